//! Cutting plans.

use crate::prelude::*;
use models::cutting::{CuttingPlan, Making, PatternPiece};

/// `ibr.pattern`: `ibr pattern SCENARIO`
#[derive(Serialize)]
pub(crate) struct PatternAnswer<'a> {
    /// Scenario as typed
    pub scenario: &'a str,
    /// Width of the welds
    pub weld_mm: f64,
    /// Fabric beyond welds and ends
    pub allowance_mm: f64,
    /// Pieces to cut
    pub pieces: &'a [PatternPiece],
    /// What the plan leaves to its reader
    pub notes: &'a [String],
    /// Files
    pub written: &'a [String],
}

impl<'a> PatternAnswer<'a> {
    /// Of a plan, its notes and the files that were written.
    pub(crate) fn of(
        scenario: &'a str,
        plan: &'a CuttingPlan,
        making: &Making,
        notes: &'a [String],
        written: &'a [String],
    ) -> PatternAnswer<'a> {
        let (weld_mm, allowance_mm) = (1e3 * making.weld_m, 1e3 * making.allowance_m);
        PatternAnswer { scenario, weld_mm, allowance_mm, pieces: &plan.pieces, notes, written }
    }

    pub(crate) fn text(&self) -> String {
        let size = |[a, b]: [f64; 2]| 1e3 * (b - a);
        let pieces = Table::of(self.pieces)
            .words("piece", |p| &p.name)
            .right("copies", |p| p.copies.to_string())
            .right("fabric", |p| p.fabric)
            .number("warp [deg]", 0, |p| p.warp_rad.to_degrees())
            .number("along [mm]", 1, |p| size(p.x_m))
            .number("across [mm]", 1, |p| size(p.y_m))
            .text();
        format!("{pieces}{}\n1:1, written: {}\n", lines("", self.notes), self.written.join(", "))
    }
}
