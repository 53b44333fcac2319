//! A folder of challenges that any tool can enter: the rules, what may be named, and the scores of an entry.
//!
//! An entry is a table `case,verdict,names`. Names are from the catalogue, best first, separated by spaces; `a+b` are two effects
//! that act together.

use super::effects::ALSO;
use super::{Claim, ClaimScore, HIDDEN, Riddle, reveal, score};
use compare::CompareError;
use serde::Serialize;
use std::collections::BTreeMap;
use std::path::Path;

/// Words that an entry may have as a verdict.
const VERDICTS: [&str; 3] = ["none", "effect", "out_of_catalog"];
const HEAD: &str = "case,verdict,names";
const RULES: &str = include_str!("rules.md");
const REFERENCE: &str = include_str!("entry.py");

/// Files of a case, or of the whole folder, with their names.
type CaseFiles = Vec<(String, Vec<u8>)>;

/// Name of a case's folder.
pub fn case_name(case: usize) -> String {
    format!("case-{case:03}")
}

/// The files of one case; with a seed the same ones again, without it the hidden effects cannot be guessed.
///
/// # Errors
/// A robot that does not balance.
pub fn case(case: usize, seed: Option<u64>) -> Result<CaseFiles, CompareError> {
    let seed = seed.map(|seed| seed.wrapping_mul(1_000_003).wrapping_add(case as u64));
    Ok(Riddle { seed, ..Riddle::default() }.make(&case_name(case))?.files)
}

/// Rules, the names that may be given, an entry to fill in, and an entry in Python.
pub fn common_files(cases: usize) -> CaseFiles {
    let mut names: Vec<_> = HIDDEN.iter().chain(ALSO).map(|effect| (effect.name, effect.sentence)).collect();
    names.sort_unstable();
    let names: String = names.into_iter().map(|(name, sentence)| format!("{name},\"{sentence}\"\n")).collect();
    let empty: String = (1..=cases).map(|k| format!("{},,\n", case_name(k))).collect();
    [
        ("README.md", RULES.replace("CASES", &cases.to_string())),
        ("effects.csv", format!("name,what_it_does\n{names}")),
        ("entry.csv", format!("{HEAD}\n{empty}")),
        ("entry.py", REFERENCE.to_string()),
    ]
    .map(|(name, text)| (name.to_string(), text.into_bytes()))
    .to_vec()
}

/// `ibr.challenge.score`: `ibr challenge score FOLDER ENTRY.csv`
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct EntryScore {
    /// Cases in the order of their names
    pub cases: Vec<CaseScore>,
    /// Cases whose verdict is the right one of the three
    pub verdicts_right: usize,
    /// Cases that hide an effect of the catalogue
    pub with_effect: usize,
    /// Of these, those whose first name is true
    pub first_true: usize,
    /// Of these, those with a true name among all that are given
    pub among_names: usize,
    /// Names given where an effect of the catalogue is hidden, mean over the answers that have any
    pub mean_names: Option<f64>,
    /// Cases without an effect of the catalogue in which one is asserted
    pub false_names: usize,
}

/// One case of an entry.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct CaseScore {
    /// Name of its folder
    pub case: String,
    /// Effects that are hidden
    pub hidden: Vec<String>,
    /// Answer of the entry
    pub answer: Claim,
    /// Its score
    pub score: ClaimScore,
}

/// Opens the seals of all cases in a folder and scores an entry, given as text with its name for messages.
///
/// # Errors
/// A row that is not an answer, with its line; a case without a row; a seal that is broken.
pub fn score_entry(folder: &Path, name: &str, text: &str) -> Result<EntryScore, CompareError> {
    let mut answers = answers(name, text)?;
    let mut cases = Vec::new();
    for case in (1..).map(case_name).take_while(|case| folder.join(case).is_dir()) {
        let (truth, _) = reveal(&folder.join(&case))?;
        let missing = || refused(name, None, format!("{case} has no row"), "answer every case; `none` is an answer");
        let (_, answer) = answers.remove(&case).ok_or_else(missing)?;
        let score = score(&truth, &answer);
        let hidden = truth.effects.into_iter().map(|choice| choice.name).collect();
        cases.push(CaseScore { case, hidden, answer, score });
    }
    if cases.is_empty() {
        let message = format!("{} has no {}", folder.display(), case_name(1));
        return Err(CompareError::refused(message, "name the folder that `ibr challenge export --out FOLDER` made"));
    }
    if let Some((case, (line, _))) = answers.into_iter().next() {
        let help = format!("cases are {} to {}", case_name(1), case_name(cases.len()));
        return Err(refused(name, Some(line), format!("{case} is not a case of {}", folder.display()), &help));
    }
    let knows = |hidden: &str| HIDDEN.iter().chain(ALSO).any(|effect| effect.name == hidden);
    let (inside, others): (Vec<&CaseScore>, Vec<&CaseScore>) =
        cases.iter().partition(|case| case.hidden.iter().any(|hidden| knows(hidden)));
    let given: Vec<usize> = inside.iter().map(|case| case.answer.set.len()).filter(|count| *count > 0).collect();
    Ok(EntryScore {
        verdicts_right: cases.iter().filter(|case| case.score.verdict_right).count(),
        with_effect: inside.len(),
        first_true: inside.iter().filter(|case| case.score.rank == Some(1)).count(),
        among_names: inside.iter().filter(|case| case.score.in_set).count(),
        mean_names: (!given.is_empty()).then(|| given.iter().sum::<usize>() as f64 / given.len() as f64),
        false_names: others.iter().filter(|case| case.answer.verdict.as_deref() == Some("effect")).count(),
        cases,
    })
}

fn refused(name: &str, line: Option<usize>, message: String, help: &str) -> CompareError {
    let place = line.map_or(name.to_string(), |line| format!("{name}:{line}"));
    CompareError::refused(format!("{place}: {message}"), help)
}

/// Answers by case, with their lines.
fn answers(name: &str, text: &str) -> Result<BTreeMap<String, (usize, Claim)>, CompareError> {
    let mut lines = text.trim_start_matches('\u{feff}').lines().enumerate().map(|(k, line)| (k + 1, line.trim_end()));
    if lines.next().is_none_or(|(_, head)| head != HEAD) {
        return Err(refused(name, Some(1), "this is not the head of an entry".into(), &format!("begin with {HEAD}")));
    }
    let mut found = BTreeMap::new();
    for (line, row) in lines.filter(|(_, row)| !row.is_empty()) {
        let fault = |message: String, help: &str| Err(refused(name, Some(line), message, help));
        let [case, verdict, names] = row.split(',').map(str::trim).collect::<Vec<_>>()[..] else {
            return fault(format!("`{row}` has not three columns"), "for example case-001,effect,gravity friction");
        };
        if !VERDICTS.contains(&verdict) {
            let help = spelling::known(verdict, &VERDICTS);
            return fault(format!("`{verdict}` is not a verdict"), &help);
        }
        let set: Vec<&str> = names.split_whitespace().collect();
        let parts: Vec<&str> = set.iter().flat_map(|entry| entry.split('+')).collect();
        let known: Vec<&str> = models::effects::EFFECTS.iter().map(|effect| effect.name).collect();
        if let Some(unknown) = parts.iter().find(|part| !known.contains(part)) {
            let meant = spelling::meant(unknown, known.iter().copied());
            return fault(
                format!("`{unknown}` is not an effect"),
                &format!("{meant}names are in effects.csv, separated by spaces"),
            );
        }
        if (verdict == "effect") == set.is_empty() {
            return fault(
                "the verdict and the names contradict each other".into(),
                "name effects with the verdict effect only",
            );
        }
        let answer = Claim {
            verdict: Some(verdict.into()),
            ranked: parts.iter().map(|part| (*part).to_string()).collect(),
            set: set.iter().map(|entry| entry.replace('+', " + ")).collect(),
            added: set.first().map_or(Vec::new(), |first| first.split('+').map(String::from).collect()),
        };
        if found.insert(case.to_string(), (line, answer)).is_some() {
            return fault(format!("{case} is there twice"), "give one row a case");
        }
    }
    Ok(found)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn exported(cases: usize) -> tempfile::TempDir {
        let folder = tempfile::tempdir().unwrap();
        for k in 1..=cases {
            let own = folder.path().join(case_name(k));
            std::fs::create_dir(&own).unwrap();
            case(k, Some(7))
                .unwrap()
                .into_iter()
                .for_each(|(name, bytes)| std::fs::write(own.join(name), bytes).unwrap());
        }
        folder
    }

    /// The truth itself is a perfect entry; an entry of nothing names nothing.
    #[test]
    fn the_truth_scores_in_full_and_nothing_scores_the_empty_cases() {
        let folder = exported(12);
        let truths: Vec<_> = (1..=12).map(|k| reveal(&folder.path().join(case_name(k))).unwrap().0).collect();
        let row = |(k, truth): (usize, &crate::Truth)| {
            let names: Vec<&str> = truth.effects.iter().map(|choice| choice.name.as_str()).collect();
            let is_inside = |name: &&str| HIDDEN.iter().chain(ALSO).any(|effect| effect.name == *name);
            let verdict = match (names.len(), names.iter().filter(|name| is_inside(name)).count()) {
                (0, _) => "none",
                (all, inside) if all == inside => "effect",
                _ => "out_of_catalog",
            };
            let names = if verdict == "effect" { names.join("+") } else { String::new() };
            format!("{},{verdict},{names}\n", case_name(k + 1))
        };
        let entry: String = truths.iter().enumerate().map(row).collect();
        let full = score_entry(folder.path(), "entry.csv", &format!("{HEAD}\n{entry}")).unwrap();
        assert_eq!((full.verdicts_right, full.false_names), (12, 0));
        assert!(full.with_effect >= 5 && full.first_true == full.with_effect && full.among_names == full.with_effect);
        let silent: String = (1..=12).map(|k| format!("{},none,\n", case_name(k))).collect();
        let none = score_entry(folder.path(), "entry.csv", &format!("{HEAD}\n{silent}")).unwrap();
        assert_eq!((none.first_true, none.among_names, none.mean_names), (0, 0, None));
        assert_eq!(none.verdicts_right, truths.iter().filter(|truth| truth.effects.is_empty()).count());
    }

    #[test]
    fn rows_that_are_no_answers_are_refused_with_their_line() {
        let folder = exported(1);
        for (rows, words) in [
            ("case-001,efect,gravity", "entry.csv:2: `efect` is not a verdict"),
            ("case-001,effect,gravitty", "entry.csv:2: `gravitty` is not an effect"),
            ("case-001,effect,", "contradict"),
            ("case-001,none,gravity", "contradict"),
            ("case-001,effect", "has not three columns"),
            ("case-001,none,\ncase-001,none,", "entry.csv:3: case-001 is there twice"),
            ("case-001,none,\ncase-002,none,", "entry.csv:3: case-002 is not a case"),
            ("", "case-001 has no row"),
        ] {
            let error = score_entry(folder.path(), "entry.csv", &format!("{HEAD}\n{rows}\n")).unwrap_err();
            assert!(error.to_string().contains(words), "{rows}: {error}");
        }
        assert!(score_entry(folder.path(), "entry.csv", "case;verdict").is_err());
    }
}
