//! The dimensions that are varied, and their ranges.

use egui::{RichText, Ui};

use crate::app::bench::questions;
use crate::app::panels::{Context, facts};
use crate::app::text::tr;
use crate::app::theme;
use crate::app::view::design::Side;
use crate::app::widgets::number::round_significant;
use crate::app::widgets::{ParameterSlider, chips};
use crate::model::Dimension;

/// Two dimensions for the map, and a third for the search.
pub(super) fn sides(context: &mut Context<'_>, ui: &mut Ui) {
    let mut search = context.view.design.search;
    let names = [tr("Across"), tr("Up")];
    for (i, name) in names.into_iter().enumerate() {
        side(context, ui, name, &mut search.sides[i]);
    }
    if search.sides[0].dimension == search.sides[1].dimension {
        // The other side takes what this one had.
        let before = context.view.design.search.sides;
        let changed = usize::from(search.sides[0] == before[0]);
        search.sides[1 - changed] = Side::of(before[changed].dimension);
    }
    let mut third = search.third.is_some();
    if chips(ui, tr("Third"), &mut third, &[(false, tr("two")), (true, tr("three in the search"))]) {
        search.third = third.then(|| Side::of(Dimension::MagnetDistance));
    }
    if let Some(third) = &mut search.third {
        side(context, ui, tr("Besides"), third);
    }
    let doubled =
        search.third.is_some_and(|third| search.sides.iter().any(|side| side.dimension == third.dimension));
    if doubled {
        let taken = search.sides.map(|side| side.dimension);
        let free = Dimension::ALL.into_iter().find(|dimension| !taken.contains(dimension));
        search.third = free.map(Side::of);
    }
    if search != context.view.design.search {
        context.redesign(|design| design.search = search);
    }
}

/// A dimension to choose, and its range.
fn side(context: &Context<'_>, ui: &mut Ui, name: &str, side: &mut Side) {
    let fact = side.dimension.fact();
    let (unit, factor) = (context.view.scenario.scaling.unit(fact.shown.0), fact.shown.1);
    ui.push_id(name, |ui| {
        ui.horizontal(|ui| {
            let colour = theme::tokens(ui).text_weak;
            ui.label(RichText::new(name).small().color(colour));
            egui::ComboBox::from_id_salt("dimension").width(190.0).selected_text(tr(fact.title)).show_ui(
                ui,
                |ui| {
                    for dimension in Dimension::ALL {
                        if ui
                            .selectable_label(dimension == side.dimension, tr(dimension.fact().title))
                            .clicked()
                        {
                            *side = Side::of(dimension);
                        }
                    }
                },
            );
        });
        let (low, high) = questions::range_of(context.view, context.session, side);
        let usual = facts::usual(fact);
        let (mut from, mut to) = (round_significant(factor * low, 6), round_significant(factor * high, 6));
        let before = (from, to);
        let (least, most) = (usual.0.min(from), usual.1.max(to));
        for (end, value) in [(tr("From"), &mut from), (tr("To"), &mut to)] {
            let slider = ParameterSlider::new(end, "", value, least..=most).unit(unit).compact();
            facts::spread(slider, fact, least).tooltip(tr(fact.name)).show(ui);
        }
        if (from, to) != before {
            side.range = Some((from / factor, to / factor));
        }
    });
}
