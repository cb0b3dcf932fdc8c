//! The 0-1 test for chaos (Gottwald & Melbourne, SIAM Journal on Applied Dynamical Systems 8, 2009, 129-145): the record
//! drives a walk in the plane that stays bounded on a torus and diffuses on a chaotic motion.

use std::f64::consts::PI;

use nalgebra::Complex;

/// Angles at which the walk turns, in the middle of (0, pi), where no resonance with the record is frequent.
const ANGLES: usize = 16;
/// Part of the record over which the walk's displacement is correlated with time.
const PART: usize = 10;
/// Longest record that is used: the work grows with its square.
const LONGEST: usize = 1000;

/// The median correlation K of displacement and time: near 0 on a regular motion, near 1 on a chaotic one
/// (dimensionless). `record` is any scalar of the motion once a period; below some 500 values K says little.
pub(super) fn zero_one(record: &[f64]) -> f64 {
    let mut found: Vec<f64> = correlations(record).collect();
    found.sort_by(f64::total_cmp);
    found[ANGLES / 2]
}

/// Whether K is larger than `limit`: known as soon as enough angles say that it is not.
pub(super) fn exceeds(record: &[f64], limit: f64) -> bool {
    correlations(record).filter(|found| !(*found > limit)).nth(ANGLES / 2).is_none()
}

/// At each of the angles.
fn correlations(record: &[f64]) -> impl Iterator<Item = f64> {
    let record = &record[record.len().saturating_sub(LONGEST)..];
    let mean = record.iter().sum::<f64>() / record.len() as f64;
    (0..ANGLES).map(move |i| {
        // Irrational multiples, so that no angle is commensurate with all others.
        let place = ((i + 1) as f64 * 0.618_033_988_749_894_9).fract();
        correlation(record, mean, PI * (0.2 + 0.6 * place))
    })
}

fn correlation(record: &[f64], mean: f64, angle: f64) -> f64 {
    let turn: Complex<f64> = Complex::cis(angle);
    let (mut unit, mut place) = (Complex::ONE, Complex::ZERO);
    let (mut p, mut q) = (Vec::with_capacity(record.len()), Vec::with_capacity(record.len()));
    for value in record {
        unit *= turn;
        place += unit * *value;
        p.push(place.re);
        q.push(place.im);
    }
    let longest = (record.len() / PART).max(2);
    let starts = record.len() - longest;
    let mut unit: Complex<f64> = Complex::ONE;
    let displacement = |n: usize| {
        let squares = squared_distance(&p[..starts], &p[n..n + starts])
            + squared_distance(&q[..starts], &q[n..n + starts]);
        unit *= turn;
        // What oscillates in it is known and taken out.
        let oscillation = mean * mean * (1.0 - unit.re) / (1.0 - turn.re);
        squares / starts as f64 - oscillation
    };
    let values: Vec<f64> = (1..=longest).map(displacement).collect();
    let (time, value) = (0.5 * (longest + 1) as f64, values.iter().sum::<f64>() / longest as f64);
    let (mut covariance, mut times, mut squares) = (0.0, 0.0, 0.0);
    for (i, displacement) in values.iter().enumerate() {
        let (t, d) = ((i + 1) as f64 - time, displacement - value);
        covariance += t * d;
        times += t * t;
        squares += d * d;
    }
    let scale = (times * squares).sqrt();
    if scale > 0.0 { covariance / scale } else { 0.0 }
}

/// Sum of (b - a)^2, in several sums that do not wait for one another.
fn squared_distance(a: &[f64], b: &[f64]) -> f64 {
    const SUMS: usize = 8;
    let square = |(a, b): (&f64, &f64)| (b - a) * (b - a);
    let ((a, a_left), (b, b_left)) = (a.as_chunks::<SUMS>(), b.as_chunks::<SUMS>());
    let mut sums = [0.0; SUMS];
    for (a, b) in a.iter().zip(b) {
        sums.iter_mut().zip(a.iter().zip(b)).for_each(|(sum, pair)| *sum += square(pair));
    }
    sums.iter().sum::<f64>() + a_left.iter().zip(b_left).map(square).sum::<f64>()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_logistic_map_is_told_from_a_rotation() {
        let mut x = 0.3;
        let chaotic: Vec<f64> = (0..1000)
            .map(|_| {
                x = 3.97 * x * (1.0 - x);
                x
            })
            .collect();
        assert!(zero_one(&chaotic) > 0.9, "{}", zero_one(&chaotic));
        let regular: Vec<f64> =
            (0..1000).map(|k| (2.0 + 0.3 * (1.234_567 * f64::from(k)).sin()).ln()).collect();
        assert!(zero_one(&regular).abs() < 0.1, "{}", zero_one(&regular));
        assert_eq!(zero_one(&[0.0; 600]), 0.0);
        for record in [&chaotic, &regular] {
            let found = zero_one(record);
            assert!(exceeds(record, found - 1e-9) && !exceeds(record, found), "{found}");
        }
    }
}
