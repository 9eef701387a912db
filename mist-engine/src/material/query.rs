//! The texts of requests: ranges, patches and names, as command lines and URLs have them.

use mist_format::number::whole_number;
use scattering::Basis;
use spectra::{
    Adaptation, ColourSettings, Extrapolation, Filter, Illuminant, Observer, Quantity, RgbSpace,
    Spectrum,
};

use super::{
    MaterialError,
    table::{GridPatch, GridRequest, Patch, PatchRow},
};
use crate::Files;

/// Nodes of one axis, at most.
const MOST_NODES: f64 = 100_000.0;

/// The numbers of `start:step:stop`, of a list with commas, or of a list of such ranges.
///
/// A range ends at `stop`, or before it where the steps do not meet it.
///
/// # Errors
///
/// Names `part` and what was expected.
pub fn nodes(part: &str, text: &str) -> Result<Vec<f64>, MaterialError> {
    let mut all = Vec::new();
    for piece in text.split(',') {
        let ends: Vec<&str> = piece.split(':').collect();
        match ends[..] {
            [one] => all.push(number(part, one)?),
            [start, step, stop] => {
                let [start, step, stop] =
                    [number(part, start)?, number(part, step)?, number(part, stop)?];
                let count = ((stop - start) / step + 1e-9).floor();
                if !(0.0..MOST_NODES - all.len() as f64).contains(&count) {
                    let problem = format!("{piece}: no range of less than {MOST_NODES} numbers");
                    return Err(MaterialError::request(part, problem));
                }
                all.extend((0..=count as u64).map(|k| start + k as f64 * step));
            }
            _ => {
                let problem = format!("{piece:?}: expected a number or start:step:stop");
                return Err(MaterialError::request(part, problem));
            }
        }
    }
    Ok(all)
}

fn number(part: &str, text: &str) -> Result<f64, MaterialError> {
    whole_number(text.trim()).filter(|x| x.is_finite()).ok_or_else(|| {
        MaterialError::request(part, format!("{:?}: expected a number", text.trim()))
    })
}

/// The grid of `thetai=0:2:90,thetas=0:2:90,phis=0:2:180`, each node with `patch`.
///
/// # Errors
///
/// For missing and unknown axes, and as [`nodes`].
pub fn grid(text: &str, patch: GridPatch) -> Result<GridRequest, MaterialError> {
    let mut axes: Vec<(String, String)> = Vec::new();
    for piece in text.split(',') {
        match (piece.split_once('='), axes.last_mut()) {
            (Some((name, first)), _) => axes.push((name.trim().to_owned(), first.to_owned())),
            (None, Some((_, nodes))) => *nodes = format!("{nodes},{piece}"),
            (None, None) => return Err(MaterialError::request("grid", "expected thetai=…")),
        }
    }
    let known = ["thetai", "thetas", "phis"];
    if let Some((name, _)) = axes.iter().find(|(name, _)| !known.contains(&name.as_str())) {
        let problem = format!("{name:?} is none of thetai, thetas, phis");
        return Err(MaterialError::request("grid", problem));
    }
    let axis = |name: &str| match axes.iter().rev().find(|(this, _)| this == name) {
        Some((_, text)) => nodes(name, text),
        None if name == "phis" && patch == GridPatch::Ring => Ok(vec![0.0]),
        None => Err(MaterialError::request("grid", format!("{name} is missing"))),
    };
    Ok(GridRequest { thetai: axis("thetai")?, thetas: axis("thetas")?, phis: axis("phis")?, patch })
}

/// `point`, `circle ALPHA`, `cell` or `ring`; blank, `:` and `=` separate.
///
/// # Errors
///
/// For every other text.
pub fn grid_patch(text: &str) -> Result<GridPatch, MaterialError> {
    let words: Vec<&str> =
        text.split([' ', ':', '=', '+']).filter(|word| !word.is_empty()).collect();
    match words[..] {
        ["point"] => Ok(GridPatch::Point),
        ["cell"] => Ok(GridPatch::Cell),
        ["ring"] => Ok(GridPatch::Ring),
        ["circle", alpha] => Ok(GridPatch::Circle(number("patch", alpha)?)),
        _ => {
            let problem = format!("{text:?} is none of point, circle ALPHA, cell, ring");
            Err(MaterialError::request("patch", problem))
        }
    }
}

/// The rows of a patches file, in degrees: `thetai thetas phis` followed by `point`, `circle 2`,
/// `ring 10 12` or `polygon t p t p …`.
///
/// A fourth number alone is the half-angle of a circle; a first line of names is skipped, and so
/// is what follows `;` or `#`.
///
/// # Errors
///
/// Names the line and what was expected.
pub fn patches(text: &str) -> Result<Vec<PatchRow>, MaterialError> {
    let mut places = Vec::new();
    for (at, line) in text.lines().enumerate() {
        let line = line.split([';', '#']).next().unwrap_or_default();
        let words: Vec<&str> = line.split_whitespace().collect();
        if words.is_empty() || (places.is_empty() && words[0] == "thetai") {
            continue;
        }
        places.push(place(&format!("patches, line {}", at + 1), &words)?);
    }
    Ok(places)
}

fn place(part: &str, words: &[&str]) -> Result<PatchRow, MaterialError> {
    let wrong = || {
        let problem = "expected thetai thetas phis and point, circle ALPHA, ring INNER OUTER or \
                       polygon THETA PHI …";
        MaterialError::request(part, problem)
    };
    let numbers = |words: &[&str]| -> Result<Vec<f64>, MaterialError> {
        words.iter().map(|word| number(part, word)).collect()
    };
    let (angles, rest) = words.split_at_checked(3).ok_or_else(wrong)?;
    let angles = numbers(angles)?;
    let patch = match rest {
        [] | ["point"] => Patch::Point,
        ["circle", alpha] => Patch::Circle(number(part, alpha)?),
        ["ring", inner, outer] => Patch::Ring(number(part, inner)?, number(part, outer)?),
        ["polygon", corners @ ..] if corners.len() >= 6 && corners.len().is_multiple_of(2) => {
            Patch::Polygon(numbers(corners)?.chunks(2).map(|c| (c[0], c[1])).collect())
        }
        [alpha] => Patch::Circle(number(part, alpha)?),
        _ => return Err(wrong()),
    };
    Ok(PatchRow { thetai: angles[0], thetas: angles[1], phis: angles[2], patch })
}

/// A Stokes vector, `1,0,0,0`.
///
/// # Errors
///
/// For anything but four numbers.
pub fn stokes(text: &str) -> Result<[f64; 4], MaterialError> {
    let numbers: Result<Vec<f64>, _> =
        text.split(',').map(|word| number("incident", word)).collect();
    numbers?.try_into().map_err(|_| MaterialError::request("incident", "expected four numbers"))
}

/// A polarization basis.
///
/// # Errors
///
/// For names other than psps, xyxy and plane.
pub fn basis(text: &str) -> Result<Basis, MaterialError> {
    let problem = format!("{text:?} is none of psps, xyxy and plane");
    Basis::from_name(text).ok_or_else(|| MaterialError::request("basis", problem))
}

/// How spectra become colours, by names; what is not named is as in the section COLOR.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ColourNames {
    /// A CIE name, a temperature, `D(temperature)` or a file; D65.
    pub illuminant: Option<String>,
    /// CIE1931_2.
    pub observer: Option<String>,
    /// sRGB.
    pub space: Option<String>,
    /// Bradford.
    pub adaptation: Option<String>,
    /// brdf.
    pub quantity: Option<String>,
    /// None.
    pub filters: Vec<String>,
}

impl ColourNames {
    /// Of reflectance and radiance factors: a grey one of 1 is white under the `illuminant`.
    pub fn of_factors(illuminant: &str) -> Self {
        Self {
            illuminant: Some(illuminant.to_owned()),
            quantity: Some("factor".to_owned()),
            ..Self::default()
        }
    }

    /// The settings; an illuminant that is no name is looked for in `files`.
    ///
    /// # Errors
    ///
    /// For names that are not known.
    pub fn settings(&self, files: Option<&dyn Files>) -> Result<ColourSettings, MaterialError> {
        fn read<T, E: std::fmt::Display>(
            part: &str,
            text: Option<&String>,
            default: &str,
            parse: impl Fn(&str) -> Result<T, E>,
        ) -> Result<T, MaterialError> {
            parse(text.map_or(default, String::as_str))
                .map_err(|error| MaterialError::request(part, error))
        }
        let filters = self.filters.iter();
        Ok(ColourSettings {
            quantity: read("quantity", self.quantity.as_ref(), "brdf", Quantity::parse)?,
            illuminant: read("illuminant", self.illuminant.as_ref(), "D65", |text| {
                illuminant(text, files)
            })?,
            observer: read("observer", self.observer.as_ref(), "CIE1931_2", Observer::parse)?,
            space: read("space", self.space.as_ref(), "sRGB", RgbSpace::parse)?,
            adaptation: read(
                "adaptation",
                self.adaptation.as_ref(),
                "Bradford",
                Adaptation::parse,
            )?,
            filters: filters
                .map(|text| {
                    Filter::parse(text).map_err(|error| MaterialError::request("filter", error))
                })
                .collect::<Result<_, _>>()?,
            outside: Extrapolation::Hold,
        })
    }
}

fn illuminant(text: &str, files: Option<&dyn Files>) -> Result<Illuminant, String> {
    let error = match Illuminant::parse(text) {
        Ok(illuminant) => return Ok(illuminant),
        Err(error) => error.to_string(),
    };
    let Some(file) = files.and_then(|files| files.read(text).ok()) else { return Err(error) };
    let (spectrum, _) = Spectrum::parse(&file).map_err(|error| error.to_string())?;
    spectrum.illuminant(text).map_err(|error| error.to_string())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges_reach_their_stop_and_lists_mix_with_them() {
        assert_eq!(nodes("x", "0:30:90").unwrap(), [0.0, 30.0, 60.0, 90.0]);
        assert_eq!(nodes("x", "1,2:0.1:2.3,7").unwrap().len(), 6);
        assert_eq!(nodes("lambda", "360:10:750").unwrap().len(), 40);
        for wrong in ["", "a", "0:0:1", "0:1", "0:-1:1", "0:1e-9:1"] {
            assert_eq!(nodes("x", wrong).unwrap_err().part(), Some("x"), "{wrong}");
        }
    }

    #[test]
    fn a_grid_has_its_three_axes() {
        let found = grid("thetai=0:45:90,thetas=10,20,phis=0:90:180", GridPatch::Cell).unwrap();
        assert_eq!((found.thetai.len(), found.thetas.len(), found.phis.len()), (3, 2, 3));
        assert!(grid("thetai=0,thetas=0", GridPatch::Point).is_err());
        assert!(grid("thetai=0,thetas=0,phi=0", GridPatch::Point).is_err());
        assert_eq!(grid_patch("circle:2").unwrap(), GridPatch::Circle(2.0));
    }

    #[test]
    fn patches_are_read_in_both_forms() {
        let text = "thetai thetas phis alpha\n45 45 0 2\n45 60 0 ring 10 12 ; far\n\n1 2 3\n\
                    30 0 0 polygon 0 0 10 0 10 90\n";
        let found = patches(text).unwrap();
        assert_eq!(found.len(), 4);
        assert_eq!(found[0].patch, Patch::Circle(2.0));
        assert_eq!(found[1].patch, Patch::Ring(10.0, 12.0));
        assert_eq!(found[2].patch, Patch::Point);
        let wrong = patches("45 45 0 square 2").unwrap_err();
        assert_eq!(wrong.part(), Some("patches, line 1"));
    }
}
