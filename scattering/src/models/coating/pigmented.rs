//! Rough coat with flakes and a body of spherical particles.
//!
//! $$ \mathbf F = \mathbf F_{surface}
//!  + \frac{\omega_s}{n^2}\,\mathbf T_s\,\mathbf F_{flakes}\,\mathbf T_i
//!  + \frac{\omega_d\,\alpha}{\pi n^2(1-\rho\alpha)}\,\mathbf t_s\otimes\mathbf t_i
//!  + \frac{\omega_s\,\alpha}{\pi n^2(1-\rho_c\alpha)}\,\mathbf c_s\otimes\mathbf c_i $$
//!
//! F_surface: shadowed facets of the coat (`surface_sdf`, `surface_shadow`, `overcoat`,
//! `overcoat_films`). F_flakes: shadowed facets inside the binder (`sdf`, `stack`, `substrate`,
//! `flake_shadow`) at the angles sin θ' = sin θ/n. The body is diffuse with the albedo α of its
//! particles over `backing`; its light comes through the gaps between flakes or through flakes.
//!
//! τ = `flake_density` · `flake_area` · `thickness` is the depth of coverage. Where light goes in
//! and out through gaps that are the same with the probability c (`correlation`),
//! ω_s = (1 − e^{−(2−c)τ})/(2 − c) and ω_d = e^{−(2−c)τ}. For c < 1 their sum is below 1: light
//! caught between flakes is lost. c = 1 is right for flakes much wider than the coat is thick.
//!
//! t is the row of what the rough surface lets pass: what comes of every polarization, less what
//! the facets return. T has the same intensities of s and p. ρ = 1 − ∫t₀ sin 2θ dθ/n² is the part
//! of diffuse light that the surface sends back to the body. Then surface and body return exactly
//! all light if the body is white. c is t times what flakes transmit, ρ_c = r + τ_f²ρ/(1 − rρ)
//! with the diffuse reflectance r and transmittance τ_f of the flakes, but at most
//! 1 − ∫c₀ sin 2θ dθ/n². Because flakes reflect and transmit at most 1 together, the whole is at
//! most ω_s + ω_d ≤ 1 of what enters. This holds for facets that return no more than 1: Gaussian
//! slopes with the Sancer function.
//!
//! Left out: light that goes from flakes back to the surface and in again, light between flakes,
//! the angle dependence of the body, absorption in the binder.
//!
//! `printed` = 1 takes the body as the paper prints it, ω_d α/(4π)·(T_s ± T_p)(T_s ± T_p) of a
//! smooth surface: without the light that goes round, too bright for coloured bodies. `printed` =
//! 2 weights the flakes by e^{−τ} as well, the part that they do not meet.
//!
//! M. I. Sancer, IEEE Trans. Antennas Propag. AP-17, 577 (1969); T. A. Germer and M. E. Nadal,
//! Proc. SPIE 4447, 77 (2001); L. B. Wolff, JOSA A 11, 2956 (1994).

use std::f64::consts::{FRAC_1_PI, FRAC_PI_2};

use super::{
    body::{self, nonnegative},
    flakes::Flakes,
    interface::{Interface, Ray, Roughness, behind},
    passage::{Passage, depolarized},
};
use crate::{
    Direction, Incidence, Mueller, Node, ParamError,
    models::{
        Brdf, COMMON, Common,
        facet::{FACET, subsurface::OVERCOAT},
    },
    spec::{Class, Family, Laws, Param, Spec},
    special::gauss,
    stack::Stack,
};

/// How programs name, parameterize and build it.
pub const SPEC: Spec<dyn Brdf> = Spec {
    class: Class {
        name: "Pigmented_Coating_BRDF_Model",
        parent: "Subsurface_Facet_BRDF_Model",
        summary: "Rough coat with flakes over a body of particles",
        equation: "F = F_surface + ws T F_flakes T/n^2 + wd a/(pi n^2 (1-rho a)) t x t",
        source: "germer-2001 sancer-1969 wolff-1994 vandehulst-1980 wiscombe-1976 wiscombe-1977",
        params: &[COMMON, FACET, OVERCOAT, OWN],
        laws: Laws::ALL,
    },
    build: |node| Ok(Box::new(Pigmented::read(node)?)),
};

const OWN: &[Param] = &[
    Param::member(
        "surface_sdf",
        Family::Slope,
        "Slope_Distribution_Function",
        "Anisotropic_Gaussian_Slope_Distribution_Function",
        "Density of the slopes of the coat's surface",
    ),
    Param::member(
        "surface_shadow",
        Family::Shadow,
        "Shadow_Function",
        "Sancer_Shadow_Function",
        "Shadowing of the coat's surface",
    ),
    Param::number("flake_density", "0.0001", "1/um^3", "Flakes per volume"),
    Param::number("flake_area", "300", "um^2", "Area of a flake"),
    Param::number("thickness", "30", "um", "Thickness of the coat"),
    Param::number(
        "correlation",
        "1",
        "1",
        "Probability that light leaves by the gap by which it entered, 0 to 1",
    ),
    Param::member(
        "particle",
        Family::Scatterer,
        "Free_Space_Scatterer",
        "MieScatterer",
        "Particle of the body; its lambda, medium and radius are set by the coating",
    ),
    Param::number("particle_radius", "0.1", "um", "Radius of the particles"),
    Param::number("particle_density", "0", "1/um^3", "Particles per volume"),
    Param::member(
        "backing",
        Family::Reflectance,
        "Reflectance",
        "Table_Reflectance",
        "Reflectance of what lies below the coat, for diffuse light inside it",
    ),
    Param::integer("printed", "0", "0 consistent, 1 the body as printed, 2 its flakes' weight too"),
    Param::member(
        "flake_shadow",
        Family::Shadow,
        "Shadow_Function",
        "Sancer_Shadow_Function",
        "Shadowing of flakes by each other, at the angles inside the coat",
    ),
    Param::number(
        "flake_spread",
        "0",
        "1",
        "Relative standard deviation of the thickness of the flakes' films, below 1/3",
    ),
    Param::integer("albedo", "0", "Albedo of the body: 0 adding and doubling, 1 Kubelka-Munk"),
];

/// Nodes of the integrals over the surface.
const NODES: usize = 96;

/// A pigmented coating.
struct Pigmented {
    common: Common,
    n: f64,
    surface: Interface,
    flakes: Flakes,
    /// ω_s.
    flake_weight: f64,
    /// Strengths of the body seen through gaps and through flakes.
    gaps: f64,
    through: f64,
    literal: bool,
}

impl Pigmented {
    fn read(node: &Node) -> Result<Self, ParamError> {
        let common = Common::read(node)?;
        common.only_reflection(SPEC.class.name)?;
        let n = node.index("overcoat").at(common.lambda).re;
        if !(n >= 1.0 && n.is_finite()) {
            let problem = format!("an index of {n} is below that of the air");
            return Err(ParamError::new("overcoat", problem));
        }
        let films = node.member::<Stack>("overcoat_films")?.at(common.lambda);
        let roughness =
            Roughness { slopes: node.child("surface_sdf"), shadow: node.child("surface_shadow") };
        let surface =
            Interface::new((1.0, n), &films, common.lambda, Some(roughness)).map_err(rename)?;
        let flakes = Flakes::read(node, &common, n, 1.0 / n)?;
        let alpha = body::albedo(node, common.lambda, n)?;
        let printed = node.integer("printed");
        if !(0..=2).contains(&printed) {
            return Err(ParamError::new("printed", format!("{printed} is not 0, 1 or 2")));
        }
        let (flake_weight, gap_weight) = weights(node, printed == 2)?;
        let mut coating = Self {
            common,
            n,
            surface,
            flakes,
            flake_weight,
            gaps: 0.0,
            through: 0.0,
            literal: printed > 0,
        };
        coating.fill(alpha, gap_weight);
        Ok(coating)
    }

    /// The strengths of the body with the albedo `alpha`.
    fn fill(&mut self, alpha: f64, gap_weight: f64) {
        if self.literal {
            self.gaps = gap_weight * alpha * FRAC_1_PI;
            return;
        }
        let n2 = self.n * self.n;
        let escaping = self.diffuse(|sin| self.surface.mean_passage(sin)) / n2;
        let absorbed = self.absorbed_from_inside();
        let rho = (1.0 - absorbed - escaping).max(0.0);
        let strength = |rho: f64| alpha * FRAC_1_PI / (n2 * (1.0 - rho * alpha));
        self.gaps = gap_weight * strength(rho);
        if !self.flakes.are_opaque() {
            let through = |sin: f64| {
                self.surface.mean_passage(sin).then(self.flakes.passage(sin / self.n, (1.0, 0.0)))
            };
            let (r, t) = self.flakes.diffuse();
            let covered = r + t * t * rho / (1.0 - r * rho);
            self.through =
                self.flake_weight * strength(covered.min(1.0 - self.diffuse(through) / n2));
        }
    }

    /// ∫ ½(s + p) sin 2θ dθ.
    fn diffuse(&self, passage: impl Fn(f64) -> Passage) -> f64 {
        gauss::integrate(NODES, 0.0, FRAC_PI_2, |t| passage(t.sin()).row()[0] * (2.0 * t).sin())
    }

    /// What films on the surface absorb of diffuse light from inside, the roughness left out.
    fn absorbed_from_inside(&self) -> f64 {
        if !self.surface.absorbs() {
            return 0.0;
        }
        let n2 = self.n * self.n;
        let half_space = |sin_outside: &dyn Fn(f64) -> f64, passes: bool| {
            gauss::integrate(NODES, 0.0, FRAC_PI_2, |t| {
                let kappa = sin_outside(t.sin());
                let passed = if passes { self.surface.smooth_passage(kappa).row()[0] } else { 0.0 };
                (1.0 - self.surface.reflects_below(kappa).row()[0] - passed) * (2.0 * t).sin()
            })
        };
        let beyond = n2 - 1.0;
        (half_space(&|sin| sin, true)
            + beyond * half_space(&|sin| (1.0 + beyond * sin * sin).sqrt(), false))
            / n2
    }

    fn body(&self, ray_i: &Ray, ray_s: &Ray) -> Mueller {
        if self.literal {
            let row = |ray: &Ray| self.surface.smooth_passage(ray.sin).row();
            return depolarized(self.gaps, row(ray_s), row(ray_i));
        }
        let mut body = depolarized(self.gaps, self.surface.row(ray_s), self.surface.row(ray_i));
        if self.through > 0.0 {
            body += depolarized(self.through, self.covered(ray_s), self.covered(ray_i));
        }
        body
    }

    /// What passes the surface and the flakes below it.
    fn covered(&self, ray: &Ray) -> [f64; 4] {
        self.surface.passage(ray).then(self.flakes.passage(ray.sin / self.n, ray.turn)).row()
    }
}

/// (ω_s, ω_d).
fn weights(node: &Node, printed: bool) -> Result<(f64, f64), ParamError> {
    let depth = nonnegative(node, "flake_density")?
        * nonnegative(node, "flake_area")?
        * nonnegative(node, "thickness")?;
    let correlation = node.number("correlation");
    if !(0.0..=1.0).contains(&correlation) {
        let problem = format!("{correlation} is not from 0 to 1");
        return Err(ParamError::new("correlation", problem));
    }
    let passes = 2.0 - correlation;
    let open = (-passes * depth).exp();
    if printed {
        return Ok(((-depth).exp(), open));
    }
    Ok((-(-passes * depth).exp_m1() / passes, open))
}

/// The names that the facets of the surface have in the coating.
fn rename(error: ParamError) -> ParamError {
    let own = ["sdf", "shadow"].iter().any(|name| error.parameter.starts_with(name));
    let parameter = if own { format!("surface_{}", error.parameter) } else { error.parameter };
    ParamError { parameter, problem: error.problem }
}

impl Brdf for Pigmented {
    fn common(&self) -> &Common {
        &self.common
    }

    fn mueller(&self, incidence: &Incidence, direction: &Direction) -> Mueller {
        let (ray_i, ray_s) = (Ray::incident(incidence), Ray::reversed(incidence, direction));
        let mut sum = self.body(&ray_i, &ray_s);
        if let Some(facets) = self.surface.facets() {
            sum += facets.mueller(incidence, direction);
        }
        if self.flake_weight > 0.0 {
            let (at, to) = (
                ray_i.below(self.n).incidence(incidence),
                ray_s.below(self.n).direction(direction),
            );
            let crossings = (self.surface.passage(&ray_s), self.surface.passage(&ray_i));
            let inner = self.flakes.mueller(&at, &to) * self.flake_weight;
            sum += behind(crossings, inner, self.n * self.n);
        }
        sum
    }
}
