use super::*;
use crate::output::frame::samples;
use models::{Account, LedgerLine};

fn mesh() -> Mesh {
    Mesh { sets: [("tip".to_string(), vec![1, 2])].into(), ..samples::mesh() }
}

fn reaction(set: &str, axes: [bool; 3], t: f64) -> Reaction {
    Reaction { set: set.into(), axes, force_n: [t.sin(), t.cos(), t / 7.0], moment_nm: [t / 3.0, -t, t.tan()] }
}

fn record(step: u64) -> HistoryRecord {
    let t = step as f64 * 0.1;
    let row = |name, kind, share: f64| LedgerLine::new(name, Account::Stretch).row(kind, share * t.exp());
    let rows = vec![
        row("membrane", RowKind::Stored, 1.0),
        row("contact", RowKind::Stored, 0.1),
        row("contact", RowKind::Dissipated, 0.2),
        row("membrane", RowKind::Stored, 2.0),
        row("yarn hysteresis", RowKind::Dissipated, 3.0),
    ];
    HistoryRecord {
        step,
        time_s: t,
        dt_s: 1e-6 / 3.0,
        ledger: Ledger { kinetic_j: 0.3 * t, rows, residual_j: -1e-4 * t, external_work_j: 1.5 * t, scale_j: 2.0 * t },
        chambers: vec![ChamberState { name: "body".into(), pressure_pa: 2e3 * t.sin(), volume_m3: 1e-3 + t / 3.0 }],
        reactions: vec![reaction("end 1", [true; 3], t), reaction("side", [false, true, false], -t)],
        positions: samples::frame(t).positions,
    }
}

fn cells(text: &str, row: usize) -> std::collections::BTreeMap<&str, f64> {
    let mut lines = text.lines();
    let names = lines.next().unwrap().split(',');
    names.zip(lines.nth(row).unwrap().split(',').map(|cell| cell.parse().unwrap())).collect()
}

#[test]
fn every_number_of_the_record_is_in_its_column_to_the_bit() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("history.csv");
    let mut history = HistoryTable::open(&path, &mesh(), &["tip".into()], &[]).unwrap();
    (0..3).for_each(|step| history.append(&record(step)).unwrap());
    let text = std::fs::read_to_string(&path).unwrap();
    assert_eq!(
        text.lines().next().unwrap(),
        "time_s,step,dt_s,kinetic_J,membrane_J,contact_stored_J,contact_dissipated_J,yarn_hysteresis_J,external_work_J,\
         residual_J,residual_share,kinetic_share,body_kPa,body_cm3,end_1_x_N,end_1_y_N,end_1_z_N,\
         end_1_mx_Nm,end_1_my_Nm,end_1_mz_Nm,side_y_N,tip_dx_mm,tip_dy_mm,tip_dz_mm"
    );
    let (row, r) = (cells(&text, 2), record(2));
    assert_eq!((row["time_s"], row["step"], row["dt_s"]), (r.time_s, 2.0, r.dt_s));
    assert_eq!(row["kinetic_J"], r.ledger.kinetic_j);
    assert_eq!(row["membrane_J"], r.ledger.rows[0].energy_j + r.ledger.rows[3].energy_j);
    assert_eq!(row["contact_dissipated_J"], r.ledger.rows[2].energy_j);
    assert_eq!(row["residual_share"], r.ledger.residual_j / r.ledger.scale_j);
    assert_eq!(row["kinetic_share"], r.ledger.kinetic_j / r.ledger.scale_j);
    assert_eq!((row["body_kPa"], row["body_cm3"]), (r.chambers[0].pressure_pa * 1e-3, r.chambers[0].volume_m3 * 1e6));
    assert_eq!(row["end_1_z_N"], r.reactions[0].force_n[2]);
    assert_eq!(row["end_1_mx_Nm"], r.reactions[0].moment_nm[0]);
    assert_eq!(row["side_y_N"], r.reactions[1].force_n[1]);
    let mean_y = (r.positions[1][1] + r.positions[2][1]) / 2.0;
    assert_eq!(row["tip_dy_mm"], (mean_y - 0.05) * 1e3);
    assert_eq!(cells(&text, 0)["residual_share"], 0.0, "no work yet: no share");
}

#[test]
fn an_interrupted_and_resumed_history_has_the_bytes_of_an_uninterrupted_one() {
    let folder = tempfile::tempdir().unwrap();
    let (whole, cut) = (folder.path().join("whole.csv"), folder.path().join("cut.csv"));
    let probes = ["tip".to_string()];
    let mut history = HistoryTable::open(&whole, &mesh(), &probes, &[]).unwrap();
    (0..8).for_each(|step| history.append(&record(step)).unwrap());
    let mut history = HistoryTable::open(&cut, &mesh(), &probes, &[]).unwrap();
    (0..6).for_each(|step| history.append(&record(step)).unwrap());
    drop(history);
    let mut history = HistoryTable::open(&cut, &mesh(), &probes, &[0, 1, 2, 3].map(|step| step as f64 * 0.1)).unwrap();
    (3..8).for_each(|step| history.append(&record(step)).unwrap());
    assert_eq!(std::fs::read(&whole).unwrap(), std::fs::read(&cut).unwrap());
}

#[test]
fn a_number_that_is_not_finite_is_named_and_not_written() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("history.csv");
    let mut history = HistoryTable::open(&path, &mesh(), &["tip".into()], &[]).unwrap();
    history.append(&record(0)).unwrap();
    let before = std::fs::read(&path).unwrap();
    let mut bad = record(1);
    bad.positions[2][0] = f64::NAN;
    assert!(history.append(&bad).unwrap_err().to_string().contains("tip_dx_mm is NaN"));
    let mut bad = record(1);
    bad.ledger.rows[1].energy_j = f64::INFINITY;
    assert!(history.append(&bad).unwrap_err().to_string().contains("contact_stored_J is inf"));
    let mut short = record(1);
    short.positions.truncate(2);
    assert!(history.append(&short).is_err());
    assert_eq!(std::fs::read(&path).unwrap(), before);
}

#[test]
fn a_probe_that_is_not_in_the_mesh_is_refused_with_the_sets_that_are() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("history.csv");
    let error = HistoryTable::open(&path, &mesh(), &["tipp".into()], &[]).unwrap_err().to_string();
    assert!(error.contains("`tipp`") && error.contains("the mesh has: tip"), "{error}");
    let mut odd = mesh();
    odd.sets.insert("none".into(), Vec::new());
    odd.sets.insert("far".into(), vec![99]);
    for name in ["none", "far"] {
        let error = HistoryTable::open(&path, &odd, &[name.to_string()], &[]).unwrap_err().to_string();
        assert!(error.contains(name) && error.contains("empty or names nodes"), "{error}");
    }
}
