//! Which law of the library the points ask for.

use super::library::{LIBRARY, LawFormula};
use crate::fit::numbers::{groups, least, mean, sort_by};
use crate::policy;
use models::{Formula, Scenario};
use nalgebra::{DMatrix, DVector};
use std::sync::Arc;

#[derive(Debug, Clone)]
pub(crate) struct MomentMaterial {
    /// κ, θ, P, p_b, s, R, B and pull of each, SI ([`Formula::moment_at`]).
    pub places: Vec<[f64; 8]>,
    pub moments: DVector<f64>,
    pub covariance: DMatrix<f64>,
    /// The bending stiffness is fitted along; it may fall by so much \[N·m²\]. `None`: it is kept.
    pub stiffness: Option<f64>,
}

#[derive(Debug, Clone)]
pub(crate) struct Tried {
    /// The law; `None`: nothing is missing.
    pub form: Option<&'static LawFormula>,
    /// Of every level, the misfit there without it over the number of points.
    pub of_levels: Vec<f64>,
    /// Values fitted to all points, SI.
    pub values: Vec<f64>,
}

impl Tried {
    /// What it misses at levels left out, in units of noise: root mean square over the levels.
    pub(crate) fn score(&self) -> f64 {
        mean(self.of_levels.iter().copied()).sqrt()
    }
}

/// All laws, and none, by how well they predict levels that were left out, the best first; empty with fewer levels than that takes.
pub(crate) fn rank(material: &MomentMaterial, robot: &Scenario) -> Vec<Tried> {
    let levels = material.levels();
    let count = levels.iter().max().map_or(0, |last| last + 1);
    if count < policy::FEWEST_LEVELS {
        return Vec::new();
    }
    let bodies = material.places.iter().any(|at| policy::bodies_differ(at[3], material.places[0][3]));
    let is_fitted = |form: &LawFormula| material.stiffness.is_some() && form.is_stiffness();
    let open = LIBRARY.iter().filter(|form| (bodies || !form.is_of_body()) && !is_fitted(form));
    let tried = |form: Option<&'static LawFormula>| -> Option<Tried> {
        let law = TabulatedLaw::of(form, material, robot)?;
        let of_levels = (0..count).map(|level| law.missed(material, &levels, level)).collect::<Option<Vec<_>>>()?;
        let all: Vec<usize> = (0..levels.len()).collect();
        Some(Tried { form, of_levels, values: law.fit(material, &all)?.values })
    };
    let mut tried: Vec<Tried> = std::iter::once(None).chain(open.map(Some)).filter_map(tried).collect();
    tried.retain(|t| t.score().is_finite());
    sort_by(&mut tried, Tried::score);
    tried
}

/// Of laws with their numbers and what they miss at pressures left out, in units of noise, the one to take: the fewest numbers
/// where no other is closer by a fifth, one noise added to each.
pub(crate) fn taken(laws: &[(usize, f64)]) -> Option<usize> {
    let with_noise = |i: usize| 1.0_f64.hypot(laws[i].1);
    let best = least(0..laws.len(), |i| laws[*i].1)?;
    let mut alike: Vec<usize> = (0..laws.len()).collect();
    alike.retain(|i| !policy::is_closer(with_noise(best), with_noise(*i)));
    sort_by(&mut alike, |i| laws[*i].1);
    alike.into_iter().min_by_key(|i| laws[*i].0)
}

impl MomentMaterial {
    /// Level of actuator pressure of every point.
    fn levels(&self) -> Vec<usize> {
        let mut levels = vec![0; self.places.len()];
        let alike = groups(&self.places, |a, b| policy::is_same_pressure(a[2], b[2]));
        alike.iter().enumerate().for_each(|(level, own)| own.iter().for_each(|i| levels[*i] = level));
        levels
    }

    fn part(&self, rows: &[usize]) -> Option<nalgebra::Cholesky<f64, nalgebra::Dyn>> {
        DMatrix::from_fn(rows.len(), rows.len(), |i, j| self.covariance[(rows[i], rows[j])]).cholesky()
    }
}

/// A law at all points: its values there per unit of what it is linear in, for everything else that is tried.
struct TabulatedLaw {
    form: Option<&'static LawFormula>,
    /// Values of all numbers with which the columns were made, and these: one per linear number, and the stiffness's.
    grid: Vec<(Vec<f64>, DMatrix<f64>)>,
    /// Lower and upper bound of each coefficient.
    bounds: Vec<[f64; 2]>,
}

struct FittedLaw {
    values: Vec<f64>,
    cost: f64,
    columns: usize,
    coefficients: DVector<f64>,
}

impl TabulatedLaw {
    fn of(form: Option<&'static LawFormula>, material: &MomentMaterial, robot: &Scenario) -> Option<TabulatedLaw> {
        let numbers = form.map_or(&[][..], |f| f.numbers);
        let scales: Vec<f64> = numbers.iter().map(|n| n.scale(robot)).collect();
        let formula = form.and_then(|f| f.formula("learned", robot));
        let spring = material.stiffness.filter(|_| form.is_none_or(|f| !f.has_spring()));
        let linear = || numbers.iter().zip(&scales).filter(|(n, _)| n.is_linear());
        let mut bounds: Vec<[f64; 2]> = linear().map(|(n, scale)| n.bounds.map(|b| b * scale)).collect();
        bounds.extend(spring.map(|most| [-most, f64::INFINITY]));
        let mut sets = vec![Vec::new()];
        for (n, scale) in numbers.iter().zip(&scales) {
            let values = if n.is_linear() { vec![0.0] } else { n.tried.iter().map(|v| v * scale).collect() };
            sets = sets.iter().flat_map(|s| values.iter().map(|v| [s.as_slice(), &[*v]].concat())).collect();
        }
        let column = |set: &[f64], formula: &Arc<Formula>, k: usize| -> Vec<f64> {
            let mut values = set.to_vec();
            values[k] = scales[k];
            material.places.iter().map(|at| formula.moment_at(at, &values) / scales[k]).collect()
        };
        let bends: Vec<f64> = material.places.iter().map(|at| -at[0]).collect();
        let columns = |set: Vec<f64>| {
            let own = (0..numbers.len()).filter(|k| numbers[*k].is_linear());
            let mut all: Vec<Vec<f64>> = own.filter_map(|k| Some(column(&set, formula.as_ref()?, k))).collect();
            all.extend(spring.map(|_| bends.clone()));
            let rows = material.places.len();
            let columns = DMatrix::from_fn(rows, all.len(), |i, j| all[j][i]);
            (set, columns)
        };
        (form.is_none() || formula.is_some()).then(|| TabulatedLaw {
            form,
            grid: sets.into_iter().map(columns).collect(),
            bounds,
        })
    }

    /// The best over all that is tried.
    fn fit(&self, material: &MomentMaterial, rows: &[usize]) -> Option<FittedLaw> {
        let root = material.part(rows)?;
        let y = DVector::from_iterator(rows.len(), rows.iter().map(|i| material.moments[*i]));
        let y = root.l_dirty().solve_lower_triangular(&y)?;
        let mut best: Option<FittedLaw> = None;
        for (at, (set, columns)) in self.grid.iter().enumerate() {
            let own = DMatrix::from_fn(rows.len(), columns.ncols(), |i, j| columns[(rows[i], j)]);
            let own = root.l_dirty().solve_lower_triangular(&own)?;
            let Some(coefficients) = bounded(&own, &y, &self.bounds) else { continue };
            let cost = (&own * &coefficients - &y).norm_squared();
            if best.as_ref().is_none_or(|b| cost < b.cost) {
                best = Some(FittedLaw { values: self.values(set, &coefficients), cost, columns: at, coefficients });
            }
        }
        best
    }

    fn values(&self, set: &[f64], coefficients: &DVector<f64>) -> Vec<f64> {
        let mut next = coefficients.iter();
        let numbers = self.form.map_or(&[][..], |f| f.numbers).iter().zip(set);
        numbers.map(|(n, v)| if n.is_linear() { next.next().copied().unwrap_or(0.0) } else { *v }).collect()
    }

    /// What the law, fitted without a level, misses there.
    fn missed(&self, material: &MomentMaterial, levels: &[usize], level: usize) -> Option<f64> {
        let (out, kept): (Vec<usize>, Vec<usize>) = (0..levels.len()).partition(|i| levels[*i] == level);
        let fitted = self.fit(material, &kept)?;
        let columns = &self.grid[fitted.columns].1;
        let left = |i: &usize| material.moments[*i] - (columns.row(*i) * &fitted.coefficients)[(0, 0)];
        let left = DVector::from_iterator(out.len(), out.iter().map(left));
        let root = material.part(&out)?;
        Some(root.l_dirty().solve_lower_triangular(&left)?.norm_squared() / out.len() as f64)
    }
}

/// Least squares with bounds: values beyond a bound are held there and the others are fitted again.
fn bounded(columns: &DMatrix<f64>, y: &DVector<f64>, bounds: &[[f64; 2]]) -> Option<DVector<f64>> {
    let count = columns.ncols();
    let mut held: Vec<Option<f64>> = vec![None; count];
    loop {
        let free: Vec<usize> = (0..count).filter(|j| held[*j].is_none()).collect();
        let fixed = DVector::from_iterator(count, held.iter().map(|h| h.unwrap_or(0.0)));
        let own = DMatrix::from_fn(columns.nrows(), free.len(), |i, j| columns[(i, free[j])]);
        let normal = own.tr_mul(&own);
        let mut all = fixed.clone();
        if !free.is_empty() {
            let found = normal.cholesky()?.solve(&own.tr_mul(&(y - columns * &fixed)));
            free.iter().zip(found.iter()).for_each(|(j, v)| all[*j] = *v);
        }
        let beyond = free.iter().find(|j| !(bounds[**j][0]..=bounds[**j][1]).contains(&all[**j]));
        match beyond {
            Some(j) => held[*j] = Some(all[*j].clamp(bounds[*j][0], bounds[*j][1])),
            None => return Some(all),
        }
    }
}
