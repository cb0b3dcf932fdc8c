//! What shakes the base other than the sine, as stored: on the page Shake, and on Explore and Live where it takes the sine's place.

use serde::{Deserialize, Serialize};

use crate::model::ModelError;
use crate::model::base_motion::{DURATIONS, FREQUENCIES};
use crate::scenario::counted;

/// Levels (g) that can be asked for.
pub const LEVELS: (f64, f64) = (1e-6, 1e3);
/// Letters of a recording's name that are kept, and bytes that they may take.
const MOST_LETTERS: usize = 60;
const LONGEST_NAME: usize = 4 * MOST_LETTERS;

/// What shakes the base.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum ShakenBy {
    /// Noise in a band.
    #[default]
    Noise,
    /// A sine that goes through the band and back.
    Chirp,
    /// A recording that the user brought.
    Recorded,
}

/// Which recording: its numbers stand in the file that was brought, or in a saved scenario.
#[derive(Debug, Clone, PartialEq, Eq, Hash, Default, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Recording {
    /// Name of its file.
    pub name: String,
    /// CRC-32 of its numbers.
    pub checksum: u32,
}

impl Recording {
    /// By the file's name, without what a link would not keep.
    pub fn new(name: &str, checksum: u32) -> Self {
        let shown = name.chars().map(|c| if c.is_control() { ' ' } else { c });
        let name: String = shown.take(MOST_LETTERS).collect();
        Self { name: name.trim().to_owned(), checksum }
    }
}

/// How the base is shaken.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct ShakeView {
    /// What shakes the base.
    pub by: ShakenBy,
    /// Whether it does so on Explore and Live, too, in place of the sine.
    pub everywhere: bool,
    /// Root mean square of the noise, or peak of the chirp (g).
    pub level: f64,
    /// Lowest and highest frequency (Hz); about the device's own when absent. Of a recording the highest alone counts.
    pub band: Option<(f64, f64)>,
    /// How long (s); some hundred vibrations when absent. A recording has its own.
    pub duration: Option<f64>,
    /// Whether a chirp goes through as many octaves a second, or else as many Hz.
    pub octaves: bool,
    /// Which noise.
    pub seed: usize,
    /// Which recording, once there was one.
    pub recording: Option<Recording>,
    /// Whether a recording's mean is left in it.
    pub with_mean: bool,
}

impl Default for ShakeView {
    fn default() -> Self {
        Self {
            by: ShakenBy::default(),
            everywhere: false,
            level: 0.02,
            band: None,
            duration: None,
            octaves: false,
            seed: 0,
            recording: None,
            with_mean: false,
        }
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
        if let Some(recording) = &self.recording {
            counted("length of design.shake.recording.name", recording.name.len(), (0, LONGEST_NAME))?;
        }
        Ok(())
    }
}
