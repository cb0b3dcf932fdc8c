//! Everything about the motion of one scenario that takes longer than a frame: the verdict, and what it rests on in a
//! form that can be drawn.

use crate::dynamics::attractors::verdict::VerdictError;
use crate::dynamics::{Inquiry, Orbit, Verdict};
use crate::model::ReducedSystem;
use crate::scenario::Scenario;
use crate::scheduler::{Failure, Piece};

/// Points of a spectrum that is drawn.
const SPECTRUM_POINTS: usize = 1200;
/// It is drawn up to this multiple of the highest named line.
const BEYOND_PEAKS: f64 = 1.3;

/// A periodic motion by its multipliers.
#[derive(Debug, Clone, PartialEq, nanoserde::SerBin, nanoserde::DeBin)]
pub struct Multipliers {
    /// Its period in excitation periods.
    pub periods: usize,
    /// Real and imaginary part of each, over that period, by descending modulus.
    pub values: Vec<[f64; 2]>,
}

impl From<&Orbit> for Multipliers {
    fn from(orbit: &Orbit) -> Self {
        let values = orbit.multipliers.iter().map(|mu| [mu.re, mu.im]).collect();
        Self { periods: orbit.periods, values }
    }
}

/// The verdict and its evidence.
#[derive(Debug, Clone, PartialEq, nanoserde::SerBin, nanoserde::DeBin)]
pub struct Inspection {
    /// The verdict.
    pub verdict: Verdict,
    /// Multipliers of the forced motion, where there is one.
    pub forced: Option<Multipliers>,
    /// Multipliers of the motion reached, where it is periodic.
    pub reached: Option<Multipliers>,
    /// Angular frequency (dimensionless) and amplitude (V) of the voltage's spectrum, its largest values where there
    /// are more than can be drawn.
    pub spectrum: Vec<[f64; 2]>,
}

/// The verdict on the motion that a scenario leads to.
#[derive(Debug, Clone, PartialEq, nanoserde::SerBin, nanoserde::DeBin)]
pub struct Inspect {
    /// Everything about it.
    pub scenario: Scenario,
}

impl Piece for Inspect {
    const NAME: &'static str = "verdict";
    type Found = Inspection;

    fn carry_out(&self) -> Result<Inspection, Failure> {
        inspect(&self.scenario)
    }
}

/// Inspects the motion that `scenario` leads to.
///
/// # Errors
/// What is out of range, or why there is no verdict.
pub fn inspect(scenario: &Scenario) -> Result<Inspection, Failure> {
    let (system, initial) = scenario.validate()?;
    Ok(Inspection::of(&system, &initial, scenario.t_end)?)
}

impl Inspection {
    /// Of the start of `system` in `initial` (length 2N + 1), shown until `t_end`.
    ///
    /// # Errors
    /// [`VerdictError`].
    pub(super) fn of(system: &ReducedSystem, initial: &[f64], t_end: f64) -> Result<Self, VerdictError> {
        let Inquiry { verdict, reached, spectrum, forced } = Inquiry::new(system, initial, t_end)?;
        let highest = verdict.peaks.iter().map(|peak| peak.omega).fold(system.parameters.omega, f64::max);
        let spectrum = spectrum.map_or_else(Vec::new, |found| {
            drawn(&found.spectrum.amplitudes, found.spectrum.spacing, BEYOND_PEAKS * highest)
        });
        Ok(Self {
            forced: forced.and_then(|forced| forced.orbit).as_ref().map(Multipliers::from),
            reached: reached.orbit.as_ref().map(Multipliers::from),
            spectrum,
            verdict,
        })
    }
}

/// The spectrum up to a frequency, the largest value of each stretch of bins.
fn drawn(amplitudes: &[f64], spacing: f64, top: f64) -> Vec<[f64; 2]> {
    let count = ((top / spacing).ceil() as usize).clamp(1, amplitudes.len());
    let bins = count.div_ceil(SPECTRUM_POINTS);
    let largest = |(k, stretch): (usize, &[f64])| {
        let (place, value) = stretch
            .iter()
            .enumerate()
            .fold((0, 0.0), |best, (i, a)| if *a > best.1 { (i, *a) } else { best });
        [(k * bins + place) as f64 * spacing, value]
    };
    amplitudes[..count].chunks(bins).enumerate().map(largest).collect()
}

#[cfg(test)]
mod tests {
    use nanoserde::{DeBin as _, SerBin as _};

    use super::*;
    use crate::dynamics::attractors::motion::Motion;
    use crate::model::ParameterSet;

    #[test]
    fn an_inspection_survives_the_way_between_workers() {
        let parameters = ParameterSet { alpha: 1e-4, beta: 1e-2, omega: 8.0969, ..Default::default() };
        let found = inspect(&Scenario { parameters, ..Default::default() }).expect("Figure 9");
        assert_eq!(found.verdict.motion, Motion::Periodic { periods: 2 });
        assert_eq!(Inspection::deserialize_bin(&found.serialize_bin()).expect("the same"), found);
        // The forced motion's multiplier of an independent program, and the line at half the excitation frequency.
        let forced = found.forced.expect("a forced motion");
        assert!((forced.values[0][0] + 1.148382).abs() < 1e-6, "{:?}", forced.values[0]);
        let highest = found.spectrum.iter().max_by(|a, b| a[1].total_cmp(&b[1])).expect("a line");
        assert!((highest[0] - 0.5 * 8.0969).abs() < 0.02, "{highest:?}");
    }
}
