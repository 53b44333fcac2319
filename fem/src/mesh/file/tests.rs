use std::path::Path;

use super::*;
use crate::FemError;
use crate::mesh::file::write::text;
use crate::mesh::generate::{Around, Cap, Distortion, Tube, crossed_sheets, disc_balloon, pillow, plate, sphere, tube};
use crate::mesh::{Mesh, Tie};

/// The example of the format description, without its comments.
const SMALL: &str = "mesh 1
nodes 6
0 0 0
0.1 0 0
0.1 0.1 0
0 0.1 0
0.2 0 0
0.2 0.1 0
part cloth
front air
back body
layer 2
warp 1
1 0 0
quads 1
1 2 3 4
triangles 1
2 5 3
set left 2
1 4
ties 1
6  3 0.5  5 0.5
end 6 2
";

fn parsed(text: &str) -> Result<Mesh, String> {
    parse(text, Path::new("a.mesh")).map_err(|error| error.to_string())
}

#[test]
fn the_documented_example_reads_as_it_says() {
    let mesh = parsed(SMALL).unwrap();
    let part = &mesh.parts[0];
    assert_eq!((part.name.as_str(), part.layer, part.warp.len()), ("cloth", 2, 1));
    assert_eq!((part.front.as_deref(), part.back.as_deref()), (Some("air"), Some("body")));
    assert_eq!((part.quads[0], part.triangles[0], &mesh.sets["left"]), ([0, 1, 2, 3], [1, 4, 2], &vec![0, 3]));
    assert_eq!(mesh.ties, [Tie { node: 5, to: vec![(2, 0.5), (4, 0.5)] }]);
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/case.md");
    let documented: String = std::fs::read_to_string(path)
        .unwrap()
        .lines()
        .skip_while(|line| !line.starts_with("mesh 1"))
        .take_while(|line| !line.contains("```"))
        .map(|line| format!("{line}\r\n"))
        .collect();
    assert_eq!(parsed(&documented).unwrap(), mesh);
}

#[test]
fn what_was_written_is_read_back_bit_by_bit() {
    let turned = Tube {
        radius_m: 0.04,
        length_m: 1.0 / 3.0,
        around: Around::Even(24),
        along: 7,
        caps: [Cap::Quads, Cap::Triangles],
        warp_rad: 0.7,
    };
    let mut odd = plate(1.0, 0.1, 3, 2, Some(Distortion { share: 0.2, seed: 5 })).unwrap();
    odd.points[5] = [-0.0, 1e-300, f64::MIN_POSITIVE / 8.0];
    odd.points[6] = [f64::MAX, 0.1 + 0.2, -1.0 / 3.0];
    odd.ties.push(Tie { node: 5, to: vec![(0, 1.0 / 3.0), (1, 2.0 / 3.0)] });
    odd.sets.insert("nobody".into(), Vec::new());
    odd.membrane = odd.points.iter().rev().copied().collect();
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.mesh");
    for mesh in [
        odd,
        pillow(0.8485, 16, 1e-5).unwrap(),
        disc_balloon(0.3, 6).unwrap(),
        crossed_sheets(0.1, 0.03, 5, 1e-3).unwrap(),
        tube(&turned).unwrap(),
    ] {
        write(&path, &mesh).unwrap();
        let again = read(&path).unwrap().mesh;
        assert_eq!(again, mesh);
        // Equality does not see the sign of zero.
        let places = |mesh: &Mesh| [mesh.points.clone(), mesh.membrane.clone(), mesh.start.clone()].concat();
        let bits = |mesh: &Mesh| places(mesh).as_flattened().iter().map(|x| x.to_bits()).collect::<Vec<_>>();
        assert_eq!(bits(&again), bits(&mesh));
    }
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
}

#[test]
fn every_fault_is_named_with_its_line() {
    for (wrong, by, line, message) in [
        ("mesh 1", "vtk 1", 1, "a mesh file begins with the line `mesh 1`"),
        ("mesh 1", "mesh 2", 1, "mesh format 2 is not known; this program reads `mesh 1`"),
        ("nodes 6", "nodes six", 2, "expected how many lines follow, found `six`"),
        ("nodes 6", "nodes 99999999999", 2, "99999999999 lines cannot follow in a file of 207 bytes"),
        ("nodes 6", "nodes 7", 9, "expected node 7 of 7 (x y z), found `part`; correct the count or add the lines"),
        (
            "nodes 6",
            "nodes 5",
            8,
            "expected a keyword, found `0.2`; has the block before more lines than its count says?",
        ),
        ("0.1 0 0", "0.1 0", 4, "expected x y z, found 2 words"),
        ("0.1 0 0", "0.1 0 zero", 4, "expected a number, found `zero`"),
        ("0.1 0 0", "0.1 NaN 0", 4, "expected a finite number, found `NaN`"),
        ("0.1 0 0", "0.1 1e999 0", 4, "expected a finite number, found `1e999`"),
        (
            "part cloth",
            "prt cloth",
            9,
            "unknown keyword `prt`; did you mean `part`? (known: mesh, nodes, membrane, start, part, front, \
          back, layer, warp, quads, triangles, set, ties, end)",
        ),
        ("part cloth", "part", 9, "`part` has 0 words after it; write `part NAME, one word`"),
        ("part cloth", "part a\npart a", 10, "part `a` exists already; use another name"),
        ("part cloth\n", "", 9, "this belongs to a part; write `part NAME` before it"),
        ("back body", "front body", 11, "a second `front` in the same part; keep one"),
        ("layer 2", "layer -1", 12, "expected a layer number from 0, found `-1`"),
        ("1 2 3 4", "1 2 3", 16, "expected 4 node numbers, found 3"),
        ("1 2 3 4", "1 2 3 7", 16, "there is no node 7: the file has 6 nodes"),
        ("1 2 3 4", "0 1 2 3", 16, "there is no node 0; node numbers count from 1"),
        ("1 2 3 4", "1 2 3 -4", 16, "expected a node number, found `-4`"),
        ("set left 2", "set left", 19, "`set` has 1 words after it; write `set NAME COUNT`"),
        ("set left 2", "set left 1", 20, "set `left` has 2 nodes up to here, but its first line says 1"),
        (
            "set left 2",
            "set left 3",
            21,
            "expected node of the set 3 of 3 (node numbers), found `ties`; correct the count or add the lines",
        ),
        ("set left 2", "set left 0\nset left 2", 20, "set `left` exists already; use another name"),
        ("6  3 0.5  5 0.5", "6  3 0.5  5", 22, "expected a node, then pairs of node and weight"),
        ("end 6 2", "end 6 3", 23, "`end` says 6 nodes and 3 elements, but there are 6 and 2"),
        ("end 6 2", "end 6", 23, "`end` has 1 words after it; write `end NODES ELEMENTS`"),
        ("end 6 2", "", 23, "the file ends without `end`: it was cut off; write it again"),
        ("end 6 2", "end 6 2\nend 6 2", 24, "`end` after `end`; remove what follows"),
        ("end 6 2", "nodes 1\n0 0 0\nend 6 2", 23, "a second block of nodes; put all nodes in one"),
        ("end 6 2", "start 1\n0 0 0\nend 6 2", 24, "1 start places for 6 nodes; give one per node"),
        ("end 6 2", "membrane 1\n0 0 0\nend 6 2", 24, "1 membrane places for 6 nodes; give one per node"),
    ] {
        assert!(SMALL.contains(wrong), "{wrong}");
        let error = parsed(&SMALL.replacen(wrong, by, 1)).unwrap_err();
        assert_eq!(error, format!("a.mesh:{line}: {message}"));
    }
}

#[test]
fn a_file_cut_anywhere_is_refused_and_never_panics() {
    for cut in 0..SMALL.len() - 1 {
        let error = parsed(&SMALL[..cut]).unwrap_err();
        assert!(error.starts_with("a.mesh:"), "{error}");
    }
}

#[test]
fn words_swapped_for_others_never_panic() {
    let words: Vec<&str> = SMALL.split_inclusive(char::is_whitespace).collect();
    for at in 0..words.len() {
        for by in ["", "nodes ", "-1 ", "4294967297 ", "1e400 ", "é ", "end 0 0\n", "# "] {
            let text: String = words[..at].iter().copied().chain([by]).chain(words[at + 1..].iter().copied()).collect();
            if let Ok(mesh) = parsed(&text) {
                let _ = crate::mesh::check::check(&mesh, &["air", "body"]);
            }
        }
    }
}

#[test]
fn bytes_that_are_no_text_and_a_missing_file_are_said() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("b.mesh");
    std::fs::write(&path, b"mesh 1\nnodes 1\n\xff\xfe 0 0\n").unwrap();
    let error = read(&path).unwrap_err().to_string();
    assert!(error.ends_with("b.mesh:3: this is not text (UTF-8); a mesh file is plain text"), "{error}");
    assert!(matches!(read(&folder.path().join("c.mesh")), Err(FemError::Io { .. })));
}

#[test]
fn a_mesh_that_a_file_cannot_tell_is_not_written() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("d.mesh");
    let good = plate(1.0, 1.0, 1, 1, None).unwrap();
    let message = |spoil: &dyn Fn(&mut Mesh)| {
        let mut mesh = good.clone();
        spoil(&mut mesh);
        write(&path, &mesh).unwrap_err().to_string()
    };
    assert_eq!(
        message(&|mesh| mesh.parts[0].name = "my plate".into()),
        "mesh: the name `my plate` cannot be written to a mesh file; use one word without spaces and `#`"
    );
    assert_eq!(
        message(&|mesh| mesh.points[1][2] = f64::INFINITY),
        "mesh: node 2 has a place that is not a number: [1.0, 0.0, inf]"
    );
    assert_eq!(
        message(&|mesh| mesh.ties.push(Tie { node: 9, to: vec![(0, 1.0)] })),
        "mesh: tie of node 10 has node 10, but there are only 4"
    );
    assert!(!path.exists());
}

#[test]
fn a_large_mesh_is_read_in_time_that_grows_with_its_size() {
    // Ratios do not depend on the machine, nor the thread's own time on what else it does: 16 times the elements in less
    // than 64 times the time.
    let seconds = |n: usize| {
        let text = text(&sphere(0.1, n).unwrap()).unwrap();
        let start = cpu_time::ThreadTime::now();
        assert_eq!(parsed(&text).unwrap().elements(), 6 * n * n);
        start.elapsed().as_secs_f64()
    };
    let (small, large) = (seconds(20).max(1e-4), seconds(80));
    assert!(large < 64.0 * small, "{small} s, then {large} s");
}
