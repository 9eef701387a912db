//! Diffuse body under a smooth interface, with internal reflection at the interface.
//!
//! $$ \mathbf{F} = \frac{x(\theta_i)\,x(\theta_s)}{n^2 (1 - \rho R)}\,
//!    \mathbf{T}(\theta_s)\,\mathrm{diag}(R/\pi, 0, 0, 0)\,\mathbf{T}(\theta_i), \qquad
//!    x(\theta) = \frac{\sqrt{n^2 - \sin^2\theta}}{\cos\theta} \qquad (1) $$
//!
//! R is the reflectance of the body inside the medium of index n (`substrate` without its k), T
//! the Mueller matrix of the amplitudes t12 of the filmed interface, and ρ the reflectance of the
//! interface for diffuse light from inside,
//!
//! $$ \rho = \int_0^{\pi/2} \tfrac12 (|r_s|^2 + |r_p|^2) \sin 2\theta'\, d\theta' \qquad (2) $$
//!
//! With κ = n sin θ' the integral is split at the critical angle, so that its integrand is smooth:
//! κ = sin θ below it and κ² = 1 + (n² − 1) sin² ψ beyond. For transparent films ρ = 1 − T/n², T the
//! transmittance of diffuse light from outside: no light is lost. With `--compat` the integral is a
//! sum of 451 rectangles of 0.2°, and beyond the critical angle it has the growing wave outside
//! absorbing films.
//!
//! L. B. Wolff, JOSA A 11, 2956 (1994).

use std::f64::consts::{FRAC_1_PI, FRAC_PI_2};

use super::lambertian::BODY;
use crate::{
    Defect, Direction, Incidence, Mueller, ParameterError, ParameterNode,
    models::{
        Brdf, COMMON, CommonParameters,
        smooth_interface::{INTERFACE, interface},
    },
    optics::film::Films,
    reflectance,
    spec::{Class, Laws, Spec},
    special::gauss,
};

/// Name, parameters and constructor of a [`DiffuseSubsurface`] body.
pub const SPEC: Spec<dyn Brdf> = Spec {
    class: Class {
        name: "Diffuse_Subsurface_BRDF_Model",
        parent: "Lambertian_BRDF_Model",
        summary: "Diffuse body under a smooth interface",
        equation: "F = x(ti) x(ts)/(n^2 (1-rho R)) T(ts) diag(R/pi,0,0,0) T(ti)",
        source: "wolff-1994",
        params: &[COMMON, BODY, INTERFACE],
        laws: Laws::ALL,
    },
    build: |node| Ok(Box::new(DiffuseSubsurface::read(node)?)),
};

/// A diffuse body under a smooth interface.
#[derive(Clone, Debug)]
pub struct DiffuseSubsurface {
    common: CommonParameters,
    films: Films,
    /// n².
    n2: f64,
    /// R/(π n² (1 − ρR)).
    strength: f64,
}

impl DiffuseSubsurface {
    fn read(node: &ParameterNode) -> Result<Self, ParameterError> {
        let common = CommonParameters::read(node)?;
        common.only_reflection(SPEC.class.name)?;
        let n = common.substrate.re;
        let films = interface(node, &common, n.into())?;
        let body = reflectance::read(node, "reflectance", common.lambda)?;
        let rho = recycled(node, &common, &films)?;
        // The factor of x T x T in (1).
        let strength = FRAC_1_PI * body / (n * n * (1.0 - rho * body));
        Ok(Self { common, films, n2: n * n, strength })
    }

    /// (T00, T10) times x at an angle from outside.
    fn transmitted(&self, sin: f64, cos: f64) -> (f64, f64) {
        let x = (self.n2 - sin * sin).max(0.0).sqrt() / cos;
        let t = self.films.t12(sin.into());
        let (s, p) = (t.s.norm_sqr(), t.p.norm_sqr());
        (0.5 * x * (s + p), 0.5 * x * (s - p))
    }

    fn matrix(&self, (i0, i1): (f64, f64), (s0, s1): (f64, f64)) -> Mueller {
        let (a, b) = (self.strength * s0, self.strength * s1);
        let mut m = Mueller::ZERO;
        (m.0[0][0], m.0[0][1], m.0[1][0], m.0[1][1]) = (a * i0, a * i1, b * i0, b * i1);
        m
    }
}

impl Brdf for DiffuseSubsurface {
    fn common(&self) -> &CommonParameters {
        &self.common
    }

    fn mueller(&self, incidence: &Incidence, direction: &Direction) -> Mueller {
        let entering = self.transmitted(incidence.sin, incidence.cos);
        self.matrix(entering, self.transmitted(direction.sin, direction.cos))
    }

    fn mueller_batch(&self, incidence: &Incidence, directions: &[Direction], out: &mut [Mueller]) {
        let entering = self.transmitted(incidence.sin, incidence.cos);
        for (m, direction) in out.iter_mut().zip(directions) {
            *m = self.matrix(entering, self.transmitted(direction.sin, direction.cos));
        }
    }
}

/// ρ of the interface.
fn recycled(
    node: &ParameterNode,
    common: &CommonParameters,
    films: &Films,
) -> Result<f64, ParameterError> {
    let stack = node.member::<crate::stack::Stack>("stack")?.at(common.lambda);
    let absorbs = stack.iter().any(|film| film.0.im != 0.0);
    let growing = absorbs && node.reproduces(Defect::RecyclingBranch);
    if node.reproduces(Defect::RecyclingSum) {
        let films = films.clone();
        return Ok(rectangles(&if growing { films.with_growing_branch() } else { films }));
    }
    // Ten nodes for each half wave of optical thickness resolve the interference fringes.
    let thickness: f64 = stack.iter().map(|film| film.0.norm() * film.1).sum();
    let nodes = 64 + (20.0 * thickness / common.lambda).min(4000.0) as usize;
    Ok(integral(films, nodes))
}

/// ½(|r_s|² + |r_p|²) from inside.
fn reflected(films: &Films, kappa: f64) -> f64 {
    let r = films.r21(kappa.into());
    0.5 * (r.s.norm_sqr() + r.p.norm_sqr())
}

/// ρ of (2) with `nodes` nodes on each side of the critical angle.
fn integral(films: &Films, nodes: usize) -> f64 {
    let n = films.substrate().re;
    let half_space = |kappa: &dyn Fn(f64) -> f64| {
        gauss::integrate(nodes, 0.0, FRAC_PI_2, |t| {
            reflected(films, kappa(t.sin())) * (2.0 * t).sin()
        })
    };
    if n <= 1.0 {
        return half_space(&|sin| n * sin);
    }
    let beyond = n * n - 1.0;
    (half_space(&|sin| sin) + beyond * half_space(&|sin| (1.0 + beyond * sin * sin).sqrt()))
        / (n * n)
}

/// ρ of (2) by rectangles of 0.2°.
fn rectangles(films: &Films) -> f64 {
    let n = films.substrate().re;
    let (mut sum, mut weights) = (0.0, 0.0);
    for j in 0..=450 {
        let theta = f64::from(j) * 0.2_f64.to_radians();
        let weight = (2.0 * theta).sin();
        sum += weight * reflected(films, n * theta.sin());
        weights += weight;
    }
    sum / weights
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use num_complex::Complex64;

    use super::*;
    use crate::{Mode, ParameterValue, optics::RefractiveIndex};

    fn bare(n: f64) -> Films {
        Films::new(&[], Complex64::ONE, n.into(), 0.5)
    }

    fn filmed(mode: Mode, n: f64, film: (f64, f64, f64)) -> DiffuseSubsurface {
        let index = |n, k| ParameterValue::Index(RefractiveIndex::constant(n, k));
        let stack = ParameterNode::with_defaults(
            crate::registry::find_class("SingleFilm_StackModel").unwrap(),
            mode,
        )
        .with("material", index(film.0, film.1))
        .and_then(|node| node.with("thickness", ParameterValue::Number(film.2)))
        .unwrap();
        let node = ParameterNode::with_defaults(&SPEC.class, mode)
            .with("substrate", index(n, 0.0))
            .and_then(|node| node.with("stack", ParameterValue::Member(Arc::new(stack))))
            .unwrap();
        DiffuseSubsurface::read(&node).unwrap()
    }

    /// Reflectances of a white body and of its interface for unpolarized light at 0.6 rad.
    fn returned(model: &DiffuseSubsurface) -> (f64, f64) {
        let at = Incidence::new(0.6, 0.0);
        let r = model.films.r12(at.sin.into());
        let diffuse = gauss::integrate(64, 0.0, FRAC_PI_2, |t| {
            let f = model.mueller(&at, &Direction::new(t, 0.0));
            std::f64::consts::PI * (2.0 * t).sin() * f[(0, 0)]
        });
        (diffuse, 0.5 * (r.s.norm_sqr() + r.p.norm_sqr()))
    }

    #[test]
    fn recycled_fraction_of_glass_is_the_exact_one() {
        // 1 − T/n², T the exact diffuse transmittance from outside: ten digits for n = 1.5.
        assert!((integral(&bare(1.5), 64) - 0.596_345_759_7).abs() < 1e-10);
        assert!((rectangles(&bare(1.5)) - 0.59635).abs() < 1e-5);
    }

    #[test]
    fn a_white_body_returns_all_light_soundly_and_a_little_more_in_compat() {
        for n in [1.33, 1.5, 1.8] {
            let (diffuse, specular) = returned(&filmed(Mode::Sound, n, (1.38, 0.0, 0.1)));
            assert!((diffuse + specular - 1.0).abs() < 1e-10, "{n}: {}", diffuse + specular);
        }
        // The 0.2° sum finds 3·10⁻⁴ too much recycled light at this index.
        let (diffuse, specular) = returned(&filmed(Mode::Compat, 1.8, (1.8, 0.0, 0.0)));
        let excess = diffuse + specular - 1.0;
        assert!(excess > 2e-4 && excess < 4e-4, "{excess}");
    }

    #[test]
    fn absorbing_films_recycle_what_they_do_not_absorb() {
        // 0.1 µm of 1.8 + 0.3i on 1.6 at 0.55 µm, and the growing wave of the library.
        let films =
            Films::new(&[(Complex64::new(1.8, 0.3), 0.1)], Complex64::ONE, 1.6.into(), 0.55);
        assert!((integral(&films, 80) - 0.112).abs() < 1e-3, "{}", integral(&films, 80));
        assert!((rectangles(&films.with_growing_branch()) - 0.261).abs() < 1e-3);
    }

    #[test]
    fn the_integral_has_converged_for_thick_films_and_thin_bodies() {
        let films = Films::new(&[(1.5.into(), 10.0)], Complex64::ONE, 1.7.into(), 0.5);
        // The chosen number of nodes against twice as many.
        assert!((integral(&films, 664) - integral(&films, 1328)).abs() < 1e-10);
        assert!((integral(&bare(0.8), 64) - integral(&bare(0.8), 128)).abs() < 1e-10);
    }

    #[test]
    fn the_reported_index_keeps_the_absorption_that_the_model_ignores() {
        let node = ParameterNode::with_defaults(&SPEC.class, Mode::Sound);
        let model = DiffuseSubsurface::read(&node).unwrap();
        assert_eq!(model.common().substrate, Complex64::new(4.05, 0.05));
        assert_eq!(model.films.substrate().im, 0.0);
    }
}
