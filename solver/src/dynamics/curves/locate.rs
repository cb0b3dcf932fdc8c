//! Locating the points of codimension two between two stations of a curve, and where the curve ends in one.

use nalgebra::{Complex, DVector};

use super::curve::SpecialKind;
use super::station::{Station, cubic};
use super::tracer::Tracer;
use crate::dynamics::bracket::root;
use crate::dynamics::{Instability, OrbitError};

/// Accuracy of a located point, in units of the gap and of the window.
const LOCATED: f64 = 1e-10;
/// Length of a cusp's heading over that of the station before, beyond which the curve only turned.
const STANDSTILL: f64 = 1e-2;
/// Value of a test at a located zero over those beside it, beyond which it jumped.
const VANISHED: f64 = 1e-2;
/// Beyond this cosine of its angle a pair is real to the accuracy of a located point.
const REAL: f64 = 1.0 - 1e-8;

/// Difference between an orbit and itself half a period later, in units of the gap, below which the place where it
/// vanishes is extrapolated.
const HALF_APART: f64 = 0.03;
/// Stations from which it is.
pub(super) const KNOWN: usize = 4;
/// Distance of a multiplier of the half orbit there from -1 that confirms it.
const CONFIRMED: f64 = 1e-3;

impl Tracer<'_> {
    /// The point between two stations in which the pair of a Neimark-Sacker curve becomes real, if there.
    pub(super) fn terminal(
        &mut self,
        here: &Station,
        next: &Station,
    ) -> Result<Option<(SpecialKind, Station)>, OrbitError> {
        let cosine = next.condition.cosine;
        if here.condition.kind == Instability::NeimarkSacker && cosine.abs() > 1.0 {
            let kind = if cosine > 0.0 { SpecialKind::OneToOne } else { SpecialKind::OneToTwo };
            let station = if here.condition.cosine.abs() >= REAL {
                here.clone()
            } else {
                self.between(here, next, |station| test(station, kind))?
            };
            return Ok(Some((kind, station)));
        }
        Ok(None)
    }

    /// The point ahead of `here` in which the orbit becomes one of half its period, if it is near.
    ///
    /// The orbit and itself half a period later lie on the curve with the same parameters, which are therefore even
    /// functions of the difference between the two, as is their mean: both are extrapolated from the stations on the
    /// way there. On the curve itself the condition of a fold vanishes with the square of the difference.
    pub(super) fn halved(&mut self, past: &[Station], here: &Station) -> Option<(SpecialKind, Station)> {
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
        let half = self.half_multipliers(&place).ok()?;
        let doubles = half.iter().any(|mu| (mu + 1.0).norm() < CONFIRMED);
        let kind = match here.condition.kind {
            Instability::Fold => SpecialKind::GeneralizedPeriodDoubling,
            _ if here.condition.cosine > 0.5 => SpecialKind::OneToTwo,
            _ => SpecialKind::FlipNeimarkSacker,
        };
        doubles.then(|| (kind, here.clone().moved(&self.surface, place)))
    }

    /// Multipliers over half the period of the orbit at `place`.
    fn half_multipliers(&mut self, place: &DVector<f64>) -> Result<Vec<Complex<f64>>, OrbitError> {
        let family = &mut self.surface.family;
        family.set(family.values(place))?;
        let (state, beta) = (family.state(place), family.beta());
        family.solver.evaluate_at(&state, beta, family.periods / 2)?;
        family.solver.multipliers()
    }

    /// The points of codimension two between two stations, in order. One that cannot be located is left out.
    pub(super) fn specials(&mut self, here: &Station, next: &Station) -> Vec<(SpecialKind, Station)> {
        let mut found: Vec<(SpecialKind, Station)> = Vec::new();
        let torus = here.condition.kind == Instability::NeimarkSacker;
        for (kind, value) in here.tests.clone() {
            // Where its pair becomes real a Neimark-Sacker curve ends.
            let ends = torus && matches!(kind, SpecialKind::OneToOne | SpecialKind::OneToTwo);
            if ends || (value < 0.0) == (test(next, kind) < 0.0) {
                continue;
            }
            let largest = value.abs().max(test(next, kind).abs());
            if let Ok(station) = self.between(here, next, |station| test(station, kind))
                && test(&station, kind).abs() < VANISHED * largest
                && here.condition.confirms(kind, &station.multipliers)
            {
                found.push((kind, station));
            }
        }
        if here.condition.kind == Instability::Fold && here.turn(next) < 0.0 {
            let cusp = self.between(here, next, |station| here.turn(station));
            let length = |station: &Station| station.heading()[0].hypot(station.heading()[1]);
            if let Ok(station) = cusp
                && length(&station) < STANDSTILL * length(here).max(length(next))
            {
                found.push((SpecialKind::Cusp, station));
            }
        }
        let ahead = |station: &Station| (&station.place - &here.place).dot(&here.direction.tangent);
        found.sort_by(|a, b| ahead(&a.1).total_cmp(&ahead(&b.1)));
        found
    }

    /// The station between two others where `test` vanishes, which it has with opposite signs.
    fn between(
        &mut self,
        here: &Station,
        next: &Station,
        test: impl Fn(&Station) -> f64,
    ) -> Result<Station, OrbitError> {
        let chord: DVector<f64> = &next.place - &here.place;
        let length = chord.norm();
        let normal = chord / length;
        let mut last = here.clone();
        root((0.0, test(here)), (1.0, test(next)), LOCATED / length, |fraction| {
            last = self.land(here, &cubic(here, next, fraction), &normal)?;
            Ok::<f64, OrbitError>(test(&last))
        })?;
        Ok(last)
    }
}

/// The test for `kind` at a station; one that it does not have never changes its sign.
fn test(station: &Station, kind: SpecialKind) -> f64 {
    station.tests.iter().find(|(other, _)| *other == kind).map_or(1.0, |(_, value)| *value)
}
