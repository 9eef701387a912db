//! From a film to pictures: colours with or without a filter, degree and angle of polarization.

use spectra::{ColourPlan, Xyz};

use super::Film;
use crate::image::{Encoding, Image, ImageError};

/// What stands before the camera, or what is shown of the polarization.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Polarization {
    /// The light as it is.
    All,
    /// Behind an ideal linear polarizer; angle (rad) of its axis from the horizontal,
    /// counter-clockwise.
    Linear(f64),
    /// Behind an ideal circular polarizer that lets left circular light (V > 0) pass.
    Left,
    /// The same for right circular light.
    Right,
    /// The degree of linear polarization of the luminance, as a grey from 0 to 1.
    Degree,
}

impl Polarization {
    /// Linear red, green and blue of a pixel; `exposure` multiplies light.
    fn colour(self, [i, q, u, v]: [Xyz; 4], plan: &ColourPlan, exposure: f64) -> [f64; 3] {
        let light = match self {
            Self::All => i,
            Self::Linear(angle) => {
                let (sin, cos) = (2.0 * angle).sin_cos();
                (i + q * cos + u * sin) * 0.5
            }
            Self::Left => (i + v) * 0.5,
            Self::Right => (i - v) * 0.5,
            Self::Degree if i.y > 0.0 => return [q.y.hypot(u.y) / i.y; 3],
            Self::Degree => return [0.0; 3],
        };
        plan.rgb(light).map(|linear| exposure * linear)
    }
}

/// What is shown of the film; `exposure` multiplies its light.
///
/// # Errors
///
/// If the film has no pixels.
pub fn picture(
    film: &Film,
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
/// If the pictures do not fit together.
pub fn side_by_side(left: &Image, right: &Image) -> Result<Image, ImageError> {
    let [width, height] = left.size();
    let stride = width * left.channels();
    let rows = left.values().chunks_exact(stride).zip(right.values().chunks_exact(stride));
    let values = rows.flat_map(|(a, b)| a.iter().chain(b)).copied().collect();
    Image::new([2 * width, height], left.channels(), values, left.encoding())
}
