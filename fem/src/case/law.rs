//! Fabrics: the numbers and tables of one law, read by the catalogue of `models::fabrics`.

use super::range::{
    ANGLE, Checked, FreeTable, Range, THICKNESS, Text, at_once, find, number, optional, plain, plain_number, refuse,
    text, unknown_name,
};
use super::raw::RawPly;
use crate::FemError;
use models::Fabric;
use models::fabrics::{self, FABRICS, Law, LawParameter, MATERIALS, Recipe};
use serde::Deserialize;
use std::collections::BTreeMap;
use std::sync::Arc;
use toml::{Spanned, Value};

/// Fabrics made so far, by name.
pub(super) type Fabrics = BTreeMap<String, Arc<dyn Fabric>>;

/// Makes all `[fabric.NAME]`; a laminate comes after the fabrics of its plies.
pub(super) fn fabrics(tables: &BTreeMap<Text, Spanned<FreeTable>>) -> Checked<Fabrics> {
    let mut made = Fabrics::new();
    let names: Vec<&str> = tables.keys().map(|name| name.get_ref().as_str()).collect();
    while made.len() < tables.len() {
        let ready = |name: &String| made.contains_key(name);
        let next = tables.iter().filter(|(name, _)| !ready(name.get_ref())).find_map(|(name, table)| {
            let parts = plies(table).and_then(|plies| known_parts(&plies, &names).map(|()| plies));
            match parts {
                Err(error) => Some(Err(error)),
                Ok(plies) if plies.iter().all(|p| ready(p.fabric.get_ref())) => Some(Ok((name, table, plies))),
                Ok(_) => None,
            }
        });
        let Some(next) = next else { return circular(tables, &made) };
        let (name, table, plies) = next?;
        let sheet = fabric(table, &plies, &made)?;
        made.insert(name.get_ref().clone(), sheet);
    }
    Ok(made)
}

fn known_parts(plies: &[RawPly], names: &[&str]) -> Checked<()> {
    match plies.iter().find(|p| !names.contains(&p.fabric.get_ref().as_str())) {
        Some(ply) => Err(unknown_name("fabric", &ply.fabric, names)),
        None => Ok(()),
    }
}

fn circular<T>(tables: &BTreeMap<Text, Spanned<FreeTable>>, made: &Fabrics) -> Checked<T> {
    let left = tables.keys().find(|name| !made.contains_key(name.get_ref()));
    let (name, span) = left.map_or(("", 0..0), |name| (name.get_ref().as_str(), name.span()));
    let message = format!("the fabric `{name}` is made of itself");
    let help = "name plies that are other fabrics";
    refuse(message, help, span)
}

/// One sheet of a fabric that is made of others. Places inside a value that was read before are not known.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Sheet {
    fabric: String,
    angle_deg: Option<f64>,
}

/// The plies of a fabric that is made of others.
fn plies(table: &Spanned<FreeTable>) -> Checked<Vec<RawPly>> {
    let Some(value) = find(table.get_ref(), "plies") else { return Ok(Vec::new()) };
    let read: Result<Vec<Sheet>, toml::de::Error> = value.get_ref().clone().try_into();
    let sheets = read.or_else(|error| {
        let message = format!("plies: {}", error.message().lines().next().unwrap_or_default());
        let help = "write for example plies = [{ fabric = \"film\", angle_deg = 45 }]";
        refuse(message, help, value.span())
    })?;
    let placed = |sheet: Sheet| RawPly {
        fabric: Spanned::new(value.span(), sheet.fabric),
        angle_deg: sheet.angle_deg.map(|angle| Spanned::new(value.span(), angle)),
    };
    Ok(sheets.into_iter().map(placed).collect())
}

fn fabric(table: &Spanned<FreeTable>, plies: &[RawPly], made: &Fabrics) -> Checked<Arc<dyn Fabric>> {
    let (law, mut recipe) = law(table)?;
    for ply in plies {
        let angle_rad = optional("angle_deg", &ply.angle_deg, &ANGLE)?.unwrap_or(0.0);
        let sheet = made.get(ply.fabric.get_ref()).cloned();
        recipe.plies.extend(sheet.map(|fabric| fabrics::Ply { fabric, angle_rad }));
    }
    let own = |key: &Text| !matches!(key.get_ref().as_str(), "law" | "material" | "plies");
    for (key, value) in table.get_ref().iter().filter(|(key, _)| own(key)) {
        let name = key.get_ref().clone();
        if let Some(parameter) = law.parameters.iter().find(|p| p.key == name) {
            recipe.numbers.insert(name, value_of(parameter, value)?);
        } else if law.curves.iter().any(|c| c.key == name) {
            recipe.curves.insert(name, rows(key, value)?);
        } else {
            let keys: Vec<&str> =
                law.parameters.iter().map(|p| p.key).chain(law.curves.iter().map(|c| c.key)).collect();
            return Err(unknown_name(&format!("key of law \"{}\"", law.name), key, &keys));
        }
    }
    (law.make)(&recipe).map_err(|message| FemError::case(message, table.span()))
}

/// The law, and the recipe to start from: empty, or the recipe of a known material.
fn law(table: &Spanned<FreeTable>) -> Checked<(&'static Law, Recipe)> {
    let laws: Vec<&str> = FABRICS.iter().map(|l| l.name).collect();
    let materials: Vec<&str> = MATERIALS.iter().map(|m| m.name).collect();
    match (find(table.get_ref(), "law"), find(table.get_ref(), "material")) {
        (Some(law), None) => {
            let name = text("law", law)?;
            let found = fabrics::by_name(name.get_ref()).map(|law| (law, Recipe::default()));
            found.ok_or_else(|| unknown_name("law", &name, &laws))
        }
        (None, Some(material)) => {
            let name = text("material", material)?;
            let found = fabrics::material(name.get_ref()).and_then(|m| Some((m.law()?, m.recipe())));
            found.ok_or_else(|| unknown_name("material", &name, &materials))
        }
        (Some(_), Some(material)) => at_once("law and material", material.span()),
        (None, None) => {
            let help = format!("add law = one of {}; or material = one of {}", laws.join(", "), materials.join(", "));
            refuse("a fabric without law", help, table.span())
        }
    }
}

/// A number as the recipe wants it: in the unit of the key.
fn value_of(p: &LawParameter, value: &Spanned<Value>) -> Checked<f64> {
    let v = plain_number(p.key, value)?;
    if p.key == "thickness_mm" {
        number(p.key, v, value.span(), &THICKNESS)?;
    }
    let unit = if p.unit == "-" { "" } else { p.unit };
    let range = Range { unit, too_small: p.meaning, ..plain(p.lower, p.upper, slip(p)) };
    number(p.key, v, value.span(), &range)
}

/// What was probably meant by a number that is too large.
fn slip(p: &LawParameter) -> &'static str {
    match p.unit {
        "MPa" => "this looks like pascals: write megapascals, for example 588 for 588e6 Pa",
        _ if p.key.starts_with("nu") => {
            "an incompressible sheet is law = \"neo-hookean\"; films have 0.3 to 0.45, woven fabrics 0 to 0.4"
        }
        _ => p.meaning,
    }
}

fn rows(key: &Text, value: &Spanned<Value>) -> Checked<Vec<[f64; 2]>> {
    let row = |v: &Value| {
        let pair: Option<Vec<f64>> = v.as_array()?.iter().map(real).collect();
        pair.and_then(|pair| <[f64; 2]>::try_from(pair).ok())
    };
    let message = format!("{} must be a table of pairs", key.get_ref());
    let read: Option<Vec<[f64; 2]>> = value.get_ref().as_array().and_then(|list| list.iter().map(row).collect());
    read.map_or_else(|| refuse(message, "write for example [[0, 0], [0.01, 2.1]]", value.span()), Ok)
}

fn real(value: &Value) -> Option<f64> {
    value.as_float().or_else(|| value.as_integer().map(|i| i as f64))
}
