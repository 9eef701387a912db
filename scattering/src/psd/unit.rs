//! White spectrum.
//!
//! $$ \mathrm{PSD} = 1\ \mu\mathrm{m}^4 $$
//!
//! Has no finite roughness; a BRDF with it shows the optical factor of a roughness model alone.
//!
//! J. C. Stover, *Optical Scattering: Measurement and Analysis*, 3rd ed. (SPIE, 2012), chapter 4.

use crate::{
    psd::Psd,
    spec::{Class, Laws, Spec},
};

/// Name, parameters and constructor of a [`UnitPsd`].
pub const SPEC: Spec<dyn Psd> = Spec {
    class: Class {
        name: "Unit_PSD_Function",
        parent: "PSD_Function",
        summary: "Constant 1 um^4",
        equation: "PSD = 1",
        source: "stover-2012",
        params: &[],
        laws: Laws::NONE,
    },
    build: |_| Ok(Box::new(UnitPsd)),
};

/// The same density at every frequency.
#[derive(Clone, Debug)]
pub struct UnitPsd;

impl Psd for UnitPsd {
    fn density(&self, _: f64, _: f64) -> f64 {
        1.0
    }
}
