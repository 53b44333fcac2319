//! A scenario's text with effects added: the existing text stays, comments too. The new text is parsed and compared with
//! its intended meaning before anyone sees it; what was added can be read back.

use crate::diagnosis::taken_away;
use crate::error::CompareError;
use crate::scenario_file::ScenarioFile;
use crate::typed_effect::{TypedValues, with_values};
use models::{Known, Scenario};
use toml_edit::{Decor, DocumentMut, Item, Table, Value, value};

/// An effect as it is to be written.
#[derive(Debug, Clone, PartialEq)]
pub struct Addition {
    /// Name of the effect in the catalogue.
    pub name: String,
    /// Keys and values, in the units of the keys.
    pub values: Vec<(String, f64)>,
    /// How the values are known: `assumed` or `calibrated`.
    pub basis: &'static str,
    /// 95 % intervals in words; empty for none.
    pub interval: String,
    /// Name and SHA-256 of the data, if there were any.
    pub data: Vec<[String; 2]>,
    /// Day of the fit in UTC, for example `2026-11-21`.
    pub date: String,
    /// B of the scenario without the effect, calibrated on the same data \[N·m²\].
    pub bending_without_nm2: Option<f64>,
    /// Lines of the comment above it.
    pub remarks: Vec<String>,
}

impl Addition {
    /// An effect without data, written today.
    pub(super) fn of(name: &str, values: TypedValues, known: Known, remark: Option<String>) -> Addition {
        Addition {
            name: name.into(),
            values,
            basis: known.word(),
            interval: String::new(),
            data: Vec::new(),
            date: today(),
            bending_without_nm2: None,
            remarks: remark.into_iter().collect(),
        }
    }
}

/// A value of `[body]` that replaces the scenario's.
#[derive(Debug, Clone, PartialEq)]
pub struct BodyValue {
    /// Key of `[body]`, with its unit.
    pub key: &'static str,
    /// In the unit of the key.
    pub value: f64,
    /// Source of the value, written as a comment after it.
    pub remark: String,
}

/// What the text of a scenario records about an effect that was added to it.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct EffectOrigin {
    pub effect: String,
    /// SHA-256 of the data it was fitted to or judged on.
    pub data_sha256: Vec<String>,
    /// B without it, calibrated on those data \[N·m²\].
    pub bending_without_nm2: Option<f64>,
}

const DIGITS: i32 = 6;
const ADDED: &str = "added by ibr";
const WITHOUT: &str = "calibrated without it B = ";
const HASH: &str = "SHA-256 ";
pub(super) const BENDING: &str = "bending_stiffness_nm2";

/// The scenario with B replaced and the effects appended; it keeps its name.
///
/// # Errors
/// A text in which this cannot be written without touching existing text.
pub(crate) fn extended(
    file: &ScenarioFile,
    bending: Option<&BodyValue>,
    additions: &[Addition],
) -> Result<ScenarioFile, CompareError> {
    let mut document = with_body(file, bending)?;
    for addition in additions {
        let why = || match taken_away(&addition.name) {
            Some(gone) => format!("it has no table [effects.{gone}]"),
            None => format!("it has {} already", addition.name),
        };
        add(&mut document, addition).ok_or_else(|| refused(&why()))?;
    }
    let text = document.to_string();
    let scenario = Scenario::parse(&text).map_err(|e| refused(&e.to_string()))?;
    if bare_of_words(&scenario) != bare_of_words(&meant(file, bending, additions)) {
        return Err(refused("it would not mean what it should"));
    }
    Ok(ScenarioFile { name: file.name.clone(), text, scenario })
}

/// The scenario with one more `[[formula]]` at its end, under a comment, and a value of its body.
pub(super) fn with_formula(
    file: &ScenarioFile,
    toml: &str,
    comment: &[String],
    body: Option<&BodyValue>,
) -> Result<ScenarioFile, CompareError> {
    let document = with_body(file, body)?;
    let comment: String = comment.iter().map(|line| format!("# {}\n", one_line(line))).collect();
    let text = format!("{}\n\n{comment}{toml}", document.to_string().trim_end());
    let scenario = Scenario::parse(&text).map_err(|e| refused(&e.to_string()))?;
    Ok(ScenarioFile { name: file.name.clone(), text, scenario })
}

pub(crate) fn origins(text: &str) -> Vec<EffectOrigin> {
    let document: DocumentMut = text.parse().unwrap_or_default();
    let effects = document.get("effects").and_then(Item::as_table_like).map(|table| table.iter());
    let origin = |(effect, item): (&str, &Item)| {
        let word = |key: &str| item.get(key).and_then(Item::as_str).unwrap_or_default();
        let note = word("note").strip_prefix(ADDED)?;
        let bending = note.split_once(WITHOUT).and_then(|(_, rest)| rest.split_whitespace().next()?.parse().ok());
        let data_sha256 = hashes(word("data"));
        Some(EffectOrigin { effect: effect.into(), data_sha256, bending_without_nm2: bending })
    };
    effects.into_iter().flatten().filter_map(origin).collect()
}

fn hashes(text: &str) -> Vec<String> {
    let hash = |part: &str| part.chars().take_while(char::is_ascii_alphanumeric).collect();
    text.split(HASH).skip(1).map(hash).collect()
}

pub(super) fn rounded(v: f64) -> f64 {
    if v == 0.0 || !v.is_finite() {
        return v;
    }
    let digits = (DIGITS - 1 - v.abs().log10().floor() as i32).clamp(0, 17) as usize;
    format!("{v:.digits$}").parse().unwrap_or(v)
}

fn with_body(file: &ScenarioFile, body: Option<&BodyValue>) -> Result<DocumentMut, CompareError> {
    let mut document: DocumentMut = file.text.parse().map_err(|e: toml_edit::TomlError| refused(e.message()))?;
    let set = body.map_or(Some(()), |new| set_body(&mut document, new));
    set.map(|()| document).ok_or_else(|| refused("it has no table [body]"))
}

fn meant(scenario: &Scenario, bending: Option<&BodyValue>, additions: &[Addition]) -> Scenario {
    let mut wanted = scenario.clone();
    for a in additions {
        wanted.effects.retain(|e| taken_away(&a.name) != Some(&e.name));
        wanted = with_values(&wanted, &a.name, |wanted| {
            a.values.iter().find(|(key, _)| key == wanted).map(|(_, v)| rounded(*v))
        });
    }
    if let Some(b) = bending {
        wanted.bending_stiffness = rounded(b.value);
    }
    wanted
}

fn bare_of_words(scenario: &Scenario) -> Scenario {
    let mut bare = scenario.clone();
    bare.effects.iter_mut().for_each(|e| (e.basis, e.interval) = Default::default());
    bare
}

fn refused(why: &str) -> CompareError {
    let message = format!("the scenario's text cannot be extended: {why}");
    CompareError::refused(message, "write effects as [effects.NAME] and the body as [body], or add the lines by hand")
}

/// A number as short as it can be written: `1`, not `1.0`.
fn number(v: f64) -> Value {
    rounded(v).to_string().parse().unwrap_or_else(|_| Value::from(v))
}

/// `None` if the effect is there already, or missing where it is to be taken away, or effects are no tables.
fn add(document: &mut DocumentMut, a: &Addition) -> Option<()> {
    if let Some(gone) = taken_away(&a.name) {
        document.get_mut("effects")?.as_table_like_mut()?.remove(gone)?;
        let data: String = a.data.iter().map(|[name, sha256]| format!(": {name}, {HASH}{sha256}")).collect();
        let line = format!("# [effects.{gone}] was taken away by ibr on {}{}\n", a.date, one_line(&data));
        let before = document.trailing().as_str().unwrap_or_default().to_string();
        document.set_trailing(format!("{before}{line}"));
        return Some(());
    }
    let mut implicit = Table::new();
    implicit.set_implicit(true);
    let effects = document.entry("effects").or_insert(Item::Table(implicit)).as_table_mut()?;
    if effects.contains_key(&a.name) {
        return None;
    }
    let mut table = Table::new();
    let remarks: String = a.remarks.iter().map(|line| format!("# {}\n", one_line(line))).collect();
    *table.decor_mut() = Decor::new(format!("\n{remarks}"), "");
    a.values.iter().for_each(|(key, v)| _ = table.insert(key, Item::Value(number(*v))));
    let each: Vec<String> = a.data.iter().map(|[name, sha256]| format!("{name}, {HASH}{sha256}")).collect();
    let without = a.bending_without_nm2.map(|b| format!("; {WITHOUT}{} N m²", rounded(b))).unwrap_or_default();
    let words = [
        ("basis", a.basis.to_string()),
        ("interval", a.interval.clone()),
        ("data", each.join("; ")),
        ("date", a.date.clone()),
        ("note", format!("{ADDED}{without}")),
    ];
    for (key, text) in words.iter().filter(|(_, text)| !text.is_empty()) {
        table.insert(key, value(one_line(text)));
    }
    effects.insert(&a.name, Item::Table(table));
    Some(())
}

/// A remark may quote a file name, which may hold anything.
fn one_line(text: &str) -> String {
    text.chars().map(|c| if c.is_control() { ' ' } else { c }).collect()
}

/// Replaces one value and keeps its old comment; `None` without a table `[body]`.
fn set_body(document: &mut DocumentMut, new: &BodyValue) -> Option<()> {
    let is_inline = document.get("body")?.is_inline_table();
    let body = document.get_mut("body")?.as_table_like_mut()?;
    let old = body.get(new.key).and_then(Item::as_value);
    let before = old.map_or(String::new(), |old| {
        let behind = old.decor().suffix().and_then(|suffix| suffix.as_str()).unwrap_or_default();
        let comment = behind.trim().trim_start_matches('#').trim();
        let comma = if comment.is_empty() { "" } else { ", " };
        format!("; before: {}{comma}{comment}", old.clone().decorated("", ""))
    });
    let remark = if is_inline { String::new() } else { format!("   # {}{before}", one_line(&new.remark)) };
    let written = Item::Value(number(new.value).decorated(" ", remark));
    match body.get_mut(new.key) {
        Some(place) => *place = written,
        None => _ = body.insert(new.key, written),
    }
    Some(())
}

/// Today's date in UTC, as `2026-11-21`.
pub fn today() -> String {
    time::OffsetDateTime::now_utc().date().to_string()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn friction() -> Addition {
        Addition {
            name: "friction".into(),
            values: vec![("moment_nm".into(), 0.123456789)],
            basis: "calibrated",
            interval: "moment_nm 0.12 to 0.13".into(),
            data: vec![["my \"runs\"".into(), "ab12".into()], ["more".into(), "cd34".into()]],
            date: "2026-11-21".into(),
            bending_without_nm2: Some(0.5),
            remarks: vec!["from\nhere".into()],
        }
    }

    #[test]
    fn what_was_there_stays_and_what_is_added_is_read_back() {
        for (_, text) in models::scenario::SHIPPED {
            let file = ScenarioFile::parse("mine", text).unwrap();
            let bending = BodyValue { key: BENDING, value: 1.23456789, remark: "calibrated".into() };
            let ScenarioFile { text: new, scenario: parsed, .. } =
                extended(&file, Some(&bending), &[friction()]).unwrap();
            assert_eq!(parsed.bending_stiffness, 1.23457);
            assert_eq!(parsed.effects.len(), file.effects.len() + 1);
            let kept = |line: &str| line.starts_with("bending_stiffness") || new.contains(line);
            assert!(text.lines().all(kept) && new.contains("# from here\n[effects.friction]"), "{new}");
            assert!(new.contains("calibrated; before: 0"), "{new}");
            let wanted = EffectOrigin {
                effect: "friction".into(),
                data_sha256: vec!["ab12".into(), "cd34".into()],
                bending_without_nm2: Some(0.5),
            };
            assert_eq!(origins(&new), [wanted]);
        }
    }

    #[test]
    fn a_stiffness_that_is_not_there_comes_after_the_radius() {
        let lines = models::shipped("spam").unwrap().lines().filter(|l| !l.starts_with("bending"));
        let text: String = lines.flat_map(|line| [line, "\r\n"]).collect();
        let file = ScenarioFile::parse("mine", &text).unwrap();
        let bending = BodyValue { key: BENDING, value: 2.0, remark: "r".into() };
        let ScenarioFile { text: new, scenario: parsed, .. } = extended(&file, Some(&bending), &[]).unwrap();
        assert_eq!(parsed.bending_stiffness, 2.0);
        assert!(new.find("radius_mm") < new.find("bending_stiffness_nm2"));
    }

    #[test]
    fn a_text_that_cannot_be_extended_is_refused() {
        let file = ScenarioFile::parse("mine", models::shipped("spam").unwrap()).unwrap();
        let twice = Addition { name: "arm_growth".into(), values: vec![("beta".into(), 0.5)], ..friction() };
        let refusal = extended(&file, None, &[twice]).unwrap_err().to_string();
        assert!(refusal.contains("cannot be extended"), "{refusal}");
    }

    #[test]
    fn an_effect_is_taken_away_with_its_comment_and_the_rest_stays() {
        let file = ScenarioFile::parse("mine", models::shipped("spam").unwrap()).unwrap();
        let away = Addition { name: "without arm_growth".into(), values: Vec::new(), ..friction() };
        let new = extended(&file, None, std::slice::from_ref(&away)).unwrap();
        assert!(!new.effects.iter().any(|e| e.name == "arm_growth") && new.effects.len() + 1 == file.effects.len());
        assert!(new.text.ends_with("SHA-256 ab12: more, SHA-256 cd34\n"), "{}", new.text);
        assert!(
            new.text.contains("# [effects.arm_growth] was taken away by ibr on 2026-11-21: my \"runs\""),
            "{}",
            new.text
        );
        assert!(origins(&new.text).is_empty());
        let twice = extended(&new, None, &[away]).unwrap_err().to_string();
        assert!(twice.contains("no table [effects.arm_growth]"), "{twice}");
    }

    #[test]
    fn an_effect_written_by_hand_was_not_added() {
        assert!(origins(models::shipped("spam").unwrap()).is_empty());
    }

    #[test]
    fn six_digits_are_written() {
        assert_eq!([0.0, 1234.56789, 1.234e-7, -0.5].map(rounded), [0.0, 1234.57, 1.234e-7, -0.5]);
    }
}
