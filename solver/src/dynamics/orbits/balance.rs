//! The energy balance of a motion: mean powers over whole excitation periods, with the extremes met on the way.
//!
//! The powers are read at the Gauss nodes of the integrator's steps, so that their means are as accurate as the motion.

use crate::dynamics::integration::extremes::{Highest, Scalar};
use crate::dynamics::integration::propagator::{Propagator, StepRest, Workspace};
use crate::dynamics::integration::rule::RULE;
use crate::dynamics::integration::{Collocation, IntegrationError, NODES, Outcome, Settings, Step};
use crate::model::ReducedSystem;
use crate::model::energy::{energy, powers};
use crate::model::quadrature::gauss_legendre;

/// Tolerance of the run: a thousand times finer than usual, since the balance is to close to eight digits.
const TOLERANCE: f64 = 1e-8;

/// Mean powers (dimensionless) and extremes of a motion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Balance {
    /// Power that the shaken base puts in.
    pub input: f64,
    /// Power lost in the Kelvin-Voigt material.
    pub viscous: f64,
    /// Power kappa v^2 that leaves through the whole conductance.
    pub electrical: f64,
    /// Rate at which the stored energy grew; 0 over a period of a periodic motion.
    pub stored: f64,
    /// Root mean square of the voltage (V).
    pub v_rms: f64,
    /// Largest |v| (V).
    pub v_peak: f64,
    /// Lowest and highest tip displacement, in beam lengths.
    pub tip: (f64, f64),
    /// Largest |slope| at the tip from equilibrium (rad), read at the nodes, which may miss some per mille.
    pub slope: f64,
}

impl Balance {
    /// |input - viscous - electrical - stored| over the largest of the four: what the integration has lost.
    pub fn defect(&self) -> f64 {
        let terms = [self.input, self.viscous, self.electrical, self.stored];
        let largest = terms.iter().fold(0.0, |largest: f64, term| largest.max(term.abs()));
        let sum = self.input - self.viscous - self.electrical - self.stored;
        if largest > 0.0 { (sum / largest).abs() } else { 0.0 }
    }

    /// The balance of the motion of `system` over `periods` excitation periods from `state` (length 2N + 1) at a
    /// stroboscopic instant; `None` when it ends within them.
    ///
    /// # Errors
    /// As [`Collocation::new`] and [`Collocation::advance`].
    pub fn of(
        system: &ReducedSystem,
        state: &[f64],
        periods: usize,
    ) -> Result<Option<Self>, IntegrationError> {
        let end = periods as f64 * system.parameters.period();
        let mut integrator = Collocation::new(system, state, Settings { tolerance: TOLERANCE })?;
        let mut reader = Reader::new(system);
        let outcome = loop {
            let outcome = integrator.advance(end, usize::MAX, &mut |step| reader.record(step))?;
            if let Some(outcome) = outcome {
                break outcome;
            }
        };
        let gained = energy(system, integrator.state()) - energy(system, state);
        let completed = outcome == Outcome::Completed;
        Ok(completed.then(|| reader.balance(integrator.propagator(), gained)))
    }
}

/// Integrates the powers step by step.
struct Reader<'a> {
    system: &'a ReducedSystem,
    weights: Vec<f64>,
    /// Input, viscous, electrical power and v^2.
    integrals: [f64; 4],
    duration: f64,
    tip: [Highest; 2],
    voltage: [Highest; 2],
    slope: [Highest; 2],
    state: Vec<f64>,
    workspace: Workspace,
}

impl<'a> Reader<'a> {
    fn new(system: &'a ReducedSystem) -> Self {
        let both = |scalar| [1.0, -1.0].map(|sign| Highest::new(scalar, sign));
        Self {
            system,
            weights: gauss_legendre(NODES).1,
            integrals: [0.0; 4],
            duration: 0.0,
            tip: both(Scalar::Tip),
            voltage: both(Scalar::Voltage),
            slope: both(Scalar::TipSlope),
            state: Vec::new(),
            workspace: Workspace::default(),
        }
    }

    fn record(&mut self, step: &Step<'_>) {
        let length = step.tables.step;
        let voltage = step.tables.voltage.at_nodes(step.start, step.rest);
        self.tip.iter_mut().for_each(|highest| highest.see(step, step.tip));
        self.voltage.iter_mut().for_each(|highest| highest.see(step, &voltage));
        let slope = step.tables.tip_slope.at_nodes(step.start, step.rest);
        self.slope.iter_mut().for_each(|highest| highest.see(step, &slope));
        let rest = StepRest::new(step.rest, length);
        self.state.clear();
        self.state.extend_from_slice(step.start);
        let dimension = self.system.dimension();
        let p = &self.system.parameters;
        let mut offset = 0.0;
        for (node, weight) in RULE.nodes.iter().zip(&self.weights) {
            let next = node * length;
            step.propagator.carry(&mut self.state, offset, next, &rest, &mut self.workspace);
            offset = next;
            let sine = (p.omega * (step.time + offset)).sin();
            let state = &self.state[..dimension];
            let now = powers(self.system, state, sine);
            let voltage = state[dimension - 1];
            for (integral, value) in
                self.integrals.iter_mut().zip([now.input, now.viscous, now.electrical, voltage * voltage])
            {
                *integral += weight * length * value;
            }
        }
        self.duration += length;
    }

    fn balance(&self, propagator: &Propagator, gained: f64) -> Balance {
        let [input, viscous, electrical, square] = self.integrals.map(|integral| integral / self.duration);
        let [high, low] = self.tip.each_ref().map(|highest| highest.value(propagator));
        let largest = |both| Highest::larger(both, propagator);
        Balance {
            input,
            viscous,
            electrical,
            stored: gained / self.duration,
            v_rms: square.sqrt(),
            v_peak: largest(&self.voltage),
            tip: (-low, high),
            slope: largest(&self.slope),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dynamics::orbits::orbit::Orbit;
    use crate::model::{ForceLaw, ParameterSet, Parameters};

    #[test]
    fn every_steady_state_keeps_its_energy() {
        for (alpha, beta, omega, law, modes) in [
            (1e-4, 1e-2, 8.0969, ForceLaw::Quadratic, 2),
            (1e-3, 1e-3, 25.0, ForceLaw::Exact, 4),
            (1e-3, 1e-3, 4.0, ForceLaw::Taylor(5), 3),
            (1e-4, 1e-3, 43.0, ForceLaw::Exact, 1),
        ] {
            let set = ParameterSet { alpha, beta, omega, ..Default::default() };
            let parameters = Parameters::new(set).expect("in range");
            let system = ReducedSystem::new(parameters, modes, law).expect("a device");
            let orbit = Orbit::find(&system, None, 1).expect("a forced motion");
            let balance = Balance::of(&system, &orbit.state, 1).expect("a run").expect("it lasts");
            assert!(balance.stored.abs() < 1e-8 * balance.input, "{balance:?}");
            assert!(balance.defect() < 1e-8, "{balance:?}");
            let measures = orbit.measures;
            assert!((balance.v_rms / measures.v_rms - 1.0).abs() < 1e-8, "{balance:?} {measures:?}");
            assert!((balance.v_peak / measures.v_peak - 1.0).abs() < 1e-7, "{balance:?} {measures:?}");
            assert!((balance.tip.0 / measures.tip_min - 1.0).abs() < 1e-7, "{balance:?} {measures:?}");
            // The first mode's slope at the tip is 1.4 of its displacement.
            assert!(balance.slope > balance.tip.1, "{balance:?}");
        }
    }
}
