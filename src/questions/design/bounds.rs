//! The limits of a device as its motions in SI units are held against them.

use super::Plant;
use super::point::HarvestPoint;
use crate::dynamics::Measures;
use crate::model::{Demand, Limits, ModelError, Units};

/// Limits with what they refer to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bounds {
    /// What must be kept.
    pub limits: Limits,
    /// Distance s0 of the magnets at rest (beam lengths); none without magnets.
    pub gap: Option<f64>,
    /// SI units of the device.
    pub units: Units,
}

impl Bounds {
    /// Of `plant`.
    ///
    /// # Errors
    /// [`ModelError`] for limits that cannot be kept at all, and as [`Plant::system`].
    pub fn new(plant: &Plant, limits: Limits) -> Result<Self, ModelError> {
        limits.validate()?;
        Ok(Self { limits, gap: Plant::gap(&plant.system()?), units: plant.units })
    }

    /// The same for the device without its magnets, which then cannot touch.
    pub fn without_magnets(&self) -> Self {
        Self { gap: None, ..*self }
    }

    /// What a motion with these numbers in SI units asks of the device.
    pub fn demand(&self, measures: &Measures) -> Demand {
        let ((low, high), beam) = (measures.tip, self.units.millimetres(1.0));
        Demand { tip: (low / beam, high / beam), ..measures.demand() }
    }

    /// Whether a motion with these numbers in SI units keeps them.
    pub fn allows(&self, measures: &Measures) -> bool {
        self.limits.allow(&self.demand(measures), self.gap)
    }

    /// What is left to the nearest limit (dimensionless, of that limit); negative beyond it.
    pub fn margin(&self, measures: &Measures) -> f64 {
        let checks = self.limits.checks(&self.demand(measures), self.gap);
        // What is no number stays so.
        let least = |least: f64, margin: f64| if least <= margin || least.is_nan() { least } else { margin };
        checks.iter().map(|check| check.margin).fold(f64::INFINITY, least)
    }

    /// (Frequency, power) of those parts of `pieces` that keep the limits, cut where the margin vanishes on the line
    /// between two points.
    pub fn powers_within(&self, pieces: &[Vec<HarvestPoint>]) -> Vec<Vec<[f64; 2]>> {
        let mut parts = Vec::new();
        for piece in pieces {
            let mut part = Vec::new();
            let mut before: Option<([f64; 2], f64)> = None;
            for point in piece {
                let (place, margin) = ([point.frequency, point.measures.power], self.margin(&point.measures));
                if let Some((last, left)) = before
                    && (left >= 0.0) != (margin >= 0.0)
                {
                    let share = left / (left - margin);
                    part.push([0, 1].map(|i| last[i] + share * (place[i] - last[i])));
                }
                if margin >= 0.0 {
                    part.push(place);
                } else {
                    parts.push(std::mem::take(&mut part));
                }
                before = Some((place, margin));
            }
            parts.push(part);
        }
        parts.retain(|part| !part.is_empty());
        parts
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenario::Scenario;

    #[test]
    fn curves_are_cut_where_they_meet_a_limit() -> Result<(), ModelError> {
        let limits = Limits { voltage: Some((10.0, 10.0)), gap: 0.5, ..Limits::default() };
        let bounds = Bounds::new(&Plant::new(&Scenario::default())?, limits)?;
        let gap = bounds.units.millimetres(bounds.gap.unwrap_or_default());
        let point = |frequency: f64, v_peak: f64, tip: f64| HarvestPoint {
            frequency,
            measures: Measures { v_peak, power: 2.0 * frequency, tip: (-tip, tip), ..Measures::default() },
            power_per_g2: 0.0,
        };
        // Up through 10 V halfway between 2 and 3 Hz, down again at 4.25 Hz; the gap never matters.
        let piece = vec![point(1.0, 5.0, 0.0), point(2.0, 8.0, 0.0), point(3.0, 12.0, 0.0)];
        let hill = [piece, vec![point(4.0, 11.0, 0.0), point(5.0, 7.0, 0.0)]].concat();
        let parts = bounds.powers_within(&[hill]);
        let expected = [vec![[1.0, 2.0], [2.0, 4.0], [2.5, 5.0]], vec![[4.25, 8.5], [5.0, 10.0]]];
        assert_eq!(parts.iter().map(Vec::len).collect::<Vec<_>>(), [3, 2]);
        for (place, expected) in parts.iter().flatten().flatten().zip(expected.iter().flatten().flatten()) {
            assert!((place - expected).abs() < 1e-12, "{parts:?}");
        }
        // Half of the gap is closed at 1.5 Hz; without magnets there is no gap.
        let near = vec![point(1.0, 1.0, 0.25 * gap), point(2.0, 1.0, 0.75 * gap)];
        let parts = bounds.powers_within(std::slice::from_ref(&near));
        assert!(parts.len() == 1 && (parts[0][1][0] - 1.5).abs() < 1e-12, "{parts:?}");
        let asked = near[1].measures;
        assert!(!bounds.allows(&asked) && bounds.without_magnets().allows(&asked));
        // The slope is the last to be met: 0.3 rad.
        assert!(!bounds.without_magnets().allows(&Measures { slope: 0.31, ..asked }));
        assert!(bounds.powers_within(&[vec![point(1.0, 11.0, 0.0)]]).is_empty());
        Ok(())
    }
}
