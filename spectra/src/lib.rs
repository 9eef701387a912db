#![doc = include_str!("../README.md")]

pub mod accuracy;
pub mod adaptation;
pub mod astm;
pub mod case;
pub mod compare;
mod data;
pub mod difference;
pub mod filter;
pub mod illuminant;
pub mod interpolate;
pub mod lab;
pub mod luv;
mod matrix;
pub mod name;
pub mod observer;
pub mod plan;
pub mod rgb;
pub mod spectrum;
pub mod wavelength;
pub mod weights;
pub mod xyz;

pub use adaptation::{Adaptation, AdaptationError};
pub use filter::{Filter, FilterError};
pub use illuminant::{Illuminant, IlluminantError};
pub use interpolate::{Extrapolation, Interpolation};
pub use lab::Lab;
pub use luv::Luv;
pub use matrix::Matrix3;
pub use name::UnknownName;
pub use observer::Observer;
pub use plan::{ColourPlan, ColourSettings, PlanError, Quantity};
pub use rgb::{RgbSpace, SpaceError};
pub use spectrum::{Spectrum, SpectrumError};
pub use wavelength::{Grid, GridError};
pub use weights::XyzWeights;
pub use xyz::Xyz;
