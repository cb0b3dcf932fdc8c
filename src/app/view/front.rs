//! What is in front: the tab, and the part of the stability map.

use serde::{Deserialize, Serialize};

use crate::app::text::marked;
use crate::theory::Resonance;

/// The tabs of the top bar.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Tab {
    /// The four linked plots.
    #[default]
    Explore,
    /// A run in which time goes on.
    Live,
    /// Charts, multipliers, basins.
    Stability,
    /// Orbit diagrams and response curves.
    Sweep,
    /// A device in SI units: watts, load, limits.
    Design,
    /// The paper's figures and tables.
    Paper,
    /// The list of guided lessons.
    Lessons,
}

impl Tab {
    /// All of them in their order, with their names.
    pub const NAMED: [(Self, &'static str); 7] = [
        (Self::Explore, marked("Explore")),
        (Self::Live, marked("Live")),
        (Self::Stability, marked("Stability")),
        (Self::Sweep, marked("Sweep")),
        (Self::Design, marked("Design")),
        (Self::Paper, marked("Paper")),
        (Self::Lessons, marked("Lessons")),
    ];
}

/// Which part of the (omega, beta) plane the stability map shows.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum MapWindow {
    /// All three resonances.
    #[default]
    All,
    /// About twice the first natural frequency.
    First,
    /// About the sum of the first two.
    Sum,
    /// About twice the second.
    Second,
}

impl MapWindow {
    /// The resonance in the middle of the window.
    pub fn resonance(self) -> Option<Resonance> {
        match self {
            Self::All => None,
            Self::First => Some(Resonance::First),
            Self::Sum => Some(Resonance::Sum),
            Self::Second => Some(Resonance::Second),
        }
    }

    /// The window about a resonance.
    pub fn about(resonance: Resonance) -> Self {
        match resonance {
            Resonance::First => Self::First,
            Resonance::Sum => Self::Sum,
            Resonance::Second => Self::Second,
        }
    }
}
