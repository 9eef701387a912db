//! Paint: slabs with particles and flakes between smooth or rough faces, over any surface.
//!
//! All light that is scattered is followed with its polarization, by adding and doubling of
//! [`crate::doubling`]: azimuthal modes of the BRDF at `nodes` directions outside and `trapped`
//! more between two indices, interpolated between them. Modes are added until they are smaller than
//! `tolerance`. Light scattered once in slabs seen through smooth faces is added exactly. Without
//! absorption no light is lost.
//!
//! `layer1` is the uppermost of `layers` slabs. Below them lies `model`: a Lambertian or
//! `Diffuse_Subsurface_BRDF_Model` exactly, `Smooth_Surface_BRDF_Model` as a mirror, any other one
//! without direction by its BRDF inside the last slab. Mirror reflection of smooth faces is no BRDF
//! and is left out.
//!
//! The facets of a rough uppermost face reflect by `Shadowed_Facet_BRDF_Model` with the general
//! Sancer function. Light that they refract or that meets several of them follows with isotropic
//! slopes, σ² = ½(σ_x² + σ_y²): for σ_x ≠ σ_y up to 0.006 of the incident light is off. `bounces` = 0
//! lets light of further bounces leave diffusely, up to 0.007 of the incident light too dark for
//! σ ≤ 0.3; `bounces` = 1 follows it, at a much higher cost. A face with σ < 0.1 is smooth for the
//! light inside, and must be the uppermost one.
//!
//! Flakes are independent of each other and of the particles; light between them is followed.
//!
//! J. F. de Haan, P. B. Bosma and J. W. Hovenier, Astron. Astrophys. 183, 371 (1987); H. C. van de
//! Hulst, *Multiple Light Scattering* (Academic Press, 1980).

use std::sync::Arc;

use super::{
    backing::Backing,
    immersed::immersed,
    layered,
    paint::{self, NARROWEST, PaintSlab},
    smooth_surface,
};
use crate::{
    Direction, Incidence, ModelLimit, Mueller, ParameterError, ParameterNode,
    doubling::{
        diffuse::DiffuseModes,
        interface::SmoothFace,
        rough::FacetBounces,
        single::SingleSlab,
        stack::{
            AngularResolution, LayerFace, StackBottom, TransferLayer, TransferProblem,
            TransferStack,
        },
        table::ModeTable,
    },
    models::{
        COMMON, CommonParameters,
        brdf::{self, Brdf},
        diffuse, model,
    },
    reflectance,
    spec::{Class, Laws, Parameter, Spec},
    stack::Stack,
};

/// Name, parameters and constructor of the class.
pub const SPEC: Spec<dyn Brdf> = Spec {
    class: Class {
        name: "Adding_Doubling_BRDF_Model",
        parent: "BRDF_Model",
        summary: "Paint: particles, flakes, smooth and rough faces, polarized",
        equation: "R = R_a + T_a (1 - R_b R_a')^-1 R_b T_a, in azimuthal modes",
        source: "dehaan-1987 vandehulst-1980 hovenier-2004 heitz-2016",
        params: &[
            COMMON,
            &[
                Parameter::member(
                    "model",
                    &brdf::FAMILY,
                    "Lambertian_BRDF_Model",
                    "The surface below all layers",
                ),
                Parameter::integer("layers", 1, "How many layers there are, 0 to 4"),
                layer("layer1", "The uppermost layer"),
                layer("layer2", "The second layer from above"),
                layer("layer3", "The third layer from above"),
                layer("layer4", "The fourth layer from above"),
                Parameter::integer("nodes", 16, "Directions in the air, 4 to 48"),
                Parameter::integer(
                    "trapped",
                    10,
                    "Directions between the air and an index, and between two indices, 2 to 48",
                ),
                Parameter::number(
                    "tolerance",
                    1e-6,
                    "1/sr",
                    "Modes are added until they are smaller",
                ),
                Parameter::integer(
                    "bounces",
                    0,
                    "Light that meets several facets: 0 leaves diffusely, 1 is followed",
                ),
            ],
        ],
        laws: Laws::ALL,
    },
    build: |node| Ok(Box::new(AddingDoubling::read(node)?)),
};

const fn layer(name: &'static str, doc: &'static str) -> Parameter {
    Parameter::member(name, &paint::FAMILY, "Scattering_Slab", doc)
}

const NAMES: [&str; 4] = ["layer1", "layer2", "layer3", "layer4"];
/// The last mode that is tried with particles, with facets or flakes, and with all bounces.
const MODES: (usize, usize, usize) = (48, 28, 16);
/// Steps of the table in θ.
const STEPS: usize = 48;
/// Modes that end above this many tolerances are told.
const ENDED: f64 = 100.0;

/// A paint, prepared.
struct AddingDoubling {
    common: CommonParameters,
    table: ModeTable,
    /// Facets of a rough uppermost face.
    facets: Option<Box<dyn Brdf>>,
    /// Light scattered once in slabs that are seen through smooth faces.
    singles: Vec<SingleSlab>,
}

impl AddingDoubling {
    fn read(node: &ParameterNode) -> Result<Self, ParameterError> {
        let common = CommonParameters::read(node)?;
        common.only_reflection(SPEC.class.name)?;
        let bounces = match node.integer("bounces") {
            0 => FacetBounces::First,
            1 => FacetBounces::All,
            other => {
                return Err(ParameterError::new("bounces", format!("{other} is not 0 or 1")));
            }
        };
        let tolerance = node.number("tolerance");
        if !(tolerance > 0.0 && tolerance.is_finite()) {
            return Err(ParameterError::new("tolerance", format!("{tolerance} is not positive")));
        }
        let (outside, trapped) = (count(node, "nodes", 4..=48)?, count(node, "trapped", 2..=48)?);
        let slabs = slabs(node)?;
        check_faces(&slabs)?;
        // Orders of the phase matrix that the nodes of the densest slab carry.
        let segments = slabs.len().max(1);
        let order = (outside + segments * trapped + 3).min(2 * outside + 2 * trapped - 1);
        let mut layers = Vec::new();
        for (name, slab) in &slabs {
            let layer = slab.layer(common.lambda, order, bounces);
            layers.push(layer.map_err(|error| error.inside(name))?);
        }
        let bottom = bottom(node, &common, &mut layers)?;
        let is_rough = layers.iter().any(|layer| matches!(layer.face, LayerFace::Rough(_)));
        let has_lobes = is_rough
            || matches!(bottom, StackBottom::Surface(_))
            || layers.iter().any(|layer| layer.flakes.is_some());
        let modes = match (has_lobes, is_rough && bounces == FacetBounces::All) {
            (false, _) => MODES.0.min(order),
            (true, false) => MODES.1,
            (true, true) => MODES.2,
        };
        let stack = TransferStack { layers, bottom };
        let resolution = AngularResolution { outside, trapped, order, modes };
        let transfer = TransferProblem::new(&stack, &resolution, &[]);
        let diffuse = DiffuseModes::new(&transfer, modes, tolerance);
        if diffuse.rest > ENDED * tolerance && diffuse.modes.len() > modes {
            node.note_limit(ModelLimit::ModesEnded);
        }
        let facets = match slabs.first() {
            Some((name, slab)) if slab.face.deviations.is_some() => {
                let facets = slab.face.facets(common.lambda);
                Some(facets.map_err(|error| error.inside("interface").inside(name))?)
            }
            _ => None,
        };
        let singles = transfer.singles();
        Ok(Self { common, table: ModeTable::new(&diffuse, STEPS), facets, singles })
    }
}

/// The integer `name`, which must be in `range`.
fn count(
    node: &ParameterNode,
    name: &str,
    range: std::ops::RangeInclusive<i32>,
) -> Result<usize, ParameterError> {
    let number = node.integer(name);
    if range.contains(&number) {
        return Ok(number as usize);
    }
    let problem = format!("{number} is not from {} to {}", range.start(), range.end());
    Err(ParameterError::new(name, problem))
}

/// The slabs that are there, with their names.
fn slabs(node: &ParameterNode) -> Result<Vec<(&'static str, PaintSlab)>, ParameterError> {
    let count = count(node, "layers", 0..=NAMES.len() as i32)?;
    let mut slabs = Vec::new();
    for name in &NAMES[..count] {
        let slab = node.member::<PaintSlab>(name)?;
        if slab.thickness > 0.0 {
            slabs.push((*name, *slab));
        }
    }
    Ok(slabs)
}

/// An error for a face below the uppermost one that is rough but too narrow to be followed.
fn check_faces(slabs: &[(&'static str, PaintSlab)]) -> Result<(), ParameterError> {
    for (name, slab) in slabs.iter().skip(1) {
        if let Some(sigma) = slab.face.sigma().filter(|sigma| *sigma < NARROWEST) {
            let problem = format!(
                "slopes of {sigma} along each axis are below {NARROWEST}: inside a paint take a \
                 smooth face (Unit_Slope_Distribution_Function) or a rougher one"
            );
            return Err(ParameterError::new(&format!("{name}.interface.sdf"), problem));
        }
    }
    Ok(())
}

/// The surface below all layers; the interface of a diffuse body becomes a layer.
fn bottom(
    node: &ParameterNode,
    common: &CommonParameters,
    layers: &mut Vec<TransferLayer>,
) -> Result<StackBottom, ParameterError> {
    let below = node.child("model");
    let inside = |error: ParameterError| error.inside("model");
    let own = CommonParameters::read(below).map_err(inside)?;
    for (name, same) in [
        ("lambda", own.lambda == common.lambda),
        ("substrate", own.substrate == common.substrate),
        ("type", own.side == common.side),
    ] {
        if !same {
            let problem = "it is not that of the model around it";
            return Err(ParameterError::new(&format!("model.{name}"), problem));
        }
    }
    let films = |below: &ParameterNode| -> Result<SmoothFace, ParameterError> {
        let films = below.member::<Stack>("stack").map_err(inside)?.at(common.lambda);
        Ok(SmoothFace { films: films.iter().map(|(n, t)| (*n, t / common.lambda)).collect() })
    };
    let name = below.class.name;
    if name == SPEC.class.name || name == layered::SPEC.class.name {
        let problem = format!("{name}: write its layers into those above");
        return Err(ParameterError::new("model", problem));
    }
    if name == smooth_surface::SPEC.class.name {
        return Ok(StackBottom::Mirror(films(below)?, common.substrate));
    }
    let is_body = name == diffuse::diffuse_subsurface::SPEC.class.name;
    if is_body {
        let n = common.substrate.re;
        if !(n >= 1.0 && n.is_finite()) {
            let problem = format!("an index of {n} is below that of the air");
            return Err(ParameterError::new("substrate", problem));
        }
        let face = LayerFace::Smooth(films(below)?);
        layers.push(TransferLayer { n, face, particles: None, binder: 0.0, flakes: None });
    }
    if is_body || name == diffuse::lambertian::SPEC.class.name {
        let rho = reflectance::read(below, "reflectance", common.lambda).map_err(inside)?;
        if !(0.0..=1.0).contains(&rho) {
            let problem = format!("{rho} is not from 0 to 1");
            return Err(ParameterError::new("model.reflectance", problem));
        }
        return Ok(StackBottom::Lambertian(rho));
    }
    let n = layers.last().map_or(1.0, |layer| layer.n);
    let model = model::build(&immersed("model", below, n, common.lambda)?).map_err(inside)?;
    Ok(StackBottom::Surface(Arc::new(Backing::new(model)?)))
}

impl Brdf for AddingDoubling {
    fn common(&self) -> &CommonParameters {
        &self.common
    }

    fn mueller(&self, incidence: &Incidence, direction: &Direction) -> Mueller {
        let mut out = [Mueller::ZERO];
        self.mueller_batch(incidence, std::slice::from_ref(direction), &mut out);
        out[0]
    }

    fn mueller_batch(&self, incidence: &Incidence, directions: &[Direction], out: &mut [Mueller]) {
        match &self.facets {
            Some(facets) => facets.mueller_batch(incidence, directions, out),
            None => out.fill(Mueller::ZERO),
        }
        let mut beam = self.table.beam(incidence.theta().abs());
        let into: Vec<_> = self.singles.iter().map(|slab| slab.ray(incidence.sin.abs())).collect();
        for (m, to) in out.iter_mut().zip(directions) {
            // A negative polar angle is a positive one on the other side.
            let side = if incidence.sin * to.sin < 0.0 { -1.0 } else { 1.0 };
            let turn = (side * to.cos_phi, side * to.sin_phi);
            *m += beam.mueller(to.theta().abs(), turn);
            for (slab, into) in self.singles.iter().zip(&into) {
                *m += slab.mueller(into, &slab.ray(to.sin.abs()), turn);
            }
        }
    }
}
