//! Locating the points of codimension two between two stations of a curve, and where the curve ends in one.

use nalgebra::{Complex, DVector};

use super::between::TestCourse;
use super::curve::SpecialKind;
use super::station::{Station, cubic};
use super::surface::Surface;
use crate::dynamics::bifurcations::bracket::root;
use crate::dynamics::orbits::{Instability, OrbitError};

/// Accuracy of a located point, in units of the gap and of the window.
const LOCATED: f64 = 1e-10;
/// Value of a test at a located zero over those beside it, beyond which it jumped.
const VANISHED: f64 = 1e-2;
/// Beyond this cosine of its angle a pair is real to the accuracy of a located point.
const REAL: f64 = 1.0 - 1e-8;
/// How often a step is divided in which a test may vanish unseen, or a zero cannot be reached.
const DEEPEST: usize = 5;
/// Where it is in the second case.
const DIVISIONS: [f64; 3] = [0.5, 0.25, 0.75];

/// Difference between an orbit and itself half a period later, in units of the gap, below which the place where it
/// vanishes is extrapolated.
const HALF_APART: f64 = 0.03;
/// Stations from which it is.
pub(super) const KNOWN: usize = 4;
/// Distance of a multiplier of the half orbit there from -1 that confirms it.
const CONFIRMED: f64 = 1e-3;

/// The point in which the pair of a Neimark-Sacker curve becomes real when it is `here` already.
pub(super) fn leaves(here: &Station, next: &Station) -> Option<(SpecialKind, Station)> {
    let cosine = next.condition.cosine;
    let leaves = here.condition.cosine.abs() >= REAL && cosine.abs() > 1.0;
    let kind = if cosine > 0.0 { SpecialKind::OneToOne } else { SpecialKind::OneToTwo };
    leaves.then(|| (kind, here.clone()))
}

/// The point ahead of `here` in which the orbit becomes one of half its period, if it is near.
///
/// The orbit and itself half a period later lie on the curve with the same parameters, which are therefore even
/// functions of the difference between the two, as is their mean: both are extrapolated from the stations on the
/// way there. On the curve itself the condition of a fold vanishes with the square of the difference.
pub(super) fn halved(
    surface: &mut Surface,
    past: &[Station],
    here: &Station,
) -> Option<(SpecialKind, Station)> {
    let known: Vec<(f64, DVector<f64>)> = past
        .iter()
        .chain([here])
        .filter_map(|station| {
            let halving = station.halving.as_ref()?;
            Some((halving.norm_squared(), &station.place + halving * 0.5))
        })
        .collect();
    let approaches = known.windows(2).all(|pair| pair[1].0 < pair[0].0);
    if known.len() < KNOWN || !approaches || known.last()?.0.sqrt() > HALF_APART {
        return None;
    }
    let mut place = DVector::zeros(here.place.len());
    for (i, (u, value)) in known.iter().enumerate() {
        let others = known.iter().enumerate().filter(|(j, _)| *j != i);
        let weight: f64 = others.map(|(_, (other, _))| other / (other - u)).product();
        place.axpy(weight, value, 1.0);
    }
    let half = half_multipliers(surface, &place).ok()?;
    let doubles = half.iter().any(|mu| (mu + 1.0).norm() < CONFIRMED);
    let kind = match here.condition.kind {
        Instability::Fold => SpecialKind::GeneralizedPeriodDoubling,
        _ if here.condition.cosine > 0.5 => SpecialKind::OneToTwo,
        _ => SpecialKind::FlipNeimarkSacker,
    };
    if !doubles {
        return None;
    }
    Some((kind, here.clone().moved(surface, place).ok()?))
}

/// Multipliers over half the period of the orbit at `place`.
fn half_multipliers(surface: &mut Surface, place: &DVector<f64>) -> Result<Vec<Complex<f64>>, OrbitError> {
    let family = &mut surface.family;
    family.set(family.values(place))?;
    let (state, beta) = (family.state(place), family.beta());
    family.solver.evaluate_at(&state, beta, family.periods / 2)?;
    family.solver.multipliers()
}

/// The points of codimension two between two stations, the one `before` being known, in order. Where a test may
/// vanish unseen, there is another station in between. A point that cannot be located is left out.
pub(super) fn specials(
    surface: &mut Surface,
    before: Option<&Station>,
    here: &Station,
    next: &Station,
    depth: usize,
) -> Vec<(SpecialKind, Station)> {
    // A curve that leaves the point in which it ends does not come to it, and one that ends on an orbit of half the
    // period stands still there.
    let leaves = here.condition.cosine.abs() >= REAL;
    let halved = here.halving.as_ref().is_some_and(|halving| halving.norm() < HALF_APART);
    let passed_over = |kind: SpecialKind| leaves && ends(here, kind) || halved && kind == SpecialKind::Cusp;
    let kinds = SpecialKind::ALL.into_iter().filter(|kind| !passed_over(*kind));
    let courses: Vec<(SpecialKind, TestCourse)> =
        kinds.filter_map(|kind| Some((kind, TestCourse::of(kind, before, here, next)?))).collect();
    let doubt = courses.iter().find_map(|(_, course)| course.doubt());
    if let Some(fraction) = doubt
        && let Some(found) = divided(surface, before, here, next, &[fraction], depth)
    {
        return found;
    }
    let mut found: Vec<(SpecialKind, Station)> = Vec::new();
    for (kind, course) in courses.into_iter().filter(|(_, course)| course.changes_sign()) {
        let size = |station: &Station| station.test(kind).map_or(0.0, f64::abs);
        match between(surface, here, next, kind, course.zero()) {
            Ok(station) => {
                if size(&station) < VANISHED * size(here).max(size(next))
                    && here.condition.confirms(kind, &station.multipliers)
                {
                    found.push((kind, station));
                }
            }
            // Nearer to a known station it may be found.
            Err(_) => {
                if let Some(found) = divided(surface, before, here, next, &DIVISIONS, depth) {
                    return found;
                }
            }
        }
    }
    let ahead = |station: &Station| (&station.place - &here.place).dot(&here.direction.tangent);
    found.sort_by(|a, b| ahead(&a.1).total_cmp(&ahead(&b.1)));
    found
}

/// The points of codimension two between two stations with another one between them, at the first of these
/// `fractions` of the way at which there is one; `None` when the step is divided enough.
fn divided(
    surface: &mut Surface,
    before: Option<&Station>,
    here: &Station,
    next: &Station,
    fractions: &[f64],
    depth: usize,
) -> Option<Vec<(SpecialKind, Station)>> {
    if depth == DEEPEST {
        return None;
    }
    let middle = fractions.iter().find_map(|fraction| at_fraction(surface, here, next, *fraction).ok())?;
    let mut found = specials(surface, before, here, &middle, depth + 1);
    found.extend(specials(surface, Some(here), &middle, next, depth + 1));
    Some(found)
}

/// The station at a `fraction` of the way between two others.
fn at_fraction(
    surface: &mut Surface,
    here: &Station,
    next: &Station,
    fraction: f64,
) -> Result<Station, OrbitError> {
    let place = place_between(surface, here, next, fraction)?;
    Station::read(surface, place, here.condition, Some(here))
}

/// The place on the curve at a `fraction` of the way between two stations.
fn place_between(
    surface: &mut Surface,
    here: &Station,
    next: &Station,
    fraction: f64,
) -> Result<DVector<f64>, OrbitError> {
    let normal = (&next.place - &here.place).normalize();
    let gradient = here.direction.gradient.lerp(&next.direction.gradient, fraction);
    surface.correct(&cubic(here, next, fraction), &normal, here.condition, &gradient)
}

/// The station between two others where the test for `kind`, which they have with opposite signs, vanishes: near
/// the fraction `guess` of the way.
fn between(
    surface: &mut Surface,
    here: &Station,
    next: &Station,
    kind: SpecialKind,
    guess: f64,
) -> Result<Station, OrbitError> {
    let ends = here.test(kind).zip(next.test(kind));
    let (first, last) = ends.ok_or(OrbitError::Singular)?;
    let tolerance = LOCATED / (&next.place - &here.place).norm();
    let mut found = here.place.clone();
    let mut value = |fraction: f64| {
        found = place_between(surface, here, next, fraction)?;
        here.test_beside(surface, &found, kind)
    };
    let middle = value(guess)?;
    let opposite = if (middle < 0.0) == (first < 0.0) { (1.0, last) } else { (0.0, first) };
    root(opposite, (guess, middle), tolerance, value)?;
    Station::read(surface, found, here.condition, Some(here))
}

/// Whether a curve ends in a point of this kind: one of Neimark-Sacker does where its pair becomes real.
pub(super) fn ends(station: &Station, kind: SpecialKind) -> bool {
    let real = matches!(kind, SpecialKind::OneToOne | SpecialKind::OneToTwo);
    real && station.condition.kind == Instability::NeimarkSacker
}
