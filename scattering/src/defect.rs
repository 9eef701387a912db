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

/// Declares the defects: each entry has its documentation, which is its row in the manual, its
/// number in the list of `docs/models.md` (`-` for none) and its effect on a result.
macro_rules! defects {
    ($($(#[doc = $doc:literal])+ $name:ident = $number:literal, $effect:literal;)*) => {
        /// A defect of NIST's library that [`Mode::Compat`] reproduces; each is named in
        /// `docs/models.md`, and a sound run that meets one says so.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub enum Defect {
            $($(#[doc = $doc])+ $name,)*
        }

        impl Defect {
            /// All defects, in the order of the manual.
            pub const ALL: &'static [Self] = &[$(Self::$name),*];

            /// The number in the list of defects of `docs/models.md`, and the effect on a result.
            pub fn describe(self) -> (&'static str, &'static str) {
                match self {
                    $(Self::$name => ($number, $effect),)*
                }
            }

            /// Computation of NIST's library, as the manual states it.
            pub fn deviation(self) -> &'static str {
                match self {
                    $(Self::$name => concat!($($doc),+).trim_ascii(),)*
                }
            }
        }
    };
}

defects! {
    /// `Table_Angle_Distribution_Function` multiplies its angle by π/180 instead of dividing.
    TableAngleUnit = "B1", "Table_Angle_Distribution_Function reads its table at the wrong angle";
    /// `Diffuse_Subsurface` takes the growing evanescent wave under absorbing films.
    RecyclingBranch = "B3", "the recycled light under an absorbing film is too large";
    /// `Microroughness` type 1 takes the wrong branch beyond the critical angle.
    MicroroughnessBranch = "B4", "the circular elements beyond the critical angle have the wrong sign";
    /// Facets turn nothing where the local angle of incidence is exactly 0.
    FacetRetro = "B5", "the facet's basis is not turned at exact retro-reflection";
    /// Reynolds–McCormick phase functions use g² in place of g in their norm.
    ReynoldsNorm = "B6", "the Reynolds-McCormick phase function is not normalized";
    /// Rayleigh and Legendre phase functions lack 1/4π.
    PhaseNorm = "B6", "the phase function is 4 pi too large";
    /// Sphere phase functions use the vacuum wave number, or the medium's where vacuum's belongs.
    SpherePhaseMedium = "B6", "the scattering coefficient of the spheres is off by the square of the medium's index";
    /// The Rayleigh sphere's amplitudes lack −i, Rayleigh–Gans spheres have its opposite.
    RayleighPhase = "B6", "the phase of the sphere's amplitudes is wrong";
    /// The modified gamma distribution integrates to 2.
    GammaNorm = "B6", "the modified gamma distribution integrates to 2";
    /// The Zernike expansion computes λ² for λ³.
    ZernikePower = "B6", "the wavelength power 3 is computed as 2";
    /// The triangular pyramid's spectral density is 0 around the lines f_x = ±√3 f_y and, for small
    /// pyramids, nearly everywhere.
    PyramidLines = "B30", "the spectrum of triangular pyramids vanishes on lines and for small pyramids";
    /// The rectangular pyramid's spectral density takes the limit of the lines f_x l_x = ±f_y l_y
    /// wherever a product of its frequencies is small, for small pyramids nearly everywhere.
    PyramidLimits = "B30", "the spectrum of small rectangular pyramids is the limit of another direction";
    /// Kubelka–Munk overflows to NaN for opaque layers.
    KubelkaOverflow = "B7", "an opaque Kubelka-Munk layer gives nan";
    // Noted by the code that reads the text.
    /// An index is read up to where its text stops being a number, and loses its first dots.
    IndexText = "B8", "the text of an index is read as another index or file";
    /// Sums over `Diffuse_Subsurface` sources fail for absorbing substrates.
    SumAbsorbing = "B11", "a sum over an absorbing Diffuse_Subsurface source fails";
    /// A loss of 10⁻¹⁰ is added to the tangential index of light from the substrate side.
    TinyLoss = "B13", "a loss of 1e-10 is added to light from the substrate";
    /// Particle models nudge angles near the specular, retro and normal directions.
    Nudge = "B14", "angles near specular, retro and normal directions are moved by 2.5e-5 rad";
    /// Particles on a face lose digits of light that arrives through the substrate near the normal.
    HalfAngle = "B29", "light through the substrate near the normal is rounded to 1e-4";
    /// A graded film of one tabulated and one constant material is tabulated from λ = 0.
    GradedFilmGrid = "B17", "a graded film of a table and a constant is tabulated too coarsely";
    /// `Diffuse_Subsurface` recycles light by a 0.2° rectangle sum.
    RecyclingSum = "B18", "the recycled light is a sum over steps of 0.2 degrees";
    // Noted by the integrator.
    /// Cones and the hemisphere are polygons that leave out directions at the horizon.
    PolygonHorizon = "B19", "cones and the hemisphere are polygons that leave out directions";
    /// Axisymmetric particles with mmax < lmax pair harmonics wrongly, in another way (B28) where
    /// the light leaves into the substrate.
    AxisymmetricIndex = "B20", "harmonics above mmax are paired wrongly";
    /// Bodies of revolution on or in a substrate are refused with mmax = 1 ("Matrix has no inverse").
    SingleOrder = "-", "bodies of revolution on a face have no answer with mmax = 1";
    /// `CrossRCW` on oblique lattices takes another factorization for one of the two oblique
    /// components of the permittivity, so that results change when the lattice is turned.
    CrossedOblique = "B21", "an oblique crossed grating has a wrong off-diagonal permittivity";
    /// `CrossRCW` takes the inverse of the permittivity for the normal waves of homogeneous layers.
    CrossedHomogeneous = "B22", "waves in a homogeneous layer of a crossed grating have the inverse permittivity";
    /// `CrossRCW` mirrors line profiles.
    CrossedMirror = "B23", "an unsymmetric line profile of a crossed grating is mirrored";
    /// `Sinusoidal_Volume_Grating` sums the series of 1/ε over 20 powers of the contrast.
    VolumeSeries = "B24", "the series of the inverse permittivity of a volume grating ends too early";
    /// `RCW` at exactly normal incidence takes s along the lines, whatever the rotation.
    LineNormalBasis = "B25", "at exactly normal incidence polarization is that of the turned grating";
    /// Bodies of revolution in free space forget the azimuth of the incident light.
    IncidentAzimuth = "-", "a body of revolution that is turned sees its light from the wrong azimuth";
    /// The Gaussian phase function is normalized by a truncated series.
    GaussianPhaseSeries = "-", "the Gaussian phase function is normalized by a series for small widths";
    /// Slope distributions use constants of twelve digits.
    SlopeConstants = "-", "constants of slope distributions have twelve digits";
    /// Light along the normal has s = ŷ where bases are changed, whatever its azimuth.
    NormalBasis = "-", "the basis of light along the normal does not follow its azimuth";
    /// The vector interface mirrors the azimuth but not the sample, and is NaN at normal incidence.
    VectorAzimuth = "B9", "asked by vectors, a sample with a direction is seen in the wrong place";
    /// `Focussed_Beam` mirrors the azimuth of every ray.
    FocussedMirror = "-", "a converging beam sees the model mirrored in the plane of incidence";
    /// The cleanliness distribution uses constants of six digits.
    CleanlinessDigits = "-", "constants of the cleanliness distribution have six digits";
    /// Mie's recurrence starts too low for large spheres.
    MieStart = "-", "amplitudes of spheres much larger than the wavelength are off by 1e-5";
    /// The series of large spheres ends before it has converged.
    SeriesLength = "-", "the series of spheres much larger than the wavelength ends too early";
    /// The image of a particle in its substrate is integrated with too few nodes.
    ImageNodes = "-", "the image of the particle in its substrate is integrated with few nodes";
    /// A spectral density that is interpolated below zero counts as its absolute value.
    NegativeSpectrum = "-", "a spectral density below zero between its points counts as positive";
}

impl Defect {
    /// True if it changes results by more than 10⁻⁹ in more than single directions; sound runs do
    /// not mention others.
    pub fn is_noticeable(self) -> bool {
        !matches!(
            self,
            Self::FacetRetro
                | Self::HalfAngle
                | Self::LineNormalBasis
                | Self::NormalBasis
                | Self::TinyLoss
                | Self::SlopeConstants
        )
    }
}

impl fmt::Display for Defect {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (number, effect) = self.describe();
        write!(f, "{number}: {effect}")
    }
}
