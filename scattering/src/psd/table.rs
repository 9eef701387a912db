//! Tabulated isotropic spectrum.
//!
//! $$ \mathrm{PSD} = T(f), \quad f = \sqrt{f_x^2 + f_y^2} $$
//!
//! The table holds its end values outside its range. Interpolated values below zero count as 0, in
//! NIST's library as their absolute value ([`Defect::NegativeSpectrum`]).
//!
//! J. C. Stover, *Optical Scattering: Measurement and Analysis*, 3rd ed. (SPIE, 2012), chapter 4.

use crate::{
    Defect, ParameterError,
    optics::RealFunction,
    psd::Psd,
    spec::{Class, Laws, Parameter, Spec},
};

/// Name, parameters and constructor of a [`Tabulated`].
pub const SPEC: Spec<dyn Psd> = Spec {
    class: Class {
        name: "Table_PSD_Function",
        parent: "PSD_Function",
        summary: "Tabulated against frequency",
        equation: "PSD = T(f)",
        source: "stover-2012",
        params: &[&[Parameter::table(
            "T",
            1.0,
            "um^4",
            "Spectral density as a function of spatial frequency (1/um)",
        )]],
        laws: Laws::NONE,
    },
    build: |node| {
        let table = node.table("T").clone();
        let mut counts_absolute = false;
        if table.dips_below_zero() {
            counts_absolute = node.reproduces(Defect::NegativeSpectrum);
            if let Some(value) = table.ordinates().find(|&value| value < 0.0 && !counts_absolute) {
                return Err(ParameterError::new(
                    "T",
                    format!("the spectral density {value} is negative"),
                ));
            }
        }
        Ok(Box::new(Tabulated { table, counts_absolute }))
    },
};

/// A tabulated spectrum.
#[derive(Clone, Debug)]
pub struct Tabulated {
    table: RealFunction,
    counts_absolute: bool,
}

impl Psd for Tabulated {
    fn density(&self, fx: f64, fy: f64) -> f64 {
        let density = self.table.at(fx.hypot(fy));
        if self.counts_absolute { density.abs() } else { density.max(0.0) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        Mode, ParameterNode, ParameterValue,
        optics::{AbscissaScale, TableInterpolation},
        spec,
    };

    fn build(mode: Mode, rows: &[(f64, f64)]) -> Result<Box<dyn Psd>, ParameterError> {
        let table = ParameterValue::Table(RealFunction::points(
            rows,
            AbscissaScale::Linear,
            TableInterpolation::Spline,
        ));
        spec::build::<dyn Psd>(&ParameterNode::with_defaults(&SPEC.class, mode).with("T", table)?)
    }

    #[test]
    fn a_spline_below_zero_is_nothing_in_sound_and_its_size_in_compat() {
        let rows = [(0.1, 1.0), (0.5, 0.01), (1.0, 0.01), (1.5, 0.8), (3.0, 0.001)];
        let (sound, compat) = (build(Mode::Sound, &rows), build(Mode::Compat, &rows));
        let (sound, compat) = (sound.unwrap(), compat.unwrap());
        let table = RealFunction::points(&rows, AbscissaScale::Linear, TableInterpolation::Spline);
        let dip = (0..3000).map(|i| f64::from(i) * 1e-3).find(|&f| table.at(f) < 0.0).unwrap();
        assert_eq!(sound.density(dip, 0.0), 0.0);
        assert_eq!(compat.density(0.0, dip), -table.at(dip));
        assert_eq!(sound.density(0.1, 0.0), 1.0);
    }

    #[test]
    fn tabulated_negative_densities_are_refused() {
        let rows = [(0.1, 1.0), (0.5, -0.01), (1.0, 0.01)];
        assert_eq!(build(Mode::Sound, &rows).err().unwrap().parameter, "T");
        assert_eq!(build(Mode::Compat, &rows).unwrap().density(0.5, 0.0), 0.01);
    }
}
