//! Links there and back, old ones, and bad ones.

use proptest::collection::vec;
use proptest::option;
use proptest::prelude::*;
use proptest::sample::select;

use super::*;
use crate::app::lessons::{LessonId, STEPS};
use crate::app::text::Language;
use crate::app::view::design::{Aim, DesignView, FREQUENCIES, POWERS, Page, SearchView, Side, Watched};
use crate::app::view::live::{KICKS, LiveView, SPEEDS, Trace, WINDOWS};
use crate::app::view::{Layer, MapWindow, Output, Panel, SweepView, Tab};
use crate::dynamics::sweep::Dwell;
use crate::jobs::design::trust::Quantity;
use crate::jobs::study::curves;
use crate::model::materials::Ceramic;
use crate::model::{Device, Dimension, ElectricalScaling, ForceLaw, Limits, Parameter, ParameterSet};
use crate::scenario::{END_TIME, ModelChoice, VERSION};
use crate::theory::Resonance;

const TABS: [Tab; 7] =
    [Tab::Explore, Tab::Live, Tab::Stability, Tab::Sweep, Tab::Design, Tab::Paper, Tab::Lessons];
const MAPS: [MapWindow; 4] = [MapWindow::All, MapWindow::First, MapWindow::Sum, MapWindow::Second];
const LAYERS: [Layer; 4] = [Layer::Multiplier, Layer::Motion, Layer::Voltage, Layer::Power];
const OUTPUTS: [Output; 3] = [Output::Voltage, Output::Power, Output::Tip];
const PANELS: [Panel; 4] = [Panel::StabilityMap, Panel::Chart, Panel::OrbitDiagram, Panel::Basins];
const SCALINGS: [ElectricalScaling; 2] = ElectricalScaling::ALL;

/// A number anywhere in a range: round, small, an end, or with all its digits.
fn within((low, high): (f64, f64)) -> impl Strategy<Value = f64> {
    let anywhere = (0.0..=1.0_f64).prop_map(move |part| (low + part * (high - low)).clamp(low, high));
    let small = (-12.0..0.0_f64).prop_map(move |power| (high * 10.0_f64.powf(power)).clamp(low, high));
    let round = (0..=20_i32).prop_map(move |part| (f64::from(part) * 1e-3).clamp(low, high));
    prop_oneof![anywhere, small, round, Just(low), Just(high)]
}

fn parameters() -> impl Strategy<Value = ParameterSet> {
    Parameter::ALL.map(|parameter| option::of(within(parameter.range()))).prop_map(|numbers| {
        let mut set = ParameterSet::default();
        for (parameter, number) in Parameter::ALL.into_iter().zip(numbers) {
            *parameter.get_mut(&mut set) = number.unwrap_or(parameter.get(&set));
        }
        set
    })
}

fn device() -> impl Strategy<Value = Device> {
    let numbers = Dimension::ALL.map(|dimension| option::of(within(dimension.accepted())));
    (numbers, any::<bool>(), any::<bool>(), option::of(select(&Ceramic::ALL[..]))).prop_map(
        |(numbers, repelling, open, ceramic)| {
            let mut device = Device { repelling, ceramic, ..Device::default() };
            for (dimension, number) in Dimension::ALL.into_iter().zip(numbers) {
                *dimension.get_mut(&mut device) = number.unwrap_or(dimension.get(&device));
            }
            if open {
                device.resistance = f64::INFINITY;
            }
            device
        },
    )
}

fn scenario() -> impl Strategy<Value = Scenario> {
    let law = prop_oneof![
        Just(ForceLaw::Quadratic),
        Just(ForceLaw::Exact),
        (2..=ForceLaw::MAX_DEGREE).prop_map(ForceLaw::Taylor),
    ];
    let model = (1..=8_usize, law).prop_flat_map(|(modes, force)| {
        (Just(ModelChoice { modes, force }), option::of(vec(within((-1e6, 1e6)), 2 * modes + 1)))
    });
    let device = prop_oneof![Just(None), Just(Some(Device::default())), device().prop_map(Some)];
    (parameters(), model, within(END_TIME), device, select(&SCALINGS[..])).prop_map(
        |(parameters, (model, initial), t_end, device, scaling)| Scenario {
            version: VERSION,
            parameters,
            model,
            initial,
            t_end,
            device,
            scaling,
        },
    )
}

fn sweep() -> impl Strategy<Value = SweepView> {
    let range = select(&Parameter::ALL[..]).prop_flat_map(|parameter| {
        let end = || within(parameter.range());
        (Just(parameter), option::of((end(), end())))
    });
    let dwell = (0..=5000_usize, 1..=1000_usize);
    (range, 2..=2000_usize, dwell, select(&OUTPUTS[..])).prop_map(
        |((parameter, range), count, (discarded, kept), output)| SweepView {
            parameter,
            range,
            count,
            dwell: Dwell { discarded, kept },
            output,
        },
    )
}

fn limits() -> impl Strategy<Value = Limits> {
    let positive = || within((1e-12, 1e12));
    let voltage =
        option::of((positive(), positive())).prop_map(|ends| ends.map(|(a, b)| (a.min(b), a.max(b))));
    (voltage, within((1e-12, 1.0)), positive(), positive())
        .prop_map(|(voltage, gap, deflection, slope)| Limits { voltage, gap, deflection, slope })
}

fn side() -> impl Strategy<Value = Side> {
    select(&Dimension::ALL[..]).prop_flat_map(|dimension| {
        let end = || within(dimension.accepted());
        option::of((end(), end())).prop_map(move |range| Side { dimension, range })
    })
}

fn search() -> impl Strategy<Value = SearchView> {
    const AIMS: [Aim; 5] = [Aim::Power, Aim::PerG2, Aim::Voltage, Aim::Band, Aim::Threshold];
    (select(&AIMS[..]), side(), side(), option::of(side()), 1..=500_usize)
        .prop_map(|(aim, x, y, third, generations)| SearchView { aim, sides: [x, y], third, generations })
}

fn design() -> impl Strategy<Value = DesignView> {
    const PAGES: [Page; 6] =
        [Page::Harvest, Page::Load, Page::Materials, Page::Trust, Page::Search, Page::Measured];
    const WATCHED: [Watched; 5] =
        [Watched::Power, Watched::PerG2, Watched::Voltage, Watched::Peak, Watched::Tip];
    let resonance = || select(&Resonance::ALL[..]);
    let quantity = prop_oneof![
        Just(Quantity::Voltage),
        Just(Quantity::Power),
        Just(Quantity::Tip),
        resonance().prop_map(Quantity::Threshold),
    ];
    let front = (select(&PAGES[..]), select(&WATCHED[..]), 1..=8_usize, resonance(), quantity);
    let flags = any::<[bool; 3]>();
    let window = option::of((within(FREQUENCIES), within(FREQUENCIES)));
    (front, flags, window, option::of(within(POWERS)), limits(), search()).prop_map(
        |((page, watched, mode, resonance, quantity), flags, window, least, limits, search)| DesignView {
            page,
            dimensionless: flags[0],
            holds_acceleration: flags[1],
            watched,
            logarithmic: flags[2],
            window,
            least,
            limits,
            mode,
            resonance,
            quantity,
            search,
        },
    )
}

fn live() -> impl Strategy<Value = LiveView> {
    let trace = select(&[Trace::Voltage, Trace::Tip][..]);
    (trace, within(SPEEDS), WINDOWS.0..=WINDOWS.1, within(KICKS))
        .prop_map(|(trace, speed, periods, kick)| LiveView { trace, speed, periods, kick })
}

/// Every field is named: one that is added to a view is asked for here by the compiler.
fn view() -> impl Strategy<Value = View> {
    let languages = option::of(select(&Language::ALL[..]));
    let looks =
        (option::of(any::<bool>()), any::<bool>(), any::<bool>(), option::of(any::<bool>()), languages);
    let front = (select(&TABS[..]), select(&MAPS[..]), select(&LAYERS[..]), option::of(select(&PANELS[..])));
    let plane = (0..5_usize, 1..5_usize)
        .prop_map(|(x, step)| [curves::PARAMETERS[x], curves::PARAMETERS[(x + step) % 5]]);
    let lesson = (option::of(select(LessonId::all().collect::<Vec<_>>())), 1..=STEPS);
    (scenario(), front, sweep(), plane, 2..=12_u8, (design(), live()), looks, lesson)
        .prop_map(
            |(scenario, (tab, map, layer, enlarged), sweep, plane, figure, (design, live), looks, lesson)| {
                View {
                    scenario,
                    tab,
                    dark: looks.0,
                    contrast: looks.3,
                    language: looks.4,
                    projector: looks.1,
                    map,
                    figure,
                    enlarged,
                    beam_moves: looks.2,
                    layer,
                    sweep,
                    plane,
                    design,
                    live,
                    lesson: lesson.0,
                    step: lesson.1,
                }
            },
        )
        // Attracting magnets can leave no equilibrium.
        .prop_filter("a view that can be computed", |view| view.check().is_ok())
}

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
    view.scenario.device = Some(Device { ceramic: Some(Ceramic::Apc850), ..Device::default() });
    view.scenario.scaling = ElectricalScaling::Consistent;
    view.scenario.initial = Some(vec![0.0; 5]);
    view.design.search.third = Some(Side::of(Dimension::MagnetDistance));
    let (value, mut paths) = (view.to_value(), Vec::new());
    leaves(&value, "", &mut paths);
    // The version of a scenario is the version of the link.
    paths.retain(|path| path != "/scenario/version");
    let mut known: Vec<String> = fields().into_iter().map(|field| field.pointer).collect();
    known.retain(|pointer| pointer != "/scenario/device");
    paths.sort();
    known.sort();
    assert_eq!(paths, known, "a field of View is missing in link/field.rs, or one there is gone");
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
    view.scenario.model = ModelChoice { modes: 3, force: ForceLaw::Taylor(5) };
    view.scenario.initial = Some(vec![0.01, 0.0, -1e-7, 0.0, 0.0, 0.0, 14.2]);
    view.scenario.device = Some(Device { beam_length: 0.3, resistance: f64::INFINITY, ..Default::default() });
    view.sweep.range = Some((7.5, 8.5));
    view.plane = [Parameter::Omega, Parameter::Alpha];
    let link = "v=1&alpha=1e-4&omega=8.0969&modes=3&force=taylor5&initial=0.01+0+-1e-7+0+0+0+14.2\
                &beam_length=0.3&resistance=open&tab=stability&sweep.range=7.5+8.5&plane=omega+alpha";
    assert_eq!(write(&view), link);
    assert_eq!(read(&format!("#{link}"), &View::default()), (view, Vec::new()));
}

/// Never change one of these: they stand in people's slides. A default that changes breaks them, too.
#[test]
fn old_links_keep_their_meaning() {
    let usual = r#"{"beam_moves":true,"contrast":null,"dark":null,"enlarged":null,"figure":9,"lang":null,"layer":"multiplier","map":"first",
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
    assert_eq!((expected.to_value(), problems), (usual, Vec::new()));
    let link = "#v=1&alpha=1e-4&beta=0.01&omega=25.4047&force=exact&t_end=605&tab=paper&map=sum&figure=4";
    expected.scenario.parameters =
        ParameterSet { alpha: 1e-4, beta: 0.01, omega: 25.4047, ..expected.scenario.parameters };
    expected.scenario.model.force = ForceLaw::Exact;
    expected.scenario.t_end = 605.0;
    (expected.tab, expected.map, expected.figure) = (Tab::Paper, MapWindow::Sum, 4);
    assert_eq!(read(link, &View::default()), (expected, Vec::new()));
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
            "sweep.range = 1 (needs 2 numbers)",
            "projector = perhaps (allowed are true and false)",
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
