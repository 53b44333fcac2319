//! Folders as a kill at any point leaves them, and folders that are not ours.

use super::*;

fn marker(text: &str, end_s: f64) -> RunIdentity {
    RunIdentity { case_sha256: sha256(text.as_bytes()), end_s, frames: false, from: None }
}

fn place(folder: &Path) -> Workplace {
    take(folder, folder, None).unwrap()
}

#[test]
fn the_end_of_an_interrupted_run_comes_back_to_the_bit() {
    let folder = tempfile::tempdir().unwrap();
    // The robots' end, which is not 0.46, and sums as ramps make them.
    let ends = [0.04 + 0.36 + 0.06].into_iter().chain((1..500).map(|i| 0.1 * f64::from(i) + 1.0 / f64::from(i)));
    for end_s in ends {
        place(folder.path()).start(&marker("", end_s), "").unwrap();
        let Ok(FolderState::Unfinished(read)) = look(folder.path()) else { panic!("no marker") };
        assert_eq!(read.end_s.to_bits(), end_s.to_bits(), "{end_s}");
    }
}

#[test]
fn a_mark_without_its_case_is_believed_only_while_it_is_alone() {
    let folder = tempfile::tempdir().unwrap();
    let place = place(folder.path());
    place.mark(&marker("mine", 1.0)).unwrap();
    assert!(matches!(look(folder.path()), Ok(FolderState::Unfinished(_))), "killed before the case was written");
    std::fs::write(folder.path().join("picture.png"), "somebody's own").unwrap();
    let stray = |found| matches!(found, Ok(FolderState::Foreign(name)) if name.starts_with(MARKER));
    assert!(stray(look(folder.path())));
    place.keep_case("another").unwrap();
    assert!(stray(look(folder.path())));
    place.keep_case("mine").unwrap();
    assert!(matches!(look(folder.path()), Ok(FolderState::Unfinished(_))));
    for name in ["notes.txt", "frames/film.mp4"] {
        let path = folder.path().join(name);
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(&path, "somebody's own").unwrap();
        assert!(matches!(look(folder.path()), Ok(FolderState::Foreign(found)) if found == name), "{name}");
        std::fs::remove_file(path).unwrap();
    }
}

#[test]
fn a_start_over_an_earlier_run_leaves_a_folder_that_is_known_wherever_it_is_killed() {
    let names = ["frames/run_00000.vtu", "checkpoint", "history.csv", "summary.json", "manifest.json", CASE];
    for done in 0..40 {
        let folder = tempfile::tempdir().unwrap();
        std::fs::create_dir(folder.path().join("frames")).unwrap();
        names.iter().for_each(|name| std::fs::write(folder.path().join(name), "old").unwrap());
        assert!(matches!(look(folder.path()), Ok(FolderState::Finished)));
        let mut left = done;
        let begun = place(folder.path()).begin(&marker("new", 1.0), "new", &mut |step| {
            left = i32::checked_sub(left, 1).filter(|l| *l >= 0).ok_or_else(|| FemError::setting("killed", ""))?;
            step()
        });
        match (begun, look(folder.path()).unwrap()) {
            (Err(_), FolderState::Finished) => assert_eq!(done, 0),
            (Err(_), FolderState::Unfinished(of)) => assert!([marker("old", 1.0), marker("new", 1.0)].contains(&of)),
            (Ok(()), FolderState::Unfinished(of)) => {
                assert!(of == marker("new", 1.0) && sorted(folder.path()).unwrap() == [LOCK, CASE, MARKER]);
                assert!(done > OWN.len() as i32);
                return;
            }
            other => panic!("killed after {done} steps: {other:?}"),
        }
    }
    panic!("never begun");
}
