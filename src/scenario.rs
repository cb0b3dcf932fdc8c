//! Everything a view depends on, versioned: what is stored, shared and undone.

use serde::{Deserialize, Serialize};

use crate::model::damping::Damping;
use crate::model::layers::Laminate;
use crate::model::{
    Device, ElectricalScaling, Layers, MAX_MODES, ModelError, Parameter, ParameterSet, Parameters,
    ReducedSystem, Units, state_dimension,
};

pub use crate::model::ModelChoice;

/// Version written by this program; older ones are read.
pub const VERSION: u32 = 2;

/// Smallest and largest end time of a run (dimensionless).
pub const END_TIME: (f64, f64) = (1.0, 5000.0);

/// What a page shows: numbers, model, start and duration.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, nanoserde::SerBin, nanoserde::DeBin)]
#[serde(default, deny_unknown_fields)]
pub struct Scenario {
    /// Version of this format.
    pub version: u32,
    /// The dimensionless numbers.
    pub parameters: ParameterSet,
    /// Modes and force law.
    pub model: ModelChoice,
    /// State at time 0 (length 2N + 1), rest when absent.
    pub initial: Option<Vec<f64>>,
    /// Duration of the run (dimensionless).
    pub t_end: f64,
    /// What the numbers leave open of the device in SI units (see [`Device::from_parameters`]); its other entries
    /// play no role. The paper's device when absent. Nothing dimensionless depends on it. Since version 2.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub device: Option<Device>,
    /// How the circuit of that device is scaled. Since version 2.
    #[serde(skip_serializing_if = "is_as_printed")]
    pub scaling: ElectricalScaling,
}

/// What of a scenario plays no role in an answer.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Forgotten {
    /// Where it starts.
    Start,
    /// How long it is shown.
    Duration,
    /// One of the numbers, which the question varies; this value stands for all.
    Number(Parameter, f64),
    /// Damping and dielectric loss, which come with a ceramic.
    Ceramic,
    /// The force law, and where there is no start the number of modes.
    Model,
}

fn is_as_printed(scaling: &ElectricalScaling) -> bool {
    *scaling == ElectricalScaling::AsPrinted
}

impl Default for Scenario {
    fn default() -> Self {
        Self {
            version: VERSION,
            parameters: ParameterSet::default(),
            model: ModelChoice::default(),
            initial: None,
            t_end: 600.0,
            device: None,
            scaling: ElectricalScaling::default(),
        }
    }
}

/// Checks a number of things.
///
/// # Errors
/// [`ModelError::Count`].
pub fn counted(
    field: &'static str,
    value: usize,
    (minimum, maximum): (usize, usize),
) -> Result<(), ModelError> {
    if (minimum..=maximum).contains(&value) {
        return Ok(());
    }
    Err(ModelError::Count { field, value, minimum, maximum })
}

impl Scenario {
    /// The device in SI units: the numbers are what is computed from, so that it always agrees with them.
    ///
    /// # Errors
    /// As [`Device::from_parameters`].
    pub fn device(&self) -> Result<Device, ModelError> {
        Device::from_parameters(&self.base(), &self.parameters, self.scaling)
    }

    /// What layers decide of the device, where the scenario is about one in SI units.
    ///
    /// # Errors
    /// As [`Self::device`].
    pub fn laminate(&self) -> Result<Option<Laminate>, ModelError> {
        self.device.map(|_| self.device().map(|device| device.laminate())).transpose()
    }

    /// Gives the first modes these damping ratios: with one the material takes it all, two set the air's part too.
    ///
    /// # Errors
    /// As [`ReducedSystem::damping_of`]; nothing is changed then.
    pub fn damp(&mut self, ratios: &[f64]) -> Result<(), ModelError> {
        let modes = self.model.modes.max(2);
        let system = ModelChoice { modes, ..self.model }.system(self.parameters)?;
        let Damping { alpha, air } = system.damping_of(ratios)?;
        self.parameters = *Parameters::new(ParameterSet { alpha, air, ..self.parameters })?;
        Ok(())
    }

    /// Makes `device` the scenario's: its dimensionless numbers under `scaling` become those of the scenario. Its layers, if it
    /// has any, decide what is theirs, the scaling too.
    ///
    /// # Errors
    /// [`ModelError`] naming what is out of range, in SI units or dimensionless; nothing is changed then.
    pub fn set_device(&mut self, device: Device, scaling: ElectricalScaling) -> Result<(), ModelError> {
        let (device, scaling) = match device.layers {
            Some(layers) => (device.with_layers(layers), Layers::SCALING),
            None => (device, scaling),
        };
        self.parameters = *Parameters::new(device.renumbered(self.parameters, scaling)?)?;
        (self.device, self.scaling, self.version) = (Some(device), scaling, VERSION);
        Ok(())
    }

    /// Changes what the numbers leave open, and the scaling; the numbers are kept, and the rest of the device follows
    /// them.
    ///
    /// # Errors
    /// [`ModelError`] naming what is out of range; nothing is changed then.
    pub fn set_base(&mut self, base: Device, scaling: ElectricalScaling) -> Result<(), ModelError> {
        base.check()?;
        Device::from_parameters(&base, &self.parameters, scaling)?;
        (self.device, self.scaling, self.version) = (Some(base), scaling, VERSION);
        Ok(())
    }

    /// The same without what plays no role in an answer: of two scenarios that compute the same both are then equal, and
    /// ask the same question. The device keeps only what the numbers leave open.
    #[must_use]
    pub fn forgetting(&self, forgotten: &[Forgotten]) -> Self {
        let usual = Self::default();
        let mut kept = self.clone();
        for what in forgotten {
            match *what {
                Forgotten::Start => kept.initial = None,
                Forgotten::Duration => kept.t_end = usual.t_end,
                Forgotten::Number(parameter, value) => *kept.parameters.get_mut(parameter) = value,
                Forgotten::Ceramic => {
                    kept.parameters.alpha = 0.0;
                    let base = kept.device.get_or_insert_default();
                    (base.ceramic, base.loss_tangent, base.viscosity) = (None, 0.0, 0.0);
                }
                Forgotten::Model => {
                    kept.model.force = usual.model.force;
                    // A start belongs to its number of modes.
                    if kept.initial.is_none() {
                        kept.model.modes = usual.model.modes;
                    }
                }
            }
        }
        kept.device = kept.device.map(|device| device.left_open());
        kept
    }

    /// The SI units in which the dimensionless quantities count.
    pub fn units(&self) -> Units {
        Units::of(&self.base(), self.scaling)
    }

    /// The device that says what the numbers leave open.
    pub fn base(&self) -> Device {
        self.device.unwrap_or_default()
    }

    /// Checks everything, and gives the system and the state to start from.
    ///
    /// # Errors
    /// [`ModelError`], naming what is out of range.
    pub fn validate(&self) -> Result<(ReducedSystem, Vec<f64>), ModelError> {
        if self.version > VERSION {
            let (minimum, value) = (1, self.version as usize);
            return Err(ModelError::Count { field: "version", value, minimum, maximum: VERSION as usize });
        }
        ModelError::check("t_end", self.t_end, END_TIME, "")?;
        if let Some(device) = &self.device {
            device.check()?;
        }
        let system = self.model.system(self.parameters)?;
        let dimension = system.dimension();
        let initial = self.initial.clone().unwrap_or_else(|| vec![0.0; dimension]);
        if initial.len() != dimension {
            return Err(ModelError::StateLength { given: initial.len(), needed: dimension });
        }
        for value in &initial {
            ModelError::check("initial", *value, (-1e6, 1e6), "")?;
        }
        Ok((system, initial))
    }

    /// Changes the number of modes, keeping the parts of the initial state that both truncations have.
    pub fn set_modes(&mut self, modes: usize) {
        let modes = modes.clamp(1, MAX_MODES);
        if let Some(initial) = &mut self.initial {
            *initial = fit_state(initial, modes);
        }
        self.model.modes = modes;
    }
}

/// A state of another number of modes (length 2M + 1) for `modes` of them (length 2N + 1): what both have is kept.
pub fn fit_state(state: &[f64], modes: usize) -> Vec<f64> {
    let before = state.len() / 2;
    let mut fitted = vec![0.0; state_dimension(modes)];
    let common = modes.min(before);
    fitted[..common].copy_from_slice(&state[..common]);
    fitted[modes..modes + common].copy_from_slice(&state[before..before + common]);
    fitted[2 * modes] = state[2 * before];
    fitted
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn changing_the_number_of_modes_keeps_what_both_have() {
        let initial = Some(vec![1.0, 2.0, 3.0, 4.0, 5.0]);
        let mut scenario = Scenario { initial, ..Default::default() };
        scenario.set_modes(3);
        assert_eq!(scenario.initial, Some(vec![1.0, 2.0, 0.0, 3.0, 4.0, 0.0, 5.0]));
        scenario.set_modes(1);
        assert_eq!(scenario.initial, Some(vec![1.0, 3.0, 5.0]));
        assert!(scenario.validate().is_ok());
    }

    #[test]
    fn a_scenario_round_trips_through_json() -> Result<(), serde_json::Error> {
        let model = ModelChoice { modes: 4, force: crate::model::ForceLaw::Taylor(5), residual_moment: true };
        let scenario = Scenario { model, initial: Some(vec![0.1; 9]), ..Default::default() };
        assert_eq!(serde_json::from_str::<Scenario>(&serde_json::to_string(&scenario)?)?, scenario);
        Ok(())
    }

    #[test]
    fn a_stored_state_of_version_1_loads_and_one_without_a_device_is_stored_without() {
        let old = r#"{"version":1,"parameters":{"beta":0.01},"model":{"modes":3},"t_end":100.0}"#;
        let scenario: Scenario = serde_json::from_str(old).expect("an old state");
        assert!(scenario.validate().is_ok() && scenario.device.is_none() && scenario.parameters.beta == 0.01);
        let text = serde_json::to_string(&scenario).expect("plain data");
        assert!(!text.contains("device") && !text.contains("scaling"), "{text}");
        assert!(Scenario { version: VERSION + 1, ..Default::default() }.validate().is_err());
    }

    #[test]
    fn device_and_numbers_agree_whichever_is_changed() -> Result<(), ModelError> {
        let mut scenario = Scenario::default();
        let mut device = Device { beam_length: 0.3, resistance: 1e5, ..scenario.device()? };
        device = device.with_acceleration(0.3);
        scenario.set_device(device, ElectricalScaling::Consistent)?;
        assert!((scenario.device()?.acceleration() / 0.3 - 1.0).abs() < 1e-12);
        assert!((scenario.device()?.resistance / 1e5 - 1.0).abs() < 1e-12);
        // The numbers move the device ...
        scenario.parameters.omega *= 2.0;
        assert!((scenario.device()?.frequency / (2.0 * device.frequency) - 1.0).abs() < 1e-12);
        let units = scenario.units();
        let hertz = units.hertz(scenario.parameters.omega);
        assert!((hertz / scenario.device()?.frequency - 1.0).abs() < 1e-12);
        // ... and kappa v^2 is V^2/R in watts.
        let watts = units.watts(scenario.parameters.kappa * 25.0);
        assert!((watts / (25.0 / 1e5) - 1.0).abs() < 1e-12);
        // Another base keeps the numbers, and so moves the device.
        let numbers = scenario.parameters;
        let longer = Device { beam_length: 0.6, ..scenario.base() };
        scenario.set_base(longer, ElectricalScaling::Consistent)?;
        assert_eq!(scenario.parameters, numbers);
        assert!((scenario.device()?.base_amplitude / (0.6 * numbers.beta) - 1.0).abs() < 1e-12);
        // What is out of range changes nothing.
        let before = scenario.clone();
        let wrong = Device { beam_mass: -1.0, ..device };
        assert!(scenario.set_device(wrong, ElectricalScaling::AsPrinted).is_err());
        assert_eq!(scenario, before);
        let text = serde_json::to_string(&scenario).expect("plain data");
        let back: Scenario = serde_json::from_str(&text).expect("the same");
        assert_eq!((&back, back.version), (&scenario, VERSION));
        Ok(())
    }
}
