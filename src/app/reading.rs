//! The run put into words: what the motion is, what it gives, how far the model can be trusted there.

use super::map::Boundaries;
use super::session::Shown;
use super::widgets::number::significant;
use crate::dynamics::Outcome;
use crate::model::force::Exact;
use crate::model::{Device, RestForce};

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
    /// What it gives.
    pub facts: Vec<String>,
    /// What to know about it.
    pub remarks: Vec<String>,
}

impl Reading {
    /// Reads `shown`, with the boundaries of its structure when there are some.
    pub(super) fn new(shown: &Shown, boundaries: Option<&Boundaries>) -> Self {
        let (tone, headline) = headline(shown);
        let mut remarks = Vec::new();
        remarks.extend(settling(shown));
        remarks.extend(boundaries.and_then(|boundaries| theories(shown, boundaries)));
        remarks.extend(force_law(shown));
        if let Outcome::Escaped { .. } = shown.run.outcome() {
            remarks.push("the exact force law (under Model) has no such barrier".to_owned());
        }
        Self { tone, headline, facts: facts(shown), remarks }
    }
}

fn headline(shown: &Shown) -> (Tone, String) {
    match (shown.run.outcome(), shown.run.recurrence) {
        (Outcome::Escaped { time }, _) => (Tone::Alarming, format!("Escape at t = {}", significant(time, 4))),
        (Outcome::Contact { time }, _) => {
            (Tone::Alarming, format!("Contact at t = {}", significant(time, 4)))
        }
        (Outcome::Completed, None) => (Tone::Plain, "Too short to classify".to_owned()),
        (Outcome::Completed, Some(found)) => match found.period {
            Some(1) => (Tone::Plain, "Period 1".to_owned()),
            Some(period) => (Tone::Notable, format!("Period {period}")),
            None => (Tone::Notable, "Not periodic".to_owned()),
        },
    }
}

fn facts(shown: &Shown) -> Vec<String> {
    let summary = match (&shown.run.summary, shown.run.outcome()) {
        (Some(summary), Outcome::Completed) => summary,
        // Voltages of a tip that has flown off mean nothing.
        (_, Outcome::Escaped { .. }) => {
            return vec!["the tip left over the truncated force's barrier".to_owned()];
        }
        _ => return Vec::new(),
    };
    let system = &shown.run.system;
    let gap = system.equilibrium.gap;
    let mut facts = vec![
        format!("{} V rms", significant(summary.v_rms, 3)),
        format!("{} V peak", significant(summary.v_peak, 3)),
    ];
    if let Some(resistance) = Device::default().resistance_of(system.parameters.kappa) {
        facts.push(format!("{} µW", significant(1e6 * summary.v_rms.powi(2) / resistance, 3)));
    }
    let nearest = -100.0 * summary.tip_min / gap;
    facts.push(format!("tip closes {} % of the gap", significant(nearest.max(0.0), 2)));
    facts
}

fn settling(shown: &Shown) -> Option<String> {
    let found = shown.run.recurrence?;
    let percent = significant(100.0 * found.defect, 2);
    match (found.period, found.settled) {
        (Some(_), true) => None,
        (Some(_), false) => Some(format!("still settling: {percent} % from repeating")),
        (None, _) => Some("stroboscopic points do not repeat within 8 periods".to_owned()),
    }
}

/// Whether the two theories call the operating point stable, where it is near a resonance.
fn theories(shown: &Shown, boundaries: &Boundaries) -> Option<String> {
    let p = &shown.run.system.parameters;
    let resonance = boundaries.resonance_near(p.omega)?;
    let word = |boundary: Option<f64>| match boundary {
        Some(beta) if p.beta > beta => format!("unstable (from β = {})", significant(beta, 3)),
        Some(beta) => format!("stable (up to β = {})", significant(beta, 3)),
        None => "stable".to_owned(),
    };
    let published = boundaries.published.as_ref()?.boundary(resonance, p.omega);
    let coupled = boundaries.coupled.as_ref()?.boundary(resonance, p.omega);
    Some(format!("forced motion: published theory {}, coupled modes {}", word(published), word(coupled)))
}

/// How wrong a truncated force law is where the tip comes closest to the magnet.
fn force_law(shown: &Shown) -> Option<String> {
    let run = &shown.run;
    let system = &run.system;
    if system.parameters.c0 == 0.0 || run.outcome() != Outcome::Completed {
        return None;
    }
    let closest = run.summary?.tip_min;
    let exact = Exact::new(&system.magnet(), &system.equilibrium);
    let contact = exact.contact()?;
    if closest <= contact {
        return Some(
            "the tip passes through the magnet: only the exact force law knows of contact".to_owned(),
        );
    }
    let (true_rest, used) = (exact.rest(closest), system.rest_force().rest(closest));
    let missing = 100.0 * (1.0 - used / true_rest);
    let word = if missing > 0.0 { "weak" } else { "strong" };
    (missing.abs() >= 10.0)
        .then(|| format!("force law {} % too {word} at closest approach", significant(missing.abs(), 2)))
}
