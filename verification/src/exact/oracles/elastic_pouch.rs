//! Oracles of the pouch with film that stretches: film tension = pressure × radius, solved with 30 digits.
//! L0 = W = 60 mm, t = 0.05 mm, E = 208 MPa; ν = 0.3 for the linear film.

use std::f64::consts::FRAC_PI_2;

use super::super::elastic_pouch::{Film, contraction, force_n, free_contraction, stretch};
use super::super::pouch::Pouch;
use super::{OracleRow, section};

const POUCH: Pouch = Pouch { length_m: 0.06, width_m: 0.06 };

/// Rows of [`super::super::elastic_pouch`].
pub fn rows() -> Vec<OracleRow> {
    let (linear, neo) = (Film::Linear(10.4e3 / 0.91), Film::NeoHookean(10.4e3 / 6.0));
    let open = Film::NeoHookeanFreeWidth(10.4e3 / 6.0);
    section(
        "wide pouch of film that stretches",
        [
            ("λ, linear, free, 30 kPa", "1.04893642045", stretch(&POUCH, linear, FRAC_PI_2, 30e3)),
            ("ε, linear, free, 30 kPa", "0.332226334785", free_contraction(&POUCH, linear, 30e3)),
            ("ε, linear, free, 90 kPa", "0.273917680475", free_contraction(&POUCH, linear, 90e3)),
            ("ε, linear, θ = 1, 30 kPa", "0.0946851477792", contraction(&POUCH, linear, 1.0, 30e3)),
            ("F, linear, θ = 1, 30 kPa [N]", "62.7799660243", force_n(&POUCH, linear, 1.0, 30e3)),
            ("λ, neo-Hookean, free, 30 kPa", "1.04619902802", stretch(&POUCH, neo, FRAC_PI_2, 30e3)),
            ("ε, neo-Hookean, free, 30 kPa", "0.33396901293", free_contraction(&POUCH, neo, 30e3)),
            ("ε, neo-Hookean, free, 90 kPa", "0.2444979837", free_contraction(&POUCH, neo, 90e3)),
            ("F, neo-Hookean, θ = 1, 30 kPa [N]", "62.9066024785", force_n(&POUCH, neo, 1.0, 30e3)),
            ("ε, neo-Hookean, open sides, free, 30 kPa", "0.32514414289", free_contraction(&POUCH, open, 30e3)),
            ("ε, neo-Hookean, open sides, free, 90 kPa", "0.223485540841", free_contraction(&POUCH, open, 90e3)),
            ("F, neo-Hookean, open sides, θ = 1, 30 kPa [N]", "61.1859654343", force_n(&POUCH, open, 1.0, 30e3)),
        ],
    )
}
