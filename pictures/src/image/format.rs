//! The picture formats, and reading and writing by format.

use super::{
    exr, pfm,
    pixels::{Image, ImageError},
    png, radiance,
};

/// A picture format.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PictureFormat {
    /// Portable Network Graphics.
    Png,
    /// OpenEXR.
    Exr,
    /// Radiance HDR; read only.
    Hdr,
    /// Portable float map.
    Pfm,
}

impl PictureFormat {
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
    /// The picture in the bytes of a file; the format is recognized by its first bytes.
    ///
    /// # Errors
    ///
    /// If the bytes are not a picture in one of the formats.
    pub fn read(bytes: &[u8]) -> Result<Self, ImageError> {
        match bytes {
            [0x89, b'P', b'N', b'G', ..] => png::read(bytes),
            [0x76, 0x2f, 0x31, 0x01, ..] => exr::read(bytes),
            [b'#', b'?', ..] => radiance::read(bytes),
            [b'P', b'F' | b'f', ..] => pfm::read(bytes),
            _ => Err(ImageError::Unknown),
        }
    }

    /// The bytes of a file with the picture. PNG holds encoded values in 0 … 1, linear colours brighter than 1 at a lower exposure, in eight
    /// bits; EXR and PFM hold linear ones.
    ///
    /// # Errors
    ///
    /// If the format is not written.
    pub fn write(&self, format: PictureFormat) -> Result<Vec<u8>, ImageError> {
        match format {
            PictureFormat::Png => png::write(self),
            PictureFormat::Exr => exr::write(self),
            PictureFormat::Pfm => Ok(pfm::write(self)),
            PictureFormat::Hdr => Err(ImageError::NotWritten(".hdr")),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{super::pixels::Encoding, *};

    fn picture(channels: usize, encoding: Encoding) -> Image {
        let values = (0..7 * 5 * channels).map(|i| (i % 52) as f32 / 51.0).collect();
        Image::new([7, 5], channels, values, encoding).unwrap()
    }

    #[test]
    fn what_is_written_is_read_back() {
        for channels in [1, 3] {
            let linear = picture(channels, Encoding::Linear);
            for format in [PictureFormat::Exr, PictureFormat::Pfm] {
                assert_eq!(Image::read(&linear.write(format).unwrap()).unwrap(), linear);
            }
            // Multiples of 5/255 are whole bytes.
            let encoded = picture(channels, Encoding::Srgb);
            assert_eq!(Image::read(&encoded.write(PictureFormat::Png).unwrap()).unwrap(), encoded);
        }
        assert!(picture(1, Encoding::Linear).write(PictureFormat::Hdr).is_err());
    }

    #[test]
    fn a_cut_off_file_is_refused() {
        for format in [PictureFormat::Png, PictureFormat::Exr, PictureFormat::Pfm] {
            let bytes = picture(3, Encoding::Linear).write(format).unwrap();
            for length in 0..bytes.len() - 12 {
                assert!(Image::read(&bytes[..length]).is_err(), "{format:?} {length}");
            }
        }
    }

    #[test]
    fn linear_values_become_bytes_by_the_curve_of_srgb() {
        let linear = Image::new([2, 1], 1, vec![0.5, 3.0], Encoding::Linear).unwrap();
        let png = Image::read(&linear.write(PictureFormat::Png).unwrap()).unwrap();
        assert_eq!(png.values(), [188.0 / 255.0, 1.0]);
        // Colours brighter than white keep the ratios of their channels.
        let bright = Image::new([1, 1], 3, vec![4.0, 2.0, 0.0], Encoding::Linear).unwrap();
        let png = Image::read(&bright.write(PictureFormat::Png).unwrap()).unwrap();
        assert_eq!(png.values(), [1.0, 188.0 / 255.0, 0.0]);
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
