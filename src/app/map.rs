//! The stability boundaries of a structure, over the frequencies of the map's windows.

use egui_plot::PlotPoint;

use super::view::MapWindow;
use crate::model::{ParameterSet, ReducedSystem};
use crate::questions::design::Plant;
use crate::scenario::Scenario;
use crate::spacing::equally_spaced;
use crate::theory::{CoupledModes, Published, Resonance};

/// Half width of a window about one resonance (dimensionless frequency).
pub(super) const HALF_WIDTH: f64 = 0.6;
/// How far a boundary is followed to either side of its resonance: as wide as the widest map shows it.
const REACH: f64 = 1.6;
/// How a boundary is followed beyond, and how often at most.
const STEP: f64 = 0.1;
const STEPS: usize = 80;
/// Points of a boundary.
const POINTS: usize = 241;

/// Upper ends that the excitation axis may have.
const CEILINGS: [f64; 7] = [0.003, 0.0075, 0.015, 0.04, 0.08, 0.15, 0.2];
/// The lowest ceiling of each window.
const fn least_ceiling(window: MapWindow) -> f64 {
    match window {
        MapWindow::First | MapWindow::Sum => 0.015,
        MapWindow::All | MapWindow::Second => 0.04,
    }
}
/// How far above the tip of a tongue a map reaches at least, so that its shape is seen: over the tip's excitation.
const ABOVE_THE_TIP: f64 = 1.5;

/// What the boundaries depend on: the device of `scenario` without its excitation.
pub(super) fn structure(scenario: &Scenario) -> Scenario {
    let usual = ParameterSet::default();
    let parameters = ParameterSet { omega: usual.omega, beta: usual.beta, ..scenario.parameters };
    Scenario { parameters, model: scenario.model, ..Scenario::default() }
}

/// A resonance's frequency and its boundaries as (omega, beta); gaps are NaN.
#[derive(Debug, Clone)]
pub(super) struct Tongue {
    /// Which resonance.
    pub resonance: Resonance,
    /// Frequency in the published theory.
    pub published_frequency: f64,
    /// Published boundary.
    pub published: Vec<PlotPoint>,
    /// Coupled-mode boundary.
    pub coupled: Vec<PlotPoint>,
}

/// All boundaries of a structure.
#[derive(Debug, Clone)]
pub(super) struct Boundaries {
    /// What they belong to.
    pub structure: Scenario,
    /// Natural frequencies.
    pub frequencies: Vec<f64>,
    /// One tongue a resonance; none for a single mode.
    pub tongues: Vec<Tongue>,
    /// The published theory, to ask about one point.
    pub published: Option<Published>,
    /// The coupled-mode theory, to ask about one point.
    pub coupled: Option<CoupledModes>,
    /// Distance of the magnets at rest (beam lengths); none without magnets.
    pub gap: Option<f64>,
}

/// Goes on with a curve over frequency at both ends, see [`Tongue::followed`].
fn follow(curve: &mut Vec<PlotPoint>, boundary: &dyn Fn(f64) -> Option<f64>) {
    for step in [STEP, -STEP] {
        for _ in 0..STEPS {
            let Some(end) = curve.last().filter(|end| end.y < CEILINGS[CEILINGS.len() - 1]).copied() else {
                break;
            };
            let omega = end.x + step;
            let beta = boundary(omega).filter(|_| omega > 0.0).unwrap_or(f64::NAN);
            curve.push(PlotPoint::new(omega, beta));
        }
        curve.reverse();
    }
}

impl Boundaries {
    /// Computes the boundaries of `system`; its excitation plays no role.
    pub(super) fn new(structure: Scenario, system: &ReducedSystem) -> Self {
        let published = Published::new(system).ok();
        let coupled = CoupledModes::new(system).ok();
        let tongues = published.as_ref().map_or_else(Vec::new, |published| {
            let tongue = |resonance| Tongue::new(resonance, REACH, published, coupled.as_ref());
            Resonance::ALL.map(|resonance| tongue(resonance).followed(published, coupled.as_ref())).into()
        });
        let frequencies = system.modes.iter().map(|mode| mode.omega).collect();
        Self { structure, frequencies, tongues, published, coupled, gap: Plant::gap(system) }
    }

    /// The tongue about a resonance.
    pub(super) fn tongue(&self, resonance: Resonance) -> Option<&Tongue> {
        self.tongues.iter().find(|tongue| tongue.resonance == resonance)
    }

    /// The resonance whose window holds `omega`.
    pub(super) fn resonance_near(&self, omega: f64) -> Option<Resonance> {
        let near = |tongue: &&Tongue| (tongue.published_frequency - omega).abs() <= HALF_WIDTH;
        self.tongues.iter().find(near).map(|tongue| tongue.resonance)
    }

    /// Lowest and highest frequency of a window.
    pub(super) fn range(&self, window: MapWindow) -> (f64, f64) {
        let centre = window.resonance().and_then(|resonance| self.tongue(resonance));
        match (centre, self.tongues.last()) {
            (Some(tongue), _) => {
                (tongue.published_frequency - HALF_WIDTH, tongue.published_frequency + HALF_WIDTH)
            }
            (None, Some(_)) => {
                let highest =
                    self.tongues.iter().map(|tongue| tongue.published_frequency).fold(0.0, f64::max);
                (0.0, 1.12 * highest)
            }
            (None, None) => (0.0, 3.0 * self.frequencies[0]),
        }
    }

    /// The upper end of the excitation axis in a window that shows `beta`, and the window's tongue: the lowest of all.
    pub(super) fn ceiling(&self, window: MapWindow, beta: f64) -> f64 {
        let shown =
            |tongue: &&Tongue| window.resonance().is_none_or(|resonance| resonance == tongue.resonance);
        let tip = self.tongues.iter().filter(shown).filter_map(Tongue::tip).fold(f64::INFINITY, f64::min);
        let tip = if tip.is_finite() { ABOVE_THE_TIP * tip } else { 0.0 };
        let wanted = tip.max(1.15 * beta).max(least_ceiling(window));
        CEILINGS.into_iter().find(|ceiling| *ceiling >= wanted).unwrap_or(CEILINGS[CEILINGS.len() - 1])
    }

    /// The window that shows `omega`, given the one open now.
    pub(super) fn follow(&self, open: MapWindow, omega: f64) -> MapWindow {
        let (low, high) = self.range(open);
        if open != MapWindow::All && (low..=high).contains(&omega) {
            return open;
        }
        match self.resonance_near(omega) {
            Some(resonance) if open != MapWindow::All => MapWindow::about(resonance),
            _ => MapWindow::All,
        }
    }
}

impl Tongue {
    /// The lowest excitation of its boundary near its resonance: the coupled one where there is one.
    fn tip(&self) -> Option<f64> {
        let near = |point: &&PlotPoint| (point.x - self.published_frequency).abs() <= HALF_WIDTH;
        let lowest = |curve: &[PlotPoint]| {
            curve.iter().filter(near).map(|point| point.y).filter(|beta| beta.is_finite()).reduce(f64::min)
        };
        lowest(&self.coupled).or_else(|| lowest(&self.published))
    }

    /// The same with its boundaries followed until they leave every map at the top, so that none ends in the middle of
    /// one.
    fn followed(mut self, published: &Published, coupled: Option<&CoupledModes>) -> Self {
        let resonance = self.resonance;
        follow(&mut self.published, &|omega| published.boundary(resonance, omega));
        if let Some(coupled) = coupled {
            follow(&mut self.coupled, &|omega| coupled.boundary(resonance, omega));
        }
        self
    }

    /// The boundaries of one resonance; the coupled ones are empty without that theory.
    pub(super) fn new(
        resonance: Resonance,
        half_width: f64,
        published: &Published,
        coupled: Option<&CoupledModes>,
    ) -> Self {
        let centre = published.frequency(resonance);
        // Denser towards the resonance, where the boundary bends.
        let frequencies =
            || equally_spaced((-1.0, 1.0), POINTS).map(|u| centre + half_width * (0.3 * u + 0.7 * u * u * u));
        let place = |omega: f64, beta: Option<f64>| PlotPoint::new(omega, beta.unwrap_or(f64::NAN));
        Self {
            resonance,
            published_frequency: centre,
            published: frequencies()
                .map(|omega| place(omega, published.boundary(resonance, omega)))
                .collect(),
            coupled: coupled.map_or_else(Vec::new, |coupled| {
                frequencies().map(|omega| place(omega, coupled.boundary(resonance, omega))).collect()
            }),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn boundaries(set: ParameterSet) -> Boundaries {
        let scenario = Scenario { parameters: set, ..Scenario::default() };
        let (system, _) = scenario.validate().expect("in range");
        Boundaries::new(structure(&scenario), &system)
    }

    #[test]
    fn every_map_reaches_well_above_the_tip_of_its_tongue() {
        for alpha in [1e-4, 1e-3, 3e-3] {
            let boundaries = boundaries(ParameterSet { alpha, ..Default::default() });
            for resonance in Resonance::ALL {
                let tongue = boundaries.tongue(resonance).expect("two modes");
                let lowest = tongue.coupled.iter().map(|point| point.y).fold(f64::INFINITY, f64::min);
                let ceiling = boundaries.ceiling(MapWindow::about(resonance), 1e-3);
                assert!(ceiling >= (1.5 * lowest).min(0.2), "{alpha} {resonance:?}: {lowest} of {ceiling}");
            }
        }
    }

    #[test]
    fn a_map_without_tongues_has_a_ceiling_too() {
        let boundaries = boundaries(ParameterSet { c0: 0.0, ..Default::default() });
        assert!(boundaries.gap.is_none() && boundaries.tongues.iter().all(|tongue| tongue.tip().is_none()));
        assert_eq!(boundaries.ceiling(MapWindow::First, 0.001), 0.015);
        assert!(boundaries.ceiling(MapWindow::All, 0.1) > 0.1);
    }
}
