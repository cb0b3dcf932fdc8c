//! The linear device in closed form: its balance at a frequency, its curve, its peak and its half-power band.

use serde::{Deserialize, Serialize};

use super::{DesignError, Interval, Plant};
use crate::dynamics::{Balance, Measures};
use crate::model::{Parameter, ReducedSystem};
use crate::scenario::Scenario;
use crate::spacing::spread;
use crate::theory::{LinearResponse, spectrum::eigenvalues};

/// Distances from a resonance, in its own widths, at which a curve has points.
const ABOUT_RESONANCE: [f64; 13] = [0.0, 0.125, 0.25, 0.5, 0.75, 1.0, 1.5, 2.0, 3.0, 5.0, 8.0, 13.0, 20.0];
/// Equally spaced points among which a peak is looked for, beside those about the resonances.
const PEAK_POINTS: usize = 64;
/// Golden sections that locate a peak.
const SECTIONS: usize = 60;
/// Halvings that locate a border of a band.
const HALVINGS: usize = 60;

/// The energy balance of the linear steady state of `system` under its own excitation, R(s) left out.
///
/// With displacements Q e^(i omega t) the mean of a product of two harmonics is half the real part of one times the
/// other's conjugate.
///
/// # Errors
/// As [`LinearResponse::new`].
pub fn linear_balance(system: &ReducedSystem) -> Result<Balance, DesignError> {
    let response = LinearResponse::new(system)?;
    let p = &system.parameters;
    let (omega, square) = (p.omega, p.omega * p.omega);
    let tip = response.tip().norm();
    let (mut input, mut viscous, mut air) = (0.0, -system.c1 * square * tip * tip, 0.0);
    for (mode, q) in system.modes.iter().zip(response.displacements.iter()) {
        // The velocity i omega q against a force that is real.
        input -= mode.eta1 * omega * q.im;
        viscous += mode.eta2 * mode.omega * mode.omega * square * q.norm_sqr();
        air += mode.eta2 * square * q.norm_sqr();
    }
    let v_peak = response.voltage.norm();
    Ok(Balance {
        input: 0.5 * square * p.beta * input,
        viscous: 0.5 * (p.alpha * viscous + p.air * air),
        stored: 0.0,
        measures: Measures {
            v_rms: v_peak * std::f64::consts::FRAC_1_SQRT_2,
            v_peak,
            power: 0.5 * p.kappa * v_peak * v_peak,
            tip: (-tip, tip),
            slope: slope(system, &response),
        },
    })
}

/// Amplitude of the slope at the tip (rad).
fn slope(system: &ReducedSystem, response: &LinearResponse) -> f64 {
    let quarter = 0.25 * system.parameters.period();
    let [start, later] = [0.0, quarter].map(|t| system.tip_slope(&response.state(t)));
    start.hypot(later)
}

/// The power of the linear device over frequency.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct LinearCurve {
    /// Frequency (Hz), v_rms (V), power (W), amplitudes of the tip (mm) and of its slope (rad), ascending in frequency
    /// and denser about the resonances.
    pub points: Vec<[f64; 5]>,
    /// Frequency (Hz) and power (W) of the highest peak.
    pub peak: [f64; 2],
    /// Where the power is at least half of that about it (Hz), as far as the window goes.
    pub half_power: Interval,
}

/// The power of `plant` without its magnets for `omega` (dimensionless) in `window`, there at these `omegas` and more
/// about the resonances, its base shaken as it says.
///
/// # Errors
/// [`DesignError`].
pub fn linear_curve(
    plant: &Plant,
    window: (f64, f64),
    omegas: impl Iterator<Item = f64>,
) -> Result<LinearCurve, DesignError> {
    let system = plant.without_magnets()?;
    let units = &plant.units;
    let point = |omega: f64| -> Result<[f64; 5], DesignError> {
        let response = LinearResponse::new(&at(plant, &system, omega)?)?;
        let v_rms = response.voltage.norm() * std::f64::consts::FRAC_1_SQRT_2;
        let tip = units.millimetres(response.tip().norm());
        Ok([units.hertz(omega), v_rms, plant.watts(v_rms), tip, slope(&system, &response)])
    };
    // An undamped device has no steady state at its resonance.
    let power = |omega: f64| point(omega).map_or(f64::INFINITY, |point| point[2]);
    let omegas = frequencies(&system, window, omegas)?;
    let place = peak(power, &omegas);
    let half = 0.5 * power(place);
    let below = omegas.iter().rev().copied().find(|omega| *omega < place && power(*omega) < half);
    let above = omegas.iter().copied().find(|omega| *omega > place && power(*omega) < half);
    let border = |outside: f64| units.hertz(crossing(|omega| power(omega) >= half, place, outside));
    Ok(LinearCurve {
        points: omegas.iter().filter_map(|omega| point(*omega).ok()).collect(),
        peak: [units.hertz(place), power(place)],
        half_power: Interval {
            from: below.map_or(units.hertz(window.0), border),
            to: above.map_or(units.hertz(window.1), border),
        },
    })
}

/// `system`, one of `plant`, at another `omega` (dimensionless).
fn at(plant: &Plant, system: &ReducedSystem, omega: f64) -> Result<ReducedSystem, DesignError> {
    Ok(system.with_numbers(plant.along.at(&system.parameters, Parameter::Omega, omega))?)
}

/// Where the linear device of `plant` gives most for `omega` (dimensionless) in `window`, and how much (W).
///
/// # Errors
/// [`DesignError`].
pub fn linear_peak(plant: &Plant, window: (f64, f64)) -> Result<(f64, f64), DesignError> {
    let system = plant.without_magnets()?;
    let power = |omega: f64| {
        let response = at(plant, &system, omega).and_then(|there| Ok(LinearResponse::new(&there)?)).ok();
        let square = |response: LinearResponse| 0.5 * response.voltage.norm_sqr();
        response.map_or(f64::INFINITY, |response| plant.units.watts(plant.load * square(response)))
    };
    let place = peak(power, &frequencies(&system, window, spread(window, false, PEAK_POINTS))?);
    Ok((place, power(place)))
}

/// The linear device at its best.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LinearBest {
    /// Frequency (Hz).
    pub frequency: f64,
    /// Mean power in the load (W).
    pub power: f64,
    /// Amplitude of the tip (beam lengths).
    pub tip: f64,
}

/// What the linear device of `scenario` gives at its own first resonance under the same acceleration of the base, which
/// may take an amplitude there that no run of the nonlinear device is allowed.
///
/// # Errors
/// [`DesignError`].
pub fn linear_at_its_best(scenario: &Scenario) -> Result<LinearBest, DesignError> {
    let own = Plant::new(scenario)?.without_magnets()?;
    let first = own.modes.iter().map(|mode| mode.omega).fold(f64::INFINITY, f64::min);
    let (omega, _) = linear_peak(&Plant::new(scenario)?, (0.6 * first, 1.4 * first))?;
    let mut there = scenario.clone();
    there.parameters.omega = omega;
    let plant = Plant::new(&there)?;
    let response = LinearResponse::new(&plant.without_magnets()?)?;
    // Everything is in proportion to the amplitude.
    let ratio = (own.parameters.omega / omega).powi(2);
    let v_rms = ratio * response.voltage.norm() * std::f64::consts::FRAC_1_SQRT_2;
    Ok(LinearBest {
        frequency: plant.units.hertz(omega),
        power: plant.watts(v_rms),
        tip: ratio * response.tip().norm(),
    })
}

/// Where `power` is highest, near the best of the ascending `omegas`.
fn peak(power: impl Fn(f64) -> f64, omegas: &[f64]) -> f64 {
    let values: Vec<f64> = omegas.iter().map(|omega| power(*omega)).collect();
    let highest = (0..values.len()).max_by(|i, j| values[*i].total_cmp(&values[*j])).unwrap_or(0);
    let around = (omegas[highest.saturating_sub(1)], omegas[(highest + 1).min(omegas.len() - 1)]);
    highest_place(power, around, SECTIONS)
}

/// These frequencies, and more about the resonances of `system`, within the window.
fn frequencies(
    system: &ReducedSystem,
    window: (f64, f64),
    omegas: impl Iterator<Item = f64>,
) -> Result<Vec<f64>, DesignError> {
    about_resonances(system, window, omegas, &ABOUT_RESONANCE, &[1.0])
}

/// These frequencies (omega) and, about the `multiples` of the eigenfrequencies of `system`, those at these `distances` in the
/// resonance's own widths, ascending and within the window.
///
/// # Errors
/// [`DesignError`] when the eigenvalues cannot be computed.
pub(in crate::questions) fn about_resonances(
    system: &ReducedSystem,
    window: (f64, f64),
    omegas: impl Iterator<Item = f64>,
    distances: &[f64],
    multiples: &[f64],
) -> Result<Vec<f64>, DesignError> {
    let mut omegas: Vec<f64> = omegas.collect();
    for value in eigenvalues(system)?.into_iter().filter(|value| value.im > 0.0) {
        for (multiple, distance) in multiples.iter().flat_map(|m| distances.iter().map(move |d| (m, d))) {
            omegas.extend([-1.0, 1.0].map(|side| multiple * (value.im + side * distance * value.re.abs())));
        }
    }
    omegas.retain(|omega| (window.0..=window.1).contains(omega));
    omegas.sort_by(f64::total_cmp);
    omegas.dedup();
    Ok(omegas)
}

/// Where `f` is highest between the ends of a bracket that holds one peak, by as many golden sections.
pub(super) fn highest_place(
    mut f: impl FnMut(f64) -> f64,
    (mut low, mut high): (f64, f64),
    sections: usize,
) -> f64 {
    let golden = 0.5 * (5.0_f64.sqrt() - 1.0);
    let (mut a, mut b) = (high - golden * (high - low), low + golden * (high - low));
    let (mut at_a, mut at_b) = (f(a), f(b));
    for _ in 0..sections {
        if at_a < at_b {
            (low, a, at_a) = (a, b, at_b);
            b = low + golden * (high - low);
            at_b = f(b);
        } else {
            (high, b, at_b) = (b, a, at_a);
            a = high - golden * (high - low);
            at_a = f(a);
        }
    }
    if at_a < at_b { b } else { a }
}

/// Where `inside` ceases to hold between a place where it does and one where it does not.
fn crossing(inside: impl Fn(f64) -> bool, mut within: f64, mut outside: f64) -> f64 {
    for _ in 0..HALVINGS {
        let middle = 0.5 * (within + outside);
        if inside(middle) { within = middle } else { outside = middle }
    }
    within
}
