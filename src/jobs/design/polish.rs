//! The end of a search: from its best places on by a pattern search (Torczon, SIAM J. Optim. 7, 1997) whose directions
//! turn from round to round (as in Audet & Dennis, SIAM J. Optim. 17, 2006), so that a ridge along a limit is no trap.
//!
//! Each round tries a step forth and back along orthogonal directions about every centre; a better place is taken and
//! the step lengthened, otherwise it is shortened. In the unit cube; the trials of a round are independent.

use super::evolution::SplitMix;

/// First step, and the factors by which it grows and shrinks.
const FIRST_STEP: f64 = 0.04;
const LONGER: f64 = 1.6;
const SHORTER: f64 = 0.5;

/// A place that is improved.
#[derive(Debug, Clone)]
struct Centre {
    place: Vec<f64>,
    rank: (f64, f64),
    step: f64,
}

/// The centres and the places tried about them.
#[derive(Debug, Clone)]
pub struct Polish {
    random: SplitMix,
    centres: Vec<Centre>,
    round: usize,
    trials: Vec<Vec<f64>>,
}

impl Polish {
    /// From places in the cube with their ranks, larger is better; the same `seed` goes the same way.
    pub fn new(places: Vec<(Vec<f64>, (f64, f64))>, seed: u64) -> Self {
        let centre = |(place, rank)| Centre { place, rank, step: FIRST_STEP };
        let centres = places.into_iter().map(centre).collect();
        let mut polish = Self { random: SplitMix(!seed), centres, round: 0, trials: Vec::new() };
        polish.aim();
        polish
    }

    /// The places of this round.
    pub fn trials(&self) -> &[Vec<f64>] {
        &self.trials
    }

    /// Takes the ranks of this round's places, and makes the next round.
    pub fn advance(&mut self, ranks: &[(f64, f64)]) {
        let each = self.trials.len() / self.centres.len().max(1);
        let found = self.trials.chunks(each.max(1)).zip(ranks.chunks(each.max(1)));
        for (centre, (trials, ranks)) in self.centres.iter_mut().zip(found) {
            let before = centre.rank;
            for (trial, rank) in trials.iter().zip(ranks) {
                if *rank > centre.rank {
                    (centre.place, centre.rank) = (trial.clone(), *rank);
                }
            }
            centre.step *= if centre.rank > before { LONGER } else { SHORTER };
        }
        self.round += 1;
        self.aim();
    }

    fn aim(&mut self) {
        let dimension = self.centres.first().map_or(0, |centre| centre.place.len());
        let directions = self.directions(dimension);
        self.trials.clear();
        for centre in &self.centres {
            for direction in &directions {
                for sign in [1.0, -1.0] {
                    let moved = centre.place.iter().zip(direction);
                    let moved = moved.map(|(x, d)| (x + sign * centre.step * d).clamp(0.0, 1.0));
                    self.trials.push(moved.collect());
                }
            }
        }
    }

    /// Orthogonal unit vectors: the axes in even rounds, a random mirror image of them in odd ones.
    fn directions(&mut self, dimension: usize) -> Vec<Vec<f64>> {
        let mut normal: Vec<f64> = (0..dimension).map(|_| 2.0 * self.random.unit() - 1.0).collect();
        let length = normal.iter().map(|x| x * x).sum::<f64>().sqrt();
        let turned = self.round % 2 == 1 && length > 0.0;
        normal.iter_mut().for_each(|x| *x = if turned { *x / length } else { 0.0 });
        let mirrored = |i: usize| {
            (0..dimension).map(|j| f64::from(u8::from(i == j)) - 2.0 * normal[i] * normal[j]).collect()
        };
        (0..dimension).map(mirrored).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_corner_between_a_slope_and_a_limit_is_found() {
        // x + y is to be large below the line 3 x + y = 2 and on it best at its upper end, (1/3, 1).
        let rank = |x: &[f64]| (-(3.0 * x[0] + x[1] - 2.0).max(0.0), x[0] + x[1]);
        let start = vec![0.5, 0.4];
        let mut polish = Polish::new(vec![(start.clone(), rank(&start))], 3);
        for _ in 0..120 {
            let ranks: Vec<_> = polish.trials().iter().map(|trial| rank(trial)).collect();
            assert!(polish.trials().iter().flatten().all(|x| (0.0..=1.0).contains(x)));
            polish.advance(&ranks);
        }
        let found = &polish.centres[0];
        assert!(found.rank.0 == 0.0 && (found.rank.1 - 4.0 / 3.0).abs() < 1e-3, "{found:?}");
    }
}
