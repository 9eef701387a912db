//! Polarized scattering models: from the parameters of a material to Mueller matrices.
//!
//! A model is chosen by name from [`models`], built from a [`ParameterNode`] of typed parameter values,
//! and gives the 4×4 Mueller BRDF (1/sr) of one incident beam and many directions:
//!
//! ```
//! use scattering::{Basis, Geometry, Mode, ParameterNode, models};
//!
//! let class = &models::find("Lambertian_BRDF_Model").unwrap().class;
//! let model = models::build(&ParameterNode::with_defaults(class, Mode::Sound)).unwrap();
//! let at = Geometry { theta_i: 0.7, theta_s: 0.2, phi_s: 1.0, rotation: 0.0 };
//! let f = model.mueller(&at, Basis::Psps);
//! assert!((f[(0, 0)] * std::f64::consts::PI - 1.0).abs() < 1e-15);
//! ```
//!
//! Angles are radians, lengths µm, time dependence exp(−iωt), indices n + ik with k ≥ 0
//! absorbing, Stokes vectors (I, Q, U, V) with Q = I_s − I_p. The crate knows no text formats,
//! no files and no spectra.

pub mod cross_grating;
pub mod defect;
pub mod distribution;
pub mod doubling;
pub mod geometry;
pub mod grating;
pub mod interrupt;
pub mod lanes;
pub mod models;
pub mod notice;
pub mod optics;
pub mod phase;
pub mod polarization;
pub mod polarized_phase;
pub mod psd;
pub mod rcw;
pub mod reflectance;
pub mod registry;
pub mod scatterer;
pub mod shadow;
pub mod shape;
pub mod size;
pub mod slope;
pub mod spec;
pub mod special;
pub mod stack;
pub mod tmatrix;
pub mod vectors;

pub use defect::{Defect, Mode};
pub use geometry::{Direction, Geometry, Incidence, Side};
pub use models::{Brdf, Model};
pub use notice::{ModelLimit, Notice};
pub use polarization::{Basis, Jones, Mueller, Stokes};
pub use spec::{
    Class, Family, Parameter, ParameterError, ParameterKind, ParameterNode, ParameterValue, Spec,
};
pub use vectors::{DirectionPairs, Surface, SurfaceError};
