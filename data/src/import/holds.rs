//! Where pressures were kept: plateaus of a recording, and bins of a ramp.

use std::ops::Range;

use super::options::ImportOptions;
use crate::policy::{tolerance_act_pa, tolerance_body_pa};

/// One run with its pressures, in the robot's frame.
pub(crate) struct PressedRun {
    pub label: String,
    pub times_s: Vec<f64>,
    /// Body and actuator pressure of every frame \[Pa\], NaN where not known.
    pub pressures_pa: [Vec<f64>; 2],
    /// `[marker][frame]` \[m\], NaN where not seen.
    pub xy_m: Vec<Vec<[f64; 2]>>,
}

/// Frames of one hold, and the direction from which its pressure was reached.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Kept {
    pub frames: Vec<usize>,
    pub act_pa: f64,
    /// Whether a ramp rose or fell there.
    pub rising: Option<bool>,
}

/// Standard deviations of the sensor's noise that a reading may be off its plateau.
const NOISE: f64 = 4.0;
/// Readings nearer than this to a plateau are on it, whatever the noise \[Pa\].
const SURELY_ON_PA: f64 = 50.0;
/// Standard deviations per median absolute difference of neighbours, of a normal variable.
pub(crate) const SD_PER_STEP: f64 = 1.482_602_218_505_602 / std::f64::consts::SQRT_2;

/// The plateaus of a run: both pressures within the tolerance of a hold, no drift beyond it, long enough, enough frames.
pub(crate) fn plateaus(run: &PressedRun, options: &ImportOptions) -> Vec<Kept> {
    let [body, act] = &run.pressures_pa;
    let mut found = Vec::new();
    let mut first = 0;
    while first < act.len() {
        let end = end_of_level(body, act, first);
        if let Some(kept) = plateau(run, first..end, options) {
            found.push(kept);
        }
        first = end.max(first + 1);
    }
    found
}

/// The first frame after `first` whose pressures depart from the mean so far, by more than a hold's tolerance, for good: a single
/// reading that departs is noise.
fn end_of_level(body: &[f64], act: &[f64], first: usize) -> usize {
    let (mut sums, mut count) = ([0.0, 0.0], 0.0);
    let mut departed = 0;
    for frame in first..act.len() {
        let near = |mean: [f64; 2]| {
            (body[frame] - mean[0]).abs() <= tolerance_body_pa(mean[0])
                && (act[frame] - mean[1]).abs() <= tolerance_act_pa(mean[1])
        };
        if count == 0.0 || near(sums.map(|sum| sum / count)) {
            departed = 0;
            sums = [sums[0] + body[frame], sums[1] + act[frame]];
            count += 1.0;
        } else {
            departed += 1;
        }
        if departed == 2 || (count == 0.0 && act[frame].is_nan()) {
            return frame + 1 - departed;
        }
    }
    act.len() - departed
}

fn plateau(run: &PressedRun, frames: Range<usize>, options: &ImportOptions) -> Option<Kept> {
    let act = &run.pressures_pa[1];
    let readings: Vec<f64> = frames.clone().map(|frame| act[frame]).collect();
    let third = readings.len() / 3;
    let mean = |part: &[f64]| part.iter().sum::<f64>() / part.len() as f64;
    let level = median(readings.clone())?;
    let tolerance = tolerance_act_pa(level);
    let drift = mean(&readings[readings.len() - third..]) - mean(&readings[..third]);
    if drift.abs() > tolerance {
        return None;
    }
    let steps = readings.windows(2).map(|pair| (pair[1] - pair[0]).abs()).collect();
    let noise_pa = SD_PER_STEP * median(steps).unwrap_or(0.0);
    let reach = (NOISE * noise_pa).max(SURELY_ON_PA).min(tolerance);
    let is_within = |frame: &usize, reach: f64| (act[*frame] - level).abs() <= reach;
    let is_on = |frame: &usize| is_within(frame, reach);
    let (begin, end) = (frames.clone().find(is_on)?, frames.rev().find(is_on)?);
    let start_s = run.times_s[begin] + options.settle_s;
    let is_kept = |frame: &usize| run.times_s[*frame] >= start_s && is_within(frame, tolerance);
    let frames: Vec<usize> = (begin..=end).filter(is_kept).collect();
    let lasts = run.times_s[*frames.last()?] - run.times_s[frames[0]];
    let is_hold = frames.len() >= options.least_frames && lasts >= options.least_hold_s;
    is_hold.then(|| Kept::of(act, frames, None))
}

impl Kept {
    fn of(act: &[f64], frames: Vec<usize>, rising: Option<bool>) -> Kept {
        let act_pa = frames.iter().map(|frame| act[*frame]).sum::<f64>() / frames.len() as f64;
        Kept { frames, act_pa, rising }
    }
}

pub(crate) fn median(mut values: Vec<f64>) -> Option<f64> {
    let middle = values.len() / 2;
    (!values.is_empty()).then(|| *values.select_nth_unstable_by(middle, f64::total_cmp).1)
}

/// The frames of every branch, up or down, by bins of the actuator's pressure: bin k holds pressures around k·`bin_pa`.
pub(crate) fn bins(run: &PressedRun, bin_pa: f64) -> Vec<(usize, i64, Kept)> {
    let act = &run.pressures_pa[1];
    let mut all = Vec::new();
    for (branch, (frames, rising)) in branches(act, 0.5 * bin_pa).into_iter().enumerate() {
        let mut found: Vec<(i64, Vec<usize>)> = Vec::new();
        for frame in frames.filter(|frame| act[*frame].is_finite()) {
            let bin = (act[frame] / bin_pa).round() as i64;
            match found.iter_mut().rev().find(|(known, _)| *known == bin) {
                Some((_, frames)) => frames.push(frame),
                None => found.push((bin, vec![frame])),
            }
        }
        let kept = |(bin, frames)| (branch, bin, Kept::of(act, frames, Some(rising)));
        all.extend(found.into_iter().map(kept));
    }
    all
}

/// Parts of a run in which the pressure rises (true) or falls: it turns where it comes back by more than `back_pa`.
pub(crate) fn branches(act: &[f64], back_pa: f64) -> Vec<(Range<usize>, bool)> {
    let (mut found, mut first) = (Vec::new(), 0);
    let (mut extreme, mut rising) = (0, None);
    for frame in 0..act.len() {
        if act[extreme].is_nan() {
            extreme = frame;
        }
        let gone = act[frame] - act[extreme];
        match rising {
            None if gone.abs() > back_pa => {
                rising = Some(gone > 0.0);
                extreme = frame;
            }
            Some(up) if (gone > 0.0) == up && gone != 0.0 => extreme = frame,
            Some(up) if gone.abs() > back_pa => {
                found.push((first..extreme + 1, up));
                first = extreme + 1;
                rising = Some(!up);
                extreme = frame;
            }
            _ => {}
        }
    }
    found.push((first..act.len(), rising.unwrap_or(true)));
    found
}

/// Part of the robot's length beyond which a place in a hold is wild.
pub(super) const WILD_SHARE: f64 = 0.05;
/// Robust standard deviations of its hold beyond which a place is wild.
const WILD_SD: f64 = 10.0;
/// Frames of a hold in which the robot may still be on its way: none in a hold of so few.
const FEW: usize = 6;

/// Takes frames off the start of a hold in which the robot was still moving, then places that are wild off the rest; returns
/// how many of each. `length_m` is the robot's.
pub(crate) fn clean(run: &mut PressedRun, kept: &mut Kept, length_m: f64) -> [u64; 2] {
    let centres = run.xy_m.iter().map(|column| centre(column, &kept.frames));
    let middle: Vec<Option<([f64; 2], f64)>> = centres.collect();
    let is_wild = |run: &PressedRun, marker: usize, frame: usize| {
        let far = |(centre, sd): ([f64; 2], f64)| {
            apart(run.xy_m[marker][frame], centre) > (WILD_SD * sd).max(WILD_SHARE * length_m)
        };
        middle[marker].is_some_and(far)
    };
    let moving = |frame: &&usize| {
        let seen = (0..run.xy_m.len()).filter(|marker| run.xy_m[*marker][**frame][0].is_finite());
        let wild = seen.clone().filter(|marker| is_wild(run, *marker, **frame)).count();
        wild > 0 && 2 * wild >= seen.count()
    };
    let half = if kept.frames.len() >= FEW { kept.frames.len() / 2 } else { 0 };
    let start = kept.frames[..half].iter().take_while(moving).count();
    kept.frames.drain(..start);
    let mut wild = 0;
    for &frame in &kept.frames {
        for marker in 0..run.xy_m.len() {
            if is_wild(run, marker, frame) {
                run.xy_m[marker][frame] = [f64::NAN; 2];
                wild += 1;
            }
        }
    }
    [start as u64, wild]
}

/// Distance of two places; without the guard of `hypot` against overflow, which takes a tenth of an import.
pub(super) fn apart(a: [f64; 2], b: [f64; 2]) -> f64 {
    ((a[0] - b[0]).powi(2) + (a[1] - b[1]).powi(2)).sqrt()
}

/// Median place of a marker over frames, and its robust standard deviation; `None` where it was seen less than three times.
pub(super) fn centre(column: &[[f64; 2]], frames: &[usize]) -> Option<([f64; 2], f64)> {
    let places = frames.iter().map(|frame| column[*frame]);
    let seen: Vec<[f64; 2]> = places.filter(|place| place[0].is_finite()).collect();
    if seen.len() < 3 {
        return None;
    }
    let over = |axis: usize| median(seen.iter().map(|place| place[axis]).collect());
    let centre = [over(0)?, over(1)?];
    let off = median(seen.iter().map(|place| apart(*place, centre)).collect());
    Some((centre, off.unwrap_or_default()))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 0 kPa for 3 s, a ramp of 2 s, 10 kPa for 4 s, back in 1 s, 0 kPa for 2 s, at 20 frames per second, with noise.
    fn run() -> PressedRun {
        let times_s: Vec<f64> = (0..240).map(|k| 0.05 * f64::from(k)).collect();
        let level = |t: f64| match t {
            t if t < 3.0 => 0.0,
            t if t < 5.0 => 5.0 * (t - 3.0),
            t if t < 9.0 => 10.0,
            t if t < 10.0 => 10.0 - 10.0 * (t - 9.0),
            _ => 0.0,
        };
        let act = times_s.iter().enumerate().map(|(k, t)| 1e3 * (level(*t) + 0.02 * (7.0 * k as f64).sin())).collect();
        let body = vec![2000.0; times_s.len()];
        let xy_m = vec![vec![[0.3, 0.0]; times_s.len()]];
        PressedRun { label: "1".into(), times_s, pressures_pa: [body, act], xy_m }
    }

    #[test]
    fn plateaus_begin_and_end_where_the_pressure_does_and_ramps_are_none() {
        let run = run();
        let found = plateaus(&run, &ImportOptions::default());
        let ends: Vec<[f64; 2]> =
            found.iter().map(|k| [k.frames[0], k.frames[k.frames.len() - 1]].map(|f| run.times_s[f])).collect();
        assert_eq!(found.len(), 3, "{ends:?}");
        for ([begin, end], [first, last]) in ends.iter().zip([[0.0, 3.0], [5.0, 9.0], [10.0, 12.0]]) {
            assert!((begin - first).abs() <= 0.1 && (end - last).abs() <= 0.1, "{ends:?}");
        }
        assert!((found[1].act_pa - 1e4).abs() < 20.0);
        let settled = plateaus(&run, &ImportOptions { settle_s: 1.0, ..ImportOptions::default() });
        assert!((run.times_s[settled[1].frames[0]] - 6.0).abs() < 0.1);
        let long = plateaus(&run, &ImportOptions { least_hold_s: 2.5, ..ImportOptions::default() });
        assert_eq!(long.len(), 2);
    }

    #[test]
    fn a_slow_ramp_has_no_plateau_and_its_bins_have_branches() {
        let times_s: Vec<f64> = (0..2400).map(|k| 0.05 * f64::from(k)).collect();
        let act: Vec<f64> = times_s.iter().map(|t| 1e3 * (if *t < 60.0 { 0.5 * t } else { 60.0 - 0.5 * t })).collect();
        let body = vec![2000.0; act.len()];
        let xy_m = vec![vec![[0.3, 0.0]; act.len()]];
        let run = PressedRun { label: "1".into(), times_s, pressures_pa: [body, act], xy_m };
        assert!(plateaus(&run, &ImportOptions::default()).is_empty());
        let found = bins(&run, 2e3);
        let up: Vec<i64> = found.iter().filter(|bin| bin.0 == 0).map(|bin| bin.1).collect();
        let down: Vec<i64> = found.iter().filter(|bin| bin.0 == 1).map(|bin| bin.1).collect();
        assert_eq!((up, down), ((0..=15).collect(), (0..=15).rev().collect()));
        assert!(found.iter().filter(|bin| bin.1 == 5).all(|bin| (bin.2.act_pa - 1e4).abs() < 30.0));
    }

    #[test]
    fn the_way_to_a_hold_and_wild_places_are_taken_off() {
        let mut run = run();
        for frame in 0..10 {
            run.xy_m[0][frame] = [0.3, 0.1 - 0.01 * frame as f64];
        }
        run.xy_m[0][40] = [0.0, 0.3];
        let mut kept = plateaus(&run, &ImportOptions::default()).remove(0);
        let [moving, wild] = clean(&mut run, &mut kept, 0.3);
        assert_eq!((moving, wild), (9, 1));
        assert!(run.xy_m[0][40][0].is_nan());
    }
}
