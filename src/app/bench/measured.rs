//! A file of measured data: opened at once, read a slice a frame.

use std::f64::consts::TAU;

use egui_plot::PlotPoint;

use crate::app::clock::milliseconds;
use crate::app::session::Shown;
use crate::app::text::say;
use crate::questions::design::measured::{Columns, Import, Layout, MeasuredError, detect};
use crate::questions::design::thin::{Thinner, extent};

/// Time that a frame may spend on reading, and rows between looks at the clock.
const BUDGET_MS: f64 = 6.0;
const ROWS: usize = 500;
/// Excitation periods of a run that are taken as a record, and rows for each.
const RECORDED: f64 = 20.0;
const ROWS_PER_PERIOD: usize = 200;
/// Buckets of the curve that is drawn.
const BUCKETS: usize = 1500;

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
    /// Under way.
    import: Option<Import>,
    /// Seconds or Hz, and volts; empty until all is read.
    pub points: Vec<[f64; 2]>,
    /// What is drawn of them.
    pub drawn: Vec<PlotPoint>,
    /// The point with the largest voltage.
    pub highest: Option<[f64; 2]>,
    /// Root mean square and largest |v| (V) about the mean.
    pub measures: Option<(f64, f64)>,
}

/// The file in view, or why there is none.
#[derive(Default)]
pub(in crate::app) struct Measured {
    /// The file.
    pub file: Option<File>,
    /// What is wrong with it, or with one that was opened after it.
    pub error: Option<String>,
    /// The file before, until this one has been read.
    before: Option<File>,
}

impl Measured {
    /// Opens a file and begins to read its first two columns; the file before stays when nothing can be made of it.
    pub(in crate::app) fn open(&mut self, name: &str, text: Vec<u8>) {
        self.error = None;
        match detect(&text) {
            Err(error) => self.error = Some(format!("{name}: {}", say(&error))),
            Ok(layout) => {
                let domain = domain_of(&layout);
                let x_unit = unit_of(&layout, 0, &[("ms", 1e-3), ("us", 1e-6), ("µs", 1e-6), ("khz", 1e3)]);
                let y_unit = unit_of(&layout, 1, &[("mv", 1e-3), ("kv", 1e3)]);
                let columns = Columns { x_unit, y_unit, ..Columns::default() };
                let reading = Reading { columns, domain, ..Reading::default() };
                self.before = self.file.take().filter(|file| file.measures.is_some()).or(self.before.take());
                self.file = Some(File {
                    name: name.to_owned(),
                    text,
                    layout,
                    reading,
                    import: None,
                    points: Vec::new(),
                    drawn: Vec::new(),
                    highest: None,
                    measures: None,
                });
                self.read(reading);
            }
        }
    }

    /// Reads the file anew.
    pub(in crate::app) fn read(&mut self, reading: Reading) {
        let Some(file) = &mut self.file else { return };
        let same = file.reading.columns == reading.columns && !file.points.is_empty();
        file.reading = reading;
        if same {
            return;
        }
        self.error = None;
        (file.points, file.drawn, file.measures) = (Vec::new(), Vec::new(), None);
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

    fn fail(&mut self, error: &MeasuredError) {
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
    fn finish(&mut self) {
        let Some(import) = self.import.take() else { return };
        self.points = import.into_points();
        let Some(range) = extent(&self.points) else { return };
        let mut thinner = Thinner::new(range, BUCKETS);
        thinner.add(&self.points);
        self.drawn = thinner.points().iter().map(|[x, y]| PlotPoint::new(*x, *y)).collect();
        self.highest = self.points.iter().copied().max_by(|a, b| a[1].total_cmp(&b[1]));
        let count = self.points.len() as f64;
        let mean = self.points.iter().map(|point| point[1]).sum::<f64>() / count;
        let square = self.points.iter().map(|point| (point[1] - mean).powi(2)).sum::<f64>() / count;
        let peak = self.points.iter().map(|point| (point[1] - mean).abs()).fold(0.0, f64::max);
        self.measures = Some((square.sqrt(), peak));
    }
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

/// A header that speaks of frequency or hertz says what the first column is.
fn domain_of(layout: &Layout) -> Domain {
    let name = layout.header.as_ref().and_then(|names| names.first()).map(|name| name.to_lowercase());
    let says = |name: &String| name.contains("freq") || name.contains("hz") || name == "f";
    if name.as_ref().is_some_and(says) { Domain::Frequency } else { Domain::Time }
}

/// The unit that a header names in brackets.
fn unit_of(layout: &Layout, column: usize, units: &[(&str, f64)]) -> f64 {
    let name = layout.header.as_ref().and_then(|names| names.get(column)).map(|name| name.to_lowercase());
    let within = |name: &String, unit: &str| {
        name.split(|c: char| !(c.is_alphanumeric() || c == 'µ')).any(|word| word == unit)
    };
    let found = units.iter().find(|(unit, _)| name.as_ref().is_some_and(|name| within(name, unit)));
    found.map_or(1.0, |(_, factor)| *factor)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_long_file_is_read_in_slices_and_a_bad_line_is_named() {
        let rows = (0..60_000).map(|i| format!("{},{}\n", f64::from(i) * 0.1, (f64::from(i) * 0.01).sin()));
        let text = format!("time [ms],voltage [mV]\n{}", rows.collect::<String>());
        let mut measured = Measured::default();
        measured.open("run.csv", text.into_bytes());
        let mut slices = 0;
        while measured.work() {
            slices += 1;
        }
        let file = measured.file.as_ref().expect("a file");
        assert!(slices > 1 && file.points.len() == 60_000 && file.drawn.len() <= 2 * BUCKETS);
        assert!((file.points[10][0] - 1e-3).abs() < 1e-12 && file.reading.domain == Domain::Time);
        assert!(file.measures.is_some_and(|(rms, _)| (rms - 0.707e-3).abs() < 2e-5));
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
            ("old.csv", b"\xff\xfe1\0,\x002\0\n\0"),
            ("sound.csv", b"RIFF\x24\0\0\0WAVE\n1,2\n"),
        ] {
            measured.open(name, bytes.to_vec());
            while measured.work() {}
            assert!(measured.error.as_ref().is_some_and(|error| error.starts_with(name)), "{name}");
            assert_eq!(rows(&measured), Some(60_000), "{name}");
        }
        let mut measured = Measured::default();
        measured.open("first.csv", b"frequency,voltage\n1,2\n2,3\n3,x\n".to_vec());
        while measured.work() {}
        assert_eq!(measured.file.as_ref().map(|file| file.reading.domain), Some(Domain::Frequency));
        assert!(measured.error.is_some());
    }
}
