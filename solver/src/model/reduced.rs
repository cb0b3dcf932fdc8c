//! The N-mode truncation (Eqs. 27-34): coefficients, right-hand side and its Jacobian side by side.

use super::force::{Exact, Polynomial};
use super::modes::Tip;
use super::{Equilibrium, ForceLaw, Magnet, ModeSet, ModelError, Parameters, RestForce, state_dimension};

/// The N-mode system, ready to be integrated.
///
/// The state is (q_1..q_N, dq_1/dt..dq_N/dt, v), of length 2N + 1, all dimensionless but v, which is in volts.
#[derive(Debug, Clone)]
pub struct ReducedSystem {
    /// The dimensionless numbers the system was made from.
    pub parameters: Parameters,
    /// Where the tip rests.
    pub equilibrium: Equilibrium,
    /// The modes kept.
    pub modes: ModeSet,
    /// The force law chosen.
    pub law: ForceLaw,
    /// Linear magnet stiffness c_1 (dimensionless).
    pub c1: f64,
    /// Modal couplings theta_n of Eq. (27), one a mode (dimensionless, per volt).
    pub theta: Vec<f64>,
    /// Capacitance of the circuit's equation (dimensionless): c, and c_r of [`Self::with_residual_moment`] where that
    /// counts.
    pub capacitance: f64,
    /// Whether the modes left out count in that capacitance and in the slope at the tip.
    pub residual_moment: bool,
    /// What each entry of the state adds to the slope at the tip: rad, per volt the last; of length 2N + 1.
    pub slopes: Vec<f64>,
}

impl ReducedSystem {
    /// Eqs. (27), (32), (33), section 2.4: the system of `modes` modes under a force law.
    ///
    /// # Errors
    /// [`ModelError`] when there is no stable equilibrium, or the number of modes or degree is not available.
    #[doc(alias = "eq-27")]
    #[doc(alias = "eq-33")]
    pub fn new(parameters: Parameters, modes: usize, law: ForceLaw) -> Result<Self, ModelError> {
        let law = law.validate()?;
        let equilibrium = Equilibrium::new(&parameters)?;
        let magnet = Magnet { c0: parameters.c0, h: parameters.h };
        let c1 = magnet.taylor_coefficient(equilibrium.gap, 1);
        let modes = ModeSet::with_tip(c1, Tip::of(&parameters), modes)?;
        let theta = modes.iter().map(|mode| parameters.theta * mode.tip_slope).collect();
        let capacitance = parameters.c;
        let mut slopes: Vec<f64> = modes.iter().map(|mode| mode.tip_slope).collect();
        slopes.resize(state_dimension(modes.len()), 0.0);
        Ok(Self {
            parameters,
            equilibrium,
            modes,
            law,
            c1,
            theta,
            capacitance,
            residual_moment: false,
            slopes,
        })
    }

    /// The same system with (`on`) or without the modes left out in the circuit's equation and in the slope at the tip.
    ///
    /// The moment theta v at the tip bends every mode, those left out quasi-statically: mode k > N follows as
    /// q_k = -theta_k v/(eta_2k omega_k^2), which gives the current -theta_k^2/(eta_2k omega_k^2) dv/dt. Together they
    /// are a capacitance beside c, c_r = theta^2 ([`ModeSet::residual_compliance`]): (c + c_r) dv/dt + kappa v is the
    /// current of the modes kept, and c_r v^2/2 is the energy stored in the others. They turn the tip by
    /// -theta v ([`ModeSet::residual_compliance`]). Their inertia, their damping and what they add to the tip
    /// displacement, a sum that falls like 1/N^2, stay left out.
    #[must_use]
    pub fn with_residual_moment(mut self, on: bool) -> Self {
        let theta = self.parameters.theta;
        let compliance = if on { self.modes.residual_compliance(self.c1) } else { 0.0 };
        self.capacitance = self.parameters.c + theta * theta * compliance;
        self.slopes[2 * self.modes.len()] = -theta * compliance;
        self.residual_moment = on;
        self
    }

    /// The same device under another excitation: everything that depends on the structure is kept.
    ///
    /// # Errors
    /// [`ModelError`] when `beta` or `omega` is out of range.
    pub fn with_excitation(&self, beta: f64, omega: f64) -> Result<Self, ModelError> {
        let parameters = Parameters::new(super::ParameterSet { beta, omega, ..*self.parameters })?;
        Ok(Self { parameters, ..self.clone() })
    }

    /// The system at other numbers: what does not depend on those that change is kept.
    ///
    /// # Errors
    /// As [`Self::new`].
    pub fn with_numbers(&self, set: super::ParameterSet) -> Result<Self, ModelError> {
        let parameters = Parameters::new(set)?;
        let structure = |set: &super::ParameterSet| [set.c0, set.d, set.h, set.eta, set.j, set.e];
        if structure(&set) != structure(&self.parameters) {
            let system = Self::new(parameters, self.modes.len(), self.law)?;
            return Ok(system.with_residual_moment(self.residual_moment));
        }
        let theta = self.modes.iter().map(|mode| parameters.theta * mode.tip_slope).collect();
        let system = Self { parameters, theta, ..self.clone() };
        Ok(system.with_residual_moment(self.residual_moment))
    }

    /// Whether nothing takes energy out: no viscosity, no air, and no load that feels the beam.
    pub fn undamped(&self) -> bool {
        let p = &self.parameters;
        p.alpha == 0.0 && p.air == 0.0 && (p.theta == 0.0 || p.kappa == 0.0)
    }

    /// Length 2N + 1 of the state.
    pub fn dimension(&self) -> usize {
        state_dimension(self.modes.len())
    }

    /// The pair of magnets.
    pub fn magnet(&self) -> Magnet {
        Magnet { c0: self.parameters.c0, h: self.parameters.h }
    }

    /// c_1..c_count of Eq. (17) at this equilibrium.
    pub fn taylor_coefficients(&self, count: u32) -> Vec<f64> {
        (1..=count).map(|j| self.magnet().taylor_coefficient(self.equilibrium.gap, j)).collect()
    }

    /// The law's R(s).
    pub fn rest_force(&self) -> RestForce {
        let (magnet, rest) = (self.magnet(), &self.equilibrium);
        match self.law {
            ForceLaw::Quadratic => RestForce::Quadratic { c2: magnet.taylor_coefficient(rest.gap, 2) },
            ForceLaw::Taylor(degree) => RestForce::Polynomial(Polynomial::new(&magnet, rest, degree)),
            // Without magnets the tip may pass the place where they would touch, a pole of the exact law.
            ForceLaw::Exact if magnet.c0 == 0.0 => RestForce::Quadratic { c2: 0.0 },
            ForceLaw::Exact => RestForce::Exact(Exact::new(&magnet, rest)),
        }
    }

    /// Tip displacement from equilibrium s = sum of q_n, in beam lengths. `state` has length 2N + 1.
    pub fn tip_displacement(&self, state: &[f64]) -> f64 {
        state[..self.modes.len()].iter().sum()
    }

    /// Slope at the tip from equilibrium (rad, positive where the tip turns with a positive displacement).
    pub fn tip_slope(&self, state: &[f64]) -> f64 {
        self.slopes.iter().zip(state).map(|(slope, entry)| slope * entry).sum()
    }

    /// Tip velocity w = sum of dq_n/dt.
    pub fn tip_velocity(&self, state: &[f64]) -> f64 {
        let n = self.modes.len();
        state[n..2 * n].iter().sum()
    }

    /// Eq. (31), section 2.4: dv/dt = (sum of theta_n dq_n/dt - kappa v) / c, c being [`Self::capacitance`].
    #[doc(alias = "eq-31")]
    pub fn voltage_rate(&self, state: &[f64]) -> f64 {
        let n = self.modes.len();
        let current: f64 = self.theta.iter().zip(&state[n..]).map(|(theta, rate)| theta * rate).sum();
        (current - self.parameters.kappa * state[2 * n]) / self.capacitance
    }

    /// Eqs. (32), (34), (60), sections 2.4-3.3: the time derivative of `state` under excitation phase `omega t`
    /// with sine `sin_phase` and a rest force `rest` = R(s). Both slices have length 2N + 1.
    #[doc(alias = "eq-32")]
    #[doc(alias = "eq-34")]
    #[doc(alias = "eq-60")]
    pub fn derivative(&self, state: &[f64], rest: f64, sin_phase: f64, derivative: &mut [f64]) {
        let n = self.modes.len();
        let p = &self.parameters;
        let common = p.alpha * self.c1 * self.tip_velocity(state) - rest;
        let drive = p.omega * p.omega * p.beta * sin_phase;
        let voltage = state[2 * n];
        for (k, mode) in self.modes.iter().enumerate() {
            let (position, velocity) = (state[k], state[n + k]);
            derivative[k] = velocity;
            derivative[n + k] = (common + drive * mode.eta1 - self.theta[k] * voltage) / mode.eta2
                - mode.omega * mode.omega * (position + p.alpha * velocity)
                - p.air * velocity;
        }
        derivative[2 * n] = self.voltage_rate(state);
    }

    /// The Jacobian of [`Self::derivative`] with respect to the state, (2N + 1) x (2N + 1), where the force law
    /// has the slope `slope` = dR/ds. With slope 0 it is the matrix A of the linear system.
    pub fn jacobian(&self, slope: f64) -> nalgebra::DMatrix<f64> {
        let n = self.modes.len();
        let p = &self.parameters;
        let mut jacobian = nalgebra::DMatrix::zeros(2 * n + 1, 2 * n + 1);
        for (k, mode) in self.modes.iter().enumerate() {
            jacobian[(k, n + k)] = 1.0;
            for j in 0..n {
                jacobian[(n + k, j)] = -slope / mode.eta2;
                jacobian[(n + k, n + j)] = p.alpha * self.c1 / mode.eta2;
            }
            jacobian[(n + k, k)] -= mode.omega * mode.omega;
            jacobian[(n + k, n + k)] -= p.alpha * mode.omega * mode.omega + p.air;
            jacobian[(n + k, 2 * n)] = -self.theta[k] / mode.eta2;
            jacobian[(2 * n, n + k)] = self.theta[k] / self.capacitance;
        }
        jacobian[(2 * n, 2 * n)] = -p.kappa / self.capacitance;
        jacobian
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::ParameterSet;

    fn system(modes: usize, law: ForceLaw) -> ReducedSystem {
        let parameters = Parameters::new(ParameterSet::default()).expect("the paper's parameters are valid");
        ReducedSystem::new(parameters, modes, law).expect("the paper's device is valid")
    }

    #[test]
    fn a_system_at_other_numbers_is_the_one_made_from_them() -> Result<(), ModelError> {
        let set = ParameterSet { j: 1e-3, e: 0.02, air: 0.05, ..Default::default() };
        let of = |set: ParameterSet| -> Result<_, ModelError> {
            Ok(ReducedSystem::new(Parameters::new(set)?, 3, ForceLaw::Exact)?.with_residual_moment(true))
        };
        let base = of(set)?;
        for parameter in crate::model::Parameter::ALL {
            let mut set = *base.parameters;
            *set.get_mut(parameter) *= 1.1;
            let (changed, made) = (base.with_numbers(set)?, of(set)?);
            assert_eq!(changed.parameters, made.parameters);
            assert_eq!(
                (changed.c1, changed.equilibrium.gap),
                (made.c1, made.equilibrium.gap),
                "{parameter:?}"
            );
            assert_eq!((&changed.theta, &changed.slopes), (&made.theta, &made.slopes), "{parameter:?}");
            assert_eq!(changed.jacobian(0.3), made.jacobian(0.3), "{parameter:?}");
        }
        Ok(())
    }

    #[test]
    fn a_moment_at_the_tip_at_rest_turns_it_like_the_whole_beam_whatever_the_number_of_modes() {
        // Without magnets a moment M turns the end of a cantilever by M L/(EI); a voltage acts as the moment -theta v.
        let set = ParameterSet { c0: 0.0, theta: 2e-3, ..Default::default() };
        for modes in [1, 2, 5] {
            let parameters = Parameters::new(set).expect("in range");
            let system = ReducedSystem::new(parameters, modes, ForceLaw::Quadratic).expect("a device");
            let bent = |system: &ReducedSystem| {
                let mut state = vec![0.0; system.dimension()];
                for (k, mode) in system.modes.iter().enumerate() {
                    state[k] = -3.0 * system.theta[k] / (mode.eta2 * mode.omega * mode.omega);
                }
                state[2 * modes] = 3.0;
                system.tip_slope(&state)
            };
            assert!(bent(&system) > -0.99 * 3.0 * 2e-3);
            let whole = bent(&system.with_residual_moment(true));
            assert!((whole / (-3.0 * 2e-3) - 1.0).abs() < 1e-12, "{modes}: {whole}");
        }
    }

    #[test]
    fn the_jacobian_is_the_derivative_by_finite_differences() {
        for (modes, law) in [(1, ForceLaw::Quadratic), (2, ForceLaw::Exact), (4, ForceLaw::Taylor(4))] {
            let set = ParameterSet { j: 1e-3, e: 0.02, air: 0.05, ..Default::default() };
            let system =
                ReducedSystem::new(Parameters::new(set).expect("in range"), modes, law).expect("a device");
            let force = system.rest_force();
            let state: Vec<f64> = (0..system.dimension()).map(|i| 0.01 * (1.0 + i as f64).sin()).collect();
            let evaluate = |state: &[f64]| {
                let mut derivative = vec![0.0; state.len()];
                let rest = force.rest(system.tip_displacement(state));
                system.derivative(state, rest, 0.3, &mut derivative);
                derivative
            };
            let jacobian = system.jacobian(force.slope(system.tip_displacement(&state)));
            for j in 0..state.len() {
                let step = 1e-6;
                let (mut low, mut high) = (state.clone(), state.clone());
                low[j] -= step;
                high[j] += step;
                let (low, high) = (evaluate(&low), evaluate(&high));
                for i in 0..state.len() {
                    let difference = (high[i] - low[i]) / (2.0 * step);
                    let error = (jacobian[(i, j)] - difference).abs();
                    assert!(error < 1e-6 * (1.0 + difference.abs()), "{modes} {law:?} ({i}, {j}): {error}");
                }
            }
        }
    }

    #[test]
    fn the_right_hand_side_has_the_hand_computed_value() {
        // One mode, state (q, dq/dt, v) = (0.1, 0.2, 3), a quarter of the excitation period, by Eqs. (31), (32).
        let system = system(1, ForceLaw::Quadratic);
        let mode = &system.modes[0];
        let (c1, c2) = (1.3450051225722, -19.378543266711);
        let force = 0.001 * c1 * 0.2 - c2 * 0.01 - 2.66720397414344e-4 * 3.0 + 625.0 * 0.001 * mode.eta1;
        let acceleration = force / mode.eta2 - mode.omega.powi(2) * (0.1 + 0.001 * 0.2);
        let mut derivative = [0.0; 3];
        system.derivative(&[0.1, 0.2, 3.0], system.rest_force().rest(0.1), 1.0, &mut derivative);
        assert_eq!(derivative[0], 0.2);
        assert!((derivative[1] - acceleration).abs() < 1e-10);
        assert!((derivative[2] - (2.66720397414344e-4 * 0.2 - 3e-6) / 1e-6).abs() < 1e-9);
    }
}
