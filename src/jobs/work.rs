//! Pieces of work: what a study hands out, and what comes back. Page and workers send them to each other in a plain
//! binary form, which costs the page a quarter of the code that JSON would.

use serde::{Deserialize, Serialize};

use super::design::{DesignFinding, DesignWork};
use super::inspection::{Inspection, inspect};
use super::motions::MotionPlane;
use super::response::{ResponseCurve, response};
use crate::dynamics::attractors::signature::Signature;
use crate::dynamics::attractors::sweep::{Dwell, SweepCourse, SweepPoint, sweep};
use crate::dynamics::bifurcations::curves::{Curve, Line, Start, bifurcations_along_line, trace_curve};
use crate::dynamics::bifurcations::tongue::{Tongue, Window};
use crate::dynamics::{Plane, largest_multipliers, trace_tongue};
use crate::model::{Parameter, Shaking};
use crate::scenario::Scenario;
use crate::theory::Resonance;

/// A piece of work, done within a fraction of a second unless named otherwise.
#[derive(Debug, Clone, PartialEq, nanoserde::SerBin, nanoserde::DeBin)]
pub enum Work {
    /// Any request of the native command; it may take long.
    Answer {
        /// The request as JSON.
        request: String,
    },
    /// The exact border of a tongue; excitation and start of the scenario play no role.
    Tongue {
        /// The device.
        scenario: Scenario,
        /// Which tongue.
        resonance: Resonance,
        /// How far it is followed.
        window: Window,
    },
    /// Columns of a chart of the forced motion's largest multiplier.
    Columns {
        /// The device.
        scenario: Scenario,
        /// One frequency a column.
        omegas: Vec<f64>,
        /// Ascending excitation amplitudes, the same for each column.
        betas: Vec<f64>,
    },
    /// Neighbouring values of a sweep.
    Sweep {
        /// The device, and the start when `state` is absent.
        scenario: Scenario,
        /// What is swept.
        parameter: Parameter,
        /// How the base is shaken meanwhile.
        shaking: Shaking,
        /// Its values in the order in which they are visited.
        values: Vec<f64>,
        /// State carried over from the value before (length 2N + 1).
        state: Option<Vec<f64>>,
        /// How long each value is held.
        dwell: Dwell,
    },
    /// Cells of a chart of the motion reached.
    Motions {
        /// The plane they lie in.
        plane: MotionPlane,
        /// Their two coordinates.
        places: Vec<[f64; 2]>,
    },
    /// Response curves of periodic motions.
    Response {
        /// The device and its other numbers.
        scenario: Scenario,
        /// What changes.
        parameter: Parameter,
        /// How the base is shaken meanwhile.
        shaking: Shaking,
        /// Its lowest and highest value.
        range: (f64, f64),
    },
    /// The verdict on the motion that a scenario leads to.
    Inspect {
        /// Everything about it.
        scenario: Scenario,
    },
    /// Bifurcations of the forced motion along a line across a plane of two parameters.
    Line {
        /// The device and its other numbers.
        scenario: Scenario,
        /// The window.
        plane: Plane,
        /// The line.
        line: Line,
    },
    /// A piece of the design bench.
    Design(DesignWork),
    /// A curve of bifurcations.
    Trace {
        /// The device and its other numbers.
        scenario: Scenario,
        /// The window.
        plane: Plane,
        /// A point of it.
        start: Start,
    },
}

/// What a piece of work found.
#[derive(Debug, Clone, PartialEq, nanoserde::SerBin, nanoserde::DeBin)]
pub enum Finding {
    /// The answer as JSON.
    Answer(String),
    /// The tongue, if there is one within the window.
    Tongue(Option<Tongue>),
    /// The columns asked for.
    Columns(Vec<Column>),
    /// The values asked for, and the state in which the last one ended.
    Sweep {
        /// One a value.
        points: Vec<SweepPoint>,
        /// State to go on from (length 2N + 1); absent when the motion ended early.
        state: Option<Vec<f64>>,
    },
    /// The motion at each place; none without a device, or where it cannot be integrated.
    Motions(Vec<Option<Signature>>),
    /// The branches found.
    Response(Vec<ResponseCurve>),
    /// Verdict and evidence.
    Inspection(Box<Inspection>),
    /// The bifurcations on a line.
    Starts(Vec<Start>),
    /// What the design bench asked for.
    Design(DesignFinding),
    /// A whole curve.
    Curve(Box<Curve>),
}

/// Largest multipliers along a column of a chart, absent from where the forced motion cannot be followed.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, nanoserde::SerBin, nanoserde::DeBin)]
pub struct Column {
    /// Modulus of each (dimensionless).
    pub modulus: Vec<Option<f64>>,
    /// Absolute argument of each (radians): 0 at a fold, pi at a period doubling, between them a pair.
    pub argument: Vec<Option<f64>>,
}

impl Work {
    /// Does the work.
    ///
    /// # Errors
    /// One sentence that says what is out of range or cannot be computed.
    pub fn carry_out(&self) -> Result<Finding, String> {
        match self {
            Self::Answer { request } => super::solve(request).map(Finding::Answer),
            Self::Tongue { scenario, resonance, window } => {
                let (system, _) = scenario.validate().map_err(sentence)?;
                trace_tongue(&system, *resonance, *window).map(Finding::Tongue).map_err(sentence)
            }
            Self::Columns { scenario, omegas, betas } => {
                let (system, _) = scenario.validate().map_err(sentence)?;
                let column = |omega: &f64| {
                    let values = largest_multipliers(&system, *omega, betas).map_err(sentence)?;
                    Ok(Column {
                        modulus: values.iter().map(|value| value.map(|mu| mu.norm())).collect(),
                        argument: values.iter().map(|value| value.map(|mu| mu.arg().abs())).collect(),
                    })
                };
                omegas.iter().map(column).collect::<Result<_, String>>().map(Finding::Columns)
            }
            Self::Sweep { scenario, parameter, shaking, values, state, dwell } => {
                let (_, start) = scenario.validate().map_err(sentence)?;
                let course = SweepCourse {
                    set: &scenario.parameters,
                    model: scenario.model,
                    parameter: *parameter,
                    shaking: *shaking,
                    start: &start,
                    dwell: *dwell,
                };
                let (points, state) = sweep(course, values, state.as_deref()).map_err(sentence)?;
                Ok(Finding::Sweep { points, state })
            }
            Self::Motions { plane, places } => plane.motions(places).map(Finding::Motions).map_err(sentence),
            Self::Response { scenario, parameter, shaking, range } => {
                response(scenario, (*parameter, *shaking), *range).map(Finding::Response).map_err(sentence)
            }
            Self::Inspect { scenario } => {
                inspect(scenario).map(|found| Finding::Inspection(Box::new(found))).map_err(sentence)
            }
            Self::Design(work) => work.carry_out().map(Finding::Design).map_err(sentence),
            Self::Line { scenario, plane, line } => {
                let (system, _) = scenario.validate().map_err(sentence)?;
                bifurcations_along_line(&system, plane, *line, false).map(Finding::Starts).map_err(sentence)
            }
            Self::Trace { scenario, plane, start } => {
                let (system, _) = scenario.validate().map_err(sentence)?;
                let curve = trace_curve(&system, start, plane).map_err(sentence)?;
                Ok(Finding::Curve(Box::new(curve)))
            }
        }
    }
}

fn sentence(error: impl std::fmt::Display) -> String {
    error.to_string()
}
