//! Square pillow airbag: published numbers and the volume of a paper bag.
//!
//! Two square sheets sealed around and inflated. There is no exact solution: the pleats decide, and codes differ in how they
//! let them form. So the known numbers are a band, not a value.

/// The square airbag of the wrinkling literature: material and load.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Airbag {
    /// Side of the flat square \[m\].
    pub side_m: f64,
    /// Young's modulus \[Pa\].
    pub young_pa: f64,
    /// Poisson's ratio.
    pub poisson: f64,
    /// Thickness \[m\].
    pub thickness_m: f64,
    /// Gauge pressure \[Pa\].
    pub pressure_pa: f64,
}

/// Diagonal 1.2 m, E = 588 MPa, ν = 0.4, t = 0.6 mm, 5 kPa.
///
/// Repeated as an example by finite element packages ("Inflation of a Square Airbag", COMSOL application library: diagonal
/// and pressure read there, where the thickness is printed as 6 mm in one sentence).
pub const AIRBAG: Airbag =
    Airbag { side_m: 0.848_528_137_423_857, young_pa: 588e6, poisson: 0.4, thickness_m: 6e-4, pressure_pa: 5e3 };

/// Rise of the centre of one sheet above the plane of the rim \[m\], lowest and highest of the published values.
///
/// Collected second hand from membrane calculations with and without a wrinkling model; the papers were not read.
pub const AIRBAG_CENTRE_M: [f64; 2] = [0.205, 0.217];

/// Inward displacement of the middle of a side \[m\], lowest and highest of the published values; second hand likewise.
pub const AIRBAG_MID_EDGE_M: [f64; 2] = [0.11, 0.125];

/// Whether a number lies in a published band, ends included.
pub fn within(band: [f64; 2], value: f64) -> bool {
    (band[0]..=band[1]).contains(&value)
}

/// Volume of a sealed rectangular bag of stretchless film, `w³ [h/(πw) − 0.142 (1 − 10^(−h/w))]` \[m³\], short side w ≤ h.
///
/// **An empirical fit** (A. C. Robin 2004, read as quoted on Wikipedia, "Paper bag problem"). For the square bag w³·0.1905,
/// while pleated constructions reach [`super::pouch::KEPERT_VOLUME_LOW`] w³: expect a simulation above it.
pub fn paper_bag_volume_m3(side_m: f64, other_side_m: f64) -> f64 {
    let (w, h) = (side_m.min(other_side_m), side_m.max(other_side_m));
    super::pouch::robin_end_factor(h / w) * w * w * h / std::f64::consts::PI
}

/// Volume of a sealed square bag of stretchless film, lowest known value and upper value \[m³\]; see [`super::pouch`].
pub fn square_bag_volume_m3(side_m: f64) -> [f64; 2] {
    [super::pouch::KEPERT_VOLUME_LOW, super::pouch::KEPERT_VOLUME_HIGH].map(|ratio| ratio * side_m.powi(3))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn side_and_diagonal_of_the_airbag_agree() {
        assert!((AIRBAG.side_m * 2.0_f64.sqrt() - 1.2).abs() < 1e-15);
        assert!(
            within(AIRBAG_CENTRE_M, 0.205) && !within(AIRBAG_CENTRE_M, 0.204) && !within(AIRBAG_MID_EDGE_M, f64::NAN)
        );
    }

    #[test]
    fn the_band_is_deeper_than_the_round_balloon_of_the_same_inscribed_disc() {
        // Corners lift the centre above that of the disc of radius side/2, whose half thickness is 0.457 of its radius.
        let disc = 0.5 * super::super::balloon::THICKNESS_RATIO * super::super::balloon::RADIUS_RATIO * 0.5;
        assert!(AIRBAG_CENTRE_M[0] > disc * AIRBAG.side_m);
    }

    #[test]
    fn the_paper_bag_is_robins_formula_whichever_side_is_named_first() {
        let robin = 0.06_f64.powi(3) * (2.0 / std::f64::consts::PI - 0.142 * (1.0 - 10_f64.powi(-2)));
        assert!((paper_bag_volume_m3(0.06, 0.12) / robin - 1.0).abs() < 1e-14);
        assert_eq!(paper_bag_volume_m3(0.12, 0.06), paper_bag_volume_m3(0.06, 0.12));
        assert!(paper_bag_volume_m3(1.0, 1.0) < square_bag_volume_m3(1.0)[0]);
    }
}
