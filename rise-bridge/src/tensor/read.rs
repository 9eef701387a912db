//! Reads a tensor file: the header at once, the data in parts.

use std::io::{Read, Seek, SeekFrom};

use super::{
    error::TensorError,
    field::{NumberType, TensorField},
    format::{MAGIC, VERSION},
};

/// Limits of a header; more is an invalid file.
const MAX_FIELDS: u32 = 1024;
const MAX_DIMENSIONS: u16 = 16;
const MAX_NAME_BYTES: u16 = 1024;

/// A tensor file with a checked header.
#[derive(Debug)]
pub struct TensorReader<R> {
    source: R,
    fields: Vec<TensorField>,
}

impl<R: Read + Seek> TensorReader<R> {
    /// Reads the header.
    ///
    /// # Errors
    ///
    /// If the source is not a complete tensor file.
    pub fn open(mut source: R) -> Result<Self, TensorError> {
        let size = source.seek(SeekFrom::End(0))?;
        source.rewind()?;
        let mut head = [0; 18];
        let long_enough = source.read_exact(&mut head).is_ok();
        if !long_enough || &head[..12] != MAGIC {
            return Err(TensorError::NotATensor);
        }
        if head[12] != VERSION[0] {
            return Err(TensorError::Version(head[12], head[13]));
        }
        let count = u32::from_le_bytes(head[14..].try_into().expect("four bytes"));
        let damaged = |what: String| TensorError::Damaged(what);
        if count > MAX_FIELDS {
            return Err(damaged(format!("it claims {count} fields")));
        }
        let mut fields = Vec::new();
        for number in 1..=count {
            let field =
                field(&mut source).map_err(|what| damaged(format!("field {number}: {what}")))?;
            let end = field.bytes().and_then(|n| field.offset.checked_add(n));
            if end.is_none_or(|end| end > size) {
                let name = &field.name;
                return Err(damaged(format!("field {name} ends after the end of the file")));
            }
            fields.push(field);
        }
        Ok(Self { source, fields })
    }

    /// The fields in the order of the header.
    pub fn fields(&self) -> &[TensorField] {
        &self.fields
    }

    /// The field called `name`.
    ///
    /// # Errors
    ///
    /// If there is none.
    pub fn field(&self, name: &str) -> Result<&TensorField, TensorError> {
        let found = self.fields.iter().find(|field| field.name == name);
        found.ok_or_else(|| TensorError::field(name, "the file does not have it"))
    }

    /// All numbers of the field `name`; for small fields.
    ///
    /// # Errors
    ///
    /// If there is no such field, its type is not u8, u16, f32 or f64, or it cannot be read.
    pub fn numbers(&mut self, name: &str) -> Result<Vec<f64>, TensorError> {
        let len = self.field(name)?.len().unwrap_or_default();
        let (kind, bytes) = self.piece(name, 0, len)?;
        let wide = |k: usize| bytes.chunks_exact(k);
        Ok(match kind {
            NumberType::U8 => bytes.iter().map(|x| f64::from(*x)).collect(),
            NumberType::U16 => {
                wide(2).map(|b| f64::from(u16::from_le_bytes([b[0], b[1]]))).collect()
            }
            NumberType::F32 => wide(4).map(|b| f64::from(le_f32(b))).collect(),
            NumberType::F64 => {
                wide(8).map(|b| f64::from_le_bytes(b.try_into().expect("eight bytes"))).collect()
            }
            NumberType::Other(number) => {
                let problem = format!("numbers of type {number} are not supported");
                return Err(TensorError::field(name, problem));
            }
        })
    }

    /// `count` 32-bit numbers of the field `name` from the one at `first`.
    ///
    /// # Errors
    ///
    /// If there is no such field, its type is not f32, it has fewer numbers, or it cannot be read.
    pub fn f32s(&mut self, name: &str, first: u64, count: u64) -> Result<Vec<f32>, TensorError> {
        let (kind, bytes) = self.piece(name, first, count)?;
        if kind != NumberType::F32 {
            return Err(TensorError::field(name, "expected 32-bit floating point numbers"));
        }
        Ok(bytes.chunks_exact(4).map(le_f32).collect())
    }

    fn piece(
        &mut self,
        name: &str,
        first: u64,
        count: u64,
    ) -> Result<(NumberType, Vec<u8>), TensorError> {
        let field = self.field(name)?;
        let (kind, width) = (field.kind, field.kind.bytes());
        let inside = first.checked_add(count).is_some_and(|end| Some(end) <= field.len());
        if !inside {
            return Err(TensorError::field(name, "it has fewer numbers than requested"));
        }
        let offset = field.offset;
        self.source.seek(SeekFrom::Start(offset + first * width))?;
        // `open` has checked that the data are inside the file.
        let mut bytes = vec![0; (count * width) as usize];
        self.source.read_exact(&mut bytes)?;
        Ok((kind, bytes))
    }
}

fn le_f32(bytes: &[u8]) -> f32 {
    f32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]])
}

/// Reads the description of one field.
fn field(source: &mut impl Read) -> Result<TensorField, String> {
    let name_len = u16::from_le_bytes(take(source)?);
    if name_len > MAX_NAME_BYTES {
        return Err(format!("a name of {name_len} bytes"));
    }
    let mut name = vec![0; usize::from(name_len)];
    source.read_exact(&mut name).map_err(|error| error.to_string())?;
    let name = String::from_utf8(name).map_err(|_| "a name that is not UTF-8".to_owned())?;
    let dimensions = u16::from_le_bytes(take(source)?);
    if dimensions > MAX_DIMENSIONS {
        return Err(format!("{dimensions} dimensions"));
    }
    let [kind] = take(source)?;
    let offset = u64::from_le_bytes(take(source)?);
    let shape: Result<Vec<u64>, String> =
        (0..dimensions).map(|_| Ok(u64::from_le_bytes(take(source)?))).collect();
    Ok(TensorField { name, kind: NumberType::of_number(kind), shape: shape?, offset })
}

fn take<const N: usize>(source: &mut impl Read) -> Result<[u8; N], String> {
    let mut bytes = [0; N];
    source.read_exact(&mut bytes).map_err(|error| error.to_string())?;
    Ok(bytes)
}
