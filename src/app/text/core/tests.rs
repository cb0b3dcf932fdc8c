use proc_macro2::{TokenStream, TokenTree};

use super::*;
use crate::app::link;
use crate::app::text::{Language, install, reset};
use crate::app::view::View;
use crate::dynamics::attractors::motion::Undecided;
use crate::dynamics::attractors::verdict::{Coexisting, OtherStart, Warning};
use crate::model::ModelError;
use crate::questions::design::measured::MeasuredError;

#[test]
fn values_are_found_between_the_words() {
    let values =
        values_in("line {line}, column {column}: \"{content}\" is no", "line 4, column 2: \"a: b\" is no");
    assert_eq!(values, Some(vec![("line", "4"), ("column", "2"), ("content", "a: b")]));
    assert_eq!(values_in("period {periods}", "quasiperiodic"), None);
    assert_eq!(values_in("chaotic", "chaotic, almost"), None);
    assert_eq!(values_in("chaotic", "chaotic"), Some(vec![]));
}

/// What of a text has no translation: its values, where every sentence in it is known. That all sentences are in both
/// catalogues is a test of its own (`tests/fast/texts.rs`).
fn leaves(text: &str) -> Vec<&str> {
    match SENTENCES.iter().find_map(|sentence| values_in(sentence, text)) {
        Some(values) => values.into_iter().flat_map(|(_, value)| leaves(value)).collect(),
        None => vec![text],
    }
}

/// Whether there are words among what is left, and not only numbers, symbols and the names in `allowed`.
fn has_words(left: &str, allowed: &[&str]) -> bool {
    let words = left.split(|letter: char| !letter.is_ascii_lowercase());
    words.into_iter().any(|word| word.len() > 2 && !allowed.contains(&word))
}

/// The tokens of a source before its tests, without brackets.
fn source(path: &str) -> Vec<String> {
    let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join(path);
    let whole = std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    let code = whole.split("#[cfg(test)]").next().unwrap_or_default();
    flat(code.parse().unwrap_or_else(|error| panic!("{}: {error}", path.display())))
}

fn flat(code: TokenStream) -> Vec<String> {
    let tokens = code.into_iter().flat_map(|token| match token {
        TokenTree::Group(group) => flat(group.stream()),
        token => vec![token.to_string()],
    });
    tokens.collect()
}

/// The texts in a source that stand right after these tokens.
fn texts(source: &[String], after: &[&str]) -> Vec<String> {
    let found = source.windows(after.len() + 1).filter(|tokens| tokens[..after.len()] == *after);
    let texts = found.filter_map(|tokens| syn::parse_str::<syn::LitStr>(&tokens[after.len()]).ok());
    texts.map(|text| text.value()).collect()
}

/// A text with its places filled by a number.
fn filled(text: &str) -> String {
    let mut parts = text.split('{');
    let first = parts.next().unwrap_or_default().to_owned();
    parts.fold(first, |filled, part| filled + "7" + part.split_once('}').map_or(part, |(_, rest)| rest))
}

/// Names of fields that stand in errors.
const FIELDS: [&str; 2] = ["mode", "periods"];

/// The reasons for which the core refuses, as they stand in its sources: one that is new there is missed here.
#[test]
fn every_error_of_the_core_is_known() {
    let (mut said, mut files) = (Vec::new(), Vec::new());
    let mut folders = vec!["solver/src".to_owned(), "src/questions/design".to_owned()];
    while let Some(folder) = folders.pop() {
        let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join(&folder);
        for entry in std::fs::read_dir(path).expect("a folder") {
            let entry = entry.expect("an entry");
            let name = format!("{folder}/{}", entry.file_name().to_string_lossy());
            if entry.path().is_dir() { folders.push(name) } else { files.push(name) }
        }
    }
    // The spectrum is asked for by the core itself, always with what it takes.
    for file in files.iter().filter(|file| *file != "solver/src/dynamics/attractors/spectrum.rs") {
        said.extend(texts(&source(file), &["#", "error"]));
    }
    assert!(said.len() > 30, "{said:?}");
    let unknown: Vec<&String> = said
        .iter()
        .filter(|text| leaves(&filled(text)).iter().any(|left| has_words(left, &FIELDS)))
        .collect();
    assert!(unknown.is_empty(), "{unknown:#?}");
}

/// Evidence is put together from pieces: the words of each stand in a sentence here.
#[test]
fn every_piece_of_evidence_is_known() {
    let source = source("solver/src/dynamics/attractors/evidence.rs");
    let unsaid = ["doc", "rename_all"].map(|name| texts(&source, &[name, "="])).concat();
    let texts: Vec<String> = texts(&source, &[]).into_iter().filter(|text| !unsaid.contains(text)).collect();
    assert!(texts.len() > 20, "{texts:?}");
    let names = ["run: ", "multipliers: ", "spectrum: "];
    for text in &texts {
        let text = names.iter().find_map(|name| text.strip_prefix(name)).unwrap_or(text);
        for words in filled(text).split('7').filter(|words| has_words(words, &[])) {
            let known = SENTENCES.iter().any(|sentence| filled(sentence).contains(words));
            assert!(known, "{words:?} of {text:?}");
        }
    }
}

#[test]
fn names_of_bifurcation_points_are_known() {
    let source = source("solver/src/dynamics/bifurcations/curves/curve.rs");
    let names = texts(&source, &["=", ">"]);
    assert_eq!(names.len(), 11, "{names:?}");
    for name in names {
        assert!(leaves(&name).iter().all(|left| !has_words(left, &[])), "{name}");
    }
}

/// One entry of every kind, and whatever else can be wrong with a link.
#[test]
fn what_is_wrong_with_a_link_is_said_in_known_words() {
    let names = "beta modes force initial t_end resistance beam_length repelling ceramic device scaling tab map layer \
        sweep.range sweep.count sweep.dwell.kept sweep.output plane figure enlarged design.page design.least \
        design.limits.voltage design.quantity design.search.aim live.trace live.speed live.periods lesson step lang v";
    let mut problems = Vec::new();
    for name in names.split_whitespace() {
        for text in ["", "x", "1e30", "1 2 3", "-1", "omega+omega", "taylor99"] {
            problems.extend(link::read(&format!("tab=sweep&{name}={text}"), &View::default()).1);
        }
    }
    assert!(problems.len() > 150, "{} problems", problems.len());
    // What is left of a list of names are names.
    let is_sentence = |left: &str| left.split(", ").any(|part| part.contains(' ') && has_words(part, &[]));
    let mut unknown: Vec<String> = problems
        .iter()
        .filter(|problem| leaves(&problem.reason).iter().any(|left| is_sentence(left)))
        .map(ToString::to_string)
        .collect();
    unknown.dedup();
    assert!(unknown.is_empty(), "{unknown:#?}");
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
        Undecided::MayBeTransient,
        Undecided::DependsOnRounding,
    ];
    let mut said: Vec<String> = whys.iter().map(|why| Motion::Undecided { why: *why }.to_string()).collect();
    let escape = Motion::Escape { time: 2.5 };
    let motions = [Motion::Periodic { periods: 2 }, Motion::Quasiperiodic, Motion::Chaotic, escape];
    said.extend(motions.iter().map(ToString::to_string));
    said.push(Motion::Contact { time: 2.5 }.to_string());
    for start in [OtherStart::ForcedMotion, OtherStart::Rest, OtherStart::Beside, OtherStart::OnTheWay] {
        said.push(Coexisting { start, motion: motions[0], v_rms: 2.0, power: 1e-6 }.to_string());
    }
    for warning in [
        Warning::TransientLeft { fraction: 0.01 },
        Warning::TransientChaos { time: 900.0 },
        Warning::WouldTake { time: 900.0 },
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
    let catalogue =
        r#"{"undecided: {why}":"offen: {why}","the evidence disagrees":"die Befunde widersprechen sich"}"#;
    install(Language::German, catalogue).expect("a catalogue");
    let german = reworded(english);
    reset();
    assert_eq!(german, "offen: die Befunde widersprechen sich");
}

#[test]
fn every_point_of_codimension_two_has_its_name() {
    for kind in crate::dynamics::bifurcations::curves::SpecialKind::ALL {
        let name = kind.to_string();
        assert!(!leaves(&name).contains(&name.as_str()), "{name}");
    }
}
