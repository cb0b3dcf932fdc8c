//! The limits of the device in view: what keeps them, and what they look like in plots.

use egui::Color32;
use egui_plot::{PlotPoint, PlotUi};

use crate::app::bench;
use crate::app::session::Session;
use crate::app::text::{fill, tr};
use crate::app::theme::{self, Tokens};
use crate::app::view::View;
use crate::app::widgets::number::with_unit;
use crate::app::widgets::plot_style;
use crate::dynamics::Measures;
use crate::export::Pen;
use crate::export::figure::Anchor;
use crate::model::Demand;
use crate::model::limits::{Assessment, Check, LimitKind, Standing, sag};
use crate::questions::design::Bounds;
use crate::scenario::Scenario;
use crate::scheduler::piece::fingerprint;

/// The limits of the device in view.
pub(in crate::app) struct Safety(pub Bounds);

impl Safety {
    /// Of the device in view, when it is one.
    pub(in crate::app) fn of(view: &View, session: &Session) -> Option<Self> {
        let gap = session.boundaries.as_ref()?.gap;
        Some(Self(Bounds { limits: bench::limits(view), gap, units: view.scenario.units() }))
    }

    /// How a demand stands to each of them.
    pub(in crate::app) fn checks(&self, demand: &Demand) -> Vec<Check> {
        self.0.limits.checks(demand, self.0.gap)
    }

    /// A number that is another one for other limits, so that a picture knows when it is old.
    pub(in crate::app) fn fingerprint(&self) -> u64 {
        fingerprint(&(self.0.limits, self.0.gap))
    }

    /// What a demand breaks, in words; empty when it keeps all.
    pub(in crate::app) fn broken(&self, demand: &Demand) -> Vec<String> {
        let checks = self.checks(demand);
        checks.iter().filter(|check| check.standing != Standing::Within).map(in_words).collect()
    }

    /// Lowest and highest tip displacement (mm) that keep them.
    pub(in crate::app::panels) fn tip(&self) -> (f64, f64) {
        let Bounds { limits, gap, units } = self.0;
        let most = limits.deflection;
        let lowest = gap.map_or(most, |gap| most.min(limits.gap * gap));
        (units.millimetres(-lowest), units.millimetres(most))
    }

    /// Draws horizontal limits of a plot of voltages (V), with their names from x = `left`.
    pub(in crate::app::panels) fn voltage_lines(
        &self,
        plot: &mut PlotUi<'_>,
        left: f64,
        coordinate: &dyn Fn(f64) -> f64,
    ) {
        if let Some((low, high)) = self.0.limits.voltage {
            line(plot, [left, coordinate(low)], tr("largest voltage allowed"));
            if high > low {
                line(plot, [left, coordinate(high)], tr("upper end of the range published"));
            }
        }
    }

    /// Draws those of a plot of tip displacements (mm).
    pub(in crate::app::panels) fn tip_lines(&self, plot: &mut PlotUi<'_>, left: f64) {
        let (low, high) = self.tip();
        let Bounds { limits, gap, .. } = self.0;
        let closes = gap.is_some_and(|gap| limits.gap * gap < limits.deflection);
        let contact =
            if limits.gap >= 1.0 { tr("contact of the magnets") } else { tr("part of the gap allowed") };
        line(plot, [left, low], if closes { contact } else { tr("largest deflection allowed") });
        line(plot, [left, high], tr("largest deflection allowed"));
    }
}

fn line(plot: &mut PlotUi<'_>, [left, at]: [f64; 2], name: &str) {
    let colour = theme::tokens_in(plot.ctx()).danger;
    if at.is_finite() {
        plot_style::rule(plot, false, name, at, colour, Pen::Line(1.6));
        plot_style::label(plot, &format!(" {name}"), [left, at], colour, Anchor::Left);
    }
}

/// Of `points`, those that go beyond the bounds, by what `measures` (in SI units) says of each.
pub(in crate::app::panels) fn beyond<T>(
    bounds: Option<Bounds>,
    points: &[T],
    measures: &dyn Fn(&T) -> Measures,
    place: &dyn Fn(&T) -> PlotPoint,
) -> Vec<PlotPoint> {
    let Some(bounds) = bounds else { return Vec::new() };
    points.iter().filter(|point| !bounds.allows(&measures(point))).map(place).collect()
}

/// A check in words: `tip closes 49 % of the gap`.
pub(in crate::app) fn in_words(check: &Check) -> String {
    let percent = |value: f64| crate::app::widgets::number::significant(100.0 * value, 2);
    match check.kind {
        LimitKind::Voltage => fill(
            "peak {value}, limit {limit}",
            &[("value", &with_unit(check.value, "V")), ("limit", &with_unit(check.limit, "V"))],
        ),
        LimitKind::Gap if check.limit < 1.0 => fill(
            "gap closed {value} %, limit {limit} %",
            &[("value", &percent(check.value)), ("limit", &percent(check.limit))],
        ),
        LimitKind::Gap => fill("tip closes {percent} % of the gap", &[("percent", &percent(check.value))]),
        LimitKind::Deflection => fill(
            "deflection {value} %, limit {limit} % of L",
            &[("value", &percent(check.value)), ("limit", &percent(check.limit))],
        ),
        LimitKind::Slope => {
            let digits = |value| crate::app::widgets::number::significant(value, 2);
            fill(
                "slope {value}, limit {limit} rad",
                &[("value", &digits(check.value)), ("limit", &digits(check.limit))],
            )
        }
        LimitKind::Sag => fill("sags by {percent} % of its length", &[("percent", &percent(check.value))]),
    }
}

/// What to know of a device that sags too far under gravity for the model.
pub(super) fn too_much_sag(scenario: &Scenario) -> Option<String> {
    let sag = sag(&bench::device(scenario).ok()?);
    (sag.standing == Standing::Exceeded)
        .then(|| fill("the beam {sags}, which the model counts as small", &[("sags", &in_words(&sag))]))
}

/// How a motion stands to the limits: in a word, and the check that is nearest to failing or else the reason.
pub(super) struct Judged {
    pub assessment: Assessment,
    pub word: &'static str,
    pub detail: String,
}

impl Judged {
    /// Of a motion of the device of `scenario` that asks so much of it; none where that is no device.
    pub(super) fn of(safety: &Safety, scenario: &Scenario, demand: &Demand) -> Option<Self> {
        let sag = sag(&bench::device(scenario).ok()?);
        let checks = safety.checks(demand);
        let worst = || worst(&checks).map(in_words).unwrap_or_default();
        let assessment = Assessment::of(&checks, &safety.0.limits, &sag);
        let (word, detail) = match assessment {
            Assessment::WithinLimits => (tr("within limits"), worst()),
            Assessment::Unchecked => (tr("unchecked"), tr("no limit of the voltage is known").to_owned()),
            Assessment::ModelNotValid => (tr("model not valid"), in_words(&sag)),
            Assessment::Marginal => (tr("marginal"), worst()),
            Assessment::Exceeded => (tr("unsafe"), worst()),
        };
        Some(Self { assessment, word, detail })
    }

    /// The word, with the reason where something stands against it.
    pub(super) fn in_words(&self) -> String {
        match self.assessment {
            Assessment::WithinLimits => self.word.to_owned(),
            _ => format!("{} ({})", self.word, self.detail),
        }
    }

    /// The colour of its word.
    pub(super) fn colour(&self, tokens: &Tokens) -> Color32 {
        match self.assessment {
            Assessment::WithinLimits => tokens.ok,
            Assessment::Unchecked => tokens.text_weak,
            Assessment::ModelNotValid | Assessment::Marginal => tokens.warning,
            Assessment::Exceeded => tokens.danger,
        }
    }
}

/// The worst of the checks: the one with the least margin.
fn worst(checks: &[Check]) -> Option<&Check> {
    checks.iter().min_by(|a, b| a.margin.total_cmp(&b.margin))
}

/// The standing of all together.
pub(super) fn standing(checks: &[Check]) -> Standing {
    if checks.iter().any(|check| check.standing == Standing::Exceeded) {
        Standing::Exceeded
    } else if checks.iter().any(|check| check.standing == Standing::Marginal) {
        Standing::Marginal
    } else {
        Standing::Within
    }
}
