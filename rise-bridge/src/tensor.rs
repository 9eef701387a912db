//! The container `tensor_file` of Mitsuba and the RGL: named arrays of numbers.
//!
//! Little endian, neither compressed nor protected by a checksum: `tensor_file\0`, version 1.0,
//! the number of fields; per field its name, shape, kind of number and offset; the data in C
//! order, each field at a multiple of eight bytes.
//!
//! [`Writer`] takes the data in the order of the fields, piece by piece, so a table need never be
//! whole in memory; [`Reader`] reads pieces.

use std::io::{self, Read, Seek, SeekFrom, Write};

const MAGIC: &[u8; 12] = b"tensor_file\0";
const VERSION: [u8; 2] = [1, 0];
/// Fields, dimensions and bytes of a name: more is no table but noise.
const MOST: (u32, u16, u16) = (1024, 16, 1024);

/// What the numbers of a field are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Bytes: texts and switches.
    U8,
    /// Whole numbers to 65535.
    U16,
    /// 32-bit floating point.
    F32,
    /// 64-bit floating point.
    F64,
    /// Another kind of the format, by its number; we neither write nor read its data.
    Other(u8),
}

impl Kind {
    fn number(self) -> u8 {
        match self {
            Self::U8 => 1,
            Self::U16 => 3,
            Self::F32 => 10,
            Self::F64 => 11,
            Self::Other(number) => number,
        }
    }

    fn of_number(number: u8) -> Self {
        let known = [Self::U8, Self::U16, Self::F32, Self::F64];
        known.into_iter().find(|kind| kind.number() == number).unwrap_or(Self::Other(number))
    }

    /// Bytes of one number.
    fn bytes(self) -> u64 {
        match self.number() {
            1 | 2 => 1,
            3 | 4 | 9 => 2,
            5 | 6 | 10 => 4,
            _ => 8,
        }
    }
}

/// A named array.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Field {
    /// Its name.
    pub name: String,
    /// What its numbers are.
    pub kind: Kind,
    /// Its length along every axis, the last one fastest.
    pub shape: Vec<u64>,
    /// Where its data begin in the file; a [`Writer`] sets it.
    pub offset: u64,
}

impl Field {
    /// An array that is going to be written.
    pub fn new(name: &str, kind: Kind, shape: &[usize]) -> Self {
        let shape = shape.iter().map(|n| *n as u64).collect();
        Self { name: name.to_owned(), kind, shape, offset: 0 }
    }

    /// How many numbers it has; nothing if there are more than can be counted.
    pub fn len(&self) -> Option<u64> {
        self.shape.iter().try_fold(1_u64, |product, n| product.checked_mul(*n))
    }

    /// Whether it has no numbers.
    pub fn is_empty(&self) -> bool {
        self.shape.contains(&0)
    }

    fn bytes(&self) -> Option<u64> {
        self.len()?.checked_mul(self.kind.bytes())
    }
}

/// Why a file is not a tensor file or lacks what is wanted.
#[derive(Debug, thiserror::Error)]
pub enum TensorError {
    /// It begins with other bytes.
    #[error("this is no tensor file: it does not begin with \"tensor_file\"")]
    NotATensor,
    /// It is of another version.
    #[error("tensor file of version {0}.{1}; expected 1.0")]
    Version(u8, u8),
    /// Its header makes no sense, or the file ends before its data.
    #[error("the tensor file is damaged or cut off: {0}")]
    Damaged(String),
    /// A field is missing or has another shape or kind.
    #[error("field {name}: {problem}")]
    Field {
        /// Its name.
        name: String,
        /// What is wrong and what is expected.
        problem: String,
    },
    /// It cannot be read or written.
    #[error(transparent)]
    Io(#[from] io::Error),
}

impl TensorError {
    /// A field that is not as it should be.
    pub fn field(name: &str, problem: impl Into<String>) -> Self {
        Self::Field { name: name.to_owned(), problem: problem.into() }
    }
}

/// Writes a tensor file, the data of one field after the other.
#[derive(Debug)]
pub struct Writer<W: Write> {
    out: W,
    fields: Vec<Field>,
    position: u64,
    /// The field whose data are next.
    next: usize,
}

impl<W: Write> Writer<W> {
    /// Writes the header of a file with `fields`.
    ///
    /// # Errors
    ///
    /// If `out` does not take it.
    pub fn begin(mut out: W, mut fields: Vec<Field>) -> io::Result<Self> {
        let head = 18 + fields.iter().map(head_bytes).sum::<u64>();
        let mut end = head;
        for field in &mut fields {
            field.offset = end.next_multiple_of(8);
            let too_large =
                || io::Error::new(io::ErrorKind::FileTooLarge, "the table is too large");
            end = field.bytes().and_then(|n| n.checked_add(field.offset)).ok_or_else(too_large)?;
        }
        let mut header = Vec::new();
        header.extend(MAGIC);
        header.extend(VERSION);
        header.extend((fields.len() as u32).to_le_bytes());
        for field in &fields {
            header.extend((field.name.len() as u16).to_le_bytes());
            header.extend(field.name.as_bytes());
            header.extend((field.shape.len() as u16).to_le_bytes());
            header.push(field.kind.number());
            header.extend(field.offset.to_le_bytes());
            field.shape.iter().for_each(|n| header.extend(n.to_le_bytes()));
        }
        out.write_all(&header)?;
        Ok(Self { out, fields, position: head, next: 0 })
    }

    /// Appends numbers of the field that is being written, as bytes.
    ///
    /// # Errors
    ///
    /// If `out` does not take them.
    ///
    /// # Panics
    ///
    /// If there is no room for them in the field.
    pub fn bytes(&mut self, data: &[u8]) -> io::Result<()> {
        let full =
            |f: &Field, at: u64| at >= f.offset && f.bytes().is_some_and(|n| at >= f.offset + n);
        while self.fields.get(self.next).is_some_and(|field| full(field, self.position)) {
            self.next += 1;
        }
        let field = self.fields.get(self.next).expect("every field is full");
        let pad = field.offset.saturating_sub(self.position);
        self.out.write_all(&[0; 8][..pad as usize])?;
        self.position += pad + data.len() as u64;
        let end = field.offset + field.bytes().unwrap_or_default();
        assert!(self.position <= end, "field {} has no room", field.name);
        self.out.write_all(data)
    }

    /// Appends 32-bit numbers.
    ///
    /// # Errors
    ///
    /// As [`Writer::bytes`].
    pub fn f32s(&mut self, data: impl IntoIterator<Item = f32>) -> io::Result<()> {
        let bytes: Vec<u8> = data.into_iter().flat_map(f32::to_le_bytes).collect();
        self.bytes(&bytes)
    }

    /// Ends the file.
    ///
    /// # Errors
    ///
    /// If `out` does not take the rest, or data are missing.
    pub fn finish(mut self) -> io::Result<W> {
        let end = self.fields.last().map_or(self.position, |f| f.offset + f.bytes().unwrap_or(0));
        if self.position != end {
            let problem = format!("{} of {end} bytes were written", self.position);
            return Err(io::Error::new(io::ErrorKind::UnexpectedEof, problem));
        }
        self.out.flush()?;
        Ok(self.out)
    }
}

fn head_bytes(field: &Field) -> u64 {
    (2 + field.name.len() + 2 + 1 + 8 + 8 * field.shape.len()) as u64
}

/// A tensor file whose header was read and found sound.
#[derive(Debug)]
pub struct Reader<R> {
    source: R,
    fields: Vec<Field>,
}

impl<R: Read + Seek> Reader<R> {
    /// Reads the header.
    ///
    /// # Errors
    ///
    /// For everything that is not a tensor file with all its data.
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
        if count > MOST.0 {
            return Err(damaged(format!("it claims {count} fields")));
        }
        let mut fields = Vec::new();
        for number in 1..=count {
            let field =
                field(&mut source).map_err(|what| damaged(format!("field {number}: {what}")))?;
            let end = field.bytes().and_then(|n| field.offset.checked_add(n));
            if end.is_none_or(|end| end > size) {
                let name = &field.name;
                return Err(damaged(format!("field {name} ends behind the end of the file")));
            }
            fields.push(field);
        }
        Ok(Self { source, fields })
    }

    /// The fields in the order of the header.
    pub fn fields(&self) -> &[Field] {
        &self.fields
    }

    /// The field called `name`.
    ///
    /// # Errors
    ///
    /// If there is none.
    pub fn field(&self, name: &str) -> Result<&Field, TensorError> {
        let found = self.fields.iter().find(|field| field.name == name);
        found.ok_or_else(|| TensorError::field(name, "the file does not have it"))
    }

    /// All numbers of the field `name`; for small fields.
    ///
    /// # Errors
    ///
    /// If there is no such field, its kind is none of u8, u16, f32 and f64, or it cannot be read.
    pub fn numbers(&mut self, name: &str) -> Result<Vec<f64>, TensorError> {
        let len = self.field(name)?.len().unwrap_or_default();
        let (kind, bytes) = self.piece(name, 0, len)?;
        let wide = |k: usize| bytes.chunks_exact(k);
        Ok(match kind {
            Kind::U8 => bytes.iter().map(|x| f64::from(*x)).collect(),
            Kind::U16 => wide(2).map(|b| f64::from(u16::from_le_bytes([b[0], b[1]]))).collect(),
            Kind::F32 => wide(4).map(|b| f64::from(le_f32(b))).collect(),
            Kind::F64 => {
                wide(8).map(|b| f64::from_le_bytes(b.try_into().expect("eight bytes"))).collect()
            }
            Kind::Other(number) => {
                let problem = format!("numbers of kind {number} are not read");
                return Err(TensorError::field(name, problem));
            }
        })
    }

    /// `count` 32-bit numbers of the field `name` from the one at `first`.
    ///
    /// # Errors
    ///
    /// If there is no such field, it has numbers of another kind or fewer, or cannot be read.
    pub fn f32s(&mut self, name: &str, first: u64, count: u64) -> Result<Vec<f32>, TensorError> {
        let (kind, bytes) = self.piece(name, first, count)?;
        if kind != Kind::F32 {
            return Err(TensorError::field(name, "expected 32-bit floating point numbers"));
        }
        Ok(bytes.chunks_exact(4).map(le_f32).collect())
    }

    fn piece(
        &mut self,
        name: &str,
        first: u64,
        count: u64,
    ) -> Result<(Kind, Vec<u8>), TensorError> {
        let field = self.field(name)?;
        let (kind, width) = (field.kind, field.kind.bytes());
        let inside = first.checked_add(count).is_some_and(|end| Some(end) <= field.len());
        if !inside {
            return Err(TensorError::field(name, "it has fewer numbers than are asked for"));
        }
        let offset = field.offset;
        self.source.seek(SeekFrom::Start(offset + first * width))?;
        // It is inside the file, as `open` has checked.
        let mut bytes = vec![0; (count * width) as usize];
        self.source.read_exact(&mut bytes)?;
        Ok((kind, bytes))
    }
}

fn le_f32(bytes: &[u8]) -> f32 {
    f32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]])
}

/// Reads the description of one field.
fn field(source: &mut impl Read) -> Result<Field, String> {
    let name_len = u16::from_le_bytes(take(source)?);
    if name_len > MOST.2 {
        return Err(format!("a name of {name_len} bytes"));
    }
    let mut name = vec![0; usize::from(name_len)];
    source.read_exact(&mut name).map_err(|error| error.to_string())?;
    let name = String::from_utf8(name).map_err(|_| "a name that is no UTF-8".to_owned())?;
    let dimensions = u16::from_le_bytes(take(source)?);
    if dimensions > MOST.1 {
        return Err(format!("{dimensions} dimensions"));
    }
    let [kind] = take(source)?;
    let offset = u64::from_le_bytes(take(source)?);
    let shape: Result<Vec<u64>, String> =
        (0..dimensions).map(|_| Ok(u64::from_le_bytes(take(source)?))).collect();
    Ok(Field { name, kind: Kind::of_number(kind), shape: shape?, offset })
}

fn take<const N: usize>(source: &mut impl Read) -> Result<[u8; N], String> {
    let mut bytes = [0; N];
    source.read_exact(&mut bytes).map_err(|error| error.to_string())?;
    Ok(bytes)
}

#[cfg(test)]
mod tests {
    use std::io::Cursor;

    use super::*;

    fn example() -> Vec<u8> {
        let fields = vec![
            Field::new("note", Kind::U8, &[5]),
            Field::new("wvls", Kind::U16, &[2]),
            Field::new("M", Kind::F32, &[2, 3]),
        ];
        let mut writer = Writer::begin(Vec::new(), fields).unwrap();
        writer.bytes(b"hello").unwrap();
        writer.bytes(&[194, 1, 38, 2]).unwrap();
        writer.f32s([1.0, 2.0, 3.0]).unwrap();
        writer.f32s([4.0, 5.0, 6.5]).unwrap();
        writer.finish().unwrap()
    }

    #[test]
    fn what_was_written_is_read_whole_and_in_pieces() {
        let mut file = Reader::open(Cursor::new(example())).unwrap();
        assert_eq!(file.numbers("wvls").unwrap(), [450.0, 550.0]);
        assert_eq!(file.numbers("M").unwrap(), [1.0, 2.0, 3.0, 4.0, 5.0, 6.5]);
        assert_eq!(file.f32s("M", 2, 2).unwrap(), [3.0, 4.0]);
        assert_eq!(file.field("M").unwrap().shape, [2, 3]);
        assert!(file.fields().iter().all(|field| field.offset % 8 == 0));
        assert!(file.f32s("M", 5, 2).is_err());
        assert!(file.numbers("N").is_err());
    }

    #[test]
    fn every_cut_is_found() {
        let whole = example();
        for len in 0..whole.len() {
            assert!(Reader::open(Cursor::new(&whole[..len])).is_err(), "{len} bytes");
        }
    }

    #[test]
    fn absurd_headers_are_refused_without_taking_memory() {
        let mut many = example();
        many[14..18].copy_from_slice(&u32::MAX.to_le_bytes());
        assert!(matches!(Reader::open(Cursor::new(many)), Err(TensorError::Damaged(_))));
        let mut wide = example();
        // The shape of the first field.
        let at = 18 + 2 + 4 + 2 + 1 + 8;
        wide[at..at + 8].copy_from_slice(&u64::MAX.to_le_bytes());
        assert!(matches!(Reader::open(Cursor::new(wide)), Err(TensorError::Damaged(_))));
        assert!(matches!(Reader::open(Cursor::new(b"RIFF")), Err(TensorError::NotATensor)));
    }

    #[test]
    fn a_file_without_all_its_data_is_not_finished() {
        let fields = vec![Field::new("M", Kind::F32, &[2])];
        let mut writer = Writer::begin(Vec::new(), fields).unwrap();
        writer.f32s([1.0]).unwrap();
        assert!(writer.finish().is_err());
    }
}
