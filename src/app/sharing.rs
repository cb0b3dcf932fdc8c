//! Links and scenario files: what goes out of the page, and what comes in.

use serde::{Deserialize, Serialize};
use serde_json::Value;

use super::App;
use super::bench::recorded::BaseRecording;
use super::bench::shaking::recorded;
use super::command::Command;
use super::errand::Errand;
use super::history::Hand;
use super::lessons::check::checked;
use super::lessons::{LessonId, course};
use super::link;
use super::panels::spec::Place;
use super::view::design::Page;
use super::view::shake::ShakenBy;
use super::view::{Tab, View};
use crate::app::text::fill;
use crate::questions::design::measured;
use crate::questions::input::{self, FieldError, NoText};
use crate::scenario::Scenario;
use crate::sentence::{Sentence, said};

/// Name of saved files.
const FILE_NAME: &str = "harvester-scenario.json";
/// A file larger than this is no scenario; a recording of half a million samples fits.
const LARGEST_FILE: usize = 40_000_000;
/// Where a scenario's file has the recording that shakes its base.
const RECORDING: &str = "recording";
/// What belongs to the room and the eyes, and not into a file.
const LOOKS: [&str; 5] = ["lang", "dark", "contrast", "projector", "beam_moves"];

/// Bytes at the beginning of a file that [`look`] needs.
pub const FIRST: usize = measured::FIRST;

/// Looks whether a file of this name, with these `first` bytes of `size`, can be opened at all, before the rest is read.
///
/// # Errors
/// One sentence that says why the file cannot be used.
pub fn look(name: &str, first: &[u8], size: usize) -> Result<(), Sentence> {
    if !is_scenario(name, first) {
        return measured::look(first, size).map_err(Sentence::from);
    }
    if size > LARGEST_FILE { Err(said("it is too large for a scenario", &[])) } else { Ok(()) }
}

/// Whether a file of this name and contents is meant as a scenario; it holds measured data otherwise.
fn is_scenario(name: &str, contents: &[u8]) -> bool {
    let first = contents.trim_ascii_start().first();
    name.to_ascii_lowercase().ends_with(".json") || matches!(first, Some(b'{'))
}

/// A recording in a scenario's file.
#[derive(Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct RecordingFile {
    name: String,
    /// Times (s) and accelerations (g).
    time: Vec<f64>,
    acceleration: Vec<f64>,
}

/// The text of a scenario without the recording in it, and that.
fn recording_apart(text: String) -> Result<(String, Option<RecordingFile>), FieldError> {
    let value = serde_json::from_str::<Value>(&text).ok();
    let Some(Value::Object(mut entries)) = value.filter(|value| value.get(RECORDING).is_some()) else {
        return Ok((text, None));
    };
    let recording = entries.remove(RECORDING).map(|value| input::fields(&value)).transpose()?;
    Ok((Value::Object(entries).to_string(), recording))
}

/// The text of a file that may hold a scenario.
fn text_of(bytes: Vec<u8>) -> Result<String, Sentence> {
    let text = input::text(&bytes).map_err(|problem| match problem {
        NoText::Utf16 => said("it is UTF-16 text: save it as UTF-8", &[]),
        NoText::Other => said("it is not a text", &[]),
    })?;
    if !text.trim_start().starts_with('{') {
        return Err(said("it is not a scenario, which begins with {", &[]));
    }
    Ok(text.to_owned())
}

impl App {
    /// Tells the address of the page, to which links lead.
    pub fn set_address(&mut self, address: String) {
        self.address = address;
    }

    /// What the browser is to do now.
    pub fn take_errands(&mut self) -> Vec<Errand> {
        std::mem::take(&mut self.errands)
    }

    /// The view in a link, without the `#`. Its looks are left out: they suit this room.
    pub fn fragment(&self) -> String {
        link::write(&self.view.clone().with_looks_of(&View::default()))
    }

    /// The place in the page, for the browser's buttons back and forward: tab, figure, lesson and step.
    pub fn whereabouts(&self) -> String {
        let View { tab, figure, lesson, step, .. } = self.view;
        link::write(&View { scenario: Scenario::default(), tab, figure, lesson, step, ..View::default() })
    }

    /// Goes to such a place; a figure or a step of a lesson sets the page as it does.
    pub fn return_to(&mut self, place: &str) {
        let (view, _) = link::read(place, &self.view);
        self.history.begin_frame(Hand::default());
        let before = self.moment();
        if (view.lesson, view.step) != (self.view.lesson, self.view.step) {
            match view.lesson {
                Some(id) if self.view.lesson != Some(id) => self.follow_lesson(course::Action::Begin(id)),
                Some(_) => {}
                None => self.follow_lesson(course::Action::Leave),
            }
            if view.lesson.is_some() {
                self.follow_lesson(course::Action::GoTo(view.step));
            }
        }
        if view.lesson.is_none() && view.figure != self.view.figure {
            self.carry_out(Command::LoadFigure(view.figure));
        }
        (self.view.tab, self.view.enlarged) =
            (view.tab, self.view.enlarged.filter(|_| view.tab == self.view.tab));
        if before != self.moment() {
            self.history.note(before, Hand::default());
        }
        self.follow();
    }

    /// Shows what the fragment of an address asks for, as one step, and says what of it was not usable.
    pub fn open_link(&mut self, fragment: &str) {
        let (view, problems) = link::read(fragment, &self.view);
        // A link that was made here names the window of the map unless it is the usual one; one written by hand may not.
        // A link that names a lesson and nothing else begins its step.
        let (plain, _) = link::read("v=1", &self.view);
        let begins = view.lesson.is_some() && view == View { lesson: view.lesson, step: view.step, ..plain };
        let set = begins.then(|| course::step(&view)?.view.as_deref()).flatten();
        let (view, fragment) = set.map_or((view.clone(), fragment), |set| (course::view_of(set, &view), set));
        self.replace(view, !fragment.contains("map="));
        if let Some(complaint) = link::complaint(&problems) {
            self.notice = Some(complaint);
        }
        self.speech.misread = problems;
    }

    /// Shows what a file holds, as one step: a scenario, or measured data, which brings its page to the front. A bad
    /// scenario changes nothing but the notice.
    pub fn open_file(&mut self, name: &str, contents: Result<Vec<u8>, Sentence>) {
        let contents = contents.and_then(|bytes| look(name, &bytes, bytes.len()).map(|()| bytes));
        let contents = match contents {
            Ok(bytes) if !is_scenario(name, &bytes) => return self.import(name, bytes),
            contents => contents,
        };
        let text = match contents.and_then(text_of) {
            Ok(text) => text,
            Err(reason) => return self.tell_unopened(name, &reason),
        };
        // A lesson is known by its steps, a scenario has none but a number.
        let steps = serde_json::from_str::<Value>(&text).ok().and_then(|value| value.get("steps").cloned());
        if steps.is_some() {
            return self.open_lesson(name, &text);
        }
        let (text, recording) = match recording_apart(text) {
            Ok(parts) => parts,
            Err(reason) => return self.tell_unopened(name, &reason.into()),
        };
        match View::read(&text, &self.view).map(|view| view.with_looks_of(&self.view)) {
            Ok(view) => {
                self.notice = None;
                self.replace(view, false);
                if let Some(RecordingFile { name, time, acceleration }) = recording {
                    self.bench.vibration.open(&name, BaseRecording::text(&time, &acceleration).into_bytes());
                }
            }
            Err(reason) => self.tell_unopened(name, &reason),
        }
    }

    /// Begins a lesson of one's own from the text of its file, as one step, or goes to the step of it that a link has
    /// asked for. What is wrong with it is told, and changes nothing.
    pub fn open_lesson(&mut self, name: &str, text: &str) {
        match checked(text) {
            Ok(lesson) => {
                self.notice = None;
                let own = LessonId::bring(lesson);
                let step = if self.view.lesson == Some(own) { self.view.step } else { 1 };
                self.begin_step(own, step);
            }
            Err(reason) => self.tell_unopened(name, &reason),
        }
    }

    /// Says why a file could not be opened.
    pub fn tell_unopened(&mut self, name: &str, reason: &Sentence) {
        self.notice = Some(fill(
            "{name} could not be opened: {reason}. Nothing was changed.",
            &[("name", &name), ("reason", reason)],
        ));
    }

    fn import(&mut self, name: &str, text: Vec<u8>) {
        self.notice = None;
        // Where a recording is asked for, a file is one.
        let asked = Place::of(&self.view) == Place::Page(Page::Shake) || self.view.shaken().is_some();
        if asked && self.view.design.shake.by == ShakenBy::Recorded {
            return self.bench.vibration.open(name, text);
        }
        let mut view = View { tab: Tab::Design, enlarged: None, ..self.view.clone() };
        view.design.page = Page::Measured;
        self.replace(view, false);
        self.bench.measured.open(name, text);
    }

    pub(super) fn save_file(&mut self) {
        let mut value = self.view.to_value();
        if let Some(entries) = value.as_object_mut() {
            entries.retain(|name, _| !LOOKS.contains(&name.as_str()));
            let shaken = self.view.design.shake.by == ShakenBy::Recorded;
            if let Some(recorded) = recorded(&self.view, &self.bench).filter(|_| shaken) {
                let (time, acceleration) = (recorded.time.to_vec(), recorded.acceleration.to_vec());
                let name = recorded.recording.name.clone();
                let file = RecordingFile { name, time, acceleration };
                entries.extend(serde_json::to_value(file).map(|value| (RECORDING.to_owned(), value)));
            }
        }
        self.errands.push(Errand::Save(FILE_NAME.to_owned(), "application/json", format!("{value:#}\n")));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::rehearsal;
    use crate::app::view::MapWindow;
    use crate::model::Parameter;
    use crate::questions::chart::Quantity;

    fn app() -> App {
        rehearsal::app(&egui::Context::default(), None)
    }

    fn do_it(app: &mut App, command: Command) {
        app.history.begin_frame(Hand::default());
        app.step(command, Hand::default());
    }

    #[test]
    fn everything_but_the_looks_is_undone_and_done_again() {
        let mut app = app();
        let mut scenario = app.view.scenario.clone();
        scenario.parameters.beta = 0.005;
        let commands = [
            Command::Show(Box::new(scenario)),
            Command::OpenTab(Tab::Sweep),
            Command::LookAt(MapWindow::Sum),
            Command::Chart(Quantity::Power),
            Command::OpenPlane([Parameter::D, Parameter::Beta]),
            Command::LoadFigure(4),
        ];
        let mut views = vec![app.view.clone()];
        for command in commands {
            do_it(&mut app, command);
            views.push(app.view.clone());
        }
        do_it(&mut app, Command::SetDark(true));
        do_it(&mut app, Command::SetProjector(true));
        do_it(&mut app, Command::DismissNotice);
        let looks = app.view.clone();
        for view in views.iter().rev().skip(1) {
            do_it(&mut app, Command::Undo);
            assert_eq!(app.view, view.clone().with_looks_of(&looks));
        }
        assert_eq!(app.history.can(), (false, true));
        for view in views.iter().skip(1) {
            do_it(&mut app, Command::Redo);
            assert_eq!(app.view, view.clone().with_looks_of(&looks));
        }
        assert_eq!(app.history.can(), (true, false));
    }

    #[test]
    fn a_saved_file_opens_again_and_a_bad_one_changes_nothing() {
        let mut app = app();
        do_it(&mut app, Command::LoadFigure(4));
        do_it(&mut app, Command::OpenTab(Tab::Stability));
        let saved = app.view.clone();
        do_it(&mut app, Command::SaveFile);
        let errands = app.take_errands();
        let [Errand::Save(name, _, text)] = errands.as_slice() else { panic!("{errands:?}") };
        assert!(name.ends_with(".json") && text.contains("\"omega\": 25.4"), "{text}");
        assert!(!text.contains("projector"), "{text}");
        do_it(&mut app, Command::LoadFigure(9));
        do_it(&mut app, Command::SetDark(true));
        for bad in ["", "x,y\n1,2\n", "{", "[]", r#"{"name":"other"}"#, r#"{"parameters":{"beta":7}}"#] {
            let before = app.view.clone();
            app.open_file("bad.json", Ok(bad.into()));
            let notice = app.notice.take().expect("a notice");
            assert!(notice.starts_with("bad.json could not be opened: "), "{notice}");
            assert_eq!(app.view, before);
        }
        for (bytes, part) in [(&b"\xfc"[..], "not a text"), (b"\xff\xfe{\0}\0", "UTF-16")] {
            app.open_file("bad.json", Ok(bytes.to_vec()));
            assert!(app.notice.take().is_some_and(|notice| notice.contains(part)));
        }
        app.open_file("good.json", Ok([b"\xef\xbb\xbf", text.as_bytes()].concat()));
        assert_eq!(app.notice, None);
        app.open_file("good.json", Ok(text.clone().into_bytes()));
        assert_eq!((app.notice.clone(), app.view.clone()), (None, saved.with_looks_of(&app.view)));
        assert_eq!(app.view.dark, Some(true));
        do_it(&mut app, Command::Undo);
        assert_eq!(app.view.figure, 9);
    }

    #[test]
    fn a_recording_shakes_what_is_in_view_and_travels_in_a_file() {
        let mut app = app();
        app.view.design.shake.everywhere = true;
        app.view.design.shake.by = ShakenBy::Recorded;
        let rows = (0..800).map(|i| (0.01 * f64::from(i), (0.07 * f64::from(i * i % 91)).sin()));
        let text: String = rows.map(|(t, a)| format!("{t};{a}\n")).collect();
        app.open_file("pump.csv", Ok(format!("time [s];acc [m/s2]\n{text}").into_bytes()));
        assert_eq!((app.notice.as_deref(), app.view.tab), (None, Tab::Explore));
        app.logic(&egui::Context::default());
        let recording = app.view.design.shake.recording.clone().expect("a recording");
        assert_eq!(recording.name, "pump.csv");
        // A link names it, and knows it by its numbers.
        let link = app.fragment();
        assert!(link.contains("design.shake.recording.name=pump.csv"), "{link}");
        do_it(&mut app, Command::SaveFile);
        let errands = app.take_errands();
        let [Errand::Save(_, _, saved)] = errands.as_slice() else { panic!("{errands:?}") };
        let brought = |app: &App| recorded(&app.view, &app.bench).map(|found| found.acceleration.to_vec());
        let before = brought(&app).expect("brought");
        let mut other = super::tests::app();
        other.open_link(&link);
        assert_eq!((other.notice.as_deref(), brought(&other)), (None, None));
        other.open_file("saved.json", Ok(saved.clone().into_bytes()));
        assert_eq!(other.notice, None);
        other.logic(&egui::Context::default());
        let after = brought(&other).expect("brought along");
        assert_eq!((&other.view.design.shake, after.len()), (&app.view.design.shake, before.len()));
        let off = before.iter().zip(&after).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(off < 1e-15, "{off}");
        let broken = saved.replace("\"acceleration\": [", "\"acceleration\": [true, ");
        other.open_file("broken.json", Ok(broken.into_bytes()));
        assert!(other.notice.is_some_and(|notice| notice.contains("acceleration")));
    }

    #[test]
    fn back_and_forward_lead_to_tabs_figures_and_steps() {
        let mut app = app();
        let mut places = vec![app.whereabouts()];
        let lesson = LessonId::named("torus").expect("a lesson");
        for command in [
            Command::OpenTab(Tab::Sweep),
            Command::OpenTab(Tab::Paper),
            Command::LoadFigure(4),
            Command::Lesson(course::Action::Begin(lesson)),
            Command::Lesson(course::Action::GoTo(2)),
            Command::Lesson(course::Action::Leave),
        ] {
            do_it(&mut app, command);
            places.push(app.whereabouts());
        }
        for place in places.iter().rev().chain(&places) {
            app.return_to(place);
            assert_eq!(app.whereabouts(), *place);
        }
        app.return_to(&places[3]);
        assert_eq!((app.view.tab, app.view.figure, app.view.lesson), (Tab::Paper, 4, None));
        app.return_to(&places[5]);
        assert_eq!((app.view.lesson, app.view.step), (Some(lesson), 2));
        // Numbers are not taken back.
        app.view.scenario.parameters.beta = 0.003;
        app.return_to(&places[1]);
        app.return_to(&places[0]);
        assert_eq!(app.view.scenario.parameters.beta, 0.003);
    }

    #[test]
    fn a_lesson_of_ones_own_begins_and_a_broken_one_is_explained() {
        let mut app = app();
        let before = app.view.clone();
        let lesson = r#"{"title":"Mine","summary":"s","minutes":1,"steps":[
            {"text":"one","view":"v=1&omega=9&force=exact"},{"text":"two","view":"v=1&omega=10"}]}"#;
        app.open_file("mine.json", Ok(lesson.replace("omega=9", "omeag=9").into_bytes()));
        let notice = app.notice.take().expect("a notice");
        assert!(notice.contains("mine.json could not be opened: steps 1, view: omeag = 9"), "{notice}");
        assert_eq!(app.view, before);
        app.open_file("mine.json", Ok(lesson.to_owned().into_bytes()));
        assert_eq!(app.notice, None);
        assert_eq!((app.view.lesson, app.view.step), (Some(LessonId::own()), 1));
        assert_eq!(app.view.scenario.parameters.omega, 9.0);
        // Again, as after a change in its file: it goes on where it was.
        do_it(&mut app, Command::Lesson(course::Action::GoTo(2)));
        app.open_lesson("mine.json", lesson);
        assert_eq!((app.view.step, app.view.scenario.parameters.omega), (2, 10.0));
        for _ in 0..4 {
            app.undo();
        }
        assert_eq!(app.view, before);
    }

    #[test]
    fn what_is_no_text_is_refused_by_its_beginning() {
        let mut app = app();
        let before = app.view.clone();
        let row = |length: usize| [b"0,1\n1,2\n".to_vec(), vec![b'7'; length]].concat();
        for (name, first, size, part) in [
            ("sound.wav", b"RIFF\x24\0\0\0WAVE".to_vec(), 200_000_000, "byte 6"),
            ("one.csv", vec![b'1'; FIRST], 50_000_000, "line 1 is longer"),
            ("run.csv", row(100), 500_000_000, "larger than 64 MB"),
            ("view.json", b"{".to_vec(), 50_000_000, "too large for a scenario"),
        ] {
            let reason = look(name, &first, size).expect_err("unfit");
            assert!(reason.to_string().contains(part), "{reason}");
        }
        assert_eq!(look("good.csv", &row(100), 60_000_000), Ok(()));
        assert_eq!(look("old.csv", b"\xff\xfe1\0,\0", 6), Ok(()));
        app.open_file("sound.wav", Ok(b"RIFF\0\0".to_vec()));
        let notice = app.notice.take().expect("a notice");
        assert!(notice.starts_with("sound.wav could not be opened: it is not text"), "{notice}");
        assert_eq!(app.view, before);
    }

    #[test]
    fn a_link_is_one_step_and_its_problems_are_told() {
        let mut app = app();
        do_it(&mut app, Command::LoadFigure(12));
        let mine = app.view.clone();
        app.open_link("#v=1&omega=25.4&beta=9");
        assert_eq!((app.view.scenario.parameters.omega, app.view.map), (25.4, MapWindow::Sum));
        let notice = app.notice.take().expect("a notice");
        assert!(notice.ends_with("beta = 9 (allowed are 0 to 0.2)."), "{notice}");
        do_it(&mut app, Command::Undo);
        assert_eq!(app.view, mine);
        app.open_link("");
        assert_eq!((app.view.clone(), app.notice.clone()), (mine, None));
        let link = app.fragment();
        app.open_link("#v=1");
        app.open_link(&link);
        assert_eq!(app.fragment(), link);
    }
}
