//! The fabric muscle as a cell: a pressurised tube of two halves whose yarns give, one half glued to the body's wall, with
//! flat ends. All that is inside it is eliminated in closed form but one number, so the balance still sees one coordinate.
//!
//! ```text
//! fabric      xᵤ = y − κh,  xₗ = y + κh            lengths of the free and the glued half, y of the axis, h = 2r/π
//! yarns       m = cos²α₀ (x² − 1)/2 + sin²α₀ e     Green strain of both families; hoop strain e = (s − 1)/2, s = hoop stretch²
//! shear       + ½ G_t sin²2α₀ (e − (x² − 1)/2)² over each half
//! halves      Fᵤ/W = m²/c − ½τ s                   τ = P r₀ y: pressure work of half the tube, −½P v
//!             Fₗ/W = m²/c + ½K e² − ½τ s + ½K ((xₗ² − 1)/2)₊²      K: the wall it is glued to, yarns along and across
//! hoop        ∂F/∂s = 0:   mᵤ = cτ/(2 sin²α₀),   mₗ = c (τ sin²α₀ + Kp)/(2 sin⁴α₀ + Kc),  p = cos²α₀ (xₗ² − 1)/2
//! half        F/W = −½τ − ½Aτ² + Bτε + ½Cε² + ½Kε₊²,  ε = (x² − 1)/2    with hoop, yarns and shear g = G_t sin²2α₀ in
//!             a = c/N, k = −2 sin²α₀ cos²α₀/N, N = 2 sin⁴α₀ + Kc:  A = a − ga²,  B = ga(k − 1) − k,  C = 2K cos⁴α₀/N + g(k − 1)²
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

use crate::actuators::ActuatorShape;
use crate::site::{SideEffects, Site};
use crate::term::{Account, LedgerLine, Pose, Term, actuator_q};
use crate::weave::Weave;
use std::f64::consts::{FRAC_PI_4, PI, SQRT_2};

/// The cell of one site as a term over the contraction.
#[derive(Debug, Clone, Copy)]
struct Muscle {
    /// Radius r₀ of the tube at rest, W/π \[m\].
    radius_m: f64,
    volume_gain: f64,
    /// Flat ends per length, n/L, and lever of the glued half over radius and arm, h/(rD) \[1/m\].
    per_m: [f64; 2],
    /// Section area lost to the muscle over its width, ΔA/W \[m\].
    drawn_in_m: f64,
    /// cos²α₀ and sin²α₀ of the angle between yarns and axis.
    bias: [f64; 2],
    /// The free half and the glued one.
    halves: [Half; 2],
}

/// Puts the cell in place of the tube with stiff yarns where an effect asks for one.
pub(crate) fn complete(site: &mut Site) {
    if let Some(actuator) = site.actuator.filter(|_| site.weave.is_cell()) {
        let tabulated_from = site.weave.drawn_in_m2 / (actuator.area)(&site.shape);
        let cell = Muscle::of(&site.weave, &site.shape, site.linkage.arm_m);
        site.act(cell, SideEffects { tabulated_from, ..SideEffects::SHIFT });
    }
}

/// One half of the tube per unit of its width, its yarns and hoop eliminated.
#[derive(Debug, Clone, Copy)]
struct Half {
    /// a/τ and k: e = a τ + k ε.
    hoop: [f64; 2],
    /// Coefficients A, B and C of its energy F/W.
    by: [f64; 3],
    /// K, yarns along the wall: taut alone.
    wall: f64,
}

/// Derivatives of a half by τ, and by its own length with two more by the axis, with which both move; second and third by
/// the axis.
struct Slopes {
    by_thrust: f64,
    own: [f64; 3],
    second: f64,
    third: f64,
}

impl Half {
    fn new(weave: &Weave, [c2, s2]: [f64; 2], wall: f64) -> Half {
        let c = weave.compliance_m_per_n;
        let per = 1.0 / (2.0 * s2 * s2 + wall * c);
        let [a, k] = [c * per, -2.0 * c2 * s2 * per];
        // Shear of the weave in its own axes; its stiffness is too small to move the hoop.
        let turn = 4.0 * c2 * s2 * weave.shear_n_per_m;
        let own = 2.0 * c2 * c2 * wall * per + turn * (k - 1.0) * (k - 1.0);
        Half { hoop: [a, k], by: [a - turn * a * a, turn * a * (k - 1.0) - k, own], wall }
    }

    /// Energy at the thrust τ and the length x, pressure work included.
    fn energy(&self, tau: f64, x: f64) -> f64 {
        let ([a, b, c], strain) = (self.by, 0.5 * (x * x - 1.0));
        let taut = strain.max(0.0);
        0.5 * (c * strain * strain + self.wall * taut * taut - tau) + tau * (b * strain - 0.5 * a * tau)
    }

    /// Slopes at the axis y, `thrust` = P r₀.
    #[inline]
    fn slopes(&self, x: f64, y: f64, thrust: f64) -> Slopes {
        let ([a, b, c], strain, tau) = (self.by, 0.5 * (x * x - 1.0), thrust * y);
        let wall = if strain > 0.0 { c + self.wall } else { c };
        let pull = b * tau + wall * strain;
        let (mixed, bend) = (b * thrust, b * thrust + wall * x);
        let own = [pull * x, pull + x * bend, 2.0 * bend + wall * x];
        let second = own[1] + mixed * x - a * thrust * thrust;
        Slopes { by_thrust: b * strain - a * tau - 0.5, own, second, third: 3.0 * bend }
    }
}

/// The cell at given pressures and line: everything but the shortening of its ends.
struct PressurisedCell<'a> {
    halves: &'a [Half; 2],
    thrust: f64,
    /// Contraction of what bends, and h over its arm.
    line: f64,
    lever: f64,
    /// n r/L', and (P π r² − p_b ΔA)/W.
    gain: f64,
    drive: f64,
}

impl PressurisedCell<'_> {
    /// Lengths of the axis and of both halves at a shortening of each end over r.
    #[inline]
    fn lengths(&self, d: f64) -> [f64; 3] {
        let (y, bend) = (1.0 - self.line + self.gain * d, self.lever * self.line);
        [y, y - bend, y + bend]
    }

    /// Pull of the tube per width and by how much more the glued half pulls by its own length, each with two derivatives by
    /// the axis.
    #[inline]
    fn tube(&self, d: f64) -> [[f64; 3]; 2] {
        let [y, free, glued] = self.lengths(d);
        let (free, glued) = (self.halves[0].slopes(free, y, self.thrust), self.halves[1].slopes(glued, y, self.thrust));
        let pull = self.thrust * (free.by_thrust + glued.by_thrust) + free.own[0] + glued.own[0];
        let more = [0, 1, 2].map(|i| glued.own[i] - free.own[i]);
        [[pull, free.second + glued.second, free.third + glued.third], more]
    }

    /// Shortening of each end over r at which it pulls as the tube does, and the pulls of [`PressurisedCell::tube`] there: Halley within
    /// a bracket.
    fn settled(&self) -> [f64; 3] {
        let still = |d: f64| self.tube(d).map(|of| of[0]);
        if self.gain == 0.0 || self.drive <= 0.0 {
            let [pull, more] = still(0.0);
            return [0.0, pull, more];
        }
        let ([mut low, mut high], mut d, mut end) = (ENDS, IDLE_END, IDLE_PULL);
        for _ in 0..80 {
            let [pull, more] = self.tube(d);
            let excess = pull[0] - self.drive * end[0];
            *(if excess > 0.0 { &mut high } else { &mut low }) = d;
            let slope = self.gain * pull[1] - self.drive * end[1];
            let bend = self.gain * self.gain * pull[2] - self.drive * end[2];
            let step = -excess * slope / (slope * slope - 0.5 * excess * bend);
            // The next step, left out here, would be some ten times the cube of this one.
            if step.abs() < LAST_STEP {
                let moved = self.gain * step;
                let at = |[f, by, bend]: [f64; 3]| f + moved * (by + 0.5 * moved * bend);
                return [d + step, at(pull), at(more)];
            }
            d = if low < d + step && d + step < high { d + step } else { 0.5 * (low + high) };
            end = end_pull(d);
        }
        let [pull, more] = still(d);
        [d, pull, more]
    }
}

impl Muscle {
    fn of(weave: &Weave, shape: &ActuatorShape, arm_m: f64) -> Muscle {
        let bias = shape.bias_squares();
        let lever = if weave.wall_n_per_m == 0.0 { 0.0 } else { 2.0 / (PI * arm_m) };
        Muscle {
            radius_m: shape.width_m / PI,
            volume_gain: shape.volume_gain,
            per_m: [weave.flat_ends / shape.length_m, lever],
            drawn_in_m: weave.drawn_in_m2 / shape.width_m,
            bias,
            halves: [0.0, weave.wall_n_per_m].map(|wall| Half::new(weave, bias, wall)),
        }
    }

    /// The cell at a contraction of the line, and its share of the flat length.
    #[inline]
    fn held(&self, contraction: f64, p_act_pa: f64, p_body_pa: f64) -> (PressurisedCell<'_>, f64) {
        let Muscle { radius_m, halves, per_m: [ends, lever], .. } = self;
        let p = self.volume_gain * p_act_pa;
        let thrust = p * radius_m;
        // At rest length, where the strain is 0.
        let spread = 1.0 + thrust * (halves[0].hoop[0] + halves[1].hoop[0]);
        let radius = radius_m * spread.sqrt();
        let bends = 1.0 - (FRAC_PI_4 * ends * radius).min(MOST_IDLE);
        let per = 1.0 / bends;
        // Over the width πr₀.
        let drive = thrust * spread - p_body_pa * self.drawn_in_m;
        let (line, lever, gain) = (contraction * per, lever * radius, ends * radius * per);
        (PressurisedCell { halves, thrust, line, lever, gain, drive }, bends)
    }

    /// Potential per metre of body at a contraction of the line, and its slope.
    fn potential(&self, contraction: f64, p_act_pa: f64, p_body_pa: f64) -> (f64, f64) {
        let (held, bends) = self.held(contraction, p_act_pa, p_body_pa);
        let [d, pull, more] = held.settled();
        let ([y, free, glued], [one, other]) = (held.lengths(d), held.halves);
        let tube = one.energy(held.thrust * y, free) + other.energy(held.thrust * y, glued);
        let ends = if d > 0.0 { held.gain * held.drive * end_work(d) } else { 0.0 };
        let width = PI * self.radius_m;
        (width * bends * (tube - ends), width * (held.lever * more - pull))
    }

    /// v − v₀ and dv/dε of the tube with stiff yarns, which the term replaces.
    fn stiff(&self, contraction: f64) -> (f64, f64) {
        let area = self.volume_gain * PI * self.radius_m.powi(2);
        let ([c2, s2], length) = (self.bias, 1.0 - contraction);
        let volume = area * (1.0 - c2 * length * length) / s2 * length;
        (volume - area, area * (3.0 * c2 * length * length - 1.0) / s2)
    }
}

impl Term for Muscle {
    fn line(&self) -> LedgerLine {
        LedgerLine::new("muscle", Account::Wall)
    }

    fn add(&self, at: &Pose, force: &mut [f64]) -> f64 {
        let contraction = at.q[actuator_q::CONTRACTION];
        let (energy, slope) = self.potential(contraction, at.p_act_pa, at.p_body_pa);
        let (gained, d_volume) = self.stiff(contraction);
        force[actuator_q::CONTRACTION] -= slope + at.p_act_pa * d_volume;
        let at_rest = self.volume_gain * at.p_act_pa * PI * self.radius_m.powi(2);
        energy + at_rest + at.p_act_pa * gained
    }

    fn add_force(&self, at: &Pose, force: &mut [f64]) {
        let contraction = at.q[actuator_q::CONTRACTION];
        let (held, _) = self.held(contraction, at.p_act_pa, at.p_body_pa);
        let [_, pull, more] = held.settled();
        let slope = PI * self.radius_m * (held.lever * more - pull);
        force[actuator_q::CONTRACTION] -= slope + at.p_act_pa * self.stiff(contraction).1;
    }
}

/// Largest share of a muscle that its ends may take.
const MOST_IDLE: f64 = 0.9;
/// Range of the shortening of a flat end over r: at 1 it pushes as hard as it can.
const ENDS: [f64; 2] = [1e-4, 1.0];
/// Where it starts: an end without a pull.
const IDLE_END: f64 = SQRT_2 - 1.0;
const IDLE_PULL: [f64; 3] = [0.0, -(2.0 + SQRT_2), 13.0 + 9.0 * SQRT_2];
/// Step of that shortening whose cube is rounding.
const LAST_STEP: f64 = 3e-6;

/// `g(d) = (d³/3 + 2d − 1/d)/8 − d`: work of a flat end over P π r³.
fn end_work(d: f64) -> f64 {
    (d * d * d / 3.0 + 2.0 * d - 1.0 / d) / 8.0 - d
}

/// `g' = (d + 1/d)²/8 − 1`, its pull over P π r², and two derivatives.
#[inline]
fn end_pull(d: f64) -> [f64; 3] {
    let (square, per) = (d * d, 1.0 / (d * d));
    [0.125 * (square + per) - 0.75, 0.25 * d * (1.0 - per * per), 0.25 + 0.75 * per * per]
}

#[cfg(test)]
#[path = "muscle_tests.rs"]
mod tests;
