use super::inputs::quantity;
use crate::cli::CharacterizeArgs;
use crate::prelude::*;
use compare::characterize::write::{fabric_toml, measured_toml, missing};
use compare::characterize::{
    Characterized, FabricNumber, FabricTests, Reduction, Replay, Specimen, directions, example,
};
use data::{CouponDefaults, Direction};
use ibr::pages::characterized_files;

/// Seed of the example: the documents show its numbers.
const EXAMPLE_SEED: u64 = 1;

pub(super) fn run(args: &CharacterizeArgs, context: &mut Context) -> Result<Outcome> {
    if let Some(folder) = &args.example {
        return make_example(folder, context);
    }
    args.out.as_deref().map_or(Ok(()), check_folder)?;
    let settings = settings(args)?;
    let tests = FabricTests::read(&args.files, &defaults(args)?, &mut |what, share| (context.progress)(what, share))?;
    (context.progress)("reducing", None);
    let found = tests.reduce(&settings)?;
    let fabric = fabric_toml(&found, &settings, &program());
    let mut text = shown(&found);
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
    Ok(Outcome::answer(text, "ibr.characterize", &fabric_answer(&found, fabric.as_deref())))
}

fn settings(args: &CharacterizeArgs) -> Result<Reduction> {
    let message = format!("--modulus-to is {} per cent strain", args.modulus_to);
    let help = "write a number above 0 and up to 50, for example 1";
    refuse_if(!(args.modulus_to > 0.0 && args.modulus_to <= 50.0), message, help)?;
    let help = "write a name for the fabric, for example silicone-nylon-mine";
    refuse_if(args.name.trim().is_empty(), "--name is empty", help)?;
    let (name, modulus_strain) = (args.name.trim().to_string(), 0.01 * args.modulus_to);
    Ok(Reduction { name, modulus_strain, any_modulus: args.any_modulus })
}

fn defaults(args: &CharacterizeArgs) -> Result<CouponDefaults> {
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

fn make_example(folder: &Path, context: &mut Context) -> Result<Outcome> {
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
    /// Files of made-up tests that were written
    files: Vec<String>,
}

fn shown(found: &Characterized) -> String {
    let count = |d: Direction| format!("{} at {}°", found.of(d).count(), d.degrees());
    let directions = directions(&found.specimens).into_iter().map(count).collect::<Vec<_>>().join(", ");
    let directions = if directions.is_empty() { "none was pulled".into() } else { directions };
    let mut text = format!("Specimens: {directions} ({})\n", found.provenance.word());
    text += &TextTable::of(&found.quantities)
        .words("quantity", |q| &q.name)
        .words("how known", |q| &q.known)
        .right("mean", |q| digits(Some(q.scatter.mean)))
        .right("unit", |q| q.unit)
        .right("95 % interval of the mean", |q| {
            q.scatter.interval().map_or("–".into(), |ends| ends.map(|end| digits(Some(end))).join(" – "))
        })
        .right("sd", |q| digits(q.scatter.sd))
        .right("n", |q| q.scatter.n.to_string())
        .text();
    let pulled = TextTable::of(&found.specimens)
        .words("specimen", |s| &s.name)
        .right("direction", |s| format!("{}°", s.direction.degrees()))
        .number("slack [%]", 3, |s| Some(100.0 * s.slack).filter(|slack| *slack > 0.0))
        .right("modulus [MPa]", |s| digits(s.modulus_pa.map(|e| 1e-6 * e)))
        .right("C10 [MPa]", |s| digits(s.c10_pa.map(|c| 1e-6 * c[0])))
        .number("largest strain [%]", 1, |s| largest_strain(s).map(|e| 100.0 * e))
        .number("locking [°]", 1, |s| locking_rad(s).map(f64::to_degrees))
        .text();
    text += if found.specimens.is_empty() { "" } else { &pulled };
    if !found.replays.is_empty() {
        text +=
            "Every test by the law that was made of them: law over test, at the end and rms of the largest stress\n";
        text += &TextTable::of(&found.replays)
            .words("law", |r| &r.law)
            .words("specimen", |r| &r.specimen)
            .words("direction", |r| format!("{}°", r.direction_deg))
            .words("used", |r| if r.used { "for the law" } else { "check" })
            .right("at the end", |r| format!("{:+.1} %", 100.0 * r.at_end))
            .right("rms", |r| format!("{:.1} %", 100.0 * r.rms))
            .text();
    }
    text + &lines("look at: ", &found.warnings) + &lines("note: ", &found.notes)
}

fn locking_rad(s: &Specimen) -> Option<f64> {
    Some(s.strip.as_ref()?.locking?.angle)
}

fn largest_strain(s: &Specimen) -> Option<f64> {
    let stretched = || s.strip.as_ref().and_then(|strip| Some(strip.pulled.last()?[0] / strip.size.length_m));
    s.stress.last().map(|row| row[0]).or_else(stretched)
}

fn digits(x: Option<f64>) -> String {
    let decimals = |x: f64| (3 - x.abs().max(1e-3).log10().floor() as i32).clamp(0, 6) as usize;
    x.map_or("–".into(), |x| format!("{x:.0$}", decimals(x)))
}

/// `ibr.characterize`: `ibr characterize FILES`
#[derive(Serialize)]
struct FabricAnswer<'a> {
    /// How the tests came to be
    provenance: Provenance,
    /// Means of the measured quantities over all specimens
    quantities: Vec<FabricQuantity<'a>>,
    /// Numbers that were read from each specimen
    specimens: Vec<SpecimenRead<'a>>,
    /// Curve along the warp: strain, stress
    warp_strain_pa: Option<&'a [[f64; 2]]>,
    /// Curve along the fill: strain, stress
    fill_strain_pa: Option<&'a [[f64; 2]]>,
    /// Shear curve: shear angle, shear force per length
    shear_rad_n_per_m: Option<&'a [[f64; 2]]>,
    /// Shear curve: shear angle, shear stress
    shear_rad_pa: Option<&'a [[f64; 2]]>,
    /// Thickness of the fabric in the tests
    thickness_m: Option<f64>,
    /// Tests of the specimens recomputed with the fitted law
    replays: &'a [Replay],
    /// Reasons to doubt a number or the law
    warnings: &'a [String],
    /// Remarks on what was assumed and left out
    notes: &'a [String],
    /// Text of a fabric table for finite element cases
    fabric_toml: Option<&'a str>,
    /// Lines that record the measured numbers in about.toml
    measured_toml: Option<String>,
}

#[derive(Serialize)]
struct FabricQuantity<'a> {
    #[serde(flatten)]
    number: &'a FabricNumber,
    /// 95 % interval of the mean
    interval: Option<[f64; 2]>,
}

/// What was read of a specimen.
#[derive(Serialize)]
struct SpecimenRead<'a> {
    /// Name of the specimen in the file
    specimen: &'a str,
    /// File in which the specimen was found
    file: &'a str,
    /// Direction of the pull to the warp
    direction_deg: f64,
    /// Modulus of the pulled direction, from rows of small strain
    modulus_pa: Option<f64>,
    /// Strain up to which it was taken
    modulus_to_strain: f64,
    /// Strain subtracted as slack of the specimen in its grips
    slack_strain: f64,
    /// Poisson's ratio of the pulled direction
    poisson: Option<f64>,
    /// Constant C10 of the neo-Hookean law over the whole curve
    c10_pa: Option<f64>,
    /// Shear angle at which the fabric locks
    locking_rad: Option<f64>,
    /// Curve of shear angle and shear force per length
    shear_rad_n_per_m: Option<&'a [[f64; 2]]>,
}

/// Of what was found, with the text of `fabric.toml` if there is one.
fn fabric_answer<'a>(found: &'a Characterized, fabric_toml: Option<&'a str>) -> FabricAnswer<'a> {
    let yarn = |direction| found.yarns.iter().find(|y| y.direction == direction).map(|y| &y.rows[..]);
    let quantity = |number: &'a FabricNumber| FabricQuantity { number, interval: number.scatter.interval() };
    let specimens = found.specimens.iter().map(|s| SpecimenRead {
        specimen: &s.name,
        file: &s.file,
        direction_deg: s.direction.degrees(),
        modulus_pa: s.modulus_pa,
        modulus_to_strain: s.modulus_strain,
        slack_strain: s.slack,
        poisson: s.poisson,
        c10_pa: s.c10_pa.map(|c| c[0]),
        locking_rad: locking_rad(s),
        shear_rad_n_per_m: s.strip.as_ref().map(|s| &s.shear[..]),
    });
    FabricAnswer {
        provenance: found.provenance,
        quantities: found.quantities.iter().map(quantity).collect(),
        specimens: specimens.collect(),
        warp_strain_pa: yarn(Direction::Warp),
        fill_strain_pa: yarn(Direction::Fill),
        shear_rad_n_per_m: found.shear.as_ref().map(|s| &s.rows[..]),
        shear_rad_pa: found.shear.as_ref().and_then(|s| s.moment_pa.as_deref()),
        thickness_m: found.thickness_m,
        replays: &found.replays,
        warnings: &found.warnings,
        notes: &found.notes,
        fabric_toml,
        measured_toml: measured_toml(found, &program()),
    }
}
