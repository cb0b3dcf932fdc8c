//! What panels ask for. They draw from shared references and push commands; one place carries them out.

use super::bench::measured::Reading;
use super::bench::variant::Change;
use super::lessons::course::Action;
use super::live::LiveAction;
use super::view::design::DesignView;
use super::view::live::LiveView;
use super::view::{MapWindow, Panel, SweepView, Tab};
use crate::app::text::Language;
use crate::export::Format;
use crate::model::Parameter;
use crate::questions::chart::Quantity;
use crate::questions::design::measured::Kind;
use crate::scenario::Scenario;
use crate::sentence::Sentence;

/// A wish of the user.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Command {
    /// Compute and show this from now on.
    Show(Box<Scenario>),
    /// Bring a tab to the front.
    OpenTab(Tab),
    /// Look at another part of the stability map.
    LookAt(MapWindow),
    /// Chart something else.
    Chart(Quantity),
    /// Sweep something else.
    Sweep(SweepView),
    /// Trace curves in another plane.
    OpenPlane([Parameter; 2]),
    /// Show something else of the Design tab.
    Design(Box<DesignView>),
    /// Show something else of the Live tab.
    LookLive(LiveView),
    /// Do something with the live run.
    Live(LiveAction),
    /// Take a changed device over, or say why it is none.
    Adopt(Result<Box<Scenario>, Sentence>),
    /// Go on in the lessons.
    Lesson(Action),
    /// Begin the search for a design, or end it.
    Find(bool),
    /// Go on with what is computed about the shaking, or stop that.
    Shake(bool),
    /// Read the columns of the file with this quantity so, or close it.
    Measure(Kind, Option<Reading>),
    /// Begins to fit the device in view to the measured data.
    Fit,
    /// Take the end of the run in view as if it were a file of measured data.
    MeasureRun,
    /// Take the noise in view as if it were a recording.
    RecordNoise,
    /// Load a figure of the paper.
    LoadFigure(u8),
    /// Fill the page with a panel, or show all of them again.
    Enlarge(Option<Panel>),
    /// Keep the present curves as ghosts, or drop them.
    Pin(bool),
    /// Change the pinned variants of the design.
    Variant(Change),
    /// Dark or light theme.
    SetDark(bool),
    /// Another language.
    Speak(Language),
    /// High contrast or not.
    SetContrast(bool),
    /// Light, dark and contrast as the system has them.
    FollowSystem,
    /// Large type or normal.
    SetProjector(bool),
    /// Let the beam move, or hold it.
    MoveBeam(bool),
    /// Take the message away.
    DismissNotice,
    /// Take the last step back.
    Undo,
    /// Take it again.
    Redo,
    /// Save what is in view as a file.
    SaveFile,
    /// Save the plots of the card with this title.
    Export(String, Format),
    /// Save a report on the device and its motion.
    Report,
    /// Ask for a file to open: a scenario, measured data, or a lesson.
    OpenFile,
    /// Fill the screen with the page, or end that.
    FullScreen,
    /// Record this part of the page, in parts of its sides, under this title, or end that.
    Record(Option<(String, egui::Rect)>),
}

impl Command {
    /// What pinning means on this tab, where curves are `pinned` or not.
    pub(super) fn pin(tab: Tab, pinned: bool) -> Self {
        if tab == Tab::Design { Self::Variant(Change::Pin) } else { Self::Pin(!pinned) }
    }
}

/// The commands of a frame.
pub(super) type Commands = Vec<Command>;
