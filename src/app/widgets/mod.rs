//! Widgets of the app: each takes plain numbers and texts and reports what the user did; none knows the model.

pub mod badge;
pub mod beam_view;
pub mod card;
pub mod explanation;
pub mod fold;
pub mod hatching;
pub mod icon;
pub mod legend;
pub mod overlay;
pub mod parameter_slider;
pub mod plot_style;
pub mod qr;
pub mod raster;
pub mod recorder;
pub mod row;
pub mod section_view;
pub mod series;
pub mod swatch;
pub mod symbol;
pub mod tabs;
pub mod tile;
pub mod touch;

#[cfg(test)]
pub(super) mod harness;

pub use crate::export::number;
pub use badge::{BadgeKind, badge, sign};
pub use beam_view::BeamView;
pub use card::{Card, CardResponse};
pub use explanation::{explained, words_explained};
pub use fold::Fold;
pub use hatching::{Hatched, hatched};
pub use icon::{Icon, icon_button};
pub use legend::legend_entry;
pub use overlay::Overlay;
pub use parameter_slider::{Mark, ParameterSlider, SliderResponse};
pub use qr::{qr_code, qr_modules};
pub use raster::{draw_raster, fading, raster};
pub use row::row;
pub use series::Series;
pub use swatch::{Filling, attractor_row, colour_bar, swatches};
pub use symbol::symbol;
pub use tabs::{chips, chips_after, tabs};
pub use tile::{Tile, tiles};
