//! Radiance HDR: a text header, a line with the size, then pixels of four bytes, three mantissas
//! and a common exponent, run-length coded in one of two ways.
//!
//! A mantissa m with exponent e is m·2^(e−136), as in the file's first description (G. Ward,
//! *Graphics Gems II* (1991), 80). Pixels are divided by the factors of EXPOSURE and COLORCORR.

use spectra::{RgbSpace, Xyz, rgb::Curve};

use super::pixels::{Encoding, Image, ImageError, check_size};

/// Row widths of the new run-length code.
const NEW_WIDTHS: std::ops::RangeInclusive<usize> = 8..=0x7fff;

fn malformed(problem: impl Into<String>) -> ImageError {
    ImageError::Malformed { format: "HDR", problem: problem.into() }
}

/// The header of a file.
struct RadianceHeader {
    size: [usize; 2],
    /// Rows run from bottom to top.
    upwards: bool,
    /// Columns run from right to left.
    leftwards: bool,
    xyz: bool,
    /// The factor by which pixels were multiplied.
    factor: [f64; 3],
    space: RgbSpace,
}

pub(super) fn read(bytes: &[u8]) -> Result<Image, ImageError> {
    let mut rest = bytes;
    let header = header(&mut rest)?;
    let [width, height] = header.size;
    check_size(width, height)?;
    // A row takes at least 4 bytes in any code.
    if rest.len() < 4 * height {
        return Err(malformed("the pixels are truncated"));
    }
    let mut rows = Vec::with_capacity(height);
    for y in 0..height {
        let row = scanline(&mut rest, width);
        let row =
            row.ok_or_else(|| malformed(format!("row {y} of {height} is truncated or invalid")))?;
        rows.push(row);
    }
    if header.upwards {
        rows.reverse();
    }
    let srgb = RgbSpace::srgb();
    let mut values = Vec::with_capacity(3 * width * height);
    for mut row in rows {
        if header.leftwards {
            row.reverse();
        }
        for pixel in row {
            let light = float(pixel);
            let light = [0, 1, 2].map(|i| light[i] / header.factor[i]);
            let [x, y, z] = light;
            let rgb = if header.xyz { srgb.linear(Xyz::new(x, y, z)) } else { light };
            values.extend(rgb.map(|v| v as f32));
        }
    }
    let mut image = Image::new(header.size, 3, values, Encoding::Linear)?;
    image.space = header.space;
    Ok(image)
}

fn header(rest: &mut &[u8]) -> Result<RadianceHeader, ImageError> {
    let mut header = RadianceHeader {
        size: [0; 2],
        upwards: false,
        leftwards: false,
        xyz: false,
        factor: [1.0; 3],
        space: RgbSpace::srgb(),
    };
    loop {
        let line = line(rest)?;
        if line.is_empty() {
            break;
        }
        let Some((key, value)) = line.split_once('=') else { continue };
        let wrong = || malformed(format!("the line {line:?} cannot be read"));
        let numbers = || -> Result<Vec<f64>, ImageError> {
            value.split_whitespace().map(|word| word.parse().map_err(|_| wrong())).collect()
        };
        match key.trim() {
            "FORMAT" => match value.trim() {
                "32-bit_rle_rgbe" => header.xyz = false,
                "32-bit_rle_xyze" => header.xyz = true,
                _ => return Err(wrong()),
            },
            "EXPOSURE" | "COLORCORR" => {
                let by = match numbers()?[..] {
                    [all] => [all; 3],
                    [r, g, b] => [r, g, b],
                    _ => return Err(wrong()),
                };
                if !by.iter().all(|by| *by > 0.0 && by.is_finite()) {
                    return Err(wrong());
                }
                header.factor = [0, 1, 2].map(|i| header.factor[i] * by[i]);
            }
            "PRIMARIES" => {
                let [rx, ry, gx, gy, bx, by, wx, wy] = numbers()?[..] else { return Err(wrong()) };
                let primaries = [[rx, ry], [gx, gy], [bx, by]];
                let space =
                    RgbSpace::from_primaries("of the file", primaries, [wx, wy], Curve::Linear);
                header.space = space.map_err(|_| wrong())?;
            }
            _ => {}
        }
    }
    let size = line(rest)?;
    let words: Vec<&str> = size.split_whitespace().collect();
    let [y, height, x, width] = words[..] else {
        return Err(malformed(format!("{size:?} is not a size such as \"-Y 480 +X 640\"")));
    };
    let wrong = || malformed(format!("the size {size:?} cannot be read"));
    if !matches!(y, "-Y" | "+Y") || !matches!(x, "-X" | "+X") {
        return Err(wrong());
    }
    (header.upwards, header.leftwards) = (y == "+Y", x == "-X");
    header.size = [width.parse().map_err(|_| wrong())?, height.parse().map_err(|_| wrong())?];
    Ok(header)
}

/// The next line of the header.
fn line<'a>(rest: &mut &'a [u8]) -> Result<&'a str, ImageError> {
    let length = rest.iter().position(|b| *b == b'\n');
    let length = length.ok_or_else(|| malformed("the header is not complete"))?;
    let line =
        std::str::from_utf8(&rest[..length]).map_err(|_| malformed("the header is not text"));
    *rest = &rest[length + 1..];
    Ok(line?.trim_end_matches('\r'))
}

/// The next row of pixels.
fn scanline(rest: &mut &[u8], width: usize) -> Option<Vec<[u8; 4]>> {
    match rest {
        [2, 2, high, low, ..] if NEW_WIDTHS.contains(&width) && *high < 128 => {
            let coded = usize::from(*high) << 8 | usize::from(*low);
            *rest = &rest[4..];
            if coded == width { new_row(rest, width) } else { None }
        }
        _ => old_row(rest, width),
    }
}

/// A row of the new code: the four components one after the other, each in runs.
fn new_row(rest: &mut &[u8], width: usize) -> Option<Vec<[u8; 4]>> {
    let mut row = vec![[0; 4]; width];
    for component in 0..4 {
        let mut x = 0;
        while x < width {
            let code = usize::from(take(rest)?);
            let (count, run) = if code > 128 { (code - 128, true) } else { (code, false) };
            if count == 0 || x + count > width {
                return None;
            }
            let mut value = if run { take(rest)? } else { 0 };
            for pixel in &mut row[x..x + count] {
                if !run {
                    value = take(rest)?;
                }
                pixel[component] = value;
            }
            x += count;
        }
    }
    Some(row)
}

/// A row of the old code, pixel by pixel; mantissas 1, 1, 1 repeat the previous pixel, several such
/// pixels are the digits of one count.
fn old_row(rest: &mut &[u8], width: usize) -> Option<Vec<[u8; 4]>> {
    let mut row: Vec<[u8; 4]> = Vec::with_capacity(width);
    let mut shift = 0;
    while row.len() < width {
        let [r, g, b, e, tail @ ..] = *rest else { return None };
        *rest = tail;
        if [*r, *g, *b] == [1, 1, 1] {
            let before = *row.last()?;
            let count = usize::from(*e).checked_shl(shift).filter(|n| row.len() + n <= width)?;
            row.resize(row.len() + count, before);
            shift += 8;
            if shift > 16 {
                return None;
            }
        } else {
            row.push([*r, *g, *b, *e]);
            shift = 0;
        }
    }
    Some(row)
}

fn take(rest: &mut &[u8]) -> Option<u8> {
    let (first, tail) = rest.split_first()?;
    *rest = tail;
    Some(*first)
}

fn float([r, g, b, e]: [u8; 4]) -> [f64; 3] {
    if e == 0 {
        return [0.0; 3];
    }
    let unit = 2_f64.powi(i32::from(e) - 136);
    [r, g, b].map(|m| f64::from(m) * unit)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn file(header: &str, size: &str, pixels: &[u8]) -> Vec<u8> {
        [format!("#?RADIANCE\n{header}\n{size}\n").as_bytes(), pixels].concat()
    }

    #[test]
    fn old_and_new_codes_give_the_same_pixels() {
        let format = "FORMAT=32-bit_rle_rgbe\n";
        // Ten pixels (128, 64, 32)·2^(129−136): a pixel, and nine more.
        let old = file(format, "-Y 1 +X 10", &[128, 64, 32, 129, 1, 1, 1, 9]);
        let new = [
            2,
            2,
            0,
            10,
            128 + 10,
            128,
            128 + 10,
            64,
            10,
            32,
            32,
            32,
            32,
            32,
            32,
            32,
            32,
            32,
            32,
            138,
            129,
        ];
        let new = file(format, "-Y 1 +X 10", &new);
        let expected: Vec<f32> = [1.0, 0.5, 0.25].into_iter().cycle().take(30).collect();
        assert_eq!(read(&old).unwrap().values(), expected);
        assert_eq!(read(&new).unwrap().values(), expected);
    }

    #[test]
    fn pixels_are_divided_by_the_exposure_and_ordered_by_the_size_line() {
        let pixels = [128, 0, 0, 129, 0, 128, 0, 129];
        let up = file("EXPOSURE=2\nEXPOSURE= 2.0\n", "+Y 2 +X 1", &pixels);
        assert_eq!(read(&up).unwrap().values(), [0.0, 0.25, 0.0, 0.25, 0.0, 0.0]);
        let left = file("", "-Y 1 -X 2", &pixels);
        assert_eq!(read(&left).unwrap().values(), [0.0, 1.0, 0.0, 1.0, 0.0, 0.0]);
    }

    #[test]
    fn xyz_keeps_its_luminance() {
        let image =
            read(&file("FORMAT=32-bit_rle_xyze\n", "-Y 1 +X 1", &[60, 128, 30, 129])).unwrap();
        let [r, g, b] = image.linear().next().unwrap();
        // Single precision.
        assert!((RgbSpace::srgb().xyz([r, g, b]).y - 1.0).abs() < 1e-6);
    }

    #[test]
    fn wrong_files_are_refused() {
        let pixel = [1, 2, 3, 4];
        for bad in [
            file("EXPOSURE=0\n", "-Y 1 +X 1", &pixel),
            file("EXPOSURE=x\n", "-Y 1 +X 1", &pixel),
            file("FORMAT=other\n", "-Y 1 +X 1", &pixel),
            file("PRIMARIES=1 2\n", "-Y 1 +X 1", &pixel),
            file("", "+X 1 -Y 1", &pixel),
            file("", "-Y 1", &pixel),
            file("", "-Y 1 +X 2", &pixel),
            file("", "-Y 1 +X 2", &[1, 1, 1, 4]),
            file("", "-Y 1 +X 9", &[2, 2, 0, 8, 1, 1, 1, 4]),
            file("", "-Y 1 +X 8", &[2, 2, 0, 8, 0, 0, 0, 0]),
            b"#?RADIANCE\n".to_vec(),
        ] {
            assert!(read(&bad).is_err(), "{}", String::from_utf8_lossy(&bad));
        }
    }
}
