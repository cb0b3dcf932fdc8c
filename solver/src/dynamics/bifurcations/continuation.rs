//! Branches of periodic orbits in any one of the ten parameters: pseudo-arclength continuation through folds, with
//! the places where stability can change located on the way, and the doubled branch that leaves a period doubling.
//!
//! Reference: Seydel, "Practical Bifurcation and Stability Analysis", chapters 4, 5 and 7. The orbits are those of the
//! stroboscopic map, so a branch is lost where the motion touches the magnet or escapes within its period.

use nalgebra::{Complex, DVector};

use super::arclength::Family;
use super::bracket::root;
use super::branch::{Bifurcation, Branch, BranchEnd, BranchPoint, Course, MOST_EFFORT};
use super::{pace, plane::Axis};
use crate::dynamics::integration::measures::Observer;
use crate::dynamics::orbits::floquet::eigenvector;
use crate::dynamics::orbits::period_map::{distance, scales};
use crate::dynamics::orbits::{Instability, OrbitError};
use crate::model::ReducedSystem;

/// Steps in units of the gap and of the parameter's range: first, shortest, longest.
const STEPS: (f64, f64, f64) = (2e-3, 1e-6, 0.02);
/// Growth of the step from one to the next at most, and the part of what is allowed that is tried where multipliers turn.
const GROWTH: f64 = 1.5;
const AHEAD: f64 = 0.9;
/// Smallest cosine between the tangents at the ends of a step.
const STRAIGHT: f64 = 0.97;
/// Accuracy of a located point, in the same units. Where there is nearly no damping, a multiplier crosses the circle this
/// close to where it meets another.
const LOCATED: f64 = 1e-12;
/// The same for the place where a doubled branch closes, on which the parameter depends quadratically, and for the
/// parameter there.
const CLOSED: f64 = 1e-6;
const HALVED: f64 = 1e-9;
/// Secants that locate the place on the orbit of half the period.
const MOST_SECANTS: usize = 12;
/// Largest difference from the orbit that a branch began with, in the units of its place, at which it has come back.
const RETURNED: f64 = 1e-6;
/// Largest difference of the states of one orbit, relative to its amplitude.
const SAME: f64 = 1e-6;
/// Distance from the unit circle beyond which a zero of the test function of tori was not a change of stability.
const ON_CIRCLE: f64 = 1e-4;
/// Distance from 1 or -1 beyond which that of a fold or a doubling was not one. Two multipliers that nearly coincide there, as
/// damping that is nearly none makes them, are good to half the digits.
const ON_AXIS: f64 = 1e-3;
/// A multiplier this close to the unit circle may be on either side of it.
const NEUTRAL: f64 = 1e-8;
/// Distances at which the doubled branch is looked for beside its origin, in units of the gap: the usual ones first, then closer
/// ones, for what leaves it steeply.
const OFFSETS: [f64; 6] = [3e-3, 1e-2, 3e-2, 1e-3, 3e-4, 1e-4];
/// Least distance between the two halves of a doubled orbit, in units of that distance; next to the origin it is 2. Where the
/// parameter moves the orbit that doubles along the same direction, the correction may end on that one, where it is 0.
const HALF_AWAY: f64 = 0.5;

/// Follows the branch of `course` from the orbit of `system` near `state` (length 2N + 1).
///
/// # Errors
/// As [`crate::dynamics::OrbitSolver::find`] when there is no orbit near `state`, [`OrbitError::Singular`] when it is
/// exactly a bifurcation. Once begun, a branch that is lost is an answer, [`BranchEnd::Lost`].
pub fn follow_branch(system: &ReducedSystem, state: &[f64], course: &Course) -> Result<Branch, OrbitError> {
    let mut family = Family::new(system, [axis(course)], course.periods)?.following(course.along);
    let beta = family.beta();
    family.solver.find(state, beta, course.periods)?;
    let value = system.parameters.get(course.parameter);
    let start = family.place(family.solver.state(), [value]);
    let mut along = DVector::zeros(start.len());
    along[start.len() - 1] = if course.upwards { 1.0 } else { -1.0 };
    let heading = family.tangent(&start, &along)?;
    Follower::new(family, course).run(start, heading)
}

/// Follows the forced motions through the range of `course` from its low end and, where that does not come through to the one of
/// the high end, from there, too. `forced` gives the device with a value of the parameter, and the state of its forced motion.
///
/// # Errors
/// Those of `forced` and of [`follow_branch`] at the low end, where there is no branch from the high one either.
pub fn follow_forced(
    forced: &dyn Fn(f64) -> Result<(ReducedSystem, Vec<f64>), OrbitError>,
    course: &Course,
) -> Result<Vec<Branch>, OrbitError> {
    let follow = |(system, state): &(ReducedSystem, Vec<f64>), upwards| {
        follow_branch(system, state, &Course { upwards, ..*course })
    };
    let low = forced(course.range.0).and_then(|start| follow(&start, true));
    let high = match forced(course.range.1) {
        Ok(start) if low.as_ref().is_ok_and(|branch| arrives(branch, course, &start)) => None,
        start => start.and_then(|start| follow(&start, false)).ok(),
    };
    match (low, high) {
        (Err(reason), None) => Err(reason),
        (low, high) => Ok(low.into_iter().chain(high).collect()),
    }
}

/// Whether a branch ends in the motion with this state at the high end of the course.
fn arrives(branch: &Branch, course: &Course, (system, state): &(ReducedSystem, Vec<f64>)) -> bool {
    let (scales, rest) = (scales(system), vec![0.0; state.len()]);
    let last = branch.points.last().filter(|last| last.value == course.range.1);
    branch.end == BranchEnd::Range
        && last.is_some_and(|last| {
            distance(&last.state, state, &scales) <= SAME * distance(&last.state, &rest, &scales)
        })
}

/// Follows the branch of twice the period that leaves `origin`, a period doubling on a branch of `course`.
///
/// Both signs of its direction hold the same orbits, shifted by the half period. The course's direction is not used:
/// the branch goes where it goes.
///
/// # Errors
/// [`OrbitError::NoConvergence`] when no doubled orbit is found nearby (also when `origin` is no period doubling), and
/// those of the map at `origin`.
pub fn follow_doubled(
    system: &ReducedSystem,
    origin: &Bifurcation,
    course: &Course,
) -> Result<Branch, OrbitError> {
    let set = course.along.at(&system.parameters, course.parameter, origin.point.value);
    let system = system.with_numbers(set)?;
    let mut family = Family::new(&system, [axis(course)], course.periods)?.following(course.along);
    let beta = family.beta();
    family.solver.evaluate_at(&origin.point.state, beta, course.periods)?;
    let mode = eigenvector(&family.solver.map().scaled_derivative(), -1.0)?;
    let doubled = Course { periods: 2 * course.periods, ..*course };
    family.periods = doubled.periods;
    let start = family.place(&origin.point.state, [origin.point.value]);
    let direction = mode.push(0.0);
    let mut reason = OrbitError::Singular;
    for offset in OFFSETS {
        let guess = &start + &direction * offset;
        match family.correct(&guess, &direction).and_then(|place| {
            let (state, beta) = (family.state(&place), family.beta());
            family.solver.evaluate_at(&state, beta, course.periods)?;
            let away = family.defect_there().norm();
            if away < HALF_AWAY * offset {
                return Err(OrbitError::NoConvergence { iterations: 1, residual: away });
            }
            let heading = family.tangent(&place, &direction)?;
            Ok((place, heading))
        }) {
            Ok((place, heading)) => return Follower::new(family, &doubled).run(place, heading),
            Err(error) => reason = error,
        }
    }
    Err(reason)
}

fn axis(course: &Course) -> Axis {
    Axis { parameter: course.parameter, range: course.range }
}

/// A place with what is known there.
#[derive(Clone)]
struct Station {
    place: DVector<f64>,
    tangent: DVector<f64>,
    /// Sign of the determinant that [`Family::tangent`] tells.
    orientation: f64,
    /// How far a period turns each mode of the linear device.
    mode_phases: Vec<f64>,
    point: BranchPoint,
    /// What half the period does to the state, scaled; zero where the orbit has half the period.
    halving: Option<DVector<f64>>,
}

/// Whether the orbit of half the period lies between two stations.
fn crosses_half(here: &Station, next: &Station) -> bool {
    here.halving.as_ref().zip(next.halving.as_ref()).is_some_and(|(before, after)| before.dot(after) <= 0.0)
}

/// Whether the bifurcations `found` between two stations make as many multipliers leave or enter the unit circle as do.
fn account_for(found: &[Bifurcation], here: &Station, next: &Station) -> bool {
    let outside = |station: &Station, least: f64| {
        station.point.multipliers.iter().filter(|mu| mu.norm() > least).count() as i32
    };
    let range = |station: &Station| (outside(station, 1.0 + NEUTRAL), outside(station, 1.0 - NEUTRAL));
    let ((least, most), (least_next, most_next)) = (range(here), range(next));
    // Each takes one or two across, one way or the other.
    let reached = found.iter().fold(vec![0], |sums: Vec<i32>, bifurcation| {
        let by = if bifurcation.kind == Instability::NeimarkSacker { 2 } else { 1 };
        sums.iter().flat_map(|sum| [sum - by, sum + by]).collect()
    });
    reached.iter().any(|sum| (least_next - most..=most_next - least).contains(sum))
}

struct Follower {
    family: Family<1>,
    course: Course,
    branch: Branch,
}

impl Follower {
    fn new(family: Family<1>, course: &Course) -> Self {
        let branch =
            Branch { points: Vec::new(), bifurcations: Vec::new(), end: BranchEnd::Points, effort: 0 };
        Self { family, course: *course, branch }
    }

    fn run(mut self, start: DVector<f64>, heading: (DVector<f64>, f64)) -> Result<Branch, OrbitError> {
        let mut here = self.read(start, heading)?;
        let phases = self.phases(&here.place.clone())?;
        self.branch.points.push(here.point.clone());
        let mut step = STEPS.0;
        while self.branch.points.len() < self.course.most_points {
            if self.family.effort() > MOST_EFFORT {
                self.branch.end = BranchEnd::Effort;
                break;
            }
            let (strays, next, border) = match self.advance_within(&here, step) {
                Err(_) if step > STEPS.1 => {
                    step *= 0.5;
                    continue;
                }
                Err(reason) => {
                    self.branch.end = BranchEnd::Lost { reason };
                    break;
                }
                Ok(next) => next,
            };
            let turns = (&here.mode_phases[..], &next.mode_phases[..]);
            let turn = pace::turn(turns, &here.point.multipliers);
            let growth = (AHEAD / pace::turn(turns, &next.point.multipliers)).min(GROWTH);
            // A correction as long as the step, or a sharp turn, may belong to another branch.
            let doubtful = strays
                || turn > 1.0
                || next.tangent.dot(&here.tangent) < STRAIGHT
                || next.orientation != here.orientation && !crosses_half(&here, &next);
            if doubtful && step > STEPS.1 {
                step *= 0.5;
                continue;
            }
            let home = if self.branch.points.len() > 2 { self.returned(&phases, &here, &next) } else { None };
            let (returned, next) = (home.is_some(), home.unwrap_or(next));
            let length = (&next.place - &here.place).dot(&here.tangent);
            let passed = match self.halved(&here, &next, length) {
                Ok(Some(value)) => Err(BranchEnd::Halved { value }),
                Ok(None) => self
                    .bifurcations_between(&here, &next, length)
                    .map_err(|reason| BranchEnd::Lost { reason }),
                Err(reason) => Err(BranchEnd::Lost { reason }),
            };
            let unclear = match &passed {
                Ok(found) => !account_for(found, &here, &next),
                Err(end) => matches!(end, BranchEnd::Lost { .. }),
            };
            if unclear && step > STEPS.1 {
                step *= 0.5;
                continue;
            }
            match passed {
                Ok(found) => self.branch.bifurcations.extend(found),
                Err(end) => {
                    self.branch.end = end;
                    break;
                }
            }
            self.branch.points.push(next.point.clone());
            if border || returned {
                self.branch.end = if returned { BranchEnd::Closed } else { BranchEnd::Range };
                break;
            }
            here = next;
            step = (growth * step).min(STEPS.2);
        }
        self.branch.effort = self.family.effort();
        Ok(self.branch)
    }

    /// The station a step beyond `here` along its tangent, and whether it is too far from where that leads.
    fn advance(&mut self, here: &Station, step: f64) -> Result<(bool, Station), OrbitError> {
        let guess = &here.place + &here.tangent * step;
        let place = self.family.correct(&guess, &here.tangent)?;
        let strays = self.strays(&guess, &place, step);
        let heading = self.family.tangent(&place, &here.tangent)?;
        Ok((strays, self.read(place, heading)?))
    }

    fn strays(&self, predicted: &DVector<f64>, place: &DVector<f64>, step: f64) -> bool {
        (place - predicted).norm() > 0.5 * step || pace::surprises(predicted, place, self.family.dimension())
    }

    /// As [`Self::advance`], but not beyond the course's range; also whether its border is reached.
    fn advance_within(&mut self, here: &Station, step: f64) -> Result<(bool, Station, bool), OrbitError> {
        let (low, high) = self.course.range;
        let outside = |value: f64| value < low || value > high;
        let mut target = self.family.value(&(&here.place + &here.tangent * step));
        if !outside(target) {
            let (strays, next) = self.advance(here, step)?;
            if !outside(next.point.value) {
                return Ok((strays, next, false));
            }
            target = next.point.value;
        }
        let value = target.clamp(low, high);
        let fraction = (value - here.point.value) / (target - here.point.value);
        let guess = &here.place + &here.tangent * (step * fraction);
        let mut normal = DVector::zeros(guess.len());
        normal[guess.len() - 1] = 1.0;
        let guess = self.family.with_value(guess, 0, value);
        let place = self.family.correct(&guess, &normal)?;
        let heading = self.family.tangent(&place, &here.tangent)?;
        let mut next = self.read(place, heading)?;
        next.point.value = value;
        Ok((self.strays(&guess, &next.place, step), next, true))
    }

    /// The stroboscopic states of the orbit at `place`, that one first, with the same parameter.
    fn phases(&mut self, place: &DVector<f64>) -> Result<Vec<DVector<f64>>, OrbitError> {
        let (beta, value) = (self.family.beta(), self.family.value(place));
        let mut phases = vec![place.clone()];
        let mut state = self.family.state(place);
        for _ in 1..self.course.periods {
            self.family.solver.evaluate_at(&state, beta, 1)?;
            state = self.family.solver.map().image().to_vec();
            phases.push(self.family.place(&state, [value]));
        }
        Ok(phases)
    }

    /// The station between two others at which the branch comes back to its origin, an orbit with these `phases`, if it
    /// does. A branch of orbits of several periods may come back to it at any of them.
    fn returned(&mut self, phases: &[DVector<f64>], here: &Station, next: &Station) -> Option<Station> {
        let length = (&next.place - &here.place).dot(&here.tangent);
        phases.iter().find_map(|phase| {
            let ahead = phase - &here.place;
            let step = ahead.dot(&here.tangent);
            let near = (0.0..=length).contains(&step) && ahead.norm() <= 2.0 * length;
            let (_, there) = near.then(|| self.advance(here, step).ok())??;
            ((&there.place - phase).amax() <= RETURNED).then_some(there)
        })
    }

    /// Measures the orbit at `place`.
    fn read(
        &mut self,
        place: DVector<f64>,
        (tangent, orientation): (DVector<f64>, f64),
    ) -> Result<Station, OrbitError> {
        let Family { solver, system, periods, .. } = &mut self.family;
        let beta = system.parameters.beta;
        let state = solver.state().to_vec();
        let halving = if periods.is_multiple_of(2) {
            solver.evaluate_at(&state, beta, *periods / 2)?;
            Some(solver.defect())
        } else {
            None
        };
        let mut observer = Observer::default();
        solver.evaluate_observed(beta, *periods, |step, _| {
            observer.record(step, 1.0);
        })?;
        let multipliers = solver.multipliers()?;
        let measures = observer.measures(system.parameters.kappa).unwrap_or_default();
        let value = self.family.value(&place);
        let state = self.family.state(&place);
        let point = BranchPoint { value, state, multipliers, measures };
        let mode_phases = pace::mode_phases(&self.family.system, self.family.periods);
        Ok(Station { place, tangent, orientation, mode_phases, point, halving })
    }

    /// The parameter where the orbit has half its period between two stations, if there.
    fn halved(&mut self, here: &Station, next: &Station, step: f64) -> Result<Option<f64>, OrbitError> {
        let (Some(before), Some(after)) = (&here.halving, &next.halving) else { return Ok(None) };
        if !crosses_half(here, next) {
            return Ok(None);
        }
        let (a, b) = (before.dot(before), before.dot(after));
        let located = self.between(here, (0.0, a), (step, b), CLOSED, |station| {
            station.halving.as_ref().map_or(0.0, |halving| halving.dot(before))
        });
        let found =
            match located {
                Ok(found) => found,
                // Where the two branches cross, corrections may stall on rounding; the nearer end is near enough.
                Err(OrbitError::NoConvergence { .. } | OrbitError::Singular) => {
                    if before.norm() < after.norm() { here.clone() } else { next.clone() }
                }
                Err(reason) => return Err(reason),
            };
        self.family.periods /= 2;
        let value = self.half_orbit_doubles_near(&found);
        self.family.periods *= 2;
        value.map(Some)
    }

    /// Where the orbit of half the period, near `station`, has the multiplier -1: the two branches cross there, so
    /// that the correction along the doubled one is not to be trusted. Secants in the parameter.
    fn half_orbit_doubles_near(&mut self, station: &Station) -> Result<f64, OrbitError> {
        let (low, high) = self.course.range;
        let mut normal = DVector::zeros(station.place.len());
        normal[station.place.len() - 1] = 1.0;
        let mut place = station.place.clone();
        let mut test = |value: f64| {
            let guess = self.family.with_value(place.clone(), 0, value);
            place = self.family.correct(&guess, &normal)?;
            Ok::<f64, OrbitError>(Instability::PeriodDoubling.test(&self.family.solver.multipliers()?))
        };
        let mut value = station.point.value;
        let mut change = CLOSED * (high - low);
        let mut before = test(value)?;
        for _ in 0..MOST_SECANTS {
            value += change;
            let now = test(value)?;
            change *= now / (before - now);
            before = now;
            if change.abs() <= HALVED * (high - low) {
                return Ok(value + change);
            }
        }
        Err(OrbitError::NoConvergence { iterations: MOST_SECANTS, residual: before.abs() })
    }

    /// The changes of stability between two stations, `length` apart along the first one's tangent.
    fn bifurcations_between(
        &mut self,
        here: &Station,
        next: &Station,
        length: f64,
    ) -> Result<Vec<Bifurcation>, OrbitError> {
        let last = here.place.len() - 1;
        let mut all = Vec::new();
        for kind in [Instability::Fold, Instability::PeriodDoubling, Instability::NeimarkSacker] {
            let test = |station: &Station| match kind {
                // The parameter turns at a fold; its test function also vanishes where branches cross.
                Instability::Fold => station.tangent[last],
                _ => kind.test(&station.point.multipliers),
            };
            let (a, b) = (test(here), test(next));
            if (a < 0.0) == (b < 0.0) {
                continue;
            }
            let found = self.between(here, (0.0, a), (length, b), LOCATED, test)?;
            let crosses = |mu: &Complex<f64>| match kind {
                Instability::Fold => (mu - 1.0).norm() < ON_AXIS,
                Instability::PeriodDoubling => (mu + 1.0).norm() < ON_AXIS,
                Instability::NeimarkSacker => {
                    (mu.norm() - 1.0).abs() < ON_CIRCLE && Instability::of(*mu) == kind
                }
            };
            if found.point.multipliers.iter().any(crosses) {
                let after = self.branch.points.len();
                all.push(Bifurcation { after, kind, point: found.point });
            }
        }
        Ok(all)
    }

    /// The station beyond `here` where `test` vanishes, between two steps with values of opposite sign.
    fn between(
        &mut self,
        here: &Station,
        a: (f64, f64),
        b: (f64, f64),
        tolerance: f64,
        test: impl Fn(&Station) -> f64,
    ) -> Result<Station, OrbitError> {
        let mut last = here.clone();
        root(a, b, tolerance, |step| {
            last = self.advance(here, step)?.1;
            Ok::<f64, OrbitError>(test(&last))
        })?;
        Ok(last)
    }
}
