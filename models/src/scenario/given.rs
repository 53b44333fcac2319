//! A table of the text, read key by key: unknown, missing and impossible values are refused with their place.

use super::keys::{Key, key, names};
use super::raw::{Entries, syntax};
pub(super) use crate::error::{Checked, ScenarioError, fault};
use serde::de::DeserializeOwned;
use std::ops::Range;
use toml::{Spanned, Value};

/// A number in SI, within a range.
pub(super) fn si(value: &Spanned<f64>, range: &spelling::units::Range) -> Checked<f64> {
    range.si(range.name, *value.get_ref()).or_else(|(message, help)| fault(message).help(help).at(value.span()))
}

/// A unit after its number; nothing where there is none.
pub(super) fn unit(name: &str) -> String {
    if name == "-" { String::new() } else { format!(" {name}") }
}

pub(super) struct Given<'a> {
    /// Where it is in the text.
    pub span: Range<usize>,
    entries: Vec<(&'static Key, &'a Spanned<Value>)>,
}

impl<'a> Given<'a> {
    /// Refuses keys that such a table does not have.
    pub(super) fn new(table: &str, raw: &'a Spanned<Entries>) -> Checked<Given<'a>> {
        let known = |(name, value): (&Spanned<String>, &'a Spanned<Value>)| match key(table, name.get_ref()) {
            Some(key) => Ok((key, value)),
            None => {
                let all = names(table);
                let listed: Vec<String> = all.iter().map(|name| format!("`{name}`")).collect();
                let meant = spelling::meant(name.get_ref(), all);
                fault(format!("unknown field `{}`, expected one of {}", name.get_ref(), listed.join(", ")))
                    .help(format!("{meant}every key carries its unit, for example length_mm"))
                    .at(name.span())
            }
        };
        let entries = raw.get_ref().iter().map(known).collect::<Checked<_>>()?;
        Ok(Given { span: raw.span(), entries })
    }

    /// The same, keys that are left out taken from another table.
    pub(super) fn or(mut self, other: &Given<'a>) -> Given<'a> {
        let missing = other.entries.iter().filter(|(key, _)| self.at(key.name).is_none());
        let missing: Vec<_> = missing.copied().collect();
        self.entries.extend(missing);
        self
    }

    fn at(&self, name: &str) -> Option<&(&'static Key, &'a Spanned<Value>)> {
        self.entries.iter().find(|(key, _)| key.name == name)
    }

    pub(super) fn has_any(&self, names: &[&str]) -> bool {
        names.iter().any(|name| self.at(name).is_some())
    }

    /// Where the value of a key is; the table where it is left out.
    pub(super) fn span_of(&self, name: &str) -> Range<usize> {
        self.at(name).map_or(self.span.clone(), |(_, value)| value.span())
    }

    pub(super) fn raw(&self, name: &str) -> Option<&'a Spanned<Value>> {
        self.at(name).map(|(_, value)| *value)
    }

    pub(super) fn read<T: DeserializeOwned>(&self, name: &str) -> Checked<Option<T>> {
        let Some(value) = self.raw(name) else { return Ok(None) };
        let wrong = |error| {
            let span = value.span();
            ScenarioError { span: Some((span.start, span.end)), ..syntax(error) }
        };
        T::deserialize(value.get_ref().clone()).map(Some).map_err(wrong)
    }

    /// The same; the key must be there.
    pub(super) fn needed<T>(&self, name: &str, value: Option<T>) -> Checked<T> {
        let message = format!("missing field `{name}`");
        value.ok_or(ScenarioError { message, help: None, span: Some((self.span.start, self.span.end)) })
    }

    /// A number in SI, within the range of its key.
    pub(super) fn number(&self, name: &str) -> Checked<Option<f64>> {
        let (Some((key, at)), Some(value)) = (self.at(name), self.read(name)?) else { return Ok(None) };
        key.range.map(|range| si(&Spanned::new(at.span(), value), &range)).transpose()
    }

    /// The same; the key must be there.
    pub(super) fn need(&self, name: &str) -> Checked<f64> {
        self.needed(name, self.number(name)?)
    }

    /// A whole number within the range of its key.
    pub(super) fn whole(&self, name: &str) -> Checked<Option<usize>> {
        let Some(whole) = self.read::<i64>(name)? else { return Ok(None) };
        self.number(name)?;
        Ok(usize::try_from(whole).ok())
    }
}
