//! The energy of the reduced system and the powers that change it: the balance every solution must keep.

use super::ReducedSystem;

/// The powers of one instant, dimensionless (unit: E I / L over the time unit).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Powers {
    /// Power the shaken base puts in.
    pub input: f64,
    /// Power lost in the Kelvin-Voigt material and to the air.
    pub viscous: f64,
    /// Power delivered to the load, kappa v^2.
    pub electrical: f64,
}

/// Kinetic, bending, magnet and capacitor energy of `state` (length 2N + 1), dimensionless, 0 at rest.
///
/// The modes are orthogonal in the energy products, so kinetic plus linear potential energy is half the sum of
/// eta_2n (dq_n/dt^2 + omega_n^2 q_n^2); R(s) adds its own potential. No work is done in the coupling theta: what
/// the beam gives the circuit receives. The capacitance holds the energy of the modes left out where the model counts it.
pub fn energy(system: &ReducedSystem, state: &[f64]) -> f64 {
    let n = system.modes.len();
    let mechanical: f64 = system
        .modes
        .iter()
        .enumerate()
        .map(|(k, mode)| 0.5 * mode.eta2 * (state[n + k].powi(2) + (mode.omega * state[k]).powi(2)))
        .sum();
    let voltage = state[2 * n];
    mechanical
        + system.rest_force().potential(system.tip_displacement(state))
        + 0.5 * system.capacitance * voltage * voltage
}

/// The three powers at `state` (length 2N + 1) when the excitation's phase has the sine `sin_phase`; the energy
/// changes at the rate input - viscous - electrical.
pub fn powers(system: &ReducedSystem, state: &[f64], sin_phase: f64) -> Powers {
    let n = system.modes.len();
    let p = &system.parameters;
    let tip_velocity = system.tip_velocity(state);
    let (mut participation, mut viscous, mut air) = (0.0, -system.c1 * tip_velocity * tip_velocity, 0.0);
    for (mode, velocity) in system.modes.iter().zip(&state[n..2 * n]) {
        participation += mode.eta1 * velocity;
        viscous += mode.eta2 * (mode.omega * velocity).powi(2);
        air += mode.eta2 * velocity * velocity;
    }
    Powers {
        input: p.omega * p.omega * p.beta * sin_phase * participation,
        viscous: p.alpha * viscous + p.air * air,
        electrical: p.kappa * state[2 * n].powi(2),
    }
}
