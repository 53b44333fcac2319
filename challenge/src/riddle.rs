//! A challenge made: data with a hidden effect, and the seal of what it is.

use super::loads::in_plane;
use super::seal::{FILE, SALT, SEALED, Seal, hex};
use super::truth::{ROBOTS, known, standard_protocol};
use super::{Draw, Hiding, Truth};
use compare::CompareError;
use compare::study::{Generator, generate, parse_protocol};
use data::{About, Dataset};
use models::Scenario;
use sha2::{Digest, Sha256};
use std::hash::{BuildHasher, Hasher};

/// Accepted sizes of hidden effects as multiples of the typical size.
const SIZES: std::ops::RangeInclusive<f64> = 0.05..=3.0;

/// Choices for a challenge; choices left out are drawn.
#[derive(Debug, Clone, Default)]
pub struct Riddle {
    /// Makes the same challenge again; without it the hidden effect cannot be guessed.
    pub seed: Option<u64>,
    /// What to hide: nothing or `random`, `none`, or `NAME[=times its typical size]` each.
    pub effects: Vec<String>,
    /// Actuator kind, one of [`ROBOTS`]; drawn if `None`.
    pub actuator: Option<String>,
    /// How many runs are measured; drawn if `None`.
    pub runs: Option<usize>,
    /// Camera noise of one coordinate \[m\].
    pub camera_sd_m: Option<f64>,
    /// Pressures as [`parse_protocol`] reads them; else [`standard_protocol`].
    pub protocol: Option<String>,
    /// Nothing scatters from hold to hold.
    pub white: bool,
}

/// A challenge as it is handed out, truth sealed.
#[derive(Debug, Clone)]
pub struct Handout {
    /// Measured markers, which the files contain as `markers.csv`.
    pub dataset: Dataset,
    /// Files by name: `scenario.toml`, `about.toml` and `markers.csv`, which are sealed in this order, then `seal.toml`.
    pub files: Vec<(String, Vec<u8>)>,
    /// The seal's hash; who keeps it can prove the truth unchanged.
    pub sha256: String,
}

impl Riddle {
    /// Makes the challenge of that name.
    ///
    /// # Errors
    /// What cannot be hidden, or not in this robot; a protocol that cannot be read, or at which nothing balances.
    pub fn make(&self, name: &str) -> Result<Handout, CompareError> {
        let mut draw = Draw::new(self.seed.unwrap_or_else(unpredictable), 0);
        let truth = self.truth(&mut draw)?;
        let protocol = self.protocol.as_deref().map_or(Ok(standard_protocol()), parse_protocol)?;
        let dataset = truth.dataset(name, &protocol)?;
        let [about, markers] = data::set_files(&dataset, &about(&truth.told()?, &dataset))?;
        let mut files = vec![(SEALED[0].to_string(), truth.told_text()?.into_bytes()), about, markers];
        let seal = Seal::close(&sealed_text(&truth, &files)?, &self.salt(&mut draw));
        files.push((FILE.into(), seal.to_toml().into_bytes()));
        Ok(Handout { dataset, files, sha256: seal.sha256 })
    }

    fn truth(&self, draw: &mut Draw) -> Result<Truth, CompareError> {
        let kinds = ROBOTS.map(|(kind, _)| kind);
        let actuator = self.actuator.as_deref().unwrap_or_else(|| draw.one_of::<&str>(&kinds));
        let mut truth = Truth::draw(actuator, draw)?;
        truth.runs = self.runs.unwrap_or(truth.runs);
        truth.holds_scatter = !self.white;
        truth.camera_sd_m = self.camera_sd_m.unwrap_or(truth.camera_sd_m);
        match self.effects.iter().map(String::as_str).collect::<Vec<_>>()[..] {
            [] | ["random"] => truth.hide(kind(draw), draw)?,
            ["none"] => {}
            _ => self.hide(&mut truth, draw)?,
        }
        truth.robot()?;
        Ok(truth)
    }

    fn hide(&self, truth: &mut Truth, draw: &mut Draw) -> Result<(), CompareError> {
        if let Some(alone) = self.effects.iter().find(|text| ["none", "random"].contains(&text.as_str())) {
            let message = format!("--effect {alone} cannot be given with others");
            return Err(CompareError::refused(message, "name the effects to hide, or give none or random alone"));
        }
        for text in &self.effects {
            let (name, times) = effect(text, draw)?;
            if truth.effects.iter().any(|choice| choice.name == name) {
                return Err(CompareError::refused(
                    format!("the effect {name} is given twice"),
                    "name each effect once",
                ));
            }
            truth.add(name, times);
        }
        Ok(())
    }

    /// From the seed if one was given, so that the same command makes the same files.
    fn salt(&self, draw: &mut Draw) -> [u8; SALT] {
        let mut half = || match self.seed {
            Some(_) => draw.between(0.0, u64::MAX as f64) as u64,
            None => unpredictable(),
        };
        let mut salt = [0; SALT];
        salt[..8].copy_from_slice(&half().to_le_bytes());
        salt[8..].copy_from_slice(&half().to_le_bytes());
        salt
    }
}

/// The truth and the hashes of the files it belongs to.
fn sealed_text(truth: &Truth, files: &[(String, Vec<u8>)]) -> Result<String, CompareError> {
    let text = toml::to_string(truth).map_err(|error| CompareError::refused(error.to_string(), "report this"))?;
    let hashes: Vec<String> = files.iter().map(|(_, bytes)| format!("\"{}\"", hex(&Sha256::digest(bytes)))).collect();
    Ok(format!("files_sha256 = [{}]\n{text}", hashes.join(", ")))
}

/// Half of the challenges hide one effect; the others keep a reader from assuming so.
fn kind(draw: &mut Draw) -> Hiding {
    match draw.between(0.0, 1.0) {
        u if u < 0.15 => Hiding::Nothing,
        u if u < 0.65 => Hiding::One,
        u if u < 0.85 => Hiding::Two,
        _ => Hiding::Outside,
    }
}

/// `NAME` or `NAME=times its typical size`.
fn effect(text: &str, draw: &mut Draw) -> Result<(&'static str, f64), CompareError> {
    let (name, times) = text.split_once('=').map_or((text, None), |(name, times)| (name, Some(times)));
    let unknown =
        |e: CompareError| CompareError::refused(e.to_string(), "`ibr challenge list` shows what can be hidden");
    let effect = known(name.trim()).map_err(unknown)?;
    let times = match times {
        None if effect.is_outside() => 1.0,
        None => draw.between(0.8, 1.5),
        Some(word) => word.trim().parse().ok().filter(|times| SIZES.contains(times)).ok_or_else(|| {
            let [least, most] = [SIZES.start(), SIZES.end()];
            let message = format!("--effect {text}: `{word}` is not a size from {least} to {most}");
            CompareError::refused(message, format!("in typical sizes, for example {name}=1.2"))
        })?,
    };
    Ok((effect.name, times))
}

/// A seed that cannot be guessed: the keys of the standard library's hash maps are random.
fn unpredictable() -> u64 {
    std::collections::hash_map::RandomState::new().build_hasher().finish()
}

fn about(scenario: &Scenario, dataset: &Dataset) -> About {
    let notes = "Not a measurement. The hidden effect is sealed in seal.toml; the recorded pressures are the set ones.";
    About {
        title: format!("Challenge: markers of {}", scenario.name),
        source: "ibr challenge new".into(),
        gravity_direction: Some(in_plane(scenario.gravity_direction)),
        notes: Some(notes.into()),
        ..generate::about(scenario, dataset, &Generator::default())
    }
}
