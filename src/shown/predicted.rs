//! Text and JSON of predicted states, `ibr.predict`.

use crate::prelude::*;
use ::sweep::PRESSURE;
use data::Column;
use ibr::{AtPressure, PressureInterval};
use models::assembly::Segment;
use models::space::SectionState;
use models::{Beyond, CHANNELS, End, GasVolumes, Limit, Prediction, Row, Steered, TipSlope, TipStiffness};

/// Text of predicted states as the command prints it: pressures, tip and warnings.
pub fn text(scenario: &Scenario, states: &[AtPressure]) -> String {
    let is_spatial = scenario.is_spatial();
    let tip = |s: &AtPressure| s.prediction.tip;
    let states = || states.iter();
    // With all channels moved together.
    let slope = |s: &AtPressure| s.slopes.iter().map(|slope| slope.y_per_pa).sum::<f64>();
    let mut out =
        format!("{} at body pressure {} kPa{}\n", scenario.name, scenario.p_body_pa / 1e3, wall_words(scenario));
    out += &TextTable::of(states())
        .right("P [kPa]", |s| pressure_words(&s.loads))
        .number("tip x [mm]", 2, |s| tip(s).x_m * 1e3)
        .number("tip y [mm]", 2, |s| tip(s).y_m * 1e3)
        .when(is_spatial, |table| table.number("tip z [mm]", 2, |s| tip(s).z_m * 1e3))
        .number("angle [deg]", 3, |s| tip(s).angle_rad.to_degrees())
        .right("dy/dP [mm/kPa]", |s| slope_words(slope(s) * 1e6))
        .text();
    if scenario.markers_m.is_empty() {
        return out;
    }
    let axes = if is_spatial { "x, y, z" } else { "x, y" };
    let mut markers =
        TextTable::of(scenario.markers_m.iter().enumerate()).number("marker at s [mm]", 1, |(_, s)| **s * 1e3);
    for state in states() {
        markers = markers.right(format!("{axes} [mm] at {} kPa", pressure_words(&state.loads)), |(i, _)| {
            let [x, y] = state.prediction.markers[*i].map(|v| v * 1e3);
            let z = state.prediction.markers_z_m[*i] * 1e3;
            if is_spatial { format!("{x:.2}, {y:.2}, {z:.2}") } else { format!("{x:.2}, {y:.2}") }
        });
    }
    out + &markers.text()
}

/// For other programs: a row per pressure, with columns named as in a sweep.
pub fn columns(scenario: &Scenario, states: &[AtPressure]) -> data::Table {
    let axes = if scenario.is_spatial() { &["x", "y", "z"][..] } else { &["x", "y"] };
    let of = |value: &dyn Fn(&AtPressure) -> f64| Column::F64(states.iter().map(value).collect());
    let mut columns = Vec::new();
    let all_alike = states.iter().all(|s| s.loads.actuator_pa.iter().all(|pa| *pa == s.loads.actuator_pa[0]));
    match all_alike {
        true => columns.push((PRESSURE.to_string(), of(&|s| s.loads.actuator_pa[0] / 1e3))),
        false => {
            columns.extend((0..CHANNELS).map(|c| (format!("{PRESSURE}.{c}"), of(&|s| s.loads.actuator_pa[c] / 1e3))))
        }
    }
    for (k, axis) in axes.iter().enumerate() {
        let tip = |s: &AtPressure| [s.prediction.tip.x_m, s.prediction.tip.y_m, s.prediction.tip.z_m][k] * 1e3;
        columns.push((format!("tip_{axis}_mm"), of(&tip)));
    }
    columns.push(("tip_angle_deg".into(), of(&|s| s.prediction.tip.angle_rad.to_degrees())));
    for m in 0..scenario.markers_m.len() {
        for (k, axis) in axes.iter().enumerate() {
            let place = |s: &AtPressure| s.prediction.markers[m].get(k).unwrap_or(&s.prediction.markers_z_m[m]) * 1e3;
            columns.push((format!("marker_{}_{axis}_mm", m + 1), of(&place)));
        }
    }
    data::Table { columns }
}

/// A slope; none where a pouch is flat.
fn slope_words(mm_per_kpa: f64) -> String {
    if mm_per_kpa.is_nan() { "-".into() } else { format!("{mm_per_kpa:.3}") }
}

fn wall_words(scenario: &Scenario) -> String {
    let wall = &scenario.wall;
    let part = |name: &str, value: Option<f64>| value.map(|v| format!(", {name} {v:.0} N/m"));
    let parts = [part("E t", wall.stiffness_n_per_m), part("G t", wall.shear_n_per_m)];
    let parts: String = parts.into_iter().flatten().collect();
    if parts.is_empty() { parts } else { format!("{parts} ({})", wall.basis) }
}

/// `ibr.predict`: `ibr predict SCENARIO`
#[derive(Serialize)]
pub struct PredictAnswer<'a> {
    /// Path or name of the scenario as typed
    pub scenario: &'a str,
    /// Name of the robot in the scenario
    pub name: &'a str,
    /// Kind of the actuator, `epam` for example
    pub actuator: &'a str,
    /// Names of the effects in the model
    pub effects: Vec<&'a str>,
    /// Predicted states, one for each pressure
    pub states: Vec<PredictedState>,
    /// With `--inverse X,Y`: what became of the place
    #[serde(skip_serializing_if = "Option::is_none")]
    pub nearest: Option<NearestPlace>,
    /// With `--inverse` of one number: the pressures over the intervals of numbers that were not measured
    #[serde(skip_serializing_if = "Option::is_none")]
    pub pressure_interval: Option<&'a PressureInterval>,
}

/// Shape, tip and markers at one set of pressures, as JSON.
#[derive(Serialize)]
pub struct PredictedState {
    /// Actuator pressure of channel 0, the only one of most robots
    pub p_act_kpa: f64,
    /// Actuator pressure of every channel, in their order
    pub p_act_channels_kpa: Vec<f64>,
    /// Body pressure at which the state is predicted
    pub p_body_kpa: f64,
    /// Markers as the camera sees them
    pub markers: Vec<PredictedMarker>,
    /// Pose of the centre line's end
    pub tip: PredictedTip,
    /// Curvature of every segment, base to tip
    pub curvature_per_m: Vec<f64>,
    /// Segments of constant curvature, base to tip
    pub segments: Vec<Segment>,
    /// Change of the tip with the pressure of each channel
    pub jacobian: Vec<TipSlope>,
    /// Gas of every channel and, last, of the body, with slopes by their pressures; null where one has no slope
    pub volumes: Option<GasVolumes>,
    /// How the tip gives way to a force; null where it has no slope
    pub tip_stiffness: Option<TipStiffness>,
    /// Energies at equilibrium, a row per term
    pub ledger: Vec<Row>,
    /// Stretches that the robot would not hold
    pub beyond: Vec<Beyond>,
    /// Bend and contraction of every segment, with strips round the body
    #[serde(skip_serializing_if = "Option::is_none")]
    pub sections: Option<Vec<SpaceSection>>,
}

/// A marker as the camera sees it.
#[derive(Serialize)]
pub struct PredictedMarker {
    /// Station along the undeformed body, from the base
    pub s_mm: f64,
    /// Coordinate along the straight robot, from the base
    pub x_mm: f64,
    /// Coordinate across it, towards the actuator
    pub y_mm: f64,
    /// Towards azimuth 90°, with strips round the body
    #[serde(skip_serializing_if = "Option::is_none")]
    pub z_mm: Option<f64>,
}

/// Pose of the tip in the frame of the clamp, as JSON.
#[derive(Serialize)]
pub struct PredictedTip {
    /// Coordinate along the straight robot, from the base
    pub x_mm: f64,
    /// Coordinate across it, towards the actuator
    pub y_mm: f64,
    /// Towards azimuth 90°, with strips round the body
    #[serde(skip_serializing_if = "Option::is_none")]
    pub z_mm: Option<f64>,
    /// Total bending angle from base to tip
    pub angle_deg: f64,
}

/// A section of a robot with strips round the body.
#[derive(Serialize)]
pub struct SpaceSection {
    /// Segment of the body, as keys of this object
    #[serde(flatten)]
    pub segment: Segment,
    /// Bend towards azimuth 0° and 90° of a frame that follows the body without twist
    pub curvature_yz_per_m: [f64; 2],
    /// Contraction of the axis, positive where it shortens
    pub contraction: f64,
    /// Tension along every strip, in the order of the scenario
    pub tension_n: Vec<f64>,
}

impl PredictedState {
    /// Converts the state to a JSON object.
    pub fn json(&self) -> serde_json::Value {
        // Keys are texts: nothing here can fail.
        serde_json::to_value(self).unwrap_or_default()
    }

    /// Of a model and its scenario.
    pub fn of(model: &Model, scenario: &Scenario, s: &AtPressure) -> PredictedState {
        let (at, is_spatial) = (&s.prediction, model.is_spatial());
        let z_mm = |z_m: f64| is_spatial.then_some(z_m * 1e3);
        let marker = |(i, s_m): (usize, &f64)| {
            let [x_mm, y_mm] = at.markers[i].map(|m| m * 1e3);
            PredictedMarker { s_mm: s_m * 1e3, x_mm, y_mm, z_mm: at.markers_z_m.get(i).copied().and_then(z_mm) }
        };
        let section = |section: SectionState| SpaceSection {
            segment: section.segment,
            curvature_yz_per_m: section.kappa,
            contraction: section.contraction,
            tension_n: section.strips.iter().map(|strip| strip.tension).collect(),
        };
        let (segments, curvature_per_m) = model.curvatures(at).unzip();
        let mut out = model.prediction();
        PredictedState {
            p_act_kpa: s.loads.actuator_pa[0] / 1e3,
            p_act_channels_kpa: s.loads.actuator_pa.iter().map(|p| p / 1e3).collect(),
            p_body_kpa: s.loads.body_pa / 1e3,
            markers: scenario.markers_m.iter().enumerate().map(marker).collect(),
            tip: PredictedTip {
                x_mm: at.tip.x_m * 1e3,
                y_mm: at.tip.y_m * 1e3,
                z_mm: z_mm(at.tip.z_m),
                angle_deg: at.tip.angle_rad.to_degrees(),
            },
            curvature_per_m,
            segments,
            jacobian: s.slopes.to_vec(),
            volumes: model.volumes(&s.loads, &mut out).ok(),
            tip_stiffness: model.tip_stiffness(&s.loads, &mut out).ok(),
            ledger: model.ledger(&s.loads, at),
            beyond: model.beyond(&s.loads, at),
            sections: is_spatial.then(|| model.sections(at).map(section).collect()),
        }
    }
}

/// A note for every stretch of a pose that the robot would not hold.
pub fn beyond_words(model: &Model, loads: &Loads, at: &Prediction) -> Vec<String> {
    let words = |beyond: Beyond| {
        let (from, to) = (beyond.start_m * 1e3, (beyond.start_m + beyond.length_m) * 1e3);
        let what = match beyond.limit {
            Limit::Collapse => {
                "the moment of the loads is {} times what the wall and the pull can carry, and the body folds"
            }
            Limit::Fold => "κR is {}: the body is bent about its own axis",
            Limit::Crossing => "the body runs into itself: 2R is {} times the distance of its centre lines",
        };
        let what = what.replace("{}", &format!("{:.2}", beyond.share));
        format!("warning: {} kPa, s = {from:.0} to {to:.0} mm: {what}; do not trust this pose", pressure_words(loads))
    };
    model.beyond(loads, at).into_iter().map(words).collect()
}

/// A note if a pressure exceeds the scenario's largest.
pub fn above_limit(scenario: &Scenario, loads: &[Loads]) -> Option<String> {
    let highest = loads.iter().flat_map(|loads| loads.actuator_pa).fold(0.0, f64::max);
    let limit = scenario.p_max_pa;
    (highest > limit)
        .then(|| format!("warning: {} kPa is above max_pressure_kpa = {} of the scenario", highest / 1e3, limit / 1e3))
}

/// A tip that is nearer than this is on target \[m\].
const MET_M: f64 = 1e-6;

fn held(found: &Steered) -> impl Iterator<Item = (usize, &'static str, f64)> + '_ {
    found.held.iter().enumerate().filter_map(|(channel, end)| {
        let word = match (*end)? {
            End::Least => "least",
            End::Most => "largest",
        };
        Some((channel, word, found.loads.actuator_pa[channel] / 1e3))
    })
}

/// What became of the target place of the tip.
#[derive(Serialize)]
pub struct NearestPlace {
    /// Target coordinate of the tip along the straight robot
    pub x_mm: f64,
    /// Target coordinate of the tip across it
    pub y_mm: f64,
    /// Distance of the tip from the place
    pub miss_mm: f64,
    /// Channels whose limit keeps the tip away
    pub held_back: Vec<ChannelLimit>,
}

/// Supply channel whose pressure is at a limit, as JSON.
#[derive(Serialize)]
pub struct ChannelLimit {
    /// Number of the supply channel, from 0
    pub channel: usize,
    /// Which limit the pressure is at: `least` or `largest`
    pub limit: &'static str,
    /// Pressure of the channel, which is its limit
    pub p_kpa: f64,
}

impl NearestPlace {
    /// Names the limits that keep the robot from a place \[m\], and the remaining distance.
    pub fn of(place_m: [f64; 2], found: &Steered) -> NearestPlace {
        let [x_mm, y_mm] = place_m.map(|m| m * 1e3);
        let held_back = held(found).map(|(channel, limit, p_kpa)| ChannelLimit { channel, limit, p_kpa }).collect();
        NearestPlace { x_mm, y_mm, miss_mm: found.miss_m * 1e3, held_back }
    }
}

pub(crate) fn nearest_words(place_m: [f64; 2], found: &Steered) -> Option<String> {
    let words: Vec<String> = held(found)
        .map(|(channel, limit, kpa)| format!("channel {channel} is at its {limit} pressure, {kpa} kPa"))
        .collect();
    let why = if words.is_empty() { "no pressures bring it nearer".to_string() } else { words.join("; ") };
    let [x, y] = place_m.map(|m| m * 1e3);
    (found.miss_m > MET_M)
        .then(|| format!("warning: the tip stays {:.2} mm from the target {x}, {y} mm: {why}", found.miss_m * 1e3))
}
