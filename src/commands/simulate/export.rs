use super::plan::RunPlan;
use crate::cli::SimulateArgs;
use crate::prelude::*;
use fem::session::{Export, Solver, export};

pub(super) fn written(args: &SimulateArgs, plan: &RunPlan, file: &Path, force: bool) -> Result<Outcome> {
    let RunPlan::Single(source) = plan else {
        return Err(Failure::usage(
            "--export writes one run, and this is several",
            "leave out --seeds, --uncertain and further values of --mesh",
        ));
    };
    if file.exists() && !force {
        let help = "give --force to replace it, or another name";
        return Err(Failure::usage(format!("{} exists already", file.display()), help));
    }
    let solver = if args.solver.as_deref() == Some("calculix") { Solver::CalculiX } else { Solver::Abaqus };
    let Export { nodes, elements, notices, left_out } = export(source, file, solver)?;
    let text = format!("{}: {nodes} nodes, {elements} elements\n", file.display());
    let left_out = left_out.into_iter().map(|what| format!("the file does not say: {what}"));
    Ok(Outcome { text, notes: notices.into_iter().chain(left_out).collect(), ..Outcome::default() })
}
