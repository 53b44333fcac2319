//! How often a diagnosis is right, on data with hidden effects: the table of figures it must reach, row by row.
//!
//! Every set is drawn from (seed, part of the table, number), so that the same call gives the same numbers for any number
//! of threads. Sizes, laws and seeds are not tuned: the table shows every missed goal, with the name that was
//! given instead and the separation λ of truth and name.

mod cases;
mod faults;
mod follow;
mod made;
mod outcome;
mod row;
mod slipped;
mod surplus;
mod table;
#[cfg(test)]
mod tests;

pub use faults::FaultSet;
pub use made::OneOff;
pub use outcome::{After, Diagnoser, Lot, Named, PlannedSet, SetOutcome};
pub use row::{Goal, Rate};
pub use slipped::SlippedSet;
pub use surplus::SurplusSet;
pub use table::Confusion;

use super::effects::Laws;
use super::score::{Claim, ClaimScore};
use super::truth::{Hiding, Truth};
use compare::error::CompareError;
use serde::{Deserialize, Serialize};

/// Size of a bench, its seed and the laws of its effects.
#[derive(Debug, Clone, Copy)]
pub struct DiscoveryOptions {
    /// Seed from which every set is drawn.
    pub seed: u64,
    /// Sets with nothing hidden, and with one effect; half as many of the other parts.
    pub sets: usize,
    /// By which laws the hidden effects act.
    pub laws: Laws,
}

/// One set as it was made and answered.
#[derive(Debug, Clone, Serialize)]
pub struct SetSeen {
    /// Part of the table that the set belongs to.
    pub part: String,
    /// What was hidden, in which robot, with which noise.
    pub truth: Truth,
    /// What was answered; `None` if the set failed.
    pub answer: Option<Claim>,
    /// Comparison of the answer with the truth; `None` if the set failed.
    pub score: Option<ClaimScore>,
    /// Answer and score after the recommended next experiment, of ambiguous sets.
    pub after: Option<After>,
}

/// Results of the whole bench: the table, its background and every set.
#[derive(Debug, Clone, Serialize)]
pub struct Discovery {
    /// Seed from which every set was drawn.
    pub seed: u64,
    /// By which laws the hidden effects act.
    pub laws: Laws,
    /// Figures with their targets, in the order of the table.
    pub rows: Vec<Rate>,
    /// How often each hidden effect got each name, of sets with one effect.
    pub confusion: Vec<Confusion>,
    /// Data made by finite elements, mechanism by mechanism.
    pub made: Vec<OneOff>,
    /// Data with a column of pressures written wrongly.
    pub slipped: Vec<SlippedSet>,
    /// Scenarios with an effect that the robot does not have.
    pub surplus: Vec<SurplusSet>,
    /// Instruments that read wrongly and places that bend otherwise.
    pub faults: Vec<FaultSet>,
    /// Every planned set, as it was made and answered.
    pub seen: Vec<SetSeen>,
    /// Sets that could not be made or diagnosed, with the reason.
    pub failed: Vec<String>,
}

/// Sets of every kind from which on finite elements and slips are asked too: they take minutes.
const WHOLE: usize = 50;

/// A bench that is planned: pieces of work that do not depend on each other, and have one answer on any machine.
#[derive(Debug, Clone)]
pub struct PlannedBench {
    /// Size, seed and laws of the bench.
    pub options: DiscoveryOptions,
    pieces: Vec<BenchPiece>,
}

#[derive(Debug, Clone)]
enum BenchPiece {
    /// A set that was drawn for the plan.
    Set(PlannedSet),
    /// Finite element data of a robot.
    Made(&'static str),
    /// A set with a column of pressures written wrongly, of (seed, number).
    Slipped(u64, usize),
    /// A scenario with an effect too many, of (seed, number).
    Surplus(u64, usize),
    /// An instrument or a place, of (seed, number).
    Fault(u64, usize),
}

/// What a piece gave, or why it failed.
pub type PieceAnswer = Result<PieceResult, String>;

/// What a piece of work gave.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub enum PieceResult {
    /// Of a set that was drawn for the plan.
    Set(Box<Named>),
    /// Of finite element data, mechanism by mechanism.
    Made(Vec<OneOff>),
    /// Of a column of pressures written wrongly.
    Slipped(Box<SlippedSet>),
    /// Of a scenario with an effect too many.
    Surplus(Box<SurplusSet>),
    /// Of an instrument or a place.
    Fault(Box<FaultSet>),
}

impl PlannedBench {
    /// Draws all sets.
    ///
    /// # Errors
    /// A shipped scenario is damaged.
    pub fn plan(options: DiscoveryOptions) -> Result<PlannedBench, CompareError> {
        let mut pieces: Vec<BenchPiece> = plan(&options)?.into_iter().map(BenchPiece::Set).collect();
        pieces.extend((0..surplus::count(options.sets)).map(|index| BenchPiece::Surplus(options.seed, index)));
        pieces.extend((0..faults::count(options.sets)).map(|index| BenchPiece::Fault(options.seed, index)));
        if options.sets >= WHOLE {
            pieces.extend(made::MADE.map(BenchPiece::Made));
            pieces.extend((0..slipped::count(options.sets)).map(|index| BenchPiece::Slipped(options.seed, index)));
        }
        Ok(PlannedBench { options, pieces })
    }

    /// What the answer to each piece depends on, in addition to the program.
    pub fn keys(&self) -> Vec<String> {
        self.pieces.iter().map(|piece| format!("{piece:?}")).collect()
    }

    /// Makes the data of a piece and diagnoses them.
    pub fn answer(&self, piece: usize, diagnose: Diagnoser) -> PieceAnswer {
        let (found, what) = match &self.pieces[piece] {
            BenchPiece::Set(set) => return cases::named(set, diagnose).map(|named| PieceResult::Set(Box::new(named))),
            BenchPiece::Slipped(seed, index) => {
                return slipped::slipped(*seed, *index, diagnose).map(|set| PieceResult::Slipped(Box::new(set)));
            }
            BenchPiece::Made(robot) => (made::made(robot, diagnose).map(PieceResult::Made), format!("fem-{robot}")),
            BenchPiece::Surplus(seed, index) => {
                let found = surplus::surplus(*seed, *index, diagnose);
                (found.map(|set| PieceResult::Surplus(Box::new(set))), "an effect too many".into())
            }
            BenchPiece::Fault(seed, index) => {
                let found = faults::fault(*seed, *index, diagnose);
                (found.map(|set| PieceResult::Fault(Box::new(set))), "a fault".into())
            }
        };
        found.map_err(|error| format!("{what}: {error}"))
    }

    /// The table, of the answers to all pieces in order.
    pub fn table(self, answers: Vec<PieceAnswer>) -> Discovery {
        let (mut outcomes, mut made, mut failed) = (Vec::new(), Vec::new(), Vec::new());
        let (mut slipped, mut surplus, mut faults) = (Vec::new(), Vec::new(), Vec::new());
        for (piece, answer) in self.pieces.into_iter().zip(answers) {
            let (given, failure) = answer.map_or_else(|why| (None, Some(why)), |given| (Some(given), None));
            failed.extend(failure);
            match (piece, given) {
                (BenchPiece::Set(PlannedSet { part, truth }), None) => {
                    outcomes.push(SetOutcome { part, truth, named: None });
                }
                (BenchPiece::Set(PlannedSet { part, truth }), Some(PieceResult::Set(named))) => {
                    outcomes.push(SetOutcome { part, truth, named: Some(*named) });
                }
                (BenchPiece::Made(_), Some(PieceResult::Made(found))) => made.extend(found),
                (BenchPiece::Surplus(..), Some(PieceResult::Surplus(found))) => surplus.push(*found),
                (BenchPiece::Slipped(..), Some(PieceResult::Slipped(found))) => slipped.push(*found),
                (BenchPiece::Fault(..), Some(PieceResult::Fault(found))) => faults.push(*found),
                (_, None) => {}
                (piece, Some(_)) => failed.push(format!("{piece:?}: an answer to something else")),
            }
        }
        Discovery {
            seed: self.options.seed,
            laws: self.options.laws,
            rows: [
                table::rows(&outcomes),
                surplus::rows(&surplus),
                faults::rows(&faults),
                table::covered(
                    &outcomes,
                    faults.iter().filter_map(FaultSet::holds).chain(surplus.iter().filter_map(SurplusSet::holds)),
                ),
                slipped::rows(&slipped),
                made::rows(&made),
            ]
            .concat(),
            confusion: table::confusion(&outcomes),
            slipped,
            surplus,
            faults,
            made,
            seen: outcomes.iter().map(seen).collect(),
            failed,
        }
    }
}

fn seen(outcome: &SetOutcome) -> SetSeen {
    let named = outcome.named.as_ref();
    SetSeen {
        part: format!("{:?}", outcome.part),
        truth: outcome.truth.clone(),
        answer: named.map(|named| named.answer.clone()),
        score: named.map(|named| named.score.clone()),
        after: named.and_then(|named| named.after.clone()),
    }
}

fn plan(options: &DiscoveryOptions) -> Result<Vec<PlannedSet>, CompareError> {
    let half = options.sets.div_ceil(2);
    let parts = [
        (Lot::Hidden(Hiding::Nothing), options.sets),
        (Lot::Hidden(Hiding::One), options.sets),
        (Lot::Hidden(Hiding::Two), half),
        (Lot::Hidden(Hiding::Outside), half),
        (Lot::Interval, half),
        (Lot::HeavyTails, half),
        (Lot::Measured(Hiding::Nothing), options.sets),
        (Lot::Measured(Hiding::One), options.sets),
        (Lot::LostMarkers(Hiding::Nothing), half),
        (Lot::LostMarkers(Hiding::One), half),
        (Lot::Clamp, half),
        (Lot::Softening, half),
        (Lot::White(Hiding::Nothing), half),
        (Lot::White(Hiding::One), half),
    ];
    let mut plan = Vec::new();
    for (number, (part, sets)) in parts.into_iter().enumerate() {
        let same = |other: &(Lot, usize)| matches!(part, Lot::Measured(kind) | Lot::LostMarkers(kind) | Lot::White(kind) if other.0 == Lot::Hidden(kind));
        let number = parts.iter().position(same).unwrap_or(number);
        for index in 0..sets {
            let stream = ((number as u64) << 32) + index as u64;
            let truth = Truth { laws: options.laws, ..cases::draw(part, options.seed, stream, index)? };
            plan.push(PlannedSet { part, truth });
        }
    }
    Ok(plan)
}
