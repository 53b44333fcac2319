use super::*;

/// A tube along x with rings at `xs`; `section` gives (y, z) of each node of a ring. Quads, or two triangles each.
fn tube(xs: &[f64], section: &[[f64; 2]], triangles: bool) -> Mesh {
    let n = section.len() as u32;
    let points = xs.iter().flat_map(|&x| section.iter().map(move |p| [x, p[0], p[1]])).collect();
    let mut part = Part { name: "tube".into(), ..Part::default() };
    for ring in 0..xs.len() as u32 - 1 {
        for k in 0..n {
            let next = (k + 1) % n;
            let [a, b, c, d] = [ring * n + k, (ring + 1) * n + k, (ring + 1) * n + next, ring * n + next];
            if triangles {
                part.triangles.extend([[a, b, c], [a, c, d]]);
            } else {
                part.quads.push([a, b, c, d]);
            }
        }
    }
    Mesh { points, parts: vec![part], ..Mesh::default() }
}

fn circle(n: usize, radius: f64) -> Vec<[f64; 2]> {
    let angle = |k: usize| std::f64::consts::TAU * k as f64 / n as f64;
    (0..n).map(|k| [radius * angle(k).cos(), radius * angle(k).sin()]).collect()
}

fn near(a: [f64; 3], b: [f64; 3], tolerance: f64) {
    assert!((0..3).all(|k| (a[k] - b[k]).abs() <= tolerance), "{a:?} is not {b:?}");
}

const X: [f64; 3] = [1.0, 0.0, 0.0];

#[test]
fn a_square_section_with_crowded_nodes_has_its_centre_in_the_middle() {
    // Five nodes on one side, none inside the others: the plain mean of the nodes would be off by a quarter side.
    let section = [[0., 0.], [0.01, 0.], [0.02, 0.], [0.03, 0.], [0.04, 0.], [0.04, 0.04], [0., 0.04]];
    for triangles in [false, true] {
        let mesh = tube(&[0.0, 0.1, 0.15, 0.4], &section, triangles);
        let stations = [0.0, 0.05, 0.1, 0.123, 0.15, 0.4];
        let line = CentreLine::new(&mesh, &[], X, &stations).unwrap();
        for (point, s) in line.at(&mesh.points).unwrap().into_iter().zip(stations) {
            near(point, [s, 0.02, 0.02], 1e-15);
        }
    }
}

#[test]
fn any_affine_motion_carries_the_centre_line_along() {
    let mesh = tube(&[0.0, 0.1, 0.2, 0.35], &circle(7, 0.04), true);
    let line = CentreLine::new(&mesh, &[], X, &[0.0, 0.07, 0.2, 0.31, 0.35]).unwrap();
    let matrix = [[0.3, -1.2, 0.5], [0.9, 0.1, -0.4], [0.2, 0.6, 1.1]];
    let moved = |p: &[f64; 3]| {
        [0, 1, 2].map(|k| matrix[k][0] * p[0] + matrix[k][1] * p[1] + matrix[k][2] * p[2] + [1.0, -2.0, 3.0][k])
    };
    let now = line.at(&mesh.points.iter().map(moved).collect::<Vec<_>>()).unwrap();
    for (point, start) in now.into_iter().zip(line.at(&mesh.points).unwrap()) {
        near(point, moved(&start), 1e-14);
    }
}

#[test]
fn a_tube_bent_to_an_arc_has_its_centre_line_on_the_arc() {
    let (curvature, radius): (f64, f64) = (2.5, 0.04);
    let xs: Vec<f64> = (0..=12).map(|i| 0.03 * i as f64).collect();
    let mesh = tube(&xs, &circle(16, radius), false);
    let bent = |p: &[f64; 3]| {
        let (angle, arm) = (curvature * p[0], 1.0 / curvature - p[1]);
        [arm * angle.sin(), 1.0 / curvature - arm * angle.cos(), p[2]]
    };
    let line = CentreLine::new(&mesh, &[], X, &xs).unwrap();
    for (point, s) in line.at(&mesh.points.iter().map(bent).collect::<Vec<_>>()).unwrap().into_iter().zip(&xs) {
        let angle = curvature * s;
        near(point, [angle.sin() / curvature, (1.0 - angle.cos()) / curvature, 0.0], 1e-15);
    }
}

#[test]
fn rounding_of_the_ring_positions_does_not_move_the_section() {
    let mut mesh = tube(&[0.0, 0.1, 0.2], &circle(8, 0.04), false);
    for (i, p) in mesh.points.iter_mut().enumerate() {
        p[0] += [0.0, 1e-17, -2e-17, 3e-16][i % 4];
    }
    let line = CentreLine::new(&mesh, &[], X, &[0.0, 0.1, 0.2]).unwrap();
    for (point, s) in line.at(&mesh.points).unwrap().into_iter().zip([0.0, 0.1, 0.2]) {
        near(point, [s, 0.0, 0.0], 1e-14);
    }
    assert_eq!(line.weights.iter().map(Vec::len).collect::<Vec<_>>(), [8, 8, 8]);
}

#[test]
fn only_the_parts_named_count_and_end_caps_in_the_plane_do_not() {
    let mut mesh = tube(&[0.0, 0.1, 0.2], &circle(8, 0.04), false);
    let first = mesh.points.len() as u32;
    mesh.points.extend([[0.0, 0.5, 0.0], [0.2, 0.5, 0.0], [0.2, 0.6, 0.0], [0.0, 0.6, 0.0]]);
    let quads = vec![[first, first + 1, first + 2, first + 3]];
    mesh.parts.push(Part { name: "pouch".into(), quads, ..Part::default() });
    mesh.parts[0].quads.push([16, 18, 20, 22]);
    let alone = CentreLine::new(&mesh, &["tube".into()], X, &[0.15, 0.2]).unwrap();
    near(alone.at(&mesh.points).unwrap()[0], [0.15, 0.0, 0.0], 1e-15);
    near(alone.at(&mesh.points).unwrap()[1], [0.2, 0.0, 0.0], 1e-15);
    assert!(CentreLine::new(&mesh, &[], X, &[0.15]).unwrap().at(&mesh.points).unwrap()[0][1] > 0.05);
}

#[test]
fn mistakes_are_told_with_what_to_write() {
    let mesh = tube(&[0.0, 0.1], &circle(8, 0.04), false);
    let say = |parts: &[String], axis, s: f64| CentreLine::new(&mesh, parts, axis, &[s]).unwrap_err().to_string();
    assert!(say(&["tub".into()], X, 0.0).contains("unknown part `tub`; the mesh has: tube"));
    assert!(say(&[], [0.0; 3], 0.0).contains("[1, 0, 0]"));
    for s in [-0.01, 0.101, f64::NAN] {
        assert!(say(&[], X, s).contains("reaches from 0 to 100 mm"), "{}", say(&[], X, s));
    }
    let line = even(&mesh, &[], X, 3).unwrap();
    assert_eq!(line.stations_m(), [0.0, 0.05, 0.1]);
    assert!(line.at(&mesh.points[1..]).is_err());
    assert!(even(&Mesh::default(), &[], X, 3).is_err());
}

#[test]
fn the_file_holds_every_station_and_resumes_to_the_same_bytes() {
    let folder = tempfile::tempdir().unwrap();
    let (whole, cut) = (folder.path().join("a.csv"), folder.path().join("b.csv"));
    let mesh = tube(&[0.0, 0.1, 0.2], &circle(8, 0.04), false);
    let line = even(&mesh, &[], X, 5).unwrap();
    let add = |file: &mut CentreLineFile, step: u64| {
        let moved: Vec<_> = mesh.points.iter().map(|p| [p[0], p[1] + step as f64 / 3.0, p[2]]).collect();
        file.append(step, step as f64 * 0.1, &moved).unwrap();
    };
    let mut file = CentreLineFile::open(&whole, line.clone(), &[]).unwrap();
    (0..6).for_each(|step| add(&mut file, step));
    let mut file = CentreLineFile::open(&cut, line.clone(), &[]).unwrap();
    (0..4).for_each(|step| add(&mut file, step));
    let mut file = CentreLineFile::open(&cut, line, &[0, 1, 2].map(|step| step as f64 * 0.1)).unwrap();
    (2..6).for_each(|step| add(&mut file, step));
    let text = std::fs::read_to_string(&whole).unwrap();
    assert_eq!(text, std::fs::read_to_string(&cut).unwrap());
    assert_eq!(text.lines().count(), 31);
    let row: Vec<f64> = text.lines().nth(8).unwrap().split(',').map(|cell| cell.parse().unwrap()).collect();
    assert_eq!(row[..3], [0.1, 1.0, 100.0]);
    near([row[3], row[4], row[5]], [100.0, 1000.0 / 3.0, 0.0], 1e-12);
}

#[test]
fn a_marker_is_on_the_side_that_the_eye_sees_and_goes_with_its_wall() {
    let mesh = tube(&[0.0, 0.1, 0.2, 0.35], &circle(64, 0.04), false);
    let (up, stations) = ([0.0, 0.0, 1.0], [0.0, 0.07, 0.2, 0.31, 0.35]);
    let line = CentreLine::seen(&mesh, &[], X, up, &stations).unwrap();
    for (point, s) in line.at(&mesh.points).unwrap().into_iter().zip(stations) {
        near(point, [s, 0.0, 0.04], 1e-9);
    }
    // A wall drawn in on the other side moves the centroid, and not the marker.
    let drawn: Vec<[f64; 3]> = mesh.points.iter().map(|p| [p[0], p[1], p[2].max(-0.02)]).collect();
    near(line.at(&drawn).unwrap()[2], [0.2, 0.0, 0.04], 1e-9);
    assert!(CentreLine::new(&mesh, &[], X, &stations).unwrap().at(&drawn).unwrap()[2][2] > 1e-3);
    // Between two nodes of a ring that stand on either side of the half plane.
    let turned = tube(&[0.0, 0.35], &[[0.04, 0.04], [-0.04, 0.04], [-0.04, -0.04], [0.04, -0.04]], true);
    near(
        CentreLine::seen(&turned, &[], X, up, &[0.1]).unwrap().at(&turned.points).unwrap()[0],
        [0.1, 0.0, 0.04],
        1e-12,
    );
    // The open half of a tube.
    let open = tube(&[0.0, 0.35], &circle(64, 0.04), false);
    let lower: Vec<[u32; 4]> =
        open.parts[0].quads.iter().copied().filter(|q| q.iter().all(|n| open.points[*n as usize][2] < 1e-9)).collect();
    let open = Mesh { parts: vec![Part { quads: lower, ..open.parts[0].clone() }], ..open };
    let refused = CentreLine::seen(&open, &[], X, up, &[0.1]).unwrap_err().to_string();
    assert!(refused.contains("no wall at 100 mm"), "{refused}");
}

/// `count` stations evenly from end to end of the parts.
fn even(mesh: &Mesh, parts: &[String], axis: [f64; 3], count: usize) -> Result<CentreLine, FemError> {
    let [low, high] = Sections::of(mesh, parts, axis)?.range;
    let share = |i: usize| if count == 1 { 0.5 } else { i as f64 / (count - 1) as f64 };
    let stations: Vec<f64> = (0..count).map(|i| low + (high - low) * share(i)).collect();
    CentreLine::new(mesh, parts, axis, &stations)
}
