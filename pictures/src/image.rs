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
mod format;
mod pfm;
mod pixels;
mod png;
mod radiance;

pub use format::PictureFormat;
pub use pixels::{Encoding, Image, ImageError, MOST_PIXELS};
