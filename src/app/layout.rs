//! The whole page: which parts it has, and where they are at which width.

use egui::{Margin, Ui};

use super::command::Command;
use super::panels::{self, Context};
use super::text::tr;
use super::view::Tab;
use super::{keyboard, theme, widgets};

/// Width of the left column, of that with units beside the numbers, and page width below which the columns are stacked.
const COLUMN: f32 = 296.0;
const WIDE_COLUMN: f32 = 336.0;
const STACKED: f32 = 760.0;

/// The whole page: bar, notice, column and tab.
pub(super) fn draw(context: &mut Context<'_>, notice: Option<&str>, ui: &mut Ui) {
    if let Some(embed) = context.embed {
        return panels::embedded::show(context, embed, notice, ui);
    }
    panels::greeting::show(context, ui);
    let tokens = theme::tokens(ui);
    let bar = egui::Frame::new().fill(tokens.bar).inner_margin(Margin::symmetric(14, 7));
    top_panel(ui, "bar", bar, |ui| panels::top_bar::show(context, ui));
    let page = egui::Frame::new().fill(tokens.page);
    let tab = context.view.tab;
    if let Some(message) = notice {
        let frame = page.inner_margin(Margin { left: 14, right: 14, top: 8, bottom: 0 });
        top_panel(ui, "notice", frame, |ui| draw_notice(context, ui, message));
    }
    panels::lessons::guide(context, ui);
    if ui.available_width() < STACKED {
        panels::on_top::show(context, ui);
        panels::on_top::scroll_beneath(context, ui);
        let page = page.inner_margin(Margin { left: 12, right: 0, top: 10, bottom: 10 });
        egui::CentralPanel::default().frame(page).show(ui, |ui| {
            scrolled(ui, Some(tab), |ui| {
                // A list to choose from needs no sliders above it.
                if tab == Tab::Lessons {
                    return draw_tab(context, ui);
                }
                panels::controls::above(context, ui);
                ui.add_space(8.0);
                draw_tab(context, ui);
                ui.add_space(8.0);
                panels::controls::below(context, ui);
            });
        });
        return;
    }
    let column =
        egui::Frame::new().fill(tokens.bar).inner_margin(Margin { left: 14, right: 0, top: 10, bottom: 10 });
    egui::Panel::left("controls")
        .frame(column)
        .show_separator_line(false)
        .resizable(false)
        .exact_size(if context.view.tab == Tab::Design { WIDE_COLUMN } else { COLUMN })
        .show(ui, |ui| {
            scrolled(ui, None, |ui| panels::controls::show(context, ui));
        });
    let page = page.inner_margin(Margin { left: 10, right: 0, top: 10, bottom: 10 });
    egui::CentralPanel::default()
        .frame(page)
        .show(ui, |ui| scrolled(ui, Some(tab), |ui| draw_tab(context, ui)));
}

/// A panel as high as its contents.
///
/// egui cuts off what stands below the height it had last. Where a narrower page gives the bar a second row, that would
/// be the tabs, until something else asks for a picture.
fn top_panel(ui: &mut Ui, name: &'static str, frame: egui::Frame, contents: impl FnOnce(&mut Ui)) {
    let panel = egui::Panel::top(name).frame(frame).show_separator_line(false);
    let height = panel.show(ui, contents).response.rect.height();
    let id = ui.scope_id().with(name);
    let last: Option<f32> = ui.data(|data| data.get_temp(id));
    if last.is_none_or(|last| height > last) {
        ui.ctx().request_discard("a panel has grown");
    }
    ui.data_mut(|data| data.insert_temp(id, height));
}

/// Contents that scroll when they are too tall, with a margin at the right in which the scroll bar floats. Those of
/// another `tab` than before begin at their top.
fn scrolled(ui: &mut Ui, tab: Option<Tab>, contents: impl FnOnce(&mut Ui)) {
    let mut area = widgets::touch::scroll_area(ui.ctx()).auto_shrink(false);
    let id = ui.scope_id().with("tab");
    if ui.data_mut(|data| std::mem::replace(data.get_temp_mut_or(id, tab), tab)) != tab {
        area = area.vertical_scroll_offset(0.0);
    }
    area.show(ui, |ui| {
        let margin = Margin { right: 12, ..Margin::ZERO };
        egui::Frame::new().inner_margin(margin).show(ui, |ui| {
            contents(ui);
            // Last, or what scrolls within would take it for its own.
            keyboard::keep_focus_in_view(ui);
            widgets::touch::scrolled(ui);
        });
    });
}

fn draw_tab(context: &mut Context<'_>, ui: &mut Ui) {
    match context.view.tab {
        Tab::Explore | Tab::Stability => panels::plots::show(context, ui),
        Tab::Live => panels::live::show(context, ui),
        Tab::Sweep => panels::sweep::show(context, ui),
        Tab::Design => panels::design::show(context, ui),
        Tab::Paper => panels::paper::show(context, ui),
        Tab::Lessons => panels::lessons::show(context, ui),
    }
}

fn draw_notice(context: &mut Context<'_>, ui: &mut Ui, message: &str) {
    let tokens = theme::tokens(ui);
    egui::Frame::new().fill(tokens.card).corner_radius(theme::radius::CARD).inner_margin(10).show(ui, |ui| {
        ui.horizontal(|ui| {
            if widgets::icon_button(ui, widgets::Icon::Close, tr("Dismiss")).clicked() {
                context.commands.push(Command::DismissNotice);
            }
            ui.add(egui::Label::new(egui::RichText::new(message).color(tokens.warning)).wrap());
        });
    });
}

#[cfg(test)]
mod tests {
    use crate::app::rehearsal::Desk;
    use crate::app::view::Tab;
    use crate::app::widgets::harness::Node;

    #[test]
    fn with_one_column_no_plot_is_there_twice() {
        for width in [360.0, 720.0] {
            for tab in ["explore", "live", "stability", "sweep", "design", "paper"] {
                let mut desk =
                    Desk::new(width, 4000.0, &format!(r#"{{"scenario":{{"t_end":100}},"tab":"{tab}"}}"#));
                desk.work(5);
                let labels = desk.harness.nodes.iter().map(|node| &node.label);
                let mut exports: Vec<_> = labels.filter(|label| label.starts_with("Export: ")).collect();
                let all = exports.len();
                exports.sort();
                exports.dedup();
                assert!(all > 0 && exports.len() == all, "{width}, {tab}: {exports:?}");
            }
        }
    }

    /// Scrolls down by so many points under a pointer `at` this place, to the end of the movement.
    fn turn_wheel(desk: &mut Desk, at: egui::Pos2, by: f32) {
        let turn = egui::Event::MouseWheel {
            unit: egui::MouseWheelUnit::Point,
            delta: egui::vec2(0.0, -by),
            phase: egui::TouchPhase::Move,
            modifiers: egui::Modifiers::NONE,
            source: egui::MouseWheelSource::Wheel,
        };
        desk.harness.frame(vec![egui::Event::PointerMoved(at), turn], |ui| desk.app.ui(ui));
        desk.rest(20);
    }

    #[test]
    fn a_tab_that_is_opened_begins_at_its_top() {
        for (width, height) in [(1100.0, 600.0), (360.0, 900.0)] {
            let mut desk = Desk::new(width, height, r#"{"scenario":{"t_end":100},"tab":"stability"}"#);
            desk.work(3);
            let button = |desk: &Desk| {
                // On a narrow page the plot stays, and the sliders move.
                let label = if width > super::STACKED { "Enlarge: Stability chart" } else { "Damping" };
                let found = |node: &&Node| node.label.starts_with(label);
                desk.harness.nodes.iter().find(found).map(|node| node.bounds.top())
            };
            let top = button(&desk);
            let at = egui::pos2(width - 100.0, height - 120.0);
            turn_wheel(&mut desk, at, 150.0);
            assert!(top.is_some() && button(&desk) != top, "{width}: {top:?}");
            desk.app.view.tab = Tab::Sweep;
            desk.rest(3);
            desk.app.view.tab = Tab::Stability;
            desk.rest(3);
            assert_eq!(button(&desk), top);
        }
    }

    #[test]
    fn on_a_phone_what_the_motion_is_stays_in_view_above_all_sliders() {
        for tab in ["explore", "live", "stability", "sweep", "design", "paper"] {
            let mut desk =
                Desk::new(360.0, 760.0, &format!(r#"{{"scenario":{{"t_end":100}},"tab":"{tab}"}}"#));
            desk.work(5);
            let answer = |desk: &Desk| {
                let said = |node: &&Node| node.label.contains(" rms") && node.label.contains("·");
                let found = desk.harness.nodes.iter().filter(said).map(|node| node.bounds);
                found.min_by(|a, b| a.top().total_cmp(&b.top()))
            };
            let slider = |desk: &Desk| desk.harness.find(egui::Role::Slider, "").bounds;
            let before = answer(&desk).expect("an answer");
            assert!(before.bottom() < slider(&desk).top() && before.bottom() < 500.0, "{tab}: {before}");
            turn_wheel(&mut desk, egui::pos2(180.0, 700.0), 300.0);
            assert_eq!(answer(&desk), Some(before), "{tab}");
        }
    }

    /// A finger that comes down and goes along these places, one a picture.
    fn swipe(desk: &mut Desk, path: &[egui::Pos2]) {
        use egui::{Event, Modifiers, PointerButton, TouchDeviceId, TouchId, TouchPhase};
        let touch = |phase, pos| Event::Touch {
            device_id: TouchDeviceId(0),
            id: TouchId::from(1_u64),
            phase,
            pos,
            force: None,
        };
        let (button, modifiers) = (PointerButton::Primary, Modifiers::NONE);
        let press = |pos, pressed| Event::PointerButton { pos, button, pressed, modifiers };
        let (first, last) = (path[0], path[path.len() - 1]);
        let mut pictures = vec![vec![press(first, true), touch(TouchPhase::Start, first)]];
        pictures
            .extend(path[1..].iter().map(|at| vec![Event::PointerMoved(*at), touch(TouchPhase::Move, *at)]));
        pictures.push(vec![press(last, false), Event::PointerGone, touch(TouchPhase::End, last)]);
        for mut events in pictures {
            desk.app.sift(&desk.harness.context, &mut events);
            desk.harness.frame(events, |ui| desk.app.ui(ui));
        }
        desk.work(2);
    }

    #[test]
    fn a_swipe_up_over_a_slider_or_the_plot_scrolls_and_changes_nothing() {
        let mut desk = Desk::new(360.0, 760.0, r#"{"scenario":{"t_end":100}}"#);
        desk.work(3);
        let before = desk.app.view.clone();
        for label in ["Frequency", "Damping"] {
            let slider = desk.harness.find(egui::Role::Slider, label).bounds;
            let from = slider.left_center() + egui::vec2(0.7 * slider.width(), 0.0);
            let path: Vec<_> = (0..12).map(|i| from - egui::vec2(0.0, 4.0 * i as f32)).collect();
            swipe(&mut desk, &path);
            let moved = desk.harness.find(egui::Role::Slider, label).bounds.top() - slider.top();
            assert_eq!(desk.app.view, before, "{label}");
            assert!((moved + 44.0).abs() < 2.0, "{label}: {moved}");
        }
        let slider = desk.harness.find(egui::Role::Slider, "Frequency").bounds;
        let path: Vec<_> = (0..12).map(|i| egui::pos2(300.0, 200.0 + 5.0 * i as f32)).collect();
        swipe(&mut desk, &path);
        let moved = desk.harness.find(egui::Role::Slider, "Frequency").bounds.top() - slider.top();
        assert!(desk.app.view == before && (moved - 55.0).abs() < 2.0, "{moved}");
    }

    #[test]
    fn the_very_first_swipe_scrolls_the_page_also_from_its_edge() {
        for x in [200.0, 354.0] {
            let mut desk = Desk::new(360.0, 760.0, r#"{"scenario":{"t_end":100}}"#);
            crate::app::widgets::touch::expect_fingers(&desk.harness.context);
            desk.work(3);
            let damping = |desk: &Desk| desk.harness.find(egui::Role::Slider, "Damping").bounds.top();
            let before = damping(&desk);
            let path: Vec<_> = (0..5).map(|i| egui::pos2(x, 740.0 - 20.0 * i as f32)).collect();
            swipe(&mut desk, &path);
            let moved = damping(&desk) - before;
            // As far as the finger, and some more as it was let go moving.
            assert!((-200.0..-70.0).contains(&moved), "{x}: {moved}");
        }
    }

    #[test]
    fn tabs_stay_in_sight_in_the_first_picture_of_a_narrower_page() {
        for (wide, narrow) in [(1440.0, 1000.0), (1440.0, 360.0), (768.0, 360.0)] {
            let mut desk = Desk::new(wide, 900.0, r#"{"tab":"lessons"}"#);
            desk.work(3);
            desk.harness.resize(narrow, 900.0);
            desk.rest(1);
            for (_, name) in Tab::NAMED {
                let seen = desk.harness.texts.iter().find(|(text, _)| text == name);
                assert!(seen.is_some_and(|(_, share)| *share > 0.99), "{wide} -> {narrow}: {name} {seen:?}");
            }
        }
    }
}
