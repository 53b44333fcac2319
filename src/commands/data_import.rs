use super::import_options::options;
use crate::cli::Import;
use crate::prelude::*;
use data::DataError;
use data::import::{Imported, import};
use ibr::pages::{clock_plot, tracks_plot};

/// Three runs of an ePAM with sealed edges as DeepLabCut writes them, and the log of their pressures.
const EXAMPLE: [(&str, &str); 4] = [
    ("run1.csv", include_str!("../../data/tests/cases/c01-deeplabcut/run1.csv")),
    ("run2.csv", include_str!("../../data/tests/cases/c01-deeplabcut/run2.csv")),
    ("run3.csv", include_str!("../../data/tests/cases/c01-deeplabcut/run3.csv")),
    ("pressure.csv", include_str!("../../data/tests/cases/c01-deeplabcut/pressure.csv")),
];

pub(super) fn run(args: &Import, context: &mut Context) -> Result<Outcome> {
    if let Some(folder) = &args.example {
        return make_example(folder, context);
    }
    let options = options(args)?;
    if let Some(folder) = &args.out {
        check_set_folder(folder, context.force)?;
    }
    let mut tell =
        |done: u64, total: u64| (context.progress)("reading tracks", Some(done as f64 / total.max(1) as f64));
    let made = import(&args.files, &options, &mut tell);
    let made = made.map_err(|error| with_picture(error, args, context))?;
    let mut text = told(&made);
    match &args.out {
        Some(folder) => {
            let (files, inputs) = (files(&made)?, inputs(args));
            spares_inputs(folder, &files, &inputs.iter().map(|input| input.name.clone()).collect::<Vec<_>>())?;
            replace_files(folder, &files, &inputs, context)?;
            text.push_str(&format!(
                "\nmarkers.csv, about.toml and tracks in {}; answer the questions in about.toml, then\n  ibr data check {0}\n",
                folder.display()
            ));
        }
        None => text.push_str("\nNothing was written: add --out FOLDER\n"),
    }
    Ok(Outcome::answer(text, "ibr.data.import", &import_answer(&made, args.out.as_deref())))
}

/// A refused clock with its picture in the folder, unless that holds a dataset.
fn with_picture(error: DataError, args: &Import, context: &mut Context) -> Failure {
    let (DataError::Clock(_, tracks), Some(folder)) = (&error, &args.out) else { return error.into() };
    let mut files = Files::default();
    let drawn = clock_plot(tracks).map(|drawn| files.plot("clock", drawn));
    let is_free = check_set_folder(folder, false).and_then(|()| check_folder(folder));
    match is_free.and(drawn.map_err(Failure::from)).and_then(|()| replace_files(folder, &files, &inputs(args), context))
    {
        Ok(()) => error.with_help(&format!("; picture of both tracks: {}", folder.join("clock.svg").display())).into(),
        Err(_) => error.into(),
    }
}

fn make_example(folder: &Path, context: &mut Context) -> Result<Outcome> {
    let files = write_example(folder, EXAMPLE.map(|(name, text)| (name.into(), text.into())).into(), context)?;
    let shown = folder.display();
    let text = format!(
        "Three runs of DeepLabCut at 30 frames per second and 3.1 px to a millimetre, the base at pixel 212, 540\n\
         ibr data import {shown}/run*.csv --pressure {shown}/pressure.csv --fps 30 --scale 3.1px/mm --base 212,540 --actuator epam\n"
    );
    Ok(Outcome::answer(text, "ibr.data.import.example", &ImportExample { files }))
}

const MOST_PICTURES: usize = 10;

fn files(made: &Imported) -> Result<Files> {
    let mut files = Files::default();
    for (k, track) in made.tracks.iter().take(MOST_PICTURES).enumerate() {
        let name = if k == 0 { "tracks".to_string() } else { format!("tracks-{}", k + 1) };
        files.plot(&name, tracks_plot(track)?);
    }
    files.text("about.toml", made.about_toml.clone());
    files.text("markers.csv", made.markers_csv.clone());
    Ok(files)
}

fn inputs(args: &Import) -> Vec<Input> {
    let board = args.board.as_deref().and_then(|board| board.rsplit_once('=')).map(|(file, _)| Path::new(file));
    args.files.iter().chain(&args.pressure).map(PathBuf::as_path).chain(board).map(read_input).collect()
}

fn told(made: &Imported) -> String {
    let set = &made.dataset;
    let count = |n: usize, word: &str| format!("{n} {word}{}", if n == 1 { "" } else { "s" });
    let sizes = [(set.runs.len(), "run"), (set.holds.len(), "hold"), (set.markers.len(), "marker")];
    format!("{}\n{}", sizes.map(|(n, word)| count(n, word)).join(", "), lines("- ", &made.told))
}

/// `ibr.data.import`: `ibr data import FILES`
#[derive(Serialize)]
struct ImportAnswer<'a> {
    /// The program that wrote the files
    program: &'a str,
    /// Labels of the runs in the table
    runs: &'a [String],
    /// Labels of the markers in the table
    markers: Vec<&'a str>,
    /// Number of holds at constant pressure in the table
    holds: usize,
    /// Sentences about what was understood and assumed
    told: &'a [String],
    /// Folder that was written; null without `--out`
    folder: Option<String>,
}

fn import_answer<'a>(made: &'a Imported, folder: Option<&Path>) -> ImportAnswer<'a> {
    let Imported { dataset: set, program, told, .. } = made;
    let markers = set.markers.iter().map(|marker| marker.name.as_str()).collect();
    let folder = folder.map(|out| out.display().to_string());
    ImportAnswer { program, runs: &set.runs, markers, holds: set.holds.len(), told, folder }
}

/// `ibr.data.import.example`: `ibr data import --example FOLDER`
#[derive(Serialize)]
struct ImportExample {
    /// Files of the example that were written
    files: Vec<String>,
}
