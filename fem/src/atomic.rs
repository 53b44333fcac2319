//! Files that are either whole or not there.

use std::fs::File;
use std::io::{BufWriter, Error, Write};
use std::path::{Path, PathBuf};

use crate::FemError;

/// Writes `path` through a file of another name in the same folder, which is renamed when it is complete. When anything
/// fails the temporary file is removed and an earlier file at `path` stays as it was.
pub(crate) fn replace(path: &Path, write: &mut dyn FnMut(&mut dyn Write) -> Result<(), Error>) -> Result<(), FemError> {
    let partial = partial_name(path);
    let written = write_whole(&partial, write).and_then(|()| std::fs::rename(&partial, path));
    written.map_err(|source| {
        // The first failure is the one to report.
        let _ = std::fs::remove_file(&partial);
        FemError::Io { path: path.to_path_buf(), source }
    })
}

/// Writes a new file and waits until the disk has it.
pub(super) fn write_whole(
    path: &Path,
    write: &mut dyn FnMut(&mut dyn Write) -> Result<(), Error>,
) -> Result<(), Error> {
    let mut out = BufWriter::new(File::create(path)?);
    write(&mut out)?;
    // Not on drop: a full disk would go unnoticed.
    out.into_inner().map_err(|failed| failed.into_error())?.sync_all()
}

/// Name of a file while it is being written: fixed, so that what a kill left behind is overwritten next time.
pub(super) fn partial_name(path: &Path) -> PathBuf {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    path.with_file_name(format!("{name}.partial"))
}

/// Makes renames in `folder` survive a power cut, where the system allows to say so.
pub(super) fn sync_folder(folder: &Path) -> Result<(), Error> {
    if cfg!(unix) { File::open(folder)?.sync_all() } else { Ok(()) }
}

/// Creates a folder and those above it.
pub(super) fn make_folder(folder: &Path) -> Result<(), FemError> {
    std::fs::create_dir_all(folder).map_err(|source| FemError::Io { path: folder.to_path_buf(), source })
}

/// Lets `room` bytes through, then fails as a full disk does.
#[cfg(test)]
pub(super) struct FullAfter<'a> {
    pub room: usize,
    pub inner: &'a mut dyn Write,
}

#[cfg(test)]
impl Write for FullAfter<'_> {
    fn write(&mut self, bytes: &[u8]) -> Result<usize, Error> {
        if self.room == 0 {
            return Err(Error::from(std::io::ErrorKind::StorageFull));
        }
        let count = self.inner.write(&bytes[..bytes.len().min(self.room)])?;
        self.room -= count;
        Ok(count)
    }
    fn flush(&mut self) -> Result<(), Error> {
        self.inner.flush()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_disk_that_fills_up_leaves_the_earlier_file_and_nothing_else() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("file");
        replace(&path, &mut |out| out.write_all(b"earlier")).unwrap();
        for room in 0..5 {
            let failed = replace(&path, &mut |inner| FullAfter { room, inner }.write_all(b"later")).unwrap_err();
            assert!(matches!(&failed, FemError::Io { path: named, .. } if *named == path), "{failed}");
            assert_eq!(std::fs::read(&path).unwrap(), b"earlier");
            assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
        }
        replace(&path, &mut |inner| FullAfter { room: 5, inner }.write_all(b"later")).unwrap();
        assert_eq!(std::fs::read(&path).unwrap(), b"later");
    }

    #[cfg(target_os = "linux")]
    #[test]
    fn a_device_without_room_is_an_error_although_the_bytes_only_reached_a_buffer() {
        let failed = write_whole(Path::new("/dev/full"), &mut |out| out.write_all(b"few")).unwrap_err();
        assert_eq!(failed.kind(), std::io::ErrorKind::StorageFull);
    }
}
