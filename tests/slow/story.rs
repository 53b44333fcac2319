//! The whole story on data made by another program's laws: diagnose, add, climb, validate at another body pressure.

use crate::alone;
use crate::support::Folder;

#[test]
fn a_hidden_effect_is_found_added_and_holds_on_data_it_was_not_fitted_to() {
    let _alone = alone();
    let folder = Folder::new();
    let make = |name: &str, protocol: &str, seed: &str| {
        let ran = folder.run(&[
            "challenge",
            "new",
            "--out",
            name,
            "--seed",
            seed,
            "--effect",
            "end_constraint",
            "--actuator",
            "epam",
            "--runs",
            "5",
            "--sigma",
            "1mm",
            "--protocol",
            protocol,
        ]);
        assert_eq!(ran.code, 0, "{}", ran.stderr);
    };
    make("one", "0,10,20,30,0@2", "5");
    make("other", "0,15,25,0@2", "5");
    let answer = folder.run(&["diagnose", "one/scenario.toml", "one", "--json"]).json("ibr.diagnose");
    assert_eq!(answer["verdict"], "effect", "{}", answer["summary"]);
    let set = answer["indistinguishable"].to_string();
    assert!(set.contains("end_constraint"), "{set}");
    let added = folder
        .run(&["add", "one/scenario.toml", "end_constraint", "one", "--out", "extended.toml", "--json"])
        .json("ibr.add");
    let fall = |key: &str| added["after"][key].as_f64().unwrap() / added["before"][key].as_f64().unwrap();
    assert!(fall("training_mm") < 0.3 && fall("heldout_pressure_mm") < 0.5, "{added}");
    let climbed = folder.run(&["ladder", "one/scenario.toml", "one", "--json"]).json("ibr.ladder");
    assert!(climbed["rungs"].as_array().unwrap().len() > 2, "{climbed}");
    let tried = folder.run(&["validate", "extended.toml", "other", "--json"]).json("ibr.validate");
    assert_eq!(tried["datasets"][0]["verdict"], "helps", "{tried}");
}
