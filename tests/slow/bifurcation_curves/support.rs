//! Devices, windows and the curves in them.

pub(crate) use crate::{Fallible, TestResult};
use harvester_lab::dynamics::bifurcations::curves::{Curve, Search, SpecialKind, SpecialPoint, find_curves};
use harvester_lab::dynamics::{Axis, Instability, Plane};
use harvester_lab::model::{ForceLaw, Parameter, ParameterSet, Parameters, ReducedSystem};

pub(crate) fn system(set: ParameterSet, law: ForceLaw) -> Fallible<ReducedSystem> {
    Ok(ReducedSystem::new(Parameters::new(set)?, 2, law)?)
}

pub(crate) fn mild(alpha: f64) -> ParameterSet {
    ParameterSet { alpha, ..Default::default() }
}

pub(crate) fn plane(first: (Parameter, (f64, f64)), second: (Parameter, (f64, f64))) -> Fallible<Plane> {
    Ok(Plane::new([first, second].map(|(parameter, range)| Axis { parameter, range }))?)
}

/// The plane of omega, within the range, and beta up to `limit`.
pub(crate) fn chart(omega: (f64, f64), limit: f64) -> Fallible<Plane> {
    plane((Parameter::Omega, omega), (Parameter::Beta, (0.0, limit)))
}

pub(crate) fn curves(system: &ReducedSystem, plane: &Plane) -> Fallible<Vec<Curve>> {
    Ok(find_curves(system, plane, Search::default())?.curves)
}

pub(crate) fn only(curves: Vec<Curve>) -> Fallible<Curve> {
    <[Curve; 1]>::try_from(curves).map(|[curve]| curve).map_err(|all| format!("{} curves", all.len()).into())
}

pub(crate) fn of_kind(curves: &[Curve], kind: Instability) -> Fallible<&Curve> {
    curves.iter().find(|curve| curve.kind == kind).ok_or_else(|| format!("no curve of {kind:?}").into())
}

pub(crate) fn special(curve: &Curve, kind: SpecialKind) -> Fallible<&SpecialPoint> {
    curve.special.iter().find(|point| point.kind == kind).ok_or_else(|| format!("no {kind}").into())
}

/// `system` at a point of `plane`.
pub(crate) fn at(system: &ReducedSystem, plane: &Plane, point: [f64; 2]) -> Fallible<ReducedSystem> {
    let mut set = *system.parameters;
    for (axis, value) in plane.axes().iter().zip(point) {
        *set.get_mut(axis.parameter) = value;
    }
    Ok(ReducedSystem::new(Parameters::new(set)?, system.modes.len(), system.law)?)
}

/// The curves near the second natural frequency, where the quadratic law's forced motion ends, at a load `kappa`.
pub(crate) fn bent_resonance(kappa: f64) -> Fallible<(ReducedSystem, Plane, Vec<Curve>)> {
    let system = system(ParameterSet { kappa, ..mild(1e-4) }, ForceLaw::Quadratic)?;
    let window = chart((20.5, 22.5), 0.04)?;
    let found = curves(&system, &window)?;
    Ok((system, window, found))
}
