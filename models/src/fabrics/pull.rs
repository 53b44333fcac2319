//! A long specimen pulled at an angle to the warp, for any law: what `ibr characterize` replays its tests with.
//!
//! ```text
//! S_yy = S_xy = 0     E_xx = ½(λ² − 1)     P = λ S_xx/t          x: pull, the warp turned by ψ from it
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | S, E | second Piola–Kirchhoff tension and Green–Lagrange strain in the axes of the pull | N/m, – |
//! | λ, P | stretch along the pull, nominal stress (force over first cross-section) | –, Pa |
//!
//! Exact for edges that are free and ends that may shear: many widths long. Grips stiffen a short specimen at an angle
//! (Pagano and Halpin 1968, J. Composite Materials 2, 18), by 6 % at 45° for 250 mm by 20 mm.

use std::sync::Arc;

use super::fabric::{Fabric, Ply};
use super::laminate::Laminate;

/// A law seen along a pull at an angle to its warp.
#[derive(Debug, Clone)]
pub struct Pull {
    turned: Laminate,
    /// \[E_yy, 2E_xy\] of the last pull: the next one starts there.
    across: [f64; 2],
}

impl Pull {
    /// At an angle ψ from warp to pull \[rad\].
    ///
    /// # Errors
    /// An angle that is not finite.
    pub fn new(fabric: Arc<dyn Fabric>, angle_rad: f64) -> Result<Pull, String> {
        Ok(Pull { turned: Laminate::new(vec![Ply { fabric, angle_rad }])?, across: [0.0; 2] })
    }

    /// Nominal stress at a nominal strain \[Pa\]; none where Newton's method finds no state with free edges.
    ///
    /// ```
    /// use models::fabrics::{Orthotropic, Pull};
    /// let sheet = std::sync::Arc::new(Orthotropic::new(96.5e6, 120e6, 0.0, 1.03e6, 5e-5));
    /// let along = Pull::new(sheet, 0.0).unwrap().stress_pa(1e-6).unwrap();
    /// assert!((along / 96.5 - 1.0).abs() < 1e-5);
    /// ```
    pub fn stress_pa(&mut self, strain: f64) -> Option<f64> {
        let along = strain * (1.0 + 0.5 * strain);
        let full = |[a, b]: [f64; 2]| [along, a, b];
        for _ in 0..60 {
            let (s, k) =
                (self.turned.tension(full(self.across), &[0.0; 2]), self.turned.tangent(full(self.across), &[0.0; 2]));
            let det = k[1][1] * k[2][2] - k[1][2] * k[2][1];
            let step = [(k[2][2] * s[1] - k[1][2] * s[2]) / det, (k[1][1] * s[2] - k[2][1] * s[1]) / det];
            if !(step[0].is_finite() && step[1].is_finite()) {
                break;
            }
            self.across = [self.across[0] - step[0], self.across[1] - step[1]];
            if step[0].abs() + step[1].abs() < 1e-13 {
                let s = self.turned.tension(full(self.across), &[0.0; 2]);
                return Some((1.0 + strain) * s[0] / self.turned.thickness_m());
            }
        }
        self.across = [0.0; 2];
        None
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Curve, Woven, Yarn};
    use super::*;

    /// Work done by the pull is the energy stored, whatever the angle: ∫P dε = W/t.
    #[test]
    fn work_of_the_pull_is_the_energy_of_the_law() {
        let yarn = |rows: &[[f64; 2]]| Yarn::new(Curve::table(rows).unwrap(), None).unwrap();
        let yarns = [yarn(&[[0.0, 0.0], [0.02, 3e6], [0.1, 20e6]]), yarn(&[[0.0, 0.0], [0.03, 11e6], [0.1, 30e6]])];
        let law: Arc<dyn Fabric> = Arc::new(
            Woven::new(yarns, Curve::table(&[[0.0, 0.0], [0.05, 1e6], [1.0, 9e6]]).unwrap(), 0.1, 1e-4).unwrap(),
        );
        for degrees in [20.0, 45.0, 70.0_f64] {
            let mut pull = Pull::new(law.clone(), degrees.to_radians()).unwrap();
            let (steps, end) = (2000, 0.06);
            let stress: Vec<f64> =
                (0..=steps).map(|i| pull.stress_pa(end * f64::from(i) / f64::from(steps)).unwrap()).collect();
            let work: f64 = stress.windows(2).map(|w| 0.5 * (w[0] + w[1]) * end / f64::from(steps)).sum();
            let [a, b] = pull.across;
            let energy = pull.turned.energy([end * (1.0 + 0.5 * end), a, b], &[0.0; 2]) / 1e-4;
            assert!((work / energy - 1.0).abs() < 2e-6, "{degrees}: {work} {energy}");
        }
    }
}
