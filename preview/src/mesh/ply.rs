//! PLY: the Stanford Triangle Format, version 1.0, as text and in both byte orders (G. Turk, *The
//! PLY Polygon File Format*, 1994).
//!
//! Read are `x y z` and, if they are there, `nx ny nz` of the element `vertex`, and the list
//! `vertex_indices` or `vertex_index` of `face`. Polygons become fans of triangles. Everything else
//! is passed over.

use glam::{DVec3, dvec3};

use super::{MOST_TRIANGLES, Mesh, MeshError};

/// Corners of a polygon at most.
const MOST_CORNERS: usize = 1 << 16;

impl Mesh {
    /// The mesh in the bytes of a PLY file.
    ///
    /// # Errors
    ///
    /// If the bytes are no mesh.
    pub fn from_ply(bytes: &[u8]) -> Result<Self, MeshError> {
        let (header, body) = Header::read(bytes)?;
        let mut body = Body { bytes: body, form: header.form };
        let (mut points, mut normals, mut faces) = (Vec::new(), Vec::new(), Vec::new());
        for element in &header.elements {
            let find = |names: [&str; 3]| {
                names.map(|name| element.properties.iter().position(|p| p.name == name))
            };
            let place = find(["x", "y", "z"]);
            let normal = find(["nx", "ny", "nz"]);
            let corners = element.properties.iter().position(|property| {
                property.count.is_some()
                    && matches!(property.name.as_str(), "vertex_indices" | "vertex_index")
            });
            for _ in 0..element.count {
                let values = body.record(element)?;
                match element.name.as_str() {
                    "vertex" => {
                        let point = vector(&values, place);
                        points.push(point.ok_or_else(|| malformed("a vertex has no x, y, z"))?);
                        normals.extend(vector(&values, normal));
                    }
                    "face" => {
                        let corners = corners.map(|at| &values[at]);
                        let corners = corners.ok_or_else(|| malformed("a face has no list"))?;
                        fan(corners, &mut faces)?;
                    }
                    _ => {}
                }
            }
        }
        Self::new(&points, &faces, Some(&normals))
    }
}

fn malformed(problem: impl Into<String>) -> MeshError {
    MeshError::Malformed(problem.into())
}

/// Three single numbers of a record.
fn vector(values: &[Vec<f64>], at: [Option<usize>; 3]) -> Option<DVec3> {
    let number = |at: Option<usize>| values[at?].first().copied();
    Some(dvec3(number(at[0])?, number(at[1])?, number(at[2])?))
}

/// Triangles around the first corner.
fn fan(corners: &[f64], faces: &mut Vec<[usize; 3]>) -> Result<(), MeshError> {
    let index = |x: &f64| (*x >= 0.0 && x.fract() == 0.0).then_some(*x as usize);
    let corners: Option<Vec<usize>> = corners.iter().map(index).collect();
    let corners = corners.ok_or_else(|| malformed("a face names a point by no whole number"))?;
    for pair in corners.windows(2).skip(1) {
        faces.push([corners[0], pair[0], pair[1]]);
    }
    if faces.len() > MOST_TRIANGLES { Err(MeshError::Large(faces.len())) } else { Ok(()) }
}

#[derive(Clone, Copy)]
enum Form {
    Text,
    Little,
    Big,
}

#[derive(Clone, Copy)]
enum Kind {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    F32,
    F64,
}

impl Kind {
    fn of(word: &str) -> Option<Self> {
        Some(match word {
            "char" | "int8" => Self::I8,
            "uchar" | "uint8" => Self::U8,
            "short" | "int16" => Self::I16,
            "ushort" | "uint16" => Self::U16,
            "int" | "int32" => Self::I32,
            "uint" | "uint32" => Self::U32,
            "float" | "float32" => Self::F32,
            "double" | "float64" => Self::F64,
            _ => return None,
        })
    }

    fn size(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::I32 | Self::U32 | Self::F32 => 4,
            Self::F64 => 8,
        }
    }
}

struct Property {
    name: String,
    /// Type of the number of values, of a list.
    count: Option<Kind>,
    kind: Kind,
}

struct Element {
    name: String,
    count: usize,
    properties: Vec<Property>,
}

struct Header {
    form: Form,
    elements: Vec<Element>,
}

impl Header {
    /// The header, and what follows it.
    fn read(bytes: &[u8]) -> Result<(Self, &[u8]), MeshError> {
        let mut rest = bytes;
        let mut line = || {
            let end = rest.iter().position(|byte| *byte == b'\n');
            let end = end.ok_or_else(|| malformed("a PLY header ends with end_header"))?;
            let text = String::from_utf8_lossy(&rest[..end]).trim().to_owned();
            rest = &rest[end + 1..];
            Ok::<String, MeshError>(text)
        };
        if line()? != "ply" {
            return Err(malformed("a PLY file begins with ply"));
        }
        let (mut form, mut elements) = (None, Vec::<Element>::new());
        loop {
            let text = line()?;
            let unknown = || malformed(format!("{text:?} is no line of a PLY header"));
            let words: Vec<&str> = text.split_whitespace().collect();
            match words[..] {
                ["end_header"] => break,
                [] | ["comment" | "obj_info", ..] => {}
                ["format", "ascii", _] => form = Some(Form::Text),
                ["format", "binary_little_endian", _] => form = Some(Form::Little),
                ["format", "binary_big_endian", _] => form = Some(Form::Big),
                ["element", name, count] => {
                    let count = count.parse().map_err(|_| unknown())?;
                    elements.push(Element { name: name.into(), count, properties: Vec::new() });
                }
                ["property", ref kinds @ .., name] => {
                    let (count, kind) = match kinds {
                        ["list", count, kind] => {
                            (Some(Kind::of(count).ok_or_else(unknown)?), Kind::of(kind))
                        }
                        [kind] => (None, Kind::of(kind)),
                        _ => return Err(unknown()),
                    };
                    let kind = kind.ok_or_else(unknown)?;
                    let element = elements.last_mut().ok_or_else(unknown)?;
                    element.properties.push(Property { name: name.into(), count, kind });
                }
                _ => return Err(unknown()),
            }
        }
        let form = form.ok_or_else(|| malformed("a PLY header has a line format"))?;
        // Records without bytes could be promised without end.
        elements.retain(|element| !element.properties.is_empty());
        Ok((Self { form, elements }, rest))
    }
}

struct Body<'a> {
    bytes: &'a [u8],
    form: Form,
}

impl Body<'_> {
    /// The values of the properties of a record.
    fn record(&mut self, element: &Element) -> Result<Vec<Vec<f64>>, MeshError> {
        let values = element.properties.iter().map(|property| {
            let count = match property.count {
                None => 1,
                Some(kind) => self.number(kind)? as usize,
            };
            if count > MOST_CORNERS {
                return Err(malformed(format!("a list has {count} values")));
            }
            (0..count).map(|_| self.number(property.kind)).collect()
        });
        values.collect()
    }

    fn number(&mut self, kind: Kind) -> Result<f64, MeshError> {
        let cut = || malformed("the file is cut off");
        if matches!(self.form, Form::Text) {
            self.bytes = self.bytes.trim_ascii_start();
            let end = self.bytes.iter().position(u8::is_ascii_whitespace);
            let (word, rest) = self.bytes.split_at(end.unwrap_or(self.bytes.len()));
            self.bytes = rest;
            let word = std::str::from_utf8(word).map_err(|_| cut())?;
            return word.parse().map_err(|_| match word {
                "" => cut(),
                _ => malformed(format!("{word:?} is no number")),
            });
        }
        let (own, rest) = self.bytes.split_at_checked(kind.size()).ok_or_else(cut)?;
        self.bytes = rest;
        let mut bytes = [0; 8];
        let bytes = &mut bytes[..own.len()];
        bytes.copy_from_slice(own);
        if matches!(self.form, Form::Big) {
            bytes.reverse();
        }
        Ok(match (kind, &*bytes) {
            (Kind::I8, [a]) => f64::from(a.cast_signed()),
            (Kind::U8, [a]) => f64::from(*a),
            (Kind::I16, [a, b]) => f64::from(i16::from_le_bytes([*a, *b])),
            (Kind::U16, [a, b]) => f64::from(u16::from_le_bytes([*a, *b])),
            (Kind::I32, [a, b, c, d]) => f64::from(i32::from_le_bytes([*a, *b, *c, *d])),
            (Kind::U32, [a, b, c, d]) => f64::from(u32::from_le_bytes([*a, *b, *c, *d])),
            (Kind::F32, [a, b, c, d]) => f64::from(f32::from_le_bytes([*a, *b, *c, *d])),
            (_, all) => f64::from_le_bytes(all.try_into().map_err(|_| cut())?),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ray::Ray;

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
            let down = |x, y| Ray { from: dvec3(x, y, 10.0), along: -DVec3::Z };
            let hit = mesh.hit(down(0.5, -0.5)).unwrap();
            assert!((hit.normal - DVec3::Z).length() < 1e-12);
            assert!(mesh.hit(down(-0.5, 0.5)).is_some() && mesh.hit(down(0.8, 0.0)).is_none());
        }
    }

    #[test]
    fn a_file_that_is_cut_off_or_wrong_is_refused() {
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
