//! One of the data of a diagnosis made ready, with the base as it was measured there.

use super::source::{Source, is_rolled};
use crate::error::CompareError;
use crate::evidence::Evidence;
use crate::gauge::Gauge;
use crate::prepare::{Prepared, prepare};
use crate::slips::slips;
use crate::study::fit_scenario;
use crate::study::predict::without_settled;
use data::{Direct, MeasuredValue};
use models::Scenario;

/// An effect of which two descriptions measure the same parameter, and not the same.
pub(super) fn contradicted<'m>(before: &[MeasuredValue], now: &'m [MeasuredValue]) -> Option<&'m str> {
    let same = |a: &MeasuredValue, b: &MeasuredValue| (&a.effect, &a.key) == (&b.effect, &b.key);
    now.iter().find(|m| before.iter().any(|k| same(k, m) && k != *m)).map(|m| m.effect.as_str())
}

/// One of the data made ready.
pub(super) struct Part {
    pub scenario: Scenario,
    pub prepared: Prepared,
    direct: Direct,
    pub gauge: Option<Gauge>,
    pub bending_nm2: Option<[f64; 2]>,
    pub measured: Vec<MeasuredValue>,
    pub slips: Vec<String>,
}

impl Part {
    /// With cautions.
    pub fn of(scenario: &Scenario, measured: &Evidence) -> Result<(Part, Vec<String>), CompareError> {
        let (dataset, about) = (&measured.dataset, measured.about.as_ref());
        crate::layout::Layout::of(dataset)?;
        let (mut scenario, mut warnings) = fit_scenario(scenario, dataset, about)?;
        let slips = slips(dataset, &scenario.markers_m, scenario.radius_m);
        let mut prepared = prepare(dataset, about);
        warnings.append(&mut prepared.warnings);
        let mut direct = about.map(|a| a.direct).unwrap_or_default();
        if direct.pressure && dataset.gauge_pa.is_some() {
            warnings.push(
                "about.toml says [direct] pressure, so p_act is the actuator's own and the column p_gauge was not used"
                    .into(),
            );
        }
        let gauge = Gauge::of(&prepared.dataset, &scenario).filter(|_| !direct.pressure);
        if let Some(gauge) = &gauge {
            prepared.dataset = gauge.positions(&prepared.dataset);
            direct.pressure = true;
            scenario = without_settled(&scenario, direct);
        }
        let bending_nm2 = about.and_then(|a| a.bending_nm2);
        let measured = about.map(|a| a.measured.clone()).unwrap_or_default();
        Ok((Part { scenario, prepared, direct, gauge, bending_nm2, measured, slips }, warnings))
    }

    pub fn source(&self, first: &Scenario) -> Source<'_> {
        let Part { scenario, prepared, direct, gauge, bending_nm2, measured, .. } = self;
        let (direct, bending_nm2) = (*direct, *bending_nm2);
        let rolled = is_rolled(scenario, first);
        Source { scenario, dataset: &prepared.dataset, direct, gauge: gauge.as_ref(), rolled, bending_nm2, measured }
    }
}
