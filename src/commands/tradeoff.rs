use crate::cli::TradeoffArgs;
use crate::prelude::*;
use compare::study::Rung;
use compare::study::engines::known_runs;
use compare::study::published::{PublishedLadder, published_ladders};
use compare::study::tradeoff::{Timing, of_runs, tradeoff};
use data::published::PublishedActuator;
use ibr::pages::tradeoff_plot;

pub(super) fn run(args: &TradeoffArgs, context: &mut Context) -> Result<Outcome> {
    let out = args.out.as_deref();
    out.map_or(Ok(()), check_folder)?;
    (context.progress)("timing", None);
    let ladders = published_ladders()?;
    let mut timings = tradeoff(&ladders)?;
    timings.extend(of_runs(&ladders, &known_runs(args.runs.as_deref())?));
    let mut text = published(&ladders).text();
    text += &format!(
        "\nOne prediction of the reduced model (equilibrium, six markers) on {}, one finite element run to 30 kPa \
        (processor time); error of the published displacement: outermost marker, finite elements mean of seeds\n",
        machine()
    );
    text += &TextTable::of(&timings)
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

/// The published displacements, and every model with one more effect.
fn published(ladders: &[PublishedLadder]) -> TextTable<(&PublishedActuator, &Rung)> {
    let rungs = ladders.iter().flat_map(|ladder| ladder.rungs.iter().map(move |rung| (&ladder.published, rung)));
    TextTable::of(rungs)
        .words("actuator", |(p, _)| &p.printed_name)
        .words("model", |(_, rung)| &rung.label)
        .words("how known", |(_, rung)| rung.known.word())
        .number("model mm", 1, |(_, rung)| rung.y_m * 1e3)
        .right("range mm", |(_, rung)| {
            rung.range_m.map_or("–".into(), |r| format!("{:.1}–{:.1}", r[0] * 1e3, r[1] * 1e3))
        })
        .number("measured mm", 1, |(p, _)| p.d_max_m * 1e3)
        .signed("difference mm", 1, |(p, rung)| (rung.y_m - p.d_max_m) * 1e3)
}

/// `ibr.tradeoff`: `ibr tradeoff`
#[derive(Serialize)]
struct TradeoffAnswer {
    /// Processor, number of cores and operating system
    machine: String,
    /// Models and the time that each takes
    models: Vec<Timing>,
}

fn time(us: f64) -> String {
    match us {
        us if us < 1e3 => format!("{us:.2} µs"),
        us => format!("{:.1} s", us * 1e-6),
    }
}
