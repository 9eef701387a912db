//! Writes a tensor file, field by field.

use std::io::{self, Write};

use super::{
    field::TensorField,
    format::{MAGIC, VERSION},
};

/// Writes a tensor file, the data of one field after the other.
#[derive(Debug)]
pub struct TensorWriter<W: Write> {
    out: W,
    fields: Vec<TensorField>,
    position: u64,
    /// Index of the field whose data are next.
    next: usize,
}

impl<W: Write> TensorWriter<W> {
    /// Writes the header of a file with `fields`.
    ///
    /// # Errors
    ///
    /// If `out` does not take it.
    pub fn begin(mut out: W, mut fields: Vec<TensorField>) -> io::Result<Self> {
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
    /// If the field is too small for them.
    pub fn bytes(&mut self, data: &[u8]) -> io::Result<()> {
        let full = |f: &TensorField, at: u64| {
            at >= f.offset && f.bytes().is_some_and(|n| at >= f.offset + n)
        };
        while self.fields.get(self.next).is_some_and(|field| full(field, self.position)) {
            self.next += 1;
        }
        let field = self.fields.get(self.next).expect("a field is left to write");
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
    /// As [`TensorWriter::bytes`].
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

fn head_bytes(field: &TensorField) -> u64 {
    (2 + field.name.len() + 2 + 1 + 8 + 8 * field.shape.len()) as u64
}
