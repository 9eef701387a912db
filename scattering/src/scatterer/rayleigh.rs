//! Sphere much smaller than the wavelength.
//!
//! $$ S_1 = -i\alpha, \qquad S_2 = -i\alpha\cos\theta, \qquad
//!    \alpha = x^3 t, \qquad t = \frac{m^2-1}{m^2+2} $$
//!
//! x = 2πnr/λ in the medium. C_sca = πr²(8/3)x⁴|t|²; C_ext has the terms to x⁴ of Bohren &
//! Huffman (5.7) and (5.8). `--compat` leaves the −i out, which moves absorption into the phase.
//!
//! C. F. Bohren and D. R. Huffman, *Absorption and Scattering of Light by Small Particles*
//! (Wiley, 1983), 5.1.

use std::f64::consts::PI;

use num_complex::Complex64;

use super::{
    CrossSections, FREE_SPACE, HostMedium, SPHERE, Scatterer, SphericalScatterer, positive,
    series::matrix,
};
use crate::{
    Defect, Jones,
    spec::{Class, Laws, Spec},
};

/// Name, parameters and constructor of a [`RayleighSphere`] sphere.
pub const SPEC: Spec<dyn Scatterer> = Spec {
    class: Class {
        name: "RayleighScatterer",
        parent: "SphericalScatterer",
        summary: "Sphere much smaller than the wavelength",
        equation: "S1 = -i x^3 (m^2-1)/(m^2+2), S2 = S1 cos(theta)",
        source: "bohren-huffman-1983",
        params: &[FREE_SPACE, SPHERE],
        laws: Laws::NONE,
    },
    build: |node| {
        let around = HostMedium::read(node)?;
        let radius = positive(node, "radius")?;
        let m = around.relative_index(node, "sphere")?;
        let x = around.wave_number() * radius;
        let phase =
            if node.reproduces(Defect::RayleighPhase) { Complex64::ONE } else { -Complex64::I };
        let amplitude = phase * x.powi(3) * (m * m - 1.0) / (m * m + 2.0);
        Ok(Box::new(RayleighSphere {
            around,
            amplitude,
            cross_sections: cross_sections(radius, x, m),
        }))
    },
};

/// A sphere much smaller than the wavelength.
#[derive(Clone, Copy, Debug)]
pub struct RayleighSphere {
    around: HostMedium,
    amplitude: Complex64,
    cross_sections: CrossSections,
}

impl SphericalScatterer for RayleighSphere {
    fn surroundings(&self) -> &HostMedium {
        &self.around
    }

    fn amplitudes(&self, cos: f64) -> Jones {
        matrix((self.amplitude, self.amplitude * cos))
    }

    fn cross_sections(&self) -> Option<CrossSections> {
        Some(self.cross_sections)
    }
}

fn cross_sections(radius: f64, x: f64, m: Complex64) -> CrossSections {
    let m2 = m * m;
    let t = (m2 - 1.0) / (m2 + 2.0);
    let area = PI * radius * radius;
    let x4 = x.powi(4);
    let correction = 1.0 + x * x / 15.0 * t * (m2 * m2 + 27.0 * m2 + 38.0) / (2.0 * m2 + 3.0);
    CrossSections {
        scattering: area * 8.0 / 3.0 * x4 * t.norm_sqr(),
        extinction: area * (4.0 * x * (t * correction).im + 8.0 / 3.0 * x4 * (t * t).re),
        back: area * 4.0 * x4 * t.norm_sqr(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Mode, ParameterNode, ParameterValue, optics::RefractiveIndex, spec};

    fn amplitude(mode: Mode) -> Complex64 {
        let node = ParameterNode::with_defaults(&SPEC.class, mode)
            .with("sphere", ParameterValue::Index(RefractiveIndex::constant(1.5, 0.0)))
            .unwrap();
        spec::build::<dyn Scatterer>(&node).unwrap().round().unwrap().amplitudes(1.0).pp
    }

    #[test]
    fn lossless_spheres_are_out_of_phase_soundly_and_in_phase_in_compat() {
        assert!(amplitude(Mode::Sound).re == 0.0 && amplitude(Mode::Sound).im < 0.0);
        assert!(amplitude(Mode::Compat).im == 0.0 && amplitude(Mode::Compat).re > 0.0);
    }

    #[test]
    fn cross_sections_are_those_of_a_small_mie_sphere() {
        // Scattering lacks terms of relative order x², extinction of an absorbing sphere x³.
        let around = HostMedium { lambda: 2.0 * PI, medium: Complex64::ONE };
        let node = ParameterNode::with_defaults(&SPEC.class, Mode::Sound);
        let (x, m) = (0.01, Complex64::new(1.5, 0.3));
        let mie =
            super::super::mie::Mie::homogeneous(&node, around, m, x).cross_sections().unwrap();
        let got = cross_sections(x, x, m);
        assert!((got.scattering / mie.scattering - 1.0).abs() < 2e-4);
        assert!((got.extinction / mie.extinction - 1.0).abs() < 1e-6);
        assert!((got.back / mie.back - 1.0).abs() < 4e-4);
    }
}
