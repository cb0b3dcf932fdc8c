//! Gaussian noise of a given spectrum.
//!
//! The noise repeats after its duration T: it is the sum of a sine at every multiple of 1/T in the band, whose amplitude has the
//! Rayleigh distribution with the mean square 2 S/T and whose phase is uniform; so every value is Gaussian, and the spectrum S
//! is met in the mean over the realisations.
//!
//! Reference: Shinozuka & Deodatis, "Simulation of stochastic processes by spectral representation", Appl. Mech. Rev. 44, 191
//! (1991); with random amplitudes it is Gaussian for any number of sines.

use std::f64::consts::TAU;

use nanoserde::{DeBin, SerBin};
use serde::{Deserialize, Serialize};

use super::{ACCELERATIONS, FREQUENCIES, Signal, samples};
use crate::fourier::{self, Complex, Direction};
use crate::model::ModelError;

/// Samples of a period at the highest frequency: between them 2e-5 of its amplitude is lost, which is part of what this noise is.
const PER_PERIOD: f64 = 16.0;
/// Most points of a spectrum.
const MOST_POINTS: usize = 1000;

/// Noise, flat between two frequencies or with a spectrum given by points.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, SerBin, DeBin)]
#[serde(default, deny_unknown_fields)]
pub struct Noise {
    /// Lowest frequency (Hz).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub from: Option<f64>,
    /// Highest frequency (Hz).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub to: Option<f64>,
    /// Root mean square of the acceleration (g), expected over the realisations.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rms: Option<f64>,
    /// Instead of these three: points (Hz, g^2/Hz) of the one-sided spectral density, between which its logarithm is linear in
    /// that of the frequency, as vibration is specified.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub spectrum: Option<Vec<(f64, f64)>>,
    /// How long it lasts (s).
    pub duration: f64,
    /// Which noise of this spectrum.
    pub seed: u64,
}

/// A one-sided spectral density over a band.
enum Density<'a> {
    Flat { band: (f64, f64), value: f64 },
    Points(&'a [(f64, f64)]),
}

impl Density<'_> {
    fn band(&self) -> (f64, f64) {
        match self {
            Self::Flat { band, .. } => *band,
            Self::Points(points) => (points[0].0, points[points.len() - 1].0),
        }
    }

    /// g^2/Hz at a frequency (Hz) in the band.
    fn at(&self, frequency: f64) -> f64 {
        match self {
            Self::Flat { value, .. } => *value,
            Self::Points(points) => {
                let next = points.partition_point(|point| point.0 < frequency).clamp(1, points.len() - 1);
                let ((low, a), (high, b)) = (points[next - 1], points[next]);
                let part = (frequency / low).ln() / (high / low).ln();
                a * (b / a).powf(part)
            }
        }
    }
}

impl Noise {
    /// The acceleration over time (s, g) in one of its realisations, counted from 0.
    ///
    /// # Errors
    /// [`ModelError`], naming what is missing or out of range.
    pub fn signal(&self, realisation: u64) -> Result<Signal, ModelError> {
        let density = self.density()?;
        let (lowest, highest) = density.band();
        let count = samples(self.duration, PER_PERIOD * highest)?;
        let spacing = 1.0 / self.duration;
        let lines = ((lowest / spacing).ceil().max(1.0) as usize)..=((highest / spacing).floor() as usize);
        if lines.is_empty() {
            // Not one sine of the noise falls into the band.
            let least = 1.0 / (highest - lowest);
            return Err(ModelError::check("duration", self.duration, (least, super::DURATIONS.1), " s")
                .err()
                .unwrap_or(ModelError::Count {
                    field: "lines of the noise in its band",
                    value: 0,
                    minimum: 1,
                    maximum: count,
                }));
        }
        let mut random = fastrand::Rng::with_seed(self.seed.wrapping_add(realisation.wrapping_mul(ODD)));
        let mut spectrum = vec![Complex::new(0.0, 0.0); count];
        for line in lines {
            let frequency = line as f64 * spacing;
            let size = (-2.0 * density.at(frequency) * spacing * (1.0 - random.f64()).ln()).sqrt();
            spectrum[line] = Complex::from_polar(size, TAU * random.f64());
        }
        fourier::transform(count, Direction::Inverse).process(&mut spectrum);
        let mut values: Vec<f64> = spectrum.iter().map(|value| value.re).collect();
        values.push(values[0]);
        Signal::new(self.duration / count as f64, values)
    }

    /// The spectral density that it has.
    fn density(&self) -> Result<Density<'_>, ModelError> {
        if let Some(points) = &self.spectrum {
            let (field, value) = ("points of spectrum", points.len());
            if !(2..=MOST_POINTS).contains(&value) {
                return Err(ModelError::Count { field, value, minimum: 2, maximum: MOST_POINTS });
            }
            let mut lowest = FREQUENCIES.0;
            for (i, (frequency, value)) in points.iter().enumerate() {
                ModelError::check(&format!("spectrum[{i}][0]"), *frequency, (lowest, FREQUENCIES.1), " Hz")?;
                ModelError::check(&format!("spectrum[{i}][1]"), *value, (1e-300, 1e12), " g^2/Hz")?;
                lowest = frequency * (1.0 + 1e-9);
            }
            return Ok(Density::Points(points));
        }
        let missing = f64::NAN;
        let from = ModelError::check("from", self.from.unwrap_or(missing), (0.0, FREQUENCIES.1), " Hz")?;
        let least = (1.0 + 1e-9) * from.max(FREQUENCIES.0);
        let to = ModelError::check("to", self.to.unwrap_or(missing), (least, FREQUENCIES.1), " Hz")?;
        let rms = ModelError::check("rms", self.rms.unwrap_or(missing), ACCELERATIONS, " g")?;
        Ok(Density::Flat { band: (from, to), value: rms * rms / (to - from) })
    }
}

/// Keeps the seeds of neighbouring realisations apart.
const ODD: u64 = 0x9E37_79B9_7F4A_7C15;

#[cfg(test)]
mod tests {
    use super::*;

    fn flat(seed: u64) -> Noise {
        let (from, to, rms) = (Some(5.0), Some(50.0), Some(0.3));
        Noise { from, to, rms, duration: 40.0, seed, ..Noise::default() }
    }

    #[test]
    fn it_has_its_root_mean_square_in_its_band_alone() -> Result<(), ModelError> {
        // 1,801 lines: the mean square of one realisation scatters by 1/sqrt(1801) = 2.4 %.
        let (count, mut mean) = (40, 0.0);
        for realisation in 0..count {
            let signal = flat(7).signal(realisation)?;
            mean += signal.rms().powi(2) / count as f64;
            assert!((signal.rms() / 0.3 - 1.0).abs() < 0.06, "{}", signal.rms());
            assert_eq!(signal.samples().first(), signal.samples().last());
        }
        assert!((mean / 0.09 - 1.0).abs() < 3.0 * 0.024 / (count as f64).sqrt(), "{mean}");
        // Below and above its band there is nothing.
        let signal = flat(7).signal(0)?;
        for line in [40.0, 2100.0] {
            let turn = |i: usize, a: &f64| Complex::from_polar(*a, TAU * line * i as f64 / 32_000.0);
            let sum: Complex<f64> =
                signal.samples()[..32_000].iter().enumerate().map(|(i, a)| turn(i, a)).sum();
            assert!(sum.norm() < 1e-8 * 32_000.0, "{line}: {sum}");
        }
        Ok(())
    }

    #[test]
    fn values_are_gaussian() -> Result<(), ModelError> {
        // Within one and two standard deviations lie 68.27 and 95.45 % of the values.
        let (mut values, sigma) = (Vec::new(), 0.3);
        for realisation in 0..40 {
            values.extend_from_slice(flat(3).signal(realisation)?.samples());
        }
        for (width, expected) in [(1.0, 0.6827), (2.0, 0.9545)] {
            let within = values.iter().filter(|value| value.abs() < width * sigma).count();
            let share = within as f64 / values.len() as f64;
            assert!((share - expected).abs() < 0.006, "{width}: {share}");
        }
        Ok(())
    }

    #[test]
    fn a_spectrum_by_points_is_met_in_the_mean() -> Result<(), ModelError> {
        // From 1e-3 g^2/Hz at 10 Hz to 1e-1 at 100 Hz, a power of 2: the integral of 1e-5 f^2 is 3.33.
        let spectrum = Some(vec![(10.0, 1e-3), (100.0, 1e-1)]);
        let noise = Noise { spectrum, duration: 20.0, ..Noise::default() };
        let squares: Result<Vec<f64>, _> =
            (0..50).map(|i| noise.signal(i).map(|signal| signal.rms().powi(2))).collect();
        let squares = squares?;
        let mean = squares.iter().sum::<f64>() / 50.0;
        let spread = (squares.iter().map(|s| (s - mean).powi(2)).sum::<f64>() / 49.0 / 50.0).sqrt();
        assert!((mean - 3.33).abs() < 3.0 * spread, "{mean} {spread}");
        Ok(())
    }

    #[test]
    fn the_same_seed_is_the_same_noise_and_another_is_not() -> Result<(), ModelError> {
        assert_eq!(flat(1).signal(4)?, flat(1).signal(4)?);
        assert_ne!(flat(1).signal(4)?, flat(1).signal(5)?);
        assert_ne!(flat(1).signal(4)?, flat(2).signal(4)?);
        Ok(())
    }

    #[test]
    fn what_is_missing_or_wrong_is_named() {
        let refused = |noise: Noise| noise.signal(0).expect_err("a refusal").to_string();
        assert!(refused(Noise { to: None, ..flat(0) }).starts_with("to is not a finite number"));
        assert!(refused(Noise { to: Some(4.0), ..flat(0) }).starts_with("to = 4 is out of range"));
        assert!(refused(Noise { duration: 0.01, ..flat(0) }).starts_with("duration = 0.01"));
        let spectrum = Some(vec![(10.0, 1e-3), (5.0, 1e-3)]);
        assert!(refused(Noise { spectrum, ..flat(0) }).starts_with("spectrum[1][0] = 5"));
    }
}
