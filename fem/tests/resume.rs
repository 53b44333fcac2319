//! A run that goes on from a saved state is the run that was saved, already before its next step.

#![allow(clippy::unwrap_used, reason = "helpers of tests: a panic is the failure to report")]

use fem::case::{Case, shipped_case};
use fem::{FemError, Simulation};
use std::path::Path;

fn small() -> Case {
    let text = shipped_case("pillow").unwrap().replace("elements = 32 ", "elements = 8 ");
    Case::parse(&text, &mut |_: &Path| Err(FemError::Problem("no file".into()))).unwrap()
}

#[test]
fn a_resumed_run_has_the_balance_chambers_and_step_of_the_saved_one_and_the_same_future() {
    let case = small();
    let mut run = Simulation::new(&case.problem).unwrap();
    let go_on = &mut |_: &Simulation| true;
    // An output time, and a moment in the middle of a burst of steps.
    for until_s in [0.01, 0.0317] {
        run.advance_until(until_s, go_on).unwrap();
        let mut again = Simulation::resume(&case.problem, &run.save()).unwrap();
        let state = |r: &Simulation| (r.ledger(), r.chambers(), r.step(), r.dt_s(), r.positions(), r.velocities());
        assert_eq!(state(&run), state(&again));
        assert_eq!(run.element_fields(), again.element_fields());
        run.advance_until(until_s + 0.005, go_on).unwrap();
        again.advance_until(until_s + 0.005, go_on).unwrap();
        assert_eq!(state(&run), state(&again));
        assert!(run.save() == again.save());
    }
}
