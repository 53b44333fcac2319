//! What every fabric answers, and the sheets whose formula the finite element kernels inline, as plain numbers.

use std::fmt::Debug;
use std::sync::Arc;

/// Largest strain each yarn family has seen (warp, fill); what a fabric with different unloading remembers.
pub type Past = [f64; 2];

/// Matrix by its rows.
pub(super) type Matrix = [[f64; 3]; 3];

#[inline(always)]
pub(super) fn matrix(of: impl Fn(usize, usize) -> f64) -> Matrix {
    std::array::from_fn(|i| std::array::from_fn(|j| of(i, j)))
}

/// The membrane law of one sheet of fabric, in warp and fill axes.
pub trait Fabric: Send + Sync + Debug {
    /// Thickness t of the unstretched fabric \[m\].
    fn thickness_m(&self) -> f64;
    /// Recoverable energy W(e) per reference area \[J/m²\].
    fn energy(&self, e: [f64; 3], past: &Past) -> f64;
    /// Second Piola–Kirchhoff tension S = ∂W/∂e \[N/m\].
    fn tension(&self, e: [f64; 3], past: &Past) -> [f64; 3];

    /// Tangent ∂S/∂e \[N/m\]; by central differences unless a law knows better.
    fn tangent(&self, e: [f64; 3], past: &Past) -> [[f64; 3]; 3] {
        const STEP: f64 = 1e-6;
        let mut columns = [[0.0; 3]; 3];
        for (k, column) in columns.iter_mut().enumerate() {
            let (mut up, mut down) = (e, e);
            up[k] += STEP;
            down[k] -= STEP;
            let (high, low) = (self.tension(up, past), self.tension(down, past));
            for i in 0..3 {
                column[i] = (high[i] - low[i]) / (2.0 * STEP);
            }
        }
        columns
    }

    /// A tangent that none exceeds, in stiffness, at strains within `reach` of `e` and on the way back from them \[N/m\]: what a
    /// time step must bear. The tangent itself unless a law stiffens in between.
    fn steepest(&self, e: [f64; 3], past: &Past, _reach: f64) -> [[f64; 3]; 3] {
        self.tangent(e, past)
    }

    /// True if [`Fabric::remember`] changes the memory: stress then depends on past strain.
    fn has_memory(&self) -> bool {
        false
    }
    /// Updates the memory after a strain was reached.
    fn remember(&self, _e: [f64; 3], _past: &mut Past) {}
    /// Energy per reference area lost for good on the way to `past` \[J/m²\].
    fn dissipated(&self, _past: &Past) -> f64 {
        0.0
    }

    /// The laws that the element kernels compile for themselves; others are called sheet by sheet.
    fn kind(&self) -> InlinedFabric<'_> {
        InlinedFabric::Other
    }
}

/// A fabric whose formula the finite element kernels inline.
#[derive(Debug, Clone, Copy)]
pub enum InlinedFabric<'a> {
    /// Incompressible neo-Hookean sheet, which carries compression too.
    NeoHookean(&'a NeoHookean),
    /// Sheet with linear stress over Green strain and three axes of symmetry.
    Orthotropic(&'a Orthotropic),
    /// Neo-Hookean and orthotropic sheets bonded to one, with the sum of their stresses.
    Mixed(&'a Mixed),
    /// Neo-Hookean sheet without compressive stress: it wrinkles where it would have some.
    WrinklingFilm(&'a WrinklingFilm),
    /// Any other law, which kernels call through [`Fabric`].
    Other,
}

/// Incompressible neo-Hookean sheet in plane stress, with one constant C₁₀.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NeoHookean {
    /// Constant C₁₀ of U = C₁₀ (Ī₁ − 3) \[Pa\], positive: a sixth of the initial modulus.
    pub c10_pa: f64,
    /// Thickness of the unstretched sheet \[m\], positive.
    pub thickness_m: f64,
}

impl NeoHookean {
    /// C₁₀ \[Pa\] and thickness \[m\], both positive.
    pub const fn new(c10_pa: f64, thickness_m: f64) -> NeoHookean {
        NeoHookean { c10_pa, thickness_m }
    }
}

/// Sheet with linear stress resultants over Green strain, along warp and fill.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Orthotropic {
    /// Stiffness A₁₁ along the warp at fixed fill \[N/m\].
    pub a11: f64,
    /// Stiffness A₂₂ along the fill at fixed warp \[N/m\].
    pub a22: f64,
    /// Coupling A₁₂ of warp and fill \[N/m\].
    pub a12: f64,
    /// Shear stiffness A₆₆ = G t between warp and fill \[N/m\].
    pub a66: f64,
    /// Thickness of the unstretched sheet \[m\].
    pub thickness_m: f64,
}

/// A film with a constant load in compression.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WrinklingFilm {
    /// The film, which carries all tension.
    pub film: NeoHookean,
    /// Load of its wrinkles N, 0 or more \[N/m\].
    pub load_n_per_m: f64,
}

/// Bonded neo-Hookean and linear plies as one formula, W = W_rubber(e) + ½ e·A e: isotropic and linear parts add up.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Mixed {
    /// All neo-Hookean plies: Σ t, and C₁₀ = Σ t C₁₀/Σ t. Thickness 0 without any.
    pub rubber: NeoHookean,
    /// A of all linear plies in the laminate's axes, symmetric \[N/m\].
    pub linear: [[f64; 3]; 3],
}

/// One sheet of a laminate and its direction there.
#[derive(Debug, Clone)]
pub struct Ply {
    /// Law of the sheet, its own thickness included.
    pub fabric: Arc<dyn Fabric>,
    /// Angle from the laminate's warp to this ply's warp \[rad\], counter-clockwise.
    pub angle_rad: f64,
}
