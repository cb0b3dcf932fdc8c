//! What can be wrong with a device or its dimensionless numbers, in sentences a user understands.

use thiserror::Error;

use crate::number::six_digits;

/// A reason why a set of inputs describes no harvester that can be computed.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum ModelError {
    /// A number lies outside the range in which the model is meant to be used.
    #[error(
        "{field} = {} is out of range: allowed are {} to {}{unit}", beyond(*value, *minimum, *maximum), six_digits(*minimum), six_digits(*maximum)
    )]
    OutOfRange {
        /// Name of the input as the user sees it.
        field: String,
        /// The value given.
        value: f64,
        /// Smallest allowed value.
        minimum: f64,
        /// Largest allowed value.
        maximum: f64,
        /// Unit with a leading blank, empty when dimensionless.
        unit: &'static str,
    },
    /// A number is NaN or infinite.
    #[error("{field} is not a finite number: allowed are {} to {}{unit}", six_digits(*minimum), six_digits(*maximum))]
    NotFinite {
        /// Name of the input as the user sees it.
        field: String,
        /// Smallest allowed value.
        minimum: f64,
        /// Largest allowed value.
        maximum: f64,
        /// Unit with a leading blank, empty when dimensionless.
        unit: &'static str,
    },
    /// The number of modes, or the degree of the Taylor polynomial, is not one the model has.
    #[error("{field} = {value} is not available: allowed are {minimum} to {maximum}")]
    Count {
        /// Name of the input.
        field: &'static str,
        /// The count given.
        value: usize,
        /// Smallest allowed count.
        minimum: usize,
        /// Largest allowed count.
        maximum: usize,
    },
    /// Both sides of a chart are the same coordinate.
    #[error("both sides of the chart are {field}: they must differ")]
    SameSides {
        /// Name of the coordinate.
        field: String,
    },
    /// Attracting magnets pull the tip in: no equilibrium exists.
    #[error(
        "the magnets attract so strongly that the tip has no equilibrium (pull-in): with c0 = {} and h = {} the gap d = {d:.4} must be larger than {smallest:.4}", six_digits(*c0), six_digits(*h)
    )]
    PullIn {
        /// Magnet strength c_0 (dimensionless, negative: attracting).
        c0: f64,
        /// Gap d (dimensionless).
        d: f64,
        /// Magnet length h (dimensionless).
        h: f64,
        /// Smallest gap with an equilibrium (dimensionless).
        smallest: f64,
    },
    /// The tip spring is so negative that the straight beam is unstable.
    #[error(
        "the magnet softens the beam past buckling: c1 = {} must be greater than -3, the stiffness of the beam's tip", six_digits(*c1)
    )]
    Buckled {
        /// Linear magnet stiffness c_1 (dimensionless).
        c1: f64,
    },
    /// The sag under gravity closes the gap of a device.
    #[error(
        "under gravity the tip sags {} m, which closes the magnets' distance of {} m", six_digits(*sag), six_digits(*distance)
    )]
    GapClosed {
        /// Sag of the tip (m).
        sag: f64,
        /// Distance of the magnets before the beam sags (m).
        distance: f64,
    },
}

impl ModelError {
    /// Checks that `value` is finite and within `minimum..=maximum`.
    ///
    /// # Errors
    /// [`ModelError::NotFinite`] or [`ModelError::OutOfRange`], naming `field` and the range.
    pub fn check(
        field: &str,
        value: f64,
        (minimum, maximum): (f64, f64),
        unit: &'static str,
    ) -> Result<f64, Self> {
        let field = field.to_owned();
        if !value.is_finite() {
            Err(Self::NotFinite { field, minimum, maximum, unit })
        } else if value < minimum || value > maximum {
            Err(Self::OutOfRange { field, value, minimum, maximum, unit })
        } else {
            Ok(value)
        }
    }
}

/// A value outside of its range in so many digits; in all where rounded it would seem allowed.
fn beyond(value: f64, minimum: f64, maximum: f64) -> String {
    let rounded = six_digits(value);
    let seems_allowed = rounded.parse().is_ok_and(|rounded: f64| (minimum..=maximum).contains(&rounded));
    if seems_allowed { value.to_string() } else { rounded }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_in_messages_are_short_but_never_seem_allowed() {
        let message = |value, range| {
            ModelError::check("d", value, range, " m")
                .map_err(|error| error.to_string())
                .err()
                .unwrap_or_default()
        };
        let expected = "d = 5.63338 is out of range: allowed are 0.01 to 2 m";
        assert_eq!(message(5.63337655769029, (0.01, 2.0)), expected);
        assert_eq!(message(-1.0, (1e-15, 1e15)), "d = -1 is out of range: allowed are 1e-15 to 1e15 m");
        let expected = "d = 2.000000001 is out of range: allowed are 0.01 to 2 m";
        assert_eq!(message(2.000000001, (0.01, 2.0)), expected);
    }
}
