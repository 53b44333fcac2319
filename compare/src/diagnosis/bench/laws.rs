//! What may be missing on a bench: effects of the catalogue, and numbers of the scenario that are usually not known.

use crate::bench::Trial;
use crate::diagnosis::candidates::{Candidate, Free, has, hold, hold_shapes, of_catalogue};
use data::Bench;
use models::Scenario;
use models::effects::{Effect, Fitted, Group, Stage};

struct BenchNumber {
    /// Kind of bench table in which the number acts.
    table: &'static str,
    name: &'static str,
    key: &'static str,
    symbol: &'static str,
    unit: &'static str,
    si: f64,
    typical: f64,
    bounds: [f64; 2],
    starts: &'static [f64],
    group: Group,
    words: [&'static str; 3],
    /// The value that a scenario has, SI.
    given: fn(&Scenario) -> Option<f64>,
    set: fn(&mut Trial, f64),
}

/// The list: one entry a number. Bounds equal the bounds of a scenario's keys, as far as fabrics reach.
const NUMBERS: &[BenchNumber] = &[
    BenchNumber {
        table: "load_deflection",
        name: "wall_stiffness",
        key: "wall_stiffness_n_per_m",
        symbol: "E t",
        unit: "N/m",
        si: 1.0,
        typical: 1e5,
        bounds: [1e3, 1e7],
        starts: &[3e3, 1e4, 3e4, 3e5, 1e6],
        group: Group::Body,
        words: [
            "The wall stretches along the body, and softens as it buckles and creases.",
            "More deflection at every load, and a curve that bends over before collapse.",
            "Take E t of the body's fabric from a tensile test along the body.",
        ],
        given: |s| s.wall.stiffness_n_per_m,
        set: |trial, v| trial.scenario.wall.stiffness_n_per_m = Some(v),
    },
    BenchNumber {
        table: "load_deflection",
        name: "wall_shear",
        key: "wall_shear_n_per_m",
        symbol: "G t",
        unit: "N/m",
        si: 1.0,
        typical: 1e3,
        bounds: [10.0, 1e6],
        starts: &[50.0, 200.0, 5e3, 3e4],
        group: Group::Body,
        words: [
            "A transverse load shears the wall, and the body with it.",
            "More deflection in proportion to the load, most in short beams.",
            "Take G t of the body's fabric from a 45° tensile test, or load beams of two lengths.",
        ],
        given: |s| s.wall.shear_n_per_m,
        set: |trial, v| trial.scenario.wall.shear_n_per_m = Some(v),
    },
    BenchNumber {
        table: "load_deflection",
        name: "bending_stiffness",
        key: "bending_stiffness_nm2",
        symbol: "B",
        unit: "N·m²",
        si: 1.0,
        typical: 1.0,
        bounds: [0.0, 1e3],
        starts: &[0.1, 10.0, 100.0],
        group: Group::Body,
        words: [
            "Something elastic holds the body in addition to the pressure: folds, glue, a liner.",
            "Less deflection, most beyond the collapse load of the pressure.",
            "Load the body at two pressures: what does not grow with pressure is B.",
        ],
        given: |s| (s.bending_stiffness > 0.0).then_some(s.bending_stiffness),
        set: |trial, v| trial.scenario.bending_stiffness = v,
    },
    BenchNumber {
        table: "force_contraction",
        name: "bias_angle",
        key: "bias_deg",
        symbol: "α₀",
        unit: "deg",
        si: std::f64::consts::PI / 180.0,
        typical: 27.0,
        bounds: [15.0, 53.0],
        starts: &[20.0, 35.0, 45.0],
        group: Group::Actuator,
        words: [
            "The yarns lie at another angle to the axis than the table or the scenario gives.",
            "Force and stroke are both off: a smaller angle pulls harder and shortens more.",
            "Measure the angle on the muscle without pressure, on a photograph.",
        ],
        given: |s| Some(s.actuator.shape.bias_rad).filter(|bias| bias.is_finite()),
        set: |trial, v| trial.bias_rad = Some(v),
    },
];

/// Where fits of a law start: as of markers, and at the bounds: where a beam has folded no slope leads back.
pub(super) fn starts(law: &Candidate) -> Vec<Vec<f64>> {
    let (mut starts, lead) = (law.starts(), law.lead());
    for bound in [law.parameters[lead].lower, law.parameters[lead].upper] {
        let mut start = law.at(1.0);
        start[lead] = bound;
        starts.push(start);
    }
    starts
}

/// The trial with a law at these values, SI.
pub(super) fn apply(law: &Candidate, trial: &mut Trial, values: &[f64]) {
    let is_own = |number: &&BenchNumber| law.name == number.name && law.parameters[0].key == number.key;
    match NUMBERS.iter().find(is_own) {
        Some(number) => (number.set)(trial, values[0]),
        None => trial.scenario = law.apply(&trial.scenario, values),
    }
}

/// Every law that may act on a table, and which of them are always fitted: numbers that every model needs and that neither table nor
/// scenario gives, and with `refit` the scenario's own.
pub(super) fn laws(bench: &Bench, scenario: &Scenario, refit: bool) -> (Vec<Candidate>, Vec<usize>) {
    let beam = bench.kind.name == "load_deflection";
    // The machine's load is known, and a dial gauge does not see what a camera does to markers.
    let may = |e: &Effect| {
        !["tip_load", "weak_place"].contains(&e.name)
            && e.stage != Stage::Camera
            // A supply that changes in time does not act on a single row.
            && !(e.stage == Stage::Supply && e.history)
            && scenario.actuator.takes(e)
            && (beam || e.needs_actuator())
            && (refit || !has(scenario, e.name))
    };
    let mut laws = of_catalogue(scenario, may);
    let first = bench.rows[0].get("p_body");
    let body_pressures = bench.rows.iter().any(|row| row.get("p_body") != first);
    // A testing machine is the separate test that a design number waits for.
    let parameters = laws.iter_mut().flat_map(|c| &mut c.parameters);
    parameters.filter(|p| p.fitted == Fitted::FromDesign).for_each(|p| p.fitted = Fitted::Always);
    hold(&mut laws, true, body_pressures, &[]);
    // Laws have their usual forms in a table of one quantity.
    hold_shapes(&mut laws);
    for chosen in scenario.effects.iter() {
        laws.iter_mut().filter(|c| c.name == chosen.name).for_each(|c| c.as_given(&chosen.values));
    }
    laws.retain(|candidate| candidate.count() > 0);
    let mut always: Vec<usize> = (0..laws.len()).filter(|i| has(scenario, &laws[*i].name)).collect();
    for number in NUMBERS.iter().filter(|n| n.table == bench.kind.name) {
        let given = (number.given)(scenario);
        let angle_untold =
            number.key == "bias_deg" && given.is_none() && bench.rows.iter().any(|r| r.get("bias").is_none());
        if angle_untold || refit && given.is_some() {
            always.push(laws.len());
        }
        laws.push(number.candidate(given));
    }
    (laws, always)
}

impl BenchNumber {
    fn candidate(&self, given: Option<f64>) -> Candidate {
        let starts = self.starts.iter().map(|v| v * self.si).chain(given);
        let free = Free {
            key: self.key.into(),
            symbol: self.symbol.into(),
            unit: self.unit.into(),
            si: self.si,
            neutral: 0.0,
            typical: self.typical * self.si,
            lower: self.bounds[0] * self.si,
            upper: self.bounds[1] * self.si,
            possible: self.bounds.map(|v| v * self.si),
            starts: starts.collect(),
            fitted: Fitted::Always,
            in_room: false,
            is_held: false,
        };
        Candidate {
            name: self.name.into(),
            removes: None,
            group: self.group,
            stage: Stage::Balance,
            sentence: self.words[0].into(),
            differs: self.words[1].into(),
            remedy: self.words[2].into(),
            parameters: vec![free],
        }
    }
}
