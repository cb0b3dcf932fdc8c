//! The larger tasks of a request against independent values and against one another.

use crate::{OMEGA_1, OMEGA_2, answer, list, number};
use serde_json::{Value, json};

fn parameters(alpha: f64, beta: f64, omega: f64) -> Value {
    json!({"alpha": alpha, "beta": beta, "omega": omega})
}

#[test]
fn orbits_of_the_figures_have_an_independent_programs_multipliers() {
    for (figure, alpha, beta, omega, modulus) in [
        (3, 1e-3, 1e-3, 25.0, 0.996743),
        (4, 1e-4, 1e-2, OMEGA_1 + OMEGA_2, 0.999378),
        (6, 1e-4, 1e-2, OMEGA_2 - OMEGA_1, 0.994786),
        (8, 1e-3, 1e-3, 8.0, 0.989845),
        (9, 1e-4, 1e-2, 2.0 * OMEGA_1, 1.148382),
        (11, 1e-3, 1e-3, 43.0, 0.998103),
        (12, 1e-4, 1e-2, 2.0 * OMEGA_2, 0.998852),
    ] {
        let orbit = answer(&json!({"task": "orbit", "parameters": parameters(alpha, beta, omega)}));
        let largest = &orbit["multipliers"][0];
        let (re, im) = (number(&largest[0]), number(&largest[1]));
        assert!((re.hypot(im) - modulus).abs() < 1e-6, "figure {figure}: {orbit}");
        assert_eq!(orbit["stable"], modulus < 1.0, "figure {figure}");
        if figure == 9 {
            assert!((re + 1.148382).abs() < 1e-6 && im == 0.0, "{orbit}");
            assert_eq!(orbit["instability"], "period_doubling");
        } else {
            assert_eq!(orbit["instability"], Value::Null);
        }
        assert_eq!((list(&orbit["multipliers"]).len(), list(&orbit["state"]).len()), (5, 5));
        assert!(number(&orbit["residual"]) < 1e-9 && number(&orbit["liouville_defect"]) < 1e-9, "{orbit}");
        let (v_rms, power) = (number(&orbit["v_rms"]), number(&orbit["power"]));
        assert!((power - 1e-6 * v_rms * v_rms).abs() < 1e-12);
        // A run from the orbit's state returns there after one period.
        let run = answer(&json!({
            "task": "simulate", "parameters": parameters(alpha, beta, omega), "initial": orbit["state"],
            "t_end": std::f64::consts::TAU / omega, "samples": 2,
        }));
        for (a, b) in list(&run["state"][1]).iter().zip(list(&orbit["state"])) {
            assert!((number(a) - number(b)).abs() < 1e-7 * number(b).abs().max(1.0), "figure {figure}");
        }
    }
}

#[test]
fn a_guess_leads_to_an_orbit_of_longer_period() {
    let parameters = parameters(1e-4, 1e-2, 2.0 * OMEGA_1);
    let (period, count) = (std::f64::consts::PI / OMEGA_1, 1500.0);
    let run = answer(&json!({
        "task": "simulate", "parameters": parameters, "t_end": count * period, "samples": 2,
    }));
    let guess = &run["state"][1];
    let orbit = answer(&json!({"task": "orbit", "parameters": parameters, "guess": guess, "periods": 2}));
    assert_eq!((&orbit["periods"], &orbit["stable"]), (&json!(2), &json!(true)));
    assert!((number(&orbit["v_rms"]) - 14.1783).abs() < 1e-4, "{orbit}");
    // Asked for as a motion of four periods it is still one of two.
    let again = answer(&json!({"task": "orbit", "parameters": parameters, "guess": guess, "periods": 4}));
    assert_eq!(again["periods"], 2);
}

#[test]
fn boundaries_by_multipliers_are_an_independent_programs() {
    for (alpha, resonance, detuning, quadratic, cubic) in [
        (1e-4, "first", 0.06, 0.000421, Some(0.000421)),
        (1e-4, "first", 0.0, 0.001628, Some(0.001735)),
        (1e-4, "sum", 0.1, 0.003707, Some(0.003809)),
        (1e-4, "sum", 0.0, 0.010911, Some(0.017355)),
        (1e-4, "sum", -0.1, 0.018431, None),
        (1e-4, "second", 0.16, 0.036027, Some(0.038133)),
        (1e-3, "first", 0.06, 0.000701, Some(0.000701)),
        (1e-3, "sum", 0.1, 0.013608, Some(0.014025)),
    ] {
        let centre = match resonance {
            "first" => 2.0 * OMEGA_1,
            "sum" => OMEGA_1 + OMEGA_2,
            _ => 2.0 * OMEGA_2,
        };
        for (force, reference) in [(json!("quadratic"), Some(quadratic)), (json!({"taylor": 3}), cubic)] {
            let request = json!({
                "task": "boundary", "theory": "floquet", "resonance": resonance,
                "parameters": {"alpha": alpha}, "model": {"force": force}, "omega": [centre + detuning],
            });
            let found = answer(&request)["beta"][0].as_f64();
            match (found, reference) {
                (Some(beta), Some(reference)) => {
                    assert!((beta - reference).abs() < 1e-6, "{request}: {beta} {reference}");
                }
                other => assert_eq!(other, (None, None), "{request}"),
            }
        }
    }
    // Above the limit of the search there is none.
    let request = json!({
        "task": "boundary", "theory": "floquet", "resonance": "sum", "limit": 0.01,
        "parameters": {"alpha": 1e-4}, "omega": [OMEGA_1 + OMEGA_2, OMEGA_1 + OMEGA_2 + 0.1],
    });
    let beta = &answer(&request)["beta"];
    assert!(beta[0].is_null() && (number(&beta[1]) - 0.003707).abs() < 1e-6, "{beta}");
}

#[test]
fn a_multiplier_chart_holds_what_orbits_say() {
    let chart = answer(&json!({
        "task": "chart", "quantity": "multiplier", "parameters": {"alpha": 1e-4},
        "omega": {"from": 8.0, "to": 8.2, "count": 3}, "beta": {"from": 1e-3, "to": 4e-3, "count": 4},
    }));
    assert_eq!((list(&chart["omega"]).len(), list(&chart["beta"]).len()), (3, 4));
    assert_eq!((list(&chart["values"]).len(), list(&chart["values"][0]).len()), (4, 3));
    for (row, beta) in list(&chart["beta"]).iter().enumerate() {
        for (column, omega) in list(&chart["omega"]).iter().enumerate() {
            let parameters = json!({"alpha": 1e-4, "beta": beta, "omega": omega});
            let orbit = answer(&json!({"task": "orbit", "parameters": parameters}));
            let (re, im) = (number(&orbit["multipliers"][0][0]), number(&orbit["multipliers"][0][1]));
            let (value, argument) = (&chart["values"][row][column], &chart["argument"][row][column]);
            assert!((number(value) - re.hypot(im)).abs() < 1e-8, "{omega} {beta}: {value} {orbit}");
            assert!((number(argument) - im.atan2(re).abs()).abs() < 1e-6, "{omega} {beta}: {argument}");
        }
    }
}

#[test]
fn motion_charts_hold_what_orbits_and_figures_say() {
    // Figures 9 and 12 with what lies beside them.
    let ask = |quantity: &str| {
        answer(&json!({
            "task": "chart", "quantity": quantity, "parameters": {"alpha": 1e-4},
            "omega": {"from": 2.0 * OMEGA_1, "to": 2.0 * OMEGA_2, "count": 2},
            "beta": {"from": 1e-3, "to": 1e-2, "count": 2},
        }))
    };
    let (motion, v_rms, power) = (ask("motion"), ask("v_rms"), ask("power"));
    assert_eq!(motion["values"], json!([["period 1", "period 1"], ["period 2", "escape"]]));
    assert_eq!(motion.get("argument"), None);
    // Where the motion is the forced one, its orbit has the same means; where it ended, it has none.
    for (column, omega) in list(&motion["omega"]).iter().enumerate() {
        let parameters = json!({"alpha": 1e-4, "beta": 1e-3, "omega": omega});
        let orbit = answer(&json!({"task": "orbit", "parameters": parameters}));
        assert!((number(&v_rms["values"][0][column]) / number(&orbit["v_rms"]) - 1.0).abs() < 1e-9);
        assert!((number(&power["values"][0][column]) / number(&orbit["power"]) - 1.0).abs() < 1e-9);
    }
    assert!((number(&v_rms["values"][1][0]) - 14.1783).abs() < 1e-4, "{v_rms}");
    assert!(v_rms["values"][1][1].is_null() && power["values"][1][1].is_null(), "{v_rms}");
}

#[test]
fn a_sweep_comes_to_what_long_simulations_come_to() {
    let (omega, kept) = (25.0, 4);
    let period = std::f64::consts::TAU / omega;
    let sweep = answer(&json!({
        "task": "sweep", "parameters": {"omega": omega}, "parameter": "beta", "from": 5e-4, "to": 1e-3,
        "count": 2, "direction": "up", "transient": 50, "kept": kept,
    }));
    assert!(sweep.get("branches").is_none());
    for point in list(&sweep["points"]) {
        // The multiplier is 0.9967 a period: nothing of a transient is left after 10,000 of them.
        let run = answer(&json!({
            "task": "simulate", "parameters": {"omega": omega, "beta": point["value"]},
            "t_end": 10_000.0 * period, "samples": 2, "tolerance": 1e-8,
        }));
        assert_eq!((&point["period"], &point["motion"]["kind"]), (&json!(1), &json!("periodic")));
        let expected = number(&run["state"][1][4]);
        for strobe in list(&point["strobe"]) {
            assert!((number(strobe) - expected).abs() < 1e-7, "{strobe} {expected}");
        }
        assert_eq!(list(&point["strobe"]).len(), kept);
    }
    let restarted = |i: usize| sweep["points"][i]["restarted"].clone();
    assert_eq!((restarted(0), restarted(1)), (json!(true), json!(false)));
}

#[test]
fn a_sweep_down_has_figure_9_on_its_way_and_on_a_branch() {
    let sweep = answer(&json!({
        "task": "sweep", "parameters": {"alpha": 1e-4, "beta": 1e-2}, "parameter": "omega",
        "from": 2.0 * OMEGA_1 - 0.5, "to": 2.0 * OMEGA_1 + 0.5, "count": 11, "direction": "down",
        "transient": 1500, "branches": true,
    }));
    let values: Vec<f64> = list(&sweep["points"]).iter().map(|point| number(&point["value"])).collect();
    assert!(values.len() == 11 && values.windows(2).all(|pair| pair[0] > pair[1]), "{values:?}");
    let middle = &sweep["points"][5];
    assert_eq!((&middle["period"], &middle["ended"]), (&json!(2), &json!(false)));
    assert!((number(&middle["v_rms"]) - 14.1783).abs() < 1e-3, "{middle}");
    // By interpolation on a stable branch of two periods.
    let doubled = list(&sweep["branches"]).iter().filter(|branch| branch["periods"] == 2);
    let near = |pair: &&[Value]| {
        let offset = |i: usize| number(&pair[i]["value"]) - 2.0 * OMEGA_1;
        offset(0) * offset(1) <= 0.0 && number(&pair[0]["multiplier"]) < 1.0
    };
    let pair = doubled.flat_map(|branch| list(&branch["points"]).windows(2)).find(near);
    let v_rms = pair.map_or(0.0, |pair| 0.5 * (number(&pair[0]["v_rms"]) + number(&pair[1]["v_rms"])));
    assert!((v_rms - 14.1783).abs() < 0.1, "{v_rms}");
}

#[test]
fn verdicts_say_what_coexists() {
    let four = answer(&json!({"task": "verdict", "parameters": parameters(1e-4, 1e-2, OMEGA_1 + OMEGA_2)}));
    assert_eq!(four["motion"]["kind"], "quasiperiodic");
    let beside = list(&four["coexists"]);
    assert_eq!((beside.len(), &beside[0]["start"]), (1, &json!("forced_motion")));
    assert_eq!(beside[0]["motion"], json!({"kind": "periodic", "periods": 1}));
    assert!((number(&four["forced"]["multiplier"]["modulus"]) - 0.999378).abs() < 1e-6, "{four}");
    let sentence = four["sentence"].as_str().unwrap_or_default();
    for part in ["quasiperiodic", "stable forced motion", "period 1", "dimension"] {
        assert!(sentence.contains(part), "{sentence}");
    }
    let nine = answer(&json!({"task": "verdict", "parameters": parameters(1e-4, 1e-2, 2.0 * OMEGA_1)}));
    assert_eq!(nine["motion"], json!({"kind": "periodic", "periods": 2}));
    assert!((number(&nine["v_rms"]) - 14.1783).abs() < 1e-4, "{nine}");
    assert!(nine["sentence"].as_str().is_some_and(|text| text.starts_with("period 2; 14.1783 V rms; ")));
    // The start is asked about, not only rest.
    let parameters = parameters(1e-4, 1e-2, OMEGA_1 + OMEGA_2);
    let forced = answer(&json!({"task": "orbit", "parameters": parameters}));
    let there = answer(
        &json!({"task": "verdict", "parameters": parameters, "initial": forced["state"], "t_end": 300}),
    );
    assert_eq!(there["motion"], json!({"kind": "periodic", "periods": 1}));
}

#[test]
fn basins_are_indices_into_attractors_that_orbits_confirm() {
    let parameters = parameters(1e-4, 1e-2, 2.0 * OMEGA_1);
    let basin = answer(&json!({
        "task": "basin", "parameters": parameters, "count": 7,
        "x": {"component": "q1", "from": -0.06, "to": 0.1}, "y": {"component": "dq1/dt", "from": -0.3, "to": 0.5},
    }));
    assert_eq!((&basin["x"]["component"], &basin["y"]["component"]), (&json!("q1"), &json!("dq1/dt")));
    let attractors = list(&basin["attractors"]);
    let classes: Vec<_> = attractors.iter().map(|found| found["motion"].as_str().unwrap_or("?")).collect();
    assert_eq!(
        {
            let mut sorted = classes.clone();
            sorted.sort_unstable();
            sorted
        },
        ["escape", "period 2"]
    );
    let sum: f64 = attractors.iter().map(|found| number(&found["fraction"])).sum();
    assert!((sum - 1.0).abs() < 1e-12);
    for (index, attractor) in attractors.iter().enumerate() {
        let cells = list(&basin["cells"]).iter().flat_map(list);
        assert_eq!(cells.filter(|cell| **cell == json!(index)).count() as u64, attractor["cells"]);
        if attractor["motion"] == "period 2" {
            let guess = &attractor["start"];
            let orbit =
                answer(&json!({"task": "orbit", "parameters": parameters, "guess": guess, "periods": 2}));
            assert_eq!((&orbit["periods"], &orbit["stable"]), (&json!(2), &json!(true)));
            assert!((number(&orbit["v_rms"]) / number(&attractor["v_rms"]) - 1.0).abs() < 1e-9);
        } else {
            assert!(attractor["v_rms"].is_null() && attractor["tip"].is_null());
        }
    }
}

#[test]
fn one_mode_has_its_equilibrium_and_the_roots_of_its_cubic() {
    let modes = answer(&json!({"task": "modes", "model": {"modes": 1}}));
    assert!((number(&modes["omega"][0]) / OMEGA_1 - 1.0).abs() < 1e-12, "{modes}");
    let roots = list(&modes["eigenvalues"]);
    assert_eq!(roots.len(), 3);
    // (x^2 + alpha (omega_1^2 - c_1/eta_21) x + omega_1^2)(c x + kappa) + x theta_1^2/eta_21 = 0 by the paper's numbers.
    let (alpha, c1, c, kappa) = (1e-3, 1.3450051225722, 1e-6, 1e-6);
    let (eta2, theta): (f64, f64) = (0.275163559332428, 2.66720397414344e-4);
    let decay = alpha * (OMEGA_1 * OMEGA_1 - c1 / eta2);
    for root in roots {
        let x = nalgebra::Complex::new(number(&root[0]), number(&root[1]));
        let circuit = x * c + kappa;
        let value = (x * x + x * decay + OMEGA_1 * OMEGA_1) * circuit + x * (theta * theta / eta2);
        assert!(value.norm() < 1e-10 * OMEGA_1 * OMEGA_1 * circuit.norm(), "{x}: {value}");
    }
    // c_r = theta^2 (slope at rest less that of mode 1) joins c where it is asked for.
    let with = answer(&json!({"task": "modes", "model": {"modes": 1, "residual_moment": true}}));
    let slope: f64 = 1.0 - 0.25 * c1 / (1.0 + c1 / 3.0);
    let residual = 4e-8 * slope - theta * theta / (eta2 * OMEGA_1 * OMEGA_1);
    assert_eq!(number(&modes["capacitance"]), c);
    assert!((number(&with["capacitance"]) - c - residual).abs() < 1e-12 * c, "{with} {residual}");
}
