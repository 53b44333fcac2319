//! Files that were cut or changed: an error or a table, never a panic.

use super::{case, pixels};
use data::import::{ImportOptions, Offset, Scale, import};

const FILES: [&str; 15] = [
    "cases/c01-deeplabcut/run1.csv",
    "cases/c02-motive/vine_1.csv",
    "cases/c04-kinovea/run1_kinematics.csv",
    "cases/c04-kinovea/run1_trajectories.txt",
    "cases/c07-table-dialects/wide.csv",
    "made/deeplabcut_multi.csv",
    "made/sleap.csv",
    "made/motive_mm.csv",
    "made/tracker_multi.txt",
    "made/tracker_one.txt",
    "made/trackmate_spots.csv",
    "made/trackmate_tracks.xml",
    "made/trackmate_model.xml",
    "made/wide_pixels.csv",
    "made/kinovea_seconds.csv",
];

/// What each file would need, so that damage is met as late as possible.
fn options() -> [ImportOptions; 3] {
    let log = "cases/c01-deeplabcut/pressure.csv";
    let free = ImportOptions { base: None, frames_per_s: None, ..pixels(log) };
    [
        pixels(log),
        ImportOptions { scale: Scale::OfFile, ..free.clone() },
        ImportOptions { scale: Scale::Unit(1.0), bin_pa: Some(2e3), offset: Offset::Find, least_frames: 1, ..free },
    ]
}

/// Reads a damaged file in all ways; counts those that gave a table.
fn read(folder: &tempfile::TempDir, bytes: &[u8]) -> usize {
    let path = folder.path().join("damaged.csv");
    std::fs::write(&path, bytes).unwrap();
    options().iter().filter(|options| import(std::slice::from_ref(&path), options, &mut |_, _| ()).is_ok()).count()
}

#[test]
fn a_file_cut_anywhere_is_no_panic() {
    let folder = tempfile::tempdir().unwrap();
    let mut tables = 0;
    for file in FILES {
        let bytes = std::fs::read(case(file)).unwrap();
        let step = (bytes.len() / 20).max(1);
        tables += (0..bytes.len()).step_by(step).map(|end| read(&folder, &bytes[..end])).sum::<usize>();
    }
    assert!(tables > 40, "most of a file is a table too: {tables}");
}

#[test]
fn a_file_with_changed_signs_is_no_panic() {
    let folder = tempfile::tempdir().unwrap();
    let signs: [&[u8]; 12] = [b"", b",", b";", b"\t", b"\n", b"\"", b"-", b"1e308", b"nan", b"\xc3", b"<", b"0"];
    let mut seed = 1_u64;
    let mut next = |most: usize| {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (seed >> 33) as usize % most
    };
    for file in FILES {
        let bytes = std::fs::read(case(file)).unwrap();
        for _ in 0..15 {
            let mut damaged = bytes.clone();
            for _ in 0..3 {
                let at = next(damaged.len());
                damaged.splice(at..at + 1, signs[next(signs.len())].iter().copied());
            }
            read(&folder, &damaged);
        }
    }
}
