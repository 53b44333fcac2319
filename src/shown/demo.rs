//! The demonstration: five panels of text.

use crate::prelude::*;
use crate::tables::PageTable;
use compare::Diagnosis;
use compare::demo::{Demo, Mechanism, ROBOT};
use compare::residuals::{HoldLabel, ResidualCell};
use compare::study::Comparison;
use compare::study::engines::EngineLine;
use compare::where_it_fails::Statement;

const CANDIDATES: usize = 3;
const SHOWN_KPA: [f64; 4] = [5.0, 10.0, 20.0, 30.0];
/// Share by which the models differ where the reduced one is called broken down.
const BREAKDOWN: f64 = 0.15;

/// A panel of the demonstration, for the terminal, the report and the page in a browser.
#[derive(Serialize)]
pub struct DemoPanel {
    title: &'static str,
    lead: String,
    /// Name of its picture, and the caption.
    picture: &'static str,
    caption: &'static str,
    /// The table as text, and for a page.
    #[serde(skip)]
    text: String,
    table: Option<PageTable>,
}

impl DemoPanel {
    fn new(title: &'static str, lead: String, [picture, caption]: [&'static str; 2]) -> DemoPanel {
        DemoPanel { title, lead, picture, caption, text: String::new(), table: None }
    }

    fn with<R>(self, caption: &str, table: impl Fn() -> TextTable<R>) -> DemoPanel {
        DemoPanel { text: table().text(), table: Some(table().page(caption)), ..self }
    }
}

/// Sentences of panel 1: what a vine robot is, and this one's dimensions.
fn robot(demo: &Demo) -> String {
    let Scenario { name, length_m, radius_m, p_body_pa, actuator, markers_m, .. } = &demo.robot;
    format!(
        "Air at {} kPa keeps a thin fabric tube, the body, straight. Pouches along one side become round under up to 30 kPa, so they \
         shorten and bend it. {name}: {:.0} mm long, {:.0} mm thick, {} pouches, {} markers.",
        p_body_pa / 1e3,
        1e3 * length_m,
        2e3 * radius_m,
        actuator.count,
        markers_m.len()
    )
}

fn heights(found: &Comparison) -> TextTable<(&HoldLabel, &ResidualCell, f64)> {
    let (map, data) = (&found.variants[0].evaluation.residual_map, &found.dataset);
    let mean = data.mean_over_runs();
    let measured = |hold: usize| {
        let of = |sample: usize| mean[data.offset(hold, sample, map.tip) + 1];
        1e3 * (0..data.samples_per_hold).map(of).sum::<f64>() / data.samples_per_hold as f64
    };
    let rows = map.holds.iter().enumerate().map(|(h, label)| (label, &map.cells[map.tip][h], measured(h)));
    let is_shown = |label: &HoldLabel| SHOWN_KPA.contains(&label.p_act_kpa);
    TextTable::of(rows.filter(|(label, ..)| is_shown(label)).collect::<Vec<_>>())
        .number("actuator kPa", 0, |(label, ..)| label.p_act_kpa)
        .number("model mm", 1, |(_, cell, measured)| measured + cell.y.mm)
        .number("markers mm", 1, |(.., measured)| *measured)
        .signed("difference mm", 1, |(_, cell, _)| cell.y.mm)
        .number("over its noise", 0, |(_, cell, _)| cell.y.in_noise.map(f64::abs))
}

fn candidates(demo: &Demo) -> TextTable<&Mechanism> {
    TextTable::of(demo.candidates.iter().take(CANDIDATES))
        .words("effect", |m| &m.effect)
        .number("error left, mm", 1, |m| m.error_mm)
        .words("what it is", |m| &m.sentence)
}

/// The model with one more mechanism in every row; last the model with a fitted stiffness in their place.
fn steps(demo: &Demo) -> TextTable<(String, &Mechanism)> {
    let added = |m: &Mechanism| if m.effect.is_empty() { "textbook".into() } else { format!("+ {}", m.effect) };
    let rows = demo.steps.iter().map(|m| (added(m), m));
    let stiffness = ("textbook, B fitted".to_string(), &demo.stiffness);
    TextTable::of(rows.chain([stiffness]).collect::<Vec<_>>())
        .words("model", |(model, _)| model.clone())
        .number("error mm", 1, |(_, m)| m.error_mm)
        .number("left-out data mm", 1, |(_, m)| m.left_out_mm)
}

/// Reduced model and finite elements of a robot at the pressures of the paper.
pub(crate) struct Breaking<'d> {
    pub(crate) robot: &'d str,
    lines: Vec<&'d EngineLine>,
}

impl Breaking<'_> {
    fn of(&self, kpa: f64, source: &str) -> Option<&EngineLine> {
        self.lines.iter().copied().find(|line| line.actuator_kpa == kpa && line.source.starts_with(source))
    }

    /// Marker of the reduced model and of the finite elements, and the latter's spread over seeds \[mm\].
    pub(crate) fn marker_mm(&self, kpa: f64) -> Option<[f64; 3]> {
        let (reduced, fe) = (self.of(kpa, REDUCED)?, self.of(kpa, ELEMENTS)?);
        Some([reduced.marker_mm?, fe.marker_mm?, fe.spread_mm.unwrap_or(0.0)])
    }

    pub(crate) fn is_broken(&self, kpa: f64) -> bool {
        self.marker_mm(kpa).is_some_and(|[reduced, fe, _]| (reduced / fe - 1.0).abs() > BREAKDOWN)
    }

    fn pair(&self, kpa: f64) -> String {
        let mark = if self.is_broken(kpa) { "*" } else { " " };
        self.marker_mm(kpa).map_or("–".into(), |[reduced, fe, sd]| format!("{reduced:.0} / {fe:.0} ± {sd:.1}{mark}"))
    }

    fn accuracies(&self) -> String {
        let at = |kpa: f64| self.of(kpa, PAPER).and_then(|line| line.accuracy).map(|a| 100.0 * a);
        let own = |source| self.of(30.0, source).and_then(|line| line.accuracy).map(|a| 100.0 * a);
        let paper = [10.0, 20.0, 30.0].map(|kpa| number(at(kpa), 0)).join(" ");
        format!("{}, {}; {paper}", number(own(REDUCED), 0), number(own(ELEMENTS), 0))
    }
}

const REDUCED: &str = "reduced, as shipped";
const ELEMENTS: &str = "finite elements";
const PAPER: &str = "the paper's";
const MEASURED: &str = "measurement";

/// Lines of panel 5 by robot, in the order of their first appearance.
pub(crate) fn breaking(demo: &Demo) -> Vec<Breaking<'_>> {
    let mut robots: Vec<Breaking> = Vec::new();
    for line in &demo.lines {
        match robots.iter_mut().find(|robot| robot.robot == line.robot) {
            Some(robot) => robot.lines.push(line),
            None => robots.push(Breaking { robot: &line.robot, lines: vec![line] }),
        }
    }
    robots
}

fn breaking_table(demo: &Demo) -> TextTable<Breaking<'_>> {
    TextTable::of(breaking(demo))
        .words("robot", |b| b.robot)
        .right("10 kPa", |b| b.pair(10.0))
        .right("20 kPa", |b| b.pair(20.0))
        .right("30 kPa", |b| b.pair(30.0))
        .number("measured, 30 kPa", 1, |b| b.of(30.0, MEASURED).and_then(|line| line.marker_mm))
        .right("accuracy %", Breaking::accuracies)
}

/// Panels of the demonstration: title, lead and table of each.
pub fn panels(demo: &Demo) -> [DemoPanel; 5] {
    let [first, last] = [demo.steps.first(), demo.steps.last()].map(|step| step.map_or(f64::NAN, |s| s.error_mm));
    let fails = &demo.compared.variants[0].evaluation.where_it_fails;
    let fails = fails.first().map_or("", |Statement { sentence, .. }| sentence);
    let lacks = format!("{fails} It lacks {} mechanisms of how this robot is made. {ALONE}", demo.candidates.len());
    [
        DemoPanel::new("This is a vine robot", robot(demo), ROBOT_PICTURE),
        DemoPanel::new("A model predicts, the markers disagree", CAMERA.into(), RESIDUALS)
            .with("Outermost marker, mean over the runs", || heights(&demo.compared)),
        DemoPanel::new("Which effects are missing?", lacks, MISSING_MOMENT)
            .with("Mechanisms, each added alone", || candidates(demo)),
        DemoPanel::new("Add them, and the error falls", format!("From {first:.1} to {last:.1} mm. {ADDED}"), WATERFALL)
            .with("Root mean square error over markers and holds", || steps(demo)),
        DemoPanel::new("Where the analytic model breaks", BREAKING.into(), BREAKING_PICTURE)
            .with("Outermost marker, sideways, mm", || breaking_table(demo)),
    ]
}

pub(crate) fn text(demo: &Demo) -> String {
    let rest = format!(
        "Everything else: `ibr list datasets`, `ibr tradeoff`, `ibr breakdown`, and `ibr diagnose {}-textbook {} \
         --keep-bending --out FOLDER`.\n",
        ROBOT[0], ROBOT[1]
    );
    let panel = |(k, panel): (usize, DemoPanel)| {
        format!("{}. {}\n{}{}", k + 1, panel.title, wrapped(&panel.lead, 0), panel.text)
    };
    panels(demo).into_iter().enumerate().map(panel).collect::<String>() + &wrapped(&rest, 0)
}

const CAMERA: &str = "The textbook model, and the same robot simulated in finite elements with every mechanism and with a camera's noise, 5 \
     runs; nothing in panels 2 to 4 was measured. Outermost marker, sideways:";
const ALONE: &str = "The nearest three, each added alone, no number fitted:";
const ADDED: &str = "Each row adds the mechanism that leaves least. Left-out data: twice the body pressure. The last row fits the body's \
     stiffness B instead: it follows these data and fails on the others.";
const BREAKING: &str = "Four published robots: pouches taped onto the body (sPAM), folded (cPAM) or in its wall (ePAM), and a fabric muscle \
     (fPAM). Outermost marker, sideways, in mm: reduced model / finite elements ± scatter of 5 seeds; * over 15 % apart. The \
     paper's accuracy, 1 − ((model − measured)/model)²: both models at 30 kPa; the paper's own at 10, 20, 30 kPa.";

const ROBOT_PICTURE: [&str; 2] =
    ["robot", "The ePAM at 30 kPa in finite elements; colours are von Mises stress in MPa."];
const RESIDUALS: [&str; 2] = ["residuals", "Model minus markers, over their noise, for every marker and hold."];
const MISSING_MOMENT: [&str; 2] = [
    "missing_moment",
    "Each point is a hold: the moment that would have to join the model's own to hold the robot in the measured bend, with the ellipse \
     of one standard deviation. On the line at 0 nothing is missing; below it something holds the robot back. Curves: single effects of the catalogue, \
     fitted without knowledge of how the robot is made.",
];
const WATERFALL: [&str; 2] = ["waterfall", "Root mean square error over all markers and holds."];
const BREAKING_PICTURE: [&str; 2] = [
    "breaking",
    "Open symbols: more than 15 % apart, because the pouches are not yet round or the body has buckled. Error bars: spread of the seeds.",
];

/// `ibr.demo`: `ibr demo`
#[derive(Serialize)]
pub(crate) struct DemoAnswer<'a> {
    /// The textbook model compared with the data
    pub where_it_fails: &'a [Statement],
    /// Mechanisms of the shipped robot, each alone in the textbook model, the nearest first
    pub candidates: &'a [Mechanism],
    /// What a diagnosis reports of the textbook model, its stiffness kept
    pub diagnosis: &'a Diagnosis,
    /// The textbook model, and one more mechanism in every step
    pub steps: &'a [Mechanism],
    /// The textbook model with a stiffness fitted to the data in place of mechanisms
    pub stiffness: &'a Mechanism,
    /// Four robots at the pressures of the paper, by every source
    pub lines: &'a [EngineLine],
}

impl<'a> DemoAnswer<'a> {
    /// Borrows the parts of a demonstration that its JSON has.
    pub(crate) fn of(demo: &'a Demo) -> DemoAnswer<'a> {
        DemoAnswer {
            where_it_fails: &demo.compared.variants[0].evaluation.where_it_fails,
            candidates: &demo.candidates,
            diagnosis: &demo.diagnosis,
            steps: &demo.steps,
            stiffness: &demo.stiffness,
            lines: &demo.lines,
        }
    }
}
