use super::*;

/// Lets `room` bytes through, then fails as a full disk does.
struct FullAfter<'a> {
    room: usize,
    inner: &'a mut dyn Write,
}

impl Write for FullAfter<'_> {
    fn write(&mut self, bytes: &[u8]) -> Result<usize, Error> {
        if self.room == 0 {
            return Err(Error::from(std::io::ErrorKind::StorageFull));
        }
        let count = self.inner.write(&bytes[..bytes.len().min(self.room)])?;
        self.room -= count;
        Ok(count)
    }
    fn flush(&mut self) -> Result<(), Error> {
        self.inner.flush()
    }
}

const PROBLEM: u64 = 0xfeed_beef;

fn state(step: u64) -> Checkpoint {
    let payload = (0..500 + step).map(|i| (i * 37 + step) as u8).collect();
    Checkpoint { fingerprint: PROBLEM, step, time_s: step as f64 * 0.1, payload }
}

fn reason(folder: &Path) -> String {
    let error = read_checkpoint(folder, PROBLEM).unwrap_err();
    assert!(matches!(error, FemError::Checkpoint { .. }), "{error:?}");
    error.to_string()
}

/// A small generator, so that damage hits other places than a person would think of.
fn random(seed: &mut u64, below: usize) -> usize {
    *seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
    (*seed >> 33) as usize % below
}

#[test]
fn the_newest_checkpoint_comes_back_to_the_bit_and_the_one_before_is_kept() {
    let folder = tempfile::tempdir().unwrap();
    let inside = folder.path().join("run");
    assert_eq!(read_checkpoint(&inside, PROBLEM).unwrap(), None);
    for step in 1..4 {
        let path = write_checkpoint(&inside, &state(step)).unwrap();
        assert_eq!(path, inside.join("checkpoint"));
        let loaded = read_checkpoint(&inside, PROBLEM).unwrap().unwrap();
        assert_eq!(loaded, (state(step), None));
    }
    assert_eq!(std::fs::read(inside.join("checkpoint.previous")).unwrap(), encode(&state(2)));
    assert_eq!(std::fs::read_dir(&inside).unwrap().count(), 2);
}

#[test]
fn every_changed_byte_and_every_cut_is_noticed() {
    let folder = tempfile::tempdir().unwrap();
    let (path, good, mut seed) = (folder.path().join("checkpoint"), encode(&state(1)), 7);
    let mut cases: Vec<Vec<u8>> = (0..good.len()).map(|length| good[..length].to_vec()).collect();
    for case in 0..300 {
        // The first bytes hold all fields but the payload: each of them once, then 250 anywhere.
        let at = if case < 50 { case } else { random(&mut seed, good.len()) };
        let mut bad = good.clone();
        bad[at] ^= 1 + random(&mut seed, 255) as u8;
        cases.push(bad);
    }
    cases.push([&good[..], &[0]].concat());
    cases.push(vec![0; good.len()]);
    for bad in cases {
        std::fs::write(&path, &bad).unwrap();
        assert!(reason(folder.path()).contains("--force"));
    }
}

#[test]
fn a_damaged_newest_one_falls_back_to_the_one_before_and_says_so() {
    let folder = tempfile::tempdir().unwrap();
    write_checkpoint(folder.path(), &state(1)).unwrap();
    write_checkpoint(folder.path(), &state(2)).unwrap();
    std::fs::write(folder.path().join("checkpoint"), &encode(&state(2))[..300]).unwrap();
    let loaded = read_checkpoint(folder.path(), PROBLEM).unwrap().unwrap();
    assert_eq!(loaded.0, state(1));
    let notice = loaded.1.unwrap();
    assert!(notice.contains("cut off or damaged") && notice.contains("step 1"), "{notice}");
    std::fs::write(folder.path().join("checkpoint.previous"), b"").unwrap();
    assert!(reason(folder.path()).contains("no other checkpoint is good"));
}

#[test]
fn a_kill_at_any_moment_of_writing_leaves_a_good_one() {
    let folder = tempfile::tempdir().unwrap();
    let [newest, previous, partial] =
        ["checkpoint", "checkpoint.previous", "checkpoint.partial"].map(|name| folder.path().join(name));
    let (one, two, three) = (encode(&state(1)), encode(&state(2)), encode(&state(3)));
    // What the folder holds after each step of replacing 2 by 3: half written, whole, first rename, second rename.
    let moments = [
        ([Some(&one[..]), Some(&two), Some(&three[..100])], 2),
        ([Some(&one), Some(&two), Some(&three)], 2),
        ([Some(&two), None, Some(&three)], 2),
        ([Some(&two), Some(&three), None], 3),
    ];
    for (files, step) in moments {
        for (path, bytes) in [&previous, &newest, &partial].into_iter().zip(files) {
            let _ = std::fs::remove_file(path);
            bytes.iter().for_each(|bytes| std::fs::write(path, bytes).unwrap());
        }
        let loaded = read_checkpoint(folder.path(), PROBLEM).unwrap().unwrap();
        assert_eq!((loaded.0, loaded.1.is_some()), (state(step), files[1].is_none()));
        write_checkpoint(folder.path(), &state(4)).unwrap();
        assert_eq!(read_checkpoint(folder.path(), PROBLEM).unwrap().unwrap().0, state(4));
        assert!(!partial.exists() && decodes(&previous), "step {step}");
    }
}

fn decodes(path: &Path) -> bool {
    matches!(read_file(path, PROBLEM).unwrap(), FoundCheckpoint::Good(_))
}

#[test]
fn a_disk_that_fills_up_leaves_both_earlier_checkpoints_as_they_were() {
    let folder = tempfile::tempdir().unwrap();
    write_checkpoint(folder.path(), &state(1)).unwrap();
    write_checkpoint(folder.path(), &state(2)).unwrap();
    for room in [0, 1, 47, 300, encode(&state(3)).len() - 1] {
        let put: Put = &mut |inner, bytes| FullAfter { room, inner }.write_all(bytes);
        let error = write_through(folder.path(), &state(3), put).unwrap_err();
        assert!(matches!(error, FemError::Io { .. }), "{error:?}");
        assert_eq!(std::fs::read(folder.path().join("checkpoint")).unwrap(), encode(&state(2)));
        assert_eq!(std::fs::read(folder.path().join("checkpoint.previous")).unwrap(), encode(&state(1)));
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 2);
    }
}

#[cfg(target_os = "linux")]
#[test]
fn a_real_device_without_room_is_an_input_output_error() {
    let folder = tempfile::tempdir().unwrap();
    write_checkpoint(folder.path(), &state(1)).unwrap();
    std::os::unix::fs::symlink("/dev/full", folder.path().join("checkpoint.partial")).unwrap();
    let error = write_checkpoint(folder.path(), &state(2)).unwrap_err();
    assert!(matches!(&error, FemError::Io { source, .. } if source.kind() == std::io::ErrorKind::StorageFull));
    assert_eq!(read_checkpoint(folder.path(), PROBLEM).unwrap().unwrap().0, state(1));
}

#[test]
fn another_problem_or_version_is_refused_even_if_an_older_one_would_fit() {
    let folder = tempfile::tempdir().unwrap();
    write_checkpoint(folder.path(), &state(1)).unwrap();
    write_checkpoint(folder.path(), &Checkpoint { fingerprint: 5, ..state(2) }).unwrap();
    let text = reason(folder.path());
    assert!(text.contains("another problem (0000000000000005, this one is 00000000feedbeef)"), "{text}");
    let mut later = unsealed(&encode(&state(3))).unwrap().to_vec();
    later[8] = VERSION as u8 + 1;
    std::fs::write(folder.path().join("checkpoint"), sealed(later)).unwrap();
    let wanted = format!("format version is {}, this program reads {VERSION}", VERSION + 1);
    assert!(reason(folder.path()).contains(&wanted));
}
