//! Links and scenario files: what goes out of the page, and what comes in.

use super::App;
use super::lessons::course;
use super::link;
use super::view::design::Page;
use super::view::{Tab, View};
use crate::app::text::{Language, fill, reworded, tr};

/// Name of saved files.
const FILE_NAME: &str = "harvester-scenario.json";
/// A file larger than this is no scenario.
const LARGEST_FILE: usize = 1 << 20;
/// What belongs to the room and the eyes, and not into a file.
const LOOKS: [&str; 5] = ["lang", "dark", "contrast", "projector", "beam_moves"];

/// What only the browser can do.
#[derive(Debug, Clone, PartialEq)]
pub enum Errand {
    /// Save a text as a file of this name and type.
    Save(String, &'static str, String),
    /// Make a picture of this drawing with so many times its pixels, and save it under this name.
    Picture(String, String, u8),
    /// Let these samples between -1 and 1 be heard after those before them; none ends the sound.
    Sound(Vec<f32>),
    /// Ask for a file, and pass it to [`App::open_file`].
    Open,
    /// Fetch what this language needs, and pass it to [`App::learn`].
    Fetch(Language),
    /// Have the page's own markup in this language, with these texts by their English ones, as JSON.
    Speak(Language, String),
}

/// Whether a file of this name and contents is meant as a scenario; it holds measured data otherwise.
fn is_scenario(name: &str, contents: &[u8]) -> bool {
    let first = contents.trim_ascii_start().first();
    name.to_ascii_lowercase().ends_with(".json") || matches!(first, Some(b'{'))
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
    }

    /// Shows what a file holds, as one step: a scenario, or measured data, which brings its page to the front. A bad
    /// scenario changes nothing but the notice.
    pub fn open_file(&mut self, name: &str, contents: Result<Vec<u8>, String>) {
        let contents = match contents {
            Ok(bytes) if !is_scenario(name, &bytes) => return self.import(name, bytes),
            contents => contents,
        };
        match contents.and_then(|bytes| self.read_file(bytes)) {
            Ok(view) => {
                self.notice = None;
                self.replace(view, false);
            }
            Err(reason) => {
                self.notice = Some(fill(
                    "{name} could not be opened: {reason}. Nothing was changed.",
                    &[("name", &name), ("reason", &reworded(&reason))],
                ));
            }
        }
    }

    fn import(&mut self, name: &str, text: Vec<u8>) {
        self.notice = None;
        let mut view = View { tab: Tab::Design, enlarged: None, ..self.view.clone() };
        view.design.page = Page::Measured;
        self.replace(view, false);
        self.bench.measured.open(name, text);
    }

    fn read_file(&self, bytes: Vec<u8>) -> Result<View, String> {
        if bytes.len() > LARGEST_FILE {
            return Err(tr("it is too large for a scenario").to_owned());
        }
        let text = String::from_utf8(bytes).map_err(|_| tr("it is not a text").to_owned())?;
        let text = text.trim_start_matches('\u{feff}');
        if !text.trim_start().starts_with('{') {
            return Err(tr("it is not a scenario, which begins with {").to_owned());
        }
        Ok(View::read(text, &self.view)?.with_looks_of(&self.view))
    }

    pub(super) fn save_file(&mut self) {
        let mut value = self.view.to_value();
        if let Some(entries) = value.as_object_mut() {
            entries.retain(|name, _| !LOOKS.contains(&name.as_str()));
        }
        self.errands.push(Errand::Save(FILE_NAME.to_owned(), "application/json", format!("{value:#}\n")));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::command::Command;
    use crate::app::history::Hand;
    use crate::app::rehearsal;
    use crate::app::view::{Layer, MapWindow};
    use crate::model::Parameter;

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
            Command::Chart(Layer::Power),
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
        app.open_file("bad.json", Ok(vec![0xff, 0xfe]));
        assert!(app.notice.take().is_some_and(|notice| notice.contains("not a text")));
        app.open_file("good.json", Ok(text.clone().into_bytes()));
        assert_eq!((app.notice.clone(), app.view.clone()), (None, saved.with_looks_of(&app.view)));
        assert_eq!(app.view.dark, Some(true));
        do_it(&mut app, Command::Undo);
        assert_eq!(app.view.figure, 9);
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
