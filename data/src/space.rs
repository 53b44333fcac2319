//! A third coordinate and pressures of several supply channels: what a planar robot leaves aside, and when it must not.

use crate::dataset::Dataset;
use crate::error::{DataError, Result};
use crate::policy::{self, tolerance_act_pa};
use crate::streams::plausible::check_y_up;
use crate::units::mm;

/// A smaller change of z would be printed as 0.0 mm.
const TOLD_MM: f64 = 0.05;

impl Dataset {
    /// Whether the table has more than one plane and one actuator pressure.
    pub fn is_spatial(&self) -> bool {
        self.has_z() || self.more_channels() > 0
    }

    /// Supply channels beyond the first that the table has pressures of.
    pub fn more_channels(&self) -> usize {
        self.holds.first().map_or(0, |hold| hold.more_act_pa.len())
    }

    /// Whether channels ever have different pressures.
    pub fn channels_differ(&self) -> bool {
        let differs = |p: f64, other: &f64| (other - p).abs() > tolerance_act_pa(p);
        self.holds.iter().any(|hold| hold.more_act_pa.iter().any(|other| differs(hold.p_act_pa, other)))
    }

    /// Whether z varies, or channels have different pressures: what a planar robot cannot do.
    pub fn leaves_the_plane(&self) -> bool {
        self.channels_differ() || mm(self.travel_m(2)) >= TOLD_MM
    }

    /// How far a marker was at most from its place in the first hold that saw it, along an axis \[m\]: means over the samples of a
    /// hold, each run alone. 0 of a table without that axis.
    pub fn travel_m(&self, axis: usize) -> f64 {
        let at = |run: usize, hold: usize, marker: usize| {
            let values = (0..self.samples_per_hold)
                .map(|sample| self.place(run, hold, sample, marker).get(axis).copied().unwrap_or(0.0));
            values.sum::<f64>() / self.samples_per_hold as f64
        };
        let mut most: f64 = 0.0;
        for run in 0..self.runs.len() {
            for marker in 0..self.markers.len() {
                let mut seen = (0..self.holds.len()).filter(|hold| !self.is_lost(run, *hold, marker));
                let Some(first) = seen.next().map(|hold| at(run, hold, marker)) else { continue };
                most = seen.map(|hold| (at(run, hold, marker) - first).abs()).fold(most, f64::max);
            }
        }
        most
    }

    /// What a planar robot leaves aside of this table, in words; nothing of a planar table.
    ///
    /// # Errors
    /// Markers that move towards z more than towards y; y that points down, which is not asked before of
    /// a table with z or several channels.
    pub fn left_aside(&self) -> Result<Option<String>> {
        let refused = |message: String, help: &str| Err(DataError::of(&self.name, message, help));
        if !self.is_spatial() {
            return Ok(None);
        }
        let [y_mm, z_mm] = [1, 2].map(|axis| mm(self.travel_m(axis)));
        if z_mm > y_mm && z_mm > mm(policy::SURELY_DOWN_M) {
            let message = format!(
                "the markers move by up to {z_mm:.1} mm towards z and {y_mm:.1} mm towards y, and the robot is planar"
            );
            let help = "y is towards the actuator: exchange the names of the columns of y and z, or describe the robot with azimuth_deg or \
                        [[strip]]";
            return refused(message, help);
        }
        check_y_up(None, self)?;
        let words = "the robot is planar, so z was left aside. If it bends towards z too, describe its strips with azimuth_deg or [[strip]]";
        Ok((z_mm >= TOLD_MM)
            .then(|| format!("{}: z varies by up to {z_mm:.1} mm from the first hold; {words}", self.name)))
    }
}
