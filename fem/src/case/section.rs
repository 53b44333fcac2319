//! `[part]` tables: parts of the mesh and the plies of their sections.

use super::law::{self, Fabrics};
use super::range::{
    ANGLE, Checked, DENSITY, Num, Range, Text, at_once, direction, optional, plain, refuse, si, unknown_name,
};
use super::raw::{RawCase, RawPart};
use crate::mesh::{Mesh, Part};
use crate::problem::start::{has_directions, warp_fault};
use crate::problem::{Ply, Section};
use crate::vec3::V3;
use spelling::Exactly;
use std::sync::Arc;
use toml::{Spanned, Value};

/// The entry of all parts that have none of their own.
const ALL: &str = "all";
const BENDING: Range = plain(0.0, 10.0, "1 is a solid film, 0.1 coated woven fabric, 0 a membrane");

/// Forgets the warp that the mesh has where the case has another.
pub(super) fn forget_warps(raw: &RawCase, mesh: &mut Mesh) {
    let replaced = |part: &&mut Part| entry(raw, part).is_ok_and(|table| table.get_ref().warp.is_some());
    for part in mesh.parts.iter_mut().filter(replaced) {
        part.warp.clear();
    }
}

/// One section per part of the mesh, in its order; parts get their warp. `unread`: orientations of the mesh file that were not understood.
pub(super) fn sections(raw: &RawCase, mesh: &mut Mesh, unread: &[(String, String)]) -> Checked<Vec<Section>> {
    let fabrics = law::fabrics(&raw.fabric)?;
    let mut known: Vec<&str> = mesh.part_names();
    known.push(ALL);
    if let Some(name) = raw.part.keys().find(|name| !known.contains(&name.get_ref().as_str())) {
        return Err(unknown_name("part", name, &known));
    }
    let mut sections = Vec::new();
    for i in 0..mesh.parts.len() {
        let table = entry(raw, &mesh.parts[i])?;
        let section = section(table, &fabrics)?;
        let warp = table.get_ref().warp.as_ref();
        if let Some(value) = warp {
            mesh.parts[i].warp = vec![direction_of(value)?];
        }
        let part = &mesh.parts[i];
        if let Some((message, help)) = warp_fault(mesh, part, &section) {
            let help = format!("try {help}");
            return refuse(message, help, warp.map_or(table.span(), Spanned::span));
        }
        let foreign = unread.iter().find(|(name, _)| warp.is_none() && *name == part.name);
        if let Some((name, what)) = foreign.filter(|_| has_directions(&section)) {
            let message = format!("part `{name}` of the mesh file has {what}, which is not read");
            let help = format!(
                "write warp = \"x\" (or \"y\", \"z\", [x, y, z]) into [part.{name}]: it is laid onto every element; where the warp turns, \
                 make several parts"
            );
            return refuse(message, help, table.span());
        }
        sections.push(section);
    }
    Ok(sections)
}

/// An axis by its letter, or a vector.
fn direction_of(value: &Spanned<Value>) -> Checked<V3> {
    let numbers = |list: &[Value]| {
        let number = |v: &Value| v.as_float().or_else(|| v.as_integer().map(|i| i as f64));
        list.iter().map(number).collect::<Option<Vec<f64>>>()
    };
    match value.get_ref() {
        Value::String(text) if text == "x" => return Ok([1.0, 0.0, 0.0]),
        Value::String(text) if text == "y" => return Ok([0.0, 1.0, 0.0]),
        Value::String(text) if text == "z" => return Ok([0.0, 0.0, 1.0]),
        Value::Array(list) => {
            if let Some(&[x, y, z]) = numbers(list).as_deref() {
                return direction("warp", &Spanned::new(value.span(), Exactly([x, y, z])));
            }
        }
        _ => {}
    }
    let message = format!("warp = {} is not understood", value.get_ref());
    let help = "write warp = \"x\", \"y\" or \"z\", or a vector such as [0, 1, 0.5]";
    refuse(message, help, value.span())
}

fn entry<'a>(raw: &'a RawCase, part: &Part) -> Checked<&'a Spanned<RawPart>> {
    let named = |wanted: &str| raw.part.iter().find(|(name, _)| name.get_ref() == wanted).map(|(_, table)| table);
    match named(&part.name).or_else(|| named(ALL)) {
        Some(table) => Ok(table),
        None => {
            let message = format!("the mesh has a part `{}` without a fabric", part.name);
            let help = format!("add [part.{}], or [part.all] for all parts without their own", part.name);
            refuse(message, help, raw.mesh.span())
        }
    }
}

fn section(table: &Spanned<RawPart>, fabrics: &Fabrics) -> Checked<Section> {
    let raw = table.get_ref();
    Ok(Section {
        plies: plies(table, fabrics)?,
        bonded: raw.bonded.unwrap_or(false),
        density_kg_m3: si("density_kg_m3", &raw.density_kg_m3, &DENSITY)?,
        bending_factor: optional("bending_factor", &raw.bending_factor, &BENDING)?.unwrap_or(0.1),
        rest_curvature: raw.rest_curvature.unwrap_or(false),
    })
}

fn plies(table: &Spanned<RawPart>, fabrics: &Fabrics) -> Checked<Vec<Ply>> {
    let raw = table.get_ref();
    match (&raw.fabric, &raw.plies) {
        (Some(name), None) => Ok(vec![ply(name, &raw.angle_deg, fabrics)?]),
        (None, Some(plies)) if plies.get_ref().is_empty() => {
            let message = "a part without a ply";
            let help = "write for example plies = [{ fabric = \"film\" }]";
            refuse(message, help, plies.span())
        }
        (None, Some(plies)) => {
            if let Some(angle) = &raw.angle_deg {
                let message = "angle_deg together with plies";
                let help = "write the angle into each ply";
                return refuse(message, help, angle.span());
            }
            plies.get_ref().iter().map(|p| ply(&p.fabric, &p.angle_deg, fabrics)).collect()
        }
        (Some(_), Some(plies)) => at_once("fabric and plies", plies.span()),
        (None, None) => refuse("a part without fabric", "write fabric = \"NAME\" of a [fabric.NAME]", table.span()),
    }
}

fn ply(name: &Text, angle: &Option<Num>, fabrics: &Fabrics) -> Checked<Ply> {
    let known: Vec<&str> = fabrics.keys().map(String::as_str).collect();
    let Some(fabric) = fabrics.get(name.get_ref()) else { return Err(unknown_name("fabric", name, &known)) };
    Ok(Ply { fabric: Arc::clone(fabric), angle_rad: optional("angle_deg", angle, &ANGLE)?.unwrap_or(0.0) })
}
