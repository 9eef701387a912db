//! Crossed grating by rigorous coupled waves, every order a cone of light.
//!
//! $$ \mathbf F = \sum_{ij} \frac{\mathbf R_{ij}}{\pi\alpha^2\cos\theta_s} $$
//!
//! over the orders (i, j), |i| ≤ `order1` and |j| ≤ `order2`, within α (`alpha`) of the direction
//! of scattering. The medium above is vacuum. A grating that does not vary along one of its axes
//! needs no harmonics there, and gets none. NIST's library has three defects of its own in crossed
//! gratings: [`Defect::CrossedOblique`], [`Defect::CrossedHomogeneous`], [`Defect::CrossedMirror`].
//!
//! L. Li, J. Opt. Soc. Am. A 14, 2758 (1997).

use std::f64::consts::TAU;

use num_complex::Complex64;

use super::{
    convergence::{ConvergenceCheck, other_order},
    orders::{OrderConeModel, bounded, half_angle, media, order},
};
use crate::{
    Brdf, Defect,
    cross_grating::{
        self, CrossGrating, CrossPattern, CrossProfile, CrossSlice, HarmonicTruncation, ObliqueRule,
    },
    models::{COMMON, CommonParameters},
    rcw::PeriodicStructure,
    spec::{Class, Laws, Parameter, ParameterError, ParameterNode, Spec},
};

const OWN: &[Parameter] = &[
    Parameter::number("alpha", 0.01, "rad", "Half angle of the cone of every order"),
    Parameter::integer("order1", 10, "Highest harmonic along axis 1"),
    Parameter::integer("order2", 10, "Highest harmonic along axis 2"),
    Parameter::member("grating", &cross_grating::FAMILY, "OneD_CrossGrating", "The grating"),
];

/// Name, parameters and constructor of the model.
pub const SPEC: Spec<dyn Brdf> = Spec {
    class: Class {
        name: "CrossRCW_BRDF_Model",
        parent: "BRDF_Model",
        summary: "Crossed grating by coupled waves, orders given a finite cone",
        equation: "F = sum_ij R_ij/(pi alpha^2 cos(theta_s)) within alpha of order (i,j)",
        source: "li-1997 moharam-1995",
        params: &[COMMON, OWN],
        laws: Laws { realizable: true, ..Laws::NONE },
    },
    build: |node| {
        let common = CommonParameters::read(node)?;
        let (order1, order2) = (order(node, "order1")?, order(node, "order2")?);
        let profile = profile(node, &common)?;
        let structure = structure(node, &profile, &common, HarmonicTruncation { order1, order2 })?;
        let check = ConvergenceCheck::new(node, || {
            let others =
                HarmonicTruncation { order1: other_order(order1), order2: other_order(order2) };
            self::structure(node, &profile, &common, others).ok()
        });
        Ok(Box::new(OrderConeModel::new(common, structure, check, half_angle(node)?)))
    },
};

fn profile(
    node: &ParameterNode,
    common: &CommonParameters,
) -> Result<CrossProfile, ParameterError> {
    let grating = node.member::<dyn CrossGrating>("grating")?;
    let profile = grating.at(common.lambda).map_err(|error| error.inside("grating"))?;
    media(common, profile.above, profile.below)?;
    Ok(profile)
}

fn structure(
    node: &ParameterNode,
    profile: &CrossProfile,
    common: &CommonParameters,
    wanted: HarmonicTruncation,
) -> Result<PeriodicStructure, ParameterError> {
    let kept = needed(profile, wanted);
    let size = |order: usize| order.checked_mul(2).and_then(|n| n.checked_add(1));
    bounded("order1", size(kept.order1))?;
    bounded(
        "order2",
        size(kept.order1).zip(size(kept.order2)).and_then(|(a, b)| a.checked_mul(b)),
    )?;
    let (k0, lattice) = (TAU / common.lambda, profile.lattice);
    let slices = profile.slices.iter().filter(|slice| slice.thickness > 0.0);
    let harmonics = kept.harmonics();
    let is_mirrored = profile.slices.iter().any(|slice| slice.pattern.is_unsymmetric_line())
        && node.reproduces(Defect::CrossedMirror);
    let rule = if lattice.zeta != 0.0 && node.reproduces(Defect::CrossedOblique) {
        ObliqueRule::Library
    } else {
        ObliqueRule::Invariant
    };
    let layer = |slice: &CrossSlice| {
        let mirrored = is_mirrored
            .then(|| CrossSlice { pattern: slice.pattern.with_mirrored_lines(), ..slice.clone() });
        let slice = mirrored.as_ref().unwrap_or(slice);
        let layer = slice.operators(kept, (lattice.zeta, rule), k0 * slice.thickness);
        let has_inverse_waves = !slice.is_gap
            && layer.is_homogeneous()
            && layer.epsilon.zz_inverse[(0, 0)] != Complex64::ONE
            && node.reproduces(Defect::CrossedHomogeneous);
        if has_inverse_waves { layer.with_inverse_waves() } else { layer }
    };
    Ok(PeriodicStructure {
        layers: slices.map(layer).collect(),
        incident: 1.0,
        behind: profile.below,
        zeroth: harmonics.len() / 2,
        harmonics: harmonics.iter().map(|&(i, j)| lattice.harmonic(i, j, common.lambda)).collect(),
    })
}

/// No harmonics along an axis on which nothing depends.
fn needed(profile: &CrossProfile, wanted: HarmonicTruncation) -> HarmonicTruncation {
    let patterns = || profile.slices.iter().map(|slice| &slice.pattern);
    let varies_1 = patterns().any(|p| !matches!(p, CrossPattern::Along2(_)));
    let varies_2 = patterns().any(|p| !matches!(p, CrossPattern::Along1(_)));
    HarmonicTruncation {
        order1: if varies_1 { wanted.order1 } else { 0 },
        order2: if varies_2 { wanted.order2 } else { 0 },
    }
}
