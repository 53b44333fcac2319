//! The session of the README in ten lines: a model misses the data, what may be missing is found, added, and tried on others.

use ibr::{DiagnosisOptions, Evidence, ScenarioFile, compare, diagnose, extend, validate};

fn main() -> Result<(), ibr::Error> {
    let robot = ScenarioFile::read("epam-textbook")?;
    let data = [Evidence::read("synthetic-epam")?];
    println!("as given: {:.2} mm beyond noise", compare(&robot, &data[0])?.error_mm());
    let found = diagnose(&robot, &data, &DiagnosisOptions::default(), &mut |_, _| ())?;
    found.summary.iter().for_each(|sentence| println!("{sentence}"));
    let extension = extend(&robot, &found)?;
    extension.told.iter().for_each(|sentence| println!("{sentence}"));
    println!("extended: {:.2} mm beyond noise", compare(&extension.file, &data[0])?.error_mm());
    println!("other data: {}", validate(&extension.file, &Evidence::read("synthetic-epam-two-bodies")?)?.sentence);
    Ok(())
}
