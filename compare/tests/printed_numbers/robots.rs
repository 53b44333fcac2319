//! Made-up robots: positions by the model, scatter between runs added by formula.

use data::{About, Dataset, Hold, Lost, Marker, Phase};
use models::{Loads, Model, Scenario, Step};

/// Bending stiffness of the scenarios as given \[N·m²\].
pub(crate) const BENDING: f64 = 1.0;

/// Text of the scenario of every test.
pub(crate) fn text() -> String {
    let text = models::shipped("epam-textbook").unwrap();
    let given = text.replace("bending_stiffness_nm2 = 0 ", &format!("bending_stiffness_nm2 = {BENDING} "));
    assert_ne!(given, text);
    given
}

pub(crate) fn scenario() -> Scenario {
    Scenario::parse(&text()).unwrap()
}

/// Holds at body and actuator pressures \[Pa\], with samples a second apart.
pub(crate) fn holds(pressures: &[[f64; 2]], samples: usize) -> Vec<Hold> {
    let hold = |(i, [p_body_pa, p_act_pa]): (usize, &[f64; 2])| Hold {
        p_body_pa: *p_body_pa,
        p_act_pa: *p_act_pa,
        more_act_pa: Vec::new(),
        phase: if i > 0 && *p_act_pa < pressures[i - 1][1] { Phase::Unload } else { Phase::Load },
        occurrence: 0,
        t_s: (0..samples).map(|t| (i * samples + t + 1) as f64).collect(),
    };
    pressures.iter().enumerate().map(hold).collect()
}

/// Positions of a robot at the holds, their actuator pressures times a factor, in run layout \[m\].
pub(crate) fn positions(robot: &Scenario, holds: &[Hold], factor: f64) -> Vec<f64> {
    let step = |hold: &Hold, t_s: f64| Step { t_s, loads: Loads::uniform(hold.p_body_pa, factor * hold.p_act_pa) };
    let steps: Vec<Step> = holds.iter().flat_map(|hold| hold.t_s.iter().map(move |t| step(hold, *t))).collect();
    let model = Model::new(robot);
    let mut seen = Vec::new();
    model.follow(&steps, &mut model.prediction(), &mut |_, at| seen.extend(at.markers.iter().flatten())).unwrap();
    seen
}

/// Curvature at pressures \[1/m\]: the robot is uniform.
pub(crate) fn curvature(robot: &Scenario, p_body_pa: f64, p_act_pa: f64) -> f64 {
    let model = Model::new(robot);
    let mut at = model.prediction();
    model.predict(&Loads::uniform(p_body_pa, p_act_pa), &mut at).unwrap();
    model.states(&at)[0].curvature
}

/// What a robot misses where it is held at a curvature \[N·m\].
pub(crate) fn missing_moment(robot: &Scenario, p_body_pa: f64, p_act_pa: f64, curvature: f64) -> f64 {
    let model = Model::new(robot);
    let step = Step { t_s: 0.0, loads: Loads::uniform(p_body_pa, p_act_pa) };
    let (held, mut missing) = (vec![curvature; model.segments().len()], 0.0);
    model.hold(&[step], &[held], &mut model.prediction(), &mut |_, at| missing = at.missing_moments()[0]).unwrap();
    missing
}

/// Normal numbers without a package: sums of twelve uniform ones.
struct Normal(u64);

impl Normal {
    fn next(&mut self) -> f64 {
        let mut uniform = || {
            self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (self.0 >> 11) as f64 / (1_u64 << 53) as f64
        };
        (0..12).map(|_| uniform()).sum::<f64>() - 6.0
    }
}

/// Runs of a robot at the holds.
pub(crate) fn scattered(truth: &Scenario, name: &str, holds: &[Hold], runs: usize, seed: u64) -> Dataset {
    let at = |factor: f64| positions(truth, holds, factor);
    let slope: Vec<f64> = at(1.0 + 1e-4).iter().zip(at(1.0 - 1e-4)).map(|(high, low)| (high - low) / 2e-4).collect();
    measured(name, holds, (&at(1.0), &slope), runs, seed)
}

/// Runs of given positions `truth_m` with camera noise, shifts of the camera and, along `slope_m` = ∂f/∂ln p, errors of the pressure.
fn measured(name: &str, holds: &[Hold], (truth_m, slope_m): (&[f64], &[f64]), runs: usize, seed: u64) -> Dataset {
    let (camera_m, shift_m, pressure) = (1.2e-3, 0.3e-3, 0.01);
    let mut normal = Normal(seed);
    let mut coordinates_m = Vec::new();
    for _ in 0..runs {
        let of_run = [shift_m * normal.next(), shift_m * normal.next(), pressure * normal.next()];
        let values = truth_m.iter().zip(slope_m).enumerate();
        coordinates_m.extend(values.map(|(i, (f, d))| f + of_run[i % 2] + of_run[2] * d + camera_m * normal.next()));
    }
    Dataset { coordinates_m, runs: (1..=runs).map(|run| run.to_string()).collect(), ..exact(name, holds, truth_m) }
}

pub(crate) fn exact(name: &str, holds: &[Hold], truth_m: &[f64]) -> Dataset {
    let marker = |(i, s): (usize, &f64)| Marker { name: (i + 1).to_string(), station_m: Some(*s) };
    Dataset {
        name: name.into(),
        actuator: "epam".into(),
        runs: vec!["1".into()],
        holds: holds.to_vec(),
        markers: scenario().markers_m.iter().enumerate().map(marker).collect(),
        samples_per_hold: holds[0].t_s.len(),
        coordinates_m: truth_m.to_vec(),
        axes: 2,
        gauge_pa: None,
        lost: Lost::default(),
        pressure_units: data::IN_KPA,
        told: Vec::new(),
    }
}

/// An `about.toml` with these lines more.
pub(crate) fn about(lines: &str) -> About {
    let text =
        format!("title = \"made up\"\nprovenance = \"synthetic\"\nsource = \"test\"\nlicence = \"CC0-1.0\"\n{lines}");
    data::parse_about("about.toml", &text).unwrap()
}
