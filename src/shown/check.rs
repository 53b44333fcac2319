//! What a table of markers holds.

use crate::prelude::*;
use data::CheckReport;

/// `ibr.data.check`: `ibr data check DATA`
#[derive(Serialize)]
pub(crate) struct CheckedTable {
    /// What was found
    pub check: Check,
}

/// What was found in data.
#[derive(Serialize)]
#[serde(untagged)]
pub(crate) enum Check {
    /// In a table of markers
    Markers(Box<CheckReport>),
    /// In a table of bench tests
    Bench(BenchCheck),
}

/// A table of bench tests.
#[derive(Serialize)]
pub(crate) struct BenchCheck {
    /// Kind of the table of bench tests
    pub kind: &'static str,
    /// Rows of that table
    pub rows: usize,
    /// How its numbers came to be
    pub provenance: Provenance,
}

pub(crate) fn check_text(report: &CheckReport) -> String {
    let CheckReport { name, runs, actuator, holds, markers, samples_per_hold, .. } = report;
    let provenance = report.provenance.as_ref().map_or(String::new(), |p| format!(" ({p})"));
    let mut out = format!(
        "{name}: {} runs of actuator {actuator}, {} holds, {} markers, {samples_per_hold} samples per hold{provenance}\n",
        runs.len(),
        holds.len(),
        markers.len(),
    );
    out += &Table::of(holds)
        .right("P [kPa]", |h| {
            let more = h.p_act_channels_kpa.iter().skip(1).map(|p| format!("/{p:.2}"));
            format!("{:.2}{}", h.p_act_kpa, more.collect::<String>())
        })
        .number("body [kPa]", 2, |h| h.p_body_kpa)
        .right("phase", |h| h.phase)
        .number("duration [s]", 1, |h| h.duration_s)
        .number("scatter of runs [mm]", 2, |h| h.scatter_mm)
        .when(holds.iter().all(|h| h.gauge_kpa.is_some()), |t| t.number("gauge [kPa]", 2, |h| h.gauge_kpa))
        .text();
    out += &Table::of(markers)
        .words("marker", |m| &m.name)
        .number("station [mm]", 1, |m| m.s_mm)
        .number("scatter of runs [mm]", 2, |m| m.scatter_mm)
        .text();
    for o in &report.outliers {
        let (run, hold, sample, marker) = (&o.run, o.hold + 1, o.sample + 1, &o.marker);
        let dz = o.dz_mm.map_or(String::new(), |dz| format!(", {dz:+.1}"));
        let off = format!("{:+.1}, {:+.1}{dz} mm off", o.dx_mm, o.dy_mm);
        out += &format!("outlier: run {run}, hold {hold}, sample {sample}, marker {marker}: {off}\n");
    }
    out += &lines("", report.identical_runs.iter().map(|[a, b]| format!("runs {a} and {b} are identical copies")));
    out + &lines("note: ", &report.warnings)
}
