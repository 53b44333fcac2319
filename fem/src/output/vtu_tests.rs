use super::*;
use crate::output::frame::samples::{frame, mesh, spoilt};

/// The bytes of one array, its length checked.
fn array(text: &str, name: &str) -> Vec<u8> {
    let at = text.find(&format!("Name=\"{name}\"")).unwrap_or_else(|| panic!("no {name}"));
    let body = text[at..].split_once('>').unwrap().1.split_once('<').unwrap().0;
    let bytes = STANDARD.decode(body).unwrap();
    let (length, values) = bytes.split_first_chunk::<8>().unwrap();
    assert_eq!(u64::from_le_bytes(*length), values.len() as u64, "{name}");
    values.to_vec()
}

fn numbers(text: &str, name: &str) -> Vec<f64> {
    array(text, name).as_chunks::<8>().0.iter().map(|b| f64::from_le_bytes(*b)).collect()
}

fn longs(text: &str, name: &str) -> Vec<i64> {
    array(text, name).as_chunks::<8>().0.iter().map(|b| i64::from_le_bytes(*b)).collect()
}

fn written(mesh: &Mesh, frame: &Frame) -> String {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("frame.vtu");
    write_vtu(&path, mesh, frame).unwrap();
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1, "nothing temporary stays");
    std::fs::read_to_string(path).unwrap()
}

#[test]
fn every_value_is_read_back_to_the_bit() {
    let (mut mesh, frame) = (mesh(), frame(0.25));
    mesh.start = mesh.points.iter().map(|p| [p[0], p[1], p[2] + 0.003]).collect();
    let text = written(&mesh, &frame);
    assert_eq!(numbers(&text, "TimeValue"), [0.25]);
    assert_eq!(numbers(&text, "Points"), mesh.start.concat());
    let moved: Vec<f64> =
        frame.positions.iter().zip(&mesh.start).flat_map(|(x, s)| [0, 1, 2].map(|k| (x[k] - s[k]) * 1e3)).collect();
    assert_eq!(numbers(&text, "U_mm"), moved);
    assert_eq!(numbers(&text, "velocity_m_s"), frame.velocities.concat());
    let scaled = |values: &[f64], by: f64| values.iter().map(|v| v * by).collect::<Vec<_>>();
    assert_eq!(numbers(&text, "contact_pressure_kPa"), scaled(&frame.contact_pressure_pa, 1e-3));
    assert_eq!(numbers(&text, "von_mises_MPa"), scaled(&frame.fields.von_mises_pa, 1e-6));
    assert_eq!(numbers(&text, "thickness_mm"), scaled(&frame.fields.thickness_m, 1e3));
    for k in 0..2 {
        let stress: Vec<f64> = frame.fields.principal_stress_pa.iter().map(|s| s[k] * 1e-6).collect();
        let strain: Vec<f64> = frame.fields.principal_strain.iter().map(|e| e[k]).collect();
        assert_eq!(numbers(&text, &format!("stress_{}_MPa", k + 1)), stress);
        assert_eq!(numbers(&text, &format!("strain_{}", k + 1)), strain);
    }
}

#[test]
fn elements_come_part_by_part_with_their_kind() {
    let text = written(&mesh(), &frame(0.0));
    assert!(text.contains(r#"<Piece NumberOfPoints="6" NumberOfCells="3">"#));
    assert_eq!(longs(&text, "connectivity"), [0, 1, 2, 3, 1, 4, 2, 3, 2, 5]);
    assert_eq!(longs(&text, "offsets"), [4, 7, 10]);
    assert_eq!(array(&text, "types"), [QUAD, TRIANGLE, TRIANGLE]);
    assert_eq!(longs(&text, "part_id"), [0, 0, 1]);
    assert_eq!(longs(&text, "wrinkle_state"), [0, 2, 1]);
}

#[test]
fn without_contact_there_is_no_contact_pressure() {
    let plain = Frame { contact_pressure_pa: Vec::new(), ..frame(0.0) };
    assert!(!written(&mesh(), &plain).contains("contact_pressure"));
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
