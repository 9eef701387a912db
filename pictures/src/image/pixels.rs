//! A picture in memory: its pixels, their encoding and their colour space.

use spectra::RgbSpace;

/// The largest number of pixels; a header that states more is refused before memory is allocated.
pub const MOST_PIXELS: usize = 1 << 27;

/// The encoding of the values of a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Encoding {
    /// Encoded by the curve of sRGB; 1 is white.
    Srgb,
    /// Proportional to light.
    Linear,
}

/// A picture, row by row from the top.
#[derive(Clone, Debug, PartialEq)]
pub struct Image {
    pub(super) width: usize,
    pub(super) height: usize,
    pub(super) channels: usize,
    pub(super) values: Vec<f32>,
    pub(super) encoding: Encoding,
    pub(super) space: RgbSpace,
}

/// Errors of reading and writing pictures.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ImageError {
    /// The first bytes belong to none of the formats.
    #[error("not a PNG, EXR, HDR or PFM file")]
    Unknown,
    /// The file violates its format.
    #[error("the {format} file cannot be read: {problem}")]
    Malformed {
        /// The format.
        format: &'static str,
        /// The violation.
        problem: String,
    },
    /// The picture has no pixels, or too many.
    #[error("the picture has {width} × {height} pixels; 1 to {MOST_PIXELS} are read")]
    Size {
        /// Pixels in a row.
        width: usize,
        /// Rows.
        height: usize,
    },
    /// The number of values does not fit the size.
    #[error("{found} values for {width} × {height} pixels of {channels} channels")]
    Values {
        /// Pixels in a row.
        width: usize,
        /// Rows.
        height: usize,
        /// Channels.
        channels: usize,
        /// Values that were given.
        found: usize,
    },
    /// The format is read only.
    #[error("pictures are written as .png, .exr or .pfm, not as {0}")]
    NotWritten(&'static str),
}

impl Image {
    /// A grey picture (one channel) or an sRGB picture (three channels, red, green and blue of a
    /// pixel one after the other).
    ///
    /// # Errors
    ///
    /// If the number of values does not fit, or there are too many pixels or none.
    pub fn new(
        [width, height]: [usize; 2],
        channels: usize,
        values: Vec<f32>,
        encoding: Encoding,
    ) -> Result<Self, ImageError> {
        let pixels = check_size(width, height)?;
        if !matches!(channels, 1 | 3) || values.len() != pixels * channels {
            return Err(ImageError::Values { width, height, channels, found: values.len() });
        }
        Ok(Self { width, height, channels, values, encoding, space: RgbSpace::srgb() })
    }

    /// Columns and rows.
    pub fn size(&self) -> [usize; 2] {
        [self.width, self.height]
    }

    /// 1 for grey, 3 for red, green and blue.
    pub fn channels(&self) -> usize {
        self.channels
    }

    /// The values, row by row from the top, the channels of a pixel one after the other.
    pub fn values(&self) -> &[f32] {
        &self.values
    }

    /// The encoding of the values.
    pub fn encoding(&self) -> Encoding {
        self.encoding
    }

    /// The space of the colours.
    pub fn space(&self) -> &RgbSpace {
        &self.space
    }

    /// Linear red, green and blue of each pixel, in the space of the picture; grey has three equal
    /// channels.
    pub fn linear(&self) -> impl Iterator<Item = [f64; 3]> {
        let decode = |v: f32| match self.encoding {
            Encoding::Srgb => spectra::rgb::Curve::Srgb.decode(f64::from(v)),
            Encoding::Linear => f64::from(v),
        };
        self.values.chunks_exact(self.channels).map(move |pixel| match pixel {
            [r, g, b] => [decode(*r), decode(*g), decode(*b)],
            _ => [decode(pixel[0]); 3],
        })
    }
}

/// The number of pixels of a picture, 1 to [`MOST_PIXELS`].
pub(super) fn check_size(width: usize, height: usize) -> Result<usize, ImageError> {
    let pixels = width.checked_mul(height).filter(|pixels| (1..=MOST_PIXELS).contains(pixels));
    pixels.ok_or(ImageError::Size { width, height })
}
