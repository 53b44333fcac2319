//! The scenario with a learned law: a new `[[formula]]`, and the position of the markers' line.

use super::steps::Ground;
use super::text::{Addition, BodyValue, today, with_formula};
use super::written::{Extension, FittedEffect};
use crate::diagnosis::{Diagnosis, LearnedLaw};
use crate::error::CompareError;
use crate::policy;
use crate::scenario_file::ScenarioFile;

const CENTRE_LINE: &str = "centre_line_mm";

pub(super) fn learned(file: &ScenarioFile, found: &Diagnosis) -> Result<Extension, CompareError> {
    let Some(law) = &found.learned else {
        let message = "no law of the library predicts pressures left out better than the model as it is";
        let help = "learning takes at least three actuator pressures; `ibr diagnose` names what else may be missing";
        return Err(CompareError::refused(message, help));
    };
    let ground = Ground::new(found, file);
    let line = law.line.as_ref().map(|line| {
        let now_m = file.centre_line_m.unwrap_or(file.radius_m);
        let remark = format!("calibrated on {} ({}) with the law learned below", found.dataset, today());
        BodyValue { key: CENTRE_LINE, value: 1e3 * now_m + line.value_mm, remark }
    });
    let with = with_formula(file, &law.toml, &origin(found, law), line.as_ref())?;
    let remarks = vec![format!("{} (learned); its formula is below", law.words)];
    let addition = Addition { remarks, ..ground.calibrated(&law.name, &law.parameters) };
    let bending = (!law.bending_nm2.is_empty()).then(|| ground.new_bending(ground.bending(&law.bending_nm2))).flatten();
    let fitted = vec![FittedEffect::of(&law.name, &law.parameters)];
    let written = Extension::written(&with, bending, vec![addition], law.sentences())?;
    let mut extension = Extension { fitted, ..written.climbed(&ground, ground.learned_step(law)) };
    if !law.heldout_after_mm.zip(law.heldout_before_mm).is_some_and(|(after, before)| policy::falls(after, before)) {
        extension.warnings.push(
            "the error at pressures left out hardly falls: this law describes these data and predicts little".into(),
        );
    }
    Ok(extension)
}

fn origin(found: &Diagnosis, law: &LearnedLaw) -> Vec<String> {
    let data: Vec<String> = found.evidence.iter().map(|used| used.words.clone()).collect();
    vec![
        format!("Learned by ibr on {} from {}: {},", today(), data.join(", "), law.words),
        "chosen among the laws of its library by prediction at actuator pressures left out. It is a description, not a cause.".into(),
    ]
}

#[cfg(test)]
mod tests {
    use crate::study::published::shipped_scenario;
    use models::{Loads, Model, Scenario};

    /// A fitted height of the markers is written as another position of the centre line, which gives the same positions.
    #[test]
    fn markers_off_the_axis_are_a_centre_line_elsewhere() {
        for kind in ["spam", "cpam", "epam", "fpam"] {
            let robot = shipped_scenario(kind).unwrap();
            let line = Scenario { centre_line_m: Some(robot.radius_m - 0.007), ..robot.clone() };
            let seen = |scenario: &Scenario| {
                let model = Model::new(scenario);
                let mut state = model.prediction();
                model.predict(&Loads::uniform(2e3, 25e3), &mut state).unwrap();
                state.markers
            };
            let (height, line) = (seen(&robot.with_effect("marker_height", &[-0.007])), seen(&line));
            let away = height.iter().flatten().zip(line.iter().flatten()).map(|(a, b)| (a - b).abs());
            assert!(away.fold(0.0, f64::max) < 1e-12, "{kind}");
        }
    }
}
