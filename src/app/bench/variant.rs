//! Variants of a design, pinned to be compared: each with the curve that says what it gives.

use std::rc::Rc;

use serde::{Deserialize, Serialize};
use serde_json::Value;

use super::{chosen_limits, questions};
use crate::app::crew::Studies;
use crate::app::session::Session;
use crate::app::view::View;
use crate::dynamics::Measures;
use crate::questions::design::band::half_power;
use crate::questions::design::load::best;
use crate::questions::design::point::powers;
use crate::questions::design::{Bounds, HarvestPoint, Interval};
use crate::questions::harvest::HarvestStudy;
use crate::questions::input;
use crate::questions::load::LoadStudy;
use crate::scenario::Scenario;
use crate::scheduler::{Asked as _, Study as _};

/// Most variants that are pinned at once.
pub(in crate::app) const MOST: usize = 4;
/// Points of a curve from which some are left out.
const POINTS: usize = 400;
/// Letters of a name.
pub(in crate::app) const LETTERS: usize = 24;
/// Its entry among what is stored.
const ENTRY: &str = "variants";

/// A design with what it gives over frequency.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(in crate::app) struct Variant {
    /// What the user calls it; empty for the present design.
    pub name: String,
    /// The design.
    pub scenario: Scenario,
    /// Whether the acceleration of the base is held over the frequencies, or else its amplitude.
    pub holds_acceleration: bool,
    /// Lowest and highest frequency (Hz) of its curve.
    pub window: (f64, f64),
    /// Distance of the magnets at rest (beam lengths); none without magnets.
    gap: Option<f64>,
    /// Pieces of the curve: frequency (Hz), v_rms, v_peak (V), power (W), lowest and highest tip (mm), slope (rad), power
    /// per g² (W/g²).
    curve: Vec<Vec<[f64; 8]>>,
    /// Best load (ohm) at its own frequency, with the power (W) there.
    pub load: Option<[f64; 2]>,
}

/// The curve that says what a device gives: its stable periodic motions, or where there are none what rest leads to;
/// none until that is known.
pub(in crate::app) fn best_curve(study: &HarvestStudy) -> Option<Vec<Vec<HarvestPoint>>> {
    let stable = study.stable_pieces();
    if !stable.is_empty() {
        return Some(stable);
    }
    study.finished().then(|| study.rest_pieces())
}

/// The point of most power.
pub(in crate::app) fn highest(pieces: &[Vec<HarvestPoint>]) -> Option<HarvestPoint> {
    pieces.iter().flatten().copied().max_by(|a, b| a.measures.power.total_cmp(&b.measures.power))
}

impl Variant {
    /// The present design as far as it is known, and whether all of it is.
    pub(in crate::app) fn present(view: &View, session: &Session, studies: &Studies) -> Option<(Self, bool)> {
        let study = studies.lanes.study::<HarvestStudy>()?;
        let (scenario, question, _) = questions::harvest(view, session);
        let current = *study.asked() == (scenario, question) && study.failure().is_none();
        let pieces = best_curve(study).filter(|_| current)?;
        let limits = chosen_limits(view).completed(&view.scenario.base());
        let gap = session.boundaries.as_ref()?.gap;
        let bounds = Bounds { limits, gap, units: view.scenario.units() };
        let loads = studies.lanes.study::<LoadStudy>();
        let loads = loads.filter(|loads| loads.finished() && *loads.asked() == questions::load(view));
        let load = loads.and_then(|loads| {
            let reached = loads.reached().iter().flatten().copied();
            let within = best(reached.clone().filter(|point| bounds.allows(&point.measures)));
            within.or_else(|| best(reached)).map(|best| [best.resistance, best.measures.power])
        });
        let all = study.finished() && loads.is_some();
        let (scenario, holds_acceleration) = (view.scenario.clone(), view.design.holds_acceleration);
        let curve = thinned(&pieces);
        let (name, window) = (String::new(), study.window());
        Some((Self { name, scenario, holds_acceleration, window, gap, curve, load }, all))
    }

    /// Its curve in pieces.
    pub(in crate::app) fn pieces(&self) -> Vec<Vec<HarvestPoint>> {
        let point = |[frequency, v_rms, v_peak, power, low, high, slope, power_per_g2]: &[f64; 8]| {
            let measures =
                Measures { v_rms: *v_rms, v_peak: *v_peak, power: *power, tip: (*low, *high), slope: *slope };
            HarvestPoint { frequency: *frequency, measures, power_per_g2: *power_per_g2 }
        };
        self.curve.iter().map(|piece| piece.iter().map(point).collect()).collect()
    }

    /// Its limits, as they are chosen in `view` for all.
    pub(in crate::app) fn bounds(&self, view: &View) -> Bounds {
        let limits = chosen_limits(view).completed(&self.scenario.base());
        Bounds { limits, gap: self.gap, units: self.scenario.units() }
    }

    /// Where it gives most, and about that where it gives at least half as much; none where no motion lasts.
    pub(in crate::app) fn best(&self) -> Option<(HarvestPoint, Option<Interval>)> {
        let pieces = self.pieces();
        Some((highest(&pieces)?, half_power(&powers(&pieces))))
    }

    /// Whether it is the same design, whatever its name.
    pub(in crate::app) fn is_same(&self, other: &Self) -> bool {
        (&self.scenario, self.holds_acceleration, self.window)
            == (&other.scenario, other.holds_acceleration, other.window)
    }

    /// Whether it can be shown.
    fn is_sound(&self) -> bool {
        let (low, high) = self.window;
        self.scenario.validate().is_ok()
            && self.name.chars().count() <= LETTERS
            && low > 0.0
            && high > low
            && self.curve.iter().map(Vec::len).sum::<usize>() <= 2 * POINTS
    }
}

/// Fewer points where there are many: the ends and the highest stay.
fn thinned(pieces: &[Vec<HarvestPoint>]) -> Vec<Vec<[f64; 8]>> {
    let every = pieces.iter().map(Vec::len).sum::<usize>().div_ceil(POINTS).max(1);
    let top = highest(pieces).map_or(0.0, |point| point.measures.power);
    let numbers = |point: &HarvestPoint| {
        let Measures { v_rms, v_peak, power, tip, slope } = point.measures;
        [point.frequency, v_rms, v_peak, power, tip.0, tip.1, slope, point.power_per_g2]
    };
    let thin = |piece: &Vec<HarvestPoint>| {
        let kept = piece.iter().enumerate().filter(|(index, point)| {
            index % every == 0 || index + 1 == piece.len() || point.measures.power >= top
        });
        kept.map(|(_, point)| numbers(point)).collect()
    };
    // A curve of very many pieces has ends enough.
    pieces.iter().take(POINTS / 4).map(thin).collect()
}

/// What the user does with variants.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::app) enum Change {
    /// Pin the present design.
    Pin,
    /// Put that of this index away.
    Remove(usize),
    /// Call it so.
    Rename(usize, String),
    /// Make it the present design.
    Restore(usize),
}

/// A name that none of them has.
pub(in crate::app) fn free_name(variants: &[Variant]) -> String {
    let free = ('A'..='Z').find(|letter| variants.iter().all(|one| one.name != letter.to_string()));
    free.unwrap_or('A').to_string()
}

/// Those of an earlier session, less what cannot be used.
pub(in crate::app) fn restore(stored: Option<&str>) -> Rc<Vec<Variant>> {
    let value: Value = stored.and_then(|text| serde_json::from_str(text).ok()).unwrap_or_default();
    let all = value.get(ENTRY).and_then(Value::as_array).into_iter().flatten();
    let read = all.filter_map(|one| input::fields::<Variant>(one).ok()).filter(Variant::is_sound);
    Rc::new(read.take(MOST).collect())
}

/// Adds them to what is stored.
pub(in crate::app) fn store(variants: &[Variant], stored: &mut Value) {
    let entries = stored.as_object_mut().filter(|_| !variants.is_empty());
    let text = serde_json::to_string(variants).ok();
    if let (Some(entries), Some(all)) = (entries, text.and_then(|text| serde_json::from_str(&text).ok())) {
        entries.insert(ENTRY.to_owned(), all);
    }
}
