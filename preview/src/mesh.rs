//! Triangles with normals at their corners, in a tree of boxes.

use std::{f64::consts::TAU, io::Cursor};

use glam::{DMat3, DVec3, dvec3};

use crate::ray::{SceneRay, SurfaceHit};

mod ply;

/// Triangles in a leaf of the tree at most.
const LEAF: usize = 4;
/// Triangles of a mesh at most.
const MOST_TRIANGLES: usize = 1 << 24;

/// Errors of reading or making a mesh.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum MeshError {
    /// The text or the geometry is invalid.
    #[error("not a mesh: {0}")]
    Malformed(String),
    /// No triangle has an area.
    #[error("the mesh has no triangle")]
    Empty,
    /// The mesh exceeds the limit of triangles.
    #[error("the mesh has {0} triangles; {MOST_TRIANGLES} are rendered")]
    Large(usize),
}

#[derive(Clone, Copy, Debug)]
struct MeshTriangle {
    corners: [DVec3; 3],
    normals: [DVec3; 3],
}

/// A body of triangles that fills the unit sphere.
#[derive(Clone, Debug)]
pub struct Mesh {
    triangles: Vec<MeshTriangle>,
    nodes: Vec<BoxNode>,
}

#[derive(Clone, Copy, Debug)]
struct BoxNode {
    low: DVec3,
    high: DVec3,
    /// Leaf: the first triangle and the number of triangles. Branch: the second child and 0; the
    /// first child follows the node.
    at: usize,
    count: usize,
}

impl Mesh {
    /// The mesh of `points` and `faces`, scaled into the unit sphere.
    ///
    /// Without one normal per point, the normal of a point is the mean over its faces, weighted by
    /// area.
    ///
    /// # Errors
    ///
    /// If no triangle has an area, or a face names a point that does not exist.
    pub fn new(
        points: &[DVec3],
        faces: &[[usize; 3]],
        normals: Option<&[DVec3]>,
    ) -> Result<Self, MeshError> {
        if faces.len() > MOST_TRIANGLES {
            return Err(MeshError::Large(faces.len()));
        }
        let is_there = |face: &[usize; 3]| face.iter().all(|i| *i < points.len());
        if let Some(face) = faces.iter().position(|face| !is_there(face)) {
            let problem = format!("face {} names a point that does not exist", face + 1);
            return Err(MeshError::Malformed(problem));
        }
        let points = fitted(points);
        let own = |normals: &[DVec3]| normals.len() == points.len();
        let normals = match normals.filter(|normals| own(normals)) {
            Some(normals) => normals.to_vec(),
            None => smooth(&points, faces),
        };
        let triangles: Vec<MeshTriangle> = faces
            .iter()
            .map(|face| MeshTriangle {
                corners: face.map(|i| points[i]),
                normals: face.map(|i| normals[i]),
            })
            .filter(|triangle| triangle.area().length_squared() > 0.0)
            .collect();
        if triangles.is_empty() {
            return Err(MeshError::Empty);
        }
        let mut mesh = Self { nodes: Vec::new(), triangles };
        mesh.grow(0, mesh.triangles.len());
        Ok(mesh)
    }

    /// The mesh in the text of a Wavefront OBJ file.
    ///
    /// # Errors
    ///
    /// If the text is not a mesh.
    pub fn from_obj(text: &str) -> Result<Self, MeshError> {
        let options =
            tobj::LoadOptions { triangulate: true, single_index: true, ..Default::default() };
        let no_materials = |_: &std::path::Path| Ok(Default::default());
        let (models, _) = tobj::load_obj_buf(&mut Cursor::new(text), &options, no_materials)
            .map_err(|error| MeshError::Malformed(error.to_string()))?;
        let (mut points, mut faces, mut normals) = (Vec::new(), Vec::new(), Vec::new());
        for tobj::Model { mesh, .. } in models {
            let first = points.len();
            points.extend(mesh.positions.chunks_exact(3).map(vector));
            normals.extend(mesh.normals.chunks_exact(3).map(vector));
            faces.extend(
                mesh.indices.chunks_exact(3).map(|f| [0, 1, 2].map(|i| first + f[i] as usize)),
            );
        }
        Self::new(&points, &faces, Some(&normals))
    }

    /// A torus of `2 n²` triangles, tilted towards the camera.
    pub fn torus(n: usize) -> Self {
        const RADII: [f64; 2] = [0.65, 0.3];
        let tilt = 0.9_f64;
        let n = n.max(3);
        let place = |i: usize, j: usize| {
            let (u, v) = (TAU * i as f64 / n as f64, TAU * j as f64 / n as f64);
            let ring = dvec3(u.cos(), u.sin(), 0.0);
            let normal = v.cos() * ring + v.sin() * DVec3::Z;
            let lean = |p: DVec3| {
                dvec3(p.x, p.y * tilt.cos() + p.z * tilt.sin(), p.z * tilt.cos() - p.y * tilt.sin())
            };
            (lean(RADII[0] * ring + RADII[1] * normal), lean(normal))
        };
        let (points, normals): (Vec<_>, Vec<_>) = (0..n * n).map(|k| place(k / n, k % n)).unzip();
        let faces = quads([n, n]);
        Self::new(&points, &faces, Some(&normals)).expect("a torus has triangles")
    }

    /// A trefoil knot of a tube, made of `12 n²` triangles.
    pub fn knot(n: usize) -> Self {
        const TUBE: f64 = 0.42;
        let n = n.max(3);
        let [along, around] = [6 * n, n];
        // A curve on a torus, rotated so that no two parts look alike.
        let curve = |i: usize| {
            let t = TAU * i as f64 / along as f64;
            let ring = 2.0 + (3.0 * t).cos();
            dvec3(ring * (2.0 * t).cos(), ring * (2.0 * t).sin(), 1.3 * (3.0 * t).sin())
        };
        let lean = DMat3::from_rotation_x(-0.45) * DMat3::from_rotation_z(0.35);
        let place = |k: usize| {
            let (i, v) = (k / around, TAU * (k % around) as f64 / around as f64);
            let tangent = (curve(i + 1) - curve(i + along - 1)).normalize();
            let side = tangent.cross(DVec3::Z).normalize();
            let normal = v.cos() * side + v.sin() * side.cross(tangent);
            (lean * (curve(i) + TUBE * normal), lean * normal)
        };
        let (points, normals): (Vec<_>, Vec<_>) = (0..along * around).map(place).unzip();
        let faces = quads([along, around]);
        Self::new(&points, &faces, Some(&normals)).expect("a knot has triangles")
    }

    /// The nearest triangle that `ray` meets, from either side.
    pub(crate) fn hit(&self, ray: SceneRay) -> Option<SurfaceHit> {
        let inverse = ray.along.recip();
        let mut nearest: Option<SurfaceHit> = None;
        let mut waiting = vec![0];
        while let Some(index) = waiting.pop() {
            let node = &self.nodes[index];
            let limit = nearest.map_or(f64::INFINITY, |hit| hit.distance);
            if !node.is_met(&ray, inverse, limit) {
                continue;
            }
            if node.count == 0 {
                waiting.extend([node.at, index + 1]);
                continue;
            }
            for triangle in &self.triangles[node.at..node.at + node.count] {
                let limit = nearest.map_or(f64::INFINITY, |hit| hit.distance);
                nearest = triangle.hit(&ray).filter(|hit| hit.distance < limit).or(nearest);
            }
        }
        nearest
    }

    /// Builds the node of the triangles in a range, and its children.
    fn grow(&mut self, from: usize, to: usize) {
        let part = &mut self.triangles[from..to];
        let corners = || part.iter().flat_map(|triangle| triangle.corners);
        let low = corners().fold(DVec3::INFINITY, DVec3::min);
        let high = corners().fold(DVec3::NEG_INFINITY, DVec3::max);
        let index = self.nodes.len();
        self.nodes.push(BoxNode { low, high, at: from, count: to - from });
        if to - from <= LEAF {
            return;
        }
        let axis = (high - low).max_position();
        let middle = part.len() / 2;
        let place = |triangle: &MeshTriangle| triangle.corners.iter().map(|p| p[axis]).sum::<f64>();
        part.select_nth_unstable_by(middle, |a, b| place(a).total_cmp(&place(b)));
        self.grow(from, from + middle);
        self.nodes[index].at = self.nodes.len();
        self.nodes[index].count = 0;
        self.grow(from + middle, to);
    }
}

impl BoxNode {
    /// True if the ray crosses the box before `limit`.
    fn is_met(&self, ray: &SceneRay, inverse: DVec3, limit: f64) -> bool {
        let a = (self.low - ray.from) * inverse;
        let b = (self.high - ray.from) * inverse;
        let near = a.min(b).max_element().max(0.0);
        near <= a.max(b).min_element().min(limit)
    }
}

impl MeshTriangle {
    /// Twice the area, along the normal.
    fn area(&self) -> DVec3 {
        let [a, b, c] = self.corners;
        (b - a).cross(c - a)
    }

    /// T. Möller and B. Trumbore, Fast, minimum storage ray–triangle intersection (1997).
    fn hit(&self, ray: &SceneRay) -> Option<SurfaceHit> {
        let [a, b, c] = self.corners;
        let (edge1, edge2) = (b - a, c - a);
        let p = ray.along.cross(edge2);
        let scale = edge1.dot(p).recip();
        let t = ray.from - a;
        let u = t.dot(p) * scale;
        let q = t.cross(edge1);
        let v = ray.along.dot(q) * scale;
        let distance = edge2.dot(q) * scale;
        let inside = u >= 0.0 && v >= 0.0 && u + v <= 1.0 && distance > 0.0 && distance.is_finite();
        inside.then(|| {
            let [n0, n1, n2] = self.normals;
            let shading = (1.0 - u - v) * n0 + u * n1 + v * n2;
            let flat = self.area().normalize();
            // The side of the true surface that the ray sees.
            let true_normal = if flat.dot(ray.along) < 0.0 { flat } else { -flat };
            let normal = shading.try_normalize().unwrap_or(true_normal);
            let normal = if normal.dot(true_normal) < 0.0 { -normal } else { normal };
            SurfaceHit { distance, point: ray.from + distance * ray.along, normal, true_normal }
        })
    }
}

/// Two triangles per square of a net of points that is closed both ways.
fn quads([rows, columns]: [usize; 2]) -> Vec<[usize; 3]> {
    let at = |i: usize, j: usize| (i % rows) * columns + j % columns;
    let square = |k: usize| {
        let (i, j) = (k / columns, k % columns);
        let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
        [[a, b, c], [a, c, d]]
    };
    (0..rows * columns).flat_map(square).collect()
}

fn vector(numbers: &[f32]) -> DVec3 {
    dvec3(f64::from(numbers[0]), f64::from(numbers[1]), f64::from(numbers[2]))
}

/// The points moved and scaled into the unit sphere.
fn fitted(points: &[DVec3]) -> Vec<DVec3> {
    let low = points.iter().copied().fold(DVec3::INFINITY, DVec3::min);
    let high = points.iter().copied().fold(DVec3::NEG_INFINITY, DVec3::max);
    let centre = 0.5 * (low + high);
    let radius = points.iter().map(|p| p.distance(centre)).fold(0.0, f64::max);
    let scale = if radius > 0.0 { 0.95 / radius } else { 1.0 };
    points.iter().map(|p| scale * (*p - centre)).collect()
}

fn smooth(points: &[DVec3], faces: &[[usize; 3]]) -> Vec<DVec3> {
    let mut normals = vec![DVec3::ZERO; points.len()];
    for face in faces {
        let [a, b, c] = face.map(|i| points[i]);
        let area = (b - a).cross(c - a);
        face.iter().for_each(|i| normals[*i] += area);
    }
    normals.into_iter().map(DVec3::normalize_or_zero).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const SQUARE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n";

    fn down(x: f64, y: f64) -> SceneRay {
        SceneRay { from: dvec3(x, y, 10.0), along: -DVec3::Z }
    }

    #[test]
    fn a_square_in_a_file_fills_the_view_and_faces_the_camera() {
        let mesh = Mesh::from_obj(SQUARE).unwrap();
        let hit = mesh.hit(down(0.1, -0.2)).unwrap();
        assert!((hit.normal - DVec3::Z).length() < 1e-12 && hit.point.z.abs() < 1e-12);
        assert!(mesh.hit(down(0.8, 0.0)).is_none());
    }

    #[test]
    fn the_tree_finds_the_triangle_that_a_search_of_all_finds() {
        let mesh = Mesh::torus(12);
        for k in 0..400 {
            let ray = down(-1.0 + 0.1 * f64::from(k % 20), -1.0 + 0.1 * f64::from(k / 20));
            let all = mesh.triangles.iter().filter_map(|triangle| triangle.hit(&ray));
            let nearest = all.map(|hit| hit.distance).fold(f64::INFINITY, f64::min);
            let found = mesh.hit(ray).map_or(f64::INFINITY, |hit| hit.distance);
            assert_eq!(found, nearest, "{k}");
        }
    }

    #[test]
    fn the_normals_of_the_knot_are_those_of_its_triangles() {
        for triangle in Mesh::knot(24).triangles {
            let flat = triangle.area().normalize();
            // The inner sides of bends have the largest triangles.
            assert!(triangle.normals.iter().all(|normal| normal.dot(flat) > 0.8));
        }
    }

    #[test]
    fn texts_that_are_no_mesh_are_refused() {
        for text in
            ["", "v 0 0 0\n", "f 1 2 3\n", "v 1 2 x\n", "v 0 0 0\nv 0 0 0\nv 0 0 0\nf 1 2 3\n"]
        {
            assert!(Mesh::from_obj(text).is_err(), "{text:?}");
        }
    }
}
