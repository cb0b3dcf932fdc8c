//! What shakes a live run in place of the sine.

use std::sync::Arc;

use crate::model::base_motion::{BaseMotion, Signal};
use crate::model::{ModelError, Units};
use crate::questions::shaken_run::dimensionless;

/// A motion of the base, ready for a run of a device with these units.
#[derive(Debug)]
pub(in crate::app) struct Shaking {
    /// What was asked for.
    pub motion: BaseMotion,
    pub(super) units: Units,
    /// Its acceleration, dimensionless.
    pub(super) signal: Arc<Signal>,
}

impl Shaking {
    /// Of `motion`; of noise the first realisation.
    ///
    /// # Errors
    /// [`ModelError`] naming what of it is out of range.
    pub(super) fn of(motion: BaseMotion, units: Units) -> Result<Self, ModelError> {
        let signal = Arc::new(dimensionless(&motion.signal(0)?, &units));
        Ok(Self { motion, units, signal })
    }

    /// How long it lasts (s) before it begins anew.
    pub(in crate::app) fn duration(&self) -> f64 {
        self.signal.duration() * self.units.time
    }
}
