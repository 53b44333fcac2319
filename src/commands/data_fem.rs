//! `ibr data fem`: marker data from finite element runs.

use super::breakdown::{changed, list};
use super::data::{about, folder_is_free, pressure_scatter, scatter};
use super::inputs;
use super::simulate::{Keeper, named, pressures, rounded};
use super::{Context, Outcome};
use crate::cli::DataFem;
use crate::failure::{Failure, INTERRUPTED};
use crate::output::{check_folder, write_files};
use compare::study::Generator;
use compare::study::engines::{FeRun, ensembles, stored};
use compare::study::pages::Files;
use compare::study::seen::seen;
use models::Scenario;
use models::scenario::quantity::Quantity;
use serde_json::json;

pub fn run(args: &DataFem, context: &mut Context) -> Result<Outcome, Failure> {
    check_folder(&args.out)?;
    folder_is_free(&args.out, args.force)?;
    let truth = inputs::scenario(&args.scenario)?;
    let kpa = pressures(&args.pressure)?;
    let body_kpa = match &args.body_pressure {
        Some(text) => match list("--body-pressure", text, Quantity::Pressure, 1e-3)? {
            none if none.is_empty() => {
                return Err(Failure::usage("--body-pressure names no pressure", "write for example 2kPa,4kPa"));
            }
            some => some,
        },
        None => vec![rounded(truth.scenario.p_body_pa * 1e-3)],
    };
    let of_body = |body: &f64| std::iter::once(0.0).chain(kpa.iter().copied()).map(|p| [body * 1e3, p * 1e3]).collect();
    let generator = Generator {
        seed: args.seed,
        runs: args.seeds as usize,
        protocol: body_kpa.iter().flat_map(|body| -> Vec<[f64; 2]> { of_body(body) }).collect(),
        camera_sd_m: scatter("--sigma", &args.scatter.sigma)?,
        alignment_sd_m: scatter("--alignment", &args.scatter.alignment)?,
        pressure_sd: pressure_scatter(args.scatter.pressure_scatter)?,
        ..Generator::default()
    };
    let Some(runs) = runs(args, &body_kpa, &kpa, context)? else {
        let note = "interrupted; finished runs are kept, the same command goes on".to_string();
        return Ok(Outcome { notes: vec![note], code: INTERRUPTED, ..Outcome::default() });
    };
    let name = args.out.file_name().map_or("fem".into(), |n| n.to_string_lossy().into_owned());
    let dataset = seen(&runs, &name, &generator)?;
    let mut csv = Vec::new();
    data::write_markers_csv(&dataset, &mut csv)?;
    let mut about = about(&truth.scenario, &dataset, &generator);
    let first = &runs[0];
    about.title =
        format!("Finite element markers of {}, {} runs with imperfections of their own", first.scenario, args.seeds);
    about.source = format!(
        "synthetic: finite elements, engine {}, {} mm elements, numbers {}; ibr data fem, seed {}",
        first.engine, first.mesh_mm[1], first.known, args.seed
    );
    let mut files = Files::default();
    files.files.push(("about.toml".into(), data::about_toml(&about).into_bytes()));
    files.files.push(("markers.csv".into(), csv));
    files.files.push(("truth.toml".into(), truth.text.into_bytes()));
    write_files(&args.out, &files, &[truth.input], context)?;
    let text =
        format!("{} values of {} finite element runs in {}\n", dataset.xy_m.len(), runs.len(), args.out.display());
    let answer = json!({"schema": "ibr.data.fem", "version": 1, "folder": args.out, "runs": dataset.runs.len()});
    Ok(Outcome::new(text, answer))
}

/// One run for every seed and body pressure, those that come with the program or those of a folder, which gets what is missing.
fn runs(args: &DataFem, body_kpa: &[f64], kpa: &[f64], context: &mut Context) -> Result<Option<Vec<FeRun>>, Failure> {
    let robot = named(&args.scenario)?;
    let (scenario, _) = robot.robot_run()?;
    if args.stored {
        let mut all = Vec::new();
        for body in body_kpa {
            let [own, _] = ensembles(&stored(), &Scenario { p_body_pa: body * 1e3, ..scenario.clone() });
            let found: Vec<FeRun> = own.runs.into_iter().take(args.seeds as usize).collect();
            if found.len() < args.seeds as usize {
                let (there, what) = (found.len(), &args.scenario);
                let message = format!(
                    "{there} finite element runs of {what} at {body} kPa body pressure come with the program, not {}",
                    args.seeds
                );
                return Err(Failure::usage(message, "lower --seeds, or leave --stored out to make them: minutes each"));
            }
            all.extend(found);
        }
        return Ok(Some(all));
    }
    let keeper = Keeper { folder: args.runs.clone(), threads: args.threads as usize };
    let mut cases = Vec::new();
    for seed in 1..=args.seeds {
        for body in body_kpa {
            let changes = [("seed".into(), seed.to_string()), ("pressures_kpa".into(), format!("{kpa:?}"))];
            let own = rounded(scenario.p_body_pa * 1e-3) == *body;
            let case =
                if own { robot.with(&changes)? } else { changed(&robot, &scenario, *body, None)?.with(&changes)? };
            cases.push((case, format!("seed {seed}, body {body} kPa")));
        }
    }
    match keeper.run_all(&cases, context)? {
        Ok(made) => made.into_iter().collect::<Result<Vec<FeRun>, Failure>>().map(Some),
        Err(_) => Ok(None),
    }
}
