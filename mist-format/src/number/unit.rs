//! Units behind numbers, which the language does not have: the remedy for each.

use super::general;

/// Lengths with their factor to µm.
const LENGTHS: [(&str, f64); 13] = [
    ("um", 1.0),
    ("µm", 1.0),
    ("μm", 1.0),
    ("micron", 1.0),
    ("microns", 1.0),
    ("nm", 1e-3),
    ("mm", 1e3),
    ("cm", 1e4),
    ("m", 1e6),
    ("pm", 1e-6),
    ("Å", 1e-4),
    ("A", 1e-4),
    ("angstrom", 1e-4),
];

/// The remedy for `number`, written with `unit` behind it; none if that is not a unit.
///
/// ```
/// use mist_format::number::without_unit;
///
/// assert_eq!(without_unit("500", "nm").unwrap(), "lengths are in µm and have no unit: write 0.5");
/// ```
pub fn without_unit(number: &str, unit: &str) -> Option<String> {
    let x: f64 = number.parse().ok()?;
    if let Some((_, factor)) = LENGTHS.iter().find(|(name, _)| *name == unit) {
        let um = general(x * factor, 12);
        return Some(format!("lengths are in µm and have no unit: write {um}"));
    }
    match unit {
        "deg" | "degree" | "degrees" | "°" => {
            Some(format!("angles are in radians and have no unit: write {number}*deg"))
        }
        "rad" | "radian" | "radians" => {
            Some(format!("angles are in radians and have no unit: write {number}"))
        }
        "sr" => Some(format!("solid angles are in sr and have no unit: write {number}")),
        _ => None,
    }
}

/// The length of the unit at the beginning of `text`: letters and the sign of degrees.
pub fn unit_length(text: &str) -> usize {
    let is_unit = |c: char| c.is_alphabetic() || c == '°';
    text.find(|c| !is_unit(c)).unwrap_or(text.len())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_unit_has_a_number_without_it() {
        for (number, unit, end) in [
            ("1.5", "um", "write 1.5"),
            ("632.8", "nm", "write 0.6328"),
            ("0.1", "mm", "write 100"),
            ("45", "°", "write 45*deg"),
        ] {
            let told = without_unit(number, unit).unwrap();
            assert!(told.ends_with(end), "{told}");
        }
        assert_eq!(without_unit("2", "x"), None);
        assert_eq!(unit_length("µm*2"), "µm".len());
    }
}
