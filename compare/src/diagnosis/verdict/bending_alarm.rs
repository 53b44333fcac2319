//! A stiffness that moved: the answer has another B than the scenario or a bending test.
//!
//! B is fitted along, and takes up part of whatever is missing: without an effect it hardly ever moves by a fifth, with one that was
//! not found by a third to nine tenths. So an answer whose B is another one is only half an answer, which a bending test completes.

use crate::diagnosis::case::DiagnosisCase;
use crate::diagnosis::experiments::bending_test;
use crate::diagnosis::problem::Fit;
use crate::diagnosis::result::BendingAlarm;
use crate::fit::numbers::largest;
use crate::policy;

pub(crate) fn bending_alarm(case: &DiagnosisCase, last: &Fit) -> Option<BendingAlarm> {
    let test = case.problem.known_bending;
    let given = test.map_or(case.first().scenario.bending_stiffness, |[found, _]| found);
    let is_off = |b: f64| match test {
        Some([found, sd]) => policy::disagree((b - found) / sd),
        None => given > 0.0 && policy::bending_moves(given, b),
    };
    // A bending test is of the first body pressure.
    let count = if test.is_some() { 1.min(case.problem.bendings) } else { case.problem.bendings };
    let off = |k: &usize| is_off(last.theta()[*k]);
    let worst = largest((0..count).filter(off), |k| (last.theta()[*k] - given).abs())?;
    let alarm = BendingAlarm {
        told_nm2: given,
        test_sd_nm2: test.map(|[_, sd]| sd),
        base_nm2: case.base.theta()[worst],
        answer_nm2: last.theta()[worst],
        words: String::new(),
    };
    Some(BendingAlarm { words: words(&alarm, !case.added(last).is_empty()), ..alarm })
}

fn words(alarm: &BendingAlarm, has_answer: bool) -> String {
    let (given, answer) = (alarm.told_nm2, alarm.answer_nm2);
    let of = if has_answer { "This answer has" } else { "The fit has" };
    match alarm.test_sd_nm2 {
        Some(sd) => format!(
            "{of} B = {answer:.2} N·m², and the bending test found {given:.2} ± {sd:.2}: they contradict each other. Look at the test \
             again, and do not believe the answer before."
        ),
        None => format!(
            "{of} B = {answer:.2} N·m², and the scenario has {given:.2} ({:+.0} %): either this robot has that stiffness, or an effect \
             hides in it. A bending test decides: {}.",
            100.0 * (answer / given - 1.0),
            bending_test().sentence
        ),
    }
}
