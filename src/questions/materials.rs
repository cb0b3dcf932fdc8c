//! The ceramics of Table 2 on one device.

use nanoserde::{DeBin, SerBin};
use serde::{Deserialize, Serialize};

use super::design::materials::{MaterialRow, material_row};
use super::error::RequestError;
use super::question::Question;
use super::subject::ACCELERATION_UNIT;
use crate::dynamics::bifurcations::tongue::Window;
use crate::model::materials::Ceramic;
use crate::scenario::Scenario;
use crate::scheduler::{Budget, Failure, Piece, Table, complete_within};
use crate::theory::Resonance;

/// The ceramics side by side.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Materials {
    /// The mode that gets the quality factor, from 1.
    pub mode: usize,
    /// Whose tongue is traced.
    pub resonance: Resonance,
    /// How far: `span` in omega, `limit` in beta.
    pub window: Window,
}

impl Default for Materials {
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

impl Question for Materials {
    const TASK: &'static str = "materials";
    const TAKES: &'static [&'static str] = &["initial", "t_end"];
    const COUNTS_LOSS: bool = true;
    type Answer = MaterialsAnswer;

    fn answer(&self, scenario: Scenario, budget: &Budget<'_>) -> Result<MaterialsAnswer, RequestError> {
        scenario.validate()?;
        let mut table = self.table(&scenario);
        complete_within(&mut table, budget);
        let rows = table.found().flatten().map(|row| {
            let row = row.map_err(|failure| RequestError::Study(failure.to_string()))?.clone();
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

impl Materials {
    /// The ceramics of Table 2, in the order of [`Ceramic::ALL`], on the device of `scenario`.
    pub fn table(&self, scenario: &Scenario) -> Table<Fitted> {
        let Self { mode, resonance, window } = *self;
        let piece = |ceramic| Fitted { scenario: scenario.clone(), ceramic, mode, resonance, window };
        Table::new(Ceramic::ALL.map(piece).to_vec())
    }
}

/// A ceramic on the device.
#[derive(Debug, Clone, PartialEq, SerBin, DeBin)]
pub struct Fitted {
    /// The device.
    pub scenario: Scenario,
    /// The ceramic.
    pub ceramic: Ceramic,
    /// The mode that gets its quality factor, from 1.
    pub mode: usize,
    /// Whose tongue is traced.
    pub resonance: Resonance,
    /// Frequencies and excitations looked at.
    pub window: Window,
}

impl Piece for Fitted {
    const NAME: &'static str = "ceramic";
    type Found = MaterialRow;

    fn carry_out(&self) -> Result<MaterialRow, Failure> {
        Ok(material_row(&self.scenario, self.ceramic, self.mode, self.resonance, self.window)?)
    }
}
