//! Plots as SVG: on white, with texts as texts, so that they print and can be edited.

mod frame;
mod layers;
mod legend;
mod words;

use std::fmt::Write as _;

use frame::{Frame, INK, LEFT, RIGHT, TEXT};
use layers::layer;
use legend::keys;
use words::{hex, text, wrapped};

use super::markup::{escape, short};
use super::{Axis, Figure, Rgba};

/// Width of a drawing of its own, in pixels.
pub const WIDTH: f64 = 640.0;
/// Height over width that a plot may have.
const ASPECTS: (f64, f64) = (0.42, 0.9);
/// Sizes of texts, and height of a line of the caption.
const TITLE: f64 = 15.0;
const SMALL: f64 = 9.5;
const CAPTION_ROW: f64 = 13.0;
const FONT: &str = "'Helvetica Neue', Helvetica, Arial, 'Liberation Sans', 'DejaVu Sans', sans-serif";
const FAINT: Rgba = [85, 98, 112, 255];
const GRID: Rgba = [226, 231, 236, 255];

/// A drawing of the plots of one card, one below the other, with a caption. The text, and its width and height in
/// pixels.
pub fn drawing(figures: &[Figure], caption: &[String]) -> (String, [f64; 2]) {
    drawing_with(figures, caption, WIDTH, "plot")
}

/// The same in another width; `prefix` tells its identifiers from those of other drawings on a page.
pub(super) fn drawing_with(
    figures: &[Figure],
    caption: &[String],
    width: f64,
    prefix: &str,
) -> (String, [f64; 2]) {
    let mut body = String::new();
    let mut y = 10.0;
    for (number, figure) in figures.iter().enumerate() {
        if let (0, false) = (number, figure.title.is_empty()) {
            y += TITLE + 2.0;
            text(&mut body, [LEFT, y], TITLE, INK, "start", " font-weight=\"600\"", &figure.title);
            y += 7.0;
        }
        y = panel(&mut body, figure, &format!("{prefix}-{number}"), width, y);
    }
    for line in caption.iter().flat_map(|text| wrapped(text, width - LEFT - RIGHT, SMALL)) {
        y += CAPTION_ROW;
        text(&mut body, [LEFT, y], SMALL, FAINT, "start", "", &line);
    }
    let height = (y + 12.0).ceil();
    let (title, described) =
        (figures.first().map_or("", |figure| figure.title.as_str()), escape(&caption.join("\n")));
    let mut out = String::with_capacity(body.len() + 900);
    let _ = write!(
        out,
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" \
         viewBox=\"0 0 {width} {height}\" role=\"img\" font-family=\"{FONT}\">\n<title>{}</title>\n\
         <desc>{described}</desc>\n<rect width=\"{width}\" height=\"{height}\" fill=\"#fff\"/>\n{body}</svg>\n",
        escape(title),
    );
    (out, [width, height])
}

/// Draws one plot from `top` down; returns where it ends.
fn panel(out: &mut String, figure: &Figure, id: &str, whole: f64, top: f64) -> f64 {
    let Some([x, y]) = &figure.axes else { return top };
    if !figure.is_usable() {
        return top;
    }
    let top = keys(out, figure, whole - RIGHT, top + 4.0) + 9.0;
    let width = whole - LEFT - RIGHT;
    let height = (width * figure.aspect.clamp(ASPECTS.0, ASPECTS.1)).round();
    let mut ranges = figure.ranges;
    if figure.equal_scale {
        let (middle, up) = (0.5 * (ranges[0].0 + ranges[0].1), ranges[1].1 - ranges[1].0);
        let half = 0.5 * up * width / height;
        ranges[0] = (middle - half, middle + half);
    }
    let frame = Frame { left: LEFT, top, width, height, ranges };
    axes(out, &frame, x, y);
    let _ = writeln!(
        out,
        "<clipPath id=\"{id}\"><rect x=\"{LEFT}\" y=\"{0}\" width=\"{width}\" height=\"{height}\"/></clipPath>\n\
         <g clip-path=\"url(#{id})\">",
        short(top)
    );
    figure.layers.iter().for_each(|one| layer(out, &frame, one));
    let _ = writeln!(
        out,
        "</g>\n<rect x=\"{LEFT}\" y=\"{}\" width=\"{width}\" height=\"{height}\" fill=\"none\" stroke=\"{}\"/>",
        short(top),
        hex(INK)
    );
    top + height + 42.0
}

/// Grid lines, ticks, their labels and the names of both axes.
fn axes(out: &mut String, frame: &Frame, x: &Axis, y: &Axis) {
    let (left, right) = (frame.left, frame.left + frame.width);
    let (top, bottom) = (frame.top, frame.top + frame.height);
    let mut lines = [String::new(), String::new()];
    let mut labels = String::new();
    for tick in x.ticks(frame.ranges[0], frame.width, 72.0) {
        let at = frame.x(tick.at);
        let label = x.label(tick);
        let long = if label.is_empty() { 3.0 } else { 5.0 };
        let _ = write!(lines[0], "M{} {}V{}", short(at), short(top), short(bottom));
        let _ = write!(lines[1], "M{} {}v-{long}", short(at), short(bottom));
        if !label.is_empty() {
            text(&mut labels, [at, bottom + 16.0], TEXT, INK, "middle", "", &label);
        }
    }
    for tick in y.ticks(frame.ranges[1], frame.height, 46.0) {
        let at = frame.y(tick.at);
        let label = y.label(tick);
        let long = if label.is_empty() { 3.0 } else { 5.0 };
        let _ = write!(lines[0], "M{} {}H{}", short(left), short(at), short(right));
        let _ = write!(lines[1], "M{} {}h{long}", short(left), short(at));
        if !label.is_empty() {
            text(&mut labels, [left - 7.0, at + 4.0], TEXT, INK, "end", "", &label);
        }
    }
    for (path, colour) in lines.iter().zip([GRID, INK]) {
        let _ = writeln!(
            out,
            "<path d=\"{path}\" fill=\"none\" stroke=\"{}\" stroke-width=\"0.8\"/>",
            hex(colour)
        );
    }
    out.push_str(&labels);
    let middle = [0.5 * (left + right), 0.5 * (top + bottom)];
    text(out, [middle[0], bottom + 35.0], TEXT, INK, "middle", "", &title(x));
    let turned = format!(" transform=\"rotate(-90 16 {})\"", short(middle[1]));
    text(out, [16.0, middle[1]], TEXT, INK, "middle", &turned, &title(y));
}

/// The title of an axis with single blanks.
pub(super) fn title(axis: &Axis) -> String {
    axis.title().replace("  ", " ")
}
