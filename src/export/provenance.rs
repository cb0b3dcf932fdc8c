//! What a figure was computed from, in words that stay with it.

use super::number::exact;
use crate::dynamics::{NODES, Settings};
use crate::model::{Dimension, ElectricalScaling, ForceLaw, Parameter};
use crate::scenario::Scenario;

/// Where a figure comes from.
#[derive(Debug, Clone, PartialEq)]
pub struct Provenance {
    /// What was computed.
    pub scenario: Scenario,
    /// Steps that the run took, when it is done.
    pub steps: Option<usize>,
    /// What else to know, by name: how a sweep was carried out, what was still being computed.
    pub notes: Vec<(&'static str, String)>,
    /// The address that shows it again.
    pub link: String,
}

/// The program with its version.
pub const PROGRAM: &str = concat!("Harvester Lab ", env!("CARGO_PKG_VERSION"));

impl Provenance {
    /// Everything, as names and values; units stand behind the values.
    pub fn lines(&self) -> Vec<(String, String)> {
        let mut lines = vec![("program".to_owned(), PROGRAM.to_owned())];
        for parameter in Parameter::ALL {
            let value = exact(self.scenario.parameters.get(parameter));
            lines.push((parameter.field().to_owned(), value + parameter.fact().suffix));
        }
        lines.push(("model".to_owned(), self.model()));
        lines.push(("run".to_owned(), self.run()));
        lines.push(("solver".to_owned(), self.solver()));
        lines.extend(self.device().into_iter().map(|(name, value)| (format!("device.{name}"), value)));
        lines.extend(self.notes.iter().map(|(name, value)| ((*name).to_owned(), value.clone())));
        lines.push(("link".to_owned(), self.link.clone()));
        lines
    }

    /// Modes and force law.
    pub fn model(&self) -> String {
        let modes = self.scenario.model.modes;
        let law = match self.scenario.model.force {
            ForceLaw::Quadratic => "quadratic".to_owned(),
            ForceLaw::Taylor(order) => format!("Taylor (order {order})"),
            ForceLaw::Exact => "exact".to_owned(),
        };
        let rest = if self.scenario.model.residual_moment { ", modes left out in the circuit" } else { "" };
        format!("{modes} {}, {law} magnet force{rest}", if modes == 1 { "mode" } else { "modes" })
    }

    /// From where to when.
    fn run(&self) -> String {
        let start = match &self.scenario.initial {
            None => "rest".to_owned(),
            Some(state) => {
                let numbers: Vec<String> = state.iter().map(|value| exact(*value)).collect();
                format!("({}) as q_1..q_N, their rates, v", numbers.join(" "))
            }
        };
        format!("from {start} until t = {}", exact(self.scenario.t_end))
    }

    /// Method, tolerance, steps.
    fn solver(&self) -> String {
        let tolerance = exact(Settings::default().tolerance);
        let steps = self.steps.map_or(String::new(), |steps| format!(", {steps} steps"));
        format!(
            "exponential Gauss-Legendre collocation, {} nodes, adaptive steps, tolerance {tolerance} of the gap{steps}",
            NODES
        )
    }

    /// The device in SI units.
    pub fn device(&self) -> Vec<(&'static str, String)> {
        let Ok(device) = self.scenario.device() else { return Vec::new() };
        let mut rows: Vec<(&'static str, String)> = Dimension::ALL
            .iter()
            .map(|dimension| {
                let value = device.get(*dimension);
                let value = if value.is_finite() { exact(rounded(value)) } else { "open circuit".to_owned() };
                let unit = self.scenario.scaling.unit(dimension.fact().unit);
                (dimension.field(), format!("{value} {unit}").trim_end().to_owned())
            })
            .collect();
        let poles = if device.repelling { "repelling" } else { "attracting" };
        rows.push(("magnets", poles.to_owned()));
        let scaling = match self.scenario.scaling {
            ElectricalScaling::AsPrinted => "as printed",
            ElectricalScaling::Consistent => "consistent",
        };
        rows.push(("scaling", scaling.to_owned()));
        rows
    }

    /// One line for a figure's caption.
    pub fn caption(&self) -> String {
        let numbers: Vec<String> = Parameter::ALL
            .into_iter()
            .map(|parameter| {
                let value = super::number::typographic(&exact(self.scenario.parameters.get(parameter)));
                format!("{} = {value}", parameter.fact().symbol)
            })
            .collect();
        let notes: String = self.notes.iter().map(|(name, value)| format!("; {name}: {value}")).collect();
        let text = format!("{}; {}; {}{notes}. {PROGRAM}", numbers.join(", "), self.model(), self.run());
        // Lines break between statements only.
        text.replace(" = ", "\u{a0}=\u{a0}").replacen(" mode", "\u{a0}mode", 1)
    }
}

/// Without the rounding that the way through the ten numbers leaves in the last digits.
pub(super) fn rounded(value: f64) -> f64 {
    super::number::round_significant(value, 12)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn everything_that_a_repetition_needs_is_said() {
        let mut scenario = Scenario { initial: Some(vec![0.0, 0.1, 0.0, 0.0, -2.5]), ..Default::default() };
        scenario.parameters.alpha = 1e-4;
        let source = Provenance {
            scenario,
            steps: Some(1234),
            notes: vec![("sweep", "up".to_owned())],
            link: "https://example.org/#v=1".to_owned(),
        };
        let lines = source.lines();
        let value = |name: &str| &lines.iter().find(|(key, _)| key == name).expect(name).1;
        assert_eq!(value("alpha"), "1e-4");
        assert_eq!(value("kappa"), "1e-6 per V^2");
        assert_eq!(value("model"), "2 modes, quadratic magnet force");
        assert_eq!(value("run"), "from (0 0.1 0 0 -2.5) as q_1..q_N, their rates, v until t = 600");
        assert!(value("solver").ends_with("8 nodes, adaptive steps, tolerance 1e-5 of the gap, 1234 steps"));
        assert_eq!(value("sweep"), "up");
        assert!(source.caption().ends_with(&format!("; sweep: up. {PROGRAM}")), "{}", source.caption());
        assert_eq!(value("device.beam_length"), "0.48 m");
        assert_eq!(value("link"), "https://example.org/#v=1");
        let caption = source.caption().replace('\u{a0}', " ");
        assert!(caption.starts_with("α = 1e−4, β = 0.001, ω = 25, c₀ = 0.5084"), "{caption}");
    }
}
