//! How the base may be shaken other than by a sine: chirps, noise, recorded vibration.
//!
//! [`signal`] is what the dynamics take, an acceleration that is a polynomial between samples; [`chirp`], [`noise`] and
//! [`recorded`] make one, in seconds and in g, and [`BaseMotion`] is any of them, as requests and files write it.

pub mod chirp;
pub mod noise;
pub mod recorded;
mod shared;
pub mod signal;

use nanoserde::{DeBin, SerBin};
use serde::{Deserialize, Serialize};

pub use chirp::Chirp;
pub use noise::Noise;
pub use recorded::{Recorded, reaches_above};
pub use shared::Shared;
pub use signal::{DERIVATIVES, Signal};

use super::ModelError;

/// Most samples of a signal: an hour at 1 kHz fits.
pub const MOST_SAMPLES: usize = 1 << 22;
/// Shortest and longest duration (s).
pub const DURATIONS: (f64, f64) = (1e-6, 1e6);
/// Lowest and highest frequency (Hz).
pub const FREQUENCIES: (f64, f64) = (1e-6, 1e6);
/// Lowest and highest acceleration (g).
pub const ACCELERATIONS: (f64, f64) = (0.0, 1e6);

/// A motion of the base.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, SerBin, DeBin)]
#[serde(tag = "kind", rename_all = "lowercase")]
pub enum BaseMotion {
    /// A sine of changing frequency.
    Chirp(Chirp),
    /// Gaussian noise.
    Noise(Noise),
    /// What an accelerometer recorded.
    Recorded(Recorded),
}

impl BaseMotion {
    /// The acceleration over time, in s and g; of noise that of its `realisation`, counted from 0, of which every one is
    /// another.
    ///
    /// # Errors
    /// [`ModelError`], naming what is out of range.
    pub fn signal(&self, realisation: u64) -> Result<Signal, ModelError> {
        match self {
            Self::Chirp(chirp) => chirp.signal(),
            Self::Noise(noise) => noise.signal(realisation),
            Self::Recorded(recorded) => recorded.signal(),
        }
    }

    /// Whether it has no end of its own: its statistics are the same at all times.
    pub fn is_stationary(&self) -> bool {
        matches!(self, Self::Noise(_))
    }
}

/// How many samples a duration (s) at `rate` (1/s) takes.
///
/// # Errors
/// [`ModelError::OutOfRange`] for the duration when they are too many.
fn samples(duration: f64, rate: f64) -> Result<usize, ModelError> {
    let most = MOST_SAMPLES as f64 / rate;
    ModelError::check("duration", duration, (DURATIONS.0, DURATIONS.1.min(most)), " s")?;
    Ok(((duration * rate).ceil() as usize).max(DERIVATIVES))
}
