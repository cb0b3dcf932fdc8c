//! Modes requests: equilibrium, Taylor coefficients, modes and eigenvalues of a device.

use serde::{Deserialize, Serialize};

use super::Answer;
use crate::jobs::RequestError;
use crate::model::ParameterSet;
use crate::scenario::ModelChoice;
use crate::theory::spectrum;

/// Number of Taylor coefficients in an answer.
const COEFFICIENTS: u32 = 7;

/// The device and truncation asked about; every other request has the same two fields.
#[derive(Debug, Clone, Copy, PartialEq, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct ModesRequest {
    /// The ten numbers; missing ones are the paper's.
    pub parameters: ParameterSet,
    /// Modes and force law.
    pub model: ModelChoice,
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
    /// Capacitance of the circuit's equation: c, and that of the modes left out where the model counts them.
    pub capacitance: f64,
    /// Eigenvalues (re, im) of the coupled linear system of beam and circuit.
    pub eigenvalues: Vec<[f64; 2]>,
}

impl ModesRequest {
    /// Computes the answer.
    ///
    /// # Errors
    /// [`RequestError`] when a number is out of range or describes no device.
    pub fn answer(&self) -> Result<Answer, RequestError> {
        let system = self.model.system(self.parameters)?;
        let eigenvalues = spectrum::eigenvalues(&system)?;
        let modes = &system.modes;
        Ok(Answer::Modes(ModesAnswer {
            displacement: system.equilibrium.displacement,
            gap: system.equilibrium.gap,
            c: system.taylor_coefficients(COEFFICIENTS),
            omega: modes.iter().map(|mode| mode.omega).collect(),
            eta1: modes.iter().map(|mode| mode.eta1).collect(),
            eta2: modes.iter().map(|mode| mode.eta2).collect(),
            theta: system.theta.clone(),
            capacitance: system.capacitance,
            eigenvalues: eigenvalues.iter().map(|value| [value.re, value.im]).collect(),
        }))
    }
}
