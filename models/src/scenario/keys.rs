//! The keys of a scenario: name, unit, range, meaning, and the value that a scenario has.
//!
//! The reader takes its names and ranges from here, and so do its errors, `--set`, sweeps, wishes, the sliders of the page and
//! `docs/scenario.md`. `[effects]` and `[[formula]]` have the catalogue's keys.

use super::stated::Scenario;
use crate::Text;
use crate::term::CHANNELS;
use spelling::units::Range;
use std::f64::consts::PI;

/// One key of the scenario text, with its unit, range and meaning.
#[derive(Debug, Clone, Copy)]
pub struct Key {
    /// Tables in which it may stand; first the one that it is described for.
    pub tables: &'static [Text],
    /// Name with its unit, as in the text.
    pub name: &'static str,
    /// Accepted numbers; `None` of a word or a list.
    pub range: Option<Range>,
    /// Meaning in a few words, for documents, messages and sliders.
    pub meaning: &'static str,
    /// Its number in SI, in the first of its tables.
    field: Option<NumberAccess>,
}

/// A number of a scenario, read and set.
#[derive(Debug, Clone, Copy)]
struct NumberAccess {
    get: fn(&Scenario) -> f64,
    set: fn(&mut Scenario, f64),
    is_whole: bool,
}

/// The field of a number, and the field of a whole number.
macro_rules! field {
    ($($part:ident).+) => { NumberAccess { get: |s| s.$($part).+, set: |s, si| s.$($part).+ = si, is_whole: false } };
    (whole $($part:ident).+) => {
        NumberAccess { get: |s| s.$($part).+ as f64, set: |s, si| s.$($part).+ = si as usize, is_whole: true }
    };
}

impl Key {
    /// Its number in the unit of the text; `None` without one.
    pub fn value(&self, scenario: &Scenario) -> Option<f64> {
        Some((self.field?.get)(scenario) * (1.0 / self.range?.si))
    }

    /// Sets its number, in the unit of the text; `None` without one, out of its range, or where it has to be a whole number.
    pub(super) fn set(&self, scenario: &mut Scenario, number: f64, is_whole: bool) -> Option<()> {
        let field = self.field.filter(|field| is_whole || !field.is_whole)?;
        (field.set)(scenario, self.range?.si("", number).ok()?);
        Some(())
    }

    /// Its place in the text, as `body.radius_mm`.
    pub fn place(&self) -> String {
        format!("{}.{}", self.tables[0], self.name)
    }
}

/// The key of that name in a table.
pub fn key(table: &str, name: &str) -> Option<&'static Key> {
    KEYS.iter().find(|key| key.name == name && key.tables.contains(&table))
}

pub(super) fn names(table: &str) -> Vec<&'static str> {
    KEYS.iter().filter(|key| key.tables.contains(&table)).map(|key| key.name).collect()
}

/// Whether a place in the text moves no predicted pose, whatever its value: names, remarks, growth, and what acts in time alone.
pub fn moves_nothing(place: &str) -> bool {
    let key = place.rsplit('.').next().unwrap_or(place);
    let is_remark = REMARKS.contains(&key) && place.starts_with("effects.");
    is_remark
        || matches!(place, "name" | "notes" | "body.wall_basis")
        || ["supply.", "growth."].iter().any(|table| place.starts_with(table))
}

/// Words that may stand next to the parameters of an effect: how they are known.
pub(super) const REMARKS: &[&str] = &["basis", "interval", "data", "date", "note"];

const fn number(tables: &'static [Text], name: Text, range: Range, meaning: Text, field: NumberAccess) -> Key {
    let (range, field) = (Some(range), Some(field));
    Key { tables, name, range, meaning, field }
}

const fn other(tables: &'static [Text], name: Text, range: Option<Range>, meaning: Text) -> Key {
    Key { tables, name, range, meaning, field: None }
}

/// Accepted numbers with their factor to SI, and the advice below and above them.
const fn range(name: Text, unit: Text, si: f64, [low, high]: [f64; 2], [too_small, too_large]: [Text; 2]) -> Range {
    Range { name, unit, si, low, high, too_small, too_large }
}

const BODY: &[&str] = &["body"];
const BODY_OR_ZONE: &[&str] = &["body", "zone"];
const ACTUATOR: &[&str] = &["actuator"];
const STRIP: &[&str] = &["actuator", "strip"];
const UNIT: &[&str] = &["actuator", "strip", "zone"];
const ZONE: &[&str] = &["zone"];
const SUPPLY: &[&str] = &["supply"];
const GROWTH: &[&str] = &["growth"];
const LENGTH: Range = Range::LENGTH;
pub(super) const POSITION: Range =
    Range { name: "position", low: 0.0, too_small: "positions count from the base", ..LENGTH };
pub(super) const SEGMENTS: Range = Range { name: "segments", ..Range::plain(1.0, 2000.0, "12 is the usual value") };
const DEGREE: f64 = PI / 180.0;
const WALL: &str = "write N/m, for example 40000 for 200 MPa x 0.2 mm";

/// All keys of the tables, in the order of the document.
#[rustfmt::skip]
pub const KEYS: &[Key] = &[
    number(BODY_OR_ZONE, "radius_mm", Range { name: "radius", high: 1000.0, ..LENGTH }, "radius R of the inflated body", field!(radius_m)),
    number(BODY, "length_mm", LENGTH, "length L from clamp to tip", field!(length_m)),
    number(BODY, "pressure_kpa", Range::BODY_PRESSURE, "body pressure p_b", field!(p_body_pa)),
    number(BODY_OR_ZONE, "bending_stiffness_nm2", range("bending stiffness", "N m²", 1.0, [0.0, 1e3], [
        "a stiffness is not negative", "write N·m²; 1 N·m² is 1e6 N·mm²",
    ]), "effective bending stiffness B", field!(bending_stiffness)),
    number(BODY, "hinge_curvature_per_m", range("hinge curvature", "1/m", 1.0, [1e-6, 10.0], [
        "it must be positive; 0.05 is the usual value", "write 1/m; 0.05 is the usual value",
    ]), "curvature over which the restoring moment sets in", field!(hinge_curvature)),
    number(BODY, "hinge_moment_share", Range {
        name: "hinge moment share", ..Range::plain(0.0, 2.0, "1 is the collapse moment πp_bR³, 0.5 the first wrinkle")
    }, "restoring moment of the base law over πp_bR³", field!(hinge_share)),
    other(BODY, "wall_stiffness_n_per_m", Some(range("wall stiffness", "N/m", 1.0, [100.0, 1e8], [
        "this looks like N/mm: write N/m, for example 40000 for 200 MPa x 0.2 mm", WALL,
    ])), "membrane stiffness E t of the wall"),
    other(BODY, "wall_shear_n_per_m", Some(range("wall shear stiffness", "N/m", 1.0, [0.0, 1e8], ["a stiffness is not negative", WALL])),
        "shear stiffness G t of the wall"),
    other(BODY, "wall_basis", None, "how the two are known"),
    other(BODY, "centre_line_mm", Some(POSITION), "distance of the centre line from the taut generator"),
    other(BODY, "gravity", None, "direction of gravity in x–y, with strips round the body in x–y–z"),
    other(ACTUATOR, "kind", None, "kind of the actuator"),
    number(UNIT, "length_mm", LENGTH, "flat length of one unit", field!(actuator.shape.length_m)),
    number(UNIT, "width_mm", LENGTH, "flat width of one unit", field!(actuator.shape.width_m)),
    number(STRIP, "count", Range { name: "count", ..Range::plain(1.0, 10_000.0, "units in series") }, "units in series",
        field!(whole actuator.count)),
    number(STRIP, "start_mm", POSITION, "station of the first unit", field!(actuator.start_m)),
    other(UNIT, "arm_mm", Some(LENGTH), "arm from the taut generator to the line of action"),
    number(UNIT, "fold_mm", POSITION, "depth of a lateral gusset fold", field!(actuator.shape.fold_m)),
    number(STRIP, "volume_gain", Range { name: "volume gain", ..Range::plain(0.05, 20.0, "1 is the plain pouch") },
        "factor on the enclosed volume", field!(actuator.shape.volume_gain)),
    number(ACTUATOR, "bias_deg", range("bias angle", "deg", DEGREE, [15.0, 75.0], [
        "write degrees from the axis; a bias cut has 45", "write degrees from the axis; a muscle with yarns beyond 54.7 lengthens",
    ]), "angle of a muscle's yarns to its axis", field!(actuator.shape.bias_rad)),
    number(UNIT, "channel", Range { name: "channel", ..Range::plain(0.0, (CHANNELS - 1) as f64, "number of the supply line") },
        "supply line that feeds it", field!(whole actuator.channel)),
    number(ACTUATOR, "max_pressure_kpa", Range { low: 0.001, too_small: "the inverse looks up to it", ..Range::ACTUATOR_PRESSURE },
        "largest pressure an inverse may ask for", field!(p_max_pa)),
    number(STRIP, "azimuth_deg", range("azimuth", "deg", DEGREE, [-360.0, 360.0], ["write degrees from y towards z: 90 is z"; 2]),
        "azimuth of the strip's start", field!(actuator.azimuth_rad)),
    number(STRIP, "turns", Range { name: "turns", ..Range::plain(-20.0, 20.0, "write turns round the body from start to end") },
        "turns round the body from start to end", field!(actuator.turns)),
    other(ZONE, "from_mm", Some(POSITION), "start of the stretch"),
    other(ZONE, "to_mm", Some(POSITION), "end of the stretch"),
    other(ZONE, "passive", None, "whether the stretch has no actuator"),
    other(&["markers"], "s_mm", Some(Range::STATION), "stations of the markers"),
    other(&["predict"], "pressures_kpa", Some(Range::ACTUATOR_PRESSURE), "actuator pressures of a prediction"),
    number(&["predict"], "segments", SEGMENTS, "division of the body where something varies along it", field!(whole segments)),
    other(SUPPLY, "valve_time_s", Some(range("valve time", "s", 1.0, [0.0, 60.0], [
        "0 is a valve without lag", "write seconds: 0.05 for 50 ms",
    ])), "time constant of valve or regulator"),
    // dm³/(s·bar) in m³/(s·Pa).
    other(SUPPLY, "conductance_l_per_s_bar", Some(range("conductance", "l/(s bar)", 1e-8, [1e-4, 1e3], [
        "write litres per second and bar (ISO 6358), for example 0.1"; 2
    ])), "sonic conductance of valve and tube"),
    other(SUPPLY, "volume_ml", Some(range("volume", "ml", 1e-6, [0.01, 1e6], [
        "write millilitres of actuator and tube, for example 400"; 2
    ])), "volume that is filled"),
    other(SUPPLY, "critical_ratio", Some(Range { name: "critical ratio", ..Range::plain(0.0, 0.8, "0.2 to 0.5 are usual") }),
        "ratio of pressures below which the flow is choked"),
    other(GROWTH, "tip_force_n", Some(range("tip force", "N", 1.0, [0.0, 1e4], [
        "a force is not negative", "write newtons: half of the pressure at which it halts, times the area of the tube",
    ])), "half of pressure times area at which a straight tube halts"),
    other(GROWTH, "break_away_n", Some(range("break-away force", "N", 1.0, [0.0, 1e4], [
        "a force is not negative", "write newtons: half of the pressure at which it starts, times the area of the tube",
    ])), "half of pressure times area at which it starts from rest"),
    other(GROWTH, "friction", Some(Range { name: "friction", ..Range::plain(0.0, 2.0, "0.1 to 0.5 are usual for films and coated fabric") }),
        "coefficient of friction of the tail on the wall"),
    other(GROWTH, "tail_weight_n_per_m", Some(range("tail weight", "N/m", 1.0, [0.0, 100.0], [
        "a weight is not negative", "write N/m: 0.2 for 20 g per metre",
    ])), "weight of the tail per length"),
    other(GROWTH, "base_tension_n", Some(range("base tension", "N", 1.0, [0.0, 1e4], [
        "a spool does not push the tail", "write newtons",
    ])), "pull of the spool on the tail at the base"),
    other(GROWTH, "speed_at_1n_m_per_s", Some(range("speed", "m/s", 1.0, [1e-6, 100.0], [
        "leave it out where the speed is not known", "write metres per second: 0.05 for 50 mm/s",
    ])), "speed of the tip at a force of 1 N beyond the halt"),
    other(GROWTH, "exponent", Some(Range { name: "exponent", ..Range::plain(0.1, 10.0, "1 is a speed in proportion to the force") }),
        "power of the force beyond the halt in the speed"),
];
