use super::*;
use crate::output::frame::samples::{frame, mesh, spoilt};

/// A file as a reader sees it.
struct File {
    tags: String,
}

impl File {
    fn written(mesh: &Mesh, frame: &MeshFrame) -> File {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("frame.vtu");
        write_vtu(&path, mesh, frame).unwrap();
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1, "nothing temporary stays");
        File { tags: std::fs::read_to_string(path).unwrap() }
    }

    /// The bytes of one array, unpacked; sizes checked.
    fn bytes(&self, kind: &str, name: &str) -> Vec<u8> {
        let tag =
            self.tags.lines().find(|l| l.contains(&format!("Name=\"{name}\""))).unwrap_or_else(|| panic!("no {name}"));
        assert!(tag.contains(&format!("type=\"{kind}\"")) && tag.contains("format=\"binary\""), "{tag}");
        let text = tag.split_once('>').unwrap().1.strip_suffix("</DataArray>").unwrap();
        // 32 bytes of sizes are 44 letters.
        let [sizes, packed] = [&text[..44], &text[44..]].map(|letters| STANDARD.decode(letters).unwrap());
        let head = sizes.as_chunks::<8>().0.iter().map(|b| u64::from_le_bytes(*b) as usize);
        let bytes = miniz_oxide::inflate::decompress_to_vec_zlib(&packed).unwrap();
        assert_eq!(head.collect::<Vec<_>>(), [1, bytes.len(), 0, packed.len()], "{name}");
        bytes
    }

    fn floats(&self, name: &str) -> Vec<f32> {
        self.bytes("Float32", name).as_chunks::<4>().0.iter().map(|b| f32::from_le_bytes(*b)).collect()
    }

    fn doubles(&self, name: &str) -> Vec<f64> {
        self.bytes("Float64", name).as_chunks::<8>().0.iter().map(|b| f64::from_le_bytes(*b)).collect()
    }

    fn integers(&self, name: &str) -> Vec<i32> {
        self.bytes("Int32", name).as_chunks::<4>().0.iter().map(|b| i32::from_le_bytes(*b)).collect()
    }
}

#[test]
fn every_value_is_read_back_with_the_bits_that_are_kept() {
    let (mut mesh, frame) = (mesh(), MeshFrame { hold_pa: None, ..frame(0.25) });
    mesh.start = mesh.points.iter().map(|p| [p[0], p[1], p[2] + 0.003]).collect();
    let file = File::written(&mesh, &frame);
    let fields = |name: &str, wanted: Vec<f64>| {
        assert_eq!(file.floats(name), wanted.iter().map(|v| kept(*v)).collect::<Vec<_>>(), "{name}");
        let near = |(a, b): (&f32, &f64)| (f64::from(*a) - b).abs() <= 5e-4 * b.abs();
        assert!(file.floats(name).iter().zip(&wanted).all(near), "{name}");
    };
    let places = |name: &str, wanted: Vec<f64>| {
        // The largest coordinate is 200 mm.
        let near = |(a, b): (&f32, &f64)| (f64::from(*a) - b).abs() <= 0.5 * 128.0 / 131_072.0 + 1e-7 * b.abs();
        assert!(file.floats(name).iter().zip(&wanted).all(near) && wanted.len() == file.floats(name).len(), "{name}");
        assert!(file.floats(name).iter().all(|x| (x * 1024.0).fract() == 0.0), "{name}");
    };
    let scaled = |values: &[f64], by: f64| values.iter().map(|v| v * by).collect::<Vec<_>>();
    let moved = frame.positions.iter().zip(&mesh.start).map(|(x, s)| [0, 1, 2].map(|k| x[k] - s[k]));
    assert_eq!(file.doubles("TimeValue"), [0.25]);
    places("Points", scaled(frame.positions.as_flattened(), 1e3));
    places("displacement_mm", scaled(moved.collect::<Vec<_>>().as_flattened(), 1e3));
    fields("velocity_m_s", scaled(frame.velocities.as_flattened(), 1.0));
    fields("contact_pressure_kPa", scaled(&frame.contact_pressure_pa, 1e-3));
    fields("von_mises_MPa", scaled(&frame.fields.von_mises_pa, 1e-6));
    fields("thickness_mm", scaled(&frame.fields.thickness_m, 1e3));
    for k in 0..2 {
        let of = |name: &str| format!("{name}_{}", k + 1);
        fields(&(of("stress") + "_MPa"), frame.fields.principal_stress_pa.iter().map(|s| s[k] * 1e-6).collect());
        fields(&of("strain"), frame.fields.principal_strain.iter().map(|e| e[k]).collect());
        let wanted: Vec<i8> =
            frame.fields.principal_direction.iter().flat_map(|d| d[k].map(|v| (127.0 * v).round() as i8)).collect();
        let found: Vec<i8> = file.bytes("Int8", &of("direction")).into_iter().map(u8::cast_signed).collect();
        assert_eq!(found, wanted);
    }
}

#[test]
fn what_the_frame_is_of_is_in_it() {
    let file = File::written(&mesh(), &frame(0.25));
    assert_eq!(["part_id body", "part_id cap"].map(|name| file.doubles(name)[0]), [0.0, 1.0]);
    assert_eq!(["chamber_kPa body", "chamber_kPa Aktor ü"].map(|name| file.doubles(name)[0]), [2.0, -7.0]);
    assert_eq!(file.doubles("chamber_cm3 Aktor ü"), [1e-3 / 3.0 * 1e6]);
    assert!(!file.tags.contains("String"), "meshio reads no texts");
    assert_eq!(file.doubles("hold_kPa"), [10.0]);
    assert!(!file.tags.contains("velocity"), "a robot is read at rest");
    let plain = MeshFrame { chambers: vec![], hold_pa: None, contact_pressure_pa: vec![], ..frame(0.25) };
    let file = File::written(&mesh(), &plain);
    assert!(!file.tags.contains("chamber") && !file.tags.contains("hold") && !file.tags.contains("contact_pressure"));
}

#[test]
fn elements_come_part_by_part_with_their_kind() {
    let file = File::written(&mesh(), &frame(0.0));
    assert!(file.tags.contains(r#"<Piece NumberOfPoints="6" NumberOfCells="3">"#));
    assert_eq!(file.integers("connectivity"), [0, 1, 2, 3, 1, 4, 2, 3, 2, 5]);
    assert_eq!(file.integers("offsets"), [4, 7, 10]);
    assert_eq!(file.bytes("UInt8", "types"), [QUAD, TRIANGLE, TRIANGLE]);
    assert_eq!(file.integers("part_id"), [0, 0, 1]);
    assert_eq!(file.bytes("UInt8", "wrinkle_state"), [0, 2, 1]);
}

#[test]
fn a_number_that_is_not_finite_is_refused_and_the_earlier_file_stays() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("frame.vtu");
    write_vtu(&path, &mesh(), &frame(0.25)).unwrap();
    let before = std::fs::read(&path).unwrap();
    for (message, bad) in spoilt() {
        let error = write_vtu(&path, &mesh(), &bad).unwrap_err().to_string();
        assert!(error.contains(message), "{error}");
        assert_eq!(std::fs::read(&path).unwrap(), before);
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
    }
}

#[test]
fn a_folder_that_does_not_exist_is_named() {
    let path = Path::new("/nowhere/frame.vtu");
    let error = write_vtu(path, &mesh(), &frame(0.0)).unwrap_err();
    assert!(error.to_string().starts_with("/nowhere/frame.vtu: "), "{error}");
}
