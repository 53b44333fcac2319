//! A complete run takes the place of an older one: in one step where the system can, else in renames that can be mended.

use std::io;
use std::path::Path;

/// Lets `new` and `old` change places, so that `old` is one of the two at every moment.
pub(super) fn exchange(new: &Path, old: &Path, aside: &Path) -> io::Result<()> {
    in_one_step(new, old).or_else(|_| in_renames(new, old, aside, &|from, to| std::fs::rename(from, to)))
}

/// Lets two folders change places in one step.
///
/// # Errors
/// The system cannot do that, or one of them is not there.
#[cfg(target_os = "linux")]
pub fn in_one_step(new: &Path, old: &Path) -> io::Result<()> {
    use rustix::fs::{CWD, RenameFlags, renameat_with};
    Ok(renameat_with(CWD, new, CWD, old, RenameFlags::EXCHANGE)?)
}

/// Lets two folders change places in one step.
///
/// # Errors
/// The system cannot do that.
#[cfg(not(target_os = "linux"))]
pub fn in_one_step(_: &Path, _: &Path) -> io::Result<()> {
    Err(io::ErrorKind::Unsupported.into())
}

type Rename<'a> = &'a dyn Fn(&Path, &Path) -> io::Result<()>;

fn in_renames(new: &Path, old: &Path, aside: &Path, rename: Rename) -> io::Result<()> {
    rename(old, aside)?;
    if let Err(cause) = rename(new, old) {
        rename(aside, old)?;
        return Err(cause);
    }
    rename(aside, new)
}

/// After a kill between those renames: the older run, which lies `aside`, goes back unless the new one is there.
pub(super) fn mend(folder: &Path, aside: &Path) -> io::Result<()> {
    if folder.exists() { std::fs::remove_dir_all(aside) } else { std::fs::rename(aside, folder) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::cell::Cell;

    /// `run` with an older run, `new` with a newer one, and where the older lies between.
    fn folders() -> (tempfile::TempDir, [std::path::PathBuf; 3]) {
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
    fn a_kill_between_renames_leaves_the_older_run_or_the_new_one() {
        for done in 0..3 {
            let (_root, [new, run, aside]) = folders();
            let left = Cell::new(done);
            let killed = in_renames(&new, &run, &aside, &|from, to| match left.get() {
                0 => Err(io::ErrorKind::Interrupted.into()),
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
    fn a_rename_that_fails_is_taken_back() {
        let (_root, [new, run, aside]) = folders();
        let refused = in_renames(&new, &run, &aside, &|from, to| match from == new {
            true => Err(io::ErrorKind::PermissionDenied.into()),
            false => std::fs::rename(from, to),
        });
        assert!(refused.is_err() && holds(&run) == "run" && holds(&new) == "new" && !aside.exists());
    }
}
