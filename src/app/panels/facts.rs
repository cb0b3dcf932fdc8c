//! Sliders and axes of the model's numbers, as their rows say.

use crate::app::text::tr;
use crate::app::view::opening;
use crate::app::widgets::ParameterSlider;
use crate::app::widgets::number::round_significant;
use crate::export::Axis;
use crate::model::{Fact, Parameter, ParameterSet, Scale};

/// A slider over the usual values of a number, widened to the present one; `value` counts in the unit that people read.
pub(super) fn slider<'a>(fact: &'static Fact, value: &'a mut f64) -> ParameterSlider<'a> {
    slider_in(fact, fact.shown.1, value)
}

/// The same where `value` counts in a unit of which one of the number's own is so many.
pub(super) fn slider_in<'a>(fact: &'static Fact, factor: f64, value: &'a mut f64) -> ParameterSlider<'a> {
    let (low, high) = (round(factor * fact.usual.0), round(factor * fact.usual.1));
    let (low, high) = (low.min(*value), high.max(*value));
    let slider = ParameterSlider::new(tr(fact.name), fact.symbol, value, low..=high);
    spread(slider, fact, low).tooltip(tr(fact.explanation))
}

/// The slider of a parameter.
pub(super) fn of_parameter(set: &mut ParameterSet, parameter: Parameter) -> ParameterSlider<'_> {
    let default = opening().parameters.get(parameter);
    slider(parameter.fact(), set.get_mut(parameter)).default_value(default).equation("Eq. 8")
}

/// A slider that begins at `low`, spread as its number is.
pub(super) fn spread<'a>(slider: ParameterSlider<'a>, fact: &Fact, low: f64) -> ParameterSlider<'a> {
    match fact.scale {
        Scale::Linear => slider,
        Scale::LogarithmicFrom(least) if low == 0.0 => slider.logarithmic_from(fact.shown.1 * least),
        _ => slider.logarithmic(),
    }
}

/// The usual values of a number in the unit that people read.
pub(super) fn usual(fact: &Fact) -> (f64, f64) {
    (round(fact.shown.1 * fact.usual.0), round(fact.shown.1 * fact.usual.1))
}

/// Without the last digits, which are what is left of the factor.
pub(super) fn round(value: f64) -> f64 {
    round_significant(value, 12)
}

/// The axis of a number, without its unit.
pub(super) fn axis(fact: &'static Fact) -> Axis {
    Axis::new(tr(fact.title), fact.base())
}
