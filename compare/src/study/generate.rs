//! Synthetic marker data: a scenario's prediction with the scatter of a real test.
//!
//! Per run: one relative pressure error, one shift of the camera, one roll of the camera. Per hold, as [`HoldScatter`] states: the same
//! three, and an error of every marker that lasts through the hold. Per sample: camera noise. The recorded pressure is the set one, as
//! a regulator reports it. Seeded: the same call gives the same bytes, and scatter per hold changes no other draw.

use super::eye::SimulatedCamera;
pub use super::eye::{Generator, HoldScatter, NormalNumbers};
use crate::error::CompareError;
use data::{About, Dataset, Direct, Geometry, Hold, Marker, MarkerStation, Phase, Provenance};
use models::{CHANNELS, Loads, Model, Moment, Prediction, Scenario, Step, Supply};
use spelling::units::Range;

/// Reads a protocol like `0,10,20,30,0@2; 0,20,40,60,0@4`: actuator pressures in kPa at a body pressure in kPa.
///
/// # Errors
/// Texts that are not of that form, or pressures out of their bounds.
pub fn parse_protocol(text: &str) -> Result<Vec<[f64; 2]>, CompareError> {
    let holds = parse_channels(text)?;
    if holds.iter().any(|(_, channels)| channels.len() > 1) {
        let problem = "one actuator pressure is possible here, not one for each channel".to_string();
        return Err(CompareError::BadProtocol { text: text.to_string(), problem });
    }
    Ok(holds.into_iter().map(|(body, channels)| [body, channels[0]]).collect())
}

impl Generator {
    /// The same with a protocol like `0/0,10/0,10/20@2`, in which a slash separates supply channels.
    ///
    /// # Errors
    /// As [`parse_protocol`]; holds with different numbers of channels.
    pub fn with_protocol(self, text: &str) -> Result<Generator, CompareError> {
        let holds = parse_channels(text)?;
        if let Some((_, other)) = holds.iter().find(|(_, channels)| channels.len() != holds[0].1.len()) {
            let problem = format!("holds have {} and {} channels", holds[0].1.len(), other.len());
            return Err(CompareError::BadProtocol { text: text.to_string(), problem });
        }
        let several = holds[0].1.len() > 1;
        let protocol = holds.iter().map(|(body, channels)| [*body, channels[0]]).collect();
        let more = holds.into_iter().map(|(_, channels)| channels[1..].to_vec());
        Ok(Generator { protocol, more_act_pa: more.filter(|_| several).collect(), ..self })
    }

    /// Pressures of a hold, the actuators' times a factor.
    pub fn loads(&self, hold: usize, factor: f64) -> Loads {
        let [body_pa, act_pa] = self.protocol[hold];
        let more = self.more_act_pa.get(hold).map_or(&[][..], Vec::as_slice);
        in_channels(body_pa, std::iter::once(act_pa).chain(more.iter().copied()).map(|p| p * factor))
    }
}

/// Loads of pressures by channel; one is for all.
pub(super) fn in_channels(body_pa: f64, channels_pa: impl Iterator<Item = f64>) -> Loads {
    let given: Vec<f64> = channels_pa.take(CHANNELS).collect();
    if let [only] = given[..] {
        return Loads::uniform(body_pa, only);
    }
    let mut actuator_pa = [0.0; CHANNELS];
    actuator_pa[..given.len()].copy_from_slice(&given);
    Loads { body_pa, actuator_pa }
}

/// Body pressure and channel pressures, hold by hold \[Pa\].
fn parse_channels(text: &str) -> Result<Vec<(f64, Vec<f64>)>, CompareError> {
    let bad = |problem: &str| CompareError::BadProtocol { text: text.to_string(), problem: problem.to_string() };
    let number = |word: &str, bounds: &Range| match word.trim().parse::<f64>() {
        Ok(kpa) => bounds.si(bounds.name, kpa).map_err(|(message, help)| bad(&format!("{message}; {help}"))),
        Err(_) => Err(bad(&format!("`{}` is not a number", word.trim()))),
    };
    let mut holds = Vec::new();
    for part in text.split(';').filter(|part| !part.trim().is_empty()) {
        let (pressures, body) = part.split_once('@').ok_or_else(|| bad("a body pressure is missing (after `@`)"))?;
        let body = number(body, &Range::BODY_PRESSURE)?;
        for p in pressures.split(',') {
            let channels: Vec<f64> =
                p.split('/').map(|p| number(p, &Range::ACTUATOR_PRESSURE)).collect::<Result<_, _>>()?;
            if channels.len() > CHANNELS {
                return Err(bad(&format!("there are {CHANNELS} supply channels")));
            }
            holds.push((body, channels));
        }
    }
    if holds.is_empty() { Err(bad("it has no hold")) } else { Ok(holds) }
}

/// Makes a dataset from a scenario.
///
/// # Errors
/// No marker stations in the scenario, or a hold without equilibrium.
pub fn generate(scenario: &Scenario, name: &str, generator: &Generator) -> Result<Dataset, CompareError> {
    if scenario.markers_m.is_empty() {
        return Err(CompareError::NoStation { marker: "1".into(), needed: 1, found: 0 });
    }
    let model = Model::new(scenario);
    let mut state = model.prediction();
    let mut eye = SimulatedCamera::new(generator, generator.protocol.len());
    let (supply, mut manometer) = (Supply::of(scenario), Manometer::new(generator.seed));
    let (mut coordinates_m, mut gauge_pa) = (Vec::new(), Vec::new());
    for _ in 0..generator.runs {
        let gains = eye.next_run();
        if model.is_spatial() {
            eye.tilt();
        }
        for (i, (set_pa, at)) in held(&holds(generator)).into_iter().enumerate() {
            gauge_pa.push(manometer.read(supply.pressure(gains[i / generator.samples] * set_pa, &at)));
        }
        if model.has_history() {
            let mut each = |_: usize, at: &Prediction| eye.look_at(at, model.is_spatial(), &mut coordinates_m);
            model.follow(&steps(generator, &gains), &mut state, &mut each)?;
            continue;
        }
        for (hold, gain) in gains.into_iter().enumerate() {
            model.predict(&generator.loads(hold, gain), &mut state)?;
            for _ in 0..generator.samples {
                eye.look_at(&state, model.is_spatial(), &mut coordinates_m);
            }
        }
    }
    Ok(Dataset {
        name: name.to_string(),
        actuator: scenario.actuator.kind.name.to_string(),
        runs: (1..=generator.runs).map(|r| r.to_string()).collect(),
        holds: holds(generator),
        markers: markers(scenario),
        samples_per_hold: generator.samples,
        axes: if model.is_spatial() { 3 } else { 2 },
        coordinates_m,
        gauge_pa: generator.gauge.then_some(gauge_pa),
        lost: data::Lost::default(),
        pressure_units: data::IN_KPA,
        told: Vec::new(),
    })
}

/// Set pressure of every sample \[Pa\], and for how long it has been held \[s\]; the time between two holds belongs to the
/// second, and a clock that jumps back starts again, as in [`Model::follow`].
pub fn held(holds: &[Hold]) -> Vec<(f64, Moment)> {
    let (mut end_s, mut before_pa, mut falling) = (0.0, 0.0, false);
    let mut all = Vec::new();
    for hold in holds {
        let begin_s = if hold.t_s.first().is_some_and(|t| *t < end_s) { 0.0 } else { end_s };
        if begin_s == 0.0 {
            (before_pa, falling) = (0.0, false);
        }
        if hold.p_act_pa != before_pa {
            (falling, before_pa) = (hold.p_act_pa < before_pa, hold.p_act_pa);
        }
        let at = |t_s: &f64| Moment { held_s: t_s - begin_s, t_s: *t_s, falling, s_m: 0.0 };
        all.extend(hold.t_s.iter().map(|t_s| (hold.p_act_pa, at(t_s))));
        end_s = hold.t_s.last().copied().unwrap_or(end_s);
    }
    all
}

/// A small digital gauge: one error of its zero and of its gain, and scatter of every reading.
pub struct Manometer {
    scatter: NormalNumbers,
    zero_pa: f64,
    gain: f64,
}

impl Manometer {
    /// Standard deviations of zero \[Pa\], gain \[-\] and reading \[Pa\].
    const SD: [f64; 3] = [100.0, 0.003, 50.0];

    /// A gauge whose zero, gain and noise follow from the seed.
    pub fn new(seed: u64) -> Manometer {
        // Other numbers than the camera's, which are the same with and without a gauge.
        let mut scatter = NormalNumbers::new(seed ^ 0x6A06E);
        let (zero_pa, gain) = (Self::SD[0] * scatter.normal(), 1.0 + Self::SD[1] * scatter.normal());
        Manometer { scatter, zero_pa, gain }
    }

    /// What it shows at a pressure \[Pa\].
    pub fn read(&mut self, p_pa: f64) -> f64 {
        self.gain * p_pa + self.zero_pa + Self::SD[2] * self.scatter.normal()
    }
}

/// The protocol of one run whose actuator pressures are off by a factor in every hold.
fn steps(generator: &Generator, gains: &[f64]) -> Vec<Step> {
    let of_hold = |(index, hold): (usize, Hold)| {
        let loads = generator.loads(index, gains[index]);
        hold.t_s.into_iter().map(move |t_s| Step { t_s, loads })
    };
    holds(generator).into_iter().enumerate().flat_map(of_hold).collect()
}

/// The markers of a scenario, counted from 1.
pub fn markers(scenario: &Scenario) -> Vec<Marker> {
    let marker = |(i, s): (usize, &f64)| Marker { name: (i + 1).to_string(), station_m: Some(*s) };
    scenario.markers_m.iter().enumerate().map(marker).collect()
}

/// The holds of a protocol, with the times of their samples.
pub fn holds(generator: &Generator) -> Vec<Hold> {
    let mut holds: Vec<Hold> = Vec::new();
    for (i, [p_body_pa, p_act_pa]) in generator.protocol.iter().enumerate() {
        let more_act_pa = generator.more_act_pa.get(i).cloned().unwrap_or_default();
        let sum_pa = p_act_pa + more_act_pa.iter().sum::<f64>();
        let before = holds.last().map_or(0.0, Hold::sum_act_pa);
        let phase = if i == 0 || sum_pa > before {
            Phase::Load
        } else if sum_pa < before {
            Phase::Unload
        } else {
            Phase::Hold
        };
        let alike = |h: &&Hold| {
            let same = h.p_body_pa == *p_body_pa && h.p_act_pa == *p_act_pa && h.more_act_pa == more_act_pa;
            same && h.phase == phase
        };
        let occurrence = holds.iter().filter(alike).count();
        let step = generator.hold_s / generator.samples as f64;
        let t_s = (0..generator.samples).map(|k| i as f64 * generator.hold_s + (k + 1) as f64 * step).collect();
        holds.push(Hold { p_body_pa: *p_body_pa, p_act_pa: *p_act_pa, more_act_pa, phase, occurrence, t_s });
    }
    holds
}

/// Title, source, licence and geometry of generated data.
pub fn about(scenario: &Scenario, dataset: &Dataset, g: &Generator) -> About {
    let shape = &scenario.actuator.shape;
    let stations = dataset.markers.iter().zip(&scenario.markers_m);
    About {
        // The name of a practice set's robot can be the answer.
        title: format!("Synthetic markers of a robot with {} actuators; truth.toml describes it", dataset.actuator),
        provenance: Provenance::Synthetic,
        source: format!("ibr data generate, seed {}", g.seed),
        licence: "CC0-1.0".into(),
        actuator: Some(dataset.actuator.clone()),
        geometry: Some(Geometry {
            body_radius_m: scenario.radius_m,
            body_length_m: scenario.length_m,
            pouch_length_m: Some(shape.length_m),
            pouch_width_m: Some(shape.width_m),
            pouches: Some(scenario.actuator.count),
            fold_m: (shape.fold_m > 0.0).then_some(shape.fold_m),
            arm_m: scenario.actuator.arm_m,
        }),
        markers: stations.map(|(m, s)| MarkerStation { name: m.name.clone(), station_m: *s }).collect(),
        gravity_direction: None,
        direct: Direct::default(),
        bending_nm2: None,
        measured: Vec::new(),
        runs: vec![],
        notes: Some(format!(
            "Not a measurement. Camera noise {} mm per coordinate; run to run: pressure {} %, alignment {} mm, rotation {} mrad. \
             The recorded pressures are the set ones.",
            g.camera_sd_m * 1e3,
            g.pressure_sd * 100.0,
            g.alignment_sd_m * 1e3,
            g.rotation_sd * 1e3
        )),
    }
}
