//! RISE: its scenes, and the tables of its `datadriven_material`.
//!
//! [`scene`] reads the chunks of a scene and replaces them; [`material`] reads materials from
//! comments or from RISE's own parameters; [`program`] writes the MIST program of a table;
//! [`product`] runs it and makes tables and scenes; [`mod@table`] is the file format. [`deferred`]
//! lets RISE render the geometry alone and shades it.

pub mod deferred;
pub mod material;
pub mod product;
pub mod program;
pub mod scene;
pub mod stack;
pub mod table;
