//! A map of any objective of the design bench over two of its variables, from coarse to fine.

use super::Study;
use super::mosaic::{Mosaic, Place};
use crate::jobs::design::find::{Evaluation, FindQuestion};
use crate::jobs::design::{DesignFinding, DesignWork};
use crate::jobs::work::{Finding, Work};
use crate::model::ModelError;
use crate::spacing::between;

/// Columns and rows a map may have.
pub const SIZES: (usize, usize) = (2, 256);

/// A map being computed, first where limits begin to be violated or a motion changes its class.
#[derive(Debug, Clone)]
pub struct DesignMap {
    question: FindQuestion,
    size: (usize, usize),
    tiles: Mosaic<Evaluation>,
    pieces: Vec<Place>,
    failure: Option<String>,
    version: u64,
}

impl DesignMap {
    /// An empty map: the first of the question's two variables goes from column to column, the second from row to row.
    ///
    /// # Errors
    /// [`ModelError`] naming what is out of range, or when there are not two variables.
    pub fn new(question: FindQuestion, size: (usize, usize)) -> Result<Self, ModelError> {
        question.validate()?;
        let count = |field, value, (minimum, maximum): (usize, usize)| {
            let right = (minimum..=maximum).contains(&value);
            if right { Ok(()) } else { Err(ModelError::Count { field, value, minimum, maximum }) }
        };
        count("variables", question.variables.len(), (2, 2))?;
        count("columns", size.0, SIZES)?;
        count("rows", size.1, SIZES)?;
        let tiles = Mosaic::new(size.0, size.1);
        Ok(Self { question, size, tiles, pieces: Vec::new(), failure: None, version: 0 })
    }

    /// What is mapped.
    pub fn question(&self) -> &FindQuestion {
        &self.question
    }

    /// Columns and rows.
    pub fn size(&self) -> (usize, usize) {
        self.size
    }

    /// The two variables' values at a cell.
    pub fn values(&self, (column, row): Place) -> [f64; 2] {
        let share = |index: usize, count: usize| between((0.0, 1.0), index, count);
        let [x, y] = [0, 1].map(|axis| self.question.variables[axis]);
        [x.at(share(column, self.size.0)), y.at(share(row, self.size.1))]
    }

    /// The cell, or the computed one nearest to it; `None` while nothing is known.
    pub fn shown(&self, place: Place) -> Option<&Evaluation> {
        self.tiles.shown(place)
    }

    /// The cell itself; `None` until it is known.
    pub fn cell(&self, place: Place) -> Option<&Evaluation> {
        self.tiles.get(place)
    }

    /// The best cell known that keeps the limits.
    pub fn best(&self) -> Option<(Place, Evaluation)> {
        let (columns, rows) = self.size;
        let places = (0..rows).flat_map(|row| (0..columns).map(move |column| (column, row)));
        let rank = |evaluation: &Evaluation| evaluation.rank(&self.question.objective).1;
        places
            .filter_map(|place| self.cell(place).map(|evaluation| (place, *evaluation)))
            .filter(|(_, evaluation)| evaluation.violation == 0.0 && evaluation.value.is_some())
            .max_by(|(_, a), (_, b)| rank(a).total_cmp(&rank(b)))
    }

    /// Grows with every change, so that a picture knows when it is old.
    pub fn version(&self) -> u64 {
        self.version
    }

    /// Why the map is incomplete, if it is and will stay so.
    pub fn failure(&self) -> Option<&str> {
        self.failure.as_deref()
    }
}

/// Whether two cells lie on different sides of a border.
fn differ(a: &Evaluation, b: &Evaluation) -> bool {
    let alike = match (&a.motion, &b.motion) {
        (Some(a), Some(b)) => a.same_class(b),
        (None, None) => a.value.is_some() == b.value.is_some(),
        _ => false,
    };
    !alike || (a.violation == 0.0) != (b.violation == 0.0)
}

impl Study for DesignMap {
    fn next(&mut self) -> Option<(usize, Work)> {
        if self.failure.is_some() {
            return None;
        }
        let place = *self.tiles.hand_out(1, differ).first()?;
        let (question, values) = (Box::new(self.question.clone()), self.values(place).to_vec());
        self.pieces.push(place);
        Some((self.pieces.len() - 1, Work::Design(DesignWork::Candidate { question, values })))
    }

    fn take(&mut self, ticket: usize, finding: Result<Finding, String>) {
        let Some(place) = self.pieces.get(ticket).copied() else { return };
        self.version += 1;
        match finding {
            Ok(Finding::Design(DesignFinding::Candidate(evaluation))) => self.tiles.put(place, evaluation),
            Ok(_) => self.failure = Some("the computation returned something else than a cell".to_owned()),
            Err(message) => self.failure = Some(message),
        }
    }

    fn progress(&self) -> f64 {
        self.tiles.progress()
    }

    fn finished(&self) -> bool {
        self.failure.is_some() || self.tiles.progress() == 1.0
    }
}
