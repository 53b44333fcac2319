//! Recordings that agree with themselves, and each slip made in one of them.

use super::seen::{Doubt, LogSeen, Seen};
use super::{AgreementCheck, doubts};
use crate::import::{ImportOptions, PressedRun};

/// Changes a place \[m\], given run, time and marker.
type Change = Box<dyn Fn(usize, f64, usize, &mut [f64; 2])>;

/// Three runs of a robot that bends evenly, with markers at 90, 210 and 330 mm, 25 frames per second.
pub(super) struct Made {
    pub levels: Vec<f64>,
    pub stations_m: Option<[f64; 3]>,
    /// At the beginning and the end of every run.
    pub body_kpa: [f64; 2],
    pub noise_mm: f64,
    pub seed: u64,
    /// Rows of time \[s\] and actuator pressure \[Pa\].
    pub log: Vec<[f64; 2]>,
    pub changes: Vec<Change>,
    pub frozen: Vec<(usize, std::ops::Range<usize>)>,
    pub copied: Vec<[usize; 2]>,
    /// The run and the time from which on the outer two markers have each other's places.
    pub swapped: Option<(usize, f64)>,
    /// Whether each pressure is in the other one's column.
    pub exchanged: bool,
    /// A run whose picture is cropped \[m\].
    pub shifted: Option<(usize, [f64; 2])>,
}

const HOLD_S: f64 = 5.0;

impl Made {
    pub(super) fn new(seed: u64) -> Made {
        let levels = vec![0.0, 10.0, 20.0, 30.0, 20.0, 10.0, 0.0];
        let pressure = |t: f64| pressure_kpa(&levels, t);
        let log = (0..700).map(|k| 0.05 * f64::from(k)).map(|t| [t, 1e3 * pressure(t)]).collect();
        Made {
            levels,
            stations_m: None,
            body_kpa: [2.0, 2.0],
            noise_mm: 0.5,
            seed,
            log,
            changes: Vec::new(),
            frozen: Vec::new(),
            copied: Vec::new(),
            swapped: None,
            exchanged: false,
            shifted: None,
        }
    }

    /// Changes places by run, time and marker.
    pub(super) fn each(&mut self, change: impl Fn(usize, f64, usize, &mut [f64; 2]) + 'static) {
        self.changes.push(Box::new(change));
    }

    pub(super) fn freeze(&mut self, run: usize, frames: std::ops::Range<usize>) {
        self.frozen.push((run, frames));
    }

    pub(super) fn copy(&mut self, from: usize, to: usize) {
        self.copied.push([from, to]);
    }

    pub(super) fn seen(&self) -> Seen {
        let mut state = self.seed.wrapping_mul(0x9e37_79b9_7f4a_7c15);
        let mut uniform = move || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 11) as f64 / (1_u64 << 53) as f64
        };
        let mut normal = move || (0..12).map(|_| uniform()).sum::<f64>() - 6.0;
        let count = (self.levels.len() as f64 * HOLD_S * 25.0) as usize;
        let times_s: Vec<f64> = (0..count).map(|k| k as f64 / 25.0).collect();
        let end_s = times_s[count - 1];
        let mut runs = Vec::new();
        for run in 0..3 {
            let gain = 1.0 + 0.02 * normal();
            let [dx, dy, roll] = [1e-3 * normal(), 1e-3 * normal(), 4e-3 * normal()];
            let act: Vec<f64> = times_s.iter().map(|t| 1e3 * pressure_kpa(&self.levels, *t)).collect();
            let [b0, b1] = self.body_kpa;
            let body = times_s.iter().map(|t| 1e3 * (b0 + (b1 - b0) * t / end_s)).collect();
            let mut xy_m = vec![Vec::new(); 3];
            for (k, t) in times_s.iter().enumerate() {
                // The way back bends more.
                let late = if *t > 20.0 { 1.04 } else { 1.0 };
                let kappa = (gain * late * 1.2 * act[k] * 1e-3 / 30.0 / 0.36).max(1e-6);
                for (marker, s) in [0.09, 0.21, 0.33].into_iter().enumerate() {
                    let [x, y] = [(kappa * s).sin() / kappa, (1.0 - (kappa * s).cos()) / kappa];
                    let noise = [normal(), normal()].map(|n| 1e-3 * self.noise_mm * n);
                    let mut place = [x - roll * y + dx + noise[0], y + roll * x + dy + noise[1]];
                    self.changes.iter().for_each(|change| change(run, *t, marker, &mut place));
                    let frozen = self.frozen.iter().find(|(r, frames)| *r == run && frames.contains(&k));
                    let still = frozen.and_then(|(_, frames)| xy_m[marker].get(frames.start).copied());
                    xy_m[marker].push(still.unwrap_or(place));
                }
            }
            let label = (run + 1).to_string();
            let pressures_pa = if self.exchanged { [act, body] } else { [body, act] };
            runs.push(PressedRun { label, times_s: times_s.clone(), pressures_pa, xy_m });
        }
        for [from, to] in &self.copied {
            runs[*to].xy_m = runs[*from].xy_m.clone();
        }
        if let Some((run, [dx, dy])) = self.shifted {
            runs[run].xy_m.iter_mut().flatten().for_each(|place| *place = [place[0] + dx, place[1] + dy]);
        }
        if let Some((run, from_s)) = self.swapped {
            let [_, b, c] = &mut runs[run].xy_m[..] else { unreachable!("three markers") };
            let first = times_s.partition_point(|t| *t < from_s);
            b[first..].swap_with_slice(&mut c[first..]);
        }
        let stations = self.stations_m.map_or([None; 3], |stations| stations.map(Some));
        let markers = ["a", "b", "c"].iter().zip(stations).map(|(name, s)| ((*name).to_string(), s)).collect();
        let [times_s, act_pa] = [0, 1].map(|k| self.log.iter().map(|reading| reading[k]).collect());
        let log = LogSeen { file: "log.csv".into(), times_s, act_pa };
        Seen::of_import(&runs, markers, &ImportOptions::default(), vec![log])
    }
}

/// Ramps of 0.5 s begin every hold but the first.
fn pressure_kpa(levels: &[f64], t_s: f64) -> f64 {
    let k = ((t_s / HOLD_S) as usize).min(levels.len() - 1);
    let before = levels[k.saturating_sub(1)];
    before + (levels[k] - before) * ((t_s - k as f64 * HOLD_S) / 0.5).clamp(0.0, 1.0)
}

/// The check names the slip with these words.
pub(super) fn refused(check: AgreementCheck, slip: impl Fn(&mut Made), words: &[&str]) {
    let mut made = Made::new(1);
    slip(&mut made);
    let Doubt { message, help } = check(&made.seen()).unwrap();
    let said = format!("{message} | {help}");
    assert!(words.iter().all(|word| said.contains(word)), "{said}");
}

/// The check has no doubt about right recordings.
pub(super) fn right(check: AgreementCheck) {
    for seed in 0..20 {
        let found = check(&Made::new(seed).seen());
        assert!(found.is_none(), "{seed}: {found:?}");
    }
}

#[test]
fn right_recordings_have_no_doubt() {
    for (noise_mm, seeds) in [(0.3, 0..100), (1.0, 100..200)] {
        let doubted: Vec<_> =
            seeds.map(|seed| doubts(&Made { noise_mm, ..Made::new(seed) }.seen())).filter(|d| !d.is_empty()).collect();
        assert!(doubted.is_empty(), "{} at {noise_mm} mm: {:?}", doubted.len(), doubted[0]);
    }
}

/// Tables that come with the program.
#[test]
fn shipped_tables_have_no_doubt() {
    for set in crate::sets() {
        let Ok((dataset, _)) = crate::load(&set.name, &mut |_, _| ()) else { continue };
        let found = doubts(&Seen::of_dataset(&dataset));
        assert!(found.is_empty(), "{}: {found:?}", set.name);
    }
}

/// `ibr data check` notes the slips that a table still shows.
#[test]
fn slips_of_tables_are_noted() {
    type Change = fn(run: usize, hold: usize, marker: usize, place: &mut [f64]);
    let slips: [(Change, &str); 5] = [
        (
            |run, hold, _, at| {
                if run == 1 && hold >= 2 {
                    at[1] += 0.02
                }
            },
            "run 2: between",
        ),
        (
            |run, _, _, at| {
                if run == 2 {
                    at[0] += 0.02
                }
            },
            "run 3: at rest",
        ),
        (
            |run, _, _, at| {
                if run == 0 {
                    at.iter_mut().for_each(|v| *v *= 1.06)
                }
            },
            "zoom",
        ),
        (
            |_, _, marker, at| {
                if marker == 4 {
                    at.copy_from_slice(&[0.27, 0.1])
                }
            },
            "background",
        ),
        (|_, _, _, at| at[1] += 0.15, "--base"),
    ];
    for (change, words) in slips {
        let (mut set, _) = crate::load("synthetic-epam", &mut |_, _| ()).unwrap();
        let (markers, axes, per_run) = (set.markers.len(), set.axes, set.values_per_run());
        let per_hold = per_run / set.holds.len();
        for (k, place) in set.coordinates_m.chunks_exact_mut(axes).enumerate() {
            let value = k * axes;
            change(value / per_run, value % per_run / per_hold, k % markers, place);
        }
        let warnings = crate::check(&set, None).warnings;
        assert!(warnings.iter().any(|warning| warning.contains(words)), "{words}: {warnings:?}");
    }
}
