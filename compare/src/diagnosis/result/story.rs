//! Sentences that report a diagnosis: the verdict first, then its reasons.

use crate::policy;

use crate::diagnosis::candidates::taken_away;
use crate::diagnosis::result::words::{change, quantity, with_interval};
use crate::diagnosis::result::{
    Added, AsClose, Confidence, Diagnosis, FittedBeside, GaugeFit, Group, KeptBending, LearnedLaw, LeftPattern,
    OtherDesign, Ranked, Verdict, names_of,
};
use crate::evidence::ForeignBase;
use crate::fit::numbers::{largest, least, sort_by};
use crate::wording::{capitalised, list, p_value};

/// What comes as close as an attempt is named up to that many; `diagnosis.json` has all.
const MOST_AS_CLOSE: usize = 3;
/// Places where the model still fails that are named; the report has all.
const MOST_PLACES: usize = 2;

/// In place of a verdict on data with a slip of a pressure.
const WITHHELD: &str = "No verdict on these pressures: any effect that was named would only make up for the slip. Mend the column and \
                        run the same again; if the pressures are right, add --not pressure_slip.";

impl Diagnosis {
    /// The answer that depends on B, if there is one, in words.
    pub fn told_of_kept_bending(&self) -> Option<String> {
        self.kept_bending.as_ref().map(|kept| with_kept_bending(self, kept))
    }
}

impl LearnedLaw {
    /// The law, its errors and its numbers, one sentence each.
    pub fn sentences(&self) -> Vec<String> {
        let mm = |v: Option<f64>| v.map_or("unknown".into(), |mm| format!("{mm:.2}"));
        let (before, after) = (mm(self.heldout_before_mm), mm(self.heldout_after_mm));
        let line = self.line.as_ref().map_or(String::new(), |line| {
            let side = if line.value_mm < 0.0 { "nearer to" } else { "further from" };
            let what = format!(
                "the line of the markers, {:.1} mm {side} the taut side than in the scenario",
                line.value_mm.abs()
            );
            match line.heldout_mm.zip(self.heldout_before_mm) {
                Some((alone, before)) if policy::falls(alone, before) => {
                    format!("; of that {what}, brings it to {alone:.2} mm")
                }
                _ => format!("; {what}, was fitted along and lowers nothing alone"),
            }
        });
        vec![
            format!("A law learned from the missing moment, {}: {}.", self.words, self.formula),
            format!(
                "With it the error at pressures left out of the fit goes from {before} to {after} mm{line}. It was chosen by that \
                 figure: try it on other data."
            ),
            format!(
                "A law of this shape is usually {}. To check: {}. `ibr add SCENARIO learned DATA` writes it as a formula.",
                self.usual, self.check
            ),
        ]
    }
}

pub(crate) fn story(d: &Diagnosis) -> Vec<String> {
    let mut told: Vec<String> = d.foreign_bases.iter().map(ForeignBase::sentence).collect();
    told.push(opening(d));
    told.extend(d.beside.iter().map(beside));
    told.extend(d.gauges.iter().filter_map(gauge));
    told.extend(d.other_design.as_ref().map(|other| other_design(d, other)));
    // All mechanisms together take the place of each alone.
    let alone = if d.other_design.is_some() { &[][..] } else { &d.by_design };
    told.extend(alone.iter().map(|entry| by_design(d, entry)));
    told.extend(match d.verdict {
        None if d.pressure_slip.is_some() => vec![WITHHELD.into()],
        None => ranking_only(d),
        Some(Verdict::None) => nothing(d),
        Some(Verdict::Effect) => effect(d),
        Some(Verdict::OutOfCatalog) => outside(d),
    });
    if !d.rule_out_first.is_empty() {
        told.push(format!(
            "Rule out before physics: {}, because supply and measurement would look the same here.",
            list(&d.rule_out_first)
        ));
    }
    told.extend(d.learned.iter().flat_map(|law| law.sentences()));
    told.extend(d.bending_alarm.as_ref().map(|alarm| alarm.words.clone()));
    if !d.excluded.is_empty() {
        told.push(format!("Left out, because you said that it cannot be here: {}.", list(&d.excluded)));
    }
    told.extend(d.next_experiment.as_ref().map(|next| next.sentence.clone()));
    told
}

fn p_of(d: &Diagnosis) -> String {
    d.p_value.map(p_value).unwrap_or_default()
}

fn opening(d: &Diagnosis) -> String {
    let noise = d.base.noise_floor_mm.map_or("noise unknown".into(), |n| format!("noise of the mean {n:.2} mm"));
    let calibrated = if d.base.bending.is_empty() { "with the scenario's B" } else { "after fitting B" };
    format!("Misfit beyond noise: {:.2} mm {calibrated} ({noise}).", d.base.systematic_mm)
}

fn beside(part: &FittedBeside) -> String {
    let direct = match (part.direct.pressure, part.direct.frame) {
        (false, false) => "",
        (true, false) => ", pressure measured at the actuator",
        (false, true) => ", positions measured from the base",
        (true, true) => ", pressure measured at the actuator and positions from the base",
    };
    let (dataset, runs) = (&part.dataset, part.runs);
    let (before, after) = (part.systematic_mm, part.systematic_with_added_mm);
    format!(
        "Fitted along: {dataset} ({runs} runs{direct}), {before:.2} mm beyond noise with the base, {after:.2} mm with this answer."
    )
}

fn gauge(fit: &GaugeFit) -> Option<String> {
    let (read, set) = largest(fit.read_kpa.iter().zip(&fit.set_kpa), |(_, set)| **set)?;
    let (dataset, before_kpa, after_kpa) = (&fit.dataset, fit.before_kpa, fit.after_kpa);
    Some(format!(
        "The gauge in {dataset} read {read:.1} kPa at the actuator where {set:.1} were set. The supply's laws are off by \
         {before_kpa:.2} kPa (rms) as the scenario has them, by {after_kpa:.2} kPa with this answer; positions are predicted at \
         the readings."
    ))
}

fn other_design(d: &Diagnosis, other: &OtherDesign) -> String {
    let then = match other.verdict {
        Some(Verdict::Effect) => format!("; then missing: {}", other.indistinguishable.join(" or ")),
        _ => String::new(),
    };
    // A pair may leave less; other designs are asked for single effects.
    let (after, own) = (other.systematic_after_mm, d.base.systematic_with_added_mm);
    let instead = if after < own { format!(" instead of {own:.2}") } else { String::new() };
    let made = change(&other.switched).replace("adding", "with").replace("leaving out", "without");
    let made = capitalised(&made);
    format!(
        "First look at how the robot is made. {made}, with nothing of it fitted, the best single effect leaves {after:.2} mm{instead}{then}."
    )
}

fn by_design(d: &Diagnosis, entry: &AsClose) -> String {
    let name = list(&entry.effects);
    let sentence = d.ranked.iter().find(|r| entry.effects.contains(&r.effect)).map_or("", |r| &r.sentence);
    format!(
        "First look at how the robot is made. {sentence} The scenario has no {name}: switched on as the design has it, with \
         nothing of it fitted, it brings the misfit over all data to {:.2} mm.",
        entry.systematic_after_mm
    )
}

fn ranking_only(d: &Diagnosis) -> Vec<String> {
    let helps = d.ranked.iter().filter(|r| policy::helps(r.gain) && !r.at_bound);
    let names: Vec<&String> = helps.take(5).map(|r| &r.effect).collect();
    let order = match names.is_empty() {
        true => "No effect lowers the misfit.".to_string(),
        false => format!("In order of how much they lower the misfit, uncalibrated: {}.", list(&names)),
    };
    vec![format!("No verdict ({} usable runs: at least three are needed for p-values).", d.runs), order]
}

fn nothing(d: &Diagnosis) -> Vec<String> {
    let mut told =
        vec![format!("No missing effect detectable ({} after correcting for {} effects).", p_of(d), d.ranked.len())];
    let mut seen: Vec<_> =
        d.undetectable.iter().filter_map(|u| Some((u, u.smallest_detectable?, u.times_typical?))).collect();
    sort_by(&mut seen, |(.., times)| -times);
    if !seen.is_empty() {
        let parts = seen.iter().take(4).map(|(u, size, _)| format!("{} {}", u.effect, quantity(*size, &u.unit)));
        told.push(format!("To be seen, the effects that hide best would have to exceed: {}.", list(parts)));
    }
    told
}

fn effect(d: &Diagnosis) -> Vec<String> {
    let names = names_of(&d.added);
    let supply = d.gauges.first().filter(|_| d.added.iter().all(|a| a.group == Group::Supply));
    let brings = match supply {
        Some(gauge) => format!("the supply within {:.2} kPa of the gauge", gauge.after_kpa),
        None => format!("it to {:.2} mm", d.base.systematic_with_added_mm),
    };
    let mut told = vec![format!(
        "{} brings {brings} ({} after correcting for {} effects).",
        capitalised(&change(&names)),
        p_of(d),
        d.ranked.len()
    )];
    told.extend(worth(d));
    let values = |added: &Added| {
        let values: Vec<String> = added.parameters.iter().map(with_interval).collect();
        let sentence = d.ranked(&added.effect).map_or("", |r| &r.sentence);
        format!("{}: {}. {sentence}", added.effect, values.join(", "))
    };
    told.extend(d.added.iter().filter(|added| taken_away(&added.effect).is_none()).map(values));
    if let ([name], None) = (&names[..], supply) {
        told.extend(d.ranked(name).and_then(|r| held_out(d, r)));
    }
    told.extend(covered(d));
    if let Some(left) = d.lack_of_fit_after.filter(|left| left.p_value < d.alpha) {
        told.push(format!(
            "The remaining misfit, {:.2} mm, is small but more than noise ({}): the real law is not quite the catalogue's, or a second, \
             smaller effect is there.",
            d.base.systematic_with_added_mm,
            p_value(left.p_value)
        ));
    }
    let rival = if d.confidence == Some(Confidence::IdentifiedInCatalog) { ", without a rival in it" } else { "" };
    told.push(match d.confidence {
        Some(Confidence::Hint) => {
            "A hint only: evidence this weak often points to a neighbour of the true effect.".into()
        }
        _ => format!("Best explanation in this catalogue{rival}. Another effect that is not listed may look the same."),
    });
    told
}

/// Size of the answer in millimetres, after its name, where it is small here or much larger elsewhere.
fn worth(d: &Diagnosis) -> Option<String> {
    let worth = d.worth.as_ref()?;
    let here_mm = worth.here_mm;
    let elsewhere = worth.elsewhere_mm.zip(worth.elsewhere.as_ref());
    let small = policy::is_good_enough(here_mm, d.tolerance_mm);
    if !small && elsewhere.is_none_or(|(mm, _)| !policy::is_far_less(here_mm, mm)) {
        return None;
    }
    let tolerance = match small {
        true => format!(", below the tolerance of {:.2} mm", d.tolerance_mm),
        false => String::new(),
    };
    let most = elsewhere.map_or(String::new(), |(mm, words)| format!("; {mm:.2} mm if you {words}"));
    Some(format!("It moves the markers by {here_mm:.2} mm (rms) in these data{tolerance}{most}."))
}

fn covered(d: &Diagnosis) -> Option<String> {
    let share = 100.0 * d.covered?;
    Some(format!("Of 100 such answers on synthetic data, whatever was hidden, {share:.0} contain a true effect."))
}

fn held_out(d: &Diagnosis, r: &Ranked) -> Option<String> {
    let (before, after) = (d.base.heldout_mm?, r.heldout_mm?);
    let verdict = match () {
        () if before.max(after) <= d.tolerance_mm => "both within the tolerance, no argument for or against it",
        () if policy::falls(after, before) => "it predicts what it has not seen",
        () => "caution: it does not predict the pressures it has not seen",
    };
    Some(format!("At pressures left out of the fit the error goes from {before:.2} to {after:.2} mm: {verdict}."))
}

fn outside(d: &Diagnosis) -> Vec<String> {
    let p = p_of(d);
    let tried = change(&names_of(&d.attempt));
    let (before, after) = (d.base.systematic_mm, d.base.systematic_with_added_mm);
    let simpler = d.pattern.as_ref().filter(|pattern| pattern.simpler);
    let mut told = vec![if simpler.is_some_and(|pattern| pattern.either) {
        format!(
            "Either {tried}, which would bring it to {after:.2} mm ({p}), or one fault that is not in the catalogue: they explain \
             these data about as well, and the fault needs a single number."
        )
    } else if simpler.is_some() {
        format!(
            "{} would bring it to {after:.2} mm ({p}), but one fault that is not in the catalogue explains more, with a \
             single number.",
            capitalised(&tried)
        )
    } else if d.attempt.is_empty() {
        format!(
            "Nothing in the catalogue explains this ({p}): {before:.2} mm remain, and no effect of it takes a fifth off them."
        )
    } else if policy::is_mostly_gone(after, before) {
        format!(
            "{} takes away most of it, {before:.2} to {after:.2} mm, but nothing in the catalogue explains the rest \
             ({p}): a law that is not quite the catalogue's, or something that is not listed.",
            capitalised(&tried)
        )
    } else {
        format!(
            "Nothing in the catalogue explains this ({p}): {after:.2} mm remain after the best of it, {tried}, of {before:.2} mm \
             before."
        )
    }];
    told.extend(as_close(d));
    told.extend(at_its_bound(d));
    told.extend(d.told_of_kept_bending());
    told.extend(d.pattern.as_ref().map(looks_like));
    let places = if d.pattern.is_some() { 1 } else { MOST_PLACES };
    told.extend(d.leftover.iter().take(places).map(|s| s.sentence.clone()));
    told.push("Check markers, set-up and protocol there before looking for new physics.".into());
    told
}

fn as_close(d: &Diagnosis) -> Option<String> {
    let (attempt, others) = d.attempt_alike.split_first().filter(|(_, others)| !others.is_empty())?;
    let (first, rest) = others.split_at(others.len().min(MOST_AS_CLOSE));
    let name = |a: &AsClose| format!("{} ({:.2} mm)", a.effects.join(" + "), a.systematic_after_mm);
    let more = (!rest.is_empty()).then(|| format!("{} more", rest.len()));
    let names = list(first.iter().map(name).chain(more));
    let as_close = match d.beside.is_empty() {
        true => "As close".into(),
        false => format!("Over all data it leaves {:.2} mm; as close", attempt.systematic_after_mm),
    };
    Some(format!("{as_close}, to a fifth: {names}. These data do not choose between them."))
}

fn at_its_bound(d: &Diagnosis) -> Option<String> {
    let nearest = least(d.ranked.iter().filter(|r| r.at_bound), |r| r.systematic_after_mm)?;
    policy::is_closer(nearest.systematic_after_mm, d.base.systematic_with_added_mm).then(|| {
        let (effect, left) = (&nearest.effect, nearest.systematic_after_mm);
        let values = nearest.parameters.iter().filter(|p| !p.held);
        let values = values.map(|p| format!("{} = {}", p.symbol, quantity(p.value, &p.unit)));
        let values = values.collect::<Vec<_>>().join(", ");
        format!(
            "{effect} would leave {left:.2} mm, but at the end of its range, {values}, and the data push beyond it: more of it than was \
             thought possible, or something that looks like it."
        )
    })
}

fn with_kept_bending(d: &Diagnosis, kept: &KeptBending) -> String {
    let fitted = list(d.base.bending.iter().map(|b| format!("{:.2}", b.value_nm2)));
    let alike = if kept.indistinguishable.len() > 1 { ", which these data do not separate" } else { "" };
    format!(
        "With B kept at the scenario's {:.2} N·m² ({fitted} fitted to the base) there is an answer: {}{alike}, down to {:.2} mm. It \
         holds if a bending test finds that B: then write it into the scenario and add --keep-bending.",
        kept.value_nm2,
        list(&kept.indistinguishable),
        kept.systematic_after_mm
    )
}

fn looks_like(pattern: &LeftPattern) -> String {
    let what = if pattern.instead { "It" } else { "The remaining misfit" };
    let (words, percent) = (&pattern.words, 100.0 * pattern.share);
    let p = p_value(pattern.p_value);
    format!("{what} looks as if {words}: that alone makes up {percent:.0} % of it ({p} among all such patterns).")
}
