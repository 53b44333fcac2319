use super::*;
use crate::mesh::Part;
use crate::mesh::Tie;
use crate::mesh::generate::{Around, Cap, Tube, pillow, plate, sphere, tube};

/// Runs the check after a change to a mesh and gives the message.
fn message_with(mut mesh: Mesh, chambers: &[&str], spoil: impl FnOnce(&mut Mesh)) -> String {
    check(&mesh, chambers).unwrap();
    spoil(&mut mesh);
    check(&mesh, chambers).unwrap_err().to_string()
}

fn plate_with(spoil: impl FnOnce(&mut Mesh)) -> String {
    message_with(plate(0.02, 0.02, 2, 2, None).unwrap(), &[], spoil)
}

fn sphere_with(spoil: impl FnOnce(&mut Mesh)) -> String {
    message_with(sphere(0.1, 4).unwrap(), &["air"], spoil)
}

#[test]
fn an_open_chamber_names_the_edge_in_numbers_from_one_and_in_mm() {
    let message = sphere_with(|mesh| {
        mesh.parts[0].quads.remove(95);
    });
    assert!(message.starts_with("mesh: chamber `air` is open: the edge between nodes "), "{message}");
    assert!(message.contains("(4 such edges)") && message.contains(" mm belongs to element "), "{message}");
    assert!(message.ends_with("weld the nodes there, or name the set of nodes at which it may be open"), "{message}");
}

#[test]
fn a_wall_that_ends_inside_a_chamber_is_refused() {
    let message = sphere_with(|mesh| {
        let [a, b, ..] = mesh.parts[0].quads[10];
        mesh.points.push([0.0; 3]);
        let fin = Part { name: "fin".into(), triangles: vec![[a, b, 98]], back: Some("air".into()), ..Part::default() };
        mesh.parts.push(fin);
    });
    assert!(message.contains("is not the inside of a closed surface: 3 of its faces meet at the edge"), "{message}");
    assert!(message.contains("element 1 of part `fin`"), "{message}");
}

#[test]
fn a_fin_with_the_same_chamber_on_both_sides_carries_no_pressure_and_passes() {
    let mut mesh = sphere(0.1, 4).unwrap();
    let ([a, b, ..], air) = (mesh.parts[0].quads[10], Some("air".to_string()));
    mesh.points.push([0.0; 3]);
    let (front, back) = (air.clone(), air);
    mesh.parts.push(Part { name: "fin".into(), triangles: vec![[a, b, 98]], front, back, ..Part::default() });
    check(&mesh, &["air"]).unwrap();
}

#[test]
fn the_one_element_turned_over_is_the_one_named() {
    for turned in [0, 17, 95] {
        let message = sphere_with(|mesh| mesh.parts[0].quads[turned].swap(1, 3));
        assert!(message.starts_with(&format!("mesh: element {} of part `sphere` (nodes ", turned + 1)), "{message}");
        assert!(message.contains(" is turned over: at the edge between nodes "), "{message}");
        assert!(message.contains("(4 such edges); list its nodes in the opposite order"), "{message}");
    }
}

#[test]
fn a_layer_turned_over_is_refused_even_while_the_pillow_is_flat() {
    let message = message_with(pillow(0.1, 4, 0.0).unwrap(), &["air"], |mesh| {
        mesh.parts[1].quads.iter_mut().for_each(|q| q.swap(1, 3));
    });
    assert!(message.contains("is turned over") && message.contains("swap front and back of its part"), "{message}");
}

#[test]
fn a_chamber_inside_out_is_refused_when_it_has_a_volume() {
    let message = sphere_with(|mesh| mesh.parts[0].quads.iter_mut().for_each(|q| q.swap(1, 3)));
    assert!(message.starts_with("mesh: chamber `air` is inside out (volume -"), "{message}");
    let message = sphere_with(|mesh| {
        let part = &mut mesh.parts[0];
        std::mem::swap(&mut part.front, &mut part.back);
    });
    assert!(message.contains("all its faces are turned over; swap front and back"), "{message}");
}

#[test]
fn front_and_back_swapped_together_with_the_order_of_nodes_is_the_same_chamber() {
    let mut mesh = sphere(0.1, 4).unwrap();
    let before = check(&mesh, &["air"]).unwrap().volumes_m3[0].1;
    let part = &mut mesh.parts[0];
    std::mem::swap(&mut part.front, &mut part.back);
    part.quads.iter_mut().for_each(|q| q.swap(1, 3));
    let after = check(&mesh, &["air"]).unwrap().volumes_m3[0].1;
    assert!((after / before - 1.0).abs() < 1e-3, "{before} {after}");
}

#[test]
fn two_pouches_of_one_supply_line_may_share_a_seam() {
    let mut mesh = pillow(0.1, 4, 0.01).unwrap();
    let mut other = pillow(0.1, 4, 0.01).unwrap();
    other.parts.iter_mut().for_each(|part| part.name += "_2");
    other.points.iter_mut().chain(&mut other.start).for_each(|x| x[0] += 0.1);
    mesh.append(other).unwrap();
    let places = mesh.start.clone();
    let meets = |a: [f64; 3], b: [f64; 3]| (0..3).all(|k| (a[k] - b[k]).abs() < 1e-6);
    let rim = mesh.sets["rim"].clone();
    let first = |n: u32| *rim.iter().find(|m| meets(places[**m as usize], places[n as usize])).unwrap_or(&n);
    let shared = |n: &mut u32| *n = if rim.contains(n) { first(*n) } else { *n };
    mesh.parts.iter_mut().flat_map(|part| &mut part.quads).flatten().for_each(shared);
    let used: std::collections::BTreeSet<u32> = mesh.parts.iter().flat_map(|p| &p.quads).flatten().copied().collect();
    assert_eq!(mesh.points.len() - used.len(), 5);
    let number = |n: u32| used.range(..n).count() as u32;
    mesh.parts.iter_mut().flat_map(|part| &mut part.quads).flatten().for_each(|n| *n = number(*n));
    let kept = |all: &[[f64; 3]]| used.iter().map(|n| all[*n as usize]).collect();
    (mesh.points, mesh.start) = (kept(&mesh.points), kept(&mesh.start));
    mesh.sets.clear();
    let quality = check(&mesh, &["air"]).unwrap();
    assert_eq!(quality.seams, 4);
    assert!(
        (quality.volumes_m3[0].1 / (2.0 * check(&pillow(0.1, 4, 0.01).unwrap(), &["air"]).unwrap().volumes_m3[0].1)
            - 1.0)
            .abs()
            < 1e-12
    );
}

#[test]
fn a_pouch_on_a_body_shares_the_wall_between_the_two_chambers() {
    let spec = Tube {
        radius_m: 0.04,
        length_m: 0.1,
        around: Around::Even(12),
        along: 4,
        caps: [Cap::Triangles; 2],
        warp_rad: 0.0,
    };
    let mut mesh = tube(&spec).unwrap();
    // A second skin over the lower half of the wall: elements 13 to 24, between the rings of nodes 13 and 25 … 37.
    let under: Vec<[u32; 4]> = mesh.parts[0].quads.drain(12..36).collect();
    let offset = mesh.points.len() as u32 - 24;
    for node in 24..36 {
        let [x, y, z] = mesh.points[node];
        mesh.points.push([x, 1.2 * y, 1.2 * z]);
    }
    let lift = |n: u32| if (24..36).contains(&n) { n + offset } else { n };
    let skin = under.iter().map(|q| q.map(lift)).collect();
    let (body, pouch) = (Some("body".to_string()), Some("pouch".to_string()));
    mesh.parts.push(Part { name: "under".into(), quads: under, front: pouch.clone(), back: body, ..Part::default() });
    mesh.parts.push(Part { name: "skin".into(), quads: skin, back: pouch, layer: 1, ..Part::default() });
    let volumes = check(&mesh, &["body", "pouch"]).unwrap().volumes_m3;
    let section = 0.5 * 12.0 * 0.04 * 0.04 * (std::f64::consts::TAU / 12.0).sin();
    // The skin's section grows from 1 to 1.44 and back: frusta of height 25 mm, mean (1 + 1.2 + 1.44)/3.
    for ((_, found), exact) in volumes.iter().zip([section * 0.1, section * 0.05 * ((1.0 + 1.2 + 1.44) / 3.0 - 1.0)]) {
        assert!((found / exact - 1.0).abs() < 1e-12, "{found} {exact}");
    }
}

#[test]
fn an_edge_closed_by_ties_is_not_a_leak() {
    let mut mesh = sphere(0.1, 2).unwrap();
    // Quad 1 gets its own node at one corner, tied to the old one: two of its edges run beside the old ones.
    let old = mesh.parts[0].quads[0][0];
    mesh.points.push(mesh.points[old as usize]);
    mesh.parts[0].quads[0][0] = 26;
    assert!(check(&mesh, &["air"]).unwrap_err().to_string().contains("is open"));
    let neighbours = [mesh.parts[0].quads[0][1], mesh.parts[0].quads[0][3]];
    mesh.ties.push(Tie { node: 26, to: vec![(old, 1.0), (neighbours[0], 0.0), (neighbours[1], 0.0)] });
    check(&mesh, &["air"]).unwrap();
}

#[test]
fn elements_without_shape_are_named() {
    for (message, wanted) in [
        (
            plate_with(|mesh| mesh.parts[0].quads[1] = [1, 2, 5, 1]),
            "element 2 of part `plate` (nodes 2, 3, 6, 2) has node 2 twice",
        ),
        (
            plate_with(|mesh| (3..6).for_each(|n| mesh.points[n][1] = 0.0)),
            "element 1 of part `plate` (nodes 1, 2, 5, 4) at (5.0, 0.0, 0.0) mm has no area",
        ),
        (
            plate_with(|mesh| mesh.points[4] = [0.004, 0.004, 0.0]),
            "element 1 of part `plate` (nodes 1, 2, 5, 4) is inverted at node 5, (4.0, 4.0, 0.0) mm: its corner there is 180 \
             degrees or more",
        ),
        (plate_with(|mesh| mesh.points[4][2] = f64::NAN), "node 5 has a place that is not a number: [0.01, 0.01, NaN]"),
        (
            plate_with(|mesh| {
                mesh.start = mesh.points.clone();
                (0..9).for_each(|n| mesh.start[n][0] = 0.0);
            }),
            "element 1 of part `plate` (nodes 1, 2, 5, 4) at (0.0, 5.0, 0.0) mm has no area at the start",
        ),
        (
            plate_with(|mesh| mesh.parts[0].quads.push([5, 4, 1, 2])),
            "element 5 of part `plate` (nodes 6, 5, 2, 3) has the nodes of element 2; remove one (a second ply belongs in the section)",
        ),
        (
            plate_with(|mesh| mesh.parts[0].quads[3][0] = u32::MAX),
            "element 4 of part `plate` (nodes 4294967296, 6, 9, 8) has node 4294967296, but there are only 9 nodes",
        ),
        (
            plate_with(|mesh| mesh.parts[0].quads[3][0] = 77),
            "element 4 of part `plate` (nodes 78, 6, 9, 8) has node 78, but there are only 9 nodes",
        ),
    ] {
        assert_eq!(message, format!("mesh: {wanted}"));
    }
}

#[test]
fn warp_directions_out_of_the_sheet_are_refused() {
    for (warp, wanted) in [
        (vec![[0.0, 0.01, 1.0]], "warp direction [0.0, 0.01, 1.0] is parallel to the normal; give one in the sheet"),
        (vec![[0.0; 3]], "warp direction [0.0, 0.0, 0.0] has no direction"),
    ] {
        let message = plate_with(|mesh| mesh.parts[0].warp = warp);
        assert_eq!(message, format!("mesh: element 1 of part `plate` (nodes 1, 2, 5, 4): {wanted}"));
    }
    let message = plate_with(|mesh| mesh.parts[0].warp = vec![[1.0, 0.0, 0.0]; 3]);
    assert_eq!(message, "mesh: part `plate` has 3 warp directions; give 1, or 4 (one per element)");
}

#[test]
fn nodes_parts_sets_and_chambers_that_do_not_fit_are_named() {
    for (message, wanted) in [
        (
            plate_with(|mesh| mesh.points.push([0.1, 0.0, 0.0])),
            "node 10 at (100.0, 0.0, 0.0) mm belongs to no element and would have no mass; remove it (1 such)",
        ),
        (plate_with(|mesh| mesh.start.push([0.0; 3])), "1 start places for 9 nodes; give one per node or none"),
        (plate_with(|mesh| mesh.parts.clear()), "there are no elements"),
        (
            plate_with(|mesh| mesh.parts.push(Part { name: "patch".into(), ..Part::default() })),
            "part `patch` has no elements; remove it",
        ),
        (plate_with(|mesh| mesh.parts.push(mesh.parts[0].clone())), "there are two parts called `plate`; rename one"),
        (
            plate_with(|mesh| mesh.parts[0].back = Some("air".into())),
            "part `plate` has chamber `air` at its back, which does not exist (chambers: none)",
        ),
        (
            sphere_with(|mesh| mesh.parts[0].back = Some("aur".into())),
            "part `sphere` has chamber `aur` at its back, which does not exist (chambers: air); did you mean `air`?",
        ),
        (sphere_with(|mesh| mesh.parts[0].back = None), "no part faces chamber `air`"),
        (
            plate_with(|mesh| mesh.sets.get_mut("left").unwrap().push(9)),
            "set `left` has node 10, but there are only 9 nodes",
        ),
    ] {
        assert_eq!(message, format!("mesh: {wanted}"));
    }
    let error = check_open(&sphere(0.1, 2).unwrap(), &["air"], &["topp"]).unwrap_err();
    assert_eq!(error.to_string(), "mesh: unknown set `topp` for an opening; did you mean `top`?");
}

#[test]
fn ties_that_would_not_hold_are_named() {
    let tie = |node, to: &[(u32, f64)]| Tie { node, to: to.to_vec() };
    for (ties, wanted) in [
        (vec![tie(4, &[(0, 0.5), (1, 0.4)])], "tie of node 5: weights sum to 0.9, and must sum to 1"),
        (vec![tie(4, &[(0, f64::NAN)])], "tie of node 5: weights sum to NaN, and must sum to 1"),
        (vec![tie(4, &[(9, 1.0)])], "tie of node 5 has node 10, but there are only 9"),
        (vec![tie(4, &[(0, 1.0)]), tie(4, &[(1, 1.0)])], "node 5 is tied twice; keep one of the two ties"),
        (
            vec![tie(4, &[(0, 1.0)]), tie(3, &[(4, 1.0)])],
            "node 4 is tied to node 5, which is itself tied; tie both to free nodes",
        ),
        (vec![tie(4, &[(4, 1.0)])], "node 5 is tied to node 5, which is itself tied; tie both to free nodes"),
    ] {
        assert_eq!(plate_with(|mesh| mesh.ties = ties), format!("mesh: {wanted}"));
    }
}

#[test]
fn an_opening_that_is_not_plane_is_refused() {
    let mut mesh = sphere(0.1, 4).unwrap();
    let removed: Vec<[u32; 4]> = mesh.parts[0].quads.drain(0..3).collect();
    mesh.sets.insert("hole".into(), removed.into_iter().flatten().collect());
    let error = check_open(&mesh, &["air"], &["hole"]).unwrap_err().to_string();
    assert!(error.ends_with("is not in a set whose nodes share a plane perpendicular to x, y or z"), "{error}");
}

#[test]
fn measures_of_known_elements_are_exact() {
    let mesh = Mesh {
        points: vec![[0.0, 0.0, 0.0], [0.003, 0.0, 0.0], [0.003, 0.001, 0.0], [0.0, 0.001, 0.0], [0.004, 0.001, 0.0]],
        parts: vec![Part {
            name: "p".into(),
            quads: vec![[0, 1, 2, 3]],
            triangles: vec![[1, 4, 2]],
            ..Part::default()
        }],
        ..Mesh::default()
    };
    let quality = check(&mesh, &[]).unwrap();
    assert_eq!(quality.aspect, 3.0);
    assert_eq!((quality.jacobian_ratio, quality.warpage), (1.0, 0.0));
    assert_eq!((quality.side_m.min, quality.side_m.max), (0.001, 0.003));
    let mut warped = plate(1.0, 1.0, 1, 1, None).unwrap();
    [0, 3].iter().for_each(|n: &usize| warped.points[*n][2] = 0.1);
    // Corners at ±0.05 from the mean plane, area of the plan 1.
    assert!((check(&warped, &[]).unwrap().warpage - 0.05).abs() < 1e-12);
}
