//! `ibr characterize`

use super::inputs::quantity;
use crate::cli::CharacterizeArgs;
use crate::prelude::*;
use crate::shown::characterized::{FabricAnswer, text};
use compare::characterize::write::{fabric_toml, missing};
use compare::characterize::{FabricTests, Reduction, example};
use data::CouponDefaults;
use ibr::pages::characterized_files;

/// Seed of the example: the documents show its numbers.
const EXAMPLE_SEED: u64 = 1;

pub(super) fn run(args: &CharacterizeArgs, context: &mut Context) -> Result<Outcome, Failure> {
    if let Some(folder) = &args.example {
        return make_example(folder, context);
    }
    args.out.as_deref().map_or(Ok(()), check_folder)?;
    let settings = settings(args)?;
    let tests = FabricTests::read(&args.files, &defaults(args)?, &mut |what, share| (context.progress)(what, share))?;
    (context.progress)("reducing", None);
    let found = tests.reduce(&settings)?;
    let fabric = fabric_toml(&found, &settings, &program());
    let mut text = text(&found);
    if fabric.is_none() {
        text.push_str(&format!("No fabric.toml: {}\n", missing(&found)));
    }
    if let Some(folder) = &args.out {
        let files = characterized_files(&found, fabric.as_deref(), &program())?;
        spares_inputs(folder, &files, &args.files)?;
        write_files(folder, &files, &tests.files, context)?;
        let also = fabric.as_ref().map_or("", |_| ", fabric.toml");
        text.push_str(&format!("Plots, tables{also} in {}\n", folder.display()));
    }
    Ok(Outcome::answer(text, "ibr.characterize", &FabricAnswer::of(&found, fabric.as_deref())))
}

fn settings(args: &CharacterizeArgs) -> Result<Reduction, Failure> {
    if !(args.modulus_to > 0.0 && args.modulus_to <= 50.0) {
        let message = format!("--modulus-to is {} per cent strain", args.modulus_to);
        return Err(Failure::usage(message, "write a number above 0 and up to 50, for example 1"));
    }
    if args.name.trim().is_empty() {
        return Err(Failure::usage("--name is empty", "write a name for the fabric, for example silicone-nylon-mine"));
    }
    let (name, modulus_strain) = (args.name.trim().to_string(), 0.01 * args.modulus_to);
    Ok(Reduction { name, modulus_strain, any_modulus: args.any_modulus })
}

/// What holds where a file says nothing.
fn defaults(args: &CharacterizeArgs) -> Result<CouponDefaults, Failure> {
    let length = |option: &str, text: &Option<String>| {
        text.as_ref().map(|text| quantity(option, text, Quantity::Length)).transpose()
    };
    Ok(CouponDefaults {
        direction_deg: args.direction,
        width_m: length("--width", &args.width)?,
        length_m: length("--length", &args.length)?,
        thickness_m: length("--thickness", &args.thickness)?,
        columns: args.columns.iter().map(|name| name.trim().to_string()).collect(),
    })
}

fn make_example(folder: &Path, context: &mut Context) -> Result<Outcome, Failure> {
    let files = write_example(folder, example::example(EXAMPLE_SEED), context)?;
    let text = format!(
        "Made-up tests of a fabric with E0 = 96.5, E90 = 120, G12 = 1.03 MPa and locking at 45°\nibr characterize {}\n",
        files.join(" ")
    );
    Ok(Outcome::answer(text, "ibr.characterize.example", &CharacterizeExample { files }))
}

/// `ibr.characterize.example`: `ibr characterize --example FOLDER`
#[derive(Serialize)]
struct CharacterizeExample {
    /// Files that were written
    files: Vec<String>,
}
