//! Light that the air in the detector's view scatters, with and without a reflection before and
//! after.
//!
//! With r the reflection coefficients of the surface, P = sin θ_i sin θ_s,
//! Q = cos θ_i cos θ_s cos φ, and u, v the sines of the angles between the viewing direction and
//! the beam before and after its reflection, four paths add incoherently:
//!
//! $$ \mathbf{F} = \frac{4\pi^2 (n_{\mathrm{air}} - 1)^2 w}{\lambda^4 N \cdot 2\cos\theta_s}
//!    \left[ \frac{\mathbf{M}(\mathbf{J}_1) + \mathbf{M}(\mathbf{J}_4)}{u}
//!    + \frac{\mathbf{M}(\mathbf{J}_2) + \mathbf{M}(\mathbf{J}_3)}{v} \right] $$
//!
//! w is the width of the field of view, N the number density of the air. J_1 is scattered
//! directly, J_2 reflected before, J_3 after, J_4 before and after. A view along a beam meets it
//! on an infinite length; nearer than 10⁻⁹ rad u and v are held at that value.
//!
//! T. A. Germer and C. C. Asmail, *Goniometric optical scatter instrument for out-of-plane
//! ellipsometry measurements*, Rev. Sci. Instrum. 70, 3688 (1999).

use std::f64::consts::PI;

use num_complex::Complex64;

use crate::{
    Direction, Incidence, Jones, Mueller, ParameterError,
    models::{Brdf, COMMON, CommonParameters},
    optics::film::{Films, SpAmplitudes},
    spec::{Class, Laws, Parameter, Spec},
    stack::{self, Stack},
};

/// Name, parameters and constructor of a [`RayleighAir`].
pub const SPEC: Spec<dyn Brdf> = Spec {
    class: Class {
        name: "Rayleigh_Instrument_BRDF_Model",
        parent: "Instrument_BRDF_Model",
        summary: "Rayleigh scattering by the air in the detector's view",
        equation: "F = 4 pi^2 (n-1)^2 w/(2 lambda^4 N cos_s) [(M(J1)+M(J4))/u + (M(J2)+M(J3))/v]",
        source: "germer-1999",
        params: &[
            COMMON,
            &[
                Parameter::member("stack", &stack::FAMILY, "No_StackModel", "Films"),
                Parameter::number("field_of_view", 1000.0, "um", "Width of the detector's view"),
                Parameter::index("air", (1.0002748, 0.0), "Index of the air"),
                Parameter::number("number_density", 2.51e7, "1/um^3", "Molecules per volume"),
            ],
        ],
        laws: Laws { reciprocal: false, ..Laws::NOT_PASSIVE },
    },
    build: |node| {
        let common = CommonParameters::read(node)?;
        common.only_reflection("Rayleigh_Instrument_BRDF_Model")?;
        let films = node.member::<Stack>("stack")?.at(common.lambda);
        let width = node.number("field_of_view");
        let number = node.number("number_density");
        if !(number > 0.0 && number.is_finite()) {
            let problem = format!("{number} 1/um^3 is not a density of molecules");
            return Err(ParameterError::new("number_density", problem));
        }
        if !(width >= 0.0 && width.is_finite()) {
            return Err(ParameterError::new("field_of_view", format!("{width} um is not a width")));
        }
        let contrast = node.index("air").at(common.lambda).re - 1.0;
        let strength = 2.0 * (PI * contrast).powi(2) * width / (common.lambda.powi(4) * number);
        let films = Films::new(&films, Complex64::ONE, common.substrate, common.lambda);
        Ok(Box::new(RayleighAir { common, films, strength }))
    },
};

/// The air above a surface.
#[derive(Clone, Debug)]
pub struct RayleighAir {
    common: CommonParameters,
    films: Films,
    /// 2π²(n−1)²w/(λ⁴N).
    strength: f64,
}

/// Nearer to a beam the view is held at this sine of its angle to the beam.
const NEAREST: f64 = 1e-9;

impl RayleighAir {
    fn at(&self, before: SpAmplitudes, incidence: &Incidence, direction: &Direction) -> Mueller {
        let after = self.films.r12(direction.sin.into());
        let (p, q) =
            (incidence.sin * direction.sin, incidence.cos * direction.cos * direction.cos_phi);
        let c = Complex64::from(direction.cos_phi);
        let (i, s) = (incidence.cos * direction.sin_phi, direction.cos * direction.sin_phi);
        let direct = Jones::real(c.re, -i, -s, p - q);
        let reflected_before = Jones {
            ss: before.s * c,
            ps: before.p * -i,
            sp: before.s * -s,
            pp: before.p * -(p + q),
        };
        let reflected_after =
            Jones { ss: after.s * -c, ps: after.s * i, sp: after.p * -s, pp: after.p * -(p + q) };
        let reflected_twice = Jones {
            ss: after.s * before.s * -c,
            ps: after.s * before.p * i,
            sp: after.p * before.s * -s,
            pp: after.p * before.p * (p - q),
        };
        let along_source = direct.mueller() + reflected_twice.mueller();
        let along_mirrored = reflected_before.mueller() + reflected_after.mueller();
        (along_source * (1.0 / sine_between(-incidence.sin, incidence.cos, direction))
            + along_mirrored * (1.0 / sine_between(incidence.sin, incidence.cos, direction)))
            * (self.strength / direction.cos)
    }
}

/// Sine of the angle between `direction` and (sin, 0, cos), at least [`NEAREST`].
fn sine_between(sin: f64, cos: f64, direction: &Direction) -> f64 {
    let (x, y) = (direction.sin * direction.cos_phi, direction.sin * direction.sin_phi);
    let across = cos * x - sin * direction.cos;
    (across * across + y * y).sqrt().max(NEAREST)
}

impl Brdf for RayleighAir {
    fn common(&self) -> &CommonParameters {
        &self.common
    }

    fn mueller(&self, incidence: &Incidence, direction: &Direction) -> Mueller {
        self.at(self.films.r12(incidence.sin.into()), incidence, direction)
    }

    fn mueller_batch(&self, incidence: &Incidence, directions: &[Direction], out: &mut [Mueller]) {
        let before = self.films.r12(incidence.sin.into());
        for (m, direction) in out.iter_mut().zip(directions) {
            *m = self.at(before, incidence, direction);
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::{
        Basis, Geometry, Mode, ParameterNode, models, optics::RefractiveIndex, spec::ParameterValue,
    };

    #[test]
    fn without_a_surface_light_at_a_right_angle_to_the_beam_has_no_p() {
        let node = ParameterNode::with_defaults(&super::SPEC.class, Mode::Sound)
            .with("substrate", ParameterValue::Index(RefractiveIndex::constant(1.0, 0.0)))
            .unwrap();
        let theta = std::f64::consts::FRAC_PI_4;
        // The beam goes down along +x; 45° forward is at a right angle to it.
        let at = Geometry { theta_i: theta, theta_s: theta, phi_s: 0.0, rotation: 0.0 };
        let m = models::build(&node).unwrap().mueller(&at, Basis::Psps);
        assert!((m[(1, 0)] / m[(0, 0)] - 1.0).abs() < 1e-12);
        // Air: 4π²(n−1)²/(λ⁴N)·w/(2 cos θ_s) for s light, of which half is counted.
        let expected = 4.0 * std::f64::consts::PI.powi(2) * 0.0002748f64.powi(2) * 1000.0
            / (0.532f64.powi(4) * 2.51e7 * 2.0 * theta.cos());
        assert!((2.0 * m[(0, 0)] / expected - 1.0).abs() < 1e-9);
    }

    #[test]
    fn a_view_along_the_beam_is_finite() {
        let model =
            models::build(&ParameterNode::with_defaults(&super::SPEC.class, Mode::Sound)).unwrap();
        for phi_s in [0.0, std::f64::consts::PI] {
            let at = Geometry { theta_i: 0.5, theta_s: 0.5, phi_s, rotation: 0.0 };
            let m = model.mueller(&at, Basis::Psps);
            assert!(m.0.iter().flatten().all(|x| x.is_finite()));
        }
    }
}
