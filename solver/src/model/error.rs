//! What can be wrong with a device or its dimensionless numbers, in sentences a user understands.

use thiserror::Error;

use crate::number::six_digits;
use crate::sentence::{Say, Sentence, not_available, said};

/// A reason why a set of inputs describes no harvester that can be computed.
#[derive(Debug, Clone, PartialEq, Error)]
#[error("{}", self.say())]
pub enum ModelError {
    /// A number lies outside the range in which the model is meant to be used.
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
    /// The start has too few numbers for the modes, or too many.
    StateLength {
        /// How many it has.
        given: usize,
        /// How many are needed.
        needed: usize,
    },
    /// A number of a layer that the device does not have.
    NoLayer {
        /// Its place in a request's device.
        field: &'static str,
    },
    /// Both sides of a chart are the same coordinate.
    SameSides {
        /// Name of the coordinate.
        field: String,
    },
    /// Attracting magnets pull the tip in: no equilibrium exists.
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
    Buckled {
        /// Linear magnet stiffness c_1 (dimensionless).
        c1: f64,
    },
    /// A damping ratio of the second mode that no material and no air give.
    DampingRatio {
        /// The ratio given for mode 2.
        ratio: f64,
        /// That of mode 1.
        first: f64,
        /// What mode 2 has where the air takes all.
        minimum: f64,
        /// What it has where the material takes all.
        maximum: f64,
    },
    /// The sag under gravity closes the gap of a device.
    GapClosed {
        /// Sag of the tip (m).
        sag: f64,
        /// Distance of the magnets before the beam sags (m).
        distance: f64,
    },
}

impl Say for ModelError {
    fn say(&self) -> Sentence {
        match self {
            Self::OutOfRange { field, value, minimum, maximum, unit } => said(
                "{field} = {value} is out of range: allowed are {from} to {to}",
                &[
                    ("field", field),
                    ("value", &beyond(*value, *minimum, *maximum)),
                    ("from", &six_digits(*minimum)),
                    ("to", &(six_digits(*maximum) + unit)),
                ],
            ),
            Self::NotFinite { field, minimum, maximum, unit } => said(
                "{field} is not a finite number: allowed are {from} to {to}",
                &[("field", field), ("from", &six_digits(*minimum)), ("to", &(six_digits(*maximum) + unit))],
            ),
            Self::Count { field, value, minimum, maximum } => not_available(field, value, (minimum, maximum)),
            Self::StateLength { given, needed } => {
                not_available(&said("numbers in initial", &[]), given, (needed, needed))
            }
            Self::NoLayer { field } => said("{field}: the device has no such layer", &[("field", field)]),
            Self::SameSides { field } => {
                said("both sides of the chart are {field}: they must differ", &[("field", field)])
            }
            Self::PullIn { c0, d, h, smallest } => said(
                "the magnets attract so strongly that the tip has no equilibrium (pull-in): with c0 = {c0} and h = {h} the gap d = {d} must be larger than {smallest}",
                &[
                    ("c0", &six_digits(*c0)),
                    ("h", &six_digits(*h)),
                    ("d", &format!("{d:.4}")),
                    ("smallest", &format!("{smallest:.4}")),
                ],
            ),
            Self::Buckled { c1 } => said(
                "the magnet softens the beam past buckling: c1 = {c1} must be greater than -3, the stiffness of the beam's tip",
                &[("c1", &six_digits(*c1))],
            ),
            Self::DampingRatio { ratio, first, minimum, maximum } => said(
                "a damping ratio of {ratio} in mode 2 is not possible beside {first} in mode 1: allowed are {from} (all of it from the air) to {to} (all of it from the material)",
                &[
                    ("ratio", &beyond(*ratio, *minimum, *maximum)),
                    ("first", &six_digits(*first)),
                    ("from", &six_digits(*minimum)),
                    ("to", &six_digits(*maximum)),
                ],
            ),
            Self::GapClosed { sag, distance } => said(
                "under gravity the tip sags {sag} m, which closes the magnets' distance of {distance} m",
                &[("sag", &six_digits(*sag)), ("distance", &six_digits(*distance))],
            ),
        }
    }
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
        if value.is_finite() && value >= minimum && value <= maximum {
            return Ok(value);
        }
        let field = field.to_owned();
        if value.is_finite() {
            Err(Self::OutOfRange { field, value, minimum, maximum, unit })
        } else {
            Err(Self::NotFinite { field, minimum, maximum, unit })
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
