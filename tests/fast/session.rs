//! The library's way through a session: `examples/session.rs` says what the commands say.

use crate::support::Folder;

#[path = "../../examples/session.rs"]
#[allow(dead_code, reason = "its main only prints")]
mod example;

#[test]
fn the_example_prints_the_numbers_of_the_commands() {
    let mut told = Vec::new();
    example::session(&mut |line| told.push(line)).unwrap();
    let folder = Folder::new();
    let error_mm = |scenario: &str| {
        let answer = folder.run(&["compare", scenario, "synthetic-epam", "--json"]).json("ibr.compare");
        format!("{:.2} mm beyond noise", answer["overall"]["systematic_mm"].as_f64().unwrap())
    };
    let diagnosis = folder.run(&["diagnose", "epam-textbook", "synthetic-epam", "--json"]).json("ibr.diagnose");
    let added = folder.run(&["add", "epam-textbook", "best", "synthetic-epam", "--out", "extended.toml"]);
    let validate = ["validate", "extended.toml", "synthetic-epam-two-bodies", "--json"];
    let judged = folder.run(&validate).json("ibr.validate");
    let wanted: Vec<String> = [format!("as given: {}", error_mm("epam-textbook"))]
        .into_iter()
        .chain(diagnosis["summary"].as_array().unwrap().iter().map(|s| s.as_str().unwrap().to_string()))
        .chain(added.stdout.lines().take_while(|line| !line.is_empty()).map(String::from))
        .chain([format!("extended: {}", error_mm("extended.toml"))])
        .chain([format!("other data: {}", judged["datasets"][0]["sentence"].as_str().unwrap())])
        .collect();
    assert_eq!(told, wanted);
}
