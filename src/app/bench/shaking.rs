//! What the page Shake asks the crew.

use crate::app::view::View;
use crate::app::view::shake::ShakenBy;
use crate::app::widgets::number::round_significant;
use crate::model::base_motion::chirp::ChirpScale;
use crate::model::base_motion::{BaseMotion, Chirp, Noise};
use crate::questions::shake::{AtLevel, Shake, ShakenRun};
use crate::scenario::{Forgotten, Scenario};
use crate::scheduler::Table;

/// Realisations of the noise in view, and of each level.
const REALISATIONS: usize = 4;
/// Points of a voltage over time.
const POINTS: usize = 3000;
/// Levels over which the devices are compared, in each decade, and decades below and above the one in view.
const PER_DECADE: i32 = 4;
/// Vibrations of the first mode that a run takes: under noise, so that most of them count, and in a chirp, so that it is slow.
const VIBRATIONS: (f64, f64) = (400.0, 1200.0);

/// First natural frequency (Hz) of the device in view; 1 where it has none.
fn first(scenario: &Scenario) -> f64 {
    let system = scenario.model.system(scenario.parameters).ok();
    let lowest =
        system.map(|system| system.modes.iter().map(|mode| mode.omega).fold(f64::INFINITY, f64::min));
    lowest.map_or(1.0, |omega| scenario.units().hertz(omega))
}

/// Lowest and highest frequency (Hz) of the shaking: as chosen, or about the first own frequency and twice it.
pub(in crate::app) fn band(view: &View) -> (f64, f64) {
    let first = first(&view.scenario);
    let usual = [0.5 * first, 2.5 * first].map(|end| round_significant(end, 2));
    let (from, to) = view.design.shake.band.unwrap_or(usual.into());
    let (low, high) = (from.min(to), from.max(to));
    (low, high.max(1.001 * low))
}

/// How long the shaking lasts (s).
pub(in crate::app) fn duration(view: &View) -> f64 {
    let vibrations = if view.design.shake.by == ShakenBy::Noise { VIBRATIONS.0 } else { VIBRATIONS.1 };
    view.design.shake.duration.unwrap_or_else(|| round_significant(vibrations / first(&view.scenario), 2))
}

/// The motion of the base at a level (g).
fn motion(view: &View, level: f64) -> BaseMotion {
    let shake = &view.design.shake;
    let ((from, to), duration) = (band(view), duration(view));
    match shake.by {
        ShakenBy::Noise => BaseMotion::Noise(Noise {
            from: Some(from),
            to: Some(to),
            rms: Some(level),
            spectrum: None,
            duration,
            seed: shake.seed as u64,
        }),
        ShakenBy::Chirp => BaseMotion::Chirp(chirp(view, level)),
    }
}

/// The chirp in view, at a level (g).
pub(in crate::app) fn chirp(view: &View, acceleration: f64) -> Chirp {
    let (from, to) = band(view);
    let scale = if view.design.shake.octaves { ChirpScale::Logarithmic } else { ChirpScale::Linear };
    Chirp { from, to, duration: duration(view), acceleration, scale, and_back: true }
}

/// What is asked about the scenario in view; its own excitation and its start play no role.
pub(in crate::app) fn question(view: &View) -> (Scenario, Shake) {
    let noise = view.design.shake.by == ShakenBy::Noise;
    let realisations = if noise { REALISATIONS } else { 1 };
    let excitation = motion(view, view.design.shake.level);
    let usual = Scenario::default().parameters;
    let scenario = view.scenario.forgetting(&[
        Forgotten::Start,
        Forgotten::Duration,
        Forgotten::Number(crate::model::Parameter::Beta, usual.beta),
        Forgotten::Number(crate::model::Parameter::Omega, usual.omega),
    ]);
    (scenario, Shake { excitation, realisations, points: POINTS })
}

/// The runs under the shaking in view; none of a device that cannot be computed.
pub(in crate::app) fn runs(view: &View) -> Option<Table<ShakenRun>> {
    let (scenario, shake) = question(view);
    shake.runs(&scenario).ok()
}

/// Levels (g) over which the devices are compared: round ones, so that they stay while the level in view moves a little.
pub(in crate::app) fn levels(view: &View) -> Vec<f64> {
    let middle = (f64::from(PER_DECADE) * view.design.shake.level.log10()).round() as i32;
    let level = |k: i32| round_significant(10.0_f64.powf(f64::from(middle + k) / f64::from(PER_DECADE)), 3);
    (-PER_DECADE..=PER_DECADE).map(level).collect()
}

/// The devices at these levels.
pub(in crate::app) fn over_levels(view: &View) -> Table<AtLevel> {
    let (scenario, shake) = question(view);
    let at = |level: f64| AtLevel {
        scenario: scenario.clone(),
        excitation: motion(view, level),
        realisations: shake.realisations,
    };
    Table::new(levels(view).into_iter().map(at).collect())
}
