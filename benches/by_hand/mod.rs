//! The two-mode system written out by hand, for integrators of other crates.

use differential_equations::prelude::ODE;
use harvester_lab::model::{ForceLaw, ParameterSet, ReducedSystem};

/// Eqs. (31)-(34) with two modes.
#[derive(Clone)]
pub(crate) struct ByHand {
    omega: [f64; 2],
    eta1: [f64; 2],
    eta2: [f64; 2],
    theta: [f64; 2],
    c1: f64,
    c2: f64,
    gap: f64,
    exact: bool,
    set: ParameterSet,
}

impl ByHand {
    /// Of `system`, which has two modes and the quadratic or the exact law.
    pub(crate) fn new(system: &ReducedSystem) -> Self {
        let [first, second] = [&system.modes[0], &system.modes[1]];
        Self {
            omega: [first.omega, second.omega],
            eta1: [first.eta1, second.eta1],
            eta2: [first.eta2, second.eta2],
            theta: [system.theta[0], system.theta[1]],
            c1: system.c1,
            c2: system.taylor_coefficients(2)[1],
            gap: system.equilibrium.gap,
            exact: system.law == ForceLaw::Exact,
            set: *system.parameters,
        }
    }

    /// Eq. (11) as the paper prints it.
    fn force(&self, x: f64) -> f64 {
        let (c0, h) = (self.set.c0, self.set.h);
        c0 * (x.powi(-2) + (x + 2.0 * h).powi(-2) - 2.0 * (x + h).powi(-2))
    }

    /// The magnet's force beyond its linear part at a tip displacement.
    #[inline]
    fn rest(&self, s: f64) -> f64 {
        if self.exact {
            self.force(self.gap) - self.force(self.gap + s) - self.c1 * s
        } else {
            self.c2 * s * s
        }
    }

    #[inline]
    fn rates(&self, t: f64, y: &[f64], dy: &mut [f64]) {
        let p = &self.set;
        let (s, w, v) = (y[0] + y[1], y[2] + y[3], y[4]);
        let common = p.alpha * self.c1 * w - self.rest(s);
        let drive = p.omega * p.omega * p.beta * (p.omega * t).sin();
        for k in 0..2 {
            dy[k] = y[2 + k];
            dy[2 + k] = (common - self.theta[k] * v + drive * self.eta1[k]) / self.eta2[k]
                - self.omega[k] * self.omega[k] * (y[k] + p.alpha * y[2 + k]);
        }
        dy[4] = (self.theta[0] * y[2] + self.theta[1] * y[3] - p.kappa * v) / p.c;
    }
}

impl ODE<f64, [f64; 5]> for ByHand {
    fn diff(&self, t: f64, y: &[f64; 5], dy: &mut [f64; 5]) {
        self.rates(t, y, dy);
    }
}

/// The same with the integral of v^2 as sixth component.
impl ODE<f64, [f64; 6]> for ByHand {
    fn diff(&self, t: f64, y: &[f64; 6], dy: &mut [f64; 6]) {
        self.rates(t, y, dy);
        dy[5] = y[4] * y[4];
    }
}
