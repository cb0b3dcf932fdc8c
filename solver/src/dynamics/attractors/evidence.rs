//! What the verdict on a motion rests on: each way of looking at it, what it says, and whether it agrees with the class.

use serde::{Deserialize, Serialize};

use super::lyapunov::{Exponent, Sign};
use super::motion::{Cell, Motion, Reached};
use super::rotation::Rotation;
use super::signature::Signature;
use super::voltage_spectrum::VoltageSpectrum;
use crate::dynamics::orbits::Orbit;
use crate::number::in_sentence;

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

/// One piece of evidence.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, nanoserde::SerBin, nanoserde::DeBin)]
pub struct Evidence {
    /// Where it comes from.
    pub source: EvidenceSource,
    /// What it says, one line.
    pub says: String,
    /// Whether it agrees with the class; `None` when it neither supports nor contradicts it.
    pub agrees: Option<bool>,
}

impl Evidence {
    fn new(source: EvidenceSource, agrees: Option<bool>, says: String) -> Self {
        Self { source, says, agrees }
    }

    /// A run that ended.
    pub(super) fn run(motion: Motion) -> Self {
        Self::new(EvidenceSource::Run, Some(true), format!("run: {motion}"))
    }

    /// The multipliers of the periodic motion reached.
    pub(super) fn multipliers(orbit: &Orbit, distance: f64) -> Self {
        let says = format!(
            "multipliers: period {} {}, largest modulus {:.6}; the run ends {} of the amplitude from it",
            orbit.periods,
            if orbit.stable() { "stable" } else { "unstable" },
            orbit.largest_multiplier().norm(),
            in_sentence(distance),
        );
        Self::new(EvidenceSource::Multipliers, Some(orbit.stable()), says)
    }

    /// Whether the stroboscopic points repeat.
    ///
    /// Points that repeat after p periods repeat after multiples of p too, and while they settle a multiple may look
    /// better; so any multiple agrees with period p.
    pub(super) fn recurrence(reached: &Reached) -> Option<Self> {
        let found = reached.recurrence?;
        let to = in_sentence(found.defect);
        let mut says = match (found.period, found.settled) {
            (Some(period), true) => format!("stroboscopic points repeat after {} to {to}", periods(period)),
            (Some(period), false) => {
                format!("stroboscopic points repeat after {} to {to}, still settling", periods(period))
            }
            (None, _) => format!("stroboscopic points do not repeat within 8 periods (off by {to})"),
        };
        if let (Motion::Periodic { periods }, Some(period)) = (reached.motion, found.period)
            && period > periods
            && period.is_multiple_of(periods)
        {
            says.push_str(&format!(": a multiple of {periods}, as they spiral in"));
        }
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
        Some(Self::new(EvidenceSource::Recurrence, agrees, says))
    }

    /// The set that the stroboscopic points fill.
    pub(super) fn points(motion: Motion, dimension: f64) -> Self {
        let (shape, agrees) = match motion {
            Motion::Quasiperiodic if dimension < 1.5 => ("lie on closed curves", Some(true)),
            Motion::Quasiperiodic => ("fill a surface", Some(true)),
            _ => ("are scattered", None),
        };
        Self::new(
            EvidenceSource::Points,
            agrees,
            format!("stroboscopic points {shape}: dimension {dimension:.2}"),
        )
    }

    /// Where starts that differ by rounding lead, and how many of them.
    pub(super) fn beside(ends: &[(Signature, usize)]) -> Self {
        let end = |(signature, count): &(Signature, usize)| {
            let Cell { motion, v_rms, .. } = signature.cell;
            let volts = if signature.cell.lasts() {
                format!(", {} V rms", in_sentence(v_rms))
            } else {
                String::new()
            };
            format!("{count} × {motion}{volts}")
        };
        let all: Vec<String> = ends.iter().map(end).collect();
        Self::new(EvidenceSource::Beside, None, format!("starts that differ by rounding: {}", all.join("; ")))
    }

    /// The rotation number of a torus.
    pub(super) fn rotation(rotation: Rotation) -> Self {
        let Rotation { number, error } = rotation;
        let says =
            format!("rotation number {number:.9}, the halves of the record differ by {}", in_sentence(error));
        Self::new(EvidenceSource::Rotation, Some(true), says)
    }

    /// The 0-1 test.
    pub(super) fn zero_one(motion: Motion, found: f64) -> Self {
        let agrees = match motion {
            Motion::Quasiperiodic => Some(found < 0.5),
            Motion::Chaotic => Some(found > 0.5),
            _ => None,
        };
        Self::new(EvidenceSource::ZeroOne, agrees, format!("0-1 test {found:.2}: 0 is regular, 1 chaotic"))
    }

    /// The exponent, which must be that of the multipliers on a periodic motion.
    pub(super) fn exponent(motion: Motion, exponent: &Exponent, orbit: Option<&Orbit>, period: f64) -> Self {
        let sign = exponent.sign();
        let mut says =
            format!("exponent {} ± {}", in_sentence(exponent.value), in_sentence(exponent.half_width));
        if sign == Sign::Zero {
            says.push_str(": zero");
        } else if !exponent.converged {
            says.push_str(", not converged");
        }
        let agrees = match (motion, sign) {
            (_, Sign::Open) => None,
            (Motion::Periodic { .. }, Sign::Negative) => Some(orbit.is_none_or(|orbit| {
                let expected = orbit.largest_multiplier().norm().ln() / (period * orbit.periods as f64);
                says.push_str(&format!("; by the multipliers {}", in_sentence(expected)));
                exponent.fits(orbit, period)
            })),
            // So weakly stable that the record cannot tell it from neutral.
            (Motion::Periodic { .. }, Sign::Zero) => None,
            (Motion::Periodic { .. }, Sign::Positive) => Some(false),
            (Motion::Quasiperiodic, sign) => Some(sign == Sign::Zero),
            (Motion::Chaotic, sign) => Some(sign == Sign::Positive),
            _ => None,
        };
        Self::new(EvidenceSource::Exponent, agrees, says)
    }

    /// The spectrum: its strongest peaks, and whether they are those of the class.
    pub(super) fn spectrum(motion: Motion, found: &VoltageSpectrum) -> Self {
        let mut parts: Vec<String> = found
            .peaks
            .iter()
            .take(NAMED)
            .map(|peak| {
                let name = peak.label.map_or_else(|| format!("{:.4}", peak.omega), |label| label.to_string());
                format!("{name} at {} V", in_sentence(peak.amplitude))
            })
            .collect();
        if let Some(basic) = found.basic {
            parts.push(format!("ν = {basic:.5}"));
        }
        let regular = found.share >= LINES;
        if !regular {
            parts.push(format!(
                "{} % of its power between the lines",
                in_sentence(100.0 * (1.0 - found.share))
            ));
        }
        // A voltage that stays zero says nothing.
        let silent = found.peaks.is_empty();
        let agrees = match motion {
            _ if silent => None,
            Motion::Periodic { .. } => Some(regular),
            Motion::Quasiperiodic => Some(regular && found.basic.is_some()),
            Motion::Chaotic if !regular => Some(true),
            _ => None,
        };
        let says = if silent { "no voltage".to_owned() } else { parts.join(", ") };
        Self::new(EvidenceSource::Spectrum, agrees, format!("spectrum: {says}"))
    }
}

fn periods(count: usize) -> String {
    if count == 1 { "1 period".to_owned() } else { format!("{count} periods") }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dynamics::attractors::poincare::Recurrence;

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
