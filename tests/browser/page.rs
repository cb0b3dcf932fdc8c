//! The page as a user has it: look, point, drag, read.

mod hand;

use std::{
    env, fs,
    path::{Path, PathBuf},
    thread::sleep,
    time::{Duration, Instant},
};

pub(crate) use hand::{CONTROL, ENTER, ESCAPE, SHIFT, TAB};
use serde::Deserialize;
use serde_json::{Value, json};

use crate::{
    driver::{Browser, Chromium, Firefox},
    server::Files,
};

/// How long anything may take on a slow machine.
const PATIENCE: Duration = Duration::from_secs(120);

/// The colours that the system asks for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Theme {
    Dark,
    Light,
    /// The same for those who need more contrast.
    DarkContrast,
    LightContrast,
}

/// One widget of the page.
#[derive(Clone, Debug, Deserialize)]
pub(crate) struct Control {
    pub(crate) role: String,
    pub(crate) label: String,
    pub(crate) value: Option<String>,
    pub(crate) number: Option<f64>,
    pub(crate) id: u64,
    pub(crate) focusable: bool,
    pub(crate) focused: bool,
    pub(crate) bounds: [f64; 4],
}

impl Control {
    /// A point inside, given as fractions of width and height.
    pub(crate) fn at(&self, across: f64, down: f64) -> (f64, f64) {
        let [left, top, right, bottom] = self.bounds;
        (left + (right - left) * across, top + (bottom - top) * down)
    }
}

/// The page in a browser of its own, served by a server of its own.
pub(crate) struct Page {
    pub(crate) files: Files,
    browser: Box<dyn Browser>,
    console: Vec<(String, String)>,
    errors_expected: bool,
}

/// The project's folder.
pub(crate) fn project() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// The folder with the built page: `dist`, or what HARVESTER_DIST names.
pub(crate) fn dist() -> PathBuf {
    env::var_os("HARVESTER_DIST").map_or_else(|| project().join("dist"), PathBuf::from)
}

impl Page {
    /// Opens the page and waits until it is drawn.
    pub(crate) fn open(width: u32, height: u32, theme: Theme) -> Self {
        Self::open_at(&dist(), width, height, theme)
    }

    /// Opens the page of a folder.
    pub(crate) fn open_at(root: &Path, width: u32, height: u32, theme: Theme) -> Self {
        Self::open_in(Box::new(Chromium::start()), root, width, height, theme)
    }

    /// Opens the page of a folder in Firefox, where sizes are those of the window.
    pub(crate) fn open_in_firefox(root: &Path, width: u32, height: u32, theme: Theme) -> Self {
        Self::open_in(Box::new(Firefox::start(theme)), root, width, height, theme)
    }

    fn open_in(browser: Box<dyn Browser>, root: &Path, width: u32, height: u32, theme: Theme) -> Self {
        let files = Files::serve(root);
        let mut page = Self { files, browser, console: Vec::new(), errors_expected: false };
        page.resize(width, height, theme);
        page.goto();
        // The greeting of a first visit.
        page.pass_greeting();
        page
    }

    /// Takes the greeting away, which lies over everything, once it stands where it will stay.
    pub(crate) fn pass_greeting(&mut self) {
        self.find("Look around", &["Button"]);
        self.wait("the greeting to go", |page| {
            let controls = page.controls();
            let past = controls.iter().find(|control| control.label == "Look around");
            past.inspect(|past| page.click(past.at(0.5, 0.5))).is_none().then_some(())
        });
    }

    /// Loads the page (again) by its address.
    pub(crate) fn goto(&mut self) {
        let url = self.files.url();
        self.browser.goto(&url);
        self.wait_ready();
    }

    /// Loads another file of the same folder.
    pub(crate) fn goto_file(&self, name: &str) {
        let url = self.files.url() + name;
        self.browser.goto(&url);
    }

    /// A script that runs in the page before its own, from the next load on.
    pub(crate) fn before_each_load(&self, script: &str) -> Value {
        self.browser.devtools("Page.addScriptToEvaluateOnNewDocument", &json!({ "source": script }))
    }

    /// Ends what [`Self::before_each_load`] began.
    pub(crate) fn before_no_load(&self, script: &Value) {
        self.browser.devtools("Page.removeScriptToEvaluateOnNewDocument", script);
    }

    /// Calls Chromium's own protocol.
    pub(crate) fn devtools(&self, command: &str) -> Value {
        self.browser.devtools(command, &json!({}))
    }

    /// From now on errors on the console are part of the test.
    pub(crate) fn expects_errors(&mut self) {
        self.errors_expected = true;
    }

    pub(crate) fn reload(&mut self) {
        self.reload_unready();
        self.wait_ready();
    }

    /// The same for a page that need not start.
    pub(crate) fn reload_unready(&self) {
        self.browser.refresh();
    }

    /// Waits until the browser has kept the page for use without a network.
    pub(crate) fn wait_kept(&mut self) {
        self.wait("the service worker", |page| {
            (page.script("return navigator.serviceWorker.controller?.state") == "activated").then_some(())
        });
    }

    pub(crate) fn wait_ready(&mut self) {
        self.wait("the page to start", |page| {
            let phase =
                page.script("return document.documentElement.dataset.phase + '|' + document.body.innerText");
            let phase = phase.as_str().unwrap_or_default();
            assert!(!phase.starts_with("failed"), "the page failed: {phase}\n{:?}", page.browser.console());
            (phase.starts_with("ready") && page.script("return 'harvester' in window") == true).then_some(())
        });
    }

    pub(crate) fn resize(&self, width: u32, height: u32, theme: Theme) {
        self.browser.resize(width, height, theme);
    }

    /// Lets the page move by itself, as most systems do.
    pub(crate) fn let_move(&self) {
        self.browser.let_move();
    }

    /// Runs JavaScript; a promise is waited for.
    pub(crate) fn script(&self, script: &str) -> Value {
        self.script_with(script, vec![])
    }

    /// The same with arguments.
    pub(crate) fn script_with(&self, script: &str, arguments: Vec<Value>) -> Value {
        self.browser.execute(script, arguments)
    }

    /// Calls a function of `window.harvester`: what it answers, or the message of its refusal.
    pub(crate) fn call(&self, function: &str, argument: &str) -> Result<Value, String> {
        let script = format!(
            "try {{ return [true, await window.harvester.{function}(arguments[0])]; }} \
             catch (error) {{ return [false, String(error?.message ?? error)]; }}"
        );
        let script = format!("return (async function() {{ {script} }})(...arguments)");
        let answer = self.browser.execute(&script, vec![json!(argument)]);
        if answer[0] == true {
            Ok(answer[1].clone())
        } else {
            Err(answer[1].as_str().unwrap_or_default().to_owned())
        }
    }

    fn json(&self, function: &str) -> Value {
        let text = self.call(function, "").unwrap_or_else(|message| panic!("{function}(): {message}"));
        serde_json::from_str(text.as_str().unwrap_or_default()).expect("harvester answers in JSON")
    }

    pub(crate) fn state(&self) -> Value {
        self.json("state")
    }

    pub(crate) fn frames(&self) -> Value {
        self.json("frames")
    }

    pub(crate) fn controls(&self) -> Vec<Control> {
        serde_json::from_value(self.json("controls")).expect("a list of widgets")
    }

    /// The labels of all widgets of a role, once there are some.
    pub(crate) fn labels(&mut self, role: &str) -> Vec<String> {
        self.find("", &[role]);
        self.controls()
            .into_iter()
            .filter(|control| control.role == role)
            .map(|control| control.label)
            .collect()
    }

    /// Polls until `look` finds something.
    pub(crate) fn wait<T>(&mut self, what: &str, mut look: impl FnMut(&Self) -> Option<T>) -> T {
        let began = Instant::now();
        loop {
            if let Some(found) = look(self) {
                return found;
            }
            if began.elapsed() > PATIENCE {
                let picture = self.screenshot("gave-up");
                self.drain();
                panic!("waited in vain for {what}; see {}; console: {:?}", picture.display(), self.console);
            }
            sleep(Duration::from_millis(30));
        }
    }

    pub(crate) fn wait_until(&mut self, what: &str, mut holds: impl FnMut(&Value) -> bool) -> Value {
        self.wait(what, |page| Some(page.state()).filter(&mut holds))
    }

    /// The widget with this label (whole, or else its beginning) and one of these roles, once it is on the screen.
    pub(crate) fn find(&mut self, label: &str, roles: &[&str]) -> Control {
        self.wait(&format!("a {roles:?} labelled {label:?}"), |page| {
            let fits = |control: &&Control| roles.is_empty() || roles.contains(&control.role.as_str());
            let controls = page.controls();
            let mut named = controls.iter().filter(fits);
            let found = named.clone().find(|control| control.label == label);
            found.or_else(|| named.find(|control| control.label.starts_with(label))).cloned()
        })
    }

    pub(crate) fn slider(&mut self, label: &str) -> Control {
        self.find(label, &["Slider"])
    }

    /// Lets the page save files in a folder.
    pub(crate) fn downloads_to(&self, folder: &Path) {
        let parameters = json!({ "behavior": "allow", "downloadPath": folder });
        self.browser.devtools("Browser.setDownloadBehavior", &parameters);
    }

    pub(crate) fn png(&self) -> Vec<u8> {
        self.browser.screenshot()
    }

    /// Writes `target/screenshots/<name>.png`.
    pub(crate) fn screenshot(&self, name: &str) -> PathBuf {
        let folder = project().join("target/screenshots");
        let file = folder.join(name).with_extension("png");
        fs::create_dir_all(&folder)
            .and_then(|()| fs::write(&file, self.png()))
            .expect("a screenshot on disk");
        file
    }

    fn drain(&mut self) {
        // Software WebGL and canvas text have much to say that is about neither.
        let noise = ["software WebGL", "GL Driver Message", "willReadFrequently"];
        let telling = |entry: &(String, String)| !noise.iter().any(|words| entry.1.contains(words));
        self.console.extend(self.browser.console().into_iter().filter(telling));
    }

    /// Ends the visit: nothing on the console may be an error.
    pub(crate) fn close(mut self) {
        self.drain();
        let errors: Vec<_> = self.console.iter().filter(|(level, _)| level == "SEVERE").collect();
        assert!(self.errors_expected || errors.is_empty(), "errors on the console: {errors:#?}");
        for (level, message) in &self.console {
            println!("console {level}: {message}");
        }
    }
}
