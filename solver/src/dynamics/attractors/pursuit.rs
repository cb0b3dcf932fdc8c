//! One start being followed, from look to look, until it is known what it leads to.

use super::effort::Effort;
use super::lyapunov::{self, Exponent, KNOWN, Sign};
use super::meter::Meter;
use super::motion::{Motion, Reached, Undecided};
use super::neighbourhood::{Neighbourhood, Relation};
use super::repertoire::Repertoire;
use super::rotation::{Rotation, disagreement, rotation, weighted_average};
use super::strobe::Strobe;
use super::tangent::Tangents;
use super::zero_one::{exceeds, zero_one};
use crate::dynamics::integration::{Collocation, Measures, Outcome, Step};
use crate::dynamics::orbits::Instability;
use crate::dynamics::orbits::period_map::MOST_PERIODS;
use crate::model::ReducedSystem;

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
pub(super) const CHUNK: usize = 32;
/// A period that was not found is looked for again after so many times as many instants.
const AGAIN: usize = 4;
/// The tip's displacement is noted once in so many periods, to be compared with other runs from the same start.
const NOTED: usize = 16;
/// Largest disagreement of the averages of two halves of a record of a torus of one further frequency, and of more.
const SURFACE_AGREEMENT: f64 = 1e-3;
/// Correlation of the 0-1 test below which a motion is regular, and above which it diffuses.
const REGULAR: f64 = 0.3;
const DIFFUSING: f64 = 0.7;
/// Largest difference of the rotation numbers of two halves (turns a period).
const SAME_ROTATION: f64 = 1e-6;
/// Distance from an orbit, relative to that at the look before, below which a run is on its way there.
const APPROACHED: f64 = 0.9;
/// Distance from a ratio of whole numbers below which a rotation is locked to it, and how many such are looked through.
const LOCKED: f64 = 1e-7;
const MOST_LOCKED: usize = 4;
/// Defect of recurrence, relative to the amplitude, below which points repeat.
const REPEATS: f64 = 1e-7;
/// Half width of a positive exponent, relative to it, that is small enough.
const CERTAIN: f64 = 0.5;
/// How often the estimated time near an orbit may pass before the estimate counts as wrong.
const PATIENCE: f64 = 3.0;

/// One start being followed: what was seen of its motion, and what was made of that so far.
pub(super) struct Pursuit {
    effort: Effort,
    modes: usize,
    strobe: Strobe,
    /// Stroboscopic instants passed, the start among them.
    instants: usize,
    /// Instants after which the motion is looked at next.
    next: usize,
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
    /// Distance from each known orbit at the look before, infinite from unstable ones.
    distances: Vec<f64>,
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

impl Pursuit {
    /// Nothing is seen yet of a start of `system`.
    pub(super) fn new(system: &ReducedSystem, effort: Effort) -> Self {
        Self {
            effort,
            modes: system.modes.len(),
            strobe: Strobe::new(system),
            instants: 0,
            next: FIRST_LOOK,
            looks: 0,
            record: None,
            resume: 0,
            lasting: None,
            waiting: None,
            notes: Vec::new(),
            tips: Vec::new(),
            failed: Vec::new(),
            far: Vec::new(),
            distances: Vec::new(),
        }
    }

    /// Sees a step.
    pub(super) fn see(&mut self, step: &Step<'_>) {
        if step.index == 0 {
            self.strobe.push(step.start);
            let tip = step.start[..self.modes].iter().sum();
            if self.tips.len() >= 2 * TIPS {
                self.tips.drain(..TIPS);
            }
            self.tips.push(tip);
            if self.instants.is_multiple_of(NOTED) {
                self.notes.push(tip);
            }
            self.instants += 1;
        }
        if let Some(record) = &mut self.record {
            if let Some(tangents) = &mut record.tangents {
                tangents.record(step);
            }
            record.meter.record(step);
        }
    }

    /// Whether it is time to look at the motion, asked when [`CHUNK`] steps have been attempted.
    pub(super) fn is_due(&self) -> bool {
        self.instants > self.next
    }

    /// Looks at the motion, whose run stands where `integrator` is and has ended with `outcome` if with any. Returns what the
    /// start leads to once that is known; else the run is to go on.
    pub(super) fn look(
        &mut self,
        repertoire: &mut Repertoire,
        integrator: &Collocation,
        outcome: Option<Outcome>,
    ) -> Option<Reached> {
        let mut look = Look { repertoire, integrator, run: self };
        if let Some(outcome) = outcome {
            let motion = match outcome {
                Outcome::Contact { time } => Motion::Contact { time },
                Outcome::Escaped { time } => Motion::Escape { time },
                Outcome::Completed => Motion::Undecided { why: Undecided::Unresolved },
            };
            return Some(look.ended(motion));
        }
        if let Some(reached) = look.look() {
            return Some(reached);
        }
        if integrator.steps() > look.run.effort.steps {
            return Some(look.given_up());
        }
        let (least, most) = BETWEEN_LOOKS;
        let left = self.record.as_ref().map_or(most, |record| record.left());
        self.next = self.instants + (self.instants / 4).clamp(least, most).min(left.max(1));
        None
    }
}

/// A look at a run.
struct Look<'a> {
    repertoire: &'a mut Repertoire,
    integrator: &'a Collocation,
    run: &'a mut Pursuit,
}

impl Look<'_> {
    /// Looks for periodic motions, then at the record.
    fn look(&mut self) -> Option<Reached> {
        self.run.looks += 1;
        let mut near = self.near_known();
        if near.is_none() {
            near = self.near_found();
        }
        if let Some((orbit, relation)) = near {
            match relation {
                Relation::Reached { distance } if self.run.instants >= self.run.effort.least => {
                    return Some(self.periodic(orbit, distance));
                }
                Relation::Reached { .. } => {
                    self.run.record = None;
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
            self.run.waiting = None;
        }
        self.judge()
    }

    /// Whether the run should go on near an orbit for the `periods` that it still needs; a record says nothing then.
    fn waits(&mut self, orbit: usize, periods: f64, why: Undecided) -> bool {
        let now = self.run.instants as f64;
        let until = match self.run.waiting {
            Some(waiting) if waiting.orbit == orbit && waiting.why == why => waiting.until,
            _ => now + PATIENCE * periods,
        };
        self.run.waiting = Some(Waiting { orbit, until, left: periods, why });
        let waits = now <= until;
        if waits {
            self.run.record = None;
            self.run.lasting = None;
        }
        waits
    }

    fn relation(&self, orbit: usize) -> Option<(usize, Relation)> {
        let gap = self.repertoire.system.equilibrium.gap;
        let relation = self.repertoire.known.get(orbit)?.relation(&self.run.strobe, gap);
        (relation != Relation::Apart).then_some((orbit, relation))
    }

    /// The known orbit that the run is near, one that it has reached before others.
    fn near_known(&self) -> Option<(usize, Relation)> {
        let near: Vec<_> =
            (0..self.repertoire.known.len()).filter_map(|orbit| self.relation(orbit)).collect();
        let reached = |found: &&(usize, Relation)| matches!(found.1, Relation::Reached { .. });
        near.iter().find(reached).or_else(|| near.first()).copied()
    }

    /// The same, of orbits newly looked for behind the last states.
    fn near_found(&mut self) -> Option<(usize, Relation)> {
        for found in self.repertoire.find_guessed() {
            let near = self.relation(found);
            if matches!(near, Some((_, Relation::Reached { .. } | Relation::Approaching { .. }))) {
                return near;
            }
            self.note_far(found, near);
        }
        let mut candidates = Vec::new();
        let recurring = self.run.strobe.recurrence(&self.repertoire.system).and_then(|found| found.period);
        candidates.extend(recurring);
        // A run that winds towards a known orbit returns close to itself after as many periods as a turn takes. Should it end on
        // a longer orbit about that one, it stops coming nearer, and its returns are looked at then.
        if !self.approaches_a_stable_orbit() {
            candidates.extend(self.run.strobe.closest_return());
        }
        if self.run.looks.is_power_of_two() {
            candidates.push(1);
        }
        candidates.dedup();
        let mut best = None;
        for mut periods in candidates {
            // Where the motion of a period has doubled, the doubled one is looked for.
            while periods <= MOST_PERIODS {
                let recently = |(tried, instant): &(usize, usize)| {
                    *tried == periods && self.run.instants < AGAIN * instant
                };
                let last = self.run.strobe.before_last(0).to_vec();
                let nearer = |(tried, orbit, distance): &(usize, usize, f64)| {
                    *tried == periods
                        && self.repertoire.known[*orbit].distance_lately(&self.run.strobe) < *distance
                };
                // On its way to the orbit found before it would find that one again.
                if self.run.failed.iter().any(recently) || self.run.far.iter().any(nearer) {
                    break;
                }
                let Some(found) = self.repertoire.find(&last, periods) else {
                    self.run.failed.retain(|(tried, _)| *tried != periods);
                    self.run.failed.push((periods, self.run.instants));
                    break;
                };
                let near = self.relation(found);
                if matches!(near, Some((_, Relation::Reached { .. } | Relation::Approaching { .. }))) {
                    return near;
                }
                best = best.or(near);
                self.note_far(found, near);
                let orbit = &self.repertoire.known[found].orbit;
                let doubled = 2 * orbit.periods;
                if orbit.instability() != Some(Instability::PeriodDoubling) || doubled <= periods {
                    break;
                }
                periods = doubled;
            }
        }
        best
    }

    /// Whether the run has come nearer to one of the known stable orbits since it was last asked; notes how near.
    fn approaches_a_stable_orbit(&mut self) -> bool {
        let distance = |known: &Neighbourhood| {
            if known.orbit.stable() { known.distance_lately(&self.run.strobe) } else { f64::INFINITY }
        };
        let now: Vec<f64> = self.repertoire.known.iter().map(distance).collect();
        let approaches = now.iter().zip(&self.run.distances).any(|(now, before)| *now < APPROACHED * before);
        self.run.distances = now;
        approaches
    }

    /// Notes how far the run is from a stable orbit that it is not near.
    fn note_far(&mut self, orbit: usize, near: Option<(usize, Relation)>) {
        let known = &self.repertoire.known[orbit];
        let periods = known.orbit.periods;
        self.run.far.retain(|(tried, _, _)| *tried != periods);
        if near.is_none() && known.orbit.stable() {
            self.run.far.push((periods, orbit, known.distance_lately(&self.run.strobe)));
        }
    }

    /// Decides by the record once it is long enough, or begins or lengthens it.
    fn judge(&mut self) -> Option<Reached> {
        if self.run.lasting.is_some() && self.repeats() {
            (self.run.lasting, self.run.record) = (None, None);
        }
        if let Some(witnesses) = self.run.lasting {
            let lasted = self.run.instants >= self.run.effort.lasting;
            return lasted.then(|| self.by_record(Motion::Chaotic, Some(witnesses)));
        }
        let Some(record) = &self.run.record else {
            if self.run.instants >= self.run.resume && self.is_worth_recording() {
                let periods = self.run.effort.record.max(lyapunov::LEAST_PERIODS);
                self.run.record = Some(Record::new(&self.repertoire.system, periods));
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
            self.run.lasting = Some(witnesses);
            if let Some(record) = &mut self.run.record {
                record.tangents = None;
            }
            return self.judge();
        }
        if witnesses.exponent.sign() == Sign::Negative && self.repeats() {
            let periods = self.run.strobe.recurrence(&self.repertoire.system)?.period?;
            return Some(self.by_record(Motion::Periodic { periods }, Some(witnesses)));
        }
        let longer = 2 * record.periods;
        if witnesses.exponent.sign() == Sign::Negative {
            // On its way to a periodic motion: until it must be there, tangent vectors would tell nothing new.
            let period = self.repertoire.system.parameters.period();
            let decay = PATIENCE / (-witnesses.exponent.value * period);
            self.run.resume = self.run.instants + longer.max(decay.min(1e9) as usize);
            self.run.record = None;
        } else {
            self.run.record = Some(Record::new(&self.repertoire.system, longer));
        }
        None
    }

    /// Whether the last displacements of the tip look like a motion that has settled, or like one that does not.
    fn is_worth_recording(&self) -> bool {
        let Some(start) = self.run.tips.len().checked_sub(PREVIEW) else { return false };
        let recent = &self.run.tips[start..];
        let disagreement = disagreement(recent);
        disagreement <= self.run.effort.agreement
            || disagreement > LARGE && exceeds(recent, DIFFUSING)
            || self.run.instants > LONGEST_PREVIEW
    }

    fn witnesses(&self) -> Option<Witnesses> {
        let record = self.run.record.as_ref()?;
        let period = self.repertoire.system.parameters.period();
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
        &self.run.tips[self.run.tips.len().saturating_sub(periods.min(TIPS))..]
    }

    fn is_torus(&self, witnesses: &Witnesses) -> bool {
        let Witnesses { exponent, rotation, disagreement, zero_one, .. } = witnesses;
        let surface = exponent.second_sign() == Sign::Zero;
        let agreement = if surface { SURFACE_AGREEMENT } else { self.run.effort.agreement };
        let turns = rotation.is_some_and(|found| found.error <= SAME_ROTATION);
        let neutral = exponent.value.abs() <= exponent.half_width || exponent.sign() == Sign::Zero;
        neutral && *disagreement <= agreement && turns && zero_one.is_some_and(|found| found < REGULAR)
    }

    fn is_chaos(&self, witnesses: &Witnesses) -> bool {
        let Witnesses { exponent, disagreement, zero_one, .. } = witnesses;
        let positive = exponent.sign() == Sign::Positive
            && exponent.half_width <= CERTAIN * exponent.value
            && (exponent.half_width <= KNOWN * exponent.value || self.run.effort.lasting < self.run.instants);
        positive
            && zero_one.is_some_and(|found| found > DIFFUSING)
            && *disagreement > self.run.effort.agreement
    }

    /// Whether the stroboscopic points repeat, to rounding almost. With neighbours that come nearer that is a periodic motion,
    /// whether Newton's iteration finds it or not: it cannot follow a motion that almost touches, and without a load it takes
    /// the orbit without charge while the charge of the start stays.
    fn repeats(&self) -> bool {
        let found = self.run.strobe.recurrence(&self.repertoire.system);
        let charged = self.repertoire.system.parameters.kappa == 0.0;
        found.is_some_and(|found| found.defect <= REPEATS || charged && found.settled)
    }

    /// The motion when the effort is spent.
    fn given_up(&mut self) -> Reached {
        if let Some(Waiting { left, why, .. }) = self.run.waiting {
            let period = self.repertoire.system.parameters.period();
            let reached = self.by_record(Motion::Undecided { why }, None);
            return Reached { longer: Some(left * period), ..reached };
        }
        if let Some(witnesses) = self.run.lasting {
            let motion = Motion::Undecided { why: Undecided::MayBeTransient };
            return self.by_record(motion, Some(witnesses));
        }
        let witnesses = self.witnesses();
        let why = match witnesses.map(|witnesses| witnesses.exponent.sign()) {
            Some(Sign::Negative) => Undecided::TransientNotGone,
            Some(Sign::Zero) => Undecided::PointsScattered,
            Some(Sign::Positive) => Undecided::EvidenceDisagrees,
            None if self.run.instants < self.run.resume => Undecided::TransientNotGone,
            Some(Sign::Open) | None => Undecided::ExponentOpen,
        };
        self.by_record(Motion::Undecided { why }, witnesses)
    }

    fn periodic(&mut self, orbit: usize, distance: f64) -> Reached {
        let known = &self.repertoire.known[orbit];
        let (orbit, states) = (known.orbit.clone(), known.states_from(self.run.strobe.before_last(0)));
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
        let system = &self.repertoire.system;
        let record = self.run.record.as_ref();
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
        meter.measures(self.repertoire.system.parameters.kappa)
    }

    fn bare(&self, motion: Motion) -> Reached {
        let empty = self.run.strobe.len() == 0;
        let state = if empty { Vec::new() } else { self.run.strobe.before_last(0).to_vec() };
        let period = self.repertoire.system.parameters.period();
        Reached {
            motion,
            measures: None,
            states: vec![state.clone()],
            state,
            time: period * self.run.instants.saturating_sub(1) as f64,
            orbit: None,
            distance: None,
            exponent: None,
            recurrence: self.run.strobe.recurrence(&self.repertoire.system),
            rotation: None,
            zero_one: None,
            longer: None,
            tips: Vec::new(),
            notes: self.run.notes.clone(),
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
