//! Published devices, asked about by their layers, against what was published and against closed forms evaluated apart
//! from this crate (`tests/reference/unimorph.py`).

use harvester_lab::questions::solve;
use serde_json::{Value, json};

fn answer(request: &Value) -> Value {
    serde_json::from_str(&solve(&request.to_string()).expect("an answer")).expect("JSON")
}

fn close(value: &Value, expected: f64, tolerance: f64) {
    let found = value.as_f64().unwrap_or(f64::NAN);
    assert!((found / expected - 1.0).abs() < tolerance, "{found} {expected}");
}

/// Erturk & Inman's unimorph of 2008.
fn unimorph() -> Value {
    json!({
        "layers": {
            "arrangement": "unimorph", "width": 20e-3,
            "substrate": {"thickness": 0.5e-3, "youngs_modulus": 100e9, "density": 7165},
            "ceramic": {"thickness": 0.4e-3, "youngs_modulus": 66e9, "density": 7800, "d31": -190e-12,
                "permittivity": 15.93e-9},
        },
        "beam_length": 0.1, "tip_mass": 0, "flux_density": 0, "damping_ratio": [0.01],
    })
}

/// Their bimorph of 2009.
fn bimorph(arrangement: &str) -> Value {
    json!({
        "layers": {
            "arrangement": arrangement, "width": 31.8e-3,
            "substrate": {"thickness": 0.14e-3, "material": "brass"},
            "ceramic": {"thickness": 0.26e-3, "youngs_modulus": 66e9, "density": 7800, "d31": -190e-12,
                "permittivity": 13.28e-9},
        },
        "beam_length": 50.8e-3, "tip_mass": 12e-3, "flux_density": 0, "damping_ratio": [0.027],
    })
}

/// What the device delivers at a frequency (Hz) into a load (ohm).
fn harvest(device: &Value, frequency: f64, resistance: f64) -> Value {
    let mut device = device.clone();
    device["frequency"] = json!(frequency);
    device["resistance"] = json!(resistance);
    let model = json!({"modes": 5, "force": "exact"});
    answer(&json!({"task": "harvest", "device": device, "model": model, "acceleration": 0.01}))
}

/// Frequency (Hz) between these at which the mean power into a load is highest, and W/g^2 there.
fn peak(device: &Value, resistance: f64, (mut low, mut high): (f64, f64)) -> (f64, f64) {
    let power = |frequency: f64| {
        harvest(device, frequency, resistance)["linear"]["power_per_g2"].as_f64().unwrap_or(f64::NAN)
    };
    for _ in 0..24 {
        let (left, right) = (low + 0.4 * (high - low), high - 0.4 * (high - low));
        if power(left) < power(right) { low = left } else { high = right }
    }
    (low, power(low))
}

#[test]
fn the_unimorph_resonates_and_delivers_as_published() {
    let found = harvest(&unimorph(), 47.8, 17.38e3);
    let stiffness = found["youngs_modulus"].as_f64().unwrap_or_default()
        * found["second_moment"].as_f64().unwrap_or_default();
    close(&json!(stiffness), 0.0978472, 1e-5);
    close(&found["beam_mass"], 13.405e-3, 1e-5);
    close(&found["capacitance"], 79.65e-9, 1e-5);
    close(&found["coupling"], 7.3861e-5, 1e-5);
    // Of the closed form, five modes; without magnets every motion is the linear one.
    for of in [&found["linear"], &found["reached"]["harvest"]] {
        close(&of["power_per_g2"], 15.538_27e-3, 1e-5);
    }
    close(&harvest(&unimorph(), 48.8, 91.2e3)["linear"]["power_per_g2"], 15.635_11e-3, 1e-5);
    // Resonances as printed: terminals connected, and open.
    let (connected, _) = peak(&unimorph(), 20.0, (46.0, 50.0));
    let (open, _) = peak(&unimorph(), 1e8, (46.0, 50.0));
    assert!((connected - 47.8).abs() < 0.05 && (open - 48.8).abs() < 0.05, "{connected} {open}");
    // Near the best load power hardly depends on it.
    for (frequency, best) in [(47.8, 17.38e3), (48.8, 91.2e3)] {
        let at = |factor: f64| harvest(&unimorph(), frequency, factor * best)["linear"]["power"].as_f64();
        assert!(at(1.0) > at(0.95) && at(1.0) > at(1.05), "{frequency}");
    }
}

#[test]
fn the_bimorph_resonates_where_it_was_measured() {
    let device = bimorph("series");
    let found = harvest(&device, 46.1, 35e3);
    close(&found["coupling"], 7.97544e-5, 1e-5);
    close(&found["capacitance"], 41.256e-9, 1e-5);
    let (connected, _) = peak(&device, 100.0, (40.0, 52.0));
    let (open, _) = peak(&device, 1e8, (40.0, 52.0));
    assert!((connected / 45.6 - 1.0).abs() < 0.02 && (open / 48.4 - 1.0).abs() < 0.02, "{connected} {open}");
    // Computed elsewhere, peaks being twice the means.
    for (resistance, frequency, power) in [(35e3, 46.1, 25.0e-3), (186e3, 47.8, 24.7e-3)] {
        let (found, mean) = peak(&device, resistance, (40.0, 52.0));
        assert!((found - frequency).abs() < 0.1 && (2.0 * mean / power - 1.0).abs() < 0.01, "{found} {mean}");
    }
}

#[test]
fn in_parallel_it_delivers_the_same_into_a_quarter_of_the_load() {
    let series = harvest(&bimorph("series"), 46.1, 40e3);
    let parallel = harvest(&bimorph("parallel"), 46.1, 10e3);
    close(&parallel["linear"]["power"], series["linear"]["power"].as_f64().unwrap_or(f64::NAN), 1e-9);
    close(&parallel["coupling"], 2.0 * 7.97544e-5, 1e-5);
    close(&parallel["capacitance"], 4.0 * 41.256e-9, 1e-5);
}
