//! The best load among the motions reached.

use crate::questions::design::Bounds;
use crate::questions::design::load::{LoadPoint, best};
use crate::questions::load::LoadStudy;

/// The best of the motions reached, of all and of those that keep the limits.
#[derive(Clone, Copy)]
pub(in crate::app::panels) struct Optimum {
    pub of_all: LoadPoint,
    pub within_limits: Option<LoadPoint>,
}

impl Optimum {
    /// None when no motion lasts.
    pub(in crate::app::panels) fn of(study: &LoadStudy, bounds: Option<Bounds>) -> Option<Self> {
        let points = study.reached().iter().flatten().copied();
        let keeps = |point: &LoadPoint| bounds.is_none_or(|bounds| bounds.allows(&point.measures));
        Some(Self { of_all: best(points.clone())?, within_limits: best(points.filter(keeps)) })
    }

    /// The one to recommend.
    pub(in crate::app::panels) fn to_use(self) -> LoadPoint {
        self.within_limits.unwrap_or(self.of_all)
    }
}
