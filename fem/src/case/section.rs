//! Parts and their plies.

use super::law::{self, Fabrics};
use super::range::{ANGLE, Checked, DENSITY, Range, optional, plain, refuse, si, unknown_name};
use super::raw::{Num, Raw, RawPart, Text};
use crate::mesh::{Mesh, Part};
use crate::problem::{Ply, Section};
use std::sync::Arc;
use toml::Spanned;

/// The entry of all parts that have none of their own.
const ALL: &str = "all";
const BENDING: Range = plain(0.0, 10.0, "1 is a solid film, 0.1 coated woven fabric, 0 a membrane");

/// One section per part of the mesh, in its order.
pub(super) fn sections(raw: &Raw, mesh: &Mesh) -> Checked<Vec<Section>> {
    let fabrics = law::fabrics(&raw.fabric)?;
    let mut known: Vec<&str> = mesh.parts.iter().map(|p| p.name.as_str()).collect();
    known.push(ALL);
    if let Some(name) = raw.part.keys().find(|name| !known.contains(&name.get_ref().as_str())) {
        return Err(unknown_name("part", name, &known));
    }
    mesh.parts.iter().map(|part| section(entry(raw, part)?, &fabrics)).collect()
}

fn entry<'a>(raw: &'a Raw, part: &Part) -> Checked<&'a Spanned<RawPart>> {
    let named = |wanted: &str| raw.part.iter().find(|(name, _)| name.get_ref() == wanted).map(|(_, table)| table);
    match named(&part.name).or_else(|| named(ALL)) {
        Some(table) => Ok(table),
        None => {
            let message = format!("the mesh has a part `{}`, and nothing says how it is made", part.name);
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
            refuse("a part without a ply", "write for example plies = [{ fabric = \"film\" }]", plies.span())
        }
        (None, Some(plies)) => {
            if let Some(angle) = &raw.angle_deg {
                return refuse("angle_deg beside plies", "write the angle into each ply", angle.span());
            }
            plies.get_ref().iter().map(|p| ply(&p.fabric, &p.angle_deg, fabrics)).collect()
        }
        (Some(_), Some(plies)) => refuse("fabric and plies at once", "keep one of the two", plies.span()),
        (None, None) => refuse("a part without fabric", "write fabric = \"NAME\" of a [fabric.NAME]", table.span()),
    }
}

fn ply(name: &Text, angle: &Option<Num>, fabrics: &Fabrics) -> Checked<Ply> {
    let known: Vec<&str> = fabrics.keys().map(String::as_str).collect();
    let Some(fabric) = fabrics.get(name.get_ref()) else { return Err(unknown_name("fabric", name, &known)) };
    Ok(Ply { fabric: Arc::clone(fabric), angle_rad: optional("angle_deg", angle, &ANGLE)?.unwrap_or(0.0) })
}
