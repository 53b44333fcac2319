//! Scatter of single holds a second time: MINQUE of the hold means with dense matrices.

use data::Dataset;
use nalgebra::{DMatrix, DVector};
use statrs::distribution::{ContinuousCDF, FisherSnedecor};

/// P(F > f).
pub(crate) fn f_tail(f: f64, numerator: usize, denominator: usize) -> f64 {
    FisherSnedecor::new(numerator as f64, denominator as f64).unwrap().sf(f)
}

/// Mean over some of the runs.
pub(crate) fn mean(data: &Dataset, is_in: impl Fn(usize) -> bool) -> DVector<f64> {
    let runs: Vec<usize> = (0..data.runs.len()).filter(|run| is_in(*run)).collect();
    let sum = runs
        .iter()
        .fold(DVector::zeros(data.values_per_run()), |sum, run| sum + DVector::from_column_slice(data.run(*run)));
    sum / runs.len() as f64
}

/// Scatter of single holds: of every kind Z Zᵀ of all values, and its variance in one run, best estimate and as in tests.
pub(crate) struct Held {
    pub kinds: Vec<(DMatrix<f64>, f64, f64)>,
    /// σ² of single values with its degrees of freedom, where errors last through a hold.
    pub lasting: Option<(f64, usize)>,
}

impl Held {
    /// MINQUE of the hold means with dense matrices; `u` are the errors of runs, σ² that of single values with so many degrees of freedom.
    pub(crate) fn of(data: &Dataset, u: &DMatrix<f64>, (sigma2, sigma_dof): (f64, usize)) -> Held {
        let (holds, samples, width) = (data.holds.len(), data.samples_per_hold, 2 * data.markers.len());
        let (n, cells, dof) = (data.values_per_run(), holds * width, (data.runs.len() - 1) as f64);
        if holds < 3 || data.runs.len() < 3 {
            return Held { kinds: Vec::new(), lasting: None };
        }
        let cell = |i: usize| i / (width * samples) * width + i % width;
        let repeated = DMatrix::from_fn(n, cells, |i, c| f64::from(u8::from(cell(i) == c)));
        let averaged = repeated.transpose() / samples as f64;
        let (all, of_runs) = (mean(data, |_| true), &averaged * u);
        let means = &averaged * &all;
        let pressure = |h: &usize| data.holds[*h].p_act_pa;
        let straight = (0..holds).min_by(|a, b| pressure(a).total_cmp(&pressure(b))).unwrap() * width;
        let bend = DVector::from_fn(cells, |c, _| means[c] - means[straight + c % width]);
        let in_holds = |shapes: Vec<DVector<f64>>| {
            let of_hold = |h: usize| {
                move |shape: &DVector<f64>| DVector::from_fn(cells, |c, _| if c / width == h { shape[c] } else { 0.0 })
            };
            DMatrix::from_columns(
                &(0..holds).flat_map(|h| shapes.iter().map(of_hold(h)).collect::<Vec<_>>()).collect::<Vec<_>>(),
            )
        };
        let column = |j: usize| of_runs.column(j).into_owned();
        let of_markers = DMatrix::from_fn(cells, width, |c, m| f64::from(u8::from(c % width == m)));
        let z = [
            in_holds(vec![column(0)]),
            in_holds(vec![bend]),
            in_holds(vec![column(1), column(2)]),
            in_holds(vec![column(3)]),
            of_markers,
        ];
        let hat = &of_runs * of_runs.tr_mul(&of_runs).try_inverse().unwrap() * of_runs.transpose();
        let m = DMatrix::identity(cells, cells) - hat;
        let squares: Vec<DMatrix<f64>> = z.iter().map(|z| z * z.transpose()).collect();
        let mut v = vec![m.clone()];
        v.extend(squares.iter().map(|zz| &m * zz * &m));
        let scatter =
            (0..data.runs.len()).map(|run| &m * &averaged * (DVector::from_column_slice(data.run(run)) - &all));
        let scatter = scatter.fold(DMatrix::zeros(cells, cells), |sum, d| sum + &d * d.transpose()) / dof;
        let mut used: Vec<usize> =
            (0..v.len()).filter(|k| *k == 0 || v[*k].trace() > 0.05 * squares[*k - 1].trace()).collect();
        let (theta, inverse) = loop {
            let scale: Vec<f64> = used.iter().map(|k| v[*k].norm()).collect();
            let of = |i: usize, j: usize| v[used[i]].dot(&v[used[j]]) / (scale[i] * scale[j]);
            let inverse = DMatrix::from_fn(used.len(), used.len(), of).try_inverse().unwrap();
            let scaled = &inverse * DVector::from_fn(used.len(), |i, _| v[used[i]].dot(&scatter) / scale[i]);
            let least = (1..used.len()).min_by(|a, b| scaled[*a].total_cmp(&scaled[*b]));
            match least.filter(|i| scaled[*i] < 0.0) {
                Some(i) => drop(used.remove(i)),
                None => {
                    let unscaled = |i: usize, j: usize| inverse[(i, j)] / (scale[i] * scale[j]);
                    let theta: Vec<f64> = (0..used.len()).map(|i| scaled[i] / scale[i]).collect();
                    break (theta, DMatrix::from_fn(used.len(), used.len(), unscaled));
                }
            }
        };
        let c = used.iter().zip(&theta).fold(DMatrix::zeros(cells, cells), |sum, (k, t)| sum + &v[*k] * *t);
        let vc: Vec<DMatrix<f64>> = used.iter().map(|k| &v[*k] * &c).collect();
        let forms = DMatrix::from_fn(used.len(), used.len(), |i, j| 2.0 / dof * (&vc[i] * &vc[j]).trace());
        let covariance = &inverse * forms * &inverse;
        let sd = |i: usize| covariance[(i, i)].sqrt();
        let kind = |i: usize| {
            let full = &repeated * &z[used[i] - 1];
            (&full * full.transpose(), theta[i], theta[i] + sd(i))
        };
        let (of_reading, reading_dof) =
            (theta[0] * samples as f64, (2.0 * (theta[0] / sd(0)).powi(2)).round() as usize);
        let lasts = f_tail(of_reading / sigma2, reading_dof, sigma_dof) < 0.05;
        Held { kinds: (1..used.len()).map(kind).collect(), lasting: lasts.then_some((of_reading, reading_dof)) }
    }

    /// Covariance of all values of one run as in tests.
    pub(crate) fn tested(&self, values: usize) -> DMatrix<f64> {
        self.kinds.iter().fold(DMatrix::zeros(values, values), |sum, (zz, _, tested)| sum + zz * *tested)
    }
}
