//! Lists of numbers: nodes of an axis, wavelengths.

use std::{fmt, str::FromStr};

use serde::{Deserialize, Deserializer, Serialize, de::Error as _};

use super::error::{InvalidText, number};

/// Largest number of nodes of one axis.
const MAX_NODES: f64 = 100_000.0;

/// Finite numbers, such as the nodes of an axis in degrees.
///
/// The text is a list with commas of numbers and ranges `start:step:stop`; a range ends at `stop`,
/// or before it if the steps do not meet it.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
#[serde(transparent)]
pub struct Nodes(Vec<f64>);

impl Nodes {
    /// These numbers.
    ///
    /// # Errors
    ///
    /// If one is not finite.
    pub fn new(numbers: Vec<f64>) -> Result<Self, InvalidText> {
        match numbers.iter().find(|x| !x.is_finite()) {
            Some(x) => Err(InvalidText::new(x.to_string(), "a number")),
            // The sum has no sign at zero.
            None => Ok(Self(numbers.into_iter().map(|x| x + 0.0).collect())),
        }
    }

    /// The numbers.
    pub fn into_vec(self) -> Vec<f64> {
        self.0
    }

    /// The numbers, in order.
    pub fn as_slice(&self) -> &[f64] {
        &self.0
    }
}

impl FromStr for Nodes {
    type Err = InvalidText;

    fn from_str(text: &str) -> Result<Self, InvalidText> {
        let mut all = Vec::new();
        for piece in text.split(',') {
            let ends: Vec<&str> = piece.split(':').collect();
            match ends[..] {
                [one] => all.push(number(one)?),
                [start, step, stop] => {
                    let [start, step, stop] = [number(start)?, number(step)?, number(stop)?];
                    let count = ((stop - start) / step + 1e-9).floor();
                    if !(0.0..MAX_NODES - all.len() as f64).contains(&count) {
                        let expected = format!("a range of less than {MAX_NODES} numbers");
                        return Err(InvalidText::new(piece, expected));
                    }
                    all.extend((0..=count as u64).map(|k| start + k as f64 * step));
                }
                _ => return Err(InvalidText::new(piece, "a number or start:step:stop")),
            }
        }
        Self::new(all)
    }
}

/// The numbers with commas.
impl fmt::Display for Nodes {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (at, x) in self.0.iter().enumerate() {
            if at > 0 {
                f.write_str(",")?;
            }
            write!(f, "{x}")?;
        }
        Ok(())
    }
}

/// The JSON of [`Nodes`].
#[derive(Deserialize)]
#[serde(untagged, expecting = "a list of numbers, a number, or a text such as 0:2:90")]
enum NodesJson {
    List(Vec<f64>),
    Number(f64),
    Text(String),
}

impl<'de> Deserialize<'de> for Nodes {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        match NodesJson::deserialize(deserializer)? {
            NodesJson::List(numbers) => Self::new(numbers),
            NodesJson::Number(number) => Self::new(vec![number]),
            NodesJson::Text(text) => text.parse(),
        }
        .map_err(D::Error::custom)
    }
}

/// Wavelengths in nm, each positive.
///
/// Texts and JSON are those of [`Nodes`].
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
#[serde(transparent)]
pub struct Wavelengths(Nodes);

impl Wavelengths {
    /// These wavelengths, nm.
    ///
    /// # Errors
    ///
    /// If one is not finite and positive.
    pub fn new(nm: Nodes) -> Result<Self, InvalidText> {
        match nm.0.iter().find(|nm| **nm <= 0.0) {
            Some(nm) => Err(InvalidText::new(nm.to_string(), "a wavelength in nm above 0")),
            None => Ok(Self(nm)),
        }
    }

    /// The wavelengths, nm.
    pub fn into_vec(self) -> Vec<f64> {
        self.0.into_vec()
    }
}

impl FromStr for Wavelengths {
    type Err = InvalidText;

    fn from_str(text: &str) -> Result<Self, InvalidText> {
        Self::new(text.parse()?)
    }
}

impl fmt::Display for Wavelengths {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}

impl<'de> Deserialize<'de> for Wavelengths {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        Self::new(Nodes::deserialize(deserializer)?).map_err(D::Error::custom)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn nodes(text: &str) -> Vec<f64> {
        text.parse::<Nodes>().unwrap().into_vec()
    }

    #[test]
    fn ranges_reach_their_stop_and_lists_mix_with_them() {
        assert_eq!(nodes("0:30:90"), [0.0, 30.0, 60.0, 90.0]);
        assert_eq!(nodes("1,2:0.1:2.3,7").len(), 6);
        assert_eq!(nodes("360:10:750").len(), 40);
        for wrong in ["", "a", "0:0:1", "0:1", "0:-1:1", "0:1e-9:1", "nan", "1,inf"] {
            assert!(wrong.parse::<Nodes>().is_err(), "{wrong}");
        }
    }

    #[test]
    fn equal_nodes_have_equal_json_whatever_their_text() {
        let json = |text: &str| serde_json::to_string(&text.parse::<Nodes>().unwrap()).unwrap();
        assert_eq!(json("0:10:20"), json("-0.0,1e1, 20.0"));
        let list: Nodes = serde_json::from_str("[0, 10.0, 20]").unwrap();
        assert_eq!(list, serde_json::from_str(r#""0:10:20""#).unwrap());
        assert_eq!(list.to_string().parse(), Ok(list));
    }

    #[test]
    fn wavelengths_are_positive() {
        assert!("400:10:700".parse::<Wavelengths>().is_ok());
        let error = "0:10:700".parse::<Wavelengths>().unwrap_err();
        assert_eq!(error.to_string(), "\"0\": expected a wavelength in nm above 0");
    }
}
