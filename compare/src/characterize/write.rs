//! Results as text: the TOML fragment that cases take, and tables.

use super::result::{Characterized, MeanCurve, ShearCurve};
use super::{PAPER_LIMIT_RAD, Reduction};
use data::{Column, Direction, Table};

/// `[fabric.NAME]` tables for a finite element case, one for every law that these tests determine; none without thickness.
///
/// Woven needs warp, fill and bias; orthotropic the same; neo-Hookean warp or fill.
pub fn fabric_toml(found: &Characterized, settings: &Reduction, program: &str) -> Option<String> {
    let thickness_mm = 1e3 * found.thickness_m?;
    let mut laws = String::new();
    for (suffix, law) in [("", woven(found)), ("-linear", linear(found)), ("-film", film(found))] {
        let Some(lines) = law else { continue };
        let name = quoted(&format!("{}{suffix}", settings.name));
        laws.push_str(&format!("\n[fabric.{name}]\n{lines}thickness_mm = {thickness_mm:.6}\n"));
    }
    let (count, word) = (found.specimens.len(), found.provenance.word());
    let head = format!(
        "# Made by {program} characterize from {count} specimens ({word}). Keep the tables that you need.\n{}",
        bending(found).unwrap_or_default()
    );
    (!laws.is_empty()).then(|| head + &laws)
}

/// What would have to be there for [`fabric_toml`].
pub fn missing(found: &Characterized) -> &'static str {
    match found.thickness_m {
        _ if found.specimens.is_empty() => "a law needs tensile tests; add their files",
        None => "the thickness is missing; add --thickness 0.05mm or # thickness_mm: 0.05 in the files",
        Some(_) => "a law needs specimens pulled along warp or fill; woven and orthotropic need 0°, 45° and 90°",
    }
}

/// `[measured]` tables for the `about.toml` of a robot made of this fabric, from numbers of two specimens or more; none without any.
///
/// The standard deviation is s √(1 + 1/n), for one more piece, because the robot is one piece; the error of the mean would be too small.
pub fn measured_toml(found: &Characterized, program: &str) -> Option<String> {
    let one_more = |key: &str| {
        let scatter = found.quantity(key)?.scatter;
        let sd = scatter.sd? * (1.0 + 1.0 / scatter.n as f64).sqrt();
        // A dataset accepts nothing better than a thousandth.
        (scatter.mean > 0.0).then(|| [scatter.mean, sd.max(2e-3 * scatter.mean)])
    };
    let line = |key: &str, [mean, sd]: [f64; 2], note: &str| {
        let (mean, sd) = (digits(mean), digits(sd));
        format!("{key} = [{mean}, {sd}]{note}\n")
    };
    let compliance = |key: &str, along: &str| {
        let (thickness, [e, sd]) = (found.thickness_m?, one_more(key)?);
        let c = 1.0 / (1e6 * e * thickness);
        Some(line("compliance_m_per_n", [c, c * sd / e], &format!("   # {along} along the robot, one layer")))
    };
    let angle = one_more("locking").map(|pair| pair.map(f64::to_radians));
    let tables = [
        ("fabric_stretch", compliance("e0", "warp").or_else(|| compliance("e90", "fill"))),
        ("shear_stiffness", one_more("gt").map(|pair| line("shear_n_per_m", pair, ""))),
        ("shear_lock", angle.map(|pair| line("lock_rad", pair, "   # where two straight lines meet"))),
    ];
    let table = |(name, text): (&str, Option<String>)| Some(format!("\n[measured.{name}]\n{}", text?));
    let tables: String = tables.into_iter().filter_map(table).collect();
    let word = found.provenance.word();
    let head = format!(
        "# Made by {program} characterize ({word}), for the about.toml of a robot whose actuator is of this fabric: value and\n\
         # standard deviation of one more piece. Keep what its actuator knows (ibr list effects).\n"
    );
    (!tables.is_empty()).then(|| head + &tables)
}

/// A bare key, or one in quotation marks.
fn quoted(name: &str) -> String {
    let bare = |c: char| c.is_ascii_alphanumeric() || c == '-' || c == '_';
    if !name.is_empty() && name.chars().all(bare) { name.into() } else { format!("\"{}\"", name.escape_default()) }
}

fn value(found: &Characterized, key: &str) -> Option<f64> {
    found.quantity(key).map(|q| q.scatter.mean)
}

fn woven(found: &Characterized) -> Option<String> {
    let word = found.provenance.word();
    let yarn = |direction| {
        let curve = found.yarns.iter().find(|y| y.direction == direction)?;
        Some(rows_of(&curve.rows, [1.0, 1e-6]))
    };
    let (warp, fill) = (yarn(Direction::Warp)?, yarn(Direction::Fill)?);
    let shear = match found.shear.as_ref().and_then(|s| s.moment_pa.as_ref()) {
        Some(rows) => {
            let limit = PAPER_LIMIT_RAD.to_degrees();
            let rows = rows_of(rows, [180.0 / std::f64::consts::PI, 1e-6]);
            format!(
                "# degrees, MPa: moment per volume; calibrated on bias extension; beyond {limit:.0}° the reduction is doubtful\n\
                 shear = {rows}\n"
            )
        }
        None => {
            value(found, "g12_link")?;
            format!("e45_MPa = {:.6}                # {word}\n", value(found, "e45")?)
        }
    };
    Some(format!(
        "law = \"woven\"\n{}# nominal strain, MPa: mean of the specimens, {word}\nwarp = {warp}\nfill = {fill}\n{shear}",
        poisson(found)
    ))
}

fn linear(found: &Characterized) -> Option<String> {
    let (e0, e90) = (value(found, "e0")?, value(found, "e90")?);
    let word = found.provenance.word();
    let shear = match (value(found, "g12"), value(found, "e45")) {
        (Some(g), _) if g > 0.0 => format!("g_MPa = {g:.6}                # calibrated: bias extension, small angle\n"),
        (_, Some(e45)) if value(found, "g12_link").is_some() => format!("e45_MPa = {e45:.6}                # {word}\n"),
        _ => return None,
    };
    let nu12 = poisson(found);
    Some(format!(
        "law = \"orthotropic\"\ne0_MPa = {e0:.6}                # {word}\n\
         e90_MPa = {e90:.6}                # {word}\n{nu12}{shear}"
    ))
}

fn poisson(found: &Characterized) -> String {
    match found.quantity("nu12") {
        Some(q) => format!("nu12 = {:.6}                # {}\n", found.nu12(), q.known),
        None => "nu12 = 0                      # assumed: needs the width under load, or a biaxial test\n".into(),
    }
}

/// D of the cantilever test as its users need it: as the factor in D = factor E t³/12, and as a value of the reduced model.
fn bending(found: &Characterized) -> Option<String> {
    let (d, t) = (1e-6 * value(found, "bending_stiffness")?, found.thickness_m?);
    let moduli: Vec<f64> = ["e0", "e90"].iter().filter_map(|key| value(found, key)).collect();
    let plate = 1e6 * moduli.iter().sum::<f64>() / moduli.len() as f64 * t.powi(3) / 12.0;
    let (factor, d) = (d / plate, digits(d));
    let text = format!(
        "# Bending stiffness of the cantilever test, D = {d} N·m: its part has bending_factor = {factor:.3},\n\
         # a robot in finite elements the same in [fem], and the effect fold_energy bending_nm = {d}.\n"
    );
    plate.is_finite().then_some(text)
}

fn film(found: &Characterized) -> Option<String> {
    let c10 = value(found, "c10")?;
    Some(format!(
        "law = \"neo-hookean\"\nc10_MPa = {c10:.6}                # calibrated: isotropic, warp and fill together\n"
    ))
}

/// `[[x, y], …]` in other units, with the digits that a test has.
fn rows_of(rows: &[[f64; 2]], factors: [f64; 2]) -> String {
    let row = |r: &[f64; 2]| format!("[{}, {}]", digits(r[0] * factors[0]), digits(r[1] * factors[1]));
    format!("[{}]", rows.iter().map(row).collect::<Vec<_>>().join(", "))
}

/// Seven digits, so that rows that rise still rise.
fn digits(x: f64) -> String {
    if x == 0.0 { "0".into() } else { format!("{}", format!("{x:.6e}").parse::<f64>().unwrap_or(x)) }
}

/// Table of a mean curve along a yarn: strain in per cent, stress and its scatter in MPa.
pub fn yarn_table(MeanCurve { rows, sd_pa, .. }: &MeanCurve) -> Table {
    let [strain, stress] = [(0, 100.0), (1, 1e-6)].map(|(k, unit)| rows.iter().map(|r| unit * r[k]).collect());
    let sd = sd_pa.iter().map(|s| s.map_or(f64::NAN, |s| 1e-6 * s)).collect();
    let columns = [("strain_pct", strain), ("stress_mpa", stress), ("sd_between_specimens_mpa", sd)];
    Table { columns: columns.map(|(name, values)| (name.into(), Column::F64(values))).into() }
}

/// Table of the shear curve: angle, force per length and its scatter, moment per volume, whether within the limit.
pub fn shear_table(shear: &ShearCurve, thickness_m: Option<f64>) -> Table {
    let moment = |[angle, force]: &[f64; 2]| thickness_m.map_or(f64::NAN, |t| 1e-6 * force * angle.cos() / t);
    let within = |row: &[f64; 2]| if row[0] <= PAPER_LIMIT_RAD { "yes" } else { "no" }.to_string();
    let rows = shear.rows.iter();
    let columns = [
        ("shear_angle_deg", rows.clone().map(|r| r[0].to_degrees()).collect()),
        ("shear_force_n_per_m", rows.clone().map(|r| r[1]).collect()),
        ("sd_between_specimens_n_per_m", shear.sd_n_per_m.iter().map(|s| s.unwrap_or(f64::NAN)).collect()),
        ("moment_per_volume_mpa", rows.clone().map(moment).collect()),
    ];
    let mut columns: Vec<_> = columns.map(|(name, values)| (name.into(), Column::F64(values))).into();
    columns.push(("within_validity_limit".into(), Column::Str(rows.map(within).collect())));
    Table { columns }
}
