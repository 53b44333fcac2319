//! ZIP archives with stored entries: what a functional mock-up unit is.
//!
//! Format: APPNOTE 6.3.10 of PKWARE, local headers, then the central directory. Times are 1980-01-01, so equal files give equal bytes.

/// Name and content of every entry as an archive. Names are UTF-8; sizes are below 4 GiB.
pub(crate) fn stored(files: &[(String, Vec<u8>)]) -> Vec<u8> {
    let (mut archive, mut directory) = (Vec::new(), Vec::new());
    for (name, bytes) in files {
        let at = archive.len() as u32;
        let common = common(name, bytes);
        archive.extend([&0x0403_4b50_u32.to_le_bytes(), &common[..], name.as_bytes(), bytes].concat());
        // Version 2.0 made it; no comment, disk 0, no attributes.
        directory.extend([&0x0201_4b50_u32.to_le_bytes()[..], &[20, 0], &common, &[0; 10], &at.to_le_bytes()].concat());
        directory.extend(name.as_bytes());
    }
    let (count, start) = ((files.len() as u16).to_le_bytes(), archive.len() as u32);
    let size = (directory.len() as u32).to_le_bytes();
    archive.extend(directory);
    let end = [&0x0605_4b50_u32.to_le_bytes()[..], &[0; 4], &count, &count, &size, &start.to_le_bytes(), &[0; 2]];
    archive.extend(end.concat());
    archive
}

/// What both headers of an entry have: version, UTF-8 flag, no compression, time and date, checksum, sizes, lengths of the name and
/// of nothing more.
fn common(name: &str, bytes: &[u8]) -> Vec<u8> {
    let size = (bytes.len() as u32).to_le_bytes();
    let start: &[u8] = &[20, 0, 0, 8, 0, 0, 0, 0, 0x21, 0];
    let name = (name.len() as u16).to_le_bytes();
    [start, &crc32fast::hash(bytes).to_le_bytes(), &size, &size, &name, &[0; 2]].concat()
}
