//! The programs whose files are understood, the most particular first.

use super::format::{Beginning, CellText, Format, ImportOptions, Result};
use super::{deeplabcut, kinovea, motive, qualisys, ros, sleap, tables, tracker, trackmate, triples};

/// Kinds of tracking files, in the order in which they are tried.
pub const FORMATS: [&Format; 16] = [
    &deeplabcut::FORMAT,
    &sleap::FORMAT,
    &motive::FORMAT,
    &triples::VICON,
    &triples::TRC,
    &qualisys::FORMAT,
    &tracker::FORMAT,
    &kinovea::TRAJECTORIES,
    &tables::KINEMATICS,
    &trackmate::XML,
    &trackmate::SPOTS,
    &ros::FORMAT,
    &tables::ANIPOSE,
    &tables::TRACKPY,
    &tables::LONG,
    &tables::WIDE,
];

/// Kinds of pressure logs, each with a small file below `data/tests`; the first is a plain table.
pub const LOGS: [(&str, &str); 4] = [
    ("a pressure log", "cases/c01-deeplabcut/pressure.csv"),
    ("LabVIEW text", "cases/c26-pressure-loggers/labview.lvm"),
    ("a serial monitor", "cases/c26-pressure-loggers/arduino_serial.txt"),
    ("a log without names", "cases/c26-pressure-loggers/arduino_noheader.csv"),
];

const LOOKED_AT: usize = 8;

pub(crate) fn recognised(sheet: &CellText, options: &ImportOptions) -> Result<&'static Format> {
    let beginning = Beginning { sheet, head: sheet.head(LOOKED_AT), options };
    let found = FORMATS.into_iter().find(|format| (format.recognise)(&beginning));
    found.ok_or_else(|| {
        let first = sheet.lines().next();
        let shown: String = first.map_or(String::new(), |(_, line)| line.chars().take(80).collect());
        let kinds: Vec<String> = FORMATS.iter().map(|f| format!("{} ({})", f.name, f.known_by)).collect();
        let help = format!(
            "understood are {}. For a table with other names of columns say which is which: --map t=Time,marker=Point,x=PosX,y=PosY",
            kinds.join("; ")
        );
        let message = format!("no program is known that writes such a file; it begins with \"{shown}\"");
        sheet.fault(1, message, help)
    })
}
