//! Thin pressurised cylinder: membrane tensions, and how far a ring at its end is felt.
//!
//! ```text
//! hoop p r     axial p r/2 (closed ends)     w∞ = (p − ν N/r) r²/(E t)
//! D w'''' − N w'' + k w = p − ν N/r          k = E t/r²
//! w = w∞ [1 − e^(−ax)(cos bx + (a/b) sin bx)]     a² = √(k/4D) + N/4D     b² = √(k/4D) − N/4D     (clamped ring)
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | r, E t | radius, membrane stiffness around the tube | m, N/m |
//! | D | bending stiffness along the axis, E t³/(12(1 − ν²)) for a homogeneous wall | N m |
//! | ν | contraction around the tube per stretch along it | – |
//! | N | axial tension, p r/2 with closed ends | N/m |
//! | w | radial displacement, outward | m |
//! | x | distance from the ring | m |
//!
//! Beyond N = 2√(kD) the decay is without waves: b is imaginary, sin bx/b becomes sinh. Without tension 1/a is the usual
//! `(r² t²/(3(1 − ν²)))^¼`. Valid for small displacements, w ≪ r, a tube much longer than 1/a, axial symmetry.
//! The differential equation is the standard one (Timoshenko & Woinowsky-Krieger, Theory of Plates and Shells, ch. 15,
//! recalled) with the tension term; the solution with tension is derived here.

use super::KnownSections;

/// A cylinder clamped at a rigid ring.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ClampedCylinder {
    /// Radius r of the cylinder \[m\].
    pub radius_m: f64,
    /// Membrane stiffness E t around the tube \[N/m\].
    pub membrane_stiffness_n_per_m: f64,
    /// ν, contraction around the tube per stretch along it.
    pub poisson: f64,
    /// Bending stiffness D along the axis \[N m\].
    pub bending_stiffness_nm: f64,
    /// Axial tension N of the wall \[N/m\].
    pub axial_tension_n_per_m: f64,
}

/// Radial displacement far from the ring, `w∞ = (p − ν N/r) r²/(E t)` \[m\]; `(1 − ν/2) p r²/(E t)` with closed ends.
pub fn far_displacement_m(shell: &ClampedCylinder, pressure_pa: f64) -> f64 {
    let r = shell.radius_m;
    (pressure_pa - shell.poisson * shell.axial_tension_n_per_m / r) * r * r / shell.membrane_stiffness_n_per_m
}

/// Edge length without tension, `(4 D r²/(E t))^¼` \[m\]: `(r² t²/(3(1 − ν²)))^¼` for a homogeneous wall.
pub fn edge_length_m(shell: &ClampedCylinder) -> f64 {
    (4.0 * shell.bending_stiffness_nm * shell.radius_m.powi(2) / shell.membrane_stiffness_n_per_m).powf(0.25)
}

/// Radial displacement at a distance from the clamped ring \[m\].
pub fn displacement_m(shell: &ClampedCylinder, pressure_pa: f64, distance_m: f64) -> f64 {
    let (a, b_squared) = decay(shell);
    let [wave, sine] = decaying_waves(a, b_squared, distance_m);
    far_displacement_m(shell, pressure_pa) * (1.0 - wave - a * sine)
}

fn stiffness(shell: &ClampedCylinder) -> f64 {
    shell.membrane_stiffness_n_per_m / shell.radius_m.powi(2)
}

/// a and b² of the solution; b² may be negative.
fn decay(shell: &ClampedCylinder) -> (f64, f64) {
    let bending = (stiffness(shell) / (4.0 * shell.bending_stiffness_nm)).sqrt();
    let tension = shell.axial_tension_n_per_m / (4.0 * shell.bending_stiffness_nm);
    ((bending + tension).sqrt(), bending - tension)
}

/// a − |b| for b² < 0, as (a² − |b|²)/(a + |b|): the difference loses digits in a thin wall.
fn slow_rate(a: f64, b_squared: f64) -> f64 {
    (a * a + b_squared) / (a + (-b_squared).sqrt())
}

/// `[e^(−ax) cos bx, e^(−ax) sin bx/b]`, with cosh and sinh for b² < 0, without overflow far from the ring.
fn decaying_waves(a: f64, b_squared: f64, x: f64) -> [f64; 2] {
    let b = b_squared.abs().sqrt();
    if b * x < 1e-8 {
        return [(-a * x).exp(), x * (-a * x).exp()];
    }
    if b_squared > 0.0 {
        let fade = (-a * x).exp();
        return [fade * (b * x).cos(), fade * (b * x).sin() / b];
    }
    let (slow, fast) = ((-slow_rate(a, b_squared) * x).exp(), (-(a + b) * x).exp());
    [0.5 * (slow + fast), 0.5 * (slow - fast) / b]
}

/// See `known.txt`; R = 40 mm, t = 0.2 mm, E = 208 MPa, ν = 0.3, 2 kPa.
pub(super) fn known() -> KnownSections {
    let shell = |factor: f64| ClampedCylinder {
        radius_m: 0.04,
        membrane_stiffness_n_per_m: 208e6 * 2e-4,
        poisson: 0.3,
        bending_stiffness_nm: factor * 208e6 * 2e-4_f64.powi(3) / (12.0 * 0.91),
        axial_tension_n_per_m: 0.5 * 2e3 * 0.04,
    };
    let near = |shell: &ClampedCylinder| {
        let [a, b, c] = [1e-3, 3e-3, 1e-2].map(|distance_m| 1e6 * displacement_m(shell, 2e3, distance_m));
        [a, b, c]
    };
    let far = [1e6 * far_displacement_m(&shell(1.0), 2e3), 1e3 * edge_length_m(&shell(1.0))];
    vec![("pressurised cylinder at a clamped ring", [&far[..], &near(&shell(1.0)), &near(&shell(0.01))].concat())]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shell(factor: f64, pressure_pa: f64) -> ClampedCylinder {
        let (young, nu, t): (f64, f64, f64) = (208e6, 0.3, 2e-4);
        ClampedCylinder {
            radius_m: 0.04,
            membrane_stiffness_n_per_m: young * t,
            poisson: nu,
            bending_stiffness_nm: factor * young * t.powi(3) / (12.0 * (1.0 - nu * nu)),
            axial_tension_n_per_m: 0.5 * pressure_pa * 0.04,
        }
    }

    /// Slope dw/dx at a distance from the clamped ring: `w∞ (a² + b²) e^(−ax) sin bx/b`.
    fn slope(shell: &ClampedCylinder, pressure_pa: f64, distance_m: f64) -> f64 {
        let (a, b_squared) = decay(shell);
        far_displacement_m(shell, pressure_pa) * (a * a + b_squared) * decaying_waves(a, b_squared, distance_m)[1]
    }

    /// Length over which the slower of the two decays falls by e \[m\]; grows as `√(N/k)` in a thin wall under tension.
    fn decay_length_m(shell: &ClampedCylinder) -> f64 {
        let (a, b_squared) = decay(shell);
        if b_squared >= 0.0 { 1.0 / a } else { 1.0 / slow_rate(a, b_squared) }
    }

    #[test]
    fn displacement_solves_the_differential_equation_and_the_clamped_ring() {
        // D ×1 waves, ×0.01 does not, and the one in between has nearly equal roots.
        for factor in [1.0, 0.1104, 0.01] {
            let (p, s) = (2e3, shell(factor, 2e3));
            assert!(displacement_m(&s, p, 0.0).abs() < 1e-18 && slope(&s, p, 0.0) == 0.0);
            let h = 5e-3 * decay_length_m(&s);
            for x in [2.5 * h, 80.0 * h, 400.0 * h] {
                let w = |i: f64| displacement_m(&s, p, x + i * h);
                let second = (w(1.0) - 2.0 * w(0.0) + w(-1.0)) / (h * h);
                let fourth = (w(2.0) - 4.0 * w(1.0) + 6.0 * w(0.0) - 4.0 * w(-1.0) + w(-2.0)) / h.powi(4);
                let n = s.axial_tension_n_per_m;
                let k = s.membrane_stiffness_n_per_m / 0.0016;
                let load = p - s.poisson * n / 0.04;
                let rest = s.bending_stiffness_nm * fourth - n * second + k * w(0.0) - load;
                assert!(rest.abs() < 1e-3 * load, "{factor} {x}: {rest}");
                let difference = (w(1.0) - w(-1.0)) / (2.0 * h);
                let steepest = far_displacement_m(&s, p) / decay_length_m(&s);
                assert!((slope(&s, p, x) - difference).abs() < 1e-3 * steepest);
            }
        }
    }

    #[test]
    fn far_from_the_ring_the_closed_cylinder_widens_by_its_hoop_strain() {
        let s = shell(1.0, 2e3);
        let far = 2e3 * 0.0016 / 41.6e3 * (1.0 - 0.15);
        assert!((far_displacement_m(&s, 2e3) / far - 1.0).abs() < 1e-14);
        assert!((displacement_m(&s, 2e3, 40.0 * decay_length_m(&s)) / far - 1.0).abs() < 1e-14);
    }

    #[test]
    fn edge_length_is_the_textbook_one_and_tension_stretches_it() {
        let bare = ClampedCylinder { axial_tension_n_per_m: 0.0, ..shell(1.0, 0.0) };
        let textbook = (0.04_f64.powi(2) * 2e-4_f64.powi(2) / (3.0 * (1.0 - 0.09))).powf(0.25);
        assert!((edge_length_m(&bare) / textbook - 1.0).abs() < 1e-14);
        assert!((decay_length_m(&bare) / textbook - 1.0).abs() < 1e-14);
        let membrane = shell(1e-8, 2e3);
        let string = (40.0 * 0.0016 / 41.6e3_f64).sqrt();
        assert!((decay_length_m(&membrane) / string - 1.0).abs() < 1e-3);
    }
}
