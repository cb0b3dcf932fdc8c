//! Where a start arrives, and whether rounding decides on it: the start is followed once with all effort and once coarsely, and
//! where these two part, from starts beside it.

use super::effort::Effort;
use super::motion::{Motion, Reached, Undecided};
use super::settle::Settler;
use super::signature::{Recogniser, Signature};
use crate::dynamics::bifurcations::ForcedMotion;
use crate::dynamics::integration::{IntegrationError, Settings};
use crate::dynamics::orbits::period_map::scales;
use crate::model::ReducedSystem;

/// Difference of two runs from one start, relative to the largest displacement, beyond which they have separated; and the
/// largest half that time before, since what grows with the time only is a vibration's phase that the coarser run loses.
const SEPARATED: f64 = 0.05;
const TOGETHER: f64 = 0.005;
/// Starts that are tried beside the one asked for when two runs from it separate.
const BESIDE: usize = 10;
/// Excitation periods that a chaotic one of them must last, and integrator steps that each may cost.
const BESIDE_LASTING: usize = 8000;
const BESIDE_STEPS: u64 = 600_000;
/// How far they are from it, relative to the gap: more than rounding, less than anybody could set.
const BESIDE_BY: f64 = 1e-10;
/// Excitation periods that a chaotic motion must last where something else attracts, on which a transient could end.
const LASTING_BESIDE: usize = 96_000;
/// A forced motion whose multiplier is below this is stable, or has just handed its stability to what branched off.
const NEARLY_STABLE: f64 = 1.01;

/// Where a start arrives.
#[derive(Debug)]
pub(super) struct Arrival {
    /// The motion reached by the most careful run.
    pub(super) reached: Reached,
    /// Where starts lead that differ by rounding, the one asked for among them: one entry a motion, with how many do.
    pub(super) ends: Vec<(Signature, usize)>,
    /// Whether two runs from the one asked for went different ways before they settled.
    pub(super) separated: bool,
}

impl Arrival {
    /// Of the start of `system`, that of `settler`, in `initial` (length 2N + 1) at t = 0, beside the `forced` motion where that
    /// can be followed.
    ///
    /// # Errors
    /// As [`Settler::reach`].
    pub(super) fn of(
        settler: &mut Settler,
        (system, initial): (&ReducedSystem, &[f64]),
        forced: Option<&ForcedMotion>,
    ) -> Result<Self, IntegrationError> {
        let mut reached = settler.reach(initial, Effort::full())?;
        if reached.motion == Motion::Chaotic && has_an_end(settler, forced) {
            reached = settler.reach(initial, Effort { lasting: LASTING_BESIDE, ..Effort::full() })?;
        }
        let coarse = Effort { tolerance: Settings::default().tolerance, ..Effort::cell() };
        let coarser = settler.reach(initial, coarse)?;
        let recogniser = Recogniser::new(system);
        let own = Signature::of(reached.clone());
        let same = recogniser.same_end(&own, &Signature::of(coarser.clone()));
        let undecided = |reached: &Reached| matches!(reached.motion, Motion::Undecided { .. });
        let diverging = reached.motion == Motion::Chaotic || undecided(&reached);
        let separated = !diverging && separated(&reached, &coarser);
        let mut ends = vec![(own, 1)];
        // One that is not decided is no other motion.
        if (same || undecided(&coarser)) && !separated {
            return Ok(Self { reached, ends, separated });
        }
        if reached.motion == Motion::Chaotic {
            // A run that found the way out of chaos shows that there is one.
            ends.push((Signature::of(coarser), 1));
        } else {
            for moved in beside(system, initial) {
                let effort = Effort { lasting: BESIDE_LASTING, steps: BESIDE_STEPS, ..Effort::full() };
                let end = Signature::of(settler.reach(&moved, effort)?);
                match ends.iter_mut().find(|(known, _)| recogniser.same_end(known, &end)) {
                    Some((_, count)) => *count += 1,
                    None if matches!(end.cell.motion, Motion::Undecided { .. }) => {}
                    None => ends.push((end, 1)),
                }
            }
        }
        Ok(Self { reached, ends, separated })
    }

    /// Whether starts that differ by rounding lead to different motions.
    pub(super) fn depends_on_rounding(&self) -> bool {
        self.ends.len() > 1
    }

    /// The motion reached, undecided where rounding decides on it.
    pub(super) fn motion(&self) -> Motion {
        if self.depends_on_rounding() {
            Motion::Undecided { why: Undecided::DependsOnRounding }
        } else {
            self.reached.motion
        }
    }
}

/// What motion the start of `system` in `initial` (length 2N + 1) at t = 0 leads to, for one start that people will rely on: with
/// all effort, and undecided where rounding decides on it. The numbers are those of one of the motions then.
///
/// # Errors
/// As [`Settler::reach`].
pub fn arrive(system: &ReducedSystem, initial: &[f64]) -> Result<Reached, IntegrationError> {
    let forced = ForcedMotion::of(system).ok();
    let arrival = Arrival::of(&mut Settler::new(system), (system, initial), forced.as_ref())?;
    Ok(Reached { motion: arrival.motion(), ..arrival.reached })
}

/// Whether a motion is known that chaos may only be the way to.
fn has_an_end(settler: &Settler, forced: Option<&ForcedMotion>) -> bool {
    let forced = forced.and_then(|forced| forced.orbit.as_ref());
    let nearly_stable = forced.is_some_and(|orbit| orbit.largest_multiplier().norm() < NEARLY_STABLE);
    nearly_stable || !settler.stable_orbits().is_empty()
}

/// Starts that differ from `initial` by rounding.
pub(super) fn beside(system: &ReducedSystem, initial: &[f64]) -> impl Iterator<Item = Vec<f64>> {
    let scales = scales(system);
    let by = BESIDE_BY * system.equilibrium.gap;
    (1..=BESIDE).map(move |k| {
        let moved = initial.iter().zip(&scales).enumerate().map(|(i, (value, scale))| {
            let direction = (1.7 * k as f64 + 2.3 * i as f64 * k as f64).cos();
            value + by * scale * direction
        });
        moved.collect()
    })
}

/// Whether two runs from one start have gone different ways before the earlier one arrived.
fn separated(a: &Reached, b: &Reached) -> bool {
    let pairs = || a.notes.iter().zip(&b.notes);
    let largest = pairs().map(|(a, b)| a.abs().max(b.abs())).fold(0.0, f64::max);
    let apart = |by: f64| pairs().position(|(a, b)| (a - b).abs() > by * largest);
    let (Some(first), Some(apart)) = (apart(TOGETHER), apart(SEPARATED)) else { return false };
    first > apart / 2
}
