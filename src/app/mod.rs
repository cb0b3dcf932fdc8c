//! The egui front end. A stand-in until the panels exist: one slider, one curve.

#[cfg(target_arch = "wasm32")]
pub mod bridge;
pub mod fonts;
pub mod theme;
pub mod widgets;

use serde::{Deserialize, Serialize};

/// What the stand-in remembers.
#[derive(Clone, Copy, Serialize, Deserialize)]
struct State {
    frequency: f64,
}

/// The application: drawn by any egui integration.
pub struct App {
    state: State,
}

impl App {
    /// A new application, continuing what an earlier session stored when that is readable.
    pub fn new(_ctx: &egui::Context, stored: Option<&str>) -> Self {
        let state = stored.and_then(|text| serde_json::from_str(text).ok());
        Self { state: state.unwrap_or(State { frequency: 3.0 }) }
    }

    /// Work that goes on while the page is hidden.
    pub fn logic(&mut self, _ctx: &egui::Context) {}

    /// Draws one frame.
    pub fn ui(&mut self, ui: &mut egui::Ui) {
        egui::CentralPanel::default().show(ui, |ui| {
            ui.heading("Harvester Lab");
            ui.spacing_mut().slider_width = 400.0;
            ui.add(egui::Slider::new(&mut self.state.frequency, 1.0..=10.0).text("Frequency"));
            let omega = self.state.frequency;
            let wave =
                egui_plot::PlotPoints::from_explicit_callback(move |x| (omega * x).sin(), 0.0..10.0, 800);
            egui_plot::Plot::new("wave").show(ui, |plot| plot.line(egui_plot::Line::new("wave", wave)));
        });
    }

    /// The scenario and its results.
    pub fn state_json(&self) -> String {
        self.stored()
    }

    /// Replaces the scenario.
    ///
    /// # Errors
    /// When the text is not a scenario; nothing changes then.
    pub fn load_json(&mut self, json: &str) -> Result<(), String> {
        self.state = serde_json::from_str(json).map_err(|error| error.to_string())?;
        Ok(())
    }

    /// What a later session needs to continue here.
    pub fn stored(&self) -> String {
        serde_json::to_string(&self.state).unwrap_or_default()
    }
}
