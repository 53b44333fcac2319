//! The numbers that refuse a mesh, stop a run or say what to think of its end. Each says what it is and in which unit;
//! `tests/policy.sh` moves every one of them and names the tests that fail then.

/// Energy residual over external work that stops a run.
pub const RESIDUAL: f64 = 0.02;
/// Share of the energy that the loads of a run can turn over, which the residual is judged against at least: elements that start
/// strained lose a part of that energy in the first steps, while pressures are still near zero.
pub const TURNED_OVER: f64 = 5e-3;
/// Uniform strain of all fabric whose energy it is judged against at least: far above rounding, far below any load.
pub const STRAIN_FLOOR: f64 = 1e-5;
/// Share of the nodes in contact that may change side of a layer.
pub const SIDES: f64 = 0.05;
/// Share of the stored energy that hourglass control may hold at the end.
pub const HOURGLASS: f64 = 0.15;
/// Share of it that is warned of.
pub const HOURGLASS_WARNED: f64 = 0.05;
/// Remedy for both: a hundredth of the coefficient alone does not help a film that carries compression, whose pleats are as long as
/// elements.
pub const LESS_HOURGLASS: &str = "for a sheet that pleats, law = \"tension-field\" with the same moduli and a hundredth of hourglass; \
    else a tenth of hourglass or smaller elements";
/// Share of the stored energy in contact at the end that is warned of: layers that lie on each other hold next to none.
pub const CAUGHT: f64 = 0.05;
/// Share of its reference area below which an element counts as collapsed.
pub const COLLAPSED: f64 = 1e-4;
/// A mesh longer than this was hardly meant in metres \[m\].
pub const HUGE_M: f64 = 20.0;
/// Elements of a mesh in metres are smaller \[m\].
pub const LONGEST_SIDE_M: f64 = 0.5;
/// Share of the stored energy in contact from which contact is the likely cause of a stop.
pub const PRESSED: f64 = 0.2;
/// Added mass over true mass from which it is, and that is warned of.
pub const HEAVY: f64 = 1.0;
/// Kinetic over internal energy above which the paper's source calls a run invalid.
pub const KINETIC_OF_INTERNAL: f64 = 0.10;
/// Kinetic over total energy that the paper kept its runs below.
pub const KINETIC_OF_TOTAL: f64 = 0.01;
/// Displacement of a planar robot's tip across its plane over its whole displacement from which it is warned of.
pub const OUT_OF_PLANE: f64 = 0.02;
/// Pull on a weld over its strength beyond which it opens.
pub const TORN: f64 = 1.0;
/// A peak of the walls' kinetic energy stands out if the valleys beside it are below this share of it.
pub const VALLEY: f64 = 0.5;
/// Smallest drop of a snap, as a share of the largest stored energy of the run.
pub const SMALLEST_DROP: f64 = 0.005;
/// Fewest rows of elements between two welds.
pub const FEWEST_ROWS: usize = 4;
/// Fewest steps of a run: guards look every 64 steps, so a shorter one is never judged.
pub const FEWEST_STEPS: f64 = 64.0;
/// More outputs than this fill a disk before they help.
pub const MOST_OUTPUTS: f64 = 100_000.0;
/// Largest number of nodes a generator makes: a slip in a count is a message, not a full memory.
pub const MOST_NODES: usize = 20_000_000;
/// Memory that a run takes at least for every element; robots of many layers take up to 2.5 times as much \[bytes\].
pub const LEAST_BYTES: u64 = 1500;
/// Nodes this deep in an obstacle at the start only touch \[m\].
pub const TOUCHING_M: f64 = 1e-5;
/// Smallest area over the square of the longest side that counts as an area; far below any useful element.
pub const NO_AREA: f64 = 1e-9;
/// Sine of the smallest angle between warp and normal: 1 degree, below which its projection is arbitrary.
pub const ACROSS: f64 = 0.0175;

/// Whether an element has lost its area, of its share of that at rest.
pub fn is_collapsed(share: f64) -> bool {
    share.is_nan() || share < COLLAPSED
}

/// Whether a mesh is as long as no robot \[m\].
pub fn is_huge(extent_m: f64) -> bool {
    extent_m > HUGE_M
}

/// Whether half of the elements are longer than those of a mesh in metres, of the median side \[m\].
pub fn is_coarse(median_side_m: f64) -> bool {
    median_side_m > LONGEST_SIDE_M
}

/// Whether contact is a likely cause of a stop, of its share of the stored energy.
pub fn is_pressed(share: f64) -> bool {
    share > PRESSED
}

/// Whether layers are caught in each other at the end, of the share of the stored energy that contact holds.
pub fn is_caught(share: f64) -> bool {
    share > CAUGHT
}

/// Whether more mass was added than there is.
pub fn is_heavy(added_mass: f64) -> bool {
    added_mass > HEAVY
}

/// Whether hourglass control is no longer small, of its share of the stored energy.
pub fn is_warped(share: f64) -> bool {
    share > HOURGLASS_WARNED
}

/// Whether a planar robot has left its plane, of its tip's displacement across it over the whole.
pub fn leaves_plane(share: f64) -> bool {
    share > OUT_OF_PLANE
}

/// Whether a weld opens, of the pull on it over its strength.
pub fn is_torn(share: f64) -> bool {
    share > TORN
}

/// Whether a run is at rest, of its kinetic over its total energy.
pub fn is_at_rest(kinetic_share: f64) -> bool {
    kinetic_share < KINETIC_OF_TOTAL
}

/// Whether a run keeps the rule of the paper's source, of its kinetic over its total energy.
pub fn is_valid(kinetic_share: f64) -> bool {
    // K < r·U is the same as K/(K + U) < r/(1 + r).
    kinetic_share < KINETIC_OF_INTERNAL / (1.0 + KINETIC_OF_INTERNAL)
}

/// Whether a valley parts two peaks, of the walls' kinetic energies.
pub fn is_valley(low_j: f64, high_j: f64) -> bool {
    low_j < VALLEY * high_j
}

/// Whether a drop of stored energy is a snap, of the most that was stored.
pub fn is_a_drop(released_j: f64, most_j: f64) -> bool {
    released_j > SMALLEST_DROP * most_j
}

/// Whether a pouch has enough elements between its welds.
pub fn is_fine(rows: usize) -> bool {
    rows >= FEWEST_ROWS
}

/// Whether a run has too few steps to follow any motion.
pub fn is_too_short(steps: f64) -> bool {
    steps < FEWEST_STEPS
}

/// Whether a node starts inside an obstacle \[m\].
pub fn is_inside(depth_m: f64) -> bool {
    depth_m > TOUCHING_M
}

/// Whether three or four corners span an area, of it and the square of the longest side.
pub fn is_area(area: f64, longest_squared: f64) -> bool {
    area > NO_AREA * longest_squared && area.is_finite()
}

/// Whether a warp lies in its sheet, of the sine of its angle with the normal.
pub fn is_in_sheet(sine: f64) -> bool {
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
    fn a_snap_is_a_peak_of_twice_its_valleys_with_a_drop_of_half_a_per_cent() {
        turns_at(0.5, |low| !is_valley(low, 1.0));
        turns_at(0.01, |drop| is_a_drop(drop, 2.0));
    }
}
