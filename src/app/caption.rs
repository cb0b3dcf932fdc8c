//! What is computed here about a figure of the paper, in sentences whose numbers come from the model.

use super::comparison::ExactRun;
use super::figures::{BoundaryFigure, Figure, MARKED_EXCITATION};
use super::session::{Session, Shown};
use super::widgets::number::significant;
use crate::app::text::{fill, tr};
use crate::dynamics::Outcome;
use crate::sentence::Say;
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
        tr("Orange as printed; green the boundary of the coupled modes, which keeps the circuit that the printed one \
            leaves out.")
            .to_owned(),
    ];
    for (alpha, tongue) in session.comparison.tongues.iter().skip(1).take(1) {
        if let (Some(printed), Some(coupled)) = (lowest(&tongue.published), lowest(&tongue.coupled)) {
            sentences.push(fill("At α = {alpha} the least excitation is β = {printed} at ω = {printed_at} as printed, but β = {coupled} at ω = {coupled_at} with the circuit.", &[("alpha", &significant(*alpha, 1)), ("printed", &significant(printed.y, 2)), ("printed_at", &significant(printed.x, 4)), ("coupled", &significant(coupled.y, 2)), ("coupled_at", &significant(coupled.x, 4))]));
        }
    }
    sentences.push(fill(
        "Both call {point} (β = {excitation}, ω = {frequency}) stable.",
        &[
            ("point", &figure.point),
            ("excitation", &significant(MARKED_EXCITATION, 1)),
            ("frequency", &significant(figure.omega, 3)),
        ],
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
    let volts = shown.run.summary.map_or(0.0, |summary| summary.measures.v_rms);
    let volts = significant(volts, 3);
    match (shown.run.outcome(), shown.run.recurrence.and_then(|found| found.period)) {
        (Outcome::Escaped { time }, _) => fill(
            "the tip leaves over the potential barrier of the truncated force at t = {time}; that is an escape set off by \
             the start, not a growing resonance.",
            &[("time", &significant(time, 3))],
        ),
        (Outcome::Contact { time }, _) => {
            fill("the magnets touch at t = {time}.", &[("time", &significant(time, 3))])
        }
        (_, Some(1)) => fill("period 1, {volts} V rms.", &[("volts", &volts)]),
        (_, Some(period)) => {
            fill("period {period}, {volts} V rms.", &[("period", &period), ("volts", &volts)])
        }
        (_, None) => fill("the stroboscopic points never repeat; {volts} V rms.", &[("volts", &volts)]),
    }
}

/// How far the first-order theory is from a motion of period 1.
fn theory_against_run(shown: &Shown) -> Option<String> {
    if shown.run.recurrence?.period? != 1 {
        return None;
    }
    let theory = SteadyState::new(&shown.run.system).ok()?.voltage.root_mean_square();
    let off = 100.0 * (theory / shown.run.summary?.measures.v_rms - 1.0);
    let (volts, percent) = (significant(theory, 3), significant(off.abs(), 2));
    let values: [(&str, &dyn Say); 2] = [("volts", &volts), ("percent", &percent)];
    Some(if off >= 0.0 {
        fill("First-order theory says {volts} V rms, {percent} % above.", &values)
    } else {
        fill("First-order theory says {volts} V rms, {percent} % below.", &values)
    })
}

/// What both theories say of the forced motion at an unstable-looking figure.
fn stability(session: &Session, figure: &Figure, shown: &Shown) -> Option<String> {
    let resonance = figure.resonance()?;
    let p = &shown.run.system.parameters;
    let boundaries = session.boundaries.as_ref()?;
    let printed = boundaries.published.as_ref()?.boundary(resonance, p.omega);
    let coupled = boundaries.coupled.as_ref()?.boundary(resonance, p.omega);
    let unstable = |beta: Option<f64>| beta.is_some_and(|beta| p.beta > beta);
    let from = |beta: Option<f64>| {
        beta.map_or(tr("no β").to_owned(), |beta| format!("β = {}", significant(beta, 3)))
    };
    let settled_elsewhere = shown.run.recurrence.is_none_or(|found| found.period != Some(1));
    match (unstable(printed), unstable(coupled)) {
        (true, false) if settled_elsewhere => Some(fill(
            "The printed boundary puts the onset at {printed}, the coupled modes at {coupled}: by these the small forced motion is \
             stable here, and the motion seen coexists with it, reached because the run starts from rest.",
            &[("printed", &from(printed)), ("coupled", &from(coupled))],
        )),
        (true, true) => Some(fill(
            "The forced motion is unstable from {printed} as printed, from {coupled} for the coupled modes.",
            &[("printed", &from(printed)), ("coupled", &from(coupled))],
        )),
        (false, false) if settled_elsewhere => Some(
            tr("Both the printed boundary and the coupled modes call the forced motion stable here.")
                .to_owned(),
        ),
        _ => None,
    }
}

/// What the exact magnet force makes of the same run.
fn exact_law(session: &Session, shown: &Shown) -> Option<String> {
    let quadratic = shown.run.summary?.measures.v_peak;
    match session.comparison.exact.as_ref()? {
        ExactRun::Computing(_) => Some(tr("(The exact magnet force is being computed.)").to_owned()),
        ExactRun::Done(Outcome::Completed, Some(summary)) if shown.run.outcome() == Outcome::Completed => {
            Some(fill(
                "Peak voltage at the end {quadratic} V; with the exact magnet force {exact} V.",
                &[
                    ("quadratic", &significant(quadratic, 3)),
                    ("exact", &significant(summary.measures.v_peak, 3)),
                ],
            ))
        }
        ExactRun::Done(Outcome::Completed, Some(summary)) => Some(fill(
            "With the exact magnet force the same start stays bounded: peak voltage {volts} V at the end.",
            &[("volts", &significant(summary.measures.v_peak, 3))],
        )),
        ExactRun::Done(..) | ExactRun::Failed => None,
    }
}
