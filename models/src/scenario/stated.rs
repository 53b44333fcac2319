//! A scenario in SI units, and its variants.

use super::choice::ActuatorChoice;
use crate::catalogue::Catalogue;
use crate::effects::{EFFECTS, Effect, Fitted, IN_SPACE, Parameter};
use crate::formula::Formula;
use crate::line::Line;
use std::ops::{Deref, DerefMut};
use std::sync::Arc;

/// A scenario in SI units, checked.
#[derive(Debug, Clone, PartialEq)]
pub struct Scenario {
    /// Name for people, in titles and files; no model reads it.
    pub name: String,
    /// Radius R of the inflated body outside of zones \[m\].
    pub radius_m: f64,
    /// Length L of the undeformed body from clamp to tip \[m\].
    pub length_m: f64,
    /// Gauge pressure p_b of the body \[Pa\], unless a call has another.
    pub p_body_pa: f64,
    /// Effective bending stiffness B \[N·m²\]; 0 in a bare model.
    pub bending_stiffness: f64,
    /// Hinge curvature k₀ of the base law \[1/m\].
    pub hinge_curvature: f64,
    /// Restoring moment of the base law as a share of πp_bR³ \[-\].
    pub hinge_share: f64,
    /// The fabric of the body, where it is known.
    pub wall: Wall,
    /// Distance of the centre line from the taut generator \[m\]; `None`: the radius, 0: it does not shorten.
    pub centre_line_m: Option<f64>,
    /// Unit vector of gravity: x, y, and z with strips round the body.
    pub gravity_direction: [f64; 3],
    /// The actuator of a planar robot, or the first strip of several.
    pub actuator: ActuatorChoice,
    /// Further strips of it round the body.
    pub more_strips: Vec<ActuatorChoice>,
    /// Stretches of the body with values of their own.
    pub zones: Vec<Zone>,
    /// Marker stations along the undeformed body \[m\].
    pub markers_m: Vec<f64>,
    /// Actuator pressures to predict at when none are asked for \[Pa\].
    pub pressures_pa: Vec<f64>,
    /// Segments of a model with transverse loads.
    pub segments: usize,
    /// Largest actuator pressure an inverse may ask for \[Pa\].
    pub p_max_pa: f64,
    /// How fast a set pressure arrives, for what happens in time; `None`: at once.
    pub line: Option<Line>,
    /// Growth by eversion, which moves no pose; `None`: not known.
    pub growth: Option<Growth>,
    /// Effects that are switched on, in the order of the catalogue.
    pub effects: Effects,
    /// The scenario's own effects, in the order of the text: they follow the catalogue's.
    pub formulas: Vec<Arc<Formula>>,
}

/// Known properties of the body's fabric.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Wall {
    /// Membrane stiffness E t along the body \[N/m\]: the body is then a [`crate::body::BodyWall`].
    pub stiffness_n_per_m: Option<f64>,
    /// In-plane shear stiffness G t \[N/m\]: transverse loads then shear the body by V/(πR²p_b + πR G t).
    pub shear_n_per_m: Option<f64>,
    /// How they are known: a word of `basis`; empty without either.
    pub basis: String,
}

/// What growth by eversion takes, measured on the tube; [`crate::grown`] has its mechanics.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Growth {
    /// Force Y = ½ P A at which a tube without tail tension halts \[N\].
    pub tip_force_n: f64,
    /// Force ½ P A at which it starts from rest, and more than ½ P A by which inverting it starts \[N\].
    pub break_away_n: f64,
    /// Coefficient of friction μ of the tail on the wall \[-\].
    pub friction: f64,
    /// Weight w of the tail per length \[N/m\].
    pub tail_weight_n_per_m: f64,
    /// Pull T₀ of the spool on the tail at the base \[N\].
    pub base_tension_n: f64,
    /// Speed v₁ of the tip 1 N beyond the halt \[m/s\]; `None`: not measured.
    pub speed_at_1n_m_per_s: Option<f64>,
    /// Exponent n of the speed \[-\].
    pub exponent: f64,
}

/// A stretch of the body where something differs from the rest.
#[derive(Debug, Clone, PartialEq)]
pub struct Zone {
    /// Station at which the zone starts \[m\].
    pub from_m: f64,
    /// Station at which the zone ends \[m\].
    pub to_m: f64,
    /// Radius of the body in the zone \[m\]; `None`: the robot's.
    pub radius_m: Option<f64>,
    /// Effective bending stiffness in the zone \[N·m²\]; `None`: the robot's.
    pub bending_stiffness: Option<f64>,
    /// True where the zone has no actuator; `None`: it has the robot's.
    pub passive: Option<bool>,
    /// Length of an actuator unit in the zone \[m\]; `None`: the robot's.
    pub unit_length_m: Option<f64>,
    /// Width of an actuator unit in the zone \[m\]; `None`: the robot's.
    pub width_m: Option<f64>,
    /// Depth of the gusset folds in the zone \[m\]; `None`: the robot's.
    pub fold_m: Option<f64>,
    /// Arm from the taut generator in the zone \[m\]; `None`: the robot's.
    pub arm_m: Option<f64>,
    /// Supply channel of the zone's actuator; `None`: the robot's.
    pub channel: Option<usize>,
}

/// An effect switched on, with its values.
#[derive(Debug, Clone, PartialEq)]
pub struct EffectChoice {
    /// Name of the effect in the catalogue, or of a formula.
    pub name: String,
    /// Parameter values in catalogue order, SI.
    pub values: Vec<f64>,
    /// How the values are known: a word of [`BASES`], or empty.
    pub basis: String,
    /// Remark on the interval of values, such as `width_mm 0 to 8`; empty without one.
    pub interval: String,
}

impl EffectChoice {
    /// Interval of a parameter by the remark, in the unit of its key: `KEY LOW to HIGH`, several with commas. `None` without one.
    ///
    /// ```
    /// let robot = models::Scenario::parse(models::shipped("epam").unwrap()).unwrap();
    /// let weld = robot.effects.iter().find(|effect| effect.name == "weld_width").unwrap();
    /// assert_eq!(weld.interval_of("width_mm"), Some([0.0, 8.0]));
    /// assert_eq!(weld.interval_of("height_mm"), None);
    /// ```
    pub fn interval_of(&self, key: &str) -> Option<[f64; 2]> {
        let of_key = self.interval.split(',').find_map(|part| part.trim().strip_prefix(key)?.strip_prefix(' '))?;
        let mut words = of_key.split_whitespace();
        let low = words.next()?.parse().ok()?;
        let high = words.next().filter(|word| *word == "to").and_then(|_| words.next())?.parse().ok()?;
        (low < high && f64::is_finite(high - low)).then_some([low, high])
    }
}

/// The effects of a scenario. Its copies share them until one of them is changed, so that copying takes no time.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Effects(Arc<Vec<EffectChoice>>);

impl FromIterator<EffectChoice> for Effects {
    fn from_iter<I: IntoIterator<Item = EffectChoice>>(all: I) -> Effects {
        Effects(Arc::new(all.into_iter().collect()))
    }
}

impl Deref for Effects {
    type Target = Vec<EffectChoice>;

    fn deref(&self) -> &Vec<EffectChoice> {
        &self.0
    }
}

impl DerefMut for Effects {
    fn deref_mut(&mut self) -> &mut Vec<EffectChoice> {
        Arc::make_mut(&mut self.0)
    }
}

/// The words of `basis`, which say how a value is known.
pub const BASES: &[&str] = &["assumed", "calibrated", "measured", "predicted", "published"];

impl Scenario {
    /// The same robot without any effect and with B = 0.
    pub fn bare(&self) -> Scenario {
        Scenario { bending_stiffness: 0.0, effects: Effects::default(), ..self.clone() }
    }

    /// The same with an effect set (added, or its values replaced); values in SI, catalogue order is kept. What shapes its
    /// law comes last and may be left out: the law then has its usual form.
    ///
    /// # Panics
    /// The catalogue has no effect of that name, or it has another number of parameters: a slip in the calling code, which
    /// must not pass as a model without the effect. Look names typed by a user up in [`Scenario::catalogue`] first.
    pub fn with_effect(&self, name: &str, values: &[f64]) -> Scenario {
        let catalogue = self.catalogue();
        let given = values.len();
        let is_usual =
            |p: &Parameter| p.fitted == Fitted::Shape || (p.fitted, p.typical) == (Fitted::FromDesign, p.neutral);
        let takes = |e: &Effect| given <= e.parameters.len() && e.parameters[given..].iter().all(is_usual);
        let effect = catalogue.by_name(name).filter(takes);
        let neutral = effect.map(|e| e.neutral());
        assert!(neutral.is_some(), "no effect `{name}` with {given} parameters");
        let usual = neutral.into_iter().flatten().skip(given);
        let values = values.iter().copied().chain(usual).collect();
        let mut changed = self.clone();
        changed.effects.retain(|e| e.name != name);
        let choice = EffectChoice { name: name.to_string(), values, basis: String::new(), interval: String::new() };
        changed.effects.push(choice);
        changed.effects.sort_by_key(|e| order(&e.name, &self.formulas));
        changed
    }

    /// Its effects with their places in the catalogue and in its order, whatever order they were written or chosen in.
    pub(crate) fn effects_in_order(&self) -> Vec<(usize, &EffectChoice)> {
        let placed = |chosen: &'_ EffectChoice| order(&chosen.name, &self.formulas);
        let mut chosen: Vec<_> = self.effects.iter().map(|chosen| (placed(chosen), chosen)).collect();
        chosen.sort_by_key(|(place, _)| *place);
        chosen
    }

    /// Every effect this scenario may use: the common ones, and its own formulas.
    pub fn catalogue(&self) -> Catalogue<'_> {
        Catalogue::new(&self.formulas)
    }

    /// Names of its effects after which a state depends on those before it.
    pub fn remembering(&self) -> Vec<&str> {
        let remembers = |name: &str| crate::effects::by_name(name).is_some_and(|effect| effect.history);
        self.effects.iter().map(|effect| effect.name.as_str()).filter(|name| remembers(name)).collect()
    }

    /// The same with another effective bending stiffness \[N·m²\].
    pub fn with_bending(&self, stiffness: f64) -> Scenario {
        Scenario { bending_stiffness: stiffness, ..self.clone() }
    }

    /// The same with other marker stations \[m\].
    pub fn with_markers(&self, stations_m: &[f64]) -> Scenario {
        Scenario { markers_m: stations_m.to_vec(), ..self.clone() }
    }

    /// The actuator and its further strips.
    pub fn strips(&self) -> impl Iterator<Item = &ActuatorChoice> {
        std::iter::once(&self.actuator).chain(&self.more_strips)
    }

    /// Whether strips lie elsewhere than along azimuth 0: the robot then leaves the x–y plane, and [`crate::space`] has its balance.
    pub fn is_spatial(&self) -> bool {
        !self.more_strips.is_empty() || !self.actuator.is_planar()
    }

    /// Force on the tip of a planar robot along z, which moves nothing \[N\]; `None` without one.
    pub fn idle_force_n(&self) -> Option<f64> {
        let load = self.effects.iter().find(|e| e.name == "tip_load").filter(|_| !self.is_spatial());
        load.map(|e| e.values[2]).filter(|force| *force != 0.0)
    }

    /// Whether an effect can act on this robot: as [`ActuatorChoice::takes`]; with strips round the body only effects in [`IN_SPACE`].
    pub fn takes(&self, effect: &Effect) -> bool {
        self.actuator.takes(effect) && (!self.is_spatial() || IN_SPACE.contains(&effect.name))
    }
}

pub(super) fn order(name: &str, formulas: &[Arc<Formula>]) -> usize {
    let listed = EFFECTS.iter().position(|e| e.name == name);
    listed.unwrap_or_else(|| EFFECTS.len() + formulas.iter().take_while(|formula| formula.name != name).count())
}
