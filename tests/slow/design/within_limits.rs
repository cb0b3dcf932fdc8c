//! Bands and loads that keep the limits.

use harvester_lab::dynamics::attractors::sweep::{Dwell, SweepCourse, sweep};
use harvester_lab::dynamics::{Instability, Measures};
use harvester_lab::model::{
    Along, Device, ElectricalScaling, ForceLaw, Limits, Parameter, ParameterSet, Shaking,
};
use harvester_lab::questions::checks::Span;
use harvester_lab::questions::design::band::usable;
use harvester_lab::questions::design::point::powers;
use harvester_lab::questions::design::{Bounds, Plant, operating};
use harvester_lab::questions::harvest::{Harvest, HarvestStudy};
use harvester_lab::questions::load::{Load, LoadStudy};
use harvester_lab::questions::solve;
use harvester_lab::questions::sweep::Direction;
use harvester_lab::scenario::Scenario;
use harvester_lab::scheduler::{Study, complete};

use super::{TestResult, figure_9};

#[test]
fn a_band_ends_where_the_motion_itself_meets_the_limit() -> TestResult {
    let (volts, mut scenario) = (20.0, figure_9());
    let plant = Plant::new(&scenario)?;
    let limits = Limits { voltage: Some((volts, volts)), ..Limits::default() };
    let bounds = Bounds::new(&plant, limits)?;
    let (dwell, shaking) = (Dwell { discarded: 100, kept: 8 }, Shaking::Amplitude);
    let units = scenario.units();
    let frequency = Span { from: units.hertz(7.9), to: units.hertz(8.7), count: 2 };
    let question = Harvest { hold: shaking, dwell, ..Harvest::default() };
    let mut study = HarvestStudy::new(scenario.clone(), question, frequency)?;
    complete(&mut study);
    // The doubled motion alone gives more than 5 µW; it needs more than 20 V below this frequency.
    let found = usable(&bounds.powers_within(&study.stable_pieces()), 5e-6);
    assert_eq!(found.len(), 1, "{found:?}");
    scenario.parameters.omega = plant.units.omega(found[0].from);
    let there = operating(&scenario)?.reached.harvest.ok_or("it lasts")?;
    assert!((there.demand.v_peak / volts - 1.0).abs() < 1e-3, "{there:?}");
    Ok(())
}

#[test]
fn requests_tell_what_keeps_the_limits() -> TestResult {
    let device = r#""parameters":{"alpha":1e-4,"beta":0.01,"omega":8.0969}"#;
    let limits = r#""limits":{"voltage":[20,20]}"#;
    let harvest = solve(&format!(
        r#"{{"task":"harvest",{device},"frequency":{{"from":2.8,"to":3.0,"count":9}},"least":5e-6,{limits}}}"#
    ))?;
    let harvest: serde_json::Value = serde_json::from_str(&harvest)?;
    for band in harvest["curves"]["bands"].as_array().ok_or("bands")? {
        let (all, safe) = (band["total"].as_f64(), band["total_within_limits"].as_f64());
        assert!(safe <= all && (band["of"] == "linear" || safe < all), "{band}");
    }
    let load = solve(&format!(r#"{{"task":"load",{device},"per_decade":2,{limits}}}"#))?;
    let load: serde_json::Value = serde_json::from_str(&load)?;
    let (best, safe) = (&load["reached_best"], &load["reached_best_within_limits"]);
    assert!(best["v_peak"].as_f64() > Some(20.0) && safe["v_peak"].as_f64() <= Some(20.0), "{load}");
    assert!(safe["power"].as_f64() < best["power"].as_f64());
    let bad = solve(&format!(r#"{{"task":"load",{device},"limits":{{"gap":1.5}}}}"#));
    let said = bad.err().ok_or("refused")?;
    assert!(said.contains("limits.gap") && said.contains("1.5"), "{said}");
    Ok(())
}

#[test]
fn every_load_keeps_the_limits_that_its_motion_keeps_the_slope_included() -> TestResult {
    // Without magnets the tip's slope, 1.38 times its deflection in mode 1, meets its 0.3 first.
    let parameters = ParameterSet { c0: 0.0, alpha: 1e-3, beta: 0.015, omega: 3.6, ..Default::default() };
    let scenario = Scenario { parameters, ..Default::default() };
    let (plant, limits) = (Plant::new(&scenario)?, Limits::default());
    let bounds = Bounds::new(&plant, limits)?;
    let mut study = LoadStudy::new(scenario, Load { per_decade: 2, ..Load::default() })?;
    complete(&mut study);
    let mut kept = 0;
    for point in study.reached().iter().flatten() {
        let there = operating(&plant.with_resistance(point.resistance)?.scenario)?;
        let demand = there.reached.harvest.ok_or("it lasts")?.demand;
        let slope = demand.slope.ok_or("a slope")?;
        assert!((point.measures.slope / slope - 1.0).abs() < 1e-4, "{point:?} {slope}");
        assert_eq!(bounds.allows(&point.measures), limits.allow(&demand, bounds.gap), "{point:?}");
        // Deflection alone would allow all of them.
        assert!(demand.tip.1 < limits.deflection, "{demand:?}");
        kept += usize::from(bounds.allows(&point.measures));
    }
    assert!(kept > 0 && kept < study.reached().len(), "{kept}");
    Ok(())
}

#[test]
fn the_best_frequency_within_limits_is_where_the_limit_is_met() -> TestResult {
    let device =
        r#""device":{"frequency":1.35,"viscosity":1.731e6,"base_amplitude":5e-4},"model":{"force":"exact"}"#;
    let asked = r#""from":763e3,"to":7.63e6,"per_decade":1,"t_end":50,"window":{"from":1.2,"to":1.8}"#;
    let found: serde_json::Value =
        serde_json::from_str(&solve(&format!(r#"{{"task":"load",{device},{asked}}}"#))?)?;
    let peak = &found["best_frequency"][0]["within_limits"];
    println!("{peak} of {}", found["best_frequency"][0]["stable"]);
    let number = |name: &str| peak[name].as_f64().unwrap_or(f64::NAN);
    // The best point stored on the branch gives 1.8786e-4 W; another program finds at least 1.9246e-4 W allowed.
    assert!(number("power") > 1.9246e-4 && peak["kept"] == "limit", "{peak}");
    // In a sweep up to there the motion gives as much and just keeps its limits.
    let device = Device {
        frequency: number("frequency"),
        viscosity: 1.731e6,
        base_amplitude: 5e-4,
        resistance: 763e3,
        ..Device::default()
    };
    let mut scenario = Scenario::default();
    scenario.set_device(device, ElectricalScaling::AsPrinted)?;
    scenario.model.force = ForceLaw::Exact;
    let there = scenario.parameters.omega;
    let from = scenario.units().omega(1.2);
    let values: Vec<f64> = (0..=60).map(|i| from + (there - from) * f64::from(i) / 60.0).collect();
    let dwell = Dwell { discarded: 300, kept: 32 };
    let (parameter, along) = (Parameter::Omega, Along::default());
    let (set, model) = (&scenario.parameters, scenario.model);
    let course = SweepCourse { set, model, parameter, along, start: &[0.0; 5], dwell };
    let (points, _) = sweep(course, &values, None)?;
    let last = points.last().ok_or("a sweep")?;
    let power = scenario.units().watts(last.measures.power);
    assert!((power / number("power") - 1.0).abs() < 1e-3, "{power}");
    let bounds = Bounds::new(&Plant::new(&scenario)?, Limits::default())?;
    let beam = scenario.units().millimetres(1.0);
    let tip = (beam * last.measures.tip.0, beam * last.measures.tip.1);
    let margin = bounds.margin(&Measures { tip, ..last.measures });
    assert!(margin.abs() < 1e-3, "{margin}");
    Ok(())
}

#[test]
fn a_swept_curve_jumps_where_the_branch_folds_and_its_band_ends_there() -> TestResult {
    // The forced motion leans to high frequencies and turns back at a fold; a sweep up falls off it there.
    let device = Device { viscosity: 1.731e6, base_amplitude: 2e-4, resistance: 763e3, ..Device::default() };
    let mut scenario = Scenario::default();
    scenario.set_device(device, ElectricalScaling::AsPrinted)?;
    scenario.model.force = ForceLaw::Exact;
    let (dwell, shaking) = (Dwell::default(), Shaking::Amplitude);
    let units = scenario.units();
    let window = (units.omega(1.35), units.omega(1.65));
    let units = scenario.units();
    let frequency = Span { from: units.hertz(window.0), to: units.hertz(window.1), count: 31 };
    let question = Harvest { hold: shaking, dwell, ..Harvest::default() };
    let mut study = HarvestStudy::new(scenario, question, frequency)?;
    complete(&mut study);
    assert!(study.finished() && study.failure().is_none() && study.progress() == 1.0);
    let curves = study.branches().ok_or("known")?.map_err(ToString::to_string)?;
    let folds =
        curves.iter().flat_map(|curve| &curve.changes).filter(|change| change.kind == Instability::Fold);
    let fold = folds.map(|change| units.hertz(change.point.value)).fold(0.0, f64::max);
    for direction in [Direction::Up, Direction::Down] {
        let samples = study.swept(direction);
        let pieces = study.swept_pieces(direction);
        assert!(samples.iter().all(Option::is_some) && pieces.len() == 1 && pieces[0].len() >= samples.len());
    }
    let piece = study.swept_pieces(Direction::Up).concat();
    assert!(piece.is_sorted_by(|a, b| a.frequency <= b.frequency));
    let jump = piece.windows(2).find(|pair| pair[0].frequency == pair[1].frequency).ok_or("a jump")?;
    println!("{jump:?} {fold}");
    assert!((jump[0].frequency / fold - 1.0).abs() < 3e-4, "{jump:?} {fold}");
    assert!(jump[0].measures.power > 2.0 * jump[1].measures.power, "{jump:?}");
    // The band ends with the motion: a line between the samples would have ended it elsewhere.
    let least = 0.5 * jump[0].measures.power + 0.5 * jump[1].measures.power;
    let band = *usable(&powers(&study.swept_pieces(Direction::Up)), least).last().ok_or("a band")?;
    assert!((band.to / fold - 1.0).abs() < 3e-4, "{band:?} {fold}");
    let across: Vec<[f64; 2]> = study
        .swept(Direction::Up)
        .iter()
        .flatten()
        .map(|point| [point.frequency, point.measures.power])
        .collect();
    let drawn = *usable(&[across], least).last().ok_or("a band")?;
    assert!((drawn.to / fold - 1.0).abs() > 1e-3, "{drawn:?} {fold}");
    Ok(())
}
