//! Rising curve through the origin, given by a table: stress over strain with its exact integral.
//!
//! ```text
//! y(x) = yᵢ + kᵢ (x − xᵢ)          ∫₀ˣ y dx = wᵢ + yᵢ (x − xᵢ) + ½ kᵢ (x − xᵢ)²
//! ```
//!
//! Straight between the rows: y is continuous, its slope jumps at rows, and value and integral belong together to the last
//! digit. Beyond the ends the outer segments go on.

/// A strictly rising, piecewise straight curve with y(0) = 0.
#[derive(Debug, Clone, PartialEq)]
pub struct Curve {
    /// Rows x, y; contains the origin.
    rows: Vec<[f64; 2]>,
    /// Slopes before the first and after the last row.
    outer: [f64; 2],
    /// Piece i is between row i − 1 and row i.
    pieces: Vec<Piece>,
}

/// One straight piece, held at its end nearer to the origin: no digits are lost at small x.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Piece {
    x: f64,
    y: f64,
    integral: f64,
    slope: f64,
}

impl Curve {
    /// y = slope·x; the slope must be positive.
    pub fn linear(slope: f64) -> Curve {
        Curve::build(vec![[0.0, 0.0]], [slope, slope])
    }

    /// From rows `[x, y]`. Below a table that starts at the origin the first slope goes on.
    ///
    /// # Errors
    /// Fewer than two rows, a number that is not finite, x or y not rising, no row `[0, 0]`: a message with the row and
    /// what to write.
    ///
    /// ```
    /// use models::fabrics::Curve;
    /// let curve = Curve::table(&[[0.0, 0.0], [0.01, 1e6], [0.02, 3e6]]).unwrap();
    /// assert_eq!((curve.value(0.015), curve.integral(0.01)), (2e6, 5e3));
    /// assert!(Curve::table(&[[0.0, 0.0], [0.01, 1e6], [0.02, 1e6]]).unwrap_err().contains("row 3"));
    /// ```
    pub fn table(rows: &[[f64; 2]]) -> Result<Curve, String> {
        check(rows)?;
        let n = rows.len();
        let first = if rows[0][0] < 0.0 { 0 } else { rows.partition_point(|r| r[0] <= 0.0) - 1 };
        Ok(Curve::build(rows.to_vec(), [between(rows[first], rows[first + 1]), between(rows[n - 2], rows[n - 1])]))
    }

    /// Interpolates y at x; beyond the rows the outer segments go on.
    pub fn value(&self, x: f64) -> f64 {
        let p = self.piece(x);
        p.y + p.slope * (x - p.x)
    }

    /// dy/dx; at a row the left piece's.
    pub fn slope(&self, x: f64) -> f64 {
        self.piece(x).slope
    }

    /// Largest slope of the pieces between two places, the ends' own pieces included.
    pub fn steepest(&self, from: f64, to: f64) -> f64 {
        let [first, last] = [from, to].map(|x| self.rows.partition_point(|r| r[0] < x));
        self.pieces[first..=last].iter().fold(0.0, |most, p| f64::max(most, p.slope))
    }

    /// ∫₀ˣ y dx, the energy per volume at a strain of x; never negative.
    pub fn integral(&self, x: f64) -> f64 {
        let p = self.piece(x);
        let dx = x - p.x;
        p.integral + (p.y + 0.5 * p.slope * dx) * dx
    }

    /// Slope just above x = 0, the stiffness of the unloaded fabric.
    pub fn initial_slope(&self) -> f64 {
        self.slope(f64::MIN_POSITIVE)
    }

    /// Slope with which the curve goes on beyond its last row.
    pub fn last_slope(&self) -> f64 {
        self.outer[1]
    }

    /// Smallest and largest slope of all pieces, the outer ones included.
    pub fn slope_range(&self) -> [f64; 2] {
        let widen = |r: [f64; 2], p: &Piece| [r[0].min(p.slope), r[1].max(p.slope)];
        self.pieces.iter().fold([f64::INFINITY, 0.0], widen)
    }

    /// Rows (x, y) of the table in rising order of x.
    pub fn rows(&self) -> &[[f64; 2]] {
        &self.rows
    }

    /// Whether the table has rows below zero.
    pub fn has_negative_rows(&self) -> bool {
        self.rows[0][0] < 0.0
    }

    /// Units changed: x and y times a positive factor.
    pub fn scaled(&self, x: f64, y: f64) -> Curve {
        let rows = self.rows.iter().map(|r| [r[0] * x, r[1] * y]).collect();
        Curve::build(rows, self.outer.map(|k| k * y / x))
    }

    /// Below the origin straight, with `share` of the initial slope. Rows below the origin are replaced.
    pub fn with_compression(&self, share: f64) -> Curve {
        let rows = self.rows.iter().filter(|r| r[0] >= 0.0).copied().collect();
        Curve::build(rows, [share * self.initial_slope(), self.outer[1]])
    }

    /// The odd curve y(−x) = −y(x). Rows below the origin are replaced.
    pub fn mirrored(&self) -> Curve {
        let above = self.rows.iter().filter(|r| r[0] > 0.0);
        let mut rows: Vec<[f64; 2]> = above.clone().rev().map(|r| [-r[0], -r[1]]).collect();
        rows.push([0.0, 0.0]);
        rows.extend(above);
        Curve::build(rows, [self.outer[1]; 2])
    }

    /// Adds ±`extra`·(|x| − `at`) beyond ±`at`: a stop.
    pub fn stiffened(&self, at: f64, extra: f64) -> Curve {
        let mut rows = self.rows.clone();
        for x in [-at, at] {
            if !rows.iter().any(|r| r[0] == x) {
                rows.push([x, self.value(x)]);
            }
        }
        rows.sort_by(|a, b| a[0].total_cmp(&b[0]));
        for row in &mut rows {
            row[1] += extra * (row[0].abs() - at).max(0.0) * row[0].signum();
        }
        Curve::build(rows, self.outer.map(|k| k + extra))
    }

    fn piece(&self, x: f64) -> &Piece {
        &self.pieces[self.rows.partition_point(|r| r[0] < x)]
    }

    /// `rows` are in order and contain the origin.
    fn build(rows: Vec<[f64; 2]>, outer: [f64; 2]) -> Curve {
        let origin = rows.iter().position(|r| r[0] == 0.0).unwrap_or(0);
        let mut areas = vec![0.0; rows.len()];
        for i in origin + 1..rows.len() {
            areas[i] = areas[i - 1] + trapezium(rows[i - 1], rows[i]);
        }
        for i in (0..origin).rev() {
            areas[i] = areas[i + 1] - trapezium(rows[i], rows[i + 1]);
        }
        let held = |i: usize, slope| Piece { x: rows[i][0], y: rows[i][1], integral: areas[i], slope };
        let mut pieces = vec![held(0, outer[0])];
        for i in 1..rows.len() {
            pieces.push(held(if i <= origin { i } else { i - 1 }, between(rows[i - 1], rows[i])));
        }
        pieces.push(held(rows.len() - 1, outer[1]));
        Curve { rows, outer, pieces }
    }
}

fn check(rows: &[[f64; 2]]) -> Result<(), String> {
    if rows.len() < 2 {
        return Err(format!("the table has {} rows; write at least two, the first usually [0, 0]", rows.len()));
    }
    for (i, [x, y]) in rows.iter().enumerate() {
        if !(x.is_finite() && y.is_finite()) {
            return Err(format!("row {} is [{x}, {y}]; write two finite numbers", i + 1));
        }
    }
    for (i, pair) in rows.windows(2).enumerate() {
        let ([x0, y0], [x1, y1]) = (pair[0], pair[1]);
        if x1 <= x0 {
            return Err(format!("row {} is [{x1}, {y1}]: the first number must rise; write more than {x0}", i + 2));
        }
        if y1 <= y0 {
            return Err(format!(
                "row {} is [{x1}, {y1}]: the curve must rise; write a second number above {y0}, or leave the row out",
                i + 2
            ));
        }
    }
    origin(rows)
}

/// The row that should be the origin, but is not.
fn origin(rows: &[[f64; 2]]) -> Result<(), String> {
    let i = rows.partition_point(|r| r[0] < 0.0);
    match rows.get(i) {
        Some([0.0, 0.0]) => Ok(()),
        Some([0.0, y]) => {
            Err(format!("row {} is [0, {y}]: the curve must pass through the origin; write [0, 0]", i + 1))
        }
        _ => Err(format!("the curve must pass through the origin; write [0, 0] as row {}", i + 1)),
    }
}

fn between(a: [f64; 2], b: [f64; 2]) -> f64 {
    (b[1] - a[1]) / (b[0] - a[0])
}

fn trapezium(a: [f64; 2], b: [f64; 2]) -> f64 {
    0.5 * (a[1] + b[1]) * (b[0] - a[0])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn bent() -> Curve {
        Curve::table(&[[-0.1, -3.0], [0.0, 0.0], [0.2, 2.0], [0.3, 6.0]]).unwrap()
    }

    #[test]
    fn value_and_integral_are_those_drawn_by_hand() {
        let c = bent();
        for (x, y, area) in [
            (0.0, 0.0, 0.0),
            (0.1, 1.0, 0.05),
            (0.25, 4.0, 0.35),
            (0.4, 10.0, 1.4),
            (-0.1, -3.0, 0.15),
            (-0.2, -6.0, 0.6),
        ] {
            assert!((c.value(x) - y).abs() < 1e-12, "{x}");
            assert!((c.integral(x) - area).abs() < 1e-12, "{x}: {}", c.integral(x));
        }
        assert!((c.initial_slope() - 10.0).abs() < 1e-12 && (c.last_slope() - 40.0).abs() < 1e-12);
        assert!((c.slope_range()[0] - 10.0).abs() < 1e-12 && (c.slope_range()[1] - 40.0).abs() < 1e-12);
        for (from, to, steepest) in [(0.01, 0.1, 10.0), (-0.05, 0.1, 30.0), (0.19, 0.21, 40.0), (0.4, 0.5, 40.0)] {
            assert!((c.steepest(from, to) - steepest).abs() < 1e-12, "{from} to {to}");
        }
    }

    #[test]
    fn the_integral_keeps_its_digits_at_tiny_arguments() {
        let c = bent();
        for (x, slope) in [(1e-12, 10.0), (-1e-12, 30.0)] {
            assert!((c.integral(x) / (0.5 * slope * x * x) - 1.0).abs() < 1e-12);
        }
    }

    #[test]
    fn a_table_from_the_origin_goes_on_below_with_its_first_slope_or_a_share() {
        let c = Curve::table(&[[0.0, 0.0], [1.0, 2.0], [2.0, 8.0]]).unwrap();
        assert_eq!(c.value(-3.0), -6.0);
        assert_eq!(c.with_compression(0.25).value(-3.0), -1.5);
        assert_eq!(c.with_compression(0.25).integral(-2.0), 1.0);
        assert_eq!(c.mirrored().value(-2.0), -8.0);
        assert_eq!(c.mirrored().integral(-2.0), c.integral(2.0));
    }

    #[test]
    fn a_stop_adds_stiffness_beyond_it_and_nothing_before() {
        let c = Curve::linear(2.0).stiffened(0.5, 100.0);
        assert_eq!([c.value(0.4), c.value(0.6), c.value(-0.6)].map(|y| (y * 1e9).round() / 1e9), [0.8, 11.2, -11.2]);
        assert!((c.integral(0.6) - (0.36 + 0.5)).abs() < 1e-12);
    }

    #[test]
    fn units_change_value_and_integral_alike() {
        let c = bent().scaled(1e-2, 1e6);
        assert!((c.value(0.0025) - 4e6).abs() < 1e-3 && (c.integral(0.0025) - 0.35e4).abs() < 1e-6);
    }

    #[test]
    fn every_bad_table_is_refused_with_row_and_remedy() {
        let cases: [(&[[f64; 2]], &[&str]); 7] = [
            (&[[0.0, 0.0]], &["1 rows", "at least two"]),
            (&[[0.0, 0.0], [0.1, f64::NAN]], &["row 2", "finite"]),
            (&[[0.0, 0.0], [0.1, 1.0], [0.1, 2.0]], &["row 3", "more than 0.1"]),
            (&[[0.0, 0.0], [0.1, 1.0], [0.2, 0.5]], &["row 3", "above 1"]),
            (&[[0.0, 0.3], [0.1, 1.0]], &["row 1", "origin", "[0, 0]"]),
            (&[[0.1, 0.3], [0.2, 1.0]], &["origin", "row 1"]),
            (&[[-0.1, -0.3], [0.2, 1.0]], &["origin", "row 2"]),
        ];
        for (rows, words) in cases {
            let message = Curve::table(rows).unwrap_err();
            assert!(words.iter().all(|w| message.contains(w)), "{message}");
        }
    }
}
