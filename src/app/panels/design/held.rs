//! What of the base's motion is held while its frequency changes, in words.

use crate::app::bench::questions;
use crate::app::text::fill;
use crate::app::view::View;
use crate::app::widgets::number::significant;
use crate::model::Shaking;

/// How the base is shaken over the frequencies: `at 0.155 g`, or `at 4.80 mm`.
pub(super) fn held(view: &View) -> String {
    let (units, p) = (view.scenario.units(), view.scenario.parameters);
    let what = match questions::shaking(view) {
        Shaking::Acceleration => format!("{} g", significant(units.acceleration(p.beta, p.omega), 3)),
        Shaking::Amplitude => format!("{} mm", significant(units.millimetres(p.beta), 3)),
    };
    fill("at {what}", &[("what", &what)])
}
