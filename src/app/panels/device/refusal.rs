//! Why a device was refused, in the dimensions and units of the page.

use crate::app::text::tr;
use crate::app::widgets::number::{short, significant};
use crate::model::{Device, Dimension, ElectricalScaling, ModelError, Parameter};
use crate::sentence::{Say as _, Sentence, said};

/// The reason; for a dimensionless number out of its range, the dimension that decides it.
pub(super) fn in_words(device: &Device, scaling: ElectricalScaling, error: &ModelError) -> Sentence {
    let told = match error {
        ModelError::OutOfRange { field, value, .. } => out_of_range(device, scaling, field, *value),
        ModelError::PullIn { smallest, .. } => Some(pull_in(device, *smallest)),
        ModelError::GapClosed { sag, distance } => Some(said(
            "under gravity the tip sags {sag} mm: the distance D = {distance} mm must be larger",
            &[("sag", &short(1e3 * sag)), ("distance", &short(1e3 * distance))],
        )),
        _ => None,
    };
    told.unwrap_or_else(|| error.say())
}

/// What the dimension may be as long as the others stay: Eq. (8) solved at both ends of the number's range.
fn out_of_range(device: &Device, scaling: ElectricalScaling, field: &str, value: f64) -> Option<Sentence> {
    let parameter = Parameter::named(field)?;
    let dimension = Dimension::ALL.into_iter().find(|other| other.decided_by() == Some(parameter))?;
    let set = device.dimensionless(scaling).ok()?;
    let at = |end: f64| {
        let mut set = set;
        *set.get_mut(parameter) = end;
        Device::from_parameters(device, &set, scaling).ok().map(|device| device.get(dimension))
    };
    let (low, high) = parameter.range();
    // The sign of c0 is that of the magnets.
    let (first, last) = (at(if parameter == Parameter::C0 { 0.0 } else { low })?, at(high)?);
    let fact = dimension.fact();
    let (unit, factor) = (scaling.unit(fact.shown.0), fact.shown.1);
    let text = |value: f64| format!("{} {unit}", significant(factor * value, 4));
    let title = [tr(fact.name), fact.base()].join(" ");
    let present = text(device.get(dimension));
    let number = format!("{field} = {}", short(value));
    let (least, most) = (first.min(last), first.max(last));
    Some(if most.is_finite() {
        said(
            "{dimension} = {value} is out of range here: allowed are {least} to {most} ({number})",
            &[
                ("dimension", &title.trim_end()),
                ("value", &present),
                ("least", &text(least)),
                ("most", &text(most)),
                ("number", &number),
            ],
        )
    } else {
        said(
            "{dimension} = {value} is out of range here: allowed are {least} and more ({number})",
            &[
                ("dimension", &title.trim_end()),
                ("value", &present),
                ("least", &text(least)),
                ("number", &number),
            ],
        )
    })
}

/// The smallest distance that the beam can hold against the magnets.
fn pull_in(device: &Device, smallest: f64) -> Sentence {
    let least = smallest * device.beam_length + device.sag();
    said(
        "the magnets attract so strongly that they pull the tip in: the distance D = {distance} mm must be larger than \
         {least} mm",
        &[
            ("distance", &significant(1e3 * device.magnet_distance, 4)),
            // Rounded up, so that what is told holds.
            ("least", &significant(1e3 * least * 1.0005, 4)),
        ],
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::inverse::Magnets;
    use crate::scenario::Scenario;

    fn refusal(device: &Device) -> String {
        let (mut scenario, scaling) = (Scenario::default(), ElectricalScaling::Consistent);
        let found = scenario.set_device(*device, scaling).and_then(|()| scenario.validate().map(|_| ()));
        found.map_or_else(|error| in_words(device, scaling, &error).to_string(), |()| String::new())
    }

    #[test]
    fn the_ends_told_are_where_a_dimension_begins_to_be_refused() {
        let device = Device::default();
        for dimension in Dimension::ALL {
            let Some(parameter) = dimension.decided_by() else { continue };
            let at = |number: f64| {
                let mut set = device.dimensionless(ElectricalScaling::Consistent).expect("a device");
                *set.get_mut(parameter) = number;
                Device::from_parameters(&device, &set, ElectricalScaling::Consistent).expect("a device")
            };
            let (_, high) = parameter.range();
            assert_eq!(refusal(&at(0.999 * high)), "", "{dimension:?}");
            let told = refusal(&at(1.01 * high));
            let end = dimension.fact().shown.1 * at(high).get(dimension);
            assert!(told.contains("is out of range here"), "{told}");
            assert!(told.contains(&significant(end, 4)), "{dimension:?} {end}: {told}");
        }
        let told = refusal(&Device { magnet_distance: 100.0, ..device });
        let expected = "Distance D = 100000 mm is out of range here: allowed are ";
        assert!(told.starts_with(expected) && told.ends_with("(d = 208)"), "{told}");
        let told = refusal(&Device { resistance: 1.0, ..device });
        assert!(
            told.starts_with("Load R = 1.000e−6 MΩ is") && told.contains(" and more (kappa = "),
            "{told}"
        );
    }

    #[test]
    fn a_pull_in_tells_a_distance_that_holds() {
        let attracting = Device::default().with_magnets(Magnets::Attracting, &Device::default());
        let told = refusal(&attracting);
        let least = told.rsplit("than ").next().and_then(|text| text.trim_end_matches(" mm").parse().ok());
        let least: f64 = least.unwrap_or_else(|| panic!("{told}"));
        let at = |millimetres: f64| Device { magnet_distance: 1e-3 * millimetres, ..attracting };
        assert_eq!(refusal(&at(least)), "");
        assert!(refusal(&at(0.998 * least)).starts_with("the magnets attract so strongly"));
    }
}
