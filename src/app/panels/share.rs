//! Undo, redo, and sharing what is in view: a link, its QR code, a file.

use egui::{Color32, Id, Modal, Popup, PopupCloseBehavior, RichText, TextEdit, Ui};

use super::Context;
use super::parts::{parts, usual};
use crate::app::command::Command;
use crate::app::embed;
use crate::app::exporting::request;
use crate::app::text::{fill, tr};
use crate::app::view::View;
use crate::app::widgets::{Icon, icon_button, qr_code, touch};
use crate::app::{fonts, link, theme};
use crate::export::snippet;

/// Part of the page's height that the list of parts for a frame may take.
const PARTS: f32 = 0.3;
/// Width of the popover, and the side of its code.
const WIDTH: f32 = 300.0;
const CODE: f32 = 216.0;
/// Seconds for which a button says that it copied.
const COPIED: f64 = 2.0;

/// What is remembered between frames.
#[derive(Clone, Copy, Default)]
struct Memory {
    /// The link carries theme and type size, too.
    looks: bool,
    /// The code fills the page.
    large: bool,
    /// When the link was copied, by egui's clock.
    copied: Option<f64>,
    /// The parts to embed, one a bit, when that is being chosen, and when its text was copied.
    parts: Option<u32>,
    embedded: Option<f64>,
    /// Whether it has no sliders.
    bare: bool,
    /// Which program was copied when.
    program: Option<(&'static str, f64)>,
}

/// Draws the buttons from right to left, and what they open.
pub(super) fn buttons(context: &mut Context<'_>, ui: &mut Ui) {
    let id = Id::unique("share");
    let mut memory: Memory = ui.data(|data| data.get_temp(id)).unwrap_or_default();
    let button = icon_button(ui, Icon::Share, tr("Share: link, QR code, file"));
    let (can_undo, can_redo) = context.steps;
    for (icon, label, able, command) in [
        (Icon::Redo, tr("Redo (Ctrl+Shift+Z)"), can_redo, Command::Redo),
        (Icon::Undo, tr("Undo (Ctrl+Z)"), can_undo, Command::Undo),
    ] {
        if ui.add_enabled_ui(able, |ui| icon_button(ui, icon, label)).inner.clicked() {
            context.commands.push(command);
        }
    }
    let popup = Popup::from_toggle_button_response(&button)
        .close_behavior(PopupCloseBehavior::CloseOnClickOutside)
        .accessible_name(tr("Share"));
    popup.show(|ui| popover(context, ui, &mut memory));
    if memory.large {
        large_code(ui, &link(context, &memory), &mut memory);
    }
    ui.data_mut(|data| data.insert_temp(id, memory));
    if ui.input(|input| !input.raw.hovered_files.is_empty()) {
        announce_drop(ui);
    }
}

/// The link to what is in view.
fn link(context: &Context<'_>, memory: &Memory) -> String {
    let view = context.view.clone();
    let view = if memory.looks { view } else { view.with_looks_of(&View::default()) };
    format!("{}#{}", context.address, link::write(&view))
}

fn popover(context: &mut Context<'_>, ui: &mut Ui, memory: &mut Memory) {
    let tokens = theme::tokens(ui);
    let link = link(context, memory);
    let link = link.as_str();
    ui.set_width(WIDTH.min(ui.ctx().content_rect().width() - 40.0));
    let title = ui.label(RichText::new(tr("Link to this view")).font(fonts::semibold(theme::size::TITLE)));
    let mut shown = link;
    let field = TextEdit::singleline(&mut shown).desired_width(f32::INFINITY).id_salt("link");
    ui.add(field.background_color(tokens.field)).labelled_by(title.id);
    let now = ui.input(|input| input.time);
    let copied = memory.copied.is_some_and(|then| now - then < COPIED);
    ui.horizontal(|ui| {
        if ui.button(if copied { tr("Copied") } else { tr("Copy link") }).clicked() {
            ui.ctx().copy_text(link.to_owned());
            ui.ctx().request_repaint_after_secs(COPIED as f32 + 0.1);
            memory.copied = Some(now);
        }
        if ui.button(tr("Large code")).clicked() {
            enlarge(ui, memory);
        }
        let embedding = memory.parts.is_some();
        let button = ui.add(egui::Button::new(tr("Embed")).selected(embedding));
        if button.on_hover_text(tr("Show plots of this view in slides or on a page of your own")).clicked() {
            let usual = || usual(context.view).iter().fold(0, |bits, part| bits | 1 << part);
            memory.parts = (!embedding).then(usual);
        }
    });
    ui.checkbox(&mut memory.looks, tr("with my theme and size of type"));
    ui.add_space(2.0);
    if let Some(parts) = memory.parts {
        choose_parts(context, ui, memory, parts, link);
    } else {
        let width = ui.available_width();
        ui.vertical_centered(|ui| {
            match qr_code(ui, link, CODE.min(width), tr("QR code of the link: enlarge")) {
                Some(code) if code.clicked() => enlarge(ui, memory),
                Some(_) => {}
                None => {
                    ui.label(
                        RichText::new(tr("This link is too long for a QR code.")).color(tokens.text_weak),
                    );
                }
            }
        });
    }
    ui.add_space(4.0);
    ui.horizontal(|ui| {
        if ui.button(tr("Save file")).clicked() {
            context.commands.push(Command::SaveFile);
        }
        if ui.button(tr("Open file")).clicked() {
            context.commands.push(Command::OpenFile);
        }
        let report =
            ui.button(tr("Report")).on_hover_text(tr("One page to print: device, verdict, limits and plots"));
        if report.clicked() {
            context.commands.push(Command::Report);
        }
    });
    copy_as(context, ui, memory);
    ui.label(
        RichText::new(tr("or drop a scenario or measured data on the page")).small().color(tokens.text_weak),
    );
}

/// What of this view a frame is to show, and the button that copies it.
fn choose_parts(context: &Context<'_>, ui: &mut Ui, memory: &mut Memory, mut chosen: u32, link: &str) {
    let parts = parts();
    // In one column where words would have to be broken.
    let widest = parts.iter().map(|(_, _, name)| {
        let galley = egui::WidgetText::from(tr(name)).into_galley(
            ui,
            Some(egui::TextWrapMode::Extend),
            f32::INFINITY,
            egui::TextStyle::Button,
        );
        galley.size().x
    });
    let mark = ui.spacing().icon_width + ui.spacing().icon_spacing;
    let width = widest.fold(0.0, f32::max) + mark + ui.spacing().item_spacing.x;
    let count = if 2.0 * width <= ui.available_width() { 2 } else { 1 };
    // There are more than fit a low page with what stands around them.
    let room = PARTS * ui.ctx().content_rect().height();
    touch::scroll_area(ui.ctx()).id_salt("parts").max_height(room).show(ui, |ui| {
        ui.columns(count, |columns| {
            for (i, (_, _, name)) in parts.iter().enumerate() {
                let mut shown = chosen >> i & 1 == 1;
                if columns[i * count / parts.len()].checkbox(&mut shown, tr(name)).changed() {
                    chosen ^= 1 << i;
                }
            }
        });
    });
    memory.parts = Some(chosen);
    ui.checkbox(&mut memory.bare, tr("without sliders"));
    let now = ui.input(|input| input.time);
    let copied = memory.embedded.is_some_and(|then| now - then < COPIED);
    let button = egui::Button::new(if copied { tr("Copied") } else { tr("Copy the frame as HTML") });
    if ui.add_enabled(chosen != 0, button).clicked() {
        let names: Vec<&str> =
            parts.iter().enumerate().filter(|(i, _)| chosen >> i & 1 == 1).map(|(_, part)| part.1).collect();
        let controls: &[&str] = if memory.bare { &[] } else { &["alpha", "beta", "omega"] };
        let fragment = link.split_once('#').map_or("", |(_, fragment)| fragment);
        ui.ctx().copy_text(embed::snippet(context.address, fragment, &names, controls));
        ui.ctx().request_repaint_after_secs(COPIED as f32 + 0.1);
        memory.embedded = Some(now);
    }
}

/// Buttons that copy the question of the tab in view as a program.
fn copy_as(context: &Context<'_>, ui: &mut Ui, memory: &mut Memory) {
    let now = ui.input(|input| input.time);
    ui.horizontal(|ui| {
        for name in ["Rust", "Python"] {
            let copied = memory.program.is_some_and(|(which, then)| which == name && now - then < COPIED);
            let text =
                if copied { tr("Copied").to_owned() } else { fill("Copy as {name}", &[("name", &name)]) };
            if ui.button(text).on_hover_text(tr("A program that asks the solver the same")).clicked() {
                let question = request(context.view, context.session, context.bench);
                let program =
                    if name == "Rust" { snippet::rust(&question) } else { snippet::python(&question) };
                ui.ctx().copy_text(program);
                ui.ctx().request_repaint_after_secs(COPIED as f32 + 0.1);
                memory.program = Some((name, now));
            }
        }
    });
}

/// Opens the large code in place of the popover.
fn enlarge(ui: &mut Ui, memory: &mut Memory) {
    memory.large = true;
    ui.close();
}

/// The code as large as the page allows, until a click or Escape.
fn large_code(ui: &Ui, link: &str, memory: &mut Memory) {
    let page = ui.ctx().content_rect().size();
    let side = page.x.min(page.y) - 48.0;
    let frame = egui::Frame::new().fill(Color32::WHITE).corner_radius(theme::radius::CARD).inner_margin(8);
    let modal =
        Modal::new(Id::unique("large code")).frame(frame).backdrop_color(Color32::from_black_alpha(190));
    let shown = modal.show(ui.ctx(), |ui| {
        qr_code(ui, link, side, tr("QR code of the link: close")).is_none_or(|code| code.clicked())
    });
    if shown.inner || shown.should_close() {
        memory.large = false;
    }
}

/// Says what a file that hovers over the page is for.
fn announce_drop(ui: &Ui) {
    let tokens = theme::tokens(ui);
    let layer = egui::LayerId::new(egui::Order::Foreground, Id::unique("drop"));
    let painter = ui.ctx().layer_painter(layer);
    let page = ui.ctx().content_rect();
    painter.rect_filled(page, 0, tokens.page.gamma_multiply(0.85));
    let font = fonts::semibold(theme::size::HEADING);
    let text = tr("Drop the file to open it");
    painter.text(page.center(), egui::Align2::CENTER_CENTER, text, font, tokens.text_strong);
}
