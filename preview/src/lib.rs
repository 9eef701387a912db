//! A small exact renderer: one material on one body, lamps, a camera with a filter before it.
//!
//! The camera looks along −z from far away; x is to the right and y up, and Stokes vectors arrive
//! with s along x: Q > 0 is horizontal light. A pixel is the radiance factor
//!
//! $$ S = \pi \sum_\text{lamps} E\, R_c\, f(\omega_o, \omega_i)\, R_l\, \Phi \cos\theta_i
//!      + \pi \int f\, L\, \cos\theta_i \, d\omega_i $$
//!
//! so a white diffuser that faces a lamp of E = 1 has the value 1. f is the Mueller BRDF of the
//! model at every wavelength and azimuth; R rotation Stokes vectors between the bases of the surface
//! point, of the lamp and of the camera. The second term holds the sky, which is unpolarized, and
//! one bounce between points of the body, with its Stokes vector: both are sampled
//! with a density proportional to cos θ_i. Random numbers are a function of pixel, sample and
//! dimension, so the picture has the same bits on any number of threads.
//!
//! For lamps in one direction the first term is a function of the normal alone; it is interpolated
//! between normals within 1 ‰ (`response.rs`) unless [`Scene::exact`] or spectra are asked
//! for; both evaluate the model for every sample.
//!
//! Limits: no light passes through the body (models of `type` 0 only), lamps are far away, and a
//! sky seen in a narrow highlight is noisy.

mod evaluate;
mod film;
mod frame;
pub mod mesh;
mod path;
mod picture;
mod random;
mod ray;
mod render;
mod response;
mod rotation;
mod scene;
mod shade;
mod shape;
mod sky;
mod spectral;
mod surface_point;

pub use film::RenderedFilm;
pub use picture::{Polarization, brightest, picture, side_by_side};
pub use render::render;
pub use scene::{Lamp, LampBasis, Scene};
pub use shade::shade;
pub use shape::BodyShape;
pub use sky::{Environment, Sky};
pub use spectral::spectral_exr;
pub use surface_point::{DistantLamps, SurfacePoint};
