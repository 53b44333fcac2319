//! One section with three strips: its equilibrium is one, and strips found together are those found one by one.

use super::frame::direction;
use super::section::{StripSection, dot};
use super::state::StripState;
use super::tests::{full, random, robot};
use crate::Model;

/// A second and a third strip.
const THREE: &str = "[[strip]]\nazimuth_deg = 95\nchannel = 1\n[[strip]]\nazimuth_deg = 190\nchannel = 2";

/// Three to four strips at random azimuths and pressures: always a state, and the one from any start.
#[test]
fn every_set_of_pressures_has_one_equilibrium() {
    let mut random = random(7);
    for scenario in
        [robot("epam", "", THREE), full("", THREE), robot("fpam", "", THREE), full("", THREE).with_bending(0.5)]
    {
        let model = Model::new(&scenario);
        let section = StripSection::new(model.assembly(), 0, 2e3);
        for _ in 0..200 {
            let pressures: [f64; 3] = std::array::from_fn(|_| (100.0 * random() * random() - 2.0).max(0.0) * 1e3);
            let mut strips = pressures.map(|p_act_pa: f64| StripState { p_act_pa, ..StripState::default() });
            let pulled = strips;
            let at = section.solve(&mut strips).unwrap_or_else(|e| panic!("{pressures:?}: {e}"));
            if strips.iter().filter(|strip| strip.tension > 0.0).count() < 2 {
                continue;
            }
            let start = [8.0 * random() - 4.0, 8.0 * random() - 4.0];
            let mut strips = pulled;
            section.acting(&mut strips);
            let other = section.minimum(&mut strips, start).unwrap_or_else(|e| panic!("{pressures:?} {start:?}: {e}"));
            let off = (other.kappa[0] - at.kappa[0]).hypot(other.kappa[1] - at.kappa[1]);
            assert!(off < 1e-6, "{pressures:?} from {start:?}: {off:e} {at:?} {other:?}");
        }
    }
}

/// The reference halves the contraction, and finds every coordinate for itself within its range.
#[test]
fn strips_found_together_have_the_contraction_of_strips_found_one_by_one() {
    let mut random = random(11);
    let grown = robot("epam", "", THREE).with_effect("arm_growth", &[0.5]);
    let (mut slack, mut taut) = (0, 0);
    for scenario in
        [robot("epam", "", THREE), full("", THREE), robot("fpam", "", THREE), robot("spam", "", THREE), grown]
    {
        let model = Model::new(&scenario);
        let section = StripSection::new(model.assembly(), 0, 2e3);
        let thrust_n = 2e3 * section.area_m2;
        for _ in 0..300 {
            let pressures: [f64; 3] = std::array::from_fn(|_| 60e3 * (random() * random()).powi(2));
            let mut strips = pressures.map(|p_act_pa: f64| StripState { p_act_pa, ..StripState::default() });
            section.acting(&mut strips);
            if strips.iter().all(|strip| !strip.is_open) {
                continue;
            }
            let kappa = [6.0 * random() - 3.0, 6.0 * random() - 3.0];
            let pull = |contraction: f64| -> f64 {
                let open = section.opened(&strips);
                let each = open.map(|(i, strip, actuator)| {
                    let (k, own) = (dot(kappa, direction(strip.azimuth_rad)), &strips[i]);
                    let a = section.coordinate(strip, actuator, own, contraction, k);
                    section.fit(strip, actuator, own.p_act_pa, a, k).force
                });
                each.sum()
            };
            let floor = section.radius_m * kappa[0].hypot(kappa[1]);
            let expected = match pull(floor) > thrust_n {
                true => crate::root::halved([floor, 1.0_f64.max(2.0 * floor)], 60, |e0| pull(e0) > thrust_n)[0],
                false => floor,
            };
            let mut found = strips;
            let Ok(balance) = section.balance(&mut found, kappa) else { continue };
            *(if expected > floor { &mut slack } else { &mut taut }) += 1;
            let off = (balance.contraction - expected).abs();
            assert!(off < 1e-9, "{pressures:?} {kappa:?}: {} and {expected}", balance.contraction);
        }
    }
    assert!(slack > 200 && taut > 200, "{slack} slack, {taut} taut");
}
