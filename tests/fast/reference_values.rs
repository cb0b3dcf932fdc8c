//! The model against numbers computed apart from it: 40-digit (magnets: 60-digit) arithmetic on the printed
//! formulas, for the paper's parameters and for geometries at the edge of what is accepted.

#![allow(clippy::excessive_precision, reason = "reference values are given as they were printed")]

use crate::{Fallible, TestResult};
use harvester_lab::model::force::Exact;
use harvester_lab::model::{
    Device, ElectricalScaling, Equilibrium, ForceLaw, Magnet, ModeSet, ParameterSet, Parameters,
    ReducedSystem,
};
use harvester_lab::theory::{SteadyState, TheoryError};

/// (omega_n, eta_1n, eta_2n, theta_n): roots of Eq. (21) and quadrature of Eq. (22) in 40-digit arithmetic.
const MODES: [(f64, f64, f64, f64); 8] = [
    (4.0484513968628941, 0.41726865282308394, 0.27516355933242792, 2.6672039741434404e-4),
    (21.356243425304903, -0.23575743102672759, 0.30056264826640121, 1.0169700653849028e-3),
    (59.658372041633981, 0.15062248984724051, 0.34247005683983, 1.7773152822310406e-3),
    (117.07620425491055, -0.11397772113807961, 0.38593583202920526, 2.6301491190019893e-3),
    (193.84993196003954, 0.093969494322354384, 0.43263869205821605, 3.5586055311305317e-3),
    (290.02429470646515, -0.081185080811033106, 0.48308899533581309, 4.5651899788377194e-3),
    (405.65201429835763, 0.072463122556288659, 0.53739596737692708, 5.6501058453306262e-3),
    (540.77655830229315, -0.066090171315126858, 0.59560157588634327, 6.8135293893901268e-3),
];

/// c_1..c_7 at the equilibrium of the paper's magnets.
const TAYLOR: [f64; 7] = [
    1.3450051225722020,
    -19.378543266710827,
    223.38294552190619,
    -2253.3500136038406,
    20784.085809381932,
    -179740.58701635469,
    1480518.2085419903,
];

fn assert_relative(value: f64, reference: f64, tolerance: f64, what: &str) {
    let error = (value - reference).abs();
    assert!(error <= tolerance * reference.abs(), "{what}: {value:e} instead of {reference:e}");
}

fn system(set: ParameterSet, modes: usize) -> Fallible<ReducedSystem> {
    Ok(ReducedSystem::new(Parameters::new(set)?, modes, ForceLaw::Quadratic)?)
}

#[test]
fn the_papers_device_gives_its_dimensionless_numbers() -> TestResult {
    let device = Device::default();
    assert_relative(device.time_unit(), 0.45432653282105025, 1e-14, "time unit");
    let set = device.dimensionless(ElectricalScaling::AsPrinted)?;
    // Value by 40-digit arithmetic, value printed, digits printed.
    for (name, value, reference, printed, digits) in [
        ("alpha", set.alpha, 0.0010000091912755813, 0.001, 0),
        ("beta", set.beta, 0.001, 0.001, 0),
        ("omega", set.omega, 25.0, 25.0, 1),
        ("c0", set.c0, 0.50838445786402502, 0.5084, 3),
        ("d", set.d, 0.14995177816272966, 0.15, 1),
        ("h", set.h, 0.0041666666666666667, 0.004167, 3),
        ("eta", set.eta, 0.02, 0.02, 0),
        ("c", set.c, 9.9999580052493438e-7, 1e-6, 0),
        ("kappa", set.kappa, 9.9999997181773798e-7, 1e-6, 0),
        ("theta", set.theta, 1.9999580052493438e-4, 2e-4, 0),
    ] {
        assert_relative(value, reference, 1e-13, name);
        assert_eq!(format!("{value:.digits$e}"), format!("{printed:.digits$e}"), "{name} as printed");
    }
    Ok(())
}

#[test]
fn the_consistent_scaling_divides_the_circuit_by_the_beam_length() -> TestResult {
    let device = Device::default();
    let consistent = device.dimensionless(ElectricalScaling::Consistent)?;
    assert_relative(consistent.c, 9.9999580052493438e-7 / 0.48, 1e-13, "c");
    assert_relative(consistent.kappa, 9.9999997181773798e-7 / 0.48, 1e-13, "kappa");
    assert_relative(consistent.theta, 1.9999580052493438e-4 / 0.48, 1e-13, "theta");
    let printed = device.dimensionless(ElectricalScaling::AsPrinted)?;
    let mechanical = ParameterSet { c: printed.c, kappa: printed.kappa, theta: printed.theta, ..consistent };
    assert_eq!(mechanical, printed);
    Ok(())
}

#[test]
fn the_magnets_of_table_1_push_with_the_newtons_of_equation_1() {
    let device = Device::default();
    assert_relative(device.magnet_force(0.3385), 1.2450520020143396e-5, 1e-10, "at the printed distance");
    assert_relative(device.magnet_force(0.005), 80.394188967780645, 1e-13, "at 5 mm");
    assert!(Device { repelling: false, ..device }.magnet_force(0.005) < 0.0);
}

#[test]
fn equilibrium_and_coefficients_of_the_paper() -> TestResult {
    let parameters = Parameters::new(ParameterSet::default())?;
    let rest = Equilibrium::new(&parameters)?;
    assert_relative(rest.displacement, 0.019450341372523630, 1e-13, "A_e");
    assert_relative(rest.gap, 0.16945034137252363, 1e-14, "s0");
    assert!(!rest.beyond_the_papers_assumption());
    let system = system(ParameterSet::default(), 1)?;
    for (j, (value, reference)) in system.taylor_coefficients(7).iter().zip(TAYLOR).enumerate() {
        assert_relative(*value, reference, 1e-12, &format!("c_{}", j + 1));
    }
    Ok(())
}

#[test]
fn the_force_keeps_its_digits_at_extreme_geometries() {
    for (c0, h, x, reference) in [
        (10.0, 1e-5, 2.0, 3.7499250010937359e-10),
        (10.0, 1e-5, 0.01, 0.59760698204329943),
        (-10.0, 1.0, 1e-6, -9999999999982.5),
        (0.5084, 1.0, 2.0, 0.045897222222222222),
        (0.5084, 0.004167, 1e-7, 50839999948764.113),
        (0.5084, 0.004167, 0.1, 0.4510685154227577),
    ] {
        assert_relative(Magnet { c0, h }.force(x), reference, 1e-14, &format!("F({x}) of {c0}, {h}"));
    }
}

#[test]
fn the_coefficients_keep_their_digits_at_extreme_geometries() {
    for (c0, h, gap, j, reference) in [
        (10.0, 1e-5, 2.0, 1, 7.4998125032812008e-10),
        (10.0, 1e-5, 0.01, 7, 7121351326030275.7),
        (-1e-3, 1.0, 0.01, 3, -39999999.992510196),
        (0.5084, 0.3, 0.7, 5, 31.42529128010012),
        (0.5084, 0.3, 0.91, 15, 39.792950166244618),
        (0.5084, 0.004167, 0.15, 15, 118549872214464.01),
    ] {
        let value = Magnet { c0, h }.taylor_coefficient(gap, j);
        assert_relative(value, reference, 1e-13, &format!("c_{j} of {c0}, {h} at {gap}"));
    }
}

#[test]
fn the_exact_remainder_keeps_its_digits_at_extreme_geometries() {
    let fractions = [-0.999, -0.51, -0.49, -1e-3, 1e-6, 0.49, 0.51, 30.0];
    for (c0, h, gap, references) in [
        (
            0.5084,
            0.004167,
            0.169450341372524,
            [
                -17658966.961546615,
                -0.74509982496828611,
                -0.61934117197408337,
                -5.5751294684990086e-7,
                -5.5642312988705003e-13,
                -0.065539230273017615,
                -0.069472961255635864,
                -6.778996360256156,
            ],
        ),
        (
            10.0,
            1e-5,
            0.01,
            [
                -61111111108.12785,
                -8.5080230916088494,
                -7.0320042780348088,
                -5.9760837542786285e-6,
                -5.9641345811882162e-12,
                -0.69393977446358604,
                -0.73539924688700695,
                -71.043649897949176,
            ],
        ),
        (
            0.02,
            1.0,
            0.2,
            [
                -499998.49815997824,
                -1.0718156452371729,
                -0.93174055504956848,
                -1.4997896381163508e-6,
                -1.4977856377079747e-12,
                -0.21473740203336428,
                -0.22877329394253511,
                -29.268453341045791,
            ],
        ),
        (
            -1e-3,
            0.05,
            0.15,
            [
                44443.70542335973,
                0.059880192980992025,
                0.051334435734026614,
                6.6345713802965404e-8,
                6.6238226106709044e-14,
                0.0086065219991927828,
                0.009143756840881188,
                0.98222225296773567,
            ],
        ),
    ] {
        // Near contact the distance s0 + s itself loses three digits.
        let law = Exact::new(&Magnet { c0, h }, &Equilibrium { displacement: 0.0, gap });
        for (fraction, reference) in fractions.into_iter().zip(references) {
            let what = format!("R({fraction} s0) of {c0}, {h}");
            assert_relative(law.rest(fraction * gap), reference, 1e-12, &what);
        }
    }
}

#[test]
fn all_eight_modes_are_as_good_as_the_first() -> TestResult {
    let system = system(ParameterSet::default(), 8)?;
    for (n, (mode, (omega, eta1, eta2, theta))) in system.modes.iter().zip(MODES).enumerate() {
        assert_relative(mode.omega, omega, 1e-14, &format!("omega_{}", n + 1));
        assert_relative(mode.eta1, eta1, 1e-12, &format!("eta_1{}", n + 1));
        assert_relative(mode.eta2, eta2, 1e-13, &format!("eta_2{}", n + 1));
        assert_relative(system.theta[n], theta, 1e-12, &format!("theta_{}", n + 1));
    }
    let fewer = ModeSet::new(system.c1, 0.02, 2)?;
    assert_eq!(fewer[1], system.modes[1]);
    Ok(())
}

#[test]
fn the_steady_states_of_figures_3_8_and_11() -> TestResult {
    for (omega, amplitudes, voltage, phase) in [
        (25.0, [-0.0015572765543312866, 0.0029023702160385896], 2.5342396255288177, 0.039978687123290041),
        (8.0, [-0.0020384790715146875, -0.00012803406958765551], -0.66870674219017138, 0.12435499454676144),
        (43.0, [-0.0015300009147359203, 0.0010412235121485225], 0.65063477264990768, 0.023251622810462915),
    ] {
        let state = SteadyState::new(&system(ParameterSet { omega, ..Default::default() }, 2)?)?;
        for (value, reference) in state.amplitudes.iter().zip(amplitudes) {
            assert_relative(*value, reference, 1e-12, "a_k");
        }
        assert_relative(state.voltage.amplitude, voltage, 1e-12, "voltage");
        assert_relative(state.voltage.phase, phase, 1e-14, "phase");
        let (v, rate) = state.voltage.stroboscopic_point();
        assert_relative(v, voltage * phase.sin(), 1e-12, "v of the Poincare point");
        assert_relative(rate, voltage * omega * phase.cos(), 1e-12, "dv/dt of the Poincare point");
        // The printed voltage solves the circuit equation (31) under the printed motion.
        for t in [0.0, 0.1, 1.7] {
            let circuit = 1e-6 * (state.voltage.rate(t) + state.voltage.value(t));
            let tip: f64 = amplitudes.iter().zip(MODES).map(|(a, mode)| a * mode.3).sum();
            let current = tip * omega * (omega * t).cos();
            assert!((circuit - current).abs() < 1e-12 * (1e-6 * voltage * omega).abs());
        }
    }
    Ok(())
}

#[test]
fn the_steady_state_at_its_limits() -> TestResult {
    let open = system(ParameterSet { kappa: 0.0, ..Default::default() }, 8)?;
    let state = SteadyState::new(&open)?;
    assert_eq!(state.voltage.phase, 0.0);
    let charge: f64 = state.amplitudes.iter().zip(&open.theta).map(|(a, theta)| a * theta).sum();
    assert_relative(state.voltage.amplitude, charge / 1e-6, 1e-14, "an open circuit integrates the current");
    for mode in 0..3 {
        let resonant = open.with_excitation(1e-3, open.modes[mode].omega)?;
        let error = TheoryError::NaturalFrequency { mode: mode + 1, omega: open.modes[mode].omega };
        assert_eq!(SteadyState::new(&resonant), Err(error));
    }
    Ok(())
}
