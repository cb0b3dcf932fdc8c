//! Random views, every field of them.

use proptest::collection::vec;
use proptest::option;
use proptest::prelude::*;
use proptest::sample::select;

use crate::app::lessons::{LessonId, STEPS};
use crate::app::text::Language;
use crate::app::view::design::{
    Aim, DROPS, DesignView, FREQUENCIES, POWERS, Page, SCATTERS, SearchView, Side, Watched,
};
use crate::app::view::live::{KICKS, LiveView, SPEEDS, Trace, WINDOWS};
use crate::app::view::shake::{LEVELS, Recording, ShakeView, ShakenBy};
use crate::app::view::{MapWindow, Output, Panel, SweepView, Tab, View};
use crate::dynamics::attractors::sweep::Dwell;
use crate::model::base_motion::{DURATIONS, FREQUENCIES as BAND};
use crate::model::layers::Sheet;
use crate::model::materials::Ceramic;
use crate::model::{Device, Dimension, ElectricalScaling, ForceLaw, Layers, Limits, Parameter, ParameterSet};
use crate::questions::design::published::{BIMORPH, UNIMORPH};
use crate::questions::design::trust::Quantity;
use crate::questions::{chart, curves};
use crate::scenario::{END_TIME, ModelChoice, Scenario, VERSION};
use crate::theory::Resonance;

const TABS: [Tab; 7] =
    [Tab::Explore, Tab::Live, Tab::Stability, Tab::Sweep, Tab::Design, Tab::Paper, Tab::Lessons];
const MAPS: [MapWindow; 4] = [MapWindow::All, MapWindow::First, MapWindow::Sum, MapWindow::Second];
const LAYERS: [chart::Quantity; 4] =
    [chart::Quantity::Multiplier, chart::Quantity::Motion, chart::Quantity::VRms, chart::Quantity::Power];
const OUTPUTS: [Output; 3] = [Output::Voltage, Output::Power, Output::Tip];
const SCALINGS: [ElectricalScaling; 2] = ElectricalScaling::ALL;

/// A number anywhere in a range: round, small, an end, or with all its digits.
fn within((low, high): (f64, f64)) -> impl Strategy<Value = f64> {
    let anywhere = (0.0..=1.0_f64).prop_map(move |part| (low + part * (high - low)).clamp(low, high));
    let small = (-12.0..0.0_f64).prop_map(move |power| (high * 10.0_f64.powf(power)).clamp(low, high));
    let round = (0..=20_i32).prop_map(move |part| (f64::from(part) * 1e-3).clamp(low, high));
    prop_oneof![anywhere, small, round, Just(low), Just(high)]
}

/// Boxed, as the device: the many numbers would overflow the stack of a test.
fn parameters() -> BoxedStrategy<ParameterSet> {
    let numbers = Parameter::ALL.map(|parameter| option::of(within(parameter.range()).boxed()).boxed());
    let set = numbers.prop_map(|numbers| {
        let mut set = ParameterSet::default();
        for (parameter, number) in Parameter::ALL.into_iter().zip(numbers) {
            *set.get_mut(parameter) = number.unwrap_or(set.get(parameter));
        }
        set
    });
    set.boxed()
}

fn device() -> BoxedStrategy<Device> {
    let numbers = Dimension::ALL.map(|dimension| option::of(within(dimension.range()).boxed()).boxed());
    let layers = option::of((select(&[UNIMORPH, BIMORPH][..]), option::of(within((1e-6, 1e-3)))));
    let device =
        (numbers.boxed(), any::<bool>(), any::<bool>(), option::of(select(&Ceramic::ALL[..])), layers);
    let device = device.prop_map(|(numbers, repelling, open, ceramic, layered)| {
        let layers = layered.and_then(|(published, glue)| {
            let layers = published.device().layers?;
            Some(Layers { epoxy: glue.map(|thickness| Sheet { thickness, ..layers.substrate }), ..layers })
        });
        let mut device = Device { repelling, ceramic, layers, ..Device::default() };
        for (dimension, number) in Dimension::ALL.into_iter().zip(numbers) {
            *device.get_mut(dimension) = number.unwrap_or(device.get(dimension));
        }
        if open {
            device.resistance = f64::INFINITY;
        }
        device
    });
    device.boxed()
}

fn scenario() -> impl Strategy<Value = Scenario> {
    let law = prop_oneof![
        Just(ForceLaw::Quadratic),
        Just(ForceLaw::Exact),
        (2..=ForceLaw::MAX_DEGREE).prop_map(ForceLaw::Taylor),
    ];
    let model = (1..=8_usize, law, any::<bool>()).prop_flat_map(|(modes, force, residual_moment)| {
        (
            Just(ModelChoice { modes, force, residual_moment }),
            option::of(vec(within((-1e6, 1e6)), 2 * modes + 1)),
        )
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
        let end = || within(dimension.range());
        option::of((end(), end())).prop_map(move |range| Side { dimension, range })
    })
}

fn search() -> impl Strategy<Value = SearchView> {
    const AIMS: [Aim; 5] = [Aim::Power, Aim::PerG2, Aim::Voltage, Aim::Band, Aim::Threshold];
    (select(&AIMS[..]), side(), side(), option::of(side()), 1..=500_usize)
        .prop_map(|(aim, x, y, third, generations)| SearchView { aim, sides: [x, y], third, generations })
}

fn shake() -> impl Strategy<Value = ShakeView> {
    let by = select(&[ShakenBy::Noise, ShakenBy::Chirp, ShakenBy::Recorded][..]);
    let band = option::of((within(BAND), within(BAND)));
    let recording = option::of((".{0,20}", any::<u32>()))
        .prop_map(|recording| recording.map(|(name, checksum)| Recording::new(&name, checksum)));
    (by, any::<[bool; 3]>(), within(LEVELS), band, option::of(within(DURATIONS)), 0..1000_usize, recording)
        .prop_map(|(by, flags, level, band, duration, seed, recording)| {
            let [everywhere, octaves, with_mean] = flags;
            ShakeView { by, everywhere, level, band, duration, octaves, seed, recording, with_mean }
        })
}

fn design() -> impl Strategy<Value = DesignView> {
    const PAGES: [Page; 9] = [
        Page::Harvest,
        Page::Load,
        Page::Materials,
        Page::Trust,
        Page::Search,
        Page::Tolerances,
        Page::Measured,
        Page::Shake,
        Page::Variants,
    ];
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
    let flags = any::<[bool; 4]>();
    let window = option::of((within(FREQUENCIES), within(FREQUENCIES)));
    let watts = (option::of(within(POWERS)), within(DROPS), within(SCATTERS));
    (front, flags, window, watts, limits(), (search(), shake())).prop_map(
        |(
            (page, watched, mode, resonance, quantity),
            flags,
            window,
            (least, diode_drop, scatter),
            limits,
            (search, shake),
        )| {
            DesignView {
                page,
                dimensionless: flags[0],
                holds_acceleration: flags[1],
                watched,
                logarithmic: flags[2],
                logarithmic_frequency: flags[3],
                window,
                least,
                diode_drop,
                scatter,
                limits,
                mode,
                resonance,
                quantity,
                search,
                shake,
            }
        },
    )
}

fn live() -> impl Strategy<Value = LiveView> {
    let trace = select(&[Trace::Voltage, Trace::Tip][..]);
    (trace, within(SPEEDS), WINDOWS.0..=WINDOWS.1, within(KICKS))
        .prop_map(|(trace, speed, periods, kick)| LiveView { trace, speed, periods, kick })
}

/// Every field is named: one that is added to a view is asked for here by the compiler.
pub(super) fn view() -> impl Strategy<Value = View> {
    let languages = option::of(select(&Language::ALL[..]));
    let looks = (
        option::of(any::<bool>()),
        any::<bool>(),
        option::of(any::<bool>()),
        option::of(any::<bool>()),
        languages,
    );
    let front = (select(&TABS[..]), select(&MAPS[..]), select(&LAYERS[..]), option::of(select(Panel::ALL)));
    let plane = (0..5_usize, 1..5_usize)
        .prop_map(|(x, step)| [curves::PARAMETERS[x], curves::PARAMETERS[(x + step) % 5]]);
    let lesson = (option::of(select(LessonId::all().collect::<Vec<_>>())), 1..=STEPS);
    (scenario(), front, sweep(), plane, 1..=12_u8, (design(), live()), looks, lesson)
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
