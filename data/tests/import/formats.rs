//! Every kind of file has a fixture that is read as what it is, a row of the zoo, a reader of the fuzzer and a line of the guide.

use super::{case, known, pixels};
use data::import::{FORMATS, FilePlace, ImportOptions, LOGS, Scale, import};
use std::path::Path;

/// Options among which each fixture finds what it needs.
fn options() -> [ImportOptions; 7] {
    let map =
        "run=Trial,marker=Point,t=Elapsed (ms),x=PosX (cm),y=PosY (cm),p_act=Sensor A (mbar),p_body=Sensor B (mbar)";
    let columns = map.split(',').map(|text| data::import::typed::column(text).unwrap()).collect();
    [
        known(LOGS[0].1),
        pixels(LOGS[0].1),
        ImportOptions { base: Some(FilePlace::At(vec![50_000.0, 400_000.0])), ..known(LOGS[0].1) },
        ImportOptions { scale: Scale::Unit(1.0), ..known(LOGS[0].1) },
        ImportOptions { scale: Scale::Unit(1e-3), frames_per_s: Some(30.0), ..known(LOGS[0].1) },
        ImportOptions { body_pa: Some(2e3), ..known("cases/c25-ros-echo/pressure.csv") },
        ImportOptions { columns, actuator: Some("epam".into()), ..ImportOptions::default() },
    ]
}

#[test]
fn every_format_has_a_fixture_a_zoo_row_a_fuzz_reader_and_a_line_of_the_guide() {
    let repository = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let text = |path: &str| std::fs::read_to_string(repository.join(path)).unwrap();
    let tables = std::fs::read_dir(repository.join("tests/zoo")).unwrap().map(|entry| entry.unwrap().path());
    let zoo: String = tables.filter_map(|path| std::fs::read_to_string(path).ok()).collect();
    let (fuzz, guide) = (text("fuzz/src/readers.rs"), text("docs/guide.md"));
    let kinds = FORMATS.iter().map(|format| (format.name, format.fixture)).chain(LOGS);
    for (name, fixture) in kinds {
        assert!(case(fixture).is_file(), "{name}: there is no data/tests/{fixture}");
        for (place, what) in [(&zoo, "row in tests/zoo"), (&fuzz, "reader in fuzz/src/readers.rs")] {
            assert!(place.contains(&format!("data/tests/{fixture}")), "{name}: no {what} takes data/tests/{fixture}");
        }
        assert!(guide.contains(name), "{name}: docs/guide.md does not name it");
    }
}

#[test]
fn every_fixture_is_read_as_what_it_is() {
    for format in FORMATS {
        let files = [case(format.fixture)];
        let made = options().map(|options| import(&files, &options, &mut |_, _| ()));
        let programs: Vec<Result<&str, String>> =
            made.into_iter().map(|made| made.map(|made| made.program).map_err(|error| error.to_string())).collect();
        assert!(programs.contains(&Ok(format.name)), "{}: {programs:?}", format.name);
        assert!(programs.iter().flatten().all(|program| *program == format.name), "{}: {programs:?}", format.name);
    }
}
