use crate::prelude::*;
use compare::diagnosis::words::with_unit;
use data::SetInfo;
use fem::case::{GENERATORS, MeshGenerator, SHIPPED_CASES, shipped_case};
use ibr::studies::{STUDIES, robots, study};
use models::actuators::{ACTUATORS, Actuator};
use models::effects::{EFFECTS, Effect};
use models::scenario::ROBOTS;

pub(super) fn run(what: Option<&str>) -> Result<Outcome> {
    let lists = Lists::of(what);
    Ok(Outcome::answer(lists.text(), "ibr.list", &lists))
}

/// `ibr.new`: `ibr new KIND`
#[derive(Serialize)]
struct NewAnswer {
    /// Text of the finite element case
    #[serde(skip_serializing_if = "Option::is_none")]
    case_toml: Option<&'static str>,
    /// Text of the scenario of the robot
    #[serde(skip_serializing_if = "Option::is_none")]
    scenario_toml: Option<&'static str>,
}

pub(super) fn new(kind: &str) -> Result<Outcome> {
    let scenario_toml = models::shipped(kind).or(study(kind));
    let case_toml = shipped_case(kind).filter(|_| scenario_toml.is_none());
    let Some(text) = scenario_toml.or(case_toml) else {
        let names = robots().into_iter().chain(SHIPPED_CASES.iter().map(|s| s.0));
        let help = spelling::known(kind, &names.collect::<Vec<_>>());
        return Err(Failure::usage(format!("no shipped scenario `{kind}`"), help));
    };
    let first = match models::shipped(kind) {
        Some(_) => format!("# First {}.\n", data::BENDING_TEST.replace("body, ", "body,\n# ")),
        None => String::new(),
    };
    Ok(Outcome::answer(first + text, "ibr.new", &NewAnswer { case_toml, scenario_toml }))
}

/// `ibr.list`: `ibr list`, `ibr data list`
#[derive(Serialize, Default)]
struct Lists {
    /// Actuators of the catalogue, with their laws
    #[serde(skip_serializing_if = "Option::is_none")]
    actuators: Option<&'static [Actuator]>,
    /// Finite element cases that come with the program
    #[serde(skip_serializing_if = "Option::is_none")]
    cases: Option<Cases>,
    /// Data sets that come with the program
    #[serde(skip_serializing_if = "Option::is_none")]
    datasets: Option<Vec<SetInfo>>,
    /// Effects of the catalogue, with their laws and parameters
    #[serde(skip_serializing_if = "Option::is_none")]
    effects: Option<&'static [Effect<'static>]>,
    /// Robots that are known by name
    #[serde(skip_serializing_if = "Option::is_none")]
    robots: Option<Vec<NamedText>>,
}

#[derive(Serialize)]
struct Cases {
    /// Cases that come with the program
    shipped: Vec<NamedText>,
    /// Robots that come with it in addition to the four
    studies: Vec<NamedText>,
    /// Generators that `[mesh] generator` of a case may name
    generators: &'static [MeshGenerator],
}

/// A name and what it is.
#[derive(Serialize)]
struct NamedText {
    /// Name by which commands take it
    name: &'static str,
    /// Title in one line, for people
    title: &'static str,
}

const TEXTBOOK: &str = "the same without the mechanics that textbook models lack";

impl Lists {
    fn of(what: Option<&str>) -> Lists {
        let wanted = |name: &str| what.is_none_or(|w| w == name);
        let title = |toml: &'static str| toml.lines().find_map(|line| line.strip_prefix("name = ")).unwrap_or_default();
        let shipped = SHIPPED_CASES.iter().map(|(name, toml)| NamedText { name, title: title(toml).trim_matches('"') });
        let studies = STUDIES.iter().map(|(name, title, _)| NamedText { name, title });
        let cases = || Cases { shipped: shipped.collect(), studies: studies.collect(), generators: GENERATORS };
        let named = |name: &'static str| {
            let of = |actuator: &&Actuator| actuator.name == name;
            NamedText { name, title: ACTUATORS.iter().find(of).map_or(TEXTBOOK, |actuator| actuator.title) }
        };
        let all = || STUDIES.iter().map(|(name, title, _)| NamedText { name, title });
        Lists {
            robots: wanted("robots").then(|| ROBOTS.into_iter().map(named).chain(all()).collect()),
            actuators: wanted("actuators").then_some(ACTUATORS),
            effects: wanted("effects").then_some(EFFECTS),
            datasets: wanted("datasets").then(data::sets),
            cases: wanted("cases").then(cases),
        }
    }

    fn text(&self) -> String {
        let mut out = String::new();
        if let Some(all) = self.actuators {
            out += "ACTUATORS\n";
            for Actuator { name, title, sentence, formula, validity, reference, .. } in all {
                let lines =
                    [title, sentence, formula, validity, &format!("source: {reference}")[..]].join("\n         ");
                out += &format!("  {name:<6} {lines}\n");
            }
        }
        if let Some(all) = self.effects {
            out += "EFFECTS\n";
            all.iter().for_each(|effect| out += &effect_text(effect));
        }
        if let Some(all) = &self.robots {
            out += "ROBOTS (a SCENARIO by name; ibr new prints them)\n";
            all.iter().for_each(|r| out += &format!("  {:<16} {}\n", r.name, r.title));
        }
        if let Some(all) = &self.datasets {
            out += "DATASETS\n";
            for set in all {
                let SetInfo { name, title, provenance, source, licence, .. } = set;
                let (provenance, kind) = (provenance.word(), kind(set));
                out += &format!("  {name:<28} {title} ({provenance}, {kind})\n    {source}; licence {licence}\n");
            }
        }
        if let Some(cases) = &self.cases {
            out += "CASES (ibr simulate; ibr new prints them)\n";
            cases.shipped.iter().for_each(|c| out += &format!("  {:<16} {}\n", c.name, c.title));
            out += "  robots in finite elements, in addition to the four of ibr list actuators\n";
            cases.studies.iter().for_each(|s| out += &format!("    {:<14} {}\n", s.name, s.title));
            out += "  meshes for cases of your own, [mesh] generator = …\n";
            for g in cases.generators {
                let keys = g.keys.iter().map(|k| k.key).collect::<Vec<_>>().join(", ");
                out += &format!("    {:<14} {}\n                   {keys}\n", g.name, g.sentence);
            }
        }
        out
    }
}

fn effect_text(effect: &Effect) -> String {
    let Effect { name, stage, sentence, formula, differs, validity, remedy, reference, .. } = effect;
    let mut out = format!("  {name:<18} [{}] {sentence}\n    {formula}\n    in data: {differs}\n", stage.word());
    for p in effect.parameters {
        let typical = with_unit(&p.typical.to_string(), p.unit);
        let range = format!("typical {typical}, {} to {}, no effect at {}", p.lower, p.upper, p.neutral);
        out += &format!("    {} ({}): {}; {range}\n", p.key, p.symbol, p.meaning);
    }
    out + &format!("    valid: {validity}; to check: {remedy}; source: {reference}\n")
}

fn kind(set: &SetInfo) -> &'static str {
    let table = data::bench::KINDS.iter().find(|k| set.files.contains(&format!("{}.csv", k.name))).map(|k| k.name);
    let coupons = set.files.iter().any(|f| f.starts_with("coupon_")).then_some("tensile tests");
    set.has_markers().then_some("markers").or(table).or(coupons).unwrap_or("published numbers")
}
