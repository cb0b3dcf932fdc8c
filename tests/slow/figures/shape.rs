//! Whether points lie on one closed curve, as the Poincare map of a quasi-periodic motion does.

use nalgebra::{DMatrix, DVector};

use super::support::range;

/// What a cloud of points looks like near each of its points.
#[derive(Debug)]
pub(crate) struct Shape {
    /// Largest ratio of the second to the first principal extent of a neighbourhood: 0 on a line, 1 in an area.
    width: f64,
    /// Smallest share of a neighbourhood on its poorer side along the line: 0 at the end of an arc.
    balance: f64,
    /// Largest distance to the nearest neighbour, relative to the size of the cloud.
    largest_gap: f64,
    /// Number of points that are apart from each other by more than a millionth of the cloud's size.
    distinct: usize,
    /// Parts that remain when points nearer than twice the largest gap are joined.
    parts: usize,
}

impl Shape {
    pub(crate) fn of(points: &[DVector<f64>], neighbours: usize) -> Self {
        let dimension = points[0].len();
        let scale: Vec<f64> = (0..dimension)
            .map(|k| {
                let (low, high) = range(points, k);
                (high - low).max(1e-300)
            })
            .collect();
        let scaled: Vec<DVector<f64>> =
            points.iter().map(|point| DVector::from_fn(dimension, |k, _| point[k] / scale[k])).collect();
        let mut shape = Self { width: 0.0, balance: 1.0, largest_gap: 0.0, distinct: 0, parts: 0 };
        for (i, point) in scaled.iter().enumerate() {
            let mut others: Vec<(f64, usize)> =
                scaled.iter().enumerate().map(|(j, other)| ((other - point).norm(), j)).collect();
            others.sort_by(|a, b| a.0.total_cmp(&b.0));
            shape.distinct += usize::from(!others.iter().any(|(r, j)| *j < i && *r < 1e-6));
            shape.largest_gap = shape.largest_gap.max(others[1].0);
            let near = DMatrix::from_fn(dimension, neighbours, |k, j| scaled[others[j + 1].1][k] - point[k]);
            let svd = near.clone().svd(true, false);
            let extents = svd.singular_values;
            shape.width = shape.width.max(extents[1] / extents[0]);
            let direction = svd.u.expect("asked for").column(0).into_owned();
            let ahead = near.column_iter().filter(|offset| offset.dot(&direction) > 0.0).count();
            shape.balance = shape.balance.min(ahead.min(neighbours - ahead) as f64 / neighbours as f64);
        }
        let mut part: Vec<Option<usize>> = vec![None; scaled.len()];
        for seed in 0..scaled.len() {
            let mut open = if part[seed].is_none() { vec![seed] } else { vec![] };
            shape.parts += open.len();
            while let Some(i) = open.pop() {
                part[i] = Some(seed);
                for j in 0..scaled.len() {
                    if part[j].is_none() && (&scaled[i] - &scaled[j]).norm() < 2.0 * shape.largest_gap {
                        part[j] = Some(seed);
                        open.push(j);
                    }
                }
            }
        }
        shape
    }

    pub(crate) fn is_closed_curve(&self, points: usize) -> bool {
        self.width < 0.4
            && self.balance > 0.1
            && self.parts == 1
            && self.distinct > points * 9 / 10
            && self.largest_gap < 0.1
    }
}

#[test]
fn the_shape_test_tells_closed_curves_from_other_sets() {
    let cloud = |f: &dyn Fn(f64) -> (f64, f64)| -> Vec<DVector<f64>> {
        let point = |i: usize| f(i as f64);
        (0..1000).map(|i| DVector::from_column_slice(&[point(i).0, 3.0 * point(i).1])).collect()
    };
    let golden = 3.883222077450933;
    let loops = cloud(&|i| ((golden * i).sin(), (golden * i + 0.7).cos() + 0.3 * (2.0 * golden * i).sin()));
    let arc = cloud(&|i| ((0.0017 * i).sin(), (0.0017 * i).cos()));
    let disk =
        cloud(&|i| ((i / 1000.0).sqrt() * (golden * i).sin(), (i / 1000.0).sqrt() * (golden * i).cos()));
    let finite = cloud(&|i| ((i % 7.0).sin(), (i % 7.0).cos()));
    let two = cloud(&|i| ((golden * i).sin() + 5.0 * (i % 2.0), (golden * i).cos()));
    assert!(Shape::of(&loops, 10).is_closed_curve(1000), "{:?}", Shape::of(&loops, 10));
    for other in [arc, disk, finite, two] {
        assert!(!Shape::of(&other, 10).is_closed_curve(1000), "{:?}", Shape::of(&other, 10));
    }
}
