//! The diagnosis of a table in sentences, and where a model fails.

use super::reading::BenchReading;
use super::result::{BenchDiagnosis, BenchRanked, LeftOut};
use super::table::{BenchFit, BenchProblem};
use crate::bench::is_free;
use crate::diagnosis::result::Verdict;
use crate::diagnosis::result::words::{quantity, with_interval};
use crate::fit::numbers::{groups, largest, least, mean, sort_by};
use crate::policy;
use crate::wording::{list, p_value, short};

/// Levels that are described one by one; more are described by thirds.
const MOST_LEVELS: usize = 4;

pub(super) fn story(d: &BenchDiagnosis) -> Vec<String> {
    let mut told = vec![opening(d)];
    told.extend(d.base.iter().map(|p| format!("Fitted along: {}.", with_interval(p))));
    let best = d.set().next();
    told.push(verdict(d, best));
    told.extend(best.filter(|_| d.verdict != Some(Verdict::None)).map(|best| of_best(d, best)).unwrap_or_default());
    told.extend(at_its_bound(d, best.map_or(d.off, |b| b.off)).filter(|_| d.verdict != Some(Verdict::None)));
    if !d.unsized_laws.is_empty() {
        told.push(format!(
            "Not tried, because they act by the muscle's size, which neither table nor scenario gives: {}. Add # diameter_mm: and a \
             number above the header, or name a scenario.",
            list(&d.unsized_laws)
        ));
    }
    told
}

fn percent(share: f64) -> String {
    if share < 0.1 { format!("{:.1} %", 100.0 * share) } else { format!("{:.0} %", 100.0 * share) }
}

fn opening(d: &BenchDiagnosis) -> String {
    let noise = match (d.noise, d.reduced_chi2) {
        (Some(noise), Some(chi2)) => format!("standard error {}, χ²/dof {chi2:.1}", percent(noise)),
        _ => "the table states no standard deviation for every row".into(),
    };
    format!("The model as it is misses the table by {} (rms of {} rows; {noise}).", percent(d.off), d.rows)
}

fn verdict(d: &BenchDiagnosis, best: Option<&BenchRanked>) -> String {
    let p = d
        .p_value
        .map(|p| format!(" ({} after correcting for {} laws)", p_value(p), d.ranked.len()))
        .unwrap_or_default();
    let to = best.map(|b| format!("{} brings it to {}", b.effect, percent(b.off)));
    match (d.verdict, to) {
        (Some(Verdict::None), _) => {
            format!("It agrees with the table within the standard deviations: no missing effect detectable{p}.")
        }
        (Some(Verdict::Effect), Some(to)) => format!("{to}{p}."),
        (Some(_), Some(to)) => {
            format!("No single effect of the catalogue explains it{p}: {to}, and that is more than noise.")
        }
        (Some(_), None) => format!("No single effect of the catalogue explains it{p}: none lowers the misfit."),
        (None, Some(to)) if d.explains => format!(
            "{to}, less than a fifth. The table does not show whether the rest is noise; --sigma 3% gives the scatter of a row."
        ),
        (None, Some(to)) => format!(
            "No single effect of the catalogue removes four fifths of it: {to}. The table does not show the noise; --sigma 3% gives it."
        ),
        (None, None) => "No single effect of the catalogue lowers it within its range.".into(),
    }
}

fn of_best(d: &BenchDiagnosis, best: &BenchRanked) -> Vec<String> {
    let values: Vec<String> = best.parameters.iter().map(with_interval).collect();
    let mut told = vec![format!("{}: {}. {}", best.effect, values.join(", "), best.sentence)];
    told.extend(d.left_out.iter().zip(&best.left_out).map(|(before, after)| holds(before, after, &best.effect)));
    let others = list(d.set().map(|r| format!("{} ({})", r.effect, percent(r.off))));
    told.push(match (d.set().count(), d.explains) {
        (0 | 1, true) => "Best explanation in this catalogue, without a rival in it. Another effect that is not listed may look the same.".into(),
        (0 | 1, false) => "It is the best of the catalogue, and not enough: another law, several effects, or the table.".into(),
        _ => format!("Equally good with this table: {others}. The data do not choose between them."),
    });
    told
}

fn at_its_bound(d: &BenchDiagnosis, off: f64) -> Option<String> {
    let closer = d.ranked.iter().filter(|r| r.at_bound && r.off < off);
    let r = least(closer, |r| r.off)?;
    let bounds = r.parameters.iter().filter(|p| p.at_bound);
    let at = list(bounds.map(|p| format!("{} = {}", p.symbol, quantity(p.value, &p.unit))));
    let (effect, to) = (&r.effect, percent(r.off));
    Some(format!("{effect} would bring it to {to}, but at the end of its range, {at}, and the data push beyond it."))
}

fn holds(before: &LeftOut, after: &LeftOut, effect: &str) -> String {
    let verdict = if policy::falls(after.off, before.off) {
        "it predicts what it has not seen"
    } else {
        "caution: it does not predict what it has not seen"
    };
    format!(
        "With each {} left out of the fit in turn, the error there goes from {} to {}: {verdict}. {effect} fits best in {} of {}.",
        before.what,
        percent(before.off),
        percent(after.off),
        after.first_in,
        after.parts
    )
}

/// Where errors d ([`super::table`]) are: on the whole, by load, pressure and specimen, and the largest.
pub(super) fn places(table: &BenchProblem, fit: &BenchFit) -> Vec<String> {
    let off = &fit.off[..];
    let beam = table.readings[0].row.get("load").is_some();
    let free = table.readings.iter().any(|r| is_free(r.row));
    let mean = mean(off.iter().copied());
    let below = off.iter().filter(|o| **o < 0.0).count();
    let most = below.max(off.len() - below);
    let (word, why) = match (beam, mean < 0.0) {
        (true, true) => ("below", "too stiff"),
        (true, false) => ("above", "too soft"),
        (false, true) => ("below", "too weak"),
        (false, false) => ("above", "too strong"),
    };
    let (rows, percent) = (off.len(), format!("mean {:+.1} %", 100.0 * mean.exp_m1()));
    let mut told = vec![match 4 * most >= 3 * rows {
        true => format!("the model is {word} the table in {most} of {rows} rows, {percent}: {why}"),
        false => percent,
    }];
    let of_drive = |v: f64| {
        if beam { format!("{v:.2} of the collapse load") } else { format!("{} % contraction", short(100.0 * v)) }
    };
    let kpa = |v: f64| format!("{} kPa", short(1e-3 * v));
    let ordered = [
        by_level(table, off, &|r| r.drive, &of_drive)
            .filter(|_| beam || !free)
            .map(|s| format!("by {}: {s}", if beam { "load" } else { "contraction" })),
        by_level(table, off, &|r| r.pressure_pa, &kpa).map(|s| format!("by pressure: {s}")),
        by_specimen(table, off).map(|s| format!("by specimen: {s}")),
    ];
    told.extend(ordered.into_iter().flatten());
    if let Some((r, o)) = largest(table.readings.iter().zip(off), |(_, off)| off.abs()) {
        let share = if beam { format!(", {}", of_drive(r.drive)) } else { String::new() };
        told.push(format!("largest in line {} ({}{share}): {:+.1} %", r.row.line, r.at, 100.0 * o.exp_m1()));
    }
    told
}

/// Means of levels, if they hold enough of the squares about the mean of all.
fn told(off: &[f64], levels: &[(String, Vec<usize>)]) -> Option<String> {
    let all = mean(off.iter().copied());
    let of = |rows: &Vec<usize>| mean(rows.iter().map(|i| off[*i]));
    let squares: f64 = off.iter().map(|o| (o - all).powi(2)).sum();
    let between: f64 = levels.iter().map(|(_, rows)| rows.len() as f64 * (of(rows) - all).powi(2)).sum();
    let share = between / squares.max(f64::MIN_POSITIVE);
    let words = levels.iter().map(|(w, rows)| format!("{:+.1} % at {w}", 100.0 * of(rows).exp_m1()));
    (levels.len() > 1 && share > policy::PATTERN_TELLS)
        .then(|| format!("{} ({:.0} % of the scatter about the mean)", list(words), 100.0 * share))
}

fn by_level(
    table: &BenchProblem,
    off: &[f64],
    of: &dyn Fn(&BenchReading) -> f64,
    word: &dyn Fn(f64) -> String,
) -> Option<String> {
    let values: Vec<f64> = table.readings.iter().map(of).collect();
    let mut order: Vec<usize> = (0..values.len()).collect();
    sort_by(&mut order, |i| values[*i]);
    let distinct = groups(&order, |a, b| values[**a].to_bits() == values[**b].to_bits());
    let parts: Vec<Vec<usize>> = match distinct.len() {
        n if n <= MOST_LEVELS => distinct.iter().map(|d| d.iter().map(|k| order[*k]).collect()).collect(),
        _ => order.chunks(order.len().div_ceil(3)).map(<[usize]>::to_vec).collect(),
    };
    let label = |rows: &Vec<usize>| {
        let (first, last) = (word(values[rows[0]]), word(values[rows[rows.len() - 1]]));
        let number = |w: &str| w.split(' ').next().unwrap_or_default().to_string();
        if first == last { last } else { format!("{} to {last}", number(&first)) }
    };
    told(off, &parts.into_iter().map(|rows| (label(&rows), rows)).collect::<Vec<_>>())
}

fn by_specimen(table: &BenchProblem, off: &[f64]) -> Option<String> {
    let parts = groups(&table.readings, |a, b| a.specimen == b.specimen);
    let label = |rows: &Vec<usize>| match table.readings[rows[0]].specimen.as_str() {
        "" => "the one without a size".to_string(),
        words => words.to_string(),
    };
    told(off, &parts.into_iter().map(|rows| (label(&rows), rows)).collect::<Vec<_>>())
}

#[cfg(test)]
mod tests {
    use super::told;

    #[test]
    fn levels_are_told_if_they_hold_a_quarter_of_the_scatter() {
        let levels = [("10 kPa".to_string(), vec![0, 1]), ("20 kPa".to_string(), vec![2, 3])];
        // Means ±a, rows a ± 1 about them: a²/(a² + 1) is between the levels.
        let of = |share: f64| {
            let a = (share / (1.0 - share)).sqrt();
            told(&[a + 1.0, a - 1.0, 1.0 - a, -1.0 - a], &levels)
        };
        assert_eq!(of(0.24), None);
        assert!(of(0.26).unwrap().ends_with("at 20 kPa (26 % of the scatter about the mean)"));
    }
}
