//! The end of a search: from its best places on by a pattern search (Torczon, SIAM J. Optim. 7, 1997) whose directions
//! turn from round to round (as in Audet & Dennis, SIAM J. Optim. 17, 2006), so that a ridge along a limit is no trap.
//!
//! Each round tries a step forth and back along orthogonal directions about every centre; a better place is taken, the
//! step lengthened, and the same way tried again; where neither axes nor turned directions lead on it is shortened. In the unit cube; the trials of a round are independent.

use fastrand::Rng;

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
    /// Unit vector of the last move, while it still leads on: along a limit few directions do.
    onwards: Option<Vec<f64>>,
}

/// The centres and the places tried about them.
#[derive(Debug, Clone)]
pub struct Polish {
    random: Rng,
    centres: Vec<Centre>,
    round: usize,
    trials: Vec<Vec<f64>>,
}

impl Polish {
    /// From places in the cube with their ranks, larger is better; the same `seed` goes the same way.
    pub fn new(places: Vec<(Vec<f64>, (f64, f64))>, seed: u64) -> Self {
        let centre = |(place, rank)| Centre { place, rank, step: FIRST_STEP, onwards: None };
        let centres = places.into_iter().map(centre).collect();
        let mut polish = Self { random: Rng::with_seed(!seed), centres, round: 0, trials: Vec::new() };
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
            let (start, before) = (centre.place.clone(), centre.rank);
            for (trial, rank) in trials.iter().zip(ranks) {
                if *rank > centre.rank {
                    (centre.place, centre.rank) = (trial.clone(), *rank);
                }
            }
            if centre.rank > before {
                centre.step *= LONGER;
                centre.onwards = unit(centre.place.iter().zip(&start).map(|(a, b)| a - b).collect());
            } else if self.round % 2 == 1 {
                (centre.step, centre.onwards) = (SHORTER * centre.step, None);
            }
        }
        self.round += 1;
        self.aim();
    }

    fn aim(&mut self) {
        let dimension = self.centres.first().map_or(0, |centre| centre.place.len());
        let random: Vec<f64> = (0..dimension).map(|_| 2.0 * self.random.f64() - 1.0).collect();
        let turned = self.round % 2 == 1;
        self.trials.clear();
        for centre in &self.centres {
            for direction in &directions(if turned { Some(&random) } else { None }, centre, dimension) {
                for sign in [1.0, -1.0] {
                    let moved = centre.place.iter().zip(direction);
                    let moved = moved.map(|(x, d)| (x + sign * centre.step * d).clamp(0.0, 1.0));
                    self.trials.push(moved.collect());
                }
            }
        }
    }
}

/// Orthogonal unit vectors: the axes, or where the round is turned a mirror image of them, with the way onwards from
/// `centre` as the first if it has one, else by a `random` mirror.
fn directions(random: Option<&[f64]>, centre: &Centre, dimension: usize) -> Vec<Vec<f64>> {
    let axis = |i: usize, j: usize| f64::from(u8::from(i == j));
    let normal = random.and_then(|random| match &centre.onwards {
        // The mirror that takes the first axis there; none is needed where it lies there already.
        Some(onwards) => unit(onwards.iter().enumerate().map(|(j, x)| axis(0, j) - x).collect()),
        None => unit(random.to_vec()),
    });
    let normal = normal.unwrap_or_else(|| vec![0.0; dimension]);
    let mirrored = |i: usize| (0..dimension).map(|j| axis(i, j) - 2.0 * normal[i] * normal[j]).collect();
    (0..dimension).map(mirrored).collect()
}

/// The vector of length 1 in the direction of `vector`; `None` for one without length.
fn unit(vector: Vec<f64>) -> Option<Vec<f64>> {
    let length = vector.iter().map(|x| x * x).sum::<f64>().sqrt();
    (length > 0.0).then(|| vector.iter().map(|x| x / length).collect())
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
