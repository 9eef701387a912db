//! Range checks of parameter values before a class is built.

use num_complex::Complex64;

use super::{ParameterError, ParameterNode, ParameterValue};
use crate::optics::{RealFunction, RefractiveIndex};

/// Largest magnitude of a number in every unit of parameters; powers of larger numbers overflow.
const LARGEST: f64 = 1e30;
/// Largest n and k; no material from X-rays to microwaves exceeds it.
const LARGEST_INDEX: f64 = 1e6;
/// Smallest n or k other than 0.
const LEAST_INDEX: f64 = 1e-6;
/// Accepted wavelengths, µm: gamma rays to the longest radio waves.
const WAVELENGTHS: std::ops::RangeInclusive<f64> = 1e-9..=1e12;

/// Checks every number in `node` and below it; `lambda` is the vacuum wavelength in µm.
///
/// # Errors
///
/// For the first number that is not finite or too large, and for an index of refraction that is 0
/// or has a negative part.
pub(crate) fn check(node: &ParameterNode, lambda: f64) -> Result<(), ParameterError> {
    for (param, value) in node.class.parameters().zip(&node.values) {
        let wrong = |problem: String| ParameterError::new(param.name, problem);
        match value {
            ParameterValue::Number(x) if param.name == "lambda" => wavelength(*x).map_err(wrong)?,
            ParameterValue::Number(x) => number(*x).map_err(wrong)?,
            ParameterValue::Table(table) => points(table).map_err(wrong)?,
            ParameterValue::Index(n) => index(n, lambda).map_err(wrong)?,
            ParameterValue::Films(films) => {
                for film in films {
                    index(&film.index, lambda).map_err(wrong)?;
                    number(film.thickness).map_err(wrong)?;
                }
            }
            ParameterValue::Member(inner) => {
                check(inner, lambda).map_err(|error| error.inside(param.name))?;
            }
            ParameterValue::Integer(_) | ParameterValue::Text(_) | ParameterValue::Formula(_) => {}
        }
    }
    Ok(())
}

fn number(x: f64) -> Result<(), String> {
    if x.abs() <= LARGEST {
        return Ok(());
    }
    Err(format!("{x} is out of range: numbers go from -{LARGEST:e} to {LARGEST:e}"))
}

fn wavelength(x: f64) -> Result<(), String> {
    if WAVELENGTHS.contains(&x) { Ok(()) } else { Err(format!("{x} um is not a wavelength")) }
}

fn points(table: &RealFunction) -> Result<(), String> {
    table.ordinates().try_for_each(number)?;
    if table.can_interpolate() {
        return Ok(());
    }
    Err("between its points the table has no numbers: abscissae have to be finite, and positive \
         on a logarithmic axis, as values have to be if they go by their logarithm"
        .into())
}

fn index(index: &RefractiveIndex, lambda: f64) -> Result<(), String> {
    let Complex64 { re: n, im: k } = index.at(lambda);
    if n.is_finite() && n >= 0.0 && k < 0.0 {
        return Err(format!(
            "k = {k} at {lambda} um: n + ik with k > 0 absorbs, write ({n},{})",
            -k
        ));
    }
    let fits = |x: f64| x == 0.0 || (LEAST_INDEX..=LARGEST_INDEX).contains(&x);
    if fits(n) && (k < LEAST_INDEX || fits(k)) && n.max(k) >= LEAST_INDEX {
        return Ok(());
    }
    Err(format!(
        "({n},{k}) at {lambda} um is not a refractive index: n and k go from {LEAST_INDEX:e} to \
         {LARGEST_INDEX:e}, and one of them may be 0"
    ))
}
