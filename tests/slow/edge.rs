//! Requests at the edge of stability and of predictability that were once answered wrongly. The right values are those of
//! runs to t = 20000 closed by Newton's iteration, and of an independent program.

use crate::{answer, list, number};
use serde_json::{Value, json};

fn verdict(parameters: Value, model: Value, more: Value) -> Value {
    let mut request = json!({"task": "verdict", "parameters": parameters, "model": model});
    for (name, value) in more.as_object().into_iter().flatten() {
        request[name] = value.clone();
    }
    answer(&request)
}

/// Asserts a period and a voltage to its printed digits.
fn assert_period(found: &Value, periods: u64, volts: f64, room: f64) {
    assert_eq!(found["motion"], json!({"kind": "periodic", "periods": periods}), "{}", found["sentence"]);
    assert!((number(&found["v_rms"]) / volts - 1.0).abs() < room, "{}", found["sentence"]);
}

#[test]
fn doubled_motions_just_beyond_the_tip_are_neither_chaos_nor_tori() {
    let none = json!({});
    let near = json!({"alpha": 1e-4, "omega": 8.165, "beta": 5e-4});
    for more in [json!({}), json!({"t_end": 1000.0})] {
        let found = verdict(near.clone(), none.clone(), more);
        assert_period(&found, 2, 0.8726, 1e-4);
        assert!((number(&found["multiplier"]["modulus"]) - 0.99853).abs() < 1e-5);
    }
    let found =
        verdict(json!({"alpha": 1e-4, "omega": 8.16, "beta": 5e-4}), none.clone(), json!({"t_end": 2000.0}));
    assert_period(&found, 2, 1.809, 5e-4);
    let start = [
        0.001538494299546727,
        -2.337172584222605e-06,
        -0.0069014421644996785,
        -0.0004468783663115603,
        0.3503189606495872,
    ];
    let found = verdict(
        json!({"alpha": 1e-4, "omega": 8.1569, "beta": 4.255913e-4}),
        none,
        json!({"t_end": 5000.0, "initial": start}),
    );
    assert_period(&found, 2, 0.9689, 1e-4);
}

#[test]
fn a_sweep_across_the_tip_takes_the_motions_that_are_settled() {
    let sweep = |direction: &str| {
        answer(&json!({
            "task": "sweep", "parameter": "omega", "from": 8.12, "to": 8.19, "count": 29, "direction": direction,
            "parameters": {"alpha": 1e-4, "beta": 5e-4},
        }))
    };
    let up = sweep("up");
    for (omega, volts) in [(8.1475, 3.09), (8.155, 2.40), (8.165, 0.873)] {
        let found = list(&up["points"]).iter().find(|point| (number(&point["value"]) - omega).abs() < 1e-9);
        let point = found.expect("the value is visited");
        assert_eq!(point["period"], 2);
        assert!((number(&point["v_rms"]) - volts).abs() < 5e-3, "{omega}: {}", point["v_rms"]);
    }
    for point in &list(&sweep("down")["points"])[..9] {
        assert_eq!(point["period"], 1, "{}", point["value"]);
    }
}

#[test]
fn sweeps_far_from_any_doubling_have_period_1() {
    for (omega, from, to) in [(8.0969, 5e-4, 1.5e-3), (25.5047, 1.6e-3, 3.6e-3)] {
        let found = answer(&json!({
            "task": "sweep", "parameter": "beta", "from": from, "to": to, "count": 11, "direction": "up",
            "parameters": {"alpha": 1e-4, "omega": omega},
        }));
        assert!(list(&found["points"]).iter().all(|point| point["period"] == 1), "{found}");
    }
}

#[test]
fn basins_and_charts_at_the_tip_hold_no_transients() {
    // The forced motion's voltage is that of Newton's iteration along its branch from rest, which follows no start.
    let parameters = json!({"alpha": 1e-4, "omega": 8.1569, "beta": 4.171637e-4});
    let forced = number(&answer(&json!({"task": "orbit", "parameters": parameters}))["v_rms"]);
    for (beta, motions, volts) in [(4.171637e-4, "period 1", forced), (4.255913e-4, "period 2", 0.9689)] {
        let ask = |t_end: f64| {
            answer(&json!({
                "task": "basin", "parameters": {"alpha": 1e-4, "omega": 8.1569, "beta": beta}, "count": 9,
                "t_end": t_end,
            }))
        };
        let found = ask(600.0);
        let attractors = list(&found["attractors"]);
        let names: Vec<_> = attractors.iter().map(|attractor| attractor["motion"].clone()).collect();
        assert_eq!(names, [json!("escape"), json!(motions)], "beta {beta}");
        assert!((number(&attractors[1]["v_rms"]) - volts).abs() < 5e-5, "{}", attractors[1]);
        assert_eq!(found, ask(5000.0));
    }
    // Just below the doubling the forced motion attracts by 6e-6 a period: what takes a million of them to arrive is undecided.
    let ask = |t_end: f64| {
        answer(&json!({
            "task": "basin", "parameters": {"alpha": 1e-4, "omega": 8.1569, "beta": 4.209561e-4}, "count": 5, "t_end": t_end,
        }))
    };
    let found = ask(600.0);
    for attractor in list(&found["attractors"]) {
        let motion = &attractor["motion"];
        assert!(["escape", "period 1", "undecided"].iter().any(|allowed| motion == allowed), "{attractor}");
    }
    assert_eq!(found, ask(5000.0));
    let chart = answer(&json!({
        "task": "chart", "quantity": "motion", "parameters": {"alpha": 1e-4},
        "omega": {"from": 8.12, "to": 8.19, "count": 15}, "beta": {"from": 3e-4, "to": 9e-4, "count": 13},
    }));
    let cells = || list(&chart["values"]).iter().flat_map(list);
    assert!(cells().all(|cell| cell == "period 1" || cell == "period 2"), "{chart}");
    assert!(cells().any(|cell| cell == "period 2"));
}

#[test]
fn what_rounding_decides_is_said_with_all_its_ends() {
    let exact = json!({"force": "exact"});
    let found = verdict(
        json!({"alpha": 4.344856870884249e-05, "beta": 0.04988850711542829, "omega": 8.841375703469955}),
        exact.clone(),
        json!({}),
    );
    assert_period(&found, 2, 54.806, 1e-4);
    // Transient chaos: at one end or the other, whatever the time that is shown.
    let parameters =
        json!({"alpha": 6.175938891942644e-5, "beta": 0.03999038403910635, "omega": 6.671335500357711});
    let found = verdict(parameters, exact, json!({}));
    assert_eq!(found["motion"]["why"], "depends_on_rounding", "{}", found["sentence"]);
    let mut ends = vec![number(&found["v_rms"])];
    ends.extend(list(&found["coexists"]).iter().map(|other| number(&other["v_rms"])));
    for expected in [22.27, 31.97] {
        assert!(ends.iter().any(|volts| (volts / expected - 1.0).abs() < 1e-3), "{ends:?}");
    }
    // By way of chaos onto a torus, where another integrator ends at period 9: 33.3756 V.
    let parameters =
        json!({"alpha": 8.930061783998469e-5, "beta": 0.04694471748786639, "omega": 6.561403904158967});
    let found = verdict(parameters, json!({"force": "exact"}), json!({}));
    assert_eq!(found["motion"]["why"], "depends_on_rounding", "{}", found["sentence"]);
    assert_eq!(found["suspected"]["kind"], "quasiperiodic");
    // Hardly any load: the transient takes a million of time units, and nothing is claimed before.
    let found = verdict(
        json!({"alpha": 1e-4, "beta": 0.02458893585682749, "omega": 7.530165700084426, "kappa": 1e-12}),
        json!({"modes": 3, "force": {"taylor": 3}}),
        json!({}),
    );
    assert_eq!(found["motion"]["kind"], "undecided", "{}", found["sentence"]);
    assert!((number(&found["v_rms"]) / 65.70 - 1.0).abs() < 0.01, "{}", found["v_rms"]);
}

#[test]
fn tori_of_three_modes_are_decided_and_their_basins_agree() {
    for (omega, beta) in [(25.381818, 0.020), (25.427273, 0.012), (25.5636, 0.008)] {
        let parameters = json!({"alpha": 1e-4, "omega": omega, "beta": beta});
        let model = json!({"modes": 3, "force": "exact"});
        let found = verdict(parameters.clone(), model.clone(), json!({}));
        assert_eq!(found["motion"]["kind"], "quasiperiodic", "{}", found["sentence"]);
        assert!(number(&found["rotation"]["error"]) < 1e-8, "{}", found["rotation"]);
        let side = |component: &str| json!({"component": component, "from": 0.0, "to": 1e-9});
        let basin = answer(&json!({
            "task": "basin", "parameters": parameters, "model": model, "count": 2, "x": side("q1"), "y": side("v"),
        }));
        let attractors = list(&basin["attractors"]);
        assert_eq!(
            (attractors.len(), &attractors[0]["motion"]),
            (1, &json!("quasiperiodic")),
            "{attractors:?}"
        );
        assert!((number(&attractors[0]["v_rms"]) / number(&found["v_rms"]) - 1.0).abs() < 1e-3);
    }
}

/// The rotation number of Figure 4's torus by another way: the angle about the centre of the closed curve of stroboscopic
/// points, which the curve goes around once, averaged with the weight exp(-1/(x (1 - x))).
#[test]
fn the_torus_of_figure_4_turns_as_its_angle_says() {
    let parameters = json!({"alpha": 1e-4, "beta": 0.01, "omega": 25.4047});
    let found = verdict(parameters.clone(), json!({}), json!({}));
    let period = std::f64::consts::TAU / 25.4047;
    let count = 20_001;
    let run = answer(&json!({
        "task": "simulate", "parameters": parameters, "t_end": period * (count - 1) as f64, "samples": count,
        "tolerance": 1e-8,
    }));
    // Without the transient; displacement and velocity of mode 1, which vibrates at the torus' own frequency.
    let points: Vec<[f64; 2]> = list(&run["state"])[8000..]
        .iter()
        .map(|state| [number(&state[0]), number(&state[2]) / 4.05])
        .collect();
    let centre = [0, 1].map(|i| points.iter().map(|point| point[i]).sum::<f64>() / points.len() as f64);
    let angle = |point: &[f64; 2]| (point[1] - centre[1]).atan2(point[0] - centre[0]);
    let (mut sum, mut total) = (0.0, 0.0);
    for (k, pair) in points.windows(2).enumerate() {
        let turn = (angle(&pair[1]) - angle(&pair[0])) / std::f64::consts::TAU;
        let x = (k + 1) as f64 / points.len() as f64;
        let weight = (-1.0 / (x * (1.0 - x))).exp();
        sum += weight * turn.rem_euclid(1.0);
        total += weight;
    }
    let turns = sum / total;
    let turns = turns.min(1.0 - turns);
    assert!((number(&found["rotation"]["number"]) - turns).abs() < 1e-8, "{} {turns}", found["rotation"]);
}
