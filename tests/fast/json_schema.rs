//! `docs/json.md` describes the JSON of every command: every key that comes out is described, every described key comes out.

use crate::support::{Folder, repository};
use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};

/// Type of every key of an answer or a record; a key that ends with `?` may be missing.
type Keys = BTreeMap<String, String>;

/// Records that only come with data of a kind that these commands have not: two effects at once, a fault, a slip, a law that the
/// catalogue lacks, a robot's run, lost nodes.
const RARE: [&str; 21] = [
    "AsClose",
    "BendingAlarm",
    "BestEffect",
    "ChangedSides",
    "Combination",
    "FirstThrough",
    "HeldBack",
    "Inflated",
    "KeptBending",
    "LearnedLaw",
    "LearnedLine",
    "LearnedTried",
    "LeftPattern",
    "LoopGap",
    "Outlier",
    "OutlyingRun",
    "PressureSlipFound",
    "Quality",
    "Reading",
    "RobotSummary",
    "Snap",
];

/// What runs, in this order in one folder, and the schema of its answer.
const COMMANDS: [(&str, &str); 48] = [
    ("predict epam-textbook --pressure 30kPa", "ibr.predict"),
    ("predict epam --pressure 300kPa", "ibr.predict"),
    ("predict epam-two-strips --pressure 20kPa/10kPa", "ibr.predict"),
    ("predict epam --limits --effect tip_load:force_y_n=1", "ibr.predict.limits"),
    ("predict epam-textbook --inverse 100mm,400mm", "ibr.predict"),
    ("export c epam --out epam.c", "ibr.export.c"),
    ("export linear fpam --pressure 20kPa", "ibr.export.linear"),
    ("pattern cpam", "ibr.pattern"),
    ("sweep study.toml --out swept", "ibr.sweep"),
    ("design wish.toml --no-check --out designed", "ibr.design"),
    ("design wide.toml --correct 1 --out corrected", "ibr.design"),
    ("simulate tube --end 1ms --out t", "ibr.simulate"),
    ("simulate epam --mesh 14mm --end 0.1ms --seeds 2 --shard 1/2 --out shards", "ibr.shard"),
    ("compare epam-textbook synthetic-epam --calibrate", "ibr.compare"),
    ("compare breukels-2011-beams", "ibr.compare.bench"),
    ("compare epam --engines --stored", "ibr.engines"),
    ("compare --paper", "ibr.paper"),
    ("compare epam-textbook synthetic-epam-two-bodies", "ibr.compare"),
    ("diagnose epam-textbook synthetic-epam --also synthetic-epam-two-bodies", "ibr.diagnose"),
    ("diagnose festo-bolen-2026", "ibr.diagnose.bench"),
    ("diagnose epam --published", "ibr.one_number"),
    ("add epam-textbook best synthetic-epam --out extended.toml", "ibr.add"),
    ("compare extended.toml synthetic-epam", "ibr.compare"),
    ("validate extended.toml synthetic-epam-two-bodies", "ibr.validate"),
    ("ladder epam-textbook synthetic-epam", "ibr.ladder"),
    ("breakdown --stored", "ibr.breakdown"),
    ("tradeoff", "ibr.tradeoff"),
    ("data check synthetic-epam", "ibr.data.check"),
    ("data check festo-bolen-2026", "ibr.data.check"),
    ("data generate epam --out made", "ibr.data.generate"),
    ("data generate epam-two-strips --protocol 0/0,20/10@2 --out space", "ibr.data.generate"),
    ("data check space", "ibr.data.check"),
    ("compare epam-two-strips space", "ibr.compare.space"),
    ("data import --example camera", "ibr.data.import.example"),
    ("data import made/markers.csv --out imported", "ibr.data.import"),
    ("data fem epam --stored --seeds 1 --out seen", "ibr.data.fem"),
    ("characterize --example tests", "ibr.characterize.example"),
    ("characterize tests/warp.csv tests/fill.csv tests/bias.csv", "ibr.characterize"),
    ("list", "ibr.list"),
    ("new cpam", "ibr.new"),
    ("new tube", "ibr.new"),
    ("challenge new --seed 3 --out c", "ibr.challenge.new"),
    ("challenge list", "ibr.challenge.list"),
    ("challenge reveal c", "ibr.challenge.reveal"),
    ("diagnose c/scenario.toml c --out d", "ibr.diagnose"),
    ("challenge reveal c --diagnosis d/diagnosis.json", "ibr.challenge.reveal"),
    ("verify", "ibr.verify"),
    ("bench", "ibr.bench"),
];

/// Answers by schema, with their version, and records by name.
fn described() -> BTreeMap<String, Keys> {
    let text = std::fs::read_to_string(repository().join("docs/json.md")).unwrap();
    let mut all: BTreeMap<String, Keys> = BTreeMap::new();
    let mut name = String::new();
    for line in text.lines() {
        if let Some(heading) = line.strip_prefix("### ") {
            name = heading.to_string();
            all.insert(name.clone(), Keys::new());
        }
        let cells: Vec<&str> = line.split(" | ").map(|cell| cell.trim_matches(['|', ' '])).collect();
        if let ([key, kind, ..], Some(keys)) = (&cells[..], all.get_mut(&name))
            && line.starts_with("| ")
            && *kind != "type"
        {
            keys.insert((*key).to_string(), (*kind).to_string());
        }
    }
    all
}

struct Checker {
    all: BTreeMap<String, Keys>,
    seen: BTreeSet<(String, String)>,
}

impl Checker {
    fn object(&mut self, place: &str, name: &str, value: &Value, given: &[&str]) {
        let keys = self.all.get(name).unwrap_or_else(|| panic!("{place}: docs/json.md has no {name}")).clone();
        let object = value.as_object().unwrap_or_else(|| panic!("{place}: {value} is no {name}"));
        for (key, kind) in &keys {
            let plain = key.trim_end_matches('?');
            match object.get(plain) {
                Some(value) => {
                    self.seen.insert((name.into(), key.clone()));
                    self.value(&format!("{place}.{plain}"), kind, value);
                }
                None => assert!(key.ends_with('?'), "{place}: {name} lacks {plain}"),
            }
        }
        let known = |key: &str| keys.keys().any(|k| k.trim_end_matches('?') == key) || given.contains(&key);
        let unknown: Vec<&String> = object.keys().filter(|key| !known(key)).collect();
        assert!(unknown.is_empty(), "{place}: docs/json.md does not describe {unknown:?} of {name}");
    }

    fn value(&mut self, place: &str, kind: &str, value: &Value) {
        let is_right = match (kind.strip_suffix('?'), kind.strip_suffix("[]"), kind.strip_prefix("map of ")) {
            (Some(_), _, _) if value.is_null() => true,
            (Some(inner), _, _) => return self.value(place, inner, value),
            (_, Some(inner), _) => {
                let list = value.as_array().unwrap_or_else(|| panic!("{place}: {value} is no list"));
                return list.iter().for_each(|item| self.value(&format!("{place}[]"), inner, item));
            }
            (_, _, Some(inner)) => {
                let map = value.as_object().unwrap_or_else(|| panic!("{place}: {value} is no map"));
                return map.values().for_each(|item| self.value(place, inner, item));
            }
            _ => match kind {
                "number" => value.is_number(),
                "text" => value.is_string(),
                "bool" => value.is_boolean(),
                record => return self.object(place, record, value, &[]),
            },
        };
        assert!(is_right, "{place}: {value} is not {kind}");
    }
}

#[test]
fn every_key_is_described_and_every_described_key_comes_out() {
    let folder = Folder::new();
    folder.write("study.toml", "scenario = \"epam\"\n[[vary]]\nkey = \"actuator.width_mm\"\nvalues = [60, 300]\n");
    let free = "[[free]]\nkey = \"pressure_kpa\"\nfrom = 5\nto = 30\n[[assumed]]\nkey = \"body.pressure_kpa\"\nfrom = 1.9\nto = 2.1\n";
    folder.write("wish.toml", format!("scenario = \"epam\"\n[wish]\ntip_angle_deg = 36\n{free}"));
    let quick = crate::design::with_wish(0.5);
    std::fs::copy(quick.path("quick.toml"), folder.path("quick.toml")).unwrap();
    std::fs::copy(quick.path("wish.toml"), folder.path("wide.toml")).unwrap();
    let mut checker = Checker { all: described(), seen: BTreeSet::new() };
    for (typed, schema) in COMMANDS {
        let args: Vec<&str> = typed.split(' ').chain(["--json"]).collect();
        let answer = folder.run(&args).json(schema);
        let name = format!("{schema} {}", answer["version"]);
        checker.object(typed, &name, &answer, &["schema", "version"]);
    }
    let silent = |(name, keys): (&String, &Keys)| -> Vec<String> {
        let is_silent = |key: &&String| !key.ends_with('?') && !checker.seen.contains(&(name.clone(), (*key).clone()));
        let keys = keys.keys().filter(is_silent);
        if RARE.contains(&name.as_str()) { Vec::new() } else { keys.map(|key| format!("{name}.{key}")).collect() }
    };
    let silent: Vec<String> = checker.all.iter().flat_map(silent).collect();
    assert!(silent.is_empty(), "described, and never seen: {silent:?}");
}
