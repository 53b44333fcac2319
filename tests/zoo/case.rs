//! One bad input, and what the program has to do with it.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

/// That of a folder with a report.
const MANIFEST: &str =
    r#"{"schema": "ibr.manifest", "version": 1, "outputs": [{"name": "report.html", "sha256": ""}]}"#;
/// No refusal takes longer, on a busy machine and unoptimised.
const LONGEST: Duration = Duration::from_secs(60);

/// What is wrong with the file.
#[derive(Debug, Clone)]
pub(crate) enum Broken {
    /// There is a file with these bytes.
    Bytes(Vec<u8>),
    /// There is a folder of that name.
    Folder,
    /// It is a link to this.
    Link(&'static str),
    /// Its bytes, which are read all the same and mean the same as these.
    Reads(Vec<u8>, Vec<u8>),
}

/// A bad input with the command that must refuse it, or must read it.
#[derive(Debug, Clone)]
pub(crate) struct Case {
    pub name: String,
    pub file: String,
    pub broken: Broken,
    pub beside: Vec<(String, Vec<u8>)>,
    pub prepare: Vec<String>,
    pub command: String,
    pub code: i32,
    pub says: Vec<String>,
}

pub(crate) struct Ran {
    pub code: i32,
    pub stdout: String,
    pub stderr: String,
}

impl Case {
    /// Runs it; the reason if the program did something else.
    pub(crate) fn run(&self) -> Result<(), String> {
        let folder = tempfile::tempdir().unwrap();
        let at = folder.path();
        self.lay_out(at)?;
        if let Broken::Reads(_, good) = &self.broken {
            let other = tempfile::tempdir().unwrap();
            self.lay_out(other.path())?;
            fs::write(other.path().join(&self.file), good).unwrap();
            return same(&self.ran(other.path())?, &self.ran(at)?);
        }
        let before = contents(at);
        let ran = self.ran(at)?;
        self.judge(&ran)?;
        let after = contents(at);
        let changed: Vec<_> = after.iter().filter(|(path, bytes)| before.get(*path) != Some(*bytes)).collect();
        match changed.first().map(|(path, _)| *path).or(before.keys().find(|path| !after.contains_key(*path))) {
            Some(path) if ran.code != 0 => Err(format!("{} has changed", path.display())),
            _ => Ok(()),
        }
    }

    /// The folder that the command finds: an earlier report, files, and the broken one.
    fn lay_out(&self, at: &Path) -> Result<(), String> {
        let write = |name: &str, bytes: &[u8]| {
            let path = at.join(name);
            fs::create_dir_all(path.parent().unwrap()).unwrap();
            fs::write(path, bytes).unwrap();
        };
        write("report/report.html", b"<p>an earlier report");
        write("report/manifest.json", MANIFEST.as_bytes());
        self.beside.iter().for_each(|(name, bytes)| write(name, bytes));
        for command in &self.prepare {
            let made = Case { command: command.clone(), ..self.clone() }.ran(at)?;
            if made.code != 0 {
                return Err(format!("{command}: {}", made.stderr));
            }
        }
        let path = at.join(&self.file);
        if path.is_file() {
            fs::remove_file(&path).unwrap();
        }
        match &self.broken {
            _ if self.file.is_empty() => {}
            Broken::Bytes(bytes) | Broken::Reads(bytes, _) => write(&self.file, bytes),
            Broken::Folder => fs::create_dir_all(path).unwrap(),
            Broken::Link(to) => link(to, &path),
        }
        Ok(())
    }

    fn ran(&self, at: &Path) -> Result<Ran, String> {
        // A no-break space stands for a space within a word.
        let words = self.command.split(' ').map(|word| word.replace('\u{a0}', " "));
        let child = Command::new(env!("CARGO_BIN_EXE_ibr"))
            .args(words)
            .current_dir(at)
            .env("NO_COLOR", "1")
            .stdin(Stdio::null())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        ended(child)
    }

    /// What every refusal has in common, and what this one has to say.
    fn judge(&self, ran: &Ran) -> Result<(), String> {
        let told = unwrapped(&ran.stderr) + &unwrapped(&ran.stdout);
        let message = || format!("{} says:\n    {}", self.command, &told[..told.floor_char_boundary(1500)]);
        if ran.code != self.code {
            return Err(format!("code {} and not {}; {}", ran.code, self.code, message()));
        }
        if let Some(missing) = self.says.iter().find(|part| !told.contains(part.as_str())) {
            return Err(format!("no `{missing}`; {}", message()));
        }
        clean(ran).map_err(|why| format!("{why}; {}", message()))
    }
}

/// What holds of everything that is said: short, with a remedy, no panic, nothing that a terminal obeys.
pub(crate) fn clean(ran: &Ran) -> Result<(), String> {
    let told = unwrapped(&ran.stderr) + &unwrapped(&ran.stdout);
    if ran.code != 0 && ran.stderr.len() > 20_000 {
        return Err(format!("a message of {} bytes", ran.stderr.len()));
    }
    let remedies = [
        "help:",
        "--help",
        "possible values",
        "tip:",
        "Usage:",
        "write ",
        "use fewer",
        "must be",
        "it must",
        "known: ",
        "expected a gauge",
        "Take ",
        "Add ",
        "Try: ",
    ];
    if ran.code != 0 && !remedies.iter().any(|word| told.contains(word)) {
        return Err("no remedy".into());
    }
    if told.contains("panicked") || told.contains("RUST_BACKTRACE") {
        return Err("a panic".into());
    }
    match ran.stdout.chars().chain(ran.stderr.chars()).find(|c| c.is_control() && !matches!(c, '\n' | '\t')) {
        Some(c) => Err(format!("{c:?} reaches the terminal")),
        None => Ok(()),
    }
}

/// A message without the frame and the line breaks that are drawn around it.
pub(crate) fn unwrapped(text: &str) -> String {
    text.split_whitespace().filter(|word| *word != "│" && *word != "·").map(|word| format!("{word} ")).collect()
}

/// Waits for the end, which may not take long.
pub(crate) fn ended(mut child: Child) -> Result<Ran, String> {
    let read = |mut from: Box<dyn std::io::Read + Send>| {
        std::thread::spawn(move || {
            let mut bytes = Vec::new();
            let _ = from.read_to_end(&mut bytes);
            String::from_utf8_lossy(&bytes).into_owned()
        })
    };
    let (stdout, stderr) = (read(Box::new(child.stdout.take().unwrap())), read(Box::new(child.stderr.take().unwrap())));
    let began = Instant::now();
    let status = loop {
        match child.try_wait().unwrap() {
            Some(status) => break status,
            None if began.elapsed() > LONGEST => {
                child.kill().unwrap();
                child.wait().unwrap();
                return Err(format!("it hangs: no end after {LONGEST:?}"));
            }
            None => std::thread::sleep(Duration::from_millis(5)),
        }
    };
    Ok(Ran { code: status.code().unwrap_or(-1), stdout: stdout.join().unwrap(), stderr: stderr.join().unwrap() })
}

fn same(right: &Ran, read: &Ran) -> Result<(), String> {
    if right.code != read.code {
        return Err(format!("the good file ends with {}, this one with {}: {}", right.code, read.code, read.stderr));
    }
    if right.stdout != read.stdout {
        return Err(format!("it is read and means something else: {} and {}", right.stdout, read.stdout));
    }
    Ok(())
}

#[cfg(unix)]
fn link(to: &str, path: &Path) {
    std::os::unix::fs::symlink(to, path).unwrap();
}

#[cfg(not(unix))]
fn link(_to: &str, path: &Path) {
    fs::create_dir_all(path).unwrap();
}

/// Every file below a folder with its bytes, and links with where they go.
fn contents(folder: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
    let mut found = BTreeMap::new();
    let mut folders = vec![folder.to_path_buf()];
    while let Some(at) = folders.pop() {
        for entry in fs::read_dir(at).unwrap() {
            let path = entry.unwrap().path();
            let kind = path.symlink_metadata().unwrap().file_type();
            if kind.is_dir() {
                folders.push(path);
            } else if kind.is_symlink() {
                found.insert(path.clone(), fs::read_link(&path).unwrap().into_os_string().into_encoded_bytes());
            } else {
                found.insert(path.clone(), fs::read(&path).unwrap());
            }
        }
    }
    found
}
