//! The egui front end: draws what the core computed, on any egui integration.
//!
//! A frame goes: [`App::ui`] lets the session compute for a few milliseconds, the panels draw from shared
//! references and push commands, and the commands are carried out at the end, in one place.

#[cfg(target_arch = "wasm32")]
pub mod bridge;
pub mod fonts;
pub mod lessons;
pub mod link;
mod live;
pub mod text;
pub mod theme;
pub mod view;
pub mod widgets;

mod bench;
mod caption;
mod clock;
mod colours;
mod command;
mod comparison;
pub mod crew;
mod curves;
pub mod embed;
mod exporting;
mod figures;
mod history;
mod keyboard;
mod layout;
mod map;
pub mod mirror;
mod panels;
mod questions;
mod reading;
#[cfg(test)]
mod rehearsal;
mod report;
mod session;
pub mod sharing;
pub mod speaking;
mod steps;

use std::cell::RefCell;
use std::rc::Rc;

use egui::Ui;

use bench::Bench;
use command::{Command, Commands};
use crew::Crew;
use embed::Embed;
use lessons::Course;
use live::Live;
use panels::Context;
use session::{Session, Status};
use sharing::Errand;
use view::{MapWindow, Tab, View};

use crate::export::Format;

/// The application.
pub struct App {
    view: View,
    session: Session,
    crew: Rc<RefCell<Crew>>,
    bench: Bench,
    course: Course,
    live: Live,
    notice: Option<String>,
    history: history::History<steps::Moment>,
    /// What the address asks to be shown of the page; all of it when absent.
    embed: Option<Embed>,
    /// The page's own address, without a fragment; empty outside a browser.
    address: String,
    /// What the browser is to do.
    errands: Vec<Errand>,
    /// Cards to be saved at the end of this frame.
    exports: Vec<(String, Format)>,
    /// What egui was last told about theme and type size.
    speech: speaking::Speech,
    styled: Option<(bool, bool, bool)>,
    /// Whether the system asks for high contrast.
    system_contrast: bool,
}

impl App {
    /// A new application with its `crew`, continuing what an earlier session `stored` when that is valid.
    pub fn new(context: &egui::Context, stored: Option<&str>, crew: Rc<RefCell<Crew>>) -> Self {
        fonts::install(context, None);
        let (view, notice) = View::restore(stored);
        let mut session = Session::default();
        session.ask(&view.scenario);
        let (bench, course) = (Bench::default(), Course::restore(stored));
        let (history, live) = (history::History::default(), Live::default());
        let (address, errands, exports) = (String::new(), Vec::new(), Vec::new());
        let mut app = Self {
            view,
            session,
            crew,
            bench,
            course,
            live,
            notice,
            history,
            embed: None,
            address,
            errands,
            exports,
            styled: None,
            speech: speaking::Speech::default(),
            system_contrast: false,
        };
        app.style(context);
        app
    }

    /// Work that goes on while the page is hidden.
    pub fn logic(&mut self, context: &egui::Context) {
        // Where time goes on, the frame is its own while the hand moves.
        if self.view.tab != Tab::Live || !context.input(|input| input.pointer.any_down()) {
            self.session.work();
        }
        self.study(context);
        self.check_goal(context);
        if self.bench.measured.work() {
            context.request_repaint();
        }
        if self.view.tab == Tab::Paper {
            let figure = figures::figure(self.view.figure);
            if self.session.compare(figure, &self.view.scenario) {
                context.request_repaint();
            }
        }
        if matches!(self.session.status(), Status::Computing(_)) {
            context.request_repaint();
        }
    }

    /// Asks the crew for what the page shows beside the run, and lets it go on.
    fn study(&mut self, context: &egui::Context) {
        let mut crew = self.crew.borrow_mut();
        crew.studies.follow(&self.view, &self.session, self.embed.as_ref());
        crew.tick(context.input(|input| input.pointer.any_down()));
        if crew.works_on_this_thread() && crew.is_busy() {
            context.request_repaint();
        }
    }

    /// Looks whether the user has done what the running lesson asks for.
    fn check_goal(&mut self, context: &egui::Context) {
        let crew = self.crew.borrow();
        let found = crew.studies.inspection(&self.view.scenario).filter(|(_, current)| *current);
        let verdict = found.map(|(found, _)| &found.verdict);
        if self.course.look(&self.view, &self.session, verdict) {
            context.request_repaint();
        }
    }

    /// Gives the crew what the view asks for now, without waiting for the next frame.
    fn follow(&mut self) {
        let mut crew = self.crew.borrow_mut();
        crew.studies.follow(&self.view, &self.session, self.embed.as_ref());
        crew.hand_out();
    }

    /// Shows only what the part of an address from `?` on asks for, if it does.
    pub fn embed(&mut self, search: &str) {
        self.embed = Embed::read(search);
    }

    /// Whether it does.
    pub fn is_embedded(&self) -> bool {
        self.embed.is_some()
    }

    /// Whether the page keeps an event for itself. Otherwise the browser scrolls what is around the page.
    pub fn keeps(&self, context: &egui::Context, event: &egui::Event) -> bool {
        self.embed
            .as_ref()
            .is_none_or(|embed| embed.keeps(event, &|place| widgets::touch::is_grip(context, place)))
    }

    /// Leaves those events out that belong to the browser.
    pub fn sift(&self, context: &egui::Context, events: &mut Vec<egui::Event>) {
        events.retain(|event| !matches!(event, egui::Event::MouseWheel { .. }) || self.keeps(context, event));
        widgets::touch::end_cancelled(events, context.input(|input| input.pointer.latest_pos()));
    }

    /// Draws one frame.
    pub fn ui(&mut self, ui: &mut Ui) {
        self.style(ui.ctx());
        self.find_words();
        widgets::touch::begin_frame(ui.ctx());
        let mut commands = Commands::new();
        let hand = steps::hand(ui.ctx());
        self.history.begin_frame(hand);
        self.go_on(ui.ctx());
        let (pinned, dark) = (self.session.pinned.is_some(), theme::tokens(ui).dark);
        keyboard::shortcuts(ui.ctx(), &self.view, pinned, dark, &mut commands);
        if self.embed.is_some() {
            // What the whole page would show or save is not there.
            commands
                .retain(|command| matches!(command, Command::Undo | Command::Redo | Command::Enlarge(None)));
        }
        let crew = self.crew.borrow();
        let mut context = Context {
            view: &self.view,
            session: &self.session,
            studies: &crew.studies,
            bench: &self.bench,
            course: &self.course,
            live: &self.live,
            address: &self.address,
            embed: self.embed.as_ref(),
            steps: self.history.can(),
            commands: &mut commands,
        };
        layout::draw(&mut context, self.notice.as_deref(), ui);
        panels::shortcuts::show(ui);
        drop(crew);
        if commands.is_empty() {
            return;
        }
        for command in commands {
            self.step(command, hand);
        }
        for (title, format) in std::mem::take(&mut self.exports) {
            self.export(ui.ctx(), &title, format);
        }
        self.follow();
        ui.ctx().request_repaint();
    }

    /// Lets the live run go on and be heard.
    fn go_on(&mut self, context: &egui::Context) {
        if self.live.frame(context.input(|input| input.time), &self.view) {
            context.request_repaint();
        }
        self.errands.extend(self.live.chunk().map(Errand::Sound));
    }

    fn carry_out(&mut self, command: Command) {
        match command {
            Command::Show(scenario) => self.show(*scenario),
            Command::OpenTab(tab) => {
                self.view.tab = tab;
                self.view.enlarged = None;
            }
            Command::LookAt(window) => self.look_at(window),
            Command::Chart(layer) => self.view.layer = layer,
            Command::Sweep(sweep) => self.view.sweep = sweep,
            Command::OpenPlane(plane) => self.view.plane = plane,
            Command::Design(design) => self.view.design = *design,
            Command::LookLive(live) => self.view.live = live,
            Command::Live(action) => {
                self.live.act(action, &self.view, &self.session);
                if !self.live.sounds() {
                    self.errands.push(Errand::Sound(Vec::new()));
                }
            }
            Command::Adopt(Ok(scenario)) => self.show(*scenario),
            Command::Adopt(Err(reason)) => self.bench.refusal = Some(reason),
            Command::Lesson(action) => self.follow_lesson(action),
            Command::Find(begin) => {
                let question = begin.then(|| bench::questions::find(&self.view, &self.session));
                let begun = self.crew.borrow_mut().studies.bench.search(question, &self.view);
                self.bench.refusal = begun.err();
            }
            Command::Measure(Some(reading)) => self.bench.measured.read(reading),
            Command::Measure(None) => self.bench.measured = bench::measured::Measured::default(),
            Command::LoadFigure(number) => self.load_figure(number),
            Command::Enlarge(panel) => self.view.enlarged = panel,
            Command::Pin(keep) => {
                self.session.pin(keep);
                let crew = self.crew.borrow();
                self.bench.pinned = keep.then(|| crew.studies.bench.pinned(&self.view.scenario));
            }
            Command::SetDark(dark) => self.view.dark = Some(dark),
            Command::Speak(language) => self.view.language = Some(language),
            Command::SetContrast(contrast) => self.view.contrast = Some(contrast),
            Command::FollowSystem => (self.view.dark, self.view.contrast) = (None, None),
            Command::SetProjector(large) => self.view.projector = large,
            Command::MoveBeam(moves) => self.view.beam_moves = moves,
            Command::DismissNotice => self.notice = None,
            Command::Undo => self.undo(),
            Command::Redo => self.redo(),
            Command::SaveFile => self.save_file(),
            Command::Export(title, format) => self.exports.push((title, format)),
            Command::Report => self.save_report(),
            Command::OpenFile => self.errands.push(Errand::Open),
        }
    }

    fn show(&mut self, scenario: crate::scenario::Scenario) {
        self.bench.refusal = None;
        if self.view.scenario.model != scenario.model {
            self.bench.before = self.view.scenario.model;
        }
        self.session.ask(&scenario);
        if let Some(boundaries) = &self.session.boundaries {
            self.view.map = boundaries.follow(self.view.map, scenario.parameters.omega);
        }
        self.view.scenario = scenario;
    }

    /// Opens a window of the map; a point outside of it comes along.
    fn look_at(&mut self, window: MapWindow) {
        self.view.map = window;
        let Some(boundaries) = &self.session.boundaries else { return };
        let (low, high) = boundaries.range(window);
        let omega = self.view.scenario.parameters.omega;
        if let Some(tongue) = window.resonance().and_then(|resonance| boundaries.tongue(resonance))
            && !(low..=high).contains(&omega)
        {
            let mut scenario = self.view.scenario.clone();
            scenario.parameters.omega = tongue.published_frequency;
            self.show(scenario);
        }
    }

    fn load_figure(&mut self, number: u8) {
        self.view.figure = number;
        let Some(figure) = figures::figure(number) else { return };
        if let Some(scenario) = figure.scenario() {
            self.view.map = figure.resonance().map_or(self.view.map, MapWindow::about);
            self.show(scenario);
        }
    }

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
    fn style(&mut self, context: &egui::Context) {
        let (dark, contrast) = self.look(context);
        let wanted = (dark, contrast, self.view.projector);
        if self.styled == Some(wanted) {
            return;
        }
        theme::apply(context, theme::Tokens::of(dark, contrast));
        context.set_zoom_factor(if wanted.2 { theme::PROJECTOR_ZOOM } else { 1.0 });
        self.styled = Some(wanted);
    }

    /// Scenario, view and newest results as JSON; the format is described in the README.
    pub fn state_json(&self) -> String {
        report::state(&self.view, &self.session, &mut self.crew.borrow_mut().studies)
    }

    /// Replaces scenario and view by what `json` holds: a view as stored, or a scenario alone.
    ///
    /// # Errors
    /// One line that says what is wrong; nothing changes then.
    pub fn load_json(&mut self, json: &str) -> Result<(), String> {
        let view = View::read(json, &self.view)?;
        self.replace(view, true);
        Ok(())
    }

    /// What a later session needs to continue here.
    pub fn stored(&self) -> String {
        let mut value = self.view.to_value();
        self.course.store(&mut value);
        value.to_string()
    }
}
