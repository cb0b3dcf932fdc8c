//! The forced motion, the one that grows out of rest as beta grows from 0, at a system's own excitation: its orbit, its
//! multipliers, and the beta from which it is unstable.

use super::boundary::{CriticalExcitation, search};
use super::newton::OrbitSolver;
use super::{Orbit, OrbitError};
use crate::model::ReducedSystem;

/// The march beyond the loss of stability gives up below this fraction of the whole.
const SHORTEST: f64 = 1e-5;

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
        let (critical, mut here) = search(&mut solver, beta, None)?;
        if matches!(critical, CriticalExcitation::Ends { .. }) {
            return Ok(Self { critical, orbit: None });
        }
        let (mut step, shortest) = (beta - here.beta, SHORTEST * beta);
        while here.beta < beta {
            match here.move_to(&mut solver, (here.beta + step).min(beta)) {
                Ok(next) => here = next,
                Err(_) if step > shortest => step *= 0.5,
                Err(_) => return Ok(Self { critical, orbit: None }),
            }
        }
        let orbit = Orbit::find(system, Some(&here.state), 1)?;
        Ok(Self { critical, orbit: Some(orbit) })
    }
}
