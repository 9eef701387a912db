//! Constants of the format.

/// The first bytes of a file.
pub(super) const MAGIC: &[u8; 12] = b"tensor_file\0";
/// Major and minor version.
pub(super) const VERSION: [u8; 2] = [1, 0];
