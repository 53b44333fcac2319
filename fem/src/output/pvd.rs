//! The frames of a run as one time series for ParaView: `run.pvd` names `frames/run_00000.vtu` and so on with their times.

use std::path::{Path, PathBuf};

use super::atomic::{make_folder, replace};
use super::frame::Frame;
use super::vtu::write_vtu;
use crate::{FemError, Mesh};

/// A growing series of frames in one folder.
#[derive(Debug, Clone, PartialEq)]
pub struct Series {
    folder: PathBuf,
    times_s: Vec<f64>,
}

impl Series {
    /// A series without frames in `folder`, which is created. A series of an earlier run in it is replaced.
    ///
    /// # Errors
    /// [`FemError::Io`].
    pub fn create(folder: &Path) -> Result<Series, FemError> {
        let series = Series { folder: folder.to_path_buf(), times_s: Vec::new() };
        make_folder(&folder.join("frames"))?;
        series.write_list()?;
        Ok(series)
    }

    /// Goes on with the series in `folder` from `time_s` \[s\]: later frames are dropped from the list and written anew as
    /// the run reaches them. Without a list it starts one.
    ///
    /// # Errors
    /// [`FemError::Io`]; [`FemError::MeshFile`] if the list was edited into something else.
    pub fn resume(folder: &Path, time_s: f64) -> Result<Series, FemError> {
        let path = folder.join("run.pvd");
        if !path.exists() {
            return Series::create(folder);
        }
        let text = std::fs::read_to_string(&path).map_err(|source| FemError::Io { path: path.clone(), source })?;
        let mut times_s = parse(&text).map_err(|line| FemError::MeshFile {
            path,
            line,
            message: "not a list of frames as this program writes it: delete the file to start a new list".into(),
        })?;
        times_s.retain(|&t| t <= time_s);
        let series = Series { folder: folder.to_path_buf(), times_s };
        make_folder(&folder.join("frames"))?;
        series.write_list()?;
        Ok(series)
    }

    /// Adds a frame: its file first, then the list that names it. A frame of the time of the last one replaces it.
    ///
    /// # Errors
    /// Those of [`write_vtu`]; [`FemError::Stopped`] for a frame earlier than the last one.
    pub fn push(&mut self, mesh: &Mesh, frame: &Frame) -> Result<PathBuf, FemError> {
        let last = self.times_s.last().copied();
        if last.is_some_and(|last| frame.time_s < last) {
            let reason = format!("a frame of {} s is in the list already", last.unwrap_or_default());
            return Err(FemError::Stopped { step: frame.step, time_s: frame.time_s, reason });
        }
        let index = if last == Some(frame.time_s) { self.times_s.len() - 1 } else { self.times_s.len() };
        let path = self.folder.join(file_name(index));
        write_vtu(&path, mesh, frame)?;
        self.times_s.truncate(index);
        self.times_s.push(frame.time_s);
        self.write_list()?;
        Ok(path)
    }

    /// Times of the frames so far \[s\].
    pub fn times_s(&self) -> &[f64] {
        &self.times_s
    }

    fn write_list(&self) -> Result<(), FemError> {
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

/// Times of a list; the number of the first line that is not as [`Series`] writes it.
fn parse(text: &str) -> Result<Vec<f64>, usize> {
    let mut times: Vec<f64> = Vec::new();
    for (at, line) in text.lines().enumerate().filter(|(_, line)| line.starts_with("<DataSet")) {
        let time = line.strip_prefix("<DataSet timestep=\"").and_then(|rest| rest.split_once('"'));
        let time = time.filter(|(_, rest)| rest.contains(&format!("\"{}\"", file_name(times.len()))));
        let time = time.and_then(|(number, _)| number.parse().ok()).ok_or(at + 1)?;
        if times.last().is_some_and(|&last| time <= last) {
            return Err(at + 1);
        }
        times.push(time);
    }
    if text.ends_with("</VTKFile>\n") { Ok(times) } else { Err(text.lines().count()) }
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
        let mut series = Series::create(whole.path()).unwrap();
        TIMES.iter().for_each(|&t| drop(series.push(&mesh(), &frame(t)).unwrap()));
        let mut series = Series::create(cut.path()).unwrap();
        TIMES[..3].iter().for_each(|&t| drop(series.push(&mesh(), &frame(t)).unwrap()));
        let mut series = Series::resume(cut.path(), 0.15).unwrap();
        assert_eq!(series.times_s(), &TIMES[..2]);
        TIMES[1..].iter().for_each(|&t| drop(series.push(&mesh(), &frame(t)).unwrap()));
        assert_eq!(files(whole.path()), files(cut.path()));
        assert_eq!(files(cut.path()).len(), 5);
    }

    #[test]
    fn a_list_only_names_frames_that_are_there() {
        let folder = tempfile::tempdir().unwrap();
        let mut series = Series::create(folder.path()).unwrap();
        series.push(&mesh(), &frame(0.0)).unwrap();
        let mut bad = frame(0.1);
        bad.positions[0][0] = f64::NAN;
        assert!(series.push(&mesh(), &bad).is_err());
        assert_eq!(series.times_s(), [0.0]);
        assert!(series.push(&mesh(), &frame(-0.1)).is_err());
        assert_eq!(Series::resume(folder.path(), 9.0).unwrap().times_s(), [0.0]);
    }

    #[test]
    fn a_foreign_or_cut_list_is_refused_with_its_line() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("run.pvd");
        let mut series = Series::create(folder.path()).unwrap();
        TIMES.iter().for_each(|&t| drop(series.push(&mesh(), &frame(t)).unwrap()));
        let good = std::fs::read_to_string(&path).unwrap();
        for bad in [good.replace("run_00001", "other"), good.replace("1e-1", "x"), good[..good.len() - 9].to_string()] {
            std::fs::write(&path, bad).unwrap();
            let error = Series::resume(folder.path(), 1.0).unwrap_err();
            assert!(error.to_string().contains("delete the file"), "{error}");
        }
    }
}
