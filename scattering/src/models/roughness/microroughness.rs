//! Rayleigh–Rice scattering: first-order vector perturbation of a bare rough surface.
//!
//! Reflection, with ε = n² of the substrate and q = √(ε − sin²θ):
//!
//! $$ \mathbf{J} = \frac{4\pi}{\lambda^2} \sqrt{\cos\theta_i \cos\theta_s\,\mathrm{PSD}}\;
//!    (\varepsilon - 1)\, \mathbf{Q} \qquad (1) $$
//!
//! $$ Q_{ss} = \frac{\cos\varphi}{(c_i + q_i)(c_s + q_s)}, \quad
//!    Q_{pp} = \frac{\varepsilon \sin\theta_i \sin\theta_s - q_i q_s \cos\varphi}
//!             {(\varepsilon c_i + q_i)(\varepsilon c_s + q_s)} \qquad (2) $$
//!
//! $$ Q_{ps} = \frac{-q_i \sin\varphi}{(\varepsilon c_i + q_i)(c_s + q_s)}, \quad
//!    Q_{sp} = \frac{-q_s \sin\varphi}{(c_i + q_i)(\varepsilon c_s + q_s)} \qquad (3) $$
//!
//! Transmission, with N = √ε, κ = N sin θ_s, A = √(ε − sin²θ_i) or √(ε − κ²), B = cos θ_i or
//! √(1 − κ²):
//!
//! $$ \mathbf{J} = \frac{4\pi}{\lambda^2} N \sqrt{A_s B_i\,\mathrm{PSD}}\;
//!    (1 - \varepsilon)\, \mathbf{Q} \qquad (4) $$
//!
//! $$ Q_{ss} = \frac{\cos\varphi}{(A_i + B_i)(A_s + B_s)}, \quad
//!    Q_{pp} = \frac{N (\kappa \sin\theta_i + A_i B_s \cos\varphi)}
//!             {(A_i + \varepsilon B_i)(A_s + \varepsilon B_s)} \qquad (5) $$
//!
//! $$ Q_{ps} = \frac{-A_i \sin\varphi}{(A_i + \varepsilon B_i)(A_s + B_s)}, \quad
//!    Q_{sp} = \frac{N B_s \sin\varphi}{(A_i + B_i)(A_s + \varepsilon B_s)} \qquad (6) $$
//!
//! From inside the substrate ε becomes 1/n², λ becomes λ/n, and the off-diagonal elements change
//! sign. NIST's library takes B_s = −i√(κ² − 1) beyond the critical angle of type 1
//! ([`Defect::MicroroughnessBranch`]). Heights must be well below the wavelength.
//!
//! S. O. Rice, *Reflection of electromagnetic waves from slightly rough surfaces*, Commun. Pure
//! Appl. Math. 4, 351 (1951).

use std::f64::consts::PI;

use num_complex::Complex64;

use super::{ROUGHNESS, RoughSurface};
use crate::{
    Defect, Direction, Incidence, Jones, Mueller, Side,
    geometry::ScatteredRay,
    lanes::{Complex, Real, SimdLevel, WIDTH},
    models::{
        Brdf, COMMON, CommonParameters,
        batch::{BatchKernel, evaluate},
    },
    optics::film::{decaying_root, root},
    polarization::muellers,
    spec::{Class, Laws, Spec},
};

/// Name, parameters and constructor of a [`Microroughness`].
pub const SPEC: Spec<dyn Brdf> = Spec {
    class: Class {
        name: "Microroughness_BRDF_Model",
        parent: "Roughness_BRDF_Model",
        summary: "Rayleigh-Rice scattering by a bare rough surface",
        equation: "J = 4 pi/lambda^2 sqrt(cos_i cos_s PSD) (eps - 1) Q",
        source: "rice-1951",
        params: &[COMMON, ROUGHNESS],
        laws: Laws::NOT_PASSIVE,
    },
    build: |node| {
        let rough = RoughSurface::read(node)?;
        let CommonParameters { lambda, substrate, side } = rough.common;
        let (index, lambda) = if side.from_below() {
            (1.0 / substrate, lambda / substrate.re)
        } else {
            (substrate, lambda)
        };
        let transmits = matches!(side, Side::DownDown | Side::UpUp);
        Ok(Box::new(Microroughness {
            rough,
            index,
            epsilon: index * index,
            scale: 4.0 * PI / (lambda * lambda),
            transmits,
            growing: side == Side::DownDown && node.reproduces(Defect::MicroroughnessBranch),
        }))
    },
};

/// A bare rough surface.
pub struct Microroughness {
    rough: RoughSurface,
    /// Index of the medium beyond the surface over that of the medium of incidence.
    index: Complex64,
    epsilon: Complex64,
    /// 4π/λ².
    scale: f64,
    transmits: bool,
    growing: bool,
}

/// The factors of the amplitudes that depend on the incident beam alone.
#[derive(Clone, Copy)]
struct IncidentFactors {
    /// q_i or A_i.
    q: Complex64,
    /// The prefactor of (1) or (4) without √cos θ_s or √A_s, over (c_i + q_i) or (A_i + B_i).
    s: Complex64,
    /// The same over (εc_i + q_i) or (A_i + εB_i).
    p: Complex64,
}

/// The surface under a beam.
struct IlluminatedSurface<'a> {
    surface: &'a Microroughness,
    beam: IncidentFactors,
    incidence: &'a Incidence,
}

impl BatchKernel for IlluminatedSurface<'_> {
    #[inline(always)]
    fn batch<V: SimdLevel>(
        &self,
        vectors: V,
        directions: &[Direction; WIDTH],
        out: &mut [Mueller; WIDTH],
    ) {
        let Self { surface, beam, incidence } = self;
        let to = ScatteredRay::batch(vectors, directions);
        let jones = surface.elements(beam, incidence, &to);
        let density = |to| surface.rough.density(incidence, to);
        muellers(vectors, jones, vectors.load(&directions.each_ref().map(density)), out);
    }

    fn one(&self, direction: &Direction) -> Mueller {
        let jones = self.surface.amplitude(&self.beam, self.incidence, direction);
        jones.mueller() * self.surface.rough.density(self.incidence, direction)
    }
}

impl Microroughness {
    fn beam(&self, incidence: &Incidence) -> IncidentFactors {
        let q = decaying_root(self.epsilon - incidence.sin * incidence.sin);
        let contrast =
            if self.transmits { (1.0 - self.epsilon) * self.index } else { self.epsilon - 1.0 };
        let factor = contrast * (self.scale * incidence.cos.sqrt());
        IncidentFactors {
            q,
            s: factor / (incidence.cos + q),
            p: factor / (self.epsilon * incidence.cos + q),
        }
    }

    /// Amplitude per √PSD: its elements ss, ps, sp and pp.
    #[inline(always)]
    fn elements<R: Real>(
        &self,
        beam: &IncidentFactors,
        incidence: &Incidence,
        to: &ScatteredRay<R>,
    ) -> [Complex<R>; 4] {
        let [ss, ps, sp, pp] = if self.transmits {
            self.transmitted(beam, incidence, to)
        } else {
            self.reflected(beam, incidence, to)
        };
        let crossed = if self.rough.common.side.from_below() {
            to.cos.splat(-1.0)
        } else {
            to.cos.splat(1.0)
        };
        [ss, ps * crossed, sp * crossed, pp]
    }

    #[inline(always)]
    fn reflected<R: Real>(
        &self,
        beam: &IncidentFactors,
        incidence: &Incidence,
        to: &ScatteredRay<R>,
    ) -> [Complex<R>; 4] {
        let Complex64 { re, im } = self.epsilon;
        let q = root(-(to.sin * to.sin) + re, im);
        let factor = to.cos.sqrt();
        let s = Complex::fraction(factor, q + to.cos);
        let p = Complex::fraction(factor, q + Complex { re: to.cos * re, im: to.cos * im });
        let sines = to.sin * incidence.sin;
        let along = Complex { re: sines * re, im: sines * im } - q.times(beam.q) * to.cos_phi;
        // Q_ss, Q_ps, Q_sp, Q_pp of (2) and (3), with the prefactor of (1).
        [
            s.times(beam.s) * to.cos_phi,
            s.times(beam.p * beam.q) * -to.sin_phi,
            (q * p).times(beam.s) * -to.sin_phi,
            (p * along).times(beam.p),
        ]
    }

    #[inline(always)]
    fn transmitted<R: Real>(
        &self,
        beam: &IncidentFactors,
        incidence: &Incidence,
        to: &ScatteredRay<R>,
    ) -> [Complex<R>; 4] {
        let (index, epsilon) = (self.index, self.epsilon);
        let kappa = to.sin * index.re;
        let a = to.cos * index.re;
        let mut b = root(-(kappa * kappa) + 1.0, 0.0);
        if self.growing {
            b.im = -b.im;
        }
        let factor = a.sqrt();
        let s = Complex::fraction(factor, b + a);
        let p = Complex::fraction(factor, b.times(epsilon) + a);
        let along = b.times(beam.q) * to.cos_phi + kappa * incidence.sin;
        // Q_ss, Q_ps, Q_sp, Q_pp of (5) and (6), with the prefactor of (4).
        [
            s.times(beam.s) * to.cos_phi,
            s.times(beam.p * beam.q) * -to.sin_phi,
            (p * b).times(beam.s * index) * to.sin_phi,
            (p * along).times(beam.p * index),
        ]
    }

    /// Amplitude per √PSD.
    fn amplitude(
        &self,
        beam: &IncidentFactors,
        incidence: &Incidence,
        direction: &Direction,
    ) -> Jones {
        let elements = self.elements(beam, incidence, &ScatteredRay::single(direction));
        let [ss, ps, sp, pp] = elements.map(Into::into);
        Jones { ss, ps, sp, pp }
    }
}

impl Brdf for Microroughness {
    fn common(&self) -> &CommonParameters {
        &self.rough.common
    }

    fn mueller(&self, incidence: &Incidence, direction: &Direction) -> Mueller {
        let jones = self.amplitude(&self.beam(incidence), incidence, direction);
        jones.mueller() * self.rough.density(incidence, direction)
    }

    fn mueller_batch(&self, incidence: &Incidence, directions: &[Direction], out: &mut [Mueller]) {
        let lit = IlluminatedSurface { surface: self, beam: self.beam(incidence), incidence };
        evaluate(&lit, directions, out);
    }

    fn jones(&self, incidence: &Incidence, direction: &Direction) -> Option<Jones> {
        let jones = self.amplitude(&self.beam(incidence), incidence, direction);
        Some(jones.scaled(self.rough.density(incidence, direction).sqrt()))
    }

    fn is_coherent(&self) -> bool {
        true
    }
}

#[cfg(test)]
mod tests {
    use crate::{
        Basis, Geometry, Mode, Model, Mueller, ParameterNode, models, optics::RefractiveIndex,
        spec::ParameterValue,
    };

    fn glass(side: i32, mode: Mode) -> Model {
        let node = ParameterNode::with_defaults(&super::SPEC.class, mode)
            .with("type", ParameterValue::Integer(side))
            .and_then(|node| {
                node.with("substrate", ParameterValue::Index(RefractiveIndex::constant(1.5, 0.0)))
            })
            .unwrap();
        models::build(&node).unwrap()
    }

    #[test]
    fn p_light_in_the_plane_vanishes_at_the_perturbation_brewster_angle() {
        // ε sin θ_i sin θ_s = q_i q_s; for θ_i = θ_s this is tan θ = √ε, Brewster's angle.
        let theta = 1.5f64.atan();
        let at = Geometry { theta_i: theta, theta_s: theta, ..Geometry::default() };
        let m = glass(0, Mode::Sound).mueller(&at, Basis::Psps);
        let pp = m[(0, 0)] - m[(0, 1)] - m[(1, 0)] + m[(1, 1)];
        assert!(pp.abs() < 1e-14 * m[(0, 0)]);
    }

    #[test]
    fn beyond_the_critical_angle_compat_turns_the_sign_of_the_circular_elements() {
        let at = Geometry { theta_i: 0.6, theta_s: 1.1, phi_s: 0.7, rotation: 0.0 };
        let sound = glass(1, Mode::Sound).mueller(&at, Basis::Psps);
        let compat = glass(1, Mode::Compat).mueller(&at, Basis::Psps);
        let turned = Mueller::diagonal([1.0, 1.0, 1.0, -1.0]);
        assert!((turned * sound * turned - compat).largest() < 1e-13 * sound.largest());
        assert!(sound[(3, 2)].abs() > 1e-3 * sound[(0, 0)]);
        // Below the critical angle the root has one branch.
        let at = Geometry { theta_s: 0.7, ..at };
        let sound = glass(1, Mode::Sound).mueller(&at, Basis::Psps);
        assert_eq!(sound, glass(1, Mode::Compat).mueller(&at, Basis::Psps));
    }

    #[test]
    fn transmission_both_ways_is_reciprocal_with_the_square_of_the_index() {
        // M₁(θ_i, θ_s, φ; r) = n² P M₃(θ_s, θ_i, −φ; r+π−φ)ᵀ P, also beyond the critical angle.
        let p = Mueller::diagonal([1.0, 1.0, -1.0, 1.0]);
        for theta_s in [0.4, 1.2] {
            let (theta_i, phi_s, rotation) = (0.8, 1.1, 0.3);
            let into = Geometry { theta_i, theta_s, phi_s, rotation };
            let back = Geometry {
                theta_i: theta_s,
                theta_s: theta_i,
                phi_s: -phi_s,
                rotation: rotation + std::f64::consts::PI - phi_s,
            };
            let m1 = glass(1, Mode::Sound).mueller(&into, Basis::Psps);
            let m3 = glass(3, Mode::Sound).mueller(&back, Basis::Psps);
            let expected = p * m3.transposed() * p * 2.25;
            assert!((m1 - expected).largest() < 1e-13 * m1.largest());
        }
    }
}
