//! Comes to a [`Verdict`] a slice at a time: the run and what it reaches, the exponent on a periodic motion reached, the
//! spectrum, the forced motion, and for a start away from rest what rest leads to.
//!
//! The run, the exponent and the start at rest can be cut anywhere; the spectrum and the forced motion are one slice
//! each, of some ten milliseconds for two modes. On a periodic motion, exponent and spectrum are those of the motion
//! itself, started on it, so that nothing of the transient is in them; were it unstable after all, it would be left.

use super::evidence::{Evidence, Source};
use super::forced::ForcedMotion;
use super::lyapunov::{Exponent, Lyapunov, Progress};
use super::motion::{Cell, Horizon, Motion, Reached, Undecided};
use super::orbit::Measures;
use super::verdict::{
    Coexisting, ForcedSummary, OtherStart, Verdict, VerdictError, Warning, deflection_warning,
    force_law_warning, forced_warning, transient_warning,
};
use super::voltage_spectrum::{VoltageSpectrum, VoltageSpectrumError};
use super::{IntegrationError, Orbit, Outcome, Search};
use crate::model::{ForceLaw, ReducedSystem};

/// Record of the exponent on a periodic motion: first, and when it is given up as it is (excitation periods).
const EXPONENT_PERIODS: (usize, usize) = (256, 8192);
/// Half width of that exponent, relative to it, at which it is accurate enough.
const ACCURATE: f64 = 0.02;
/// Decay of the tangent vectors over the record after which it is long enough whatever the interval says.
const LONG: f64 = 200.0;
/// Integrator steps that count as an excitation period.
const STEPS_PER_PERIOD: usize = 8;
/// Distance, over the gap, below which two states are the same.
const SAME_STATE: f64 = 1e-6;
/// Relative difference of voltages below which two motions that are not periodic are the same.
const SAME_VOLTAGE: f64 = 0.05;

/// The work on one verdict.
#[derive(Debug)]
pub struct Inquiry {
    system: ReducedSystem,
    initial: Vec<f64>,
    t_end: f64,
    stage: Stage,
    findings: Findings,
}

/// What is done next.
#[derive(Debug)]
enum Stage {
    Run(Box<Search>),
    Exponent { work: Box<Lyapunov>, done: usize },
    Spectrum,
    Forced,
    FromRest(Box<Search>),
    Finished,
}

/// What is known so far.
#[derive(Debug, Default)]
struct Findings {
    reached: Option<Reached>,
    exponent: Option<Exponent>,
    spectrum: Option<VoltageSpectrum>,
    forced: Option<ForcedMotion>,
    from_rest: Option<Reached>,
}

impl Inquiry {
    /// Prepares the verdict on the start of `system` in `initial` (length 2N + 1) with a run of length `t_end`.
    ///
    /// # Errors
    /// [`IntegrationError::InitialState`].
    pub fn new(system: &ReducedSystem, initial: &[f64], t_end: f64) -> Result<Self, IntegrationError> {
        let search = Search::new(system, initial, Horizon::full(t_end))?;
        Ok(Self {
            system: system.clone(),
            initial: initial.to_vec(),
            t_end,
            stage: Stage::Run(Box::new(search)),
            findings: Findings::default(),
        })
    }

    /// Goes on with the present stage for about `steps` steps of the integrator; the verdict once there is one.
    ///
    /// # Errors
    /// [`VerdictError`]; the inquiry is then over.
    pub fn advance(&mut self, steps: usize) -> Result<Option<Verdict>, VerdictError> {
        let next = match std::mem::replace(&mut self.stage, Stage::Finished) {
            Stage::Run(mut search) => match search.advance(steps)? {
                None => Stage::Run(search),
                Some(reached) => self.after_run(reached)?,
            },
            Stage::Exponent { mut work, done } => {
                let left = EXPONENT_PERIODS.1 - done;
                let periods = (steps / STEPS_PER_PERIOD).clamp(1, EXPONENT_PERIODS.0).min(left);
                let done = done + periods;
                match work.advance(periods)? {
                    Progress::Going(exponent) => {
                        self.findings.exponent = exponent;
                        let accurate = exponent.is_some_and(|exponent| {
                            exponent.half_width <= ACCURATE * exponent.value.abs()
                                || exponent.value.abs() * exponent.duration > LONG
                        });
                        let enough = done >= EXPONENT_PERIODS.0 && accurate || done >= EXPONENT_PERIODS.1;
                        if enough { Stage::Spectrum } else { Stage::Exponent { work, done } }
                    }
                    Progress::Ended(_) | Progress::Unresolved => Stage::Spectrum,
                }
            }
            Stage::Spectrum => {
                self.take_spectrum()?;
                Stage::Forced
            }
            Stage::Forced => {
                self.findings.forced = ForcedMotion::of(&self.system).ok();
                if self.initial.iter().all(|value| *value == 0.0) {
                    return Ok(self.conclude());
                }
                let rest = vec![0.0; self.initial.len()];
                Stage::FromRest(Box::new(Search::new(&self.system, &rest, Horizon::chart(self.t_end))?))
            }
            Stage::FromRest(mut search) => match search.advance(steps)? {
                None => Stage::FromRest(search),
                from_rest => {
                    self.findings.from_rest = from_rest;
                    return Ok(self.conclude());
                }
            },
            Stage::Finished => return Ok(None),
        };
        self.stage = next;
        Ok(None)
    }

    /// The motion reached, once its stage is done.
    pub fn reached(&self) -> Option<&Reached> {
        self.findings.reached.as_ref()
    }

    /// The spectrum of its voltage, once its stage is done.
    pub fn spectrum(&self) -> Option<&VoltageSpectrum> {
        self.findings.spectrum.as_ref()
    }

    /// The forced motion at the same parameters, once its stage is done.
    pub fn forced(&self) -> Option<&ForcedMotion> {
        self.findings.forced.as_ref()
    }

    /// Names the present stage, for a progress line.
    pub fn doing(&self) -> &'static str {
        match self.stage {
            Stage::Run(_) => "following the motion",
            Stage::Exponent { .. } => "computing the Lyapunov exponent",
            Stage::Spectrum => "computing the spectrum",
            Stage::Forced => "following the forced motion from rest",
            Stage::FromRest(_) => "following the motion from rest",
            Stage::Finished => "done",
        }
    }

    fn after_run(&mut self, reached: Reached) -> Result<Stage, VerdictError> {
        self.findings.exponent = reached.exponent;
        let ended = matches!(reached.motion, Motion::Escape { .. } | Motion::Contact { .. });
        let stage = match &reached.orbit {
            Some(orbit) => {
                Stage::Exponent { work: Box::new(Lyapunov::new(&self.system, &orbit.state)?), done: 0 }
            }
            None if ended => Stage::Forced,
            None => Stage::Spectrum,
        };
        self.findings.reached = Some(reached);
        Ok(stage)
    }

    fn take_spectrum(&mut self) -> Result<(), VerdictError> {
        let Some(reached) = &mut self.findings.reached else { return Ok(()) };
        let state = reached.orbit.as_ref().map_or(&reached.state, |orbit| &orbit.state);
        match VoltageSpectrum::of(&self.system, state, reached.motion) {
            Ok(spectrum) => self.findings.spectrum = Some(spectrum),
            // What looked like a lasting motion was a transient.
            Err(VoltageSpectrumError::Ended { outcome }) => {
                let time = reached.time + outcome.early_end().unwrap_or(0.0);
                reached.motion = match outcome {
                    Outcome::Contact { .. } => Motion::Contact { time },
                    _ => Motion::Escape { time },
                };
                reached.measures = None;
                self.findings.exponent = None;
            }
            Err(error) => return Err(error.into()),
        }
        Ok(())
    }

    /// Puts everything together.
    fn conclude(&self) -> Option<Verdict> {
        let Findings { reached, exponent, spectrum, forced, from_rest } = &self.findings;
        let reached = reached.as_ref()?;
        let suspected = reached.motion;
        let gap = self.system.equilibrium.gap;
        let rests_on = self.evidence(reached, exponent.as_ref(), spectrum.as_ref());
        let disagreeing: Vec<Source> =
            rests_on.iter().filter(|piece| piece.agrees == Some(false)).map(|piece| piece.source).collect();
        let motion = if disagreeing.is_empty() {
            suspected
        } else {
            Motion::Undecided { why: Undecided::EvidenceDisagrees }
        };
        let mut warnings: Vec<Warning> = Vec::new();
        warnings.extend(transient_warning(reached.distance));
        if let Some(Measures { tip_min, tip_max, .. }) = reached.measures {
            warnings.extend(force_law_warning(&self.system, tip_min));
            warnings.extend(deflection_warning(tip_min, tip_max));
        }
        if matches!(suspected, Motion::Escape { .. }) && self.system.law != ForceLaw::Exact {
            warnings.push(Warning::TruncatedBarrier);
        }
        warnings.extend(forced_warning(forced.as_ref()));
        let forced_orbit = forced.as_ref().and_then(|forced| forced.orbit.as_ref());
        let mut coexists = Vec::new();
        coexists.extend(forced_orbit.and_then(|orbit| self.beside_forced(reached, orbit)));
        coexists.extend(from_rest.as_ref().and_then(|other| self.beside_rest(reached, other)));
        let (peaks, basic) =
            spectrum.as_ref().map_or((Vec::new(), None), |found| (found.peaks.clone(), found.basic));
        Some(Verdict {
            motion,
            suspected,
            multiplier: reached.orbit.as_ref().map(|orbit| orbit.largest_multiplier().into()),
            forced: forced
                .as_ref()
                .zip(forced_orbit)
                .map(|(forced, orbit)| ForcedSummary::new(forced, orbit)),
            exponent: *exponent,
            v_rms: reached.measures.map(|measures| measures.v_rms),
            v_peak: reached.measures.map(|measures| measures.v_peak),
            power: reached.measures.map(|measures| measures.power),
            tip_over_gap: reached.measures.map(|measures| (measures.tip_min / gap, measures.tip_max / gap)),
            slope: reached.measures.map(|measures| measures.slope),
            peaks,
            basic,
            rests_on,
            disagreeing,
            coexists,
            warnings,
        })
    }

    fn evidence(
        &self,
        reached: &Reached,
        exponent: Option<&Exponent>,
        spectrum: Option<&VoltageSpectrum>,
    ) -> Vec<Evidence> {
        let motion = reached.motion;
        if matches!(motion, Motion::Escape { .. } | Motion::Contact { .. }) {
            return vec![Evidence::run(motion)];
        }
        let period = self.system.parameters.period();
        let orbit = reached.orbit.as_ref();
        let mut evidence = Vec::new();
        evidence.extend(
            orbit.zip(reached.distance).map(|(orbit, distance)| Evidence::multipliers(orbit, distance)),
        );
        evidence.extend(Evidence::recurrence(reached));
        evidence.extend(reached.dimension.map(|dimension| Evidence::points(motion, dimension)));
        evidence.extend(exponent.map(|exponent| Evidence::exponent(motion, exponent, orbit, period)));
        evidence.extend(spectrum.map(|spectrum| Evidence::spectrum(motion, spectrum)));
        evidence
    }

    /// The forced motion, when it is stable and not the motion reached.
    fn beside_forced(&self, reached: &Reached, forced: &Orbit) -> Option<Coexisting> {
        let same = reached.orbit.as_ref().is_some_and(|orbit| self.same(&orbit.state, &forced.state));
        let motion = Motion::Periodic { periods: 1 };
        let measures = forced.measures;
        (forced.stable() && !same).then_some(Coexisting {
            start: OtherStart::ForcedMotion,
            motion,
            v_rms: measures.v_rms,
            power: measures.power,
        })
    }

    /// The motion from rest, when it is not the motion reached.
    fn beside_rest(&self, reached: &Reached, other: &Reached) -> Option<Coexisting> {
        let (here, there) = (reached.cell(), other.cell());
        let same = match (&reached.orbit, &other.orbit) {
            // The same orbit may be met at another of its points.
            (Some(a), Some(b)) => {
                a.periods == b.periods && (a.measures.v_rms / b.measures.v_rms - 1.0).abs() < 1e-6
            }
            (None, None) => {
                std::mem::discriminant(&here.motion) == std::mem::discriminant(&there.motion)
                    && (here.v_rms - there.v_rms).abs() <= SAME_VOLTAGE * here.v_rms
            }
            _ => false,
        };
        let decided = !matches!(there.motion, Motion::Undecided { .. });
        let Cell { motion, v_rms, power, .. } = there;
        (decided && !same).then_some(Coexisting { start: OtherStart::Rest, motion, v_rms, power })
    }

    fn same(&self, a: &[f64], b: &[f64]) -> bool {
        let scales = super::period_map::scales(&self.system);
        let gap = self.system.equilibrium.gap;
        a.iter().zip(b).zip(&scales).all(|((a, b), scale)| (a - b).abs() <= SAME_STATE * gap * scale)
    }
}
