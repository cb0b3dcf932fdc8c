//! The classical fourth-order Runge-Kutta method, as the paper runs it (section 3.3): 10,000 steps a period.

use std::f64::consts::TAU;

use nalgebra::Complex;

use super::collocation::check_state;
use super::outcome::{ESCAPE_DISPLACEMENT, IntegrationError, Outcome};
use crate::model::{ReducedSystem, RestForce};

/// Steps of one excitation period in the paper's runs.
pub const PAPER_STEPS_PER_PERIOD: u32 = 10_000;
/// Halvings of the step in which a run ends: they find the instant to 1e-12 of the step.
const HALVINGS: usize = 40;

/// The factor |1 + z + z^2/2 + z^3/6 + z^4/24| by which a step of length h multiplies a linear motion exp(lambda t), with
/// z = lambda h. Where it is above 1 for a motion that decays, the steps are too long and the numbers grow by themselves.
///
/// Source: Hairer & Wanner, "Solving Ordinary Differential Equations II", section IV.2.
pub fn amplification(z: Complex<f64>) -> f64 {
    (1.0 + z * (1.0 + z / 2.0 * (1.0 + z / 3.0 * (1.0 + z / 4.0)))).norm()
}

/// The classical method on a grid of equal fractions of the excitation period.
///
/// It has no error control: it is as accurate as its step, and unstable when alpha omega_N^2 times the step
/// exceeds about 2.8.
#[derive(Debug, Clone)]
pub struct RungeKutta4<'a> {
    system: &'a ReducedSystem,
    force: RestForce,
    steps_per_period: u32,
    /// Whole steps done, and the share of a step beyond them once the run has ended.
    count: u64,
    share: f64,
    state: Vec<f64>,
    stages: [Vec<f64>; 4],
    probe: Vec<f64>,
}

impl<'a> RungeKutta4<'a> {
    /// Starts `system` under its own force law at time 0 in `initial` (length 2N + 1) with `steps_per_period` > 0 steps a period.
    ///
    /// # Errors
    /// [`IntegrationError::InitialState`].
    pub fn new(
        system: &'a ReducedSystem,
        initial: &[f64],
        steps_per_period: u32,
    ) -> Result<Self, IntegrationError> {
        check_state(initial, system.dimension())?;
        let zero = vec![0.0; system.dimension()];
        Ok(Self {
            system,
            force: system.rest_force(),
            steps_per_period: steps_per_period.max(1),
            count: 0,
            share: 0.0,
            state: initial.to_vec(),
            stages: std::array::from_fn(|_| zero.clone()),
            probe: zero,
        })
    }

    /// Step length 2 pi / (steps_per_period omega) (dimensionless time).
    pub fn step_length(&self) -> f64 {
        self.system.parameters.period() / f64::from(self.steps_per_period)
    }

    /// Present time (dimensionless).
    pub fn time(&self) -> f64 {
        (self.count as f64 + self.share) * self.step_length()
    }

    /// Present state, length 2N + 1.
    pub fn state(&self) -> &[f64] {
        &self.state
    }

    /// Whole steps done.
    pub fn steps(&self) -> u64 {
        self.count
    }

    /// One step; the outcome when the tip has escaped or the magnets touched. The run then ends where it did, with a
    /// step shortened to there.
    pub fn step(&mut self) -> Option<Outcome> {
        let start = self.state.clone();
        self.go(&start, 1.0);
        if self.ended().is_none() {
            self.count += 1;
            return None;
        }
        let (mut inside, mut outside) = (0.0, 1.0);
        for _ in 0..HALVINGS {
            let middle = 0.5 * (inside + outside);
            self.go(&start, middle);
            let end = if self.ended().is_some() { &mut outside } else { &mut inside };
            *end = middle;
        }
        self.go(&start, outside);
        self.share = outside;
        self.ended()
    }

    /// The last step of a run, shortened to end at `time`, which is within a step from now.
    pub fn step_to(&mut self, time: f64) -> Option<Outcome> {
        let start = self.state.clone();
        let share = ((time - self.time()) / self.step_length()).clamp(0.0, 1.0);
        self.go(&start, share);
        if self.ended().is_some() {
            // It ends within a whole step, too.
            self.state = start;
            return self.step();
        }
        self.share = share;
        None
    }

    /// From `start` at the present grid point on by a `share` of a step.
    fn go(&mut self, start: &[f64], share: f64) {
        let h = share * self.step_length();
        let steps = u64::from(self.steps_per_period);
        // The phase is taken within the period, where its sine keeps all digits.
        let place = (self.count % steps) as f64;
        let sine = |part: f64| (TAU * (place + part * share) / steps as f64).sin();
        let (begin, middle, end) = (sine(0.0), sine(0.5), sine(1.0));
        let Self { system, force, state, stages: [k1, k2, k3, k4], probe, .. } = self;
        let evaluate = |state: &[f64], sine: f64, out: &mut [f64]| {
            system.derivative(state, force.rest(system.tip_displacement(state)), sine, out);
        };
        let shift = |factor: f64, stage: &[f64], out: &mut [f64]| {
            for ((out, y), k) in out.iter_mut().zip(start).zip(stage) {
                *out = y + factor * k;
            }
        };
        evaluate(start, begin, k1);
        shift(0.5 * h, k1, probe);
        evaluate(probe, middle, k2);
        shift(0.5 * h, k2, probe);
        evaluate(probe, middle, k3);
        shift(h, k3, probe);
        evaluate(probe, end, k4);
        for (i, (y, start)) in state.iter_mut().zip(start).enumerate() {
            *y = start + h / 6.0 * (k1[i] + 2.0 * (k2[i] + k3[i]) + k4[i]);
        }
    }

    fn ended(&self) -> Option<Outcome> {
        let s = self.system.tip_displacement(&self.state);
        let time = self.time();
        if self.force.contact().is_some_and(|contact| s <= contact) {
            Some(Outcome::Contact { time })
        } else if !(s.abs() < ESCAPE_DISPLACEMENT) {
            Some(Outcome::Escaped { time })
        } else {
            None
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_region_of_stability_is_the_textbooks() {
        // Borders on the real and the imaginary axis: 2.785293563 and 2 sqrt(2).
        let (real, imaginary) = (2.785293563405282, 8.0_f64.sqrt());
        assert!((amplification(Complex::new(-real, 0.0)) - 1.0).abs() < 1e-12);
        assert!((amplification(Complex::new(0.0, imaginary)) - 1.0).abs() < 1e-12);
        assert!(amplification(Complex::new(0.0, 1.001 * imaginary)) > 1.0);
        let z = Complex::new(-0.01, 0.02);
        assert!((amplification(z) - z.exp().norm()).abs() < 1e-10);
    }
}
