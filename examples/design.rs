//! Design: which pouches bring the tip of the ePAM to x = 310 mm, y = 110 mm?
//!
//! The search varies their width and the pressure and minimises the distance of the tip from the target, each robot solved by
//! the balance of virtual work. A target within reach is met within 1 % of the length.
//!
//! ```text
//! actuator.width_mm = 80
//! pressure_kpa = 6.948
//! reached: 2.5 mm from the target
//! ```

use ibr::ScenarioFile;
use ibr::sweep::design::{Wish, design};
use std::ops::ControlFlow::Continue;
use std::path::Path;

const WISH: &str = r#"
kind = "design"
scenario = "epam"
free = [{ key = "actuator.width_mm", from = 40, to = 80 }, { key = "pressure_kpa", from = 5, to = 30 }]
[wish]
tip_mm = [310, 110]
"#;

pub(crate) fn example() -> Result<String, Box<dyn std::error::Error>> {
    let wish = Wish::parse("wish.toml", WISH, Path::new(""), ScenarioFile::read)?;
    let found = design(&wish, &mut |_, _| Continue(()))?;
    let chosen: String = found.chosen.iter().map(|(key, value)| format!("{key} = {value}\n")).collect();
    let miss_mm = 1e3 * found.worst_m();
    let verdict = if found.reached(&wish) { "reached" } else { "not reached" };
    Ok(format!("{chosen}{verdict}: {miss_mm:.1} mm from the target\n"))
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    print!("{}", example()?);
    Ok(())
}
