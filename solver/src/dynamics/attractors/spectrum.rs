//! The amplitude spectrum of a sampled signal and its lines.
//!
//! The window is Hann's. Of the common windows its main lobe is the narrowest (four bins) whose side lobes fall with
//! the cube of the distance, so that the neighbouring lines of a slow modulation stay apart; and between the two
//! highest bins of a line its shape is known in closed form, which gives frequency and amplitude of a steady line
//! exactly. A flat-top window would give amplitudes without that interpolation, but merges lines within ten bins.
//!
//! Two lines closer than [`Spectrum::resolution`] merge, and a line that grows, decays or wanders within the record is
//! spread over several bins: its amplitude is then too small, which [`Spectrum::share_of`] shows.
//!
//! Reference: Grandke, "Interpolation algorithms for discrete Fourier transforms of weighted signals", IEEE
//! Transactions on Instrumentation and Measurement 32, 1983, 350-355.

use std::f64::consts::{PI, TAU};

use serde::{Deserialize, Serialize};
use thiserror::Error;

use crate::fourier::{self, Complex, Direction};

/// Fewest samples of a spectrum.
pub const LEAST_SAMPLES: usize = 32;
/// Most samples: about half a second of work.
pub const MOST_SAMPLES: usize = 1 << 20;
/// How many times a line must exceed what stronger ones leak into its bin.
const ABOVE_LEAKAGE: f64 = 3.0;
/// Mean square of the Hann window over the square of its mean: what noise gains.
const NOISE_GAIN: f64 = 1.5;

/// Why there is no spectrum.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum SpectrumError {
    /// Too few or too many samples.
    #[error("a spectrum needs {LEAST_SAMPLES} to {MOST_SAMPLES} samples, got {got}")]
    Samples {
        /// How many there are.
        got: usize,
    },
    /// The sampling interval is not positive, or a sample is not finite.
    #[error("a spectrum needs finite samples at a positive interval")]
    NotFinite,
}

/// A line of a spectrum.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, nanoserde::SerBin, nanoserde::DeBin)]
pub struct SpectralLine {
    /// Angular frequency (dimensionless).
    pub omega: f64,
    /// Amplitude: of a sin(omega t) it is a (in the unit of the signal).
    pub amplitude: f64,
}

/// The one-sided amplitude spectrum of a real signal.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Spectrum {
    /// Distance of the bins in angular frequency (dimensionless); bin k is at k times this.
    pub spacing: f64,
    /// Amplitude at each bin, up to half the sampling frequency, the mean left out (in the unit of the signal).
    pub amplitudes: Vec<f64>,
    /// Weighted mean of the signal.
    pub mean: f64,
    /// Weighted mean square of the signal about its mean.
    pub mean_square: f64,
    /// The same by the sum over the bins (Parseval's theorem): the mean square of the windowed signal over the window's
    /// own. It is [`Self::mean_square`] for a steady signal.
    pub power: f64,
}

impl Spectrum {
    /// The spectrum of `samples` taken every `interval` (dimensionless time).
    ///
    /// # Errors
    /// [`SpectrumError::Samples`], [`SpectrumError::NotFinite`].
    pub fn new(samples: &[f64], interval: f64) -> Result<Self, SpectrumError> {
        let count = samples.len();
        if !(LEAST_SAMPLES..=MOST_SAMPLES).contains(&count) {
            return Err(SpectrumError::Samples { got: count });
        }
        if !(interval > 0.0 && interval.is_finite() && samples.iter().all(|value| value.is_finite())) {
            return Err(SpectrumError::NotFinite);
        }
        let window = |n: usize| 0.5 * (1.0 - (TAU * n as f64 / count as f64).cos());
        // The window's mean is 1/2 exactly.
        let weighted = |value: &dyn Fn(f64) -> f64| {
            samples.iter().enumerate().map(|(n, x)| window(n) * value(*x)).sum::<f64>() / (0.5 * count as f64)
        };
        let mean = weighted(&|x| x);
        let mean_square = weighted(&|x| (x - mean) * (x - mean));
        let windowed = samples.iter().enumerate().map(|(n, x)| Complex::from(window(n) * (x - mean)));
        let mut transformed: Vec<Complex<f64>> = windowed.collect();
        fourier::transform(count, Direction::Forward).process(&mut transformed);
        let scale = 2.0 / (0.5 * count as f64);
        let last = count / 2;
        // Zero and half the sampling frequency are their own mirror images, all others stand for two.
        let alone = |k: usize| k == 0 || (k == last && count.is_multiple_of(2));
        let amplitude = |k: usize, size: f64| if alone(k) { 0.5 * scale * size } else { scale * size };
        let amplitudes: Vec<f64> =
            transformed.iter().take(last + 1).enumerate().map(|(k, x)| amplitude(k, x.norm())).collect();
        let square = |k: usize, a: f64| if alone(k) { a * a } else { 0.5 * a * a };
        let power = amplitudes.iter().enumerate().map(|(k, a)| square(k, *a)).sum::<f64>() / NOISE_GAIN;
        Ok(Self { spacing: TAU / (interval * count as f64), amplitudes, mean, mean_square, power })
    }

    /// Distance in angular frequency at which two lines are told apart: half a main lobe, two bins.
    pub fn resolution(&self) -> f64 {
        2.0 * self.spacing
    }

    /// The lines whose amplitude is at least `threshold` times the largest, by descending amplitude.
    ///
    /// A line is a bin higher than its neighbours and than what stronger lines leak there.
    pub fn lines(&self, threshold: f64) -> Vec<SpectralLine> {
        let a = &self.amplitudes;
        let mut bins: Vec<usize> =
            (1..a.len().saturating_sub(1)).filter(|&k| a[k] > a[k - 1] && a[k] >= a[k + 1]).collect();
        bins.sort_by(|j, k| a[*k].total_cmp(&a[*j]));
        let least = bins.first().map_or(0.0, |k| threshold * a[*k]);
        let mut lines: Vec<SpectralLine> = Vec::new();
        for k in bins.into_iter().take_while(|k| a[*k] >= least && a[*k] > 0.0) {
            let leaked: f64 =
                lines.iter().map(|line| leakage(line, k as f64 * self.spacing, self.spacing)).sum();
            if a[k] > ABOVE_LEAKAGE * leaked {
                lines.push(self.interpolate(k));
            }
        }
        lines.sort_by(|a, b| b.amplitude.total_cmp(&a.amplitude));
        lines
    }

    /// The line at the local maximum `k`.
    fn interpolate(&self, k: usize) -> SpectralLine {
        let a = &self.amplitudes;
        let (neighbour, side) = if a[k + 1] > a[k - 1] { (a[k + 1], 1.0) } else { (a[k - 1], -1.0) };
        let ratio = neighbour / a[k];
        let offset = ((2.0 * ratio - 1.0) / (ratio + 1.0)).clamp(-0.5, 0.5);
        let shape = if offset == 0.0 { 1.0 } else { (PI * offset).sin() / (PI * offset) };
        SpectralLine {
            omega: (k as f64 + side * offset) * self.spacing,
            amplitude: a[k] * (1.0 - offset * offset) / shape,
        }
    }

    /// Share of the mean square that lies within a main lobe of the frequencies `omegas`, 0 to 1.
    ///
    /// Close to 1 when the signal consists of steady lines there. A line at zero frequency and one at half the
    /// sampling frequency do not count.
    pub fn share_of(&self, omegas: &[f64]) -> f64 {
        let mut taken = vec![false; self.amplitudes.len()];
        for omega in omegas {
            let bin = omega / self.spacing;
            let (low, high) = ((bin - 3.0).ceil().max(0.0) as usize, (bin + 3.0).floor().max(0.0) as usize);
            for place in taken.iter_mut().take(high + 1).skip(low) {
                *place = true;
            }
        }
        let all: f64 = self.amplitudes.iter().map(|a| a * a).sum();
        let own: f64 =
            self.amplitudes.iter().zip(&taken).filter(|(_, taken)| **taken).map(|(a, _)| a * a).sum();
        if all > 0.0 { own / all } else { 1.0 }
    }
}

/// Upper bound on what `line` leaks to the frequency `omega`.
fn leakage(line: &SpectralLine, omega: f64, spacing: f64) -> f64 {
    let distance = (line.omega - omega).abs() / spacing;
    if distance <= 1.5 {
        line.amplitude
    } else {
        line.amplitude / (PI * distance * (distance * distance - 1.0))
    }
}
