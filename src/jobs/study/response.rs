//! The response curves over a range, in one piece of work.

use serde::{Deserialize, Serialize};

use super::Study;
use crate::jobs::response::ResponseCurve;
use crate::jobs::work::{Finding, Work};
use crate::model::Parameter;
use crate::scenario::Scenario;

/// What is followed.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ResponseQuestion {
    /// The device and its other numbers.
    pub scenario: Scenario,
    /// What changes.
    pub parameter: Parameter,
    /// Its lowest and highest value.
    pub range: (f64, f64),
}

/// Response curves being followed.
#[derive(Debug, Clone)]
pub struct ResponseStudy {
    question: ResponseQuestion,
    handed: bool,
    found: Option<Result<Vec<ResponseCurve>, String>>,
}

impl ResponseStudy {
    /// Nothing yet of what `question` asks for.
    pub fn new(question: ResponseQuestion) -> Self {
        Self { question, handed: false, found: None }
    }

    /// What is followed.
    pub fn question(&self) -> &ResponseQuestion {
        &self.question
    }

    /// The curves, or why there are none, once it is known.
    pub fn found(&self) -> Option<&Result<Vec<ResponseCurve>, String>> {
        self.found.as_ref()
    }
}

impl Study for ResponseStudy {
    fn next(&mut self) -> Option<(usize, Work)> {
        if std::mem::replace(&mut self.handed, true) {
            return None;
        }
        let ResponseQuestion { scenario, parameter, range } = &self.question;
        Some((0, Work::Response { scenario: scenario.clone(), parameter: *parameter, range: *range }))
    }

    fn take(&mut self, _ticket: usize, finding: Result<Finding, String>) {
        self.found = match finding {
            Ok(Finding::Response(curves)) => Some(Ok(curves)),
            Ok(_) => None,
            Err(message) => Some(Err(message)),
        };
    }

    fn progress(&self) -> f64 {
        if self.finished() { 1.0 } else { 0.0 }
    }

    fn finished(&self) -> bool {
        self.found.is_some()
    }
}
