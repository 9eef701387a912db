//! A slab of a paint: a binder with particles and flakes under its upper face.
//!
//! A slab of thickness 0 is not there, neither is its face. The binder's index is real for
//! refraction; its k absorbs. Particles lie in the binder: their wavelength and medium are set by
//! the slab.

use std::{f64::consts::PI, sync::Arc};

use super::{
    paint_face::{self, PaintFace},
    paint_flakes::{self, PaintFlakes},
};
use crate::{
    ParameterError, ParameterNode, ParameterValue,
    doubling::{
        expansion::PhaseExpansion,
        interface::SmoothFace,
        phase_table::PhaseTable,
        rough::{FacetBounces, RoughFace},
        slopes::GaussianSlopes,
        stack::{LayerFace, SlabParticles, TransferLayer},
    },
    optics::RefractiveIndex,
    polarized_phase::{self, PolarizedPhase},
    spec::{self, Class, Family, Laws, Member, Parameter, Spec},
};

/// Name, parameters and constructor of the class.
pub const SPEC: Spec<PaintSlab> = Spec {
    class: Class {
        name: "Scattering_Slab",
        parent: "Slab",
        summary: "Binder with particles and flakes under a face",
        equation: "tau = (kappa_a + kappa_s + 4 pi k/lambda) t",
        source: "vandehulst-1980",
        params: &[&[
            Parameter::member("interface", &paint_face::FAMILY, "Coated_Face", "The upper face"),
            Parameter::number("thickness", 10.0, "um", "Thickness; 0: no slab"),
            Parameter::member(
                "particles",
                &polarized_phase::FAMILY,
                "No_Polarized_Phase_Function",
                "Particles; lambda and medium of spheres are set by the slab",
            ),
            Parameter::member("flakes", &paint_flakes::FAMILY, "No_Flakes", "Flakes"),
        ]],
        laws: Laws::NONE,
    },
    build: |node| {
        let thickness = node.number("thickness");
        if !(thickness >= 0.0 && thickness.is_finite()) {
            let problem = format!("{thickness} um is not a thickness");
            return Err(ParameterError::new("thickness", problem));
        }
        Ok(Box::new(PaintSlab {
            thickness,
            face: *node.member::<PaintFace>("interface")?,
            flakes: *node.member::<PaintFlakes>("flakes")?,
            particles: node.child("particles").clone(),
        }))
    },
};

/// All of them, in the order they are listed to users.
pub const ALL: &[&Spec<PaintSlab>] = &[&SPEC];

impl Member for PaintSlab {
    const CLASSES: &'static [&'static [&'static Spec<Self>]] = &[ALL];
}

/// The family of slabs with scatterers.
pub static FAMILY: Family =
    Family::new("Slab", "Slabs with scatterers", spec::classes::<PaintSlab>);

/// Below this slope light inside takes a face as smooth.
pub(super) const NARROWEST: f64 = 0.1;

/// A slab of a paint.
pub struct PaintSlab {
    /// Thickness, µm.
    pub(super) thickness: f64,
    /// Upper face.
    pub(super) face: PaintFace,
    flakes: PaintFlakes,
    particles: ParameterNode,
}

impl PaintSlab {
    /// The slab at the vacuum wavelength `lambda` µm, with phase matrices up to l = `order`.
    pub(super) fn layer(
        &self,
        lambda: f64,
        order: usize,
        bounces: FacetBounces,
    ) -> Result<TransferLayer, ParameterError> {
        let index = self.face.material.at(lambda);
        if !(index.re >= 1.0 && index.re.is_finite() && index.im >= 0.0 && index.im.is_finite()) {
            let problem = format!("{index}: n has to be at least 1, k at least 0");
            return Err(ParameterError::new("interface.material", problem));
        }
        let n = index.re;
        let films: Vec<_> =
            self.face.films.at(lambda).iter().map(|(index, t)| (*index, t / lambda)).collect();
        if bounces == FacetBounces::All && films.iter().any(|(index, _)| index.im > 0.0) {
            let problem = "films that absorb on a rough face need bounces = 0";
            return Err(ParameterError::new("interface.stack", problem));
        }
        let films = SmoothFace { films };
        let face = match self.face.sigma() {
            Some(sigma) if sigma >= NARROWEST * (1.0 - 1e-9) => {
                LayerFace::Rough(RoughFace { films, slopes: GaussianSlopes { sigma }, bounces })
            }
            _ => LayerFace::Smooth(films),
        };
        Ok(TransferLayer {
            n,
            face,
            particles: self.particles(lambda, n, order)?,
            binder: 4.0 * PI * index.im * self.thickness / lambda,
            flakes: self.flakes.layer(lambda, n, self.thickness),
        })
    }

    fn particles(
        &self,
        lambda: f64,
        n: f64,
        order: usize,
    ) -> Result<Option<SlabParticles>, ParameterError> {
        let inside = |error: ParameterError| error.inside("particles");
        let node = suspended(&self.particles, lambda, n);
        let phase = spec::build::<dyn PolarizedPhase>(&node).map_err(inside)?;
        let (absorption, scattering) = (phase.absorption().max(0.0), phase.scattering());
        let extinction = absorption + scattering;
        if !(extinction > 0.0) {
            return Ok(None);
        }
        let elements = |c: f64| {
            let p = phase.at_cosine(c);
            let own = [p[(0, 0)], p[(1, 1)], p[(2, 2)], p[(3, 3)], p[(0, 1)], p[(2, 3)]];
            own.map(|x| x * 4.0 * PI)
        };
        let (series, norm) = PhaseExpansion::converged(elements, order + 1);
        if !series.terms.iter().flatten().all(|x| x.is_finite()) {
            let problem = "the phase matrix has no finite expansion";
            return Err(inside(ParameterError::new("", problem)));
        }
        let depth = extinction * self.thickness;
        let whole = Some(Arc::new(PhaseTable::new(elements, norm)));
        Ok(Some(SlabParticles { depth, albedo: scattering / extinction, series, whole }))
    }
}

/// Particles at the vacuum wavelength `lambda` in a medium of index `n`.
fn suspended(node: &ParameterNode, lambda: f64, n: f64) -> ParameterNode {
    let mut node = node.clone();
    for (value, parameter) in node.values.iter_mut().zip(node.class.parameters()) {
        *value = match (&*value, parameter.name) {
            (ParameterValue::Number(_), "lambda") => ParameterValue::Number(lambda),
            (ParameterValue::Index(_), "medium") => {
                ParameterValue::Index(RefractiveIndex::constant(n, 0.0))
            }
            (ParameterValue::Member(child), _) => {
                ParameterValue::Member(Arc::new(suspended(child, lambda, n)))
            }
            (other, _) => other.clone(),
        };
    }
    node
}
