//! Phase matrix of a suspension of homogeneous spheres of many sizes.
//!
//! $$ P = \frac{\sum_j w_j\,M(\mathrm{diag}(S_2, S_1))_j}{k^2 \sum_j w_j C_{sca,j}} \qquad (1) $$
//!
//! $$ \kappa_s = \sum_j w_j C_{sca,j}, \quad
//!    \kappa_a = \sum_j w_j (C_{ext} - C_{sca})_j \qquad (2) $$
//!
//! over the diameters d_j = start·(1+step)^j ≤ end with w_j = n(d_j) d_j·step. k is the wave number
//! in the medium. `--compat` divides both coefficients by the square of the medium's index.
//!
//! D. Deirmendjian, *Electromagnetic Scattering on Spherical Polydispersions* (Elsevier, 1969).

use num_complex::Complex64;

use super::PolarizedPhase;
use crate::{
    Defect, Mueller, ParameterNode,
    scatterer::{
        FREE_SPACE, HostMedium, SphericalScatterer,
        mie::Mie,
        series::{AngularFunctions, MieSeries, terms},
    },
    size::{self, VolumeSize},
    spec::{Class, Laws, Parameter, ParameterError, Spec},
};

/// Name, parameters and constructor of a [`DistributedMie`] phase matrix.
pub const SPEC: Spec<dyn PolarizedPhase> = Spec {
    class: Class {
        name: "Distributed_Mie_Phase_Function",
        parent: "Polarized_Phase_Function",
        summary: "Suspension of homogeneous spheres of many sizes",
        equation: "P = sum(w M(diag(S2,S1)))/(k^2 sum(w Csca)), kappa_s = sum(w Csca)",
        source: "deirmendjian-1969",
        params: &[&[
            FREE_SPACE[0],
            Parameter::index("medium", (1.33, 0.0), "Index of the surrounding medium"),
            Parameter::index("sphere", (1.0, 0.0), "Index of the spheres"),
            Parameter::member(
                "distribution",
                &size::VOLUME_FAMILY,
                "Regular_VolumeParticleSizeDistribution",
                "Number of spheres per volume and diameter",
            ),
            Parameter::number("integralStart", 0.1, "um", "Smallest diameter"),
            Parameter::number("integralEnd", 100.0, "um", "Largest diameter"),
            Parameter::number("integralStep", 0.01, "1", "Step of the diameter over the diameter"),
        ]],
        laws: Laws::NONE,
    },
    build: |node| Ok(Box::new(DistributedMie::read(node)?)),
};

/// The most terms of all series together: 1 GB of them.
const MOST_TERMS: usize = 30_000_000;

/// A suspension of spheres of many sizes.
struct DistributedMie {
    /// w_j, 1/µm³, and the series of the sphere j.
    spheres: Vec<(f64, MieSeries)>,
    /// Terms of the longest series.
    longest: usize,
    /// 1/(k² Σ w C_sca).
    norm: f64,
    /// κ_a, 1/µm.
    absorption: f64,
    /// κ_s, 1/µm.
    scattering: f64,
}

impl DistributedMie {
    fn read(node: &ParameterNode) -> Result<Self, ParameterError> {
        let around = HostMedium::read(node)?;
        let m = around.relative_index(node, "sphere")?;
        let numbers = node.member::<dyn VolumeSize>("distribution")?;
        let k = around.wave_number();
        let (mut spheres, mut longest) = (Vec::new(), 0);
        let (mut scattering, mut absorption) = (0.0, 0.0);
        for (d, width) in ladder(node, k)? {
            let weight = numbers.density(d) * width;
            if weight == 0.0 {
                continue;
            }
            let sphere = Mie::homogeneous(node, around, m, 0.5 * d);
            let cross = sphere.cross_sections().expect("a Mie sphere has cross-sections");
            // (2)
            scattering += weight * cross.scattering;
            // Lossless spheres absorb a rounding error.
            absorption += weight * (cross.extinction - cross.scattering).max(0.0);
            longest = longest.max(sphere.series().len());
            spheres.push((weight, sphere.into_series()));
        }
        if !(scattering > 0.0) {
            return Err(ParameterError::new(
                "distribution",
                "no sphere of these diameters scatters",
            ));
        }
        let norm = 1.0 / (k * k * scattering);
        let n = around.medium.re;
        let scale = if node.reproduces(Defect::SpherePhaseMedium) { 1.0 / (n * n) } else { 1.0 };
        let (absorption, scattering) = (scale * absorption, scale * scattering);
        Ok(Self { spheres, longest, norm, absorption, scattering })
    }
}

/// Diameters with their widths, unless they are too many.
fn ladder(
    node: &ParameterNode,
    k: f64,
) -> Result<impl Iterator<Item = (f64, f64)> + use<>, ParameterError> {
    let [start, end, step] =
        ["integralStart", "integralEnd", "integralStep"].map(|name| node.number(name));
    if !size::is_ladder(start, end, step) {
        let problem =
            format!("{start} um to {end} um in steps of {step} is not a range of diameters");
        return Err(ParameterError::new("integralStep", problem));
    }
    let rungs = || size::ladder(start, end, step);
    let mut total = 0;
    for (d, _) in rungs() {
        total += terms(0.5 * k * d);
        if total > MOST_TERMS {
            return Err(ParameterError::new("integralEnd", "too many and too large spheres"));
        }
    }
    Ok(rungs())
}

impl PolarizedPhase for DistributedMie {
    fn at_cosine(&self, cos: f64) -> Mueller {
        let angular: Vec<_> = AngularFunctions::new(cos).take(self.longest).collect();
        // The sums over w_j of |S₁|², |S₂|² and S₂S₁*, of which the elements of M consist.
        let (mut across, mut along, mut product) = (0.0, 0.0, Complex64::ZERO);
        for (weight, series) in &self.spheres {
            let (s1, s2) = series.amplitudes_from(&angular);
            across += weight * s1.norm_sqr();
            along += weight * s2.norm_sqr();
            product += weight * s2 * s1.conj();
        }
        // (1)
        let (p, l) = (0.5 * (along + across), 0.5 * (along - across));
        let (d, v) = (product.re, product.im);
        Mueller([[p, l, 0.0, 0.0], [l, p, 0.0, 0.0], [0.0, 0.0, d, v], [0.0, 0.0, -v, d]])
            * self.norm
    }

    fn absorption(&self) -> f64 {
        self.absorption
    }

    fn scattering(&self) -> f64 {
        self.scattering
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::{PI, TAU};

    use super::*;
    use crate::{Mode, ParameterValue, spec, special::gauss};

    fn build(mode: Mode) -> Result<Box<dyn PolarizedPhase>, ParameterError> {
        let node = ParameterNode::with_defaults(&SPEC.class, mode)
            .with("integralEnd", ParameterValue::Number(3.0))?
            .with("integralStep", ParameterValue::Number(0.1))?;
        spec::build::<dyn PolarizedPhase>(&node)
    }

    #[test]
    fn the_integral_over_all_directions_is_one() {
        let phase = build(Mode::Sound).unwrap();
        let total =
            gauss::integrate(200, 0.0, PI, |t| TAU * t.sin() * phase.at_cosine(t.cos())[(0, 0)]);
        assert!((total - 1.0).abs() < 1e-12, "{total}");
    }

    #[test]
    fn compat_divides_the_coefficients_by_the_square_of_the_index() {
        let (sound, compat) = (build(Mode::Sound).unwrap(), build(Mode::Compat).unwrap());
        // Recurrences of the largest spheres start lower in compat: 1e-7 of the cross-section.
        assert!((sound.scattering() / compat.scattering() / (1.33 * 1.33) - 1.0).abs() < 1e-6);
    }

    #[test]
    fn ranges_that_would_not_end_are_refused() {
        for (name, value, blamed) in [
            ("integralStep", 0.0, "integralStep"),
            ("integralStart", -1.0, "integralStep"),
            ("integralEnd", 1e9, "integralEnd"),
        ] {
            let node = ParameterNode::with_defaults(&SPEC.class, Mode::Sound)
                .with(name, ParameterValue::Number(value))
                .unwrap();
            assert_eq!((SPEC.build)(&node).err().unwrap().parameter, blamed);
        }
    }
}
