//! Colour cases in JSON: spectra in, XYZ, Lab and RGB out.
//!
//! A request is one case or `{"illuminants": {…}, "cases": […]}`. Fields of a case:
//!
//! | field | meaning | default |
//! | --- | --- | --- |
//! | `id` | name in the answer and in errors | its number, from 1 |
//! | `wavelengths` | nm, in any order | required |
//! | `values` or `stokes` | a list, or four lists I, Q, U, V | one is required |
//! | `value_factor` | factor on the values (π: BRDF → radiance factor) | 1 |
//! | `interpolation` | `none`, `sprague`, `cubic`, `linear` | by the grid |
//! | `extrapolation` | `hold`, `zero` | `hold`; `zero` for emission |
//! | `illuminant` | name in `illuminants`, CIE name, K, `D(K)`, `custom`, null: emission | required |
//! | `custom_illuminant` | `wavelengths`, `values`, `interpolation`, `extrapolation` | linear, zero |
//! | `observer` | `CIE1931_2`, `CIE1964_10`, `CIE2015_2`, `CIE2015_10` | `CIE1931_2` |
//! | `method` | `sum_1nm`, `absolute_683`, `relative_Y1`, `astm_e308` | `sum_1nm`, `absolute_683` |
//! | `rgb_exposure` | factor on XYZ before the RGB matrix | 1 |
//! | `filters` | `linear_polariser`, `linear_retarder`, `circular_analyser`, or text | none |
//! | `rgb` (or `expected.rgb`) | list of objects with `space` and `adaptation`, or of such pairs | all spaces × none, Bradford, CAT02, CAT16 |
//!
//! The answer has `results`, one per case, and `warnings` of spectra that are probably not what was meant.
//! Other fields are notes and are ignored; a field that resembles one of these is an error.

mod error;
mod evaluate;
mod fields;
mod light;
mod request;
mod response;
mod warnings;

pub use error::CaseError;
pub use evaluate::evaluate;
pub use response::{CaseResult, ColourResponse, RgbResult};
pub use warnings::CaseWarning;
