//! Folders written whole: new contents are made ready next to a folder and take its place in one step where the system can.

use crate::files::{folder_of, is_gone};
use std::io::{Error, Result};
use std::path::{Path, PathBuf};

/// Between the name of a folder and the number of the process that makes its contents ready.
const INCOMPLETE: &str = ".incomplete-";

/// Where the contents of a folder are made ready. It is removed on drop.
#[derive(Debug)]
pub struct Staged {
    /// The folder itself, where a link to it leads.
    folder: PathBuf,
    /// Next to it, or in it.
    staging: PathBuf,
    /// It can take the place of the folder.
    is_beside: bool,
}

impl Staged {
    /// An empty folder for new contents of `folder`; what killed processes left of theirs is removed.
    ///
    /// # Errors
    /// A folder that cannot be made.
    pub fn of(folder: &Path) -> Result<Staged> {
        let folder = folder.canonicalize().or_else(|_| {
            let above = folder_of(folder);
            std::fs::create_dir_all(&above)?;
            Ok::<_, Error>(folder.file_name().map_or_else(|| folder.to_path_buf(), |name| above.join(name)))
        })?;
        let process = std::process::id();
        let prefix = folder.file_name().map(|name| format!(".{}{INCOMPLETE}", name.to_string_lossy()));
        clear(&folder, INCOMPLETE);
        prefix.iter().for_each(|prefix| clear(&folder_of(&folder), prefix));
        if let Some(prefix) = prefix.filter(|_| is_results_only(&folder)) {
            let staging = folder.with_file_name(format!("{prefix}{process}"));
            if std::fs::create_dir(&staging).is_ok() {
                return Ok(Staged { folder, staging, is_beside: true });
            }
        }
        let staging = folder.join(format!("{INCOMPLETE}{process}"));
        std::fs::create_dir_all(&staging)?;
        Ok(Staged { folder, staging, is_beside: false })
    }

    /// Folder in which the caller writes the new files.
    pub fn path(&self) -> &Path {
        &self.staging
    }

    /// The new files, `names`, take their place: in one step with all else that is in the folder but `retired`, or one by one in this
    /// order.
    ///
    /// # Errors
    /// A file that cannot be moved.
    pub fn finish(self, names: &[String], retired: &[String]) -> Result<()> {
        match self.is_beside && self.exchange(retired).is_ok() {
            true => Ok(()),
            false => self.rename(names, retired),
        }
    }

    fn exchange(&self, retired: &[String]) -> Result<()> {
        let Staged { folder, staging, .. } = self;
        if !folder.exists() {
            return std::fs::rename(staging, folder);
        }
        let kept = |into: &Path, keep: fn(PathBuf, PathBuf) -> Result<()>, from: &Path| {
            let names = std::fs::read_dir(from)?.map(|entry| Ok(entry?.file_name())).collect::<Result<Vec<_>>>()?;
            let mut others =
                names.iter().filter(|name| !into.join(name).exists() && !retired.iter().any(|old| **name == **old));
            others.try_for_each(|name| keep(from.join(name), into.join(name)))
        };
        kept(staging, std::fs::hard_link, folder)?;
        std::fs::set_permissions(staging, std::fs::metadata(folder)?.permissions())?;
        in_one_step(staging, folder)?;
        // What somebody wrote there meanwhile.
        kept(folder, std::fs::rename, staging)
    }

    fn rename(&self, names: &[String], retired: &[String]) -> Result<()> {
        let Staged { folder, staging, .. } = self;
        std::fs::create_dir_all(folder)?;
        names.iter().try_for_each(|name| std::fs::rename(staging.join(name), folder.join(name)))?;
        retired.iter().try_for_each(|name| std::fs::remove_file(folder.join(name)))
    }
}

impl Drop for Staged {
    fn drop(&mut self) {
        // A folder that cannot be removed does no harm.
        let _ = std::fs::remove_dir_all(&self.staging);
    }
}

/// Removes what killed processes made ready in `folder` under this prefix.
fn clear(folder: &Path, prefix: &str) {
    for entry in std::fs::read_dir(folder).into_iter().flatten().flatten() {
        if entry.file_name().to_string_lossy().strip_prefix(prefix).is_some_and(is_gone) {
            let _ = std::fs::remove_dir_all(entry.path());
        }
    }
}

/// A folder that another may replace: files only, and no process works in it.
fn is_results_only(folder: &Path) -> bool {
    let is_here = std::env::current_dir().is_ok_and(|here| here.starts_with(folder));
    let Ok(mut entries) = std::fs::read_dir(folder) else { return !folder.exists() };
    !is_here && entries.all(|entry| entry.and_then(|e| e.file_type()).is_ok_and(|kind| kind.is_file()))
}

/// Lets `new` and `old` change places: in one step where the system can, else in renames that [`mend`] completes after a kill.
///
/// # Errors
/// A rename that fails.
pub fn exchange(new: &Path, old: &Path, aside: &Path) -> Result<()> {
    in_one_step(new, old).or_else(|_| in_renames(new, old, aside, &|from, to| std::fs::rename(from, to)))
}

#[cfg(target_os = "linux")]
fn in_one_step(new: &Path, old: &Path) -> Result<()> {
    use rustix::fs::{CWD, RenameFlags, renameat_with};
    Ok(renameat_with(CWD, new, CWD, old, RenameFlags::EXCHANGE)?)
}

#[cfg(not(target_os = "linux"))]
fn in_one_step(_: &Path, _: &Path) -> Result<()> {
    Err(std::io::ErrorKind::Unsupported.into())
}

fn in_renames(new: &Path, old: &Path, aside: &Path, rename: &dyn Fn(&Path, &Path) -> Result<()>) -> Result<()> {
    rename(old, aside)?;
    if let Err(cause) = rename(new, old) {
        rename(aside, old)?;
        return Err(cause);
    }
    rename(aside, new)
}

/// After a kill between those renames: the older folder, now at `aside`, goes back unless the new one is there.
///
/// # Errors
/// It cannot be moved or removed.
pub fn mend(folder: &Path, aside: &Path) -> Result<()> {
    if folder.exists() { std::fs::remove_dir_all(aside) } else { std::fs::rename(aside, folder) }
}

/// Names of the entries of a folder in alphabetical order.
pub fn names(folder: &Path) -> Result<Vec<String>> {
    let entries = std::fs::read_dir(folder)?;
    let mut names: Vec<String> =
        entries.filter_map(|e| Some(e.ok()?.file_name().to_string_lossy().into_owned())).collect();
    names.sort();
    Ok(names)
}

/// Removes a file or a folder with all that is in it, if it is there.
pub fn remove(path: &Path) -> Result<()> {
    match path.symlink_metadata() {
        Err(_) => Ok(()),
        Ok(about) if about.is_dir() => std::fs::remove_dir_all(path),
        Ok(_) => std::fs::remove_file(path),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::cell::Cell;
    use std::io::ErrorKind;

    /// `run` with older contents, `new` with newer ones, and where the older lie between.
    fn folders() -> (tempfile::TempDir, [PathBuf; 3]) {
        let root = tempfile::tempdir().unwrap();
        let paths = ["new", "run", "run.old"].map(|name| root.path().join(name));
        for path in &paths[..2] {
            std::fs::create_dir(path).unwrap();
            std::fs::write(path.join("file"), path.file_name().unwrap().as_encoded_bytes()).unwrap();
        }
        (root, paths)
    }

    fn holds(folder: &Path) -> String {
        std::fs::read_to_string(folder.join("file")).unwrap_or_default()
    }

    #[test]
    fn folders_change_places() {
        let (_root, [new, run, aside]) = folders();
        exchange(&new, &run, &aside).unwrap();
        assert_eq!([holds(&run), holds(&new)], ["new", "run"]);
        assert!(!aside.exists());
    }

    #[test]
    #[cfg(target_os = "linux")]
    fn there_is_no_moment_without_the_folder_where_the_system_can_exchange() {
        let (_root, [new, run, _]) = folders();
        in_one_step(&new, &run).unwrap();
        assert_eq!([holds(&run), holds(&new)], ["new", "run"]);
    }

    #[test]
    fn a_kill_between_renames_leaves_the_older_folder_or_the_new_one() {
        for done in 0..3 {
            let (_root, [new, run, aside]) = folders();
            let left = Cell::new(done);
            let killed = in_renames(&new, &run, &aside, &|from, to| match left.get() {
                0 => Err(ErrorKind::Interrupted.into()),
                n => {
                    left.set(n - 1);
                    std::fs::rename(from, to)
                }
            });
            assert!(killed.is_err());
            if aside.exists() {
                mend(&run, &aside).unwrap();
            }
            assert_eq!(holds(&run), ["run", "run", "new"][done], "killed after {done} renames");
            assert!(!aside.exists());
        }
    }

    #[test]
    fn a_rename_that_fails_is_undone() {
        let (_root, [new, run, aside]) = folders();
        let refused = in_renames(&new, &run, &aside, &|from, to| match from == new {
            true => Err(ErrorKind::PermissionDenied.into()),
            false => std::fs::rename(from, to),
        });
        assert!(refused.is_err() && holds(&run) == "run" && holds(&new) == "new" && !aside.exists());
    }

    /// In one step, and file by file where somebody keeps a folder there. Leavings of a killed process go with it.
    #[test]
    fn new_contents_replace_the_older_ones_and_nothing_else() {
        for own in ["notes.txt", "sub/notes.txt"] {
            let root = tempfile::tempdir().unwrap();
            let folder = root.path().join("report");
            let write = |files: &[&str], retired: &[&str]| {
                let staged = Staged::of(&folder).unwrap();
                files.iter().for_each(|name| std::fs::write(staged.path().join(name), "new").unwrap());
                let owned = |names: &[&str]| names.iter().map(ToString::to_string).collect::<Vec<_>>();
                staged.finish(&owned(files), &owned(retired)).unwrap();
            };
            write(&["a.png", "old.png"], &[]);
            std::fs::create_dir_all(folder.join(own).parent().unwrap()).unwrap();
            std::fs::write(folder.join(own), "somebody's own").unwrap();
            assert_eq!(is_results_only(&folder), own == "notes.txt");
            let left = [root.path().join(".report.incomplete-4194999"), folder.join(".incomplete-4194999")];
            left.iter().for_each(|path| std::fs::create_dir(path).unwrap());
            write(&["a.png"], &["old.png"]);
            assert_eq!(names(&folder).unwrap(), ["a.png", own.split('/').next().unwrap()]);
            assert_eq!(std::fs::read_to_string(folder.join(own)).unwrap(), "somebody's own");
            assert_eq!(names(root.path()).unwrap(), ["report"]);
        }
    }
}
