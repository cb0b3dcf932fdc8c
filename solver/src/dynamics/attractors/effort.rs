//! How much work it is worth to know what a start leads to.

/// How much work a start is worth.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Effort {
    /// Tolerance of the integration ([`Settings`](crate::dynamics::Settings)).
    pub tolerance: f64,
    /// Excitation periods that are run at least.
    pub least: usize,
    /// First record for exponents and averages (excitation periods).
    pub record: usize,
    /// Excitation periods that a motion must last to count as chaotic.
    pub lasting: usize,
    /// Largest disagreement between the averages of the two halves of a torus' record, relative.
    pub agreement: f64,
    /// Integrator steps after which the start is given up as undecided.
    pub steps: u64,
}

impl Effort {
    /// For a chart of many cells.
    pub const fn cell() -> Self {
        Self { tolerance: 1e-5, least: 0, record: 640, lasting: 3000, agreement: 1e-4, steps: 600_000 }
    }

    /// For one motion.
    pub const fn full() -> Self {
        Self { tolerance: 1e-8, least: 0, record: 1024, lasting: 24_000, agreement: 1e-6, steps: 4_000_000 }
    }
}
