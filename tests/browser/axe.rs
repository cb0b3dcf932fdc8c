//! What axe-core finds wrong with the page for people who use it by other means than eyes and mouse.

use std::fs;

use serde_json::Value;

use crate::page::{Page, project};

/// Where npm puts it: `scripts/tools.sh browser`.
const SOURCE: &str = "node_modules/axe-core/axe.min.js";

/// Fails when axe-core calls anything on the page serious or critical; prints what it calls less.
pub(crate) fn check(page: &Page, what: &str) {
    let source = fs::read_to_string(project().join(SOURCE));
    let source =
        source.unwrap_or_else(|error| panic!("{SOURCE}: {error}; scripts/tools.sh browser brings it"));
    page.script(&format!("if (!window.axe) {{ {source} }}"));
    let run = "return axe.run().then(({ violations, passes }) => [passes.length, violations.map(({ id, impact, nodes }) => \
               [impact, id, nodes.map(({ html, failureSummary }) => html + ' ' + failureSummary)])])";
    let answer = page.script(run);
    let violations = answer[1].as_array().expect("a list");
    println!("axe-core, {what}: {} rules pass, {} fail", answer[0], violations.len());
    for violation in violations {
        println!("axe-core, {what}: {violation}");
    }
    let grave = |violation: &&Value| violation[0] == "serious" || violation[0] == "critical";
    let grave: Vec<&Value> = violations.iter().filter(grave).collect();
    assert!(grave.is_empty(), "{what}: {grave:#?}");
    // A page that hides everything from axe-core would pass, too.
    assert!(answer[0].as_u64() > Some(9), "axe-core looked at next to nothing: {answer}");
}
