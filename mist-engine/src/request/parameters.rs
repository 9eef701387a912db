//! Parameters in JSON: an object, or a list of pairs; values are texts or numbers.

use std::fmt;

use mist_format::number::general;
use serde::{
    Deserialize, Deserializer, Serialize, Serializer,
    de::{MapAccess, SeqAccess, Visitor},
};

/// Digits of a number that is sent to a model, as in programs.
const DIGITS: usize = 16;

/// A text, or a number that is written as one.
struct ParameterText(String);

impl<'de> Deserialize<'de> for ParameterText {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        #[derive(Deserialize)]
        #[serde(untagged, expecting = "a text or a number")]
        enum Either {
            ParameterText(String),
            Number(f64),
        }
        Ok(Self(match Either::deserialize(deserializer)? {
            Either::ParameterText(text) => text,
            Either::Number(number) => general(number, DIGITS),
        }))
    }
}

pub(super) fn serialize<S: Serializer>(
    parameters: &[(String, String)],
    serializer: S,
) -> Result<S::Ok, S::Error> {
    parameters.serialize(serializer)
}

pub(super) fn deserialize<'de, D: Deserializer<'de>>(
    deserializer: D,
) -> Result<Vec<(String, String)>, D::Error> {
    deserializer.deserialize_any(ParametersVisitor)
}

struct ParametersVisitor;

impl<'de> Visitor<'de> for ParametersVisitor {
    type Value = Vec<(String, String)>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("an object of parameters, or a list of [name, text]")
    }

    /// The order of an object means nothing, so parents come before their sub-parameters.
    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Self::Value, A::Error> {
        let mut found = Vec::new();
        while let Some((name, ParameterText(text))) = map.next_entry::<String, ParameterText>()? {
            found.push((name, text));
        }
        found.sort_by_key(|(name, _)| name.matches('.').count());
        Ok(found)
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<Self::Value, A::Error> {
        let mut found = Vec::new();
        while let Some((name, ParameterText(text))) =
            list.next_element::<(String, ParameterText)>()?
        {
            found.push((name, text));
        }
        Ok(found)
    }
}
