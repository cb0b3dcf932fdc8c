//! The design bench: loads, frequencies, ceramics, trust, and the search for designs.

mod search;
mod within_limits;

use crate::TestResult;
use harvester_lab::dynamics::attractors::sweep::Dwell;
use harvester_lab::dynamics::{Motion, critical_excitation};
use harvester_lab::model::materials::Ceramic;
use harvester_lab::model::{ForceLaw, Limits, ParameterSet, Shaking};
use harvester_lab::questions::checks::Span;
use harvester_lab::questions::design::band::{half_power, total, usable};
use harvester_lab::questions::design::load::{best, best_frequency};
use harvester_lab::questions::design::materials::with_ceramic;
use harvester_lab::questions::design::point::powers;
use harvester_lab::questions::design::trust::{LAWS, Quantity, force_beyond_linear, law_error, trust_entry};
use harvester_lab::questions::design::{Plant, operating};
use harvester_lab::questions::harvest::{Harvest, HarvestStudy};
use harvester_lab::questions::load::Reached;
use harvester_lab::questions::load::{Load, LoadStudy};
use harvester_lab::questions::materials::Materials;
use harvester_lab::questions::sweep::Direction;
use harvester_lab::questions::trust::Trust;
use harvester_lab::scenario::Scenario;
use harvester_lab::scheduler::{Study, complete};
use harvester_lab::theory::Resonance;

fn figure_9() -> Scenario {
    let parameters = ParameterSet { alpha: 1e-4, beta: 0.01, omega: 8.0969, ..Default::default() };
    Scenario { parameters, ..Default::default() }
}

#[test]
fn the_doubled_motion_is_followed_over_loads_and_the_linear_optimum_is_the_closed_form() -> TestResult {
    let mut study = LoadStudy::new(figure_9(), Load { per_decade: 4, ..Load::default() })?;
    complete(&mut study);
    assert!(study.finished() && study.failure().is_none() && study.progress() == 1.0);
    assert_eq!(study.resistances().len(), 25);
    assert!((study.resistances()[24] / study.resistances()[0] / 1e6 - 1.0).abs() < 1e-12);
    // The linear device: no load gives more than the closed form's, and the curve comes close to it.
    let [ohm, watt] = study.linear_best();
    assert!(study.linear().iter().all(|point| point[1] <= watt));
    let near = study.linear().iter().filter(|point| (point[0] / ohm).ln().abs() < 0.3);
    assert!(near.map(|point| point[1] / watt).fold(0.0, f64::max) > 0.95);
    let at_best = Plant::new(&figure_9())?.with_resistance(ohm)?;
    let linear = operating(&at_best.scenario)?.linear;
    assert!((linear.measures.power / watt - 1.0).abs() < 1e-9);
    // At the device's own load, in the middle, it is the motion of the figure.
    let middle = study.reached()[12].ok_or("known")?;
    assert_eq!(middle.motion, Motion::Periodic { periods: 2 });
    let own = operating(&figure_9())?.reached.harvest.ok_or("it lasts")?;
    assert!((middle.measures.power / own.measures.power - 1.0).abs() < 1e-7, "{middle:?} {own:?}");
    let doubled = study.reached().iter().flatten();
    let doubled = doubled.filter(|point| point.motion == Motion::Periodic { periods: 2 }).count();
    let forced = study.forced().ok_or("known")?;
    let unstable = forced.iter().flatten().filter(|point| !point.stable).count();
    println!("{doubled} doubled, {unstable} unstable forced");
    for (forced, reached) in forced.iter().zip(study.reached()) {
        println!("{forced:?}\n    {reached:?}");
    }
    assert!(doubled >= 15, "{doubled}");
    let found = best(study.reached().iter().flatten().copied()).ok_or("points")?;
    assert!(found.measures.power >= own.measures.power);
    Ok(())
}

#[test]
fn an_open_circuit_begins_with_the_largest_load() -> TestResult {
    let parameters = ParameterSet { kappa: 0.0, ..figure_9().parameters };
    let scenario = Scenario { parameters, ..Default::default() };
    let mut study = LoadStudy::new(scenario, Load { per_decade: 1, ..Load::default() })?;
    let largest = *study.resistances().last().ok_or("loads")?;
    let orders: Vec<_> = std::iter::from_fn(|| study.next()).collect();
    let reached = orders.iter().filter_map(|order| order.piece::<Reached>());
    let firsts: Vec<f64> = reached.filter_map(|piece| piece.resistances.first().copied()).collect();
    assert_eq!(firsts, [largest, largest]);
    Ok(())
}

#[test]
fn the_best_frequency_beats_the_given_one() -> TestResult {
    let scenario = figure_9();
    let plant = Plant::new(&scenario)?;
    let (window, limits) = (((7.5, 8.8), Shaking::Amplitude), Limits::default());
    let found = best_frequency(&scenario, plant.resistance(), window, limits)?;
    let own = operating(&scenario)?;
    println!("{found:?}");
    assert!(found.linear[1] >= own.linear.measures.power);
    let stable = found.stable.ok_or("a stable motion")?;
    assert!(
        stable.measures.power >= 0.999 * own.reached.harvest.ok_or("it lasts")?.measures.power
            && stable.periods == 2
    );
    assert_eq!(found.within_limits, found.stable);
    // A voltage below the best motion's takes it away; one below every motion's leaves none.
    let at_most = |volts: f64| Limits { voltage: Some((volts, volts)), ..limits };
    let volts = 0.7 * stable.measures.v_peak;
    let found = best_frequency(&scenario, plant.resistance(), window, at_most(volts))?;
    let within = found.within_limits.ok_or("a motion within the limits")?;
    assert!(
        found.stable == Some(stable)
            && within.measures.v_peak <= volts
            && within.measures.power < stable.measures.power
    );
    let found = best_frequency(&scenario, plant.resistance(), window, at_most(0.1))?;
    assert_eq!(found.within_limits, None);
    Ok(())
}

#[test]
fn the_frequency_curves_agree_with_one_another() -> TestResult {
    curves_agree(Shaking::Amplitude)
}

#[test]
fn so_do_those_at_the_same_acceleration() -> TestResult {
    curves_agree(Shaking::Acceleration)
}

fn curves_agree(shaking: Shaking) -> TestResult {
    let scenario = figure_9();
    let dwell = Dwell { discarded: 300, kept: 16 };
    let units = scenario.units();
    let frequency = Span { from: units.hertz(7.6), to: units.hertz(8.7), count: 23 };
    let question = Harvest { hold: shaking, dwell, ..Harvest::default() };
    let mut study = HarvestStudy::new(scenario.clone(), question, frequency)?;
    complete(&mut study);
    assert!(study.finished() && study.failure().is_none() && study.progress() == 1.0);
    let branches = study.branches().ok_or("known")?.map_err(ToString::to_string)?;
    assert!(branches.iter().any(|branch| branch.periods == 2));
    for direction in [Direction::Up, Direction::Down] {
        assert_eq!(study.swept(direction).len(), 23);
    }
    // What is reached from rest and repeats lies on a stable branch.
    let stable = powers(&study.stable_pieces());
    let mut periodic = 0;
    for (motion, point) in study.from_rest().iter().flatten().flatten() {
        let Motion::Periodic { periods } = motion else { continue };
        periodic += 1;
        let on = stable.iter().flat_map(|curve| curve.windows(2)).any(|pair| {
            let inside = (pair[0][0] - point.frequency) * (pair[1][0] - point.frequency) <= 0.0;
            let share = (point.frequency - pair[0][0]) / (pair[1][0] - pair[0][0]);
            let power = pair[0][1] + share * (pair[1][1] - pair[0][1]);
            inside && (power / point.measures.power - 1.0).abs() < 0.02
        });
        assert!(on || *periods > 4, "{motion:?} {point:?}");
    }
    assert!(periodic >= 15, "{periodic}");
    // Each is what the bench says of the device shaken so at that frequency.
    let units = scenario.units();
    let force = scenario.parameters.beta * scenario.parameters.omega.powi(2);
    for index in [13, 20] {
        let mut there = scenario.clone();
        let p = &mut there.parameters;
        p.omega = 7.6 + 1.1 * index as f64 / 22.0;
        if shaking == Shaking::Acceleration {
            p.beta = force / (p.omega * p.omega);
        }
        let found = operating(&there)?;
        let hertz = units.hertz(there.parameters.omega);
        let mut starts = study.from_rest().iter().flatten().flatten();
        let start = starts.find(|(_, point)| (point.frequency / hertz - 1.0).abs() < 1e-9);
        let (_, point) = start.ok_or("a start there")?;
        let harvest = found.reached.harvest.ok_or("it lasts")?;
        assert!((point.measures.power / harvest.measures.power - 1.0).abs() < 1e-6, "{point:?} {harvest:?}");
        let per_g2 = harvest.power_per_g2.ok_or("shaken")?;
        assert!((point.power_per_g2 / per_g2 - 1.0).abs() < 1e-6);
        let linear = study.linear().points.iter().find(|point| (point[0] / hertz - 1.0).abs() < 1e-9);
        let linear = linear.ok_or("a point there")?;
        assert!(
            (linear[2] / found.linear.measures.power - 1.0).abs() < 1e-9,
            "{linear:?} {:?}",
            found.linear
        );
    }
    let least = 1e-5;
    let rest = powers(&study.rest_pieces());
    let (linear, band) = (study.linear(), usable(&rest, least));
    let points: Vec<[f64; 2]> = linear.points.iter().map(|point| [point[0], point[2]]).collect();
    println!("usable {band:?}, linear {:?}, peak {:?}", usable(&[points], least), linear.peak);
    println!("half power {:?}", half_power(&rest));
    assert!(total(&band) > 0.0 && linear.peak[1] < least);
    Ok(())
}

#[test]
fn every_ceramic_has_its_row_and_harder_ones_need_less() -> TestResult {
    let mut table = Materials::default().table(&figure_9());
    complete(&mut table);
    let rows: Vec<_> = table.found().flatten().collect::<Result<_, _>>().map_err(ToString::to_string)?;
    assert_eq!(rows.len(), 9);
    for row in &rows {
        println!("{row:?}");
        let scenario = with_ceramic(&figure_9(), row.ceramic, 1)?;
        let plant = Plant::new(&scenario)?;
        let threshold = row.threshold.ok_or("a tongue")?;
        // The threshold is the exact boundary there, and lowest among its neighbours.
        let system = plant.in_tongue(Resonance::First)?.system()?;
        let omega = plant.units.omega(threshold.frequency);
        let at = |omega: f64| critical_excitation(&system, omega, 0.04, None).map(|found| found.beta());
        let lowest = at(omega)?.ok_or("unstable")?;
        assert!((lowest / threshold.beta - 1.0).abs() < 1e-6, "{row:?}");
        for nearby in [omega - 2e-3, omega + 2e-3] {
            assert!(at(nearby)?.ok_or("unstable")? > threshold.beta * (1.0 + 1e-9), "{row:?}");
        }
        assert!(row.reached.harvest.is_some_and(|harvest| harvest.defect < 1e-8));
        let open = row.open.ok_or("beta is above the threshold")?;
        assert!(open.from < threshold.frequency && threshold.frequency < open.to);
    }
    let of = |ceramic| rows.iter().find(|row| row.ceramic == ceramic).and_then(|row| row.threshold);
    let (hard, soft) = (of(Ceramic::Apc844).ok_or("844")?, of(Ceramic::Apc860).ok_or("860")?);
    assert!(hard.beta < soft.beta, "{hard:?} {soft:?}");
    assert!(with_ceramic(&figure_9(), Ceramic::Apc840, 3).is_err());
    Ok(())
}

#[test]
fn trust_is_a_table_of_modes_and_laws() -> TestResult {
    let mut table = Trust { quantity: Quantity::Voltage }.table(&figure_9());
    complete(&mut table);
    let entries: Vec<_> = table.found().flatten().collect::<Result<_, _>>().map_err(ToString::to_string)?;
    assert_eq!(entries.len(), 32);
    let of = |modes, law| entries.iter().find(|e| e.modes == modes && e.law == law).and_then(|e| e.value);
    for entry in &entries {
        println!("{entry:?}");
    }
    assert!((of(2, ForceLaw::Quadratic).ok_or("it lasts")? - 14.1783).abs() < 1e-4);
    // Modes converge.
    let [six, eight] = [6, 8].map(|modes| of(modes, ForceLaw::Exact));
    assert!((six.ok_or("it lasts")? / eight.ok_or("it lasts")? - 1.0).abs() < 5e-3);
    // The threshold of an independent program at the tongue's tip: 0.000421 at omega = 8.1569.
    let entry = trust_entry(&figure_9(), 2, ForceLaw::Quadratic, Quantity::Threshold(Resonance::First))?;
    let lowest = entry.value.ok_or("a tongue")?;
    assert!((lowest - 0.000421).abs() < 1e-6, "{lowest}");
    // The quadratic law of Figure 9 at its closest approach, by the series of the exact one.
    let (system, _) = figure_9().validate()?;
    let cubic = law_error(&system, ForceLaw::Quadratic, -1e-5).rest.ok_or("no contact")?;
    let (c2, c3) = (-19.378543266711, 223.38294552191);
    assert!((cubic / (c3 / c2 * 1e-5) - 1.0).abs() < 1e-3, "{cubic}");
    let far = LAWS.map(|law| law_error(&system, law, -0.0835).rest.unwrap_or(f64::NAN).abs());
    assert!(far[0] > 0.3 && far[1] < far[0] && far[2] < far[1] && far[3] == 0.0, "{far:?}");
    assert_eq!(law_error(&system, ForceLaw::Quadratic, -0.2).rest, None);
    // The force beyond the linear part is Eq. (11) itself less its value and its slope at rest.
    let (at, gap, (c1, c2)) = (system.magnet(), system.equilibrium.gap, (system.c1, c2));
    for tip in [-0.08, -0.01, 0.02, 0.1] {
        let of = |law| force_beyond_linear(&system, law, tip).ok_or("no contact");
        let true_rest = at.force(gap) - at.force(gap + tip) - c1 * tip;
        assert!((of(ForceLaw::Exact)? - true_rest).abs() < 1e-12 * at.force(gap + tip), "{tip}");
        assert!((of(ForceLaw::Quadratic)? / (c2 * tip * tip) - 1.0).abs() < 1e-10, "{tip}");
    }
    assert_eq!(force_beyond_linear(&system, ForceLaw::Exact, -gap), None);
    Ok(())
}
