//! Keys of the service: random, shown once, kept as digests.
//!
//! A line of the file of keys is `NAME SCOPES DIGEST`: scopes are some of `read`, `run` and `admin`
//! with commas between them, of which the highest counts. The digest is the SHA-256 of the key in
//! hexadecimal. A key has 256 random bits, so nobody finds it
//! from its digest by trying.

use std::fmt::Write as _;

use sha2::{Digest, Sha256};
use subtle::ConstantTimeEq;

/// Beginning of every key, so that one in a log is recognized.
const PREFIX: &str = "mist_";
/// Random bytes of a key.
const BYTES: usize = 32;

/// Permission of a key; each includes those before it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum KeyScope {
    /// To look at what is there, and to compute within small limits.
    Read,
    /// To compute, and to store and change what is its own.
    Run,
    /// To change what others have stored.
    Admin,
}

impl KeyScope {
    /// Its name.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Read => "read",
            Self::Run => "run",
            Self::Admin => "admin",
        }
    }
}

/// A known key.
#[derive(Clone, Debug)]
struct Key {
    name: String,
    scope: KeyScope,
    digest: [u8; 32],
}

/// The keys of a service.
#[derive(Clone, Debug, Default)]
pub(crate) struct Keys(Vec<Key>);

impl Keys {
    /// Reads the lines of a file of keys; `#` begins a comment.
    ///
    /// # Errors
    ///
    /// Names the line and what was expected.
    pub(crate) fn parse(text: &str) -> Result<Self, String> {
        let mut keys = Vec::new();
        for (at, line) in text.lines().enumerate() {
            let line = line.split('#').next().unwrap_or("").trim();
            if !line.is_empty() {
                let key = key(line).map_err(|problem| format!("line {}: {problem}", at + 1))?;
                keys.push(key);
            }
        }
        if keys.is_empty() {
            return Err("there is no key in it".into());
        }
        Ok(Self(keys))
    }

    /// The name and the scope of a key; none if the key is not known.
    ///
    /// All digests are compared whole: the time tells nothing about them.
    pub(crate) fn find(&self, key: &str) -> Option<(&str, KeyScope)> {
        let digest: [u8; 32] = Sha256::digest(key).into();
        let mut found = None;
        for known in &self.0 {
            if bool::from(known.digest.ct_eq(&digest)) {
                found = Some((known.name.as_str(), known.scope));
            }
        }
        found
    }
}

fn key(line: &str) -> Result<Key, String> {
    let [name, scopes, digest] = line.split_whitespace().collect::<Vec<_>>()[..] else {
        return Err("expected NAME SCOPES DIGEST".into());
    };
    let scope = |text: &str| match text {
        "read" => Ok(KeyScope::Read),
        "run" => Ok(KeyScope::Run),
        "admin" => Ok(KeyScope::Admin),
        _ => Err(format!("scope {text:?} is none of read, run and admin")),
    };
    let scopes: Result<Vec<KeyScope>, String> = scopes.split(',').map(scope).collect();
    let scope = scopes?.into_iter().max().ok_or("a scope is missing")?;
    let digest = bytes(digest).ok_or("the digest is not 64 hexadecimal digits")?;
    Ok(Key { name: name.to_owned(), scope, digest })
}

fn bytes(hexadecimal: &str) -> Option<[u8; 32]> {
    let digits: Option<Vec<u32>> = hexadecimal.chars().map(|c| c.to_digit(16)).collect();
    let pairs = digits?.chunks(2).map(|d| u8::try_from(16 * d[0] + d.get(1)?).ok()).collect();
    let all: Option<Vec<u8>> = pairs;
    all?.try_into().ok()
}

/// A new key.
///
/// # Errors
///
/// If the system has no random numbers.
pub fn random() -> Result<String, getrandom::Error> {
    let mut bytes = [0; BYTES];
    getrandom::fill(&mut bytes)?;
    Ok(PREFIX.to_owned() + &hexadecimal(&bytes))
}

/// The line of the file of keys for `key`.
pub fn line(name: &str, scopes: &str, key: &str) -> String {
    format!("{name} {scopes} {}", hexadecimal(&Sha256::digest(key)))
}

/// Two digits per byte.
pub(crate) fn hexadecimal(bytes: &[u8]) -> String {
    bytes.iter().fold(String::new(), |mut text, byte| {
        // Writing to a string cannot fail.
        let _ = write!(text, "{byte:02x}");
        text
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_key_is_known_by_its_digest_and_has_its_highest_scope() {
        let key = random().unwrap();
        let file = format!("# keys\n{}\n", line("farm", "read", &key));
        assert!(!file.contains(&key));
        let keys = Keys::parse(&file).unwrap();
        assert_eq!(keys.find(&key), Some(("farm", KeyScope::Read)));
        assert_eq!(keys.find("mist_other"), None);
        let both = Keys::parse(&line("farm", "run,read", &key)).unwrap();
        assert_eq!(both.find(&key), Some(("farm", KeyScope::Run)));
    }

    #[test]
    fn a_wrong_line_is_told_by_its_number() {
        for wrong in ["a read", "a write 00", "a read 12", "a read zz", ""] {
            assert!(Keys::parse(&format!("\n{wrong}\n")).is_err(), "{wrong}");
        }
        assert!(Keys::parse("\na read 12").unwrap_err().contains("line 2"));
    }
}
