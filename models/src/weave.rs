//! What several effects together make of a fabric muscle, before its cell is put together ([`crate::muscle`]).

/// What effects make of a muscle; nothing of it in the bare model.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Weave {
    /// Compliance c of its yarns \[m/N\].
    pub compliance_m_per_n: f64,
    /// E t of the wall to which one half is glued \[N/m\]; 0: it is not.
    pub wall_n_per_m: f64,
    /// Number n of ends that are sealed flat, 0 to 2.
    pub flat_ends: f64,
    /// Area ΔA that the body's section loses to the muscle \[m²\].
    pub drawn_in_m2: f64,
    /// Shear stiffness G t of its fabric \[N/m\], where the cell takes it over from a separate term.
    pub shear_n_per_m: f64,
}

impl Weave {
    pub(crate) fn is_cell(&self) -> bool {
        [self.compliance_m_per_n, self.wall_n_per_m, self.flat_ends] != [0.0; 3]
    }
}
