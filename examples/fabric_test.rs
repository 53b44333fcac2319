//! A tensile test of a coated weave becomes the numbers of a fabric law.
//!
//! A strip of width w, thickness t and free length l is pulled along the warp: stress σ = F/(w t), strain ε = u/l. The modulus is
//! the slope up to 1 % strain. Here the strip is a linear solid of E = 100 MPa, so the answer is known.
//!
//! ```text
//! modulus E0, pulled along warp: 100.0 MPa
//! C10, warp and fill together: 17.2 MPa
//! C10, another weight: 17.0 MPa
//! what that C10 misses along warp, rms: 0.4 %
//! strain at the largest stress, warp: 4.0 %
//! ```

use ibr::data::{CouponDefaults, parse_coupons};
use ibr::study::characterize::{FabricTests, Reduction};

const HEAD: &str =
    "# direction_deg: 0\n# width_mm: 20\n# length_mm: 250\n# thickness_mm: 0.05\ndisplacement_mm,force_n\n";
const E_PA: f64 = 100e6;

pub(crate) fn example() -> Result<String, ibr::Error> {
    let force_n = |u_mm: f64| E_PA * (u_mm / 250.0) * 20e-3 * 0.05e-3;
    let rows = (0..=100).map(|row| 0.1 * f64::from(row)).map(|u_mm| format!("{u_mm:.2},{:.5}\n", force_n(u_mm)));
    let text = format!("{HEAD}{}", rows.collect::<String>());
    let size = text.len() as u64;
    let coupons = parse_coupons("pull.csv", &mut text.as_bytes(), size, &CouponDefaults::default(), &mut |_, _| ())?;
    let found = FabricTests { coupons, ..FabricTests::default() }.reduce(&Reduction::default())?;
    let line = |n: &ibr::study::characterize::FabricNumber| format!("{}: {:.1} {}\n", n.name, n.scatter.mean, n.unit);
    Ok(found.quantities.iter().map(line).collect())
}

fn main() -> Result<(), ibr::Error> {
    print!("{}", example()?);
    Ok(())
}
