//! Several runs in words.

use crate::tables::table;
use compare::study::uncertain::{Member, Uncertain, Weight};
use fem::session::{AS_IT_IS, Heights, RunRow, RunTable, SeedGroup};

/// Every run, then mean and spread of those that differ in the seed only.
pub fn table_text(all: &RunTable) -> String {
    // A robot as it is comes first, then what was changed about it.
    let first = all.rows.first().filter(|run| run.variation.label == AS_IT_IS).map_or(&[][..], |run| &run.heights);
    let row = |run: &RunRow, (k, h): (usize, &Heights)| {
        let [marker, tip, cpu] = [h.marker_mm, h.tip_mm, run.cpu_s].map(|v| format!("{v:.1}"));
        let own = first.get(k).filter(|own| own.actuator_kpa == h.actuator_kpa && own.tip_mm.abs() > 0.0);
        let change = own.map_or("–".into(), |own| format!("{:+.1}", 100.0 * (h.tip_mm / own.tip_mm - 1.0)));
        let rest = if h.is_at_rest { "yes" } else { "no" };
        vec![run.variation.label.clone(), h.actuator_kpa.to_string(), marker, tip, change, rest.into(), cpu]
    };
    let lines = all.rows.iter().flat_map(|run| run.heights.iter().enumerate().map(|h| row(run, h)));
    let head = ["run", "actuator kPa", "outermost marker mm", "tip mm", "change %", "at rest", "run CPU s"];
    let mut text = table(&head, 1, lines.collect());
    let groups = all.groups();
    let row = |g: &SeedGroup| {
        let name = if g.group.is_empty() { "all" } else { &g.group };
        let [mean, sd] = [g.tip_mean_mm, g.tip_sd_mm].map(|v| format!("{v:.1}"));
        vec![name.to_string(), g.actuator_kpa.to_string(), g.runs.to_string(), mean, sd]
    };
    let several: Vec<_> = groups.iter().filter(|g| g.runs > 1).map(row).collect();
    if !several.is_empty() {
        text.push_str("\nTip, mean and standard deviation over the seeds\n");
        text.push_str(&table(&["group", "actuator kPa", "runs", "mean mm", "sd mm"], 1, several));
    }
    text
}

/// Robots that differ in what nobody measured.
pub fn uncertain_text(all: &Uncertain, measured: &[(f64, [f64; 2])]) -> String {
    let stopped: Vec<&Member> = all.members.iter().filter(|m| m.stopped.is_some()).collect();
    let mut out = format!(
        "{}: {} robots whose assumed numbers fill their intervals{}\n\nHeight of the markers [mm]: median (10 % to 90 %)\n",
        all.scenario,
        all.members.len(),
        if stopped.is_empty() { String::new() } else { format!(", {} of which stopped", stopped.len()) }
    );
    let mut head = vec!["actuator kPa".to_string()];
    head.extend(all.stations_mm.iter().map(|s| format!("s = {s}")));
    head.push("measured".into());
    let rows =
        all.pressures_kpa().into_iter().map(|kpa| {
            let cell = |m: usize| {
                let quantiles = all.quantiles_mm(kpa, m, 1);
                quantiles.map_or("–".into(), |[low, middle, high]| format!("{middle:.1} ({low:.1} to {high:.1})"))
            };
            let mut row = vec![format!("{kpa}")];
            row.extend((0..all.stations_mm.len()).map(cell));
            let point = measured.iter().find(|(at, _)| (at - kpa).abs() < 0.05);
            let inside = |y: f64| all.tip_mm(kpa).is_some_and(|[low, _, high]| (low..=high).contains(&y));
            row.push(point.map_or("–".into(), |(_, [_, y])| {
                format!("{y:.1}, {}", if inside(*y) { "inside" } else { "outside" })
            }));
            row
        });
    out.push_str(&table(&head, 0, rows.collect()));
    let top = all.top_kpa();
    if let Some((weights, rest)) = all.weights(top) {
        out.push_str(&format!("\nWhat to measure first: outermost marker at {top} kPa\n"));
        let row = |w: &Weight| {
            let number = &all.numbers[w.number];
            vec![
                number.name.clone(),
                format!("{} to {}", number.interval[0], number.interval[1]),
                format!("{:+.1}", w.swing_mm),
                format!("{:.0}", 100.0 * w.share),
                number.reason.clone(),
            ]
        };
        let head = ["assumed", "interval", "10 % to 90 % of it: mm", "of the variance %", "why this interval"];
        out.push_str(&table(&head, 2, weights.iter().map(row).collect()));
        out.push_str(&calibrated(all, measured, &weights));
        out.push_str(&format!("{:.0} % of the variance is not of a straight law\n", 100.0 * rest));
    }
    for member in stopped {
        out.push_str(&format!("stopped: {}\n", member.stopped.as_deref().unwrap_or_default()));
    }
    out
}

/// What one number would have to be for the measured displacement, all others in the middle of their intervals.
fn calibrated(all: &Uncertain, measured: &[(f64, [f64; 2])], weights: &[Weight]) -> String {
    let Some((kpa, [_, y])) = measured.last() else { return String::new() };
    let mut out = format!(
        "\nCalibration, no prediction: what one number would have to be for the measured {y:.1} mm at {kpa} kPa, by a straight law\n"
    );
    let rows = weights.iter().map(|w| {
        let number = &all.numbers[w.number];
        let wanted = all.share_for(*kpa, w.number, *y).filter(|share| (0.0..=1.0).contains(share));
        let place =
            wanted.map_or("none in its interval".into(), |share| format!("{:.0} % of its interval", 100.0 * share));
        vec![number.name.clone(), place]
    });
    out.push_str(&table(&["assumed", "wanted"], 2, rows.collect()));
    out
}
