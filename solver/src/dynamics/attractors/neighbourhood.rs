//! The linear neighbourhood of a periodic motion: whether the last stroboscopic states of a run lie in it, and what they
//! do there.
//!
//! The deviation of a state from the orbit is split by the left eigenvectors of the monodromy matrix. Close enough to
//! the orbit each part then shrinks or grows by its own multiplier. A run has reached a stable orbit when the parts that
//! matter do so at their multipliers' own rates: were another motion's border near, such as the unstable motion of
//! twice the period beside a doubling, the slow part would shrink at another rate than that.

use nalgebra::{Complex, DMatrix, DVector};

use super::strobe::Strobe;
use crate::dynamics::orbits::period_map::distance;
use crate::dynamics::orbits::{Orbit, OrbitError, OrbitSolver};
use crate::model::ReducedSystem;

/// Distance from the orbit, relative to the amplitude of the run, beyond which nothing is asked.
const FAR: f64 = 0.3;
/// The same relative to the gap, beyond which a decay at the orbit's rate is a coincidence.
const NEAR: f64 = 0.1;
/// Distance, relative to the gap, within which the magnet's force is as good as linear.
const LINEAR: f64 = 0.01;
/// Amplitude, relative to the gap, below which a motion is rest.
const REST: f64 = 1e-3;
/// Deviation, relative to the amplitude, that counts as none.
const NONE: f64 = 1e-7;
/// Error of the orbit's state by the difference between the integrator and the map, relative to the gap, times the
/// distance of the multiplier from the unit circle.
const MAP_ERROR: f64 = 2e-9;
/// A multiplier whose modulus is this close to 1 may be on either side of it.
const NEUTRAL: f64 = 1e-8;
/// A direction whose deviation shrinks below this in the window need not be watched.
const FAST: f64 = 1e-3;
/// Fewest returns to the orbit that are looked at, and most.
const WINDOW: (usize, usize) = (8, 3000);
/// Decay that must be seen in each third of the window (natural logarithm): so much for a deviation of the size of the gap,
/// since the force's curvature bends the decay in proportion to the deviation, but no less and no more than the limits.
const SEEN: f64 = 10.0;
const SEEN_LIMITS: (f64, f64) = (2e-3, 0.25);
/// Measured over promised rate, lowest and highest, in each of the last two thirds of the window.
const RATE: (f64, f64) = (0.8, 1.25);
/// A direction whose part of the deviation is smaller than this, relative to the largest, is watched only when it is the
/// slowest.
const MINOR: f64 = 0.1;
/// Growth, relative to the promised one, below which a motion that was leaving no longer does.
const SATURATED: f64 = 0.2;

/// What a run does near an orbit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Relation {
    /// It is not near, or neither comes nearer nor leaves.
    Apart,
    /// The orbit is stable, and the run has come so close that it cannot go elsewhere.
    Reached {
        /// Its distance, relative to the amplitude.
        distance: f64,
    },
    /// The orbit is stable and the run comes nearer, but not yet at the orbit's own rate.
    Approaching {
        /// Excitation periods after which it should.
        periods: f64,
    },
    /// The orbit is unstable and the run is still close.
    Leaving {
        /// Excitation periods that it takes to leave.
        periods: f64,
    },
}

/// A direction in which deviations shrink or grow by one multiplier.
#[derive(Debug, Clone)]
struct Direction {
    multiplier: Complex<f64>,
    /// Left eigenvector: its product with a scaled deviation is that deviation's part along the right one, whose largest
    /// component is 1.
    left: DVector<Complex<f64>>,
}

/// An orbit with the directions about it.
#[derive(Debug, Clone)]
pub(super) struct Neighbourhood {
    pub(super) orbit: Orbit,
    /// Its states at stroboscopic instants, the orbit's own first.
    states: Vec<Vec<f64>>,
    scales: Vec<f64>,
    /// theta_n / c, without a load only: the charge, v minus its product with the displacements, is then conserved.
    charge: Option<Vec<f64>>,
    /// By descending modulus of the multiplier, one of each conjugate pair.
    directions: Vec<Direction>,
}

impl Neighbourhood {
    /// About `orbit`, of which `solver` holds the map and the derivative over its shortest period.
    ///
    /// # Errors
    /// As [`crate::dynamics::PeriodMap::apply`]; [`OrbitError::Singular`] when the eigenvectors cannot be computed.
    pub(super) fn new(
        orbit: Orbit,
        solver: &mut OrbitSolver,
        system: &ReducedSystem,
    ) -> Result<Self, OrbitError> {
        let p = &system.parameters;
        let matrix = solver.monodromy().map(Complex::from);
        let map = solver.map();
        let scales = map.scales().to_vec();
        let mut states = vec![orbit.state.clone()];
        while let Some(last) = states.last().filter(|_| states.len() < orbit.periods) {
            map.carry(last, p.beta, 1)?;
            states.push(map.image().to_vec());
        }
        let upper = orbit.multipliers.iter().filter(|multiplier| multiplier.im >= 0.0);
        let slow = upper.filter(|multiplier| watched(**multiplier));
        let directions =
            slow.map(|multiplier| Direction::new(&matrix, *multiplier)).collect::<Result<_, _>>()?;
        let charge =
            (p.kappa == 0.0).then(|| system.theta.iter().map(|theta| theta / system.capacitance).collect());
        Ok(Self { orbit, states, scales, charge, directions })
    }

    /// Whether `state` is a stroboscopic state of the orbit, up to `within` (a displacement in beam lengths).
    pub(super) fn holds(&self, state: &[f64], within: f64) -> bool {
        self.states.iter().any(|own| self.between(own, state) <= within)
    }

    /// Largest distance of the last states from the orbit's stroboscopic ones, as a displacement in beam lengths.
    pub(super) fn distance_lately(&self, strobe: &Strobe) -> f64 {
        let nearest = |state: &[f64]| {
            self.states.iter().map(|own| self.between(own, state)).fold(f64::INFINITY, f64::min)
        };
        (0..WINDOW.0.min(strobe.len())).map(|back| nearest(strobe.before_last(back))).fold(0.0, f64::max)
    }

    /// The stroboscopic states of the orbit in their order, from the one nearest to `state`.
    pub(super) fn states_from(&self, state: &[f64]) -> Vec<Vec<f64>> {
        let distance = |k: &usize| self.between(&self.states[*k], state);
        let nearest = (0..self.states.len()).min_by(|a, b| distance(a).total_cmp(&distance(b))).unwrap_or(0);
        let mut states = self.states.clone();
        states.rotate_left(nearest);
        states
    }

    /// Distance of `state` from the orbit's own, as a displacement in beam lengths.
    fn distance(&self, state: &[f64]) -> f64 {
        self.between(state, &self.orbit.state)
    }

    fn between(&self, a: &[f64], b: &[f64]) -> f64 {
        distance(a, b, &self.scales)
    }

    /// Difference of the conserved charges of two states, scaled as the voltage; none with a load.
    fn charge_between(&self, a: &[f64], b: &[f64]) -> f64 {
        let Some(charge) = &self.charge else { return 0.0 };
        let last = a.len() - 1;
        let of = |state: &[f64]| state[last] - charge.iter().zip(state).map(|(c, q)| c * q).sum::<f64>();
        (of(a) - of(b)).abs() / self.scales[last]
    }

    /// What the run whose last states `strobe` holds does near this orbit, where `gap` is the unit of displacements.
    pub(super) fn relation(&self, strobe: &Strobe, gap: f64) -> Relation {
        let period = self.orbit.periods;
        if strobe.len() < period {
            return Relation::Apart;
        }
        // The instant, among the last `period` ones, in step with the orbit's own state.
        let nearest = (0..period).map(|back| (back, self.distance(strobe.before_last(back))));
        let Some((offset, _)) = nearest.min_by(|a, b| a.1.total_cmp(&b.1)) else { return Relation::Apart };
        let held = (strobe.len() - 1 - offset) / period + 1;
        let unit = strobe.recent_amplitude().max(REST * gap);
        let sizes = |count: usize| {
            (0..count.min(held)).map(|k| self.distance(strobe.before_last(offset + k * period)))
        };
        let recent = sizes(WINDOW.0).fold(0.0, f64::max);
        if held < WINDOW.0 || recent > (FAR * unit).max(LINEAR * gap) {
            return Relation::Apart;
        }
        if self.charge_between(strobe.before_last(offset), &self.orbit.state) > NONE * unit {
            return Relation::Apart;
        }
        let part = |direction: &Direction, k: usize| {
            direction.part(strobe.before_last(offset + k * period), &self.orbit.state, &self.scales)
        };
        let unstable = self.directions.iter().filter(|direction| direction.multiplier.norm() > 1.0);
        let mut leaves: Option<f64> = None;
        for direction in unstable {
            let rate = direction.multiplier.norm().ln();
            let size = mean_size(|k| part(direction, k), 0, WINDOW.0);
            let window = window(rate, held);
            let growth = (mean_log(|k| part(direction, k), 0, window / 2)
                - mean_log(|k| part(direction, k), window / 2, window))
                / ((window / 2) as f64 * rate);
            // One that no longer grows as promised has met the motion that it was growing towards.
            let saturated = growth < SATURATED && size > MAP_ERROR * gap / rate;
            if !saturated {
                let periods = (FAR * unit / size.max(1e-15 * gap)).ln().max(1.0) / rate * period as f64;
                leaves = Some(leaves.map_or(periods, |other| other.min(periods)));
            }
        }
        if let Some(periods) = leaves {
            return Relation::Leaving { periods };
        }
        if !self.orbit.stable() || self.orbit.largest_multiplier().norm() > 1.0 - NEUTRAL {
            return Relation::Apart;
        }
        let distance = recent / unit;
        let none = |multiplier: Complex<f64>| (NONE * unit).max(MAP_ERROR * gap / (1.0 - multiplier.norm()));
        let slowest = none(self.orbit.largest_multiplier());
        if sizes(WINDOW.0).all(|size| size <= slowest) {
            return Relation::Reached { distance };
        }
        let now: Vec<f64> =
            self.directions.iter().map(|direction| mean_size(|k| part(direction, k), 0, WINDOW.0)).collect();
        let largest = now.iter().copied().fold(0.0, f64::max);
        let modulus = self.orbit.largest_multiplier().norm();
        for (direction, size) in self.directions.iter().zip(&now) {
            let own = direction.multiplier.norm();
            let is_slowest = own > modulus - 0.5 * (1.0 - modulus);
            if *size <= none(direction.multiplier) || (!is_slowest && *size < MINOR * largest) {
                continue;
            }
            let rate = -own.ln();
            let seen = (SEEN * size / gap).clamp(SEEN_LIMITS.0, SEEN_LIMITS.1);
            // An even number, as a multiplier near -1 changes the sign at every return.
            let third = 2 * ((0.5 * seen / rate).ceil() as usize).max(WINDOW.0 / 4);
            let periods = 3.0 * period as f64 / rate;
            if *size > NEAR * gap || 3 * third > held.min(WINDOW.1) {
                return Relation::Approaching { periods };
            }
            let logs: Vec<f64> =
                (0..3).map(|i| mean_log(|k| part(direction, k), i * third, (i + 1) * third)).collect();
            let promised = third as f64 * rate;
            let kept = |earlier: f64, later: f64| {
                let measured = (earlier - later) / promised;
                (RATE.0..=RATE.1).contains(&measured)
            };
            if !(kept(logs[1], logs[0]) && kept(logs[2], logs[1])) {
                let nearer = logs[0] < logs[1] - SATURATED * promised;
                return if nearer { Relation::Approaching { periods } } else { Relation::Apart };
            }
        }
        Relation::Reached { distance }
    }
}

/// Whether deviations along `multiplier` last long enough to be watched.
fn watched(multiplier: Complex<f64>) -> bool {
    multiplier.norm().powi(WINDOW.0 as i32) > FAST
}

/// Returns within which a deviation changes by half at the `rate` per return, no more than are `held`.
fn window(rate: f64, held: usize) -> usize {
    ((0.7 / rate).ceil().min(1e6) as usize).clamp(WINDOW.0 + 1, WINDOW.1).min(held)
}

/// Mean logarithm of `size` over `from..to` returns back.
fn mean_log(size: impl Fn(usize) -> f64, from: usize, to: usize) -> f64 {
    (from..to).map(|k| size(k).max(f64::MIN_POSITIVE).ln()).sum::<f64>() / (to - from).max(1) as f64
}

/// Its geometric mean.
fn mean_size(size: impl Fn(usize) -> f64, from: usize, to: usize) -> f64 {
    mean_log(size, from, to).exp()
}

impl Direction {
    fn new(matrix: &DMatrix<Complex<f64>>, multiplier: Complex<f64>) -> Result<Self, OrbitError> {
        let right = eigenvector(matrix, multiplier)?;
        let left = eigenvector(&matrix.transpose(), multiplier)?;
        let largest = right.iter().map(|entry| entry.norm()).fold(0.0, f64::max);
        let product = left.dot(&right) / largest;
        let left = left / product;
        let finite = left.iter().all(|entry| entry.re.is_finite() && entry.im.is_finite());
        if finite { Ok(Self { multiplier, left }) } else { Err(OrbitError::Singular) }
    }

    /// Size of the part along this direction of the deviation of `state` from `orbit`.
    fn part(&self, state: &[f64], orbit: &[f64], scales: &[f64]) -> f64 {
        let terms = self.left.iter().zip(state.iter().zip(orbit).zip(scales));
        terms.map(|(left, ((a, b), scale))| left * ((a - b) / scale)).sum::<Complex<f64>>().norm()
    }
}

/// The eigenvector of `matrix` to the eigenvalue nearest to `value`, of unit length, by inverse iteration.
fn eigenvector(
    matrix: &DMatrix<Complex<f64>>,
    value: Complex<f64>,
) -> Result<DVector<Complex<f64>>, OrbitError> {
    let n = matrix.nrows();
    // Away from the exact singularity, by less than the multiplier is known to.
    let moved = matrix - DMatrix::identity(n, n) * (value * Complex::new(1.0 + 1e-10, 1e-11));
    let solver = moved.lu();
    let mut direction = DVector::from_fn(n, |i, _| Complex::new(1.0, 0.1 * i as f64));
    for _ in 0..4 {
        direction = solver.solve(&direction).ok_or(OrbitError::Singular)?;
        let norm = direction.norm();
        direction /= Complex::from(norm);
    }
    if direction.iter().all(|entry| entry.re.is_finite() && entry.im.is_finite()) {
        Ok(direction)
    } else {
        Err(OrbitError::Singular)
    }
}
