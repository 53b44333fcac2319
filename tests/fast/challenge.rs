//! `ibr challenge` seals, opens and refuses, and its hash is right.

use crate::refused::refuse;
use crate::support::Folder;
use sha2::{Digest, Sha256};

fn make(folder: &Folder, more: &[&str]) -> String {
    let ran = folder.run(&[&["challenge", "new", "--out", "c", "--seed", "5"], more].concat());
    assert_eq!(ran.code, 0, "{}", ran.stderr);
    ran.stdout
}

#[test]
fn the_truth_is_in_no_file_of_a_challenge_and_comes_out_when_it_is_revealed() {
    let folder = Folder::new();
    let said = make(&folder, &["--effect", "friction=1.25", "--actuator", "epam", "--runs", "3"]);
    for (path, bytes) in folder.contents() {
        let text = String::from_utf8_lossy(&bytes).to_lowercase();
        // The command line is in the manifest; whoever typed the effect knows it.
        assert!(path.ends_with("manifest.json") || !text.contains("friction"), "{}", path.display());
    }
    let shown = folder.run(&["challenge", "reveal", "c"]);
    assert!(shown.stdout.contains("Hidden: friction (1.25 typical sizes)"), "{}", shown.stdout);
    let seal = said.lines().find(|line| line.starts_with("Seal")).unwrap().rsplit(' ').next().unwrap().to_string();
    assert!(shown.stdout.contains(&seal));
    assert_eq!(folder.run(&["data", "check", "c"]).code, 0);
    assert_eq!(folder.run(&["predict", "c/scenario.toml"]).code, 0);
}

#[test]
fn the_same_seed_makes_the_same_challenge_and_no_seed_another_one() {
    let (a, b) = (Folder::new(), Folder::new());
    assert_eq!(make(&a, &[]), make(&b, &[]));
    for file in ["markers.csv", "seal.toml", "scenario.toml", "about.toml"] {
        let read = |folder: &Folder| std::fs::read(folder.path("c").join(file)).unwrap();
        assert!(read(&a) == read(&b), "{file}");
    }
    let seal = |name: &str| {
        assert_eq!(a.run(&["challenge", "new", "--out", name]).code, 0);
        std::fs::read(a.path(name).join("seal.toml")).unwrap()
    };
    assert!(seal("d") != seal("e"));
}

/// The hash of the data in a folder as they are read.
fn data_sha256(folder: &Folder) -> String {
    let (dataset, _) = data::load(&folder.path("c").display().to_string(), &mut |_, _| ()).unwrap();
    let mut bytes = Vec::new();
    data::write_markers_csv(&dataset, &mut bytes).unwrap();
    Sha256::digest(&bytes).iter().map(|b| format!("{b:02x}")).collect()
}

#[test]
fn a_diagnosis_is_scored() {
    let folder = Folder::new();
    make(&folder, &["--effect", "leak", "--actuator", "spam"]);
    let hash = data_sha256(&folder);
    let answer = |rest: &str| folder.write("answer.json", format!("{{\"data_sha256\": [\"{hash}\"], {rest}}}"));
    answer(
        r#""verdict": "effect", "ranked": [{"effect": "creep", "at_bound": true}, {"effect": "leak", "at_bound": false}],
        "indistinguishable": ["leak", "creep"], "added": [{"effect": "leak"}]"#,
    );
    let args = ["challenge", "reveal", "c", "answer.json"];
    let told = folder.run(&args).stdout;
    assert!(told.contains("The diagnosis states: effect, which is right."), "{told}");
    assert!(told.contains("place 1 of the ranking and in the stated set of 2 (leak, creep)"), "{told}");
    let json = folder.run(&[&args[..], &["--json"]].concat()).json("ibr.challenge.reveal");
    assert_eq!(json["diagnosis"]["score"]["rank"], 1);
    assert_eq!(json["truth"]["effect"][0]["name"], "leak");
    answer(r#""verdict": "none""#);
    assert!(folder.run(&args).stdout.contains("none, which is wrong"));
    answer(r#""verdict": "perhaps""#);
    refuse(&folder, &args, 3, &["`verdict` \"perhaps\" is none of"]);
}

#[test]
fn a_diagnosis_of_one_run_is_not_scored_and_one_of_other_data_refused() {
    let folder = Folder::new();
    make(&folder, &["--actuator", "epam", "--runs", "1"]);
    let diagnosed = folder.run(&["diagnose", "c/scenario.toml", "c", "--json"]);
    folder.write("answer.json", &diagnosed.stdout);
    let args = ["challenge", "reveal", "c", "answer.json"];
    let told = folder.run(&args);
    assert!(told.stdout.contains("gives no verdict: it is not scored"), "{}{}", told.stdout, told.stderr);
    let json = folder.run(&[&args[..], &["--json"]].concat()).json("ibr.challenge.reveal");
    assert!(json["diagnosis"]["answer"]["verdict"].is_null() && json["diagnosis"]["score"].is_null(), "{json}");
    assert_eq!(folder.run(&["challenge", "new", "--out", "c", "--force", "--seed", "6"]).code, 0);
    refuse(&folder, &args, 3, &["it is a diagnosis of other data (`c`), not of c"]);
    folder.write("answer.json", r#"{"verdict": "none"}"#);
    refuse(&folder, &args, 3, &["does not say of which data", "ibr diagnose c/scenario.toml c --json"]);
}

#[test]
fn a_broken_seal_or_a_changed_file_is_noticed() {
    let folder = Folder::new();
    make(&folder, &[]);
    let reveal = ["challenge", "reveal", "c"];
    for (name, change) in [("markers.csv", "1,"), ("scenario.toml", "#"), ("about.toml", "#")] {
        let file = format!("c/{name}");
        let text = std::fs::read_to_string(folder.path(&file)).unwrap();
        folder.write(&file, format!("{text}{change}"));
        refuse(&folder, &reveal, 3, &[name, "the file is not the one that was sealed"]);
        folder.write(&file, text);
    }
    let seal = std::fs::read_to_string(folder.path("c/seal.toml")).unwrap();
    let (start, truth) = seal.split_once("truth = \"").unwrap();
    folder.write("c/seal.toml", format!("{start}truth = \"0000{}", &truth[4..]));
    refuse(&folder, &reveal, 3, &["the seal is broken"]);
    folder.write("c/seal.toml", seal.replace("version = 2", "version = 1"));
    refuse(&folder, &reveal, 3, &["the seal is of format 1, this program opens format 2"]);
    folder.write("c/seal.toml", "nonsense");
    refuse(&folder, &reveal, 3, &["seal.toml"]);
    refuse(&folder, &["challenge", "reveal", "nowhere"], 3, &["nowhere/seal.toml", "ibr challenge new"]);
}

#[test]
fn what_cannot_be_hidden_is_refused_and_nothing_is_replaced_unasked() {
    let folder = Folder::new();
    let new = |more: &[&'static str]| [&["challenge", "new", "--out", "c"], more].concat();
    refuse(&folder, &new(&["--effect", "magic"]), 2, &["no hidden effect `magic`", "known: end_constraint"]);
    refuse(&folder, &new(&["--effect", "frction"]), 2, &["did you mean friction?"]);
    refuse(
        &folder,
        &new(&["--effect", "none", "--effect", "friction"]),
        2,
        &["--effect none cannot be given with others"],
    );
    refuse(&folder, &new(&["--effect", "creep=x"]), 2, &["`x` is not a size", "creep=1.2"]);
    refuse(&folder, &new(&["--effect", "creep=99"]), 2, &["not a size from 0.05 to 3"]);
    refuse(&folder, &new(&["--effect", "creep", "--effect", "creep"]), 2, &["given twice"]);
    refuse(&folder, &new(&["--actuator", "nosuch"]), 3, &["known: spam, cpam, epam, fpam"]);
    let not_here = ["--effect", "shear_lock", "--actuator", "epam"];
    refuse(&folder, &new(&not_here), 3, &["shear_lock does not exist for a robot of actuator epam"]);
    refuse(&folder, &new(&["--sigma", "5"]), 2, &["has no unit"]);
    make(&folder, &[]);
    refuse(&folder, &new(&["--seed", "6"]), 2, &["already holds a challenge", "--force"]);
    assert_eq!(folder.run(&new(&["--seed", "6", "--force"])).code, 0);
}

#[test]
fn the_list_says_what_can_be_hidden() {
    let list = Folder::new().run(&["challenge", "list", "--json"]).json("ibr.challenge.list");
    assert_eq!(list["effects"].as_array().unwrap().len(), 36);
}
