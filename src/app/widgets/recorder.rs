//! Records what is drawn, for exported files. It records only while `app::exporting` draws a frame for that purpose; in
//! ordinary frames its functions do nothing.

use std::collections::HashMap;
use std::sync::{Arc, Mutex};

use egui::{Color32, Context, Id, TextureId};
use egui_plot::PlotUi;

use super::series::Series;
use crate::app::theme;
use crate::export::figure::{Cells, Key};
use crate::export::{Axis, Figure, Layer, Rgba};

/// What was drawn so far.
#[derive(Debug, Default)]
pub struct Recorder {
    /// The card being drawn.
    card: String,
    /// Its legend.
    names: Vec<(Series, String)>,
    keys: Vec<Key>,
    /// Pixels of the pictures that were made.
    pictures: HashMap<TextureId, ((usize, usize), Vec<Rgba>)>,
    /// All plots with the titles of their cards.
    pub figures: Vec<Figure>,
}

type Shared = Arc<Mutex<Recorder>>;

fn id() -> Id {
    Id::unique("recorder")
}

/// Begins to record in `context`.
pub fn start(context: &Context) {
    context.data_mut(|data| data.insert_temp(id(), Shared::default()));
}

/// Ends it; the plots of each card, in the order in which they were drawn, and none twice.
pub fn finish(context: &Context) -> Vec<Figure> {
    let shared: Option<Shared> = context.data_mut(|data| data.remove_temp(id()));
    let taken = shared.and_then(|shared| shared.lock().ok().map(|mut found| std::mem::take(&mut *found)));
    let mut figures = taken.unwrap_or_default().figures;
    figures.retain(Figure::is_usable);
    figures
}

/// Changes the recorder, if there is one.
fn with(context: &Context, change: &mut dyn FnMut(&mut Recorder)) {
    let shared: Option<Shared> = context.data(|data| data.get_temp(id()));
    if let Some(shared) = shared
        && let Ok(mut recorder) = shared.lock()
    {
        change(&mut recorder);
    }
}

/// Whether anything is taken down.
pub fn is_on(context: &Context) -> bool {
    context.data(|data| data.get_temp::<Shared>(id())).is_some()
}

/// A card begins.
pub fn card(context: &Context, title: &str) {
    with(context, &mut |recorder| {
        recorder.card = title.to_owned();
        recorder.names.clear();
        recorder.keys.clear();
    });
}

/// An entry of a legend.
pub fn name(context: &Context, series: Series, label: &str) {
    with(context, &mut |recorder| recorder.names.push((series, label.to_owned())));
}

/// An entry of a legend of colours.
pub fn key(context: &Context, make: &mut dyn FnMut() -> Key) {
    with(context, &mut |recorder| match recorder.figures.last_mut() {
        Some(figure) if figure.title == recorder.card => figure.keys.push(make()),
        _ => recorder.keys.push(make()),
    });
}

/// A plot begins. Axes without names are those of the plot before it in the same card.
pub fn begin(context: &Context, x: &Axis, y: &Axis) {
    with(context, &mut |recorder| {
        let before = recorder.figures.iter().rev().find(|figure| figure.title == recorder.card);
        let before = before.and_then(|figure| figure.axes.clone());
        let nameless = x.title().is_empty() && y.title().is_empty();
        let axes = before.filter(|_| nameless).unwrap_or_else(|| [x.clone(), y.clone()]);
        let keys = std::mem::take(&mut recorder.keys);
        let title = recorder.card.clone();
        recorder.figures.push(Figure { title, axes: Some(axes), keys, ..Figure::default() });
    });
}

/// Something is drawn into the plot that began last.
pub fn draw(plot: &PlotUi<'_>, make: &mut dyn FnMut() -> Layer) {
    with(plot.ctx(), &mut |recorder| {
        let Some(figure) = recorder.figures.last_mut() else { return };
        if figure.layers.is_empty() {
            let bounds = plot.plot_bounds();
            let ([left, bottom], [right, top]) = (bounds.min(), bounds.max());
            figure.ranges = [(left, right), (bottom, top)];
            let frame = plot.transform().frame();
            figure.aspect = f64::from(frame.height() / frame.width());
            let [across, up] =
                [plot.transform().dpos_dvalue_x(), plot.transform().dpos_dvalue_y()].map(f64::abs);
            figure.equal_scale = (across / up - 1.0).abs() < 1e-3;
        }
        figure.layers.push(make());
    });
}

/// Something is laid over the plot that began last.
pub fn over(context: &Context, make: &mut dyn FnMut() -> Layer) {
    with(context, &mut |recorder| {
        if let Some(figure) = recorder.figures.last_mut() {
            figure.layers.push(make());
        }
    });
}

/// What of the plot that began last is to be seen upwards: the page may keep room for what is laid over it.
pub fn show_upwards(context: &Context, low: f64, high: f64) {
    with(context, &mut |recorder| {
        if let Some(figure) = recorder.figures.last_mut() {
            figure.ranges[1] = (low, high);
        }
    });
}

/// The name of a series in the legend: that of the card's legend, where it has one for its kind.
pub fn legend_name(context: &Context, series: Series, name: &str) -> String {
    let mut found = name.to_owned();
    with(context, &mut |recorder| {
        let entry = recorder.names.iter().find(|(kind, _)| *kind == series && series != Series::Ghost);
        if let Some((_, label)) = entry {
            found.clone_from(label);
        }
    });
    found
}

/// A picture was made.
pub fn picture(context: &Context, texture: TextureId, size: [usize; 2], pixels: &[Color32]) {
    with(context, &mut |recorder| {
        let pixels = pixels.iter().map(|colour| rgba(*colour)).collect();
        recorder.pictures.insert(texture, ((size[0], size[1]), pixels));
    });
}

/// A picture is drawn over a rectangle.
pub fn draw_picture(plot: &PlotUi<'_>, texture: TextureId, place: [(f64, f64); 2], opacity: f32) {
    let mut found = None;
    with(plot.ctx(), &mut |recorder| found = recorder.pictures.get(&texture).cloned());
    if let Some((size, pixels)) = found {
        draw(plot, &mut || Layer::Picture { size, pixels: pixels.clone(), place, opacity });
    }
}

/// The values behind a picture: of `columns` x `rows` cells with their middles at the ends of the `ranges`.
pub fn cells(
    plot: &PlotUi<'_>,
    name: &str,
    size: (usize, usize),
    ranges: [(f64, f64); 2],
    value: &dyn Fn(usize, usize) -> Option<String>,
) {
    with(plot.ctx(), &mut |recorder| {
        let Some(figure) = recorder.figures.last_mut() else { return };
        let places = (0..size.1).flat_map(|row| (0..size.0).map(move |column| (column, row)));
        let values = places.map(|(column, row)| value(column, row).unwrap_or_default()).collect();
        figure.cells.push(Cells { name: name.to_owned(), size, ranges, values });
    });
}

/// A colour with its opacity apart.
pub fn rgba(colour: Color32) -> Rgba {
    colour.to_srgba_unmultiplied()
}

/// A kind's colour in the theme in force.
pub fn colour_of(plot: &PlotUi<'_>, series: Series) -> Rgba {
    rgba(series.colour(theme::tokens_in(plot.ctx())))
}
