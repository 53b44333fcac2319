//! Slips of a recording with the noise of a laboratory: each is refused or printed when it is imported, and right recordings are imported.

use data::import::{FileAxis, FilePlace, ImportOptions, Imported, Offset, Scale, import};
use std::fmt::Write as _;
use std::path::PathBuf;

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

/// A robot, its protocol and its camera.
#[derive(Clone)]
struct Take {
    robot: fn(f64) -> f64,
    fps: f64,
    hold_s: f64,
    levels: Vec<f64>,
    /// Scatter of a place from frame to frame \[mm\].
    noise_mm: f64,
}

/// Proportional, concave, with a threshold, and saturating.
const ROBOTS: [fn(f64) -> f64; 4] = [
    |kpa| 1.2 * kpa / 30.0,
    |kpa| 1.3 * (kpa / 30.0).sqrt(),
    |kpa| 2.2 * (kpa - 3.0).max(0.0) / (kpa + 20.0),
    |kpa| 1.3 * (kpa / 15.0).tanh(),
];

fn usual() -> Take {
    let levels = vec![0.0, 10.0, 20.0, 30.0, 20.0, 10.0, 0.0];
    Take { robot: ROBOTS[0], fps: FPS, hold_s: 5.0, levels, noise_mm: 0.3 }
}

const FPS: f64 = 25.0;

/// Three videos in pixels, 3.1 to a millimetre, base at 212, 540, y down; and a pressure log for all.
struct Recorded {
    /// `[run][frame][marker]`, NaN where a marker was lost.
    pixels: Vec<Vec<[[f64; 2]; 3]>>,
    /// Time, body and actuator pressure \[kPa\].
    log: Vec<[f64; 3]>,
    options: ImportOptions,
}

impl Take {
    fn pressure_kpa(&self, t_s: f64) -> f64 {
        let k = ((t_s / self.hold_s).max(0.0) as usize).min(self.levels.len() - 1);
        let before = self.levels[k.saturating_sub(1)];
        before + (self.levels[k] - before) * ((t_s - k as f64 * self.hold_s) / 0.5).clamp(0.0, 1.0)
    }

    fn record(&self, seed: u64) -> Recorded {
        let mut dice = Dice(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15));
        let pixels = (0..3).map(|_| self.film(&mut dice)).collect();
        let readings = (self.hold_s * self.levels.len() as f64 / 0.05) as u32;
        let log = (0..readings).map(|k| 0.05 * f64::from(k));
        let log = log.map(|t| [t, 2.0 + 0.02 * dice.normal(), self.pressure_kpa(t) + 0.05 * dice.normal()]).collect();
        let options = ImportOptions {
            scale: Scale::PixelsPerMetre(3100.0),
            base: Some(FilePlace::At(vec![212.0, 540.0])),
            frames_per_s: Some(self.fps),
            actuator: Some("epam".into()),
            ..ImportOptions::default()
        };
        Recorded { pixels, log, options }
    }

    /// A robot that bends evenly, 4 % more on its way back. The regulator scatters by 2 % from run to run and the bend by 1 % from hold to hold;
    /// the camera is set up for every run and moves by 0.3 mm from hold to hold; markers are off by 0.5 mm through a run; noise is white, and
    /// half as large as AR(1); in one frame of two hundred a marker is lost for five frames.
    fn film(&self, dice: &mut Dice) -> Vec<[[f64; 2]; 3]> {
        let gain = 1.0 + 0.02 * dice.normal();
        let [dx, dy, roll] = [dice.normal(), dice.normal(), 4e-3 * dice.normal()];
        let holds: Vec<[f64; 3]> = self
            .levels
            .iter()
            .map(|_| [1.0 + 0.01 * dice.normal(), 0.3 * dice.normal(), 0.3 * dice.normal()])
            .collect();
        let lasting = [0; 3].map(|_| [0.5 * dice.normal(), 0.5 * dice.normal()]);
        let highest = (0..self.levels.len()).max_by(|a, b| self.levels[*a].total_cmp(&self.levels[*b])).unwrap();
        let (mut bend, mut slow, mut lost) = (0.0, [[0.0; 2]; 3], [0; 3]);
        let frames = (self.hold_s * self.levels.len() as f64 * self.fps) as usize;
        let mut places = |k: usize| {
            let t = k as f64 / self.fps;
            let hold = ((t / self.hold_s) as usize).min(holds.len() - 1);
            let [own, ox, oy] = holds[hold];
            let way_back = if hold > highest { 1.04 } else { 1.0 };
            let target = gain * own * way_back * (self.robot)(self.pressure_kpa(t));
            bend += (target - bend) * (1.0 / self.fps / 0.2).min(1.0);
            let kappa = (bend / 360.0_f64).max(1e-9);
            [0, 1, 2].map(|m| {
                let s = STATIONS_MM[m];
                let [x, y] = [(kappa * s).sin() / kappa, (1.0 - (kappa * s).cos()) / kappa];
                (0..2).for_each(|axis| slow[m][axis] = 0.9 * slow[m][axis] + 0.2 * self.noise_mm * dice.normal());
                let off = [0, 1].map(|axis| lasting[m][axis] + slow[m][axis] + self.noise_mm * dice.normal());
                lost[m] = if dice.normal() > 2.6 { 5 } else { i32::max(lost[m] - 1, 0) };
                if lost[m] > 0 {
                    return [f64::NAN; 2];
                }
                [212.0 + 3.1 * (x - roll * y + dx + ox + off[0]), 540.0 - 3.1 * (y + roll * x + dy + oy + off[1])]
            })
        };
        (0..frames).map(&mut places).collect()
    }
}

impl Recorded {
    fn import(mut self) -> Result<Imported, String> {
        let folder = tempfile::tempdir().unwrap();
        let mut files: Vec<PathBuf> = Vec::new();
        for (run, frames) in self.pixels.iter().enumerate() {
            let mut text = String::from("frame,a_x,a_y,b_x,b_y,c_x,c_y\n");
            for (k, places) in frames.iter().enumerate() {
                let cell = |v: &f64| if v.is_nan() { String::new() } else { format!("{v:.2}") };
                let cells: Vec<String> = places.iter().flatten().map(cell).collect();
                writeln!(text, "{k},{}", cells.join(",")).unwrap();
            }
            files.push(folder.path().join(format!("run{}.csv", run + 1)));
            std::fs::write(&files[run], text).unwrap();
        }
        let log: String = self.log.iter().map(|[t, body, act]| format!("{t:.4},{body:.3},{act:.3}\n")).collect();
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

    /// Repeats the first frame of a time in the rest of it, for some of the markers.
    fn freeze(&mut self, run: usize, markers: std::ops::Range<usize>, [from_s, to_s]: [f64; 2]) {
        let [from, to] = [from_s, to_s].map(|t| (t * FPS) as usize);
        for marker in markers {
            let seen =
                self.pixels[run][..=from].iter().rev().map(|frame| frame[marker]).find(|place| !place[0].is_nan());
            self.pixels[run][from..to].iter_mut().for_each(|frame| frame[marker] = seen.unwrap());
        }
    }

    /// A spot of the background that the tracker takes for a marker from a time on, with its own noise.
    fn spot(&mut self, run: usize, marker: usize, from_s: f64, place: [f64; 2]) {
        let mut dice = Dice(17);
        let frames = self.pixels[run].iter_mut().skip((from_s * FPS) as usize);
        frames.for_each(|frame| frame[marker] = place.map(|v| v + 0.8 * dice.normal()));
    }

    fn swap(&mut self, run: usize, from_s: f64) {
        self.pixels[run].iter_mut().skip((from_s * FPS) as usize).for_each(|frame| frame.swap(1, 2));
    }

    /// Turns by an angle and zooms about the middle of the picture.
    fn turn(&mut self, run: usize, from_s: f64, angle: f64, zoom: f64) {
        let (sin, cos) = angle.sin_cos();
        self.shift(run, from_s, |_, [x, y]| {
            let [x, y] = [zoom * (x - 640.0), zoom * (y - 360.0)];
            [640.0 + cos * x - sin * y, 360.0 + sin * x + cos * y]
        });
    }

    fn each(&mut self, change: impl Fn(&mut [f64; 3])) {
        self.log.iter_mut().for_each(change);
    }
}

/// What is slipped, how, and words of what is printed; several where noise decides which contradiction is met first.
type Slip = (&'static str, fn(&mut Recorded), &'static str);

/// The slips of laboratories that were seen, then others of their kinds.
const SLIPS: [Slip; 86] = [
    ("camera frozen for two holds", |r| r.freeze(0, 0..3, [9.0, 19.9]), "are frozen"),
    ("camera frozen for 8 s", |r| r.freeze(0, 0..3, [11.0, 19.0]), "are frozen"),
    ("camera frozen within a hold", |r| r.freeze(0, 0..3, [11.5, 14.0]), "are frozen"),
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
    ("log 3 % fast", |r| r.each(|row| row[0] *= 1.03), "--clock-offset find"),
    ("log 3 % slow", |r| r.each(|row| row[0] *= 0.97), "--clock-offset find"),
    ("log 1 s late", |r| r.each(|row| row[0] += 1.0), "--clock-offset find"),
    ("log 1.5 s early", |r| r.each(|row| row[0] -= 1.5), "--clock-offset find"),
    ("typed offset of a hold", |r| r.options.offset = Offset::Given(5.0), "--clock-offset find"),
    ("typed offset of 2 s", |r| r.options.offset = Offset::Given(-2.0), "--clock-offset find"),
    ("30 frames per second typed for 25", |r| r.options.frames_per_s = Some(30.0), "frames per second (6 of 6"),
    ("20 frames per second typed for 25", |r| r.options.frames_per_s = Some(20.0), "frames per second (6 of 6"),
    ("log with whole seconds", |r| r.each(|row| row[0] = row[0].floor()), "too coarse"),
    ("8 s missing in the log", |r| r.log.retain(|row| !(8.0..16.0).contains(&row[0])), "no readings from"),
    ("4 s missing in the log", |r| r.log.retain(|row| !(13.0..17.0).contains(&row[0])), "no readings from"),
    ("body's sensor not connected", |r| r.each(|row| row[1] = 0.0), "body"),
    ("body falls from 2 to 0.3 kPa", |r| r.each(|row| row[1] = 2.0 - 1.7 * row[0] / 35.0), "body has 0."),
    ("base in millimetres", |r| r.options.base = Some(FilePlace::At(vec![212.0 / 3.1, 540.0 / 3.1])), "--base"),
    ("a station twice", |r| stations(r, [90.0, 210.0, 210.0]), "one station"),
    ("a wrong station", |r| stations(r, [90.0, 150.0, 330.0]), "by their stations"),
    ("a copied run", |r| r.pixels[2] = r.pixels[0].clone(), "identical"),
    ("camera frozen at the beginning", |r| r.freeze(1, 0..3, [0.0, 4.0]), "are frozen"),
    ("camera frozen at the end", |r| r.freeze(2, 0..3, [30.5, 35.0]), "are frozen"),
    ("one marker kept for 8 s", |r| r.freeze(0, 1..2, [11.0, 19.0]), "only marker b is frozen"),
    ("the inner marker kept for two holds", |r| r.freeze(1, 0..1, [9.0, 19.9]), "only marker a is frozen"),
    ("the outer marker kept within a hold", |r| r.freeze(2, 2..3, [16.0, 19.0]), "only marker c is frozen"),
    ("a spot for the outer marker", |r| r.spot(2, 2, 0.0, [1100.0, 310.0]), "background"),
    ("a spot for the middle marker", |r| r.spot(0, 1, 6.0, [850.0, 470.0]), "background"),
    ("a spot for the outer marker from half way", |r| r.spot(1, 2, 17.5, [1000.0, 250.0]), "background"),
    (
        "the inner marker on the background",
        |r| r.shift(0, 0.0, |m, p| if m == 0 { [490.0, 525.0] } else { p }),
        "begins beyond it",
    ),
    ("a spot for the inner marker", |r| r.spot(0, 0, 0.0, [490.0, 525.0]), "begins beyond it"),
    ("a spot near the base for the inner marker", |r| r.spot(1, 0, 0.0, [300.0, 540.0]), "run 2: at rest the markers"),
    (
        "the outer label goes to the middle marker",
        |r| r.pixels[0].iter_mut().skip(440).for_each(|frame| frame[2] = frame[1]),
        "marker c jumps|does not follow",
    ),
    ("labels exchanged in a hold", |r| r.swap(0, 17.5), "labels are exchanged|does not follow"),
    ("labels exchanged on a ramp", |r| r.swap(1, 15.2), "labels are exchanged"),
    ("labels exchanged in one run", |r| r.swap(1, 0.0), "labels are exchanged"),
    ("camera turned by 4 degrees in a hold", |r| r.turn(0, 17.5, 0.07, 1.0), "jump"),
    ("camera turned by 6 degrees in the last hold", |r| r.turn(2, 32.6, -0.105, 1.0), "jump"),
    ("camera zoomed by 6 % in a hold", |r| r.turn(1, 17.5, 0.0, 1.06), "jump"),
    (
        "a marker slid by 20 mm",
        |r| r.shift(0, 18.0, |m, p| if m == 1 { [p[0] + 62.0, p[1]] } else { p }),
        "marker b jumps",
    ),
    ("camera knocked by 7 mm", |r| r.shift(0, 13.0, |_, p| [p[0], p[1] - 22.0]), "camera"),
    ("camera turned by 5 degrees in one run", |r| r.turn(1, 0.0, 0.087, 1.0), "run 2: at rest"),
    ("camera elsewhere by 12 mm", |r| r.shift(0, 0.0, |_, p| [p[0], p[1] - 37.0]), "elsewhere"),
    ("camera zoomed by 3.5 % in one run", |r| r.turn(2, 0.0, 0.0, 1.035), "zoom"),
    ("one run mirrored", |r| r.shift(1, 0.0, |_, p| [p[0], 1080.0 - p[1]]), "another way than in the other runs"),
    ("log 5 % fast", |r| r.each(|row| row[0] *= 1.05), "--clock-offset find"),
    ("log 8 % slow", |r| r.each(|row| row[0] *= 0.92), "--clock-offset find"),
    ("log 2 s late", |r| r.each(|row| row[0] += 2.0), "--clock-offset find"),
    ("log 3 s early", |r| r.each(|row| row[0] -= 3.0), "--clock-offset find"),
    ("log a hold late", |r| r.each(|row| row[0] += 5.0), "--clock-offset find"),
    ("log two holds late", |r| r.each(|row| row[0] += 10.0), "--clock-offset find"),
    ("typed offset of 1 s", |r| r.options.offset = Offset::Given(1.0), "--clock-offset find"),
    ("typed offset of two holds", |r| r.options.offset = Offset::Given(-10.0), "--clock-offset find"),
    ("24 frames per second typed for 25", |r| r.options.frames_per_s = Some(24.0), "frames per second (6 of 6"),
    ("50 frames per second typed for 25", |r| r.options.frames_per_s = Some(50.0), "frames per second"),
    ("3 s cut out of the video", |r| drop(r.pixels[0].drain(410..485)), "changes of pressure have their movement"),
    ("log with times of 2 s", |r| r.each(|row| row[0] = 2.0 * (row[0] / 2.0).floor()), "too coarse"),
    ("minutes read as seconds", |r| r.each(|row| row[0] /= 60.0), "pressure|move by 0"),
    ("milliseconds read as seconds", |r| r.each(|row| row[0] *= 1000.0), "pressure"),
    ("12 s missing in the log", |r| r.log.retain(|row| !(12.0..24.5).contains(&row[0])), "at one pressure"),
    ("logger repeats a reading for 7 s", |r| repeated(r, 8.0, 15.0), "repeated its last reading"),
    ("logger repeats a reading for 4 s", |r| repeated(r, 21.0, 25.0), "repeated its last reading"),
    ("body in bar", |r| r.each(|row| row[1] *= 0.01), "body has 0.02 kPa"),
    ("body without pressure from half way", |r| r.each(|row| row[1] *= f64::from(row[0] < 17.0)), "body has 0.00 kPa"),
    ("pressures exchanged", |r| r.each(|row| row.swap(1, 2)), "the actuator's pressure stays between"),
    ("actuator in bar", |r| r.each(|row| row[2] *= 0.01), "the actuator's pressure stays between"),
    ("absolute pressures", |r| r.each(|row| *row = [row[0], row[1] + 101.3, row[2] + 101.3]), "absolute"),
    ("base in centimetres", |r| base(r, [212.0 / 31.0, 540.0 / 31.0]), "--base"),
    ("base at the origin", |r| base(r, [0.0, 0.0]), "--base"),
    ("base with x and y exchanged", |r| base(r, [540.0, 212.0]), "--base"),
    ("stations counted from the tip", |r| stations(r, [270.0, 150.0, 30.0]), "by its station"),
    ("stations in centimetres", |r| stations(r, [9.0, 21.0, 33.0]), "by their stations"),
    ("stations counted from a flange", |r| stations(r, [150.0, 270.0, 390.0]), "by its station"),
    ("scale per centimetre", |r| scaled(r, 310.0), "station"),
    ("scale per metre", |r| scaled(r, 3.1), "no robot has this size"),
    ("a copied run of another crop", |r| r.pixels[1] = moved(&r.pixels[0], [37.0, -12.0]), "identical"),
    ("axes exchanged", |r| r.options.axes = Some([axis(1, true), axis(0, false)]), "degrees to the file's"),
];

fn axis(index: usize, turned: bool) -> FileAxis {
    FileAxis { index, turned }
}

fn moved(frames: &[[[f64; 2]; 3]], by: [f64; 2]) -> Vec<[[f64; 2]; 3]> {
    frames.iter().map(|frame| frame.map(|place| [place[0] + by[0], place[1] + by[1]])).collect()
}

fn repeated(recorded: &mut Recorded, from_s: f64, to_s: f64) {
    let [from, to] = [from_s, to_s].map(|t| (t / 0.05) as usize);
    let kept = recorded.log[from][2];
    recorded.log[from..to].iter_mut().for_each(|row| row[2] = kept);
}

fn base(recorded: &mut Recorded, at: [f64; 2]) {
    recorded.options.base = Some(FilePlace::At(at.to_vec()));
}

fn scaled(recorded: &mut Recorded, per_metre: f64) {
    stations(recorded, STATIONS_MM);
    recorded.options.scale = Scale::PixelsPerMetre(per_metre);
}

fn stations(recorded: &mut Recorded, stations_mm: [f64; 3]) {
    recorded.options.stations_m =
        ["a", "b", "c"].map(String::from).into_iter().zip(stations_mm.map(|s| 1e-3 * s)).collect();
}

/// The table slip by slip; none is silent.
#[test]
fn every_slip_is_refused_or_printed_with_its_name() {
    let mut silent = Vec::new();
    for (name, slip, words) in SLIPS {
        for seed in 1..4 {
            let mut recorded = usual().record(seed);
            slip(&mut recorded);
            let said = match recorded.import() {
                Ok(made) => made.told.join("; "),
                Err(said) => said,
            };
            match words.split('|').find(|words| said.contains(words)) {
                Some(_) if seed == 1 => println!("| {name} | {} |", said.split(" | ").next().unwrap_or_default()),
                Some(_) => (),
                None => silent.push(format!("{name}, {seed}: {said}")),
            }
        }
    }
    println!("{} slips, {} silent", SLIPS.len(), silent.len());
    assert!(silent.is_empty(), "{}", silent.join("\n"));
}

/// Robots, frame rates, protocols and noise of 240 recordings.
#[test]
fn right_recordings_are_imported_and_their_tables_have_no_doubt() {
    let (mut refused, mut doubted) = (Vec::new(), Vec::new());
    let known = ["one body pressure", "robust", "no bending test", "have no position", "no unloading branch"];
    let protocols: [&[f64]; 4] = [
        &[0.0, 10.0, 20.0, 30.0, 20.0, 10.0, 0.0],
        &[0.0, 5.0, 10.0, 15.0, 20.0, 25.0, 30.0],
        &[0.0, 4.0, 8.0, 12.0, 16.0, 12.0, 8.0, 4.0, 0.0],
        &[0.0, 30.0, 10.0, 20.0, 0.0],
    ];
    for seed in 0..240 {
        let of = |step: usize, count: usize| seed as usize / step % count;
        let take = Take {
            robot: ROBOTS[of(1, 4)],
            fps: [15.0, 25.0, 30.0, 60.0][of(4, 4)],
            hold_s: [4.0, 5.0, 7.5][of(16, 3)],
            levels: protocols[of(48, 4)].to_vec(),
            noise_mm: [0.05, 0.1, 0.3, 0.6, 1.0][of(1, 5)],
        };
        match take.record(100 + seed).import() {
            Err(said) => refused.push(format!("{seed}: {said}")),
            Ok(made) => {
                assert_eq!(made.dataset.holds.len(), take.levels.len(), "{seed}: {:?}", made.told);
                assert!(made.told.iter().all(|told| !told.contains("background")), "{seed}: {:?}", made.told);
                let report = data::check(&made.dataset, Some(&made.about));
                let is_known = |word: &String| known.iter().any(|known| word.contains(known));
                doubted.extend(
                    report.warnings.iter().filter(|word| !is_known(word)).map(|word| format!("{seed}: {word}")),
                );
            }
        }
    }
    println!("{} of 240 right recordings refused", refused.len());
    assert!(refused.len() <= 1 && doubted.len() <= 1, "{}\n{}", refused.join("\n"), doubted.join("\n"));
}
