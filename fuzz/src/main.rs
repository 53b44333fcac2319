//! `ibr-fuzz READER|all [--cases N] [--seed S] [--from CASE] [--keep FOLDER]`: broken inputs for the readers of `ibr`.
//!
//! A reader may refuse what it is given, and may read it. It may not panic, not take longer than `LONGEST` and not ask for more
//! than `MOST_MEMORY` bytes. Inputs that make it do so are saved. Ends with 1 if there are any.

mod mutate;
mod readers;
mod watch;

use readers::{READERS, Reader};
use stats_alloc::{INSTRUMENTED_SYSTEM, StatsAlloc};
use std::alloc::System;
use std::path::PathBuf;
use std::process::ExitCode;
use watch::{WatchTotals, WatchedReader};

#[global_allocator]
static COUNTING: &StatsAlloc<System> = &INSTRUMENTED_SYSTEM;

struct FuzzRequest {
    readers: Vec<&'static Reader>,
    cases: u64,
    seed: u64,
    from: u64,
    keep: PathBuf,
}

fn main() -> ExitCode {
    let wish = match wish(std::env::args().skip(1).collect()) {
        Ok(wish) => wish,
        Err(message) => {
            eprintln!("{message}");
            return ExitCode::from(2);
        }
    };
    let faults: usize = wish.readers.iter().map(|reader| run(reader, &wish)).sum();
    ExitCode::from(u8::from(faults > 0))
}

fn wish(words: Vec<String>) -> Result<FuzzRequest, String> {
    let names: Vec<&str> = READERS.iter().map(|reader| reader.name).collect();
    let help = format!(
        "usage: ibr-fuzz READER [--cases N] [--seed S] [--from CASE] [--keep FOLDER]; READER: all, {}",
        names.join(", ")
    );
    let mut wish = FuzzRequest { readers: Vec::new(), cases: 1000, seed: 1, from: 0, keep: "fuzz-found".into() };
    let mut words = words.into_iter();
    while let Some(word) = words.next() {
        let mut value = || words.next().ok_or_else(|| format!("{word} needs a value\n{help}"));
        let number = |text: String| text.parse().map_err(|_| format!("`{text}` is not a whole number\n{help}"));
        match word.as_str() {
            "--cases" => wish.cases = number(value()?)?,
            "--seed" => wish.seed = number(value()?)?,
            "--from" => wish.from = number(value()?)?,
            "--keep" => wish.keep = value()?.into(),
            "all" => wish.readers = READERS.iter().collect(),
            name => match READERS.iter().find(|reader| reader.name == name) {
                Some(reader) => wish.readers.push(reader),
                None => return Err(format!("`{name}` is no reader\n{help}")),
            },
        }
    }
    if wish.readers.is_empty() { Err(help) } else { Ok(wish) }
}

/// Gives the cases to a reader; prints how it went, and returns how many faults of different kinds were found.
fn run(reader: &Reader, wish: &FuzzRequest) -> usize {
    let corpus = reader.corpus();
    let mut watched = WatchedReader::new(reader, &wish.keep);
    for case in wish.from..wish.from + wish.cases {
        let mut random = mutate::Random::of(wish.seed, case);
        let input = mutate::broken(&corpus, &mut random);
        watched.feed(case, input, COUNTING);
    }
    let WatchTotals { kinds, read, seconds } = watched.end();
    let rate = wish.cases as f64 / seconds;
    println!(
        "{:<18} {:>8} cases, {:>7.0} cases/s, {:>3.0} % read, {} faults",
        reader.name,
        wish.cases,
        rate,
        100.0 * read as f64 / wish.cases.max(1) as f64,
        kinds
    );
    kinds
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Otherwise nothing behind the first check of a reader is ever reached.
    #[test]
    fn every_reader_reads_good_input() {
        let reads = |reader: &&Reader| reader.corpus().iter().any(|good| (reader.read)(good));
        let bad: Vec<&str> = READERS.iter().filter(|reader| !reads(reader)).map(|reader| reader.name).collect();
        assert!(bad.is_empty(), "{bad:?}");
    }

    #[test]
    fn a_case_is_known_by_its_seed_and_its_number() {
        let corpus = READERS[0].corpus();
        let of = |seed, case| mutate::broken(&corpus, &mut mutate::Random::of(seed, case));
        assert_eq!(of(1, 7), of(1, 7));
        assert!((0..50).any(|case| of(1, case) != of(2, case)) && (0..50).any(|case| of(1, case) != of(1, case + 1)));
    }
}
