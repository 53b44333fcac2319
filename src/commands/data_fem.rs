//! `ibr data fem`: marker data from finite element runs.

use super::breakdown::{changed, list};
use super::data::{about, folder_is_free, pressure_scatter, scatter};
use super::inputs;
use super::simulate::{Keeper, Named, named, pressures};
use super::{Context, Outcome};
use crate::cli::DataFem;
use crate::failure::{Failure, INTERRUPTED};
use crate::output::{check_folder, write_files};
use compare::study::Generator;
use compare::study::engines::{FeRun, ensemble, stored};
use compare::study::seen::seen;
use ibr::pages::Files;
use models::Scenario;
use models::scenario::quantity::Quantity;
use serde_json::json;

pub fn run(args: &DataFem, context: &mut Context) -> Result<Outcome, Failure> {
    check_folder(&args.out)?;
    folder_is_free(&args.out, args.force)?;
    let truth = inputs::scenario(&args.scenario)?;
    let (robot, scenario) = robot(args)?;
    let kpa = pressures(&args.pressure)?;
    let body_pa = scenario.p_body_pa;
    let generator = Generator {
        seed: args.seed,
        runs: args.seeds as usize,
        protocol: std::iter::once(0.0).chain(kpa.iter().map(|p| p * 1e3)).map(|p| [body_pa, p]).collect(),
        camera_sd_m: scatter("--sigma", &args.scatter.sigma)?,
        alignment_sd_m: scatter("--alignment", &args.scatter.alignment)?,
        pressure_sd: pressure_scatter(args.scatter.pressure_scatter)?,
        ..Generator::default()
    };
    let Some(runs) = runs(args, &robot, &scenario, &kpa, context)? else {
        let note = "interrupted; finished runs are kept, the same command goes on".to_string();
        return Ok(Outcome { notes: vec![note], code: INTERRUPTED, ..Outcome::default() });
    };
    let name = args.out.file_name().map_or("fem".into(), |n| n.to_string_lossy().into_owned());
    let dataset = seen(&runs, &name, &generator)?;
    let mut csv = Vec::new();
    data::write_markers_csv(&dataset, &mut csv)?;
    let mut about = about(&scenario, &dataset, &generator);
    let first = &runs[0];
    about.title =
        format!("Finite element markers of {}, {} runs with imperfections of their own", first.scenario, runs.len());
    about.source = format!(
        "synthetic: finite elements, engine {}, {} mm elements, numbers {}; ibr data fem, seed {}",
        first.engine, first.mesh_mm[1], first.known, args.seed
    );
    let mut files = Files::default();
    files.files.push(("about.toml".into(), data::about_toml(&about).into_bytes()));
    files.files.push(("markers.csv".into(), csv));
    files.files.push(("truth.toml".into(), robot.text.into_bytes()));
    write_files(&args.out, &files, &[truth.input], context)?;
    let text = format!(
        "{} values of {} finite element runs in {}\n",
        dataset.xy_m.len(),
        dataset.runs.len(),
        args.out.display()
    );
    let answer = json!({"schema": "ibr.data.fem", "version": 1, "folder": args.out.display().to_string(), "runs": dataset.runs.len()});
    Ok(Outcome::new(text, answer))
}

/// The robot, at another body pressure if one is named.
fn robot(args: &DataFem) -> Result<(Named, Scenario), Failure> {
    let robot = named(&args.scenario)?;
    let (scenario, _) = robot.robot_run()?;
    let Some(text) = &args.body_pressure else { return Ok((robot, scenario)) };
    let [body_kpa] = list("--body-pressure", text, Quantity::Pressure, 1e-3)?[..] else {
        let help = "write for example 4kPa; data at several are datasets of their own, diagnosed together with --also";
        return Err(Failure::usage("--body-pressure takes one pressure", help));
    };
    let robot = changed(&robot, &scenario, body_kpa, None)?;
    let (scenario, _) = robot.robot_run()?;
    Ok((robot, scenario))
}

/// One run for every seed, those that come with the program or those of a folder, which gets what is missing.
fn runs(
    args: &DataFem,
    robot: &Named,
    scenario: &Scenario,
    kpa: &[f64],
    context: &mut Context,
) -> Result<Option<Vec<FeRun>>, Failure> {
    if args.stored {
        let own = ensemble(&stored()?, scenario);
        let found: Vec<FeRun> = own.runs.into_iter().take(args.seeds as usize).collect();
        if found.len() < args.seeds as usize {
            let (there, what) = (found.len(), &args.scenario);
            let (body_kpa, wanted) = (scenario.p_body_pa * 1e-3, args.seeds);
            let message = format!(
                "{there} finite element runs of {what} at {body_kpa} kPa body pressure come with the program, not {wanted}"
            );
            return Err(Failure::usage(message, "lower --seeds, or leave --stored out to make them: minutes each"));
        }
        return Ok(Some(found));
    }
    let keeper = Keeper { folder: args.runs.clone(), threads: args.threads as usize };
    let mut cases = Vec::new();
    for seed in 1..=args.seeds {
        let case = robot.with(&[("seed".into(), seed.to_string()), ("pressures_kpa".into(), format!("{kpa:?}"))])?;
        cases.push((case, format!("seed {seed}")));
    }
    match keeper.run_all(&cases, context)? {
        Ok(made) => made.into_iter().collect::<Result<Vec<FeRun>, Failure>>().map(Some),
        Err(_) => Ok(None),
    }
}
