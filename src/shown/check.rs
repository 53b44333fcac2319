//! What a table of markers holds.

use crate::tables::{number, table};
use data::CheckReport;

/// For readers.
pub fn check_text(report: &CheckReport) -> String {
    let mut out = format!(
        "{}: {} runs of actuator {}, {} holds, {} markers, {} samples per hold{}\n",
        report.name,
        report.runs.len(),
        report.actuator,
        report.holds.len(),
        report.markers.len(),
        report.samples_per_hold,
        report.provenance.as_ref().map_or(String::new(), |p| format!(" ({p})"))
    );
    let holds = report.holds.iter().map(|h| {
        let more = h.p_act_channels_kpa.iter().skip(1).map(|p| format!("/{p:.2}"));
        let cells =
            [format!("{:.2}{}", h.p_act_kpa, more.collect::<String>()), format!("{:.2}", h.p_body_kpa), h.phase.into()];
        let rest = [format!("{:.1}", h.duration_s), number(h.scatter_mm, 2)];
        let read = h.gauge_kpa.map(|kpa| format!("{kpa:.2}"));
        cells.into_iter().chain(rest).chain(read).collect()
    });
    let head = ["P [kPa]", "body [kPa]", "phase", "duration [s]", "scatter of runs [mm]", "gauge [kPa]"];
    let head = &head[..head.len() - usize::from(report.holds.iter().any(|h| h.gauge_kpa.is_none()))];
    out.push_str(&table(head, 0, holds.collect()));
    let markers = report.markers.iter().map(|m| vec![m.name.clone(), number(m.s_mm, 1), number(m.scatter_mm, 2)]);
    out.push_str(&table(&["marker", "station [mm]", "scatter of runs [mm]"], 1, markers.collect()));
    for o in &report.outliers {
        out.push_str(&format!(
            "outlier: run {}, hold {}, sample {}, marker {}: {:+.1}, {:+.1}{} mm off\n",
            o.run,
            o.hold + 1,
            o.sample + 1,
            o.marker,
            o.dx_mm,
            o.dy_mm,
            o.dz_mm.map_or(String::new(), |dz| format!(", {dz:+.1}"))
        ));
    }
    for [a, b] in &report.identical_runs {
        out.push_str(&format!("runs {a} and {b} are identical copies\n"));
    }
    report.warnings.iter().for_each(|w| out.push_str(&format!("note: {w}\n")));
    out
}
