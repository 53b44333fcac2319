//! Scenarios that come with the library by name, in addition to the four robots: finite element studies.

use compare::{CompareError, ScenarioFile};
use fem::case::{SHIPPED_CASES, shipped_case};
use fem::session::RunSource;
use models::scenario::ROBOTS;
use spelling::files::{MOST_TEXT, read_whole};
use std::path::Path;

/// A scenario of `studies/` with what it is about.
macro_rules! study {
    ($name:literal, $about:literal) => {
        ($name, $about, include_str!(concat!("../studies/", $name, ".toml")))
    };
}

/// A robot in the paper's own model.
macro_rules! paper {
    ($name:literal, $about:literal, $file:literal) => {
        ($name, $about, concat!(include_str!($file), "\n[fem]\nmodel = \"paper\"\n"))
    };
}

/// Names, what they are about, and texts.
pub const STUDIES: &[(&str, &str, &str)] = &[
    study!("cpam-11-12-13", "the cPAM in small steps of pressure"),
    study!("cpam-mesh", "the cPAM on meshes of 4 to 1 mm"),
    paper!("spam-paper", "the sPAM as the paper modelled it", "../models/scenarios/spam.toml"),
    paper!("cpam-paper", "the cPAM as the paper modelled it", "../models/scenarios/cpam.toml"),
    paper!("epam-paper", "the ePAM as the paper modelled it", "../models/scenarios/epam.toml"),
    paper!("fpam-paper", "the fPAM as the paper modelled it", "../models/scenarios/fpam.toml"),
    study!("long", "a robot of 2 m with 40 pouches"),
    study!("tip-load", "a load on the tip"),
    study!("epam-two-strips", "two strips of pouches at 90 degrees"),
    study!("epam-helix", "a strip of pouches wound round the body"),
    study!("obstacle", "a cylinder in the way"),
];

/// Studies of robots with strips round the body.
pub const IN_SPACE: [&str; 2] = ["epam-two-strips", "epam-helix"];

/// Keys of `[fem]` for a run that somebody waits for: a little coarse and fast.
pub const SMALL_RUN: [(&str, &str); 3] =
    [("actuator_mesh_mm", "4"), ("body_ramp_s", "0.02"), ("actuator_ramp_s", "0.18")];

/// Finds the scenario text of a study by name; `None` if there is none.
pub fn study(name: &str) -> Option<&'static str> {
    STUDIES.iter().find(|s| s.0 == name).map(|s| s.2)
}

/// Reads a scenario file, or takes a shipped robot or study by name. Errors as for [`ScenarioFile::read`].
pub fn scenario(spec: &str) -> Result<ScenarioFile, CompareError> {
    match study(spec).filter(|_| !Path::new(spec).exists()) {
        Some(text) => ScenarioFile::parse(spec, text),
        None => ScenarioFile::read(spec).map_err(|error| match error {
            CompareError::Unread { path, cause, .. } => {
                CompareError::Unread { path, cause, help: ScenarioFile::help(spec, &robots()) }
            }
            other => other,
        }),
    }
}

/// Names of all robots that come with the library.
pub fn robots() -> Vec<&'static str> {
    ROBOTS.into_iter().chain(STUDIES.iter().map(|s| s.0)).collect()
}

/// Reads a finite element case or the scenario of a robot, or takes a shipped one by name.
///
/// ```
/// assert!(ibr::fe_source("epam")?.is_robot() && !ibr::fe_source("pillow")?.is_robot());
/// assert!(ibr::fe_source("epan").unwrap_err().help().unwrap_or_default().contains("epam"));
/// # Ok::<(), ibr::Error>(())
/// ```
///
/// # Errors
/// Nothing of that name, or no text.
pub fn fe_source(spec: &str) -> Result<RunSource, CompareError> {
    let path = Path::new(spec);
    let cause = match (read_whole(path, MOST_TEXT), shipped_case(spec).or(models::shipped(spec)).or(study(spec))) {
        (Err(_), Some(text)) if !path.exists() => return Ok(RunSource::new(spec, text)),
        (Err(cause), _) => cause.to_string(),
        (Ok(bytes), _) => match String::from_utf8(bytes) {
            Ok(text) if text.trim().is_empty() => "the file is empty".to_string(),
            Ok(text) => {
                let folder = path.parent().unwrap_or(Path::new("")).to_path_buf();
                return Ok(RunSource { folder, ..RunSource::new(spec, &text) });
            }
            Err(_) => "it is not a text in UTF-8".to_string(),
        },
    };
    let names: Vec<&str> = SHIPPED_CASES.iter().map(|c| c.0).chain(robots()).collect();
    let help = format!(
        "{}give a finite element case or a robot's scenario, or a shipped one: {}; `ibr new pillow > my.toml` makes a start",
        spelling::meant(spec, names.iter().copied()),
        names.join(", ")
    );
    Err(CompareError::Unread { path: spec.into(), cause, help })
}
