//! The report of a diagnosis, for people: whether anything is missing, what it could be, what to do, where it fails.

use super::diagnosis_figures::{
    candidate_curves, ledger_cases, left_out, ranking, shown, supply, waterfall, witness_ledger,
};
use super::{Maker, Result, Values, figures, moment_figure, residual_figure};
use crate::prelude::*;
use crate::shown::diagnosis_tables as tables;
use ::compare::diagnosis::words::listed;
use ::compare::diagnosis::{Diagnosis, EffectAnswer, Standing, Verdict};
use ::compare::extension::error_steps;
use ::compare::progress::Progress;
use ::compare::residuals::{Deviation, ResidualCell, ResidualMap};
use ::compare::study::predict::fit_scenario;
use ::compare::witness::Witness;
use ::compare::wording::p_value;
use data::About;

/// Errors below this are no bar \[mm\].
const SMALLEST_BAR_MM: f64 = 0.005;
/// Explanations in plain words; the tables have all.
const MOST_TOLD: usize = 6;

/// A diagnosis with what it was made of.
pub struct Diagnosed<'a> {
    /// Result of the diagnosis that the page shows.
    pub diagnosis: &'a Diagnosis,
    /// Scenario as the user gave it, before any effect is added.
    pub scenario: &'a Scenario,
    /// Measurements that the scenario was compared with.
    pub dataset: &'a Dataset,
    /// Description of the measurements; `None` if they have none.
    pub about: Option<&'a About>,
    /// Finite element runs of the same robot, if there are any.
    pub witness: Option<&'a Witness>,
    /// Scenario and data as typed, for the commands that come next.
    pub typed: [&'a str; 2],
    /// What else was typed that these commands need, e.g. `--also MORE`; empty for nothing.
    pub more: String,
}

impl<'a> Diagnosed<'a> {
    /// A diagnosis of the first data, without finite elements and with nothing else typed.
    pub fn of(
        diagnosis: &'a Diagnosis,
        scenario: &'a Scenario,
        first: &'a Evidence,
        typed: [&'a str; 2],
    ) -> Diagnosed<'a> {
        let (dataset, about) = (&first.dataset, first.about.as_ref());
        Diagnosed { diagnosis, scenario, dataset, about, witness: None, typed, more: String::new() }
    }
}

/// The page of a diagnosis and its plots.
pub fn diagnosis_page(found: &Diagnosed, maker: &Maker, progress: &mut Progress) -> Result<Files> {
    let mut files = diagnosis_plots(found, progress)?;
    if let Some(missing) = &found.diagnosis.missing_moment {
        files.text("missing_moment.csv", missing.csv());
    }
    files.page("diagnosis.html", values(found), maker)?;
    Ok(files)
}

/// Draws the plots of a diagnosis without its report.
pub fn diagnosis_plots(found: &Diagnosed, progress: &mut Progress) -> Result<Files> {
    let mut files = Files::default();
    draw(found, "", &diagnosis_pictures(), &mut files, progress)?;
    Ok(files)
}

/// A picture of a diagnosis with the scenario fitted to the stations and loads of the data; `None` where there is nothing to show.
type Picture = fn(&Diagnosed, &Scenario) -> Result<Option<Drawn>>;

/// Every picture that a report of a diagnosis may have, and its name without prefix and ending.
const PICTURES: [(&str, Picture); 9] = [
    ("missing_moment", |f, _| {
        let beside = f.witness.map_or(&[][..], |w| &w.moments);
        f.diagnosis.missing_moment.as_ref().map_or(Ok(None), |m| moment_figure::missing_moment(m, beside))
    }),
    ("residuals_before", |f, _| {
        let title = "The calibrated model misses here";
        residual_figure::map(title, &f.diagnosis.residuals_before, f.dataset).map(Some)
    }),
    ("residuals_after", |f, _| {
        let title = "The rest after the best explanation";
        let explained = !f.diagnosis.added.is_empty() || !f.diagnosis.attempt.is_empty();
        explained.then(|| residual_figure::map(title, &f.diagnosis.residuals_after, f.dataset)).transpose()
    }),
    ("ranking", |f, _| ranking(f.diagnosis)),
    ("before_after", |f, _| {
        let rungs = error_steps(f.diagnosis, f.scenario);
        let seen = rungs.iter().any(|r| r.training_mm >= SMALLEST_BAR_MM);
        seen.then(|| waterfall("Before and after", &rungs, f.diagnosis.base.noise_floor_mm)).transpose()
    }),
    ("before_after_supply", |f, _| supply(f.diagnosis)),
    ("candidates", |f, scenario| match f.diagnosis.is_quiet() || f.diagnosis.pressure_slip.is_some() {
        true => Ok(None),
        _ if scenario.is_spatial() || f.dataset.channels_differ() => Ok(None),
        false => candidate_curves(f.diagnosis, scenario, f.dataset),
    }),
    ("ledger", |f, scenario| {
        let d = f.diagnosis;
        let parts = !d.is_quiet() && !shown(d).is_empty();
        let at = figures::at_highest(f.dataset).filter(|_| parts);
        let cases = |loads: &Loads| ledger_cases(d, scenario, d.level(1e-3 * loads.body_pa));
        at.map(|(title, loads)| figures::ledgers(&title, &cases(&loads), &loads)).transpose()
    }),
    ("finite_elements", |f, _| {
        f.witness.filter(|w| w.fe_mj.is_some()).map(|w| witness_ledger(w, f.diagnosis)).transpose()
    }),
];

pub(crate) fn diagnosis_pictures() -> [&'static str; 9] {
    PICTURES.map(|(name, _)| name)
}

/// Adds the requested pictures that exist, their names after a prefix.
pub(super) fn draw(
    found: &Diagnosed,
    prefix: &str,
    wanted: &[&str],
    files: &mut Files,
    progress: &mut Progress,
) -> Result<()> {
    let (scenario, _) = fit_scenario(found.scenario, found.dataset, found.about)?;
    for (i, (name, picture)) in PICTURES.iter().filter(|(name, _)| wanted.contains(name)).enumerate() {
        progress("plots of the diagnosis", Some(i as f64 / wanted.len() as f64));
        if let Some(drawn) = picture(found, &scenario)? {
            files.plot(&format!("{prefix}{name}"), drawn);
        }
    }
    Ok(())
}

pub(super) fn verdict(found: &Diagnosed) -> Values {
    let d = found.diagnosis;
    let verdict = match d.verdict {
        Some(Verdict::None) => "none",
        Some(Verdict::Effect) => "effect",
        Some(Verdict::OutOfCatalog) if d.is_either() => "either",
        Some(Verdict::OutOfCatalog) => "out_of_catalog",
        None if d.pressure_slip.is_some() => "withheld",
        None => "no_answer",
    };
    let next = d.next_experiment.as_ref();
    let next = next.map(|next| Values::new().with("sentence", in_words(&next.sentence)).and(Values::of(next)));
    let summary = d.summary.iter().map(|s| in_words(s)).collect::<Vec<_>>();
    let d_in_words = Values::new().with("summary", summary).with("next_experiment", &next).and(Values::of(d));
    let answers = told(d).iter().map(|a| answer(d, a)).collect::<Vec<_>>();
    Values::new().with("verdict", verdict).with("answers", answers).with("d", d_in_words).with("typed", found.typed)
}

fn values(found: &Diagnosed) -> Values {
    let d = found.diagnosis;
    let worst = largest(&d.residuals_before, |cell| cell.y).zip(largest(&d.residuals_before, |cell| cell.x));
    let looks = match d.indistinguishable.is_empty() {
        true => [d.attempt_words(), "others"],
        false => ["fit equally well", "fits worse"],
    };
    Values::new()
        .with("title", format!("{} compared with {}: which effect is missing?", d.scenario, d.dataset))
        .with("lead", d.summary.iter().take(2).map(|s| in_words(s)).collect::<Vec<_>>().join(" "))
        .with("evidence", evidence(d))
        .with("worst", worst)
        .with("looks", looks)
        .with("more", &found.more)
        .with("left_out", left_out(d, &shown(d)).map_or(String::new(), |words| words + " "))
        .with("leftover", d.leftover.iter().map(|s| &s.sentence).collect::<Vec<_>>())
        .with("effects", tables::ranking(d).map(|(title, rows)| rows.page(title)))
        .with("pairs", (!d.pairs.is_empty()).then(|| tables::pairs(d).page("Pairs, refitted with B")))
        .with("marks", tables::MARKS)
        .with("unseen", tables::unseen(d).page(tables::UNSEEN))
        .with("experiments", tables::experiments(d).map(|(title, rows)| rows.page(&title)))
        .with("explained", explained(d))
        .with("map_colours", residual_figure::colours(found.dataset))
        .with("cautions", d.warnings.iter().filter(|w| !d.slips.contains(w)).collect::<Vec<_>>())
        .with("provenance", provenance(found))
        .and(verdict(found))
        .and(witness(found.witness))
}

/// What the verdict states, or the attempt; nothing where nothing is missing.
fn told(d: &Diagnosis) -> Vec<EffectAnswer<'_>> {
    let none = d.is_quiet() || d.pressure_slip.is_some();
    let answers = if none { Vec::new() } else { d.answers() };
    answers.into_iter().filter(|a| matches!(a.standing, Standing::Stated | Standing::Attempt)).collect()
}

/// An answer with the values of its fit and what it brings.
fn answer(d: &Diagnosis, answer: &EffectAnswer) -> Values {
    let values = answer.effects.iter().map(|(r, values)| match answer.effects.len() {
        1 => listed(values),
        _ => format!("{}, {}", super::effect(&r.effect), listed(values)),
    });
    let mark = if answer.standing == Standing::Attempt { format!(", {}", d.attempt_words()) } else { String::new() };
    let cancels = d.pairs.iter().any(|p| p.cancels && p.effects.join(" + ") == answer.name());
    let values = values.collect::<Vec<_>>().join("; ");
    Values::new()
        .with("name", answer.name())
        .with("mark", mark)
        .with("values", values)
        .with("after_mm", answer.after_mm)
        .with("cancels", cancels)
}

/// Every effect of the stated answers once. Notes of a single fit do not apply to a pair.
fn explained(d: &Diagnosis) -> Vec<Values> {
    let mut seen: Vec<&str> = Vec::new();
    let mut out = Vec::new();
    let answers = told(d);
    for answer in answers.iter().take(MOST_TOLD) {
        for (r, _) in &answer.effects {
            if !seen.contains(&r.effect.as_str()) {
                seen.push(&r.effect);
                let notes = if answer.effects.len() == 1 { r.notes.as_slice() } else { &[] };
                out.push(Values::new().with("notes", notes).and(Values::of(r)));
            }
        }
    }
    out
}

fn evidence(d: &Diagnosis) -> [[String; 2]; 8] {
    let p = |p: Option<f64>| p.map_or("–".into(), p_value);
    let mm = |v: f64| format!("{v:.2} mm");
    [
        ("\"nothing is missing\", corrected for everything tried", p(d.p_value)),
        ("level at which it is judged", d.alpha.to_string()),
        ("lack of fit after fitting B", p(d.lack_of_fit_before.as_ref().map(|l| l.p_value))),
        ("lack of fit of the final model", p(d.lack_of_fit_after.as_ref().map(|l| l.p_value))),
        ("error beyond noise after fitting B", mm(d.base.systematic_mm)),
        ("the same of the final model", mm(d.base.systematic_with_added_mm)),
        ("noise of the mean", d.base.noise_floor_mm.map_or("unknown".into(), mm)),
        ("good enough", mm(d.tolerance_mm)),
    ]
    .map(|(name, value)| [name.to_string(), value])
}

/// `+9.1 mm (12 times the noise) at marker 5 of 5, 10 kPa load`: the largest in one direction.
fn largest(map: &ResidualMap, of: fn(&ResidualCell) -> Deviation) -> Option<String> {
    let cells = map.cells.iter().enumerate();
    let all = cells.flat_map(|(m, row)| row.iter().enumerate().map(move |(h, cell)| (m, h, of(cell))));
    let (marker, hold, d) = all.max_by(|a, b| a.2.mm.abs().total_cmp(&b.2.mm.abs()))?;
    let (at, of_all) = (&map.holds[hold], map.cells.len());
    let noise = d.in_noise.map_or(String::new(), |z| format!(" ({:.0} times the noise)", z.abs()));
    let several = map.holds.iter().any(|h| h.p_body_kpa != at.p_body_kpa);
    let body = if several { format!(", body {:.0} kPa", at.p_body_kpa) } else { String::new() };
    let place = format!("at marker {} of {of_all}, {:.0} kPa {}{body}", marker + 1, at.p_act_kpa, at.phase);
    Some(format!("{:+.1} mm{noise} {place}", d.mm))
}

fn witness(witness: Option<&Witness>) -> Values {
    let Some(w) = witness else { return Values::new().with("witness", ()) };
    let sentences = w.sentences.iter().map(|s| in_words(s)).collect::<Vec<_>>();
    let captions = [
        "Outermost marker on first loading [mm]. Finite elements: the point of the wall where the marker sticks, on the side that a camera sees",
        "Ledgers from the first bend to the highest shared pressure [mJ]; apart: without hourglass control",
    ];
    let [heights, ledgers] = captions;
    let ledgers = tables::witness_ledgers(w).map(|table| table.page(ledgers));
    let shown = std::iter::once(tables::witness_heights(w).page(heights)).chain(ledgers);
    Values::new().with("witness", Values::new().with("sentences", sentences).with("tables", shown.collect::<Vec<_>>()))
}

fn provenance(found: &Diagnosed) -> Vec<[String; 2]> {
    let line = |name: &str, value: &str| [name.into(), value.into()];
    let mut lines = vec![
        line("scenario", found.typed[0]),
        line("data", found.typed[1]),
        line("runs", &found.diagnosis.runs.to_string()),
    ];
    lines.extend(found.diagnosis.beside.iter().map(|b| line("fitted along", &b.dataset)));
    if let Some(about) = found.about {
        lines.push(line("data are", &format!("{}: {}", about.provenance.word(), about.title)));
        lines.push(line("source", &about.source));
    }
    lines
}
