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
//! **Sharp folds**: an adhesive of shear modulus G and thickness t_g lets two sheets at ±z slide over a length
//! ℓ = √(A t_g/2G) beside a fold, so that a fold by θ cannot cost more than √(G A/2t_g) z² θ² per width (derived here: least
//! energy of stretch and slip). Soft acrylic, G = 0.3 MPa, t_g = 0.05 mm, gives 0.25 J/m and ℓ = 2.4 mm. This is not
//! modelled; β = 1 − (ℓ/h)(1 − exp(−h/ℓ)) at element size h stands for it.

use std::sync::Arc;

use models::Fabric;
use models::actuators::pattern::{Film, Joint, Pattern};
use models::fabrics::{Kind, Orthotropic, Ply, WrinklingFilm, material};

use super::RobotSettings;
use super::sew::{FACE, MARGIN, SEAM, WALL};
use crate::FemError;
use crate::problem::Section;
use crate::sheet::reference::{bending_stiffness, mean_stiffness};

/// Fabrics of one robot.
pub(super) struct Plies<'a> {
    pattern: &'a Pattern,
    settings: &'a RobotSettings,
    /// Of the strips to the body \[rad\], as ply angles count.
    slant_rad: f64,
    body: Arc<dyn Fabric>,
    sheet: Arc<dyn Fabric>,
}

impl Plies<'_> {
    /// For strips of one kind and slant, as azimuths turn from base to tip \[rad\].
    pub fn of<'a>(pattern: &'a Pattern, slant_rad: f64, settings: &'a RobotSettings) -> Result<Plies<'a>, FemError> {
        let s = settings;
        let body = made(
            pattern.body_fabric,
            s.nu12,
            &[("body_sheet_mm", s.body_sheet_m), ("body_sheet_e_mpa", s.body_sheet_e_pa)],
        )?;
        let sheet = made(pattern.fabric, s.nu12, &[("sheet_mm", s.sheet_m), ("sheet_e_mpa", s.sheet_e_pa)])?;
        // Azimuths turn clockwise seen from outside.
        Ok(Plies { pattern, settings, slant_rad: -slant_rad, body, sheet })
    }

    /// Section of the part of that name.
    pub fn section(&self, part: &str) -> Section {
        let wall = ply(&self.body, 0.0);
        let free = ply(&self.wrinkling(&self.body), 0.0);
        if let Some(panel) = self.pattern.panels.iter().find(|p| p.name == part) {
            // A panel that runs back shows its front to the body, and is seen from there.
            let seen = if panel.to_m < panel.from_m { -panel.warp_rad } else { panel.warp_rad };
            return self.loose(vec![ply(&self.wrinkling(&self.sheet), seen)]);
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
            (WALL, None) => self.loose(vec![free; self.pattern.body_sheets]),
            _ => self.loose(vec![free]),
        }
    }

    /// A film whose wrinkles are shorter than an element, if less than all of compression is to be carried; stuck plies are too
    /// stiff for such wrinkles.
    fn wrinkling(&self, fabric: &Arc<dyn Fabric>) -> Arc<dyn Fabric> {
        match fabric.kind() {
            Kind::NeoHookean(film) if self.settings.compression < 1.0 => {
                Arc::new(WrinklingFilm { film: *film, share: self.settings.compression })
            }
            _ => Arc::clone(fabric),
        }
    }

    /// Film and bottom sheet on the wall, if the pattern has them.
    fn stuck(&self) -> Vec<Ply> {
        let Joint::Bonded { warp_rad, .. } = self.pattern.joint else { return Vec::new() };
        let bottom = ply(&self.sheet, self.slant_rad + warp_rad);
        self.film().map(|film| ply(&film, 0.0)).into_iter().chain([bottom]).collect()
    }

    fn film(&self) -> Option<Arc<dyn Fabric>> {
        let Joint::Bonded { film, .. } = self.pattern.joint else { return None };
        let (e_pa, thickness_m) = match film {
            Film::Tape => (self.settings.tape_e_pa, self.settings.tape_m),
            Film::Glue => (self.settings.glue_e_pa, self.settings.glue_m),
        };
        Some(Arc::new(Orthotropic::isotropic(e_pa, 0.5, thickness_m)))
    }

    fn loose(&self, plies: Vec<Ply>) -> Section {
        let (density_kg_m3, bending_factor) = (self.settings.density_kg_m3, self.settings.bending_factor);
        Section { plies, bonded: false, density_kg_m3, bending_factor, rest_curvature: false }
    }

    fn bonded(&self, plies: Vec<Ply>) -> Section {
        let wanted = laminate_stiffness(&plies, self.settings.bond, self.settings.bending_factor);
        let solid = Section { bonded: true, bending_factor: 1.0, ..self.loose(plies) };
        let bending_factor = wanted / bending_stiffness(&solid);
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
fn made(
    name: &str,
    nu12: Option<f64>,
    [thickness, modulus]: &[(&str, Option<f64>); 2],
) -> Result<Arc<dyn Fabric>, FemError> {
    let problem = |message: String| FemError::Problem(format!("robot: fabric `{name}`: {message}"));
    let material = material(name).ok_or_else(|| problem("there is no such material".into()))?;
    let law = material.law().ok_or_else(|| problem("there is no such law".into()))?;
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
