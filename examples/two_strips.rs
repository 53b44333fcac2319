//! Two strips of pouches, a quarter round the body from each other, bend the robot in space.
//!
//! Each strip bends the body towards itself, κ is a vector, and every marker moves in y (strip 0) and z (strip 1). Equal pressures
//! of equal strips bend the robot in the plane at 45°: y = z. One strip alone bends it almost in its own plane.
//!
//! ```text
//! [20.0, 0.0] kPa: outermost marker at y = 80.5, z = 6.7 mm
//! [20.0, 20.0] kPa: outermost marker at y = 70.1, z = 70.1 mm
//! [0.0, 20.0] kPa: outermost marker at y = 6.7, z = 80.5 mm
//! ```

use ibr::Predictor;

pub(crate) fn example() -> Result<String, ibr::Error> {
    let robot = Predictor::new(&ibr::studies::scenario("epam-two-strips")?.scenario);
    let mut lines = String::new();
    for given_kpa in [[20.0, 0.0], [20.0, 20.0], [0.0, 20.0]] {
        let at = robot.state(&robot.loads(None, &given_kpa.map(|kpa| 1e3 * kpa))?)?.prediction;
        let (y_m, z_m) = (at.markers[5][1], at.markers_z_m[5]);
        lines += &format!("{given_kpa:?} kPa: outermost marker at y = {:.1}, z = {:.1} mm\n", 1e3 * y_m, 1e3 * z_m);
    }
    Ok(lines)
}

fn main() -> Result<(), ibr::Error> {
    print!("{}", example()?);
    Ok(())
}
