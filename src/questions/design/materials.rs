//! The ceramics of Table 2 in the place of the device's own, side by side (section 5.2).

use serde::{Deserialize, Serialize};

use super::harvest::{Lasting, lasting};
use super::linear::highest_place;
use super::{DesignError, Interval, Plant};
use crate::dynamics::bifurcations::tongue::{Tongue, TonguePoint, Window};
use crate::dynamics::{critical_excitation, trace_tongue};
use crate::model::materials::Ceramic;
use crate::model::{Limits, Parameters, ReducedSystem};
use crate::scenario::Scenario;
use crate::theory::Resonance;

/// Golden sections about the tip of a tongue: a bracket of a twentieth of the spacing shrinks to a millionth of it, and
/// beta depends on its square.
const SECTIONS: usize = 14;

/// The scenario with `ceramic` on its beam: the damping that gives mode `mode` (from 1) its quality factor (see
/// [`Ceramic::damping`]), and its dissipation factor as the device's loss tangent, which [`Plant`] makes a conductance
/// beside the load. Stiffness, mass, coupling and capacitance are left as they are: Table 2 gives none.
///
/// # Errors
/// [`DesignError::Mode`] without such a mode, and [`DesignError::Model`].
pub fn with_ceramic(scenario: &Scenario, ceramic: Ceramic, mode: usize) -> Result<Scenario, DesignError> {
    let (system, _) = scenario.validate()?;
    let modes = system.modes.len();
    let alpha = mode
        .checked_sub(1)
        .and_then(|index| ceramic.damping(&system, index))
        .ok_or(DesignError::Mode { mode, modes })?;
    let mut changed = scenario.clone();
    changed.parameters.alpha = alpha;
    Parameters::new(changed.parameters)?;
    let mut device = changed.device()?;
    (device.ceramic, device.loss_tangent) = (Some(ceramic), ceramic.material().dissipation_factor);
    changed.set_base(device, changed.scaling)?;
    Ok(changed)
}

/// A ceramic on the device.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, nanoserde::SerBin, nanoserde::DeBin)]
pub struct MaterialRow {
    /// The ceramic.
    pub ceramic: Ceramic,
    /// Damping alpha that it gives (dimensionless).
    pub alpha: f64,
    /// Dielectric conductance over that of the load (dimensionless); absent without a load.
    pub leakage: Option<f64>,
    /// Lowest excitation that makes the forced motion unstable in the resonance's way; `None` when there is none
    /// within the window.
    pub threshold: Option<Threshold>,
    /// Frequencies (Hz) between which the tongue is open at the scenario's own beta; none when beta is below it. A
    /// flank that leaves the window ends there.
    pub open: Option<Interval>,
    /// The motion that the scenario's start leads to.
    pub reached: Lasting,
    /// Range published for the largest voltage on the device's ceramic (V).
    pub voltage_limit: Option<(f64, f64)>,
}

/// The lowest point of a tongue.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, nanoserde::SerBin, nanoserde::DeBin)]
pub struct Threshold {
    /// Amplitude beta (dimensionless).
    pub beta: f64,
    /// Frequency (Hz).
    pub frequency: f64,
    /// Peak of the base's acceleration (g, of 9.80665 m/s^2).
    pub acceleration: f64,
}

/// The row of one ceramic, its quality factor given to mode `mode` (from 1).
///
/// # Errors
/// [`DesignError`].
pub fn material_row(
    scenario: &Scenario,
    ceramic: Ceramic,
    mode: usize,
    resonance: Resonance,
    window: Window,
) -> Result<MaterialRow, DesignError> {
    let scenario = with_ceramic(scenario, ceramic, mode)?;
    let plant = Plant::new(&scenario)?;
    let (system, initial) = plant.scenario.validate()?;
    let growing = plant.in_tongue(resonance)?.system()?;
    let tongue = trace_tongue(&growing, resonance, window)?;
    let units = &plant.units;
    let threshold = match &tongue {
        Some(tongue) => lowest(&growing, tongue, resonance, window)?.map(|tip| Threshold {
            beta: tip.beta,
            frequency: units.hertz(tip.omega),
            acceleration: units.acceleration(tip.beta, tip.omega),
        }),
        None => None,
    };
    let open = tongue.as_ref().and_then(|tongue| open_at(tongue, system.parameters.beta));
    Ok(MaterialRow {
        ceramic,
        alpha: system.parameters.alpha,
        leakage: (plant.load > 0.0).then(|| plant.leakage / plant.load),
        threshold,
        open: open.map(|(from, to)| Interval { from: units.hertz(from), to: units.hertz(to) }),
        reached: lasting(&plant, &system, &initial)?,
        voltage_limit: Limits::of(&scenario.base()).voltage,
    })
}

/// Half widths (dimensionless) of the windows in which the tip of a tongue is looked for: it is near the centre, and a
/// whole tongue takes much longer.
const SPANS: [f64; 3] = [0.03, 0.15, 0.6];

/// The lowest excitation up to `limit` that makes the forced motion of `system` unstable in the way of `resonance`;
/// `None` when there is none at its centre.
///
/// # Errors
/// As [`trace_tongue`].
pub fn lowest_threshold(
    system: &ReducedSystem,
    resonance: Resonance,
    limit: f64,
) -> Result<Option<TonguePoint>, DesignError> {
    let mut best = None;
    for span in SPANS {
        let window = Window { span, limit };
        let Some(tongue) = trace_tongue(system, resonance, window)? else { return Ok(None) };
        best = lowest(system, &tongue, resonance, window)?;
        let ends = [tongue.points.first(), tongue.points.last()];
        let at_end = |tip: TonguePoint| ends.iter().flatten().any(|end| **end == tip);
        if best.is_some_and(|tip| !at_end(tip)) {
            break;
        }
    }
    Ok(best)
}

/// The tip of a tongue, improved from its lowest point by the exact boundary between the neighbours.
///
/// # Errors
/// As [`critical_excitation`].
pub fn lowest(
    system: &ReducedSystem,
    tongue: &Tongue,
    resonance: Resonance,
    window: Window,
) -> Result<Option<TonguePoint>, DesignError> {
    let points = &tongue.points;
    let Some(place) = (0..points.len()).min_by(|i, j| points[*i].beta.total_cmp(&points[*j].beta)) else {
        return Ok(None);
    };
    if place == 0 || place + 1 == points.len() {
        return Ok(Some(points[place]));
    }
    let kind = Some(resonance.instability());
    let beta = |omega: f64| {
        let found = critical_excitation(system, omega, window.limit, kind);
        found.ok().and_then(|found| found.beta()).unwrap_or(f64::INFINITY)
    };
    // The points are close enough for a parabola to say where; a short golden section about it says it exactly.
    let (a, b, c) = (points[place - 1], points[place], points[place + 1]);
    let vertex = parabola_vertex(a, b, c);
    let reach = 0.05 * (c.omega - a.omega).abs();
    let omega = highest_place(|omega| -beta(omega), (vertex - reach, vertex + reach), SECTIONS);
    let found = TonguePoint { omega, beta: beta(omega) };
    Ok(Some(if found.beta < b.beta { found } else { b }))
}

/// Where the parabola through three points is lowest; the middle one where it has no such place between the others.
fn parabola_vertex(a: TonguePoint, b: TonguePoint, c: TonguePoint) -> f64 {
    let (left, right) = (b.omega - a.omega, b.omega - c.omega);
    let (to_left, to_right) = (b.beta - a.beta, b.beta - c.beta);
    let shift =
        0.5 * (left * left * to_right - right * right * to_left) / (left * to_right - right * to_left);
    let vertex = b.omega - shift;
    let between = (vertex - a.omega) * (vertex - c.omega) <= 0.0;
    if between { vertex } else { b.omega }
}

/// The frequencies (dimensionless) at which a tongue's flanks pass `beta`, by straight lines between its points; the
/// end of a flank where it ends below `beta`. `None` when the whole tongue is above.
pub fn open_at(tongue: &Tongue, beta: f64) -> Option<(f64, f64)> {
    let below: Vec<usize> = (0..tongue.points.len()).filter(|i| tongue.points[*i].beta <= beta).collect();
    let (first, last) = (*below.first()?, *below.last()?);
    let cut = |inside: usize, outside: Option<usize>| {
        let a = tongue.points[inside];
        outside
            .and_then(|i| tongue.points.get(i))
            .map_or(a.omega, |b| a.omega + (b.omega - a.omega) * (beta - a.beta) / (b.beta - a.beta))
    };
    let ends = (cut(first, first.checked_sub(1)), cut(last, Some(last + 1)));
    Some((ends.0.min(ends.1), ends.0.max(ends.1)))
}
