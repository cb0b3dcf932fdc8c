//! What the user chose: the scenario and how it is looked at. This is what the page remembers.

pub mod design;
mod front;
pub mod live;
mod panel;
mod salvage;
pub mod shake;
mod sweep;

use serde::{Deserialize, Serialize};
use serde_json::Value;

use self::design::{DesignView, Side};
pub use self::front::{MapWindow, Tab};
use self::live::LiveView;
pub use self::panel::Panel;
pub(in crate::app) use self::panel::panels;
use self::salvage::salvage;
use self::shake::{Recording, ShakenBy};
pub use self::sweep::{Output, SweepView};
use super::figures;
use super::lessons::{LessonId, STEPS};
use crate::app::text::{Language, fill};
use crate::model::{Dimension, ElectricalScaling, ForceLaw, ModelError, Parameter};
use crate::questions::chart::Quantity;
use crate::questions::curves;
use crate::questions::design::published::BIMORPH;
use crate::questions::input::{self, FieldError};
use crate::scenario::{Scenario, counted};
use crate::sentence::{Say, Sentence, said};

/// Scenario and view, as stored; the fields in the order that links have.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct View {
    /// What is computed.
    pub scenario: Scenario,
    /// The tab in front.
    pub tab: Tab,
    /// Window of the stability map.
    pub map: MapWindow,
    /// What the chart shows.
    pub layer: Quantity,
    /// What is swept.
    pub sweep: SweepView,
    /// The two parameters of the plane of bifurcation curves.
    pub plane: [Parameter; 2],
    /// The figure of the paper that was loaded last.
    pub figure: u8,
    /// The panel that fills the page.
    pub enlarged: Option<Panel>,
    /// The Design tab.
    pub design: DesignView,
    /// The Live tab.
    pub live: LiveView,
    /// The running lesson.
    pub lesson: Option<LessonId>,
    /// Its step, from 1; the last one when there are fewer.
    pub step: usize,
    /// The language of the texts; the browser's choice when absent.
    #[serde(rename = "lang")]
    pub language: Option<Language>,
    /// Dark or light; the system's choice when absent.
    pub dark: Option<bool>,
    /// High contrast or not; the system's choice when absent.
    pub contrast: Option<bool>,
    /// Large type for the lecture room.
    pub projector: bool,
    /// Whether what can move by itself does, the beam and the live run; the system's choice when absent.
    pub beam_moves: Option<bool>,
}

/// What of a view cannot be shown.
#[derive(Debug)]
pub(super) struct Fault {
    /// The part that is wrong, as in JSON.
    pub part: &'static str,
    /// What is wrong with it; nothing where it is the plane, whose two parameters must differ and be among those that can
    /// be followed.
    pub error: Option<ModelError>,
}

impl Say for Fault {
    fn say(&self) -> Sentence {
        let names = || curves::PARAMETERS.map(Parameter::field).join(", ");
        let plane = || said("plane: two different ones of {names}", &[("names", &names())]);
        self.error.as_ref().map_or_else(plane, Say::say)
    }
}

/// What the page opens with, and what its sliders return to: a period-doubled motion that lasts, inside of the first
/// tongue, under the exact force law. Links and files that leave something out mean the paper's numbers all the same.
pub fn opening() -> Scenario {
    let mut scenario = Scenario::default();
    let p = &mut scenario.parameters;
    (p.beta, p.omega) = (2.5e-3, 8.2);
    scenario.model.force = ForceLaw::Exact;
    scenario
}

impl Default for View {
    /// Opens where there is something to see.
    fn default() -> Self {
        Self {
            scenario: opening(),
            tab: Tab::Explore,
            dark: None,
            language: None,
            contrast: None,
            projector: false,
            map: MapWindow::First,
            figure: 9,
            enlarged: None,
            beam_moves: None,
            layer: Quantity::default(),
            sweep: SweepView::default(),
            plane: [Parameter::Omega, Parameter::Beta],
            design: DesignView::default(),
            live: LiveView::default(),
            lesson: None,
            step: 1,
        }
    }
}

impl View {
    /// Reads a view, or a scenario alone, which leaves the rest of `present` as it is. A scenario with a device and
    /// without the ten numbers has the numbers of the device.
    ///
    /// # Errors
    /// The path of the field and what is wrong with it.
    pub fn read(json: &str, present: &Self) -> Result<Self, Sentence> {
        Self::of_value(input::json(json)?, present)
    }

    fn of_value(value: Value, present: &Self) -> Result<Self, Sentence> {
        if !value.is_object() {
            let example = "{\"parameters\":{\"omega\":25}}";
            return Err(said("expected an object such as {example}", &[("example", &example)]));
        }
        let is_view = value.get("scenario").is_some();
        let scenario = value.get("scenario").unwrap_or(&value);
        let numbers_follow = scenario.get("parameters").is_none();
        let mut view = if is_view {
            input::fields(&value)?
        } else {
            Self { scenario: input::fields(&value)?, ..present.clone() }
        };
        if let Some(device) = view.scenario.device.filter(|_| numbers_follow) {
            let scaling = view.scenario.scaling;
            view.scenario.set_device(device, scaling)?;
        }
        view.check().map_err(|fault| fault.say())?;
        Ok(view)
    }

    /// A view as JSON, not yet checked.
    pub(super) fn from_value(value: Value) -> Result<Self, FieldError> {
        input::fields(&value)
    }

    /// As JSON.
    pub(super) fn to_value(&self) -> Value {
        // By way of text, which is needed anyway: another serialiser would weigh more.
        serde_json::to_string(self).ok().and_then(|text| serde_json::from_str(&text).ok()).unwrap_or_default()
    }

    /// One with all that there need not be, so that every place of its JSON can be seen; what it says is of no interest.
    pub(super) fn complete() -> Self {
        let mut view = Self::default();
        view.scenario.device = Some(BIMORPH.device());
        view.scenario.scaling = ElectricalScaling::Consistent;
        view.scenario.model.residual_moment = true;
        view.design.search.third = Some(Side::of(Dimension::TipMass));
        view.design.shake.recording = Some(Recording { name: "r".to_owned(), checksum: 0 });
        view
    }

    /// Checks everything.
    pub(super) fn check(&self) -> Result<(), Fault> {
        let part = |part| move |error: ModelError| Fault { part, error: Some(error) };
        self.scenario.validate().map_err(part("scenario"))?;
        self.sweep.check().map_err(part("sweep"))?;
        self.design.check().map_err(part("design"))?;
        self.live.check().map_err(part("live"))?;
        counted("step", self.step, (1, STEPS)).map_err(part("step"))?;
        counted("figure", self.figure.into(), figures::NUMBERS).map_err(part("figure"))?;
        let [x, y] = self.plane;
        if x == y || ![x, y].iter().all(|axis| curves::PARAMETERS.contains(axis)) {
            return Err(Fault { part: "plane", error: None });
        }
        Ok(())
    }

    /// What shakes the base of what is in view in place of the sine.
    pub(in crate::app) fn shaken(&self) -> Option<ShakenBy> {
        let shake = &self.design.shake;
        (matches!(self.tab, Tab::Explore | Tab::Live) && shake.everywhere).then_some(shake.by)
    }

    /// The same, looking like `other`: what suits the room and the eyes, and belongs to no scenario.
    pub(super) fn with_looks_of(self, other: &Self) -> Self {
        let Self { dark, contrast, language, projector, beam_moves, .. } = *other;
        Self { dark, contrast, language, projector, beam_moves, ..self }
    }

    /// What an earlier session stored, less the parts that cannot be used, and a sentence about those.
    pub fn restore(stored: Option<&str>) -> (Self, Option<String>) {
        let Some(text) = stored else { return (Self::default(), None) };
        let read = input::json(text).map_err(Sentence::from);
        match read.and_then(|value| salvage(value, |value| Self::of_value(value, &Self::default()))) {
            Ok((view, dropped)) if dropped.is_empty() => (view, None),
            Ok((view, dropped)) => {
                let parts = dropped.join(", ");
                let message = fill(
                    "Parts of the stored state could not be used and are as in a fresh start: {parts}. The rest is kept.",
                    &[("parts", &parts)],
                );
                (view, Some(message))
            }
            Err(reason) => {
                let message = fill(
                    "The stored state could not be used ({reason}); this is a fresh start.",
                    &[("reason", &reason)],
                );
                (Self::default(), Some(message))
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_device_alone_brings_its_own_numbers() {
        let read = |json: &str| View::read(json, &View::default());
        let device = r#""device":{"beam_length":0.3,"resistance":1e5},"scaling":"consistent""#;
        for json in [format!("{{{device}}}"), format!(r#"{{"scenario":{{{device}}}}}"#)] {
            let scenario = read(&json).expect("a device").scenario;
            let found = scenario.device().expect("the same device");
            assert!((found.resistance / 1e5 - 1.0).abs() < 1e-12, "{found:?}");
            assert!((found.beam_mass / scenario.base().beam_mass - 1.0).abs() < 1e-12, "{found:?}");
        }
        // Beside numbers it says what they leave open.
        let both = read(&format!(r#"{{{device},"parameters":{{"beta":0.002}}}}"#)).expect("both").scenario;
        assert_eq!((both.parameters.beta, both.parameters.kappa), (0.002, 1e-6));
        let bad = read(r#"{"device":{"beam_length":-1}}"#).expect_err("no beam");
        assert!(bad.to_string().contains("beam_length"), "{bad}");
    }

    #[test]
    fn what_names_no_force_law_means_the_quadratic_one_whatever_the_page_opens_with() {
        assert_eq!(opening().model.force, ForceLaw::Exact);
        let view = |json: &str| View::read(json, &View::default()).expect("a view").scenario;
        let stored = |json: &str| View::restore(Some(json)).0.scenario;
        let link = |text: &str| crate::app::link::read(text, &View::default()).0.scenario;
        for scenario in [
            view(r#"{"parameters":{"omega":8.2}}"#),
            view(r#"{"model":{"modes":3},"parameters":{"omega":8.2}}"#),
            view(r#"{"scenario":{"parameters":{"omega":8.2}},"tab":"sweep"}"#),
            stored(r#"{"scenario":{"version":1,"parameters":{"omega":8.2}},"figure":9}"#),
            link("v=1&omega=8.2"),
            link("v=1&omega=8.2&modes=3"),
        ] {
            assert_eq!(scenario.model.force, ForceLaw::Quadratic);
            let usual = Scenario::default().parameters;
            assert_eq!((scenario.parameters.beta, scenario.parameters.omega), (usual.beta, 8.2));
        }
        // What is made now says what it means.
        assert!(crate::app::link::write(&View::default()).contains("force=exact"));
        assert_eq!(link(&crate::app::link::write(&View::default())), opening());
    }

    #[test]
    fn a_view_round_trips_and_garbage_gives_a_fresh_start_with_a_reason() {
        let view = View { tab: Tab::Paper, projector: true, ..Default::default() };
        let text = serde_json::to_string(&view).expect("a view is plain data");
        assert_eq!(View::restore(Some(&text)), (view, None));
        for garbage in ["", "{", "[1]", "5"] {
            let (view, message) = View::restore(Some(garbage));
            assert_eq!(view, View::default());
            assert!(message.is_some_and(|message| message.contains("could not be used")));
        }
    }

    #[test]
    fn bad_parts_of_a_stored_state_are_dropped_and_named_and_the_rest_is_kept() {
        let good = View { tab: Tab::Sweep, figure: 4, projector: true, ..Default::default() };
        let spoiled = |spoil: &dyn Fn(&mut Value)| {
            let mut value = good.to_value();
            spoil(&mut value);
            View::restore(Some(&value.to_string()))
        };
        let set = |place: &'static str, new: Value| {
            move |value: &mut Value| *value.pointer_mut(place).expect("a place") = new.clone()
        };
        let cases: [(&str, Value, &str); 8] = [
            ("/lang", Value::from(5), "lang"),
            ("/tab", Value::from("disco"), "tab"),
            ("/scenario/parameters/beta", Value::from(7), "scenario.parameters.beta"),
            ("/scenario/parameters/omega", Value::from("fast"), "scenario.parameters.omega"),
            ("/scenario/initial", Value::from(vec![1.0]), "scenario.initial"),
            ("/step", Value::from(1_000_000_000), "step"),
            ("/sweep/dwell/kept", Value::from(-1), "sweep.dwell"),
            ("/design/search/sides/0/dimension", Value::from(0), "design.search.sides"),
        ];
        for (place, new, name) in cases {
            let (view, message) = spoiled(&set(place, new));
            let message = message.expect("a message");
            assert!(message.contains(&format!("fresh start: {name}")), "{place}: {message}");
            assert_eq!((view.figure, view.projector), (4, true), "{place}: {message}");
            assert!(place == "/tab" || view.tab == Tab::Sweep, "{place}: {message}");
            assert!(view.check().is_ok());
        }
        // Several at once, of which each is named.
        let (view, message) = spoiled(&|value: &mut Value| {
            value["lang"] = Value::from(vec![1]);
            value["scenario"]["t_end"] = Value::from(-1);
            value["scenario"]["gravity"] = Value::from(1);
        });
        let message = message.expect("a message");
        for name in ["lang", "scenario.t_end", "scenario.gravity"] {
            assert!(message.contains(name), "{message}");
        }
        let mut expected = good.clone();
        expected.scenario.t_end = Scenario::default().t_end;
        assert_eq!(view, expected);
    }
}
