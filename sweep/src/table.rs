//! The table of a sweep: a row per case and engine.

use crate::SweepError;
use crate::axis::as_number;
use crate::columns::{CPU_S, columns};
use crate::part::{Part, Rows, parts};
use crate::study::{PRESSURE, Study};
use data::table::{Column, Table};
use std::path::Path;
use toml::Value;

/// Names of all columns of the table.
pub fn names(study: &Study) -> Vec<String> {
    let first = ["case", "engine"].into_iter().map(String::from);
    let last = ["status", "reason"].into_iter().map(String::from);
    first.chain(study.keys()).chain(columns(study)).chain(last).collect()
}

/// The table of the parts in a folder.
///
/// # Errors
/// [`SweepError::Missing`]; a part whose file is damaged.
pub fn collect(study: &Study, folder: &Path) -> Result<Table, SweepError> {
    let width = columns(study).len();
    let all = parts(study);
    let read = |part: &Part| Rows::read(&part.path(study, folder), part.cases.len() * width);
    let rows: Vec<Option<Rows>> = all.iter().map(read).collect::<Result<_, _>>()?;
    let missing = rows.iter().filter(|rows| rows.is_none()).count();
    if missing > 0 {
        return Err(SweepError::Missing(missing));
    }
    let mut building = Building::new(study);
    all.iter().zip(rows.iter().flatten()).for_each(|(part, rows)| building.add(study, part, rows));
    Ok(building.table(study))
}

struct Building {
    case: Vec<i64>,
    engine: Vec<String>,
    inputs: Vec<Vec<Value>>,
    pressure: Vec<f64>,
    numbers: Vec<Vec<f64>>,
    /// Which of the columns of numbers is that of processor time.
    timed: Option<usize>,
    status: Vec<String>,
    reason: Vec<String>,
}

impl Building {
    fn new(study: &Study) -> Building {
        Building {
            case: Vec::new(),
            engine: Vec::new(),
            inputs: vec![Vec::new(); study.axes.len()],
            pressure: Vec::new(),
            numbers: vec![Vec::new(); columns(study).len()],
            timed: columns(study).iter().position(|name| name == CPU_S),
            status: Vec::new(),
            reason: Vec::new(),
        }
    }

    fn add(&mut self, study: &Study, part: &Part, rows: &Rows) {
        let (width, per_robot) = (self.numbers.len(), study.per_robot());
        for robot in part.robots(per_robot) {
            let values = study.values(robot);
            for k in part.pressures(robot, per_robot) {
                self.case.push((robot * per_robot + k) as i64 + 1);
                self.engine.push(part.engine.word().into());
                self.inputs.iter_mut().zip(&values).for_each(|(column, value)| column.push(value.clone()));
                let own = || study.axes.iter().position(|a| a.key == PRESSURE).and_then(|i| as_number(&values[i]));
                self.pressure.push(study.pressures_kpa.get(k).copied().or_else(own).unwrap_or(f64::NAN));
            }
        }
        let each_s = rows.cpu_s / part.cases.len() as f64;
        for row in rows.numbers.chunks(width) {
            let timed = row.iter().enumerate().map(|(k, v)| if Some(k) == self.timed { each_s } else { *v });
            self.numbers.iter_mut().zip(timed).for_each(|(column, value)| column.push(value));
        }
        let first = self.status.len();
        self.status.resize(first + part.cases.len(), "ok".into());
        self.reason.resize(first + part.cases.len(), String::new());
        for (i, why) in &rows.failed {
            self.status[first + i] = "failed".into();
            self.reason[first + i] = why.replace('\n', " ");
        }
    }

    fn table(self, study: &Study) -> Table {
        let inputs = study.axes.iter().zip(self.inputs).filter(|(axis, _)| axis.key != PRESSURE).map(|pair| pair.1);
        let columns = [Column::I64(self.case), Column::Str(self.engine)]
            .into_iter()
            .chain(inputs.map(column))
            .chain((!study.has_channels()).then_some(Column::F64(self.pressure)))
            .chain(self.numbers.into_iter().map(Column::F64))
            .chain([Column::Str(self.status), Column::Str(self.reason)]);
        Table { columns: names(study).into_iter().zip(columns).collect() }
    }
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
