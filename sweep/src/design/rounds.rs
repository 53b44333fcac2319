//! Designs that finite elements check one after the other: each is searched by the model with what they said of the last one added.

use super::misses::{Miss, worst_m};
use super::search::{Design, design, design_near};
use super::wish::Wish;
use crate::SweepError;
use fem::session::Progress;

/// Result of one finite element run of a design.
#[derive(Debug, Clone, Default, serde::Serialize)]
pub struct Checked {
    /// Where the stations are, the last is the tip \[m\].
    #[serde(skip)]
    pub places_m: Vec<[f64; 2]>,
    /// The parts of the wish that it can read.
    pub misses: Vec<Miss>,
    /// Sentences about what makes the run doubtful.
    pub warnings: Vec<String>,
    /// Pictures of the run by file name.
    #[serde(skip)]
    pub pictures: Vec<(String, Vec<u8>)>,
}

/// One round of a design: the design, and finite elements of it.
#[derive(Debug, Clone)]
pub struct Round {
    /// The design; its misses are the uncorrected model's.
    pub design: Design,
    /// The wish by the model corrected by finite elements, which found the design; `None` for the first.
    pub corrected: Option<Vec<Miss>>,
    /// The finite element result, or why no run was made.
    pub checked: Result<Checked, String>,
}

impl Round {
    fn unchecked(design: Design, corrected: Option<Vec<Miss>>) -> Round {
        Round { design, corrected, checked: Err("it was not asked for".into()) }
    }

    /// A part of the wish by finite elements, if they read it.
    pub fn by_elements(&self, what: &str) -> Option<&Miss> {
        self.checked.as_ref().ok()?.misses.iter().find(|miss| miss.what == what)
    }

    /// Largest miss of a part: by finite elements, and by the model what they do not read \[m\].
    pub fn worst_m(&self) -> f64 {
        worst_m(self.design.misses.iter().map(|miss| self.by_elements(&miss.what).unwrap_or(miss)))
    }

    /// Whether every part is within the tolerance so.
    pub fn reached(&self, wish: &Wish) -> bool {
        self.worst_m() <= wish.tolerance * self.design.file.length_m
    }

    /// What finite elements found less what the model found, number by number; 0 for what they do not read.
    fn difference(&self) -> Vec<f64> {
        let of = |miss: &Miss| -> Vec<f64> {
            let other = self.by_elements(&miss.what).unwrap_or(miss);
            other.found.iter().zip(&miss.found).map(|(elements, model)| elements - model).collect()
        };
        self.design.misses.iter().flat_map(of).collect()
    }
}

/// Why no further design is checked.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "lowercase")]
pub enum StopReason {
    /// The last one has the wish by finite elements.
    Reached,
    /// The allowed number of corrections is spent.
    Spent,
    /// The search came back to a design that was checked.
    Same,
    /// The last one could not be checked.
    Unchecked,
}

/// All rounds so far: ask with [`Rounds::search`], answer with [`Rounds::answer`].
#[derive(Debug, Clone)]
pub struct Rounds {
    /// Rounds after the first, at most.
    pub corrections: usize,
    /// The designs; there is one after the first search.
    pub all: Vec<Round>,
    came_back: bool,
}

impl Rounds {
    /// Starts without a round, with at most so many corrections.
    pub fn new(corrections: usize) -> Rounds {
        Rounds { corrections, all: Vec::new(), came_back: false }
    }

    /// Searches the next design, which shall be checked; `None` at the end. The same answers give the same bits.
    /// Errors as for [`design`].
    pub fn search(&mut self, wish: &Wish, progress: Progress) -> Result<Option<&Design>, SweepError> {
        let round = match self.all.last() {
            None => Some(Round::unchecked(design(wish, progress)?, None)),
            Some(_) if self.end(wish).is_some() => None,
            Some(last) => self.further(last, wish, progress)?,
        };
        self.came_back = round.is_none();
        self.all.extend(round);
        Ok(self.all.last().map(|round| &round.design).filter(|_| !self.came_back))
    }

    /// A design of the corrected model near the last one, with the wish by that model; `None` where it was checked before.
    fn further(&self, last: &Round, wish: &Wish, progress: Progress) -> Result<Option<Round>, SweepError> {
        let correction = last.difference();
        let mut found = design_near(&wish.less(&correction), Some(&last.design.shares), progress)?;
        let length_m = found.file.length_m;
        let mut numbers = correction.into_iter();
        let mut corrected = Vec::new();
        for (miss, asked) in found.misses.iter_mut().zip(&last.design.misses) {
            let of = |found: Vec<f64>| Miss::new(asked.what.clone(), asked.wanted.clone(), found, length_m);
            corrected.push(of(miss.found.iter().zip(&mut numbers).map(|(model, number)| model + number).collect()));
            *miss = of(std::mem::take(&mut miss.found));
        }
        let known = self.all.iter().any(|round| round.design.chosen == found.chosen);
        Ok((!known).then(|| Round::unchecked(found, Some(corrected))))
    }

    /// What finite elements say of the last design.
    pub fn answer(&mut self, checked: Result<Checked, String>) {
        if let Some(last) = self.all.last_mut() {
            last.checked = checked;
        }
    }

    /// Number of the design that misses least by finite elements, from 0; the first where none was checked.
    pub fn best(&self) -> usize {
        let checked = self.all.iter().enumerate().filter(|(_, round)| round.checked.is_ok());
        checked.min_by(|a, b| a.1.worst_m().total_cmp(&b.1.worst_m())).map_or(0, |(number, _)| number)
    }

    /// Whether the best one has the wish: without corrections by the model, with them by finite elements.
    pub fn reached(&self, wish: &Wish) -> bool {
        self.all.get(self.best()).is_some_and(|best| match self.corrections {
            0 => best.design.reached(wish),
            _ => best.reached(wish),
        })
    }

    /// Why the rounds ended; `None` before the end.
    pub fn end(&self, wish: &Wish) -> Option<StopReason> {
        let last = self.all.last()?;
        match &last.checked {
            Err(_) => Some(StopReason::Unchecked),
            Ok(_) if last.reached(wish) => Some(StopReason::Reached),
            Ok(_) if self.all.len() > self.corrections => Some(StopReason::Spent),
            Ok(_) => self.came_back.then_some(StopReason::Same),
        }
    }
}
