//! A chart over (omega, beta) of the largest Floquet multiplier of the forced motion, column by column.

use serde::{Deserialize, Serialize};

use super::Study;
use crate::jobs::response::check_range;
use crate::jobs::work::{Column, Finding, Work};
use crate::model::{ModelError, Parameter};
use crate::scenario::Scenario;
use crate::spacing::between;

/// Columns and rows of the first, coarse picture.
const FIRST: (usize, usize) = (16, 24);
/// Share of the progress that the coarse picture is.
const FIRST_SHARE: f64 = 0.02;
/// Multipliers a piece of work computes, about.
const PER_PIECE: usize = 768;
/// Columns and rows a chart may have.
pub const SIZES: (usize, usize) = (2, 1024);

/// What is charted.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct MultiplierQuestion {
    /// The device; its excitation and start play no role.
    pub scenario: Scenario,
    /// Lowest and highest frequency, at the middle of the first and last column.
    pub omega: (f64, f64),
    /// Lowest and highest amplitude, at the middle of the first and last row.
    pub beta: (f64, f64),
    /// Number of columns (frequencies) and rows (amplitudes).
    pub size: (usize, usize),
}

impl MultiplierQuestion {
    /// Checks ranges and size.
    ///
    /// # Errors
    /// [`ModelError`] naming what is out of range.
    pub fn validate(&self) -> Result<(), ModelError> {
        self.scenario.validate()?;
        check_range(Parameter::Omega, self.omega)?;
        check_range(Parameter::Beta, self.beta)?;
        for (field, value) in [("columns", self.size.0), ("rows", self.size.1)] {
            let (minimum, maximum) = SIZES;
            if !(minimum..=maximum).contains(&value) {
                return Err(ModelError::Count { field, value, minimum, maximum });
            }
        }
        Ok(())
    }

    /// Frequency of a column.
    pub fn omega_at(&self, column: usize) -> f64 {
        between(self.omega, column, self.size.0)
    }

    /// Amplitude of a row.
    pub fn beta_at(&self, row: usize) -> f64 {
        between(self.beta, row, self.size.1)
    }
}

/// A chart being computed: first every sixteenth column coarsely, then every column, those beside a change first.
#[derive(Debug, Clone)]
pub struct MultiplierChart {
    question: MultiplierQuestion,
    /// Rows of the coarse picture.
    coarse_rows: Vec<usize>,
    coarse: Vec<Option<Column>>,
    fine: Vec<Option<Column>>,
    handed: Vec<bool>,
    handed_coarse: Vec<bool>,
    /// Pieces under way: columns, and whether they are coarse.
    pieces: Vec<(Vec<usize>, bool)>,
    known: usize,
    failure: Option<String>,
    version: u64,
}

impl MultiplierChart {
    /// An empty chart; the question must be valid.
    pub fn new(question: MultiplierQuestion) -> Self {
        let (columns, rows) = question.size;
        let coarse_rows = (0..rows).step_by((rows / FIRST.1).max(1)).collect();
        Self {
            question,
            coarse_rows,
            coarse: vec![None; columns],
            fine: vec![None; columns],
            handed: vec![false; columns],
            handed_coarse: vec![false; columns],
            pieces: Vec::new(),
            known: 0,
            failure: None,
            version: 0,
        }
    }

    /// What is charted.
    pub fn question(&self) -> &MultiplierQuestion {
        &self.question
    }

    /// Grows with every change, so that a picture knows when it is old.
    pub fn version(&self) -> u64 {
        self.version
    }

    /// Why the chart is incomplete, if it is and will stay so.
    pub fn failure(&self) -> Option<&str> {
        self.failure.as_deref()
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
        (0..self.question.size.1).map(row).collect()
    }

    fn stride(&self) -> usize {
        (self.question.size.0 / FIRST.0).max(1)
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

impl Study for MultiplierChart {
    fn next(&mut self) -> Option<(usize, Work)> {
        if self.failure.is_some() {
            return None;
        }
        let stride = self.stride();
        let mut columns: Vec<usize> = self.coarse_left().take(4).collect();
        let coarse = !columns.is_empty();
        let mut finer = stride;
        while columns.is_empty() && finer >= 1 {
            let most = (PER_PIECE / self.question.size.1).max(1);
            columns = self.columns_at(finer, most);
            finer = if finer == 1 { 0 } else { finer.div_ceil(2) };
        }
        if columns.is_empty() {
            return None;
        }
        let handed = if coarse { &mut self.handed_coarse } else { &mut self.handed };
        columns.iter().for_each(|i| handed[*i] = true);
        let question = &self.question;
        let rows: Vec<usize> = if coarse { self.coarse_rows.clone() } else { (0..question.size.1).collect() };
        let work = Work::Columns {
            scenario: question.scenario.clone(),
            omegas: columns.iter().map(|i| question.omega_at(*i)).collect(),
            betas: rows.into_iter().map(|row| question.beta_at(row)).collect(),
        };
        self.pieces.push((columns, coarse));
        Some((self.pieces.len() - 1, work))
    }

    fn take(&mut self, ticket: usize, finding: Result<Finding, String>) {
        let Some((columns, coarse)) = self.pieces.get(ticket) else { return };
        self.version += 1;
        match finding {
            Ok(Finding::Columns(found)) => {
                let table = if *coarse { &mut self.coarse } else { &mut self.fine };
                self.known += if *coarse { 0 } else { columns.len() };
                for (i, values) in columns.iter().zip(found) {
                    table[*i] = Some(values);
                }
            }
            Ok(_) => {}
            Err(message) => self.failure = Some(message),
        }
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
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dynamics::largest_multipliers;
    use crate::jobs::study::complete;
    use crate::model::ParameterSet;

    #[test]
    fn a_chart_is_complete_and_holds_what_one_column_holds() {
        let parameters = ParameterSet { alpha: 1e-4, ..Default::default() };
        let scenario = Scenario { parameters, ..Default::default() };
        let question = MultiplierQuestion { scenario, omega: (7.9, 8.3), beta: (1e-4, 4e-3), size: (37, 21) };
        question.validate().expect("a valid chart");
        let mut chart = MultiplierChart::new(question.clone());
        complete(&mut chart);
        assert!(chart.finished() && chart.failure().is_none() && chart.progress() == 1.0);
        let (system, _) = question.scenario.validate().expect("the paper's device");
        let betas: Vec<f64> = (0..21).map(|row| question.beta_at(row)).collect();
        for column in [0, 5, 18, 36] {
            let expected = largest_multipliers(&system, question.omega_at(column), &betas).expect("a column");
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

    #[test]
    fn sizes_and_ranges_are_checked() {
        let question = |omega, size| MultiplierQuestion {
            scenario: Scenario::default(),
            omega,
            beta: (0.0, 0.01),
            size,
        };
        assert!(question((5.0, 6.0), (16, 16)).validate().is_ok());
        assert!(question((5.0, 4.0), (16, 16)).validate().is_err());
        assert!(question((5.0, 600.0), (16, 16)).validate().is_err());
        assert!(question((5.0, 6.0), (1, 16)).validate().is_err());
    }
}
