//! Materials requests: the ceramics of Table 2 on one device.

use serde::{Deserialize, Serialize};

use crate::dynamics::bifurcations::tongue::Window;
use crate::jobs::RequestError;
use crate::jobs::budget::Budget;
use crate::jobs::design::materials::MaterialRow;
use crate::jobs::study::complete_within;
use crate::jobs::study::table::Table;
use crate::jobs::tasks::device::ACCELERATION_UNIT;
use crate::scenario::Scenario;
use crate::theory::Resonance;

/// The ceramics side by side.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct MaterialsTask {
    /// The mode that gets the quality factor, from 1.
    pub mode: usize,
    /// Whose tongue is traced.
    pub resonance: Resonance,
    /// How far: `span` in omega, `limit` in beta.
    pub window: Window,
}

impl Default for MaterialsTask {
    fn default() -> Self {
        Self { mode: 1, resonance: Resonance::First, window: Window::default() }
    }
}

/// The ceramics side by side.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct MaterialsAnswer {
    /// What the accelerations of the thresholds count in.
    pub acceleration_unit: &'static str,
    /// One a row of Table 2.
    pub rows: Vec<NamedRow>,
}

/// A row with the ceramic's name.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct NamedRow {
    /// Trade name.
    pub name: &'static str,
    /// Mechanical quality factor.
    pub quality_factor: f64,
    /// Dielectric dissipation factor.
    pub dissipation_factor: f64,
    /// What it does to the device.
    #[serde(flatten)]
    pub row: MaterialRow,
}

impl MaterialsTask {
    pub(super) fn answer(
        &self,
        scenario: &Scenario,
        budget: &Budget<'_>,
    ) -> Result<MaterialsAnswer, RequestError> {
        let mut table = Table::materials(scenario, self.mode, self.resonance, self.window);
        complete_within(&mut table, budget);
        let rows = table.material_rows().flatten().map(|row| {
            let row = row.map_err(|message| RequestError::Study(message.to_owned()))?.clone();
            let material = row.ceramic.material();
            Ok(NamedRow {
                name: material.name,
                quality_factor: material.quality_factor,
                dissipation_factor: material.dissipation_factor,
                row,
            })
        });
        let rows = rows.collect::<Result<_, RequestError>>()?;
        Ok(MaterialsAnswer { acceleration_unit: ACCELERATION_UNIT, rows })
    }
}
