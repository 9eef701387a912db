//! Rough surfaces: the parameters, the spatial frequency and the spectrum of every model.

use crate::{
    Direction, Incidence,
    models::brdf::CommonParameters,
    psd::{self, Psd},
    spec::{Parameter, ParameterError, ParameterNode},
    stack,
};

/// The parameter of every roughness model.
pub const ROUGHNESS: &[Parameter] = &[Parameter::member(
    "psd",
    &psd::FAMILY,
    "ABC_PSD_Function",
    "Power spectral density of surface height",
)];

/// The films of a stack model.
pub(super) const STACK: &[Parameter] =
    &[Parameter::member("stack", &stack::FAMILY, "No_StackModel", "Films")];

/// Data of every roughness model: the common part, the spectrum, the frequencies.
pub(super) struct RoughSurface {
    pub(super) common: CommonParameters,
    pub(super) psd: Box<dyn Psd>,
    /// m_i/λ and m_s/λ, 1/µm.
    per_sine: (f64, f64),
}

impl RoughSurface {
    pub(super) fn read(node: &ParameterNode) -> Result<Self, ParameterError> {
        let common = CommonParameters::read(node)?;
        let index = |inside: bool| if inside { common.substrate.re } else { 1.0 };
        let per_sine = (
            index(common.side.from_below()) / common.lambda,
            index(common.side.to_below()) / common.lambda,
        );
        Ok(Self { common, psd: node.member::<dyn Psd>("psd")?, per_sine })
    }

    /// (f_x, f_y) in the frame of the sample, 1/µm.
    pub(super) fn frequency(&self, incidence: &Incidence, direction: &Direction) -> (f64, f64) {
        let (incident, scattered) = self.per_sine;
        let out = scattered * direction.sin;
        incidence
            .to_sample(out * direction.cos_phi - incident * incidence.sin, out * direction.sin_phi)
    }

    /// PSD at that frequency, µm⁴.
    pub(super) fn density(&self, incidence: &Incidence, direction: &Direction) -> f64 {
        let (fx, fy) = self.frequency(incidence, direction);
        self.psd.density(fx, fy)
    }
}

/// The thickness `name` of a single film, µm.
pub(super) fn thickness(node: &ParameterNode, name: &str) -> Result<f64, ParameterError> {
    let value = node.number(name);
    if value >= 0.0 && value.is_finite() {
        return Ok(value);
    }
    Err(ParameterError::new(name, format!("{value} um is not the thickness of a film")))
}
