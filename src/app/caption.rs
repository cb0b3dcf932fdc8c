//! What is computed here about a figure of the paper, in sentences whose numbers come from the model.

use super::comparison::ExactRun;
use super::figures::{BoundaryFigure, Figure, MARKED_EXCITATION};
use super::session::{Session, Shown};
use super::widgets::number::significant;
use crate::dynamics::Outcome;
use crate::theory::SteadyState;

/// The sentences for `figure`.
pub(super) fn caption(session: &Session, figure: &Figure) -> String {
    let sentences = match figure.boundaries() {
        Some(boundaries) => boundary_sentences(session, &boundaries),
        None => {
            session.shown.as_ref().map_or_else(Vec::new, |shown| response_sentences(session, figure, shown))
        }
    };
    sentences.join(" ")
}

fn boundary_sentences(session: &Session, figure: &BoundaryFigure) -> Vec<String> {
    let lowest = |curve: &[egui_plot::PlotPoint]| {
        curve.iter().filter(|place| place.y.is_finite()).min_by(|a, b| a.y.total_cmp(&b.y)).copied()
    };
    let mut sentences = vec![
        "Orange as printed; green the boundary of the coupled modes, which keeps the circuit that the printed one \
         leaves out."
            .to_owned(),
    ];
    for (alpha, tongue) in session.comparison.tongues.iter().skip(1).take(1) {
        if let (Some(printed), Some(coupled)) = (lowest(&tongue.published), lowest(&tongue.coupled)) {
            sentences.push(format!(
                "At α = {} the least excitation is β = {} at ω = {} as printed, but β = {} at ω = {} with the circuit.",
                significant(*alpha, 1),
                significant(printed.y, 2),
                significant(printed.x, 4),
                significant(coupled.y, 2),
                significant(coupled.x, 4),
            ));
        }
    }
    sentences.push(format!(
        "Both call {} (β = {}, ω = {}) stable.",
        figure.point,
        significant(MARKED_EXCITATION, 1),
        significant(figure.omega, 3)
    ));
    if !both_stable(session, figure) {
        sentences.pop();
    }
    sentences
}

/// Whether the marked point is below every boundary drawn.
fn both_stable(session: &Session, figure: &BoundaryFigure) -> bool {
    let Some(boundaries) = &session.boundaries else { return false };
    let above = |beta: Option<f64>| beta.is_none_or(|beta| beta > MARKED_EXCITATION);
    let (resonance, omega) = (figure.resonance, figure.omega);
    boundaries.published.as_ref().is_some_and(|theory| above(theory.boundary(resonance, omega)))
        && boundaries.coupled.as_ref().is_some_and(|theory| above(theory.boundary(resonance, omega)))
}

fn response_sentences(session: &Session, figure: &Figure, shown: &Shown) -> Vec<String> {
    let mut sentences = vec![motion(shown)];
    sentences.extend(theory_against_run(shown));
    sentences.extend(stability(session, figure, shown));
    sentences.extend(exact_law(session, shown));
    sentences
}

fn motion(shown: &Shown) -> String {
    let volts = shown.run.summary.map_or(0.0, |summary| summary.v_rms);
    let volts = significant(volts, 3);
    match (shown.run.outcome(), shown.run.recurrence.and_then(|found| found.period)) {
        (Outcome::Escaped { time }, _) => format!(
            "the tip leaves over the potential barrier of the truncated force at t = {}; that is an escape set off by \
             the start, not a growing resonance.",
            significant(time, 3)
        ),
        (Outcome::Contact { time }, _) => format!("the magnets touch at t = {}.", significant(time, 3)),
        (_, Some(1)) => format!("period 1, {volts} V rms."),
        (_, Some(period)) => format!("period {period}, {volts} V rms."),
        (_, None) => format!("the stroboscopic points never repeat; {volts} V rms."),
    }
}

/// How far the first-order theory is from a motion of period 1.
fn theory_against_run(shown: &Shown) -> Option<String> {
    if shown.run.recurrence?.period? != 1 {
        return None;
    }
    let theory = SteadyState::new(&shown.run.system).ok()?.voltage.root_mean_square();
    let off = 100.0 * (theory / shown.run.summary?.v_rms - 1.0);
    let word = if off >= 0.0 { "above" } else { "below" };
    Some(format!(
        "First-order theory says {} V rms, {} % {word}.",
        significant(theory, 3),
        significant(off.abs(), 2)
    ))
}

/// What both theories say of the forced motion at an unstable-looking figure.
fn stability(session: &Session, figure: &Figure, shown: &Shown) -> Option<String> {
    let resonance = figure.resonance()?;
    let p = &shown.run.system.parameters;
    let boundaries = session.boundaries.as_ref()?;
    let printed = boundaries.published.as_ref()?.boundary(resonance, p.omega);
    let coupled = boundaries.coupled.as_ref()?.boundary(resonance, p.omega);
    let unstable = |beta: Option<f64>| beta.is_some_and(|beta| p.beta > beta);
    let from =
        |beta: Option<f64>| beta.map_or("no β".to_owned(), |beta| format!("β = {}", significant(beta, 3)));
    let settled_elsewhere = shown.run.recurrence.is_none_or(|found| found.period != Some(1));
    match (unstable(printed), unstable(coupled)) {
        (true, false) if settled_elsewhere => Some(format!(
            "The printed boundary puts the onset at {}, the coupled modes at {}: by these the small forced motion is \
             stable here, and the motion seen coexists with it, reached because the run starts from rest.",
            from(printed),
            from(coupled)
        )),
        (true, true) => Some(format!(
            "The forced motion is unstable from {} as printed, from {} for the coupled modes.",
            from(printed),
            from(coupled)
        )),
        (false, false) if settled_elsewhere => Some(
            "Both the printed boundary and the coupled modes call the forced motion stable here.".to_owned(),
        ),
        _ => None,
    }
}

/// What the exact magnet force makes of the same run.
fn exact_law(session: &Session, shown: &Shown) -> Option<String> {
    let quadratic = shown.run.summary?.v_peak;
    match session.comparison.exact.as_ref()? {
        ExactRun::Computing(_) => Some("(The exact magnet force is being computed.)".to_owned()),
        ExactRun::Done(Outcome::Completed, Some(summary)) if shown.run.outcome() == Outcome::Completed => {
            Some(format!(
                "Peak voltage at the end {} V; with the exact magnet force {} V.",
                significant(quadratic, 3),
                significant(summary.v_peak, 3)
            ))
        }
        ExactRun::Done(Outcome::Completed, Some(summary)) => Some(format!(
            "With the exact magnet force the same start stays bounded: peak voltage {} V at the end.",
            significant(summary.v_peak, 3)
        )),
        ExactRun::Done(..) | ExactRun::Failed => None,
    }
}
