//! TrackMate: the table of spots, the XML of tracks ("Export tracks to XML"), and the XML that it saves itself.

use std::collections::HashMap;

use super::format::*;

pub(super) const SPOTS: Format = Format {
    name: "TrackMate, spots",
    known_by: "columns TRACK_ID and POSITION_X",
    fixture: "made/trackmate_spots.csv",
    likelihood: None,
    recognise: |begin| begin.has(&["TRACK_ID", "POSITION_X"]),
    read: spots,
};

pub(super) const XML: Format = Format {
    name: "TrackMate, XML",
    known_by: "a <TrackMate> or <Tracks> element",
    fixture: "made/trackmate_tracks.xml",
    likelihood: None,
    recognise: |begin| tags(begin.sheet.text).take(4).any(|tag| matches!(tag.name, "TrackMate" | "Tracks")),
    read: xml,
};

/// Where a spot has its place.
const PLACES: [&str; 3] = ["POSITION_X", "POSITION_Y", "POSITION_Z"];

fn spots<'s>(sheet: &CellText<'s>, _options: &ImportOptions) -> Result<Vec<Recording>> {
    let header = sheet.head(1).pop().unwrap_or_default();
    let column = |name: &str| header.iter().position(|known| *known == name);
    let [track, t, frame] = ["TRACK_ID", "POSITION_T", "FRAME"].map(column);
    let places = PLACES.map(column);
    let [x, ..] = places;
    // Up to three more rows of names and units.
    let cell = |line: &'s str, index: Option<usize>| index.and_then(|index| sheet.split(line).get(index).copied());
    let is_head = |line: &&'s str| sheet.number(cell(line, x).unwrap_or_default()).is_none();
    let heads: Vec<&str> = sheet.lines().skip(1).map(|(_, line)| line).take_while(is_head).collect();
    let unit_in = |line: &'s str, index| ColumnName::of(&format!("x {}", cell(line, index).unwrap_or_default())).unit;
    let unit = |index| heads.iter().rev().find_map(|line| unit_in(line, index));
    let second = unit(t).filter(|unit| !is_frame(unit)).and_then(|unit| si(&unit, MeasuredQuantity::Time));
    let time = if second.is_some() { t } else { frame.or(t) };
    let lengths = unit(x).and_then(|unit| lengths(&unit)).unwrap_or(Lengths::Pixels);
    let mut layout = FrameColumns::new(1, time.unwrap_or_default(), second, lengths);
    (layout.marker, layout.named, layout.row_of) = (track, false, ["spot", "track"]);
    let places = places.into_iter().enumerate().filter_map(|(part, index)| Some((index?, "", part)));
    layout.columns(sheet, places)?;
    layout.read(sheet, 2, sheet.lines().skip(1 + heads.len()))
}

/// One XML element as far as it is needed here.
struct Tag<'a> {
    name: &'a str,
    attributes: &'a str,
}

impl<'a> Tag<'a> {
    fn get(&self, key: &str) -> Option<&'a str> {
        let mut rest = self.attributes;
        while let Some((before, after)) = rest.split_once('=') {
            let after = after.trim_start();
            let quote = after.chars().next().filter(|c| matches!(c, '"' | '\''))?;
            let (value, tail) = after[1..].split_once(quote)?;
            if before.trim() == key {
                return Some(value);
            }
            rest = tail;
        }
        None
    }

    fn number(&self, key: &str) -> Option<f64> {
        self.get(key)?.parse().ok()
    }
}

fn tags(text: &str) -> impl Iterator<Item = Tag<'_>> {
    text.split('<').skip(1).filter_map(|part| {
        let inside = part.split('>').next()?.trim_end_matches('/');
        let space = inside.find(|c: char| c.is_ascii_whitespace()).unwrap_or(inside.len());
        let (name, attributes) = inside.split_at(space);
        let is_tag = name.starts_with(|c: char| c.is_ascii_alphabetic());
        is_tag.then_some(Tag { name, attributes })
    })
}

fn xml(sheet: &CellText, _options: &ImportOptions) -> Result<Vec<Recording>> {
    let said = |keys: [&str; 2]| {
        let of = |key: &str| tags(sheet.text).take(8).find_map(|tag| tag.get(key));
        of(keys[0]).or_else(|| of(keys[1])).map(str::to_lowercase)
    };
    let unit = said(["spaceUnits", "spatialunits"]).and_then(|unit| lengths(&unit));
    let time = said(["timeUnits", "timeunits"]).unwrap_or_default();
    let second = si(&time, MeasuredQuantity::Time).filter(|_| !is_frame(&time));
    let mut pivot = Pivot::new(unit.unwrap_or(Lengths::Pixels), second.is_some());
    let exported = tags(sheet.text).any(|tag| tag.name == "particle");
    let read = if exported { detections } else { model };
    let single = read(sheet, second, &mut pivot)?;
    if single > 0 {
        let spots = counted(single, "spot");
        pivot.recording.told.push(format!("left out: {spots} of no track"));
    }
    pivot.recording.named = false;
    Ok(vec![pivot.finish()])
}

/// `<particle>` with `<detection t x y z>`; t counts frames of `frameInterval`.
fn detections(sheet: &CellText, second: Option<f64>, pivot: &mut Pivot) -> Result<u64> {
    let interval = tags(sheet.text).find_map(|tag| tag.number("frameInterval")).unwrap_or(1.0);
    let step = second.map_or(1.0, |second| second * interval);
    let mut track = 0;
    for tag in tags(sheet.text) {
        match tag.name {
            "particle" => track += 1,
            "detection" if track == 0 => {
                let help = "save the tracks again in TrackMate";
                return Err(sheet.fault(0, "a <detection> precedes the first <particle>", help));
            }
            "detection" => {
                let time = tag.number("t").map(|t| t * step);
                let what = || format!("a detection of track {track}");
                let place = ["x", "y", "z"].map(|axis| tag.number(axis));
                put(sheet, pivot, (time, &track.to_string()), place, what)?;
            }
            _ => {}
        }
    }
    Ok(0)
}

/// `<Spot>` elements, joined to tracks by the `<Edge>` elements of every `<Track>`; returns how many have none.
fn model(sheet: &CellText, second: Option<f64>, pivot: &mut Pivot) -> Result<u64> {
    let mut track_of: HashMap<&str, String> = HashMap::new();
    let (mut track, mut count) = (String::new(), 0);
    for tag in tags(sheet.text) {
        match tag.name {
            "Track" => {
                count += 1;
                track = tag.get("name").map_or(count.to_string(), str::to_string);
            }
            "Edge" => {
                let ends = ["SPOT_SOURCE_ID", "SPOT_TARGET_ID"].map(|key| tag.get(key));
                track_of.extend(ends.into_iter().flatten().map(|spot| (spot, track.clone())));
            }
            _ => {}
        }
    }
    let mut single = 0;
    for tag in tags(sheet.text).filter(|tag| tag.name == "Spot") {
        let Some(track) = tag.get("ID").and_then(|id| track_of.get(id)) else {
            single += 1;
            continue;
        };
        let time = match second {
            Some(second) => tag.number("POSITION_T").map(|t| t * second),
            None => tag.number("FRAME"),
        };
        let place = PLACES.map(|axis| tag.number(axis));
        let what = || format!("spot {}", tag.get("ID").unwrap_or_default());
        put(sheet, pivot, (time, track), place, what)?;
    }
    Ok(single)
}

fn put(
    sheet: &CellText,
    pivot: &mut Pivot,
    (time, track): (Option<f64>, &str),
    [x, y, z]: [Option<f64>; 3],
    what: impl Fn() -> String,
) -> Result<()> {
    let (Some(time), Some(x), Some(y)) = (time, x, y) else {
        let message = format!("{} lacks its time or place as a number", what());
        return Err(sheet.fault(0, message, "save the tracks again in TrackMate"));
    };
    let (frame, marker) = (pivot.frame(time), pivot.marker(track));
    pivot.put(frame, marker, [x, y, z.unwrap_or(0.0)], true);
    Ok(())
}
