//! Homogeneous sphere of any size.
//!
//! The coefficients a_n, b_n of [`layered`] with one layer in the series of [`series`]; the
//! number of terms is that beyond which none changes the sum. `--compat` takes x + 4x^{1/3} + 2,
//! x = 2πnr/λ in the medium, 10⁻⁷ off for x = 1000, and starts the recurrence of ψ'/ψ at
//! max(x + 4x^{1/3} + 2, |mx|) + 15, which is too low for large spheres: at x = 57 the amplitudes
//! are off by 10⁻⁵.
//!
//! G. Mie, Ann. Phys. 330, 377 (1908); C. F. Bohren and D. R. Huffman, *Absorption and Scattering
//! of Light by Small Particles* (Wiley, 1983), chapter 4.

use num_complex::Complex64;

use super::{
    CrossSections, FREE_SPACE, HostMedium, SPHERE, Scatterer, SphericalScatterer, layered,
    series::{self, MieSeries},
};
use crate::{
    Defect, Jones, Mode, ParameterNode,
    spec::{Class, Laws, Spec},
    special::riccati,
};

/// Name, parameters and constructor of a homogeneous sphere.
pub const SPEC: Spec<dyn Scatterer> = Spec {
    class: Class {
        name: "MieScatterer",
        parent: "SphericalScatterer",
        summary: "Homogeneous sphere of any size",
        equation: "S1 = sum (2n+1)/(n(n+1)) (a_n pi_n + b_n tau_n), S2 with a, b exchanged",
        source: "mie-1908 bohren-huffman-1983",
        params: &[FREE_SPACE, SPHERE],
        laws: Laws::NONE,
    },
    build: |node| {
        let around = HostMedium::read(node)?;
        let m = around.relative_index(node, "sphere")?;
        let radius = around.radius(node, &[m])?;
        Ok(Box::new(Mie::homogeneous(node, around, m, radius)))
    },
};

/// A sphere given by its Mie coefficients.
#[derive(Clone, Debug)]
pub struct Mie {
    around: HostMedium,
    series: MieSeries,
}

impl Mie {
    /// A homogeneous sphere of relative index `m` and radius `radius` µm; `node` says whether
    /// to start its recurrence as NIST's library does.
    pub fn homogeneous(
        node: &ParameterNode,
        around: HostMedium,
        m: Complex64,
        radius: f64,
    ) -> Self {
        let x = around.wave_number() * radius;
        let terms = series::terms_for(node, x);
        let from = first_order(node, m * x, x, terms);
        let series = MieSeries::new(&layered::homogeneous((m, x), terms, from));
        Self { around, series: if node.mode == Mode::Sound { series.trimmed() } else { series } }
    }

    /// A sphere of layers, from the inside out, with `terms` terms.
    pub fn layered(around: HostMedium, layers: &[layered::SphereShell], terms: usize) -> Self {
        Self { around, series: MieSeries::new(&layered::coefficients(layers, terms)) }
    }

    /// Its series.
    pub fn series(&self) -> &MieSeries {
        &self.series
    }

    /// Its series, without the rest.
    pub fn into_series(self) -> MieSeries {
        self.series
    }
}

impl SphericalScatterer for Mie {
    fn surroundings(&self) -> &HostMedium {
        &self.around
    }

    fn amplitudes(&self, cos: f64) -> Jones {
        series::matrix(self.series.amplitudes(cos))
    }

    fn cross_sections(&self) -> Option<CrossSections> {
        Some(self.series.cross_sections(self.around.wave_number()))
    }
}

/// The order at which the recurrence of ψ'/ψ at `z` = mx starts for this number of terms.
fn first_order(node: &ParameterNode, z: Complex64, x: f64, terms: usize) -> usize {
    let converged = riccati::start(terms, z);
    let library = (x + 4.0 * x.powf(0.3333) + 2.0).max(z.norm()) + 15.0;
    // Six widths of the turning point leave exp(−1.9·6^{3/2}) = 1e-12 of the start's error.
    let too_low = library < z.norm() + 6.0 * z.norm().cbrt();
    if too_low && node.reproduces(Defect::MieStart) { library as usize } else { converged }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    fn sound() -> ParameterNode {
        ParameterNode::with_defaults(&SPEC.class, Mode::Sound)
    }

    /// Efficiencies (Q_sca, Q_ext, Q_back) of a sphere of size parameter `x` in vacuum.
    fn efficiencies(x: f64, m: Complex64) -> (f64, f64, f64) {
        let around = HostMedium { lambda: 2.0 * PI, medium: Complex64::ONE };
        let c = Mie::homogeneous(&sound(), around, m, x).cross_sections().unwrap();
        let area = PI * x * x;
        (c.scattering / area, c.extinction / area, c.back / area)
    }

    #[test]
    fn bohren_and_huffmans_sample_run_is_reproduced() {
        // Appendix A: radius 0.525 µm, λ 0.6328 µm, m = 1.55; printed with six digits. Their
        // Q_back is 4|S(180°)|²/x².
        let x = 2.0 * PI * 0.525 / 0.6328;
        let (sca, ext, back) = efficiencies(x, Complex64::new(1.55, 0.0));
        assert!((x - 5.213).abs() < 5e-4);
        assert!((sca - 3.10543).abs() < 5e-6 && (ext - 3.10543).abs() < 5e-6);
        assert!((back - 2.92534).abs() < 5e-6, "{back}");
    }

    #[test]
    fn bohren_and_huffmans_matrix_elements_are_reproduced() {
        // The same run: angle, S11/S11(0°), −S12/S11, S33/S11, S34/S11, six digits.
        let rows = [
            (0.0, 1.0, 0.0, 1.0, 0.0),
            (9.0, 0.785390, -0.459811e-2, 0.999400, 0.343261e-1),
            (90.0, 0.124601e-1, 0.230462, 0.937497, 0.260742),
            (180.0, 0.383189e-1, 0.0, -1.0, 0.0),
        ];
        let around = HostMedium { lambda: 0.6328, medium: Complex64::ONE };
        let sphere = Mie::homogeneous(&sound(), around, Complex64::new(1.55, 0.0), 0.525);
        let s11 = |s: &Jones| 0.5 * (s.ss.norm_sqr() + s.pp.norm_sqr());
        let forward = s11(&sphere.amplitudes(1.0));
        for (angle, relative, polarization, s33, s34) in rows {
            let s = sphere.amplitudes(f64::to_radians(angle).cos());
            let own = s11(&s);
            let half_difference = 0.5 * (s.pp.norm_sqr() - s.ss.norm_sqr());
            let product = s.ss * s.pp.conj();
            assert!((own / forward - relative).abs() < 6e-7, "{angle}");
            assert!((half_difference / own - polarization).abs() < 6e-7, "{angle}");
            assert!((product.re / own - s33).abs() < 6e-7, "{angle}");
            assert!((product.im / own - s34).abs() < 6e-7, "{angle}");
        }
    }

    #[test]
    fn wiscombes_cases_are_reproduced() {
        // W. J. Wiscombe, NCAR/TN-140+STR (1979): (m, x, Q_ext, Q_sca), seven digits.
        let cases = [
            ((0.75, 0.0), 0.099, 7.417859e-6, 7.417859e-6),
            ((0.75, 0.0), 10.0, 2.232265, 2.232265),
            ((0.75, 0.0), 1000.0, 1.997908, 1.997908),
            ((1.5, 0.0), 10.0, 2.881999, 2.881999),
            ((1.5, 0.0), 100.0, 2.094388, 2.094388),
            ((1.5, 0.0), 1000.0, 2.013945, 2.013945),
            ((1.33, 1e-5), 1.0, 0.09395198, 0.09392330),
            ((1.33, 1e-5), 100.0, 2.101321, 2.096594),
            ((1.33, 1e-5), 10000.0, 2.004089, 1.723857),
            ((1.5, 1.0), 0.055, 0.1014910, 1.131687e-5),
            ((1.5, 1.0), 1.0, 2.336321, 0.6634538),
            ((1.5, 1.0), 100.0, 2.097502, 1.283697),
            ((1.5, 1.0), 10000.0, 2.004368, 1.236574),
            ((10.0, 10.0), 1.0, 2.532993, 2.049405),
            ((10.0, 10.0), 100.0, 2.071124, 1.836785),
            ((10.0, 10.0), 10000.0, 2.005914, 1.795393),
        ];
        for ((n, k), x, extinction, scattering) in cases {
            let (sca, ext, _) = efficiencies(x, Complex64::new(n, k));
            assert!((ext / extinction - 1.0).abs() < 5e-7, "{n} {k} {x}: {ext}");
            assert!((sca / scattering - 1.0).abs() < 5e-7, "{n} {k} {x}: {sca}");
        }
    }

    #[test]
    fn large_opaque_spheres_take_twice_their_shadow() {
        let (_, ext, _) = efficiencies(2e4, Complex64::new(1.5, 0.5));
        // Q_ext − 2 falls as x^{−2/3}, times a factor near 2.
        assert!((ext - 2.0).abs() < 4.0 * 2e4f64.powf(-2.0 / 3.0));
    }

    #[test]
    fn the_low_start_of_the_recurrence_shows_in_large_spheres_of_compat_only() {
        let at = |mode, radius| {
            let node = ParameterNode::with_defaults(&SPEC.class, mode);
            let around = HostMedium { lambda: 0.55, medium: Complex64::ONE };
            let sphere = Mie::homogeneous(&node, around, Complex64::new(1.33, 0.0), radius);
            (sphere.amplitudes(0.4536).ss, !node.notices.lock().unwrap().is_empty())
        };
        let ((compat, _), (sound, met)) = (at(Mode::Compat, 5.0), at(Mode::Sound, 5.0));
        let relative = (compat - sound).norm() / sound.norm();
        assert!(met && relative > 1e-6 && relative < 1e-4, "{relative}");
        let ((compat, _), (sound, met)) = (at(Mode::Compat, 0.3), at(Mode::Sound, 0.3));
        // The sound series has a few terms more.
        assert!(!met && (compat - sound).norm() < 1e-9 * sound.norm());
    }

    #[test]
    fn sixty_more_terms_change_no_large_sphere() {
        for (x, m) in
            [(1e3, (1.33, 0.0)), (4321.0, (1.5, 1e-4)), (1e4, (1.59, 0.0)), (150.0, (0.2, 3.4))]
        {
            let m = Complex64::new(m.0, m.1);
            let around = HostMedium { lambda: 2.0 * PI, medium: Complex64::ONE };
            let sphere = Mie::homogeneous(&sound(), around, m, x);
            let terms = series::converged_terms(x) + 60;
            let from = riccati::start(terms, m * x);
            let longer = MieSeries::new(&layered::homogeneous((m, x), terms, from));
            let (got, expected) = (sphere.series().cross_sections(1.0), longer.cross_sections(1.0));
            assert!((got.extinction / expected.extinction - 1.0).abs() < 1e-13);
            for theta in [0.0, 0.3, 1.2, 2.5, PI] {
                let at = |series: &MieSeries| series.amplitudes(f64::cos(theta));
                let (got, expected) = (at(sphere.series()), at(&longer));
                assert!((got.0 - expected.0).norm() < 1e-11 * expected.0.norm(), "{x} {theta}");
                assert!((got.1 - expected.1).norm() < 1e-11 * expected.1.norm(), "{x} {theta}");
            }
        }
    }

    #[test]
    fn the_series_of_large_spheres_ends_early_in_compat_only() {
        let node = |mode| ParameterNode::with_defaults(&SPEC.class, mode);
        let around = HostMedium { lambda: 2.0 * PI, medium: Complex64::ONE };
        let m = Complex64::new(1.5, 1e-3);
        let at = |mode| Mie::homogeneous(&node(mode), around, m, 2000.0);
        let (sound, compat) = (at(Mode::Sound), at(Mode::Compat));
        assert_eq!(compat.series().len(), series::terms(2000.0));
        let (a, b) = (sound.amplitudes(-0.7).ss, compat.amplitudes(-0.7).ss);
        let relative = (a - b).norm() / a.norm();
        assert!(relative > 1e-9 && relative < 1e-5, "{relative:e}");
    }
}
