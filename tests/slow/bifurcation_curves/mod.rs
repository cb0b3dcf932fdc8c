//! Curves of bifurcations in two parameters against one-parameter searches, an independent program's values, each
//! other, and charts computed point by point.

mod boundaries;
mod charts;
mod codimension_two;
mod criticality;
mod search;
mod support;
