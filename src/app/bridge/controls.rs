//! The widgets of a frame, from the tree that egui makes for screen readers.

use std::collections::HashMap;

use egui::accesskit::{Action, Node, NodeId, Role, Toggled, TreeUpdate};
use serde::Serialize;

/// One widget: enough to find it by its name and to aim a pointer at it.
#[derive(Serialize)]
pub(super) struct Control {
    /// The same as long as it is there.
    id: u64,
    role: String,
    label: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    value: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    number: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    on: Option<bool>,
    enabled: bool,
    /// Whether Tab leads there, and whether it is there.
    focusable: bool,
    focused: bool,
    /// Left, top, right, bottom in CSS pixels of the page.
    bounds: [f64; 4],
}

/// Widgets that have a place on the screen; containers without a name are left out.
pub(super) fn collect(update: &TreeUpdate, zoom: f32) -> Vec<Control> {
    let nodes: HashMap<NodeId, &Node> = update.nodes.iter().map(|(id, node)| (*id, node)).collect();
    let controls = update.nodes.iter().filter_map(|(id, node)| {
        Some(Control { id: id.0, focused: *id == update.focus, ..control(node, &nodes, f64::from(zoom))? })
    });
    controls.collect()
}

fn control(node: &Node, nodes: &HashMap<NodeId, &Node>, zoom: f64) -> Option<Control> {
    let bounds = node.bounds()?;
    let label = name(node, nodes);
    if matches!(node.role(), Role::Window)
        || (label.is_empty() && matches!(node.role(), Role::GenericContainer | Role::Unknown))
    {
        return None;
    }
    Some(Control {
        id: 0,
        role: format!("{:?}", node.role()),
        label,
        value: node.value().map(str::to_owned),
        number: node.numeric_value(),
        on: node.toggled().map(|state| state == Toggled::True),
        enabled: !node.is_disabled(),
        focusable: node.supports_action(Action::Focus) && !node.is_disabled(),
        focused: false,
        bounds: [bounds.x0, bounds.y0, bounds.x1, bounds.y1].map(|edge| edge * zoom),
    })
}

/// Its own label, else the text of what labels it, else, for plain text, the text.
fn name(node: &Node, nodes: &HashMap<NodeId, &Node>) -> String {
    if let Some(label) = node.label() {
        return label.to_owned();
    }
    let given: Vec<&str> = node
        .labelled_by()
        .iter()
        .filter_map(|id| nodes.get(id))
        .filter_map(|labelling| labelling.label().or_else(|| labelling.value()))
        .collect();
    match node.role() {
        Role::Label => node.value().unwrap_or_default().to_owned(),
        _ => given.join(" "),
    }
}
