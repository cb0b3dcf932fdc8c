//! Two tangent vectors carried along a motion by the exact derivative of each collocation step, and their growth
//! from one stroboscopic instant to the next.
//!
//! They are those of the stroboscopic map: the phase of the excitation is not varied, so that the exponent zero of
//! every flow, along its own direction, does not appear. At each instant they are made orthonormal again (Benettin,
//! Galgani, Giorgilli & Strelcyn, Meccanica 15, 1980, 9-20).

use crate::dynamics::integration::Step;
use crate::dynamics::integration::propagator::BLOCK;
use crate::dynamics::integration::rule::{NODES, NodeValues};
use crate::dynamics::integration::variation::Variation;
use crate::dynamics::orbits::period_map::scales;
use crate::model::{ReducedSystem, RestForce};

/// Number of tangent vectors: the second exponent tells a torus of two further frequencies from one.
pub(super) const VECTORS: usize = 2;

/// The tangent vectors of a motion and the logarithms of their growth.
pub(super) struct Tangents {
    force: RestForce,
    scales: Vec<f64>,
    /// Charge theta_n / c per displacement, without a load only: then c v - sum theta_n q_n is conserved, and the
    /// direction that changes it, whose exponent is always zero, is left out.
    charge: Option<Vec<f64>>,
    /// Extended by the variation of the excitation, which is zero: length 2N + 3.
    vectors: [Vec<f64>; VECTORS],
    end: Vec<f64>,
    begun: bool,
    resolved: bool,
    growth: [Vec<f64>; VECTORS],
}

impl Tangents {
    pub(super) fn new(system: &ReducedSystem) -> Self {
        let scales = scales(system);
        let capacitance = system.capacitance;
        let dimension = scales.len();
        let vector = |seed: f64| -> Vec<f64> {
            // Any directions will do that are not exactly those of a faster decay.
            let components =
                scales.iter().enumerate().map(|(i, scale)| scale * (seed * (i as f64 + 1.0)).cos());
            components.chain([0.0, 0.0]).collect()
        };
        let mut tangents = Self {
            force: system.rest_force(),
            charge: (system.parameters.kappa == 0.0)
                .then(|| system.theta.iter().map(|theta| theta / capacitance).collect()),
            vectors: [vector(0.7), vector(1.9)],
            end: vec![0.0; dimension.next_multiple_of(BLOCK)],
            begun: false,
            resolved: true,
            growth: Default::default(),
            scales,
        };
        tangents.orthonormalise();
        tangents
    }

    /// Takes an accepted step into account. Nothing is recorded before the first stroboscopic instant.
    pub(super) fn record(&mut self, step: &Step<'_>) {
        if step.index == 0 {
            let growth = self.orthonormalise();
            if self.begun {
                for (record, factor) in self.growth.iter_mut().zip(growth) {
                    record.push(factor.ln());
                }
            }
            self.begun = true;
        }
        let tables = step.tables;
        let slopes = self.force.slope_at(step.tip);
        let Some(variation) = Variation::new(&tables.tip.from_rest, &slopes) else {
            self.resolved = false;
            return;
        };
        let dimension = self.scales.len();
        let free = self.vectors.each_ref().map(|vector| tables.tip.free(vector));
        let mut solved: [[f64; VECTORS]; NODES] = std::array::from_fn(|l| free.map(|nodes| nodes[l]));
        variation.solve(&mut solved);
        for (k, vector) in self.vectors.iter_mut().enumerate() {
            let nodes: NodeValues = std::array::from_fn(|l| solved[l][k] * slopes[l]);
            tables.end(vector, &nodes, &mut self.end);
            vector[..dimension].copy_from_slice(&self.end[..dimension]);
        }
    }

    /// Whether every step could be differentiated.
    pub(super) fn resolved(&self) -> bool {
        self.resolved && self.growth[0].iter().all(|value| value.is_finite())
    }

    /// Logarithm of the growth of each vector in each excitation period so far.
    pub(super) fn growth(&self) -> &[Vec<f64>; VECTORS] {
        &self.growth
    }

    /// Makes the vectors orthonormal in scaled components and returns the lengths that were taken out.
    fn orthonormalise(&mut self) -> [f64; VECTORS] {
        let Self { vectors: [first, second], scales, charge, .. } = self;
        if let Some(charge) = charge {
            for vector in [&mut *first, &mut *second] {
                vector[scales.len() - 1] = charge.iter().zip(&*vector).map(|(charge, q)| charge * q).sum();
            }
        }
        let dot = |a: &[f64], b: &[f64]| -> f64 {
            a.iter().zip(b).zip(&*scales).map(|((a, b), scale)| (a / scale) * (b / scale)).sum()
        };
        let own = dot(first, first).sqrt();
        first.iter_mut().for_each(|value| *value /= own);
        let common = dot(second, first);
        second.iter_mut().zip(&*first).for_each(|(value, other)| *value -= common * other);
        let other = dot(second, second).sqrt();
        second.iter_mut().for_each(|value| *value /= other);
        [own, other]
    }
}
