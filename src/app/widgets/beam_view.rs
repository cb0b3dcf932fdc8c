//! The harvester itself: clamped beam, tip magnet, fixed magnet and the gap between them, to scale.

use egui::{
    Align2, Color32, CornerRadius, Painter, Pos2, Rect, Response, Sense, Shape, Stroke, StrokeKind, Ui, pos2,
    vec2,
};

use super::number;
use crate::app::text::{fill, tr};
use crate::app::{fonts, theme};

/// Magnifications of the deflection to choose from when it is too small to be seen.
const MAGNIFICATIONS: [f64; 8] = [1.0, 2.0, 3.0, 5.0, 10.0, 20.0, 50.0, 100.0];
/// Side of a magnet, in beam lengths.
const MAGNET: f64 = 0.075;
/// Share of the picture's height that motion should use at most.
const USED_HEIGHT: f64 = 0.8;
/// Height of the note in the corner, with what keeps it clear, points.
const NOTE: f32 = 24.0;

/// A moving picture of the beam. Lengths are in beam lengths; `z` points up.
///
/// ```
/// # use harvester_lab::app::widgets::BeamView;
/// # fn draw(ui: &mut egui::Ui, shape: &[[f64; 2]]) {
/// BeamView::new(shape).magnet(-0.15, false).base(0.002).gap(0.49).show(ui, 180.0);
/// # }
/// ```
pub struct BeamView<'a> {
    shape: &'a [[f64; 2]],
    /// Height of the fixed magnet's near face, and whether it attracts.
    magnet: Option<(f64, bool)>,
    base: f64,
    gap: Option<f64>,
    extremes: &'a [&'a [[f64; 2]]],
    magnification: Option<f64>,
    /// The volts to be named, where the parts are.
    labels: Option<Option<f64>>,
}

impl<'a> BeamView<'a> {
    /// The beam through the points `(x, z)` from the clamp to the tip, relative to the clamp; without magnets.
    pub fn new(shape: &'a [[f64; 2]]) -> Self {
        Self { shape, magnet: None, base: 0.0, gap: None, extremes: &[], magnification: None, labels: None }
    }

    /// A magnet at the tip and a fixed one, whose near face is so high above the undeflected beam (negative: below it).
    /// One that is further away than the picture is high is not seen.
    pub fn magnet(mut self, face: f64, attracts: bool) -> Self {
        self.magnet = Some((face, attracts));
        self
    }

    /// How far the clamp is displaced now.
    pub fn base(mut self, base: f64) -> Self {
        self.base = base;
        self
    }

    /// The open part of the gap between the magnets: 1 at rest, 0 at contact. Drawn as an arrow with a percentage.
    pub fn gap(mut self, open: f64) -> Self {
        self.gap = Some(open);
        self
    }

    /// Shapes drawn faintly behind, such as the highest and the lowest of a period.
    pub fn extremes(mut self, extremes: &'a [&'a [[f64; 2]]]) -> Self {
        self.extremes = extremes;
        self
    }

    /// Draws heights larger than lengths by this factor, which is printed. Left alone, the view takes the largest
    /// round factor at which everything stays in the picture; hold on to one while the picture moves by giving the
    /// extremes as well.
    pub fn magnification(mut self, factor: f64) -> Self {
        self.magnification = Some(factor);
        self
    }

    /// Names the parts, for whoever has never seen the device; the load gets so many volts, where that is known.
    pub fn labelled(mut self, volts: Option<f64>) -> Self {
        self.labels = Some(volts);
        self
    }

    /// Draws over the available width and `height` points.
    pub fn show(self, ui: &mut Ui, height: f32) -> Response {
        let (rect, response) = ui.allocate_exact_size(vec2(ui.available_width(), height), Sense::hover());
        let label = self.gap.map_or(tr("The beam in motion").to_owned(), |gap| {
            let percent = number::significant(100.0 * gap, 2);
            fill("The beam in motion, gap {percent} % open", &[("percent", &percent)])
        });
        let enabled = ui.is_enabled();
        response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Image, enabled, label.clone()));
        if ui.is_rect_visible(rect) {
            self.paint(ui, rect);
        }
        response
    }

    fn paint(&self, ui: &Ui, rect: Rect) {
        let tokens = theme::tokens(ui);
        ui.painter().rect_filled(rect, theme::radius::CONTROL, tokens.inset);
        let painter = ui.painter().with_clip_rect(rect.intersect(ui.clip_rect()));
        let view = View::fit(rect, self);
        let wall_x = view.at(0.0, 0.0).x;
        let base = self.base;

        // The clamp, with the hatching of an engineering drawing.
        let half = 0.32 * rect.height();
        let middle = view.at(0.0, base).y;
        let wall = Rect::from_min_max(pos2(wall_x - 9.0, middle - half), pos2(wall_x, middle + half));
        painter.rect_filled(wall, CornerRadius::same(2), tokens.track);
        let hatched = painter.with_clip_rect(wall.intersect(rect));
        for step in 0..40 {
            let foot = pos2(wall.left(), wall.top() + 7.0 * step as f32);
            hatched.line_segment([foot, foot + vec2(9.0, -9.0)], Stroke::new(1.0, tokens.ruler));
        }
        let rest = [view.at(0.0, 0.0), view.at(1.0, 0.0)];
        painter.extend(Shape::dashed_line(&rest, Stroke::new(1.0, tokens.track), 4.0, 4.0));

        let curve = |points: &[[f64; 2]]| -> Vec<Pos2> {
            let finite = points.iter().filter(|p| p[0].is_finite() && p[1].is_finite());
            finite.map(|p| view.at(p[0], p[1] + base)).collect()
        };
        for extreme in self.extremes {
            painter.add(Shape::line(
                curve(extreme),
                Stroke::new(1.5, tokens.numeric.gamma_multiply(if tokens.contrast { 0.8 } else { 0.3 })),
            ));
        }
        let beam = curve(self.shape);
        let tip = beam.last().copied().unwrap_or(rest[1]);
        painter.add(Shape::line(beam, Stroke::new(3.5, tokens.numeric)));

        let side = view.magnet;
        let moving = Rect::from_center_size(tip, vec2(side, side));
        let fixed = self.magnet.map(|(face, attracts)| {
            let facing = if face < 0.0 { 1.0 } else { -1.0 };
            let fixed_face = view.at(1.0, face + base);
            let fixed = Rect::from_center_size(fixed_face + vec2(0.0, 0.5 * side * facing), vec2(side, side));
            // Like poles repel: of magnets that do, the same sides face each other.
            magnet(&painter, moving, tokens.theory, tokens.exact, facing);
            magnet(&painter, fixed, tokens.theory, tokens.exact, if attracts { facing } else { -facing });
            let moving_face = tip + vec2(0.0, 0.5 * side * facing);
            self.gap_arrow(&painter, ui, tip.x + 0.5 * side + 9.0, moving_face.y, fixed_face.y, rect);
            (fixed, attracts)
        });
        if fixed.is_none() {
            painter.rect_filled(moving, CornerRadius::same(2), tokens.text_weak);
        }
        let note = if view.magnification > 1.0 {
            fill(
                "heights × {factor}",
                &[("factor", &number::significant(view.magnification, 2).trim_end_matches(".0"))],
            )
        } else {
            tr("to scale").to_owned()
        };
        // Where the clamp reaches down to the note, the note stands beside it.
        let aside =
            if wall.bottom() > rect.bottom() - NOTE { wall.right() - rect.left() + 6.0 } else { 10.0 };
        let at = rect.left_bottom() + vec2(aside, -7.0);
        painter.text(at, Align2::LEFT_BOTTOM, note, fonts::regular(theme::size::SMALL), tokens.text_weak);
        if let Some(volts) = self.labels {
            let middle_of_beam = view.at(0.45, self.height_at(0.45) + base);
            self.name_parts(&painter, tokens, volts, (wall, middle_of_beam, fixed));
        }
    }

    /// Height of the beam at the part `x` of its length.
    fn height_at(&self, x: f64) -> f64 {
        let next = self.shape.iter().position(|point| point[0] >= x);
        next.and_then(|index| self.shape.get(index)).map_or(0.0, |point| point[1])
    }

    fn name_parts(
        &self,
        painter: &Painter,
        tokens: &theme::Tokens,
        volts: Option<f64>,
        (wall, beam, fixed): (Rect, Pos2, Option<(Rect, bool)>),
    ) {
        let font = fonts::regular(theme::size::BODY);
        let line = Stroke::new(1.0, tokens.ruler);
        let rect = painter.clip_rect();
        // Lines end at the names, and no name leaves the picture or stands on the foot.
        let name = |at: Pos2, align: Align2, text: &str| {
            let galley = painter.layout_no_wrap(text.to_owned(), font.clone(), tokens.text_strong);
            let place = align.anchor_size(at, galley.size());
            let left = place.left().min(rect.right() - 6.0 - place.width()).max(wall.right() + 6.0);
            let place = place.translate(vec2(left - place.left(), 0.0));
            painter.rect_filled(place.expand2(vec2(3.0, 0.0)), CornerRadius::same(2), tokens.inset);
            painter.galley(place.min, galley, tokens.text_strong);
        };
        // The foot, with an arrow for what is done to it.
        let arrow = Stroke::new(2.0, tokens.exact);
        let x = wall.left() - 7.0;
        painter.line_segment([pos2(x, wall.top() + 4.0), pos2(x, wall.bottom() - 4.0)], arrow);
        for (end, way) in [(wall.top() + 4.0, 1.0), (wall.bottom() - 4.0, -1.0)] {
            painter.line_segment([pos2(x, end), pos2(x - 4.0, end + 6.0 * way)], arrow);
            painter.line_segment([pos2(x, end), pos2(x + 4.0, end + 6.0 * way)], arrow);
        }
        name(pos2(wall.right() + 8.0, wall.top() + 2.0), Align2::LEFT_CENTER, tr("shaken foot"));
        // The beam, above it.
        let above = pos2(beam.x, wall.top().max(rect.top()) + 32.0);
        painter.line_segment([above, beam], line);
        name(above, Align2::CENTER_BOTTOM, tr("beam with a layer of ceramic"));
        // The load, on two wires from the ceramic.
        let load = Rect::from_center_size(pos2(beam.x, rect.bottom() - 18.0), vec2(34.0, 12.0));
        for (end, down) in [(load.left_center(), 12.0), (load.right_center(), -12.0)] {
            let foot = pos2(beam.x - down, beam.y);
            painter.line_segment([foot, pos2(foot.x, load.top())], line);
            painter.line_segment([pos2(foot.x, load.top()), end], line);
        }
        painter.rect(load, CornerRadius::same(2), tokens.inset, line, StrokeKind::Middle);
        // The magnets, beside the fixed one.
        if let Some((fixed, attracts)) = fixed.filter(|(fixed, _)| rect.intersects(*fixed)) {
            let text = if attracts { tr("magnets, which attract") } else { tr("magnets, which repel") };
            name(fixed.left_center() - vec2(8.0, 0.0), Align2::RIGHT_CENTER, text);
        }
        let text = volts.map_or(tr("load").to_owned(), |volts| {
            fill("load: {volts} V", &[("volts", &number::significant(volts, 3))])
        });
        name(load.right_center() + vec2(8.0, 0.0), Align2::LEFT_CENTER, &text);
    }

    fn gap_arrow(&self, painter: &Painter, ui: &Ui, x: f32, from: f32, to: f32, rect: Rect) {
        let Some(gap) = self.gap.filter(|gap| gap.is_finite()) else { return };
        let tokens = theme::tokens(ui);
        let colour = if gap < 0.2 { tokens.danger } else { tokens.text_weak };
        let stroke = Stroke::new(1.3, colour);
        painter.line_segment([pos2(x, from), pos2(x, to)], stroke);
        let down = if to > from { 1.0 } else { -1.0 };
        if (to - from).abs() > 12.0 {
            for (tip, way) in [(from, down), (to, -down)] {
                let barb = |side: f32| [pos2(x, tip), pos2(x + 3.5 * side, tip + 5.0 * way)];
                painter.line_segment(barb(1.0), stroke);
                painter.line_segment(barb(-1.0), stroke);
            }
        }
        let font = fonts::regular(theme::size::SMALL);
        let middle = (0.5 * (from + to)).max(rect.top() + 18.0).min(rect.bottom() - 18.0);
        painter.text(
            pos2(x + 7.0, middle - 1.0),
            Align2::LEFT_BOTTOM,
            tr("gap"),
            font.clone(),
            tokens.text_weak,
        );
        let text = format!("{:.0} %", (100.0 * gap).max(0.0));
        painter.text(pos2(x + 7.0, middle + 1.0), Align2::LEFT_TOP, text, font, colour);
    }
}

/// From beam lengths to the screen.
struct View {
    origin: Pos2,
    scale: f64,
    magnification: f64,
    /// Side of a magnet, points.
    magnet: f32,
}

impl View {
    fn fit(rect: Rect, beam: &BeamView<'_>) -> Self {
        let left = rect.left() + 22.0;
        let scale = f64::from((rect.right() - 66.0 - left).max(30.0));
        let magnet = (MAGNET * scale).clamp(8.0, 16.0) as f32;
        let heights =
            beam.extremes.iter().flat_map(|shape| shape.iter()).chain(beam.shape).map(|p| p[1] + beam.base);
        let reach = |(low, high): (f64, f64), z: f64| (low.min(z), high.max(z));
        let of_beam = heights.filter(|z| z.is_finite()).fold((0.0, 0.0), reach);
        let room = USED_HEIGHT * f64::from(rect.height()) - 2.0 * f64::from(magnet);
        let with_magnet = beam.magnet.map(|(face, _)| reach(of_beam, face + beam.base));
        let (low, high) = with_magnet.filter(|(low, high)| (high - low) * scale <= room).unwrap_or(of_beam);
        let fits = |factor: &&f64| (high - low) * scale * **factor <= room;
        let largest = MAGNIFICATIONS.iter().rev().find(fits).copied();
        let magnification = beam.magnification.or(largest).unwrap_or(1.0);
        let middle = 0.5 * (low + high) * scale * magnification;
        Self { origin: pos2(left, rect.center().y + middle as f32), scale, magnification, magnet }
    }

    fn at(&self, x: f64, z: f64) -> Pos2 {
        self.origin + vec2((x * self.scale) as f32, (-z * self.scale * self.magnification) as f32)
    }
}

/// A magnet of two halves; the one in `near` colour faces downwards when `facing` is positive.
fn magnet(painter: &Painter, rect: Rect, far: Color32, near: Color32, facing: f32) {
    let (upper, lower) = if facing > 0.0 { (far, near) } else { (near, far) };
    let (top, bottom) = (
        Rect { max: pos2(rect.max.x, rect.center().y), ..rect },
        Rect { min: pos2(rect.min.x, rect.center().y), ..rect },
    );
    painter.rect_filled(top, CornerRadius { nw: 2, ne: 2, ..CornerRadius::ZERO }, upper);
    painter.rect_filled(bottom, CornerRadius { sw: 2, se: 2, ..CornerRadius::ZERO }, lower);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::widgets::harness::Harness;

    #[test]
    fn everything_fits_and_small_motion_is_magnified() {
        let shape: Vec<[f64; 2]> =
            (0..=20).map(|i| [f64::from(i) / 20.0, 1e-3 * f64::from(i * i) / 400.0]).collect();
        let rect = Rect::from_min_size(Pos2::ZERO, vec2(280.0, 200.0));
        for fixed in [-0.15, -0.004, 0.15] {
            let view = View::fit(rect, &BeamView::new(&shape).magnet(fixed, false));
            assert!(view.magnification >= 1.0);
            for [x, z] in shape.iter().copied().chain([[1.0, fixed]]) {
                assert!(rect.contains(view.at(x, z)), "{fixed}: {x}, {z}");
            }
        }
        let strong = View::fit(rect, &BeamView::new(&shape).magnet(-0.004, false));
        assert!(strong.magnification > 5.0);
    }

    #[test]
    fn the_beam_stays_in_sight_however_far_away_the_magnet_is() {
        let shape = [[0.0, 0.0], [0.5, 0.001], [1.0, 0.004]];
        let rect = Rect::from_min_size(Pos2::ZERO, vec2(280.0, 200.0));
        let alone = View::fit(rect, &BeamView::new(&shape));
        let far = View::fit(rect, &BeamView::new(&shape).magnet(-6.66, true));
        for view in [&alone, &far] {
            assert!(shape.iter().all(|[x, z]| rect.contains(view.at(*x, *z))));
            assert!(view.magnification > 5.0);
        }
        assert!(!rect.contains(far.at(1.0, -6.66)));
    }

    #[test]
    fn it_announces_the_gap_and_survives_bad_numbers() {
        let mut harness = Harness::new(300.0, 260.0);
        let shape = [[0.0, 0.0], [0.5, f64::NAN], [1.0, 0.05]];
        harness.settle(|ui| {
            let extremes: [&[[f64; 2]]; 1] = [&shape];
            let beam = BeamView::new(&shape).magnet(-0.15, false).gap(0.49).extremes(&extremes);
            beam.magnification(1.0).show(ui, 200.0);
        });
        harness.find(egui::Role::Image, "The beam in motion, gap 49 % open");
    }
}
