//! Colours that stand for numbers and kinds in charts.

use egui::Color32;

use super::theme::Tokens;
use crate::app::text::tr;
use crate::dynamics::Instability;
use crate::dynamics::attractors::motion::Motion;

/// Decay and growth per excitation period at which a chart's colour has gone two thirds of its way.
const DECAY_SCALE: f64 = 0.01;
const GROWTH_SCALE: f64 = 0.05;
/// An argument nearer to 0 or pi than this belongs to a real multiplier (radians).
const REAL: f64 = 1e-6;

/// The colour of an instability's kind.
pub(super) fn instability(kind: Instability, tokens: &Tokens) -> Color32 {
    match kind {
        Instability::PeriodDoubling => tokens.exact,
        Instability::NeimarkSacker => tokens.poincare,
        Instability::Fold => tokens.warning,
    }
}

/// The name of an instability's kind.
pub(super) fn name(kind: Instability) -> &'static str {
    match kind {
        Instability::Fold => tr("fold"),
        Instability::PeriodDoubling => tr("period doubling"),
        Instability::NeimarkSacker => tr("Neimark–Sacker"),
    }
}

/// The kind that a multiplier of this absolute argument belongs to.
pub(super) fn kind_of(argument: f64) -> Instability {
    if argument < REAL {
        Instability::Fold
    } else if argument > std::f64::consts::PI - REAL {
        Instability::PeriodDoubling
    } else {
        Instability::NeimarkSacker
    }
}

/// The colour of a largest multiplier: blue when stable, the brighter the slower it decays; in the colour of its kind
/// when unstable, the stronger the faster it grows; that of missing things where there is no forced motion.
pub(super) fn multiplier(value: Option<(f64, f64)>, tokens: &Tokens) -> Color32 {
    let Some((modulus, argument)) = value else { return tokens.track };
    let rate = modulus.ln();
    if rate < 0.0 {
        let share = (rate / DECAY_SCALE).exp();
        tokens.inset.lerp_to_gamma(tokens.numeric, 0.06 + 0.44 * share as f32)
    } else {
        let share = 1.0 - (-rate / GROWTH_SCALE).exp();
        let colour = instability(kind_of(argument), tokens);
        tokens.inset.lerp_to_gamma(colour, 0.55 + 0.45 * share as f32)
    }
}

/// The colour of a class of motion.
pub(super) fn motion(motion: Motion, tokens: &Tokens) -> Color32 {
    let colour = match motion {
        Motion::Periodic { periods: 1 } => tokens.numeric.gamma_multiply(0.55),
        Motion::Periodic { periods: 2 } => tokens.exact,
        Motion::Periodic { .. } => tokens.warning,
        Motion::Quasiperiodic => tokens.poincare,
        Motion::Chaotic => tokens.ok,
        Motion::Escape { .. } | Motion::Contact { .. } => return tokens.track,
        Motion::Undecided { .. } => return tokens.ghost,
    };
    tokens.inset.lerp_to_gamma(colour, 0.85)
}

/// A colour of the sequential scale (viridis, legible without colour vision) at 0 to 1.
pub(super) fn sequential(share: f64) -> Color32 {
    let colour = colorous::VIRIDIS.eval_continuous(share.clamp(0.0, 1.0));
    Color32::from_rgb(colour.r, colour.g, colour.b)
}
