//! What an axis measures, where its ticks stand and what they say.

use super::number;

/// A tick of an axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tick {
    /// Where, as a coordinate of the axis.
    pub at: f64,
    /// Distance to the next of its kind, in coordinates.
    pub step: f64,
}

/// An axis: name, symbol, unit, scale. Its coordinates are the values, or their `log10` when it is logarithmic.
#[derive(Debug, Clone, PartialEq)]
pub struct Axis {
    name: String,
    symbol: String,
    unit: String,
    logarithmic: bool,
}

impl Axis {
    /// A linear, dimensionless axis; either text may be empty.
    pub fn new(name: impl Into<String>, symbol: impl Into<String>) -> Self {
        Self { name: name.into(), symbol: symbol.into(), unit: String::new(), logarithmic: false }
    }

    /// The unit, shown in brackets in the title and after values.
    pub fn unit(mut self, unit: impl Into<String>) -> Self {
        self.unit = unit.into();
        self
    }

    /// Coordinates are `log10` of the values; ticks and readouts show the values.
    pub fn logarithmic(mut self) -> Self {
        self.logarithmic = true;
        self
    }

    /// Whether coordinates are logarithms.
    pub fn is_logarithmic(&self) -> bool {
        self.logarithmic
    }

    /// The title: `voltage v  [V]`.
    pub fn title(&self) -> String {
        let mut parts = vec![self.name.as_str(), self.symbol.as_str()];
        let bracketed = format!(" [{}]", self.unit);
        if self.has_unit() {
            parts.push(&bracketed);
        }
        parts.retain(|part| !part.is_empty());
        parts.join(" ").trim_start().to_owned()
    }

    /// The same without the name, where there is a symbol: `v [V]`.
    pub fn short_title(&self) -> String {
        let unit = if self.has_unit() { format!(" [{}]", self.unit) } else { String::new() };
        format!("{}{unit}", self.symbol())
    }

    /// The symbol, or the name where there is none.
    pub fn symbol(&self) -> &str {
        if self.symbol.is_empty() { &self.name } else { &self.symbol }
    }

    /// Whether values have a unit.
    pub fn has_unit(&self) -> bool {
        !self.unit.is_empty()
    }

    /// The unit; empty when there is none.
    pub fn unit_text(&self) -> &str {
        &self.unit
    }

    /// The value at a plot coordinate.
    pub fn value(&self, coordinate: f64) -> f64 {
        if self.logarithmic { from_log(coordinate) } else { coordinate }
    }

    /// The plot coordinate of a value.
    pub fn coordinate(&self, value: f64) -> f64 {
        if self.logarithmic { to_log(value) } else { value }
    }

    /// Ticks of an axis that shows the coordinates from `low` to `high` over a `length`, about `wanted` apart, closer on
    /// small plots; both in points or in any other unit.
    pub fn ticks(&self, (low, high): (f64, f64), length: f64, wanted: f64) -> Vec<Tick> {
        if !(low.is_finite() && high.is_finite() && length > 0.0 && high > low) {
            return Vec::new();
        }
        let per_point = (high - low) / length;
        let wanted = wanted.min(0.25 * length).max(0.6 * wanted);
        let decade = 1.0 / per_point;
        // Where values are short in digits they stand at 1, 2, 5 even when decades are narrow.
        let short = low >= SHORT.0 && high <= SHORT.1;
        if self.logarithmic && decade < if short { 2.0 } else { 3.5 } * wanted {
            return decades(low, high, wanted * per_point, decade >= 24.0);
        }
        if self.logarithmic {
            return within_decades(low, high, wanted * per_point);
        }
        let step = round_step(wanted * per_point);
        let count = ((high - low) / step).ceil().min(200.0) as i64;
        let first = (low / step).ceil();
        (0..=count)
            .map(|index| Tick { at: (first + index as f64) * step, step })
            .filter(|tick| tick.at <= high)
            .collect()
    }

    /// The label of a tick; empty where lines have none.
    pub fn label(&self, tick: Tick) -> String {
        if !self.logarithmic {
            return number::tick(tick.at, tick.step);
        }
        let exponent = tick.at.round();
        if (tick.at - exponent).abs() < 1e-9 && tick.step >= 1.0 {
            number::power_of_ten(exponent as i32)
        } else if tick.step < MINOR {
            String::new()
        } else {
            number::typographic(&number::six_digits(number::round_significant(from_log(tick.at), 3)))
        }
    }
}

/// Coordinates of a logarithmic axis between which values are short in plain digits.
const SHORT: (f64, f64) = (-1.0, 4.0);
/// Step sizes below this, in decades, mark unlabelled lines of a logarithmic axis.
const MINOR: f64 = 0.05;

/// Lines at the powers of ten, and faint ones between them when there is room.
fn decades(low: f64, high: f64, wanted: f64, fine: bool) -> Vec<Tick> {
    let stride = wanted.ceil().max(1.0) as i64;
    let mut marks = Vec::new();
    for exponent in (low.floor() as i64)..=(high.ceil() as i64) {
        if exponent.rem_euclid(stride) == 0 {
            marks.push(Tick { at: exponent as f64, step: stride as f64 });
        }
        if fine && stride == 1 {
            let between = (2..10).map(|digit| exponent as f64 + f64::from(digit).log10());
            marks.extend(between.map(|value| Tick { at: value, step: 0.9 * MINOR }));
        }
    }
    marks.retain(|tick| (low..=high).contains(&tick.at));
    marks
}

/// Part of a spacing ahead, as a factor between values, at which the next line stands at least.
const NEAREST: f64 = 0.75;

/// Lines at round values of an axis that shows about a decade or less.
fn within_decades(low: f64, high: f64, wanted: f64) -> Vec<Tick> {
    let mut marks: Vec<Tick> = Vec::new();
    let mut value = from_log(low);
    let (end, mut guard) = (from_log(high), 0);
    while value <= end && guard < 200 {
        // Aim one spacing ahead and take the next round number there.
        let ahead = value * 10_f64.powf(wanted);
        let step = round_step(ahead - value);
        let next = (value / step).floor() * step + step;
        // One that is much nearer would have its label overprint.
        let next = if next < NEAREST * ahead && !marks.is_empty() { next + step } else { next };
        marks.push(Tick { at: to_log(next), step: wanted.max(MINOR) });
        value = next;
        guard += 1;
    }
    marks.retain(|tick| tick.at <= high);
    marks
}

/// The smallest of 1, 2, 5 times a power of ten that is at least `step`.
fn round_step(step: f64) -> f64 {
    let power = 10_f64.powf(step.log10().floor());
    let factor = [1.0, 2.0, 5.0, 10.0].into_iter().find(|factor| factor * power >= step * (1.0 - 1e-9));
    // Dividing keeps 0.1, 0.02 and their like exact to the last digit.
    let factor = factor.unwrap_or(10.0);
    if power < 1.0 { factor / (1.0 / power).round() } else { factor * power }
}

/// The plot coordinate of a value on a logarithmic axis; values that are not positive become a gap.
pub fn to_log(value: f64) -> f64 {
    if value > 0.0 { value.log10() } else { f64::NAN }
}

/// The value at a coordinate of a logarithmic axis.
pub fn from_log(coordinate: f64) -> f64 {
    10_f64.powf(coordinate)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(axis: &Axis, low: f64, high: f64, points: f64, wanted: f64) -> Vec<String> {
        let inside = |tick: &Tick| (0.025..=0.985).contains(&((tick.at - low) / (high - low)));
        let ticks = axis.ticks((low, high), points, wanted).into_iter().filter(inside);
        ticks.map(|tick| axis.label(tick)).filter(|text| !text.is_empty()).collect()
    }

    #[test]
    fn linear_ticks_are_round() {
        let axis = Axis::new("", "β");
        assert_eq!(
            labels(&axis, 0.0, 0.0145, 300.0, 38.0),
            ["0.002", "0.004", "0.006", "0.008", "0.010", "0.012", "0.014"]
        );
        assert_eq!(labels(&axis, -120.0, 160.0, 260.0, 38.0), ["−100", "−50", "0", "50", "100", "150"]);
        assert!(labels(&axis, 0.0, f64::INFINITY, 300.0, 38.0).is_empty());
    }

    #[test]
    fn logarithmic_ticks_are_powers_or_round_values() {
        let axis = Axis::new("damping", "α").logarithmic();
        assert_eq!(labels(&axis, -5.5, -0.5, 400.0, 72.0), ["10⁻⁵", "10⁻⁴", "10⁻³", "10⁻²", "10⁻¹"]);
        let fine = labels(&axis, -2.2, -1.8, 400.0, 72.0);
        assert!(fine.len() >= 3 && fine.iter().all(|text| text.starts_with("0.0")), "{fine:?}");
        let hertz = labels(&axis, 0.0, 2.1, 300.0, 54.0);
        assert_eq!(hertz, ["2", "5", "10", "20", "50", "100"]);
        let level = labels(&Axis::new("", "a").logarithmic(), -2.83, -0.67, 470.0, 56.0);
        assert_eq!(level, ["0.002", "0.004", "0.01", "0.02", "0.04", "0.1"]);
    }

    #[test]
    fn titles() {
        assert_eq!(Axis::new("voltage", "v").unit("V").title(), "voltage v  [V]");
        assert_eq!(Axis::new("", "dv/dt").title(), "dv/dt");
        assert!(to_log(-1.0).is_nan());
    }
}
