//! What is checked in seconds: reference values, closed forms, properties, and what stands beside the solver (command,
//! files, texts, the document of the equations). What has to follow motions for long is in `tests/slow`.

#![allow(clippy::expect_used, clippy::unwrap_used, reason = "helpers of tests panic as tests do")]

mod batch;
mod command;
mod conservation;
mod continuous_beam;
mod equations_document;
mod export;
mod finite_element;
mod fit;
mod hill;
mod integration;
mod integrators;
mod limits;
mod lyapunov;
mod measured;
mod messages;
mod own_device;
mod properties;
mod published_devices;
mod rectifier;
mod reference_values;
mod spectrum;
mod stability_boundaries;
#[cfg(feature = "app")]
mod texts;
mod tolerances;

/// What a test gives back that fails by `?`, too.
type Fallible<T> = Result<T, Box<dyn std::error::Error>>;
type TestResult = Fallible<()>;

/// The paper's omega_1, omega_2 in 40-digit arithmetic, rounded to a double's digits.
const OMEGA_1: f64 = 4.04845139686289;
const OMEGA_2: f64 = 21.3562434253049;
