//! C interface of the reduced models, for controllers: `ibr.h` is its header, `examples/controller.c` a control loop on it.
//!
//! A robot is put together once by [`ibr_open`]. Every other call allocates nothing and returns [`IBR_OK`] or why not; the words
//! are then in [`ibr_error`]. No panic crosses the border. One handle belongs to one thread at a time.

#![allow(non_camel_case_types, reason = "names as C has them")]

mod text;

use models::{Aim, CHANNELS, End, Limits, Loads, Model, Prediction, Scenario, Steering, Target, Unsolved};
use std::ffi::{CStr, c_char};
use std::panic::{AssertUnwindSafe, catch_unwind};
use text::Text;

/// Supply channels; every array of pressures has so many; values for channels that feed nothing are ignored.
pub const IBR_CHANNELS: usize = 4;
/// The call did what was asked; its results are written.
pub const IBR_OK: i32 = 0;
/// An argument that means nothing: a null pointer, a negative pressure, a place that is not finite.
pub const IBR_BAD_ARGUMENT: i32 = 1;
/// The robot has no equilibrium at these pressures.
pub const IBR_UNSOLVED: i32 = 2;
/// The tip cannot reach its target; the error text has the range in reach.
pub const IBR_OUT_OF_REACH: i32 = 3;
/// A fault in the library: please report it with its text.
pub const IBR_FAULT: i32 = 4;

const _: () = assert!(IBR_CHANNELS == CHANNELS);

/// A robot, and the buffers of its computations.
pub struct ibr_robot {
    model: Model,
    body_pa: f64,
    state: Prediction,
    steering: Steering,
    error: Text,
}

impl ibr_robot {
    /// Checked pressures, without the channels that feed nothing.
    fn loads(&self, body_pa: f64, given_pa: &[f64; CHANNELS]) -> Result<Loads, Unsolved> {
        let mut actuator_pa = [0.0; CHANNELS];
        self.model.channels().for_each(|channel| actuator_pa[channel] = given_pa[channel]);
        Loads { body_pa, actuator_pa }.checked()
    }
}

/// Pose of the end of the robot's centre line.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ibr_tip {
    /// Coordinate along the undeformed body, m.
    pub x_m: f64,
    /// Coordinate across the undeformed body, towards the actuator, m.
    pub y_m: f64,
    /// Total bending angle from base to tip, rad.
    pub angle_rad: f64,
}

/// Slopes of the tip's pose by the pressure of one channel; not a number where an actuator of the channel is flat.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ibr_slope {
    /// Slope of `x_m` by the channel's pressure, m/Pa.
    pub x_per_pa: f64,
    /// Slope of `y_m` by the channel's pressure, m/Pa.
    pub y_per_pa: f64,
    /// Slope of `angle_rad` by the channel's pressure, rad/Pa.
    pub angle_per_pa: f64,
}

/// Pressures that bring the tip nearest to its target.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ibr_steered {
    /// Pressure of each channel, Pa; 0 where one feeds nothing.
    pub actuator_pa: [f64; IBR_CHANNELS],
    /// Distance of the tip from there, m.
    pub miss_m: f64,
    /// Per channel: -1 its least pressure keeps the tip from coming nearer, 1 its largest does, 0 neither.
    pub held: [i32; IBR_CHANNELS],
}

/// Puts a robot together from the text of a scenario (docs/scenario.md) or the name of a shipped one: spam, cpam, epam, fpam.
/// Null if it is refused; `error`, if not null, then gets the reason, cut to `error_size` bytes with the closing zero.
///
/// # Safety
/// `scenario` is null or ends with a zero; `error` is null or has `error_size` bytes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ibr_open(scenario: *const c_char, error: *mut c_char, error_size: usize) -> *mut ibr_robot {
    let opened = catch_unwind(|| {
        if scenario.is_null() {
            return Err("the scenario is a null pointer".to_string());
        }
        // SAFETY: the caller's promise.
        let text = unsafe { CStr::from_ptr(scenario) }.to_str().map_err(|_| "the scenario is not UTF-8".to_string())?;
        open(models::shipped(text.trim()).unwrap_or(text))
    });
    match opened.unwrap_or_else(|_| Err("a fault in the library: please report it with this scenario".into())) {
        Ok(robot) => Box::into_raw(Box::new(robot)),
        Err(words) => {
            // SAFETY: the caller's promise.
            unsafe { text::copy(&words, error, error_size) };
            std::ptr::null_mut()
        }
    }
}

fn open(text: &str) -> Result<ibr_robot, String> {
    let scenario = Scenario::parse(text).map_err(|fault| fault.in_text(text))?;
    if scenario.is_spatial() {
        return Err("this robot has strips round the body, and this interface knows x and y alone; leave out [[strip]], azimuth_deg and turns".into());
    }
    let model = Model::new(&scenario);
    let (state, steering) = (model.prediction(), model.steering());
    Ok(ibr_robot { model, body_pa: scenario.p_body_pa, state, steering, error: Text::default() })
}

/// Gives a robot back; null is nothing.
///
/// # Safety
/// `robot` is null or comes from [`ibr_open`], and is not used afterwards.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ibr_close(robot: *mut ibr_robot) {
    if !robot.is_null() {
        // SAFETY: the caller's promise. A panic of a destructor ends here.
        let _ = catch_unwind(AssertUnwindSafe(|| drop(unsafe { Box::from_raw(robot) })));
    }
}

/// Why the last call with this robot failed; empty if it did not. Good until the next call with it.
///
/// # Safety
/// `robot` is null or comes from [`ibr_open`].
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ibr_error(robot: *const ibr_robot) -> *const c_char {
    // SAFETY: the caller's promise.
    unsafe { robot.as_ref() }.map_or(c"the robot is a null pointer".as_ptr(), |robot| robot.error.as_ptr())
}

/// Body pressure of the scenario in Pa; not a number for null.
///
/// # Safety
/// `robot` is null or comes from [`ibr_open`].
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ibr_body_pressure(robot: *const ibr_robot) -> f64 {
    // SAFETY: the caller's promise.
    unsafe { robot.as_ref() }.map_or(f64::NAN, |robot| robot.body_pa)
}

/// Largest actuator pressure of the scenario in Pa, up to which inverses search; not a number for null.
///
/// # Safety
/// `robot` is null or comes from [`ibr_open`].
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ibr_largest_pressure(robot: *const ibr_robot) -> f64 {
    // SAFETY: the caller's promise.
    unsafe { robot.as_ref() }.map_or(f64::NAN, |robot| robot.model.p_max_pa())
}

/// Number of markers of the scenario.
///
/// # Safety
/// `robot` is null or comes from [`ibr_open`].
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ibr_marker_count(robot: *const ibr_robot) -> usize {
    // SAFETY: the caller's promise.
    unsafe { robot.as_ref() }.map_or(0, |robot| robot.state.markers.len())
}

/// Tip at the pressures of the body and of the channels, in Pa, on the first loading from rest. `markers_xy_m`, if not null,
/// gets x, y of every marker.
///
/// # Safety
/// `robot` is null or comes from [`ibr_open`]; `actuator_pa` has [`IBR_CHANNELS`] numbers, `tip` is one and `markers_xy_m` has
/// twice as many numbers as there are markers, or any of them is null.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ibr_predict(
    robot: *mut ibr_robot,
    body_pa: f64,
    actuator_pa: *const f64,
    tip: *mut ibr_tip,
    markers_xy_m: *mut f64,
) -> i32 {
    // SAFETY: the caller's promise.
    let (given, tip) = unsafe { (pressures(actuator_pa), tip.as_mut()) };
    let work = |robot: &mut ibr_robot| {
        let (Some(actuator_pa), Some(tip)) = (given, tip) else { return Err(NULL) };
        robot.model.predict(&robot.loads(body_pa, &actuator_pa)?, &mut robot.state)?;
        *tip = tip_of(&robot.state);
        if !markers_xy_m.is_null() {
            let seen = &robot.state.markers;
            // SAFETY: the caller's promise; both are of f64, and a buffer of the caller is none of the robot.
            unsafe { std::ptr::copy_nonoverlapping(seen.as_ptr().cast(), markers_xy_m, 2 * seen.len()) };
        }
        Ok(())
    };
    // SAFETY: the caller's promise.
    unsafe { call(robot, work) }
}

/// Pressure in Pa, the same in every channel, at which the tip has a height in m.
///
/// # Safety
/// `robot` is null or comes from [`ibr_open`]; `pressure_pa` is null or a number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ibr_pressure_for_height(
    robot: *mut ibr_robot,
    body_pa: f64,
    y_m: f64,
    pressure_pa: *mut f64,
) -> i32 {
    // SAFETY: the caller's promise.
    unsafe { inverse(robot, body_pa, Target::TipHeight(y_m), pressure_pa) }
}

/// Pressure in Pa, the same in every channel, at which the robot is bent by an angle in rad.
///
/// # Safety
/// As [`ibr_pressure_for_height`].
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ibr_pressure_for_angle(
    robot: *mut ibr_robot,
    body_pa: f64,
    angle_rad: f64,
    pressure_pa: *mut f64,
) -> i32 {
    // SAFETY: the caller's promise.
    unsafe { inverse(robot, body_pa, Target::Angle(angle_rad), pressure_pa) }
}

/// # Safety
/// As [`ibr_pressure_for_height`].
unsafe fn inverse(robot: *mut ibr_robot, body_pa: f64, target: Target, pressure_pa: *mut f64) -> i32 {
    // SAFETY: the caller's promise.
    let pressure_pa = unsafe { pressure_pa.as_mut() };
    let work = |robot: &mut ibr_robot| {
        let Some(found) = pressure_pa else { return Err(NULL) };
        let Loads { body_pa, .. } = Loads::uniform(body_pa, 0.0).checked()?;
        *found = robot.model.pressure_for(target, body_pa, &mut robot.state)?;
        Ok(())
    };
    // SAFETY: the caller's promise.
    unsafe { call(robot, work) }
}

/// Slopes of the tip's pose by the pressure of every channel.
///
/// # Safety
/// `robot` is null or comes from [`ibr_open`]; `actuator_pa` and `slopes` are null or have [`IBR_CHANNELS`] entries.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ibr_jacobian(
    robot: *mut ibr_robot,
    body_pa: f64,
    actuator_pa: *const f64,
    slopes: *mut ibr_slope,
) -> i32 {
    // SAFETY: the caller's promise.
    let (given, slopes) = unsafe { (pressures(actuator_pa), slopes.cast::<[ibr_slope; IBR_CHANNELS]>().as_mut()) };
    let work = |robot: &mut ibr_robot| {
        let (Some(actuator_pa), Some(slopes)) = (given, slopes) else { return Err(NULL) };
        let found = robot.model.jacobian(&robot.loads(body_pa, &actuator_pa)?, &mut robot.state)?;
        *slopes = found.map(|models::TipSlope { x_per_pa, y_per_pa, angle_per_pa }| ibr_slope {
            x_per_pa,
            y_per_pa,
            angle_per_pa,
        });
        Ok(())
    };
    // SAFETY: the caller's promise.
    unsafe { call(robot, work) }
}

/// Pressures from 0 to the largest of the scenario that bring the tip nearest to a place in m. `now_pa`, if not null, are the
/// present pressures, from which none changes by more than `change_pa`: a rate times the time of a cycle.
///
/// # Safety
/// `robot` is null or comes from [`ibr_open`]; `now_pa` is null or has [`IBR_CHANNELS`] numbers; `steered` is null or one.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ibr_steer(
    robot: *mut ibr_robot,
    body_pa: f64,
    x_m: f64,
    y_m: f64,
    now_pa: *const f64,
    change_pa: f64,
    steered: *mut ibr_steered,
) -> i32 {
    // SAFETY: the caller's promise.
    let (now, steered) = unsafe { (pressures(now_pa), steered.as_mut()) };
    let work = |robot: &mut ibr_robot| {
        let Some(steered) = steered else { return Err(NULL) };
        let Loads { body_pa, .. } = Loads::uniform(body_pa, 0.0).checked()?;
        let all = Limits::up_to(robot.model.p_max_pa());
        let limits = now.map_or(all, |now| all.near(&now, change_pa));
        let found = robot.model.steer(Aim::Tip([x_m, y_m]), body_pa, &limits, &mut robot.steering)?;
        let held = found.held.map(|end| match end {
            None => 0,
            Some(End::Least) => -1,
            Some(End::Most) => 1,
        });
        *steered = ibr_steered { actuator_pa: found.loads.actuator_pa, miss_m: found.miss_m, held };
        Ok(())
    };
    // SAFETY: the caller's promise.
    unsafe { call(robot, work) }
}

/// Pressures that were given.
///
/// # Safety
/// It is null or has [`IBR_CHANNELS`] numbers.
unsafe fn pressures(given_pa: *const f64) -> Option<[f64; CHANNELS]> {
    // SAFETY: the caller's promise; an array is aligned as its numbers.
    unsafe { given_pa.cast::<[f64; CHANNELS]>().as_ref() }.copied()
}

fn tip_of(at: &Prediction) -> ibr_tip {
    let models::Tip { x_m, y_m, angle_rad, .. } = at.tip;
    ibr_tip { x_m, y_m, angle_rad }
}

const NULL: Unsolved = Unsolved::BadAim { what: "a pointer for pressures or for the answer is null" };

/// Works with a robot; its error text then belongs to this call.
///
/// # Safety
/// `robot` is null or comes from [`ibr_open`].
unsafe fn call(robot: *mut ibr_robot, work: impl FnOnce(&mut ibr_robot) -> Result<(), Unsolved>) -> i32 {
    // SAFETY: the caller's promise.
    let Some(robot) = (unsafe { robot.as_mut() }) else { return IBR_BAD_ARGUMENT };
    robot.error.clear();
    match catch_unwind(AssertUnwindSafe(|| work(robot))) {
        Ok(Ok(())) => IBR_OK,
        Ok(Err(error)) => {
            robot.error.say(format_args!("{error}"));
            code(&error)
        }
        Err(_) => {
            robot.error.say(format_args!("a fault in the library: please report it"));
            IBR_FAULT
        }
    }
}

fn code(error: &Unsolved) -> i32 {
    match error {
        Unsolved::BadPressure { .. }
        | Unsolved::BadAim { .. }
        | Unsolved::BadTime { .. }
        | Unsolved::InSpace { .. } => IBR_BAD_ARGUMENT,
        Unsolved::OutOfReach { .. } | Unsolved::Jump { .. } => IBR_OUT_OF_REACH,
        Unsolved::NoEquilibrium { .. }
        | Unsolved::Formula { .. }
        | Unsolved::NoValue { .. }
        | Unsolved::NotConverged { .. } => IBR_UNSOLVED,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_panic_ends_at_the_border_and_the_robot_goes_on() {
        // SAFETY: a text that ends with a zero; the robot is used while it is open.
        unsafe {
            let robot = ibr_open(c"epam".as_ptr(), std::ptr::null_mut(), 0);
            assert_eq!(call(robot, |_| panic!("a fault")), IBR_FAULT);
            assert!(CStr::from_ptr(ibr_error(robot)).to_bytes().starts_with(b"a fault in the library"));
            let mut p = 0.0;
            assert_eq!(ibr_pressure_for_height(robot, 2e3, 0.05, &raw mut p), IBR_OK);
            ibr_close(robot);
        }
    }
}
