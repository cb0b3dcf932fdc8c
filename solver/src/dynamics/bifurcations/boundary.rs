//! The lowest excitation at which the forced motion is unstable, by its Floquet multipliers.
//!
//! The forced motion, the one that grows out of rest as beta grows from 0, is followed in beta at a fixed frequency (by
//! the march, whose stations do not depend on the limit asked for). Whether a multiplier leaves the unit circle between
//! two stations is asked of the smooth test functions of all multipliers (see [`Instability::test`]): where one has
//! changed its sign, the crossing is located; where the parabola through three neighbouring stations dips towards
//! zero, more stations are set at its lowest place, until the dip is seen to pass zero or not to. So a window of
//! instability need not contain a station to be found. No smallness of anything is assumed.
//!
//! What can still be missed: a window within a dip so sharp that no parabola through three stations foresees it (the
//! multipliers move by less than 0.2 from one to the next), or narrower than a ten-millionth of its beta; a third
//! crossing between two stations with one; just below a boundary, in the same step, a window of another kind; two folds
//! so close that the motion goes on beyond them as before; and, where nothing dissipates, a window of complex
//! multipliers between two stations, because the test for these then vanishes and only the moduli at the stations are
//! left to look at.

use nalgebra::Complex;

use super::bracket::root;
use crate::dynamics::orbits::march::{Forced, March};
use crate::dynamics::orbits::{Instability, OrbitError, OrbitSolver};
use crate::model::ReducedSystem;
use crate::theory::{CoupledModes, Resonance};

/// Accuracy of a located beta, relative to it.
const LOCATED: f64 = 1e-10;
/// A modulus above 1 by less than this is an undamped multiplier and rounding.
const MARGIN: f64 = 1e-9;
/// The same of one that may be a fold's.
const FOLD_MARGIN: f64 = 1e-6;
/// A parabola that falls below this fraction of the lower of its values about its lowest place calls for a station there.
const DIP: f64 = 0.5;
/// Width of an interval, relative to its beta, that is not divided any more.
const NARROW: f64 = 1e-7;
/// Most stations set in the dips beside one of the march.
const MOST_EXTRA: usize = 60;
/// Distance of a multiplier from 1 within which an end of the motion may be a fold.
const AT_FOLD: f64 = 0.05;
/// How far beyond the last station a fold may lie, in distances of the last two.
const FOLD_REACH: f64 = 10.0;

/// What the march in beta found.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum CriticalExcitation {
    /// The forced motion loses its stability.
    Unstable {
        /// The lowest unstable beta (dimensionless).
        beta: f64,
        /// How it becomes unstable.
        instability: Instability,
        /// The multiplier that leaves the unit circle, the upper of a pair.
        multiplier: Complex<f64>,
    },
    /// It is stable (in the ways asked about) up to the limit.
    Stable,
    /// It cannot be followed to the limit: it meets another motion and both end, or it escapes, or touches.
    Ends {
        /// Where it ends (dimensionless): the fold, or the last beta reached.
        beta: f64,
    },
}

impl CriticalExcitation {
    /// The lowest unstable beta, if there is one below the limit and before the forced motion ends.
    pub fn beta(&self) -> Option<f64> {
        match *self {
            Self::Unstable { beta, .. } => Some(beta),
            Self::Stable | Self::Ends { .. } => None,
        }
    }
}

impl Resonance {
    /// How the forced motion loses stability at this resonance.
    pub const fn instability(self) -> Instability {
        match self {
            Self::Sum => Instability::NeimarkSacker,
            Self::First | Self::Second => Instability::PeriodDoubling,
        }
    }
}

/// A place where the forced motion loses stability.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Loss {
    /// The excitation (dimensionless).
    pub beta: f64,
    /// How: a fold is where the motion ends.
    pub instability: Instability,
    /// The multiplier that leaves the unit circle, the upper of a pair.
    pub multiplier: Complex<f64>,
}

/// Where a resonance makes the forced motion unstable, and what comes before.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ResonanceBoundary {
    /// The lowest beta from which it is unstable by the resonance; `None` when that does not happen below the limit.
    pub beta: Option<f64>,
    /// The first loss of stability of any kind, at or below [`Self::beta`], else below the limit.
    pub first: Option<Loss>,
    /// Where the motion ends, when it does so before the resonance makes it unstable and below the limit: at a fold
    /// with another motion, or at the last beta to which it could be followed before it touches or escapes.
    pub ends: Option<f64>,
}

/// The lowest beta up to `limit` at which the forced motion of `system` at frequency `omega` is unstable, in the way
/// `only` if given, else in any way. The beta and omega of the system itself are not used.
///
/// # Errors
/// [`OrbitError::Model`] when `omega` is out of range, and [`OrbitError::Multipliers`].
pub fn critical_excitation(
    system: &ReducedSystem,
    omega: f64,
    limit: f64,
    only: Option<Instability>,
) -> Result<CriticalExcitation, OrbitError> {
    let system = system.with_excitation(0.0, omega)?;
    let asked = only.map_or(Asked::Any, Asked::Kind);
    Ok(ForcedSurvey::of(&mut OrbitSolver::new(&system), limit, asked)?.critical())
}

/// The lowest beta up to `limit` at which the forced motion of `system` at frequency `omega` is unstable by `resonance`,
/// and the first loss of stability of any kind on the way. The beta and omega of the system itself are not used.
///
/// A loss of stability is the resonance's when it is of its kind and when the resonance's centre O_i + O_j is the nearest
/// to `omega` of all that lead to this kind: 2 O_k and 2 O_k / 3 of every mode to a doubling, O_k + O_l and
/// (O_k + O_l) / 2 of every two modes to a complex pair. Only the linear frequencies are asked: in a strong motion, at a
/// resonance of higher order, another mode than the resonance's may be the one that begins to swing.
///
/// # Errors
/// As [`critical_excitation`].
pub fn resonance_boundary(
    system: &ReducedSystem,
    omega: f64,
    limit: f64,
    resonance: Resonance,
) -> Result<ResonanceBoundary, OrbitError> {
    let system = system.with_excitation(0.0, omega)?;
    let nearest = is_nearest(&system, omega, resonance);
    let asked = if nearest { Asked::Kind(resonance.instability()) } else { Asked::Nothing };
    let ForcedSurvey { found, first, ends, .. } =
        ForcedSurvey::of(&mut OrbitSolver::new(&system), limit, asked)?;
    Ok(ResonanceBoundary { beta: found.map(|(loss, _)| loss.beta), first, ends })
}

/// Whether the centre of `resonance` is the nearest to `omega`, as [`resonance_boundary`] has it. Higher orders, 2 O_k / 5,
/// 2 O_k / 7, .., are narrow, and of many modes together everywhere.
fn is_nearest(system: &ReducedSystem, omega: f64, resonance: Resonance) -> bool {
    let beam: Vec<f64> = system.modes.iter().map(|mode| mode.omega).collect();
    // With the circuit, where it leaves every mode its oscillation.
    let coupled = CoupledModes::new(system).ok().filter(|coupled| coupled.modes().len() == beam.len());
    let frequencies = coupled.map_or(beam, |found| found.modes().iter().map(|mode| mode.frequency).collect());
    let (i, j) = resonance.pair();
    let (Some(first), Some(second)) = (frequencies.get(i), frequencies.get(j)) else { return false };
    let own = (first + second - omega).abs();
    let order = if i == j { 3.0 } else { 2.0 };
    let pairs = (0..frequencies.len()).flat_map(|k| (0..=k).map(move |l| (l, k)));
    pairs.filter(|(k, l)| (k == l) == (i == j)).all(|(k, l)| {
        let sum = frequencies[k] + frequencies[l];
        [sum, sum / order].iter().all(|centre| (centre - omega).abs() >= own)
    })
}

/// The largest Floquet multiplier of the forced motion of `system` at frequency `omega` for each of the ascending
/// `betas`: one column of a stability chart. `None` from where the motion cannot be followed.
///
/// # Errors
/// As [`critical_excitation`].
pub fn largest_multipliers(
    system: &ReducedSystem,
    omega: f64,
    betas: &[f64],
) -> Result<Vec<Option<Complex<f64>>>, OrbitError> {
    let mut solver = OrbitSolver::new(&system.with_excitation(0.0, omega)?);
    let mut here = Some(Forced::at_rest(&mut solver)?);
    let mut values = Vec::with_capacity(betas.len());
    for beta in betas {
        here = match here {
            Some(forced) => forced.march_to(&mut solver, *beta)?,
            None => None,
        };
        values.push(here.as_ref().and_then(|forced| forced.multipliers.first().copied()));
    }
    Ok(values)
}

/// What is looked for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Asked {
    /// Any loss of stability.
    Any,
    /// One of this kind.
    Kind(Instability),
    /// Nothing in particular: how the motion fares up to the limit.
    Nothing,
}

/// What is known of the forced motion up to the loss of stability asked for, or to the limit.
#[derive(Debug)]
pub(super) struct ForcedSurvey {
    /// What was asked for, and the orbit there.
    pub(super) found: Option<(Loss, Forced)>,
    /// The first loss of any kind.
    first: Option<Loss>,
    /// Where the motion ends.
    ends: Option<f64>,
    /// The last station that is not beyond the limit.
    pub(super) last: Forced,
}

/// A station with its test functions.
#[derive(Debug, Clone)]
struct Station {
    forced: Forced,
    /// Of period doublings and of complex pairs.
    tests: [f64; 2],
}

/// The kinds that have a smooth test, in the order of [`Station::tests`].
const TESTED: [Instability; 2] = [Instability::PeriodDoubling, Instability::NeimarkSacker];
const KINDS: [Instability; 3] = [Instability::Fold, Instability::PeriodDoubling, Instability::NeimarkSacker];

impl Station {
    fn new(forced: Forced) -> Self {
        let tests = TESTED.map(|kind| kind.test(&forced.multipliers));
        Self { forced, tests }
    }

    fn beta(&self) -> f64 {
        self.forced.beta
    }

    /// The same motion half a period later, under the excitation of opposite sign.
    fn mirrored(&self) -> Self {
        let mut mirrored = self.clone();
        mirrored.forced.beta = -self.forced.beta;
        mirrored
    }

    /// The multiplier that is about to cross the unit circle in the way `kind`, the upper of a pair: the nearest to 1 or
    /// -1, or the upper of the two whose product is nearest to 1.
    fn critical(&self, kind: Instability) -> Option<Complex<f64>> {
        let all = &self.forced.multipliers;
        let nearest = |place: f64| {
            let distance = |mu: &Complex<f64>| (mu - place).norm_sqr();
            all.iter().copied().min_by(|a, b| distance(a).total_cmp(&distance(b)))
        };
        match kind {
            Instability::Fold => nearest(1.0),
            Instability::PeriodDoubling => nearest(-1.0),
            Instability::NeimarkSacker => {
                let pairs =
                    all.iter().enumerate().flat_map(|(i, a)| all[i + 1..].iter().map(move |b| (*a, a * b)));
                let distance = |(_, product): &(Complex<f64>, Complex<f64>)| (product - 1.0).norm_sqr();
                pairs.min_by(|a, b| distance(a).total_cmp(&distance(b))).map(|(upper, _)| upper)
            }
        }
    }

    /// How many multipliers are outside of the unit circle, by more than `margin`, and as `counted` says.
    fn outside(&self, margin: f64, counted: impl Fn(Instability) -> bool) -> usize {
        let outside = self.forced.multipliers.iter().take_while(|mu| mu.norm() > 1.0 + margin);
        outside.filter(|mu| counted(Instability::of(**mu))).count()
    }
}

impl ForcedSurvey {
    /// The march and what it finds, of the system and omega of `solver`.
    pub(super) fn of(solver: &mut OrbitSolver, limit: f64, asked: Asked) -> Result<Self, OrbitError> {
        let mut march = March::from_rest(solver)?;
        // Where something is not damped, the product of pairs is all rounding, whatever its sign.
        let damped = march.here.multipliers.iter().all(|mu| (mu.norm() - 1.0).abs() > MARGIN);
        let smooth = if damped { 2 } else { 1 };
        let mut stations = vec![Station::new(march.here.clone())];
        let mut survey = Self { found: None, first: None, ends: None, last: march.here.clone() };
        while survey.found.is_none() && march.here.beta < limit {
            let Some(next) = march.step(solver, f64::INFINITY)? else {
                survey.end(&stations, limit);
                break;
            };
            march.here = next.clone();
            let next = Station::new(next);
            if stations.len() == 1 {
                stations.insert(0, next.mirrored());
            }
            stations.push(next);
            let here = stations[1].beta();
            follow_dips(solver, &mut stations, smooth)?;
            // The interval before may have been divided only now.
            let from = if stations[1].beta() < here { stations[0].beta() } else { here };
            for pair in stations.windows(2).filter(|pair| pair[0].beta() >= from) {
                for kind in KINDS {
                    if let Some((loss, orbit)) = locate(solver, pair, kind, damped)?
                        && loss.beta <= limit
                    {
                        survey.take((loss, orbit), asked);
                    }
                }
            }
            if let Some(station) = stations.iter().rfind(|station| station.beta() <= limit) {
                survey.last = station.forced.clone();
            }
            stations.drain(..stations.len() - 2);
        }
        Ok(survey)
    }

    /// Takes a loss of stability into account.
    fn take(&mut self, (loss, orbit): (Loss, Forced), asked: Asked) {
        if self.first.is_none_or(|first| loss.beta < first.beta) {
            self.first = Some(loss);
        }
        let asked_for = match asked {
            Asked::Any => true,
            Asked::Kind(kind) => kind == loss.instability,
            Asked::Nothing => false,
        };
        if asked_for && self.found.as_ref().is_none_or(|(found, _)| loss.beta < found.beta) {
            self.found = Some((loss, orbit));
        }
    }

    /// Notes that the motion cannot be followed beyond the last of `stations`.
    fn end(&mut self, stations: &[Station], limit: f64) {
        let Some(last) = stations.last() else { return };
        let fold = fold_beyond(stations);
        let beta = fold.unwrap_or(last.beta());
        if beta > limit {
            return;
        }
        self.ends = Some(beta);
        if fold.is_some() && self.first.is_none() {
            let (instability, multiplier) = (Instability::Fold, Complex::from(1.0));
            self.first = Some(Loss { beta, instability, multiplier });
        }
    }

    /// The answer of [`critical_excitation`].
    pub(super) fn critical(&self) -> CriticalExcitation {
        match (&self.found, self.ends) {
            (Some((Loss { beta, instability, multiplier }, _)), _) => CriticalExcitation::Unstable {
                beta: *beta,
                instability: *instability,
                multiplier: *multiplier,
            },
            (None, Some(beta)) => CriticalExcitation::Ends { beta },
            (None, None) => CriticalExcitation::Stable,
        }
    }
}

/// Where the test for folds vanishes, close beyond the last station, when a multiplier is close to 1: it falls with the
/// square root of the distance from the fold.
fn fold_beyond(stations: &[Station]) -> Option<f64> {
    let [.., before, last] = stations else { return None };
    let square = |station: &Station| Instability::Fold.test(&station.forced.multipliers).powi(2);
    let (a, b) = (square(before), square(last));
    let width = last.beta() - before.beta();
    let ahead = width * b / (a - b);
    let near = last.critical(Instability::Fold).is_some_and(|mu| (mu - 1.0).norm() < AT_FOLD);
    (near && b < a && ahead < FOLD_REACH * width).then(|| last.beta() + ahead)
}

/// Sets further stations where one of the first `smooth` tests dips towards zero between two of `stations`.
fn follow_dips(
    solver: &mut OrbitSolver,
    stations: &mut Vec<Station>,
    smooth: usize,
) -> Result<(), OrbitError> {
    for _ in 0..MOST_EXTRA {
        let places = 0..stations.len().saturating_sub(2);
        let Some((place, beta)) =
            places.flat_map(|i| (0..smooth).map(move |test| (i, test))).find_map(|(i, test)| {
                let points = [0, 1, 2].map(|k| (stations[i + k].beta(), stations[i + k].tests[test]));
                dip(points).map(|(side, beta)| (i + side + 1, beta))
            })
        else {
            return Ok(());
        };
        // Backwards the next station predicts by the cubic between both.
        match stations[place].forced.move_to(solver, beta) {
            Ok(forced) => stations.insert(place, Station::new(forced)),
            Err(OrbitError::Multipliers) => return Err(OrbitError::Multipliers),
            Err(_) => return Ok(()),
        }
    }
    Ok(())
}

/// Where the parabola through three points falls to zero or far towards it between two of them whose values have the
/// same sign: before (0) or behind (1) the middle one, and at which abscissa.
fn dip([a, b, c]: [(f64, f64); 3]) -> Option<(usize, f64)> {
    let (left, right) = ((b.1 - a.1) / (b.0 - a.0), (c.1 - b.1) / (c.0 - b.0));
    let curvature = (right - left) / (c.0 - a.0);
    // Newton's form: b.1 + slope (x - b.0) + curvature (x - b.0)^2.
    let slope = left + curvature * (b.0 - a.0);
    let lowest = b.0 - 0.5 * slope / curvature;
    let (side, low, high) = if lowest < b.0 { (0, a, b) } else { (1, b, c) };
    let value = b.1 - 0.25 * slope * slope / curvature;
    let inside = (lowest - low.0).min(high.0 - lowest) > 0.5 * NARROW * high.0;
    let sign = low.1.signum();
    let falls = sign == high.1.signum()
        && sign * curvature > 0.0
        && sign * value < DIP * low.1.abs().min(high.1.abs());
    (inside && low.0 >= 0.0 && falls).then_some((side, lowest))
}

/// The loss of stability of one `kind` between two neighbouring stations, and the orbit there.
fn locate(
    solver: &mut OrbitSolver,
    pair: &[Station],
    kind: Instability,
    damped: bool,
) -> Result<Option<(Loss, Forced)>, OrbitError> {
    let [from, to] = pair else { return Ok(None) };
    // Of two multipliers close to 1, a fold's and that of a hardly loaded charge, half the digits are rounding. A pair
    // that has left may meet on the real axis before the next station; one multiplier at a time cannot.
    let outside = |station: &Station| match kind {
        Instability::Fold => station.outside(FOLD_MARGIN, |other| other == kind),
        Instability::PeriodDoubling => station.outside(0.0, |other| other == kind),
        Instability::NeimarkSacker if damped => station.outside(0.0, |_| true),
        Instability::NeimarkSacker => station.outside(MARGIN, |other| other == kind),
    };
    let before = outside(from);
    if outside(to) <= before {
        return Ok(None);
    }
    let test = |station: &Station| kind.test(&station.forced.multipliers);
    let changes = (test(from) < 0.0) != (test(to) < 0.0);
    let smooth = match kind {
        Instability::Fold => changes,
        Instability::PeriodDoubling => true,
        Instability::NeimarkSacker => damped,
    };
    if smooth && !changes {
        return Ok(None);
    }
    // Without a smooth test only stability itself is left to ask for.
    let test = |station: &Station| match smooth {
        true => test(station),
        false if outside(station) > before => 1.0,
        false => -1.0,
    };
    let mut last = to.clone();
    root((from.beta(), test(from)), (to.beta(), test(to)), LOCATED * to.beta(), |beta| {
        let near = if (beta - from.beta()).abs() < (beta - last.beta()).abs() { from } else { &last };
        let moved = match near.forced.move_to(solver, beta) {
            Ok(moved) => moved,
            // Close to a fold in shorter steps.
            Err(_) => from.forced.clone().march_to(solver, beta)?.ok_or(OrbitError::MotionEnds { beta })?,
        };
        last = Station::new(moved);
        Ok::<f64, OrbitError>(test(&last))
    })?;
    let multiplier = last.critical(kind);
    // Two real multipliers whose product passes 1 also change the sign of the test for pairs.
    Ok(multiplier
        .filter(|mu| Instability::of(*mu) == kind)
        .map(|multiplier| (Loss { beta: last.beta(), instability: kind, multiplier }, last.forced)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_dip_is_where_a_parabola_falls_far_below_its_neighbours() {
        let at = |function: fn(f64) -> f64, places: [f64; 3]| dip(places.map(|x| (x, function(x))));
        let near = |found: Option<(usize, f64)>, side: usize, place: f64| {
            found.is_some_and(|(where_, beta)| where_ == side && (beta - place).abs() < 1e-12)
        };
        // Below zero, behind and before the middle, and turned over.
        assert!(near(at(|x| (x - 2.6).powi(2) - 0.1, [1.0, 2.0, 3.5]), 1, 2.6));
        assert!(near(at(|x| (x - 1.4).powi(2) - 0.1, [1.0, 2.0, 3.5]), 0, 1.4));
        assert!(near(at(|x| 0.1 - (x - 2.6).powi(2), [1.0, 2.0, 3.5]), 1, 2.6));
        // Hardly lower than a station, beyond the stations, a hump, on a side with a change of sign, at negative beta.
        assert_eq!(at(|x| (x - 2.6).powi(2) + 1.0, [1.0, 2.0, 3.5]), None);
        assert_eq!(at(|x| (x - 5.0).powi(2), [1.0, 2.0, 3.5]), None);
        assert_eq!(at(|x| 3.0 - (x - 2.6).powi(2), [1.0, 2.0, 3.5]), None);
        assert_eq!(at(|x| (x - 2.1).powi(2) - 1.0, [1.0, 2.0, 3.0]), None);
        assert_eq!(at(|x| (x + 0.4).powi(2) - 0.1, [-1.0, 0.0, 1.0]), None);
        assert_eq!(at(|x| x, [0.0, 1.0, 2.0]), None);
    }
}
