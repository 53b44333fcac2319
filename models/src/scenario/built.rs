//! What cannot be built: one place for the scenario and for the finite elements.

use super::choice::ActuatorChoice;
use super::stated::Scenario;
use crate::actuators::pattern::Pattern;
use std::f64::consts::PI;

/// Whether a station is beyond the end of a body of this length, by more than rounding.
pub(super) fn is_off(station_m: f64, length_m: f64) -> bool {
    station_m > length_m * (1.0 + 1e-9)
}

impl Scenario {
    /// Refuses what this robot and the sewing pattern of one of its strips do not allow together, with welds `weld_m` wide and the
    /// sheet's edge `margin_m` beyond them.
    ///
    /// # Errors
    /// The fault with its number, and what to change.
    pub fn fits(&self, strip: &ActuatorChoice, pattern: &Pattern, weld_m: f64, margin_m: f64) -> Result<(), String> {
        if !strip.exists() {
            return Err("a beam without [actuator] has no sewing pattern; add one".into());
        }
        sewn(pattern, self.radius_m, weld_m, margin_m)?;
        let end_m = self.length_m * (1.0 + 1e-9);
        let length = self.length_m * 1e3;
        if let Some(s) = self.markers_m.iter().find(|s| !(0.0..=end_m).contains(*s)) {
            return Err(format!("a marker at {} mm is off the body of {length} mm", s * 1e3));
        }
        let last_m = strip.start_m + strip.count as f64 * pattern.pitch_m * strip.cos_slant(self.radius_m);
        if strip.start_m < 0.0 || last_m > end_m {
            let count = strip.count;
            return Err(format!("{count} units that end at {:.1} mm do not fit the body of {length} mm", last_m * 1e3));
        }
        // The ends of a slanted strip reach beyond its middle line.
        let beyond_m = (0.5 * (pattern.width_m + weld_m) + margin_m) * strip.sin_slant(self.radius_m).abs();
        if strip.start_m < beyond_m || last_m + beyond_m > end_m {
            let [beyond, last] = [beyond_m, last_m].map(|m| m * 1e3);
            return Err(format!(
                "the ends of a strip that turns round the body reach {beyond:.1} mm beyond its middle, which reaches from {:.1} to {last:.1} mm of {length} mm\nmove start_mm or make the body longer",
                strip.start_m * 1e3
            ));
        }
        Ok(())
    }

    /// The same for every stretch of the reduced model, whose welds are lines; and the actuator's line of action is beyond
    /// the body's axis.
    pub(super) fn can_be_built(&self) -> Result<(), String> {
        for span in self.spans() {
            let Some(actuator) = span.actuator else { continue };
            sewn(&(actuator.pattern)(&span.shape), span.radius_m, 0.0, 0.0)?;
            if span.arm_m < span.radius_m {
                let (arm, radius) = (span.arm_m * 1e3, span.radius_m * 1e3);
                return Err(format!(
                    "an arm of {arm} mm from the far side of the body ends inside it, below its axis at {radius} mm"
                ));
            }
        }
        Ok(())
    }
}

fn sewn(pattern: &Pattern, radius_m: f64, weld_m: f64, margin_m: f64) -> Result<(), String> {
    pattern.check(radius_m, weld_m)?;
    pattern.between_welds(weld_m).check(radius_m, weld_m)?;
    let (edge_m, half_m) = (0.5 * (pattern.width_m + weld_m) + margin_m, PI * radius_m);
    if edge_m > half_m {
        let (edge, half) = (edge_m * 1e3, half_m * 1e3);
        return Err(format!(
            "the sheet's edges are {edge:.1} mm from the middle of the strip and meet behind the body, at {half:.1} mm; make the pouch, weld_mm or tape_margin_mm narrower"
        ));
    }
    Ok(())
}
