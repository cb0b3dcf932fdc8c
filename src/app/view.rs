//! What the user chose: the scenario and how it is looked at. This is what the page remembers.

pub mod design;
pub mod live;

use serde::{Deserialize, Serialize};
use serde_json::Value;

use self::design::DesignView;
use self::live::LiveView;
use super::figures::{self, Figure};
use super::lessons::{LessonId, STEPS};
use crate::app::text::{Language, fill, marked};
use crate::dynamics::sweep::Dwell;
use crate::jobs::study::curves;
use crate::jobs::study::sweep::COUNTS;
use crate::model::{ModelError, Parameter};
use crate::scenario::Scenario;
use crate::theory::Resonance;

/// The tabs of the top bar.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Tab {
    /// The four linked plots.
    #[default]
    Explore,
    /// A run in which time goes on.
    Live,
    /// Charts, multipliers, basins.
    Stability,
    /// Orbit diagrams and response curves.
    Sweep,
    /// A device in SI units: watts, load, limits.
    Design,
    /// The paper's figures and tables.
    Paper,
    /// The list of guided lessons.
    Lessons,
}

impl Tab {
    /// All of them in their order, with their names.
    pub const NAMED: [(Self, &'static str); 7] = [
        (Self::Explore, marked("Explore")),
        (Self::Live, marked("Live")),
        (Self::Stability, marked("Stability")),
        (Self::Sweep, marked("Sweep")),
        (Self::Design, marked("Design")),
        (Self::Paper, marked("Paper")),
        (Self::Lessons, marked("Lessons")),
    ];
}

/// Which part of the (omega, beta) plane the stability map shows.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum MapWindow {
    /// All three resonances.
    #[default]
    All,
    /// About twice the first natural frequency.
    First,
    /// About the sum of the first two.
    Sum,
    /// About twice the second.
    Second,
}

impl MapWindow {
    /// The resonance in the middle of the window.
    pub fn resonance(self) -> Option<Resonance> {
        match self {
            Self::All => None,
            Self::First => Some(Resonance::First),
            Self::Sum => Some(Resonance::Sum),
            Self::Second => Some(Resonance::Second),
        }
    }

    /// The window about a resonance.
    pub fn about(resonance: Resonance) -> Self {
        match resonance {
            Resonance::First => Self::First,
            Resonance::Sum => Self::Sum,
            Resonance::Second => Self::Second,
        }
    }
}

/// What the chart over (omega, beta) shows.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Layer {
    /// Largest multiplier of the forced motion.
    #[default]
    Multiplier,
    /// The motion reached from the scenario's start.
    Motion,
    /// Its voltage.
    Voltage,
    /// Its power.
    Power,
}

/// The panels that can be made large.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Panel {
    /// Stability map.
    StabilityMap,
    /// Phase portrait.
    PhasePortrait,
    /// Poincare map.
    PoincareMap,
    /// Time history.
    TimeHistory,
    /// Chart of stability or of motions.
    Chart,
    /// Multipliers and the unit circle.
    Multipliers,
    /// Stroboscopic points of a sweep.
    OrbitDiagram,
    /// Response curves.
    Response,
    /// Curves of bifurcations.
    Curves,
    /// Spectrum of the voltage.
    Spectrum,
    /// What the verdict rests on.
    Evidence,
    /// Basins of attraction.
    Basins,
    /// What the device delivers over frequency.
    Harvest,
    /// Power against the load.
    Load,
    /// Map over two dimensions of the device.
    DesignMap,
    /// The magnets' force over the tip's range.
    MagnetForce,
    /// Measured data.
    Measured,
    /// Live trace over time.
    Oscilloscope,
    /// Live phase portrait.
    LivePortrait,
    /// Live beam.
    LiveBeam,
}

/// What is swept, and how.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct SweepView {
    /// What changes.
    pub parameter: Parameter,
    /// Lowest and highest value; about the resonance in view, or the present value, when absent.
    pub range: Option<(f64, f64)>,
    /// Number of values.
    pub count: usize,
    /// How long each is held.
    pub dwell: Dwell,
    /// What the response curves show.
    pub output: Output,
}

impl Default for SweepView {
    fn default() -> Self {
        let (parameter, dwell) = (Parameter::Omega, Dwell::default());
        Self { parameter, range: None, count: 240, dwell, output: Output::default() }
    }
}

/// What a response curve shows.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Output {
    /// Root mean square of the voltage.
    #[default]
    Voltage,
    /// Mean power in the load.
    Power,
    /// Largest and smallest tip displacement over the gap.
    Tip,
}

/// Scenario and view, as stored.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct View {
    /// What is computed.
    pub scenario: Scenario,
    /// The tab in front.
    pub tab: Tab,
    /// Dark or light; the system's choice when absent.
    pub dark: Option<bool>,
    /// The language of the texts; the browser's choice when absent.
    #[serde(rename = "lang")]
    pub language: Option<Language>,
    /// High contrast or not; the system's choice when absent.
    pub contrast: Option<bool>,
    /// Large type for the lecture room.
    pub projector: bool,
    /// Window of the stability map.
    pub map: MapWindow,
    /// The figure of the paper that was loaded last.
    pub figure: u8,
    /// The panel that fills the page.
    pub enlarged: Option<Panel>,
    /// Whether the beam moves.
    pub beam_moves: bool,
    /// What the chart shows.
    pub layer: Layer,
    /// What is swept.
    pub sweep: SweepView,
    /// The two parameters of the plane of bifurcation curves.
    pub plane: [Parameter; 2],
    /// The Design tab.
    pub design: DesignView,
    /// The Live tab.
    pub live: LiveView,
    /// The running lesson.
    pub lesson: Option<LessonId>,
    /// Its step, from 1; the last one when there are fewer.
    pub step: usize,
}

impl Default for View {
    /// Opens where there is something to see: the paper's period-doubled motion, Figure 9.
    fn default() -> Self {
        Self {
            scenario: figures::figure(9).and_then(Figure::scenario).unwrap_or_default(),
            tab: Tab::Explore,
            dark: None,
            language: None,
            contrast: None,
            projector: false,
            map: MapWindow::First,
            figure: 9,
            enlarged: None,
            beam_moves: true,
            layer: Layer::default(),
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
    /// Reads a view, or a scenario alone, which leaves the rest of `present` as it is.
    ///
    /// # Errors
    /// One line with the path of the field and what is wrong with it.
    pub fn read(json: &str, present: &Self) -> Result<Self, String> {
        let value: Value = serde_json::from_str(json).map_err(|error| format!("not valid JSON: {error}"))?;
        if !value.is_object() {
            return Err("expected an object such as {\"parameters\":{\"omega\":25}}".to_owned());
        }
        let is_view = value.get("scenario").is_some();
        let view = if is_view {
            Self::from_value(value)?
        } else {
            let scenario = serde_path_to_error::deserialize(value).map_err(describe)?;
            Self { scenario, ..present.clone() }
        };
        view.check().map_err(|(_, reason)| reason)?;
        Ok(view)
    }

    /// A view as JSON, not yet checked.
    pub(super) fn from_value(value: Value) -> Result<Self, String> {
        serde_path_to_error::deserialize(value).map_err(describe)
    }

    /// As JSON.
    pub(super) fn to_value(&self) -> Value {
        // By way of text, which is needed anyway: another serialiser would weigh more.
        serde_json::to_string(self).ok().and_then(|text| serde_json::from_str(&text).ok()).unwrap_or_default()
    }

    /// Checks everything. An error names the part that is wrong, as in JSON, and says why.
    pub(super) fn check(&self) -> Result<(), (&'static str, String)> {
        let part = |name| move |error: ModelError| (name, error.to_string());
        self.scenario.validate().map_err(part("scenario"))?;
        let SweepView { parameter, range, count, dwell, .. } = self.sweep;
        if let Some((from, to)) = range {
            for end in [from, to] {
                ModelError::check(parameter.field(), end, parameter.range(), "").map_err(part("sweep"))?;
            }
        }
        let (minimum, maximum) = COUNTS;
        if !(minimum..=maximum).contains(&count) {
            let field = "sweep.count";
            return Err(part("sweep")(ModelError::Count { field, value: count, minimum, maximum }));
        }
        dwell.validate().map_err(part("sweep"))?;
        self.design.check().map_err(part("design"))?;
        self.live.check().map_err(part("live"))?;
        if !(1..=STEPS).contains(&self.step) {
            let (field, value) = ("step", self.step);
            return Err(part(field)(ModelError::Count { field, value, minimum: 1, maximum: STEPS }));
        }
        let [x, y] = self.plane;
        if x == y || ![x, y].iter().all(|axis| curves::PARAMETERS.contains(axis)) {
            let allowed = curves::PARAMETERS.map(Parameter::field).join(", ");
            return Err(("plane", format!("plane: two different ones of {allowed}")));
        }
        Ok(())
    }

    /// The same, looking like `other`: what suits the room and the eyes, and belongs to no scenario.
    pub(super) fn with_looks_of(self, other: &Self) -> Self {
        let Self { dark, contrast, language, projector, beam_moves, .. } = *other;
        Self { dark, contrast, language, projector, beam_moves, ..self }
    }

    /// What an earlier session stored, and a sentence about it when it cannot be used.
    pub fn restore(stored: Option<&str>) -> (Self, Option<String>) {
        let Some(text) = stored else { return (Self::default(), None) };
        match Self::read(text, &Self::default()) {
            Ok(view) => (view, None),
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

/// One line with the path of the field and what is wrong with it.
fn describe(error: serde_path_to_error::Error<serde_json::Error>) -> String {
    format!("{}: {}", error.path(), error.inner())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_view_round_trips_and_garbage_gives_a_fresh_start_with_a_reason() {
        let view = View { tab: Tab::Paper, projector: true, ..Default::default() };
        let text = serde_json::to_string(&view).expect("a view is plain data");
        assert_eq!(View::restore(Some(&text)), (view, None));
        for garbage in [
            "",
            "{",
            "[1]",
            r#"{"scenario":{"parameters":{"beta":7}}}"#,
            r#"{"scenario":{},"step":1000000000}"#,
        ] {
            let (view, message) = View::restore(Some(garbage));
            assert_eq!(view, View::default());
            assert!(message.is_some_and(|message| message.contains("could not be used")));
        }
    }
}
