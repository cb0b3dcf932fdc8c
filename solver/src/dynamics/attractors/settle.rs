//! What motion a start leads to, and what its numbers are when it has arrived.
//!
//! 1. The motion is integrated. From time to time Newton's iteration looks for the periodic motion behind the last
//!    stroboscopic states, with the periods that their recurrence suggests (long ones only while the run does not come nearer
//!    to a stable one that is known). A stable one counts as reached when the run lies in its linear neighbourhood
//!    (`super::neighbourhood`); the numbers are then those of the orbit itself, however long the rest of the transient takes.
//!    Near an unstable one the run is leaving at a known rate: it goes on for as long as that takes.
//! 2. What is near no periodic motion is recorded with its tangent vectors. It is quasiperiodic when the weighted Birkhoff
//!    averages and the rotation number of both halves of the record agree, the largest exponent is neither above
//!    nor below zero, and the 0-1 test sees no diffusion; chaotic when the exponent is positive beyond its error, the averages have the error of an average
//!    over chance, the 0-1 test sees diffusion, and the motion has lasted as long as [`Effort::lasting`] says. Where these
//!    witnesses disagree the record is doubled.
//! 3. What is not known when the [`Effort`] is spent is undecided, with the reason and, where it is known, how much longer it would
//!    take.
//!
//! What no finite run can show: a chaotic transient that outlives the effort counts as chaotic, and a periodic motion of
//! more than 64 excitation periods is never found.

use super::effort::Effort;
use super::motion::Reached;
use super::pursuit::{CHUNK, Pursuit};
use super::repertoire::Repertoire;
use super::signature::Signature;
use crate::dynamics::integration::{IntegrationError, Settings};
use crate::model::ReducedSystem;

/// What motion the start of `system` in `initial` (length 2N + 1) at t = 0 leads to.
///
/// # Errors
/// Those of the integrator: a start that is none, or a motion that no steps can follow.
pub fn reach(system: &ReducedSystem, initial: &[f64], effort: Effort) -> Result<Reached, IntegrationError> {
    Settler::new(system).reach(initial, effort)
}

/// Answers for many starts of one system, whose periodic motions it keeps.
pub struct Settler {
    repertoire: Repertoire,
}

impl std::fmt::Debug for Settler {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Settler").field("known", &self.repertoire.known.len()).finish()
    }
}

impl Settler {
    /// For starts of `system`.
    pub fn new(system: &ReducedSystem) -> Self {
        Self { repertoire: Repertoire::new(system) }
    }

    /// For starts of `system`, one like the last: its periodic motions are looked for near those of the last.
    pub fn turn_to(&mut self, system: &ReducedSystem) {
        self.repertoire = self.repertoire.turned_to(system);
    }

    /// What motion the start in `initial` (length 2N + 1) at t = 0 leads to.
    ///
    /// # Errors
    /// Those of the integrator: a start that is none, or a motion that no steps can follow.
    pub fn reach(&mut self, initial: &[f64], effort: Effort) -> Result<Reached, IntegrationError> {
        let repertoire = &mut self.repertoire;
        let mut integrator = repertoire.integrator(initial, Settings { tolerance: effort.tolerance })?;
        let mut pursuit = Pursuit::new(&repertoire.system, effort);
        loop {
            let outcome = integrator.advance(f64::INFINITY, CHUNK, &mut |step| pursuit.see(step))?;
            if (outcome.is_some() || pursuit.is_due())
                && let Some(reached) = pursuit.look(repertoire, &integrator, outcome)
            {
                return Ok(reached);
            }
        }
    }

    /// The stable periodic motions met so far.
    pub fn stable_orbits(&self) -> Vec<Signature> {
        self.repertoire.stable_orbits()
    }
}
