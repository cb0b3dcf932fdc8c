use super::*;
use crate::app::bench::Bench;
use crate::app::bench::variant::Change;
use crate::app::command::Command;
use crate::app::history::Hand;
use crate::app::map::{self, Boundaries};
use crate::app::rehearsal;
use crate::app::session::Session;
use crate::app::widgets::number::with_unit;

use crate::questions::chart::Quantity;
use crate::questions::solve;

/// The page of a link, everything computed, and drawn once.
fn page(link: &str, size: [f32; 2]) -> (App, Egui) {
    let context = Egui::default();
    let mut app = rehearsal::app(&context, None);
    app.set_address("https://example.org/lab/".to_owned());
    app.open_link(link);
    for frame in 0..20_000 {
        app.logic(&context);
        let busy = app.session.status() != Status::Done || app.crew.borrow_mut().is_busy();
        if frame > 3 && !busy {
            break;
        }
        app.follow();
    }
    assert_eq!(app.session.status(), Status::Done);
    for _ in 0..3 {
        let screen_rect = Some(Rect::from_min_size(egui::Pos2::ZERO, size.into()));
        let input = RawInput { screen_rect, ..RawInput::default() };
        context.run_ui(input, |ui| app.ui(ui)).drop_without_applying_deltas();
    }
    (app, context)
}

/// What is saved of the card.
fn saved(app: &mut App, context: &Egui, title: &str, format: Format) -> (String, String) {
    app.export(context, title, format);
    match app.take_errands().pop() {
        Some(Errand::Save(name, _, text) | Errand::Picture(name, text, PICTURE_SCALE)) => (name, text),
        other => panic!("{title}: {other:?}, {:?}", app.notice),
    }
}

/// Leaves it where a person can look at it.
fn keep(name: &str, text: &str) {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("target/exports");
    std::fs::create_dir_all(&folder).expect("a folder");
    std::fs::write(folder.join(name), text).expect("a file");
}

const FIGURE_9: &str = "v=1&alpha=1e-4&beta=0.01&omega=8.0969&map=first";

#[test]
fn every_plot_of_every_tab_is_saved_in_light_colours_and_the_page_stays_as_it_is() {
    let all: [(&str, &[&str]); 6] = [
        (FIGURE_9, &["Stability near 2ω₁", "Phase portrait", "Poincaré map", "Time history"]),
        (
            "v=1&alpha=1e-4&beta=0.01&omega=8.0969&tab=stability&layer=motion&map=first",
            &["Stability chart", "Floquet multipliers", "Spectrum", "Basins of attraction"],
        ),
        (
            "v=1&alpha=1e-4&beta=0.005&omega=8.0969&tab=sweep&map=first&sweep.count=30",
            &["Orbit diagram", "Response curves"],
        ),
        ("v=1&alpha=1e-4&beta=0.01&omega=8.0969&tab=design", &["Over frequency"]),
        ("v=1&tab=paper&figure=9", &["(a)  Initial history", "(c)  Phase diagram", "(d)  Poincaré map"]),
        ("v=1&tab=paper&figure=7", &["Stability boundaries"]),
    ];
    for (number, (link, titles)) in all.into_iter().enumerate() {
        let (mut app, context) = page(link, [1440.0, 900.0]);
        let view = app.view.clone();
        for title in titles {
            let (name, text) = saved(&mut app, &context, title, Format::Svg);
            keep(&format!("{number}-{name}"), &text);
            let drawing = roxmltree::Document::parse(&text).expect("well-formed");
            assert!(drawing.descendants().any(|node| node.text() == Some(title)), "{title}");
            assert!(
                text.contains(&format!("#{:02x}{:02x}{:02x}", 20, 26, 32)) && text.contains("fill=\"#fff\"")
            );
            let (name, table) = saved(&mut app, &context, title, Format::Csv);
            keep(&format!("{number}-{name}"), &table);
            assert!(table.starts_with(&format!("# plot: {title}\n# program: Harvester Lab ")), "{table}");
            assert_eq!(table.contains("# sweep: omega from "), view.tab == Tab::Sweep);
            assert!(table.lines().filter(|line| !line.starts_with('#')).count() > 5, "{title}");
            assert!(!table.lines().any(|line| line.starts_with(',')), "every row has a name: {title}");
            let (picture, again) = saved(&mut app, &context, title, Format::Png);
            assert!(picture.ends_with(".png") && again == text, "{picture}");
        }
        assert_eq!((app.view.clone(), app.notice.clone()), (view, None));
    }
}

#[test]
fn a_report_holds_the_numbers_of_the_scenario() {
    let (mut app, _) = page(FIGURE_9, [1440.0, 900.0]);
    app.step(Command::Report, Hand::default());
    let errands = app.take_errands();
    let [Errand::Save(name, kind, text)] = errands.as_slice() else { panic!("{errands:?}") };
    keep(name, text);
    assert_eq!((name.as_str(), *kind), ("harvester-report.html", "text/html;charset=utf-8"));
    let options = roxmltree::ParsingOptions { allow_dtd: true, ..Default::default() };
    let page = roxmltree::Document::parse_with_options(text, options).expect("well-formed");
    let count = |tag: &str| page.descendants().filter(|node| node.has_tag_name(tag)).count();
    let svg = "http://www.w3.org/2000/svg";
    let drawings = page.descendants().filter(|node| node.has_tag_name((svg, "svg"))).count();
    assert_eq!(drawings, 6, "four plots, a close view and a code");
    assert_eq!(count("script"), 0);
    for part in ["Period 2", "1e−4", "8.0969", "480 mm", "v=1&amp;alpha=1e-4", "of the gap"] {
        assert!(text.contains(part), "{part}");
    }
    assert!(!text.contains("<h2>Variants"));
}

#[test]
fn a_report_holds_the_pinned_variants_with_their_curves() {
    let (mut app, context) =
        page("v=1&omega=4&beta=1e-4&tab=design&design.page=variants&design.window=1.3+1.5", [1440.0, 900.0]);
    app.step(Command::Variant(Change::Pin), Hand::default());
    assert_eq!((app.bench.variants.len(), app.notice.clone()), (1, None));
    app.step(Command::Report, Hand::default());
    let errands = app.take_errands();
    let [Errand::Save(name, _, text)] = errands.as_slice() else { panic!("{errands:?}") };
    keep(&format!("variants-{name}"), text);
    let best = app.bench.variants[0].best().expect("a motion").0;
    let power = with_unit(best.measures.power, "W");
    for part in ["<h2>Variants</h2>", "<td>present</td><td>A</td>", "Variants over frequency", &power] {
        assert!(text.contains(part), "{part}");
    }
    let (_, table) = saved(&mut app, &context, "Variants over frequency", Format::Csv);
    assert!(table.contains("\npresent,1.") && table.contains("\nA,1."), "{table}");
}

#[test]
fn a_plot_over_logarithmic_frequencies_is_saved_in_hertz_with_round_ticks() {
    let link = "v=1&alpha=1e-4&beta=1e-4&omega=8.0969&tab=design&design.logarithmic_frequency=true&design.window=1+9";
    let (mut app, context) = page(link, [1440.0, 900.0]);
    assert_eq!(app.notice, None);
    let (_, table) = saved(&mut app, &context, "Over frequency", Format::Csv);
    let curves = table.lines().filter(|line| !line.starts_with("least power"));
    let hertz = curves.filter_map(|line| line.split(',').find_map(|field| field.parse::<f64>().ok()));
    let hertz: Vec<f64> = hertz.collect();
    let outside = hertz.iter().find(|hertz| !(0.999..=9.001).contains(*hertz));
    assert!(hertz.len() > 100 && outside.is_none(), "{outside:?}");
    let (_, drawing) = saved(&mut app, &context, "Over frequency", Format::Svg);
    for tick in [">2<", ">4<", ">6<"] {
        assert!(drawing.contains(tick), "{tick}");
    }
}

#[test]
fn what_is_not_there_is_not_saved_and_said() {
    let (mut app, context) = page("v=1", [900.0, 700.0]);
    for title in ["Orbit diagram", "", "no such card"] {
        app.export(&context, title, Format::Svg);
        assert_eq!(app.take_errands(), []);
        assert_eq!(app.notice.take().as_deref(), Some(BUSY));
    }
}

#[test]
fn files_have_plain_names() {
    assert_eq!(file_name("Poincaré map"), "harvester-poincare-map");
    assert_eq!(file_name("Stability near ω₁+ω₂"), "harvester-stability-near-omega1-omega2");
    assert_eq!(file_name("(c)  Phase diagram"), "harvester-c-phase-diagram");
}

#[test]
fn the_solver_answers_what_the_programs_ask() {
    for link in [
        "v=1&alpha=1e-4&beta=0.01&omega=8.0969&force=taylor5&t_end=300&initial=0+0.1+0+0+0",
        "v=1&tab=sweep&sweep.count=3&sweep.dwell.discarded=10&sweep.dwell.kept=4&omega=8",
        "v=1&tab=design&omega=8.0969&resistance=1e6&scaling=consistent&design.window=1.3+1.4",
        "v=1&tab=design&design.page=load",
        "v=1&tab=design&design.page=tolerances&design.window=1.3+1.4",
        "v=1&tab=design&design.page=trust",
        "v=1&tab=design&design.page=shake&design.shake.by=chirp&design.shake.duration=20&alpha=0.005&force=exact",
        "v=1&design.shake.everywhere=true&design.shake.duration=20&design.shake.level=1e-3&alpha=0.005",
    ] {
        let view = crate::app::link::read(link, &View::default()).0;
        let shakes = link.contains("shake");
        let request = request(&view, &Session::default(), &Bench::default());
        assert_eq!(request.contains("\"task\":\"shake\""), shakes, "{request}");
        let answer = solve(&request);
        assert!(answer.is_ok(), "{request}: {answer:?}");
    }
}

#[test]
fn the_chart_in_view_is_asked_for() {
    let view = crate::app::link::read("v=1&tab=stability&map=first&alpha=1e-4", &View::default()).0;
    let system = view.scenario.model.system(view.scenario.parameters).expect("a system");
    let structure = map::structure(&view.scenario);
    let mut session = Session::default();
    session.boundaries = Some(Boundaries::new(structure, &system));
    for (layer, quantity) in [(Quantity::Multiplier, "multiplier"), (Quantity::VRms, "v_rms")] {
        let request = request(&View { layer, ..view.clone() }, &session, &Bench::default());
        let asked: serde_json::Value = serde_json::from_str(&request).expect("JSON");
        assert_eq!((asked["task"].as_str(), asked["quantity"].as_str()), (Some("chart"), Some(quantity)));
        let omega = asked["omega"]["from"].as_f64().zip(asked["omega"]["to"].as_f64());
        assert!(omega.is_some_and(|(from, to)| from < 8.0969 && 8.0969 < to), "{request}");
        // Fewer places, of which there are thousands.
        let fewer = request.replace("\"count\":256", "\"count\":3").replace("\"count\":80", "\"count\":2");
        let fewer = fewer.replace("\"count\":60", "\"count\":2");
        assert!(solve(&fewer).is_ok(), "{fewer}: {:?}", solve(&fewer));
    }
}
