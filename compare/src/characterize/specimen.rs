//! One specimen: stress over strain, modulus, C₁₀, and the shear curve of a bias extension.

use super::Reduction;
use super::result::{BiasStrip, Specimen};
use super::warn::{self, who};
use crate::policy;
use data::{Coupon, DataError, Direction, Pulled};
use models::fabrics::{BiasExtension, Fabric, specimen as fit};

/// Most rows that go into a reduction: far finer than any law's table, and the noise is averaged.
const MOST_ROWS: usize = 400;

/// Reduces one specimen, but for the shear of a bias test; adds to `warnings` what a user should look at.
pub(super) fn reduce(
    coupon: &Coupon,
    slack: f64,
    settings: &Reduction,
    warnings: &mut Vec<String>,
) -> Result<Specimen, DataError> {
    let along = coupon.direction.along_yarn();
    let whole = stresses(coupon)?;
    let mut used = up_to_peak(whole.as_deref().unwrap_or(coupon.pulled.rows()));
    let (least, column) = (policy::FEWEST_ROWS, &coupon.columns[1]);
    if used.len() < least {
        let message = format!("{column} is largest in row {} of the specimen", used.len());
        let help = format!("give at least {least} rows of loading, tension as a positive {column}");
        return Err(fault(coupon, message, help));
    }
    warn::slips(coupon, &used, warnings);
    let up_to = settings.modulus_strain * if along { 1.0 } else { 2.0 };
    let poisson = poisson(coupon, whole.as_deref().unwrap_or_default(), up_to);
    used = fit::thinned(&used, MOST_ROWS);
    let stress = if whole.is_some() { used } else { Vec::new() };
    let start = small(&stress, up_to);
    // Further than asked for if there are too few rows.
    let (modulus_pa, modulus_strain) = (fit::slope(start), start.last().map_or(up_to, |row| row[0]));
    if let Some(modulus_pa) = modulus_pa.filter(|_| !settings.any_modulus) {
        plausible(coupon, modulus_pa)?;
    }
    warn::stiffens(coupon, &stress, modulus_pa.map(|modulus_pa| [modulus_strain, modulus_pa]), warnings);
    let c10_pa = |rows: &[[f64; 2]]| Some([fit::c10_pa(rows)?, fit::c10_by_share_pa(rows)?]);
    Ok(Specimen {
        name: coupon.specimen.clone(),
        file: coupon.file.clone(),
        direction: coupon.direction,
        c10_pa: along.then(|| c10_pa(&stress)).flatten(),
        slack,
        poisson,
        strip: None,
        thickness_m: coupon.thickness_m,
        stress,
        modulus_pa,
        modulus_strain,
    })
}

/// The coupon from where it is taut, and the strain before.
pub(super) fn taut(coupon: &Coupon, settings: &Reduction) -> (Coupon, f64) {
    let scale = match &coupon.pulled {
        Pulled::Stress(_) => 1.0,
        Pulled::Force(_) => coupon.length_m.unwrap_or(f64::NAN),
    };
    let mut coupon = coupon.clone();
    let Some(slack) = fit::slack(coupon.pulled.rows(), settings.modulus_strain * scale) else { return (coupon, 0.0) };
    let rows = coupon.pulled.rows_mut();
    let behind = rows[slack.from..].iter().map(|[x, y]| [x - slack.at, *y]);
    *rows = [[0.0, 0.0]].into_iter().chain(behind).collect();
    if coupon.loaded_width_m.len() > slack.from {
        // The width of the taut specimen at no load is the first that was measured.
        coupon.loaded_width_m.drain(1..slack.from);
    }
    (coupon, slack.at / scale)
}

/// Rows up to some x, and as many more as a slope needs.
fn small(rows: &[[f64; 2]], up_to: f64) -> &[[f64; 2]] {
    let within = rows.partition_point(|row| row[0] <= up_to);
    &rows[..within.max(policy::FEWEST_ROWS.min(rows.len()))]
}

/// −slope of the strain across over the strain along.
fn poisson(coupon: &Coupon, stress: &[[f64; 2]], up_to: f64) -> Option<f64> {
    let first = *coupon.loaded_width_m.first()?;
    let rows = stress.iter().zip(&coupon.loaded_width_m).map(|(r, w)| [r[0], w / first - 1.0]);
    Some(-fit::slope(small(&rows.collect::<Vec<_>>(), up_to))?)
}

pub(super) fn fault(coupon: &Coupon, message: String, help: impl Into<String>) -> DataError {
    DataError::of(&coupon.file, format!("{}: {message}", who(coupon)), help).at_line(coupon.line)
}

/// Nominal strain and stress; none for a bias test without thickness.
fn stresses(coupon: &Coupon) -> Result<Option<Vec<[f64; 2]>>, DataError> {
    let Pulled::Force(rows) = &coupon.pulled else { return Ok(Some(coupon.pulled.rows().to_vec())) };
    let Coupon { length_m: length, width_m: width, thickness_m: thickness, .. } = *coupon;
    let sizes = [("length", length, 250.0), ("width", width, 20.0), ("thickness", thickness, 0.05)];
    let is_needed = |name: &str| coupon.direction != Direction::Bias || name != "thickness";
    let missing = sizes.iter().find(|(name, size, _)| size.is_none() && is_needed(name));
    if let Some((name, _, typical)) = missing {
        let free = if *name == "length" { " (free, between the grips)" } else { "" };
        let help = format!("write # {name}_mm: {typical} above the header, or --{name} {typical}mm for all files");
        let message = format!("force and displacement need the {name}{free}, which is missing");
        return Err(fault(coupon, message, help));
    }
    let farthest = rows.last().map_or(0.0, |row| row[0]);
    if let Some(length) = length.filter(|length| farthest > 3.0 * length) {
        let (far, free) = (1e3 * farthest, 1e3 * length);
        let message = format!("a displacement of {far:.3} mm on a free length of {free:.3} mm");
        let help = format!("check the unit of {} and of the length", coupon.columns[0]);
        return Err(fault(coupon, message, help));
    }
    let (Some(length), Some(area)) = (length, width.zip(thickness).map(|(w, t)| w * t)) else { return Ok(None) };
    Ok(Some(rows.iter().map(|[d, f]| [d / length, f / area]).collect()))
}

/// Until the specimen breaks: rows up to the largest y.
fn up_to_peak(rows: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let peak = (0..rows.len()).max_by(|a, b| rows[*a][1].total_cmp(&rows[*b][1])).unwrap_or(0);
    rows[..=peak].to_vec()
}

/// The bias extension of a coupon pulled at 45° whose sizes are known; the stretch of `yarns` is taken out.
pub(super) fn strip(
    coupon: &Coupon,
    yarns: Option<&dyn Fabric>,
    settings: &Reduction,
    warnings: &mut Vec<String>,
) -> Result<Option<BiasStrip>, DataError> {
    if coupon.direction != Direction::Bias {
        return Ok(None);
    }
    let (Some(length_m), Some(width_m)) = (coupon.length_m, coupon.width_m) else { return Ok(None) };
    if length_m < 2.0 * width_m {
        let (h, w) = (1e3 * length_m, 1e3 * width_m);
        let message = format!(
            "bias extension needs a free length of at least twice the width, H ≥ 2W; here H = {h:.3} mm and W = {w:.3} mm"
        );
        let help = format!("cut the next one {:.0} mm long or narrower; check length_mm and width_mm", 2e3 * width_m);
        return Err(fault(coupon, message, help));
    }
    let rows: Vec<[f64; 2]> = match (&coupon.pulled, coupon.thickness_m) {
        (Pulled::Force(rows), _) => rows.clone(),
        (Pulled::Stress(rows), Some(t)) => rows.iter().map(|[e, s]| [e * length_m, s * width_m * t]).collect(),
        (Pulled::Stress(_), None) => return Ok(None),
    };
    let size = BiasExtension { length_m, width_m, thickness_m: coupon.thickness_m.unwrap_or(1.0) };
    let pulled = fit::thinned(&sheared(coupon, &size, up_to_peak(&rows), warnings), MOST_ROWS);
    let refused = |message| fault(coupon, message, "check length_mm and width_mm");
    let shear = size.shear_force(&pulled, yarns).map_err(refused)?;
    // Every row of the reduction rests on those before it alone.
    let start = small(&pulled, 2.0 * settings.modulus_strain * length_m);
    let start = size.shear_force(start, yarns).map_err(refused)?;
    let slope_n_per_m = fit::slope(&start);
    let locking = fit::locking(&shear);
    Ok(Some(BiasStrip { size, pulled, shear, slope_n_per_m, locking }))
}

/// Rows up to the angle beyond which yarns slip.
fn sheared(
    coupon: &Coupon,
    size: &BiasExtension,
    mut rows: Vec<[f64; 2]>,
    warnings: &mut Vec<String>,
) -> Vec<[f64; 2]> {
    let last_m = size.displacement_m(policy::SURELY_SLIP_RAD);
    let kept = rows.partition_point(|row| row[0] <= last_m);
    if kept < rows.len() {
        let (who, more, last_mm) = (who(coupon), rows.len() - kept, 1e3 * last_m);
        let most = policy::SURELY_SLIP_RAD.to_degrees();
        warnings.push(format!(
            "{who}: {more} rows beyond {last_mm:.1} mm left out: the shear angle would be above {most:.0}°, where yarns slip"
        ));
        rows.truncate(kept);
    }
    rows
}

/// What may be written for what: unit of the column, its size \[Pa\].
const STRESSES: [(&str, f64); 3] = [("Pa", 1.0), ("kPa", 1e3), ("MPa", 1e6)];

/// Refuses a modulus far from any fabric, and names the unit that would make sense of it.
fn plausible(coupon: &Coupon, modulus_pa: f64) -> Result<(), DataError> {
    let range = match coupon.direction {
        Direction::Warp | Direction::Fill => policy::ALONG_PA,
        Direction::Bias => policy::BIAS_PA,
        Direction::Between(_) => [policy::BIAS_PA[0], policy::ALONG_PA[1]],
    };
    let fits = |pa: f64| (range[0]..=range[1]).contains(&pa);
    if fits(modulus_pa) {
        return Ok(());
    }
    let (mpa, [low, high]) = (short(modulus_pa * 1e-6), range.map(|pa| pa * 1e-6));
    let message = format!("its modulus would be {mpa} MPa; fabrics pulled in this direction have {low} to {high} MPa");
    let [x, y] = &coupon.columns;
    let thickness = coupon.thickness_m.map_or("–".into(), |t| short(1e3 * t));
    let advice = match coupon.pulled {
        Pulled::Stress(_) => stress_advice(coupon, modulus_pa, fits),
        Pulled::Force(_) => format!("check the units of {y}, {x}, and width, length and thickness ({thickness} mm)"),
    };
    let help = format!("{advice}; if the number is right, add --any-modulus");
    Err(fault(coupon, message, help))
}

fn stress_advice(coupon: &Coupon, modulus_pa: f64, fits: impl Fn(f64) -> bool) -> String {
    let [strain, stress] = &coupon.columns;
    let written = stress.to_lowercase();
    let own = STRESSES.iter().find(|(unit, _)| written.ends_with(&format!("_{}", unit.to_lowercase())));
    let renamed = |(unit, size): &(&str, f64)| {
        let (name, pa) = (own?.0, modulus_pa * size / own?.1);
        let (suffix, mpa) = (unit.to_lowercase(), short(pa * 1e-6));
        let words = format!("if {stress} holds {unit}, name it stress_{suffix} (modulus {mpa} MPa)");
        (name != *unit && fits(pa)).then_some(words)
    };
    let mut found: Vec<String> = STRESSES.iter().filter_map(renamed).collect();
    let is_ratio = strain.to_lowercase().ends_with("ratio");
    let (unit, factor) = if is_ratio { ("pct", 100.0) } else { ("ratio", 0.01) };
    if fits(modulus_pa * factor) {
        let mpa = short(modulus_pa * factor * 1e-6);
        found.push(format!("if {strain} is in another unit, name it strain_{unit} (modulus {mpa} MPa)"));
    }
    if found.is_empty() { format!("check the units of {strain} and {stress}") } else { found.join("; ") }
}

fn short(x: f64) -> String {
    if x != 0.0 && !(1e-3..1e6).contains(&x.abs()) {
        return format!("{x:.3e}");
    }
    let decimals = (3 - x.abs().max(1e-3).log10().floor() as i32).clamp(0, 6) as usize;
    let text = format!("{x:.decimals$}");
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_string() } else { text }
}
