//! What can be wrong with any file.

use crate::case::{Broken, Case};
use crate::table::Table;

type Break = fn(&[u8]) -> Broken;

/// By name: how a good file is broken.
const WRONG: &[(&str, Break)] = &[
    ("empty", |_| Broken::Bytes(Vec::new())),
    ("empty lines", |_| Broken::Bytes(b"\n\n  \n".to_vec())),
    ("random bytes", |_| Broken::Bytes((0..=255).rev().cycle().take(5000).collect())),
    ("UTF-16", |good| Broken::Bytes(utf16(good))),
    ("zero byte", |good| Broken::Bytes(inside(good, b"\0"))),
    ("not UTF-8", |good| Broken::Bytes(inside(good, b"\xb5"))),
    ("escape", |good| Broken::Bytes(inside(good, b"\x1b[31m\x1b]0;title\x07"))),
    ("long line", |good| Broken::Bytes(inside(good, &b"x".repeat(2 << 20)))),
    ("workbook", |good| Broken::Bytes([b"PK\x03\x04\x14\0\x06\0", good].concat())),
    ("only CR", |good| Broken::Bytes(with_ends(good, b"\r"))),
    ("CRLF", |good| Broken::Bytes(with_ends(good, b"\r\n"))),
    ("BOM", |good| Broken::Bytes([b"\xef\xbb\xbf", good].concat())),
    ("folder", |_| Broken::Folder),
    ("dangling link", |_| Broken::Link("nowhere")),
    ("loop of links", |_| Broken::Link("loop")),
];

/// All of them for one kind of file. What is read all the same must give the same answer as the good file.
pub(crate) fn cases(table: &Table, base: &Case, good: &[u8]) -> Vec<Case> {
    let wanted = WRONG.iter().filter(|(name, _)| !table.skips.iter().any(|skipped| skipped == name));
    let case = |(name, make): &(&str, Break)| {
        let broken = match make(good) {
            Broken::Bytes(bytes) if table.reads.iter().any(|read| read == name) => Broken::Reads(bytes, good.to_vec()),
            Broken::Link("loop") => Broken::Link(Box::leak(base.file.clone().into_boxed_str())),
            broken => broken,
        };
        let says = vec![base.file.clone()];
        Case { name: format!("{}: {name}", base.name), broken, says, ..base.clone() }
    };
    wanted.map(case).collect()
}

/// The bytes with others after their first third, in the middle of a word if there is one.
fn inside(good: &[u8], more: &[u8]) -> Vec<u8> {
    let from = good.len() / 3;
    let at = good[from..]
        .windows(2)
        .position(|pair| pair.iter().all(u8::is_ascii_alphabetic))
        .map_or(from, |k| from + k + 1);
    [&good[..at], more, &good[at..]].concat()
}

fn with_ends(good: &[u8], end: &[u8]) -> Vec<u8> {
    good.iter().flat_map(|byte| if *byte == b'\n' { end } else { std::slice::from_ref(byte) }).copied().collect()
}

fn utf16(good: &[u8]) -> Vec<u8> {
    let text = String::from_utf8_lossy(good);
    std::iter::once(0xfeff).chain(text.encode_utf16()).flat_map(u16::to_le_bytes).collect()
}
