//! After `ibr_open` no call allocates: counted by an instrumented allocator.

#![allow(clippy::unwrap_used, reason = "tests: a panic is the failure to report")]

use ibr_capi::*;
use stats_alloc::{INSTRUMENTED_SYSTEM, Region, StatsAlloc};
use std::alloc::System;
use std::ptr::null_mut;

#[global_allocator]
static COUNTING: &StatsAlloc<System> = &INSTRUMENTED_SYSTEM;

// Without the test harness, whose own thread allocates at any time and would be counted too.
fn main() {
    for name in [c"spam", c"cpam", c"epam", c"fpam"] {
        let region = Region::new(COUNTING);
        // SAFETY: a text that ends with a zero, and no buffer.
        let robot = unsafe { ibr_open(name.as_ptr(), null_mut(), 0) };
        assert!(!robot.is_null() && region.change().allocations > 0, "the counter counts");
        let mut tip = ibr_tip { x_m: 0.0, y_m: 0.0, angle_rad: 0.0 };
        let mut slopes = [ibr_slope { x_per_pa: 0.0, y_per_pa: 0.0, angle_per_pa: 0.0 }; IBR_CHANNELS];
        let mut steered = ibr_steered { actuator_pa: [0.0; IBR_CHANNELS], miss_m: 0.0, held: [0; IBR_CHANNELS] };
        let (mut pressure_pa, mut markers, all) = (0.0, [0.0; 12], [20e3; IBR_CHANNELS]);
        let region = Region::new(COUNTING);
        // SAFETY: the robot is open, every pointer leads to as many numbers as told.
        let codes = unsafe {
            [
                ibr_predict(robot, 2e3, all.as_ptr(), &raw mut tip, markers.as_mut_ptr()),
                ibr_pressure_for_height(robot, 2e3, 0.05, &raw mut pressure_pa),
                ibr_pressure_for_angle(robot, 2e3, 0.3, &raw mut pressure_pa),
                ibr_jacobian(robot, 2e3, all.as_ptr(), slopes.as_mut_ptr()),
                ibr_steer(robot, 2e3, tip.x_m, tip.y_m, all.as_ptr(), 1e3, &raw mut steered),
                // What is refused is said without the heap too.
                ibr_predict(robot, -1.0, all.as_ptr(), &raw mut tip, null_mut()),
                ibr_pressure_for_height(robot, 2e3, 0.5, &raw mut pressure_pa),
            ]
        };
        let change = region.change();
        assert_eq!(change.allocations + change.reallocations, 0, "{name:?}");
        assert_eq!(codes, [0, 0, 0, 0, 0, IBR_BAD_ARGUMENT, IBR_OUT_OF_REACH], "{name:?}");
        // SAFETY: opened above, not used again.
        unsafe { ibr_close(robot) };
    }
    println!("predict, inverse, Jacobian and steering through C allocate nothing after set-up");
}
