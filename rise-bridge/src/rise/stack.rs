//! Product B in colours: combines renders with three wavelengths each to one picture.
//!
//! Under white light a pixel of the render of λ1, λ2, λ3 is proportional to the radiance at these
//! wavelengths for a flat spectrum. All renders together are the spectrum of the pixel; with the
//! spectrum of an illuminant it becomes XYZ and linear sRGB, as that of a reflectance does.

use mist_engine::request::ColourQuery;
use pictures::image::{Encoding, Image};
use spectra::{ColourPlan, Grid};

use super::product::triples;
use crate::export::ExportError;

/// The picture of `renders` under `illuminant`: a CIE name, a temperature or `D(temperature)`.
///
/// # Errors
///
/// If the renders differ in size or their number is not that of the triples of wavelengths (nm), and for
/// wavelengths or illuminants that give no colours.
pub fn stack(
    renders: &[Image],
    wavelengths: &[f64],
    illuminant: &str,
) -> Result<Image, ExportError> {
    let refused =
        |part: &str, error: &dyn std::fmt::Display| ExportError::refused(part, error.to_string());
    let expected = triples(wavelengths.len()).count();
    let size = renders.first().map_or([0; 2], Image::size);
    if renders.len() != expected || renders.iter().any(|render| render.size() != size) {
        let problem = format!("expected {expected} renders of one size, found {}", renders.len());
        return Err(ExportError::refused("renders", problem));
    }
    let names = ColourQuery::of_factors(illuminant);
    let grid = Grid::new(wavelengths).map_err(|error| refused("wavelengths", &error))?;
    let plan = ColourPlan::new(&grid, names.settings(None)?);
    let plan = plan.map_err(|error| refused("illuminant", &error))?;
    let mut pixels: Vec<_> = renders.iter().map(Image::linear).collect();
    let mut values = Vec::with_capacity(size[0] * size[1] * 3);
    let mut spectrum = vec![0.0; wavelengths.len()];
    for _ in 0..size[0] * size[1] {
        for (render, triple) in pixels.iter_mut().zip(triples(wavelengths.len())) {
            // All renders have the same size.
            let pixel = render.next().unwrap_or_default();
            triple.into_iter().zip(pixel).for_each(|(k, value)| spectrum[k] = value);
        }
        let rgb = plan.rgb(plan.unpolarized(&spectrum));
        values.extend(rgb.map(|x| x as f32));
    }
    Image::new(size, 3, values, Encoding::Linear).map_err(|error| refused("renders", &error))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn grey(value: f32) -> Image {
        Image::new([2, 1], 3, vec![value; 6], Encoding::Linear).unwrap()
    }

    #[test]
    fn a_grey_scene_stays_grey_under_every_illuminant() {
        let nm: Vec<f64> = (40..=70).map(|k| 10.0 * f64::from(k)).collect();
        let renders = vec![grey(0.25); 11];
        for illuminant in ["D65", "A", "E"] {
            let picture = stack(&renders, &nm, illuminant).unwrap();
            // 32-bit numbers.
            assert!(picture.values().iter().all(|x| (x - 0.25).abs() < 1e-6), "{illuminant}");
        }
    }

    #[test]
    fn missing_renders_and_other_sizes_are_refused() {
        let nm = [450.0, 500.0, 550.0, 600.0];
        assert!(stack(&[grey(1.0)], &nm, "D65").is_err());
        let wide = Image::new([1, 1], 3, vec![0.0; 3], Encoding::Linear).unwrap();
        assert!(stack(&[grey(1.0), wide], &nm, "D65").is_err());
        assert!(stack(&[grey(1.0), grey(1.0)], &nm, "no light").is_err());
    }
}
