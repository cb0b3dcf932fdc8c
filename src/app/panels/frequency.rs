//! The frequency slider's marks.

use crate::app::map::Boundaries;
use crate::app::text::tr;
use crate::app::widgets::Mark;
use crate::model::Parameter;

/// Marks of the frequency slider, the secondary resonances first.
pub(super) fn resonance_marks(boundaries: &Boundaries) -> Vec<Mark> {
    let frequencies = &boundaries.frequencies;
    let first = frequencies[0];
    let mut marks = vec![Mark::new(
        2.0 * first,
        "2ω₁",
        tr("Twice the first natural frequency: first subharmonic resonance"),
    )];
    if let Some(second) = frequencies.get(1) {
        marks.push(Mark::new(first + second, "ω₁+ω₂", tr("Sum of the first two: combination resonance")));
        marks.push(Mark::new(2.0 * second, "2ω₂", tr("Twice the second: second subharmonic resonance")));
        marks.push(Mark::new(second - first, "ω₂−ω₁", tr("Difference of the first two: no resonance here")));
        marks.push(Mark::new(first, "ω₁", tr("First natural frequency: primary resonance")));
        marks.push(Mark::new(*second, "ω₂", tr("Second natural frequency: primary resonance")));
    } else {
        marks.push(Mark::new(first, "ω₁", tr("First natural frequency: primary resonance")));
    }
    let (lowest, highest) = Parameter::Omega.fact().usual;
    marks.retain(|mark| (lowest..=highest).contains(&mark.value));
    marks
}
