//! Rough coat with flakes and a body of spherical particles.
//!
//! $$ \mathbf F = \mathbf F_{surface}
//!  + \frac{\omega_s}{n^2}\,\mathbf T_s\,\mathbf F_{flakes}\,\mathbf T_i
//!  + \frac{\omega_d\,\alpha}{\pi n^2(1-\rho\alpha)}\,\mathbf t_s\otimes\mathbf t_i
//!  + \frac{\omega_s}{\pi n^2}\sum_{a,b\in\{l,c\}} G_{ab}\,\mathbf a_s\otimes\mathbf b_i $$
//!
//! F_surface: shadowed facets of the coat (`surface_sdf`, `surface_shadow`, `overcoat`,
//! `overcoat_films`). F_flakes: shadowed facets inside the binder (`sdf`, `stack`, `substrate`,
//! `flake_shadow`) at the angles sin θ' = sin θ/n. The body returns the part α of diffuse light and
//! αB(cos θ') of a beam, by its particles over `backing`, and depolarizes; its light comes through
//! the gaps between flakes or through flakes.
//!
//! τ = `flake_density` · `flake_area` · `thickness` is the depth of coverage. Where light goes in
//! and out through gaps that are the same with the probability c (`correlation`),
//! ω_s = (1 − e^{−(2−c)τ})/(2 − c) and ω_d = e^{−(2−c)τ}. For c < 1 their sum is below 1: light
//! caught between flakes is lost. c = 1 is right for flakes much wider than the coat is thick.
//! A binder that absorbs (k of `overcoat`, κ = 4πk/λ, L = `thickness`) adds
//! κL(1/cos θ_i' + 1/cos θ_s') to the exponent: with E the sum of both, ω_d = e^{−E} and
//! ω_s = τ(1 − e^{−E})/E; diffuse light crosses it up to the flakes' mean depth or the body.
//!
//! t is the row of what the rough surface lets pass: what comes of every polarization, less what
//! the facets return; times B. T has the same intensities of s and p. ρ = ⟨wB²⟩, w what the surface
//! sends back of light from below; without absorption B is 1 and ρ = 1 − ∫t₀ sin 2θ dθ/n². Then surface and
//! body return exactly all light if the body is white. c is what of t passes the flakes, l what
//! they reflect and the surface sends back to them; [`InterreflectionMatrix`] has G. `exchange` = 0 leaves l
//! out: flakes are then seen as those of `Shadowed_Subsurface_Facet_BRDF_Model`. With `exchange`
//! = 1 and c = 1, transparent flakes that do not absorb over a white body return all light too.
//! Because flakes reflect and transmit at most 1 together, the whole is at most ω_s + ω_d ≤ 1 of
//! what enters. This holds for facets that return no more than 1: Gaussian slopes with the Sancer
//! function.
//!
//! Limits, noted where they are passed: particles fill at most a tenth of the volume (they are
//! taken to scatter independently); flakes of side √A and slope σ have the room N A (t + σ√A) ≤ 1
//! to tilt; what is lost between flakes, 1 − ω_s − ω_d, is at most 0.05.
//!
//! Left out: light between flakes, what the body does to a beam beyond that (its light leaves as
//! if diffuse light had entered), refraction of the light of
//! flakes and body into other directions by a rough surface.
//!
//! `printed` = 1 takes the body as the paper prints it (equation 9), ω_d α/(4π)·(T_s ± T_p)(T_s ±
//! T_p) of a smooth surface: without the light that goes round, too bright for coloured bodies.
//! `printed` = 2 weights the flakes by e^{−τ} as well (equation 11), the part that they do not
//! meet. `printed_surface` = 1 takes the facets of the surface as equations 4 to 6 print them, with
//! the Jones matrix transposed: right in the plane of incidence, the reversed path outside of it.
//! `printed_flakes` = 1 takes equation 8: the transposed Jones matrix, n² in place of its η²,
//! (1 + ζ')² for (1 + ζ'²)²; brighter by n² and more. Energy is not kept in any of these.
//!
//! M. I. Sancer, IEEE Trans. Antennas Propag. AP-17, 577 (1969); T. A. Germer and M. E. Nadal,
//! Proc. SPIE 4447, 77 (2001); L. B. Wolff, JOSA A 11, 2956 (1994).

mod diffuse_light;
mod parameters;

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
    build: |node| Ok(Box::new(PigmentedCoating::read(node)?)),
};

/// Spheres that fill more of the volume do not scatter independently: they are closer than about
/// a radius then.
const INDEPENDENT: f64 = 0.1;

/// Light lost between flakes above which a notice is given.
const LOST: f64 = 0.05;

/// A pigmented coating.
struct PigmentedCoating {
    common: CommonParameters,
    n: f64,
    surface: Interface,
    flakes: Flakes,
    cover: FlakeCover,
    slab: DiffuseSlab,
    /// Strength of the body seen through gaps.
    gaps: f64,
    /// Strengths of what goes by flakes other than by one reflection.
    through: InterreflectionMatrix,
    /// True if light between flakes and surface is taken in.
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

    /// Quantities that are the same for all directions.
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

    /// Fraction of a ray that reaches the body, times the fraction that returns to a beam at this angle.
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

    /// Light that went by flakes other than by one reflection.
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

    /// One reflection by flakes.
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

/// A ray, outside and inside, and what of it crosses the surface.
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

/// The names that the facets of the surface have in the coating.
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
