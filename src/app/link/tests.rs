//! Links there and back, old ones, and bad ones.

mod views;

use proptest::prelude::*;

use self::views::view;
use super::*;
use crate::app::lessons::LessonId;
use crate::app::view::design::Side;
use crate::app::view::shake::Recording;
use crate::app::view::{MapWindow, Panel, Tab};
use crate::export::number::shortest;
use crate::model::materials::Ceramic;
use crate::model::{Device, Dimension, ElectricalScaling, ForceLaw, Parameter, ParameterSet};
use crate::questions::chart::Quantity;
use crate::questions::design::published::BIMORPH;
use crate::scenario::{ModelChoice, VERSION};

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1000))]

    #[test]
    fn a_thousand_random_views_round_trip_exactly(view in view()) {
        let link = write(&view);
        let (back, problems) = read(&link, &View::default());
        prop_assert_eq!(&problems, &[], "{}", link);
        prop_assert_eq!(&back, &view, "{}", link);
        // What stands for them in files, too.
        prop_assert_eq!(View::from_value(view.to_value()), Ok(view));
    }

    #[test]
    fn no_text_is_too_strange(text in ".*") {
        let (view, _) = read(&text, &View::default());
        prop_assert!(view.check().is_ok());
    }

    #[test]
    fn no_value_is_too_strange(place in 0..60_usize, text in "[-0-9eE.,+% a-z]{0,12}", other in "[-0-9e. ]{0,6}") {
        let fields = fields();
        let name = &fields[place % fields.len()].name;
        let (view, _) = read(&format!("v=1&{name}={text}&modes=3&c0={other}"), &View::default());
        prop_assert!(view.check().is_ok());
    }
}

/// The paths of all numbers, words and flags.
fn leaves(value: &Value, path: &str, paths: &mut Vec<String>) {
    match value {
        Value::Object(entries) => {
            for (key, value) in entries {
                leaves(value, &format!("{path}/{key}"), paths);
            }
        }
        Value::Array(parts) if parts.iter().any(Value::is_object) => {
            for (i, part) in parts.iter().enumerate() {
                leaves(part, &format!("{path}/{i}"), paths);
            }
        }
        _ => paths.push(path.to_owned()),
    }
}

#[test]
fn every_field_of_a_view_is_in_links_and_no_other() {
    let lesson = LessonId::named("escape");
    let mut view = View { dark: Some(true), enlarged: Some(Panel::Chart), lesson, ..View::default() };
    view.sweep.range = Some((1.0, 2.0));
    view.scenario.device = Some(Device { ceramic: Some(Ceramic::Apc850), ..BIMORPH.device() });
    view.scenario.scaling = ElectricalScaling::Consistent;
    view.scenario.initial = Some(vec![0.0; 5]);
    view.scenario.model.residual_moment = true;
    view.design.search.third = Some(Side::of(Dimension::MagnetDistance));
    view.design.shake.recording = Some(Recording::default());
    let (value, mut paths) = (view.to_value(), Vec::new());
    leaves(&value, "", &mut paths);
    // The version of a scenario is the version of the link.
    paths.retain(|path| path != "/scenario/version");
    // Layers are one entry, whatever they hold.
    const LAYERS: &str = "/scenario/device/layers";
    paths.iter_mut().filter(|path| path.starts_with(LAYERS)).for_each(|path| LAYERS.clone_into(path));
    let mut known: Vec<String> = fields().into_iter().map(|field| field.pointer).collect();
    known.retain(|pointer| pointer != "/scenario/device");
    paths.sort();
    paths.dedup();
    known.sort();
    assert_eq!(paths, known, "a field of View is missing in View::complete, or one there is gone");
    let mut names: Vec<String> = fields().into_iter().map(|field| field.name).collect();
    let all = names.len();
    names.sort();
    names.dedup();
    assert_eq!(names.len(), all, "two entries have one name");
}

#[test]
fn a_link_is_readable() {
    let mut view = View { tab: Tab::Stability, ..View::default() };
    view.scenario = Scenario::default();
    assert_eq!(write(&View { tab: Tab::Explore, ..view.clone() }), "v=1");
    view.scenario.parameters = ParameterSet { alpha: 1e-4, omega: 8.0969, ..Default::default() };
    view.scenario.model = ModelChoice { modes: 3, force: ForceLaw::Taylor(5), residual_moment: true };
    view.scenario.initial = Some(vec![0.01, 0.0, -1e-7, 0.0, 0.0, 0.0, 14.2]);
    view.scenario.device = Some(Device { beam_length: 0.3, resistance: f64::INFINITY, ..Default::default() });
    view.sweep.range = Some((7.5, 8.5));
    view.plane = [Parameter::Omega, Parameter::Alpha];
    let link = "v=1&alpha=1e-4&omega=8.0969&modes=3&force=taylor5&residual_moment=true&initial=0.01+0+-1e-7+0+0+0+14.2\
                &beam_length=0.3&resistance=open&tab=stability&sweep.range=7.5+8.5&plane=omega+alpha";
    assert_eq!(write(&view), link);
    assert_eq!(read(&format!("#{link}"), &View::default()), (view, Vec::new()));
}

/// What an old version knew stands in a new one, which may know more.
fn holds(new: &Value, old: &Value) {
    match (new, old) {
        (Value::Object(entries), Value::Object(known)) => {
            known.iter().for_each(|(name, old)| holds(entries.get(name).expect(name), old));
        }
        _ => assert_eq!(new, old),
    }
}

/// Never change one of these: they stand in people's slides. A default that changes breaks them, too.
#[test]
fn old_links_keep_their_meaning() {
    let usual = r#"{"beam_moves":null,"contrast":null,"dark":null,"enlarged":null,"figure":9,"lang":null,"layer":"multiplier","map":"first",
        "plane":["omega","beta"],"projector":false,"scenario":{"initial":null,"model":{"force":"quadratic","modes":2},
        "parameters":{"alpha":0.001,"beta":0.001,"c":1e-6,"c0":0.5084,"d":0.15,"eta":0.02,"h":0.004167,"kappa":1e-6,
        "omega":25.0,"theta":0.0002},"t_end":600.0,"version":2},"sweep":{"count":240,"dwell":{"discarded":200,"kept":64},
        "output":"voltage","parameter":"omega","range":null},"tab":"explore",
        "design":{"page":"harvest","dimensionless":false,"holds_acceleration":true,"watched":"power",
        "logarithmic":false,"window":null,"least":null,"limits":{"voltage":null,"gap":1.0,"deflection":0.3,"slope":0.3},
        "mode":1,"resonance":"first","quantity":"power","search":{"aim":"power","sides":[{"dimension":"frequency",
        "range":null},{"dimension":"resistance","range":null}],"third":null,"generations":20}},
        "live":{"trace":"voltage","speed":2.0,"periods":12,"kick":0.2},"lesson":null,"step":1}"#;
    let mut usual: Value = serde_json::from_str(usual).expect("JSON");
    usual["scenario"]["version"] = VERSION.into();
    let (mut expected, problems) = read("#v=1", &View::default());
    assert_eq!(problems, []);
    holds(&expected.to_value(), &usual);
    let link = "#v=1&alpha=1e-4&beta=0.01&omega=25.4047&force=exact&t_end=605&tab=paper&map=sum&figure=4";
    expected.scenario.parameters =
        ParameterSet { alpha: 1e-4, beta: 0.01, omega: 25.4047, ..expected.scenario.parameters };
    expected.scenario.model.force = ForceLaw::Exact;
    expected.scenario.t_end = 605.0;
    (expected.tab, expected.map, expected.figure) = (Tab::Paper, MapWindow::Sum, 4);
    assert_eq!(read(link, &View::default()), (expected, Vec::new()));
    let (view, problems) = read("#v=1&tab=stability&layer=voltage", &View::default());
    assert_eq!((view.layer, problems), (Quantity::VRms, Vec::new()));
}

#[test]
fn numbers_are_short_and_read_back() {
    for (value, text) in [
        (1e-4, "1e-4"),
        (0.01, "0.01"),
        (600.0, "600"),
        (0.005, "0.005"),
        (5000.0, "5000"),
        (-0.15, "-0.15"),
        (1e15, "1e15"),
        (0.1 + 0.2, "0.30000000000000004"),
        (0.0, "0"),
    ] {
        assert_eq!(shortest(value), text);
        assert_eq!(text.parse(), Ok(value));
    }
    for wrong in ["", "x", "1,5", "nan", "inf", "-1e999", "0.1000001", "true", "alpha", "1:2"] {
        let (view, found) = reasons(&format!("v=1&alpha={wrong}"));
        assert_eq!(view.scenario.parameters.alpha, 1e-3, "{wrong}");
        assert!(found.len() == 1 && found[0].ends_with("allowed are 0 to 0.1)"), "{found:?}");
    }
    let (view, found) = reasons("v=1&alpha=+0.1+");
    assert_eq!((view.scenario.parameters.alpha, found.len()), (0.1, 0));
}

fn reasons(link: &str) -> (View, Vec<String>) {
    let (view, problems) = read(link, &View::default());
    (view, problems.iter().map(Problem::to_string).collect())
}

#[test]
fn a_bad_link_loads_what_is_valid_and_says_what_was_not() {
    let link = "#v=1&alpha=7&beta=0.01&omega=fast&modes=9&force=taylor99&tab=dance&colour=red&t_end=100\
                &beam_length=-1&resistance=none&sweep.range=1&projector=perhaps";
    let (view, reasons) = reasons(link);
    assert_eq!((view.scenario.parameters.beta, view.scenario.t_end), (0.01, 100.0));
    let rest = ParameterSet { beta: 0.01, ..ParameterSet::default() };
    assert_eq!(view.scenario, Scenario { parameters: rest, t_end: 100.0, ..Scenario::default() });
    assert_eq!(
        reasons,
        [
            "alpha = 7 (allowed are 0 to 0.1)",
            "omega = fast (not a number; allowed are 0.1 to 500)",
            "modes = 9 (allowed are whole numbers from 1 to 8)",
            "force = taylor99 (allowed are quadratic, taylor2 to taylor15 and exact)",
            "tab = dance (allowed are explore, live, stability, sweep, design, paper, lessons)",
            "colour = red (not a name this page knows)",
            "beam_length = -1 (allowed are 1e-15 to 1e15 m)",
            "resistance = none (not a number; allowed are 1e-15 to 1e15 ohm, or open)",
            "sweep.range = 1 (\"1\" stands where a list of 2 values is needed)",
            "projector = perhaps (\"perhaps\" stands where true or false is needed)",
        ]
    );
}

#[test]
fn what_does_not_go_together_is_blamed_on_one_entry() {
    let (view, found) = reasons("v=1&modes=3&initial=1+2+3&beta=0.005");
    assert_eq!((view.scenario.model.modes, view.scenario.initial), (3, None));
    assert_eq!((view.scenario.parameters.beta, found.len()), (0.005, 1));
    assert!(found[0].starts_with("initial = 1 2 3 (numbers in initial = 3"), "{found:?}");

    let (view, found) = reasons("v=1&c0=-5&omega=9&sweep.parameter=alpha&sweep.range=7+8&plane=d+d");
    assert_eq!((view.scenario.parameters.c0, view.scenario.parameters.omega), (0.5084, 9.0));
    assert_eq!((view.sweep.range, found.len()), (None, 3));
    assert!(found[0].starts_with("c0 = -5 (the magnets attract"), "{found:?}");
    assert!(found[1].starts_with("sweep.range = 7 8 (alpha = 7 is out of range"), "{found:?}");
    assert_eq!(found[2], "plane = d d (plane: two different ones of omega, beta, alpha, d, kappa)");
}

#[test]
fn what_is_no_link_changes_nothing_and_a_newer_one_loads_what_is_known() {
    let present = View { tab: Tab::Sweep, dark: Some(true), ..View::default() };
    for nothing in ["", "#", "#footnote", "%ff%00&&&==", "#colour=red"] {
        assert_eq!(read(nothing, &present).0, present, "{nothing}");
    }
    assert_eq!(read("#", &present).1, []);
    assert_eq!(read("#footnote", &present).1.len(), 1);
    let (view, problems) = read("#v=7&beta=0.01&beta=0.02", &present);
    assert_eq!((view.scenario.parameters.beta, view.dark, view.tab), (0.02, Some(true), Tab::Explore));
    assert_eq!(problems[0].to_string(), "v = 7 (this page knows version 1)");
    // A hand-written one may leave the version out.
    assert_eq!(read("beta=0.01", &present).1, []);
}

#[test]
fn a_complaint_stays_short() {
    let (_, problems) = read(&"v=1&x=1".repeat(5000), &View::default());
    let text = complaint(&problems).expect("problems");
    assert!(text.len() < 1000 && text.ends_with("more."), "{text}");
    assert_eq!(complaint(&[]), None);
}

/// What of a sentence is the same in every language.
fn verbatim(sentence: &Sentence) -> Vec<&str> {
    match sentence {
        Sentence::Verbatim(text) => vec![text],
        Sentence::Words { values, .. } => values.iter().flat_map(|(_, value)| verbatim(value)).collect(),
    }
}

/// One entry of every kind, and whatever else can be wrong with a link.
#[test]
fn one_bad_dimension_leaves_the_others() {
    let good = "beam_length=0.25&tip_mass=0.004&flux_density=0.9&magnet_distance=0.05";
    let (all, problems) = read(&format!("v=1&{good}"), &View::default());
    assert!(problems.is_empty(), "{problems:?}");
    for bad in ["capacitance=-1", "beam_mass=heavy", "youngs_modulus=0", "resistance=1e99", "viscosity=NaN"] {
        let (view, problems) = read(&format!("v=1&{bad}&{good}"), &View::default());
        assert_eq!(problems.len(), 1, "{bad}: {problems:?}");
        assert_eq!(view, all, "{bad}");
    }
}

#[test]
fn what_is_wrong_with_a_link_can_be_translated() {
    let names = "beta modes force initial t_end resistance beam_length repelling ceramic device scaling tab map layer \
        sweep.range sweep.count sweep.dwell.kept sweep.output plane figure enlarged design.page design.least \
        design.limits.voltage design.quantity design.search.aim live.trace live.speed live.periods lesson step lang v";
    let mut problems = Vec::new();
    for name in names.split_whitespace() {
        for text in ["", "x", "1e30", "1 2 3", "-1", "omega+omega", "taylor99"] {
            problems.extend(read(&format!("tab=sweep&{name}={text}"), &View::default()).1);
        }
    }
    assert!(problems.len() > 150, "{} problems", problems.len());
    // What is left are numbers and names, not words.
    let is_word = |word: &str| word.len() > 2 && !["mode", "periods"].contains(&word);
    let has_words = |text: &str| text.split(|letter: char| !letter.is_ascii_lowercase()).any(is_word);
    let is_sentence = |left: &str| left.split(", ").any(|part| part.contains(' ') && has_words(part));
    for problem in &problems {
        // What was given may be repeated.
        let given = format!("{:?}", problem.value);
        let left = verbatim(&problem.reason);
        assert!(!left.iter().any(|left| *left != given && is_sentence(left)), "{problem}: {left:?}");
    }
}

#[test]
fn layers_are_one_entry_of_a_link() {
    let mut view = View::default();
    BIMORPH.put_into(&mut view.scenario).expect("a device");
    let link = write(&view);
    let layers = "layers=series+0.0318+0.00014+1.05e11+9000+0.00026+6.6e10+7800+-1.9e-10+1.328e-8";
    assert!(link.contains(layers), "{link}");
    let (read_back, problems) = read(&link, &View::default());
    assert!(
        problems.is_empty() && read_back.scenario.device().expect("a device").layers.is_some(),
        "{problems:?}"
    );
    assert_eq!(read_back.scenario, view.scenario);
    for wrong in ["layers=series", "layers=pile+1+2+3+4+5+6+7+8+9", "layers=series+x+2+3+4+5+6+7+8+9"] {
        let (view, problems) = read(&format!("v=1&{wrong}"), &View::default());
        assert!(problems.len() == 1 && view.scenario.device.is_none(), "{wrong}: {problems:?}");
    }
    // What is written of no layers is what it was.
    assert!(!write(&View { scenario: Scenario::default(), ..View::default() }).contains("layers"));
}
