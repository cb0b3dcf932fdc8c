//! What scatter does to a device: sensitivities against closed forms, shares against counting.

use harvester_lab::questions::solve;
use serde_json::{Value, json};

fn answer(request: &Value) -> Value {
    serde_json::from_str(&solve(&request.to_string()).expect("an answer")).expect("JSON")
}

/// A beam without magnets, tip mass, load and coupling that matter: f = 1.8751^2/(2 pi) sqrt(E I/(m_b L^3)).
fn plain() -> Value {
    json!({"flux_density": 0.0, "tip_mass": 0.0, "gravity": 0.0, "coupling": 1e-9, "frequency": 0.5,
        "base_amplitude": 1e-4, "viscosity": 1e6})
}

#[test]
fn sensitivities_of_a_plain_beam_are_the_powers_of_its_formulas() {
    let request = json!({"task": "tolerances", "device": plain(), "samples": 0});
    let found = answer(&request);
    let rows = found["sensitivities"].as_array().expect("rows");
    let of = |name: &str, what: &str| {
        let row = rows.iter().find(|row| row["name"] == name).expect(name);
        row[what].as_f64().expect(what)
    };
    // Of the frequency: the formula's own powers.
    for (name, power) in
        [("beam_length", -1.5), ("beam_mass", -0.5), ("youngs_modulus", 0.5), ("second_moment", 0.5)]
    {
        assert!((of(name, "frequency") - power).abs() < 1e-4, "{name}: {}", of(name, "frequency"));
    }
    assert!(of("capacitance", "frequency").abs() < 1e-6);
    // Of the power, far below resonance with a weak coupling: P = Theta^2 q^2 w^2 R/(1 + (w R C)^2).
    let (omega, resistance, capacitance) = (std::f64::consts::PI, 7_631_732.0, 5.9531e-8_f64);
    let part = (omega * resistance * capacitance).powi(2);
    assert!((of("coupling", "power") - 2.0).abs() < 1e-4);
    assert!(
        (of("resistance", "power") - (1.0 - part) / (1.0 + part)).abs() < 1e-3,
        "{}",
        of("resistance", "power")
    );
    assert!((of("capacitance", "power") + 2.0 * part / (1.0 + part)).abs() < 1e-3);
    assert_eq!(found["most"]["frequency"], "beam_length");
    assert!(found["sensitivities"][0]["power"].as_f64().map(f64::abs) >= Some(2.0));
    // Without magnets there is no tongue.
    assert!(found["nominal"]["threshold"].is_null() && found["most"]["threshold"].is_null());
    assert_eq!(found["yield"]["samples"], 0);
}

#[test]
fn the_spread_of_one_dimension_is_that_of_the_closed_form() {
    // The power goes with the square of the coupling, so its quantiles are those of a squared normal deviate.
    let request = json!({"task": "tolerances", "device": plain(), "samples": 512, "deviation": 0.0,
        "scatter": [{"name": "coupling", "deviation": 0.1}], "limits": {"voltage": [1e3, 1e3]}});
    let found = answer(&request);
    let (spread, nominal) = (&found["yield"], found["nominal"]["power"].as_f64().expect("a power"));
    let of = |name: &str| spread["power"][name].as_f64().expect(name) / nominal;
    // The normal quantile of 0.95 is 1.6449, of 0.75 0.6745.
    for (name, deviate) in
        [("p5", -1.6449), ("p25", -0.6745), ("median", 0.0), ("p75", 0.6745), ("p95", 1.6449)]
    {
        let expected = (1.0_f64 + 0.1 * deviate).powi(2);
        assert!((of(name) / expected - 1.0).abs() < 0.01, "{name}: {} {expected}", of(name));
    }
    assert!((of("mean") - 1.01).abs() < 2e-3, "{}", of("mean"));
    assert_eq!((spread["samples"].as_u64(), spread["lasting"].as_f64()), (Some(512), Some(1.0)));
    assert_eq!((spread["safe"].as_f64(), spread["voltage_checked"].as_bool()), (Some(1.0), Some(true)));
    // A limit at the median of the voltage is kept by half of them.
    let peak = (2.0 * nominal * 7_631_732.0).sqrt();
    let mut request = request;
    request["limits"] = json!({"voltage": [peak, peak]});
    let safe = answer(&request)["yield"]["safe"].as_f64().expect("a share");
    assert!((safe - 0.5).abs() < 0.02, "{safe}");
}

#[test]
fn the_threshold_of_the_papers_device_has_sensitivities_and_bad_requests_are_named() {
    let request = json!({"task": "tolerances", "parameters": {"alpha": 1e-4, "omega": 8.1, "beta": 3e-4},
        "samples": 4, "deviation": 0.001});
    let found = answer(&request);
    let threshold = found["nominal"]["threshold"].as_f64().expect("a threshold");
    let rows = found["sensitivities"].as_array().expect("rows");
    let row = |name: &str| rows.iter().find(|row| row["name"] == name).expect(name);
    // The beam may not matter less than the magnets' distance, by differences of another task.
    let beside = |step: f64| {
        let mut request = request.clone();
        request["samples"] = json!(0);
        let device = answer(&json!({"task": "find", "parameters": request["parameters"], "generations": 1,
            "variables": [{"name": "resistance", "from": 7e6, "to": 8e6}]}))["device"]
            .clone();
        let mut device = device;
        device["resistance"] = json!(7_631_732.0);
        device["magnet_distance"] =
            json!(device["magnet_distance"].as_f64().expect("a distance") * (1.0 + step));
        request.as_object_mut().expect("an object").remove("parameters");
        request["device"] = device;
        answer(&request)["nominal"]["threshold"].as_f64().expect("a threshold")
    };
    let slope = (beside(0.02) / beside(-0.02)).ln() / (1.02_f64 / 0.98).ln();
    let lean = row("magnet_distance")["threshold"].as_f64().expect("a sensitivity");
    assert!(threshold > 0.0 && (lean / slope - 1.0).abs() < 0.05, "{lean} {slope}");
    let refused = |more: Value| {
        let mut request = request.clone();
        request.as_object_mut().expect("an object").extend(more.as_object().expect("an object").clone());
        solve(&request.to_string()).expect_err("refused")
    };
    assert!(refused(json!({"deviation": 0.5})).starts_with("deviation = 0.5 is out of range"));
    assert!(
        refused(json!({"scatter": [{"name": "frequency", "deviation": 0.1}]}))
            .starts_with("scatter[0].name: `frequency`")
    );
    assert!(refused(json!({"samples": 100000})).contains("samples"));
}

#[test]
fn safe_is_what_the_task_limits_calls_safe() {
    for (device, assessment, known) in [
        // No ceramic, so nothing is known of the voltage that it bears; hung level, the paper's beam sags too far.
        (json!({"gravity": 0.0, "frequency": 1.42}), "unchecked", (false, true)),
        (json!({"frequency": 2.0, "ceramic": "apc855"}), "model_not_valid", (true, false)),
        (json!({"gravity": 0.0, "frequency": 1.42, "ceramic": "apc855"}), "within_limits", (true, true)),
    ] {
        let mut request =
            json!({"task": "limits", "device": device, "acceleration": 0.005, "scaling": "consistent"});
        let limits = answer(&request);
        assert_eq!(limits["assessment"], assessment, "{limits}");
        (request["task"], request["samples"]) = (json!("tolerances"), json!(8));
        let found = answer(&request);
        let (nominal, shares) = (&found["nominal"], &found["yield"]);
        assert_eq!((&nominal["within_limits"], &shares["within_limits"]), (&json!(true), &json!(1.0)));
        assert_eq!((&shares["voltage_checked"], &shares["model_valid"]), (&json!(known.0), &json!(known.1)));
        let safe = f64::from(u8::from(limits["safe"] == true));
        assert_eq!((&nominal["safe"], &shares["safe"]), (&limits["safe"], &json!(safe)), "{found}");
    }
}
