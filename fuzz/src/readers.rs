//! Everything that reads what people give, each with good inputs from the tests of the libraries.

use data::import::{FilePlace, ImportOptions, Scale, import, read_board};
use data::{CouponDefaults, ReadOptions};
use fem::case::{Case, shipped_case};
use fem::mesh::file::MeshFile;
use fem::session::{FileHash, MANIFEST, Maker, Manifest, RunSource, SUMMARY, Summary};
use fem::{FemError, Simulation};
use models::{Loads, Model, Scenario};
use std::path::{Path, PathBuf};
use std::sync::LazyLock;

#[derive(Debug)]
pub(crate) struct Reader {
    pub name: &'static str,
    good: Good,
    /// Reads, as the program does; whether it was read without an error.
    pub read: fn(&[u8]) -> bool,
}

#[derive(Debug)]
enum Good {
    Files(&'static [&'static str]),
    Made(fn() -> Vec<Vec<u8>>),
}

const fn of(name: &'static str, files: &'static [&'static str], read: fn(&[u8]) -> bool) -> Reader {
    Reader { name, good: Good::Files(files), read }
}

const fn made(name: &'static str, make: fn() -> Vec<Vec<u8>>, read: fn(&[u8]) -> bool) -> Reader {
    Reader { name, good: Good::Made(make), read }
}

pub(crate) const READERS: &[Reader] = &[
    made("scenario", scenarios, scenario),
    made("formula", formulas, formula),
    of(
        "markers",
        &[
            "data/tests/cases/reference_markers.csv",
            "data/tests/cases/space_markers.csv",
            "data/sets/jitosho-2023-arm/markers.csv",
            "data/tests/cases/c06-spreadsheet-locale/semicolon_decimal_comma_bom.csv",
        ],
        markers,
    ),
    of(
        "about",
        &[
            "data/tests/cases/reference_about.toml",
            "data/sets/jitosho-2023-arm/about.toml",
            "data/sets/synthetic-epam/about.toml",
        ],
        about,
    ),
    of(
        "coupons",
        &[
            "data/sets/nylon-offaxis/coupon_45.csv",
            "data/tests/cases/c18-bluehill/raw.csv",
            "data/tests/cases/c18-bluehill/decimal_comma.csv",
            "data/tests/cases/c18-bluehill/two_specimens_side_by_side.csv",
        ],
        coupons,
    ),
    of(
        "bench",
        &["data/sets/breukels-2011-beams/load_deflection.csv", "data/sets/mckibben-free/force_contraction.csv"],
        bench,
    ),
    of("base", &["data/sets/synthetic-epam/markers.csv", "data/tests/made/correction.csv"], base),
    of("study", &["studies/epam-designs.toml"], study),
    of("wish", &["studies/epam-wish.toml"], wish),
    made("parquet", parquets, parquet),
    made("case", cases, case),
    made("robot", robots, robot),
    of("mesh-gmsh", &["fem/tests/meshes/cube_gmsh41.msh", "fem/tests/meshes/cube_gmsh22.msh"], mesh),
    of("mesh-abaqus", &["fem/tests/meshes/cubes.inp", "fem/tests/meshes/cushion_cae.inp"], mesh),
    of("mesh-stl", &["fem/tests/meshes/cubes.stl", "fem/tests/meshes/cushion.stl"], mesh),
    of("deeplabcut", &["data/tests/cases/c01-deeplabcut/run1.csv", "data/tests/made/deeplabcut_multi.csv"], pixels),
    of("sleap", &["data/tests/made/sleap.csv"], pixels),
    of("vicon", &["data/tests/cases/c21-vicon-nexus/trial1.csv"], lengths),
    of("trc", &["data/tests/cases/c22-trc/run1.trc"], lengths),
    of("qualisys", &["data/tests/cases/c23-qualisys-tsv/m1.tsv"], lengths),
    of("motive", &["data/tests/cases/c02-motive/vine_1.csv", "data/tests/made/motive_mm.csv"], lengths),
    of("tracker", &["data/tests/made/tracker_one.txt", "data/tests/made/tracker_multi.txt"], metres),
    of(
        "kinovea",
        &[
            "data/tests/made/kinovea_seconds.csv",
            "data/tests/made/kinovea_trajectory.txt",
            "data/tests/cases/c04-kinovea/run1_kinematics.csv",
            "data/tests/cases/c04-kinovea/run1_trajectories.txt",
        ],
        pixels,
    ),
    of(
        "trackmate",
        &[
            "data/tests/made/trackmate_spots.csv",
            "data/tests/made/trackmate_tracks.xml",
            "data/tests/made/trackmate_model.xml",
        ],
        pixels,
    ),
    of("ros", &["data/tests/cases/c25-ros-echo/all_markers.csv", "data/tests/cases/c25-ros-echo/marker_b.csv"], ros),
    of("anipose", &["data/tests/made/anipose.csv"], millimetres),
    of("trackpy", &["data/tests/made/trackpy.csv"], pixels),
    of("wide", &["data/tests/cases/c07-table-dialects/wide.csv", "data/tests/made/wide_pixels.csv"], lengths),
    of("long", &["data/tests/made/long_foreign.tsv", "data/tests/cases/reference_markers.csv"], mapped),
    of(
        "pressure-log",
        &[
            "data/tests/cases/c01-deeplabcut/pressure.csv",
            "data/tests/cases/c26-pressure-loggers/labview.lvm",
            "data/tests/cases/c26-pressure-loggers/arduino_serial.txt",
            "data/tests/cases/c26-pressure-loggers/arduino_noheader.csv",
        ],
        log,
    ),
    of("board", &["data/tests/made/board.csv"], board),
    made("checkpoint", checkpoints, checkpoint),
    made("record", records, record),
];

impl Reader {
    pub(crate) fn corpus(&self) -> Vec<Vec<u8>> {
        match self.good {
            Good::Files(files) => {
                files.iter().map(|file| std::fs::read(repository(file)).unwrap_or_default()).collect()
            }
            Good::Made(make) => make(),
        }
    }
}

fn repository(file: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..").join(file)
}

/// What readers of files are given; they are done with it before the next one.
fn as_file(bytes: &[u8], name: &str) -> PathBuf {
    static FOLDER: LazyLock<PathBuf> =
        LazyLock::new(|| std::env::temp_dir().join(format!("ibr-fuzz-{}", std::process::id())));
    let path = FOLDER.join(name);
    if std::fs::write(&path, bytes).is_err() {
        // The first one; a disk that is full shows as inputs that are never read.
        let _ = std::fs::create_dir_all(&*FOLDER).and_then(|()| std::fs::write(&path, bytes));
    }
    path
}

fn texts(list: &[&str]) -> Vec<Vec<u8>> {
    list.iter().map(|text| text.as_bytes().to_vec()).collect()
}

/// A formula of the scenario's own.
const FORMULA: &str = "
[[formula]]
name = \"spring\"
moment = \"FORMULA\"
[formula.parameters.k]
unit = \"N m\"
typical = 0.5
bounds = [0, 20]
[effects.spring]
k = 0.5
";

fn scenarios() -> Vec<Vec<u8>> {
    let textbook = models::shipped("epam-textbook").unwrap_or_default();
    let spring = format!("{textbook}{}", FORMULA.replace("FORMULA", "-k*theta^3 * exp(-s/R)"));
    let zone = format!("{textbook}\n[[zone]]\nfrom_mm = 10\nto_mm = 50\nradius_mm = 30\n");
    let strips = format!("{textbook}\n[[strip]]\nazimuth_deg = 180\nturns = 0.2\nchannel = 1\n");
    let shipped = |name: &str| models::shipped(name).unwrap_or_default();
    texts(&[shipped("epam"), shipped("fpam"), &spring, &zone, &strips])
}

fn predicts(text: &str) -> bool {
    let Ok(scenario) = Scenario::parse(text) else { return false };
    let model = Model::new(&scenario);
    model.predict(&Loads::uniform(scenario.p_body_pa, 30e3), &mut model.prediction()).is_ok()
}

fn scenario(bytes: &[u8]) -> bool {
    std::str::from_utf8(bytes).is_ok_and(predicts)
}

fn formulas() -> Vec<Vec<u8>> {
    texts(&[
        "-k*theta^3 * exp(-s/R)",
        "-k*(kappa*R - 0.1)",
        "-k*p_act/p_body*sin(theta)/(1 + theta^2)",
        "-k*sqrt(abs(theta))*tanh(s/R)",
        "-k*max(theta, 0.1)^2",
        "-k*ln(1 + theta^2)",
        "-k*min(theta, 1)*cos(theta)",
    ])
}

fn formula(bytes: &[u8]) -> bool {
    let written = String::from_utf8_lossy(bytes).replace('\\', "\\\\").replace('"', "\\\"").replace(['\n', '\r'], " ");
    let textbook = models::shipped("epam-textbook").unwrap_or_default();
    predicts(&format!("{textbook}{}", FORMULA.replace("FORMULA", &written)))
}

/// Predictions of another simulator for an embedded set, or a correction of them.
fn base(bytes: &[u8]) -> bool {
    let (text, set) = (String::from_utf8_lossy(bytes), data::load("synthetic-epam", &mut |_, _| ()));
    let is_base = set.is_ok_and(|(set, _)| data::parse_predictions("base.csv", &text, &set).is_ok());
    is_base || data::parse_correction("correction.csv", &text).is_ok()
}

fn markers(mut bytes: &[u8]) -> bool {
    let read = data::parse_markers("markers.csv", &mut bytes, ReadOptions::default(), &mut |_, _| ());
    read.is_ok_and(|dataset| {
        data::check(&dataset, None);
        let aside = dataset.left_aside();
        aside.is_ok() || dataset.to_table().rows() > 0
    })
}

fn about(bytes: &[u8]) -> bool {
    std::str::from_utf8(bytes).is_ok_and(|text| data::parse_about("about.toml", text).is_ok())
}

/// Its robot is one that comes with the program.
fn study(bytes: &[u8]) -> bool {
    let epam = |_: &str| compare::ScenarioFile::read("epam");
    std::str::from_utf8(bytes).is_ok_and(|text| sweep::Study::parse("study.toml", text, Path::new(""), epam).is_ok())
}

fn wish(bytes: &[u8]) -> bool {
    let epam = |_: &str| compare::ScenarioFile::read("epam");
    let read = |text| sweep::design::Wish::parse("wish.toml", text, Path::new(""), epam);
    std::str::from_utf8(bytes).is_ok_and(|text| read(text).is_ok())
}

/// As it is, and with what an export of a machine leaves out.
fn coupons(bytes: &[u8]) -> bool {
    let exported = CouponDefaults { direction_deg: Some(0.0), length_m: Some(0.15), ..CouponDefaults::default() };
    [CouponDefaults::default(), exported]
        .iter()
        .any(|known| data::parse_coupons("coupon.csv", &mut &*bytes, bytes.len() as u64, known, &mut |_, _| ()).is_ok())
}

fn bench(bytes: &[u8]) -> bool {
    std::str::from_utf8(bytes).is_ok_and(|text| data::parse_bench("bench.csv", text).is_ok_and(|bench| bench.is_some()))
}

fn parquets() -> Vec<Vec<u8>> {
    let columns = vec![
        ("run".into(), data::Column::Str(vec!["1".into(), "1".into()])),
        ("marker".into(), data::Column::I64(vec![1, 2])),
        ("x_mm".into(), data::Column::F64(vec![30.0, 90.5])),
    ];
    let path = as_file(b"", "made.parquet");
    let written = data::Table { columns }.to_parquet(&path, &[]).is_ok();
    vec![if written { std::fs::read(path).unwrap_or_default() } else { Vec::new() }]
}

fn parquet(bytes: &[u8]) -> bool {
    data::read_parquet(&as_file(bytes, "markers.parquet")).is_ok()
}

fn cases() -> Vec<Vec<u8>> {
    let shipped = ["pillow", "tube", "blocked-pouch"].map(|name| shipped_case(name).unwrap_or_default());
    texts(&shipped)
}

fn case(bytes: &[u8]) -> bool {
    let mut read_mesh =
        |_: &Path| -> Result<MeshFile, FemError> { fem::mesh::file::read(&repository("fem/tests/meshes/cushion.msh")) };
    std::str::from_utf8(bytes).is_ok_and(|text| Case::parse(text, &mut read_mesh).is_ok())
}

fn robots() -> Vec<Vec<u8>> {
    texts(&["epam", "fpam"].map(|name| models::shipped(name).unwrap_or_default()))
}

fn robot(bytes: &[u8]) -> bool {
    std::str::from_utf8(bytes).is_ok_and(|text| RunSource::new("robot.toml", text).robot_run().is_ok())
}

fn mesh(bytes: &[u8]) -> bool {
    fem::mesh::file::read(&as_file(bytes, "mesh")).is_ok_and(|file| {
        let chambers = file.mesh.parts.iter().flat_map(|part| [&part.front, &part.back]);
        let chambers: Vec<&str> = chambers.filter_map(|name| name.as_deref()).collect();
        fem::mesh::check::check(&file.mesh, &chambers).is_ok()
    })
}

fn tracks(bytes: &[u8], options: &ImportOptions) -> bool {
    import(&[as_file(bytes, "tracks.csv")], options, &mut |_, _| ()).is_ok()
}

/// The clock of all recordings of the tests.
fn lengths_options() -> ImportOptions {
    let log = repository("data/tests/cases/c01-deeplabcut/pressure.csv");
    ImportOptions { pressure_logs: vec![log], actuator: Some("epam".into()), ..ImportOptions::default() }
}

fn pixel_options() -> ImportOptions {
    ImportOptions {
        scale: Scale::PixelsPerMetre(3100.0),
        base: Some(FilePlace::At(vec![212.0, 540.0])),
        frames_per_s: Some(30.0),
        ..lengths_options()
    }
}

fn lengths(bytes: &[u8]) -> bool {
    tracks(bytes, &lengths_options())
}

fn metres(bytes: &[u8]) -> bool {
    tracks(bytes, &ImportOptions { scale: Scale::Unit(1.0), ..lengths_options() })
}

fn millimetres(bytes: &[u8]) -> bool {
    tracks(bytes, &ImportOptions { scale: Scale::Unit(1e-3), frames_per_s: Some(30.0), ..lengths_options() })
}

fn ros(bytes: &[u8]) -> bool {
    let log = repository("data/tests/cases/c25-ros-echo/pressure.csv");
    tracks(bytes, &ImportOptions { pressure_logs: vec![log], body_pa: Some(2e3), ..lengths_options() })
}

fn pixels(bytes: &[u8]) -> bool {
    tracks(bytes, &pixel_options())
}

fn mapped(bytes: &[u8]) -> bool {
    tracks(bytes, &ImportOptions::default()) || tracks(bytes, &ImportOptions { bin_pa: Some(2e3), ..lengths_options() })
}

/// With the names in the file, and with typed ones.
fn log(bytes: &[u8]) -> bool {
    let frames = [repository("data/tests/cases/c01-deeplabcut/run1.csv")];
    let is_read = |log_columns: &[&str]| {
        let options = ImportOptions {
            pressure_logs: vec![as_file(bytes, "pressure.csv")],
            pressure_unit_pa: Some(1e3),
            log_columns: log_columns.iter().map(|name| (*name).to_string()).collect(),
            ..pixel_options()
        };
        import(&frames, &options, &mut |_, _| ()).is_ok()
    };
    [&[][..], &["t_ms", "p_body_kpa", "p_act_kpa"]].map(is_read).contains(&true)
}

fn board(bytes: &[u8]) -> bool {
    let Ok(corners) = read_board(&as_file(bytes, "board.csv")) else { return false };
    let options = ImportOptions {
        scale: Scale::Board(corners, 0.025),
        base: Some(FilePlace::At(vec![300.0, 700.0])),
        ..pixel_options()
    };
    import(&[repository("data/tests/made/askew.csv")], &options, &mut |_, _| ()).is_ok()
}

/// A pillow of few elements, small enough to set up a thousand times a second.
static PILLOW: LazyLock<Option<fem::Problem>> = LazyLock::new(|| {
    let text = shipped_case("pillow")?;
    let mut problem = Case::parse(text, &mut |_| Err(FemError::Mesh("none".into()))).ok()?.problem;
    problem.mesh = fem::mesh::generate::pillow(0.1, 4, 0.0).ok()?;
    problem.settings.threads = 1;
    Some(problem)
});

fn checkpoints() -> Vec<Vec<u8>> {
    let run = PILLOW.as_ref().and_then(|problem| Simulation::new(problem).ok());
    vec![run.map(|run| run.save()).unwrap_or_default()]
}

fn checkpoint(bytes: &[u8]) -> bool {
    PILLOW.as_ref().is_some_and(|problem| Simulation::resume(problem, bytes).is_ok())
}

fn records() -> Vec<Vec<u8>> {
    let outputs = vec![FileHash::of("markers.csv", b"some bytes")];
    let maker = Maker { program: "ibr".into(), date: "2026-01-01".into(), ..Maker::default() };
    vec![Manifest { maker, inputs: outputs.clone(), outputs, cost: None }.text().into_bytes()]
}

fn record(bytes: &[u8]) -> bool {
    let text = String::from_utf8_lossy(bytes);
    let manifest = MANIFEST.read::<Manifest>("manifest.json", &text, "").is_ok();
    SUMMARY.read::<Summary>("summary.json", &text, "").is_ok() || manifest
}
