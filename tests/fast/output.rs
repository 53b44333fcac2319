//! What lands on disk: whole or not at all.

use crate::refused::{refuse, with_report};
use crate::support::{Folder, assert_hashes, assert_opens_offline};
use serde_json::Value;

#[test]
fn a_comparison_writes_a_report_that_opens_offline_plots_and_a_manifest_whose_hashes_match() {
    let folder = Folder::new();
    let ran = folder.run(&["compare", "epam", "synthetic-epam"]);
    assert_eq!(ran.code, 0, "{}", ran.stderr);
    assert!(ran.stdout.contains("Where the scenario's model fails"), "{}", ran.stdout);
    assert!(ran.stderr.contains("ibr-report/compare-synthetic-epam/report.html"), "{}", ran.stderr);
    let read = |name: &str| std::fs::read(folder.path("ibr-report/compare-synthetic-epam").join(name)).unwrap();
    let manifest: Value = serde_json::from_slice(&read("manifest.json")).unwrap();
    let names = assert_hashes(&folder.path("ibr-report/compare-synthetic-epam"));
    assert!(names.iter().filter(|n| n.ends_with(".png")).all(|n| read(n).starts_with(b"\x89PNG\r\n")));
    assert!(names.iter().filter(|n| n.ends_with(".svg")).all(|n| read(n).starts_with(b"<svg")));
    for ending in [".png", ".svg", ".csv", ".parquet", ".html"] {
        assert!(names.iter().any(|name| name.ends_with(ending)), "{ending}");
    }
    assert_eq!(folder.contents().len(), names.len() + 1, "nothing else is left behind");
    let inputs: Vec<_> = manifest["inputs"].as_array().unwrap().iter().map(|i| i["name"].as_str().unwrap()).collect();
    assert_eq!(inputs, ["epam", "synthetic-epam (as read)"]);
    assert_opens_offline(&String::from_utf8(read("report.html")).unwrap());
}

#[test]
fn json_alone_writes_no_files() {
    let folder = Folder::new();
    folder.run(&["compare", "epam", "synthetic-epam", "--json"]).json("ibr.compare");
    assert!(folder.contents().is_empty());
}

#[test]
fn a_folder_below_a_file_is_refused_before_any_work() {
    let folder = with_report();
    folder.write("file", "text");
    let words = ["cannot write to file/x", "file is a file", "choose another folder with --out"];
    let commands: [&[&str]; 5] = [
        &["demo"],
        &["predict", "epam"],
        &["compare", "epam", "synthetic-epam"],
        &["data", "generate", "epam"],
        &["tradeoff"],
    ];
    for args in commands {
        refuse(&folder, &[args, &["--out", "file/x"]].concat(), 3, &words);
    }
    refuse(&folder, &["man", "--out", "file/x"], 3, &["cannot write to file/x"]);
    refuse(&folder, &["predict", "epam", "--out", "file"], 3, &["cannot write to file"]);
    refuse(&folder, &["predict", "epam", "--out", ""], 2, &["a value is required for '--out <OUT>'"]);
}

#[cfg(target_os = "linux")]
#[test]
fn a_folder_that_cannot_be_made_is_refused() {
    // Not even the superuser can make a folder there.
    refuse(&with_report(), &["predict", "epam", "--out", "/proc/ibr"], 3, &["cannot write to /proc/ibr"]);
}

#[test]
fn a_plot_of_a_prediction_is_written_where_it_is_wanted() {
    let folder = Folder::new();
    assert_eq!(folder.run(&["predict", "fpam", "--out", "a/b"]).code, 0);
    let names: Vec<_> = folder.contents().into_keys().map(|p| p.file_name().unwrap().to_owned()).collect();
    assert_eq!(names, ["manifest.json", "shapes.png", "shapes.svg"]);
}

#[test]
#[cfg(target_os = "linux")]
fn a_folder_whose_name_is_no_utf_8_is_as_good_as_any() {
    use std::os::unix::ffi::OsStrExt;
    let folder = Folder::new();
    folder.write("my.toml", crate::simulate::small());
    let commands: [(&[&str], &str); 3] = [
        (&["simulate", "my.toml", "--json"], "summary.json"),
        (&["data", "generate", "epam", "--json"], "markers.csv"),
        (&["compare", "epam", "synthetic-epam", "--json"], "report.html"),
    ];
    for (k, (args, file)) in commands.into_iter().enumerate() {
        let name = [b"out-\xff".as_slice(), &[b'0' + k as u8]].concat();
        let out = std::ffi::OsStr::from_bytes(&name);
        let ran = crate::support::Ran::from(folder.ibr(args).arg("--out").arg(out).output().unwrap());
        assert_eq!(ran.code, 0, "{args:?}: {}", ran.stderr);
        assert!(folder.path("").join(out).join(file).exists(), "{args:?}");
    }
}

#[test]
fn files_of_others_are_not_replaced_and_leavings_of_killed_processes_are_removed() {
    let folder = Folder::new();
    folder.write("mine/shapes.svg", "a picture of my own");
    folder.write("mine.svg", "a pattern of my own");
    for (args, words) in [
        (["predict", "fpam", "--out", "mine"], "mine/shapes.svg exists, and ibr did not write it"),
        (["pattern", "epam", "--out", "mine.svg"], "mine.svg exists, and ibr did not write it"),
    ] {
        refuse(&folder, &args, 2, &[words, "with --out"]);
    }
    folder.write(".made.incomplete-4194999/half.png", "half");
    folder.write("made/.incomplete-4194999/half.png", "half");
    folder.write(".made.svg.tmp", "not ours");
    for _ in 0..2 {
        assert_eq!(folder.run(&["predict", "fpam", "--out", "made"]).code, 0);
        assert_eq!(folder.run(&["pattern", "epam", "--out", "made.svg"]).code, 0);
    }
    let is_left = |path: &std::path::PathBuf| path.to_string_lossy().contains("incomplete");
    assert!(!folder.contents().keys().any(is_left) && folder.path(".made.svg.tmp").exists());
}
