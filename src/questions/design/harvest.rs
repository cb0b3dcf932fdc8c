//! What a device harvests under its own excitation: the linear device without magnets, the forced motion, and the
//! motion that its start leads to, side by side.

use serde::{Deserialize, Serialize};

use super::linear::linear_balance;
use super::{DesignError, Plant};
use crate::dynamics::attractors::dielectric::{WithLoss, orbit_with_loss};
use crate::dynamics::attractors::rotation::{weighted_average, weights};
use crate::dynamics::{Balance, ForcedMotion, Measures, Motion, Reached, arrive};
use crate::model::{Demand, ReducedSystem};
use crate::questions::batch_means::mean_error;
use crate::scenario::Scenario;

/// Excitation periods over which a motion that never repeats is measured, and those of each batch of them.
const RECORD: usize = 2048;
const BATCH: usize = 32;

/// What a steady motion delivers and what it costs.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, nanoserde::SerBin, nanoserde::DeBin)]
pub struct Harvest {
    /// Means and extremes in SI units: V, W (V^2/R_eq in the load), mm.
    #[serde(flatten)]
    pub measures: Measures,
    /// Error of the mean power (W) of a motion that never repeats: the standard error by the scatter along its record, or half the
    /// distance from the mean of the run before it where that is more; on a torus how far the means of its halves differ; absent
    /// where the motion repeats.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub power_error: Option<f64>,
    /// The power over the square of the peak of the base's acceleration (W/g^2); `None` at rest.
    pub power_per_g2: Option<f64>,
    /// Mean power that the shaken base puts in (W).
    pub input: f64,
    /// Mean power lost in the material's damping and to the air (W).
    pub viscous: f64,
    /// Mean power lost in the dielectric (W).
    pub dielectric: f64,
    /// power / input (dimensionless); `None` without input.
    pub efficiency: Option<f64>,
    /// |input - power - losses - energy stored| over the largest of them: what the computation has lost.
    pub defect: f64,
    /// What it asks of the device, for the limits.
    pub demand: Demand,
}

impl Harvest {
    /// Of a motion of `system`, one of `plant`, with its `balance`.
    pub fn new(plant: &Plant, system: &ReducedSystem, balance: &Balance) -> Self {
        let p = &system.parameters;
        let units = &plant.units;
        let share = if p.kappa > 0.0 { plant.load / p.kappa } else { 0.0 };
        let electrical = balance.measures.power;
        let power = units.watts(share * electrical);
        let acceleration = units.acceleration(p.beta, p.omega);
        let per_input = electrical * share / balance.input;
        Self {
            measures: Measures { power, ..plant.in_si(&balance.measures) },
            power_error: None,
            power_per_g2: (acceleration > 0.0).then(|| power / (acceleration * acceleration)),
            input: units.watts(balance.input),
            viscous: units.watts(balance.viscous),
            dielectric: units.watts((1.0 - share) * electrical),
            efficiency: (balance.input > 0.0).then_some(per_input),
            defect: balance.defect(),
            demand: balance.measures.demand(),
        }
    }
}

/// The forced motion, which grows out of rest with the excitation.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, nanoserde::SerBin, nanoserde::DeBin)]
pub struct Forced {
    /// What it delivers, whether it is stable or not.
    pub harvest: Harvest,
    /// Whether it is stable.
    pub stable: bool,
    /// Modulus of its largest multiplier.
    pub multiplier: f64,
}

/// The motion that the start leads to.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, nanoserde::SerBin, nanoserde::DeBin)]
pub struct Lasting {
    /// Its class.
    pub motion: Motion,
    /// What it delivers; `None` when it ended.
    pub harvest: Option<Harvest>,
    /// Frequency (Hz) of the largest line of its voltage, at which its dielectric loss is taken: half of the excitation's
    /// for many a doubled motion. `None` without such a loss.
    pub dielectric_frequency: Option<f64>,
}

/// Three motions of one device under one excitation.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, nanoserde::SerBin, nanoserde::DeBin)]
pub struct Operating {
    /// Excitation frequency (Hz).
    pub frequency: f64,
    /// Peak of the base's acceleration (g, of 9.80665 m/s^2).
    pub acceleration: f64,
    /// Load resistance (ohm); absent without a load.
    pub resistance: Option<f64>,
    /// The device without its magnets, in closed form.
    pub linear: Harvest,
    /// The forced motion; `None` when it cannot be followed to this excitation.
    pub forced: Option<Forced>,
    /// The motion that the scenario's start leads to.
    pub reached: Lasting,
    /// Power of the forced motion over that of the linear device, be it a gain or a loss; `None` without one of them.
    pub forced_gain: Option<f64>,
    /// Power of the motion reached over that of the linear device.
    pub reached_gain: Option<f64>,
}

/// What the device of `scenario` harvests under its own excitation.
///
/// The comparison is with the same device without magnets, same beam, damping, load and excitation, at this one
/// frequency: close to the linear device's own resonance the magnets may well lose.
///
/// # Errors
/// [`DesignError`].
pub fn operating(scenario: &Scenario) -> Result<Operating, DesignError> {
    let plant = Plant::new(scenario)?;
    let (system, initial) = plant.scenario.validate()?;
    let bare = plant.without_magnets()?;
    let linear = Harvest::new(&plant, &bare, &linear_balance(&bare)?);
    let forced = match ForcedMotion::of(&system).ok().and_then(|forced| forced.orbit) {
        None => None,
        Some(orbit) => {
            let own = orbit_with_loss(&system, plant.along, (&orbit.state, orbit.periods))?;
            let (system, orbit) = own.unwrap_or_else(|| (system.clone(), orbit));
            Balance::of(&system, &orbit.state, orbit.periods)?.map(|balance| Forced {
                harvest: Harvest::new(&plant, &system, &balance),
                stable: orbit.stable(),
                multiplier: orbit.largest_multiplier().norm(),
            })
        }
    };
    let reached = lasting(&plant, &system, &initial)?;
    let least = linear.measures.power;
    let gain = |harvest: &Harvest| (least > 0.0).then(|| harvest.measures.power / least);
    let p = &system.parameters;
    Ok(Operating {
        frequency: plant.units.hertz(p.omega),
        acceleration: plant.units.acceleration(p.beta, p.omega),
        resistance: Some(plant.resistance()).filter(|resistance| resistance.is_finite()),
        forced_gain: forced.as_ref().and_then(|forced| gain(&forced.harvest)),
        reached_gain: reached.harvest.as_ref().and_then(gain),
        linear,
        forced,
        reached,
    })
}

/// The motion that the start of `system`, one of `plant`, in `initial` leads to: for one start that people will rely on, undecided
/// where rounding decides on it. The power is then that of one of the motions.
///
/// # Errors
/// As [`Plant::with_loss`].
pub fn lasting(plant: &Plant, system: &ReducedSystem, initial: &[f64]) -> Result<Lasting, DesignError> {
    delivering(plant.with_loss(system, &|system| arrive(system, initial))?)
}

/// The same for one sample of many, which is not held against others.
///
/// # Errors
/// As [`Plant::with_loss`].
pub fn sampled(plant: &Plant, system: &ReducedSystem, initial: &[f64]) -> Result<Lasting, DesignError> {
    delivering(plant.reach(system, initial)?)
}

fn delivering((plant, found): (Plant, WithLoss)) -> Result<Lasting, DesignError> {
    let WithLoss { system, reached, line } = found;
    let motion = reached.motion;
    let period = match (&reached.orbit, motion) {
        (Some(orbit), _) => Some((&orbit.state, orbit.periods)),
        (None, Motion::Periodic { periods }) => Some((&reached.state, periods)),
        (None, _) => None,
    };
    let harvest = match (period, motion) {
        (_, Motion::Escape { .. } | Motion::Contact { .. }) => None,
        (Some((state, periods)), _) => {
            Balance::of(&system, state, periods)?.map(|balance| Harvest::new(&plant, &system, &balance))
        }
        (None, _) => never_repeating(&plant, &system, &reached)?,
    };
    Ok(Lasting { motion, harvest, dielectric_frequency: line.map(|line| plant.units.hertz(line)) })
}

/// What a motion of `system`, one of `plant`, that never repeats delivers, by a record of it.
fn never_repeating(
    plant: &Plant,
    system: &ReducedSystem,
    reached: &Reached,
) -> Result<Option<Harvest>, DesignError> {
    // On a torus these means come much closer than plain ones.
    let on_a_torus = reached.motion == Motion::Quasiperiodic;
    let weights = if on_a_torus { weights(RECORD) } else { vec![1.0 / RECORD as f64; RECORD] };
    let Some((balance, powers)) = Balance::averaged(system, &reached.state, &weights)? else {
        return Ok(None);
    };
    let error = if on_a_torus {
        let (early, late) = powers.split_at(RECORD / 2);
        Some((weighted_average(early) - weighted_average(late)).abs())
    } else {
        let means = powers.chunks_exact(BATCH).map(|batch| batch.iter().sum::<f64>() / BATCH as f64);
        // Chaos may swell and sink over more periods than the record has: what the run before it gave tells.
        let before = reached.measures.map_or(balance.measures.power, |measures| measures.power);
        let apart = 0.5 * (before - balance.measures.power).abs();
        mean_error(&means.collect::<Vec<_>>()).map(|error| error.max(apart))
    };
    let harvest = Harvest::new(plant, system, &balance);
    let electrical = balance.measures.power;
    let power_error =
        error.filter(|_| electrical > 0.0).map(|error| harvest.measures.power * error / electrical);
    Ok(Some(Harvest { power_error, ..harvest }))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::{ForceLaw, ModelChoice, ParameterSet};

    #[test]
    fn the_powers_of_chaotic_motions_scatter_as_their_errors_say() -> Result<(), DesignError> {
        let powers = (0..6).map(|k| {
            let beta = 0.05 * (1.0 + 1e-9 * f64::from(k));
            let parameters = ParameterSet { alpha: 1e-4, beta, omega: 11.0, ..Default::default() };
            let model = ModelChoice { force: ForceLaw::Exact, ..Default::default() };
            let plant = Plant::new(&Scenario { parameters, model, ..Default::default() })?;
            let (system, initial) = plant.scenario.validate()?;
            let found = sampled(&plant, &system, &initial)?;
            assert_eq!(found.motion, Motion::Chaotic);
            let harvest = found.harvest.expect("it lasts");
            Ok((harvest.measures.power, harvest.power_error.expect("it never repeats")))
        });
        let powers: Vec<(f64, f64)> = powers.collect::<Result<_, DesignError>>()?;
        let count = powers.len() as f64;
        let mean = powers.iter().map(|(power, _)| power).sum::<f64>() / count;
        let scatter = powers.iter().map(|(power, _)| (power - mean).powi(2)).sum::<f64>() / (count - 1.0);
        let error = powers.iter().map(|(_, error)| error * error).sum::<f64>() / count;
        // Of six values, this quotient is between these in 98 of 100 cases (chi squared of five degrees of freedom).
        assert!((0.11..3.02).contains(&(scatter / error)), "{powers:?}");
        Ok(())
    }

    #[test]
    fn the_error_knows_of_chaos_that_swells_for_longer_than_the_record() -> Result<(), DesignError> {
        // Another integrator's mean over 60,000 periods: 1.63 mW, each 15,000 of them 1.34 to 1.97. The first start's record
        // lies in a lull of 0.29 mW.
        const POWER: f64 = 1.63e-3;
        for beta in [0.0028156997679850415, 0.0028156997679850415 * (1.0 + 7e-9)] {
            let parameters = ParameterSet {
                alpha: 0.00012391363144238324,
                beta,
                omega: 21.59320131268024,
                ..Default::default()
            };
            let model = ModelChoice { force: ForceLaw::Exact, residual_moment: true, ..Default::default() };
            let plant = Plant::new(&Scenario { parameters, model, ..Default::default() })?;
            let (system, initial) = plant.scenario.validate()?;
            let harvest = lasting(&plant, &system, &initial)?.harvest.expect("it lasts");
            let (power, error) = (harvest.measures.power, harvest.power_error.expect("it never repeats"));
            assert!((power - POWER).abs() < 4.0 * error, "{power} {error}");
        }
        Ok(())
    }
}
