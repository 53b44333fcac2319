//! `ibr data check | list | import | generate | fem`

use super::inputs::{self, scattered};
use super::list;
use crate::cli::{DataCommand, GenerateArgs};
use crate::output::write_dataset;
use crate::prelude::*;
use compare::diagnosis::{Options, pressure_slip};
use compare::slips::pressure::pressure_words;
use compare::slips::slips;
use compare::study::generate::{Generator, about, generate};
use data::CheckReport;
use ibr::check_fed;

pub(super) fn run(command: &DataCommand, context: &mut Context) -> Result<Outcome> {
    match command {
        DataCommand::Check { data, scenario } => check(data, scenario.as_deref(), context),
        DataCommand::List => list::run(Some("datasets")),
        DataCommand::Import(args) => super::data_import::run(args, context),
        DataCommand::Generate(args) => make(args, context),
        DataCommand::Fem(args) => super::data_fem::run(args, context),
    }
}

fn check(spec: &str, scenario: Option<&str>, context: &mut Context) -> Result<Outcome> {
    if let Some(bench) = data::bench::bench(spec)? {
        let check = BenchCheck { kind: bench.kind.name, rows: bench.rows.len(), provenance: bench.provenance };
        let words = format!("{spec}: {}, {} rows ({})\n", bench.kind.sentence, check.rows, check.provenance.word());
        return Ok(Outcome::answer(words, "ibr.data.check", &CheckedTable { check: TableCheck::Bench(check) }));
    }
    let evidence = inputs::evidence(spec, context)?;
    let Evidence { dataset, about, .. } = &evidence;
    let mut report = data::check(dataset, about.as_ref());
    let stations_m: Option<Vec<f64>> = dataset.markers.iter().map(|marker| marker.station_m).collect();
    let radius_m = about.as_ref().and_then(|about| about.geometry.as_ref()).map(|geometry| geometry.body_radius_m);
    match stations_m.zip(radius_m) {
        _ if dataset.leaves_the_plane() => report.warnings.extend(pressure_words(dataset)),
        Some((stations_m, radius_m)) => report.warnings.extend(slips(dataset, &stations_m, radius_m)),
        None => report.warnings.extend(pressure_words(dataset)),
    }
    let model = match scenario {
        Some(scenario) => Some(ibr::studies::scenario(scenario)?),
        None => ScenarioFile::beside(spec)?,
    };
    report.warnings.extend((model.is_none() && dataset.leaves_the_plane()).then(|| in_space_words(dataset)));
    if let Some(model) = model
        && let Some(found) = pressure_slip(&model, &evidence, &Options::default())?
    {
        let in_numbers = pressure_words(dataset);
        report.warnings.retain(|warning| !in_numbers.contains(warning));
        report.warnings.push(found.words);
    }
    let words = check_text(&report);
    Ok(Outcome::answer(words, "ibr.data.check", &CheckedTable { check: TableCheck::Markers(Box::new(report)) }))
}

/// A note on a table with z or several channels, whose frame no geometry alone can check.
fn in_space_words(dataset: &Dataset) -> String {
    let z =
        dataset.has_z().then(|| format!("z varies by up to {:.1} mm from the first hold", 1e3 * dataset.travel_m(2)));
    let more = dataset.more_channels();
    let channels = (more > 0).then(|| format!("pressures of {} supply channels", more + 1));
    let words: Vec<String> = z.into_iter().chain(channels).collect();
    format!("{}: the robot's model finds exchanged columns of them: ibr data check DATA SCENARIO", words.join(", "))
}

fn make(args: &GenerateArgs, context: &mut Context) -> Result<Outcome> {
    let generator = Generator { runs: args.runs as usize, gauge: args.gauge, ..scattered(&args.scatter)? };
    let generator = generator.with_protocol(&args.protocol)?;
    check_set_folder(&args.out, context.force)?;
    let named = ibr::studies::scenario(&args.scenario)?;
    let model = Model::new(&named.scenario);
    (0..generator.protocol.len()).try_for_each(|hold| check_fed(&model, &generator.loads(hold, 1.0).actuator_pa))?;
    let message = format!("the scenario {} has no marker stations", args.scenario);
    let help = "add [markers] with s_mm = [30, 90, 150] to it: places in mm from the base";
    refuse_if(named.markers_m.is_empty(), message, help)?;
    let dataset = generate(&named.scenario, &set_name(&args.out, "synthetic"), &generator)?;
    let about = about(&named.scenario, &dataset, &generator);
    let inputs = inputs::named(&named, [])?;
    write_dataset(&args.out, &dataset, &about, named.text, &inputs, context)?;
    let values = dataset.coordinates_m.len();
    let text = format!("{values} values of {} runs in {}\n", dataset.runs.len(), args.out.display());
    let answer = Generated { folder: args.out.display().to_string(), runs: dataset.runs.len() };
    Ok(Outcome::answer(text, "ibr.data.generate", &answer))
}

/// `ibr.data.generate`: `ibr data generate SCENARIO`
#[derive(Serialize)]
struct Generated {
    /// Folder in which data and description were written
    folder: String,
    /// Number of runs in the data
    runs: usize,
}

/// `ibr.data.check`: `ibr data check DATA`
#[derive(Serialize)]
struct CheckedTable {
    /// Result of the check, by the kind of table
    check: TableCheck,
}

#[derive(Serialize)]
#[serde(untagged)]
enum TableCheck {
    /// Table of markers, with holds and runs
    Markers(Box<CheckReport>),
    /// In a table of bench tests
    Bench(BenchCheck),
}

#[derive(Serialize)]
struct BenchCheck {
    /// Kind of the table of bench tests
    kind: &'static str,
    /// Number of rows in that table
    rows: usize,
    /// How its numbers came to be
    provenance: Provenance,
}

fn check_text(report: &CheckReport) -> String {
    let CheckReport { name, runs, actuator, holds, markers, samples_per_hold, .. } = report;
    let provenance = report.provenance.as_ref().map_or(String::new(), |p| format!(" ({p})"));
    let mut out = format!(
        "{name}: {} runs of actuator {actuator}, {} holds, {} markers, {samples_per_hold} samples per hold{provenance}\n",
        runs.len(),
        holds.len(),
        markers.len(),
    );
    out += &TextTable::of(holds)
        .right("P [kPa]", |h| {
            let more = h.p_act_channels_kpa.iter().skip(1).map(|p| format!("/{p:.2}"));
            format!("{:.2}{}", h.p_act_kpa, more.collect::<String>())
        })
        .number("body [kPa]", 2, |h| h.p_body_kpa)
        .right("phase", |h| h.phase)
        .number("duration [s]", 1, |h| h.duration_s)
        .number("scatter of runs [mm]", 2, |h| h.scatter_mm)
        .when(holds.iter().all(|h| h.gauge_kpa.is_some()), |t| t.number("gauge [kPa]", 2, |h| h.gauge_kpa))
        .text();
    out += &TextTable::of(markers)
        .words("marker", |m| &m.name)
        .number("station [mm]", 1, |m| m.s_mm)
        .number("scatter of runs [mm]", 2, |m| m.scatter_mm)
        .text();
    for o in &report.outliers {
        let (run, hold, sample, marker) = (&o.run, o.hold + 1, o.sample + 1, &o.marker);
        let dz = o.dz_mm.map_or(String::new(), |dz| format!(", {dz:+.1}"));
        let off = format!("{:+.1}, {:+.1}{dz} mm off", o.dx_mm, o.dy_mm);
        out += &format!("outlier: run {run}, hold {hold}, sample {sample}, marker {marker}: {off}\n");
    }
    out += &lines("", report.identical_runs.iter().map(|[a, b]| format!("runs {a} and {b} are identical copies")));
    out + &lines("note: ", &report.warnings)
}
