//! Rough coat with flakes and a body of spherical particles.
//!
//! $$ \mathbf F = \mathbf F_{surface}
//!  + \frac{\omega_s}{n^2}\,\mathbf T_s\,\mathbf F_{flakes}\,\mathbf T_i
//!  + \frac{\omega_d\,\alpha}{\pi n^2(1-\rho\alpha)}\,\mathbf t_s\otimes\mathbf t_i
//!  + \frac{\omega_s}{\pi n^2}\sum_{a,b\in\{l,c\}} G_{ab}\,\mathbf a_s\otimes\mathbf b_i \qquad (1) $$
//!
//! The four terms are:
//!
//! 1. F_surface, the shadowed facets of the surface (`surface_sdf`, `surface_shadow`, `overcoat`,
//!    `overcoat_films`).
//! 2. One reflection by a flake. F_flakes are shadowed facets inside the binder (`sdf`, `stack`,
//!    `substrate`, `flake_shadow`) at the angles sin θ' = sin θ/n; n is the index of the binder.
//! 3. Light that reaches the body through gaps between the flakes. The body is a slab of particles
//!    over `backing`. It depolarizes, returns the fraction α of diffuse light and the fraction
//!    αB(cos θ') of a beam.
//! 4. Light that is reflected by flakes more than once or passes through them
//!    ([`InterreflectionMatrix`] has G).
//!
//! Coverage. τ = `flake_density` · `flake_area` · `thickness` is the mean number of flakes above a
//! point of the body. c = `correlation` is the probability that light leaves through the gap by
//! which it entered; c = 1 holds for flakes that are much wider than the coat is thick. With the
//! absorption κ = 4πk/λ of the binder (k of `overcoat`) and L = `thickness`,
//!
//! $$ E = (2-c)\tau + \kappa L\left(\frac1{\cos\theta_i'}+\frac1{\cos\theta_s'}\right), \qquad
//!    \omega_d = e^{-E}, \qquad \omega_s = \tau\,\frac{1-e^{-E}}{E} \qquad (2) $$
//!
//! For c < 1 and κ = 0 the sum ω_s + ω_d is below 1: the rest is light that is lost between flakes.
//! Diffuse light is absorbed up to the mean depth of the flakes, or down to the body.
//!
//! Transmission of the surface. T has the intensities of s and p and their coherence. t = B · (1 − e)
//! is a row of a Mueller matrix, e the row that the facets return
//! ([`DirectionalAlbedo`](super::directional_albedo)). ρ = ⟨wB²⟩ is a mean over diffuse light, w the
//! internal reflectance of the surface. Without absorption B = 1 and ρ = 1 − ∫ t₀ sin 2θ dθ/n²;
//! surface and white body then return all light.
//!
//! Light between flakes and surface. c is the part of t that passes the flakes; l is the light that
//! they reflect to the surface and that the surface reflects back to them. `exchange` = 0 leaves l
//! out; flakes then look like those of `Shadowed_Subsurface_Facet_BRDF_Model`. With `exchange` = 1
//! and c = 1, transparent flakes without absorption over a white body return all light.
//!
//! Energy. Flakes reflect and transmit together at most 1, so the total is at most ω_s + ω_d ≤ 1 of
//! the light that enters. This holds for facets that return at most 1: Gaussian slopes with the
//! Sancer shadow function.
//!
//! Limits; a notice is given where one is exceeded:
//! - particles fill at most a tenth of the volume (they are taken to scatter independently);
//! - flakes of side √A and slope σ have room to tilt: N A (t + σ√A) ≤ 1, t the thickness of the films;
//! - the light lost between flakes, 1 − ω_s − ω_d, is at most 0.05.
//!
//! `body` = `doubling` builds the same coating as an `Adding_Doubling_BRDF_Model`, whose light keeps
//! its polarization, between flakes and particles too; the parameters of the scalar body
//! (`correlation`, `printed…`, `exchange`, `albedo`, `flake_spread`) are refused then. Flakes and
//! surface need Gaussian slopes, flakes with σ of at least 0.1.
//!
//! Left out by the scalar body: reflections from flake to flake; the directions in which the body returns a beam, beyond
//! B; refraction of the light of flakes and body into other directions by a rough surface.
//!
//! The parameters `printed…` reproduce the equations of the paper as they are printed. None of these
//! forms conserves energy:
//! - `printed` = 1: the body by equation 9, ω_d α/(4π)·(T_s ± T_p)(T_s ± T_p) of a smooth surface,
//!   without internal reflection; too bright for coloured bodies.
//! - `printed` = 2: in addition the flakes are weighted by e^{−τ} (equation 11), the fraction of
//!   light that meets no flake.
//! - `printed_surface` = 1: the surface by equations 4 to 6, with the transposed Jones matrix; right
//!   in the plane of incidence, the reversed path outside of it.
//! - `printed_flakes` = 1: the flakes by equation 8, with the transposed Jones matrix, n² instead of
//!   its η², and (1 + ζ')² instead of (1 + ζ'²)²; brighter by n² and more.
//!
//! M. I. Sancer, IEEE Trans. Antennas Propag. AP-17, 577 (1969); T. A. Germer and M. E. Nadal,
//! Proc. SPIE 4447, 77 (2001); L. B. Wolff, JOSA A 11, 2956 (1994).

mod diffuse_light;
mod parameters;
mod polarized_body;

use std::f64::consts::FRAC_1_PI;

use diffuse_light::DiffuseLight;

use super::{
    body,
    cover::FlakeCover,
    doubling::DiffuseSlab,
    flakes::Flakes,
    interface::{
        Interface, InterfaceRay, InterfaceTransmission, RoughnessParameters, behind, realizable,
    },
    interreflection::InterreflectionMatrix,
    published::{PublishedForm, printed_jacobian, transposed_jones},
    transmission::depolarized,
};
use crate::{
    Direction, Incidence, ModelLimit, Mueller, ParameterError, ParameterNode,
    models::{
        Brdf, COMMON, CommonParameters,
        facet::{FACET, subsurface::OVERCOAT},
    },
    slope::SlopeDistribution,
    spec::{Class, Laws, Spec},
    stack::Stack,
};

/// Name, parameters and constructor of the class.
pub const SPEC: Spec<dyn Brdf> = Spec {
    class: Class {
        name: "Pigmented_Coating_BRDF_Model",
        parent: "Subsurface_Facet_BRDF_Model",
        summary: "Rough coat with flakes over a body of particles",
        equation: "F = F_surface + ws T F_flakes T/n^2 + wd a/(pi n^2 (1-rho a)) t x t + light through flakes",
        source: "germer-2001 sancer-1969 wolff-1994 vandehulst-1980 wiscombe-1976 wiscombe-1977",
        params: &[COMMON, FACET, OVERCOAT, parameters::OWN],
        laws: Laws::ALL,
    },
    build: |node| match node.text("body") {
        "" | "scalar" => Ok(Box::new(PigmentedCoating::read(node)?)),
        "doubling" => polarized_body::build(node),
        other => {
            let problem = format!("{other:?} is neither scalar nor doubling");
            Err(ParameterError::new("body", problem))
        }
    },
};

/// Largest volume fraction of particles that scatter independently: denser ones are closer than
/// about a radius.
const INDEPENDENT: f64 = 0.1;

/// Fraction of light lost between flakes above which a notice is given.
const LOST: f64 = 0.05;

/// A pigmented coating.
struct PigmentedCoating {
    common: CommonParameters,
    n: f64,
    surface: Interface,
    flakes: Flakes,
    cover: FlakeCover,
    slab: DiffuseSlab,
    /// Factor of t ⊗ t in the third term of (1).
    gaps: f64,
    /// Factors of the fourth term of (1).
    through: InterreflectionMatrix,
    /// True if light between flakes and surface is included (`exchange`).
    exchange: bool,
    printed: PublishedForm,
}

impl PigmentedCoating {
    fn read(node: &ParameterNode) -> Result<Self, ParameterError> {
        let common = CommonParameters::read(node)?;
        common.only_reflection(SPEC.class.name)?;
        let binder = node.index("overcoat").at(common.lambda);
        if !(binder.re > 0.0 && binder.re.is_finite() && binder.im >= 0.0) {
            return Err(ParameterError::new("overcoat", format!("{binder} is not an index")));
        }
        let films = node.member::<Stack>("overcoat_films")?.at(common.lambda);
        let roughness = RoughnessParameters {
            slopes: node.child("surface_sdf"),
            shadow: node.child("surface_shadow"),
        };
        let surface = Interface::new((1.0, binder.re), &films, common.lambda, Some(roughness))
            .map_err(rename)?;
        let printed = node.integer("printed");
        if !(0..=2).contains(&printed) {
            return Err(ParameterError::new("printed", format!("{printed} is not 0, 1 or 2")));
        }
        let mut coating = Self {
            common,
            n: binder.re,
            surface,
            flakes: Flakes::read(node, &common, binder)?,
            cover: FlakeCover::read(node, common.lambda, binder.im, printed == 2)?,
            slab: DiffuseSlab::uniform(0.0),
            gaps: 0.0,
            through: InterreflectionMatrix::default(),
            exchange: switch(node, "exchange")?,
            printed: PublishedForm {
                body: printed > 0,
                surface: switch(node, "printed_surface")?,
                flakes: switch(node, "printed_flakes")?,
            },
        };
        coating.fill(node)?;
        coating.note_limits(node)?;
        Ok(coating)
    }

    /// Computes the quantities that are the same for all directions.
    fn fill(&mut self, node: &ParameterNode) -> Result<(), ParameterError> {
        self.slab = body::read(node, self.common.lambda, self.n)?;
        let alpha = self.slab.reflectance;
        if self.printed.body {
            self.gaps = self.cover.gaps() * alpha * FRAC_1_PI;
            return Ok(());
        }
        let n2 = self.n * self.n;
        let shape = |ray: &InterfaceRay| self.slab.shape(ray.cos);
        let light = self.diffuse_light();
        let escaping = light.escaping(|ray| {
            self.surface.mean_passage(ray.sin).row()[0] * shape(&ray.below(self.n))
        });
        let returned = light.inside(|ray| {
            light.internal_reflectance(ray) * self.cover.left(2.0, ray.cos) * shape(ray).powi(2)
        });
        // α returned ≤ 1 − escaping, exactly where nothing absorbs.
        let rho =
            if alpha * returned > 1.0 - escaping { (1.0 - escaping) / alpha } else { returned };
        self.gaps = self.cover.gaps() * alpha * FRAC_1_PI / (n2 * (1.0 - rho * alpha));
        let weight = self.cover.covered();
        let seen = weight > 0.0 && (self.exchange || self.flakes.are_transparent());
        if seen {
            let Self { flakes, surface, cover, .. } = self;
            let level = cover.level();
            let internal =
                |up: &InterfaceRay| surface.sends_back(up).scaled(cover.left(2.0 * level, up.cos));
            flakes.tabulate(node, &internal, 1.0 / self.n)?;
            let InterreflectionMatrix { ll, lc, cc } =
                InterreflectionMatrix::new(&self.diffuse_light().means(), alpha);
            let part = |x: f64| x * weight * FRAC_1_PI / n2;
            self.through = InterreflectionMatrix { ll: part(ll), lc: part(lc), cc: part(cc) };
        }
        Ok(())
    }

    fn diffuse_light(&self) -> DiffuseLight<'_> {
        let Self { n, surface, flakes, cover, slab, .. } = self;
        DiffuseLight { n: *n, surface, flakes, cover, slab }
    }

    fn note_limits(&self, node: &ParameterNode) -> Result<(), ParameterError> {
        if body::filled(node) > INDEPENDENT {
            node.note_limit(ModelLimit::ParticlesTooDense);
        }
        let side = node.number("flake_area").sqrt();
        let slopes = node.member::<dyn SlopeDistribution>("sdf")?;
        let tilt = slopes.deviations().map_or(0.0, |(x, y)| x.max(y));
        let films = node.member::<Stack>("stack")?.at(self.common.lambda);
        let thickness: f64 = films.iter().map(|(_, t)| t).sum();
        let room = node.number("flake_density") * side * side * (thickness + tilt * side);
        if room > 1.0 {
            node.note_limit(ModelLimit::FlakesTooDense);
        }
        if 1.0 - self.cover.gaps() - self.cover.covered() > LOST {
            node.note_limit(ModelLimit::LostBetweenFlakes);
        }
        Ok(())
    }

    /// The third term of (1): light of the body through gaps between flakes.
    fn body(&self, out: &SurfaceRay, into: &SurfaceRay) -> Mueller {
        if self.printed.body {
            let row = |side: &SurfaceRay| self.surface.smooth_passage(side.outside.sin).row();
            return depolarized(self.gaps, row(out), row(into));
        }
        let row = |side: &SurfaceRay| {
            let left = self.to_body(&side.inside);
            side.crossing.row.map(|x| x * left)
        };
        depolarized(self.gaps, row(out), row(into))
    }

    /// Transmittance from the surface to the body, times B at this angle.
    fn to_body(&self, inside: &InterfaceRay) -> f64 {
        self.cover.left(1.0, inside.cos) * self.slab.shape(inside.cos)
    }

    /// The rows l and c of a ray.
    fn spaces(&self, side: &SurfaceRay) -> ([f64; 4], [f64; 4]) {
        let (returned, caught) = self.flakes.rows(&side.inside);
        let kept = &side.crossing.kept;
        let level = self.cover.left(self.cover.level(), side.inside.cos);
        let l = if self.exchange { kept.before(caught).map(|x| x * level) } else { [0.0; 4] };
        if !self.flakes.are_transparent() {
            return (realizable(l), [0.0; 4]);
        }
        let reflected = kept.before(returned);
        let (s, p) = self.flakes.absorbed(side.inside.sin);
        let absorbed = kept.before([0.5 * (s + p), 0.5 * (s - p), 0.0, 0.0]);
        let left = self.to_body(&side.inside);
        let c = std::array::from_fn(|k| left * (side.crossing.row[k] - reflected[k] - absorbed[k]));
        (realizable(l), realizable(c))
    }

    /// The fourth term of (1): several reflections by flakes, or transmission through them.
    fn through(&self, out: &SurfaceRay, into: &SurfaceRay) -> Mueller {
        let ((l_s, c_s), (l_i, c_i)) = (self.spaces(out), self.spaces(into));
        let InterreflectionMatrix { ll, lc, cc } = self.through;
        let mut sum = depolarized(cc, c_s, c_i);
        if self.exchange {
            sum += depolarized(ll, l_s, l_i);
            sum += depolarized(lc, l_s, c_i);
            sum += depolarized(lc, c_s, l_i);
        }
        sum
    }

    /// The second term of (1): one reflection by a flake.
    fn by_flakes(
        &self,
        (into, incidence): (&SurfaceRay, &Incidence),
        (out, direction): (&SurfaceRay, &Direction),
    ) -> Mueller {
        let weight = self.cover.flakes(into.inside.cos, out.inside.cos);
        if weight == 0.0 {
            return Mueller::ZERO;
        }
        let (at, to) = (into.inside.incidence(incidence), out.inside.direction(direction));
        let mut inner = self.flakes.mueller(&at, &to) * weight;
        let mut n2 = self.n * self.n;
        if self.printed.flakes {
            inner = transposed_jones(&inner) * printed_jacobian(&at, &to);
            n2 = 1.0;
        }
        behind((out.crossing.kept, into.crossing.kept), inner, n2)
    }
}

/// A ray outside and inside of the coat, and its transmission through the surface.
struct SurfaceRay {
    outside: InterfaceRay,
    inside: InterfaceRay,
    crossing: InterfaceTransmission,
}

/// The parameter `name`, 0 or 1.
fn switch(node: &ParameterNode, name: &str) -> Result<bool, ParameterError> {
    match node.integer(name) {
        0 => Ok(false),
        1 => Ok(true),
        other => Err(ParameterError::new(name, format!("{other} is not 0 or 1"))),
    }
}

/// `error` with the name that a parameter of the facets has in the coating.
fn rename(error: ParameterError) -> ParameterError {
    let own = ["sdf", "shadow"].iter().any(|name| error.parameter.starts_with(name));
    let parameter = if own { format!("surface_{}", error.parameter) } else { error.parameter };
    ParameterError { parameter, problem: error.problem }
}

impl Brdf for PigmentedCoating {
    fn common(&self) -> &CommonParameters {
        &self.common
    }

    fn mueller(&self, incidence: &Incidence, direction: &Direction) -> Mueller {
        let side = |outside: InterfaceRay| SurfaceRay {
            outside,
            inside: outside.below(self.n),
            crossing: self.surface.crossing(&outside),
        };
        let (into, out) = (
            side(InterfaceRay::incident(incidence)),
            side(InterfaceRay::reversed(incidence, direction)),
        );
        let mut sum = self.body(&out, &into);
        if let Some(facets) = self.surface.facets() {
            let seen = facets.mueller(incidence, direction);
            sum += if self.printed.surface { transposed_jones(&seen) } else { seen };
        }
        if self.cover.depth > 0.0 || self.cover.printed {
            sum += self.by_flakes((&into, incidence), (&out, direction));
            if self.through != InterreflectionMatrix::default() {
                sum += self.through(&out, &into);
            }
        }
        sum
    }
}
