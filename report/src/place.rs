//! Where to put labels so that they cover neither data nor each other.

use crate::scene::ScenePoint;

/// A rectangle: left, top, right, bottom [design px].
pub(crate) type Rect = [f64; 4];

/// Vertical positions as near as possible to the targets, at least `gap` apart and inside `[top, bottom]` if they fit.
pub(crate) fn stack(targets: &[f64], gap: f64, [top, bottom]: [f64; 2]) -> Vec<f64> {
    let mut order: Vec<usize> = (0..targets.len()).collect();
    order.sort_by(|a, b| targets[*a].total_cmp(&targets[*b]));
    let mut placed = targets.to_vec();
    let mut floor = top;
    for i in &order {
        placed[*i] = placed[*i].max(floor);
        floor = placed[*i] + gap;
    }
    let mut ceiling = bottom;
    for i in order.iter().rev() {
        placed[*i] = placed[*i].min(ceiling);
        ceiling = placed[*i] - gap;
    }
    placed
}

/// For each point, the centre of a label of the given size near it, clear of `obstacles` and earlier labels.
pub(crate) fn around(points: &[ScenePoint], sizes: &[[f64; 2]], bounds: Rect, obstacles: &[Rect]) -> Vec<ScenePoint> {
    let mut taken = obstacles.to_vec();
    let mut out = Vec::with_capacity(points.len());
    for (point, size) in points.iter().zip(sizes) {
        let best = candidates(*point, *size)
            .into_iter()
            .map(|(centre, far)| {
                let rect = rect_of(centre, *size);
                let overlap: f64 = taken.iter().map(|other| shared(rect, *other)).sum();
                let outside = size[0] * size[1] - shared(rect, bounds);
                (overlap + 10.0 * outside + 4.0 * far, centre)
            })
            .min_by(|a, b| a.0.total_cmp(&b.0))
            .map_or(*point, |best| best.1);
        taken.push(rect_of(best, *size));
        out.push(best);
    }
    out
}

/// Centres around a point with a penalty that grows with distance; right and left come first.
fn candidates([x, y]: ScenePoint, [width, height]: [f64; 2]) -> Vec<(ScenePoint, f64)> {
    let mut out = Vec::new();
    for ring in 0..5 {
        let reach = 10.0 + 14.0 * f64::from(ring);
        for step in 0..16 {
            let angle = f64::from(step) * std::f64::consts::PI / 8.0;
            let (sin, cos) = angle.sin_cos();
            let centre = [x + cos * (reach + 0.5 * width), y + sin * (reach + 0.5 * height)];
            out.push((centre, f64::from(ring) * 3.0 + sin.abs() + 0.4 * (1.0 - cos)));
        }
    }
    out
}

fn rect_of([x, y]: ScenePoint, [width, height]: [f64; 2]) -> Rect {
    [x - 0.5 * width, y - 0.5 * height, x + 0.5 * width, y + 0.5 * height]
}

fn shared(a: Rect, b: Rect) -> f64 {
    let along = |i: usize| (a[i + 2].min(b[i + 2]) - a[i].max(b[i])).max(0.0);
    along(0) * along(1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stacked_labels_keep_their_distance_and_order() {
        let placed = stack(&[50.0, 51.0, 52.0, 10.0], 16.0, [0.0, 80.0]);
        let mut sorted = placed.clone();
        sorted.sort_by(f64::total_cmp);
        assert!(sorted.windows(2).all(|pair| pair[1] - pair[0] >= 16.0 - 1e-9), "{placed:?}");
        assert!(placed[0] < placed[1] && placed[1] < placed[2] && placed[3] == 10.0 && placed[2] <= 80.0);
    }

    #[test]
    fn labels_of_coincident_points_do_not_overlap() {
        let sizes = [[60.0, 14.0]; 6];
        let placed = around(&[[200.0, 100.0]; 6], &sizes, [0.0, 0.0, 400.0, 200.0], &[]);
        for (i, a) in placed.iter().enumerate() {
            for b in &placed[i + 1..] {
                assert_eq!(shared(rect_of(*a, sizes[0]), rect_of(*b, sizes[0])), 0.0, "{placed:?}");
            }
        }
    }
}
