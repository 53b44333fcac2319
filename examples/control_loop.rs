//! Control with a wrong model: the tip of an ePAM shall rise to 60 mm.
//!
//! Balance of the textbook model: pouches under P pull along one side, the body under p_b straightens, δW = 0 gives the bend. Its
//! inverse is the first pressure. The robot (here the model with all effects) answers lower, so the loop corrects by six tenths of
//! Newton's step ΔP = (y* − y)/(∂y/∂P) with the slope of the wrong model, which is too small where pouches have just opened.
//!
//! ```text
//! step 0:  1.25 kPa, tip at 0.00 mm
//! step 1:  1.90 kPa, tip at 0.00 mm
//! step 2:  2.81 kPa, tip at 2.41 mm
//! step 3:  4.25 kPa, tip at 25.60 mm
//! step 4:  5.98 kPa, tip at 59.45 mm
//! step 5:  6.04 kPa, tip at 60.46 mm
//! ```

use ibr::models::Target;
use ibr::{Predictor, ScenarioFile};

const TARGET_M: f64 = 0.060;
/// Share of Newton's step.
const STEP: f64 = 0.6;

pub(crate) fn example() -> Result<String, ibr::Error> {
    let model = Predictor::new(&ScenarioFile::read("epam-textbook")?.scenario);
    let robot = Predictor::new(&ScenarioFile::read("epam")?.scenario);
    let (mut loads, _) = model.inverse(Target::TipHeight(TARGET_M), None)?;
    let mut lines = String::new();
    for step in 0..6 {
        let seen_m = robot.state(&loads)?.prediction.tip.y_m;
        let pressure_pa = loads.actuator_pa[0];
        lines += &format!("step {step}: {:5.2} kPa, tip at {:.2} mm\n", pressure_pa / 1e3, 1e3 * seen_m);
        let slope_m_per_pa = model.jacobian(&loads)?[0].y_per_pa;
        loads = model.loads(None, &[pressure_pa + STEP * (TARGET_M - seen_m) / slope_m_per_pa])?;
    }
    Ok(lines)
}

fn main() -> Result<(), ibr::Error> {
    print!("{}", example()?);
    Ok(())
}
