//! Bench tests, in addition to marker tables: a load and a deflection, a force and a contraction, a bending length.
//!
//! To add a kind: one file here with its columns and its check, and one line in [`KINDS`]. A value that is the same in all rows may
//! be in a comment above the header, `# radius_mm: 80`; `# provenance: measured` is how the numbers came to be
//! (measured, published, digitised, synthetic; measured by default).

mod bending_length;
mod force_contraction;
mod kind;
mod load_deflection;
mod read;

use std::io::Read;
use std::path::Path;

pub use crate::columns::Field;
use crate::error::{DataError, Result};
use crate::sets;
use spelling::files::{MOST_DATA, read_whole};

pub use bending_length::bending_lengths_m;
pub use kind::{Bench, BenchKind, BenchRow};

/// Kinds of bench tables that can be read.
pub const KINDS: &[BenchKind] = &[load_deflection::ENTRY, force_contraction::ENTRY, bending_length::ENTRY];

/// Reads a table of bench tests: a CSV file, a folder or an embedded set with one. `None` if it is something else (markers).
///
/// # Errors
/// A fault of the table, with line, column and what to write.
pub fn bench(spec: &str) -> Result<Option<Bench>> {
    let path = Path::new(spec);
    if path.is_file() {
        // A table of markers may be of gigabytes: its beginning shows that it is not a bench table.
        let mut start = Vec::new();
        let opened = std::fs::File::open(path).and_then(|file| file.take(HEADER).read_to_end(&mut start));
        if opened.is_ok_and(|count| count as u64 == HEADER) {
            let lines = String::from_utf8_lossy(&start);
            let end = lines.rfind('\n').map_or(lines.len(), |end| end + 1);
            if matches!(read::parse(KINDS, spec, &lines[..end]), Ok(None)) {
                return Ok(None);
            }
        }
        let Some(text) = read_whole(path, MOST_DATA).ok().and_then(|bytes| String::from_utf8(bytes).ok()) else {
            return Ok(None);
        };
        let place = path.with_file_name("scenario.toml");
        let scenario = std::fs::read_to_string(&place).ok().map(|text| (place.display().to_string(), text));
        return read::parse(KINDS, spec, &text).map(|found| found.map(|bench| Bench { scenario, ..bench }));
    }
    for kind in KINDS {
        let Some((shown, text)) = part(spec, &format!("{}.csv", kind.name)) else { continue };
        let found = read::parse(KINDS, &shown, &text)?.filter(|bench| bench.kind.name == kind.name);
        let Some(bench) = found else {
            let message = format!("the columns do not fit a {} table", kind.name);
            return Err(DataError::of(&shown, message, format!("write {}", read::wanted(kind))));
        };
        let scenario = part(spec, "scenario.toml");
        return Ok(Some(Bench { scenario, ..bench }));
    }
    Ok(None)
}

/// A file of a folder or of an embedded set: its name in errors, and its text.
fn part(spec: &str, name: &str) -> Option<(String, String)> {
    if !Path::new(spec).is_dir() {
        return Some((sets::shown(spec, name), sets::set_file(spec, name).ok()?.to_string()));
    }
    let file = Path::new(spec).join(name);
    Some((file.display().to_string(), std::fs::read_to_string(&file).ok()?))
}

/// Bytes that hold the header of any table, comments included.
const HEADER: u64 = 1 << 16;

/// Reads the text of a table; `None` if its header is of no kind.
///
/// ```
/// let csv = "# provenance: measured\nmuscle,p_act_kpa,contraction_pct,force_n\n1,300,5,40\n1,300,10,20\n";
/// let pulled = data::parse_bench("pull.csv", csv).unwrap().unwrap();
/// assert_eq!((pulled.kind.name, pulled.rows.len()), ("force_contraction", 2));
/// assert!(data::parse_bench("x.csv", "a,b\n1,2\n").unwrap().is_none(), "of no kind");
/// ```
pub fn parse_bench(file: &str, text: &str) -> Result<Option<Bench>> {
    read::parse(KINDS, file, text)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::about::Provenance;

    fn refused(text: &str, words: &[&str]) {
        let error = parse_bench("a.csv", text).unwrap_err();
        let said = format!("{error} | {}", error.help());
        assert!(words.iter().all(|word| said.contains(word)), "{said}");
    }

    #[test]
    fn every_kind_reads_its_own_columns_in_any_unit() {
        let text = "# radius_mm: 80\n# provenance: published\np_body_bar;load_n;deflection_cm\n0.2;8.72;1.284\n";
        let found = parse_bench("a.csv", text).unwrap().unwrap();
        let row = &found.rows[0];
        assert_eq!((found.kind.name, found.provenance, row.line), ("load_deflection", Provenance::Published, 4));
        let near = |base: &str, value: f64| assert!((row.value(base) / value - 1.0).abs() < 1e-12, "{base}");
        [("p_body", 2e4), ("load", 8.72), ("deflection", 0.01284), ("radius", 0.08)]
            .into_iter()
            .for_each(|(b, v)| near(b, v));
        let muscle = parse_bench("a.csv", "p_act_kpa,contraction_pct,force_n,force_sd_n,n\n620,5,300,4,3\n");
        let muscle = muscle.unwrap().unwrap();
        assert_eq!((muscle.kind.name, muscle.rows[0].get("n")), ("force_contraction", Some(3.0)));
        assert!((muscle.rows[0].value("contraction") - 0.05).abs() < 1e-15);
        let text = "# areal_mass_g_m2: 155\noverhang_mm,droop_deg\n75,59.04\n60,41.5\n";
        assert_eq!(parse_bench("a.csv", text).unwrap().unwrap().kind.name, "bending_length");
        let labelled = "# areal_mass_g_m2: 155\nspecimen,overhang_mm,droop_deg\nA1,75,59.04\n";
        let found = parse_bench("a.csv", labelled).unwrap().unwrap();
        assert!(found.kind.name == "bending_length" && (bending_lengths_m(&found)[0][0] - 0.0302).abs() < 1e-4);
        for other in
            ["run,t_s,p_act_kpa,marker,x_mm,y_mm\n", "run,marker,x_mm,y_mm,p_act_kpa,contraction_pct,force_n\n"]
        {
            assert!(parse_bench("a.csv", other).unwrap().is_none(), "{other}");
        }
    }

    #[test]
    fn what_is_wrong_is_said_with_place_and_remedy() {
        let head = "p_body_kpa,load_n,deflection_mm";
        refused(&format!("{head}\n20,1,x\n"), &["a.csv:2, column deflection_mm", "found \"x\""]);
        refused(&format!("{head}\n20,1\n"), &["a.csv:2", "2 cells, the header 3"]);
        refused(&format!("{head}\n"), &["no rows"]);
        refused(&format!("{head}\n-2,1,1\n"), &["a.csv:2", "body pressure must be from 0.5 to 100 kPa, not -2"]);
        refused(&format!("{head},deflection_sd_mm\n20,1,1,0.1\n"), &["belong together", "n of 2 or more"]);
        refused(&format!("{head},deflection_sd_mm,n\n20,1,1,0.1,1\n"), &["of 1 tests"]);
        refused("p_body,load_n,deflection_mm\n20,1,1\n", &["p_body has no unit", "p_body_kpa"]);
        refused(&format!("# radius_mm: wide\n{head}\n20,1,1\n"), &["a.csv:1", "wide"]);
        refused(
            &format!("# raduis_mm: 80\n{head}\n20,1,1\n"),
            &["a.csv:1", "unknown raduis_mm", "did you mean # radius_mm: 80?"],
        );
        refused("p_act_kpa,contraction_ratio,force_n\n620,5,300\n", &["contraction is 500 %", "contraction_pct"]);
        refused("# areal_mass_g_m2: 155\noverhang_mm,droop_deg\n75,0\n", &["droops by 0", "41.5"]);
        let words = ["a.csv:2", "a bending_length table has no column direction_deg", "bending_length_mm, overhang_mm"];
        refused("# areal_mass_g_m2: 155\noverhang_mm,direction_deg\n75,0\n", &words);
        refused("overhang_mm,droop_deg\n75,41\n", &["areal_mass_g_m2 is missing", "# areal_mass_g_m2: 155"]);
    }

    #[test]
    fn the_embedded_tables_are_read_with_their_scenarios() {
        for (set, kind, rows) in [
            ("breukels-2011-beams", "load_deflection", 36),
            ("festo-bolen-2026", "force_contraction", 4),
            ("mckibben-free", "force_contraction", 31),
        ] {
            let found = bench(set).unwrap().unwrap();
            assert_eq!((found.kind.name, found.rows.len()), (kind, rows), "{set}");
            assert_ne!(found.provenance, Provenance::Measured, "{set}: numbers in print");
        }
        assert!(bench("synthetic-epam").unwrap().is_none() && bench("no-such-thing").unwrap().is_none());
    }
}
