//! What a request says of the device that it is about, in the ten numbers or in SI units, of its model and of its start: the
//! same for every task.

use serde::Deserialize;
use serde_json::{Map, Value};

use super::error::{RequestError, read};
use crate::model::base_motion::ACCELERATIONS;
use crate::model::{Device, ElectricalScaling, Layers, ModelError, ParameterSet};
use crate::scenario::{ModelChoice, Scenario};
use harvester_solver::number::six_digits;

/// The device of a request.
#[derive(Debug, Clone, Copy, PartialEq, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
struct Described {
    /// The ten numbers. Absent, they are those of `device`, or else the paper's.
    parameters: Option<ParameterSet>,
    /// The device in SI units, missing dimensions as in Table 1. Beside `parameters` it says only what they leave open.
    device: Option<Device>,
    /// How its circuit is scaled; as the paper prints it when absent, consistently where the device has layers.
    scaling: Option<ElectricalScaling>,
    /// Peak of the base's acceleration (g, of 9.80665 m/s^2) at the device's frequency, instead of the amplitude of its
    /// motion.
    acceleration: Option<f64>,
}

/// Names of the fields of [`Described`], and of what else every task takes.
const NAMES: [&str; 4] = ["parameters", "device", "scaling", "acceleration"];
const MODEL: &str = "model";
/// What an acceleration in an answer counts in, in words.
pub(super) const ACCELERATION_UNIT: &str = "peak g of 9.80665 m/s^2";
/// Relative difference up to which two values of a dimension are the same.
const SAME: f64 = 1e-6;
/// Quality factors that a mode can be given.
const QUALITY: (f64, f64) = (0.5, 1e9);

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
    let mut described = part(&mut NAMES.iter());
    let ratios = damping_ratios(&mut described)?;
    let layered = layered(&described)?;
    // What the ratios decide must not be refused before they do.
    let undamped = |device| Device { viscosity: 0.0, air_damping: 0.0, ..device };
    let device = if ratios.is_some() { layered.map(undamped) } else { layered };
    let described = Described { device, ..read(&described)? };
    let Looked { model, initial, t_end } = read(&part(&mut [MODEL].iter().chain(takes)))?;
    let mut scenario = Scenario { model, initial, t_end, ..Scenario::default() };
    described.put_into(&mut scenario)?;
    if let Some(ratios) = ratios {
        scenario.damp(&ratios)?;
    }
    Ok(scenario)
}

/// Takes the damping ratios of the first modes out of a request's device; `None` where none are given.
///
/// # Errors
/// [`RequestError`] naming what is no ratio, or what is given beside them and says the same.
fn damping_ratios(described: &mut Value) -> Result<Option<Vec<f64>>, RequestError> {
    const NAMES: [&str; 2] = ["damping_ratio", "quality_factor"];
    let refused = |name: &str, problem: &str| {
        Err(RequestError::Field { field: format!("device.{name}"), problem: problem.to_owned() })
    };
    let Some(Value::Object(device)) = described.get_mut("device") else { return Ok(None) };
    let mut given = NAMES.into_iter().filter_map(|name| Some((name, device.remove(name)?)));
    let (Some((name, value)), more) = (given.next(), given.next()) else { return Ok(None) };
    if let Some((other, _)) = more {
        return refused(other, "damping_ratio is given: leave one of the two out");
    }
    let beside = |of: &Map<String, Value>, names: [&'static str; 2]| {
        names.into_iter().find(|name| of.get(*name).is_some_and(|value| !value.is_null()))
    };
    if let Some(other) = beside(device, ["viscosity", "air_damping"]) {
        return refused(other, "the damping of the modes decides it: leave one of the two out");
    }
    let parameters = described.get("parameters").and_then(Value::as_object);
    if let Some(other) = parameters.and_then(|parameters| beside(parameters, ["alpha", "air"])) {
        return refused(name, &format!("parameters.{other} is given: leave one of the two out"));
    }
    let numbers: Vec<f64> = match &value {
        Value::Number(_) => vec![read(&value).map_err(|error: RequestError| error.of(name))?],
        _ => read(&value).map_err(|error: RequestError| error.of(&format!("device.{name}")))?,
    };
    if name == "damping_ratio" {
        return Ok(Some(numbers));
    }
    for factor in &numbers {
        ModelError::check("quality_factor", *factor, QUALITY, "")?;
    }
    Ok(Some(numbers.into_iter().map(|factor| 0.5 / factor).collect()))
}

/// The device of a request with what its layers decide.
///
/// # Errors
/// [`RequestError`] naming what is said twice: a dimension that the layers decide otherwise, or the scaling.
fn layered(described: &Value) -> Result<Option<Device>, RequestError> {
    let Some(given) = described.get("device").filter(|device| device.is_object()) else { return Ok(None) };
    let Described { device: Some(device), scaling, .. } = read(described)? else { return Ok(None) };
    let Some(layers) = device.layers else { return Ok(Some(device)) };
    let field = |name: &str, problem: String| Err(RequestError::Field { field: name.to_owned(), problem });
    if scaling.is_some_and(|scaling| scaling != Layers::SCALING) {
        return field(
            "scaling",
            "layers give a coupling in N m/V: leave it out, or write \"consistent\"".to_owned(),
        );
    }
    layers.check()?;
    let device = device.with_layers(layers);
    for dimension in Layers::DECIDED {
        let name = dimension.field();
        let (value, decided) = (given.get(name).and_then(Value::as_f64), device.get(dimension));
        if let Some(value) = value.filter(|value| (value - decided).abs() > SAME * decided) {
            let (value, decided) = (six_digits(value), six_digits(decided));
            return field(
                &format!("device.{name}"),
                format!("{value} is given, but the layers give {decided}: leave one of the two out"),
            );
        }
    }
    Ok(Some(device))
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
        let layered = self.device.is_some_and(|device| device.layers.is_some());
        let usual = if layered { Layers::SCALING } else { ElectricalScaling::default() };
        let scaling = self.scaling.unwrap_or(usual);
        scenario.scaling = scaling;
        if let Some(device) = &self.device {
            device.check()?;
        }
        match (self.parameters, self.device) {
            (Some(parameters), device) => (scenario.parameters, scenario.device) = (parameters, device),
            (None, Some(device)) => scenario.set_device(device, scaling)?,
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

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    fn unimorph() -> Value {
        json!({
            "arrangement": "unimorph", "width": 0.02,
            "substrate": {"thickness": 5e-4, "youngs_modulus": 100e9, "density": 7165},
            "ceramic": {"thickness": 4e-4, "youngs_modulus": 66e9, "density": 7800, "d31": -190e-12,
                "permittivity": 15.93e-9},
        })
    }

    fn taken(fields: Value) -> Result<Scenario, RequestError> {
        let Value::Object(mut fields) = fields else { panic!("no object") };
        take(&mut fields, &[])
    }

    #[test]
    fn layers_decide_dimensions_under_the_consistent_scaling() {
        let scenario =
            taken(json!({"device": {"layers": unimorph(), "beam_length": 0.1}})).expect("a device");
        assert_eq!(scenario.scaling, ElectricalScaling::Consistent);
        let device = scenario.device().expect("the same");
        assert!(device.layers.is_some() && (device.bending_stiffness() / 0.0978472 - 1.0).abs() < 1e-5);
        assert!((device.coupling / 7.3861e-5 - 1.0).abs() < 1e-5 && device.ceramic_thickness == 4e-4);
        // What is written of it is read as the same, and so is what an answer says of the device.
        assert_eq!(taken(Value::Object(written(&scenario, &[]))).expect("the same"), scenario);
        let fed_back = json!({"device": serde_json::to_value(device).expect("plain data")});
        let again = taken(fed_back).expect("the same");
        assert!((again.parameters.theta / scenario.parameters.theta - 1.0).abs() < 1e-12);
    }

    #[test]
    fn measured_damping_sets_material_and_air() {
        let damped = |device: Value| taken(json!({"device": device}));
        let ratios =
            |scenario: &Scenario| scenario.model.system(scenario.parameters).map(|s| s.damping_ratios());
        let two = damped(json!({"damping_ratio": [0.01, 0.012], "tip_mass": 0.001})).expect("possible");
        let found = ratios(&two).expect("a device");
        assert!((found[0] / 0.01 - 1.0).abs() < 1e-10 && (found[1] / 0.012 - 1.0).abs() < 1e-10, "{found:?}");
        assert!(two.parameters.air > 0.0 && two.device().expect("a device").air_damping > 0.0);
        let factors =
            damped(json!({"quality_factor": [50.0, 1.0 / 0.024], "tip_mass": 0.001})).expect("possible");
        assert!((factors.parameters.alpha / two.parameters.alpha - 1.0).abs() < 1e-12);
        let one = damped(json!({"damping_ratio": 0.01})).expect("possible");
        assert!((ratios(&one).expect("a device")[0] / 0.01 - 1.0).abs() < 1e-12 && one.parameters.air == 0.0);
        // The usual viscosity, of a long soft beam, would be too much for a short one: the ratio replaces it.
        let short = json!({"beam_length": 0.02, "beam_mass": 0.001, "tip_mass": 0.0001, "youngs_modulus": 7e10,
            "second_moment": 2e-13, "flux_density": 0, "frequency": 300, "resistance": 1e5,
            "damping_ratio": [0.01]});
        let short = taken(json!({"device": short, "scaling": "consistent"})).expect("possible");
        let first = short.model.system(short.parameters).expect("a device").modes[0].omega;
        assert!((short.parameters.alpha / (0.02 / first) - 1.0).abs() < 1e-12, "{}", short.parameters.alpha);
        let wrong = |fields: Value| taken(fields).expect_err("refused").to_string();
        let device = json!({"damping_ratio": [0.01, 0.001], "viscosity": 1e6});
        assert!(wrong(json!({"device": device})).starts_with("device.viscosity: the damping of the modes"));
        let impossible = wrong(json!({"device": {"damping_ratio": [0.01, 0.001]}}));
        assert!(impossible.starts_with("a damping ratio of 0.001 in mode 2 is not possible"), "{impossible}");
        assert!(wrong(json!({"device": {"damping_ratio": "dry"}})).starts_with("device.damping_ratio: "));
        assert!(
            wrong(json!({"device": {"quality_factor": [0]}}))
                .starts_with("quality_factor = 0 is out of range")
        );
    }

    #[test]
    fn what_is_said_twice_of_a_layered_device_is_named() {
        let wrong = |fields: Value| taken(fields).expect_err("refused").to_string();
        let device = json!({"layers": unimorph(), "beam_length": 0.1, "coupling": 1e-5});
        assert_eq!(
            wrong(json!({"device": device})),
            "device.coupling: 1e-5 is given, but the layers give 7.38613e-5: leave one of the two out"
        );
        let device = json!({"layers": unimorph(), "beam_length": 0.1});
        assert!(
            wrong(json!({"device": device, "scaling": "as_printed"})).starts_with("scaling: layers give")
        );
        let mut thin = unimorph();
        thin["ceramic"]["thickness"] = json!(-1.0);
        assert!(
            wrong(json!({"device": {"layers": thin}})).starts_with("layers.ceramic.thickness = -1 is out of")
        );
        let mut unknown = unimorph();
        unknown["substrate"] = json!({"thickness": 1e-4, "material": "wood"});
        let message = wrong(json!({"device": {"layers": unknown}}));
        assert!(message.starts_with("device.layers.substrate: the material is not available"), "{message}");
    }
}
