//! Differential evolution (Storn & Price 1997, rand/1/bin), in the unit cube, one generation at a time.
//!
//! Chosen because results of a nonlinear device jump where motions change their class, so that slopes mean nothing, and
//! because the candidates of a generation are independent. The random numbers of a generation are drawn when it is made,
//! in order, so that the course does not depend on who computes what first.

/// Weight of the difference.
const WEIGHT: f64 = 0.7;
/// Probability that a candidate takes a coordinate from the mutant.
const CROSSING: f64 = 0.9;

/// A population and the candidates that challenge it.
#[derive(Debug, Clone)]
pub struct Evolution {
    random: SplitMix,
    population: Vec<Vec<f64>>,
    ranks: Vec<(f64, f64)>,
    trials: Vec<Vec<f64>>,
}

impl Evolution {
    /// `size` (at least 4) candidates spread over a cube of `dimension` sides: Latin hypercube sampling, and the
    /// `first` one where given.
    pub fn new(dimension: usize, size: usize, seed: u64, first: Option<Vec<f64>>) -> Self {
        let size = size.max(4);
        let mut random = SplitMix(seed);
        let mut trials = vec![vec![0.0; dimension]; size];
        for axis in 0..dimension {
            let mut shares: Vec<usize> = (0..size).collect();
            for i in (1..size).rev() {
                shares.swap(i, random.below(i + 1));
            }
            for (trial, share) in trials.iter_mut().zip(shares) {
                trial[axis] = (share as f64 + random.unit()) / size as f64;
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
                let other = self.random.below(size);
                if other != i && !others[..k].contains(&other) {
                    others[k] = other;
                    break;
                }
            }
        }
        let dimension = self.population[i].len();
        let sure = self.random.below(dimension);
        let mut trial = self.population[i].clone();
        for (axis, value) in trial.iter_mut().enumerate() {
            let taken = self.random.unit() < CROSSING;
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

/// Steele, Lea & Flood's SplitMix64: eight lines that pass the usual tests, the same on every machine.
#[derive(Debug, Clone)]
pub(super) struct SplitMix(pub(super) u64);

impl SplitMix {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// In [0, 1).
    pub(super) fn unit(&mut self) -> f64 {
        (self.next() >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// In 0..count; the bias of the remainder is far below what a search can feel.
    fn below(&mut self, count: usize) -> usize {
        (self.next() % count.max(1) as u64) as usize
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
