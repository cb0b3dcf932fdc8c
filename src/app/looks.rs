//! What suits the room and the eyes: the theme and the size of type.

use super::{App, theme};

impl App {
    /// Says whether the system asks for high contrast.
    pub fn set_system_contrast(&mut self, contrast: bool) {
        self.system_contrast = contrast;
    }

    /// Whether the theme is dark, and whether it has high contrast.
    pub fn look(&self, context: &egui::Context) -> (bool, bool) {
        let system = context.system_theme().unwrap_or(egui::Theme::Dark) == egui::Theme::Dark;
        (self.view.dark.unwrap_or(system), self.view.contrast.unwrap_or(self.system_contrast))
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
}
