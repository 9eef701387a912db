//! The body of a coating: spherical particles in a binder over a backing.
//!
//! N particles per volume with the cross-sections C of [`crate::scatterer`] in the binder give the
//! optical depth N C_ext L, the albedo C_sca/C_ext and the asymmetry g = ⟨cos⟩ of adding and
//! doubling, or the coefficients K = 2 N C_abs and S = ¾ N C_sca (1 − g) of Kubelka and Munk. These
//! hold for diffuse light; for a dark body that scatters forwards they are up to a fifth too bright.
//!
//! P. Kubelka and F. Munk, Z. Tech. Phys. 12, 593 (1931); C. F. Bohren and D. R. Huffman,
//! *Absorption and Scattering of Light by Small Particles* (Wiley, 1983).

use std::sync::Arc;

use super::doubling::{self, DiffuseSlab};
use crate::{
    ParameterError, ParameterNode, ParameterValue,
    optics::{RealFunction, RefractiveIndex},
    reflectance::{self, Reflectance},
    scatterer::{Scatterer, SphericalScatterer, positive},
    spec,
    special::gauss,
};

/// Largest volume fraction of spheres of one size (densest packing, rounded).
const DENSEST: f64 = 0.74;

/// The body of `node` inside a binder of index `binder`.
pub(super) fn read(
    node: &ParameterNode,
    lambda: f64,
    binder: f64,
) -> Result<DiffuseSlab, ParameterError> {
    let backing = reflectance::read(node, "backing", lambda)?;
    if !(0.0..=1.0).contains(&backing) {
        return Err(ParameterError::new("backing", format!("{backing} is not from 0 to 1")));
    }
    let (density, thickness) =
        (nonnegative(node, "particle_density")?, nonnegative(node, "thickness")?);
    if density == 0.0 || thickness == 0.0 {
        return Ok(DiffuseSlab::uniform(backing));
    }
    let radius = positive(node, "particle_radius")?;
    let filled = filled(node);
    if filled > DENSEST {
        let problem =
            format!("{density} 1/um^3 fill {filled} of the volume; {DENSEST} is the most");
        return Err(ParameterError::new("particle_density", problem));
    }
    let particle = particle(node, lambda, binder, radius)?;
    let round = particle.round();
    let (round, sections) = round
        .and_then(|round| Some((round, round.cross_sections()?)))
        .ok_or_else(|| ParameterError::new("particle", "a sphere with cross-sections is needed"))?;
    let (extinction, scattering) =
        (sections.extinction, sections.scattering.min(sections.extinction));
    if !(extinction > 0.0) {
        return Ok(DiffuseSlab::uniform(backing));
    }
    let g = if scattering > 0.0 { asymmetry(round, radius) } else { 0.0 };
    match node.integer("albedo") {
        0 => Ok(doubling::slab(
            density * extinction * thickness,
            scattering / extinction,
            g,
            backing,
        )),
        1 => kubelka_munk(
            2.0 * density * (extinction - scattering),
            0.75 * density * scattering * (1.0 - g),
            thickness,
            backing,
        )
        .map(DiffuseSlab::uniform),
        other => Err(ParameterError::new("albedo", format!("{other} is not 0 or 1"))),
    }
}

/// The part of the volume that the particles of `node` fill.
pub(super) fn filled(node: &ParameterNode) -> f64 {
    let radius = node.number("particle_radius");
    node.number("particle_density") * 4.0 / 3.0 * std::f64::consts::PI * radius.powi(3)
}

/// The number `name`, which must not be negative.
pub(super) fn nonnegative(node: &ParameterNode, name: &str) -> Result<f64, ParameterError> {
    let x = node.number(name);
    if x >= 0.0 && x.is_finite() {
        return Ok(x);
    }
    Err(ParameterError::new(name, format!("{x} is negative or not finite")))
}

/// The particle in the binder: its own wavelength, medium and radius are those of the coating.
fn particle(
    node: &ParameterNode,
    lambda: f64,
    binder: f64,
    radius: f64,
) -> Result<Box<dyn Scatterer>, ParameterError> {
    let inside = node
        .child("particle")
        .clone()
        .with("lambda", ParameterValue::Number(lambda))
        .and_then(|p| {
            p.with("medium", ParameterValue::Index(RefractiveIndex::constant(binder, 0.0)))
        })
        .and_then(|p| p.with("radius", ParameterValue::Number(radius)));
    inside
        .and_then(|particle| spec::build::<dyn Scatterer>(&particle))
        .map_err(|error| error.inside("particle"))
}

/// ⟨cos⟩ of the scattered light.
fn asymmetry(round: &dyn SphericalScatterer, radius: f64) -> f64 {
    // The intensity is a polynomial of about twice the size parameter in cos θ.
    let orders = round.surroundings().wave_number() * radius;
    let nodes = 32 + (2.0 * orders + 8.0 * orders.cbrt()) as usize;
    let (mut sum, mut along) = (0.0, 0.0);
    for (cos, weight) in gauss::legendre(nodes, -1.0, 1.0) {
        let s = round.amplitudes(cos);
        let intensity = weight * (s.ss.norm_sqr() + s.pp.norm_sqr());
        sum += intensity;
        along += cos * intensity;
    }
    along / sum
}

fn kubelka_munk(k: f64, s: f64, thickness: f64, backing: f64) -> Result<f64, ParameterError> {
    let table = |x: f64| ParameterValue::Table(RealFunction::constant(x));
    let ground = ParameterNode::with_defaults(&reflectance::table::SPEC.class, Default::default())
        .with("table", table(backing))?;
    let node =
        ParameterNode::with_defaults(&reflectance::kubelka_munk::SPEC.class, Default::default())
            .with("thickness", ParameterValue::Number(thickness))?
            .with("absorption", table(k))?
            .with("scattering", table(s))?
            .with("substrate", ParameterValue::Member(Arc::new(ground)))?;
    Ok(spec::build::<dyn Reflectance>(&node)?.at(1.0))
}
