//! A sweep as pictures: how far each key moves the tip, and a map over the two that move it most.

use super::Result;
use crate::prelude::*;
use ::sweep::influence::{Influence, SweepMap, influences, map};
use ::sweep::{Engine, Study};
use data::Table;
use report::number;

/// Pictures of a table, two for every engine and coordinate of the tip.
pub(crate) fn sweep_pictures(study: &Study, table: &Table) -> Result<Files> {
    let mut files = Files::default();
    for engine in &study.engines {
        let by = if *engine == Engine::Elements { "_fe" } else { "" };
        for (output, what) in study.heights() {
            let axis = if *output == "tip_z_mm" { "_z" } else { "" };
            let found = influences(study, table, *engine, output);
            if found.is_empty() {
                continue;
            }
            files.plot(&format!("influence{axis}{by}"), tornado(&found, *engine, what)?);
            let Some([first, second]) = found.first_chunk::<2>() else { continue };
            let drawn = map(table, *engine, output, [&second.key, &first.key]);
            let drawn = drawn.map(|map| map_of(&map, *engine, what)).transpose()?;
            drawn.into_iter().for_each(|drawn| files.plot(&format!("map{axis}{by}"), drawn));
        }
    }
    Ok(files)
}

pub(crate) fn sweep_picture_names() -> [&'static str; 8] {
    ["influence", "influence_fe", "map", "map_fe", "influence_z", "influence_z_fe", "map_z", "map_z_fe"]
}

fn tornado(found: &[Influence], engine: Engine, what: &str) -> Result<Drawn> {
    let bar = |(row, i): (usize, &Influence)| {
        let span = i.range();
        let (low, high) = (number(span[0], 0), number(span[1], 0));
        Mark::Bar(Bar { ink: Ink::Series(0), text: format!("{low} to {high}"), ..Bar::over(row, span) })
    };
    let rows = found.iter().map(|i| ChartRow::beside(&i.key)).collect();
    let title = format!("How far each key moves the tip, {}", engine.word());
    let label = format!("mean {what} [mm] over the values of the key");
    let marks = found.iter().enumerate().map(bar).collect();
    Ok(report::rows(&title, &label, rows, marks, Vec::new()).draw("influence of each key")?)
}

fn map_of(map: &SweepMap, engine: Engine, what: &str) -> Result<Drawn> {
    let finite = || map.means.iter().flatten().copied().filter(|m| m.is_finite());
    let most = finite().fold(0.0, |most: f64, m| most.max(m.abs()));
    let cells = |(r, row): (usize, &Vec<f64>)| {
        let cell = |(c, mean): (usize, &f64)| Mark::Cell([r, c], mean / most, number(*mean, 0), String::new());
        row.iter().enumerate().map(cell).collect::<Vec<_>>()
    };
    // Ranges are too wide for neighbouring columns: each column shows the start of its range.
    let start = |name: &String| name.split(" to ").next().unwrap_or_default().to_string();
    let columns = map.names[1].iter().map(|name| ChartColumn { name: start(name), ..ChartColumn::default() });
    let is_ranges = map.names[1].iter().any(|name| name.contains(" to "));
    let title = format!("{}{}, {}", what[..1].to_uppercase(), &what[1..], engine.word());
    let x_label = format!("{}{}", map.keys[1], if is_ranges { ", from" } else { "" });
    let space = Space::Grid(map.names[0].iter().map(|name| ChartRow::beside(name)).collect(), columns.collect());
    let marks = map.means.iter().enumerate().flat_map(cells).collect();
    let heat = Some((format!("mean {what} [mm]"), most));
    let mut chart = Chart::new(title, x_label, &map.keys[0]);
    (chart.space, chart.marks, chart.heat) = (space, marks, heat);
    Ok(chart.draw("map of the sweep")?)
}
