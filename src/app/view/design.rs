//! What the Design tab shows, as stored.

use serde::{Deserialize, Serialize};

use super::shake::ShakeView;
use crate::model::{Dimension, Limits, MAX_MODES, ModelError};
use crate::questions::design::trust::Quantity;
use crate::questions::find::GENERATIONS;
pub use crate::questions::rectifier::DROPS;
pub use crate::questions::tolerances::SCATTERS;
use crate::scenario::counted;
use crate::theory::Resonance;

/// The parts of the Design tab.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Page {
    /// What the device delivers over frequency.
    #[default]
    Harvest,
    /// Power against the load.
    Load,
    /// The ceramics side by side.
    Materials,
    /// How far the model can be trusted.
    Trust,
    /// Maps and the search for a design.
    Search,
    /// What the scatter of dimensions does.
    Tolerances,
    /// Measured data over computed curves.
    Measured,
    /// Shaken by chirps and noise.
    Shake,
    /// Pinned designs side by side.
    Variants,
}

/// What is drawn over frequency.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Watched {
    /// Mean power in the load.
    #[default]
    Power,
    /// The same over the square of the base's acceleration.
    PerG2,
    /// Root mean square of the voltage.
    Voltage,
    /// Its largest value, which the ceramic has to bear.
    Peak,
    /// Lowest and highest tip displacement.
    Tip,
}

/// What a map shows and a search makes large.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Aim {
    /// Mean power.
    #[default]
    Power,
    /// Power over the square of the base's acceleration.
    PerG2,
    /// Voltage.
    Voltage,
    /// Width of the band in which the least power is reached.
    Band,
    /// Lowest excitation of the resonance in view.
    Threshold,
}

/// A dimension that is varied, and how far; about its present value where no range is given.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Side {
    /// The dimension varied.
    #[serde(default = "Side::usual")]
    pub dimension: Dimension,
    /// Lowest and highest value in its SI unit.
    #[serde(default)]
    pub range: Option<(f64, f64)>,
}

impl Side {
    const fn usual() -> Dimension {
        Dimension::MagnetDistance
    }

    /// About the present value.
    pub const fn of(dimension: Dimension) -> Self {
        Self { dimension, range: None }
    }
}

/// What is mapped and searched.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct SearchView {
    /// What is to be good.
    pub aim: Aim,
    /// Across and up the map; the search varies both.
    pub sides: [Side; 2],
    /// Varied by the search besides.
    pub third: Option<Side>,
    /// Generations of the search.
    pub generations: usize,
}

impl Default for SearchView {
    fn default() -> Self {
        let sides = [Side::of(Dimension::Frequency), Side::of(Dimension::Resistance)];
        Self { aim: Aim::default(), sides, third: None, generations: 20 }
    }
}

/// Frequencies (Hz) that a window may have.
pub const FREQUENCIES: (f64, f64) = (1e-9, 1e9);
/// Powers (W) that can be asked for.
pub const POWERS: (f64, f64) = (1e-30, 1e30);

impl SearchView {
    /// Looks for something else. What does not depend on the frequency is not mapped over it.
    pub fn pursue(&mut self, aim: Aim) {
        self.aim = aim;
        if !matches!(aim, Aim::Band | Aim::Threshold) {
            return;
        }
        let taken = self.sides.map(|side| side.dimension);
        let mut free = [Dimension::MagnetDistance, Dimension::TipMass].into_iter();
        for side in self.sides.iter_mut().filter(|side| side.dimension == Dimension::Frequency) {
            *side = free.find(|dimension| !taken.contains(dimension)).map_or(*side, Side::of);
        }
    }
}

/// The Design tab.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct DesignView {
    /// The part in front.
    pub page: Page,
    /// Whether the left column shows the ten dimensionless numbers instead of the device.
    pub dimensionless: bool,
    /// Whether the base motion is held as an acceleration when the frequency changes, or else as an amplitude.
    pub holds_acceleration: bool,
    /// What is drawn over frequency.
    pub watched: Watched,
    /// Whether powers and voltages are drawn on a logarithmic scale.
    pub logarithmic: bool,
    /// Whether the frequencies of the curves are on a logarithmic scale.
    pub logarithmic_frequency: bool,
    /// Frequencies (Hz) of the curves; about the present one when absent.
    pub window: Option<(f64, f64)>,
    /// Power (W) that counts as usable; half of the highest when absent.
    pub least: Option<f64>,
    /// Forward drop of a rectifier's diode (V).
    pub diode_drop: f64,
    /// Standard deviation of every dimension, over its value.
    pub scatter: f64,
    /// What must be kept. Its voltage is that of the ceramic where it is not given.
    pub limits: Limits,
    /// The mode that gets a ceramic's quality factor, from 1.
    pub mode: usize,
    /// The resonance whose tongue is compared.
    pub resonance: Resonance,
    /// What is compared over models.
    pub quantity: Quantity,
    /// What is searched.
    pub search: SearchView,
    /// How the device is shaken on the page Shake.
    pub shake: ShakeView,
}

impl Default for DesignView {
    fn default() -> Self {
        Self {
            page: Page::default(),
            dimensionless: false,
            holds_acceleration: true,
            watched: Watched::default(),
            logarithmic: false,
            logarithmic_frequency: false,
            window: None,
            least: None,
            diode_drop: 0.0,
            scatter: 0.01,
            limits: Limits::default(),
            mode: 1,
            resonance: Resonance::First,
            quantity: Quantity::Power,
            search: SearchView::default(),
            shake: ShakeView::default(),
        }
    }
}

impl DesignView {
    /// Checks that everything can be asked for.
    ///
    /// # Errors
    /// [`ModelError`] naming what is out of range.
    pub(super) fn check(&self) -> Result<(), ModelError> {
        for end in self.window.iter().flat_map(|(from, to)| [from, to]) {
            ModelError::check("design.window", *end, FREQUENCIES, " Hz")?;
        }
        if let Some(least) = self.least {
            ModelError::check("design.least", least, POWERS, " W")?;
        }
        ModelError::check("design.diode_drop", self.diode_drop, DROPS, " V")?;
        ModelError::check("design.scatter", self.scatter, SCATTERS, "")?;
        self.limits.validate()?;
        self.shake.check()?;
        counted("design.mode", self.mode, (1, MAX_MODES))?;
        counted("design.search.generations", self.search.generations, GENERATIONS)?;
        for side in self.search.sides.iter().chain(&self.search.third) {
            for end in side.range.iter().flat_map(|(from, to)| [from, to]) {
                side.dimension.check(*end)?;
            }
        }
        Ok(())
    }
}
