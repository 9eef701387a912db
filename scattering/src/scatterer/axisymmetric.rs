//! Body of revolution in free space, by its T-matrix.
//!
//! The axis is z; the pole θ = 0 of the shape is at −z, as for a particle on a surface. See
//! [`tmatrix`](crate::tmatrix) and [`waves`](crate::tmatrix::waves).
//!
//! The amplitudes depend on the difference of the azimuths of both beams about the axis. NIST's
//! library takes the azimuth of the scattered beam alone ([`Defect::IncidentAzimuth`]): right only
//! for light that travels in the half plane of azimuth 0. It pairs harmonics above m_max wrongly
//! ([`Defect::AxisymmetricIndex`]).
//!
//! P. C. Waterman, Phys. Rev. D 3, 825 (1971).

use std::f64::consts::TAU;

use glam::DVec3;
use num_complex::Complex64;

use super::{FREE_SPACE, HostMedium, Scatterer};
use crate::{
    Defect, Jones, ParameterNode,
    polarization::TransverseFrame,
    shape::Shape,
    spec::{Class, Laws, ParameterError, Spec},
    special::harmonics::Harmonics,
    tmatrix::{
        self, BODY, MULTIPOLES, TMatrix, mispairing,
        waves::{self, MirroredWave, Multipole, OutgoingMultipoles},
    },
};

/// Name, parameters and constructor of a body of revolution.
pub const SPEC: Spec<dyn Scatterer> = Spec {
    class: Class {
        name: "TMatrix_Axisymmetric_Scatterer",
        parent: "Free_Space_Scatterer",
        summary: "Body of revolution",
        equation: "T = -RgQ Q^-1",
        source: "waterman-1971 mishchenko-2002",
        params: &[FREE_SPACE, &BODY, &MULTIPOLES],
        laws: Laws::NONE,
    },
    build: |node| Ok(Box::new(AxisymmetricScatterer::read(node)?)),
};

/// A body of revolution.
pub struct AxisymmetricScatterer {
    around: HostMedium,
    particle: TMatrix,
    harmonics: Harmonics,
    /// The incident light counts as if it travelled at azimuth 0.
    forgets_azimuth: bool,
    /// Harmonics above m_max are paired wrongly.
    mispairs: bool,
}

impl AxisymmetricScatterer {
    fn read(node: &ParameterNode) -> Result<Self, ParameterError> {
        let around = HostMedium::read(node)?;
        let shape = node.member::<Shape>("Shape")?;
        let index = around.relative_index(node, "particle")?;
        let particle = tmatrix::read(node, &shape, index, around.wave_number())?;
        let harmonics = Harmonics::new(particle.l_max, particle.m_max());
        let forgets_azimuth = node.reproduces(Defect::IncidentAzimuth);
        let incomplete = particle.m_max() < particle.l_max;
        let mispairs = incomplete && node.reproduces(Defect::AxisymmetricIndex);
        Ok(Self { around, particle, harmonics, forgets_azimuth, mispairs })
    }
}

impl Scatterer for AxisymmetricScatterer {
    fn lambda(&self) -> f64 {
        self.around.lambda
    }

    fn medium(&self) -> Complex64 {
        self.around.medium
    }

    fn jones(
        &self,
        k_in: DVec3,
        k_out: DVec3,
        frame_in: &TransverseFrame,
        frame_out: &TransverseFrame,
    ) -> Jones {
        let (incoming, outgoing) = (AxisDirection::new(k_in), AxisDirection::new(k_out));
        let regular =
            waves::regular(&self.harmonics, &MirroredWave::free(incoming.cos, incoming.sin));
        let scattered = self.particle.answer(&regular);
        let scattered = if self.mispairs {
            mispairing::outside(&scattered, &self.harmonics)
        } else {
            OutgoingMultipoles::symmetric(scattered.into_iter())
        };
        let from = if self.forgets_azimuth { 0.0 } else { incoming.azimuth };
        let turn = outgoing.azimuth - from;
        // The library counts the azimuth from x towards y, which its pairing is not blind to.
        let side = if self.mispairs { -1.0 } else { 1.0 };
        let azimuth = (turn.cos(), side * turn.sin());
        let beam = MirroredWave::free(outgoing.cos, outgoing.sin);
        let j = scattered.amplitude(&self.harmonics, &beam, azimuth);
        let j = if self.mispairs { j.flipped() } else { j };
        outgoing.frame().to(frame_out) * j * frame_in.to(&incoming.frame())
    }
}

/// A direction in polar coordinates about the axis down.
struct AxisDirection {
    cos: f64,
    sin: f64,
    /// Counted from x towards −y.
    azimuth: f64,
}

impl AxisDirection {
    fn new(k: DVec3) -> Self {
        let sin = k.x.hypot(k.y);
        let azimuth = if sin == 0.0 { 0.0 } else { (-k.y).atan2(k.x).rem_euclid(TAU) };
        Self { cos: -k.z, sin, azimuth }
    }

    /// (φ̂, θ̂), which take the places of s and p.
    fn frame(&self) -> TransverseFrame {
        let (s, c) = self.azimuth.sin_cos();
        TransverseFrame {
            first: DVec3::new(-s, -c, 0.0),
            second: DVec3::new(self.cos * c, -self.cos * s, self.sin),
        }
    }
}

impl TMatrix {
    /// (m, l, w) for regular waves in the order of [`Harmonics::visit`].
    fn answer(&self, regular: &[Multipole]) -> Vec<(usize, usize, Multipole)> {
        let mut out = Vec::new();
        let mut start = 0;
        for (m, block) in self.blocks.iter().enumerate() {
            let size = block.nrows() / 2;
            tmatrix::apply(block, &regular[start..start + size], size, |row, w| {
                out.push((m, Harmonics::l_min(m) + row, w));
            });
            start += size;
        }
        out
    }
}

#[cfg(test)]
mod tests {
    use glam::DMat3;

    use super::*;
    use crate::{Mode, ParameterValue, spec};

    fn particle(vertical: f64, horizontal: f64) -> Box<dyn Scatterer> {
        built(vertical, horizontal, Mode::Sound)
    }

    fn built(vertical: f64, horizontal: f64, mode: Mode) -> Box<dyn Scatterer> {
        let shape = ParameterNode::with_defaults(&crate::shape::ellipsoid::SPEC.class, Mode::Sound)
            .with("vertical", ParameterValue::Number(vertical))
            .and_then(|node| node.with("horizontal", ParameterValue::Number(horizontal)))
            .unwrap();
        let node = ParameterNode::with_defaults(&SPEC.class, mode)
            .with("Shape", ParameterValue::Member(shape.into()))
            .unwrap();
        spec::build::<dyn Scatterer>(&node).unwrap()
    }

    fn jones(particle: &dyn Scatterer, k_in: DVec3, k_out: DVec3) -> Jones {
        particle.jones(k_in, k_out, &TransverseFrame::psps(k_in), &TransverseFrame::psps(k_out))
    }

    fn largest(a: &Jones, b: &Jones) -> f64 {
        [a.ss - b.ss, a.ps - b.ps, a.sp - b.sp, a.pp - b.pp]
            .iter()
            .map(|z| z.norm())
            .fold(0.0, f64::max)
    }

    #[test]
    fn a_round_one_is_the_sphere_of_mie() {
        let class = &super::super::mie::SPEC.class;
        let node = ParameterNode::with_defaults(class, Mode::Sound)
            .with("radius", ParameterValue::Number(0.1))
            .unwrap();
        let sphere = spec::build::<dyn Scatterer>(&node).unwrap();
        let body = particle(0.1, 0.1);
        for (a, b) in [
            (DVec3::new(0.6, 0.0, -0.8), DVec3::new(0.48, 0.64, 0.6)),
            (DVec3::new(0.0, 0.0, -1.0), DVec3::new(-0.48, 0.64, -0.6)),
            (DVec3::new(-0.64, 0.6, 0.48), DVec3::new(0.0, 0.0, 1.0)),
        ] {
            let (got, expected) = (jones(&*body, a, b), jones(&*sphere, a, b));
            // The rule for the number of multipoles leaves out others than Mie's.
            assert!(largest(&got, &expected) < 1e-6 * (expected.ss.norm() + expected.ps.norm()));
        }
    }

    #[test]
    fn reversed_light_takes_the_same_path() {
        // S(−k_s, −k_i) is the transpose of S(k_i, k_s) with the signs of psps.
        let body = particle(0.15, 0.1);
        let (a, b) = (DVec3::new(0.6, 0.0, -0.8), DVec3::new(0.48, 0.64, 0.6));
        let (forth, back) = (jones(&*body, a, b), jones(&*body, -b, -a));
        let expected = Jones { ps: -back.sp, sp: -back.ps, ..back };
        // T is symmetric up to the multipoles that are cut off.
        let difference = largest(&forth, &expected) / forth.ss.norm();
        assert!(difference < 1e-5, "{difference:e}");
    }
    #[test]
    fn turning_both_beams_about_the_axis_changes_nothing_but_under_compat() {
        let (a, b) = (DVec3::new(0.6, 0.0, -0.8), DVec3::new(0.48, 0.64, 0.6));
        let turn = DMat3::from_rotation_z(0.7);
        for (mode, kept) in [(Mode::Sound, true), (Mode::Compat, false)] {
            let body = built(0.15, 0.1, mode);
            let (here, there) = (jones(&*body, a, b), jones(&*body, turn * a, turn * b));
            let difference = largest(&here, &there) / here.ss.norm();
            assert_eq!(difference < 1e-12, kept, "{mode:?}: {difference:e}");
            // Light at azimuth 0 meets no defect.
            let sound = jones(&*built(0.15, 0.1, Mode::Sound), a, b);
            // The orders differ by their truncation errors.
            assert!(largest(&here, &sound) < 1e-6 * sound.ss.norm());
        }
    }
}
