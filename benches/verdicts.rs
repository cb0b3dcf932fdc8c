//! Verdicts on random devices against long runs of another integrator, DOP853 of differential-equations with the equations
//! written out by hand, closed by Newton's iteration: how many are right, undecided, wrong.
//!
//! `cargo bench --bench verdicts` tries 200 points over the whole range of the parameters and 120 hard-driven ones;
//! `cargo bench --bench verdicts -- 2000 7` so many of the former, from another seed. Each wrong one is printed.

#![allow(clippy::expect_used, reason = "a benchmark fails by panicking")]

#[path = "by_hand/mod.rs"]
mod by_hand;
#[path = "../tests/slow/tips/truth.rs"]
mod truth;

use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Instant;

use by_hand::ByHand;
use differential_equations::prelude::{ExplicitRungeKutta, IVP};
use harvester_lab::dynamics::attractors::motion::Undecided;
use harvester_lab::dynamics::{ESCAPE_DISPLACEMENT, Inquiry, Motion, Verdict};
use harvester_lab::model::{ForceLaw, ModelChoice, ParameterSet, ReducedSystem};
use rayon::iter::{IntoParallelIterator, ParallelIterator};
use truth::{Length, Run, Standing, Truth};

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
        ..Default::default()
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

/// Excitation periods of the runs: where they have arrived before, long before, and where nothing is steady.
const LENGTH: Length = Length { first: 1000, least: 20_000, most: 1_000_000 };
/// Excitation periods between looks for the end of a run.
const STRETCH: usize = 50;

/// A run by DOP853.
#[derive(Clone)]
struct Independent {
    system: ByHand,
    period: f64,
    contact: f64,
    /// The integral of v^2 last.
    state: [f64; 6],
}

impl Independent {
    fn new(system: &ReducedSystem) -> Self {
        let contact = system.rest_force().contact().unwrap_or(-ESCAPE_DISPLACEMENT);
        Self { system: ByHand::new(system), period: system.parameters.period(), contact, state: [0.0; 6] }
    }
}

impl Run for Independent {
    fn beside(&self, by: f64) -> Self {
        let mut other = self.clone();
        other.state[0] += by;
        other
    }

    fn advance(&mut self, periods: usize) -> Option<f64> {
        let mut left = periods;
        self.state[5] = 0.0;
        while left > 0 {
            let stretch = left.min(STRETCH);
            left -= stretch;
            // Of the stiffest devices the voltage decays a thousand times in a period.
            let method = ExplicitRungeKutta::dop853().rtol(1e-10).atol(1e-12).max_steps(10_000_000);
            let end = stretch as f64 * self.period;
            // Steps that become too small are an escape or a contact.
            let run = IVP::ode(&self.system, 0.0, end, self.state).method(method).solve().ok()?;
            let inside = |y: &[f64; 6]| (self.contact..ESCAPE_DISPLACEMENT).contains(&(y[0] + y[1]));
            if !run.y.iter().all(inside) {
                return None;
            }
            self.state = *run.y.last()?;
        }
        Some(self.state[5])
    }

    fn state(&self) -> Vec<f64> {
        self.state[..5].to_vec()
    }
}

/// Points after which it is said how far the bench is.
const REPORTED: usize = 50;

/// What a verdict is worth.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Worth {
    Right,
    Undecided,
    Rounding,
    /// It claims a periodic motion where the long run has not arrived anywhere.
    Unknown,
    Wrong,
}

fn worth(truth: &Truth, verdict: &Verdict) -> Worth {
    match truth::standing(truth, verdict.motion, verdict.v_rms.unwrap_or(0.0), VOLTS) {
        Standing::Right => Worth::Right,
        Standing::Undecided
            if verdict.motion == (Motion::Undecided { why: Undecided::DependsOnRounding }) =>
        {
            Worth::Rounding
        }
        Standing::Undecided => Worth::Undecided,
        Standing::Wrong
            if matches!((truth, verdict.motion), (Truth::Open { .. }, Motion::Periodic { .. })) =>
        {
            Worth::Unknown
        }
        Standing::Wrong => Worth::Wrong,
    }
}

fn run(name: &str, count: usize, seed: u64, draw: fn(&mut fastrand::Rng) -> (ParameterSet, ModelChoice)) {
    let mut random = fastrand::Rng::with_seed(seed);
    let drawn: Vec<_> = std::iter::repeat_with(|| draw(&mut random))
        .filter_map(|(set, model)| model.system(set).ok().map(|system| (set, model, system)))
        .take(count)
        .collect();
    let done = AtomicUsize::new(0);
    let tried = drawn.into_par_iter().map(|(set, model, system)| {
        let begun = Instant::now();
        let verdict = Inquiry::new(&system, &vec![0.0; system.dimension()], 600.0).map(|found| found.verdict);
        let time = begun.elapsed().as_secs_f64();
        // A motion too fast to follow has no verdict.
        let worth = verdict.map_or(Worth::Undecided, |verdict| {
            let truth = truth::follow(&system, &mut Independent::new(&system), LENGTH);
            let worth = worth(&truth, &verdict);
            if worth != Worth::Right {
                println!(
                    "{worth:?}: {set:?} {model:?}: {truth:?}; verdict {} {:?}",
                    verdict.motion, verdict.v_rms
                );
            }
            worth
        });
        let done = done.fetch_add(1, Ordering::Relaxed) + 1;
        if done.is_multiple_of(REPORTED) {
            eprintln!("{name}: {done} of {count}");
        }
        (worth, time)
    });
    let (worths, mut times): (Vec<Worth>, Vec<f64>) = tried.unzip();
    times.sort_by(f64::total_cmp);
    let of = |worth: Worth| worths.iter().filter(|found| **found == worth).count();
    println!(
        "{name}: {} right, {} undecided, {} depend on rounding, {} where the long run has not arrived, {} wrong of \
         {count}; median {:.0} ms, longest {:.1} s",
        of(Worth::Right),
        of(Worth::Undecided),
        of(Worth::Rounding),
        of(Worth::Unknown),
        of(Worth::Wrong),
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
