//! The spectrum of a voltage as it changes over time.

use nanoserde::{DeBin, SerBin};

use crate::dynamics::attractors::spectrum::Spectrum;
use crate::model::base_motion::BaseMotion;
use crate::model::{ReducedSystem, Units};

/// Spectra of a spectrogram, and frequencies of each at most.
const COLUMNS: usize = 120;
const ROWS: usize = 96;
/// How many columns' time each spectrum takes: neighbours overlap.
const OVERLAP: usize = 3;
/// Fewest samples of a spectrum.
const LEAST: usize = 32;

/// Amplitudes (V) over time and frequency.
#[derive(Debug, Clone, PartialEq, SerBin, DeBin)]
pub struct Spectrogram {
    /// How long it is (s).
    pub duration: f64,
    /// Its highest frequency (Hz).
    pub highest: f64,
    /// Number of times.
    pub columns: usize,
    /// Number of frequencies.
    pub rows: usize,
    /// Amplitude (V) at each frequency from 0 and then at each time.
    pub amplitudes: Vec<f32>,
}

impl Spectrogram {
    /// The highest frequency (Hz) worth showing of a device under `motion`: twice what it is shaken with, or past the second
    /// own frequency under a record.
    pub fn highest(motion: &BaseMotion, system: &ReducedSystem, units: &Units) -> f64 {
        let own = |mode: usize| system.modes.iter().nth(mode).map_or(0.0, |mode| units.hertz(mode.omega));
        match motion {
            BaseMotion::Chirp(chirp) => 2.0 * chirp.from.max(chirp.to),
            BaseMotion::Noise(noise) => {
                let points = noise.spectrum.iter().flatten().map(|point| point.0);
                2.0 * points.chain(noise.to).fold(own(0), f64::max)
            }
            BaseMotion::Recorded(_) => 1.5 * own(1).max(2.0 * own(0)),
        }
    }

    /// Of a voltage at samples so far apart (s), up to a frequency (Hz).
    pub fn new(voltages: &[f64], interval: f64, highest: f64) -> Self {
        let columns = COLUMNS.min(voltages.len() / LEAST);
        let mut spectrogram = Self {
            duration: interval * voltages.len() as f64,
            highest: highest.min(0.5 / interval),
            columns,
            rows: 0,
            amplitudes: Vec::new(),
        };
        let hop = voltages.len().checked_div(columns).unwrap_or(0);
        let length = (OVERLAP * hop).max(LEAST).min(voltages.len());
        for column in 0..columns {
            let middle = hop * column + hop / 2;
            let begin = middle.saturating_sub(length / 2).min(voltages.len() - length);
            let Ok(spectrum) = Spectrum::new(&voltages[begin..begin + length], interval) else { break };
            let bins = &spectrum.amplitudes;
            // The spectrum's own frequency unit is 2 pi/s here.
            let bin = spectrum.spacing / std::f64::consts::TAU;
            let shown = ((spectrogram.highest / bin) as usize + 1).min(bins.len());
            let rows = shown.min(ROWS);
            spectrogram.rows = rows;
            spectrogram.amplitudes.extend((0..rows).map(|row| {
                let part = &bins[row * shown / rows..((row + 1) * shown / rows).max(row * shown / rows + 1)];
                part.iter().copied().fold(0.0, f64::max) as f32
            }));
        }
        spectrogram
    }

    /// Amplitude (V) at a time and a frequency, each by its place from 0.
    pub fn at(&self, column: usize, row: usize) -> f64 {
        self.amplitudes.get(column * self.rows + row).copied().map_or(0.0, f64::from)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_chirps_ridge_lies_at_its_frequency() {
        // 2 V from 10 to 40 Hz within 60 s, 400 samples a second.
        let rate = 400.0;
        let phase = |t: f64| std::f64::consts::TAU * (10.0 * t + 0.25 * t * t);
        let voltages: Vec<f64> = (0..24_000).map(|i| 2.0 * phase(i as f64 / rate).sin()).collect();
        let found = Spectrogram::new(&voltages, 1.0 / rate, 60.0);
        assert_eq!((found.columns, found.amplitudes.len()), (120, found.columns * found.rows));
        for column in 5..115 {
            let time = (column as f64 + 0.5) / found.columns as f64 * found.duration;
            let row = (0..found.rows).max_by(|a, b| found.at(column, *a).total_cmp(&found.at(column, *b)));
            let frequency = (row.unwrap_or(0) as f64 + 0.5) / found.rows as f64 * found.highest;
            assert!((frequency - (10.0 + 0.5 * time)).abs() < 1.5, "{column}: {frequency}");
            assert!((0.8..2.05).contains(&found.at(column, row.unwrap_or(0))));
        }
        assert_eq!(Spectrogram::new(&[], 1.0, 1.0).columns, 0);
    }
}
