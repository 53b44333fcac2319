//! SLEAP analysis CSV: `track,frame_idx,instance.score,NODE.x,NODE.y,NODE.score,…`, a row for every track and frame.

use super::formats::Format;
use super::options::ImportOptions;
use super::recording::{FrameClock, Lengths, Pivot, Recording};
use super::sheet::CellText;
use crate::cells::is_nothing;
use crate::error::DataError;

pub(super) const FORMAT: Format = Format {
    name: "SLEAP",
    known_by: "columns frame_idx and NODE.x, NODE.y",
    likelihood: Some(SCORE),
    recognise: |_, head, _| {
        head.first().is_some_and(|row| row.contains(&"frame_idx") && row.iter().any(|name| name.ends_with(".x")))
    },
    read,
};

/// Peaks of a confidence map below this are what SLEAP itself discards at most.
const SCORE: f64 = 0.2;

fn read(sheet: &CellText, options: &ImportOptions) -> Result<Vec<Recording>, DataError> {
    let mut pivot = Pivot::new(Lengths::Pixels, FrameClock::Frames);
    let limit = options.likelihood.unwrap_or(SCORE);
    let mut lines = sheet.lines();
    let header = lines.next().map_or(Vec::new(), |(_, line)| sheet.split(line));
    let column = |name: &str| header.iter().position(|known| *known == name);
    let nodes: Vec<_> = header.iter().filter_map(|name| name.strip_suffix(".x")).collect();
    let nodes: Vec<_> = nodes
        .into_iter()
        .map(|node| (node, ["x", "y", "score"].map(|part| column(&format!("{node}.{part}")))))
        .collect();
    if let Some((node, _)) = nodes.iter().find(|(_, parts)| parts[1].is_none()) {
        let message = format!("there is a column {node}.x, and none {node}.y");
        return Err(sheet.fault(1, message, "export the analysis again as CSV"));
    }
    let (track, time) = (column("track"), column("frame_idx").unwrap_or_default());
    let several = several_tracks(sheet, track);
    let mut cells = Vec::new();
    for (number, line) in lines {
        sheet.split_into(line, &mut cells);
        sheet.whole_row(&cells, header.len(), number)?;
        let cell = |index: Option<usize>| index.and_then(|index| cells.get(index).copied()).unwrap_or_default();
        let frame = pivot.frame(sheet.time(cell(Some(time)), number, "frame_idx")?);
        for (node, [x, y, score]) in &nodes {
            let value = |index: &Option<usize>| sheet.expect(cell(*index), number, node);
            let place = [value(x)?, value(y)?, 0.0];
            let likelihood = value(score)?;
            let marker = if several { pivot.marker(&format!("{}_{node}", cell(track))) } else { pivot.marker(node) };
            let free = pivot.put(frame, marker, place, likelihood.is_nan() || likelihood >= limit);
            if !free {
                let message =
                    format!("{node} is there twice in frame {}: several animals without track names", cell(Some(time)));
                return Err(sheet.fault(number, message, "track the instances in SLEAP, or export one instance"));
            }
        }
    }
    pivot.recording.told.push(format!("positions with a score below {limit} are lost markers (--likelihood)"));
    Ok(vec![pivot.finish()])
}

/// Whether more than one track has a name.
fn several_tracks(sheet: &CellText, track: Option<usize>) -> bool {
    let Some(track) = track else { return false };
    let mut names = sheet
        .lines()
        .skip(1)
        .filter_map(|(_, line)| sheet.split(line).get(track).copied())
        .filter(|name| !is_nothing(name));
    names.next().is_some_and(|first| names.any(|name| name != first))
}
