//! Comes to a [`Verdict`]: the motion reached, whether rounding decides on it, its exponent and its spectrum, the forced
//! motion, and what else is there.
//!
//! On a periodic motion, exponent and spectrum are those of the motion itself, started on it, so that nothing of the
//! transient is in them; were it unstable after all, it would be left.

use super::effort::Effort;
use super::evidence::{Evidence, EvidenceSource, Observation};
use super::lyapunov::{Exponent, Record, Sign, exponents};
use super::motion::{Cell, Motion, Reached, Undecided};
use super::rotation::{Rotation, rotation};
use super::settle::Settler;
use super::signature::{Recogniser, Signature};
use super::strobe::{GEOMETRY, Strobe};
use super::verdict::{
    Coexisting, ForcedSummary, OtherStart, Verdict, VerdictError, Warning, deflection_warning,
    force_law_warning, forced_warning, transient_warning,
};
use super::voltage_spectrum::{VoltageSpectrum, VoltageSpectrumError};
use crate::dynamics::bifurcations::ForcedMotion;
use crate::dynamics::integration::Measures;
use crate::dynamics::integration::{Collocation, Outcome, Settings};
use crate::dynamics::orbits::period_map::scales;
use crate::model::{ForceLaw, ReducedSystem};

/// Record of the exponent on a periodic motion: first, and when it is given up as it is (excitation periods).
const EXPONENT_PERIODS: (usize, usize) = (192, 8192);
/// Half width of that exponent, relative to it, at which it is accurate enough.
const ACCURATE: f64 = 0.02;
/// Decay of the tangent vectors over the record after which it is long enough whatever the interval says.
const LONG: f64 = 200.0;
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

/// What was found out about the motion that a start leads to.
#[derive(Debug)]
pub struct Inquiry {
    /// The verdict on it.
    pub verdict: Verdict,
    /// The motion reached.
    pub reached: Reached,
    /// The spectrum of its voltage; `None` when it ended.
    pub spectrum: Option<VoltageSpectrum>,
    /// The forced motion at the same parameters; `None` when it cannot be followed there.
    pub forced: Option<ForcedMotion>,
}

impl Inquiry {
    /// About the start of `system` in `initial` (length 2N + 1) at t = 0; the plots show it until `t_end`.
    ///
    /// # Errors
    /// [`VerdictError`].
    pub fn new(system: &ReducedSystem, initial: &[f64], t_end: f64) -> Result<Self, VerdictError> {
        let mut settler = Settler::new(system);
        let forced = ForcedMotion::of(system).ok();
        let mut reached = settler.reach(initial, Effort::full())?;
        if reached.motion == Motion::Chaotic && has_an_end(&settler, forced.as_ref()) {
            reached = settler.reach(initial, Effort { lasting: LASTING_BESIDE, ..Effort::full() })?;
        }
        let (beside, separated) = beside(&mut settler, system, initial, &reached)?;
        let spectrum = spectrum(system, &mut reached)?;
        let exponent = match &reached.orbit {
            Some(orbit) => exponent_on(system, &orbit.state)?,
            // Averages converge sooner than an exponent about zero.
            None if reached.motion == Motion::Quasiperiodic => exponent_on(system, &reached.state)?,
            None => reached.exponent,
        };
        let from_rest = match initial.iter().all(|value| *value == 0.0) {
            true => None,
            false => Some(settler.reach(&vec![0.0; initial.len()], Effort::full())?),
        };
        let others = Others { beside, separated, from_rest, met: settler.stable_orbits() };
        let findings = Findings {
            system,
            t_end,
            reached: &reached,
            exponent,
            spectrum: spectrum.as_ref(),
            forced: forced.as_ref(),
        };
        let verdict = findings.conclude(&others);
        Ok(Self { verdict, reached, spectrum, forced })
    }
}

/// Whether a motion is known that chaos may only be the way to.
fn has_an_end(settler: &Settler, forced: Option<&ForcedMotion>) -> bool {
    let forced = forced.and_then(|forced| forced.orbit.as_ref());
    let nearly_stable = forced.is_some_and(|orbit| orbit.largest_multiplier().norm() < NEARLY_STABLE);
    nearly_stable || !settler.stable_orbits().is_empty()
}

/// Where starts lead that differ by rounding, the one asked for among them: one entry a motion, with how many do; and
/// whether two runs from the one asked for went different ways before they settled.
fn beside(
    settler: &mut Settler,
    system: &ReducedSystem,
    initial: &[f64],
    reached: &Reached,
) -> Result<(Vec<(Signature, usize)>, bool), VerdictError> {
    let coarse = Effort { tolerance: Settings::default().tolerance, ..Effort::cell() };
    let coarser = settler.reach(initial, coarse)?;
    let recogniser = Recogniser::new(system);
    let own = Signature::of(reached.clone());
    let same = recogniser.same_end(&own, &Signature::of(coarser.clone()));
    let diverging = matches!(reached.motion, Motion::Chaotic | Motion::Undecided { .. });
    let separated = !diverging && separated(reached, &coarser);
    let mut ends = vec![(own, 1)];
    let undecided = |reached: &Reached| matches!(reached.motion, Motion::Undecided { .. });
    // One that is not decided is no other motion.
    if (same || undecided(&coarser)) && !separated {
        return Ok((ends, false));
    }
    // A run that found the way out of chaos shows that there is one.
    if reached.motion == Motion::Chaotic {
        ends.push((Signature::of(coarser), 1));
        return Ok((ends, false));
    }
    let scales = scales(system);
    for k in 1..=BESIDE {
        let moved: Vec<f64> = initial
            .iter()
            .zip(&scales)
            .enumerate()
            .map(|(i, (value, scale))| {
                let direction = (1.7 * k as f64 + 2.3 * i as f64 * k as f64).cos();
                value + BESIDE_BY * system.equilibrium.gap * scale * direction
            })
            .collect();
        let effort = Effort { lasting: BESIDE_LASTING, steps: BESIDE_STEPS, ..Effort::full() };
        let end = Signature::of(settler.reach(&moved, effort)?);
        match ends.iter_mut().find(|(known, _)| recogniser.same_end(known, &end)) {
            Some((_, count)) => *count += 1,
            None if matches!(end.cell.motion, Motion::Undecided { .. }) => {}
            None => ends.push((end, 1)),
        }
    }
    Ok((ends, separated))
}

/// Whether two runs from one start have gone different ways before the earlier one arrived.
fn separated(a: &Reached, b: &Reached) -> bool {
    let pairs = || a.notes.iter().zip(&b.notes);
    let largest = pairs().map(|(a, b)| a.abs().max(b.abs())).fold(0.0, f64::max);
    let apart = |by: f64| pairs().position(|(a, b)| (a - b).abs() > by * largest);
    let (Some(first), Some(apart)) = (apart(TOGETHER), apart(SEPARATED)) else { return false };
    first > apart / 2
}

/// The exponent by tangent vectors along the motion from `state`, which has settled: a second witness beside multipliers or
/// averages.
fn exponent_on(system: &ReducedSystem, state: &[f64]) -> Result<Option<Exponent>, VerdictError> {
    let accurate = |exponent: &Exponent| {
        exponent.half_width <= ACCURATE * exponent.value.abs()
            || exponent.value.abs() * exponent.duration > LONG
            || exponent.sign() == Sign::Zero
    };
    Ok(match exponents(system, state, EXPONENT_PERIODS, &accurate)? {
        Record::Exponents(found) => found,
        Record::Ended(_) | Record::Unresolved => None,
    })
}

/// The spectrum of the motion reached; what ends meanwhile was no lasting motion.
fn spectrum(system: &ReducedSystem, reached: &mut Reached) -> Result<Option<VoltageSpectrum>, VerdictError> {
    if !reached.cell().lasts() {
        return Ok(None);
    }
    let state = reached.orbit.as_ref().map_or(&reached.state, |orbit| &orbit.state);
    match VoltageSpectrum::of(system, state, reached.motion) {
        Ok(spectrum) => Ok(Some(spectrum)),
        Err(VoltageSpectrumError::Ended { outcome }) => {
            let time = reached.time + outcome.early_end().unwrap_or(0.0);
            reached.motion = match outcome {
                Outcome::Contact { .. } => Motion::Contact { time },
                _ => Motion::Escape { time },
            };
            (reached.measures, reached.exponent) = (None, None);
            Ok(None)
        }
        Err(error) => Err(error.into()),
    }
}

/// What else was met at the same parameters.
struct Others {
    beside: Vec<(Signature, usize)>,
    separated: bool,
    from_rest: Option<Reached>,
    /// Stable orbits that Newton's iteration came upon.
    met: Vec<Signature>,
}

/// What is known of the motion.
struct Findings<'a> {
    system: &'a ReducedSystem,
    t_end: f64,
    reached: &'a Reached,
    exponent: Option<Exponent>,
    spectrum: Option<&'a VoltageSpectrum>,
    forced: Option<&'a ForcedMotion>,
}

impl Findings<'_> {
    /// Puts everything together.
    fn conclude(&self, others: &Others) -> Verdict {
        let Self { system, reached, exponent, spectrum, forced, .. } = *self;
        let suspected = reached.motion;
        let gap = system.equilibrium.gap;
        let rotation = self.rotation();
        let rests_on = self.evidence(rotation, others);
        let disagreeing: Vec<EvidenceSource> =
            rests_on.iter().filter(|piece| piece.agrees == Some(false)).map(Evidence::source).collect();
        let motion = if others.beside.len() > 1 {
            Motion::Undecided { why: Undecided::DependsOnRounding }
        } else if disagreeing.is_empty() {
            suspected
        } else {
            Motion::Undecided { why: Undecided::EvidenceDisagrees }
        };
        let forced_orbit = forced.and_then(|forced| forced.orbit.as_ref());
        let (peaks, basic) = spectrum.map_or((Vec::new(), None), |found| (found.peaks.clone(), found.basic));
        let measures = reached.measures;
        Verdict {
            motion,
            suspected,
            multiplier: reached.orbit.as_ref().map(|orbit| orbit.largest_multiplier().into()),
            forced: forced.zip(forced_orbit).map(|(forced, orbit)| ForcedSummary::new(forced, orbit)),
            exponent,
            v_rms: measures.map(|measures| measures.v_rms),
            v_peak: measures.map(|measures| measures.v_peak),
            power: measures.map(|measures| measures.power),
            tip_over_gap: measures.map(|measures| (measures.tip.0 / gap, measures.tip.1 / gap)),
            slope: measures.map(|measures| measures.slope),
            peaks,
            basic,
            rotation,
            rests_on,
            disagreeing,
            coexists: self.coexists(others),
            warnings: self.warnings(others.separated),
        }
    }

    fn warnings(&self, separated: bool) -> Vec<Warning> {
        let reached = self.reached;
        let mut warnings: Vec<Warning> = Vec::new();
        warnings.extend(reached.longer.map(|time| Warning::WouldTake { time }));
        if separated {
            warnings.push(Warning::TransientChaos { time: reached.time });
        }
        warnings.extend(transient_warning(self.distance_at_end()));
        if let Some(Measures { tip: (lowest, highest), .. }) = reached.measures {
            warnings.extend(force_law_warning(self.system, lowest));
            warnings.extend(deflection_warning(lowest, highest));
        }
        if matches!(reached.motion, Motion::Escape { .. }) && self.system.law != ForceLaw::Exact {
            warnings.push(Warning::TruncatedBarrier);
        }
        warnings.extend(forced_warning(self.forced));
        warnings
    }

    /// How far the run is from the periodic motion at the end of the plots, relative to its amplitude, by the slowest
    /// multiplier.
    fn distance_at_end(&self) -> Option<f64> {
        let (orbit, distance) = self.reached.orbit.as_ref().zip(self.reached.distance)?;
        let rate =
            orbit.largest_multiplier().norm().ln() / (self.system.parameters.period() * orbit.periods as f64);
        Some((distance * (rate * (self.t_end - self.reached.time)).exp()).min(1.0))
    }

    /// The rotation number of a torus: that of its basic frequency, from the record of the tip.
    fn rotation(&self) -> Option<Rotation> {
        let strongest = self.reached.rotation.filter(|_| self.reached.motion == Motion::Quasiperiodic)?;
        let Some(basic) = self.spectrum.and_then(|found| found.basic) else { return Some(strongest) };
        let turns = (basic / self.system.parameters.omega).rem_euclid(1.0);
        rotation(&self.reached.tips, Some(turns.min(1.0 - turns))).or(Some(strongest))
    }

    /// Dimension of the set that the stroboscopic points of a motion fill that never repeats: 1 on closed curves.
    fn dimension(&self) -> Option<f64> {
        let (Motion::Quasiperiodic | Motion::Chaotic | Motion::Undecided { .. }) = self.reached.motion else {
            return None;
        };
        let mut strobe = Strobe::new(self.system);
        let mut integrator = Collocation::new(self.system, &self.reached.state, Settings::default()).ok()?;
        let end = GEOMETRY as f64 * self.system.parameters.period();
        integrator
            .advance(end, usize::MAX, &mut |step| {
                if step.index == 0 {
                    strobe.push(step.start);
                }
            })
            .ok()?;
        strobe.dimension()
    }

    fn evidence(&self, rotation: Option<Rotation>, others: &Others) -> Vec<Evidence> {
        let reached = self.reached;
        let motion = reached.motion;
        let mut evidence = Vec::new();
        if others.beside.len() > 1 {
            evidence.push(Evidence::beside(&others.beside));
        }
        if !reached.cell().lasts() {
            evidence.push(Evidence::supporting(Observation::Run(motion)));
            return evidence;
        }
        let period = self.system.parameters.period();
        let orbit = reached.orbit.as_ref();
        evidence.extend(
            orbit.zip(reached.distance).map(|(orbit, distance)| Evidence::multipliers(orbit, distance)),
        );
        evidence.extend(Evidence::recurrence(reached));
        evidence.extend(self.dimension().map(|dimension| Evidence::points(motion, dimension)));
        evidence.extend(rotation.map(|found| Evidence::supporting(Observation::Rotation(found))));
        evidence.extend(reached.zero_one.map(|found| Evidence::zero_one(motion, found)));
        evidence.extend(self.exponent.map(|exponent| Evidence::exponent(motion, &exponent, orbit, period)));
        evidence.extend(self.spectrum.map(|spectrum| Evidence::spectrum(motion, spectrum)));
        evidence
    }

    /// Other attracting motions that were met, each once.
    fn coexists(&self, others: &Others) -> Vec<Coexisting> {
        let recogniser = Recogniser::new(self.system);
        let mut known = vec![Signature::of(self.reached.clone())];
        let mut found = Vec::new();
        let mut add = |start: OtherStart, signature: Signature| {
            let decided = !matches!(signature.cell.motion, Motion::Undecided { .. });
            if decided && !known.iter().any(|known| recogniser.same(known, &signature)) {
                let Cell { motion, measures } = signature.cell;
                found.push(Coexisting { start, motion, measures });
                known.push(signature);
            }
        };
        for (end, _) in others.beside.iter().skip(1) {
            add(OtherStart::Beside, end.clone());
        }
        let stable = self.forced.and_then(|forced| forced.orbit.as_ref()).filter(|orbit| orbit.stable());
        if let Some(orbit) = stable {
            add(OtherStart::ForcedMotion, Signature::of_orbit(orbit, vec![orbit.state.clone()]));
        }
        if let Some(reached) = &others.from_rest {
            add(OtherStart::Rest, Signature::of(reached.clone()));
        }
        for orbit in &others.met {
            add(OtherStart::OnTheWay, orbit.clone());
        }
        found
    }
}
