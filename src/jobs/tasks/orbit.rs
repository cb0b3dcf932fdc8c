//! Orbit requests: a periodic motion, its stability and its measures.

use serde::{Deserialize, Serialize};

use super::{Answer, count, state};
use crate::dynamics::orbits::period_map::MOST_PERIODS;
use crate::dynamics::{Instability, Orbit};
use crate::jobs::RequestError;
use crate::model::ParameterSet;
use crate::scenario::ModelChoice;

/// A periodic motion.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct OrbitRequest {
    /// The ten numbers; missing ones are the paper's.
    pub parameters: ParameterSet,
    /// Modes and force law.
    pub model: ModelChoice,
    /// State at t = 0 (length 2N + 1) from which Newton's iteration starts; when absent, the forced motion is followed
    /// from rest.
    pub guess: Option<Vec<f64>>,
    /// Its period, in excitation periods, or a multiple of it.
    pub periods: usize,
}

impl Default for OrbitRequest {
    fn default() -> Self {
        Self { parameters: ParameterSet::default(), model: ModelChoice::default(), guess: None, periods: 1 }
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
    /// Root mean square of the voltage (V).
    pub v_rms: f64,
    /// Mean electrical power kappa v^2 (dimensionless).
    pub power: f64,
    /// Lowest and highest tip displacement, in beam lengths.
    pub tip: [f64; 2],
    /// Largest defect of periodicity, as a displacement over the gap s0 (dimensionless).
    pub residual: f64,
    /// Relative error of the product of the multipliers against Liouville's formula; null when rounding hides it.
    pub liouville_defect: Option<f64>,
}

impl OrbitRequest {
    /// Computes the answer.
    ///
    /// # Errors
    /// [`RequestError`] when a number is out of range or no periodic motion is found.
    pub fn answer(&self) -> Result<Answer, RequestError> {
        count("periods", self.periods, (1, MOST_PERIODS))?;
        let system = self.model.system(self.parameters)?;
        state("guess", self.guess.as_ref(), system.dimension())?;
        let (orbit, forced) = match &self.guess {
            Some(guess) => (Orbit::find(&system, Some(guess), self.periods)?, None),
            None => {
                let (orbit, forced) = Orbit::from_rest(&system)?;
                (orbit, Some(forced))
            }
        };
        let (stable, instability) = (orbit.stable(), orbit.instability());
        Ok(Answer::Orbit(OrbitAnswer {
            periods: orbit.periods,
            forced,
            multipliers: orbit.multipliers.iter().map(|mu| [mu.re, mu.im]).collect(),
            stable,
            instability,
            v_rms: orbit.measures.v_rms,
            power: orbit.measures.power,
            tip: [orbit.measures.tip_min, orbit.measures.tip_max],
            residual: orbit.residual,
            liouville_defect: orbit.liouville_defect,
            state: orbit.state,
        }))
    }
}
