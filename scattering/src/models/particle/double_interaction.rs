//! A particle above the smooth face of a substrate.
//!
//! The particle scatters as in vacuum. Light reaches it and leaves it directly or after a reflection
//! at the (filmed) face, and the four paths interfere. With h the distance of its centre,
//! k₀ = 2π/λ and r = r12(θ) e^{2ik₀h cos θ},
//!
//! | type | J k₀ |
//! |---|---|
//! | 0 | S(k_i,k_s) + S(k_i^r,k_s) r_i + r_s S(k_i,k_s^r) + r_s S(k_i^r,k_s^r) r_i |
//! | 1 | t12(b) (n^{3/2} cos θ_s/c_b) [S(k_i,k_o) + S(k_i^r,k_o) r_i] e^{ik₀h(c_b − n cos θ_s)} |
//! | 2 | t21(θ_s) S(k_a,k_b) t21(θ_i) e^{ik₀h(c_a − n cos θ_i + c_b − n cos θ_s)} |
//! | 3 | [S(k_a,k_s) + r_s S(k_a,k_s^r)] t21(θ_i) n^{−1/2} e^{ik₀h(c_a − n cos θ_i)} |
//!
//! where a = n sin θ_i and b = n sin θ_s are the sines outside and c their cosines; light that the
//! face reflects totally does not reach the particle. F = N M(J)/(cos θ_i cos θ_s). Light
//! of the particle that the face reflects back to it is neglected.
//!
//! K. B. Nahm and W. L. Wolfe, Appl. Opt. 26, 2995 (1987).

use std::f64::consts::TAU;

use glam::DVec3;
use num_complex::Complex64;

use super::{
    LOCAL,
    paths::{
        FaceReflection, InteractionPaths, ORIENTATION, OrientedParticle, PolarizedBeam, nudged,
    },
    small_sphere::not_negative,
};
use crate::{
    Defect, Direction, Incidence, Jones, Mueller, ParameterError, ParameterNode, ParameterValue,
    Side,
    models::{
        Brdf, COMMON, CommonParameters,
        smooth_interface::{INTERFACE, interface},
    },
    optics::{RefractiveIndex, film::Films},
    scatterer::{self, Scatterer},
    spec::{self, Class, Laws, Parameter, Spec},
};

/// Name, parameters and constructor of a [`DoubleInteraction`].
pub const SPEC: Spec<dyn Brdf> = Spec {
    class: Class {
        name: "Double_Interaction_BRDF_Model",
        parent: "Local_BRDF_Model",
        summary: "Particle above a smooth surface",
        equation: "F = N/(cos_i cos_s) M(J), J = (S(ki,ks) + S(kir,ks) ri + rs S(ki,ksr) + rs S(kir,ksr) ri)/k0",
        source: "nahm-wolfe-1987",
        params: &[
            COMMON,
            LOCAL,
            INTERFACE,
            &[
                Parameter::number(
                    "distance",
                    0.05,
                    "um",
                    "Distance of the centre from the surface",
                ),
                Parameter::member(
                    "scatterer",
                    &scatterer::FAMILY,
                    "MieScatterer",
                    "The particle; its lambda and medium are set to the model's and to vacuum",
                ),
                ORIENTATION[0],
                ORIENTATION[1],
            ],
        ],
        laws: Laws::NOT_PASSIVE,
    },
    build: |node| Ok(Box::new(DoubleInteraction::read(node)?)),
};

/// A particle above a surface.
pub struct DoubleInteraction {
    above: HalfSpace,
    particle: OrientedParticle,
    distance: f64,
    density: f64,
}

impl DoubleInteraction {
    fn read(node: &ParameterNode) -> Result<Self, ParameterError> {
        let above = HalfSpace::read(node)?;
        let vacuum = ParameterValue::Index(RefractiveIndex::constant(1.0, 0.0));
        let particle = node
            .child("scatterer")
            .clone()
            .with("lambda", ParameterValue::Number(above.common.lambda))
            .and_then(|particle| particle.with("medium", vacuum))
            .and_then(|particle| spec::build::<dyn Scatterer>(&particle))
            .map_err(|error| error.inside("scatterer"))?;
        Ok(Self {
            above,
            particle: OrientedParticle::read(node, particle)?,
            distance: not_negative(node, "distance")?,
            density: not_negative(node, "density")?,
        })
    }

    fn amplitude(&self, incidence: &Incidence, direction: &Direction) -> Jones {
        let Some((i, paths)) = self.above.paths(incidence, direction) else {
            return Jones::default();
        };
        let factor = (self.density / (incidence.cos * direction.cos).abs()).sqrt();
        self.particle.jones(&paths, &i, self.distance).scaled(factor)
    }
}

impl Brdf for DoubleInteraction {
    fn common(&self) -> &CommonParameters {
        &self.above.common
    }

    fn mueller(&self, incidence: &Incidence, direction: &Direction) -> Mueller {
        self.amplitude(incidence, direction).mueller()
    }

    fn jones(&self, incidence: &Incidence, direction: &Direction) -> Option<Jones> {
        Some(self.amplitude(incidence, direction))
    }

    fn is_coherent(&self) -> bool {
        true
    }
}

/// The space above a surface, from which particles are seen by way of its reflection.
pub(super) struct HalfSpace {
    pub common: CommonParameters,
    films: Films,
    n: f64,
    /// Wave number in vacuum.
    k0: f64,
    nudges: bool,
    /// s of a beam along the normal is ŷ.
    normal_is_y: bool,
}

impl HalfSpace {
    pub(super) fn read(node: &ParameterNode) -> Result<Self, ParameterError> {
        let common = CommonParameters::read(node)?;
        let mut films = interface(node, &common, common.substrate)?;
        if common.side != Side::DownUp && node.reproduces(Defect::TinyLoss) {
            films = films.with_tiny_loss();
        }
        Ok(Self {
            films,
            n: common.substrate.re,
            k0: TAU / common.lambda,
            nudges: node.reproduces(Defect::Nudge),
            normal_is_y: node.reproduces(Defect::NormalBasis),
            common,
        })
    }

    /// The paths by way of a particle with their incidence; `None` where no light reaches it.
    pub(super) fn paths(
        &self,
        incidence: &Incidence,
        direction: &Direction,
    ) -> Option<(Incidence, InteractionPaths)> {
        let side = self.common.side;
        let (i, s) = if self.nudges {
            nudged(incidence, direction, side == Side::DownUp)
        } else {
            (*incidence, *direction)
        };
        let incoming = self.outside(i.sin, i.cos, side.from_below())?;
        let outgoing = self.outside(s.sin, s.cos, side.to_below())?;
        let along = |sin: f64, x: f64, y: f64, z: f64| DVec3::new(sin * x, sin * y, z);
        let up = |up: bool, cos: f64| if up { cos } else { -cos };
        let k_i = along(incoming.sin, 1.0, 0.0, up(side.from_below(), incoming.cos));
        let k_s = along(outgoing.sin, s.cos_phi, s.sin_phi, up(!side.to_below(), outgoing.cos));
        let s_out = if self.normal_is_y { s.nists_s() } else { s.s() };
        let mut paths = InteractionPaths::new(
            PolarizedBeam::new(k_i, i.s()),
            PolarizedBeam::new(k_s, s_out),
            self.k0,
        );
        if side.from_below() {
            paths.t_in = self.films.t21(self.films.kappa_inside(i.sin));
        } else {
            paths.before = Some(self.bounce(&incoming));
        }
        match side {
            Side::DownUp | Side::UpUp => paths.after = Some(self.bounce(&outgoing)),
            Side::DownDown => paths.t_out = self.films.t12(outgoing.sin.into()),
            Side::UpDown => paths.t_out = self.films.t21(self.films.kappa_inside(s.sin)),
        }
        paths.scale *= match side {
            Side::DownUp | Side::UpDown => 1.0,
            Side::DownDown => self.n * self.n.sqrt() * s.cos / outgoing.cos,
            Side::UpUp => 1.0 / self.n.sqrt(),
        };
        paths.phase = self.k0 * (incoming.detour + outgoing.detour);
        Some((i, paths))
    }

    /// The same beam outside, where it is not there already.
    fn outside(&self, sin: f64, cos: f64, inside: bool) -> Option<ExternalBeam> {
        if !inside {
            return Some(ExternalBeam { sin, cos, detour: 0.0 });
        }
        let sine = self.n * sin;
        let squared = 1.0 - sine * sine;
        (squared > 0.0).then(|| {
            let cosine = squared.sqrt();
            ExternalBeam { sin: sine, cos: cosine, detour: cosine - self.n * cos }
        })
    }

    fn bounce(&self, beam: &ExternalBeam) -> FaceReflection {
        let r = self.films.r12(Complex64::from(beam.sin));
        FaceReflection { r, phase: 2.0 * self.k0 * beam.cos }
    }
}

/// A beam outside, and by how much its path to a unit height exceeds the one inside.
struct ExternalBeam {
    sin: f64,
    cos: f64,
    detour: f64,
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use crate::{Basis, Geometry, Mode, models};

    fn index(n: f64, k: f64) -> ParameterValue {
        ParameterValue::Index(RefractiveIndex::constant(n, k))
    }

    fn build(mode: Mode, side: i32, substrate: (f64, f64)) -> models::Model {
        let particle = ParameterNode::with_defaults(&crate::scatterer::mie::SPEC.class, mode)
            .with("radius", ParameterValue::Number(0.2))
            .unwrap();
        let node = ParameterNode::with_defaults(&SPEC.class, mode)
            .with("substrate", index(substrate.0, substrate.1))
            .and_then(|node| node.with("type", ParameterValue::Integer(side)))
            .and_then(|node| node.with("distance", ParameterValue::Number(0.3)))
            .and_then(|node| node.with("scatterer", ParameterValue::Member(Arc::new(particle))))
            .unwrap();
        models::build(&node).unwrap()
    }

    fn at(theta_i: f64, theta_s: f64, phi_s: f64) -> Geometry {
        Geometry { theta_i, theta_s, phi_s, rotation: 0.0 }
    }

    #[test]
    fn over_vacuum_reflection_and_transmission_are_those_of_the_lone_particle() {
        let [reflection, transmission] = [0, 1].map(|side| build(Mode::Sound, side, (1.0, 0.0)));
        let sphere = ParameterNode::with_defaults(&crate::scatterer::mie::SPEC.class, Mode::Sound)
            .with("radius", ParameterValue::Number(0.2))
            .unwrap();
        let sphere = spec::build::<dyn Scatterer>(&sphere).unwrap();
        let (k, cosines) = (TAU / 0.532, 0.3f64.cos() * 0.8f64.cos());
        for (model, cos) in [(&reflection, -(1.1f64.cos())), (&transmission, 0.5f64.cos())] {
            let s = sphere.round().unwrap().amplitudes(cos);
            let expected = 0.5 * (s.ss.norm_sqr() + s.pp.norm_sqr()) / (k * k * cosines);
            let got = model.mueller(&at(0.3, 0.8, 0.0), Basis::Psps)[(0, 0)];
            assert!((got / expected - 1.0).abs() < 1e-12, "{got} {expected}");
        }
    }

    #[test]
    fn light_in_and_light_out_change_places() {
        // M₁(θ_i,θ_s,φ) = n² P M₃(θ_s,θ_i,−φ)ᵀ P with P = diag(1,1,−1,1).
        let n = 1.5;
        let [into, out] = [1, 3].map(|side| build(Mode::Sound, side, (n, 0.0)));
        let p = Mueller::diagonal([1.0, 1.0, -1.0, 1.0]);
        for (a, b, phi) in [(0.5, 0.3, 0.7), (1.2, 0.6, -2.0)] {
            let forth = into.mueller(&at(a, b, phi), Basis::Psps);
            let back = out.mueller(&at(b, a, -phi), Basis::Psps);
            let back = p * back.transposed() * p * (n * n);
            assert!((forth - back).largest() < 1e-12 * forth.largest(), "{a} {b} {phi}");
        }
    }

    #[test]
    fn light_that_is_reflected_totally_does_not_reach_the_particle() {
        let model = build(Mode::Sound, 2, (1.5, 0.0));
        assert_eq!(model.mueller(&at(0.9, 0.3, 0.5), Basis::Psps), Mueller::ZERO);
        assert!(model.mueller(&at(0.6, 0.3, 0.5), Basis::Psps)[(0, 0)] > 0.0);
    }

    #[test]
    fn special_directions_are_finite_soundly_and_nudged_in_compat() {
        let [sound, compat] = [Mode::Sound, Mode::Compat].map(|mode| build(mode, 0, (2.1, 0.7)));
        let pi = std::f64::consts::PI;
        for g in [at(0.5, 0.5, 0.0), at(0.4, 0.4, pi), at(0.0, 0.3, 0.4), at(0.0, 0.0, 0.0)] {
            let (a, b) = (sound.mueller(&g, Basis::Psps), compat.mueller(&g, Basis::Psps));
            let difference = (a - b).largest() / a.largest();
            // First order in the nudge, or second at the normal.
            assert!(difference > 1e-11 && difference < 1e-3, "{g:?}: {difference}");
            let aside = Geometry { theta_s: g.theta_s + 1e-8, ..g };
            let aside = sound.mueller(&aside, Basis::Psps);
            assert!((a[(0, 0)] / aside[(0, 0)] - 1.0).abs() < 1e-6);
        }
    }
}
