//! stub
use super::Context;
/// stub
pub(in crate::app) fn show(context: &mut Context<'_>, ui: &mut egui::Ui) {
    let _ = (context, ui);
}
