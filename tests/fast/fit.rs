//! Fits: known devices come back, and standard errors are what repeated measurements scatter by.

use harvester_lab::questions::solve;
use serde_json::{Value, json};

fn answer(request: &Value) -> Value {
    serde_json::from_str(&solve(&request.to_string()).expect("an answer")).expect("JSON")
}

/// A linear device of one's own under a given acceleration.
fn device(viscosity: f64, coupling: f64, tip_mass: f64) -> Value {
    json!({"flux_density": 0.0, "beam_length": 0.12, "beam_mass": 0.02, "youngs_modulus": 1e11, "second_moment": 1e-12,
        "tip_mass": tip_mass, "viscosity": viscosity, "coupling": coupling, "capacitance": 5e-8, "resistance": 1e5,
        "frequency": 20.0})
}

/// Its voltages by the task `harvest`, whose linear curve is tested against the closed form elsewhere.
fn measured(device: &Value, from: f64, to: f64, count: usize) -> Vec<[f64; 2]> {
    let found =
        answer(&json!({"task": "harvest", "device": device, "scaling": "consistent", "acceleration": 0.2,
        "hold": "acceleration", "frequency": {"from": from, "to": to, "count": count}}));
    let points = found["curves"]["linear"]["points"].as_array().expect("points");
    points.iter().map(|p| [p[0].as_f64().expect("Hz"), p[1].as_f64().expect("V")]).collect()
}

fn fit(device: &Value, data: &[[f64; 2]], free: &[&str]) -> Value {
    answer(&json!({"task": "fit", "device": device, "scaling": "consistent", "acceleration": 0.2,
        "hold": "acceleration", "data": data, "free": free}))
}

fn value(found: &Value, index: usize, what: &str) -> f64 {
    found["fitted"][index][what].as_f64().expect(what)
}

#[test]
fn a_known_device_comes_back_from_its_own_curve() {
    let truth = [3e7, 2e-4, 2e-3];
    let data = measured(&device(truth[0], truth[1], truth[2]), 12.0, 24.0, 30);
    let found = fit(&device(1.8e7, 3e-4, 2.4e-3), &data, &["viscosity", "coupling", "tip_mass"]);
    assert_eq!(found["converged"], true, "{found}");
    for (i, truth) in truth.iter().enumerate() {
        assert!((value(&found, i, "value") / truth - 1.0).abs() < 1e-5, "{i}: {found}");
    }
    let left = [0, 1].map(|i| found["left"][i].as_f64().expect("V"));
    assert!(left[1] < 1e-6 * left[0], "{left:?}");
    assert_eq!(found["result"].as_array().map(Vec::len), Some(data.len()));
}

#[test]
fn standard_errors_are_the_scatter_of_repeated_fits() {
    let (viscosity, coupling, noise) = (3e7, 2e-4, 0.01);
    let clean = measured(&device(viscosity, coupling, 2e-3), 14.0, 22.0, 24);
    let highest = clean.iter().map(|point| point[1]).fold(0.0, f64::max);
    let mut seed = 1_u64;
    let mut uniform = || {
        // Knuth's MMIX generator.
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (seed >> 11) as f64 / (1_u64 << 53) as f64
    };
    let fits = 60;
    let (mut values, mut errors) = (vec![Vec::new(), Vec::new()], [0.0; 2]);
    for _ in 0..fits {
        // Twelve uniform numbers have the variance 1.
        let mut normal = || (0..12).map(|_| uniform()).sum::<f64>() - 6.0;
        let data: Vec<[f64; 2]> =
            clean.iter().map(|[hz, v]| [*hz, (v + noise * highest * normal()).max(0.0)]).collect();
        let found = fit(&device(viscosity, coupling, 2e-3), &data, &["viscosity", "coupling"]);
        for k in 0..2 {
            values[k].push(value(&found, k, "value"));
            errors[k] += value(&found, k, "standard_error") / f64::from(fits);
        }
    }
    for (k, truth) in [viscosity, coupling].into_iter().enumerate() {
        let mean = values[k].iter().sum::<f64>() / f64::from(fits);
        let square = values[k].iter().map(|v| (v - mean).powi(2)).sum::<f64>() / f64::from(fits - 1);
        // Of 60 fits the scatter itself is known to 9 %, the mean to an eighth of it.
        assert!((square.sqrt() / errors[k] - 1.0).abs() < 0.3, "{k}: {} {}", square.sqrt(), errors[k]);
        assert!((mean - truth).abs() < 0.5 * errors[k], "{k}: {mean} {truth} {}", errors[k]);
    }
}

#[test]
fn a_device_with_magnets_is_fitted_by_the_motion_from_rest() {
    let with = |distance: f64| json!({"magnet_distance": distance, "frequency": 1.3, "viscosity": 1.7e8});
    let request = |device: &Value, data: Value| {
        json!({"task": "fit", "device": device, "acceleration": 0.002, "hold": "acceleration", "data": data,
            "free": ["magnet_distance"]})
    };
    // What another task computes of it: the motion from rest, one frequency at a time.
    let data: Vec<[f64; 2]> = [1.30, 1.34, 1.38, 1.42, 1.46, 1.50]
        .iter()
        .map(|hertz| {
            let mut device = with(0.34);
            device["frequency"] = json!(hertz);
            let found = answer(&json!({"task": "harvest", "device": device, "acceleration": 0.002}));
            [*hertz, found["reached"]["harvest"]["v_rms"].as_f64().expect("V")]
        })
        .collect();
    let found = answer(&request(&with(0.345), json!(data)));
    assert!((value(&found, 0, "value") / 0.34 - 1.0).abs() < 1e-4, "{found}");
}

#[test]
fn what_cannot_be_fitted_is_said() {
    let data = json!([[12.0, 1.0], [13.0, 2.0]]);
    let refused = |free: Value, data: Value| {
        let request = json!({"task": "fit", "device": device(1e7, 1e-4, 0.0), "scaling": "consistent", "data": data,
            "free": free});
        solve(&request.to_string()).expect_err("refused")
    };
    assert!(refused(json!(["tip_mass"]), data.clone()).starts_with("free[0]: `tip_mass` is not available"));
    assert!(refused(json!(["coupling", "coupling"]), data.clone()).starts_with("free[1]"));
    assert!(refused(json!(["coupling", "viscosity", "capacitance"]), data.clone()).contains("data = 2"));
    assert!(refused(json!(["coupling"]), json!([[12.0, -1.0], [1.0, 1.0]])).starts_with("data[0][1] = -1"));
    // Of the thickness of the ceramic the voltage tells nothing.
    let request = json!({"task": "fit", "device": device(1e7, 1e-4, 0.0), "scaling": "consistent",
        "data": [[12.0, 1.0], [13.0, 2.0], [14.0, 1.0]], "free": ["ceramic_thickness"]});
    let found = answer(&request);
    assert_eq!(
        (found["converged"].as_bool(), found["fitted"][0]["standard_error"].is_null()),
        (Some(false), true)
    );
}
