//! The panels by their names.

use serde::{Deserialize, Serialize};

/// Gives all panels to a macro: the name of each, and its file in `app/panels`. A line here and that file are a panel.
/// Tabs show theirs in this order.
macro_rules! panels {
    ($to:ident) => {
        $to! {
            StabilityMap stability_map
            PhasePortrait phase_portrait
            PoincareMap poincare_map
            TimeHistory time_history
            Oscilloscope oscilloscope
            LivePortrait live_portrait
            LiveBeam live_beam
            Chart chart
            Multipliers multipliers
            Curves curves
            Basins basins
            Spectrum spectrum
            Evidence evidence
            OrbitDiagram orbit_diagram
            Response response
            Harvest harvest
            Load load
            Store store
            MagnetForce magnet_force
            DesignMap design_map
            Tolerances tolerances
            Measured measured
            ShakenVoltage shaken_voltage
            ShakenSpectrum shaken_spectrum
            ShakenPower shaken_power
            ShakenWith shaken_with
            Variants variants
        }
    };
}
pub(in crate::app) use panels;

macro_rules! names {
    ($($name:ident $file:ident)*) => {
        /// The panels, each of which can be made large.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
        #[serde(rename_all = "snake_case")]
        pub enum Panel {
            $(#[doc = concat!("What `app/panels/", stringify!($file), ".rs` draws.")] $name,)*
        }

        impl Panel {
            /// All of them in their order.
            pub const ALL: &[Self] = &[$(Self::$name),*];
        }
    };
}
panels!(names);
