//! A crossed grating drawn in a description file: vertices, and triangles between materials.
//!
//! After the word CROSSGRATING come the blocks of a line grating's description. Vertices have
//! three coordinates; a boundary is `v1 v2 v3 m1 m2` or `QUAD v1 v2 v3 v4 m1 m2`, with m2 on the
//! side to which the normal of v1, v2, v3 points by the right-hand rule. The drawing is cut at
//! the height of every vertex; each part then gets its share of `nlayers` slices by the largest
//! horizontal run of an edge in it. A pixel has the material above the next boundary below it.
//!
//! L. Li, J. Opt. Soc. Am. A 14, 2758 (1997).

use std::{collections::BTreeMap, sync::Arc};

use glam::DVec3;

use super::{
    CrossGrating, CrossGratingMedia, CrossPattern, CrossProfile, CrossSlice, MEDIA,
    grid::{CELL, UnitCell},
};
use crate::{
    grating::{
        GratingMaterial,
        generic::{
            FILE,
            description::{DescriptionContext, GratingDescription},
            shares,
        },
        levels,
    },
    spec::{Class, Laws, Parameter, ParameterError, ParameterNode, Spec},
};

const OWN: &[Parameter] = &[Parameter::integer("nlayers", 10, "Number of slices, about")];

/// Name, parameters and constructor of a [`GenericCrossGrating`].
pub const SPEC: Spec<dyn CrossGrating> = Spec {
    class: Class {
        name: "Generic_CrossGrating",
        parent: "Gridded_CrossGrating",
        summary: "Crossed grating from a description file",
        equation: "materials between triangles of a drawing",
        source: "li-1997",
        params: &[MEDIA, CELL, FILE, OWN],
        laws: Laws::NONE,
    },
    build: |node| Ok(Box::new(GenericCrossGrating::read(node)?)),
};

/// A crossed grating from a drawing.
#[derive(Clone, Debug)]
pub struct GenericCrossGrating {
    media: CrossGratingMedia,
    cell: UnitCell,
    text: Arc<str>,
    values: Arc<str>,
    layers: usize,
}

impl GenericCrossGrating {
    fn read(node: &ParameterNode) -> Result<Self, ParameterError> {
        Ok(Self {
            media: CrossGratingMedia::read(node),
            cell: UnitCell::read(node)?,
            text: node.text("filename").into(),
            values: node.text("pstring").into(),
            layers: levels(node, "nlayers", 1)?,
        })
    }

    fn slices(&self, drawing: &SurfaceDrawing) -> Result<Vec<CrossSlice>, String> {
        let zeta = self.cell.lattice.zeta;
        let isotropic =
            |m: &GratingMaterial| m.epsilon == [m.epsilon[0]; 3] && m.mu == [m.mu[0]; 3];
        if zeta != 0.0 && !drawing.materials.iter().all(isotropic) {
            return Err("anisotropic materials need zeta = 0".to_owned());
        }
        let parts = shares(&drawing.heights, self.layers, |low, high| drawing.run(low, high));
        let mut slices = Vec::new();
        for (low, high, count) in parts.into_iter().rev() {
            let thickness = (high - low) / count as f64;
            for k in (0..count).rev() {
                let z = low + (k as f64 + 0.5) * thickness;
                let grid = self.cell.paint(drawing.materials.clone(), |x, y| drawing.at(x, y, z));
                slices.push(CrossSlice::new(thickness, CrossPattern::Grid(grid)));
            }
        }
        Ok(slices)
    }
}

impl CrossGrating for GenericCrossGrating {
    fn at(&self, lambda: f64) -> Result<CrossProfile, ParameterError> {
        let at_file = |problem: String| ParameterError::new("filename", problem);
        let surroundings = DescriptionContext {
            period: self.cell.lattice.d1,
            lambda,
            above: self.media.above.at(lambda),
            below: self.media.below.at(lambda),
        };
        let text = self.text.trim_start();
        let text = text.strip_prefix("CROSSGRATING").ok_or_else(|| {
            at_file("the description does not start with CROSSGRATING".to_owned())
        })?;
        let description = GratingDescription::read(text, &self.values, &surroundings)?;
        let drawing = SurfaceDrawing::of(&description).map_err(at_file)?;
        let slices = self.slices(&drawing).map_err(at_file)?;
        Ok(self.media.profile(lambda, self.cell.lattice, slices))
    }
}

/// A triangle and the materials on its upper and lower side, by position in the list.
struct Triangle {
    corners: [DVec3; 3],
    above: u8,
    below: u8,
}

impl Triangle {
    /// z of the triangle over (x, y), if it is there.
    fn height(&self, x: f64, y: f64) -> Option<f64> {
        let [a, b, c] = self.corners;
        let area = |p: DVec3, q: DVec3| (p.x - x) * (q.y - y) - (q.x - x) * (p.y - y);
        let (u, v, w) = (area(b, c), area(c, a), area(a, b));
        let sum = u + v + w;
        let inside = (u >= 0.0 && v >= 0.0 && w >= 0.0) || (u <= 0.0 && v <= 0.0 && w <= 0.0);
        (inside && sum != 0.0).then(|| (u * a.z + v * b.z + w * c.z) / sum)
    }
}

/// Position of the lower medium in the list of materials.
const MEDIUM_T: u8 = 0;

struct SurfaceDrawing {
    triangles: Vec<Triangle>,
    materials: Vec<GratingMaterial>,
    /// Distinct heights of vertices, ascending.
    heights: Vec<f64>,
}

impl SurfaceDrawing {
    fn of(description: &GratingDescription) -> Result<Self, String> {
        let points = description.vertices::<3>()?;
        let mut materials = vec![description.material("medium_t")?];
        let mut triangles = Vec::new();
        for line in description.lines("BOUNDARIES") {
            triangles.extend(boundary(&line, description, &points, &mut materials)?);
        }
        let mut heights: Vec<f64> = points.values().map(|p| p[2]).collect();
        heights.sort_by(f64::total_cmp);
        let height = heights.last().copied().unwrap_or(0.0) - heights.first().unwrap_or(&0.0);
        if height <= 0.0 {
            return Err("the vertices have no height".to_owned());
        }
        // Heights that differ by rounding are one.
        heights.dedup_by(|b, a| *b - *a <= 1e-12 * height);
        Ok(Self { triangles, materials, heights })
    }

    /// The largest horizontal run of an edge between two heights.
    fn run(&self, low: f64, high: f64) -> f64 {
        let edges = self.triangles.iter().flat_map(|t| {
            let [a, b, c] = t.corners;
            [(a, b), (b, c), (c, a)]
        });
        edges
            .filter(|(a, b)| a.z.min(b.z) < high && a.z.max(b.z) > low)
            .map(|(a, b)| (b - a).truncate().length() / (b.z - a.z).abs() * (high - low))
            .fold(0.0, f64::max)
    }

    /// The material at a point: that above the next triangle below, or below the next above.
    fn at(&self, x: f64, y: f64, z: f64) -> u8 {
        let (mut floor, mut ceiling) = (f64::NEG_INFINITY, f64::INFINITY);
        let (mut on_floor, mut under_ceiling) = (None, MEDIUM_T);
        for triangle in &self.triangles {
            match triangle.height(x, y) {
                Some(at) if at <= z && at > floor => {
                    (floor, on_floor) = (at, Some(triangle.above));
                }
                Some(at) if at > z && at < ceiling => {
                    (ceiling, under_ceiling) = (at, triangle.below);
                }
                _ => {}
            }
        }
        on_floor.unwrap_or(under_ceiling)
    }
}

/// The one or two triangles of a line of the file.
fn boundary(
    line: &str,
    description: &GratingDescription,
    points: &BTreeMap<String, [f64; 3]>,
    materials: &mut Vec<GratingMaterial>,
) -> Result<Vec<Triangle>, String> {
    let words: Vec<&str> = line.split_whitespace().collect();
    let point = |name: &str| {
        let found = points.get(name).copied().map(DVec3::from_array);
        found.ok_or_else(|| format!("boundary {line:?}: no vertex {name}"))
    };
    let (corners, [m1, m2]) = match words[..] {
        ["QUAD", a, b, c, d, m1, m2] => {
            let [a, b, c, d] = [point(a)?, point(b)?, point(c)?, point(d)?];
            (vec![[a, b, c], [a, c, d]], [m1, m2])
        }
        [a, b, c, m1, m2] => (vec![[point(a)?, point(b)?, point(c)?]], [m1, m2]),
        _ => {
            return Err(format!(
                "boundary {line:?} is not three or QUAD four vertices and two materials"
            ));
        }
    };
    let mut number = |name: &str| -> Result<u8, String> {
        let material = description.material(name)?;
        let at = materials.iter().position(|m| *m == material).unwrap_or_else(|| {
            materials.push(material);
            materials.len() - 1
        });
        u8::try_from(at).map_err(|_| "more than 256 materials".to_owned())
    };
    let (m1, m2) = (number(m1)?, number(m2)?);
    Ok(corners
        .into_iter()
        .map(|corners| {
            let [a, b, c] = corners;
            let upwards = (b - a).cross(c - a).z > 0.0;
            let (above, below) = if upwards { (m2, m1) } else { (m1, m2) };
            Triangle { corners, above, below }
        })
        .collect())
}
