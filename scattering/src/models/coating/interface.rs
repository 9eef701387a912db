//! One interface of a coating, smooth or rough, seen from the medium above it.
//!
//! A smooth interface transmits by Fresnel's equations. A rough interface with the facet BRDF F
//! returns the row e of [`DirectionalAlbedo`]; it transmits the rest,
//!
//! $$ \mathbf t = (1, 0, 0, 0) - \mathbf e - \mathbf a, $$
//!
//! a the absorption of the films, so that no energy is lost or gained at any roughness. Transmitted
//! light is taken to continue in the direction of Snell's law.

use num_complex::Complex64;

use super::{
    directional_albedo::{DirectionalAlbedo, ErrorSign},
    transmission::TransmissionFactors,
};
use crate::{
    Direction, Incidence, Mode, Mueller, ParameterError, ParameterNode, ParameterValue,
    models::{Brdf, facet::shadowed},
    optics::{RefractiveIndex, film::Films},
    slope::SlopeDistribution,
    spec,
    stack::Film,
};

/// One interface.
pub(super) struct Interface {
    /// Index below over index above.
    pub(super) n: f64,
    films: Films,
    rough: Option<RoughInterface>,
    absorbs: bool,
    /// Σ |n| t of the films, µm.
    optical_thickness: f64,
}

/// The facets of a rough interface and their directional albedo.
struct RoughInterface {
    facets: Box<dyn Brdf>,
    slopes: Box<dyn SlopeDistribution>,
    returned: DirectionalAlbedo,
}

/// A ray at an interface: its polar angle above it and its azimuth in the sample.
#[derive(Clone, Copy, Debug)]
pub(super) struct InterfaceRay {
    /// sin θ.
    pub(super) sin: f64,
    /// cos θ.
    pub(super) cos: f64,
    /// cos 2r and sin 2r, r the rotation of the sample for which the ray is the incident beam.
    pub(super) turn: (f64, f64),
}

impl InterfaceRay {
    /// The incident beam.
    pub(super) fn incident(at: &Incidence) -> Self {
        let (c, s) = (at.cos_rotation, at.sin_rotation);
        Self { sin: at.sin, cos: at.cos, turn: (c * c - s * s, 2.0 * s * c) }
    }

    /// The beam that returns along `direction`, on the sample turned by r + π − φ.
    pub(super) fn reversed(at: &Incidence, direction: &Direction) -> Self {
        let (c, s) = (
            at.cos_rotation * direction.cos_phi + at.sin_rotation * direction.sin_phi,
            at.sin_rotation * direction.cos_phi - at.cos_rotation * direction.sin_phi,
        );
        Self { sin: direction.sin, cos: direction.cos, turn: (c * c - s * s, 2.0 * s * c) }
    }

    /// A ray with this sine, for quantities that do not depend on the azimuth.
    pub(super) fn mean(sin: f64) -> Self {
        Self { sin, cos: (1.0 - sin * sin).max(0.0).sqrt(), turn: (1.0, 0.0) }
    }

    /// The ray below an interface with the relative index `n`.
    pub(super) fn below(&self, n: f64) -> Self {
        let sin = self.sin / n;
        Self { sin, cos: (1.0 - sin * sin).max(0.0).sqrt(), turn: self.turn }
    }

    /// The ray as an incident beam on the sample of `at`.
    pub(super) fn incidence(&self, at: &Incidence) -> Incidence {
        at.inclined((self.sin, self.cos))
    }

    /// The ray as an exit along the azimuth of `direction`.
    pub(super) fn direction(&self, direction: &Direction) -> Direction {
        direction.inclined((self.sin, self.cos))
    }
}

/// The roughness of an interface: members of the families Slope and Shadow, not yet built.
pub(super) struct RoughnessParameters<'a> {
    /// Slopes.
    pub(super) slopes: &'a ParameterNode,
    /// Shadowing.
    pub(super) shadow: &'a ParameterNode,
}

impl Interface {
    /// Between the indices `above` and `below` with `films` (index, thickness µm; the lowest
    /// first) at the vacuum wavelength `lambda` µm.
    pub(super) fn new(
        (above, below): (f64, f64),
        films: &[(Complex64, f64)],
        lambda: f64,
        roughness: Option<RoughnessParameters<'_>>,
    ) -> Result<Self, ParameterError> {
        let n = below / above;
        let films: Vec<_> = films.iter().map(|&(index, t)| (index / above, t)).collect();
        let stack = Films::new(&films, Complex64::ONE, n.into(), lambda / above);
        let rough = roughness
            .map(|roughness| {
                RoughInterface::new(n.into(), &films, lambda / above, &stack, &roughness)
            })
            .transpose()?;
        let absorbs = films.iter().any(|(index, _)| index.im != 0.0);
        let optical_thickness = above * films.iter().map(|(n, t)| n.norm() * t).sum::<f64>();
        Ok(Self { n, films: stack, rough, absorbs, optical_thickness })
    }

    /// Σ |n| t of its films, µm.
    pub(super) fn optical_thickness(&self) -> f64 {
        self.optical_thickness
    }

    /// True if its films absorb.
    pub(super) fn absorbs(&self) -> bool {
        self.absorbs
    }

    /// True if it is rough.
    pub(super) fn is_rough(&self) -> bool {
        self.rough.is_some()
    }

    /// The density of the facets' slopes; nothing if it is smooth.
    pub(super) fn slopes(&self) -> Option<&dyn SlopeDistribution> {
        self.rough.as_ref().map(|rough| &*rough.slopes)
    }

    /// Total reflectance of the facets for a ray.
    pub(super) fn returned(&self, ray: &InterfaceRay) -> [f64; 4] {
        let [i, q, u, v] = self.crossing(ray).row;
        [1.0 - i, -q, -u, -v]
    }

    /// Directional albedo of the facets; `None` if it is smooth.
    pub(super) fn facets(&self) -> Option<&dyn Brdf> {
        self.rough.as_ref().map(|rough| &*rough.facets)
    }

    /// Transmittance of a smooth interface, for a ray from either side.
    fn smooth(&self, sin: f64, cos: f64, cos_below: f64) -> TransmissionFactors {
        TransmissionFactors::of(self.films.t12(sin.into()), self.n * cos_below / cos)
    }

    /// Transmittance for s and p alone.
    pub(super) fn passage(&self, ray: &InterfaceRay) -> TransmissionFactors {
        let smooth = self.smooth(ray.sin, ray.cos, ray.below(self.n).cos);
        match &self.rough {
            None => smooth,
            Some(rough) => rough.lessen(smooth, rough.at(ray)),
        }
    }

    /// Transmittance of the same interface without roughness.
    pub(super) fn smooth_passage(&self, sin: f64) -> TransmissionFactors {
        let ray = InterfaceRay::mean(sin);
        self.smooth(sin, ray.cos, ray.below(self.n).cos)
    }

    /// The mean of [`Interface::passage`] over azimuths.
    pub(super) fn mean_passage(&self, sin: f64) -> TransmissionFactors {
        let smooth = self.smooth_passage(sin);
        match &self.rough {
            None => smooth,
            Some(rough) => rough.lessen(smooth, rough.returned.mean(sin.asin())),
        }
    }

    /// Transmittance in both representations.
    pub(super) fn crossing(&self, ray: &InterfaceRay) -> InterfaceTransmission {
        let smooth = self.smooth(ray.sin, ray.cos, ray.below(self.n).cos);
        let Some(rough) = &self.rough else {
            return InterfaceTransmission { kept: smooth, row: smooth.row() };
        };
        let more = rough.at(ray);
        let mut row = smooth.row();
        for (x, e) in row.iter_mut().zip(more) {
            *x -= e;
        }
        let passage = rough.lessen(smooth, more);
        // The polarized part has no U and V, so a slightly smaller part is realizable.
        let least = passage.s.min(passage.p);
        let oblique = more[2].hypot(more[3]);
        let part = if oblique < least { 1.0 - oblique / least } else { 0.0 };
        let kept = if oblique > 0.0 { passage.scaled(part) } else { passage };
        InterfaceTransmission { kept, row: realizable(row) }
    }

    /// Internal reflectance for a ray from below with this sine above the interface; above 1 it is
    /// reflected totally. A rough interface reflects more by the amount that it transmits less than a
    /// smooth one.
    fn sent_back(&self, sin: f64, passes: impl Fn() -> TransmissionFactors) -> TransmissionFactors {
        let reflected = self.reflects_below(sin);
        if self.rough.is_none() || sin >= 1.0 {
            return reflected;
        }
        let (smooth, rough) = (self.smooth_passage(sin), passes());
        let back = |r: f64, smooth: f64, rough: f64| (r + smooth - rough).clamp(0.0, 1.0);
        TransmissionFactors {
            s: back(reflected.s, smooth.s, rough.s),
            p: back(reflected.p, smooth.p, rough.p),
            c: reflected.c,
        }
    }

    /// Internal reflectance of the interface for a ray from below.
    pub(super) fn sends_back(&self, below: &InterfaceRay) -> TransmissionFactors {
        let sin = below.sin * self.n;
        self.sent_back(sin, || {
            self.passage(&InterfaceRay { sin, cos: (1.0 - sin * sin).sqrt(), turn: below.turn })
        })
    }

    /// The mean of [`Interface::sends_back`] over azimuths, for a ray whose sine on top is `sin`.
    pub(super) fn mean_sent_back(&self, sin: f64) -> TransmissionFactors {
        self.sent_back(sin, || self.mean_passage(sin))
    }

    /// Smooth reflection of light from above with this sine.
    pub(super) fn reflects_above(&self, sin: f64) -> TransmissionFactors {
        TransmissionFactors::of(self.films.r12(sin.into()), 1.0)
    }

    /// Smooth reflection of light from below; `sin` is n times the sine there, and may exceed 1.
    pub(super) fn reflects_below(&self, sin: f64) -> TransmissionFactors {
        TransmissionFactors::of(self.films.r21(sin.into()), 1.0)
    }
}

impl RoughInterface {
    /// Excess of the reflectance for a ray over that of a smooth interface.
    fn at(&self, ray: &InterfaceRay) -> [f64; 4] {
        self.returned.at(ray.sin.asin(), ray.turn.0, ray.turn.1)
    }

    fn new(
        n: Complex64,
        films: &[(Complex64, f64)],
        lambda: f64,
        stack: &Films,
        roughness: &RoughnessParameters<'_>,
    ) -> Result<Self, ParameterError> {
        let node = facets(n, films, lambda, roughness)?;
        let facets = spec::build::<dyn Brdf>(&node)?;
        let slopes = spec::build::<dyn SlopeDistribution>(roughness.slopes)?;
        let smooth = |sin: f64| [TransmissionFactors::of(stack.r12(sin.into()), 1.0).row()];
        let rows = |at: &Incidence, to: &Direction| [facets.mueller(at, to).0[0]];
        let [returned] =
            DirectionalAlbedo::tabulate(&*slopes, &rows, &smooth, (None, [ErrorSign::Large]));
        Ok(Self { facets, slopes, returned })
    }

    /// `smooth` minus the excess of the reflectance of the facets over a smooth interface.
    fn lessen(&self, smooth: TransmissionFactors, more: [f64; 4]) -> TransmissionFactors {
        let s = (smooth.s - more[0] - more[1]).clamp(0.0, 1.0);
        let p = (smooth.p - more[0] + more[1]).clamp(0.0, 1.0);
        smooth.with_intensities(s, p)
    }
}

/// Transmittance of an interface.
pub(super) struct InterfaceTransmission {
    /// With its polarization: s, p and their coherence.
    pub(super) kept: TransmissionFactors,
    /// Row of the transmitted power for a Stokes vector.
    pub(super) row: [f64; 4],
}

/// The row with no more polarization than intensity, and an intensity of 0 to 1.
pub(super) fn realizable([i, q, u, v]: [f64; 4]) -> [f64; 4] {
    let i = i.clamp(0.0, 1.0);
    let polarized = (q * q + u * u + v * v).sqrt();
    let keep = if polarized > i { i / polarized } else { 1.0 };
    [i, keep * q, keep * u, keep * v]
}

/// The shadowed facets of the index `n` relative to the medium of the light.
pub(super) fn facets(
    n: Complex64,
    films: &[(Complex64, f64)],
    lambda: f64,
    roughness: &RoughnessParameters<'_>,
) -> Result<ParameterNode, ParameterError> {
    let index = |n: Complex64| RefractiveIndex::constant(n.re, n.im);
    let film = |&(n, thickness): &(Complex64, f64)| Film { index: index(n), thickness };
    let films = films.iter().map(film).collect();
    let stack = ParameterNode::with_defaults(&crate::stack::list::SPEC.class, Mode::Sound)
        .with("stack", ParameterValue::Films(films))?;
    ParameterNode::with_defaults(&shadowed::SPEC.class, Mode::Sound)
        .with("lambda", ParameterValue::Number(lambda))?
        .with("substrate", ParameterValue::Index(index(n)))?
        .with("stack", ParameterValue::Member(stack.into()))?
        .with("sdf", ParameterValue::Member(roughness.slopes.clone().into()))?
        .with("shadow", ParameterValue::Member(roughness.shadow.clone().into()))
}

/// BRDF of `brdf` below an interface, seen from above: transmission out · F · transmission in / n².
pub(super) fn behind(
    (out, into): (TransmissionFactors, TransmissionFactors),
    inner: Mueller,
    n_squared: f64,
) -> Mueller {
    out.matrix() * inner * into.matrix() * (1.0 / n_squared)
}
