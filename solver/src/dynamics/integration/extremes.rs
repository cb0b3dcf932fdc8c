//! The extremes of a motion, which lie between the nodes of its steps.
//!
//! Two stages. While steps go by, the polynomial through a step's node values says how high it may reach; the best
//! steps are kept. In the end the motion itself is read there, by dense output and one of Newton's corrections. So
//! what comes out is a value that the motion takes, whatever the polynomial was worth: where a step leaves out a
//! fast, decaying part of a vibration, it may miss the top between two nodes but never invents one.

use super::propagator::{Propagator, StepRest, Workspace};
use super::rule::{NODES, NodeValues, RULE};
use super::step::Step;

/// How far a resolved scalar may rise above its node values, in units of their range. The widest space between nodes
/// is 0.18 of a step; on a parabola with its top in the middle of it the excess is 0.04.
const MARGIN: f64 = 0.1;
/// Steps kept for the end.
const KEPT: usize = 2;
/// Newton's iterations on the polynomial, from the highest node.
const ITERATIONS: usize = 3;

/// A scalar of the motion.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::dynamics) enum Scalar {
    /// Tip displacement s, in beam lengths.
    Tip,
    /// Voltage v (V).
    Voltage,
    /// dv/dt (V per dimensionless time).
    VoltageRate,
    /// Slope at the tip (rad).
    TipSlope,
}

/// The highest value of a scalar, or of its negative.
#[derive(Debug, Clone)]
pub(in crate::dynamics) struct Highest {
    scalar: Scalar,
    sign: f64,
    /// At the nodes seen so far.
    at_nodes: f64,
    /// The steps that may reach highest, best first.
    candidates: Vec<Candidate>,
}

#[derive(Debug, Clone)]
struct Candidate {
    /// Height and place of the top, the latter as a fraction of the step, and d2/dt2 there, by the polynomial.
    top: Top,
    step: f64,
    start: Vec<f64>,
    rest: NodeValues,
}

#[derive(Debug, Clone, Copy)]
struct Top {
    height: f64,
    place: f64,
    bend: f64,
}

impl Highest {
    /// Of a scalar and of its negative.
    pub(in crate::dynamics) fn both(scalar: Scalar) -> [Self; 2] {
        [1.0, -1.0].map(|sign| Self::new(scalar, sign))
    }

    /// Of `scalar`; with the `sign` -1 the highest value of its negative.
    pub(in crate::dynamics) fn new(scalar: Scalar, sign: f64) -> Self {
        Self { scalar, sign, at_nodes: f64::NEG_INFINITY, candidates: Vec::with_capacity(KEPT) }
    }

    /// Takes a step into account at whose nodes the scalar has the given `values`.
    #[inline]
    pub(in crate::dynamics) fn see(&mut self, step: &Step<'_>, values: &NodeValues) {
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        for value in values {
            let value = self.sign * value;
            low = if value < low { value } else { low };
            high = if value > high { value } else { high };
        }
        self.at_nodes = self.at_nodes.max(high);
        let excess = MARGIN * (high - low);
        if high + excess > self.bar() {
            self.look_closely(step, &values.map(|value| self.sign * value), excess);
        }
    }

    /// What a step has to reach to be kept.
    fn bar(&self) -> f64 {
        self.candidates.get(KEPT - 1).map_or(f64::NEG_INFINITY, |worst| worst.top.height)
    }

    fn look_closely(&mut self, step: &Step<'_>, values: &NodeValues, excess: f64) {
        let coefficients = RULE.about_the_middle(values);
        for i in 0..NODES {
            let below = |j: usize| values.get(j).is_none_or(|value| *value <= values[i]);
            if values[i] + excess > self.bar() && below(i.wrapping_sub(1)) && below(i + 1) {
                let top = top(&coefficients, 2.0 * RULE.nodes[i] - 1.0);
                if top.height > self.bar() {
                    self.keep(step, top);
                }
            }
        }
    }

    fn keep(&mut self, step: &Step<'_>, top: Top) {
        let length = step.tables.step;
        let top = Top { bend: top.bend * (2.0 / length).powi(2), ..top };
        // The worst one's vector is used again.
        let full = self.candidates.len() == KEPT;
        let worst = if full { self.candidates.pop() } else { None };
        let mut start = worst.map_or_else(Vec::new, |worst| worst.start);
        start.clear();
        start.extend_from_slice(step.start);
        let candidate = Candidate { top, step: length, start, rest: *step.rest };
        let place = self.candidates.partition_point(|other| other.top.height >= top.height);
        self.candidates.insert(place, candidate);
    }

    /// The highest value that the motion takes, with its sign changed as asked for; minus infinity before the first
    /// step. `propagator` belongs to the motion's linear part and is at least as long as its steps.
    pub(in crate::dynamics) fn value(&self, propagator: &Propagator) -> f64 {
        let mut value = self.at_nodes;
        for candidate in &self.candidates {
            let (near, slope) = self.read(candidate, candidate.top.place, propagator);
            // On from the polynomial's top to the motion's.
            let shift = -slope / (candidate.top.bend * candidate.step);
            let place = (candidate.top.place + shift).clamp(0.0, 1.0);
            value = value.max(near);
            if shift.abs() < MARGIN {
                value = value.max(self.read(candidate, place, propagator).0);
            }
        }
        value
    }

    /// The larger value of a scalar and of its negative, as [`Self::value`].
    pub(in crate::dynamics) fn larger(both: &[Self; 2], propagator: &Propagator) -> f64 {
        both[0].value(propagator).max(both[1].value(propagator))
    }

    /// The scalar and its rate of change at `place`, a fraction of the candidate's step.
    fn read(&self, candidate: &Candidate, place: f64, propagator: &Propagator) -> (f64, f64) {
        let part = propagator.part();
        let n = part.modes;
        let rest = StepRest::new(&candidate.rest, candidate.step);
        let mut state = candidate.start.clone();
        propagator.carry(&mut state, 0.0, place * candidate.step, &rest, &mut Workspace::default());
        let mut rate = vec![0.0; state.len()];
        part.apply(&state, rest.at(place), &mut rate);
        let (value, slope) = match self.scalar {
            Scalar::Tip => (state[..n].iter().sum(), state[n..2 * n].iter().sum()),
            Scalar::TipSlope => {
                let along = |entries: &[f64]| part.slopes.iter().zip(entries).map(|(a, b)| a * b).sum();
                (along(&state), along(&rate))
            }
            Scalar::Voltage => (state[2 * n], rate[2 * n]),
            Scalar::VoltageRate => {
                // R acts on the voltage through the velocities only.
                part.apply(&rate, 0.0, &mut state);
                (rate[2 * n], state[2 * n])
            }
        };
        let (value, slope): (f64, f64) = (value, slope);
        (self.sign * value, self.sign * slope)
    }
}

/// The top of the polynomial near `x`, where -1 and 1 are the ends of the step; its bend is per x squared.
fn top(coefficients: &NodeValues, x: f64) -> Top {
    let read = |x: f64| {
        let (mut value, mut slope, mut half_bend) = (0.0, 0.0, 0.0);
        for coefficient in coefficients.iter().rev() {
            half_bend = half_bend * x + slope;
            slope = slope * x + value;
            value = value * x + coefficient;
        }
        (value, slope, 2.0 * half_bend)
    };
    let (mut place, mut now) = (x, read(x));
    for _ in 0..ITERATIONS {
        let next = (place - now.1 / now.2).clamp(-1.0, 1.0);
        let there = read(next);
        // Away from a top Newton's iteration may lead down, or nowhere.
        if !(there.0 > now.0) {
            break;
        }
        (place, now) = (next, there);
    }
    Top { height: now.0, place: 0.5 * (1.0 + place), bend: now.2 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_top_of_a_parabola_is_found_at_once_and_that_of_a_slope_at_its_end() {
        let values = RULE.nodes.map(|x| 3.0 - 2.0 * (x - 0.47).powi(2));
        let found = top(&RULE.about_the_middle(&values), 2.0 * RULE.nodes[3] - 1.0);
        assert!((found.height - 3.0).abs() < 1e-14 && (found.place - 0.47).abs() < 1e-7, "{found:?}");
        assert!((found.bend + 1.0).abs() < 1e-11, "{found:?}");
        let values = RULE.nodes.map(|x| (0.5 * x).sin());
        let found = top(&RULE.about_the_middle(&values), 2.0 * RULE.nodes[7] - 1.0);
        assert!((found.height - 0.5_f64.sin()).abs() < 1e-9 && found.place == 1.0, "{found:?}");
    }
}
