//! What a request says of the device that it is about, in the ten numbers or in SI units; the same for every task.

use serde::Deserialize;
use serde_json::{Map, Value};

use crate::jobs::RequestError;
use crate::jobs::request::read;
use crate::model::{Device, ElectricalScaling, ModelError, ParameterSet};
use crate::scenario::Scenario;

/// The device of a request.
#[derive(Debug, Clone, Copy, PartialEq, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Described {
    /// The ten numbers. Absent, they are those of `device`, or else the paper's.
    pub parameters: Option<ParameterSet>,
    /// The device in SI units, missing dimensions as in Table 1. Beside `parameters` it says only what they leave open.
    pub device: Option<Device>,
    /// How its circuit is scaled.
    pub scaling: ElectricalScaling,
    /// Peak of the base's acceleration (g, of 9.80665 m/s^2) at the device's frequency, instead of the amplitude of its
    /// motion.
    pub acceleration: Option<f64>,
}

/// Names of the fields of [`Described`].
const NAMES: [&str; 4] = ["parameters", "device", "scaling", "acceleration"];
/// What an acceleration in an answer counts in, in words.
pub(super) const ACCELERATION_UNIT: &str = "peak g of 9.80665 m/s^2";
/// Accelerations that can be asked for (g).
const ACCELERATIONS: (f64, f64) = (0.0, 1e6);

impl Described {
    /// Takes its fields out of those of a request.
    ///
    /// # Errors
    /// [`RequestError`] for the first of them that is wrong.
    pub(in crate::jobs) fn take(fields: &mut Map<String, Value>) -> Result<Self, RequestError> {
        let own = NAMES.iter().filter_map(|name| fields.remove_entry(*name));
        read(Value::Object(own.collect()))
    }

    /// Puts the device into `scenario`, whose model, start and duration stay.
    ///
    /// # Errors
    /// [`ModelError`] naming what is out of range.
    pub(in crate::jobs) fn put_into(&self, scenario: &mut Scenario) -> Result<(), ModelError> {
        scenario.scaling = self.scaling;
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

    /// Its ten numbers: all that a task without SI units needs to know of it.
    ///
    /// # Errors
    /// [`ModelError`] naming what is out of range.
    pub(in crate::jobs) fn numbers(&self) -> Result<ParameterSet, ModelError> {
        if let Some(device) = &self.device {
            device.check()?;
        }
        let mut scenario = Scenario::default();
        self.put_into(&mut scenario)?;
        Ok(scenario.parameters)
    }
}
