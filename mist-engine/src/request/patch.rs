//! Solid angles around a direction, and lists of them.

use std::{fmt, str::FromStr};

use serde::{Deserialize, Deserializer, Serialize, Serializer, de::Error as _};

use super::error::{InvalidText, number};
use crate::region::{PolarAngles, Region};

/// A solid angle around a direction, degrees.
#[derive(Clone, Debug, PartialEq)]
pub enum Patch {
    /// One direction.
    Point,
    /// A cone with this half-angle.
    Circle(f64),
    /// The directions between two cones with these half-angles.
    Ring(f64, f64),
    /// A polygon of (thetas, phis), with straight edges in the projection.
    Polygon(Vec<(f64, f64)>),
}

impl Patch {
    /// The region around `center` (radians), as the integrals of programs have it.
    pub fn region(&self, center: PolarAngles) -> Region {
        match self {
            Self::Point => Region::Differential { center },
            Self::Circle(alpha) => Region::around(center, alpha.to_radians()),
            Self::Ring(inner, outer) => Region::Annulus {
                outer_center: center,
                outer_alpha: outer.to_radians(),
                inner_center: center,
                inner_alpha: inner.to_radians(),
            },
            Self::Polygon(corners) => Region::Polygon {
                vertices: corners.iter().map(|(t, p)| (t.to_radians(), p.to_radians())).collect(),
                polarization_center: center,
            },
        }
    }

    /// Reads `point`, `circle A`, `ring A B`, `polygon T P T P T P …`, or `A` alone, a circle.
    fn read(words: &[&str]) -> Result<Self, InvalidText> {
        let numbers = |words: &[&str]| -> Result<Vec<f64>, InvalidText> {
            words.iter().map(|word| number(word)).collect()
        };
        match words {
            [] | ["point"] => Ok(Self::Point),
            ["circle", alpha] => Ok(Self::Circle(number(alpha)?)),
            ["ring", inner, outer] => Ok(Self::Ring(number(inner)?, number(outer)?)),
            ["polygon", corners @ ..] if corners.len() >= 6 && corners.len().is_multiple_of(2) => {
                let pairs = numbers(corners)?.chunks(2).map(|c| (c[0], c[1])).collect();
                Ok(Self::Polygon(pairs))
            }
            [alpha] => Ok(Self::Circle(number(alpha)?)),
            _ => Err(InvalidText::new(words.join(" "), EXPECTED)),
        }
    }
}

const EXPECTED: &str =
    "thetai thetas phis and point, circle ALPHA, ring INNER OUTER or polygon THETA PHI …";

impl fmt::Display for Patch {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Point => f.write_str("point"),
            Self::Circle(alpha) => write!(f, "circle {alpha}"),
            Self::Ring(inner, outer) => write!(f, "ring {inner} {outer}"),
            Self::Polygon(corners) => {
                f.write_str("polygon")?;
                corners.iter().try_for_each(|(theta, phi)| write!(f, " {theta} {phi}"))
            }
        }
    }
}

/// A row of a list of solid angles, degrees: `thetai thetas phis` and a [`Patch`].
///
/// In JSON an object with `thetai`, `thetas`, `phis` and at most one of `circle` (a half-angle),
/// `ring` (two half-angles) and `polygon` (a list of corners).
#[derive(Clone, Debug, PartialEq)]
pub struct PatchRow {
    /// Polar angle of incidence.
    pub thetai: f64,
    /// Polar angle of scattering.
    pub thetas: f64,
    /// Azimuth of scattering; 0 is the specular side.
    pub phis: f64,
    /// The solid angle around it.
    pub patch: Patch,
}

impl FromStr for PatchRow {
    type Err = InvalidText;

    fn from_str(text: &str) -> Result<Self, InvalidText> {
        let words: Vec<&str> = text.split_whitespace().collect();
        let [thetai, thetas, phis, patch @ ..] = &words[..] else {
            return Err(InvalidText::new(text.trim(), EXPECTED));
        };
        Ok(Self {
            thetai: number(thetai)? + 0.0,
            thetas: number(thetas)? + 0.0,
            phis: number(phis)? + 0.0,
            patch: Patch::read(patch)?,
        })
    }
}

impl fmt::Display for PatchRow {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { thetai, thetas, phis, patch } = self;
        write!(f, "{thetai} {thetas} {phis} {patch}")
    }
}

/// The JSON of a [`PatchRow`].
#[derive(Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
struct PatchRowJson {
    thetai: f64,
    thetas: f64,
    phis: f64,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    circle: Option<f64>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    ring: Option<(f64, f64)>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    polygon: Option<Vec<(f64, f64)>>,
}

impl Serialize for PatchRow {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let Self { thetai, thetas, phis, patch } = self;
        let (thetai, thetas, phis) = (*thetai, *thetas, *phis);
        let (mut circle, mut ring, mut polygon) = (None, None, None);
        match patch {
            Patch::Point => {}
            Patch::Circle(alpha) => circle = Some(*alpha),
            Patch::Ring(inner, outer) => ring = Some((*inner, *outer)),
            Patch::Polygon(corners) => polygon = Some(corners.clone()),
        }
        PatchRowJson { thetai, thetas, phis, circle, ring, polygon }.serialize(serializer)
    }
}

impl<'de> Deserialize<'de> for PatchRow {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let read = PatchRowJson::deserialize(deserializer)?;
        let PatchRowJson { thetai, thetas, phis, circle, ring, polygon } = read;
        let patch = match (circle, ring, polygon) {
            (None, None, None) => Patch::Point,
            (Some(alpha), None, None) => Patch::Circle(alpha),
            (None, Some((inner, outer)), None) => Patch::Ring(inner, outer),
            (None, None, Some(corners)) if corners.len() >= 3 => Patch::Polygon(corners),
            (None, None, Some(_)) => {
                return Err(D::Error::custom("expected three corners or more in polygon"));
            }
            _ => {
                let expected = "expected one of circle, ring and polygon, or none for a point";
                return Err(D::Error::custom(expected));
            }
        };
        Ok(Self { thetai: thetai + 0.0, thetas: thetas + 0.0, phis: phis + 0.0, patch })
    }
}

/// Solid angles in the order of a table.
///
/// The text has one [`PatchRow`] per line; a first line of names is skipped, and so is what follows
/// `;` or `#`.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
#[serde(transparent)]
pub struct PatchList(pub Vec<PatchRow>);

impl PatchList {
    /// Reads rows that `;` separates, as they stand in a URL.
    ///
    /// # Errors
    ///
    /// As for a text with one row per line.
    pub fn inline(text: &str) -> Result<Self, InvalidText> {
        text.replace(';', "\n").parse()
    }
}

impl FromStr for PatchList {
    type Err = InvalidText;

    fn from_str(text: &str) -> Result<Self, InvalidText> {
        let mut rows = Vec::new();
        for (at, line) in text.lines().enumerate() {
            let line = line.split([';', '#']).next().unwrap_or_default().trim();
            if line.is_empty() || (rows.is_empty() && line.starts_with("thetai")) {
                continue;
            }
            rows.push(line.parse().map_err(|error: InvalidText| InvalidText {
                text: format!("line {}: {}", at + 1, error.text),
                ..error
            })?);
        }
        Ok(Self(rows))
    }
}

impl<'de> Deserialize<'de> for PatchList {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        // Not by an untagged enum: its errors do not tell the cause.
        match serde_json::Value::deserialize(deserializer)? {
            serde_json::Value::String(text) => text.parse().map_err(D::Error::custom),
            rows => serde_json::from_value(rows).map(Self).map_err(D::Error::custom),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "thetai thetas phis alpha\n45 45 0 2\n45 60 0 ring 10 12 ; far\n\n1 2 3\n\
                        30 0 0 polygon 0 0 10 0 10 90\n";

    #[test]
    fn rows_are_read_in_both_forms() {
        let PatchList(found) = TEXT.parse().unwrap();
        assert_eq!(found.len(), 4);
        assert_eq!(found[0].patch, Patch::Circle(2.0));
        assert_eq!(found[1].patch, Patch::Ring(10.0, 12.0));
        assert_eq!(found[2].patch, Patch::Point);
        let wrong = "45 45 0 square 2".parse::<PatchList>().unwrap_err();
        assert!(wrong.text.starts_with("line 1: "), "{wrong}");
        assert_eq!(PatchList::inline("1 2 3;4 5 6 7").unwrap().0.len(), 2);
    }

    #[test]
    fn texts_and_json_are_read_back() {
        let list: PatchList = TEXT.parse().unwrap();
        let lines: Vec<String> = list.0.iter().map(PatchRow::to_string).collect();
        assert_eq!(lines.join("\n").parse(), Ok(list.clone()));
        let json = serde_json::to_string(&list).unwrap();
        assert_eq!(serde_json::from_str::<PatchList>(&json).unwrap(), list);
        let two = r#"[{"thetai":1,"thetas":2,"phis":3,"circle":1,"ring":[1,2]}]"#;
        let error = serde_json::from_str::<PatchList>(two).unwrap_err();
        assert!(error.to_string().contains("one of circle, ring and polygon"), "{error}");
    }

    #[test]
    fn a_patch_is_the_region_of_the_language() {
        let center = (0.5, 0.1);
        assert_eq!(Patch::Point.region(center), Region::Differential { center });
        assert_eq!(Patch::Circle(90.0).region((0.0, 0.0)), Region::Hemi);
    }
}
