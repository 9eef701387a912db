//! Requests: what the command line, HTTP and JSON ask for, as typed values with one grammar each.
//!
//! Every value has `FromStr` for texts and serde for JSON. A text that is not a value is an
//! [`InvalidText`]; [`read`] adds the key and makes it a [`RequestError`]. Serialization is
//! canonical: values that are equal have equal JSON, whatever their texts were (`0`, `0.0` and
//! `-0`), so a digest of it identifies a request.
//!
//! | value | text | JSON |
//! | --- | --- | --- |
//! | [`Nodes`] | `0:2:90`, `0,10,30`, or both mixed | a list, a number or the text |
//! | [`Wavelengths`] | the same, nm | the same |
//! | [`IncidentLight`] | `1,0,0,0` | a list or the text |
//! | [`GridPatch`] | `point`, `cell`, `ring`, `circle:2` | the text |
//! | [`PatchRow`] | `45 60 0 circle 2` | an object |
//! | [`PatchList`] | rows, one per line | a list of rows or the text |
//! | [`ColourQuery`] | names of illuminant, observer, … | an object |
//! | [`TableQuery`] | the keys of a URL | an object |

mod colours;
mod error;
mod evaluation;
mod grid;
mod incident;
mod material;
mod nodes;
mod parameters;
mod patch;
mod slips;
mod table;

pub use colours::ColourQuery;
pub use error::{InvalidText, RequestError, read};
pub use evaluation::{EvaluationRequest, GeometryAngles};
pub use grid::{GridPatch, GridRequest};
pub use incident::IncidentLight;
pub use material::{Material, MaterialDescription, ProgramDescription};
pub use nodes::{Nodes, Wavelengths};
pub use patch::{Patch, PatchList, PatchRow};
pub use slips::{invisible_warning, wavelength_warning};
pub use table::{TableDirections, TableQuery, TableRequest};
