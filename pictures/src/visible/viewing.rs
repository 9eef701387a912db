//! The viewing conditions: the display and the distance.

use super::error::VisibleError;

/// A display and its distance from the eye. The picture is shown pixel by pixel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Viewing {
    size_m: [f64; 2],
    pixels: [f64; 2],
    distance_m: f64,
}

impl Default for Viewing {
    /// 0.375 m × 0.3 m with 1280 × 1024 pixels at 0.5 m, the default of HDR-VDP.
    fn default() -> Self {
        Self { size_m: [0.375, 0.3], pixels: [1280.0, 1024.0], distance_m: 0.5 }
    }
}

impl Viewing {
    /// A display of `size_m` (width and height in metres) with `pixels` columns and rows, seen
    /// from `distance_m` metres.
    ///
    /// # Errors
    ///
    /// If one of them is not a positive number.
    pub fn new(size_m: [f64; 2], pixels: [f64; 2], distance_m: f64) -> Result<Self, VisibleError> {
        let all = [
            ("the width of the display", size_m[0], "m"),
            ("the height of the display", size_m[1], "m"),
            ("the number of columns of the display", pixels[0], "pixels"),
            ("the number of rows of the display", pixels[1], "pixels"),
            ("the viewing distance", distance_m, "m"),
        ];
        for (name, value, unit) in all {
            if !(value > 0.0 && value.is_finite()) {
                return Err(VisibleError::Viewing { name, value, unit });
            }
        }
        Ok(Self { size_m, pixels, distance_m })
    }

    /// Pixels per degree of visual angle.
    pub fn pixels_per_degree(&self) -> f64 {
        2.0 * 0.5_f64.to_radians().tan() * self.distance_m * self.pixels[0] / self.size_m[0]
    }

    /// Area of the display in square degrees.
    pub fn area_deg2(&self) -> f64 {
        let per_degree = self.pixels_per_degree();
        (self.pixels[0] / per_degree) * (self.pixels[1] / per_degree)
    }

    /// Width and height of the display in metres.
    pub fn size_m(&self) -> [f64; 2] {
        self.size_m
    }

    /// Columns and rows of the display.
    pub fn pixels(&self) -> [f64; 2] {
        self.pixels
    }

    /// Distance from the eye to the display in metres.
    pub fn distance_m(&self) -> f64 {
        self.distance_m
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_default_display_has_thirty_pixels_per_degree() {
        // The value that the reference vectors state.
        assert!((Viewing::default().pixels_per_degree() - 29.78770872579).abs() < 1e-10);
    }

    #[test]
    fn a_display_without_size_is_refused() {
        for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            assert!(Viewing::new([0.3, 0.3], [100.0, 100.0], bad).is_err());
            assert!(Viewing::new([bad, 0.3], [100.0, 100.0], 0.5).is_err());
        }
    }
}
