//! A camera that looks at a board: a radial lens, and the homography of what it would show without it.

use super::homography::Homography;

/// p ↦ c + (p − c)(1 + k₁ρ² + k₂ρ⁴), ρ = |p − c| / size: from a pixel of the picture to its place without the lens.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Lens {
    centre: [f64; 2],
    size: f64,
    k: [f64; 2],
}

impl Lens {
    pub(super) fn straight(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let Lens { centre: [cx, cy], size, k } = self;
        let square = ((x - cx).powi(2) + (y - cy).powi(2)) / size.powi(2);
        let by = 1.0 + k[0] * square + k[1] * square.powi(2);
        [cx + (x - cx) * by, cy + (y - cy) * by]
    }

    /// Whether places farther from the centre are farther without the lens too.
    fn rises(&self, [x, y]: [f64; 2]) -> bool {
        let square = ((x - self.centre[0]).powi(2) + (y - self.centre[1]).powi(2)) / self.size.powi(2);
        1.0 + 3.0 * self.k[0] * square + 5.0 * self.k[1] * square.powi(2) > LEAST_SLOPE
    }
}

const FEWEST: usize = 12;
/// The lens is bent back where it stretches a picture by less than this.
const LEAST_SLOPE: f64 = 0.2;
/// Corners are not read more finely \[px\].
const FINEST_PX: f64 = 0.02;
/// Numbers of a lens: k₁, k₂ and its centre.
const N: usize = 4;
const STEPS: usize = 40;

/// A camera as a board shows it.
#[derive(Debug, Clone)]
pub(super) struct CameraView {
    lens: Option<Lens>,
    plane: Homography,
    /// Distance of the corners from their places: root mean square \[px\], the same on the board and the largest \[m\].
    pub rms_px: f64,
    pub off_m: [f64; 2],
    /// Smallest and largest x and y of the corners \[px\].
    frame: [[f64; 2]; 2],
}

impl CameraView {
    /// Least squares over corners (column, row, x, y) of a board with squares of this side. A lens is taken where it leaves less than
    /// Schwarz's criterion asks for its four numbers.
    ///
    /// # Errors
    /// Corners that make no plane.
    pub(super) fn of_board(corners: &[[f64; 4]], square_m: f64) -> Result<CameraView, String> {
        let plain = CameraView::with(None, corners, square_m)?;
        let values = 2.0 * corners.len() as f64;
        let gains = |bent: &CameraView| 2.0 * values * (plain.rms_px / bent.rms_px).ln() > 2.0 * N as f64 * values.ln();
        let bent = (corners.len() >= FEWEST && plain.rms_px > FINEST_PX).then(|| plain.bent(corners, square_m));
        Ok(bent.flatten().filter(gains).unwrap_or(plain))
    }

    fn with(lens: Option<Lens>, corners: &[[f64; 4]], square_m: f64) -> Result<CameraView, String> {
        let mut straight = corners.to_vec();
        for corner in straight.iter_mut().filter(|_| lens.is_some()) {
            let [x, y] = lens.map_or([corner[2], corner[3]], |lens| lens.straight([corner[2], corner[3]]));
            (corner[2], corner[3]) = (x, y);
        }
        let (plane, rms_px) = Homography::of_board(&straight, square_m)?;
        let frame = [2, 3].map(|k| {
            let values = || corners.iter().map(|corner| corner[k]);
            [values().fold(f64::INFINITY, f64::min), values().fold(f64::NEG_INFINITY, f64::max)]
        });
        let mut view = CameraView { lens, plane, rms_px, off_m: [0.0; 2], frame };
        let off = |corner: &[f64; 4]| {
            let [x, y] = view.at([corner[2], corner[3]]);
            (x - corner[0] * square_m).hypot(y - corner[1] * square_m)
        };
        let squares = corners.iter().map(|corner| off(corner).powi(2)).sum::<f64>();
        view.off_m = [(squares / corners.len() as f64).sqrt(), corners.iter().map(off).fold(0.0, f64::max)];
        Ok(view)
    }

    /// The lens that leaves least, by Levenberg's and Marquardt's steps with slopes from differences; the centre stays on the board.
    fn bent(&self, corners: &[[f64; 4]], square_m: f64) -> Option<CameraView> {
        let [[left, right], [top, bottom]] = self.frame;
        let size = 0.5 * (right - left).hypot(bottom - top);
        let view = |q: &[f64; N]| {
            let centre = [
                0.5 * (left + right) + q[2].clamp(-1.0, 1.0) * size,
                0.5 * (top + bottom) + q[3].clamp(-1.0, 1.0) * size,
            ];
            let lens = Lens { centre, size, k: [q[0], q[1]] };
            let rises = corners.iter().all(|corner| lens.rises([corner[2], corner[3]]));
            CameraView::with(Some(lens).filter(|_| rises), corners, square_m).ok().filter(|_| rises)
        };
        // Pixels without the lens are as large as the pixels of the picture near the centre, so that misses are comparable.
        let misses = |view: &CameraView| -> Vec<f64> {
            let miss = |corner: &[f64; 4]| {
                let [x, y] = view.at([corner[2], corner[3]]);
                [x - corner[0] * square_m, y - corner[1] * square_m]
            };
            corners.iter().flat_map(miss).collect()
        };
        let sum = |values: &[f64]| values.iter().map(|v| v * v).sum::<f64>();
        let mut q = [0.0; N];
        let (mut best, mut damping) = (view(&q)?, 1e-3);
        for _ in 0..STEPS {
            let now = misses(&best);
            let slopes: Vec<Vec<f64>> = (0..N)
                .map(|k| {
                    let mut moved = q;
                    moved[k] += 1e-4;
                    let moved = misses(&view(&moved)?);
                    Some(moved.iter().zip(&now).map(|(a, b)| (a - b) / 1e-4).collect())
                })
                .collect::<Option<_>>()?;
            let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
            let mut rows = [[0.0; N + 1]; N];
            for i in 0..N {
                (0..N).for_each(|j| rows[i][j] = dot(&slopes[i], &slopes[j]));
                rows[i][N] = -dot(&slopes[i], &now);
            }
            // Without a lens its centre moves nothing.
            let least = 1e-9 * (0..N).map(|i| rows[i][i]).fold(0.0, f64::max);
            (0..N).for_each(|i| rows[i][i] = rows[i][i] * (1.0 + damping) + least);
            let Some(step) = super::homography::solve(rows) else { break };
            let mut next = q;
            (0..N).for_each(|k| next[k] += step[k]);
            match view(&next).filter(|view| sum(&misses(view)) < sum(&now)) {
                Some(better) => {
                    let gain = 1.0 - sum(&misses(&better)) / sum(&now);
                    (q, best, damping) = (next, better, 0.3 * damping);
                    if gain < 1e-9 {
                        break;
                    }
                }
                None if damping > 1e6 => break,
                None => damping *= 10.0,
            }
        }
        Some(best)
    }

    pub(super) fn at(&self, pixel: [f64; 2]) -> [f64; 2] {
        self.plane.at(self.lens.map_or(pixel, |lens| lens.straight(pixel)))
    }

    /// Whether the lens is known at a pixel.
    pub(super) fn knows(&self, pixel: [f64; 2]) -> bool {
        self.lens.is_none_or(|lens| lens.rises(pixel))
    }

    /// Whether a pixel is beyond the corners by more than a tenth of their extent.
    pub(super) fn is_outside(&self, pixel: [f64; 2]) -> bool {
        let beyond =
            |([low, high], at): (&[f64; 2], f64)| at < low - 0.1 * (high - low) || at > high + 0.1 * (high - low);
        self.frame.iter().zip(pixel).any(beyond)
    }

    /// `a homography of 84 corners, and a lens (k₁ -0.12, k₂ 0.01 at 300 px from 640, 360); 0.05 px off (rms), on the board 0.02 mm, …`.
    pub(super) fn words(&self, corners: usize) -> String {
        let lens = self.lens.map_or(String::new(), |Lens { centre: [x, y], size, k: [k1, k2] }| {
            format!(" and a lens (k1 {k1:.4}, k2 {k2:.4} at {size:.0} px from {x:.0}, {y:.0})")
        });
        let [rms_mm, most_mm] = self.off_m.map(crate::units::mm);
        format!(
            "a homography of {corners} corners{lens}; what remains is {:.2} px (rms), on the board {rms_mm:.3} mm and {most_mm:.3} mm at most",
            self.rms_px
        )
    }
}
