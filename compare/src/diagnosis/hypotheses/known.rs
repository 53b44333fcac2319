//! Quantities that were measured by themselves: parameters of effects, from a test of their own.
//!
//! A parameter p that a test found to be m ± s is one more value that every hypothesis has to meet: `(p − m)/s` where it has the
//! effect. A hypothesis without it lacks a known effect: it pays `(p₀ − m)/s` with the value p₀ at which the effect vanishes, but no
//! more than |W Δf|, what the effect of that size changes at the markers. A weave that locks beyond the muscle's stroke changes nothing.

use crate::diagnosis::candidates::Candidate;
use crate::error::CompareError;
use crate::policy;
use data::MeasuredValue;
use models::Scenario;

/// A separately measured parameter, or the usual form of a law, in SI.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct KnownParameter {
    /// Effect, as an index into the catalogue.
    pub effect: usize,
    pub parameter: usize,
    pub value: f64,
    pub sd: f64,
    /// What a hypothesis without the effect differs from it by, in standard deviations.
    pub lacking: f64,
    /// Not measured: the usual form of a law, from which real ones differ by [`policy::SHAPE`].
    pub usual: bool,
}

/// A test in addition to the markers, and what it measures.
#[derive(Debug, PartialEq)]
pub struct BenchTest {
    /// Short name of the test, such as `caliper`.
    pub name: &'static str,
    /// What the test measures, on which object.
    pub sentence: &'static str,
    /// Effects and the parameters that the test measures.
    pub parameters: &'static [(&'static str, &'static str)],
}

/// Separate tests that a next experiment may propose.
pub const BENCH_TESTS: [BenchTest; 3] = [
    BenchTest {
        name: "fabric test",
        sentence: "strips of the actuator's fabric, pulled along the body and at 45° to the yarns",
        parameters: &[
            ("fabric_stretch", "compliance_m_per_n"),
            ("shear_stiffness", "shear_n_per_m"),
            ("shear_lock", "lock_rad"),
        ],
    },
    BenchTest {
        name: "scale",
        sentence: "the robot's weight on a scale",
        parameters: &[("gravity", "weight_n_per_m")],
    },
    BenchTest {
        name: "caliper",
        sentence: "the body's height at its middle by caliper, straight and fully bent",
        parameters: &[("ovalization", "flattening_m2")],
    },
];

/// Standard deviation that is expected of such a test, as a share of the value and of no less than its typical size. Assumed.
pub const BENCH_TEST: f64 = 0.1;

impl KnownParameter {
    pub(crate) fn planned(effect: usize, parameter: usize) -> KnownParameter {
        KnownParameter { effect, parameter, value: 0.0, sd: 0.0, lacking: 0.0, usual: false }
    }

    /// Difference of a hypothesis to it, in standard deviations; `values` lists the hypothesis's effects, one after the other.
    pub(crate) fn residual(&self, candidates: &[Candidate], effects: &[usize], values: &[f64]) -> f64 {
        self.of(candidates, effects, values).map_or(self.lacking, |value| (value - self.value) / self.sd)
    }

    pub(crate) fn of(&self, candidates: &[Candidate], effects: &[usize], values: &[f64]) -> Option<f64> {
        let mut from = 0;
        for effect in effects {
            if *effect == self.effect {
                return Some(values[from + self.parameter]);
            }
            from += candidates[*effect].parameters.len();
        }
        None
    }

    /// The same parameter as if a test had found this value.
    pub(crate) fn at(self, candidates: &[Candidate], value: f64, sd: f64) -> KnownParameter {
        let neutral = candidates[self.effect].parameters[self.parameter].neutral;
        KnownParameter { value, sd, lacking: (neutral - value) / sd, ..self }
    }
}

pub(crate) fn add_shapes(known: &mut Vec<KnownParameter>, candidates: &[Candidate]) {
    for (effect, candidate) in candidates.iter().enumerate() {
        for (parameter, p) in candidate.parameters.iter().enumerate().filter(|(_, p)| p.is_shape() && p.is_free()) {
            if known.iter().all(|k| (k.effect, k.parameter) != (effect, parameter)) {
                let sd = policy::shape_sd(p.lower, p.upper);
                let planned = KnownParameter::planned(effect, parameter);
                known.push(KnownParameter { value: p.neutral, sd, usual: true, ..planned });
            }
        }
    }
}

/// What a bench test would measure of the catalogue: effect and parameter; nothing of effects that are not candidates.
pub(crate) fn parameters_of(test: &BenchTest, candidates: &[Candidate]) -> Vec<(usize, usize)> {
    test.parameters.iter().filter_map(|(effect, key)| place(candidates, effect, key)).collect()
}

/// The values measured of effects that may be missing or are refitted.
///
/// # Errors
/// A name that neither the catalogue nor the scenario has, a value beyond its bounds. An effect that the actuator cannot have is not a
/// fault, because a test of the fabric covers all actuators.
pub(crate) fn known<'m>(
    measured: impl IntoIterator<Item = &'m MeasuredValue>,
    candidates: &[Candidate],
    scenario: &Scenario,
) -> Result<Vec<KnownParameter>, CompareError> {
    let mut all: Vec<KnownParameter> = Vec::new();
    for m in measured {
        check(scenario, m)?;
        let Some((effect, parameter)) = place(candidates, &m.effect, &m.key) else { continue };
        // Of two tests of one quantity the first counts.
        if all.iter().all(|k| (k.effect, k.parameter) != (effect, parameter)) {
            let si = candidates[effect].parameters[parameter].si;
            all.push(KnownParameter::planned(effect, parameter).at(candidates, m.value * si, m.sd * si));
        }
    }
    Ok(all)
}

fn place(candidates: &[Candidate], effect: &str, key: &str) -> Option<(usize, usize)> {
    let index = candidates.iter().position(|candidate| candidate.name == effect)?;
    Some((index, candidates[index].parameters.iter().position(|p| p.key == key)?))
}

fn check(scenario: &Scenario, m: &MeasuredValue) -> Result<(), CompareError> {
    let (name, key, value, sd) = (&m.effect, &m.key, m.value, m.sd);
    let wrong = |problem: String| {
        let place = if m.place.is_empty() { "about.toml".to_string() } else { m.place.clone() };
        Err(CompareError::told(format!("{place}: [measured] {problem}")))
    };
    let catalogue = scenario.catalogue();
    let Some(effect) = catalogue.by_name(name) else {
        let names: Vec<&str> = catalogue.effects().map(|effect| effect.name).collect();
        return wrong(format!("names an unknown effect `{name}`; {}", spelling::known(name, &names)));
    };
    let Some(p) = effect.parameters.iter().find(|p| p.key == key) else {
        let keys: Vec<&str> = effect.parameters.iter().map(|p| p.key).collect();
        return wrong(format!("names an unknown parameter `{key}` of {name}; {}", spelling::known(key, &keys)));
    };
    if value.is_finite() && policy::is_within(p.possible, value, sd) {
        return Ok(());
    }
    wrong(format!(
        "{name}: {key} = {value} is outside its physical bounds {} by more than {} of its standard deviations \
         ({sd}): correct the value or its unit",
        p.possible_words(),
        policy::BEYOND_BOUNDS
    ))
}

/// What was measured to be more than fits look for: possible, and perhaps another unit.
pub(crate) fn unusual(measured: &[MeasuredValue], scenario: &Scenario) -> Vec<String> {
    let catalogue = scenario.catalogue();
    let told = measured.iter().filter_map(|m| {
        let effect = catalogue.by_name(&m.effect)?;
        let p = effect.parameters.iter().find(|p| p.key == m.key)?;
        let given = format!("about.toml gives {} with {} = {}", m.effect, m.key, m.value);
        (!policy::is_within([p.lower, p.upper], m.value, m.sd))
            .then(|| format!("{given}, and robots like these have {}: used as given, check its unit", p.usual_words()))
    });
    told.collect()
}

/// Room for what was measured beyond the bounds of a fit, as far as that is possible.
pub(crate) fn make_room(candidates: &mut [Candidate], measured: &[&MeasuredValue], scenario: &Scenario) {
    let catalogue = scenario.catalogue();
    for m in measured {
        let entry = catalogue.by_name(&m.effect);
        let Some(((effect, parameter), entry)) = place(candidates, &m.effect, &m.key).zip(entry) else { continue };
        let [lower, upper] = entry.parameters[parameter].possible;
        let free = &mut candidates[effect].parameters[parameter];
        let far = policy::BEYOND_BOUNDS * m.sd;
        let [low, high] = [m.value - far, m.value + far].map(|v| v.clamp(lower, upper) * free.si);
        if m.value * free.si < free.lower {
            free.lower = free.lower.min(low);
        }
        if m.value * free.si > free.upper {
            free.upper = free.upper.max(high);
        }
    }
}
