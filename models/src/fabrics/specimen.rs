//! From the curve of a pulled specimen to the numbers of a fabric law.
//!
//! ```text
//! P(ε) = 2 C₁₀ (λ − λ⁻²)     λ = 1 + ε          C₁₀ = Σ P g / Σ g²     g = 2 (λ − λ⁻²)
//! E = slope of the least-squares line through the rows of small strain
//! y = a + b x + c (x − x_L)₊                    x_L: locking, where the slope rises from b to b + c
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | P, ε | nominal stress (force over first cross-section), nominal strain | Pa, – |
//! | C₁₀ | constant of the reduced polynomial of order one (neo-Hookean), U = C₁₀ (Ī₁ − 3), incompressible (D₁₀ = 0) | Pa |
//! | E | modulus of the pulled direction | Pa |
//! | x_S | slack: where the line through the straight rows behind a soft toe meets zero force | – |
//! | x, y | shear angle and shear force per length of a bias extension test | rad, N/m |
//!
//! C₁₀ is fitted over the *whole* curve, so 6 C₁₀ is not the modulus unless the curve has the law's shape. Two weights: the
//! stress itself, and its share, Σ (1 − P_law/P)², which counts small strains as much as large ones.
//! Reference: Treloar, The Physics of Rubber Elasticity (law); the fits are linear least squares, derived here.

use super::bias_extension::BiasExtension;

/// Nominal stress of the law at a nominal strain \[Pa\].
pub fn neo_hookean_pa(c10_pa: f64, strain: f64) -> f64 {
    c10_pa * shape(strain)
}

/// C₁₀ that misses the stresses least, Σ (P − P_law)² \[Pa\]; none without a strain.
///
/// ```
/// use models::fabrics::specimen::{c10_pa, neo_hookean_pa};
/// let rows: Vec<[f64; 2]> = [0.05, 0.1, 0.2].map(|e| [e, neo_hookean_pa(50.3e6, e)]).to_vec();
/// assert!((c10_pa(&rows).unwrap() / 50.3e6 - 1.0).abs() < 1e-14);
/// ```
pub fn c10_pa(rows: &[[f64; 2]]) -> Option<f64> {
    ratio(rows.iter().map(|[strain, stress]| (shape(*strain), *stress)))
}

/// C₁₀ that misses the stresses by the smallest shares, Σ (1 − P_law/P)² \[Pa\]; rows without stress are left out.
pub fn c10_by_share_pa(rows: &[[f64; 2]]) -> Option<f64> {
    ratio(rows.iter().filter(|row| row[1] > 0.0).map(|[strain, stress]| (shape(*strain) / stress, 1.0)))
}

/// Root mean square of what a law misses, over the largest stress.
pub fn misfit(rows: &[[f64; 2]], law: impl Fn(f64) -> f64) -> f64 {
    let squares: f64 = rows.iter().map(|[x, y]| (y - law(*x)).powi(2)).sum();
    let largest = rows.iter().map(|row| row[1].abs()).fold(f64::MIN_POSITIVE, f64::max);
    (squares / rows.len().max(1) as f64).sqrt() / largest
}

/// Slope of the least-squares line, with its own intercept; none with fewer than two different x.
pub fn slope(rows: &[[f64; 2]]) -> Option<f64> {
    let n = rows.len() as f64;
    let [x, y] = [0, 1].map(|k| rows.iter().map(|row| row[k]).sum::<f64>() / n);
    let along: f64 = rows.iter().map(|row| (row[0] - x).powi(2)).sum();
    let across: f64 = rows.iter().map(|row| (row[0] - x) * (row[1] - y)).sum();
    (along > 0.0).then(|| across / along)
}

/// The slack that a specimen starts with.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Slack {
    /// x at which the straight line behind the toe meets zero force.
    pub at: f64,
    /// Index of the first row on the straight line behind the toe.
    pub from: usize,
}

/// Toe of a curve: a soft start after which the curve is straight over `up_to` (toe compensation of ASTM D882, annex A1).
///
/// None unless the first slope is below three quarters of the steepest by more than the rows' noise, and the steep part takes a
/// third of `up_to` at least: a curve that goes on to stiffen is a fabric's crimp and stays. A toe longer than that has to be free of
/// force but for a twentieth of what the straight part gains over `up_to`, and for noise. Slopes are taken over more rows where there is noise.
///
/// ```
/// use models::fabrics::specimen::slack;
/// let rows: Vec<[f64; 2]> = (0..80).map(|k| 1e-3 * f64::from(k)).map(|x| [x, 300e6 * (x - 0.02).max(0.0)]).collect();
/// assert!((slack(&rows, 0.01).unwrap().at - 0.02).abs() < 1e-9);
/// ```
pub fn slack(rows: &[[f64; 2]], up_to: f64) -> Option<Slack> {
    const FREE: f64 = 0.05;
    let count = |end: f64| rows.partition_point(|row| row[0] <= end);
    let within = count(up_to);
    let short = toe(&rows[..within], (within / 6).max(3), within.div_ceil(3));
    let begins = onset(rows)?;
    let taut = count(begins + up_to).saturating_sub(count(begins));
    let long = || {
        let found = toe(&rows[..count(begins + up_to)], (taut / 6).max(3), taut.div_ceil(3))?;
        let gained = rows[found.from][1] * up_to / (rows[found.from][0] - found.at);
        (at(rows, found.at) <= FREE * gained + 3.0 * noise(rows)).then_some(found)
    };
    short.or_else(long)
}

/// Toe of all these rows, by slopes over `width` rows; the steep part has at least so many rows.
fn toe(rows: &[[f64; 2]], width: usize, least: usize) -> Option<Slack> {
    const SOFT: f64 = 0.75;
    const STEEP: f64 = 0.9;
    let within = rows.len();
    let width = steady(rows, width, least)?;
    let slopes: Vec<f64> = rows.windows(width).filter_map(slope).collect();
    let steepest = slopes.iter().copied().fold(0.0, f64::max);
    let error = slope_error(rows, width);
    let from = slopes.iter().position(|s| *s >= STEEP * steepest - 2.0 * error)?;
    let soft = slopes[0] < SOFT * steepest && steepest - slopes[0] > 5.7 * error;
    if !(soft && within - from >= least && slopes[from..].iter().all(|s| *s >= SOFT * steepest - 3.0 * error)) {
        return None;
    }
    // The first steep window still has the end of the toe in it: the line is taken behind it.
    let from = (from + width).min(within - width);
    let line = &rows[from..from + width];
    let [x, y] = [0, 1].map(|k| line.iter().map(|row| row[k]).sum::<f64>() / width as f64);
    let at = x - y / slope(line)?;
    (at > 0.0 && at < rows[from][0]).then_some(Slack { at, from })
}

/// Where a curve is steeper than its start: strain at which the steepest stretch of length `up_to` begins, and its slope.
///
/// None unless that slope exceeds 4/3 of the first stretch's by more than the rows' noise. Crimp of the yarns and a toe too wide
/// for [`slack`] give the same curve: only the user knows which it is.
pub fn stiffening(rows: &[[f64; 2]], up_to: f64) -> Option<[f64; 2]> {
    const MORE: f64 = 4.0 / 3.0;
    let stretches = (0..rows.len()).filter_map(|i| {
        let within = rows[i..].partition_point(|row| row[0] <= rows[i][0] + up_to);
        let stretch = &rows[i..i + within];
        (within > 2 && i + within < rows.len())
            .then(|| Some((rows[i][0], slope(stretch)?, slope_error(stretch, within))))?
    });
    let stretches: Vec<_> = stretches.collect();
    let (_, first, error) = *stretches.first()?;
    let (at, most, other) = *stretches.iter().max_by(|a, b| a.1.total_cmp(&b.1))?;
    (most > MORE * first + 3.0 * error.hypot(other)).then_some([at, most])
}

/// Fewest rows, from `width` to `most`, over which the noise leaves a slope to a twenty-fifth of the steepest one, or `most`.
fn steady(rows: &[[f64; 2]], width: usize, most: usize) -> Option<usize> {
    const SHARE: f64 = 0.04;
    let steepest = |width: usize| rows.windows(width).filter_map(slope).fold(0.0, f64::max);
    let is_steady = |width: &usize| slope_error(rows, *width) <= SHARE * steepest(*width);
    (2 * width <= rows.len()).then(|| (width..most).find(is_steady).unwrap_or(most.max(width)))
}

/// Where the force rises above its noise, and above a two-hundredth of the largest force, for good.
fn onset(rows: &[[f64; 2]]) -> Option<f64> {
    let largest = rows.iter().map(|row| row[1]).fold(0.0, f64::max);
    let least = (6.0 * noise(rows)).max(0.005 * largest);
    let first = rows.iter().rposition(|row| row[1] <= least)?;
    let peak = rows.iter().position(|row| row[1] >= largest)?;
    let first = if first > peak { rows[..peak].iter().rposition(|row| row[1] <= least)? } else { first };
    Some(rows[first][0])
}

/// Standard deviation of the force, by the second differences of rows that are evenly spaced.
fn noise(rows: &[[f64; 2]]) -> f64 {
    let mut bends: Vec<f64> = rows.windows(3).map(|r| (r[2][1] - 2.0 * r[1][1] + r[0][1]).abs()).collect();
    bends.sort_by(f64::total_cmp);
    // Median of |N(0, 6σ²)|.
    bends.get(bends.len() / 2).map_or(0.0, |bend| bend / (0.6745 * 6.0_f64.sqrt()))
}

fn slope_error(rows: &[[f64; 2]], width: usize) -> f64 {
    let [Some(first), Some(last)] = [rows.first(), rows.last()].map(|row| row.map(|r| r[0])) else { return 0.0 };
    let (n, step) = (width as f64, (last - first) / (rows.len() - 1) as f64);
    noise(rows) * (12.0 / (n * (n * n - 1.0))).sqrt() / step
}

/// What grips add to the modulus at 45°: clamped over free specimen, for yarns much stiffer than shear.
///
/// `H (H − 5W/4) / (H − W)²`: F d = G t γ² (A_C + A_B/4) with γ = 2d/(H − W), against F/(W t) = 4 G d/H. Derived here.
/// 1.5 for H = 2W, 1.06 for the paper's 250 mm by 20 mm.
pub fn bias_grip_factor(strip: &BiasExtension) -> f64 {
    let (h, w) = (strip.length_m, strip.width_m);
    h * (h - 1.25 * w) / (h - w).powi(2)
}

/// A place where a curve loses force and then goes on to more: a specimen that slipped in its grips.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Slip {
    /// Strain at which the specimen begins to lose force.
    pub at: f64,
    /// Strain at which the force is back.
    pub until: f64,
    /// Share of the force lost; 0 for a plateau.
    pub lost: f64,
}

/// First drop of at least 5 % after which the force rises beyond where it was. Rows up to the peak, rising in x.
pub fn drop(rows: &[[f64; 2]]) -> Option<Slip> {
    /// Above the noise of a load cell, below what a slipping grip loses.
    const LEAST: f64 = 0.05;
    /// Share of the largest force below which jumps are noise.
    const QUIET: f64 = 0.1;
    let largest = rows.iter().map(|row| row[1]).fold(0.0, f64::max);
    let mut top = [0.0, 0.0];
    let mut least = f64::INFINITY;
    for &[x, y] in rows {
        if y >= top[1] {
            let lost = 1.0 - least / top[1];
            if top[1] > QUIET * largest && least.is_finite() && lost >= LEAST {
                return Some(Slip { at: top[0], until: x, lost });
            }
            (top, least) = ([x, y], f64::INFINITY);
        } else {
            least = least.min(y);
        }
    }
    None
}

/// First stretch over which the force hardly rises between two stretches where it does. Along yarns only: at 45° a plateau
/// is how fabric shears.
pub fn plateau(rows: &[[f64; 2]]) -> Option<Slip> {
    const PIECES: usize = 40;
    let end = rows.last()?[0];
    let edges: Vec<f64> = (0..=PIECES).map(|i| end * i as f64 / PIECES as f64).collect();
    let rises: Vec<f64> = edges.windows(2).map(|e| at(rows, e[1]) - at(rows, e[0])).collect();
    let mut sorted = rises.clone();
    sorted.sort_by(f64::total_cmp);
    let usual = sorted[PIECES / 2];
    let (flat, steep) = (|i: usize| rises[i] < 0.1 * usual, |i: usize| rises[i] > 0.5 * usual);
    let first = (1..PIECES - 2).find(|&i| flat(i) && flat(i + 1) && (0..i).any(steep))?;
    let last = (first..PIECES).find(|&i| !flat(i))?;
    let again = (last..PIECES.min(last + 3)).any(steep);
    again.then(|| Slip { at: edges[first], until: edges[last], lost: 0.0 })
}

/// Shear angle at which a fabric stiffens for good: its yarns touch.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Locking {
    /// x_L: shear angle at which the two lines meet \[rad\].
    pub angle: f64,
    /// Slopes of the two lines, before and after the locking angle \[N/m\].
    pub slopes: [f64; 2],
}

/// The two lines that miss the curve least; none if the second is not at least three times as steep as the first.
///
/// Three is a convention: it separates the rise of jammed yarns from an even stiffening.
pub fn locking(rows: &[[f64; 2]]) -> Option<Locking> {
    const STEEPER: f64 = 3.0;
    const PIECES: usize = 120;
    let end = rows.last()?[0];
    let even: Vec<[f64; 2]> = (1..=PIECES).map(|i| end * i as f64 / PIECES as f64).map(|x| [x, at(rows, x)]).collect();
    let tried =
        (PIECES / 5..PIECES * 19 / 20).filter_map(|i| two_lines(&even, even[i][0]).map(|fit| (even[i][0], fit)));
    let (angle, (_, [before, more])) = tried.min_by(|a, b| a.1.0.total_cmp(&b.1.0))?;
    let after = before + more;
    (after > 0.0 && after > STEEPER * before).then_some(Locking { angle, slopes: [before, after] })
}

/// Sum of squares left and `[b, c]` of `y = a + b x + c (x − x_L)₊`.
fn two_lines(rows: &[[f64; 2]], knee: f64) -> Option<(f64, [f64; 2])> {
    let n = rows.len() as f64;
    let features = |x: f64| [x, (x - knee).max(0.0)];
    let mean = |f: &dyn Fn(&[f64; 2]) -> f64| rows.iter().map(f).sum::<f64>() / n;
    let [u, v] = [0, 1].map(|k| mean(&|row| features(row[0])[k]));
    let y = mean(&|row| row[1]);
    let product =
        |a: &dyn Fn(&[f64; 2]) -> f64, b: &dyn Fn(&[f64; 2]) -> f64| rows.iter().map(|r| a(r) * b(r)).sum::<f64>();
    let (du, dv) = (|r: &[f64; 2]| features(r[0])[0] - u, |r: &[f64; 2]| features(r[0])[1] - v);
    let dy = |r: &[f64; 2]| r[1] - y;
    let (uu, uv, vv) = (product(&du, &du), product(&du, &dv), product(&dv, &dv));
    let (uy, vy) = (product(&du, &dy), product(&dv, &dy));
    let det = uu * vv - uv * uv;
    if det <= 1e-12 * uu * vv {
        return None;
    }
    let (b, c) = ((uy * vv - vy * uv) / det, (vy * uu - uy * uv) / det);
    let left = rows.iter().map(|r| (dy(r) - b * du(r) - c * dv(r)).powi(2)).sum();
    Some((left, [b, c]))
}

/// The strictly rising curve through the origin that misses the rows least: what a tabulated law accepts.
///
/// Pool adjacent violators (Barlow et al. 1972): neighbours that fall are replaced by their mean. Rows rise in x.
pub fn rising(rows: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let mut pools: Vec<(f64, [f64; 2])> = Vec::new();
    for row in rows.iter().filter(|row| row[0] > 0.0) {
        pools.push((1.0, *row));
        while let [.., (m, a), (n, b)] = pools[..] {
            if a[1] < b[1] {
                break;
            }
            pools.truncate(pools.len() - 2);
            pools.push((m + n, [0, 1].map(|k| (m * a[k] + n * b[k]) / (m + n))));
        }
    }
    let above = pools.into_iter().map(|pool| pool.1).filter(|row| row[1] > 0.0);
    [[0.0, 0.0]].into_iter().chain(above).collect()
}

/// At most `most` rows: means over equal stretches of x. Rows rise in x.
pub fn thinned(rows: &[[f64; 2]], most: usize) -> Vec<[f64; 2]> {
    let (Some(first), Some(last)) = (rows.first(), rows.last()) else { return Vec::new() };
    if rows.len() <= most {
        return rows.to_vec();
    }
    let width = (last[0] - first[0]) / most as f64;
    let place = |row: &[f64; 2]| (((row[0] - first[0]) / width) as usize).min(most - 1);
    let mean = |part: &[[f64; 2]]| [0, 1].map(|k| part.iter().map(|row| row[k]).sum::<f64>() / part.len() as f64);
    rows.chunk_by(|a, b| place(a) == place(b)).map(mean).collect()
}

/// Straight between rows that rise in x; beyond them the nearest row's value.
pub fn at(rows: &[[f64; 2]], x: f64) -> f64 {
    let after = rows.partition_point(|row| row[0] < x);
    match (after.checked_sub(1).and_then(|i| rows.get(i)), rows.get(after)) {
        (Some([x0, y0]), Some([x1, y1])) => y0 + (y1 - y0) * (x - x0) / (x1 - x0),
        (Some(row), None) | (None, Some(row)) => row[1],
        (None, None) => f64::NAN,
    }
}

/// g(ε) = 2 (λ − λ⁻²).
fn shape(strain: f64) -> f64 {
    let stretch = 1.0 + strain;
    2.0 * (stretch - 1.0 / (stretch * stretch))
}

/// Σ g P / Σ g².
fn ratio(pairs: impl Iterator<Item = (f64, f64)>) -> Option<f64> {
    let [above, below] = pairs.fold([0.0, 0.0], |[a, b], (g, p)| [a + g * p, b + g * g]);
    (below > 0.0).then(|| above / below)
}

#[cfg(test)]
#[path = "specimen_tests.rs"]
mod tests;
