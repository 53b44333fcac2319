use super::*;
use data::published;

fn run(kind: &str, mesh_mm: [f64; 2], kpa: f64, marker_mm: f64) -> PaperRun {
    let filled = EngineState { body_cm3: 1800.0, ..EngineState::default() };
    let end = EngineState {
        actuator_kpa: kpa,
        marker_mm,
        tip_mm: 1.1 * marker_mm,
        body_cm3: 1700.0,
        von_mises_mpa: 30.0,
        moved_mm: vec![[0.0, 0.2 * marker_mm], [0.0, marker_mm]],
        ..EngineState::default()
    };
    let run = EngineRun {
        actuator: kind.into(),
        mesh_mm,
        cpu_s: 10.0,
        states: vec![filled, end],
        stations_mm: vec![330.0],
        ..EngineRun::default()
    };
    PaperRun {
        run,
        encastre: false,
        added_mass_share: 0.1,
        kinetic: Kinetic { outputs: 10, below_10_pct_of_internal: 10, below_1_pct_of_total: 9, at_end: 2e-3 },
        peak: Peak { part: "top".into(), at_mm: 60.0, on_seam: true },
    }
}

fn row(id: &str, runs: &[PaperRun]) -> FactRow {
    facts(&published().unwrap(), runs).into_iter().find(|row| row.id == id).unwrap()
}

#[test]
fn accuracies_imply_two_branches_where_the_measurement_is_printed() {
    let paper = published().unwrap();
    for (kind, low, high) in [("spam", 54.5, 88.7), ("cpam", 137.2, 191.1), ("epam", 97.4, 154.2), ("fpam", 56.9, 82.1)]
    {
        let implied = Implied::of(paper.actuator(kind).unwrap(), 30e3).unwrap();
        let found = implied.branches_mm.unwrap();
        assert!((found[0] - low).abs() < 0.05 && (found[1] - high).abs() < 0.05, "{kind} {found:?}");
        // Back through the paper's own formula, at every marker alike.
        let measured = paper.actuator(kind).unwrap().d_max_m * 1e3;
        for branch in found {
            let a = crate::accuracy::paper_accuracy(&[branch], &[measured]).unwrap();
            assert!((a - (1.0 - implied.error * implied.error)).abs() < 1e-12);
        }
        let at_10 = Implied::of(paper.actuator(kind).unwrap(), 10e3).unwrap();
        assert!(at_10.branches_mm.is_none() && at_10.at_most_mm > measured);
    }
    assert!(Implied::of(paper.actuator("epam").unwrap(), 13e3).is_none(), "no accuracy is printed there");
}

#[test]
fn a_height_is_told_by_its_nearer_branch_or_by_what_it_would_mean() {
    let paper = published().unwrap();
    let epam = paper.actuator("epam").unwrap();
    let verdict = |kpa: f64, mm: f64| against(epam, &run("epam", [4.0, 4.0], kpa, mm)).unwrap().verdict;
    assert_eq!(verdict(30.0, 95.1), "holds: -2.4 % from the low branch");
    assert_eq!(verdict(30.0, 125.0), "misses: -19.0 % from the high branch");
    // e = √0.193 at 10 kPa: 35 mm are 19.6 or 50.4 measured; no measured height is above the largest.
    assert_eq!(verdict(10.0, 35.0), "no y_EXP printed; would mean 20 or 50 measured");
    assert_eq!(verdict(10.0, 215.0), "misses: above the most that is possible by 2.0 mm");
}

#[test]
fn every_fact_has_one_check_and_every_check_a_fact() {
    let paper = published().unwrap();
    let checks: Vec<&str> = checks::CHECKS.iter().map(|c| c.0).collect();
    for fact in &paper.facts {
        assert_eq!(checks.iter().filter(|id| **id == fact.id).count(), 1, "{}", fact.id);
    }
    assert_eq!(checks.len(), paper.facts.len());
}

#[test]
fn patterns_and_fabrics_of_the_robots_agree_with_the_text() {
    for (id, words) in
        [("area", "round, over"), ("threshold", "yarns turn by"), ("layers", "3 layers of the sheet at its edge, 4")]
    {
        let row = row(id, &[]);
        assert!(row.verdict == FactVerdict::Holds && row.found.contains(words), "{row:?}");
    }
    assert!(row("area", &[]).found.contains("2.60") && row("area", &[]).found.contains("1.80"));
}

#[test]
fn what_needs_runs_says_so_without_them() {
    let rows = facts(&published().unwrap(), &[]);
    let needy: Vec<&FactRow> = rows.iter().filter(|row| row.verdict != FactVerdict::Holds).collect();
    assert_eq!((needy.len(), rows.len()), (15, 18));
    assert!(needy.iter().all(|row| row.verdict.words().starts_with("cannot be checked: no run of")), "{needy:?}");
}

#[test]
fn ratios_and_meshes_are_judged_by_the_heights_of_runs() {
    let [coarse, fine] = MESHES_MM;
    let mut runs = vec![run("cpam", coarse, 30.0, 134.0), run("epam", coarse, 30.0, 100.0)];
    assert_eq!(
        (row("ratio-epam", &runs).found.as_str(), row("ratio-epam", &runs).verdict),
        ("1.34 (4 mm)", FactVerdict::Holds)
    );
    runs[0] = run("cpam", coarse, 30.0, 160.0);
    assert_eq!(row("ratio-epam", &runs).verdict.words(), "misses: +19 %");
    runs.push(run("cpam", fine, 30.0, 150.0));
    assert_eq!(row("mesh-deeper", &runs).verdict, FactVerdict::Holds);
    runs[2] = run("cpam", fine, 30.0, 170.0);
    assert_eq!(row("mesh-deeper", &runs).verdict.words(), "misses: the cPAM bends more");
}

#[test]
fn the_finest_mesh_that_has_all_runs_decides() {
    let [coarse, fine] = MESHES_MM;
    let mut runs =
        vec![run("cpam", coarse, 10.0, 100.0), run("cpam", coarse, 13.0, 127.5), run("cpam", fine, 13.0, 119.0)];
    assert_eq!(row("buckling", &runs).verdict, FactVerdict::Holds);
    runs.push(run("cpam", fine, 10.0, 81.0));
    let found = row("buckling", &runs);
    assert!(found.found.contains("4 mm: 100.0, 127.5 mm, +27.5 %") && found.found.contains("4/1 mm"), "{found:?}");
    assert!(found.verdict.words().contains("+46.9 %, read as +25 to +35 %"), "{found:?}");
}

#[test]
fn supports_stresses_and_kinetic_energies_are_told_from_the_runs() {
    let mesh = MESHES_MM[0];
    let mut runs = vec![run("epam", mesh, 30.0, 90.0), PaperRun { encastre: true, ..run("epam", mesh, 30.0, 88.0) }];
    // A row of 4 mm off 330 mm is 2.4 % of the height.
    assert!(row("base", &runs).found.contains("ePAM -2.2 % (+0.2) at 30 kPa"), "{:?}", row("base", &runs));
    assert_eq!(row("base", &runs).verdict, FactVerdict::Holds);
    runs[1] = PaperRun { encastre: true, ..run("epam", mesh, 30.0, 84.6) };
    assert_eq!(row("base", &runs).verdict.words(), "misses: up to 3.7 % beyond that row");
    assert_eq!(row("kinetic-valid", &runs).verdict, FactVerdict::Holds);
    assert_eq!(row("kinetic-kept", &runs).verdict.words(), "misses: 1 of 1 runs exceed it at some output");
    assert_eq!(row("stress-seams", &runs).verdict, FactVerdict::Holds);
    runs[0].peak.on_seam = false;
    assert_eq!(row("stress-seams", &runs).verdict.words(), "misses: not in the ePAM");
    runs[0].run.states[1].von_mises_mpa = 19.0;
    assert_eq!(row("stress-cap", &runs).verdict.words(), "misses: no peak reaches the cap");
}

#[test]
fn stored_runs_are_read_back_and_kept_once_in_one_order() {
    let [coarse, fine] = MESHES_MM;
    let second = |mut r: PaperRun| {
        r.run.seed = 2;
        r
    };
    let runs =
        vec![run("fpam", fine, 30.0, 1.0), second(run("fpam", coarse, 30.0, 2.0)), run("fpam", coarse, 30.0, 3.0)];
    let kept = ordered(runs);
    let heights: Vec<f64> = kept.iter().map(|r| r.end().unwrap().marker_mm).collect();
    assert_eq!(heights, [3.0, 1.0], "coarse first, seed 1 of two");
    assert_eq!(read_runs("runs.json", &runs_json(&kept)).unwrap(), kept);
    let cut = runs_json(&kept).replace("\"encastre\":false,", "");
    assert!(read_runs("runs.json", &cut).unwrap_err().to_string().contains("encastre"));
    // What comes with the program is in that order.
    let text = include_str!("../../../assets/paper-runs.json");
    assert_eq!(runs_json(&ordered(stored().unwrap())), text);
}
