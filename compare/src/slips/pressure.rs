//! Slips of a column: pressures in another unit than its name gives, body and actuator exchanged, absolute for gauge; of a robot in space
//! also supply channels and axes that are exchanged, and an axis that is turned over.
//!
//! Each is exact: a factor from a table of units, an exchange, the pressure of a room. It has no free number, which an effect that
//! imitates it has. What numbers alone show is here ([`by_numbers`]); whether a model fits once a slip is undone is asked by
//! `diagnosis::pressures`.

use crate::policy;
use crate::wording::short;
use data::{Dataset, Hold, is_a_room};
use models::Scenario;
use serde::Serialize;
use spelling::units::{Dimension, units_of};

/// Which of the two kinds of pressure column is meant.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PressureColumn {
    /// `p_act`, with all supply channels where there are several.
    Actuator,
    /// `p_body`, the pressure that keeps the body straight.
    Body,
}

/// What may have happened to the columns of a table.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum PressureSlip {
    /// A column is in another unit than its name gives.
    Unit(PressureColumn, WrongUnit),
    /// The columns of body and actuator pressure are exchanged.
    Exchanged,
    /// A sensor of absolute pressure, in a room of this pressure \[Pa\].
    Absolute(PressureColumn, f64),
    /// Two supply channels are exchanged, given by their numbers.
    Channels([usize; 2]),
    /// Two axes are exchanged, in space.
    Axes([usize; 2]),
    /// An axis is turned over, in space.
    Turned(usize),
}

/// A pressure column in another unit than its name states.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WrongUnit {
    /// What the numbers have to be multiplied by.
    pub factor: f64,
    /// The actual unit and the unit of the column's name, each in words and as the suffix of a column's name.
    units: [[&'static str; 2]; 2],
}

/// Units of pressure gauges and loggers: their symbol, in words, and as the suffix of a column's name.
const UNITS: [[&str; 3]; 4] =
    [["psi", "psi", "psi"], ["mbar", "mbar", "mbar"], ["bar", "bar", "bar"], ["inH2O", "inches of water", "inh2o"]];

fn wrong_units() -> impl Iterator<Item = WrongUnit> {
    UNITS.into_iter().flat_map(|[symbol, words, suffix]| {
        let known = units_of(Dimension::PRESSURE).find(|unit| unit.symbol == symbol);
        let factor = known.map_or(f64::NAN, |unit| 1e-3 * unit.factor());
        let (own, kpa) = ([words, suffix], ["kPa", "kpa"]);
        [WrongUnit { factor, units: [own, kpa] }, WrongUnit { factor: 1.0 / factor, units: [kpa, own] }]
    })
}

const COLUMNS: [PressureColumn; 2] = [PressureColumn::Actuator, PressureColumn::Body];

const AXES: [&str; 3] = ["x", "y", "z"];

/// Convention of the axes in space, printed with a remedy.
const FRAME: &str =
    "x runs from the base along the straight robot, y towards azimuth 0\u{b0}, z towards azimuth 90\u{b0}";

/// All pairs of numbers below `count`, each once.
fn pairs(count: usize) -> impl Iterator<Item = [usize; 2]> {
    (0..count).flat_map(move |one| (one + 1..count).map(move |other| [one, other]))
}

const ROOM_PA: f64 = 101_325.0;

impl PressureColumn {
    fn words(self) -> [&'static str; 2] {
        match self {
            PressureColumn::Actuator => ["actuator", "p_act"],
            PressureColumn::Body => ["body", "p_body"],
        }
    }

    fn pressures(self, hold: &Hold) -> Vec<f64> {
        match self {
            PressureColumn::Actuator => hold.channels_pa().collect(),
            PressureColumn::Body => vec![hold.p_body_pa],
        }
    }

    fn lowest(self, hold: &Hold) -> f64 {
        self.pressures(hold).into_iter().fold(f64::INFINITY, f64::min)
    }

    fn top(self, dataset: &Dataset) -> f64 {
        dataset.holds.iter().flat_map(|hold| self.pressures(hold)).fold(0.0, f64::max)
    }

    fn change(self, hold: &mut Hold, by: impl Fn(f64) -> f64) {
        match self {
            PressureColumn::Actuator => {
                std::iter::once(&mut hold.p_act_pa).chain(&mut hold.more_act_pa).for_each(|pa| *pa = by(*pa));
            }
            PressureColumn::Body => hold.p_body_pa = by(hold.p_body_pa),
        }
    }
}

impl PressureSlip {
    /// Every slip that data may have of a robot whose body has a known pressure \[Pa\].
    pub fn all(dataset: &Dataset, body_pa: f64) -> Vec<PressureSlip> {
        let units = COLUMNS.iter().flat_map(|column| wrong_units().map(|unit| PressureSlip::Unit(*column, unit)));
        let absolute = COLUMNS.iter().filter_map(|column| {
            let lowest = dataset.holds.iter().map(|hold| column.lowest(hold)).fold(f64::INFINITY, f64::min);
            // An actuator is vented now and then, a body hardly ever.
            let room_pa = if *column == PressureColumn::Body { lowest - body_pa } else { lowest };
            is_a_room(room_pa).then_some(PressureSlip::Absolute(*column, room_pa))
        });
        let exchanged = (dataset.more_channels() == 0).then_some(PressureSlip::Exchanged);
        let channels = pairs(dataset.more_channels() + 1).map(PressureSlip::Channels);
        let axes = if dataset.has_z() { dataset.axes } else { 0 };
        let moved = pairs(axes).map(PressureSlip::Axes).chain((0..axes).map(PressureSlip::Turned));
        units.chain(exchanged).chain(absolute).chain(channels).chain(moved).collect()
    }

    /// Whether the numbers alone look like it: the body's are the scenario's pressure in the wrong unit, or the actuator's are beyond its
    /// highest pressure, and within it once the slip is undone.
    pub fn is_in_numbers(&self, dataset: &Dataset, scenario: &Scenario) -> bool {
        let is_told = |hold: &Hold| policy::is_same_ratio(hold.p_body_pa, scenario.p_body_pa);
        if self.is_of_body() {
            return !dataset.holds.iter().any(is_told) && self.undone(dataset).holds.iter().any(is_told);
        }
        if let PressureSlip::Unit(column, _) = self {
            return column.top(dataset) > scenario.p_max_pa && column.top(&self.undone(dataset)) <= scenario.p_max_pa;
        }
        by_numbers(dataset).iter().any(|seen| std::mem::discriminant(seen) == std::mem::discriminant(self))
    }

    /// The data with the slip undone.
    pub fn undone(&self, dataset: &Dataset) -> Dataset {
        let mut mended = dataset.clone();
        let holds = &mut mended.holds;
        let places = mended.coordinates_m.chunks_exact_mut(mended.axes);
        match self {
            PressureSlip::Unit(column, unit) => {
                holds.iter_mut().for_each(|hold| column.change(hold, |pa| pa * unit.factor))
            }
            PressureSlip::Exchanged => {
                holds.iter_mut().for_each(|hold| std::mem::swap(&mut hold.p_act_pa, &mut hold.p_body_pa));
            }
            PressureSlip::Absolute(column, room_pa) => {
                holds.iter_mut().for_each(|hold| column.change(hold, |pa| pa - room_pa));
            }
            PressureSlip::Channels([one, other]) => holds.iter_mut().for_each(|hold| {
                let mut all: Vec<f64> = hold.channels_pa().collect();
                all.swap(*one, *other);
                hold.more_act_pa = all.split_off(1);
                hold.p_act_pa = all[0];
            }),
            PressureSlip::Axes([one, other]) => places.for_each(|place| place.swap(*one, *other)),
            PressureSlip::Turned(axis) => places.for_each(|place| place[*axis] = -place[*axis]),
        }
        mended
    }

    /// Whether it leaves the actuator's pressures as they are.
    pub fn is_of_body(&self) -> bool {
        matches!(self, PressureSlip::Unit(PressureColumn::Body, _) | PressureSlip::Absolute(PressureColumn::Body, _))
    }

    /// How the columns look, how they were corrected to try this slip, and how to correct the table if they are as suspected.
    pub fn words(&self) -> [String; 3] {
        match self {
            PressureSlip::Unit(column, WrongUnit { factor, units: [[right, suffix], [wrong, own]] }) => {
                let [word, name] = column.words();
                [
                    format!("the {word} pressures look as if they were {right} under a name of {wrong}"),
                    format!("{} times the numbers", (1e4 * factor).round() / 1e4),
                    format!("if they are, name the column {name}_{suffix} in place of {name}_{own}"),
                ]
            }
            PressureSlip::Exchanged => exchanged("the pressures of body and actuator", ["p_act", "p_body"]),
            PressureSlip::Absolute(column, room_pa) => {
                let ([word, name], kpa) = (column.words(), short(1e-3 * room_pa));
                let help = format!("if they are, subtract {kpa} kPa from the column {name}");
                [format!("the {word} pressures look absolute"), format!("{kpa} kPa subtracted"), help]
            }
            PressureSlip::Channels(pair) => {
                let name = |channel| if channel == 0 { "p_act".into() } else { format!("p_act_{channel}") };
                let ([one, other], names) = (pair, pair.map(name));
                let what = format!("the pressures of the supply channels {one} and {other}");
                exchanged(&what, names.each_ref().map(String::as_str))
            }
            PressureSlip::Axes(pair) => {
                let names = pair.map(|axis| AXES[axis]);
                let [looks, with, help] = exchanged(&names.join(" and "), names);
                [looks, with, format!("{FRAME}; {help}")]
            }
            PressureSlip::Turned(axis) => {
                let name = AXES[*axis];
                let help = format!("{FRAME}; if it is, change the sign of the column {name}");
                [format!("{name} looks turned over"), format!("-{name} in place of {name}"), help]
            }
        }
    }
}

fn exchanged(what: &str, [one, other]: [&str; 2]) -> [String; 3] {
    let help = format!("if they are, exchange the names of the columns {one} and {other}");
    [format!("{what} look exchanged"), "the two columns exchanged".into(), help]
}

/// What the numbers alone look like: a column that begins at the pressure of a room and never goes below it, an actuator that
/// never has more than its body.
pub fn by_numbers(dataset: &Dataset) -> Vec<PressureSlip> {
    let Some(first) = dataset.holds.first() else { return Vec::new() };
    let absolute = |column: &PressureColumn| {
        let begins = column.lowest(first);
        let above = dataset.holds.iter().all(|hold| policy::is_not_below(column.lowest(hold), begins));
        let room_pa = if *column == PressureColumn::Body { begins.min(ROOM_PA) } else { begins };
        (is_a_room(begins) && above).then_some(PressureSlip::Absolute(*column, room_pa))
    };
    let [act, body] = COLUMNS.map(|column| column.top(dataset));
    let found: Vec<PressureSlip> = COLUMNS.iter().filter_map(absolute).collect();
    match found.is_empty() && dataset.more_channels() == 0 && policy::is_never_above(act, body) {
        true => vec![PressureSlip::Exchanged],
        false => found,
    }
}

/// A warning for each slip that the pressures show without a model.
pub fn pressure_words(dataset: &Dataset) -> Vec<String> {
    let told = |slip: &PressureSlip| {
        let why = match slip {
            PressureSlip::Absolute(column, _) => {
                let begins = column.lowest(&dataset.holds[0]);
                format!("they begin at {} kPa, the air of a room, and are never below it", short(1e-3 * begins))
            }
            _ => "the actuator never has more than the body".into(),
        };
        let [looks, _, help] = slip.words();
        format!("{}: {looks}: {why}. Look at it first: {help}", dataset.name)
    };
    by_numbers(dataset).iter().map(told).collect()
}

/// A slip of a pressure column that withholds the verdict.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PressureSlipFound {
    /// Name of the dataset with the suspected column.
    pub dataset: String,
    /// What it looks like, the evidence, what to type.
    pub words: String,
    /// Error beyond noise of the base with the pressures as they are written \[mm\].
    pub before_mm: Option<f64>,
    /// The same with the slip undone \[mm\]; `None` where the robot has no equilibrium then either.
    pub after_mm: Option<f64>,
    /// The best of the catalogue with the pressures as they are written.
    pub best_effect: Option<BestEffect>,
}

/// What comes nearest without a slip.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct BestEffect {
    /// Names of the effects that were fitted together.
    pub effects: Vec<String>,
    /// Error beyond noise that they leave \[mm\].
    pub left_mm: f64,
}

#[cfg(test)]
mod tests {
    use super::*;

    fn embedded(name: &str) -> Dataset {
        data::load(name, &mut |_, _| {}).unwrap().0
    }

    const SETS: [&str; 10] = [
        "synthetic-spam",
        "synthetic-cpam",
        "synthetic-epam",
        "synthetic-fpam",
        "synthetic-epam-two-bodies",
        "fem-spam",
        "fem-cpam",
        "fem-epam",
        "fem-fpam",
        "jitosho-2023-arm",
    ];

    #[test]
    fn right_pressures_look_like_no_slip() {
        for name in SETS {
            assert!(by_numbers(&embedded(name)).is_empty(), "{name}");
        }
    }

    #[test]
    fn exchanged_and_absolute_pressures_are_seen_in_the_numbers_alone() {
        for name in SETS {
            let right = embedded(name);
            assert_eq!(by_numbers(&PressureSlip::Exchanged.undone(&right)), [PressureSlip::Exchanged], "{name}");
            for column in COLUMNS {
                let absolute = PressureSlip::Absolute(column, -ROOM_PA).undone(&right);
                let [PressureSlip::Absolute(found, room_pa)] = by_numbers(&absolute)[..] else { panic!("{name}") };
                assert!(found == column && (room_pa - ROOM_PA).abs() < 1.0, "{name} {room_pa}");
                let words = pressure_words(&absolute).concat();
                assert!(words.contains("subtract 10") && words.contains(column.words()[1]), "{words}");
            }
        }
    }

    #[test]
    fn undoing_a_slip_brings_the_pressures_back_and_nothing_else_moves() {
        let right = embedded("synthetic-epam");
        for slip in PressureSlip::all(&right, 2e3) {
            let PressureSlip::Unit(column, unit) = slip else { continue };
            let mended = slip.undone(&right);
            assert_eq!(mended.coordinates_m, right.coordinates_m);
            for (hold, before) in mended.holds.iter().zip(&right.holds) {
                assert_eq!(column.lowest(hold), unit.factor * column.lowest(before));
            }
            assert!(wrong_units().any(|other| (other.factor * unit.factor - 1.0).abs() < 1e-12), "{unit:?}");
        }
    }
}
