//! `ibr diagnose SCENARIO --published`: what the one displacement that the paper prints can tell.

use super::{Context, Outcome};
use crate::failure::Failure;
use crate::output::{check_folder, write_files};
use crate::shown::one_number::text;
use compare::study::one_number::{Explanation, OneNumber, one_number};
use ibr::pages::Files;
use models::scenario::SHIPPED;
use report::{LineSeries, LineStyle, Lines, lines};
use serde_json::json;
use std::path::Path;

/// Explanations drawn as curves: with the bare model and the published number as many as a plot holds.
const MOST_CURVES: usize = 22;

pub fn run(kind: &str, out: Option<&Path>, context: &mut Context) -> Result<Outcome, Failure> {
    out.map_or(Ok(()), check_folder)?;
    if models::shipped(kind).is_none() {
        let message = format!("the paper printed no displacement of `{kind}`");
        let kinds: Vec<&str> = SHIPPED.iter().map(|s| s.0).collect();
        let help = format!("with --published name a robot of the paper; {}", spelling::known(kind, &kinds));
        return Err(Failure::usage(message, help));
    }
    let one = one_number(kind)?;
    let mut outcome = Outcome::new(text(&one), json!({"schema": "ibr.one_number", "version": 1, "result": one}));
    if let Some(folder) = out {
        let mut files = Files::default();
        let drawn = lines(&curves(&one)).map_err(|e| Failure::usage(format!("the curves: {e}"), "report this"))?;
        files.plot(&format!("one_number_{kind}"), drawn);
        write_files(folder, &files, &[], context)?;
        outcome.notes.push(format!("plot: {}", folder.join(format!("one_number_{kind}.png")).display()));
    }
    Ok(outcome)
}

/// Explanations from the least to the most bend at the first pressure; of more than fit the ends and the smallest sizes.
fn drawn(one: &OneNumber) -> Vec<&Explanation> {
    let first = |e: &Explanation| e.y_mm.first().copied().unwrap_or(0.0);
    let ends = [f64::min, f64::max].map(|end| one.met_by.iter().map(first).reduce(end));
    let (mut kept, rest): (Vec<&Explanation>, Vec<&Explanation>) =
        one.met_by.iter().partition(|e| ends.contains(&Some(first(e))));
    kept.extend(rest);
    kept.truncate(MOST_CURVES);
    kept.sort_by(|a, b| first(a).total_cmp(&first(b)));
    kept
}

fn curves(one: &OneNumber) -> Lines {
    let points = |y_mm: &[f64]| one.p_act_kpa.iter().zip(y_mm).map(|(p, y)| [*p, *y]).collect::<Vec<_>>();
    let line = |name: &str, y_mm: &[f64], style| LineSeries {
        name: name.into(),
        points: points(y_mm),
        half_width: Vec::new(),
        style,
        colour: None,
    };
    let top = one.p_act_kpa.len() - 1;
    let mut series = vec![line("without B", &one.bare_mm, LineStyle::Dashed)];
    series.extend(drawn(one).into_iter().map(|e| line(&e.effect, &e.y_mm, LineStyle::LinePoints)));
    series.push(LineSeries {
        name: "published".into(),
        points: vec![[one.p_act_kpa[top], one.measured_mm]],
        half_width: Vec::new(),
        style: LineStyle::OpenPoints,
        colour: None,
    });
    Lines {
        title: format!("{}: all of these meet the one published number", one.robot),
        x_label: "actuator pressure [kPa]".into(),
        y_label: "displacement [mm]".into(),
        series,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_explanation_is_drawn_the_ends_first_where_they_are_too_many() {
        let mut one = one_number("cpam").unwrap();
        let named = |one: &OneNumber| curves(one).series.iter().map(|s| s.name.clone()).collect::<Vec<_>>();
        assert_eq!(named(&one).len(), one.met_by.len() + 2);
        let inner = one.met_by.iter().find(|e| e.effect == "friction").unwrap().clone();
        one.met_by.splice(0..0, vec![inner; MOST_CURVES]);
        let names = named(&one);
        assert_eq!(
            (names.len(), &*names[1], &*names[MOST_CURVES]),
            (MOST_CURVES + 2, "pressure_offset", "ovalization")
        );
        assert!(lines(&curves(&one)).is_ok());
    }
}
