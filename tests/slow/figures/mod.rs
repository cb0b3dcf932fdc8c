//! The figures of the paper on the data this program computes for them: which motion each shows, and how close the
//! paper's first-order theory comes to it.

mod models;
mod period_one;
mod resonances;
mod shape;
mod support;
