//! One yarn family of a woven fabric: a curve for loading, and one for the way back, scaled to meet it where it turned.
//!
//! T = T(ε*) u(ε)/u(ε*) below ε*, the largest strain seen: see [`super::woven`].

use super::curve::Curve;

/// Tension of one yarn family over its strain, with a curve for unloading where it differs.
#[derive(Debug, Clone, PartialEq)]
pub struct Yarn {
    pub(super) load: Curve,
    pub(super) unload: Option<Curve>,
}

impl Yarn {
    /// Stress over nominal strain \[Pa\], and the shape of the way back if it differs.
    ///
    /// # Errors
    /// An unloading curve with rows below zero, or one that would create energy: unloading over loading stress must not fall
    /// with strain.
    pub fn new(load: Curve, unload: Option<Curve>) -> Result<Yarn, String> {
        if let Some(back) = &unload {
            loses_energy(&load, back)?;
        }
        Ok(Yarn { load, unload })
    }

    /// Stress at a strain, after the largest strain `past` of its history \[Pa\].
    pub(super) fn stress(&self, strain: f64, past: f64) -> f64 {
        let (curve, scale) = self.way(strain, past);
        scale * curve.value(strain)
    }

    /// Slope dT/dε of the stress on the same branch \[Pa\].
    pub(super) fn slope(&self, strain: f64, past: f64) -> f64 {
        let (curve, scale) = self.way(strain, past);
        scale * curve.slope(strain)
    }

    /// The curve that the stress follows, and what it is multiplied by.
    fn way(&self, strain: f64, past: f64) -> (&Curve, f64) {
        match &self.unload {
            Some(back) if strain > 0.0 && strain < past => (back, self.scale(back, past)),
            _ => (&self.load, 1.0),
        }
    }

    /// A slope that neither way exceeds within `reach` of a strain, whatever part of it is remembered \[Pa\].
    pub(super) fn steepest(&self, strain: f64, past: f64, reach: f64) -> f64 {
        let [from, to] = [strain - reach, strain + reach];
        let load = self.load.steepest(from, to);
        match &self.unload {
            Some(back) if to > 0.0 => load.max(self.scale(back, past.max(from)) * back.steepest(from.max(0.0), to)),
            _ => load,
        }
    }

    /// Energy per volume that unloading would give back \[J/m³\].
    pub(super) fn energy(&self, strain: f64, past: f64) -> f64 {
        match &self.unload {
            Some(back) if strain > 0.0 && strain < past => self.scale(back, past) * back.integral(strain),
            Some(_) if strain > 0.0 => self.load.integral(strain) - self.lost(past),
            _ => self.load.integral(strain),
        }
    }

    /// Energy D(ε*) per volume lost by hysteresis up to the largest strain ε* \[J/m³\].
    pub(super) fn lost(&self, past: f64) -> f64 {
        match &self.unload {
            Some(back) if past > 0.0 => {
                (self.load.integral(past) - self.scale(back, past) * back.integral(past)).max(0.0)
            }
            _ => 0.0,
        }
    }

    /// T(ε*)/u(ε*), which falls from its value at 0.
    fn scale(&self, back: &Curve, past: f64) -> f64 {
        let of = |curve: &Curve| if past > 0.0 { curve.value(past) } else { curve.initial_slope() };
        of(&self.load) / of(back)
    }

    /// A slope that the stress never undercuts, loading or unloading. T(ε*)/u(ε*) falls towards the ratio of the last slopes.
    pub(super) fn least_slope(&self) -> f64 {
        let load = self.load.slope_range()[0];
        match &self.unload {
            Some(back) => load.min(back.slope_range()[0] * self.load.last_slope() / back.last_slope()),
            None => load,
        }
    }
}

/// u/T must not fall. Both are straight between their joint rows, so their ratio is monotone there: the rows and the slopes
/// at both ends suffice.
fn loses_energy(load: &Curve, back: &Curve) -> Result<(), String> {
    if back.has_negative_rows() {
        return Err(
            "the unloading curve has rows below zero strain; leave them out, slack yarns unload as they load".into()
        );
    }
    let mut at: Vec<f64> = load.rows().iter().chain(back.rows()).map(|r| r[0]).filter(|x| *x > 0.0).collect();
    at.sort_by(f64::total_cmp);
    let inside = at.iter().map(|x| (*x, back.value(*x) / load.value(*x)));
    let start = (0.0, back.initial_slope() / load.initial_slope());
    let end = (f64::INFINITY, back.last_slope() / load.last_slope());
    let ratios: Vec<(f64, f64)> = [start].into_iter().chain(inside).chain([end]).collect();
    match ratios.windows(2).find(|w| w[1].1 < w[0].1 * (1.0 - 1e-9)) {
        None => Ok(()),
        Some(w) => Err(format!(
            "the unloading curve would create energy beyond strain {}: unloading over loading stress falls from {:.4} to \
             {:.4} there; write unloading stresses that start lower and rise more steeply than those of loading",
            w[0].0, w[0].1, w[1].1
        )),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_way_there_or_back_is_steeper_than_the_steepest_within_reach() {
        let table = |rows: &[[f64; 2]]| Curve::table(rows).unwrap();
        let load = table(&[[0.0, 0.0], [0.03, 6e6], [0.1, 13e6]]);
        let yarn = Yarn::new(load, Some(table(&[[0.0, 0.0], [0.05, 0.3e6], [0.09, 1e6], [0.1, 10e6]]))).unwrap();
        let (reach, places) = (0.01, || (-20..=140).map(|i| 1e-3 * f64::from(i)));
        for (strain, seen) in places().flat_map(|strain| places().map(move |seen| (strain, f64::max(seen, strain)))) {
            let steepest = yarn.steepest(strain, seen, reach);
            for next in (-9..=9).map(|i| strain + 1e-3 * f64::from(i)) {
                for past in [seen.max(next), seen.max(strain + 9e-3)] {
                    let slope = yarn.slope(next, past);
                    assert!(
                        slope <= steepest * (1.0 + 1e-9),
                        "{strain} {seen}: {slope} at {next} after {past}, {steepest}"
                    );
                }
            }
        }
        // At the turn the way back is nine times as steep as the way there.
        assert!(yarn.steepest(0.1, 0.1, reach) > 8.9e8 && yarn.slope(0.1, 0.1) < 2.1e8);
    }
}
