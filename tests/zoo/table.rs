//! Tables of bad inputs, one TOML file per kind of file or command line.

use crate::case::{Broken, Case};
use crate::common;
use serde::Deserialize;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// A kind of file, or of command line.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Table {
    #[serde(skip)]
    pub name: String,
    /// What is broken, and the good contents of it: `shipped:NAME`, `case:NAME`, `set:SET/FILE` or a file of the repository.
    #[serde(default)]
    pub file: String,
    #[serde(default)]
    pub good: String,
    /// Further files of the folder, by name, with their good contents.
    #[serde(default)]
    pub beside: BTreeMap<String, String>,
    /// Commands that make the folder first.
    #[serde(default)]
    pub prepare: Vec<String>,
    /// Command line of `ibr` that reads the file.
    #[serde(default)]
    pub command: String,
    /// Exit code of a refusal, unless a case states another.
    #[serde(default = "refused")]
    pub code: i32,
    /// Which of the broken files that any reader meets are read all the same.
    #[serde(default)]
    pub reads: Vec<String>,
    /// Which of them make no sense here.
    #[serde(default)]
    pub skips: Vec<String>,
    /// Cases of this kind, each with one fault.
    #[serde(default)]
    pub bad: Vec<Bad>,
}

/// One fault, and how the good file is changed to have it.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Bad {
    name: String,
    /// A change of the good file: what stood there, and what stands there now. The first must be there.
    #[serde(default)]
    replace: Vec<[String; 2]>,
    /// The same for a piece that is there so many times.
    many: Option<(String, String, usize)>,
    /// In place of the good file.
    text: Option<String>,
    /// Text that is appended to the good file.
    append: Option<String>,
    /// Bytes in hex, and from where.
    patch: Option<(usize, String)>,
    /// Good contents in place of the table's.
    good: Option<String>,
    /// Command line in place of the table's.
    command: Option<String>,
    /// Exit code in place of the table's.
    code: Option<i32>,
    /// What the message has to say.
    says: Vec<String>,
}

fn refused() -> i32 {
    3
}

/// Reads all tables of this folder, in the order of their names.
pub(crate) fn tables() -> Vec<Table> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/zoo");
    let files = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let mut files: Vec<PathBuf> = files.filter(|path| path.extension().is_some_and(|e| e == "toml")).collect();
    files.sort();
    let read = |path: &PathBuf| {
        let text = std::fs::read_to_string(path).unwrap();
        let table: Table = toml::from_str(&text).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
        Table { name: path.file_stem().unwrap().to_string_lossy().into_owned(), ..table }
    };
    files.iter().map(read).collect()
}

/// Good contents as bytes, by `shipped:NAME`, `case:NAME`, `set:SET/FILE`, `text:TEXT` or a path.
fn contents(good: &str) -> Vec<u8> {
    match good.split_once(':') {
        Some(("shipped", name)) => models::shipped(name).unwrap().into(),
        Some(("case", name)) => fem::case::shipped_case(name).unwrap().into(),
        Some(("set", file)) => {
            let (set, file) = file.split_once('/').unwrap();
            data::set_file(set, file).unwrap().into()
        }
        Some(("text", text)) => text.into(),
        _ => std::fs::read(Path::new(env!("CARGO_MANIFEST_DIR")).join(good)).unwrap_or_else(|e| panic!("{good}: {e}")),
    }
}

impl Table {
    /// Its own list, and what can be wrong with any file.
    pub(crate) fn cases(&self) -> Vec<Case> {
        let own = self.bad.iter().map(|bad| self.own(bad));
        if self.file.is_empty() {
            return own.collect();
        }
        let good = contents(&self.good);
        let right = Case { name: format!("{}: the good file", self.name), code: 0, ..self.base() };
        let right = Case { broken: Broken::Bytes(good.clone()), ..right };
        let right = (!self.skips.iter().any(|skipped| skipped == "the good file")).then_some(right);
        own.chain(right).chain(common::cases(self, &self.base(), &good)).collect()
    }

    /// The folder around the file, and the command.
    fn base(&self) -> Case {
        Case {
            name: self.name.clone(),
            file: self.file.clone(),
            broken: Broken::Bytes(Vec::new()),
            beside: self.beside.iter().map(|(name, good)| (name.clone(), contents(good))).collect(),
            prepare: self.prepare.clone(),
            command: self.command.clone(),
            code: self.code,
            says: Vec::new(),
        }
    }

    fn own(&self, bad: &Bad) -> Case {
        let good = bad.good.as_ref().unwrap_or(&self.good);
        let broken = if self.file.is_empty() { Vec::new() } else { bad.broken(contents(good)) };
        Case {
            name: format!("{}: {}", self.name, bad.name),
            broken: Broken::Bytes(broken),
            command: bad.command.clone().unwrap_or(self.command.clone()),
            code: bad.code.unwrap_or(self.code),
            says: bad.says.clone(),
            ..self.base()
        }
    }
}

impl Bad {
    fn broken(&self, good: Vec<u8>) -> Vec<u8> {
        let mut bytes = self.text.as_ref().map_or(good, |text| text.clone().into_bytes());
        for [old, new] in &self.replace {
            let at = find(&bytes, old.as_bytes()).unwrap_or_else(|| panic!("{}: `{old}` is not there", self.name));
            bytes.splice(at..at + old.len(), new.bytes());
        }
        if let Some((old, piece, times)) = &self.many {
            let at = find(&bytes, old.as_bytes()).unwrap_or_else(|| panic!("{}: `{old}` is not there", self.name));
            bytes.splice(at..at + old.len(), piece.repeat(*times).bytes());
        }
        if let Some((at, hex)) = &self.patch {
            let new: Vec<u8> =
                (0..hex.len() / 2).map(|k| u8::from_str_radix(&hex[2 * k..2 * k + 2], 16).unwrap()).collect();
            bytes[*at..at + new.len()].copy_from_slice(&new);
        }
        bytes.extend(self.append.iter().flat_map(|text| text.bytes()));
        bytes
    }
}

fn find(bytes: &[u8], piece: &[u8]) -> Option<usize> {
    if piece.is_empty() { Some(0) } else { bytes.windows(piece.len()).position(|window| window == piece) }
}
