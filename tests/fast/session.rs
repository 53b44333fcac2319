//! The library's way through a session: `examples/session.rs`, and that it says what the commands say.

use crate::support::Folder;
use std::process::Command;

/// Beside this test binary, where cargo puts what it builds with it.
fn example() -> Command {
    let tests = std::env::current_exe().unwrap();
    Command::new(tests.parent().unwrap().with_file_name("examples").join("session"))
}

#[test]
fn the_example_prints_the_numbers_of_the_commands() {
    let ran = example().output().expect("the example is built with the tests");
    let told = String::from_utf8(ran.stdout).unwrap();
    assert!(ran.status.success(), "{told}");
    let folder = Folder::new();
    let error_mm = |scenario: &str| {
        let answer = folder.run(&["compare", scenario, "synthetic-epam", "--json"]).json("ibr.compare");
        format!("{:.2} mm beyond noise", answer["overall"]["systematic_mm"].as_f64().unwrap())
    };
    let diagnosis = folder.run(&["diagnose", "epam-textbook", "synthetic-epam", "--json"]).json("ibr.diagnose");
    let added = folder.run(&["add", "epam-textbook", "best", "synthetic-epam", "--out", "extended.toml"]);
    let validate = ["validate", "extended.toml", "synthetic-epam-two-bodies", "--json"];
    let judged = folder.run(&validate).json("ibr.validate");
    let wanted = [format!("as given: {}\n", error_mm("epam-textbook"))]
        .into_iter()
        .chain(diagnosis["summary"].as_array().unwrap().iter().map(|s| format!("{}\n", s.as_str().unwrap())))
        .chain(added.stdout.lines().take_while(|line| !line.is_empty()).map(|line| format!("{line}\n")))
        .chain([format!("extended: {}\n", error_mm("extended.toml"))])
        .chain([format!("other data: {}\n", judged["datasets"][0]["sentence"].as_str().unwrap())]);
    assert_eq!(told, wanted.collect::<String>());
}
