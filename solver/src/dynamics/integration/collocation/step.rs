//! One step: the fixed-point iteration for the rest force at the nodes, and the estimate of its error.

use super::Collocation;
use crate::dynamics::integration::propagator::Propagator;
use crate::dynamics::integration::tables::{NodeValues, RULE, StepTables, add_scaled};
use crate::model::RestForce;

/// Most passes of the fixed-point iteration before a step counts as too long.
const MAX_PASSES: usize = 14;

/// Relative accuracy below which rounding hides every error.
pub(in crate::dynamics) const ROUNDING: f64 = 1e-14;

/// One accepted step, shown to the observer of a run.
#[derive(Debug)]
pub struct Step<'a> {
    /// Time at the start of the step (dimensionless).
    pub time: f64,
    /// Extended state at the start, length 2N + 3: the state, then beta times sine and cosine of omega t.
    pub start: &'a [f64],
    /// R at the nodes.
    pub rest: &'a NodeValues,
    /// Tip displacement at the nodes, in beam lengths.
    pub tip: &'a NodeValues,
    /// The tables of this step's length.
    pub tables: &'a StepTables,
    /// The linear part's flow, for the motion within the step.
    pub propagator: &'a Propagator,
    /// Position within the excitation period, in steps of this length; 0 at t = 2 pi k / omega, where a run that began
    /// at a phase of its own has that phase again.
    pub index: usize,
}

/// What happened to an attempted step.
pub(super) enum Attempt {
    Accepted { error: f64 },
    Rejected,
}

impl Collocation {
    /// Solves the step from the present state; leaves R and s at the nodes in `self`.
    pub(super) fn attempt(&mut self, tables: &StepTables) -> Attempt {
        // Compiled twice, once for the paper's law alone, which then stays in registers.
        let solution = match self.force {
            RestForce::Quadratic { c2 } => self.solve(&RestForce::Quadratic { c2 }, tables),
            _ => self.solve(&self.force, tables),
        };
        match solution {
            Some((rest, tip, scale)) => self.judge(tables, rest, tip, scale),
            None => Attempt::Rejected,
        }
    }

    /// R and s at the nodes under the integrator's own `force`, and the size of s by which their error is judged; `None`
    /// when the step is too long.
    #[inline(always)]
    fn solve(&self, force: &RestForce, tables: &StepTables) -> Option<(NodeValues, NodeValues, f64)> {
        let free = tables.tip.free(&self.extended);
        let n = self.part.modes;
        let s: f64 = self.extended[..n].iter().sum();
        let w: f64 = self.extended[n..2 * n].iter().sum();
        let mut tip = free;
        add_scaled(&mut tip, force.rest(s), &tables.guess[0]);
        add_scaled(&mut tip, force.slope(s) * w, &tables.guess[1]);
        let scale = self.gap.max(s.abs());
        // Each pass shrinks the error by an order of magnitude or more, so the last change bounds what is left.
        let settled = (1e-4 * self.settings.tolerance).max(ROUNDING) * scale;
        let contact = force.contact();
        for _ in 0..MAX_PASSES {
            let rest = force.rest_at(&tip);
            let mut next = free;
            for (value, row) in rest.iter().zip(&tables.tip.from_rest) {
                add_scaled(&mut next, *value, row);
            }
            let change = largest_difference(&next, &tip);
            tip = next;
            let lowest = tip.iter().copied().fold(f64::INFINITY, f64::min);
            let beyond = contact.is_some_and(|contact| lowest <= contact);
            if !change.is_finite() || beyond {
                return None;
            }
            if change <= settled {
                return Some((force.rest_at(&tip), tip, scale));
            }
        }
        None
    }

    fn judge(&mut self, tables: &StepTables, rest: NodeValues, tip: NodeValues, scale: f64) -> Attempt {
        let mut highest = 0.0;
        for row in &RULE.highest {
            let coefficient: f64 = row.iter().zip(&rest).map(|(a, b)| a * b).sum();
            highest += coefficient.abs();
        }
        // R's polynomial ends where its last coefficients are; what they move s by bounds what the missing ones do.
        let tolerance = self.settings.tolerance;
        let within = tables.gain / tolerance;
        let end = tables.end_gain / (tolerance * tolerance).max(ROUNDING);
        let error = highest * within.max(end) / scale;
        if !(error <= 1.0) {
            return Attempt::Rejected;
        }
        self.rest = rest;
        self.tip = tip;
        tables.end(&self.extended, &self.rest, &mut self.end);
        Attempt::Accepted { error }
    }
}

/// Largest |a - b|, by pairs: one chain of eight comparisons would take as long as a pass of the iteration. A NaN
/// may get lost, but not in the estimate of the error, which adds up all nodes.
fn largest_difference(a: &NodeValues, b: &NodeValues) -> f64 {
    let larger = |a: f64, b: f64| if a > b { a } else { b };
    let eight: NodeValues = std::array::from_fn(|i| (a[i] - b[i]).abs());
    let four: [f64; 4] = std::array::from_fn(|i| larger(eight[i], eight[i + 4]));
    larger(larger(four[0], four[2]), larger(four[1], four[3]))
}
