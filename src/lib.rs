//! Harvester Lab: the nonlinear vibration of a cantilevered piezoelectric energy harvester whose tip magnet faces
//! a second, fixed magnet (Zhang & Zhang, "Secondary Resonance Energy Harvesting with Quadratic Nonlinearity",
//! Materials 2020, 13(15), 3389).
//!
//! * [`model`], [`theory`] and [`dynamics`] are the solver core, a package of its own, so that it builds without the rest
//!   and is compiled for speed while the page is compiled for size. What it tells people are [`sentence`]s.
//! * [`questions`] is what can be asked, one type each for the page, JavaScript and the native command; [`scheduler`] brings
//!   their pieces of work to cores and workers.
//! * [`scenario`] is everything a view depends on, as stored and shared.
//! * [`export`] writes plots as SVG and CSV, a report as HTML, and a question as a program.
//! * [`spacing`] is what equally spaced means, everywhere.
//! * `app` (feature `app`) is the egui front end; it draws what the other modules computed.
//!
//! Dependencies point one way: app -> export, questions -> scheduler, dynamics, theory -> model.

pub use harvester_solver::{dynamics, model, sentence, theory};

pub mod export;
pub mod questions;
pub mod scenario;
pub mod scheduler;
pub mod spacing;

#[cfg(feature = "app")]
pub mod app;
