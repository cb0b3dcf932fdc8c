//! Points of a branch of periodic orbits as zeros in state and parameter together, and Newton's correction onto the
//! branch within a hyperplane: what pseudo-arclength continuation is made of.
//!
//! A place x holds the state in scaled components over the gap, then the parameter over the width of its range.

use nalgebra::{DMatrix, DVector};

use super::OrbitError;
use super::newton::OrbitSolver;
use super::period_map::PeriodMap;
use crate::model::{Parameter, ParameterSet, Parameters, ReducedSystem, RestForce};

/// Iterations of a correction.
const MAX_ITERATIONS: usize = 8;
/// A correction below this is the last one.
const SETTLED: f64 = 1e-9;
/// A defect below this is rounding, whatever correction a nearly singular matrix makes of it.
const ROUNDING: f64 = 1e-14;
/// Step of the difference quotient in the parameter, relative to the width of its range.
const DIFFERENCE: f64 = 1e-6;

/// A force law behind a pointer: the law of a branch changes with its parameter.
pub(super) struct Law(Box<dyn RestForce>);

impl RestForce for Law {
    fn rest(&self, s: f64) -> f64 {
        self.0.rest(s)
    }

    fn slope(&self, s: f64) -> f64 {
        self.0.slope(s)
    }

    fn potential(&self, s: f64) -> f64 {
        self.0.potential(s)
    }

    fn contact(&self) -> Option<f64> {
        self.0.contact()
    }
}

/// The orbits of a device while one of its numbers changes.
pub(super) struct Family {
    pub(super) system: ReducedSystem,
    pub(super) parameter: Parameter,
    pub(super) periods: usize,
    pub(super) solver: OrbitSolver<Law>,
    /// Units of the places' components.
    units: Vec<f64>,
}

impl Family {
    /// The orbits of `periods` excitation periods of the device `system` with its `parameter` within `range`.
    pub(super) fn new(
        system: &ReducedSystem,
        parameter: Parameter,
        range: (f64, f64),
        periods: usize,
    ) -> Result<Self, OrbitError> {
        let mut solver = OrbitSolver::new(system, Law(system.rest_force()))?;
        let gap = solver.map().gap();
        let units =
            solver.map().scales().iter().map(|scale| scale * gap).chain([range.1 - range.0]).collect();
        Ok(Self { system: system.clone(), parameter, periods, solver, units })
    }

    /// The place of `state` at the parameter `value`.
    pub(super) fn place(&self, state: &[f64], value: f64) -> DVector<f64> {
        let values = state.iter().chain([&value]).zip(&self.units).map(|(value, unit)| value / unit);
        DVector::from_iterator(self.units.len(), values)
    }

    /// The state at a place, length 2N + 1.
    pub(super) fn state(&self, place: &DVector<f64>) -> Vec<f64> {
        let n = place.len() - 1;
        place.iter().zip(&self.units).take(n).map(|(value, unit)| value * unit).collect()
    }

    /// The parameter at a place.
    pub(super) fn value(&self, place: &DVector<f64>) -> f64 {
        let n = place.len() - 1;
        place[n] * self.units[n]
    }

    /// `place` with its parameter replaced by `value`.
    pub(super) fn with_value(&self, mut place: DVector<f64>, value: f64) -> DVector<f64> {
        let n = place.len() - 1;
        place[n] = value / self.units[n];
        place
    }

    pub(super) fn beta(&self) -> f64 {
        self.system.parameters.beta
    }

    /// Makes the system the one at the parameter `value`.
    fn set(&mut self, value: f64) -> Result<(), OrbitError> {
        // A border of the accepted range is met up to rounding.
        let (minimum, maximum) = self.parameter.range();
        let border = value.clamp(minimum, maximum);
        let value = if (value - border).abs() <= 1e-12 * (maximum - minimum) { border } else { value };
        if value == self.parameter.get(&self.system.parameters) {
            return Ok(());
        }
        let mut set: ParameterSet = *self.system.parameters;
        *self.parameter.get_mut(&mut set) = value;
        match self.parameter {
            Parameter::Beta => self.system = self.system.with_excitation(value, set.omega)?,
            Parameter::Omega => {
                self.system = self.system.with_excitation(set.beta, value)?;
                self.solver.retune(&self.system)?;
            }
            _ => {
                let modes = self.system.modes.len();
                self.system = ReducedSystem::new(Parameters::new(set)?, modes, self.system.law)?;
                let (law, level) = (Law(self.system.rest_force()), self.solver.map().level());
                let map = PeriodMap::with_level(&self.system, law, level)?;
                self.solver = OrbitSolver::with_map(&self.system, map);
            }
        }
        Ok(())
    }

    /// The defect of periodicity at `place`, in units of the gap.
    fn defect(&mut self, place: &DVector<f64>) -> Result<DVector<f64>, OrbitError> {
        let state = self.state(place);
        self.set(self.value(place))?;
        let beta = self.beta();
        self.solver.evaluate_at(&state, beta, self.periods)?;
        let gap = self.solver.map().gap();
        Ok(self.solver.defect() / gap)
    }

    /// Defect at `place` and its derivative, (2N + 1) x (2N + 2). The solver is left at the place.
    fn linearised(&mut self, place: &DVector<f64>) -> Result<(DVector<f64>, DMatrix<f64>), OrbitError> {
        let n = place.len() - 1;
        let slope = if self.parameter == Parameter::Beta {
            None
        } else {
            // One-sided at the ends of the accepted range.
            let (minimum, maximum) = self.parameter.range();
            let (mut low, mut high) = (place.clone(), place.clone());
            low[n] = (place[n] - DIFFERENCE).max(minimum / self.units[n]);
            high[n] = (place[n] + DIFFERENCE).min(maximum / self.units[n]);
            Some((self.defect(&high)? - self.defect(&low)?) / (high[n] - low[n]))
        };
        let defect = self.defect(place)?;
        let gap = self.solver.map().gap();
        let slope = slope.unwrap_or_else(|| self.solver.beta_derivative() * (self.units[n] / gap));
        // The solver's scales follow the system; the places keep the first one's.
        let scales: Vec<f64> = self.solver.map().scales().to_vec();
        let matrix = self.solver.newton_matrix();
        let derivative = DMatrix::from_fn(n, n + 1, |i, j| {
            if j == n { slope[i] } else { -matrix[(i, j)] * self.units[j] / (scales[j] * gap) }
        });
        Ok((defect, derivative))
    }

    /// The point of the branch in the hyperplane through `guess` with the `normal`; the solver is left there.
    pub(super) fn correct(
        &mut self,
        guess: &DVector<f64>,
        normal: &DVector<f64>,
    ) -> Result<DVector<f64>, OrbitError> {
        let mut place = guess.clone();
        let mut residual = f64::INFINITY;
        for _ in 0..MAX_ITERATIONS {
            let (defect, derivative) = self.linearised(&place)?;
            residual = defect.amax();
            let off = normal.dot(&(&place - guess));
            if residual <= ROUNDING && off.abs() <= ROUNDING {
                return Ok(place);
            }
            let right = defect.push(off);
            let correction = bordered(&derivative, normal).lu().solve(&right).ok_or(OrbitError::Singular)?;
            if !correction.iter().all(|value| value.is_finite()) {
                return Err(OrbitError::Singular);
            }
            place -= &correction;
            if correction.amax() <= SETTLED {
                return Ok(place);
            }
        }
        Err(OrbitError::NoConvergence { iterations: MAX_ITERATIONS, residual })
    }

    /// Unit tangent of the branch at `place`, on the side of `like`.
    pub(super) fn tangent(
        &mut self,
        place: &DVector<f64>,
        like: &DVector<f64>,
    ) -> Result<DVector<f64>, OrbitError> {
        let (_, derivative) = self.linearised(place)?;
        let mut right = DVector::zeros(place.len());
        right[place.len() - 1] = 1.0;
        let tangent = bordered(&derivative, like).lu().solve(&right).ok_or(OrbitError::Singular)?;
        let length = tangent.norm();
        if length.is_finite() && length > 0.0 { Ok(tangent / length) } else { Err(OrbitError::Singular) }
    }
}

/// The derivative with the normal as its last row.
fn bordered(derivative: &DMatrix<f64>, normal: &DVector<f64>) -> DMatrix<f64> {
    let n = normal.len();
    DMatrix::from_fn(n, n, |i, j| if i + 1 < n { derivative[(i, j)] } else { normal[j] })
}
