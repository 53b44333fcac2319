//! Answers to a diagnosis, as they are drawn and reported: one effect or two, each at the values of its fit.

use crate::diagnosis::candidates::taken_away;
use crate::diagnosis::result::{Combination, Diagnosis, ParameterValue, Ranked, Verdict};
use crate::fit::numbers::least;
use crate::policy;
use crate::typed_effect::with_values;
use models::{Known, Scenario};

/// Status of an answer in a diagnosis.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Standing {
    /// The verdict names it, alone or among answers that the data cannot separate.
    Stated,
    /// The best that the catalogue can do, which is not enough.
    Attempt,
    /// An explanation that fits worse than the stated ones.
    Other,
    /// A value sits on a physical bound.
    Rejected,
}

/// One effect or two, with the values and the bending stiffness that were fitted together.
#[derive(Debug, Clone, PartialEq)]
pub struct EffectAnswer<'d> {
    /// The effects as ranked, and their values.
    pub effects: Vec<(&'d Ranked, &'d [ParameterValue])>,
    /// B that was fitted along, one per body pressure \[N·m²\].
    pub bending_nm2: &'d [f64],
    /// Fall of the whitened sum of squares against the calibrated base; NaN where it was not kept.
    pub gain: f64,
    /// Root-mean-square error beyond noise with it \[mm\].
    pub after_mm: f64,
    /// Place of the answer in the verdict.
    pub standing: Standing,
}

impl<'d> EffectAnswer<'d> {
    /// The effects, as the stated set writes them: `a` or `a + b`.
    pub fn name(&self) -> String {
        self.effects.iter().map(|(r, _)| r.effect.as_str()).collect::<Vec<_>>().join(" + ")
    }

    /// The scenario with it, and the B of a level that was fitted with it.
    pub fn on(&self, scenario: &Scenario, level: usize) -> Scenario {
        self.on_with(scenario, level, |_| true)
    }

    /// The same with some of its effects only.
    pub fn on_with(&self, scenario: &Scenario, level: usize, wanted: impl Fn(&Ranked) -> bool) -> Scenario {
        let kept = self.effects.iter().filter(|(r, _)| wanted(r));
        let kept: Vec<(&str, &[ParameterValue])> = kept.map(|(r, values)| (r.effect.as_str(), *values)).collect();
        with_fitted(scenario, &kept, self.bending_nm2.get(level).copied())
    }

    /// The answer as changes of a scenario's text, for [`crate::ScenarioFile::with`]: each place and its new text. `level` as in
    /// [`EffectAnswer::on`].
    pub fn changes(&self, level: usize) -> Vec<(String, String)> {
        let mut changes = Vec::new();
        for (r, values) in &self.effects {
            let name = taken_away(&r.effect).unwrap_or(&r.effect);
            let of = |key: &str, value: String| (format!("effects.{name}.{key}"), value);
            changes.extend(values.iter().map(|p| of(&p.key, format!("{:?}", p.value))));
            changes.push(of("basis", format!("\"{}\"", Known::Calibrated.word())));
        }
        let bending = self.bending_nm2.get(level).map(|b| ("body.bending_stiffness_nm2".to_string(), format!("{b:?}")));
        changes.extend(bending);
        changes
    }

    /// Whether it changes anything, with values that are possible.
    pub fn helps(&self) -> bool {
        self.standing != Standing::Rejected && (policy::helps(self.gain) || self.standing == Standing::Attempt)
    }

    fn single(r: &'d Ranked, standing: Standing) -> EffectAnswer<'d> {
        let effects = vec![(r, r.parameters.as_slice())];
        EffectAnswer { effects, bending_nm2: &r.bending_nm2, gain: r.gain, after_mm: r.systematic_after_mm, standing }
    }
}

impl Diagnosis {
    /// Which of the fitted bending stiffnesses, one per body pressure, belongs to a body pressure \[kPa\]: the nearest.
    pub fn level(&self, p_body_kpa: f64) -> usize {
        let bending = &self.base.bending;
        least(0..bending.len(), |k| (bending[*k].p_body_kpa - p_body_kpa).abs()).unwrap_or(0)
    }

    /// The scenario with the calibrated B of a level; its own if B was kept.
    pub fn calibrated(&self, scenario: &Scenario, level: usize) -> Scenario {
        with_fitted(scenario, &[], self.base.bending.get(level).map(|b| b.value_nm2))
    }

    /// Every effect and every reported pair: stated ones first and in that order, or the attempt and answers that come as close; then
    /// others by their gain; answers on a bound last.
    pub fn answers(&self) -> Vec<EffectAnswer<'_>> {
        let attempt = self.attempt.iter().map(|a| a.effect.as_str()).collect::<Vec<_>>().join(" + ");
        let standing = |name: &str, at_bound: bool| match () {
            () if self.indistinguishable.iter().any(|stated| stated == name) => Standing::Stated,
            () if name == attempt => Standing::Attempt,
            () if at_bound => Standing::Rejected,
            () => Standing::Other,
        };
        let mut answers: Vec<EffectAnswer> =
            self.ranked.iter().map(|r| EffectAnswer::single(r, standing(&r.effect, r.at_bound))).collect();
        for pair in &self.pairs {
            let (effects, gain) = (self.members(pair), pair.gain);
            let standing = standing(&pair.effects.join(" + "), false);
            let (bending_nm2, after_mm) = (pair.bending_nm2.as_slice(), pair.systematic_after_mm);
            answers.push(EffectAnswer { effects, bending_nm2, gain, after_mm, standing });
        }
        if !attempt.is_empty() && answers.iter().all(|a| a.standing != Standing::Attempt) {
            answers.push(self.unreported_attempt());
        }
        let stated = self.indistinguishable.len();
        let as_close =
            |a: &EffectAnswer| self.attempt_alike.iter().position(|other| other.effects.join(" + ") == a.name());
        let place = |a: &EffectAnswer| match a.standing {
            Standing::Stated => self.indistinguishable.iter().position(|entry| *entry == a.name()).unwrap_or(0),
            Standing::Attempt => stated,
            Standing::Other => stated + 1 + as_close(a).unwrap_or(self.attempt_alike.len()),
            Standing::Rejected => usize::MAX,
        };
        answers.sort_by(|a, b| place(a).cmp(&place(b)).then(b.gain.total_cmp(&a.gain)));
        answers
    }

    /// Whether the verdict is that no effect is missing.
    pub fn is_quiet(&self) -> bool {
        self.verdict == Some(Verdict::None)
    }

    /// Whether effects and a fault outside the catalogue explain the data about as well.
    pub fn is_either(&self) -> bool {
        self.pattern.as_ref().is_some_and(|pattern| pattern.either)
    }

    /// What the final model has beyond the base, and how it is known; `None` where that is nothing.
    pub fn final_model(&self) -> Option<(String, &'static str)> {
        let (added, word) = match self.added.is_empty() {
            true => (&self.attempt, self.attempt_words()),
            false => (&self.added, "calibrated"),
        };
        let names: Vec<String> = added.iter().map(|a| in_step(&a.effect)).collect();
        (!names.is_empty()).then(|| (names.join(" "), word))
    }

    /// Label of an attempt in a list of answers.
    pub fn attempt_words(&self) -> &'static str {
        match &self.pattern {
            Some(pattern) if pattern.either => "attempt; one fault explains as much",
            Some(pattern) if pattern.simpler => "attempt; one fault explains more",
            _ => "attempt, not enough",
        }
    }

    /// Whether an effect is stated or attempted, alone or as a part of a pair.
    pub fn speaks_of(&self, effect: &str) -> bool {
        let stated = self.indistinguishable.iter().flat_map(|entry| entry.split(" + "));
        let added = self.added.iter().chain(&self.attempt).map(|a| a.effect.as_str());
        stated.chain(added).any(|name| name == effect)
    }

    /// The effects of a pair with their share of its values; refitted effects of the scenario come before them.
    fn members<'d>(&'d self, pair: &'d Combination) -> Vec<(&'d Ranked, &'d [ParameterValue])> {
        let effects: Vec<&Ranked> = pair.effects.iter().filter_map(|name| self.ranked(name)).collect();
        let own: usize = effects.iter().map(|r| r.parameters.len()).sum();
        let mut values = pair.parameters.get(pair.parameters.len().saturating_sub(own)..).unwrap_or(&[]);
        let mut member = |r: &'d Ranked| {
            let (first, rest) = values.split_at(r.parameters.len().min(values.len()));
            values = rest;
            (r, first)
        };
        effects.into_iter().map(&mut member).collect()
    }

    /// An effect as it is ranked.
    pub fn ranked(&self, effect: &str) -> Option<&Ranked> {
        self.ranked.iter().find(|r| r.effect == effect)
    }

    /// The closest in mm may be too far down the list of pairs to be in it.
    fn unreported_attempt(&self) -> EffectAnswer<'_> {
        let members = self.attempt.iter().filter_map(|a| Some((self.ranked(&a.effect)?, a.parameters.as_slice())));
        EffectAnswer {
            effects: members.collect(),
            bending_nm2: &self.base.bending_with_added_nm2,
            gain: f64::NAN,
            after_mm: self.base.systematic_with_added_mm,
            standing: Standing::Attempt,
        }
    }
}

/// What a model changes from the one before it: `+ a`, or `- a` where it leaves an effect out.
pub(crate) fn in_step(name: &str) -> String {
    taken_away(name).map_or_else(|| format!("+ {name}"), |gone| format!("- {gone}"))
}

/// The scenario with effects at their fitted values, and a B if one is given. Names that the scenario does not know are left out.
pub fn with_fitted(scenario: &Scenario, added: &[(&str, &[ParameterValue])], bending_nm2: Option<f64>) -> Scenario {
    let mut with = scenario.clone();
    for (name, fitted) in added {
        with.effects.retain(|e| taken_away(name) != Some(&e.name));
        let value = |key: &str| fitted.iter().find(|v| v.key == key).map(|v| v.value);
        with = with_values(&with, name, value);
    }
    bending_nm2.map_or(with.clone(), |b| with.with_bending(b))
}
