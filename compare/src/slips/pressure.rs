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
    /// Sensors of absolute pressure of actuator, body or both, in rooms of these pressures \[Pa\].
    Absolute([Option<f64>; 2]),
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
    /// The actual unit and the unit of the column's name, each as symbol, in words and as the suffix of a column's name.
    units: [[&'static str; 3]; 2],
}

/// Units of pressure gauges and loggers: their symbol, in words, and as the suffix of a column's name.
const UNITS: [[&str; 3]; 4] =
    [["psi", "psi", "psi"], ["mbar", "mbar", "mbar"], ["bar", "bar", "bar"], ["inH2O", "inches of water", "inh2o"]];

fn wrong_units() -> impl Iterator<Item = WrongUnit> {
    UNITS.into_iter().flat_map(|own| {
        let known = units_of(Dimension::PRESSURE).find(|unit| unit.symbol == own[0]);
        let factor = known.map_or(f64::NAN, |unit| 1e-3 * unit.factor());
        let kpa = ["kPa", "kPa", "kpa"];
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
        let units = COLUMNS.iter().zip(dataset.pressure_units).flat_map(|(column, named)| {
            let possible = wrong_units().filter(move |unit| unit.units[1][0] == named);
            possible.map(|unit| PressureSlip::Unit(*column, unit))
        });
        let rooms = COLUMNS.map(|column| {
            let lowest = dataset.holds.iter().map(|hold| column.lowest(hold)).fold(f64::INFINITY, f64::min);
            // An actuator is vented now and then, a body hardly ever.
            Some(if column == PressureColumn::Body { lowest - body_pa } else { lowest }).filter(|pa| is_a_room(*pa))
        });
        let absolute = rooms.iter().any(Option::is_some).then_some(PressureSlip::Absolute(rooms));
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
        by_numbers(dataset).is_some_and(|seen| std::mem::discriminant(&seen) == std::mem::discriminant(self))
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
            PressureSlip::Absolute(rooms) => holds.iter_mut().for_each(|hold| {
                let columns = COLUMNS.iter().zip(rooms);
                columns.for_each(|(column, room)| column.change(hold, |pa| pa - room.unwrap_or_default()));
            }),
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
        matches!(self, PressureSlip::Unit(PressureColumn::Body, _) | PressureSlip::Absolute([None, _]))
    }

    /// How the columns look, how they were corrected to try this slip, and how to correct the table if they are as suspected.
    pub fn words(&self) -> [String; 3] {
        match self {
            PressureSlip::Unit(column, WrongUnit { factor, units: [[_, right, suffix], [_, wrong, own]] }) => {
                let [word, name] = column.words();
                [
                    format!("the {word} pressures look as if they were {right} under a name of {wrong}"),
                    format!("{} times the numbers", (1e4 * factor).round() / 1e4),
                    format!("if they are, name the column {name}_{suffix} in place of {name}_{own}"),
                ]
            }
            PressureSlip::Exchanged => exchanged("the pressures of body and actuator", ["p_act", "p_body"]),
            PressureSlip::Absolute(rooms) => {
                let own = COLUMNS.iter().zip(rooms).filter_map(|(column, room)| Some((column.words(), (*room)?)));
                let parts: Vec<_> =
                    own.map(|([word, name], pa)| [word.into(), name.into(), short(1e-3 * pa)]).collect();
                let all = |of: &dyn Fn(&[String; 3]) -> String| parts.iter().map(of).collect::<Vec<_>>().join(" and ");
                let kpa = all(&|[_, name, kpa]| format!("{kpa} kPa from the column {name}"));
                [
                    format!("the {} pressures look absolute", all(&|[word, ..]| word.clone())),
                    format!("{} kPa subtracted", all(&|[.., kpa]| kpa.clone())),
                    format!("if they are, subtract {kpa}"),
                ]
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
pub fn by_numbers(dataset: &Dataset) -> Option<PressureSlip> {
    let first = dataset.holds.first()?;
    let rooms = COLUMNS.map(|column| {
        let begins = column.lowest(first);
        let above = dataset.holds.iter().all(|hold| policy::is_not_below(column.lowest(hold), begins));
        let room_pa = if column == PressureColumn::Body { begins.min(ROOM_PA) } else { begins };
        (is_a_room(begins) && above).then_some(room_pa)
    });
    let [act, body] = COLUMNS.map(|column| column.top(dataset));
    let is_exchanged = dataset.more_channels() == 0 && policy::is_never_above(act, body);
    match rooms == [None; 2] {
        true => is_exchanged.then_some(PressureSlip::Exchanged),
        false => Some(PressureSlip::Absolute(rooms)),
    }
}

/// A warning for each slip that the pressures show without a model.
pub fn pressure_words(dataset: &Dataset) -> Vec<String> {
    let told = |slip: &PressureSlip| {
        let why = match slip {
            PressureSlip::Absolute(rooms) => {
                let begins = COLUMNS.iter().zip(rooms).filter(|(_, room)| room.is_some());
                let kpa: Vec<String> =
                    begins.map(|(column, _)| short(1e-3 * column.lowest(&dataset.holds[0]))).collect();
                format!("they begin at {} kPa, the air of a room, and are never below it", kpa.join(" and "))
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
            assert_eq!(by_numbers(&embedded(name)), None, "{name}");
        }
    }

    #[test]
    fn exchanged_and_absolute_pressures_are_seen_in_the_numbers_alone() {
        for name in SETS {
            let right = embedded(name);
            assert_eq!(by_numbers(&PressureSlip::Exchanged.undone(&right)), Some(PressureSlip::Exchanged), "{name}");
            for column in COLUMNS {
                let raised = COLUMNS.map(|own| (own == column).then_some(-ROOM_PA));
                let absolute = PressureSlip::Absolute(raised).undone(&right);
                let Some(PressureSlip::Absolute(rooms)) = by_numbers(&absolute) else { panic!("{name}") };
                assert!(rooms.iter().zip(raised).all(|(found, made)| found.is_some() == made.is_some()), "{name}");
                assert!(rooms.iter().flatten().all(|pa| (pa - ROOM_PA).abs() < 1.0), "{name} {rooms:?}");
                let words = pressure_words(&absolute).concat();
                assert!(words.contains("subtract 10") && words.contains(column.words()[1]), "{words}");
            }
            let both = PressureSlip::Absolute([Some(-ROOM_PA); 2]).undone(&right);
            let words = pressure_words(&both).concat();
            assert!(words.contains("from the column p_act and 101.3 kPa from the column p_body"), "{words}");
        }
    }

    #[test]
    fn a_remedy_renames_columns_that_the_table_has() {
        let kpa = embedded("synthetic-epam");
        let mbar = Dataset { pressure_units: ["mbar", "kPa"], ..kpa.clone() };
        let remedies = |data: &Dataset| -> String {
            let units = PressureSlip::all(data, 2e3).into_iter().filter(|slip| matches!(slip, PressureSlip::Unit(..)));
            units.map(|slip| slip.words()[2].clone()).collect()
        };
        assert!(!remedies(&kpa).contains("in place of p_act_mbar"), "{}", remedies(&kpa));
        let of_mbar = remedies(&mbar);
        assert!(of_mbar.contains("p_act_kpa in place of p_act_mbar") && !of_mbar.contains("place of p_act_kpa"));
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
