//! Comparison of two pictures of the same view: detection probability, colour difference, ꟻLIP.
//!
//! The luminance of a picture depends on its kind:
//!
//! | picture | luminance in cd/m² |
//! | --- | --- |
//! | encoded sRGB (PNG) | Y of the decoded colour × white |
//! | linear, one channel (EXR, PFM) | the value itself |
//! | linear, colours (EXR, HDR, PFM) | Y × scale |
//!
//! CIEDE2000 is taken between L\*a\*b\* relative to the white of the picture's space at the
//! luminance `white`; ꟻLIP between the encoded colours if both pictures are encoded sRGB, else in
//! its form for high dynamic range, where `white` is 1.

mod overlay;

use serde::Serialize;
use spectra::{Lab, RgbSpace, Xyz, lab};

use crate::{
    image::{Encoding, Image},
    visible::{
        DetectionMap, DetectorSettings, FrontEnd, Luminances, Viewing, VisibleError,
        colour::{self, ColourDifference},
        detect,
        flip::{self, Flip, FlipRange},
    },
};

/// Conditions of the comparison.
#[derive(Clone, Debug, PartialEq)]
pub struct ComparisonSettings {
    /// Display and distance.
    pub viewing: Viewing,
    /// Luminance of white in cd/m².
    pub white: f64,
    /// Luminance in cd/m² of the linear colour with Y = 1.
    pub scale: f64,
    /// Repeat the deviations of HDR-VDP 1.7.
    pub compat: bool,
    /// Also compute Daly's predictor of 1993.
    pub daly: bool,
}

impl Default for ComparisonSettings {
    fn default() -> Self {
        Self { viewing: Viewing::default(), white: 80.0, scale: 1.0, compat: false, daly: false }
    }
}

/// Statistics of a map of detection probabilities.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct DetectionSummary {
    /// Percentage of the pixels with a probability above 0.75.
    pub p75_percent: f64,
    /// Percentage of the pixels with a probability above 0.95.
    pub p95_percent: f64,
    /// Mean probability.
    pub mean: f64,
    /// Largest probability.
    pub max: f64,
}

impl DetectionSummary {
    fn new(map: &DetectionMap) -> Self {
        Self {
            p75_percent: map.percent_above(0.75),
            p95_percent: map.percent_above(0.95),
            mean: map.mean(),
            max: map.max(),
        }
    }
}

/// The result of [`compare`].
#[derive(Clone, Debug, PartialEq)]
pub struct PictureDifference {
    /// Detection by an observer (Mantiuk and others 2005).
    pub detection: DetectionSummary,
    /// Detection by Daly's predictor of 1993, if requested.
    pub daly: Option<DetectionSummary>,
    /// CIEDE2000.
    pub colour: ColourDifference,
    /// ꟻLIP, or the reason why it is undefined.
    pub flip: Result<Flip, VisibleError>,
    /// The range of values that ꟻLIP compared.
    pub flip_range: FlipRange,
    /// The detection probabilities.
    pub map: DetectionMap,
    /// The luminances of the reference.
    pub reference: Luminances,
    /// Smallest and largest luminance of the test in cd/m².
    pub test_range: [f64; 2],
    /// The conditions of the comparison.
    pub settings: ComparisonSettings,
}

/// Compares `test` with `reference`.
///
/// # Errors
///
/// If the pictures have different sizes or cannot be shown, or a setting is not a positive number.
pub fn compare(
    test: &Image,
    reference: &Image,
    settings: &ComparisonSettings,
) -> Result<PictureDifference, VisibleError> {
    for (name, value) in [("the luminance of white", settings.white), ("the scale", settings.scale)]
    {
        if !(value > 0.0 && value.is_finite()) {
            return Err(VisibleError::Viewing { name, value, unit: "cd/m²" });
        }
    }
    let shown = luminances(reference, settings)?;
    let tested = luminances(test, settings)?;
    let detected = |front_end| {
        let model = DetectorSettings { front_end, compat: settings.compat };
        detect(&tested, &shown, &settings.viewing, &model)
    };
    let map = detected(FrontEnd::Hdr)?;
    let daly = if settings.daly {
        Some(DetectionSummary::new(&detected(FrontEnd::Daly1993)?))
    } else {
        None
    };
    let flip_range = match (test.encoding(), reference.encoding()) {
        (Encoding::Srgb, Encoding::Srgb) => FlipRange::Encoded,
        _ => FlipRange::Linear,
    };
    let channels = |image| flip_channels(image, flip_range, settings);
    let per_degree = settings.viewing.pixels_per_degree();
    Ok(PictureDifference {
        detection: DetectionSummary::new(&map),
        daly,
        colour: colour::differences(&labs(test, settings), &labs(reference, settings)),
        flip: flip::flip(test.size(), channels(test), channels(reference), per_degree, flip_range),
        flip_range,
        map,
        reference: shown,
        test_range: tested.range(),
        settings: settings.clone(),
    })
}

/// The luminance in cd/m² of a linear value of 1.
fn unit_luminance(image: &Image, settings: &ComparisonSettings) -> f64 {
    match (image.encoding(), image.channels()) {
        (Encoding::Srgb, _) => settings.white,
        (Encoding::Linear, 1) => 1.0,
        (Encoding::Linear, _) => settings.scale,
    }
}

fn luminances(image: &Image, settings: &ComparisonSettings) -> Result<Luminances, VisibleError> {
    let [width, height] = image.size();
    let unit = unit_luminance(image, settings);
    let [_, to_y, _] = *image.space().to_xyz_matrix();
    let y = |[r, g, b]: [f64; 3]| match image.channels() {
        1 => r * unit,
        _ => (to_y[0] * r + to_y[1] * g + to_y[2] * b) * unit,
    };
    Luminances::new(width, height, image.linear().map(y).collect())
}

/// L\*a\*b\* of each pixel.
fn labs(image: &Image, settings: &ComparisonSettings) -> Vec<Lab> {
    let relative = unit_luminance(image, settings) / settings.white;
    let (space, white) = (image.space(), image.space().white());
    let lab = |rgb: [f64; 3]| {
        let xyz = space.xyz(rgb.map(|v| v * relative));
        lab::from_xyz(Xyz::new(xyz.x, xyz.y, xyz.z), white)
    };
    image.linear().map(lab).collect()
}

/// Red, green and blue in the range that ꟻLIP compares.
fn flip_channels(image: &Image, range: FlipRange, settings: &ComparisonSettings) -> Vec<f32> {
    let relative = unit_luminance(image, settings) / settings.white;
    let srgb = RgbSpace::srgb();
    let same = *image.space() == srgb;
    let channels = |rgb: [f64; 3]| {
        let linear = rgb.map(|v| v * relative);
        let linear = if same { linear } else { srgb.linear(image.space().xyz(linear)) };
        let out = if range == FlipRange::Encoded { srgb.encode_clipped(linear) } else { linear };
        out.map(|v| v as f32)
    };
    image.linear().flat_map(channels).collect()
}

impl PictureDifference {
    /// The numbers as JSON.
    pub fn json(&self) -> serde_json::Value {
        let ComparisonSettings { viewing, white, scale, compat, .. } = &self.settings;
        let flip = match &self.flip {
            Ok(flip) => serde_json::json!({
                "mean": flip.mean, "weighted_median": flip.weighted_median, "max": flip.max,
                "range": match self.flip_range { FlipRange::Encoded => "ldr", FlipRange::Linear => "hdr" },
            }),
            Err(error) => serde_json::json!({ "error": error.to_string() }),
        };
        let mut json = serde_json::json!({
            "size": self.map.size(),
            "hdrvdp": self.detection,
            "compat": compat,
            "ciede2000": {
                "mean": self.colour.mean, "p95": self.colour.p95, "max": self.colour.max,
            },
            "flip": flip,
            "viewing": {
                "pixels_per_degree": viewing.pixels_per_degree(),
                "display_size_m": viewing.size_m(),
                "display_pixels": viewing.pixels(),
                "distance_m": viewing.distance_m(),
            },
            "luminance_cd_m2": {
                "test": self.test_range,
                "reference": self.reference.range(),
                "white": white,
                "scale": scale,
            },
        });
        if let Some(daly) = &self.daly {
            json["daly1993"] = serde_json::json!(daly);
        }
        json
    }

    /// The detection probabilities as a grey picture; 1 is white.
    pub fn map_image(&self, encoding: Encoding) -> Image {
        let values = self.map.probability().iter().map(|p| *p as f32).collect();
        Image::new(self.map.size(), 1, values, encoding).expect("a map has a value for each pixel")
    }

    /// The reference in grey with visible differences in colour: yellow above 75 %, red above 95 %.
    pub fn overlay(&self) -> Image {
        overlay::draw(&self.reference, &self.map)
    }
}
