//! Over a whole step: the vector at its end and a scalar at its nodes, as functions of the start and of R.

use super::{Propagator, add, dot, scale};
use crate::dynamics::integration::rule::{NODES, NodeValues, RULE, add_scaled};
use crate::dynamics::integration::tables::NodeMap;

impl Propagator {
    /// What a unit of component `column` of the vector at the start (from 2N + 3 on: of R at the nodes) does to the
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
}
