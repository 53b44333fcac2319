use super::Result;
use super::figures::measured;
use crate::prelude::*;
use compare::diagnosis::{Diagnosis, EffectAnswer, Group, Standing};
use compare::extension::ErrorStep;
use compare::study::engines::{Energies, TERMS};
use compare::study::predict::predict_dataset;
use compare::witness::{Witness, WitnessRow};
use data::Phase;
use models::Step;
use report as plots;

const MM: f64 = 1e3;
const POINTS: u32 = 48;
/// Curves go this much beyond the highest measured pressure, where candidates part.
const BEYOND: f64 = 1.3;
/// Candidates drawn as curves: as many as have a colour different from the measurement's.
const MOST_CURVES: usize = 7;
const MEASURED: usize = 5;
/// Ledgers drawn next to the ledger of finite elements: the base, the stated set, then the nearest.
const MOST_LEDGERS: usize = 6;
/// Of those the others than the base and the stated set, so that there is something to compare with.
const OTHER_LEDGERS: usize = 2;
/// Candidates drawn in addition to the stated set, for the same reason.
const OTHER_CURVES: usize = 2;

/// What others are called where colours do not say it.
const FITS_WORSE: &str = "fits worse";

/// Supply against the readings of every gauge, before and after; `None` without a gauge.
pub(super) fn supply(d: &Diagnosis) -> Result<Option<Drawn>> {
    if d.gauges.is_empty() {
        return Ok(None);
    }
    // An effect of the body leaves the supply's laws as they were.
    let of_supply = d.added.iter().chain(&d.attempt).any(|a| a.group == Group::Supply);
    let after = d.final_model().filter(|_| of_supply).map(|(names, how)| format!("{names} ({how})"));
    let series = |gauge: &compare::diagnosis::GaugeFit| {
        let values = std::iter::once(gauge.before_kpa).chain(after.as_ref().map(|_| gauge.after_kpa));
        (format!("gauge in {}", gauge.dataset), values.collect(), false)
    };
    let groups: Vec<String> = std::iter::once("supply of the scenario".to_string()).chain(after.clone()).collect();
    let series: Vec<_> = d.gauges.iter().map(series).collect();
    let label = "supply's laws against the gauge, rms [kPa]";
    Ok(Some(plots::bars("The supply, before and after", label, &groups, &series, None)?))
}

/// Error of every model, training and left-out data, with the noise of the mean.
pub(super) fn waterfall(title: &str, rungs: &[ErrorStep], floor_mm: Option<f64>) -> Result<Drawn> {
    let series = |name: &str, of: fn(&ErrorStep) -> f64| (name.to_string(), rungs.iter().map(of).collect(), false);
    let groups: Vec<String> = rungs.iter().map(|r| super::effect(&r.label())).collect();
    let series = [
        series("data of the fit", |r| r.training_mm),
        series("pressures left out", |r| r.heldout_pressure_mm.unwrap_or(f64::NAN)),
        series("runs left out", |r| r.heldout_run_mm.unwrap_or(f64::NAN)),
    ];
    let target = floor_mm.map(|value| ("noise of the mean".into(), value));
    Ok(plots::bars(title, "error beyond noise [mm]", &groups, &series, target)?)
}

/// Meaning of the colour of a bar of the ranking.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Rank {
    Alike,
    Attempt,
    Worse,
    Other,
    Rejected,
}

const RANKS: [(Rank, &str, Ink); 5] = [
    (Rank::Alike, "fit equally well", Ink::Series(2)),
    (Rank::Attempt, "attempt", Ink::Series(1)),
    (Rank::Worse, FITS_WORSE, Ink::Muted),
    (Rank::Other, "others", Ink::Muted),
    (Rank::Rejected, "on a physical bound, rejected", Ink::Grid),
];

/// Name, rank and gain of every answer relative to the best one's \[%\]; stated ones, the attempt, worse and rejected ones, each by
/// their bars. `None` where nothing helps.
pub(super) fn ranking_rows(d: &Diagnosis) -> Option<Vec<(String, Rank, f64)>> {
    let answers = d.answers();
    let possible = answers.iter().filter(|a| a.standing != Standing::Rejected && a.gain.is_finite());
    let best = possible.map(|a| a.gain).fold(0.0, f64::max);
    let rank = |a: &EffectAnswer| match a.standing {
        Standing::Stated => Rank::Alike,
        Standing::Attempt => Rank::Attempt,
        Standing::Other if d.indistinguishable.is_empty() => Rank::Other,
        Standing::Other => Rank::Worse,
        Standing::Rejected => Rank::Rejected,
    };
    let mut rows: Vec<_> = answers.iter().map(|a| (a.name(), rank(a), 100.0 * a.gain / best)).collect();
    rows.sort_by(|a, b| a.1.cmp(&b.1).then(b.2.total_cmp(&a.2)));
    (best > 0.0).then_some(rows)
}

pub(super) fn ranking(d: &Diagnosis) -> Result<Option<Drawn>> {
    let Some(rows) = ranking_rows(d) else { return Ok(None) };
    let title = if d.pairs.is_empty() { "What one effect explains" } else { "What one effect or two explain" };
    let digits = plots::decimals(rows.iter().map(|row| row.2));
    let bar = |(row, (_, rank, value)): (usize, &(String, Rank, f64))| {
        let (_, _, ink) = RANKS[*rank as usize];
        Mark::Bar(Bar::to(row, *value, ink, plots::number(*value, digits)))
    };
    let marks = rows.iter().enumerate().map(bar).collect();
    let present = RANKS.iter().filter(|(rank, ..)| rows.iter().any(|row| row.1 == *rank));
    let keys = present.map(|(_, words, ink)| LegendEntry::new(KeyLook::Patch, *ink, words)).collect();
    let names = rows.iter().map(|row| ChartRow::beside(&super::effect(&row.0))).collect();
    let label = "gain: fall of the squares, weighted by the noise; % of the best";
    Ok(Some(plots::rows(title, label, names, marks, keys).draw("ranking")?))
}

/// Answers worth a curve: the stated set or the attempt, then the nearest others.
pub(super) fn shown(d: &Diagnosis) -> Vec<EffectAnswer<'_>> {
    let mut kept: Vec<EffectAnswer> = d.answers().into_iter().filter(EffectAnswer::helps).collect();
    let first = kept.iter().filter(|a| a.standing != Standing::Other).count();
    kept.truncate((first + OTHER_CURVES).min(MOST_CURVES));
    kept
}

/// `12 of the 14 that fit equally well`, where not all of them are drawn.
pub(super) fn left_out(d: &Diagnosis, drawn: &[EffectAnswer]) -> Option<String> {
    let stated = |answers: &[EffectAnswer]| answers.iter().filter(|a| a.standing == Standing::Stated).count();
    let (shown, all) = (stated(drawn), d.indistinguishable.len());
    (shown < all).then(|| format!("Drawn are the first {shown} of the {all} that fit equally well."))
}

/// What the answers predict over pressure, as the difference from the calibrated base: height of the outermost marker on first
/// loading at the first body pressure, after the time that the samples have waited in their holds.
pub(super) fn candidate_curves(d: &Diagnosis, scenario: &Scenario, dataset: &Dataset) -> Result<Option<Drawn>> {
    let Some(first) = dataset.holds.first() else { return Ok(None) };
    let level = d.level(first.p_body_pa * 1e-3);
    let top_pa = BEYOND * dataset.holds.iter().map(|h| h.p_act_pa).fold(0.0, f64::max);
    let candidates = shown(d);
    if candidates.is_empty() || top_pa <= 0.0 {
        return Ok(None);
    }
    let wait_s = waited_s(dataset);
    let heights = |scenario: &Scenario| -> Vec<f64> {
        let model = Model::new(scenario);
        let mut state = model.prediction();
        let mut height = |i: u32| {
            let p = top_pa * (f64::from(i) / f64::from(POINTS)).powi(2);
            let loads = Loads::uniform(first.p_body_pa, p);
            let found = match model.has_history() {
                true => model.follow(&[0.0, wait_s].map(|t_s| Step { t_s, loads }), &mut state, &mut |_, _| {}),
                false => model.predict(&loads, &mut state),
            };
            found.ok().and_then(|()| state.markers.last().map(|m| m[1] * MM)).unwrap_or(f64::NAN)
        };
        (0..=POINTS).map(&mut height).collect()
    };
    let base = d.calibrated(scenario, level);
    let zero = heights(&base);
    let mut series = vec![deviations(&base, dataset)?];
    for (i, answer) in candidates.iter().enumerate() {
        let own = heights(&answer.on(scenario, level));
        let point = |k: usize| [1e-3 * top_pa * (k as f64 / f64::from(POINTS)).powi(2), own[k] - zero[k]];
        let style = if answer.standing == Standing::Other { LineStyle::Dashed } else { LineStyle::Line };
        let name = format!("+ {}{}", super::effect(&answer.name()), attempted(d, answer));
        let line = LineSeries::new(name, style, (0..own.len()).map(point).collect());
        series.push(line.coloured(if i < MEASURED { i } else { i + 1 }));
    }
    let body =
        if super::figures::several_bodies(dataset) { super::figures::body(first.p_body_pa) } else { String::new() };
    let with = if d.base.bending.is_empty() { "B as given" } else { "fitted B alone" };
    let (x, y) = (
        format!("actuator pressure{body} [kPa]"),
        format!("outermost marker, difference from the model with {with} [mm]"),
    );
    Ok(Some(plots::lines(&plots::Lines::new("What the candidates predict differently", &x, &y, series))?))
}

/// Mean time of the samples in their holds under pressure \[s\].
pub(super) fn waited_s(dataset: &Dataset) -> f64 {
    let ends = std::iter::once(0.0).chain(dataset.holds.iter().filter_map(|hold| hold.t_s.last().copied()));
    let under = dataset.holds.iter().zip(ends).filter(|(hold, _)| hold.p_act_pa > 0.0);
    // A hold before the end of the last one begins a session.
    let waits = under.flat_map(|(hold, end)| {
        let begin = if hold.t_s.first().is_some_and(|t| *t >= end) { end } else { 0.0 };
        hold.t_s.iter().map(move |t| t - begin)
    });
    let (sum, count) = waits.fold((0.0, 0.0), |(sum, count), wait| (sum + wait, count + 1.0));
    if count > 0.0 { sum / count } else { 0.0 }
}

fn attempted(d: &Diagnosis, answer: &EffectAnswer) -> String {
    if answer.standing == Standing::Attempt { format!(" ({})", d.attempt_words()) } else { String::new() }
}

/// Models of the ledgers at a level of body pressure: the base and the answers of the curves.
pub(super) fn ledger_cases(d: &Diagnosis, scenario: &Scenario, level: usize) -> Vec<(String, Scenario)> {
    let mut cases = vec![("base".to_string(), d.calibrated(scenario, level))];
    cases.extend(shown(d).iter().map(|a| {
        let worse = a.standing == Standing::Other && !d.indistinguishable.is_empty();
        let what = if worse { format!(" ({FITS_WORSE})") } else { attempted(d, a) };
        (format!("+ {}{what}", a.name()), a.on(scenario, level))
    }));
    cases
}

/// Models of the ledgers next to finite elements: the base, the stated set or the attempt, then the nearest others.
pub(super) fn witness_cases(w: &Witness, d: &Diagnosis) -> Vec<plots::LedgerCase> {
    let Some((base, others)) = w.models.split_first() else { return Vec::new() };
    let named = others.iter().filter(|m| m.named);
    let nearest = others.iter().filter(|m| !m.named).take(OTHER_LEDGERS);
    let is_set = !d.indistinguishable.is_empty();
    let what = |m: &WitnessRow| match (m.named, is_set) {
        (true, true) | (false, false) => String::new(),
        (true, false) => format!(" ({})", d.attempt_words()),
        (false, true) => format!(" ({FITS_WORSE})"),
    };
    let case = |label: String, e: &Energies| (label, e.to_vec());
    let mut cases = vec![case(base.name.clone(), &base.energies_mj)];
    cases.extend(
        named.chain(nearest).map(|m| case(m.name.trim_start_matches("+ ").to_string() + &what(m), &m.energies_mj)),
    );
    cases.truncate(MOST_LEDGERS);
    cases.extend(w.fe_mj.iter().map(|fe| case("finite elements".into(), fe)));
    cases
}

pub(super) fn witness_ledger(w: &Witness, d: &Diagnosis) -> Result<Drawn> {
    let mut cases = witness_cases(w, d);
    cases.iter_mut().for_each(|(label, _)| *label = effect(label));
    let title = format!("Where the energy goes, to {:.0} kPa", w.actuator_kpa);
    Ok(plots::ledger(&title, "energy taken up since the first bend [mJ]", &TERMS.map(String::from), &cases)?)
}

/// Measured minus calibrated base at the loading holds of the first body pressure.
fn deviations(base: &Scenario, dataset: &Dataset) -> Result<LineSeries> {
    let predicted = predict_dataset(base, dataset)?.coordinates_m;
    let tip = dataset.markers.len() - 1;
    let body = dataset.holds[0].p_body_pa;
    let (mut points, mut half_width) = (Vec::new(), Vec::new());
    for (h, hold) in dataset.holds.iter().enumerate() {
        let unseen = !dataset.is_seen(h, tip);
        if unseen || hold.phase == Phase::Unload || (hold.p_body_pa - body).abs() > 0.05 * body {
            continue;
        }
        let (mean, spread) = measured(dataset, h, tip);
        let model: f64 = (0..dataset.samples_per_hold).map(|s| predicted[dataset.offset(h, s, tip) + 1]).sum();
        points.push([hold.p_act_pa * 1e-3, MM * (mean[1] - model / dataset.samples_per_hold as f64)]);
        half_width.push(spread[1] * MM / (dataset.runs.len() as f64).sqrt());
    }
    let line = LineSeries::new("measured (± standard error)", LineStyle::Points, points);
    Ok(line.with_errors(half_width).coloured(MEASURED))
}
