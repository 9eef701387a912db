//! Spectral EXR with Stokes channels, in the layout of A. Fichet, R. Pacanowski and A. Wilkie, *An
//! OpenEXR Layout for Spectral Images*, JCGT 10(3), 2021.
//!
//! A channel per wavelength and Stokes component: `S0.450,000000nm`, … with a comma for the decimal
//! point, and the attributes `spectralLayoutVersion`, `emissiveUnits` and `polarisationHandedness`.
//! Values are radiance factors of a lamp with a flat spectrum.

use exr::prelude::{
    AnyChannel, AnyChannels, AttributeValue, Encoding as Packing, FlatSamples, Image as File,
    Layer, LayerAttributes, SmallVec, Text, WritableImage,
};
use pictures::image::ImageError;

use crate::film::RenderedFilm;

/// The bytes of a file with the spectra of `film` at `wavelengths` (nm).
///
/// # Errors
///
/// For a film without spectra.
pub fn spectral_exr(film: &RenderedFilm, wavelengths: &[f64]) -> Result<Vec<u8>, ImageError> {
    let malformed = |problem: String| ImageError::Malformed { format: "EXR", problem };
    let bands = wavelengths.len();
    let [width, height] = film.size;
    if film.spectra.is_empty() || film.spectra.len() != width * height * 4 * bands {
        return Err(malformed("the film has no spectra at these wavelengths".into()));
    }
    let channel = |number: usize| {
        let nm = format!("{:.6}", wavelengths[number % bands]).replace('.', ",");
        let samples = film.spectra.iter().skip(number).step_by(4 * bands).copied().collect();
        let name = format!("S{}.{nm}nm", number / bands);
        AnyChannel::new(name.as_str(), FlatSamples::F32(samples))
    };
    let channels: SmallVec<_> = (0..4 * bands).map(channel).collect();
    let mut attributes = LayerAttributes::default();
    // Left circular light has V > 0 here.
    let texts = [
        ("spectralLayoutVersion", "1.0"),
        ("emissiveUnits", "W.m^-2.sr^-1"),
        ("polarisationHandedness", "left"),
    ];
    for (name, value) in texts {
        attributes.other.insert(Text::from(name), AttributeValue::Text(Text::from(value)));
    }
    let layer = Layer::new(
        (width, height),
        attributes,
        Packing::SMALL_LOSSLESS,
        AnyChannels::sort(channels),
    );
    let mut bytes = std::io::Cursor::new(Vec::new());
    let file = File::from_layer(layer);
    file.write().non_parallel().to_buffered(&mut bytes).map_err(|e| malformed(e.to_string()))?;
    Ok(bytes.into_inner())
}
