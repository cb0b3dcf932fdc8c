//! The exact borders of the three tongues of a device.

use super::Study;
use crate::dynamics::bifurcations::tongue::{Tongue, Window};
use crate::jobs::work::{Finding, Work};
use crate::scenario::Scenario;
use crate::theory::Resonance;

/// What is known of one tongue.
#[derive(Debug, Clone, PartialEq, Default)]
pub enum Traced {
    /// Nothing yet.
    #[default]
    Waiting,
    /// Its border; none when the forced motion stays stable within the window.
    Done(Option<Tongue>),
    /// Why it has none.
    Failed(String),
}

/// The tongues of one device.
#[derive(Debug, Clone)]
pub struct TongueStudy {
    scenario: Scenario,
    window: Window,
    handed: usize,
    traced: [Traced; 3],
}

impl TongueStudy {
    /// The tongues of the device of `scenario` within `window`.
    pub fn new(scenario: Scenario, window: Window) -> Self {
        Self { scenario, window, handed: 0, traced: Default::default() }
    }

    /// The device.
    pub fn scenario(&self) -> &Scenario {
        &self.scenario
    }

    /// How far they are followed.
    pub fn window(&self) -> Window {
        self.window
    }

    /// What is known of the tongue of `resonance`.
    pub fn tongue(&self, resonance: Resonance) -> &Traced {
        let index = Resonance::ALL.iter().position(|other| *other == resonance);
        &self.traced[index.unwrap_or_default()]
    }
}

impl Study for TongueStudy {
    fn next(&mut self) -> Option<(usize, Work)> {
        let ticket = self.handed;
        let resonance = *Resonance::ALL.get(ticket)?;
        self.handed += 1;
        Some((ticket, Work::Tongue { scenario: self.scenario.clone(), resonance, window: self.window }))
    }

    fn take(&mut self, ticket: usize, finding: Result<Finding, String>) {
        let Some(place) = self.traced.get_mut(ticket) else { return };
        match finding {
            Ok(Finding::Tongue(tongue)) => *place = Traced::Done(tongue),
            Ok(_) => {}
            Err(message) => *place = Traced::Failed(message),
        }
    }

    fn progress(&self) -> f64 {
        let done = self.traced.iter().filter(|traced| **traced != Traced::Waiting).count();
        done as f64 / self.traced.len() as f64
    }

    fn finished(&self) -> bool {
        self.traced.iter().all(|traced| *traced != Traced::Waiting)
    }
}
