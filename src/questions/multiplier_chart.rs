//! A chart over (omega, beta) of the largest Floquet multiplier of the forced motion, column by column.

use nanoserde::{DeBin, SerBin};

use super::checks::Span;
use crate::dynamics::largest_multipliers;
use crate::scenario::Scenario;
use crate::scheduler::{Asked, Failure, Order, Piece, Study};

/// Columns and rows of the first, coarse picture.
const FIRST: (usize, usize) = (16, 24);
/// Share of the progress that the coarse picture is.
const FIRST_SHARE: f64 = 0.02;
/// Multipliers a piece of work computes, about.
const PER_PIECE: usize = 768;
/// Columns and rows a chart may have.
pub const SIZES: (usize, usize) = (2, 1024);

/// Columns of the chart.
#[derive(Debug, Clone, PartialEq, SerBin, DeBin)]
pub struct Columns {
    /// The device.
    pub scenario: Scenario,
    /// One frequency a column.
    pub omegas: Vec<f64>,
    /// Ascending excitation amplitudes, the same for each column.
    pub betas: Vec<f64>,
}

/// Largest multipliers along a column of a chart, absent from where the forced motion cannot be followed.
#[derive(Debug, Clone, PartialEq, Default, SerBin, DeBin)]
pub struct Column {
    /// Modulus of each (dimensionless).
    pub modulus: Vec<Option<f64>>,
    /// Absolute argument of each (radians): 0 at a fold, pi at a period doubling, between them a pair.
    pub argument: Vec<Option<f64>>,
}

impl Piece for Columns {
    const NAME: &'static str = "columns";
    type Found = Vec<Column>;

    fn carry_out(&self) -> Result<Vec<Column>, Failure> {
        let (system, _) = self.scenario.validate()?;
        let column = |omega: &f64| {
            let values = largest_multipliers(&system, *omega, &self.betas)?;
            Ok(Column {
                modulus: values.iter().map(|value| value.map(|mu| mu.norm())).collect(),
                argument: values.iter().map(|value| value.map(|mu| mu.arg().abs())).collect(),
            })
        };
        self.omegas.iter().map(column).collect()
    }
}

/// A chart being computed: first every sixteenth column coarsely, then every column, those beside a change first.
#[derive(Debug, Clone)]
pub struct MultiplierChart {
    /// Whose multipliers, at which frequencies (the columns) and at which amplitudes (the rows).
    asked: (Scenario, Span, Span),
    /// Rows of the coarse picture.
    coarse_rows: Vec<usize>,
    coarse: Vec<Option<Column>>,
    fine: Vec<Option<Column>>,
    handed: Vec<bool>,
    handed_coarse: Vec<bool>,
    known: usize,
    failure: Option<Failure>,
    version: u64,
}

impl MultiplierChart {
    /// An empty chart of the device of `scenario`, whose excitation and start play no role, at each frequency and amplitude;
    /// all of it must be valid.
    pub fn new(scenario: Scenario, omega: Span, beta: Span) -> Self {
        let (columns, rows) = (omega.count, beta.count);
        let coarse_rows = (0..rows).step_by((rows / FIRST.1).max(1)).collect();
        Self {
            asked: (scenario, omega, beta),
            coarse_rows,
            coarse: vec![None; columns],
            fine: vec![None; columns],
            handed: vec![false; columns],
            handed_coarse: vec![false; columns],
            known: 0,
            failure: None,
            version: 0,
        }
    }

    /// Grows with every change, so that a picture knows when it is old.
    pub fn version(&self) -> u64 {
        self.version
    }

    /// Why the chart is incomplete, if it is and will stay so.
    pub fn failure(&self) -> Option<&Failure> {
        self.failure.as_ref()
    }

    /// Modulus and absolute argument at a cell, or at the computed one nearest to it. The outer `None`: nothing is
    /// known yet; the inner: the forced motion cannot be followed to there.
    pub fn shown(&self, column: usize, row: usize) -> Option<Option<(f64, f64)>> {
        let pick = |values: &Column, row: usize| Some(values.modulus[row].zip(values.argument[row]));
        if let Some(values) = &self.fine[column] {
            return pick(values, row);
        }
        let reach = self.stride();
        let near = (0..=reach).flat_map(|k| [column.checked_sub(k), Some(column + k)]).flatten();
        for other in near.filter(|other| *other < self.fine.len()) {
            if let Some(values) = &self.fine[other] {
                return pick(values, row);
            }
            if let Some(values) = &self.coarse[other] {
                let spacing = self.coarse_rows.get(1).copied().unwrap_or(1);
                return pick(values, ((row + spacing / 2) / spacing).min(self.coarse_rows.len() - 1));
            }
        }
        None
    }

    /// The values of a finished chart, row by row from the lowest amplitude: moduli and absolute arguments.
    pub fn rows(&self) -> Vec<Column> {
        let row = |row: usize| {
            let cells = self.fine.iter().map(|column| column.as_ref());
            let pick = |values: fn(&Column) -> &Vec<Option<f64>>| {
                cells.clone().map(|column| column.and_then(|column| values(column)[row])).collect()
            };
            Column { modulus: pick(|column| &column.modulus), argument: pick(|column| &column.argument) }
        };
        (0..self.asked.2.count).map(row).collect()
    }

    fn stride(&self) -> usize {
        (self.asked.1.count / FIRST.0).max(1)
    }

    /// Columns of the coarse picture that nobody has yet.
    fn coarse_left(&self) -> impl Iterator<Item = usize> + '_ {
        (0..self.handed_coarse.len()).step_by(self.stride()).filter(|i| !self.handed_coarse[*i])
    }

    /// Columns on multiples of `stride` that nobody has yet, those between unlike neighbours first.
    fn columns_at(&self, stride: usize, most: usize) -> Vec<usize> {
        let free: Vec<usize> = (0..self.handed.len()).step_by(stride).filter(|i| !self.handed[*i]).collect();
        let (first, rest): (Vec<usize>, Vec<usize>) = free.into_iter().partition(|i| self.changes_at(*i));
        first.into_iter().chain(rest).take(most).collect()
    }

    /// Whether the forced motion's stability changes with amplitude near a column.
    fn changes_at(&self, column: usize) -> bool {
        let reach = self.stride();
        let near =
            (column.saturating_sub(reach)..=column + reach).filter_map(|i| self.coarse.get(i)?.as_ref());
        let stable = |value: &Option<f64>| value.is_some_and(|modulus| modulus < 1.0);
        let mut near = near.peekable();
        let Some(first) = near.peek().map(|values| values.modulus.first().is_some_and(stable)) else {
            return false;
        };
        near.any(|values| values.modulus.iter().any(|value| stable(value) != first))
    }
}

impl Asked for MultiplierChart {
    type Question = (Scenario, Span, Span);

    fn asked(&self) -> &Self::Question {
        &self.asked
    }
}

impl Study for MultiplierChart {
    fn next(&mut self) -> Option<Order<Self>> {
        if self.failure.is_some() {
            return None;
        }
        let (scenario, omega, beta) = self.asked.clone();
        let stride = self.stride();
        let mut columns: Vec<usize> = self.coarse_left().take(4).collect();
        let coarse = !columns.is_empty();
        let mut finer = stride;
        while columns.is_empty() && finer >= 1 {
            let most = (PER_PIECE / beta.count).max(1);
            columns = self.columns_at(finer, most);
            finer = if finer == 1 { 0 } else { finer.div_ceil(2) };
        }
        if columns.is_empty() {
            return None;
        }
        let handed = if coarse { &mut self.handed_coarse } else { &mut self.handed };
        columns.iter().for_each(|i| handed[*i] = true);
        let rows: Vec<usize> = if coarse { self.coarse_rows.clone() } else { (0..beta.count).collect() };
        let piece = Columns {
            scenario,
            omegas: columns.iter().map(|i| omega.at(*i)).collect(),
            betas: rows.into_iter().map(|row| beta.at(row)).collect(),
        };
        Some(Order::new(piece, move |chart: &mut Self, found| {
            chart.version += 1;
            match found {
                Ok(found) => {
                    let table = if coarse { &mut chart.coarse } else { &mut chart.fine };
                    chart.known += if coarse { 0 } else { columns.len() };
                    for (i, values) in columns.into_iter().zip(found) {
                        table[i] = Some(values);
                    }
                }
                Err(message) => chart.failure = Some(message),
            }
        }))
    }

    fn progress(&self) -> f64 {
        let columns = self.fine.len();
        let first = columns.div_ceil(self.stride());
        let pictured = self.coarse.iter().flatten().count() as f64 / first as f64;
        FIRST_SHARE * pictured + (1.0 - FIRST_SHARE) * self.known as f64 / columns as f64
    }

    fn finished(&self) -> bool {
        self.failure.is_some() || self.known == self.fine.len()
    }

    fn sketches(&self) -> bool {
        self.coarse_left().next().is_some()
    }

    fn is_replaceable(&self) -> bool {
        self.finished() || (0..self.coarse.len()).step_by(self.stride()).all(|i| self.coarse[i].is_some())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dynamics::largest_multipliers;
    use crate::model::ParameterSet;
    use crate::scheduler::complete;

    #[test]
    fn a_chart_is_complete_and_holds_what_one_column_holds() {
        let parameters = ParameterSet { alpha: 1e-4, ..Default::default() };
        let scenario = Scenario { parameters, ..Default::default() };
        let omega = Span { from: 7.9, to: 8.3, count: 37 };
        let beta = Span { from: 1e-4, to: 4e-3, count: 21 };
        let mut chart = MultiplierChart::new(scenario.clone(), omega, beta);
        complete(&mut chart);
        assert!(chart.finished() && chart.failure().is_none() && chart.progress() == 1.0);
        let (system, _) = scenario.validate().expect("the paper's device");
        let betas: Vec<f64> = (0..21).map(|row| beta.at(row)).collect();
        for column in [0, 5, 18, 36] {
            let expected = largest_multipliers(&system, omega.at(column), &betas).expect("a column");
            for (row, expected) in expected.iter().enumerate() {
                let shown = chart.shown(column, row).flatten();
                assert_eq!(shown.map(|(modulus, _)| modulus), expected.map(|mu| mu.norm()));
                assert_eq!(chart.rows()[row].modulus[column], expected.map(|mu| mu.norm()));
            }
        }
        // Both states occur, so that the comparison says something.
        let stable = |row: &Column| row.modulus.iter().flatten().filter(|modulus| **modulus < 1.0).count();
        let count: usize = chart.rows().iter().map(stable).sum();
        assert!((50..37 * 21 - 50).contains(&count), "{count}");
    }
}
