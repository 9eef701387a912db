//! The text form of names and filters: `FromStr` and `Display`, and serde as text.

use std::{fmt, str::FromStr};

use serde::{Deserialize, Deserializer, Serialize, Serializer};

use crate::{
    Adaptation, Filter, FilterError, Illuminant, IlluminantError, Observer, Quantity, RgbSpace,
    SpaceError, UnknownName,
};

/// Implements `FromStr` by `parse`, `Display` by `name` where asked, and serde by both.
macro_rules! as_text {
    ($($type:ty, $error:ty;)*) => {$(
        impl FromStr for $type {
            type Err = $error;

            fn from_str(text: &str) -> Result<Self, $error> {
                Self::parse(text)
            }
        }

        impl Serialize for $type {
            fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
                serializer.collect_str(self)
            }
        }

        impl<'de> Deserialize<'de> for $type {
            fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                let text = String::deserialize(deserializer)?;
                Self::parse(&text).map_err(serde::de::Error::custom)
            }
        }
    )*};
}

as_text! {
    Quantity, UnknownName;
    Observer, UnknownName;
    Adaptation, UnknownName;
    RgbSpace, SpaceError;
    Illuminant, IlluminantError;
    Filter, FilterError;
}

impl fmt::Display for Quantity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl fmt::Display for Observer {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl fmt::Display for Adaptation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl fmt::Display for RgbSpace {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl fmt::Display for Illuminant {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// The form that [`Filter::parse`] reads, with every argument: `linear(0.5,1,0)`.
impl fmt::Display for Filter {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        // The sum has no sign at zero.
        match *self {
            Self::Linear { angle, k1, k2 } => {
                write!(f, "linear({},{},{})", angle + 0.0, k1 + 0.0, k2 + 0.0)
            }
            Self::Retarder { fast_axis, retardance_nm } => {
                write!(f, "retarder({},{})", fast_axis + 0.0, retardance_nm + 0.0)
            }
            Self::Circular { left } => write!(f, "circular({})", if left { 1 } else { -1 }),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_are_read_back() {
        for text in ["linear(0.5)", "linear(0.5,0.9,0.01)", "retarder(-0.1,560)", "circular(-1)"] {
            let filter: Filter = text.parse().unwrap();
            assert_eq!(filter.to_string().parse(), Ok(filter));
        }
        for text in ["D65", "2856", "D(5500)", "f2"] {
            let light: Illuminant = text.parse().unwrap();
            assert_eq!(light.to_string().parse(), Ok(light));
        }
        for text in ["sRGB", "rec709", "primaries(0.64,0.33,0.3,0.6,0.15,0.06,0.3127,0.329)"] {
            let space: RgbSpace = text.parse().unwrap();
            assert_eq!(space.to_string().parse(), Ok(space));
        }
    }

    #[test]
    fn equal_filters_have_equal_texts() {
        let texts = ["linear(0)", "linear(-0.0, 1.0)", "linear(0.0,1,0)"];
        let texts = texts.map(|text| Filter::parse(text).map(|filter| filter.to_string()));
        assert_eq!(texts[0].as_deref(), Ok("linear(0,1,0)"));
        assert_eq!(texts[0], texts[2]);
        assert!(texts[1].is_err(), "a polarizer has one argument or three");
    }
}
