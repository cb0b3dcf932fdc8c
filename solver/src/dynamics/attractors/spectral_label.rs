//! Names for the lines of a spectrum: multiples of the excitation's frequency, the system's own frequencies, and
//! combinations of both.
//!
//! An exact relation (a multiple m omega / n, a combination of measured basic frequencies) must hold within half a bin
//! of the spectrum, a quarter of its resolution. The system's own frequencies are those of beam and circuit coupled and
//! linear; at finite amplitude the magnet shifts them, so a combination that contains them may lie as far off as
//! [`SHIFT`] times them or itself, whichever is less, and then says how far. A line that fits nothing keeps no label.

use std::fmt;

use serde::{Deserialize, Serialize};

use super::spectrum::SpectralLine;

/// How far a nonlinear vibration may be from the linear eigenfrequency it belongs to, relative.
pub const SHIFT: f64 = 0.02;
/// Largest multiple of the excitation in a combination with measured basic frequencies, and of those.
const LARGEST_ORDER: i32 = 8;
/// Amplitude, relative to the strongest line's, of a line that tells what motion a torus lies about.
const STRONG: f64 = 0.1;
/// Lines that may be the basic frequency.
const CANDIDATES: usize = 8;
/// The combinations (excitation, first, second own frequency) that are looked for, by priority: itself, the partner
/// in the sum resonance, the first order of a sideband, the second order.
const COMBINATIONS: [(i32, i32, i32); 16] = [
    (0, 1, 0),
    (0, 0, 1),
    (1, -1, 0),
    (1, 0, -1),
    (1, 1, 0),
    (1, 0, 1),
    (0, 2, 0),
    (0, 1, 1),
    (0, -1, 1),
    (0, 0, 2),
    (1, -2, 0),
    (1, 0, -2),
    (1, 2, 0),
    (2, -1, 0),
    (2, 0, -1),
    (0, 3, 0),
];

/// What a line of a spectrum is.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, nanoserde::SerBin, nanoserde::DeBin)]
#[serde(rename_all = "snake_case", tag = "kind")]
pub enum Label {
    /// numerator / denominator of the excitation's frequency, in lowest terms.
    Excitation {
        /// Numerator m.
        numerator: u32,
        /// Denominator n.
        denominator: u32,
    },
    /// An integer combination of the excitation and the two lowest own frequencies of beam and circuit.
    Own {
        /// Multiple of omega.
        excitation: i32,
        /// Multiple of the first own frequency.
        first: i32,
        /// Multiple of the second own frequency.
        second: i32,
        /// (measured - combination) / combination.
        shift: f64,
    },
    /// An integer combination of the excitation, or a fraction of it, and the basic frequency nu measured on a torus.
    Torus {
        /// Multiple of omega / denominator.
        excitation: i32,
        /// 1, or the periods of the motion that the torus lies about.
        denominator: u32,
        /// Multiple of nu.
        basic: i32,
    },
}

impl fmt::Display for Label {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::Excitation { numerator, denominator } => {
                terms(f, &[(numerator as i32, "ω")])?;
                if denominator > 1 { write!(f, "/{denominator}") } else { Ok(()) }
            }
            Self::Own { excitation, first, second, .. } => {
                terms(f, &[(excitation, "ω"), (first, "ω₁′"), (second, "ω₂′")])
            }
            Self::Torus { excitation, denominator, basic } => {
                let whole = denominator as i32;
                if excitation % whole == 0 {
                    return terms(f, &[(excitation / whole, "ω"), (basic, "ν")]);
                }
                terms(f, &[(excitation, &format!("ω/{denominator}")), (basic, "ν")])
            }
        }
    }
}

/// Writes a sum of multiples, a positive one first, such as "ω − 2ω₁′".
fn terms(f: &mut fmt::Formatter<'_>, parts: &[(i32, &str)]) -> fmt::Result {
    let mut parts: Vec<_> = parts.iter().filter(|(factor, _)| *factor != 0).collect();
    parts.sort_by_key(|(factor, _)| *factor < 0);
    for (i, (factor, symbol)) in parts.into_iter().enumerate() {
        f.write_str(match (i, *factor < 0) {
            (0, false) => "",
            (0, true) => "−",
            (_, false) => " + ",
            (_, true) => " − ",
        })?;
        match factor.unsigned_abs() {
            1 => f.write_str(symbol)?,
            multiple => write!(f, "{multiple}{symbol}")?,
        }
    }
    Ok(())
}

/// The frequencies that lines are compared with, all angular and dimensionless.
#[derive(Debug, Clone, PartialEq)]
pub struct Frequencies {
    /// The excitation's omega.
    pub excitation: f64,
    /// The own frequencies of beam and circuit, ascending; only the two lowest are used.
    pub own: Vec<f64>,
    /// Half a bin of the spectrum: how far an exact relation may be off.
    pub tolerance: f64,
    /// Largest denominator n of m omega / n: the motion's period where it is known.
    pub largest_denominator: u32,
}

impl Frequencies {
    /// The label of a line at `omega` on a motion that is no torus.
    pub fn label(&self, omega: f64) -> Option<Label> {
        self.excitation_label(omega).or_else(|| self.own_label(omega))
    }

    /// m omega / n with the smallest n, if `omega` is one.
    pub fn excitation_label(&self, omega: f64) -> Option<Label> {
        (1..=self.largest_denominator).find_map(|denominator| {
            let unit = self.excitation / f64::from(denominator);
            let numerator = (omega / unit).round();
            let close = numerator >= 1.0 && (omega - numerator * unit).abs() <= self.tolerance;
            close.then_some(Label::Excitation { numerator: numerator as u32, denominator })
        })
    }

    /// A combination with the own frequencies, if `omega` is near one: of several the nearest.
    pub fn own_label(&self, omega: f64) -> Option<Label> {
        let own = |i: usize| self.own.get(i).copied();
        let found = COMBINATIONS.iter().filter_map(|&(excitation, first, second)| {
            let part = |factor: i32, i: usize| {
                if factor == 0 { Some(0.0) } else { own(i).map(|own| own * f64::from(factor)) }
            };
            let (one, two) = (part(first, 0)?, part(second, 1)?);
            let sum = f64::from(excitation) * self.excitation + one + two;
            let reach = self.tolerance.max(SHIFT * (one.abs() + two.abs()).min(sum));
            let off = omega - sum;
            (sum > 0.0 && off.abs() <= reach)
                .then_some((off, Label::Own { excitation, first, second, shift: off / sum }))
        });
        found.min_by(|a, b| a.0.abs().total_cmp(&b.0.abs())).map(|found| found.1)
    }

    /// The periods n of the motion that a torus lies about: the smallest denominator of the strongest of `lines` that is a
    /// multiple of omega / n and none of omega, or 1 where no strong one is.
    pub fn torus_denominator(&self, lines: &[SpectralLine]) -> u32 {
        let strongest = lines.first().map_or(0.0, |line| line.amplitude);
        let strong = lines.iter().take_while(|line| line.amplitude >= STRONG * strongest);
        let fractions = strong.filter_map(|line| self.excitation_label(line.omega));
        let denominators = fractions.filter_map(|label| match label {
            Label::Excitation { denominator, .. } => Some(denominator),
            _ => None,
        });
        denominators.max().unwrap_or(1)
    }

    /// a omega / `denominator` + b nu with the smallest |a| + |b|, b not 0, if `omega` is one.
    pub fn torus_label(&self, omega: f64, basic: f64, denominator: u32) -> Option<Label> {
        let unit = self.excitation / f64::from(denominator);
        let mut best: Option<(i32, Label)> = None;
        for multiple in (-LARGEST_ORDER..=LARGEST_ORDER).filter(|multiple| *multiple != 0) {
            let excitation = ((omega - f64::from(multiple) * basic) / unit).round();
            if excitation.abs() > f64::from(LARGEST_ORDER) * f64::from(denominator) {
                continue;
            }
            let sum = excitation * unit + f64::from(multiple) * basic;
            let order = multiple.abs() + excitation.abs() as i32;
            // The error of nu is multiplied with it.
            let tolerance = self.tolerance * f64::from(multiple.abs()).sqrt();
            if (omega - sum).abs() <= tolerance && best.is_none_or(|(least, _)| order < least) {
                best = Some((
                    order,
                    Label::Torus { excitation: excitation as i32, denominator, basic: multiple },
                ));
            }
        }
        best.map(|(_, label)| label)
    }

    /// The basic frequency nu of a torus about a motion of `denominator` periods: of the strongest `lines` that are no
    /// multiples of omega / denominator, the one whose combinations with it explain most of them, and in the simplest way.
    ///
    /// Any of the frequencies nu + k omega / denominator would do; which one is found depends on the strengths.
    pub fn basic(&self, lines: &[SpectralLine], denominator: u32) -> Option<f64> {
        let free: Vec<&SpectralLine> =
            lines.iter().filter(|line| self.multiple(line.omega, denominator).is_none()).collect();
        let cost = |basic: f64| -> f64 {
            let weights = free.iter().map(|line| {
                let order = match self.torus_label(line.omega, basic, denominator) {
                    Some(Label::Torus { excitation, basic, .. }) => excitation.abs() + basic.abs(),
                    _ => 4 * LARGEST_ORDER,
                };
                line.amplitude * line.amplitude * f64::from(order)
            });
            weights.sum()
        };
        let candidates = free.iter().take(CANDIDATES).map(|line| (line.omega, cost(line.omega)));
        candidates.min_by(|a, b| a.1.total_cmp(&b.1)).map(|found| found.0)
    }

    /// The multiple of omega / `denominator` that a line is, if it is one.
    pub fn multiple(&self, omega: f64, denominator: u32) -> Option<u32> {
        let unit = self.excitation / f64::from(denominator);
        let numerator = (omega / unit).round();
        let close = numerator >= 1.0 && (omega - numerator * unit).abs() <= self.tolerance;
        close.then_some(numerator as u32)
    }
}
