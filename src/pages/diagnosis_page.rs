//! The report of a diagnosis, for people: where it fails, whether anything is missing, what it could be, what to do.

use super::PageError;
use super::diagnosis_figures::{
    candidate_curves, ledger_cases, left_out, ranking, shown, supply, waterfall, witness_ledger,
};
use super::diagnosis_words::{candidate_blocks, pairs_table, ranking_table, three};
use super::tables::{column, number, words};
use super::{Files, Imprint, figures, residual_figure};
use compare::diagnosis::{Diagnosis, Verdict};
use compare::residuals::{Deviation, ResidualCell, ResidualMap};
use compare::study::engines::TERMS;
use compare::study::predict::fit_scenario;
use compare::study::witness::{HEIGHTS, Witness};
use compare::wording::p_value;
use data::{About, Dataset};
use models::Scenario;
use report::Drawn;
use report::page::{Block, Callout, Provenance, Report, Section, Table};

const RANKING: &str = "Effects added and refitted together with B. A bar is a gain: how much the sum of squared differences falls, each \
    weighted by its noise. The error in mm (table) weighs all differences alike and may rise where the gain is small or quiet holds \
    are met at the cost of others. Green: cannot be told apart with these data.";
const BEFORE_AFTER: &str = "Left-out data were not in the fit of the value drawn. A fall there is worth more than one on the data of the \
    fit, and neither proves the name.";
const SUPPLY: &str = "What the supply's laws say of the pressure at the actuator against what the gauge read. Positions are predicted at \
    the readings, so that their error says nothing of the supply.";
/// Errors below this are no bar \[mm\].
const SMALLEST_BAR_MM: f64 = 0.005;

/// Pictures that a report of a diagnosis may have, without prefix and ending.
pub const DIAGNOSIS_PICTURES: [&str; 8] = [
    "residuals_before",
    "residuals_after",
    "ranking",
    "before_after",
    "before_after_supply",
    "candidates",
    "ledger",
    "finite_elements",
];

/// A diagnosis with what it was made of.
pub struct Diagnosed<'a> {
    /// What was found.
    pub diagnosis: &'a Diagnosis,
    /// The scenario as given.
    pub scenario: &'a Scenario,
    /// The data.
    pub dataset: &'a Dataset,
    /// Their description.
    pub about: Option<&'a About>,
    /// Finite element runs of the same robot, if there are any.
    pub witness: Option<&'a Witness>,
    /// Scenario and data as typed, for the commands that come next.
    pub typed: [&'a str; 2],
    /// What else was typed that these commands need, e.g. `--also MORE`; empty for nothing.
    pub more: String,
}

/// The page of a diagnosis and its plots.
///
/// # Errors
/// What cannot be drawn.
pub fn diagnosis_page(found: &Diagnosed, imprint: &Imprint) -> Result<Files, PageError> {
    let d = found.diagnosis;
    let mut files = Files::default();
    let sections = diagnosis_sections(found, "", &mut files)?;
    let report = Report {
        title: format!("{} held against {}: what is missing?", d.scenario, d.dataset),
        lead: lead(d),
        generated_by: imprint.program.clone(),
        generated_on: imprint.date.clone(),
        sections,
        provenance: provenance(found),
    };
    files.report(&report)?;
    Ok(files)
}

/// The sections of a diagnosis; `prefix` keeps anchors and file names apart where a page has more than one.
///
/// # Errors
/// What cannot be drawn.
pub fn diagnosis_sections(found: &Diagnosed, prefix: &str, files: &mut Files) -> Result<Vec<Section>, PageError> {
    let d = found.diagnosis;
    let (scenario, _) = fit_scenario(found.scenario, found.dataset, found.about)?;
    let mut keep = |name: &str, caption: &str, drawn: Drawn| -> Block {
        files.plot(&format!("{prefix}{name}"), &drawn);
        Block::Figure { caption: caption.into(), alt: caption.into(), svg: drawn.svg }
    };
    let before = residual_figure::map("The calibrated model misses here", &d.residuals_before, found.dataset)?;
    let after = residual_figure::map("What is left with the best explanation", &d.residuals_after, found.dataset)?;
    let mut fails = vec![
        Block::Paragraph(worst(&d.residuals_before)),
        keep(
            "residuals_before",
            &format!("Residuals after fitting B, marker × hold. {}", residual_figure::MAP_COLOURS),
            before,
        ),
    ];
    let nothing_added = d.added.is_empty() && d.attempt.is_empty();
    if !nothing_added {
        fails.push(keep(
            "residuals_after",
            "The same with the best explanation: on this scale noise stays within ±3.",
            after,
        ));
    }
    fails.push(Block::List(d.leftover.iter().map(|s| s.sentence.clone()).collect()));
    let mut bars: Vec<Block> = Vec::new();
    if let Some(drawn) = ranking(d)? {
        bars.push(keep("ranking", RANKING, drawn));
    }
    bars.push(ranking_table(d));
    bars.extend(pairs_table(d));
    let mut fall: Vec<Block> = Vec::new();
    if let Some(drawn) = supply(d)? {
        fall.push(keep("before_after_supply", SUPPLY, drawn));
    }
    let rungs = d.rungs();
    if rungs.iter().any(|r| r.training_mm >= SMALLEST_BAR_MM) {
        let drawn = waterfall("Before and after", &rungs, d.base.noise_floor_mm)?;
        fall.push(keep("before_after", BEFORE_AFTER, drawn));
    } else {
        fall.push(Block::Paragraph("Positions are met to within noise, before and after.".into()));
    }
    let mut sections = vec![
        section(prefix, "missing", "Is anything missing?", verdict_blocks(d)),
        section(prefix, "where", "Where it fails", fails),
        section(prefix, "ranking", "What it could be", bars),
        section(prefix, "candidates", "The candidates in plain words", candidate_blocks(d)),
        section(prefix, "before-after", "Before and after", fall),
    ];
    if d.verdict != Some(Verdict::None) {
        sections.extend(differently(found, &scenario, prefix, files)?);
    }
    if let Some(witness) = found.witness {
        let blocks = witness_blocks((witness, d), prefix, files)?;
        sections.push(section(prefix, "finite-elements", "The same robot in finite elements", blocks));
    }
    sections.push(section(prefix, "unseen", "What could not be seen", unseen_blocks(d)));
    sections.push(section(prefix, "next", "What to do next", next_blocks(found)));
    sections.push(section(prefix, "noise", "Noise and cautions", noise_blocks(d)));
    Ok(sections)
}

pub(super) fn section(prefix: &str, id: &str, heading: &str, blocks: Vec<Block>) -> Section {
    let id = format!("{}{id}", prefix.replace('_', "-"));
    Section { id, heading: heading.into(), blocks }
}

fn lead(d: &Diagnosis) -> String {
    d.summary.iter().take(3).cloned().collect::<Vec<_>>().join(" ")
}

fn verdict_blocks(d: &Diagnosis) -> Vec<Block> {
    let answer = match d.verdict {
        Some(Verdict::None) => "**No**: no missing effect is detectable in these data.",
        Some(Verdict::Effect) => "**Yes**: an effect is missing, and the catalogue has an explanation.",
        Some(Verdict::OutOfCatalog) if d.is_either() => {
            "**Yes**: something is missing, a fault that is not in the catalogue or effects that explain the data about as well."
        }
        Some(Verdict::OutOfCatalog) => "**Yes**: something is missing, and nothing in the catalogue explains it.",
        None => "**No answer**: too few runs for p-values. What follows is a ranking, not a test.",
    };
    let p = |p: Option<f64>| p.map_or("–".into(), p_value);
    let row = |name: &str, value: String| vec![name.to_string(), value];
    let rows = vec![
        row("\"nothing is missing\", corrected for everything tried", p(d.p_value)),
        row("level at which it is judged", format!("{}", d.alpha)),
        row("lack of fit after fitting B", p(d.lack_of_fit_before.map(|l| l.p_value))),
        row("lack of fit of the final model", p(d.lack_of_fit_after.map(|l| l.p_value))),
        row("error beyond noise after fitting B", format!("{:.2} mm", d.base.systematic_mm)),
        row("the same of the final model", format!("{:.2} mm", d.base.systematic_with_added_mm)),
        row("noise of the mean", d.base.noise_floor_mm.map_or("unknown".into(), |n| format!("{n:.2} mm"))),
        row("good enough", format!("{:.2} mm", d.tolerance_mm)),
    ];
    let evidence = Table {
        caption: "Evidence".into(),
        columns: vec![words("quantity"), column("value", "")],
        rows,
        how_column: None,
    };
    let slip = |slip: &String| Block::Callout {
        kind: Callout::Warning,
        text: format!("Before the verdict, look at the data. {slip}"),
    };
    let mut blocks: Vec<Block> = d.slips.iter().map(slip).collect();
    blocks.extend([
        Block::Callout { kind: Callout::Result, text: answer.into() },
        Block::List(d.summary.clone()),
        Block::Table(evidence),
    ]);
    blocks
}

/// The largest residuals in words.
fn worst(map: &ResidualMap) -> String {
    match (largest(map, |cell| cell.y), largest(map, |cell| cell.x)) {
        (Some(y), Some(x)) => format!("Largest, model minus measured: across the robot {y}; along it {x}."),
        _ => "There is no residual to show.".into(),
    }
}

/// `+9.1 mm (12 times the noise) at marker 5 of 5, 10 kPa load`: the largest in one direction.
fn largest(map: &ResidualMap, of: fn(&ResidualCell) -> Deviation) -> Option<String> {
    let cells = map.cells.iter().enumerate();
    let all = cells.flat_map(|(m, row)| row.iter().enumerate().map(move |(h, cell)| (m, h, of(cell))));
    let (marker, hold, d) = all.max_by(|a, b| a.2.mm.abs().total_cmp(&b.2.mm.abs()))?;
    let at = &map.holds[hold];
    let noise = d.in_noise.map_or(String::new(), |z| format!(" ({:.0} times the noise)", z.abs()));
    let several = map.holds.iter().any(|h| h.p_body_kpa != at.p_body_kpa);
    let body = if several { format!(", body {:.0} kPa", at.p_body_kpa) } else { String::new() };
    let of_all = map.cells.len();
    Some(format!(
        "{:+.1} mm{noise} at marker {} of {of_all}, {:.0} kPa {}{body}",
        d.mm,
        marker + 1,
        at.p_act_kpa,
        at.phase
    ))
}

fn differently(
    found: &Diagnosed,
    scenario: &Scenario,
    prefix: &str,
    files: &mut Files,
) -> Result<Option<Section>, PageError> {
    let d = found.diagnosis;
    let Some(curves) = candidate_curves(d, scenario, found.dataset)? else { return Ok(None) };
    files.plot(&format!("{prefix}candidates"), &curves);
    let drawn = shown(d);
    let [solid, dashed] = match d.indistinguishable.is_empty() {
        true => [d.attempt_words(), "others"],
        false => ["cannot be told apart", "fits worse"],
    };
    let caption = format!(
        "First loading at the first body pressure, to 1.3 times the highest one measured. Solid: {solid}; dashed: {dashed}. {}Effects \
         with history also differ on the way down.",
        left_out(d, &drawn).map_or(String::new(), |words| words + " ")
    );
    let mut blocks =
        vec![Block::Figure { caption, alt: "curves of the candidates over pressure".into(), svg: curves.svg }];
    if let Some((title, loads)) = figures::at_highest(found.dataset) {
        let level = d.level(1e-3 * loads.body_pa);
        let ledger = figures::ledgers(&title, &ledger_cases(d, scenario, level), &loads)?;
        files.plot(&format!("{prefix}ledger"), &ledger);
        let caption = "Where each candidate lets the actuator's work go, in the order of the curves above.";
        blocks.push(Block::Figure { caption: caption.into(), alt: "stacked energies".into(), svg: ledger.svg });
    }
    Ok(Some(section(prefix, "differently", "What they would predict differently", blocks)))
}

fn witness_blocks((w, d): (&Witness, &Diagnosis), prefix: &str, files: &mut Files) -> Result<Vec<Block>, PageError> {
    let rows = w.height_rows();
    let mut columns = vec![column(HEIGHTS[0], "")];
    columns.extend(HEIGHTS[1..].iter().map(|h| column(h, "mm")));
    let caption = "Outermost marker on first loading. Finite elements: the point of the wall where the marker sticks, on the side that a \
                   camera sees; the middle of that section may be elsewhere".to_string();
    let mut blocks =
        vec![Block::List(w.sentences.clone()), Block::Table(Table { caption, columns, rows, how_column: None })];
    if w.fe_mj.is_some() {
        let ledger = witness_ledger(w, d)?;
        files.plot(&format!("{prefix}finite_elements"), &ledger);
        let caption = "The work of the gas and where it went, at the bends of the finite elements: the base, what cannot be told apart, then \
                       the nearest others. Models that bend alike may spend it differently.";
        blocks.push(Block::Figure { caption: caption.into(), alt: "stacked energies".into(), svg: ledger.svg });
        let mut columns = vec![words("model")];
        columns.extend(TERMS.iter().map(|t| column(t, "mJ")));
        columns.push(column("apart", "mJ"));
        let caption =
            "Ledgers from the first bend to the highest shared pressure; apart: without hourglass control".into();
        blocks.push(Block::Table(Table { caption, columns, rows: w.ledger_rows(), how_column: None }));
    }
    Ok(blocks)
}

fn unseen_blocks(d: &Diagnosis) -> Vec<Block> {
    let rows = d.undetectable.iter().map(|u| {
        let size = u.smallest_detectable.map_or("not within its bounds".into(), |s| {
            if u.unit == "-" { three(s) } else { format!("{} {}", three(s), u.unit) }
        });
        vec![u.effect.clone(), size, number(u.times_typical, 2)]
    });
    let table = Table {
        caption: "Effects that were not found, and the smallest size that would have been seen in nine of ten such experiments".into(),
        columns: vec![words("effect"), column("size", ""), column("times typical", "")],
        rows: rows.collect(),
        how_column: None,
    };
    let mut blocks = vec![Block::Table(table)];
    if !d.limits.is_empty() {
        blocks.push(Block::List(d.limits.clone()));
    }
    blocks
}

fn next_blocks(found: &Diagnosed) -> Vec<Block> {
    let d = found.diagnosis;
    let mut blocks = Vec::new();
    if let Some(next) = &d.next_experiment {
        blocks.push(Block::Callout { kind: Callout::Result, text: next.sentence.clone() });
    }
    if let Some(next) = d.next_experiment.as_ref().filter(|next| !next.tried.is_empty()) {
        let mut columns = vec![words("experiment"), words("protocol [kPa]"), column("suffices", "")];
        columns.extend(next.now.iter().map(|s| column(&s.rival, "")));
        let cells = |separations: &[compare::diagnosis::Separation]| -> Vec<String> {
            separations.iter().map(|s| format!("{:.1}", s.lambda)).collect()
        };
        let row = |name: String, protocol: String, needed: f64, found: &[compare::diagnosis::Separation]| {
            [vec![name, protocol, format!("{needed:.0}")], cells(found)].concat()
        };
        let mut rows = vec![row("data at hand".into(), "–".into(), next.needed_now, &next.now)];
        rows.extend(
            next.tried.iter().map(|e| row(e.name.clone(), e.shown_protocol().to_string(), e.needed, &e.separations)),
        );
        let caption = format!("Expected separation λ of {} from its rivals, and what suffices", next.best);
        blocks.push(Block::Table(Table { caption, columns, rows, how_column: None }));
    }
    let ([scenario, data], more) = (found.typed, &found.more);
    let commands = match d.verdict {
        Some(Verdict::Effect) => format!(
            "ibr add {scenario} best {data}{more}     # writes a new scenario\nibr ladder {scenario} {data}{more}       # until what is left is noise\nibr validate NEW OTHER_DATA    # the strongest evidence: data it was not fitted to"
        ),
        Some(Verdict::None) => "ibr diagnose SCENARIO OTHER_DATA   # another pressure, size or body pressure".into(),
        _ => format!("ibr data check {data}"),
    };
    blocks.push(Block::Code(commands));
    blocks
}

fn noise_blocks(d: &Diagnosis) -> Vec<Block> {
    let mut blocks = vec![Block::Paragraph(d.noise.sentence.clone())];
    let left = d.warnings.iter().filter(|warning| !d.slips.contains(warning));
    blocks.extend(left.map(|w| Block::Callout { kind: Callout::Warning, text: w.clone() }));
    blocks
}

pub(super) fn line(name: &str, value: &str) -> Provenance {
    Provenance { name: name.into(), value: value.into() }
}

fn provenance(found: &Diagnosed) -> Vec<Provenance> {
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
