//! The motions that many starts or devices lead to: cells of a chart in the plane of any two coordinates.

use serde::{Deserialize, Serialize};

use super::response::check_range;
use crate::dynamics::attractors::signature::Signature;
use crate::dynamics::{ESCAPE_DISPLACEMENT, Effort, IntegrationError, Settler};
use crate::model::layers::LayerNumber;
use crate::model::{Dimension, ModelError, Parameter, ReducedSystem, Units, state_dimension};
use crate::scenario::{Scenario, counted};
use crate::scheduler::mosaic::Place;
use crate::scheduler::{Failure, Piece};
use crate::spacing::between;

/// Largest modal velocity that a start may have (dimensionless): that of the fastest mode with the largest displacement.
const MOST_VELOCITY: f64 = 1e4;
/// Largest voltage that a start may have (V), as in a scenario.
const MOST_VOLTAGE: f64 = 1e6;

/// What changes along a side of a chart.
#[derive(
    Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize, nanoserde::SerBin, nanoserde::DeBin,
)]
#[serde(rename_all = "snake_case")]
pub enum Coordinate {
    /// One of the ten numbers.
    Parameter(Parameter),
    /// A dimension of the device in SI units; the other dimensions are kept, and so the ten numbers follow.
    Dimension(Dimension),
    /// A number of the device's layers, which decide the dimensions that follow from them.
    Layer(LayerNumber),
    /// A component of the state at t = 0: q_1..q_N, dq_1/dt..dq_N/dt, v by index from 0.
    Start(usize),
}

impl Coordinate {
    /// Its name, for a model of `modes` modes.
    pub fn name(self, modes: usize) -> String {
        match self {
            Self::Parameter(parameter) => parameter.field().to_owned(),
            Self::Dimension(dimension) => dimension.field().to_owned(),
            Self::Layer(number) => number.field().to_owned(),
            Self::Start(i) if i < modes => format!("q{}", i + 1),
            Self::Start(i) if i < 2 * modes => format!("dq{}/dt", i + 1 - modes),
            Self::Start(_) => "v".to_owned(),
        }
    }

    /// The coordinate of that name, if a model of `modes` modes has it.
    pub fn named(name: &str, modes: usize) -> Option<Self> {
        let start = (0..state_dimension(modes)).map(Self::Start).find(|start| start.name(modes) == name);
        start
            .or_else(|| Parameter::named(name).map(Self::Parameter))
            .or_else(|| Dimension::named(name).map(Self::Dimension))
            .or_else(|| LayerNumber::named(name).map(Self::Layer))
    }

    /// Lowest and highest value on it: the own range of a parameter or a dimension; ten beam lengths for a displacement,
    /// beyond which every motion counts as escaped; the same for velocities, or more.
    pub fn limits(self, modes: usize) -> (f64, f64) {
        let most = match self {
            Self::Parameter(parameter) => return parameter.range(),
            Self::Dimension(dimension) => return dimension.range(),
            Self::Layer(number) => return number.range(),
            Self::Start(i) if i < modes => ESCAPE_DISPLACEMENT,
            Self::Start(i) if i < 2 * modes => MOST_VELOCITY,
            Self::Start(_) => MOST_VOLTAGE,
        };
        (-most, most)
    }

    /// Its value in `scenario`; `None` where that has no device.
    pub fn value(self, scenario: &Scenario) -> Option<f64> {
        match self {
            Self::Parameter(parameter) => Some(scenario.parameters.get(parameter)),
            Self::Dimension(dimension) => scenario.device().ok().map(|device| device.get(dimension)),
            Self::Layer(number) => scenario.device().ok()?.layers?.number(number),
            Self::Start(i) => scenario.initial.as_ref().map_or(Some(0.0), |start| start.get(i).copied()),
        }
    }

    /// Checks that a model of `modes` modes has it, and that `range` lies within its limits.
    ///
    /// # Errors
    /// [`ModelError`] naming what is out of range.
    pub fn check(self, modes: usize, range: (f64, f64)) -> Result<(), ModelError> {
        match self {
            Self::Parameter(parameter) => check_range(parameter, range),
            Self::Dimension(dimension) => {
                dimension.check(range.0)?;
                dimension.check(range.1)?;
                let highest = self.limits(modes).1;
                ModelError::check(dimension.field(), range.1, (range.0, highest), "").map(|_| ())
            }
            Self::Layer(number) => {
                ModelError::check(number.field(), range.0, number.range(), "")?;
                ModelError::check(number.field(), range.1, (range.0, number.range().1), "").map(|_| ())
            }
            Self::Start(value) => {
                let maximum = state_dimension(modes) - 1;
                counted("component of the start", value, (0, maximum))?;
                let (name, (minimum, maximum)) = (self.name(modes), self.limits(modes));
                ModelError::check(&name, range.0, (minimum, maximum), "")?;
                ModelError::check(&name, range.1, (range.0, maximum), "").map(|_| ())
            }
        }
    }
}

/// `scenario` with each of the `coordinates` at its value of `values`, one after the other.
///
/// # Errors
/// [`ModelError`] when there is no such device.
pub fn at_place(
    scenario: &Scenario,
    coordinates: &[Coordinate],
    values: &[f64],
) -> Result<Scenario, ModelError> {
    let mut scenario = scenario.clone();
    for (coordinate, value) in coordinates.iter().zip(values) {
        match *coordinate {
            Coordinate::Parameter(parameter) => *scenario.parameters.get_mut(parameter) = *value,
            Coordinate::Dimension(dimension) => {
                let device = scenario.device()?.with(dimension, *value);
                scenario.set_device(device, scenario.scaling)?;
            }
            Coordinate::Layer(number) => {
                let device = scenario.device()?;
                let missing = || ModelError::NoLayer { field: number.field() };
                let mut layers = device.layers.ok_or_else(missing)?;
                *layers.number_mut(number).ok_or_else(missing)? = *value;
                layers.check()?;
                scenario.set_device(device.with_layers(layers), scenario.scaling)?;
            }
            Coordinate::Start(i) => {
                let modes = scenario.model.modes;
                coordinate.check(modes, (*value, *value))?;
                scenario.initial.get_or_insert_with(|| vec![0.0; state_dimension(modes)])[i] = *value;
            }
        }
    }
    Ok(scenario)
}

/// Cells of a chart of the motion reached.
#[derive(Debug, Clone, PartialEq, nanoserde::SerBin, nanoserde::DeBin)]
pub struct Motions {
    /// The plane they lie in.
    pub plane: MotionPlane,
    /// Their two coordinates.
    pub places: Vec<[f64; 2]>,
}

impl Piece for Motions {
    const NAME: &'static str = "motions";
    /// The motion at each place; none without a device, or where it cannot be integrated.
    type Found = Vec<Option<Signature>>;

    fn carry_out(&self) -> Result<Self::Found, Failure> {
        self.plane.motions(&self.places)
    }
}

/// Columns and rows a chart may have.
pub const SIZES: (usize, usize) = (2, 512);

/// A plane of two coordinates through the numbers and the start of a scenario, as it is charted.
#[derive(Debug, Clone, PartialEq, nanoserde::SerBin, nanoserde::DeBin)]
pub struct MotionPlane {
    /// Device and start; of both, what the coordinates change plays no role.
    pub scenario: Scenario,
    /// What changes from column to column, with its value in the first and in the last one.
    pub x: (Coordinate, (f64, f64)),
    /// What changes from row to row, with its value in the first and in the last one.
    pub y: (Coordinate, (f64, f64)),
    /// Number of columns and rows.
    pub size: (usize, usize),
}

impl MotionPlane {
    /// Checks ranges and size.
    ///
    /// # Errors
    /// [`ModelError`] naming what is out of range.
    pub fn validate(&self) -> Result<(), ModelError> {
        self.scenario.validate()?;
        let modes = self.scenario.model.modes;
        for (coordinate, range) in [self.x, self.y] {
            coordinate.check(modes, range)?;
        }
        if self.x.0 == self.y.0 {
            return Err(ModelError::SameSides { field: self.x.0.name(modes) });
        }
        counted("columns", self.size.0, SIZES)?;
        counted("rows", self.size.1, SIZES)
    }

    /// The two coordinates of a cell.
    pub fn place(&self, (column, row): Place) -> [f64; 2] {
        [between(self.x.1, column, self.size.0), between(self.y.1, row, self.size.1)]
    }

    /// The SI units at a place, for watts and millimetres; `None` where there is no device.
    pub fn units(&self, place: Place) -> Option<Units> {
        let scenario = at_place(&self.scenario, &[self.x.0, self.y.0], &self.place(place)).ok()?;
        Some(scenario.units())
    }

    /// The motions reached at `places`; `None` where there is no device (the magnets leave no equilibrium, or buckle the
    /// beam) or where its motion cannot be integrated.
    ///
    /// # Errors
    /// One sentence when the scenario or a place is out of range.
    pub fn motions(&self, places: &[[f64; 2]]) -> Result<Vec<Option<Signature>>, Failure> {
        let (system, start) = self.scenario.validate()?;
        // Where only the start changes, all share the periodic motions that are found.
        let one_system = matches!((self.x.0, self.y.0), (Coordinate::Start(_), Coordinate::Start(_)));
        let mut settler = Settler::new(&system);
        let motion = |place: &[f64; 2]| self.motion(&system, &start, *place, (&mut settler, one_system));
        places.iter().map(motion).collect()
    }

    fn motion(
        &self,
        system: &ReducedSystem,
        start: &[f64],
        place: [f64; 2],
        (settler, one_system): (&mut Settler, bool),
    ) -> Result<Option<Signature>, Failure> {
        let mut set = self.scenario.parameters;
        let mut initial = start.to_vec();
        let sides = [self.x.0, self.y.0];
        let in_si = sides.iter().any(|side| matches!(side, Coordinate::Dimension(_) | Coordinate::Layer(_)));
        if in_si {
            // A sensible dimension may still make a number that the model does not take.
            match at_place(&self.scenario, &sides, &place) {
                Ok(scenario) => (set, initial) = (scenario.parameters, scenario.initial.unwrap_or(initial)),
                Err(_) => return Ok(None),
            }
        }
        for (coordinate, value) in sides.into_iter().zip(place).filter(|_| !in_si) {
            match coordinate {
                Coordinate::Parameter(parameter) => *set.get_mut(parameter) = value,
                Coordinate::Dimension(_) | Coordinate::Layer(_) => {}
                Coordinate::Start(i) => {
                    coordinate.check(self.scenario.model.modes, (value, value))?;
                    initial[i] = value;
                }
            }
        }
        let system = match system.with_numbers(set) {
            Err(ModelError::PullIn { .. } | ModelError::Buckled { .. }) => return Ok(None),
            Err(_) if in_si => return Ok(None),
            system => system?,
        };
        if !one_system {
            settler.turn_to(&system);
        }
        match settler.reach(&initial, Effort::cell()).map(Signature::of) {
            Err(IntegrationError::StepTooSmall { .. } | IntegrationError::TooManySteps { .. }) => Ok(None),
            found => Ok(Some(found?)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dynamics::Motion;
    use crate::model::ParameterSet;

    #[test]
    fn coordinates_have_names_and_limits() {
        for modes in 1..=8 {
            for i in 0..=2 * modes {
                let coordinate = Coordinate::Start(i);
                assert_eq!(Coordinate::named(&coordinate.name(modes), modes), Some(coordinate));
                assert!(coordinate.check(modes, (-1.0, 1.0)).is_ok());
            }
            assert!(Coordinate::Start(2 * modes + 1).check(modes, (-1.0, 1.0)).is_err());
        }
        assert_eq!(Coordinate::named("omega", 2), Some(Coordinate::Parameter(Parameter::Omega)));
        assert_eq!(Coordinate::named("q3", 2), None);
        assert!(Coordinate::Start(0).check(2, (0.0, f64::INFINITY)).is_err());
        let message = Coordinate::Start(2).check(2, (-1.0, 1e5)).map_err(|error| error.to_string());
        assert_eq!(message, Err("dq1/dt = 100000 is out of range: allowed are -1 to 10000".to_owned()));
    }

    #[test]
    fn a_place_without_a_device_is_none() {
        // Attracting magnets: pull-in for a small gap, an equilibrium for a wide one.
        let parameters = ParameterSet { c0: -0.5, d: 1.5, ..Default::default() };
        let plane = MotionPlane {
            scenario: Scenario { parameters, ..Default::default() },
            x: (Coordinate::Parameter(Parameter::D), (0.05, 1.5)),
            y: (Coordinate::Start(0), (0.0, 0.01)),
            size: (2, 2),
        };
        let found = plane.motions(&[[0.05, 0.0], [1.5, 0.0]]).expect("a valid plane");
        assert_eq!(found[0], None);
        let motion = found[1].as_ref().map(|signature| signature.cell.motion);
        assert_eq!(motion, Some(Motion::Periodic { periods: 1 }));
        assert!(plane.motions(&[[300.0, 0.0]]).is_err());
    }
}
