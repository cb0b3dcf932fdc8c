//! What the verdict on a motion rests on: each way of looking at it, what it says, and whether it agrees with the class.

use std::fmt;

use serde::ser::SerializeStruct as _;
use serde::{Deserialize, Serialize, Serializer};

use super::lyapunov::{Exponent, Sign};
use super::motion::{Cell, Motion, Reached};
use super::poincare::Recurrence;
use super::rotation::Rotation;
use super::signature::Signature;
use super::voltage_spectrum::{Peak, VoltageSpectrum};
use crate::dynamics::orbits::Orbit;
use crate::number::in_sentence;
use crate::sentence::{Say, Sentence, said};

/// Distance from a periodic motion below which its stroboscopic points must repeat.
const SETTLED: f64 = 1e-4;
/// Share of the mean square in the allowed lines, at least, on a regular motion.
const LINES: f64 = 0.99;
/// Peaks that are named.
const NAMED: usize = 4;

/// A way of looking at a motion.
#[derive(
    Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize, nanoserde::SerBin, nanoserde::DeBin,
)]
#[serde(rename_all = "snake_case")]
pub enum EvidenceSource {
    /// How the run ended.
    Run,
    /// Floquet multipliers of the periodic motion near the last state.
    Multipliers,
    /// Whether the stroboscopic points of the run repeat.
    Recurrence,
    /// The set that the stroboscopic points fill.
    Points,
    /// Starts that differ by rounding.
    Beside,
    /// How often the motion turns about its torus in an excitation period.
    Rotation,
    /// The 0-1 test for chaos.
    ZeroOne,
    /// The largest Lyapunov exponent.
    Exponent,
    /// The spectrum of the voltage.
    Spectrum,
}

/// Where starts that differ by rounding lead.
#[derive(Debug, Clone, Copy, PartialEq, nanoserde::SerBin, nanoserde::DeBin)]
pub struct End {
    /// How many of them.
    pub count: usize,
    /// To a motion of this class.
    pub motion: Motion,
    /// Root mean square of its voltage (V); `None` when it ends.
    pub v_rms: Option<f64>,
}

/// What looking at a motion shows.
#[derive(Debug, Clone, PartialEq, nanoserde::SerBin, nanoserde::DeBin)]
pub enum Observation {
    /// The run ended so.
    Run(Motion),
    /// There is a periodic motion near the last state.
    Multipliers {
        /// Its period, in excitation periods.
        periods: usize,
        /// Whether it is stable.
        stable: bool,
        /// Modulus of its largest multiplier.
        modulus: f64,
        /// How far the run ends from it, relative to its amplitude.
        distance: f64,
    },
    /// Whether the stroboscopic points repeat.
    Recurrence {
        /// What they say.
        found: Recurrence,
        /// The period of the motion, of which theirs is a multiple as they spiral in.
        multiple_of: Option<usize>,
    },
    /// The stroboscopic points lie on closed curves, a set of this dimension.
    ClosedCurves(f64),
    /// They fill a surface, a set of this dimension.
    Surface(f64),
    /// They are scattered over a set of this dimension.
    Scattered(f64),
    /// Where starts that differ by rounding lead.
    Beside(Vec<End>),
    /// How often the motion turns about its torus in an excitation period.
    Rotation(Rotation),
    /// The 0-1 test: near 0 on a regular motion, near 1 on a chaotic one.
    ZeroOne(f64),
    /// The largest Lyapunov exponent.
    Exponent {
        /// The exponent.
        found: Exponent,
        /// What it should be by the multipliers of the periodic motion reached (per dimensionless time).
        by_multipliers: Option<f64>,
    },
    /// The spectrum of the voltage.
    Spectrum {
        /// Its strongest lines.
        peaks: Vec<Peak>,
        /// On a torus, the second basic frequency (dimensionless).
        basic: Option<f64>,
        /// Share of the mean square in the lines that the motion's class allows.
        share: f64,
    },
}

/// One piece of evidence.
#[derive(Debug, Clone, PartialEq, nanoserde::SerBin, nanoserde::DeBin)]
pub struct Evidence {
    /// What it shows.
    pub shows: Observation,
    /// Whether it agrees with the class; `None` when it neither supports nor contradicts it.
    pub agrees: Option<bool>,
}

impl Say for Observation {
    fn say(&self) -> Sentence {
        let dimension = |dimension: &f64| format!("{dimension:.2}");
        match self {
            Self::Run(motion) => motion.say(),
            Self::Multipliers { periods, stable, modulus, distance } => {
                let values: [(&str, &dyn Say); 3] = [
                    ("periods", periods),
                    ("modulus", &format!("{modulus:.6}")),
                    ("distance", &in_sentence(*distance)),
                ];
                if *stable {
                    said(
                        "period {periods} stable, largest modulus {modulus}; the run ends {distance} of the amplitude from it",
                        &values,
                    )
                } else {
                    said(
                        "period {periods} unstable, largest modulus {modulus}; the run ends {distance} of the amplitude from it",
                        &values,
                    )
                }
            }
            Self::Recurrence { found, multiple_of } => recurrence(found, *multiple_of),
            Self::ClosedCurves(of) => said(
                "stroboscopic points lie on closed curves: dimension {dimension}",
                &[("dimension", &dimension(of))],
            ),
            Self::Surface(of) => said(
                "stroboscopic points fill a surface: dimension {dimension}",
                &[("dimension", &dimension(of))],
            ),
            Self::Scattered(of) => said(
                "stroboscopic points are scattered: dimension {dimension}",
                &[("dimension", &dimension(of))],
            ),
            Self::Beside(ends) => {
                let ends = Sentence::list(ends.iter().map(Say::say), "; ");
                said("starts that differ by rounding: {ends}", &[("ends", &ends)])
            }
            Self::Rotation(Rotation { number, error }) => said(
                "rotation number {number}, the halves of the record differ by {error}",
                &[("number", &format!("{number:.9}")), ("error", &in_sentence(*error))],
            ),
            Self::ZeroOne(value) => {
                said("0-1 test {value}: 0 is regular, 1 chaotic", &[("value", &format!("{value:.2}"))])
            }
            Self::Exponent { found, by_multipliers } => exponent(found, *by_multipliers),
            Self::Spectrum { peaks, .. } if peaks.is_empty() => said("no voltage", &[]),
            Self::Spectrum { peaks, basic, share } => spectrum(peaks, *basic, *share),
        }
    }
}

impl Say for End {
    fn say(&self) -> Sentence {
        let Self { count, motion, v_rms } = self;
        match v_rms.map(in_sentence) {
            Some(volts) => said(
                "{count} × {motion}, {volts} V rms",
                &[("count", count), ("motion", motion), ("volts", &volts)],
            ),
            None => said("{count} × {motion}", &[("count", count), ("motion", motion)]),
        }
    }
}

fn recurrence(found: &Recurrence, multiple_of: Option<usize>) -> Sentence {
    let part = in_sentence(found.defect);
    let mut text = match found.period {
        Some(1) => said("stroboscopic points repeat after 1 period to {part}", &[("part", &part)]),
        Some(periods) => said(
            "stroboscopic points repeat after {periods} periods to {part}",
            &[("periods", &periods), ("part", &part)],
        ),
        None => {
            said("stroboscopic points do not repeat within 8 periods (off by {part})", &[("part", &part)])
        }
    };
    if found.period.is_some() && !found.settled {
        text = said("{text}, still settling", &[("text", &text)]);
    }
    if let Some(periods) = multiple_of {
        text = said(
            "{text}: a multiple of {periods}, as they spiral in",
            &[("text", &text), ("periods", &periods)],
        );
    }
    text
}

fn exponent(found: &Exponent, by_multipliers: Option<f64>) -> Sentence {
    let value = format!("{} ± {}", in_sentence(found.value), in_sentence(found.half_width));
    let value: [(&str, &dyn Say); 1] = [("value", &value)];
    let text = if found.sign() == Sign::Zero {
        said("exponent {value}: zero", &value)
    } else if found.converged {
        said("exponent {value}", &value)
    } else {
        said("exponent {value}, not converged", &value)
    };
    match by_multipliers.map(in_sentence) {
        Some(value) => said("{text}; by the multipliers {value}", &[("text", &text), ("value", &value)]),
        None => text,
    }
}

fn spectrum(peaks: &[Peak], basic: Option<f64>, share: f64) -> Sentence {
    let line = |peak: &Peak| {
        let name = peak.label.map_or_else(|| format!("{:.4}", peak.omega), |label| label.to_string());
        said("{line} at {volts} V", &[("line", &name), ("volts", &in_sentence(peak.amplitude))])
    };
    let mut parts: Vec<Sentence> = peaks.iter().map(line).collect();
    parts.extend(basic.map(|basic| Sentence::Verbatim(format!("ν = {basic:.5}"))));
    if share < LINES {
        let percent = in_sentence(100.0 * (1.0 - share));
        parts.push(said("{percent} % of its power between the lines", &[("percent", &percent)]));
    }
    Sentence::list(parts, ", ")
}

/// In English, where it comes from before what does not say it.
impl fmt::Display for Evidence {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self.source() {
            EvidenceSource::Run => "run: ",
            EvidenceSource::Multipliers => "multipliers: ",
            EvidenceSource::Spectrum => "spectrum: ",
            _ => "",
        })?;
        self.shows.say().fmt(f)
    }
}

/// For machines: where it comes from, what it says in English, and whether it agrees.
impl Serialize for Evidence {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut entries = serializer.serialize_struct("Evidence", 3)?;
        entries.serialize_field("source", &self.source())?;
        entries.serialize_field("says", &self.to_string())?;
        entries.serialize_field("agrees", &self.agrees)?;
        entries.end()
    }
}

impl Evidence {
    /// What supports the class.
    pub(super) fn supporting(shows: Observation) -> Self {
        Self { shows, agrees: Some(true) }
    }

    /// Where it comes from.
    pub fn source(&self) -> EvidenceSource {
        match self.shows {
            Observation::Run(_) => EvidenceSource::Run,
            Observation::Multipliers { .. } => EvidenceSource::Multipliers,
            Observation::Recurrence { .. } => EvidenceSource::Recurrence,
            Observation::ClosedCurves(_) | Observation::Surface(_) | Observation::Scattered(_) => {
                EvidenceSource::Points
            }
            Observation::Beside(_) => EvidenceSource::Beside,
            Observation::Rotation(_) => EvidenceSource::Rotation,
            Observation::ZeroOne(_) => EvidenceSource::ZeroOne,
            Observation::Exponent { .. } => EvidenceSource::Exponent,
            Observation::Spectrum { .. } => EvidenceSource::Spectrum,
        }
    }

    /// The multipliers of the periodic motion reached.
    pub(super) fn multipliers(orbit: &Orbit, distance: f64) -> Self {
        let (periods, stable) = (orbit.periods, orbit.stable());
        let modulus = orbit.largest_multiplier().norm();
        let shows = Observation::Multipliers { periods, stable, modulus, distance };
        Self { shows, agrees: Some(stable) }
    }

    /// Whether the stroboscopic points repeat.
    ///
    /// Points that repeat after p periods repeat after multiples of p too, and while they settle a multiple may look
    /// better; so any multiple agrees with period p.
    pub(super) fn recurrence(reached: &Reached) -> Option<Self> {
        let found = reached.recurrence?;
        let multiple_of = match (reached.motion, found.period) {
            (Motion::Periodic { periods }, Some(period)) => {
                (period > periods && period.is_multiple_of(periods)).then_some(periods)
            }
            _ => None,
        };
        let agrees = match (reached.motion, found.period) {
            (Motion::Periodic { periods }, Some(period)) if found.settled => {
                Some(period.is_multiple_of(periods))
            }
            (Motion::Periodic { periods }, Some(period)) => period.is_multiple_of(periods).then_some(true),
            (Motion::Periodic { periods }, None) => {
                let arrived = reached.distance.is_some_and(|distance| distance < SETTLED);
                (periods <= 8 && arrived).then_some(false)
            }
            (Motion::Quasiperiodic | Motion::Chaotic, Some(_)) => found.settled.then_some(false),
            (Motion::Quasiperiodic | Motion::Chaotic, None) => Some(true),
            _ => None,
        };
        Some(Self { shows: Observation::Recurrence { found, multiple_of }, agrees })
    }

    /// The set that the stroboscopic points fill.
    pub(super) fn points(motion: Motion, dimension: f64) -> Self {
        let (shows, agrees) = match motion {
            Motion::Quasiperiodic if dimension < 1.5 => (Observation::ClosedCurves(dimension), Some(true)),
            Motion::Quasiperiodic => (Observation::Surface(dimension), Some(true)),
            _ => (Observation::Scattered(dimension), None),
        };
        Self { shows, agrees }
    }

    /// Where starts that differ by rounding lead, and how many of them.
    pub(super) fn beside(ends: &[(Signature, usize)]) -> Self {
        let end = |(signature, count): &(Signature, usize)| {
            let Cell { motion, measures } = signature.cell;
            End { count: *count, motion, v_rms: signature.cell.lasts().then_some(measures.v_rms) }
        };
        Self { shows: Observation::Beside(ends.iter().map(end).collect()), agrees: None }
    }

    /// The 0-1 test.
    pub(super) fn zero_one(motion: Motion, found: f64) -> Self {
        let agrees = match motion {
            Motion::Quasiperiodic => Some(found < 0.5),
            Motion::Chaotic => Some(found > 0.5),
            _ => None,
        };
        Self { shows: Observation::ZeroOne(found), agrees }
    }

    /// The exponent, which must be that of the multipliers on a periodic motion.
    pub(super) fn exponent(motion: Motion, exponent: &Exponent, orbit: Option<&Orbit>, period: f64) -> Self {
        let mut by_multipliers = None;
        let agrees = match (motion, exponent.sign()) {
            (_, Sign::Open) => None,
            (Motion::Periodic { .. }, Sign::Negative) => Some(orbit.is_none_or(|orbit| {
                let rate = orbit.largest_multiplier().norm().ln() / (period * orbit.periods as f64);
                by_multipliers = Some(rate);
                exponent.fits(orbit, period)
            })),
            // So weakly stable that the record cannot tell it from neutral.
            (Motion::Periodic { .. }, Sign::Zero) => None,
            (Motion::Periodic { .. }, Sign::Positive) => Some(false),
            (Motion::Quasiperiodic, sign) => Some(sign == Sign::Zero),
            (Motion::Chaotic, sign) => Some(sign == Sign::Positive),
            _ => None,
        };
        Self { shows: Observation::Exponent { found: *exponent, by_multipliers }, agrees }
    }

    /// The spectrum: its strongest peaks, and whether they are those of the class.
    pub(super) fn spectrum(motion: Motion, found: &VoltageSpectrum) -> Self {
        let VoltageSpectrum { peaks, basic, share, .. } = found;
        let regular = *share >= LINES;
        let agrees = match motion {
            // A voltage that stays zero says nothing.
            _ if peaks.is_empty() => None,
            Motion::Periodic { .. } => Some(regular),
            Motion::Quasiperiodic => Some(regular && basic.is_some()),
            Motion::Chaotic if !regular => Some(true),
            _ => None,
        };
        let peaks = peaks.iter().take(NAMED).copied().collect();
        Self { shows: Observation::Spectrum { peaks, basic: *basic, share: *share }, agrees }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn reached(motion: Motion, recurrence: Recurrence, distance: Option<f64>) -> Reached {
        Reached {
            motion,
            measures: None,
            state: vec![0.0; 5],
            time: 600.0,
            orbit: None,
            distance,
            exponent: None,
            recurrence: Some(recurrence),
            rotation: None,
            zero_one: None,
            longer: None,
            states: Vec::new(),
            tips: Vec::new(),
            notes: Vec::new(),
        }
    }

    fn exponent(value: f64, half_width: f64) -> Exponent {
        Exponent {
            value,
            half_width,
            second: -1.0,
            second_half_width: 1e-3,
            periods: 1000,
            duration: 300.0,
            converged: true,
        }
    }

    #[test]
    fn recurrence_agrees_with_multiples_and_contradicts_other_periods() {
        let says = |motion, period, defect: f64, distance| {
            let found = Recurrence { period, defect, settled: defect < 1e-4 };
            Evidence::recurrence(&reached(motion, found, distance)).and_then(|evidence| evidence.agrees)
        };
        let two = Motion::Periodic { periods: 2 };
        assert_eq!(says(two, Some(2), 1e-6, None), Some(true));
        assert_eq!(says(two, Some(6), 1e-6, None), Some(true));
        assert_eq!(says(two, Some(1), 1e-6, None), Some(false));
        // Still settling, it may look like another period, or like none.
        assert_eq!(says(two, Some(3), 1e-2, Some(1e-2)), None);
        assert_eq!(says(two, None, 0.1, Some(1e-2)), None);
        // Arrived there, the points must repeat.
        assert_eq!(says(two, None, 0.1, Some(1e-6)), Some(false));
        assert_eq!(says(Motion::Chaotic, Some(3), 1e-6, None), Some(false));
        assert_eq!(says(Motion::Quasiperiodic, None, 0.5, None), Some(true));
    }

    #[test]
    fn an_exponent_of_the_wrong_sign_contradicts() {
        let says = |motion, value| Evidence::exponent(motion, &exponent(value, 1e-3), None, 0.25).agrees;
        let one = Motion::Periodic { periods: 1 };
        assert_eq!((says(one, -0.01), says(one, 0.01)), (Some(true), Some(false)));
        assert_eq!((says(Motion::Chaotic, 0.3), says(Motion::Chaotic, -0.3)), (Some(true), Some(false)));
        assert_eq!(
            (says(Motion::Quasiperiodic, 0.0), says(Motion::Quasiperiodic, 0.3)),
            (Some(true), Some(false))
        );
        // One that says nothing supports nothing.
        assert_eq!(Evidence::exponent(one, &exponent(0.0, 0.5), None, 0.25).agrees, None);
    }
}
