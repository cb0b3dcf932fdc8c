//! The discrete Fourier transform.

use std::sync::Arc;

use rustfft::Fft;
use rustfft::algorithm::{BluesteinsAlgorithm, Radix4};

pub(crate) use rustfft::FftDirection as Direction;
pub(crate) use rustfft::num_complex::Complex;

/// The transform of any length by those of powers of two. A planner would choose among all of the crate's algorithms,
/// which weigh more in the page than the whole integrator; this takes three times as long, a few milliseconds.
pub(crate) fn transform(length: usize, direction: Direction) -> Arc<dyn Fft<f64>> {
    let of_power_of_two = |length| Arc::new(Radix4::new(length, direction));
    if length.is_power_of_two() {
        return of_power_of_two(length);
    }
    Arc::new(BluesteinsAlgorithm::new(length, of_power_of_two((2 * length).next_power_of_two())))
}
