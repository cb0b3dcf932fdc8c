//! The run behind the linked plots: computed in slices, so that a frame never waits for it.

use crate::dynamics::attractors::poincare::{PhasePoint, Recurrence, recurrence};
use crate::dynamics::integration::Step;
use crate::dynamics::integration::summary::{Collector, Envelope, Summary};
use crate::dynamics::{Collocation, Measures, Outcome, RunError, Settings, Trajectory};
use crate::model::ReducedSystem;
use crate::scenario::Scenario;

/// Slices of the voltage's envelope; about as many as a plot has pixels.
const ENVELOPE_SLICES: usize = 800;
/// Periods in a slice at least, unless the run is short: fewer, and the edges would beat with the motion.
const PERIODS_PER_SLICE: f64 = 4.0;
/// Fewest slices.
const LEAST_SLICES: usize = 60;
/// Part of a run that its summary covers at least, unless there are no whole periods to cover: the last tenth.
const WINDOW: f64 = 0.1;

/// Everything the plots show of one run.
#[derive(Debug, Clone)]
pub struct Run {
    /// The system that was integrated.
    pub system: ReducedSystem,
    /// Its motion, with dense output.
    pub trajectory: Trajectory,
    /// (v, dv/dt) at t = 2 pi k / omega, k = 0, 1, ..
    pub strobe: Vec<PhasePoint>,
    /// Amplitudes and means over the last tenth in whole pairs of excitation periods, or over the whole run when it
    /// ended early or is shorter than such a pair.
    pub summary: Option<Summary>,
    /// Envelope of the voltage.
    pub envelope: Envelope,
    /// Whether the stroboscopic points recur; `None` when there are too few.
    pub recurrence: Option<Recurrence>,
}

impl Run {
    /// How the run ended.
    pub fn outcome(&self) -> Outcome {
        self.trajectory.outcome
    }

    /// Computes the whole run of `scenario` at once.
    ///
    /// # Errors
    /// [`RunError`].
    pub fn compute(scenario: &Scenario) -> Result<Self, RunError> {
        let mut job = RunJob::new(scenario)?;
        loop {
            if let Some(run) = job.advance(usize::MAX)? {
                return Ok(run);
            }
        }
    }
}

/// A run being computed.
pub struct RunJob {
    integrator: Collocation,
    system: ReducedSystem,
    t_end: f64,
    recorder: Option<Recorder>,
}

impl std::fmt::Debug for RunJob {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("RunJob").field("t_end", &self.t_end).field("progress", &self.progress()).finish()
    }
}

impl RunJob {
    /// Prepares the run of `scenario`.
    ///
    /// # Errors
    /// [`RunError`] when the scenario is not valid.
    pub fn new(scenario: &Scenario) -> Result<Self, RunError> {
        let (system, initial) = scenario.validate()?;
        let t_end = scenario.t_end;
        let integrator = Collocation::new(&system, &initial, Settings::default())?;
        let period = system.parameters.period();
        // Whole pairs of periods, so that means are those of the motion, also when its period has doubled.
        let last = (t_end / period + 1e-9).floor();
        let pairs = (0.5 * WINDOW * t_end / period).ceil().min((0.5 * last).floor());
        let window = ((last - 2.0 * pairs) * period, last * period);
        let slices = (t_end / (PERIODS_PER_SLICE * period)) as usize;
        let slices = slices.clamp(LEAST_SLICES, ENVELOPE_SLICES);
        let recorder = Recorder {
            trajectory: Trajectory::recorder(&integrator),
            strobe: Vec::with_capacity((t_end / period) as usize + 2),
            collector: Collector::new(window, t_end, slices),
        };
        Ok(Self { integrator, system, t_end, recorder: Some(recorder) })
    }

    /// Done part of the run, 0 to 1.
    pub fn progress(&self) -> f64 {
        (self.integrator.time() / self.t_end).clamp(0.0, 1.0)
    }

    /// Goes on for at most `steps` steps; the finished run once there is one.
    ///
    /// # Errors
    /// [`RunError`] when the motion cannot be resolved.
    pub fn advance(&mut self, steps: usize) -> Result<Option<Run>, RunError> {
        let Some(mut recorder) = self.recorder.take() else { return Ok(None) };
        let outcome =
            self.integrator.advance(self.t_end, steps, &mut |step| recorder.record(step, &self.system))?;
        let Some(outcome) = outcome else {
            self.recorder = Some(recorder);
            return Ok(None);
        };
        recorder.trajectory.finish(&self.integrator, outcome);
        Ok(Some(recorder.finish(self.system.clone())))
    }
}

/// What is recorded while a run goes on.
struct Recorder {
    trajectory: Trajectory,
    strobe: Vec<PhasePoint>,
    collector: Collector,
}

impl Recorder {
    fn record(&mut self, step: &Step<'_>, system: &ReducedSystem) {
        if step.index == 0 {
            let state = &step.start[..system.dimension()];
            self.strobe.push(PhasePoint { v: state[state.len() - 1], dv_dt: system.voltage_rate(state) });
        }
        self.trajectory.record(step);
        self.collector.record(step);
    }

    fn finish(self, system: ReducedSystem) -> Run {
        let Self { trajectory, strobe, collector } = self;
        let summary = collector
            .summary(trajectory.propagator(), system.parameters.kappa)
            .or_else(|| whole_run(&trajectory, &system));
        let recurrence = match (trajectory.outcome, &summary) {
            (Outcome::Completed, Some(summary)) => {
                recurrence(&strobe, summary.measures.v_peak, summary.dv_dt_peak)
            }
            _ => None,
        };
        let envelope = collector.envelope().clone();
        Run { system, trajectory, strobe, summary, envelope, recurrence }
    }
}

/// The summary of a run that ended before its window began.
fn whole_run(trajectory: &Trajectory, system: &ReducedSystem) -> Option<Summary> {
    let to = trajectory.end_time();
    if !(to > 0.0) {
        return None;
    }
    let n = system.modes.len();
    let tip = (f64::INFINITY, f64::NEG_INFINITY);
    let mut measures = Measures { tip, ..Measures::default() };
    let (mut square, mut dv_dt_peak) = (0.0, 0.0_f64);
    const SAMPLES: usize = 2000;
    trajectory.sample(0.0, to, SAMPLES, |_, state| {
        let (v, tip) = (state[2 * n], system.tip_displacement(state));
        square += v * v / SAMPLES as f64;
        dv_dt_peak = dv_dt_peak.max(system.voltage_rate(state).abs());
        measures.v_peak = measures.v_peak.max(v.abs());
        measures.tip = (measures.tip.0.min(tip), measures.tip.1.max(tip));
        measures.slope = measures.slope.max(system.tip_slope(state).abs());
    });
    let measures = measures.with_mean_square(square, system.parameters.kappa);
    Some(Summary { from: 0.0, to, measures, dv_dt_peak, v_peak_whole: measures.v_peak })
}
