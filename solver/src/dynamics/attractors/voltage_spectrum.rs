//! The spectrum of the voltage along a motion, its lines named.

use serde::{Deserialize, Serialize};

use super::motion::Motion;
use super::spectral_label::{Frequencies, Label};
use super::spectrum::{SpectralLine, Spectrum, SpectrumError};
use crate::dynamics::integration::{IntegrationError, Outcome, Settings, Trajectory};
use crate::model::ReducedSystem;
use crate::sentence::{Say, Sentence, said};
use crate::theory::spectrum::eigenvalues;

/// Periods of a record: multiples of all periods up to eight where there is room, so that subharmonics fall on bins.
const PERIODS: [usize; 7] = [840, 420, 210, 120, 60, 24, 12];
/// Samples of a record at most.
const MOST_SAMPLES: usize = 1 << 15;
/// Sampling frequency over the higher of the excitation's and the second own frequency.
const OVERSAMPLING: f64 = 8.0;
/// Amplitude, relative to the largest, from which a line is a peak.
const THRESHOLD: f64 = 1e-3;
/// Most peaks that are named.
const MOST_PEAKS: usize = 12;
/// Highest multiple of omega and of nu among the frequencies of a torus.
const TORUS_ORDER: i32 = 8;
/// Denominators tried when the period is not known.
const DENOMINATORS: u32 = 8;

/// A line of the voltage's spectrum.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, nanoserde::SerBin, nanoserde::DeBin)]
pub struct Peak {
    /// Angular frequency (dimensionless).
    pub omega: f64,
    /// Amplitude (V).
    pub amplitude: f64,
    /// What it is: on a torus in terms of its basic frequencies, which is exact.
    pub label: Option<Label>,
    /// On a torus, the combination of the linear own frequencies that it is near.
    pub near: Option<Label>,
}

/// The voltage's spectrum along a motion.
#[derive(Debug, Clone, PartialEq)]
pub struct VoltageSpectrum {
    /// Its amplitudes (V).
    pub spectrum: Spectrum,
    /// The strongest lines.
    pub peaks: Vec<Peak>,
    /// On a torus, the second basic frequency (dimensionless); the first is omega.
    pub basic: Option<f64>,
    /// Share of the mean square in the lines that the motion's class allows: multiples of omega / m for a period of m,
    /// combinations of omega and nu for a torus. For other classes, the larger of the shares in multiples of
    /// omega / n with n up to 8 and in the combinations with the best nu.
    pub share: f64,
}

impl VoltageSpectrum {
    /// The spectrum along the motion of `system` from `state` (length 2N + 1) at a stroboscopic instant, read as that
    /// of a motion of the class `motion`.
    ///
    /// Modes above the second alias when they vibrate at more than four times the higher of omega and the second own
    /// frequency.
    ///
    /// # Errors
    /// [`VoltageSpectrumError::Ended`] when the motion ends within the record, and those of [`Trajectory::compute`].
    pub fn of(system: &ReducedSystem, state: &[f64], motion: Motion) -> Result<Self, VoltageSpectrumError> {
        let omega = system.parameters.omega;
        let period = system.parameters.period();
        let own: Vec<f64> =
            eigenvalues(system).map_or_else(|_| Vec::new(), |all| all.iter().map(|value| value.im).collect());
        let own: Vec<f64> = own.into_iter().filter(|frequency| *frequency > 0.0).take(2).collect();
        let highest = own.iter().copied().fold(omega, f64::max);
        let samples = 2 * (0.5 * OVERSAMPLING * highest / omega).ceil() as usize;
        let fits = |periods: &&usize| **periods * samples <= MOST_SAMPLES;
        let periods = PERIODS.iter().find(fits).copied().unwrap_or(PERIODS[PERIODS.len() - 1]);
        let record = Trajectory::compute(system, state, periods as f64 * period, Settings::default())?;
        if record.outcome != Outcome::Completed {
            return Err(VoltageSpectrumError::Ended { outcome: record.outcome });
        }
        let interval = period / samples as f64;
        let times: Vec<f64> = (0..periods * samples).map(|i| i as f64 * interval).collect();
        let mut voltage = Vec::with_capacity(times.len());
        record.read_at(&times, |_, state| voltage.push(state[state.len() - 1]));
        let spectrum = Spectrum::new(&voltage, interval)?;
        let largest_denominator = match motion {
            Motion::Periodic { periods } => periods as u32,
            _ => DENOMINATORS,
        };
        let frequencies =
            Frequencies { excitation: omega, own, tolerance: 0.5 * spectrum.spacing, largest_denominator };
        Ok(Self::read(spectrum, &frequencies, motion))
    }

    fn read(spectrum: Spectrum, frequencies: &Frequencies, motion: Motion) -> Self {
        let lines = spectrum.lines(THRESHOLD);
        let top = spectrum.spacing * spectrum.amplitudes.len() as f64;
        let multiples = |n: u32| {
            let unit = frequencies.excitation / f64::from(n);
            let count = (top / unit) as u32;
            let all: Vec<f64> = (1..=count).map(|m| f64::from(m) * unit).collect();
            spectrum.share_of(&all)
        };
        let denominator = match motion {
            Motion::Quasiperiodic => frequencies.torus_denominator(&lines),
            _ => 1,
        };
        let unit = frequencies.excitation / f64::from(denominator);
        let combinations = |basic: f64| {
            let order = TORUS_ORDER * denominator as i32;
            let mut all = Vec::new();
            for a in -order..=order {
                all.extend((-TORUS_ORDER..=TORUS_ORDER).map(|b| f64::from(a) * unit + f64::from(b) * basic));
            }
            all.retain(|omega| *omega > 0.0 && *omega < top);
            spectrum.share_of(&all)
        };
        let basic = match motion {
            Motion::Periodic { .. } => None,
            _ => frequencies.basic(&lines, denominator),
        };
        let share = match (motion, basic) {
            (Motion::Periodic { periods }, _) => multiples(periods as u32),
            (Motion::Quasiperiodic, Some(basic)) => combinations(basic),
            (Motion::Quasiperiodic, None) => multiples(1),
            (_, basic) => {
                (1..=DENOMINATORS).map(multiples).chain(basic.map(combinations)).fold(0.0, f64::max)
            }
        };
        let torus = if motion == Motion::Quasiperiodic { basic } else { None };
        let peak = |line: &SpectralLine| {
            let SpectralLine { omega, amplitude } = *line;
            match torus {
                Some(basic) => {
                    let multiple = frequencies.multiple(omega, denominator);
                    let exact = match multiple {
                        Some(_) => frequencies.excitation_label(omega),
                        None => frequencies.torus_label(omega, basic, denominator),
                    };
                    let near = if multiple.is_some() { None } else { frequencies.own_label(omega) };
                    Peak { omega, amplitude, label: exact, near }
                }
                // In a broad spectrum something would be near every combination.
                None if motion == Motion::Chaotic => {
                    Peak { omega, amplitude, label: frequencies.excitation_label(omega), near: None }
                }
                None => Peak { omega, amplitude, label: frequencies.label(omega), near: None },
            }
        };
        let peaks = lines.iter().take(MOST_PEAKS).map(peak).collect();
        Self { spectrum, peaks, basic: torus, share }
    }
}

/// Why there is no spectrum of a motion.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("{}", self.say())]
pub enum VoltageSpectrumError {
    /// The motion cannot be integrated.
    Integration(#[from] IntegrationError),
    /// The motion escaped or touched before the record was complete.
    Ended {
        /// How, its time counted from the start of the record.
        outcome: Outcome,
    },
    /// The samples have no spectrum.
    Spectrum(#[from] SpectrumError),
}

impl Say for VoltageSpectrumError {
    fn say(&self) -> Sentence {
        match self {
            Self::Integration(error) => error.say(),
            Self::Ended { .. } => said("the motion ends within the record of the spectrum", &[]),
            // Asked for by ourselves, always with what it takes.
            Self::Spectrum(error) => Sentence::Verbatim(error.to_string()),
        }
    }
}
