//! docs/equations.md against the source: every equation has a row, every function and test named there
//! exists, and every alias `eq-n` in the source stands in the row of its equation.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Display;
use std::path::Path;

use crate::{Fallible, TestResult};
use syn::{
    Attribute, Expr, ExprLit, ImplItem, Item, ItemEnum, ItemStruct, Lit, Meta, MetaNameValue, Signature,
    TraitItem, Type,
};

/// What the source holds: paths of its items and tests, and for each equation number the functions that carry
/// its alias with their documentation.
#[derive(Default)]
struct Source {
    items: BTreeSet<String>,
    tests: BTreeSet<String>,
    aliases: BTreeMap<u32, Vec<(String, String)>>,
}

impl Source {
    fn read() -> Fallible<Self> {
        let root = Path::new(env!("CARGO_MANIFEST_DIR"));
        let mut source = Self::default();
        for module in ["model", "theory", "dynamics"] {
            source.read_folder(&root.join("solver/src").join(module), module)?;
        }
        source.read_folder(&root.join("src/questions"), "questions")?;
        for tests in ["tests/fast", "tests/slow"] {
            source.read_folder(&root.join(tests), "")?;
        }
        Ok(source)
    }

    fn read_folder(&mut self, folder: &Path, module: &str) -> TestResult {
        for entry in std::fs::read_dir(folder)? {
            let path = entry?.path();
            let name = path.file_stem().and_then(|name| name.to_str()).ok_or("file name")?;
            let module = if name == "mod" { module.to_owned() } else { inside(module, &name) };
            if path.is_dir() {
                self.read_folder(&path, &module)?;
            } else if path.extension().is_some_and(|extension| extension == "rs") {
                self.read_items(syn::parse_file(&std::fs::read_to_string(&path)?)?.items, &module);
            }
        }
        Ok(())
    }

    fn read_items(&mut self, items: Vec<Item>, module: &str) {
        self.items.insert(module.to_owned());
        for item in items {
            match item {
                Item::Fn(function) => self.read_function(&function.sig, &function.attrs, module),
                Item::Struct(ItemStruct { ident, .. }) | Item::Enum(ItemEnum { ident, .. }) => {
                    self.items.insert(inside(module, &ident));
                }
                Item::Mod(found) => {
                    self.read_items(found.content.unwrap_or_default().1, &inside(module, &found.ident));
                }
                Item::Trait(found) => {
                    let block = inside(module, &found.ident);
                    for item in found.items {
                        if let TraitItem::Fn(function) = item {
                            self.read_function(&function.sig, &function.attrs, &block);
                        }
                    }
                    self.items.insert(block);
                }
                Item::Impl(found) => {
                    let Type::Path(subject) = *found.self_ty else { continue };
                    let Some(subject) = subject.path.segments.last() else { continue };
                    let block = inside(module, &subject.ident);
                    for item in found.items {
                        if let ImplItem::Fn(function) = item {
                            self.read_function(&function.sig, &function.attrs, &block);
                        }
                    }
                }
                // Functions with random arguments, which are no Rust until they are expanded: all are tests.
                Item::Macro(found) if found.mac.path.is_ident("proptest") => {
                    let tokens: Vec<String> =
                        found.mac.tokens.into_iter().map(|token| token.to_string()).collect();
                    for pair in tokens.windows(2).filter(|pair| pair[0] == "fn") {
                        self.tests.insert(inside(module, &pair[1]));
                        self.items.insert(inside(module, &pair[1]));
                    }
                }
                _ => {}
            }
        }
    }

    fn read_function(&mut self, signature: &Signature, attributes: &[Attribute], block: &str) {
        let path = inside(block, &signature.ident);
        if attributes.iter().any(|attribute| attribute.path().is_ident("test")) {
            self.tests.insert(path.clone());
        }
        let documentation: String = attributes.iter().filter_map(documentation).collect();
        for number in attributes.iter().filter_map(equation) {
            self.aliases.entry(number).or_default().push((path.clone(), documentation.clone()));
        }
        self.items.insert(path);
    }
}

fn inside(module: &str, name: &dyn Display) -> String {
    if module.is_empty() { name.to_string() } else { format!("{module}::{name}") }
}

/// A line of documentation.
fn documentation(attribute: &Attribute) -> Option<String> {
    match &attribute.meta {
        Meta::NameValue(MetaNameValue {
            path,
            value: Expr::Lit(ExprLit { lit: Lit::Str(line), .. }),
            ..
        }) if path.is_ident("doc") => Some(line.value() + " "),
        _ => None,
    }
}

/// The number in `#[doc(alias = "eq-8")]`.
fn equation(attribute: &Attribute) -> Option<u32> {
    let alias: MetaNameValue = attribute.path().is_ident("doc").then(|| attribute.parse_args().ok())??;
    match alias.value {
        Expr::Lit(ExprLit { lit: Lit::Str(name), .. }) => name.value().strip_prefix("eq-")?.parse().ok(),
        _ => None,
    }
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
