//! Coats: thick layers with the interface on them, and the light that crosses several of them.

use std::f64::consts::{FRAC_PI_2, PI};

use num_complex::Complex64;

use super::{
    interface::{Interface, InterfaceRay, RoughnessParameters},
    layer::CoatingLayer,
    transmission::TransmissionFactors,
};
use crate::{ParameterError, slope, special::gauss, stack::Stack};

/// Nodes of the integral over diffuse light, in each of its smooth pieces.
const NODES: usize = 64;

/// A layer with the interface on it.
pub(super) struct CoatLayer {
    pub(super) interface: Interface,
    /// Index of the layer.
    pub(super) n: f64,
    /// 4πkt/λ.
    pub(super) depth: f64,
}

/// All layers down to some depth, for one ray.
#[derive(Clone, Copy)]
pub(super) struct LayersAbove {
    /// Transmittance.
    pub(super) passes: TransmissionFactors,
    /// Internal reflectance for light from below, through the last layer and back.
    pub(super) returns: TransmissionFactors,
    /// Light that smooth interfaces reflect outwards.
    pub(super) mirrored: TransmissionFactors,
}

impl LayersAbove {
    pub(super) const NOTHING: Self = Self {
        passes: TransmissionFactors::FREE,
        returns: TransmissionFactors::NONE,
        mirrored: TransmissionFactors::NONE,
    };
}

/// Switch: with or without the absorption of the layers.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Absorption {
    Lossy,
    Clear,
}

impl CoatLayer {
    pub(super) fn new(
        layer: &CoatingLayer,
        above: f64,
        lambda: f64,
    ) -> Result<Self, ParameterError> {
        let Complex64 { re: n, im: k } = layer.material.at(lambda);
        if !(n >= 1.0 && n.is_finite() && k >= 0.0 && k.is_finite()) {
            let problem = format!("{n} + {k}i: n has to be at least 1, k at least 0");
            return Err(ParameterError::new("material", problem));
        }
        let node = &layer.node;
        let films = node.member::<Stack>("stack")?.at(lambda);
        let smooth = node.child("sdf").class.name == slope::unit::SPEC.class.name;
        let roughness = (!smooth).then(|| RoughnessParameters {
            slopes: node.child("sdf"),
            shadow: node.child("shadow"),
        });
        let interface = Interface::new((above, n), &films, lambda, roughness)?;
        Ok(Self { interface, n, depth: 4.0 * PI * k * layer.thickness / lambda })
    }

    /// Fraction of light that remains after one passage at an angle with this cosine.
    pub(super) fn left(&self, cos: f64, media: Absorption) -> f64 {
        if self.depth == 0.0 || media == Absorption::Clear {
            1.0
        } else {
            (-self.depth / cos).exp()
        }
    }

    /// The layers down to this one for the ray `ray` above it, whose angle in it has the cosine
    /// `cos`; `sin` is that of the ray above.
    pub(super) fn add(
        &self,
        above: LayersAbove,
        ray: &InterfaceRay,
        cos: f64,
        media: Absorption,
    ) -> LayersAbove {
        let crossing = self.interface.crossing(ray).kept;
        let absorbed = self.left(cos, media);
        if self.interface.is_rough() {
            // A rough interface reflects into other directions.
            let passes = above.passes.then(crossing).scaled(absorbed);
            return LayersAbove {
                passes,
                returns: TransmissionFactors::NONE,
                mirrored: above.mirrored,
            };
        }
        let reflected = self.interface.reflects_above(ray.sin);
        let trips = above.returns.then(reflected).repeated();
        let passes = above.passes.then(crossing).then(trips).scaled(absorbed);
        let out = above.passes.then(reflected).then(trips).then(above.passes);
        let mirrored = above.mirrored.plus(out);
        let through = crossing.then(crossing).then(above.returns).then(trips);
        let returns = self.interface.reflects_below(ray.sin).plus(through);
        LayersAbove { passes, returns: returns.scaled(absorbed * absorbed), mirrored }
    }

    /// The part of light with the tangential index `kappa` that all layers down to this one send
    /// back, once it has crossed this one twice, of diffuse light from below.
    fn recycled(
        &self,
        above: (f64, TransmissionFactors),
        kappa: f64,
        media: Absorption,
    ) -> TransmissionFactors {
        let (n_above, returns) = above;
        let sin = kappa / n_above;
        let cos = (1.0 - (kappa / self.n).powi(2)).max(0.0).sqrt();
        let absorbed = self.left(cos, media).powi(2);
        let reflected = self.interface.reflects_below(sin);
        if sin >= 1.0 {
            return reflected.scaled(absorbed);
        }
        let crossing = self.interface.mean_passage(sin);
        let back = self.interface.mean_sent_back(sin);
        let trips = if self.interface.is_rough() {
            TransmissionFactors::FREE
        } else {
            returns.then(self.interface.reflects_above(sin)).repeated()
        };
        back.plus(crossing.then(crossing).then(returns).then(trips)).scaled(absorbed)
    }
}

/// ρ: the fraction of diffuse light from below all coats that returns.
pub(super) fn recycled(coats: &[CoatLayer], lambda: f64, media: Absorption) -> f64 {
    let Some(last) = coats.last() else { return 0.0 };
    // The integrand has kinks where light begins to be reflected totally.
    let mut ends = vec![0.0, 1.0, last.n];
    ends.extend(coats.iter().map(|coat| coat.n).filter(|n| *n < last.n));
    ends.sort_by(f64::total_cmp);
    let thickest = coats.iter().map(|coat| coat.interface.optical_thickness()).fold(0.0, f64::max);
    // Interference fringes are followed with ten nodes for each half wave.
    let nodes = NODES + (20.0 * thickest / lambda).min(4000.0) as usize;
    let mut sum = 0.0;
    for pair in ends.windows(2) {
        let (from, span) = (pair[0] * pair[0], pair[1] * pair[1] - pair[0] * pair[0]);
        if span <= 0.0 {
            continue;
        }
        sum += span
            * gauss::integrate(nodes, 0.0, FRAC_PI_2, |t| {
                let kappa = (from + span * t.sin().powi(2)).sqrt();
                let mut above = (1.0, TransmissionFactors::NONE);
                for coat in coats {
                    above = (coat.n, coat.recycled(above, kappa, media));
                }
                above.1.row()[0] * (2.0 * t).sin()
            });
    }
    sum / (last.n * last.n)
}
