//! A titled panel with rounded corners.

use egui::{
    Align2, Context, Id, Layout, Popup, Rect, Response, Role, Sense, Ui, UiBuilder, WidgetInfo, pos2, vec2,
};

use super::explanation::{self, explained};
use super::icon::{self, BUTTON_SIDE, Icon};
use super::plot_style::views;
use super::recorder;
use super::row;
use crate::app::text::{fill, terms, tr};
use crate::app::{fonts, theme};
use crate::export::Format;

/// Height of the title row and inner margin, points.
const TITLE_ROW: f32 = 34.0;
const MARGIN: f32 = 12.0;
/// Width of what its title means, in the menu of others.
const MEANING: f32 = 260.0;
/// Numbers of the button that gives plots their own views again, and of that which holds their axes.
const FIT: usize = usize::MAX;
const HOLD: usize = usize::MAX - 1;

fn clips() -> Id {
    Id::unique("clips")
}

/// Says whether cards can be recorded as they move.
pub fn offer_clips(context: &Context, offered: bool) {
    context.data_mut(|data| data.insert_temp(clips(), offered));
}

/// Whether what is shown can be recorded as it moves.
pub fn has_clips(context: &Context) -> bool {
    context.data(|data| data.get_temp(clips())).unwrap_or(false)
}

/// A panel with a title, a quiet hint at the right and icon buttons.
///
/// ```
/// # use harvester_lab::app::widgets::{Card, Icon};
/// # fn draw(ui: &mut egui::Ui) {
/// let card = Card::new("Phase portrait").hint("click to start there").button(Icon::Enlarge, "Enlarge");
/// let shown = card.show(ui, |ui| ui.label("a plot"));
/// if shown.pressed == Some(Icon::Enlarge) { /* fill the page with it */ }
/// # }
/// ```
pub struct Card<'a> {
    title: &'a str,
    hint: &'a str,
    among: &'a [&'a str],
    buttons: Vec<(Icon, &'a str)>,
    height: Option<f32>,
    hugging: bool,
}

/// What a card's frame did, beside its contents.
pub struct CardResponse<R> {
    /// What the contents returned.
    pub inner: R,
    /// The icon button that was pressed.
    pub pressed: Option<Icon>,
    /// What the card is to be saved as.
    pub export: Option<Format>,
    /// Index of the card that is to stand in its place.
    pub chosen: Option<usize>,
    /// The whole card.
    pub rect: Rect,
}

impl<'a> Card<'a> {
    /// A card that fills the available space. `title` identifies its buttons, so it must be unique among siblings.
    pub fn new(title: &'a str) -> Self {
        Self { title, hint: "", among: &[], buttons: Vec::new(), height: None, hugging: false }
    }

    /// Quiet text right of the title; left out where there is no room for it.
    pub fn hint(mut self, hint: &'a str) -> Self {
        self.hint = hint;
        self
    }

    /// Lets the title be pressed to choose another card by its title; this one is among them. One alone is no choice.
    pub fn among(mut self, titles: &'a [&'a str]) -> Self {
        self.among = if titles.len() > 1 { titles } else { &[] };
        self
    }

    /// Adds an icon button at the right end; `label` is its tooltip and its accessible name.
    pub fn button(mut self, icon: Icon, label: &'a str) -> Self {
        self.buttons.push((icon, label));
        self
    }

    /// Adds the button that offers to save what the card shows.
    pub fn exports(self) -> Self {
        self.button(Icon::Download, tr("Export"))
    }

    /// A fixed height in points instead of all that is available.
    pub fn height(mut self, height: f32) -> Self {
        self.height = Some(height);
        self
    }

    /// As tall as its contents.
    pub fn hugging(mut self) -> Self {
        self.hugging = true;
        self
    }

    /// Draws the card; the contents get the rectangle under the title.
    pub fn show<R>(self, ui: &mut Ui, add_contents: impl FnOnce(&mut Ui) -> R) -> CardResponse<R> {
        recorder::card(ui.ctx(), self.title);
        views::begin_card(ui.ctx());
        let (rect, background, mut child) = self.begin(ui);
        row::begin_card(ui.ctx(), (!self.hugging).then(|| child.max_rect().height()));
        let inner = add_contents(&mut child);
        row::begin_card(ui.ctx(), None);
        let (Pressed { pressed, export, chosen }, rect) = self.end(ui, &child, rect, background);
        CardResponse { inner, pressed, export, chosen, rect }
    }

    /// Reserves the card's place: its rectangle, its background to be drawn, and where its contents go.
    #[inline(never)]
    fn begin(&self, ui: &mut Ui) -> (Rect, egui::layers::ShapeIdx, Ui) {
        let available = ui.available_rect_before_wrap();
        let height = self.height.unwrap_or(available.height()).max(TITLE_ROW + 2.0 * MARGIN);
        let rect = Rect::from_min_size(available.min, vec2(available.width(), height));
        let background = ui.painter().add(egui::Shape::Noop);
        let top = if self.title.is_empty() { MARGIN } else { TITLE_ROW };
        let body = Rect::from_min_max(rect.min + vec2(MARGIN, top), rect.max - vec2(MARGIN, MARGIN));
        let builder =
            UiBuilder::new().max_rect(body).layout(Layout::top_down(egui::Align::Min)).id_salt(self.title);
        let mut child = ui.new_child(builder);
        if !self.hugging {
            child.shrink_clip_rect(rect);
        }
        (rect, background, child)
    }

    /// Draws the frame around the contents.
    #[inline(never)]
    fn end(
        &self,
        ui: &mut Ui,
        child: &Ui,
        mut rect: Rect,
        background: egui::layers::ShapeIdx,
    ) -> (Pressed, Rect) {
        if self.hugging {
            rect.max.y = child.min_rect().bottom() + MARGIN;
        }
        let tokens = theme::tokens(ui);
        let outline = if tokens.dark { tokens.edge() } else { egui::Stroke::new(1.0, tokens.outline) };
        let shape = egui::epaint::RectShape::new(
            rect,
            theme::radius::CARD,
            tokens.card,
            outline,
            egui::StrokeKind::Inside,
        );
        ui.painter().set(background, shape);
        let pressed = if self.title.is_empty() { Pressed::default() } else { self.title_row(ui, rect) };
        ui.allocate_rect(rect, Sense::hover());
        (pressed, rect)
    }

    /// Lets the title be pressed.
    fn choose(&self, ui: &Ui, title: Rect) -> Option<usize> {
        let tokens = theme::tokens(ui);
        let place = title.expand2(vec2(4.0, 6.0)).with_max_x(title.right() + 20.0);
        let response = ui.interact(place, ui.make_persistent_id((self.title, "other card")), Sense::click());
        let enabled = ui.is_enabled();
        let words = fill("{title}: show another plot here", &[("title", &self.title)]);
        response.widget_info(|| WidgetInfo::labeled(Role::Button, enabled, &words));
        let sign = Rect::from_center_size(pos2(title.right() + 11.0, title.center().y), vec2(16.0, 16.0));
        icon::paint(ui.painter(), sign, Icon::ChevronDown, tokens.text_weak);
        let mut chosen = None;
        Popup::menu(&response).show(|ui| {
            for (index, other) in self.among.iter().enumerate() {
                if ui.selectable_label(*other == self.title, *other).clicked() {
                    chosen = Some(index);
                }
            }
            if let Some(term) = terms::meaning(self.title) {
                ui.separator();
                ui.set_max_width(MEANING);
                explanation::meaning(ui, "", term);
            }
        });
        chosen
    }

    fn title_row(&self, ui: &Ui, rect: Rect) -> Pressed {
        let tokens = theme::tokens(ui);
        let middle = rect.top() + 0.5 * TITLE_ROW + 1.0;
        let at = pos2(rect.left() + MARGIN, middle);
        let title = ui.painter().text(
            at,
            Align2::LEFT_CENTER,
            self.title,
            fonts::semibold(theme::size::TITLE),
            tokens.text_strong,
        );
        let mut right = rect.right() - 5.0;
        let chosen = if self.among.is_empty() {
            let id = ui.make_persistent_id((self.title, "meaning"));
            explained(ui.interact(title.expand2(vec2(0.0, 4.0)), id, Sense::CLICK), self.title);
            None
        } else {
            self.choose(ui, title)
        };
        let (mut pressed, mut export) = (None, None);
        let held = views::held(ui.ctx());
        let hold =
            held.map(|held| (Icon::Lock, if held { tr("Let the axes go") } else { tr("Hold the axes") }));
        let changed = held == Some(false) && views::changed(ui.ctx());
        let fit = changed.then(|| (Icon::Reset, tr("Fit the view")));
        let own = hold.iter().map(|hold| (HOLD, hold)).chain(fit.iter().map(|fit| (FIT, fit)));
        for (index, (icon, label)) in self.buttons.iter().enumerate().rev().chain(own) {
            let place = Rect::from_center_size(
                pos2(right - 0.5 * BUTTON_SIDE, middle),
                egui::Vec2::splat(BUTTON_SIDE),
            );
            let id = ui.make_persistent_id((self.title, "card button", index));
            let response: Response = ui.interact(place, id, Sense::click());
            icon::paint_button(ui, place, &response, *icon, &format!("{label}: {}", self.title));
            if index == HOLD && held == Some(true) {
                let sign = Rect::from_center_size(place.center(), egui::Vec2::splat(13.0));
                icon::paint(ui.painter(), sign, *icon, tokens.accent);
            }
            if *icon == Icon::Download {
                Popup::menu(&response).show(|ui| {
                    for (format, name) in Format::ALL {
                        if ui.button(name).clicked() {
                            export = Some(format);
                        }
                    }
                    if has_clips(ui.ctx()) && ui.button(tr("Clip (video)")).clicked() {
                        pressed = Some(Icon::Record);
                    }
                });
            } else if response.clicked() && (index == FIT || (index == HOLD && held == Some(true))) {
                views::fit(ui.ctx());
            } else if response.clicked() && index == HOLD {
                views::hold(ui.ctx());
            } else if response.clicked() {
                pressed = Some(*icon);
            }
            response.on_hover_text(*label);
            right = place.left() - 2.0;
        }
        let font = fonts::regular(theme::size::SMALL);
        let hint = ui.painter().layout_no_wrap(self.hint.to_owned(), font, tokens.text_weak);
        let left = right - 4.0 - hint.size().x;
        if left > title.right() + if self.among.is_empty() { 14.0 } else { 30.0 } {
            ui.painter().galley(pos2(left, middle - 0.5 * hint.size().y), hint, tokens.text_weak);
        }
        Pressed { pressed, export, chosen }
    }
}

/// What was pressed in a title row.
#[derive(Default)]
struct Pressed {
    pressed: Option<Icon>,
    export: Option<Format>,
    chosen: Option<usize>,
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::widgets::harness::Harness;

    #[test]
    fn contents_stay_inside_and_the_button_reports() {
        let mut harness = Harness::new(500.0, 300.0);
        let mut pressed = None;
        let mut draw = |ui: &mut Ui| {
            let card =
                Card::new("Phase portrait").hint("a hint").button(Icon::Enlarge, "Enlarge").height(200.0);
            let shown = card.show(ui, |ui| ui.available_rect_before_wrap());
            assert!(shown.rect.contains_rect(shown.inner));
            assert_eq!(shown.rect.height(), 200.0);
            pressed = pressed.or(shown.pressed);
        };
        harness.settle(&mut draw);
        let button = harness.find(egui::Role::Button, "Enlarge: Phase portrait").bounds.center();
        harness.click(button, &mut draw);
        assert_eq!(pressed, Some(Icon::Enlarge));
    }

    #[test]
    fn the_menu_of_a_card_says_what_to_save_it_as_also_where_it_is_narrow() {
        let mut harness = Harness::new(340.0, 300.0);
        let mut export = None;
        let mut draw = |ui: &mut Ui| {
            let card = Card::new("Stability near ω₁+ω₂").hint("drag or click to move").exports();
            let shown = card.button(Icon::Enlarge, "Enlarge").show(ui, |ui| ui.label("a plot"));
            export = export.or(shown.export);
        };
        harness.settle(&mut draw);
        let button = harness.find(egui::Role::Button, "Export: Stability").bounds;
        let beside = harness.find(egui::Role::Button, "Enlarge: Stability").bounds;
        assert!(button.right() <= beside.left() && button.left() > 200.0, "{button:?} {beside:?}");
        harness.click(button.center(), &mut draw);
        harness.settle(&mut draw);
        let choice = harness.find(egui::Role::Button, "CSV").bounds.center();
        harness.click(choice, &mut draw);
        assert_eq!(export, Some(Format::Csv));
    }

    #[test]
    fn a_hugging_card_is_as_tall_as_its_contents() {
        let mut harness = Harness::new(500.0, 300.0);
        harness.settle(|ui| {
            let shown = Card::new("Beam").hugging().show(ui, |ui| ui.allocate_space(vec2(10.0, 50.0)));
            assert_eq!(shown.rect.height(), TITLE_ROW + 50.0 + MARGIN);
        });
    }
}
