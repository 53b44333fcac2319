//! `ibr bench discovery`: the same numbers for any number of threads, every row there.

use crate::support::Folder;
use serde_json::Value;

fn bench(threads: &str) -> Value {
    let folder = Folder::new();
    let mut command = folder.ibr(&["bench", "discovery", "--sets", "8", "--seed", "3", "--json"]);
    let output = command.env("RAYON_NUM_THREADS", threads).output().expect("ibr starts");
    assert!(matches!(output.status.code(), Some(0 | 1)), "{}", String::from_utf8_lossy(&output.stderr));
    let mut answer: Value = serde_json::from_slice(&output.stdout).expect("JSON");
    // Times differ from run to run.
    answer["time"] = Value::Null;
    answer
}

#[test]
fn the_bench_gives_the_same_numbers_for_any_number_of_threads_and_no_set_fails() {
    let one = bench("1");
    assert_eq!(one, bench("3"));
    assert_eq!(one["schema"], "ibr.bench.discovery");
    assert_eq!(one["failed"].as_array().map(Vec::len), Some(0), "{}", one["failed"]);
    let rows = one["rows"].as_array().expect("rows");
    assert_eq!(rows.len(), 62);
    assert!(rows.iter().all(|row| row["figure"].is_string() && row["target"].is_object()), "{rows:?}");
}

/// Shards in any order, one with a file of half an answer, which is an error until it is deleted, and a bench of fewer sets before: the table is that of one call.
#[test]
fn a_bench_in_shards_has_the_numbers_of_one_call() {
    let folder = Folder::new();
    let bench = |sets: &str, more: &[&str]| {
        let ran = folder.ibr(&[&["bench", "discovery", "--sets", sets, "--json"], more].concat()).output();
        let ran = ran.expect("ibr starts");
        assert!(matches!(ran.status.code(), Some(0 | 1)), "{}", String::from_utf8_lossy(&ran.stderr));
        let mut answer: Value = serde_json::from_slice(&ran.stdout).expect("JSON");
        answer["time"] = Value::Null;
        answer
    };
    let whole = bench("4", &[]);
    assert_eq!(whole["seen"].as_array().map(Vec::len), Some(36));
    let told = bench("4", &["--out", "b", "--shard", "2/3"]);
    assert_eq!((&told["schema"], &told["made"], &told["missing"]), (&"ibr.shard".into(), &19.into(), &37.into()));
    bench("4", &["--out", "b", "--shard", "1/3"]);
    let answers = || std::fs::read_dir(folder.path("b/answers")).expect("a folder").map(|e| e.expect("a file").path());
    assert_eq!(answers().count(), 38);
    let torn = answers().next().expect("a file");
    let half = std::fs::read(&torn).expect("a file");
    std::fs::write(&torn, &half[..half.len() / 2]).expect("a file");
    let ran = folder.ibr(&["bench", "discovery", "--sets", "4", "--out", "b"]).output().expect("ibr starts");
    let words = String::from_utf8_lossy(&ran.stderr).into_owned();
    assert!(ran.status.code() == Some(3) && words.contains("checksum") && words.contains("delete the file"), "{words}");
    std::fs::write(&torn, &half).expect("a file");
    assert_eq!(bench("4", &["--out", "b", "--shard", "3/3"]), whole, "the last shard has the table");
    std::fs::remove_file(&torn).expect("a file");
    assert_eq!(bench("4", &["--out", "b", "--threads", "1"]), whole);
    assert_eq!(
        (answers().count(), std::fs::read(&torn).expect("a file")),
        (56, half),
        "what was deleted is recomputed"
    );
    bench("2", &["--out", "b"]);
    assert_eq!(answers().count(), 56, "the sets of a smaller bench are among those of a larger one");
}

#[test]
fn the_second_laws_make_other_data_of_the_same_robots() {
    let folder = Folder::new();
    let [first, second] = ["first", "second"].map(|laws| {
        let output =
            folder.ibr(&["bench", "discovery", "--sets", "1", "--laws", laws, "--json"]).output().expect("ibr starts");
        serde_json::from_slice::<Value>(&output.stdout).expect("JSON")
    });
    assert_eq!((&first["laws"], &second["laws"]), (&"first".into(), &"second".into()));
    assert_eq!(second["failed"].as_array().map(Vec::len), Some(0), "{}", second["failed"]);
    let one = |bench: &Value| bench["seen"][1].clone();
    assert_eq!(
        (one(&first)["part"].as_str(), one(&first)["truth"]["effect"].clone()),
        (Some("Hidden(One)"), one(&second)["truth"]["effect"].clone())
    );
    let answers =
        |bench: &Value| bench["seen"].as_array().unwrap().iter().map(|set| set["answer"].clone()).collect::<Vec<_>>();
    assert_ne!(answers(&first), answers(&second));
}

#[test]
fn a_full_diagnosis_takes_less_than_a_second_on_one_core() {
    let folder = Folder::new();
    let output = folder.ibr(&["bench", "discovery", "--sets", "1", "--json"]).output().expect("ibr starts");
    let answer: Value = serde_json::from_slice(&output.stdout).expect("JSON");
    let seconds = answer["time"]["row"]["measured"].as_f64().expect("CPU seconds");
    assert!(seconds > 0.0 && seconds <= 1.0, "{seconds} s");
}
