//! Tests of a fabric, as files.

use super::{Characterized, Reduction, characterize};
use crate::CompareError;
use crate::progress::Progress;
use data::bench::bending_lengths_m;
use data::{Bench, Coupon, CouponDefaults, SetInfo, bench, parse_coupons, read_coupons};
use fem::session::FileHash;
use spelling::files::{MOST_DATA, read_whole};
use std::path::Path;

/// Tensile and cantilever tests of one fabric.
#[derive(Debug, Clone, Default)]
pub struct FabricTests {
    /// Specimens that were pulled, of all files.
    pub coupons: Vec<Coupon>,
    /// Cantilever tests, one table of bending lengths each.
    pub bent: Vec<Bench>,
    /// Files that were read, with the hash of each.
    pub files: Vec<FileHash>,
}

impl FabricTests {
    /// Reads tensile and cantilever tests; an embedded set is read by its name.
    ///
    /// # Errors
    /// A fault of a file, or a table that is of no fabric.
    pub fn read(files: &[String], defaults: &CouponDefaults, tell: &mut Progress) -> Result<FabricTests, CompareError> {
        let mut tests = FabricTests::default();
        for file in files {
            tell(&format!("reading {file}"), None);
            match data::sets().into_iter().find(|set| set.name == *file && !Path::new(file).exists()) {
                Some(set) => tests.add_set(&set, defaults)?,
                None => tests.add(file, defaults)?,
            }
        }
        Ok(tests)
    }

    fn add_set(&mut self, set: &SetInfo, defaults: &CouponDefaults) -> Result<(), CompareError> {
        let coupons: Vec<&String> = set.files.iter().filter(|name| name.starts_with("coupon")).collect();
        if coupons.is_empty() {
            let help = "`ibr list datasets` shows the files of every set";
            return Err(CompareError::refused(format!("the set {} has no tests of a fabric", set.name), help));
        }
        for name in coupons {
            let (text, shown) = (data::set_file(&set.name, name)?, format!("set:{}/{name}", set.name));
            self.files.push(FileHash::of(&shown, text.as_bytes()));
            let size = text.len() as u64;
            self.coupons.extend(parse_coupons(&shown, &mut text.as_bytes(), size, defaults, &mut |_, _| ())?);
        }
        Ok(())
    }

    fn add(&mut self, file: &str, defaults: &CouponDefaults) -> Result<(), CompareError> {
        let path = Path::new(file);
        let table = bench(file)?;
        // A pipe can be read only once.
        let bytes = read_whole(path, MOST_DATA);
        self.files.extend(bytes.iter().map(|bytes| FileHash::of(file, bytes)));
        let progress = &mut |_, _| ();
        match (table, bytes) {
            (Some(table), _) if table.kind.name == "bending_length" => self.bent.push(table),
            (Some(table), _) => {
                let message = format!("{file} is a {} table, not a test of a fabric", table.kind.name);
                let help = format!("`ibr compare {file}` holds it against its model");
                return Err(CompareError::refused(message, help));
            }
            (None, Ok(bytes)) => {
                let (mut text, size) = (bytes.as_slice(), bytes.len() as u64);
                self.coupons.extend(parse_coupons(file, &mut text, size, defaults, progress)?);
            }
            // `read_coupons` reports why the file cannot be read.
            (None, Err(_)) => self.coupons.extend(read_coupons(path, defaults, progress)?),
        }
        Ok(())
    }

    /// Numbers and curves of the fabric.
    ///
    /// # Errors
    /// No test at all, and as for [`characterize`].
    pub fn reduce(&self, settings: &Reduction) -> Result<Characterized, CompareError> {
        let Some(origin) =
            self.coupons.iter().map(|c| c.provenance).chain(self.bent.iter().map(|b| b.provenance)).next()
        else {
            let help = "name a file of tensile tests, or of bending lengths";
            return Err(CompareError::refused("no specimen was given", help));
        };
        let mut found = characterize(&self.coupons, settings)?;
        if self.coupons.is_empty() {
            found.provenance = origin;
        }
        for table in &self.bent {
            found.bend(&bending_lengths_m(table), table.provenance.word());
        }
        Ok(found)
    }
}
