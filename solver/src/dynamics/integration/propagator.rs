//! The exact flow of the linear part under a polynomial rest force, over any duration.
//!
//! By scaling and squaring: over a duration so short that a Taylor series converges at once, and from there by
//! doubling, whose cost grows with the logarithm of the fastest rate. What is kept is E - I, where E is the matrix
//! exponential: doubled as 2 (E - I) + (E - I)^2 it keeps the digits of slow motions, which squaring E itself would
//! lose beside the 1 at every doubling. The flows over all durations unit, 2 unit, 4 unit, .. are kept; a duration
//! between them is a sum of these and of a last short one.
//!
//! Reference: Higham, "Functions of Matrices" (2008), chapter 10; the polynomial part is the phi functions of
//! Hochbruck & Ostermann, Acta Numerica 2010, in the basis of a step's node values.

mod dense;
mod ends;
#[cfg(test)]
mod tests;

pub(in crate::dynamics) use self::dense::{StepRest, Workspace};
use super::linear::LinearPart;
use super::rule::{MOST_TERMS, NODES, RULE};
use super::tables::BLOCK;

/// Remainder of the Taylor series, relative to the vector.
const REMAINDER: f64 = 1e-18;
/// Largest product of the fastest rate and the duration that is left to the Taylor series.
const MAX_RATE_STEP: f64 = 0.5;

/// The flows of one linear part over a longest duration and its halves, quarters and so on.
#[derive(Debug, Clone)]
pub struct Propagator {
    part: LinearPart,
    /// Shortest duration.
    unit: f64,
    /// Flows over unit, 2 unit, 4 unit, ..
    flows: Vec<Flow>,
    /// Terms of the Taylor series over the unit.
    terms: usize,
    /// Length of the extended vector, and the same padded to whole blocks.
    width: usize,
    stride: usize,
}

/// The flow over one duration: columns of E - I, and of the response to each cardinal polynomial R.
#[derive(Debug, Clone)]
struct Flow {
    columns: Vec<f64>,
}

impl Propagator {
    /// The flows of `part` over `duration` > 0 (dimensionless) and its binary fractions.
    pub fn new(part: &LinearPart, duration: f64) -> Self {
        let width = part.extended_dimension();
        let (mut unit, mut doublings) = (duration, 0);
        while part.rate * unit > MAX_RATE_STEP {
            unit *= 0.5;
            doublings += 1;
        }
        let mut propagator = Self {
            part: part.clone(),
            unit,
            flows: Vec::with_capacity(doublings + 1),
            terms: terms(part.rate * unit),
            width,
            stride: width.next_multiple_of(BLOCK),
        };
        let mut flow = propagator.shortest();
        for _ in 0..doublings {
            let doubled = propagator.doubled(&flow);
            propagator.flows.push(std::mem::replace(&mut flow, doubled));
        }
        propagator.flows.push(flow);
        propagator
    }

    /// The linear part.
    pub fn part(&self) -> &LinearPart {
        &self.part
    }

    /// Longest duration (dimensionless).
    pub fn duration(&self) -> f64 {
        self.unit * self.units() as f64
    }

    /// The longest duration in units.
    fn units(&self) -> u64 {
        1 << (self.flows.len() - 1)
    }

    fn shortest(&self) -> Flow {
        let Self { part, unit, width, stride, .. } = self;
        let mut columns = vec![0.0; stride * (width + NODES)];
        let (mut term, mut next) = (vec![0.0; *width], vec![0.0; *width]);
        let (free, forced) = columns.split_at_mut(stride * width);
        for (j, column) in free.chunks_exact_mut(*stride).enumerate() {
            term.fill(0.0);
            term[j] = 1.0;
            for k in 0..self.terms {
                part.apply(&term, 0.0, &mut next);
                std::mem::swap(&mut term, &mut next);
                scale(&mut term, unit / (k as f64 + 1.0));
                add(column, 1.0, &term);
            }
        }
        next.fill(0.0);
        part.apply(&next, 1.0, &mut term);
        scale(&mut term, *unit);
        for (k, moments) in RULE.moments.iter().enumerate().take(self.terms) {
            for (column, moment) in forced.chunks_exact_mut(*stride).zip(moments) {
                add(column, *moment, &term);
            }
            part.apply(&term, 0.0, &mut next);
            std::mem::swap(&mut term, &mut next);
            scale(&mut term, unit / (k as f64 + 1.0));
        }
        Flow { columns }
    }

    fn doubled(&self, flow: &Flow) -> Flow {
        let Self { width, stride, .. } = self;
        let (free, forced) = flow.columns.split_at(stride * width);
        let mut columns = vec![0.0; flow.columns.len()];
        let (first, rest) = columns.split_at_mut(stride * width);
        for (column, old) in first.chunks_exact_mut(*stride).zip(free.chunks_exact(*stride)) {
            add(column, 2.0, old);
            self.add_product(free, old, column);
        }
        // What the first half leaves is carried on through the second.
        let mut half = vec![0.0; *stride];
        let [first_half, second_half] = &RULE.halves;
        for (l, column) in rest.chunks_exact_mut(*stride).enumerate() {
            half.fill(0.0);
            for (i, old) in forced.chunks_exact(*stride).enumerate() {
                add(&mut half, first_half[l][i], old);
                add(column, second_half[l][i], old);
            }
            add(column, 1.0, &half);
            self.add_product(free, &half, column);
        }
        Flow { columns }
    }

    /// `out` += (E - I) `y`.
    fn add_product(&self, free: &[f64], y: &[f64], out: &mut [f64]) {
        for (value, column) in y[..self.width].iter().zip(free.chunks_exact(self.stride)) {
            add(out, *value, column);
        }
    }
}

/// Number of terms after which those of exp(x) are below [`REMAINDER`].
fn terms(x: f64) -> usize {
    let (mut term, mut k) = (1.0, 0);
    while term > REMAINDER && k < MOST_TERMS {
        k += 1;
        term *= x / k as f64;
    }
    k
}

/// `sum` += `factor` * `column`, as far as both reach.
#[inline(always)]
fn add(sum: &mut [f64], factor: f64, column: &[f64]) {
    for (sum, entry) in sum.iter_mut().zip(column) {
        *sum += factor * entry;
    }
}

#[inline(always)]
fn scale(vector: &mut [f64], factor: f64) {
    for value in vector {
        *value *= factor;
    }
}

#[inline(always)]
fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}
