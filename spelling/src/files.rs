//! Files read whole, and files written whole: a reader, a full disk or a kill never leaves half of one.

use std::fs::File;
use std::io::{BufWriter, Error, ErrorKind, Read, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};

/// Most bytes of a text that people write: a scenario, a case, a description.
pub const MOST_TEXT: u64 = 16 << 20;
/// Most bytes of a file that programs write: tracks, logs, meshes.
pub const MOST_DATA: u64 = 4 << 30;
/// Most bytes of a pipe, whose length is not known before.
const MOST_STREAM: u64 = 64 << 20;

/// The bytes of a file of at most `most` bytes, so that an endless file is an error and does not fill the memory.
///
/// # Errors
/// It cannot be read, or is larger.
pub fn read_whole(path: &Path, most: u64) -> Result<Vec<u8>, Error> {
    let file = File::open(path)?;
    let about = file.metadata()?;
    let (most, expected) = if about.is_file() { (most, about.len().min(most)) } else { (most.min(MOST_STREAM), 0) };
    let mut bytes = Vec::with_capacity(expected as usize + 1);
    file.take(most + 1).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > most {
        return Err(Error::new(ErrorKind::FileTooLarge, format!("it is larger than {} MiB", most >> 20)));
    }
    Ok(bytes)
}

/// End of the name of a file that is being written: `.NAME.HOST-PROCESS-COUNT.partial`.
const PARTIAL: &str = ".partial";
static BEGUN: AtomicUsize = AtomicUsize::new(0);

/// Writes `path` through a file of another name in the same folder, which is renamed when the disk has all of it. When anything fails
/// that file is removed and an earlier one at `path` stays as it was. Several processes may write the same file.
///
/// # Errors
/// The folder does not exist or is not writable, or the disk is full.
pub fn replace(path: &Path, write: &mut dyn FnMut(&mut dyn Write) -> Result<(), Error>) -> Result<(), Error> {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let count = BEGUN.fetch_add(1, Ordering::Relaxed);
    let partial = path.with_file_name(format!(".{name}.{}-{}-{count}{PARTIAL}", host(), std::process::id()));
    let written = write_new(&partial, write).and_then(|()| std::fs::rename(&partial, path));
    written.inspect_err(|_| {
        // The first failure is the one to report.
        let _ = std::fs::remove_file(&partial);
    })
}

/// Writes a new file and waits until the disk has it. Errors as for [`replace`].
pub fn write_new(path: &Path, write: &mut dyn FnMut(&mut dyn Write) -> Result<(), Error>) -> Result<(), Error> {
    let mut out = BufWriter::new(File::create(path)?);
    write(&mut out)?;
    // Not on drop: a full disk would go unnoticed.
    out.into_inner().map_err(std::io::IntoInnerError::into_error)?.sync_all()
}

/// Whether a name belongs to a file that was being written, also by earlier versions.
pub fn is_partial(name: &str) -> bool {
    name.ends_with(PARTIAL) || (name.starts_with('.') && name.ends_with(".tmp"))
}

/// Removes the files that killed processes of this machine were writing to `folder` under a name that `is_ours` accepts.
pub fn clear(folder: &Path, is_ours: &dyn Fn(&str) -> bool) {
    for entry in std::fs::read_dir(folder).into_iter().flatten().flatten() {
        let name = entry.file_name().to_string_lossy().into_owned();
        let writer = name.strip_suffix(PARTIAL).and_then(|whole| whole.strip_prefix('.')?.rsplit_once('.'));
        let Some((_, writer)) = writer.filter(|(whole, _)| is_ours(whole)) else { continue };
        let process = writer.strip_prefix(&host()).and_then(|rest| rest.strip_prefix('-')?.split('-').next());
        if process.is_some_and(is_gone) {
            // A file that cannot be removed does no harm.
            let _ = std::fs::remove_file(entry.path());
        }
    }
}

/// Whether no process of this machine has the number, where the system can answer.
pub(crate) fn is_gone(process: &str) -> bool {
    let all = Path::new("/proc");
    let is_number = !process.is_empty() && process.bytes().all(|byte| byte.is_ascii_digit());
    is_number && all.join("self").exists() && !all.join(process).exists()
}

/// Name of this machine, without points.
fn host() -> String {
    let name = std::fs::read_to_string("/proc/sys/kernel/hostname").unwrap_or_default();
    name.trim().replace('.', "_")
}

const SEAL: usize = 4;

/// Bytes followed by their CRC-32, little-endian.
pub fn sealed(mut bytes: Vec<u8>) -> Vec<u8> {
    bytes.extend(crc32fast::hash(&bytes).to_le_bytes());
    bytes
}

/// The bytes that were [`sealed`]; `None` if any of them was lost or changed.
///
/// ```
/// let mut bytes = spelling::files::sealed(b"abc".to_vec());
/// assert_eq!(spelling::files::unsealed(&bytes), Some(&b"abc"[..]));
/// bytes[0] = b'x';
/// assert_eq!(spelling::files::unsealed(&bytes), None);
/// ```
pub fn unsealed(bytes: &[u8]) -> Option<&[u8]> {
    let (body, check) = bytes.split_last_chunk::<SEAL>()?;
    (crc32fast::hash(body) == u32::from_le_bytes(*check)).then_some(body)
}

/// Makes renames in `folder` survive a power cut, where the system can.
///
/// # Errors
/// The folder cannot be opened.
pub fn sync_folder(folder: &Path) -> Result<(), Error> {
    if cfg!(unix) { File::open(folder)?.sync_all() } else { Ok(()) }
}

/// The folder of a file: the process's own for a bare name.
pub fn folder_of(path: &Path) -> PathBuf {
    let above = path.parent().filter(|above| !above.as_os_str().is_empty());
    above.unwrap_or(Path::new(".")).to_path_buf()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_is_read_up_to_its_limit() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("file");
        std::fs::write(&path, [7; 100]).unwrap();
        assert_eq!(read_whole(&path, 100).unwrap().len(), 100);
        assert_eq!(read_whole(&path, 99).unwrap_err().kind(), ErrorKind::FileTooLarge);
        std::fs::remove_file(&path).unwrap();
        assert_eq!(read_whole(&path, 99).unwrap_err().kind(), ErrorKind::NotFound);
    }

    #[test]
    #[cfg(target_os = "linux")]
    fn an_endless_file_is_an_error() {
        let error = read_whole(Path::new("/dev/zero"), MOST_DATA).unwrap_err();
        assert!(error.to_string().contains("larger than 64 MiB"), "{error}");
    }

    /// Lets `room` bytes through, then fails as a full disk does.
    struct FullAfter<'a> {
        room: usize,
        inner: &'a mut dyn Write,
    }

    impl Write for FullAfter<'_> {
        fn write(&mut self, bytes: &[u8]) -> Result<usize, Error> {
            if self.room == 0 {
                return Err(Error::from(ErrorKind::StorageFull));
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
            assert_eq!(failed.kind(), ErrorKind::StorageFull);
            assert_eq!(std::fs::read(&path).unwrap(), b"earlier");
            assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
        }
        replace(&path, &mut |inner| FullAfter { room: 5, inner }.write_all(b"later")).unwrap();
        assert_eq!(std::fs::read(&path).unwrap(), b"later");
    }

    #[cfg(target_os = "linux")]
    #[test]
    fn a_device_without_room_is_an_error_although_the_bytes_only_reached_a_buffer() {
        let failed = write_new(Path::new("/dev/full"), &mut |out| out.write_all(b"few")).unwrap_err();
        assert_eq!(failed.kind(), ErrorKind::StorageFull);
    }

    #[test]
    fn every_flipped_bit_breaks_the_seal() {
        let whole = sealed(b"numbers".to_vec());
        assert_eq!(unsealed(&whole), Some(&b"numbers"[..]));
        for bit in 0..8 * whole.len() {
            let mut bytes = whole.clone();
            bytes[bit / 8] ^= 1 << (bit % 8);
            assert_eq!(unsealed(&bytes), None, "bit {bit}");
        }
        assert_eq!((unsealed(&whole[..whole.len() - 1]), unsealed(b"")), (None, None));
    }

    #[cfg(target_os = "linux")]
    #[test]
    fn files_of_killed_processes_are_removed_and_those_of_others_stay() {
        let folder = tempfile::tempdir().unwrap();
        let gone = format!(".a.part.{}-4194999-0.partial", host());
        let kept = [
            format!(".a.part.{}-{}-0.partial", host(), std::process::id()),
            ".a.part.another-4194999-0.partial".to_string(),
            format!(".b.txt.{}-4194999-0.partial", host()),
            "4194999.partial".to_string(),
        ];
        kept.iter().chain([&gone]).for_each(|name| std::fs::write(folder.path().join(name), "half").unwrap());
        clear(folder.path(), &|name| name.ends_with(".part"));
        assert!(!folder.path().join(gone).exists());
        assert!(kept.iter().all(|name| folder.path().join(name).exists()));
    }
}
