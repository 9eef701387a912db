//! Cache of values of slow functions: loops come back to the
//! same numbers again and again.

use super::functions::Function;

/// Values of functions of one number; a value is forgotten when another one comes to its place.
#[derive(Clone, Debug, Default)]
pub(super) struct Memo {
    /// Function, argument and value by their bits; all zero where nothing is.
    places: Vec<[u64; 3]>,
    asked: usize,
}

/// Binary logarithm of the number of places.
const BITS: u32 = 12;
/// So many questions are answered without a memory, which most evaluations never need.
const FEW: usize = 256;

impl Memo {
    /// The value of `function` at `x`.
    #[inline]
    pub(super) fn value(&mut self, function: Function, x: f64) -> f64 {
        // 2⁶⁴ over the golden ratio, odd: it spreads neighbours.
        const SPREAD: u64 = 0x9e37_79b9_7f4a_7c15;
        if self.places.is_empty() {
            self.asked += 1;
            if self.asked <= FEW {
                return function.of_one(x);
            }
            self.places = vec![[0; 3]; 1 << BITS];
        }
        let key = [function as u64 + 1, x.to_bits()];
        let at = (key[0].rotate_right(8) ^ key[1]).wrapping_mul(SPREAD) >> (64 - BITS);
        let place = &mut self.places[at as usize];
        if place[..2] != key {
            *place = [key[0], key[1], function.of_one(x).to_bits()];
        }
        f64::from_bits(place[2])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_remembered_has_the_bits_of_what_is_computed() {
        let mut memo = Memo::default();
        let functions = Function::ALL.iter().copied().filter(|function| function.arity() == 1);
        for round in 0..4 {
            for function in functions.clone() {
                for k in -400..400 {
                    let x = f64::from(k) * 0.37 + f64::from(round % 2);
                    for x in [x, x.next_up(), -x, x / 0.0] {
                        let value = memo.value(function, x).to_bits();
                        assert_eq!(value, function.of_one(x).to_bits(), "{function:?} {x}");
                    }
                }
            }
        }
    }
}
