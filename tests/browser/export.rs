//! Plots and the report as files, as a user saves them.

use std::path::Path;
use std::{env, fs};

use super::page::{Page, Theme, project};

const FIGURE_9: &str = r#"{"parameters":{"alpha":1e-4,"beta":0.01,"omega":8.0969}}"#;

fn press(page: &mut Page, label: &str) {
    let control = page.find(label, &["Button"]);
    page.click(control.at(0.5, 0.5));
}

/// Saves by pressing both buttons, and waits for the file.
fn saved(page: &mut Page, folder: &Path, [menu, button]: [&str; 2], name: &str) -> Vec<u8> {
    press(page, menu);
    press(page, button);
    let file = folder.join(name);
    // The browser gives it its name when it is whole.
    page.wait(name, |_| fs::read(&file).ok().filter(|bytes| !bytes.is_empty()))
}

#[test]
#[ignore = "needs the built page and Chromium: make test"]
fn a_plot_is_saved_as_drawing_picture_and_table_and_all_of_it_as_a_report() {
    let mut page = Page::open(1440, 900, Theme::Dark);
    let folder = env::temp_dir().join(format!("harvester-exports-{}", std::process::id()));
    fs::create_dir_all(&folder).expect("a folder");
    page.downloads_to(&folder);
    page.call("load", FIGURE_9).expect("a valid scenario");
    page.wait_until("the verdict", |state| state["status"] == "done" && !state["verdict"].is_null());

    let menu = "Export: Phase portrait";
    let drawing = saved(&mut page, &folder, [menu, "SVG"], "harvester-phase-portrait.svg");
    let drawing = String::from_utf8(drawing).expect("a text");
    let document = roxmltree::Document::parse(&drawing).expect("well-formed");
    let size = |name: &str| -> u32 {
        document.root_element().attribute(name).and_then(|text| text.parse().ok()).expect("a size")
    };
    let (width, height) = (size("width"), size("height"));
    assert!(document.descendants().any(|node| node.text() == Some("voltage v [V]")));

    let picture = saved(&mut page, &folder, [menu, "PNG"], "harvester-phase-portrait.png");
    assert!(picture.starts_with(b"\x89PNG\r\n\x1a\n"));
    let info = png::Decoder::new(std::io::Cursor::new(&picture)).read_info().expect("a PNG");
    assert_eq!(info.info().size(), (2 * width, 2 * height));
    assert!(super::colours(&picture) > 50, "the picture is nearly blank");
    fs::write(project().join("target/screenshots/export-phase-portrait.png"), &picture).expect("kept");

    let table = saved(&mut page, &folder, [menu, "CSV"], "harvester-phase-portrait.csv");
    let table = String::from_utf8(table).expect("a text");
    for part in ["# omega: 8.0969\n", "\nseries,voltage v [V],dv/dt [V]\n", "\ncomputed,"] {
        assert!(table.contains(part), "{part}");
    }
    // What lies behind a coloured chart is a table, too.
    let tab = page.find("Stability", &["Tab"]);
    page.click(tab.at(0.5, 0.5));
    page.wait_until("the charts", |state| state["progress"] == serde_json::json!([]));
    let chart =
        saved(&mut page, &folder, ["Export: Stability chart", "PNG"], "harvester-stability-chart.png");
    assert!(super::colours(&chart) > 20);
    fs::write(project().join("target/screenshots/export-stability-chart.png"), &chart).expect("kept");

    let report = saved(&mut page, &folder, ["Share: link", "Report"], "harvester-report.html");
    let report = String::from_utf8(report).expect("a text");
    for part in ["<h1>Period 2</h1>", "8.0969", "480 mm", "Poincaré map", "QR code of the link"] {
        assert!(report.contains(part), "{part}");
    }
    assert!(report.contains(&format!("{}#v=1&amp;alpha=1e-4", page.files.url())));
    page.screenshot("export-dark");
    fs::remove_dir_all(&folder).expect("the folder goes");
    page.close();
}

#[test]
#[ignore = "needs the built page and Chromium: make test"]
fn the_buttons_of_a_card_fit_a_phone() {
    let mut page = Page::open(360, 760, Theme::Light);
    page.wait_until("the run", |state| state["status"] == "done");
    press(&mut page, "Share: link");
    for label in ["Report", "Copy as Rust", "Copy as Python"] {
        let [left, top, right, bottom] = page.find(label, &["Button"]).bounds;
        assert!(left >= 0.0 && top >= 0.0 && right <= 360.0 && bottom <= 760.0, "{label} sticks out");
    }
    page.screenshot("share-programs-phone");
    page.close();
}
