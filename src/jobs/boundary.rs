//! Boundary requests.

use serde::Deserialize;

use super::RequestError;
use super::answer::Answer;
use super::request::BoundaryRequest;
use crate::theory::{CoupledModes, Published};

/// The theories that give a boundary.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Theory {
    /// Eqs. (57), (72), (81) as printed.
    Published,
    /// The coupled-mode boundary, which keeps the circuit.
    Coupled,
}

pub(super) fn answer(request: &BoundaryRequest) -> Result<Answer, RequestError> {
    let system = request.system()?;
    let resonance = request.resonance;
    let omegas = request.omega.iter();
    let beta = match request.theory {
        Theory::Published => {
            let theory = Published::new(&system)?;
            omegas.map(|omega| theory.boundary(resonance, *omega)).collect()
        }
        Theory::Coupled => {
            let theory = CoupledModes::new(&system)?;
            omegas.map(|omega| theory.boundary(resonance, *omega)).collect()
        }
    };
    Ok(Answer::Boundary { beta })
}
