//! The forced motion, the one that grows out of rest as beta grows from 0, at a system's own excitation: its orbit, its
//! multipliers, and the beta from which it is unstable.

use super::boundary::{Asked, CriticalExcitation, ForcedSurvey};
use crate::dynamics::orbits::{Orbit, OrbitError, OrbitSolver};
use crate::model::ReducedSystem;

/// The forced motion of a system.
#[derive(Debug, Clone, PartialEq)]
pub struct ForcedMotion {
    /// Where it first loses its stability on the way to the system's beta, or ends.
    pub critical: CriticalExcitation,
    /// The orbit at the system's beta; `None` when it cannot be followed there.
    pub orbit: Option<Orbit>,
}

impl ForcedMotion {
    /// Follows the forced motion of `system` from rest to its own beta, past a loss of stability.
    ///
    /// Where the branch turns back on the way, it ends (see [`CriticalExcitation::Ends`]).
    ///
    /// # Errors
    /// As [`super::critical_excitation`].
    pub fn of(system: &ReducedSystem) -> Result<Self, OrbitError> {
        let beta = system.parameters.beta;
        let mut solver = OrbitSolver::new(system);
        let survey = ForcedSurvey::of(&mut solver, beta, Asked::Any)?;
        let critical = survey.critical();
        let there = match critical {
            CriticalExcitation::Ends { .. } => None,
            _ => survey.last.march_to(&mut solver, beta)?,
        };
        let orbit = there.map(|there| Orbit::read_at(system, &mut solver, &there.state)).transpose()?;
        Ok(Self { critical, orbit })
    }
}
