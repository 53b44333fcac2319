//! Some cases that are computed together, and their file.

use crate::axis::CaseChanges;
use crate::policy::{PART, PARTS};
use crate::study::{Engine, Study};
use crate::{SweepError, pieces};
use fem::session::sha256;
use serde::{Deserialize, Serialize};
use std::ops::Range;
use std::path::{Path, PathBuf};

/// Goes up when a number of the reduced model, or the file, changes its meaning.
const FORMAT: u32 = 2;

/// Cases of one engine that are computed together.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct StudyPart {
    pub engine: Engine,
    /// Numbers of these cases among the study's.
    pub cases: Range<usize>,
}

#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct Rows {
    /// A row of numbers per case; NaN where there is none.
    pub numbers: Vec<f64>,
    /// Cases that failed, counted within the part, and why.
    pub failed: Vec<(usize, String)>,
    pub cpu_s: f64,
}

/// The first line of a file.
#[derive(Serialize, Deserialize)]
struct PartHead {
    ibr_sweep_part: u32,
    numbers: usize,
    failed: Vec<(usize, String)>,
    cpu_s: f64,
}

impl StudyPart {
    /// Its file in the folder of a sweep: the hash of all that its numbers depend on, code by its version.
    pub(crate) fn path(&self, study: &Study, folder: &Path) -> PathBuf {
        let engine = match self.engine {
            Engine::Reduced => format!("reduced {}", env!("CARGO_PKG_VERSION")),
            Engine::Elements => format!("finite elements {}", fem::ENGINE),
        };
        let words: Vec<String> = study.outputs.iter().map(|output| format!("{output:?}").to_lowercase()).collect();
        let mut told = format!("ibr sweep {FORMAT}, {engine}, {}\n{}\n", words.join(" "), study.base.text).into_bytes();
        let per_robot = study.per_robot();
        for robot in self.robots(per_robot) {
            let CaseChanges { values, pressures_kpa } = study.changes(robot);
            values.iter().for_each(|(key, value)| told.extend(format!("{key} = {value}\n").bytes()));
            let pressures = match &pressures_kpa {
                Some(channels) => &channels[..],
                None => &study.pressures_kpa[self.pressures(robot, per_robot)],
            };
            pressures.iter().for_each(|kpa| told.extend(kpa.to_le_bytes()));
        }
        folder.join("parts").join(format!("{}.part", &sha256(&told)[..32]))
    }

    pub(crate) fn robots(&self, per_robot: usize) -> Range<usize> {
        self.cases.start / per_robot..self.cases.end.div_ceil(per_robot)
    }

    pub(crate) fn pressures(&self, robot: usize, per_robot: usize) -> Range<usize> {
        let first = robot * per_robot;
        self.cases.start.max(first) - first..self.cases.end.min(first + per_robot) - first
    }
}

/// All parts of a study in order: equal pieces, for finite elements of whole robots.
pub(crate) fn parts(study: &Study) -> Vec<StudyPart> {
    let of = |engine: &Engine| {
        let (engine, cases, per_robot) = (*engine, study.cases(*engine), study.per_robot());
        let size = match engine {
            Engine::Reduced => cases.div_ceil(PARTS).clamp(PART[0], PART[1]),
            Engine::Elements => per_robot * (cases / per_robot).div_ceil(PARTS),
        };
        (0..cases.div_ceil(size)).map(move |k| StudyPart { engine, cases: k * size..cases.min((k + 1) * size) })
    };
    study.engines.iter().flat_map(of).collect()
}

impl Rows {
    pub(crate) fn fail(&mut self, width: usize, why: String) {
        self.failed.push((self.numbers.len() / width, why));
        self.row(width, |_| ());
    }

    /// A row of the numbers that `put` adds, filled up with NaN.
    pub(crate) fn row(&mut self, width: usize, put: impl FnOnce(&mut Vec<f64>)) {
        let end = self.numbers.len() + width;
        put(&mut self.numbers);
        self.numbers.resize(end, f64::NAN);
    }

    pub(crate) fn write(&self, path: &Path) -> Result<(), SweepError> {
        let Rows { numbers, failed, cpu_s } = self;
        let head = PartHead { ibr_sweep_part: FORMAT, numbers: numbers.len(), failed: failed.clone(), cpu_s: *cpu_s };
        let mut bytes = serde_json::to_vec(&head).unwrap_or_default();
        bytes.push(b'\n');
        bytes.extend(numbers.iter().flat_map(|x| x.to_le_bytes()));
        pieces::keep(path, bytes)
    }

    /// Reads them; `None` without a file.
    pub(crate) fn read(path: &Path, count: usize) -> Result<Option<Rows>, SweepError> {
        let Some(bytes) = pieces::kept(path)? else { return Ok(None) };
        Rows::decode(&bytes, count).map(Some).ok_or_else(|| SweepError::damaged(path))
    }

    fn decode(bytes: &[u8], count: usize) -> Option<Rows> {
        let end = bytes.iter().position(|b| *b == b'\n')?;
        let head: PartHead = serde_json::from_slice(&bytes[..end]).ok()?;
        let (values, rest) = bytes[end + 1..].as_chunks::<8>();
        let whole = head.ibr_sweep_part == FORMAT && head.numbers == count && values.len() == count && rest.is_empty();
        let numbers = values.iter().map(|b| f64::from_le_bytes(*b)).collect();
        whole.then_some(Rows { numbers, failed: head.failed, cpu_s: head.cpu_s })
    }
}
