//! The exact borders of the three tongues of a device.

use nanoserde::{DeBin, SerBin};

use crate::dynamics::bifurcations::tongue::{Tongue, Window};
use crate::dynamics::trace_tongue;
use crate::scenario::Scenario;
use crate::scheduler::{Asked, Failure, Order, Piece, Study};
use crate::theory::Resonance;

/// The exact border of a tongue; excitation and start of the scenario play no role.
#[derive(Debug, Clone, PartialEq, SerBin, DeBin)]
pub struct Border {
    /// The device.
    pub scenario: Scenario,
    /// Which tongue.
    pub resonance: Resonance,
    /// How far it is followed.
    pub window: Window,
}

impl Piece for Border {
    const NAME: &'static str = "tongue";
    /// The tongue, if there is one within the window.
    type Found = Option<Tongue>;

    fn carry_out(&self) -> Result<Option<Tongue>, Failure> {
        let (system, _) = self.scenario.validate()?;
        Ok(trace_tongue(&system, self.resonance, self.window)?)
    }
}

/// What is known of one tongue.
#[derive(Debug, Clone, PartialEq, Default)]
pub enum Traced {
    /// Nothing yet.
    #[default]
    Waiting,
    /// Its border; none when the forced motion stays stable within the window.
    Done(Option<Tongue>),
    /// Why it has none.
    Failed(Failure),
}

/// The tongues of one device.
#[derive(Debug, Clone)]
pub struct TongueStudy {
    /// The device, and how far they are followed.
    asked: (Scenario, Window),
    handed: usize,
    traced: [Traced; 3],
}

impl TongueStudy {
    /// The tongues of the device of `scenario` within `window`.
    pub fn new(scenario: Scenario, window: Window) -> Self {
        Self { asked: (scenario, window), handed: 0, traced: Default::default() }
    }

    /// What is known of the tongue of `resonance`.
    pub fn tongue(&self, resonance: Resonance) -> &Traced {
        let index = Resonance::ALL.iter().position(|other| *other == resonance);
        &self.traced[index.unwrap_or_default()]
    }
}

impl Asked for TongueStudy {
    type Question = (Scenario, Window);

    fn asked(&self) -> &Self::Question {
        &self.asked
    }
}

impl Study for TongueStudy {
    fn next(&mut self) -> Option<Order<Self>> {
        let place = self.handed;
        let resonance = *Resonance::ALL.get(place)?;
        self.handed += 1;
        let (scenario, window) = self.asked.clone();
        let border = Border { scenario, resonance, window };
        Some(Order::new(border, move |study: &mut Self, found| {
            study.traced[place] = found.map_or_else(Traced::Failed, Traced::Done);
        }))
    }

    fn progress(&self) -> f64 {
        let done = self.traced.iter().filter(|traced| **traced != Traced::Waiting).count();
        done as f64 / self.traced.len() as f64
    }

    fn finished(&self) -> bool {
        self.traced.iter().all(|traced| *traced != Traced::Waiting)
    }
}
