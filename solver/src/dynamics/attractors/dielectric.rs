//! The dielectric loss at a motion's own frequency: tan delta omega c is a conductance only where omega is known, and a
//! doubled motion has its voltage at half of the excitation's.

use std::f64::consts::TAU;

use nalgebra::Complex;

use super::motion::{Motion, Reached};
use crate::dynamics::integration::{IntegrationError, RunError, Settings, Trajectory};
use crate::dynamics::orbits::{Orbit, OrbitError};
use crate::model::{Along, ModelError, ReducedSystem};

/// Voltages read in an excitation period, and how many of its harmonics are looked at.
const SAMPLES: usize = 64;
const HARMONICS: usize = 16;
/// Excitation periods looked at of a motion that never repeats.
const RECORD: usize = 64;
/// How often the motion is computed again with the loss at its main line before it is taken as it is.
const ROUNDS: usize = 4;
/// Two conductances are the same within this part.
const SAME: f64 = 1e-3;

/// A motion reached with the dielectric loss that belongs to it.
#[derive(Debug, Clone)]
pub struct WithLoss {
    /// The system with that loss.
    pub system: ReducedSystem,
    /// The motion.
    pub reached: Reached,
    /// Angular frequency (dimensionless) of the voltage's main line, at which the loss is taken; `None` without a loss
    /// or a voltage.
    pub line: Option<f64>,
}

/// The motion that a start of `system` leads to as `reach` says, the dielectric loss that `along` says is in its kappa taken at
/// the frequency of the largest line of its voltage, not at the excitation's. Where motion and loss do not come to agree within
/// a few rounds the last ones are the answer.
///
/// # Errors
/// As `reach`, and [`RunError::Model`] when the conductance is out of range.
pub fn reach_with_loss(
    system: &ReducedSystem,
    along: Along,
    reach: &dyn Fn(&ReducedSystem) -> Result<Reached, IntegrationError>,
) -> Result<WithLoss, RunError> {
    let mut there = system.clone();
    let mut rounds = 0;
    loop {
        let reached = reach(&there)?;
        let lasts = !matches!(reached.motion, Motion::Escape { .. } | Motion::Contact { .. });
        let line = if along.dielectric > 0.0 && lasts {
            let (state, periods) = match &reached.orbit {
                Some(orbit) => (&orbit.state, orbit.periods),
                None => (&reached.state, RECORD),
            };
            main_line(&there, state, periods)?
        } else {
            None
        };
        match line.map(|line| other_loss(system, &there, along, line)).transpose()?.flatten() {
            Some(other) if rounds < ROUNDS => there = other,
            _ => return Ok(WithLoss { system: there, reached, line }),
        }
        rounds += 1;
    }
}

/// The periodic motion near `state`, the beginning of one of `system` of so many `periods`, in the same manner, and the
/// system with its loss; `None` where that is `system`.
///
/// # Errors
/// As [`Orbit::find`].
pub fn orbit_with_loss(
    system: &ReducedSystem,
    along: Along,
    (state, periods): (&[f64], usize),
) -> Result<Option<(ReducedSystem, Orbit)>, OrbitError> {
    let mut there = system.clone();
    let mut found: Option<Orbit> = None;
    for _ in 0..if along.dielectric > 0.0 { ROUNDS } else { 0 } {
        let state = found.as_ref().map_or(state, |orbit| &orbit.state);
        let line = main_line(&there, state, periods)?;
        let Some(other) = line.map(|line| other_loss(system, &there, along, line)).transpose()?.flatten()
        else {
            break;
        };
        there = other;
        found = Some(Orbit::find(&there, Some(state), periods)?);
    }
    Ok(found.map(|orbit| (there, orbit)))
}

/// `system` with its loss at `line`, unless `there` has that one already.
fn other_loss(
    system: &ReducedSystem,
    there: &ReducedSystem,
    along: Along,
    line: f64,
) -> Result<Option<ReducedSystem>, ModelError> {
    let set = along.with_line_at(&system.parameters, line);
    let difference = (set.kappa - there.parameters.kappa).abs();
    let other = difference > SAME * along.dielectric * line;
    other.then(|| system.with_numbers(set)).transpose()
}

/// Angular frequency of the largest line of the voltage over so many `periods` of the excitation from `state` on; `None`
/// without any voltage.
fn main_line(system: &ReducedSystem, state: &[f64], periods: usize) -> Result<Option<f64>, IntegrationError> {
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
