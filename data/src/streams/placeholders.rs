//! Positions that stand for none: a tracking program writes them where a marker was not seen.
//!
//! Some are known by their numbers (`rows::PLACEHOLDERS`). Any other is known by two markers that were seen there to the last digit,
//! far from where both were else: no camera sees two markers at one place.

use super::segments::{HoldSegment, Stream};
use crate::policy;
use crate::units::mm;

type PlaceBits = [u64; 3];

/// Rows that were taken as not seen, and the line of the first, by their position in words.
#[derive(Debug, Default)]
pub(crate) struct Placeholders(Vec<(String, u64, u64)>);

impl Placeholders {
    /// Counts rows that have the position in words.
    pub(crate) fn note(&mut self, words: &str, rows: u64, line: u64) {
        match self.0.iter_mut().find(|(known, ..)| known == words) {
            Some((_, count, first)) => (*count, *first) = (*count + rows, line.min(*first)),
            None => self.0.push((words.into(), rows, line)),
        }
    }

    pub(crate) fn rows(&self) -> u64 {
        self.0.iter().map(|(_, rows, _)| rows).sum()
    }

    pub(crate) fn told(&self) -> Vec<String> {
        let told = |(words, rows, line): &(String, u64, u64)| {
            format!(
                "{rows} rows have a marker at exactly {words}, first in line {line}: taken as not seen (a marker at the base \
                 needs its station there in about.toml)"
            )
        };
        self.0.iter().map(told).collect()
    }

    /// Takes out what two markers share to the last digit, far from where both are else.
    pub(crate) fn take_out_shared(&mut self, streams: &mut [Stream]) {
        for place in shared(streams) {
            let [x_mm, y_mm, z_mm] = place.map(|bits| mm(f64::from_bits(bits)));
            let words = if z_mm == 0.0 { format!("{x_mm}, {y_mm} mm") } else { format!("{x_mm}, {y_mm}, {z_mm} mm") };
            for segment in streams.iter_mut().flat_map(|stream| &mut stream.segments) {
                let rows = segment.take_out(|sample| is_at(sample.place(), place));
                if rows > 0 {
                    self.note(&words, rows, segment.first_line);
                }
            }
        }
        streams.iter_mut().for_each(|stream| stream.segments.retain(|segment| !segment.samples.is_empty()));
    }
}

fn is_at(place: [f64; 3], other: PlaceBits) -> bool {
    place.map(f64::to_bits) == other
}

/// Places that stood still in the streams of two markers or more, and are far from all others of each.
fn shared(streams: &[Stream]) -> Vec<PlaceBits> {
    let mut still: Vec<(PlaceBits, usize)> = Vec::new();
    for stream in streams {
        still.extend(stream.segments.iter().flat_map(stood_still).map(|place| (place, stream.marker)));
    }
    still.sort_unstable();
    still.dedup();
    let of_one_place = still.chunk_by(|a, b| a.0 == b.0).filter(|markers| markers.len() > 1);
    let far = |markers: &&[(PlaceBits, usize)]| markers.iter().all(|(place, marker)| is_far(streams, *marker, *place));
    of_one_place.filter(far).map(|markers| markers[0].0).collect()
}

/// Places of which a segment has two samples in a row, or its only one.
fn stood_still(segment: &HoldSegment) -> Vec<PlaceBits> {
    let places: Vec<PlaceBits> = segment.samples.iter().map(|sample| sample.place().map(f64::to_bits)).collect();
    match places[..] {
        [only] => vec![only],
        _ => places.windows(2).filter(|pair| pair[0] == pair[1]).map(|pair| pair[0]).collect(),
    }
}

/// Whether a marker was nowhere near a place but at it.
fn is_far(streams: &[Stream], marker: usize, place: PlaceBits) -> bool {
    let [x, y, z] = place.map(f64::from_bits);
    let own = streams.iter().filter(|stream| stream.marker == marker).flat_map(|stream| &stream.segments);
    let others = own.flat_map(|segment| &segment.samples).map(|sample| sample.place()).filter(|p| !is_at(*p, place));
    others.map(|p| (p[0] - x).hypot(p[1] - y).hypot(p[2] - z)).all(policy::is_elsewhere)
}
