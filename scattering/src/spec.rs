//! Self-description of classes, and the typed values from which they are built.
//!
//! Every class (a BRDF model, a slope distribution, a film stack, …) is one `SPEC` in one file:
//! its name, its parameters with unit and default, its source and the function that builds it.
//! The manual, the JSON schema, the parameter tree of programs and the contract tests read
//! these lists and nothing else.

mod class;
mod member;
mod node;
pub(crate) mod range;

pub use class::{Class, Family, Laws, Parameter, ParameterKind, number_text};
pub use member::{Member, Spec, build, classes, specs};
pub use node::{ParameterError, ParameterNode, ParameterValue, SharedNotices};
