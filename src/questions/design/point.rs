//! What a device delivers at one frequency.

use serde::{Deserialize, Serialize};

use super::{Asked, Plant};
use crate::dynamics::attractors::sweep::SweepPoint;
use crate::questions::response::ResponsePoint;

/// A point of a curve over frequency.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, nanoserde::SerBin, nanoserde::DeBin)]
pub struct HarvestPoint {
    /// Frequency (Hz).
    pub frequency: f64,
    /// Root mean square of the voltage (V).
    pub v_rms: f64,
    /// Largest |v| (V).
    pub v_peak: f64,
    /// Mean power in the load (W).
    pub power: f64,
    /// The same over the square of the peak of the base's acceleration there (W/g^2).
    pub power_per_g2: f64,
    /// Lowest and highest tip displacement (mm).
    pub tip: (f64, f64),
    /// Largest |slope| at the tip (rad).
    pub slope: f64,
}

impl HarvestPoint {
    /// From voltages (V), rms and peak, range of the tip (beam lengths) and largest slope (rad) at omega
    /// (dimensionless).
    pub(in crate::questions) fn new(
        plant: &Plant,
        omega: f64,
        (v_rms, v_peak): (f64, f64),
        tip: (f64, f64),
        slope: f64,
    ) -> Self {
        let units = &plant.units;
        let power = plant.watts(v_rms);
        let acceleration = units.acceleration(plant.beta_at(omega), omega);
        Self {
            frequency: units.hertz(omega),
            v_rms,
            v_peak,
            power,
            power_per_g2: if acceleration > 0.0 { power / (acceleration * acceleration) } else { 0.0 },
            tip: (units.millimetres(tip.0), units.millimetres(tip.1)),
            slope,
        }
    }

    /// Of the linear device: frequency (Hz), root mean square of the voltage (V), power (W), amplitude of the
    /// tip (mm), and of its slope (rad).
    pub(in crate::questions) fn of_linear(plant: &Plant, point: [f64; 5]) -> Self {
        let [frequency, v_rms, power, tip, slope] = point;
        let omega = plant.units.omega(frequency);
        let tip = tip / plant.units.millimetres(1.0);
        let point = Self::new(plant, omega, (v_rms, v_rms * std::f64::consts::SQRT_2), (-tip, tip), slope);
        Self { frequency, power, ..point }
    }

    /// Of a value of a sweep over omega.
    pub(in crate::questions) fn of_sweep(plant: &Plant, point: &SweepPoint) -> Self {
        Self::new(plant, point.value, (point.v_rms, point.v_peak), point.tip, point.slope)
    }

    /// Of a point of a branch over omega.
    pub(in crate::questions) fn of_branch(plant: &Plant, point: &ResponsePoint) -> Self {
        Self::new(plant, point.value, (point.v_rms, point.v_peak), point.tip, point.slope)
    }

    /// What it asks of the device.
    pub fn asked(&self) -> Asked {
        let Self { v_peak, tip, slope, .. } = *self;
        Asked { v_peak, tip, slope }
    }
}

/// (Frequency, power) of pieces of curves.
pub fn powers(pieces: &[Vec<HarvestPoint>]) -> Vec<Vec<[f64; 2]>> {
    let place = |point: &HarvestPoint| [point.frequency, point.power];
    pieces.iter().map(|piece| piece.iter().map(place).collect()).collect()
}
