//! The extension module `mist._native`: numbers and threads for the Python package `mist`.
//!
//! The package in `python/mist` has the public names; it converts arguments and finds what to show.
//! Every function here that computes releases Python's lock, and looks for signals meanwhile.

mod analysis;
mod angles;
mod error;
mod evaluate;
mod files;
mod kept;
mod material;
mod pool;
mod program;
mod registry;
mod result;
mod scatterer;
mod shards;
mod watch;

use pyo3::prelude::*;

/// Numbers and threads of mist; private, the package `mist` has the public names.
#[pymodule]
mod _native {
    #[pymodule_export]
    #[allow(non_upper_case_globals)]
    const version: &str = env!("CARGO_PKG_VERSION");
    #[pymodule_export]
    use crate::analysis::{
        ciede2000, colour_table, colour_tolerance, colours, export_file, fit_program,
    };
    #[pymodule_export]
    use crate::material::NativeMaterial;
    #[pymodule_export]
    use crate::pool::{forget_threads, set_threads, threads};
    #[pymodule_export]
    use crate::program::{NativeProgram, formatted};
    #[pymodule_export]
    use crate::registry::families;
    #[pymodule_export]
    use crate::result::NativeResult;
    #[pymodule_export]
    use crate::scatterer::NativeScatterer;
    #[pymodule_export]
    use crate::shards::merge_shards;
}
