//! What can be wrong with a device or its dimensionless numbers, in sentences a user understands.

use thiserror::Error;

/// A reason why a set of inputs describes no harvester that can be computed.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum ModelError {
    /// A number lies outside the range in which the model is meant to be used.
    #[error("{field} = {value} is out of range: allowed are {minimum} to {maximum}{unit}")]
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
    #[error("{field} is not a finite number: allowed are {minimum} to {maximum}{unit}")]
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
        "the magnets attract so strongly that the tip has no equilibrium (pull-in): with c0 = {c0} and h = {h} the gap d = {d:.4} must be larger than {smallest:.4}"
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
        "the magnet softens the beam past buckling: c1 = {c1} must be greater than -3, the stiffness of the beam's tip"
    )]
    Buckled {
        /// Linear magnet stiffness c_1 (dimensionless).
        c1: f64,
    },
    /// The sag under gravity closes the gap of a device.
    #[error("under gravity the tip sags {sag} m, which closes the magnets' distance of {distance} m")]
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
