//! Verdicts on the paper's figures: the class, what it rests on, and what must be said beside it.

#![allow(clippy::excessive_precision, reason = "reference values are given as they were printed")]

use crate::{Fallible, OMEGA_1, OMEGA_2, TestResult};
use harvester_lab::dynamics::attractors::evidence::{Evidence, EvidenceSource};
use harvester_lab::dynamics::attractors::motion::Undecided;
use harvester_lab::dynamics::attractors::verdict::{OtherStart, VerdictError, Warning, force_law_warning};
use harvester_lab::dynamics::integration::rk4::RungeKutta4;
use harvester_lab::dynamics::{
    ForcedMotion, Inquiry, Instability, Motion, Orbit, Verdict, largest_multipliers,
};
use harvester_lab::model::{ForceLaw, ParameterSet, Parameters, ReducedSystem};
use harvester_lab::theory::LinearResponse;

const PERIOD_1: Motion = Motion::Periodic { periods: 1 };

fn system(alpha: f64, beta: f64, omega: f64, law: ForceLaw) -> Fallible<ReducedSystem> {
    let set = ParameterSet { alpha, beta, omega, ..Default::default() };
    Ok(ReducedSystem::new(Parameters::new(set)?, 2, law)?)
}

fn strong(omega: f64) -> Fallible<ReducedSystem> {
    system(1e-4, 1e-2, omega, ForceLaw::Quadratic)
}

fn verdict_on(system: &ReducedSystem, initial: &[f64], t_end: f64) -> Result<Verdict, VerdictError> {
    Ok(Inquiry::new(system, initial, t_end)?.verdict)
}

fn sources(verdict: &Verdict) -> Vec<EvidenceSource> {
    assert!(verdict.rests_on.iter().all(|piece| piece.agrees != Some(false)), "{:?}", verdict.rests_on);
    assert!(verdict.disagreeing.is_empty() && verdict.motion == verdict.suspected);
    verdict.rests_on.iter().filter(|piece| piece.agrees == Some(true)).map(Evidence::source).collect()
}

/// Root mean square of the voltage (V) over 200 excitation periods, after 8000 of them, from rest by RK4.
fn settled_voltage(system: &ReducedSystem) -> Fallible<f64> {
    const STEPS: u32 = 400;
    let mut run = RungeKutta4::new(system, &[0.0; 5], STEPS)?;
    let mut square = 0.0;
    for step in 0..8200 * STEPS {
        if let Some(outcome) = run.step() {
            return Err(format!("{outcome:?}").into());
        }
        if step >= 8000 * STEPS {
            square += run.state()[4] * run.state()[4];
        }
    }
    Ok((square / f64::from(200 * STEPS)).sqrt())
}

#[test]
fn figure_3_is_the_stable_forced_motion() -> TestResult {
    let verdict = verdict_on(&system(1e-3, 1e-3, 25.0, ForceLaw::Quadratic)?, &[0.0; 5], 600.0)?;
    assert_eq!(verdict.motion, PERIOD_1);
    // The run ends as soon as it is in the motion's reach, while its points still settle.
    assert_eq!(
        sources(&verdict),
        [EvidenceSource::Multipliers, EvidenceSource::Exponent, EvidenceSource::Spectrum]
    );
    let forced = verdict.forced.ok_or("forced")?;
    assert!(forced.stable && (forced.multiplier.modulus - 0.996743).abs() < 1e-6, "{forced:?}");
    assert!(verdict.multiplier.is_some_and(|multiplier| (multiplier.modulus - 0.996743).abs() < 1e-6));
    // It is that motion, so nothing coexists; and the tip moves too little for a warning.
    assert_eq!((verdict.coexists.len(), verdict.warnings.len()), (0, 0), "{:?}", verdict.warnings);
    Ok(())
}

/// Just beyond the first tongue's tip the doubled motion needs thousands of periods to grow, diverging from rest all the
/// while. RK4 from rest comes to the same voltage.
#[test]
fn slow_growth_beyond_a_boundary_is_not_chaos() -> TestResult {
    for (alpha, beta) in [(1e-4, 5e-4), (1e-4, 6e-4), (1e-3, 8e-4)] {
        let system = system(alpha, beta, 8.1569, ForceLaw::Quadratic)?;
        let verdict = verdict_on(&system, &[0.0; 5], 600.0)?;
        assert_eq!(verdict.motion, Motion::Periodic { periods: 2 }, "alpha {alpha}, beta {beta}");
        let forced = verdict.forced.ok_or("forced")?;
        assert_eq!(forced.instability, Some(Instability::PeriodDoubling));
        let voltage = settled_voltage(&system)?;
        let v_rms = verdict.v_rms.ok_or("voltage")?;
        assert!((v_rms / voltage - 1.0).abs() < 1e-7, "alpha {alpha}, beta {beta}: {v_rms} and {voltage}");
    }
    Ok(())
}

#[test]
fn figure_4_is_a_torus_and_says_what_coexists() -> TestResult {
    let system = strong(OMEGA_1 + OMEGA_2)?;
    let verdict = verdict_on(&system, &[0.0; 5], 605.0)?;
    assert_eq!(verdict.motion, Motion::Quasiperiodic);
    assert_eq!(
        sources(&verdict),
        [
            EvidenceSource::Recurrence,
            EvidenceSource::Points,
            EvidenceSource::Rotation,
            EvidenceSource::ZeroOne,
            EvidenceSource::Exponent,
            EvidenceSource::Spectrum
        ]
    );
    let forced = verdict.forced.ok_or("forced")?;
    assert!(forced.stable && (forced.multiplier.modulus - 0.999378).abs() < 1e-6, "{forced:?}");
    assert_eq!((forced.instability, forced.unstable_from), (None, None));
    let [beside] = verdict.coexists[..] else { return Err("one motion coexists".into()) };
    assert_eq!((beside.start, beside.motion), (OtherStart::ForcedMotion, PERIOD_1));
    assert_eq!(verdict.multiplier, None);
    assert!(verdict.basic.is_some());
    // Started on the forced motion, it is the torus from rest that coexists.
    let orbit = Orbit::find(&system, None, 1)?;
    assert!((beside.measures.v_rms / orbit.measures.v_rms - 1.0).abs() < 1e-9);
    let verdict = verdict_on(&system, &orbit.state, 605.0)?;
    assert_eq!(verdict.motion, PERIOD_1);
    let [beside] = verdict.coexists[..] else { return Err("one motion coexists".into()) };
    assert_eq!((beside.start, beside.motion), (OtherStart::Rest, Motion::Quasiperiodic));
    Ok(())
}

#[test]
fn the_peak_of_a_torus_is_that_of_a_long_run_by_runge_kutta() -> TestResult {
    const STEPS: usize = 250;
    let system = strong(OMEGA_1 + OMEGA_2)?;
    let verdict = verdict_on(&system, &[0.0; 5], 600.0)?;
    let mut run = RungeKutta4::new(&system, &[0.0; 5], STEPS as u32)?;
    let mut peak = 0.0_f64;
    for step in 0..20_000 * STEPS {
        assert!(run.step().is_none());
        if step >= 5000 * STEPS {
            peak = peak.max(run.state()[4].abs());
        }
    }
    assert!(
        verdict.v_peak.is_some_and(|v_peak| (v_peak / peak - 1.0).abs() < 5e-4),
        "{:?}, {peak}",
        verdict.v_peak
    );
    Ok(())
}

#[test]
fn a_slow_transient_ends_in_the_linear_response_and_hangs_on_no_rounding() -> TestResult {
    let set = ParameterSet {
        alpha: 1.0233908736632898e-5,
        beta: 4.507660494492484e-5,
        omega: 52.39782899634506,
        c0: 1.498416208025629,
        d: 0.26256482367445555,
        h: 0.002451819883333969,
        eta: 0.07599914066754945,
        c: 9.297360944547462e-6,
        kappa: 9.888449382616378e-8,
        theta: 2.456704586417608e-5,
        ..Default::default()
    };
    let system = ReducedSystem::new(Parameters::new(set)?, 2, ForceLaw::Exact)?;
    let verdict = verdict_on(&system, &[0.0; 5], 600.0)?;
    assert_eq!(verdict.motion, PERIOD_1);
    let linear = LinearResponse::new(&system)?.voltage.norm() / 2.0_f64.sqrt();
    assert!(
        verdict.v_rms.is_some_and(|v_rms| (v_rms / linear - 1.0).abs() < 1e-4),
        "{:?}, {linear}",
        verdict.v_rms
    );
    let beside = |piece: &Evidence| piece.source() == EvidenceSource::Beside;
    assert!(!verdict.rests_on.iter().any(beside), "{:?}", verdict.rests_on);
    let slow = |warning: &Warning| matches!(warning, Warning::TransientChaos { .. });
    assert!(!verdict.warnings.iter().any(slow), "{:?}", verdict.warnings);
    Ok(())
}

#[test]
fn a_nearly_conservative_device_whose_transient_outlasts_the_effort_is_undecided() -> TestResult {
    // A stable motion of period 3 is there, but the run is 3 % away from it for a million periods.
    let set = ParameterSet { alpha: 1e-4, beta: 0.01239, omega: 12.9689, kappa: 1e-12, ..Default::default() };
    let system = ReducedSystem::new(Parameters::new(set)?, 1, ForceLaw::Exact)?;
    let verdict = verdict_on(&system, &[0.0; 3], 600.0)?;
    assert_eq!(verdict.motion, Motion::Undecided { why: Undecided::TransientNotGone });
    let longer = |warning: &Warning| matches!(warning, Warning::WouldTake { time } if *time > 1e5);
    assert!(verdict.warnings.iter().any(longer), "{:?}", verdict.warnings);
    Ok(())
}

#[test]
fn chaos_of_forty_thousand_periods_is_not_named_where_a_torus_attracts() -> TestResult {
    // Runs at tolerances 1e-6, 1e-8 and 1e-9 leave chaos between t = 4000 and 10000 for the torus about the forced motion,
    // which has just lost its stability.
    let set = ParameterSet {
        alpha: 0.00041394780074859055,
        beta: 0.04973012242646372,
        omega: 25.034830785345395,
        c0: 0.18540251990912038,
        d: 0.18890451916505524,
        h: 0.042417646286551786,
        eta: 0.015879820100582753,
        c: 2.3230084774211234e-6,
        kappa: 4.193403077628977e-8,
        theta: 1.344031667651489e-5,
        ..Default::default()
    };
    let system = ReducedSystem::new(Parameters::new(set)?, 2, ForceLaw::Exact)?;
    let verdict = verdict_on(&system, &[0.0; 5], 600.0)?;
    assert_ne!(verdict.motion, Motion::Chaotic);
    let torus = |motion: Motion, v_rms: Option<f64>| {
        motion == Motion::Quasiperiodic && v_rms.is_some_and(|v_rms| (v_rms - 2.948).abs() < 0.01)
    };
    let met = verdict.coexists.iter().any(|other| torus(other.motion, Some(other.measures.v_rms)));
    assert!(torus(verdict.suspected, verdict.v_rms) || met, "{:?} {:?}", verdict.motion, verdict.coexists);
    Ok(())
}

#[test]
fn beside_other_motions_the_start_at_rest_leads_where_runge_kutta_goes() -> TestResult {
    let system = system(1e-4, 0.02109, 8.15737, ForceLaw::Taylor(5))?;
    let verdict = verdict_on(&system, &[0.0; 5], 600.0)?;
    assert_eq!(verdict.motion, Motion::Periodic { periods: 2 });
    let expected = settled_voltage(&system)?;
    assert!(verdict.v_rms.is_some_and(|v_rms| (v_rms / expected - 1.0).abs() < 1e-4), "{:?}", verdict.v_rms);
    Ok(())
}

#[test]
fn figure_9_has_period_2_where_the_forced_motion_has_doubled() -> TestResult {
    let verdict = verdict_on(&strong(2.0 * OMEGA_1)?, &[0.0; 5], 600.0)?;
    assert_eq!(verdict.motion, Motion::Periodic { periods: 2 });
    // The run ends as soon as it is in the motion's reach, while its points still settle.
    assert_eq!(
        sources(&verdict),
        [EvidenceSource::Multipliers, EvidenceSource::Exponent, EvidenceSource::Spectrum]
    );
    let forced = verdict.forced.ok_or("forced")?;
    assert!((forced.multiplier.re + 1.148382).abs() < 1e-6, "{forced:?}");
    assert_eq!((forced.stable, forced.instability), (false, Some(Instability::PeriodDoubling)));
    // An independent program's boundary.
    assert!(forced.unstable_from.is_some_and(|beta| (beta - 0.001628).abs() < 1e-6), "{forced:?}");
    let (low, high) = verdict.tip_over_gap.ok_or("tip")?;
    assert!((low + 0.4930).abs() < 1e-4 && (high - 0.3896).abs() < 1e-4, "{low} {high}");
    assert!(verdict.v_rms.is_some_and(|v_rms| (v_rms - 14.1783).abs() < 1e-4));
    // An independent program's 25.6 V, of a run that has not quite settled.
    assert!(verdict.v_peak.is_some_and(|v_peak| (v_peak / 25.6 - 1.0).abs() < 0.01));
    assert_eq!(verdict.peaks[0].label.map(|label| label.to_string()).as_deref(), Some("ω/2"));
    assert!(verdict.coexists.is_empty());
    // With a multiplier of 0.988 the transient outlives t = 600; and the paper's quadratic law is strained.
    assert!(verdict.warnings.iter().any(|warning| matches!(warning, Warning::TransientLeft { .. })));
    assert!(
        verdict.warnings.iter().any(
            |warning| matches!(warning, Warning::ForceLaw { missing } if (0.75..0.85).contains(missing))
        )
    );
    Ok(())
}

#[test]
fn figure_12_escapes_beside_a_stable_forced_motion() -> TestResult {
    let verdict = verdict_on(&strong(2.0 * OMEGA_2)?, &[0.0; 5], 600.0)?;
    assert!(matches!(verdict.motion, Motion::Escape { time } if (time - 1.14).abs() < 0.01));
    assert_eq!(sources(&verdict), [EvidenceSource::Run]);
    assert_eq!((verdict.v_rms, verdict.exponent, verdict.tip_over_gap), (None, None, None));
    assert!(verdict.forced.is_some_and(|forced| (forced.multiplier.modulus - 0.998852).abs() < 1e-6));
    assert_eq!(verdict.coexists.len(), 1);
    assert_eq!(verdict.warnings, [Warning::TruncatedBarrier]);
    let exact = verdict_on(&system(1e-4, 1e-2, 2.0 * OMEGA_2, ForceLaw::Exact)?, &[0.0; 5], 600.0)?;
    assert!(matches!(exact.motion, Motion::Periodic { .. }), "{}", exact.motion);
    assert!(exact.tip_over_gap.is_some_and(|(low, _)| low > -1.0));
    Ok(())
}

#[test]
fn chaos_rests_on_its_exponent_and_its_spectrum() -> TestResult {
    let verdict = verdict_on(&system(1e-4, 0.05, 11.0, ForceLaw::Exact)?, &[0.0; 5], 600.0)?;
    assert_eq!(verdict.motion, Motion::Chaotic);
    assert_eq!(
        sources(&verdict),
        [
            EvidenceSource::Recurrence,
            EvidenceSource::ZeroOne,
            EvidenceSource::Exponent,
            EvidenceSource::Spectrum
        ]
    );
    assert!(verdict.warnings.iter().any(|warning| matches!(warning, Warning::LargeDeflection { .. })));
    Ok(())
}

#[test]
fn a_verdict_is_written_as_json() -> TestResult {
    let text = serde_json::to_string(&verdict_on(&strong(2.0 * OMEGA_1)?, &[0.0; 5], 300.0)?)?;
    assert!(text.contains(r#""motion":{"kind":"periodic","periods":2}"#), "{text}");
    Ok(())
}

#[test]
fn the_forced_motion_has_the_multipliers_of_the_stability_chart() -> TestResult {
    for omega in [2.0 * OMEGA_1, OMEGA_1 + OMEGA_2, 2.0 * OMEGA_2] {
        let system = strong(omega)?;
        let forced = ForcedMotion::of(&system)?.orbit.ok_or("an orbit")?;
        let chart = largest_multipliers(&system, omega, &[1e-2])?;
        let [Some(expected)] = chart[..] else { return Err("one multiplier".into()) };
        assert!((forced.largest_multiplier() - expected).norm() < 1e-8);
    }
    Ok(())
}

#[test]
fn the_force_law_is_judged_where_the_tip_is_closest() -> TestResult {
    let quadratic = strong(25.0)?;
    let gap = quadratic.equilibrium.gap;
    assert_eq!(force_law_warning(&quadratic, -0.01 * gap), None);
    assert_eq!(force_law_warning(&quadratic, -1.01 * gap), Some(Warning::PassesMagnet));
    // R by the remainders of the poles, in the form that cancels nothing.
    let p = &quadratic.parameters;
    let s = -0.5 * gap;
    let r = |x: f64| s * s * (3.0 * x + 2.0 * s) / (x.powi(3) * (x + s).powi(2));
    let exact = -p.c0 * (r(gap) + r(gap + 2.0 * p.h) - 2.0 * r(gap + p.h));
    let expected = 1.0 - -19.378543266711 * s * s / exact;
    let Some(Warning::ForceLaw { missing }) = force_law_warning(&quadratic, s) else {
        panic!("half the gap")
    };
    assert!((missing - expected).abs() < 1e-6, "{missing} {expected}");
    assert_eq!(force_law_warning(&system(1e-4, 1e-2, 25.0, ForceLaw::Exact)?, s), None);
    Ok(())
}
