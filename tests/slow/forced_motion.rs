//! Where the forced motion loses its stability, and the orbit itself, against multipliers by another method: classical
//! Runge-Kutta steps of the equations of motion and their variational equations, Newton's iteration on that map.

use crate::{Fallible, TestResult};
use harvester_lab::dynamics::{
    CriticalExcitation, ForcedMotion, Instability, Orbit, critical_excitation, largest_multipliers,
    resonance_boundary, trace_tongue,
};
use harvester_lab::model::{ForceLaw, ParameterSet, Parameters, ReducedSystem};
use harvester_lab::questions::solve;
use harvester_lab::theory::Resonance;
use nalgebra::{Complex, DMatrix, DVector};
use serde_json::{Value, json};

fn answer(request: &Value) -> Fallible<Value> {
    Ok(serde_json::from_str(&solve(&request.to_string())?)?)
}

fn device(set: ParameterSet, modes: usize, law: ForceLaw) -> Fallible<ReducedSystem> {
    Ok(ReducedSystem::new(Parameters::new(set)?, modes, law)?)
}

fn low_damping(law: ForceLaw) -> Fallible<ReducedSystem> {
    device(ParameterSet { alpha: 1e-4, ..Default::default() }, 2, law)
}

/// State and derivative of the stroboscopic map by 2,000 Runge-Kutta steps.
fn runge_kutta(system: &ReducedSystem, start: &DVector<f64>) -> (DVector<f64>, DMatrix<f64>) {
    const STEPS: u32 = 2000;
    let n = start.len();
    let force = system.rest_force();
    let rates = |state: &DVector<f64>, variation: &DMatrix<f64>, phase: f64| {
        let tip = system.tip_displacement(state.as_slice());
        let mut rate = DVector::zeros(n);
        system.derivative(state.as_slice(), force.rest(tip), phase.sin(), rate.as_mut_slice());
        (rate, system.jacobian(force.slope(tip)) * variation)
    };
    let step = system.parameters.period() / f64::from(STEPS);
    let turn = std::f64::consts::TAU / f64::from(STEPS);
    let (mut state, mut variation) = (start.clone(), DMatrix::identity(n, n));
    for i in 0..STEPS {
        let phase = turn * f64::from(i);
        let moved = |(rate, growth): &(DVector<f64>, DMatrix<f64>), part: f64| {
            (&state + rate * (part * step), &variation + growth * (part * step))
        };
        let a = rates(&state, &variation, phase);
        let (y, v) = moved(&a, 0.5);
        let b = rates(&y, &v, phase + 0.5 * turn);
        let (y, v) = moved(&b, 0.5);
        let c = rates(&y, &v, phase + 0.5 * turn);
        let (y, v) = moved(&c, 1.0);
        let d = rates(&y, &v, phase + turn);
        state += (a.0 + (b.0 + c.0) * 2.0 + d.0) * (step / 6.0);
        variation += (a.1 + (b.1 + c.1) * 2.0 + d.1) * (step / 6.0);
    }
    (state, variation)
}

/// The forced motion at a beta and its multipliers by that map, followed from rest in `steps` equal steps.
fn forced(device: &ReducedSystem, omega: f64, beta: f64, steps: u32) -> Fallible<Vec<Complex<f64>>> {
    let n = device.dimension();
    let mut states = vec![DVector::zeros(n)];
    let mut matrix = DMatrix::zeros(n, n);
    for i in 1..=steps {
        let system = device.with_excitation(beta * f64::from(i) / f64::from(steps), omega)?;
        let mut state = match &states[..] {
            [.., a, b, c] => c * 3.0 - b * 3.0 + a,
            [a, b] => b * 2.0 - a,
            _ => states[0].clone(),
        };
        for iteration in 0.. {
            let (image, derivative) = runge_kutta(&system, &state);
            let defect = image - &state;
            let change =
                (DMatrix::identity(n, n) - &derivative).lu().solve(&defect).ok_or("a singular map")?;
            state += &change;
            matrix = derivative;
            // The voltage of a device with hardly any load is known to no more than the rounding of its charge.
            if change.rows(0, n - 1).amax() < 1e-11 {
                break;
            }
            assert!(iteration < 20, "omega {omega}, beta {beta}: {change}");
        }
        states.push(state);
    }
    Ok(matrix.complex_eigenvalues().iter().copied().collect())
}

/// Largest modulus of the multipliers of a kind; 0 without one.
fn largest(multipliers: &[Complex<f64>], kind: Instability) -> f64 {
    let of_kind = multipliers.iter().filter(|mu| match kind {
        Instability::NeimarkSacker => mu.im.abs() > 1e-6,
        Instability::PeriodDoubling => mu.im.abs() <= 1e-6 && mu.re < 0.0,
        Instability::Fold => mu.im.abs() <= 1e-6 && mu.re > 0.0,
    });
    of_kind.map(|mu| mu.norm()).fold(0.0, f64::max)
}

/// Holds a boundary to the moduli on both sides of it.
fn hold(device: &ReducedSystem, omega: f64, beta: f64, kind: Instability, steps: u32) -> TestResult {
    for (side, outside) in [(1.0 - 1e-6, false), (1.0 + 1e-6, true)] {
        let modulus = largest(&forced(device, omega, side * beta, steps)?, kind);
        assert_eq!(modulus > 1.0, outside, "omega {omega}, beta {beta}: {modulus}");
    }
    Ok(())
}

fn boundary(
    parameters: &Value,
    force: &Value,
    resonance: &str,
    omega: &[f64],
    limit: f64,
) -> Fallible<Value> {
    answer(&json!({
        "task": "boundary", "theory": "floquet", "resonance": resonance, "parameters": parameters,
        "model": {"force": force}, "omega": omega, "limit": limit,
    }))
}

fn near(value: &Value, reference: f64, tolerance: f64) -> bool {
    value.as_f64().is_some_and(|value| (value - reference).abs() <= tolerance)
}

#[test]
fn what_comes_before_a_resonance_is_told() -> TestResult {
    let omega = 6.212945380118955;
    let found = boundary(&json!({"c0": 0.02, "alpha": 1e-4}), &json!("exact"), "first", &[omega], 0.2)?;
    assert!(near(&found["beta"][0], 0.0524158, 5e-8), "{found}");
    let first = &found["first"][0];
    assert!(near(&first["beta"], 0.04944, 5e-6) && first["kind"] == "neimark_sacker", "{found}");
    assert_eq!((&found["ends"], &found["failed"]), (&json!([null]), &json!([null])));
    let device = device(ParameterSet { c0: 0.02, alpha: 1e-4, ..Default::default() }, 2, ForceLaw::Exact)?;
    for (value, kind) in
        [(&found["beta"][0], Instability::PeriodDoubling), (&first["beta"], Instability::NeimarkSacker)]
    {
        hold(&device, omega, value.as_f64().ok_or("a number")?, kind, 40)?;
    }
    // Where nothing comes before, both are the same.
    let found = boundary(&json!({"alpha": 1e-4}), &json!("quadratic"), "first", &[8.1569], 0.04)?;
    assert_eq!(found["first"][0]["beta"], found["beta"][0]);
    Ok(())
}

#[test]
fn the_limit_cuts_and_does_nothing_else() -> TestResult {
    let omegas = [22.56640667296042, 22.384507];
    let mut known: Option<Value> = None;
    for limit in [0.03, 0.04, 0.05, 0.1, 0.15, 0.2] {
        let found = boundary(&json!({"alpha": 1e-4}), &json!("exact"), "sum", &omegas, limit)?;
        let beta = &found["beta"];
        assert!(near(&beta[0], 0.0246341, 5e-8), "{limit}: {found}");
        // To the last digit.
        assert_eq!(beta, known.get_or_insert_with(|| beta.clone()), "{limit}");
    }
    // The second is a window, 0.02008 within it.
    let device = low_damping(ForceLaw::Exact)?;
    let known = known.ok_or("values")?;
    for (omega, value) in omegas.iter().zip(known.as_array().ok_or("a list")?) {
        hold(&device, *omega, value.as_f64().ok_or("a number")?, Instability::NeimarkSacker, 40)?;
    }
    let within = forced(&device, omegas[1], 0.02008, 40)?;
    assert!(largest(&within, Instability::NeimarkSacker) > 1.0, "{within:?}");
    let below = boundary(&json!({"alpha": 1e-4}), &json!("exact"), "sum", &omegas, 0.02)?;
    assert_eq!((&below["beta"], &below["first"]), (&json!([null, null]), &json!([null, null])));
    Ok(())
}

#[test]
fn windows_far_narrower_than_a_step_are_found() -> TestResult {
    // About the tip of a tongue whose beta falls with omega, a frequency is unstable in a window that closes where the
    // flank turns; the test's own fine march counts how wide it is.
    let device = low_damping(ForceLaw::Exact)?;
    let mut narrowest = f64::INFINITY;
    for i in 0..=40 {
        let omega = 22.3 + 2.5e-3 * f64::from(i);
        let found = critical_excitation(&device, omega, 0.03, Some(Instability::NeimarkSacker))?.beta();
        let betas: Vec<f64> = (0..1500).map(|k| 2e-5 * f64::from(k + 1)).collect();
        let fine = largest_multipliers(&device, omega, &betas)?;
        let outside: Vec<f64> = fine
            .iter()
            .zip(&betas)
            .filter(|(mu, _)| mu.is_some_and(|mu| mu.norm() > 1.0 + 1e-9 && mu.im.abs() > 1e-6))
            .map(|(_, beta)| *beta)
            .collect();
        match (found, outside.first()) {
            (Some(beta), Some(first)) => {
                assert!((first - 2e-5..=*first).contains(&beta), "{omega}: {beta} {first}");
                narrowest = narrowest.min(2e-5 * outside.len() as f64);
            }
            // Between two of the fine march's points.
            (Some(beta), None) => {
                let within = forced(&device, omega, beta * (1.0 + 1e-6), 40)?;
                assert!(largest(&within, Instability::NeimarkSacker) > 1.0, "{omega} {beta}: {within:?}");
                narrowest = narrowest.min(2e-5);
            }
            (None, first) => assert_eq!(first, None, "{omega}"),
        }
    }
    assert!(narrowest < 3e-4, "{narrowest}");
    Ok(())
}

#[test]
fn a_resonance_is_the_one_that_was_asked_for() -> TestResult {
    let both = json!({"alpha": 1e-4});
    // Near 2 omega_1 the doubling is the first subharmonic's, near 2 omega_2 the second's.
    for (omega, resonance, other, beta) in
        [(8.1569, "first", "second", 0.000421), (42.8725, "second", "first", 0.036027)]
    {
        let own = boundary(&both, &json!("quadratic"), resonance, &[omega], 0.04)?;
        assert!(near(&own["beta"][0], beta, 1e-6), "{own}");
        let not = boundary(&both, &json!("quadratic"), other, &[omega], 0.04)?;
        assert_eq!(not["beta"], json!([null]));
        let first = &not["first"][0];
        assert!(near(&first["beta"], beta, 1e-6) && first["kind"] == "period_doubling", "{not}");
    }
    // With three modes, two of which meet: omega_1 + omega_3 is no sum of the first two.
    let three = device(ParameterSet { alpha: 1e-4, ..Default::default() }, 3, ForceLaw::Quadratic)?;
    let omega = three.modes[0].omega + three.modes[2].omega + 0.1;
    let found = resonance_boundary(&three, omega, 0.1, Resonance::Sum)?;
    let loss = found.first.ok_or("an instability")?;
    assert_eq!((found.beta, loss.instability), (None, Instability::NeimarkSacker));
    hold(&three, omega, loss.beta, Instability::NeimarkSacker, 20)
}

#[test]
fn a_hardly_loaded_device_has_its_boundaries() -> TestResult {
    // The charge decays in 10^6 units of time: a multiplier of 1 - 2.4e-7 stands between rounding and the orbit.
    let omegas = [25.899449323139123, 25.5047];
    for (force, law) in [
        (json!("quadratic"), ForceLaw::Quadratic),
        (json!("exact"), ForceLaw::Exact),
        (json!({"taylor": 3}), ForceLaw::Taylor(3)),
    ] {
        let found = boundary(&json!({"alpha": 1e-4, "kappa": 1e-12}), &force, "sum", &omegas, 0.04)?;
        assert_eq!(found["failed"], json!([null, null]), "{found}");
        let device = device(ParameterSet { alpha: 1e-4, kappa: 1e-12, ..Default::default() }, 2, law)?;
        let beta = found["beta"][0].as_f64().ok_or("a boundary")?;
        hold(&device, omegas[0], beta, Instability::NeimarkSacker, 40)?;
    }
    Ok(())
}

#[test]
fn the_end_of_the_forced_motion_is_told() -> TestResult {
    let found = boundary(&json!({"alpha": 1e-4}), &json!("quadratic"), "sum", &[21.3], 0.04)?;
    let (first, ends) = (&found["first"][0], &found["ends"][0]);
    assert_eq!((&found["beta"], &first["kind"]), (&json!([null]), &json!("fold")));
    assert_eq!(&first["beta"], ends);
    let beta = ends.as_f64().ok_or("an end")?;
    // Just below, the product of all distances of multipliers from 1 falls with the square root of that from the fold.
    let device = low_damping(ForceLaw::Quadratic)?;
    let product = |part: f64| -> Fallible<f64> {
        let multipliers = forced(&device, 21.3, beta * (1.0 - part), 200)?;
        Ok(multipliers.iter().map(|mu| 1.0 - mu).product::<Complex<f64>>().re)
    };
    let (far, close) = (product(4e-5)?, product(1e-5)?);
    assert!((far / close - 2.0).abs() < 0.01, "{far} {close}");
    // Beyond there is no forced motion to be found, which is what the task orbit says.
    let request =
        json!({"task": "orbit", "parameters": {"alpha": 1e-4, "omega": 21.3, "beta": 0.02}}).to_string();
    let message = solve(&request).expect_err("no motion");
    assert!(message.to_string().contains("the forced motion ends below beta = 0.02"), "{message}");
    Ok(())
}

#[test]
fn verdict_tongue_and_boundary_have_one_march() -> TestResult {
    let device = low_damping(ForceLaw::Exact)?;
    let (omega, kind) = (22.56640667296042, Instability::NeimarkSacker);
    let alone = critical_excitation(&device, omega, 0.2, Some(kind))?.beta().ok_or("a boundary")?;
    let followed = ForcedMotion::of(&device.with_excitation(0.03, omega)?)?;
    assert_eq!(followed.critical.beta(), Some(alone));
    let not_yet = ForcedMotion::of(&device.with_excitation(0.0246, omega)?)?;
    assert_eq!(not_yet.critical, CriticalExcitation::Stable);
    let column = largest_multipliers(&device, omega, &[0.0246, alone * 1.000_001, 0.03])?;
    let orbits = [not_yet.orbit, None, followed.orbit];
    for (chart, orbit) in column.iter().zip(orbits) {
        let Some(orbit) = orbit else { continue };
        let chart = chart.ok_or("a followed motion")?;
        assert!((chart - orbit.largest_multiplier()).norm() < 1e-8, "{chart}");
    }
    let tongue = trace_tongue(&device, Resonance::First, Default::default())?.ok_or("a tongue")?;
    for point in tongue.points.iter().step_by(9) {
        let found = resonance_boundary(&device, point.omega, 0.05, Resonance::First)?;
        let beta = found.beta.ok_or("a boundary")?;
        assert!((beta / point.beta - 1.0).abs() < 1e-5, "{point:?}: {beta}");
    }
    Ok(())
}

#[test]
fn an_orbit_without_a_guess_is_the_forced_motion() -> TestResult {
    let parameters = json!({"alpha": 1e-4, "omega": 22.56640667296042, "beta": 0.0246});
    let orbit = answer(&json!({"task": "orbit", "parameters": parameters, "model": {"force": "exact"}}))?;
    assert_eq!(
        (&orbit["forced"], &orbit["periods"], &orbit["stable"]),
        (&json!(true), &json!(1), &json!(true))
    );
    let reference = forced(&low_damping(ForceLaw::Exact)?, 22.56640667296042, 0.0246, 60)?;
    for value in orbit["multipliers"].as_array().ok_or("a list")? {
        let value = Complex::new(value[0].as_f64().ok_or("re")?, value[1].as_f64().ok_or("im")?);
        let nearest = reference.iter().map(|mu| (mu - value).norm()).fold(f64::INFINITY, f64::min);
        assert!(nearest < 1e-6, "{value}: {nearest:e}");
    }
    Ok(())
}

#[test]
fn sixty_four_periods_of_a_motion_of_one() -> TestResult {
    // Over 64 periods a deviation grows by 1.148^64 = 7,000.
    let device = low_damping(ForceLaw::Quadratic)?;
    let system = device.with_excitation(1e-2, 8.0969)?;
    let known = Orbit::find(&system, None, 1)?;
    let request = |guess: Option<&[f64]>| {
        answer(&json!({
            "task": "orbit", "parameters": {"alpha": 1e-4, "omega": 8.0969, "beta": 1e-2}, "periods": 64, "guess": guess,
        }))
    };
    // A guess that the iteration over 64 periods makes nothing of, but that over one does.
    let off: Vec<f64> = known.state.iter().map(|value| value * 1.05).collect();
    for guess in [None, Some(known.state.as_slice()), Some(off.as_slice())] {
        let orbit = request(guess)?;
        assert_eq!(
            (&orbit["periods"], &orbit["forced"]),
            (&json!(1), &json!(guess.is_none().then_some(true)))
        );
        let v_rms = orbit["v_rms"].as_f64().ok_or("a number")?;
        assert!((v_rms / known.measures.v_rms - 1.0).abs() < 1e-8, "{orbit}");
        assert!((known.largest_multiplier().re + 1.148382).abs() < 1e-6);
    }
    Ok(())
}
