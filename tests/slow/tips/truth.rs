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
/// Part of the distance that is left when the decay by the multipliers is looked at.
const DECAY: f64 = 0.1;

/// Batches of the last stretch, whose scatter tells how far its mean is off by chance, and how many standard errors that is.
const BATCHES: usize = 10;
const ERRORS: f64 = 4.0;
/// Where a run that did not arrive is followed beside another one: how far from it that begins, relative to the gap, for how
/// many periods, and how far apart, relative to the largest displacement, chaos drives them in that time. On a torus two
/// motions part in proportion to the time only.
const BESIDE: f64 = 1e-8;
const FOLLOWED: usize = 2000;
const APART: f64 = 1e-2;

/// What the run came to.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Truth {
    /// It has arrived at this stable orbit.
    Periodic(Box<Orbit>),
    /// It escaped or touched.
    Ended,
    /// Neither: a torus, chaos, or a transient without end.
    Open {
        /// Root mean square of the voltage over the last tenth (V).
        v_rms: f64,
        /// How far that is off by chance, relative.
        chance: f64,
        /// Whether neighbours part as on a chaotic motion.
        chaotic: bool,
    },
}

/// A run that can be continued by whole excitation periods.
pub(crate) trait Run: Sized {
    /// Another one from here, its first displacement larger by `by` (beam lengths).
    fn beside(&self, by: f64) -> Self;
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
    let (mut earlier, mut open, mut chance) = (None, f64::NAN, f64::NAN);
    let mut always_closer = [true; LONGEST];
    while done < length.most {
        let until = if done == 0 { length.first } else { (done + done / 2).min(length.most) };
        let tenth = ((until - done) / 10).max(2 * LONGEST);
        if run.advance(until.saturating_sub(tenth + done)).is_none() {
            return Truth::Ended;
        }
        let batch = (tenth - LONGEST).div_ceil(BATCHES);
        let mut squares = Vec::new();
        for _ in 0..BATCHES {
            let Some(square) = run.advance(batch) else { return Truth::Ended };
            squares.push(square / (batch as f64 * period));
        }
        let mut last = vec![run.state()];
        for _ in 0..LONGEST {
            if run.advance(1).is_none() {
                return Truth::Ended;
            }
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
            let off = |state: &[f64]| off(system, &orbit, state);
            let unit = size.max(1e-4 * system.equilibrium.gap);
            let near = if done < length.least { EARLY } else { ARRIVED };
            if orbit.stable() && off(&state) <= near * unit {
                return Truth::Periodic(Box::new(orbit));
            }
            // A slow transient may look steady; chaos does not come closer at every look.
            let closer = earlier.as_ref().is_none_or(|earlier: &Vec<f64>| off(&state) < off(earlier));
            always_closer[periods - 1] &= closer;
            leaving |= orbit.stable() && always_closer[periods - 1];
            let before = &last[last.len() - 1 - periods * (LONGEST / periods)];
            let shrinks = earlier.as_ref().is_some_and(|earlier: &Vec<f64>| off(&state) < 0.5 * off(earlier));
            let arrives = off(&state) <= 0.1 * unit && shrinks && off(&state) < off(before);
            if orbit.stable() && arrives && done >= length.least {
                match decays(system, run, &orbit, length.most) {
                    Some(true) => return Truth::Periodic(Box::new(orbit)),
                    Some(false) => {}
                    None => return Truth::Ended,
                }
            }
            // Whatever is near may still be approached, or left.
            leaving |= off(&state) <= 0.3 * unit;
        }
        earlier = Some(state);
        let mean = squares.iter().sum::<f64>() / BATCHES as f64;
        let variance =
            squares.iter().map(|square| (square - mean).powi(2)).sum::<f64>() / (BATCHES - 1) as f64;
        let now = mean.sqrt();
        // Of a square the relative error is twice that of its root.
        chance = 0.5 * ERRORS * (variance / BATCHES as f64).sqrt() / mean;
        // What drifts is still on its way.
        let steady = (now / open - 1.0).abs() <= STEADY;
        open = now;
        if steady && !leaving && done >= length.least {
            break;
        }
    }
    chaotic(system, run).map_or(Truth::Ended, |chaotic| Truth::Open { v_rms: open, chance, chaotic })
}

/// Whether `run`, near the stable `orbit`, comes closer as its multipliers say, twice by [`DECAY`] of the distance: a torus
/// about it passes closer and farther. `None` when the run ends.
fn decays(system: &ReducedSystem, run: &mut impl Run, orbit: &Orbit, most: usize) -> Option<bool> {
    let turns = DECAY.ln() / orbit.largest_multiplier().norm().ln();
    let turns = (turns.ceil() as usize).clamp(1, most / orbit.periods);
    let mut before = off(system, orbit, &run.state());
    for _ in 0..2 {
        run.advance(turns * orbit.periods)?;
        let now = off(system, orbit, &run.state());
        if now > DECAY.sqrt() * before && now > EARLY {
            return Some(false);
        }
        before = now;
    }
    Some(true)
}

/// Largest component of the difference of `state` from the orbit's.
fn off(system: &ReducedSystem, orbit: &Orbit, state: &[f64]) -> f64 {
    let parts = state.iter().zip(&orbit.state).zip(scales(system));
    parts.map(|((a, b), scale)| ((a - b) / scale).abs()).fold(0.0, f64::max)
}

/// Whether `run` and one beside it part as on a chaotic motion; `None` when one of them ends.
fn chaotic(system: &ReducedSystem, run: &mut impl Run) -> Option<bool> {
    let mut other = run.beside(BESIDE * system.equilibrium.gap);
    let (mut apart, mut largest) = (0.0_f64, 0.0_f64);
    for _ in 0..FOLLOWED {
        run.advance(1)?;
        other.advance(1)?;
        let [a, b] = [run.state(), other.state()].map(|state| system.tip_displacement(&state));
        apart = apart.max((a - b).abs());
        largest = largest.max(a.abs());
    }
    Some(apart > APART * largest)
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
        (Truth::Open { v_rms: expected, chaotic: false, .. }, Motion::Quasiperiodic) => near(*expected),
        (Truth::Open { v_rms: expected, chance, chaotic: true }, Motion::Chaotic) => {
            (v_rms / expected - 1.0).abs() <= room.max(*chance)
        }
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
