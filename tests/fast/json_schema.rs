//! The types that describe the JSON of every command describe what comes out: every key, and its type.

use crate::json_types::{JsonKey, Types};
use crate::support::Folder;
use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};

/// Answers of commands that take long, and records that only come with data of a kind that these commands have not: two effects at
/// once, a fault, a slip, a law that the catalogue lacks, a robot's run, lost nodes.
const RARE: &str = "ibr.demo ibr.simulations ibr.uncertain AsClose BendingAlarm BestEffect Beyond Combination Diagnosis FirstThrough ForeignBase GaugeFit Heights \
    Held InflatedPouch Intervals KeptBending LearnedLaw LearnedLine LearnedTried LeftPattern Mechanism OtherDesign Outlier OutlyingRun \
    PressureSlipFound Reading RobotSummary RunRecord Rung SeedGroup Snap Through Varied Weight";

/// What runs, in this order in one folder, and the schema of its answer.
const COMMANDS: [(&str, &str); 56] = [
    ("predict no-such-robot", "ibr.error"),
    ("predict epam --set body.radius_mn=45", "ibr.error"),
    ("predict epam --no-such-option", "ibr.error"),
    ("predict epam-textbook --pressure 30kPa", "ibr.predict"),
    ("predict epam --pressure 300kPa", "ibr.predict"),
    ("predict epam-two-strips --pressure 20kPa/10kPa", "ibr.predict"),
    ("predict epam --limits --effect tip_load:force_y_n=1", "ibr.predict.limits"),
    ("predict epam-textbook --inverse 100mm,400mm", "ibr.predict"),
    ("predict epam --inverse tip=100mm", "ibr.predict"),
    ("grow epam --set growth.tip_force_n=2 --set growth.friction=0.3 --pressure 20kPa", "ibr.grow"),
    ("export c epam --out epam.c", "ibr.export.c"),
    ("export linear fpam --pressure 20kPa", "ibr.export.linear"),
    ("export mjcf epam --pressure 20kPa --out epam.xml", "ibr.export.rigid"),
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
    ("compare epam-two-strips space", "ibr.compare"),
    ("data import --example camera", "ibr.data.import.example"),
    ("data import made/markers.csv --out imported", "ibr.data.import"),
    ("data fem epam --stored --seeds 1 --out seen", "ibr.data.fem"),
    ("characterize --example tests", "ibr.characterize.example"),
    ("characterize tests/warp.csv tests/fill.csv tests/bias.csv", "ibr.characterize"),
    ("list", "ibr.list"),
    ("new cpam", "ibr.new"),
    ("new tube", "ibr.new"),
    ("challenge new --seed 3 --out c", "ibr.challenge.new"),
    ("challenge export --out cases --cases 2 --seed 5", "ibr.challenge.export"),
    ("challenge score cases entry.csv", "ibr.challenge.score"),
    ("challenge list", "ibr.challenge.list"),
    ("challenge reveal c", "ibr.challenge.reveal"),
    ("diagnose c/scenario.toml c --out d", "ibr.diagnose"),
    ("challenge reveal c d/diagnosis.json", "ibr.challenge.reveal"),
    ("verify", "ibr.verify"),
    ("bench", "ibr.bench"),
];

struct Checker {
    all: BTreeMap<String, Vec<JsonKey>>,
    seen: BTreeSet<String>,
}

impl Checker {
    fn object(&mut self, place: &str, name: &str, value: &Value, given: &[&str]) {
        let keys = self.all.get(name).unwrap_or_else(|| panic!("{place}: there is no type {name}")).clone();
        self.seen.insert(name.into());
        let object = value.as_object().unwrap_or_else(|| panic!("{place}: {value} is no {name}"));
        for key in &keys {
            match object.get(&key.name) {
                Some(value) => self.value(&format!("{place}.{}", key.name), &key.kind, value),
                None => assert!(key.optional, "{place}: {name} lacks {}", key.name),
            }
        }
        let known = |key: &str| keys.iter().any(|k| k.name == key) || given.contains(&key);
        let unknown: Vec<&String> = object.keys().filter(|key| !known(key)).collect();
        assert!(unknown.is_empty(), "{place}: {name} has no {unknown:?}");
    }

    fn value(&mut self, place: &str, kind: &str, value: &Value) {
        if let Some((first, second)) = kind.split_once(" or ") {
            let fits = |name: &str| self.all[name].iter().all(|key| key.optional || value.get(&key.name).is_some());
            return self.value(place, if fits(first) { first } else { second }, value);
        }
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
                "list" => value.is_array(),
                "any" => true,
                record => return self.object(place, record, value, &[]),
            },
        };
        assert!(is_right, "{place}: {value} is not {kind}");
    }
}

#[test]
fn what_comes_out_is_what_the_types_say() {
    let folder = Folder::new();
    folder.write("study.toml", "scenario = \"epam\"\n[[vary]]\nkey = \"actuator.width_mm\"\nvalues = [60, 300]\n");
    let free = "[[free]]\nkey = \"pressure_kpa\"\nfrom = 5\nto = 30\n[[assumed]]\nkey = \"body.pressure_kpa\"\nfrom = 1.9\nto = 2.1\n";
    folder.write("entry.csv", "case,verdict,names\ncase-001,none,\ncase-002,effect,gravity\n");
    folder.write("wish.toml", format!("scenario = \"epam\"\n[wish]\ntip_angle_deg = 36\n{free}"));
    let quick = crate::design::with_wish(0.5);
    std::fs::copy(quick.path("quick.toml"), folder.path("quick.toml")).unwrap();
    std::fs::copy(quick.path("wish.toml"), folder.path("wide.toml")).unwrap();
    let types = Types::read();
    let answers: BTreeMap<String, Vec<JsonKey>> =
        types.answers().into_iter().map(|(schema, (_, keys))| (schema, keys)).collect();
    let records = types.records(answers.values().flatten());
    let mut checker = Checker { all: answers.into_iter().chain(records).collect(), seen: BTreeSet::new() };
    for (typed, schema) in COMMANDS {
        let args: Vec<&str> = typed.split(' ').chain(["--json"]).collect();
        let answer = folder.run(&args).json(schema);
        checker.object(typed, schema, &answer, &["schema", "version"]);
    }
    let is_rare = |name: &str| RARE.split(' ').any(|rare| rare == name);
    let silent: Vec<&String> =
        checker.all.keys().filter(|name| !checker.seen.contains(*name) && !is_rare(name)).collect();
    assert!(silent.is_empty(), "described, and never seen: {silent:?}");
}
