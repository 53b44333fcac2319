//! Where the model fails, in plain language, each sentence with its evidence.
//!
//! A cell of the residual map counts as a failure if it is significant after correction for all contrasts **and**
//! larger than the tolerance; noise is then called a failure in about a fraction α of all datasets. The sentences say
//! which pressures, which markers, loading or unloading, x or y, or drift during holds; they do not name physics.

use crate::beside_mean::BesideMean;
use crate::fit::numbers::largest;
use crate::residuals::{Deviation, ResidualCell, ResidualMap};
use crate::wording::{evidence, list, markers, p_value, pressures, times_the_noise};
use data::Phase;
use serde::Serialize;
use std::collections::BTreeSet;

/// Where or when the difference of a statement is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Finding {
    /// One run: the noise is unknown, what follows is description only.
    NoiseUnknown,
    /// Model and measurement differ by no more than noise.
    Agrees,
    /// Differences beyond noise, all below the tolerance.
    WithinTolerance,
    /// Bending (y) wrong in holds reached by loading.
    Loading,
    /// Bending (y) wrong in holds reached by unloading.
    Unloading,
    /// The gap between loading and unloading at one pressure is wrong.
    Loop,
    /// Positions along the body (x) wrong.
    Lengthwise,
    /// Positions across the body (y or z) wrong, of markers with z.
    Across,
    /// Movement of the markers during holds is wrong.
    Drift,
    /// More than noise as a whole, but nowhere in particular.
    Diffuse,
}

/// One sentence on where a model fails, with its evidence.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Statement {
    /// Where or when the difference is.
    pub finding: Finding,
    /// The finding in plain words, as one sentence.
    pub sentence: String,
    /// Indices of the holds that the statement is about.
    pub holds: Vec<usize>,
    /// Indices of the markers that the statement is about.
    pub markers: Vec<usize>,
    /// The difference that the sentence quotes; `None` if it quotes none.
    pub largest: Option<Deviation>,
}

impl Statement {
    fn of(finding: Finding, sentence: String) -> Statement {
        Statement { finding, sentence, holds: Vec::new(), markers: Vec::new(), largest: None }
    }
}

/// Describe where a model fails; never empty. `chi2_p` is the p-value of the overall χ², `alpha` the significance level over all
/// statements together; differences up to the tolerance are not called failures.
pub fn where_it_fails(
    c: &BesideMean,
    map: &ResidualMap,
    chi2_p: Option<f64>,
    alpha: f64,
    tolerance_m: f64,
) -> Vec<Statement> {
    let judge = Judge::new(c, map, alpha, tolerance_m);
    let mut found = Vec::new();
    let signs = [1.0, -1.0];
    for (axis, phase) in [(1, Finding::Loading), (2, Finding::Unloading)] {
        let one = |sign| if c.is_spatial() { judge.along(axis, sign) } else { judge.bending(phase, sign) };
        found.extend(signs.into_iter().filter_map(one));
    }
    let told: Vec<usize> = found.iter().flat_map(|s: &Statement| s.holds.clone()).collect();
    found.extend(judge.loops(&told));
    found.extend(signs.iter().filter_map(|sign| judge.along(0, *sign)));
    found.extend(judge.drifts());
    if found.is_empty() {
        found.push(judge.nothing_stands_out(chi2_p));
    }
    if !c.noise.is_known() {
        found.insert(0, unknown_noise());
    }
    found
}

struct Judge<'a> {
    c: &'a BesideMean<'a>,
    map: &'a ResidualMap,
    alpha: f64,
    least_mm: f64,
    bend: f64,
}

impl<'a> Judge<'a> {
    fn new(c: &'a BesideMean<'a>, map: &'a ResidualMap, alpha: f64, tolerance_m: f64) -> Judge<'a> {
        let largest = map.cells.iter().flatten().map(|cell| cell.norm_mm).fold(0.0, f64::max);
        // Without noise only the coarse pattern is described: what reaches a quarter of the largest difference.
        let pattern_mm = if c.noise.is_known() { 0.0 } else { 0.25 * largest };
        let least_mm = (1e3 * tolerance_m).max(pattern_mm);
        Judge { c, map, alpha, least_mm, bend: c.bend_sign() }
    }

    fn fails(&self, d: &Deviation) -> bool {
        d.mm.abs() > self.least_mm && d.is_significant(self.alpha).unwrap_or(true)
    }

    fn cell(&self, (hold, marker): (usize, usize)) -> &ResidualCell {
        &self.map.cells[marker][hold]
    }

    fn is_unloading(&self, hold: usize) -> bool {
        self.c.dataset.holds[hold].phase == Phase::Unload
    }

    /// Cells of loading or unloading holds whose deviation fails with the given sign.
    fn failing(
        &self,
        unloading: Option<bool>,
        signed: impl Fn(&ResidualCell) -> Deviation,
        sign: f64,
    ) -> Vec<(usize, usize)> {
        let holds = (0..self.c.layout.holds).filter(|&h| unloading.is_none_or(|u| u == self.is_unloading(h)));
        let cells = holds.flat_map(|h| (0..self.c.layout.markers).map(move |m| (h, m)));
        let fails = |d: Deviation| self.fails(&d) && d.mm * sign > 0.0;
        cells.filter(|at| fails(signed(self.cell(*at)))).collect()
    }

    /// Too far (`sign` = +1) or too little bending in one phase.
    fn bending(&self, finding: Finding, sign: f64) -> Option<Statement> {
        let unloading = finding == Finding::Unloading;
        let way = if sign > 0.0 { "too far" } else { "too little" };
        let cells = self.failing(Some(unloading), |c| c.y, sign * self.bend);
        self.on_cells(
            finding,
            &cells,
            |c| c.y,
            |at, holds, markers| {
                let pressures = pressures(self.map, holds);
                let start = match unloading {
                    true => format!("After unloading, at {pressures}, the model is bent {way}"),
                    false => format!("The model bends {way} at {pressures}"),
                };
                [start, self.growth(at.0, markers).to_string() + &self.contrast(holds, unloading)]
            },
        )
    }

    /// A statement on failing cells, from its words before and after the evidence: of the worst cell, of all holds and markers.
    fn on_cells(
        &self,
        finding: Finding,
        cells: &[(usize, usize)],
        of: impl Fn(&ResidualCell) -> Deviation,
        words: impl Fn((usize, usize), &[usize], &[usize]) -> [String; 2],
    ) -> Option<Statement> {
        let worst = self.worst(cells, &of)?;
        let holds: Vec<usize> = cells.iter().map(|at| at.0).collect::<BTreeSet<_>>().into_iter().collect();
        let failing: Vec<usize> = cells.iter().map(|at| at.1).collect::<BTreeSet<_>>().into_iter().collect();
        let largest = of(self.cell(worst));
        let ([start, end], evidence) = (words(worst, &holds, &failing), evidence(self.map, worst, &holds, &largest));
        let sentence = format!("{start} ({evidence}){}{end}.", markers(self.map, &failing));
        Some(Statement { finding, sentence, holds, markers: failing, largest: Some(largest) })
    }

    /// The tip at its worst hold if it fails at all, else the worst cell.
    fn worst(&self, cells: &[(usize, usize)], of: impl Fn(&ResidualCell) -> Deviation) -> Option<(usize, usize)> {
        let size = |at: &(usize, usize)| of(self.cell(*at)).mm.abs();
        let at_tip = cells.iter().copied().filter(|at| at.1 == self.c.tip);
        largest(at_tip, size).or_else(|| largest(cells.iter().copied(), size))
    }

    fn growth(&self, hold: usize, markers: &[usize]) -> &'static str {
        let sizes: Vec<f64> = markers.iter().map(|&m| self.cell((hold, m)).y.mm.abs()).collect();
        let steps = || sizes.windows(2).map(|w| w[1] - w[0]);
        match sizes.len() {
            0..=2 => "",
            _ if steps().all(|d| d > 0.0) => " and growing towards the tip",
            _ if steps().all(|d| d < 0.0) => " and shrinking towards the tip",
            _ => "",
        }
    }

    /// Where the prediction is right, to bound the failure: other loading pressures and the other phase.
    fn contrast(&self, holds: &[usize], unloading: bool) -> String {
        let right = |h: &usize| !holds.contains(h) && self.bending_is_right(*h);
        let (back, there): (Vec<usize>, Vec<usize>) = (0..self.c.layout.holds).partition(|&h| self.is_unloading(h));
        let loading: Vec<usize> = there.into_iter().filter(right).collect();
        let mut places = Vec::new();
        if !loading.is_empty() {
            let while_loading = if unloading { " while loading" } else { "" };
            places.push(format!("at {}{while_loading}", pressures(self.map, &loading)));
        }
        if !unloading && !back.is_empty() && back.iter().all(right) {
            places.push("after unloading".to_string());
        }
        let degree = if self.c.noise.is_known() { "right to within noise" } else { "nearer" };
        if places.is_empty() { String::new() } else { format!("; {} it is {degree}", list(&places)) }
    }

    /// No y of this hold is significant (with unknown noise: none reaches the pattern level).
    fn bending_is_right(&self, hold: usize) -> bool {
        (0..self.c.layout.markers).all(|m| {
            let y = self.cell((hold, m)).y;
            !y.is_significant(self.alpha).unwrap_or(y.mm.abs() > self.least_mm)
        })
    }

    fn loops(&self, told: &[usize]) -> Option<Statement> {
        let news = |l: &&crate::residuals::LoopGap| !told.contains(&l.unload_hold) || told.contains(&l.load_hold);
        let gaps: Vec<_> = self.map.loops.iter().filter(|l| self.fails(&l.deviation)).filter(news).collect();
        let worst = largest(&gaps, |gap| gap.deviation.mm.abs())?;
        let d = worst.deviation;
        let more = if d.mm < 0.0 { "more" } else { "less" };
        let sentence = format!(
            "At {} the robot is bent {:.1} mm {more} after unloading than while loading, compared with the model \
             (weighted over the markers{}).",
            pressures(self.map, &[worst.unload_hold]),
            d.mm.abs(),
            times_the_noise(&d),
        );
        let holds = gaps.iter().flat_map(|l| [l.load_hold, l.unload_hold]).collect();
        Some(Statement { holds, largest: Some(d), ..Statement::of(Finding::Loop, sentence) })
    }

    /// One coordinate too large (`sign` = +1) or too small: x in the plane, all of them in space.
    fn along(&self, axis: usize, sign: f64) -> Option<Statement> {
        let of = |cell: &ResidualCell| cell.axes()[axis];
        let way = if sign > 0.0 { "too large" } else { "too small" };
        let (finding, place) = match axis {
            0 => (Finding::Lengthwise, "Along the body, x"),
            1 => (Finding::Across, "Across the body, y"),
            _ => (Finding::Across, "Across the body, z"),
        };
        self.on_cells(finding, &self.failing(None, of, sign), of, |at, holds, _| {
            let y = self.cell(at).y;
            let with_y = match () {
                () if self.c.is_spatial() => "",
                () if y.mm.abs() > of(self.cell(at)).mm.abs() && self.fails(&y) => "; the error in y is larger there",
                () if (0..self.c.layout.holds).all(|h| self.bending_is_right(h)) => "; y is right to within noise",
                () => "",
            };
            [format!("{place} of the model is {way} at {}", pressures(self.map, holds)), with_y.into()]
        })
    }

    fn drifts(&self) -> Option<Statement> {
        let drifts: Vec<_> = self.map.drifts.iter().filter(|d| self.fails(&d.deviation)).collect();
        let worst = largest(&drifts, |drift| drift.deviation.mm.abs())?;
        let holds: Vec<usize> = drifts.iter().map(|d| d.hold).collect();
        let way = if worst.deviation.mm < 0.0 { "in" } else { "against" };
        let sentence = format!(
            "During the hold at {} the robot moves {:.1} mm further {way} the bending direction than the model (late \
             minus early samples, weighted over the markers{}).",
            pressures(self.map, &[worst.hold]),
            worst.deviation.mm.abs(),
            times_the_noise(&worst.deviation),
        );
        Some(Statement { holds, largest: Some(worst.deviation), ..Statement::of(Finding::Drift, sentence) })
    }

    fn nothing_stands_out(&self, chi2_p: Option<f64>) -> Statement {
        let entries = || self.map.cells.iter().flatten().flat_map(ResidualCell::axes);
        let most = largest(entries(), |d| d.in_noise.unwrap_or(d.mm).abs());
        let size = most.map_or(String::new(), |d| format!("{:.2} mm{}", d.mm.abs(), times_the_noise(&d)));
        let least = self.least_mm;
        let (finding, sentence) = if !self.c.noise.is_known() {
            (Finding::WithinTolerance, format!("No difference above {least:.2} mm was found (largest {size})."))
        } else if entries().any(|d| d.is_significant(self.alpha) == Some(true)) {
            let below = format!("Every difference is below the tolerance of {least:.2} mm");
            (Finding::WithinTolerance, format!("{below}, though not all are noise (most significant {size})."))
        } else if let Some(p) = chi2_p.filter(|p| *p < self.alpha) {
            let more =
                format!("As a whole the misfit is more than noise ({}), but no single marker and pressure", p_value(p));
            (Finding::Diffuse, format!("{more} is significant on its own (most significant difference {size})."))
        } else if self.c.noise.gives_p_values() {
            let agrees = "The model agrees with the measurements to within noise at every pressure and marker";
            (Finding::Agrees, format!("{agrees} (most significant difference {size})."))
        } else {
            let nothing = format!("Nothing rises above the noise (largest {size}); no significance can be given.");
            (Finding::Agrees, nothing)
        };
        Statement { largest: most, ..Statement::of(finding, sentence) }
    }
}

fn unknown_noise() -> Statement {
    let sentence = "The noise is unknown (one run only), so no significance can be given: what follows describes \
                    differences, some of which may be noise. Repeat the protocol at least 3 times.";
    Statement::of(Finding::NoiseUnknown, sentence.into())
}
