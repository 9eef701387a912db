//! RISE's `pinhole_camera`: from where a pixel is seen.

use glam::DVec3;

use crate::{export::ExportError, rise::scene::Chunk};

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
    pub(super) fn of(chunks: &[Chunk]) -> Result<Self, ExportError> {
        let refused = |problem: String| ExportError::refused("camera", problem);
        let mut cameras = chunks.iter().filter(|chunk| chunk.keyword.ends_with("_camera"));
        let Some(chunk) = cameras.next() else {
            return Err(refused("the scene has none".into()));
        };
        if chunk.keyword != "pinhole_camera" || cameras.next().is_some() {
            let problem = format!("line {}: expected one pinhole_camera and no other", chunk.line);
            return Err(refused(problem));
        }
        // Turns of the camera beyond its axes.
        let known = ["name", "location", "lookat", "up", "fov"];
        if let Some((name, _)) = chunk.lines.iter().find(|(name, _)| !known.contains(&&**name)) {
            let problem = format!("line {}: {name} is not taken into account", chunk.line);
            return Err(refused(problem));
        }
        let vector = |name: &str, usual| triple(chunk, name).unwrap_or(Ok(usual));
        let location = vector("location", DVec3::ZERO)?;
        let forward = vector("lookat", DVec3::NEG_Z)? - location;
        let (forward, up) = (forward.try_normalize(), vector("up", DVec3::Y)?);
        let right = forward.and_then(|forward| forward.cross(up).try_normalize());
        let (Some(forward), Some(right)) = (forward, right) else {
            return Err(refused("it looks nowhere, or along its own up".into()));
        };
        let fov: f64 = chunk.get("fov").and_then(|text| text.parse().ok()).unwrap_or(f64::NAN);
        if !(fov > 0.0 && fov < 180.0) {
            return Err(refused("fov is the height of the picture in degrees".into()));
        }
        let half_height = (0.5 * fov.to_radians()).tan();
        Ok(Self { forward, right, up: right.cross(forward), half_height })
    }

    /// The unit vectors from the point in a pixel to the camera, and across it to the right.
    pub(super) fn sees(&self, [x, y]: [usize; 2], [width, height]: [usize; 2]) -> (DVec3, DVec3) {
        let unit = 2.0 * self.half_height / height as f64;
        let across = (x as f64 + 0.5 - 0.5 * width as f64) * unit;
        let up = (0.5 * height as f64 - y as f64 - 0.5) * unit;
        let to_camera = -(self.forward + across * self.right + up * self.up).normalize();
        let horizontal = self.right - self.right.dot(to_camera) * to_camera;
        (to_camera, horizontal.normalize())
    }
}

/// Three numbers of a chunk, if it has them.
pub(super) fn triple(chunk: &Chunk, name: &str) -> Option<Result<DVec3, ExportError>> {
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
