//! The figures of the paper: their parameters, their time windows, and what the paper says of them.

use crate::app::text::marked;
use crate::model::{ParameterSet, ReducedSystem};
use crate::scenario::{ModelChoice, Scenario};
use crate::theory::Resonance;

/// Where a figure's excitation frequency lies.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Frequency {
    /// A number.
    At(f64),
    /// omega_1 + omega_2.
    Sum,
    /// omega_2 - omega_1.
    Difference,
    /// 2 omega_1.
    TwiceFirst,
    /// 2 omega_2.
    TwiceSecond,
}

/// The numbers of the figures that there are; 1 are the tables.
pub(super) const NUMBERS: (usize, usize) = (1, 12);

/// What a figure shows.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Kind {
    /// Boundaries for four dampings, and a marked point.
    Boundaries { resonance: Resonance, dampings: [f64; 4], point: &'static str, omega: f64 },
    /// History, close view, phase portrait, Poincare map.
    Response { alpha: f64, beta: f64, frequency: Frequency, initial_until: f64, window: [f64; 2], c0: f64 },
}

/// A figure of the paper.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Figure {
    /// Its number, 2 to 12.
    pub number: u8,
    /// Short title.
    pub title: &'static str,
    /// What the paper says it shows.
    pub paper: &'static str,
    kind: Kind,
}

/// The boundaries of one figure.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct BoundaryFigure {
    pub resonance: Resonance,
    /// Upper end of the excitation axis and half width of the frequency axis, at which the curves are seen.
    pub ceiling: f64,
    pub half_width: f64,
    pub dampings: [f64; 4],
    pub point: &'static str,
    pub omega: f64,
}

/// The marked points S0, S1, S2 all have this excitation.
pub(super) const MARKED_EXCITATION: f64 = 1e-3;

const fn response(
    number: u8,
    title: &'static str,
    (alpha, beta): (f64, f64),
    frequency: Frequency,
    initial_until: f64,
    window: [f64; 2],
    paper: &'static str,
) -> Figure {
    let kind = Kind::Response { alpha, beta, frequency, initial_until, window, c0: 0.5084 };
    Figure { number, title, paper, kind }
}

const fn boundaries(
    number: u8,
    title: &'static str,
    resonance: Resonance,
    dampings: [f64; 4],
    (point, omega): (&'static str, f64),
    paper: &'static str,
) -> Figure {
    Figure { number, title, paper, kind: Kind::Boundaries { resonance, dampings, point, omega } }
}

/// Cases 1 and 2 of section 3.4, which most figures use: (alpha, beta).
const CASE_1: (f64, f64) = (1e-3, 1e-3);
const CASE_2: (f64, f64) = (1e-4, 1e-2);

/// Figures 2 to 12. (Figure 1 is the sketch of the device, which the page draws moving.)
pub(super) const FIGURES: [Figure; 11] = [
    boundaries(
        2,
        marked("Stability boundary, ω ≈ ω₁+ω₂"),
        Resonance::Sum,
        [0.0, 0.001, 0.002, 0.003],
        ("S₀", 25.0),
        marked(
            "Eq. 57 for four dampings: the combination resonance needs small damping, a large excitation and a frequency \
             close to the sum. S₀ is stable.",
        ),
    ),
    response(
        3,
        marked("Periodic response, ω = 25"),
        CASE_1,
        Frequency::At(25.0),
        60.0,
        [600.0, 602.0],
        marked(
            "At S₀ the response is periodic with the period of the excitation; theory (59) and computation nearly agree.",
        ),
    ),
    response(
        4,
        marked("Quasiperiodic response, ω = ω₁+ω₂"),
        CASE_2,
        Frequency::Sum,
        60.0,
        [600.0, 605.0],
        marked(
            "Small damping and large excitation at the sum of the frequencies: the motion is not periodic, and the \
             Poincaré map shows a closed curve.",
        ),
    ),
    response(
        5,
        marked("Small periodic response, ω = ω₂−ω₁"),
        CASE_1,
        Frequency::Difference,
        60.0,
        [600.0, 602.0],
        marked(
            "At the difference of the frequencies the response stays periodic: there is no difference resonance.",
        ),
    ),
    response(
        6,
        marked("Large periodic response, ω = ω₂−ω₁"),
        CASE_2,
        Frequency::Difference,
        60.0,
        [600.0, 602.0],
        marked("The same with ten times the excitation and a tenth of the damping: still periodic."),
    ),
    boundaries(
        7,
        marked("Stability boundary, ω ≈ 2ω₁"),
        Resonance::First,
        [0.0, 0.001, 0.002, 0.003],
        ("S₁", 8.0),
        marked(
            "Eq. 72 for four dampings: near twice the first frequency stability strongly depends on the damping. S₁ is \
             stable.",
        ),
    ),
    response(
        8,
        marked("Periodic response, ω = 8"),
        CASE_1,
        Frequency::At(8.0),
        80.0,
        [600.0, 604.0],
        marked("At S₁ the response has the period of the excitation; both methods give almost the same map."),
    ),
    response(
        9,
        marked("Period-doubled motion, ω = 2ω₁"),
        CASE_2,
        Frequency::TwiceFirst,
        120.0,
        [600.0, 608.0],
        marked(
            "In the unstable region the steady state has twice the period of the excitation: two points in the Poincaré \
             map.",
        ),
    ),
    boundaries(
        10,
        marked("Stability boundary, ω ≈ 2ω₂"),
        Resonance::Second,
        [0.0, 1e-4, 2e-4, 3e-4],
        ("S₂", 43.0),
        marked(
            "Eq. 81 for four dampings: the second subharmonic resonance needs extremely small damping. S₂ is stable.",
        ),
    ),
    response(
        11,
        marked("Periodic response, ω = 43"),
        CASE_1,
        Frequency::At(43.0),
        40.0,
        [600.0, 601.0],
        marked("At S₂ the response has the period of the excitation."),
    ),
    Figure {
        number: 12,
        title: marked("Growth without bound, ω = 2ω₂"),
        paper: marked(
            "The output voltage grows without bound, taken as proof of the second subharmonic resonance.",
        ),
        kind: Kind::Response {
            alpha: CASE_2.0,
            beta: CASE_2.1,
            frequency: Frequency::TwiceSecond,
            initial_until: 1.2,
            window: [600.0, 601.0],
            c0: 0.508394,
        },
    },
];

/// The figure with this number.
pub(super) fn figure(number: u8) -> Option<&'static Figure> {
    FIGURES.iter().find(|figure| figure.number == number)
}

impl Figure {
    /// The scenario the figure shows; a boundary figure's is its marked point.
    pub(super) fn scenario(&self) -> Option<Scenario> {
        let (alpha, beta, frequency, t_end, c0) = match self.kind {
            Kind::Boundaries { dampings, omega, .. } => {
                (dampings[1], MARKED_EXCITATION, Frequency::At(omega), 600.0, 0.5084)
            }
            Kind::Response { alpha, beta, frequency, window, c0, .. } => {
                (alpha, beta, frequency, window[1], c0)
            }
        };
        let set = ParameterSet { alpha, beta, c0, ..ParameterSet::default() };
        let model = ModelChoice::default();
        let system = model.system(set).ok()?;
        let parameters = ParameterSet { omega: frequency.of(&system), ..set };
        Some(Scenario { parameters, model, t_end, ..Scenario::default() })
    }

    /// The resonance the figure is about; none for the difference.
    pub(super) fn resonance(&self) -> Option<Resonance> {
        match self.kind {
            Kind::Boundaries { resonance, .. } => Some(resonance),
            Kind::Response { .. } => match self.number {
                3 | 4 => Some(Resonance::Sum),
                8 | 9 => Some(Resonance::First),
                11 | 12 => Some(Resonance::Second),
                _ => None,
            },
        }
    }

    /// The boundaries, when the figure shows some.
    pub(super) fn boundaries(&self) -> Option<BoundaryFigure> {
        match self.kind {
            Kind::Boundaries { resonance, dampings, point, omega } => {
                let (ceiling, half_width) = match resonance {
                    Resonance::Sum => (0.03, 0.9),
                    Resonance::First => (0.02, 0.8),
                    Resonance::Second => (0.06, 0.4),
                };
                Some(BoundaryFigure { resonance, ceiling, half_width, dampings, point, omega })
            }
            Kind::Response { .. } => None,
        }
    }

    /// End of the initial history of panel (a), and the terminal interval of panel (b).
    pub(super) fn windows(&self) -> Option<(f64, [f64; 2])> {
        match self.kind {
            Kind::Boundaries { .. } => None,
            Kind::Response { initial_until, window, .. } => Some((initial_until, window)),
        }
    }
}

impl Frequency {
    fn of(self, system: &ReducedSystem) -> f64 {
        let (first, second) = (system.modes[0].omega, system.modes[1].omega);
        match self {
            Self::At(omega) => omega,
            Self::Sum => first + second,
            Self::Difference => second - first,
            Self::TwiceFirst => 2.0 * first,
            Self::TwiceSecond => 2.0 * second,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_figure_from_2_to_12_loads_a_valid_scenario() {
        for number in 2..=12 {
            let scenario = figure(number).and_then(Figure::scenario);
            assert!(scenario.is_some_and(|scenario| scenario.validate().is_ok()), "Figure {number}");
        }
    }

    #[test]
    fn the_frequencies_are_those_the_paper_prints() {
        let omega =
            |number| figure(number).and_then(Figure::scenario).map(|scenario| scenario.parameters.omega);
        for (number, printed) in [(4, 25.4), (5, 17.3), (6, 17.3), (9, 8.0967), (12, 42.7)] {
            assert!(omega(number).is_some_and(|omega| (omega - printed).abs() < 0.05), "Figure {number}");
        }
    }
}
