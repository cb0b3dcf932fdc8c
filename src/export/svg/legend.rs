//! The legend of a plot.

use std::fmt::Write as _;

use super::frame::{INK, LEFT, TEXT};
use super::layers::{drawn, mark, marked};
use super::words::{filled, text, width};
use crate::export::figure::{Key, Layer};
use crate::export::markup::short;
use crate::export::{Figure, Pen, Rgba};

/// Height of a row.
const KEY_ROW: f64 = 18.0;

/// One entry of the legend: what is drawn before its text, and how wide it is.
struct Entry<'a> {
    sample: Sample<'a>,
    text: String,
}

enum Sample<'a> {
    Pen(Rgba, Pen),
    Swatch(Rgba),
    Scale(&'a [Rgba], &'a str),
}

impl Entry<'_> {
    fn lead(&self) -> f64 {
        match &self.sample {
            Sample::Pen(_, pen) if pen.mark().is_some() => 18.0,
            Sample::Pen(..) => 34.0,
            Sample::Swatch(_) => 18.0,
            Sample::Scale(_, low) => width(low, TEXT) + 122.0,
        }
    }
}

/// The legend from `top` down, in as many rows as it needs; returns where it ends.
pub(super) fn keys(out: &mut String, figure: &Figure, end: f64, top: f64) -> f64 {
    let mut entries: Vec<Entry<'_>> = Vec::new();
    for layer in &figure.layers {
        let (key, sample) = match layer {
            Layer::Curve { key, colour, pen, .. } => (key, Sample::Pen(*colour, *pen)),
            Layer::Band { key, edge, .. } => (key, Sample::Swatch(*edge)),
            Layer::Rule { name, colour, pen, .. } => (name, Sample::Pen(*colour, *pen)),
            _ => continue,
        };
        if !key.is_empty() && entries.iter().all(|entry| entry.text != *key) {
            entries.push(Entry { sample, text: key.clone() });
        }
    }
    for key in &figure.keys {
        let (sample, text) = match key {
            Key::Swatch(colour, text) => (Sample::Swatch(*colour), text),
            Key::Scale(colours, low, high) => (Sample::Scale(colours, low), high),
        };
        entries.push(Entry { sample, text: text.clone() });
    }
    let (mut x, mut y) = (LEFT, top);
    for (i, entry) in entries.iter().enumerate() {
        let size = entry.lead() + width(&entry.text, TEXT);
        if i == 0 || x + size > end {
            (x, y) = (LEFT, y + KEY_ROW);
        }
        sample(out, &entry.sample, x, y - 4.0);
        text(out, [x + entry.lead(), y], TEXT, INK, "start", "", &entry.text);
        x += size + 18.0;
    }
    y
}

fn sample(out: &mut String, sample: &Sample<'_>, x: f64, middle: f64) {
    let (left, at) = (short(x), short(middle));
    match sample {
        Sample::Swatch(colour) => {
            let top = short(middle - 5.5);
            let _ = writeln!(
                out,
                "<rect x=\"{left}\" y=\"{top}\" width=\"11\" height=\"11\" rx=\"2\"{}/>",
                filled(*colour)
            );
        }
        Sample::Pen(colour, pen) if pen.mark().is_some() => {
            let radius = f64::from(pen.mark().unwrap_or_default()).max(2.0);
            let (x, path) = (short(x + 6.0), mark(*pen, radius));
            let _ = writeln!(out, "<path d=\"M{x} {at}{path}\"{}/>", marked(*colour, *pen, radius));
        }
        Sample::Pen(colour, pen) => {
            let _ = writeln!(out, "<path d=\"M{left} {at}h28\" fill=\"none\"{}/>", drawn(*colour, *pen));
        }
        Sample::Scale(colours, low) => {
            text(out, [x, middle + 4.0], TEXT, INK, "start", "", low);
            let start = x + width(low, TEXT) + 6.0;
            let step = 110.0 / colours.len().max(1) as f64;
            for (i, colour) in colours.iter().enumerate() {
                let _ = writeln!(
                    out,
                    "<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"10\"{}/>",
                    short(start + step * i as f64),
                    short(middle - 5.0),
                    // Neighbours overlap, or hairlines would show between them.
                    short(step + if i + 1 < colours.len() { 0.5 } else { 0.0 }),
                    filled(*colour)
                );
            }
        }
    }
}
