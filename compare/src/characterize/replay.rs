//! Every test by the laws that `fabric.toml` holds: what comes back is what a user of the law will get.
//!
//! A bias extension whose size is known is replayed by its zones ([`models::fabrics::BiasExtension`]), any other test as a long
//! specimen with free edges ([`Pull`]). The laws are read from the text that is written, digits and all.

use super::result::{BiasStrip, Characterized, Replay, Specimen};
use super::write::fabric_toml;
use super::{PAPER_LIMIT_RAD, Reduction};
use models::fabrics::{self, BiasExtension, Fabric, Pull, Recipe, specimen as fit};
use std::sync::Arc;

/// Places of a replay: a mean curve has fewer rows.
const PLACES: usize = 48;

pub(super) fn replays(found: &Characterized, settings: &Reduction) -> Vec<Replay> {
    let mut all = Vec::new();
    for (law, fabric) in laws(found, settings) {
        let tests = found.specimens.iter().filter(|s| s.stress.len() > 1);
        all.extend(tests.filter_map(|test| replayed(test, &law, &fabric)));
    }
    all
}

pub(super) fn laws(found: &Characterized, settings: &Reduction) -> Vec<(String, Arc<dyn Fabric>)> {
    let text = fabric_toml(found, settings, "").unwrap_or_default();
    let table: toml::Table = text.parse().unwrap_or_default();
    let fabrics = table.get("fabric").and_then(toml::Value::as_table).into_iter().flatten();
    let fabric = |(name, law): (&String, &toml::Value)| Some((name.clone(), make(law.as_table()?)?));
    let mut made: Vec<(String, Arc<dyn Fabric>)> = fabrics.filter_map(fabric).collect();
    made.sort_by_key(|(name, _)| if name.ends_with("-film") { 2 } else { u8::from(name.ends_with("-linear")) });
    made
}

fn make(table: &toml::Table) -> Option<Arc<dyn Fabric>> {
    let number = |v: &toml::Value| v.as_float().or(v.as_integer().map(|i| i as f64));
    let mut recipe = Recipe::default();
    for (key, value) in table {
        if let Some(rows) = value.as_array() {
            let row = |r: &toml::Value| Some([number(r.get(0)?)?, number(r.get(1)?)?]);
            let rows = rows.iter().filter_map(row).collect();
            recipe.curves.insert(key.clone(), rows);
        } else if let Some(value) = number(value) {
            recipe.numbers.insert(key.clone(), value);
        }
    }
    (fabrics::by_name(table.get("law")?.as_str()?)?.make)(&recipe).ok()
}

fn replayed(test: &Specimen, law: &str, fabric: &Arc<dyn Fabric>) -> Option<Replay> {
    let end = test.stress.last()?[0];
    let rows = match (&test.strip, test.thickness_m) {
        (Some(strip), Some(thickness_m)) => zones(strip, thickness_m, end, fabric)?,
        _ => free(test, end, fabric)?,
    };
    let [x, y] = *rows.last()?;
    let largest = test.stress.iter().fold(f64::MIN_POSITIVE, |most, row| most.max(row[1]));
    let square = |[x, y]: &[f64; 2]| (y - fit::at(&test.stress, *x)).powi(2);
    let squares: f64 = rows.iter().map(square).sum();
    let at_end = y / fit::at(&test.stress, x) - 1.0;
    let rms = (squares / rows.len() as f64).sqrt() / largest;
    let used = test.direction.along_yarn() || test.direction == data::Direction::Bias;
    let (specimen, direction_deg) = (test.name.clone(), test.direction.degrees());
    Some(Replay { law: law.to_string(), specimen, used, direction_deg, at_end, rms, rows })
}

fn free(test: &Specimen, end: f64, fabric: &Arc<dyn Fabric>) -> Option<Vec<[f64; 2]>> {
    let mut pull = Pull::new(fabric.clone(), test.direction.degrees().to_radians()).ok()?;
    let mut row = |strain: f64| Some([strain, pull.stress_pa(strain)?]);
    (0..=PLACES).map(|i| row(end * i as f64 / PLACES as f64)).collect()
}

/// By shear angle, as far as the test went and the reduction holds: F_sh is the law's S₁₂ where its yarns have not stretched.
fn zones(strip: &BiasStrip, thickness_m: f64, end: f64, fabric: &Arc<dyn Fabric>) -> Option<Vec<[f64; 2]>> {
    let size: &BiasExtension = &strip.size;
    let shear = |angle: f64| fabric.tension([0.0, 0.0, angle.sin()], &[0.0; 2])[2];
    let last = size.angle(end * size.length_m).map_or(PAPER_LIMIT_RAD, |angle| angle.min(PAPER_LIMIT_RAD));
    let row = |i: usize| {
        let [d, f] = size.pulled(last * i as f64 / PLACES as f64, shear, Some(&**fabric));
        [d / size.length_m, f / (size.width_m * thickness_m)]
    };
    let rows: Vec<[f64; 2]> =
        (0..=PLACES).map(row).take_while(|[x, y]| x.is_finite() && y.is_finite() && *x <= end).collect();
    (rows.len() > 1).then_some(rows)
}
