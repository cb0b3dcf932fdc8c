//! The Design tab, drawn without a window.

use egui::Role;

use crate::app::bench::questions;
use crate::app::bench::variant::highest;
use crate::app::command::Command;
use crate::app::history::Hand;
use crate::app::rehearsal::Desk;
use crate::app::session::Status;
use crate::app::widgets::harness::Node;
use crate::app::widgets::number::{significant, with_unit};
use crate::questions::harvest::HarvestStudy;
use crate::questions::shake::AtLevel;
use crate::scheduler::Table;

fn desk(width: f32, page: &str) -> Desk {
    let stored = format!(
        r#"{{"scenario":{{"parameters":{{"alpha":0.001}},"t_end":100}},"tab":"design","design":{{"page":"{page}"}}}}"#
    );
    Desk::new(width, 900.0, &stored)
}

#[test]
fn every_page_draws_on_a_phone_and_on_a_desk_without_labels_over_each_other() {
    for page in ["harvest", "load", "materials", "trust", "search", "tolerances", "measured", "variants"] {
        for width in [360.0, 1440.0] {
            let mut desk = desk(width, page);
            desk.work(20);
            // A table that has just got a value knows its widths a frame later.
            desk.rest(1);
            // A text that breaks has a rectangle in which its neighbours begin.
            let whole =
                |node: &&Node| node.role == Role::Label && node.bounds.height() < 28.0 && node.label != "·";
            let labels: Vec<_> = desk.harness.nodes.iter().filter(whole).collect();
            assert!(labels.len() > 10, "{page} at {width}: {} labels", labels.len());
            for (i, a) in labels.iter().enumerate() {
                for b in &labels[i + 1..] {
                    let common = a.bounds.shrink(1.5).intersect(b.bounds.shrink(1.5));
                    assert!(!common.is_positive(), "{page} at {width}: {a:?} over {b:?}");
                }
            }
        }
    }
}

#[test]
fn the_summary_says_what_the_device_delivers() {
    let mut desk = desk(1440.0, "harvest");
    for _ in 0..400 {
        desk.work(1);
        if desk.harness.nodes.iter().any(|node| node.label.starts_with("Limits: ")) {
            break;
        }
    }
    for name in [
        "Voltage, rms: ",
        "Power in the load: ",
        "Power per g²: ",
        "Tip: ",
        "Efficiency: ",
        "Limits: model not valid",
    ] {
        desk.harness.find(Role::Label, name);
    }
}

#[test]
fn a_record_of_the_run_itself_is_aligned_with_it() {
    let mut desk = desk(1440.0, "measured");
    desk.work(20);
    let unit = desk.app.view.scenario.units().time;
    let period = std::f64::consts::TAU / desk.app.view.scenario.parameters.omega;
    let shown = desk.app.session.shown.as_ref().expect("a run");
    let run = &shown.run;
    let end = run.trajectory.end_time() - 1.3 * period;
    let mut text = "time [s],voltage [V]\n".to_owned();
    run.trajectory.sample(end - 20.0 * period, end, 4001, |time, state| {
        text += &format!("{},{}\n", 7.0 + time * unit, state[run.system.dimension() - 1]);
    });
    desk.app.bench.measured.open("run.csv", text.into_bytes());
    desk.work(20);
    let align = desk.harness.find(Role::Button, "Align").bounds.center();
    let Desk { app, harness } = &mut desk;
    harness.click(align, |ui| app.ui(ui));
    desk.work(3);
    let shift = desk.app.bench.measured.file.as_ref().expect("a file").reading.shift;
    assert!((shift - 1.3).abs() < 1e-3, "{shift}");
    desk.harness.find(Role::Label, "what is left between them: ");
}

#[test]
fn before_there_is_a_file_the_run_in_view_can_stand_for_one() {
    let mut desk = desk(1440.0, "measured");
    desk.work(20);
    let button = desk.harness.find(Role::Button, "Try it with the run in view").bounds.center();
    let Desk { app, harness } = &mut desk;
    harness.click(button, |ui| app.ui(ui));
    desk.work(20);
    let file = desk.app.bench.measured.file.as_ref().expect("a file");
    let (run, unit) =
        (&desk.app.session.shown.as_ref().expect("a run").run, desk.app.view.scenario.units().time);
    let [time, volts] = file.points[1234];
    let state = run.trajectory.state_at(time / unit);
    assert!((volts - state[run.system.dimension() - 1]).abs() < 1e-9, "{volts} V");
    desk.harness.find(Role::Label, "4001 rows read");
    desk.harness.find(Role::Label, "what is left between them: ");
}

#[test]
fn a_click_on_a_frequency_keeps_the_window() {
    let stored = r#"{"scenario":{"parameters":{"omega":15,"beta":1e-4},"t_end":100},"tab":"design"}"#;
    let mut desk = Desk::new(1440.0, 900.0, stored);
    let window = |desk: &Desk| questions::window(&desk.app.view, &desk.app.session);
    for _ in 0..200 {
        desk.work(1);
    }
    let (before, asked) = (window(&desk), questions::harvest(&desk.app.view, &desk.app.session));
    let corner = desk.harness.find(Role::Button, "Enlarge: Over frequency").bounds;
    let at = egui::pos2(corner.right() - 20.0, corner.bottom() + 150.0);
    let Desk { app, harness } = &mut desk;
    harness.click(at, |ui| app.ui(ui));
    desk.work(2);
    assert!(desk.app.view.scenario.parameters.omega > 17.0, "{}", desk.app.view.scenario.parameters.omega);
    assert_eq!(window(&desk), before);
    assert_eq!(questions::harvest(&desk.app.view, &desk.app.session), asked);
}

#[test]
fn a_load_is_read_in_the_unit_that_suits_it() {
    let mut desk = Desk::new(1440.0, 2000.0, r#"{"scenario":{"t_end":100},"tab":"design"}"#);
    desk.work(3);
    let shown = |desk: &Desk, text: &str| desk.harness.texts.iter().any(|(shown, _)| shown == text);
    assert!(desk.harness.texts.iter().any(|(text, _)| text.ends_with(" MΩ")), "{:?}", desk.harness.texts);
    let preset = desk.harness.find(Role::Button, "60 mm steel beam").bounds.center();
    let Desk { app, harness } = &mut desk;
    harness.click(preset, |ui| app.ui(ui));
    desk.work(2);
    assert!(shown(&desk, "18.0 kΩ"), "{:?}", desk.harness.texts);
    let field = desk.harness.find(Role::TextInput, "Load value").bounds.center();
    let Desk { app, harness } = &mut desk;
    harness.click(field, |ui| app.ui(ui));
    harness.text("30.39 kOhm", |ui| app.ui(ui));
    harness.key(egui::Key::Enter, egui::Modifiers::NONE, |ui| app.ui(ui));
    desk.work(2);
    assert!(shown(&desk, "30.39 kΩ"), "{:?}", desk.harness.texts);
}

#[test]
fn beside_measured_frequencies_the_curves_are_those_of_these() {
    let mut desk = desk(1440.0, "measured");
    desk.app.bench.measured.open("sweep.csv", b"f [Hz],v [V]\n1.1,0.5\n1.2,5.7\n1.4,0.2\n".to_vec());
    desk.work(10);
    let crew = desk.app.crew.borrow();
    let points = crew.studies.lanes.study::<HarvestStudy>().expect("curves").linear_points();
    let (first, last) = (points[0].frequency, points[points.len() - 1].frequency);
    assert!((first - 1.1).abs() < 1e-9 && (last - 1.4).abs() < 1e-9, "{first} {last}");
}

#[test]
fn in_place_of_the_sine_noise_shakes_explore_and_the_verdict_steps_aside() {
    let stored = r#"{"scenario":{"model":{"force":"exact"},"parameters":{"alpha":0.005}},"design":{"shake":{"duration":20}}}"#;
    let mut desk = Desk::new(1440.0, 900.0, stored);
    desk.work(3);
    desk.harness.find(Role::Button, "Enlarge: Poincaré map");
    let noise = desk.harness.find(Role::RadioButton, "Shaken by: noise").bounds.center();
    let Desk { app, harness } = &mut desk;
    harness.click(noise, |ui| app.ui(ui));
    desk.work(20);
    for card in ["Voltage over time", "Spectrogram of the voltage", "Mean power so far"] {
        desk.harness.find(Role::Button, &format!("Enlarge: {card}"));
    }
    assert!(!desk.harness.nodes.iter().any(|node| node.label == "Enlarge: Poincaré map"));
    desk.harness.find(Role::Label, "Under noise nothing repeats");
    // Elsewhere the sine stays.
    desk.app.view.tab = crate::app::view::Tab::Stability;
    desk.work(3);
    assert!(!desk.harness.nodes.iter().any(|node| node.label == "Shaken by: noise"));
}

#[test]
fn what_is_computed_about_noise_can_be_stopped_and_taken_up_again() {
    let stored = r#"{"scenario":{"model":{"force":"exact"},"parameters":{"alpha":0.005}},"design":{"shake":{"duration":20,"everywhere":true}}}"#;
    let mut desk = Desk::new(360.0, 2400.0, stored);
    let says = |desk: &Desk, text: &str| desk.harness.nodes.iter().any(|node| node.label.starts_with(text));
    let begun = |desk: &Desk| says(desk, "computing ") && !says(desk, "computing 0 %");
    for _ in 0..400 {
        desk.work(1);
        if begun(&desk) {
            break;
        }
    }
    assert!(begun(&desk));
    assert!(!says(&desk, "computed"));
    for label in ["computing ", "Stop"] {
        let node = desk.harness.nodes.iter().find(|node| node.label.starts_with(label)).expect("in view");
        assert!(node.bounds.right() <= 360.0, "{node:?}");
    }
    press(&mut desk, Role::Button, "Stop");
    // It stays so, however often the page asks.
    desk.work(20);
    desk.harness.find(Role::Label, "Stopped before its end.");
    assert!(says(&desk, "computed"));
    assert!(!desk.harness.nodes.iter().any(|node| node.label == "Stop"));
    press(&mut desk, Role::Button, "Compute");
    compute(&mut desk);
    desk.harness.find(Role::Label, "Under noise nothing repeats");
    assert!(!says(&desk, "Compute") && !says(&desk, "Stopped"));
    // Stopped once more, another level is computed at once, and with it what was stopped over the level.
    desk.app.change("design.shake.level", "0.021").expect("a level");
    desk.app.carry_out(Command::Shake(false));
    desk.work(2);
    desk.harness.find(Role::Label, "Stopped before its end.");
    desk.app.change("design.shake.level", "0.0211").expect("a level");
    compute(&mut desk);
    desk.harness.find(Role::Label, "Under noise nothing repeats");
    let crew = desk.app.crew.borrow();
    let levels: &Table<AtLevel> = crew.studies.lanes.study().expect("levels");
    assert!(levels.is_whole());
}

/// A page with all of it computed.
fn computed(width: f32, stored: &str) -> Desk {
    let mut desk = Desk::new(width, 2400.0, stored);
    compute(&mut desk);
    desk
}

fn compute(desk: &mut Desk) {
    for _ in 0..40_000 {
        desk.app.logic(&desk.harness.context.clone());
        if desk.app.session.status() == Status::Done && !desk.app.crew.borrow().is_busy() {
            desk.app.follow();
            if !desk.app.crew.borrow().is_busy() {
                break;
            }
        }
    }
    desk.work(3);
}

fn press(desk: &mut Desk, role: Role, label: &str) {
    let at = desk.harness.find(role, label).bounds.center();
    let Desk { app, harness } = desk;
    harness.click(at, |ui| app.ui(ui));
    desk.work(2);
}

#[test]
fn one_sentence_says_what_the_device_gives_over_the_window() {
    let said = |design: &str| {
        let numbers = r#"{"parameters":{"omega":4.0,"beta":1e-4},"t_end":100}"#;
        let desk = computed(360.0, &format!(r#"{{"scenario":{numbers},"tab":"design","design":{design}}}"#));
        let label = desk.harness.find(Role::Label, "Shaken at ").label.replace('\u{a0}', " ");
        let crew = desk.app.crew.borrow();
        let study: &HarvestStudy = crew.studies.lanes.study().expect("curves");
        let best = study.stable_pieces().concat().into_iter();
        let best = best.max_by(|a, b| a.measures.power.total_cmp(&b.measures.power)).expect("a motion");
        let gives =
            format!("{} at {} Hz", with_unit(best.measures.power, "W"), significant(best.frequency, 4));
        assert!(label.contains(&gives), "{label}: {gives}");
        label
    };
    let usual = said(r#"{"window":[1.2,1.6]}"#);
    for part in [
        "0.000379 g",
        " into 7.63 MΩ, ",
        " or more from 1.4",
        " model not valid (sags by ",
        "; without magnets ≥",
    ] {
        assert!(usual.contains(part), "{usual}: {part}");
    }
    let beyond = said(r#"{"window":[1.35,1.45],"least":1e-5,"limits":{"voltage":[5.0,5.0]}}"#);
    assert!(beyond.contains(", nowhere 10.0 µW or more, unsafe (peak 5.94 V, limit 5.00 V)"), "{beyond}");
    let cut = said(r#"{"window":[1.35,1.45],"least":1e-6,"limits":{"voltage":[5.0,5.0]}}"#);
    assert!(cut.contains("limit 5.00 V), within the limits: 1.4"), "{cut}");
}

#[test]
fn on_a_logarithmic_axis_frequencies_are_spread_drawn_and_clicked_as_it_says() {
    let design = r#"{"window":[1.0,9.0],"logarithmic_frequency":true}"#;
    let numbers = r#"{"parameters":{"omega":15,"beta":1e-4},"t_end":100}"#;
    let mut desk =
        Desk::new(1440.0, 900.0, &format!(r#"{{"scenario":{numbers},"tab":"design","design":{design}}}"#));
    desk.work(30);
    let (_, question, _) = questions::harvest(&desk.app.view, &desk.app.session);
    assert!(question.logarithmic);
    let points = {
        let crew = desk.app.crew.borrow();
        crew.studies.lanes.study::<HarvestStudy>().expect("curves").linear_points()
    };
    let [first, last] = [points[0].frequency, points[points.len() - 1].frequency];
    let below = points.iter().filter(|point| point.frequency < (first * last).sqrt()).count();
    assert!(2 * below > points.len() - 40, "{below} of {} below the middle", points.len());
    let corner = desk.harness.find(Role::Button, "Enlarge: Over frequency").bounds;
    let mut clicked = |x: f32| {
        let Desk { app, harness } = &mut desk;
        harness.click(egui::pos2(corner.right() - x, corner.bottom() + 150.0), |ui| app.ui(ui));
        desk.work(2);
        let view = &desk.app.view;
        view.scenario.units().hertz(view.scenario.parameters.omega)
    };
    let [low, middle, high] = [420.0, 270.0, 120.0].map(&mut clicked);
    assert!(low > first && high < last && high > 1.5 * low, "{low} {high}");
    assert!((middle * middle / (low * high) - 1.0).abs() < 2e-3, "{low} {middle} {high}");
}

#[test]
fn one_window_holds_all_resonances() {
    let mut desk = Desk::new(1440.0, 2400.0, r#"{"scenario":{"t_end":100},"tab":"design"}"#);
    desk.work(3);
    let button = desk.harness.find(Role::Button, "all resonances").bounds.center();
    let Desk { app, harness } = &mut desk;
    harness.click(button, |ui| app.ui(ui));
    desk.work(2);
    let (low, high) = questions::window(&desk.app.view, &desk.app.session);
    let natural = &desk.app.session.boundaries.as_ref().expect("boundaries").frequencies;
    assert!(
        natural.len() > 1 && natural.iter().all(|omega| low < 0.9 * omega && high > 1.1 * omega),
        "{low} {high}"
    );
}

#[test]
fn pinned_designs_stand_beside_the_present_one_until_they_are_removed() {
    let numbers = r#"{"parameters":{"omega":4.0,"beta":1e-4},"t_end":100}"#;
    let design = r#"{"page":"variants","window":[1.3,1.5]}"#;
    for width in [360.0, 1440.0] {
        let mut desk =
            computed(width, &format!(r#"{{"scenario":{numbers},"tab":"design","design":{design}}}"#));
        press(&mut desk, Role::Button, "Pin this design");
        let told = |desk: &Desk, text: &str| desk.harness.nodes.iter().any(|node| node.label.contains(text));
        assert!(told(&desk, "Remove A"));
        let first = desk.app.view.scenario.clone();
        // The same again is no other.
        press(&mut desk, Role::Button, "Pin this design");
        assert_eq!(desk.app.bench.variants.len(), 1);
        let mut other = first.clone();
        other.parameters.kappa *= 4.0;
        desk.app.step(Command::Show(Box::new(other.clone())), Hand::default());
        desk.app.follow();
        compute(&mut desk);
        press(&mut desk, Role::Button, "Pin this design");
        let texts: Vec<&str> = desk.harness.nodes.iter().map(|node| node.label.as_str()).collect();
        let rows = |name: &str| texts.iter().filter(|text| **text == name).count();
        // On a phone the designs stand below each other, each with its own names of rows.
        let tables = if width < 500.0 { 3 } else { 1 };
        let (load, length) = (rows("load resistance"), rows("beam length"));
        assert!(load == tables && length == 0, "{width}: {load} {length} {texts:?}");
        let all = desk.app.bench.variants.clone();
        let ([a, b], crew) = ([&all[0], &all[1]], desk.app.crew.borrow());
        assert_eq!((a.name.as_str(), b.name.as_str(), &b.scenario), ("A", "B", &other));
        let study: &HarvestStudy = crew.studies.lanes.study().expect("curves");
        let best = b.best().expect("a motion").0.measures.power;
        assert_eq!(highest(&study.stable_pieces()).map(|point| point.measures.power), Some(best));
        assert!(a.best().expect("a motion").0.measures.power != best && b.load.is_some());
        for design in [a, b] {
            let best = design.best().expect("a motion").0;
            let gives =
                format!("{} at {} Hz", with_unit(best.measures.power, "W"), significant(best.frequency, 4));
            assert!(texts.iter().any(|text| text.ends_with(&gives)), "{gives}: {texts:?}");
        }
        drop(crew);
        press(&mut desk, Role::Button, "Make A the present design");
        assert_eq!(desk.app.view.scenario, first);
        press(&mut desk, Role::TextInput, "Name of B");
        let Desk { app, harness } = &mut desk;
        harness.text("loaded", |ui| app.ui(ui));
        harness.key(egui::Key::Enter, egui::Modifiers::NONE, |ui| app.ui(ui));
        desk.work(2);
        assert!(desk.app.bench.variants[1].name.contains("loaded"), "{}", desk.app.bench.variants[1].name);
        // Another session goes on with them; what cannot be used is left out.
        let next = Desk::new(width, 900.0, &desk.app.stored());
        assert_eq!(next.app.bench.variants, desk.app.bench.variants);
        let spoiled = desk.app.stored().replacen("\"gap\":0.", "\"gap\":\"x\",\"was\":0.", 1);
        assert_eq!(Desk::new(width, 900.0, &spoiled).app.bench.variants.len(), 1);
        press(&mut desk, Role::Button, "Remove A");
        assert_eq!(desk.app.bench.variants.len(), 1);
        desk.app.undo();
        assert_eq!(desk.app.bench.variants.len(), 2);
    }
}
