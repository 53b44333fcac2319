use super::*;

/// Lets `room` bytes through, then fails as a full disk does.
pub(crate) struct FullAfter<'a> {
    pub room: usize,
    pub inner: &'a mut dyn Write,
}

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
