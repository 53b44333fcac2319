//! What both test binaries share: a folder of its own for every test, and `ibr` run in it.

use sha2::{Digest, Sha256};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// A folder that is deleted with the test.
pub(crate) struct Folder(tempfile::TempDir);

/// What one run of `ibr` did.
pub(crate) struct Ran {
    /// Exit code; -1 if a signal ended it.
    pub code: i32,
    pub stdout: String,
    pub stderr: String,
}

pub(crate) fn repository() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

impl Folder {
    pub(crate) fn new() -> Folder {
        Folder(tempfile::tempdir().expect("a temporary folder"))
    }

    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    /// Writes a file, with the folders above it.
    pub(crate) fn write(&self, name: &str, bytes: impl AsRef<[u8]>) {
        let path = self.path(name);
        std::fs::create_dir_all(path.parent().expect("a parent")).expect("a folder");
        std::fs::write(path, bytes).expect("a file");
    }

    /// The command `ibr` with this folder as its current one.
    pub(crate) fn ibr(&self, args: &[&str]) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_ibr"));
        command.args(args).current_dir(self.0.path()).env("NO_COLOR", "1");
        command
    }

    pub(crate) fn run(&self, args: &[&str]) -> Ran {
        Ran::from(self.ibr(args).output().expect("ibr starts"))
    }

    /// Every file below this folder, hidden ones too, with its contents.
    pub(crate) fn contents(&self) -> BTreeMap<PathBuf, Vec<u8>> {
        let mut found = BTreeMap::new();
        collect(self.0.path(), &mut found);
        found
    }
}

fn collect(folder: &Path, found: &mut BTreeMap<PathBuf, Vec<u8>>) {
    for entry in std::fs::read_dir(folder).expect("a folder") {
        let path = entry.expect("an entry").path();
        if path.is_dir() {
            collect(&path, found);
        } else {
            // A program that is still at work takes temporary files away.
            match std::fs::read(&path) {
                Err(cause) if cause.kind() == std::io::ErrorKind::NotFound => {}
                bytes => _ = found.insert(path, bytes.expect("a file")),
            }
        }
    }
}

impl From<Output> for Ran {
    fn from(output: Output) -> Ran {
        let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
        Ran { code: output.status.code().unwrap_or(-1), stdout: text(&output.stdout), stderr: text(&output.stderr) }
    }
}

impl Ran {
    /// Standard output, which must be one JSON object with this schema, version 1, and nothing else.
    pub(crate) fn json(&self, schema: &str) -> serde_json::Value {
        // A bench that misses what is wanted ends with 1; a shared machine is slow at times.
        let bench = schema.starts_with("ibr.bench");
        let failed = schema == "ibr.error" && self.code > 1;
        assert!(self.code == 0 || failed || (bench && self.code == 1), "{}", self.stderr);
        let value: serde_json::Value = serde_json::from_str(&self.stdout).expect("one JSON value");
        assert_eq!(
            (value["schema"].as_str(), value["version"].as_u64()),
            (Some(schema), Some(if schema == "ibr.bench" { 2 } else { 1 }))
        );
        value
    }
}

/// A page that fetches nothing: no link, script or picture of another place.
pub(crate) fn assert_opens_offline(html: &str) {
    assert!(html.starts_with("<!doctype html>") || html.starts_with("<!DOCTYPE html>"), "{}", &html[..60]);
    assert!(html.trim_end().ends_with("</html>"), "the page is cut short");
    for fetched in
        ["src=\"http", "href=\"http", "src='http", "href='http", "url(http", "@import", "<link", "<script src"]
    {
        assert!(!html.contains(fetched), "the page contains {fetched}");
    }
    assert!(html.contains("<svg") && html.contains("prefers-color-scheme: dark") && html.contains("viewport"));
}

/// The names in the manifest of a folder, each a file with the hash that the manifest gives.
pub(crate) fn assert_hashes(folder: &Path) -> Vec<String> {
    let text = std::fs::read_to_string(folder.join("manifest.json")).expect("a manifest");
    let manifest: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    let outputs = manifest["outputs"].as_array().expect("outputs");
    let check = |output: &serde_json::Value| {
        let name = output["name"].as_str().expect("a name");
        let bytes = std::fs::read(folder.join(name)).expect("the file that the manifest names");
        let found: String = Sha256::digest(&bytes).iter().map(|b| format!("{b:02x}")).collect();
        assert_eq!(output["sha256"].as_str(), Some(found.as_str()), "{name}");
        name.to_string()
    };
    outputs.iter().map(check).collect()
}
