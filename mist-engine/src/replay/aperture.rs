//! The parameters of an integral, from the values of their expressions.

use mist_format::{
    Diagnostic,
    expr::Value,
    program::{ApertureShape, SourceText},
};
use scattering::Stokes;

use crate::{
    fault::{Fault, fault},
    plan::{ApertureParameter, IntegralPlan},
    region::Region,
    sampling::SamplingRule,
    step::StepIntegral,
};

/// The parameters of an integral while they are read.
#[derive(Default)]
pub(super) struct ApertureBuilder {
    center: (f64, f64),
    inner_center: (f64, f64),
    alpha: f64,
    inner_alpha: f64,
    vertices: Vec<(f64, f64)>,
    pol_center: (f64, f64),
    pol: Option<Stokes>,
    inpol: Stokes,
}

impl ApertureBuilder {
    /// Nothing but the incident light.
    pub(super) fn under(inpol: Stokes) -> Self {
        Self { inpol, ..Self::default() }
    }

    /// Takes what `text` gave for `key`.
    pub(super) fn set(
        &mut self,
        key: ApertureParameter,
        value: &Value,
        text: &SourceText,
    ) -> Result<(), Fault> {
        match key {
            ApertureParameter::Center | ApertureParameter::OuterCenter => {
                self.center = direction(value, text)?
            }
            ApertureParameter::InnerCenter => self.inner_center = direction(value, text)?,
            ApertureParameter::Alpha | ApertureParameter::OuterAlpha => self.alpha = value.number(),
            ApertureParameter::InnerAlpha => self.inner_alpha = value.number(),
            ApertureParameter::Vertex => self.vertices.push(direction(value, text)?),
            ApertureParameter::PolCenter => self.pol_center = direction(value, text)?,
            ApertureParameter::Pol => self.pol = Some(stokes(value, text)?),
            ApertureParameter::InPol => self.inpol = stokes(value, text)?,
        }
        Ok(())
    }

    /// The integral that `plan` makes of them.
    pub(super) fn integral(self, plan: &IntegralPlan, rule: SamplingRule) -> StepIntegral {
        let region = match plan.shape {
            ApertureShape::Differential => Region::Differential { center: self.center },
            ApertureShape::Circle => Region::around(self.center, self.alpha),
            ApertureShape::Hemi => Region::Hemi,
            ApertureShape::Annulus => Region::Annulus {
                outer_center: self.center,
                outer_alpha: self.alpha,
                inner_center: self.inner_center,
                inner_alpha: self.inner_alpha,
            },
            ApertureShape::Polygon => {
                Region::Polygon { vertices: self.vertices, polarization_center: self.pol_center }
            }
        };
        let pol = self.pol.unwrap_or(Stokes::UNPOLARIZED);
        StepIntegral { region, rule, pol, inpol: self.inpol }
    }
}

fn direction(value: &Value, text: &SourceText) -> Result<(f64, f64), Fault> {
    match value.as_slice() {
        [theta, phi, ..] => Ok((*theta, *phi)),
        _ => {
            let message = "a direction has two elements, (theta,phi)";
            let found = fault("integral/direction", text, message);
            Err(Box::new(found.help("write both angles, in radians: (0.3,0)")))
        }
    }
}

/// The Stokes vector that `text` gave.
pub(super) fn stokes(value: &Value, text: &SourceText) -> Result<Stokes, Fault> {
    match value.as_slice() {
        [i, q, u, v, ..] => Ok(Stokes([*i, *q, *u, *v])),
        short => Err(Box::new(
            Diagnostic::error(
                "program/stokes",
                text.span(),
                format!("a Stokes vector has four elements, this has {}", short.len()),
            )
            .help("write (I,Q,U,V), such as (1,0,0,0) for unpolarized light"),
        )),
    }
}
