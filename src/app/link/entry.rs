//! Single entries of a view, by the names and in the spelling that links have.

use super::field::fields;
use super::{Problem, unknown};
use crate::app::bench;
use crate::app::view::View;
use crate::model::{Device, Dimension, ModelError};
use crate::sentence::{Say as _, Sentence};

/// The entries of these names as text; names that links do not have are left out.
pub fn entries(view: &View, names: &[&'static str]) -> Vec<(&'static str, String)> {
    let (value, fields) = (view.to_value(), fields());
    let text = |name: &&'static str| {
        let field = fields.iter().find(|field| field.name == **name)?;
        Some((*name, field.write(field.of(&value))))
    };
    names.iter().filter_map(text).collect()
}

/// `view` with another value in the entry `name`.
///
/// # Errors
/// What is wrong with it, and what is allowed.
pub fn edit(view: &View, name: &str, text: &str) -> Result<View, Problem> {
    let problem = |reason: Sentence| Problem::new(name, text, reason);
    let fields = fields();
    let field = fields.iter().find(|field| field.name == name);
    let field = field.ok_or_else(|| problem(unknown()))?;
    let mut value = view.to_value();
    let new = field.read(text, &value).map_err(problem)?;
    field.set(&mut value, &new);
    let mut edited = View::from_value(value).map_err(|error| problem(error.into()))?;
    if let Some(allowed) = edited.check().err().and_then(|fault| field.allowed(&fault)) {
        return Err(problem(allowed));
    }
    if let Some(device) = edited_device(view, name, &edited) {
        let device = device.map_err(|error| problem(error.into()))?;
        let scaling = view.scenario.scaling;
        edited.scenario = view.scenario.clone();
        edited.scenario.set_device(device, scaling).map_err(|error| problem(error.into()))?;
    }
    let modes = edited.scenario.model.modes;
    if modes != view.scenario.model.modes {
        // A start state has as many numbers as the modes need.
        edited.scenario = view.scenario.clone();
        edited.scenario.set_modes(modes);
    }
    if edited.tab != view.tab {
        edited.enlarged = None;
    }
    edited.check().map_err(|fault| problem(fault.say()))?;
    Ok(edited)
}

/// The device in view with the entry `name` of the one stored in `edited`, where the ten numbers decide that entry;
/// stored alone, it would play no role.
fn edited_device(view: &View, name: &str, edited: &View) -> Option<Result<Device, ModelError>> {
    let dimension = Dimension::named(name)?;
    let stored = edited.scenario.device.filter(|_| dimension.decided_by().is_some())?;
    Some(bench::device(&view.scenario).map(|device| device.with(dimension, stored.get(dimension))))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::view::{Panel, Tab};
    use crate::model::ForceLaw;

    #[test]
    fn an_entry_is_written_as_it_is_read() {
        let mut view = View { enlarged: Some(Panel::TimeHistory), ..View::default() };
        view.scenario.initial = Some(vec![0.1, 0.2, 0.3, 0.4, 0.5]);
        let edits =
            [("alpha", "0.002"), ("omega", "8.25"), ("force", "taylor5"), ("modes", "3"), ("tab", "sweep")];
        for (name, text) in edits {
            view = edit(&view, name, text).expect("a value in range");
        }
        assert_eq!(view.scenario.parameters.omega, 8.25);
        assert_eq!(view.scenario.model.force, ForceLaw::Taylor(5));
        assert_eq!(view.scenario.initial, Some(vec![0.1, 0.2, 0.0, 0.3, 0.4, 0.0, 0.5]));
        assert_eq!((view.tab, view.enlarged), (Tab::Sweep, None));
        let names = edits.map(|(name, _)| name);
        let written = entries(&view, &names);
        assert_eq!(written, edits.map(|(name, text)| (name, text.to_owned())));
    }

    #[test]
    fn a_dimension_that_the_ten_numbers_decide_sets_that_of_the_device_in_view() {
        let before = View::default();
        let device = before.scenario.device().expect("a device");
        let edited = edit(&before, "frequency", "20").expect("in range");
        let found = edited.scenario.device().expect("a device");
        assert!((found.frequency / 20.0 - 1.0).abs() < 1e-12, "{found:?}");
        assert!((found.base_amplitude / device.base_amplitude - 1.0).abs() < 1e-12);
        let edited = edit(&edited, "resistance", "1e6").expect("in range");
        let found = edited.scenario.device().expect("a device");
        assert!((found.resistance / 1e6 - 1.0).abs() < 1e-12 && (found.frequency / 20.0 - 1.0).abs() < 1e-12);
        let refusal = edit(&before, "frequency", "1e4").expect_err("beyond omega").to_string();
        assert!(refusal.starts_with("frequency = 1e4 (omega = "), "{refusal}");
        // What the numbers leave open keeps them, as in a link.
        let longer = edit(&before, "beam_length", "0.6").expect("in range");
        assert_eq!(longer.scenario.parameters, before.scenario.parameters);
    }

    #[test]
    fn a_bad_value_is_refused_with_what_is_allowed() {
        let view = View::default();
        let refusal = |name, text| edit(&view, name, text).expect_err("refused").to_string();
        assert_eq!(refusal("beta", "7"), "beta = 7 (allowed are 0 to 0.2)");
        assert_eq!(refusal("modes", "9"), "modes = 9 (allowed are whole numbers from 1 to 8)");
        assert!(refusal("omega", "").starts_with("omega =  ("), "{}", refusal("omega", ""));
        assert!(refusal("tab", "dance").contains("allowed are explore, "));
        assert_eq!(refusal("colour", "red"), "colour = red (not a name this page knows)");
    }
}
