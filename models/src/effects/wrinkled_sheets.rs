//! Wrinkled sheets: fabric that is pressed together wrinkles, and goes on carrying the load at which it does.
//!
//! Wrinkles along a tension T, of a length ℓ between the lines that keep the sheet flat, carry a load across T that does not depend on
//! how deep they are. T and ℓ are as in the finite elements:
//!
//! ```text
//! N = 2π √(D T)/ℓ per width     T = p_b R
//! wall   ℓ = ½ s,  shortened by κ h at the height h above the far side, R' (1 − w/s) in the mean,  κ = ε/D₀
//! sides  ℓ = ½ W,  four arcs of ½πa₀, shortened by ½ε in the mean
//! E = 4π √(D p_b R) [R' (1 − w/s)/D₀ + e π a₀/W] ε per metre
//! ```
//!
//! s, w and R' are arc, chord and radius of the wall's section (`section.rs`), D₀ is the arm, a₀ the half height of the lens in its middle,
//! e the edge restraint of the actuator (1 sealed); sides with `gussets` are as round, so e is 1 for them too. The wall is shortened by its
//! actuator, not by loads. The middle of a pouch, which an arc keeps at its length, and the flaps of gussets carry nothing. In a full pouch
//! the tension is P̄ a₀ and the wrinkles are shorter, so that its sides carry up to three times as much. Neither engine has that.

use super::entry::*;
use crate::fabrics::wrinkling_load_n_per_m;
use crate::gusset::half_height;
use crate::trig::sin_cos;
use std::f64::consts::PI;

pub(super) const ENTRY: Effect = Effect {
    name: "wrinkled_sheets",
    formula: "E = 4π √(D p_b R) [R' (1 − w/s)/D₀ + e π a₀/W] ε per metre",
    sentence: "Wall and sides of the pouches are pressed together as the robot bends, and their wrinkles carry a load.",
    differs: "The bend comes late and less, most where the pull is weak: at low pressures.",
    remedy: "Measure the bending length of the fabric, and compare with a thinner one.",
    validity: "many shallow wrinkles along the hoop tension of the body",
    reference: "Cerda and Mahadevan 2003; sums derived here",
    parameters: &[parameter("bending_nm", "D", "N m", 1.0)
        .usual(1e-4, [0.0, 1e-2])
        .fitted(Fitted::FromDesign)
        .means("bending stiffness of one sheet")],
    needs: Needs::Family(Family::Pouch),
    add: |values, assembly| {
        if values[0] == 0.0 {
            return;
        }
        for site in assembly.active_sites(Family::Pouch) {
            let load = |length_m: f64| wrinkling_load_n_per_m(values[0], site.radius_m, length_m);
            let arc_m = 2.0 * PI * site.radius_m - site.strip_m;
            let height = |s: CutSection| s.radius_m * (1.0 - site.strip_m / arc_m);
            let sealed = site.actuator.map_or(0.0, |actuator| (actuator.edge_restraint)(&site.shape));
            let term = WrinkledSheets {
                wall: site.drawn_in(site.strip_m).map_or(0.0, height) * load(0.5 * arc_m) * arc_m / site.linkage.arm_m,
                sides: sealed.max(site.gusset_share) * load(0.5 * site.shape.width_m) * PI,
                length_m: site.shape.length_m,
            };
            site.act(term, SideEffects::SHIFT);
        }
    },
    ..BALANCE
};

struct WrinkledSheets {
    /// Load over √p_b of the wall \[m √N\], and of the sides over a₀ √p_b \[√N\].
    wall: f64,
    sides: f64,
    length_m: f64,
}

impl Term for WrinkledSheets {
    fn line(&self) -> LedgerLine {
        ENTRY.line(Account::Wall)
    }

    fn add(&self, at: &Pose, force: &mut [f64]) -> f64 {
        let (theta, contraction) = (at.q[actuator_q::COORDINATE], at.q[actuator_q::CONTRACTION]);
        let root = at.p_body_pa.max(0.0).sqrt();
        if theta == 0.0 {
            // A flat pouch has no sides yet, and below the quotients are 0/0.
            force[actuator_q::CONTRACTION] -= root * self.wall;
            return root * self.wall * contraction;
        }
        let [height, d_height] = half_height(self.length_m, theta, sin_cos(0.5 * theta));
        let load = root * (self.wall + self.sides * height);
        force[actuator_q::CONTRACTION] -= load;
        force[actuator_q::COORDINATE] -= root * self.sides * d_height * contraction;
        load * contraction
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Model, Scenario};

    /// The sums again, strip by strip: the wall around the section, and the sides across their arcs, whose lines are shortened by
    /// ε cos² of the angle from the seam.
    #[test]
    fn wall_and_sides_carry_the_load_of_their_strips() {
        let with = format!(
            "{}\n[effects.chord_arm]\nshare = 1\n{}",
            crate::shipped("epam-textbook").unwrap(),
            "[effects.wrinkled_sheets]\nbending_nm = 5e-5\n"
        );
        let model = Model::new(&Scenario::parse(&with).unwrap());
        let site = &model.assembly().sites[0];
        let (p_body, theta, contraction) = (2e3, 1.1, 0.2);
        let mut force = [0.0; 4];
        let q = [theta, contraction, 0.0, 0.0];
        let term = site.actuator_terms.last().unwrap();
        let energy = term.add(&Pose::new(&q, p_body, 3e4), &mut force);
        let tension = p_body * 0.04;
        let load = |length_m: f64| 2.0 * PI * (5e-5 * tension).sqrt() / length_m;
        let section = site.drawn_in(0.06).unwrap();
        let (arc, n) = (2.0 * PI * 0.04 - 0.06, 20_000);
        let kappa = contraction / section.chord_m;
        let wall: f64 = (0..n)
            .map(|i| {
                let at = ((f64::from(i) + 0.5) / f64::from(n) - 0.5) * arc;
                let height = section.radius_m * (1.0 - (at / section.radius_m).cos());
                load(0.5 * arc) * kappa * height * arc / f64::from(n)
            })
            .sum();
        let a = 0.06 / (2.0 * theta) * (1.0 - theta.cos());
        let sides: f64 = (0..n)
            .map(|i| {
                let angle = (f64::from(i) + 0.5) / f64::from(n) * 0.5 * PI;
                4.0 * load(0.03) * contraction * angle.cos().powi(2) * a * 0.5 * PI / f64::from(n)
            })
            .sum();
        assert!((energy / (wall + sides) - 1.0).abs() < 1e-6, "{energy} {wall} {sides}");
        assert!((-force[actuator_q::CONTRACTION] * contraction / energy - 1.0).abs() < 1e-12);
    }
}
