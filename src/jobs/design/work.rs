//! The bench's pieces of work.

use super::change::{Way, between};
use super::find::{Evaluation, FindQuestion, evaluate};
use super::harvest::{Operating, operating};
use super::load::{BestFrequency, LoadPoint, best_frequency, forced_loads, reached_loads};
use super::materials::{MaterialRow, material_row};
use super::trust::{Quantity, TrustEntry, trust_entry};
use super::{DesignError, HarvestPoint};
use crate::dynamics::bifurcations::tongue::Window;
use crate::model::materials::Ceramic;
use crate::model::{ForceLaw, Limits, Shaking};
use crate::scenario::Scenario;
use crate::theory::Resonance;

/// A piece of work of the bench, done within a second.
#[derive(Debug, Clone, PartialEq, nanoserde::SerBin, nanoserde::DeBin)]
pub enum DesignWork {
    /// What the device harvests under its own excitation.
    Operating {
        /// The device.
        scenario: Scenario,
    },
    /// The forced motion under one load after the other.
    ForcedLoads {
        /// The device.
        scenario: Scenario,
        /// Load resistances (ohm) in their order.
        resistances: Vec<f64>,
    },
    /// The motion reached under one load after the other.
    ReachedLoads {
        /// The device, and the start when `state` is absent.
        scenario: Scenario,
        /// Load resistances (ohm) in their order.
        resistances: Vec<f64>,
        /// State carried over from the load before (length 2N + 1).
        state: Option<Vec<f64>>,
    },
    /// The best frequency under a load.
    BestFrequency {
        /// The device.
        scenario: Scenario,
        /// Load resistance (ohm).
        resistance: f64,
        /// Lowest and highest omega (dimensionless).
        window: (f64, f64),
        /// What of the base's motion stays at other frequencies.
        shaking: Shaking,
        /// What must be kept.
        limits: Limits,
    },
    /// Where a curve over frequency changes its motion.
    Change {
        /// The device.
        scenario: Scenario,
        /// What of the base's motion stays at other frequencies.
        shaking: Shaking,
        /// How its motions are reached.
        way: Way,
        /// Two neighbours (omega) in their order.
        neighbours: (f64, f64),
        /// Difference in power (W) that is small enough.
        difference: f64,
    },
    /// A ceramic on the device.
    Material {
        /// The device.
        scenario: Scenario,
        /// The ceramic.
        ceramic: Ceramic,
        /// The mode that gets its quality factor, from 1.
        mode: usize,
        /// Whose tongue is traced.
        resonance: Resonance,
        /// How far.
        window: Window,
    },
    /// An entry of the table of trust.
    Trust {
        /// The device.
        scenario: Scenario,
        /// Number of modes.
        modes: usize,
        /// Force law.
        law: ForceLaw,
        /// What is compared.
        quantity: Quantity,
    },
    /// A candidate of a search.
    Candidate {
        /// What is searched.
        question: Box<FindQuestion>,
        /// A value for each variable.
        values: Vec<f64>,
    },
}

/// What it found.
#[derive(Debug, Clone, PartialEq, nanoserde::SerBin, nanoserde::DeBin)]
pub enum DesignFinding {
    /// What the device harvests.
    Operating(Box<Operating>),
    /// One a load, where the forced motion exists.
    ForcedLoads(Vec<Option<LoadPoint>>),
    /// One a load, and the state to go on from (length 2N + 1).
    ReachedLoads {
        /// The motions.
        points: Vec<LoadPoint>,
        /// Absent when the last one ended.
        state: Option<Vec<f64>>,
    },
    /// The best frequency.
    BestFrequency(BestFrequency),
    /// The points between two neighbours of a curve; nothing where the motion ends.
    Change(Vec<Option<HarvestPoint>>),
    /// A ceramic's row.
    Material(Box<MaterialRow>),
    /// An entry.
    Trust(TrustEntry),
    /// A candidate's evaluation.
    Candidate(Evaluation),
}

impl DesignWork {
    /// Does the work.
    ///
    /// # Errors
    /// [`DesignError`], naming what is out of range or cannot be computed.
    pub fn carry_out(&self) -> Result<DesignFinding, DesignError> {
        Ok(match self {
            Self::Operating { scenario } => DesignFinding::Operating(Box::new(operating(scenario)?)),
            Self::ForcedLoads { scenario, resistances } => {
                DesignFinding::ForcedLoads(forced_loads(scenario, resistances)?)
            }
            Self::ReachedLoads { scenario, resistances, state } => {
                let (points, state) = reached_loads(scenario, resistances, state.as_deref())?;
                DesignFinding::ReachedLoads { points, state }
            }
            Self::BestFrequency { scenario, resistance, window, shaking, limits } => {
                let window = (*window, *shaking);
                DesignFinding::BestFrequency(best_frequency(scenario, *resistance, window, *limits)?)
            }
            Self::Change { scenario, shaking, way, neighbours, difference } => {
                DesignFinding::Change(between(scenario, *shaking, way, *neighbours, *difference)?)
            }
            Self::Material { scenario, ceramic, mode, resonance, window } => {
                let row = material_row(scenario, *ceramic, *mode, *resonance, *window)?;
                DesignFinding::Material(Box::new(row))
            }
            Self::Trust { scenario, modes, law, quantity } => {
                DesignFinding::Trust(trust_entry(scenario, *modes, *law, *quantity)?)
            }
            Self::Candidate { question, values } => DesignFinding::Candidate(evaluate(question, values)?),
        })
    }
}
