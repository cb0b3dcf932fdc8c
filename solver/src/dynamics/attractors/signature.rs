//! What an attracting motion is recognised by, so that starts which lead to the same motion are known to.
//!
//! A periodic motion is known by its stroboscopic states: one of m excitation periods has m of them, and is the same
//! whichever comes first. Tori and chaotic motions have no such finite mark; two of them are the same when class and
//! mean voltage agree.

use serde::{Deserialize, Serialize};

use super::motion::{Cell, Motion, Reached};
use crate::dynamics::orbits::Orbit;
use crate::dynamics::orbits::period_map::{distance, scales};
use crate::model::ReducedSystem;

/// Distance, relative to the amplitude, below which stroboscopic states are the same.
const SAME_STATE: f64 = 1e-3;
/// Amplitude, relative to the gap, below which a motion is rest.
const SMALL: f64 = 1e-3;
/// Relative difference of voltages below which two tori are the same, and two chaotic motions, whose means are those of
/// a finite record.
const SAME_TORUS: f64 = 0.01;
const SAME_CHAOS: f64 = 0.25;

/// A motion with what it is recognised by.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, nanoserde::SerBin, nanoserde::DeBin)]
pub struct Signature {
    /// Class, means and extremes.
    pub cell: Cell,
    /// States of length 2N + 1 at stroboscopic instants: of a periodic motion one for each excitation period of its
    /// shortest period, in their order; of any other lasting motion the last one; none when the motion ended.
    pub states: Vec<Vec<f64>>,
}

impl Signature {
    /// Of what a start has `reached`.
    pub fn of(reached: Reached) -> Self {
        let cell = reached.cell();
        Self { cell, states: if cell.lasts() { reached.states } else { Vec::new() } }
    }

    /// Of a periodic motion with its `states` at the stroboscopic instants of its period.
    pub(super) fn of_orbit(orbit: &Orbit, states: Vec<Vec<f64>>) -> Self {
        let motion = Motion::Periodic { periods: orbit.periods };
        Self { cell: Cell::new(motion, Some(orbit.measures)), states }
    }
}

/// Compares motions of one device under one excitation.
#[derive(Debug, Clone)]
pub struct Recogniser {
    scales: Vec<f64>,
    gap: f64,
}

impl Recogniser {
    /// For motions of `system`.
    pub fn new(system: &ReducedSystem) -> Self {
        Self { scales: scales(system), gap: system.equilibrium.gap }
    }

    /// Whether `a` and `b` are the same motion. Escapes are all the same whenever they happen, so are contacts, and so
    /// are motions whose class is not decided.
    pub fn same(&self, a: &Signature, b: &Signature) -> bool {
        if !a.cell.motion.same_class(&b.cell.motion) {
            return false;
        }
        match a.cell.motion {
            Motion::Periodic { .. } => self.same_orbit(&a.states, &b.states),
            Motion::Quasiperiodic | Motion::Chaotic => {
                let room = if a.cell.motion == Motion::Chaotic { SAME_CHAOS } else { SAME_TORUS };
                let (a, b) = (a.cell.measures.v_rms, b.cell.measures.v_rms);
                (a - b).abs() <= room * a.max(b)
            }
            Motion::Escape { .. } | Motion::Contact { .. } | Motion::Undecided { .. } => true,
        }
    }

    /// The same of two ends of runs from one start: averages over chaotic motions differ by chance, so two of them are no
    /// two motions then.
    pub(super) fn same_end(&self, a: &Signature, b: &Signature) -> bool {
        [a, b].iter().all(|end| end.cell.motion == Motion::Chaotic) || self.same(a, b)
    }

    /// Whether the states coincide, begun at any of them.
    fn same_orbit(&self, a: &[Vec<f64>], b: &[Vec<f64>]) -> bool {
        if a.len() != b.len() {
            return false;
        }
        let components = |state: &Vec<f64>| {
            state.iter().zip(&self.scales).map(|(y, scale)| (y / scale).abs()).fold(0.0, f64::max)
        };
        let amplitude = a.iter().map(components).fold(SMALL * self.gap, f64::max);
        let near = |a: &Vec<f64>, b: &Vec<f64>| distance(a, b, &self.scales) <= SAME_STATE * amplitude;
        (0..b.len()).any(|shift| {
            let shifted = b.iter().cycle().skip(shift);
            a.iter().zip(shifted).all(|(a, b)| near(a, b))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dynamics::attractors::effort::Effort;
    use crate::dynamics::attractors::settle::reach;
    use crate::dynamics::integration::Measures;
    use crate::model::{ModelChoice, ParameterSet};

    fn signature(system: &ReducedSystem, initial: &[f64]) -> Signature {
        let reached = reach(system, initial, Effort::cell()).expect("a motion");
        Signature::of(reached)
    }

    #[test]
    fn both_phases_of_figure_9_are_one_motion() {
        let set = ParameterSet { alpha: 1e-4, beta: 0.01, omega: 8.0969, ..Default::default() };
        let system = ModelChoice::default().system(set).expect("the paper's device");
        let found = signature(&system, &[0.0; 5]);
        assert_eq!(found.states.len(), 2);
        // Started on its other stroboscopic state, it is the same motion half a period later.
        let other = signature(&system, &found.states[1]);
        let recogniser = Recogniser::new(&system);
        assert!(recogniser.same(&found, &other) && recogniser.same(&other, &found));
        let swapped =
            Signature { states: vec![found.states[1].clone(), found.states[0].clone()], ..found.clone() };
        assert!(recogniser.same(&found, &swapped));
        let mut moved = found.clone();
        moved.states[1][0] *= 1.01;
        assert!(!recogniser.same(&found, &moved));
    }

    #[test]
    fn classes_and_voltages_tell_the_rest_apart() {
        let system = ModelChoice::default().system(ParameterSet::default()).expect("the paper's device");
        let recogniser = Recogniser::new(&system);
        let torus = |v_rms| Signature {
            cell: Cell::new(Motion::Quasiperiodic, Some(Measures { v_rms, ..Default::default() })),
            states: vec![vec![0.0; 5]],
        };
        assert!(recogniser.same(&torus(20.0), &torus(20.1)));
        assert!(!recogniser.same(&torus(20.0), &torus(25.0)));
        let escape = |time| Signature { cell: Cell::new(Motion::Escape { time }, None), states: Vec::new() };
        assert!(recogniser.same(&escape(1.0), &escape(5.0)));
        assert!(!recogniser.same(&escape(1.0), &torus(20.0)));
    }
}
