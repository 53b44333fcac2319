//! A robot put together, which its scenario and its states share.

use ibr::models::Prediction;
use ibr::{Predictor, ScenarioFile};
use std::sync::Mutex;

/// A robot put together, and buffers for one prediction at a time.
pub struct Robot {
    pub predictor: Predictor,
    pub scratch: Mutex<Prediction>,
}

impl Robot {
    pub fn new(file: &ScenarioFile) -> Robot {
        let predictor = Predictor::new(file);
        Robot { scratch: Mutex::new(predictor.model().prediction()), predictor }
    }
}
