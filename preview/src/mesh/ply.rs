//! PLY, the Stanford Triangle Format 1.0, as text and in both byte orders, by the crate `ply-rs-bw`.
//!
//! Read are `x y z` and `nx ny nz` of the element `vertex`, and the list `vertex_indices` or
//! `vertex_index` of `face`. Polygons become fans of triangles. Other elements and properties are
//! ignored.

use glam::{DVec3, dvec3};
use ply_rs_bw::{
    parser::{ParseError, Parser, Reader},
    ply::{Property, PropertyAccess, PropertyAccessResult},
};

use super::{MOST_TRIANGLES, Mesh, MeshError};

impl Mesh {
    /// The mesh in the bytes of a PLY file.
    ///
    /// # Errors
    ///
    /// If the bytes are not a mesh; the error names the line of a text.
    pub fn from_ply(bytes: &[u8]) -> Result<Self, MeshError> {
        let mut reader = Reader::new(bytes);
        let header = Parser::<Ignored>::new().read_header(&mut reader).map_err(malformed)?;
        let (mut points, mut normals, mut faces) = (Vec::new(), Vec::new(), Vec::new());
        // An element without properties has no data, however many of it the header states.
        for element in header.elements.values().filter(|element| !element.properties.is_empty()) {
            match element.name.as_str() {
                "vertex" => {
                    let parser = Parser::<PlyVertex>::new();
                    let read = parser.read_payload_for_element(&mut reader, element, &header);
                    for vertex in read.map_err(malformed)? {
                        let point = vector(vertex.point);
                        points.push(point.ok_or_else(|| invalid("a vertex has no x, y, z"))?);
                        normals.extend(vector(vertex.normal));
                    }
                }
                "face" => {
                    let parser = Parser::<PlyFace>::new();
                    let read = parser.read_payload_for_element(&mut reader, element, &header);
                    for face in read.map_err(malformed)? {
                        let corners = face.corners.ok_or_else(|| invalid("a face has no list"))?;
                        add_fan(&corners, &mut faces)?;
                    }
                }
                _ => {
                    let parser = Parser::<Ignored>::new();
                    let read = parser.read_payload_for_element(&mut reader, element, &header);
                    read.map_err(malformed)?;
                }
            }
        }
        Self::new(&points, &faces, Some(&normals))
    }
}

/// The error of the parser in one line.
fn malformed(error: ParseError) -> MeshError {
    let text = error.to_string();
    MeshError::Malformed(text.split_whitespace().collect::<Vec<_>>().join(" "))
}

fn invalid(problem: &str) -> MeshError {
    MeshError::Malformed(problem.into())
}

fn vector([x, y, z]: [Option<f64>; 3]) -> Option<DVec3> {
    Some(dvec3(x?, y?, z?))
}

/// Adds triangles around the first corner of a polygon.
fn add_fan(corners: &[i64], faces: &mut Vec<[usize; 3]>) -> Result<(), MeshError> {
    let index = |corner: &i64| usize::try_from(*corner).ok();
    let corners: Option<Vec<usize>> = corners.iter().map(index).collect();
    let corners = corners.ok_or_else(|| invalid("a face names a point with a negative number"))?;
    for pair in corners.windows(2).skip(1) {
        faces.push([corners[0], pair[0], pair[1]]);
    }
    if faces.len() > MOST_TRIANGLES { Err(MeshError::Large(faces.len())) } else { Ok(()) }
}

/// A point with its normal, if the file has them.
#[derive(Default)]
struct PlyVertex {
    point: [Option<f64>; 3],
    normal: [Option<f64>; 3],
}

impl PlyVertex {
    fn set(&mut self, name: &str, value: f64) -> PropertyAccessResult {
        let place = match name {
            "x" => &mut self.point[0],
            "y" => &mut self.point[1],
            "z" => &mut self.point[2],
            "nx" => &mut self.normal[0],
            "ny" => &mut self.normal[1],
            "nz" => &mut self.normal[2],
            _ => return PropertyAccessResult::Ignored,
        };
        *place = Some(value);
        PropertyAccessResult::Set
    }
}

impl PropertyAccess for PlyVertex {
    fn new() -> Self {
        Self::default()
    }

    fn set_property(&mut self, name: &str, value: Property) -> PropertyAccessResult {
        let number = match value {
            Property::Double(x) => Some(x),
            Property::Int(x) => Some(x.into()),
            Property::UInt(x) => Some(x.into()),
            // Exact for the other types, which are narrower; none for lists.
            narrow => narrow.to_f32_lossy().map(f64::from),
        };
        number.map_or(PropertyAccessResult::Ignored, |number| self.set(name, number))
    }

    fn set_float(&mut self, name: &str, value: f32) -> PropertyAccessResult {
        self.set(name, value.into())
    }

    fn set_double(&mut self, name: &str, value: f64) -> PropertyAccessResult {
        self.set(name, value)
    }
}

/// The corners of a polygon, if the file has them.
#[derive(Default)]
struct PlyFace {
    corners: Option<Vec<i64>>,
}

impl PropertyAccess for PlyFace {
    fn new() -> Self {
        Self::default()
    }

    fn set_property(&mut self, name: &str, value: Property) -> PropertyAccessResult {
        fn wide<T: Into<i64>>(list: Vec<T>) -> Vec<i64> {
            list.into_iter().map(T::into).collect()
        }
        if !matches!(name, "vertex_indices" | "vertex_index") {
            return PropertyAccessResult::Ignored;
        }
        self.corners = Some(match value {
            Property::ListChar(list) => wide(list),
            Property::ListUChar(list) => wide(list),
            Property::ListShort(list) => wide(list),
            Property::ListUShort(list) => wide(list),
            Property::ListInt(list) => wide(list),
            Property::ListUInt(list) => wide(list),
            _ => return PropertyAccessResult::UnsupportedType,
        });
        PropertyAccessResult::Set
    }
}

/// An element whose properties are ignored.
struct Ignored;

impl PropertyAccess for Ignored {
    fn new() -> Self {
        Self
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ray::SceneRay;

    const SQUARE: &str = "ply\nformat ascii 1.0\ncomment a square\nelement vertex 4\n\
        property float x\nproperty float y\nproperty float z\nelement face 1\n\
        property list uchar int vertex_indices\nend_header\n\
        0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n";

    fn binary(big: bool) -> Vec<u8> {
        let name = if big { "binary_big_endian" } else { "binary_little_endian" };
        let end = SQUARE.find("0 0 0\n").unwrap();
        let mut bytes = SQUARE[..end].replace("ascii", name).into_bytes();
        let order = |mut own: [u8; 4]| {
            if big {
                own.reverse();
            }
            own
        };
        for x in [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 1.0, 0.0_f32] {
            bytes.extend(order(x.to_le_bytes()));
        }
        bytes.push(4);
        (0..4_i32).for_each(|index| bytes.extend(order(index.to_le_bytes())));
        bytes
    }

    #[test]
    fn a_square_is_the_same_as_text_and_in_both_byte_orders() {
        for bytes in [SQUARE.as_bytes().to_vec(), binary(false), binary(true)] {
            let mesh = Mesh::from_ply(&bytes).unwrap();
            let down = |x, y| SceneRay { from: dvec3(x, y, 10.0), along: -DVec3::Z };
            let hit = mesh.hit(down(0.5, -0.5)).unwrap();
            assert!((hit.normal - DVec3::Z).length() < 1e-12);
            assert!(mesh.hit(down(-0.5, 0.5)).is_some() && mesh.hit(down(0.8, 0.0)).is_none());
        }
    }

    #[test]
    fn other_elements_types_and_line_ends_are_read() {
        let edges = SQUARE.replace("element face", "element edge 1\nproperty int a\nelement face");
        let edges = edges.replace("4 0 1", "9\n4 0 1");
        let empty = SQUARE.replace("element face", "element none 99999999999\nelement face");
        let lines = SQUARE.replace('\n', "\r\n");
        let types = SQUARE.replace("float", "float64").replace("uchar int", "uint8 uint16");
        for text in [edges, empty, lines, types] {
            assert!(Mesh::from_ply(text.as_bytes()).is_ok(), "{text}");
        }
    }

    #[test]
    fn the_line_of_an_error_is_named() {
        let wrong = SQUARE.replace("1 1 0", "1 1 x");
        let error = Mesh::from_ply(wrong.as_bytes()).unwrap_err().to_string();
        assert!(error.contains("Line 13") && !error.contains('\n'), "{error}");
    }

    #[test]
    fn a_truncated_or_invalid_file_is_refused() {
        for bytes in [SQUARE.as_bytes().to_vec(), binary(false)] {
            for length in 0..bytes.len() - 2 {
                assert!(Mesh::from_ply(&bytes[..length]).is_err(), "{length}");
            }
        }
        for (old, new) in [
            ("0 1 2 3\n", "0 1 2 7\n"),
            ("0 1 2 3\n", "0 1 2 -3\n"),
            ("vertex 4", "vertex x"),
            ("float y", "quad y"),
            ("float y", "float t"),
            ("format ascii 1.0", "comment"),
            ("vertex 4", "vertex 99999999999999"),
        ] {
            assert!(Mesh::from_ply(SQUARE.replace(old, new).as_bytes()).is_err(), "{new}");
        }
    }
}
