//! An integrator whose force law is hidden, so that what watches a motion has one type and no end time.

use super::collocation::{Collocation, Step};
use super::{IntegrationError, Outcome, Settings};
use crate::model::reduced::ForceVisitor;
use crate::model::{ReducedSystem, RestForce};

/// A motion being computed, from stroboscopic instant to stroboscopic instant without end.
pub(super) trait Flow {
    /// Present time (dimensionless).
    fn time(&self) -> f64;

    /// Goes on for at most `steps` steps, each shown to `observer`; the outcome when the motion has ended.
    ///
    /// # Errors
    /// As [`Collocation::advance`].
    fn advance(
        &mut self,
        steps: usize,
        observer: &mut dyn FnMut(&Step<'_>),
    ) -> Result<Option<Outcome>, IntegrationError>;
}

impl<F: RestForce> Flow for Collocation<F> {
    fn time(&self) -> f64 {
        Self::time(self)
    }

    fn advance(
        &mut self,
        steps: usize,
        observer: &mut dyn FnMut(&Step<'_>),
    ) -> Result<Option<Outcome>, IntegrationError> {
        // Without an end time no step is shortened, so every stroboscopic instant stays on the grid.
        Self::advance(self, f64::INFINITY, steps, observer)
    }
}

/// The motion of `system` from `initial` (length 2N + 1) at t = 0 under its own force law.
///
/// # Errors
/// As [`Collocation::new`].
pub(super) fn begin(system: &ReducedSystem, initial: &[f64]) -> Result<Box<dyn Flow>, IntegrationError> {
    struct Begin<'a>(&'a ReducedSystem, &'a [f64]);
    impl ForceVisitor for Begin<'_> {
        type Output = Result<Box<dyn Flow>, IntegrationError>;
        fn visit<F: RestForce + 'static>(self, force: F) -> Self::Output {
            Ok(Box::new(Collocation::new(self.0, force, self.1, Settings::default())?))
        }
    }
    system.dispatch(Begin(system, initial))
}

/// What each component of a state is when its energy is that of a unit displacement of its mode, length 2N + 1, as
/// [`super::PeriodMap::scales`]. Divided by these, components compare.
pub(super) fn scales(system: &ReducedSystem) -> Vec<f64> {
    let first = &system.modes[0];
    let voltage = first.omega * (first.eta2 / system.parameters.c).sqrt();
    let velocities = system.modes.iter().map(|mode| mode.omega);
    std::iter::repeat_n(1.0, system.modes.len()).chain(velocities).chain([voltage]).collect()
}
