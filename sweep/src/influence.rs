//! What a table shows: how far each key moves an output, and a map over two keys.

use crate::study::{Engine, Study};
use compare::wording::value;
use data::table::{Column, Table};

/// Groups of a key that has more values.
const MOST_GROUPS: usize = 10;

/// Means of an output over groups of a key's values, all other keys as they come.
#[derive(Debug, Clone, PartialEq)]
pub struct Influence {
    /// Key that the groups belong to, as in the study.
    pub key: String,
    /// Name of every group, and the mean of the output in it; rising values of the key.
    pub groups: Vec<(String, f64)>,
}

impl Influence {
    /// Lowest and highest mean of the output over all groups.
    pub fn range(&self) -> [f64; 2] {
        let all = || self.groups.iter().map(|group| group.1);
        [all().fold(f64::INFINITY, f64::min), all().fold(f64::NEG_INFINITY, f64::max)]
    }

    fn span(&self) -> f64 {
        self.range()[1] - self.range()[0]
    }
}

/// Means of an output over groups of two keys.
#[derive(Debug, Clone, PartialEq)]
pub struct SweepMap {
    /// Keys whose groups are the rows and the columns.
    pub keys: [String; 2],
    /// Names of the groups of each.
    pub names: [Vec<String>; 2],
    /// Row by row; NaN without a case.
    pub means: Vec<Vec<f64>>,
}

/// The keys of a study by how far they move an output of an engine, the furthest first. Failed cases are left out.
pub fn influences(study: &Study, table: &Table, engine: Engine, output: &str) -> Vec<Influence> {
    let Some(rows) = SolvedCase::of(table, engine, output) else { return Vec::new() };
    let of = |key: String| {
        let grouped = rows.grouped(table, &key)?;
        let mean = |g: usize| rows.mean(|i| grouped.of_row[i] == g);
        let groups = grouped.names.iter().enumerate().map(|(g, name)| (name.clone(), mean(g))).collect();
        Some(Influence { key, groups }).filter(|found| found.groups.len() > 1)
    };
    let mut found: Vec<Influence> = study.keys().filter_map(of).collect();
    found.sort_by(|a, b| b.span().total_cmp(&a.span()));
    found
}

/// An output of the cases that both engines have: reduced model and finite elements.
pub fn pairs(table: &Table, output: &str) -> Vec<[f64; 2]> {
    let Some(Column::I64(cases)) = column(table, "case") else { return Vec::new() };
    let of = |engine| {
        let rows = SolvedCase::of(table, engine, output);
        rows.map_or(Vec::new(), |rows| rows.rows.into_iter().map(|i| cases[i]).zip(rows.values).collect())
    };
    let reduced: std::collections::BTreeMap<i64, f64> = of(Engine::Reduced).into_iter().collect();
    let both = |(case, fe): (i64, f64)| Some([*reduced.get(&case)?, fe]);
    of(Engine::Elements).into_iter().filter_map(both).collect()
}

/// Means of an output over groups of two keys; `None` if a key or output is not in the table.
pub fn map(table: &Table, engine: Engine, output: &str, keys: [&str; 2]) -> Option<SweepMap> {
    let rows = SolvedCase::of(table, engine, output)?;
    let [down, across] = [rows.grouped(table, keys[0])?, rows.grouped(table, keys[1])?];
    let mean = |r: usize, c: usize| rows.mean(|i| down.of_row[i] == r && across.of_row[i] == c);
    let means = (0..down.names.len()).map(|r| (0..across.names.len()).map(|c| mean(r, c)).collect()).collect();
    Some(SweepMap { keys: keys.map(String::from), names: [down.names, across.names], means })
}

struct SolvedCase {
    rows: Vec<usize>,
    values: Vec<f64>,
}

struct Grouped {
    names: Vec<String>,
    of_row: Vec<usize>,
}

fn column<'t>(table: &'t Table, name: &str) -> Option<&'t Column> {
    table.columns.iter().find(|column| column.0 == name).map(|column| &column.1)
}

impl SolvedCase {
    fn of(table: &Table, engine: Engine, output: &str) -> Option<SolvedCase> {
        let (Column::Str(engines), Column::F64(all)) = (column(table, "engine")?, column(table, output)?) else {
            return None;
        };
        let rows: Vec<usize> = (0..all.len()).filter(|i| engines[*i] == engine.word() && all[*i].is_finite()).collect();
        let values = rows.iter().map(|i| all[*i]).collect();
        Some(SolvedCase { rows, values })
    }

    /// A group for each value, or groups of equally many cases if there are more values.
    fn grouped(&self, table: &Table, key: &str) -> Option<Grouped> {
        let numbers = match column(table, key)? {
            Column::F64(all) => self.rows.iter().map(|i| all[*i]).collect::<Vec<f64>>(),
            Column::I64(all) => self.rows.iter().map(|i| all[*i] as f64).collect(),
            Column::Bool(all) => self.rows.iter().map(|i| all[*i].map_or(f64::NAN, f64::from)).collect(),
            Column::Str(all) => {
                let mut names: Vec<String> = self.rows.iter().map(|i| all[*i].clone()).collect();
                names.sort_unstable();
                names.dedup();
                let place = |i: &usize| names.binary_search(&all[*i]).unwrap_or(0);
                return Some(Grouped { of_row: self.rows.iter().map(place).collect(), names });
            }
        };
        let mut sorted = numbers.clone();
        sorted.sort_by(f64::total_cmp);
        let mut levels = sorted.clone();
        levels.dedup();
        let is_few = levels.len() <= MOST_GROUPS;
        let starts: Vec<f64> = match is_few {
            true => levels,
            false => {
                let mut starts: Vec<f64> = (0..MOST_GROUPS).map(|g| sorted[g * sorted.len() / MOST_GROUPS]).collect();
                starts.dedup();
                starts
            }
        };
        let of_row = numbers.iter().map(|x| starts.partition_point(|start| start <= x).max(1) - 1).collect();
        let last = sorted.last().copied().unwrap_or(0.0);
        let end = |g: usize| starts.get(g + 1).copied().unwrap_or(last);
        let name = |(g, start): (usize, &f64)| match is_few {
            true => value(*start),
            false => format!("{} to {}", value(*start), value(end(g))),
        };
        Some(Grouped { names: starts.iter().enumerate().map(name).collect(), of_row })
    }

    fn mean(&self, wanted: impl Fn(usize) -> bool) -> f64 {
        let own = self.values.iter().enumerate().filter(|(i, _)| wanted(*i)).map(|pair| pair.1);
        let (sum, count) = own.fold((0.0, 0.0), |(sum, count), value| (sum + value, count + 1.0));
        sum / count
    }
}
