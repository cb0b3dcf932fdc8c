//! Files of what is in view: a plot as drawing, picture or table, a report, and the question as a program.
//!
//! What a plot shows is taken down while the page is drawn once more where nobody sees it, in the light theme: with the
//! page's own memory, so that plots stay as they were zoomed, or afresh, for plots that are not in view.

use egui::{Context as Egui, RawInput, Rect, vec2};

use super::App;
use super::bench;
use super::panels::design::safety::{Safety, in_words};
use super::panels::{Context, device};
use super::reading::Reading;
use super::session::{Session, Status};
use super::sharing::Errand;
use super::view::design::Page;
use super::view::{Panel, Tab, View};
use super::widgets::number::{exact, round_significant, typographic};
use super::widgets::{qr_modules, recorder};
use super::{draw, fonts, questions, theme};
use crate::app::text::{marked, tr, within};
use crate::dynamics::Outcome;
use crate::export::report::{Report, html};
use crate::export::{Figure, Format, Provenance, svg, table};
use crate::jobs::study::Study as _;
use crate::model::limits::Standing;
use crate::model::{Demand, Dimension};

/// Pixels of a picture for each of its drawing.
const PICTURE_SCALE: u8 = 2;
/// Size of the page on which the plots of a report are drawn, points.
const REPORT_PAGE: [f32; 2] = [1100.0, 980.0];
/// Height over width of a plot in a report.
const REPORT_ASPECT: f64 = 0.42;
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

    /// Saves a report on what is in view.
    pub(super) fn save_report(&mut self) {
        match self.report() {
            Some(report) => {
                let name = "harvester-report.html".to_owned();
                self.errands.push(Errand::Save(name, "text/html;charset=utf-8", html(&report)));
            }
            None => self.tell(tr(BUSY)),
        }
    }

    /// Shows a sentence above the page.
    pub fn tell(&mut self, sentence: &str) {
        self.notice = Some(sentence.to_owned());
    }

    fn report(&self) -> Option<Report> {
        let shown = self.session.shown.as_ref().filter(|_| self.session.status() == Status::Done)?;
        let provenance = self.provenance(&self.view);
        let crew = self.crew.borrow();
        let found = crew.studies.inspection(&shown.scenario).filter(|(_, current)| *current);
        let verdict = found.map(|(found, _)| &found.verdict);
        let reading = Reading::new(shown, self.session.boundaries.as_ref(), verdict);
        let explore = View { tab: Tab::Explore, enlarged: None, ..self.view.clone() };
        let plots = self.figures(&explore, None);
        let mut plots: Vec<Vec<Figure>> = plots.into_iter().map(|figure| vec![figure]).collect();
        for index in 1..plots.len() {
            if plots[index][0].title == plots[index - 1][0].title {
                plots[index][0].title += tr(": the end of the run");
            }
        }
        plots.iter_mut().flatten().for_each(|figure| figure.aspect = REPORT_ASPECT);
        let harvest = crew.studies.bench.harvest.study();
        let question = bench::questions::harvest(&self.view, &self.session);
        if harvest.is_some_and(|study| study.finished() && *study.question() == question) {
            let mut view = View { tab: Tab::Design, enlarged: Some(Panel::Harvest), ..self.view.clone() };
            view.design.page = Page::Harvest;
            let mut figures = self.figures(&view, None);
            figures.iter_mut().for_each(|figure| figure.aspect = REPORT_ASPECT);
            plots.push(figures);
        }
        Some(Report {
            headline: reading.headline,
            facts: reading.facts,
            remarks: reading.remarks,
            limits: self.limits(),
            device: device_rows(&self.view),
            plots,
            code: qr_modules(&provenance.link),
            provenance,
        })
    }

    /// The limits that apply to the motion in view, and whether each is kept.
    fn limits(&self) -> Vec<(String, bool)> {
        let shown = self.session.shown.as_ref();
        let lasting = shown.filter(|shown| shown.run.outcome() == Outcome::Completed);
        let summary = lasting.and_then(|shown| shown.run.summary.as_ref());
        let (Some(summary), Some(safety)) = (summary, Safety::of(&self.view, &self.session)) else {
            return Vec::new();
        };
        let tip = (summary.tip_min, summary.tip_max);
        let demand = Demand { v_peak: summary.v_peak, tip, slope: None };
        let checks = safety.limits.checks(&demand, safety.gap);
        checks.iter().map(|check| (in_words(check), check.standing == Standing::Within)).collect()
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
                    "{} from {} to {}, {} values, {} periods dropped and {} kept at each, {} times as many dropped \
                     where it starts from the scenario's start",
                    sweep.parameter.field(),
                    exact(from),
                    exact(to),
                    sweep.count,
                    sweep.dwell.discarded,
                    sweep.dwell.kept,
                    crate::dynamics::sweep::SETTLING
                ),
            ));
        }
        for (name, part) in self.crew.borrow_mut().studies.progress() {
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
        fonts::install(&hidden);
        let mut size = vec2(REPORT_PAGE[0], REPORT_PAGE[1]);
        let (mut time, mut frames) = (0.0, SETTLING);
        if let Some(page) = page {
            let memory = page.memory(Clone::clone);
            hidden.memory_mut(|own| *own = memory);
            size = page.content_rect().size();
            (time, frames) = (page.input(|input| input.time), 1);
        }
        theme::apply(&hidden, &theme::LIGHT);
        let crew = self.crew.borrow();
        for frame in 0..frames {
            let input = RawInput {
                screen_rect: Some(Rect::from_min_size(egui::Pos2::ZERO, size)),
                time: Some(time + frame as f64),
                ..RawInput::default()
            };
            let output = hidden.run_ui(input, |ui| {
                recorder::start(ui.ctx());
                let mut commands = Vec::new();
                let mut context = Context {
                    view,
                    session: &self.session,
                    studies: &crew.studies,
                    bench: &self.bench,
                    course: &self.course,
                    live: &self.live,
                    address: &self.address,
                    embed: self.embed.as_ref(),
                    steps: (false, false),
                    commands: &mut commands,
                };
                draw(&mut context, self.notice.as_deref(), ui);
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
fn file_name(title: &str) -> String {
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

/// The device of a view for a table: name, symbol, value with unit.
fn device_rows(view: &View) -> Vec<[String; 3]> {
    let Ok(found) = bench::device(&view.scenario) else { return Vec::new() };
    let row = |dimension: &Dimension| {
        let (name, symbol, unit, factor, _) = device::words(*dimension);
        let value = factor * dimension.get(&found);
        let value = if value.is_finite() {
            format!("{} {unit}", typographic(&exact(round_significant(value, 5))))
        } else {
            tr("open circuit").to_owned()
        };
        let whose = match dimension {
            Dimension::MagnetLength | Dimension::MagnetRadius | Dimension::MagnetArea => tr("Magnet "),
            Dimension::BeamLength | Dimension::BeamMass => tr("Beam "),
            Dimension::CeramicThickness => tr("Ceramic "),
            _ => "",
        };
        let name = if whose.is_empty() { name.to_owned() } else { whose.to_owned() + &within(name) };
        [name, symbol.to_owned(), value]
    };
    let mut rows: Vec<[String; 3]> = Dimension::ALL.iter().map(row).collect();
    let magnets = match (view.scenario.parameters.c0 == 0.0, found.repelling) {
        (true, _) => tr("none"),
        (false, true) => tr("repelling"),
        (false, false) => tr("attracting"),
    };
    rows.push([tr("Magnets").to_owned(), String::new(), magnets.to_owned()]);
    rows.push([
        tr("Base acceleration").to_owned(),
        String::new(),
        format!("{} g", typographic(&exact(round_significant(found.acceleration(), 4)))),
    ]);
    rows
}

/// What the tab in view asks the solver, as a request of the native command.
pub(super) fn request(view: &View, session: &Session) -> String {
    let value = view.to_value();
    let part = |name: &str| value["scenario"][name].to_string();
    let subject = format!("\"parameters\":{},\n \"model\":{}", part("parameters"), part("model"));
    let initial = if view.scenario.initial.is_some() {
        format!(",\n \"initial\":{}", part("initial"))
    } else {
        String::new()
    };
    let lasting = format!("{initial},\n \"t_end\":{}", part("t_end"));
    match view.tab {
        Tab::Sweep => {
            let (from, to) = questions::sweep_range(view, session);
            let sweep = &view.sweep;
            format!(
                "{{\"task\":\"sweep\",\n \"parameter\":\"{}\",\"from\":{},\"to\":{},\"count\":{},\n \
                 \"transient\":{},\"kept\":{},\"branches\":true,\n {subject}{initial}}}",
                sweep.parameter.field(),
                exact(from),
                exact(to),
                sweep.count,
                sweep.dwell.discarded,
                sweep.dwell.kept
            )
        }
        Tab::Design => {
            let scaling = part("scaling");
            let scaling =
                if scaling == "null" { String::new() } else { format!(",\n \"scaling\":{scaling}") };
            let device = match view.scenario.device {
                Some(_) => format!(",\n \"device\":{}", part("device")),
                None => String::new(),
            };
            format!("{{\"task\":\"harvest\",\n {subject}{device}{scaling}{lasting}}}")
        }
        _ => format!("{{\"task\":\"verdict\",\n {subject}{lasting}}}"),
    }
}

#[cfg(test)]
mod tests {
    use std::cell::RefCell;
    use std::rc::Rc;

    use super::*;
    use crate::app::command::Command;
    use crate::app::crew::{Crew, Inline};
    use crate::app::history::Hand;
    use crate::jobs::solve;

    /// The page of a link, everything computed, and drawn once.
    fn page(link: &str, size: [f32; 2]) -> (App, Egui) {
        let context = Egui::default();
        let crew = Rc::new(RefCell::new(Crew::new(Box::new(Inline::default()))));
        let mut app = App::new(&context, None, crew);
        app.set_address("https://example.org/lab/".to_owned());
        app.open_link(link);
        for frame in 0..20_000 {
            app.logic(&context);
            let busy = app.session.status() != Status::Done || app.crew.borrow_mut().is_busy();
            if frame > 3 && !busy {
                break;
            }
            app.follow();
        }
        assert_eq!(app.session.status(), Status::Done);
        for _ in 0..3 {
            let screen_rect = Some(Rect::from_min_size(egui::Pos2::ZERO, size.into()));
            let input = RawInput { screen_rect, ..RawInput::default() };
            context.run_ui(input, |ui| app.ui(ui)).drop_without_applying_deltas();
        }
        (app, context)
    }

    /// What is saved of the card.
    fn saved(app: &mut App, context: &Egui, title: &str, format: Format) -> (String, String) {
        app.export(context, title, format);
        match app.take_errands().pop() {
            Some(Errand::Save(name, _, text) | Errand::Picture(name, text, PICTURE_SCALE)) => (name, text),
            other => panic!("{title}: {other:?}, {:?}", app.notice),
        }
    }

    /// Leaves it where a person can look at it.
    fn keep(name: &str, text: &str) {
        let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("target/exports");
        std::fs::create_dir_all(&folder).expect("a folder");
        std::fs::write(folder.join(name), text).expect("a file");
    }

    const FIGURE_9: &str = "v=1&alpha=1e-4&beta=0.01&omega=8.0969&map=first";

    #[test]
    fn every_plot_of_every_tab_is_saved_in_light_colours_and_the_page_stays_as_it_is() {
        let all: [(&str, &[&str]); 6] = [
            (FIGURE_9, &["Stability near 2ω₁", "Phase portrait", "Poincaré map", "Time history"]),
            (
                "v=1&alpha=1e-4&beta=0.01&omega=8.0969&tab=stability&layer=motion&map=first",
                &["Stability chart", "Floquet multipliers", "Spectrum", "Basins of attraction"],
            ),
            (
                "v=1&alpha=1e-4&beta=0.005&omega=8.0969&tab=sweep&map=first&sweep.count=30",
                &["Orbit diagram", "Response curves"],
            ),
            ("v=1&alpha=1e-4&beta=0.01&omega=8.0969&tab=design", &["Over frequency"]),
            ("v=1&tab=paper&figure=9", &["(a)  Initial history", "(c)  Phase diagram", "(d)  Poincaré map"]),
            ("v=1&tab=paper&figure=7", &["Stability boundaries"]),
        ];
        for (number, (link, titles)) in all.into_iter().enumerate() {
            let (mut app, context) = page(link, [1440.0, 900.0]);
            let view = app.view.clone();
            for title in titles {
                let (name, text) = saved(&mut app, &context, title, Format::Svg);
                keep(&format!("{number}-{name}"), &text);
                let drawing = roxmltree::Document::parse(&text).expect("well-formed");
                assert!(drawing.descendants().any(|node| node.text() == Some(title)), "{title}");
                assert!(
                    text.contains(&format!("#{:02x}{:02x}{:02x}", 20, 26, 32))
                        && text.contains("fill=\"#fff\"")
                );
                let (name, table) = saved(&mut app, &context, title, Format::Csv);
                keep(&format!("{number}-{name}"), &table);
                assert!(table.starts_with(&format!("# plot: {title}\n# program: Harvester Lab ")), "{table}");
                assert_eq!(table.contains("# sweep: omega from "), view.tab == Tab::Sweep);
                assert!(table.lines().filter(|line| !line.starts_with('#')).count() > 5, "{title}");
                let (picture, again) = saved(&mut app, &context, title, Format::Png);
                assert!(picture.ends_with(".png") && again == text, "{picture}");
            }
            assert_eq!((app.view.clone(), app.notice.clone()), (view, None));
        }
    }

    #[test]
    fn a_report_holds_the_numbers_of_the_scenario() {
        let (mut app, _) = page(FIGURE_9, [1440.0, 900.0]);
        app.step(Command::Report, Hand::default());
        let errands = app.take_errands();
        let [Errand::Save(name, kind, text)] = errands.as_slice() else { panic!("{errands:?}") };
        keep(name, text);
        assert_eq!((name.as_str(), *kind), ("harvester-report.html", "text/html;charset=utf-8"));
        let options = roxmltree::ParsingOptions { allow_dtd: true, ..Default::default() };
        let page = roxmltree::Document::parse_with_options(text, options).expect("well-formed");
        let count = |tag: &str| page.descendants().filter(|node| node.has_tag_name(tag)).count();
        let svg = "http://www.w3.org/2000/svg";
        let drawings = page.descendants().filter(|node| node.has_tag_name((svg, "svg"))).count();
        assert_eq!(drawings, 6, "four plots, a close view and a code");
        assert_eq!(count("script"), 0);
        for part in ["Period 2", "1e−4", "8.0969", "480 mm", "v=1&amp;alpha=1e-4", "of the gap"] {
            assert!(text.contains(part), "{part}");
        }
    }

    #[test]
    fn what_is_not_there_is_not_saved_and_said() {
        let (mut app, context) = page("v=1", [900.0, 700.0]);
        for title in ["Orbit diagram", "", "no such card"] {
            app.export(&context, title, Format::Svg);
            assert_eq!(app.take_errands(), []);
            assert_eq!(app.notice.take().as_deref(), Some(BUSY));
        }
    }

    #[test]
    fn files_have_plain_names() {
        assert_eq!(file_name("Poincaré map"), "harvester-poincare-map");
        assert_eq!(file_name("Stability near ω₁+ω₂"), "harvester-stability-near-omega1-omega2");
        assert_eq!(file_name("(c)  Phase diagram"), "harvester-c-phase-diagram");
    }

    #[test]
    fn the_solver_answers_what_the_programs_ask() {
        for link in [
            "v=1&alpha=1e-4&beta=0.01&omega=8.0969&force=taylor5&t_end=300&initial=0+0.1+0+0+0",
            "v=1&tab=sweep&sweep.count=3&sweep.dwell.discarded=10&sweep.dwell.kept=4&omega=8",
            "v=1&tab=design&omega=8.0969&resistance=1e6&scaling=consistent",
        ] {
            let view = crate::app::link::read(link, &View::default()).0;
            let request = request(&view, &Session::default());
            let answer = solve(&request);
            assert!(answer.is_ok(), "{request}: {answer:?}");
        }
    }
}
