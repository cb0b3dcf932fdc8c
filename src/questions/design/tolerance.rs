//! What the scatter of dimensions does to a device: sensitivities, and quasi-random samples.

use std::f64::consts::TAU;

use serde::{Deserialize, Serialize};

use super::harvest::{Lasting, sampled};
use super::materials::lowest_threshold;
use super::{DesignError, Plant};
use crate::dynamics::bifurcations::tongue::Window;
use crate::model::layers::LayerNumber;
use crate::model::{Dimension, Layers, ModelError};
use crate::questions::motions::{Coordinate, at_place};
use crate::scenario::Scenario;
use crate::theory::{Resonance, spectrum::frequencies};

/// Changes of a dimension for the differences, over its value: of a motion and of an eigenvalue, and of the tip of a
/// tongue, which is known less exactly.
const STEP: f64 = 1e-3;
const LONG_STEP: f64 = 5e-3;
/// Normal deviates are cut here: no workshop delivers what is farther out.
const MOST_DEVIATIONS: f64 = 3.0;

/// What a change of one dimension by a per cent does, in per cent; `None` where the motion changes its class or ends, or
/// there is no tongue.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, nanoserde::SerBin, nanoserde::DeBin)]
pub struct Lean {
    /// Of the mean power of the motion reached.
    pub power: Option<f64>,
    /// Of the first resonance frequency of the linear device with its circuit.
    pub frequency: Option<f64>,
    /// Of the lowest acceleration that opens the tongue.
    pub threshold: Option<f64>,
}

/// The dimensions of the device of `scenario` that can scatter: those that are there, without the excitation and without
/// constants of nature.
///
/// # Errors
/// [`ModelError`] when there is no device.
pub fn dimensions(scenario: &Scenario) -> Result<Vec<(Dimension, f64)>, ModelError> {
    use Dimension as D;
    let device = scenario.device()?;
    let magnets = scenario.parameters.c0 != 0.0;
    let of_magnets = [D::FluxDensity, D::MagnetLength, D::MagnetRadius, D::MagnetArea, D::MagnetDistance];
    let scatters = |dimension: &D| {
        let constant = matches!(dimension, D::BaseAmplitude | D::Frequency | D::Gravity | D::Permeability);
        !constant && (magnets || !of_magnets.contains(dimension))
    };
    let all = D::ALL.iter().copied().filter(scatters).map(|dimension| (dimension, device.get(dimension)));
    Ok(all.filter(|(_, value)| *value > 0.0 && value.is_finite()).collect())
}

/// The same as coordinates. What layers decide of a beam does not scatter by itself: their own numbers do.
///
/// # Errors
/// [`ModelError`] when there is no device.
pub fn coordinates(scenario: &Scenario) -> Result<Vec<(Coordinate, f64)>, ModelError> {
    let layers = scenario.device()?.layers;
    let itself = |dimension: &Dimension| layers.is_none() || !Layers::DECIDED.contains(dimension);
    let all = dimensions(scenario)?.into_iter().filter(|(dimension, _)| itself(dimension));
    let mut all: Vec<(Coordinate, f64)> =
        all.map(|(dimension, value)| (Coordinate::Dimension(dimension), value)).collect();
    let numbers = LayerNumber::ALL.iter().copied();
    let given = numbers.filter_map(|number| Some((number, layers?.number(number)?)));
    all.extend(
        given.filter(|(_, value)| *value != 0.0).map(|(number, value)| (Coordinate::Layer(number), value)),
    );
    Ok(all)
}

/// The motion that the start of `scenario` leads to.
fn motion(scenario: &Scenario) -> Result<Lasting, DesignError> {
    let plant = Plant::new(scenario)?;
    let (system, initial) = plant.scenario.validate()?;
    sampled(&plant, &system, &initial)
}

/// First resonance frequency (Hz) of the linear device with its circuit.
///
/// # Errors
/// [`DesignError`].
pub fn resonance_frequency(scenario: &Scenario) -> Result<Option<f64>, DesignError> {
    let plant = Plant::new(scenario)?;
    let frequencies = frequencies(&plant.system()?)?;
    Ok(frequencies.first().map(|lowest| plant.units.hertz(*lowest)))
}

/// Lowest acceleration of the base (peak g) that opens the tongue of `resonance`.
///
/// # Errors
/// [`DesignError`].
pub fn threshold(scenario: &Scenario, resonance: Resonance) -> Result<Option<f64>, DesignError> {
    let plant = Plant::new(scenario)?.in_tongue(resonance)?;
    let tip = lowest_threshold(&plant.system()?, resonance, Window::default().limit)?;
    Ok(tip.map(|tip| plant.units.acceleration(tip.beta, tip.omega)))
}

/// d ln f / d ln x by central differences: per cent per per cent.
fn elasticity(low: Option<f64>, high: Option<f64>, step: f64) -> Option<f64> {
    let (low, high) = (low.filter(|low| *low > 0.0)?, high.filter(|high| *high > 0.0)?);
    Some((high / low).ln() / ((1.0 + step) / (1.0 - step)).ln())
}

/// What one of the [`coordinates`] does to the device of `scenario`.
///
/// # Errors
/// [`DesignError`] when the device beside it is none.
pub fn lean(scenario: &Scenario, coordinate: Coordinate, resonance: Resonance) -> Result<Lean, DesignError> {
    let value = coordinate.value(scenario).unwrap_or(f64::NAN);
    let beside = |step: f64| {
        let place = [value * (1.0 + step)];
        at_place(scenario, &[coordinate], &place)
    };
    let (low, high) = (beside(-STEP)?, beside(STEP)?);
    let (a, b) = (motion(&low)?, motion(&high)?);
    let power = |motion: &Lasting| motion.harvest.map(|harvest| harvest.measures.power);
    let alike = a.motion.same_class(&b.motion);
    Ok(Lean {
        power: elasticity(power(&a), power(&b), STEP).filter(|_| alike),
        frequency: elasticity(resonance_frequency(&low)?, resonance_frequency(&high)?, STEP),
        threshold: elasticity(
            threshold(&beside(-LONG_STEP)?, resonance).ok().flatten(),
            threshold(&beside(LONG_STEP)?, resonance).ok().flatten(),
            LONG_STEP,
        ),
    })
}

/// The `index`-th of a sequence of points that fill the unit cube of so many dimensions evenly: the fractional parts of
/// multiples of 1/g, 1/g^2, .., g being the root of g^(d+1) = g + 1 (Roberts, "The unreasonable effectiveness of
/// quasirandom sequences", 2018; the golden ratio for d = 1).
pub fn evenly(index: usize, dimensions: usize) -> Vec<f64> {
    let mut root: f64 = 2.0;
    for _ in 0..64 {
        root = (1.0 + root).powf(1.0 / (dimensions as f64 + 1.0));
    }
    (1..=dimensions).map(|k| (0.5 + (index + 1) as f64 * root.powi(-(k as i32))).fract()).collect()
}

/// Normal deviates with mean 0 and standard deviation 1 in so many dimensions, the `index`-th of a sequence: by Box and
/// Muller's transform of [`evenly`] spread points, cut at three standard deviations.
pub fn deviates(index: usize, dimensions: usize) -> Vec<f64> {
    let uniform = evenly(index, dimensions.next_multiple_of(2));
    let pairs = uniform.chunks_exact(2).flat_map(|pair| {
        let radius = (-2.0 * pair[0].max(f64::MIN_POSITIVE).ln()).sqrt();
        let (sine, cosine) = (TAU * pair[1]).sin_cos();
        [radius * cosine, radius * sine]
    });
    pairs.take(dimensions).map(|deviate| deviate.clamp(-MOST_DEVIATIONS, MOST_DEVIATIONS)).collect()
}

/// How powers scatter (W).
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Distribution {
    /// Lowest.
    pub lowest: f64,
    /// Of which a twentieth are below.
    pub p5: f64,
    /// A quarter.
    pub p25: f64,
    /// Half.
    pub median: f64,
    /// Three quarters.
    pub p75: f64,
    /// Nineteen twentieths.
    pub p95: f64,
    /// Highest.
    pub highest: f64,
    /// Mean.
    pub mean: f64,
    /// Standard deviation.
    pub deviation: f64,
}

impl Distribution {
    /// Of ascending `values`; `None` when there are none.
    pub fn of(values: &[f64]) -> Option<Self> {
        let (first, last) = (*values.first()?, *values.last()?);
        let count = values.len() as f64;
        let quantile = |part: f64| {
            let place = part * (count - 1.0);
            let (below, share) = (place as usize, place.fract());
            let above = values[(below + 1).min(values.len() - 1)];
            values[below] + share * (above - values[below])
        };
        let mean = values.iter().sum::<f64>() / count;
        let square = values.iter().map(|value| (value - mean).powi(2)).sum::<f64>() / count;
        Some(Self {
            lowest: first,
            p5: quantile(0.05),
            p25: quantile(0.25),
            median: quantile(0.5),
            p75: quantile(0.75),
            p95: quantile(0.95),
            highest: last,
            mean,
            deviation: square.sqrt(),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::ElectricalScaling;
    use crate::questions::design::published::UNIMORPH;

    #[test]
    fn layers_scatter_in_place_of_what_they_decide_and_scale_as_plates_do() {
        // A plate alone: its frequency goes with every thickness together, with the root of every modulus over every density,
        // and not with its width, which scales all of it.
        let mut device = UNIMORPH.device();
        device.tip_mass = 0.0;
        device.resistance = 10.0;
        let mut scenario = Scenario::default();
        scenario.set_device(device, ElectricalScaling::Consistent).expect("a device");
        let all = coordinates(&scenario).expect("a device");
        assert!(all.iter().all(|(coordinate, _)| {
            !matches!(coordinate, Coordinate::Dimension(decided) if Layers::DECIDED.contains(decided))
        }));
        let frequency = |coordinate: Coordinate| {
            let value = coordinate.value(&scenario).expect("there");
            let at = |step: f64| {
                let moved = at_place(&scenario, &[coordinate], &[value * (1.0 + step)]).expect("a device");
                resonance_frequency(&moved).expect("a system")
            };
            elasticity(at(-STEP), at(STEP), STEP).expect("a frequency")
        };
        let sum = |part: &str| -> f64 {
            let these = all.iter().filter(|(coordinate, _)| coordinate.name(2).ends_with(part));
            these.map(|(coordinate, _)| frequency(*coordinate)).sum()
        };
        for (part, expected) in
            [(".thickness", 1.0), ("youngs_modulus", 0.5), (".density", -0.5), (".width", 0.0)]
        {
            let found = sum(part);
            assert!((found - expected).abs() < 1e-4, "{part}: {found}");
        }
        assert!((frequency(Coordinate::Dimension(Dimension::BeamLength)) + 2.0).abs() < 1e-4);
        // A glue that is not there cannot be changed.
        let glue = Coordinate::Layer(LayerNumber::EpoxyThickness);
        let refused = at_place(&scenario, &[glue], &[1e-5]).expect_err("no glue");
        assert_eq!(refused.to_string(), "layers.epoxy.thickness: the device has no such layer");
        assert_eq!(Coordinate::named("layers.epoxy.thickness", 2), Some(glue));
    }

    #[test]
    fn points_are_spread_evenly_and_deviates_are_normal() {
        // The mean of a product over the cube is 2^-d, to better than a random sample of 2048 would tell.
        for dimensions in [1, 2] {
            let product = |index| evenly(index, dimensions).iter().product::<f64>();
            let mean = (0..2048).map(product).sum::<f64>() / 2048.0;
            let error = mean * 2_f64.powi(dimensions as i32) - 1.0;
            assert!(error.abs() < 0.004, "{dimensions}: {error}");
        }
        // Shares of a half space in many dimensions, 0.3085 beyond half a deviation: over directions they are off by less
        // than those of random samples, 0.0204 for 512 of them.
        let points: Vec<Vec<f64>> = (0..512).map(|index| deviates(index, 16)).collect();
        let mut squares = 0.0;
        for j in 0..24 {
            let weight = |k: usize| (1.3 * f64::from(j) + 0.7 * (k + 1) as f64 * f64::from(j + 1)).cos();
            let size = (0..16).map(|k| weight(k).powi(2)).sum::<f64>().sqrt();
            let along = |z: &Vec<f64>| z.iter().enumerate().map(|(k, z)| weight(k) * z).sum::<f64>();
            let share = points.iter().filter(|z| along(z) > 0.5 * size).count() as f64 / 512.0;
            squares += (share - 0.308_54).powi(2);
        }
        assert!((squares / 24.0).sqrt() < 0.75 * 0.0204, "{squares}");
        let (count, dimensions) = (4096, 12);
        let mut sums = vec![[0.0; 3]; dimensions];
        let mut between: f64 = 0.0;
        for index in 0..count {
            let deviates = deviates(index, dimensions);
            between += deviates[0] * deviates[1] + deviates[2] * deviates[7];
            for (sums, z) in sums.iter_mut().zip(&deviates) {
                sums[0] += z;
                sums[1] += z * z;
                sums[2] += z.powi(4);
            }
        }
        let count = count as f64;
        // Cut at 3 the variance of a normal deviate is 0.9951 - and the fourth moment 2.81, by its integrals.
        for [first, second, fourth] in sums {
            assert!((first / count).abs() < 0.02, "{first}");
            assert!((second / count - 0.995).abs() < 0.03, "{second}");
            assert!((fourth / count - 2.85).abs() < 0.25, "{fourth}");
        }
        assert!((between / count).abs() < 0.06);
    }

    #[test]
    fn quantiles_are_those_of_equally_spaced_values() {
        let values: Vec<f64> = (0..=100).map(f64::from).collect();
        let found = Distribution::of(&values).expect("values");
        assert_eq!((found.p5, found.p25, found.median, found.p95), (5.0, 25.0, 50.0, 95.0));
        assert!((found.deviation - (850.0_f64).sqrt()).abs() < 1e-9);
        assert_eq!(Distribution::of(&[]), None);
    }
}
