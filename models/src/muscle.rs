//! The fabric muscle as a cell: a pressurised tube of two halves whose yarns give, one half glued to the body's wall, with
//! flat ends. All that is inside it is eliminated in closed form but one number, so the balance still sees one coordinate.
//!
//! ```text
//! fabric      xᵤ = y − κh,  xₗ = y + κh            lengths of the free and the glued half, y that of the axis, h = 2r/π
//! yarns       m = cos²α₀ (x² − 1)/2 + sin²α₀ e     Green strain of both families; hoop strain e = (s − 1)/2, s = hoop stretch²
//! shear       + ½ G_t sin²2α₀ (e − (x² − 1)/2)² over each half
//! halves      Fᵤ/W = m²/c − ½τ s                   τ = P r₀ y: pressure work of half the tube, −½P v
//!             Fₗ/W = m²/c + ½K e² − ½τ s + ½K ((xₗ² − 1)/2)₊²      K: the wall it is glued to, yarns along and across
//! hoop        ∂F/∂s = 0:   mᵤ = cτ/(2 sin²α₀),   mₗ = c (τ sin²α₀ + Kp)/(2 sin⁴α₀ + Kc),  p = cos²α₀ (xₗ² − 1)/2
//! flat ends   −(P π r² − p_b ΔA) r g(d) each,  g = (d³/3 + 2d − 1/d)/8 − d:  they shorten the muscle by d r
//! line        κD = 1 − y + n d r/L';               ∂/∂d = 0:  ∂(Fᵤ + Fₗ)/∂y = (P π r² − p_b ΔA) g'(d)
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | c | compliance of the yarns, strain of both per tension in both, (1 − ν)/(E t); effect `yarn_stretch` | m/N |
//! | K | E t of the wall to which half of the muscle is glued; effect `glued_face` | N/m |
//! | G_t | shear modulus × thickness; effect `shear_stiffness`, on what the fabric shears and not on what the line shortens | N/m |
//! | n | ends that are sealed flat; effect `flat_ends` | – |
//! | ΔA | area that the body's section loses to the muscle; effect `sunk_muscle` | m² |
//! | r, r₀ | radius under pressure, √(mean s) r₀ at rest length, and at rest, W/π | m |
//! | L', L | length that bends, L − n πr/4, and flat length | m |
//!
//! *Flat ends.* A section of height u·2r that is flattened by its seam holds (2u − u²) π r² (perimeter kept). A generator
//! that climbs there from the seam maximises ∫A cosψ ds at slope ψ, so A/cosψ is constant: without a pull on it cosψ = 2u − u²,
//! and the end is shorter than its fabric by r ∫(1 − u)/√(1 + 2u − u²) du = (√2 − 1) r. A pull N adds N/P to both areas, which
//! gives d = √m − √(m − 1), m = 2 + 2N/(Pπr²), and back N = Pπr² ((d + 1/d)²/8 − 1) = Pπr² g'(d). Its height is missing
//! over ∫(1 − u) ds = π r/4: there the muscle is not yet in the wall and does not bend it.
//!
//! *Energy.* At given pressure the hoop takes P Δv from the supply and stores half of it, so a ledger line of this term is
//! what the cell's potential has beyond −P v of a tube with stiff yarns; it may be negative.
//!
//! **Validity**: both halves round with one radius, (√sᵤ + √sₗ)² taken as 2(sᵤ + sₗ) (0.3 % at the stretches of an fPAM);
//! yarns linear in Green strain; a wall that takes no compression along the body. Derived here.

use crate::assembly::Assembly;
use crate::site::Site;
use crate::term::{Pose, Term, actuator_q};
use std::f64::consts::{FRAC_PI_4, PI, SQRT_2};

/// What effects make of a muscle; nothing of it in the bare model.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Weave {
    /// Compliance c of its yarns \[m/N\].
    pub compliance_m_per_n: f64,
    /// E t of the wall to which one half is glued \[N/m\]; 0: it is not.
    pub wall_n_per_m: f64,
    /// Ends that are sealed flat.
    pub flat_ends: f64,
    /// Area ΔA that the body's section loses to the muscle \[m²\].
    pub drawn_in_m2: f64,
    /// Shear stiffness G t of its fabric \[N/m\], where the cell takes it over from a term of its own.
    pub shear_n_per_m: f64,
}

impl Weave {
    /// Whether the cell stands in for the tube with stiff yarns.
    pub(crate) fn is_cell(&self) -> bool {
        [self.compliance_m_per_n, self.wall_n_per_m, self.flat_ends] != [0.0; 3]
    }
}

/// The cell of one site as a term over the contraction.
#[derive(Debug, Clone, Copy)]
struct Muscle {
    weave: Weave,
    /// r₀ \[m\].
    radius_m: f64,
    length_m: f64,
    /// Arm D \[m\].
    arm_m: f64,
    volume_gain: f64,
    /// cos²α₀, sin²α₀.
    bias: [f64; 2],
}

/// Puts the cell in place of the tube with stiff yarns wherever an effect asks for one.
pub(crate) fn complete(assembly: &mut Assembly) {
    for site in &mut assembly.sites {
        if site.actuator.is_some() && site.weave.is_cell() {
            site.actuator_terms.push(Box::new(Muscle::of(site)));
        }
    }
}

/// One half of the tube per unit of its width: energy, pressure work included, and derivatives.
#[derive(Debug, Clone, Copy, Default)]
struct Half {
    energy: f64,
    /// By the length of the axis.
    by_axis: f64,
    /// By its own length alone.
    by_own: f64,
    /// Second derivative by the axis, the half moving along.
    stiffness: f64,
    /// Hoop stretch squared.
    hoop2: f64,
}

impl Muscle {
    fn of(site: &Site) -> Muscle {
        let shape = &site.shape;
        Muscle {
            weave: site.weave,
            radius_m: shape.width_m / PI,
            length_m: shape.length_m,
            arm_m: site.linkage.arm_m,
            volume_gain: shape.volume_gain,
            bias: shape.bias_squares(),
        }
    }

    /// A half of length x at the axis y, glued to a wall of stiffness K; `thrust` = P r₀.
    fn half(&self, x: f64, y: f64, wall: f64, thrust: f64) -> Half {
        let ([c2, s2], c) = (self.bias, self.weave.compliance_m_per_n);
        let (tau, along, d_along) = (thrust * y, 0.5 * c2 * (x * x - 1.0), c2 * x);
        let per = 1.0 / (2.0 * s2 * s2 + wall * c);
        // m/c, which stays finite with stiff yarns, and m.
        let pull = (tau * s2 + wall * along) * per;
        let hoop = (c * pull - along) / s2;
        let taut = (0.5 * (x * x - 1.0)).max(0.0);
        let d_pull = (thrust * s2 + wall * d_along) * per;
        let [by_tau, by_x] = [c * thrust * per, (c * wall * d_along * per - d_along) / s2];
        let d_hoop = by_tau + by_x;
        // Shear of the weave in its own axes; its stiffness is too small to move the hoop.
        let turn = 4.0 * c2 * s2 * self.weave.shear_n_per_m;
        let shear = hoop - 0.5 * (x * x - 1.0);
        let d_taut = if taut > 0.0 { x } else { 0.0 };
        Half {
            energy: c * pull * pull + 0.5 * wall * (hoop * hoop + taut * taut) - tau * (0.5 + hoop)
                + 0.5 * turn * shear * shear,
            by_axis: -thrust * (0.5 + hoop) + turn * shear * by_tau,
            by_own: 2.0 * pull * d_along + wall * taut * x + turn * shear * (by_x - x),
            stiffness: 2.0 * (d_pull * d_along + pull * c2) + wall * (d_taut * x + taut) - thrust * d_hoop
                + turn * (d_hoop - x) * (d_hoop - x),
            hoop2: 1.0 + 2.0 * hoop,
        }
    }

    /// Both halves at the axis length y and the bend κh.
    fn halves(&self, y: f64, bend: f64, thrust: f64) -> [Half; 2] {
        [self.half(y - bend, y, 0.0, thrust), self.half(y + bend, y, self.weave.wall_n_per_m, thrust)]
    }

    /// Potential per metre of body at a contraction of the line, and its slope.
    fn potential(&self, contraction: f64, p_act_pa: f64, p_body_pa: f64) -> (f64, f64) {
        let Muscle { radius_m, length_m, arm_m, weave, .. } = *self;
        let (width, p) = (PI * radius_m, self.volume_gain * p_act_pa);
        let thrust = p * radius_m;
        let [free, glued] = self.halves(1.0, 0.0, thrust);
        let radius = radius_m * (0.5 * (free.hoop2 + glued.hoop2)).sqrt();
        let idle = (weave.flat_ends * FRAC_PI_4 * radius / length_m).min(MOST_IDLE);
        let line = contraction / (1.0 - idle);
        let lever = if weave.wall_n_per_m == 0.0 { 0.0 } else { 2.0 * radius / (PI * arm_m) };
        let gain = weave.flat_ends * radius / (length_m * (1.0 - idle));
        let drive = p * PI * radius * radius - p_body_pa * weave.drawn_in_m2;
        let at = |d: f64| self.halves(1.0 - line + gain * d, lever * line, thrust);
        let d = if gain == 0.0 || drive <= 0.0 { 0.0 } else { shortening(&at, width, gain, drive) };
        let [free, glued] = at(d);
        let pull = |half: Half| half.by_axis + half.by_own;
        let mut energy = (1.0 - idle) * width * (free.energy + glued.energy);
        if d > 0.0 {
            energy -= (1.0 - idle) * gain * drive * end_work(d);
        }
        (energy, width * (lever * (glued.by_own - free.by_own) - pull(free) - pull(glued)))
    }

    /// v − v₀ and dv/dε of the tube with stiff yarns, which the term stands in for.
    fn stiff(&self, contraction: f64) -> (f64, f64) {
        let area = self.volume_gain * PI * self.radius_m.powi(2);
        let ([c2, s2], length) = (self.bias, 1.0 - contraction);
        let volume = area * (1.0 - c2 * length * length) / s2 * length;
        (volume - area, area * (3.0 * c2 * length * length - 1.0) / s2)
    }
}

impl Term for Muscle {
    fn name(&self) -> &'static str {
        "muscle"
    }

    fn add(&self, at: &Pose, force: &mut [f64]) -> f64 {
        let contraction = at.q[actuator_q::CONTRACTION];
        let (energy, slope) = self.potential(contraction, at.p_act_pa, at.p_body_pa);
        let (gained, d_volume) = self.stiff(contraction);
        force[actuator_q::CONTRACTION] -= slope + at.p_act_pa * d_volume;
        let at_rest = self.volume_gain * at.p_act_pa * PI * self.radius_m.powi(2);
        energy + at_rest + at.p_act_pa * gained
    }
}

/// Largest share of a muscle that its ends may take.
const MOST_IDLE: f64 = 0.9;
/// Range of the shortening of a flat end over r: at 1 it pushes as hard as it can.
const ENDS: [f64; 2] = [1e-4, 1.0];

/// `g(d) = (d³/3 + 2d − 1/d)/8 − d`: work of a flat end over P π r³.
fn end_work(d: f64) -> f64 {
    (d * d * d / 3.0 + 2.0 * d - 1.0 / d) / 8.0 - d
}

/// `g' = (d + 1/d)²/8 − 1`, its pull over P π r², and its slope.
fn end_pull(d: f64) -> [f64; 2] {
    let inverse = 1.0 / d;
    [0.125 * (d + inverse) * (d + inverse) - 1.0, 0.25 * (d + inverse) * (1.0 - inverse * inverse)]
}

/// Shortening of each end at which it pulls as the tube does: Newton within a bracket.
fn shortening(at: &dyn Fn(f64) -> [Half; 2], width: f64, gain: f64, drive: f64) -> f64 {
    let ([mut low, mut high], mut d) = (ENDS, SQRT_2 - 1.0);
    for _ in 0..80 {
        let [free, glued] = at(d);
        let [pull, stiffness] = end_pull(d);
        let tube = width * (free.by_axis + free.by_own + glued.by_axis + glued.by_own);
        let excess = tube - drive * pull;
        if excess > 0.0 {
            high = d
        } else {
            low = d
        }
        let step = excess / (width * gain * (free.stiffness + glued.stiffness) - drive * stiffness);
        let next = d - step;
        // What the next step would be is the square of this one: rounding, which a bracket as narrow would only halve.
        if step.abs() < 1e-10 {
            return next;
        }
        let inside = low < next && next < high;
        d = if inside { next } else { 0.5 * (low + high) };
    }
    d
}

#[cfg(test)]
#[path = "muscle_tests.rs"]
mod tests;
