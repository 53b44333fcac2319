//! Tension field: a linear sheet that wrinkles instead of carrying compression, for meshes too coarse to show the wrinkles.
//!
//! The relaxed energy is the least over all folds P ≥ 0 (the strain that wrinkles swallow), W_r(e) = min W(e + P):
//!
//! ```text
//! taut      both principal tensions of S = A e are ≥ 0          W_r = W
//! slack     both principal strains are ≤ 0                      W_r = 0
//! wrinkled  otherwise: tension σ along one direction φ only     W_r = max over φ of ½ t E(φ) ⟨e(φ)⟩²
//!
//! e(φ) = c² e₁ + s² e₂ + cs e₃      1/E(φ) = c⁴/E₁ + s⁴/E₂ + c²s² (1/G − 2ν₁₂/E₁)       σ = t E(φ) e(φ)
//! S = σ [c², s², cs]                because the best φ is stationary, ∂W_r/∂e is the slope at fixed φ
//! ```
//!
//! Isotropic: φ is the principal direction, e(φ) = ε₁ and W_r = ½ E t ε₁². Orthotropic: φ is found to machine precision; the
//! mixed criterion is exact for both, since W is quadratic and positive. Nothing else is approximated *within* a linear sheet;
//! the law leaves out the wrinkle itself: its bending, wavelength and depth.
//! A share η of the sheet keeps its compressive stiffness: W = (1 − η) W_r + η ½ e·A e.
//!
//! **With mass damping alone it flutters and never settles**: a wrinkled or slack element has no stiffness across, and inertia
//! opens and closes it for ever. Give viscosity or a share of some per cent; or a mesh that shows the wrinkles, and no tension
//! field at all.
//! Reference: Pipkin 1986, IMA J. Appl. Math. 36, 85 (relaxed energy); Roddeman et al. 1987, J. Appl. Mech. 54, 884 (criterion).

use std::f64::consts::TAU;
use std::sync::Arc;

use super::fabric::{Fabric, Orthotropic, Past, matrix};
use super::recipe::*;

pub(super) const ENTRY: Law = Law {
    name: "tension-field",
    parameters: &[
        modulus("e0_MPa").required("modulus pulled along warp"),
        modulus("e90_MPa").optional("modulus pulled along fill; else isotropic"),
        modulus("e45_MPa").optional("modulus pulled at 45 degrees to the yarns; with e90_MPa"),
        modulus("g_MPa").optional("shear modulus between warp and fill, in place of e45_MPa; with e90_MPa"),
        ratio("nu12", [0.0, 2.0]).or(0.0, "contraction along fill per stretch along warp"),
        ratio("compression_share", [0.0, 1.0]).or(0.01, "share of the sheet that carries compression"),
        THICKNESS,
    ],
    example: || {
        Recipe::of(&[("e0_MPa", 96.5), ("e90_MPa", 120.0), ("e45_MPa", 4.05), ("nu12", 0.3), ("thickness_mm", 0.05)])
    },
    make,
    ..SHEET
};

/// A linear sheet without (or with a share of) compressive stiffness.
#[derive(Debug, Clone, PartialEq)]
pub struct TensionField {
    sheet: Orthotropic,
    share: f64,
    /// 1/(t E(φ)) = p₀ + p₁ cos 2φ + p₂ cos 4φ \[m/N\].
    compliance: [f64; 3],
    /// sin 2φ, cos 2φ and t E(φ) of equally spaced directions.
    samples: [[f64; 3]; SAMPLES],
}

/// Finds every peak of E(φ) of a cloth with E/G up to about 1000, whose peaks are √(G/E) wide.
const SAMPLES: usize = 96;

impl TensionField {
    /// `share` of the sheet keeps its compressive stiffness.
    ///
    /// # Errors
    /// A sheet that is not positive definite, a share outside 0 to 1.
    pub fn new(sheet: Orthotropic, share: f64) -> Result<TensionField, String> {
        let det = sheet.a11 * sheet.a22 - sheet.a12 * sheet.a12;
        if !(sheet.a11 > 0.0 && sheet.a66 > 0.0 && det > 0.0 && sheet.a22.is_finite()) {
            return Err("the sheet is not stiff in every direction; write positive moduli and a smaller nu12".into());
        }
        if !(0.0..=1.0).contains(&share) {
            return Err(format!("the compressive share is {share}; write a number from 0 to 1"));
        }
        let (warp, fill) = (sheet.a22 / det, sheet.a11 / det);
        let mixed = 1.0 / sheet.a66 - 2.0 * sheet.a12 / det;
        let p0 = (3.0 * (warp + fill) + mixed) / 8.0;
        let mut rest = [(warp - fill) / 2.0, (warp + fill - mixed) / 8.0];
        if rest.iter().all(|p| p.abs() < 1e-13 * p0) {
            rest = [0.0; 2];
        }
        let compliance = [p0, rest[0], rest[1]];
        let samples = std::array::from_fn(|i| {
            let (sin, cos) = (i as f64 * TAU / SAMPLES as f64).sin_cos();
            [sin, cos, 1.0 / softness(compliance, sin, cos)[0]]
        });
        Ok(TensionField { sheet, share, compliance, samples })
    }

    fn state(&self, e: [f64; 3]) -> FilmState {
        let s = self.sheet.tension(e, &[0.0; 2]);
        if s[0] + s[1] >= 0.0 && s[0] * s[1] >= s[2] * s[2] {
            return FilmState::Taut;
        }
        let along = Along { mean: 0.5 * (e[0] + e[1]), cos: 0.5 * (e[0] - e[1]), sin: 0.5 * e[2] };
        if along.mean + along.cos.hypot(along.sin) <= 0.0 {
            return FilmState::Slack;
        }
        let x = self.direction(&along);
        FilmState::Wrinkled { along, x }
    }

    fn relaxed(&self, e: [f64; 3]) -> (f64, [f64; 3]) {
        match self.state(e) {
            FilmState::Taut => (self.sheet.energy(e, &[0.0; 2]), self.sheet.tension(e, &[0.0; 2])),
            FilmState::Slack => (0.0, [0.0; 3]),
            FilmState::Wrinkled { along, x } => {
                let (sin, cos) = x.sin_cos();
                let strain = along.at(sin, cos);
                let sigma = strain / softness(self.compliance, sin, cos)[0];
                (0.5 * sigma * strain, [0.5 * (1.0 + cos), 0.5 * (1.0 - cos), 0.5 * sin].map(|w| sigma * w))
            }
        }
    }

    /// Tangent of wrinkled sheet. For W = max f(e, x) it is f_ee − f_ex f_xe/f_xx: pulling also turns the wrinkles.
    fn wrinkled_tangent(&self, along: &Along, x: f64) -> [[f64; 3]; 3] {
        let (sin, cos) = x.sin_cos();
        let [s, s1, _] = softness(self.compliance, sin, cos);
        let (e, e1) = (along.at(sin, cos), along.sin * cos - along.cos * sin);
        let sigma = e / s;
        let (w, w1) = ([0.5 * (1.0 + cos), 0.5 * (1.0 - cos), 0.5 * sin], [-0.5 * sin, 0.5 * sin, 0.5 * cos]);
        let mixed: [f64; 3] = std::array::from_fn(|i| (e1 - sigma * s1) / s * w[i] + sigma * w1[i]);
        let bent = 0.5 * e * self.slope(along, x).1 / (s * s);
        matrix(|i, j| w[i] * w[j] / s - mixed[i] * mixed[j] / bent)
    }

    /// x = 2φ with the most energy ½tE(φ)e(φ)².
    fn direction(&self, along: &Along) -> f64 {
        let principal = along.sin.atan2(along.cos);
        if self.compliance[1] == 0.0 && self.compliance[2] == 0.0 {
            return principal;
        }
        let step = TAU / SAMPLES as f64;
        let energies = self.samples.map(|[sin, cos, stiff]| stiff * along.at(sin, cos).max(0.0).powi(2));
        let peaks = (0..SAMPLES).filter(|i| {
            let (before, after) = (energies[(i + SAMPLES - 1) % SAMPLES], energies[(i + 1) % SAMPLES]);
            energies[*i] > 0.0 && energies[*i] >= before && energies[*i] >= after
        });
        let candidates = peaks.map(|i| self.climb(along, (i as f64 - 1.0) * step, (i as f64 + 1.0) * step));
        let better = |a: f64, b: f64| if self.energy_along(along, b) > self.energy_along(along, a) { b } else { a };
        // Nearly slack, only a cone between two samples is stretched; it holds the principal direction.
        candidates.reduce(better).unwrap_or_else(|| self.climb(along, principal - step, principal + step))
    }

    /// The peak between `low` and `high`: root of the energy's slope by Newton inside a shrinking bracket.
    fn climb(&self, along: &Along, mut low: f64, mut high: f64) -> f64 {
        /// Bisection alone needs 50 for f64; Newton takes about 5.
        const MOST: usize = 60;
        let mut x = 0.5 * (low + high);
        for _ in 0..MOST {
            let (slope, curvature) = self.slope(along, x);
            if slope > 0.0 {
                low = x;
            } else {
                high = x;
            }
            let newton = x - slope / curvature;
            let next = if newton > low && newton < high { newton } else { 0.5 * (low + high) };
            if (next - x).abs() <= 1e-15 * TAU {
                return next;
            }
            x = next;
        }
        x
    }

    fn energy_along(&self, along: &Along, x: f64) -> f64 {
        let (sin, cos) = x.sin_cos();
        let strain = along.at(sin, cos);
        if strain > 0.0 { strain * strain / softness(self.compliance, sin, cos)[0] } else { 0.0 }
    }

    /// 2e′s − e s′, which has the sign of the slope of e²/s where e > 0, and its slope; e′ where e ≤ 0.
    fn slope(&self, along: &Along, x: f64) -> (f64, f64) {
        let (sin, cos) = x.sin_cos();
        let e = [along.at(sin, cos), along.sin * cos - along.cos * sin, -along.cos * cos - along.sin * sin];
        let s = softness(self.compliance, sin, cos);
        if e[0] <= 0.0 {
            return (e[1], e[2]);
        }
        (2.0 * e[1] * s[0] - e[0] * s[1], 2.0 * e[2] * s[0] + e[1] * s[1] - e[0] * s[2])
    }
}

impl Fabric for TensionField {
    fn thickness_m(&self) -> f64 {
        self.sheet.thickness_m
    }

    fn energy(&self, e: [f64; 3], past: &Past) -> f64 {
        (1.0 - self.share) * self.relaxed(e).0 + self.share * self.sheet.energy(e, past)
    }

    fn tension(&self, e: [f64; 3], past: &Past) -> [f64; 3] {
        let (wrinkling, full) = (self.relaxed(e).1, self.sheet.tension(e, past));
        std::array::from_fn(|i| (1.0 - self.share) * wrinkling[i] + self.share * full[i])
    }

    fn tangent(&self, e: [f64; 3], past: &Past) -> [[f64; 3]; 3] {
        let full = self.sheet.tangent(e, past);
        let own = match self.state(e) {
            FilmState::Taut => return full,
            FilmState::Slack => [[0.0; 3]; 3],
            FilmState::Wrinkled { along, x } => self.wrinkled_tangent(&along, x),
        };
        matrix(|i, j| (1.0 - self.share) * own[i][j] + self.share * full[i][j])
    }

    fn steepest(&self, e: [f64; 3], past: &Past, _reach: f64) -> [[f64; 3]; 3] {
        self.sheet.tangent(e, past)
    }
}

enum FilmState {
    Taut,
    Slack,
    /// Wrinkled, with tension along one direction only, x/2 from the warp.
    Wrinkled {
        along: Along,
        x: f64,
    },
}

/// 1/(t E(φ)) over x = 2φ and its two slopes.
fn softness([p0, p1, p2]: [f64; 3], sin: f64, cos: f64) -> [f64; 3] {
    let (sin2, cos2) = (2.0 * sin * cos, (cos - sin) * (cos + sin));
    [p0 + p1 * cos + p2 * cos2, -p1 * sin - 2.0 * p2 * sin2, -p1 * cos - 4.0 * p2 * cos2]
}

/// Strain along a direction: e(φ) = mean + cos·cos 2φ + sin·sin 2φ.
struct Along {
    mean: f64,
    cos: f64,
    sin: f64,
}

impl Along {
    fn at(&self, sin: f64, cos: f64) -> f64 {
        self.mean + self.cos * cos + self.sin * sin
    }
}

fn make(recipe: &Recipe) -> Result<Arc<dyn Fabric>, String> {
    let v = ENTRY.read(recipe)?;
    let (nu12, t) = (v.get("nu12")?, v.get("thickness_mm")?);
    let sheet = if v.optional("e90_MPa").is_some() {
        super::orthotropic::from_values(&v)?
    } else if v.optional("e45_MPa").is_some() || v.optional("g_MPa").is_some() {
        return Err(
            v.says("`e45_MPa` or `g_MPa` without `e90_MPa`; write e90_MPa too, or e0_MPa and nu12 alone".into())
        );
    } else if nu12 > 0.5 {
        return Err(v.says(format!("nu12 is {nu12}; write a number from 0 to 0.5 for an isotropic film")));
    } else {
        Orthotropic::isotropic(v.get("e0_MPa")?, nu12, t)
    };
    Ok(Arc::new(TensionField::new(sheet, v.get("compression_share")?).map_err(|m| v.says(m))?))
}
