//! RISE's `pinhole_camera`: the beam of every pixel.

use glam::DVec3;

use crate::{export::ExportError, rise::scene::SceneChunk};

/// Axes of the camera, and half the height of its picture at the distance 1.
#[derive(Clone, Copy, Debug)]
pub(super) struct Camera {
    forward: DVec3,
    right: DVec3,
    up: DVec3,
    half_height: f64,
}

impl Camera {
    /// The camera of a scene.
    ///
    /// # Errors
    ///
    /// If there is not exactly one `pinhole_camera` with valid parameters.
    pub(super) fn of(chunks: &[SceneChunk]) -> Result<Self, ExportError> {
        let refused = |problem: String| ExportError::refused("camera", problem);
        let mut cameras = chunks.iter().filter(|chunk| chunk.keyword.ends_with("_camera"));
        let Some(chunk) = cameras.next() else {
            return Err(refused("the scene has none".into()));
        };
        if chunk.keyword != "pinhole_camera" || cameras.next().is_some() {
            let problem = format!("line {}: expected one pinhole_camera and no other", chunk.line);
            return Err(refused(problem));
        }
        // Parameters that rotate the camera further are refused.
        let known = ["name", "location", "lookat", "up", "fov"];
        if let Some((name, _)) = chunk.lines.iter().find(|(name, _)| !known.contains(&&**name)) {
            let problem = format!("line {}: {name} is not supported", chunk.line);
            return Err(refused(problem));
        }
        let vector = |name: &str, usual| triple(chunk, name).unwrap_or(Ok(usual));
        let location = vector("location", DVec3::ZERO)?;
        let forward = vector("lookat", DVec3::NEG_Z)? - location;
        let (forward, up) = (forward.try_normalize(), vector("up", DVec3::Y)?);
        let right = forward.and_then(|forward| forward.cross(up).try_normalize());
        let (Some(forward), Some(right)) = (forward, right) else {
            return Err(refused("lookat equals location, or up is parallel to the view".into()));
        };
        let fov: f64 = chunk.get("fov").and_then(|text| text.parse().ok()).unwrap_or(f64::NAN);
        if !(fov > 0.0 && fov < 180.0) {
            return Err(refused("fov is missing or not an angle from 0 to 180 degrees".into()));
        }
        let half_height = (0.5 * fov.to_radians()).tan();
        Ok(Self { forward, right, up: right.cross(forward), half_height })
    }

    /// Unit vectors from the point in a pixel to the camera, and perpendicular to it to the right.
    pub(super) fn beam(&self, [x, y]: [usize; 2], [width, height]: [usize; 2]) -> (DVec3, DVec3) {
        let unit = 2.0 * self.half_height / height as f64;
        let across = (x as f64 + 0.5 - 0.5 * width as f64) * unit;
        let up = (0.5 * height as f64 - y as f64 - 0.5) * unit;
        let to_camera = -(self.forward + across * self.right + up * self.up).normalize();
        let horizontal = self.right - self.right.dot(to_camera) * to_camera;
        (to_camera, horizontal.normalize())
    }
}

/// Three numbers of a chunk, if it has them.
pub(super) fn triple(chunk: &SceneChunk, name: &str) -> Option<Result<DVec3, ExportError>> {
    let text = chunk.get(name)?;
    let numbers: Option<Vec<f64>> = text
        .split_whitespace()
        .map(|word| word.parse().ok().filter(|x: &f64| x.is_finite()))
        .collect();
    Some(match numbers.as_deref() {
        Some(&[x, y, z]) => Ok(DVec3::new(x, y, z)),
        _ => {
            let part = format!("scene, line {}", chunk.line);
            Err(ExportError::refused(&part, format!("{name} {text}: expected three numbers")))
        }
    })
}
