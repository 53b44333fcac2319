//! SLEAP analysis CSV: `track,frame_idx,instance.score,NODE.x,NODE.y,NODE.score,…`, a row for every track and frame.

use super::format::*;

pub(super) const FORMAT: Format = Format {
    name: "SLEAP",
    known_by: "columns frame_idx and NODE.x, NODE.y",
    fixture: "made/sleap.csv",
    likelihood: Some(SCORE),
    recognise: |begin| begin.has(&["frame_idx"]) && begin.any(|name| name.ends_with(".x")),
    read,
};

/// Peaks of a confidence map below this are what SLEAP itself discards at most.
const SCORE: f64 = 0.2;

fn read(sheet: &CellText, options: &ImportOptions) -> Result<Vec<Recording>> {
    let header = sheet.head(1).pop().unwrap_or_default();
    let column = |name: &str| header.iter().position(|known| *known == name);
    let mut layout = FrameColumns::new(1, column("frame_idx").unwrap_or_default(), None, Lengths::Pixels);
    layout.unlikely(options, SCORE, f64::INFINITY, "with a score below");
    layout.width = Some(header.len());
    layout.marker = column("track").filter(|track| has_several(sheet, *track));
    layout.twice = Some("several animals without track names: track the instances in SLEAP, or export one instance");
    let columns = header.iter().enumerate().filter_map(|(index, name)| {
        let (node, what) = name.rsplit_once('.').filter(|(node, _)| *node != "instance")?;
        Some((index, node, if what == "score" { LIKELIHOOD } else { part(what)? }))
    });
    layout.columns(sheet, columns)?;
    layout.read(sheet, 2, sheet.lines().skip(1))
}

/// Whether more than one track has a name.
fn has_several(sheet: &CellText, track: usize) -> bool {
    let names = sheet.lines().skip(1).filter_map(|(_, line)| sheet.split(line).get(track).copied());
    let mut names = names.filter(|name| !is_nothing(name));
    names.next().is_some_and(|first| names.any(|name| name != first))
}
