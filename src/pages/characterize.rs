//! Plots: all specimens, their mean, the fit, and where the reduction stops being valid.

use super::Result;
use crate::prelude::*;
use compare::characterize::write::{measured_toml, shear_table, yarn_table};
use compare::characterize::{BiasStrip, Characterized, OPTICAL_LIMIT_RAD, PAPER_LIMIT_RAD};
use models::fabrics::{Fabric, specimen as fit};
use report::lines;

const LIMIT: usize = 5;

/// Every plot that the specimens allow, their mean curves, and what scenarios and cases take of them.
pub(crate) fn characterized_files(found: &Characterized, fabric: Option<&str>, program: &str) -> Result<Files> {
    let mut files = Files::default();
    for (name, plot) in [("tension", tension(found)), ("bias", bias(found)), ("shear", shear(found))] {
        if let Some(plot) = plot {
            files.plot(name, lines(&plot)?);
        }
    }
    for yarn in &found.yarns {
        files.csv(&format!("mean_{}", yarn.direction.word()), &yarn_table(yarn))?;
    }
    if let Some(shear) = &found.shear {
        files.csv("mean_shear", &shear_table(shear, found.thickness_m))?;
    }
    let texts = [("fabric.toml", fabric.map(String::from)), ("measured.toml", measured_toml(found, program))];
    texts.into_iter().filter_map(|(name, text)| Some((name, text?))).for_each(|(name, text)| files.text(name, text));
    Ok(files)
}

fn tension(found: &Characterized) -> Option<Lines> {
    let mut series = Vec::new();
    for (k, yarn) in found.yarns.iter().enumerate() {
        let word = yarn.direction.word();
        let all = found.of(yarn.direction).map(|s| scaled(&s.stress, [100.0, 1e-6]));
        series.push(specimens(&format!("{word}, {}", count(found.of(yarn.direction).count())), all, 2 * k));
        let spread = if found.of(yarn.direction).count() > 1 { " ± sd" } else { "" };
        let mean =
            LineSeries::new(format!("{word}, mean{spread}"), LineStyle::Points, scaled(&yarn.rows, [100.0, 1e-6]));
        let sd = yarn.sd_pa.iter().map(|s| s.map_or(0.0, |s| 1e-6 * s)).collect();
        series.push(mean.coloured(2 * k).with_errors(sd));
    }
    let reach = found.yarns.iter().filter_map(|y| y.rows.last()).map(|row| row[0]).fold(0.0, f64::max);
    let c10 = found.quantity("c10").map(|q| q.scatter.mean)?;
    let law = (0..=60).map(|i| reach * f64::from(i) / 60.0).map(|e| [100.0 * e, fit::neo_hookean_pa(c10, e)]);
    let name = format!("neo-Hookean, C10 = {c10:.1} MPa");
    series.push(LineSeries::new(name, LineStyle::Dashed, law.collect()).coloured(1));
    Some(Lines::new("Pulled along the yarns", "nominal strain [%]", "nominal stress [MPa]", series))
}

/// The 45° test as it was made: force over strain, and the force that the mean shear curve gives back.
fn bias(found: &Characterized) -> Option<Lines> {
    let shear = found.shear.as_ref()?;
    let first = found.strips().next()?.1.size;
    let same = |s: &BiasStrip| (s.size.length_m - first.length_m).abs() + (s.size.width_m - first.width_m).abs() < 1e-6;
    let alike: Vec<_> = found.strips().filter(|(_, strip)| same(strip)).collect();
    let all = alike.iter().map(|(_, s)| scaled(&s.pulled, [100.0 / first.length_m, 1.0]));
    let mut series = vec![specimens(&count(alike.len()), all, 0)];
    let strain = |angle: f64| 100.0 * first.displacement_m(angle) / first.length_m;
    let yarns = found.yarns_alone();
    let yarns = yarns.as_ref().map(|y| y as &dyn Fabric);
    let force = |row: &[f64; 2]| {
        let [d, f] = first.pulled(row[0], |x| fit::at(&shear.rows, x), yarns);
        [100.0 * d / first.length_m, f]
    };
    let law = shear.rows.iter().map(force).collect();
    series.push(LineSeries::new("from the mean shear curve", LineStyle::Points, law).coloured(1));
    let top = highest(&series);
    let limit = strain(PAPER_LIMIT_RAD);
    series.push(upright(&format!("validity limit: {limit:.0} % here is 36°"), limit, top, LIMIT));
    let title = format!("Bias extension, {:.0} mm by {:.0} mm", 1e3 * first.length_m, 1e3 * first.width_m);
    Some(Lines::new(title, "displacement over free length [%]", "force [N]", series))
}

/// Shear force over shear angle, with the angles at which it stops being true.
fn shear(found: &Characterized) -> Option<Lines> {
    let shear = found.shear.as_ref()?;
    let degrees = 180.0 / std::f64::consts::PI;
    let all = found.strips().map(|(_, s)| scaled(&s.shear, [degrees, 1.0]));
    let mut series = vec![specimens(&count(found.strips().count()), all, 0)];
    let name = if found.strips().count() > 1 { "mean ± sd" } else { "rows of the table" };
    let mean = LineSeries::new(name, LineStyle::Points, scaled(&shear.rows, [degrees, 1.0])).coloured(1);
    series.push(mean.with_errors(shear.sd_n_per_m.iter().map(|s| s.unwrap_or(0.0)).collect()));
    let top = highest(&series);
    let last = shear.rows.last().map_or(0.0, |row| row[0]);
    for (name, angle) in [
        ("30°: optical angles agree within 5°", OPTICAL_LIMIT_RAD),
        ("36°: validity limit (24 % of the paper)", PAPER_LIMIT_RAD),
    ] {
        let near = angle < 1.3 * last;
        let colour = if angle == PAPER_LIMIT_RAD { LIMIT } else { 4 };
        series.extend(near.then(|| upright(name, angle * degrees, top, colour)));
    }
    if let Some(locking) = found.quantity("locking") {
        let at = locking.scatter.mean;
        series.push(upright(&format!("locking at {at:.0}°"), at, top, 3));
    }
    Some(Lines::new("Shear from bias extension", "shear angle [°]", "shear force per length [N/m]", series))
}

fn count(n: usize) -> String {
    if n == 1 { "1 specimen".into() } else { format!("{n} specimens") }
}

fn scaled(rows: &[[f64; 2]], by: [f64; 2]) -> Vec<[f64; 2]> {
    rows.iter().map(|r| [r[0] * by[0], r[1] * by[1]]).collect()
}

/// All curves as one series: a point that is not finite lifts the pen.
fn specimens(name: &str, curves: impl Iterator<Item = Vec<[f64; 2]>>, colour: usize) -> LineSeries {
    let points = curves.flat_map(|curve| curve.into_iter().chain([[f64::NAN; 2]])).collect();
    LineSeries::new(name, LineStyle::Line, points).coloured(colour)
}

fn highest(series: &[LineSeries]) -> f64 {
    series.iter().flat_map(|s| &s.points).map(|p| p[1]).filter(|y| y.is_finite()).fold(0.0, f64::max)
}

fn upright(name: &str, x: f64, top: f64, colour: usize) -> LineSeries {
    LineSeries::new(name, LineStyle::Dashed, vec![[x, 0.0], [x, top]]).coloured(colour)
}

#[cfg(test)]
mod tests {
    use super::*;
    use compare::characterize::{Reduction, characterize, example::example};
    use data::{CouponDefaults, parse_coupons};

    #[test]
    fn tests_in_three_directions_have_three_pictures() {
        let read = |text: &str| {
            parse_coupons("a.csv", &mut text.as_bytes(), 0, &CouponDefaults::default(), &mut |_, _| ()).unwrap()
        };
        let coupons: Vec<_> = example(1).iter().flat_map(|(_, text)| read(text)).collect();
        let found = characterize(&coupons, &Reduction::default()).unwrap();
        let made = characterized_files(&found, None, "ibr").unwrap().files;
        let pictures = made.iter().filter_map(|(name, _)| name.strip_suffix(".svg"));
        assert!(pictures.eq(["tension", "bias", "shear"]));
    }
}
