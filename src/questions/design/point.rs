//! What a device delivers at one frequency.

use serde::{Deserialize, Serialize};

use super::Plant;
use crate::dynamics::Measures;

/// A point of a curve over frequency.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, nanoserde::SerBin, nanoserde::DeBin)]
pub struct HarvestPoint {
    /// Frequency (Hz).
    pub frequency: f64,
    /// Means and extremes in SI units: V, W, mm.
    #[serde(flatten)]
    pub measures: Measures,
    /// The power over the square of the peak of the base's acceleration there (W/g^2).
    pub power_per_g2: f64,
}

impl HarvestPoint {
    /// Of a motion at omega (dimensionless), as `measures` say.
    pub(in crate::questions) fn new(plant: &Plant, omega: f64, measures: &Measures) -> Self {
        let (units, measures) = (&plant.units, plant.in_si(measures));
        let acceleration = units.acceleration(plant.beta_at(omega), omega);
        let square = acceleration * acceleration;
        let power_per_g2 = if acceleration > 0.0 { measures.power / square } else { 0.0 };
        Self { frequency: units.hertz(omega), measures, power_per_g2 }
    }

    /// Of the linear device: frequency (Hz), root mean square of the voltage (V), power (W), amplitude of the
    /// tip (mm), and of its slope (rad).
    pub(in crate::questions) fn of_linear(plant: &Plant, point: [f64; 5]) -> Self {
        let [frequency, v_rms, power, tip, slope] = point;
        let omega = plant.units.omega(frequency);
        let tip = tip / plant.units.millimetres(1.0);
        let v_peak = v_rms * std::f64::consts::SQRT_2;
        let measures = Measures { v_rms, v_peak, power, tip: (-tip, tip), slope };
        Self { frequency, ..Self::new(plant, omega, &measures) }
    }
}

/// (Frequency, power) of pieces of curves.
pub fn powers(pieces: &[Vec<HarvestPoint>]) -> Vec<Vec<[f64; 2]>> {
    let place = |point: &HarvestPoint| [point.frequency, point.measures.power];
    pieces.iter().map(|piece| piece.iter().map(place).collect()).collect()
}
