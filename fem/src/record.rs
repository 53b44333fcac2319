//! Records: files that this program writes and reads again, JSON with the name of their shape and its version.
//!
//! Read in two goes: first shape and version, so that a record of another program is refused as foreign and not for the first
//! key it lacks; then the rest, where a fault is reported with its line and its path, `runs[3].states[0].tip_mm`.

use crate::FemError;
use crate::error::Damage;
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use serde_json::error::Category;
use serde_path_to_error::deserialize;

/// Name and version of a JSON record.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct RecordShape {
    /// Name of the record, for example `ibr.simulate`.
    pub schema: &'static str,
    /// Goes up whenever a record of before can no longer be read as it was meant.
    pub version: u64,
}

#[derive(Serialize)]
struct Stamped<'a, T> {
    schema: &'static str,
    version: u64,
    #[serde(flatten)]
    body: &'a T,
}

#[derive(Deserialize)]
struct Stamp {
    schema: String,
    version: u64,
}

impl RecordShape {
    /// Serialises `body` with the schema and version of this record in front.
    pub fn stamped<T: Serialize>(self, body: &T) -> serde_json::Value {
        // Keys are strings and numbers that are not finite become null: nothing here can fail.
        serde_json::to_value(Stamped { schema: self.schema, version: self.version, body }).unwrap_or_default()
    }

    /// A record of this shape whose body is one list, an entry a line.
    pub fn listed<T: Serialize>(self, key: &str, list: &[T]) -> String {
        let lines: Vec<String> = list.iter().filter_map(|entry| serde_json::to_string(entry).ok()).collect();
        let RecordShape { schema, version } = self;
        format!("{{\"schema\":\"{schema}\",\"version\":{version},\"{key}\":[\n{}\n]}}\n", lines.join(",\n"))
    }

    /// Reads the record in `text`, the content of `file`; `help` is the remedy if it cannot be.
    ///
    /// # Errors
    /// [`FemError::Record`]: another shape or version, a file cut short, a key missing or of another type.
    pub fn read<T: DeserializeOwned>(self, file: &str, text: &str, help: &str) -> Result<T, FemError> {
        let Stamp { schema, version } = parse(file, text, help)?;
        let RecordShape { schema: own, version: known } = self;
        if (schema.as_str(), version) != (own, known) {
            let message = format!("holds {schema}, version {version}, where this program reads {own}, version {known}");
            return Err(Damage::error(file, None, message, help));
        }
        parse(file, text, help)
    }
}

fn parse<T: DeserializeOwned>(file: &str, text: &str, help: &str) -> Result<T, FemError> {
    let mut from = serde_json::Deserializer::from_str(text);
    let found = deserialize(&mut from).map_err(|fault| {
        let path = Some(fault.path().to_string()).filter(|path| path != "." && path != "?");
        (path, fault.into_inner())
    });
    // Text after a whole record does not belong to it.
    let whole = found.is_ok();
    let found = found.and_then(|body| from.end().map(|()| body).map_err(|fault| (None, fault)));
    found.map_err(|(path, fault)| {
        let end = format!(" at line {} column {}", fault.line(), fault.column());
        let what = match fault.classify() {
            // The parser does not report the end of a file within a number.
            kind if !whole && (kind == Category::Eof || !text.trim_end().ends_with('}')) => {
                "the file is cut short".to_string()
            }
            _ => fault.to_string().trim_end_matches(&end).replace('`', "\""),
        };
        let message = path.map_or(what.clone(), |path| format!("{path}: {what}"));
        Damage::error(file, Some(fault.line() as u64), message, help)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[derive(Debug, PartialEq, Serialize, Deserialize)]
    struct Body {
        rows: Vec<Row>,
    }

    #[derive(Debug, PartialEq, Serialize, Deserialize)]
    struct Row {
        tip_mm: f64,
    }

    const SHAPE: RecordShape = RecordShape { schema: "ibr.test", version: 2 };

    fn refused(text: &str) -> String {
        let error = SHAPE.read::<Body>("R/a.json", text, "delete R").unwrap_err();
        assert_eq!(error.help(), Some("delete R"));
        error.to_string()
    }

    #[test]
    fn a_record_comes_back_and_every_fault_is_told_with_file_line_and_field() {
        let body = Body { rows: vec![Row { tip_mm: 0.1 + 0.2 }, Row { tip_mm: -1.0 }] };
        let text = format!("{:#}", SHAPE.stamped(&body));
        assert_eq!(SHAPE.read::<Body>("R/a.json", &text, "").unwrap(), body);
        let renamed = text.replacen("tip_mm", "tip", 1);
        assert_eq!(refused(&renamed), "R/a.json:5: rows[0]: missing field \"tip_mm\"");
        assert_eq!(
            refused(&text.replace("-1.0", "\"-1\"")),
            "R/a.json:7: rows[1].tip_mm: invalid type: string \"-1\", expected f64"
        );
        let words = "R/a.json: holds ibr.test, version 3, where this program reads ibr.test, version 2";
        assert_eq!(refused(&text.replace("\"version\": 2", "\"version\": 3").replace("rows", "lines")), words);
        for length in 0..text.len() {
            assert!(refused(&text[..length]).contains("the file is cut short"), "{}", &text[..length]);
        }
        assert_eq!(refused("{}"), "R/a.json:1: missing field \"schema\"");
        assert!(refused(&(text + "x")).contains("trailing characters"));
    }
}
