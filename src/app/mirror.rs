//! What the page mirrors in native controls, for those who cannot see or reach the canvas: a few entries of the view, the
//! steps that can be taken back, and the verdict in words.

use serde_json::{Map, Value};

use super::App;
use super::link;
use super::panels::design::shaking::{self, Meant};
use super::reading::Reading;
use super::session::Status;
use super::text::{self, Language};
use super::view::{Tab, View};
use crate::questions::shaken_run::ShakenRun;
use crate::scheduler::{Study as _, Table};
use crate::sentence::Sentence;

/// The entries that have native controls, by their names in links and in `index.html`.
const ENTRIES: [&str; 6] = ["alpha", "beta", "omega", "modes", "force", "tab"];

/// Everything the mirror shows, in a form that two frames can compare quickly.
#[derive(Debug, Clone, PartialEq)]
pub struct Signs {
    view: View,
    steps: (bool, bool),
    /// Number of the answer behind the verdict, once nothing is being computed that would change it.
    answer: Option<u64>,
    failure: Option<Sentence>,
    /// A change of language has the verdict spoken again.
    language: Language,
}

impl App {
    /// The signs of this frame. While `hand_moves` there is no verdict in them.
    pub fn signs(&self, hand_moves: bool) -> Signs {
        let status = self.session.status();
        let rests = status == Status::Done && !hand_moves;
        let answer = if self.view.shaken().is_some() {
            self.shaken_answer()
        } else {
            let shown = self.session.shown.as_ref().filter(|_| self.has_verdict());
            shown.map(|shown| shown.generation)
        };
        Signs {
            view: self.view.clone(),
            steps: self.history.can(),
            answer: answer.filter(|_| rests),
            language: text::language(),
            failure: match status {
                Status::Failed(why) => Some(why),
                _ => None,
            },
        }
    }

    /// Whether the verdict belongs to the scenario in view. The Design tab asks for none: the run itself speaks there.
    fn has_verdict(&self) -> bool {
        let crew = self.crew.borrow();
        let current = crew.studies.inspection(&self.view.scenario).is_some_and(|(_, current)| current);
        current || self.view.tab == Tab::Design
    }

    /// Number of the runs under anything but the sine, once all are there.
    fn shaken_answer(&self) -> Option<u64> {
        let crew = self.crew.borrow();
        let runs = crew.studies.lanes.study::<Table<ShakenRun>>()?;
        runs.finished().then(|| crew.studies.lanes.generation::<Table<ShakenRun>>())
    }

    /// The mirror as JSON: `entries` by name, `undo`, `redo`, and `verdict`, null while it is being computed.
    pub fn mirror_json(&self, signs: &Signs) -> String {
        let entries = link::entries(&signs.view, &ENTRIES);
        let entries: Map<String, Value> =
            entries.into_iter().map(|(name, text)| (name.to_owned(), Value::from(text))).collect();
        let spoken = match (&signs.failure, signs.answer) {
            (Some(why), _) => Value::from(text::say(why)),
            (None, Some(_)) => self.spoken_verdict().map_or(Value::Null, Value::from),
            (None, None) => Value::Null,
        };
        let parts = [
            ("entries", Value::Object(entries)),
            ("undo", Value::from(signs.steps.0)),
            ("redo", Value::from(signs.steps.1)),
            ("verdict", spoken),
        ];
        Value::Object(parts.into_iter().map(|(name, part)| (name.to_owned(), part)).collect()).to_string()
    }

    fn spoken_verdict(&self) -> Option<String> {
        if self.view.shaken().is_some() {
            let mut said = shaking::said(&self.view, &self.bench, &self.crew.borrow().studies);
            // How far something is changes all the time.
            said.retain(|(meant, _)| *meant != Meant::Computing);
            return Some(said.into_iter().map(|(_, sentence)| sentence).collect::<Vec<_>>().join(" "));
        }
        let shown = self.session.shown.as_ref()?;
        let crew = self.crew.borrow();
        let found = crew.studies.inspection(&shown.scenario).filter(|(_, current)| *current);
        let verdict = found.map(|(found, _)| &found.verdict);
        let Reading { headline, plain, facts, warnings, remarks, .. } =
            Reading::new(shown, self.session.boundaries.as_ref(), verdict);
        let mut sentences = format!("{headline}: {}.", facts.join(", "));
        for remark in [plain].into_iter().filter(|text| !text.is_empty()).chain(warnings).chain(remarks) {
            let mut letters = remark.chars();
            let first = letters.next().map(char::to_uppercase);
            sentences
                .extend([' '].into_iter().chain(first.into_iter().flatten()).chain(letters).chain(['.']));
        }
        Some(sentences)
    }

    /// Puts another value in an entry of the view, as one step; names and values are those of links.
    ///
    /// # Errors
    /// One line that names the entry, the value and what is allowed; nothing changes then.
    pub fn change(&mut self, name: &str, value: &str) -> Result<(), String> {
        let view = link::edit(&self.view, name, value).map_err(|problem| problem.to_string())?;
        let follows = view.map == self.view.map;
        self.replace(view, follows);
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::rehearsal;

    fn app() -> App {
        rehearsal::app(&egui::Context::default(), None)
    }

    fn mirror(app: &App) -> Value {
        serde_json::from_str(&app.mirror_json(&app.signs(false))).expect("valid JSON")
    }

    #[test]
    fn entries_and_steps_follow_changes_from_either_side() {
        let mut app = app();
        let before = app.signs(false);
        assert_eq!(app.signs(false), before);
        app.change("omega", "25.4").expect("a frequency in range");
        assert_ne!(app.signs(false), before);
        let shown = mirror(&app);
        assert_eq!((&shown["entries"]["omega"], &shown["undo"]), (&"25.4".into(), &true.into()));
        assert!(ENTRIES.iter().all(|name| shown["entries"][name].is_string()), "{shown}");
        app.undo();
        let shown = mirror(&app);
        assert_eq!((&shown["undo"], &shown["redo"]), (&false.into(), &true.into()));
        let view = app.view.clone();
        let refusal = app.change("beta", "7").expect_err("out of range");
        assert_eq!(refusal, "beta = 7 (allowed are 0 to 0.2)");
        assert_eq!(app.view, view);
    }

    #[test]
    fn under_noise_the_means_are_told_in_place_of_the_verdict() {
        let mut app = app();
        app.view.scenario.parameters.alpha = 5e-3;
        app.change("design.shake.duration", "20").expect("a duration");
        app.change("design.shake.everywhere", "true").expect("noise");
        for _ in 0..200 {
            app.logic(&egui::Context::default());
        }
        let told = mirror(&app)["verdict"].as_str().expect("means").to_owned();
        assert!(told.starts_with("On average it gives ") && told.contains("nothing repeats"), "{told}");
    }

    #[test]
    fn the_verdict_is_told_when_it_is_there_and_the_hand_rests() {
        let mut app = app();
        assert_eq!(mirror(&app)["verdict"], Value::Null);
        let context = egui::Context::default();
        let begun = std::time::Instant::now();
        while app.signs(false).answer.is_none() && begun.elapsed().as_secs() < 60 {
            app.logic(&context);
        }
        let verdict = mirror(&app)["verdict"].as_str().expect("a verdict").to_owned();
        assert!(verdict.starts_with("Period 2: ") && verdict.contains(" V rms"), "{verdict}");
        let told = app.mirror_json(&app.signs(true));
        assert!(told.contains("\"verdict\":null"), "{told}");
        app.change("beta", "0.002").expect("in range");
        assert_eq!(mirror(&app)["verdict"], Value::Null);
    }
}
