//! Figures 3, 5, 6, 8 and 11: motions of the excitation's own period, and how far the theory's curves are from them.

use harvester_lab::theory::{LinearResponse, SteadyState};

use super::support::{Numbers, assert_close, assert_numbers, paper, range, strobe_states};
use crate::{OMEGA_1, OMEGA_2};

/// What the figures with a motion of the excitation's own period show.
struct PeriodOne {
    alpha: f64,
    beta: f64,
    omega: f64,
    end: f64,
    numbers: Numbers,
    /// Spread of v over the last 50 stroboscopic points: what is left of the transient. This and the next two are
    /// in units of the largest |v| of the last period.
    spread: f64,
    /// Largest distance between the computed curve and the paper's dots in the plane (v, dv/dt / omega). The dots
    /// leave out damping and the circuit's back-action.
    from_dots: f64,
    /// The same in v from the linear response that keeps both.
    from_linear: f64,
}

impl PeriodOne {
    fn assert(&self) {
        let &Self { alpha, beta, omega, end, .. } = self;
        let run = paper(alpha, beta, omega, end);
        assert_numbers(&run, self.numbers);
        let period = run.system.parameters.period();
        let (mut peak, mut from_dots, mut from_linear): (f64, f64, f64) = (0.0, 0.0, 0.0);
        let dots = SteadyState::new(&run.system).expect("off resonance").voltage;
        let linear = LinearResponse::new(&run.system).expect("damped");
        // The 500 times of the reference.
        run.trajectory.sample(end - period, end, 500, |t, state| {
            let (v, rate) = (state[4], run.system.voltage_rate(state) / omega);
            peak = peak.max(v.abs());
            from_dots = from_dots.max((v - dots.value(t)).hypot(rate - dots.rate(t) / omega));
            from_linear = from_linear.max((v - linear.state(t)[4]).abs());
        });
        let (low, high) = range(&strobe_states(&run, 50), 4);
        for (value, reference) in
            [(high - low, self.spread), (from_dots, self.from_dots), (from_linear, self.from_linear)]
        {
            assert_close(value / peak, reference, 1.0);
        }
        let recurrence = run.recurrence.expect("enough points");
        assert_eq!(recurrence.period, Some(1), "omega = {omega}: {recurrence:?}");
    }
}

#[test]
fn figure_3_has_period_one_and_the_theory_near_it() {
    let figure = PeriodOne {
        alpha: 1e-3,
        beta: 1e-3,
        omega: 25.0,
        end: 602.0,
        numbers: [1.82572778232, 2.58409944845, 6.45577657051e1, 1.41400545441e-3, -1.40549226624e-3],
        spread: 8.6589748e-4,
        from_dots: 8.1773785e-2,
        from_linear: 4.0589031e-4,
    };
    figure.assert();
}

#[test]
fn figure_5_has_period_one_and_the_theory_near_it() {
    let figure = PeriodOne {
        alpha: 1e-3,
        beta: 1e-3,
        omega: OMEGA_2 - OMEGA_1,
        end: 603.0,
        numbers: [1.34976241319, 1.91042250599, 3.30437899540e1, 3.09211368031e-3, -3.05188443651e-3],
        spread: 6.8987531e-4,
        from_dots: 4.5421426e-2,
        from_linear: 4.9508863e-4,
    };
    figure.assert();
}

#[test]
fn figure_6_has_period_one_and_the_theory_near_it() {
    let figure = PeriodOne {
        alpha: 1e-4,
        beta: 1e-2,
        omega: OMEGA_2 - OMEGA_1,
        end: 603.0,
        numbers: [1.35443918911e1, 1.92064540971e1, 3.31818836505e2, 3.28017892951e-2, -2.86976655111e-2],
        spread: 6.1433879e-4,
        from_dots: 2.4196151e-2,
        from_linear: 4.8730649e-3,
    };
    figure.assert();
}

#[test]
fn figure_8_has_period_one_and_the_theory_near_it() {
    let figure = PeriodOne {
        alpha: 1e-3,
        beta: 1e-3,
        omega: 8.0,
        end: 604.0,
        numbers: [4.71271292530e-1, 6.67800683228e-1, 5.33691337715, 2.18760909840e-3, -2.16657062094e-3],
        spread: 1.5782635e-3,
        from_dots: 5.1571594e-3,
        from_linear: 1.4076367e-3,
    };
    figure.assert();
}

#[test]
fn figure_11_has_period_one_and_the_theory_near_it() {
    let figure = PeriodOne {
        alpha: 1e-3,
        beta: 1e-3,
        omega: 43.0,
        end: 601.0,
        numbers: [4.61246995757e-1, 6.55891644297e-1, 2.80635815711e1, 5.01689700928e-4, -5.00768473232e-4],
        spread: 5.5161317e-3,
        from_dots: 2.4097688e-2,
        from_linear: 1.1332933e-3,
    };
    figure.assert();
}
