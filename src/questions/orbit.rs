//! Orbit requests: a periodic motion, its stability and its measures.

use serde::{Deserialize, Serialize};

use super::checks::{count, state};
use super::error::RequestError;
use super::question::Question;
use crate::dynamics::orbits::period_map::MOST_PERIODS;
use crate::dynamics::{self, Instability, Measures};
use crate::scenario::Scenario;
use crate::scheduler::Budget;

/// A periodic motion.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Orbit {
    /// State at t = 0 (length 2N + 1) from which Newton's iteration starts; when absent, the forced motion is followed
    /// from rest.
    pub guess: Option<Vec<f64>>,
    /// Its period, in excitation periods, or a multiple of it.
    pub periods: usize,
}

impl Default for Orbit {
    fn default() -> Self {
        Self { guess: None, periods: 1 }
    }
}

/// A periodic motion.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct OrbitAnswer {
    /// State at t = 0: q_1..q_N, dq_1/dt..dq_N/dt, v.
    pub state: Vec<f64>,
    /// Its shortest period, in excitation periods: a divisor of what was asked for.
    pub periods: usize,
    /// Without a guess, whether it is the motion that grows out of rest with beta; where that ends below, it is what
    /// Newton's iteration reaches from the linear response. Null with a guess.
    pub forced: Option<bool>,
    /// Floquet multipliers [re, im] over that period by descending modulus.
    pub multipliers: Vec<[f64; 2]>,
    /// Whether all of them are inside the unit circle.
    pub stable: bool,
    /// How it is unstable; null when it is stable.
    pub instability: Option<Instability>,
    /// Means and extremes.
    #[serde(flatten)]
    pub measures: Measures,
    /// Largest defect of periodicity, as a displacement over the gap s0 (dimensionless).
    pub residual: f64,
    /// Relative error of the product of the multipliers against Liouville's formula; null when rounding hides it.
    pub liouville_defect: Option<f64>,
}

impl Question for Orbit {
    const TASK: &'static str = "orbit";
    type Answer = OrbitAnswer;

    fn answer(&self, scenario: Scenario, _: &Budget<'_>) -> Result<OrbitAnswer, RequestError> {
        count("periods", self.periods, (1, MOST_PERIODS))?;
        let system = scenario.model.system(scenario.parameters)?;
        state("guess", self.guess.as_ref(), system.dimension())?;
        let (orbit, forced) = match &self.guess {
            Some(guess) => (dynamics::Orbit::find(&system, Some(guess), self.periods)?, None),
            None => {
                let (orbit, forced) = dynamics::Orbit::from_rest(&system)?;
                (orbit, Some(forced))
            }
        };
        let (stable, instability) = (orbit.stable(), orbit.instability());
        Ok(OrbitAnswer {
            periods: orbit.periods,
            forced,
            multipliers: orbit.multipliers.iter().map(|mu| [mu.re, mu.im]).collect(),
            stable,
            instability,
            measures: orbit.measures,
            residual: orbit.residual,
            liouville_defect: orbit.liouville_defect,
            state: orbit.state,
        })
    }
}
