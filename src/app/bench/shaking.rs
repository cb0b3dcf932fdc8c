//! What the page asks the crew where the base is shaken by anything but the sine.

use super::Bench;
use super::recorded::BaseRecording;
use crate::app::view::View;
use crate::app::view::shake::ShakenBy;
use crate::app::widgets::number::round_significant;
use crate::model::ReducedSystem;
use crate::model::base_motion::chirp::ChirpScale;
use crate::model::base_motion::{BaseMotion, Chirp, Noise};
use crate::questions::shake::{AtLevel, Shake};
use crate::questions::shaken_run::ShakenRun;
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
/// Above so many times the model's highest own frequency a recording is cut off: there is no mode to follow it.
const BEYOND: f64 = 4.0;

/// Lowest and highest natural frequency (Hz) of the device in view; 1 where it has none.
fn own(scenario: &Scenario) -> (f64, f64) {
    let Ok(system) = scenario.model.system(scenario.parameters) else { return (1.0, 1.0) };
    let own = |pick: fn(f64, f64) -> f64, start| {
        scenario.units().hertz(system.modes.iter().map(|mode| mode.omega).fold(start, pick))
    };
    (own(f64::min, f64::INFINITY), own(f64::max, 0.0))
}

/// Lowest natural frequency (dimensionless) of a system: that by which Live counts while no sine shakes it.
pub(in crate::app) fn first(system: &ReducedSystem) -> f64 {
    system.modes.iter().map(|mode| mode.omega).fold(f64::INFINITY, f64::min)
}

/// Lowest and highest frequency (Hz) of the shaking: as chosen, or about the first own frequency and twice it; of a recording up
/// to where no mode follows.
pub(in crate::app) fn band(view: &View) -> (f64, f64) {
    let (first, last) = own(&view.scenario);
    let highest = if view.design.shake.by == ShakenBy::Recorded { BEYOND * last } else { 2.5 * first };
    let usual = [0.5 * first, highest].map(|end| round_significant(end, 2));
    let (from, to) = view.design.shake.band.unwrap_or(usual.into());
    let (low, high) = (from.min(to), from.max(to));
    (low, high.max(1.001 * low))
}

/// How long the shaking lasts (s), where it is no recording.
pub(in crate::app) fn duration(view: &View) -> f64 {
    let vibrations = if view.design.shake.by == ShakenBy::Chirp { VIBRATIONS.1 } else { VIBRATIONS.0 };
    let usual = || round_significant(vibrations / own(&view.scenario).0, 2);
    view.design.shake.duration.unwrap_or_else(usual)
}

/// The recording in view, when it has been brought.
pub(in crate::app) fn recorded<'a>(view: &View, bench: &'a Bench) -> Option<&'a BaseRecording> {
    let brought = bench.vibration.file.as_ref()?.recorded.as_ref()?;
    let wanted = view.design.shake.recording.as_ref();
    wanted.is_none_or(|wanted| wanted.checksum == brought.recording.checksum).then_some(brought)
}

/// The motion of the base at a level (g); none without the recording.
pub(in crate::app) fn motion(view: &View, bench: &Bench, level: f64) -> Option<BaseMotion> {
    Some(match view.design.shake.by {
        ShakenBy::Noise => BaseMotion::Noise(noise(view, level)),
        ShakenBy::Chirp => BaseMotion::Chirp(chirp(view, level)),
        ShakenBy::Recorded => {
            let recorded = recorded(view, bench)?;
            BaseMotion::Recorded(recorded.motion(view.design.shake.with_mean, band(view).1))
        }
    })
}

/// What shakes the Live tab in place of the sine: the same, but noise that soon begins anew, so that its level can be dragged.
pub(in crate::app) fn live(view: &View, bench: &Bench) -> Option<BaseMotion> {
    let shake = &view.design.shake;
    view.shaken()?;
    let mut motion = motion(view, bench, shake.level)?;
    if let BaseMotion::Noise(noise) = &mut motion {
        noise.duration = noise.duration.min(VIBRATIONS.0 / own(&view.scenario).0);
    }
    Some(motion)
}

/// The noise in view, at a level (g).
fn noise(view: &View, rms: f64) -> Noise {
    let (from, to) = band(view);
    Noise {
        from: Some(from),
        to: Some(to),
        rms: Some(rms),
        spectrum: None,
        duration: duration(view),
        seed: view.design.shake.seed as u64,
    }
}

/// The noise in view as the text of a file, such as an accelerometer's software writes; none where there is no such noise.
pub(in crate::app) fn noise_as_recorded(view: &View) -> Option<String> {
    let signal = noise(view, view.design.shake.level).signal(0).ok()?;
    let time: Vec<f64> = (0..signal.samples().len()).map(|i| i as f64 * signal.interval()).collect();
    Some(BaseRecording::text(&time, signal.samples()))
}

/// The chirp in view, at a level (g).
pub(in crate::app) fn chirp(view: &View, acceleration: f64) -> Chirp {
    let (from, to) = band(view);
    let scale = if view.design.shake.octaves { ChirpScale::Logarithmic } else { ChirpScale::Linear };
    Chirp { from, to, duration: duration(view), acceleration, scale, and_back: true }
}

/// What is asked about the scenario in view; its own excitation and its start play no role. Nothing without the recording.
pub(in crate::app) fn question(view: &View, bench: &Bench) -> Option<(Scenario, Shake)> {
    let noise = view.design.shake.by == ShakenBy::Noise;
    let realisations = if noise { REALISATIONS } else { 1 };
    let excitation = motion(view, bench, view.design.shake.level)?;
    let usual = Scenario::default().parameters;
    let scenario = view.scenario.forgetting(&[
        Forgotten::Start,
        Forgotten::Duration,
        Forgotten::Number(crate::model::Parameter::Beta, usual.beta),
        Forgotten::Number(crate::model::Parameter::Omega, usual.omega),
    ]);
    Some((scenario, Shake { excitation, realisations, points: POINTS }))
}

/// The runs under the shaking in view; none of a device that cannot be computed.
pub(in crate::app) fn runs(view: &View, bench: &Bench) -> Option<Table<ShakenRun>> {
    let (scenario, shake) = question(view, bench)?;
    shake.runs(&scenario).ok()
}

/// Levels (g) over which the devices are compared: round ones, so that they stay while the level in view moves a little.
pub(in crate::app) fn levels(view: &View) -> Vec<f64> {
    let middle = (f64::from(PER_DECADE) * view.design.shake.level.log10()).round() as i32;
    let level = |k: i32| round_significant(10.0_f64.powf(f64::from(middle + k) / f64::from(PER_DECADE)), 3);
    (-PER_DECADE..=PER_DECADE).map(level).collect()
}

/// The devices at these levels.
pub(in crate::app) fn over_levels(view: &View, bench: &Bench) -> Option<Table<AtLevel>> {
    let (scenario, shake) = question(view, bench)?;
    let at = |level: f64| {
        let excitation = motion(view, bench, level)?;
        Some(AtLevel { scenario: scenario.clone(), excitation, realisations: shake.realisations })
    };
    Some(Table::new(levels(view).into_iter().filter_map(at).collect()))
}
