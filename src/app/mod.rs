//! The egui front end: draws what the core computed, on any egui integration.
//!
//! A frame goes: [`App::ui`] lets the session compute for a few milliseconds, the panels draw from shared
//! references and push commands, and the commands are carried out at the end, in one place.
//!
//! # How a frame goes
//!
//! 1. `App::logic` lets `Session::work` compute for at most 7 ms. A run is a `RunJob` that advances in slices of 400
//!    steps; in the default model it is finished within one frame. Questions are numbered, an answer shows which one
//!    it answers, and a plot that answers an older question is drawn faintly.
//! 2. `App::ui` draws. `Curves`, sampled once when a run ends, are borrowed by the plots, not copied.
//! 3. Commands are carried out: a change of the scenario asks the session a new question.
//!
//! A slow run is not restarted at every move of the hand: it may finish within 250 ms, then the newest question is
//! taken up.
//!
//! Panels get a `Context` of references, made by `App::draw` only, and push commands; `App::carry_out` is the one
//! place that changes anything. So a test draws every panel without a window.

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
#[cfg(all(feature = "window", not(target_arch = "wasm32")))]
pub mod window;

mod asking;
mod bench;
mod caption;
mod carrying_out;
mod clock;
mod colours;
mod command;
mod comparison;
pub mod crew;
mod curves;
pub mod embed;
pub mod errand;
mod exporting;
mod figures;
mod following;
mod history;
mod keyboard;
mod layout;
mod looks;
mod map;
pub mod mirror;
mod moment;
mod panels;
mod questions;
mod reading;
#[cfg(test)]
mod rehearsal;
mod report;
mod session;
pub mod sharing;
pub mod speaking;
mod speech;
mod steps;

use std::cell::RefCell;
use std::rc::Rc;

use egui::Ui;

use bench::Bench;
use command::{Command, Commands};
use crew::Crew;
use embed::Embed;
use errand::Errand;
use history::{Hand, History};
use lessons::Course;
use live::Live;
use moment::Moment;
use panels::Context;
use session::{Session, Status};
use speech::Speech;
use view::shake::ShakenBy;
use view::{Tab, View};

use crate::export::Format;
use crate::scenario::Scenario;

/// The application.
pub struct App {
    view: View,
    session: Session,
    crew: Rc<RefCell<Crew>>,
    bench: Bench,
    course: Course,
    live: Live,
    notice: Option<String>,
    history: History<Moment>,
    /// What the address asks to be shown of the page; all of it when absent.
    embed: Option<Embed>,
    /// The page's own address, without a fragment; empty outside a browser.
    address: String,
    /// What the browser is to do.
    errands: Vec<Errand>,
    /// Cards to be saved at the end of this frame.
    exports: Vec<(String, Format)>,
    speech: Speech,
    /// Whether a clip is being recorded.
    records: bool,
    /// What egui was last told about theme and type size.
    styled: Option<(bool, bool, bool)>,
    wishes: looks::Wishes,
    /// The device that plots showed last.
    device: Option<Scenario>,
}

impl App {
    /// A new application with its `crew`, continuing what an earlier session `stored` when that is valid.
    pub fn new(context: &egui::Context, stored: Option<&str>, crew: Rc<RefCell<Crew>>) -> Self {
        fonts::install(context, None);
        // A tap is one however long a slow picture takes.
        context.options_mut(|options| options.input_options.max_click_duration = f64::INFINITY);
        let (view, notice) = View::restore(stored);
        let mut session = Session::default();
        session.ask(&view.scenario);
        let (bench, course) = (
            Bench { variants: bench::variant::restore(stored), ..Bench::default() },
            Course::restore(stored),
        );
        let (history, live) = (History::default(), Live::default());
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
            speech: Speech::default(),
            records: false,
            wishes: looks::Wishes::default(),
            device: None,
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
        if self.bench.vibration.work() {
            self.shake_by_recording();
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

    /// Has the view name the recording that was just read.
    fn shake_by_recording(&mut self) {
        let file = self.bench.vibration.file.as_ref();
        let Some(recorded) = file.and_then(|file| file.recorded.as_ref()) else { return };
        let shake = &mut self.view.design.shake;
        (shake.by, shake.recording) = (ShakenBy::Recorded, Some(recorded.recording.clone()));
    }

    /// Asks the crew for what the page shows beside the run, and lets it go on.
    fn study(&mut self, context: &egui::Context) {
        let mut crew = self.crew.borrow_mut();
        asking::ask(&mut crew.studies, &self.view, &self.session, &self.bench, self.embed.as_ref());
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
        asking::ask(&mut crew.studies, &self.view, &self.session, &self.bench, self.embed.as_ref());
        crew.hand_out();
    }

    /// Shows only what the part of an address from `?` on asks for, if it does.
    pub fn embed(&mut self, search: &str) {
        self.embed = Embed::read(search, &panels::parts::parts());
    }

    /// Whether the page shows only the parts that its address asks for.
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
        widgets::touch::part_taps(context, events);
        widgets::touch::end_cancelled(events, context.input(|input| input.pointer.latest_pos()));
    }

    /// Draws one frame.
    pub fn ui(&mut self, ui: &mut Ui) {
        self.style(ui.ctx());
        self.find_words();
        self.begin_views(ui.ctx());
        widgets::touch::begin_frame(ui.ctx());
        let mut commands = Commands::new();
        let hand = Hand::of(ui.ctx());
        self.history.begin_frame(hand);
        self.go_on(ui.ctx());
        let (pinned, dark) = (self.session.pinned.is_some(), theme::tokens(ui).dark);
        keyboard::shortcuts(ui.ctx(), &self.view, pinned, (dark, self.moves()), &mut commands);
        if self.embed.is_some() {
            // What the whole page would show or save is not there.
            commands
                .retain(|command| matches!(command, Command::Undo | Command::Redo | Command::Enlarge(None)));
        }
        self.draw(&self.view, &mut commands, ui);
        panels::shortcuts::show(ui);
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

    /// Draws the page as it shows `view`, which exports draw once more where nobody sees it.
    fn draw(&self, view: &View, commands: &mut Commands, ui: &mut Ui) {
        let crew = self.crew.borrow();
        let mut context = Context {
            view,
            session: &self.session,
            studies: &crew.studies,
            bench: &self.bench,
            course: &self.course,
            live: &self.live,
            address: &self.address,
            embed: self.embed.as_ref(),
            steps: self.history.can(),
            records: self.records,
            moves: self.moves(),
            on_top: None,
            commands,
        };
        layout::draw(&mut context, self.notice.as_deref(), ui);
    }

    /// Lets the live run go on and be heard.
    fn go_on(&mut self, context: &egui::Context) {
        let live = |panel: &view::Panel| panels::list::spec(*panel).place.tab() == Tab::Live;
        let in_sight = match &self.embed {
            Some(embed) => {
                embed.parts.contains(&embed::Part::Live)
                    || view::Panel::ALL.iter().any(|panel| live(panel) && embed.shows(*panel))
            }
            None => self.view.tab == Tab::Live,
        };
        let mut goes_on = in_sight;
        if in_sight {
            let motion = bench::shaking::live(&self.view, &self.bench);
            // Without its recording nothing shakes the base.
            goes_on = motion.is_some() || self.view.shaken().is_none();
            self.live.shake(motion, &self.view.scenario);
        }
        if self.live.frame(context.input(|input| input.time), (&self.view, self.moves()), goes_on) {
            context.request_repaint();
        }
        self.errands.extend(self.live.chunk().map(Errand::Sound));
    }

    /// Scenario, view and newest results as JSON; the format is described in the README.
    pub fn state_json(&self) -> String {
        report::state(&self.view, &self.session, &self.crew.borrow().studies)
    }

    /// Replaces scenario and view by what `json` holds: a view as stored, or a scenario alone.
    ///
    /// # Errors
    /// One line that says what is wrong; nothing changes then.
    pub fn load_json(&mut self, json: &str) -> Result<(), String> {
        let view = View::read(json, &self.view).map_err(|why| why.to_string())?;
        self.replace(view, true);
        Ok(())
    }

    /// What a later session needs to continue here.
    pub fn stored(&self) -> String {
        let mut value = self.view.to_value();
        self.course.store(&mut value);
        bench::variant::store(&self.bench.variants, &mut value);
        value.to_string()
    }
}
