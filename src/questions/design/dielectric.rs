//! The dielectric loss at a motion's own frequency: tan delta omega c is a conductance only where omega is known, and a
//! doubled motion has its voltage at half of the excitation's.

use std::f64::consts::TAU;

use nalgebra::Complex;

use super::{DesignError, Plant};
use crate::dynamics::attractors::motion::Reached;
use crate::dynamics::{Effort, IntegrationError, Motion, Settings, Trajectory, reach};
use crate::model::materials::dielectric_conductance;
use crate::model::{ParameterSet, ReducedSystem};

/// Voltages read in an excitation period, and how many of its harmonics are looked at.
const SAMPLES: usize = 64;
const HARMONICS: usize = 16;
/// Excitation periods looked at of a motion that never repeats.
const RECORD: usize = 64;
/// How often the motion is computed again with the loss at its main line before it is taken as it is.
const ROUNDS: usize = 4;
/// Two frequencies are the same within this.
const SAME: f64 = 1e-3;

/// A motion reached with the dielectric loss that belongs to it.
pub(super) struct Settled {
    /// The plant with that loss.
    pub plant: Plant,
    /// Its system.
    pub system: ReducedSystem,
    /// The motion.
    pub reached: Reached,
    /// Angular frequency (dimensionless) of the voltage's main line, at which the loss is taken; `None` without a loss
    /// or a voltage.
    pub omega: Option<f64>,
}

/// The motion that the start `initial` of `system`, one of `plant`, leads to, its dielectric loss taken at the frequency
/// of the largest line of its voltage. The plant's own loss is the first guess; where motion and loss do not come to
/// agree within a few rounds the last ones are the answer.
///
/// # Errors
/// As [`reach`], and [`DesignError::Model`] when the conductance is out of range.
pub(super) fn settle(
    plant: &Plant,
    system: &ReducedSystem,
    initial: &[f64],
    effort: Effort,
) -> Result<Settled, DesignError> {
    let (mut plant, mut system) = (plant.clone(), system.clone());
    let loss_tangent = plant.scenario.base().loss_tangent;
    let mut rounds = 0;
    loop {
        let reached = reach(&system, initial, effort)?;
        let omega = if loss_tangent > 0.0 { main_line(&system, &reached)? } else { None };
        let Some(line) = omega else { return Ok(Settled { plant, system, reached, omega }) };
        let leakage = dielectric_conductance(loss_tangent, line, system.parameters.c);
        if (plant.leakage / leakage - 1.0).abs() < SAME || rounds == ROUNDS {
            return Ok(Settled { plant, system, reached, omega });
        }
        plant = plant.with_leakage(leakage)?;
        let set = ParameterSet { kappa: plant.scenario.parameters.kappa, ..*system.parameters };
        system = system.with_numbers(set)?;
        rounds += 1;
    }
}

/// Angular frequency of the largest line of the voltage of the motion `reached` by `system`; `None` where it ended, and
/// without any voltage.
fn main_line(system: &ReducedSystem, reached: &Reached) -> Result<Option<f64>, IntegrationError> {
    if matches!(reached.motion, Motion::Escape { .. } | Motion::Contact { .. }) {
        return Ok(None);
    }
    let (state, periods) = match &reached.orbit {
        Some(orbit) => (&orbit.state, orbit.periods),
        None => (&reached.state, RECORD),
    };
    let (duration, count) = (periods as f64 * system.parameters.period(), SAMPLES * periods);
    let run = Trajectory::compute(system, state, duration, Settings::default())?;
    let mut voltages = Vec::with_capacity(count);
    let spacing = duration / count as f64;
    let times: Vec<f64> = (0..count).map(|i| spacing * i as f64).collect();
    run.read_at(&times, |_, state| voltages.push(state[state.len() - 1]));
    let square = |k: usize| {
        let line = voltages.iter().enumerate().map(|(i, v)| {
            // The angle within a turn, where its sine keeps all digits.
            Complex::from_polar(*v, TAU * (k * i % count) as f64 / count as f64)
        });
        line.sum::<Complex<f64>>().norm_sqr()
    };
    let largest = (1..=HARMONICS * periods).map(|k| (k, square(k))).max_by(|a, b| a.1.total_cmp(&b.1));
    let line = largest.filter(|(_, square)| *square > 0.0);
    Ok(line.map(|(k, _)| k as f64 * system.parameters.omega / periods as f64))
}
