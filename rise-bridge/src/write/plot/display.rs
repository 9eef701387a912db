//! Screen colours of the values of a table.

use std::f64::consts::PI;

use mist_engine::colour::ColourTable;
use spectra::{Adaptation, Matrix3, RgbSpace, Xyz};

/// The conversion from linear RGB of a table to sRGB.
pub(super) struct DisplayColours {
    space: RgbSpace,
    adapt: Matrix3,
    scale: f64,
}

impl DisplayColours {
    /// The conversion for the space and the quantity of `table`.
    pub(super) fn new(table: &ColourTable) -> Self {
        let space = RgbSpace::parse(&table.space).unwrap_or_else(|_| RgbSpace::srgb());
        let srgb = RgbSpace::srgb();
        let adapt = Adaptation::Bradford.matrix(space.white(), srgb.white());
        // A space without a valid white is shown unadapted.
        let adapt = adapt.unwrap_or([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]);
        Self { space, adapt, scale: scale(table) }
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
        let xyz = self.space.xyz(table.rows[at].rgb[0]);
        let [x, y, z] = self.adapt.map(|[a, b, c]| a * xyz.x + b * xyz.y + c * xyz.z);
        let srgb = RgbSpace::srgb();
        let linear = srgb.linear(Xyz::new(x, y, z)).map(|v| v * self.scale);
        let brightest = linear.iter().copied().fold(1.0, f64::max);
        srgb.encode_u8(linear.map(|v| v / brightest))
    }
}

/// The factor by which the quantity of a perfect diffuser becomes 1.
fn scale(table: &ColourTable) -> f64 {
    match table.quantity.split(' ').next() {
        Some("brdf") => PI,
        Some("factor") => 1.0,
        // Fractions of flux and radiances have no diffuser to compare with: the brightest is white.
        _ => {
            let brightest = table.rows.iter().map(|row| row.xyz[0][1]).fold(0.0, f64::max);
            if brightest > 0.0 { 1.0 / brightest } else { 1.0 }
        }
    }
}
