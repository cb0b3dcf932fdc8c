//! Periodic orbits as zeros in state and parameters together, and Newton's correction onto a branch of them within a
//! hyperplane: what pseudo-arclength continuation is made of.
//!
//! A place x holds the state in scaled components over the gap, then each parameter over the width of its range. The
//! derivative with respect to the state and to beta is exact; that with respect to another parameter is a difference
//! quotient, kept from place to place: it decides how fast a correction converges, not where to.

use nalgebra::{DMatrix, DVector};

use super::plane::Axis;
use crate::dynamics::orbits::newton::ROUNDING;
use crate::dynamics::orbits::{OrbitError, OrbitSolver, PeriodMap};
use crate::model::{Along, Parameter, ParameterSet, ReducedSystem};

/// Iterations of a correction.
const MAX_ITERATIONS: usize = 12;
/// Iterations after which the difference quotients are renewed.
const RENEWAL: usize = 4;
/// A correction below this is the last one.
const SETTLED: f64 = 1e-9;
/// Longest step of a difference quotient in a parameter, relative to the width of its range.
pub(super) const DIFFERENCE: f64 = 1e-6;
/// Smallest component of a unit vector along a parameter by which a difference quotient's step is scaled.
const STEEP: f64 = 0.1;
/// Prepared maps kept beside the present one.
const SPARE: usize = 3;

/// The orbits of a device while K of its numbers change.
pub(super) struct Family<const K: usize> {
    pub(super) system: ReducedSystem,
    pub(super) periods: usize,
    pub(super) solver: OrbitSolver,
    /// Step of difference quotients in a parameter, relative to the width of its range.
    pub(super) difference: f64,
    axes: [Axis; K],
    /// The numbers that do not change, and what follows those on the axes.
    origin: ParameterSet,
    along: Along,
    /// Units of the places' components.
    units: Vec<f64>,
    /// Systems that differ in more than beta, with their maps, the one used last at the end.
    spare: Vec<(ReducedSystem, OrbitSolver)>,
    /// Derivatives of the defect with respect to the parameters, (2N + 1) x K.
    columns: Option<DMatrix<f64>>,
    /// Effort of the solvers that are no longer kept.
    spent: u64,
}

impl<const K: usize> Family<K> {
    /// The orbits of `periods` excitation periods of the device `system` with its parameters on `axes`.
    pub(super) fn new(system: &ReducedSystem, axes: [Axis; K], periods: usize) -> Result<Self, OrbitError> {
        let (origin, along) = (*system.parameters, Along::default());
        let mut solver = OrbitSolver::new(system);
        let gap = solver.map().gap();
        let state = solver.map().scales().iter().map(|scale| scale * gap);
        let units = state.chain(axes.iter().map(Axis::width)).collect();
        let (difference, spare, columns, spent) = (DIFFERENCE, Vec::new(), None, 0);
        let system = system.clone();
        Ok(Self { system, periods, solver, difference, axes, origin, along, units, spare, columns, spent })
    }

    /// The same problem with what follows the frequency when that changes.
    pub(super) fn following(self, along: Along) -> Self {
        Self { along, ..self }
    }

    /// What was computed so far, as [`OrbitSolver::effort`].
    pub(super) fn effort(&self) -> u64 {
        self.spent + self.solver.effort() + self.spare.iter().map(|(_, solver)| solver.effort()).sum::<u64>()
    }

    /// Length 2N + 1 of the state.
    pub(super) fn dimension(&self) -> usize {
        self.units.len() - K
    }

    /// The place of `state` at the parameters `values`.
    pub(super) fn place(&self, state: &[f64], values: [f64; K]) -> DVector<f64> {
        let values = state.iter().chain(&values).zip(&self.units).map(|(value, unit)| value / unit);
        DVector::from_iterator(self.units.len(), values)
    }

    /// The state at a place, length 2N + 1.
    pub(super) fn state(&self, place: &DVector<f64>) -> Vec<f64> {
        place.iter().zip(&self.units).take(self.dimension()).map(|(value, unit)| value * unit).collect()
    }

    /// The parameters at a place.
    pub(super) fn values(&self, place: &DVector<f64>) -> [f64; K] {
        let n = self.dimension();
        std::array::from_fn(|k| place[n + k] * self.units[n + k])
    }

    /// Length of a difference of places without its parameters, in the components that the present map's scales make
    /// comparable, over the gap.
    pub(super) fn length(&mut self, difference: &DVector<f64>) -> f64 {
        let map = self.solver.map();
        let parts = difference.iter().zip(&self.units).zip(map.scales());
        parts.map(|((part, unit), scale)| (part * unit / scale).powi(2)).sum::<f64>().sqrt() / map.gap()
    }

    /// `place` with its parameter `k` replaced by `value`.
    pub(super) fn with_value(&self, mut place: DVector<f64>, k: usize, value: f64) -> DVector<f64> {
        let n = self.dimension();
        place[n + k] = value / self.units[n + k];
        place
    }

    pub(super) fn beta(&self) -> f64 {
        self.system.parameters.beta
    }

    /// Makes the system the one at the parameters `values`. Between systems visited lately it only switches, and
    /// finds their solvers as they were left.
    pub(super) fn set(&mut self, values: [f64; K]) -> Result<(), OrbitError> {
        let mut set = self.origin;
        for (axis, value) in self.axes.iter().zip(values) {
            set = self.along.at(&set, axis.parameter, axis.accepted(value));
        }
        let differs = |other: &ParameterSet| ParameterSet { beta: set.beta, ..*other } != set;
        if differs(&self.system.parameters) {
            let (system, solver) = match self.spare.iter().position(|(other, _)| !differs(&other.parameters))
            {
                Some(known) => self.spare.remove(known),
                None => {
                    let system = self.system.with_numbers(set)?;
                    let map = PeriodMap::with_level(&system, self.solver.map().level());
                    let solver = OrbitSolver::with_map(&system, map);
                    (system, solver)
                }
            };
            let left =
                (std::mem::replace(&mut self.system, system), std::mem::replace(&mut self.solver, solver));
            self.spare.push(left);
            if self.spare.len() > SPARE {
                self.spent += self.spare.remove(0).1.effort();
            }
        }
        if self.system.parameters.beta != set.beta {
            self.system = self.system.with_numbers(set)?;
        }
        Ok(())
    }

    /// The defect of periodicity at `place`, in units of the gap.
    pub(super) fn defect(&mut self, place: &DVector<f64>) -> Result<DVector<f64>, OrbitError> {
        let state = self.state(place);
        self.set(self.values(place))?;
        let beta = self.beta();
        self.solver.evaluate_at(&state, beta, self.periods)?;
        Ok(self.defect_there())
    }

    /// The same at the state that the solver evaluated last.
    pub(super) fn defect_there(&mut self) -> DVector<f64> {
        let gap = self.solver.map().gap();
        self.solver.defect() / gap
    }

    /// Whether the model accepts the parameters at `place`.
    fn accepts(&self, place: &DVector<f64>) -> bool {
        self.values(place).iter().zip(&self.axes).all(|(value, axis)| {
            let (minimum, maximum) = axis.parameter.range();
            (minimum..=maximum).contains(&axis.accepted(*value))
        })
    }

    /// Goes from `place` along a unit `vector` by the step of a difference quotient, and evaluates there on the same
    /// grid. Returns the step, which is taken backwards where the model ends ahead or the grid changes.
    ///
    /// A parameter that changes by as much as the vector at all does so by the same step every time, so that its map
    /// is prepared once.
    pub(super) fn step_along(
        &mut self,
        place: &DVector<f64>,
        vector: &DVector<f64>,
    ) -> Result<f64, OrbitError> {
        let n = self.dimension();
        let (mut steepest, mut slope) = (n, 0.0_f64);
        for k in n..n + K {
            if vector[k].abs() > slope.abs() && self.axes[k - n].parameter != Parameter::Beta {
                (steepest, slope) = (k, vector[k]);
            }
        }
        let steep = slope.abs() > STEEP;
        let length = if steep { self.difference / slope } else { self.difference };
        self.set(self.values(place))?;
        let steps = self.solver.map().steps_per_period();
        for step in [length, -length] {
            let mut moved = place + vector * step;
            if steep {
                moved[steepest] = place[steepest] + self.difference.copysign(step * slope);
            }
            if !self.accepts(&moved) {
                continue;
            }
            self.set(self.values(&moved))?;
            if self.solver.map().steps_per_period() == steps {
                let (state, beta) = (self.state(&moved), self.beta());
                self.solver.evaluate_unrefined(&state, beta, self.periods)?;
                return Ok(step);
            }
        }
        Err(OrbitError::Singular)
    }

    /// Renews the derivatives with respect to the parameters at `place`, where the solver is and has this `defect`.
    fn renew(&mut self, place: &DVector<f64>, defect: &DVector<f64>) -> Result<(), OrbitError> {
        let n = self.dimension();
        let mut columns = DMatrix::zeros(n, K);
        for k in 0..K {
            if self.axes[k].parameter != Parameter::Beta {
                let mut along = DVector::zeros(n + K);
                along[n + k] = 1.0;
                let step = self.step_along(place, &along)?;
                let there = self.solver.defect() / self.solver.map().gap();
                columns.set_column(k, &((there - defect) / step));
            }
        }
        self.columns = Some(columns);
        self.set(self.values(place))
    }

    /// Defect at `place` and its derivative, (2N + 1) x (2N + 1 + K), with new difference quotients where `renewed`.
    /// The solver is left at the place.
    pub(super) fn linearised(
        &mut self,
        place: &DVector<f64>,
        renewed: bool,
    ) -> Result<(DVector<f64>, DMatrix<f64>), OrbitError> {
        let defect = self.defect(place)?;
        let derivative = self.derivative(place, &defect, renewed)?;
        Ok((defect, derivative))
    }

    /// The derivative alone, where the solver is at `place` already and has this `defect`.
    pub(super) fn derivative(
        &mut self,
        place: &DVector<f64>,
        defect: &DVector<f64>,
        renewed: bool,
    ) -> Result<DMatrix<f64>, OrbitError> {
        let n = self.dimension();
        if renewed || self.columns.is_none() {
            self.renew(place, defect)?;
        }
        let gap = self.solver.map().gap();
        let mut derivative = DMatrix::zeros(n, n + K);
        // The solver's scales follow the system; the places keep the first one's.
        let scales: Vec<f64> = self.solver.map().scales().to_vec();
        let matrix = self.solver.newton_matrix();
        for (j, (unit, scale)) in self.units.iter().zip(&scales).enumerate() {
            derivative.set_column(j, &(matrix.column(j) * (-unit / (scale * gap))));
        }
        for (k, axis) in self.axes.iter().enumerate() {
            if axis.parameter == Parameter::Beta {
                let slope = self.solver.beta_derivative() * (self.units[n + k] / gap);
                derivative.set_column(n + k, &slope);
            } else if let Some(columns) = &self.columns {
                derivative.set_column(n + k, &columns.column(k));
            }
        }
        Ok(derivative)
    }
}

impl Family<1> {
    /// The parameter at a place.
    pub(super) fn value(&self, place: &DVector<f64>) -> f64 {
        self.values(place)[0]
    }

    /// The point of the branch in the hyperplane through `guess` with the `normal`; the solver is left there.
    pub(super) fn correct(
        &mut self,
        guess: &DVector<f64>,
        normal: &DVector<f64>,
    ) -> Result<DVector<f64>, OrbitError> {
        let corrected = self.corrected(guess, normal);
        if corrected.is_err() {
            // A correction that went astray may have renewed them far away.
            self.columns = None;
        }
        corrected
    }

    fn corrected(&mut self, guess: &DVector<f64>, normal: &DVector<f64>) -> Result<DVector<f64>, OrbitError> {
        let mut place = guess.clone();
        let mut residual = f64::INFINITY;
        for iteration in 1..=MAX_ITERATIONS {
            let (defect, derivative) = self.linearised(&place, iteration % RENEWAL == 0)?;
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

    /// Unit tangent of the branch at `place`, on the side of `like`, and the sign of the determinant of the defect's derivative
    /// bordered by it. Along a branch that sign stays, through folds as well: it changes where branches
    /// cross, and between neighbouring pieces of one, or of two, that run side by side in opposite senses.
    pub(super) fn tangent(
        &mut self,
        place: &DVector<f64>,
        like: &DVector<f64>,
    ) -> Result<(DVector<f64>, f64), OrbitError> {
        let (_, derivative) = self.linearised(place, true)?;
        let mut right = DVector::zeros(place.len());
        right[place.len() - 1] = 1.0;
        let decomposed = bordered(&derivative, like).lu();
        let tangent = decomposed.solve(&right).ok_or(OrbitError::Singular)?;
        let length = tangent.norm();
        if !(length.is_finite() && length > 0.0) {
            return Err(OrbitError::Singular);
        }
        Ok((tangent / length, decomposed.determinant().signum()))
    }
}

/// The derivative with the normal as its last row.
fn bordered(derivative: &DMatrix<f64>, normal: &DVector<f64>) -> DMatrix<f64> {
    let n = normal.len();
    DMatrix::from_fn(n, n, |i, j| if i + 1 < n { derivative[(i, j)] } else { normal[j] })
}
