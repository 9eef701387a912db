//! Grids of directions.

use std::{fmt, str::FromStr};

use serde::{Deserialize, Deserializer, Serialize, Serializer, de::Error as _};

use super::{
    error::{InvalidText, RequestError, number, read},
    nodes::Nodes,
};

/// The nodes of a grid, degrees, rising.
#[derive(Clone, Debug, PartialEq, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub struct GridRequest {
    /// Polar angles of incidence.
    pub thetai: Vec<f64>,
    /// Polar angles of scattering.
    pub thetas: Vec<f64>,
    /// Azimuths: all in 0…180, and the other half is the mirror image, or in −180…180.
    pub phis: Vec<f64>,
    /// The solid angle of a node.
    pub patch: GridPatch,
}

impl GridRequest {
    /// The grid of the texts of its axes; a ring needs no `phis`.
    ///
    /// # Errors
    ///
    /// For missing axes and texts that are not [`Nodes`].
    pub fn of_axes(
        thetai: Option<&str>,
        thetas: Option<&str>,
        phis: Option<&str>,
        patch: GridPatch,
    ) -> Result<Self, RequestError> {
        let axis = |name: &str, text: Option<&str>| match text {
            Some(text) => read::<Nodes>(name, text).map(Nodes::into_vec),
            None if name == "phis" && patch == GridPatch::Ring => Ok(vec![0.0]),
            None => Err(RequestError::new("grid", format!("{name} is missing"))),
        };
        Ok(Self {
            thetai: axis("thetai", thetai)?,
            thetas: axis("thetas", thetas)?,
            phis: axis("phis", phis)?,
            patch,
        })
    }

    /// The grid of `thetai=0:2:90,thetas=0:2:90,phis=0:2:180`.
    ///
    /// # Errors
    ///
    /// For missing and unknown axes and texts that are not [`Nodes`].
    pub fn of_text(text: &str, patch: GridPatch) -> Result<Self, RequestError> {
        let refuse = |problem: String| Err(RequestError::new("grid", problem));
        let mut axes: Vec<(&str, String)> = Vec::new();
        for piece in text.split(',') {
            match (piece.split_once('='), axes.last_mut()) {
                (Some((name, first)), _) => axes.push((name.trim(), first.to_owned())),
                (None, Some((_, nodes))) => *nodes = format!("{nodes},{piece}"),
                (None, None) => return refuse("expected thetai=…,thetas=…,phis=…".into()),
            }
        }
        let known = ["thetai", "thetas", "phis"];
        if let Some((name, _)) = axes.iter().find(|(name, _)| !known.contains(name)) {
            return refuse(format!("{name:?} is none of thetai, thetas, phis"));
        }
        let [thetai, thetas, phis] = known.map(|name| {
            let last = axes.iter().rev().find(|(this, _)| *this == name);
            last.map(|(_, nodes)| nodes.as_str())
        });
        Self::of_axes(thetai, thetas, phis, patch)
    }
}

/// The solid angle of a node of a grid.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum GridPatch {
    /// One direction.
    #[default]
    Point,
    /// A cone with this half-angle, degrees.
    Circle(f64),
    /// The node's Voronoi cell.
    Cell,
    /// The average over all azimuths between the neighbours; `phis` has one node.
    Ring,
}

impl FromStr for GridPatch {
    type Err = InvalidText;

    /// Reads `point`, `circle ALPHA`, `cell` or `ring`; blanks, `:`, `=` and `+` separate.
    fn from_str(text: &str) -> Result<Self, InvalidText> {
        let words: Vec<&str> =
            text.split([' ', ':', '=', '+']).filter(|word| !word.is_empty()).collect();
        match words[..] {
            ["point"] => Ok(Self::Point),
            ["cell"] => Ok(Self::Cell),
            ["ring"] => Ok(Self::Ring),
            ["circle", alpha] => Ok(Self::Circle(number(alpha)? + 0.0)),
            _ => Err(InvalidText::new(text, "point, circle ALPHA, cell or ring")),
        }
    }
}

impl fmt::Display for GridPatch {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Point => f.write_str("point"),
            Self::Circle(alpha) => write!(f, "circle {alpha}"),
            Self::Cell => f.write_str("cell"),
            Self::Ring => f.write_str("ring"),
        }
    }
}

impl Serialize for GridPatch {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}

impl<'de> Deserialize<'de> for GridPatch {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        String::deserialize(deserializer)?.parse().map_err(D::Error::custom)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_grid_has_its_three_axes() {
        let text = "thetai=0:45:90,thetas=10,20,phis=0:90:180";
        let found = GridRequest::of_text(text, GridPatch::Cell).unwrap();
        assert_eq!((found.thetai.len(), found.thetas.len(), found.phis.len()), (3, 2, 3));
        for wrong in ["thetai=0,thetas=0", "thetai=0,thetas=0,phi=0", "0:45:90"] {
            let error = GridRequest::of_text(wrong, GridPatch::Point).unwrap_err();
            assert_eq!(error.key, "grid", "{wrong}");
        }
        let error = GridRequest::of_text("thetai=x,thetas=0,phis=0", GridPatch::Point);
        assert_eq!(error.unwrap_err().key, "thetai");
        assert!(GridRequest::of_text("thetai=0,thetas=0:10:80", GridPatch::Ring).is_ok());
    }

    #[test]
    fn patches_of_nodes_are_read_back() {
        for text in ["point", "circle:2", "circle 2.5", "cell", "ring"] {
            let patch: GridPatch = text.parse().unwrap();
            assert_eq!(patch.to_string().parse(), Ok(patch));
        }
        assert!("ring 1 2".parse::<GridPatch>().is_err());
    }
}
