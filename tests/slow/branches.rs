//! The tasks `continue` and `curves` against independent values, and against the tasks that ask the same elsewhere.

use crate::{OMEGA_1, answer, list, number};
use harvester_lab::model::{ForceLaw, ParameterSet, Parameters, ReducedSystem};
use harvester_lab::theory::LinearResponse;
use serde_json::{Value, json};

/// Entries of a list whose `field` is this.
fn those<'a>(all: &'a Value, field: &'a str, is: &'a str) -> impl Iterator<Item = &'a Value> {
    list(all).iter().filter(move |entry| entry[field] == is)
}

fn at(entry: &Value) -> [f64; 2] {
    [number(&entry["at"][0]), number(&entry["at"][1])]
}

fn close(found: [f64; 2], expected: [f64; 2], tolerance: [f64; 2]) -> bool {
    (0..2).all(|i| (found[i] - expected[i]).abs() < tolerance[i])
}

fn window(omega: [f64; 2], beta: [f64; 2], parameters: &Value) -> Value {
    json!({
        "task": "curves", "parameters": parameters,
        "x": {"parameter": "omega", "from": omega[0], "to": omega[1]},
        "y": {"parameter": "beta", "from": beta[0], "to": beta[1]},
    })
}

#[test]
fn the_first_tongue_turns_where_its_criticality_is_known_to() {
    let found = answer(&window([7.8, 8.5], [0.0, 0.004], &json!({"alpha": 1e-4})));
    assert_eq!((list(&found["failed"]).len(), found.get("missing")), (0, None), "{found}");
    let doublings: Vec<&Value> = those(&found["curves"], "kind", "period_doubling").collect();
    let [curve] = doublings[..] else { panic!("{} curves", doublings.len()) };
    let turn = those(&curve["special"], "kind", "generalized_period_doubling").next().expect("a turn");
    assert!(close(at(turn), [8.156415, 4.21207e-4], [1e-6, 1e-9]), "{turn}");
    assert_eq!(turn["criticality"], json!(["subcritical", "supercritical"]));
    for point in list(&curve["points"]) {
        let expected = if at(point)[0] < 8.1564 { "subcritical" } else { "supercritical" };
        assert_eq!(point["criticality"], expected, "{point}");
    }
    // The lowest unstable excitation at the same frequencies, and the motion there.
    for point in list(&curve["points"]).iter().step_by(7) {
        let [omega, beta] = at(point);
        let parameters = json!({"alpha": 1e-4, "omega": omega, "beta": beta});
        let boundary = answer(&json!({
            "task": "boundary", "theory": "floquet", "resonance": "first", "parameters": parameters,
            "omega": [omega],
        }));
        assert!((number(&boundary["beta"][0]) - beta).abs() < 1e-8, "{point} {boundary}");
        let orbit = answer(&json!({"task": "orbit", "parameters": parameters, "guess": point["state"]}));
        assert!((number(&orbit["v_rms"]) - number(&point["v_rms"])).abs() < 1e-9, "{point} {orbit}");
        let multipliers = list(&orbit["multipliers"]).iter();
        let nearest = multipliers.map(|mu| (number(&mu[0]) + 1.0).hypot(number(&mu[1])));
        assert!(nearest.fold(f64::INFINITY, f64::min) < 1e-6, "{orbit}");
    }
}

#[test]
fn two_resonances_lie_on_the_curve_of_doublings() {
    let found = answer(&window([6.0, 10.0], [0.0, 0.1], &json!({"alpha": 1e-4})));
    let doublings = those(&found["curves"], "kind", "period_doubling");
    let resonances: Vec<&Value> =
        doublings.flat_map(|curve| those(&curve["special"], "kind", "one_to_two")).collect();
    assert_eq!(resonances.len(), 2, "{resonances:?}");
    for expected in [[8.461662, 0.078580], [8.503841, 0.077610]] {
        let met = resonances.iter().any(|point| close(at(point), expected, [1e-6, 1e-6]));
        assert!(met, "{expected:?}: {resonances:?}");
        // A curve of tori ends in each.
        let ends = |curve: &&Value| {
            let points = list(&curve["points"]);
            let met = [points.first(), points.last()].into_iter().flatten();
            met.zip(list(&curve["ends"])).any(|(point, end)| {
                close(at(point), expected, [1e-5, 1e-5])
                    && *end == json!({"kind": "meeting", "special": "one_to_two"})
            })
        };
        assert!(those(&found["curves"], "kind", "neimark_sacker").any(|curve| ends(&curve)), "{expected:?}");
    }
}

#[test]
fn doubled_motions_are_searched_where_that_is_asked_for() {
    let mut request = window([7.6, 8.8], [0.0, 0.03], &json!({"alpha": 1e-4}));
    request["lines"] = json!(2);
    let periods = |found: &Value| {
        let mut periods: Vec<u64> =
            list(&found["curves"]).iter().filter_map(|curve| curve["periods"].as_u64()).collect();
        periods.dedup();
        periods.sort_unstable();
        periods.dedup();
        periods
    };
    assert_eq!(periods(&answer(&request)), [1]);
    request["doubled"] = json!(true);
    let found = answer(&request);
    assert_eq!(periods(&found), [1, 2]);
    // The folds of the doubled motions end where the doubling turns supercritical.
    let folds = those(&found["curves"], "kind", "fold").filter(|curve| curve["periods"] == 2);
    let turn = json!({"kind": "meeting", "special": "generalized_period_doubling"});
    let mut met = 0;
    for curve in folds {
        let points = list(&curve["points"]);
        let ends = list(&curve["ends"]).iter().zip([points.first(), points.last()]);
        for point in ends.filter(|(end, _)| **end == turn).filter_map(|(_, point)| point) {
            // Its numbers are its own: those of the orbit that Newton's iteration finds there.
            let parameters = json!({"alpha": 1e-4, "omega": point["at"][0], "beta": point["at"][1]});
            let orbit = answer(
                &json!({"task": "orbit", "parameters": parameters, "guess": point["state"], "periods": 2}),
            );
            let ratio = number(&point["v_rms"]) / number(&orbit["v_rms"]);
            assert!((ratio - 1.0).abs() < 1e-3, "{point} {orbit}");
            met += 1;
        }
    }
    assert!(met > 0, "{}", found["failed"]);
}

/// Figure 9's device along beta.
fn along_beta(more: Value) -> Value {
    let mut request = json!({
        "task": "continue", "parameter": "beta", "from": 1e-5, "to": 0.01,
        "parameters": {"alpha": 1e-4, "beta": 0.01, "omega": 2.0 * OMEGA_1},
    });
    let fields = request.as_object_mut().expect("an object");
    fields.extend(more.as_object().expect("an object").clone());
    request
}

#[test]
fn the_branches_of_figure_9_are_those_known() {
    let found = answer(&along_beta(json!({"doublings": 1})));
    let [forced, doubled] = list(&found["branches"]) else { panic!("{found}") };
    let range = json!({"kind": "range"});
    assert_eq!((&forced["periods"], &forced["begin"], &forced["end"]), (&json!(1), &range, &range));
    let birth = &forced["bifurcations"][0];
    assert!((number(&birth["value"]) - 0.001628).abs() < 1e-6, "{birth}");
    assert_eq!(birth["value"], birth["beta"]);
    assert_eq!((&birth["kind"], &birth["criticality"]), (&json!("period_doubling"), &json!("subcritical")));
    let begin = json!({"kind": "branch_point", "value": birth["value"], "branch": 0});
    assert_eq!((&doubled["periods"], &doubled["begin"], &doubled["end"]), (&json!(2), &begin, &range));
    let fold = &doubled["bifurcations"][0];
    assert_eq!(
        (&fold["kind"], &fold["criticality"], &fold["coefficient"]),
        (&json!("fold"), &Value::Null, &Value::Null)
    );
    for branch in [forced, doubled] {
        let change = &branch["bifurcations"][0];
        let after = change["after"].as_u64().unwrap_or_default() as usize;
        for (i, point) in list(&branch["points"]).iter().enumerate() {
            // The forced motion loses its stability at the doubling, the doubled one gets it at the fold.
            let stable = (i < after) == (branch["periods"] == 1);
            assert_eq!(point["stable"], stable, "{i} {point}");
            assert_eq!(point["instability"].is_null(), stable);
            assert_eq!(number(&point["multiplier"]) < 1.0, stable);
            let argument = number(&point["argument"]);
            assert!((0.0..=std::f64::consts::PI).contains(&argument), "{point}");
        }
    }
    let last = list(&doubled["points"]).last().expect("points");
    assert!(last["value"] == 0.01 && (number(&last["v_rms"]) - 14.1783).abs() < 1e-4, "{last}");
}

/// What stands under the same names in both.
fn same_measures(point: &Value, other: &Value, names: &[&str], tolerance: f64) {
    for name in names {
        let pairs: Vec<(f64, f64)> = match &point[name] {
            Value::Array(values) => {
                values.iter().zip(list(&other[name])).map(|(a, b)| (number(a), number(b))).collect()
            }
            value => vec![(number(value), number(&other[name]))],
        };
        assert!(!pairs.is_empty());
        for (a, b) in pairs {
            assert!((a - b).abs() <= tolerance * b.abs().max(1e-3), "{name}: {point} {other}");
        }
    }
}

#[test]
fn measures_on_branches_are_those_of_orbits_and_of_sweeps() {
    let (from, to, count) = (8.0, 8.4, 5);
    let parameters = json!({"alpha": 1e-4, "beta": 0.002});
    let sweep = answer(&json!({
        "task": "sweep", "parameters": parameters, "parameter": "omega", "from": from, "to": to,
        "count": count, "branches": true,
    }));
    let request =
        json!({"task": "continue", "parameters": parameters, "parameter": "omega", "from": from, "to": to});
    let found = answer(&request);
    let mut stable = 0;
    for branch in list(&found["branches"]) {
        let periods = &branch["periods"];
        for point in list(&branch["points"]).iter().step_by(6) {
            let parameters = json!({"alpha": 1e-4, "beta": 0.002, "omega": point["value"]});
            let orbit = answer(&json!({
                "task": "orbit", "parameters": parameters, "guess": point["state"], "periods": periods,
            }));
            assert_eq!(
                (&orbit["periods"], &orbit["stable"], &orbit["instability"]),
                (periods, &point["stable"], &point["instability"])
            );
            same_measures(point, &orbit, &["v_rms", "power", "tip"], 1e-7);
            let (re, im) = (number(&orbit["multipliers"][0][0]), number(&orbit["multipliers"][0][1]));
            assert!((number(&point["multiplier"]) - re.hypot(im)).abs() < 1e-7, "{point} {orbit}");
            assert!((number(&point["argument"]) - im.atan2(re).abs()).abs() < 1e-4, "{point} {orbit}");
            if point["stable"] == true {
                stable += 1;
                let verdict = answer(&json!({
                    "task": "verdict", "parameters": parameters, "initial": point["state"],
                }));
                same_measures(point, &verdict, &["v_rms", "v_peak", "power", "slope"], 1e-6);
            }
        }
    }
    assert!(stable > 3, "{stable}");
    // The page's curves, which a sweep gives, have the same points.
    let curves = list(&sweep["branches"]);
    assert_eq!(curves.len(), list(&found["branches"]).len());
    for (branch, curve) in list(&found["branches"]).iter().zip(curves) {
        assert_eq!((&branch["periods"], &branch["cut"]), (&curve["periods"], &curve["cut"]));
        let (points, others) = (list(&branch["points"]), list(&curve["points"]));
        assert_eq!(points.len(), others.len());
        for (point, other) in points.iter().zip(others) {
            for (name, value) in other.as_object().expect("a point") {
                assert_eq!(&point[name], value, "{name}");
            }
        }
        for (found, change) in list(&branch["bifurcations"]).iter().zip(list(&curve["changes"])) {
            assert_eq!((&found["kind"], &found["value"]), (&change["kind"], &change["point"]["value"]));
        }
    }
    // What the sweep reached lies on a stable branch: a motion continued from there passes it again.
    for point in list(&sweep["points"]) {
        let mut request = request.clone();
        request["parameters"] = json!({"alpha": 1e-4, "beta": 0.002, "omega": point["value"]});
        request["doublings"] = json!(0);
        request["initial"] = json!([0, 0, 0, 0, 0]);
        let found = answer(&request);
        let [branch] = list(&found["branches"]) else { panic!("{found}") };
        assert_eq!(branch["periods"], point["period"], "{point}");
        let there = |other: &&Value| number(&other["value"]) == number(&point["value"]);
        let passed = list(&branch["points"]).iter().find(there).expect("its start");
        same_measures(passed, point, &["v_rms", "v_peak", "power", "tip", "slope"], 1e-6);
    }
}

#[test]
fn a_motion_given_is_followed_both_ways() {
    let known = answer(&along_beta(json!({"doublings": 1})));
    let (fold, last) = (
        &known["branches"][1]["bifurcations"][0],
        list(&known["branches"][1]["points"]).last().expect("points"),
    );
    // From a point of it that is not stable, by Newton's iteration, and from rest at its end, which leads there.
    let middle = &known["branches"][1]["points"][5];
    assert_eq!(middle["stable"], false);
    for given in [
        json!({
            "guess": middle["state"], "periods": 4,
            "parameters": {"alpha": 1e-4, "beta": middle["value"], "omega": 2.0 * OMEGA_1},
        }),
        json!({"initial": [0, 0, 0, 0, 0]}),
    ] {
        let found = answer(&along_beta(given));
        let [branch] = list(&found["branches"]) else { panic!("{found}") };
        assert_eq!(branch["periods"], 2);
        let ends = [&branch["begin"], &branch["end"]];
        let point = ends.iter().find(|end| end["kind"] == "branch_point").expect("the doubling");
        assert!(
            (number(&point["value"]) - number(&known["branches"][0]["bifurcations"][0]["value"])).abs()
                < 1e-8,
            "{point}"
        );
        assert!(ends.iter().any(|end| **end == json!({"kind": "range"})), "{ends:?}");
        let [turn] = list(&branch["bifurcations"]) else { panic!("{}", branch["bifurcations"]) };
        assert!(
            turn["kind"] == "fold" && (number(&turn["value"]) - number(&fold["value"])).abs() < 1e-9,
            "{turn} {fold}"
        );
        let after = turn["after"].as_u64().unwrap_or_default() as usize;
        let points = list(&branch["points"]);
        assert_ne!(points[after - 1]["stable"], points[after]["stable"]);
        let stable = |points: &[Value]| points.iter().all(|point| point["stable"] == points[0]["stable"]);
        assert!(stable(&points[..after]) && stable(&points[after..]));
        // Neighbours are near each other all along: the two ways meet in the motion given.
        for pair in points.windows(2) {
            assert!((number(&pair[0]["v_rms"]) - number(&pair[1]["v_rms"])).abs() < 0.5, "{pair:?}");
        }
        let at_end =
            [points.first(), points.last()].into_iter().flatten().find(|point| point["value"] == 0.01);
        same_measures(
            at_end.expect("the end of the range"),
            last,
            &["v_rms", "v_peak", "power", "tip", "slope"],
            1e-8,
        );
    }
}

#[test]
fn each_of_the_ten_numbers_can_be_followed_and_its_doublings_are_boundaries() {
    for (parameter, from, to) in [
        ("alpha", 0.0, 2e-4),
        ("beta", 0.0, 2e-3),
        ("omega", 8.3, 8.5),
        ("c0", 0.4, 0.6),
        ("d", 0.14, 0.16),
        ("h", 0.003, 0.005),
        ("eta", 0.0, 0.03),
        ("c", 5e-7, 2e-6),
        ("kappa", 1e-8, 2e-6),
        ("theta", 0.0, 4e-4),
    ] {
        let parameters = json!({"alpha": 1e-4, "beta": 1e-3, "omega": 8.4});
        let found = answer(&json!({
            "task": "continue", "parameter": parameter, "from": from, "to": to, "parameters": parameters,
            "model": {"force": "exact"}, "doublings": 0,
        }));
        let [branch] = list(&found["branches"]) else { panic!("{parameter}: {found}") };
        assert_eq!((&branch["end"]["kind"], &branch["cut"]), (&json!("range"), &json!(false)), "{parameter}");
        let values = [list(&branch["points"]).first(), list(&branch["points"]).last()];
        assert_eq!(values.map(|point| point.map(|point| number(&point["value"]))), [Some(from), Some(to)]);
        for found in those(&branch["bifurcations"], "kind", "period_doubling") {
            let mut there = parameters.clone();
            there[parameter] = found["value"].clone();
            let boundary = answer(&json!({
                "task": "boundary", "theory": "floquet", "resonance": "first", "parameters": there,
                "model": {"force": "exact"}, "omega": [there["omega"]],
            }));
            let beta = number(&boundary["beta"][0]);
            assert!((beta / number(&there["beta"]) - 1.0).abs() < 1e-6, "{parameter}: {found} {boundary}");
        }
    }
}

/// The first branch over the frequency in a window, and what leaves it.
fn over_frequency([from, to]: [f64; 2], parameters: &Value) -> Value {
    let mut request =
        json!({"task": "continue", "parameter": "omega", "from": from, "to": to, "parameters": parameters});
    request["parameters"]["omega"] = json!(from);
    answer(&request)
}

#[test]
fn a_wide_window_steps_over_no_peak_of_the_linear_device() {
    for alpha in [1e-3, 1e-5] {
        let parameters = json!({"c0": 0.0, "alpha": alpha, "beta": 1e-5});
        let found = over_frequency([0.5, 100.0], &parameters);
        let at = |omega: f64| {
            let set = ParameterSet { c0: 0.0, alpha, beta: 1e-5, omega, ..Default::default() };
            ReducedSystem::new(Parameters::new(set).expect("in range"), 2, ForceLaw::Exact).expect("a system")
        };
        let voltage = |omega: f64| {
            LinearResponse::new(&at(omega)).expect("damped").voltage_harmonic().root_mean_square()
        };
        let points = list(&found["branches"][0]["points"]);
        for point in points {
            let (omega, v_rms) = (number(&point["value"]), number(&point["v_rms"]));
            assert!((v_rms / voltage(omega) - 1.0).abs() < 1e-5, "{alpha} {omega}: {v_rms}");
        }
        for mode in at(10.0).modes.iter() {
            let near = |omega: f64| (omega / mode.omega - 1.0).abs() < 0.05;
            let highest = points.iter().filter(|point| near(number(&point["value"])));
            let highest = highest.map(|point| number(&point["v_rms"])).fold(0.0, f64::max);
            let peak = (-10_000..=10_000).map(|k| voltage(mode.omega * (1.0 + 5e-6 * f64::from(k))));
            let peak = peak.fold(0.0, f64::max);
            assert!(highest > 0.95 * peak, "{alpha} mode at {}: {highest} of {peak}", mode.omega);
        }
    }
}

#[test]
fn doublings_do_not_depend_on_the_window() {
    // The smallest is 2 % above what opens the tongue.
    for (alpha, beta) in [(1e-4, 4.3e-4), (1e-4, 8e-4), (1e-3, 2e-3)] {
        let parameters = json!({"alpha": alpha, "beta": beta});
        let doublings = |window: [f64; 2]| -> Vec<f64> {
            let found = over_frequency(window, &parameters);
            let all = &found["branches"][0]["bifurcations"];
            let values = those(all, "kind", "period_doubling").map(|doubling| number(&doubling["value"]));
            values.filter(|omega| (7.9..8.4).contains(omega)).collect()
        };
        let near = doublings([8.0, 8.3]);
        assert_eq!(near.len(), 2, "{alpha} {beta}: {near:?}");
        for window in [[5.0, 12.0], [1.0, 45.0], [0.5, 100.0]] {
            let far = doublings(window);
            let same = far.len() == 2 && near.iter().zip(&far).all(|(a, b)| (a - b).abs() < 1e-6);
            assert!(same, "{alpha} {beta} {window:?}: {far:?} for {near:?}");
        }
    }
}

#[test]
fn nor_do_tori_at_the_sum_of_two_frequencies() {
    let tori = |window: [f64; 2]| -> Vec<f64> {
        let found = over_frequency(window, &json!({"alpha": 1e-4, "beta": 6e-3}));
        let branches = list(&found["branches"]).iter();
        let all = branches.flat_map(|branch| those(&branch["bifurcations"], "kind", "neimark_sacker"));
        let mut omegas: Vec<f64> = all.map(|torus| number(&torus["value"])).collect();
        omegas.retain(|omega| (25.0..26.0).contains(omega));
        // A branch may be followed from its high end.
        omegas.sort_by(f64::total_cmp);
        omegas
    };
    let near = tori([25.0, 26.0]);
    assert_eq!(near.len(), 2, "{near:?}");
    for window in [[19.0, 32.0], [24.0, 45.0]] {
        let far = tori(window);
        let same = far.len() == 2 && near.iter().zip(&far).all(|(a, b)| (a - b).abs() < 1e-6);
        assert!(same, "{window:?}: {far:?} for {near:?}");
    }
}

#[test]
fn what_would_take_too_long_is_cut_and_said_to_be() {
    let found = answer(&json!({
        "task": "continue", "parameter": "omega", "from": 1.0, "to": 200.0, "model": {"modes": 1, "force": "exact"},
        "parameters": {"c": 0.01, "kappa": 0.01, "beta": 0.2, "alpha": 0.00162},
    }));
    let cut = list(&found["branches"]).iter().filter(|branch| branch["cut"] == true).count();
    assert!(cut > 0, "{}", found["missing"]);
    assert!(
        found["missing"].as_str().is_some_and(|why| why.contains("not followed to their ends")),
        "{}",
        found["missing"]
    );
}

#[test]
fn an_isola_is_followed_from_a_motion_on_it_and_closes() {
    let parameters = json!({"alpha": 1e-4, "beta": 0.01, "omega": 15});
    let request = json!({
        "task": "continue", "parameter": "omega", "from": 14, "to": 16, "parameters": parameters,
        "model": {"force": "exact"}, "initial": [0, 0, 0, 0, 0],
    });
    let found = answer(&request);
    let [branch] = list(&found["branches"]) else { panic!("{found}") };
    let closed = json!({"kind": "closed"});
    assert_eq!((&branch["periods"], &branch["begin"], &branch["end"]), (&json!(7), &closed, &closed));
    let points = list(&branch["points"]);
    let (first, last) = (&points[0], &points[points.len() - 1]);
    assert_eq!((number(&first["value"]), number(&last["value"])), (15.0, 15.0));
    same_measures(first, last, &["v_rms", "v_peak", "power", "tip", "slope", "multiplier"], 1e-6);
    // Once around: a stable and an unstable side between two folds, and nothing beyond these.
    let folds: Vec<f64> =
        those(&branch["bifurcations"], "kind", "fold").map(|fold| number(&fold["value"])).collect();
    assert_eq!((folds.len(), list(&branch["bifurcations"]).len()), (2, 2), "{folds:?}");
    let (low, high) = (folds[0].min(folds[1]), folds[0].max(folds[1]));
    for point in points {
        let value = number(&point["value"]);
        assert!((low - 1e-7..high + 1e-7).contains(&value), "{value} {folds:?}");
    }
    let sides = points.windows(2).filter(|pair| pair[0]["stable"] != pair[1]["stable"]).count();
    assert_eq!(sides, 2);
    // At each fold a run of the motion repeats after seven periods, and one multiplier is 1.
    for fold in list(&branch["bifurcations"]) {
        let there = json!({"alpha": 1e-4, "beta": 0.01, "omega": fold["value"]});
        let run = answer(&json!({
            "task": "simulate", "parameters": there, "model": {"force": "exact"}, "initial": fold["state"],
            "t_end": 7.0 * std::f64::consts::TAU / number(&fold["value"]), "samples": 2, "tolerance": 1e-10,
        }));
        for (a, b) in list(&run["state"][1]).iter().zip(list(&fold["state"])) {
            assert!((number(a) - number(b)).abs() < 1e-6 * number(b).abs().max(0.1), "{run} {fold}");
        }
        assert!((number(&fold["multiplier"]) - 1.0).abs() < 1e-4, "{fold}");
    }
    // From the other side, by Newton's iteration, it is the same.
    let unstable = points.iter().find(|point| point["stable"] == false).expect("an unstable side");
    let mut request = request.clone();
    request["initial"] = Value::Null;
    request["guess"] = unstable["state"].clone();
    request["periods"] = json!(7);
    request["parameters"]["omega"] = unstable["value"].clone();
    let again = answer(&request);
    assert_eq!((list(&again["branches"]).len(), &again["branches"][0]["end"]), (1, &closed));
    for fold in folds {
        let mut others = list(&again["branches"][0]["bifurcations"]).iter();
        assert!(others.any(|other| (number(&other["value"]) - fold).abs() < 1e-7), "{fold}");
    }
}

/// The bifurcations of the branches of a request, each with its kind, value and criticality.
fn bifurcations(request: &Value) -> Vec<(String, f64, Value)> {
    let found = answer(request);
    let branches = list(&found["branches"]).iter();
    let all = branches.flat_map(|branch| list(&branch["bifurcations"]).iter());
    all.map(|found| {
        let kind = found["kind"].as_str().unwrap_or_default().to_owned();
        (kind, number(&found["value"]), found["criticality"].clone())
    })
    .collect()
}

#[test]
fn a_doubling_with_nearly_no_damping_is_found_and_judged_alike_from_every_window() {
    // det(M + I) = 0 by bisection on derivatives of another integrator: 7.817199150. The pair meets on the axis only 1e-9 before.
    for window in [[7.81, 7.83], [7.8, 8.0], [7.8, 8.4], [7.7, 8.4]] {
        let found = bifurcations(&json!({
            "task": "continue", "parameter": "omega", "from": window[0], "to": window[1],
            "parameters": {"alpha": 1e-6, "theta": 0, "beta": 0.01}, "model": {"modes": 1, "force": "exact"},
        }));
        let [(kind, value, criticality)] = &found[..] else { panic!("{window:?}: {found:?}") };
        assert_eq!((kind.as_str(), criticality), ("period_doubling", &json!("supercritical")), "{window:?}");
        assert!((value - 7.817199150).abs() < 2e-9, "{window:?}: {value}");
    }
}

#[test]
fn the_forced_motion_of_the_high_end_is_followed_though_another_branch_arrives_there() {
    // From the low end the branch climbs the bent peak and arrives at the high one on its upper side.
    let found = answer(&json!({
        "task": "continue", "parameter": "omega", "from": 3.5, "to": 5,
        "parameters": {"alpha": 1e-4, "beta": 0.001}, "model": {"force": "exact"},
    }));
    let swings: Vec<f64> = list(&found["branches"])
        .iter()
        .filter(|branch| branch["periods"] == 1)
        .flat_map(|branch| list(&branch["points"]))
        .filter(|point| number(&point["value"]) == 5.0)
        .map(|point| number(&point["tip"][1]))
        .collect();
    // Of the linear device near 5: a few thousandths of the beam's length.
    let small = swings.iter().filter(|swing| **swing < 0.006).count();
    let large = swings.iter().filter(|swing| **swing > 0.3).count();
    assert!(small >= 1 && large >= 1, "{swings:?}");
}

/// Every change of stability between two points of a branch has a bifurcation there.
fn changes_are_told(found: &Value, of: &dyn std::fmt::Debug) {
    for branch in list(&found["branches"]) {
        let told: Vec<f64> =
            list(&branch["bifurcations"]).iter().map(|bifurcation| number(&bifurcation["after"])).collect();
        for (after, pair) in list(&branch["points"]).windows(2).enumerate() {
            let silent = pair[0]["stable"] != pair[1]["stable"] && !told.contains(&(after as f64 + 1.0));
            let [from, to] =
                [&pair[0], &pair[1]].map(|point| (number(&point["value"]), number(&point["multiplier"])));
            assert!(!silent, "{of:?}: {from:?} to {to:?}, {told:?}");
        }
    }
}

#[test]
fn no_stability_changes_in_silence_where_there_is_nearly_no_damping() {
    // From wherever the window begins: the steps fall elsewhere.
    for (index, from) in [7.6, 7.7, 7.75, 7.8].into_iter().enumerate() {
        for beta in [0.002, 0.004, 0.006, 0.008, 0.01] {
            let found = answer(&json!({
                "task": "continue", "parameter": "omega", "from": from, "to": 8.09, "doublings": 0,
                "parameters": {"alpha": 5e-7, "theta": 0, "beta": beta}, "model": {"modes": 1, "force": "exact"},
            }));
            changes_are_told(&found, &(from, beta));
            let doublings = those(&found["branches"][0]["bifurcations"], "kind", "period_doubling").count();
            assert_eq!(doublings, 1, "{from} {beta}");
        }
        let found = answer(&json!({
            "task": "continue", "parameter": "omega", "from": 3.5 + 0.05 * index as f64, "to": 4.6, "doublings": 0,
            "parameters": {"alpha": 1e-6, "theta": 0, "beta": 0.002},
        }));
        changes_are_told(&found, &index);
        let folds: Vec<f64> = those(&found["branches"][0]["bifurcations"], "kind", "fold")
            .map(|fold| number(&fold["value"]))
            .collect();
        // Where another implementation of the continuation turns back.
        assert!(folds.len() == 1 && (folds[0] - 3.853395).abs() < 1e-5, "{folds:?}");
    }
    // Along another number, with four modes.
    for (from, to) in [(0.236, 0.238), (0.22, 0.25), (0.0, 0.24)] {
        let found = answer(&json!({
            "task": "continue", "parameter": "eta", "from": from, "to": to, "doublings": 0,
            "parameters": {"alpha": 2.524403923961825e-6, "beta": 0.003101710393628818, "omega": 17.94373697606927,
                "theta": 5.287957244448741e-6},
            "model": {"modes": 4, "force": "exact"},
        }));
        changes_are_told(&found, &(from, to));
        let doublings = those(&found["branches"][0]["bifurcations"], "kind", "period_doubling");
        let values: Vec<f64> = doublings.map(|doubling| number(&doubling["value"])).collect();
        assert!(values.iter().any(|value| (value - 0.2370306).abs() < 1e-6), "{from} {to}: {values:?}");
    }
}

#[test]
fn an_open_tongue_is_crossed_in_few_steps() {
    let found = answer(&json!({
        "task": "continue", "parameter": "omega", "from": 7.8, "to": 8.4, "doublings": 0,
        "parameters": {"alpha": 1e-4, "theta": 0, "beta": 0.01}, "model": {"modes": 1, "force": "exact"},
    }));
    let branch = &found["branches"][0];
    assert_eq!(branch["end"]["kind"], "range");
    assert!(list(&branch["points"]).len() < 150, "{}", list(&branch["points"]).len());
}

#[test]
fn a_correction_that_goes_astray_does_not_lose_the_branch() {
    // The voltage falls to half within a ten-thousandth of this range.
    let found = answer(&json!({
        "task": "continue", "parameter": "c", "from": 1e-8, "to": 1e-4,
        "parameters": {"kappa": 2.019172441589038e-7}, "model": {"modes": 1},
    }));
    let [branch] = list(&found["branches"]) else { panic!("{found}") };
    assert_eq!(branch["end"]["kind"], "range");
    let points = list(&branch["points"]);
    assert_eq!((number(&points[0]["value"]), number(&points[points.len() - 1]["value"])), (1e-8, 1e-4));
}

#[test]
fn a_doubled_branch_is_none_of_the_orbits_that_double() {
    // Next to this doubling the parameter moves the orbit itself along the direction in which the doubled one leaves it.
    let found = answer(&json!({
        "task": "continue", "parameter": "c0", "from": 0.01, "to": 2, "doublings": 1,
        "parameters": {"alpha": 0.0003749913730785348, "beta": 0.00044355481610882166, "omega": 4.051751497845853,
            "kappa": 1e-9, "theta": 1e-5},
        "model": {"modes": 2, "force": "exact"},
    }));
    let doubled: Vec<&Value> =
        list(&found["branches"]).iter().filter(|branch| branch["periods"] == 2).collect();
    // Each leads from a doubling of one branch to one of the other, and is there once.
    let ends = |branch: &Value| [&branch["begin"], &branch["end"]].map(|end| number(&end["value"]));
    let found: Vec<[f64; 2]> = doubled.iter().map(|branch| ends(branch)).collect();
    let expected = [[0.022190012, 0.024813736], [0.013627215, 0.015061060]];
    assert_eq!(found.len(), 2, "{found:?}");
    for (found, expected) in found.iter().zip(expected) {
        assert!(close(*found, expected, [1e-8; 2]), "{found:?} {expected:?}");
    }
    // Subcritical: it begins where the orbit is still stable, as Newton's iteration on another integrator has it.
    assert!(number(&doubled[1]["points"][0]["value"]) < 0.013627214);
}
