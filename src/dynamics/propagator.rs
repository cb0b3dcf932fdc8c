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
    [0.319839327694219, 0.00184627884189995, -3.75716372184984, -0.00407696211534633, -4.71556478796255],
    [0.0497075072819217, 0.839436421881916, -0.10976436464394, 0.604130576955883, 2.69481443644714],
    [0.234822732615615, 0.000254810132209146, 0.304216505754806, 0.00211087306414247, 0.390165897353254],
    [0.000274410911609849, -0.00151032644238971, 0.00227324791523035, 0.841061876894035, 3.94531928413386],
    [-1.03152979736681e-9, 2.1895367296133e-11, -1.36558064073639e-9, -1.28222876734351e-8, -6.18114543517759e-8],
    [0.0632950610797856, -0.000382723705460955, 0.345027687861905, 0.00212514830017772, 0.441246487591002],
    [0.00700060287781025, -0.000610188270071717, 0.0632950610797856, -0.000382723705460955, 0.0773247648557351],
    [-0.01290433562243, 0.000332504546826459, -0.0183059087336902, -0.0431812495854479, -0.22529454490378],
    [-0.0271671270198301, 0.00299193055258766, -0.0521119789567937, -0.0781827439590464, -0.431620907009312],
    [-0.0346557980768072, 0.00701874874069339, -0.0991131546100209, -0.0129764254384826, -0.184717640464032],
    [-0.0330755487139159, 0.00452602048134444, -0.145726220627454, 0.137660692187301, 0.463128256091603],
    [-0.0239645123321853, -0.00462343391559622, -0.170761505368289, 0.145945516260757, 0.470665868941689],
    [-0.0124322980212053, -0.00754818126972894, -0.161773328663762, -0.0078229620716179, -0.238886862886001],
    [-0.00383846848138119, -0.00328123969403192, -0.119723378905112, -0.0868306696418156, -0.556675612947209],
    [-0.000343185302469017, -0.000317055017638683, -0.0552559237522632, -0.0505954322766136, -0.306232986893633],
];
    #[rustfmt::skip]
    const FIFTH_NODE: [[f64; 3]; 15] = [
    [0.741197808933307, -3.29472891709686, -15.0208894759694],
    [-0.741212740901449, 45.0017836314855, 1410.15657500726],
    [0.166759621772616, 0.93880559224809, -2.69996526275253],
    [-0.0245820195325594, -3.52539143751815, 48.7267224735032],
    [-3.55082458609119e-10, 4.9599933765531e-8, -7.3050675841097e-7],
    [0.0209492170271186, 0.393165328157563, 4.03792976590101],
    [0.00114578952944341, 0.0143222006097354, 0.393165328157563],
    [-0.00797017462545477, 0.148400842573647, -1.90783207008917],
    [-0.0175683808474765, 0.340534099366203, 0.447341165668766],
    [-0.0241751738388523, 0.300392714013095, 11.0573966189674],
    [-0.0189734721404384, -0.660673656611937, 15.7355362295204],
    [-0.00227270060508785, -0.549177598243152, -16.890003720119],
    [0.000251117865864741, 0.0905526239786241, -0.351631462178138],
    [-6.53092853115483e-5, -0.0336015721157676, 0.1047257502102],
    [1.37606610932621e-5, 0.00849008843016913, -0.0238299129147521],
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
