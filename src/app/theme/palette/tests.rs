//! Legibility, and difference for all eyes.

use super::*;
use crate::app::colours;
use crate::app::widgets::Series::{self, *};
use crate::dynamics::motion::Motion;
use crate::export::Pen;

const THEMES: [&Tokens; 4] = [&DARK, &LIGHT, &BLACK, &WHITE];
/// Least difference of two colours that nothing else tells apart, by CIEDE2000; about 2 are just noticed side by side.
const LEAST_DIFFERENCE: f64 = 10.0;

/// Linear light of a channel (IEC 61966-2-1).
fn linear(colour: Color32) -> [f64; 3] {
    [colour.r(), colour.g(), colour.b()].map(|channel| {
        let value = f64::from(channel) / 255.0;
        if value <= 0.04045 { value / 12.92 } else { ((value + 0.055) / 1.055).powf(2.4) }
    })
}

fn times(matrix: &[[f64; 3]; 3], light: [f64; 3]) -> [f64; 3] {
    matrix.map(|row| row.iter().zip(light).map(|(a, b)| a * b).sum::<f64>())
}

/// Contrast by WCAG 2.2.
fn contrast(first: Color32, second: Color32) -> f64 {
    let luminance = |colour| {
        let [r, g, b] = linear(colour);
        0.2126 * r + 0.7152 * g + 0.0722 * b
    };
    let (first, second) = (luminance(first), luminance(second));
    (first.max(second) + 0.05) / (first.min(second) + 0.05)
}

/// Normal sight, and what is missing in protanopia, deuteranopia and tritanopia: Machado, Oliveira and Fernandes, "A
/// Physiologically-based Model for Simulation of Color Vision Deficiency", IEEE Trans. Vis. Comput. Graph. 15 (2009),
/// severity 1.0, for linear sRGB.
const EYES: [(&str, [[f64; 3]; 3]); 4] = [
    ("normal", [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]),
    (
        "protanopia",
        [[0.152286, 1.052583, -0.204868], [0.114503, 0.786281, 0.099216], [-0.003882, -0.048116, 1.051998]],
    ),
    (
        "deuteranopia",
        [[0.367322, 0.860646, -0.227968], [0.280085, 0.672501, 0.047413], [-0.011820, 0.042940, 0.968881]],
    ),
    (
        "tritanopia",
        [[1.255528, -0.076749, -0.178779], [-0.078411, 0.930809, 0.147602], [0.004733, 0.691367, 0.303900]],
    ),
];

/// CIELAB for D65 of linear light.
fn lab(light: [f64; 3]) -> [f64; 3] {
    const XYZ: [[f64; 3]; 3] = [
        [0.4124564, 0.3575761, 0.1804375],
        [0.2126729, 0.7151522, 0.0721750],
        [0.0193339, 0.1191920, 0.9503041],
    ];
    let root = |t: f64| if t > 216.0 / 24389.0 { t.cbrt() } else { (24389.0 / 27.0 * t + 16.0) / 116.0 };
    let [x, y, z] = times(&XYZ, light);
    let (x, y, z) = (root(x / 0.95047), root(y), root(z / 1.08883));
    [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)]
}

/// CIEDE2000 (Sharma, Wu and Dalal, Color Res. Appl. 30, 2005), all weights 1.
fn ciede2000([l1, a1, b1]: [f64; 3], [l2, a2, b2]: [f64; 3]) -> f64 {
    let seventh = |c: f64| (c.powi(7) / (c.powi(7) + 25.0_f64.powi(7))).sqrt();
    let g = 0.5 * (1.0 - seventh(0.5 * (a1.hypot(b1) + a2.hypot(b2))));
    let (a1, a2) = ((1.0 + g) * a1, (1.0 + g) * a2);
    let (c1, c2) = (a1.hypot(b1), a2.hypot(b2));
    let hue =
        |a: f64, b: f64| if a == 0.0 && b == 0.0 { 0.0 } else { b.atan2(a).to_degrees().rem_euclid(360.0) };
    let (h1, h2) = (hue(a1, b1), hue(a2, b2));
    let grey = c1 * c2 == 0.0;
    let turn = match h2 - h1 {
        _ if grey => 0.0,
        turn if turn > 180.0 => turn - 360.0,
        turn if turn < -180.0 => turn + 360.0,
        turn => turn,
    };
    let (dl, dc) = (l2 - l1, c2 - c1);
    let dh = 2.0 * (c1 * c2).sqrt() * (0.5 * turn).to_radians().sin();
    let (l, c) = (0.5 * (l1 + l2), 0.5 * (c1 + c2));
    let h = match h1 + h2 {
        sum if grey => sum,
        sum if (h1 - h2).abs() <= 180.0 => 0.5 * sum,
        sum if sum < 360.0 => 0.5 * (sum + 360.0),
        sum => 0.5 * (sum - 360.0),
    };
    let cos = |degrees: f64| degrees.to_radians().cos();
    let t = 1.0 - 0.17 * cos(h - 30.0) + 0.24 * cos(2.0 * h) + 0.32 * cos(3.0 * h + 6.0)
        - 0.2 * cos(4.0 * h - 63.0);
    let sl = 1.0 + 0.015 * (l - 50.0).powi(2) / (20.0 + (l - 50.0).powi(2)).sqrt();
    let (sc, sh) = (1.0 + 0.045 * c, 1.0 + 0.015 * c * t);
    let around = 60.0 * (-((h - 275.0) / 25.0).powi(2)).exp();
    let rt = -2.0 * seventh(c) * around.to_radians().sin();
    ((dl / sl).powi(2) + (dc / sc).powi(2) + (dh / sh).powi(2) + rt * (dc / sc) * (dh / sh)).sqrt()
}

/// The least difference of two colours that any of the eyes sees, and whose.
fn difference(first: Color32, second: Color32) -> (f64, &'static str) {
    let seen = |colour, matrix| lab(times(matrix, linear(colour)).map(|light| light.clamp(0.0, 1.0)));
    let all =
        EYES.iter().map(|(whose, matrix)| (ciede2000(seen(first, matrix), seen(second, matrix)), *whose));
    all.min_by(|a, b| a.0.total_cmp(&b.0)).expect("four eyes")
}

#[test]
fn differences_are_those_of_the_published_test_data() {
    // Pairs 1, 7, 17 and 25 of Sharma, Wu and Dalal's table 1.
    let data = [
        ([50.0, 2.6772, -79.7751], [50.0, 0.0, -82.7485], 2.0425),
        ([50.0, 0.0, 0.0], [50.0, -1.0, 2.0], 2.3669),
        ([50.0, 2.5, 0.0], [73.0, 25.0, -18.0], 27.1492),
        ([60.2574, -34.0099, 36.2677], [60.4626, -34.1751, 39.4387], 1.2644),
    ];
    for (first, second, wanted) in data {
        let found = ciede2000(first, second);
        assert!((found - wanted).abs() < 1e-4, "{found} instead of {wanted}");
    }
}

#[test]
fn text_is_legible_everywhere_it_is_drawn() {
    for tokens in THEMES {
        let least = if tokens.contrast { 7.0 } else { 4.5 };
        let name = tokens.number();
        for back in [tokens.page, tokens.bar, tokens.card, tokens.inset, tokens.field] {
            for text in [
                tokens.text_strong,
                tokens.text,
                tokens.text_weak,
                tokens.accent,
                tokens.warning,
                tokens.danger,
                tokens.ok,
            ] {
                let ratio = contrast(text, back);
                assert!(ratio >= least, "{text:?} on {back:?} (theme {name}): {ratio:.2}");
            }
        }
        for text in [tokens.text_strong, tokens.text] {
            assert!(contrast(text, tokens.hover) >= least, "theme {name}");
        }
        assert!(contrast(tokens.on_accent, tokens.accent) >= least, "theme {name}");
    }
}

#[test]
fn curves_and_outlines_stand_out_from_what_they_are_on() {
    for tokens in THEMES {
        let least = if tokens.contrast { 4.5 } else { 3.0 };
        let (numeric, theory, published) = (tokens.numeric, tokens.theory, tokens.published);
        let curves =
            [numeric, theory, published, tokens.coupled, tokens.exact, tokens.poincare, tokens.ghost];
        for curve in curves {
            let ratio = contrast(curve, tokens.card);
            assert!(ratio >= least, "{curve:?} (theme {}): {ratio:.2}", tokens.number());
        }
        if tokens.contrast {
            assert_eq!(tokens.edge().color, tokens.outline);
            for back in [tokens.page, tokens.bar, tokens.card, tokens.field, tokens.hover] {
                assert!(contrast(tokens.outline, back) >= 4.5, "{back:?}");
            }
            // What is not text needs three: WCAG 2.2, 1.4.11.
            assert!(contrast(tokens.track, tokens.card) >= 3.0);
        }
    }
}

#[test]
fn a_style_is_known_again() {
    for tokens in THEMES {
        let context = egui::Context::default();
        crate::app::theme::apply(&context, tokens);
        assert_eq!(crate::app::theme::tokens_in(&context), tokens);
    }
}

/// Lines and marks in a plot.
struct PlotOf {
    name: &'static str,
    lines: &'static [Series],
    marks: &'static [Series],
}

/// What the panels draw into one plot.
const PLOTS: [PlotOf; 14] = [
    PlotOf { name: "stability map", lines: &[Published, Coupled, Exact], marks: &[Ghost] },
    // The exact boundary of another device, while that of this one is computed.
    PlotOf { name: "stability map before", lines: &[Published, Coupled, Ghost], marks: &[Ghost] },
    PlotOf { name: "phase portrait", lines: &[Numeric, Ghost], marks: &[Theory] },
    PlotOf { name: "Poincaré map", lines: &[], marks: &[Poincare, TheoryPoint, Ghost] },
    PlotOf { name: "time history", lines: &[Numeric, Ghost], marks: &[Theory] },
    PlotOf { name: "multipliers", lines: &[Ghost], marks: &[Forced, Reached] },
    PlotOf { name: "bifurcation curves", lines: &[Exact, Torus, Fold], marks: &[] },
    PlotOf { name: "orbit diagram", lines: &[], marks: &[Up, Down] },
    PlotOf { name: "response", lines: &[Stable, Unstable, Ghost], marks: &[Up, Down] },
    PlotOf {
        name: "harvest",
        lines: &[Linear, Stable, Unstable, Ghost],
        marks: &[FromRest, Up, Down, Beyond, Measured],
    },
    PlotOf { name: "load", lines: &[Linear, Stable, Unstable, Theory, Best], marks: &[Up, Beyond] },
    PlotOf { name: "measured over frequency", lines: &[Linear, Stable], marks: &[FromRest, Measured] },
    PlotOf { name: "spectrum", lines: &[Numeric], marks: &[] },
    PlotOf { name: "roles", lines: &[Numeric, Theory, Published, Coupled, Ghost], marks: &[Poincare] },
];

/// Whether two pens leave different traces, without colour and whatever their weight.
fn differ(first: Pen, second: Pen) -> bool {
    let ratio = |a: f32, b: f32| a.max(b) / a.min(b) > 1.5;
    match (first, second) {
        (Pen::Dashes(_, a), Pen::Dashes(_, b)) | (Pen::Dots(_, a), Pen::Dots(_, b)) => ratio(a, b),
        _ => std::mem::discriminant(&first) != std::mem::discriminant(&second),
    }
}

/// How much heavier the heavier of two solid lines is.
fn weights(first: Pen, second: Pen) -> Option<f32> {
    match (first, second) {
        (Pen::Line(a), Pen::Line(b)) => Some(a.max(b) / a.min(b)),
        _ => None,
    }
}

#[test]
fn what_shares_a_plot_differs_by_more_than_colour() {
    for plot in &PLOTS {
        let lines = plot.lines.iter().map(|series| (*series, series.pen()));
        let all: Vec<(Series, Pen)> =
            lines.chain(plot.marks.iter().map(|series| (*series, series.mark()))).collect();
        for (index, (first, pen)) in all.iter().enumerate() {
            for (second, other) in &all[index + 1..] {
                if differ(*pen, *other) {
                    continue;
                }
                // A line of at least twice the weight, if its colour is another one, too.
                let weight = weights(*pen, *other).unwrap_or(1.0);
                assert!(weight >= 2.0, "{}: {first:?} and {second:?} are drawn alike", plot.name);
                for tokens in THEMES {
                    let (found, whose) = difference(first.colour(tokens), second.colour(tokens));
                    let (name, theme) = (plot.name, tokens.number());
                    assert!(
                        found >= LEAST_DIFFERENCE,
                        "{name}: {first:?} and {second:?}, {whose}, theme {theme}: {found:.1}"
                    );
                }
            }
        }
    }
}

/// A translucent colour on a card.
fn on_card(colour: Color32, tokens: &Tokens) -> Color32 {
    tokens.card.blend(colour)
}

#[test]
fn kinds_of_motion_differ_for_all_eyes() {
    let motions = [
        Motion::Periodic { periods: 1 },
        Motion::Periodic { periods: 2 },
        Motion::Periodic { periods: 3 },
        Motion::Quasiperiodic,
        Motion::Chaotic,
        Motion::Escape { time: 1.0 },
        Motion::Undecided { why: crate::dynamics::motion::Undecided::TransientNotGone },
    ];
    for tokens in THEMES {
        for (index, first) in motions.iter().enumerate() {
            for second in &motions[index + 1..] {
                let colour = |motion: &Motion| on_card(colours::motion(*motion, tokens), tokens);
                let (found, whose) = difference(colour(first), colour(second));
                let theme = tokens.number();
                assert!(
                    found >= LEAST_DIFFERENCE,
                    "{first} and {second}, {whose}, theme {theme}: {found:.1}"
                );
            }
        }
    }
}

#[test]
fn ways_to_instability_differ_for_all_eyes() {
    let pi = std::f64::consts::PI;
    for tokens in THEMES {
        let of = |value| on_card(colours::multiplier(value, tokens), tokens);
        let areas = [
            ("nearly unstable", of(Some((0.9999, 1.0)))),
            ("period doubling", of(Some((1.3, pi)))),
            ("torus", of(Some((1.3, 1.0)))),
            ("fold", of(Some((1.3, 0.0)))),
            ("none", of(None)),
        ];
        for (index, (first, colour)) in areas.iter().enumerate() {
            for (second, other) in &areas[index + 1..] {
                let (found, whose) = difference(*colour, *other);
                let theme = tokens.number();
                assert!(
                    found >= LEAST_DIFFERENCE,
                    "{first} and {second}, {whose}, theme {theme}: {found:.1}"
                );
            }
        }
    }
}
