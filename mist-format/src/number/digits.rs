//! The decimal digits of a number, correctly rounded, without arithmetic of many digits.
//!
//! x 10^p is the product of the 64-bit mantissa of x and a 128-bit power of ten that is at most
//! 2 units of its last place too small. The product has 192 bits, so its fraction is known to
//! about 60 bits behind what the mantissa itself can tell; only where that fraction lies within
//! the error of ½ is the answer left to the slow way, which the caller has anyway.

/// Most digits that the fast way gives.
pub(super) const MOST: usize = 17;

/// Significant decimal digits d.ddd… of a number, times 10^exponent.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Digits {
    ascii: Ascii,
    count: usize,
    /// The power of ten of the first digit.
    pub(super) exponent: i32,
}

/// Digits, and zeros behind them; whole words are checked faster than bytes when it becomes text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(align(16))]
struct Ascii([u8; 32]);

/// A number as text.
pub(super) struct Short {
    ascii: Ascii,
    count: usize,
}

impl Short {
    pub(super) fn as_str(&self) -> &str {
        self.ascii.first(self.count)
    }
}

impl Ascii {
    const ZEROS: Self = Self([b'0'; 32]);

    /// The first `count` of them as text.
    fn first(&self, count: usize) -> &str {
        &std::str::from_utf8(&self.0).unwrap_or_default()[..count]
    }
}

impl Digits {
    /// The first `count` digits of a finite x ≥ 0, rounded to nearest; none if that needs the
    /// slow way.
    #[inline]
    pub(super) fn of(x: f64, count: usize) -> Option<Self> {
        if !(1..=MOST).contains(&count) {
            return None;
        }
        if x == 0.0 {
            return Some(Self { ascii: Ascii::ZEROS, count, exponent: 0 });
        }
        let above = POWERS_OF_TEN[count];
        let mut exponent = lower_exponent(x);
        let mut whole = scaled(x, count as i32 - 1 - exponent)?;
        if whole >= above {
            // The estimate was one too low, or all digits were nines and are rounded up.
            exponent += 1;
            whole = scaled(x, count as i32 - 1 - exponent)?;
        }
        Some(Self { ascii: ascii(whole, count), count, exponent })
    }

    /// The digits of a finite x ≥ 0 down to 10^−`places`, one before the point at least; none if
    /// that needs the slow way.
    pub(super) fn down_to(x: f64, places: usize) -> Option<Self> {
        let whole = scaled(x, i32::try_from(places).ok()?)?;
        let count = POWERS_OF_TEN.iter().position(|power| whole < *power)?.max(places + 1);
        (count <= MOST).then(|| Self {
            ascii: ascii(whole, count),
            count,
            exponent: (count - 1 - places) as i32,
        })
    }

    /// d.ddde+05, with a point if something follows or `point` says so; none for exponents of three
    /// digits.
    #[inline]
    pub(super) fn scientific(&self, point: bool) -> Option<Short> {
        let size = self.exponent.unsigned_abs() as u8;
        if self.exponent.unsigned_abs() >= 100 {
            return None;
        }
        let (digits, mut text) = (&self.ascii.0, Ascii::ZEROS);
        text.0[0] = digits[0];
        text.0[1] = b'.';
        // With all that may follow of 17 digits: the lengths are known.
        text.0[2..MOST + 1].copy_from_slice(&digits[1..MOST]);
        let end = if self.count > 1 || point { self.count + 1 } else { 1 };
        text.0[end] = b'e';
        text.0[end + 1] = if self.exponent < 0 { b'-' } else { b'+' };
        text.0[end + 2] = b'0' + size / 10;
        text.0[end + 3] = b'0' + size % 10;
        Some(Short { ascii: text, count: end + 4 })
    }

    /// The digits as text.
    pub(super) fn as_str(&self) -> &str {
        self.ascii.first(self.count)
    }
}

/// x 10^p rounded to the nearest whole number, for a finite x > 0; none where the rounding is
/// not certain, the number is below 1 or has more than 18 digits.
fn scaled(x: f64, p: i32) -> Option<u64> {
    let power = *POWERS.get(usize::try_from(p - LEAST_POWER).ok()?)?;
    let (mantissa, exponent) = normalized(x);
    let low = u128::from(mantissa) * (power & u128::from(u64::MAX));
    let high = u128::from(mantissa) * (power >> 64) + (low >> 64);
    // x 10^p = (high, low 64 bits) / 2^places.
    let places = -(exponent + binary_exponent(p));
    // Of the places 64 lie in the dropped word and 64 in the lower half of `high`.
    if x == 0.0 || !(130..=191).contains(&places) {
        return None;
    }
    let places = (places - 64) as u32;
    let (whole, fraction) = ((high >> places) as u64, high & ((1 << places) - 1));
    let half = 1_u128 << (places - 1);
    if fraction > half {
        Some(whole + 1)
    } else if fraction + ERROR < half {
        Some(whole)
    } else {
        None
    }
}

/// Error bound of the upper 128 bits of a product: 2 units of the power times a mantissa below
/// 2^64, and the dropped word.
const ERROR: u128 = 4;

/// x = mantissa 2^exponent with the upper bit of the mantissa set, for a finite x > 0.
fn normalized(x: f64) -> (u64, i32) {
    let bits = x.to_bits();
    let fraction = bits & ((1 << 52) - 1);
    let (mantissa, exponent) = match (bits >> 52) as i32 {
        0 => (fraction, -1074),
        biased => (fraction | (1 << 52), biased - 1075),
    };
    let shift = mantissa.leading_zeros();
    (mantissa << shift, exponent - shift as i32)
}

/// The power of ten of the first digit of x > 0, or one less.
fn lower_exponent(x: f64) -> i32 {
    let (_, exponent) = normalized(x);
    // floor(b log10 2) for the power of two b of the first bit; exact for |b| < 1650.
    ((exponent + 63) * 315_653) >> 20
}

/// 10^p is `POWERS[p]` 2^(this) with the upper bit of `POWERS[p]` set: floor(p log2 10) − 127.
const fn binary_exponent(p: i32) -> i32 {
    // Exact for |p| < 1650.
    ((p * 1_741_647) >> 19) - 127
}

/// The smallest p of [`POWERS`]: the largest number has 309 digits before its point.
const LEAST_POWER: i32 = -309;
/// As many as take the 17 digits of the smallest number, 5e-324, before the point.
const COUNT: usize = 309 + 342;

/// The upper 128 bits of 10^p, cut off; p from [`LEAST_POWER`].
static POWERS: [u128; COUNT] = powers();

/// 10^n for n up to 17.
const POWERS_OF_TEN: [u64; MOST + 1] = {
    let mut powers = [1; MOST + 1];
    let mut n = 1;
    while n <= MOST {
        powers[n] = 10 * powers[n - 1];
        n += 1;
    }
    powers
};

/// Multiplied and divided by ten from 1 on with 192 bits: each step loses less than 8 units of
/// the last of them, all together less than 2^12, far below the last of the 128 that are kept.
const fn powers() -> [u128; COUNT] {
    let mut table = [0; COUNT];
    let one = [0, 0, 1 << 63];
    let zero = -LEAST_POWER as usize;
    let mut power = one;
    let mut at = zero;
    while at < COUNT {
        table[at] = upper(power);
        power = times_five(power);
        at += 1;
    }
    power = one;
    at = zero;
    while at > 0 {
        power = fifth(power);
        at -= 1;
        table[at] = upper(power);
    }
    table
}

const fn upper(words: [u64; 3]) -> u128 {
    ((words[2] as u128) << 64) | words[1] as u128
}

/// Five times the number, with its upper bit in place again.
const fn times_five(words: [u64; 3]) -> [u64; 3] {
    let mut product = [0; 4];
    let mut carry = 0;
    let mut at = 0;
    while at < 3 {
        let sum = words[at] as u128 * 5 + carry;
        product[at] = sum as u64;
        carry = sum >> 64;
        at += 1;
    }
    product[3] = carry as u64;
    // 5 × 2^191 … 5 × 2^192 has 194 or 195 bits.
    let shift = 64 - product[3].leading_zeros();
    let mut out = [0; 3];
    at = 0;
    while at < 3 {
        out[at] = (product[at] >> shift) | (product[at + 1] << (64 - shift));
        at += 1;
    }
    out
}

/// A fifth of the number, with its upper bit in place again.
const fn fifth(words: [u64; 3]) -> [u64; 3] {
    let mut quotient = [0; 3];
    let mut rest = 0;
    let mut at = 3;
    while at > 0 {
        at -= 1;
        let part = (rest << 64) | words[at] as u128;
        quotient[at] = (part / 5) as u64;
        rest = part % 5;
    }
    let shift = quotient[2].leading_zeros();
    [
        quotient[0] << shift,
        (quotient[1] << shift) | (quotient[0] >> (64 - shift)),
        (quotient[2] << shift) | (quotient[1] >> (64 - shift)),
    ]
}

/// The last `count` decimal digits of `whole`.
#[inline]
fn ascii(mut whole: u64, count: usize) -> Ascii {
    let Ascii(mut ascii) = Ascii::ZEROS;
    let mut at = count;
    while at >= 2 {
        let pair = (whole % 100) as usize * 2;
        whole /= 100;
        at -= 2;
        ascii[at..at + 2].copy_from_slice(&PAIRS[pair..pair + 2]);
    }
    if at == 1 {
        ascii[0] = b'0' + (whole % 10) as u8;
    }
    Ascii(ascii)
}

/// 00 01 02 … 99.
const PAIRS: [u8; 200] = {
    let mut pairs = [0; 200];
    let mut n = 0;
    while n < 100 {
        pairs[2 * n] = b'0' + (n / 10) as u8;
        pairs[2 * n + 1] = b'0' + (n % 10) as u8;
        n += 1;
    }
    pairs
};

#[cfg(test)]
mod tests {
    use super::*;

    /// The digits and the exponent as the standard library has them.
    fn slow(x: f64, count: usize) -> (String, i32) {
        let text = format!("{:.*e}", count - 1, x);
        let (mantissa, exponent) = text.split_once('e').unwrap();
        (mantissa.replace('.', ""), exponent.parse().unwrap())
    }

    /// True if the fast path gives the digits.
    fn agrees(x: f64, count: usize) -> bool {
        let Some(digits) = Digits::of(x, count) else { return false };
        assert_eq!((digits.as_str().to_owned(), digits.exponent), slow(x, count), "{x:e} {count}");
        true
    }

    #[test]
    fn all_magnitudes_have_the_digits_of_the_standard_library() {
        // A generator of its own: the same numbers everywhere (Steele, Lea, Flood, 2014).
        let mut state = 0_u64;
        let mut next = || {
            state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
            let x = (state ^ (state >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
            let x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
            x ^ (x >> 31)
        };
        let mut answered = 0;
        for _ in 0..60_000 {
            let x = f64::from_bits(next() >> 1);
            let count = 1 + (next() % MOST as u64) as usize;
            if x.is_finite() {
                answered += usize::from(agrees(x, count));
            }
        }
        // All but the NaNs, one in 2048.
        assert!(answered > 59_900, "{answered}");
    }

    #[test]
    fn short_decimals_powers_and_the_ends_of_the_range_have_the_digits_of_the_standard_library() {
        for exponent in -330..=308 {
            for mantissa in ["1", "2", "5", "9", "9.5", "2.5", "9.9999999999999", "1.2345"] {
                let x: f64 = format!("{mantissa}e{exponent}").parse().unwrap();
                for count in 1..=MOST {
                    for near in [x, x.next_up(), x.next_down().max(0.0)] {
                        if near.is_finite() {
                            agrees(near, count);
                        }
                    }
                }
            }
        }
        for bits in 0..64 {
            let x = f64::from_bits(1 << bits);
            if x.is_finite() && x > 0.0 {
                for count in 1..=MOST {
                    agrees(x, count);
                }
            }
        }
        for count in 1..=MOST {
            assert!(agrees(f64::MAX, count) && agrees(5e-324, count) && agrees(0.0, count));
        }
    }

    #[test]
    fn fixed_places_are_those_of_the_standard_library() {
        let mut answered = 0;
        for n in 1..20_000_u32 {
            let x = f64::from(n).powi(3) * 1.234_567_8e-7;
            for places in 0..=MOST {
                let Some(digits) = Digits::down_to(x, places) else { continue };
                let text = format!("{x:.places$}").replace('.', "");
                assert_eq!(digits.as_str(), text, "{x} {places}");
                assert_eq!(digits.exponent, text.len() as i32 - 1 - places as i32);
                answered += 1;
            }
        }
        assert!(answered > 200_000, "{answered}");
    }

    #[test]
    fn halves_are_left_to_the_slow_way() {
        assert_eq!(Digits::of(2.5, 1), None);
        assert_eq!(Digits::of(0.125, 2), None);
        assert_eq!(scaled(0.5, 0), None);
        assert_eq!(scaled(1.5, 1), Some(15));
    }

    #[test]
    fn more_digits_than_the_fast_way_has_are_left_to_the_slow_way() {
        assert_eq!(Digits::of(0.1, MOST + 1), None);
        assert_eq!(Digits::of(0.1, 0), None);
    }
}
