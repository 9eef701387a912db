//! A body of revolution, its axis upright, on the smooth face of a substrate, or in the substrate
//! against its face.
//!
//! As [`bobbert_vlieger`](super::bobbert_vlieger), with the [T-matrix](crate::tmatrix) of the body
//! in place of the Mie coefficients. The body rests on its lowest node, `delta` over the face;
//! `lmax` = 0 stands for ⌊x + 4.05x^{0.3333} + 2⌋, x that of the farthest node.
//!
//! P. C. Waterman, Phys. Rev. D 3, 825 (1971); P. A. Bobbert and J. Vlieger, Physica A 137, 209
//! (1986).

use super::{
    LOCAL,
    supported::{SubstrateFace, SupportedParticle, interaction},
};
use crate::{
    Defect, ParameterError, ParameterNode,
    models::{Brdf, COMMON, smooth_interface::INTERFACE},
    shape::Shape,
    spec::{Class, Laws, Parameter, Spec},
    tmatrix::{
        self, BODY, MULTIPOLES,
        converged::{self, Orders},
    },
};

const EQUATION: &str = "F = N/(cos_i cos_s) M(J), J = -i sum W Z e^(i m phi), W = (T^-1 - A)^-1 V";
const SOURCE: &str = "waterman-1971 bobbert-vlieger-1986 mishchenko-2002";

/// Interchange of beams holds up to the number of nodes of the image's integral only.
const LAWS: Laws = Laws { reciprocal: false, ..Laws::NOT_PASSIVE };

const PARAMS: &[&[Parameter]] = &[
    COMMON,
    LOCAL,
    &BODY,
    INTERFACE,
    &[Parameter::number("delta", 0.0, "um", "Gap between the particle and the face")],
    &MULTIPOLES,
    &interaction("Interaction with the face: 0 none, any other number exact, as NIST's library"),
];

/// Name, parameters and constructor of a body of revolution on a substrate.
pub const SPEC: Spec<dyn Brdf> = Spec {
    class: Class {
        name: "Axisymmetric_Particle_BRDF_Model",
        parent: "Local_BRDF_Model",
        summary: "Body of revolution on a smooth surface, with all their interaction",
        equation: EQUATION,
        source: SOURCE,
        params: PARAMS,
        laws: LAWS,
    },
    build: |node| Ok(Box::new(build(node, false)?)),
};

/// Name, parameters and constructor of a body of revolution in a substrate.
pub const SUBSURFACE: Spec<dyn Brdf> = Spec {
    class: Class {
        name: "Subsurface_Axisymmetric_Particle_BRDF_Model",
        parent: "Local_BRDF_Model",
        summary: "Body of revolution in the substrate against its face, with all their interaction",
        equation: EQUATION,
        source: SOURCE,
        params: PARAMS,
        laws: LAWS,
    },
    build: |node| Ok(Box::new(build(node, true)?)),
};

fn build(node: &ParameterNode, buried: bool) -> Result<SupportedParticle, ParameterError> {
    let ground = SubstrateFace::read(node, buried)?.without_series();
    let shape = node.member::<Shape>("Shape")?;
    let index = node.index("particle").at(ground.common().lambda);
    if !(index.norm() > 0.0 && index.is_finite()) {
        return Err(ParameterError::new(
            "particle",
            format!("{index} is not an index of refraction"),
        ));
    }
    let relative = index / ground.medium;
    if !node.reproduces(Defect::ImageNodes) {
        let (k, m_max) = (ground.k, tmatrix::m_max(node)?);
        let orders = Orders::of_body(node, k * shape.reach())?;
        if m_max < orders.start() {
            node.reproduces(Defect::AxisymmetricIndex);
        }
        if m_max == 1 {
            node.reproduces(Defect::SingleOrder);
        }
        let height = shape.spheroid().map_or(shape.height(), |spheroid| spheroid.vertical);
        let centre = height + ground.distance();
        let orders = if shape.reach() > centre {
            orders.asymptotic(into_face(&shape, centre))
        } else {
            orders
        };
        let particle = |level| {
            let particle = converged::at_level(node, &shape, relative, k, m_max, level)?;
            Some((particle, height))
        };
        return SupportedParticle::converged(ground, node, &orders, particle);
    }
    let particle = tmatrix::read(node, &shape, relative, ground.k)?;
    if particle.m_max() == 1 {
        // Defect::SingleOrder: nothing can be inverted.
        return Err(ParameterError::new(
            "mmax",
            "NIST's library has no answer for orders up to m = 1: its matrix has no inverse",
        ));
    }
    let (l_max, incomplete) = (particle.l_max, particle.m_max() < particle.l_max);
    let supported = SupportedParticle::as_the_library(ground, &particle, shape.height(), l_max)?;
    if incomplete && node.reproduces(Defect::AxisymmetricIndex) {
        return Ok(supported.mispairing());
    }
    Ok(supported)
}

/// The remedy for a body whose surrounding sphere reaches into the face.
fn into_face(shape: &Shape, centre: f64) -> String {
    let reach = shape.reach();
    format!(
        "its multipoles meet those of its image, which need not converge where the sphere of \
         {reach:.4} um around its origin reaches into the face {centre:.4} um below: a delta that is \
         larger by {:.4} um, or a rounder body, converges",
        reach - centre
    )
}
