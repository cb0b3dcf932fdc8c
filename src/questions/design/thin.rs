//! Thinning for drawing: of many points the lowest and the highest in each bucket of x, so that no peak is lost.

/// Collects the extremes of equal buckets of x.
#[derive(Debug, Clone, PartialEq)]
pub struct Thinner {
    range: (f64, f64),
    buckets: Vec<Option<Bucket>>,
}

#[derive(Debug, Clone, Copy, PartialEq)]
struct Bucket {
    lowest: [f64; 2],
    highest: [f64; 2],
}

impl Thinner {
    /// Buckets over `range` of x; points outside are left out.
    pub fn new(range: (f64, f64), buckets: usize) -> Self {
        Self { range, buckets: vec![None; buckets.max(1)] }
    }

    /// Takes points into account, in any order.
    pub fn add(&mut self, points: &[[f64; 2]]) {
        let (low, high) = self.range;
        let last = self.buckets.len() - 1;
        let scale = self.buckets.len() as f64 / (high - low);
        for point in points {
            if !(point[0] >= low && point[0] <= high) {
                continue;
            }
            // A range of no width has one bucket; NaN becomes 0.
            let index = (((point[0] - low) * scale) as usize).min(last);
            match &mut self.buckets[index] {
                None => self.buckets[index] = Some(Bucket { lowest: *point, highest: *point }),
                Some(bucket) => {
                    if point[1] < bucket.lowest[1] {
                        bucket.lowest = *point;
                    }
                    if point[1] > bucket.highest[1] {
                        bucket.highest = *point;
                    }
                }
            }
        }
    }

    /// At most two points a bucket, by ascending x.
    pub fn points(&self) -> Vec<[f64; 2]> {
        let mut points = Vec::with_capacity(2 * self.buckets.len());
        for Bucket { lowest, highest } in self.buckets.iter().flatten() {
            let (first, second) = if lowest[0] <= highest[0] { (lowest, highest) } else { (highest, lowest) };
            points.push(*first);
            if first != second {
                points.push(*second);
            }
        }
        points
    }
}

/// Smallest and largest x of `points`; `None` without points.
pub fn extent(points: &[[f64; 2]]) -> Option<(f64, f64)> {
    let first = points.first()?[0];
    Some(points.iter().fold((first, first), |(low, high), point| (low.min(point[0]), high.max(point[0]))))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn few_points_are_kept_and_of_many_the_extremes() {
        let few = [[0.0, 1.0], [0.5, 3.0], [1.0, 2.0]];
        let mut thinner = Thinner::new(extent(&few).expect("points"), 10);
        thinner.add(&few);
        assert_eq!(thinner.points(), few);
        let many: Vec<[f64; 2]> = (0..10_000).map(|i| f64::from(i) * 1e-3).map(|x| [x, x.sin()]).collect();
        let mut thinner = Thinner::new((0.0, 10.0), 100);
        // In slices, and backwards.
        many.rchunks(333).for_each(|slice| thinner.add(slice));
        let kept = thinner.points();
        assert!(kept.len() <= 200 && kept.windows(2).all(|pair| pair[0][0] < pair[1][0]));
        let highest = |points: &[[f64; 2]]| points.iter().map(|point| point[1]).fold(f64::MIN, f64::max);
        assert_eq!(highest(&kept), highest(&many));
    }

    #[test]
    fn one_place_and_what_is_outside_do_no_harm() {
        let mut thinner = Thinner::new((1.0, 1.0), 4);
        thinner.add(&[[1.0, 5.0], [1.0, 2.0], [2.0, 9.0], [f64::NAN, 1.0]]);
        assert_eq!(thinner.points(), [[1.0, 2.0], [1.0, 5.0]]);
        assert_eq!(extent(&[]), None);
    }
}
