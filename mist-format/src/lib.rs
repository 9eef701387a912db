//! The text of MIST programs, expressions, tables and optical constants.
