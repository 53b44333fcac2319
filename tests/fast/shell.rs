//! The shell's side of `ibr`: help, completions, manual pages, pipes.

use crate::support::{Folder, Ran};
use std::io::{BufRead, BufReader};
use std::process::Stdio;

#[test]
fn help_names_every_command_and_the_exit_codes() {
    let help = Folder::new().run(&["--help"]);
    assert_eq!((help.code, help.stderr.as_str()), (0, ""));
    for word in [
        "demo",
        "predict",
        "compare",
        "simulate",
        "characterize",
        "data",
        "list",
        "new",
        "tradeoff",
        "verify",
        "bench",
        "completions",
        "man",
    ] {
        assert!(help.stdout.contains(&format!("\n  {word}")), "{word}");
        assert_eq!(Folder::new().run(&[word, "--help"]).code, 0, "{word}");
    }
    assert!(help.stdout.contains("130 interrupted"));
    assert!(Folder::new().run(&["--version"]).stdout.starts_with("ibr "));
}

#[test]
fn completions_are_made_for_the_common_shells() {
    for (shell, sign) in [("bash", "complete -F _ibr"), ("zsh", "#compdef ibr"), ("fish", "complete -c ibr")] {
        let ran = Folder::new().run(&["completions", shell]);
        assert!(ran.code == 0 && ran.stdout.contains(sign) && ran.stdout.contains("predict"), "{shell}");
    }
}

#[test]
fn the_manual_is_one_page_or_one_per_command() {
    let folder = Folder::new();
    let page = folder.run(&["man"]);
    assert!(page.code == 0 && page.stdout.contains(".TH ibr"), "{}", page.stdout);
    assert_eq!(folder.run(&["man", "--out", "pages"]).code, 0);
    for name in ["ibr.1", "ibr-predict.1", "ibr-compare.1"] {
        assert!(std::fs::read_to_string(folder.path("pages").join(name)).unwrap().contains(".TH"), "{name}");
    }
}

#[test]
fn a_reader_that_closes_the_pipe_ends_the_command_without_a_word() {
    let folder = Folder::new();
    // More than any pipe holds, so that the command still writes when the reader has gone.
    let pressures = (1..=2000).map(|i| format!("{i}Pa")).collect::<Vec<_>>().join(",");
    let mut command = folder.ibr(&["predict", "epam", "--json", "--pressure", &pressures]);
    let mut child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    let mut first = String::new();
    BufReader::new(child.stdout.take().unwrap()).read_line(&mut first).unwrap();
    let ran = Ran::from(child.wait_with_output().unwrap());
    assert_eq!((first.as_str(), ran.code, ran.stderr.as_str()), ("{\n", 0, ""));
}

#[test]
fn an_error_that_nobody_reads_keeps_its_exit_code() {
    let folder = Folder::new();
    let mut child = folder.ibr(&["predict", "nothing.toml"]).stderr(Stdio::piped()).spawn().unwrap();
    drop(child.stderr.take());
    assert_eq!(child.wait().unwrap().code(), Some(3));
}

#[test]
fn quiet_and_json_keep_progress_and_pages_away_from_standard_output() {
    let folder = Folder::new();
    let [plain, quiet] = [&["predict", "epam"][..], &["predict", "epam", "--quiet"]].map(|args| folder.run(args));
    assert_eq!((plain.stdout, plain.stderr), (quiet.stdout, quiet.stderr));
}

#[test]
fn every_effect_of_the_list_can_be_typed_as_listed() {
    let answer = Folder::new().run(&["list", "effects", "--json"]).json("ibr.list");
    let mut typed = 0;
    for effect in answer["effects"].as_array().unwrap() {
        let name = effect["name"].as_str().unwrap();
        let values = effect["parameters"].as_array().unwrap().iter();
        let values = values.map(|p| format!("{}={}", p["key"].as_str().unwrap(), p["typical"]));
        let text = format!("{name}:{}", values.collect::<Vec<_>>().join(","));
        for robot in ["epam", "fpam"] {
            typed += i32::from(Folder::new().run(&["predict", robot, "--effect", &text]).code == 0);
        }
    }
    let listed = answer["effects"].as_array().unwrap().len() as i32;
    assert!(typed >= listed, "every effect is for one robot at least: {typed} of {listed}");
}

#[test]
fn a_printed_scenario_is_a_scenario() {
    let folder = Folder::new();
    for robot in ["spam", "cpam", "epam", "fpam"] {
        folder.write("mine.toml", folder.run(&["new", robot]).stdout);
        let [mine, shipped] = ["mine.toml", robot].map(|s| folder.run(&["predict", s]).stdout);
        assert_eq!(mine, shipped);
    }
}
