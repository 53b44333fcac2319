//! `ibr tradeoff`

use crate::cli::TradeoffArgs;
use crate::prelude::*;
use compare::study::engines::known_runs;
use compare::study::published::published_ladders;
use compare::study::tradeoff::{Timing, of_runs, tradeoff};
use ibr::pages::tradeoff_plot;

pub(super) fn run(args: &TradeoffArgs, context: &mut Context) -> Result<Outcome> {
    let out = args.out.as_deref();
    out.map_or(Ok(()), check_folder)?;
    (context.progress)("timing", None);
    let ladders = published_ladders()?;
    let mut timings = tradeoff(&ladders)?;
    timings.extend(of_runs(&ladders, &known_runs(args.runs.as_deref())?));
    let mut text = format!(
        "One prediction of the reduced model (equilibrium, six markers) on {}, one finite element run to 30 kPa \
        (processor time); error of the published displacement: outermost marker, finite elements mean of seeds\n",
        machine()
    );
    text += &Table::of(&timings)
        .words("engine", |t| &t.engine)
        .words("actuator", |t| &t.actuator)
        .words("model", |t| &t.model)
        .words("how known", |t| &t.known)
        .right("time", |t| time(t.prediction_us))
        .signed("error [mm]", 1, |t| t.error_mm)
        .number("error [%]", 1, |t| t.error_pct.abs())
        .text();
    if let Some(folder) = out {
        let mut files = Files::default();
        files.plot("tradeoff", tradeoff_plot(&timings)?);
        write_files(folder, &files, &[], context)?;
    }
    Ok(Outcome::answer(text, "ibr.tradeoff", &TradeoffAnswer { machine: machine(), models: timings }))
}

/// `ibr.tradeoff`: `ibr tradeoff`
#[derive(Serialize)]
struct TradeoffAnswer {
    /// Processor, cores, system
    machine: String,
    /// Models
    models: Vec<Timing>,
}

fn time(us: f64) -> String {
    match us {
        us if us < 1e3 => format!("{us:.2} µs"),
        us => format!("{:.1} s", us * 1e-6),
    }
}
