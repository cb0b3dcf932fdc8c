//! Drawings, tables and programs that leave the page, read back as their readers would.

use std::path::Path;
use std::process::Command;

use harvester_lab::export::figure::{Anchor, Cells, Key};
use harvester_lab::export::{Axis, Figure, Layer, Pen, Provenance, snippet, svg, table};
use harvester_lab::scenario::Scenario;

/// The program as it is copied.
mod verdict {
    include!("export/verdict.rs");

    pub(super) fn run() -> Result<(), String> {
        main()
    }
}

const REQUEST: &str = r#"{"task":"verdict",
 "parameters":{"alpha":1e-4,"beta":0.01,"omega":8.0969},
 "t_end":300}"#;

fn curve(name: &str, pen: Pen, points: Vec<[f64; 2]>) -> Layer {
    Layer::Curve { name: name.to_owned(), key: name.to_owned(), colour: [11, 109, 201, 255], pen, points }
}

/// A plot over 0..10 and 1e-3..1e1, the latter logarithmic.
fn figure() -> Figure {
    let points =
        vec![[0.0, -3.0], [5.0, -1.0], [f64::NAN, 0.0], [6.0, f64::NEG_INFINITY], [8.0, 0.0], [10.0, 1.0]];
    Figure {
        title: "Voltage & rate <of change> \"today\"".to_owned(),
        axes: Some([Axis::new("time", "t"), Axis::new("voltage", "v").unit("V").logarithmic()]),
        ranges: [(0.0, 10.0), (-3.0, 1.0)],
        aspect: 0.5,
        equal_scale: false,
        layers: vec![
            curve("a < b & c", Pen::Line(2.0), points),
            curve("dots", Pen::Points(2.0), vec![[2.5, 0.0]]),
            Layer::Text {
                text: "x < y & z".to_owned(),
                colour: [0, 0, 0, 255],
                place: [5.0, 0.0],
                anchor: Anchor::Middle,
            },
            Layer::Picture {
                size: (2, 1),
                pixels: vec![[255, 0, 0, 255], [0, 0, 255, 128]],
                place: [(0.0, 10.0), (-3.0, 1.0)],
                opacity: 1.0,
            },
        ],
        keys: vec![Key::Swatch([1, 2, 3, 255], "torus".to_owned())],
        cells: Vec::new(),
    }
}

fn provenance() -> Provenance {
    let mut scenario = Scenario::default();
    scenario.parameters.beta = 0.1 + 0.2 - 0.25;
    let link = "https://example.org/#v=1".to_owned();
    Provenance { scenario, steps: Some(7), notes: Vec::new(), link }
}

/// The numbers of a path, pair by pair, from its moves and lines; one list a move.
fn runs(path: &str) -> Vec<Vec<[f64; 2]>> {
    let moves = path.split('M').filter(|run| !run.is_empty());
    let pair = |text: &str| {
        let mut numbers =
            text.trim_end_matches("h0").split(' ').map(|number| number.parse::<f64>().expect("a number"));
        [numbers.next().expect("x"), numbers.next().expect("y")]
    };
    moves.map(|run| run.split('L').map(pair).collect()).collect()
}

#[test]
fn names_of_points_end_within_the_plot() {
    let special = |name: &str, x: f64| Layer::Special { name: name.to_owned(), place: [x, 0.0] };
    let layers = vec![special("generalized period doubling", 0.5), special("fold", 9.9)];
    let (text, _) = svg::drawing(&[Figure { layers, ..figure() }], &[]);
    let document = roxmltree::Document::parse(&text).expect("well-formed");
    let anchor = |name: &str| {
        let node = document.descendants().find(|node| node.is_element() && node.text() == Some(name));
        node.and_then(|node| node.attribute("text-anchor"))
    };
    assert_eq!(anchor("generalized period doubling"), Some("start"));
    assert_eq!(anchor("fold"), Some("end"));
}

#[test]
fn points_are_where_the_axes_say_and_gaps_break_lines() {
    let (text, [width, height]) = svg::drawing(&[figure()], &["a caption & more".to_owned()]);
    let document = roxmltree::Document::parse(&text).expect("well-formed");
    let root = document.root_element();
    assert_eq!(root.attribute("viewBox"), Some(format!("0 0 {width} {height}").as_str()));
    let clip = document.descendants().find(|node| node.has_tag_name("clipPath")).expect("a clip");
    let frame = clip.first_element_child().expect("a rectangle");
    let side =
        |name: &str| frame.attribute(name).and_then(|text| text.parse::<f64>().ok()).expect("a number");
    let (left, top, across, down) = (side("x"), side("y"), side("width"), side("height"));
    let group = document.descendants().find(|node| node.attribute("clip-path").is_some()).expect("a group");
    let paths: Vec<&str> = group.children().filter_map(|node| node.attribute("d")).collect();
    let at = |x: f64, y: f64| [left + across * x, top + down * (1.0 - y)];
    let wanted = [vec![at(0.0, 0.0), at(0.5, 0.5)], vec![at(0.8, 0.75), at(1.0, 1.0)]];
    let found = runs(paths[0]);
    assert_eq!(found.len(), wanted.len(), "{paths:?}");
    for (a, b) in found.iter().flatten().zip(wanted.iter().flatten()) {
        assert!((a[0] - b[0]).abs() < 0.006 && (a[1] - b[1]).abs() < 0.006, "{a:?} {b:?}");
    }
    let dot = runs(paths[1])[0][0];
    assert!((dot[0] - at(0.25, 0.75)[0]).abs() < 0.006, "{dot:?}");
    let texts: Vec<&str> = document.descendants().filter_map(|node| node.text()).collect();
    for words in
        ["Voltage & rate <of change> \"today\"", "a < b & c", "x < y & z", "torus", "time t", "voltage v [V]"]
    {
        assert!(texts.contains(&words), "{words} in {texts:?}");
    }
    for label in ["0", "2", "10", "10⁻²", "10⁰"] {
        assert!(texts.contains(&label), "{label} in {texts:?}");
    }
    // The label of a decade stands at its decade.
    let tick =
        document.descendants().find(|node| node.is_element() && node.text() == Some("10⁰")).expect("a tick");
    let y: f64 = tick.attribute("y").and_then(|text| text.parse().ok()).expect("a place");
    assert!((y - 4.0 - at(0.0, 0.75)[1]).abs() < 0.006);
    let picture = document.descendants().find(|node| node.has_tag_name("image")).expect("a picture");
    assert!(picture.attribute("href").is_some_and(|text| text.starts_with("data:image/png;base64,")));
}

#[test]
fn a_table_reads_back_digit_by_digit() {
    let mut plot = figure();
    let third = 1.0 / 3.0;
    plot.axes = Some([Axis::new("time", "t"), Axis::new("voltage", "v").unit("V")]);
    plot.layers =
        vec![curve("one, \"two\"", Pen::Line(1.0), vec![[third, 1e-7], [f64::NAN, 2.0], [-1e300, 0.1]])];
    plot.cells = vec![Cells {
        name: "power [W]".to_owned(),
        size: (2, 2),
        ranges: [(1.0, 3.0), (-1.0, 1.0)],
        values: vec!["1".to_owned(), String::new(), "3".to_owned(), "period 2".to_owned()],
    }];
    let text = table::table(&[plot], &provenance());
    let headers: Vec<&str> = text.lines().take_while(|line| line.starts_with("# ")).collect();
    for wanted in [
        "# plot: Voltage & rate <of change> \"today\"",
        concat!("# program: Harvester Lab ", env!("CARGO_PKG_VERSION")),
        "# beta: 0.050000000000000044",
        "# link: https://example.org/#v=1",
    ] {
        assert!(headers.contains(&wanted), "{wanted} in {headers:#?}");
    }
    let mut reader = csv::ReaderBuilder::new().comment(Some(b'#')).from_reader(text.as_bytes());
    let names = reader.headers().expect("a header").clone();
    assert_eq!(names.iter().collect::<Vec<_>>(), ["series", "time t", "voltage v [V]", "value"]);
    let rows: Vec<csv::StringRecord> =
        reader.records().collect::<Result<_, _>>().expect("rows of one length");
    assert_eq!(&rows[0][0], "one, \"two\"");
    assert_eq!(rows[0][1].parse(), Ok(third));
    assert_eq!(rows[0][2].parse(), Ok(1e-7));
    assert_eq!((&rows[1][1], &rows[1][2]), ("", "2"));
    assert_eq!(rows[2][1].parse(), Ok(-1e300));
    assert_eq!(rows[4].iter().collect::<Vec<_>>(), ["power [W]", "3", "-1", ""]);
    assert_eq!(rows[6].iter().collect::<Vec<_>>(), ["power [W]", "3", "1", "period 2"]);
    assert_eq!(rows.len(), 7);
}

#[test]
fn logarithms_leave_no_trace_in_a_table() {
    let mut plot = figure();
    let values = [1e-3, 0.007, 123.456];
    let points = values.iter().map(|value: &f64| [1.0, value.log10()]).collect();
    plot.layers = vec![curve("one", Pen::Line(1.0), points)];
    let text = table::table(&[plot], &provenance());
    let last = |line: &str| line.rsplit(',').next().map(str::to_owned);
    let found: Vec<String> = text.lines().filter(|line| line.starts_with("one,")).filter_map(last).collect();
    assert_eq!(found, ["0.001", "0.007", "123.456"]);
}

#[test]
fn the_program_in_rust_is_the_one_that_compiles_here_and_it_runs() {
    assert_eq!(snippet::rust(REQUEST), include_str!("export/verdict.rs"));
    assert_eq!(verdict::run(), Ok(()));
    assert!(snippet::rust("{\"a\":\"#\"}").contains("r##\""), "the text ends where it should");
}

#[test]
fn the_program_in_python_gets_the_answer() {
    let python = Command::new("python3").arg("--version").output();
    if !python.is_ok_and(|found| found.status.success()) {
        println!("no python3 here");
        return;
    }
    let command = Path::new(env!("CARGO_BIN_EXE_harvester"));
    let folder = command.parent().expect("a folder");
    let path = format!("{}:{}", folder.display(), std::env::var("PATH").unwrap_or_default());
    let run = Command::new("python3").args(["-c", &snippet::python(REQUEST)]).env("PATH", path).output();
    let run = run.expect("python3 runs");
    assert!(run.status.success(), "{}", String::from_utf8_lossy(&run.stderr));
    let answer: serde_json::Value = serde_json::from_slice(&run.stdout).expect("JSON");
    assert!(answer["sentence"].as_str().is_some_and(|text| text.starts_with("period 2")), "{answer}");
}
