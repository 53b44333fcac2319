//! `ibr characterize`

use super::inputs::quantity;
use super::{Context, Outcome};
use crate::cli::Characterize;
use crate::failure::Failure;
use crate::output::{Input, check_folder, program, write_files};
use crate::shown::characterized::{text, to_json};
use compare::characterize::write::{fabric_toml, measured_toml, shear_table, yarn_table};
use compare::characterize::{Characterized, Settings, characterize, example};
use data::bench::bending_lengths_m;
use data::{Bench, Coupon, CouponDefaults, Table, bench, parse_coupons, read_coupons};
use ibr::pages::Files;
use models::scenario::quantity::Quantity;
use serde_json::json;
use std::path::Path;

/// Seed of the example: the documents show its numbers.
const EXAMPLE_SEED: u64 = 1;

pub fn run(args: &Characterize, context: &mut Context) -> Result<Outcome, Failure> {
    if let Some(folder) = &args.example {
        return make_example(folder, context);
    }
    args.out.as_deref().map_or(Ok(()), check_folder)?;
    let settings = settings(args)?;
    let Read { coupons, bent, inputs } = read(args, context)?;
    (context.progress)("reducing", None);
    let mut found = characterize(&coupons, &settings)?;
    for table in &bent {
        found.bend(&bending_lengths_m(table), table.provenance.word());
    }
    let fabric = fabric_toml(&found, &settings, &program());
    let mut text = text(&found);
    if fabric.is_none() {
        text.push_str(&format!("No fabric.toml: {}\n", missing(&found)));
    }
    if let Some(folder) = &args.out {
        let files = files(&found, fabric.as_deref())?;
        spares_inputs(folder, &files, &args.files)?;
        write_files(folder, &files, &inputs, context)?;
        text.push_str(&format!(
            "Plots, tables{} in {}\n",
            fabric.as_ref().map_or("", |_| ", fabric.toml"),
            folder.display()
        ));
    }
    Ok(Outcome::new(text, to_json(&found, fabric.as_deref())))
}

fn settings(args: &Characterize) -> Result<Settings, Failure> {
    if !(args.modulus_to > 0.0 && args.modulus_to <= 50.0) {
        let message = format!("--modulus-to is {} per cent strain", args.modulus_to);
        return Err(Failure::usage(message, "write a number above 0 and up to 50, for example 1"));
    }
    if args.name.trim().is_empty() {
        return Err(Failure::usage("--name is empty", "write a name for the fabric, for example silicone-nylon-mine"));
    }
    let (name, modulus_strain) = (args.name.trim().to_string(), 0.01 * args.modulus_to);
    Ok(Settings { name, modulus_strain, any_modulus: args.any_modulus })
}

/// What the files hold.
struct Read {
    coupons: Vec<Coupon>,
    /// Cantilever tests.
    bent: Vec<Bench>,
    inputs: Vec<Input>,
}

fn read(args: &Characterize, context: &mut Context) -> Result<Read, Failure> {
    let length = |option: &str, text: &Option<String>| {
        text.as_ref().map(|text| quantity(option, text, Quantity::Length)).transpose()
    };
    let defaults = CouponDefaults {
        direction_deg: args.direction,
        width_m: length("--width", &args.width)?,
        length_m: length("--length", &args.length)?,
        thickness_m: length("--thickness", &args.thickness)?,
        columns: args.columns.iter().map(|name| name.trim().to_string()).collect(),
    };
    let (mut coupons, mut bent, mut inputs) = (Vec::new(), Vec::new(), Vec::new());
    for file in &args.files {
        (context.progress)(&format!("reading {file}"), None);
        if let Some(table) = bench(file)? {
            if table.kind.name != "bending_length" {
                let message = format!("{file} is a {} table, not a test of a fabric", table.kind.name);
                return Err(Failure::usage(message, format!("`ibr compare {file}` holds it against its model")));
            }
            inputs.push(Input::of(file, &std::fs::read(file).unwrap_or_default()));
            bent.push(table);
            continue;
        }
        // The bytes are hashed for the manifest; a file that cannot be read is refused by the reader.
        coupons.extend(match std::fs::read(file) {
            Ok(bytes) => {
                inputs.push(Input::of(file, &bytes));
                parse_coupons(file, &mut bytes.as_slice(), bytes.len() as u64, &defaults, &mut |_, _| ())?
            }
            Err(_) => read_coupons(Path::new(file), &defaults, &mut |_, _| ())?,
        });
    }
    Ok(Read { coupons, bent, inputs })
}

fn make_example(folder: &Path, context: &mut Context) -> Result<Outcome, Failure> {
    check_folder(folder)?;
    let made = example::example(EXAMPLE_SEED);
    if let Some((name, _)) = made.iter().find(|(name, _)| folder.join(name).exists()) {
        let message = format!("{} exists", folder.join(name).display());
        return Err(Failure::usage(message, "give another folder to --example"));
    }
    let names: Vec<String> = made.iter().map(|(name, _)| folder.join(name).display().to_string()).collect();
    let files = made.into_iter().map(|(name, text)| (name, text.into_bytes())).collect();
    write_files(folder, &Files { files, ..Files::default() }, &[], context)?;
    let text = format!(
        "Made-up tests of a fabric with E0 = 96.5, E90 = 120, G12 = 1.03 MPa and locking at 45°\nibr characterize {}\n",
        names.join(" ")
    );
    Ok(Outcome::new(text, json!({"schema": "ibr.characterize.example", "version": 1, "files": names})))
}

/// What would have to be there for a fabric table.
fn missing(found: &Characterized) -> &'static str {
    if found.thickness_m.is_none() {
        "the thickness is missing; add --thickness 0.05mm or # thickness_mm: 0.05 in the files"
    } else {
        "a law needs specimens pulled along warp or fill; woven and orthotropic need 0°, 45° and 90°"
    }
}

fn files(found: &Characterized, fabric: Option<&str>) -> Result<Files, Failure> {
    let mut files = Files::default();
    for (name, drawn) in ibr::pages::pictures(found)? {
        files.files.push((format!("{name}.svg"), drawn.svg.into_bytes()));
        files.files.push((format!("{name}.png"), drawn.png));
    }
    let yarns = found.yarns.iter().map(|y| (y.direction.word(), yarn_table(&y.rows, &y.sd_pa)));
    let shear = found.shear.iter().map(|s| ("shear", shear_table(s, found.thickness_m)));
    for (name, rows) in yarns.chain(shear) {
        files.files.push((format!("mean_{name}.csv"), csv(&rows)?));
    }
    files.files.extend(fabric.map(|text| ("fabric.toml".to_string(), text.as_bytes().to_vec())));
    files.files.extend(measured_toml(found, &program()).map(|text| ("measured.toml".to_string(), text.into_bytes())));
    Ok(files)
}

/// Refuses to write over a file that was read.
fn spares_inputs(folder: &Path, files: &Files, inputs: &[String]) -> Result<(), Failure> {
    let read: Vec<_> = inputs.iter().filter_map(|file| std::fs::canonicalize(file).ok()).collect();
    let same = |name: &&String| std::fs::canonicalize(folder.join(name)).is_ok_and(|path| read.contains(&path));
    match files.files.iter().map(|(name, _)| name).find(same) {
        Some(name) => {
            let message = format!("{} was read and would be written over", folder.join(name).display());
            Err(Failure::usage(message, "choose another folder with --out"))
        }
        None => Ok(()),
    }
}

fn csv(rows: &Table) -> Result<Vec<u8>, Failure> {
    let mut bytes = Vec::new();
    rows.to_csv(&mut bytes)?;
    Ok(bytes)
}
