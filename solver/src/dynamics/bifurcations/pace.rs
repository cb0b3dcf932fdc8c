//! How far a step along a branch of orbits may go, so that no resonance is stepped over.
//!
//! Where the motion is small, it is nearly that of the linear device: its multipliers turn on circles just within the unit
//! circle, by the phase omega_n T of each mode. Where one comes to the real axis there is a resonance: at +1 a peak, at -1
//! the tongue of a period doubling; where two meet, that of tori. All are as narrow as the damping is small, with nothing to
//! be seen of them from afar.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use nalgebra::{Complex, DVector};

use crate::model::ReducedSystem;

/// Largest turn of a multiplier in a step (radians), and the smallest one that is asked for.
const TURN: (f64, f64) = (0.4, 1e-4);
/// The same, relative to its distance from the real axis or half that from another.
const OF_DISTANCE: f64 = 0.5;
/// Difference of a multiplier's angle from that of the linear device (radians) beyond which it is another mode's.
const DETUNED: f64 = 1.0;
/// Vibrations of a mode in an excitation period beyond which its resonances are too weak to matter.
const MOST_VIBRATIONS: f64 = 2.5;
/// Largest difference of a state from where the tangent leads, relative to its size: over a peak the phase turns, however
/// small the motion is against the gap.
const SURPRISE: f64 = 0.3;

/// The phases by which a period turns the modes of the linear device, radians; infinite for those that do not matter.
pub(super) fn mode_phases(system: &ReducedSystem, periods: usize) -> Vec<f64> {
    let vibrations = system.modes.iter().map(|mode| mode.omega / system.parameters.omega);
    vibrations
        .map(|turns| if turns <= MOST_VIBRATIONS { TAU * periods as f64 * turns } else { f64::INFINITY })
        .collect()
}

/// The largest part of what is allowed of the turns from one place with these `phases` and `multipliers` to the next: above
/// 1 the step was too long.
pub(super) fn turn((from, to): (&[f64], &[f64]), multipliers: &[Complex<f64>]) -> f64 {
    let slow: Vec<(f64, f64)> = from
        .iter()
        .zip(to)
        .filter(|(from, to)| from.is_finite() && to.is_finite())
        .map(|(from, to)| (*from, (to - from).abs()))
        .collect();
    let upper: Vec<Complex<f64>> = slow.iter().filter_map(|(phase, _)| own(*phase, multipliers)).collect();
    let parts = slow.iter().map(|(phase, turned)| turned / allowed(*phase, multipliers, &upper));
    parts.fold(0.0, f64::max)
}

/// How far a mode of that `phase` may turn, where those of the slow modes are `upper`.
fn allowed(phase: f64, multipliers: &[Complex<f64>], upper: &[Complex<f64>]) -> f64 {
    let own = own(phase, multipliers);
    let to_axis = own.map(|own| (own.arg().min(PI - own.arg()), own.norm().ln()));
    // Two modes meet away from the axis where their frequencies add up to the excitation's: each goes half the way.
    let to_other = own.into_iter().flat_map(|own| {
        let others = upper.iter().filter(move |other| **other != own);
        others.map(move |other| (0.5 * (own.ln() - other.ln()).norm(), 0.5 * (own * other).norm().ln()))
    });
    // Where they come together, as far as half the decay: as narrow is a tongue that has just opened.
    let freely = |(distance, decay): (f64, f64)| OF_DISTANCE * distance.max(-0.5 * decay);
    let meetings = to_axis.into_iter().chain(on_axis(phase, multipliers)).chain(to_other);
    meetings.map(freely).fold(TURN.0, f64::min).max(TURN.1)
}

/// The angle of a mode's multiplier in the upper half plane, if it is as in the linear device.
fn folded(phase: f64) -> f64 {
    PI - (phase.rem_euclid(TAU) - PI).abs()
}

/// A mode's multiplier in the upper half plane, if it is there.
fn own(phase: f64, multipliers: &[Complex<f64>]) -> Option<Complex<f64>> {
    let away = |multiplier: &Complex<f64>| (multiplier.arg() - folded(phase)).abs();
    let upper = multipliers.iter().filter(|own| own.im > 0.0 && away(own) < DETUNED);
    upper.min_by(|a, b| away(a).total_cmp(&away(b))).copied()
}

/// Of a mode's pair that is on the axis, on the side on which the mode is: half the difference of its logarithms, and their
/// mean. A tongue that is 2 w wide parts them by 2 w in its middle and by less elsewhere. So its far end is no nearer than
/// half their difference; its near one may be, but changes the sign of what is watched.
fn on_axis(phase: f64, multipliers: &[Complex<f64>]) -> Option<(f64, f64)> {
    let side = if folded(phase) > FRAC_PI_2 { -1.0 } else { 1.0 };
    let real = multipliers.iter().filter(|own| own.im == 0.0 && own.re * side > 0.0);
    // The circuit's own is positive.
    let count = if side > 0.0 { 3 } else { 2 };
    let logs: Vec<f64> = real.map(|own| own.norm().ln()).take(count).collect();
    let (first, others) = logs.split_first().filter(|_| logs.len() == count)?;
    let second = others.iter().min_by(|a, b| (first + *a).abs().total_cmp(&(first + *b).abs()))?;
    Some((0.5 * (first - second), 0.5 * (first + second)))
}

/// Whether the state `there` is elsewhere than where the tangent from another place leads, at `predicted`, seen by its own
/// size; of `n` components.
pub(super) fn surprises(predicted: &DVector<f64>, there: &DVector<f64>, n: usize) -> bool {
    let difference = (there - predicted).rows(0, n).norm();
    difference > SURPRISE * there.rows(0, n).norm().max(predicted.rows(0, n).norm())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_multiplier_near_the_axis_may_turn_by_half_its_distance_and_one_far_from_it_freely() {
        let on_circle = |angle: f64| {
            let multiplier = Complex::from_polar(0.999, angle);
            [multiplier, multiplier.conj()]
        };
        for (angle, expected) in
            [(1.5, 0.4), (0.2, 0.1), (PI - 0.2, 0.1), (1e-5, 0.25 * 0.0010005), (-0.2, 0.1), (TAU + 0.2, 0.1)]
        {
            let found = allowed(angle, &on_circle(angle), &[]);
            assert!((found / expected - 1.0).abs() < 1e-3, "{angle}: {found} for {expected}");
        }
        // On the axis the two are apart by what the tongue still has before it, or decay together as before.
        let real = [Complex::new(-1.1, 0.0), Complex::new(-0.9, 0.0), Complex::new(0.5, 0.0)];
        let expected = 0.25 * (1.1_f64 / 0.9).ln();
        assert!((allowed(3.1, &real, &[]) / expected - 1.0).abs() < 1e-9);
        let closed = [Complex::new(-0.9, 0.0), Complex::new(-0.9, 0.0)];
        assert!((allowed(3.1, &closed, &[]) / (-0.25 * 0.9_f64.ln()) - 1.0).abs() < 1e-9);
        // Of three positive ones the circuit's own is none of the pair.
        let folding = [1.02, 0.99, 0.978].map(|own| Complex::new(own, 0.0));
        assert!((allowed(0.05, &folding, &[]) / (0.25 * (1.02_f64 / 0.978).ln()) - 1.0).abs() < 1e-9);
        assert_eq!(allowed(0.1, &real, &[]), 0.4);
        // Of two modes each has its own.
        let two: Vec<_> = on_circle(0.1).into_iter().chain(on_circle(2.0)).collect();
        assert_eq!(allowed(2.1, &two, &[]), 0.4);
        assert!((allowed(0.15, &two, &[]) - 0.05).abs() < 1e-12);
        let upper = [on_circle(1.0)[0], on_circle(1.2)[0]];
        let both: Vec<_> = upper.iter().flat_map(|own| [*own, own.conj()]).collect();
        assert!((allowed(1.0, &both, &upper) - 0.05).abs() < 1e-12, "they meet half way");
        let steep = turn((&[0.1, f64::INFINITY, 2.0], &[0.2, 1.0, 2.1]), &two);
        assert!((steep - 2.0).abs() < 1e-9, "{steep}");
    }
}
