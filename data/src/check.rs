//! `ibr data check`: the contents of a dataset, how well its runs agree, and what it cannot be used for.

use serde::Serialize;

use crate::about::{About, BENDING_TEST};
use crate::agreement::{Doubt, Seen, doubts};
use crate::dataset::{Dataset, Hold, Marker, Phase};
use crate::lost::losses;
use crate::policy::{self, tolerance_act_pa, tolerance_body_pa};
use crate::units::{kpa, mm};

/// Standard deviations per median absolute deviation of a normal variable: 1/Φ⁻¹(3/4).
const SD_PER_MAD: f64 = 1.482_602_218_505_602;

/// What a dataset holds; mm, kPa and s because it is printed.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct CheckReport {
    /// Name of the dataset that was checked.
    pub name: String,
    /// Actuator kind of the dataset, such as `epam`.
    pub actuator: String,
    /// `measured`, `digitised`, `synthetic` or `published`; `None` without about.toml.
    pub provenance: Option<String>,
    /// Labels of the runs in the order of the table.
    pub runs: Vec<String>,
    /// Samples per run, hold and marker.
    pub samples_per_hold: usize,
    /// Checks of the holds in protocol order.
    pub holds: Vec<HoldCheck>,
    /// Checks of the markers in order of station.
    pub markers: Vec<MarkerCheck>,
    /// Distinct actuator pressures of the holds, rising \[kPa\].
    pub actuator_pressures_kpa: Vec<f64>,
    /// Distinct body pressures of the holds, rising \[kPa\].
    pub body_pressures_kpa: Vec<f64>,
    /// How far z of a marker is at most from its z in the first hold \[mm\], where the table has z.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub z_travel_mm: Option<f64>,
    /// Whether there is an unloading branch.
    pub unloading: bool,
    /// Samples far from the other runs.
    pub outliers: Vec<Outlier>,
    /// Pairs of runs with identical values.
    pub identical_runs: Vec<[String; 2]>,
    /// What limits the use of this dataset, in plain words.
    pub warnings: Vec<String>,
}

/// Pressures, duration and scatter of one hold.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct HoldCheck {
    /// Actuator pressure, of supply channel 0 where there are several \[kPa\].
    pub p_act_kpa: f64,
    /// Of every supply channel \[kPa\], where the table has several.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub p_act_channels_kpa: Vec<f64>,
    /// Body pressure of the hold \[kPa\].
    pub p_body_kpa: f64,
    /// How the hold was reached: `load`, `hold` or `unload`.
    pub phase: &'static str,
    /// 0 for the first hold of its kind.
    pub occurrence: usize,
    /// Time between first and last sample \[s\]; with few samples less than the hold lasted.
    pub duration_s: f64,
    /// Run-to-run standard deviation of the hold means, rms over markers and axes \[mm\]; `None` for one run.
    pub scatter_mm: Option<f64>,
    /// Mean reading of the gauge at the actuator \[kPa\]; `None` without one.
    pub gauge_kpa: Option<f64>,
}

/// Station and scatter of one marker.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct MarkerCheck {
    /// Label as in the `marker` column.
    pub name: String,
    /// Station on the undeformed body from its base \[mm\]; `None` if unknown.
    pub s_mm: Option<f64>,
    /// Run-to-run standard deviation of the hold means, rms over holds and axes \[mm\]; `None` for one run.
    pub scatter_mm: Option<f64>,
}

/// A sample far from the median over runs.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Outlier {
    /// Label of the run as in the table.
    pub run: String,
    /// Index of the hold in the protocol.
    pub hold: usize,
    /// Index of the sample in the hold.
    pub sample: usize,
    /// Label of the marker as in the table.
    pub marker: String,
    /// Distance along x from the median over runs \[mm\].
    pub dx_mm: f64,
    /// Distance along y from the median over runs \[mm\].
    pub dy_mm: f64,
    /// Distance along z \[mm\], where the table has z.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub dz_mm: Option<f64>,
    /// Largest of the robust z of the axes.
    pub robust_z: f64,
}

/// Counts and scatter of a dataset, with warnings about what limits its use.
pub fn check(dataset: &Dataset, about: Option<&About>) -> CheckReport {
    let variance_mm2 = variance_of_hold_means_mm2(dataset);
    let (holds, markers) = (dataset.holds.len(), dataset.markers.len());
    let rms = |select: &dyn Fn(usize, usize) -> bool| -> Option<f64> {
        let cells = (0..holds).flat_map(|h| (0..markers).map(move |m| (h, m)));
        let cells = cells.filter(|&(h, m)| select(h, m) && dataset.is_seen(h, m));
        let values: Vec<f64> = cells.flat_map(|(h, m)| variance_mm2.as_ref().map(|v| v[h * markers + m])).collect();
        (!values.is_empty()).then(|| (values.iter().sum::<f64>() / values.len() as f64).sqrt())
    };
    let marker_check = |(index, marker): (usize, &Marker)| MarkerCheck {
        name: marker.name.clone(),
        s_mm: marker.station_m.map(mm),
        scatter_mm: rms(&|_, marker| marker == index),
    };
    let mut report = CheckReport {
        name: dataset.name.clone(),
        actuator: dataset.actuator.clone(),
        provenance: about.map(|about| about.provenance.word().to_string()),
        runs: dataset.runs.clone(),
        samples_per_hold: dataset.samples_per_hold,
        holds: (0..holds).map(|h| hold_check(dataset, h, rms(&|hold, _| hold == h))).collect(),
        markers: dataset.markers.iter().enumerate().map(marker_check).collect(),
        actuator_pressures_kpa: levels(dataset.holds.iter().flat_map(Hold::channels_pa).collect(), tolerance_act_pa),
        body_pressures_kpa: levels(dataset.holds.iter().map(|hold| hold.p_body_pa).collect(), tolerance_body_pa),
        z_travel_mm: dataset.has_z().then(|| mm(dataset.travel_m(2))),
        unloading: dataset.holds.iter().any(|hold| hold.phase == Phase::Unload),
        outliers: outliers(dataset),
        identical_runs: identical_runs(dataset),
        warnings: Vec::new(),
    };
    report.warnings = warnings(&report, about);
    report.warnings.extend(contradictions(dataset));
    report.warnings.extend(losses(dataset));
    let doubts = doubts(&Seen::of_dataset(dataset)).into_iter();
    report.warnings.extend(doubts.map(|Doubt { message, help }| format!("{message}; {help}")));
    report
}

fn hold_check(dataset: &Dataset, index: usize, scatter_mm: Option<f64>) -> HoldCheck {
    let hold = &dataset.holds[index];
    let duration_s = hold.t_s.last().zip(hold.t_s.first()).map_or(0.0, |(last, first)| last - first);
    HoldCheck {
        p_act_kpa: kpa(hold.p_act_pa),
        p_act_channels_kpa: hold.channels_pa().map(kpa).filter(|_| !hold.more_act_pa.is_empty()).collect(),
        p_body_kpa: kpa(hold.p_body_pa),
        phase: hold.phase.word(),
        occurrence: hold.occurrence,
        duration_s,
        scatter_mm,
        gauge_kpa: gauge_kpa(dataset, index),
    }
}

fn gauge_kpa(dataset: &Dataset, hold: usize) -> Option<f64> {
    let samples = dataset.samples_per_hold;
    let own = |run: usize| Some(dataset.gauge(run)?[hold * samples..(hold + 1) * samples].iter().sum::<f64>());
    let total: f64 = (0..dataset.runs.len()).map(own).sum::<Option<f64>>()?;
    Some(kpa(total / (dataset.runs.len() * samples) as f64))
}

/// `[hold][marker]`: variance over runs of the mean over samples, averaged over the axes \[mm²\]; `None` for one run.
fn variance_of_hold_means_mm2(dataset: &Dataset) -> Option<Vec<f64>> {
    let runs = dataset.runs.len();
    if runs < 2 {
        return None;
    }
    let samples = dataset.samples_per_hold;
    let mean_mm = |run: usize, hold: usize, marker: usize, axis: usize| {
        let values = (0..samples).map(|sample| dataset.place(run, hold, sample, marker)[axis]);
        values.map(mm).sum::<f64>() / samples as f64
    };
    let variance = |hold: usize, marker: usize, axis: usize| {
        let means: Vec<f64> = (0..runs).map(|run| mean_mm(run, hold, marker, axis)).collect();
        let centre = means.iter().sum::<f64>() / runs as f64;
        means.iter().map(|mean| (mean - centre).powi(2)).sum::<f64>() / (runs - 1) as f64
    };
    let cells = (0..dataset.holds.len()).flat_map(|hold| (0..dataset.markers.len()).map(move |marker| (hold, marker)));
    let share = 1.0 / dataset.axes as f64;
    let over_axes = |hold, marker| (0..dataset.axes).map(|axis| variance(hold, marker, axis)).sum::<f64>();
    Some(cells.map(|(hold, marker)| share * over_axes(hold, marker)).collect())
}

/// Distinct values \[kPa\], rising; values within the tolerance of a hold are one.
fn levels(mut values_pa: Vec<f64>, tolerance_pa: fn(f64) -> f64) -> Vec<f64> {
    values_pa.sort_by(f64::total_cmp);
    let mut levels: Vec<f64> = Vec::new();
    for value in values_pa {
        if levels.last().is_none_or(|&last| value - last > tolerance_pa(last)) {
            levels.push(value);
        }
    }
    levels.into_iter().map(kpa).collect()
}

/// Samples whose distance d from the median over runs exceeds 6 robust standard deviations, both of their hold and
/// marker (all runs and samples) and of their marker (all holds): with few runs either scale alone is small by chance
/// and would list good samples. Robust standard deviation: 1.4826 · median |d| · √(R/(R−1)) over the values with d ≠ 0;
/// the median run itself has d = 0 and carries no information on the scatter. Needs three runs.
fn outliers(dataset: &Dataset) -> Vec<Outlier> {
    let runs = dataset.runs.len();
    if runs < 3 {
        return Vec::new();
    }
    let deviations: Vec<_> = (0..dataset.axes).map(|axis| deviations_from_median_m(dataset, axis)).collect();
    let few_runs = (runs as f64 / (runs - 1) as f64).sqrt();
    let mut found = Vec::new();
    for (marker, described) in dataset.markers.iter().enumerate() {
        let scale = |holds: &[usize], axis: usize| {
            let all = holds.iter().flat_map(|&h| samples_of(dataset, h, marker));
            let of_axis = &deviations[axis];
            let sizes =
                all.flat_map(|i| of_axis.iter().map(move |run| run[i].abs())).filter(|size| *size > 0.0).collect();
            (few_runs * SD_PER_MAD * median(sizes)).max(policy::SURELY_FINE_M / policy::OUTLIER_Z)
        };
        let every_hold: Vec<usize> = (0..dataset.holds.len()).collect();
        let of_marker: Vec<f64> = (0..dataset.axes).map(|axis| scale(&every_hold, axis)).collect();
        for hold in every_hold {
            let sd = of_marker.iter().enumerate().map(|(axis, sd)| scale(&[hold], axis).max(*sd)).collect::<Vec<_>>();
            for (sample, at) in samples_of(dataset, hold, marker).enumerate() {
                for (run, label) in dataset.runs.iter().enumerate() {
                    let d: Vec<f64> = deviations.iter().map(|of_axis| of_axis[run][at]).collect();
                    let robust_z = d.iter().zip(&sd).map(|(d, sd)| d.abs() / sd).fold(0.0, f64::max);
                    if robust_z > policy::OUTLIER_Z {
                        let (run, marker) = (label.clone(), described.name.clone());
                        let (dx_mm, dy_mm, dz_mm) = (mm(d[0]), mm(d[1]), d.get(2).copied().map(mm));
                        found.push(Outlier { run, hold, sample, marker, dx_mm, dy_mm, dz_mm, robust_z });
                    }
                }
            }
        }
    }
    found
}

fn samples_of(dataset: &Dataset, hold: usize, marker: usize) -> impl Iterator<Item = usize> + '_ {
    (0..dataset.samples_per_hold).map(move |sample| dataset.offset(hold, sample, marker) / dataset.axes)
}

/// `[run][hold, sample, marker]`: distance of a coordinate from the median over runs \[m\].
fn deviations_from_median_m(dataset: &Dataset, axis: usize) -> Vec<Vec<f64>> {
    let of_run =
        |run: usize| -> Vec<f64> { dataset.run(run).iter().skip(axis).step_by(dataset.axes).copied().collect() };
    let runs: Vec<Vec<f64>> = (0..dataset.runs.len()).map(of_run).collect();
    let over_runs = |i: usize| median(runs.iter().map(|run| run[i]).collect());
    let centre: Vec<f64> = (0..dataset.values_per_run() / dataset.axes).map(over_runs).collect();
    runs.iter().map(|run| run.iter().zip(&centre).map(|(value, centre)| value - centre).collect()).collect()
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    let (count, middle) = (values.len(), values.len() / 2);
    match count {
        0 => 0.0,
        _ if count % 2 == 1 => values[middle],
        _ => 0.5 * (values[middle - 1] + values[middle]),
    }
}

fn identical_runs(dataset: &Dataset) -> Vec<[String; 2]> {
    let mut order: Vec<usize> = (0..dataset.runs.len()).collect();
    let compare = |a: &usize, b: &usize| {
        let pairs = dataset.run(*a).iter().zip(dataset.run(*b));
        pairs.map(|(x, y)| x.total_cmp(y)).find(|order| order.is_ne()).unwrap_or(std::cmp::Ordering::Equal)
    };
    order.sort_by(compare);
    let same = order.windows(2).filter(|pair| compare(&pair[0], &pair[1]).is_eq());
    same.map(|pair| [dataset.runs[pair[0]].clone(), dataset.runs[pair[1]].clone()]).collect()
}

const MOST_NAMED: usize = 3;

/// Contradictions in the holds of a table: phases against pressures, times against any protocol. The first hold, and
/// one that begins before the last (another session), have no pressure before them.
pub fn contradictions(dataset: &Dataset) -> Vec<String> {
    let mut found = Vec::new();
    let (mut wrong, mut gaps) = (Vec::new(), Vec::new());
    for (i, pair) in dataset.holds.windows(2).enumerate() {
        let (before, hold) = (&pair[0], &pair[1]);
        let begins = |hold: &Hold| hold.t_s.first().copied().unwrap_or_default();
        if begins(hold) < begins(before) {
            continue;
        }
        gaps.push(begins(hold) - begins(before));
        let (change, least) = (hold.sum_act_pa() - before.sum_act_pa(), tolerance_act_pa(before.sum_act_pa()));
        let right = if change > least { Phase::Load } else { Phase::Unload };
        if change.abs() > least && hold.phase != right {
            let ([from, to], said, right) =
                ([before, hold].map(|h| kpa(h.sum_act_pa())), hold.phase.word(), right.word());
            wrong.push(format!("hold {} goes from {from:.1} to {to:.1} kPa and is marked {said}, not {right}", i + 2));
        }
    }
    if !wrong.is_empty() {
        let (name, count) = (&dataset.name, wrong.len());
        let more = if count > MOST_NAMED { format!(", and {} more", count - MOST_NAMED) } else { String::new() };
        wrong.truncate(MOST_NAMED);
        found.push(format!(
            "{name}: the column phase contradicts the actuator's pressure in {count} of {} holds: {}{more}. Correct it: load \
             where the pressure was raised to reach a hold, unload where it was lowered, hold where it stayed",
            dataset.holds.len(),
            wrong.join("; ")
        ));
    }
    if !gaps.is_empty() && median(gaps) > policy::PATIENT_S {
        let name = &dataset.name;
        found.push(format!(
            "{name}: holds are more than {} s apart: if the times are milliseconds, name the column t_ms",
            policy::PATIENT_S
        ));
    }
    found
}

fn warnings(report: &CheckReport, about: Option<&About>) -> Vec<String> {
    let mut warnings = Vec::new();
    let mut warn = |condition: bool, text: &str| warnings.extend(condition.then(|| text.to_string()));
    let runs = report.runs.len();
    warn(runs == 1, "one run: no noise floor and no p-values can be given; at least 3 runs are needed");
    warn(runs == 2, "two runs: the noise floor rests on one difference; at least 3 runs are needed for p-values");
    let outliers = report.outliers.len();
    let far = policy::OUTLIER_Z;
    warn(
        outliers > 0,
        &format!("{outliers} samples lie more than {far} robust standard deviations from the other runs"),
    );
    let unknown = report.markers.iter().filter(|marker| marker.s_mm.is_none()).count();
    warn(unknown > 0, &format!("{unknown} markers without station: add [markers] names and s_mm to about.toml"));
    warn(!report.unloading, "no unloading branch: friction, creep and set cannot be separated from other effects");
    let [body, act] = [&report.body_pressures_kpa, &report.actuator_pressures_kpa].map(Vec::len);
    warn(body < 2, "one body pressure: body stiffness and pouch effects are hard to separate");
    warn(act < 3, "fewer than three actuator pressures: no trend with pressure");
    warn(about.is_some_and(|about| about.bending_nm2.is_none()), &format!("no bending test: {BENDING_TEST}"));
    warn(about.is_none(), "no about.toml: provenance, licence, geometry and gravity are unknown");
    let unseen =
        about.into_iter().flat_map(|about| &about.markers).filter(|m| report.markers.iter().all(|r| r.name != m.name));
    unseen.for_each(|marker| warn(true, &format!("marker {} of about.toml has no rows", marker.name)));
    warnings
}
