//! The run put into words: what the motion is, what it gives, how far the model can be trusted there.

use super::map::Boundaries;
use super::session::Shown;
use super::widgets::number::{significant, with_unit};
use crate::app::text::{fill, say, tr};
use crate::dynamics::attractors::motion::Motion;
use crate::dynamics::attractors::verdict::{ForcedSummary, Verdict, Warning, force_law_warning};
use crate::dynamics::{Instability, Outcome};
use crate::theory::Resonance;

/// How the headline is coloured.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Tone {
    /// The forced motion with the excitation's own period.
    Plain,
    /// Another motion than that.
    Notable,
    /// The run ended early.
    Alarming,
}

/// The lines of the verdict bar.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Reading {
    pub tone: Tone,
    /// What the motion is.
    pub headline: String,
    /// The same for somebody who does not know the word.
    pub plain: String,
    /// What it gives.
    pub facts: Vec<String>,
    /// What to be careful about.
    pub warnings: Vec<String>,
    /// What else is known of it.
    pub remarks: Vec<String>,
}

impl Reading {
    /// Reads `shown`, with the boundaries of its structure when there are some, and the `verdict` on the same scenario
    /// once it is there: until then only stroboscopic points that have settled say anything.
    pub(super) fn new(shown: &Shown, boundaries: Option<&Boundaries>, verdict: Option<&Verdict>) -> Self {
        let (tone, headline, plain) =
            verdict.map_or_else(|| first_look(shown), |verdict| headline(verdict.motion));
        let facts = measured(shown, verdict);
        let (mut warnings, mut remarks) = (Vec::new(), Vec::new());
        match verdict {
            Some(verdict) => {
                remarks.extend(resonance(shown, boundaries, verdict));
                remarks.extend(multiplier(verdict));
                remarks.extend(verdict.forced.as_ref().and_then(|forced| forced_motion(forced, verdict)));
                remarks.extend(verdict.coexists.iter().map(|other| say(other)));
                remarks.extend(disagreement(verdict));
                warnings.extend(verdict.warnings.iter().map(|warning| say(warning)));
            }
            None => {
                remarks.extend(settling(shown));
                warnings.extend(force_law(shown).map(|warning| say(&warning)));
            }
        }
        remarks.extend(boundaries.and_then(|boundaries| theories(shown, boundaries)));
        if shown.scenario.base().loss_tangent > 0.0 {
            remarks.push(tr("without the dielectric loss, which the Design tab counts").to_owned());
        }
        Self { tone, headline, plain, facts, warnings, remarks }
    }
}

/// By the run alone.
fn first_look(shown: &Shown) -> (Tone, String, String) {
    let open = |headline: &str, plain: &str| (Tone::Plain, headline.to_owned(), plain.to_owned());
    match (shown.run.outcome(), shown.run.recurrence.map(|found| found.period.filter(|_| found.settled))) {
        (Outcome::Escaped { time }, _) => headline(Motion::Escape { time }),
        (Outcome::Contact { time }, _) => headline(Motion::Contact { time }),
        (Outcome::Completed, None) => open(tr("Too short to classify"), tr("let it run longer")),
        (Outcome::Completed, Some(Some(periods))) => headline(Motion::Periodic { periods }),
        (Outcome::Completed, Some(None)) => {
            open(tr("Not settled yet"), tr("it still remembers how it was started"))
        }
    }
}

/// How a motion is coloured, what it is called, and what that means.
fn headline(motion: Motion) -> (Tone, String, String) {
    let (tone, name, plain) = match motion {
        Motion::Periodic { periods: 1 } => {
            (Tone::Plain, tr("Period 1").to_owned(), tr("it swings in step with the shaking"))
        }
        Motion::Periodic { periods } => {
            let name = fill("Period {periods}", &[("periods", &periods)]);
            let plain = fill("it repeats only every {periods} shakes", &[("periods", &periods)]);
            return (Tone::Notable, name, plain);
        }
        Motion::Quasiperiodic => {
            let name = tr("Quasiperiodic: a torus").to_owned();
            (Tone::Notable, name, tr("two rhythms at once, so it never quite repeats"))
        }
        Motion::Chaotic => {
            (Tone::Notable, tr("Chaotic").to_owned(), tr("no swing is like another, and it never repeats"))
        }
        Motion::Escape { time } => {
            let name = fill("Escape at t = {time}", &[("time", &significant(time, 4))]);
            (Tone::Alarming, name, tr("the tip leaves and does not come back"))
        }
        Motion::Contact { time } => {
            let name = fill("Contact at t = {time}", &[("time", &significant(time, 4))]);
            (Tone::Alarming, name, tr("the tip hits the fixed magnet"))
        }
        Motion::Undecided { why } => (Tone::Notable, fill("Undecided: {why}", &[("why", &why)]), ""),
    };
    (tone, name, plain.to_owned())
}

/// Which resonance a motion other than the forced one belongs to.
fn resonance(shown: &Shown, boundaries: Option<&Boundaries>, verdict: &Verdict) -> Option<String> {
    let motion = verdict.motion;
    let near = boundaries?.resonance_near(shown.run.system.parameters.omega)?;
    let name = match (motion, near) {
        (Motion::Periodic { periods }, Resonance::First) if periods % 2 == 0 => tr("subharmonic of mode 1"),
        (Motion::Periodic { periods }, Resonance::Second) if periods % 2 == 0 => tr("subharmonic of mode 2"),
        (Motion::Quasiperiodic, Resonance::Sum) => tr("combination of modes 1 and 2"),
        _ => return None,
    };
    Some(name.to_owned())
}

fn multiplier(verdict: &Verdict) -> Option<String> {
    let found = verdict.multiplier?;
    Some(fill("largest multiplier {modulus}", &[("modulus", &significant(found.modulus, 4))]))
}

fn measured(shown: &Shown, verdict: Option<&Verdict>) -> Vec<String> {
    let summary = match (&shown.run.summary, shown.run.outcome()) {
        (Some(summary), Outcome::Completed) => summary,
        // Voltages of a tip that has flown off mean nothing.
        (_, Outcome::Escaped { .. }) => {
            return vec![tr("the tip left over the truncated force's barrier").to_owned()];
        }
        _ => return Vec::new(),
    };
    let system = &shown.run.system;
    let v_rms = verdict.and_then(|verdict| verdict.v_rms).unwrap_or(summary.measures.v_rms);
    let lowest = verdict.and_then(|verdict| verdict.tip_over_gap).map(|(low, _)| low);
    let lowest = lowest.unwrap_or(summary.measures.tip.0 / system.equilibrium.gap);
    let mut facts = vec![fill("{volts} V rms", &[("volts", &significant(v_rms, 3))])];
    let kappa = system.parameters.kappa;
    if kappa > 0.0 {
        facts.push(with_unit(shown.scenario.units().watts(kappa * v_rms * v_rms), "W"));
    }
    facts.push(fill(
        "tip closes {percent} % of the gap",
        &[("percent", &significant((-100.0 * lowest).max(0.0), 2))],
    ));
    facts
}

/// What the forced motion does, where the motion reached is another one or it has lost its stability.
fn forced_motion(forced: &ForcedSummary, verdict: &Verdict) -> Option<String> {
    if forced.stable {
        // Said by what coexists, or the motion reached is the forced one.
        return (verdict.motion != Motion::Periodic { periods: 1 }).then(|| {
            fill(
                "the forced motion is stable (|μ| = {modulus})",
                &[("modulus", &significant(forced.multiplier.modulus, 4))],
            )
        });
    }
    let how = match forced.instability? {
        Instability::Fold => tr("fold"),
        Instability::PeriodDoubling => tr("period doubling"),
        Instability::NeimarkSacker => tr("Neimark–Sacker"),
    };
    let modulus = significant(forced.multiplier.modulus, 4);
    Some(match forced.unstable_from {
        Some(beta) => fill(
            "the forced motion is unstable from β = {beta}: {how}, |μ| = {modulus}",
            &[("beta", &significant(beta, 3)), ("how", &how), ("modulus", &modulus)],
        ),
        None => fill(
            "the forced motion is unstable: {how}, |μ| = {modulus}",
            &[("how", &how), ("modulus", &modulus)],
        ),
    })
}

fn disagreement(verdict: &Verdict) -> Option<String> {
    (!verdict.disagreeing.is_empty()).then(|| {
        fill("by the run alone: {motion}; other evidence contradicts it", &[("motion", &verdict.suspected)])
    })
}

fn settling(shown: &Shown) -> Option<String> {
    let found = shown.run.recurrence?;
    let percent = significant(100.0 * found.defect, 2);
    match (found.period, found.settled) {
        (Some(_), true) => None,
        (Some(_), false) => {
            Some(fill("still settling: {percent} % from repeating", &[("percent", &percent)]))
        }
        (None, _) => Some(tr("stroboscopic points do not repeat within 8 periods").to_owned()),
    }
}

/// Where the two theories put the boundary, near a resonance.
fn theories(shown: &Shown, boundaries: &Boundaries) -> Option<String> {
    let p = &shown.run.system.parameters;
    let resonance = boundaries.resonance_near(p.omega)?;
    let word = |boundary: Option<f64>| match boundary {
        Some(beta) if p.beta > beta => fill("unstable from β = {beta}", &[("beta", &significant(beta, 3))]),
        Some(beta) => fill("stable up to β = {beta}", &[("beta", &significant(beta, 3))]),
        None => tr("stable").to_owned(),
    };
    let published = boundaries.published.as_ref()?.boundary(resonance, p.omega);
    let coupled = boundaries.coupled.as_ref()?.boundary(resonance, p.omega);
    Some(fill(
        "published theory: {published}; coupled modes: {coupled}",
        &[("published", &word(published)), ("coupled", &word(coupled))],
    ))
}

/// How wrong a truncated force law is where the tip comes closest to the magnet.
fn force_law(shown: &Shown) -> Option<Warning> {
    let run = &shown.run;
    let completed = run.outcome() == Outcome::Completed;
    run.summary
        .filter(|_| completed)
        .and_then(|summary| force_law_warning(&run.system, summary.measures.tip.0))
}
