//! Measured data of many kinds, good and bad.

use std::fmt::Write as _;
use std::time::Instant;

use harvester_lab::questions::design::measured::{Columns, Import, MeasuredError, detect, look};
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
        message("t,U\n0,1\n1,2\n2,overload\n3,4\n"),
        "line 4, column 2: \"overload\" is not a finite number"
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
    assert_eq!(message(b"\xff\xfe0\0,\x001\0"), "it is UTF-16 text: save it as UTF-8");
    assert_eq!(message(b"0,1\n\0\0\0"), "it is no text: byte 5 is no character of one");
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
