//! What stands in a plot: bands, curves, marks, pictures and texts.

use std::fmt::Write as _;

use super::frame::{Frame, INK, TEXT};
use super::words::{filled, hex, stroke, text, width};

use crate::export::figure::{Anchor, Layer, finite_runs};
use crate::export::markup::short;
use crate::export::picture::data_address;
use crate::export::{Pen, Rgba};

pub(super) fn layer(out: &mut String, frame: &Frame, layer: &Layer) {
    let _ = match layer {
        Layer::Picture { size, pixels, place: [x, y], opacity } => {
            let Some(address) = data_address(*size, pixels) else { return };
            let (left, right, top, bottom) = (frame.x(x.0), frame.x(x.1), frame.y(y.1), frame.y(y.0));
            writeln!(
                out,
                "<image x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" opacity=\"{opacity}\" preserveAspectRatio=\"none\" \
                 style=\"image-rendering:pixelated\" href=\"{address}\"/>",
                short(left),
                short(top),
                short(right - left),
                short(bottom - top)
            )
        }
        Layer::Band { fill, edge, points, .. } => return band(out, frame, *fill, *edge, points),
        Layer::Curve { colour, pen, points, .. } => return curve(out, frame, *colour, *pen, points),
        Layer::Rule { colour, pen, upright, at, .. } => {
            let [x, y] = frame.ranges;
            let ends = if *upright { [[*at, y.0], [*at, y.1]] } else { [[x.0, *at], [x.1, *at]] };
            return curve(out, frame, *colour, *pen, &ends);
        }
        Layer::Text { text: words, colour, place: [x, y], anchor } => {
            let (anchor, lift) = if *anchor == Anchor::Middle { ("middle", 4.0) } else { ("start", -4.0) };
            let at = [frame.x(*x) + if lift < 0.0 { 5.0 } else { 0.0 }, frame.y(*y) + lift];
            return text(out, at, TEXT, *colour, anchor, HALO, words);
        }
        Layer::Special { name, place } => {
            let (x, y) = (frame.x(place[0]), frame.y(place[1]));
            let ends = x + 8.0 + width(name, TEXT);
            let (side, anchor) =
                if ends <= frame.left + frame.width { (8.0, "start") } else { (-8.0, "end") };
            text(out, [x + side, y - 5.0], TEXT, INK, anchor, HALO, name);
            writeln!(out, "<path d=\"M{} {}l5 5-5 5-5-5z\" fill=\"{}\"/>", short(x), short(y - 5.0), hex(INK))
        }
        Layer::Here { place, .. } => writeln!(
            out,
            "<path d=\"M{at}m-7 0a7 7 0 1 0 14 0a7 7 0 1 0-14 0M{at}m-5 0h10M{at}m0-5v10\" fill=\"none\" \
             stroke=\"{}\" stroke-width=\"1.6\"/>",
            hex(INK),
            at = frame.place(*place)
        ),
    };
}

/// White around texts that stand on curves.
const HALO: &str = " paint-order=\"stroke\" stroke=\"#fff\" stroke-width=\"3\" stroke-linejoin=\"round\"";

fn band(out: &mut String, frame: &Frame, fill: Rgba, edge: Rgba, points: &[[f64; 3]]) {
    let sound = |point: &[f64; 3]| !point.iter().all(|value| value.is_finite());
    for run in points.split(sound).filter(|run| run.len() > 1) {
        let mut path = String::new();
        let forth = run.iter().map(|[x, low, _]| [*x, *low]);
        let back = run.iter().rev().map(|[x, _, high]| [*x, *high]);
        for (i, place) in forth.chain(back).enumerate() {
            path.push(if i == 0 { 'M' } else { 'L' });
            path.push_str(&frame.place(place));
        }
        let edges = if edge[3] == 0 { String::new() } else { stroke(edge, 0.8) };
        let _ = writeln!(out, "<path d=\"{path}z\"{}{edges}/>", filled(fill));
    }
}

fn curve(out: &mut String, frame: &Frame, colour: Rgba, pen: Pen, points: &[[f64; 2]]) {
    let mut path = String::new();
    if let Some(radius) = pen.mark() {
        for place in points.iter().filter(|place| place.iter().all(|value| value.is_finite())) {
            path.push('M');
            path.push_str(&frame.place(*place));
            path.push_str(&mark(pen, f64::from(radius)));
        }
        if !path.is_empty() {
            let _ = writeln!(out, "<path d=\"{path}\"{}/>", marked(colour, pen, f64::from(radius)));
        }
        return;
    }
    for run in finite_runs(points) {
        for (i, place) in run.iter().enumerate() {
            path.push(if i == 0 { 'M' } else { 'L' });
            path.push_str(&frame.place(*place));
        }
        if run.len() == 1 {
            path.push_str("h0");
        }
    }
    if !path.is_empty() {
        let _ = writeln!(
            out,
            "<path d=\"{path}\" fill=\"none\" stroke-linejoin=\"round\"{}/>",
            drawn(colour, pen)
        );
    }
}

/// The path of a mark from its place on.
pub(super) fn mark(pen: Pen, radius: f64) -> String {
    let (r, d) = (short(radius), short(2.0 * radius));
    match pen {
        Pen::Rings(_) => format!("m-{r} 0a{r} {r} 0 1 0 {d} 0a{r} {r} 0 1 0-{d} 0"),
        Pen::Crosses(_) => format!("m-{r}-{r}l{d} {d}m0-{d}l-{d} {d}"),
        Pen::Diamonds(_) | Pen::HollowDiamonds(_) => format!("m0-{r}l{r} {r}-{r} {r}-{r}-{r}z"),
        // The ends of a line without length make a disc or a square of it, at a tenth of a circle's text.
        _ => "h0".to_owned(),
    }
}

/// The attributes of marks.
pub(super) fn marked(colour: Rgba, pen: Pen, radius: f64) -> String {
    match pen {
        Pen::Diamonds(_) => filled(colour),
        Pen::Rings(_) | Pen::Crosses(_) | Pen::HollowDiamonds(_) => {
            format!(" fill=\"none\"{}", stroke(colour, 1.2))
        }
        _ => {
            let cap = if matches!(pen, Pen::Squares(_)) { "square" } else { "round" };
            format!(" fill=\"none\"{} stroke-linecap=\"{cap}\"", stroke(colour, 2.0 * radius))
        }
    }
}

/// The attributes of a line.
pub(super) fn drawn(colour: Rgba, pen: Pen) -> String {
    // A little thinner than on a screen, as prints are looked at from near.
    match pen {
        Pen::Dashes(width, length) => format!(
            "{} stroke-dasharray=\"{} {}\"",
            stroke(colour, 0.8 * f64::from(width)),
            short(0.8 * f64::from(length)),
            short(0.5 * f64::from(length))
        ),
        Pen::Dots(radius, spacing) => format!(
            "{} stroke-linecap=\"round\" stroke-dasharray=\"0 {}\"",
            stroke(colour, 1.6 * f64::from(radius)),
            short(0.8 * f64::from(spacing))
        ),
        Pen::Line(size)
        | Pen::Points(size)
        | Pen::Rings(size)
        | Pen::Crosses(size)
        | Pen::Diamonds(size)
        | Pen::HollowDiamonds(size)
        | Pen::Squares(size) => stroke(colour, 0.8 * f64::from(size)),
    }
}
