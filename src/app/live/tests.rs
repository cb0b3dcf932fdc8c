//! The live run against the ordinary one, through changes, kicks and ends.

use std::f64::consts::TAU;

use super::*;
use crate::app::bench::{Bench, shaking};
use crate::app::view::Tab;
use crate::dynamics::{Ongoing, Settings, Trajectory};
use crate::model::{ForceLaw, Parameter};

/// A frame (s).
const FRAME: f64 = 1.0 / 60.0;

fn view(parameters: ParameterSet, force: ForceLaw) -> View {
    let model = ModelChoice { force, ..Default::default() };
    let mut view = View { tab: Tab::Live, ..View::default() };
    view.scenario = Scenario { parameters, model, ..Scenario::default() };
    view
}

fn figure_9() -> ParameterSet {
    ParameterSet { alpha: 1e-4, beta: 1e-2, omega: 8.0969, ..Default::default() }
}

/// A page with its clock.
struct Page {
    live: Live,
    view: View,
    clock: f64,
}

impl Page {
    fn new(view: View) -> Self {
        let mut page = Self { live: Live::default(), view, clock: 0.0 };
        // The first frame only starts the clock.
        page.live.frame(0.0, (&page.view, true), true);
        page
    }

    fn frames(&mut self, count: usize) -> bool {
        (0..count).fold(false, |_, _| {
            self.clock += FRAME;
            self.live.frame(self.clock, (&self.view, true), self.view.tab == Tab::Live)
        })
    }

    fn act(&mut self, action: LiveAction) {
        self.live.act(action, &self.view, &Session::default());
    }

    fn state(&self) -> Vec<f64> {
        self.live.now().expect("a run").1.to_vec()
    }

    fn sample(&self) -> Sample {
        self.live.now().expect("a run").2
    }
}

#[test]
fn with_constant_numbers_it_is_the_ordinary_run() {
    for force in [ForceLaw::Quadratic, ForceLaw::Exact] {
        let mut page = Page::new(view(figure_9(), force));
        let (system, start) = page.view.scenario.validate().expect("a valid scenario");
        let whole = Trajectory::compute(&system, &start, 60.0, Settings::default()).expect("a run");
        let compare = |sample: &Sample, state: &[f64]| {
            let (exact, [v, dv_dt, tip, velocity]) = (whole.state_at(sample.time), sample.values);
            let near = |value: f64, exact: f64, size: f64| (value - exact).abs() < 1e-10 * size;
            assert!(near(v, exact[4], 20.0), "{force:?} at {}: {v} {}", sample.time, exact[4]);
            assert!(near(dv_dt, system.voltage_rate(&exact), 200.0));
            assert!(near(tip, system.tip_displacement(&exact), 0.1));
            assert!(near(velocity, system.tip_velocity(&exact), 1.0));
            assert!(state.is_empty() || state.iter().zip(&exact).all(|(a, b)| near(*a, *b, 20.0)));
        };
        for speed in [0.05, 2.0, 37.0, 0.7] {
            page.view.live.speed = speed;
            assert!(page.frames(60));
            compare(&page.sample(), &page.state());
        }
        let trail = &page.live.trail;
        assert!(trail.samples.len() > 39 * 64 && trail.strobe.len() == 40, "{}", trail.strobe.len());
        trail.samples.iter().for_each(|sample| compare(sample, &[]));
        for (k, sample) in trail.strobe.iter().enumerate() {
            assert_eq!(sample.turns, k as f64);
            assert!(
                (sample.time - k as f64 * system.parameters.period()).abs() < 1e-12 * (1.0 + sample.time)
            );
        }
    }
}

#[test]
fn means_are_those_of_the_last_whole_periods() {
    let mut page = Page::new(view(figure_9(), ForceLaw::Quadratic));
    page.view.live.speed = 100.0;
    page.frames(480);
    let (v_rms, power, periods) = page.live.trail.means().expect("whole periods");
    let (system, start) = page.view.scenario.validate().expect("a valid scenario");
    let end = page.sample().turns.floor() * system.parameters.period();
    let run = Trajectory::compute(&system, &start, end + 1.0, Settings::default()).expect("a run");
    let (from, mut square) = (end - 8.0 * system.parameters.period(), 0.0);
    let (count, mut index) = (8000, 0);
    run.sample(from, end, count + 1, |_, state| {
        let weight = if index == 0 || index == count { 0.5 } else { 1.0 };
        square += weight * state[4] * state[4] / count as f64;
        index += 1;
    });
    let expected = f64::sqrt(square);
    assert!((v_rms / expected - 1.0).abs() < 1e-6 && v_rms > 14.0, "{v_rms} {expected}");
    assert!((power / (1e-6 * v_rms * v_rms) - 1.0).abs() < 1e-12);
    assert_eq!(periods, 8);
}

#[test]
fn state_and_phase_go_on_when_a_number_changes() {
    let mut page = Page::new(view(figure_9(), ForceLaw::Exact));
    page.view.live.speed = 3.3;
    page.frames(100);
    let mut expected = page.sample();
    for (k, parameter) in Parameter::ALL.into_iter().cycle().take(30).enumerate() {
        let (state, before) = (page.state(), page.sample());
        *page.view.scenario.parameters.get_mut(parameter) *= if k % 2 == 0 { 1.03 } else { 0.98 };
        // A frame of no length takes the numbers over and nothing else.
        page.live.frame(page.clock, (&page.view, true), page.view.tab == Tab::Live);
        let after = page.sample();
        assert_eq!((page.state(), after.turns), (state.clone(), before.turns), "{parameter:?}");
        assert!((after.time - before.time).abs() < 1e-12 * after.time);
        let system = page.live.now().expect("a run").0.clone();
        assert_eq!(*system.parameters, page.view.scenario.parameters);
        // The phase by its closed form: turns at the speed of the page, time at the period of the moment.
        page.frames(1);
        let turns = page.view.live.speed * FRAME;
        expected.turns += turns;
        expected.time += turns * system.parameters.period();
        let sample = page.sample();
        assert!((sample.turns - expected.turns).abs() < 1e-12 * expected.turns);
        assert!((sample.time - expected.time).abs() < 1e-12 * expected.time);
        // And it is the phase that acts on the beam: by the equations of motion at the state before.
        let mut slope = vec![0.0; 5];
        let rest = system.rest_force().rest(system.tip_displacement(&state));
        system.derivative(&state, rest, (TAU * before.turns).sin(), &mut slope);
        let mut run =
            LiveRun::begin(system.clone(), Drive::Sine, state.clone(), before.turns, 0.0).expect("a state");
        let step = 1e-5 / system.parameters.period();
        assert_eq!(run.go_to(before.turns + step), Ok(Reach::There));
        for i in 0..5 {
            let measured = (run.state()[i] - state[i]) / 1e-5;
            let close = 2e-3 * (1.0 + slope[i].abs());
            assert!((measured - slope[i]).abs() < close, "{parameter:?} {i}: {measured} {}", slope[i]);
        }
    }
}

#[test]
fn modes_can_come_and_go_on_the_way() {
    let mut page = Page::new(view(figure_9(), ForceLaw::Exact));
    page.frames(200);
    let before = page.state();
    page.view.scenario.set_modes(4);
    page.live.frame(page.clock, (&page.view, true), page.view.tab == Tab::Live);
    let state = page.state();
    assert_eq!((&state[..2], &state[4..6], state[8]), (&before[..2], &before[2..4], before[4]));
    assert_eq!((&state[2..4], &state[6..8]), (&[0.0; 2][..], &[0.0; 2][..]));
    assert!(page.frames(100));
    page.view.scenario.set_modes(1);
    assert!(page.frames(100) && page.state().len() == 3);
}

#[test]
fn a_kick_changes_one_velocity_by_what_is_said() {
    let mut page = Page::new(view(figure_9(), ForceLaw::Quadratic));
    page.frames(100);
    let (before, at) = (page.state(), page.sample());
    let system = page.live.now().expect("a run").0.clone();
    page.act(LiveAction::Kick(-1.0));
    // A fifth of the gap of 0.16945 at 4.04845, the paper's first frequency.
    let said = kick(&page.view.live, &system);
    assert!((said - 0.2 * 0.169450341372524 * 4.04845139686289).abs() < 1e-9, "{said}");
    let mut expected = before;
    expected[2] -= said;
    assert_eq!((page.state(), page.sample().turns), (expected, at.turns));
    assert!(page.frames(10));
}

#[test]
fn an_escape_is_told_and_a_new_start_goes_on() {
    // Figure 12.
    let set = ParameterSet { alpha: 1e-4, beta: 1e-2, omega: 42.7125, ..Default::default() };
    let mut page = Page::new(view(set, ForceLaw::Quadratic));
    page.view.live.speed = 20.0;
    assert!(!page.frames(200));
    let ended = page.live.ended.clone();
    assert!(
        matches!(ended, Some(End::Outcome(Outcome::Escaped { time })) if (1.0..4.0).contains(&time)),
        "{ended:?}"
    );
    let trail = &page.live.trail;
    assert!(trail.samples.iter().all(|sample| sample.values.iter().all(|value| value.is_finite())));
    assert!(trail.samples.iter().all(|sample| sample.values[2].abs() <= curves::SIGHT));
    // Nothing goes on, whatever is pressed; other numbers wait for the new start.
    for action in [LiveAction::Kick(1.0), LiveAction::StepPeriod, LiveAction::Clear, LiveAction::Toggle] {
        page.act(action);
        assert!(!page.frames(2));
    }
    page.view.scenario.parameters = figure_9();
    assert!(!page.frames(2) && page.live.ended == ended);
    page.act(LiveAction::FromRest);
    assert!(page.live.running && page.live.ended.is_none() && page.state() == [0.0; 5]);
    assert!(page.frames(60));
    assert_eq!(*page.live.now().expect("a run").0.parameters, figure_9());
}

#[test]
fn a_device_that_is_none_is_refused_and_the_run_goes_on() {
    let mut page = Page::new(view(figure_9(), ForceLaw::Quadratic));
    page.frames(10);
    page.view.scenario.parameters.c0 = -5.0;
    assert!(page.frames(10));
    assert!(page.live.refusal.as_ref().is_some_and(|reason| reason.to_string().contains("attract")));
    page.view.scenario.parameters.c0 = 0.5;
    assert!(page.frames(1) && page.live.refusal.is_none());
    // Also at the start.
    let mut set = figure_9();
    set.c0 = -5.0;
    let mut page = Page::new(view(set, ForceLaw::Quadratic));
    assert!(!page.frames(3) && page.live.refusal.is_some() && page.live.now().is_none());
    page.view.scenario.parameters = figure_9();
    assert!(page.frames(3) && page.live.refusal.is_none());
}

#[test]
fn pause_and_steps_go_as_far_as_they_say() {
    let mut page = Page::new(view(figure_9(), ForceLaw::Quadratic));
    page.frames(30);
    page.act(LiveAction::Toggle);
    let before = page.sample().turns;
    assert!(!page.frames(5));
    assert_eq!(page.sample().turns, before);
    page.act(LiveAction::StepPeriod);
    assert!(!page.frames(5));
    assert_eq!(page.sample().turns, before + 1.0);
    page.act(LiveAction::StepFrame);
    page.frames(5);
    assert!((page.sample().turns - before - 1.0 - 2.0 / 60.0).abs() < 1e-12);
    // Behind another tab it stands still, and does not make up for it.
    page.act(LiveAction::Toggle);
    page.view.tab = Tab::Explore;
    assert!(!page.frames(100));
    page.view.tab = Tab::Live;
    let before = page.sample().turns;
    page.frames(1);
    assert_eq!(page.sample().turns, before);
    page.clock += 30.0;
    page.frames(1);
    assert!((page.sample().turns - before - 2.0 * LONGEST_FRAME).abs() < 1e-9);
}

/// Not a check of the machine: what a change costs is printed, and must leave room in a frame by an order of magnitude.
#[test]
fn a_change_of_numbers_is_cheap_enough_for_every_frame() {
    for (modes, law) in [(2, ForceLaw::Quadratic), (4, ForceLaw::Exact), (8, ForceLaw::Exact)] {
        let mut view = view(figure_9(), law);
        view.scenario.model.modes = modes;
        let mut page = Page::new(view);
        for parameter in [Parameter::Omega, Parameter::D] {
            let begun = milliseconds();
            for k in 0..100 {
                *page.view.scenario.parameters.get_mut(parameter) *= if k % 2 == 0 { 1.01 } else { 0.99 };
                page.frames(1);
            }
            let each = 0.01 * (milliseconds() - begun);
            println!("{modes} modes, {law:?}, {parameter:?}: {each:.3} ms a change and frame");
            assert!(each < 60.0, "{modes} {law:?} {parameter:?}: {each} ms");
        }
    }
}

#[test]
fn under_noise_it_is_the_run_of_the_integrator_and_goes_on_through_changes() {
    let mut view = view(ParameterSet { alpha: 5e-3, ..figure_9() }, ForceLaw::Exact);
    view.design.shake.everywhere = true;
    view.live.speed = 20.0;
    let bench = Bench::default();
    let motion = |view: &View| shaking::live(view, &bench);
    let mut live = Live::default();
    let mut clock = 0.0;
    let mut frames = |live: &mut Live, view: &View, count: usize| {
        for _ in 0..count {
            live.shake(motion(view), &view.scenario);
            live.frame(clock, (view, true), true);
            clock += FRAME;
        }
    };
    frames(&mut live, &view, 40);
    let (system, state, now) = live.now().expect("a run");
    let shaking = Shaking::of(motion(&view).expect("noise"), view.scenario.units()).expect("a signal");
    let mut whole = Ongoing::under(system, (shaking.signal.clone(), 0), &[0.0; 5]).expect("from rest");
    let mut expected = [0.0; 5];
    while whole.read(now.time, 1000, &mut expected) == Ok(Reach::Later) {}
    let near = |a: &[f64], b: &[f64]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-9 * (1.0 + b.abs()));
    assert!(near(state, &expected) && now.turns > 10.0 && expected[4].abs() > 0.0, "{state:?} {expected:?}");
    // A motion that begins anew at a sample is the whole one: a kick of nothing changes nothing.
    let mut run =
        LiveRun::begin(system.clone(), Drive::Signal(shaking.signal.clone(), 0), vec![0.0; 5], 0.0, 0.0)
            .expect("from rest");
    for turns in [3.217, 7.9, now.turns] {
        while run.go_to(turns) == Ok(Reach::Later) {}
        run.kick(0.0).expect("a motion");
    }
    let mut again = [0.0; 5];
    let mut whole = Ongoing::under(system, (shaking.signal.clone(), 0), &[0.0; 5]).expect("from rest");
    while whole.read(run.time(), 1000, &mut again) == Ok(Reach::Later) {}
    assert!(run.time() >= now.time && near(run.state(), &again), "{:?} {again:?}", run.state());
    // A softer noise goes on where the other was, up to a sample.
    let (_, before) = live.shaken().expect("shaken");
    view.design.shake.level *= 0.5;
    live.shake(motion(&view), &view.scenario);
    let (shaking, after) = live.shaken().expect("shaken");
    assert!(
        (0.0..=1.001 * shaking.signal.interval() * shaking.units.time).contains(&(after - before)),
        "{before} {after}"
    );
    // It begins anew where it ends, with the motion as it is.
    view.live.speed = 200.0;
    let mut places = Vec::new();
    for _ in 0..160 {
        frames(&mut live, &view, 1);
        places.push(live.shaken().expect("shaken").1);
    }
    assert!(live.ended.is_none() && places.windows(2).any(|pair| pair[1] < pair[0]), "{places:?}");
    let turns = live.turns();
    assert!(turns > 400.0 && live.trail.samples.len() > 1000);
    // Kicked, it goes on from the next sample; with the sine again it starts afresh.
    live.act(LiveAction::Kick(1.0), &view, &Session::default());
    frames(&mut live, &view, 2);
    assert!(live.ended.is_none() && live.turns() > turns);
    view.design.shake.everywhere = false;
    frames(&mut live, &view, 2);
    assert!(live.shaken().is_none() && live.turns() < 10.0);
}
