//! One step of a run, as those see it who read the motion on the way.

use super::propagator::Propagator;
use super::rule::NodeValues;
use super::tables::StepTables;

/// One accepted step, shown to the observer of a run.
#[derive(Debug)]
pub struct Step<'a> {
    /// Time at the start of the step (dimensionless).
    pub time: f64,
    /// Extended state at the start: the state, then what generates the excitation (see [`super::linear`]).
    pub start: &'a [f64],
    /// R at the nodes.
    pub rest: &'a NodeValues,
    /// Tip displacement at the nodes, in beam lengths.
    pub tip: &'a NodeValues,
    /// The tables of this step's length.
    pub tables: &'a StepTables,
    /// The linear part's flow, for the motion within the step.
    pub propagator: &'a Propagator,
    /// Position within the excitation period, in steps of this length; 0 at t = 2 pi k / omega, where a run that began
    /// at a phase of its own has that phase again.
    pub index: usize,
}
