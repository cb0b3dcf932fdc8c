//! A file of measured data: opened at once, read a slice a frame.

use std::f64::consts::TAU;

use egui_plot::PlotPoint;

use super::questions::shaking;
use super::recorded::BaseRecording;
use crate::app::clock::milliseconds;
use crate::app::session::Shown;
use crate::app::text::say;
use crate::app::view::View;
use crate::app::view::design::FREQUENCIES;
use crate::model::Dimension;
use crate::questions::design::measured::{Ask, Columns, Import, Kind, Layout, decode, detect, detect_with};
use crate::questions::design::record::{Clock, Level, sorted};
use crate::questions::design::thin::{Thinner, extent};
use crate::questions::fit::Fit;
use crate::scenario::{Forgotten, Scenario};
use crate::sentence::{Say, said};

/// Time that a frame may spend on reading, and rows between looks at the clock.
const BUDGET_MS: f64 = 6.0;
const ROWS: usize = 500;
/// Excitation periods of a run that are taken as a record, and rows for each.
const RECORDED: f64 = 20.0;
const ROWS_PER_PERIOD: usize = 200;
/// Buckets of the curve that is drawn.
const BUCKETS: usize = 1500;

/// Dimensions that can be fitted: damping, coupling, tip mass, gap.
pub(in crate::app) const FITTED: [Dimension; 4] =
    [Dimension::Viscosity, Dimension::Coupling, Dimension::TipMass, Dimension::MagnetDistance];
/// Most points that are fitted; of more some are left out evenly.
const MOST_FITTED: usize = 120;

/// What the first column is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(in crate::app) enum Domain {
    /// Seconds.
    #[default]
    Time,
    /// Hertz.
    Frequency,
}

/// How a file is to be read.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(in crate::app) struct Reading {
    /// Which columns, and their units.
    pub columns: Columns,
    /// What the first of them is.
    pub domain: Domain,
    /// By how many excitation periods the computed run is moved.
    pub shift: f64,
    /// Whether commas are decimal ones between others, where that had to be asked.
    pub decimal_commas: Option<bool>,
    /// Whether the column of the voltage is known, or was chosen.
    pub chosen: bool,
    /// Whether rows are put in the order of their times or frequencies.
    pub sorted: bool,
    /// Which of the [`FITTED`] are fitted.
    pub fitted: [bool; FITTED.len()],
}

/// A file.
pub(in crate::app) struct File {
    /// Its name.
    pub name: String,
    text: Vec<u8>,
    /// How it is written.
    pub layout: Layout,
    /// How it is read.
    pub reading: Reading,
    /// What has to be said before it is.
    pub ask: Option<Ask>,
    /// Under way.
    import: Option<Import>,
    /// Seconds or Hz, and volts; empty until all is read.
    pub points: Vec<[f64; 2]>,
    /// What is drawn of them.
    pub drawn: Vec<PlotPoint>,
    /// The point with the largest voltage.
    pub highest: Option<[f64; 2]>,
    /// Level of the record (V); of one over frequency without cycles, and about its mean as well.
    pub measures: Option<Level>,
    /// What is the matter with its times.
    pub clock: Clock,
    /// Rows left out, out of the instrument's range.
    pub over_range: usize,
    /// The accelerations, where they are what is wanted.
    pub recorded: Option<BaseRecording>,
}

/// The file in view, or why there is none.
pub(in crate::app) struct Measured {
    /// What is looked for in it: voltages, or accelerations.
    pub wanted: Kind,
    /// The file.
    pub file: Option<File>,
    /// What is wrong with it, or with one that was opened after it.
    pub error: Option<String>,
    /// The file before, until this one has been read.
    before: Option<File>,
}

impl Measured {
    /// No file yet; the quantity `wanted` of the next.
    pub(in crate::app) fn of(wanted: Kind) -> Self {
        Self { wanted, file: None, error: None, before: None }
    }

    /// Opens a file and begins to read its first two columns; the file before stays when nothing can be made of it.
    pub(in crate::app) fn open(&mut self, name: &str, text: Vec<u8>) {
        self.error = None;
        let text = decode(&text).into_owned();
        match detect(&text) {
            Err(error) => self.error = Some(format!("{name}: {}", say(&error))),
            Ok(layout) => {
                let (reading, ask) = begin(&layout, self.wanted);
                if self.wanted == Kind::Acceleration && reading.domain == Domain::Frequency {
                    let why = say(&said("its first column is a frequency, and a recording needs times", &[]));
                    self.error = Some(format!("{name}: {why}"));
                    return;
                }
                self.before = self.file.take().filter(|file| file.measures.is_some()).or(self.before.take());
                self.file = Some(File {
                    name: name.to_owned(),
                    text,
                    layout,
                    reading,
                    ask,
                    import: None,
                    points: Vec::new(),
                    drawn: Vec::new(),
                    highest: None,
                    measures: None,
                    clock: Clock::default(),
                    over_range: 0,
                    recorded: None,
                });
                if ask.is_none() {
                    self.read(reading);
                }
            }
        }
    }

    /// Reads the file anew.
    pub(in crate::app) fn read(&mut self, reading: Reading) {
        let Some(file) = &mut self.file else { return };
        let as_before = |part: fn(&Reading) -> (Columns, bool)| part(&file.reading) == part(&reading);
        let same = as_before(|reading| (reading.columns, reading.sorted)) && !file.points.is_empty();
        if reading.decimal_commas != file.reading.decimal_commas {
            // Other columns than before: what they are is looked at anew.
            match detect_with(&file.text, reading.decimal_commas) {
                Ok(layout) => {
                    let (begun, ask) = begin(&layout, self.wanted);
                    file.layout = layout;
                    file.reading = Reading { decimal_commas: reading.decimal_commas, ..begun };
                    file.ask = ask;
                }
                Err(error) => return self.fail(&error),
            }
        } else {
            file.reading = reading;
            if reading.chosen && file.ask == Some(Ask::Column) {
                file.ask = None;
            } else if same {
                return;
            }
        }
        self.error = None;
        (file.points, file.drawn, file.measures, file.recorded) = (Vec::new(), Vec::new(), None, None);
        if file.ask.is_some() {
            return;
        }
        let reading = file.reading;
        match Import::new(file.text.clone(), file.layout.clone(), reading.columns) {
            Ok(import) => file.import = Some(import),
            Err(error) => self.fail(&error),
        }
    }

    /// Goes on reading for a frame's share; whether there is more to read.
    pub(in crate::app) fn work(&mut self) -> bool {
        let Some(file) = &mut self.file else { return false };
        let Some(import) = &mut file.import else { return false };
        let start = milliseconds();
        while milliseconds() - start < BUDGET_MS {
            match import.advance(ROWS) {
                Ok(false) => {}
                Ok(true) => {
                    file.finish();
                    if self.wanted == Kind::Acceleration {
                        match BaseRecording::of(&file.name, &file.points) {
                            Ok(recorded) => file.recorded = Some(recorded),
                            // Rows in disorder can be sorted: the file stays in view.
                            Err(error) if file.clock.is_unsorted() => {
                                self.error = Some(format!("{}: {}", file.name, say(&error)));
                            }
                            Err(error) => {
                                self.fail(&error);
                                return true;
                            }
                        }
                    }
                    self.before = None;
                    return true;
                }
                Err(error) => {
                    self.fail(&error);
                    return true;
                }
            }
        }
        true
    }

    /// Read part of the file, 0 to 1, while it is being read.
    pub(in crate::app) fn progress(&self) -> Option<f64> {
        Some(self.file.as_ref()?.import.as_ref()?.progress())
    }

    fn fail(&mut self, error: &dyn Say) {
        if let Some(file) = &mut self.file {
            file.import = None;
            self.error = Some(format!("{}: {}", file.name, say(error)));
        }
        if let Some(before) = self.before.take() {
            self.file = Some(before);
        }
    }
}

impl File {
    /// Lowest and highest frequency (Hz) of a file over frequency, once it is read.
    pub(in crate::app) fn frequencies(&self) -> Option<(f64, f64)> {
        let of_frequency = self.reading.domain == Domain::Frequency && self.measures.is_some();
        let (low, high) = extent(&self.points).filter(|_| of_frequency)?;
        (FREQUENCIES.0 <= low && low < high && high <= FREQUENCIES.1).then_some((low, high))
    }

    fn finish(&mut self) {
        let Some(import) = self.import.take() else { return };
        self.over_range = import.over_range();
        self.points = import.into_points();
        self.clock = Clock::of(&self.points);
        if self.reading.sorted {
            self.points = sorted(std::mem::take(&mut self.points));
        }
        let Some(range) = extent(&self.points) else { return };
        let mut thinner = Thinner::new(range, BUCKETS);
        thinner.add(&self.points);
        self.drawn = thinner.points().iter().map(|[x, y]| PlotPoint::new(*x, *y)).collect();
        self.highest = self.points.iter().copied().max_by(|a, b| a[1].total_cmp(&b[1]));
        // Times that go back have no cycles.
        let by_rows =
            || self.points.iter().enumerate().map(|(i, point)| [i as f64, point[1]]).collect::<Vec<_>>();
        self.measures = Level::of(&self.points)
            .or_else(|| Level::of(&by_rows()).map(|level| Level { cycles: 0, ..level }))
            .or_else(|| {
                self.points.first().map(|point| Level { mean: point[1], rms: 0.0, peak: 0.0, cycles: 0 })
            });
    }
}

/// The fit of the device in view to a file of voltages over frequency.
pub(in crate::app) fn fit(file: &File, view: &View) -> (Scenario, Fit) {
    let ticked = FITTED.iter().zip(file.reading.fitted).filter(|(_, ticked)| *ticked);
    let every = file.points.len().div_ceil(MOST_FITTED).max(1);
    let fit = Fit {
        data: file.points.iter().step_by(every).copied().collect(),
        free: ticked.map(|(dimension, _)| dimension.field().to_owned()).collect(),
        hold: shaking(view),
    };
    (view.scenario.forgetting(&[Forgotten::Start, Forgotten::Duration]), fit)
}

/// How a file of this layout is read at first, and what has to be asked before.
fn begin(layout: &Layout, wanted: Kind) -> (Reading, Option<Ask>) {
    let choice = layout.choose(wanted);
    let domain = if choice.x == Kind::Frequency { Domain::Frequency } else { Domain::Time };
    let chosen = choice.ask.is_none();
    let fitted = [true, false, false, false];
    (Reading { columns: choice.columns, domain, chosen, fitted, ..Reading::default() }, choice.ask)
}

/// The end of a run as the text of a file, such as an instrument writes: time (s) and voltage (V).
pub(in crate::app) fn record(shown: &Shown) -> String {
    let unit = shown.scenario.units().time;
    let end = shown.run.trajectory.end_time();
    let span = (RECORDED * TAU / shown.scenario.parameters.omega).min(end);
    let rows = RECORDED as usize * ROWS_PER_PERIOD + 1;
    let mut text = "time [s],voltage [V]\n".to_owned();
    let voltage = shown.run.system.dimension() - 1;
    shown.run.trajectory.sample(end - span, end, rows, |time, state| {
        text += &format!("{},{}\n", time * unit, state[voltage]);
    });
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_long_file_is_read_in_slices_and_a_bad_line_is_named() {
        let rows = (0..60_000).map(|i| format!("{},{}\n", f64::from(i) * 0.1, (f64::from(i) * 0.01).sin()));
        let text = format!("time [ms],voltage [mV]\n{}", rows.collect::<String>());
        let mut measured = Measured::of(Kind::Voltage);
        measured.open("run.csv", text.into_bytes());
        let mut slices = 0;
        while measured.work() {
            slices += 1;
        }
        let file = measured.file.as_ref().expect("a file");
        assert!(slices > 1 && file.points.len() == 60_000 && file.drawn.len() <= 2 * BUCKETS);
        assert!((file.points[10][0] - 1e-3).abs() < 1e-12 && file.reading.domain == Domain::Time);
        assert!(file.measures.is_some_and(|level| (level.rms - 0.707e-3).abs() < 2e-6 && level.cycles > 90));
        measured.open("bad.csv", b"frequency,voltage\n1,2\n2,3\n3,x\n".to_vec());
        while measured.work() {}
        assert!(
            measured.error.as_ref().is_some_and(|error| error.contains("line 4")),
            "{:?}",
            measured.error
        );
        // The good one stays.
        let rows = |measured: &Measured| measured.file.as_ref().map(|file| file.points.len());
        assert_eq!(rows(&measured), Some(60_000));
        for (name, bytes) in [
            ("empty.csv", &b""[..]),
            ("one.csv", b"t,v\n0,1\n1,2\n2,3\n3,NaN\n4,5\n"),
            ("old.csv", b"\xff\xfex\0,\x002\0\n\0"),
            ("sound.csv", b"RIFF\x24\0\0\0WAVE\n1,2\n"),
        ] {
            measured.open(name, bytes.to_vec());
            while measured.work() {}
            assert!(measured.error.as_ref().is_some_and(|error| error.starts_with(name)), "{name}");
            assert_eq!(rows(&measured), Some(60_000), "{name}");
        }
        // What nobody can know is asked, and nothing is read before.
        measured.open("two.csv", b"0,1.5,2\n1,2,3\n2,5,3\n".to_vec());
        assert!(!measured.work());
        let file = measured.file.as_ref().expect("a file");
        assert_eq!((file.ask, file.points.len()), (Some(Ask::Column), 0));
        let columns = Columns { y: 2, ..file.reading.columns };
        // Another unit of the times is no answer to the question.
        let reading = file.reading;
        measured.read(Reading { columns: Columns { x_unit: 1e-3, ..reading.columns }, ..reading });
        assert!(!measured.work());
        measured.read(Reading { columns, chosen: true, ..reading });
        while measured.work() {}
        assert_eq!(measured.file.as_ref().map(|file| file.points[1]), Some([1.0, 3.0]));
        measured.open("commas.csv", b"0,5,1,5\n2,5,2,5\n1,5,3,5\n".to_vec());
        let reading = measured.file.as_ref().map(|file| file.reading).expect("a file");
        measured.read(Reading { decimal_commas: Some(true), ..reading });
        while measured.work() {}
        let file = measured.file.as_ref().expect("a file");
        assert_eq!((file.points[1], file.clock.decreases), ([2.5, 2.5], Some(2)));
        measured.read(Reading { sorted: true, ..file.reading });
        while measured.work() {}
        assert_eq!(measured.file.as_ref().map(|file| file.points[1]), Some([1.5, 3.5]));
        let mut measured = Measured::of(Kind::Voltage);
        measured.open("first.csv", b"frequency,voltage\n1,2\n2,3\n3,x\n".to_vec());
        while measured.work() {}
        assert_eq!(measured.file.as_ref().map(|file| file.reading.domain), Some(Domain::Frequency));
        assert!(measured.error.is_some());
    }
}
