//! A number that tells states of parameters apart.

use std::hash::{Hash, Hasher};

/// A 128-bit digest of everything that a model is built from.
///
/// Two states with equal digests are taken for equal: among 10⁹ states of a run the chance of
/// a mistake is below 10⁻²⁰.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Fingerprint(u64, u64);

impl Fingerprint {
    /// The digest of `value`.
    pub(crate) fn of(value: &impl Hash) -> Self {
        let mut digest = Digest::default();
        value.hash(&mut digest);
        Self(digest.finish(), digest.second())
    }
}

/// Two lanes of multiplied and folded words, with different odd constants: the first 128 bits of
/// the fractional parts of √2 and √3.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Digest {
    a: u64,
    b: u64,
}

const A: [u64; 2] = [0x6a09_e667_f3bc_c909, 0xb2fb_1366_ea95_7d3f];
const B: [u64; 2] = [0xbb67_ae85_84ca_a73b, 0x2574_2d70_78b8_3b89];

impl Default for Digest {
    fn default() -> Self {
        Self { a: A[0], b: B[0] }
    }
}

/// The high and the low half of the product, added.
fn folded(x: u64, y: u64) -> u64 {
    let product = u128::from(x) * u128::from(y);
    (product as u64) ^ ((product >> 64) as u64)
}

impl Digest {
    fn second(&self) -> u64 {
        folded(self.b, A[1])
    }
}

impl Hasher for Digest {
    fn finish(&self) -> u64 {
        folded(self.a, B[1])
    }

    fn write(&mut self, bytes: &[u8]) {
        for chunk in bytes.chunks(8) {
            let mut word = [0; 8];
            word[..chunk.len()].copy_from_slice(chunk);
            self.write_u64(u64::from_le_bytes(word));
        }
        self.write_u64(bytes.len() as u64);
    }

    fn write_u64(&mut self, word: u64) {
        self.a = folded(self.a.wrapping_add(word), A[1]).wrapping_add(word.rotate_left(32));
        self.b = folded(self.b ^ word, B[1]).wrapping_add(word);
    }

    fn write_usize(&mut self, word: usize) {
        self.write_u64(word as u64);
    }

    fn write_u8(&mut self, byte: u8) {
        self.write_u64(u64::from(byte));
    }
}

#[cfg(test)]
mod tests {
    use std::collections::HashSet;

    use super::*;

    #[test]
    fn close_numbers_have_different_digests() {
        let mut seen = HashSet::new();
        for i in 0..200_000_u64 {
            let x = 0.4 + 1e-15 * i as f64;
            seen.insert(Fingerprint::of(&(x.to_bits(), "lambda")));
            seen.insert(Fingerprint::of(&(i, x.to_bits())));
        }
        let bits: HashSet<u64> =
            (0..200_000_u64).map(|i| (0.4 + 1e-15 * i as f64).to_bits()).collect();
        assert_eq!(seen.len(), 200_000 + bits.len());
        let halves: HashSet<u64> = seen.iter().map(|digest| digest.0).collect();
        assert_eq!(halves.len(), seen.len());
    }

    #[test]
    fn the_border_between_texts_counts() {
        assert_ne!(Fingerprint::of(&("ab", "c")), Fingerprint::of(&("a", "bc")));
    }
}
