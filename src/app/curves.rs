//! What the plots draw of a run, sampled once when the run is finished.

use egui_plot::PlotPoint;

use crate::dynamics::Outcome;
use crate::model::ReducedSystem;
use crate::questions::Run;
use crate::spacing::equally_spaced;
use crate::theory::SteadyState;

/// Samples of an excitation period in the phase portrait.
const SAMPLES_PER_PERIOD: usize = 72;
/// The same while the motion starts and in the close view.
const COARSE_SAMPLES: f64 = 40.0;
/// Periods shown of a motion that does not repeat.
const APERIODIC_PERIODS: f64 = 24.0;
/// Periods of the start, drawn faintly.
const TRANSIENT_PERIODS: f64 = 20.0;
/// Periods in the close view of the time history.
const CLOSE_PERIODS: f64 = 6.0;
/// Dots that stand for the theory on one period.
const THEORY_DOTS: usize = 48;
/// The theory is drawn up to this times the motion.
const THEORY_SIGHT: f64 = 4.0;
/// The dots of a period in the close view, where six periods share the width.
const CLOSE_DOTS: usize = 14;
/// Samples of a run that ended early.
const EARLY_SAMPLES: usize = 3000;
/// Tip displacement, in beam lengths, up to which an escape is drawn.
pub(super) const SIGHT: f64 = 0.5;
/// Points along the beam.
pub(super) const BEAM_POINTS: usize = 33;

/// Curves of one run, in the units of the plots: volts, volts per dimensionless time, dimensionless time.
#[derive(Debug, Clone, Default)]
pub(super) struct Curves {
    /// (v, dv/dt) while the motion starts.
    pub transient: Vec<PlotPoint>,
    /// (v, dv/dt) at the end of the run.
    pub phase: Vec<PlotPoint>,
    /// Stroboscopic points before and in the last quarter of the run.
    pub strobe_before: Vec<PlotPoint>,
    pub strobe: Vec<PlotPoint>,
    /// (t, v) at the end of the run.
    pub close: Vec<PlotPoint>,
    /// First-order theory, as dots over `phase` and `close`, and its stroboscopic point.
    pub theory_phase: Vec<PlotPoint>,
    pub theory_close: Vec<PlotPoint>,
    pub theory_strobe: Option<PlotPoint>,
    /// Amplitude (V) of that theory where it is left out: so large that the motion would not be seen beside it.
    pub theory_beyond: Option<f64>,
    /// Times, lowest and highest voltage of the envelope.
    pub envelope: [Vec<f64>; 3],
    /// Largest |v| and |dv/dt| of the drawn motion.
    pub extent: [f64; 2],
    /// Mode shapes at [`BEAM_POINTS`] points from clamp to tip, one row a mode.
    pub shapes: Vec<Vec<f64>>,
    /// Beam at the lowest and at the highest tip position of the drawn motion.
    pub extremes: [Vec<[f64; 2]>; 2],
    /// Time at which the drawn motion ends.
    pub end: f64,
    /// Stretch of time that the moving beam repeats.
    pub repeat: [f64; 2],
}

impl Curves {
    /// Samples `run`.
    pub(super) fn new(run: &Run) -> Self {
        let system = &run.system;
        let period = system.parameters.period();
        let early = run.outcome() != Outcome::Completed;
        let end = if early { last_time_in_sight(run) } else { run.trajectory.end_time() };
        let repeats = run.recurrence.and_then(|found| found.period);
        let shown = repeats.map_or(APERIODIC_PERIODS, |periods| 2.0 * periods as f64) * period;
        let from = if early { 0.0 } else { (end - shown).max(0.0) };
        let count =
            if early { EARLY_SAMPLES } else { ((end - from) / period * SAMPLES_PER_PERIOD as f64) as usize };
        let mut curves = Self { shapes: shapes(system), end, ..Self::default() };
        let voltage = system.dimension() - 1;
        let (mut lowest, mut highest) = (f64::INFINITY, f64::NEG_INFINITY);
        run.trajectory.sample(from, end, count.max(2), |_, state| {
            let point = PlotPoint::new(state[voltage], system.voltage_rate(state));
            curves.extent = [curves.extent[0].max(point.x.abs()), curves.extent[1].max(point.y.abs())];
            curves.phase.push(point);
            let tip = system.tip_displacement(state);
            if tip < lowest {
                lowest = tip;
                curves.extremes[0] = beam(&curves.shapes, state);
            }
            if tip > highest {
                highest = tip;
                curves.extremes[1] = beam(&curves.shapes, state);
            }
        });
        if !early {
            let until = (TRANSIENT_PERIODS * period).min(from);
            run.trajectory.sample(0.0, until, (TRANSIENT_PERIODS * COARSE_SAMPLES) as usize, |_, state| {
                curves.transient.push(PlotPoint::new(state[voltage], system.voltage_rate(state)));
            });
        }
        curves.sample_close_view(run, if early { 0.0 } else { end - CLOSE_PERIODS * period }, end);
        curves.split_strobe(run);
        curves.take_envelope(run);
        curves.add_theory(run, end);
        let loops = repeats.unwrap_or(8) as f64 * period;
        curves.repeat = [if early { 0.0 } else { (end - loops).max(0.0) }, end];
        curves
    }

    fn sample_close_view(&mut self, run: &Run, from: f64, end: f64) {
        let voltage = run.system.dimension() - 1;
        let count = (CLOSE_PERIODS * 2.0 * COARSE_SAMPLES) as usize;
        run.trajectory.sample(from.max(0.0), end, count, |time, state| {
            self.close.push(PlotPoint::new(time, state[voltage]));
        });
    }

    fn split_strobe(&mut self, run: &Run) {
        let points = &run.strobe;
        // The start belongs to the time history; the map shows where the points go.
        let (first, split) = (points.len() / 10, points.len() * 3 / 4);
        let convert = |range: &[crate::dynamics::attractors::poincare::PhasePoint]| {
            range.iter().map(|point| PlotPoint::new(point.v, point.dv_dt)).collect()
        };
        if run.outcome() == Outcome::Completed {
            self.strobe_before = convert(&points[first..split]);
            self.strobe = convert(&points[split..]);
        } else {
            self.strobe = convert(points);
            // The last ones are of a tip that is out of sight.
            let [width, height] = self.extent;
            self.strobe.retain(|point| point.x.abs() <= width && point.y.abs() <= height);
        }
    }

    fn take_envelope(&mut self, run: &Run) {
        let envelope = &run.envelope;
        let early = run.outcome() != Outcome::Completed;
        for (i, (low, high)) in envelope.slices.iter().enumerate() {
            let time = (i as f64 + 0.5) * envelope.width;
            let reaches = if early { time + 0.5 * envelope.width } else { time };
            if low.is_finite() && reaches <= self.end {
                self.envelope[0].push(time);
                self.envelope[1].push(*low);
                self.envelope[2].push(*high);
            }
        }
    }

    fn add_theory(&mut self, run: &Run, end: f64) {
        // At a natural frequency the first-order theory has no steady state, and no dots.
        let Ok(theory) = SteadyState::new(&run.system) else { return };
        let period = run.system.parameters.period();
        let voltage = theory.voltage;
        // Above a resonance the amplitudes of Eq. (43) are negative.
        let amplitude = voltage.amplitude.abs();
        if amplitude > THEORY_SIGHT * self.extent[0] {
            self.theory_beyond = Some(amplitude);
            return;
        }
        let place = |time: f64| PlotPoint::new(voltage.value(time), voltage.rate(time));
        let times = |from: f64, count: usize, dots: usize| {
            (0..count).map(move |i| from + period * i as f64 / dots as f64)
        };
        self.theory_phase = times(0.0, THEORY_DOTS, THEORY_DOTS).map(place).collect();
        let start = (end - CLOSE_PERIODS * period).max(0.0);
        let dots = CLOSE_DOTS * CLOSE_PERIODS as usize;
        self.theory_close =
            times(start, dots, CLOSE_DOTS).map(|time| PlotPoint::new(time, voltage.value(time))).collect();
        self.theory_strobe = Some(place(0.0));
    }
}

/// When a run that ended early last had its tip within a beam's length of rest; beyond, nothing else would be seen.
fn last_time_in_sight(run: &Run) -> f64 {
    let end = run.trajectory.end_time();
    let mut last = end;
    let mut lost = false;
    run.trajectory.sample(0.0, end, EARLY_SAMPLES, |time, state| {
        lost |= run.system.tip_displacement(state).abs() > SIGHT;
        if !lost {
            last = time;
        }
    });
    last
}

/// Mode shapes along the beam, one row a mode.
pub(super) fn shapes(system: &ReducedSystem) -> Vec<Vec<f64>> {
    let along = || equally_spaced((0.0, 1.0), BEAM_POINTS);
    system.modes.iter().map(|mode| along().map(|x| mode.shape(x)).collect()).collect()
}

/// The deflection of the beam in a state, as points (x, z) from clamp to tip, in beam lengths.
pub(super) fn beam(shapes: &[Vec<f64>], state: &[f64]) -> Vec<[f64; 2]> {
    equally_spaced((0.0, 1.0), BEAM_POINTS)
        .enumerate()
        .map(|(i, x)| [x, shapes.iter().zip(state).map(|(shape, q)| shape[i] * q).sum()])
        .collect()
}

#[cfg(test)]
mod tests {
    use super::Outcome;
    use crate::app::rehearsal::Desk;

    #[test]
    fn after_an_escape_axes_show_the_motion() {
        for (omega, beta) in [(4.0, 0.02), (25.0, 0.05), (15.0, 0.1), (2.0, 0.2), (8.0969, 0.02)] {
            let stored = format!(
                r#"{{"scenario":{{"parameters":{{"omega":{omega},"beta":{beta}}},"model":{{"force":"quadratic"}}}}}}"#
            );
            let mut desk = Desk::new(1000.0, 700.0, &stored);
            desk.work(4);
            let shown = desk.app.session.shown.as_ref().expect("a run");
            assert!(matches!(shown.run.outcome(), Outcome::Escaped { .. }), "{omega} {beta}");
            let curves = &shown.curves;
            let highest = curves.envelope[1..].iter().flatten().fold(0.0, |most: f64, v| most.max(v.abs()));
            let strobe = curves.strobe.iter().fold(0.0, |most: f64, point| most.max(point.x.abs()));
            assert!(curves.extent[0] < 400.0, "{omega} {beta}: {:?}", curves.extent);
            assert!(highest <= 1.01 * curves.extent[0] && strobe <= curves.extent[0], "{highest} {strobe}");
        }
    }

    #[test]
    fn a_theory_far_outside_the_motion_does_not_set_the_axes() {
        // Near omega_1 the damping that the first-order theory leaves out decides.
        let run = |alpha: f64, omega: f64| {
            let stored = format!(
                r#"{{"scenario":{{"parameters":{{"c0":0,"omega":{omega},"beta":1e-4,"alpha":{alpha}}},"model":{{"force":"exact"}}}}}}"#
            );
            let mut desk = Desk::new(1000.0, 700.0, &stored);
            desk.work(4);
            desk.app.session.shown.as_ref().expect("a run").curves.clone()
        };
        for omega in [3.33, 3.43] {
            let heavy = run(0.1, omega);
            let volts = heavy.theory_beyond.expect("it is far outside");
            assert!(volts > 4.0 * heavy.extent[0]);
            assert!(heavy.theory_phase.is_empty() && heavy.theory_strobe.is_none());
        }
        let light = run(1e-3, 3.3);
        assert!(light.theory_beyond.is_none() && !light.theory_phase.is_empty(), "{:?}", light.extent);
    }
}
