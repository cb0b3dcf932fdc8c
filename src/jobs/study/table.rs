//! Pieces of work that do not depend on one another: the rows of a table.

use super::Study;
use crate::dynamics::bifurcations::tongue::Window;
use crate::jobs::design::materials::MaterialRow;
use crate::jobs::design::trust::{Quantity, TrustEntry, places};
use crate::jobs::design::{DesignFinding, DesignWork};
use crate::jobs::work::{Finding, Work};
use crate::model::materials::Ceramic;
use crate::scenario::Scenario;
use crate::theory::Resonance;

/// Pieces and what they found, in their order.
#[derive(Debug, Clone)]
pub struct Table {
    works: Vec<Work>,
    handed: usize,
    found: Vec<Option<Result<Finding, String>>>,
}

impl Table {
    /// Nothing found yet.
    pub fn new(works: Vec<Work>) -> Self {
        Self { handed: 0, found: vec![None; works.len()], works }
    }

    /// The ceramics of Table 2 on the device of `scenario`, their quality factors given to mode `mode` (from 1), with
    /// the tongue of `resonance` within `window`.
    pub fn materials(scenario: &Scenario, mode: usize, resonance: Resonance, window: Window) -> Self {
        let work = |ceramic| {
            let scenario = scenario.clone();
            Work::Design(DesignWork::Material { scenario, ceramic, mode, resonance, window })
        };
        Self::new(Ceramic::ALL.map(work).to_vec())
    }

    /// The table of trust for `quantity`: 1 to 8 modes, each under the four laws of
    /// [`LAWS`](crate::jobs::design::trust::LAWS).
    pub fn trust(scenario: &Scenario, quantity: Quantity) -> Self {
        let work = |(modes, law)| {
            Work::Design(DesignWork::Trust { scenario: scenario.clone(), modes, law, quantity })
        };
        Self::new(places().map(work).collect())
    }

    /// The pieces.
    pub fn works(&self) -> &[Work] {
        &self.works
    }

    /// What each found, or why it did not; `None` until it is known.
    pub fn found(&self) -> &[Option<Result<Finding, String>>] {
        &self.found
    }

    /// What each found of a table of materials, in the order of [`Ceramic::ALL`].
    pub fn material_rows(&self) -> impl Iterator<Item = Option<Result<&MaterialRow, &str>>> {
        self.picked(|finding| match finding {
            DesignFinding::Material(row) => Some(&**row),
            _ => None,
        })
    }

    /// What each found of a table of trust, modes by modes.
    pub fn trust_entries(&self) -> impl Iterator<Item = Option<Result<&TrustEntry, &str>>> {
        self.picked(|finding| match finding {
            DesignFinding::Trust(entry) => Some(entry),
            _ => None,
        })
    }

    fn picked<'a, T>(
        &'a self,
        pick: impl Fn(&'a DesignFinding) -> Option<T> + 'a,
    ) -> impl Iterator<Item = Option<Result<T, &'a str>>> {
        self.found.iter().map(move |found| match found.as_ref()? {
            Ok(Finding::Design(finding)) => pick(finding).map(Ok),
            Ok(_) => None,
            Err(message) => Some(Err(message.as_str())),
        })
    }
}

impl Study for Table {
    fn next(&mut self) -> Option<(usize, Work)> {
        let work = self.works.get(self.handed)?.clone();
        self.handed += 1;
        Some((self.handed - 1, work))
    }

    fn take(&mut self, ticket: usize, finding: Result<Finding, String>) {
        if let Some(place) = self.found.get_mut(ticket) {
            *place = Some(finding);
        }
    }

    fn progress(&self) -> f64 {
        let done = self.found.iter().flatten().count();
        done as f64 / self.found.len().max(1) as f64
    }

    fn finished(&self) -> bool {
        self.found.iter().all(Option::is_some)
    }
}
