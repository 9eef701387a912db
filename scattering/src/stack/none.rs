//! No films: a bare interface.

use super::Stack;
use crate::spec::{Class, Laws, Spec};

/// Name and constructor of the class.
pub const SPEC: Spec<Stack> = Spec {
    class: Class {
        name: "No_StackModel",
        parent: "StackModel",
        summary: "No films",
        equation: "no films",
        source: "born-1999",
        params: &[],
        laws: Laws::NONE,
    },
    build: |_| Ok(Box::default()),
};
