//! Orthonormal bases of a few long columns: the rest of a trace when others are fitted out.

use super::least_squares::{dot, square};

/// Part of a column that must be new for it to count.
const NEW_PART: f64 = 1e-6;

#[derive(Debug, Clone, Default)]
pub(crate) struct Basis {
    columns: Vec<Vec<f64>>,
}

impl Basis {
    /// Basis of the span of some columns; columns without a new part are passed over.
    pub(crate) fn of(columns: &[Vec<f64>]) -> Basis {
        let mut basis = Basis::default();
        for column in columns {
            basis.add(column);
        }
        basis
    }

    /// The rest of a vector when the span is fitted to it. Twice, because once leaves rounding.
    pub(crate) fn rest(&self, vector: &[f64]) -> Vec<f64> {
        let mut rest = vector.to_vec();
        for _ in 0..2 {
            for q in &self.columns {
                let along = dot(q, &rest);
                rest.iter_mut().zip(q).for_each(|(r, q)| *r -= along * q);
            }
        }
        rest
    }

    /// Adds a column; false if it brings nothing new.
    pub(crate) fn add(&mut self, column: &[f64]) -> bool {
        let (rest, length) = (self.rest(column), square(column).sqrt());
        let new = square(&rest).sqrt();
        if new.is_nan() || new <= NEW_PART * length || new == 0.0 {
            return false;
        }
        self.columns.push(rest.iter().map(|r| r / new).collect());
        true
    }
}

/// The rest of a column when all others are fitted to it.
pub(crate) fn own_part(columns: &[Vec<f64>], k: usize) -> Vec<f64> {
    let others: Vec<Vec<f64>> = (0..columns.len()).filter(|j| *j != k).map(|j| columns[j].clone()).collect();
    Basis::of(&others).rest(&columns[k])
}

pub(crate) fn cosine(a: &[f64], b: &[f64]) -> f64 {
    let lengths = (square(a) * square(b)).sqrt();
    if lengths > 0.0 { dot(a, b) / lengths } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_rest_is_perpendicular_and_repeated_columns_count_once() {
        let columns = vec![vec![1.0, 2.0, 3.0, 4.0], vec![2.0, 4.0, 6.0, 8.0], vec![0.0; 4], vec![1.0, 0.0, -1.0, 0.5]];
        let basis = Basis::of(&columns);
        assert_eq!(basis.columns.len(), 2);
        let rest = basis.rest(&[0.3, -2.0, 1.0, 0.7]);
        assert!(columns.iter().all(|c| dot(c, &rest).abs() < 1e-12));
    }
}
