//! The session of the README in ten lines: a model misses the data, what may be missing is found, added, and tried on others.

use ibr::{DiagnosisOptions, Evidence, ScenarioFile, compare, diagnose, extend, validate};

fn main() -> Result<(), ibr::Error> {
    session(&mut |line| println!("{line}"))
}

pub(crate) fn session(say: &mut dyn FnMut(String)) -> Result<(), ibr::Error> {
    let robot = ScenarioFile::read("epam-textbook")?;
    let data = [Evidence::read("synthetic-epam")?];
    say(format!("as given: {:.2} mm beyond noise", compare(&robot, &data[0])?.error_mm()));
    let found = diagnose(&robot, &data, &DiagnosisOptions::default(), &mut |_, _| ())?;
    found.summary.iter().for_each(|sentence| say(sentence.clone()));
    let extension = extend(&robot, &found)?;
    extension.told.iter().for_each(|sentence| say(sentence.clone()));
    say(format!("extended: {:.2} mm beyond noise", compare(&extension.file, &data[0])?.error_mm()));
    let other = validate(&extension.file, &Evidence::read("synthetic-epam-two-bodies")?)?;
    say(format!("other data: {}", other.sentence));
    Ok(())
}
