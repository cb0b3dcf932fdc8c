//! What motion a start leads to, and what its numbers are when it has arrived.
//!
//! 1. The motion is integrated. From time to time Newton's iteration looks for the periodic motion behind the last
//!    stroboscopic states, with the periods that their recurrence suggests. A stable one counts as reached when the run
//!    lies in its linear neighbourhood (`super::neighbourhood`); the numbers are then those of the orbit itself, however
//!    long the rest of the transient takes. Near an unstable one the run is leaving at a known rate: it goes on for as
//!    long as that takes.
//! 2. What is near no periodic motion is recorded with its tangent vectors. It is quasiperiodic when the weighted Birkhoff
//!    averages and the rotation number of both halves of the record agree, the largest exponent is neither above
//!    nor below zero, and the 0-1 test sees no diffusion; chaotic when the exponent is positive beyond its error, the averages have the error of an average
//!    over chance, the 0-1 test sees diffusion, and the motion has lasted as long as [`Effort::lasting`] says. Where these
//!    witnesses disagree the record is doubled.
//! 3. What is not known when the [`Effort`] is spent is undecided, with the reason and, where it is known, how much longer it would
//!    take.
//!
//! What no finite run can show: a chaotic transient that outlives the effort counts as chaotic, and a periodic motion of
//! more than 64 excitation periods is never found.

use super::lyapunov::{self, Exponent, KNOWN, Sign};
use super::meter::Meter;
use super::motion::{Motion, Reached, Undecided};
use super::neighbourhood::{Neighbourhood, Relation};
use super::rotation::{Rotation, disagreement, rotation, weighted_average};
use super::signature::Signature;
use super::strobe::Strobe;
use super::tangent::Tangents;
use super::zero_one::{exceeds, zero_one};
use crate::dynamics::integration::{Collocation, IntegrationError, Measures, Outcome, Settings};
use crate::dynamics::orbits::newton::Convergence;
use crate::dynamics::orbits::period_map::MOST_PERIODS;
use crate::dynamics::orbits::{Instability, Orbit, OrbitSolver, PeriodMap};
use crate::model::{ParameterSet, ReducedSystem};

/// Excitation periods before the states are first looked at, between looks at least, and at most.
const FIRST_LOOK: usize = 24;
const BETWEEN_LOOKS: (usize, usize) = (24, 512);
/// Excitation periods whose averages say whether a record is worth its cost, and after which it is begun all the same.
const PREVIEW: usize = 512;
const LONGEST_PREVIEW: usize = 4096;
/// Disagreement that does not come from a transient's end.
const LARGE: f64 = 1e-2;
/// Displacements of the tip that are kept.
const TIPS: usize = 1 << 15;
/// Integrator steps between looks at the time.
const CHUNK: usize = 32;
/// How often the map's grid may be halved: for motions that touch almost, finer ones cost more than they tell.
const DEEPEST_LEVEL: u32 = 7;
/// A period that was not found is looked for again after so many times as many instants.
const AGAIN: usize = 4;
/// Longest period that is looked for from afar.
const SHORT: usize = 8;
/// Most motions of one system that serve as guesses for the next.
const MOST_GUESSES: usize = 4;
/// Distance, relative to the gap, below which two orbits are the same.
const SAME: f64 = 1e-6;
/// The tip's displacement is noted once in so many periods, to be compared with other runs from the same start.
const NOTED: usize = 16;
/// Largest disagreement of the averages of two halves of a record of a torus of one further frequency, and of more.
const SURFACE_AGREEMENT: f64 = 1e-3;
/// Correlation of the 0-1 test below which a motion is regular, and above which it diffuses.
const REGULAR: f64 = 0.3;
const DIFFUSING: f64 = 0.7;
/// Largest difference of the rotation numbers of two halves (turns a period).
const SAME_ROTATION: f64 = 1e-6;
/// Distance from a ratio of whole numbers below which a rotation is locked to it, and how many such are looked through.
const LOCKED: f64 = 1e-7;
const MOST_LOCKED: usize = 4;
/// Defect of recurrence, relative to the amplitude, below which points repeat.
const REPEATS: f64 = 1e-7;
/// Half width of a positive exponent, relative to it, that is small enough.
const CERTAIN: f64 = 0.5;
/// How often the estimated time near an orbit may pass before the estimate counts as wrong.
const PATIENCE: f64 = 3.0;

/// How much work a start is worth.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Effort {
    /// Tolerance of the integration ([`Settings`]).
    pub tolerance: f64,
    /// Excitation periods that are run at least.
    pub least: usize,
    /// First record for exponents and averages (excitation periods).
    pub record: usize,
    /// Excitation periods that a motion must last to count as chaotic.
    pub lasting: usize,
    /// Largest disagreement between the averages of the two halves of a torus' record, relative.
    pub agreement: f64,
    /// Integrator steps after which the start is given up as undecided.
    pub steps: u64,
}

impl Effort {
    /// For a chart of many cells.
    pub const fn cell() -> Self {
        Self { tolerance: 1e-5, least: 0, record: 640, lasting: 3000, agreement: 1e-4, steps: 600_000 }
    }

    /// For one motion.
    pub const fn full() -> Self {
        Self { tolerance: 1e-8, least: 0, record: 1024, lasting: 24_000, agreement: 1e-6, steps: 4_000_000 }
    }
}

/// What motion the start of `system` in `initial` (length 2N + 1) at t = 0 leads to.
///
/// # Errors
/// As [`Collocation::new`] and [`Collocation::advance`].
pub fn reach(system: &ReducedSystem, initial: &[f64], effort: Effort) -> Result<Reached, IntegrationError> {
    Settler::new(system).reach(initial, effort)
}

/// Answers for many starts of one system, whose periodic motions it keeps.
pub struct Settler {
    system: ReducedSystem,
    /// Of the map on its coarsest grid, whose steps are the integrator's longest.
    solver: OrbitSolver,
    known: Vec<Neighbourhood>,
    /// Periodic motions of a system like this one, with their periods: where its own are looked for first.
    guesses: Vec<(Vec<f64>, usize)>,
    /// That of the last start, for its tables.
    integrator: Option<Collocation>,
}

impl std::fmt::Debug for Settler {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Settler").field("known", &self.known.len()).finish()
    }
}

impl Settler {
    /// For starts of `system`.
    pub fn new(system: &ReducedSystem) -> Self {
        let map = PeriodMap::new(system).limited(DEEPEST_LEVEL);
        let solver = OrbitSolver::with_map(system, map);
        let system = system.clone();
        Self { system, solver, known: Vec::new(), guesses: Vec::new(), integrator: None }
    }

    /// For starts of `system`, one like the last: its periodic motions are looked for near those of the last.
    pub fn turn_to(&mut self, system: &ReducedSystem) {
        let stable = self.known.iter().map(|known| &known.orbit).filter(|orbit| orbit.stable());
        let guesses: Vec<_> =
            stable.take(MOST_GUESSES).map(|orbit| (orbit.state.clone(), orbit.periods)).collect();
        let beta = system.parameters.beta;
        let model = |system: &ReducedSystem| (system.modes.len(), system.law, system.residual_moment);
        let same_set = ParameterSet { beta, ..*self.system.parameters } == *system.parameters;
        // The excitation's amplitude is in no table.
        if same_set && model(&self.system) == model(system) {
            self.integrator.iter_mut().for_each(|integrator| integrator.set_beta(beta));
            self.known.clear();
            self.system = system.clone();
        } else {
            *self = Self::new(system);
        }
        self.guesses = guesses;
    }

    /// What motion the start in `initial` (length 2N + 1) at t = 0 leads to.
    ///
    /// # Errors
    /// As [`Collocation::new`] and [`Collocation::advance`].
    pub fn reach(&mut self, initial: &[f64], effort: Effort) -> Result<Reached, IntegrationError> {
        let settings = Settings { tolerance: effort.tolerance };
        let integrator = match self.integrator.take() {
            Some(mut integrator) => {
                integrator.restart(initial, settings)?;
                integrator
            }
            None => {
                let tables = self.solver.map().tables();
                Collocation::with_tables(&self.system, initial, tables, settings)?
            }
        };
        let mut run = Run {
            integrator,
            strobe: Strobe::new(&self.system),
            instants: 0,
            looks: 0,
            record: None,
            resume: 0,
            lasting: None,
            waiting: None,
            notes: Vec::new(),
            tips: Vec::new(),
            failed: Vec::new(),
            far: Vec::new(),
            effort,
            settler: self,
        };
        let reached = run.follow();
        let integrator = run.integrator;
        self.integrator = Some(integrator);
        reached
    }

    /// The stable periodic motions met so far.
    pub fn stable_orbits(&self) -> Vec<Signature> {
        let stable = self.known.iter().filter(|known| known.orbit.stable());
        stable.map(|known| Signature::of_orbit(&known.orbit, known.states_from(&known.orbit.state))).collect()
    }

    /// The orbit of `periods` excitation periods that Newton's iteration reaches from `state`, as an index into those
    /// known.
    fn find(&mut self, state: &[f64], periods: usize) -> Option<usize> {
        let beta = self.system.parameters.beta;
        let mut solver = self.solver.clone();
        // A long period is looked for where the states nearly repeat already, so that the iteration converges or never will.
        let convergence = if periods > SHORT {
            solver.follow(state, beta, periods).ok()?
        } else {
            solver.find(state, beta, periods).ok()?
        };
        self.learn(solver, convergence, periods)
    }

    /// The orbits near the motions of a system like this one, as indices into those known.
    fn find_guessed(&mut self) -> Vec<usize> {
        let beta = self.system.parameters.beta;
        let guesses = std::mem::take(&mut self.guesses);
        let found = guesses.into_iter().filter_map(|(state, periods)| {
            let mut solver = self.solver.clone();
            let convergence = solver.follow(&state, beta, periods).ok()?;
            self.learn(solver, convergence, periods)
        });
        found.collect()
    }

    /// The orbit of `periods` that `solver` has found, as an index into those known.
    fn learn(&mut self, mut solver: OrbitSolver, convergence: Convergence, periods: usize) -> Option<usize> {
        let beta = self.system.parameters.beta;
        let gap = self.system.equilibrium.gap;
        let found = solver.state().to_vec();
        if let Some(index) = self.known.iter().position(|known| known.holds(&found, SAME * gap)) {
            return Some(index);
        }
        let orbit = Orbit::read(&self.system, &mut solver, convergence, beta, periods).ok()?;
        self.known.push(Neighbourhood::new(orbit, &mut solver, &self.system).ok()?);
        Some(self.known.len() - 1)
    }
}

/// One start being followed.
struct Run<'a> {
    settler: &'a mut Settler,
    effort: Effort,
    integrator: Collocation,
    strobe: Strobe,
    /// Stroboscopic instants passed, the start among them.
    instants: usize,
    looks: usize,
    record: Option<Record>,
    /// Instant before which no record is begun.
    resume: usize,
    /// Evidence of a chaotic motion that must still last.
    lasting: Option<Witnesses>,
    waiting: Option<Waiting>,
    /// Tip displacement every [`NOTED`] periods, in beam lengths.
    notes: Vec<f64>,
    /// The same in each of the last periods.
    tips: Vec<f64>,
    /// Periods of which no orbit was found, and the instant of that.
    failed: Vec<(usize, usize)>,
    /// Periods of which a stable orbit was found that the run was not near: its index, and the distance from it then.
    far: Vec<(usize, usize, f64)>,
}

/// What is recorded of a motion that is near no periodic one.
struct Record {
    tangents: Option<Tangents>,
    meter: Meter,
    periods: usize,
}

impl Record {
    fn new(system: &ReducedSystem, periods: usize) -> Self {
        Self { tangents: Some(Tangents::new(system)), meter: Meter::default(), periods }
    }

    /// Excitation periods that are still to be recorded.
    fn left(&self) -> usize {
        let done = self.tangents.as_ref().map_or(self.periods, |tangents| tangents.growth()[0].len());
        self.periods.saturating_sub(done)
    }
}

/// A periodic motion that the run is close to without having reached it.
#[derive(Clone, Copy)]
struct Waiting {
    /// Index of the orbit.
    orbit: usize,
    /// Instant by which it should have left or arrived, with room.
    until: f64,
    /// Excitation periods still needed, by the last estimate.
    left: f64,
    why: Undecided,
}

/// What a record says.
#[derive(Debug, Clone, Copy)]
struct Witnesses {
    exponent: Exponent,
    rotation: Option<Rotation>,
    /// Of the averages of both halves.
    disagreement: f64,
    /// `None` where the other witnesses leave nothing to it.
    zero_one: Option<f64>,
}

impl Run<'_> {
    fn follow(&mut self) -> Result<Reached, IntegrationError> {
        let mut next = FIRST_LOOK;
        loop {
            if let Some(outcome) = self.go_on_to(next)? {
                let motion = match outcome {
                    Outcome::Contact { time } => Motion::Contact { time },
                    Outcome::Escaped { time } => Motion::Escape { time },
                    Outcome::Completed => Motion::Undecided { why: Undecided::Unresolved },
                };
                return Ok(self.ended(motion));
            }
            if let Some(reached) = self.look() {
                return Ok(reached);
            }
            if self.integrator.steps() > self.effort.steps {
                return Ok(self.given_up());
            }
            let (least, most) = BETWEEN_LOOKS;
            let left = self.record.as_ref().map_or(most, |record| record.left());
            next = self.instants + (self.instants / 4).clamp(least, most).min(left.max(1));
        }
    }

    /// Integrates until so many stroboscopic instants have passed.
    fn go_on_to(&mut self, instants: usize) -> Result<Option<Outcome>, IntegrationError> {
        while self.instants <= instants {
            let Self { integrator, strobe, instants, record, notes, tips, settler, .. } = self;
            let system = &settler.system;
            if tips.len() >= 2 * TIPS {
                tips.drain(..TIPS);
            }
            let outcome = integrator.advance(f64::INFINITY, CHUNK, &mut |step| {
                if step.index == 0 {
                    strobe.push(step.start);
                    tips.push(system.tip_displacement(step.start));
                    if instants.is_multiple_of(NOTED) {
                        notes.push(system.tip_displacement(step.start));
                    }
                    *instants += 1;
                }
                if let Some(record) = record {
                    if let Some(tangents) = &mut record.tangents {
                        tangents.record(step);
                    }
                    record.meter.record(step);
                }
            })?;
            if outcome.is_some() {
                return Ok(outcome);
            }
        }
        Ok(None)
    }

    /// Looks for periodic motions, then at the record.
    fn look(&mut self) -> Option<Reached> {
        self.looks += 1;
        let mut near = self.near_known();
        if near.is_none() {
            near = self.near_found();
        }
        if let Some((orbit, relation)) = near {
            match relation {
                Relation::Reached { distance } if self.instants >= self.effort.least => {
                    return Some(self.periodic(orbit, distance));
                }
                Relation::Reached { .. } => {
                    self.record = None;
                    return None;
                }
                Relation::Leaving { periods } if self.waits(orbit, periods, Undecided::NearUnstable) => {
                    return None;
                }
                Relation::Approaching { periods }
                    if self.waits(orbit, periods, Undecided::TransientNotGone) =>
                {
                    return None;
                }
                _ => {}
            }
        } else {
            self.waiting = None;
        }
        self.judge()
    }

    /// Whether the run should go on near an orbit for the `periods` that it still needs; a record says nothing then.
    fn waits(&mut self, orbit: usize, periods: f64, why: Undecided) -> bool {
        let now = self.instants as f64;
        let until = match self.waiting {
            Some(waiting) if waiting.orbit == orbit && waiting.why == why => waiting.until,
            _ => now + PATIENCE * periods,
        };
        self.waiting = Some(Waiting { orbit, until, left: periods, why });
        let waits = now <= until;
        if waits {
            self.record = None;
            self.lasting = None;
        }
        waits
    }

    fn relation(&self, orbit: usize) -> Option<(usize, Relation)> {
        let gap = self.settler.system.equilibrium.gap;
        let relation = self.settler.known.get(orbit)?.relation(&self.strobe, gap);
        (relation != Relation::Apart).then_some((orbit, relation))
    }

    /// The known orbit that the run is near, one that it has reached before others.
    fn near_known(&self) -> Option<(usize, Relation)> {
        let near: Vec<_> = (0..self.settler.known.len()).filter_map(|orbit| self.relation(orbit)).collect();
        let reached = |found: &&(usize, Relation)| matches!(found.1, Relation::Reached { .. });
        near.iter().find(reached).or_else(|| near.first()).copied()
    }

    /// The same, of orbits newly looked for behind the last states.
    fn near_found(&mut self) -> Option<(usize, Relation)> {
        for found in self.settler.find_guessed() {
            let near = self.relation(found);
            if matches!(near, Some((_, Relation::Reached { .. } | Relation::Approaching { .. }))) {
                return near;
            }
            self.note_far(found, near);
        }
        let mut candidates = Vec::new();
        let recurring = self.strobe.recurrence(&self.settler.system).and_then(|found| found.period);
        candidates.extend(recurring);
        candidates.extend(self.strobe.closest_return());
        if self.looks.is_power_of_two() {
            candidates.push(1);
        }
        candidates.dedup();
        let mut best = None;
        for mut periods in candidates {
            // Where the motion of a period has doubled, the doubled one is looked for.
            while periods <= MOST_PERIODS {
                let recently =
                    |(tried, instant): &(usize, usize)| *tried == periods && self.instants < AGAIN * instant;
                let last = self.strobe.before_last(0).to_vec();
                let nearer = |(tried, orbit, distance): &(usize, usize, f64)| {
                    *tried == periods && self.settler.known[*orbit].distance_lately(&self.strobe) < *distance
                };
                // On its way to the orbit found before it would find that one again.
                if self.failed.iter().any(recently) || self.far.iter().any(nearer) {
                    break;
                }
                let Some(found) = self.settler.find(&last, periods) else {
                    self.failed.retain(|(tried, _)| *tried != periods);
                    self.failed.push((periods, self.instants));
                    break;
                };
                let near = self.relation(found);
                if matches!(near, Some((_, Relation::Reached { .. } | Relation::Approaching { .. }))) {
                    return near;
                }
                best = best.or(near);
                self.note_far(found, near);
                let orbit = &self.settler.known[found].orbit;
                let doubled = 2 * orbit.periods;
                if orbit.instability() != Some(Instability::PeriodDoubling) || doubled <= periods {
                    break;
                }
                periods = doubled;
            }
        }
        best
    }

    /// Notes how far the run is from a stable orbit that it is not near.
    fn note_far(&mut self, orbit: usize, near: Option<(usize, Relation)>) {
        let known = &self.settler.known[orbit];
        let periods = known.orbit.periods;
        self.far.retain(|(tried, _, _)| *tried != periods);
        if near.is_none() && known.orbit.stable() {
            self.far.push((periods, orbit, known.distance_lately(&self.strobe)));
        }
    }

    /// Decides by the record once it is long enough, or begins or lengthens it.
    fn judge(&mut self) -> Option<Reached> {
        if self.lasting.is_some() && self.repeats() {
            (self.lasting, self.record) = (None, None);
        }
        if let Some(witnesses) = self.lasting {
            let lasted = self.instants >= self.effort.lasting;
            return lasted.then(|| self.by_record(Motion::Chaotic, Some(witnesses)));
        }
        let Some(record) = &self.record else {
            if self.instants >= self.resume && self.is_worth_recording() {
                let periods = self.effort.record.max(lyapunov::LEAST_PERIODS);
                self.record = Some(Record::new(&self.settler.system, periods));
            }
            return None;
        };
        let tangents = record.tangents.as_ref()?;
        if !tangents.resolved() {
            return Some(self.by_record(Motion::Undecided { why: Undecided::Unresolved }, None));
        }
        if record.left() > 0 {
            return None;
        }
        let witnesses = self.witnesses()?;
        if self.is_torus(&witnesses) {
            return Some(self.by_record(Motion::Quasiperiodic, Some(witnesses)));
        }
        if self.is_chaos(&witnesses) {
            // From now on it only has to last, which needs no tangent vectors.
            self.lasting = Some(witnesses);
            if let Some(record) = &mut self.record {
                record.tangents = None;
            }
            return self.judge();
        }
        if witnesses.exponent.sign() == Sign::Negative && self.repeats() {
            let periods = self.strobe.recurrence(&self.settler.system)?.period?;
            return Some(self.by_record(Motion::Periodic { periods }, Some(witnesses)));
        }
        let longer = 2 * record.periods;
        if witnesses.exponent.sign() == Sign::Negative {
            // On its way to a periodic motion: until it must be there, tangent vectors would tell nothing new.
            let period = self.settler.system.parameters.period();
            let decay = PATIENCE / (-witnesses.exponent.value * period);
            self.resume = self.instants + longer.max(decay.min(1e9) as usize);
            self.record = None;
        } else {
            self.record = Some(Record::new(&self.settler.system, longer));
        }
        None
    }

    /// Whether the last displacements of the tip look like a motion that has settled, or like one that does not.
    fn is_worth_recording(&self) -> bool {
        let Some(start) = self.tips.len().checked_sub(PREVIEW) else { return false };
        let recent = &self.tips[start..];
        let disagreement = disagreement(recent);
        disagreement <= self.effort.agreement
            || disagreement > LARGE && exceeds(recent, DIFFUSING)
            || self.instants > LONGEST_PREVIEW
    }

    fn witnesses(&self) -> Option<Witnesses> {
        let record = self.record.as_ref()?;
        let period = self.settler.system.parameters.period();
        let exponent = Exponent::from_growth(record.tangents.as_ref()?.growth(), period)?;
        let squares = record.meter.squares();
        let tips = self.recorded(squares.len());
        let disagreement = disagreement(squares).max(disagreement(tips));
        let regular = disagreement <= SURFACE_AGREEMENT;
        Some(Witnesses {
            exponent,
            rotation: if regular { free_rotation(tips) } else { None },
            disagreement,
            zero_one: (regular || exponent.sign() == Sign::Positive).then(|| zero_one(tips)),
        })
    }

    /// The displacements of the tip over the last `periods`.
    fn recorded(&self, periods: usize) -> &[f64] {
        &self.tips[self.tips.len().saturating_sub(periods.min(TIPS))..]
    }

    fn is_torus(&self, witnesses: &Witnesses) -> bool {
        let Witnesses { exponent, rotation, disagreement, zero_one, .. } = witnesses;
        let surface = exponent.second_sign() == Sign::Zero;
        let agreement = if surface { SURFACE_AGREEMENT } else { self.effort.agreement };
        let turns = rotation.is_some_and(|found| found.error <= SAME_ROTATION);
        let neutral = exponent.value.abs() <= exponent.half_width || exponent.sign() == Sign::Zero;
        neutral && *disagreement <= agreement && turns && zero_one.is_some_and(|found| found < REGULAR)
    }

    fn is_chaos(&self, witnesses: &Witnesses) -> bool {
        let Witnesses { exponent, disagreement, zero_one, .. } = witnesses;
        let positive = exponent.sign() == Sign::Positive
            && exponent.half_width <= CERTAIN * exponent.value
            && (exponent.half_width <= KNOWN * exponent.value || self.effort.lasting < self.instants);
        positive && zero_one.is_some_and(|found| found > DIFFUSING) && *disagreement > self.effort.agreement
    }

    /// Whether the stroboscopic points repeat, to rounding almost. With neighbours that come nearer that is a periodic motion,
    /// whether Newton's iteration finds it or not: it cannot follow a motion that almost touches, and without a load it takes
    /// the orbit without charge while the charge of the start stays.
    fn repeats(&self) -> bool {
        let found = self.strobe.recurrence(&self.settler.system);
        let charged = self.settler.system.parameters.kappa == 0.0;
        found.is_some_and(|found| found.defect <= REPEATS || charged && found.settled)
    }

    /// The motion when the effort is spent.
    fn given_up(&mut self) -> Reached {
        if let Some(Waiting { left, why, .. }) = self.waiting {
            let period = self.settler.system.parameters.period();
            let reached = self.by_record(Motion::Undecided { why }, None);
            return Reached { longer: Some(left * period), ..reached };
        }
        if let Some(witnesses) = self.lasting {
            let motion = Motion::Undecided { why: Undecided::MayBeTransient };
            return self.by_record(motion, Some(witnesses));
        }
        let witnesses = self.witnesses();
        let why = match witnesses.map(|witnesses| witnesses.exponent.sign()) {
            Some(Sign::Negative) => Undecided::TransientNotGone,
            Some(Sign::Zero) => Undecided::PointsScattered,
            Some(Sign::Positive) => Undecided::EvidenceDisagrees,
            None if self.instants < self.resume => Undecided::TransientNotGone,
            Some(Sign::Open) | None => Undecided::ExponentOpen,
        };
        self.by_record(Motion::Undecided { why }, witnesses)
    }

    fn periodic(&mut self, orbit: usize, distance: f64) -> Reached {
        let known = &self.settler.known[orbit];
        let (orbit, states) = (known.orbit.clone(), known.states_from(self.strobe.before_last(0)));
        Reached {
            measures: Some(orbit.measures),
            distance: Some(distance),
            states,
            ..self.bare(Motion::Periodic { periods: orbit.periods })
        }
        .with_orbit(orbit)
    }

    fn ended(&self, motion: Motion) -> Reached {
        let recurrence = None;
        Reached { recurrence, ..self.bare(motion) }
    }

    /// A motion with the numbers of the record.
    fn by_record(&self, motion: Motion, witnesses: Option<Witnesses>) -> Reached {
        let system = &self.settler.system;
        let record = self.record.as_ref();
        let measures = record.and_then(|record| record.meter.measures(system.parameters.kappa));
        Reached {
            measures: measures.or_else(|| self.measured()),
            exponent: witnesses.map(|witnesses| witnesses.exponent),
            rotation: witnesses.and_then(|witnesses| witnesses.rotation),
            zero_one: witnesses.and_then(|witnesses| witnesses.zero_one),
            tips: record.map_or(&[][..], |record| self.recorded(record.meter.squares().len())).to_vec(),
            ..self.bare(motion)
        }
    }

    /// The numbers of the next periods, for a motion that was not recorded.
    fn measured(&self) -> Option<Measures> {
        const PERIODS: usize = 64;
        let mut integrator = self.integrator.clone();
        let mut meter = Meter::default();
        while meter.squares().len() < PERIODS {
            let outcome = integrator.advance(f64::INFINITY, CHUNK, &mut |step| meter.record(step)).ok()?;
            if outcome.is_some() {
                return None;
            }
        }
        meter.measures(self.settler.system.parameters.kappa)
    }

    fn bare(&self, motion: Motion) -> Reached {
        let empty = self.strobe.len() == 0;
        let state = if empty { Vec::new() } else { self.strobe.before_last(0).to_vec() };
        let period = self.settler.system.parameters.period();
        Reached {
            motion,
            measures: None,
            states: vec![state.clone()],
            state,
            time: period * self.instants.saturating_sub(1) as f64,
            orbit: None,
            distance: None,
            exponent: None,
            recurrence: self.strobe.recurrence(&self.settler.system),
            rotation: None,
            zero_one: None,
            longer: None,
            tips: Vec::new(),
            notes: self.notes.clone(),
        }
    }
}

/// The denominator of the ratio of two whole numbers that `number` is, if it is at most the longest period looked for.
fn locked(number: f64) -> Option<usize> {
    (1..=MOST_PERIODS).find(|denominator| {
        let turns = number * *denominator as f64;
        (turns - turns.round()).abs() <= LOCKED * *denominator as f64
    })
}

/// The strongest frequency of `tips` that is no ratio of small whole numbers: about an orbit of several periods the torus
/// adds its own to theirs.
fn free_rotation(tips: &[f64]) -> Option<Rotation> {
    let mut values = tips.to_vec();
    let size = spread(tips);
    for _ in 0..MOST_LOCKED {
        let found = rotation(&values, None)?;
        let Some(denominator) = locked(found.number) else { return Some(found) };
        values = values.iter().zip(values.get(denominator..)?).map(|(a, b)| b - a).collect();
        if spread(&values) <= REPEATS * size {
            return None;
        }
    }
    None
}

/// Root mean square of the deviations from the mean.
fn spread(values: &[f64]) -> f64 {
    let mean = weighted_average(values);
    weighted_average(&values.iter().map(|value| (value - mean).powi(2)).collect::<Vec<_>>()).sqrt()
}
