//! What a user can type wrong, and what the case says then; and that what is right arrives in SI.

mod document;

use std::path::Path;

use super::*;
use crate::problem::{Amplitude, Gas, MassScaling, ObstacleShape, Pressure};

/// A case that uses every table.
const WHOLE: &str = r#"
kind = "fem"
name = "everything"
[mesh]
generator = "pillow"
side_mm = 400
elements = 4
gap_mm = 0.01
[fabric.film]
law = "isotropic"
e_MPa = 500
nu = 0.3
thickness_mm = 0.1
[fabric.stack]
law = "laminate"
plies = [{ fabric = "film" }, { fabric = "film", angle_deg = 90 }]
[part.top]
plies = [{ fabric = "film", angle_deg = 45 }, { fabric = "film", angle_deg = -45 }]
bonded = true
density_kg_m3 = 1100
bending_factor = 1
[part.all]
fabric = "stack"
angle_deg = 30
density_kg_m3 = 1000
[chamber.air]
pressure_kPa = 3
preset = "actuator"
sealed_at_s = 1.2
[[support]]
set = "centre_bottom"
axes = "xy"
[[support]]
set = "corners"
encastre = true
smooth_s_mm = [[0, 0, 0, 0], [1, 0, 0, 20]]
[[rigid]]
set = "rim"
[[force]]
set = "centre_top"
total_n = [0, 0, -2]
linear_s = [[0, 0], [0.5, 1]]
[gravity]
g_m_s2 = [0, 0, -9.81]
[[obstacle]]
shape = "plane"
point_mm = [0, 0, -300]
normal = [0, 0, 1]
friction = 0.3
[[obstacle]]
shape = "cylinder"
point_mm = [0, 0, 300]
axis = [0, 1, 0]
radius_mm = 50
[contact]
friction = 0.2
gap_mm = 0.01
thickness_mm = 0.1
parts = ["top"]
[settings]
preset = "paper"
end_s = 1.5
mass_scaling = 4
output_every_s = 0.02
seed = 7
[output]
probes = ["centre_top"]
stations_mm = [-100, 100]
station_parts = ["bottom"]
frames = false
view = "top"
"#;

fn no_files(path: &Path) -> Result<MeshFile, FemError> {
    Err(FemError::Io { path: path.to_path_buf(), source: std::io::ErrorKind::NotFound.into() })
}

pub(super) fn parse(text: &str) -> Result<Case, FemError> {
    Case::parse(text, &mut no_files)
}

/// The message for `WHOLE` with one piece replaced, and the text that the message points at.
fn broken(from: &str, to: &str) -> (String, String) {
    assert_eq!(WHOLE.matches(from).count(), 1, "{from}");
    refused(&WHOLE.replace(from, to))
}

pub(super) fn refused(text: &str) -> (String, String) {
    match parse(text) {
        Err(FemError::Case { message, span: Some(span) }) => (message, text[span].to_string()),
        other => panic!("{text}: {other:?}"),
    }
}

/// Each row: what is replaced, by what, the text pointed at, and words of the message.
fn check(rows: &[(&str, &str, &str, &[&str])]) {
    for (from, to, place, words) in rows {
        let (message, at) = broken(from, to);
        assert!(at.contains(place), "{to}: points at `{at}`: {message}");
        for word in *words {
            assert!(message.contains(word), "{to}: no `{word}` in: {message}");
        }
        assert_eq!(message.lines().count(), 2, "{to}: what is wrong, and what to type: {message}");
    }
}

#[test]
fn every_shipped_case_parses_and_runs_for_some_time() {
    for (name, text) in SHIPPED_CASES {
        let case = parse(text).unwrap_or_else(|e| panic!("{name}: {e}"));
        assert!(is_case(text) && !case.problem.name.is_empty(), "{name}");
        assert!(case.problem.settings.end_s > 0.0 && !case.outputs.probes.is_empty(), "{name}");
        assert_eq!(shipped_case(name), Some(*text));
    }
}

#[test]
fn the_pillow_is_the_one_of_the_literature() {
    let case = parse(shipped_case("pillow").unwrap()).unwrap();
    let (p, s) = (&case.problem, &case.problem.settings);
    assert_eq!((s.end_s, s.mass_damping_1_s, s.mass_scaling), (0.15, 100.0, MassScaling::None));
    let Pressure::Set(amplitude) = &p.chambers[0].pressure else { panic!("{:?}", p.chambers) };
    assert_eq!((amplitude.at(0.05), amplitude.at(0.0)), (5e3, 0.0));
    assert!((amplitude.at(0.025) - 2.5e3).abs() < 1e-9, "the smooth ramp is half way up at half time");
    let ply = &p.sections[0].plies[0];
    assert!((ply.fabric.thickness_m() - 6e-4).abs() < 1e-15);
    // Equal stretch in both directions: S = E t e/(1 − ν).
    let tension = ply.fabric.tension([1e-4, 1e-4, 0.0], &[0.0; 2])[0];
    assert!((tension - 588e6 * 6e-4 * 1e-4 / 0.6).abs() < 1e-9, "{tension}");
    let side = p.mesh.points.iter().fold(0.0_f64, |m, x| m.max(x[0])) * 2.0;
    assert!((side - 0.8485).abs() < 1e-12 && p.sections[0].density_kg_m3 == 1000.0, "{side}");
}

#[test]
fn every_table_arrives_in_si() {
    let case = parse(WHOLE).unwrap();
    let p = case.problem;
    assert_eq!(p.name, "everything");
    assert_eq!((p.sections.len(), p.mesh.parts[0].name.as_str()), (2, "top"));
    assert!((p.sections[0].plies[1].angle_rad + std::f64::consts::FRAC_PI_4).abs() < 1e-15);
    assert_eq!((p.sections[0].plies.len(), p.sections[0].bonded, p.sections[0].density_kg_m3), (2, true, 1100.0));
    assert_eq!((p.sections[1].plies.len(), p.sections[1].bonded, p.sections[1].bending_factor), (1, false, 0.1));
    assert!((p.sections[1].plies[0].fabric.thickness_m() - 2e-4).abs() < 1e-15, "two plies of 0.1 mm");
    let Pressure::Sealed { filling, sealed_at_s, gas } = &p.chambers[0].pressure else { panic!() };
    assert_eq!((filling.at(0.1), filling.at(1.1)), (0.0, 3e3));
    assert_eq!((*sealed_at_s, gas), (1.2, &Gas::default()));
    assert_eq!((p.supports[0].axes, p.supports[0].motion.is_none()), ([true, true, false], true));
    let motion = p.supports[1].motion.as_ref().unwrap();
    assert_eq!((motion[0].at(1.0), motion[2].at(1.0)), (0.0, 0.02));
    assert_eq!((p.forces[0].total_n[2], p.forces[0].amplitude.at(0.25)), (-2.0, 0.5));
    assert_eq!(p.gravity.as_ref().unwrap().amplitude, Amplitude::Constant(1.0));
    assert_eq!((p.obstacles.len(), p.obstacles[0].friction), (2, 0.3));
    assert!(matches!(p.obstacles[1].shape, ObstacleShape::Cylinder { radius_m: 0.05, .. }), "{:?}", p.obstacles);
    let contact = p.contact.as_ref().unwrap();
    assert!((contact.gap_m - 1e-5).abs() < 1e-18 && contact.parts == ["top"], "{contact:?}");
    let s = &p.settings;
    assert_eq!((s.end_s, s.mass_damping_1_s, s.mass_scaling, s.seed), (1.5, 5.0, MassScaling::Fixed(4.0), 7));
    let wanted = Outputs {
        probes: vec!["centre_top".into()],
        stations_m: vec![-0.1, 0.1],
        station_parts: vec!["bottom".into()],
        station_axis: [1.0, 0.0, 0.0],
        frames: false,
        pictures: true,
        view: Viewpoint::Top,
    };
    assert_eq!(case.outputs, wanted);
}

#[test]
fn an_encastre_support_holds_the_row_beside_its_own() {
    let p = parse(WHOLE).unwrap().problem;
    let held = &p.mesh.sets[&p.supports[1].set];
    // Each corner of the two layers of squares: itself, its two neighbours on the rim, one inner node per layer.
    assert_eq!(held.len(), 4 * 5, "{held:?}");
    assert!(p.mesh.sets["corners"].iter().all(|n| held.contains(n)));
    assert_eq!(p.supports[0].set, "centre_bottom");
}

#[test]
fn misspelt_keys_and_names_are_answered_with_what_was_meant() {
    check(&[
        ("side_mm = 400", "sdie_mm = 400", "sdie_mm", &["unknown key", "did you mean `side_mm`?"]),
        ("side_mm = 400", "side_m = 0.4", "side_m", &["did you mean `side_mm`?"]),
        ("end_s = 1.5", "end = 1.5", "end", &["unknown key `end`", "did you mean `end_s`?"]),
        ("bonded = true", "bondde = true", "bondde", &["did you mean `bonded`?"]),
        ("pressure_kPa = 3", "pressure_Pa = 3000", "pressure_Pa", &["did you mean `pressure_kPa`?"]),
        ("e_MPa = 500", "e_GPa = 0.5", "e_GPa", &["law \"isotropic\"", "did you mean `e_MPa`?"]),
        ("\"pillow\"", "\"pilow\"", "pilow", &["unknown generator", "did you mean `pillow`?"]),
        ("\"isotropic\"", "\"isotrop\"", "isotrop", &["unknown law", "did you mean `isotropic`?"]),
        ("law = \"isotropic\"", "material = \"tpu\"", "tpu", &["unknown material", "tpu-nylon"]),
        ("fabric = \"stack\"", "fabric = \"stakc\"", "stakc", &["unknown fabric", "did you mean `stack`?"]),
        ("[part.top]", "[part.tops]", "tops", &["unknown part", "did you mean `top`?"]),
        ("[chamber.air]", "[chamber.body]\npressure_kPa = 1\n[chamber.air]", "body", &["unknown chamber", "air"]),
        ("set = \"corners\"", "set = \"corner\"", "corner", &["unknown node set", "did you mean `corners`?"]),
        ("probes = [\"centre_top\"]", "probes = [\"centre\"]", "centre", &["unknown node set", "centre_top"]),
        ("parts = [\"top\"]", "parts = [\"tpo\"]", "tpo", &["unknown part", "did you mean `top`?"]),
        ("parts = [\"bottom\"]", "parts = [\"botom\"]", "botom", &["unknown part", "did you mean `bottom`?"]),
        ("\"plane\"", "\"plan\"", "plan", &["unknown shape", "did you mean `plane`?"]),
        ("view = \"top\"", "view = \"topp\"", "topp", &["unknown view", "did you mean `top`?"]),
        ("sealed_at_s = 1.2", "open_axis = \"q\"", "q", &["is not understood", "x, y and z"]),
        ("\"paper\"", "\"papre\"", "papre", &["unknown preset", "did you mean `paper`?"]),
        ("preset = \"actuator\"", "preset = \"acuator\"", "acuator", &["unknown preset", "`actuator`"]),
        ("kind = \"fem\"", "kind = \"fme\"", "fme", &["unknown kind", "did you mean `fem`?"]),
    ]);
}

#[test]
fn numbers_in_another_unit_or_out_of_range_are_refused_with_what_to_type() {
    check(&[
        ("side_mm = 400", "side_mm = 0.4", "0.4", &["from 1 to 100000 mm, not 0.4", "looks like metres"]),
        ("side_mm = 400", "side_mm = -400", "-400", &["not -400", "negative"]),
        ("side_mm = 400", "side_mm = nan", "nan", &["not NaN", "write a number"]),
        ("elements = 4", "elements = 4.5", "4.5", &["whole number"]),
        ("elements = 4", "elements = 0", "0", &["from 1 to 10000", "elements"]),
        ("elements = 4", "elements = 1000000", "1000000", &["from 1 to 10000"]),
        ("thickness_mm = 0.1\n[fabric.stack]", "thickness_mm = 1e-4\n[fabric.stack]", "1e-4", &["metres"]),
        ("thickness_mm = 0.1\n[fabric.stack]", "thickness_mm = -0.1\n[fabric.stack]", "-0.1", &["negative"]),
        ("thickness_mm = 0.1\n[fabric.stack]", "thickness_mm = 200\n[fabric.stack]", "200", &["micrometres"]),
        ("e_MPa = 500", "e_MPa = 500e6", "500e6", &["looks like pascals", "megapascals"]),
        ("nu = 0.3", "nu = 0.6", "0.6", &["from 0 to 0.5", "neo-hookean"]),
        ("density_kg_m3 = 1100", "density_kg_m3 = 1.1", "1.1", &["g/cm³", "write kg/m³"]),
        ("pressure_kPa = 3", "pressure_kPa = 3000", "3000", &["looks like pascals", "kilopascals"]),
        ("pressure_kPa = 3", "pressure_kPa = -3000", "-3000", &["looks like pascals", "a vacuum"]),
        ("sealed_at_s = 1.2", "sealed_at_s = 1200", "1200", &["milliseconds"]),
        ("pressure_kPa = 3", "pressure_kPa = -110", "chamber.air", &["a vacuum is -101.325 kPa"]),
        ("= 1.2\n", "= 1.2\npolytropic_exponent = 14\n", "14", &["from 1 to 1.67", "1.4 adiabatic"]),
        ("= 1.2\n", "= 1.2\ndead_volume_cm3 = -5\n", "-5", &["negative"]),
        ("= 1.2\n", "= 1.2\nleak_l_min_kPa = nan\n", "nan", &["L/min per kPa", "write a number"]),
        ("= 1.2\n", "= 1.2\ninflow_l_min = -2\n", "-2", &["L/min", "negative"]),
        ("= 1.2\n", "= 1.2\ninflow_linear_s_l_min = [[0, 0], [0, 2]]\n", "[[0, 0], [0, 2]]", &["must rise"]),
        ("sealed_at_s = 1.2", "sealed_at_s = 1.2\natmosphere_kPa = 101325", "101325", &["looks like pascals"]),
        ("friction = 0.3", "friction = 30", "30", &["from 0 to 2", "Coulomb"]),
        ("radius_mm = 50", "radius_mm = 0.05", "0.05", &["looks like metres"]),
        ("gap_mm = 0.01\nthickness_mm", "gap_mm = 1e-6\nthickness_mm", "1e-6", &["looks like metres"]),
        ("normal = [0, 0, 1]", "normal = [0, 0, 0]", "[0, 0, 0]", &["no direction"]),
        ("end_s = 1.5", "end_s = 0", "0", &["end_s must be", "some time"]),
        ("end_s = 1.5", "cfl = 2", "2", &["from 0.01 to 1", "0.9 is usual"]),
        ("end_s = 1.5", "hourglass = -1", "-1", &["negative"]),
        ("end_s = 1.5", "dt_s = 4", "4", &["leave it out", "microseconds"]),
    ]);
}

#[test]
fn settings_that_exclude_each_other_or_flood_the_disk_are_refused() {
    check(&[
        ("mass_scaling = 4", "mass_scaling = \"much\"", "much", &["not understood", "target_step_s = 4e-6"]),
        ("mass_scaling = 4", "mass_scaling = 0.1", "0.1", &["from 1 to"]),
        ("mass_scaling = 4", "mass_passes = 3", "3", &["mass_passes cannot be 3", "2, 4 or 6"]),
        ("mass_scaling = 4", "mass_scaling = 4\ntarget_step_s = 4e-6", "4", &["at once", "keep one"]),
        ("seed = 7", "seed = -7", "-7", &["seed must be from 0", "negative"]),
        ("output_every_s = 0.02", "output_every_s = 1e-6", "1e-6", &["1500000 outputs", "at least 1.5e-5"]),
    ]);
    let with = |text: &str| parse(&WHOLE.replace("mass_scaling = 4", text)).unwrap().problem.settings.mass_scaling;
    assert_eq!(with("mass_scaling = \"none\""), MassScaling::None);
    let passes = |text: &str| parse(&WHOLE.replace("mass_scaling = 4", text)).unwrap().problem.settings.mass_passes;
    assert_eq!(["mass_passes = 4", ""].map(passes), [4, 2]);
    assert_eq!(with("target_step_s = 4e-6"), MassScaling::TargetStep(4e-6));
    assert_eq!(with("mass_scaling = 2.5"), MassScaling::Fixed(2.5));
    let quasi_static = WHOLE.replace("mass_scaling = 4", "").replace("\"paper\"", "\"quasi-static\"");
    assert_eq!(parse(&quasi_static).unwrap().problem.settings.mass_scaling, MassScaling::Fixed(10.0));
}

#[test]
fn what_is_missing_or_said_twice_is_named() {
    check(&[
        ("preset = \"actuator\"", "smooth_s_kPa = [[0, 0], [1, 2]]", "chamber.air", &["a curve at once"]),
        ("pressure_kPa = 3\n", "", "actuator", &["a preset needs the pressure"]),
        ("pressure_kPa = 3\npreset = \"actuator\"\n", "", "chamber.air", &["without a pressure"]),
        ("sealed_at_s = 1.2", "atmosphere_kPa = 100", "100", &["sealed chamber only"]),
        ("sealed_at_s = 1.2", "dead_volume_cm3 = 9", "9", &["sealed chamber only", "sealed_at_s"]),
        ("= 1.2\n", "= 1.2\ninflow_l_min = 2\ninflow_smooth_s_l_min = [[0, 0], [1, 2]]\n", "2", &["at once"]),
        ("angle_deg = 30", "plies = []", "[]", &["at once", "keep one"]),
        ("fabric = \"stack\"\nangle_deg = 30", "plies = []", "[]", &["without a ply"]),
        ("fabric = \"stack\"\nangle_deg = 30\n", "", "part.all", &["without fabric"]),
        ("law = \"isotropic\"\n", "", "fabric.film", &["without law", "isotropic", "tpu-nylon"]),
        ("side_mm = 400\n", "", "[mesh]", &["lacks side_mm", "add side_mm"]),
        ("generator = \"pillow\"\n", "", "[mesh]", &["has no shape", "generator ="]),
        ("gap_mm = 0.01\n[fabric", "file = \"a.mesh\"\n[fabric", "a.mesh", &["at once"]),
        ("axes = \"xy\"", "axes = \"xq\"", "xq", &["not understood", "\"xyz\""]),
        ("axes = \"xy\"", "axes = \"\"", "\"\"", &["not understood"]),
        ("encastre = true", "encastre = true\naxes = \"x\"", "support", &["all three axes"]),
        ("normal = [0, 0, 1]", "radius_mm = 4", "obstacle", &["point_mm and normal"]),
        ("radius_mm = 50", "", "obstacle", &["point_mm, axis and radius_mm"]),
        ("linear_s = [[0, 0], [0.5, 1]]", "linear_s = [[0, 0], [0, 1]]", "[0, 1]", &["must rise"]),
        ("linear_s = [[0, 0], [0.5, 1]]", "linear_s = [[0, 0]]", "[[0, 0]]", &["two rows"]),
        ("smooth_s_mm = [[0, 0, 0, 0], [1, 0, 0, 20]]", "smooth_s_mm = []", "[]", &["two rows"]),
    ]);
}

#[test]
fn a_part_or_chamber_of_the_mesh_without_its_table_is_asked_for() {
    let without = |from: &str, to: &str| {
        let (start, end) = (WHOLE.find(from).unwrap(), WHOLE.find(to).unwrap());
        refused(&format!("{}{}", &WHOLE[..start], &WHOLE[end..])).0
    };
    assert!(without("[part.all]", "[chamber.air]").contains("add [part.bottom], or [part.all]"));
    assert!(without("[chamber.air]", "[[support]]").contains("add [chamber.air] with pressure_kPa"));
    assert!(without("[mesh]", "[fabric.film]").contains("missing field `mesh`"));
}

#[test]
fn fabrics_of_plies_are_made_in_any_order_and_never_of_themselves() {
    let renamed = WHOLE.replace("stack", "a");
    assert!(parse(&renamed).is_ok(), "the laminate comes first in the alphabet");
    check(&[
        ("plies = [{ fabric = \"film\" },", "plies = [{ fabric = \"stack\" },", "stack", &["made of itself"]),
        ("plies = [{ fabric = \"film\" },", "plies = [{ fabric = \"flim\" },", "flim", &["did you mean `film`?"]),
        ("plies = [{ fabric = \"film\" },", "plies = [{ fabrik = \"film\" },", "fabrik", &["plies: unknown field"]),
    ]);
}

#[test]
fn broken_toml_and_wrong_types_have_their_place() {
    check(&[
        ("kind = \"fem\"\n", "", "", &["missing field `kind`", "kind = \"fem\""]),
        ("[mesh]", "[mesh", "", &["unclosed table", "ibr new pillow"]),
        ("end_s = 1.5", "end_s = \"1.5\"", "1.5", &["not a text", "plain number"]),
        ("end_s = 1.5", "end_s = 1.5 s", "", &["ibr new pillow"]),
        ("seed = 7", "seed = 7.5", "7.5", &["whole number"]),
        ("side_mm = 400", "side_mm = \"400\"", "400", &["must be a number, not a text"]),
        ("total_n = [0, 0, -2]", "total_n = [0, -2]", "[0, -2]", &["length"]),
        ("total_n = [0, 0, -2]", "total_n = [0, 0, -2, 5]", "5]", &["length 4", "array of length 3", "x, y, z"]),
        ("[[0, 0], [0.5, 1]]", "[[0, 0, 7], [0.5, 1, 9]]", "7]", &["length 3", "time and value"]),
        ("[1, 0, 0, 20]]", "[1, 0, 0, 20, 5]]", "5]", &["array of length 4", "time, x, y, z"]),
    ]);
}

#[test]
fn a_mesh_file_is_read_through_the_given_function_only() {
    let start = WHOLE.find("generator").unwrap();
    let end = WHOLE.find("[fabric.film]").unwrap();
    let text = format!("{}file = \"sub/robot.mesh\"\nunit = \"m\"\n{}", &WHOLE[..start], &WHOLE[end..]);
    let pillow = parse(WHOLE).unwrap().problem.mesh;
    let mut asked = Vec::new();
    let case = Case::parse(&text, &mut |path: &Path| {
        asked.push(path.to_path_buf());
        Ok(pillow.clone().into())
    });
    assert_eq!(case.unwrap().problem.sections.len(), 2);
    assert_eq!(asked, [Path::new("sub/robot.mesh")]);
    let (message, place) = refused(&text);
    assert!(place.contains("robot.mesh") && message.contains("cannot be read"), "{message}");
    assert!(message.contains("folder of the case file"), "{message}");
}

#[test]
fn a_mesh_whose_chamber_leaks_is_refused() {
    let mut tube = String::from("kind = \"fem\"\n[mesh]\ngenerator = \"tube\"\ndiameter_mm = 80\nlength_mm = 100\n");
    tube += "elements_around = 12\nelements_along = 4\ntip_cap = \"CAP\"\n[fabric.nylon]\nmaterial = \"tpu-nylon\"\n";
    tube += "[part.all]\nfabric = \"nylon\"\ndensity_kg_m3 = 1000\n[chamber.body]\npressure_kPa = 2\n";
    assert!(parse(&tube.replace("CAP", "triangles")).is_ok() && parse(&tube.replace("CAP", "quads")).is_ok());
    let (message, place) = refused(&tube.replace("CAP", "open"));
    assert!(place == "[mesh]" && message.contains("body"), "{place}: {message}");
    let (message, place) = refused(&tube.replace("CAP", "shut"));
    assert!(place.contains("shut") && message.contains("\"triangles\", \"quads\", \"open\""), "{message}");
}

#[test]
fn an_empty_or_cut_text_is_an_error_not_a_panic() {
    for end in 0..WHOLE.len() {
        let _ = parse(&WHOLE[..end]);
    }
    assert!(parse("").unwrap_err().to_string().contains("missing field"));
}

#[test]
fn a_case_is_told_from_a_scenario_by_its_kind() {
    assert!(is_case(WHOLE) && is_case("# c\nkind='fem'") && is_case("kind = \"fem\nbroken"));
    assert!(!is_case(models::shipped("epam").unwrap()) && !is_case("[actuator]\nkind = \"fem\""));
}
