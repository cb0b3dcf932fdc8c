//! What the core says in English, in the reader's language.
//!
//! The core knows no languages: its sentences stand in the JSON of the native command and come from workers as texts.
//! Here each is known by the words between its values. One that is not known stays English.

use super::{fill_with, is_english, marked, tr};
use crate::dynamics::motion::Motion;

/// The sentences, the more special before the more general. A value may be another sentence.
const SENTENCES: [&str; 66] = [
    // Motions.
    marked("a start on the stable forced motion leads to another motion: {motion}, {volts} V rms"),
    marked("a start at rest leads to another motion: {motion}, {volts} V rms"),
    marked(
        "period {periods} stable, largest modulus {modulus}; the run ends {distance} of the amplitude from it",
    ),
    marked(
        "period {periods} unstable, largest modulus {modulus}; the run ends {distance} of the amplitude from it",
    ),
    marked("period {periods}"),
    marked("quasiperiodic"),
    marked("chaotic"),
    marked("escape at t = {time}"),
    marked("contact at t = {time}"),
    marked("undecided: {why}"),
    marked("undecided"),
    marked("the transient has not gone: the run ends {percent} % of the amplitude away"),
    marked("the transient has not gone"),
    marked("the run is still near an unstable periodic motion"),
    marked("the Lyapunov exponent has not converged"),
    marked("the exponent is zero, but the stroboscopic points lie on no closed curves"),
    marked("the motion is too fast to differentiate"),
    marked("the evidence disagrees"),
    // Warnings.
    marked("the force law is {percent} % too weak at closest approach"),
    marked("the force law is {percent} % too strong at closest approach"),
    marked("the tip passes through the magnet: only the exact force law knows of contact"),
    marked("the tip moves by {part} of the beam's length, where the beam is no linear one"),
    marked("the escape is over the barrier of the truncated force law; the exact one has none"),
    marked("the motion that grows from rest with beta can be followed to beta = {beta} only"),
    marked("the forced motion could not be computed"),
    // Evidence.
    marked("{text}: a multiple of {periods}, as they spiral in"),
    marked("{text}, still settling"),
    marked("stroboscopic points repeat after 1 period to {part}"),
    marked("stroboscopic points repeat after {periods} periods to {part}"),
    marked("stroboscopic points do not repeat within 8 periods (off by {part})"),
    marked("stroboscopic points lie on closed curves: dimension {dimension}"),
    marked("stroboscopic points fill a surface: dimension {dimension}"),
    marked("stroboscopic points are scattered: dimension {dimension}"),
    marked("{text}; by the multipliers {value}"),
    marked("exponent {value}: zero"),
    marked("exponent {value}, not converged"),
    marked("exponent {value}"),
    marked("no voltage"),
    marked("{percent} % of its power between the lines"),
    // Points where curves of bifurcations meet.
    marked("cusp"),
    marked("{ratio} resonance"),
    marked("fold-flip"),
    marked("fold-Neimark-Sacker"),
    marked("flip-Neimark-Sacker"),
    marked("double Neimark-Sacker"),
    marked("generalized period doubling"),
    // What is wrong with a device.
    marked(
        "the magnets attract so strongly that the tip has no equilibrium (pull-in): with c0 = {c0} and h = {h} the gap d = {d} must be larger than {smallest}",
    ),
    marked(
        "the magnet softens the beam past buckling: c1 = {c1} must be greater than -3, the stiffness of the beam's tip",
    ),
    marked("under gravity the tip sags {sag} m, which closes the magnets' distance of {distance} m"),
    marked("{field} = {value} is out of range: allowed are {from} to {to}"),
    marked("{field} is not a finite number: allowed are {from} to {to}"),
    marked("both sides of the chart are {field}: they must differ"),
    // What is wrong with a file or a link.
    marked("the file is empty"),
    marked("no row with at least two numbers in the first {lines} lines; line 1 is \"{first}\""),
    marked("line {line} has {fields} fields, column {column} is missing: \"{content}\""),
    marked("line {line}, column {column}: \"{content}\" is not a finite number"),
    marked("line {line} cannot be read: {problem}"),
    marked("{field} = {value} is not available: {allowed}"),
    marked("not a number; {allowed}"),
    marked("allowed are whole numbers from {from} to {to}"),
    marked("allowed are {from} to {to}"),
    marked("allowed are {words}"),
    marked("not valid JSON: {problem}"),
    marked("not a name this page knows"),
    marked("this page knows version {version}"),
    // The page's own.
    marked("There is no curve for this device."),
];

/// The class of a motion.
pub fn motion_in_words(motion: Motion) -> String {
    reworded(&motion.to_string())
}

/// A sentence of the core in the reader's language, or as it is.
pub fn reworded(english: &str) -> String {
    if is_english() {
        return english.to_owned();
    }
    for sentence in SENTENCES {
        if let Some(values) = values_in(sentence, english) {
            return fill_with(tr(sentence), values.iter().map(|(name, value)| (*name, reworded(value))));
        }
    }
    english.to_owned()
}

/// The values of a sentence by their names, if `text` is that sentence.
fn values_in<'a>(sentence: &'static str, text: &'a str) -> Option<Vec<(&'static str, &'a str)>> {
    let mut values = Vec::new();
    let (head, mut ahead) = sentence.split_once('{').unwrap_or((sentence, ""));
    let mut rest = text.strip_prefix(head)?;
    while let Some((name, after)) = ahead.split_once('}') {
        let (words, next) = after.split_once('{').unwrap_or((after, ""));
        let value;
        (value, rest) =
            if next.is_empty() { (rest.strip_suffix(words)?, "") } else { rest.split_once(words)? };
        values.push((name, value));
        ahead = next;
    }
    rest.is_empty().then_some(values)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::text::{Language, install, reset};
    use crate::dynamics::motion::Undecided;
    use crate::dynamics::verdict::{Coexisting, OtherStart, Warning};
    use crate::jobs::design::measured::MeasuredError;
    use crate::model::ModelError;

    #[test]
    fn values_are_found_between_the_words() {
        let values = values_in(
            "line {line}, column {column}: \"{content}\" is no",
            "line 4, column 2: \"a: b\" is no",
        );
        assert_eq!(values, Some(vec![("line", "4"), ("column", "2"), ("content", "a: b")]));
        assert_eq!(values_in("period {periods}", "quasiperiodic"), None);
        assert_eq!(values_in("chaotic", "chaotic, almost"), None);
        assert_eq!(values_in("chaotic", "chaotic"), Some(vec![]));
    }

    /// Whatever of these the core can say is known here: the words of both must not drift apart.
    #[test]
    fn sentences_of_the_core_are_known() {
        let whys = [
            Undecided::TransientNotGone,
            Undecided::NearUnstable,
            Undecided::ExponentOpen,
            Undecided::PointsScattered,
            Undecided::Unresolved,
            Undecided::EvidenceDisagrees,
        ];
        let mut said: Vec<String> =
            whys.iter().map(|why| Motion::Undecided { why: *why }.to_string()).collect();
        let escape = Motion::Escape { time: 2.5 };
        let motions = [Motion::Periodic { periods: 2 }, Motion::Quasiperiodic, Motion::Chaotic, escape];
        said.extend(motions.iter().map(ToString::to_string));
        said.push(Motion::Contact { time: 2.5 }.to_string());
        for start in [OtherStart::ForcedMotion, OtherStart::Rest] {
            said.push(Coexisting { start, motion: motions[0], v_rms: 2.0, power: 1e-6 }.to_string());
        }
        for warning in [
            Warning::TransientLeft { fraction: 0.01 },
            Warning::ForceLaw { missing: 0.2 },
            Warning::ForceLaw { missing: -0.2 },
            Warning::PassesMagnet,
            Warning::LargeDeflection { tip: 0.4 },
            Warning::TruncatedBarrier,
            Warning::ForcedMotionEnds { beta: 0.01 },
            Warning::ForcedMotionUnknown,
        ] {
            said.push(warning.to_string());
        }
        let (field, minimum, maximum) = (|| "beta".to_owned(), 0.0, 0.2);
        for error in [
            ModelError::OutOfRange { field: field(), value: 7.0, minimum, maximum, unit: " mm" },
            ModelError::NotFinite { field: field(), minimum, maximum, unit: "" },
            ModelError::Count { field: "modes", value: 9, minimum: 1, maximum: 8 },
            ModelError::SameSides { field: field() },
            ModelError::PullIn { c0: -0.5, d: 0.1, h: 0.2, smallest: 0.3 },
            ModelError::Buckled { c1: -4.0 },
            ModelError::GapClosed { sag: 0.2, distance: 0.1 },
        ] {
            said.push(error.to_string());
        }
        let content = || "x".to_owned();
        for error in [
            MeasuredError::Empty,
            MeasuredError::NoNumbers { lines: 40, first: content() },
            MeasuredError::Choice { field: "x", value: 3.0, allowed: content() },
            MeasuredError::Missing { line: 3, fields: 1, column: 2, content: content() },
            MeasuredError::Number { line: 3, column: 2, content: content() },
            MeasuredError::Text { line: 3, problem: content() },
        ] {
            said.push(error.to_string());
        }
        let catalogue: std::collections::BTreeMap<&str, String> =
            SENTENCES.iter().map(|sentence| (*sentence, format!("» {sentence}"))).collect();
        let catalogue = serde_json::to_string(&catalogue).expect("plain texts");
        install(Language::German, &catalogue).expect("a catalogue");
        let unknown: Vec<String> = said.into_iter().filter(|text| reworded(text) == *text).collect();
        reset();
        assert_eq!(unknown, Vec::<String>::new());
    }

    #[test]
    fn english_stays_as_it_is_and_sentences_within_sentences_are_reworded() {
        let english = "undecided: the evidence disagrees";
        assert_eq!(reworded(english), english);
        let catalogue = r#"{"undecided: {why}":"offen: {why}","the evidence disagrees":"die Befunde widersprechen sich"}"#;
        install(Language::German, catalogue).expect("a catalogue");
        let german = reworded(english);
        reset();
        assert_eq!(german, "offen: die Befunde widersprechen sich");
    }
}
