//! Flakes, or a rough substrate, under a smooth clear coat.
//!
//! $$ \mathbf F = \frac{S(\zeta_x,\zeta_y)}{4 n_z^4\cos\theta_i\cos\theta_s}\,\mathbf M(J), \qquad (1) $$
//! $$ J = t(\theta_s)\,J_{flake}(\theta_i',\theta_s',\phi)\,t(\theta_i) \qquad (2) $$
//!
//! Primes are angles inside the coat, sin θ' = sin θ/n. n̂, its slopes and J_flake are those inside
//! the coat; the cosines of the prefactor are those outside. t = diag(t_s, t_p) are the transmission
//! coefficients from vacuum into the coat with its films. They are used for both crossings and
//! contain the factor n² of the radiance law. Left out: reflection by the coat itself, multiple
//! reflections between coat and flakes, transmission through flakes, and shadowing.
//!
//! NIST's library does not rotate the bases where light hits a flake within 10⁻⁵ rad of its normal
//! ([`Defect::FacetRetro`]).
//!
//! T. A. Germer and M. E. Nadal, Proc. SPIE 4447, 77 (2001); T. A. Germer and E. Marx,
//! Appl. Opt. 43, 1266 (2004).

use num_complex::Complex64;

use super::{FACET, bare::turned, rotation::FacetOrientation};
use crate::{
    Defect, Direction, Incidence, Jones, Mueller, ParameterError, ParameterNode,
    geometry::ScatteredRay,
    models::{Brdf, COMMON, CommonParameters},
    optics::film::{Films, SpAmplitudes},
    slope::SlopeDistribution,
    spec::{Class, Laws, Parameter, Spec},
    stack::{self, Stack},
};

/// The parameters of a clear coat.
pub const OVERCOAT: &[Parameter] = &[
    Parameter::index("overcoat", (1.59, 0.0), "Index of the clear coat; its k is taken as 0"),
    Parameter::member(
        "overcoat_films",
        &stack::FAMILY,
        "No_StackModel",
        "Films on the air side of the coat",
    ),
];

/// Name, parameters and constructor of the class.
pub const SPEC: Spec<dyn Brdf> = Spec {
    class: Class {
        name: "Subsurface_Facet_BRDF_Model",
        parent: "Facet_BRDF_Model",
        summary: "Flakes or a rough layer under a smooth clear coat",
        equation: "F = S(zeta') M(t_s J_flake t_i)/(4 nz'^4 cos(ti) cos(ts))",
        source: "germer-2001 germer-2004",
        params: &[COMMON, FACET, OVERCOAT],
        laws: Laws::NOT_PASSIVE,
    },
    build: |node| Ok(Box::new(SubsurfaceFacet::read(node)?)),
};

/// sin² ι below which NIST's library does not rotate the bases.
const UNTURNED: f64 = 1e-10;

/// Flakes under a clear coat.
pub(crate) struct SubsurfaceFacet {
    common: CommonParameters,
    slopes: Box<dyn SlopeDistribution>,
    coat: f64,
    flakes: Films,
    interface: Films,
    unturned: bool,
}

/// The two rays inside the coat.
pub(super) struct InternalRays {
    pub(super) incidence: Incidence,
    pub(super) direction: Direction,
}

impl SubsurfaceFacet {
    pub(crate) fn read(node: &ParameterNode) -> Result<Self, ParameterError> {
        let common = CommonParameters::read(node)?;
        common.only_reflection(node.class.name)?;
        let coat = node.index("overcoat").at(common.lambda).re;
        if coat < 1.0 || !coat.is_finite() {
            let problem = format!("an index of {coat} is below that of the air");
            return Err(ParameterError::new("overcoat", problem));
        }
        let at = |name: &str| Ok(node.member::<Stack>(name)?.at(common.lambda));
        let (on_flakes, on_coat) = (at("stack")?, at("overcoat_films")?);
        let (air, coat_index) = (Complex64::ONE, Complex64::from(coat));
        Ok(Self {
            common,
            slopes: node.member("sdf")?,
            coat,
            flakes: Films::new(&on_flakes, coat_index, common.substrate, common.lambda),
            interface: Films::new(&on_coat, air, coat_index, common.lambda),
            unturned: node.reproduces(Defect::FacetRetro),
        })
    }

    /// The density of the flakes' slopes.
    pub(crate) fn slopes(&self) -> &dyn SlopeDistribution {
        &*self.slopes
    }

    /// The refracted rays inside the coat.
    pub(super) fn inside(&self, incidence: &Incidence, direction: &Direction) -> InternalRays {
        let (sin_i, sin_s) = (incidence.sin / self.coat, direction.sin / self.coat);
        InternalRays {
            incidence: incidence.inclined((sin_i, (1.0 - sin_i * sin_i).sqrt())),
            direction: direction.inclined((sin_s, (1.0 - sin_s * sin_s).sqrt())),
        }
    }

    /// (J, w) of the flakes alone between rays inside the coat; w lacks 1/(4 cos θ_i cos θ_s).
    fn flakes(&self, inside: &InternalRays) -> (Jones, f64) {
        let InternalRays { incidence, direction } = inside;
        let facet = FacetOrientation::between(incidence, &ScatteredRay::single(direction));
        let n = self.coat;
        let coefficients = self.flakes.r12_known(n * facet.cos(), n * n * facet.sin2);
        let unturned = self.unturned && facet.sin2 <= UNTURNED;
        let (jones, norm) = turned(incidence, direction, direction.cos, coefficients, unturned);
        let [x, y] = facet.slopes;
        // The prefactor of (1) without its cosines.
        (jones, facet.weight(self.slopes.density(x, y), norm))
    }

    fn crossing(&self, sin: f64) -> SpAmplitudes {
        self.interface.t12(sin.into())
    }
}

/// `out`·J·`into` for diagonal `out` and `into`.
fn between(out: SpAmplitudes, jones: Jones, into: SpAmplitudes) -> Jones {
    Jones {
        ss: out.s * jones.ss * into.s,
        ps: out.s * jones.ps * into.p,
        sp: out.p * jones.sp * into.s,
        pp: out.p * jones.pp * into.p,
    }
}

impl SubsurfaceFacet {
    /// (J, w) with the BRDF w·M(J).
    fn event(
        &self,
        incidence: &Incidence,
        direction: &Direction,
        into: SpAmplitudes,
    ) -> (Jones, f64) {
        let (jones, weight) = self.flakes(&self.inside(incidence, direction));
        let jones = between(self.crossing(direction.sin), jones, into);
        (jones, weight / (4.0 * incidence.cos * direction.cos))
    }
}

impl Brdf for SubsurfaceFacet {
    fn common(&self) -> &CommonParameters {
        &self.common
    }

    fn mueller(&self, incidence: &Incidence, direction: &Direction) -> Mueller {
        let (jones, weight) = self.event(incidence, direction, self.crossing(incidence.sin));
        jones.mueller() * weight
    }

    fn mueller_batch(&self, incidence: &Incidence, directions: &[Direction], out: &mut [Mueller]) {
        let into = self.crossing(incidence.sin);
        for (m, direction) in out.iter_mut().zip(directions) {
            let (jones, weight) = self.event(incidence, direction, into);
            *m = jones.mueller() * weight;
        }
    }

    fn jones(&self, incidence: &Incidence, direction: &Direction) -> Option<Jones> {
        let (jones, weight) = self.event(incidence, direction, self.crossing(incidence.sin));
        Some(jones.scaled(weight.sqrt()))
    }

    fn is_coherent(&self) -> bool {
        true
    }
}
