//! The surroundings of body and lamps: unpolarized light with the spectrum of the lamps.

use std::f64::consts::{PI, TAU};

use glam::DVec3;
use pictures::image::Image;

/// The surroundings. Values are radiance factors: one that is 1 everywhere gives a white diffuser
/// the value 1.
#[derive(Clone, Debug, PartialEq)]
pub enum Sky {
    /// Darkness.
    Dark,
    /// The same radiance factor in all directions.
    Uniform(f64),
    /// The radiance factors of a picture.
    Map(Environment),
}

/// A picture of all directions: the azimuth over the columns, the polar angle from +y over the rows.
///
/// The centre is the direction of view, −z; +x is to the right of it.
#[derive(Clone, Debug, PartialEq)]
pub struct Environment {
    size: [usize; 2],
    luminances: Vec<f64>,
}

impl Environment {
    /// The luminances of `picture` times `factor`; negative luminances count as 0.
    pub fn new(picture: &Image, factor: f64) -> Self {
        let [_, to_y, _] = *picture.space().to_xyz_matrix();
        let luminance =
            |rgb: [f64; 3]| factor * to_y.iter().zip(rgb).map(|(a, b)| a * b).sum::<f64>().max(0.0);
        Self { size: picture.size(), luminances: picture.linear().map(luminance).collect() }
    }

    /// The luminance in a direction, interpolated between the centres of the pixels.
    fn radiance_factor(&self, direction: DVec3) -> f64 {
        let [width, height] = self.size;
        let u = direction.x.atan2(-direction.z) / TAU + 0.5;
        let v = direction.y.clamp(-1.0, 1.0).acos() / PI;
        let (x, y) = (u * width as f64 - 0.5, v * height as f64 - 0.5);
        let (left, top) = (x.floor(), y.floor());
        let (part_x, part_y) = (x - left, y - top);
        let row = |at: f64| at.clamp(0.0, height as f64 - 1.0) as usize * width;
        let column = |at: f64| (at as isize).rem_euclid(width as isize) as usize;
        let line = |row: usize| {
            let [a, b] = [left, left + 1.0].map(|at| self.luminances[row + column(at)]);
            a + part_x * (b - a)
        };
        let [above, below] = [row(top), row(top + 1.0)].map(line);
        above + part_y * (below - above)
    }
}

impl Sky {
    /// True unless the sky is dark.
    pub(crate) fn is_light(&self) -> bool {
        *self != Self::Dark
    }

    /// The radiance factor in a direction.
    pub(crate) fn radiance_factor(&self, direction: DVec3) -> f64 {
        match self {
            Self::Dark => 0.0,
            Self::Uniform(factor) => *factor,
            Self::Map(environment) => environment.radiance_factor(direction),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use pictures::image::Encoding;

    #[test]
    fn every_pixel_is_where_the_camera_has_it() {
        let (width, height) = (8, 4);
        let values = (0..width * height).map(|k| k as f32).collect();
        let picture = Image::new([width, height], 1, values, Encoding::Linear).unwrap();
        let map = Environment::new(&picture, 2.0);
        for (x, y) in [(0, 0), (3, 1), (4, 2), (7, 3)] {
            let azimuth = TAU * ((x as f64 + 0.5) / width as f64 - 0.5);
            let polar = PI * (y as f64 + 0.5) / height as f64;
            let toward =
                DVec3::new(polar.sin() * azimuth.sin(), polar.cos(), -polar.sin() * azimuth.cos());
            let expected = 2.0 * (y * width + x) as f64;
            assert!((map.radiance_factor(toward) - expected).abs() < 1e-9, "{x} {y}");
        }
        // Straight ahead, between the four pixels in the middle.
        assert!((map.radiance_factor(DVec3::NEG_Z) - 2.0 * 15.5).abs() < 1e-9);
        // Behind the camera the last column meets the first.
        assert!((map.radiance_factor(DVec3::Z) - 2.0 * 15.5).abs() < 1e-9);
        assert!(map.radiance_factor(DVec3::X) > map.radiance_factor(DVec3::NEG_X));
    }
}
