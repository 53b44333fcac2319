//! `ibr list` and `ibr new`

use crate::prelude::*;
use crate::shown::lists::Lists;
use fem::case::{SHIPPED_CASES, shipped_case};
use ibr::studies::{STUDIES, study};
use models::scenario::SHIPPED;

pub(super) fn run(what: Option<&str>) -> Result<Outcome, Failure> {
    let lists = Lists::of(what);
    Ok(Outcome::answer(lists.text(), "ibr.list", &lists))
}

/// `ibr.new`: `ibr new KIND`
#[derive(Serialize)]
struct NewAnswer {
    /// Text of the case
    #[serde(skip_serializing_if = "Option::is_none")]
    case_toml: Option<&'static str>,
    /// Text of the scenario
    #[serde(skip_serializing_if = "Option::is_none")]
    scenario_toml: Option<&'static str>,
}

pub(super) fn new(kind: &str) -> Result<Outcome, Failure> {
    let scenario_toml = models::shipped(kind).or(study(kind));
    let case_toml = shipped_case(kind).filter(|_| scenario_toml.is_none());
    let Some(text) = scenario_toml.or(case_toml) else {
        let names = SHIPPED.iter().chain(SHIPPED_CASES).map(|s| s.0).chain(STUDIES.iter().map(|s| s.0));
        let help = spelling::known(kind, &names.collect::<Vec<_>>());
        return Err(Failure::usage(format!("no shipped scenario `{kind}`"), help));
    };
    Ok(Outcome::answer(text.to_string(), "ibr.new", &NewAnswer { case_toml, scenario_toml }))
}
