//! Pictures in files: PNG, OpenEXR, Radiance HDR and PFM.
//!
//! | format | read | write | values |
//! | --- | --- | --- | --- |
//! | PNG | 1 to 16 bits, grey, colour, palette | 8 bits | encoded sRGB, 0 … 1 |
//! | EXR | channels R, G, B, or one channel, of the first layer | 32-bit float, ZIP | linear |
//! | HDR | RGBE and XYZE, both run-length codes | – | linear, exposure taken out |
//! | PFM | grey and colour, both byte orders | little-endian | linear |
//!
//! A transparency channel is left out. Linear colours are in the primaries that the file names, or
//! in those of sRGB. PFM's scale factor is read for its sign only, as most readers do.

mod exr;
mod pfm;
mod png;
mod radiance;

use spectra::RgbSpace;

/// Pixels of a picture at most; a header that promises more is refused before memory is taken.
pub const MOST_PIXELS: usize = 1 << 27;

/// What the values of a picture are.
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
    width: usize,
    height: usize,
    channels: usize,
    values: Vec<f32>,
    encoding: Encoding,
    space: RgbSpace,
}

/// A format of pictures.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// Portable Network Graphics.
    Png,
    /// OpenEXR.
    Exr,
    /// Radiance HDR; read only.
    Hdr,
    /// Portable float map.
    Pfm,
}

/// Why a file is no picture, or a picture no file.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ImageError {
    /// The first bytes are those of no format that is read.
    #[error("this is no PNG, EXR, HDR or PFM file")]
    Unknown,
    /// The file does not keep to its format.
    #[error("not a {format} file that can be read: {problem}")]
    Malformed {
        /// The format.
        format: &'static str,
        /// What is wrong.
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
    /// The format is not written.
    #[error("pictures are written as .png, .exr or .pfm, not as {0}")]
    NotWritten(&'static str),
}

impl Format {
    /// The format of files with this name, by its extension.
    pub fn of_name(name: &str) -> Option<Self> {
        let extension = name.rsplit_once('.')?.1.to_ascii_lowercase();
        match extension.as_str() {
            "png" => Some(Self::Png),
            "exr" => Some(Self::Exr),
            "hdr" | "pic" => Some(Self::Hdr),
            "pfm" => Some(Self::Pfm),
            _ => None,
        }
    }
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

    /// The picture in the bytes of a file; the first bytes tell the format.
    ///
    /// # Errors
    ///
    /// If the bytes are no picture that is read.
    pub fn read(bytes: &[u8]) -> Result<Self, ImageError> {
        match bytes {
            [0x89, b'P', b'N', b'G', ..] => png::read(bytes),
            [0x76, 0x2f, 0x31, 0x01, ..] => exr::read(bytes),
            [b'#', b'?', ..] => radiance::read(bytes),
            [b'P', b'F' | b'f', ..] => pfm::read(bytes),
            _ => Err(ImageError::Unknown),
        }
    }

    /// The bytes of a file with the picture. PNG holds encoded values clipped to 0 … 1 in eight
    /// bits; EXR and PFM hold linear ones.
    ///
    /// # Errors
    ///
    /// If the format is not written.
    pub fn write(&self, format: Format) -> Result<Vec<u8>, ImageError> {
        match format {
            Format::Png => png::write(self),
            Format::Exr => exr::write(self),
            Format::Pfm => Ok(pfm::write(self)),
            Format::Hdr => Err(ImageError::NotWritten(".hdr")),
        }
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

    /// What the values are.
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

/// The number of pixels, if it can be had.
fn check_size(width: usize, height: usize) -> Result<usize, ImageError> {
    let pixels = width.checked_mul(height).filter(|pixels| (1..=MOST_PIXELS).contains(pixels));
    pixels.ok_or(ImageError::Size { width, height })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn picture(channels: usize, encoding: Encoding) -> Image {
        let values = (0..7 * 5 * channels).map(|i| (i % 52) as f32 / 51.0).collect();
        Image::new([7, 5], channels, values, encoding).unwrap()
    }

    #[test]
    fn what_is_written_is_read_back() {
        for channels in [1, 3] {
            let linear = picture(channels, Encoding::Linear);
            for format in [Format::Exr, Format::Pfm] {
                assert_eq!(Image::read(&linear.write(format).unwrap()).unwrap(), linear);
            }
            // Multiples of 5/255 are whole bytes.
            let encoded = picture(channels, Encoding::Srgb);
            assert_eq!(Image::read(&encoded.write(Format::Png).unwrap()).unwrap(), encoded);
        }
        assert!(picture(1, Encoding::Linear).write(Format::Hdr).is_err());
    }

    #[test]
    fn a_cut_off_file_is_refused() {
        for format in [Format::Png, Format::Exr, Format::Pfm] {
            let bytes = picture(3, Encoding::Linear).write(format).unwrap();
            for length in 0..bytes.len() - 12 {
                assert!(Image::read(&bytes[..length]).is_err(), "{format:?} {length}");
            }
        }
    }

    #[test]
    fn linear_values_become_bytes_by_the_curve_of_srgb() {
        let linear = Image::new([2, 1], 1, vec![0.5, 3.0], Encoding::Linear).unwrap();
        let png = Image::read(&linear.write(Format::Png).unwrap()).unwrap();
        assert_eq!(png.values(), [188.0 / 255.0, 1.0]);
    }

    #[test]
    fn values_and_sizes_that_do_not_fit_are_refused() {
        assert!(Image::new([2, 2], 1, vec![0.0; 3], Encoding::Linear).is_err());
        assert!(Image::new([2, 1], 2, vec![0.0; 4], Encoding::Linear).is_err());
        assert!(Image::new([0, 1], 1, vec![], Encoding::Linear).is_err());
        assert!(Image::new([usize::MAX, 2], 1, vec![], Encoding::Linear).is_err());
        assert_eq!(Image::read(b"GIF89a"), Err(ImageError::Unknown));
        assert_eq!(Image::read(b""), Err(ImageError::Unknown));
    }
}
