//! A particle in the substrate, below its smooth face.
//!
//! Light crosses the (filmed) face, is scattered by the particle in the medium of the substrate and
//! crosses the face again. Light inside the substrate reaches and leaves the particle also after a
//! reflection at the face, with the phase 2k₀nd cos θ of the longer path at the depth d:
//!
//! | type | J k₀n |
//! |---|---|
//! | 0 | t12(θ_s) S t12(θ_i) |
//! | 1 | [S(k_i',k_s) + r21(θ_s) S(k_i',k_s^r)] t12(θ_i) √n |
//! | 2 | all four paths |
//! | 3 | t21(θ_s) (cos θ_s/c_s' n^{−3/2}) [S(k_i,k_s') + S(k_i^r,k_s') r21(θ_i)] |
//!
//! F = N M(J)/(cos θ_i cos θ_s). Light of the particle that the face reflects back to it is
//! neglected, and so is the light of other particles. The surroundings of `scatterer` have to be those of the model.
//!
//! T. A. Germer, *Polarized light scattering by microroughness and small defects in dielectric
//! layers*, J. Opt. Soc. Am. A 18, 1279 (2001).

use std::f64::consts::TAU;

use glam::DVec3;

use super::{
    LOCAL,
    paths::{
        FaceReflection, InteractionPaths, ORIENTATION, OrientedParticle, PolarizedBeam, nudged,
    },
    small_sphere::not_negative,
};
use crate::{
    Defect, Direction, Incidence, Jones, Mueller, ParameterError, ParameterNode, Side,
    models::{
        Brdf, COMMON, CommonParameters,
        smooth_interface::{INTERFACE, interface},
    },
    optics::film::{Films, SpAmplitudes},
    scatterer::{self, Scatterer},
    spec::{Class, Laws, Parameter, Spec},
};

/// Name, parameters and constructor of a [`SubsurfaceParticle`].
pub const SPEC: Spec<dyn Brdf> = Spec {
    class: Class {
        name: "Subsurface_Particle_BRDF_Model",
        parent: "Local_BRDF_Model",
        summary: "Particle in the substrate, below its smooth face",
        equation: "F = N/(cos_i cos_s) M(J), J = t12(ts) S(ki',ks') t12(ti)/(k0 n)",
        source: "germer-2001-layers",
        params: &[
            COMMON,
            LOCAL,
            INTERFACE,
            &[
                Parameter::number("depth", 0.0, "um", "Depth of the particle below the face"),
                Parameter::member(
                    "scatterer",
                    &scatterer::FAMILY,
                    "MieScatterer",
                    "The particle, with the model's lambda in the substrate as its medium",
                ),
                ORIENTATION[0],
                ORIENTATION[1],
            ],
        ],
        laws: Laws::NOT_PASSIVE,
    },
    build: |node| Ok(Box::new(SubsurfaceParticle::read(node)?)),
};

/// A particle in the substrate.
pub struct SubsurfaceParticle {
    common: CommonParameters,
    films: Films,
    particle: OrientedParticle,
    depth: f64,
    density: f64,
    n: f64,
    /// Wave number in the substrate.
    k: f64,
    nudges: bool,
    /// s of a beam along the normal is ŷ.
    normal_is_y: bool,
}

impl SubsurfaceParticle {
    fn read(node: &ParameterNode) -> Result<Self, ParameterError> {
        let common = CommonParameters::read(node)?;
        let n = common.substrate;
        if n.im != 0.0 {
            return Err(ParameterError::new("substrate", format!("absorbs (k = {})", n.im)));
        }
        let particle = node.member::<dyn Scatterer>("scatterer")?;
        if particle.lambda() != common.lambda {
            let problem = format!("{} um is not the model's {}", particle.lambda(), common.lambda);
            return Err(ParameterError::new("scatterer.lambda", problem));
        }
        if particle.medium().re != n.re {
            let problem = format!("{} is not the substrate's {}", particle.medium().re, n.re);
            return Err(ParameterError::new("scatterer.medium", problem));
        }
        let mut films = interface(node, &common, n)?;
        if common.side != Side::DownUp && node.reproduces(Defect::TinyLoss) {
            films = films.with_tiny_loss();
        }
        Ok(Self {
            films,
            particle: OrientedParticle::read(node, particle)?,
            depth: not_negative(node, "depth")?,
            density: not_negative(node, "density")?,
            n: n.re,
            k: TAU * n.re / common.lambda,
            nudges: node.reproduces(Defect::Nudge),
            normal_is_y: node.reproduces(Defect::NormalBasis),
            common,
        })
    }

    /// The direction inside of light outside, or nothing where the light is reflected totally.
    fn refracted(&self, k: DVec3) -> Option<DVec3> {
        let (x, y) = (k.x / self.n, k.y / self.n);
        let squared = 1.0 - x * x - y * y;
        (squared > 0.0).then(|| DVec3::new(x, y, squared.sqrt().copysign(k.z)))
    }

    fn bounce(&self, sin: f64, cos: f64) -> FaceReflection {
        let r = self.films.r21(self.films.kappa_inside(sin));
        FaceReflection { r, phase: 2.0 * self.k * cos }
    }

    fn paths(&self, incidence: &Incidence, direction: &Direction) -> Option<InteractionPaths> {
        let side = self.common.side;
        let (k_i, k_s) = crate::geometry::propagation(side, incidence, direction);
        let inside_i = if side.from_below() { k_i } else { self.refracted(k_i)? };
        let inside_s = if side.to_below() { k_s } else { self.refracted(k_s)? };
        let s_out = if self.normal_is_y { direction.nists_s() } else { direction.s() };
        let (incoming, outgoing) =
            (PolarizedBeam::new(inside_i, incidence.s()), PolarizedBeam::new(inside_s, s_out));
        let mut paths = InteractionPaths::new(incoming, outgoing, self.k);
        if side.from_below() {
            paths.before = Some(self.bounce(incidence.sin, incidence.cos));
        } else {
            paths.t_in = self.films.t12(incidence.sin.into());
        }
        if side.to_below() {
            paths.after = Some(self.bounce(direction.sin, direction.cos));
        } else {
            paths.t_out = self.leaving(side, direction);
        }
        paths.scale *= match side {
            Side::DownUp | Side::UpDown => 1.0,
            Side::DownDown => self.n.sqrt(),
            Side::UpUp => direction.cos / (inside_s.z * self.n * self.n.sqrt()),
        };
        Some(paths)
    }

    /// Amplitudes that leave through the face; type 0 writes t21 by the reversed path.
    fn leaving(&self, side: Side, direction: &Direction) -> SpAmplitudes {
        match side {
            Side::UpUp => self.films.t21(direction.sin.into()),
            _ => self.films.t12(direction.sin.into()),
        }
    }

    fn amplitude(&self, incidence: &Incidence, direction: &Direction) -> Jones {
        let (i, s) =
            if self.nudges { nudged(incidence, direction, true) } else { (*incidence, *direction) };
        let Some(paths) = self.paths(&i, &s) else { return Jones::default() };
        let factor = (self.density / (incidence.cos * direction.cos).abs()).sqrt();
        self.particle.jones(&paths, &i, self.depth).scaled(factor)
    }
}

impl Brdf for SubsurfaceParticle {
    fn common(&self) -> &CommonParameters {
        &self.common
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

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use crate::{Basis, Geometry, Mode, ParameterValue, models, optics::RefractiveIndex};

    fn node(mode: Mode, side: i32, n: f64, depth: f64) -> ParameterNode {
        let index = |n, k| ParameterValue::Index(RefractiveIndex::constant(n, k));
        let particle = ParameterNode::with_defaults(&crate::scatterer::mie::SPEC.class, mode)
            .with("medium", index(n, 0.0))
            .and_then(|node| node.with("radius", ParameterValue::Number(0.2)))
            .and_then(|node| node.with("sphere", index(1.3, 0.05)))
            .unwrap();
        ParameterNode::with_defaults(&SPEC.class, mode)
            .with("substrate", index(n, 0.0))
            .and_then(|node| node.with("type", ParameterValue::Integer(side)))
            .and_then(|node| node.with("depth", ParameterValue::Number(depth)))
            .and_then(|node| node.with("scatterer", ParameterValue::Member(Arc::new(particle))))
            .unwrap()
    }

    fn at(theta_i: f64, theta_s: f64, phi_s: f64) -> Geometry {
        Geometry { theta_i, theta_s, phi_s, rotation: 0.0 }
    }

    #[test]
    fn in_a_substrate_like_vacuum_only_the_particle_scatters() {
        let model = models::build(&node(Mode::Sound, 0, 1.0, 0.4)).unwrap();
        let g = at(0.3, 0.8, 0.0);
        let particle =
            crate::spec::build::<dyn Scatterer>(node(Mode::Sound, 0, 1.0, 0.4).child("scatterer"))
                .unwrap();
        let s = particle.round().unwrap().amplitudes(-(1.1f64.cos()));
        let k = TAU / 0.532;
        let expected =
            0.5 * (s.ss.norm_sqr() + s.pp.norm_sqr()) / (k * k * 0.3f64.cos() * 0.8f64.cos());
        let got = model.mueller(&g, Basis::Psps)[(0, 0)];
        assert!((got / expected - 1.0).abs() < 1e-12, "{got} {expected}");
    }

    #[test]
    fn light_in_and_light_out_change_places() {
        // M₁(θ_i,θ_s,φ) = n² P M₃(θ_s,θ_i,−φ)ᵀ P with P = diag(1,1,−1,1).
        let n = 1.5;
        let [into, out] =
            [1, 3].map(|side| models::build(&node(Mode::Sound, side, n, 0.3)).unwrap());
        let p = Mueller::diagonal([1.0, 1.0, -1.0, 1.0]);
        for (a, b, phi) in [(0.5, 0.3, 0.7), (1.2, 0.9, -2.0), (0.0, 0.4, 1.0)] {
            let forth = into.mueller(&at(a, b, phi), Basis::Psps);
            let rotation = std::f64::consts::PI - phi;
            let back = Geometry { theta_i: b, theta_s: a, phi_s: -phi, rotation };
            let back = p * out.mueller(&back, Basis::Psps).transposed() * p * (n * n);
            assert!((forth - back).largest() < 1e-12 * forth.largest(), "{a} {b} {phi}");
        }
    }

    #[test]
    fn the_specular_direction_is_nudged_in_compat_only() {
        let [sound, compat] = [Mode::Sound, Mode::Compat]
            .map(|mode| models::build(&node(mode, 0, 1.5, 0.3)).unwrap());
        let f = |model: &models::Model, theta_s| model.mueller(&at(0.5, theta_s, 0.0), Basis::Psps);
        let difference = |a: Mueller, b: Mueller| (a - b).largest() / a.largest();
        assert!(difference(f(&sound, 0.5), f(&compat, 0.5)) > 1e-7);
        // The sound series of the sphere has a few terms more.
        assert!(difference(f(&sound, 0.6), f(&compat, 0.6)) < 1e-8);
        // The result is continuous: 1e-9 rad from the specular direction changes as much.
        assert!(difference(f(&sound, 0.5), f(&sound, 0.5 + 1e-9)) < 1e-7);
    }

    #[test]
    fn a_particle_in_another_medium_is_refused() {
        let index = ParameterValue::Index(RefractiveIndex::constant(1.6, 0.0));
        let wrong = node(Mode::Sound, 0, 1.5, 0.0).with("substrate", index).unwrap();
        assert_eq!((SPEC.build)(&wrong).err().unwrap().parameter, "scatterer.medium");
        let wrong =
            node(Mode::Sound, 0, 1.5, 0.0).with("lambda", ParameterValue::Number(0.6)).unwrap();
        assert_eq!((SPEC.build)(&wrong).err().unwrap().parameter, "scatterer.lambda");
    }
}
