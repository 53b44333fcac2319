//! What each part of a robot is made of.
//!
//! Plies that are stuck together bend by the distance of their sheets from the middle plane, which sliding yarns do not
//! weaken, and by their own stiffness, which they do:
//!
//! ```text
//! D = β Σ Aₚ z̄ₚ² + b Σ Aₚ tₚ²/12                (laminate, one isotropic value)
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | Aₚ | mean in-plane stiffness of ply p | N/m |
//! | z̄ₚ | distance of its middle from the stiffness-weighted middle plane | m |
//! | β | share of the bond (`bond`) | – |
//! | b | bending factor of one sheet | – |
//!
//! Two equal sheets have 6.2/8 of the stiffness of a solid plate of both with β = 1, b = 0.1. Derived here; Jones,
//! Mechanics of Composite Materials, ch. 4, for β = b = 1.
//!
//! **Wrinkles**: a single sheet under compression carries N_w = 2π √(D T)/ℓ ([`models::fabrics::WrinklingFilm`]) with its own bending stiffness
//! D, the hoop tension T = p_b R of the body, and the length ℓ of [`Wrinkles`], both from the geometry.
//! The sheets of a pouch have a tension of this size where the load matters: P L/π of a full pouch is 1.2 p_b R at 2.5 p_b.
//!
//! **Sharp folds**: an adhesive of shear modulus G and thickness t_g lets two sheets at ±z slide over a length
//! ℓ = √(A t_g/2G) next to a fold, so that a fold by θ cannot cost more than √(G A/2t_g) z² θ² per width (derived here: least
//! energy of stretch and slip). Soft acrylic, G = 0.3 MPa, t_g = 0.05 mm, gives 0.25 J/m and ℓ = 2.4 mm. This is not
//! modelled; β = 1 − (ℓ/h)(1 − exp(−h/ℓ)) at element size h approximates it.

use std::f64::consts::PI;
use std::sync::Arc;

use models::actuators::pattern::{ChamberBottom, Film, Pattern};
use models::fabrics::{InlinedFabric, Orthotropic, Ply, WrinklingFilm, material, wrinkling_load_n_per_m};
use models::{Fabric, Scenario};

use super::RobotSettings;
use super::sew::{FACE, MARGIN, SEAM, WALL};
use crate::problem::Section;
use crate::sheet::reference::{bending_stiffness, mean_stiffness};
use crate::{FemError, Result};

pub(super) struct Plies<'a> {
    pattern: &'a Pattern,
    settings: &'a RobotSettings,
    /// Of the strips to the body \[rad\], as ply angles count.
    slant_rad: f64,
    wrinkles: Option<Wrinkles>,
    body: Arc<dyn Fabric>,
    sheet: Arc<dyn Fabric>,
}

/// Wrinkles of single sheets: tension along them, and their length between the lines that keep the sheet flat.
pub(super) struct Wrinkles {
    /// T = p_b R, the hoop tension of the body \[N/m\].
    tension_n_per_m: f64,
    /// In the wall: half of the circumference between two strips, from the side weld of a strip to the line that stays taut \[m\].
    wall_m: f64,
    /// In the actuator's sheets: half of the width between the side welds, from a side to the middle \[m\].
    sheet_m: f64,
}

impl Wrinkles {
    /// Of a robot; `None` if its sheets carry all of compression.
    pub(super) fn of(scenario: &Scenario, patterns: &[Pattern], settings: &RobotSettings) -> Option<Wrinkles> {
        let longer = settings.wrinkle_length?;
        let free_m = 2.0 * PI * scenario.radius_m - patterns.iter().map(|p| p.width_m).sum::<f64>();
        Some(Wrinkles {
            tension_n_per_m: scenario.p_body_pa * scenario.radius_m,
            wall_m: 0.5 * longer * free_m / patterns.len() as f64,
            sheet_m: 0.5 * longer * patterns[0].width_m,
        })
    }
}

impl Plies<'_> {
    /// For strips of one kind and slant, as azimuths turn from base to tip \[rad\].
    pub(super) fn of<'a>(
        pattern: &'a Pattern,
        slant_rad: f64,
        settings: &'a RobotSettings,
        wrinkles: Option<Wrinkles>,
    ) -> Result<Plies<'a>> {
        let s = settings;
        let body = made(
            pattern.body_fabric,
            s.nu12,
            &[("body_sheet_mm", s.body_sheet_m), ("body_sheet_e_mpa", s.body_sheet_e_pa)],
        )?;
        let sheet = made(pattern.fabric, s.nu12, &[("sheet_mm", s.sheet_m), ("sheet_e_mpa", s.sheet_e_pa)])?;
        // Azimuths turn clockwise seen from outside.
        Ok(Plies { pattern, settings, slant_rad: -slant_rad, wrinkles, body, sheet })
    }

    /// Section of the part of that name.
    pub(super) fn section(&self, part: &str) -> Section {
        let wall = ply(&self.body, 0.0);
        let [wall_m, sheet_m] = self.wrinkles.as_ref().map_or([0.0; 2], |w| [w.wall_m, w.sheet_m]);
        let free = |length_m: f64| ply(&self.wrinkling(&self.body, length_m), 0.0);
        if let Some(panel) = self.pattern.panels.iter().find(|p| p.name == part) {
            // A panel that runs back shows its front to the body, and is seen from there.
            let seen = panel.warp_rad * (panel.to_m - panel.from_m).signum();
            return self.loose(vec![ply(&self.wrinkling(&self.sheet, sheet_m), seen)]);
        }
        match (part, part.strip_prefix(SEAM).and_then(|n| n.parse::<usize>().ok())) {
            (_, Some(layers)) => {
                let mut plies = vec![wall];
                plies.extend(self.stuck());
                let welded = layers + usize::from(self.film().is_some());
                plies.resize(
                    plies.len().max(welded),
                    ply(&self.sheet, self.slant_rad + self.pattern.panels[0].warp_rad),
                );
                self.bonded(plies)
            }
            (FACE | MARGIN, None) if !self.stuck().is_empty() => {
                let plies = std::iter::once(wall).chain(self.stuck()).collect();
                self.bonded(plies)
            }
            (WALL, None) => self.loose(vec![free(wall_m); self.pattern.body_sheets]),
            (FACE | MARGIN, None) => self.loose(vec![free(sheet_m)]),
            _ => self.loose(vec![free(wall_m)]),
        }
    }

    /// A film with the load of its wrinkles over a length \[m\]; stuck plies are too stiff for such wrinkles.
    fn wrinkling(&self, fabric: &Arc<dyn Fabric>, length_m: f64) -> Arc<dyn Fabric> {
        match (fabric.kind(), &self.wrinkles) {
            (InlinedFabric::NeoHookean(film), Some(wrinkles)) => {
                let bending_nm = self.settings.bending_factor * mean_stiffness(film) * film.thickness_m.powi(2) / 12.0;
                let load_n_per_m = wrinkling_load_n_per_m(bending_nm, wrinkles.tension_n_per_m, length_m);
                Arc::new(WrinklingFilm { film: *film, load_n_per_m })
            }
            _ => Arc::clone(fabric),
        }
    }

    /// Film and bottom sheet on the wall, if the pattern has them.
    fn stuck(&self) -> Vec<Ply> {
        let ChamberBottom::Bonded { warp_rad, .. } = self.pattern.joint else { return Vec::new() };
        let bottom = ply(&self.sheet, self.slant_rad + warp_rad);
        self.film().map(|film| ply(&film, 0.0)).into_iter().chain([bottom]).collect()
    }

    fn film(&self) -> Option<Arc<dyn Fabric>> {
        let ChamberBottom::Bonded { film, .. } = self.pattern.joint else { return None };
        let (e_pa, thickness_m) = match film {
            Film::Tape => (self.settings.tape_e_pa, self.settings.tape_m),
            Film::Glue => (self.settings.glue_e_pa, self.settings.glue_m),
        };
        Some(Arc::new(Orthotropic::isotropic(e_pa, 0.5, thickness_m)))
    }

    fn loose(&self, plies: Vec<Ply>) -> Section {
        let s = self.settings;
        let bending_factor = s.bending_factor * s.bending_share;
        Section { plies, bonded: false, density_kg_m3: s.density_kg_m3, bending_factor, rest_curvature: false }
    }

    fn bonded(&self, plies: Vec<Ply>) -> Section {
        let wanted = laminate_stiffness(&plies, self.settings.bond, self.settings.bending_factor);
        let solid = Section { bonded: true, bending_factor: 1.0, ..self.loose(plies) };
        let bending_factor = self.settings.bending_share * wanted / bending_stiffness(&solid);
        Section { bending_factor, ..solid }
    }
}

/// D of a laminate \[N m\].
fn laminate_stiffness(plies: &[Ply], bond: f64, factor: f64) -> f64 {
    let mut top = 0.0;
    let mut sheets = Vec::with_capacity(plies.len());
    for ply in plies {
        let t = ply.fabric.thickness_m();
        sheets.push((mean_stiffness(&*ply.fabric), top + 0.5 * t, t));
        top += t;
    }
    let sum: f64 = sheets.iter().map(|s| s.0).sum();
    let middle = sheets.iter().map(|s| s.0 * s.1).sum::<f64>() / sum;
    sheets.iter().map(|(a, z, t)| a * (bond * (z - middle).powi(2) + factor * t * t / 12.0)).sum()
}

fn ply(fabric: &Arc<dyn Fabric>, angle_rad: f64) -> Ply {
    Ply { fabric: Arc::clone(fabric), angle_rad }
}

/// A fabric of the list, with another biaxial coupling if it has one, and another thickness \[m\] and Young's modulus \[Pa\]
/// where these are set, each with its key.
fn made(name: &str, nu12: Option<f64>, [thickness, modulus]: &[(&str, Option<f64>); 2]) -> Result<Arc<dyn Fabric>> {
    let problem = |message: String| FemError::Problem(format!("robot: fabric `{name}`: {message}"));
    let material = material(name).ok_or_else(|| problem("the material is unknown".into()))?;
    let law = material.law().ok_or_else(|| problem("the law is unknown".into()))?;
    let mut recipe = material.recipe();
    if let (Some(value), Some(number)) = (nu12, recipe.numbers.get_mut("nu12")) {
        *number = value;
    }
    if let (_, Some(thickness_m)) = thickness {
        recipe.numbers.insert("thickness_mm".into(), thickness_m * 1e3);
    }
    match (modulus, recipe.numbers.get_mut("c10_MPa")) {
        ((_, None), _) => {}
        // An incompressible neo-Hookean sheet has E = 6 C₁₀ at small strains.
        ((_, Some(e_pa)), Some(c10_mpa)) => *c10_mpa = e_pa * 1e-6 / 6.0,
        ((key, Some(e_pa)), None) => {
            let e_mpa = e_pa * 1e-6;
            return Err(problem(format!(
                "cannot take {key} = {e_mpa}: its moduli along warp, fill and bias differ. Leave {key} out"
            )));
        }
    }
    (law.make)(&recipe).map_err(|fault| problem(fault.to_string()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_stuck_sheets_bend_like_a_solid_plate_but_for_their_own_stiffness() {
        let sheet: Arc<dyn Fabric> = Arc::new(Orthotropic::isotropic(1e9, 0.3, 2e-4));
        let one = mean_stiffness(&*sheet) * 4e-8 / 12.0;
        let of = |bond, factor| laminate_stiffness(&[ply(&sheet, 0.0), ply(&sheet, 0.0)], bond, factor) / one;
        for (bond, factor, exact) in [(1.0, 1.0, 8.0), (1.0, 0.1, 6.2), (0.0, 1.0, 2.0), (0.5, 0.1, 3.2)] {
            assert!((of(bond, factor) / exact - 1.0).abs() < 1e-12, "{bond} {factor}");
        }
    }

    #[test]
    fn a_soft_thick_film_carries_the_sheets_away_from_the_middle() {
        let sheet: Arc<dyn Fabric> = Arc::new(Orthotropic::isotropic(1e9, 0.0, 2e-4));
        let film: Arc<dyn Fabric> = Arc::new(Orthotropic::isotropic(1e-3, 0.0, 6e-4));
        let d = laminate_stiffness(&[ply(&sheet, 0.0), ply(&film, 0.0), ply(&sheet, 0.0)], 1.0, 0.0);
        assert!((d / (2.0 * 2e5 * 4e-4f64.powi(2)) - 1.0).abs() < 1e-9);
    }
}
