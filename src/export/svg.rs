//! Plots as SVG: on white, with texts as texts, so that they print and can be edited.

use std::fmt::Write as _;

use super::figure::{Anchor, Key, Layer, finite_runs};
use super::markup::{escape, short};
use super::picture::data_address;
use super::{Axis, Figure, Pen, Rgba};

/// Width of a drawing of its own and what is kept free left and right of a plot, in pixels.
pub const WIDTH: f64 = 640.0;
const LEFT: f64 = 76.0;
const RIGHT: f64 = 20.0;
/// Height over width that a plot may have.
const ASPECTS: (f64, f64) = (0.42, 0.9);
/// Sizes of texts, and heights of their lines.
const TITLE: f64 = 15.0;
const TEXT: f64 = 12.0;
const SMALL: f64 = 9.5;
const KEY_ROW: f64 = 18.0;
const CAPTION_ROW: f64 = 13.0;
/// Width of a letter over its size, on average, and for the widest.
const LETTER: f64 = 0.52;
const FONT: &str = "'Helvetica Neue', Helvetica, Arial, 'Liberation Sans', 'DejaVu Sans', sans-serif";
const INK: Rgba = [20, 26, 32, 255];
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

/// Where a plot is drawn.
struct Frame {
    left: f64,
    top: f64,
    width: f64,
    height: f64,
    ranges: [(f64, f64); 2],
}

impl Frame {
    fn x(&self, x: f64) -> f64 {
        let (low, high) = self.ranges[0];
        // Far outside, drawings lose their precision; the clipping does not see the difference.
        self.left + self.width * ((x - low) / (high - low)).clamp(-20.0, 20.0)
    }

    fn y(&self, y: f64) -> f64 {
        let (low, high) = self.ranges[1];
        self.top + self.height * (1.0 - ((y - low) / (high - low)).clamp(-20.0, 20.0))
    }

    fn place(&self, [x, y]: [f64; 2]) -> String {
        format!("{} {}", short(self.x(x)), short(self.y(y)))
    }
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

fn layer(out: &mut String, frame: &Frame, layer: &Layer) {
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
            text(out, [x + 8.0, y - 5.0], TEXT, INK, "start", HALO, name);
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
fn mark(pen: Pen, radius: f64) -> String {
    let (r, d) = (short(radius), short(2.0 * radius));
    match pen {
        Pen::Rings(_) => format!("m-{r} 0a{r} {r} 0 1 0 {d} 0a{r} {r} 0 1 0-{d} 0"),
        Pen::Crosses(_) => format!("m-{r}-{r}l{d} {d}m0-{d}l-{d} {d}"),
        Pen::Diamonds(_) => format!("m0-{r}l{r} {r}-{r} {r}-{r}-{r}z"),
        // The ends of a line without length make a disc or a square of it, at a tenth of a circle's text.
        _ => "h0".to_owned(),
    }
}

/// The attributes of marks.
fn marked(colour: Rgba, pen: Pen, radius: f64) -> String {
    match pen {
        Pen::Diamonds(_) => filled(colour),
        Pen::Rings(_) | Pen::Crosses(_) => format!(" fill=\"none\"{}", stroke(colour, 1.2)),
        _ => {
            let cap = if matches!(pen, Pen::Squares(_)) { "square" } else { "round" };
            format!(" fill=\"none\"{} stroke-linecap=\"{cap}\"", stroke(colour, 2.0 * radius))
        }
    }
}

/// The attributes of a line.
fn drawn(colour: Rgba, pen: Pen) -> String {
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
        | Pen::Squares(size) => stroke(colour, 0.8 * f64::from(size)),
    }
}

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
fn keys(out: &mut String, figure: &Figure, end: f64, top: f64) -> f64 {
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

fn text(out: &mut String, [x, y]: [f64; 2], size: f64, colour: Rgba, anchor: &str, more: &str, words: &str) {
    let _ = writeln!(
        out,
        "<text x=\"{}\" y=\"{}\" font-size=\"{size}\" text-anchor=\"{anchor}\"{}{more}>{}</text>",
        short(x),
        short(y),
        filled(colour),
        escape(words.trim())
    );
}

/// About how wide a text is: fonts differ.
fn width(words: &str, size: f64) -> f64 {
    LETTER * size * words.chars().count() as f64
}

/// The text in lines of at most `room`.
fn wrapped(words: &str, room: f64, size: f64) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in words.split(' ') {
        match lines.last_mut() {
            Some(line) if width(line, size) + width(word, size) < room => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(word.to_owned()),
        }
    }
    lines
}

fn hex([r, g, b, _]: Rgba) -> String {
    format!("#{r:02x}{g:02x}{b:02x}")
}

/// An opacity as an attribute; none when opaque.
fn opacity(what: &str, colour: Rgba) -> String {
    if colour[3] == 255 {
        String::new()
    } else {
        format!(" {what}=\"{}\"", short(f64::from(colour[3]) / 255.0))
    }
}

fn filled(colour: Rgba) -> String {
    format!(" fill=\"{}\"{}", hex(colour), opacity("fill-opacity", colour))
}

fn stroke(colour: Rgba, width: f64) -> String {
    let opacity = opacity("stroke-opacity", colour);
    format!(" stroke=\"{}\"{opacity} stroke-width=\"{}\"", hex(colour), short(width))
}
