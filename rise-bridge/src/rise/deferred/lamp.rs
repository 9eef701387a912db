//! RISE's `directional_light`.

use glam::DVec3;

use super::camera::triple;
use crate::{export::ExportError, rise::scene::SceneChunk};

/// A directional light of the scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DirectionalLamp {
    /// Unit vector to the lamp.
    pub toward: DVec3,
    /// Irradiance on a surface that faces it.
    pub irradiance: f64,
}

impl DirectionalLamp {
    /// The lamp of a chunk.
    ///
    /// # Errors
    ///
    /// If the chunk is another light, is not grey, or lacks power or direction.
    pub(super) fn of(chunk: &SceneChunk) -> Result<Self, ExportError> {
        let refused = |problem: &str| {
            let part = format!("scene, line {}", chunk.line);
            ExportError::refused(&part, format!("{}: {problem}", chunk.keyword))
        };
        if chunk.keyword != "directional_light" {
            return Err(refused("only directional_light is supported"));
        }
        let color = triple(chunk, "color").unwrap_or(Ok(DVec3::ONE))?;
        if color.x != color.y || color.x != color.z {
            return Err(refused("its color is not grey: the spectrum of lamps is --illuminant"));
        }
        let power = chunk.get("power").map_or(Some(1.0), |text| text.parse::<f64>().ok());
        let power = power.filter(|power| *power >= 0.0 && power.is_finite());
        let toward = triple(chunk, "direction").transpose()?.and_then(DVec3::try_normalize);
        match (power, toward) {
            (Some(power), Some(toward)) => Ok(Self { toward, irradiance: power * color.x }),
            _ => Err(refused("expected a power and a direction")),
        }
    }
}
