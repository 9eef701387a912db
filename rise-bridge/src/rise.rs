//! RISE: scenes whose materials we know, and the tables that its `datadriven_material` reads.
//!
//! [`scene`] reads the chunks of a scene and puts others in their place; [`material`] finds what a
//! chunk says about a material, in comments for us or in RISE's own parameters; [`program`] writes
//! the MIST program of its rings; [`product`] runs it and makes tables and scenes; [`table`] is the
//! file. [`deferred`] lets RISE render the geometry alone and shades it.

pub mod deferred;
pub mod material;
pub mod product;
pub mod program;
pub mod scene;
pub mod stack;
pub mod table;
