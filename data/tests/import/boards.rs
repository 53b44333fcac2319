//! A checkerboard that a camera with a lens sees: the plane and the lens, and what remains in millimetres.

use super::{known, refused_paths, rows, told};
use data::import::{FilePlace, ImportOptions, Imported, Scale, import};
use std::fmt::Write as _;

/// A pinhole askew to the plane \[m\], and a lens that pulls the corners in: p + (p − c)(−0.18 r² + 0.03 r⁴), r in 640 px (OpenCV's k1, k2).
fn picture(k1: f64, u: f64, v: f64) -> [f64; 2] {
    let depth = 1.0 + 0.35 * u - 0.2 * v;
    let [x, y] = [(190.0 + 2300.0 * u + 90.0 * v) / depth, (600.0 - 60.0 * u - 2250.0 * v) / depth];
    let [dx, dy] = [(x - 650.0) / 640.0, (y - 350.0) / 640.0];
    let square = dx * dx + dy * dy;
    let by = 1.0 + k1 * square - k1 / 6.0 * square * square;
    [650.0 + 640.0 * dx * by, 350.0 + 640.0 * dy * by]
}

/// The reference's first run through such a camera, with a board of squares of 25 mm whose corners are read to `noise_px`.
fn filmed(k1: f64, noise_px: f64, columns: u32) -> Result<Imported, data::DataError> {
    let mut text = String::from("frame,a_x,a_y,b_x,b_y,c_x,c_y\n");
    let reference = super::reference();
    let mut frames = std::collections::BTreeMap::new();
    for ((run, time, _), cells) in reference.iter().filter(|(key, _)| key.0 == "1") {
        let [x, y] = [7, 8].map(|k| cells[k].parse::<f64>().unwrap_or(f64::NAN) * 1e-3);
        let [px, py] = picture(k1, x, y);
        let frame = (time.parse::<f64>().unwrap() * 30.0).round() as u32;
        assert_eq!(run, "1");
        let _ = write!(frames.entry(frame).or_insert_with(String::new), ",{px:.3},{py:.3}");
    }
    frames.into_iter().for_each(|(frame, cells)| text.push_str(&format!("{frame}{cells}\n")));
    let folder = tempfile::tempdir().unwrap();
    let tracks = folder.path().join("run1.csv");
    std::fs::write(&tracks, text).unwrap();
    let mut board = Vec::new();
    for (i, j) in (0..columns).flat_map(|i| (0..10).map(move |j| (i, j))) {
        let [x, y] = picture(k1, 0.025 * f64::from(i) - 0.05, 0.025 * f64::from(j) - 0.03);
        let noise = |k: u32| noise_px * (f64::from(k) * 12.9898).sin() * 1.4;
        board.push([f64::from(i), f64::from(j), x + noise(31 * i + j), y + noise(17 * j + 5 * i + 3)]);
    }
    let base = picture(k1, 0.0, 0.0);
    let scale = Scale::Board(board, 0.025);
    let options = ImportOptions {
        scale,
        base: Some(FilePlace::At(base.to_vec())),
        frames_per_s: Some(30.0),
        ..known("cases/c01-deeplabcut/pressure.csv")
    };
    import(&[tracks], &options, &mut |_, _| ())
}

/// Largest distance from the reference \[mm\].
fn off_mm(made: &Imported) -> f64 {
    let reference = super::reference();
    let found = rows(&made.markers_csv);
    assert_eq!(found.len(), 45);
    let off = |((_, time, marker), cells): (&(String, String, String), &Vec<String>)| {
        let right = &reference[&("1".to_string(), time.clone(), marker.clone())];
        let [x, y] = [7, 8].map(|k| cells[k].parse::<f64>().unwrap() - right[k].parse::<f64>().unwrap());
        x.hypot(y)
    };
    found.iter().map(off).fold(0.0, f64::max)
}

#[test]
fn a_board_gives_plane_and_lens_and_what_remains_in_millimetres() {
    for k1 in [-0.18, -0.06, 0.1] {
        for noise_px in [0.0, 0.2] {
            let made = filmed(k1, noise_px, 18).unwrap();
            let off = off_mm(&made);
            println!("k1 {k1}, corners to {noise_px} px: markers to {off:.3} mm; {}", made.told.join("; "));
            told(&made, &["a homography of 180 corners and a lens (k1", "what remains is", "mm at most"]);
            assert!(off < 0.15 + noise_px, "{off} mm");
        }
    }
    let straight = filmed(0.0, 0.2, 18).unwrap();
    told(&straight, &["a homography of 180 corners; what remains is 0.2"]);
    assert!(off_mm(&straight) < 0.3);
}

#[test]
fn positions_outside_of_the_board_are_reported_and_refused_where_the_lens_is_not_known() {
    let narrow = filmed(-0.06, 0.0, 10);
    told(&narrow.unwrap(), &["warning: ", "% of the positions are outside of the board", "film a board that fills"]);
    let options = ImportOptions {
        scale: Scale::Board(data::import::read_board(&super::case("made/board.csv")).unwrap(), 0.0),
        ..super::pixels("cases/c01-deeplabcut/pressure.csv")
    };
    refused_paths(&[super::case("made/askew.csv")], &options, &["plane"]);
}

#[test]
fn a_corner_at_two_places_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("board.csv");
    let board = |more: &str| {
        let text = format!("column,row,x,y\n0,0,100,100\n1,0,200,100\n0,1,100,200\n1,1,200,200\n{more}");
        std::fs::write(&path, text).unwrap();
        data::import::read_board(&path)
    };
    assert_eq!(board("1,1,201,200\n").unwrap().len(), 5);
    let error = board("1,1,300,200\n").unwrap_err().to_string();
    assert!(
        error.contains("board.csv:6: corner 1,1 is at 300.0, 200.0 px here and at 200.0, 200.0 px above"),
        "{error}"
    );
}
