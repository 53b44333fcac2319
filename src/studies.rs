//! Scenarios of finite element studies that come with the program, beside the four robots.

/// A robot in the paper's own model.
macro_rules! paper {
    ($name:literal, $about:literal, $robot:literal) => {
        ($name, $about, concat!(include_str!($robot), "\n[fem]\nmodel = \"paper\"\n"))
    };
}

/// Names, what they are about, and texts.
pub const STUDIES: &[(&str, &str, &str)] = &[
    ("cpam-11-12-13", "the cPAM in small steps of pressure", include_str!("../studies/cpam-11-12-13.toml")),
    ("cpam-mesh", "the cPAM on meshes of 4 to 1 mm", include_str!("../studies/cpam-mesh.toml")),
    paper!("spam-paper", "the sPAM as the paper modelled it", "../models/scenarios/spam.toml"),
    paper!("cpam-paper", "the cPAM as the paper modelled it", "../models/scenarios/cpam.toml"),
    paper!("epam-paper", "the ePAM as the paper modelled it", "../models/scenarios/epam.toml"),
    paper!("fpam-paper", "the fPAM as the paper modelled it", "../models/scenarios/fpam.toml"),
    ("long", "a robot of 2 m with 40 pouches", include_str!("../studies/long.toml")),
    ("tip-load", "a load on the tip", include_str!("../studies/tip-load.toml")),
    ("obstacle", "a cylinder in the way", include_str!("../studies/obstacle.toml")),
];

/// The text of a study.
pub fn study(name: &str) -> Option<&'static str> {
    STUDIES.iter().find(|s| s.0 == name).map(|s| s.2)
}
