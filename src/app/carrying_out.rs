//! What each command changes: the one place that changes anything.

use std::rc::Rc;

use super::bench::variant::{self, Change, Variant};
use super::command::Command;
use super::errand::Errand;
use super::text::{fill, tr};
use super::view::MapWindow;
use super::{App, bench, exporting, figures};
use crate::scenario::Scenario;

impl App {
    /// Carries out a command; [`Self::step`] makes a step of it.
    pub(super) fn carry_out(&mut self, command: Command) {
        match command {
            Command::Show(scenario) => self.show(*scenario),
            Command::OpenTab(tab) => {
                self.view.tab = tab;
                self.view.enlarged = None;
            }
            Command::LookAt(window) => self.look_at(window),
            Command::Chart(layer) => self.view.layer = layer,
            Command::Sweep(sweep) => self.view.sweep = sweep,
            Command::OpenPlane(plane) => self.view.plane = plane,
            Command::Design(design) => self.view.design = *design,
            Command::LookLive(live) => self.view.live = live,
            Command::Live(action) => {
                self.live.act(action, &self.view, &self.session);
                if !self.live.sounds() {
                    self.errands.push(Errand::Sound(Vec::new()));
                }
            }
            Command::Adopt(Ok(scenario)) => self.show(*scenario),
            Command::Adopt(Err(reason)) => self.bench.refusal = Some(reason),
            Command::Lesson(action) => self.follow_lesson(action),
            Command::Find(begin) => {
                let question = begin.then(|| bench::questions::find(&self.view, &self.session));
                let begun = self.crew.borrow_mut().studies.search(question, &self.view);
                self.bench.refusal = begun.err();
            }
            Command::Shake(on) => self.crew.borrow_mut().studies.shake(on),
            Command::Measure(wanted, Some(reading)) => self.bench.file_of(wanted).read(reading),
            Command::Measure(wanted, None) => {
                *self.bench.file_of(wanted) = bench::measured::Measured::of(wanted);
            }
            Command::Fit => {
                let asked =
                    self.bench.measured.file.as_ref().map(|file| bench::measured::fit(file, &self.view));
                self.bench.refusal = asked.and_then(|asked| self.crew.borrow_mut().studies.fit(asked).err());
            }
            Command::MeasureRun => {
                if let Some(shown) = &self.session.shown {
                    self.bench.measured.open("run.csv", bench::measured::record(shown).into_bytes());
                }
            }
            Command::RecordNoise => {
                if let Some(text) = bench::shaking::noise_as_recorded(&self.view) {
                    self.bench.vibration.open("noise.csv", text.into_bytes());
                }
            }
            Command::LoadFigure(number) => self.load_figure(number),
            Command::Enlarge(panel) => self.view.enlarged = panel,
            Command::Pin(keep) => self.session.pin(keep),
            Command::Variant(change) => self.vary(change),
            Command::SetDark(dark) => self.view.dark = Some(dark),
            Command::Speak(language) => self.view.language = Some(language),
            Command::SetContrast(contrast) => self.view.contrast = Some(contrast),
            Command::FollowSystem => (self.view.dark, self.view.contrast) = (None, None),
            Command::SetProjector(large) => self.view.projector = large,
            Command::MoveBeam(moves) => self.view.beam_moves = Some(moves),
            Command::DismissNotice => self.notice = None,
            Command::Undo => self.undo(),
            Command::Redo => self.redo(),
            Command::SaveFile => self.save_file(),
            Command::Export(title, format) => self.exports.push((title, format)),
            Command::Report => self.save_report(),
            Command::OpenFile => self.errands.push(Errand::Open),
            Command::FullScreen => self.errands.push(Errand::FullScreen),
            Command::Record(Some((title, part))) if !self.records => {
                self.records = true;
                self.errands.push(Errand::Record(exporting::file_name(&title), part));
            }
            Command::Record(_) => self.stop_recording(),
        }
    }

    /// Changes the pinned variants.
    fn vary(&mut self, change: Change) {
        let mut variants = self.bench.variants.to_vec();
        match change {
            Change::Pin => {
                let present = Variant::present(&self.view, &self.session, &self.crew.borrow().studies);
                let Some((mut present, _)) = present.filter(|(_, all)| *all) else {
                    return self.tell(tr(
                        "There is nothing to pin yet: the curves of the page Harvest are not computed.",
                    ));
                };
                if let Some(same) = variants.iter().find(|one| one.is_same(&present)) {
                    let text = fill("This design is pinned already, as {name}.", &[("name", &same.name)]);
                    return self.tell(&text);
                }
                if variants.len() >= variant::MOST {
                    return self
                        .tell(&fill("{most} designs are pinned already.", &[("most", &variant::MOST)]));
                }
                present.name = variant::free_name(&variants);
                variants.push(present);
            }
            Change::Remove(index) if index < variants.len() => {
                variants.remove(index);
            }
            Change::Rename(index, name) => {
                if let Some(variant) = variants.get_mut(index) {
                    variant.name = name.chars().take(variant::LETTERS).collect();
                }
            }
            Change::Restore(index) => {
                if let Some(variant) = variants.get(index) {
                    self.view.design.holds_acceleration = variant.holds_acceleration;
                    self.show(variant.scenario.clone());
                }
                return;
            }
            Change::Remove(_) => return,
        }
        self.bench.variants = Rc::new(variants);
    }

    fn stop_recording(&mut self) {
        self.records = false;
        self.errands.push(Errand::StopRecording);
    }

    /// Says that no clip has begun.
    pub fn recording_failed(&mut self) {
        self.records = false;
        self.tell("This browser could not record the page.");
    }

    /// Computes and shows `scenario`; the window of the map follows it.
    pub(super) fn show(&mut self, scenario: Scenario) {
        self.bench.refusal = None;
        if self.view.scenario.model != scenario.model {
            self.bench.before = self.view.scenario.model;
        }
        self.session.ask(&scenario);
        if let Some(boundaries) = &self.session.boundaries {
            self.view.map = boundaries.follow(self.view.map, scenario.parameters.omega);
        }
        self.view.scenario = scenario;
    }

    /// Opens a window of the map; a point outside of it comes along.
    fn look_at(&mut self, window: MapWindow) {
        self.view.map = window;
        let Some(boundaries) = &self.session.boundaries else { return };
        let (low, high) = boundaries.range(window);
        let omega = self.view.scenario.parameters.omega;
        if let Some(tongue) = window.resonance().and_then(|resonance| boundaries.tongue(resonance))
            && !(low..=high).contains(&omega)
        {
            let mut scenario = self.view.scenario.clone();
            scenario.parameters.omega = tongue.published_frequency;
            self.show(scenario);
        }
    }

    fn load_figure(&mut self, number: u8) {
        self.view.figure = number;
        let Some(figure) = figures::figure(number) else { return };
        self.view.design.shake.everywhere = false;
        if let Some(scenario) = figure.scenario() {
            self.view.map = figure.resonance().map_or(self.view.map, MapWindow::about);
            self.show(scenario);
        }
    }
}
