//! The last stroboscopic states of a motion, and what their geometry says: after how many periods they nearly return,
//! and the dimension of the set they fill.
//!
//! Distances are largest components of scaled states (see [`crate::dynamics::PeriodMap::scales`]), so displacements.

use super::poincare::{PhasePoint, Recurrence, recurrence};
use crate::dynamics::orbits::period_map::{distance, scales};
use crate::model::ReducedSystem;

/// States kept.
const KEPT: usize = 4096;
/// States that recurrence is asked of, a few more than it compares.
const RECENT: usize = 64;
/// Distance of states, relative to the amplitude, that are a near return.
const RETURNED: f64 = 0.05;
/// The same for states that repeat, and how much nearer than so many periods earlier those must be that will.
const ARRIVED: f64 = 1e-4;
const NEARER: f64 = 0.95;
const EARLIER: usize = 512;
/// Longest near return looked for, in excitation periods.
const LONGEST_RETURN: usize = 64;
/// States whose geometry is looked at.
pub(super) const GEOMETRY: usize = 512;
/// Neighbours whose distances give the dimension.
const NEIGHBOURS: (usize, usize) = (4, 16);

/// The last stroboscopic states.
pub(super) struct Strobe {
    scales: Vec<f64>,
    /// Chronological; the oldest half is dropped when twice as many are held as needed.
    states: Vec<f64>,
}

impl Strobe {
    pub(super) fn new(system: &ReducedSystem) -> Self {
        let scales = scales(system);
        Self { states: Vec::with_capacity(2 * KEPT * scales.len()), scales }
    }

    pub(super) fn push(&mut self, state: &[f64]) {
        let width = self.width();
        if self.states.len() == 2 * KEPT * width {
            self.states.drain(..KEPT * width);
        }
        self.states.extend_from_slice(&state[..width]);
    }

    fn width(&self) -> usize {
        self.scales.len()
    }

    /// How many states are held, [`KEPT`] or more after as many periods.
    pub(super) fn len(&self) -> usize {
        self.states.len() / self.width()
    }

    /// The state `back` periods before the last one.
    pub(super) fn before_last(&self, back: usize) -> &[f64] {
        let end = self.states.len() - back * self.width();
        &self.states[end - self.width()..end]
    }

    fn distance(&self, a: &[f64], b: &[f64]) -> f64 {
        distance(a, b, &self.scales)
    }

    /// Largest scaled component of the last `count` states.
    fn amplitude(&self, count: usize) -> f64 {
        let states = self.states.chunks_exact(self.width()).rev().take(count);
        states.fold(0.0, |most, state| {
            state.iter().zip(&self.scales).fold(most, |most, (value, scale)| most.max((value / scale).abs()))
        })
    }

    /// Whether the states recur, in voltage and its rate, or, where the voltage stays zero, in the tip's displacement
    /// and velocity.
    pub(super) fn recurrence(&self, system: &ReducedSystem) -> Option<Recurrence> {
        let width = self.width();
        let states = || self.states.chunks_exact(width).skip(self.len().saturating_sub(RECENT));
        let electrical =
            |state: &[f64]| PhasePoint { v: state[width - 1], dv_dt: system.voltage_rate(state) };
        let mechanical = |state: &[f64]| PhasePoint {
            v: system.tip_displacement(state),
            dv_dt: system.tip_velocity(state),
        };
        let silent = system.parameters.theta == 0.0;
        let points: Vec<PhasePoint> =
            if silent { states().map(mechanical).collect() } else { states().map(electrical).collect() };
        // Over half a vibration v and dv/dt change places, so each is measured by the larger of both.
        let omega = system.parameters.omega;
        let size = points.iter().fold(0.0_f64, |most, p| most.max(p.v.abs()).max(p.dv_dt.abs() / omega));
        recurrence(&points, size, size * omega)
    }

    /// Largest scaled component of the last [`RECENT`] states.
    pub(super) fn recent_amplitude(&self) -> f64 {
        self.amplitude(RECENT)
    }

    /// The number of periods, up to 64, after which the last states come closest to themselves, if they come close and ever
    /// closer, or have arrived.
    pub(super) fn closest_return(&self) -> Option<usize> {
        let compared = self.len().checked_sub(LONGEST_RETURN).filter(|count| *count > 0)?.min(LONGEST_RETURN);
        let distances = |period: usize, back: usize| {
            (back..back + compared)
                .map(move |j| self.distance(self.before_last(j), self.before_last(j + period)))
        };
        let amplitude = self.amplitude(RECENT);
        // Most periods are ruled out by their first few pairs. At rest even a limit of zero is kept.
        let mut closest = None;
        for period in 1..=LONGEST_RETURN {
            let limit = closest.map_or((RETURNED * amplitude).next_up(), |(_, defect)| defect);
            let mut defect: f64 = 0.0;
            if distances(period, 0).all(|distance| {
                defect = defect.max(distance);
                defect < limit
            }) {
                closest = Some((period, defect));
            }
        }
        let (period, now) = closest?;
        let back = (self.len() - compared - period).min(EARLIER);
        let nearer = || now < NEARER * distances(period, back).fold(0.0, f64::max);
        (now <= ARRIVED * amplitude || nearer()).then_some(period)
    }

    /// Dimension of the set that the last states fill, by the median distances of their 4th and 16th neighbours: 1 on
    /// curves, 2 on a surface. `None` when too few are held, or they coincide.
    ///
    /// An estimate at the scale of a thirtieth of the set; a set thickened by a transient seems larger.
    pub(super) fn dimension(&self) -> Option<f64> {
        let count = self.len().min(GEOMETRY);
        let (near, far) = NEIGHBOURS;
        if count < 16 * far {
            return None;
        }
        let mut distances = vec![0.0; count];
        let (mut nearer, mut farther) = (Vec::with_capacity(count), Vec::with_capacity(count));
        for i in 0..count {
            for (j, distance) in distances.iter_mut().enumerate() {
                *distance = self.distance(self.before_last(i), self.before_last(j));
            }
            // The smallest is the state itself.
            let (below, value, _) = distances.select_nth_unstable_by(far, f64::total_cmp);
            farther.push(*value);
            nearer.push(*below.select_nth_unstable_by(near, f64::total_cmp).1);
        }
        let median = |values: &mut Vec<f64>| *values.select_nth_unstable_by(count / 2, f64::total_cmp).1;
        let ratio = median(&mut farther) / median(&mut nearer);
        let dimension = (far as f64 / near as f64).ln() / ratio.ln();
        dimension.is_finite().then_some(dimension)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::{ParameterSet, Parameters};

    /// States whose displacement is `value` of their number.
    fn strobe(count: usize, value: impl Fn(usize) -> f64) -> Strobe {
        let parameters = Parameters::new(ParameterSet::default()).expect("the paper's");
        let system = ReducedSystem::new(parameters, 1, Default::default()).expect("a device");
        let mut strobe = Strobe::new(&system);
        (0..count).for_each(|k| strobe.push(&[value(k), 0.0, 0.0]));
        strobe
    }

    #[test]
    fn the_closest_return_is_the_shortest_of_the_closest() {
        assert_eq!(strobe(200, |_| 0.7).closest_return(), Some(1));
        assert_eq!(strobe(200, |_| 0.0).closest_return(), Some(1));
        assert_eq!(strobe(200, |k| (k % 3) as f64).closest_return(), Some(3));
        assert_eq!(strobe(200, |k| (k % 37) as f64).closest_return(), Some(37));
        // Nearly repeating is enough only where states come closer.
        let turning = |k: usize, period: f64| (std::f64::consts::TAU * k as f64 / period).sin();
        let settling = |k: usize| 1.0 + (-0.02 * k as f64).exp() * turning(k, 5.05);
        assert_eq!(strobe(200, settling).closest_return(), Some(5));
        assert_eq!(strobe(200, |k| turning(k, 5.05)).closest_return(), None);
        // Too few to be compared.
        assert_eq!(strobe(LONGEST_RETURN, |_| 0.7).closest_return(), None);
        assert_eq!(strobe(LONGEST_RETURN + 1, |_| 0.7).closest_return(), Some(1));
    }
}
