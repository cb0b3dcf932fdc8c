//! The energy balance of a motion: mean powers over whole excitation periods, with the extremes met on the way.
//!
//! The powers are read at the Gauss nodes of the integrator's steps, so that their means are as accurate as the motion.

use crate::dynamics::integration::measures::Observer;
use crate::dynamics::integration::propagator::{StepRest, Workspace};
use crate::dynamics::integration::rule::RULE;
use crate::dynamics::integration::{Collocation, IntegrationError, Measures, NODES, Outcome, Settings, Step};
use crate::model::ReducedSystem;
use crate::model::energy::{energy, powers};
use crate::model::quadrature::gauss_legendre;

/// Tolerance of the run: a thousand times finer than usual, since the balance is to close to eight digits.
const TOLERANCE: f64 = 1e-8;

/// Mean powers (dimensionless) of a motion, with its other numbers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Balance {
    /// Power that the shaken base puts in.
    pub input: f64,
    /// Power lost in the Kelvin-Voigt material and to the air.
    pub viscous: f64,
    /// Rate at which the stored energy grew; 0 over a period of a periodic motion.
    pub stored: f64,
    /// Means and extremes; the power kappa v^2 leaves through the whole conductance.
    pub measures: Measures,
}

impl Balance {
    /// |input - viscous - electrical - stored| over the largest of the four: what the integration has lost.
    pub fn defect(&self) -> f64 {
        let terms = [self.input, self.viscous, self.measures.power, self.stored];
        let largest = terms.iter().fold(0.0, |largest: f64, term| largest.max(term.abs()));
        let sum = self.input - self.viscous - self.measures.power - self.stored;
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
        let whole = vec![1.0 / periods as f64; periods];
        Ok(Self::averaged(system, state, &whole)?.map(|(balance, _)| balance))
    }

    /// The same with a weight of each excitation period, whose sum is 1: where a motion never repeats, its means depend on them.
    /// With the mean electrical power of each period.
    ///
    /// # Errors
    /// As [`Self::of`].
    pub fn averaged(
        system: &ReducedSystem,
        state: &[f64],
        weights: &[f64],
    ) -> Result<Option<(Self, Vec<f64>)>, IntegrationError> {
        let period = system.parameters.period();
        let mut integrator = Collocation::new(system, state, Settings { tolerance: TOLERANCE })?;
        let mut reader = Reader::new(system);
        let mut means = [0.0; 4];
        let mut stored = 0.0;
        let mut powers = Vec::with_capacity(weights.len());
        let mut before = energy(system, state);
        for (k, weight) in weights.iter().enumerate() {
            reader.integrals = [0.0; 4];
            let outcome = loop {
                let end = (k + 1) as f64 * period;
                if let Some(outcome) = integrator.advance(end, usize::MAX, &mut |step| reader.record(step))? {
                    break outcome;
                }
            };
            if outcome != Outcome::Completed {
                return Ok(None);
            }
            let now = energy(system, integrator.state());
            stored += weight * (now - before) / period;
            before = now;
            for (mean, integral) in means.iter_mut().zip(&reader.integrals) {
                *mean += weight * integral / period;
            }
            powers.push(reader.integrals[ELECTRICAL] / period);
        }
        let [input, viscous, power, square] = means;
        let seen = reader.observer.measures(system.parameters.kappa).unwrap_or_default();
        let measures = Measures { v_rms: square.sqrt(), power, ..seen };
        Ok(Some((Self { input, viscous, stored, measures }, powers)))
    }
}

/// Place of the electrical power among the integrals.
const ELECTRICAL: usize = 2;

/// Integrates the powers step by step.
struct Reader<'a> {
    system: &'a ReducedSystem,
    weights: Vec<f64>,
    /// Input, viscous, electrical power and v^2.
    integrals: [f64; 4],
    observer: Observer,
    state: Vec<f64>,
    workspace: Workspace,
}

impl<'a> Reader<'a> {
    fn new(system: &'a ReducedSystem) -> Self {
        Self {
            system,
            weights: gauss_legendre(NODES).1,
            integrals: [0.0; 4],
            observer: Observer::default(),
            state: Vec::new(),
            workspace: Workspace::default(),
        }
    }

    fn record(&mut self, step: &Step<'_>) {
        let length = step.tables.step;
        self.observer.record(step, length);
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
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dynamics::orbits::orbit::Orbit;
    use crate::model::{ForceLaw, ParameterSet, Parameters};

    #[test]
    fn every_steady_state_keeps_its_energy() {
        for (alpha, air, beta, omega, law, modes) in [
            (1e-4, 0.0, 1e-2, 8.0969, ForceLaw::Quadratic, 2),
            (1e-3, 0.0, 1e-3, 25.0, ForceLaw::Exact, 4),
            (1e-3, 0.0, 1e-3, 4.0, ForceLaw::Taylor(5), 3),
            (1e-4, 0.0, 1e-3, 43.0, ForceLaw::Exact, 1),
            (1e-4, 0.08, 1e-3, 4.0, ForceLaw::Exact, 3),
            (0.0, 0.2, 1e-3, 8.0, ForceLaw::Quadratic, 2),
        ] {
            // A tip that turns where there is air.
            let (j, e) = if air > 0.0 { (2e-3, 0.03) } else { (0.0, 0.0) };
            let set = ParameterSet { alpha, beta, omega, air, j, e, ..Default::default() };
            let parameters = Parameters::new(set).expect("in range");
            let system = ReducedSystem::new(parameters, modes, law).expect("a device");
            let orbit = Orbit::find(&system, None, 1).expect("a forced motion");
            let balance = Balance::of(&system, &orbit.state, 1).expect("a run").expect("it lasts");
            assert!(balance.stored.abs() < 1e-8 * balance.input, "{balance:?}");
            assert!(balance.defect() < 1e-8, "{balance:?}");
            let (found, measures) = (balance.measures, orbit.measures);
            assert!((found.v_rms / measures.v_rms - 1.0).abs() < 1e-8, "{balance:?} {measures:?}");
            assert!((found.v_peak / measures.v_peak - 1.0).abs() < 1e-7, "{balance:?} {measures:?}");
            assert!((found.tip.0 / measures.tip.0 - 1.0).abs() < 1e-7, "{balance:?} {measures:?}");
            // The first mode's slope at the tip is 1.4 of its displacement.
            assert!(found.slope > found.tip.1, "{balance:?}");
        }
    }
}
