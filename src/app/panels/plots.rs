//! The panels as cards, side by side or alone.

use egui::Ui;

use super::design::shaking;
use super::grid::{GAP, LEAST_HEIGHT_ALONE, grid, place};
use super::spec::Place;
use super::{Context, list, verdict};
use crate::app::command::Command;
use crate::app::text::tr;
use crate::app::view::design::Page;
use crate::app::view::{Panel, Tab};
use crate::app::widgets::{Card, Icon};

/// The verdict and the plots of the place in view.
pub(in crate::app) fn show(context: &mut Context<'_>, ui: &mut Ui) {
    if Place::of(context.view) == Place::Page(Page::Shake) {
        shaking::in_place_of_verdict(context, ui);
    } else {
        verdict::show(context, ui);
    }
    ui.add_space(GAP - ui.spacing().item_spacing.y);
    cards(context, ui);
}

/// The panels of the place in view side by side, or the one of them that fills the page.
pub(super) fn cards(context: &mut Context<'_>, ui: &mut Ui) {
    if context.on_top.is_some() {
        return;
    }
    let panels = list::at(Place::of(context.view));
    if let Some(panel) = alone(context, &panels) {
        let height = ui.available_height().max(LEAST_HEIGHT_ALONE);
        place(ui, ui.available_width(), height, &mut |ui| draw(context, ui, panel));
        return;
    }
    grid(ui, &panels, &mut |ui, panel| draw(context, ui, *panel));
}

/// The panels of the place in view below each other, each at least `least` high, or the one of them that is made large.
pub(super) fn column(context: &mut Context<'_>, ui: &mut Ui, [width, height]: [f32; 2], least: f32) {
    if context.on_top.is_some() {
        return;
    }
    let panels = list::at(Place::of(context.view));
    let panels = alone(context, &panels).map_or(panels, |panel| vec![panel]);
    let count = panels.len().max(1) as f32;
    let height = ((height - GAP * (count - 1.0)) / count).max(least);
    for (index, panel) in panels.into_iter().enumerate() {
        if index > 0 {
            ui.add_space(GAP);
        }
        place(ui, width, height, &mut |ui| draw(context, ui, panel));
    }
}

/// The one of these panels that is made large.
pub(super) fn alone(context: &Context<'_>, panels: &[Panel]) -> Option<Panel> {
    context.view.enlarged.filter(|panel| panels.contains(panel))
}

/// The card of a panel; a press of one of its buttons is carried out.
pub(super) fn draw(context: &mut Context<'_>, ui: &mut Ui, panel: Panel) {
    draw_among(context, ui, panel, &[]);
}

/// The same, where its title offers others to be shown in its place: the index of the one that was chosen.
pub(super) fn draw_among(
    context: &mut Context<'_>,
    ui: &mut Ui,
    panel: Panel,
    others: &[&str],
) -> Option<usize> {
    let spec = list::spec(panel);
    let large = context.view.enlarged == Some(panel);
    let (icon, label) =
        if large { (Icon::Shrink, tr("Show all plots")) } else { (Icon::Enlarge, tr("Enlarge")) };
    let (title, hint) = ((spec.title)(context.view), (spec.hint)(context));
    let card = Card::new(title).hint(&hint).among(others);
    let card = if spec.exports { card.exports() } else { card };
    let card = if context.on_top.is_some() { card } else { card.button(icon, label) };
    let shown = card.show(ui, |ui| {
        if context.is_stale() && spec.place.tab() != Tab::Live {
            ui.multiply_opacity(0.55);
        }
        (spec.contents)(context, ui);
    });
    context.export(title, shown.export);
    match shown.pressed {
        Some(Icon::Record) => context.record(ui, title, shown.rect),
        Some(_) => context.commands.push(Command::Enlarge((!large).then_some(panel))),
        None => {}
    }
    shown.chosen
}

#[cfg(test)]
mod tests {
    use egui::{Event, Modifiers, MouseWheelSource, MouseWheelUnit, Pos2, Role, TouchPhase, vec2};

    use crate::app::rehearsal::Desk;

    fn wheel(desk: &mut Desk, at: Pos2, modifiers: Modifiers) {
        let (unit, delta, phase) = (MouseWheelUnit::Point, vec2(0.0, -80.0), TouchPhase::Move);
        let source = MouseWheelSource::Wheel;
        let turn = Event::MouseWheel { unit, delta, phase, modifiers, source };
        let events = vec![Event::PointerMoved(at), Event::ModifiersChanged(modifiers), turn];
        desk.harness.frame(events, |ui| desk.app.ui(ui));
        for _ in 0..20 {
            desk.harness.frame(vec![Event::ModifiersChanged(Modifiers::NONE)], |ui| desk.app.ui(ui));
        }
    }

    /// Where the view can be fitted.
    fn fits(desk: &Desk) -> Vec<String> {
        let buttons = desk.harness.nodes.iter().filter(|node| node.role == Role::Button);
        buttons.map(|node| node.label.clone()).filter(|label| label.starts_with("Fit the view")).collect()
    }

    fn middle(desk: &Desk, card: &str) -> Pos2 {
        let corner = desk.harness.find(Role::Button, &format!("Enlarge: {card}")).bounds;
        corner.center() + vec2(-150.0, 130.0)
    }

    #[test]
    fn the_wheel_scrolls_the_page_and_with_ctrl_it_zooms_what_can_be_fitted_again() {
        let mut desk = Desk::new(1000.0, 560.0, r#"{"scenario":{"t_end":120.0}}"#);
        desk.work(8);
        for card in ["Stability", "Phase portrait", "Time history", "Voltage spectrum"] {
            let found =
                desk.harness.nodes.iter().find(|node| node.label.starts_with(&format!("Enlarge: {card}")));
            let Some(top) = found.map(|node| node.bounds.top()).filter(|top| *top < 400.0) else { continue };
            let at = middle(&desk, card);
            wheel(&mut desk, at, Modifiers::NONE);
            let moved = desk.harness.find(Role::Button, &format!("Enlarge: {card}")).bounds.top() - top;
            assert!((moved + 80.0).abs() < 1.0, "{card}: {moved}");
            assert!(fits(&desk).is_empty(), "{card}: {:?}", fits(&desk));
        }
        desk.harness.resize(1440.0, 900.0);
        desk.rest(2);
        let at = middle(&desk, "Phase portrait");
        wheel(&mut desk, at, Modifiers::CTRL | Modifiers::COMMAND);
        assert_eq!(fits(&desk), ["Fit the view: Phase portrait"]);
        let button = desk.harness.find(Role::Button, "Fit the view").bounds.center();
        desk.harness.click(button, |ui| desk.app.ui(ui));
        desk.rest(2);
        assert!(fits(&desk).is_empty());
    }

    #[test]
    fn a_view_is_reset_without_changing_the_device_and_does_not_outlast_it() {
        let mut desk = Desk::new(1440.0, 900.0, r#"{"scenario":{"t_end":120.0}}"#);
        desk.work(8);
        let before = desk.app.view.scenario.clone();
        let at = middle(&desk, "Phase portrait");
        let zoom = |desk: &mut Desk| {
            desk.harness.frame(vec![Event::PointerMoved(at)], |ui| desk.app.ui(ui));
            desk.harness.frame(vec![Event::Zoom(1.5)], |ui| desk.app.ui(ui));
            desk.rest(2);
            assert_eq!(fits(desk).len(), 1);
        };
        zoom(&mut desk);
        desk.harness.click(at, |ui| desk.app.ui(ui));
        assert!(desk.app.view.scenario.initial.is_some(), "a click starts there");
        desk.harness.click(at, |ui| desk.app.ui(ui));
        desk.work(3);
        assert_eq!(desk.app.view.scenario, before);
        assert!(fits(&desk).is_empty());
        zoom(&mut desk);
        desk.app.load_json(r#"{"parameters":{"omega":9.0}}"#).expect("a scenario");
        desk.work(3);
        assert_eq!(fits(&desk).len(), 1, "the same device");
        desk.app.load_json(r#"{"parameters":{"c0":0.3}}"#).expect("a scenario");
        desk.work(3);
        assert!(fits(&desk).is_empty());
    }
}
