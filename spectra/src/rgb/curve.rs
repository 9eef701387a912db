//! Transfer curves between linear and encoded channels.
//!
//! Every curve is odd, encode(v) = sign(v) encode(|v|), as in CSS Color 4: colours out of gamut keep
//! their sign and come back.

/// A transfer curve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Curve {
    /// Encoded equals linear.
    Linear,
    /// IEC 61966-2-1: 12.92 v up to 0.0031308, then 1.055 v^(1/2.4) − 0.055.
    Srgb,
    /// v^(1/γ).
    Gamma(f64),
    /// ITU-R BT.2020: 4.5 v below β, then α v^0.45 − (α − 1), with α and β unrounded.
    Rec2020,
    /// ISO 22028-2 (ROMM): 16 v below 2⁻⁹, then v^(1/1.8).
    ProPhoto,
}

/// α and β of BT.2020, which make curve and slope continuous.
const REC2020_ALPHA: f64 = 1.09929682680944;
const REC2020_BETA: f64 = 0.018053968510807;

impl Curve {
    /// The encoded channel of a linear one.
    pub fn encode(self, linear: f64) -> f64 {
        self.encode_positive(linear.abs()).copysign(linear)
    }

    /// The linear channel of an encoded one.
    pub fn decode(self, encoded: f64) -> f64 {
        self.decode_positive(encoded.abs()).copysign(encoded)
    }

    fn encode_positive(self, v: f64) -> f64 {
        match self {
            Self::Linear => v,
            Self::Srgb if v <= 0.0031308 => 12.92 * v,
            Self::Srgb => 1.055 * v.powf(1.0 / 2.4) - 0.055,
            Self::Gamma(gamma) => v.powf(1.0 / gamma),
            Self::Rec2020 if v < REC2020_BETA => 4.5 * v,
            Self::Rec2020 => REC2020_ALPHA * v.powf(0.45) - (REC2020_ALPHA - 1.0),
            Self::ProPhoto if v < 1.0 / 512.0 => 16.0 * v,
            Self::ProPhoto => v.powf(1.0 / 1.8),
        }
    }

    fn decode_positive(self, v: f64) -> f64 {
        match self {
            Self::Linear => v,
            Self::Srgb if v <= 12.92 * 0.0031308 => v / 12.92,
            Self::Srgb => ((v + 0.055) / 1.055).powf(2.4),
            Self::Gamma(gamma) => v.powf(gamma),
            Self::Rec2020 if v < 4.5 * REC2020_BETA => v / 4.5,
            Self::Rec2020 => ((v + REC2020_ALPHA - 1.0) / REC2020_ALPHA).powf(1.0 / 0.45),
            Self::ProPhoto if v < 16.0 / 512.0 => v / 16.0,
            Self::ProPhoto => v.powf(1.8),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const ALL: [Curve; 5] =
        [Curve::Linear, Curve::Srgb, Curve::Gamma(2.6), Curve::Rec2020, Curve::ProPhoto];

    #[test]
    fn decoding_undoes_encoding_with_either_sign() {
        for curve in ALL {
            for v in [-2.0, -0.5, -1e-3, 0.0, 1e-4, 0.0031308, 0.01, 0.018, 0.3, 1.0, 5.0] {
                let back = curve.decode(curve.encode(v));
                // A power and its inverse at values up to 5; the sRGB pieces meet to 3e-8.
                assert!((back - v).abs() < 1e-14, "{curve:?} {v} {back}");
            }
        }
    }

    #[test]
    fn one_is_encoded_as_one() {
        for curve in ALL {
            assert!((curve.encode(1.0) - 1.0).abs() < 1e-15);
        }
    }
}
