//! Incident light.

use std::{fmt, str::FromStr};

use serde::{Deserialize, Deserializer, Serialize, de::Error as _};

use super::{error::InvalidText, nodes::Nodes};

/// A Stokes vector I, Q, U, V of the incident light; the text is `1,0,0,0`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(transparent)]
pub struct IncidentLight(pub [f64; 4]);

/// Unpolarized light.
impl Default for IncidentLight {
    fn default() -> Self {
        Self([1.0, 0.0, 0.0, 0.0])
    }
}

impl TryFrom<Nodes> for IncidentLight {
    type Error = InvalidText;

    fn try_from(nodes: Nodes) -> Result<Self, InvalidText> {
        let text = nodes.to_string();
        let numbers = nodes.into_vec().try_into();
        numbers.map(Self).map_err(|_| InvalidText::new(text, "four numbers I,Q,U,V"))
    }
}

impl FromStr for IncidentLight {
    type Err = InvalidText;

    fn from_str(text: &str) -> Result<Self, InvalidText> {
        Self::try_from(text.parse::<Nodes>()?)
    }
}

impl fmt::Display for IncidentLight {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [i, q, u, v] = self.0;
        write!(f, "{i},{q},{u},{v}")
    }
}

impl<'de> Deserialize<'de> for IncidentLight {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        Self::try_from(Nodes::deserialize(deserializer)?).map_err(D::Error::custom)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_stokes_vector_has_four_numbers() {
        assert_eq!("1, 0.5,0,-0".parse(), Ok(IncidentLight([1.0, 0.5, 0.0, 0.0])));
        assert!("1,0,0".parse::<IncidentLight>().is_err());
        let light: IncidentLight = serde_json::from_str("[1, 0, 0, 1]").unwrap();
        assert_eq!(light.to_string(), "1,0,0,1");
    }
}
