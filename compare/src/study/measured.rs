//! Real things beside their models: a beam, muscles, a fabric and an arm, all of them embedded.

use data::{Coupon, CouponDefaults, parse_coupons};
use models::{Loads, Model, Scenario};

use crate::CompareError;
use crate::bench::{Held, HeldRow, held};
use crate::characterize::{Reduction, characterize};
use models::Known;

/// Beam, muscle, fabric, arm.
///
/// # Errors
/// Damaged embedded data or a model without equilibrium.
pub fn measured_things() -> Result<Vec<Held>, CompareError> {
    let bench = |set: &str, calibrate| -> Result<Option<Held>, CompareError> {
        let Some(bench) = data::bench::bench(set)? else { return Ok(None) };
        let scenario = bench.scenario.as_deref().and_then(|text| Scenario::parse(text).ok());
        held(&bench, scenario.as_ref(), calibrate).map(Some)
    };
    let all = [bench("breukels-2011-beams", true)?, bench("festo-bolen-2026", false)?, Some(fabric()?), arm()?];
    Ok(all.into_iter().flatten().collect())
}

/// The nylon: the law of 0°, 45° and 90° at the end of every test.
fn fabric() -> Result<Held, CompareError> {
    const SET: &str = "nylon-offaxis";
    let mut coupons: Vec<Coupon> = Vec::new();
    for degrees in [0, 15, 30, 45, 60, 75, 90] {
        let file = format!("coupon_{degrees:02}.csv");
        let text = data::set_file(SET, &file)?;
        coupons.extend(parse_coupons(&file, &mut text.as_bytes(), 0, &CouponDefaults::default(), &mut |_, _| ())?);
    }
    let settings = Reduction { name: "nylon".into(), ..Reduction::default() };
    let found = characterize(&coupons, &settings)?;
    let law = found.replays.iter().filter(|r| r.law == settings.name);
    let rows = law.filter_map(|r| {
        let (test, end) = (&found.specimens[r.specimen], r.rows.last()?);
        let at = format!("{}°, {:.1} % strain", test.direction.degrees(), 100.0 * end[0]);
        let (measured, model) = (1e-6 * end[1] / (1.0 + r.at_end), Some(1e-6 * end[1]));
        Some(HeldRow { at, measured, model, half: None, fitted: r.used })
    });
    Ok(Held {
        title: format!("Coated nylon, the law of its tests at 0°, 45° and 90° against {SET}"),
        quantity: "stress MPa".into(),
        known: Known::Calibrated,
        rows: rows.collect(),
        notes: vec!["the other angles had no part in the law".into()],
    })
}

/// The arm: tip heights of its own scenario.
fn arm() -> Result<Option<Held>, CompareError> {
    const SET: &str = "jitosho-2023-arm";
    let Ok(scenario) = Scenario::parse(data::set_file(SET, "scenario.toml")?) else { return Ok(None) };
    let (dataset, _) = data::load(SET, &mut |_, _| {})?;
    let model = Model::new(&scenario);
    let mut out = model.prediction();
    let (markers, samples) = (
        dataset.markers.len(),
        dataset.coordinates_m.len() / (dataset.axes * dataset.markers.len() * dataset.holds.len()),
    );
    let mut rows = Vec::new();
    for (i, hold) in dataset.holds.iter().enumerate().filter(|(_, hold)| hold.p_act_pa > 0.0) {
        model.predict(&Loads::uniform(hold.p_body_pa, hold.p_act_pa), &mut out)?;
        let last = 2 * ((i + 1) * samples * markers) - 1;
        rows.push(HeldRow {
            at: format!("{:.1} kPa, body {:.1} kPa", 1e-3 * hold.p_act_pa, 1e-3 * hold.p_body_pa),
            measured: 1e3 * dataset.coordinates_m[last],
            model: out.markers.last().map(|m| 1e3 * m[1]),
            half: None,
            fitted: false,
        });
    }
    Ok(Some(Held {
        title: format!("{} against {SET}", scenario.name),
        quantity: "tip height mm".into(),
        known: Known::Assumed,
        rows,
        notes: vec!["identified by its authors; the body pressure is assumed and decides the outcome".into()],
    }))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn beam_muscle_fabric_and_arm_are_there_with_every_row() {
        let all = measured_things().unwrap();
        assert_eq!(all.iter().map(|h| h.rows.len()).collect::<Vec<_>>(), [36, 4, 7, 3]);
        // The arm's own tips, as its identified model has them.
        let tips: Vec<f64> = all[3].rows.iter().map(|r| r.measured).collect();
        assert!(tips.iter().zip([66.381, 117.062, 164.393]).all(|(a, b)| (a - b).abs() < 1e-3), "{tips:?}");
        for h in &all {
            assert!(h.rms().is_some_and(f64::is_finite), "{}", h.title);
            println!("{}: rms off {:.1} %", h.title, 100.0 * h.rms().unwrap());
        }
    }
}
