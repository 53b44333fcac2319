//! `ibr data fem`: marker data from finite element runs.

use super::fem_inputs::{kept, list, pressures};
use super::inputs;
use super::inputs::scattered;
use crate::cli::DataFemArgs;
use crate::output::write_dataset;
use crate::prelude::*;
use compare::study::Generator;
use compare::study::engines::{EngineRun, of_the_program, runs_of, seed_jobs};
use compare::study::generate::about;
use compare::study::seen::seen;
use fem::session::RunSource;

pub(super) fn run(args: &DataFemArgs, context: &mut Context) -> Result<Outcome> {
    check_set_folder(&args.out, context.force)?;
    let truth = ibr::studies::scenario(&args.scenario)?.planar()?;
    let (robot, scenario) = robot(args)?;
    let kpa = pressures(&args.pressure)?;
    let help = "write rising ones, for example 10kPa,20kPa,30kPa: a robot is loaded once";
    let message = format!("--pressure {} does not rise", args.pressure);
    refuse_if(!kpa.is_sorted_by(|a, b| a < b), message, help)?;
    let body_pa = scenario.p_body_pa;
    let generator = Generator {
        runs: args.seeds as usize,
        protocol: std::iter::once(0.0).chain(kpa.iter().map(|p| p * 1e3)).map(|p| [body_pa, p]).collect(),
        ..scattered(&args.scatter)?
    };
    let runs = match args.fem.stored {
        true => of_the_program(&scenario, args.seeds as usize)?,
        false => made(args, &robot, &scenario, &kpa, context)?,
    };
    let dataset = seen(&runs, &set_name(&args.out, "fem"), &generator)?;
    let mut about = about(&scenario, &dataset, &generator);
    let first = &runs[0];
    about.title =
        format!("Finite element markers of {}, {} runs with imperfections of their own", first.scenario, runs.len());
    about.source = format!(
        "synthetic: finite elements, engine {}, {} mm elements, numbers {}; ibr data fem, seed {}",
        first.engine, first.mesh_mm[1], first.known, args.scatter.random.seed
    );
    write_dataset(&args.out, &dataset, &about, robot.text, &inputs::named(&truth, [])?, context)?;
    let text = format!(
        "{} values of {} finite element runs in {}\n",
        dataset.coordinates_m.len(),
        dataset.runs.len(),
        args.out.display()
    );
    let answer = SeenByFem { folder: args.out.display().to_string(), runs: dataset.runs.len() };
    Ok(Outcome::answer(text, "ibr.data.fem", &answer))
}

/// The robot, at another body pressure if one is named.
fn robot(args: &DataFemArgs) -> Result<(RunSource, Scenario)> {
    let mut robot = ibr::fe_source(&args.scenario)?;
    if let Some(text) = &args.body_pressure {
        let [body_kpa] = list("--body-pressure", text, Quantity::Pressure, 1e-3)?[..] else {
            let help =
                "write for example 4kPa; data at several are datasets of their own, diagnosed together with --also";
            return Err(Failure::usage("--body-pressure takes one pressure", help));
        };
        robot = robot.varied(body_kpa, None)?;
    }
    let (scenario, _) = robot.robot_run()?;
    Ok((robot, scenario))
}

/// One run for every seed in a folder; missing runs are made there.
fn made(
    args: &DataFemArgs,
    robot: &RunSource,
    scenario: &Scenario,
    kpa: &[f64],
    context: &mut Context,
) -> Result<Vec<EngineRun>> {
    let jobs = seed_jobs(&[(robot.clone(), scenario.clone())], args.seeds, Some(kpa))?;
    let settings = kept(&args.fem.folder(), context);
    let found = context.fem(|progress| runs_of(&jobs, &settings, progress))?;
    Ok(found.into_iter().collect::<Result<Vec<EngineRun>, _>>()?)
}

/// `ibr.data.fem`: `ibr data fem SCENARIO`
#[derive(Serialize)]
struct SeenByFem {
    /// Folder in which data and description were written
    folder: String,
    /// Number of runs in the data
    runs: usize,
}
