//! What the vertical axis of the curves over frequency measures.

use egui_plot::PlotPoint;

use crate::app::text::tr;
use crate::app::view::design::Watched;
use crate::app::widgets::number::prefix;
use crate::app::widgets::plot_style::Axis;
use crate::questions::design::HarvestPoint;

/// What the vertical axis measures.
pub(in crate::app) struct Measure {
    watched: Watched,
    factor: f64,
    axis: Axis,
}

impl Measure {
    /// For values up to `highest`, in SI units.
    pub(in crate::app) fn new(watched: Watched, logarithmic: bool, highest: f64) -> Self {
        let (factor, sign) = if watched == Watched::Tip { (1.0, "") } else { prefix(highest) };
        let (name, symbol, unit) = match watched {
            Watched::Power => (tr("power in the load"), "P", "W"),
            Watched::PerG2 => (tr("power per g²"), "P/a²", "W/g²"),
            Watched::Voltage => (tr("voltage, rms"), "v", "V"),
            Watched::Peak => (tr("largest voltage"), "v", "V"),
            Watched::Tip => (tr("tip"), "s", "mm"),
        };
        let axis = Axis::new(name, symbol).unit(format!("{sign}{unit}"));
        let axis = if logarithmic && watched != Watched::Tip { axis.logarithmic() } else { axis };
        Self { watched, factor, axis }
    }

    /// One value in SI units (mm for the tip), or two where there is a range.
    pub(in crate::app::panels) fn values(&self, point: &HarvestPoint) -> [f64; 2] {
        values(self.watched, point)
    }

    /// Where a value in SI units is drawn.
    pub(in crate::app) fn coordinate(&self, value: f64) -> f64 {
        self.axis.coordinate(self.factor * value)
    }

    /// Its axis.
    pub(in crate::app) fn axis(&self) -> &Axis {
        &self.axis
    }

    /// A curve of one side of that range.
    pub(in crate::app::panels) fn line(&self, points: &[HarvestPoint], side: usize) -> Vec<PlotPoint> {
        let place =
            |point: &HarvestPoint| PlotPoint::new(point.frequency, self.coordinate(self.values(point)[side]));
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
