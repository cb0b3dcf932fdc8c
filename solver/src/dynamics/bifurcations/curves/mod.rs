//! Curves of bifurcations of periodic orbits in the plane of any two parameters.
//!
//! * [`Start`], [`Curve`]: what goes in and comes out.
//! * [`trace_curve`] follows one curve: `surface` is the surface of orbits over the plane with the curve's direction on
//!   it, `condition` and `normal_form` the scalars that vanish on the curve and at its special points, `station` what is
//!   read at a point, `between` what a test may do between two, `locate` finds the special points there.
//! * [`find_curves`] finds the curves of a window, or its parts do: [`search_lines`], [`bifurcations_along_line`],
//!   [`KnownCurves`].

mod between;
mod condition;
mod curve;
mod known;
mod locate;
mod normal_form;
mod search;
mod station;
mod surface;
mod tracer;

pub use curve::{Criticality, Curve, CurveEnd, CurvePoint, SpecialKind, SpecialPoint, Start, Stretch};
pub use known::KnownCurves;
pub use normal_form::normal_form;
pub use search::{Line, Search, Survey, bifurcations_along_line, find_curves, search_lines};
pub use tracer::trace_curve;
