//! Plots as CSV: what they show, in the units of their axes.

use super::figure::Layer;
use super::svg::title;
use super::{Axis, Figure, Provenance};

/// The plots of one card as CSV after a header of lines that begin with `#`: a row a point, with the name of its series;
/// a gap in a curve is a row without numbers. Coloured charts add a column with the value of each cell, several plots
/// one with the number of the plot.
pub fn table(figures: &[Figure], provenance: &Provenance) -> String {
    let mut out = String::new();
    let title_line = figures.first().map_or("", |figure| figure.title.as_str());
    for line in std::iter::once(("plot".to_owned(), title_line.to_owned())).chain(provenance.lines()) {
        let (name, value) = line;
        out.push_str(&format!("# {name}: {value}\n").replace('\r', " "));
    }
    let mut writer = csv::WriterBuilder::new().flexible(true).from_writer(Vec::new());
    let several = figures.len() > 1;
    let valued = figures.iter().any(|figure| !figure.cells.is_empty());
    let Some([x, y]) = figures.iter().find_map(|figure| figure.axes.as_ref()) else { return out };
    let mut row = |number: usize, cells: [&str; 4]| {
        let number = if number == 0 { "panel".to_owned() } else { number.to_string() };
        let start = several.then_some(number.as_str());
        let rest = &cells[..if valued { 4 } else { 3 }];
        // Memory does not refuse.
        let _ = writer.write_record(start.iter().chain(rest));
    };
    row(0, ["series", &title(x), &title(y), "value"]);
    for (index, figure) in figures.iter().enumerate() {
        let Some([x, y]) = &figure.axes else { continue };
        let mut point = |name: &str, place: [f64; 2]| {
            row(index + 1, [name, &digits(x, place[0]), &digits(y, place[1]), ""]);
        };
        for layer in &figure.layers {
            match layer {
                Layer::Curve { name, points, .. } if !name.is_empty() => {
                    points.iter().for_each(|place| point(name, *place));
                }
                Layer::Band { name, points, .. } if !name.is_empty() => {
                    for (end, word) in [(1, "lowest"), (2, "highest")] {
                        let name = format!("{name}, {word}");
                        points.iter().for_each(|place| point(&name, [place[0], place[end]]));
                    }
                }
                Layer::Special { name, place } | Layer::Here { name, place } => point(name, *place),
                Layer::Rule { name, upright, at, .. } if !name.is_empty() => {
                    point(name, if *upright { [*at, f64::NAN] } else { [f64::NAN, *at] });
                }
                _ => {}
            }
        }
        for cells in &figure.cells {
            let (columns, rows) = cells.size;
            let at = |axis: usize, i: usize, count: usize| {
                let (low, high) = cells.ranges[axis];
                low + (high - low) * i as f64 / (count as f64 - 1.0).max(1.0)
            };
            for (i, value) in cells.values.iter().enumerate() {
                let place = [at(0, i % columns.max(1), columns), at(1, i / columns.max(1), rows)];
                row(index + 1, [&cells.name, &digits(x, place[0]), &digits(y, place[1]), value]);
            }
        }
    }
    let text = writer.into_inner().unwrap_or_default();
    out.push_str(&String::from_utf8_lossy(&text));
    out
}

/// The value at a coordinate with the fewest digits that give it back; empty where there is none. On logarithmic axes
/// it went through a logarithm, whose rounding would show in the last two digits.
fn digits(axis: &Axis, coordinate: f64) -> String {
    let value = axis.value(coordinate);
    let rounded =
        if axis.is_logarithmic() { format!("{value:.13e}").parse().unwrap_or(value) } else { value };
    number(rounded)
}

/// The fewest digits that give `value` back; empty when it is none.
pub(super) fn number(value: f64) -> String {
    if value.is_finite() { super::number::exact(value) } else { String::new() }
}
