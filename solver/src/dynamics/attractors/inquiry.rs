//! Comes to a [`Verdict`]: the motion reached, whether rounding decides on it, its exponent and its spectrum, the forced
//! motion, and what else is there.
//!
//! On a periodic motion, exponent and spectrum are those of the motion itself, started on it, so that nothing of the
//! transient is in them; were it unstable after all, it would be left.

use super::arrival::Arrival;
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
use crate::model::{ForceLaw, ReducedSystem};

/// Record of the exponent on a periodic motion: first, and when it is given up as it is (excitation periods).
const EXPONENT_PERIODS: (usize, usize) = (192, 8192);
/// Half width of that exponent, relative to it, at which it is accurate enough.
const ACCURATE: f64 = 0.02;
/// Decay of the tangent vectors over the record after which it is long enough whatever the interval says.
const LONG: f64 = 200.0;

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
        let mut arrival = Arrival::of(&mut settler, (system, initial), forced.as_ref())?;
        let spectrum = spectrum(system, &mut arrival.reached)?;
        let reached = &arrival.reached;
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
        let others = Others { arrival: &arrival, from_rest, met: settler.stable_orbits() };
        let findings = Findings {
            system,
            t_end,
            reached,
            exponent,
            spectrum: spectrum.as_ref(),
            forced: forced.as_ref(),
        };
        let verdict = findings.conclude(&others);
        Ok(Self { verdict, reached: arrival.reached, spectrum, forced })
    }
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
struct Others<'a> {
    arrival: &'a Arrival,
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
    fn conclude(&self, others: &Others<'_>) -> Verdict {
        let Self { system, reached, exponent, spectrum, forced, .. } = *self;
        let suspected = reached.motion;
        let gap = system.equilibrium.gap;
        let rotation = self.rotation();
        let rests_on = self.evidence(rotation, others);
        let disagreeing: Vec<EvidenceSource> =
            rests_on.iter().filter(|piece| piece.agrees == Some(false)).map(Evidence::source).collect();
        let motion = if others.arrival.depends_on_rounding() || disagreeing.is_empty() {
            others.arrival.motion()
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
            warnings: self.warnings(others.arrival.separated),
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

    fn evidence(&self, rotation: Option<Rotation>, others: &Others<'_>) -> Vec<Evidence> {
        let reached = self.reached;
        let motion = reached.motion;
        let mut evidence = Vec::new();
        if others.arrival.depends_on_rounding() {
            evidence.push(Evidence::beside(&others.arrival.ends));
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
    fn coexists(&self, others: &Others<'_>) -> Vec<Coexisting> {
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
        for (end, _) in others.arrival.ends.iter().skip(1) {
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
