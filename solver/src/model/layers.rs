//! A beam from its layers: standard laminate theory (Erturk & Inman, J. Vib. Acoust. 130, 041002, 2008, for the unimorph;
//! Smart Mater. Struct. 18, 025009, 2009, for bimorphs), with the electrodes over the whole length.

use nanoserde::{DeBin, SerBin};
use serde::{Deserialize, Serialize};

use super::substances::{SUBSTANCES, Substance, clamped_permittivity};
use super::{Device, Dimension, ElectricalScaling, ModelError};

/// Thickness of a ceramic (m), of what may be left out, and the width of a beam (m).
const THICKNESS: (f64, f64) = (1e-9, 1.0);
const THICKNESS_OR_NONE: (f64, f64) = (0.0, 1.0);
const WIDTH: (f64, f64) = (1e-6, 10.0);
const MODULUS: (f64, f64) = (1e3, 1e13);
const DENSITY: (f64, f64) = (0.0, 1e5);
const D31: (f64, f64) = (-1e-6, 1e-6);
const PERMITTIVITY: (f64, f64) = (1e-15, 1e-3);
/// Relative differences that the way through the dimensionless numbers leaves.
const ROUNDING: f64 = 1e-9;

/// Where the ceramic is, and how its plates are connected.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, SerBin, DeBin)]
#[serde(rename_all = "snake_case")]
pub enum Arrangement {
    /// One plate, on one side of the substrate.
    Unimorph,
    /// A plate on each side, connected in series: their voltages add.
    Series,
    /// A plate on each side, connected in parallel: their charges add.
    Parallel,
}

impl Arrangement {
    /// All three.
    pub const ALL: [Self; 3] = [Self::Unimorph, Self::Series, Self::Parallel];
}

/// A layer that only bends.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, SerBin, DeBin)]
#[serde(try_from = "SheetGiven")]
pub struct Sheet {
    /// Thickness (m).
    pub thickness: f64,
    /// Young's modulus (Pa).
    pub youngs_modulus: f64,
    /// Density (kg/m^3).
    pub density: f64,
}

/// A plate of ceramic.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, SerBin, DeBin)]
#[serde(try_from = "PlateGiven")]
pub struct Plate {
    /// Thickness (m).
    pub thickness: f64,
    /// Young's modulus along the beam at constant field (Pa).
    pub youngs_modulus: f64,
    /// Density (kg/m^3).
    pub density: f64,
    /// Piezoelectric constant d31 (m/V); its sign plays no role.
    pub d31: f64,
    /// Permittivity eps33 at constant strain (F/m).
    pub permittivity: f64,
}

impl Plate {
    /// No plate, to be completed.
    pub const THIN: Self =
        Self { thickness: 0.0, youngs_modulus: 0.0, density: 0.0, d31: 0.0, permittivity: 0.0 };
}

/// The section of a beam: a substrate with ceramic on one side or on both, glued or not.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, SerBin, DeBin)]
#[serde(deny_unknown_fields)]
pub struct Layers {
    /// Where the ceramic is.
    pub arrangement: Arrangement,
    /// Width of the beam (m).
    pub width: f64,
    /// What the ceramic is glued to.
    pub substrate: Sheet,
    /// Each plate of ceramic.
    pub ceramic: Plate,
    /// Each layer of glue between the two, where it counts.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub epoxy: Option<Sheet>,
}

/// Each number's place in a request's device, and lowest and highest value in SI units.
macro_rules! layer_numbers {
    ($($(#[doc = $doc:literal])+ $name:ident $field:literal in $range:ident,)*) => {
        /// One number of a section, by which devices scatter or a search goes.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize, SerBin, DeBin)]
        #[serde(rename_all = "snake_case")]
        pub enum LayerNumber {
            $($(#[doc = $doc])+ $name,)*
        }

        impl LayerNumber {
            /// All of them, in the order of a request.
            pub const ALL: &[Self] = &[$(Self::$name),*];

            const fn row(self) -> (&'static str, (f64, f64)) {
                match self {
                    $(Self::$name => ($field, $range),)*
                }
            }
        }
    };
}
layer_numbers! {
    /// Width of the beam.
    Width "layers.width" in WIDTH,
    /// Thickness of the substrate.
    SubstrateThickness "layers.substrate.thickness" in THICKNESS_OR_NONE,
    /// Its modulus.
    SubstrateModulus "layers.substrate.youngs_modulus" in MODULUS,
    /// Its density.
    SubstrateDensity "layers.substrate.density" in DENSITY,
    /// Thickness of each plate of ceramic.
    CeramicThickness "layers.ceramic.thickness" in THICKNESS,
    /// Its modulus.
    CeramicModulus "layers.ceramic.youngs_modulus" in MODULUS,
    /// Its density.
    CeramicDensity "layers.ceramic.density" in DENSITY,
    /// Its piezoelectric constant.
    D31 "layers.ceramic.d31" in D31,
    /// Its permittivity.
    Permittivity "layers.ceramic.permittivity" in PERMITTIVITY,
    /// Thickness of each layer of glue.
    EpoxyThickness "layers.epoxy.thickness" in THICKNESS_OR_NONE,
    /// Its modulus.
    EpoxyModulus "layers.epoxy.youngs_modulus" in MODULUS,
    /// Its density.
    EpoxyDensity "layers.epoxy.density" in DENSITY,
}

impl LayerNumber {
    /// Its place in a request's device.
    pub const fn field(self) -> &'static str {
        self.row().0
    }

    /// Lowest and highest value (SI).
    pub const fn range(self) -> (f64, f64) {
        self.row().1
    }

    /// The one at this place of a request's device.
    pub fn named(field: &str) -> Option<Self> {
        Self::ALL.iter().copied().find(|number| number.field() == field)
    }
}

impl Layers {
    /// One of its numbers (SI); none of a glue that is not there.
    pub fn number_mut(&mut self, number: LayerNumber) -> Option<&mut f64> {
        use LayerNumber as N;
        Some(match number {
            N::Width => &mut self.width,
            N::SubstrateThickness => &mut self.substrate.thickness,
            N::SubstrateModulus => &mut self.substrate.youngs_modulus,
            N::SubstrateDensity => &mut self.substrate.density,
            N::CeramicThickness => &mut self.ceramic.thickness,
            N::CeramicModulus => &mut self.ceramic.youngs_modulus,
            N::CeramicDensity => &mut self.ceramic.density,
            N::D31 => &mut self.ceramic.d31,
            N::Permittivity => &mut self.ceramic.permittivity,
            N::EpoxyThickness => &mut self.epoxy.as_mut()?.thickness,
            N::EpoxyModulus => &mut self.epoxy.as_mut()?.youngs_modulus,
            N::EpoxyDensity => &mut self.epoxy.as_mut()?.density,
        })
    }

    /// One of its numbers (SI); none of a glue that is not there.
    pub fn number(mut self, number: LayerNumber) -> Option<f64> {
        self.number_mut(number).copied()
    }
}

/// What a layer of a section is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LayerKind {
    /// The substrate.
    Substrate,
    /// Glue.
    Epoxy,
    /// Ceramic.
    Ceramic,
}

/// A layer in its place.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Layer {
    /// What it is.
    pub kind: LayerKind,
    /// Height of its lower face over that of the beam (m).
    pub from: f64,
    /// That of its upper face (m).
    pub to: f64,
    modulus: f64,
    density: f64,
}

impl Layer {
    fn thickness(&self) -> f64 {
        self.to - self.from
    }

    fn middle(&self) -> f64 {
        0.5 * (self.from + self.to)
    }
}

/// What layers decide of a device, all in SI units.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Laminate {
    /// Young's modulus (Pa) that gives a uniform beam of the same outline the bending stiffness E I of the layers.
    pub youngs_modulus: f64,
    /// Second moment of area of the outline, b h^3/12 (m^4).
    pub second_moment: f64,
    /// Mass of the beam (kg).
    pub beam_mass: f64,
    /// Capacitance between the terminals at constant strain (F).
    pub capacitance: f64,
    /// Bending moment a volt between the terminals gives (N m/V): for the consistent scaling.
    pub coupling: f64,
}

impl Layers {
    /// The dimensions of a device that layers decide.
    pub const DECIDED: [Dimension; 6] = [
        Dimension::YoungsModulus,
        Dimension::SecondMoment,
        Dimension::BeamMass,
        Dimension::Capacitance,
        Dimension::Coupling,
        Dimension::CeramicThickness,
    ];
    /// The scaling under which they give the coupling.
    pub const SCALING: ElectricalScaling = ElectricalScaling::Consistent;

    /// Plates whose voltages add between the terminals.
    pub fn plates_in_series(&self) -> u8 {
        if self.arrangement == Arrangement::Series { 2 } else { 1 }
    }

    /// The layers from the bottom to the top.
    pub fn stack(&self) -> Vec<Layer> {
        let (substrate, plate) = (&self.substrate, &self.ceramic);
        let substrate =
            (LayerKind::Substrate, substrate.thickness, substrate.youngs_modulus, substrate.density);
        let ceramic = (LayerKind::Ceramic, plate.thickness, plate.youngs_modulus, plate.density);
        let glue =
            self.epoxy.map(|glue| (LayerKind::Epoxy, glue.thickness, glue.youngs_modulus, glue.density));
        let mut kinds = Vec::with_capacity(5);
        if self.arrangement != Arrangement::Unimorph {
            kinds.push(ceramic);
            kinds.extend(glue);
        }
        kinds.push(substrate);
        kinds.extend(glue);
        kinds.push(ceramic);
        let mut height = 0.0;
        let placed = kinds.into_iter().map(|(kind, thickness, modulus, density)| {
            let from = height;
            height += thickness;
            Layer { kind, from, to: height, modulus, density }
        });
        placed.collect()
    }

    /// Height of the neutral axis over the lower face (m): where bending neither stretches nor shortens.
    pub fn neutral_axis(&self) -> f64 {
        neutral_axis(&self.stack())
    }

    /// What the layers give a beam of the length `length` (m).
    pub fn laminate(&self, length: f64) -> Laminate {
        let stack = self.stack();
        let axis = neutral_axis(&stack);
        let stiffness: f64 = stack
            .iter()
            .map(|layer| {
                let thickness = layer.thickness();
                let lever = layer.middle() - axis;
                layer.modulus * (thickness.powi(3) / 12.0 + thickness * lever * lever)
            })
            .sum();
        let area_density: f64 = stack.iter().map(|layer| layer.density * layer.thickness()).sum();
        let height = stack.last().map_or(0.0, |top| top.to);
        let second_moment = self.width * height.powi(3) / 12.0;
        // A volt on a plate is a moment e31 b z, z being the distance of the plate's middle from the neutral axis.
        let plates = || stack.iter().filter(|layer| layer.kind == LayerKind::Ceramic);
        let stress = self.ceramic.d31.abs() * self.ceramic.youngs_modulus * self.width;
        let moment: f64 = plates().map(|plate| stress * (plate.middle() - axis).abs()).sum();
        let plate_capacitance = self.ceramic.permittivity * self.width * length / self.ceramic.thickness;
        let count = plates().count() as f64;
        // In series a volt of the terminals is shared by the plates, which carry one charge.
        let (coupling, capacitance) = match self.arrangement {
            Arrangement::Series => (moment / count, plate_capacitance / count),
            Arrangement::Unimorph | Arrangement::Parallel => (moment, plate_capacitance * count),
        };
        Laminate {
            youngs_modulus: self.width * stiffness / second_moment,
            second_moment,
            beam_mass: self.width * length * area_density,
            capacitance,
            coupling,
        }
    }

    /// Checks every number against the range in which it makes sense.
    ///
    /// # Errors
    /// [`ModelError::OutOfRange`] or [`ModelError::NotFinite`] for the first that fails.
    pub fn check(&self) -> Result<(), ModelError> {
        ModelError::check("layers.width", self.width, WIDTH, " m")?;
        let Plate { thickness, youngs_modulus, density, d31, permittivity } = self.ceramic;
        let ceramic = Sheet { thickness, youngs_modulus, density };
        self.substrate.check("layers.substrate", THICKNESS_OR_NONE)?;
        ceramic.check("layers.ceramic", THICKNESS)?;
        ModelError::check("layers.ceramic.d31", d31, D31, " m/V")?;
        ModelError::check("layers.ceramic.permittivity", permittivity, PERMITTIVITY, " F/m")?;
        self.epoxy.map_or(Ok(()), |epoxy| epoxy.check("layers.epoxy", THICKNESS_OR_NONE))
    }
}

fn neutral_axis(stack: &[Layer]) -> f64 {
    let (mut stiffness, mut moment) = (0.0, 0.0);
    for layer in stack {
        let membrane = layer.modulus * layer.thickness();
        stiffness += membrane;
        moment += membrane * layer.middle();
    }
    moment / stiffness
}

impl Sheet {
    fn check(&self, name: &str, thickness: (f64, f64)) -> Result<(), ModelError> {
        let named = |field: &str| format!("{name}.{field}");
        ModelError::check(&named("thickness"), self.thickness, thickness, " m")?;
        ModelError::check(&named("youngs_modulus"), self.youngs_modulus, MODULUS, " Pa")?;
        ModelError::check(&named("density"), self.density, DENSITY, " kg/m^3")?;
        Ok(())
    }
}

impl Device {
    /// The same device with the section `layers`, which decide its E, I, m_b, C_eq, Theta and ceramic's thickness.
    #[must_use]
    pub fn with_layers(&self, layers: Layers) -> Self {
        let Laminate { youngs_modulus, second_moment, beam_mass, capacitance, coupling } =
            layers.laminate(self.beam_length);
        let ceramic_thickness = layers.ceramic.thickness;
        Self {
            youngs_modulus,
            second_moment,
            beam_mass,
            capacitance,
            coupling,
            ceramic_thickness,
            layers: Some(layers),
            ..*self
        }
    }

    /// The same device with another value of a dimension. Layers follow a new length; one that they decide is theirs no
    /// more, and the device then keeps what they gave it otherwise.
    #[must_use]
    pub fn with(&self, dimension: Dimension, value: f64) -> Self {
        let mut device = *self;
        *device.get_mut(dimension) = value;
        if Layers::DECIDED.contains(&dimension) {
            device.layers = None;
        }
        match device.layers {
            Some(layers) if dimension == Dimension::BeamLength => device.with_layers(layers),
            _ => device,
        }
    }

    /// The same device without its layers if they do not give what it has.
    #[must_use]
    pub(super) fn with_layers_that_hold(&self) -> Self {
        let holds = |layers: &Layers| {
            let given = self.with_layers(*layers);
            Layers::DECIDED.into_iter().all(|dimension| {
                let (a, b) = (self.get(dimension), given.get(dimension));
                (a - b).abs() <= ROUNDING * b.abs()
            })
        };
        Self { layers: self.layers.filter(holds), ..*self }
    }

    /// What layers decide, of a device with or without them.
    pub fn laminate(&self) -> Laminate {
        let &Self { youngs_modulus, second_moment, beam_mass, capacitance, coupling, .. } = self;
        Laminate { youngs_modulus, second_moment, beam_mass, capacitance, coupling }
    }
}

/// A sheet as it is written: a material may stand for its numbers, and those given beside it count.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct SheetGiven {
    thickness: f64,
    material: Option<String>,
    youngs_modulus: Option<f64>,
    density: Option<f64>,
}

/// The same of a plate.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct PlateGiven {
    thickness: f64,
    material: Option<String>,
    youngs_modulus: Option<f64>,
    density: Option<f64>,
    d31: Option<f64>,
    permittivity: Option<f64>,
    permittivity_at_constant_stress: Option<f64>,
}

/// The material of this name.
fn substance(name: Option<&str>, piezoelectric: bool) -> Result<Option<&'static Substance>, String> {
    let Some(name) = name else { return Ok(None) };
    let suits = |substance: &&Substance| !piezoelectric || substance.piezoelectric.is_some();
    Substance::named(name).filter(suits).map(Some).ok_or_else(|| {
        let names: Vec<_> = SUBSTANCES.iter().filter(suits).map(|substance| substance.name).collect();
        format!("the material is not available: allowed are {}", names.join(", "))
    })
}

fn needed(field: &str, given: Option<f64>, usual: Option<f64>) -> Result<f64, String> {
    given.or(usual).ok_or_else(|| format!("`{field}` is missing: give it, or a material"))
}

impl TryFrom<SheetGiven> for Sheet {
    type Error = String;

    fn try_from(given: SheetGiven) -> Result<Self, String> {
        let material = substance(given.material.as_deref(), false)?;
        Ok(Self {
            thickness: given.thickness,
            youngs_modulus: needed(
                "youngs_modulus",
                given.youngs_modulus,
                material.map(|m| m.youngs_modulus),
            )?,
            density: needed("density", given.density, material.map(|m| m.density))?,
        })
    }
}

impl TryFrom<PlateGiven> for Plate {
    type Error = String;

    fn try_from(given: PlateGiven) -> Result<Self, String> {
        let material = substance(given.material.as_deref(), true)?;
        let piezoelectric = material.and_then(|material| material.piezoelectric);
        let youngs_modulus =
            needed("youngs_modulus", given.youngs_modulus, material.map(|m| m.youngs_modulus))?;
        let d31 = needed("d31", given.d31, piezoelectric.map(|p| p.d31))?;
        let permittivity = match (given.permittivity, given.permittivity_at_constant_stress) {
            (Some(_), Some(_)) => {
                return Err("give `permittivity` or `permittivity_at_constant_stress`, not both".to_owned());
            }
            (Some(clamped), None) => clamped,
            (None, free) => {
                let free = needed("permittivity", free, piezoelectric.map(|p| p.free_permittivity))?;
                clamped_permittivity(free, d31, youngs_modulus)
            }
        };
        Ok(Self {
            thickness: given.thickness,
            youngs_modulus,
            density: needed("density", given.density, material.map(|m| m.density))?,
            d31,
            permittivity,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::{ForceLaw, Parameters, ReducedSystem};

    /// Erturk & Inman's unimorph of 2008, 100 mm long.
    fn unimorph() -> Layers {
        Layers {
            arrangement: Arrangement::Unimorph,
            width: 0.02,
            substrate: Sheet { thickness: 5e-4, youngs_modulus: 100e9, density: 7165.0 },
            ceramic: Plate {
                thickness: 4e-4,
                youngs_modulus: 66e9,
                density: 7800.0,
                d31: -190e-12,
                permittivity: 15.93e-9,
            },
            epoxy: None,
        }
    }

    /// Their bimorph of 2009, 50.8 mm long.
    fn bimorph(arrangement: Arrangement) -> Layers {
        Layers {
            arrangement,
            width: 0.0318,
            substrate: Sheet { thickness: 1.4e-4, youngs_modulus: 105e9, density: 9000.0 },
            ceramic: Plate { thickness: 2.6e-4, permittivity: 13.28e-9, ..unimorph().ceramic },
            epoxy: None,
        }
    }

    fn close(value: f64, expected: f64, tolerance: f64) {
        assert!((value / expected - 1.0).abs() < tolerance, "{value} {expected}");
    }

    fn stiffness(found: &Laminate) -> f64 {
        found.youngs_modulus * found.second_moment
    }

    #[test]
    fn plates_in_series_bear_twice_the_voltage_of_one() {
        use crate::model::{Limits, materials::Ceramic};
        let of = |arrangement| {
            let device = Device { ceramic: Some(Ceramic::Apc855), ..Default::default() };
            Limits::of(&device.with_layers(bimorph(arrangement))).voltage.expect("published")
        };
        // The same beam moves alike with both, and each plate bears the same.
        let (parallel, series) = (of(Arrangement::Parallel), of(Arrangement::Series));
        assert_eq!((2.0 * parallel.0, 2.0 * parallel.1), series);
    }

    #[test]
    fn the_published_unimorph_and_bimorph_have_the_numbers_computed_by_hand() {
        let found = unimorph().laminate(0.1);
        for (value, expected) in [
            (stiffness(&found), 0.0978472),
            (found.beam_mass, 13.405e-3),
            (found.capacitance, 79.65e-9),
            (found.coupling, 7.3861e-5),
        ] {
            close(value, expected, 1e-5);
        }
        let found = bimorph(Arrangement::Series).laminate(0.0508);
        for (value, expected) in [
            (stiffness(&found), 0.0505666),
            (found.beam_mass, 8.58768e-3),
            (found.capacitance, 41.256e-9),
            (found.coupling, 7.97544e-5),
        ] {
            close(value, expected, 1e-5);
        }
    }

    #[test]
    fn a_section_of_one_material_is_a_plain_bar_however_it_is_cut() {
        for arrangement in Arrangement::ALL {
            let sheet = Sheet { thickness: 3e-4, youngs_modulus: 66e9, density: 7800.0 };
            let epoxy = Some(Sheet { thickness: 1e-4, ..sheet });
            let layers = Layers { arrangement, substrate: sheet, epoxy, ..unimorph() };
            let height = if arrangement == Arrangement::Unimorph { 8e-4 } else { 1.3e-3 };
            let found = layers.laminate(0.1);
            close(found.youngs_modulus, 66e9, 1e-12);
            close(found.second_moment, 0.02 * height * height * height / 12.0, 1e-12);
            close(found.beam_mass, 7800.0 * 0.02 * height * 0.1, 1e-12);
            close(layers.neutral_axis(), 0.5 * height, 1e-12);
        }
    }

    #[test]
    fn glue_moves_the_plates_away_from_the_neutral_axis() {
        // By hand, symmetric: E I = b [E_s h_s^3/12 + 2 E_g (h_g^3/12 + h_g y_g^2) + 2 E_p (h_p^3/12 + h_p y_p^2)].
        let epoxy = Sheet { thickness: 5e-5, youngs_modulus: 3e9, density: 1150.0 };
        let layers = Layers { epoxy: Some(epoxy), ..bimorph(Arrangement::Parallel) };
        let (y_g, y_p) = (0.07e-3 + 0.025e-3, 0.07e-3 + 0.05e-3 + 0.13e-3);
        let part = |modulus: f64, thickness: f64, y: f64| {
            2.0 * modulus * (thickness.powi(3) / 12.0 + thickness * y * y)
        };
        let substrate = 105e9 * 1.4e-4_f64.powi(3) / 12.0;
        let expected = 0.0318 * (substrate + part(3e9, 5e-5, y_g) + part(66e9, 2.6e-4, y_p));
        let found = layers.laminate(0.0508);
        close(stiffness(&found), expected, 1e-12);
        close(found.coupling, 2.0 * 190e-12 * 66e9 * 0.0318 * y_p, 1e-12);
        close(found.beam_mass, 8.58768e-3 + 2.0 * 1150.0 * 5e-5 * 0.0318 * 0.0508, 1e-5);
    }

    #[test]
    fn in_parallel_a_quarter_of_the_load_takes_the_same_power() -> Result<(), ModelError> {
        let power = |arrangement, resistance: f64| -> Result<f64, ModelError> {
            let plain = Device {
                beam_length: 0.0508,
                flux_density: 0.0,
                resistance,
                frequency: 46.0,
                ..Default::default()
            };
            let device = Device { tip_mass: 0.003, ..plain.with_layers(bimorph(arrangement)) };
            let parameters = Parameters::new(device.dimensionless(Layers::SCALING)?)?;
            let system = ReducedSystem::new(parameters, 3, ForceLaw::Exact)?;
            let response = crate::theory::LinearResponse::new(&system).expect("it is damped");
            Ok(response.voltage.norm_sqr() / resistance)
        };
        for resistance in [1e3, 35e3, 1e6] {
            let series = power(Arrangement::Series, resistance)?;
            close(power(Arrangement::Parallel, 0.25 * resistance)?, series, 1e-11);
        }
        Ok(())
    }

    #[test]
    fn layers_follow_the_length_and_end_where_a_number_of_theirs_is_changed() {
        let device = Device { beam_length: 0.1, ..Default::default() }.with_layers(unimorph());
        let longer = device.with(Dimension::BeamLength, 0.2);
        close(longer.beam_mass, 2.0 * device.beam_mass, 1e-15);
        close(longer.capacitance, 2.0 * device.capacitance, 1e-15);
        assert_eq!((longer.coupling, longer.layers), (device.coupling, device.layers));
        assert_eq!(device.with(Dimension::TipMass, 0.01).layers, device.layers);
        let other = device.with(Dimension::Capacitance, 1e-8);
        assert_eq!((other.layers, other.coupling), (None, device.coupling));
        assert_eq!(device.with_layers_that_hold(), device);
        assert_eq!(Device { coupling: 1e-5, ..device }.with_layers_that_hold().layers, None);
    }

    #[test]
    fn a_material_stands_for_its_numbers_and_what_is_missing_is_said() -> Result<(), serde_json::Error> {
        let plate: Plate =
            serde_json::from_str(r#"{"thickness":4e-4,"material":"PSI-5A4E","density":7700}"#)?;
        assert_eq!((plate.youngs_modulus, plate.density, plate.d31), (66e9, 7700.0, -190e-12));
        // epsT = 1800 eps0 = 15.94 nF/m, less d31^2 E = 2.38 nF/m.
        close(plate.permittivity, 13.5549e-9, 1e-5);
        let text = r#"{"thickness":4e-4,"material":"PSI-5A4E","permittivity_at_constant_stress":15.93e-9}"#;
        close(serde_json::from_str::<Plate>(text)?.permittivity, 15.93e-9 - 190e-12 * 190e-12 * 66e9, 1e-12);
        let sheet: Sheet = serde_json::from_str(r#"{"thickness":1e-4,"material":"brass"}"#)?;
        assert_eq!((sheet.youngs_modulus, sheet.density), (105e9, 9000.0));
        let wrong =
            |text| serde_json::from_str::<Plate>(text).err().map(|e| e.to_string()).unwrap_or_default();
        assert!(wrong(r#"{"thickness":1e-4,"material":"brass"}"#).contains("allowed are PZT-5A"));
        assert!(wrong(r#"{"thickness":1e-4,"d31":1e-10}"#).contains("`youngs_modulus` is missing"));
        let both = r#"{"thickness":1e-4,"material":"PVDF","permittivity":1e-8,"permittivity_at_constant_stress":1e-8}"#;
        assert!(wrong(both).contains("not both"));
        let layers = Layers { epoxy: Some(sheet), ..unimorph() };
        assert_eq!(serde_json::from_str::<Layers>(&serde_json::to_string(&layers)?)?, layers);
        Ok(())
    }

    #[test]
    fn a_number_out_of_range_is_named() {
        let message =
            |layers: Layers| layers.check().map_err(|error| error.to_string()).err().unwrap_or_default();
        assert!(unimorph().check().is_ok());
        let mut wrong = unimorph();
        wrong.ceramic.thickness = 0.0;
        assert_eq!(message(wrong), "layers.ceramic.thickness = 0 is out of range: allowed are 1e-9 to 1 m");
        // A constant-strain permittivity that is none: more coupling than the material could have.
        wrong = unimorph();
        wrong.ceramic.permittivity = clamped_permittivity(1e-9, -190e-12, 66e9);
        assert!(message(wrong).starts_with("layers.ceramic.permittivity = -"));
    }
}
