//! An acceleration given by equally spaced samples, between which it is a polynomial.

use crate::model::ModelError;

/// Samples through which the polynomial between two of them goes, and so its value and its derivatives that are not zero. Of a
/// sine with n samples a period it is off by 0.005 (2 pi/n)^6 of the amplitude.
pub const DERIVATIVES: usize = 6;

/// Equally spaced samples of the base's acceleration, the first at time 0; in s and g, or dimensionless.
#[derive(Debug, Clone, PartialEq)]
pub struct Signal {
    interval: f64,
    samples: Vec<f64>,
}

impl Signal {
    /// Of samples so far apart in time.
    ///
    /// # Errors
    /// [`ModelError`] for an interval that is not positive, fewer than [`DERIVATIVES`] samples, or one that is not finite.
    pub fn new(interval: f64, samples: Vec<f64>) -> Result<Self, ModelError> {
        ModelError::check("interval", interval, (f64::MIN_POSITIVE, f64::MAX), "")?;
        let (field, value) = ("samples", samples.len());
        if value < DERIVATIVES {
            return Err(ModelError::Count {
                field,
                value,
                minimum: DERIVATIVES,
                maximum: super::MOST_SAMPLES,
            });
        }
        for sample in &samples {
            ModelError::check("acceleration", *sample, (-f64::MAX, f64::MAX), "")?;
        }
        Ok(Self { interval, samples })
    }

    /// Time between two samples.
    pub fn interval(&self) -> f64 {
        self.interval
    }

    /// The samples.
    pub fn samples(&self) -> &[f64] {
        &self.samples
    }

    /// Time of the last sample.
    pub fn duration(&self) -> f64 {
        self.interval * (self.samples.len() - 1) as f64
    }

    /// The same in other units: every time and every acceleration by a factor.
    #[must_use]
    pub fn scaled(&self, time: f64, acceleration: f64) -> Self {
        let samples = self.samples.iter().map(|sample| acceleration * sample).collect();
        Self { interval: time * self.interval, samples }
    }

    /// Root mean square of the samples.
    pub fn rms(&self) -> f64 {
        (self.samples.iter().map(|a| a * a).sum::<f64>() / self.samples.len() as f64).sqrt()
    }

    /// Mean of the samples.
    pub fn mean(&self) -> f64 {
        self.samples.iter().sum::<f64>() / self.samples.len() as f64
    }

    /// The acceleration at `time`; beyond the ends the polynomial of the end goes on.
    pub fn at(&self, time: f64) -> f64 {
        let place = (time / self.interval).clamp(0.0, (self.samples.len() - 1) as f64);
        self.derivatives(place as usize, place.fract())[0]
    }

    /// The acceleration and its derivatives, the k-th times interval^k, at `place` (0 to 1) of the interval after sample
    /// `index`, as the polynomial of that interval has them.
    pub fn derivatives(&self, index: usize, place: f64) -> [f64; DERIVATIVES] {
        let last = self.samples.len() - DERIVATIVES;
        let first = index.saturating_sub(DERIVATIVES / 2 - 1).min(last);
        let x = index as f64 - first as f64 + place;
        // Newton's form from forward differences, expanded about x.
        let mut differences = [0.0; DERIVATIVES];
        differences.copy_from_slice(&self.samples[first..first + DERIVATIVES]);
        for order in 1..DERIVATIVES {
            for i in (order..DERIVATIVES).rev() {
                differences[i] = (differences[i] - differences[i - 1]) / order as f64;
            }
        }
        let mut taylor = [0.0; DERIVATIVES];
        for (node, difference) in differences.iter().enumerate().rev() {
            for k in (1..DERIVATIVES).rev() {
                taylor[k] = taylor[k - 1] + (x - node as f64) * taylor[k];
            }
            taylor[0] = difference + (x - node as f64) * taylor[0];
        }
        let mut factorial = 1.0;
        for (k, term) in taylor.iter_mut().enumerate().skip(1) {
            factorial *= k as f64;
            *term *= factorial;
        }
        taylor
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_polynomial_of_degree_five_is_met_with_its_derivatives() -> Result<(), ModelError> {
        // f(t) = t^5 - 2 t^3 + t over samples 0.25 apart.
        let h: f64 = 0.25;
        let f = |t: f64| t.powi(5) - 2.0 * t.powi(3) + t;
        let signal = Signal::new(h, (0..12).map(|i| f(h * i as f64)).collect())?;
        for index in 0..11 {
            for place in [0.0, 0.3, 1.0] {
                let t = h * (index as f64 + place);
                let expected = [
                    f(t),
                    h * (5.0 * t.powi(4) - 6.0 * t * t + 1.0),
                    h.powi(2) * (20.0 * t.powi(3) - 12.0 * t),
                    h.powi(3) * (60.0 * t * t - 12.0),
                    h.powi(4) * 120.0 * t,
                    h.powi(5) * 120.0,
                ];
                for (got, expected) in signal.derivatives(index, place).iter().zip(expected) {
                    assert!((got - expected).abs() < 1e-11, "{index} {place}: {got} {expected}");
                }
            }
        }
        Ok(())
    }

    #[test]
    fn of_a_sine_it_is_off_by_as_much_as_said() -> Result<(), ModelError> {
        let samples = 20;
        let h = std::f64::consts::TAU / samples as f64;
        let signal = Signal::new(h, (0..=3 * samples).map(|i| (h * i as f64).sin()).collect())?;
        let error = (0..1000).map(|i| 0.0125 * i as f64).filter(|t| (3.0 * h..40.0 * h).contains(t));
        let worst = error.map(|t| (signal.at(t) - t.sin()).abs()).fold(0.0, f64::max);
        let said = 0.005 * h.powi(6);
        assert!(worst < said && worst > 0.5 * said, "{worst} {said}");
        assert!((signal.rms() - 0.5_f64.sqrt()).abs() < 0.01 && signal.mean().abs() < 1e-12);
        assert!((signal.duration() - 3.0 * std::f64::consts::TAU).abs() < 1e-12);
        Ok(())
    }

    #[test]
    fn too_few_samples_and_infinite_ones_are_refused() {
        assert!(Signal::new(0.1, vec![0.0; 5]).is_err() && Signal::new(0.0, vec![0.0; 9]).is_err());
        assert!(Signal::new(0.1, vec![0.0, 0.0, f64::NAN, 0.0, 0.0, 0.0]).is_err());
    }
}
