//! Parameters that change and their ranges: one axis for a branch of orbits, two for a curve of bifurcations.

use serde::{Deserialize, Serialize};

use crate::dynamics::orbits::OrbitError;
use crate::model::{ModelError, Parameter, ReducedSystem};

/// One number that changes, with its range, whose width serves as its unit.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, nanoserde::SerBin, nanoserde::DeBin)]
pub struct Axis {
    /// Which number.
    pub parameter: Parameter,
    /// Its smallest and largest value (dimensionless).
    pub range: (f64, f64),
}

impl Axis {
    /// The range's width.
    pub fn width(&self) -> f64 {
        self.range.1 - self.range.0
    }

    /// The value at a `fraction` of the range.
    pub fn at(&self, fraction: f64) -> f64 {
        self.range.0 + fraction * self.width()
    }

    /// `value`, moved onto the border of what the model accepts where only rounding lies between them.
    pub(super) fn accepted(&self, value: f64) -> f64 {
        let (minimum, maximum) = self.parameter.range();
        let border = value.clamp(minimum, maximum);
        if (value - border).abs() <= 1e-12 * (maximum - minimum) { border } else { value }
    }
}

/// A rectangle in the plane of two parameters.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, nanoserde::SerBin, nanoserde::DeBin)]
#[serde(try_from = "[Axis; 2]", into = "[Axis; 2]")]
pub struct Plane {
    axes: [Axis; 2],
}

impl Plane {
    /// The rectangle of two different parameters with ranges of positive width within what the model accepts.
    ///
    /// # Errors
    /// [`ModelError::NotFinite`] and [`ModelError::OutOfRange`] for an end of a range, [`OrbitError::Plane`] for
    /// an empty range or twice the same parameter.
    pub fn new(axes: [Axis; 2]) -> Result<Self, OrbitError> {
        for Axis { parameter, range: (low, high) } in axes {
            for end in [low, high] {
                ModelError::check(parameter.field(), end, parameter.range(), "")?;
            }
            if !(low < high) || axes[0].parameter == axes[1].parameter {
                return Err(OrbitError::Plane { parameter: parameter.field() });
            }
        }
        Ok(Self { axes })
    }

    /// Both axes: the horizontal one, the vertical one.
    pub fn axes(&self) -> &[Axis; 2] {
        &self.axes
    }

    /// The device `system` with the plane's parameters at the point `at`.
    ///
    /// # Errors
    /// [`ModelError`] when there is none.
    pub fn system(&self, system: &ReducedSystem, at: [f64; 2]) -> Result<ReducedSystem, ModelError> {
        let mut set = *system.parameters;
        for (axis, value) in self.axes.iter().zip(at) {
            *set.get_mut(axis.parameter) = axis.accepted(value);
        }
        system.with_numbers(set)
    }

    /// Distance of two points in units of the ranges' widths (dimensionless).
    pub fn distance(&self, a: [f64; 2], b: [f64; 2]) -> f64 {
        let [p, q] = self.scaled([b[0] - a[0], b[1] - a[1]]);
        p.hypot(q)
    }

    /// A difference of two points in units of the ranges' widths.
    pub(super) fn scaled(&self, difference: [f64; 2]) -> [f64; 2] {
        std::array::from_fn(|k| difference[k] / self.axes[k].width())
    }
}

impl TryFrom<[Axis; 2]> for Plane {
    type Error = OrbitError;

    fn try_from(axes: [Axis; 2]) -> Result<Self, OrbitError> {
        Self::new(axes)
    }
}

impl From<Plane> for [Axis; 2] {
    fn from(plane: Plane) -> Self {
        plane.axes
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_plane_needs_two_parameters_and_ranges_in_order() {
        let axis = |parameter, low, high| Axis { parameter, range: (low, high) };
        let omega = axis(Parameter::Omega, 8.0, 9.0);
        assert!(Plane::new([omega, axis(Parameter::Beta, 0.0, 0.04)]).is_ok());
        for second in [
            axis(Parameter::Beta, 0.04, 0.0),
            axis(Parameter::Beta, 0.02, 0.02),
            axis(Parameter::Omega, 8.0, 9.0),
        ] {
            assert!(matches!(Plane::new([omega, second]), Err(OrbitError::Plane { .. })), "{second:?}");
        }
        let out_of_range = Plane::new([omega, axis(Parameter::Beta, 0.0, 0.3)]);
        assert!(matches!(out_of_range, Err(OrbitError::Model(ModelError::OutOfRange { .. }))));
    }
}
