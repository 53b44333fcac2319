//! Clocks that pair changes of movement with changes of pressure: shift and rate are fitted together.

use super::edges::SignalEdge;

/// The log's time is `offset_s + rate · t` of the camera's.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Clock {
    pub offset_s: f64,
    pub rate: f64,
}

impl Clock {
    /// The time of the log at a time of the camera \[s\].
    pub(crate) fn at(self, t_s: f64) -> f64 {
        self.offset_s + self.rate * t_s
    }
}

/// Rates that are searched: a camera of 25 frames per second that was taken for one of 30, and the like.
const RATES: [f64; 2] = [0.7, 1.43];
/// Fewest pairs from which a rate is fitted.
const FEWEST_FOR_RATE: usize = 3;
/// Changes at each end of a track from which clocks are proposed.
const ENDS: usize = 6;
/// Same for tracks with many changes.
const FEW_ENDS: usize = 2;
const MANY: usize = 100;
/// Part of the usual time between changes that two changes of one pair are apart at most.
const APART: [f64; 2] = [0.15, 0.3];
/// Changes are nearly a pair within this multiple of it.
const NEARLY: f64 = 2.5;
/// An error of fitted times that is of no importance \[s\].
const FINE_S: f64 = 0.05;

/// Changes of both tracks, and when they begin and end.
pub(super) struct TrackPair<'a> {
    pub camera: &'a [SignalEdge],
    pub log: &'a [SignalEdge],
    pub camera_s: [f64; 2],
    pub log_s: [f64; 2],
    /// Usual time between changes of the log \[s\].
    pub gap_s: f64,
}

/// A clock with the changes that it pairs.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct ClockCandidate {
    pub clock: Clock,
    /// Whether movement along the principal direction is towards lower pressure.
    pub turned: bool,
    pub pairs: Vec<[usize; 2]>,
    /// Changes without partner where both tracks are known.
    pub alone: usize,
}

impl ClockCandidate {
    pub(super) fn score(&self) -> isize {
        self.pairs.len() as isize - self.alone as isize
    }
}

impl TrackPair<'_> {
    /// How far two changes of one pair are apart at most \[s\].
    pub(super) fn tolerance_s(&self, camera: &SignalEdge, log: &SignalEdge) -> f64 {
        (camera.gap_s + log.gap_s).clamp(APART[0] * self.gap_s, APART[1] * self.gap_s)
    }

    /// What a clock pairs, within `wide` times the tolerance.
    pub(super) fn paired(&self, clock: Clock, turned: bool, wide: f64) -> ClockCandidate {
        let mut pairs: Vec<[usize; 2]> = Vec::new();
        let mut next = 0;
        for (i, edge) in self.camera.iter().enumerate() {
            let at_s = clock.at(edge.t_s);
            let off = |j: usize| (self.log[j].t_s - at_s).abs();
            while next + 1 < self.log.len() && off(next + 1) <= off(next) {
                next += 1;
            }
            let Some(partner) = self.log.get(next) else { break };
            let way = edge.sign * if turned { -1 } else { 1 } * partner.sign;
            if way >= 0
                && off(next) <= wide * self.tolerance_s(edge, partner)
                && pairs.last().is_none_or(|p| p[1] < next)
            {
                pairs.push([i, next]);
            }
        }
        let inside = |t_s: f64, [first, last]: [f64; 2]| t_s > first && t_s < last;
        let [begin, end] = self.camera_s.map(|t_s| clock.at(t_s));
        let cameras = self.camera.iter().filter(|edge| inside(clock.at(edge.t_s), self.log_s)).count();
        let logs = self.log.iter().filter(|edge| inside(edge.t_s, [begin, end])).count();
        let alone = (cameras + logs).saturating_sub(2 * pairs.len());
        ClockCandidate { clock, turned, pairs, alone }
    }

    /// All clocks that pair as many changes as the best or have as few without partner: one for each way of pairing.
    pub(super) fn search(&self, turned: bool) -> Vec<ClockCandidate> {
        let mut found: Vec<ClockCandidate> = Vec::new();
        let mut most = 0;
        for clock in self.proposed() {
            let mut candidate = self.paired(clock, turned, 1.0);
            if 2 * candidate.pairs.len() < most {
                continue;
            }
            for _ in 0..3 {
                let fitted = self.fitted(&candidate.pairs);
                candidate = self.paired(fitted, turned, 1.0);
            }
            if !candidate.pairs.is_empty() && !found.iter().any(|known| known.pairs == candidate.pairs) {
                most = most.max(candidate.pairs.len());
                if candidate.pairs.len() + 1 >= most {
                    found.push(candidate);
                }
            }
        }
        found
    }

    /// Clocks through two changes of each track, near the ends of one of them, and with rate 1 through one.
    fn proposed(&self) -> Vec<Clock> {
        let ends = |count: usize| {
            let some = if count > MANY { FEW_ENDS } else { ENDS }.min(count);
            (0..some).flat_map(move |i| (count - some..count).map(move |k| [i, k])).filter(|[i, k]| i < k)
        };
        let all = |count: usize| (0..count).flat_map(move |i| (i + 1..count).map(move |k| [i, k]));
        let (cameras, logs) = (self.camera.len(), self.log.len());
        let mut found = Vec::new();
        let mut propose = |camera: [usize; 2], log: [usize; 2]| {
            let [t0, t1] = camera.map(|i| self.camera[i].t_s);
            let [l0, l1] = log.map(|j| self.log[j].t_s);
            let rate = (l1 - l0) / (t1 - t0);
            if (RATES[0]..=RATES[1]).contains(&rate) {
                found.push(Clock { offset_s: l0 - rate * t0, rate });
            }
        };
        ends(cameras).for_each(|camera| all(logs).for_each(|log| propose(camera, log)));
        ends(logs).for_each(|log| all(cameras).for_each(|camera| propose(camera, log)));
        let one = |i: usize, j: usize| Clock { offset_s: self.log[j].t_s - self.camera[i].t_s, rate: 1.0 };
        let singles = (0..cameras.min(MANY)).flat_map(|i| (0..logs.min(MANY)).map(move |j| one(i, j)));
        found.extend(singles);
        let mut keys = std::collections::HashSet::new();
        let [begin, end] = self.camera_s;
        let fine = 0.05 * self.gap_s.max(FINE_S);
        found.retain(|clock| keys.insert([begin, end].map(|t_s| (clock.at(t_s) / fine).round() as i64)));
        found
    }

    /// Squares of the distances within pairs \[s²\].
    pub(super) fn squares(&self, candidate: &ClockCandidate) -> f64 {
        let off = |[i, j]: &[usize; 2]| self.log[*j].t_s - candidate.clock.at(self.camera[*i].t_s);
        candidate.pairs.iter().map(|pair| off(pair).powi(2)).sum()
    }

    /// The largest distance within a pair, and of changes that only just have no partner, beyond the time between samples \[s\].
    pub(super) fn farthest_s(&self, candidate: &ClockCandidate) -> f64 {
        let wider = self.paired(candidate.clock, candidate.turned, NEARLY);
        let off = |[i, j]: &[usize; 2]| {
            let (camera, log) = (&self.camera[*i], &self.log[*j]);
            (log.t_s - candidate.clock.at(camera.t_s)).abs() - camera.gap_s - log.gap_s
        };
        wider.pairs.iter().map(off).fold(0.0, f64::max)
    }

    /// Shift and rate of pairs by least squares; rate 1 unless another one is clearly better.
    pub(super) fn fitted(&self, pairs: &[[usize; 2]]) -> Clock {
        let points: Vec<[f64; 2]> = pairs.iter().map(|[i, j]| [self.camera[*i].t_s, self.log[*j].t_s]).collect();
        let count = points.len().max(1) as f64;
        let mean = [0, 1].map(|k| points.iter().map(|p| p[k]).sum::<f64>() / count);
        let one = Clock { offset_s: mean[1] - mean[0], rate: 1.0 };
        let moment = |k: usize| points.iter().map(|p| (p[0] - mean[0]) * (p[k] - mean[k])).sum::<f64>();
        if points.len() < FEWEST_FOR_RATE {
            return one;
        }
        let rate = (moment(1) / moment(0)).clamp(RATES[0], RATES[1]);
        let free = Clock { offset_s: mean[1] - rate * mean[0], rate };
        let squares = |clock: Clock| points.iter().map(|p| (p[1] - clock.at(p[0])).powi(2)).sum::<f64>();
        let allowed = (squares(free) + count * FINE_S * FINE_S) * (1.0 + 4.0 / (count - 2.0));
        if squares(one) <= allowed { one } else { free }
    }
}
