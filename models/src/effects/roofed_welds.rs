//! Roofed welds: where the actuator pulls weakly, the gas of the body lifts the middle of a weld to a roof.
//!
//! Both halves of the weld are straight and climb by γ to a ridge. A roof holds more of the body's gas than a chord, but its sheets, half a
//! height a above and below it, turn by 2γ at the ridge: that takes 2a tanγ of the width and 4a² tanγ of the section. The sides take more of
//! a roofed wall, too. The ridge is where the energy is least:
//!
//! ```text
//! E = σ min over γ ≥ 0 of  p_b [(A(0) − A(γ)) L₀ + (2 tanγ A'(γ) + n (A'(γ) − A'(0))) I₁] + 4 tanγ P̄ I₂   per pitch L₀
//! A(γ) = A_c(w cosγ) + ¼ w² sinγ cosγ     A'(γ) = ∂A/∂w = R' cosα cosγ + ½ w sinγ cosγ
//! P̄ = P − χ p_b     n = (π − 2) q e     I₁ = ∫ a dx     I₂ = ∫ a² dx
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | γ | slope of both halves of the weld | rad |
//! | w | length of the weld | m |
//! | A_c, R', α | section of the body with a chord of that length, its radius and half chord angle (`section.rs`) | m², m, rad |
//! | n | narrowing by the sides of `sealed_sides` over a | - |
//!
//! Each function of γ is a parabola through its values at 0, γ₀ and ½γ₀, γ₀ where A is largest, so γ = −c₁/2c₂ and E = −c₁²/4c₂ for c₁ < 0:
//! within 3 % of the exact functions. Flat pouches have the energy of the gas in their roofs. There is one state for every load; finite
//! elements have the same tips while the pressure rises and falls. Left out: the arm, which a roof raises (up to 8 % of a bend of a few
//! degrees); the outer sheet's own round over the ridge; a base that is held round, next to which half a pouch stays a roof.

use super::entry::*;
use super::sealed_sides::SealedSides;
use crate::gusset::NARROWED;
use crate::root::halved;
use crate::trig::sin_cos;
use std::f64::consts::FRAC_PI_4;

pub(super) const ENTRY: Effect = Effect {
    name: "roofed_welds",
    formula: "E = min over γ of p_b [(A(0) − A(γ)) L₀ + (2 tanγ A' + n (A' − A'(0))) ∫a dx] + 4 tanγ (P − χ p_b) ∫a²dx per pitch",
    sentence: "The gas of the body lifts the middle of each weld to a roof, and the pouches open only as they pull it flat.",
    differs: "The bend comes late: much is missing below 2.5 times the body's pressure, and above it with pouches that are short.",
    remedy: "Look along the robot at low pressure: whether its welds are straight or rise in the middle.",
    validity: "welds across the wall that fold in their middle",
    reference: "derived here",
    parameters: &[SHARE.means("1: welds that fold in their middle, 0: welds that stay straight")],
    needs: Needs::Family(Family::Pouch),
    add: |values, assembly| {
        if values[0] == 0.0 {
            return;
        }
        for site in assembly.active_sites(Family::Pouch) {
            if let Some(term) = RoofedWelds::new(values[0], site) {
                let closes = values[0] * term.closes();
                site.act(term, SideEffects { closes, ..SideEffects::SHIFT });
            }
        }
    },
    ..BALANCE
};

/// Factors of γ and γ².
type Parabola = [f64; 2];

struct RoofedWelds {
    sealed: SealedSides,
    /// Share per pitch, σ/L \[1/m\]; the rest of the pitch is in the active fraction.
    share: f64,
    /// Narrowing of the sides over q a.
    narrows: f64,
    /// (A(γ) − A(0)) L₀ \[m³\].
    gained: Parabola,
    /// 2 tanγ A'(γ) and A'(γ) − A'(0) \[m\].
    ridge: Parabola,
    sides: Parabola,
    /// 4 tanγ
    lost: Parabola,
}

/// Area of the section with a roofed weld of length w and slope γ, and its slope by w.
fn roofed(site: &Site, width_m: f64, gamma: f64) -> Option<[f64; 2]> {
    let (sin, cos) = sin_cos(gamma);
    let section = site.drawn_in(width_m * cos)?;
    let half = 0.5 * width_m * sin * cos;
    Some([section.area_m2 + 0.5 * width_m * half, section.by_chord_m() * cos + half])
}

impl RoofedWelds {
    /// `None`: a weld too wide for the body.
    fn new(share: f64, site: &Site) -> Option<RoofedWelds> {
        let width_m = site.strip_m;
        // ∂A/∂γ = −w sinγ R' cosα + ¼ w² cos 2γ
        let rises = |gamma: f64| {
            let (sin, cos) = sin_cos(gamma);
            let pull_m = site.drawn_in(width_m * cos).map_or(0.0, |section| section.by_chord_m());
            0.25 * width_m * (1.0 - 2.0 * sin * sin) > sin * pull_m
        };
        let [_, highest] = halved([0.0, FRAC_PI_4], 50, rises);
        let [flat, half, whole] = [0.0, 0.5 * highest, highest].map(|gamma| roofed(site, width_m, gamma));
        let [flat, half, whole] = [flat?, half?, whole?];
        let through = |half: f64, whole: f64| {
            let bend = (whole - 2.0 * half) * 2.0 / (highest * highest);
            [whole / highest - bend * highest, bend]
        };
        let tan = [0.5 * highest, highest].map(f64::tan);
        // Welds take as much of the pitch as of the width.
        let pitch_m = site.shape.length_m + site.strip_m - site.shape.width_m;
        Some(RoofedWelds {
            sealed: SealedSides::new(share, site),
            share: share / site.shape.length_m,
            narrows: site.side_effects.narrows + NARROWED * site.gusset_share,
            gained: through(half[0] - flat[0], whole[0] - flat[0]).map(|factor| factor * pitch_m),
            ridge: through(2.0 * tan[0] * half[1], 2.0 * tan[1] * whole[1]),
            sides: through(half[1] - flat[1], whole[1] - flat[1]),
            lost: through(4.0 * tan[0], 4.0 * tan[1]),
        })
    }

    /// As a → 0, the gas of the body resists at the highest ridge with (2 tanγ A' + n (A' − A'(0)))/2W of its pressure.
    fn closes(&self) -> f64 {
        let gamma = -0.5 * self.gained[0] / self.gained[1];
        let [q, _] = self.sealed.side_share(0.0);
        let at = |[a, b]: Parabola| gamma * (a + gamma * b);
        (at(self.ridge) + q * self.narrows * at(self.sides)).max(0.0) / (2.0 * self.sealed.width_m)
    }
}

impl Term for RoofedWelds {
    fn line(&self) -> LedgerLine {
        ENTRY.line(Account::BodyGas)
    }

    fn add(&self, at: &Pose, force: &mut [f64]) -> f64 {
        let theta = at.q[actuator_q::COORDINATE];
        let [first, second] = self.sealed.integrals(theta);
        let [q, d_q] = self.sealed.side_share(theta);
        let (n, d_n) = (self.narrows * q, self.narrows * d_q);
        let gas = (at.p_act_pa - self.sealed.inner * at.p_body_pa).max(0.0);
        // c₁ and c₂ with their slopes by θ.
        let [c1, c2] = [0, 1].map(|k| {
            let taken = self.ridge[k] + n * self.sides[k];
            let value = at.p_body_pa * (taken * first[0] - self.gained[k]) + gas * self.lost[k] * second[0];
            let d_taken = d_n * self.sides[k];
            [value, at.p_body_pa * (taken * first[1] + d_taken * first[0]) + gas * self.lost[k] * second[1]]
        });
        if c1[0] >= 0.0 {
            return 0.0;
        }
        let gamma = -0.5 * c1[0] / c2[0];
        force[actuator_q::COORDINATE] -= self.share * gamma * (c1[1] + gamma * c2[1]);
        0.5 * self.share * gamma * c1[0]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Loads, Model, Scenario};
    use std::f64::consts::PI;

    fn model(more: &str) -> Model {
        Model::new(&Scenario::parse(&format!("{}\n{more}", crate::shipped("epam-textbook").unwrap())).unwrap())
    }

    /// Polygon of the wall's arc and the two halves of the weld, by its corners.
    fn polygon_m2(site: &Site, width_m: f64, gamma: f64) -> f64 {
        let section = site.drawn_in(width_m * gamma.cos()).unwrap();
        let (r, n) = (section.radius_m, 40_000);
        let alpha = section.cos.acos();
        // From one end of the weld round to the other, then the ridge.
        let mut corners: Vec<[f64; 2]> = (0..=n)
            .map(|i| {
                let at = alpha + 2.0 * (PI - alpha) * f64::from(i) / f64::from(n);
                [r * at.sin(), r * at.cos()]
            })
            .collect();
        corners.push([0.0, r * alpha.cos() + 0.5 * width_m * gamma.sin()]);
        let twice: f64 = (0..corners.len())
            .map(|i| {
                let ([x, y], [u, v]) = (corners[i], corners[(i + 1) % corners.len()]);
                x * v - u * y
            })
            .sum();
        0.5 * twice.abs()
    }

    #[test]
    fn a_roofed_section_has_the_area_of_its_polygon_and_the_slope_of_two_widths() {
        let model = model("");
        let site = &model.assembly().sites[0];
        for gamma in [0.0, 0.1, 0.38] {
            let [area, slope] = roofed(site, 0.06, gamma).unwrap();
            assert!((area / polygon_m2(site, 0.06, gamma) - 1.0).abs() < 1e-6, "{gamma}");
            let [more, less] = [1e-6, -1e-6].map(|step| roofed(site, 0.06 + step, gamma).unwrap()[0]);
            assert!(((more - less) / 2e-6 / slope - 1.0).abs() < 1e-6, "{gamma}");
        }
    }

    /// Ends and ridge of the highest roof lie on one circle: no section of a wall and two straight halves is larger.
    #[test]
    fn the_highest_roof_is_inscribed_in_a_circle() {
        let model = model("");
        let site = &model.assembly().sites[0];
        let term = RoofedWelds::new(1.0, site).unwrap();
        let gamma = -0.5 * term.gained[0] / term.gained[1];
        // Both halves and the arc have one radius: s/R' + 4 asin(w/4R') = 2π.
        let arc = 2.0 * PI * 0.04 - 0.06;
        let [low, high] = halved([0.03, 0.06], 60, |r| arc / r + 4.0 * (0.015 / r).asin() > 2.0 * PI);
        let inscribed = (0.015 / (0.5 * (low + high))).asin();
        assert!((gamma / inscribed - 1.0).abs() < 0.05, "{gamma} {inscribed}");
    }

    /// The energy at its least over ridges from flat to steep, without parabolas.
    fn searched(site: &Site, theta: f64, [p_body, p_act]: [f64; 2]) -> f64 {
        let r = 0.03 / theta;
        let n = 4000;
        let (mut first, mut second) = (0.0, 0.0);
        for i in 0..n {
            let phi = theta * ((2 * i + 1) as f64 / f64::from(n) - 1.0);
            let (a, dx) = (r * (phi.cos() - theta.cos()), r * phi.cos() * 2.0 * theta / f64::from(n));
            (first, second) = (first + a * dx, second + a * a * dx);
        }
        let q = 1.05 - 0.355 * r * (1.0 - theta.cos()) / 0.06;
        let [flat, by_flat] = roofed(site, 0.06, 0.0).unwrap();
        let energy = |gamma: f64| {
            let [area, by_width] = roofed(site, 0.06, gamma).unwrap();
            let taken = 2.0 * gamma.tan() * by_width + q * (PI - 2.0) * (by_width - by_flat);
            p_body * ((flat - area) * 0.06 + taken * first) + 4.0 * gamma.tan() * p_act * second
        };
        (0..=600).map(|i| energy(1e-3 * f64::from(i))).fold(0.0, f64::min) / 0.06
    }

    #[test]
    fn the_ridge_is_where_the_energy_is_least() {
        let model = model(
            "[effects.chord_arm]\nshare = 1\n[effects.sealed_sides]\nshare = 1\n[effects.roofed_welds]\nshare = 1\n",
        );
        let site = &model.assembly().sites[0];
        let term = site.actuator_terms.iter().find(|term| term.line().name == "roofed_welds").unwrap();
        let whole = searched(site, 1e-3, [2e3, 3e3]);
        for (theta, p_act) in [(0.1, 3e3), (0.2, 3.4e3), (0.3, 3.6e3), (0.4, 4e3), (0.5, 5e3)] {
            let energy = term.add(&Pose::new(&[theta, 0.0, 0.0, 0.0], 2e3, p_act), &mut [0.0; 4]);
            let least = searched(site, theta, [2e3, p_act]);
            assert!(least < 0.0 && (energy - least).abs() < 0.03 * whole.abs(), "{theta}: {energy} {least} of {whole}");
        }
        // A ridge that costs more than it gains is not there.
        assert_eq!(term.add(&Pose::new(&[1.2, 0.0, 0.0, 0.0], 2e3, 3e4), &mut [0.0; 4]), 0.0);
    }

    #[test]
    fn far_above_the_pressure_of_the_body_welds_are_chords_to_rounding() {
        let tip = |share: f64, kpa: f64| {
            let text = crate::shipped("epam")
                .unwrap()
                .replace("[effects.roofed_welds]\nshare = 1", &format!("[effects.roofed_welds]\nshare = {share}"));
            let model = Model::new(&Scenario::parse(&text).unwrap());
            let mut at = model.prediction();
            model.predict(&Loads::uniform(2e3, 1e3 * kpa), &mut at).unwrap();
            at.tip.y_m
        };
        assert!((tip(1.0, 20.0) / tip(0.0, 20.0) - 1.0).abs() < 1e-14);
        assert!(tip(1.0, 3.0) < 0.3 * tip(0.0, 3.0) && tip(1.0, 5.0) < 0.9 * tip(0.0, 5.0));
    }
}
