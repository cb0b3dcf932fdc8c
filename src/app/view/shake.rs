//! How the device is shaken on the page Shake of the Design tab, as stored.

use serde::{Deserialize, Serialize};

use crate::model::ModelError;
use crate::model::base_motion::FREQUENCIES;

/// Levels (g) that can be asked for.
pub const LEVELS: (f64, f64) = (1e-6, 1e3);
/// Durations (s) that can be asked for.
pub const DURATIONS: (f64, f64) = (1e-3, 1e5);

/// What shakes the base.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum ShakenBy {
    /// Noise in a band.
    #[default]
    Noise,
    /// A sine that goes through the band and back.
    Chirp,
}

/// The page Shake.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct ShakeView {
    /// What shakes the base.
    pub by: ShakenBy,
    /// Root mean square of the noise, or peak of the chirp (g).
    pub level: f64,
    /// Lowest and highest frequency (Hz); about the device's own when absent.
    pub band: Option<(f64, f64)>,
    /// How long (s); some hundred vibrations when absent.
    pub duration: Option<f64>,
    /// Whether a chirp goes through as many octaves a second, or else as many Hz.
    pub octaves: bool,
    /// Which noise.
    pub seed: usize,
}

impl Default for ShakeView {
    fn default() -> Self {
        Self { by: ShakenBy::default(), level: 0.02, band: None, duration: None, octaves: false, seed: 0 }
    }
}

impl ShakeView {
    /// Checks that everything can be asked for.
    ///
    /// # Errors
    /// [`ModelError`] naming what is out of range.
    pub(super) fn check(&self) -> Result<(), ModelError> {
        ModelError::check("design.shake.level", self.level, LEVELS, " g")?;
        if let Some(duration) = self.duration {
            ModelError::check("design.shake.duration", duration, DURATIONS, " s")?;
        }
        for end in self.band.iter().flat_map(|(from, to)| [from, to]) {
            ModelError::check("design.shake.band", *end, FREQUENCIES, " Hz")?;
        }
        Ok(())
    }
}
