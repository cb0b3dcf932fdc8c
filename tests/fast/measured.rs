//! Measured data of many kinds, good and bad.

use std::fmt::Write as _;
use std::time::Instant;

use harvester_lab::questions::design::measured::{
    Ask, Choice, Columns, Import, Kind, Layout, MeasuredError, decode, detect, detect_with, look,
};
use harvester_lab::questions::design::record::Clock;
use harvester_lab::questions::design::thin::{Thinner, extent};

fn read(text: &str, columns: Columns) -> Result<Vec<[f64; 2]>, MeasuredError> {
    let layout = detect(text.as_bytes())?;
    let mut import = Import::new(text.as_bytes().to_vec(), layout, columns)?;
    while !import.advance(100)? {}
    Ok(import.into_points())
}

#[test]
fn delimiters_headers_preambles_and_decimal_commas_are_found() {
    let expected = [[0.0, 1.5], [0.001, -2.5], [0.002, 3e-1]];
    for text in [
        "0,1.5\n0.001,-2.5\n0.002,3e-1\n",
        "time (s),voltage (V)\n0,1.5\n0.001,-2.5\n0.002,3e-1",
        "\u{feff}t;U\r\n0;1,5\r\n0,001;-2,5\r\n0,002;3e-1\r\n",
        "# a comment\n# t U\n0 1.5\n0.001   -2.5\n\n0.002 3e-1\n",
        "Model,DS1054\nRecord Length,3\nSource,CH1\nTIME,CH1\n0,1.5\n0.001,-2.5\n0.002,3e-1\n",
        "\"t\"\t\"U\"\n\"0\"\t\"1.5\"\n0.001\t-2.5\n0.002\t3e-1\n",
    ] {
        assert_eq!(read(text, Columns::default()), Ok(expected.to_vec()), "{text}");
    }
    let layout = detect(b"Model,X\ntime, voltage\n0,1\n1,2\n").expect("a table");
    assert_eq!(layout.header.as_deref(), Some(&["time".to_owned(), "voltage".to_owned()][..]));
    assert_eq!((layout.preamble, layout.columns, layout.delimiter), (2, 2, b','));
}

#[test]
fn columns_and_units_are_chosen() {
    let text = "n,f (kHz),U (mV)\n1,0.01,250\n2,0.02,-500\n";
    let columns = Columns { x: 1, x_unit: 1e3, y: 2, y_unit: 1e-3 };
    assert_eq!(read(text, columns), Ok(vec![[10.0, 0.25], [20.0, -0.5]]));
    let message = |columns| read(text, columns).expect_err("no such column").to_string();
    assert_eq!(message(Columns { y: 3, ..columns }), "y = 3 is not available: allowed are 0 to 2");
    assert!(message(Columns { y_unit: 0.0, ..columns }).starts_with("y_unit = 0 is not available"));
}

#[test]
fn bad_files_are_explained_by_line_and_content() {
    let message = |text: &str| read(text, Columns::default()).expect_err("bad").to_string();
    assert_eq!(message(""), "the file is empty");
    assert_eq!(message("\n\n"), "the file is empty");
    assert_eq!(
        message("hello\nworld\n"),
        "no row with at least two numbers in the first 3 lines; line 1 is \"hello\""
    );
    assert_eq!(
        message("t,U\n0,1\n1,2\n2,broken\n3,4\n"),
        "line 4, column 2: \"broken\" is not a finite number"
    );
    assert_eq!(message("0,1\n1,2\n2,NaN\n"), "line 3, column 2: \"NaN\" is not a finite number");
    assert_eq!(message("# x\n0,1\n1,2\n\n2\n"), "line 5 has 1 fields, column 2 is missing: \"2\"");
    let bytes = b"0,1\n1,2\n2,\xff\xfe\n".to_vec();
    let layout = detect(&bytes).expect("two rows");
    let mut import = Import::new(bytes, layout, Columns::default()).expect("columns");
    assert!(import.advance(10).expect_err("no text").to_string().starts_with("line 3, column 2"));
}

#[test]
fn a_million_rows_are_read_and_thinned_in_slices_in_well_under_a_second() {
    let mut text = String::with_capacity(24_000_000);
    text.push_str("time,voltage\n");
    for i in 0..1_000_000 {
        let t = f64::from(i) * 1e-4;
        writeln!(text, "{t:.4},{:.6}", 20.0 * (6.0 * t).sin()).expect("a string grows");
    }
    let bytes = text.into_bytes();
    let begin = Instant::now();
    let layout = detect(&bytes).expect("a table");
    let mut import = Import::new(bytes, layout, Columns::default()).expect("columns");
    let mut slices = 0;
    let mut longest = 0.0_f64;
    loop {
        let slice = Instant::now();
        let done = import.advance(20_000).expect("numbers");
        longest = longest.max(slice.elapsed().as_secs_f64());
        slices += 1;
        if done {
            break;
        }
        assert!(import.progress() <= 1.0);
    }
    let read = begin.elapsed().as_secs_f64();
    let points = import.points();
    assert_eq!((points.len(), slices), (1_000_000, 51));
    let mut thinner = Thinner::new(extent(points).expect("points"), 1000);
    points.chunks(50_000).for_each(|slice| thinner.add(slice));
    let kept = thinner.points();
    let whole = begin.elapsed().as_secs_f64();
    println!("read {read:.3} s, longest slice {longest:.3} s, with thinning {whole:.3} s");
    assert!(kept.len() <= 2000);
    let highest = kept.iter().map(|point| point[1]).fold(f64::MIN, f64::max);
    assert!((highest - 20.0).abs() < 1e-5);
    // Generous: several builds may share the machine.
    assert!(whole < 3.0, "{whole}");
}

#[test]
fn what_is_no_table_of_text_is_refused_before_it_is_read() {
    let message = |bytes: &[u8]| detect(bytes).expect_err("no table").to_string();
    assert_eq!(message(b"0,1\n\0\0\0"), "it is not text: byte 5 belongs to no character");
    let mut long = vec![b'1'; 50 << 20];
    let begin = Instant::now();
    assert_eq!(message(&long), "line 1 is longer than 65536 characters");
    assert!(begin.elapsed().as_millis() < 50);
    long.splice(..0, *b"0,1\r\n1,2\r\n");
    assert_eq!(message(&long), "line 3 is longer than 65536 characters");
    assert_eq!(
        look(b"0,1\n", 65 << 20).map_err(|error| error.to_string()),
        Err("it is larger than 64 MB".into())
    );
    // What tools write besides: a mark at the end of the file, a mark of the byte order.
    assert!(detect(b"\xef\xbb\xbf0,1\n1,2\n\x1a").is_ok());
    let numbers = read("\u{feff}0,1\n1,2\n", Columns::default());
    assert_eq!(numbers, Ok(vec![[0.0, 1.0], [1.0, 2.0]]));
}

/// Reads a file as the page does, without anything to be asked.
fn opened(bytes: &[u8]) -> (Layout, Choice, Vec<[f64; 2]>, usize) {
    let text = decode(bytes);
    let layout = detect(&text).expect("a table");
    let choice = layout.choose(Kind::Voltage);
    assert_eq!(choice.ask, None, "{layout:?}");
    let mut import = Import::new(text.to_vec(), layout.clone(), choice.columns).expect("columns");
    while !import.advance(100).expect("numbers") {}
    let over = import.over_range();
    (layout, choice, import.into_points(), over)
}

fn asked(text: &str) -> Option<Ask> {
    detect(text.as_bytes()).expect("a table").choose(Kind::Voltage).ask
}

fn close(points: &[[f64; 2]], expected: &[[f64; 2]]) -> bool {
    points.len() == expected.len()
        && points.iter().flatten().zip(expected.iter().flatten()).all(|(a, b)| (a - b).abs() <= 1e-12)
}

#[test]
fn times_come_from_the_head_where_the_rows_have_none() {
    // Rigol DS1000Z.
    let rigol = "X,CH1,Start,Increment,\nSequence,Volt,-3.000000e-02,5.000000e-05\n0,1.2e-01,,\n1,-1.3e-01,,\n3,0.5,,\n";
    let (layout, choice, points, _) = opened(rigol.as_bytes());
    assert!(close(&points, &[[-0.03, 0.12], [-0.02995, -0.13], [-0.02985, 0.5]]), "{points:?}");
    assert_eq!((choice.x, choice.columns.y), (Kind::Time, 1));
    assert_eq!(layout.header.as_ref().map(|names| names[1].as_str()), Some("CH1 (Volt)"));
    // Two channels: which of them is the harvester, nobody knows.
    let two = "X,CH1,CH2,Start,Increment,\nSequence,Volt,Volt,-3.0e-02,5.0e-05\n0,1,2,,\n1,2,3,,\n";
    assert_eq!(asked(two), Some(Ask::Column));
    // Its newer models.
    let newer = "CH1(V),t0 = -6.0e-03s, tInc = 1e-06s,\n0.5,,,\n0.25,,,\n";
    let (_, _, points, _) = opened(newer.as_bytes());
    assert!(close(&points, &[[-6e-3, 0.5], [-5.999e-3, 0.25]]), "{points:?}");
    // LabVIEW, with a decimal comma besides.
    let head = "LabVIEW Measurement\t\r\nWriter_Version\t2\r\nSeparator\tTab\r\nDecimal_Separator\t,\r\n\
                Multi_Headings\tNo\r\nX_Columns\tNo\r\n***End_of_Header***\t\r\n\t\r\nChannels\t1\t\r\n\
                Samples\t3\t\r\nX0\t0,5E+0\t\r\nDelta_X\t0,001000\t\r\n***End_of_Header***\t\r\n\
                X_Value\tVoltage\tComment\r\n\t0,123\r\n\t-0,25\r\n\t0,5\r\n";
    let (_, _, points, _) = opened(head.as_bytes());
    assert!(close(&points, &[[0.5, 0.123], [0.501, -0.25], [0.502, 0.5]]), "{points:?}");
    // With times in the rows these count.
    let with = head.replace("X_Columns\tNo", "X_Columns\tOne").replace("\n\t0,123", "\n1,0\t0,123");
    let with = with.replace("\n\t-0,25", "\n1,1\t-0,25").replace("\n\t0,5\r", "\n1,2\t0,5\r");
    let (_, _, points, _) = opened(with.as_bytes());
    assert!(close(&points, &[[1.0, 0.123], [1.1, -0.25], [1.2, 0.5]]), "{points:?}");
}

#[test]
fn comments_name_columns_and_empty_columns_stand_before_them() {
    let comsol = "% Model:              beam.mph\n% Version:            COMSOL 5.5\n% Expressions:        1\n\
                  % freq (kHz)             Terminal voltage (mV)\n0.04                 120.5\n0.05                 99\n";
    let (layout, choice, points, _) = opened(comsol.as_bytes());
    assert!(close(&points, &[[40.0, 0.1205], [50.0, 0.099]]), "{points:?}");
    assert_eq!((layout.comment, choice.x), (b'%', Kind::Frequency));
    let within = "# t, V\n0,1\n1,2\n# a break\n2,3\n";
    assert_eq!(opened(within.as_bytes()).2.len(), 3);
    // Tektronix: words beside the first rows, then empty columns.
    let tektronix = "Record Length,2.5e+03,,-0.005,0.012,\nSample Interval,4e-06,,-0.004996,0.008,\n\
                     Trigger Point,1.25e+03,,-0.004992,0.012,\n,,,-0.004988,0.008,\n,,,-0.004984,0.004,\n";
    let (layout, choice, points, _) = opened(tektronix.as_bytes());
    assert_eq!((layout.preamble, choice.columns.x, choice.columns.y), (0, 3, 4));
    assert!(close(&points[..2], &[[-0.005, 0.012], [-0.004996, 0.008]]) && points.len() == 5, "{points:?}");
}

#[test]
fn commas_that_may_be_either_are_asked_about() {
    let text = "0,000,1,50\n0,001,2,25\n0,002,0,75\n";
    assert_eq!(asked(text), Some(Ask::Commas));
    let layout = detect(text.as_bytes()).expect("a table");
    let refused = Import::new(text.into(), layout, Columns::default()).expect_err("commas");
    assert_eq!(refused, MeasuredError::Commas);
    let read = |decimal: bool, columns: Columns| {
        let layout = detect_with(text.as_bytes(), Some(decimal)).expect("a table");
        let mut import = Import::new(text.into(), layout, columns).expect("columns");
        while !import.advance(100).expect("numbers") {}
        import.into_points()
    };
    assert!(close(&read(true, Columns::default()), &[[0.0, 1.5], [0.001, 2.25], [0.002, 0.75]]));
    let last = Columns { x: 1, y: 3, ..Columns::default() };
    assert!(close(&read(false, last), &[[0.0, 50.0], [1.0, 25.0], [2.0, 75.0]]));
    // A decimal point anywhere, or names for every field, leave no doubt.
    assert_eq!(asked("0,0,1.5,2\n1,1,2,3\n"), Some(Ask::Column));
    assert_eq!(asked("t,a (g),b,U (V)\n0,1,2,3\n1,2,3,4\n"), None);
}

#[test]
fn both_kinds_of_utf16_and_byte_order_marks_are_read() {
    let text = "t (s);U (V)\r\n0,5;1,25\r\n1,5;-2\r\n";
    let units: Vec<u16> = text.encode_utf16().collect();
    let little: Vec<u8> = units.iter().flat_map(|unit| unit.to_le_bytes()).collect();
    let big: Vec<u8> = units.iter().flat_map(|unit| unit.to_be_bytes()).collect();
    let marked = |mark: &[u8], bytes: &[u8]| [mark, bytes].concat();
    for bytes in [
        text.as_bytes().to_vec(),
        marked(b"\xef\xbb\xbf", text.as_bytes()),
        marked(b"\xff\xfe", &little),
        marked(b"\xfe\xff", &big),
        little,
        big,
    ] {
        let (layout, _, points, _) = opened(&bytes);
        assert!(close(&points, &[[0.5, 1.25], [1.5, -2.0]]), "{points:?}");
        assert_eq!(layout.header.expect("names")[0], "t (s)");
    }
}

#[test]
fn nothing_else_is_taken_for_a_voltage() {
    // Several values without names, one that is named as something else, two voltages: all are asked about.
    assert_eq!(asked("0,1.5,2\n1,2,3\n"), Some(Ask::Column));
    assert_eq!(asked("time,acceleration\n0,1.5\n1,2\n"), Some(Ask::Column));
    assert_eq!(asked("time,a (m/s^2)\n0,1.5\n1,2\n"), Some(Ask::Column));
    assert_eq!(asked("t,U1 (V),U2 (V)\n0,1.5,2\n1,2,3\n"), Some(Ask::Column));
    let (_, choice, points, _) = opened(b"n,acc [g],t [ms],output [mV]\n0,1,2,3\n1,2,4,6\n");
    assert_eq!((choice.columns.x, choice.columns.y), (2, 3));
    assert!(close(&points, &[[0.002, 0.003], [0.004, 0.006]]), "{points:?}");
    // The same reader finds an acceleration where one is wanted.
    let layout = detect(b"t [ms],U [V],acc [g]\n0,1,2\n1,2,4\n").expect("a table");
    let choice = layout.choose(Kind::Acceleration);
    assert_eq!((choice.columns.y, choice.columns.y_unit, choice.ask), (2, 9.80665, None));
    assert_eq!(layout.rows[1], ["1", "2", "4"]);
}

#[test]
fn marks_of_over_range_are_left_out_and_counted() {
    let text = b"t,U (V)\n0,1\n1,9.91E+37\n2,-9.9e37\n3,OL\n4,inf\n5,-Infinity\n6,1.#INF\n7,2\n";
    let (_, _, points, over) = opened(text);
    assert_eq!((points, over), (vec![[0.0, 1.0], [7.0, 2.0]], 6));
    // What is no number at all is still an error.
    assert!(read("0,1\n1,2\n2,NaN\n", Columns::default()).is_err());
}

#[test]
fn times_that_go_back_or_change_their_unit_are_told() {
    let (_, _, points, _) = opened(b"t,U (V)\n0,1\n2,2\n1,3\n1,4\n");
    let clock = Clock::of(&points);
    assert_eq!((clock.decreases, clock.repeats, clock.unit_changes), (Some(2), Some(3), None));
}
