//! The periodic motions of a system that starts have led to so far, and the search for further ones.

use super::neighbourhood::Neighbourhood;
use super::signature::Signature;
use crate::dynamics::integration::{Collocation, IntegrationError, Settings};
use crate::dynamics::orbits::newton::Convergence;
use crate::dynamics::orbits::{Orbit, OrbitSolver, PeriodMap};
use crate::model::{ParameterSet, ReducedSystem};

/// How often the map's grid may be halved: for motions that touch almost, finer ones cost more than they tell.
const DEEPEST_LEVEL: u32 = 7;
/// Longest period that is looked for from afar.
const SHORT: usize = 8;
/// Most motions of one system that serve as guesses for the next.
const MOST_GUESSES: usize = 4;
/// Distance, relative to the gap, below which two orbits are the same.
const SAME: f64 = 1e-6;

/// What is known of a system's periodic motions.
pub(super) struct Repertoire {
    pub(super) system: ReducedSystem,
    /// Of the map on its coarsest grid, whose steps are the integrator's longest.
    solver: OrbitSolver,
    pub(super) known: Vec<Neighbourhood>,
    /// Periodic motions of a system like this one, with their periods: where its own are looked for first.
    guesses: Vec<(Vec<f64>, usize)>,
}

impl Repertoire {
    /// Nothing is known yet.
    pub(super) fn new(system: &ReducedSystem) -> Self {
        let map = PeriodMap::new(system).limited(DEEPEST_LEVEL);
        let solver = OrbitSolver::with_map(system, map);
        Self { system: system.clone(), solver, known: Vec::new(), guesses: Vec::new() }
    }

    /// That of `system`, one like this: its periodic motions are looked for near those of this one. Where only the excitation's
    /// amplitude differs, which is in no table, it has the same tables.
    pub(super) fn turned_to(&self, system: &ReducedSystem) -> Self {
        let stable = self.known.iter().map(|known| &known.orbit).filter(|orbit| orbit.stable());
        let guesses = stable.take(MOST_GUESSES).map(|orbit| (orbit.state.clone(), orbit.periods)).collect();
        if self.has_tables_of(system) {
            let (system, solver) = (system.clone(), self.solver.clone());
            Self { system, solver, known: Vec::new(), guesses }
        } else {
            Self { guesses, ..Self::new(system) }
        }
    }

    /// Whether only the excitation's amplitude differs.
    fn has_tables_of(&self, system: &ReducedSystem) -> bool {
        let beta = system.parameters.beta;
        let model = |system: &ReducedSystem| (system.modes.len(), system.law, system.residual_moment);
        let same_set = ParameterSet { beta, ..*self.system.parameters } == *system.parameters;
        same_set && model(&self.system) == model(system)
    }

    /// An integrator of the system from `initial` (length 2N + 1), whose steps are those of the map.
    ///
    /// # Errors
    /// As [`Collocation::new`].
    pub(super) fn integrator(
        &mut self,
        initial: &[f64],
        settings: Settings,
    ) -> Result<Collocation, IntegrationError> {
        Collocation::with_rung(&self.system, initial, self.solver.map().rung(), settings)
    }

    /// The stable periodic motions met so far.
    pub(super) fn stable_orbits(&self) -> Vec<Signature> {
        let stable = self.known.iter().filter(|known| known.orbit.stable());
        stable.map(|known| Signature::of_orbit(&known.orbit, known.states_from(&known.orbit.state))).collect()
    }

    /// The orbit of `periods` excitation periods that Newton's iteration reaches from `state`, as an index into those
    /// known.
    pub(super) fn find(&mut self, state: &[f64], periods: usize) -> Option<usize> {
        let beta = self.system.parameters.beta;
        let mut solver = self.solver.clone();
        // A long period is looked for where the states nearly repeat already, so that the iteration converges or never will.
        let convergence = if periods > SHORT {
            solver.follow_state(state, beta, periods).ok()?
        } else {
            solver.find_state(state, beta, periods).ok()?
        };
        self.learn(solver, convergence, periods)
    }

    /// The orbits near the motions of a system like this one, as indices into those known.
    pub(super) fn find_guessed(&mut self) -> Vec<usize> {
        let beta = self.system.parameters.beta;
        let guesses = std::mem::take(&mut self.guesses);
        let found = guesses.into_iter().filter_map(|(state, periods)| {
            let mut solver = self.solver.clone();
            let convergence = solver.follow_state(&state, beta, periods).ok()?;
            self.learn(solver, convergence, periods)
        });
        found.collect()
    }

    /// The orbit of `periods` that `solver` has found, as an index into those known.
    fn learn(&mut self, mut solver: OrbitSolver, convergence: Convergence, periods: usize) -> Option<usize> {
        let beta = self.system.parameters.beta;
        let gap = self.system.equilibrium.gap;
        let found = solver.state().to_vec();
        if let Some(index) = self.known.iter().position(|known| known.holds(&found, SAME * gap)) {
            return Some(index);
        }
        let mut orbit = Orbit::read(&self.system, &mut solver, convergence, beta, periods).ok()?;
        if !solver.was_resolved() {
            // The derivative, which the search for the state left out at last, asks for a finer grid than the motion.
            let convergence = solver.find(&found, beta, periods).ok()?;
            orbit = Orbit::read(&self.system, &mut solver, convergence, beta, periods).ok()?;
        }
        self.known.push(Neighbourhood::new(orbit, &mut solver, &self.system).ok()?);
        Some(self.known.len() - 1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::{ForceLaw, Parameters};
    use nalgebra::Complex;

    #[test]
    fn an_orbit_is_known_by_a_derivative_that_the_grid_resolves() {
        let set = ParameterSet { alpha: 1e-4, beta: 2.5e-3, omega: 8.0969, ..Default::default() };
        let parameters = Parameters::new(set).expect("in range");
        let system = ReducedSystem::new(parameters, 2, ForceLaw::Exact).expect("a system");
        // Near the forced motion: on the longest steps it is resolved, and how its neighbours part from it is not.
        let guess = [6e-5, 0.0, -0.041, 0.0, -0.2];
        let mut repertoire = Repertoire::new(&system);
        let mut solver = repertoire.solver.clone();
        solver.find_state(&guess, set.beta, 1).expect("an orbit");
        solver.evaluate_observed(set.beta, 1, |_, _| ()).expect("followed");
        assert!(!solver.was_resolved());
        let coarse = solver.multipliers().expect("multipliers");
        let index = repertoire.find(&guess, 1).expect("an orbit");
        let found = &repertoire.known[index].orbit.multipliers;
        let (expected, forced) = Orbit::from_rest(&system).expect("a forced motion");
        assert!(forced);
        let off = |multipliers: &[Complex<f64>]| {
            let pairs = multipliers.iter().zip(&expected.multipliers);
            pairs.map(|(a, b)| (a - b).norm()).fold(0.0, f64::max)
        };
        assert!(off(found) < 1e-10 && off(&coarse) > 10.0 * off(found), "{} {}", off(found), off(&coarse));
    }
}
