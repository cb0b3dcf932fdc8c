//! One verdict on the motion that a start leads to, with all it rests on. [`super::Inquiry`] computes it.

use nalgebra::Complex;
use serde::{Deserialize, Serialize};

use super::evidence::{Evidence, EvidenceSource};
use super::lyapunov::Exponent;
use super::motion::Motion;
use super::rotation::Rotation;
use super::voltage_spectrum::{Peak, VoltageSpectrumError};
use crate::dynamics::bifurcations::ForcedMotion;
use crate::dynamics::bifurcations::boundary::CriticalExcitation;
use crate::dynamics::integration::{IntegrationError, Measures};
use crate::dynamics::orbits::{Instability, Orbit};
use crate::model::force::Exact;
use crate::model::limits::LINEAR_BEAM;
use crate::model::{ForceLaw, ReducedSystem};
use crate::number::in_sentence;
use crate::sentence::{Say, Sentence, in_english, said};

/// Distance from the periodic motion, relative to the amplitude, beyond which the transient has not gone.
const TRANSIENT: f64 = 1e-3;
/// Relative error of the force law from which the verdict warns of it.
const FORCE_ERROR: f64 = 0.1;

/// A Floquet multiplier.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, nanoserde::SerBin, nanoserde::DeBin)]
pub struct Multiplier {
    /// Real part.
    pub re: f64,
    /// Imaginary part, not negative: the upper of a pair.
    pub im: f64,
    /// Modulus.
    pub modulus: f64,
}

impl From<Complex<f64>> for Multiplier {
    fn from(value: Complex<f64>) -> Self {
        Self { re: value.re, im: value.im.abs(), modulus: value.norm() }
    }
}

/// The forced motion at the same parameters.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, nanoserde::SerBin, nanoserde::DeBin)]
pub struct ForcedSummary {
    /// Its largest multiplier over one excitation period.
    pub multiplier: Multiplier,
    /// Whether it is stable.
    pub stable: bool,
    /// How it is unstable.
    pub instability: Option<Instability>,
    /// The lowest beta at which it is unstable, if below the system's.
    pub unstable_from: Option<f64>,
    /// Its means and extremes.
    #[serde(flatten)]
    pub measures: Measures,
}

impl ForcedSummary {
    pub(super) fn new(forced: &ForcedMotion, orbit: &Orbit) -> Self {
        Self {
            multiplier: orbit.largest_multiplier().into(),
            stable: orbit.stable(),
            instability: orbit.instability(),
            unstable_from: forced.critical.beta(),
            measures: orbit.measures,
        }
    }
}

/// Which other start leads to another motion.
#[derive(
    Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize, nanoserde::SerBin, nanoserde::DeBin,
)]
#[serde(rename_all = "snake_case")]
pub enum OtherStart {
    /// On the forced motion, which is stable.
    ForcedMotion,
    /// At rest.
    Rest,
    /// Beside the start asked for, by no more than rounding.
    Beside,
    /// On a stable periodic motion that was met on the way.
    OnTheWay,
}

/// Another attracting motion at the same parameters.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, nanoserde::SerBin, nanoserde::DeBin)]
pub struct Coexisting {
    /// The start that leads there.
    pub start: OtherStart,
    /// Its class.
    pub motion: Motion,
    /// Its means and extremes; 0 when it ends.
    #[serde(flatten)]
    pub measures: Measures,
}

impl Say for Coexisting {
    fn say(&self) -> Sentence {
        let values: [(&str, &dyn Say); 2] =
            [("motion", &self.motion), ("volts", &in_sentence(self.measures.v_rms))];
        match self.start {
            OtherStart::ForcedMotion => said(
                "a start on the stable forced motion leads to another motion: {motion}, {volts} V rms",
                &values,
            ),
            OtherStart::Rest => {
                said("a start at rest leads to another motion: {motion}, {volts} V rms", &values)
            }
            OtherStart::Beside => said(
                "a start that differs by rounding leads to another motion: {motion}, {volts} V rms",
                &values,
            ),
            OtherStart::OnTheWay => said(
                "a start on a motion met on the way leads to another motion: {motion}, {volts} V rms",
                &values,
            ),
        }
    }
}

/// What to know before relying on a verdict.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, nanoserde::SerBin, nanoserde::DeBin)]
#[serde(rename_all = "snake_case", tag = "kind")]
pub enum Warning {
    /// The run ends away from the periodic motion it approaches.
    TransientLeft {
        /// How far, relative to the amplitude.
        fraction: f64,
    },
    /// Neighbouring motions diverge until it settles: transient chaos.
    TransientChaos {
        /// When it has settled (dimensionless).
        time: f64,
    },
    /// The effort was spent before the motion could be decided on.
    WouldTake {
        /// How much longer it would take (dimensionless).
        time: f64,
    },
    /// The truncated force law is wrong where the tip comes closest to the magnet.
    ForceLaw {
        /// 1 - R / R_exact there: positive when the law is too weak.
        missing: f64,
    },
    /// The tip passes the place of the fixed magnet: only the exact force law knows of contact.
    PassesMagnet,
    /// The tip moves so far that no linear beam theory holds, whatever the force law.
    LargeDeflection {
        /// Largest tip displacement, in beam lengths.
        tip: f64,
    },
    /// The escape is over the barrier of the truncated law; the exact one has none.
    TruncatedBarrier,
    /// The forced motion cannot be followed to this excitation: it meets another one and both end, or it is lost.
    ForcedMotionEnds {
        /// The last beta reached (dimensionless).
        beta: f64,
    },
    /// The forced motion or its multipliers could not be computed.
    ForcedMotionUnknown,
}

impl Say for Warning {
    fn say(&self) -> Sentence {
        match *self {
            Self::TransientLeft { fraction } => said(
                "the transient has not gone: the run ends {percent} % of the amplitude away",
                &[("percent", &in_sentence(100.0 * fraction))],
            ),
            Self::TransientChaos { time } => said(
                "neighbouring motions diverge until it settles, at t = {time}",
                &[("time", &in_sentence(time))],
            ),
            Self::WouldTake { time } => {
                said("to decide would take about {time} more in t", &[("time", &in_sentence(time))])
            }
            Self::ForceLaw { missing } if missing > 0.0 => said(
                "the magnet force beyond its linear part is {percent} % too weak at the closest approach under this force law",
                &[("percent", &in_sentence(100.0 * missing))],
            ),
            Self::ForceLaw { missing } => said(
                "the magnet force beyond its linear part is {percent} % too strong at the closest approach under this force law",
                &[("percent", &in_sentence(-100.0 * missing))],
            ),
            Self::PassesMagnet => {
                said("the tip passes through the magnet: only the exact force law knows of contact", &[])
            }
            Self::LargeDeflection { tip } => said(
                "the tip moves by {part} of the beam's length, where the beam is no linear one",
                &[("part", &in_sentence(tip))],
            ),
            Self::TruncatedBarrier => {
                said("the escape is over the barrier of the truncated force law; the exact one has none", &[])
            }
            Self::ForcedMotionEnds { beta } => said(
                "the motion that grows from rest with beta can be followed to beta = {beta} only",
                &[("beta", &in_sentence(beta))],
            ),
            Self::ForcedMotionUnknown => said("the forced motion could not be computed", &[]),
        }
    }
}

in_english!(Coexisting, Warning);

/// How wrong the force law of `system` is where its tip comes to `tip_min` (in beam lengths); `None` when it is exact,
/// without magnets, or right within a tenth.
pub fn force_law_warning(system: &ReducedSystem, tip_min: f64) -> Option<Warning> {
    if system.parameters.c0 == 0.0 || system.law == ForceLaw::Exact {
        return None;
    }
    let exact = Exact::new(&system.magnet(), &system.equilibrium);
    if tip_min <= exact.contact()? {
        return Some(Warning::PassesMagnet);
    }
    let missing = 1.0 - system.rest_force().rest(tip_min) / exact.rest(tip_min);
    (missing.abs() >= FORCE_ERROR).then_some(Warning::ForceLaw { missing })
}

/// What is known of the motion that a start leads to.
#[derive(Debug, Clone, PartialEq, Serialize, nanoserde::SerBin, nanoserde::DeBin)]
pub struct Verdict {
    /// Its class; undecided when the evidence disagrees.
    pub motion: Motion,
    /// The class by the run, its Newton iteration and exponent alone: the one that the evidence agrees with or not.
    pub suspected: Motion,
    /// Largest multiplier of the periodic motion reached, over its own period.
    pub multiplier: Option<Multiplier>,
    /// The forced motion at these parameters; `None` when it cannot be followed there.
    pub forced: Option<ForcedSummary>,
    /// The largest Lyapunov exponents of the motion reached; `None` when it ended.
    pub exponent: Option<Exponent>,
    /// Root mean square of the voltage (V).
    pub v_rms: Option<f64>,
    /// Largest |v| (V).
    pub v_peak: Option<f64>,
    /// Mean power kappa v^2 in the load (dimensionless).
    pub power: Option<f64>,
    /// Lowest and highest tip displacement over the gap s0 (dimensionless); contact is at -1.
    pub tip_over_gap: Option<(f64, f64)>,
    /// Largest |slope| at the tip from equilibrium (rad).
    pub slope: Option<f64>,
    /// Strongest lines of the voltage's spectrum, by descending amplitude.
    pub peaks: Vec<Peak>,
    /// On a torus, the measured second basic frequency (dimensionless); the first is omega.
    pub basic: Option<f64>,
    /// On a torus, its turns in an excitation period.
    pub rotation: Option<Rotation>,
    /// What the class rests on.
    pub rests_on: Vec<Evidence>,
    /// The pieces of evidence that contradict it.
    pub disagreeing: Vec<EvidenceSource>,
    /// Other attracting motions met at the same parameters. Few other starts are tried: there may be more.
    pub coexists: Vec<Coexisting>,
    /// What to know before relying on it.
    pub warnings: Vec<Warning>,
}

/// Why there is no verdict.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("{}", self.say())]
pub enum VerdictError {
    /// The motion cannot be integrated.
    Integration(#[from] IntegrationError),
    /// The voltage has no spectrum.
    Spectrum(#[from] VoltageSpectrumError),
}

impl Say for VerdictError {
    fn say(&self) -> Sentence {
        match self {
            Self::Integration(error) => error.say(),
            Self::Spectrum(error) => error.say(),
        }
    }
}

/// The warning about a deflection between `tip_min` and `tip_max` (in beam lengths).
pub(super) fn deflection_warning(tip_min: f64, tip_max: f64) -> Option<Warning> {
    let tip = tip_max.max(-tip_min);
    (tip > LINEAR_BEAM).then_some(Warning::LargeDeflection { tip })
}

/// The warning about a run that ended `distance` (relative to its amplitude) from the periodic motion it approaches.
pub(super) fn transient_warning(distance: Option<f64>) -> Option<Warning> {
    distance.filter(|fraction| *fraction > TRANSIENT).map(|fraction| Warning::TransientLeft { fraction })
}

/// The warning about a forced motion that is not there.
pub(super) fn forced_warning(forced: Option<&ForcedMotion>) -> Option<Warning> {
    match forced {
        Some(ForcedMotion { orbit: Some(_), .. }) => None,
        Some(ForcedMotion { critical: CriticalExcitation::Ends { beta }, .. }) => {
            Some(Warning::ForcedMotionEnds { beta: *beta })
        }
        _ => Some(Warning::ForcedMotionUnknown),
    }
}
