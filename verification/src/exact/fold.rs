//! A pulled sheet that leaves a clamp at an angle: the elastica's fold.
//!
//! ½ D φ'² + T cos φ is constant along a strip of stiffness D under the pull T, φ the angle from the pull. Far away φ = φ' = 0, so
//!
//! ```text
//! soft sheet   M(φ) = √(2 D T (1 − cos φ)) = 2 √(D T) sin ½φ
//! stiff end    M_c² = M(φ_e)² + 2 D₂ T (cos φ_e − cos θ)                b = ∫ D₂ dφ/√(M(φ_e)² + 2 D₂ T (cos φ_e − cos φ)) over φ_e … θ
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | D, D₂ | bending stiffness of the sheet and of a strip of length b between it and the clamp | N m |
//! | T | pull per width | N/m |
//! | θ, φ_e | angle of the clamp from the pull; angle where sheet and strip meet | rad |
//!
//! Valid without stretch, for sheets much longer than √(D/T). Derivation standard: Love, A treatise on the mathematical theory of
//! elasticity, §262 (recalled); the stiff end derived here.

use super::KnownSections;
use super::solve::{falling_root, integral};

/// Moment per width at a clamp at `angle` from the pull, 2 √(D T) sin ½θ \[N\].
pub fn moment_n(stiffness_nm: f64, pull_n_m: f64, angle: f64) -> f64 {
    2.0 * (stiffness_nm * pull_n_m).sqrt() * (0.5 * angle).sin()
}

/// Moments per width at the clamp of a strip of stiffness `stiff_nm` and length `length_m`, and where a soft sheet goes on from it \[N\].
pub fn stiffened_moments_n(soft_nm: f64, stiff_nm: f64, length_m: f64, pull_n_m: f64, angle: f64) -> [f64; 2] {
    let square = |meet: f64, phi: f64| {
        moment_n(soft_nm, pull_n_m, meet).powi(2) + 2.0 * stiff_nm * pull_n_m * (meet.cos() - phi.cos())
    };
    let reach = |meet: f64| integral(|phi| stiff_nm / square(meet, phi).sqrt(), meet, angle, 40);
    // The nearer the angle where they meet is to the clamp's, the shorter the strip.
    let meet = falling_root(|meet| reach(meet) - length_m, 0.0, angle);
    [square(meet, angle).sqrt(), moment_n(soft_nm, pull_n_m, meet)]
}

pub(super) fn known() -> KnownSections {
    let [half, one, more] = [0.5, 1.0, 1.5].map(|angle| stiffened_moments_n(1.0, 60.0, 7.5, 1.0, angle));
    vec![("fold of a pulled sheet", vec![moment_n(1.0, 1.0, 1.0), half[0], one[0], more[0], one[1]])]
}
