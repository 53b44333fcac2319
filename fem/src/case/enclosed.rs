//! Which parts of a foreign mesh enclose which chamber. The generators say it themselves.

use super::load::{open_axis, part_names};
use super::range::{Checked, Text, refuse};
use super::raw::{RawCase, RawChamber};
use crate::FemError;
use crate::mesh::enclose;
use crate::mesh::file::{MeshFile, Surface};
use toml::Spanned;

/// Gives the parts of a foreign mesh the chambers of the case.
pub(super) fn chambers(raw: &RawCase, file: &mut MeshFile) -> Checked<()> {
    let tables: Vec<(&Text, &Spanned<RawChamber>)> = raw.chamber.iter().collect();
    for (name, table) in &tables {
        if !file.format.is_empty() {
            walls(name, table, tables.len() == 1, file)?;
        } else if let Some(parts) = &table.get_ref().parts {
            let help = "remove parts: they are for mesh files, which name no chambers";
            let message = "the generator already names the parts that face the chamber";
            return refuse(message, help, parts.span());
        }
    }
    Ok(())
}

/// Gives the walls of one chamber their side: the case lists them, a surface of the file does, or all parts enclose a single chamber.
fn walls(name: &Text, table: &Spanned<RawChamber>, is_single: bool, file: &mut MeshFile) -> Checked<()> {
    let all: Vec<String> = file.mesh.parts.iter().map(|part| part.name.clone()).collect();
    let parts = match &table.get_ref().parts {
        Some(parts) => part_names(parts.get_ref(), &file.mesh)?,
        None => match surface(name, is_single, file)?.cloned() {
            Some(surface) => return faced(name, &surface, file),
            None if is_single => all.clone(),
            None if all.contains(name.get_ref()) => vec![name.get_ref().clone()],
            None => {
                let message = format!("the parts that enclose chamber `{}` are not given", name.get_ref());
                let help = format!("add parts = [\"{}\", …] to it; the parts are {}", all[0], all.join(", "));
                return refuse(message, help, name.span());
            }
        },
    };
    let numbers: Vec<usize> = (0..all.len()).filter(|i| parts.contains(&all[*i])).collect();
    let turned =
        match enclose(&mut file.mesh, name.get_ref(), &numbers, open_axis(table.get_ref())?.unwrap_or_default()) {
            Err(FemError::Mesh(message)) => return Err(FemError::case(message, name.span())),
            other => other?,
        };
    let over =
        if turned > 0 { format!("; {turned} elements were turned over to look out of it") } else { String::new() };
    file.told.push(format!("chamber `{}` is enclosed by {}{over}", name.get_ref(), parts.join(", ")));
    Ok(())
}

/// The surface of the file that is the chamber's: of its name, or the one that a pressure acts on.
fn surface<'a>(name: &Text, is_single: bool, file: &'a MeshFile) -> Checked<Option<&'a Surface>> {
    if let Some(named) = file.surfaces.iter().find(|surface| surface.name.eq_ignore_ascii_case(name.get_ref())) {
        return Ok(Some(named));
    }
    let pressed: Vec<&Surface> = file.surfaces.iter().filter(|surface| surface.is_pressed && is_single).collect();
    match pressed[..] {
        [] => Ok(None),
        [only] => Ok(Some(only)),
        _ => {
            let names: Vec<&str> = pressed.iter().map(|surface| surface.name.as_str()).collect();
            let message = format!("pressures act on {} surfaces of the file: {}", names.len(), names.join(", "));
            let help = "write a [chamber.NAME] for each, or parts = [\"…\"] into this one";
            refuse(message, help, name.span())
        }
    }
}

/// Gives the parts of a surface the chamber on its side.
fn faced(name: &Text, surface: &Surface, file: &mut MeshFile) -> Checked<()> {
    if let Some(fault) = &surface.fault {
        let help = "or write parts = [\"…\"] into the chamber";
        return refuse(fault, help, name.span());
    }
    for part in &mut file.mesh.parts {
        for (_, back) in surface.faces.iter().filter(|(face, _)| *face == part.name) {
            let slot = if *back { &mut part.back } else { &mut part.front };
            *slot = Some(name.get_ref().clone());
        }
    }
    file.told.push(format!("chamber `{}` is behind the surface `{}` of the file", name.get_ref(), surface.name));
    Ok(())
}
