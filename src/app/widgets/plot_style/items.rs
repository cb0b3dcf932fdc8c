//! Curves, points, bands and texts in the app's colours.

use egui_plot::{
    HLine, Line, LineStyle, MarkerShape, PlotPoint, PlotPoints, PlotUi, Points, Polygon, Text, VLine,
};

use super::super::recorder;
use super::super::series::Series;
use crate::app::{fonts, theme};
use crate::export::Layer;
use crate::export::Pen;
use crate::export::figure::Anchor;

/// Opacity of what is behind a name on a plot.
const BEHIND: f32 = 0.65;
/// Opacity of the lane under a curve over a picture, and how far it reaches beyond the curve, points.
const LANE: f32 = 0.75;
const BESIDE: f32 = 1.6;

/// A curve in the style of its kind. Points that are not finite leave gaps. The name shows at the pointer.
pub fn series<'a>(plot: &mut PlotUi<'a>, kind: Series, name: &str, curve: &'a [PlotPoint]) {
    let colour = kind.colour(theme::tokens_in(plot.ctx()));
    let pen = kind.pen();
    if pen.mark().is_some() {
        return points(plot, kind, name, curve);
    }
    record(plot, name, Some(kind), colour, pen, curve);
    draw(plot, name, colour, pen, kind != Series::Ghost, curve);
}

/// The same over a picture, which may have its colour: on a lane of the card's.
pub fn series_on_picture<'a>(plot: &mut PlotUi<'a>, kind: Series, name: &str, curve: &'a [PlotPoint]) {
    let colour = theme::tokens_in(plot.ctx()).card.gamma_multiply(LANE);
    let (width, _) = style(kind.pen());
    let lane = Pen::Line(width + 2.0 * BESIDE);
    record(plot, "", None, colour, lane, curve);
    draw(plot, "", colour, lane, false, curve);
    series(plot, kind, name, curve);
}

/// A curve that belongs to no kind, in a style of its own.
pub fn curve<'a>(plot: &mut PlotUi<'a>, name: &str, colour: egui::Color32, pen: Pen, curve: &'a [PlotPoint]) {
    record(plot, name, None, colour, pen, curve);
    draw(plot, name, colour, pen, true, curve);
}

fn draw<'a>(
    plot: &mut PlotUi<'a>,
    name: &str,
    colour: egui::Color32,
    pen: Pen,
    hovers: bool,
    curve: &'a [PlotPoint],
) {
    let (width, style) = style(pen);
    for run in finite_runs(curve) {
        let line = Line::new(name, PlotPoints::Borrowed(run)).color(colour).width(width).style(style);
        // The bands that egui_plot makes of dense lines overshoot steep peaks.
        let line = line.allow_band(false);
        plot.line(line.allow_hover(hovers));
    }
}

fn style(pen: Pen) -> (f32, LineStyle) {
    match pen {
        Pen::Dashes(width, length) => (width, LineStyle::Dashed { length }),
        Pen::Dots(radius, spacing) => (radius, LineStyle::Dotted { spacing }),
        Pen::Line(width) => (width, LineStyle::Solid),
        mark => (mark.mark().unwrap_or_default(), LineStyle::Solid),
    }
}

/// Notes a curve for files.
fn record(
    plot: &PlotUi<'_>,
    name: &str,
    kind: Option<Series>,
    colour: egui::Color32,
    pen: Pen,
    curve: &[PlotPoint],
) {
    if curve.is_empty() || !recorder::is_on(plot.ctx()) {
        return;
    }
    let key = kind.map_or(name.to_owned(), |kind| recorder::legend_name(plot.ctx(), kind, name));
    recorder::draw(plot, &mut || Layer::Curve {
        name: name.to_owned(),
        key: key.clone(),
        colour: recorder::rgba(colour),
        pen,
        points: curve.iter().map(|point| [point.x, point.y]).collect(),
    });
}

/// A line across the whole plot, upright or level, where `at` is. Its name shows at the pointer; one without a name is
/// a mere help to the eye.
pub fn rule(plot: &mut PlotUi<'_>, upright: bool, name: &str, at: f64, colour: egui::Color32, pen: Pen) {
    if !at.is_finite() {
        return;
    }
    recorder::draw(plot, &mut || {
        let (name, colour) = (name.to_owned(), recorder::rgba(colour));
        Layer::Rule { name, colour, pen, upright, at }
    });
    let (width, style) = style(pen);
    let hovers = !name.is_empty();
    if upright {
        plot.vline(VLine::new(name, at).color(colour).width(width).style(style).allow_hover(hovers));
    } else {
        plot.hline(HLine::new(name, at).color(colour).width(width).style(style).allow_hover(hovers));
    }
}

/// Points where the data are: large when few, small when many.
pub fn points<'a>(plot: &mut PlotUi<'a>, kind: Series, name: &str, places: &'a [PlotPoint]) {
    faded_points(plot, kind, name, places, 1.0);
}

/// The same with less of their colour, such as older ones.
pub fn faded_points<'a>(
    plot: &mut PlotUi<'a>,
    kind: Series,
    name: &str,
    places: &'a [PlotPoint],
    strength: f32,
) {
    let colour = kind.colour(theme::tokens_in(plot.ctx()));
    let (radius, opacity) = match (kind, places.len()) {
        (Series::Ghost, 0..=40) => (3.5, 0.8),
        (Series::Ghost, _) => (2.0, 0.6),
        (Series::TheoryPoint, _) => (7.0, 1.0),
        (Series::Reached, _) => (6.5, 1.0),
        (Series::Down, _) => (2.6, 0.8),
        (Series::Unsettled, _) => (3.6, 1.0),
        (Series::Beyond, _) => (4.5, 1.0),
        (_, 0..=40) => (5.0, 1.0),
        (_, 41..=400) => (2.6, 0.9),
        _ => (1.5, 0.75),
    };
    let opacity = if theme::tokens_in(plot.ctx()).contrast { 1.0 } else { opacity };
    let opacity = opacity * strength;
    let (pen, shape) = match kind.mark() {
        Pen::Rings(_) => (Pen::Rings(radius), MarkerShape::Circle),
        Pen::Crosses(_) => (Pen::Crosses(radius), MarkerShape::Cross),
        Pen::Diamonds(_) => (Pen::Diamonds(radius), MarkerShape::Diamond),
        Pen::HollowDiamonds(_) => (Pen::HollowDiamonds(radius), MarkerShape::Diamond),
        Pen::Squares(_) => (Pen::Squares(radius), MarkerShape::Square),
        _ => (Pen::Points(radius), MarkerShape::Circle),
    };
    record(plot, name, Some(kind), colour.gamma_multiply(opacity), pen, places);
    for run in finite_runs(places) {
        let dots = Points::new(name, PlotPoints::Borrowed(run)).color(colour.gamma_multiply(opacity));
        let dots = dots.filled(!matches!(pen, Pen::Rings(_) | Pen::HollowDiamonds(_))).shape(shape);
        plot.points(dots.radius(radius).allow_hover(kind != Series::Ghost));
    }
}

/// A filled band between the smallest and largest value in each stretch of a long record, all one length.
pub fn envelope(plot: &mut PlotUi<'_>, kind: Series, name: &str, xs: &[f64], low: &[f64], high: &[f64]) {
    let tokens = theme::tokens_in(plot.ctx());
    let colour = kind.colour(tokens);
    let usable = |i: &usize| xs[*i].is_finite() && low[*i].is_finite() && high[*i].is_finite();
    let count = xs.len().min(low.len()).min(high.len());
    let kept: Vec<usize> = (0..count).filter(usable).collect();
    let pick = |values: &[f64]| kept.iter().map(|i| values[*i]).collect::<Vec<f64>>();
    let (xs, low, high) = (pick(xs), pick(low), pick(high));
    if xs.is_empty() {
        return;
    }
    let fill = colour.gamma_multiply(if kind == Series::Ghost { 0.22 } else { 0.5 });
    let key = recorder::legend_name(plot.ctx(), kind, name);
    recorder::draw(plot, &mut || Layer::Band {
        name: name.to_owned(),
        key: key.clone(),
        fill: recorder::rgba(fill),
        edge: recorder::rgba(colour),
        points: (0..xs.len()).map(|i| [xs[i], low[i], high[i]]).collect(),
    });
    plot.add(egui_plot::FilledArea::new(name, &xs, &low, &high).fill_color(fill).allow_hover(false));
    for edge in [&low, &high] {
        let curve: PlotPoints<'_> = xs.iter().zip(edge).map(|(x, y)| [*x, *y]).collect();
        let width = if kind == Series::Ghost { 0.8 } else { 1.2 };
        plot.line(Line::new(name, curve).color(colour).width(width).allow_band(false).allow_hover(false));
    }
}

/// Tints the region above a curve up to `top`, such as the unstable side of a boundary.
pub fn area_above(plot: &mut PlotUi<'_>, kind: Series, curve: &[PlotPoint], top: f64) {
    let tokens = theme::tokens_in(plot.ctx());
    let tint = tokens.tint(kind.colour(tokens));
    for run in finite_runs(curve).into_iter().filter(|run| run.len() > 1) {
        let xs: Vec<f64> = run.iter().map(|point| point.x).collect();
        let lows: Vec<f64> = run.iter().map(|point| point.y.min(top)).collect();
        let tops = vec![top; run.len()];
        recorder::draw(plot, &mut || Layer::Band {
            name: String::new(),
            key: String::new(),
            fill: recorder::rgba(tint),
            edge: [0; 4],
            points: run.iter().map(|point| [point.x, point.y.min(top), top]).collect(),
        });
        plot.add(egui_plot::FilledArea::new("", &xs, &lows, &tops).fill_color(tint).allow_hover(false));
    }
}

/// A filled rectangle, such as one cell of a chart, from one corner to the opposite one.
pub fn cell(plot: &mut PlotUi<'_>, from: [f64; 2], to: [f64; 2], fill: egui::Color32) {
    let corners = vec![from, [to[0], from[1]], to, [from[0], to[1]]];
    let shape = Polygon::new("", PlotPoints::from(corners)).fill_color(fill).stroke(egui::Stroke::NONE);
    plot.polygon(shape.allow_hover(false));
}

/// Whether a small text about `place` has room within the frame and beside those that have `taken` theirs; it takes its own.
pub fn has_room(plot: &PlotUi<'_>, text: &str, place: [f64; 2], taken: &mut Vec<egui::Rect>) -> bool {
    let rect = egui::Rect::from_center_size(plot.screen_from_plot(place.into()), label_size(plot, text));
    let free =
        plot.transform().frame().contains_rect(rect) && !taken.iter().any(|other| other.intersects(rect));
    taken.extend(free.then_some(rect));
    free
}

/// How large a label with this text is, points.
pub fn label_size(plot: &PlotUi<'_>, text: &str) -> egui::Vec2 {
    let font = fonts::regular(theme::size::SMALL + 0.5);
    let layout = |fonts: &mut egui::epaint::text::FontsView<'_>| {
        fonts.layout_no_wrap(text.to_owned(), font, egui::Color32::WHITE).size()
    };
    plot.ctx().fonts_mut(layout)
}

/// A small text in the plot, in the colour of what it names.
pub fn labelled_place(plot: &mut PlotUi<'_>, text: &str, place: [f64; 2], kind: Series) {
    let tokens = theme::tokens_in(plot.ctx());
    let colour = match kind {
        _ if tokens.contrast => tokens.text_strong,
        Series::Ghost => tokens.text_weak,
        kind => kind.colour(tokens),
    };
    label(plot, text, place, colour, Anchor::Middle);
}

/// A small text whose middle or left end is at `place`.
pub fn label(plot: &mut PlotUi<'_>, text: &str, place: [f64; 2], colour: egui::Color32, anchor: Anchor) {
    recorder::draw(plot, &mut || {
        let (text, colour) = (text.to_owned(), recorder::rgba(colour));
        Layer::Text { text, colour, place, anchor }
    });
    let rich = egui::RichText::new(text).font(fonts::regular(theme::size::SMALL + 0.5)).color(colour);
    let align =
        if anchor == Anchor::Middle { egui::Align2::CENTER_CENTER } else { egui::Align2::LEFT_BOTTOM };
    plot.text(Text::new("", place.into(), rich).color(colour).anchor(align).allow_hover(false));
}

/// A place of its own, with its name beside it.
pub fn special_point(plot: &mut PlotUi<'_>, name: &str, place: PlotPoint) {
    special_points(plot, &[(name, place)]);
}

/// Such places, each with its name where that meets neither another name nor another place: the rest tell theirs on touch.
pub fn special_points(plot: &mut PlotUi<'_>, all: &[(impl AsRef<str>, PlotPoint)]) {
    let tokens = theme::tokens_in(plot.ctx());
    let font = fonts::regular(theme::size::SMALL + 0.5);
    let frame = *plot.transform().frame();
    let mut taken: Vec<egui::Rect> = all
        .iter()
        .map(|(_, place)| {
            egui::Rect::from_center_size(plot.screen_from_plot(*place), egui::Vec2::splat(10.0))
        })
        .collect();
    for (index, (name, place)) in all.iter().map(|(name, place)| (name.as_ref(), *place)).enumerate() {
        recorder::draw(plot, &mut || Layer::Special { name: name.to_owned(), place: [place.x, place.y] });
        let spaced = format!("  {name}  ");
        let layout = |fonts: &mut egui::epaint::text::FontsView<'_>| {
            fonts.layout_no_wrap(spaced.clone(), font.clone(), tokens.text_strong).size()
        };
        let size = plot.ctx().fonts_mut(layout);
        let others = taken.iter().enumerate().filter(|(other, _)| *other != index).map(|(_, rect)| *rect);
        let others: Vec<egui::Rect> = others.collect();
        if let Some((anchor, rect)) = anchor_with_room(plot.screen_from_plot(place), size, frame, &others) {
            taken.push(rect);
            let behind = tokens.card.gamma_multiply(BEHIND);
            let rich = egui::RichText::new(spaced).font(font.clone());
            let rich = rich.color(tokens.text_strong).background_color(behind);
            let text = Text::new("", place, rich).color(tokens.text_strong);
            plot.text(text.anchor(anchor).allow_hover(false));
        }
        // On a map any colour may be behind it.
        for (radius, colour) in [(7.0, tokens.card), (5.0, tokens.text_strong)] {
            let mark = Points::new(name, vec![[place.x, place.y]]).radius(radius).color(colour);
            plot.points(mark.shape(egui_plot::MarkerShape::Diamond));
        }
    }
}

/// Which corner of a text is at `place`, and where that puts it, so that it ends within the frame and meets none of the
/// `taken`: to the right and up where it can be. One that fits nowhere in the frame begins there.
fn anchor_with_room(
    place: egui::Pos2,
    size: egui::Vec2,
    frame: egui::Rect,
    taken: &[egui::Rect],
) -> Option<(egui::Align2, egui::Rect)> {
    use egui::Align2;
    let free = |rect: &egui::Rect| taken.iter().all(|other| !other.intersects(*rect));
    let at = |anchor: Align2| (anchor, anchor.anchor_size(place, size));
    let corners = [Align2::LEFT_BOTTOM, Align2::RIGHT_BOTTOM, Align2::LEFT_TOP, Align2::RIGHT_TOP].map(at);
    let fits = |rect: &egui::Rect| rect.left() >= frame.left() && rect.right() <= frame.right();
    let inside =
        |rect: &egui::Rect| fits(rect) && rect.top() >= frame.top() && rect.bottom() <= frame.bottom();
    if corners.iter().any(|(_, rect)| inside(rect)) {
        return corners.into_iter().find(|(_, rect)| inside(rect) && free(rect));
    }
    let up = place.y - size.y >= frame.top();
    Some(corners[if up { 0 } else { 2 }]).filter(|(_, rect)| free(rect))
}

/// The stretches of a curve without points that are not finite.
pub fn finite_runs(curve: &[PlotPoint]) -> Vec<&[PlotPoint]> {
    let finite = |point: &PlotPoint| point.x.is_finite() && point.y.is_finite();
    curve.split(|point| !finite(point)).filter(|run| !run.is_empty()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_ends_within_the_frame() {
        let frame = egui::Rect::from_min_size(egui::pos2(0.0, 0.0), egui::vec2(200.0, 100.0));
        let size = egui::vec2(80.0, 12.0);
        let at =
            |x: f32, y: f32| anchor_with_room(egui::pos2(x, y), size, frame, &[]).map(|(anchor, _)| anchor);
        assert_eq!(at(50.0, 50.0), Some(egui::Align2::LEFT_BOTTOM));
        assert_eq!(at(150.0, 50.0), Some(egui::Align2::RIGHT_BOTTOM));
        assert_eq!(at(150.0, 5.0), Some(egui::Align2::RIGHT_TOP));
        let wide = anchor_with_room(egui::pos2(100.0, 50.0), egui::vec2(150.0, 12.0), frame, &[]);
        let beginning = Some(egui::Align2::LEFT_BOTTOM);
        assert_eq!(
            wide.map(|(anchor, _)| anchor),
            beginning,
            "no room on either side: the beginning is legible"
        );
    }

    #[test]
    fn a_name_meets_no_other_and_is_left_out_where_there_is_no_room() {
        let frame = egui::Rect::from_min_size(egui::pos2(0.0, 0.0), egui::vec2(200.0, 100.0));
        let (place, size) = (egui::pos2(100.0, 50.0), egui::vec2(80.0, 12.0));
        let mut taken = Vec::new();
        for expected in [
            egui::Align2::LEFT_BOTTOM,
            egui::Align2::RIGHT_BOTTOM,
            egui::Align2::LEFT_TOP,
            egui::Align2::RIGHT_TOP,
        ] {
            let (anchor, rect) = anchor_with_room(place, size, frame, &taken).expect("room is left");
            assert_eq!(anchor, expected);
            taken.push(rect.shrink(0.5));
        }
        assert_eq!(anchor_with_room(place, size, frame, &taken), None);
    }

    #[test]
    fn runs_are_split_at_gaps() {
        let at = |x: f64, y: f64| PlotPoint::new(x, y);
        let curve = [at(f64::NAN, 0.0), at(0.0, 1.0), at(1.0, 2.0), at(2.0, f64::INFINITY), at(3.0, 1.0)];
        let lengths: Vec<usize> = finite_runs(&curve).iter().map(|run| run.len()).collect();
        assert_eq!(lengths, [2, 1]);
    }
}
