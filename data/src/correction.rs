//! A correction of another simulator's predictions: a displacement of every marker over the pressure.
//!
//! | column | meaning |
//! |---|---|
//! | `p_body_kpa`, `p_act_kpa` | pressures |
//! | `phase` (optional) | `load` or `unload`, where the two differ |
//! | `marker` | label |
//! | `dx_mm`, `dy_mm` | displacement that is added to the prediction |
//!
//! Comments above the header name the effects and the data of the fit.

use crate::cells::label;
use crate::columns::{Field, Head, Note, field, needed, plain};
use crate::dataset::{Dataset, Hold, Phase};
use crate::error::{DataError, Result};
use crate::lines::LineReader;
use crate::policy;
use crate::units::{MeasuredQuantity, kpa};

const FIELDS: [Field; 6] = [
    plain("marker", true),
    field("p_body", "p_body_kpa", MeasuredQuantity::Pressure, true),
    field("p_act", "p_act_kpa", MeasuredQuantity::Pressure, true),
    field("dx", "dx_mm", MeasuredQuantity::Length, true),
    field("dy", "dy_mm", MeasuredQuantity::Length, true),
    plain("phase", false),
];
const MARKER: usize = 0;
const P_BODY: usize = 1;
const P_ACT: usize = 2;
const DX: usize = 3;
const DY: usize = 4;
const PHASE: usize = 5;

#[derive(Debug, Clone, PartialEq)]
struct MarkerShift {
    marker: String,
    phase: String,
    body_pa: f64,
    act_pa: f64,
    d_m: [f64; 2],
}

/// Displacements of markers over the pressure.
#[derive(Debug, Clone, PartialEq)]
pub struct CorrectionTable {
    /// File, for messages.
    pub file: String,
    /// Effects, as its comments name them.
    pub effects: Vec<String>,
    /// SHA-256 of the data of the fit.
    pub data_sha256: Vec<String>,
    /// In order of pressure.
    rows: Vec<MarkerShift>,
}

/// Reads a correction.
///
/// # Errors
/// A table of another kind, a cell that is not a number: with file, line and remedy.
pub fn parse_correction(file: &str, text: &str) -> Result<CorrectionTable> {
    let mut lines = LineReader::of_text(file, text);
    let (notes, head) = Head::read(&mut lines)?;
    let help = format!("give a table that `ibr add … --base … --out correction.csv` wrote: {}", needed(&FIELDS));
    let Some(head) = head else { return Err(DataError::of(file, "the file is empty", help)) };
    let sheet = head.sheet(&FIELDS)?;
    if let Some(missing) = sheet.missing() {
        let message = format!("column {} is missing: this is not a correction", FIELDS[missing].expected);
        return Err(sheet.head.line.line().fault(message, help));
    }
    let mut rows = Vec::new();
    sheet.each_row(&mut lines, |row| {
        let number = |field: usize| row.number(field).map(Option::unwrap_or_default);
        let (marker, phase) = (label(row.text(MARKER)).to_string(), row.text(PHASE).to_lowercase());
        let (body_pa, act_pa, d_m) = (number(P_BODY)?, number(P_ACT)?, [number(DX)?, number(DY)?]);
        rows.push(MarkerShift { marker, phase, body_pa, act_pa, d_m });
        Ok(())
    })?;
    rows.sort_by(|a, b| a.act_pa.total_cmp(&b.act_pa));
    let of = |key: &'static str| notes.iter().filter(move |note| note.key == key);
    let effects = of("effects").flat_map(|note| note.text.split(", ")).map(str::to_string).collect();
    let hash = |note: &Note| Some(note.text.rsplit_once("SHA-256 ")?.1.trim().to_string());
    let data_sha256 = of("fitted on").filter_map(hash).collect();
    Ok(CorrectionTable { file: file.to_string(), effects, data_sha256, rows })
}

impl CorrectionTable {
    /// Displacements at the holds of data in run layout \[m\], linear between the pressures of the table.
    ///
    /// # Errors
    /// A marker, a body pressure or an actuator pressure that the table has not.
    pub fn moved_m(&self, dataset: &Dataset) -> Result<Vec<f64>> {
        let mut moved = Vec::with_capacity(dataset.values_per_run());
        for hold in &dataset.holds {
            let mut of_hold = Vec::new();
            for marker in &dataset.markers {
                of_hold.extend(self.between(hold, &marker.name)?.into_iter().chain([0.0]).take(dataset.axes));
            }
            moved.extend(of_hold.repeat(dataset.samples_per_hold));
        }
        Ok(moved)
    }

    fn between(&self, hold: &Hold, marker: &str) -> Result<[f64; 2]> {
        let body_pa = hold.p_body_pa;
        let near = |row: &&MarkerShift| (row.body_pa - body_pa).abs() <= policy::tolerance_body_pa(body_pa);
        let phase = if hold.phase == Phase::Unload { "unload" } else { "load" };
        let in_phase = |row: &&MarkerShift| row.phase.is_empty() || row.phase == phase;
        let of_marker = self.rows.iter().filter(|row| row.marker == marker);
        let own: Vec<&MarkerShift> = of_marker.filter(near).collect();
        let one_way: Vec<&MarkerShift> = own.iter().copied().filter(in_phase).collect();
        // The highest pressure of a way back is the end of the way there.
        let own = if one_way.is_empty() { own } else { one_way };
        let refused = |message: String| {
            let help =
                "fit it on data with this marker at these pressures, and write it again: `ibr add … --base … --also …`";
            Err(DataError::of(&self.file, message, help))
        };
        let [Some(first), Some(last)] = [own.first(), own.last()] else {
            let body = kpa(body_pa);
            return refused(format!("the correction has no marker {marker} at {body:.1} kPa body pressure"));
        };
        let p = hold.p_act_pa;
        let reach = policy::tolerance_act_pa(last.act_pa);
        if p > last.act_pa + reach || p < first.act_pa - reach {
            let [p, low, high] = [p, first.act_pa, last.act_pa].map(kpa);
            return refused(format!("the correction goes from {low:.1} to {high:.1} kPa, and a hold is at {p:.1} kPa"));
        }
        let above = own.iter().position(|row| row.act_pa >= p).unwrap_or(own.len() - 1);
        let [a, b] = [own[above.saturating_sub(1)], own[above]];
        let width = b.act_pa - a.act_pa;
        let share = if width > 0.0 { ((p - a.act_pa) / width).clamp(0.0, 1.0) } else { 1.0 };
        Ok([0, 1].map(|axis| a.d_m[axis] + share * (b.d_m[axis] - a.d_m[axis])))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = include_str!("../tests/made/correction.csv");

    fn moved(hold: [f64; 2], phase: Phase) -> Result<[f64; 2], String> {
        let table = parse_correction("c.csv", TEXT).unwrap();
        let [p_body_pa, p_act_pa] = hold;
        let hold = Hold { p_body_pa, p_act_pa, more_act_pa: Vec::new(), phase, occurrence: 0, t_s: vec![0.0] };
        table.between(&hold, "1").map(|d| d.map(|m| (m * 1e6).round() * 1e-3)).map_err(|error| error.to_string())
    }

    #[test]
    fn displacements_are_linear_between_pressures_on_the_way_of_the_phase() {
        assert_eq!(moved([2e3, 15e3], Phase::Load), Ok([3.0, -7.5]));
        assert_eq!(moved([2e3, 0.0], Phase::Unload), Ok([0.0, -2.0]));
        assert!(
            moved([2e3, 30e3], Phase::Load).unwrap_err().contains("goes from 0.0 to 20.0 kPa, and a hold is at 30.0")
        );
        assert!(moved([4e3, 10e3], Phase::Load).unwrap_err().contains("no marker 1 at 4.0 kPa body pressure"));
    }

    #[test]
    fn comments_name_the_effects_and_the_data() {
        let table = parse_correction("c.csv", TEXT).unwrap();
        assert_eq!((table.effects, table.data_sha256), (vec!["pressure_loss".into()], vec!["0123abcd".to_string()]));
        let error = parse_correction("c.csv", &TEXT.replace("dx_mm,", "x_mm,")).unwrap_err();
        assert_eq!(error.to_string(), "c.csv:4: column dx_mm is missing: this is not a correction");
    }
}
