//! Thick clear or absorbing coats over any model.
//!
//! F_j is the BRDF of everything below interface j, seen inside layer j. With η = n_j/n_{j−1} and
//! sin θ⁽ʲ⁾ = sin θ⁽ʲ⁻¹⁾/η,
//!
//! $$ \mathbf F_{j-1} = \mathbf S_j + \frac{1}{\eta^2}\,\mathbf T_j(\theta_s)\,A_j(\theta_s)\,
//!    \mathbf F_j(\theta_i^{(j)},\theta_s^{(j)},\phi)\,A_j(\theta_i)\,\mathbf T_j(\theta_i),
//!    \qquad (1) $$
//! $$ A_j = e^{-4\pi k_j t_j/(\lambda\cos\theta^{(j)})} \qquad (2) $$
//!
//! S_j is the BRDF of the facets of a rough interface. A smooth interface reflects into one direction,
//! which is not part of a BRDF. T_j is the transmission of the interface. The model at the bottom is
//! immersed in the last layer: all its indices are divided by n, and so is its wavelength. Models that
//! have no meaning inside a medium are refused.
//!
//! Reflections between smooth interfaces are summed as a geometric series, separately for s, p and
//! their coherence: T_1 T_2/(1 − A R_1 R_2 A) for two interfaces, and so on downwards.
//!
//! A diffuse body at the bottom (`Lambertian_BRDF_Model`, or `Diffuse_Subsurface_BRDF_Model` with its
//! own interface) gets the factor 1/(1 − ρR): R is its reflectance, ρ the fraction of diffuse light
//! that all layers return. Light that rough interfaces neither transmit nor send out counts as
//! diffuse light that reaches the body ([`EnergyCompensation`]). Without absorption, coats over a
//! white body therefore lose no light, for any roughness and any polarization.
//!
//! `layer1` is the uppermost of `layers` layers. A layered model as `model` has its layers below
//! these, so the number of layers is not limited.
//!
//! Left out:
//! - reflections between a rough interface and other interfaces, or between interfaces and a bottom
//!   that is not diffuse;
//! - the spread of directions by refraction at rough interfaces;
//! - with absorbing films, the light between rough interfaces (it is lost).
//!
//! Absorption is computed along the refracted direction of the real index.
//!
//! M. Born and E. Wolf, *Principles of Optics*, 7th ed. (1999), sections 1.5 and 1.6; T. A. Germer
//! and M. E. Nadal, Proc. SPIE 4447, 77 (2001).

use std::f64::consts::FRAC_1_PI;

use super::{
    coat::{Absorption, CoatLayer, LayersAbove, recycled},
    energy_compensation::EnergyCompensation,
    immersed::immersed,
    interface::{Interface, InterfaceRay, behind},
    layer::{CoatingLayer, FAMILY},
    transmission::depolarized,
};
use crate::{
    Basis, Direction, Incidence, Model, Mueller, ParameterError, ParameterNode,
    models::{
        COMMON, CommonParameters, LobeSupport,
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
        name: "Layered_BRDF_Model",
        parent: "BRDF_Model",
        summary: "Thick clear or absorbing coats over any model",
        equation: "F_(j-1) = S_j + T_j A_j F_j A_j T_j (n_(j-1)/n_j)^2",
        source: "born-1999 germer-2001",
        params: &[
            COMMON,
            &[
                Parameter::member(
                    "model",
                    &brdf::FAMILY,
                    "Lambertian_BRDF_Model",
                    "The model below all layers",
                ),
                Parameter::integer("layers", 1, "How many layers there are, 0 to 4"),
                layer("layer1", "The uppermost layer"),
                layer("layer2", "The second layer from above"),
                layer("layer3", "The third layer from above"),
                layer("layer4", "The fourth layer from above"),
            ],
        ],
        laws: Laws::NOT_PASSIVE,
    },
    build: |node| Ok(Box::new(LayeredModel::read(node)?)),
};

const fn layer(name: &'static str, doc: &'static str) -> Parameter {
    Parameter::member(name, &FAMILY, "Coat_Layer", doc)
}

const NAMES: [&str; 4] = ["layer1", "layer2", "layer3", "layer4"];

/// Layers over a model.
struct LayeredModel {
    common: CommonParameters,
    /// Layers, the uppermost first.
    coats: Vec<CoatLayer>,
    bottom: LowestSurface,
}

/// Body below all layers.
enum LowestSurface {
    /// A diffuse body of this reflectance, for light inside the last layer.
    Diffuse {
        /// R/(π(1 − ρR)).
        strength: f64,
        /// Additional light that reaches it through rough interfaces.
        compensation: Option<EnergyCompensation>,
    },
    /// Any other model, immersed.
    Immersed(Model),
}

impl LayeredModel {
    fn read(node: &ParameterNode) -> Result<Self, ParameterError> {
        let common = CommonParameters::read(node)?;
        common.only_reflection(SPEC.class.name)?;
        let mut coats = Vec::new();
        let below = add_coats(node, &common, &mut coats)?;
        let n = coats.last().map_or(1.0, |coat| coat.n);
        let bottom = match diffuse_body(&below, &common, &mut coats)? {
            Some(reflectance) => {
                let compensation = EnergyCompensation::new(&coats);
                let rho = match &compensation {
                    None => recycled(&coats, common.lambda, Absorption::Lossy),
                    Some(compensation) => {
                        // The way back absorbs like that of light that is not compensated.
                        let clear = recycled(&coats, common.lambda, Absorption::Clear);
                        let lossy = recycled(&coats, common.lambda, Absorption::Lossy);
                        let kept = if clear > 0.0 { (lossy / clear).min(1.0) } else { 1.0 };
                        kept * compensation.sent_back(&coats)
                    }
                };
                let strength = FRAC_1_PI * reflectance / (1.0 - rho * reflectance);
                LowestSurface::Diffuse { strength, compensation }
            }
            None => {
                let inside = immersed("model", &below, n, common.lambda)?;
                LowestSurface::Immersed(
                    model::build(&inside).map_err(|error| error.inside("model"))?,
                )
            }
        };
        Ok(Self { common, coats, bottom })
    }
}

/// Adds the layers of `node`, and those of a layered model below them; returns the model below all.
fn add_coats(
    node: &ParameterNode,
    common: &CommonParameters,
    coats: &mut Vec<CoatLayer>,
) -> Result<ParameterNode, ParameterError> {
    let count = node.integer("layers");
    if !(0..=NAMES.len() as i32).contains(&count) {
        return Err(ParameterError::new(
            "layers",
            format!("{count} is not from 0 to {}", NAMES.len()),
        ));
    }
    for name in &NAMES[..count as usize] {
        let layer = node.member::<CoatingLayer>(name)?;
        if layer.thickness == 0.0 {
            continue;
        }
        let above = coats.last().map_or(1.0, |coat| coat.n);
        coats.push(
            CoatLayer::new(&layer, above, common.lambda).map_err(|error| error.inside(name))?,
        );
    }
    let below = node.child("model");
    check_same(below, common)?;
    if below.class.name == SPEC.class.name {
        return add_coats(below, common, coats).map_err(|error| error.inside("model"));
    }
    Ok(below.clone())
}

/// The model below sees the light of the layered model, and its substrate is that of the whole.
fn check_same(below: &ParameterNode, common: &CommonParameters) -> Result<(), ParameterError> {
    let CommonParameters { lambda, substrate, side } =
        CommonParameters::read(below).map_err(|e| e.inside("model"))?;
    let differs = |parameter: &str, own: String, whole: String| {
        let problem = format!("{own} is not {whole}, that of the model around it");
        Err(ParameterError::new(&format!("model.{parameter}"), problem))
    };
    if lambda != common.lambda {
        return differs("lambda", format!("{lambda} um"), format!("{} um", common.lambda));
    }
    if substrate != common.substrate {
        return differs("substrate", substrate.to_string(), common.substrate.to_string());
    }
    if side != common.side {
        return differs("type", side.number().to_string(), common.side.number().to_string());
    }
    Ok(())
}

/// The reflectance of the model `below` if it is a diffuse body; its own interface becomes a coat.
fn diffuse_body(
    below: &ParameterNode,
    common: &CommonParameters,
    coats: &mut Vec<CoatLayer>,
) -> Result<Option<f64>, ParameterError> {
    let name = below.class.name;
    let under_interface = name == diffuse::diffuse_subsurface::SPEC.class.name;
    if !under_interface && name != diffuse::lambertian::SPEC.class.name {
        return Ok(None);
    }
    let inside = |error: ParameterError| error.inside("model");
    if under_interface {
        let above = coats.last().map_or(1.0, |coat| coat.n);
        let films = below.member::<Stack>("stack").map_err(inside)?.at(common.lambda);
        let n = common.substrate.re;
        if !(n >= 1.0 && n.is_finite()) {
            let problem = format!("an index of {n} is below that of the air");
            return Err(ParameterError::new("substrate", problem));
        }
        let interface = Interface::new((above, n), &films, common.lambda, None)?;
        coats.push(CoatLayer { interface, n, depth: 0.0 });
    }
    let reflectance = reflectance::read(below, "reflectance", common.lambda);
    reflectance.map(Some).map_err(inside)
}

impl Brdf for LayeredModel {
    fn common(&self) -> &CommonParameters {
        &self.common
    }

    fn lobe_supports(&self, incidence: &Incidence) -> Vec<LobeSupport> {
        let LowestSurface::Immersed(model) = &self.bottom else { return Vec::new() };
        let n = self.coats.last().map_or(1.0, |coat| coat.n);
        let inside = Incidence::new((incidence.sin / n).asin(), incidence.rotation());
        let supports = model.lobe_supports(&inside).into_iter();
        supports.filter_map(|support| support.refracted(n)).collect()
    }

    fn mueller(&self, incidence: &Incidence, direction: &Direction) -> Mueller {
        let (mut ray_i, mut ray_s) =
            (InterfaceRay::incident(incidence), InterfaceRay::reversed(incidence, direction));
        let (mut above_i, mut above_s) = (LayersAbove::NOTHING, LayersAbove::NOTHING);
        let mut n = 1.0;
        let mut sum = Mueller::ZERO;
        for coat in &self.coats {
            if let Some(facets) = coat.interface.facets() {
                let seen = facets.mueller(&ray_i.incidence(incidence), &ray_s.direction(direction));
                // S_j of (1), seen through the layers above.
                sum += behind((above_s.passes, above_i.passes), seen, n * n);
            }
            let (below_i, below_s) = (ray_i.below(coat.interface.n), ray_s.below(coat.interface.n));
            above_i = coat.add(above_i, &ray_i, below_i.cos, Absorption::Lossy);
            above_s = coat.add(above_s, &ray_s, below_s.cos, Absorption::Lossy);
            (ray_i, ray_s, n) = (below_i, below_s, coat.n);
        }
        match &self.bottom {
            LowestSurface::Diffuse { strength, compensation } => {
                let mut rows = [above_s.passes.row(), above_i.passes.row()];
                if let Some(compensation) = compensation {
                    let outside = [
                        InterfaceRay::reversed(incidence, direction),
                        InterfaceRay::incident(incidence),
                    ];
                    for (row, ray) in rows.iter_mut().zip(outside) {
                        compensation.add(row, &self.coats, ray);
                    }
                }
                let [leaving, entering] = rows;
                sum += depolarized(strength / (n * n), leaving, entering);
            }
            LowestSurface::Immersed(model) => {
                let mut inner = [Mueller::ZERO];
                let to = ray_s.direction(direction);
                model.evaluate(&ray_i.incidence(incidence), &[to], Basis::Psps, &mut inner);
                // The second term of (1), for all layers at once.
                sum += behind((above_s.passes, above_i.passes), inner[0], n * n);
            }
        }
        sum
    }
}
