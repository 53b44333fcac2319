//! A CSV file that grows as the run does and is cut back to the checkpoint on resume.

use std::fs::{File, OpenOptions};
use std::io::Write;
use std::path::{Path, PathBuf};

use crate::output::replace;
use crate::{FemError, Result};

/// A growing table with a column `step`. Rows of one step are written in one go and handed to the system at once.
#[derive(Debug)]
pub(crate) struct StepTable {
    path: PathBuf,
    file: File,
    header: String,
    last_step: Option<u64>,
}

impl StepTable {
    /// The table after the outputs at `times_s` \[s\], of so many rows each, which must be there: later rows, and a last line that a
    /// kill cut short, are dropped. Without any output it is empty, whatever was there.
    pub(crate) fn open(path: &Path, times_s: &[f64], rows_each: usize) -> Result<StepTable> {
        let text = content(path)?;
        let (header, last_step, kept) = kept(path, &text, times_s, rows_each)?;
        if kept.len() < text.len() || !path.exists() {
            replace(path, &mut |out| out.write_all(kept.as_bytes()))?;
        }
        let file = OpenOptions::new().append(true).open(path).map_err(FemError::io(path))?;
        Ok(StepTable { path: path.to_path_buf(), file, header: header.to_string(), last_step })
    }

    /// Refuses what [`StepTable::open`] refuses, and touches nothing.
    pub(crate) fn check(path: &Path, times_s: &[f64], rows_each: usize) -> Result<()> {
        kept(path, &content(path)?, times_s, rows_each).map(|_| ())
    }

    /// Adds the rows (each ending in a newline) of one step. A step that is in the table already is not written again.
    pub(crate) fn append(&mut self, step: u64, header: &str, rows: &str) -> Result<()> {
        if self.last_step == Some(step) || rows.is_empty() {
            return Ok(());
        }
        if let Some(last) = self.last_step.filter(|&last| last > step) {
            return Err(FemError::Problem(format!(
                "{}: step {step} comes after step {last}: start a new folder for a new run",
                self.path.display()
            )));
        }
        let first = self.header.is_empty();
        if !first && self.header != header {
            return Err(FemError::Problem(format!(
                "{}: the columns were `{}` and now are `{header}`: start a new folder for a changed case",
                self.path.display(),
                self.header
            )));
        }
        let text = if first { format!("{header}\n{rows}") } else { rows.to_string() };
        self.file.write_all(text.as_bytes()).map_err(FemError::io(&self.path))?;
        self.header = header.to_string();
        self.last_step = Some(step);
        Ok(())
    }

    /// Waits until the disk has all rows; to be called before a checkpoint is written.
    pub(crate) fn sync(&self) -> Result<()> {
        self.file.sync_all().map_err(FemError::io(&self.path))
    }
}

/// Header, last step and rows that an interrupted run goes on after.
fn kept<'t>(path: &Path, text: &'t str, times_s: &[f64], rows_each: usize) -> Result<(&'t str, Option<u64>, &'t str)> {
    let foreign = |line: usize| {
        let message = "not a row as this program writes it, so it cannot go on in this file: move it away".into();
        FemError::MeshFile { path: path.to_path_buf(), line, message }
    };
    let lost = |time_s: f64| {
        FemError::Problem(format!(
            "{} has lost the row of {time_s} s that the interrupted run wrote: put the file back as it was, or start again \
             with --force",
            path.display()
        ))
    };
    let mut lines = text.split_inclusive('\n').take_while(|line| line.ends_with('\n'));
    let Some(&first_s) = times_s.first() else { return Ok(("", None, "")) };
    let header = lines.next().ok_or_else(|| lost(first_s))?;
    let column = |wanted| header.trim_end().split(',').position(|name| name == wanted);
    let (time, step) = column("time_s").zip(column("step")).ok_or_else(|| foreign(1))?;
    let (mut kept, mut last) = (header.len(), None);
    for index in 0..times_s.len() * rows_each {
        let time_s = times_s[index / rows_each];
        let line = lines.next().ok_or_else(|| lost(time_s))?;
        let cell = |column: usize| line.split(',').nth(column).map(str::trim_end);
        let at: f64 = cell(time).and_then(|cell| cell.parse().ok()).ok_or_else(|| foreign(index + 2))?;
        last = Some(cell(step).and_then(|cell| cell.parse().ok()).ok_or_else(|| foreign(index + 2))?);
        if at != time_s {
            return Err(lost(time_s));
        }
        kept += line.len();
    }
    Ok((header.trim_end(), last, &text[..kept]))
}

/// The shortest digits that give the same bits when read back.
pub(crate) fn number(value: f64) -> String {
    format!("{value:e}")
}

/// Refuses text that would break a cell.
pub(crate) fn check_label(label: &str, what: &str) -> Result<()> {
    if label.is_empty() || label.contains([',', ';', '"', '\t', '\n', '\r']) {
        return Err(FemError::Problem(format!(
            "{what} `{label}` cannot be a cell of a table: use letters, digits, - and _ only"
        )));
    }
    Ok(())
}

fn content(path: &Path) -> Result<String> {
    if path.exists() { std::fs::read_to_string(path).map_err(FemError::io(path)) } else { Ok(String::new()) }
}

#[cfg(test)]
mod tests {
    use super::*;

    const HEADER: &str = "time_s,step,x";

    fn rows(step: u64) -> String {
        (0..2).map(|k| format!("{},{step},{k}\n", number(step as f64 * 0.1))).collect()
    }

    fn times(steps: u64) -> Vec<f64> {
        (0..steps).map(|step| step as f64 * 0.1).collect()
    }

    fn whole(steps: std::ops::Range<u64>) -> String {
        format!("{HEADER}\n{}", steps.map(rows).collect::<String>())
    }

    #[test]
    fn cut_anywhere_and_resumed_the_table_ends_with_the_same_bytes() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("t.csv");
        let all = whole(0..6);
        for length in (0..=all.len()).rev().step_by(7) {
            // The file on the disk has at least the rows up to the checkpoint; the last line may be half written.
            for step in (0..6).filter(|&step| whole(0..step + 1).len() <= length) {
                std::fs::write(&path, &all[..length]).unwrap();
                let mut table = StepTable::open(&path, &times(step + 1), 2).unwrap();
                assert_eq!(std::fs::read_to_string(&path).unwrap(), whole(0..step + 1));
                (step..6).for_each(|step| table.append(step, HEADER, &rows(step)).unwrap());
                table.sync().unwrap();
                assert_eq!(std::fs::read_to_string(&path).unwrap(), all);
            }
        }
    }

    #[test]
    fn a_step_back_and_other_columns_are_refused() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("t.csv");
        let mut table = StepTable::open(&path, &[], 2).unwrap();
        table.append(3, HEADER, &rows(3)).unwrap();
        assert!(table.append(2, HEADER, &rows(2)).unwrap_err().to_string().contains("step 2 comes after step 3"));
        assert!(table.append(4, "time_s,step,y", &rows(4)).unwrap_err().to_string().contains("columns were"));
        assert_eq!(std::fs::read_to_string(&path).unwrap(), whole(3..4));
    }

    #[test]
    fn a_file_that_is_no_such_table_is_refused_and_left_alone() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("t.csv");
        for (text, line) in [("a,b\n1,2\n", 1), ("time_s,step\n0,1\n0,one\n", 3)] {
            std::fs::write(&path, text).unwrap();
            let error = StepTable::open(&path, &[0.0], 2).unwrap_err().to_string();
            assert!(error.contains(&format!("t.csv:{line}: ")), "{error}");
            assert_eq!(std::fs::read_to_string(&path).unwrap(), text);
        }
    }

    #[test]
    fn a_table_that_lost_a_row_is_refused_and_left_alone() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("t.csv");
        let all = whole(0..6);
        for line in 1..=8 {
            let fewer: String = all.split_inclusive('\n').enumerate().filter(|l| l.0 != line).map(|l| l.1).collect();
            std::fs::write(&path, &fewer).unwrap();
            let error = StepTable::open(&path, &times(4), 2).unwrap_err().to_string();
            assert!(error.contains(&format!("the row of {} s", ((line - 1) / 2) as f64 * 0.1)), "{error}");
            assert_eq!(std::fs::read_to_string(&path).unwrap(), fewer);
        }
        std::fs::remove_file(&path).unwrap();
        assert!(StepTable::open(&path, &times(1), 2).unwrap_err().to_string().contains("the row of 0 s"));
        assert!(!path.exists() && StepTable::open(&path, &[], 2).is_ok() && path.exists());
    }
}
