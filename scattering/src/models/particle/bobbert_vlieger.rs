//! A sphere on the smooth face of a substrate, or in the substrate against its face.
//!
//! The exact interaction of the multipoles of the sphere (Mie coefficients, coats included) with
//! their image in the face; see [`supported`](super) for the equations. The sum runs to
//! L = ⌊x + 4x^{0.3333} + 2⌋ − `lmax` for `lmax` ≤ 0 and to `lmax` otherwise, x = 2πr/λ. The
//! sphere rests at the height `delta` over the face.
//!
//! P. A. Bobbert and J. Vlieger, *Light scattering by a sphere on a substrate*, Physica A 137,
//! 209 (1986); J. H. Kim, S. H. Ehrman, G. W. Mulholland and T. A. Germer, Appl. Opt. 41, 5405
//! (2002).

use super::{
    LOCAL,
    supported::{SubstrateFace, SupportedParticle, interaction},
};
use crate::{
    Defect, ParameterError, ParameterNode,
    models::{Brdf, COMMON, smooth_interface::INTERFACE},
    scatterer::{layered, positive, series},
    spec::{Class, Laws, Parameter, Spec},
    stack::{self, Stack},
    tmatrix::{
        TMatrix,
        converged::{Level, Orders},
        l_max,
    },
};

const EQUATION: &str = "F = N/(cos_i cos_s) M(J), J = -i sum W Z e^(i m phi), W = (B^-1 - A)^-1 V";
const SOURCE: &str = "bobbert-vlieger-1986 kim-2002";

/// Interchange of beams holds up to the number of nodes of the image's integral only.
const LAWS: Laws = Laws { reciprocal: false, ..Laws::NOT_PASSIVE };

const PARAMS: &[&[Parameter]] = &[
    COMMON,
    LOCAL,
    &[
        Parameter::index("sphere", (1.59, 0.0), "Index of the sphere"),
        Parameter::number("radius", 0.05, "um", "Outer radius of the sphere"),
        Parameter::member(
            "spherecoat",
            &stack::FAMILY,
            "No_StackModel",
            "Coats within the radius, the innermost first",
        ),
    ],
    INTERFACE,
    &[
        Parameter::number("delta", 0.0, "um", "Gap between the sphere and the face"),
        Parameter::integer(
            "lmax",
            0,
            "Largest l: 0 as the size needs, -n that and n more, n just n",
        ),
    ],
    &interaction("Interaction with the face: -1 exact, 0 none, n the first n terms of a series"),
];

/// Name, parameters and constructor of a sphere on a substrate.
pub const SPEC: Spec<dyn Brdf> = Spec {
    class: Class {
        name: "Bobbert_Vlieger_BRDF_Model",
        parent: "Local_BRDF_Model",
        summary: "Sphere on a smooth surface, with all their interaction",
        equation: EQUATION,
        source: SOURCE,
        params: PARAMS,
        laws: LAWS,
    },
    build: |node| Ok(Box::new(build(node, false)?)),
};

/// Name, parameters and constructor of a sphere in a substrate.
pub const SUBSURFACE: Spec<dyn Brdf> = Spec {
    class: Class {
        name: "Subsurface_Bobbert_Vlieger_BRDF_Model",
        parent: "Local_BRDF_Model",
        summary: "Sphere in the substrate against its smooth face, with all their interaction",
        equation: EQUATION,
        source: SOURCE,
        params: PARAMS,
        laws: LAWS,
    },
    build: |node| Ok(Box::new(build(node, true)?)),
};

fn build(node: &ParameterNode, buried: bool) -> Result<SupportedParticle, ParameterError> {
    let ground = SubstrateFace::read(node, buried)?;
    let lambda = ground.common().lambda;
    let radius = positive(node, "radius")?;
    let relative = |name: &str, n: num_complex::Complex64| {
        if n.norm() > 0.0 && n.is_finite() {
            return Ok(n / ground.medium);
        }
        Err(ParameterError::new(name, format!("{n} is not an index of refraction")))
    };
    let coats = node.member::<Stack>("spherecoat")?.at(lambda);
    let mut r = radius - coats.iter().map(|coat| coat.1).sum::<f64>();
    if r < 0.0 || r.is_nan() {
        return Err(ParameterError::new("spherecoat", format!("does not fit in {radius} um")));
    }
    let mut layers = vec![(relative("sphere", node.index("sphere").at(lambda))?, ground.k * r)];
    for (index, thickness) in coats {
        r += thickness;
        layers.push((relative("spherecoat", index)?, ground.k * r));
    }
    let needed = series::terms(ground.k * radius);
    let sphere = |l_max: usize| TMatrix::sphere(&layered::coefficients(&layers, l_max));
    if !node.reproduces(Defect::ImageNodes) {
        let orders = Orders::read(node, needed)?;
        let particle = |level: Level| Some((sphere(level.l_max), radius));
        return SupportedParticle::converged(ground, node, &orders, particle);
    }
    let l_max = l_max(node, needed)?;
    SupportedParticle::as_the_library(ground, &sphere(l_max), radius, needed)
}
