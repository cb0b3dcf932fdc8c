//! Browsers that tests drive, closed again however a test ends.

mod chromium;
mod firefox;

use std::{env, path::PathBuf};

use serde_json::Value;

pub(crate) use chromium::Chromium;
pub(crate) use firefox::Firefox;

use crate::page::Theme;

/// A browser with one window. Its methods block: the tests have nothing else to do.
pub(crate) trait Browser {
    /// Loads a page.
    fn goto(&self, url: &str);

    /// Loads it again.
    fn refresh(&self);

    /// Runs JavaScript in the page; a promise is waited for.
    fn execute(&self, script: &str, arguments: Vec<Value>) -> Value;

    /// What keys and pointers do, as in WebDriver.
    fn perform(&self, actions: &Value);

    /// A picture of the page as PNG.
    fn screenshot(&self) -> Vec<u8>;

    /// The size of the page, and the colours that its system asks for where the browser can still change them.
    fn resize(&self, width: u32, height: u32, theme: Theme);

    /// From now on the system lets pages move by themselves. It does not at first: tests are about other things, and every
    /// picture takes time.
    fn let_move(&self) {
        panic!("only Chromium can be told so while it runs")
    }

    /// Console messages since the last call: (level, message).
    fn console(&self) -> Vec<(String, String)> {
        Vec::new()
    }

    /// Calls Chromium's own protocol.
    fn devtools(&self, command: &str, _parameters: &Value) -> Value {
        panic!("{command} is for Chromium only")
    }
}

/// The program named by an environment variable, or the first of `names` on the search path.
fn program(variable: &str, names: &[&str]) -> PathBuf {
    if let Some(given) = env::var_os(variable) {
        return given.into();
    }
    let path = env::var_os("PATH").unwrap_or_default();
    let folders: Vec<PathBuf> = env::split_paths(&path).collect();
    let candidates = names.iter().flat_map(|name| folders.iter().map(move |folder| folder.join(name)));
    candidates.into_iter().find(|candidate| candidate.is_file()).unwrap_or_else(|| {
        panic!("none of {names:?} is installed: `scripts/tools.sh browser` installs or explains")
    })
}
