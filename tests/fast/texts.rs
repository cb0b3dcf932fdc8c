//! The catalogues hold exactly what the page says, and the fonts hold what the catalogues say.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

use harvester_lab::app::fonts::{self, regular};
use harvester_lab::app::lessons::LessonId;
use harvester_lab::app::text::page;
use harvester_lab::model::{Dimension, Parameter};
use proc_macro2::{Delimiter, TokenStream, TokenTree};
use syn::Lit;

type Catalogue = BTreeMap<String, String>;

/// What asks for a text of the catalogue.
const CALLS: [&str; 4] = ["tr", "fill", "marked", "said"];

fn project(path: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(path)
}

fn read(path: &Path) -> String {
    fs::read_to_string(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

fn catalogue(code: &str) -> Catalogue {
    serde_json::from_str(&read(&project(&format!("assets/text/{code}.json")))).expect("texts by texts")
}

fn sources(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).expect("a folder") {
        let path = entry.expect("an entry").path();
        if path.is_dir() {
            sources(&path, found);
        } else if path.extension().is_some_and(|kind| kind == "rs") && !path.ends_with("tests.rs") {
            found.push(path);
        }
    }
}

/// The literals that follow one of [`CALLS`], outside of tests.
fn texts(code: TokenStream) -> Vec<String> {
    let tokens: Vec<TokenTree> = code.into_iter().collect();
    let (mut found, mut tests) = (Vec::new(), false);
    for (i, token) in tokens.iter().enumerate() {
        let TokenTree::Group(group) = token else {
            tests &= token.to_string() != ";";
            continue;
        };
        let before = i.checked_sub(1).map(|before| tokens[before].to_string()).unwrap_or_default();
        if before == "#" {
            tests |= group.stream().to_string().replace(' ', "") == "cfg(test)";
        } else if group.delimiter() == Delimiter::Brace && std::mem::take(&mut tests) {
            continue;
        }
        if CALLS.contains(&before.as_str())
            && let Some(TokenTree::Literal(first)) = group.stream().into_iter().next()
            && let Lit::Str(text) = Lit::new(first)
        {
            found.push(text.value());
        }
        found.extend(texts(group.stream()));
    }
    found
}

/// The texts in the sources, each with a file that says it.
fn said() -> BTreeMap<String, String> {
    let mut files = Vec::new();
    for folder in ["src", "solver/src"] {
        sources(&project(folder), &mut files);
    }
    let mut said = BTreeMap::new();
    for file in files {
        let code = read(&file).parse().unwrap_or_else(|error| panic!("{}: {error}", file.display()));
        said.extend(texts(code).into_iter().map(|text| (text, file.display().to_string())));
    }
    let facts = Parameter::ALL.map(Parameter::fact).into_iter().chain(Dimension::ALL.map(Dimension::fact));
    for fact in facts {
        said.extend(
            [fact.name, fact.title, fact.explanation].map(|text| (text.to_owned(), fact.field.to_owned())),
        );
    }
    assert!(said.len() > 700, "only {} texts were found", said.len());
    said
}

/// An error of the solver or of a design question would reach the page in English, if its words stood in an attribute. The
/// spectrum is asked for by the solver itself, always with what it takes.
#[test]
fn what_the_solver_says_can_be_translated() {
    let mut files = Vec::new();
    for folder in ["solver/src", "src/questions/design"] {
        sources(&project(folder), &mut files);
    }
    let mut errors = 0;
    for file in files.iter().filter(|file| !file.ends_with("attractors/spectrum.rs")) {
        let code = read(file);
        for (_, after) in code.match_indices("#[error(").map(|(at, call)| code[at..].split_at(call.len())) {
            assert!(after.starts_with("\"{}\", self.say())]"), "{}: {after:.60}", file.display());
            errors += 1;
        }
    }
    assert!(errors > 8, "only {errors} kinds of errors were found");
}

/// The names in braces. A lone brace is none.
fn places(text: &str) -> BTreeSet<&str> {
    let parts = text.split('{').skip(1).filter_map(|part| part.split_once('}'));
    parts.map(|(name, _)| name).collect()
}

#[test]
fn every_text_is_in_every_catalogue_and_nothing_else_is() {
    let said = said();
    for code in ["de", "zh"] {
        let catalogue = catalogue(code);
        let missing: Vec<_> = said.iter().filter(|(text, _)| !catalogue.contains_key(*text)).collect();
        assert!(missing.is_empty(), "{code} lacks {missing:#?}");
        let unused: Vec<_> = catalogue.keys().filter(|text| !said.contains_key(*text)).collect();
        assert!(unused.is_empty(), "nobody says what {code} translates: {unused:#?}");
        for (english, translation) in &catalogue {
            assert!(!translation.trim().is_empty(), "{code}: {english:?} is empty");
            assert_eq!(places(english), places(translation), "{code}: {english:?}");
            let blanks = |text: &str| (text.starts_with(' '), text.ends_with(' '));
            if code == "de" {
                assert_eq!(blanks(english), blanks(translation), "{code}: {english:?}");
            }
        }
    }
}

#[test]
fn the_texts_of_the_markup_are_those_of_the_page() {
    let shell = ["index.html", "assets/shell/start.js", "assets/shell/mirror.js", "assets/shell/offline.js"];
    let markup: String = shell.iter().map(|path| read(&project(path))).collect();
    for text in page::TEXTS {
        assert!(markup.contains(text), "{text:?} does not stand in the page's markup");
    }
    // And the other way round: what is between tags, but for the page's own name.
    let html = read(&project("index.html"));
    let body = html.split_once("<body>").expect("a body").1;
    let texts = body.split('>').filter_map(|part| part.split('<').next()).map(str::trim);
    let known: BTreeSet<&str> = page::TEXTS.into_iter().collect();
    let named = ["Harvester Lab", "This page computes in your browser and needs JavaScript and WebAssembly."];
    // What is shown when no script runs stands there in every language.
    let late = body.split_once("<div id=\"late\">").and_then(|(_, rest)| rest.split_once("</div>"));
    let late = late.expect("what is shown without scripts").0;
    for code in ["en", "de", "zh"] {
        assert!(late.contains(&format!("<p lang=\"{code}\">")), "{code}");
    }
    let unknown: Vec<&str> = texts
        .filter(|text| {
            !text.is_empty() && !known.contains(text) && !named.contains(text) && !late.contains(*text)
        })
        .collect();
    assert!(unknown.is_empty(), "not in the catalogue: {unknown:?}");
}

/// What the page says of itself when it cannot start, and so has no catalogue.
#[test]
fn the_early_texts_are_whole_and_those_of_the_catalogues() {
    let script = read(&project("assets/shell/start.js"));
    let said = ["fail(\"", "say(\""].into_iter().flat_map(|call| {
        script.match_indices(call).filter_map(|(at, call)| {
            // Its texts are written as in JSON.
            serde_json::Deserializer::from_str(&script[at + call.len() - 1..])
                .into_iter::<String>()
                .next()?
                .ok()
        })
    });
    // These can be said only once the page runs.
    let late = ["The graphics card or its driver gave up on the page.", "Text typed into the picture"];
    let said: Vec<String> = said.filter(|text| !late.contains(&text.as_str())).collect();
    assert!(said.len() > 4, "{said:?}");
    let early = script.split_once("const EARLY = {").expect("early texts").1;
    for code in ["de", "zh"] {
        let block = early.split_once(&format!("{code}: {{")).expect("a language").1;
        let mut texts = block.split_once("\n  }").expect("its end").0.split('"').skip(1).step_by(2);
        let mut pairs = BTreeMap::new();
        while let (Some(english), Some(translation)) = (texts.next(), texts.next()) {
            pairs.insert(english, translation);
        }
        let missing: Vec<_> = said.iter().filter(|text| !pairs.contains_key(text.as_str())).collect();
        assert!(missing.is_empty(), "{code} lacks {missing:?}");
        let catalogue = catalogue(code);
        for (english, translation) in pairs {
            assert_eq!(catalogue.get(english).map_or(translation, String::as_str), translation, "{code}");
        }
    }
}

fn lesson_texts(code: &str) -> String {
    let mut all = String::new();
    for id in LessonId::all() {
        let lesson: serde_json::Value = serde_json::from_str(id.source()).expect("JSON");
        gather(&lesson, code, &mut all);
    }
    all
}

fn gather(value: &serde_json::Value, code: &str, all: &mut String) {
    match value {
        serde_json::Value::Object(entries) if entries.contains_key("en") => {
            all.push_str(entries[code].as_str().unwrap_or_else(|| panic!("no {code} of {}", entries["en"])));
        }
        serde_json::Value::Object(entries) => entries.values().for_each(|entry| gather(entry, code, all)),
        serde_json::Value::Array(entries) => entries.iter().for_each(|entry| gather(entry, code, all)),
        _ => {}
    }
}

#[test]
fn the_fonts_have_every_letter() {
    let font = fs::read(project("assets/fonts/DroidSansFallback-subset.ttf")).expect("the Chinese font");
    let ideographs = std::sync::Arc::new(egui::FontData::from_owned(font));
    for (code, font) in [("de", None), ("zh", Some(&ideographs))] {
        let context = egui::Context::default();
        fonts::install(&context, font);
        context.run_ui(egui::RawInput::default(), |_| {}).drop_without_applying_deltas();
        let texts: String = catalogue(code).values().cloned().collect::<String>() + &lesson_texts(code);
        let letters: BTreeSet<char> = texts.chars().filter(|letter| *letter != '\n').collect();
        let missing: String = context.fonts_mut(|fonts| {
            letters.into_iter().filter(|letter| !fonts.has_glyph(&regular(14.0), *letter)).collect()
        });
        assert!(missing.is_empty(), "{code}: no glyph for {missing:?}: run assets/fonts/subset.sh");
    }
}

#[test]
fn the_name_of_each_language_can_always_be_drawn() {
    let context = egui::Context::default();
    fonts::install(&context, None);
    context.run_ui(egui::RawInput::default(), |_| {}).drop_without_applying_deltas();
    for language in harvester_lab::app::text::Language::ALL {
        for letter in language.own_name().chars() {
            assert!(context.fonts_mut(|fonts| fonts.has_glyph(&regular(14.0), letter)), "{letter}");
        }
    }
}
