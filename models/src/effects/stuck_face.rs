//! Stuck face: the inner sheet of a pouch outside the body is taped to the wall, and both plies bend as one plate.
//!
//! ```text
//! E = 8 W (1 − cos ½θ) [2 D_i (u coth u − 1)/L − √(D T)] + 2 e (F_i − F) s ε L₀     per pitch
//! T = (P − p_b) r     u = ½ L √(T/D_i)
//! F_i = 2 √(k P̄ (D_w b + ⅓π a₀ D_i))     F = 2 √(k P̄ D_w b)     s, k as in `crimped_sides`
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | D_i, D | bending stiffness of the stuck face, and of one sheet (`fold_energy`) | N·m |
//! | D_w b | bending stiffness of one side weld (`crimped_sides`) | N·m² |
//! | T, r, a₀ | tension of the face, radius and half height of the lens | N/m, m, m |
//!
//! The face is a plate under tension, clamped at both ends of the lens: where it is taut it folds there as the elastica does, √(D_i T) in
//! place of √(D T), and without tension its energy is linear in T. At both sides its round zone, ½π a wide, ⅔ a₀ in the mean, crimps with
//! the weld. Bonded plies of thickness t have D_i = ½ E t³, free ones a fifth of that or less. The clamped plate is exact for small θ.
//! Up to D it has no effect: the face is one sheet at least. Left out: the wall next to the face.

use super::crimped_sides::{FOLDED, FOUNDATION};
use super::entry::*;
use crate::gusset::half_height;
use crate::trig::sin_cos;
use std::f64::consts::PI;

pub(super) const ENTRY: Effect = Effect {
    name: "stuck_face",
    formula: "E = 8 W (1 − cos ½θ)[2 D_i (u coth u − 1)/L − √(D T)] + 2 e (F_i − F)(1 − (½π − 1)²) ε L₀ per pitch, u = ½ L √(T/D_i)",
    sentence: "The inner face of the pouches is taped to the wall, and both sheets bend and fold as one plate.",
    differs: "The bend comes late and less, at all pressures.",
    remedy: "Measure the bending length of two sheets with the tape between them.",
    validity: "pouches outside the wall, stuck over their whole face",
    reference: "Timoshenko 1940 (plate under tension); derived here",
    parameters: &[parameter("bending_nm", "D_i", "N m", 1.0)
        .usual(1.6e-3, [0.0, 1e-1])
        .fitted(Fitted::FromDesign)
        .means("bending stiffness of the inner face with the wall")],
    needs: Needs::Family(Family::Pouch),
    add: |values, assembly| {
        let outside = |site: &&mut Site| {
            // One sheet is in `fold_energy` already.
            values[0] > site.sheet_nm && site.actuator.is_some_and(|actuator| !actuator.in_wall(&site.shape))
        };
        for site in assembly.active_sites(Family::Pouch).filter(outside) {
            let sealed = site.actuator.map_or(0.0, |actuator| (actuator.edge_restraint)(&site.shape));
            let term = StuckFace {
                bending_nm: values[0],
                sheet_nm: site.sheet_nm,
                sides: 4.0 * sealed * FOLDED * FOUNDATION.sqrt(),
                weld_nm2: site.weld_nm2,
                length_m: site.shape.length_m,
                width_m: site.shape.width_m,
                inner: site.inner_share,
            };
            site.act(term, SideEffects::SHIFT);
        }
    },
    ..BALANCE
};

struct StuckFace {
    bending_nm: f64,
    sheet_nm: f64,
    /// 4 e s √k
    sides: f64,
    /// D_w b \[N·m²\]
    weld_nm2: f64,
    length_m: f64,
    width_m: f64,
    /// Share χ of the pouch that is in the body.
    inner: f64,
}

impl Term for StuckFace {
    fn line(&self) -> LedgerLine {
        ENTRY.line(Account::Wall)
    }

    fn add(&self, at: &Pose, force: &mut [f64]) -> f64 {
        let (theta, contraction) = (at.q[actuator_q::COORDINATE], at.q[actuator_q::CONTRACTION]);
        if theta == 0.0 {
            return 0.0;
        }
        let (per_length, per_theta) = (1.0 / self.length_m, 1.0 / theta);
        let (sin, cos) = sin_cos(0.5 * theta);
        // 1 − cos ½θ without cancellation.
        let turned = sin * sin / (1.0 + cos);
        let tension = (at.p_act_pa - at.p_body_pa).max(0.0) * 0.5 * self.length_m * per_theta;
        let [plate, d_plate] = clamped(self.bending_nm, tension, self.length_m);
        let sheet = (self.sheet_nm * tension).sqrt();
        // T falls as 1/θ.
        let (fold, d_fold) = (plate - sheet, (0.5 * sheet - tension * d_plate) * per_theta);
        let width = 8.0 * self.width_m * per_length;
        let [height, d_height] = half_height(self.length_m, theta, (sin, cos));
        let zone = PI / 3.0 * self.bending_nm;
        let across = (at.p_act_pa - self.inner * at.p_body_pa).max(0.0).sqrt();
        let whole = (self.weld_nm2 + zone * height).sqrt();
        let push = self.sides * across * (whole - self.weld_nm2.sqrt());
        let d_push = self.sides * across * 0.5 * zone * d_height / whole;
        force[actuator_q::COORDINATE] -= width * (0.25 * sin * fold * 2.0 + turned * d_fold) + d_push * contraction;
        force[actuator_q::CONTRACTION] -= push;
        width * turned * fold + push * contraction
    }
}

/// `2 D (u coth u − 1)/L`, u = ½ L √(T/D), and its slope by T: √(D T) where the plate is taut.
fn clamped(bending_nm: f64, tension: f64, length_m: f64) -> [f64; 2] {
    let per = length_m / (2.0 * bending_nm);
    let z = 0.25 * length_m * length_m * tension / bending_nm;
    if z < 1e-2 {
        let slope = 1.0 / 3.0 - z * (2.0 / 45.0 - z * (2.0 / 315.0));
        return [z * (1.0 / 3.0 - z * (1.0 / 45.0 - z * (2.0 / 945.0))) / per, slope * 0.5 * length_m];
    }
    let u = z.sqrt();
    let decay = (-2.0 * u).exp();
    let coth = (1.0 + decay) / (1.0 - decay);
    let slope = 0.5 * (coth / u - 4.0 * decay / (1.0 - decay).powi(2));
    [(u * coth - 1.0) / per, slope * 0.5 * length_m]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Model, Scenario};

    #[test]
    fn a_face_that_is_not_stiffer_than_one_sheet_has_no_effect() {
        let tip = |bending_nm: f64| {
            let sheet = "[effects.fold_energy]\nbending_nm = 5e-5\n[effects.stuck_face]\n";
            let text = format!("{}\n{sheet}bending_nm = {bending_nm}\n", crate::shipped("spam-textbook").unwrap());
            let model = Model::new(&Scenario::parse(&text).unwrap());
            let mut at = model.prediction();
            model.predict(&crate::Loads::uniform(2e3, 2e4), &mut at).unwrap();
            at.tip.y_m
        };
        assert_eq!([1e-9, 5e-5].map(tip), [tip(0.0); 2]);
        assert!(tip(1e-3) < tip(0.0));
    }

    /// Both parts again: the clamped plate, and beams on the foundation along the sides.
    #[test]
    fn a_face_folds_bends_and_crimps_as_a_plate() {
        let (length, width, plate, sheet, weld) = (0.06, 0.06, 1.6e-3, 5e-5, 5e-6);
        let more = format!(
            "[effects.fold_energy]\nbending_nm = {sheet}\n[effects.crimped_sides]\nbending_nm2 = {weld}\n\
             [effects.stuck_face]\nbending_nm = {plate}\n"
        );
        let model =
            Model::new(&Scenario::parse(&format!("{}\n{more}", crate::shipped("spam-textbook").unwrap())).unwrap());
        let site = &model.assembly().sites[0];
        let term = site.actuator_terms.iter().find(|term| term.line().name == "stuck_face").unwrap();
        let (theta, contraction, p_body, p_act): (f64, f64, f64, f64) = (0.9, 0.13, 2e3, 2e4);
        let radius = 0.5 * length / theta;
        let tension = (p_act - p_body) * radius;
        let u = 0.5 * length * (tension / plate).sqrt();
        let ends = 8.0
            * width
            * (1.0 - (0.5 * theta).cos())
            * ((plate * tension).sqrt() * (1.0 / u.tanh() - 1.0 / u) - (sheet * tension).sqrt());
        let n = 20_000;
        let zone: f64 = 2.0 / 3.0 * radius * (1.0 - theta.cos()) * 0.5 * PI;
        let crimp = |bending: f64| 2.0 * (4.0 / (4.0 - PI) * p_act * bending).sqrt();
        let spared = (0.5 * PI - 1.0_f64).powi(2);
        let sides = 2.0 * (crimp(weld + zone * plate) - crimp(weld)) * (1.0 - spared) * contraction * length;
        let energy = length * term.add(&Pose::new(&[theta, contraction, 0.0, 0.0], p_body, p_act), &mut [0.0; 4]);
        assert!((energy / (ends + sides) - 1.0).abs() < 1e-12, "{energy} {ends} {sides}");
        // Two thirds of the half height is the mean of a flat lens; a round one has 5 % more.
        let mean: f64 = (0..n)
            .map(|i| {
                let phi = theta * ((2 * i + 1) as f64 / f64::from(n) - 1.0);
                radius * (phi.cos() - theta.cos()) * phi.cos()
            })
            .sum::<f64>()
            * 2.0
            * theta
            * radius
            / f64::from(n)
            / (2.0 * radius * theta.sin());
        assert!((mean / (2.0 / 3.0 * radius * (1.0 - theta.cos())) - 1.0).abs() < 0.05, "{mean}");
    }

    /// A beam under tension between clamps, by finite differences: how much less than a string it gives way to the load of an arc.
    #[test]
    fn a_plate_under_tension_stores_what_it_gives_way_less_than_a_string() {
        let (length, bending): (f64, f64) = (0.06, 1.6e-3);
        for (tension, radius) in [(0.3, 0.2), (5.0, 0.3), (400.0, 0.3)] {
            // D v'' − T v = −q x of the slope v, v = 0 at both ends, on half of the length; Thomas.
            let n = 4000;
            let (h, load) = (0.5 * length / f64::from(n), tension / radius);
            let (mut gain, mut value) = (vec![0.0; n as usize + 1], vec![0.0; n as usize + 1]);
            for i in 1..n as usize {
                let (off, diagonal) = (bending / (h * h), -2.0 * bending / (h * h) - tension);
                let pivot = diagonal + off * gain[i - 1];
                gain[i] = -off / pivot;
                value[i] = (load * h * i as f64 - off * value[i - 1]) / pivot;
            }
            let (mut slope, mut mean) = (0.0, 0.0);
            for i in (1..n as usize).rev() {
                slope = gain[i] * slope + value[i];
                mean -= 2.0 * slope * h * i as f64 * h;
            }
            let string = load * length.powi(3) / (12.0 * tension);
            let stored = 0.5 * load * (string - mean);
            let theta = 0.5 * length / radius;
            let [plate, _] = clamped(bending, tension, length);
            assert!(
                (theta * theta * plate / stored - 1.0).abs() < 1e-3,
                "{tension}: {} {stored}",
                theta * theta * plate
            );
        }
    }

    #[test]
    fn series_and_closed_form_of_the_clamped_plate_meet_and_taut_plates_fold_as_the_elastica() {
        let (length, bending) = (0.06, 1.6e-3);
        let tension = 1e-2 * 4.0 * bending / (length * length);
        let [low, high] = [1.0 - 1e-9, 1.0].map(|share| clamped(bending, share * tension, length));
        low.iter().zip(high).for_each(|(low, high)| assert!((low / high - 1.0).abs() < 1e-7, "{low} {high}"));
        let taut = clamped(bending, 1e9, length)[0] / (bending * 1e9_f64).sqrt();
        assert!((taut - 1.0).abs() < 1e-4, "{taut}");
        let [more, less] = [1.001, 0.999].map(|share| clamped(bending, 40.0 * share, length)[0]);
        assert!(((more - less) / 0.08 / clamped(bending, 40.0, length)[1] - 1.0).abs() < 1e-6);
    }
}
