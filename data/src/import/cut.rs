//! Runs cut into holds or bins, cleaned, and compared with each other.

use super::holds::{Kept, PressedRun, WILD_SHARE, apart as between, bins, centre, clean, median, plateaus};
use super::options::ImportOptions;
use super::recording::{Recording, counted};
use crate::error::{DataError, Result};
use crate::policy::tolerance_act_pa;
use crate::units::kpa;

/// A run and the frames of its holds.
pub(crate) type CutRuns = Vec<(PressedRun, Vec<Kept>)>;

/// Recordings, whose places in the robot's frame are `xy_m`, with their pressures.
pub(crate) fn pressed(recordings: Vec<Recording>, xy_m: Vec<Vec<Vec<[f64; 2]>>>) -> Vec<PressedRun> {
    let run = |(recording, xy_m): (Recording, _)| PressedRun {
        label: recording.run.unwrap_or_default(),
        times_s: recording.times,
        pressures_pa: recording.pressures.map(Option::unwrap_or_default),
        xy_m,
    };
    recordings.into_iter().zip(xy_m).map(run).collect()
}

pub(crate) fn cut(
    file: &str,
    runs: Vec<PressedRun>,
    options: &ImportOptions,
    told: &mut Vec<String>,
) -> Result<CutRuns> {
    match options.bin_pa {
        Some(bin_pa) => binned(file, runs, bin_pa, told),
        None => held(file, runs, options, told),
    }
}

fn held(file: &str, runs: Vec<PressedRun>, options: &ImportOptions, told: &mut Vec<String>) -> Result<CutRuns> {
    let (mut cut, mut used, mut taken) = (Vec::new(), 0, [0, 0]);
    let frames: usize = runs.iter().map(|run| run.times_s.len()).sum();
    let least = format!("{} s and {} frames", options.least_hold_s, options.least_frames);
    for mut run in runs {
        let mut holds = plateaus(&run, options);
        if holds.len() < 2 {
            let (label, count) = (&run.label, holds.len());
            let message = format!("run {label} has {count} holds in which the pressures are kept for {least}");
            let unknown = run.pressures_pa[1].iter().filter(|p| p.is_nan()).count() as u64;
            let clock = format!("{} have no pressure: check --clock-offset; ", counted(unknown, "frame"));
            let clock = if unknown > 0 { &clock } else { "" };
            let help = format!("{clock}for a ramp add --bin 2kPa; for short holds --hold 0.2s or --frames 1");
            return Err(DataError::of(file, message, help));
        }
        let length_m = length_m(&run);
        let [early, all] = anticipated(&run, &holds, length_m);
        if early > 1 && 2 * early > all && !options.pressure_logs.is_empty() {
            let label = &run.label;
            let message =
                format!("run {label}: in {early} of {all} changes the robot is there before the pressure changes");
            let help =
                "log and camera have two clocks: give the log's time minus the camera's, --clock-offset, or find";
            return Err(DataError::of(file, message, help));
        }
        for hold in &mut holds {
            let [moving, wild] = clean(&mut run, hold, length_m);
            taken = [taken[0] + moving, taken[1] + wild];
            used += hold.frames.len();
        }
        cut.push((run, holds));
    }
    let counts: Vec<String> = cut.iter().map(|(_, holds)| holds.len().to_string()).collect();
    let (counts, rest) = (counts.join(", "), frames - used);
    told.push(format!("holds of at least {least}: {counts} in the runs; {rest} of {frames} frames are in none"));
    let [moving, wild] = [counted(taken[0], "frame"), counted(taken[1], "position")];
    if taken[0] > 0 {
        told.push(format!("left out: {moving} at the start of holds, in which the robot still moves"));
    }
    if taken[1] > 0 {
        told.push(format!("lost markers: {wild} far from the others of their hold"));
    }
    Ok(cut)
}

/// Changes after whose holds the markers are, in the last frame, nearer to their places of the next hold; and all changes that are
/// clear.
fn anticipated(run: &PressedRun, holds: &[Kept], length_m: f64) -> [usize; 2] {
    let mut counts = [0, 0];
    for pair in holds.windows(2) {
        let Some(last) = pair[0].frames.last() else { continue };
        let ahead = |column: &Vec<[f64; 2]>| {
            let [own, next] = [&pair[0], &pair[1]].map(|hold| centre(column, &hold.frames).map(|(at, _)| at));
            let (own, next) = (own?, next?);
            let clear = column[*last][0].is_finite() && between(own, next) > WILD_SHARE * length_m;
            clear.then(|| between(column[*last], next) < between(column[*last], own))
        };
        let votes: Vec<bool> = run.xy_m.iter().filter_map(ahead).collect();
        counts[0] += usize::from(2 * votes.iter().filter(|ahead| **ahead).count() > votes.len());
        counts[1] += usize::from(!votes.is_empty());
    }
    counts
}

/// The farthest that a marker is seen from the base.
fn length_m(run: &PressedRun) -> f64 {
    let distance = |column: &Vec<[f64; 2]>| {
        let all = column.iter().map(|[x, y]| (x * x + y * y).sqrt());
        median(all.filter(|d| d.is_finite()).collect()).unwrap_or(0.0)
    };
    run.xy_m.iter().map(distance).fold(0.0, f64::max)
}

/// A bin of a branch, by the numbers of branch and bin.
type Bin = (usize, i64, Kept);

/// Without bins at the ends of a branch that the pressure only touches, so that their mean is too near to the next bin's to be
/// separated.
fn apart(bins: Vec<Bin>) -> Vec<Bin> {
    let of = |branch: usize, k: i64| bins.iter().find(|bin| (bin.0, bin.1) == (branch, k)).map(|bin| bin.2.act_pa);
    let is_apart = |(branch, k, kept): &&Bin| match (of(*branch, k - 1), of(*branch, k + 1)) {
        (Some(next), None) | (None, Some(next)) => {
            (kept.act_pa - next).abs() >= 1.1 * tolerance_act_pa(kept.act_pa.max(next))
        }
        _ => true,
    };
    bins.iter().filter(is_apart).cloned().collect()
}

/// Runs by bins of pressure, those bins that all of them have.
fn binned(file: &str, runs: Vec<PressedRun>, bin_pa: f64, told: &mut Vec<String>) -> Result<CutRuns> {
    let found: Vec<Vec<Bin>> = runs.iter().map(|run| apart(bins(run, bin_pa))).collect();
    let highest_pa = found.iter().flatten().map(|bin| bin.2.act_pa).fold(0.0, f64::max);
    let least_pa = 1.1 * tolerance_act_pa(highest_pa);
    let bin_kpa = kpa(bin_pa);
    if bin_pa < least_pa {
        let highest = kpa(highest_pa);
        let message =
            format!("bins of {bin_kpa} kPa cannot be separated at {highest:.1} kPa: holds nearer than 5 % are one");
        let help = format!("give --bin {}kPa", kpa(least_pa).ceil());
        return Err(DataError::of(file, message, help));
    }
    let has = |run: &Vec<Bin>, bin: &Bin| run.iter().any(|own| (own.0, own.1) == (bin.0, bin.1));
    let all_have = |bin: &&Bin| found.iter().all(|run| has(run, bin));
    let common = |run: &Vec<Bin>| run.iter().filter(all_have).map(|bin| bin.2.clone()).collect();
    let common: Vec<Vec<Kept>> = found.iter().map(common).collect();
    let (all, count) = (found.iter().map(Vec::len).sum::<usize>(), common[0].len());
    let left_out = all - common.iter().map(Vec::len).sum::<usize>();
    if count < 2 {
        let help = "give larger bins, or import the runs one by one";
        return Err(DataError::of(file, "the runs have fewer than two bins in common", help));
    }
    told.push(format!(
        "binned by actuator pressure in steps of {bin_kpa} kPa, rising and falling apart: {count} bins with the mean of their frames; {left_out} are left out, which not every run has or which only touch a bin"
    ));
    Ok(runs.into_iter().zip(common).collect())
}
