//! Weighted sum of three models.
//!
//! $$ \mathbf F = \sum_j factor_j\,\mathbf F_{source\,j} $$
//!
//! T. A. Germer and E. Marx, Appl. Opt. 43, 1266 (2004), for sums of sources.

use super::weighted::{WeightedSum, source};
use crate::{
    models::{Brdf, COMMON},
    spec::{Class, Laws, Spec},
};

/// Name, parameters and constructor of the class.
pub const SPEC: Spec<dyn Brdf> = Spec {
    class: Class {
        name: "Three_Source_BRDF_Model",
        parent: "BRDF_Model",
        summary: "Weighted sum of three models",
        equation: "F = sum_j factor_j F_j",
        source: "germer-2004",
        params: &[
            COMMON,
            &source("factor1", "source1", "Weight of the first source", "First source"),
            &source("factor2", "source2", "Weight of the second source", "Second source"),
            &source("factor3", "source3", "Weight of the third source", "Third source"),
        ],
        laws: Laws::NOT_PASSIVE,
    },
    build: |node| Ok(Box::new(WeightedSum::read(node, 3)?)),
};
