//! Every check of the finite element engine against its known answer.

use crate::alone;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use verification::checks::{CHECKS, Check};

#[test]
fn the_engine_meets_every_known_answer() {
    let _alone = alone();
    let missed = Mutex::new(Vec::new());
    let next = AtomicUsize::new(0);
    // Long ones first, so that both workers end together.
    let mut checks: Vec<&Check> = CHECKS.iter().collect();
    checks.sort_by_key(|check| !check.slow);
    std::thread::scope(|scope| {
        for _ in 0..2 {
            scope.spawn(|| {
                while let Some(check) = checks.get(next.fetch_add(1, Ordering::Relaxed)) {
                    missed.lock().unwrap().extend(judge(check));
                }
            });
        }
    });
    let missed = missed.into_inner().unwrap();
    assert!(missed.is_empty(), "{}", missed.join("\n"));
}

fn judge(check: &Check) -> Vec<String> {
    match (check.run)() {
        Ok(outcome) => {
            let bad = outcome.lines.iter().filter(|line| !line.passes());
            bad.map(|l| format!("{}: {} is {}, wanted {:?}", check.name, l.quantity, l.measured, l.against)).collect()
        }
        Err(e) => vec![format!("{}: {e}", check.name)],
    }
}
