//! What is aimed at, in digits.

use crate::app::view::design::Aim;
use crate::app::widgets::number::{significant, with_unit};

/// What the objective counts in.
fn unit(aim: Aim) -> &'static str {
    match aim {
        Aim::Power => "W",
        Aim::PerG2 => "W/g²",
        Aim::Voltage => "V",
        Aim::Band => "Hz",
        Aim::Threshold => "",
    }
}

pub(in crate::app::panels) fn in_digits(value: f64, aim: Aim) -> String {
    if aim == Aim::Threshold {
        format!("β = {}", significant(value, 3))
    } else {
        with_unit(value, unit(aim))
    }
}
