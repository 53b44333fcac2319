//! Whether pressures were kept at all: a hold has a least duration, and a ramp has none.

use crate::error::{DataError, Result};
use crate::header::PRESSURES;
use crate::rows::lowest_mean_pa;
use crate::streams::{HoldSegment, Recorder, Stream};
use crate::units::kpa;

/// A hold lasts at least so long \[s\].
const LEAST_HOLD_S: f64 = 0.5;
/// Fewest holds that can look like a ramp.
const FEWEST: usize = 8;
/// On a ramp the pressure moves on within holds by more than this part of all that it moves.
const RAMP: f64 = 0.3;
/// A piece of a ramp has less than this part of the rows of the usual hold.
const FEW_ROWS: f64 = 0.2;

/// Refuses recordings without holds, or with ramps between them, and holds whose mean pressure is below its bounds.
pub(crate) fn check_kept(recorder: &Recorder) -> Result<()> {
    let segments = || recorder.streams.iter().flat_map(|stream| &stream.segments);
    let too_low = |segment: &HoldSegment| {
        let mut means = segment.too_low.iter().zip(segment.means_pa()).zip(PRESSURES);
        means.find(|((_, mean), quantity)| *mean < lowest_mean_pa(*quantity)).and_then(|((fault, _), _)| fault.clone())
    };
    if let Some(fault) = segments().find_map(too_low) {
        return Err(fault);
    }
    let fullest = recorder.streams.iter().max_by_key(|stream| stream.segments.len());
    if let Some(stream) = fullest.filter(|stream| is_ramp(&stream.segments)) {
        let (run, count) = (&recorder.runs.names[stream.run], stream.segments.len());
        let message =
            format!("run {run} looks like a ramp: it falls into {count} holds within which the pressure moves on");
        return Err(remedy(recorder, message, stream.first_line));
    }
    (0..recorder.runs.names.len()).try_for_each(|run| no_pieces(recorder, run))
}

fn is_ramp(segments: &[HoldSegment]) -> bool {
    let within: f64 = segments.iter().map(|segment| (segment.ends_pa[1] - segment.ends_pa[0]).abs()).sum();
    let between: f64 = segments.windows(2).map(|pair| (pair[1].p_act_pa() - pair[0].p_act_pa()).abs()).sum();
    segments.len() >= FEWEST && within > RAMP * between
}

/// Pieces of a ramp between holds are in the rows of every marker of a run; a glimpse of one marker is not.
fn no_pieces(recorder: &Recorder, run: usize) -> Result<()> {
    let streams = || recorder.streams.iter().filter(move |stream| stream.run == run);
    let Some(first) = streams().min_by_key(|stream| pieces(stream).count()) else { return Ok(()) };
    let Some(piece) = pieces(first).next() else { return Ok(()) };
    let (run, p, rows) = (&recorder.runs.names[run], kpa(piece.p_act_pa()), piece.rows);
    let lasts = piece.last_t_s() - piece.first_t_s();
    let message = format!(
        "run {run} has a hold at {p:.1} kPa of {rows} rows in {lasts:.2} s, and others of many more: a hold lasts at least {LEAST_HOLD_S} s"
    );
    Err(remedy(recorder, message, piece.first_line))
}

/// Segments too short to be holds, compared with the one that contains the middle row.
fn pieces(stream: &Stream) -> impl Iterator<Item = &HoldSegment> {
    let mut rows: Vec<u64> = stream.segments.iter().map(|segment| segment.rows).collect();
    rows.sort_unstable();
    let half = rows.iter().sum::<u64>() / 2;
    let mut before = 0;
    let middle = rows.iter().find(|rows| {
        before += **rows;
        before > half
    });
    let usual = middle.copied().unwrap_or_default() as f64;
    let short = move |segment: &&HoldSegment| {
        segment.last_t_s() - segment.first_t_s() < LEAST_HOLD_S && (segment.rows as f64) < FEW_ROWS * usual
    };
    stream.segments.iter().filter(short)
}

fn remedy(recorder: &Recorder, message: String, line: u64) -> DataError {
    let file = &recorder.file;
    let help = format!(
        "`ibr data import {file} --out FOLDER` keeps the holds of a recording and leaves the ramps between them out; with --bin 2kPa it bins a ramp"
    );
    recorder.fault(message, &help, line)
}
