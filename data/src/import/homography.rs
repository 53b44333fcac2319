//! The plane of a checkerboard: from pixels to metres on the board through the corners of its squares.

/// x' = (h₀x + h₁y + h₂)/(h₆x + h₇y + 1), y' = (h₃x + h₄y + h₅)/(h₆x + h₇y + 1).
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Homography([f64; 8]);

const N: usize = 8;

impl Homography {
    /// Least squares over corners (column, row, x, y), and how far off they are \[px, rms\].
    pub(super) fn of_board(corners: &[[f64; 4]], square_m: f64) -> Result<(Homography, f64), String> {
        if corners.len() < 4 {
            return Err(format!("{} corners do not make a plane", corners.len()));
        }
        // Pixels about their mean and of size one, so that the equations are well scaled.
        let count = corners.len() as f64;
        let mean = [2, 3].map(|k| corners.iter().map(|c| c[k]).sum::<f64>() / count);
        let size = corners.iter().map(|c| (c[2] - mean[0]).hypot(c[3] - mean[1])).sum::<f64>() / count;
        let mut normal = [[0.0; N + 1]; N];
        for [column, row, x, y] in corners {
            let (x, y) = ((x - mean[0]) / size, (y - mean[1]) / size);
            let (u, v) = (column * square_m, row * square_m);
            for equation in
                [[x, y, 1.0, 0.0, 0.0, 0.0, -u * x, -u * y, u], [0.0, 0.0, 0.0, x, y, 1.0, -v * x, -v * y, v]]
            {
                for i in 0..N {
                    (0..=N).for_each(|j| normal[i][j] += equation[i] * equation[j]);
                }
            }
        }
        let h = solve(normal)
            .filter(|h| h.iter().all(|part| part.is_finite()))
            .ok_or("the corners do not make a plane: too many are on one line")?;
        // Back to pixels, with the last number one again.
        let [a, b] = mean;
        let last = size - h[6] * a - h[7] * b;
        let part = |k: usize| [h[k] / last, h[k + 1] / last, (h[k + 2] * size - h[k] * a - h[k + 1] * b) / last];
        let ([x0, x1, x2], [y0, y1, y2]) = (part(0), part(3));
        let found = Homography([x0, x1, x2, y0, y1, y2, h[6] / last, h[7] / last]);
        let off = |c: &[f64; 4]| {
            let [x, y] = found.at([c[2], c[3]]);
            ((x - c[0] * square_m).powi(2) + (y - c[1] * square_m).powi(2))
                * (1.0 / found.metres_per_pixel([c[2], c[3]])).powi(2)
        };
        let rms = (corners.iter().map(off).sum::<f64>() / count).sqrt();
        if rms.is_finite() && rms < 0.1 * size {
            Ok((found, rms))
        } else {
            Err(format!("the corners are {rms:.1} px off a plane"))
        }
    }

    pub(super) fn at(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let h = &self.0;
        let depth = h[6] * x + h[7] * y + 1.0;
        [(h[0] * x + h[1] * y + h[2]) / depth, (h[3] * x + h[4] * y + h[5]) / depth]
    }

    fn metres_per_pixel(&self, [x, y]: [f64; 2]) -> f64 {
        let (a, b) = (self.at([x - 0.5, y - 0.5]), self.at([x + 0.5, y + 0.5]));
        (a[0] - b[0]).hypot(a[1] - b[1]) / 2.0_f64.sqrt()
    }
}

/// Gauss's elimination with pivots of N rows with their right sides, M = N + 1; `None` for a singular matrix.
pub(super) fn solve<const N: usize, const M: usize>(mut rows: [[f64; M]; N]) -> Option<[f64; N]> {
    let largest = rows.iter().flatten().fold(0.0_f64, |most, v| most.max(v.abs()));
    for k in 0..N {
        let pivot = (k..N).max_by(|a, b| rows[*a][k].abs().total_cmp(&rows[*b][k].abs()))?;
        rows.swap(k, pivot);
        if rows[k][k].abs() <= 1e-13 * largest {
            return None;
        }
        let head = rows[k];
        for row in rows.iter_mut().skip(k + 1) {
            let times = row[k] / head[k];
            (k..M).for_each(|j| row[j] -= times * head[j]);
        }
    }
    let mut found = [0.0; N];
    for k in (0..N).rev() {
        let rest: f64 = (k + 1..N).map(|j| rows[k][j] * found[j]).sum();
        found[k] = (rows[k][N] - rest) / rows[k][k];
    }
    Some(found)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A board seen askew by a known projection: the plane comes back to rounding, and pixels between the corners too.
    #[test]
    fn a_board_seen_askew_gives_its_plane_back() {
        let picture = |u: f64, v: f64| {
            let depth = 1.0 + 0.9 * u - 0.4 * v;
            [(300.0 + 2500.0 * u + 200.0 * v) / depth, (200.0 - 150.0 * u + 2300.0 * v) / depth]
        };
        let square = 0.025;
        let corner = |k: i32| {
            let (i, j) = (f64::from(k % 7), f64::from(k / 7));
            let [x, y] = picture(i * square, j * square);
            [i, j, x, y]
        };
        let corners: Vec<[f64; 4]> = (0..35).map(corner).collect();
        let (found, rms) = Homography::of_board(&corners, square).unwrap();
        assert!(rms < 1e-6, "{rms}");
        for (u, v) in [(0.013, 0.08), (0.1, 0.01), (-0.05, 0.2)] {
            let [x, y] = found.at(picture(u, v));
            assert!((x - u).abs() < 1e-9 && (y - v).abs() < 1e-9, "{x} {y}");
        }
        let line: Vec<[f64; 4]> = corners.iter().take(7).copied().collect();
        assert!(Homography::of_board(&line, square).is_err() && Homography::of_board(&corners[..3], square).is_err());
    }
}
