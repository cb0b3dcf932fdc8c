//! docs/equations.md against the source: every equation has a row, every function and test named there
//! exists, and every alias `eq-n` in the source stands in the row of its equation.

use std::collections::{BTreeMap, BTreeSet};
use std::error::Error;
use std::path::Path;

type TestResult = Result<(), Box<dyn Error>>;

/// What the source holds: paths of its items and tests, and for each equation number the functions that carry
/// its alias with their documentation.
#[derive(Default)]
struct Source {
    items: BTreeSet<String>,
    tests: BTreeSet<String>,
    aliases: BTreeMap<u32, Vec<(String, String)>>,
}

impl Source {
    fn read() -> Result<Self, Box<dyn Error>> {
        let root = Path::new(env!("CARGO_MANIFEST_DIR"));
        let mut source = Self::default();
        for module in ["model", "theory", "dynamics"] {
            source.read_folder(&root.join("solver/src").join(module), module)?;
        }
        source.read_folder(&root.join("src/questions"), "questions")?;
        source.read_folder(&root.join("tests/design"), "design")?;
        source.read_folder(&root.join("tests/bifurcation_curves"), "bifurcation_curves")?;
        for entry in std::fs::read_dir(root.join("tests"))? {
            let path = entry?.path();
            if path.extension().is_some_and(|extension| extension == "rs") {
                let name = path.file_stem().and_then(|name| name.to_str()).ok_or("file name")?;
                source.read_text(&std::fs::read_to_string(&path)?, name);
            }
        }
        Ok(source)
    }

    fn read_folder(&mut self, folder: &Path, module: &str) -> TestResult {
        self.items.insert(module.to_owned());
        for entry in std::fs::read_dir(folder)? {
            let path = entry?.path();
            let name = path.file_stem().and_then(|name| name.to_str()).ok_or("file name")?.to_owned();
            let module = if name == "mod" { module.to_owned() } else { format!("{module}::{name}") };
            if path.is_dir() {
                self.read_folder(&path, &module)?;
            } else {
                self.read_text(&std::fs::read_to_string(&path)?, &module);
            }
        }
        Ok(())
    }

    /// Collects the items of one formatted file: a block that starts in the first column is an `impl`, a
    /// trait or a module of tests, and ends with a brace there.
    fn read_text(&mut self, text: &str, module: &str) {
        self.items.insert(module.to_owned());
        let (mut block, mut documentation, mut numbers, mut is_test) =
            (None, String::new(), Vec::new(), false);
        for line in text.lines() {
            let code = line.trim_start();
            if let Some(comment) = code.strip_prefix("///") {
                documentation.push_str(comment);
                documentation.push(' ');
                continue;
            }
            if let Some(alias) = code.strip_prefix("#[doc(alias = \"eq-") {
                numbers.extend(alias.trim_end_matches("\")]").parse::<u32>());
                continue;
            }
            if code.starts_with("#[") {
                is_test |= code == "#[test]";
                continue;
            }
            let inside = |block: &Option<String>, name: &str| match block {
                Some(block) => format!("{module}::{block}::{name}"),
                None => format!("{module}::{name}"),
            };
            if let Some(name) = defined(code, "fn ") {
                let path = inside(&block, name);
                if is_test {
                    self.tests.insert(path.clone());
                }
                for number in &numbers {
                    self.aliases.entry(*number).or_default().push((path.clone(), documentation.clone()));
                }
                self.items.insert(path);
            }
            for keyword in ["struct ", "enum ", "trait ", "mod "] {
                if let Some(name) = defined(line, keyword) {
                    self.items.insert(inside(&None, name));
                    if line.ends_with('{') && ["trait ", "mod "].contains(&keyword) {
                        block = Some(name.to_owned());
                    }
                }
            }
            if line.starts_with("impl") {
                let subject = line.rsplit(" for ").next().unwrap_or(line);
                let subject =
                    if subject == line { line.trim_start_matches("impl").trim_start() } else { subject };
                block = Some(identifier(subject).to_owned());
            } else if line == "}" {
                block = None;
            }
            documentation.clear();
            numbers.clear();
            is_test = false;
        }
    }
}

/// The name defined by `line` when it starts with `keyword` after its visibility.
fn defined<'a>(line: &'a str, keyword: &str) -> Option<&'a str> {
    let line = ["pub ", "pub(crate) ", "pub(super) "]
        .iter()
        .find_map(|visibility| line.strip_prefix(visibility))
        .unwrap_or(line);
    let line = line.strip_prefix("const ").unwrap_or(line);
    line.strip_prefix(keyword).map(identifier)
}

fn identifier(text: &str) -> &str {
    text.split(|letter: char| !letter.is_alphanumeric() && letter != '_').next().unwrap_or(text)
}

/// A row of the tables of equations.
struct Row {
    number: u32,
    function: String,
    test: String,
}

fn document() -> Result<String, std::io::Error> {
    std::fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/equations.md"))
}

fn rows(document: &str) -> Vec<Row> {
    let cells = |line: &str| line.split('|').map(|cell| cell.trim().to_owned()).collect::<Vec<_>>();
    document
        .lines()
        .filter(|line| line.starts_with('|'))
        .map(cells)
        .filter_map(|cells| {
            let number = cells.get(1)?.parse().ok()?;
            Some(Row { number, function: cells.get(3)?.clone(), test: cells.get(4)?.clone() })
        })
        .collect()
}

/// What stands between backticks in `text` and is a path.
fn paths(text: &str) -> Vec<&str> {
    text.split('`').skip(1).step_by(2).filter(|word| word.contains("::")).collect()
}

#[test]
fn every_equation_has_one_row() -> TestResult {
    let numbers: Vec<u32> = rows(&document()?).iter().map(|row| row.number).collect();
    assert_eq!(numbers, (1..=81).collect::<Vec<_>>());
    Ok(())
}

#[test]
fn every_path_in_the_document_exists() -> TestResult {
    let source = Source::read()?;
    let document = document()?;
    for path in document.lines().flat_map(paths) {
        assert!(source.items.contains(path), "{path} is not in the source");
    }
    Ok(())
}

#[test]
fn rows_and_aliases_name_the_same_functions() -> TestResult {
    let source = Source::read()?;
    for row in rows(&document()?) {
        let number = row.number;
        let aliased: Vec<&str> =
            source.aliases.get(&number).into_iter().flatten().map(|(path, _)| path.as_str()).collect();
        if row.function.starts_with("none: ") {
            assert!(aliased.is_empty(), "Eq. {number} has a function after all: {aliased:?}");
            continue;
        }
        let named = paths(&row.function);
        let first = *named.first().ok_or(format!("Eq. {number} names no function"))?;
        assert!(aliased.contains(&first), "{first} lacks the alias eq-{number}");
        for path in aliased {
            assert!(named.contains(&path), "{path} carries eq-{number}, its row does not name it");
        }
    }
    let strangers: Vec<_> = source.aliases.keys().filter(|number| !(1..=81).contains(*number)).collect();
    assert!(strangers.is_empty(), "the paper has no equations {strangers:?}");
    Ok(())
}

#[test]
fn every_function_of_an_equation_is_tested() -> TestResult {
    let source = Source::read()?;
    for row in rows(&document()?) {
        let named = paths(&row.test);
        assert!(row.function.starts_with("none: ") || !named.is_empty(), "Eq. {} has no test", row.number);
        for path in named {
            assert!(source.tests.contains(path), "Eq. {}: {path} is not a test", row.number);
        }
    }
    Ok(())
}

#[test]
fn documentation_begins_with_equation_and_section() -> TestResult {
    for (number, functions) in Source::read()?.aliases {
        for (path, documentation) in functions {
            let start = documentation.trim_start().split(':').next().unwrap_or_default();
            let well_formed = (start.starts_with("Eq. (") || start.starts_with("Eqs. ("))
                && start.contains(&format!("({number})"))
                && start.contains(", section");
            assert!(well_formed, "{path}: \"{start}\" does not begin with Eq. ({number}) and its section");
        }
    }
    Ok(())
}
