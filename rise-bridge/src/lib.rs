//! Colour tables in the formats that renderers read, and back.
//!
//! [`mod@write`] turns a [`ColourTable`](mist_engine::colour::ColourTable) into text: the table
//! `.mtab`, its spectra `.mspd`, their JSON twin and a picture. [`read`] brings `.mtab` and
//! `.mspd` back and finds every truncation. The text format is described in
//! `docs/formats/mtab.md`.
//!
//! [`mitsuba`] has the frames and the tables of that renderer, [`tensor`] their container.
//! [`rise`] makes scenes for RISE and pictures from its renders.
//!
//! ```
//! # let text = include_str!("../tests/data/orange_paint.mtab");
//! let table = rise_bridge::read::mtab(text)?;
//! assert_eq!(table.rows.len(), 4);
//! let again = rise_bridge::write::mtab(&table, rise_bridge::write::Style::default())?;
//! assert_eq!(rise_bridge::read::mtab(&again)?, table);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod column;
pub mod export;
pub mod formats;
pub mod goniometer;
pub mod klems;
pub mod mitsuba;
pub mod read;
pub mod rise;
pub mod tensor;
pub mod write;
