//! A run with a full-wave rectifier and a store held at a voltage in place of the load.
//!
//! Two linear parts take turns. While |v| is below the threshold, the store's voltage and the drops of two diodes, the
//! circuit is open but for the dielectric loss. When |v| reaches it the voltage stays there, and the current of the beam,
//! sum of theta_n dq_n/dt - kappa v, flows to the store until it reverses. Both parts are carried exactly as in
//! [`super::collocation`]; a step ends where the circuit switches, at a root on its dense output, so that the
//! instant is as accurate as the motion.
//!
//! The charge that flows is a difference of displacements and needs no quadrature.
//!
//! Reference: Shu & Lien, Smart Mater. Struct. 15, 1499 (2006), for the two intervals of a half cycle.

use super::collocation::{Collocation, Settings};
use super::outcome::{IntegrationError, Outcome};
use super::propagator::{StepRest, Workspace};
use super::step::Step;
use crate::model::ReducedSystem;
use crate::model::energy::powers;
use crate::model::quadrature::gauss_legendre;

/// Tolerance of the runs: what is read within a step is as accurate as this.
const TOLERANCE: f64 = 1e-10;
/// Looks at the circuit in a vibration of the fastest mode.
const LOOKS: f64 = 12.0;
/// Nodes of the quadrature between two looks.
const NODES_BETWEEN: usize = 5;
/// Most switchings in an excitation period; more do not resolve.
const MOST_SWITCHINGS: usize = 4096;
/// Most evaluations that locate a switching.
const ROOT_STEPS: usize = 100;
/// Part of the threshold, or of the largest current, that is rounding.
const ROUNDING: f64 = 1e-13;

/// What the circuit does.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Circuit {
    /// The diodes block.
    Open,
    /// The store is charged by the voltage of this sign.
    Charging(f64),
}

/// A run of the rectified device, period by period.
#[derive(Debug, Clone)]
pub struct RectifiedRun {
    system: ReducedSystem,
    threshold: f64,
    open: Collocation,
    clamped: Collocation,
    circuit: Circuit,
    state: Vec<f64>,
    periods: u64,
    /// Switchings of the circuit since it began.
    switchings: usize,
    /// Longest time between two looks at the circuit.
    look: f64,
    largest_current: f64,
    scratch: Scratch,
}

/// Vectors that are used again.
#[derive(Debug, Clone, Default)]
struct Scratch {
    workspace: Workspace,
    rate: Vec<f64>,
}

/// What was read in a run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RectifiedTotals {
    /// Time (dimensionless).
    pub duration: f64,
    /// Charge into the store (power unit times time unit per volt).
    pub charge: f64,
    /// Work of the shaken base, of the viscous damping and of the conductance left in the circuit (dimensionless).
    pub input: f64,
    /// See `input`.
    pub viscous: f64,
    /// See `input`.
    pub dielectric: f64,
    /// Integral of v^2 (V^2 times time).
    pub square: f64,
    /// Largest |v| (V).
    pub v_peak: f64,
    /// Lowest and highest tip displacement (beam lengths).
    pub tip: (f64, f64),
    /// Largest |slope| at the tip (rad).
    pub slope: f64,
    /// Times at which the circuit switched.
    pub switchings: usize,
}

impl Default for RectifiedTotals {
    fn default() -> Self {
        Self {
            duration: 0.0,
            charge: 0.0,
            input: 0.0,
            viscous: 0.0,
            dielectric: 0.0,
            square: 0.0,
            v_peak: 0.0,
            tip: (f64::INFINITY, f64::NEG_INFINITY),
            slope: 0.0,
            switchings: 0,
        }
    }
}

/// A switching within a step: when, after its start, the state there and what follows.
struct Switching {
    offset: f64,
    state: Vec<f64>,
    into: Circuit,
}

impl RectifiedRun {
    /// A run of `system`, whose kappa is what is left of conductance without a load, from `initial` (length 2N + 1) at a
    /// stroboscopic instant, with diodes that open at |v| = `threshold` > 0 (V). A voltage beyond it falls to it at once.
    ///
    /// # Errors
    /// [`IntegrationError::InitialState`].
    pub fn new(system: &ReducedSystem, threshold: f64, initial: &[f64]) -> Result<Self, IntegrationError> {
        let settings = Settings { tolerance: TOLERANCE };
        let open = Collocation::new(system, initial, settings)?;
        let clamped = Collocation::clamped(system, initial, settings)?;
        let fastest = system.modes.iter().last().map_or(0.0, |mode| mode.omega);
        let fastest = fastest.max(2.0 * system.parameters.omega);
        let mut run = Self {
            system: system.clone(),
            threshold,
            open,
            clamped,
            circuit: Circuit::Open,
            state: Vec::new(),
            periods: 0,
            switchings: 0,
            look: std::f64::consts::TAU / (LOOKS * fastest),
            largest_current: 0.0,
            scratch: Scratch::default(),
        };
        run.begin(initial);
        Ok(run)
    }

    /// Begins anew from `state` (length 2N + 1) at a stroboscopic instant.
    pub fn begin(&mut self, state: &[f64]) {
        self.state.clear();
        self.state.extend_from_slice(state);
        let (system, threshold) = (&self.system, self.threshold);
        let last = self.state.len() - 1;
        let sign = self.state[last].signum();
        self.circuit = Circuit::Open;
        if sign * self.state[last] >= threshold {
            self.state[last] = sign * threshold;
            if sign * current(system, &self.state) > 0.0 {
                self.circuit = Circuit::Charging(sign);
            }
        }
        (self.periods, self.switchings) = (0, 0);
    }

    /// The present state, length 2N + 1, at a stroboscopic instant.
    pub fn state(&self) -> &[f64] {
        &self.state
    }

    /// Excitation periods done.
    pub fn periods(&self) -> u64 {
        self.periods
    }

    /// Whether the circuit has stayed open since it began: no charge has moved.
    pub fn stayed_open(&self) -> bool {
        self.circuit == Circuit::Open && self.switchings == 0
    }

    /// Goes on for an excitation period, read into `totals` where they are given; an outcome when the motion ended.
    ///
    /// # Errors
    /// As [`Collocation::advance`], and [`IntegrationError::TooManySteps`] when the circuit switches without end.
    pub fn period(
        &mut self,
        mut totals: Option<&mut RectifiedTotals>,
    ) -> Result<Option<Outcome>, IntegrationError> {
        let period = self.system.parameters.period();
        let omega = self.system.parameters.omega;
        let (mut within, mut switchings) = (0.0, 0);
        while period - within > 1e-12 * period {
            let Self { system, open, clamped, circuit, threshold, scratch, .. } = self;
            let (look, began, circuit) = (self.look, within, *circuit);
            let run = if circuit == Circuit::Open { open } else { clamped };
            run.begin_at(&self.state, omega * began)?;
            let phase = |time: f64| omega * (began + time);
            let (mut found, mut largest) = (None, self.largest_current);
            let outcome = loop {
                let outcome = run.advance(period - began, 1, &mut |step| {
                    let rest = StepRest::new(step.rest, step.tables.step);
                    let watch = Watch { system, threshold: *threshold, circuit, step, rest };
                    let switching = watch.switching(look, &mut largest, scratch);
                    let end = switching.as_ref().map_or(step.tables.step, |there| there.offset);
                    if let Some(totals) = totals.as_deref_mut() {
                        watch.read(end, look, phase(step.time), totals, scratch);
                    }
                    found = switching.map(|there| Switching { offset: step.time + there.offset, ..there });
                })?;
                if found.is_some() || outcome.is_some() {
                    break outcome;
                }
            };
            self.largest_current = largest;
            match (found, outcome) {
                (Some(there), _) => {
                    within += there.offset;
                    self.state = there.state;
                    self.circuit = there.into;
                    switchings += 1;
                    if switchings > MOST_SWITCHINGS {
                        let time = self.periods as f64 * period + within;
                        return Err(IntegrationError::TooManySteps { time, steps: switchings as u64 });
                    }
                }
                (None, Some(Outcome::Completed) | None) => {
                    self.state.copy_from_slice(run.state());
                    within = period;
                }
                (None, Some(early)) => {
                    let time = self.periods as f64 * period + began + early.early_end().unwrap_or_default();
                    return Ok(Some(match early {
                        Outcome::Contact { .. } => Outcome::Contact { time },
                        _ => Outcome::Escaped { time },
                    }));
                }
            }
        }
        self.periods += 1;
        self.switchings += switchings;
        if let Some(totals) = totals {
            totals.switchings += switchings;
        }
        Ok(None)
    }
}

/// The current that the beam sends beyond the conductance at `state`, of length 2N + 1 or longer.
fn current(system: &ReducedSystem, state: &[f64]) -> f64 {
    let n = system.modes.len();
    let beam: f64 = system.theta.iter().zip(&state[n..2 * n]).map(|(theta, rate)| theta * rate).sum();
    beam - system.parameters.kappa * state[2 * n]
}

/// A step that is looked at.
struct Watch<'a> {
    system: &'a ReducedSystem,
    threshold: f64,
    circuit: Circuit,
    step: &'a Step<'a>,
    rest: StepRest,
}

/// What decides about a switching at one instant: positive where the other circuit holds, and its rate.
#[derive(Debug, Clone, Copy)]
struct Sign {
    value: f64,
    rate: f64,
}

impl Watch<'_> {
    fn carry(&self, state: &mut [f64], from: f64, to: f64, workspace: &mut Workspace) {
        self.step.propagator.carry(state, from, to, &self.rest, workspace);
    }

    /// The current and its rate, or the voltage and its rate, at `offset` in the step.
    fn signed(&self, state: &[f64], offset: f64, scratch: &mut Scratch) -> (f64, f64) {
        let n = self.system.modes.len();
        let now = current(self.system, state);
        match self.circuit {
            Circuit::Open => (state[2 * n], now / self.system.capacitance),
            Circuit::Charging(_) => {
                scratch.rate.resize(state.len(), 0.0);
                let rest = self.rest.at(offset / self.step.tables.step);
                self.step.propagator.part().apply(state, rest, &mut scratch.rate);
                let theta = self.system.theta.iter().zip(&scratch.rate[n..2 * n]);
                (now, theta.map(|(theta, rate)| theta * rate).sum())
            }
        }
    }

    fn sign(&self, (value, rate): (f64, f64), side: f64) -> Sign {
        match self.circuit {
            Circuit::Open => Sign { value: side * value - self.threshold, rate: side * rate },
            Circuit::Charging(sign) => Sign { value: -sign * value, rate: -sign * rate },
        }
    }

    /// The first switching in the step.
    fn switching(&self, look: f64, largest: &mut f64, scratch: &mut Scratch) -> Option<Switching> {
        let length = self.step.tables.step;
        let count = (length / look).ceil().max(1.0);
        let mut state = self.step.start.to_vec();
        let mut at = 0.0;
        let mut left = self.signed(&state, at, scratch);
        for k in 1..=count as usize {
            let to = length * k as f64 / count;
            let before = state.clone();
            self.carry(&mut state, at, to, &mut scratch.workspace);
            let right = self.signed(&state, to, scratch);
            if self.circuit != Circuit::Open {
                *largest = largest.max(left.0.abs());
            }
            let small = ROUNDING * if self.circuit == Circuit::Open { self.threshold } else { *largest };
            for side in self.sides(left, right) {
                let (a, b) = (self.sign(left, side), self.sign(right, side));
                let top = if a.value > small {
                    // It should have switched before: rounding.
                    return Some(self.there(before, at, side));
                } else if b.value > 0.0 {
                    Some(to)
                } else if a.rate > 0.0 && b.rate < 0.0 && a.value + a.rate * (to - at) > small {
                    // A top between the looks.
                    let falls = |sign: Sign| Sign { value: -sign.rate, rate: 0.0 };
                    let (top, state) = self.root(&before, (at, to), side, &falls, scratch);
                    (self.sign(self.signed(&state, top, scratch), side).value > small).then_some(top)
                } else {
                    None
                };
                if let Some(top) = top {
                    let (offset, state) = self.root(&before, (at, top), side, &|sign| sign, scratch);
                    return Some(self.there(state, offset, side));
                }
            }
            (left, at) = (right, to);
        }
        None
    }

    /// The signs of the voltage at which the open circuit may begin to conduct.
    fn sides(&self, left: (f64, f64), right: (f64, f64)) -> impl Iterator<Item = f64> {
        let one = if self.circuit == Circuit::Open {
            // Where it leads to, or else where it leads from.
            if right.0.abs() > self.threshold { right.0.signum() } else { left.1.signum() }
        } else {
            1.0
        };
        let other = (self.circuit == Circuit::Open && left.0.abs() > self.threshold).then(|| left.0.signum());
        other.into_iter().chain([one])
    }

    /// Where `of` becomes positive in a bracket at whose beginning, in the state `before`, it is not: by Newton's iteration
    /// kept inside it, or halving.
    fn root(
        &self,
        before: &[f64],
        (from, to): (f64, f64),
        side: f64,
        of: &dyn Fn(Sign) -> Sign,
        scratch: &mut Scratch,
    ) -> (f64, Vec<f64>) {
        let (mut low, mut high) = (from, to);
        let mut place = 0.5 * (low + high);
        let mut there = before.to_vec();
        for _ in 0..ROOT_STEPS {
            there.copy_from_slice(before);
            self.carry(&mut there, from, place, &mut scratch.workspace);
            let Sign { value, rate } = of(self.sign(self.signed(&there, place, scratch), side));
            if value > 0.0 {
                high = place;
            } else {
                low = place;
            }
            let newton = place - value / rate;
            let next = if newton > low && newton < high { newton } else { 0.5 * (low + high) };
            if (next - place).abs() <= 1e-15 * self.step.tables.step.max(place) {
                break;
            }
            place = next;
        }
        (place, there)
    }

    /// The switching in `state` at `offset`.
    fn there(&self, mut state: Vec<f64>, offset: f64, side: f64) -> Switching {
        let n = self.system.modes.len();
        state.truncate(2 * n + 1);
        let into = match self.circuit {
            Circuit::Open => {
                state[2 * n] = side * self.threshold;
                Circuit::Charging(side)
            }
            Circuit::Charging(_) => Circuit::Open,
        };
        Switching { offset, state, into }
    }

    /// Reads the step up to `end`; the excitation has `phase` at its start.
    fn read(&self, end: f64, look: f64, phase: f64, totals: &mut RectifiedTotals, scratch: &mut Scratch) {
        let (system, omega) = (self.system, self.system.parameters.omega);
        let n = system.modes.len();
        let (nodes, weights) = gauss_legendre(NODES_BETWEEN);
        let count = (end / look).ceil().max(1.0);
        let width = end / count;
        let mut state = self.step.start.to_vec();
        let begin = state.clone();
        let mut at = 0.0;
        see(system, &state, totals);
        for k in 0..count as usize {
            for (node, weight) in nodes.iter().zip(&weights) {
                let to = (k as f64 + node) * width;
                self.carry(&mut state, at, to, &mut scratch.workspace);
                at = to;
                let now = powers(system, &state[..2 * n + 1], (phase + omega * to).sin());
                totals.input += weight * width * now.input;
                totals.viscous += weight * width * now.viscous;
                totals.dielectric += weight * width * now.electrical;
                totals.square += weight * width * state[2 * n].powi(2);
                see(system, &state, totals);
            }
        }
        self.carry(&mut state, at, end, &mut scratch.workspace);
        see(system, &state, totals);
        totals.duration += end;
        if let Circuit::Charging(sign) = self.circuit {
            let moved = state.iter().zip(&begin).zip(&system.theta).map(|((b, a), theta)| theta * (b - a));
            let leaked = system.parameters.kappa * sign * self.threshold * end;
            totals.charge += sign * (moved.sum::<f64>() - leaked);
        }
    }
}

/// Takes the extremes of one instant.
fn see(system: &ReducedSystem, state: &[f64], totals: &mut RectifiedTotals) {
    let n = system.modes.len();
    let (tip, slope) = (system.tip_displacement(state), system.tip_slope(state));
    totals.v_peak = totals.v_peak.max(state[2 * n].abs());
    totals.tip = (totals.tip.0.min(tip), totals.tip.1.max(tip));
    totals.slope = totals.slope.max(slope.abs());
}
