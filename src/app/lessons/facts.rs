//! What is known of the page and of the motion in view.
//!
//! Facts are one JSON value: `view` as stored, `verdict` as the solver answers, and `theory`: at the frequency in view,
//! `over_published` and `over_coupled` are the excitation over the boundary of either theory, near a resonance.

use serde_json::{Value, json};

use crate::app::map::{Boundaries, structure};
use crate::app::view::View;
use crate::dynamics::Verdict;
use crate::questions::inspection;

/// The facts of a page that shows `view`, with the boundaries of its structure and the verdict on its scenario once they
/// are there.
pub(in crate::app) fn facts(
    view: &View,
    boundaries: Option<&Boundaries>,
    verdict: Option<&Verdict>,
) -> Value {
    let over = |boundary: Option<f64>| boundary.map(|beta| view.scenario.parameters.beta / beta);
    let omega = view.scenario.parameters.omega;
    let near = boundaries.and_then(|found| Some((found, found.resonance_near(omega)?)));
    let published = near.and_then(|(found, near)| found.published.as_ref()?.boundary(near, omega));
    let coupled = near.and_then(|(found, near)| found.coupled.as_ref()?.boundary(near, omega));
    // By way of text: another serialiser would weigh more.
    let verdict = verdict.and_then(|verdict| serde_json::to_string(verdict).ok());
    let verdict: Value = verdict.and_then(|text| serde_json::from_str(&text).ok()).unwrap_or_default();
    json!({
        "view": view.to_value(),
        "verdict": verdict,
        "theory": { "over_published": over(published), "over_coupled": over(coupled) },
    })
}

/// The facts with the verdict computed at once, as a page would know them after a while.
///
/// # Errors
/// One line when the scenario cannot be computed.
pub fn facts_at_once(view: &View) -> Result<Value, String> {
    let (system, _) = view.scenario.validate().map_err(|error| error.to_string())?;
    let boundaries = Boundaries::new(structure(&view.scenario), &system);
    let found = inspection::inspect(&view.scenario).map_err(|error| error.to_string())?;
    Ok(facts(view, Some(&boundaries), Some(&found.verdict)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::lessons::condition::tests::holds;

    #[test]
    fn the_facts_hold_view_verdict_and_theory() {
        // Figure 9, with the numbers of an independent program.
        let figure =
            crate::app::link::read("v=1&alpha=1e-4&beta=0.01&omega=8.0969&c0=0.5084", &View::default()).0;
        let facts = facts_at_once(&figure).expect("facts");
        for condition in [
            r#"{"at":"/view/scenario/parameters/beta","is":0.01}"#,
            r#"{"at":"/view/tab","is":"explore"}"#,
            r#"{"at":"/verdict/motion/kind","is":"periodic"}"#,
            r#"{"at":"/verdict/motion/periods","is":2}"#,
            r#"{"at":"/verdict/forced/multiplier/modulus","from":1.1482,"to":1.1486}"#,
            r#"{"at":"/theory/over_coupled","from":6.02,"to":6.05}"#,
            r#"{"at":"/theory/over_published","from":100}"#,
        ] {
            assert!(holds(condition, &facts), "{condition}");
        }
        // Far from any resonance the theories say nothing.
        let mut view = View::default();
        view.scenario.parameters.omega = 15.0;
        let facts = facts_at_once(&view).expect("facts");
        assert!(!holds(r#"{"at":"/theory/over_coupled","from":0}"#, &facts));
    }
}
