//! How long a request may compute. What is not begun by then is missing from the answer, which says so.

use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};

use super::parallel;

/// Who wants to know the done part of a request, 0 to 1.
type Report<'a> = &'a (dyn Fn(f64) + Sync);

/// What a request may compute, and what of it is missing.
///
/// Time is that of its pieces of work, summed over all cores, so that a request has the same budget alone and among
/// others, on one core and on many. A piece, once begun, is finished.
#[derive(Default)]
pub struct Budget<'a> {
    /// Computing time (s); without end when absent.
    seconds: Option<f64>,
    /// Time of the clock (s) at which whoever asked has gone.
    deadline: Option<f64>,
    microseconds: AtomicU64,
    cut: AtomicBool,
    lacks: Mutex<Vec<String>>,
    report: Option<Report<'a>>,
}

impl<'a> Budget<'a> {
    /// Computing time (s) of a request that names none; the README says it, too.
    pub const USUAL: f64 = 900.0;
    /// Computing times (s) that can be asked for.
    pub const RANGE: (f64, f64) = (1e-3, 1e7);

    /// Computes for so many seconds.
    #[must_use]
    pub fn of(self, seconds: f64) -> Self {
        Self { seconds: Some(seconds), ..self }
    }

    /// Begins nothing once so many seconds (of the clock) have passed from now.
    #[must_use]
    pub fn until(self, seconds: Option<f64>) -> Self {
        Self { deadline: seconds.map(|seconds| now() + seconds), ..self }
    }

    /// Tells the done part, 0 to 1, as it grows.
    #[must_use]
    pub fn reporting(self, report: Option<Report<'a>>) -> Self {
        Self { report, ..self }
    }

    /// Tells whoever wants to know that this part is done, 0 to 1.
    pub fn report(&self, part: f64) {
        if let Some(report) = self.report {
            report(part);
        }
    }

    /// Whether nothing more may begin. Whoever asks this leaves something out when it is so.
    pub fn is_spent(&self) -> bool {
        let spent = self.microseconds.load(Ordering::Relaxed) as f64 * 1e-6;
        let over = self.seconds.is_some_and(|seconds| spent >= seconds)
            || self.deadline.is_some_and(|deadline| now() >= deadline);
        if over {
            self.cut.store(true, Ordering::Relaxed);
        }
        over
    }

    /// Does a piece of work, unless the budget is spent.
    pub fn piece<R>(&self, work: impl FnOnce() -> R) -> Option<R> {
        if self.is_spent() {
            return None;
        }
        let start = now();
        let found = work();
        self.microseconds.fetch_add(((now() - start) * 1e6) as u64, Ordering::Relaxed);
        Some(found)
    }

    /// What `work` makes of each of `items`, in their order, on all cores; `None` where the budget was spent before.
    pub fn map<T: Sync, R: Send>(&self, items: &[T], work: impl Fn(&T) -> R + Sync + Send) -> Vec<Option<R>> {
        let done = AtomicU64::new(0);
        parallel::map(items, |item| {
            let found = self.piece(|| work(item));
            self.report((done.fetch_add(1, Ordering::Relaxed) + 1) as f64 / items.len() as f64);
            found
        })
    }

    /// Notes something that the answer lacks for another reason.
    pub fn lacks(&self, what: String) {
        if let Ok(mut lacks) = self.lacks.lock() {
            lacks.push(what);
        }
    }

    /// What the answer lacks, in a sentence.
    pub fn missing(&self) -> Option<String> {
        let mut clauses = Vec::new();
        if let Some(seconds) = self.seconds.filter(|_| self.cut.load(Ordering::Relaxed)) {
            clauses.push(format!(
                "the budget of {seconds} s of computing was spent before all was computed: what is null or absent may be \
                 missing for that; a larger \"budget\" goes on"
            ));
        }
        clauses.extend(self.lacks.lock().map(|lacks| lacks.clone()).unwrap_or_default());
        (!clauses.is_empty()).then(|| clauses.join("; "))
    }
}

/// Seconds since some moment.
#[cfg(not(target_arch = "wasm32"))]
pub fn now() -> f64 {
    static START: std::sync::LazyLock<std::time::Instant> = std::sync::LazyLock::new(std::time::Instant::now);
    START.elapsed().as_secs_f64()
}

/// Seconds since some moment, in windows and workers.
#[cfg(all(target_arch = "wasm32", feature = "app"))]
pub fn now() -> f64 {
    1e-3 * js_sys::Date::now()
}

/// Without a clock nothing is ever spent.
#[cfg(all(target_arch = "wasm32", not(feature = "app")))]
pub fn now() -> f64 {
    0.0
}

#[cfg(test)]
mod tests {
    use super::*;

    fn for_a_while(milliseconds: f64) {
        let start = now();
        while now() - start < 1e-3 * milliseconds {}
    }

    #[test]
    fn what_is_not_begun_in_time_is_left_out_and_said() {
        let budget = Budget::default().of(0.02);
        assert_eq!(budget.piece(|| 1), Some(1));
        assert_eq!(budget.missing(), None);
        // A piece that takes longer is finished; the next is not begun.
        assert_eq!(budget.piece(|| for_a_while(30.0)), Some(()));
        assert_eq!((budget.missing(), budget.piece(|| 1)), (None, None));
        assert!(budget.missing().is_some_and(|why| why.contains("0.02 s")));
        // Time in which nothing is computed does not count.
        let budget = Budget::default().of(0.02);
        for_a_while(30.0);
        assert_eq!(budget.map(&[1, 2, 3], |x| 2 * x), [Some(2), Some(4), Some(6)]);
        let gone = Budget::default().until(Some(0.01));
        for_a_while(15.0);
        assert_eq!(gone.map(&[1, 2], |x| *x), [None, None]);
    }

    #[test]
    fn the_done_part_is_told_and_without_a_limit_all_is_done() {
        let parts = Mutex::new(Vec::new());
        let report = |part| parts.lock().expect("whole").push(part);
        let budget = Budget::default().reporting(Some(&report));
        assert_eq!(budget.map(&[3, 4], |x| *x), [Some(3), Some(4)]);
        let mut parts = parts.lock().expect("whole").clone();
        parts.sort_by(f64::total_cmp);
        assert_eq!(parts, [0.5, 1.0]);
        budget.lacks("the end".to_owned());
        assert_eq!(budget.missing().as_deref(), Some("the end"));
    }
}
