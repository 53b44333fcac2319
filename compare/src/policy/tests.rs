//! Each decision changes at the value that the policy states for it.

use super::*;

/// A decision is not taken one per cent below a value, and taken one per cent above it.
fn turns_at(value: f64, decision: impl Fn(f64) -> bool) {
    assert!(!decision(0.99 * value), "below {value}");
    assert!(decision(1.01 * value), "above {value}");
}

#[test]
fn a_second_effect_is_for_more_than_a_twentieth_of_the_error_and_a_tolerance() {
    turns_at(0.5, |after| is_worth_a_second(after, 10.0));
    turns_at(0.15, |after| is_worth_a_second(after, 1.0));
}

#[test]
fn one_effect_may_leave_a_fifth_and_two_less() {
    turns_at(2.0, |after| is_left_over(1, after, 10.0));
    turns_at(1.5, |after| is_left_over(2, after, 10.0));
    turns_at(0.05, |after| is_left_over(1, after, 0.1));
    turns_at(5.0, |after| is_most(after, 10.0));
    // Amplitudes: of a gain of a thousand a hundredth, and one for the noise.
    turns_at(10.9 / 0.99, |gain| is_a_place_left(gain, 990.0));
}

#[test]
fn six_units_part_explanations_and_a_fifth_of_the_error_attempts() {
    turns_at(1.0, helps);
    turns_at(25.0, |gain| !is_a_hint(gain));
    turns_at(0.5, is_worth_a_look);
    turns_at(200.0, is_beyond_doubt);
    turns_at(6.0, |worse| !is_alike(40.0 + worse, 40.0));
    turns_at(8.0, |after| !is_closer(after, 10.0));
    turns_at(7.0, |after| !falls(after, 10.0));
    turns_at(2.5, |after| !is_mostly_gone(after, 10.0));
    turns_at(0.95, |opposite| cancel(-opposite));
}

#[test]
fn a_quarter_of_its_range_is_one_deviation_of_a_shape() {
    turns_at(0.25, |away| away / shape_sd(1.0, 2.0) >= 1.0);
}

/// That they are true is held by `ibr bench discovery`.
#[test]
fn most_stated_sets_hold_the_truth_and_not_all() {
    assert!((0.9..=1.0).contains(&COVERED));
}

#[test]
fn a_fit_is_doubted_by_its_stiffness_its_rest_and_what_was_measured() {
    turns_at(0.2, |more| bending_moves(1.5, 1.5 * (1.0 + more)) && bending_moves(1.5, 1.5 * (1.0 - more)));
    turns_at(5.0, |left| does_not_fit(left, 10.0));
    turns_at(3.0, |deviations| disagree(deviations) && disagree(-deviations));
    turns_at(0.5, |out| !is_within([0.0, 1.0], 1.0 + out, 0.1) && !is_within([0.0, 1.0], -out, 0.1));
    turns_at(1.0, |more| is_another_minimum(40.0 + more, 40.0));
    turns_at(3.0, is_worth_its_time);
}

#[test]
fn strays_are_few_and_a_run_is_odd_by_chance_and_by_size() {
    turns_at(0.05, |share| !are_strays(share, 5));
    assert!(are_strays(0.01, 3) && !are_strays(0.01, 2));
    turns_at(0.001, |p| !run_stands_out(p, 2.0));
    turns_at(1.5, |ratio| run_stands_out(1e-6, ratio) && is_uneven(1e-6, ratio));
    turns_at(0.01, |p| !is_uneven(p, 2.0));
    turns_at(4.0, |deviations| runs_down(deviations) && runs_down(-deviations));
}

#[test]
fn a_twentieth_or_a_tenth_of_a_kilopascal_is_the_same_pressure() {
    turns_at(1e3, |lower| !is_same_pressure(20e3, 20e3 - lower));
    turns_at(100.0, |above| !is_same_pressure(0.0, above));
}

#[test]
fn a_misfit_counts_from_as_much_again_as_the_noise_and_is_allowed_for_at_three_times() {
    turns_at(2.0, misses);
    turns_at(10.0, is_a_misfit);
}

#[test]
fn a_slip_is_told_where_it_is_far_from_chance() {
    turns_at(0.04, |left| !is_a_shift([1.0, left], 1e-6));
    turns_at(1e-3, |chance| !is_a_shift([1.0, 0.01], chance));
    turns_at(0.6, |above| !is_lowest(10.0 + above, [10.0, 30.0]));
    turns_at(0.8, |heading| !is_nearly_straight(heading));
    turns_at(5.0, |after| !is_far_less(after, 10.0));
    turns_at(0.25, |more| is_no_scale(1.0 + more) && is_no_scale(1.0 / (1.0 + more)));
    turns_at(0.1, |off| !is_near_unit(1.0 + off) && !is_near_unit(1.0 - off));
    turns_at(3.0, |half| labels_are_clear(half, 1.0));
}

#[test]
fn a_slip_of_pressures_is_told_where_it_is_clear() {
    turns_at(500.0, |below| !is_not_below(20e3 - below, 20e3));
    turns_at(100.0, |below| is_never_above(2e3 - below, 2e3));
    turns_at(4.0, |worse| is_clearly_better(40.0, 40.0 + worse));
    turns_at(6.0, |worse| !is_as_good(40.0 + worse, 40.0));
    turns_at(2.0, |factor| !is_same_stiffness(1.5 * factor, 1.5) && !is_same_stiffness(1.5 / factor, 1.5));
    assert!(is_same_stiffness(7.0, 0.0));
}

#[test]
fn the_same_ratio_at_a_body_pressure_that_is_not() {
    turns_at(0.03, |off: f64| !is_same_ratio(10.0 * off.exp(), 10.0));
    turns_at(0.1, |off: f64| bodies_differ(2e3 * off.exp(), 2e3) && bodies_differ(2e3, 2e3 * off.exp()));
}

#[test]
fn a_marker_has_moved_beyond_five_millimetres_and_its_noise() {
    turns_at(5e-3, |y| has_moved(y, 5e-4) && has_moved(-y, 5e-4));
    turns_at(1e-2, |y| has_moved(y, 2e-3));
}

#[test]
fn lengths_are_of_one_robot_to_a_fiftieth_and_of_none_beyond_a_kilometre() {
    turns_at(1e3, |value| !is_a_length(value) && !is_a_length(-value));
    assert!(!is_a_length(f64::NAN));
    turns_at(8.0, |more| is_other_length(400.0 + more, 400.0) && is_other_length(400.0 - more, 400.0));
    assert!(!is_other_length(400.0, f64::NAN));
}

#[test]
fn models_meet_to_a_tenth_where_a_robot_is_bent() {
    turns_at(0.1, |off| !meets(off) && !meets(-off));
    turns_at(0.2, |turn| is_bent(turn, 2.0));
    turns_at(0.05, |off| !is_same_reading(20.0 + off, 20.0) && !is_same_reading(20.0, 20.0 + off));
    turns_at(0.4, |off| !is_same_set_point(20.0, 20.0 + off));
    turns_at(1.0, |off| !is_same_station(60.0, 60.0 + off));
    turns_at(3.0, |more| is_beyond(30.0 + more, 30.0));
}

#[test]
fn words_of_a_publication_allow_what_they_say() {
    turns_at(0.02, |share| !is_none(share));
    turns_at(0.05, |share| !is_little(share));
    turns_at(5.0, |below| !is_almost(90.0 - below, 90.0));
    assert!(!is_almost(90.1, 90.0));
}

#[test]
fn what_does_not_matter_grows_with_the_bend() {
    assert_eq!([0.01, 0.03, 0.1].map(tolerance_m), [1.5e-4, 1.5e-4, 5e-4]);
    turns_at(0.5, |error| !is_good_enough(error, 1e3 * tolerance_m(0.1)));
}

#[test]
fn a_specimen_is_odd_from_a_quarter_and_from_a_twentieth_where_chance_does_not_do_it() {
    turns_at(0.25, |off| deviates(off, false) && deviates(-off, false));
    turns_at(0.05, |off| deviates(off, true) && deviates(-off, true));
    turns_at(0.2, |off| !is_like_another(100.0 * (1.0 + off), 100.0) && !is_like_another(100.0 * (1.0 - off), 100.0));
}

#[test]
fn scatter_of_holds_is_printed_from_twice_its_error_on() {
    turns_at(2.0, |variance| holds_scatter(variance, 1.0));
}
