//! The blocks of a description file that line and crossed gratings share.

use std::collections::BTreeMap;

use num_complex::Complex64;

use super::expression::{Constants, evaluate, tuple};
use crate::{grating::GratingMaterial, spec::ParameterError};

/// Names that a description may use without defining them.
pub(crate) struct DescriptionContext {
    /// Period, µm.
    pub(crate) period: f64,
    /// Vacuum wavelength, µm.
    pub(crate) lambda: f64,
    /// Index above.
    pub(crate) above: Complex64,
    /// Index below.
    pub(crate) below: Complex64,
}

/// A parsed description with the values of its parameters and materials.
pub(crate) struct GratingDescription {
    blocks: BTreeMap<String, Vec<String>>,
    scope: Constants,
    materials: BTreeMap<String, GratingMaterial>,
}

impl GratingDescription {
    /// Reads the description `text` with `values` = "(v1,v2,…)" for its parameters.
    pub(crate) fn read(
        text: &str,
        values: &str,
        around: &DescriptionContext,
    ) -> Result<Self, ParameterError> {
        let at_file = |problem: String| ParameterError::new("filename", problem);
        let blocks = blocks(text).map_err(at_file)?;
        let mut scope: Constants = [
            ("period", around.period),
            ("lambda", around.lambda),
            ("mediumin", around.above.re),
            ("mediumik", around.above.im),
            ("mediumtn", around.below.re),
            ("mediumtk", around.below.im),
        ]
        .into_iter()
        .map(|(name, value)| (name.to_owned(), value))
        .collect();
        let names = blocks.get("PARAMETERS").map_or(&[][..], Vec::as_slice);
        let values = tuple(values, &Constants::new())
            .map_err(|problem| ParameterError::new("pstring", problem))?;
        if names.len() != values.len() {
            let problem = format!("{} values for {} parameters", values.len(), names.len());
            return Err(ParameterError::new("pstring", problem));
        }
        scope.extend(names.iter().cloned().zip(values));
        for line in blocks.get("WORKING").into_iter().flatten() {
            let (name, text) = split(line).map_err(at_file)?;
            let value = evaluate(text, &scope).map_err(at_file)?;
            scope.insert(name.to_owned(), value);
        }
        let mut materials = BTreeMap::from([
            ("medium_i".to_owned(), GratingMaterial::from_index(around.above)),
            ("medium_t".to_owned(), GratingMaterial::from_index(around.below)),
        ]);
        for line in blocks.get("MATERIALS").into_iter().flatten() {
            let (name, material) = material(line, &scope).map_err(at_file)?;
            materials.insert(name, material);
        }
        Ok(Self { blocks, scope, materials })
    }

    /// The lines of a block, none if it is missing.
    pub(crate) fn lines(&self, block: &str) -> impl Iterator<Item = String> + use<> {
        self.blocks.get(block).cloned().unwrap_or_default().into_iter()
    }

    /// The material called `name`.
    pub(crate) fn material(&self, name: &str) -> Result<GratingMaterial, String> {
        self.materials.get(name).copied().ok_or_else(|| format!("no material {name}"))
    }

    /// The vertices with N coordinates.
    pub(crate) fn vertices<const N: usize>(&self) -> Result<BTreeMap<String, [f64; N]>, String> {
        self.lines("VERTICES")
            .map(|line| {
                let (name, text) = split(&line)?;
                let point = tuple(text, &self.scope)?;
                let count = point.len();
                let point: [f64; N] = point
                    .try_into()
                    .map_err(|_| format!("vertex {name} has {count} coordinates, not {N}"))?;
                if point.iter().all(|x| x.is_finite()) {
                    Ok((name.to_owned(), point))
                } else {
                    Err(format!("vertex {name} is not finite"))
                }
            })
            .collect()
    }
}

/// The lines between each block's name and END, without comments and blank lines.
fn blocks(text: &str) -> Result<BTreeMap<String, Vec<String>>, String> {
    let mut blocks = BTreeMap::new();
    let mut open: Option<(String, Vec<String>)> = None;
    for line in text.lines() {
        let line = line.split(';').next().unwrap_or_default().trim();
        if line.is_empty() {
            continue;
        }
        open = match open {
            None => Some((line.to_owned(), Vec::new())),
            Some((name, lines)) if line == "END" => {
                blocks.insert(name, lines);
                None
            }
            Some((name, mut lines)) => {
                lines.push(line.to_owned());
                Some((name, lines))
            }
        };
    }
    match open {
        None => Ok(blocks),
        Some((name, _)) => Err(format!("block {name} has no END")),
    }
}

/// The first word of a line and the rest.
fn split(line: &str) -> Result<(&str, &str), String> {
    line.split_once(char::is_whitespace)
        .map(|(name, rest)| (name, rest.trim()))
        .ok_or_else(|| format!("{line:?} is a name without a value"))
}

fn material(line: &str, scope: &Constants) -> Result<(String, GratingMaterial), String> {
    let (first, rest) = split(line)?;
    let expected = match first {
        "ANISO" => 3,
        "MAGNETIC" => 2,
        "ANISOMAGNETIC" => 6,
        name => return Ok((name.to_owned(), GratingMaterial::from_index(index(rest, scope)?))),
    };
    let (name, texts) = split(rest)?;
    let squares = texts
        .split_whitespace()
        .map(|text| index(text, scope).map(|n| n * n))
        .collect::<Result<Vec<_>, _>>()?;
    if squares.len() != expected {
        return Err(format!("{first} {name} needs {expected} indices without blanks in them"));
    }
    let one = Complex64::ONE;
    let (epsilon, mu) = match squares[..] {
        [x, y, z] => ([x, y, z], [one; 3]),
        [epsilon, mu] => ([epsilon; 3], [mu; 3]),
        [a, b, c, d, e, f] => ([a, b, c], [d, e, f]),
        _ => return Err(format!("{first} {name} needs {expected} indices")),
    };
    Ok((name.to_owned(), GratingMaterial { epsilon, mu }))
}

/// An index of refraction: an expression, or (n, k) of two.
fn index(text: &str, scope: &Constants) -> Result<Complex64, String> {
    match tuple(text, scope)?[..] {
        [n] => Ok(Complex64::new(n, 0.0)),
        [n, k] => Ok(Complex64::new(n, k)),
        _ => Err(format!("{text:?} is not an index n or (n,k)")),
    }
}
