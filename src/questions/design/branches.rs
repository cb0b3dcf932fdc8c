//! The branches of periodic motions of a plant over frequency, each motion with its own dielectric loss.

use super::Plant;
use crate::dynamics::attractors::dielectric::orbit_with_loss;
use crate::dynamics::{BranchPoint, OrbitError};
use crate::model::Parameter;
use crate::questions::response::{DOUBLINGS, Followed, branches};

/// The forced motion of `plant` for omega (dimensionless) in `window`, and the doubled ones that leave it.
///
/// They are followed, and their changes of stability located, with the loss at the excitation's frequency, on which a
/// branch depends smoothly; where the voltage of a motion has its largest line elsewhere, that motion is computed again
/// with the loss there. It stays as it was where it does not exist with that loss, next to a fold.
///
/// # Errors
/// As [`branches`].
pub(in crate::questions) fn delivering_branches(
    plant: &Plant,
    window: (f64, f64),
) -> Result<Vec<Followed>, OrbitError> {
    let mut found = branches(&plant.scenario, (Parameter::Omega, plant.along), window, DOUBLINGS)?;
    let system = plant.scenario.model.system(plant.scenario.parameters)?;
    for Followed { branch, periods, .. } in &mut found {
        for point in &mut branch.points {
            let set = plant.along.at(&system.parameters, Parameter::Omega, point.value);
            let there = system.with_numbers(set)?;
            let Ok(Some((_, orbit))) = orbit_with_loss(&there, plant.along, (&point.state, *periods)) else {
                continue;
            };
            if orbit.periods == *periods {
                let (state, multipliers, measures) = (orbit.state, orbit.multipliers, orbit.measures);
                *point = BranchPoint { value: point.value, state, multipliers, measures };
            }
        }
    }
    Ok(found)
}
