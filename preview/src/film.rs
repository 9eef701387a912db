//! The rendered picture in spectra and XYZ.

use spectra::Xyz;

/// A rendered picture: XYZ of the four Stokes components per pixel, row by row from the top.
#[derive(Clone, Debug, PartialEq)]
pub struct RenderedFilm {
    /// Columns and rows.
    pub size: [usize; 2],
    /// XYZ of I, Q, U and V; Y = 1 is a white diffuser that faces a lamp of irradiance 1.
    pub pixels: Vec<[Xyz; 4]>,
    /// Radiance factors with [`Scene::spectra`](crate::Scene::spectra), else empty: per pixel the
    /// spectra of I, Q, U and V.
    pub spectra: Vec<f32>,
}
