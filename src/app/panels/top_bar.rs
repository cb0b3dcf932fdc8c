//! Name, tabs, and the switches that concern the whole page.

use egui::{Popup, Ui};

use super::{Context, design, share, shortcuts};
use crate::app::command::{Command, Commands};
use crate::app::lessons::course;
use crate::app::lessons::data::Step;
use crate::app::panels::computing;
use crate::app::session::Status;
use crate::app::text::{self, Language, tr};
use crate::app::view::Tab;
use crate::app::widgets::card::has_clips;
use crate::app::widgets::{BadgeKind, Icon, badge, icon_button, sign, tabs, touch};
use crate::app::{fonts, theme};

/// Width below which the tabs move under the switches.
const NARROW: f32 = 1060.0;
/// Width below which the state of the computation is a sign without words.
const PHONE: f32 = 420.0;

/// The tabs can be pushed aside where there is no room for all of them; a bar would hide them.
const SCROLL_BAR: egui::scroll_area::ScrollBarVisibility =
    egui::scroll_area::ScrollBarVisibility::AlwaysHidden;

/// Draws the bar.
pub(in crate::app) fn show(context: &mut Context<'_>, ui: &mut Ui) {
    let width = ui.available_width();
    if width < NARROW {
        ui.vertical(|ui| {
            ui.horizontal(|ui| {
                title(ui);
                ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
                    ui.spacing_mut().item_spacing.x = 2.0;
                    shortcuts::button(ui);
                    if context.records {
                        stage(context, ui);
                    }
                    switches(context, ui, width < PHONE);
                    share::buttons(context, ui);
                    status(context, ui, if width < PHONE { sign } else { badge });
                });
            });
            // Most steps of lessons bring their tabs along, and the plot needs the room.
            if course::step(context.view).is_none_or(Step::asks_for_a_tab) {
                touch::sideways(ui.ctx())
                    .scroll_bar_visibility(SCROLL_BAR)
                    .show(ui, |ui| choose_tab(context, ui));
            }
        });
    } else {
        ui.horizontal(|ui| {
            title(ui);
            ui.add_space(8.0);
            choose_tab(context, ui);
            ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
                shortcuts::button(ui);
                stage(context, ui);
                switches(context, ui, false);
                share::buttons(context, ui);
                ui.add_space(6.0);
                status(context, ui, badge);
            });
        });
    }
}

fn title(ui: &mut Ui) {
    let tokens = theme::tokens(ui);
    let font = fonts::semibold(theme::size::HEADING);
    ui.label(egui::RichText::new("Harvester Lab").font(font).color(tokens.text_strong));
}

fn choose_tab(context: &mut Context<'_>, ui: &mut Ui) {
    let mut tab = context.view.tab;
    if tabs(ui, &mut tab, &Tab::NAMED.map(|(tab, name)| (tab, tr(name)))) {
        context.commands.push(Command::OpenTab(tab));
    }
}

fn status(context: &Context<'_>, ui: &mut Ui, badge: fn(&mut Ui, BadgeKind, &str) -> egui::Response) {
    let status = match (context.session.status(), design::shaking::under_way(context)) {
        (_, Some(part)) => Status::Computing(part),
        // What panels have asked for, the one that is least far.
        (Status::Done, None) => {
            let parts = context.studies.lanes.progress().map(|(_, part)| part);
            parts.reduce(f64::min).map_or(Status::Done, Status::Computing)
        }
        (status, None) => status,
    };
    match status {
        Status::Done => badge(ui, BadgeKind::Converged, tr("computed")),
        Status::Computing(part) => badge(ui, BadgeKind::Computing, &computing(part)),
        Status::Failed(_) => badge(ui, BadgeKind::Error, tr("no answer")),
    };
}

/// What a lecture needs: the whole screen, and a clip of the page, which says so while it is recorded.
fn stage(context: &mut Context<'_>, ui: &mut Ui) {
    if context.records {
        let tokens = theme::tokens(ui);
        let text = egui::RichText::new(tr("Stop recording")).color(tokens.on_accent);
        if ui.add(egui::Button::new(text).fill(tokens.danger)).clicked() {
            context.commands.push(Command::Record(None));
        }
    } else if has_clips(ui.ctx()) && icon_button(ui, Icon::Record, tr("Record a clip of the page")).clicked()
    {
        let whole = egui::Rect::from_min_max(egui::Pos2::ZERO, egui::pos2(1.0, 1.0));
        context.commands.push(Command::Record(Some(("page".to_owned(), whole))));
    }
    if cfg!(target_arch = "wasm32") && icon_button(ui, Icon::Enlarge, tr("Full screen (Shift+F)")).clicked() {
        context.commands.push(Command::FullScreen);
    }
}

/// Where there is no room for more switches, languages and large type stand among the themes.
fn switches(context: &mut Context<'_>, ui: &mut Ui, few: bool) {
    if !few {
        let button = icon_button(ui, Icon::Globe, tr("Language"));
        let popup = Popup::menu(&button).accessible_name(tr("Language"));
        popup.show(|ui| languages(context.commands, ui));
    }
    choose_theme(context, ui, few);
    let large = context.view.projector;
    let label = if large { tr("Normal type") } else { tr("Large type for a projector") };
    if !few && icon_button(ui, Icon::Type, label).clicked() {
        context.commands.push(Command::SetProjector(!large));
    }
    let pinned = context.session.pinned.is_some();
    let (icon, label) = if context.view.tab == Tab::Design {
        (Icon::Pin, tr("Pin this design"))
    } else if pinned {
        (Icon::Close, tr("Drop the pinned curves"))
    } else {
        (Icon::Pin, tr("Pin: keep these curves as grey ghosts to compare with"))
    };
    if icon_button(ui, icon, label).clicked() {
        context.commands.push(Command::pin(context.view.tab, pinned));
    }
}

/// The menu of themes: the choice, or the system's, and high contrast with either.
fn choose_theme(context: &mut Context<'_>, ui: &mut Ui, with_more: bool) {
    let tokens = theme::tokens(ui);
    let button = icon_button(ui, if tokens.dark { Icon::Moon } else { Icon::Sun }, tr("Theme"));
    let popup = Popup::menu(&button).accessible_name(tr("Theme"));
    let commands = &mut *context.commands;
    let view = context.view;
    popup.show(|ui| {
        let system = view.dark.is_none() && view.contrast.is_none();
        if ui.radio(system, tr("System")).clicked() {
            commands.push(Command::FollowSystem);
        }
        for (dark, name) in [(false, tr("Light")), (true, tr("Dark"))] {
            if ui.radio(view.dark == Some(dark), name).clicked() {
                commands.push(Command::SetDark(dark));
            }
        }
        ui.separator();
        let mut contrast = tokens.contrast;
        if ui.checkbox(&mut contrast, tr("High contrast")).clicked() {
            commands.push(Command::SetContrast(contrast));
        }
        if with_more {
            let mut large = view.projector;
            if ui.checkbox(&mut large, tr("Large type for a projector")).clicked() {
                commands.push(Command::SetProjector(large));
            }
            ui.separator();
            languages(commands, ui);
        }
    });
}

/// The languages, each by its own name.
fn languages(commands: &mut Commands, ui: &mut Ui) {
    for language in Language::ALL {
        if ui.radio(language == text::language(), language.own_name()).clicked() {
            commands.push(Command::Speak(language));
        }
    }
}
