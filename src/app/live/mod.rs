//! The Live tab's run: time goes on with the numbers in view while the page shows it.
//!
//! `App::ui` lets `live::Live` go on by the time since the last frame, for at most 6 ms; what cannot be kept is told,
//! not made up for. It counts excitation periods, `turns`: the phase is 2π `turns` and stays continuous when the
//! frequency changes. Every read (64 samples a period, those of the sound, the end of the frame) is dense output of
//! `dynamics::Ongoing`, which is the integrator with its present step. A changed number or a kick begins another one
//! at the last state and phase (`Collocation::from_phase`); its tables take 0.1 ms for two modes, 0.7 ms for eight
//! with another structure, so every frame of a drag has its own. Modal coordinates are carried over as they are, also
//! when the equilibrium moves.
//!
//! Only what is looked at (`view::live`) is stored, linked and undone; the run is not. While the hand moves, the
//! ordinary run of the other tabs waits. Where anything but the sine shakes the base (`live::shaking`), `turns` counts periods of
//! the first natural frequency, and a motion begins at a sample of the signal. Sound is made as samples in Rust and played by `assets/shell/sound.js` piece
//! by piece; each ends in a fade that the next one takes back, so that a late or a last piece does not click.

mod action;
mod run;
mod shaking;
mod sound;
mod trail;

#[cfg(test)]
mod tests;

use super::clock::milliseconds;
use super::curves;
use super::session::Session;
use super::view::View;
use super::view::live::LiveView;
use crate::dynamics::{IntegrationError, Outcome, Reach};
use crate::model::base_motion::BaseMotion;
use crate::model::{ModelError, ParameterSet, ReducedSystem};
use crate::scenario::{ModelChoice, Scenario};
use crate::sentence::Sentence;
use run::{Drive, LiveRun};
pub(super) use shaking::Shaking;
use sound::Sound;

pub(super) use action::{End, LiveAction};
#[cfg(target_arch = "wasm32")]
pub(super) use sound::RATE;
pub(super) use trail::{Sample, Trail};

/// Time that a frame may spend on the run.
const BUDGET_MS: f64 = 6.0;
/// Reads between looks at the clock.
const READS: usize = 16;
/// Time (s) that a frame counts for at most: a page that was hidden does not make up for it.
const LONGEST_FRAME: f64 = 0.1;
/// Frames a second that a step of one frame stands for.
const FRAMES: f64 = 60.0;
/// Time (s) over which the speed reached is averaged.
const AVERAGED: f64 = 0.5;
/// Part of the speed asked for below which it counts as not kept.
const KEPT: f64 = 0.9;
/// Excitation periods in the phase portrait.
pub(super) const PORTRAIT: f64 = 16.0;

/// The run with all that is shown of it.
#[derive(Default)]
pub(super) struct Live {
    run: Option<LiveRun>,
    /// The numbers that it follows.
    followed: Option<(ParameterSet, ModelChoice)>,
    /// What shakes it in place of the sine.
    shaking: Option<Shaking>,
    /// Why the numbers in view are not those of the run.
    pub refusal: Option<Sentence>,
    pub ended: Option<End>,
    pub running: bool,
    pub trail: Trail,
    /// Turns at which a step ends.
    goal: Option<f64>,
    /// Time of the last frame (s).
    clock: Option<f64>,
    /// Speed reached (excitation periods a second), averaged.
    reached: Option<f64>,
    sound: Option<Sound>,
    /// Mode shapes along the beam.
    pub shapes: Vec<Vec<f64>>,
}

impl Live {
    /// The system that runs, its state and where it stands.
    pub(super) fn now(&self) -> Option<(&ReducedSystem, &[f64], Sample)> {
        self.run.as_ref().map(|run| (run.system(), run.state(), Sample::of(run)))
    }

    /// What plots show as the present: of a run that ended early, the last that is in sight.
    pub(super) fn present(&self) -> Option<Sample> {
        match self.ended {
            Some(End::Outcome(_)) => self.trail.samples.back().copied(),
            _ => self.run.as_ref().map(Sample::of),
        }
    }

    /// Whether the voltage is to be heard.
    pub(super) fn sounds(&self) -> bool {
        self.sound.is_some()
    }

    /// The speed reached where it is less than the one asked for.
    pub(super) fn slower_than(&self, speed: f64) -> Option<f64> {
        self.reached.filter(|reached| self.running && self.ended.is_none() && *reached < KEPT * speed)
    }

    /// A piece of sound, when one is ready.
    pub(super) fn chunk(&mut self) -> Option<Vec<f32>> {
        self.sound.as_mut()?.chunk()
    }

    /// Has the base shaken by `motion` from now on, by the sine without one.
    pub(super) fn shake(&mut self, motion: Option<BaseMotion>, scenario: &Scenario) {
        let units = scenario.units();
        if self.shaking.as_ref().map(|shaking| (&shaking.motion, shaking.units))
            == motion.as_ref().map(|motion| (motion, units))
        {
            return;
        }
        let by_sine = self.shaking.is_none() || motion.is_none();
        self.shaking = match motion.map(|motion| Shaking::of(motion, units)).transpose() {
            Ok(shaking) => shaking,
            Err(error) => return self.refuse(&error),
        };
        self.refusal = None;
        if by_sine || self.ended.is_some() {
            // Another kind of time: periods are others.
            (self.run, self.followed, self.ended) = (None, None, None);
        } else if let Some(run) = &mut self.run {
            let signal = self.shaking.as_ref().map(|shaking| shaking.signal.clone());
            let system = run.system().clone();
            let adopted = run.adopt(system, signal);
            self.note(adopted);
        }
    }

    /// What shakes the base in place of the sine, and the time (s) reached in it.
    pub(super) fn shaken(&self) -> Option<(&Shaking, f64)> {
        let shaking = self.shaking.as_ref()?;
        let (_, place) = self.run.as_ref()?.signal()?;
        Some((shaking, place * shaking.units.time))
    }

    /// The period (dimensionless) by which the run counts.
    pub(super) fn period(&self) -> Option<f64> {
        self.run.as_ref().map(LiveRun::period)
    }

    /// Goes on by the time since the last frame, where it is `in_sight`, begun running where the page `moves`; `now` is the page's clock (s). Whether it goes on
    /// in the next frame.
    pub(super) fn frame(&mut self, now: f64, (view, moves): (&View, bool), in_sight: bool) -> bool {
        if !in_sight {
            (self.clock, self.reached) = (None, None);
            return false;
        }
        let passed = self.clock.replace(now).map_or(0.0, |before| (now - before).clamp(0.0, LONGEST_FRAME));
        let wanted = Some((view.scenario.parameters, view.scenario.model));
        if self.run.is_none() && self.ended.is_none() && self.followed != wanted {
            self.running = moves;
            let start = view.scenario.initial.clone();
            self.start(&view.scenario, start, 0.0, 0.0);
        }
        self.follow(&view.scenario);
        let speed = view.live.speed;
        let from = self.turns();
        let goal = if self.running { Some(from + speed * passed) } else { self.goal };
        if let Some(goal) = goal.filter(|goal| *goal > from && self.ended.is_none()) {
            self.advance(goal, speed);
        }
        if !self.running && self.goal.is_some_and(|goal| self.turns() >= goal) {
            self.goal = None;
        }
        if self.running && passed > 0.0 {
            let speed = (self.turns() - from) / passed;
            let before = self.reached.unwrap_or(speed);
            self.reached = Some(before + (speed - before) * (passed / AVERAGED).min(1.0));
        }
        let window = (2 * view.live.periods) as f64;
        self.trail.fit(self.turns() - window.max(PORTRAIT));
        self.run.is_some() && self.ended.is_none() && (self.running || self.goal.is_some())
    }

    /// Does what the user wants.
    pub(super) fn act(&mut self, action: LiveAction, view: &View, session: &Session) {
        match action {
            // Nothing drives a run that has ended.
            LiveAction::Toggle | LiveAction::StepPeriod | LiveAction::StepFrame | LiveAction::Kick(_)
                if self.ended.is_some() => {}
            LiveAction::Toggle => {
                (self.running, self.goal, self.reached) = (!self.running, None, None);
            }
            LiveAction::StepPeriod => self.step(1.0),
            LiveAction::StepFrame => self.step(view.live.speed / FRAMES),
            LiveAction::Kick(way) => {
                if let Some(run) = &mut self.run {
                    let velocity = way * kick(&view.live, run.system());
                    let kicked = run.kick(velocity);
                    self.trail.kick(run);
                    self.note(kicked);
                }
            }
            LiveAction::FromRest => self.start(&view.scenario, None, 0.0, 0.0),
            LiveAction::FromSettled => {
                if let Some((state, turns, time)) = settled(view, session) {
                    self.start(&view.scenario, Some(state.to_vec()), turns, time);
                }
            }
            LiveAction::Clear => self.trail.clear(),
            LiveAction::Sound => {
                self.sound =
                    if self.sounds() { None } else { Some(Sound::new(self.turns(), self.trail.scales[0])) };
            }
        }
    }

    fn turns(&self) -> f64 {
        self.run.as_ref().map_or(0.0, LiveRun::turns)
    }

    fn step(&mut self, turns: f64) {
        self.running = false;
        self.goal = Some(self.turns() + turns);
    }

    /// Begins anew with the numbers of `scenario`, from rest without a `state`.
    fn start(&mut self, scenario: &Scenario, state: Option<Vec<f64>>, turns: f64, time: f64) {
        self.running |= self.ended.is_some();
        (self.ended, self.refusal, self.goal) = (None, None, None);
        self.trail = Trail::begin(turns);
        self.followed = Some((scenario.parameters, scenario.model));
        match scenario.model.system(scenario.parameters) {
            Ok(system) => {
                let state = state.unwrap_or_else(|| vec![0.0; system.dimension()]);
                self.shapes = curves::shapes(&system);
                let drive = self
                    .shaking
                    .as_ref()
                    .map_or(Drive::Sine, |shaking| Drive::Signal(shaking.signal.clone(), 0));
                let begun = LiveRun::begin(system, drive, state, turns, time);
                let begun = begun.map(|run| self.run = Some(run));
                self.note(begun);
            }
            Err(error) => {
                self.run = None;
                self.refuse(&error);
            }
        }
    }

    /// Takes over the numbers of `scenario` if they are others.
    fn follow(&mut self, scenario: &Scenario) {
        let wanted = (scenario.parameters, scenario.model);
        if self.followed.as_ref() == Some(&wanted) || self.ended.is_some() {
            return;
        }
        self.followed = Some(wanted);
        let Some(run) = &mut self.run else { return };
        let system = run.system();
        let same_model = ModelChoice::of(system) == scenario.model;
        let made = if same_model {
            system.with_numbers(scenario.parameters)
        } else {
            scenario.model.system(scenario.parameters)
        };
        match made {
            Ok(system) => {
                self.refusal = None;
                self.shapes = curves::shapes(&system);
                self.trail.change(run.turns(), system.dimension());
                let adopted = run.adopt(system, None);
                self.note(adopted);
            }
            Err(error) => self.refuse(&error),
        }
    }

    fn refuse(&mut self, error: &ModelError) {
        self.refusal = Some(error.into());
    }

    fn note(&mut self, done: Result<(), IntegrationError>) {
        if let Err(error) = done {
            self.ended = Some(End::Failed(error.into()));
        }
    }

    /// Goes on to `goal`, or as far as a frame's time reaches, and takes samples on the way.
    fn advance(&mut self, goal: f64, speed: f64) {
        let Some(run) = &mut self.run else { return };
        let begun = milliseconds();
        let mut sound = self.sound.as_mut().filter(|_| self.running);
        if let Some(sound) = &mut sound {
            sound.tune(run.turns(), speed);
        }
        for reads in 1.. {
            let sampled = self.trail.due();
            let heard = sound.as_ref().map_or(f64::INFINITY, |sound| sound.due);
            let next = sampled.min(heard).min(goal);
            match run.go_to(next) {
                Ok(Reach::There) => {
                    if sampled <= next {
                        self.trail.take(run);
                    }
                    if let Some(sound) = sound.as_mut().filter(|_| heard <= next) {
                        sound.take(run.reading()[0]);
                    }
                    if next >= goal {
                        return;
                    }
                }
                Ok(Reach::Later) => {}
                Ok(Reach::Ended(outcome)) => {
                    self.trail.cut(curves::SIGHT);
                    self.ended = Some(End::Outcome(outcome));
                    return;
                }
                Err(error) => {
                    self.ended = Some(End::Failed(error.into()));
                    return;
                }
            }
            if reads % READS == 0 && milliseconds() - begun > BUDGET_MS {
                return;
            }
        }
    }
}

/// The velocity (beam lengths per dimensionless time) by which a kick of `live` changes mode 1: that with which it alone,
/// without damping, would swing out to the part of the gap asked for.
pub(super) fn kick(live: &LiveView, system: &ReducedSystem) -> f64 {
    let frequency = system.modes.iter().next().map_or(0.0, |mode| mode.omega);
    live.kick * system.equilibrium.gap * frequency
}

/// Where the run of the other tabs has settled, with its turns and its time, when it belongs to the numbers in view.
pub(super) fn settled<'a>(view: &View, session: &'a Session) -> Option<(&'a [f64], f64, f64)> {
    let by_sine = !view.design.shake.everywhere;
    let shown = session.shown.as_ref().filter(|shown| by_sine && shown.scenario == view.scenario)?;
    let run = Some(&shown.run).filter(|run| run.outcome() == Outcome::Completed)?;
    let time = run.trajectory.end_time();
    Some((run.trajectory.final_state(), time / run.system.parameters.period(), time))
}
