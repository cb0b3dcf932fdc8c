//! Files of what is in view: a plot as drawing, picture or table, a report, and the question as a program.
//!
//! What a plot shows is taken down while the page is drawn once more where nobody sees it, in the light theme: with the
//! page's own memory, so that plots stay as they were zoomed, or afresh, for plots that are not in view.
//!
//! `App::figures` does so, and `widgets::recorder` collects what the helpers of `plot_style`,
//! `raster`, `legend` and `swatch` draw. A panel that draws by these is exported without code of its own; only the
//! values behind a coloured chart are told apart (`recorder::cells`). Drawing, picture and table are made from the
//! same `export::Figure`. The browser makes pictures from drawings (`assets/shell/picture.js`).

mod question;
mod report;

use egui::{Context as Egui, RawInput, Rect, vec2};

pub(super) use question::request;

use super::App;
use super::errand::Errand;
use super::session::Status;
use super::view::{Tab, View};
use super::widgets::number::exact;
use super::widgets::recorder;
use super::{fonts, questions, theme};
use crate::app::text::{marked, tr};
use crate::export::{Figure, Format, Provenance, svg, table};

/// Pixels of a picture for each of its drawing.
const PICTURE_SCALE: u8 = 2;
/// Size of the page on which the plots of a report are drawn, points.
const REPORT_PAGE: [f32; 2] = [1100.0, 980.0];
/// Frames until the plots of a page that was not drawn before have found their bounds.
const SETTLING: usize = 3;
/// Letters from here on stay in the names of files: they have no spelling in Latin ones.
const FIRST_IDEOGRAPH: char = '\u{4e00}';
/// What is said when there is nothing to save.
const BUSY: &str =
    marked("There is nothing to save yet: it is still being computed, or this view has no plot here.");

impl App {
    /// Saves the plots of the card with this title.
    pub(super) fn export(&mut self, context: &Egui, title: &str, format: Format) {
        if self.session.status() != Status::Done {
            return self.tell(tr(BUSY));
        }
        let provenance = self.provenance(&self.view);
        let mut figures = self.figures(&self.view, Some(context));
        figures.retain(|figure| figure.title == title);
        if figures.is_empty() {
            return self.tell(tr(BUSY));
        }
        let name = file_name(title);
        let errand = match format {
            Format::Csv => {
                Errand::Save(name + ".csv", "text/csv;charset=utf-8", table::table(&figures, &provenance))
            }
            Format::Svg => Errand::Save(name + ".svg", "image/svg+xml", drawing(&figures, &provenance)),
            Format::Png => Errand::Picture(name + ".png", drawing(&figures, &provenance), PICTURE_SCALE),
        };
        self.errands.push(errand);
    }

    /// Shows a sentence above the page.
    pub fn tell(&mut self, sentence: &str) {
        self.notice = Some(sentence.to_owned());
    }

    /// What the plots of `view` are computed from.
    fn provenance(&self, view: &View) -> Provenance {
        let shown = self.session.shown.as_ref().filter(|shown| shown.scenario == view.scenario);
        let mut notes = Vec::new();
        if view.tab == Tab::Sweep {
            let (from, to) = questions::sweep_range(view, &self.session);
            let sweep = &view.sweep;
            notes.push((
                "sweep",
                format!(
                    "{} from {} to {}, {} values, at least {} periods dropped and {} kept at each",
                    sweep.parameter.field(),
                    exact(from),
                    exact(to),
                    sweep.count,
                    sweep.dwell.discarded,
                    sweep.dwell.kept
                ),
            ));
        }
        for (name, part) in self.crew.borrow().studies.lanes.progress() {
            notes.push(("still being computed", format!("{name}, {:.0} % done", 100.0 * part)));
        }
        Provenance {
            scenario: view.scenario.clone(),
            steps: shown.map(|shown| shown.run.trajectory.len()),
            notes,
            link: format!("{}#{}", self.address, self.fragment()),
        }
    }

    /// The plots that the page shows of `view`: as they are in `page`, or as they are at first.
    fn figures(&self, view: &View, page: Option<&Egui>) -> Vec<Figure> {
        let hidden = Egui::default();
        fonts::install(&hidden, self.speech.ideographs.as_ref());
        let mut size = vec2(REPORT_PAGE[0], REPORT_PAGE[1]);
        let (mut time, mut frames) = (0.0, SETTLING);
        if let Some(page) = page {
            let memory = page.memory(Clone::clone);
            hidden.memory_mut(|own| *own = memory);
            size = page.content_rect().size();
            (time, frames) = (page.input(|input| input.time), 1);
        }
        theme::apply(&hidden, &theme::LIGHT);
        for frame in 0..frames {
            let input = RawInput {
                screen_rect: Some(Rect::from_min_size(egui::Pos2::ZERO, size)),
                time: Some(time + frame as f64),
                ..RawInput::default()
            };
            let output = hidden.run_ui(input, |ui| {
                recorder::start(ui.ctx());
                self.draw(view, &mut Vec::new(), ui);
            });
            output.drop_without_applying_deltas();
        }
        recorder::finish(&hidden)
    }
}

fn drawing(figures: &[Figure], provenance: &Provenance) -> String {
    svg::drawing(figures, &[provenance.caption()]).0
}

/// The name of a card as that of a file.
pub(super) fn file_name(title: &str) -> String {
    let mut name = "harvester".to_owned();
    for word in
        title.to_lowercase().split(|letter: char| !letter.is_alphanumeric() && letter != '₁' && letter != '₂')
    {
        let plain: String = word
            .chars()
            .map(|letter| match letter {
                'é' => "e".to_owned(),
                'ä' => "ae".to_owned(),
                'ö' => "oe".to_owned(),
                'ü' => "ue".to_owned(),
                'ß' => "ss".to_owned(),
                'ω' => "omega".to_owned(),
                '₁' => "1".to_owned(),
                '₂' => "2".to_owned(),
                other if other.is_ascii_alphanumeric() || other >= FIRST_IDEOGRAPH => other.to_string(),
                _ => String::new(),
            })
            .collect();
        if !plain.is_empty() {
            name.push('-');
            name.push_str(&plain);
        }
    }
    name
}

#[cfg(test)]
mod tests;
