//! The defects of NIST's library, and whether they are reproduced.

use std::fmt;

/// Mode in which a model is built: with sound physics, or as NIST's library computes it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Mode {
    /// Sound physics.
    #[default]
    Sound,
    /// NIST's numbers, defects included.
    Compat,
}

/// A defect of NIST's library that [`Mode::Compat`] reproduces; each is named in
/// `docs/models.md`, and a sound run that meets one says so.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Defect {
    /// `Table_Angle_Distribution_Function` multiplies its angle by π/180 instead of dividing.
    TableAngleUnit,
    /// `Diffuse_Subsurface` takes the growing evanescent wave under absorbing films.
    RecyclingBranch,
    /// `Microroughness` type 1 takes the wrong branch beyond the critical angle.
    MicroroughnessBranch,
    /// Facets turn nothing where the local angle of incidence is exactly 0.
    FacetRetro,
    /// Reynolds–McCormick phase functions use g² in place of g in their norm.
    ReynoldsNorm,
    /// Rayleigh and Legendre phase functions lack 1/4π.
    PhaseNorm,
    /// Sphere phase functions use the vacuum wave number, or the medium's where vacuum's belongs.
    SpherePhaseMedium,
    /// The Rayleigh sphere's amplitudes lack −i, Rayleigh–Gans spheres have its opposite.
    RayleighPhase,
    /// The modified gamma distribution integrates to 2.
    GammaNorm,
    /// The Zernike expansion computes λ² for λ³.
    ZernikePower,
    /// The triangular pyramid's spectral density is 0 around the lines f_x = ±√3 f_y and, for small
    /// pyramids, nearly everywhere.
    PyramidLines,
    /// Kubelka–Munk overflows to NaN for opaque layers.
    KubelkaOverflow,
    /// An index is read up to where its text stops being a number, and loses its first dots.
    ///
    /// Noted by the code that reads the text.
    IndexText,
    /// Sums over `Diffuse_Subsurface` sources fail for absorbing substrates.
    SumAbsorbing,
    /// A loss of 10⁻¹⁰ is added to the tangential index of light from the substrate side.
    TinyLoss,
    /// Particle models nudge angles near the specular, retro and normal directions.
    Nudge,
    /// A graded film of one tabulated and one constant material is tabulated from λ = 0.
    GradedFilmGrid,
    /// `Diffuse_Subsurface` recycles light by a 0.2° rectangle sum.
    RecyclingSum,
    /// Cones and the hemisphere are polygons that leave out directions at the horizon.
    ///
    /// Noted by the integrator.
    PolygonHorizon,
    /// Axisymmetric particles with mmax < lmax pair harmonics wrongly.
    AxisymmetricIndex,
    /// Bodies of revolution in free space forget the azimuth of the incident light.
    IncidentAzimuth,
    /// The Gaussian phase function is normalized by a truncated series.
    GaussianPhaseSeries,
    /// Slope distributions use constants of twelve digits.
    SlopeConstants,
    /// Light along the normal has s = ŷ where bases are changed, whatever its azimuth.
    NormalBasis,
    /// The vector interface mirrors the azimuth but not the sample, and is NaN at normal incidence.
    VectorAzimuth,
    /// `Focussed_Beam` mirrors the azimuth of every ray.
    FocussedMirror,
    /// The cleanliness distribution uses constants of six digits.
    CleanlinessDigits,
    /// Mie's recurrence starts too low for large spheres.
    MieStart,
    /// The series of large spheres ends before it has converged.
    SeriesLength,
    /// The image of a particle in its substrate is integrated with too few nodes.
    ImageNodes,
    /// A spectral density that is interpolated below zero counts as its absolute value.
    NegativeSpectrum,
}

impl Defect {
    /// The number in the list of defects of `docs/models.md`, and what it does to a result.
    pub fn describe(self) -> (&'static str, &'static str) {
        match self {
            Self::TableAngleUnit => {
                ("B1", "Table_Angle_Distribution_Function reads its table at the wrong angle")
            }
            Self::RecyclingBranch => {
                ("B3", "the recycled light under an absorbing film is too large")
            }
            Self::MicroroughnessBranch => {
                ("B4", "the circular elements beyond the critical angle have the wrong sign")
            }
            Self::FacetRetro => ("B5", "the facet's basis is not turned at exact retro-reflection"),
            Self::ReynoldsNorm => ("B6", "the Reynolds-McCormick phase function is not normalized"),
            Self::PhaseNorm => ("B6", "the phase function is 4 pi too large"),
            Self::SpherePhaseMedium => (
                "B6",
                "the scattering coefficient of the spheres is off by the square of the medium's index",
            ),
            Self::RayleighPhase => ("B6", "the phase of the sphere's amplitudes is wrong"),
            Self::GammaNorm => ("B6", "the modified gamma distribution integrates to 2"),
            Self::ZernikePower => ("B6", "the wavelength power 3 is computed as 2"),
            Self::PyramidLines => (
                "B30",
                "the spectrum of triangular pyramids vanishes on lines and for small pyramids",
            ),
            Self::KubelkaOverflow => ("B7", "an opaque Kubelka-Munk layer gives nan"),
            Self::IndexText => ("B8", "the text of an index is read as another index or file"),
            Self::SumAbsorbing => {
                ("B11", "a sum over an absorbing Diffuse_Subsurface source fails")
            }
            Self::TinyLoss => ("B13", "a loss of 1e-10 is added to light from the substrate"),
            Self::Nudge => {
                ("B14", "angles near specular, retro and normal directions are moved by 2.5e-5 rad")
            }
            Self::GradedFilmGrid => {
                ("B17", "a graded film of a table and a constant is tabulated too coarsely")
            }
            Self::RecyclingSum => ("B18", "the recycled light is a sum over steps of 0.2 degrees"),
            Self::PolygonHorizon => {
                ("B19", "cones and the hemisphere are polygons that leave out directions")
            }
            Self::AxisymmetricIndex => ("B20", "harmonics above mmax are paired wrongly"),
            Self::IncidentAzimuth => {
                ("-", "a body of revolution that is turned sees its light from the wrong azimuth")
            }
            Self::GaussianPhaseSeries => {
                ("-", "the Gaussian phase function is normalized by a series for small widths")
            }
            Self::NormalBasis => {
                ("-", "the basis of light along the normal does not follow its azimuth")
            }
            Self::VectorAzimuth => {
                ("B9", "asked by vectors, a sample with a direction is seen in the wrong place")
            }
            Self::FocussedMirror => {
                ("-", "a converging beam sees the model mirrored in the plane of incidence")
            }
            Self::SlopeConstants => ("-", "constants of slope distributions have twelve digits"),
            Self::CleanlinessDigits => {
                ("-", "constants of the cleanliness distribution have six digits")
            }
            Self::MieStart => {
                ("-", "amplitudes of spheres much larger than the wavelength are off by 1e-5")
            }
            Self::SeriesLength => {
                ("-", "the series of spheres much larger than the wavelength ends too early")
            }
            Self::ImageNodes => {
                ("-", "the image of the particle in its substrate is integrated with few nodes")
            }
            Self::NegativeSpectrum => {
                ("-", "a spectral density below zero between its points counts as positive")
            }
        }
    }
}

impl Defect {
    /// True if it changes results by more than 10⁻⁹ in more than single directions; sound runs do
    /// not mention others.
    pub fn is_noticeable(self) -> bool {
        !matches!(
            self,
            Self::FacetRetro | Self::NormalBasis | Self::TinyLoss | Self::SlopeConstants
        )
    }
}

impl fmt::Display for Defect {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (number, effect) = self.describe();
        write!(f, "{number}: {effect}")
    }
}
