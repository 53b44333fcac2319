//! The numbers that refuse a mesh, stop a run or judge its end. Each comment gives meaning and unit;
//! `tests/policy.sh` moves every one of them and names the tests that fail then.

/// Energy residual over external work that stops a run.
pub(crate) const RESIDUAL: f64 = 0.02;
/// Share of the energy that the loads of a run can turn over, which the residual is judged against at least: elements that start
/// strained lose a part of that energy in the first steps, while pressures are still near zero.
pub(crate) const TURNED_OVER: f64 = 5e-3;
/// Uniform strain of all fabric whose energy it is judged against at least: far above rounding, far below any load.
pub(crate) const STRAIN_FLOOR: f64 = 1e-5;
/// Share of the nodes in contact that may change side of a layer.
pub(crate) const SIDES: f64 = 0.05;
/// Share of the stored energy that hourglass control may hold at the end.
pub(crate) const HOURGLASS: f64 = 0.15;
/// Share of it that is warned of.
pub(crate) const HOURGLASS_WARNED: f64 = 0.05;
/// Share of the stored energy in contact at the end that is warned of: layers that lie on each other hold next to none.
pub(crate) const CAUGHT: f64 = 0.05;
/// Negative volume over (wall area)^(3/2) from which the walls of a chamber have passed through each other: a hundredth of a pillow's.
pub(crate) const INSIDE_OUT: f64 = 1e-3;
/// Volume of gas over (wall area)^(3/2) below which a sealed chamber is empty: 0.2 cm³ in a pillow of 200 mm.
pub(crate) const NO_GAS: f64 = 1e-5;
/// Share of its reference area below which an element counts as collapsed.
pub(crate) const COLLAPSED: f64 = 1e-4;
/// A mesh longer than this was hardly meant in metres \[m\].
pub(crate) const HUGE_M: f64 = 20.0;
/// Elements of a mesh in metres are smaller \[m\].
pub(crate) const LONGEST_SIDE_M: f64 = 0.5;
/// Share of the stored energy in contact from which contact is the likely cause of a stop.
pub(crate) const PRESSED: f64 = 0.2;
/// Added mass over true mass from which it is, and that is warned of.
pub(crate) const HEAVY: f64 = 1.0;
/// Kinetic over internal energy above which the paper's source calls a run invalid.
pub(crate) const KINETIC_OF_INTERNAL: f64 = 0.10;
/// Kinetic over total energy that the paper kept its runs below.
pub(crate) const KINETIC_OF_TOTAL: f64 = 0.01;
/// Movement of the tip that a hold does not wait for, as a share of its displacement from the start.
pub(crate) const CREEP: f64 = 0.005;
/// Displacement of the tip from which on that is judged, as a share of the length.
pub(crate) const BENT: f64 = 0.1;
/// Displacement of a planar robot's tip across its plane over its whole displacement from which it is warned of.
pub(crate) const OUT_OF_PLANE: f64 = 0.02;
/// Pull on a weld over its strength beyond which it opens.
pub(crate) const TORN: f64 = 1.0;
/// A peak of the walls' kinetic energy counts if the valleys on both sides are below this share of it.
pub(crate) const VALLEY: f64 = 0.5;
/// Smallest drop of a snap, as a share of the largest stored energy of the run.
pub(crate) const SMALLEST_DROP: f64 = 0.005;
/// Fewest rows of elements between two welds.
pub(crate) const FEWEST_ROWS: usize = 4;
/// Fewest steps of a run whose masses are all raised: guards look every 64 steps, so a shorter one is never judged.
pub(crate) const FEWEST_STEPS: f64 = 64.0;
/// More outputs than this fill a disk before they help.
pub(crate) const MOST_OUTPUTS: f64 = 100_000.0;
/// Largest number of nodes a generator makes: a slip in a count is a message, not a full memory.
pub(crate) const MOST_NODES: usize = 20_000_000;
/// Memory that a run takes at least for every element; robots of many layers take up to 3.5 times as much \[bytes\].
pub(crate) const LEAST_BYTES: u64 = 1200;
/// Nodes this deep in an obstacle at the start only touch \[m\].
pub(crate) const TOUCHING_M: f64 = 1e-5;
/// Smallest area over the square of the longest side that counts as an area; far below any useful element.
pub(crate) const NO_AREA: f64 = 1e-9;
/// Sine of the smallest angle between warp and normal: 1 degree, below which its projection is arbitrary.
pub(crate) const ACROSS: f64 = 0.0175;

pub(crate) fn is_collapsed(share: f64) -> bool {
    share.is_nan() || share < COLLAPSED
}

pub(crate) fn is_inside_out(share: f64) -> bool {
    share < -INSIDE_OUT
}

/// Whether a sealed chamber has something in it, of its volume over (wall area)^(3/2).
pub(crate) fn holds_gas(share: f64) -> bool {
    share >= NO_GAS
}

pub(crate) fn is_huge(extent_m: f64) -> bool {
    extent_m > HUGE_M
}

/// Whether half of the elements are longer than elements of a mesh in metres, of the median side \[m\].
pub(crate) fn is_coarse(median_side_m: f64) -> bool {
    median_side_m > LONGEST_SIDE_M
}

pub(crate) fn is_pressed(share: f64) -> bool {
    share > PRESSED
}

/// Whether layers are caught in each other at the end, of the share of the stored energy that contact holds.
pub(crate) fn is_caught(share: f64) -> bool {
    share > CAUGHT
}

pub(crate) fn is_heavy(added_mass: f64) -> bool {
    added_mass > HEAVY
}

/// Whether hourglass control is too large for a result without a warning, of its share of the stored energy.
pub(crate) fn is_warped(share: f64) -> bool {
    share > HOURGLASS_WARNED
}

/// Whether a planar robot has left its plane, of its tip's displacement across it over the whole.
pub(crate) fn leaves_plane(share: f64) -> bool {
    share > OUT_OF_PLANE
}

pub(crate) fn is_torn(share: f64) -> bool {
    share > TORN
}

pub(crate) fn is_at_rest(kinetic_share: f64) -> bool {
    kinetic_share < KINETIC_OF_TOTAL
}

/// Whether a run keeps the rule of the paper's source, of its kinetic over its total energy.
pub(crate) fn is_valid(kinetic_share: f64) -> bool {
    // K < r·U is the same as K/(K + U) < r/(1 + r).
    kinetic_share < KINETIC_OF_INTERNAL / (1.0 + KINETIC_OF_INTERNAL)
}

/// Movement of a tip that counts as none \[m\], of the share allowed ([`CREEP`]), its displacement and the robot's length \[m\].
pub(crate) fn moves_no_more_m(creep: f64, tip_m: f64, length_m: f64) -> f64 {
    creep * tip_m.max(BENT * length_m)
}

/// Whether a valley parts two peaks, of the walls' kinetic energies.
pub(crate) fn is_valley(low_j: f64, high_j: f64) -> bool {
    low_j < VALLEY * high_j
}

/// Whether a drop of stored energy is a snap, of the most that was stored.
pub(crate) fn is_a_drop(released_j: f64, most_j: f64) -> bool {
    released_j > SMALLEST_DROP * most_j
}

pub(crate) fn is_fine(rows: usize) -> bool {
    rows >= FEWEST_ROWS
}

/// Whether a run has too few steps to follow any motion.
pub(crate) fn is_too_short(steps: f64) -> bool {
    steps < FEWEST_STEPS
}

pub(crate) fn is_inside(depth_m: f64) -> bool {
    depth_m > TOUCHING_M
}

pub(crate) fn is_area(area: f64, longest_squared: f64) -> bool {
    area > NO_AREA * longest_squared && area.is_finite()
}

/// Whether a warp is in its sheet, of the sine of its angle with the normal.
pub(crate) fn is_in_sheet(sine: f64) -> bool {
    sine >= ACROSS
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A decision is not taken one per cent below a value, and taken one per cent above it.
    fn turns_at(value: f64, decision: impl Fn(f64) -> bool) {
        assert!(!decision(0.99 * value), "below {value}");
        assert!(decision(1.01 * value), "above {value}");
    }

    #[test]
    fn a_mesh_is_refused_by_what_no_robot_is() {
        turns_at(0.5, is_coarse);
        turns_at(1e-5, is_inside);
        turns_at(64.0, |steps| !is_too_short(steps));
        turns_at(1e-9, |area| is_area(area, 1.0));
        assert!(!is_area(f64::INFINITY, 1.0));
        turns_at(0.0175, is_in_sheet);
        assert_eq!([3, 4].map(is_fine), [false, true]);
    }

    #[test]
    fn a_run_is_stopped_or_warned_of_by_shares() {
        turns_at(1e-4, |share| !is_collapsed(share));
        assert!(is_collapsed(f64::NAN));
        turns_at(1e-3, |share| is_inside_out(-share));
        turns_at(1e-5, holds_gas);
        turns_at(20.0, is_huge);
        turns_at(0.2, is_pressed);
        turns_at(1.0, is_heavy);
        turns_at(0.05, is_warped);
        turns_at(0.05, is_caught);
    }

    #[test]
    fn a_run_is_at_rest_below_a_hundredth_and_valid_below_a_tenth_of_its_stored_energy() {
        turns_at(0.01, |share| !is_at_rest(share));
        turns_at(0.1 / 1.1, |share| !is_valid(share));
    }

    #[test]
    fn a_tip_moves_by_half_a_per_cent_of_its_way_or_of_a_tenth_of_the_length() {
        for (tip_m, allowed_m) in [(0.1, 5e-4), (0.001, 1.8e-4)] {
            assert!((moves_no_more_m(CREEP, tip_m, 0.36) / allowed_m - 1.0).abs() < 1e-9);
        }
    }

    #[test]
    fn a_snap_is_a_peak_of_twice_its_valleys_with_a_drop_of_half_a_per_cent() {
        turns_at(0.5, |low| !is_valley(low, 1.0));
        turns_at(0.01, |drop| is_a_drop(drop, 2.0));
    }
}
