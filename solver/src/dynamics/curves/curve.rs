//! Curves of bifurcations in the plane of two parameters: where one starts, its points, the special ones among them,
//! and why it ends.

use std::fmt;

use serde::{Deserialize, Serialize};

use crate::dynamics::Instability;

/// A bifurcation to trace a curve from.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, nanoserde::SerBin, nanoserde::DeBin)]
pub struct Start {
    /// Its kind, the curve's.
    pub kind: Instability,
    /// Period of the orbit in excitation periods.
    pub periods: usize,
    /// The two parameters.
    pub at: [f64; 2],
    /// State of the orbit at t = 0, length 2N + 1.
    pub state: Vec<f64>,
}

/// A point of a curve.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, nanoserde::SerBin, nanoserde::DeBin)]
pub struct CurvePoint {
    /// The two parameters.
    pub at: [f64; 2],
    /// State of the orbit at t = 0, length 2N + 1.
    pub state: Vec<f64>,
    /// Root mean square of the orbit's voltage (V).
    pub v_rms: f64,
}

/// Bifurcations of codimension two, points in the plane of two parameters (Kuznetsov, "Elements of Applied
/// Bifurcation Theory", chapter 9).
#[derive(
    Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize, nanoserde::SerBin, nanoserde::DeBin,
)]
#[serde(rename_all = "snake_case")]
pub enum SpecialKind {
    /// Two curves of folds meet in a point with a common tangent: three orbits become one.
    Cusp,
    /// A double multiplier +1; a Neimark-Sacker curve ends on one of folds.
    OneToOne,
    /// A double multiplier -1; a Neimark-Sacker curve ends on one of period doublings.
    OneToTwo,
    /// A pair at a third of a turn.
    OneToThree,
    /// A pair at a quarter of a turn.
    OneToFour,
    /// Multipliers +1 and -1.
    FoldFlip,
    /// A multiplier +1 and a pair on the circle.
    FoldNeimarkSacker,
    /// A multiplier -1 and a pair on the circle.
    FlipNeimarkSacker,
    /// Two pairs on the circle.
    DoubleNeimarkSacker,
    /// The doubled orbit changes from supercritical to subcritical; its curve of folds ends here.
    GeneralizedPeriodDoubling,
}

impl fmt::Display for SpecialKind {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(match self {
            Self::Cusp => "cusp",
            Self::OneToOne => "1:1 resonance",
            Self::OneToTwo => "1:2 resonance",
            Self::OneToThree => "1:3 resonance",
            Self::OneToFour => "1:4 resonance",
            Self::FoldFlip => "fold-flip",
            Self::FoldNeimarkSacker => "fold-Neimark-Sacker",
            Self::FlipNeimarkSacker => "flip-Neimark-Sacker",
            Self::DoubleNeimarkSacker => "double Neimark-Sacker",
            Self::GeneralizedPeriodDoubling => "generalized period doubling",
        })
    }
}

/// A point of codimension two on a curve.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, nanoserde::SerBin, nanoserde::DeBin)]
pub struct SpecialPoint {
    /// What it is.
    pub kind: SpecialKind,
    /// The two parameters.
    pub at: [f64; 2],
    /// State of the orbit at t = 0, length 2N + 1.
    pub state: Vec<f64>,
    /// Real and imaginary part of the orbit's multipliers over the curve's period, by descending modulus.
    pub multipliers: Vec<[f64; 2]>,
    /// How many points of the curve lie before it.
    pub after: usize,
}

/// Why a curve is not followed any further.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, nanoserde::SerBin, nanoserde::DeBin)]
#[serde(rename_all = "snake_case", tag = "kind")]
pub enum CurveEnd {
    /// The window's border.
    Window,
    /// A point of codimension two in which curves of this kind end; it is the curve's last point.
    Meeting {
        /// Which.
        special: SpecialKind,
    },
    /// The next point could not be found: the motion touches or escapes, or there is no device.
    Lost {
        /// What the last attempt met.
        reason: String,
    },
    /// The largest number of points was reached.
    Points,
    /// The curve is closed: it came back to its start.
    Closed,
}

/// A curve on which orbits of `periods` excitation periods have a multiplier on the unit circle.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, nanoserde::SerBin, nanoserde::DeBin)]
pub struct Curve {
    /// In which way.
    pub kind: Instability,
    /// Period of the orbits in excitation periods.
    pub periods: usize,
    /// Its points in order; in the plane's first parameter the curve grows as it passes its start.
    pub points: Vec<CurvePoint>,
    /// Which of them is the start.
    pub origin: usize,
    /// The points of codimension two on it, in order.
    pub special: Vec<SpecialPoint>,
    /// Why it ends before its first point and after its last one.
    pub ends: [CurveEnd; 2],
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_curve_round_trips_through_json() -> Result<(), serde_json::Error> {
        let (at, state) = ([8.1, 0.01], vec![0.1, -0.2, 0.3]);
        let multipliers = vec![[-1.0, 0.0], [0.3, 0.4]];
        let curve = Curve {
            kind: Instability::PeriodDoubling,
            periods: 1,
            points: vec![CurvePoint { at, state: state.clone(), v_rms: 1.5 }],
            origin: 0,
            special: vec![SpecialPoint { kind: SpecialKind::OneToTwo, at, state, multipliers, after: 1 }],
            ends: [CurveEnd::Window, CurveEnd::Lost { reason: "the magnets touch".into() }],
        };
        assert_eq!(serde_json::from_str::<Curve>(&serde_json::to_string(&curve)?)?, curve);
        Ok(())
    }
}
