//! Slips of a recording: each is refused or printed when it is imported, and right recordings are imported.

use data::import::{FilePlace, ImportOptions, Imported, Offset, Scale, import};
use std::fmt::Write as _;
use std::path::PathBuf;

const FPS: f64 = 25.0;
const HOLD_S: f64 = 5.0;
const LEVELS: [f64; 7] = [0.0, 10.0, 20.0, 30.0, 20.0, 10.0, 0.0];
const STATIONS_MM: [f64; 3] = [90.0, 210.0, 330.0];

/// Uniform numbers in 0..1 (Knuth's MMIX constants).
struct Dice(u64);

impl Dice {
    fn normal(&mut self) -> f64 {
        let mut uniform = || {
            self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (self.0 >> 11) as f64 / (1_u64 << 53) as f64
        };
        (0..12).map(|_| uniform()).sum::<f64>() - 6.0
    }
}

/// Three videos in pixels, 3.1 to a millimetre, base at 212, 540, y down; and a pressure log for all.
struct Recorded {
    /// `[run][frame][marker]`
    pixels: Vec<Vec<[[f64; 2]; 3]>>,
    /// Time, body and actuator pressure \[kPa\].
    log: Vec<[f64; 3]>,
    options: ImportOptions,
}

fn pressure_kpa(t_s: f64) -> f64 {
    let k = ((t_s / HOLD_S).max(0.0) as usize).min(LEVELS.len() - 1);
    let before = LEVELS[k.saturating_sub(1)];
    before + (LEVELS[k] - before) * ((t_s - k as f64 * HOLD_S) / 0.5).clamp(0.0, 1.0)
}

impl Recorded {
    fn new(seed: u64) -> Recorded {
        let mut dice = Dice(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15));
        let frames = (HOLD_S * LEVELS.len() as f64 * FPS) as usize;
        let pixels = (0..3).map(|_| film(&mut dice, frames)).collect();
        let log = (0..700).map(|k| 0.05 * f64::from(k));
        let log = log.map(|t| [t, 2.0 + 0.02 * dice.normal(), pressure_kpa(t) + 0.05 * dice.normal()]).collect();
        let options = ImportOptions {
            scale: Scale::PixelsPerMetre(3100.0),
            base: Some(FilePlace::At(vec![212.0, 540.0])),
            frames_per_s: Some(FPS),
            actuator: Some("epam".into()),
            ..ImportOptions::default()
        };
        Recorded { pixels, log, options }
    }

    fn import(mut self) -> Result<Imported, String> {
        let folder = tempfile::tempdir().unwrap();
        let mut files: Vec<PathBuf> = Vec::new();
        for (run, frames) in self.pixels.iter().enumerate() {
            let mut text = String::from("frame,a_x,a_y,b_x,b_y,c_x,c_y\n");
            for (k, [a, b, c]) in frames.iter().enumerate() {
                let cells = [a[0], a[1], b[0], b[1], c[0], c[1]].map(|v| format!("{v:.2}"));
                writeln!(text, "{k},{}", cells.join(",")).unwrap();
            }
            files.push(folder.path().join(format!("run{}.csv", run + 1)));
            std::fs::write(&files[run], text).unwrap();
        }
        let log: String = self.log.iter().map(|[t, body, act]| format!("{t:.2},{body:.3},{act:.3}\n")).collect();
        let path = folder.path().join("log.csv");
        std::fs::write(&path, format!("time_s,p_body_kpa,p_act_kpa\n{log}")).unwrap();
        self.options.pressure_logs = vec![path];
        let made = import(&files, &self.options, &mut |_, _| ());
        made.map_err(|error| format!("{} | {}", error.message(), error.help()))
    }

    /// Changes places of a run from a time on.
    fn shift(&mut self, run: usize, from_s: f64, change: impl Fn(usize, [f64; 2]) -> [f64; 2]) {
        let frames = self.pixels[run].iter_mut().skip((from_s * FPS) as usize);
        frames.for_each(|places| (0..3).for_each(|marker| places[marker] = change(marker, places[marker])));
    }

    fn freeze(&mut self, from_s: f64, to_s: f64) {
        let [from, to] = [from_s, to_s].map(|t| (t * FPS) as usize);
        let still = self.pixels[0][from];
        self.pixels[0][from..to].fill(still);
    }
}

/// A robot that bends evenly, 4 % more on its way back, seen by a camera that is set up anew for every run.
fn film(dice: &mut Dice, frames: usize) -> Vec<[[f64; 2]; 3]> {
    let gain = 1.0 + 0.02 * dice.normal();
    let [dx, dy, roll] = [dice.normal(), dice.normal(), 4e-3 * dice.normal()];
    let mut bend = 0.0;
    let mut place = |k: usize| {
        let t = k as f64 / FPS;
        let way_back = if t > 20.0 { 1.04 } else { 1.0 };
        bend += (gain * way_back * 1.2 * pressure_kpa(t) / 30.0 - bend) * (1.0 / FPS / 0.2);
        let kappa = (bend / 360.0_f64).max(1e-9);
        STATIONS_MM.map(|s| {
            let [x, y] = [(kappa * s).sin() / kappa, (1.0 - (kappa * s).cos()) / kappa];
            let [x, y] = [x - roll * y + dx + 0.4 * dice.normal(), y + roll * x + dy + 0.4 * dice.normal()];
            [212.0 + 3.1 * x, 540.0 - 3.1 * y]
        })
    };
    (0..frames).map(&mut place).collect()
}

/// What is slipped, how, and words of what is printed.
type Slip = (&'static str, fn(&mut Recorded), &'static str);

const SLIPS: [Slip; 30] = [
    ("camera frozen for two holds", |r| r.freeze(9.0, 19.9), "stand still"),
    ("camera frozen for 8 s", |r| r.freeze(11.0, 19.0), "stand still"),
    ("camera frozen within a hold", |r| r.freeze(11.5, 14.0), "stand still"),
    (
        "outer marker on the background",
        |r| r.shift(1, 0.0, |m, p| if m == 2 { [1100.3, 310.0] } else { p }),
        "background",
    ),
    (
        "middle marker on the background",
        |r| r.shift(0, 6.0, |m, p| if m == 1 { [850.0, 470.0] } else { p }),
        "background",
    ),
    (
        "marker on the background from half way",
        |r| r.shift(0, 17.0, |m, p| if m == 2 { [1000.0, 250.0] } else { p }),
        "background",
    ),
    ("camera knocked in a hold", |r| r.shift(0, 17.5, |_, p| [p[0] + 40.0, p[1] + 45.0]), "all markers step"),
    ("camera knocked on a ramp", |r| r.shift(2, 15.2, |_, p| [p[0], p[1] + 60.0]), "all markers step"),
    ("camera knocked by 8 mm", |r| r.shift(1, 22.0, |_, p| [p[0] - 25.0, p[1]]), "all markers step"),
    ("camera elsewhere in one run", |r| r.shift(1, 0.0, |_, p| [p[0] + 60.0, p[1]]), "elsewhere"),
    ("camera higher in one run", |r| r.shift(2, 0.0, |_, p| [p[0], p[1] + 45.0]), "elsewhere"),
    (
        "camera zoomed in one run",
        |r| r.shift(0, 0.0, |_, p| [212.0 + 1.05 * (p[0] - 212.0), 540.0 + 1.05 * (p[1] - 540.0)]),
        "zoom",
    ),
    (
        "camera zoomed about the middle",
        |r| r.shift(1, 0.0, |_, p| [600.0 + 0.95 * (p[0] - 600.0), 400.0 + 0.95 * (p[1] - 400.0)]),
        "zoom",
    ),
    ("log 3 % fast", |r| r.log.iter_mut().for_each(|row| row[0] *= 1.03), "--clock-offset find"),
    ("log 3 % slow", |r| r.log.iter_mut().for_each(|row| row[0] *= 0.97), "--clock-offset find"),
    ("log 1 s late", |r| r.log.iter_mut().for_each(|row| row[0] += 1.0), "--clock-offset find"),
    ("log 1.5 s early", |r| r.log.iter_mut().for_each(|row| row[0] -= 1.5), "--clock-offset find"),
    ("typed offset of a hold", |r| r.options.offset = Offset::Given(5.0), "--clock-offset find"),
    ("typed offset of 2 s", |r| r.options.offset = Offset::Given(-2.0), "--clock-offset find"),
    ("30 frames per second typed for 25", |r| r.options.frames_per_s = Some(30.0), "frames per second (6 of 6"),
    ("20 frames per second typed for 25", |r| r.options.frames_per_s = Some(20.0), "frames per second (6 of 6"),
    ("log with whole seconds", |r| r.log.iter_mut().for_each(|row| row[0] = row[0].floor()), "too coarse"),
    ("8 s missing in the log", |r| r.log.retain(|row| !(8.0..16.0).contains(&row[0])), "no readings from"),
    ("4 s missing in the log", |r| r.log.retain(|row| !(13.0..17.0).contains(&row[0])), "no readings from"),
    ("body's sensor not connected", |r| r.log.iter_mut().for_each(|row| row[1] = 0.0), "body"),
    (
        "body falls from 2 to 0.3 kPa",
        |r| r.log.iter_mut().for_each(|row| row[1] = 2.0 - 1.7 * row[0] / 35.0),
        "body has 0.",
    ),
    ("base in millimetres", |r| r.options.base = Some(FilePlace::At(vec![212.0 / 3.1, 540.0 / 3.1])), "--base"),
    ("a station twice", |r| stations(r, [90.0, 210.0, 210.0]), "one station"),
    ("a wrong station", |r| stations(r, [90.0, 150.0, 330.0]), "by their stations"),
    ("a copied run", |r| r.pixels[2] = r.pixels[0].clone(), "identical"),
];

fn stations(recorded: &mut Recorded, stations_mm: [f64; 3]) {
    recorded.options.stations_m =
        ["a", "b", "c"].map(String::from).into_iter().zip(stations_mm.map(|s| 1e-3 * s)).collect();
}

#[test]
fn every_slip_is_refused_with_its_name() {
    let mut silent = Vec::new();
    for (name, slip, words) in SLIPS {
        for seed in 1..4 {
            let mut recorded = Recorded::new(seed);
            slip(&mut recorded);
            match recorded.import() {
                Err(said) if said.contains(words) => println!("{name}: {said}"),
                said => silent.push(format!("{name}, {seed}: {:?}", said.map(|made| made.told))),
            }
        }
    }
    assert!(silent.is_empty(), "{}", silent.join("\n"));
}

#[test]
fn right_recordings_are_imported_and_their_tables_have_no_doubt() {
    let mut refused = Vec::new();
    let known = ["one body pressure", "robust", "no bending test"];
    for seed in 100..300 {
        match Recorded::new(seed).import() {
            Err(said) => refused.push(said),
            Ok(made) => {
                assert_eq!(made.dataset.holds.len(), LEVELS.len());
                let report = data::check(&made.dataset, Some(&made.about));
                assert!(
                    report.warnings.iter().all(|word| known.iter().any(|known| word.contains(known))),
                    "{:?}",
                    report.warnings
                );
            }
        }
    }
    println!("{} of 200 right recordings refused", refused.len());
    assert!(refused.len() <= 1, "{refused:?}");
}
