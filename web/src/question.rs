//! Questions that the page asks, as JSON, and their answers.

use crate::data_of::Measured;
use crate::robot::Robot;
use crate::{data_of, held, robot};
use compare::CompareError;
use serde::Deserialize;
use serde_json::{Value, json};

/// A question: the shipped robots and data; the five panels of the demonstration; a robot; its shape and its bare model's at one pressure
/// \[kPa\] for all supply channels or one for each; its comparison with measurements; its missing effects.
#[derive(Debug, Deserialize)]
#[serde(tag = "ask", rename_all = "snake_case", deny_unknown_fields)]
enum Ask {
    Start,
    Demo,
    Robot { robot: Robot },
    Predict { robot: Robot, actuator_kpa: Vec<f64> },
    Compare { robot: Robot, data: Measured },
    Diagnose { robot: Robot, data: Measured },
}

impl Ask {
    fn answer(&self) -> Result<Value, CompareError> {
        match self {
            Ask::Start => Ok(start()),
            Ask::Demo => held::demo(),
            Ask::Robot { robot } => robot.told(),
            Ask::Predict { robot, actuator_kpa } => robot.predicted(actuator_kpa),
            Ask::Compare { robot, data } => held::compared(robot, data),
            Ask::Diagnose { robot, data } => held::diagnosed(robot, data),
        }
    }
}

/// The answer to a question in JSON: `{"ok": …}`, or `{"error": {"message": …, "help": …}}`.
pub fn answer(question: &str) -> String {
    let told = match serde_json::from_str::<Ask>(question) {
        Ok(ask) => ask.answer(),
        Err(error) => Err(CompareError::refused(format!("this is not a question: {error}"), "see web/src/question.rs")),
    };
    let told = match told {
        Ok(value) => json!({"ok": value}),
        Err(error) => json!({"error": {"message": error.to_string(), "help": error.help()}}),
    };
    told.to_string()
}

/// Robot and data that the page opens with: the data hold an effect that the textbook robot lacks.
const STORY: [&str; 2] = [compare::demo::ROBOT[0], "synthetic-epam"];

fn start() -> Value {
    let [robot, data] = STORY;
    json!({
        "version": env!("CARGO_PKG_VERSION"), "robots": robot::shipped(), "data": data_of::examples(),
        "story": {"robot": format!("{robot}-textbook"), "data": data}, "colours": report::colours(),
    })
}
