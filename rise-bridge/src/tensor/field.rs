//! The fields of a tensor file: name, number type, shape and position.

/// The type of the numbers of a field.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NumberType {
    /// Bytes: texts and switches.
    U8,
    /// Whole numbers to 65535.
    U16,
    /// 32-bit floating point.
    F32,
    /// 64-bit floating point.
    F64,
    /// Another type of the format, by its number; its data are neither read nor written.
    Other(u8),
}

impl NumberType {
    pub(super) fn number(self) -> u8 {
        match self {
            Self::U8 => 1,
            Self::U16 => 3,
            Self::F32 => 10,
            Self::F64 => 11,
            Self::Other(number) => number,
        }
    }

    pub(super) fn of_number(number: u8) -> Self {
        let known = [Self::U8, Self::U16, Self::F32, Self::F64];
        known.into_iter().find(|kind| kind.number() == number).unwrap_or(Self::Other(number))
    }

    /// Bytes of one number.
    pub(super) fn bytes(self) -> u64 {
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
pub struct TensorField {
    /// Its name.
    pub name: String,
    /// The type of its numbers.
    pub kind: NumberType,
    /// Its length along every axis, the last one fastest.
    pub shape: Vec<u64>,
    /// Start of its data in the file; set by [`TensorWriter`](super::TensorWriter).
    pub offset: u64,
}

impl TensorField {
    /// A field to be written.
    pub fn new(name: &str, kind: NumberType, shape: &[usize]) -> Self {
        let shape = shape.iter().map(|n| *n as u64).collect();
        Self { name: name.to_owned(), kind, shape, offset: 0 }
    }

    /// The number of its numbers; none beyond the range of u64.
    pub fn len(&self) -> Option<u64> {
        self.shape.iter().try_fold(1_u64, |product, n| product.checked_mul(*n))
    }

    /// True if it has no numbers.
    pub fn is_empty(&self) -> bool {
        self.shape.contains(&0)
    }

    /// The size of its data; none beyond the range of u64.
    pub(super) fn bytes(&self) -> Option<u64> {
        self.len()?.checked_mul(self.kind.bytes())
    }
}
