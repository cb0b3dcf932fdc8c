//! Differential evolution (Storn & Price 1997, rand/1/bin), in the unit cube, one generation at a time.
//!
//! Chosen because results of a nonlinear device jump where motions change their class, so that slopes mean nothing, and
//! because the candidates of a generation are independent. The random numbers of a generation are drawn when it is made,
//! in order, so that the course does not depend on who computes what first.

use fastrand::Rng;

/// Weight of the difference.
const WEIGHT: f64 = 0.7;
/// Probability that a candidate takes a coordinate from the mutant.
const CROSSING: f64 = 0.9;

/// A population and the candidates that challenge it.
#[derive(Debug, Clone)]
pub struct Evolution {
    random: Rng,
    population: Vec<Vec<f64>>,
    ranks: Vec<(f64, f64)>,
    trials: Vec<Vec<f64>>,
}

impl Evolution {
    /// `size` (at least 4) candidates spread over a cube of `dimension` sides: Latin hypercube sampling, and the
    /// `first` one where given.
    pub fn new(dimension: usize, size: usize, seed: u64, first: Option<Vec<f64>>) -> Self {
        let size = size.max(4);
        let mut random = Rng::with_seed(seed);
        let mut trials = vec![vec![0.0; dimension]; size];
        for axis in 0..dimension {
            let mut shares: Vec<usize> = (0..size).collect();
            random.shuffle(&mut shares);
            for (trial, share) in trials.iter_mut().zip(shares) {
                trial[axis] = (share as f64 + random.f64()) / size as f64;
            }
        }
        if let Some(first) = first {
            trials[0] = first;
        }
        Self { random, population: Vec::new(), ranks: Vec::new(), trials }
    }

    /// The candidates of this generation.
    pub fn trials(&self) -> &[Vec<f64>] {
        &self.trials
    }

    /// The members of the population that are best, at most `count`, each farther than `apart` (of the cube's side) from
    /// those before it, with their ranks.
    pub fn best(&self, count: usize, apart: f64) -> Vec<(Vec<f64>, (f64, f64))> {
        let mut order: Vec<usize> = (0..self.population.len()).collect();
        let by_rank = |i: usize| self.ranks[i];
        order.sort_by(|i, j| {
            let (a, b) = (by_rank(*i), by_rank(*j));
            b.0.total_cmp(&a.0).then(b.1.total_cmp(&a.1))
        });
        let mut chosen: Vec<(Vec<f64>, (f64, f64))> = Vec::new();
        for i in order {
            let member = &self.population[i];
            let distance =
                |other: &[f64]| member.iter().zip(other).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            if chosen.len() < count && chosen.iter().all(|(other, _)| distance(other) > apart) {
                chosen.push((member.clone(), self.ranks[i]));
            }
        }
        chosen
    }

    /// Takes the ranks of this generation's candidates, larger is better, and makes the next generation.
    pub fn advance(&mut self, ranks: &[(f64, f64)]) {
        let trials = std::mem::take(&mut self.trials);
        if self.population.is_empty() {
            self.population = trials;
            self.ranks = ranks.to_vec();
        } else {
            for (i, trial) in trials.into_iter().enumerate() {
                if ranks[i] >= self.ranks[i] {
                    self.population[i] = trial;
                    self.ranks[i] = ranks[i];
                }
            }
        }
        self.trials = (0..self.population.len()).map(|i| self.challenger(i)).collect();
    }

    fn challenger(&mut self, i: usize) -> Vec<f64> {
        let size = self.population.len();
        let mut others: [usize; 3] = [i; 3];
        for k in 0..3 {
            loop {
                let other = self.random.usize(..size);
                if other != i && !others[..k].contains(&other) {
                    others[k] = other;
                    break;
                }
            }
        }
        let dimension = self.population[i].len();
        let sure = self.random.usize(..dimension);
        let mut trial = self.population[i].clone();
        for (axis, value) in trial.iter_mut().enumerate() {
            let taken = self.random.f64() < CROSSING;
            if taken || axis == sure {
                let [a, b, c] = others.map(|other| self.population[other][axis]);
                let mutant = a + WEIGHT * (b - c);
                // What leaves the cube comes back halfway between its border and where it came from.
                *value = match mutant {
                    mutant if mutant < 0.0 => 0.5 * a,
                    mutant if mutant > 1.0 => 0.5 * (a + 1.0),
                    mutant => mutant,
                };
            }
        }
        trial
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn run(seed: u64) -> (Vec<f64>, f64) {
        // A narrow bent valley with its end at (0.7, 0.49), half of the cube forbidden.
        let rank = |x: &[f64]| {
            let value = -((0.7 - x[0]).powi(2) + 100.0 * (x[1] - x[0] * x[0]).powi(2));
            (-(x[0] - 0.75).max(0.0), value)
        };
        let mut evolution = Evolution::new(2, 20, seed, Some(vec![1.0, 1.0]));
        for _ in 0..80 {
            let ranks: Vec<_> = evolution.trials().iter().map(|trial| rank(trial)).collect();
            evolution.advance(&ranks);
            assert!(evolution.trials().iter().flatten().all(|x| (0.0..=1.0).contains(x)));
        }
        let (place, rank) = best(&evolution);
        (place.to_vec(), rank.1)
    }

    /// Best member and its rank.
    fn best(evolution: &Evolution) -> (&[f64], (f64, f64)) {
        let ranked = evolution.population.iter().zip(&evolution.ranks);
        let highest = ranked.max_by(|(_, a), (_, b)| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)));
        let (place, rank) = highest.expect("a population");
        (place, *rank)
    }

    #[test]
    fn the_bottom_of_a_valley_is_found_and_the_same_seed_goes_the_same_way() {
        for seed in 0..5 {
            let (place, value) = run(seed);
            assert!(value > -1e-5, "{seed}: {place:?} {value}");
            assert_eq!(run(seed), (place, value));
        }
        assert_ne!(run(1), run(2));
    }
}
