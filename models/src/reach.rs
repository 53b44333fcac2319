//! Pressure at which a response meets its target, or why there is none: for targets that a quick search does not find.

/// A target missed by no more than this is met \[m or rad\]: far below any camera, far above rounding.
pub(crate) const MET: f64 = 1e-9;
/// Pressures sampled, the first at zero and the last at the end, dense at low pressure, where the response is steepest; and
/// with transverse loads, under which a robot may rest in several shapes.
pub(crate) const SAMPLES: [usize; 2] = [64, 1024];
/// Halvings that take an interval of pressures to rounding.
const HALVINGS: usize = 200;
/// Narrowings of a summit, each by the golden section: to the square root of rounding, where it is flat.
const NARROWINGS: usize = 60;
const GOLDEN: f64 = 0.618_033_988_749_894_9;

/// A pressure and the response there; NaN without equilibrium.
type PressureResponse = (f64, f64);

#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Reach {
    At(f64),
    /// Passed over between two pressures next to each other.
    Gap {
        low: PressureResponse,
        high: PressureResponse,
        between: &'static str,
    },
    /// All that can be had, ends polished.
    Beyond {
        least: f64,
        most: f64,
    },
    Nowhere,
}

/// A pressure from 0 to `most` at which `f` meets its target: the lowest that so many samples show.
pub(crate) fn reach(f: &mut dyn FnMut(f64) -> f64, wanted: f64, most: f64, samples: usize) -> Reach {
    let place = |i: usize| most * (i as f64 / (samples - 1) as f64).powi(3);
    let mut seen = SearchedRange { wanted, gap: None, last: None, least: f64::INFINITY, most: f64::NEG_INFINITY };
    let mut point = (0.0, f(0.0));
    let mut before = point;
    for i in 0..samples {
        let next = if i + 1 < samples { (place(i + 1), f(place(i + 1))) } else { point };
        // Summits and valleys between samples, and the edges of what has an equilibrium, are samples too.
        let edge = match (before.1.is_nan(), point.1.is_nan()) {
            (true, false) => Some(edge(f, point, before)),
            (false, true) => Some(edge(f, before, point)),
            _ => None,
        };
        let found = edge.and_then(|edge| seen.visit(f, edge));
        let found = found.or_else(|| seen.visit(f, point));
        let found = found.or_else(|| summit(f, before, point, next).and_then(|top| seen.visit(f, top)));
        if let Some(p) = found {
            return Reach::At(p);
        }
        (before, point) = (point, next);
    }
    match seen.gap {
        Some(gap) => gap,
        None if seen.least > seen.most => Reach::Nowhere,
        None => Reach::Beyond { least: seen.least, most: seen.most },
    }
}

struct SearchedRange {
    wanted: f64,
    gap: Option<Reach>,
    last: Option<PressureResponse>,
    least: f64,
    most: f64,
}

impl SearchedRange {
    /// The next point; a pressure if the target is met at it or on the way to it.
    fn visit(&mut self, f: &mut dyn FnMut(f64) -> f64, point: PressureResponse) -> Option<f64> {
        let (p, value) = point;
        if value.is_nan() {
            return None;
        }
        (self.least, self.most) = (self.least.min(value), self.most.max(value));
        if (value - self.wanted).abs() <= MET {
            return Some(p);
        }
        let last = self.last.replace(point)?;
        if (last.1 < self.wanted) == (value < self.wanted) {
            return None;
        }
        match cross(f, last, point, self.wanted) {
            Reach::At(p) => Some(p),
            gap => {
                self.gap.get_or_insert(gap);
                None
            }
        }
    }
}

/// Halves the interval between a point below the target and one above it, until it is met or the two are neighbours.
fn cross(f: &mut dyn FnMut(f64) -> f64, mut low: PressureResponse, mut high: PressureResponse, wanted: f64) -> Reach {
    for _ in 0..HALVINGS {
        let p = 0.5 * (low.0 + high.0);
        if p == low.0 || p == high.0 {
            break;
        }
        let value = f(p);
        if value.is_nan() {
            let (near, far) = (edge(f, low, (p, value)), edge(f, high, (p, value)));
            let passed = |a: PressureResponse, b: PressureResponse| (a.1 < wanted) != (b.1 < wanted);
            match (passed(low, near), passed(far, high)) {
                (true, _) => high = near,
                (_, true) => low = far,
                _ => return Reach::Gap { low: near, high: far, between: "no equilibrium" },
            }
            continue;
        }
        if (value - wanted).abs() <= MET {
            return Reach::At(p);
        }
        let on_low = (value < wanted) == (low.1 < wanted);
        if on_low { low = (p, value) } else { high = (p, value) }
    }
    Reach::Gap { low, high, between: "a jump" }
}

/// The last point with an equilibrium on the way from one that has one to one that has none.
fn edge(f: &mut dyn FnMut(f64) -> f64, mut inside: PressureResponse, outside: PressureResponse) -> PressureResponse {
    let mut beyond = outside.0;
    for _ in 0..HALVINGS {
        let p = 0.5 * (inside.0 + beyond);
        if p == inside.0 || p == beyond {
            break;
        }
        match f(p) {
            value if value.is_nan() => beyond = p,
            value => inside = (p, value),
        }
    }
    inside
}

/// The highest or lowest point near a sample that is higher or lower than both of its neighbours.
fn summit(
    f: &mut dyn FnMut(f64) -> f64,
    before: PressureResponse,
    at: PressureResponse,
    next: PressureResponse,
) -> Option<PressureResponse> {
    let sign = if at.1 >= before.1 && at.1 >= next.1 {
        1.0
    } else if at.1 <= before.1 && at.1 <= next.1 {
        -1.0
    } else {
        return None;
    };
    let mut best = at;
    let mut height = |p: f64| {
        let value = f(p);
        if sign * value > sign * best.1 {
            best = (p, value);
        }
        if value.is_nan() { f64::NEG_INFINITY } else { sign * value }
    };
    let (mut low, mut high) = (before.0, next.0);
    let inner = |low: f64, high: f64| [high - GOLDEN * (high - low), low + GOLDEN * (high - low)];
    let [mut left, mut right] = inner(low, high).map(|p| (p, height(p)));
    for _ in 0..NARROWINGS {
        if left.1 > right.1 {
            (high, right) = (right.0, left);
            left.0 = inner(low, high)[0];
            left.1 = height(left.0);
        } else {
            (low, left) = (left.0, right);
            right.0 = inner(low, high)[1];
            right.1 = height(right.0);
        }
    }
    Some(best)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_summit_between_samples_is_within_reach_and_polished() {
        // Highest at 0.7654, between two samples.
        let f = |p: f64| 1.0 - (p - 0.7654).powi(2);
        let Reach::At(p) = reach(&mut { f }, 1.0 - 1e-8, 1.0, 64) else { panic!("not reached") };
        assert!((f(p) - (1.0 - 1e-8)).abs() <= MET);
        let Reach::Beyond { least, most } = reach(&mut { f }, 1.1, 1.0, 64) else { panic!("no range") };
        assert!((most - 1.0).abs() < 1e-12 && least == f(0.0), "{most}");
    }

    #[test]
    fn a_jump_is_told_with_both_sides() {
        let mut f = |p: f64| if p < 0.3 { p } else { p + 0.5 };
        let Reach::Gap { low, high, between } = reach(&mut f, 0.5, 1.0, 64) else { panic!("no gap") };
        assert!(between == "a jump" && (high.0 - low.0) < 1e-15, "{low:?} {high:?}");
        assert!((low.1 - 0.3).abs() < 1e-12 && (high.1 - 0.8).abs() < 1e-12);
    }

    #[test]
    fn what_lies_beyond_an_edge_without_equilibrium_is_told() {
        let mut f = |p: f64| if (0.2..0.6).contains(&p) { f64::NAN } else { p };
        let Reach::Gap { low, high, between } = reach(&mut f, 0.4, 1.0, 64) else { panic!("no gap") };
        assert!(between == "no equilibrium" && (low.0 - 0.2).abs() < 1e-12 && (high.0 - 0.6).abs() < 1e-12);
        let Reach::At(p) = reach(&mut f, 0.2 - 1e-9, 1.0, 64) else { panic!("not reached") };
        assert!((p - 0.2).abs() < 1e-8);
        assert_eq!(reach(&mut |_| f64::NAN, 0.5, 1.0, 64), Reach::Nowhere);
    }

    #[test]
    fn the_edge_of_the_pressures_can_be_the_summit() {
        for (f, top) in [(&(|p: f64| (-p).exp()) as &dyn Fn(f64) -> f64, 1.0), (&|p: f64| p.sqrt(), 1.0)] {
            let Reach::Beyond { most, .. } = reach(&mut |p| f(p), 2.0, 1.0, 64) else { panic!("no range") };
            assert_eq!(most, top);
        }
    }
}
