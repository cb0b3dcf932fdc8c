//! Curves of bifurcations in the plane of two parameters: where one starts, its points, the special ones among them,
//! and why it ends.

use serde::{Deserialize, Serialize};

use crate::dynamics::integration::Measures;
use crate::dynamics::orbits::Instability;
use crate::sentence::{Say, Sentence, in_english, said};

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
    /// Means and extremes of the orbit.
    #[serde(flatten)]
    pub measures: Measures,
    /// Coefficient of the bifurcation's normal form on the centre manifold (dimensionless): b of x + b x^2 at a fold,
    /// with a sign that changes at a cusp; c of -x + c x^3 at a period doubling; at a Neimark-Sacker point the real
    /// part d of D in exp(i theta) z (1 + D z |z|^2). x measures states, in the components that
    /// [`crate::dynamics::PeriodMap::scales`] makes comparable, over the gap. Good to about 1e-5 of the largest term;
    /// `None` where there is no finite value, and for a device without any damping.
    pub coefficient: Option<f64>,
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
    /// A period doubling changes from supercritical to subcritical; a curve of folds of the doubled orbits ends here.
    GeneralizedPeriodDoubling,
    /// A Neimark-Sacker bifurcation changes from supercritical to subcritical; here tori meet and end.
    Chenciner,
}

impl SpecialKind {
    /// Every kind.
    pub const ALL: [Self; 11] = [
        Self::Cusp,
        Self::OneToOne,
        Self::OneToTwo,
        Self::OneToThree,
        Self::OneToFour,
        Self::FoldFlip,
        Self::FoldNeimarkSacker,
        Self::FlipNeimarkSacker,
        Self::DoubleNeimarkSacker,
        Self::GeneralizedPeriodDoubling,
        Self::Chenciner,
    ];

    /// Whether the normal form of a curve of `kind` has a finite coefficient in such a point.
    pub(super) fn has_coefficient(self, kind: Instability) -> bool {
        match self {
            Self::OneToOne | Self::OneToTwo => false,
            Self::FoldFlip => kind == Instability::Fold,
            Self::FoldNeimarkSacker => kind == Instability::Fold,
            _ => true,
        }
    }
}

/// To which side the motions go that branch off, on the centre manifold.
#[derive(
    Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize, nanoserde::SerBin, nanoserde::DeBin,
)]
#[serde(rename_all = "snake_case")]
pub enum Criticality {
    /// To the side where the orbit is unstable: they take over its stability and grow out of it.
    Supercritical,
    /// To the side where the orbit is stable: they are unstable, and beyond the curve the motion jumps elsewhere.
    Subcritical,
}

impl Criticality {
    /// What a normal form's `coefficient` says at a bifurcation of `kind`; nothing at a fold, where nothing branches off.
    pub fn of(kind: Instability, coefficient: f64) -> Option<Self> {
        let supercritical = match kind {
            Instability::Fold => return None,
            Instability::PeriodDoubling => coefficient > 0.0,
            Instability::NeimarkSacker => coefficient < 0.0,
        };
        Some(if supercritical { Self::Supercritical } else { Self::Subcritical })
    }
}

impl Say for SpecialKind {
    fn say(&self) -> Sentence {
        let resonance = |ratio: &str| said("{ratio} resonance", &[("ratio", &ratio)]);
        match self {
            Self::Cusp => said("cusp", &[]),
            Self::OneToOne => resonance("1:1"),
            Self::OneToTwo => resonance("1:2"),
            Self::OneToThree => resonance("1:3"),
            Self::OneToFour => resonance("1:4"),
            Self::FoldFlip => said("fold-flip", &[]),
            Self::FoldNeimarkSacker => said("fold-Neimark-Sacker", &[]),
            Self::FlipNeimarkSacker => said("flip-Neimark-Sacker", &[]),
            Self::DoubleNeimarkSacker => said("double Neimark-Sacker", &[]),
            Self::GeneralizedPeriodDoubling => said("generalized period doubling", &[]),
            Self::Chenciner => said("Chenciner", &[]),
        }
    }
}

in_english!(SpecialKind);

/// A point of codimension two on a curve.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, nanoserde::SerBin, nanoserde::DeBin)]
pub struct SpecialPoint {
    /// Its kind.
    pub kind: SpecialKind,
    /// The two parameters.
    pub at: [f64; 2],
    /// State of the orbit at t = 0, length 2N + 1.
    pub state: Vec<f64>,
    /// Real and imaginary part of the orbit's multipliers over the curve's period, by descending modulus.
    pub multipliers: Vec<[f64; 2]>,
    /// Coefficient of the curve's normal form, as that of a [`CurvePoint`]: zero at a cusp, a generalized period doubling
    /// and a Chenciner point; `None` where it grows beyond all bounds and where the orbit has half the curve's period.
    pub coefficient: Option<f64>,
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
        /// The point's kind.
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

/// A stretch of a curve of the same criticality.
#[derive(Debug, Clone, PartialEq)]
pub struct Stretch {
    /// To which side motions branch off on it; not known where no coefficient is finite, none at folds.
    pub criticality: Option<Criticality>,
    /// Its places, the points of codimension two at its ends among them.
    pub places: Vec<[f64; 2]>,
}

impl Curve {
    /// The criticality at each point: one without a coefficient has that of the point before, the first ones that of the
    /// first which has one.
    pub fn criticality(&self) -> Vec<Option<Criticality>> {
        let of = |point: &CurvePoint| point.coefficient.and_then(|value| Criticality::of(self.kind, value));
        let mut known = self.points.iter().find_map(of);
        let points = self.points.iter();
        points
            .map(|point| {
                known = of(point).or(known);
                known
            })
            .collect()
    }

    /// The curve in stretches of the same criticality, each from where the one before ends. A point without a coefficient
    /// belongs to the stretch on the way to it.
    pub fn stretches(&self) -> Vec<Stretch> {
        let known = self.criticality();
        let mut stretches =
            vec![Stretch { criticality: known.first().copied().flatten(), places: Vec::new() }];
        for (i, (point, criticality)) in self.points.iter().zip(known).enumerate() {
            let between = self.special.iter().filter(|special| special.after == i).map(|special| special.at);
            let Some(stretch) = stretches.last_mut() else { break };
            let before = stretch.places.last().copied();
            if criticality == stretch.criticality {
                stretch.places.extend(between.chain([point.at]));
            } else {
                stretch.places.extend(between);
                let begin = stretch.places.last().copied().or(before).unwrap_or(point.at);
                stretches.push(Stretch { criticality, places: vec![begin, point.at] });
            }
        }
        stretches
    }

    /// Starts of the curves of other kinds that pass, or end in, this one's points of codimension two.
    pub fn branches(&self) -> Vec<Start> {
        self.special.iter().filter_map(|point| self.branch(point)).collect()
    }

    fn branch(&self, point: &SpecialPoint) -> Option<Start> {
        use Instability::{Fold, NeimarkSacker, PeriodDoubling};
        let either = |a: Instability, b: Instability| if self.kind == a { b } else { a };
        let kind = match point.kind {
            SpecialKind::OneToOne => either(Fold, NeimarkSacker),
            SpecialKind::OneToTwo => either(PeriodDoubling, NeimarkSacker),
            SpecialKind::FoldFlip => either(Fold, PeriodDoubling),
            SpecialKind::FoldNeimarkSacker => either(Fold, NeimarkSacker),
            SpecialKind::FlipNeimarkSacker => either(PeriodDoubling, NeimarkSacker),
            _ => return None,
        };
        Some(Start { kind, periods: self.periods, at: point.at, state: point.state.clone() })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stretches_meet_in_special_points() {
        let point = |x: f64, coefficient| CurvePoint {
            at: [x, 0.0],
            state: vec![],
            measures: Measures::default(),
            coefficient,
        };
        let turn = SpecialPoint {
            kind: SpecialKind::GeneralizedPeriodDoubling,
            at: [1.5, 0.0],
            state: vec![],
            multipliers: vec![],
            coefficient: Some(0.0),
            after: 2,
        };
        let curve = Curve {
            kind: Instability::PeriodDoubling,
            periods: 1,
            points: vec![point(0.0, None), point(1.0, Some(-1.0)), point(2.0, Some(1.0)), point(3.0, None)],
            origin: 0,
            special: vec![turn],
            ends: [CurveEnd::Window, CurveEnd::Window],
        };
        let stretch = |criticality, places: &[f64]| Stretch {
            criticality: Some(criticality),
            places: places.iter().map(|x| [*x, 0.0]).collect(),
        };
        let expected = [
            stretch(Criticality::Subcritical, &[0.0, 1.0, 1.5]),
            stretch(Criticality::Supercritical, &[1.5, 2.0, 3.0]),
        ];
        assert_eq!(curve.stretches(), expected);
        let folds = Curve { kind: Instability::Fold, ..curve };
        assert_eq!(folds.stretches().len(), 1);
        assert_eq!(Criticality::of(Instability::NeimarkSacker, -1.0), Some(Criticality::Supercritical));
    }

    #[test]
    fn a_curve_round_trips_through_json() -> Result<(), serde_json::Error> {
        let (at, state) = ([8.1, 0.01], vec![0.1, -0.2, 0.3]);
        let multipliers = vec![[-1.0, 0.0], [0.3, 0.4]];
        let measures = Measures { v_rms: 1.5, tip: (-0.1, 0.2), ..Default::default() };
        let curve = Curve {
            kind: Instability::PeriodDoubling,
            periods: 1,
            points: vec![CurvePoint { at, state: state.clone(), measures, coefficient: Some(-0.25) }],
            origin: 0,
            special: vec![SpecialPoint {
                kind: SpecialKind::OneToTwo,
                at,
                state,
                multipliers,
                coefficient: None,
                after: 1,
            }],
            ends: [CurveEnd::Window, CurveEnd::Lost { reason: "the magnets touch".into() }],
        };
        assert_eq!(serde_json::from_str::<Curve>(&serde_json::to_string(&curve)?)?, curve);
        Ok(())
    }
}
