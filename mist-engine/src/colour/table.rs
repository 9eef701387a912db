//! A colour table: per direction the linear RGB and the intensity of each Stokes component,
//! with everything that is needed to read it rightly.

use crate::Warning;

/// A table of colours over directions, ready to be written in any format.
///
/// Angles are degrees, solid angles sr, wavelengths nm. Values are 1/sr for the quantity
/// `brdf`, and patch means: flux in the patch over incident flux and projected solid angle.
#[derive(Clone, Debug, PartialEq)]
pub struct ColourTable {
    /// Name of the material.
    pub material: String,
    /// Quantity of the values with its unit: `brdf 1/sr`, `factor 1`, `reflectance 1`, `radiance`.
    pub quantity: String,
    /// Incident Stokes vector.
    pub incident: [f64; 4],
    /// Polarization basis of the exit light: `psps`, `xyxy` or `plane`.
    pub frame: String,
    /// Wavelengths of the spectra, nm, ascending.
    pub wavelengths: Vec<f64>,
    /// Interpolation of spectra to 1 nm and their extrapolation: `sprague hold`.
    pub interpolation: String,
    /// Name of the illuminant.
    pub illuminant: String,
    /// Name of the observer.
    pub observer: String,
    /// Name of the RGB space; values are linear in it.
    pub space: String,
    /// Name of the chromatic adaptation.
    pub adaptation: String,
    /// XYZ of the perfect diffuser, Y = 1.
    pub white: [f64; 3],
    /// Order of the rows.
    pub layout: RowOrder,
    /// Solid angle of a row.
    pub patch: RowPatch,
    /// Names of columns before the angles: loops that are neither angles nor folded.
    pub leading: Vec<String>,
    /// Number of Stokes components given per row: 1, 3 (I, Q, U) or 4.
    pub stokes: usize,
    /// The rows, in the order of `layout`.
    pub rows: Vec<ColourRow>,
    /// Hemispherical reflectance per incidence node; may be empty.
    pub albedo: Vec<Albedo>,
    /// Warnings of the computation; only the JSON form has them.
    pub warnings: Vec<Warning>,
}

/// The order of the rows.
#[derive(Clone, Debug, PartialEq)]
pub enum RowOrder {
    /// As they were asked for.
    List,
    /// Every node of a grid, the first axis slowest.
    Grid {
        /// The axes, slowest first.
        axes: Vec<TableAxis>,
        /// Which half of the azimuths is given.
        symmetry: Symmetry,
    },
}

/// One axis of a grid.
#[derive(Clone, Debug, PartialEq)]
pub struct TableAxis {
    /// `thetai`, `thetas` or `phis`.
    pub name: String,
    /// Its nodes, degrees, ascending.
    pub nodes: Vec<f64>,
}

/// Which azimuths a grid gives.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Symmetry {
    /// 0…180: the other half is its mirror image.
    Mirror,
    /// −180…180.
    None,
}

/// The solid angle of a row.
#[derive(Clone, Debug, PartialEq)]
pub enum RowPatch {
    /// One direction.
    Point,
    /// A cone with this half-angle in degrees.
    Circle(f64),
    /// The grid's Voronoi cell.
    Cell,
    /// The average over the azimuth.
    Ring,
    /// Whatever the program says.
    Other(String),
}

/// One row.
#[derive(Clone, Debug, PartialEq)]
pub struct ColourRow {
    /// Values of the leading columns.
    pub leading: Vec<f64>,
    /// Polar angle of incidence, degrees.
    pub thetai: f64,
    /// Polar angle of scattering, degrees.
    pub thetas: f64,
    /// Azimuth of scattering, degrees; 0 is the specular side.
    pub phis: f64,
    /// Projected solid angle of the patch, sr; 0 for a point.
    pub omega: f64,
    /// Linear RGB of I, Q, U, V.
    pub rgb: [[f64; 3]; 4],
    /// XYZ of I, Q, U, V, white = 1; Y is the intensity.
    pub xyz: [[f64; 3]; 4],
    /// Spectra of I, Q, U, V on the table's wavelengths; components that were not given are empty.
    pub spectra: [Vec<f64>; 4],
    /// Bits of [`ColourRow::OUT_OF_GAMUT`] and its kin.
    pub flags: u8,
}

impl ColourRow {
    /// A channel of the unfiltered colour lies below −10⁻⁹.
    pub const OUT_OF_GAMUT: u8 = 1;
    /// The node lies at or below the horizon and was filled from 89.9°.
    pub const FILLED: u8 = 2;
    /// The integral did not reach its tolerance.
    pub const NOT_REACHED: u8 = 4;
}

/// Hemispherical reflectance for one angle of incidence.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Albedo {
    /// Polar angle of incidence, degrees.
    pub thetai: f64,
    /// Linear RGB.
    pub rgb: [f64; 3],
    /// Luminous reflectance.
    pub intensity: f64,
}
