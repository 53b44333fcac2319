//! `ibr data generate`: the embedded synthetic sets can be made again, byte for byte.

use crate::refused::refuse;
use crate::support::{Folder, repository};

const TWO_BODIES: &str = "0,10,20,30,0@2; 0,20,40,60,0@4";

#[test]
fn every_synthetic_set_is_made_again_byte_for_byte_from_its_truth() {
    let synthetic: Vec<String> =
        data::sets().into_iter().map(|s| s.name).filter(|name| name.starts_with("synthetic-")).collect();
    assert_eq!(synthetic.len(), 5);
    for name in synthetic {
        let set = repository().join("data/sets").join(&name);
        let truth = set.join("truth.toml").display().to_string();
        let (seed, protocol) =
            if name == "synthetic-epam-two-bodies" { ("12", TWO_BODIES) } else { ("11", "0,10,20,30,0@2") };
        let folder = Folder::new();
        let args =
            ["data", "generate", &truth, "--out", &name, "--seed", seed, "--scatter", "white", "--protocol", protocol];
        assert_eq!(folder.run(&args).code, 0, "{name}");
        for file in ["markers.csv", "about.toml", "truth.toml"] {
            let made = std::fs::read(folder.path(&name).join(file)).unwrap();
            assert!(made == std::fs::read(set.join(file)).unwrap(), "{name}/{file}");
        }
        let hidden = std::fs::read_to_string(set.join("truth.toml")).unwrap();
        let hidden = hidden.lines().next().unwrap().trim_start_matches("name = ").trim_matches('"');
        assert!(!folder.run(&["list", "datasets"]).stdout.contains(hidden), "{name} shows its answer: {hidden}");
    }
}

#[test]
fn every_finite_element_set_is_made_again_byte_for_byte_from_the_stored_runs() {
    for robot in ["spam", "cpam", "epam", "fpam"] {
        let (folder, name) = (Folder::new(), format!("fem-{robot}"));
        let ran = folder.run(&[
            "data",
            "fem",
            &format!("{robot}-textbook"),
            "--stored",
            "--scatter",
            "white",
            "--seed",
            "21",
            "--out",
            &name,
        ]);
        assert_eq!(ran.code, 0, "{}", ran.stderr);
        for file in ["markers.csv", "about.toml", "truth.toml"] {
            let made = std::fs::read(folder.path(&name).join(file)).unwrap();
            assert!(
                made == std::fs::read(repository().join("data/sets").join(&name).join(file)).unwrap(),
                "{name}/{file}"
            );
        }
    }
}

#[test]
fn finite_element_data_that_cannot_be_made_are_refused_before_anything_is_written() {
    let folder = Folder::new();
    refuse(
        &folder,
        &["data", "fem", "epam", "--stored", "--seeds", "900", "--out", "a"],
        2,
        &["come with the program", "--seeds"],
    );
    refuse(&folder, &["data", "fem", "pillow", "--stored", "--out", "a"], 3, &["pillow"]);
    refuse(&folder, &["data", "fem", "epam", "--stored", "--pressure", "90kPa", "--out", "a"], 3, &["up to 30.0 kPa"]);
    assert!(!folder.path("a").exists());
}

#[test]
fn another_seed_gives_other_scatter() {
    let folder = Folder::new();
    for seed in ["1", "2"] {
        assert_eq!(folder.run(&["data", "generate", "epam", "--seed", seed, "--out", seed]).code, 0);
    }
    let [one, two] = ["1", "2"].map(|name| std::fs::read(folder.path(name).join("markers.csv")).unwrap());
    assert!(one != two);
}

#[test]
fn an_existing_set_is_replaced_only_when_forced() {
    let folder = Folder::new();
    assert_eq!(folder.run(&["data", "generate", "epam", "--out", "set"]).code, 0);
    let again = ["data", "generate", "epam", "--out", "set", "--seed", "2"];
    refuse(&folder, &again, 2, &["set already holds a dataset", "add --force to replace it"]);
    let before = folder.contents();
    assert_eq!(folder.run(&[&again[..], &["--force"]].concat()).code, 0);
    assert!(folder.contents() != before);
}

#[test]
fn a_generated_set_loads_and_agrees_with_its_own_truth() {
    let folder = Folder::new();
    assert_eq!(folder.run(&["data", "generate", "fpam", "--seed", "5", "--out", "set"]).code, 0);
    let answer = folder.run(&["compare", "set/truth.toml", "set", "--json"]).json("ibr.compare");
    let overall = &answer["overall"];
    assert!(overall["systematic_mm"].as_f64().unwrap() < 1.0, "{overall}");
    assert!(overall["p_value"].as_f64().unwrap() > 0.001, "{overall}");
}

#[test]
fn what_cannot_be_generated_is_refused_with_an_example() {
    let folder = Folder::new();
    let text = models::shipped("epam").unwrap();
    let bare: Vec<&str> = text.lines().filter(|line| !line.starts_with("s_mm")).collect();
    folder.write("bare.toml", bare.join("\n"));
    let refused = |args: &[&str], words: &[&str]| {
        refuse(&folder, &[&["data", "generate"], args, &["--out", "set"]].concat(), 2, words);
    };
    refused(&["bare.toml"], &["bare.toml has no marker stations", "s_mm = [30, 90, 150]"]);
    refused(&["epam", "--protocol", "0,10"], &["a body pressure is missing (after `@`)", "\"0,10,20,30,0@2"]);
    refused(&["epam", "--protocol", "0,x@2"], &["`x` is not a number"]);
    refused(&["epam", "--protocol", ""], &["it has no hold"]);
    refused(&["epam", "--protocol", "0,1900@2"], &["actuator pressure must be from 0 to 1000 kPa, not 1900"]);
    refused(&["epam", "--sigma", "5"], &["--sigma", "`5` has no unit"]);
    refused(&["epam", "--sigma", "-1mm"], &["--sigma", "not from 0 to 100 mm"]);
    refused(&["epam", "--scatter", "pressure=nan"], &["not from 0 to 50 per cent"]);
    refused(&["epam", "--scatter", "pressure=-3%"], &["not from 0 to 50 per cent"]);
    refused(&["epam", "--runs", "0"], &["0 is not in 1..=10000"]);
}
