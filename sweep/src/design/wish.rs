//! The TOML file of a wish.

use crate::axis::{Axis, CaseChanges, RawAxis, axes};
use crate::form::{Form, ReadRobot, Wrong};
use compare::{CompareError, ScenarioFile};
use serde::Deserialize;
use spelling::Exactly;
use std::path::{Path, PathBuf};
use toml::Spanned;

/// Largest number of free keys; the simplex search fails with more.
const MOST_FREE: usize = 12;

/// Targets of the shape; the design must meet all of them at once.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Wanted {
    /// Target place of the tip \[m\]; `None`: anywhere.
    pub tip_m: Option<[f64; 2]>,
    /// Target angle of the tip \[rad\]; `None`: any.
    pub tip_angle_rad: Option<f64>,
    /// Places that stations of the body pass.
    pub places: Vec<TargetPlace>,
    /// By how much stretches of the body turn.
    pub turns: Vec<TargetTurn>,
}

/// A station and its target position.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TargetPlace {
    /// Station along the undeformed body \[m\].
    pub s_m: f64,
    /// Target position x, y of the station \[m\].
    pub at_m: [f64; 2],
}

/// A stretch and by how much it turns.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TargetTurn {
    /// Its ends along the undeformed body \[m\].
    pub between_m: [f64; 2],
    /// Angle from one to the other \[rad\].
    pub angle_rad: f64,
}

/// What a design costs in addition to its miss, in squares of the tolerance.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Cost {
    /// Of the largest pressure of the scenario.
    pub pressure: f64,
    /// Weight of the flat area of the actuator over the scenario's.
    pub footprint: f64,
    /// Of a tip that the assumed numbers move by the tolerance to each side.
    pub robustness: f64,
}

impl Default for Cost {
    /// Of two designs that have the wish the one with less pressure.
    fn default() -> Cost {
        Cost { pressure: 0.01, footprint: 0.0, robustness: 0.0 }
    }
}

/// A wish as read from its file.
#[derive(Debug, Clone)]
pub struct Wish {
    /// The robot, with the force at its tip.
    pub base: ScenarioFile,
    /// Folder that paths in the robot's file count from.
    pub folder: PathBuf,
    /// Targets of the shape, all at once.
    pub wanted: Wanted,
    /// Share of the body's length by which it may be missed.
    pub tolerance: f64,
    /// Keys that the search may choose, with their ranges.
    pub free: Vec<Axis>,
    /// Unknown numbers, with their ranges.
    pub assumed: Vec<Axis>,
    /// Weights of pressure, size and sensitivity next to the miss.
    pub cost: Cost,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RawDesign {
    #[serde(rename = "kind")]
    _kind: Option<DesignKind>,
    scenario: Spanned<String>,
    wish: Spanned<RawWish>,
    #[serde(default)]
    free: Vec<Spanned<RawAxis>>,
    #[serde(default)]
    assumed: Vec<Spanned<RawAxis>>,
    cost: Option<Spanned<Cost>>,
}

#[derive(Deserialize)]
#[serde(rename_all = "lowercase")]
enum DesignKind {
    Design,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RawWish {
    tip_mm: Option<Exactly<2>>,
    tip_angle_deg: Option<f64>,
    #[serde(default)]
    places: Vec<Spanned<RawPlace>>,
    #[serde(default)]
    turns: Vec<Spanned<RawTurn>>,
    force_n: Option<Exactly<2>>,
    tolerance: Option<f64>,
}

#[derive(Clone, Copy, Deserialize)]
#[serde(deny_unknown_fields)]
struct RawPlace {
    s_mm: f64,
    at_mm: Exactly<2>,
}

#[derive(Clone, Copy, Deserialize)]
#[serde(deny_unknown_fields)]
struct RawTurn {
    from_mm: f64,
    to_mm: f64,
    angle_deg: f64,
}

const FORM: Form<RawDesign, Wish> =
    Form { what: "wish", page: "docs/design.md", scenario: |raw| &raw.scenario, of: Wish::of };

impl Wish {
    /// Reads a wish; `scenario` reads the robot that it names, first as a file in the same folder.
    ///
    /// # Errors
    /// A file that cannot be read; a fault of the wish or of the robot, with its line and what to write.
    pub fn read(path: &Path, scenario: ReadRobot) -> Result<Wish, CompareError> {
        FORM.read(path, scenario)?.checked()
    }

    /// Of a text; `name` is for messages. Errors as for [`Wish::read`].
    ///
    /// ```
    /// use sweep::design::Wish;
    /// let text = "kind = \"design\"\nscenario = \"epam\"\n[wish]\ntip_mm = [310, 110]\n[[free]]\nkey = \"pressure_kpa\"\nfrom = 5\nto = 30\n";
    /// let read = |text: &str| Wish::parse("wish.toml", text, "".as_ref(), compare::ScenarioFile::read);
    /// assert!(read(text).is_ok() && read(&text.replace("tip_mm", "tip_cm")).is_err());
    /// ```
    pub fn parse(name: &str, text: &str, folder: &Path, scenario: ReadRobot) -> Result<Wish, CompareError> {
        FORM.parse(name, text, folder, scenario)?.checked()
    }

    /// Refuses a key that the scenario does not have before the search starts.
    fn checked(self) -> Result<Wish, CompareError> {
        let middle = |axes: &[Axis]| vec![0.5; axes.len()];
        let changes = self.changes(&middle(&self.free), &middle(&self.assumed));
        self.base.with(&changes.values)?;
        Ok(self)
    }

    fn of(raw: RawDesign, base: ScenarioFile, folder: &Path) -> Result<Wish, Wrong> {
        let whole = base.length_m;
        let wanted = wanted(raw.wish.get_ref(), whole)
            .map_err(|(span, message, help)| (span.or(Some(raw.wish.span())), message, help))?;
        let wrong = |message: &str, help| Err((Some(raw.wish.span()), message.to_string(), help));
        if wanted == Wanted::default() {
            return wrong("nothing is wished for", "write for example tip_mm = [290, 140]");
        }
        let tolerance = raw.wish.get_ref().tolerance.unwrap_or(0.01);
        if !(1e-6..=0.5).contains(&tolerance) {
            return wrong(
                "`tolerance` is a share of the length, from 1e-6 to 0.5",
                "write for example tolerance = 0.01",
            );
        }
        let free = axes(&raw.free, true, &base)?;
        if free.is_empty() || free.len() > MOST_FREE {
            let message = format!("{} keys are free; a design needs 1 to {MOST_FREE}", free.len());
            return Err((None, message, "add [[free]] with key = \"pressure_kpa\", from = 5 and to = 30"));
        }
        let assumed = axes(&raw.assumed, true, &base)?;
        let all = || free.iter().zip(&raw.free).chain(assumed.iter().zip(&raw.assumed));
        if let Some((axis, raw)) = all().find(|(axis, _)| axis.key.starts_with("fem.")) {
            let message = format!("`{}` moves nothing of the reduced model, which searches", axis.key);
            return Err((Some(raw.span()), message, "leave it out; ibr sweep varies settings of finite elements"));
        }
        if let Some(twice) = assumed.iter().position(|a| free.iter().any(|f| f.key == a.key)) {
            let message = format!("`{}` is free and assumed", assumed[twice].key);
            return Err((Some(raw.assumed[twice].span()), message, "what you choose is known: leave one out"));
        }
        let cost = raw.cost.as_ref().map_or(Cost::default(), |cost| *cost.get_ref());
        if ![cost.pressure, cost.footprint, cost.robustness].iter().all(|weight| (0.0..=1e3).contains(weight)) {
            let span = raw.cost.as_ref().map(Spanned::span);
            return Err((span, "a weight is not from 0 to 1000".into(), "write for example pressure = 0.01"));
        }
        if cost.robustness > 0.0 && assumed.is_empty() {
            let span = raw.cost.as_ref().map(Spanned::span);
            return Err((span, "robustness against nothing".into(), "add [[assumed]] keys with from and to"));
        }
        let force = raw.wish.get_ref().force_n.map_or([0.0; 2], |force| force.0);
        let base = match force.iter().all(|f| *f == 0.0) {
            true => base,
            false => {
                let [x, y] = force.map(|f| format!("{f:?}"));
                let set = [("force_x_n", x), ("force_y_n", y)].map(|(key, f)| (format!("effects.tip_load.{key}"), f));
                base.with(&set).map_err(|error| (Some(raw.wish.span()), error.to_string(), "force_n is in newtons"))?
            }
        };
        Ok(Wish { base, folder: folder.to_path_buf(), wanted, tolerance, free, assumed, cost })
    }

    /// The wish less some numbers, in the order of its parts: who finds it has this one once they are added.
    pub(super) fn less(&self, numbers: &[f64]) -> Wish {
        let mut wish = self.clone();
        let Wanted { tip_m, tip_angle_rad, places, turns } = &mut wish.wanted;
        let places = places.iter_mut().flat_map(|place| &mut place.at_m);
        let turns = turns.iter_mut().map(|turn| &mut turn.angle_rad);
        let all = tip_m.iter_mut().flatten().chain(tip_angle_rad).chain(places).chain(turns);
        all.zip(numbers).for_each(|(wanted, number)| *wanted -= number);
        wish
    }

    /// Values for the scenario at shares of the ranges of free and assumed keys.
    pub(super) fn changes(&self, free: &[f64], assumed: &[f64]) -> CaseChanges {
        let both = self.free.iter().zip(free).chain(self.assumed.iter().zip(assumed));
        CaseChanges::of(both.map(|(axis, share)| (axis, axis.at(*share))))
    }
}

fn wanted(raw: &RawWish, length_m: f64) -> Result<Wanted, Wrong> {
    let on_body = |s: f64| (0.0..=length_m).contains(&(1e-3 * s));
    let far = "a place is within ten lengths of the robot";
    let near = |[x, y]: [f64; 2]| [x, y].iter().all(|v| v.abs() <= 1e4 * length_m);
    if raw.tip_mm.is_some_and(|tip| !near(tip.0)) {
        return Err((None, far.into(), "write millimetres: tip_mm = [290, 140]"));
    }
    if raw.tip_angle_deg.is_some_and(|angle| angle.is_nan() || angle.abs() > 720.0) {
        return Err((None, "`tip_angle_deg` is more than two turns".into(), "write degrees"));
    }
    let places = raw.places.iter().map(|place| {
        let RawPlace { s_mm, at_mm: Exactly(at_mm) } = *place.get_ref();
        match on_body(s_mm) && near(at_mm) {
            true => Ok(TargetPlace { s_m: 1e-3 * s_mm, at_m: at_mm.map(|v| 1e-3 * v) }),
            false => {
                Err((Some(place.span()), format!("s_mm = {s_mm} is not on the body, or {far}"), "write millimetres"))
            }
        }
    });
    let turns = raw.turns.iter().map(|turn| {
        let RawTurn { from_mm, to_mm, angle_deg } = *turn.get_ref();
        match on_body(from_mm) && on_body(to_mm) && from_mm < to_mm && angle_deg.abs() <= 720.0 {
            true => Ok(TargetTurn { between_m: [1e-3 * from_mm, 1e-3 * to_mm], angle_rad: angle_deg.to_radians() }),
            false => {
                let help = "write from_mm below to_mm, both on the body, and degrees";
                Err((Some(turn.span()), "a turn of a stretch that is none".to_string(), help))
            }
        }
    });
    Ok(Wanted {
        tip_m: raw.tip_mm.map(|tip| tip.0.map(|v| 1e-3 * v)),
        tip_angle_rad: raw.tip_angle_deg.map(f64::to_radians),
        places: places.collect::<Result<_, Wrong>>()?,
        turns: turns.collect::<Result<_, Wrong>>()?,
    })
}
