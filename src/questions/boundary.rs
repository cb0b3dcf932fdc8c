//! Boundary requests: the lowest unstable excitation amplitude over frequency, by three theories.

use serde::{Deserialize, Serialize};

use super::checks::count;
use super::error::RequestError;
use super::question::Question;
use crate::dynamics::{Instability, OrbitError, ResonanceBoundary, resonance_boundary};
use crate::model::{ModelError, Parameter, ReducedSystem};
use crate::scenario::Scenario;
use crate::scheduler::Budget;
use crate::theory::{CoupledModes, Published, Resonance, TheoryError};

/// Most frequencies of a request: closed formulas take microseconds, Floquet multipliers half a millisecond with two
/// modes and 25 with eight.
const MOST_CLOSED: usize = 100_000;
const MOST_FLOQUET: usize = 10_000;
/// Allowed limits of the search by multipliers: below the lowest, rounding hides the multipliers' change.
const LIMITS: (f64, f64) = (1e-6, Parameter::Beta.range().1);

/// A stability boundary; the scenario's beta and omega play no role, and the closed theories use the quadratic term of its
/// force law.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Boundary {
    /// Which resonance.
    pub resonance: Resonance,
    /// Which theory.
    pub theory: Theory,
    /// Excitation frequencies (dimensionless).
    pub omega: Vec<f64>,
    /// Highest amplitude looked at by the theory of Floquet.
    #[serde(default = "default_limit")]
    pub limit: f64,
}

/// The theories that give a boundary.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Theory {
    /// Eqs. (57), (72), (81) as printed.
    Published,
    /// The coupled-mode boundary, which keeps the circuit.
    Coupled,
    /// The forced motion's Floquet multipliers, with nothing left out.
    Floquet,
}

/// A boundary. The further lists, one entry an omega like `beta`, are the theory of Floquet's.
#[derive(Debug, Clone, PartialEq, Default, Serialize)]
pub struct BoundaryAnswer {
    /// Lowest unstable beta at each omega (dimensionless); null where there is none.
    pub beta: Vec<Option<f64>>,
    /// The first loss of stability of any kind and by any resonance, at or below `beta`, else below the limit.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub first: Option<Vec<Option<FirstLoss>>>,
    /// Where the forced motion ends before the resonance makes it unstable (dimensionless).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub ends: Option<Vec<Option<f64>>>,
    /// Why nothing is known at this omega.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub failed: Option<Vec<Option<String>>>,
}

/// Where the forced motion first loses its stability, and how.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct FirstLoss {
    /// The excitation (dimensionless).
    pub beta: f64,
    /// The kind; at a fold the motion ends.
    pub kind: Instability,
}

const fn default_limit() -> f64 {
    0.04
}

impl Question for Boundary {
    const TASK: &'static str = "boundary";
    type Answer = BoundaryAnswer;

    fn answer(&self, scenario: Scenario, budget: &Budget<'_>) -> Result<BoundaryAnswer, RequestError> {
        let most = if self.theory == Theory::Floquet { MOST_FLOQUET } else { MOST_CLOSED };
        count("numbers in omega", self.omega.len(), (0, most))?;
        for omega in &self.omega {
            ModelError::check("omega", *omega, Parameter::Omega.range(), "")?;
        }
        ModelError::check("limit", self.limit, LIMITS, "")?;
        let system = scenario.model.system(scenario.parameters)?;
        let (omegas, resonance) = (self.omega.iter(), self.resonance);
        let closed = |beta| BoundaryAnswer { beta, ..Default::default() };
        Ok(match self.theory {
            Theory::Published => {
                let theory = Published::new(&system)?;
                closed(omegas.map(|omega| theory.boundary(resonance, *omega)).collect())
            }
            Theory::Coupled => {
                let theory = CoupledModes::new(&system)?;
                closed(omegas.map(|omega| theory.boundary(resonance, *omega)).collect())
            }
            Theory::Floquet => self.by_multipliers(&system, budget)?,
        })
    }
}

impl Boundary {
    /// Where the resonance makes the forced motion unstable; other losses of stability are passed. What fails at one
    /// frequency is told there.
    fn by_multipliers(
        &self,
        system: &ReducedSystem,
        budget: &Budget<'_>,
    ) -> Result<BoundaryAnswer, RequestError> {
        let (found, needed) = (system.modes.len(), self.resonance.pair().1 + 1);
        if found < needed {
            return Err(TheoryError::TooFewModes { found }.into());
        }
        let found: Vec<Option<Result<ResonanceBoundary, OrbitError>>> =
            budget.map(&self.omega, |omega| resonance_boundary(system, *omega, self.limit, self.resonance));
        let known = || found.iter().map(|boundary| boundary.as_ref()?.as_ref().ok());
        let first = |boundary: &ResonanceBoundary| {
            boundary.first.map(|loss| FirstLoss { beta: loss.beta, kind: loss.instability })
        };
        let failed =
            |boundary: &Option<Result<_, OrbitError>>| Some(boundary.as_ref()?.as_ref().err()?.to_string());
        Ok(BoundaryAnswer {
            beta: known().map(|boundary| boundary?.beta).collect(),
            first: Some(known().map(|boundary| first(boundary?)).collect()),
            ends: Some(known().map(|boundary| boundary?.ends).collect()),
            failed: Some(found.iter().map(failed).collect()),
        })
    }
}
