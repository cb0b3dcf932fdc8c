//! A device in rows for tables, and in which of them several differ.

use crate::app::bench;
use crate::app::text::{fill, tr};
use crate::app::widgets::number::{exact, round_significant, typographic};
use crate::model::{Dimension, ForceLaw, Parameter};
use crate::scenario::Scenario;

/// Name, symbol, value with unit.
pub(in crate::app) type Row = [String; 3];

/// The device of a scenario; empty where it is none.
pub(in crate::app) fn rows(scenario: &Scenario) -> Vec<Row> {
    let Ok(found) = bench::device(scenario) else { return Vec::new() };
    let row = |dimension: &Dimension| {
        let fact = dimension.fact();
        let value = fact.shown.1 * found.get(*dimension);
        let value = if value.is_finite() {
            let unit = scenario.scaling.unit(fact.shown.0);
            format!("{} {unit}", typographic(&exact(round_significant(value, 5))))
        } else {
            tr("open circuit").to_owned()
        };
        [tr(fact.title).to_owned(), fact.base().to_owned(), value]
    };
    let mut rows: Vec<Row> = Dimension::ALL.iter().map(row).collect();
    let magnets = match (scenario.parameters.c0 == 0.0, found.repelling) {
        (true, _) => tr("none"),
        (false, true) => tr("repelling"),
        (false, false) => tr("attracting"),
    };
    rows.push([tr("Magnets").to_owned(), String::new(), magnets.to_owned()]);
    rows.push([
        tr("Base acceleration").to_owned(),
        String::new(),
        format!("{} g", typographic(&exact(round_significant(found.acceleration(), 4)))),
    ]);
    rows
}

/// Modes and force law.
pub(in crate::app) fn model(scenario: &Scenario) -> String {
    let law = match scenario.model.force {
        ForceLaw::Quadratic => tr("quadratic").to_owned(),
        ForceLaw::Taylor(order) => fill("Taylor (order {order})", &[("order", &order)]),
        ForceLaw::Exact => tr("exact").to_owned(),
    };
    let text = match scenario.model.modes {
        1 => fill("1 mode, {law} magnet force", &[("law", &law)]),
        modes => fill("{modes} modes, {law} magnet force", &[("modes", &modes), ("law", &law)]),
    };
    if scenario.model.residual_moment {
        fill("{text}; modes left out count in the circuit", &[("text", &text)])
    } else {
        text
    }
}

/// The names of what is not the same in all of them, and the value of each. What the base does is told by its acceleration, or
/// by its amplitude where that is held; the frequency is not a part of a curve over it.
pub(in crate::app) fn differing(
    scenarios: &[&Scenario],
    holds_acceleration: bool,
) -> Vec<(String, Vec<String>)> {
    let mut tables: Vec<Vec<Row>> = scenarios.iter().map(|scenario| rows(scenario)).collect();
    if tables.iter().any(Vec::is_empty) {
        tables = scenarios.iter().map(|scenario| numbers(scenario)).collect();
    } else {
        let untold = if holds_acceleration { Dimension::BaseAmplitude } else { Dimension::Frequency };
        for table in &mut tables {
            let mut dimensions = Dimension::ALL.iter();
            let last = table.len() - usize::from(!holds_acceleration);
            table.truncate(last);
            table.retain(|_| {
                dimensions.next().is_none_or(|one| *one != Dimension::Frequency && *one != untold)
            });
        }
    }
    for (table, scenario) in tables.iter_mut().zip(scenarios) {
        let ceramic = scenario.base().ceramic.map_or("–", |ceramic| ceramic.material().name);
        table.push([tr("ceramic").to_owned(), String::new(), ceramic.to_owned()]);
        table.push([tr("Model").to_owned(), String::new(), model(scenario)]);
    }
    let Some(first) = tables.first() else { return Vec::new() };
    let values =
        |index: usize| tables.iter().filter_map(move |table| table.get(index)).map(|row| row[2].clone());
    let all =
        first.iter().enumerate().map(|(index, row)| (row[0].clone(), values(index).collect::<Vec<_>>()));
    all.filter(|(_, values)| values.iter().any(|value| *value != values[0])).collect()
}

/// The dimensionless numbers.
fn numbers(scenario: &Scenario) -> Vec<Row> {
    let row = |parameter: Parameter| {
        let (fact, value) = (parameter.fact(), scenario.parameters.get(parameter));
        let value = format!("{} {}", typographic(&exact(value)), fact.shown.0);
        [tr(fact.title).to_owned(), fact.symbol.to_owned(), value.trim_end().to_owned()]
    };
    Parameter::ALL.into_iter().map(row).collect()
}
