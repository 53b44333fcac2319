//! Files that people give, read whole.

use std::fs::File;
use std::io::{Error, ErrorKind, Read};
use std::path::Path;

/// Most bytes of a text that people write: a scenario, a case, a description.
pub const MOST_TEXT: u64 = 16 << 20;
/// Most bytes of a file that programs write: tracks, logs, meshes.
pub const MOST_DATA: u64 = 4 << 30;
/// Of what is no file on a disk, such as a pipe, whose length nobody knows before.
const MOST_STREAM: u64 = 64 << 20;

/// The bytes of a file of at most `most` bytes: a file that never ends is told, and does not fill the memory.
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_is_read_up_to_its_limit() {
        let path = std::env::temp_dir().join(format!("ibr-whole-{}", std::process::id()));
        std::fs::write(&path, [7; 100]).unwrap();
        assert_eq!(read_whole(&path, 100).unwrap().len(), 100);
        assert_eq!(read_whole(&path, 99).unwrap_err().kind(), ErrorKind::FileTooLarge);
        std::fs::remove_file(&path).unwrap();
        assert_eq!(read_whole(&path, 99).unwrap_err().kind(), ErrorKind::NotFound);
    }

    #[test]
    #[cfg(target_os = "linux")]
    fn a_file_that_never_ends_is_told() {
        let error = read_whole(Path::new("/dev/zero"), MOST_DATA).unwrap_err();
        assert!(error.to_string().contains("larger than 64 MiB"), "{error}");
    }
}
