//! One dataset on its way through a diagnosis, with the base as it was measured there.

use crate::error::CompareError;
use crate::evidence::Evidence;
use crate::fit::numbers::{groups, least};
use crate::gauge::Gauge;
use crate::layout::Layout;
use crate::noise::NoiseModel;
use crate::policy;
use crate::prepare::{Outliers, prepare};
use crate::slips::slips_of;
use crate::study::fit_scenario;
use crate::study::predict::{is_open, seen_by, without_settled};
use data::{About, Dataset, Direct, Hold, MeasuredValue};
use models::Scenario;
use models::effects::Stage;

/// Whether one direction of gravity is the other one rolled by 180° about the robot's axis: it pulls the other way across.
pub(super) fn is_rolled([ax, ay, az]: [f64; 3], [bx, by, bz]: [f64; 3]) -> bool {
    ay.abs().max(az.abs()) > policy::SAME_DIRECTION
        && (ax - bx).abs() < policy::SAME_DIRECTION
        && (ay + by).abs().max((az + bz).abs()) < policy::SAME_DIRECTION
}

/// A scenario as the robot sees it when it is rolled by 180°: forces and cameras that stay in the room change sides.
pub(super) fn seen_rolled(scenario: &Scenario) -> Scenario {
    let mut seen = scenario.clone();
    for effect in seen.effects.iter_mut() {
        let parameters = models::effects::by_name(&effect.name).map_or(&[][..], |entry| entry.parameters);
        let in_room = parameters.iter().zip(&mut effect.values).filter(|(p, _)| p.in_room);
        in_room.for_each(|(_, value)| *value = -*value);
    }
    seen
}

/// Distinct body pressures in order of appearance \[Pa\].
pub(super) fn body_pressures<'d>(datasets: impl IntoIterator<Item = &'d Dataset>) -> Vec<f64> {
    levels(datasets.into_iter().flat_map(|dataset| &dataset.holds).map(|hold| hold.p_body_pa))
}

/// Distinct actuator pressures above zero in order of appearance, sums over supply channels \[Pa\].
pub(super) fn pressure_levels(holds: &[Hold]) -> Vec<f64> {
    levels(holds.iter().map(Hold::sum_act_pa).filter(|p| *p > policy::ZERO_PRESSURE_PA))
}

fn levels(pressures_pa: impl Iterator<Item = f64>) -> Vec<f64> {
    let all: Vec<f64> = pressures_pa.collect();
    groups(&all, |a, b| policy::is_same_pressure(**a, **b)).iter().map(|own| all[own[0]]).collect()
}

/// Index of the nearest level; 0 without levels.
pub(super) fn nearest(levels: &[f64], p: f64) -> usize {
    least(0..levels.len(), |level| (levels[*level] - p).abs()).unwrap_or(0)
}

/// A dataset, its base as measured there, and further measurements of the same robot.
#[derive(Clone)]
pub(crate) struct DiagnosisSource {
    /// The base with the dataset's markers and loads, without effects of what was measured directly.
    pub scenario: Scenario,
    /// The data without copies and strays; with a gauge at its readings.
    pub dataset: Dataset,
    /// Session of every run; empty if there is one.
    pub sessions: Vec<usize>,
    pub direct: Direct,
    /// Readings of the actuator's pressure, which the supply's laws must meet.
    pub gauge: Option<Gauge>,
    /// Rolled by 180° against the first data: effects fixed to the room act the other way.
    pub rolled: bool,
    /// Bending stiffness at the first body pressure, measured separately, and its standard deviation \[N·m²\].
    pub bending_nm2: Option<[f64; 2]>,
    /// Parameters of effects measured by themselves.
    pub measured: Vec<MeasuredValue>,
    pub outliers: Outliers,
    /// Slips in the table as it was read, in words.
    pub slips: Vec<String>,
}

impl DiagnosisSource {
    /// Of data as they are, with a scenario that is fitted to them.
    pub(crate) fn of(scenario: Scenario, dataset: Dataset, about: Option<&About>) -> DiagnosisSource {
        DiagnosisSource {
            scenario,
            dataset,
            sessions: Vec::new(),
            direct: about.map(|a| a.direct).unwrap_or_default(),
            gauge: None,
            rolled: false,
            bending_nm2: about.and_then(|a| a.bending_nm2),
            measured: about.map(|a| a.measured.clone()).unwrap_or_default(),
            outliers: Outliers::default(),
            slips: Vec::new(),
        }
    }

    /// Of evidence made ready, with cautions.
    pub(crate) fn prepared(
        scenario: &Scenario,
        evidence: &Evidence,
    ) -> Result<(DiagnosisSource, Vec<String>), CompareError> {
        let (dataset, about) = (&evidence.dataset, evidence.about.as_ref());
        Layout::of(dataset)?;
        let (scenario, mut warnings) = fit_scenario(scenario, dataset, about)?;
        let slips = slips_of(dataset, &scenario);
        let mut prepared = prepare(dataset, about);
        warnings.append(&mut prepared.warnings);
        let dataset_seen = seen_by(&scenario, prepared.dataset);
        let mut source = DiagnosisSource::of(scenario, dataset_seen, about);
        if source.direct.pressure && dataset.gauge_pa.is_some() {
            let own = "about.toml has [direct] pressure, so p_act is the actuator's own";
            warnings.push(format!("{own} and the column p_gauge was not used"));
        }
        let several = source.dataset.channels_differ();
        if several && dataset.gauge_pa.is_some() {
            warnings.push("the column p_gauge is of one supply channel and was not used: the table has several".into());
        }
        let gauge = Gauge::of(&source.dataset, &source.scenario).filter(|_| !source.direct.pressure && !several);
        if let Some(gauge) = &gauge {
            source.dataset = gauge.positions(&source.dataset);
            source.direct.pressure = true;
            source.scenario = without_settled(&source.scenario, source.direct);
        }
        let (sessions, outliers) = (prepared.sessions, prepared.outliers);
        Ok((DiagnosisSource { sessions, gauge, outliers, slips, ..source }, warnings))
    }

    pub(crate) fn all(
        scenario: &Scenario,
        evidence: &[Evidence],
    ) -> Result<(Vec<DiagnosisSource>, Vec<String>), CompareError> {
        let (mut sources, mut warnings) = (Vec::<DiagnosisSource>::new(), Vec::new());
        for (i, measured) in evidence.iter().enumerate() {
            let name = &measured.dataset.name;
            if evidence[..i].iter().any(|seen| seen.dataset.coordinates_m == measured.dataset.coordinates_m) {
                let copy = "is a copy of data that are there already and was left out";
                warnings.push(format!("{name} {copy}: copies are not repeats"));
                continue;
            }
            let own = measured.about.as_ref().and_then(|a| a.gravity_direction);
            let own = own.map_or(scenario.gravity_direction, |[x, y]| [x, y, 0.0]);
            let rolled = sources.first().is_some_and(|first| is_rolled(own, first.scenario.gravity_direction));
            let base = if rolled { seen_rolled(scenario) } else { scenario.clone() };
            let (source, told) = DiagnosisSource::prepared(&base, measured)?;
            let bending = source.contradicts_bending(&sources).then(|| "bending".to_string());
            let effect = sources.iter().find_map(|known| known.contradicts(&source));
            for what in bending.into_iter().chain(effect.map(|effect| format!("measured.{effect}"))) {
                let before = "in the about.toml of data before it, which is used";
                warnings.push(format!("{name} contradicts [{what}] {before}"));
            }
            let of = if i > 0 { format!("{name}: ") } else { String::new() };
            warnings.extend(source.slips.iter().cloned());
            warnings.extend(told.into_iter().map(|warning| format!("{of}{warning}")));
            sources.push(DiagnosisSource { rolled, ..source });
        }
        Ok((sources, warnings))
    }

    /// An effect of which the other description measures the same parameter, and not the same.
    fn contradicts<'m>(&self, other: &'m DiagnosisSource) -> Option<&'m str> {
        let same = |a: &MeasuredValue, b: &MeasuredValue| (&a.effect, &a.key) == (&b.effect, &b.key);
        let differs = |m: &&MeasuredValue| self.measured.iter().any(|k| same(k, m) && k != *m);
        other.measured.iter().find(differs).map(|m| m.effect.as_str())
    }

    fn contradicts_bending(&self, before: &[DiagnosisSource]) -> bool {
        let tested = before.iter().find_map(|known| known.bending_nm2).zip(self.bending_nm2);
        tested.is_some_and(|(known, own)| known != own)
    }

    pub(crate) fn shows(&self, stage: Stage) -> bool {
        is_open(stage, self.direct) || stage == Stage::Supply && self.gauge.is_some()
    }

    /// The base with all its effects.
    pub(crate) fn as_given(&self) -> &Scenario {
        self.gauge.as_ref().map_or(&self.scenario, |gauge| &gauge.scenario)
    }

    /// The dataset at its set pressures.
    pub(crate) fn as_set(&self) -> Dataset {
        self.gauge.as_ref().map_or_else(|| self.dataset.clone(), |gauge| gauge.as_set(&self.dataset))
    }

    /// Noise at the readings of the gauge, if there is one, given ∂f/∂ln p.
    pub(crate) fn at_readings(&self, noise: NoiseModel, slope: &[f64]) -> Result<NoiseModel, CompareError> {
        match &self.gauge {
            Some(gauge) => noise.at_readings(gauge.errors_m(&self.dataset, slope)),
            None => Ok(noise),
        }
    }
}

#[cfg(test)]
mod tests {
    #[test]
    fn a_robot_is_rolled_if_gravity_pulls_it_the_other_way_across_to_a_twentieth() {
        let is_rolled = |[ax, ay]: [f64; 2], [bx, by]: [f64; 2]| {
            let in_z = super::is_rolled([ax, 0.0, ay], [bx, 0.0, by]);
            assert_eq!(super::is_rolled([ax, ay, 0.0], [bx, by, 0.0]), in_z);
            in_z
        };
        assert!(is_rolled([0.0, -1.0], [0.0, 1.0]) && !is_rolled([0.0, -1.0], [0.0, -1.0]));
        // Hung along x nothing is across.
        assert!(is_rolled([0.99, 0.051], [0.99, -0.051]) && !is_rolled([1.0, 0.049], [1.0, -0.049]));
        assert!(is_rolled([0.0, -1.0], [0.049, 1.0]) && !is_rolled([0.0, -1.0], [0.051, 1.0]));
        assert!(is_rolled([0.0, -1.0], [0.0, 0.951]) && !is_rolled([0.0, -1.0], [0.0, 0.949]));
    }
}
