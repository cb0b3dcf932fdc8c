//! What a start leads to by brute force: a long run at a tight tolerance, closed by Newton's iteration from its end. It uses
//! nothing of what the verdict is made of but the map, which other tests hold to their own truths; whoever asks brings the
//! integrator.

use harvester_lab::dynamics::{Motion, Orbit};
use harvester_lab::model::ReducedSystem;

/// Longest period that is looked for.
const LONGEST: usize = 12;
/// Change of the voltage from one stretch of the run to the next, relative, that is none.
const STEADY: f64 = 0.02;
/// Distance from the orbit, relative to its size, at which the run has arrived, and at which it may stop before its time.
const ARRIVED: f64 = 1e-3;
const EARLY: f64 = 1e-6;

/// By how much averages of a chaotic motion over some thousand periods may differ by chance, relative.
const CHANCE: f64 = 0.25;

/// What the run came to.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Truth {
    /// It has arrived at this stable orbit.
    Periodic(Box<Orbit>),
    /// It escaped or touched.
    Ended,
    /// Neither, with the root mean square of the voltage over the last tenth: a torus, chaos, or a transient without end.
    Open(f64),
}

/// A run that can be continued by whole excitation periods.
pub(crate) trait Run {
    /// Continues for so many, and returns the integral of v^2 over them; `None` when the run ends.
    fn advance(&mut self, periods: usize) -> Option<f64>;
    /// The state at a stroboscopic instant.
    fn state(&self) -> Vec<f64>;
}

/// How long a run is, in excitation periods.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Length {
    /// The first look at it, which ends it when it has long arrived.
    pub(crate) first: usize,
    /// Before this it is not given up as open.
    pub(crate) least: usize,
    /// After this a run that still leaves an unstable motion is.
    pub(crate) most: usize,
}

/// Follows `run` of `system`.
pub(crate) fn follow(system: &ReducedSystem, run: &mut impl Run, length: Length) -> Truth {
    let period = system.parameters.period();
    let mut done = 0;
    let (mut earlier, mut open) = (None, f64::NAN);
    while done < length.most {
        let until = if done == 0 { length.first } else { (done + done / 2).min(length.most) };
        let tenth = ((until - done) / 10).max(2 * LONGEST);
        if run.advance(until.saturating_sub(tenth + done)).is_none() {
            return Truth::Ended;
        }
        let Some(mut square) = run.advance(tenth - LONGEST) else { return Truth::Ended };
        let mut last = vec![run.state()];
        for _ in 0..LONGEST {
            let Some(one) = run.advance(1) else { return Truth::Ended };
            square += one;
            last.push(run.state());
        }
        done = until;
        let mut leaving = false;
        let state = run.state();
        for periods in 1..=LONGEST {
            let Ok(orbit) = Orbit::find(system, Some(&state), periods) else { continue };
            let size = orbit
                .state
                .iter()
                .zip(scales(system))
                .map(|(y, scale)| (y / scale).abs())
                .fold(0.0, f64::max);
            let off = |state: &[f64]| {
                let parts = state.iter().zip(&orbit.state).zip(scales(system));
                parts.map(|((a, b), scale)| ((a - b) / scale).abs()).fold(0.0, f64::max)
            };
            let unit = size.max(1e-4 * system.equilibrium.gap);
            let near = if done < length.least { EARLY } else { ARRIVED };
            if orbit.stable() && off(&state) <= near * unit {
                return Truth::Periodic(Box::new(orbit));
            }
            let before = &last[last.len() - 1 - periods * (LONGEST / periods)];
            let shrinks = earlier.as_ref().is_some_and(|earlier: &Vec<f64>| off(&state) < 0.5 * off(earlier));
            let arrives = off(&state) <= 0.1 * unit && shrinks && off(&state) < off(before);
            if orbit.stable() && arrives && done >= length.least {
                return Truth::Periodic(Box::new(orbit));
            }
            // Whatever is near may still be approached, or left.
            leaving |= off(&state) <= 0.3 * unit;
        }
        earlier = Some(state);
        let now = (square / (tenth as f64 * period)).sqrt();
        // What drifts is still on its way.
        let steady = (now / open - 1.0).abs() <= STEADY;
        open = now;
        if steady && !leaving && done >= length.least {
            break;
        }
    }
    Truth::Open(open)
}

/// How an answer stands to the truth.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Standing {
    /// The class is right, and the voltage within the room given.
    Right,
    /// It claims nothing.
    Undecided,
    /// It claims something else.
    Wrong,
}

/// Of an answer with this `motion` and voltage, which may be off by `room`, relative.
pub(crate) fn standing(truth: &Truth, motion: Motion, v_rms: f64, room: f64) -> Standing {
    if matches!(motion, Motion::Undecided { .. }) {
        return Standing::Undecided;
    }
    let near = |expected: f64| (v_rms / expected - 1.0).abs() <= room;
    let right = match (truth, motion) {
        (Truth::Periodic(orbit), Motion::Periodic { periods }) => {
            periods == orbit.periods && near(orbit.measures.v_rms)
        }
        (Truth::Ended, Motion::Escape { .. } | Motion::Contact { .. }) => true,
        (Truth::Open(expected), Motion::Quasiperiodic) => near(*expected),
        (Truth::Open(expected), Motion::Chaotic) => (v_rms / expected - 1.0).abs() <= CHANCE,
        _ => false,
    };
    if right { Standing::Right } else { Standing::Wrong }
}

/// Displacements, velocities and voltages of comparable energy.
fn scales(system: &ReducedSystem) -> Vec<f64> {
    let first = &system.modes[0];
    let voltage = first.omega * (first.eta2 / system.parameters.c).sqrt();
    let velocities = system.modes.iter().map(|mode| mode.omega);
    std::iter::repeat_n(1.0, system.modes.len()).chain(velocities).chain([voltage]).collect()
}
