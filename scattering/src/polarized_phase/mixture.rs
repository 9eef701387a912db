//! Up to four kinds of particles together: coefficients add, P is the mean by scattering.
//!
//! $$ \kappa = \sum_j \kappa_j \qquad (1) $$
//!
//! $$ P = \sum_j \kappa_{s,j}P_j \Big/ \sum_j \kappa_{s,j} \qquad (2) $$

use super::{FAMILY, PolarizedPhase};
use crate::{
    Mueller,
    spec::{Class, Laws, Parameter, Spec},
};

/// Name, parameters and constructor of the class.
pub const SPEC: Spec<dyn PolarizedPhase> = Spec {
    class: Class {
        name: "Mixture_Phase_Function",
        parent: "Polarized_Phase_Function",
        summary: "Up to four kinds of particles together",
        equation: "kappa = sum kappa_j, P = sum kappa_sj P_j/sum kappa_sj",
        source: "hovenier-2004",
        params: &[&[
            kind("phase1", "SphericalScatterer_Phase_Function", "The first kind"),
            kind("phase2", "No_Polarized_Phase_Function", "The second kind"),
            kind("phase3", "No_Polarized_Phase_Function", "The third kind"),
            kind("phase4", "No_Polarized_Phase_Function", "The fourth kind"),
        ]],
        laws: Laws::NONE,
    },
    build: |node| {
        let names = ["phase1", "phase2", "phase3", "phase4"];
        let kinds = names.map(|name| node.member::<dyn PolarizedPhase>(name));
        Ok(Box::new(ParticleMixture(kinds.into_iter().collect::<Result<_, _>>()?)))
    },
};

const fn kind(name: &'static str, default: &'static str, doc: &'static str) -> Parameter {
    Parameter::member(name, &FAMILY, default, doc)
}

/// Several kinds of particles.
struct ParticleMixture(Vec<Box<dyn PolarizedPhase>>);

impl PolarizedPhase for ParticleMixture {
    fn at_cosine(&self, cos: f64) -> Mueller {
        let kappa_s = self.scattering();
        if kappa_s == 0.0 {
            return self.0[0].at_cosine(cos);
        }
        let mut sum = Mueller::ZERO;
        for kind in self.0.iter().filter(|kind| kind.scattering() > 0.0) {
            // A term of (2).
            sum += kind.at_cosine(cos) * (kind.scattering() / kappa_s);
        }
        sum
    }

    // (1) for κ_a and κ_s.
    fn absorption(&self) -> f64 {
        self.0.iter().map(|kind| kind.absorption()).sum()
    }

    fn scattering(&self) -> f64 {
        self.0.iter().map(|kind| kind.scattering()).sum()
    }
}
