//! Hypotheses beside the catalogue: nothing, a law that nobody wrote down, a fault of a place, a hold or a marker.

use super::judge::{Hypothesis, Judge};
use super::judged::Kind;
use crate::moment::{Factor, Prior, Robot, Weighed, shift_numbers, weigh};
use crate::policy;
use models::Scenario;
use nalgebra::DVector;

impl Judge<'_> {
    /// The base with further columns of covariance.
    fn base_with(&self, columns: &[DVector<f64>]) -> Option<Weighed> {
        let base = &self.case.base;
        let priors = self.priors(&base.effects, base.theta());
        let bendings = self.case.problem.bendings;
        let own: Vec<Prior> = priors[..bendings].iter().flatten().map(|(prior, _)| *prior).collect();
        let whole = |values: &[f64]| [values, &base.theta()[bendings..]].concat();
        let mut covariance = self.covariance.clone();
        columns.iter().for_each(|column| covariance += column * column.transpose());
        let predict = |values: &[f64]| self.predict(&base.effects, &whole(values));
        weigh(&self.measured, &own, &base.theta()[..bendings], &predict, &|_| Some(covariance.clone()))
    }

    /// A smooth share of the actuator's moment that nobody wrote down, of three sizes.
    pub fn unknown(&self) -> Vec<Hypothesis> {
        let base = &self.case.base;
        let pull = self.stack(|part| {
            let with = self.scenarios(part, &base.effects, base.theta());
            let less: Vec<Scenario> = with.iter().map(|s| s.with_effect("pressure_loss", &[LESS, 1.0])).collect();
            let with = Robot { scenarios: &with, of_hold: &part.of_hold };
            let less = Robot { scenarios: &less, of_hold: &part.of_hold };
            part.response(&less, &with, &FREE)
        });
        let Some(columns) = pull else { return Vec::new() };
        let weigh = |size: &f64| {
            let weighed = self.base_with(&columns.iter().map(|c| c * (*size / LESS)).collect::<Vec<_>>())?;
            let weight = policy::PRIOR_UNKNOWN / UNKNOWN_SIZES.len() as f64;
            Some(Hypothesis { words: "unknown law".into(), kind: Kind::Unknown, weight, weighed })
        };
        UNKNOWN_SIZES.iter().filter_map(weigh).collect()
    }

    /// A place that bends otherwise in every hold, a hold that bends otherwise, a marker that sits elsewhere; in the first data.
    pub fn faults(&self) -> Vec<Hypothesis> {
        let Some(part) = self.parts.first() else { return Vec::new() };
        let division = &part.shape.division;
        let (places, holds) = (division.places.len(), part.view.dataset.holds.len());
        let mut faults: Vec<(String, Vec<DVector<f64>>)> = Vec::new();
        let bends = |hold: usize, place: usize| part.shape.numbers[hold * places + place];
        let column = |wanted: &dyn Fn(usize, usize) -> bool| {
            let mut column = DVector::zeros(self.measured.len());
            for hold in 0..holds {
                for place in (0..places).filter(|place| wanted(hold, *place)) {
                    column[hold * places + place] = FAULT * bends(hold, place);
                }
            }
            column
        };
        if places > 1 {
            let fault = |p: usize| {
                let [from, to] = [division.places[p].from_m, division.places[p].to_m].map(|m| 1e3 * m);
                (format!("the place from {from:.0} to {to:.0} mm"), vec![column(&|_, place| place == p)])
            };
            faults.extend((0..places).map(fault));
        }
        faults.extend((1..holds).map(|h| (format!("hold {}", h + 1), vec![column(&|hold, _| hold == h)])));
        for (marker, told) in part.view.dataset.markers.iter().enumerate() {
            let columns = [0, 1].map(|axis| {
                let own = shift_numbers(&part.view, &part.shape, marker, axis, MARKER_M);
                let mut column = DVector::zeros(self.measured.len());
                column.rows_mut(0, own.len()).copy_from(&own);
                column
            });
            faults.push((format!("marker {}", told.name), columns.to_vec()));
        }
        let count = faults.len() as f64;
        let weigh = |(words, columns): (String, Vec<DVector<f64>>)| {
            let weighed = self.base_with(&columns)?;
            Some(Hypothesis { words, kind: Kind::Fault, weight: policy::PRIOR_FAULT / count, weighed })
        };
        faults.into_iter().filter_map(weigh).collect()
    }
}

/// Of which a law that nobody wrote down is made.
const FREE: [Factor; 6] = [|_, _| 1.0, |u, _| u, |_, v| v, |u, _| 0.5 * u * u, |_, v| 0.5 * v * v, |u, v| u * v];
/// Its sizes, as shares of the actuator's moment.
const UNKNOWN_SIZES: [f64; 3] = [0.03, 0.1, 0.3];
/// Share of the pressure whose loss weighs the actuator's moment.
const LESS: f64 = 0.01;
/// Share by which the bend of a faulty place or hold is off.
const FAULT: f64 = 0.2;
/// By how much a marker is off \[m\].
const MARKER_M: f64 = 5e-3;
