//! Pages: self-contained HTML with inline plots, no external resource, no script, light and dark.
//!
//! Words stand in `templates/`. Every value is escaped; the only markup in one is `` `code` `` and `**bold**`. A template that names
//! a value which is not there is an error, not a blank.

use crate::palette::{colours, with_css_variables};
use crate::{ReportError, markup};
use minijinja::value::{Serde, Value};
use minijinja::{Environment, Error, ErrorKind, UndefinedBehavior};
use serde::Serialize;
use std::collections::BTreeMap;

const TEMPLATES: [(&str, &str); 7] = [
    ("base.html", include_str!("../templates/base.html")),
    ("parts.html", include_str!("../templates/parts.html")),
    ("compare.html", include_str!("../templates/compare.html")),
    ("demo.html", include_str!("../templates/demo.html")),
    ("diagnosis.html", include_str!("../templates/diagnosis.html")),
    ("engines.html", include_str!("../templates/engines.html")),
    ("ladder.html", include_str!("../templates/ladder.html")),
];

/// A template filled with values and figures: SVG documents of [`crate::Drawn`] by name. A figure that was not drawn is left out.
///
/// # Errors
/// A value that the template needs and does not find.
pub fn render(
    template: &str,
    values: &impl Serialize,
    figures: BTreeMap<String, String>,
) -> Result<String, ReportError> {
    Ok(environment(figures)?.get_template(template)?.render(Serde(values))?)
}

fn environment(figures: BTreeMap<String, String>) -> Result<Environment<'static>, ReportError> {
    let mut env = Environment::new();
    env.set_undefined_behavior(UndefinedBehavior::Strict);
    for (name, text) in TEMPLATES {
        env.add_template(name, text)?;
    }
    let [light, dark] = colours();
    env.add_global("css_light", light);
    env.add_global("css_dark", dark);
    env.add_filter("inline", |text: &str| Value::from_safe_string(markup::inline(text)));
    env.add_filter("tags", |text: &str| Value::from_safe_string(markup::with_tags(text)));
    env.add_filter("effect", |text: &str| text.replace('_', " "));
    env.add_filter("fixed", |value: Value, digits: usize| number(&value, 1.0, |v| format!("{v:.digits$}")));
    env.add_filter("digits", |value: Value| number(&value, 1.0, three));
    env.add_filter("signed", |value: Value, digits: usize| number(&value, 1.0, |v| format!("{v:+.digits$}")));
    env.add_filter("percent", |value: Value, digits: usize| number(&value, 100.0, |v| format!("{v:.digits$}")));
    let names: Vec<String> = figures.keys().cloned().collect();
    env.add_function("drawn", move |name: &str| names.iter().any(|n| n == name));
    env.add_function("picture", move |name: &str, alt: &str| match figures.get(name) {
        Some(svg) => Ok(Value::from_safe_string(inline(svg, alt))),
        None => Err(Error::new(ErrorKind::InvalidOperation, format!("figure {name} does not exist"))),
    });
    Ok(env)
}

/// A number in words; a dash where there is none.
fn number(value: &Value, scale: f64, words: impl Fn(f64) -> String) -> String {
    let number = f64::try_from(value.clone()).ok().filter(|v| v.is_finite());
    let text = number.map_or_else(|| "–".into(), |v| words(scale * v));
    // Nothing has no sign.
    match text.contains(|c: char| ('1'..='9').contains(&c)) {
        true => text.replace('-', "−"),
        false => text.replace(['-', '+'], ""),
    }
}

fn three(v: f64) -> String {
    match v.abs() {
        0.0 => "0".into(),
        size if size < 1e-3 => format!("{v:.1e}"),
        size => format!("{v:.*}", (2 - size.log10().floor() as i32).max(0) as usize),
    }
}

/// A plot as part of a page: its colours and its font, as wide as its column, with an accessible title.
pub fn inline(svg: &str, alt: &str) -> String {
    let (head, body) = svg.split_once('>').unwrap_or(("", svg));
    let view = head.split_once("viewBox=\"").and_then(|(_, rest)| rest.split_once('"')).map_or("", |(view, _)| view);
    let alt = markup::escape(alt);
    let font = format!(" font-family=\"{}, Verdana, sans-serif\"", crate::text::FAMILY);
    let body = with_css_variables(body).replace(&font, "");
    format!("<svg role=\"img\" aria-label=\"{alt}\" viewBox=\"{view}\"><title>{alt}</title>{body}")
}
