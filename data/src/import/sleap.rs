//! SLEAP analysis CSV: `track,frame_idx,instance.score,NODE.x,NODE.y,NODE.score,…`, a row for every track and frame.

use super::format::Format;
use super::layout::Layout;
use super::options::ImportOptions;
use super::recording::{Lengths, Recording};
use super::sheet::CellText;
use crate::cells::is_nothing;
use crate::error::Result;

pub(super) const FORMAT: Format = Format {
    name: "SLEAP",
    known_by: "columns frame_idx and NODE.x, NODE.y",
    fixture: "made/sleap.csv",
    likelihood: Some(SCORE),
    recognise: |_, head, _| {
        head.first().is_some_and(|row| row.contains(&"frame_idx") && row.iter().any(|name| name.ends_with(".x")))
    },
    read,
};

/// Peaks of a confidence map below this are what SLEAP itself discards at most.
const SCORE: f64 = 0.2;

fn read(sheet: &CellText, options: &ImportOptions) -> Result<Vec<Recording>> {
    let header = sheet.head(1).pop().unwrap_or_default();
    let column = |name: &str| header.iter().position(|known| *known == name);
    let limit = options.likelihood.unwrap_or(SCORE);
    let mut layout = Layout::new(column("frame_idx").unwrap_or_default(), None, Lengths::Pixels);
    layout.likely = [limit, f64::INFINITY];
    layout.width = Some(header.len());
    layout.marker = column("track").filter(|track| has_several(sheet, *track));
    layout.twice = Some("several animals without track names: track the instances in SLEAP, or export one instance");
    layout.told.push(format!("positions with a score below {limit} are lost markers (--likelihood)"));
    for (index, name) in header.iter().enumerate() {
        let Some((node, what)) = name.rsplit_once('.').filter(|(node, _)| *node != "instance") else { continue };
        let part = ["x", "y", "z", "score"].iter().position(|known| *known == what);
        part.map_or(Ok(()), |part| layout.add(sheet, 1, node, part, index))?;
    }
    layout.read(sheet, 1, 2, sheet.lines().skip(1))
}

/// Whether more than one track has a name.
fn has_several(sheet: &CellText, track: usize) -> bool {
    let names = sheet.lines().skip(1).filter_map(|(_, line)| sheet.split(line).get(track).copied());
    let mut names = names.filter(|name| !is_nothing(name));
    names.next().is_some_and(|first| names.any(|name| name != first))
}
