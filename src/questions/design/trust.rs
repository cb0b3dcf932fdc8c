//! How far the model is to be trusted at the present amplitude: the force law's error there, and one quantity over
//! numbers of modes and force laws.

use serde::{Deserialize, Serialize};

use super::materials::lowest_threshold;
use super::{DesignError, Plant};
use crate::dynamics::Motion;
use crate::dynamics::bifurcations::tongue::Window;
use crate::model::force::Exact;
use crate::model::{ForceLaw, MAX_MODES, ModelChoice, ParameterSet, ReducedSystem};
use crate::scenario::Scenario;
use crate::theory::{ContinuousResponse, LinearResponse, Resonance};

/// The force laws compared, from the paper's to the magnets' own.
pub const LAWS: [ForceLaw; 4] =
    [ForceLaw::Quadratic, ForceLaw::Taylor(3), ForceLaw::Taylor(5), ForceLaw::Exact];

/// What is compared.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, nanoserde::SerBin, nanoserde::DeBin)]
#[serde(rename_all = "snake_case")]
pub enum Quantity {
    /// Root mean square of the voltage of the motion reached (V).
    Voltage,
    /// Mean power of the motion reached (W).
    Power,
    /// Largest |tip displacement| of the motion reached (mm).
    Tip,
    /// Lowest beta of a resonance's tongue (dimensionless).
    Threshold(Resonance),
}

/// An entry of the table.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, nanoserde::SerBin, nanoserde::DeBin)]
pub struct TrustEntry {
    /// Number of modes.
    pub modes: usize,
    /// Force law.
    pub law: ForceLaw,
    /// The quantity in its unit; `None` when the motion ended, or there is no tongue within the window.
    pub value: Option<f64>,
    /// Class of the motion reached, where one was asked for: values of different classes do not converge to each other.
    pub motion: Option<Motion>,
}

/// The places of the table, modes by modes.
pub fn places() -> impl Iterator<Item = (usize, ForceLaw)> {
    (1..=MAX_MODES).flat_map(|modes| LAWS.into_iter().map(move |law| (modes, law)))
}

/// One entry: `quantity` of `scenario` with so many modes and this law.
///
/// # Errors
/// [`DesignError`].
pub fn trust_entry(
    scenario: &Scenario,
    modes: usize,
    law: ForceLaw,
    quantity: Quantity,
) -> Result<TrustEntry, DesignError> {
    let mut scenario = scenario.clone();
    scenario.set_modes(modes);
    scenario.model.force = law;
    let plant = Plant::new(&scenario)?;
    let (system, initial) = plant.scenario.validate()?;
    if let Quantity::Threshold(resonance) = quantity {
        let system = plant.in_tongue(resonance)?.system()?;
        let tip = lowest_threshold(&system, resonance, Window::default().limit)?;
        return Ok(TrustEntry { modes, law, value: tip.map(|tip| tip.beta), motion: None });
    }
    let cell = plant.reach(&system, &initial)?.1.reached.cell();
    let value = cell.demand().map(|demand| match quantity {
        Quantity::Power => plant.watts(cell.measures.v_rms),
        Quantity::Tip => plant.units.millimetres(demand.tip.1.max(-demand.tip.0)),
        Quantity::Voltage | Quantity::Threshold(_) => cell.measures.v_rms,
    });
    Ok(TrustEntry { modes, law, value, motion: Some(cell.motion) })
}

/// How far off the voltage of the linear device is because modes are left out: their moment converges only like 1/N.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct MomentError {
    /// Number of modes.
    pub modes: usize,
    /// Amplitude of the voltage over that of the continuous beam, less 1 (dimensionless); `None` where there is none to
    /// compare with, as without coupling.
    pub without: Option<f64>,
    /// The same when the modes left out count in the circuit.
    pub with: Option<f64>,
}

/// The error of `modes` modes at the frequency of `scenario`, the magnets' force taken as linear.
///
/// # Errors
/// [`DesignError`].
pub fn moment_errors(scenario: &Scenario, modes: usize) -> Result<MomentError, DesignError> {
    let plant = Plant::new(scenario)?;
    let chosen = |residual_moment| {
        let model = ModelChoice { modes, residual_moment, ..plant.scenario.model };
        // Relative to the amplitude of the base, which may be 0.
        model.system(ParameterSet { beta: 1e-3, ..plant.scenario.parameters })
    };
    let (without, with) = (chosen(false)?, chosen(true)?);
    let whole = ContinuousResponse::new(&without)?.voltage.norm();
    let error = |system: &ReducedSystem| -> Result<Option<f64>, DesignError> {
        let voltage = LinearResponse::new(system)?.voltage.norm();
        Ok((whole > 0.0).then(|| voltage / whole - 1.0))
    };
    Ok(MomentError { modes, without: error(&without)?, with: error(&with)? })
}

/// How far a force law is off.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct LawError {
    /// Tip displacement (beam lengths).
    pub tip: f64,
    /// R of the law over that of the magnets, less 1 (dimensionless); `None` where the magnets would have touched.
    pub rest: Option<f64>,
    /// The whole restoring force 3 s + c_1 s + R(s) of beam and magnets at the tip, in the same way: how much of it is
    /// wrong.
    pub whole: Option<f64>,
}

/// R(s), what `law` gives beyond its linear part where the tip of `system` is at `tip` (beam lengths from equilibrium), in
/// units of E I / L^2; `None` where the magnets would have touched, which only the exact law knows of (Eq. 16).
pub fn force_beyond_linear(system: &ReducedSystem, law: ForceLaw, tip: f64) -> Option<f64> {
    let force = ReducedSystem { law, ..system.clone() }.rest_force();
    force.contact().is_none_or(|contact| tip > contact).then(|| force.rest(tip))
}

/// How far `law` is off for `system` when its tip is at `tip` (beam lengths from equilibrium).
pub fn law_error(system: &ReducedSystem, law: ForceLaw, tip: f64) -> LawError {
    /// Stiffness of the beam's tip, 3 E I / L^3.
    const BEAM: f64 = 3.0;
    if system.parameters.c0 == 0.0 || tip == 0.0 {
        return LawError { tip, rest: Some(0.0), whole: Some(0.0) };
    }
    let exact = Exact::new(&system.magnet(), &system.equilibrium);
    if exact.contact().is_some_and(|contact| tip <= contact) {
        return LawError { tip, rest: None, whole: None };
    }
    let under = ReducedSystem { law, ..system.clone() };
    let (taken, true_rest) = (under.rest_force().rest(tip), exact.rest(tip));
    let linear = (BEAM + system.c1) * tip;
    LawError {
        tip,
        rest: Some(taken / true_rest - 1.0),
        whole: Some((taken - true_rest) / (linear + true_rest)),
    }
}
