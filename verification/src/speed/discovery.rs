//! How often a diagnosis is right, on data whose hidden effects follow other laws.

use crate::{Error, Findings, Printed};
use challenge::bench::{Confusion, Discovery, DiscoveryOptions, Goal, PieceAnswer, PlannedBench, Rate};
use challenge::truth::{ROBOTS, standard_protocol};
use challenge::{Draw, Truth};
use compare::Evidence;
use compare::diagnosis::{Options, diagnose};
use fem::cost::thread_seconds;
use fem::session::{Progress, Shard, sha256};
use serde_json::json;
use std::path::{Path, PathBuf};
use sweep::pieces;

/// Target time of a full diagnosis on one core \[s\].
const TIME_S: f64 = 1.0;

/// Largest size of a hidden effect, in typical sizes.
const LARGEST: f64 = 1.5;
/// λ that parts two explanations in about nine of ten cases.
const ENOUGH: f64 = 16.0;

/// The bench, and where its answers are kept.
#[derive(Debug)]
pub struct DiscoveryWork {
    bench: PlannedBench,
    /// A file for each piece; none where nothing is kept.
    files: Vec<PathBuf>,
}

impl DiscoveryWork {
    /// Plans a bench. With a folder, it keeps the answers there under the fingerprint of the program: another program may answer otherwise.
    ///
    /// # Errors
    /// A shipped scenario is damaged; a folder that cannot be made.
    pub fn plan(options: DiscoveryOptions, kept: Option<(&Path, &str)>) -> Result<DiscoveryWork, Error> {
        let bench = PlannedBench::plan(options)?;
        let files = match kept {
            Some((folder, program)) => {
                let folder = folder.join("answers");
                pieces::folder(&folder)?;
                let name = |key: String| format!("{}.json", &sha256(format!("{program}\n{key}").as_bytes())[..32]);
                bench.keys().into_iter().map(|key| folder.join(name(key))).collect()
            }
            None => Vec::new(),
        };
        Ok(DiscoveryWork { bench, files })
    }

    /// How many pieces the whole bench has.
    pub fn pieces(&self) -> usize {
        self.bench.keys().len()
    }

    /// Pieces of a shard that have no file yet.
    pub fn missing(&self, shard: Shard) -> usize {
        shard.own(&self.files).filter(|file| !file.exists()).count()
    }

    /// Answers to the pieces of a shard: those in files, and the others, which are made.
    ///
    /// # Errors
    /// A folder that cannot be written to; an interrupt.
    pub fn answers(&self, shard: Shard, threads: usize, progress: Progress) -> Result<Vec<PieceAnswer>, Error> {
        let own: Vec<usize> = shard.own(0..self.pieces()).collect();
        let answer = |k: usize| {
            let file = self.files.get(own[k]);
            let there = file.map_or(Ok(None), |file| pieces::kept(file))?;
            if let Some(answer) = there.and_then(|bytes| serde_json::from_slice(&bytes).ok()) {
                return Ok(answer);
            }
            let answer = self.bench.answer(own[k], diagnose);
            if let Some(file) = file {
                pieces::keep(file, serde_json::to_vec(&answer).unwrap_or_default())?;
            }
            Ok(answer)
        };
        Ok(pieces::beside(own.len(), threads, "sets", progress, &answer)?)
    }

    /// The table, of all answers; `machine` names the computer that times a diagnosis.
    ///
    /// # Errors
    /// A robot without an equilibrium, or a diagnosis that cannot be made.
    pub fn findings(self, answers: Vec<PieceAnswer>, machine: &str) -> Result<Findings, Error> {
        let DiscoveryOptions { seed, sets, laws } = self.bench.options;
        let bench = self.bench.table(answers);
        let seconds = seconds(seed)?;
        let time = Rate::number(
            "full diagnosis",
            "median CPU seconds on one core",
            Goal::AtMost(TIME_S),
            Some(seconds),
            ROBOTS.len(),
        );
        let json = json!({
            "schema": "ibr.bench.discovery", "version": 1, "seed": seed, "sets": sets, "laws": laws, "rows": bench.rows, "slipped": bench.slipped, "surplus": bench.surplus, "faults": bench.faults,
            "confusion": bench.confusion,
            "made": bench.made, "seen": bench.seen, "failed": bench.failed, "time": {"machine": machine, "row": time},
        });
        let missed = bench.rows.iter().chain([&time]).any(|row| row.met == Some(false)) || !bench.failed.is_empty();
        Ok(Findings { parts: parts(&bench, &time), json, missed })
    }
}

/// Median CPU time of a diagnosis, one set with a hidden effect for every actuator.
fn seconds(seed: u64) -> Result<f64, Error> {
    let mut times = Vec::new();
    for (index, (actuator, _)) in ROBOTS.iter().enumerate() {
        let mut truth = Truth::draw(actuator, &mut Draw::new(seed, u64::MAX - index as u64))?;
        truth.add("friction", 1.0);
        truth.add("camera_scale", 1.0);
        let (told, data) = (truth.told()?, truth.dataset("time", &standard_protocol())?);
        let evidence = [Evidence::of(data, None)];
        let start = thread_seconds();
        diagnose(&told, &evidence, &Options::default(), &mut |_, _| ())?;
        times.push(thread_seconds() - start);
    }
    times.sort_by(f64::total_cmp);
    Ok(0.5 * (times[1] + times[2]))
}

fn parts(bench: &Discovery, time: &Rate) -> Vec<Printed> {
    let head = &["sets of", "figure", "target", "measured", "95 % interval", "sets", "met"];
    let named = bench.confusion.iter().map(|c| {
        let [lambda, behind, least] = [c.lambda, c.bic_behind, c.smallest_detectable].map(number);
        vec![c.truth.clone(), c.named.clone(), c.count.to_string(), lambda, behind, least]
    });
    let named_head = &["hidden", "named", "sets", "λ", "truth behind by BIC", "smallest detectable [typical sizes]"];
    let made = bench.made.iter().map(|m| {
        let listed = |names: &[String]| if names.is_empty() { "–".into() } else { names.join(", ") };
        let [before, whole, after] = m.systematic_mm.map(|mm| number(Some(mm)));
        let reported = if m.by_design {
            "by design"
        } else if m.in_set {
            "in the set"
        } else {
            "no"
        };
        let place = m.place.map_or("–".into(), |place| place.to_string());
        let bending = if m.kept { "kept" } else { "fitted" };
        let asked = [&m.robot, &m.lacking, &m.bodies.to_string(), bending].map(String::from);
        let found = [
            number(Some(m.does_mm)),
            before,
            whole,
            after,
            reported.into(),
            place,
            listed(&m.stated),
            listed(&m.attempted),
        ];
        asked.into_iter().chain(found).collect::<Vec<String>>()
    });
    let made_head = &[
        "robot",
        "lacks",
        "bodies",
        "B",
        "it does mm",
        "misfit",
        "with it",
        "named",
        "reported",
        "place",
        "stated",
        "closest",
    ];
    let laws = if bench.laws.are_first() { "" } else { " by the second laws" };
    vec![
        Printed::Text(format!("Diagnosis of data with hidden effects{laws}, seed {}\n", bench.seed)),
        Printed::table(head, 2, bench.rows.iter().chain([time]).map(cells)),
        Printed::Text("\nOne hidden effect: what was named\n".into()),
        Printed::table(named_head, 2, named),
        Printed::Text(
            "Medians. λ below 16: the data do not hold the answer. Behind by more than 6 without λ: the robot's law is not \
             the catalogue's formula.\n"
                .into(),
        ),
        Printed::Text(limits(bench)),
        Printed::Text(
            "\nMade by finite elements, the shipped model without one mechanism: its effect there, and the names given\n"
                .into(),
        ),
        Printed::table(made_head, 4, made),
        Printed::Text(bench.failed.iter().map(|reason| format!("failed: {reason}\n")).collect()),
    ]
}

/// A number with one decimal, or a dash for `None`.
fn number(value: Option<f64>) -> String {
    value.map_or_else(|| "–".into(), |v| format!("{v:.1}"))
}

/// How many misses of single effects no method could avoid with these data, cell by cell of the table above.
fn limits(bench: &Discovery) -> String {
    let count = |chosen: &dyn Fn(&Confusion) -> bool| -> usize {
        bench.confusion.iter().filter(|c| chosen(c)).map(|c| c.count).sum()
    };
    let unseen = |c: &Confusion| c.named == "none";
    let other = |c: &Confusion| !unseen(c) && c.named != "out_of_catalog" && c.named != c.truth;
    let small = count(&|c| unseen(c) && c.smallest_detectable.is_none_or(|least| least > LARGEST));
    let alike = count(&|c| other(c) && c.lambda.is_some_and(|lambda| lambda < ENOUGH));
    format!(
        "Of {} effects not seen {small} are smaller than what these data show with 90 % probability (above {LARGEST} typical \
         sizes); of {} called by another name {alike} are the same curve here (λ below {ENOUGH}).\n",
        count(&unseen),
        count(&other)
    )
}

fn cells(row: &Rate) -> Vec<String> {
    let shown = |v: f64| if row.share { format!("{:.1} %", 100.0 * v) } else { format!("{v:.2}") };
    let wanted = match row.target {
        Goal::AtLeast(v) => format!("≥ {}", shown(v)),
        Goal::AtMost(v) => format!("≤ {}", shown(v)),
        Goal::Between(low, high) => format!("{}–{}", shown(low), shown(high)),
    };
    let interval = row.interval.map_or("–".into(), |[low, high]| format!("{}–{}", shown(low), shown(high)));
    let met = row.met.map_or("–", |met| if met { "yes" } else { "no" });
    let measured = row.measured.map_or("–".into(), shown);
    vec![row.case.into(), row.figure.into(), wanted, measured, interval, row.sets.to_string(), met.into()]
}
