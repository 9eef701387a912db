//! PNG by the crate `png`. Values count as encoded sRGB; chunks of gamma and colour profile are
//! ignored.

use std::io::Cursor;

use png::{BitDepth, ColorType, Decoder, Encoder, Limits, SrgbRenderingIntent, Transformations};

use super::pixels::{Encoding, Image, ImageError, MOST_PIXELS, check_size};

fn malformed(error: impl ToString) -> ImageError {
    ImageError::Malformed { format: "PNG", problem: error.to_string() }
}

pub(super) fn read(bytes: &[u8]) -> Result<Image, ImageError> {
    // Eight bytes are a pixel of four 16-bit channels.
    let limits = Limits { bytes: 8 * MOST_PIXELS };
    let mut decoder = Decoder::new_with_limits(Cursor::new(bytes), limits);
    decoder.set_transformations(Transformations::EXPAND);
    let mut reader = decoder.read_info().map_err(malformed)?;
    let size = [reader.info().width as usize, reader.info().height as usize];
    check_size(size[0], size[1])?;
    let length =
        reader.output_buffer_size().ok_or(ImageError::Size { width: size[0], height: size[1] })?;
    let mut data = vec![0; length];
    let frame = reader.next_frame(&mut data).map_err(malformed)?;
    data.truncate(frame.buffer_size());
    let samples: Vec<f32> = match frame.bit_depth {
        BitDepth::Sixteen => data
            .chunks_exact(2)
            .map(|pair| f32::from(u16::from_be_bytes([pair[0], pair[1]])) / f32::from(u16::MAX))
            .collect(),
        _ => data.iter().map(|byte| f32::from(*byte) / f32::from(u8::MAX)).collect(),
    };
    let (stride, channels) = match frame.color_type {
        ColorType::Grayscale => (1, 1),
        ColorType::GrayscaleAlpha => (2, 1),
        ColorType::Rgba => (4, 3),
        ColorType::Rgb | ColorType::Indexed => (3, 3),
    };
    let values =
        samples.chunks_exact(stride).flat_map(|pixel| &pixel[..channels]).copied().collect();
    Image::new(size, channels, values, Encoding::Srgb)
}

/// A linear colour whose brightest channel is at most 1: brighter ones keep their hue.
fn exposed(pixel: &[f32]) -> [f32; 3] {
    let brightest = pixel.iter().copied().filter(|v| v.is_finite()).fold(1.0, f32::max);
    [0, 1, 2].map(|channel| pixel[channel] / brightest)
}

pub(super) fn write(image: &Image) -> Result<Vec<u8>, ImageError> {
    let size = ImageError::Size { width: image.width, height: image.height };
    let (Ok(width), Ok(height)) = (u32::try_from(image.width), u32::try_from(image.height)) else {
        return Err(size);
    };
    let byte = |v: f32| {
        let encoded = match image.encoding {
            Encoding::Srgb => f64::from(v),
            Encoding::Linear => spectra::rgb::Curve::Srgb.encode(f64::from(v).max(0.0)),
        };
        // The value is clipped to the range of u8; the cast truncates.
        (255.0 * encoded.clamp(0.0, 1.0) + 0.5) as u8
    };
    let data: Vec<u8> = match (image.encoding, image.channels) {
        (Encoding::Linear, 3) => {
            image.values.chunks_exact(3).flat_map(|pixel| exposed(pixel).map(byte)).collect()
        }
        _ => image.values.iter().map(|v| byte(*v)).collect(),
    };
    let mut bytes = Vec::new();
    let mut encoder = Encoder::new(&mut bytes, width, height);
    encoder.set_color(if image.channels == 1 { ColorType::Grayscale } else { ColorType::Rgb });
    encoder.set_depth(BitDepth::Eight);
    encoder.set_source_srgb(SrgbRenderingIntent::RelativeColorimetric);
    let mut writer = encoder.write_header().map_err(malformed)?;
    writer.write_image_data(&data).map_err(malformed)?;
    writer.finish().map_err(malformed)?;
    Ok(bytes)
}
