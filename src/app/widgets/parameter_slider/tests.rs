//! Sliders driven by synthetic pointer and keyboard events.

use egui::{Key, Modifiers, Role, Ui, pos2};

use super::super::harness::Harness;
use super::{Mark, ParameterSlider, SliderResponse};

/// A slider in a window of its own, with what it last reported.
struct Bench {
    harness: Harness,
    value: f64,
    last: Option<SliderResponse>,
    releases: usize,
}

impl Bench {
    fn new(value: f64) -> Self {
        let mut bench = Self { harness: Harness::new(320.0, 240.0), value, last: None, releases: 0 };
        bench.run(|harness, draw| harness.settle(draw));
        bench
    }

    fn run(&mut self, act: impl FnOnce(&mut Harness, &mut dyn FnMut(&mut Ui))) {
        let Self { harness, value, last, releases } = self;
        let marks = [Mark::new(8.0969, "2ω₁", "twice the first frequency"), Mark::new(30.0, "2ω₂", "far")];
        act(harness, &mut |ui| {
            let slider =
                ParameterSlider::new("Frequency", "ω", value, 1.0..=41.0).marks(&marks).default_value(8.0);
            let response = slider.tooltip("Base frequency.").equation("Eq. 8").secondary("2.84 Hz").show(ui);
            *releases += usize::from(response.released);
            *last = Some(response);
        });
    }

    fn error(&self) -> Option<&str> {
        self.last.as_ref().and_then(|last| last.error.as_deref())
    }

    fn field(&self) -> egui::Pos2 {
        self.harness.find(Role::Slider, "Frequency").bounds.right_top() + egui::vec2(-20.0, -14.0)
    }

    /// Long enough that the next click does not count as the second of a double click.
    fn pause(&mut self) {
        self.run(|harness, draw| (0..40).for_each(|_| harness.frame(Vec::new(), &mut *draw)));
    }

    fn type_text(&mut self, text: &str, end: Key) {
        self.pause();
        let at = self.field();
        self.run(|harness, draw| harness.click(at, draw));
        self.run(|harness, draw| harness.text(text, draw));
        self.run(|harness, draw| harness.key(end, Modifiers::NONE, draw));
    }
}

#[test]
fn it_is_found_by_its_label_and_dragged() {
    let mut bench = Bench::new(11.0);
    let node = bench.harness.find(Role::Slider, "Frequency");
    assert_eq!(node.number, Some(11.0));
    let from = pos2(node.bounds.left() + 8.0 + 0.25 * (node.bounds.width() - 16.0), node.bounds.center().y);
    let to =
        pos2(node.bounds.left() + 8.0 + 0.75 * (node.bounds.width() - 16.0), node.bounds.center().y + 30.0);
    bench.run(|harness, draw| harness.drag(from, to, draw));
    assert!((bench.value - 31.0).abs() < 0.1, "{}", bench.value);
    assert_eq!(bench.releases, 1);
    assert_eq!(bench.value, (bench.value * 100.0).round() / 100.0);
}

#[test]
fn with_shift_it_moves_a_tenth_as_far_and_resolves_a_hundredth_about_a_mark() {
    let moved = |from: f64| {
        let mut bench = Bench::new(from);
        let node = bench.harness.find(Role::Slider, "Frequency");
        let rail = node.bounds.shrink2(egui::vec2(8.0, 0.0));
        let thumb = pos2(rail.left() + rail.width() * ((from - 1.0) / 40.0) as f32, rail.center().y);
        let shift = egui::Event::ModifiersChanged(Modifiers::SHIFT);
        bench.run(|harness, draw| harness.frame(vec![shift], draw));
        bench.run(|harness, draw| harness.drag(thumb, thumb + egui::vec2(50.0, 0.0), draw));
        let step = 40.0 / f64::from(rail.width());
        ((bench.value - from) / 50.0, step)
    };
    let (point, step) = moved(21.0);
    assert!((point / step - 0.1).abs() < 0.005, "{point} {step}");
    let (point, _) = moved(8.1);
    assert!(point > 0.0 && point < 0.01, "{point}");
}

#[test]
fn a_complaint_moves_nothing_and_escape_takes_it_away() {
    let mut bench = Bench::new(11.0);
    let below = |bench: &mut Bench| {
        let mut bottom = 0.0;
        let value = &mut bench.value;
        bench.harness.frame(Vec::new(), |ui| {
            ParameterSlider::new("Frequency", "ω", value, 1.0..=41.0).show(ui);
            bottom = ui.cursor().top();
        });
        bottom
    };
    let before = below(&mut bench);
    bench.type_text("fast", Key::Tab);
    assert!(bench.error().is_some());
    assert_eq!(below(&mut bench), before);
    let texts = &bench.harness.texts;
    assert!(texts.iter().any(|(text, seen)| text.contains("is not a number") && *seen > 0.99), "{texts:?}");
    bench.run(|harness, draw| harness.key(Key::Escape, Modifiers::NONE, draw));
    assert_eq!(bench.error(), None);
}

#[test]
fn a_press_on_the_track_jumps_there() {
    let mut bench = Bench::new(11.0);
    let node = bench.harness.find(Role::Slider, "Frequency");
    bench.run(|harness, draw| harness.click(node.bounds.center(), draw));
    assert!((bench.value - 21.0).abs() < 0.1, "{}", bench.value);
}

#[test]
fn grabbing_the_thumb_off_centre_moves_nothing() {
    let mut bench = Bench::new(21.0);
    let node = bench.harness.find(Role::Slider, "Frequency");
    bench.run(|harness, draw| harness.click(node.bounds.center() + egui::vec2(5.0, 0.0), draw));
    assert_eq!(bench.value, 21.0);
}

#[test]
fn typed_values_are_exact() {
    let mut bench = Bench::new(11.0);
    bench.type_text("8,0969416", Key::Enter);
    assert_eq!(bench.value, 8.096_941_6);
    assert!(bench.releases >= 1);
    bench.type_text("2.5e1", Key::Tab);
    assert_eq!(bench.value, 25.0);
    bench.type_text("12", Key::Escape);
    assert_eq!(bench.value, 25.0);
    assert_eq!(bench.error(), None);
}

#[test]
fn a_bad_text_keeps_the_value_and_says_why() {
    let mut bench = Bench::new(11.0);
    bench.type_text("77", Key::Enter);
    assert_eq!(bench.value, 11.0);
    assert_eq!(bench.error(), Some("Frequency ω = 77 is out of range. Allowed: 1 to 41."));
    // The field still has the keyboard and the text; a correction goes straight through.
    bench.run(|harness, draw| harness.key(Key::Backspace, Modifiers::NONE, draw));
    assert_eq!(bench.error(), None);
    bench.run(|harness, draw| harness.key(Key::Enter, Modifiers::NONE, draw));
    assert_eq!(bench.value, 7.0);
    bench.type_text("fast", Key::Tab);
    assert_eq!(bench.error(), Some("Frequency ω: “fast” is not a number. Allowed: 1 to 41."));
    let node = bench.harness.find(Role::Slider, "Frequency");
    bench.run(|harness, draw| harness.click(node.bounds.center(), draw));
    assert_eq!(bench.error(), None);
}

#[test]
fn keys_step_coarsely_and_finely() {
    let mut bench = Bench::new(21.0);
    bench.run(|harness, draw| harness.key(Key::Tab, Modifiers::NONE, draw));
    let press = |bench: &mut Bench, key, modifiers| {
        bench.run(|harness, draw| harness.key(key, modifiers, draw));
        bench.value
    };
    for (key, modifiers, expected) in [
        (Key::ArrowRight, Modifiers::NONE, 21.2),
        (Key::ArrowLeft, Modifiers::SHIFT, 21.18),
        (Key::PageUp, Modifiers::NONE, 23.18),
        (Key::End, Modifiers::NONE, 41.0),
        (Key::ArrowRight, Modifiers::NONE, 41.0),
        (Key::ArrowLeft, Modifiers::COMMAND, 30.0),
        (Key::ArrowLeft, Modifiers::COMMAND, 8.0969),
        (Key::Home, Modifiers::NONE, 1.0),
    ] {
        let value = press(&mut bench, key, modifiers);
        assert!((value - expected).abs() < 1e-9, "{key:?}: {value} instead of {expected}");
    }
}

#[test]
fn marks_snap_and_the_name_resets() {
    let mut bench = Bench::new(11.0);
    let mark = bench.harness.find(Role::Button, "Frequency at 2ω₁").bounds.center();
    bench.run(|harness, draw| harness.click(mark, draw));
    assert_eq!(bench.value, 8.0969);
    let reset = bench.harness.find(Role::Button, "Reset Frequency").bounds.center();
    bench.run(|harness, draw| harness.click(reset, draw));
    assert_eq!(bench.value, 8.0);
    bench.type_text("9", Key::Enter);
    bench.pause();
    let name = bench.harness.find(Role::Label, "Frequency").bounds.center();
    bench.run(|harness, draw| harness.click(name, draw));
    bench.run(|harness, draw| harness.click(name, draw));
    assert_eq!(bench.value, 8.0);
}

#[test]
fn the_compact_form_drags_too() {
    let mut harness = Harness::new(260.0, 60.0);
    let mut value = 0.0;
    let mut draw = |ui: &mut Ui| {
        ParameterSlider::new("Distance", "d", &mut value, 0.0..=0.1)
            .logarithmic_from(1e-5)
            .compact()
            .show(ui);
    };
    harness.settle(&mut draw);
    let track = harness.find(Role::Slider, "Distance").bounds;
    harness.drag(track.left_center() + egui::vec2(8.0, 0.0), track.right_center(), &mut draw);
    assert_eq!(value, 0.1);
}

#[test]
fn a_narrow_field_shows_fewer_digits_instead_of_half_of_them() {
    let mut harness = Harness::new(400.0, 200.0);
    let mut widths = Vec::new();
    harness.settle(|ui| {
        let text = |width| super::field::fitting(ui, 0.47091, "MPa s", width);
        widths = [200.0, 112.0, 40.0].map(text).to_vec();
    });
    assert_eq!(widths, ["0.47091 MPa s", "0.4709 MPa s", "0.471 MPa s"]);
}

/// Pictures of a finger that comes down and goes along these places, one a picture.
fn swipe(bench: &mut Bench, path: &[egui::Pos2]) {
    use egui::{Event, PointerButton, TouchDeviceId, TouchId, TouchPhase};
    let touch = |phase, pos| Event::Touch {
        device_id: TouchDeviceId(0),
        id: TouchId::from(1_u64),
        phase,
        pos,
        force: None,
    };
    let button = |pos, pressed| Event::PointerButton {
        pos,
        button: PointerButton::Primary,
        pressed,
        modifiers: Modifiers::NONE,
    };
    let (first, last) = (path[0], path[path.len() - 1]);
    let mut pictures = vec![vec![button(first, true), touch(TouchPhase::Start, first)]];
    pictures.extend(path[1..].iter().map(|at| vec![Event::PointerMoved(*at), touch(TouchPhase::Move, *at)]));
    pictures.push(vec![button(last, false), Event::PointerGone, touch(TouchPhase::End, last)]);
    bench.run(|harness, draw| {
        for events in pictures {
            harness.frame(events, |ui| {
                crate::app::widgets::touch::begin_frame(ui.ctx());
                draw(ui);
            });
        }
    });
}

#[test]
fn a_finger_slides_sideways_scrolls_up_and_down_and_sets_by_a_tap() {
    let mut bench = Bench::new(11.0);
    let track = bench.harness.find(Role::Slider, "Frequency").bounds;
    let at = |across: f32, down: f32| track.left_center() + egui::vec2(across * track.width(), down);
    for step in [3.0, 12.0, 40.0] {
        let path: Vec<_> = (0..8).map(|i| at(0.7, -step * i as f32)).collect();
        swipe(&mut bench, &path);
        assert_eq!(bench.value, 11.0, "{step}");
    }
    // Once it scrolls it does so wherever it goes.
    swipe(&mut bench, &[at(0.7, 0.0), at(0.7, 20.0), at(0.9, 24.0), at(0.2, 24.0)]);
    assert_eq!(bench.value, 11.0);
    swipe(&mut bench, &[at(0.7, 0.0), at(0.71, 0.0)]);
    assert!((bench.value - 29.0).abs() < 1.5, "{}", bench.value);
    let tapped = bench.value;
    swipe(&mut bench, &[at(0.3, 0.0), at(0.35, 2.0), at(0.4, 60.0)]);
    assert!(bench.value < tapped - 5.0, "{}", bench.value);
}
