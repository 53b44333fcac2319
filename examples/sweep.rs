//! A sweep: how pouch width and pressure bend the ePAM.
//!
//! The pull of a pouch is P W L cosθ/θ, in proportion to its width W; the body resists with about π p_b R³, which does not depend on
//! W. So a wider pouch bends more, and most where the pressure is low. Every value of a key times every value of the others is a
//! case; a folder keeps what is computed, so the same call again computes nothing.
//!
//! ```text
//! 40 mm, 10 kPa: tip at 41.2 mm
//! 40 mm, 30 kPa: tip at 78.4 mm
//! 60 mm, 10 kPa: tip at 90.6 mm
//! 60 mm, 30 kPa: tip at 131.6 mm
//! ```

use ibr::data::table::Column;
use ibr::sweep::{Settings, Shard, Study, collect, run};
use std::ops::ControlFlow::Continue;
use std::path::Path;

const STUDY: &str = r#"
kind = "sweep"
scenario = "epam"
outputs = ["tip"]
vary = [{ key = "actuator.width_mm", values = [40, 60] }, { key = "pressure_kpa", values = [10, 30] }]
"#;

pub(crate) fn example() -> Result<String, Box<dyn std::error::Error>> {
    let study = Study::parse("study.toml", STUDY, Path::new(""), ibr::studies::scenario)?;
    let folder = std::env::temp_dir().join(format!("ibr-sweep-{}", std::process::id()));
    let settings = Settings {
        folder: folder.clone(),
        shard: Shard::WHOLE,
        keep_runs: false,
        threads: 1,
        maker: Default::default(),
    };
    run(&study, &settings, &mut |_, _| Continue(()))?;
    let table = collect(&study, &folder, false)?;
    std::fs::remove_dir_all(&folder)?;
    let column = |name: &str| match table.columns.iter().find(|column| column.0 == name) {
        Some((_, Column::F64(values))) => values.clone(),
        _ => Vec::new(),
    };
    let cases = column("actuator.width_mm").into_iter().zip(column("pressure_kpa")).zip(column("tip_y_mm"));
    Ok(cases.map(|((width, kpa), tip)| format!("{width} mm, {kpa} kPa: tip at {tip:.1} mm\n")).collect())
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    print!("{}", example()?);
    Ok(())
}
