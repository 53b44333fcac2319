//! Export to C: a microcontroller has no solver, but tip over pressure is one smooth curve.
//!
//! Polynomials on pieces of the pressure range replace the balance of virtual work. The table states the largest difference from the
//! model, found at thousands of pressures: below a thousandth of the length L, in at most 4096 bytes of constants.
//!
//! ```text
//! 4 pieces, 1940 bytes
//! tip within 0.01 mm of the model
//! int robot_pressure(IBR_REAL y_m, IBR_REAL *p_pa);
//! ```

use ibr::models::export::{Origin, Table};
use ibr::models::{Model, Scenario, shipped};

pub(crate) fn example() -> Result<String, Box<dyn std::error::Error>> {
    let robot = Scenario::parse(shipped("epam").unwrap_or_default())?;
    let table = Table::new(&Model::new(&robot), robot.p_body_pa, [0.0, 30e3])?;
    let origin = Origin { prefix: "robot", robot: &robot.name, command: "examples/export_c.rs", history: &[] };
    let [header, _source] = table.c_files(&origin);
    let declared: Vec<&str> = header.lines().filter(|line| line.contains("robot_pressure(")).collect();
    Ok(format!(
        "{} pieces, {} bytes\ntip within {:.2} mm of the model\n{}\n",
        table.pieces(),
        table.bytes(),
        1e3 * table.bound.tip_m,
        declared.join("\n")
    ))
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    print!("{}", example()?);
    Ok(())
}
