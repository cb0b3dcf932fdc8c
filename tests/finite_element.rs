//! The modes against a finite-element beam: Hermite cubics, tip mass eta, tip spring c_1, nothing shared with
//! the characteristic equation.

use harvester_lab::model::{ModeSet, ModelError};
use nalgebra::{DMatrix, DVector, Matrix4, SymmetricEigen, Vector4};

type TestResult = Result<(), Box<dyn std::error::Error>>;

/// What a mode is compared by: frequency, participation, modal mass and tip slope, scaled to unit tip.
#[derive(Clone, Copy)]
struct BeamMode {
    omega: f64,
    eta1: f64,
    eta2: f64,
    tip_slope: f64,
}

/// Modes of a clamped beam of `elements` equal Hermite elements, ascending in frequency.
fn finite_element_modes(c1: f64, eta: f64, elements: usize) -> Option<Vec<BeamMode>> {
    let h = 1.0 / elements as f64;
    let size = 2 * elements + 2;
    let mut stiffness = DMatrix::zeros(size, size);
    let mut mass = DMatrix::zeros(size, size);
    let mut load = DVector::zeros(size);
    // Textbook element matrices for the unknowns (w, w' h) at both ends.
    let k = Matrix4::new(
        12.0, 6.0, -12.0, 6.0, 6.0, 4.0, -6.0, 2.0, -12.0, -6.0, 12.0, -6.0, 6.0, 2.0, -6.0, 4.0,
    ) / h.powi(3);
    let m = Matrix4::new(
        156.0, 22.0, 54.0, -13.0, 22.0, 4.0, 13.0, -3.0, 54.0, 13.0, 156.0, -22.0, -13.0, -3.0, -22.0, 4.0,
    ) * (h / 420.0);
    let uniform = Vector4::new(6.0, 1.0, 6.0, -1.0) * (h / 12.0);
    for element in 0..elements {
        let mut block = stiffness.fixed_view_mut::<4, 4>(2 * element, 2 * element);
        block += k;
        let mut block = mass.fixed_view_mut::<4, 4>(2 * element, 2 * element);
        block += m;
        let mut part = load.fixed_rows_mut::<4>(2 * element);
        part += uniform;
    }
    let tip = size - 2;
    stiffness[(tip, tip)] += c1;
    mass[(tip, tip)] += eta;
    load[tip] += eta;
    // The clamp removes the first two unknowns.
    let free = size - 2;
    let stiffness = stiffness.view((2, 2), (free, free)).into_owned();
    let mass = mass.view((2, 2), (free, free)).into_owned();
    let load = load.rows(2, free).into_owned();
    let lower = mass.clone().cholesky()?.l();
    let half = lower.solve_lower_triangular(&stiffness)?;
    let reduced = lower.solve_lower_triangular(&half.transpose())?;
    let eigen = SymmetricEigen::try_new(0.5 * (&reduced + reduced.transpose()), f64::EPSILON, 10_000)?;
    let mut modes = Vec::new();
    for (value, vector) in eigen.eigenvalues.iter().zip(eigen.eigenvectors.column_iter()) {
        let shape = lower.transpose().solve_upper_triangular(&vector.into_owned())?;
        let shape = &shape / shape[free - 2];
        modes.push(BeamMode {
            omega: value.sqrt(),
            eta1: load.dot(&shape),
            eta2: shape.dot(&(&mass * &shape)),
            tip_slope: shape[free - 1] / h,
        });
    }
    modes.sort_by(|a, b| a.omega.total_cmp(&b.omega));
    Some(modes)
}

/// Relative errors (omega, eta_1, eta_2, tip slope) of mode `n` of a mesh against the exact modes.
fn errors(exact: &ModeSet, c1: f64, eta: f64, elements: usize, n: usize) -> Option<[f64; 4]> {
    let found = *finite_element_modes(c1, eta, elements)?.get(n)?;
    let mode = &exact[n];
    Some([
        found.omega / mode.omega - 1.0,
        found.eta1 / mode.eta1 - 1.0,
        found.eta2 / mode.eta2 - 1.0,
        found.tip_slope / mode.tip_slope - 1.0,
    ])
}

/// The paper's beam, a nearly buckled one, a heavy tip with a stiff spring, and the plain cantilever.
const BEAMS: [(f64, f64); 4] = [(1.3450051225722, 0.02), (-2.5, 0.0), (50.0, 5.0), (0.0, 0.0)];

#[test]
fn the_finite_element_beam_converges_to_the_modes() -> TestResult {
    for (c1, eta) in BEAMS {
        let exact = ModeSet::new(c1, eta, 4)?;
        for n in 0..4 {
            let found = errors(&exact, c1, eta, 32, n).ok_or("the mesh is not positive definite")?;
            for (error, what) in found.into_iter().zip(["omega", "eta1", "eta2", "slope"]) {
                // Theory of the element: the error of the frequency is (lambda h)^4 / 1440 for a long beam.
                let bound = (exact[n].wave_number / 32.0).powi(4) / 100.0 + 1e-8;
                assert!(error.abs() < bound, "{c1} {eta} mode {} {what}: {error:e} of {bound:e}", n + 1);
            }
        }
    }
    Ok(())
}

#[test]
fn its_frequencies_converge_from_above_with_the_fourth_power_of_the_element_length() -> TestResult {
    for (c1, eta) in BEAMS {
        let exact = ModeSet::new(c1, eta, 4)?;
        for n in 1..4 {
            let coarse = errors(&exact, c1, eta, 8, n).ok_or("the mesh is not positive definite")?[0];
            let fine = errors(&exact, c1, eta, 16, n).ok_or("the mesh is not positive definite")?[0];
            assert!(coarse > fine && fine > 0.0, "a conforming element is too stiff");
            let order = (coarse / fine).log2();
            assert!((order - 4.0).abs() < 0.25, "{c1} {eta} mode {}: order {order}", n + 1);
        }
    }
    Ok(())
}

#[test]
fn the_beam_buckles_in_both_where_the_tip_spring_reaches_minus_three() -> TestResult {
    // At c_1 = -3 the bending stiffness 3 of the tip is used up; the cubic is the exact static shape.
    let before = finite_element_modes(-2.999, 0.02, 4).ok_or("the mesh is not positive definite")?;
    let exact = ModeSet::new(-2.999, 0.02, 1)?;
    assert!((before[0].omega / exact[0].omega - 1.0).abs() < 1e-4);
    let after = finite_element_modes(-3.001, 0.02, 4).ok_or("the mesh is not positive definite")?;
    assert!(after.iter().any(|mode| mode.omega.is_nan()), "a negative square of a frequency");
    assert_eq!(ModeSet::new(-3.001, 0.02, 1), Err(ModelError::Buckled { c1: -3.001 }));
    Ok(())
}
