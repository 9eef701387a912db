//! From the values of a table to colours on a screen.

use std::f64::consts::PI;

use mist_engine::colour::ColourTable;
use spectra::{Adaptation, Matrix3, RgbSpace, Xyz};

/// How a table's linear RGB becomes sRGB.
pub(super) struct Display {
    space: RgbSpace,
    adapt: Matrix3,
    scale: f64,
}

impl Display {
    /// For the space and the quantity of `table`.
    pub(super) fn new(table: &ColourTable) -> Self {
        let space = RgbSpace::parse(&table.space).unwrap_or_else(|_| RgbSpace::srgb());
        let srgb = RgbSpace::srgb();
        let adapt = Adaptation::Bradford.matrix(space.white(), srgb.white());
        // A space without a proper white is shown unadapted.
        let adapt = adapt.unwrap_or([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]);
        Self { space, adapt, scale: scale(table) }
    }

    /// Colour of row `at` as `#rrggbb`.
    pub(super) fn hex(&self, table: &ColourTable, at: usize) -> String {
        let [r, g, b] = self.bytes(table, at);
        format!("#{r:02x}{g:02x}{b:02x}")
    }

    /// Whether light text is read better on the colour of row `at` than dark text.
    pub(super) fn is_dark(&self, table: &ColourTable, at: usize) -> bool {
        let [r, g, b] = self.bytes(table, at).map(f64::from);
        // Luma weights of ITU-R BT.709.
        0.2126 * r + 0.7152 * g + 0.0722 * b < 110.0
    }

    /// sRGB of row `at`; what is brighter than white keeps its hue.
    fn bytes(&self, table: &ColourTable, at: usize) -> [u8; 3] {
        let xyz = self.space.xyz(table.rows[at].rgb[0]);
        let [x, y, z] = self.adapt.map(|[a, b, c]| a * xyz.x + b * xyz.y + c * xyz.z);
        let srgb = RgbSpace::srgb();
        let linear = srgb.linear(Xyz::new(x, y, z)).map(|v| v * self.scale);
        let brightest = linear.iter().copied().fold(1.0, f64::max);
        srgb.encode_u8(linear.map(|v| v / brightest))
    }
}

/// What brings the quantity of a table to a scale on which a perfect diffuser is 1.
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
