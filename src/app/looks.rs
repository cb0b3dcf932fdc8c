//! What suits the room and the eyes: the theme and the size of type; and views of plots that suit the device.

use super::widgets::plot_style;
use super::{App, theme};
use crate::model::Parameter;
use crate::scenario::Forgotten;

/// What the system asks of every page.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Wishes {
    /// High contrast.
    pub contrast: bool,
    /// That nothing moves by itself.
    pub stillness: bool,
}

impl App {
    /// Says what the system asks for.
    pub fn set_wishes(&mut self, wishes: Wishes) {
        self.wishes = wishes;
    }

    /// Whether what can move by itself does.
    pub(super) fn moves(&self) -> bool {
        self.view.beam_moves.unwrap_or(!self.wishes.stillness)
    }

    /// Whether the theme is dark, and whether it has high contrast.
    pub fn look(&self, context: &egui::Context) -> (bool, bool) {
        let system = context.system_theme().unwrap_or(egui::Theme::Dark) == egui::Theme::Dark;
        (self.view.dark.unwrap_or(system), self.view.contrast.unwrap_or(self.wishes.contrast))
    }

    /// Tells egui about theme and type size when they have changed.
    pub(super) fn style(&mut self, context: &egui::Context) {
        let (dark, contrast) = self.look(context);
        let wanted = (dark, contrast, self.view.projector);
        if self.styled == Some(wanted) {
            return;
        }
        theme::apply(context, theme::Tokens::of(dark, contrast));
        context.set_zoom_factor(if wanted.2 { theme::PROJECTOR_ZOOM } else { 1.0 });
        self.styled = Some(wanted);
    }

    /// Lets no view of a plot outlast the device that it was chosen for; shaking and load are not the device's.
    pub(super) fn begin_views(&mut self, context: &egui::Context) {
        let outer = [Parameter::Omega, Parameter::Beta, Parameter::Kappa];
        let outer = outer.map(|parameter| Forgotten::Number(parameter, 0.0));
        let device =
            self.view.scenario.forgetting(&outer).forgetting(&[Forgotten::Start, Forgotten::Duration]);
        if self.device.as_ref() != Some(&device) {
            plot_style::views::another_device(context);
            self.device = Some(device);
        }
        let step = self.view.lesson.map(|lesson| (lesson.number(), self.view.step));
        plot_style::views::in_step(context, step);
    }
}
