//! What a device harvests, against integrations by another method and closed forms.

#![allow(clippy::excessive_precision, reason = "reference values are given as they were printed")]

use crate::{Fallible, TestResult};
use std::f64::consts::TAU;

use harvester_lab::dynamics::{Balance, Effort, Motion, Orbit, Settings, Trajectory, reach};
use harvester_lab::model::limits::Standing;
use harvester_lab::model::materials::Ceramic;
use harvester_lab::model::{Device, ElectricalScaling, ForceLaw, Limits, ParameterSet, ReducedSystem};
use harvester_lab::questions::checks::Span;
use harvester_lab::questions::design::linear::{linear_at_its_best, linear_curve};
use harvester_lab::questions::design::{HarvestPoint, Plant, operating};
use harvester_lab::questions::harvest::{Harvest, HarvestStudy};
use harvester_lab::questions::sweep::Direction;
use harvester_lab::scenario::{ModelChoice, Scenario};
use harvester_lab::scheduler::complete;
use harvester_lab::spacing::equally_spaced;
use harvester_lab::theory::{LinearResponse, Source};
use nalgebra::Complex;

/// Figure 9 of the paper.
fn figure_9() -> Scenario {
    let parameters = ParameterSet { alpha: 1e-4, beta: 0.01, omega: 8.0969, ..Default::default() };
    Scenario { parameters, ..Default::default() }
}

/// Two modes as Eqs. (31), (34) print them, with the modes' numbers from 40-digit arithmetic or another system.
struct Equations {
    omega: [f64; 2],
    eta1: [f64; 2],
    eta2: [f64; 2],
    theta: [f64; 2],
    c1: f64,
    c2: f64,
}

/// The paper's device.
const PAPER: Equations = Equations {
    omega: [4.04845139686289, 21.3562434253049],
    eta1: [0.417268652823084, -0.235757431026728],
    eta2: [0.275163559332428, 0.300562648266401],
    theta: [2.66720397414344e-4, 1.01697006538490e-3],
    c1: 1.3450051225722,
    c2: -19.378543266711,
};

impl Equations {
    fn of(system: &ReducedSystem) -> Self {
        let pick = |f: fn(&harvester_lab::model::Mode) -> f64| [0, 1].map(|k| f(&system.modes[k]));
        Self {
            omega: pick(|mode| mode.omega),
            eta1: pick(|mode| mode.eta1),
            eta2: pick(|mode| mode.eta2),
            theta: [system.theta[0], system.theta[1]],
            c1: system.c1,
            c2: 0.0,
        }
    }

    fn rate(&self, set: &ParameterSet, t: f64, y: &[f64; 5]) -> [f64; 5] {
        let (s, w) = (y[0] + y[1], y[2] + y[3]);
        let drive = set.omega * set.omega * set.beta * (set.omega * t).sin();
        let acceleration = |k: usize| {
            let force =
                set.alpha * self.c1 * w - self.c2 * s * s - self.theta[k] * y[4] + drive * self.eta1[k];
            force / self.eta2[k] - self.omega[k] * self.omega[k] * (y[k] + set.alpha * y[2 + k])
        };
        let current = self.theta[0] * y[2] + self.theta[1] * y[3];
        [y[2], y[3], acceleration(0), acceleration(1), (current - set.kappa * y[4]) / set.c]
    }

    /// Mean power kappa v^2 over the last two of `periods` excitation periods from rest, by classical Runge-Kutta steps.
    fn power(&self, set: &ParameterSet, periods: usize, steps: usize) -> f64 {
        let h = TAU / set.omega / steps as f64;
        let (mut y, mut square) = ([0.0; 5], 0.0);
        for i in 0..periods * steps {
            let t = i as f64 * h;
            let add = |k: &[f64; 5], f: f64| std::array::from_fn(|j| y[j] + f * k[j]);
            let k1 = self.rate(set, t, &y);
            let k2 = self.rate(set, t + 0.5 * h, &add(&k1, 0.5 * h));
            let k3 = self.rate(set, t + 0.5 * h, &add(&k2, 0.5 * h));
            let k4 = self.rate(set, t + h, &add(&k3, h));
            for j in 0..5 {
                y[j] += h / 6.0 * (k1[j] + 2.0 * k2[j] + 2.0 * k3[j] + k4[j]);
            }
            // The trapezoidal rule over whole periods of a smooth periodic motion.
            if i >= (periods - 2) * steps {
                square += y[4] * y[4];
            }
        }
        set.kappa * square / (2 * steps) as f64
    }
}

#[test]
fn figure_9_harvests_what_another_integration_says_and_so_many_times_the_linear_device() -> TestResult {
    let scenario = figure_9();
    let found = operating(&scenario)?;
    let plant = Plant::new(&scenario)?;
    assert_eq!(found.reached.motion, Motion::Periodic { periods: 2 });
    let doubled = found.reached.harvest.ok_or("a lasting motion")?;
    let expected = PAPER.power(&scenario.parameters, 4000, 1000);
    let watts = plant.units.watts(expected);
    assert!((doubled.measures.power / watts - 1.0).abs() < 1e-6, "{} {watts}", doubled.measures.power);
    // V^2/R of the printed load, by another program's 14.1783 V.
    assert!(
        (doubled.measures.power / (14.1783_f64.powi(2) / 7_631_732.0) - 1.0).abs() < 1e-4,
        "{}",
        doubled.measures.power
    );
    let bare = Equations::of(&plant.without_magnets()?);
    let linear = bare.power(&scenario.parameters, 4000, 1000);
    assert!((found.linear.measures.power / plant.units.watts(linear) - 1.0).abs() < 1e-6);
    let ratio = found.reached_gain.ok_or("a gain")?;
    assert!((ratio / (expected / linear) - 1.0).abs() < 1e-6, "{ratio} {}", expected / linear);
    // The forced motion coexists, unstable.
    let forced = found.forced.ok_or("a forced motion")?;
    assert!(!forced.stable && (forced.multiplier - 1.148382).abs() < 1e-6);
    println!(
        "Figure 9: {doubled:?}\nlinear {:?}\ngain {ratio}, forced {:?}",
        found.linear, found.forced_gain
    );
    Ok(())
}

#[test]
fn every_harvest_keeps_its_energy() -> TestResult {
    let mut lossy = figure_9();
    let mut device = lossy.device()?;
    (device.ceramic, device.loss_tangent) = (Some(Ceramic::Apc854), 0.02);
    lossy.set_device(device, ElectricalScaling::AsPrinted)?;
    let stable = ParameterSet { omega: 3.9, ..Default::default() };
    let attracting = ParameterSet { c0: -0.02, d: 0.3, ..figure_9().parameters };
    let exact = ModelChoice { modes: 3, force: ForceLaw::Exact, ..Default::default() };
    let scaling = ElectricalScaling::Consistent;
    for scenario in [
        figure_9(),
        lossy.clone(),
        Scenario { parameters: stable, ..Default::default() },
        Scenario { parameters: attracting, ..Default::default() },
        Scenario { model: exact, ..figure_9() },
        Scenario { device: Some(Device { beam_length: 0.1, ..Device::default() }), scaling, ..figure_9() },
    ] {
        let found = operating(&scenario)?;
        let forced = found.forced.map(|forced| forced.harvest);
        for harvest in [Some(found.linear), forced, found.reached.harvest].into_iter().flatten() {
            assert!(harvest.defect < 1e-8, "{harvest:?}");
            let sum = harvest.measures.power + harvest.viscous + harvest.dielectric;
            assert!((sum / harvest.input - 1.0).abs() < 1e-8, "{harvest:?}");
            let efficiency = harvest.efficiency.ok_or("input")?;
            assert!((efficiency - harvest.measures.power / harvest.input).abs() < 1e-12 && efficiency < 1.0);
        }
        assert!(found.reached.harvest.is_some(), "{scenario:?}");
    }
    // The dielectric takes tan delta omega C of what the load takes kappa of.
    let found = operating(&lossy)?.linear;
    let share = 0.02 * lossy.parameters.omega * lossy.parameters.c / lossy.parameters.kappa;
    assert!((found.dielectric / found.measures.power / share - 1.0).abs() < 1e-12);
    // The doubled motion has the largest line of its voltage at half of the frequency, and half the conductance there.
    let reached = operating(&lossy)?.reached;
    let harvest = reached.harvest.ok_or("it lasts")?;
    assert_eq!(reached.motion, Motion::Periodic { periods: 2 });
    let hertz = reached.dielectric_frequency.ok_or("a loss")?;
    assert!((hertz / lossy.device()?.frequency - 0.5).abs() < 1e-12, "{hertz}");
    assert!((harvest.dielectric / harvest.measures.power / (0.5 * share) - 1.0).abs() < 1e-9, "{harvest:?}");
    // Integrated with that conductance in all, from rest.
    let mut whole = lossy.parameters;
    whole.kappa += 0.02 * 0.5 * whole.omega * whole.c;
    let system = lossy.model.system(whole)?;
    let run = Trajectory::compute(&system, &[0.0; 5], 600.0, Settings::default())?;
    let period = 2.0 * system.parameters.period();
    let (mut sum, count) = (0.0, 4096);
    run.sample(600.0 - 20.0 * period, 600.0, count, |_, state| sum += state[4] * state[4]);
    let v_rms = (sum / count as f64).sqrt();
    assert!((v_rms / harvest.measures.v_rms - 1.0).abs() < 2e-3, "{v_rms} {}", harvest.measures.v_rms);
    assert_eq!(operating(&figure_9())?.reached.dielectric_frequency, None);
    Ok(())
}

#[test]
fn every_motion_of_a_curve_has_the_dielectric_loss_of_its_own_frequency() -> TestResult {
    // As lossy as a ceramic never is, so that it shows.
    let mut lossy = figure_9();
    let device = Device { loss_tangent: 0.5, ..lossy.device()? };
    lossy.set_device(device, ElectricalScaling::AsPrinted)?;
    let units = lossy.units();
    let frequency = Span { from: units.hertz(7.2), to: units.hertz(8.15), count: 20 };
    let mut study = HarvestStudy::new(lossy.clone(), Harvest::default(), frequency)?;
    complete(&mut study);
    assert_eq!(study.failure(), None);
    // The conductance of the load, and of the dielectric at the frequency of the voltage, added by hand.
    let v_rms = |omega: f64, periods: usize| -> Fallible<Option<f64>> {
        let mut whole = ParameterSet { omega, ..lossy.parameters };
        whole.kappa += 0.5 * omega / periods as f64 * whole.c;
        let reached = reach(&lossy.model.system(whole)?, &[0.0; 5], Effort::full())?;
        // Rest may lead elsewhere than to this motion of a branch.
        let orbit = reached.orbit.filter(|_| reached.motion == Motion::Periodic { periods });
        Ok(orbit.map(|orbit| orbit.measures.v_rms))
    };
    let mut seen = [0, 0];
    let mut agrees = |point: &HarvestPoint, periods: usize| -> TestResult {
        let Some(expected) = v_rms(units.omega(point.frequency), periods)? else { return Ok(()) };
        assert!((point.measures.v_rms / expected - 1.0).abs() < 1e-6, "{periods}: {point:?} {expected}");
        seen[periods - 1] += 1;
        Ok(())
    };
    for start in study.from_rest() {
        let Some((Motion::Periodic { periods }, point)) = start.flatten() else { continue };
        agrees(&point, periods)?;
        let mut up = study.swept(Direction::Up).into_iter().flatten();
        let swept = up.find(|swept| swept.frequency == point.frequency);
        if let Some(swept) = swept.filter(|_| periods == 1) {
            agrees(&swept, 1)?;
        }
    }
    for curve in study.branches().ok_or("known")?.map_err(ToString::to_string)? {
        let stable = study.branch_points(curve).into_iter().filter(|(point, stable)| {
            // Beside its birth the doubled motion has its main line at the excitation's frequency, still.
            let strong = curve.periods == 1 || point.measures.v_rms > 5.0;
            *stable && strong && (7.3..8.12).contains(&units.omega(point.frequency))
        });
        for (point, _) in stable.step_by(3) {
            agrees(&point, curve.periods)?;
        }
    }
    assert!(seen.iter().all(|count| *count > 4), "{seen:?}");
    Ok(())
}

#[test]
fn the_linear_device_is_its_closed_form_and_its_best_load_the_admittance() -> TestResult {
    let scenario = figure_9();
    let plant = Plant::new(&scenario)?;
    let bare = plant.without_magnets()?;
    let response = LinearResponse::new(&bare)?;
    let found = operating(&scenario)?.linear;
    // As a current source with an inner admittance, which no amplitude of a mode enters.
    let source = Source::new(&bare)?;
    let closed = plant.units.watts(source.power(scenario.parameters.kappa, 0.0));
    assert!((found.measures.power / closed - 1.0).abs() < 1e-9);
    // The same motion integrated.
    let balance = Balance::of(&bare, &response.state(0.0), 1)?.ok_or("it lasts")?;
    let orbit = Orbit::find(&bare, None, 1)?.measures;
    let slope = found.demand.slope.ok_or("a slope")?;
    for (a, b) in [(slope, balance.measures.slope), (slope, orbit.slope), (found.demand.v_peak, orbit.v_peak)]
    {
        assert!((a / b - 1.0).abs() < 1e-7, "{a} {b}");
    }
    for (a, b) in [
        (found.input, balance.input),
        (found.viscous, balance.viscous),
        (found.measures.power, balance.measures.power),
    ] {
        assert!((a / plant.units.watts(b) - 1.0).abs() < 1e-8, "{a} {b}");
    }
    let power = |kappa: f64| {
        let set = ParameterSet { kappa, ..*bare.parameters };
        let system = bare.with_numbers(set).expect("in range");
        let response = LinearResponse::new(&system).expect("damped");
        0.5 * kappa * response.voltage.norm_sqr()
    };
    let best = source.best_load(0.0);
    let closed = 0.25 * source.current.norm_sqr() / (source.admittance.norm() + source.admittance.re);
    assert!((power(best) / closed - 1.0).abs() < 1e-9, "{} {closed}", power(best));
    for factor in [0.5, 0.99, 1.01, 2.0] {
        assert!(power(factor * best) < power(best));
    }
    Ok(())
}

#[test]
fn the_input_is_the_work_of_the_base_in_watts_and_1_over_l_of_it_under_the_printed_scaling() -> TestResult {
    for scaling in ElectricalScaling::ALL {
        let mut scenario = figure_9();
        scenario.set_device(Device { frequency: 2.8, ..scenario.device()? }, scaling)?;
        let device = scenario.device()?;
        let bare = Plant::new(&scenario)?.without_magnets()?;
        let response = LinearResponse::new(&bare)?;
        // Force of the base on the masses that move relative to it, against its velocity: newtons, metres per second.
        let rate = TAU * device.frequency;
        let pairs = bare.modes.iter().zip(response.displacements.iter());
        let moved: Complex<f64> = pairs.map(|(mode, q)| q * mode.eta1).sum();
        let force = moved * (-device.beam_mass * rate * rate * device.beam_length);
        // A real excitation Omega^2 B is that of a base at B e^(i Omega t).
        let velocity = Complex::new(0.0, device.base_amplitude * rate);
        let watts = 0.5 * (force * velocity.conj()).re;
        let found = operating(&scenario)?.linear.input;
        let factor = if scaling == ElectricalScaling::Consistent { 1.0 } else { 1.0 / device.beam_length };
        println!("{scaling:?}: {found} {watts}");
        assert!((found / (factor * watts) - 1.0).abs() < 1e-9, "{scaling:?}: {found} {watts}");
    }
    Ok(())
}

#[test]
fn the_linear_device_at_its_best_is_shaken_as_hard_whatever_amplitude_that_takes() -> TestResult {
    let scenario = figure_9();
    let best = linear_at_its_best(&scenario)?;
    let units = scenario.units();
    let acceleration = |of: &Scenario| units.acceleration(of.parameters.beta, of.parameters.omega);
    // The same place by the bench itself.
    let mut there = scenario.clone();
    there.parameters.omega = units.omega(best.frequency);
    there.parameters.beta = units.beta_of(acceleration(&scenario), there.parameters.omega);
    let found = operating(&there)?.linear;
    assert!((found.measures.power / best.power - 1.0).abs() < 1e-9, "{found:?} {best:?}");
    assert!((found.demand.tip.1 / best.tip - 1.0).abs() < 1e-9);
    // Ten times the acceleration would take more amplitude than a run is allowed, and gives a hundred times the power.
    let mut hard = scenario.clone();
    hard.parameters.omega *= 10.0_f64.sqrt();
    assert!(units.beta_of(acceleration(&hard), there.parameters.omega) > 0.2);
    let harder = linear_at_its_best(&hard)?;
    assert!((harder.power / best.power / 100.0 - 1.0).abs() < 1e-6, "{harder:?} {best:?}");
    Ok(())
}

#[test]
fn the_half_power_band_of_the_linear_device_has_half_the_power_at_its_ends() -> TestResult {
    let plant = Plant::new(&figure_9())?;
    let curve = linear_curve(&plant, (3.0, 5.0), equally_spaced((3.0, 5.0), 50))?;
    let bare = plant.without_magnets()?;
    let power = |hertz: f64| -> Fallible<f64> {
        let system = bare.with_excitation(bare.parameters.beta, plant.units.omega(hertz))?;
        let v_rms = LinearResponse::new(&system)?.voltage_harmonic().root_mean_square();
        Ok(plant.watts(v_rms))
    };
    let [place, peak] = curve.peak;
    assert!((power(place)? / peak - 1.0).abs() < 1e-9);
    for nearby in [0.9999, 1.0001] {
        assert!(power(place * nearby)? < peak);
    }
    for end in [curve.half_power.from, curve.half_power.to] {
        assert!((power(end)? / (0.5 * peak) - 1.0).abs() < 1e-6, "{end}");
    }
    assert!(curve.half_power.from < place && place < curve.half_power.to);
    Ok(())
}

#[test]
fn the_printed_device_gives_the_printed_numbers_and_limits_tell_safe_from_unsafe() -> TestResult {
    let device = Device::default();
    let set = device.dimensionless(ElectricalScaling::AsPrinted)?;
    let printed = ParameterSet::default();
    // D is printed to 0.1 mm, which leaves d its last digit.
    for (a, b) in [
        (set.alpha, printed.alpha),
        (set.beta, printed.beta),
        (set.c0, printed.c0),
        (set.d, printed.d),
        (set.h, printed.h),
        (set.eta, printed.eta),
        (set.c, printed.c),
        (set.kappa, printed.kappa),
        (set.theta, printed.theta),
    ] {
        assert!((a / b - 1.0).abs() < 1e-4 || (a - b).abs() < 5e-5 && b == 0.15, "{a} {b}");
    }
    let back = Device::from_parameters(&device, &set, ElectricalScaling::AsPrinted)?;
    assert!((back.resistance / 7_631_732.0 - 1.0).abs() < 1e-12);
    // Figure 9's motion on a thick and on a thin ceramic.
    let mut scenario = figure_9();
    let motion = operating(&scenario)?.reached.harvest.ok_or("it lasts")?;
    let (system, _) = scenario.validate()?;
    for (thickness, allowed) in [(2e-4, true), (5e-5, false)] {
        let device =
            Device { ceramic: Some(Ceramic::Apc844), ceramic_thickness: thickness, ..scenario.device()? };
        scenario.set_device(device, ElectricalScaling::AsPrinted)?;
        let limits = Limits::of(&scenario.base());
        assert_eq!(limits.allow(&motion.demand, Plant::gap(&system)), allowed, "{motion:?}");
        let checks = limits.checks(&motion.demand, Plant::gap(&system));
        assert_eq!(checks[0].standing == Standing::Within, allowed, "{checks:?}");
    }
    Ok(())
}
