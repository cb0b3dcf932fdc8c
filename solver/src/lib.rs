//! The solver core of Harvester Lab: the nonlinear vibration of a cantilevered piezoelectric energy harvester whose tip
//! magnet faces a second, fixed magnet (Zhang & Zhang, "Secondary Resonance Energy Harvesting with Quadratic
//! Nonlinearity", Materials 2020, 13(15), 3389). Page and command reach it through the package `harvester-lab`.
//!
//! A tour, in the order of the paper:
//!
//! * [`model`] is section 2: the device in SI units and its dimensionless numbers (Eqs. 1-8), the magnet force and
//!   its equilibrium (Eqs. 11-17), the modes (Eqs. 18-23) and the N-mode system (Eqs. 27-34).
//! * [`theory`] is sections 3 and 4: the first-order steady state and the stability boundaries as published, and a
//!   coupled-mode boundary that keeps the electrical circuit the published ones leave out.
//! * [`dynamics`] integrates: the classical Runge-Kutta run of the paper, and an error-controlled exponential
//!   collocation that does the same run a thousand times faster.
//! * `fourier` is the transform that spectra, noise and rotation numbers share.
//! * [`number`] writes numbers for people, here and in the page; a [`sentence`] is what they will read, before it is put into
//!   a language.
//!
//! Dependencies point one way: dynamics, theory -> model -> fourier. Everything is dimensionless unless a docstring names
//! a unit; time is counted in units of `sqrt(m_b L^3 / (E I))`, lengths in units of the beam's length, voltages in
//! volts.

pub mod dynamics;
mod fourier;
pub mod model;
pub mod number;
pub mod sentence;
pub mod theory;
