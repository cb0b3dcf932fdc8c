//! The requests of the design bench.

use crate::{answer, list, number};
use harvester_lab::model::Device;
use harvester_lab::questions::solve;
use serde_json::{Value, json};

fn refusal(request: &Value) -> String {
    solve(&request.to_string()).expect_err("it is refused")
}

fn figure_9() -> Value {
    json!({"alpha": 1e-4, "beta": 0.01, "omega": 8.0969})
}

#[test]
fn a_harvest_may_be_asked_for_in_numbers_and_in_si_units() {
    let found = answer(&json!({"task": "harvest", "parameters": figure_9()}));
    assert_eq!(found["reached"]["motion"]["periods"], 2);
    assert!((number(&found["reached_gain"]) - 9.7155).abs() < 1e-3, "{found}");
    assert!(number(&found["reached"]["harvest"]["defect"]) < 1e-8);
    // Table 1 shaken as in Figure 3, by its SI device.
    let device = answer(&json!({"task": "harvest", "device": {}}));
    assert!((number(&device["acceleration"]) - 0.148206).abs() < 1e-5, "{device}");
    assert!((number(&device["frequency"]) - 25.0 / (std::f64::consts::TAU * 0.4543265)).abs() < 1e-6);
    // An acceleration comes out as it went in.
    let shaken = answer(&json!({"task": "harvest", "device": {"frequency": 2.9}, "acceleration": 0.05}));
    assert!((number(&shaken["acceleration"]) / 0.05 - 1.0).abs() < 1e-12, "{shaken}");
    assert!((number(&shaken["frequency"]) / 2.9 - 1.0).abs() < 1e-12);
    // The consistent scaling is another circuit: twice the coupling, twice the damping that it brings.
    let other = answer(&json!({"task": "harvest", "device": {}, "scaling": "consistent"}));
    let ratio = number(&other["linear"]["power"]) / number(&device["linear"]["power"]);
    assert!((ratio - 1.0).abs() > 1e-4, "{ratio}");
}

#[test]
fn a_harvest_over_frequency_has_curves_and_bands() {
    let found = answer(&json!({
        "task": "harvest", "parameters": figure_9(), "least": 1e-5,
        "frequency": {"from": 2.7, "to": 3.0, "count": 13},
    }));
    let curves = &found["curves"];
    assert_eq!(list(&curves["up"]).len(), 13);
    // One of them at each of these, and more in the tongue, at twice the first frequency.
    let starts: Vec<f64> =
        list(&curves["from_rest"]).iter().filter_map(|start| start[1]["frequency"].as_f64()).collect();
    // Below, the motion ends.
    for k in 2..13 {
        let asked = 2.7 + 0.025 * f64::from(k);
        assert!(starts.iter().any(|start| (start / asked - 1.0).abs() < 1e-9), "{asked}: {starts:?}");
    }
    assert!(starts.len() > 13 && starts.is_sorted(), "{starts:?}");
    let bands: Vec<&str> = list(&curves["bands"]).iter().filter_map(|band| band["of"].as_str()).collect();
    assert_eq!(bands, ["linear", "stable", "from_rest", "up", "down"]);
    assert_eq!(number(&curves["bands"][0]["total"]), 0.0);
    assert!(number(&curves["bands"][2]["total"]) > 0.1, "{}", curves["bands"]);
    assert!(list(&curves["branches"]).iter().any(|branch| branch["periods"] == 2));
    assert!(curves["branches_missing"].is_null());
    // Where no branch can be followed it says why, and ended motions are no points.
    let hard = answer(&json!({
        "task": "harvest", "parameters": {"alpha": 1e-4, "beta": 0.12, "omega": 4.0},
        "frequency": {"from": 1.2, "to": 1.6, "count": 3},
    }));
    let curves = &hard["curves"];
    assert!(list(&curves["branches"]).is_empty() && curves["branches_missing"].is_string(), "{curves}");
    assert!(list(&curves["up"]).iter().any(Value::is_null), "{curves}");
}

#[test]
fn a_wide_window_holds_the_peak_that_a_narrow_one_holds() {
    // A steel beam without magnets: its peak is known in closed form, and 0.1 Hz wide.
    let device = json!({
        "beam_length": 0.06, "beam_mass": 1.41e-3, "tip_mass": 0.74e-3, "youngs_modulus": 200e9,
        "second_moment": 2.25e-14, "viscosity": 1e6, "capacitance": 13e-9, "resistance": 18e3, "coupling": 25e-6,
        "frequency": 42.5, "flux_density": 0.0,
    });
    let mut peaks = Vec::new();
    for (from, to) in [(38.0, 39.0), (30.0, 60.0), (10.0, 400.0)] {
        let found = answer(&json!({
            "task": "harvest", "device": device, "acceleration": 0.01, "hold": "acceleration",
            "frequency": {"from": from, "to": to, "count": 11},
        }));
        let curves = &found["curves"];
        let peak = number(&curves["linear"]["peak"][1]);
        peaks.push(peak);
        assert!((peak / peaks[0] - 1.0).abs() < 1e-9, "{peaks:?}");
        let power = |point: &Value| point["power"].as_f64().unwrap_or_default();
        let branch = list(&curves["branches"][0]["points"]).iter().map(power).fold(0.0, f64::max);
        let rest = list(&curves["from_rest"]).iter().map(|start| power(&start[1])).fold(0.0, f64::max);
        for (what, highest) in [("branch", branch), ("from rest", rest)] {
            assert!(highest > 0.98 * peak && highest < 1.0001 * peak, "{what} {from} {to}: {highest} {peak}");
        }
    }
}

#[test]
fn loads_have_an_optimum() {
    let found = answer(&json!({"task": "load", "parameters": figure_9(), "per_decade": 2}));
    assert_eq!((list(&found["linear"]).len(), list(&found["reached"]).len()), (13, 13));
    let best = number(&found["reached_best"]["power"]);
    for point in list(&found["reached"]) {
        assert!(number(&point["power"]) <= best);
    }
    let linear = number(&found["linear_best"][1]);
    assert!(list(&found["linear"]).iter().all(|point| number(&point[1]) <= linear));
}

#[test]
fn limits_say_what_is_broken() {
    let with = |thickness: f64| {
        answer(&json!({
            "task": "limits", "parameters": figure_9(),
            "device": {"ceramic": "apc844", "ceramic_thickness": thickness, "gravity": 0.0},
        }))
    };
    let (thick, thin) = (with(2e-4), with(5e-5));
    assert_eq!((&thick["safe"], &thin["safe"]), (&json!(true), &json!(false)));
    assert_eq!((&thick["assessment"], &thin["assessment"]), (&json!("within_limits"), &json!("exceeded")));
    // The peak is held against the field: 9 V/mil of 50 um are 17.7 V, and the motion's peak is beyond 11 V/mil.
    assert_eq!(thin["voltage_compared"], "v_peak");
    assert_eq!(thin["checks"][0]["value"], thin["demand"]["v_peak"]);
    assert!((number(&thin["checks"][0]["limit"]) - 9.0 * 5e-5 / 2.54e-5).abs() < 1e-9);
    // Without a ceramic nothing is known of the voltage it bears.
    let bare = answer(&json!({"task": "limits", "parameters": figure_9(), "device": {"gravity": 0.0}}));
    assert_eq!((&bare["safe"], &bare["assessment"]), (&json!(false), &json!("unchecked")));
    let broken =
        |found: &Value| list(&found["checks"]).iter().filter(|check| check["standing"] != "within").count();
    assert_eq!((broken(&thick), broken(&thin)), (0, 1), "{thin}");
    assert_eq!(thin["checks"][0]["kind"], "voltage");
    assert!(number(&thin["checks"][0]["margin"]) < 0.0);
    // The printed device sags by more than half its length.
    let sagging = answer(&json!({"task": "limits", "parameters": figure_9()}));
    let sag = &sagging["sag"];
    assert_eq!((&sag["kind"], &sag["standing"]), (&json!("sag"), &json!("exceeded")));
    // No limit of the motion is broken, but the model counts the sag as small.
    assert_eq!((&sagging["safe"], &sagging["assessment"]), (&json!(false), &json!("model_not_valid")));
}

#[test]
fn ceramics_trust_and_designs_are_answered() {
    let parameters = json!({"alpha": 1e-4, "beta": 0.002, "omega": 8.1569});
    let found = answer(&json!({"task": "materials", "parameters": parameters}));
    let names: Vec<&str> = list(&found["rows"]).iter().filter_map(|row| row["name"].as_str()).collect();
    assert_eq!((names.len(), names[0], names[8]), (9, "APC 840", "APC 880/881"));
    let trust = answer(&json!({
        "task": "trust", "parameters": parameters, "quantity": {"threshold": "first"}, "t_end": 200,
    }));
    assert_eq!((list(&trust["entries"]).len(), list(&trust["law_errors"]).len()), (32, 4));
    let value = |i: usize| number(&trust["entries"][i]["value"]);
    assert!((value(4) / value(7) - 1.0).abs() < 0.2, "{trust}");
    // One mode has no table of resonances, and says why.
    let reason = trust["entries"][0]["reason"].as_str();
    assert!(trust["entries"][0]["value"].is_null() && reason.is_some_and(|why| why.contains("two modes")));
    assert!(trust["entries"][7].get("reason").is_none(), "{trust}");
    let find = json!({
        "task": "find", "parameters": parameters, "generations": 3, "seed": 5, "t_end": 200,
        "variables": [{"name": "resistance", "from": 1e5, "to": 1e9, "logarithmic": true}],
    });
    let design = answer(&find);
    assert_eq!(design, answer(&find));
    assert_eq!(list(&design["history"]).len(), 3 + 16);
    assert_eq!((&design["sensitivity"][0]["name"], &design["cliff"]), (&json!("resistance"), &json!(false)));
    assert!(number(&design["sensitivity"][0]["loss"]) < 1e-3, "{design}");
    let ohm = number(&design["values"][0]);
    assert!((number(&design["device"]["resistance"]) / ohm - 1.0).abs() < 1e-9, "{design}");
}

#[test]
fn trust_says_what_the_modes_left_out_cost_in_volts() {
    let device = json!({"frequency": 2.835, "coupling": 8e-5});
    let trust = answer(&json!({"task": "trust", "device": device, "quantity": "voltage", "t_end": 20}));
    let errors = list(&trust["moment_errors"]);
    // By a mesh of Hermite elements with the circuit, tests/fast/finite_element.rs.
    for (modes, without, with) in [(2, 0.310, 0.0198), (8, 0.0497, 1.3e-4)] {
        let entry = &errors[modes - 1];
        assert_eq!(entry["modes"], modes);
        assert!((number(&entry["without"]) - without).abs() < 1e-3, "{entry}");
        assert!((number(&entry["with"]) - with).abs() < 1e-3, "{entry}");
    }
}

#[test]
fn a_map_has_the_values_of_the_harvests_at_its_cells() {
    let map = answer(&json!({
        "task": "map", "parameters": figure_9(), "t_end": 200,
        "x": {"name": "beta", "from": 0.001, "to": 0.012, "count": 3},
        "y": {"name": "resistance", "from": 1e6, "to": 4e6, "count": 2, "logarithmic": true},
        "limits": {"voltage": [10, 10]},
    }));
    assert_eq!(map["y"], json!([1e6, 4e6]));
    let (x, y) = (list(&map["x"]), list(&map["y"]));
    let unit = Device::default().resistance_of(1.0).expect("a load");
    let mut best = None;
    for (row, ohm) in y.iter().enumerate() {
        for (column, beta) in x.iter().enumerate() {
            let mut parameters = figure_9();
            parameters["beta"] = beta.clone();
            parameters["kappa"] = json!(unit / number(ohm));
            let found = answer(&json!({"task": "harvest", "parameters": parameters, "t_end": 200}));
            let (value, violation) = (&map["values"][row][column], number(&map["violation"][row][column]));
            let Some(watts) = found["reached"]["harvest"]["power"].as_f64() else {
                assert!(value.is_null() && violation > 0.0, "{map}");
                continue;
            };
            assert!((number(value) / watts - 1.0).abs() < 1e-4, "{value} {watts}");
            let peak = number(&found["reached"]["harvest"]["demand"]["v_peak"]);
            assert!(violation > 0.0 || peak <= 10.001, "{peak} {violation}");
            if violation == 0.0 && best.is_none_or(|best| watts > best) {
                best = Some(watts);
            }
        }
    }
    let found = number(&map["best"]["evaluation"]["value"]);
    assert!((found / best.expect("one keeps the limits") - 1.0).abs() < 1e-4, "{map}");
}

#[test]
fn a_bad_request_names_the_field() {
    for (request, message) in [
        (json!({"task": "harvest", "device": {"beam_mass": -1.0}}), "beam_mass = -1 is out of range"),
        (json!({"task": "harvest", "device": {"mass": 1.0}}), "device.mass: unknown field `mass`"),
        (json!({"task": "harvest", "ohm": 1}), "ohm: unknown field `ohm`"),
        (json!({"task": "load", "per_decade": 99}), "per_decade = 99 is not available: allowed are 1 to 50"),
        (json!({"task": "materials", "mode": 3}), "mode = 3 is not available: allowed are 1 to 2"),
        (json!({"task": "limits", "gap": 2.0}), "limits.gap = 2 is out of range"),
        (json!({"task": "find", "variables": []}), "variables = 0 is not available: allowed are 1 to 8"),
        (
            json!({"task": "find", "variables": [{"name": "colour", "from": 0, "to": 1}]}),
            "variables: colour: allowed are the ten numbers",
        ),
        (
            json!({"task": "find", "variables": [
                {"name": "resistance", "from": 1e5, "to": 1e6}, {"name": "resistance", "from": 1e5, "to": 1e7},
            ]}),
            "variables[1].name: `resistance` is varied already",
        ),
        (json!({"task": "harvest", "least": -1}), "least = -1 is out of range: allowed are 0 to"),
        (json!({"task": "harvest", "limits": {"voltage": [10, 5]}}), "limits.voltage = 5 is out of range"),
        (
            json!({"task": "load", "from": 1e6, "to": 1e5}),
            "to = 100000 is out of range: allowed are 1000000 to 1e15 ohm",
        ),
        (json!({"task": "load", "from": -1}), "from = -1 is out of range"),
        (json!({"task": "load", "from": 1}), "from = 1 is out of range"),
        (
            json!({"task": "map", "x": {"name": "d", "from": 0.1, "to": 0.2, "count": 200},
                "y": {"name": "omega", "from": 20, "to": 30, "count": 200}}),
            "cells of the map = 40000 is not available: allowed are 4 to 16384",
        ),
        (
            json!({"task": "map", "x": {"name": "gap", "from": 0.1, "to": 0.2},
                "y": {"name": "omega", "from": 20, "to": 30}}),
            "x.name: `gap` is not available",
        ),
        (
            json!({"task": "map", "x": {"name": "d", "from": 0.1, "to": 0.2}, "y": {"name": "d", "from": 1, "to": 2}}),
            "both sides of the chart are d",
        ),
    ] {
        let found = refusal(&request);
        assert!(found.starts_with(message), "{request}: {found}");
    }
}

#[test]
fn a_threshold_counts_the_loss_of_the_voltage_that_grows() {
    let loss = 0.05;
    let space = |frequency: f64| {
        json!({
            "task": "map", "device": {"frequency": frequency, "resistance": 5e6, "loss_tangent": loss},
            "acceleration": 0.01, "objective": {"threshold": "first"},
            "x": {"name": "resistance", "from": 5e6, "to": 6e6, "count": 2},
            "y": {"name": "tip_mass", "from": 5.12e-4, "to": 6e-4, "count": 2},
        })
    };
    let first = |frequency: f64| number(&answer(&space(frequency))["values"][0][0]);
    let near = first(2.85);
    for frequency in [1.4, 8.0, 20.0] {
        assert!((first(frequency) / near - 1.0).abs() < 1e-9, "{frequency}: {} {near}", first(frequency));
    }
    // The tip of the tongue of a device whose conductance is that of the load and of the loss at half the tongue's frequency.
    let paper = answer(&json!({"task": "modes"}));
    let frequency = number(&paper["omega"][0]);
    let [c, kappa] = [1e-6, 1e-6 * Device::default().resistance / 5e6];
    let omegas: Vec<f64> = (-40..=40).map(|step| 2.0 * frequency + 0.005 * f64::from(step)).collect();
    let boundary = answer(&json!({
        "task": "boundary", "theory": "floquet", "resonance": "first", "omega": omegas,
        "parameters": {"c": c, "kappa": kappa + loss * frequency * c},
    }));
    let lowest = list(&boundary["beta"]).iter().filter_map(Value::as_f64).fold(f64::INFINITY, f64::min);
    assert!((near / lowest - 1.0).abs() < 2e-3, "{near} {lowest}");
}

#[test]
fn trust_counts_the_loss_of_a_doubled_motion_as_a_harvest_does() {
    let device = json!({"frequency": 2.85, "resistance": 5e6, "loss_tangent": 0.05});
    let harvest = answer(&json!({"task": "harvest", "device": device, "acceleration": 0.03}));
    let reached = &harvest["reached"];
    assert_eq!(reached["motion"], json!({"kind": "periodic", "periods": 2}));
    let volts = number(&reached["harvest"]["v_rms"]);
    let trust =
        answer(&json!({"task": "trust", "quantity": "voltage", "device": device, "acceleration": 0.03}));
    let entries = list(&trust["entries"]).iter();
    let own: Vec<f64> = entries
        .filter(|entry| entry["modes"] == 2 && entry["law"] == "quadratic")
        .map(|entry| number(&entry["value"]))
        .collect();
    assert!(own.len() == 1 && (own[0] / volts - 1.0).abs() < 1e-8, "{own:?} {volts}");
}

#[test]
fn what_rounding_decides_is_no_fact_of_the_bench_either() {
    // By 1e-12 of the resistance this device moves with period 9, 3 or 1.
    let device = json!({"frequency": 5.092_010_737_736_381_5, "resistance": 9_513_869.812_648_773,
        "capacitance": 7.558_749_644_782_022e-8, "base_amplitude": 0.011_300_247_286_119_75});
    let request = |task| {
        json!({"task": task, "scaling": "consistent", "device": device,
            "model": {"force": {"taylor": 5}}})
    };
    let undecided = json!({"kind": "undecided", "why": "depends_on_rounding"});
    assert_eq!(answer(&request("verdict"))["motion"], undecided);
    let reached = &answer(&request("harvest"))["reached"];
    assert_eq!(reached["motion"], undecided);
    assert!(number(&reached["harvest"]["power"]) > 0.0);
    assert_eq!(answer(&request("limits"))["motion"], "undecided");
    // Where it decides nothing the motion is one, and of a periodic one the power is exact.
    let own = answer(&json!({"task": "harvest", "parameters": figure_9()}));
    assert_eq!(own["reached"]["motion"]["periods"], 2);
    assert_eq!(own["reached"]["harvest"].get("power_error"), None);
}

#[test]
fn a_cycle_that_chaos_fell_into_by_chance_is_no_fact_of_the_rectifier() {
    // The cycle is stable, but none of seven neighbours 1e-10 apart, nor any of 88 random starts of another integrator,
    // found it within 12,000 periods; those go on chaotically with eight times its current.
    let parameters = json!({"alpha": 2e-4, "beta": 0.01, "omega": 21.5});
    let found = answer(&json!({"task": "harvest", "parameters": parameters, "model": {"force": "exact"},
        "rectifier": {"voltage": 5, "count": 0}}));
    let found = &found["rectified"]["at_voltage"];
    assert_eq!(
        (&found["steady"]["kind"], &found["delivered"]),
        (&json!("depends_on_rounding"), &json!(null))
    );
}

#[test]
fn the_band_of_a_map_ends_where_that_of_a_harvest_does() {
    let (from, to, least) = (2.7, 3.0, 1e-5);
    let harvest = answer(&json!({"task": "harvest", "parameters": figure_9(), "least": least,
        "frequency": {"from": from, "to": to, "count": 41}}));
    let bands = list(&harvest["curves"]["bands"]).iter();
    let expected: Vec<f64> =
        bands.filter(|band| band["of"] == "from_rest").map(|band| number(&band["total"])).collect();
    // A line between two of ten frequencies would miss a border by up to their distance.
    let map = answer(&json!({"task": "map", "parameters": figure_9(),
        "objective": {"band": {"least": least, "from": from, "to": to, "count": 10}},
        "x": {"name": "alpha", "from": 1e-4, "to": 2e-4, "count": 2},
        "y": {"name": "beta", "from": 0.01, "to": 0.02, "count": 2}}));
    let found = number(&map["values"][0][0]);
    let distance = (to - from) / 9.0;
    assert!(
        expected.len() == 1 && (found - expected[0]).abs() < 2.0 * distance / 64.0,
        "{found} {expected:?}"
    );
}
