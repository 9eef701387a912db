//! First-order scattering by rough interfaces.
//!
//! All models share the spatial frequency that a pair of directions selects. With the index
//! m_i = n of the substrate for types 2 and 3, else 1, and m_s = n for types 1 and 2, else 1,
//!
//! $$ f_x = \frac{m_s \sin\theta_s \cos\varphi_s - m_i \sin\theta_i}{\lambda}, \quad
//!    f_y = \frac{m_s \sin\theta_s \sin\varphi_s}{\lambda} $$
//!
//! turned into the frame of the sample. The amplitudes of the models are per √PSD, so that the
//! Mueller matrix is PSD times that of the amplitude. First order means heights well below the
//! wavelength; neither the specular beam nor multiple scattering is included.

use super::{Brdf, CommonParameters};
use crate::{
    Direction, Incidence, ParameterError, ParameterNode,
    psd::Psd,
    spec::{Family, Parameter, Spec},
};

mod coherent;
pub mod correlated_film;
pub mod correlated_stack;
pub mod growth_stack;
mod interfaces;
pub mod microroughness;
pub mod one_interface;
pub mod two_face;
pub mod uncorrelated_stack;

/// The models of this group, in the order they are listed to users.
pub const ALL: &[&Spec<dyn Brdf>] = &[
    &microroughness::SPEC,
    &one_interface::SPEC,
    &correlated_stack::SPEC,
    &uncorrelated_stack::SPEC,
    &growth_stack::SPEC,
    &correlated_film::SPEC,
    &two_face::SPEC,
];

/// The parameter of every roughness model.
pub const ROUGHNESS: &[Parameter] = &[Parameter::member(
    "psd",
    Family::Psd,
    "PSD_Function",
    "ABC_PSD_Function",
    "Power spectral density of surface height",
)];

/// The films of a stack model.
const STACK: &[Parameter] =
    &[Parameter::member("stack", Family::Stack, "StackModel", "No_StackModel", "Films")];

/// Data of every roughness model: the common part, the spectrum, the frequencies.
struct RoughSurface {
    common: CommonParameters,
    psd: Box<dyn Psd>,
    /// m_i/λ and m_s/λ, 1/µm.
    per_sine: (f64, f64),
}

impl RoughSurface {
    fn read(node: &ParameterNode) -> Result<Self, ParameterError> {
        let common = CommonParameters::read(node)?;
        let index = |inside: bool| if inside { common.substrate.re } else { 1.0 };
        let per_sine = (
            index(common.side.from_below()) / common.lambda,
            index(common.side.to_below()) / common.lambda,
        );
        Ok(Self { common, psd: node.member::<dyn Psd>("psd")?, per_sine })
    }

    /// (f_x, f_y) in the frame of the sample, 1/µm.
    fn frequency(&self, incidence: &Incidence, direction: &Direction) -> (f64, f64) {
        let (incident, scattered) = self.per_sine;
        let out = scattered * direction.sin;
        incidence
            .to_sample(out * direction.cos_phi - incident * incidence.sin, out * direction.sin_phi)
    }

    /// PSD at that frequency, µm⁴.
    fn density(&self, incidence: &Incidence, direction: &Direction) -> f64 {
        let (fx, fy) = self.frequency(incidence, direction);
        self.psd.density(fx, fy)
    }
}

/// The thickness `name` of a single film, µm.
fn thickness(node: &ParameterNode, name: &str) -> Result<f64, ParameterError> {
    let value = node.number(name);
    if value >= 0.0 && value.is_finite() {
        return Ok(value);
    }
    Err(ParameterError::new(name, format!("{value} um is not the thickness of a film")))
}
