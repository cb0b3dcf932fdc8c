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

use super::linear::LinearPart;
use super::rule::{MOST_TERMS, NODES, NodeValues, RULE, add_scaled};
use super::tables::{BLOCK, NodeMap};

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

    /// What a unit of component `column` of the vector at the start (from 2N + 3 on: of R at the nodes) does to the
    /// first entries of the vector after the longest duration.
    pub(super) fn end_column(&self, column: usize, out: &mut [f64]) {
        let Some(flow) = self.flows.last() else { return };
        out.copy_from_slice(&flow.columns[column * self.stride..][..out.len()]);
        if let Some(own) = out.get_mut(column) {
            *own += 1.0;
        }
    }

    /// The scalar `row` . y at the nodes of a step of the longest duration.
    pub(super) fn read_at_nodes(&self, row: &[f64], map: &mut NodeMap) {
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

    /// Carries `y` (length 2N + 3) from one offset within a step to a later one, both in units of time from the
    /// step's start and no further apart than the longest duration.
    pub(super) fn carry(
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
pub(super) struct StepRest {
    /// Length of the step (dimensionless).
    step: f64,
    values: NodeValues,
    coefficients: NodeValues,
}

impl StepRest {
    /// The polynomial with the given `values` at the nodes of a step.
    pub(super) fn new(values: &NodeValues, step: f64) -> Self {
        Self { step, values: *values, coefficients: RULE.coefficients(values) }
    }

    /// R at `place`, a fraction of the step.
    pub(super) fn at(&self, place: f64) -> f64 {
        RULE.values(&self.coefficients, place, 0.0)[0]
    }
}

/// Vectors that [`Propagator::carry`] reuses, so that it does not allocate.
#[derive(Debug, Clone, Default)]
pub(super) struct Workspace {
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

#[cfg(test)]
mod tests {
    use super::super::linear::tests::{matrix, part, stiff};
    use super::super::tables::StepTables;
    use super::*;
    use crate::model::ParameterSet;

    // By tests/reference/propagator.py for [`stiff`] over STEP: what a unit of each component of the vector at the
    // start, and then of R at each node, does to the state at the end; and to s, v and dv/dt at the fifth node.
    const STEP: f64 = 0.3125;
    #[rustfmt::skip]
    const END: [[f64; 5]; 15] = [
    [0.31983932769421909, 0.0018462788418999488, -3.7571637218498415, -0.0040769621153463342, -4.7155647879625519],
    [0.049707507281921699, 0.83943642188191642, -0.10976436464393977, 0.60413057695588283, 2.6948144364471414],
    [0.23482273261561509, 0.00025481013220914589, 0.30421650575480587, 0.0021108730641424721, 0.3901658973532538],
    [0.00027441091160984942, -0.0015103264423897071, 0.0022732479152303546, 0.84106187689403475, 3.9453192841338622],
    [-1.0315297973668082e-9, 2.1895367296133024e-11, -1.3655806407363883e-9, -1.2822287673435052e-8, -6.1811454351775886e-8],
    [0.063295061079785635, -0.00038272370546095541, 0.345027687861905, 0.0021251483001777158, 0.44124648759100248],
    [0.0070006028778102477, -0.00061018827007171666, 0.063295061079785635, -0.00038272370546095541, 0.077324764855735055],
    [-0.012904335622429955, 0.000332504546826459, -0.01830590873369021, -0.043181249585447903, -0.22529454490378006],
    [-0.02716712701983011, 0.0029919305525876576, -0.052111978956793712, -0.078182743959046417, -0.43162090700931203],
    [-0.034655798076807196, 0.0070187487406933924, -0.0991131546100209, -0.012976425438482587, -0.18471764046403229],
    [-0.033075548713915932, 0.004526020481344439, -0.14572622062745424, 0.13766069218730149, 0.46312825609160289],
    [-0.023964512332185266, -0.0046234339155962204, -0.17076150536828911, 0.14594551626075701, 0.47066586894168876],
    [-0.012432298021205299, -0.0075481812697289398, -0.16177332866376179, -0.0078229620716178969, -0.23888686288600087],
    [-0.0038384684813811862, -0.00328123969403192, -0.1197233789051117, -0.086830669641815604, -0.556675612947209],
    [-0.00034318530246901653, -0.00031705501763868306, -0.055255923752263166, -0.050595432276613554, -0.3062329868936326],
];
    #[rustfmt::skip]
    const FIFTH_NODE: [[f64; 3]; 15] = [
    [0.74119780893330711, -3.2947289170968621, -15.02088947596944],
    [-0.74121274090144926, 45.00178363148553, 1410.1565750072596],
    [0.16675962177261555, 0.93880559224809002, -2.6999652627525262],
    [-0.024582019532559377, -3.5253914375181489, 48.726722473503223],
    [-3.5508245860911866e-10, 4.9599933765530996e-8, -7.3050675841097009e-7],
    [0.020949217027118635, 0.39316532815756344, 4.0379297659010113],
    [0.0011457895294434105, 0.014322200609735439, 0.39316532815756344],
    [-0.0079701746254547727, 0.14840084257364695, -1.9078320700891747],
    [-0.017568380847476522, 0.3405340993662033, 0.44734116566876565],
    [-0.024175173838852283, 0.30039271401309476, 11.057396618967388],
    [-0.018973472140438367, -0.66067365661193723, 15.735536229520386],
    [-0.0022727006050878542, -0.5491775982431521, -16.890003720119005],
    [0.00025111786586474121, 0.090552623978624141, -0.35163146217813812],
    [-6.5309285311548343e-5, -0.033601572115767603, 0.10472575021019951],
    [1.3760661093262062e-5, 0.0084900884301691292, -0.023829912914752089],
];

    /// Whether `value` is the reference up to rounding, some of it of the size `lost`.
    fn assert_close(value: f64, reference: f64, lost: f64, place: (usize, usize)) {
        let error = (value - reference).abs();
        assert!(error <= 1e-13 * reference.abs() + 1e-15 * lost, "{place:?}: {value} instead of {reference}");
    }

    #[test]
    fn a_circuit_ten_million_times_faster_than_the_beam_costs_no_digits() {
        let tables = StepTables::new(&stiff(), STEP);
        for (j, references) in END.iter().enumerate() {
            for (i, reference) in references.iter().enumerate() {
                // What is left of a voltage is known relative to what it was.
                let lost = if (i, j) == (4, 4) { 1.0 } else { 0.0 };
                assert_close(tables.end_column(j)[i], *reference, lost, (i, j));
            }
        }
        let entry =
            |map: &NodeMap, j: usize| map.from_state.get(j).unwrap_or_else(|| &map.from_rest[j - 7])[4];
        for (j, [tip, voltage, rate]) in FIFTH_NODE.into_iter().enumerate() {
            assert_close(entry(&tables.tip, j), tip, 0.01, (0, j));
            assert_close(entry(&tables.voltage, j), voltage, 0.0, (1, j));
            // The difference of two currents that the voltage keeps in balance.
            assert_close(entry(&tables.voltage_rate, j), rate, 1e7 * voltage.abs(), (2, j));
        }
    }

    #[test]
    fn dense_output_is_the_same_motion() {
        let (part, duration) = (stiff(), STEP);
        let propagator = Propagator::new(&part, duration);
        let start = [0.01, -0.02, 0.1, 0.4, 3.0, 0.6, 0.8];
        let rest = RULE.nodes.map(|x| (5.0 * x).cos());
        let tables = StepTables::of(&propagator);
        let mut end = vec![0.0; tables.stride()];
        tables.end(&start, &rest, &mut end);
        let tip = tables.tip.at_nodes(&start, &rest);
        let input = StepRest::new(&rest, duration);
        // In one go, through all nodes, and at last over a short rest.
        for stops in [vec![1.0], [&RULE.nodes[..], &[1.0 - 1e-8, 1.0]].concat()] {
            let (mut y, mut reached) = (start.to_vec(), 0.0);
            for (i, stop) in stops.iter().map(|stop| stop * duration).enumerate() {
                propagator.carry(&mut y, reached, stop, &input, &mut Workspace::default());
                reached = stop;
                if stops.len() > 1 && i < NODES {
                    assert_close(y[0] + y[1], tip[i], 1.0, (i, 0));
                }
            }
            for (i, (value, end)) in y.iter().zip(&end[..5]).enumerate() {
                assert_close(*value, *end, 10.0, (i, 0));
            }
        }
    }

    #[test]
    fn it_agrees_with_the_matrix_exponential() {
        let set = ParameterSet { beta: 0.01, ..Default::default() };
        for modes in [1, 2, 8] {
            let part = part(set, modes);
            // In components of comparable energy, which the library's exponential needs more than ours.
            let size = part.extended_dimension();
            let scales = nalgebra::DVector::from_fn(size, |i, _| match i {
                i if i < modes => 1.0,
                i if i < 2 * modes => part.frequency(i - modes),
                i if i == 2 * modes => 2000.0,
                _ => 100.0,
            });
            let start = nalgebra::DVector::from_fn(size, |i, _| (i as f64 + 1.0).sin());
            let balanced =
                nalgebra::DMatrix::from_fn(size, size, |i, j| matrix(&part)[(i, j)] * scales[j] / scales[i]);
            let expected = (balanced * 0.7).exp() * &start;
            let mut y: Vec<f64> = start.component_mul(&scales).iter().copied().collect();
            let rest = StepRest::new(&[0.0; NODES], 0.7);
            Propagator::new(&part, 0.7).carry(&mut y, 0.0, 0.7, &rest, &mut Workspace::default());
            let reached = nalgebra::DVector::from_vec(y).component_div(&scales);
            let error = (reached - &expected).amax() / expected.amax();
            assert!(error < 3e-14, "{modes} modes: {error:e}");
        }
    }

    #[test]
    fn a_polynomial_rest_force_acts_like_many_short_constant_ones() {
        let part = part(ParameterSet::default(), 2);
        let polynomial = |t: f64| 0.3 - 2.0 * t + 5.0 * t * t + t.powi(3);
        let step = 0.2;
        let propagator = Propagator::new(&part, step);
        let mut once = vec![0.01, 0.0, 0.0, 0.1, 1.0, 0.0, 1.0];
        let mut often = once.clone();
        let mut workspace = Workspace::default();
        let rest = StepRest::new(&RULE.nodes.map(|x| polynomial(step * x)), step);
        propagator.carry(&mut once, 0.0, step, &rest, &mut workspace);
        // Midpoint values of R on 4,000 intervals: an independent second-order method.
        let count = 4000;
        let short = step / f64::from(count);
        for i in 0..count {
            let rest = StepRest::new(&[polynomial(short * (f64::from(i) + 0.5)); NODES], short);
            propagator.carry(&mut often, 0.0, short, &rest, &mut workspace);
        }
        for (a, b) in once.iter().zip(&often) {
            assert!((a - b).abs() < 1e-7 * (1.0 + b.abs()), "{a} {b}");
        }
    }
}
