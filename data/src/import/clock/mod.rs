//! The clocks of camera and pressure log, from the times at which movement and pressure change.
//!
//! Shift and rate are fitted to pairs of changes (`pairs`). A clock explains a recording if it pairs most changes and the movement
//! follows the pressure there (`follows`). A clock is found if no other one pairs as many changes or leaves as few alone; a clock that
//! the caller gives is refused if another one is better in both, if its pairs are apart, or if the movement does not follow.

mod edges;
mod follows;
mod pairs;
#[cfg(test)]
mod tests;
mod track;

use super::options::{ImportOptions, Offset};
use super::recording::Recording;
use crate::agreement::longest_step_s;
use crate::error::ClockTracks;
use crate::policy::{SAME_ACTUATOR_PA, tolerance_act_pa};
use edges::SignalEdge;
use follows::{CameraFrame, follows};
pub(crate) use pairs::Clock;
use pairs::{ClockCandidate, TrackPair};
use track::{Track, noise_of};

/// Least correlation of movement and pressure.
const FOLLOWS: f64 = 0.95;
/// Least share of the changes of the shorter track that a clock pairs, and of all changes where both tracks are known.
const PAIRED: [f64; 2] = [0.6, 0.7];
/// Share of all changes below which a given clock is refused, where both tracks have so many.
const HARDLY: f64 = 0.5;
const SEVERAL: usize = 3;
/// A given clock may pair changes that are farther apart by this much than the pairs of a clock that is found.
const WIDE: f64 = 1.5;
/// How far movement may be from pressure with a given clock, beyond the time between samples \[s\].
const LATE_S: f64 = 0.6;
/// Part of the time between changes around each of them in which movement need not follow.
const ON_ITS_WAY: f64 = 0.2;
/// Part of the range of the pressure by which it turns.
const TURN: f64 = 0.05;

pub(crate) struct Readings<'a> {
    pub times_s: &'a [f64],
    /// Pressures of body and actuator \[Pa\].
    pub values_pa: [&'a [f64]; 2],
}

/// The clock to use, and what to report; or the message and the remedy.
pub(crate) type Agreed = Result<(Clock, String), [String; 2]>;

/// Checks the clock that the caller gives, or finds it.
pub(crate) fn agree(readings: &Readings, recording: &Recording, options: &ImportOptions) -> Agreed {
    let given = given(options);
    let act = || readings.values_pa[1].iter().copied().filter(|p| p.is_finite());
    let (low, high) = (act().fold(f64::INFINITY, f64::min), act().fold(f64::NEG_INFINITY, f64::max));
    let unseen = |why: &str| given.map(|clock| (clock, kept(options.offset))).ok_or_else(|| nothing(recording, why));
    if high - low <= 2.0 * tolerance_act_pa(low) {
        return unseen("the actuator's pressure does not change");
    }
    let Some(track) = Track::of(recording) else { return unseen("no marker moves") };
    let (log, camera, gap_s) = changes(readings, &track, options);
    let sides =
        TrackPair { camera: &camera, log: &log, camera_s: ends(&track.times), log_s: ends(readings.times_s), gap_s };
    let judge = ClockJudge::of(&sides, &track, readings, options, (TURN * (high - low)).max(SAME_ACTUATOR_PA));
    match given {
        Some(clock) => judge.check(clock, recording, options.offset),
        None => judge.find(recording),
    }
}

fn given(options: &ImportOptions) -> Option<Clock> {
    match options.offset {
        Offset::Given(offset_s) => Some(Clock { offset_s, rate: 1.0 }),
        Offset::Same => Some(Clock { offset_s: 0.0, rate: 1.0 }),
        Offset::Find => None,
    }
}

fn ends(times: &[f64]) -> [f64; 2] {
    [times[0], times[times.len() - 1]]
}

/// Changes of pressure and of movement, and the usual time between pressure changes \[s\].
fn changes(readings: &Readings, track: &Track, options: &ImportOptions) -> (Vec<SignalEdge>, Vec<SignalEdge>, f64) {
    let log = edges::of_log(readings.times_s, readings.values_pa, options);
    let gap_s = edges::usual_gap_s(&log, ends(readings.times_s));
    let camera = if log.is_empty() { Vec::new() } else { edges::of_movement(track, gap_s) };
    let [log, camera] = [log, camera].map(|found| if edges::too_many(&found) { Vec::new() } else { found });
    (log, camera, gap_s)
}

/// Points of a track in a picture.
const MOST_POINTS: usize = 2_000;

/// Movement and pressure as the clock of the caller puts them next to each other; without one both begin at the log's first reading.
/// `None` if no marker moves.
pub(crate) fn tracks(readings: &Readings, recording: &Recording, options: &ImportOptions) -> Option<ClockTracks> {
    let track = Track::of(recording)?;
    let (log, camera, _) = changes(readings, &track, options);
    let begin_s = readings.times_s[0] - track.times[0];
    let clock = given(options).unwrap_or(Clock { offset_s: begin_s, rate: 1.0 });
    let shares = |times: &[f64], values: &[f64]| {
        let known = || values.iter().copied().filter(|v| v.is_finite());
        let (low, high) = (known().fold(f64::INFINITY, f64::min), known().fold(f64::NEG_INFINITY, f64::max));
        let point = |(t, v): (&f64, &f64)| [*t, (v - low) / (high - low).max(f64::MIN_POSITIVE)];
        times.iter().zip(values).step_by(times.len().div_ceil(MOST_POINTS)).map(point).collect::<Vec<_>>()
    };
    let [moved, pressed] = [&camera, &log].map(|edges| edges.iter().map(|edge| edge.t_s).collect::<Vec<f64>>());
    let of_log = |times: &[f64]| times.iter().map(|t| clock.at(*t)).collect::<Vec<f64>>();
    let mut movement = shares(&of_log(&track.times), &track.along());
    // From the first frame on, which is usually at rest.
    if movement.first().is_some_and(|[_, share]| *share > 0.5) {
        movement.iter_mut().for_each(|[_, share]| *share = 1.0 - *share);
    }
    Some(ClockTracks {
        movement,
        pressure: shares(readings.times_s, readings.values_pa[1]),
        changes_s: [of_log(&moved), pressed],
        offset_s: clock.offset_s,
    })
}

/// What was assumed, where nothing contradicts it.
fn kept(offset: Offset) -> String {
    match offset {
        Offset::Given(offset_s) => format!("the pressure log's clock is {offset_s} s ahead of the camera's, as given"),
        _ => "the pressure log and the camera were taken to have one clock".to_string(),
    }
}

fn nothing(recording: &Recording, why: &str) -> [String; 2] {
    let rate = if recording.in_seconds { "" } else { "; check --fps, and whether the frame rate varies" };
    [
        format!("movement and pressure do not show the offset of the clocks: {why}"),
        format!("give the log's time minus the camera's: --clock-offset 0s, or what a flash or a knock shows{rate}"),
    ]
}

struct ClockJudge<'a> {
    sides: &'a TrackPair<'a>,
    track: &'a Track,
    along: Vec<f64>,
    readings: &'a Readings<'a>,
    rising: Vec<bool>,
    frames_per_s: Option<f64>,
}

impl<'a> ClockJudge<'a> {
    /// The pressure turns where it comes back by `turn_pa`.
    fn of(
        sides: &'a TrackPair<'a>,
        track: &'a Track,
        readings: &'a Readings<'a>,
        options: &ImportOptions,
        turn_pa: f64,
    ) -> ClockJudge<'a> {
        let branches = super::holds::branches(readings.values_pa[1], turn_pa);
        let rising = branches.into_iter().flat_map(|(range, rising)| range.map(move |_| rising)).collect();
        ClockJudge { sides, track, along: track.along(), readings, rising, frames_per_s: options.frames_per_s }
    }

    /// Correlation of movement and pressure at a clock.
    fn follows(&self, clock: Clock) -> Option<f64> {
        let [first, last] = self.sides.log_s;
        let times_s = self.readings.times_s;
        let longest_s = longest_step_s(times_s);
        let on_its_way = |t_s: f64| {
            let near = ON_ITS_WAY * self.sides.gap_s;
            let next = self.sides.log.partition_point(|edge| edge.t_s < t_s - near);
            self.sides.log.get(next).is_some_and(|edge| edge.t_s < t_s + near)
        };
        let frame = |(t_s, moved): (&f64, &f64)| {
            let t_s = clock.at(*t_s);
            if t_s < first || t_s > last || on_its_way(t_s) {
                return None;
            }
            let at = times_s.partition_point(|t| *t <= t_s).saturating_sub(1);
            let [body_pa, act_pa] = self.readings.values_pa.map(|values| values[at]);
            (act_pa.is_finite() && t_s <= times_s[at] + longest_s).then(|| CameraFrame {
                moved: *moved,
                act_pa,
                branch: (self.rising[at], (body_pa * 1e-3).round() as i64),
            })
        };
        let frames: Vec<CameraFrame> = self.track.times.iter().zip(&self.along).filter_map(frame).collect();
        follows(&frames, noise_of(&self.along))
    }

    fn explains(&self, candidate: &ClockCandidate) -> bool {
        let (paired, TrackPair { camera, log, .. }) = (candidate.pairs.len() as f64, self.sides);
        paired >= PAIRED[0] * camera.len().min(log.len()) as f64
            && 2.0 * paired >= PAIRED[1] * (2.0 * paired + candidate.alone as f64)
            && self.follows(candidate.clock).is_some_and(|r| r >= FOLLOWS)
    }

    /// The clock that explains the recording best, then those that explain it as well; clocks that hardly differ are one.
    fn explanations(&self) -> Vec<ClockCandidate> {
        let mut found: Vec<ClockCandidate> =
            [false, true].into_iter().flat_map(|turned| self.sides.search(turned)).collect();
        let off = |candidate: &ClockCandidate| self.sides.squares(candidate) / candidate.pairs.len().max(1) as f64;
        found.sort_by(|a, b| {
            (b.pairs.len(), b.score()).cmp(&(a.pairs.len(), a.score())).then(off(a).total_cmp(&off(b)))
        });
        let mut kept: Vec<ClockCandidate> = Vec::new();
        for candidate in found {
            let rivals =
                |best: &ClockCandidate| candidate.pairs.len() >= best.pairs.len() || candidate.score() >= best.score();
            let new = kept.iter().all(|known| self.differ(known, &candidate));
            if new && kept.first().is_none_or(rivals) && self.explains(&candidate) {
                kept.push(candidate);
            }
        }
        kept
    }

    fn differ(&self, a: &ClockCandidate, b: &ClockCandidate) -> bool {
        let times = a.pairs.iter().chain(&b.pairs).map(|pair| self.sides.camera[pair[0]].t_s);
        times.map(|t_s| (a.clock.at(t_s) - b.clock.at(t_s)).abs()).fold(0.0, f64::max) > 0.5 * self.sides.gap_s
    }

    fn find(&self, recording: &Recording) -> Agreed {
        let TrackPair { camera, log, .. } = self.sides;
        let found = self.explanations();
        let Some(best) = found.first() else {
            let counts =
                [(camera, "movement"), (log, "pressure")].map(|(edges, of)| format!("{} of {of}", edges.len()));
            return Err(nothing(recording, &format!("no offset pairs their changes ({})", counts.join(", "))));
        };
        if let Some(rival) = found.get(1) {
            let message = format!(
                "two offsets explain the changes of movement and pressure: the log's clock {} and {}",
                self.words(best, recording),
                self.words(rival, recording)
            );
            return Err([message, self.which([best, rival], recording)]);
        }
        let farthest_s = self.sides.farthest_s(best);
        if farthest_s > LATE_S {
            let varies = format!("with the best offset they are {farthest_s:.1} s apart: does the frame rate vary?");
            return Err(nothing(recording, &varies));
        }
        let r = self.follows(best.clock).unwrap_or_default();
        Ok((best.clock, format!("the pressure log's clock {}; r = {r:.2}", self.words(best, recording))))
    }

    /// What to type for each of two clocks; an offset alone is refused where the clocks do not run alike.
    fn which(&self, clocks: [&ClockCandidate; 2], recording: &Recording) -> String {
        let typed = |ClockCandidate { clock: Clock { offset_s, rate }, .. }: &ClockCandidate| {
            let offset = format!("--clock-offset {offset_s:.2}s");
            match self.frames_per_s.filter(|_| !recording.in_seconds) {
                _ if *rate == 1.0 => Some(offset),
                Some(fps) => Some(format!("--fps {:.4} {offset}", fps / rate)),
                None => None,
            }
        };
        let typed: Vec<String> = clocks.into_iter().filter_map(typed).collect();
        match &typed[..] {
            [] => "correct the times in one of the files: the two clocks do not run alike".to_string(),
            _ => format!("give the right one, for example {}", typed.join(" or ")),
        }
    }

    /// `is 3.40 s ahead of the camera's (7 of 7 changes)`.
    fn words(&self, candidate: &ClockCandidate, recording: &Recording) -> String {
        let Clock { offset_s, rate } = candidate.clock;
        let most = self.sides.camera.len().max(self.sides.log.len());
        let rate = match self.frames_per_s.filter(|_| !recording.in_seconds) {
            _ if rate == 1.0 => String::new(),
            None => format!(", and runs {rate:.4} times as fast"),
            Some(fps) => format!(" with {:.3} frames per second", fps / rate),
        };
        format!("is {offset_s:.2} s ahead of the camera's{rate} ({} of {most} changes)", candidate.pairs.len())
    }

    fn check(&self, clock: Clock, recording: &Recording, offset: Offset) -> Agreed {
        let given = [false, true].map(|turned| self.sides.paired(clock, turned, WIDE));
        let [rising, turned] = given;
        let given = if turned.score() > rising.score() { turned } else { rising };
        let r = self.follows(clock);
        let TrackPair { camera, log, .. } = self.sides;
        let enough = camera.len() >= SEVERAL && log.len() >= SEVERAL;
        let all = 2 * given.pairs.len() + given.alone;
        let apart = self.apart(&given);
        let found = if r.is_some() && !log.is_empty() { self.explanations() } else { Vec::new() };
        let better = |c: &&ClockCandidate| c.pairs.len() > given.pairs.len() && c.score() > given.score();
        let hardly = enough && all > 0 && 2.0 * given.pairs.len() as f64 <= HARDLY * all as f64;
        let why = if let Some(better) = found.iter().find(better) {
            format!("{} of {} changes of pressure have their movement", given.pairs.len(), better.pairs.len())
        } else if let Some(late_s) = apart {
            format!("movement and pressure change up to {late_s:.1} s apart")
        } else if let Some(r) = r.filter(|r| *r < FOLLOWS) {
            format!("the movement does not follow the pressure: r = {r:.2}, at least {FOLLOWS} is asked")
        } else if hardly {
            format!("{} of {all} changes of movement and pressure have a partner", 2 * given.pairs.len())
        } else {
            return Ok((clock, kept(offset)));
        };
        let now = match offset {
            Offset::Given(offset_s) => format!("with the log's clock {offset_s} s ahead, as given,"),
            _ => "if log and camera have one clock,".to_string(),
        };
        let words: Vec<String> = found.iter().take(2).map(|c| self.words(c, recording)).collect();
        let other = if words.is_empty() { String::new() } else { format!("; the log's clock {}", words.join(" or ")) };
        let help = match &found[..] {
            [] => "are log and video of one test, and is the pressure's column right? If so, give the offset that a flash or a knock \
                   shows: --clock-offset, the log's time minus the camera's"
                .to_string(),
            [_] => "add --clock-offset find to take the clock that movement and pressure show".to_string(),
            [a, b, ..] => self.which([a, b], recording),
        };
        Err([format!("{now} {why}{other}"), help])
    }

    /// How far a given clock is from its own pairs, if that is too much \[s\].
    fn apart(&self, given: &ClockCandidate) -> Option<f64> {
        let (first, last) = (given.pairs.first()?, given.pairs.last()?);
        let fitted = self.sides.fitted(&given.pairs);
        let gap = |edges: &[SignalEdge], k: usize| -> f64 {
            given.pairs.iter().map(|pair| edges[pair[k]].gap_s).sum::<f64>() / given.pairs.len() as f64
        };
        let allowed = LATE_S + gap(self.sides.camera, 0) + gap(self.sides.log, 1);
        let off = |pair: &[usize; 2]| {
            let t_s = self.sides.camera[pair[0]].t_s;
            (fitted.at(t_s) - given.clock.at(t_s)).abs()
        };
        Some(off(first).max(off(last))).filter(|off| given.pairs.len() >= SEVERAL && *off > allowed)
    }
}
