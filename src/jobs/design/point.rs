//! What a device delivers at one frequency.

use serde::{Deserialize, Serialize};

use super::Plant;
use crate::dynamics::sweep::SweepPoint;
use crate::jobs::response::ResponsePoint;

/// A point of a curve over frequency.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct HarvestPoint {
    /// Frequency (Hz).
    pub frequency: f64,
    /// Root mean square of the voltage (V).
    pub v_rms: f64,
    /// Largest |v| (V).
    pub v_peak: f64,
    /// Mean power in the load (W).
    pub power: f64,
    /// The same over the square of the base's acceleration there (W/g^2).
    pub power_per_g2: f64,
    /// Lowest and highest tip displacement (mm).
    pub tip: (f64, f64),
}

impl HarvestPoint {
    /// From voltages (V), rms and peak, and the range of the tip (beam lengths) at omega (dimensionless).
    pub(in crate::jobs) fn new(
        plant: &Plant,
        omega: f64,
        (v_rms, v_peak): (f64, f64),
        tip: (f64, f64),
    ) -> Self {
        let units = &plant.units;
        let power = plant.watts(v_rms);
        let acceleration = units.acceleration(plant.scenario.parameters.beta, omega);
        Self {
            frequency: units.hertz(omega),
            v_rms,
            v_peak,
            power,
            power_per_g2: if acceleration > 0.0 { power / (acceleration * acceleration) } else { 0.0 },
            tip: (units.millimetres(tip.0), units.millimetres(tip.1)),
        }
    }

    /// Of the linear device: frequency (Hz), root mean square of the voltage (V), power (W), amplitude of the tip (mm).
    pub(in crate::jobs) fn of_linear(plant: &Plant, [frequency, v_rms, power, tip]: [f64; 4]) -> Self {
        let omega = plant.units.omega(frequency);
        let tip = tip / plant.units.millimetres(1.0);
        let point = Self::new(plant, omega, (v_rms, v_rms * std::f64::consts::SQRT_2), (-tip, tip));
        Self { frequency, power, ..point }
    }

    /// Of a value of a sweep over omega.
    pub(in crate::jobs) fn of_sweep(plant: &Plant, point: &SweepPoint) -> Self {
        Self::new(plant, point.value, (point.v_rms, point.v_peak), point.tip)
    }

    /// Of a point of a branch over omega.
    pub(in crate::jobs) fn of_branch(plant: &Plant, point: &ResponsePoint) -> Self {
        Self::new(plant, point.value, (point.v_rms, point.v_peak), point.tip)
    }
}

/// (Frequency, power) of pieces of curves.
pub fn powers(pieces: &[Vec<HarvestPoint>]) -> Vec<Vec<[f64; 2]>> {
    let place = |point: &HarvestPoint| [point.frequency, point.power];
    pieces.iter().map(|piece| piece.iter().map(place).collect()).collect()
}
