//! The linear harvester as its load sees it: a current source with an admittance, and the load that takes most from it.

use nalgebra::{Complex, DVector};

use super::{DynamicStiffness, TheoryError};
use crate::model::{ParameterSet, ReducedSystem};

/// The Norton equivalent of the linear system at its electrodes, capacitance included and load left out: with the load
/// conductance kappa the voltage has the complex amplitude I / (kappa + Y).
///
/// With M_0 the dynamic stiffness without the circuit, F the modal forces and theta the modal couplings, Eqs. (31),
/// (32), with c the system's capacitance, give I = s theta^T M_0^-1 F and Y = s (c + theta^T M_0^-1 theta) at s = i omega.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Source {
    /// I (dimensionless current) under the system's own excitation.
    pub current: Complex<f64>,
    /// Y (dimensionless, per volt squared).
    pub admittance: Complex<f64>,
}

impl Source {
    /// That of `system`, its magnet's rest force R(s) left out, under its own excitation.
    ///
    /// # Errors
    /// [`TheoryError::Undamped`] when there is no damping and omega is exactly a frequency of the beam alone.
    pub fn new(system: &ReducedSystem) -> Result<Self, TheoryError> {
        let p = &system.parameters;
        let undamped = TheoryError::Undamped { omega: p.omega };
        let set = ParameterSet { theta: 0.0, ..**p };
        let beam = system.with_numbers(set).map_err(|_| undamped.clone())?;
        let s = Complex::new(0.0, p.omega);
        let stiffness = DynamicStiffness::new(&beam).matrix(s).lu();
        let theta =
            DVector::from_iterator(system.theta.len(), system.theta.iter().map(|x| Complex::from(*x)));
        let force = p.omega * p.omega * p.beta;
        let forces =
            DVector::from_iterator(theta.len(), system.modes.iter().map(|m| Complex::from(force * m.eta1)));
        let (Some(moved), Some(answer)) = (stiffness.solve(&forces), stiffness.solve(&theta)) else {
            return Err(undamped);
        };
        let source = Self {
            current: s * theta.dot(&moved),
            admittance: s * (Complex::from(system.capacitance) + theta.dot(&answer)),
        };
        if source.current.is_finite() && source.admittance.is_finite() { Ok(source) } else { Err(undamped) }
    }

    /// Mean power (dimensionless) in the load conductance `kappa` beside a `leakage`.
    pub fn power(&self, kappa: f64, leakage: f64) -> f64 {
        let total = self.admittance + kappa + leakage;
        0.5 * kappa * self.current.norm_sqr() / total.norm_sqr()
    }

    /// The load conductance that takes most beside a `leakage`: |Y + leakage|, where kappa / |kappa + Y + leakage|^2
    /// is highest.
    pub fn best_load(&self, leakage: f64) -> f64 {
        (self.admittance + leakage).norm()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::{ForceLaw, Parameters};
    use crate::theory::LinearResponse;

    fn system(kappa: f64, omega: f64) -> ReducedSystem {
        let set = ParameterSet { c0: 0.0, kappa, omega, ..Default::default() };
        let parameters = Parameters::new(set).expect("in range");
        ReducedSystem::new(parameters, 3, ForceLaw::Quadratic).expect("a device")
    }

    #[test]
    fn the_power_of_the_source_is_that_of_the_linear_response() {
        for omega in [3.3, 3.6, 8.1, 25.0] {
            let source = Source::new(&system(1e-6, omega)).expect("damped");
            let mut highest = (0.0, 0.0);
            for i in 0..=1200 {
                let kappa = 1e-9 * 1e6_f64.powf(f64::from(i) / 1200.0);
                let response = LinearResponse::new(&system(kappa, omega)).expect("damped");
                let power = 0.5 * kappa * response.voltage.norm_sqr();
                assert!((source.power(kappa, 0.0) / power - 1.0).abs() < 1e-9, "{omega} {kappa}");
                highest = if power > highest.1 { (kappa, power) } else { highest };
            }
            let best = source.best_load(0.0);
            assert!((best / highest.0).ln().abs() < 0.02, "{omega}: {best} {highest:?}");
            assert!(source.power(best, 0.0) >= highest.1);
        }
    }
}
