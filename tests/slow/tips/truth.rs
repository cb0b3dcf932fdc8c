//! What a start leads to by brute force: a long run at a tight tolerance, closed by Newton's iteration from its end. It uses
//! nothing of what the verdict is made of but the integrator and the map, which other tests hold to their own truths.

use harvester_lab::dynamics::{Collocation, Motion, Orbit, Outcome, Settings};
use harvester_lab::model::ReducedSystem;

/// Dimensionless time of the run, at least.
const DURATION: f64 = 20_000.0;
/// Excitation periods after which a run that still leaves an unstable motion is given up.
const MOST_PERIODS: usize = 4_000_000;
/// Longest period that is looked for.
const LONGEST: usize = 12;
/// Change of the voltage from one stretch of the run to the next, relative, that is none.
const STEADY: f64 = 0.02;
/// Distance from the orbit, relative to its size, at which the run has arrived.
const ARRIVED: f64 = 1e-3;

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

/// Follows the start of `system` at rest.
pub(crate) fn from_rest(system: &ReducedSystem) -> Truth {
    let settings = Settings { tolerance: 1e-9 };
    let rest = vec![0.0; system.dimension()];
    let mut run = Collocation::new(system, &rest, settings).expect("a start");
    let period = system.parameters.period();
    let least = (DURATION / period).ceil() as usize;
    let mut done = 0;
    let (mut earlier, mut open) = (None, f64::NAN);
    while done < MOST_PERIODS {
        let until = if done == 0 { least } else { (done + done / 2).min(MOST_PERIODS) };
        let mut last: Vec<Vec<f64>> = Vec::new();
        let (mut square, mut count) = (0.0, 0.0);
        let tenth = until - (until - done) / 10;
        while done < until {
            let outcome = run.advance(f64::INFINITY, 1, &mut |step| {
                if step.index == 0 {
                    done += 1;
                    last.push(step.start[..rest.len()].to_vec());
                }
                if done > tenth {
                    let v = step.start[rest.len() - 1];
                    square += v * v * step.tables.step;
                    count += step.tables.step;
                }
            });
            match outcome.expect("a run") {
                None => {}
                Some(Outcome::Completed) => unreachable!("a run without an end"),
                Some(_) => return Truth::Ended,
            }
            if last.len() > 4 * LONGEST {
                last.drain(..2 * LONGEST);
            }
        }
        let mut leaving = false;
        let state = last.last().expect("a state").clone();
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
            let before = last[last.len() - 1 - periods * ((last.len() - 1) / periods)].clone();
            if orbit.stable() && off(&state) <= ARRIVED * unit {
                return Truth::Periodic(Box::new(orbit));
            }
            let shrinks = earlier.as_ref().is_some_and(|earlier: &Vec<f64>| off(&state) < 0.5 * off(earlier));
            if orbit.stable() && off(&state) <= 0.1 * unit && shrinks && off(&state) < off(&before) {
                return Truth::Periodic(Box::new(orbit));
            }
            // Whatever is near may still be approached, or left.
            leaving |= off(&state) <= 0.3 * unit;
        }
        earlier = Some(state);
        let now = (square / count).sqrt();
        // What drifts is still on its way.
        let steady = (now / open - 1.0).abs() <= STEADY;
        open = now;
        if steady && !leaving {
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
        (Truth::Open(expected), Motion::Quasiperiodic | Motion::Chaotic) => near(*expected),
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
