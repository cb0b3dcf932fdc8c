use super::*;
use crate::app::panels::parts::parts;
use egui::{Event, Modifiers, MouseWheelUnit, TouchPhase, pos2, vec2};

fn read(search: &str) -> Option<Embed> {
    Embed::read(search, &parts())
}

#[test]
fn an_address_says_what_is_shown() {
    assert!(read("").is_none() && read("?controls=omega").is_none());
    let embed = read("?embed=map,phase,map&controls=omega,modes,resistance").expect("embedded");
    assert_eq!(embed.parts, [Part::Plot(Panel::StabilityMap), Part::Plot(Panel::PhasePortrait)]);
    let controls =
        [Control::Number(Parameter::Omega), Control::Modes, Control::Dimension(Dimension::Resistance)];
    assert_eq!((embed.controls.as_slice(), &embed.complaint), (&controls[..], &None));
    let bare = read("?embed").expect("embedded");
    assert_eq!((bare.parts.len(), bare.controls.len(), bare.complaint), (2, 0, None));
    for (part, name, _) in parts() {
        assert_eq!(read(&format!("?embed={name}")).map(|embed| embed.parts), Some(vec![part]));
    }
    for name in control_names() {
        let read = read(&format!("?embed=map&controls={name}")).expect("embedded");
        assert!(read.controls.len() == 1 && read.complaint.is_none(), "{name}");
    }
}

#[test]
fn what_is_not_known_is_told_and_the_rest_is_shown() {
    let embed = read("?embed=map,mop,<script>&controls=omega,zeta").expect("embedded");
    assert_eq!((embed.parts.len(), embed.controls.len()), (1, 1));
    let complaint = embed.complaint.expect("a complaint");
    assert!(complaint.starts_with("Not understood in embed: mop, <script>. There are verdict, map, "));
    assert!(complaint.contains("Not understood in controls: zeta. There are alpha, beta, "), "{complaint}");
    let long = read(&format!("?embed={}", "x".repeat(9000))).and_then(|embed| embed.complaint);
    assert!(long.is_some_and(|text| text.len() < 300));
}

#[test]
fn a_snippet_is_read_back() {
    let html = snippet("https://example.org/lab/", "v=1&omega=8.2", &["map", "phase"], &["alpha", "omega"]);
    let wanted =
        "src=\"https://example.org/lab/?embed=map,phase&amp;controls=alpha,omega#v=1&amp;omega=8.2\"";
    assert!(html.starts_with("<iframe ") && html.contains(wanted), "{html}");
}

#[test]
fn the_wheel_and_the_finger_belong_to_the_page_around() {
    let embed = read("?embed=map").expect("embedded");
    let wheel = |up: f32, modifiers| Event::MouseWheel {
        unit: MouseWheelUnit::Point,
        delta: vec2(0.0, up),
        phase: TouchPhase::Move,
        source: egui::MouseWheelSource::Unknown,
        modifiers,
    };
    let press = |x| Event::PointerButton {
        pos: pos2(x, 0.0),
        button: egui::PointerButton::Primary,
        pressed: true,
        modifiers: Modifiers::NONE,
    };
    let moved = Event::PointerMoved(pos2(0.0, 9.0));
    let release = Event::PointerButton {
        pos: pos2(0.0, 9.0),
        button: egui::PointerButton::Primary,
        pressed: false,
        modifiers: Modifiers::NONE,
    };
    let keeps = |event: &Event| embed.keeps(event, &|at| at.x > 50.0);
    assert!(!keeps(&wheel(9.0, Modifiers::NONE)) && !keeps(&wheel(-9.0, Modifiers::NONE)));
    assert!(keeps(&wheel(9.0, Modifiers::CTRL)));
    assert!(!keeps(&press(10.0)) && keeps(&release));
    assert!(!keeps(&moved) && !keeps(&release));
    assert!(keeps(&press(60.0)) && keeps(&moved));
    // Contents that are too tall for the frame are scrolled first.
    embed.room.set([0.0, 80.0]);
    assert!(keeps(&wheel(-9.0, Modifiers::NONE)) && !keeps(&wheel(9.0, Modifiers::NONE)));
    assert!(keeps(&press(10.0)));
}
