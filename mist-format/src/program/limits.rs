//! Limits of reading.

/// The longest program text, in bytes.
pub const MAX_PROGRAM_BYTES: usize = 16 << 20;

/// The longest list of errors in one report; reading ends when it is full.
pub(super) const MAX_ERRORS: usize = 20;
