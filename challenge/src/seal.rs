//! The seal of a truth: a hash that commits to it, and the truth itself, encoded against reading by accident.
//!
//! ```text
//! sha256 = SHA-256(salt ‖ truth)          printed when the challenge is made; who keeps it can prove the truth unchanged
//! truth  = hex(text XOR keystream)        keystream = SHA-256(salt ‖ 0), SHA-256(salt ‖ 1), …
//! ```
//!
//! This keeps honest eyes out, not a determined reader: the file also contains the salt.

use sha2::{Digest, Sha256};

/// Format of the seal; 2 covers all files of the challenge, 1 covered the markers alone.
pub(crate) const VERSION: u32 = 2;

/// Contents of `seal.toml`: the truth in masked form and a hash that commits to it.
#[derive(Debug, Clone, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Seal {
    pub schema: String,
    pub version: u32,
    /// SHA-256 of salt and truth, in hexadecimal digits.
    pub sha256: String,
    /// Random bytes that make the hash unguessable, in hexadecimal digits.
    pub salt: String,
    /// Truth XOR keystream, in hexadecimal digits.
    pub truth: String,
}

pub(crate) const FILE: &str = "seal.toml";
/// The files handed out with it, all of them sealed.
pub(crate) const SEALED: [&str; 3] = ["scenario.toml", "about.toml", "markers.csv"];
pub(crate) const SALT: usize = 16;

impl Seal {
    /// Seals a text with a hash of salt and text.
    pub(crate) fn close(text: &str, salt: &[u8; SALT]) -> Seal {
        Seal {
            schema: "ibr.challenge".into(),
            version: VERSION,
            sha256: hex(&commitment(salt, text.as_bytes())),
            salt: hex(salt),
            truth: hex(&masked(text.as_bytes(), salt)),
        }
    }

    pub(crate) fn open(&self) -> Option<String> {
        let salt = bytes(&self.salt)?;
        let text = masked(&bytes(&self.truth)?, &salt);
        if hex(&commitment(&salt, &text)) != self.sha256 {
            return None;
        }
        String::from_utf8(text).ok()
    }

    /// Text of the file `seal.toml`, with a comment for its reader.
    pub(crate) fn to_toml(&self) -> String {
        let Seal { schema, version, sha256, salt, truth } = self;
        format!(
            "# Opened only by `ibr challenge reveal`.\nschema = \"{schema}\"\nversion = {version}\n\
             sha256 = \"{sha256}\"\nsalt = \"{salt}\"\ntruth = \"{truth}\"\n"
        )
    }
}

fn commitment(salt: &[u8], text: &[u8]) -> Vec<u8> {
    Sha256::new().chain_update(salt).chain_update(text).finalize().to_vec()
}

fn masked(text: &[u8], salt: &[u8]) -> Vec<u8> {
    let stream = (0u64..).flat_map(|block| commitment(salt, &block.to_le_bytes()));
    text.iter().zip(stream).map(|(byte, mask)| byte ^ mask).collect()
}

/// Two lower-case hexadecimal digits per byte, without separators.
pub(crate) fn hex(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("{byte:02x}")).collect()
}

fn bytes(hex: &str) -> Option<Vec<u8>> {
    if !hex.len().is_multiple_of(2) || !hex.is_ascii() {
        return None;
    }
    (0..hex.len()).step_by(2).map(|i| u8::from_str_radix(&hex[i..i + 2], 16).ok()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_was_sealed_comes_out_and_a_changed_letter_does_not() {
        let seal = Seal::close("friction 1.2\nü", &[7; SALT]);
        assert_eq!(seal.open().as_deref(), Some("friction 1.2\nü"));
        assert!(!seal.to_toml().contains("friction"));
        for changed in [
            Seal { truth: format!("00{}", &seal.truth[2..]), ..seal.clone() },
            Seal { salt: hex(&[8; SALT]), ..seal.clone() },
            Seal { truth: "xyz".into(), ..seal.clone() },
            Seal { truth: String::new(), ..seal.clone() },
        ] {
            assert_eq!(changed.open(), None);
        }
        assert_eq!(toml::from_str::<Seal>(&seal.to_toml()), Ok(seal));
    }
}
