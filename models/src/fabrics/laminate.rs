//! Bonded plies: several fabrics with one and the same strain, each at its own angle; with or without a film of glue.
//!
//! ```text
//! W(e) = Σ Wₚ(Qₚ e)     S = Σ Qₚᵀ Sₚ(Qₚ e)     t = Σ tₚ
//!
//!        ⎡  c²    s²    cs  ⎤
//! Q(α) = ⎢  s²    c²   −cs  ⎥     e = [E₁₁, E₂₂, 2E₁₂],  c = cos α, s = sin α
//!        ⎣ −2cs  2cs  c²−s² ⎦
//! ```
//!
//! α is the angle from the laminate's warp to the ply's warp, counter-clockwise. S = ∂W/∂e holds by the chain rule because Q
//! turns the *engineering* strain and its transpose turns the tension back.
//!
//! Valid where the bond does not slip and the laminate is thin against its radius of curvature: the plies sit in one
//! plane, so the bending stiffness by their distance is the business of the shell, not of this law.
//! Reference: Jones, Mechanics of Composite Materials, ch. 2.6 and 4.

use std::sync::Arc;

use super::fabric::{Fabric, InlinedFabric, Mixed, NeoHookean, Orthotropic, Past, Ply, WrinklingFilm, matrix};
use super::recipe::*;

/// Several fabrics bonded face to face, each at its own angle: they share one strain and add their tensions.
pub(super) const LAMINATE: Law = Law {
    name: "laminate",
    parameters: &[],
    plies: [1, usize::MAX],
    example: || Recipe { plies: example_plies(), ..Recipe::default() },
    make: |recipe| {
        let values = LAMINATE.read(recipe)?;
        Ok(Arc::new(Laminate::new(values.plies().to_vec()).map_err(|m| values.says(m))?))
    },
    ..SHEET
};

/// Two fabrics with a film of glue between them: the glue adds stiffness in every direction, also off the yarns.
pub(super) const GLUED: Law = Law {
    name: "glued",
    parameters: &[
        number("glue_thickness_mm", "mm", 1e-3, [1e-4, 100.0]).required("thickness of the glue film"),
        modulus("glue_e_MPa").required("Young's modulus of the glue"),
        ratio("glue_nu", [0.0, 0.5]).or(0.5, "Poisson's ratio of the glue; 0.5: rubber"),
    ],
    plies: [2, 2],
    example: || Recipe { plies: example_plies(), ..Recipe::of(&[("glue_thickness_mm", 0.1), ("glue_e_MPa", 1.0)]) },
    make: |recipe| {
        let v = GLUED.read(recipe)?;
        let film = Orthotropic::isotropic(v.get("glue_e_MPa")?, v.get("glue_nu")?, v.get("glue_thickness_mm")?);
        let mut plies = v.plies().to_vec();
        plies.insert(1, Ply { fabric: Arc::new(film), angle_rad: 0.0 });
        Ok(Arc::new(Laminate::new(plies).map_err(|m| v.says(m))?))
    },
    ..SHEET
};

/// Plies bonded without slip: equal strain, and the sum of their stress resultants.
#[derive(Debug, Clone)]
pub struct Laminate {
    plies: Vec<(Arc<dyn Fabric>, Turn)>,
    mixed: Option<Mixed>,
    film: Option<WrinklingFilm>,
}

impl Laminate {
    /// From plies, in any order: they share one plane.
    ///
    /// # Errors
    /// No ply; an angle that is not finite; plies with memory (unloading curves) at different angles, since an element
    /// remembers one pair of yarn directions only. A ply that is itself a laminate with memory counts with its own angle.
    pub fn new(plies: Vec<Ply>) -> Result<Laminate, String> {
        if plies.is_empty() {
            return Err("a laminate without plies; write at least one".into());
        }
        if let Some(i) = plies.iter().position(|p| !p.angle_rad.is_finite()) {
            return Err(format!("the angle of ply {} is not a finite number; write degrees from -180 to 180", i + 1));
        }
        let mut remembering = plies.iter().filter(|p| p.fabric.has_memory()).map(|p| p.angle_rad);
        if let Some(first) = remembering.next()
            && let Some(other) = remembering.find(|a| *a != first)
        {
            return Err(format!(
                "plies with unloading curves lie at {} and {} degrees; leave the unloading curves of one of them out",
                first.to_degrees(),
                other.to_degrees()
            ));
        }
        let plies: Vec<_> = plies.into_iter().map(|p| (p.fabric, Turn::new(p.angle_rad))).collect();
        Ok(Laminate { mixed: Mixed::of(&plies), film: film_of(&plies), plies })
    }

    /// The plies' tangents at their own strains, turned into the laminate's axes and added.
    fn sum(&self, e: [f64; 3], of: impl Fn(&dyn Fabric, [f64; 3]) -> [[f64; 3]; 3]) -> [[f64; 3]; 3] {
        let mut sum = [[0.0; 3]; 3];
        for (fabric, turn) in &self.plies {
            let turned = turn.tangent(&of(&**fabric, turn.strain(e)));
            sum = matrix(|i, j| sum[i][j] + turned[i][j]);
        }
        sum
    }
}

/// Wrinkling films that wrinkle at one strain are one film; `None` if a ply is something else.
fn film_of(plies: &[(Arc<dyn Fabric>, Turn)]) -> Option<WrinklingFilm> {
    let mut sum = Mixed { rubber: NeoHookean::new(0.0, 0.0), linear: [[0.0; 3]; 3] };
    let (mut strain, mut load_n_per_m) = (None, 0.0);
    for (fabric, _) in plies {
        let InlinedFabric::WrinklingFilm(ply) = fabric.kind() else { return None };
        let own = ply.load_n_per_m / (ply.film.c10_pa * ply.film.thickness_m);
        if *strain.get_or_insert(own) != own {
            return None;
        }
        load_n_per_m += ply.load_n_per_m;
        sum.add_rubber(&ply.film);
    }
    strain.map(|_| WrinklingFilm { film: sum.rubber, load_n_per_m })
}

impl Mixed {
    /// `None` if a ply follows another law.
    fn of(plies: &[(Arc<dyn Fabric>, Turn)]) -> Option<Mixed> {
        let mut sum = Mixed { rubber: NeoHookean::new(0.0, 0.0), linear: [[0.0; 3]; 3] };
        for (fabric, turn) in plies {
            let linear = match fabric.kind() {
                InlinedFabric::NeoHookean(rubber) => {
                    sum.add_rubber(rubber);
                    continue;
                }
                InlinedFabric::Orthotropic(sheet) => sheet.tangent([0.0; 3], &[0.0; 2]),
                InlinedFabric::Mixed(mixed) => {
                    sum.add_rubber(&mixed.rubber);
                    mixed.linear
                }
                InlinedFabric::WrinklingFilm(_) | InlinedFabric::Other => return None,
            };
            let turned = turn.tangent(&linear);
            sum.linear = matrix(|i, j| sum.linear[i][j] + turned[i][j]);
        }
        Some(sum)
    }

    fn add_rubber(&mut self, other: &NeoHookean) {
        let force_n_per_m = self.rubber.c10_pa * self.rubber.thickness_m + other.c10_pa * other.thickness_m;
        self.rubber.thickness_m += other.thickness_m;
        if self.rubber.thickness_m > 0.0 {
            self.rubber.c10_pa = force_n_per_m / self.rubber.thickness_m;
        }
    }
}

impl Fabric for Laminate {
    fn thickness_m(&self) -> f64 {
        self.plies.iter().map(|(fabric, _)| fabric.thickness_m()).sum()
    }

    fn energy(&self, e: [f64; 3], past: &Past) -> f64 {
        self.plies.iter().map(|(fabric, turn)| fabric.energy(turn.strain(e), past)).sum()
    }

    fn tension(&self, e: [f64; 3], past: &Past) -> [f64; 3] {
        let mut sum = [0.0; 3];
        for (fabric, turn) in &self.plies {
            let back = turn.back(fabric.tension(turn.strain(e), past));
            sum = std::array::from_fn(|i| sum[i] + back[i]);
        }
        sum
    }

    fn tangent(&self, e: [f64; 3], past: &Past) -> [[f64; 3]; 3] {
        self.sum(e, |fabric, e| fabric.tangent(e, past))
    }

    fn steepest(&self, e: [f64; 3], past: &Past, reach: f64) -> [[f64; 3]; 3] {
        self.sum(e, |fabric, e| fabric.steepest(e, past, reach))
    }

    fn has_memory(&self) -> bool {
        self.plies.iter().any(|(fabric, _)| fabric.has_memory())
    }

    fn remember(&self, e: [f64; 3], past: &mut Past) {
        // Plies with memory share one angle, so they agree on what was seen.
        self.plies.iter().for_each(|(fabric, turn)| fabric.remember(turn.strain(e), past));
    }

    fn dissipated(&self, past: &Past) -> f64 {
        self.plies.iter().map(|(fabric, _)| fabric.dissipated(past)).sum()
    }

    fn kind(&self) -> InlinedFabric<'_> {
        if let Some(film) = &self.film {
            return InlinedFabric::WrinklingFilm(film);
        }
        match &self.mixed {
            Some(mixed) if mixed.linear == [[0.0; 3]; 3] => InlinedFabric::NeoHookean(&mixed.rubber),
            Some(mixed) => InlinedFabric::Mixed(mixed),
            None => InlinedFabric::Other,
        }
    }
}

/// Rotation Q(α) of strain into the axes of a ply.
#[derive(Debug, Clone, Copy)]
struct Turn {
    cc: f64,
    ss: f64,
    cs: f64,
}

impl Turn {
    fn new(angle_rad: f64) -> Turn {
        let (s, c) = angle_rad.sin_cos();
        Turn { cc: c * c, ss: s * s, cs: c * s }
    }

    /// Strain in the axes of the ply, Q e.
    fn strain(&self, e: [f64; 3]) -> [f64; 3] {
        let Turn { cc, ss, cs } = *self;
        [
            cc * e[0] + ss * e[1] + cs * e[2],
            ss * e[0] + cc * e[1] - cs * e[2],
            2.0 * cs * (e[1] - e[0]) + (cc - ss) * e[2],
        ]
    }

    /// Stress in the axes of the laminate, Qᵀ S.
    fn back(&self, s: [f64; 3]) -> [f64; 3] {
        let Turn { cc, ss, cs } = *self;
        [
            cc * s[0] + ss * s[1] - 2.0 * cs * s[2],
            ss * s[0] + cc * s[1] + 2.0 * cs * s[2],
            cs * (s[0] - s[1]) + (cc - ss) * s[2],
        ]
    }

    /// Qᵀ T Q, column by column: the columns of Q are what Q makes of unit strains.
    fn tangent(&self, own: &[[f64; 3]; 3]) -> [[f64; 3]; 3] {
        let columns: [[f64; 3]; 3] = std::array::from_fn(|j| {
            let unit = self.strain(std::array::from_fn(|k| f64::from(k == j)));
            self.back(std::array::from_fn(|i| (0..3).map(|k| own[i][k] * unit[k]).sum()))
        });
        matrix(|i, j| columns[j][i])
    }
}

fn example_plies() -> Vec<Ply> {
    let sheet = Orthotropic::new(96.5e6, 120e6, 0.3, 1.1e6, 5e-5);
    [0.0, 30f64.to_radians()].map(|angle_rad| Ply { fabric: Arc::new(sheet), angle_rad }).to_vec()
}
