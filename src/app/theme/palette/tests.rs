//! Legibility, and difference for all eyes.

mod sight;

use sight::{contrast, difference};

use super::*;
use crate::app::colours;
use crate::app::widgets::Series::{self, *};
use crate::dynamics::attractors::motion::Motion;
use crate::export::Pen;

const THEMES: [&Tokens; 4] = [&DARK, &LIGHT, &BLACK, &WHITE];
/// Least difference of two colours that nothing else tells apart, by CIEDE2000; about 2 are just noticed side by side.
const LEAST_DIFFERENCE: f64 = 10.0;

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
const PLOTS: [PlotOf; 17] = [
    PlotOf { name: "stability map", lines: &[Published, Coupled, Exact], marks: &[Ghost] },
    // The exact boundary of another device, while that of this one is computed.
    PlotOf { name: "stability map before", lines: &[Published, Coupled, Ghost], marks: &[Ghost] },
    PlotOf { name: "phase portrait", lines: &[Numeric, Ghost], marks: &[Theory] },
    PlotOf { name: "Poincaré map", lines: &[], marks: &[Poincare, TheoryPoint, Ghost] },
    PlotOf { name: "time history", lines: &[Numeric, Ghost], marks: &[Theory] },
    PlotOf { name: "multipliers", lines: &[Ghost], marks: &[Forced, Reached] },
    PlotOf {
        name: "bifurcation curves",
        lines: &[Exact, Subcritical, Torus, SubcriticalTorus, Fold],
        marks: &[],
    },
    PlotOf { name: "orbit diagram", lines: &[], marks: &[Up, Down, Unsettled] },
    PlotOf { name: "response", lines: &[Stable, Unstable, Ghost], marks: &[Up, Down, Unsettled] },
    PlotOf {
        name: "harvest",
        lines: &[Linear, Stable, Unstable],
        marks: &[FromRest, Up, Down, Beyond, Measured],
    },
    PlotOf { name: "variants", lines: &[Stable, Variant(0), Variant(1), Variant(2), Variant(3)], marks: &[] },
    PlotOf { name: "tolerances", lines: &[Numeric, Linear], marks: &[] },
    PlotOf { name: "store", lines: &[Stable, Linear, Best], marks: &[] },
    PlotOf { name: "load", lines: &[Linear, Stable, Unstable, Theory, Best], marks: &[Up, Beyond] },
    PlotOf {
        name: "measured over frequency",
        lines: &[Linear, Stable, Best, Ghost],
        marks: &[FromRest, Measured],
    },
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
        Motion::Undecided { why: crate::dynamics::attractors::motion::Undecided::TransientNotGone },
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
