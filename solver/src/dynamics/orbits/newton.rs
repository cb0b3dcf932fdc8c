//! Newton's iteration for fixed points of the stroboscopic map, on a grid that it refines as needed.
//!
//! Its linear system, and what else follows from the derivative of the map, is scaled. Without a load the row of the
//! voltage, which is then linearly dependent, makes room for that of the charge.

use nalgebra::{Complex, DMatrix, DVector};

use super::floquet::multipliers;
use super::orbit_error::OrbitError;
use super::period_map::{PeriodMap, StepDerivative};
use crate::dynamics::integration::{IntegrationError, Step};
use crate::model::ReducedSystem;

/// Iterations before the search is given up.
const MAX_ITERATIONS: usize = 40;
/// A correction below this fraction of the gap is the last one: the next would be its square.
const SETTLED: f64 = 1e-10;
/// A defect below this is rounding, whatever correction a nearly singular matrix makes of it.
pub(in crate::dynamics) const ROUNDING: f64 = 1e-14;
/// Close to a fold corrections shrink no further than the rounding of the defect allows: iterations from which, and defect
/// and correction below which, the orbit counts as found. Its state is then good to that correction only.
const STALLED: (usize, f64, f64) = (12, 1e-11, 1e-6);
/// The same for warm starts, which converge faster: the defect below which, and the ratio to the correction before above
/// which, a correction no longer shrinks because the defect is rounding. With hardly any load the state's charge, which
/// then hardly matters to anything else, is known no better.
const WARM_STALLED: (f64, f64) = (1e-13, 0.1);
/// How often a step that does not reduce the defect is halved.
const MAX_HALVINGS: usize = 8;
/// How often the grid is doubled for a guess that it cannot follow at all.
const RESCUES: usize = 3;
/// Reduction of the defect by a correction with which the derivative is kept for the next one: a map without its derivative
/// takes a third of the time.
const CHORD: f64 = 0.1;
/// Iterations within which a warm start must converge, without damping.
const MAX_WARM_ITERATIONS: usize = 6;

/// What an iteration ended with.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Convergence {
    /// Evaluations of the map.
    pub iterations: usize,
    /// Largest component of the last evaluated defect of periodicity, as a displacement over the gap s0.
    pub residual: f64,
}

/// Periodic orbits of one structure at one frequency, for any beta.
#[derive(Debug, Clone)]
pub struct OrbitSolver {
    map: PeriodMap,
    /// theta_n, without a load only: then the charge c v - sum theta_n q_n is conserved and every orbit belongs to
    /// a family; the one without charge is taken.
    charge: Option<(f64, Vec<f64>)>,
    state: Vec<f64>,
    /// Derivative of the map at the state of the last evaluation, scaled.
    matrix: DMatrix<f64>,
    residual: f64,
    /// Estimated error of what was observed last, in units of what is allowed.
    error: f64,
    effort: u64,
}

impl OrbitSolver {
    /// Prepares the map of `system`.
    pub fn new(system: &ReducedSystem) -> Self {
        Self::with_map(system, PeriodMap::new(system))
    }

    /// A solver of `system` with its `map`.
    pub(in crate::dynamics) fn with_map(system: &ReducedSystem, map: PeriodMap) -> Self {
        let n = map.dimension();
        let open = system.parameters.kappa == 0.0;
        Self {
            map,
            charge: open.then(|| (system.capacitance, system.theta.clone())),
            state: vec![0.0; n],
            matrix: DMatrix::zeros(n, n),
            residual: f64::INFINITY,
            error: f64::INFINITY,
            effort: 0,
        }
    }

    /// What was computed so far: steps with their derivatives, each counted N + 1 times, as it takes about that much longer.
    /// It bounds time in the same way on every machine: a million takes some second.
    pub fn effort(&self) -> u64 {
        self.effort
    }

    fn count(&mut self, periods: usize) {
        let n = self.state.len();
        self.effort += (self.map.steps_per_period() * periods * n.div_ceil(2)) as u64;
    }

    /// The map, for what only it knows.
    pub fn map(&mut self) -> &mut PeriodMap {
        &mut self.map
    }

    /// Derivative of the map at the state evaluated last, scaled, (2N + 1) x (2N + 1).
    pub(in crate::dynamics) fn monodromy(&self) -> &DMatrix<f64> {
        &self.matrix
    }

    /// Whether the grid was fine enough for what [`Self::evaluate_observed`] evaluated last.
    pub(in crate::dynamics) fn was_resolved(&self) -> bool {
        self.error <= 1.0
    }

    /// State of the orbit found last at t = 0, length 2N + 1.
    pub fn state(&self) -> &[f64] {
        &self.state
    }

    /// Finds an orbit of `periods` excitation periods at amplitude `beta` near `guess` (length 2N + 1); its state
    /// and derivative stay in the solver. Steps that do not reduce the defect are shortened, and a derivative serves for as
    /// long as the defect shrinks fast.
    ///
    /// # Errors
    /// Those of [`PeriodMap::apply`] when already the guess cannot be followed, [`OrbitError::Singular`],
    /// [`OrbitError::NoConvergence`].
    pub fn find(&mut self, guess: &[f64], beta: f64, periods: usize) -> Result<Convergence, OrbitError> {
        self.begin(guess)?;
        let mut iterations = 1;
        let mut error = self.evaluate_rescued(beta, periods)?;
        while !self.iterate(error, beta, periods, &mut iterations)? {
            error = self.evaluate(beta, periods)?;
            iterations += 1;
        }
        Ok(Convergence { iterations, residual: self.residual })
    }

    /// As [`Self::find`], but what stays in the solver is the state alone: the derivative may be that of an earlier one.
    ///
    /// # Errors
    /// As [`Self::find`].
    pub(in crate::dynamics) fn find_state(
        &mut self,
        guess: &[f64],
        beta: f64,
        periods: usize,
    ) -> Result<Convergence, OrbitError> {
        self.begin(guess)?;
        let mut iterations = 1;
        let error = self.evaluate_rescued(beta, periods)?;
        self.iterate(error, beta, periods, &mut iterations)?;
        Ok(Convergence { iterations, residual: self.residual })
    }

    /// Newton's iteration from where map and derivative were evaluated last, with that `error`, until a correction is the last
    /// one, which is then made. Returns whether the derivative is that of the iteration's last state.
    fn iterate(
        &mut self,
        mut error: f64,
        beta: f64,
        periods: usize,
        iterations: &mut usize,
    ) -> Result<bool, OrbitError> {
        // Whether the derivative is that at the present state.
        let mut fresh = true;
        loop {
            if error > 1.0 && self.residual < 1e-3 {
                self.map.refine()?;
                (error, fresh) = (self.evaluate_rescued(beta, periods)?, true);
                *iterations += 1;
                continue;
            }
            let correction = self.correction()?;
            if self.residual <= ROUNDING && error <= 1.0 && self.largest(&correction) > STALLED.2 {
                return Ok(fresh);
            }
            let stalled = *iterations >= STALLED.0
                && self.residual <= STALLED.1
                && self.largest(&correction) <= STALLED.2;
            if (self.largest(&correction) <= SETTLED || stalled) && error <= 1.0 {
                self.add(&correction, 1.0);
                return Ok(fresh);
            }
            let before = self.residual;
            let start = self.state.clone();
            let mut factor = 1.0;
            for halvings in 0..=MAX_HALVINGS {
                if *iterations >= MAX_ITERATIONS || halvings == MAX_HALVINGS {
                    return Err(OrbitError::NoConvergence { iterations: *iterations, residual: before });
                }
                self.state.copy_from_slice(&start);
                self.add(&correction, factor);
                *iterations += 1;
                match self.evaluate_image(beta, periods) {
                    // At the level of rounding the defect need not fall any more.
                    Ok(new) if self.residual < before || self.residual < SETTLED => {
                        error = new;
                        break;
                    }
                    // Not the direction's fault, perhaps, but that of a derivative from elsewhere.
                    _ if !fresh => {
                        self.state.copy_from_slice(&start);
                        break;
                    }
                    _ => factor *= 0.5,
                }
            }
            let chord = factor == 1.0 && self.residual <= CHORD * before;
            fresh = !chord;
            if fresh {
                error = self.evaluate(beta, periods)?;
            }
        }
    }

    /// As [`Self::find`] from a guess that is known to be good, for curves of orbits: no damping, few iterations.
    ///
    /// # Errors
    /// As [`Self::find`]; the solver's state is then meaningless.
    pub fn follow(&mut self, guess: &[f64], beta: f64, periods: usize) -> Result<Convergence, OrbitError> {
        self.approach(guess, beta, periods, false)
    }

    /// As [`Self::follow`], but what stays in the solver is the state alone: a derivative serves for as long as corrections shrink
    /// fast.
    ///
    /// # Errors
    /// As [`Self::follow`].
    pub(in crate::dynamics) fn follow_state(
        &mut self,
        guess: &[f64],
        beta: f64,
        periods: usize,
    ) -> Result<Convergence, OrbitError> {
        self.approach(guess, beta, periods, true)
    }

    /// Undamped corrections from a good guess; with `chords`, a derivative serves for as long as they shrink fast.
    fn approach(
        &mut self,
        guess: &[f64],
        beta: f64,
        periods: usize,
        chords: bool,
    ) -> Result<Convergence, OrbitError> {
        self.begin(guess)?;
        let (mut iterations, mut derivatives) = (0, 0);
        let mut sizes = [f64::INFINITY; 2];
        while derivatives < MAX_WARM_ITERATIONS {
            iterations += 1;
            // The first correction says nothing yet about how fast they shrink.
            let [before, size] = sizes;
            let shrinks = iterations == 2 || size <= CHORD * before && before.is_finite();
            let chord = chords && shrinks;
            let error = if chord {
                self.evaluate_image(beta, periods)?
            } else {
                derivatives += 1;
                self.evaluate(beta, periods)?
            };
            if error > 1.0 {
                self.map.refine()?;
                (iterations, derivatives, sizes) = (0, 0, [f64::INFINITY; 2]);
                continue;
            }
            let correction = self.correction()?;
            self.add(&correction, 1.0);
            let size = self.largest(&correction);
            let stalled =
                self.residual <= WARM_STALLED.0 && size <= STALLED.2 && size > WARM_STALLED.1 * sizes[1];
            if size <= SETTLED || stalled {
                return Ok(Convergence { iterations, residual: self.residual });
            }
            sizes = [sizes[1], size];
        }
        Err(OrbitError::NoConvergence { iterations, residual: self.residual })
    }

    fn begin(&mut self, guess: &[f64]) -> Result<(), OrbitError> {
        if guess.len() != self.state.len() {
            let (expected, got) = (self.state.len(), format!("{} numbers", guess.len()));
            return Err(IntegrationError::InitialState { expected, got }.into());
        }
        self.state.copy_from_slice(guess);
        Ok(())
    }

    /// Evaluates at a state that should be followed; a grid too coarse for that is refined.
    fn evaluate_rescued(&mut self, beta: f64, periods: usize) -> Result<f64, OrbitError> {
        for _ in 0..RESCUES {
            match self.evaluate(beta, periods) {
                Err(
                    OrbitError::Escaped { .. } | OrbitError::Contact { .. } | OrbitError::Unresolved { .. },
                ) => {
                    self.map.refine()?;
                }
                other => return other,
            }
        }
        self.evaluate(beta, periods)
    }

    /// Map and derivative at `state`, on a grid fine enough for both.
    ///
    /// # Errors
    /// As [`PeriodMap::apply`] and [`PeriodMap::refine`].
    pub(in crate::dynamics) fn evaluate_at(
        &mut self,
        state: &[f64],
        beta: f64,
        periods: usize,
    ) -> Result<(), OrbitError> {
        self.begin(state)?;
        while self.evaluate(beta, periods)? > 1.0 {
            self.map.refine()?;
        }
        Ok(())
    }

    /// The same on the present grid, be it fine enough or not: for differences, in which its errors cancel.
    pub(in crate::dynamics) fn evaluate_unrefined(
        &mut self,
        state: &[f64],
        beta: f64,
        periods: usize,
    ) -> Result<(), OrbitError> {
        self.begin(state)?;
        self.evaluate(beta, periods).map(|_| ())
    }

    /// Map and derivative at the present state; returns the estimated error in units of what is allowed.
    fn evaluate(&mut self, beta: f64, periods: usize) -> Result<f64, OrbitError> {
        self.count(periods);
        let error = self.map.apply(&self.state, beta, periods, |_, _| ())?;
        self.take();
        Ok(error)
    }

    /// The map alone at the present state, the derivative staying that of an earlier one; returns the estimated error.
    fn evaluate_image(&mut self, beta: f64, periods: usize) -> Result<f64, OrbitError> {
        self.effort += (self.map.steps_per_period() * periods) as u64;
        let error = self.map.carry(&self.state, beta, periods)?;
        self.take_residual();
        Ok(error)
    }

    /// Evaluates the map at the state found last, each step shown to `observer`, and returns its residual. The
    /// multipliers are then those over `periods`.
    pub(in crate::dynamics) fn evaluate_observed(
        &mut self,
        beta: f64,
        periods: usize,
        observer: impl FnMut(&Step<'_>, &StepDerivative<'_>),
    ) -> Result<f64, OrbitError> {
        self.count(periods);
        self.error = self.map.apply(&self.state, beta, periods, observer)?;
        self.take();
        Ok(self.residual)
    }

    /// As [`Self::evaluate_observed`] at `state`; returns the estimated error in units of what is allowed.
    pub(in crate::dynamics) fn evaluate_observed_at(
        &mut self,
        state: &[f64],
        beta: f64,
        periods: usize,
        observer: impl FnMut(&Step<'_>, &StepDerivative<'_>),
    ) -> Result<f64, OrbitError> {
        self.begin(state)?;
        let error = self.map.apply(&self.state, beta, periods, observer)?;
        self.take();
        Ok(error)
    }

    /// Takes derivative and defect over from the map.
    fn take(&mut self) {
        let n = self.state.len();
        let scales = self.map.scales();
        for j in 0..n {
            for i in 0..n {
                self.matrix[(i, j)] = self.map.derivative(i, j) * (scales[j] / scales[i]);
            }
        }
        self.take_residual();
    }

    /// Takes the defect over from the map.
    fn take_residual(&mut self) {
        let (n, scales) = (self.state.len(), self.map.scales());
        let image = self.map.image();
        let defect = |i: usize| ((image[i] - self.state[i]) / scales[i]).abs();
        self.residual = (0..n).map(defect).fold(0.0, f64::max) / self.map.gap();
    }

    /// Multipliers of the orbit found last, without that of the conserved charge when there is no load.
    ///
    /// # Errors
    /// [`OrbitError::Multipliers`].
    pub fn multipliers(&self) -> Result<Vec<Complex<f64>>, OrbitError> {
        let Some((c, theta)) = &self.charge else { return multipliers(&self.matrix) };
        // Among the states without charge, where the voltage follows from the displacements.
        let last = self.state.len() - 1;
        let voltage = |j: usize| theta.get(j).map_or(0.0, |theta| theta / (c * self.map.scales()[last]));
        let entry = |i, j| self.matrix[(i, j)] + self.matrix[(i, last)] * voltage(j);
        multipliers(&DMatrix::from_fn(last, last, entry))
    }

    /// d(state)/d(beta) along the orbits through the one found last, length 2N + 1.
    ///
    /// # Errors
    /// [`OrbitError::Singular`] at a fold.
    pub fn beta_slope(&self) -> Result<Vec<f64>, OrbitError> {
        let mut slope = self.solved(self.beta_derivative())?;
        slope.iter_mut().zip(self.map.scales()).for_each(|(value, scale)| *value *= scale);
        Ok(slope.as_slice().to_vec())
    }

    /// Newton's correction of the state, scaled.
    fn correction(&self) -> Result<DVector<f64>, OrbitError> {
        self.solved(self.defect())
    }

    /// Image minus state, scaled; without a load the last entry asks for no charge.
    pub(in crate::dynamics) fn defect(&self) -> DVector<f64> {
        let (image, scales) = (self.map.image(), self.map.scales());
        let mut defect = DVector::from_fn(self.state.len(), |i, _| (image[i] - self.state[i]) / scales[i]);
        if let Some((c, theta)) = &self.charge {
            let last = defect.len() - 1;
            let charge: f64 = theta.iter().zip(&self.state).map(|(theta, q)| theta * q).sum();
            defect[last] = (charge / c - self.state[last]) / scales[last];
        }
        defect
    }

    /// Minus the derivative of [`Self::defect`], 1 - M, scaled. Without a load the last row, which is then linearly
    /// dependent, makes room for that of the charge.
    pub(in crate::dynamics) fn newton_matrix(&self) -> DMatrix<f64> {
        let n = self.state.len();
        let mut matrix = DMatrix::from_fn(n, n, |i, j| f64::from(u8::from(i == j)) - self.matrix[(i, j)]);
        if let Some((c, theta)) = &self.charge {
            let scale = self.map.scales()[n - 1];
            for j in 0..n - 1 {
                matrix[(n - 1, j)] = -theta.get(j).map_or(0.0, |theta| theta / (c * scale));
            }
            matrix[(n - 1, n - 1)] = 1.0;
        }
        matrix
    }

    /// Derivative of [`Self::defect`] with respect to beta, scaled.
    pub(in crate::dynamics) fn beta_derivative(&self) -> DVector<f64> {
        let n = self.state.len();
        let scales = self.map.scales();
        let mut derivative = DVector::from_fn(n, |i, _| self.map.derivative(i, n) / scales[i]);
        if self.charge.is_some() {
            derivative[n - 1] = 0.0;
        }
        derivative
    }

    /// (1 - M)^-1 `right`, scaled, for a right-hand side that holds no charge.
    pub(in crate::dynamics) fn response(&self, mut right: DVector<f64>) -> Result<DVector<f64>, OrbitError> {
        if self.charge.is_some() {
            let last = right.len() - 1;
            right[last] = 0.0;
        }
        self.solved(right)
    }

    fn solved(&self, mut right: DVector<f64>) -> Result<DVector<f64>, OrbitError> {
        let solvable = self.newton_matrix().lu().solve_mut(&mut right);
        let finite = solvable && right.iter().all(|value| value.is_finite());
        finite.then_some(right).ok_or(OrbitError::Singular)
    }

    fn largest(&self, correction: &DVector<f64>) -> f64 {
        correction.amax() / self.map.gap()
    }

    fn add(&mut self, correction: &DVector<f64>, factor: f64) {
        let steps = correction.iter().zip(self.map.scales());
        for (value, (step, scale)) in self.state.iter_mut().zip(steps) {
            *value += factor * step * scale;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dynamics::orbits::period_map::distance;
    use crate::model::{ForceLaw, ParameterSet, Parameters};

    #[test]
    fn a_state_found_with_old_derivatives_is_that_of_newtons_iteration() {
        for (modes, law) in [(1, ForceLaw::Quadratic), (2, ForceLaw::Exact), (4, ForceLaw::Quadratic)] {
            for (omega, periods) in [(25.0, 1), (8.0969, 2)] {
                let set = ParameterSet { alpha: 1e-4, beta: 2.5e-3, omega, ..Default::default() };
                let system =
                    Parameters::new(set).and_then(|p| ReducedSystem::new(p, modes, law)).expect("a device");
                let mut solver = OrbitSolver::new(&system);
                let mut guess = vec![0.0; system.dimension()];
                guess[0] = 0.02;
                solver.find(&guess, set.beta, periods).expect("an orbit");
                let found = solver.state().to_vec();
                let same = |other: &OrbitSolver| {
                    distance(other.state(), &found, other.map.scales()) <= 10.0 * SETTLED * other.map.gap()
                };
                let mut other = OrbitSolver::new(&system);
                other.find_state(&guess, set.beta, periods).expect("as before");
                assert!(same(&other), "{modes} modes, {law:?}, omega = {omega}");
                // From near, as from an orbit of a similar system.
                let near: Vec<f64> = found.iter().map(|value| 1.001 * value).collect();
                other.follow_state(&near, set.beta, periods).expect("a good guess");
                assert!(same(&other), "{modes} modes, {law:?}, omega = {omega}");
            }
        }
    }
}
