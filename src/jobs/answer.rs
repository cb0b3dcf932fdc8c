//! The answers, as they are written.

use serde::Serialize;

use crate::dynamics::Outcome;
use crate::model::ReducedSystem;
use crate::theory::CoupledModes;

/// Number of Taylor coefficients in a modes answer.
const COEFFICIENTS: u32 = 7;

/// The answer to a request.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Answer {
    /// To a modes request.
    Modes(ModesAnswer),
    /// To a boundary request.
    Boundary {
        /// Lowest unstable beta at each omega; null where there is none.
        beta: Vec<Option<f64>>,
    },
    /// To a simulate request.
    Simulate(SimulateAnswer),
}

/// Equilibrium, coefficients and modes; one entry a mode in the last four lists. All dimensionless.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ModesAnswer {
    /// Displacement of the tip at rest.
    #[serde(rename = "A_e")]
    pub displacement: f64,
    /// Distance of the magnets at rest, d + A_e.
    pub gap: f64,
    /// c_1..c_7.
    pub c: Vec<f64>,
    /// Natural frequencies omega_n.
    pub omega: Vec<f64>,
    /// Participations eta_1n.
    pub eta1: Vec<f64>,
    /// Modal masses eta_2n.
    pub eta2: Vec<f64>,
    /// Couplings theta_n.
    pub theta: Vec<f64>,
    /// Eigenvalues (re, im) of the coupled linear system of beam and circuit.
    pub eigenvalues: Vec<[f64; 2]>,
}

/// A run in time.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SimulateAnswer {
    /// Times of the samples (dimensionless).
    pub t: Vec<f64>,
    /// One row (q_1..q_N, dq_1/dt..dq_N/dt, v) a time.
    pub state: Vec<Vec<f64>>,
    /// "completed", "escaped" or "contact".
    pub outcome: &'static str,
    /// Time at which the run ended.
    pub t_outcome: f64,
    /// Integration steps done.
    pub steps: u64,
}

impl Answer {
    pub(super) fn modes(system: &ReducedSystem, coupled: &CoupledModes) -> Self {
        let modes = &system.modes;
        Self::Modes(ModesAnswer {
            displacement: system.equilibrium.displacement,
            gap: system.equilibrium.gap,
            c: system.taylor_coefficients(COEFFICIENTS),
            omega: modes.iter().map(|mode| mode.omega).collect(),
            eta1: modes.iter().map(|mode| mode.eta1).collect(),
            eta2: modes.iter().map(|mode| mode.eta2).collect(),
            theta: system.theta.clone(),
            eigenvalues: coupled.eigenvalues().iter().map(|value| [value.re, value.im]).collect(),
        })
    }
}

/// The word for an outcome.
pub(super) fn word(outcome: Outcome) -> &'static str {
    match outcome {
        Outcome::Completed => "completed",
        Outcome::Escaped { .. } => "escaped",
        Outcome::Contact { .. } => "contact",
    }
}
