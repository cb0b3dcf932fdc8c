//! Means and frequencies of a record by the weighted Birkhoff average (Das, Saiki, Sander & Yorke, Nonlinearity 30, 2017,
//! 4111-4140): with the weight exp(-1/(x (1 - x))) the error of a mean falls faster than any power of the length of the
//! record on a torus, and only like its inverse root on a chaotic motion. How far the means of the two halves of a
//! record agree so tells the two apart.

use std::f64::consts::TAU;

use nalgebra::Complex;
use serde::{Deserialize, Serialize};

use crate::fourier::{self, Direction};

/// Frequencies, spread over a bin of the record's resolution, from which the largest is looked for.
const PER_BIN: usize = 4;
/// Iterations of the search for the largest.
const ITERATIONS: usize = 60;

/// How often a motion turns about its torus in an excitation period.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, nanoserde::SerBin, nanoserde::DeBin)]
pub struct Rotation {
    /// Turns an excitation period (dimensionless, 0 to 1/2): stroboscopic points, once a period, cannot tell it from 1
    /// minus it.
    pub number: f64,
    /// How far the numbers of the two halves of the record differ.
    pub error: f64,
}

/// The weight at place `k` of a record of `count`.
fn weight(k: usize, count: usize) -> f64 {
    let x = (k + 1) as f64 / (count + 1) as f64;
    (-1.0 / (x * (1.0 - x))).exp()
}

/// The weights of a record of `count` values in their weighted Birkhoff average; their sum is 1.
pub fn weights(count: usize) -> Vec<f64> {
    let weights: Vec<f64> = (0..count).map(|k| weight(k, count)).collect();
    let total = weights.iter().sum::<f64>();
    weights.into_iter().map(|weight| weight / total).collect()
}

/// The weighted Birkhoff average of `values`.
pub fn weighted_average(values: &[f64]) -> f64 {
    weights(values.len()).iter().zip(values).map(|(weight, value)| weight * value).sum()
}

/// Largest difference of the weighted averages of the two halves of a record, of the values and of their squares, over
/// the mean square deviation.
pub(super) fn disagreement(values: &[f64]) -> f64 {
    let (early, late) = values.split_at(values.len() / 2);
    let mean = weighted_average(values);
    let spread = weighted_average(&values.iter().map(|v| (v - mean).powi(2)).collect::<Vec<_>>());
    let squares =
        |part: &[f64]| weighted_average(&part.iter().map(|v| (v - mean).powi(2)).collect::<Vec<_>>());
    let first =
        (weighted_average(early) - weighted_average(late)).abs() / spread.sqrt().max(1e-9 * mean.abs());
    let second = (squares(early) - squares(late)).abs() / spread.max(1e-18 * mean * mean);
    if spread > 0.0 { first.max(second) } else { 0.0 }
}

/// The strongest frequency of `values`, taken once a period, near `guess` (turns a period) if given, else anywhere;
/// `None` for a constant record.
pub(in crate::dynamics) fn rotation(values: &[f64], guess: Option<f64>) -> Option<Rotation> {
    let (early, late) = values.split_at(values.len() / 2);
    let number = frequency(values, guess)?;
    let (a, b) = (frequency(early, Some(number))?, frequency(late, Some(number))?);
    Some(Rotation { number, error: (a - b).abs() })
}

fn frequency(values: &[f64], guess: Option<f64>) -> Option<f64> {
    let count = values.len();
    let mean = weighted_average(values);
    let weighted: Vec<f64> =
        values.iter().enumerate().map(|(k, value)| weight(k, count) * (value - mean)).collect();
    let power = |frequency: f64| amplitude(&weighted, frequency).norm_sqr();
    let bin = 1.0 / (PER_BIN * count) as f64;
    let best = match guess {
        Some(guess) => {
            let near = (-3 * PER_BIN as i32..=3 * PER_BIN as i32).map(|i| guess + f64::from(i) * bin);
            near.max_by(|a, b| power(*a).total_cmp(&power(*b)))?
        }
        None => strongest(&weighted, bin)?,
    };
    if !(power(best) > 0.0) {
        return None;
    }
    let found = maximum(power, best - bin, best + bin);
    Some(found.abs().min((1.0 - found).abs()))
}

/// Of the frequencies 0 to 1/2 in steps of `bin`, the one with the largest amplitude.
fn strongest(weighted: &[f64], bin: f64) -> Option<f64> {
    let length = (1.0 / bin).round() as usize;
    let mut padded: Vec<Complex<f64>> = weighted.iter().map(|value| Complex::from(*value)).collect();
    padded.resize(length.next_power_of_two(), Complex::default());
    let spacing = 1.0 / padded.len() as f64;
    fourier::transform(padded.len(), Direction::Forward).process(&mut padded);
    let half = padded.len() / 2;
    let largest = (1..=half).max_by(|a, b| padded[*a].norm_sqr().total_cmp(&padded[*b].norm_sqr()))?;
    Some(largest as f64 * spacing)
}

/// Sum of `values` e^(-2 pi i k frequency), by a recurrence that is renewed often enough.
fn amplitude(values: &[f64], frequency: f64) -> Complex<f64> {
    const RENEWED: usize = 64;
    let turn = Complex::from_polar(1.0, -TAU * frequency);
    let mut sum = Complex::default();
    for (number, stretch) in values.chunks(RENEWED).enumerate() {
        let phase = (frequency * (number * RENEWED) as f64).fract();
        let mut factor = Complex::from_polar(1.0, -TAU * phase);
        for value in stretch {
            sum += factor * *value;
            factor *= turn;
        }
    }
    sum
}

/// Place of the maximum of `f`, which has one between `low` and `high`, by golden sections and a last parabola.
fn maximum(f: impl Fn(f64) -> f64, mut low: f64, mut high: f64) -> f64 {
    let golden = 0.5 * (5.0_f64.sqrt() - 1.0);
    let (mut a, mut b) = (high - golden * (high - low), low + golden * (high - low));
    let (mut at_a, mut at_b) = (f(a), f(b));
    // A maximum cannot be told to more than half the digits by values; the parabola has the rest.
    let width = high - low;
    for _ in 0..ITERATIONS {
        if high - low < 1e-3 * width {
            break;
        }
        if at_a > at_b {
            high = b;
            (b, at_b) = (a, at_a);
            a = high - golden * (high - low);
            at_a = f(a);
        } else {
            low = a;
            (a, at_a) = (b, at_b);
            b = low + golden * (high - low);
            at_b = f(b);
        }
    }
    let (centre, h) = (0.5 * (low + high), 0.02 * width);
    let (before, here, after) = (f(centre - h), f(centre), f(centre + h));
    let bend = before - 2.0 * here + after;
    if bend < 0.0 { centre + 0.5 * h * (before - after) / bend } else { centre }
}
