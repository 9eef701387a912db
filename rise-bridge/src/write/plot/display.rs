//! Screen colours of the values of a table.

use std::f64::consts::PI;

use mist_engine::colour::ColourTable;
use mist_format::number::general;
use spectra::{Adaptation, Matrix3, RgbSpace, Xyz};

/// The conversion from linear RGB of a table to sRGB.
pub(super) struct DisplayColours {
    space: RgbSpace,
    adapt: Matrix3,
    scale: f64,
    /// The luminance that is shown as white, if it is not that of a perfect diffuser.
    brightest: Option<f64>,
}

impl DisplayColours {
    /// The conversion for the space and the quantity of `table`.
    pub(super) fn new(table: &ColourTable) -> Self {
        let space = RgbSpace::parse(&table.space).unwrap_or_else(|_| RgbSpace::srgb());
        let srgb = RgbSpace::srgb();
        let adapt = Adaptation::Bradford.matrix(space.white(), srgb.white());
        // A space without a valid white is shown unadapted.
        let adapt = adapt.unwrap_or([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]);
        let brightest = brightest(table);
        Self { space, adapt, scale: Self::white_scale(table), brightest }
    }

    /// The factor that makes white 1: a perfect diffuser has the BRDF 1/π, the factor 1, the
    /// reflectance 1.
    pub(super) fn white_scale(table: &ColourTable) -> f64 {
        let is_brdf = table.quantity.split(' ').next() == Some("brdf");
        brightest(table).map_or(if is_brdf { PI } else { 1.0 }, |luminance| 1.0 / luminance)
    }

    /// Colour of row `at` as `#rrggbb`.
    pub(super) fn hex(&self, table: &ColourTable, at: usize) -> String {
        let [r, g, b] = self.bytes(table, at);
        format!("#{r:02x}{g:02x}{b:02x}")
    }

    /// True if the colour of row `at` is dark, so that text on it should be light.
    pub(super) fn is_dark(&self, table: &ColourTable, at: usize) -> bool {
        let [r, g, b] = self.bytes(table, at).map(f64::from);
        // Luma weights of ITU-R BT.709.
        0.2126 * r + 0.7152 * g + 0.0722 * b < 110.0
    }

    /// sRGB of row `at`; colours brighter than white keep their hue.
    fn bytes(&self, table: &ColourTable, at: usize) -> [u8; 3] {
        let exposure = self.exposure(table, at);
        RgbSpace::srgb().encode_u8(self.linear(table, at).map(|v| v * exposure))
    }

    /// Linear sRGB of row `at`, white = 1.
    fn linear(&self, table: &ColourTable, at: usize) -> [f64; 3] {
        let xyz = self.space.xyz(table.rows[at].rgb[0]);
        let [x, y, z] = self.adapt.map(|[a, b, c]| a * xyz.x + b * xyz.y + c * xyz.z);
        RgbSpace::srgb().linear(Xyz::new(x, y, z)).map(|v| v * self.scale)
    }

    /// The exposure of row `at`: 1, or less for a colour that is brighter than white.
    pub(super) fn exposure(&self, table: &ColourTable, at: usize) -> f64 {
        let brightest = self.linear(table, at).iter().copied().fold(1.0, f64::max);
        // White through two matrices is 1 but for rounding.
        if brightest < 1.0 + 1e-9 { 1.0 } else { 1.0 / brightest }
    }

    /// A phrase about white, for the subtitle.
    pub(super) fn white(&self) -> String {
        match self.brightest {
            None => "white is a perfect diffuser".to_owned(),
            Some(luminance) => format!("white is the brightest row, Y = {}", general(luminance, 4)),
        }
    }
}

/// The luminance of the row that is shown as white, for radiances: they have no diffuser to compare
/// with.
fn brightest(table: &ColourTable) -> Option<f64> {
    let is_radiance = table.quantity.split(' ').next() == Some("radiance");
    let luminances = table.rows.iter().map(|row| row.xyz[0][1]);
    is_radiance.then(|| luminances.fold(0.0, f64::max)).filter(|luminance| *luminance > 0.0)
}
