//! All that meets one published displacement, as curves.

use super::Result;
use crate::prelude::*;
use compare::study::one_number::{Explanation, OneNumber};
use data::published::printed;
use report::lines;

/// Explanations drawn as curves: with the bare model and the published number as many as a plot holds.
const MOST_CURVES: usize = 22;

pub(crate) fn one_number_files(one: &OneNumber) -> Result<Files> {
    let mut files = Files::default();
    files.plot(&format!("one_number_{}", one.actuator), lines(&curves(one))?);
    Ok(files)
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
    let line = |name: &str, y_mm: &[f64], style| LineSeries::new(name, style, points(y_mm));
    let top = one.p_act_kpa.len() - 1;
    let mut series = vec![line("without B", &one.bare_mm, LineStyle::Dashed)];
    series.extend(drawn(one).into_iter().map(|e| line(&effect(&e.effect), &e.y_mm, LineStyle::LinePoints)));
    let published = vec![[one.p_act_kpa[top], one.measured_mm]];
    series.push(LineSeries::new("published", LineStyle::OpenPoints, published));
    let title = format!("{}: all of these meet the one published number", printed(&one.actuator));
    Lines::new(title, "actuator pressure [kPa]", "displacement [mm]", series)
}

#[cfg(test)]
mod tests {
    use super::*;
    use compare::study::one_number::one_number;

    #[test]
    fn every_explanation_is_drawn_the_ends_first_where_they_are_too_many() {
        let mut one = one_number("cpam-textbook").unwrap();
        let named = |one: &OneNumber| curves(one).series.iter().map(|s| s.name.clone()).collect::<Vec<_>>();
        assert_eq!(named(&one).len(), one.met_by.len() + 2);
        let inner = one.met_by.iter().find(|e| e.effect == "friction").unwrap().clone();
        one.met_by.splice(0..0, vec![inner; MOST_CURVES]);
        let names = named(&one);
        assert_eq!(
            (names.len(), &*names[1], &*names[MOST_CURVES]),
            (MOST_CURVES + 2, "pressure offset", "ovalization")
        );
        assert!(lines(&curves(&one)).is_ok());
    }
}
