//! The root of a continuous function between two points where it has opposite signs.

/// Evaluations after which the bracket is taken as it is.
const MAX_EVALUATIONS: usize = 80;

/// A place and the function's value there.
pub(super) type Sample = (f64, f64);

/// A point within `tolerance` of a root between `a` and `b`, where the function's values differ in sign: secants
/// with the Illinois rule (an end that stays has its value halved), so the bracket shrinks from both sides.
///
/// The function must be continuous; at a jump through zero the jump is returned.
///
/// # Errors
/// The first error of `function`.
pub(super) fn root<E>(
    mut a: Sample,
    mut b: Sample,
    tolerance: f64,
    mut function: impl FnMut(f64) -> Result<f64, E>,
) -> Result<f64, E> {
    for _ in 0..MAX_EVALUATIONS {
        let width = b.0 - a.0;
        if width.abs() <= tolerance || b.1 == 0.0 {
            break;
        }
        // A point at least half a tolerance inside lets the far end come close too.
        let inset = (0.5 * tolerance / width.abs()).min(0.5);
        let fraction = (a.1 / (a.1 - b.1)).clamp(inset, 1.0 - inset);
        let x = a.0 + width * fraction;
        let value = function(x)?;
        if (value < 0.0) == (b.1 < 0.0) {
            a.1 *= 0.5;
        } else {
            a = b;
        }
        b = (x, value);
    }
    Ok(b.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(function: impl Fn(f64) -> f64, from: f64, to: f64) -> f64 {
        let sample = |x: f64| (x, function(x));
        root::<()>(sample(from), sample(to), 1e-12, |x| Ok(function(x))).expect("no errors")
    }

    #[test]
    fn roots_are_met() {
        assert!((found(|x| x * x - 2.0, 0.0, 2.0) - 2.0_f64.sqrt()).abs() < 1e-12);
        assert!((found(|x| (40.0 * (x - 0.3)).tanh() + 1e-3, 0.0, 1.0) - (0.3 - 2.5e-5)).abs() < 1e-9);
        assert!((found(|x| if x < 0.7 { -1.0 } else { 2.0 }, 1.0, 0.0) - 0.7).abs() < 1e-11);
    }
}
