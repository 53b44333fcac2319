//! Woven fabric: two yarn families that follow the deformation, and the shear between them, each by its own curve.
//!
//! ```text
//! λ₁ = √C₁₁   ε₁ = λ₁ − 1   λ₂ = √C₂₂   ε₂ = λ₂ − 1   γ = asin(C₁₂/(λ₁λ₂))
//! W = t [ ∫₀^ε₁ T₁ dε + ∫₀^ε₂ T₂ dε + c ε₁ε₂ + ∫₀^γ T₁₂ dγ ]
//!
//! ∂ε₁/∂e₁ = 1/λ₁     ∂γ/∂e₃ = 1/(λ₁λ₂ cos γ)     ∂γ/∂e₁ = −tan γ/λ₁²       (e₃ = 2E₁₂ = C₁₂, C₁₁ = 1 + 2e₁)
//! S₁ = t [(T₁ + c ε₂)/λ₁ − T₁₂ tan γ/λ₁²]     S₂ likewise     S₃ = t T₁₂/(λ₁λ₂ cos γ)
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | ε₁, ε₂ | nominal strain of warp and fill | – |
//! | T₁(ε), T₂(ε) | force per reference cross-section, pulled along a yarn | Pa |
//! | γ | angle that the yarns have closed | rad |
//! | T₁₂(γ) | moment per reference volume that closes it; from bias extension C_s/t = F_sh cos γ/t | Pa |
//! | ν₁₂, c | biaxial coupling (crimp interchange): c = ν₁₂E₂/(1 − ν₁₂ν₂₁), E from the initial slopes | –, Pa |
//! | t | thickness | m |
//!
//! With ν₁₂ > 0 the curves in W are those given, over 1 − ν₁₂ν₂₁: so a straight given curve *is* the uniaxial test; a bent one
//! is so at small strain only.
//!
//! **Unloading.** ε* is the largest strain seen. Below it the yarn follows the unloading curve u, scaled to meet the loading
//! curve there: T = T(ε*) u(ε)/u(ε*), back to zero strain, and forth again up to ε*. Lost for good is
//! D(ε*) = ∫₀^ε* T dε − T(ε*)/u(ε*) ∫₀^ε* u dε, which never falls if u/T never falls: that is checked. Beyond ε* the energy
//! is ∫T dε − D(ε*): tension is its slope at fixed memory, and energy plus loss is continuous when the memory moves.
//!
//! Valid for large turns of the yarns. **Do not use it where yarns slip out of the weave**, nor expect permanent set, rate
//! or a yarn in compression to buckle: that is what the mesh does. The stress is continuous, the stiffness jumps at rows.
//! At λ → 0 or γ → 90° the energy stays finite; a locking angle keeps elements from closing.
//! Reference: Abaqus 2017, Materials, Fabric material behavior (kinematics); Cao et al. 2008, Composites A 39 (shear).

use std::sync::Arc;

use super::bias_extension::BiasExtension;
use super::curve::Curve;
use super::fabric::{Fabric, Past, matrix};
use super::orthotropic::{coupling_fits, shear_modulus};
use super::recipe::*;
use super::yarn::Yarn;

pub(super) const ENTRY: Law = Law {
    name: "woven",
    parameters: &[
        modulus("e0_MPa").optional("modulus pulled along warp; in place of the curve warp"),
        modulus("e90_MPa").optional("modulus pulled along fill; in place of the curve fill"),
        modulus("e45_MPa").optional("modulus pulled at 45 degrees; in place of g_MPa and the curve shear"),
        modulus("g_MPa").optional("stress per shear angle [rad]; in place of e45_MPa and the curve shear"),
        ratio("nu12", [0.0, 2.0]).or(0.0, "contraction along fill per stretch along warp"),
        ratio("compression_share", [1e-6, 1.0]).optional("slope below zero strain over initial slope; else 1"),
        number("locking_deg", "deg", std::f64::consts::PI / 180.0, [1.0, 89.0])
            .optional("shear angle at which the yarns jam; else they never do"),
        modulus("locking_MPa").optional("slope added beyond locking_deg; else 10 times the steepest of shear"),
        strip("bias_length_mm", "free length of the strip"),
        strip("bias_width_mm", "width of the strip"),
        THICKNESS,
    ],
    curves: &[
        tensile("warp").means("stress over nominal strain, pulled along warp; in place of e0_MPa"),
        tensile("fill").means("stress over nominal strain, pulled along fill; in place of e90_MPa"),
        tensile("warp_unloading").means("shape of the way back along warp; else as loading"),
        tensile("fill_unloading").means("shape of the way back along fill; else as loading"),
        table("shear", ("deg", std::f64::consts::PI / 180.0), ("MPa", 1e6))
            .means("moment per volume over shear angle; in place of g_MPa and e45_MPa"),
        table("bias_extension", ("mm", 1e-3), ("N", 1.0))
            .means("clamp force over displacement of a strip pulled at 45 degrees; in place of the curve shear"),
    ],
    strain_limit: 0.3,
    example,
    make: |recipe| Ok(Arc::new(from_values(&ENTRY.read(recipe)?)?)),
    ..SHEET
};

/// Woven fabric with a law for each yarn family, one for their shear, and a linear coupling.
#[derive(Debug, Clone, PartialEq)]
pub struct Woven {
    thickness_m: f64,
    yarns: [Yarn; 2],
    shear: Curve,
    coupling_pa: f64,
}

impl Woven {
    /// From curves: stress over nominal strain of both families, stress over shear angle \[rad\] (odd: only the part above zero
    /// is used), coupling and thickness.
    ///
    /// # Errors
    /// A thickness that is not positive; a coupling so strong that some strain would give energy away.
    pub fn new(yarns: [Yarn; 2], shear: Curve, nu12: f64, thickness_m: f64) -> Result<Woven, String> {
        if !(thickness_m > 0.0 && thickness_m.is_finite()) {
            return Err(format!("the thickness is {thickness_m} m; write a positive number"));
        }
        let [e1, e2] = [&yarns[0], &yarns[1]].map(|y| y.load.initial_slope());
        coupling_fits(e1, e2, nu12)?;
        let lateral = 1.0 / (1.0 - nu12 * nu12 * e2 / e1);
        let yarns = yarns.map(|y| Yarn { load: y.load.scaled(1.0, lateral), unload: y.unload });
        let coupling_pa = nu12 * e2 * lateral;
        let carried = (yarns[0].least_slope() * yarns[1].least_slope()).sqrt();
        if coupling_pa >= carried {
            return Err(format!(
                "nu12 = {nu12} couples the yarns more strongly than the flattest part of their curves can carry: \
                 write a number below {:.4}, a larger compression_share or steeper curves",
                nu12 * carried / coupling_pa
            ));
        }
        Ok(Woven { thickness_m, yarns, shear: shear.mirrored(), coupling_pa })
    }
}

impl Woven {
    /// ∂S/∂e with these slopes of the yarns' curves and of shear.
    fn stiffness(&self, yarns: &YarnStretch, past: &Past, slopes: [f64; 2], steep: f64) -> [[f64; 3]; 3] {
        let t12 = self.shear.value(yarns.gamma);
        let (turn, turns) = yarns.turn();
        let mut k = matrix(|i, j| steep * turn[i] * turn[j] + t12 * turns[i][j]);
        for (i, (yarn, l)) in self.yarns.iter().zip(yarns.lambda).enumerate() {
            let (own, other) = (yarns.nominal[i], yarns.nominal[1 - i]);
            let stress = yarn.stress(own, past[i]) + self.coupling_pa * other;
            k[i][i] += (slopes[i] - stress / l) / (l * l);
            k[i][1 - i] += self.coupling_pa / (l * yarns.lambda[1 - i]);
        }
        k.map(|row| row.map(|x| x * self.thickness_m))
    }
}

impl Fabric for Woven {
    fn thickness_m(&self) -> f64 {
        self.thickness_m
    }

    fn energy(&self, e: [f64; 3], past: &Past) -> f64 {
        let yarns = YarnStretch::new(e);
        let [a, b] = yarns.nominal;
        let along = self.yarns[0].energy(a, past[0]) + self.yarns[1].energy(b, past[1]);
        self.thickness_m * (along + self.coupling_pa * a * b + self.shear.integral(yarns.gamma))
    }

    fn tension(&self, e: [f64; 3], past: &Past) -> [f64; 3] {
        let yarns = YarnStretch::new(e);
        let [a, b] = yarns.nominal;
        let [l1, l2] = yarns.lambda;
        let t1 = self.yarns[0].stress(a, past[0]) + self.coupling_pa * b;
        let t2 = self.yarns[1].stress(b, past[1]) + self.coupling_pa * a;
        let t12 = self.shear.value(yarns.gamma) / yarns.cos;
        let turn = t12 * yarns.sin;
        [t1 / l1 - turn / (l1 * l1), t2 / l2 - turn / (l2 * l2), t12 / (l1 * l2)].map(|s| s * self.thickness_m)
    }

    fn tangent(&self, e: [f64; 3], past: &Past) -> [[f64; 3]; 3] {
        let yarns = YarnStretch::new(e);
        let slopes = [0, 1].map(|i| self.yarns[i].slope(yarns.nominal[i], past[i]));
        self.stiffness(&yarns, past, slopes, self.shear.slope(yarns.gamma))
    }

    fn steepest(&self, e: [f64; 3], past: &Past, reach: f64) -> [[f64; 3]; 3] {
        let yarns = YarnStretch::new(e);
        let slopes = [0, 1].map(|i| self.yarns[i].steepest(yarns.nominal[i], past[i], reach));
        self.stiffness(&yarns, past, slopes, self.shear.steepest(yarns.gamma - reach, yarns.gamma + reach))
    }

    fn has_memory(&self) -> bool {
        self.yarns.iter().any(|y| y.unload.is_some())
    }

    fn remember(&self, e: [f64; 3], past: &mut Past) {
        let seen = YarnStretch::new(e).nominal;
        *past = [past[0].max(seen[0]), past[1].max(seen[1])];
    }

    fn dissipated(&self, past: &Past) -> f64 {
        self.thickness_m * (self.yarns[0].lost(past[0]) + self.yarns[1].lost(past[1]))
    }
}

struct YarnStretch {
    lambda: [f64; 2],
    nominal: [f64; 2],
    gamma: f64,
    sin: f64,
    cos: f64,
}

impl YarnStretch {
    fn new(e: [f64; 3]) -> YarnStretch {
        // A collapsed element ends as a finite number that the guards see, not as NaN.
        const LEAST: f64 = 1e-6;
        let lambda = [e[0], e[1]].map(|x| (1.0 + 2.0 * x).max(LEAST * LEAST).sqrt());
        // √(1 + 2e) − 1 without cancellation.
        let nominal = [2.0 * e[0] / (1.0 + lambda[0]), 2.0 * e[1] / (1.0 + lambda[1])];
        let sin = (e[2] / (lambda[0] * lambda[1])).clamp(-1.0, 1.0);
        let cos = ((1.0 - sin) * (1.0 + sin)).sqrt().max(LEAST);
        YarnStretch { lambda, nominal, gamma: sin.asin(), sin, cos }
    }

    /// ∂γ/∂e and ∂²γ/∂e²: differentiate −tan γ/λ² and 1/(λ₁λ₂ cos γ) once more, with ∂λ⁻²/∂e = −2λ⁻⁴.
    fn turn(&self) -> ([f64; 3], [[f64; 3]; 3]) {
        let inverse = self.lambda.map(|l| 1.0 / (l * l));
        let (tan, sec2) = (self.sin / self.cos, 1.0 / (self.cos * self.cos));
        let across = 1.0 / (self.lambda[0] * self.lambda[1] * self.cos);
        let g = [-tan * inverse[0], -tan * inverse[1], across];
        let along = |i: usize, j: usize| {
            let stretched = if i == j { 2.0 * tan * inverse[i] * inverse[i] } else { 0.0 };
            stretched - sec2 * g[j] * inverse[i]
        };
        let rows = [0, 1].map(|i| [0, 1, 2].map(|j| along(i, j)));
        (g, [rows[0], rows[1], [rows[0][2], rows[1][2], across * across * tan]])
    }
}

fn from_values(v: &RecipeValues) -> Result<Woven, String> {
    v.exactly_one(&["e0_MPa", "warp"])?;
    v.exactly_one(&["e90_MPa", "fill"])?;
    v.exactly_one(&["e45_MPa", "g_MPa", "shear", "bias_extension"])?;
    let yarns = [yarn(v, "e0_MPa", "warp", "warp_unloading")?, yarn(v, "e90_MPa", "fill", "fill_unloading")?];
    let nu12 = v.get("nu12")?;
    let [e1, e2] = [&yarns[0], &yarns[1]].map(|y| y.load.initial_slope());
    let shear = match (v.curve("shear")?.or(bias_extension(v)?), v.optional("e45_MPa")) {
        (Some(curve), _) => curve,
        (None, Some(e45)) => Curve::linear(shear_modulus(e1, e2, e45, nu12).map_err(|m| v.says(m))?),
        (None, None) => Curve::linear(v.get("g_MPa")?),
    };
    Woven::new(yarns, locked(v, shear)?, nu12, v.get("thickness_mm")?).map_err(|m| v.says(m))
}

fn yarn(v: &RecipeValues, modulus: &str, curve: &str, unloading: &str) -> Result<Yarn, String> {
    let load = match v.curve(curve)? {
        Some(table) => table,
        None => Curve::linear(v.get(modulus)?),
    };
    let load = match v.optional("compression_share") {
        Some(_) if load.has_negative_rows() => {
            let twice = format!("curve `{curve}` has rows below zero strain; leave them or `compression_share` out");
            return Err(v.says(twice));
        }
        Some(share) => load.with_compression(share),
        None => load,
    };
    Yarn::new(load, v.curve(unloading)?).map_err(|m| v.says(format!("curve `{unloading}`: {m}")))
}

fn bias_extension(v: &RecipeValues) -> Result<Option<Curve>, String> {
    let thickness_m = v.get("thickness_mm")?;
    match (v.curve("bias_extension")?, v.optional("bias_length_mm"), v.optional("bias_width_mm")) {
        (Some(test), Some(length_m), Some(width_m)) => {
            let rows = BiasExtension { length_m, width_m, thickness_m }.shear(test.rows());
            let curve = rows.and_then(|rows| Curve::table(&rows));
            curve.map(Some).map_err(|m| v.says(format!("curve `bias_extension`, as shear angle and moment: {m}")))
        }
        (None, None, None) => Ok(None),
        _ => {
            Err(v.says("write `bias_extension`, `bias_length_mm` and `bias_width_mm` together, or none of them".into()))
        }
    }
}

fn locked(v: &RecipeValues, shear: Curve) -> Result<Curve, String> {
    /// Steep against the cloth, soft enough not to shorten the time step much: assumed, not measured.
    const STEEPER: f64 = 10.0;
    match (v.optional("locking_deg"), v.optional("locking_MPa")) {
        (Some(at), slope) => Ok(shear.stiffened(at, slope.unwrap_or(STEEPER * shear.slope_range()[1]))),
        (None, Some(_)) => Err(v.says("`locking_MPa` without `locking_deg`; write both or neither".into())),
        (None, None) => Ok(shear),
    }
}

const fn strip(key: &'static str, meaning: &'static str) -> LawParameter {
    number(key, "mm", 1e-3, [1.0, 1e4]).optional(meaning)
}

const fn tensile(key: &'static str) -> CurveInput {
    table(key, ("-", 1.0), ("MPa", 1e6))
}

fn example() -> Recipe {
    let tables: [(&str, &[[f64; 2]]); 4] = [
        ("warp", &[[0.0, 0.0], [0.02, 1.6], [0.1, 12.0], [0.2, 22.0]]),
        ("warp_unloading", &[[0.0, 0.0], [0.02, 0.3], [0.1, 4.0], [0.2, 12.0]]),
        ("fill", &[[0.0, 0.0], [0.03, 3.0], [0.2, 24.0]]),
        ("shear", &[[0.0, 0.0], [10.0, 0.2], [30.0, 0.4], [45.0, 1.2]]),
    ];
    let curves = tables.into_iter().map(|(key, rows)| (key.to_string(), rows.to_vec())).collect();
    Recipe { curves, ..Recipe::of(&[("nu12", 0.2), ("locking_deg", 45.0), ("thickness_mm", 0.05)]) }
}
