//! Verdicts on random devices against long runs closed by Newton's iteration: how many are right, undecided, wrong.
//!
//! `cargo bench --bench verdicts` tries 200 points over the whole range of the parameters and 120 hard-driven ones;
//! `cargo bench --bench verdicts -- 2000 7` so many of the former, from another seed. Each wrong one is printed.

#![allow(clippy::expect_used, reason = "a benchmark fails by panicking")]

#[path = "../tests/slow/tips/truth.rs"]
mod truth;

use std::time::Instant;

use harvester_lab::dynamics::motion::Undecided;
use harvester_lab::dynamics::{Motion, Verdict};
use harvester_lab::model::{ForceLaw, ModelChoice, ParameterSet};
use truth::{Standing, Truth};

/// Allowed error of the voltage, relative.
const VOLTS: f64 = 0.01;

/// A value between `low` and `high`, evenly in its logarithm.
fn between(random: &mut fastrand::Rng, low: f64, high: f64) -> f64 {
    low * (high / low).powf(random.f64())
}

/// A device and an excitation anywhere.
fn anywhere(random: &mut fastrand::Rng) -> (ParameterSet, ModelChoice) {
    let set = ParameterSet {
        alpha: between(random, 1e-5, 1e-2),
        beta: between(random, 1e-5, 0.05),
        omega: between(random, 1.0, 60.0),
        c0: between(random, 0.05, 2.0),
        d: between(random, 0.1, 0.5),
        h: between(random, 1e-3, 0.05),
        eta: between(random, 1e-3, 1.0),
        c: between(random, 1e-7, 1e-5),
        kappa: between(random, 1e-8, 1e-4),
        theta: between(random, 1e-5, 1e-3),
    };
    let force = [ForceLaw::Quadratic, ForceLaw::Exact][random.usize(..2)];
    (set, ModelChoice { force, ..Default::default() })
}

/// The paper's device driven hard, where motions are many.
fn driven_hard(random: &mut fastrand::Rng) -> (ParameterSet, ModelChoice) {
    let set = ParameterSet {
        alpha: between(random, 4e-5, 1e-3),
        beta: between(random, 0.005, 0.05),
        omega: 6.5 + 3.0 * random.f64(),
        ..Default::default()
    };
    (set, ModelChoice { force: ForceLaw::Exact, ..Default::default() })
}

fn run(name: &str, count: usize, seed: u64, draw: fn(&mut fastrand::Rng) -> (ParameterSet, ModelChoice)) {
    let mut random = fastrand::Rng::with_seed(seed);
    let (mut right, mut undecided, mut rounding, mut wrong, mut unknown) = (0, 0, 0, 0, 0);
    let mut times = Vec::new();
    while right + undecided + rounding + wrong + unknown < count {
        let (set, model) = draw(&mut random);
        let Ok(system) = model.system(set) else { continue };
        let begun = Instant::now();
        let Ok(verdict) = Verdict::of(&system, &vec![0.0; system.dimension()], 600.0) else { continue };
        times.push(begun.elapsed().as_secs_f64());
        let truth = truth::from_rest(&system);
        match truth::standing(&truth, verdict.motion, verdict.v_rms.unwrap_or(0.0), VOLTS) {
            Standing::Right => right += 1,
            Standing::Undecided => match verdict.motion {
                Motion::Undecided { why: Undecided::DependsOnRounding } => rounding += 1,
                _ => undecided += 1,
            },
            Standing::Wrong => {
                // A run that neither arrived nor ended contradicts an orbit only when it does something else.
                let open = matches!(truth, Truth::Open(_));
                let arrives = matches!(verdict.motion, Motion::Periodic { .. });
                if open && arrives {
                    unknown += 1
                } else {
                    wrong += 1
                }
                println!("{set:?} {model:?}: {truth:?}; verdict {} {:?}", verdict.motion, verdict.v_rms);
            }
        }
    }
    times.sort_by(f64::total_cmp);
    println!(
        "{name}: {right} right, {undecided} undecided, {rounding} depend on rounding, {unknown} where the long run has \
         not arrived, {wrong} wrong of {count}; median {:.0} ms, longest {:.1} s",
        1e3 * times[times.len() / 2],
        times[times.len() - 1]
    );
}

fn main() {
    let numbers: Vec<u64> = std::env::args().filter_map(|argument| argument.parse().ok()).collect();
    let count = numbers.first().map_or(200, |count| *count as usize);
    let seed = numbers.get(1).copied().unwrap_or(1);
    run("anywhere", count, seed, anywhere);
    run("driven hard", if numbers.is_empty() { 120 } else { count.div_ceil(10) }, seed, driven_hard);
}
