//! Modes requests: equilibrium, Taylor coefficients, modes and eigenvalues of a device.

use serde::{Deserialize, Serialize};

use super::error::RequestError;
use super::question::Question;
use crate::model::layers::Laminate;
use crate::scenario::Scenario;
use crate::scheduler::Budget;
use crate::theory::spectrum;

/// Number of Taylor coefficients in an answer.
const COEFFICIENTS: u32 = 7;

/// The modes of the device and truncation asked about; there is nothing more to say.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Modes {}

/// Equilibrium, coefficients and modes; one entry a mode in the lists from `omega` to `theta`. All dimensionless but
/// `device`.
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
    /// Damping ratios zeta_n of each mode alone.
    pub damping_ratio: Vec<f64>,
    /// Couplings theta_n.
    pub theta: Vec<f64>,
    /// Capacitance of the circuit's equation: c, and that of the modes left out where the model counts them.
    pub capacitance: f64,
    /// Eigenvalues (re, im) of the coupled linear system of beam and circuit.
    pub eigenvalues: Vec<[f64; 2]>,
    /// What the layers of the device decide, or else was given for it, in SI units; absent where the request is about
    /// numbers.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub device: Option<Laminate>,
}

impl Question for Modes {
    const TASK: &'static str = "modes";
    type Answer = ModesAnswer;

    fn answer(&self, scenario: Scenario, _: &Budget<'_>) -> Result<ModesAnswer, RequestError> {
        let system = scenario.model.system(scenario.parameters)?;
        let eigenvalues = spectrum::eigenvalues(&system)?;
        let modes = &system.modes;
        Ok(ModesAnswer {
            displacement: system.equilibrium.displacement,
            gap: system.equilibrium.gap,
            c: system.taylor_coefficients(COEFFICIENTS),
            omega: modes.iter().map(|mode| mode.omega).collect(),
            eta1: modes.iter().map(|mode| mode.eta1).collect(),
            eta2: modes.iter().map(|mode| mode.eta2).collect(),
            damping_ratio: system.damping_ratios(),
            theta: system.theta.clone(),
            capacitance: system.capacitance,
            eigenvalues: eigenvalues.iter().map(|value| [value.re, value.im]).collect(),
            device: scenario.laminate()?,
        })
    }
}
