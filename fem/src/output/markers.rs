//! `markers.csv`: what a camera would see, in the columns of a dataset, so that a run can be compared like a measurement.
//!
//! A marker is the mean of a node set named `marker_<label>`. x and y are those of the mesh: x along the undeformed body
//! from its base, y towards the actuator. Rows belong to steady pressures: write them at the end of each hold.
//!
//! | column | meaning |
//! |---|---|
//! | `run`, `actuator`, `phase`, `marker` | labels |
//! | `t_s`, `step` | time \[s\], steps done |
//! | `p_body_kpa`, `p_act_kpa` | gauge pressures |
//! | `x_mm`, `y_mm`, `z_mm` | position |
//! | `s_mm` | station on the undeformed body: x of the marker in the reference shape |

use std::path::Path;

use super::history::mean;
use super::table::{Table, check_label, number};
use crate::{FemError, Mesh};

const PREFIX: &str = "marker_";
const HEADER: &str = "run,actuator,t_s,p_body_kpa,p_act_kpa,phase,marker,x_mm,y_mm,s_mm,z_mm,step";

/// What was done to the actuator pressure to reach a hold.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Phase {
    /// Raised; also the first hold.
    Load,
    /// Unchanged.
    Hold,
    /// Lowered.
    Unload,
}

/// One steady moment.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Moment {
    /// Steps done.
    pub step: u64,
    /// Time \[s\].
    pub time_s: f64,
    /// Body gauge pressure \[Pa\].
    pub body_pa: f64,
    /// Actuator gauge pressure \[Pa\].
    pub actuator_pa: f64,
    /// How the hold was reached.
    pub phase: Phase,
}

/// The growing file.
#[derive(Debug)]
pub struct Markers {
    table: Table,
    run: String,
    actuator: String,
    markers: Vec<Marker>,
}

#[derive(Debug)]
struct Marker {
    label: String,
    nodes: Vec<u32>,
    station_m: f64,
}

impl Markers {
    /// An empty table at `path` for the markers of `mesh`; `run` and `actuator` fill their columns.
    ///
    /// # Errors
    /// [`FemError::Problem`] for a mesh without markers, an empty marker, or a label that would break the table;
    /// [`FemError::Io`].
    pub fn create(path: &Path, mesh: &Mesh, run: &str, actuator: &str) -> Result<Markers, FemError> {
        let markers = find(mesh, run, actuator)?;
        Ok(Markers { table: Table::create(path)?, run: run.into(), actuator: actuator.into(), markers })
    }

    /// Goes on after `step` of the checkpoint; later rows are dropped.
    ///
    /// # Errors
    /// As [`Markers::create`]; [`FemError::MeshFile`] if the file was edited into something else.
    pub fn resume(path: &Path, mesh: &Mesh, run: &str, actuator: &str, step: u64) -> Result<Markers, FemError> {
        let markers = find(mesh, run, actuator)?;
        Ok(Markers { table: Table::resume(path, step)?, run: run.into(), actuator: actuator.into(), markers })
    }

    /// True if the mesh has markers.
    pub fn any(mesh: &Mesh) -> bool {
        mesh.sets.keys().any(|name| name.starts_with(PREFIX))
    }

    /// Adds one row per marker; a step that is in the file already is not written again.
    ///
    /// # Errors
    /// [`FemError::Stopped`] if a number is not finite; [`FemError::Problem`] for another mesh; [`FemError::Io`].
    pub fn append(&mut self, at: &Moment, positions: &[[f64; 3]]) -> Result<(), FemError> {
        let mut rows = String::new();
        for Marker { label, nodes, station_m } in &self.markers {
            let point = mean(nodes, |node| positions.get(node).copied()).ok_or_else(|| {
                FemError::Problem(format!("marker `{label}`: these positions belong to another mesh"))
            })?;
            let state = [at.time_s, at.body_pa * 1e-3, at.actuator_pa * 1e-3];
            let place = [point[0], point[1], *station_m, point[2]].map(|length| length * 1e3);
            if !state.iter().chain(&place).all(|value| value.is_finite()) {
                let reason = format!("marker `{label}` is at {point:?} m");
                return Err(FemError::Stopped { step: at.step, time_s: at.time_s, reason });
            }
            let (state, place) = (state.map(number).join(","), place.map(number).join(","));
            let (run, actuator, phase) = (&self.run, &self.actuator, word(at.phase));
            rows += &format!("{run},{actuator},{state},{phase},{label},{place},{}\n", at.step);
        }
        self.table.append(at.step, HEADER, &rows)
    }

    /// Waits until the disk has all rows; to be called before a checkpoint is written.
    ///
    /// # Errors
    /// [`FemError::Io`].
    pub fn sync(&self) -> Result<(), FemError> {
        self.table.sync()
    }
}

fn word(phase: Phase) -> &'static str {
    match phase {
        Phase::Load => "load",
        Phase::Hold => "hold",
        Phase::Unload => "unload",
    }
}

/// Markers in the order of their stations.
fn find(mesh: &Mesh, run: &str, actuator: &str) -> Result<Vec<Marker>, FemError> {
    check_label(run, "the run")?;
    check_label(actuator, "the actuator")?;
    let mut markers = Vec::new();
    for (name, nodes) in &mesh.sets {
        let Some(label) = name.strip_prefix(PREFIX) else { continue };
        check_label(label, "the marker")?;
        let reference = mean(nodes, |node| mesh.points.get(node).copied()).ok_or_else(|| {
            FemError::Problem(format!("node set `{name}` is empty or names nodes that are not in the mesh"))
        })?;
        markers.push(Marker { label: label.into(), nodes: nodes.clone(), station_m: reference[0] });
    }
    if markers.is_empty() {
        return Err(FemError::Problem(format!(
            "there are no markers: name node sets `{PREFIX}1`, `{PREFIX}2` and so on"
        )));
    }
    markers.sort_by(|a, b| a.station_m.total_cmp(&b.station_m));
    Ok(markers)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::output::frame::samples;

    fn mesh() -> Mesh {
        let sets = [("marker_tip", vec![4]), ("marker_1", vec![0, 3]), ("clamp", vec![5])];
        Mesh { sets: sets.map(|(name, nodes)| (name.to_string(), nodes)).into(), ..samples::mesh() }
    }

    fn moment(step: u64) -> Moment {
        Moment { step, time_s: step as f64 * 0.1, body_pa: 2e3, actuator_pa: 1e4, phase: Phase::Load }
    }

    #[test]
    fn the_table_is_a_dataset_sorted_by_station() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("markers.csv");
        let mut markers = Markers::create(&path, &mesh(), "fe", "epam").unwrap();
        markers.append(&moment(5), &mesh().points).unwrap();
        markers.append(&Moment { phase: Phase::Unload, ..moment(7) }, &mesh().points).unwrap();
        drop(markers);
        let mut markers = Markers::resume(&path, &mesh(), "fe", "epam", 5).unwrap();
        markers.append(&Moment { phase: Phase::Hold, ..moment(6) }, &mesh().points).unwrap();
        let text = std::fs::read_to_string(&path).unwrap();
        let wanted = "run,actuator,t_s,p_body_kpa,p_act_kpa,phase,marker,x_mm,y_mm,s_mm,z_mm,step\n\
            fe,epam,5e-1,2e0,1e1,load,1,0e0,5e1,0e0,0e0,5\nfe,epam,5e-1,2e0,1e1,load,tip,2e2,5e1,2e2,0e0,5\n\
            fe,epam,6.000000000000001e-1,2e0,1e1,hold,1,0e0,5e1,0e0,0e0,6\n\
            fe,epam,6.000000000000001e-1,2e0,1e1,hold,tip,2e2,5e1,2e2,0e0,6\n";
        assert_eq!(text, wanted);
    }

    #[test]
    fn missing_empty_and_unprintable_markers_are_refused() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("markers.csv");
        let refuse = |mesh: &Mesh, run: &str| Markers::create(&path, mesh, run, "epam").unwrap_err().to_string();
        assert!(refuse(&samples::mesh(), "fe").contains("name node sets `marker_1`"));
        assert!(!Markers::any(&samples::mesh()) && Markers::any(&mesh()));
        assert!(refuse(&mesh(), "a,b").contains("`a,b`"));
        for (name, nodes) in [("marker_2", vec![]), ("marker_2", vec![77]), ("marker_a\nb", vec![0])] {
            let mut bad = mesh();
            bad.sets.insert(name.into(), nodes);
            assert!(refuse(&bad, "fe").contains(&name[7..]), "{}", refuse(&bad, "fe"));
        }
        let mut markers = Markers::create(&path, &mesh(), "fe", "epam").unwrap();
        let mut bad = mesh().points;
        bad[4][1] = f64::NAN;
        assert!(markers.append(&moment(1), &bad).unwrap_err().to_string().contains("`tip`"));
        assert_eq!(std::fs::read_to_string(&path).unwrap(), "");
    }
}
