//! The table of a sweep: a row per case and engine.

use crate::SweepError;
use crate::axis::as_number;
use crate::columns::{CPU_S, TRUSTED, columns};
use crate::part::{Rows, StudyPart, parts};
use crate::study::{Engine, PRESSURE, Study};
use data::table::{Column, Table};
use std::path::Path;
use toml::Value;

/// Names of all columns of the table.
///
/// ```
/// let text = "kind = \"sweep\"\nscenario = \"epam\"\noutputs = [\"tip\"]\n[[vary]]\nkey = \"pressure_kpa\"\nvalues = [10, 20]\n";
/// let study = sweep::Study::parse("study.toml", text, "".as_ref(), compare::ScenarioFile::read).unwrap();
/// assert!(sweep::names(&study).contains(&"tip_y_mm".to_string()));
/// ```
pub fn names(study: &Study) -> Vec<String> {
    let first = ["case", "engine"].into_iter().map(String::from);
    let last = ["status", "reason"].into_iter().map(String::from);
    first.chain(study.keys()).chain(columns(study)).chain(last).collect()
}

/// The table of the parts in a folder: of all, or `so_far` of those that are there.
///
/// # Errors
/// [`SweepError::Missing`], so far if none is there; a part whose file is damaged.
pub fn collect(study: &Study, folder: &Path, so_far: bool) -> Result<Table, SweepError> {
    let found = columns(study);
    let width = found.len();
    let all = parts(study);
    let read = |part: &StudyPart| Rows::read(&part.path(study, folder), part.cases.len() * width);
    let rows: Vec<Option<Rows>> = all.iter().map(read).collect::<Result<_, _>>()?;
    let missing = rows.iter().filter(|rows| rows.is_none()).count();
    if missing > 0 && !(so_far && missing < all.len()) {
        return Err(SweepError::Missing(missing));
    }
    let per_robot = study.per_robot();
    let end = all.iter().map(|part| part.cases.end).max().unwrap_or(0);
    let values: Vec<Vec<Value>> = (0..end.div_ceil(per_robot)).map(|robot| study.values(robot)).collect();
    // Every case: its part, the rows of that, and which of them is its own.
    let cases: Vec<(&StudyPart, &Rows, usize, usize)> = all
        .iter()
        .zip(&rows)
        .filter_map(|(part, rows)| Some((part, rows.as_ref()?)))
        .flat_map(|(part, rows)| part.cases.clone().enumerate().map(move |(i, case)| (part, rows, i, case)))
        .collect();
    let place = |name: &str| found.iter().position(|known| known == name);
    let (timed, judged) = (place(CPU_S), place(TRUSTED));
    let number = |k: usize| {
        let of = |(part, rows, i, _): &(&StudyPart, &Rows, usize, usize)| match timed == Some(k) {
            true if part.engine == Engine::Reduced => rows.cpu_s / part.cases.len() as f64,
            _ => rows.numbers[i * width + k],
        };
        let numbers = cases.iter().map(of);
        match judged == Some(k) {
            true => Column::Bool(numbers.map(|v| (!v.is_nan()).then_some(v != 0.0)).collect()),
            false => Column::F64(numbers.collect()),
        }
    };
    let own = study.axes.iter().position(|axis| axis.key == PRESSURE);
    let pressure = |case: usize| {
        let common = study.pressures_kpa.get(case % per_robot).copied();
        common.or_else(|| as_number(&values[case / per_robot][own?])).unwrap_or(f64::NAN)
    };
    let of = |axis: usize| column(cases.iter().map(|c| values[c.3 / per_robot][axis].clone()).collect());
    let why = |(_, rows, i, _): &(&StudyPart, &Rows, usize, usize)| {
        let failed = rows.failed.binary_search_by_key(i, |failed| failed.0);
        failed.ok().map(|at| rows.failed[at].1.replace('\n', " "))
    };
    let reasons: Vec<Option<String>> = cases.iter().map(why).collect();
    let status = |why: &Option<String>| why.as_ref().map_or("ok", |_| "failed").to_string();
    let columns = [
        Column::I64(cases.iter().map(|c| c.3 as i64 + 1).collect()),
        Column::Str(cases.iter().map(|c| c.0.engine.word().into()).collect()),
    ]
    .into_iter()
    .chain((0..study.axes.len()).filter(|axis| Some(*axis) != own).map(of))
    .chain((!study.has_channels()).then(|| Column::F64(cases.iter().map(|c| pressure(c.3)).collect())))
    .chain((0..width).map(number))
    .chain([Column::Str(reasons.iter().map(status).collect())])
    .chain([Column::Str(reasons.iter().map(|why| why.clone().unwrap_or_default()).collect())]);
    Ok(Table { columns: names(study).into_iter().zip(columns).collect() })
}

/// Numbers if all are, else texts.
fn column(values: Vec<Value>) -> Column {
    match values.iter().map(as_number).collect() {
        Some(numbers) => Column::F64(numbers),
        None => {
            let text = |v: Value| v.as_str().map_or_else(|| v.to_string(), String::from);
            Column::Str(values.into_iter().map(text).collect())
        }
    }
}
