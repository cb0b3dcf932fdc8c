//! What the curves over frequency are drawn on: the choice of their axes, and where values stand on them.

use egui::Ui;
use egui_plot::PlotPoint;

use crate::app::panels::Context;
use crate::app::text::tr;
use crate::app::view::design::{DesignView, Watched};
use crate::app::widgets::number::prefix;
use crate::app::widgets::plot_style::Axis;
use crate::app::widgets::{chips, chips_after, row};
use crate::questions::design::HarvestPoint;

/// Chooses what the vertical axis measures, and the scales of both.
pub(in crate::app::panels) fn choose(context: &mut Context<'_>, ui: &mut Ui) {
    let before = &context.view.design;
    let mut design = before.clone();
    let choices = [
        (Watched::Power, tr("power")),
        (Watched::PerG2, tr("per g²")),
        (Watched::Voltage, tr("V rms")),
        (Watched::Peak, tr("V peak")),
        (Watched::Tip, tr("tip")),
    ];
    let scales = [(false, tr("linear")), (true, tr("log"))];
    row(ui, |ui| {
        chips(ui, tr("Over frequency"), &mut design.watched, &choices);
        if design.watched != Watched::Tip {
            chips(ui, tr("Scale"), &mut design.logarithmic, &scales);
        }
        chips_after(ui, "f", tr("Scale of the frequency"), &mut design.logarithmic_frequency, &scales);
    });
    if design != *before {
        context.redesign(|present| *present = design);
    }
}

/// Both axes.
pub(in crate::app) struct Measure {
    watched: Watched,
    factor: f64,
    axis: Axis,
    frequency: Axis,
}

impl Measure {
    /// As chosen, for values up to `highest`, in SI units.
    pub(in crate::app) fn new(design: &DesignView, highest: f64) -> Self {
        let watched = design.watched;
        let (factor, sign) = if watched == Watched::Tip { (1.0, "") } else { prefix(highest) };
        let (name, symbol, unit) = match watched {
            Watched::Power => (tr("power in the load"), "P", "W"),
            Watched::PerG2 => (tr("power per g²"), "P/a²", "W/g²"),
            Watched::Voltage => (tr("voltage, rms"), "v", "V"),
            Watched::Peak => (tr("largest voltage"), "v", "V"),
            Watched::Tip => (tr("tip"), "s", "mm"),
        };
        let scaled = |axis: Axis, logarithmic| if logarithmic { axis.logarithmic() } else { axis };
        let axis = Axis::new(name, symbol).unit(format!("{sign}{unit}"));
        let frequency = Axis::new(tr("excitation frequency"), "f").unit("Hz");
        Self {
            watched,
            factor,
            axis: scaled(axis, design.logarithmic && watched != Watched::Tip),
            frequency: scaled(frequency, design.logarithmic_frequency),
        }
    }

    /// One value in SI units (mm for the tip), or two where there is a range.
    pub(in crate::app::panels) fn values(&self, point: &HarvestPoint) -> [f64; 2] {
        values(self.watched, point)
    }

    /// Where a value in SI units is drawn.
    pub(in crate::app) fn coordinate(&self, value: f64) -> f64 {
        self.axis.coordinate(self.factor * value)
    }

    /// The vertical axis.
    pub(in crate::app) fn axis(&self) -> &Axis {
        &self.axis
    }

    /// The axis of frequencies (Hz).
    pub(in crate::app) fn frequency(&self) -> &Axis {
        &self.frequency
    }

    /// Where a value in SI units at a frequency (Hz) is drawn.
    pub(in crate::app) fn place(&self, frequency: f64, value: f64) -> PlotPoint {
        PlotPoint::new(self.frequency.coordinate(frequency), self.coordinate(value))
    }

    /// A curve of one side of that range.
    pub(in crate::app::panels) fn line(&self, points: &[HarvestPoint], side: usize) -> Vec<PlotPoint> {
        let place = |point: &HarvestPoint| self.place(point.frequency, self.values(point)[side]);
        points.iter().map(place).collect()
    }
}

/// One value in SI units (mm for the tip), or two where there is a range.
pub(in crate::app::panels) fn values(watched: Watched, point: &HarvestPoint) -> [f64; 2] {
    match watched {
        Watched::Power => [point.measures.power; 2],
        Watched::PerG2 => [point.power_per_g2; 2],
        Watched::Voltage => [point.measures.v_rms; 2],
        Watched::Peak => [point.measures.v_peak; 2],
        Watched::Tip => [point.measures.tip.0, point.measures.tip.1],
    }
}
