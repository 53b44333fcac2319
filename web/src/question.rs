//! The questions of the page.

use crate::data_of::Measured;
use crate::robot::Robot;
use crate::{data_of, held, robot};
use compare::CompareError;
use serde::Deserialize;
use serde_json::{Value, json};

/// A question.
#[derive(Debug, Deserialize)]
#[serde(tag = "ask", rename_all = "snake_case", deny_unknown_fields)]
pub enum Ask {
    /// What there is: robots, example data, colours.
    Start,
    /// What a robot is: its text, what can be turned, its effects.
    Robot {
        /// Which.
        robot: Robot,
    },
    /// Its shape at a pressure of every supply channel \[kPa\], and that of its bare model.
    Predict {
        /// Which.
        robot: Robot,
        /// One pressure for all channels, or one for each.
        actuator_kpa: Vec<f64>,
    },
    /// It held against measurements.
    Compare {
        /// Which.
        robot: Robot,
        /// Measurements.
        data: Measured,
    },
    /// What it lacks.
    Diagnose {
        /// Which.
        robot: Robot,
        /// Measurements.
        data: Measured,
    },
}

impl Ask {
    fn answer(&self) -> Result<Value, CompareError> {
        match self {
            Ask::Start => Ok(start()),
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
        Err(error) => Err(CompareError::refused(format!("this is no question: {error}"), "see web/src/question.rs")),
    };
    let told = match told {
        Ok(value) => json!({"ok": value}),
        Err(error) => json!({"error": {"message": error.to_string(), "help": error.help()}}),
    };
    told.to_string()
}

fn start() -> Value {
    let [robot, data] = compare::demo::HIDDEN_IN;
    json!({
        "version": env!("CARGO_PKG_VERSION"), "robots": robot::shipped(), "data": data_of::examples(),
        "story": {"robot": format!("{robot}-textbook"), "data": data}, "colours": report::page::colours(),
    })
}
