//! A scenario's text with effects added: what stands there stays, comments too. The new text is parsed and held against what
//! it should mean before anyone sees it; what was added can be read back.

use crate::failure::Failure;
use models::Scenario;
use serde::Deserialize;
use std::collections::BTreeMap;
use std::ops::Range;
use toml::Spanned;

/// An effect as it is to be written.
#[derive(Debug, Clone, PartialEq)]
pub struct Addition {
    /// Name in the catalogue.
    pub name: String,
    /// Keys and values, in the units of the keys.
    pub values: Vec<(String, f64)>,
    /// `assumed` or `calibrated`.
    pub basis: &'static str,
    /// 95 % intervals in words; empty for none.
    pub interval: String,
    /// Name and SHA-256 of the data, if there were any.
    pub data: Vec<[String; 2]>,
    /// Date, for example `2026-11-21`.
    pub date: String,
    /// B of the scenario without the effect, calibrated on the same data \[N·m²\].
    pub bending_without_nm2: Option<f64>,
    /// Lines of the comment above it.
    pub remarks: Vec<String>,
}

/// A bending stiffness that replaces the scenario's.
#[derive(Debug, Clone, PartialEq)]
pub struct NewBending {
    /// B \[N·m²\].
    pub value_nm2: f64,
    /// Where it comes from.
    pub remark: String,
}

/// What the text of a scenario says about an effect that was added to it.
#[derive(Debug, Clone, PartialEq)]
pub struct Origin {
    /// Name of the effect.
    pub effect: String,
    /// SHA-256 of the data it was fitted to or judged on.
    pub data_sha256: Vec<String>,
    /// B without it, calibrated on those data \[N·m²\].
    pub bending_without_nm2: Option<f64>,
}

/// Significant digits of what is written.
const DIGITS: i32 = 6;
/// How the note of an added effect begins.
const ADDED: &str = "added by ibr";
/// What comes before the stiffness in that note.
const WITHOUT: &str = "calibrated without it B = ";
/// What comes before the hash of the data.
const HASH: &str = "SHA-256 ";

#[derive(Deserialize)]
struct Places {
    body: Body,
}

#[derive(Deserialize)]
struct Body {
    radius_mm: Spanned<toml::Value>,
    bending_stiffness_nm2: Option<Spanned<toml::Value>>,
}

#[derive(Deserialize)]
struct Remarked {
    #[serde(default)]
    effects: BTreeMap<String, Spanned<toml::Table>>,
}

/// The text with B replaced and the effects appended, and the scenario it describes.
pub fn extended(
    text: &str,
    scenario: &Scenario,
    bending: Option<&NewBending>,
    additions: &[Addition],
) -> Result<(String, Scenario), Failure> {
    let mut new = bending.map_or(Ok(text.to_string()), |b| with_bending(text, b))?;
    for addition in additions {
        let section = section(addition, new.ends_with('\n'));
        new.push_str(&section);
    }
    let parsed = Scenario::parse(&new).map_err(|e| refused(&e.to_string()))?;
    if bare_of_words(&parsed) != bare_of_words(&meant(scenario, bending, additions)) {
        return Err(refused("it would not mean what it should"));
    }
    Ok((new, parsed))
}

/// The effects that were added to a scenario, in the order of its text.
pub fn origins(text: &str) -> Vec<Origin> {
    let Ok(remarked) = toml::from_str::<Remarked>(text) else { return Vec::new() };
    let mut found: Vec<(usize, Origin)> = remarked
        .effects
        .into_iter()
        .filter_map(|(effect, table)| {
            let start = table.span().start;
            let word = |key: &str| table.get_ref().get(key).and_then(|v| v.as_str()).unwrap_or_default().to_string();
            let note = word("note");
            let after = |text: &str, mark: &str| Some(text.split_once(mark)?.1.split_whitespace().next()?.to_string());
            let bending_without_nm2 = after(&note, WITHOUT).and_then(|number| number.parse().ok());
            let origin = Origin { effect, data_sha256: hashes(&word("data")), bending_without_nm2 };
            note.starts_with(ADDED).then_some((start, origin))
        })
        .collect();
    found.sort_by_key(|(start, _)| *start);
    found.into_iter().map(|(_, origin)| origin).collect()
}

/// Every SHA-256 in what is said of the data.
fn hashes(text: &str) -> Vec<String> {
    let hash = |part: &str| part.chars().take_while(char::is_ascii_alphanumeric).collect();
    text.split(HASH).skip(1).map(hash).collect()
}

/// Rounded to what is written.
pub fn rounded(v: f64) -> f64 {
    if v == 0.0 || !v.is_finite() {
        return v;
    }
    let digits = (DIGITS - 1 - v.abs().log10().floor() as i32).clamp(0, 17) as usize;
    format!("{v:.digits$}").parse().unwrap_or(v)
}

fn meant(scenario: &Scenario, bending: Option<&NewBending>, additions: &[Addition]) -> Scenario {
    let mut wanted = scenario.clone();
    for a in additions {
        let catalogue = scenario.catalogue();
        let Some(effect) = catalogue.by_name(&a.name) else { continue };
        let value = |p: &models::effects::Parameter| {
            let written = a.values.iter().find(|(key, _)| key == p.key);
            written.map_or(p.neutral, |(_, v)| rounded(*v)) * p.si
        };
        let values: Vec<f64> = effect.parameters.iter().map(value).collect();
        wanted = wanted.with_effect(&a.name, &values);
    }
    if let Some(b) = bending {
        wanted.bending_stiffness = rounded(b.value_nm2);
    }
    wanted
}

fn bare_of_words(scenario: &Scenario) -> Scenario {
    let mut bare = scenario.clone();
    bare.effects.iter_mut().for_each(|e| e.basis.clear());
    bare
}

fn refused(why: &str) -> Failure {
    let message = format!("the scenario's text cannot be extended: {why}");
    Failure::usage(message, "write effects as [effects.NAME] and the body as [body], or add the lines by hand")
}

fn section(a: &Addition, on_new_line: bool) -> String {
    let mut out = if on_new_line { "\n".to_string() } else { "\n\n".to_string() };
    a.remarks.iter().for_each(|line| out.push_str(&format!("# {}\n", one_line(line))));
    out.push_str(&format!("[effects.{}]\n", a.name));
    a.values.iter().for_each(|(key, value)| out.push_str(&format!("{key} = {}\n", rounded(*value))));
    let mut word = |key: &str, text: &str| {
        out.push_str(&format!("{key} = {}\n", toml::Value::String(one_line(text))));
    };
    word("basis", a.basis);
    if !a.interval.is_empty() {
        word("interval", &a.interval);
    }
    if !a.data.is_empty() {
        let each: Vec<String> = a.data.iter().map(|[name, sha256]| format!("{name}, {HASH}{sha256}")).collect();
        word("data", &each.join("; "));
    }
    word("date", &a.date);
    let without = a.bending_without_nm2.map(|b| format!("; {WITHOUT}{} N m²", rounded(b)));
    word("note", &format!("{ADDED}{}", without.unwrap_or_default()));
    out
}

/// A remark may quote a file name, which may hold anything.
fn one_line(text: &str) -> String {
    text.chars().map(|c| if c.is_control() { ' ' } else { c }).collect()
}

fn with_bending(text: &str, b: &NewBending) -> Result<String, Failure> {
    let places: Places = toml::from_str(text).map_err(|e| refused(e.message()))?;
    let value = rounded(b.value_nm2).to_string();
    let remark = one_line(&b.remark);
    let Some(old) = &places.body.bending_stiffness_nm2 else {
        let end = rest_of_line(text, places.body.radius_mm.span().end).end;
        return Ok(replaced(text, end..end, &format!("\nbending_stiffness_nm2 = {value}   # {remark}")));
    };
    let (at, before) = (old.span(), &text[old.span()]);
    let rest = rest_of_line(text, at.end);
    let behind = text[rest.clone()].trim();
    Ok(match behind.strip_prefix('#').map(str::trim) {
        Some(comment) => {
            let line = format!("{value}   # {remark}; before: {before}, {comment}");
            replaced(text, at.start..rest.end, &line)
        }
        None if behind.is_empty() => {
            replaced(text, at.start..rest.end, &format!("{value}   # {remark}; before: {before}"))
        }
        None => replaced(text, at, &value),
    })
}

fn rest_of_line(text: &str, from: usize) -> Range<usize> {
    let end = text[from..].find(['\n', '\r']).map_or(text.len(), |i| from + i);
    from..end
}

fn replaced(text: &str, at: Range<usize>, by: &str) -> String {
    format!("{}{by}{}", &text[..at.start], &text[at.end..])
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
            let scenario = Scenario::parse(text).unwrap();
            let bending = NewBending { value_nm2: 1.23456789, remark: "calibrated".into() };
            let (new, parsed) = extended(text, &scenario, Some(&bending), &[friction()]).unwrap();
            assert_eq!(parsed.bending_stiffness, 1.23457);
            assert_eq!(parsed.effects.len(), scenario.effects.len() + 1);
            let kept = |line: &str| line.starts_with("bending_stiffness") || new.contains(line);
            assert!(text.lines().all(kept) && new.contains("# from here\n[effects.friction]"), "{new}");
            assert!(new.contains("calibrated; before: 0"), "{new}");
            let wanted = Origin {
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
        let scenario = Scenario::parse(&text).unwrap();
        let bending = NewBending { value_nm2: 2.0, remark: "r".into() };
        let (new, parsed) = extended(&text, &scenario, Some(&bending), &[]).unwrap();
        assert_eq!(parsed.bending_stiffness, 2.0);
        assert!(new.find("radius_mm") < new.find("bending_stiffness_nm2"));
    }

    #[test]
    fn a_text_that_cannot_be_extended_is_refused() {
        let text = models::shipped("spam").unwrap();
        let scenario = Scenario::parse(text).unwrap();
        let twice = Addition { name: "arm_growth".into(), values: vec![("beta".into(), 0.5)], ..friction() };
        let refusal = extended(text, &scenario, None, &[twice]).unwrap_err().to_string();
        assert!(refusal.contains("cannot be extended"), "{refusal}");
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
