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

#[cfg(test)]
mod tests;

use super::linear::LinearPart;
use super::node_map::NodeMap;
use super::rule::{MOST_TERMS, NODES, NodeValues, RULE, add_scaled};

/// Entries of the state at the end of a step that are summed together.
pub(in crate::dynamics) const BLOCK: usize = 8;
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

    /// What a unit of component `column` of the vector at the start (beyond it: of R at the nodes) does to the
    /// first entries of the vector after the longest duration.
    pub(in crate::dynamics) fn end_column(&self, column: usize, out: &mut [f64]) {
        let Some(flow) = self.flows.last() else { return };
        out.copy_from_slice(&flow.columns[column * self.stride..][..out.len()]);
        if let Some(own) = out.get_mut(column) {
            *own += 1.0;
        }
    }

    /// The scalar `row` . y at the nodes of a step of the longest duration.
    pub(in crate::dynamics) fn read_at_nodes(&self, row: &[f64], map: &mut NodeMap) {
        // Its Taylor series over a unit, and those of its response to R = 1 before the moments.
        let mut series = vec![row.to_vec()];
        let (mut rate, mut responses) = (vec![0.0; self.width], Vec::with_capacity(self.terms));
        self.part.apply(&vec![0.0; self.width], 1.0, &mut rate);
        for k in 0..self.terms {
            responses.push(self.unit * dot(&series[k], &rate));
            let mut next = vec![0.0; self.width];
            self.part.apply_transposed(&series[k], &mut next);
            scale(&mut next, self.unit / (k as f64 + 1.0));
            series.push(next);
        }
        let mut y = vec![0.0; self.stride];
        for (j, node) in RULE.nodes.iter().enumerate() {
            let reached = self.read(*node, &series, &responses, &mut y);
            for (entry, row) in y.iter().zip(&mut map.from_state) {
                row[j] = *entry;
            }
            for (entry, row) in reached.iter().zip(&mut map.from_rest) {
                row[j] = *entry;
            }
        }
    }

    /// The functional with the given series, as one of the vector at the start (in `row`) and of R at the nodes, at
    /// `fraction` of the longest duration: backwards through the last short part, then through whole flows.
    fn read(&self, fraction: f64, series: &[Vec<f64>], responses: &[f64], row: &mut [f64]) -> NodeValues {
        let units = self.units();
        let length = fraction * units as f64;
        let mut position = length as u64;
        let short = length - position as f64;
        let mut of_legendre = [0.0; NODES];
        let mut collect = |from: f64, length: f64, of_part: &NodeValues| {
            let polynomials = RULE.polynomials(from / units as f64, length / units as f64);
            for (sum, polynomial) in of_legendre.iter_mut().zip(&polynomials) {
                *sum += dot(polynomial, of_part);
            }
        };
        row.fill(0.0);
        let (mut power, mut of_part) = (1.0, [0.0; NODES]);
        for (k, term) in series.iter().enumerate() {
            add(row, power, term);
            power *= short;
            if let Some(response) = responses.get(k) {
                add_scaled(&mut of_part, power * response, &RULE.moments[k]);
            }
        }
        collect(position as f64, short, &of_part);
        let mut earlier = vec![0.0; self.width];
        for (level, flow) in
            self.flows.iter().enumerate().filter(|(level, _)| length as u64 >> level & 1 == 1)
        {
            position -= 1 << level;
            let (free, forced) = flow.columns.split_at(self.stride * self.width);
            for (value, column) in of_part.iter_mut().zip(forced.chunks_exact(self.stride)) {
                *value = dot(row, column);
            }
            collect(position as f64, (1_u64 << level) as f64, &of_part);
            for (value, column) in earlier.iter_mut().zip(free.chunks_exact(self.stride)) {
                *value = dot(row, column);
            }
            add(row, 1.0, &earlier);
        }
        RULE.to_cardinal(&of_legendre)
    }

    /// Carries `y` (extended) from one offset within a step to a later one, both in units of time from the
    /// step's start and no further apart than the longest duration.
    pub(in crate::dynamics) fn carry(
        &self,
        y: &mut [f64],
        from: f64,
        to: f64,
        rest: &StepRest,
        workspace: &mut Workspace,
    ) {
        let count = ((to - from) / self.unit).max(0.0);
        let whole = (count as u64).min(2 * self.units() - 1);
        let mut position = from;
        for (level, flow) in self.flows.iter().enumerate().rev() {
            if whole >> level & 1 == 0 {
                continue;
            }
            let duration = self.unit * (1_u64 << level) as f64;
            let values = RULE.values(&rest.coefficients, position / rest.step, duration / rest.step);
            let Workspace { next, .. } = workspace;
            next.clear();
            next.resize(self.stride, 0.0);
            let inputs = y.iter().chain(&values);
            for (value, column) in inputs.zip(flow.columns.chunks_exact(self.stride)) {
                add(next, *value, column);
            }
            add(y, 1.0, next);
            position += duration;
        }
        if to > position {
            self.carry_briefly(y, position, to - position, rest, workspace);
        }
    }

    /// By Taylor series, over at most a unit.
    fn carry_briefly(
        &self,
        y: &mut [f64],
        from: f64,
        duration: f64,
        rest: &StepRest,
        workspace: &mut Workspace,
    ) {
        // Term k carries duration^k, and so must the coefficient of R that enters it.
        let coefficients = RULE.taylor(&rest.values, from / rest.step, rest.step / duration);
        let Workspace { term, next } = workspace;
        term.clear();
        term.extend_from_slice(y);
        next.resize(self.width, 0.0);
        next.truncate(self.width);
        for k in 0..self.terms.max(NODES) {
            self.part.apply(term, coefficients.get(k).copied().unwrap_or(0.0), next);
            scale(next, duration / (k as f64 + 1.0));
            add(y, 1.0, next);
            std::mem::swap(term, next);
        }
    }
}

/// The polynomial R of a step.
#[derive(Debug, Clone, Default)]
pub(in crate::dynamics) struct StepRest {
    /// Length of the step (dimensionless).
    step: f64,
    values: NodeValues,
    coefficients: NodeValues,
}

impl StepRest {
    /// The polynomial with the given `values` at the nodes of a step.
    pub(in crate::dynamics) fn new(values: &NodeValues, step: f64) -> Self {
        Self { step, values: *values, coefficients: RULE.coefficients(values) }
    }

    /// R at `place`, a fraction of the step.
    pub(in crate::dynamics) fn at(&self, place: f64) -> f64 {
        RULE.values(&self.coefficients, place, 0.0)[0]
    }
}

/// Vectors that [`Propagator::carry`] reuses, so that it does not allocate.
#[derive(Debug, Clone, Default)]
pub(in crate::dynamics) struct Workspace {
    term: Vec<f64>,
    next: Vec<f64>,
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
