//! Columns of pressures that were written wrongly, ten kinds on each robot, and placeholders where markers were lost; without any
//! hidden effect.

use super::outcome::{Diagnoser, about};
use super::row::{Goal, Rate};
use crate::truth::{ROBOTS, standard_protocol};
use crate::{Draw, Truth};
use compare::Evidence;
use compare::diagnosis::Options;
use compare::error::CompareError;
use data::{Dataset, Hold};
use serde::{Deserialize, Serialize};

type Spoil = fn(&mut Hold);

/// The kinds, by the content of the column of kilopascals of gauge pressure.
const KINDS: [(&str, Spoil); 10] = [
    ("p_act in psi", |hold| hold.p_act_pa /= 6.894_757),
    ("p_act in mbar", |hold| hold.p_act_pa *= 10.0),
    ("p_act in inches of water", |hold| hold.p_act_pa /= 0.249_089),
    ("p_act in bar", |hold| hold.p_act_pa /= 100.0),
    ("p_act absolute", |hold| hold.p_act_pa += 101_325.0),
    ("p_body in psi", |hold| hold.p_body_pa /= 6.894_757),
    ("p_body in mbar", |hold| hold.p_body_pa *= 10.0),
    ("p_body in inches of water", |hold| hold.p_body_pa /= 0.249_089),
    ("p_body absolute", |hold| hold.p_body_pa += 101_325.0),
    ("exchanged", |hold| std::mem::swap(&mut hold.p_act_pa, &mut hold.p_body_pa)),
];

/// What programs write for x and y of a marker that was not seen.
const PLACEHOLDERS: [(&str, &str); 4] =
    [("0, 0", "0,0"), ("-1, -1", "-1,-1"), ("9999, 9999", "9999,9999"), ("a corner of the picture", "613.25,-207.5")];

/// Sets of a round: every kind on every robot.
const SETS: usize = (KINDS.len() + PLACEHOLDERS.len()) * ROBOTS.len();
/// Keeps their streams apart from the streams of the other parts.
const STREAM: u64 = 100 << 32;

/// A set with a wrong column or placeholders, and the diagnosis of it.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct SlippedSet {
    /// What the table has in place of the right numbers.
    pub kind: String,
    /// It is of a column of pressures, else a placeholder.
    pub is_column: bool,
    /// Robot, noise and runs before the table was spoiled.
    pub truth: Truth,
    /// The diagnosis reported it as a slip of the pressures.
    pub told: bool,
    /// The warning or the refusal in words; `None` without one.
    pub words: Option<String>,
    /// Effects that the verdict adds to the model.
    pub named: Vec<String>,
}

/// Sets of a bench, a round for every hundred of its sets.
pub(super) fn count(sets: usize) -> usize {
    SETS * sets.div_ceil(100)
}

/// Makes, spoils and diagnoses a set; `Err` gives the reason for a failure.
pub(super) fn slipped(seed: u64, index: usize, diagnose: Diagnoser) -> Result<SlippedSet, String> {
    let kind = index / ROBOTS.len() % (SETS / ROBOTS.len());
    let name = KINDS.get(kind).map_or_else(|| PLACEHOLDERS[kind - KINDS.len()].0, |(name, _)| name);
    one(seed, index, kind, diagnose, name).map_err(|error| format!("{name}: {error}"))
}

/// A refusal that names the column is an answer too.
fn one(seed: u64, index: usize, kind: usize, diagnose: Diagnoser, name: &str) -> Result<SlippedSet, CompareError> {
    let truth = Truth::draw(ROBOTS[index % ROBOTS.len()].0, &mut Draw::new(seed, STREAM + index as u64))?;
    let mut data = truth.dataset("slipped", &standard_protocol())?;
    let is_column = kind < KINDS.len();
    match KINDS.get(kind) {
        Some((_, spoil)) => data.holds.iter_mut().for_each(spoil),
        None => data = read_with(&data, PLACEHOLDERS[kind - KINDS.len()].1)?,
    }
    let words = (!is_column).then(|| data::losses(&data).join(" ")).filter(|words| words.contains("taken as not seen"));
    let options = Options::default().without_advice();
    let evidence = [Evidence::of(data, Some(about(&truth)?))];
    let (words, named) = match diagnose(&truth.told()?, &evidence, &options, &mut |_, _| ()) {
        Ok(found) => {
            let named = found.added.into_iter().map(|added| added.effect).collect();
            (words.or(found.pressure_slip.map(|slip| slip.words)), named)
        }
        Err(CompareError::Refused { message, .. }) => (Some(message), Vec::new()),
        Err(error) => return Err(error),
    };
    Ok(SlippedSet { kind: name.into(), is_column, truth, told: words.is_some(), words, named })
}

/// The data as they are read from a table in which one marker in twenty has the placeholder for a hold.
fn read_with(right: &Dataset, placeholder: &str) -> Result<Dataset, CompareError> {
    let mut table = Vec::new();
    data::write_markers_csv(right, &mut table)?;
    let text = String::from_utf8_lossy(&table);
    let mut lines = text.lines();
    let header: Vec<&str> = lines.next().unwrap_or_default().split(',').collect();
    let at = |name: &str| header.iter().position(|column| *column == name).unwrap_or(0);
    let [run, pressure, marker, x] = ["run", "p_act_kpa", "marker", "x_mm"].map(at);
    let spoiled = |line: &str| {
        let mut cells: Vec<&str> = line.split(',').collect();
        let number = |cell: usize| cells[cell].parse::<f64>().unwrap_or(0.0) as usize;
        let is_lost = (7 * number(run) + 3 * number(marker) + number(pressure) / 10).is_multiple_of(20);
        if is_lost {
            cells.splice(x..x + 2, [placeholder]);
        }
        cells.join(",") + "\n"
    };
    let table: String = std::iter::once(header.join(",") + "\n").chain(lines.map(spoiled)).collect();
    Ok(data::parse_markers("slipped.csv", &mut table.as_bytes(), data::ReadOptions::default(), &mut |_, _| ())?)
}

pub(super) fn rows(sets: &[SlippedSet]) -> Vec<Rate> {
    let (columns, placeholders): (Vec<&SlippedSet>, Vec<&SlippedSet>) = sets.iter().partition(|set| set.is_column);
    let of = |case, reported, named_at_most: f64, sets: &[&SlippedSet]| {
        let share = |figure, target, hit: fn(&SlippedSet) -> bool| {
            Rate::share(case, figure, target, &sets.iter().map(|set| hit(set)).collect::<Vec<_>>())
        };
        let named = share("an effect named", Goal::AtMost(named_at_most), |set| !set.named.is_empty());
        [share(reported, Goal::AtLeast(0.9), |set| set.told), named]
    };
    let columns = of("a column of pressures written wrongly", "reported as a slip", 0.0, &columns);
    [columns, of("placeholders for lost markers", "reported as not seen", 0.05, &placeholders)].concat()
}
