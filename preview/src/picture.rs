//! Pictures of a film: its colours with or without a filter, or its degree of polarization.

use pictures::image::{Encoding, Image, ImageError};
use spectra::{ColourPlan, Xyz};

use crate::film::RenderedFilm;

/// The filter before the camera, or the property of polarization that is shown.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Polarization {
    /// The light without a filter.
    All,
    /// Behind an ideal linear polarizer; angle (rad) of its axis from the horizontal,
    /// counter-clockwise.
    Linear(f64),
    /// Behind an ideal circular polarizer that lets left circular light (V > 0) pass.
    Left,
    /// Behind an ideal circular polarizer that lets right circular light (V < 0) pass.
    Right,
    /// The degree of linear polarization of the luminance, as a grey from 0 to 1.
    Degree,
}

impl Polarization {
    /// The light of a pixel behind the filter.
    fn filtered(self, [i, q, u, v]: [Xyz; 4]) -> Xyz {
        match self {
            Self::All | Self::Degree => i,
            Self::Linear(angle) => {
                let (sin, cos) = (2.0 * angle).sin_cos();
                (i + q * cos + u * sin) * 0.5
            }
            Self::Left => (i + v) * 0.5,
            Self::Right => (i - v) * 0.5,
        }
    }

    /// Linear red, green and blue of a pixel; `exposure` multiplies light.
    fn colour(self, pixel: [Xyz; 4], plan: &ColourPlan, exposure: f64) -> [f64; 3] {
        let [i, q, u, _] = pixel;
        match self {
            Self::Degree if i.y > 0.0 => [q.y.hypot(u.y) / i.y; 3],
            Self::Degree => [0.0; 3],
            _ => plan.rgb(self.filtered(pixel)).map(|linear| exposure * linear),
        }
    }
}

/// Y of the brightest pixel behind the filter; 1 is a white diffuser that faces a lamp.
pub fn brightest(film: &RenderedFilm, filter: Polarization) -> f64 {
    film.pixels.iter().map(|pixel| filter.filtered(*pixel).y).fold(0.0, f64::max)
}

/// The picture of the film behind the filter; `exposure` multiplies its light.
///
/// # Errors
///
/// If the film has no pixels.
pub fn picture(
    film: &RenderedFilm,
    plan: &ColourPlan,
    filter: Polarization,
    exposure: f64,
) -> Result<Image, ImageError> {
    let colours = film.pixels.iter().flat_map(|pixel| filter.colour(*pixel, plan, exposure));
    Image::new(film.size, 3, colours.map(|value| value as f32).collect(), Encoding::Linear)
}

/// Two pictures of one size, the second to the right of the first.
///
/// # Errors
///
/// If the pictures have no common height and number of channels.
pub fn side_by_side(left: &Image, right: &Image) -> Result<Image, ImageError> {
    let [width, height] = left.size();
    let stride = width * left.channels();
    let rows = left.values().chunks_exact(stride).zip(right.values().chunks_exact(stride));
    let values = rows.flat_map(|(a, b)| a.iter().chain(b)).copied().collect();
    Image::new([2 * width, height], left.channels(), values, left.encoding())
}
