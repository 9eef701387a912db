//! Portable float maps: a line `PF` (colour) or `Pf` (grey), width and height, a scale whose sign
//! is the byte order, then 32-bit floats from the bottom row to the top one.

use super::pixels::{Encoding, Image, ImageError, check_size};

fn malformed(problem: impl Into<String>) -> ImageError {
    ImageError::Malformed { format: "PFM", problem: problem.into() }
}

pub(super) fn read(bytes: &[u8]) -> Result<Image, ImageError> {
    let mut rest = bytes;
    let channels = match word(&mut rest)? {
        "PF" => 3,
        "Pf" => 1,
        other => return Err(malformed(format!("it begins with {other:?}, not with PF or Pf"))),
    };
    let mut size = [0; 2];
    for (size, what) in size.iter_mut().zip(["width", "height"]) {
        let text = word(&mut rest)?;
        let parsed = text.parse();
        *size = parsed.map_err(|_| malformed(format!("{text:?} is not a {what}")))?;
    }
    let text = word(&mut rest)?;
    let scale: f64 = text.parse().map_err(|_| malformed(format!("{text:?} is not a scale")))?;
    let pixels = check_size(size[0], size[1])?;
    let expected = pixels * channels * size_of::<f32>();
    if rest.len() < expected {
        return Err(malformed(format!("{} of {expected} bytes are present", rest.len())));
    }
    let number = |bytes: &[u8]| {
        let bytes = [bytes[0], bytes[1], bytes[2], bytes[3]];
        if scale < 0.0 { f32::from_le_bytes(bytes) } else { f32::from_be_bytes(bytes) }
    };
    let row = size[0] * channels * size_of::<f32>();
    let rows = rest[..expected].chunks_exact(row).rev();
    let values = rows.flat_map(|row| row.chunks_exact(size_of::<f32>())).map(number).collect();
    Image::new(size, channels, values, Encoding::Linear)
}

/// Takes the next word of the header and the white space after it.
fn word<'a>(rest: &mut &'a [u8]) -> Result<&'a str, ImageError> {
    // The longest word of a header.
    const LONGEST: usize = 64;
    let start = rest.iter().position(|b| !b.is_ascii_whitespace()).unwrap_or(rest.len());
    let bytes = &rest[start..];
    let length = bytes.iter().take(LONGEST).position(u8::is_ascii_whitespace);
    let length = length.ok_or_else(|| malformed("the header is not complete"))?;
    *rest = &bytes[length + 1..];
    std::str::from_utf8(&bytes[..length]).map_err(|_| malformed("the header is not text"))
}

pub(super) fn write(image: &Image) -> Vec<u8> {
    let magic = if image.channels == 1 { "Pf" } else { "PF" };
    let mut bytes = format!("{magic}\n{} {}\n-1.0\n", image.width, image.height).into_bytes();
    let linear: Vec<[f64; 3]> = image.linear().collect();
    for row in linear.chunks_exact(image.width).rev() {
        for pixel in row {
            for value in &pixel[..image.channels] {
                bytes.extend_from_slice(&(*value as f32).to_le_bytes());
            }
        }
    }
    bytes
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_run_from_bottom_to_top_in_either_byte_order() {
        for scale in ["-1.0", "1"] {
            let mut bytes = format!("Pf\n1 2\n{scale}\n").into_bytes();
            for value in [0.25_f32, 2.0] {
                let [le, be] = [value.to_le_bytes(), value.to_be_bytes()];
                bytes.extend(if scale == "-1.0" { le } else { be });
            }
            assert_eq!(read(&bytes).unwrap().values(), [2.0, 0.25]);
        }
    }

    #[test]
    fn wrong_headers_are_refused() {
        for bad in
            ["PF", "PX\n1 1\n1\n", "Pf\nx 1\n1\n", "Pf\n1 1\nx\n", "Pf\n99999999 99999999\n1\n"]
        {
            assert!(read(bad.as_bytes()).is_err(), "{bad}");
        }
    }
}
