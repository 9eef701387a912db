//! Contrast sensitivity: the inverse of the threshold contrast.
//!
//! $$ S(\rho, \theta) = 250\, \min\left[S_1(\rho), S_1\left(\frac{\rho}{r_a r_\theta}\right)\right] $$
//! $$ S_1(\rho) = \left[\left(3.23 (\rho^2 i^2)^{-0.3}\right)^5 + 1\right]^{-1/5}
//!    A \epsilon \rho\, e^{-B \epsilon \rho} \sqrt{1 + 0.06\, e^{B \epsilon \rho}} $$
//!
//! ρ in cycles per degree, i² the area of the picture in square degrees, ε = 0.9 for foveal
//! vision, A = 0.801 (1 + 0.7/L)^−0.2 and B = 0.3 (1 + 100/L)^0.15 for an adaptation to L cd/m²,
//! r_a = 0.856 d^0.14 for a distance of d metres, r_θ = 0.11 cos 4θ + 0.89. The mean of a picture
//! is not seen: S(0) = 0.
//!
//! S. Daly, in *Digital Images and Human Vision*, ed. A. B. Watson (MIT Press, 1993), 179.

/// The contrast sensitivity of an observer.
#[derive(Clone, Copy, Debug)]
pub(super) struct ContrastSensitivity {
    /// Luminance to which the eye is adapted, in cd/m².
    pub(super) luminance: f64,
    /// Area of the picture in square degrees.
    pub(super) area_deg2: f64,
    /// Viewing distance in metres.
    pub(super) distance_m: f64,
}

impl ContrastSensitivity {
    /// S at `rho` cycles per degree and the orientation `theta` in radians.
    pub(super) fn at(&self, rho: f64, theta: f64) -> f64 {
        if rho == 0.0 {
            return 0.0;
        }
        let accommodation = 0.856 * self.distance_m.powf(0.14);
        let orientation = 0.11 * (4.0 * theta).cos() + 0.89;
        250.0 * self.radial(rho).min(self.radial(rho / (accommodation * orientation)))
    }

    /// S₁.
    fn radial(&self, rho: f64) -> f64 {
        let a = 0.801 * (1.0 + 0.7 / self.luminance).powf(-0.2);
        let b = 0.3 * (1.0 + 100.0 / self.luminance).powf(0.15);
        let seen = 0.9 * rho;
        let decay = b * seen;
        // Beyond, the sensitivity is below 1e-10 and the exponential leaves the range of floats.
        if decay > 50.0 {
            return 0.0;
        }
        let size = (3.23 * (rho * rho * self.area_deg2).powf(-0.3)).powi(5);
        (size + 1.0).powf(-0.2) * a * seen * (-decay).exp() * (1.0 + 0.06 * decay.exp()).sqrt()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(luminance: f64) -> ContrastSensitivity {
        ContrastSensitivity { luminance, area_deg2: 1.0, distance_m: 0.5 }
    }

    #[test]
    fn the_mean_and_very_fine_structure_are_not_seen() {
        assert_eq!(at(50.0).at(0.0, 0.3), 0.0);
        assert_eq!(at(50.0).at(1000.0, 0.3), 0.0);
    }

    #[test]
    fn sensitivity_grows_with_luminance_and_is_least_for_oblique_structure() {
        assert!(at(100.0).at(4.0, 0.0) > at(1.0).at(4.0, 0.0));
        let oblique = std::f64::consts::FRAC_PI_4;
        assert!(at(100.0).at(20.0, oblique) < at(100.0).at(20.0, 0.0));
    }
}
