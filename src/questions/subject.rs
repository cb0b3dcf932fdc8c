//! What a request says of the device that it is about, in the ten numbers or in SI units, of its model and of its start: the
//! same for every task.

use serde::Deserialize;
use serde_json::{Map, Value};

use super::error::{RequestError, read};
use crate::model::{Device, ElectricalScaling, ModelError, ParameterSet};
use crate::scenario::{ModelChoice, Scenario};

/// The device of a request.
#[derive(Debug, Clone, Copy, PartialEq, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
struct Described {
    /// The ten numbers. Absent, they are those of `device`, or else the paper's.
    parameters: Option<ParameterSet>,
    /// The device in SI units, missing dimensions as in Table 1. Beside `parameters` it says only what they leave open.
    device: Option<Device>,
    /// How its circuit is scaled.
    scaling: ElectricalScaling,
    /// Peak of the base's acceleration (g, of 9.80665 m/s^2) at the device's frequency, instead of the amplitude of its
    /// motion.
    acceleration: Option<f64>,
}

/// Names of the fields of [`Described`], and of what else every task takes.
const NAMES: [&str; 4] = ["parameters", "device", "scaling", "acceleration"];
const MODEL: &str = "model";
/// What an acceleration in an answer counts in, in words.
pub(super) const ACCELERATION_UNIT: &str = "peak g of 9.80665 m/s^2";
/// Accelerations that can be asked for (g).
const ACCELERATIONS: (f64, f64) = (0.0, 1e6);

/// How the device is looked at.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(default, deny_unknown_fields)]
struct Looked {
    /// Modes and force law.
    model: ModelChoice,
    /// State at time 0, length 2N + 1; rest when absent.
    initial: Option<Vec<f64>>,
    /// Duration (dimensionless). A start is followed until its motion is known, however long that takes.
    t_end: f64,
}

impl Default for Looked {
    fn default() -> Self {
        let Scenario { model, initial, t_end, .. } = Scenario::default();
        Self { model, initial, t_end }
    }
}

/// Names of the fields of a request of a task that takes these of a scenario.
pub(super) fn names(takes: &[&'static str]) -> Vec<&'static str> {
    NAMES.iter().chain([&MODEL]).chain(takes).copied().collect()
}

/// Takes the scenario out of the fields of a request, as far as a task has these fields.
pub(super) fn take(fields: &mut Map<String, Value>, takes: &[&str]) -> Result<Scenario, RequestError> {
    let mut part = |names: &mut dyn Iterator<Item = &&str>| {
        Value::Object(names.filter_map(|name| fields.remove_entry(*name)).collect())
    };
    let described: Described = read(&part(&mut NAMES.iter()))?;
    let Looked { model, initial, t_end } = read(&part(&mut [MODEL].iter().chain(takes)))?;
    let mut scenario = Scenario { model, initial, t_end, ..Scenario::default() };
    described.put_into(&mut scenario)?;
    Ok(scenario)
}

/// The fields of a request about `scenario`.
pub(super) fn written(scenario: &Scenario, takes: &[&str]) -> Map<String, Value> {
    let Ok(Value::Object(mut fields)) = serde_json::to_value(scenario) else { return Map::new() };
    let wanted = names(&[]);
    fields.retain(|name, _| wanted.contains(&name.as_str()) || takes.contains(&name.as_str()));
    fields
}

impl Described {
    /// Puts the device into `scenario`, whose model, start and duration stay.
    ///
    /// # Errors
    /// [`ModelError`] naming what is out of range.
    fn put_into(&self, scenario: &mut Scenario) -> Result<(), ModelError> {
        scenario.scaling = self.scaling;
        if let Some(device) = &self.device {
            device.check()?;
        }
        match (self.parameters, self.device) {
            (Some(parameters), device) => (scenario.parameters, scenario.device) = (parameters, device),
            (None, Some(device)) => scenario.set_device(device, self.scaling)?,
            (None, None) => {}
        }
        if let Some(acceleration) = self.acceleration {
            ModelError::check("acceleration", acceleration, ACCELERATIONS, " g")?;
            let omega = ModelError::check("omega", scenario.parameters.omega, (1e-9, 1e9), "")?;
            scenario.parameters.beta = scenario.units().beta_of(acceleration, omega);
        }
        Ok(())
    }
}
