//! Requests: a question as JSON, with the device, the model and the start that it is about.

use serde_json::Value;

use super::error::{RequestError, read, with_range};
use super::input::{self, cut};
use super::question::Question;
use super::subject;
use crate::model::ModelError;
use crate::scenario::Scenario;
use crate::scheduler::Budget;

/// A kind of question, as requests name it.
pub struct Task {
    /// Its name.
    pub name: &'static str,
    takes: &'static [&'static str],
    counts_loss: bool,
    solve: fn(&Value, &[&'static str], Scenario, &Budget<'_>) -> Result<String, RequestError>,
}

impl Task {
    /// The task whose requests are a `Q` each.
    pub(super) const fn of<Q: Question>() -> Self {
        Self {
            name: Q::TASK,
            takes: Q::TAKES,
            counts_loss: Q::COUNTS_LOSS,
            solve: |fields, beside, scenario, budget| {
                let question: Q = input::known_fields(fields, beside).map_err(with_range)?;
                let answer = question.answer(scenario, budget)?;
                serde_json::to_string(&answer).map_err(|error| RequestError::Study(error.to_string()))
            },
        }
    }
}

/// Answers one JSON request with one JSON object, within what `budget` leaves of the request's own.
pub(super) fn answer(tasks: &[Task], json: &str, budget: Budget<'_>) -> Result<String, RequestError> {
    let Value::Object(mut fields) = input::json(json)? else {
        return Err(RequestError::NoObject);
    };
    let name = fields.remove("task").unwrap_or_default();
    let seconds = match fields.remove("budget") {
        Some(seconds) => read::<f64>(&seconds).map_err(|error| error.of("budget"))?,
        None => Budget::USUAL,
    };
    let budget = budget.of(ModelError::check("budget", seconds, Budget::RANGE, " s")?);
    let task = tasks.iter().find(|task| name.as_str() == Some(task.name)).ok_or_else(|| {
        let names: Vec<String> = tasks.iter().map(|task| format!("\"{}\"", task.name)).collect();
        RequestError::Task(cut(&name.to_string()), names.join(", "))
    })?;
    let beside = subject::names(task.takes);
    let scenario = subject::take(&mut fields, task.takes)?;
    let loss = scenario.base().loss_tangent;
    let left_out = (loss > 0.0 && !task.counts_loss)
        .then(|| format!("the dielectric loss (loss_tangent = {loss}), which tasks in watts count"));
    let mut answer = (task.solve)(&Value::Object(fields), &beside, scenario, &budget)?;
    for (name, told) in [("left_out", left_out), ("missing", budget.missing())] {
        if let Some(told) = told {
            // Every answer is an object; this is its last entry.
            answer.pop();
            answer += &format!(",\"{name}\":{}}}", Value::from(told));
        }
    }
    Ok(answer)
}

/// The request that asks `question` about `scenario`, as [`solve`](super::solve) reads it.
pub fn written<Q: Question>(question: &Q, scenario: &Scenario) -> String {
    let own = serde_json::to_value(question).unwrap_or_default();
    let about = subject::written(scenario, Q::TAKES);
    let entry = |(name, value): (&String, &Value)| format!(",\n \"{name}\":{value}");
    let entries = own.as_object().into_iter().flatten().chain(&about).filter(|(_, value)| !value.is_null());
    format!("{{\"task\":\"{}\"{}}}", Q::TASK, entries.map(entry).collect::<String>())
}

#[cfg(test)]
mod tests {
    use std::fmt::Debug;

    use super::*;
    use crate::model::{Along, Parameter};
    use crate::questions::basin::Basin;
    use crate::questions::chart::{Chart, Quantity};
    use crate::questions::checks::Span;
    use crate::questions::harvest::Harvest;
    use crate::questions::simulate::Simulate;
    use crate::questions::sweep::{Direction, Sweep};

    /// What is read of the request that was written.
    fn again<Q: Question + PartialEq + Debug>(question: &Q, scenario: &Scenario) {
        let request = written(question, scenario);
        let Ok(Value::Object(mut fields)) = input::json(&request) else { panic!("{request}") };
        assert_eq!(fields.remove("task"), Some(Value::from(Q::TASK)));
        let about = subject::take(&mut fields, Q::TAKES).expect(&request);
        assert_eq!((about.parameters, about.model), (scenario.parameters, scenario.model), "{request}");
        assert!(about.initial == scenario.initial || !Q::TAKES.contains(&"initial"), "{request}");
        let read: Q = input::known_fields(&Value::Object(fields), &[]).expect(&request);
        assert_eq!(&read, question, "{request}");
    }

    #[test]
    fn a_task_that_leaves_the_dielectric_loss_out_says_so() {
        let told = |task: &str, loss: f64| {
            let request =
                format!(r#"{{"task":"{task}","device":{{"resistance":5e6,"loss_tangent":{loss}}}}}"#);
            let answer: Value =
                serde_json::from_str(&crate::questions::solve(&request).expect(task)).expect(task);
            answer["left_out"].clone()
        };
        let expected = "the dielectric loss (loss_tangent = 0.05), which tasks in watts count";
        assert_eq!((told("orbit", 0.05), told("modes", 0.05)), (expected.into(), expected.into()));
        assert_eq!((told("orbit", 0.0), told("limits", 0.05)), (Value::Null, Value::Null));
    }

    #[test]
    fn a_request_that_is_written_is_read_as_the_same_question() {
        let scenario = Scenario { initial: Some(vec![0.1; 5]), ..Scenario::default() };
        let span = Span { from: 8.0, to: 8.5, count: 7 };
        again(&Chart { omega: span, beta: span, quantity: Quantity::VRms }, &scenario);
        again(&Basin { count: Some(5), ..Basin::default() }, &scenario);
        again(&Harvest::default(), &scenario);
        again(&Simulate::default(), &scenario);
        let sweep = Sweep {
            parameter: Parameter::Alpha,
            from: 1e-4,
            to: 1e-3,
            count: 5,
            direction: Direction::Down,
            transient: 10,
            kept: 2,
            branches: true,
            along: Along::default(),
            logarithmic: false,
        };
        again(&sweep, &scenario);
    }
}
