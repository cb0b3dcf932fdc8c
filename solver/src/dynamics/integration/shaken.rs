//! A motion under any shaking of the base, read while it is computed: means over equal parts of the run, extremes, and a
//! voltage thinned for a plot. Nothing of it grows with the run.

use std::sync::Arc;

use nanoserde::{DeBin, SerBin};

use super::collocation::{Collocation, Settings};
use super::measures::{Measures, Observer};
use super::node_map::NodeMap;
use super::outcome::{IntegrationError, Outcome};
use super::propagator::Propagator;
use super::rule::{NODES, NodeValues, RULE};
use super::step::Step;
use crate::model::ReducedSystem;
use crate::model::base_motion::Signal;
use crate::model::quadrature::gauss_legendre;

/// Parts of a run over each of which means are taken.
pub const PARTS: usize = 64;

/// What is integrated over a part of a run, dimensionless but for volts.
#[derive(Debug, Clone, Copy, PartialEq, Default, SerBin, DeBin)]
pub struct Part {
    /// How long it is.
    pub duration: f64,
    /// Integral of v^2 (V^2).
    pub square: f64,
    /// Work that the shaken base has put in.
    pub input: f64,
}

/// A run under a signal.
#[derive(Debug)]
pub struct Shaken {
    integrator: Collocation,
    reader: Reader,
    end: f64,
    kappa: f64,
}

#[derive(Debug)]
struct Reader {
    signal: Arc<Signal>,
    state: usize,
    observer: Observer,
    weights: Vec<f64>,
    /// For each velocity the force that a base acceleration of -1 exerts on its mode.
    participation: Vec<f64>,
    /// Their sum times the velocities at the nodes, for each length of step met.
    velocities: Vec<(f64, NodeMap)>,
    parts: Vec<Part>,
    part: f64,
    trace: Trace,
    record: Record,
}

/// The lowest and the highest voltage in equal parts of the run, with their times.
#[derive(Debug)]
struct Trace {
    width: f64,
    buckets: Vec<Option<[(f64, f64); 2]>>,
}

/// The voltage at every so many samples of the signal.
#[derive(Debug)]
struct Record {
    every: usize,
    next: usize,
    voltages: Vec<f64>,
}

impl Shaken {
    /// The run of `system` from `initial` (length 2N + 1) under `signal` (dimensionless), as long as it lasts. Of its voltage
    /// there will be about `points` for a plot, and one every `every` samples of the signal.
    ///
    /// # Errors
    /// As [`Collocation::under`].
    pub fn new(
        system: &ReducedSystem,
        signal: Arc<Signal>,
        initial: &[f64],
        (points, every): (usize, usize),
    ) -> Result<Self, IntegrationError> {
        let end = signal.duration();
        let integrator = Collocation::under(system, (signal.clone(), 0), initial, Settings::default())?;
        let modes = system.modes.len();
        let mut participation = vec![0.0; integrator.linear_part().extended_dimension()];
        for (value, mode) in participation[modes..].iter_mut().zip(system.modes.iter()) {
            *value = mode.eta1;
        }
        let buckets = (points / 2).max(1);
        let reader = Reader {
            signal,
            state: system.dimension(),
            observer: Observer::default(),
            weights: gauss_legendre(NODES).1,
            participation,
            velocities: Vec::new(),
            parts: vec![Part::default(); PARTS],
            part: end / PARTS as f64,
            trace: Trace { width: end / buckets as f64, buckets: vec![None; buckets] },
            record: Record { every: every.max(1), next: 0, voltages: Vec::new() },
        };
        Ok(Self { integrator, reader, end, kappa: system.parameters.kappa })
    }

    /// Goes on for at most `most_steps` steps; the outcome once there is one.
    ///
    /// # Errors
    /// As [`Collocation::advance`].
    pub fn advance(&mut self, most_steps: usize) -> Result<Option<Outcome>, IntegrationError> {
        let Self { integrator, reader, end, .. } = self;
        integrator.advance(*end, most_steps, &mut |step| reader.see(step))
    }

    /// Present time (dimensionless).
    pub fn time(&self) -> f64 {
        self.integrator.time()
    }

    /// Present state, length 2N + 1.
    pub fn state(&self) -> &[f64] {
        self.integrator.state()
    }

    /// Means and extremes from the beginning to the present; `None` before the first step.
    pub fn measures(&self) -> Option<Measures> {
        self.reader.observer.measures(self.kappa)
    }

    /// What was integrated over each of [`PARTS`] equal parts of the run; zero where it has not come to.
    pub fn parts(&self) -> &[Part] {
        &self.reader.parts
    }

    /// Ascending times (dimensionless) and voltages (V) for a plot: in equal parts of the run the lowest and the highest.
    pub fn trace(&self) -> Vec<(f64, f64)> {
        let mut points = Vec::with_capacity(2 * self.reader.trace.buckets.len());
        for [low, high] in self.reader.trace.buckets.iter().flatten() {
            let (first, second) = if low.0 <= high.0 { (low, high) } else { (high, low) };
            points.push(*first);
            if second != first {
                points.push(*second);
            }
        }
        points
    }

    /// The voltage (V) at the samples of the signal that were asked for, from the first on.
    pub fn voltages(&self) -> &[f64] {
        &self.reader.record.voltages
    }
}

impl Reader {
    fn see(&mut self, step: &Step<'_>) {
        let length = step.tables.step;
        let voltage = step.tables.voltage.at_nodes(step.start, step.rest);
        let mean_square = self.observer.see(step, &voltage, length);
        let place = ((step.time + 0.5 * length) / self.part) as usize;
        let input = self.input(step) * length;
        if let Some(part) = self.parts.get_mut(place.min(PARTS - 1)) {
            part.duration += length;
            part.square += mean_square * length;
            part.input += input;
        }
        self.trace.see(step, &voltage);
        self.record.see(step, self.signal.interval(), self.state);
    }

    /// Mean power that the base puts in during a step: at the nodes, which are Gauss nodes, force times velocity.
    fn input(&mut self, step: &Step<'_>) -> f64 {
        let length = step.tables.step;
        let known = self.velocities.iter().position(|(of, _)| *of == length);
        let place = known.unwrap_or_else(|| {
            let propagator = Propagator::new(step.propagator.part(), length);
            let mut map =
                NodeMap { from_state: vec![[0.0; NODES]; self.participation.len()], ..Default::default() };
            propagator.read_at_nodes(&self.participation, &mut map);
            self.velocities.push((length, map));
            self.velocities.len() - 1
        });
        let velocities = self.velocities[place].1.at_nodes(step.start, step.rest);
        let accelerations = self.accelerations(step);
        let powers = velocities.iter().zip(accelerations).zip(&self.weights);
        -powers.map(|((velocity, acceleration), weight)| weight * velocity * acceleration).sum::<f64>()
    }

    /// The base's acceleration at the nodes of a step.
    fn accelerations(&self, step: &Step<'_>) -> NodeValues {
        let length = step.tables.step / self.signal.interval();
        RULE.nodes.map(|node| {
            let derivatives = &step.start[self.state..];
            let mut sum = 0.0;
            for (k, derivative) in derivatives.iter().enumerate().rev() {
                sum = derivative + sum * node * length / (k as f64 + 1.0);
            }
            sum
        })
    }
}

impl Trace {
    fn see(&mut self, step: &Step<'_>, voltage: &NodeValues) {
        let last = self.buckets.len() - 1;
        for (node, value) in RULE.nodes.iter().zip(voltage) {
            let time = step.time + node * step.tables.step;
            let bucket = &mut self.buckets[((time / self.width) as usize).min(last)];
            let [low, high] = bucket.get_or_insert([(time, *value); 2]);
            if *value < low.1 {
                *low = (time, *value);
            }
            if *value > high.1 {
                *high = (time, *value);
            }
        }
    }
}

impl Record {
    fn see(&mut self, step: &Step<'_>, interval: f64, state: usize) {
        let place = step.time / interval;
        if place + 1e-6 > self.next as f64 {
            self.voltages.push(step.start[state - 1]);
            self.next += self.every;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dynamics::integration::trajectory::Trajectory;
    use crate::model::energy::energy;
    use crate::model::{ForceLaw, ParameterSet, Parameters};

    fn system(set: ParameterSet, modes: usize, law: ForceLaw) -> ReducedSystem {
        Parameters::new(set).and_then(|p| ReducedSystem::new(p, modes, law)).expect("a valid device")
    }

    fn run(system: &ReducedSystem, signal: &Signal) -> Shaken {
        let initial = vec![0.0; system.dimension()];
        let mut run = Shaken::new(system, Arc::new(signal.clone()), &initial, (200, 4)).expect("from rest");
        assert_eq!(run.advance(usize::MAX), Ok(Some(Outcome::Completed)));
        run
    }

    /// The base acceleration of the system's own sine, w_b'' = -beta omega^2 sin(omega t), so many samples a period.
    fn sine(system: &ReducedSystem, per_period: usize, periods: usize) -> Signal {
        let p = &system.parameters;
        let interval = p.period() / per_period as f64;
        let sample = |i: usize| -p.beta * p.omega * p.omega * (p.omega * interval * i as f64).sin();
        Signal::new(interval, (0..=per_period * periods).map(sample).collect()).expect("long enough")
    }

    #[test]
    fn a_recorded_sine_gives_the_sines_motion() {
        let set = ParameterSet { alpha: 1e-4, beta: 1e-2, omega: 8.0969, ..Default::default() };
        for law in [ForceLaw::Quadratic, ForceLaw::Exact] {
            let system = system(set, 2, law);
            // While the motion grows out of rest what is lost between samples grows with it.
            let signal = sine(&system, 64, 60);
            let own =
                Trajectory::compute(&system, &[0.0; 5], signal.duration(), Settings { tolerance: 1e-8 })
                    .expect("a run");
            let run = run(&system, &signal);
            let largest =
                own.final_state().iter().zip(run.state()).map(|(a, b)| (a - b).abs() / (0.01 + a.abs()));
            let largest = largest.fold(0.0, f64::max);
            assert!(largest < 1e-6, "{law:?}: {largest}");
            let thinned = run.trace();
            assert!(thinned.windows(2).all(|pair| pair[0].0 < pair[1].0) && thinned.len() > 150);
            let peak = thinned.iter().map(|point| point.1.abs()).fold(0.0, f64::max);
            let v_peak = run.measures().expect("measured").v_peak;
            assert!(peak <= v_peak && peak > 0.999 * v_peak, "{peak} {v_peak}");
            assert_eq!(run.voltages().len(), 64 * 60 / 4);
        }
    }

    #[test]
    fn what_the_base_puts_in_is_lost_delivered_or_stored() {
        // Without viscosity all of it reaches the load or stays: no second formula for the losses is needed.
        let set = ParameterSet { alpha: 0.0, kappa: 1e-7, ..Default::default() };
        let system = system(set, 3, ForceLaw::Exact);
        let sample = |i: usize| 0.4 * ((0.3 * i as f64).sin() + (0.037 * (i * i) as f64).cos());
        let signal = Signal::new(0.04, (0..2000).map(sample).collect()).expect("long enough");
        let run = run(&system, &signal);
        let sum = |of: fn(&Part) -> f64| run.parts().iter().map(of).sum::<f64>();
        let (input, square) = (sum(|part| part.input), sum(|part| part.square));
        let stored = energy(&system, run.state());
        let defect = input - system.parameters.kappa * square - stored;
        assert!(defect.abs() < 1e-8 * input.abs().max(stored), "{input} {stored} {defect}");
        assert!((sum(|part| part.duration) - signal.duration()).abs() < 1e-9);
    }
}
