use std::f64::consts::{FRAC_PI_4, PI, TAU};

use super::*;
use crate::mesh::check::{check, check_open};
use crate::mesh::{Mesh, Part};
use crate::vec3::{area, cross, dot, norm, scale, sub};

/// Area vector of element `i` in the stress-free shape.
fn area_vector(mesh: &Mesh, part: &Part, i: usize) -> [f64; 3] {
    area(&part.nodes(i).iter().map(|n| mesh.points[*n as usize]).collect::<Vec<_>>())
}

fn part_area(mesh: &Mesh, name: &str) -> f64 {
    let part = mesh.parts.iter().find(|p| p.name == name).unwrap();
    (0..part.len()).map(|i| norm(area_vector(mesh, part, i))).sum()
}

/// Equal to rounding of sums over the elements.
fn assert_close(found: f64, exact: f64) {
    assert!((found / exact - 1.0).abs() < 1e-12, "{found} is not {exact}");
}

fn standard_tube(around: Around, caps: [Cap; 2]) -> Tube {
    Tube { radius_m: 0.04, length_m: 0.36, around, along: 30, caps, warp_rad: 0.0 }
}

/// A quarter of the turn twice as fine as the rest.
fn graded() -> Vec<f64> {
    (0..24).map(|i| f64::from(i) * PI / 48.0).chain((0..36).map(|i| PI / 2.0 + f64::from(i) * PI / 24.0)).collect()
}

#[test]
fn twenty_million_nodes_are_made_and_not_one_row_more() {
    assert!(few_enough("plate", 999, 19_999).is_ok() && few_enough("plate", 999, 20_000).is_err());
}

#[test]
fn every_generator_makes_a_mesh_that_passes_the_check() {
    for (mesh, chambers, open) in [
        (plate(0.2, 0.1, 5, 4, Some(Distortion { share: 0.24, seed: 3 })), vec![], vec![]),
        (crossed_sheets(0.1, 0.02, 4, 1e-3), vec![], vec![]),
        (pillow(0.8485, 16, 0.0), vec!["air"], vec![]),
        (pillow(0.8485, 16, 1e-3), vec!["air"], vec![]),
        (disc_balloon(0.5, 2), vec!["air"], vec![]),
        (disc_balloon(0.5, 8), vec!["air"], vec![]),
        (long_pouch(0.06, 0.01, 30, 4, 0.0), vec!["air"], vec!["open_0", "open_1"]),
        (long_pouch(0.06, 0.01, 30, 4, 1e-4), vec!["air"], vec!["open_0", "open_1"]),
        (flat_tube(0.06, 0.3, 12, 60, FRAC_PI_4, 1e-4), vec!["air"], vec![]),
        (sphere(0.1, 1), vec!["air"], vec![]),
        (sphere(0.1, 7), vec!["air"], vec![]),
        (tube(&standard_tube(Around::Even(48), [Cap::Quads, Cap::Triangles])), vec!["body"], vec![]),
        (tube(&standard_tube(Around::Even(20), [Cap::Triangles, Cap::Quads])), vec!["body"], vec![]),
        (tube(&standard_tube(Around::Even(31), [Cap::Triangles; 2])), vec!["body"], vec![]),
        (tube(&standard_tube(Around::Angles(graded()), [Cap::Triangles; 2])), vec!["body"], vec![]),
        (tube(&standard_tube(Around::Even(48), [Cap::Open, Cap::Triangles])), vec!["body"], vec!["base"]),
        (tube(&standard_tube(Around::Even(48), [Cap::Open; 2])), vec!["body"], vec!["base", "tip"]),
    ] {
        check_open(&mesh.unwrap(), &chambers, &open).unwrap();
    }
}

#[test]
fn a_plate_has_its_area_and_its_named_nodes_even_when_distorted() {
    let flat = plate(0.3, 0.2, 6, 4, None).unwrap();
    let bent = plate(0.3, 0.2, 6, 4, Some(Distortion { share: 0.2, seed: 7 })).unwrap();
    assert_close(part_area(&bent, "plate"), 0.06);
    assert_ne!(flat.points, bent.points);
    for (name, nodes) in &flat.sets {
        assert!(name == "centre" || nodes.iter().all(|n| bent.points[*n as usize] == flat.points[*n as usize]));
    }
    assert_eq!(flat.points[flat.sets["centre"][0] as usize], [0.15, 0.1, 0.0]);
    assert!(flat.sets["right"].iter().all(|n| (flat.points[*n as usize][0] - 0.3).abs() < 1e-15));
    assert_eq!((flat.sets["left"].len(), flat.sets["top"].len(), flat.sets["corners"].len()), (5, 7, 4));
    assert!(area_vector(&flat, &flat.parts[0], 0)[2] > 0.0);
}

#[test]
fn two_layers_have_twice_the_area_and_fronts_outward() {
    let mesh = pillow(0.8, 8, 0.02).unwrap();
    assert_close(part_area(&mesh, "top") + part_area(&mesh, "bottom"), 2.0 * 0.64);
    assert_eq!(mesh.points.len(), 2 * 81 - 32);
    assert!(area_vector(&mesh, &mesh.parts[0], 0)[2] > 0.0 && area_vector(&mesh, &mesh.parts[1], 0)[2] < 0.0);
    assert_eq!((mesh.parts[0].layer, mesh.parts[1].layer), (0, 1));
    let start = |set: &str| mesh.start[mesh.sets[set][0] as usize];
    assert_eq!((start("centre_top"), start("centre_bottom")), ([0.0, 0.0, 0.01], [0.0, 0.0, -0.01]));
    let middles: Vec<_> = mesh.sets["mid_edges"].iter().map(|n| mesh.points[*n as usize]).collect();
    assert_eq!(middles, [[0.0, -0.4, 0.0], [0.4, 0.0, 0.0], [0.0, 0.4, 0.0], [-0.4, 0.0, 0.0]]);
}

#[test]
fn the_volume_of_a_long_pouch_per_width_is_that_of_its_section() {
    let (length, width, gap, n) = (0.06, 0.01, 1e-3, 30);
    let mesh = long_pouch(length, width, n, 2, gap).unwrap();
    let quality = check_open(&mesh, &["air"], &["open_0", "open_1"]).unwrap();
    // The section is a hexagon: full height over n − 2 elements, half on average over the two at the welds.
    assert_close(quality.volumes_m3[0].1 / width, gap * length * (n - 1) as f64 / n as f64);
    let error = check(&mesh, &["air"]).unwrap_err().to_string();
    assert!(
        error.contains("chamber `air` is open: the edge between nodes") && error.contains("(120 such edges)"),
        "{error}"
    );
}

#[test]
fn a_disc_balloon_has_the_area_of_its_polygon_and_well_shaped_quads() {
    for n in [4, 8, 16, 32] {
        let mesh = disc_balloon(0.5, n).unwrap();
        let sides = 4.0 * n as f64;
        assert_close(part_area(&mesh, "top"), 0.5 * sides * 0.25 * (TAU / sides).sin());
        assert_close(part_area(&mesh, "bottom"), 0.5 * sides * 0.25 * (TAU / sides).sin());
        assert_eq!(mesh.sets["rim"].len(), 4 * n);
        assert!(mesh.sets["rim"].iter().all(|r| (norm(mesh.points[*r as usize]) - 0.5).abs() < 1e-15));
        assert_eq!(norm(mesh.points[mesh.sets["centre_top"][0] as usize]), 0.0);
        let quality = check(&mesh, &["air"]).unwrap();
        assert!(quality.aspect < 3.0 && quality.jacobian_ratio > if n < 8 { 0.35 } else { 0.5 }, "{n}: {quality:?}");
    }
}

#[test]
fn a_capped_tube_has_the_area_and_volume_of_its_prism() {
    for (around, gaps) in [
        (Around::Even(48), vec![TAU / 48.0; 48]),
        (Around::Angles(graded()), [vec![PI / 48.0; 24], vec![PI / 24.0; 36]].concat()),
    ] {
        let quads = if gaps[0] == gaps[gaps.len() - 1] { Cap::Quads } else { Cap::Triangles };
        let mesh = tube(&standard_tube(around, [Cap::Triangles, quads])).unwrap();
        let section: f64 = gaps.iter().map(|g| 0.5 * 0.04 * 0.04 * g.sin()).sum();
        let round: f64 = gaps.iter().map(|g| 2.0 * 0.04 * (0.5 * g).sin()).sum();
        assert_close(part_area(&mesh, "wall"), round * 0.36);
        assert_close(part_area(&mesh, "base_cap"), section);
        assert_close(part_area(&mesh, "tip_cap"), section);
        assert_close(check(&mesh, &["body"]).unwrap().volumes_m3[0].1, section * 0.36);
    }
}

#[test]
fn an_open_tube_counts_the_volume_up_to_its_ends() {
    let mesh = tube(&standard_tube(Around::Even(48), [Cap::Open; 2])).unwrap();
    let quality = check_open(&mesh, &["body"], &["base", "tip"]).unwrap();
    assert_close(quality.volumes_m3[0].1, 24.0 * 0.04 * 0.04 * (TAU / 48.0).sin() * 0.36);
}

/// Stable step times wave speed of an element of N nodes: 2/ω with ω² = N c² λmax(Σ Bₙ Bₙᵀ), Bₙ the gradients of the shape
/// functions at its centre.
fn stable_length(corners: &[[f64; 3]]) -> f64 {
    let normal = area(corners);
    let twice = 2.0 * norm(normal);
    let gradient = |k: usize| {
        let opposite = sub(corners[(k + corners.len() - 1) % corners.len()], corners[(k + 1) % corners.len()]);
        scale(cross(normal, opposite), 2.0 / (twice * twice))
    };
    let axis = sub(corners[1], corners[0]);
    let axis = scale(axis, 1.0 / norm(axis));
    let across = cross(scale(normal, 2.0 / twice), axis);
    let (mut xx, mut xy, mut yy) = (0.0, 0.0, 0.0);
    for b in (0..3).map(gradient) {
        let (x, y) = (dot(b, axis), dot(b, across));
        (xx, xy, yy) = (xx + x * x, xy + x * y, yy + y * y);
    }
    let largest = 0.5 * (xx + yy) + (0.25 * (xx - yy) * (xx - yy) + xy * xy).sqrt();
    2.0 / (corners.len() as f64 * largest).sqrt()
}

#[test]
fn the_stable_step_of_known_elements_is_exact() {
    // Equilateral, side 1: Σ B Bᵀ = 2; right angle, legs 1: λmax = 3; unit square: 1.
    let third = 0.75f64.sqrt();
    assert_close(stable_length(&[[0.0; 3], [1.0, 0.0, 0.0], [0.5, third, 0.0]]), 2.0 / 6f64.sqrt());
    assert_close(stable_length(&[[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]), 2.0 / 3.0);
    assert_close(stable_length(&[[0.0; 3], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]]), 1.0);
}

#[test]
fn a_cap_of_triangles_allows_two_thirds_to_four_fifths_of_the_time_step_of_the_wall() {
    let mut worst: Vec<f64> = (6..=128).map(|around| cap_step(around, Cap::Triangles)).collect();
    worst.sort_by(f64::total_cmp);
    assert!(worst[0] > 0.65 && worst[worst.len() / 2] > 0.75, "{worst:?}");
}

#[test]
fn a_cap_of_quads_allows_half_of_the_time_step_of_the_wall() {
    let worst = (4..=32).map(|n| cap_step(4 * n, Cap::Quads)).fold(f64::MAX, f64::min);
    assert!(worst > 0.5, "{worst}");
}

/// Smallest stable step in the cap over that of a square quad with the ring's side h, which is h/c.
fn cap_step(around: usize, cap: Cap) -> f64 {
    let mesh = tube(&standard_tube(Around::Even(around), [cap; 2])).unwrap();
    let side = 2.0 * 0.04 * (PI / around as f64).sin();
    let cap = &mesh.parts[1];
    let corners = |i| cap.nodes(i).iter().map(|n| mesh.points[*n as usize]).collect::<Vec<_>>();
    (0..cap.len()).map(|i| stable_length(&corners(i)) / side).fold(f64::MAX, f64::min)
}

#[test]
fn rings_of_a_tube_are_where_their_names_say() {
    let mesh = tube(&standard_tube(Around::Even(48), [Cap::Triangles; 2])).unwrap();
    for (set, x) in [("base", 0.0), ("base_2", 0.012), ("middle", 0.18), ("tip_2", 0.348), ("tip", 0.36)] {
        assert_eq!(mesh.sets[set].len(), 48);
        assert!(mesh.sets[set].iter().all(|n| (mesh.points[*n as usize][0] - x).abs() < 1e-15), "{set}");
    }
    assert_eq!(mesh.points[mesh.sets["tip_centre"][0] as usize], [0.36, 0.0, 0.0]);
    assert!(mesh.sets["tip_cap"].iter().all(|n| mesh.points[*n as usize][0] == 0.36));
    assert!(mesh.sets["tip"].iter().all(|n| mesh.sets["tip_cap"].contains(n)));
}

#[test]
fn the_warp_runs_round_as_one_helix_seen_from_outside() {
    let turn = 0.6;
    let spec = Tube { warp_rad: turn, ..standard_tube(Around::Angles(graded()), [Cap::Open; 2]) };
    for mesh in [tube(&spec).unwrap(), flat_tube(0.06, 0.3, 4, 8, turn, 0.0).unwrap()] {
        for part in &mesh.parts {
            for i in 0..part.len() {
                let (warp, normal) = (part.warp_of(i).unwrap(), area_vector(&mesh, part, i));
                let normal = scale(normal, 1.0 / norm(normal));
                assert!(dot(warp, normal).abs() < 1e-12 && (norm(warp) - 1.0).abs() < 1e-15);
                assert!((warp[0] - turn.cos()).abs() < 1e-15);
                assert!((dot(cross([1.0, 0.0, 0.0], warp), normal) - turn.sin()).abs() < 1e-12);
            }
        }
    }
}

#[test]
fn a_flat_tube_is_closed_and_its_gauge_rings_go_round() {
    let mesh = flat_tube(0.06, 0.3, 12, 60, FRAC_PI_4, 0.0).unwrap();
    assert_close(part_area(&mesh, "top") + part_area(&mesh, "bottom"), 2.0 * 0.018);
    for (set, x, count) in [("gauge_0", 0.075, 24), ("gauge_1", 0.225, 24), ("end_0", 0.0, 13), ("end_1", 0.3, 13)] {
        assert_eq!(mesh.sets[set].len(), count, "{set}");
        assert!(mesh.sets[set].iter().all(|n| (mesh.points[*n as usize][0] - x).abs() < 1e-15), "{set}");
    }
    assert_eq!(mesh.points[mesh.sets["anchor_end"][0] as usize], [0.3, 0.0, 0.0]);
}

#[test]
fn area_and_volume_of_a_sphere_converge_at_second_order() {
    let error = |n: usize| {
        let mesh = sphere(0.1, n).unwrap();
        let volume = check(&mesh, &["air"]).unwrap().volumes_m3[0].1;
        [1.0 - part_area(&mesh, "sphere") / (4.0 * PI * 0.01), 1.0 - volume / (4.0 / 3.0 * PI * 1e-3)]
    };
    let (coarse, fine) = (error(8), error(16));
    for k in 0..2 {
        let order = (coarse[k] / fine[k]).log2();
        assert!(fine[k] > 0.0 && fine[k] < 0.01 && (order - 2.0).abs() < 0.1, "{coarse:?} {fine:?}");
    }
    assert_eq!(sphere(0.1, 8).unwrap().points.len(), 6 * 64 + 2);
}

#[test]
fn crossed_sheets_lie_apart_by_the_gap_and_share_no_place_in_the_plane() {
    let mesh = crossed_sheets(0.1, 0.02, 4, 1e-3).unwrap();
    assert_close(part_area(&mesh, "lower"), 2e-3);
    assert_close(part_area(&mesh, "upper"), 2e-3);
    let [lower, upper] = ["lower", "upper"].map(|set| &mesh.sets[set]);
    assert!(lower.iter().all(|n| mesh.points[*n as usize][2] == 0.0));
    assert!(upper.iter().all(|n| mesh.points[*n as usize][2] == 1e-3));
    assert!(mesh.sets["upper_ends"].iter().all(|n| (mesh.points[*n as usize][1].abs() - 0.05).abs() < 1e-15));
    assert_ne!(mesh.parts[0].layer, mesh.parts[1].layer);
}

#[test]
fn sizes_that_make_no_mesh_are_refused_with_the_name_of_the_number() {
    let even = |around, caps| standard_tube(around, caps);
    for (result, message) in [
        (plate(-1.0, 1.0, 1, 1, None), "plate: lx_m is -1, and must be a positive length in metres"),
        (plate(1.0, f64::NAN, 1, 1, None), "plate: ly_m is NaN, and must be a positive length in metres"),
        (plate(1.0, 1.0, 0, 1, None), "plate: nx is 0, and must be at least 1"),
        (
            plate(1.0, 1.0, usize::MAX, 2, None),
            "plate: 18446744073709551615 by 2 elements is more than 20000000 nodes; use fewer",
        ),
        (
            plate(1.0, 1.0, 2, 2, Some(Distortion { share: 0.3, seed: 0 })),
            "plate: distortion is 0.3, and must be at least 0 and below 0.25",
        ),
        (pillow(1.0, 3, 0.0), "pillow: n is 3, and must be even so that a node is in the middle"),
        (pillow(1.0, 4, -1.0), "gap_m is -1, and must be 0 or a positive length in metres"),
        (sphere(f64::INFINITY, 3), "sphere: radius_m is inf, and must be a positive length in metres"),
        (disc_balloon(1.0, 0), "disc balloon: n is 0, and must be even so that a node is in the middle"),
        (
            flat_tube(0.06, 0.3, 4, 6, 0.0, 0.0),
            "flat tube: n_l must be a multiple of 4 (gauge rings at the quarters), the angle a number; found 6 and 0",
        ),
        (
            tube(&even(Around::Even(50), [Cap::Quads; 2])),
            "tube: a cap of quads needs equal angles and a multiple of 4, at least 8, elements around; found 50; use a cap of \
             triangles",
        ),
        (
            tube(&even(Around::Angles(vec![0.0, 1.0, 0.5, 2.0, 3.0, 4.0, 5.0]), [Cap::Open; 2])),
            "tube: angles must ascend in one turn by at most 60°; found 57.296° then 28.648°",
        ),
        (
            tube(&even(Around::Angles(Vec::new()), [Cap::Open; 2])),
            "tube: number of angles is 0, and must be at least 6",
        ),
    ] {
        assert_eq!(result.unwrap_err().to_string(), format!("mesh: {message}"));
    }
}

#[test]
fn counts_that_overflow_are_refused() {
    let (size, most) = (0.1, usize::MAX - 3);
    for result in [
        plate(size, size, most, most, None),
        crossed_sheets(size, size, most, size),
        pillow(size, most - most % 2, 0.0),
        disc_balloon(size, most - most % 2),
        long_pouch(size, size, 4, most - most % 2, 0.0),
        flat_tube(size, size, 4, most - most % 4, 0.0, 0.0),
        sphere(size, most),
        tube(&Tube { along: most, ..standard_tube(Around::Even(6), [Cap::Open; 2]) }),
        tube(&standard_tube(Around::Even(most), [Cap::Open; 2])),
    ] {
        let message = result.unwrap_err().to_string();
        assert!(message.ends_with(" elements is more than 20000000 nodes; use fewer"), "{message}");
    }
}
