//! The frames of a run as one time series for ParaView: `run.pvd` names `frames/run_00000.vtu` and so on with their times.

use std::path::{Path, PathBuf};

use super::frame::MeshFrame;
use super::vtu::write_vtu;
use crate::output::replace;
use crate::{FemError, Mesh, Result};

/// A growing series of frames in one folder.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Series {
    folder: PathBuf,
    times_s: Vec<f64>,
}

impl Series {
    /// The series in `folder`, which is created, after the frames of `times_s` \[s\]: the list is rewritten, and later frames follow as the
    /// run reaches their times.
    pub(crate) fn open(folder: &Path, times_s: &[f64]) -> Result<Series> {
        let missing = (0..times_s.len()).map(|index| folder.join(file_name(index))).find(|path| !path.is_file());
        if let Some(path) = missing {
            return Err(FemError::Problem(format!(
                "{} is missing, a frame of the interrupted run: put the file back, or start again with --force",
                path.display()
            )));
        }
        let series = Series { folder: folder.to_path_buf(), times_s: times_s.to_vec() };
        let frames = folder.join("frames");
        std::fs::create_dir_all(&frames).map_err(|source| FemError::Io { path: frames.clone(), source })?;
        series.write_list()?;
        Ok(series)
    }

    /// Adds a frame: its file first, then the list that names it. A frame of the time of the last one replaces it.
    pub(crate) fn push(&mut self, mesh: &Mesh, frame: &MeshFrame) -> Result<PathBuf> {
        let last = self.times_s.last().copied();
        if last.is_some_and(|last| frame.time_s < last) {
            let reason = format!("a frame of {} s is in the list already", last.unwrap_or_default());
            return Err(FemError::stopped(frame.step, frame.time_s, reason));
        }
        let index = self.times_s.len() - usize::from(last == Some(frame.time_s));
        let path = self.folder.join(file_name(index));
        write_vtu(&path, mesh, frame)?;
        self.times_s.truncate(index);
        self.times_s.push(frame.time_s);
        self.write_list()?;
        Ok(path)
    }

    fn write_list(&self) -> Result<()> {
        let mut text = String::from(
            "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">\n<Collection>\n",
        );
        for (index, time) in self.times_s.iter().enumerate() {
            text += &format!("<DataSet timestep=\"{time:e}\" part=\"0\" file=\"{}\"/>\n", file_name(index));
        }
        text += "</Collection>\n</VTKFile>\n";
        replace(&self.folder.join("run.pvd"), &mut |out| out.write_all(text.as_bytes()))
    }
}

fn file_name(index: usize) -> String {
    format!("frames/run_{index:05}.vtu")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::output::frame::samples::{frame, mesh};

    const TIMES: [f64; 4] = [0.0, 0.1, 0.2, 0.30000000000000004];

    fn files(folder: &Path) -> Vec<(PathBuf, Vec<u8>)> {
        let frames = std::fs::read_dir(folder.join("frames")).unwrap().map(|entry| entry.unwrap().path());
        let mut all: Vec<_> =
            frames.chain([folder.join("run.pvd")]).map(|path| (path.clone(), std::fs::read(path).unwrap())).collect();
        all.iter_mut().for_each(|(path, _)| *path = path.strip_prefix(folder).unwrap().to_path_buf());
        all.sort();
        all
    }

    #[test]
    fn a_resumed_series_ends_with_the_same_files_as_an_uninterrupted_one() {
        let (whole, cut) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
        let mut series = Series::open(whole.path(), &[]).unwrap();
        TIMES.iter().for_each(|&t| drop(series.push(&mesh(), &frame(t)).unwrap()));
        let mut series = Series::open(cut.path(), &[]).unwrap();
        TIMES[..3].iter().for_each(|&t| drop(series.push(&mesh(), &frame(t)).unwrap()));
        let mut series = Series::open(cut.path(), &TIMES[..2]).unwrap();
        assert_eq!(series.times_s, &TIMES[..2]);
        TIMES[1..].iter().for_each(|&t| drop(series.push(&mesh(), &frame(t)).unwrap()));
        assert_eq!(files(whole.path()), files(cut.path()));
        assert_eq!(files(cut.path()).len(), 5);
    }

    #[test]
    fn a_list_only_names_frames_that_are_there() {
        let folder = tempfile::tempdir().unwrap();
        let mut series = Series::open(folder.path(), &[]).unwrap();
        series.push(&mesh(), &frame(0.0)).unwrap();
        let mut bad = frame(0.1);
        bad.positions[0][0] = f64::NAN;
        assert!(series.push(&mesh(), &bad).is_err());
        assert_eq!(series.times_s, [0.0]);
        assert!(series.push(&mesh(), &frame(-0.1)).is_err());
    }

    #[test]
    fn a_lost_list_is_made_again_and_a_lost_frame_is_named() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("run.pvd");
        let mut series = Series::open(folder.path(), &[]).unwrap();
        TIMES.iter().for_each(|&t| drop(series.push(&mesh(), &frame(t)).unwrap()));
        let good = std::fs::read_to_string(&path).unwrap();
        std::fs::write(&path, &good[..good.len() - 9]).unwrap();
        assert_eq!(Series::open(folder.path(), &TIMES).unwrap(), series);
        assert_eq!(std::fs::read_to_string(&path).unwrap(), good);
        std::fs::remove_file(folder.path().join(file_name(2))).unwrap();
        let error = Series::open(folder.path(), &TIMES).unwrap_err().to_string();
        assert!(error.contains("run_00002.vtu is missing") && error.contains("--force"), "{error}");
        assert!(Series::open(folder.path(), &TIMES[..2]).is_ok(), "a later one is rewritten");
    }
}
