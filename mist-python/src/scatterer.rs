//! Particles in free space.

use std::{collections::BTreeMap, sync::Arc};

use glam::DVec3;
use mist_engine::{
    DataFiles,
    deviation::dialect,
    material::MaterialError,
    parameters::{ModelParameters, ParameterInput, ParameterPath},
};
use num_complex::Complex64;
use numpy::{PyArray1, PyArray2, PyArrayMethods};
use pyo3::prelude::*;
use scattering::{
    Mode,
    polarization::{TransverseFrame, perp},
    registry,
    scatterer::Scatterer,
    spec,
    spec::SharedNotices,
};

use crate::{error, files::RecordedFiles};

/// A particle with its parameters; immutable.
#[pyclass(frozen, name = "Scatterer", module = "mist._native")]
pub(crate) struct NativeScatterer {
    particle: Box<dyn Scatterer>,
}

#[pymethods]
impl NativeScatterer {
    #[new]
    fn new(
        py: Python<'_>,
        class: &str,
        parameters: Vec<(String, String)>,
        files: BTreeMap<String, String>,
        compat: bool,
    ) -> PyResult<Self> {
        let mode = if compat { Mode::Compat } else { Mode::Sound };
        let built = py.detach(|| build(class, &parameters, files, mode));
        let particle = built.map_err(|failure| error::of_material(py, &failure))?;
        Ok(Self { particle })
    }

    /// Wave number in the medium, 1/µm.
    #[getter]
    fn wave_number(&self) -> f64 {
        std::f64::consts::TAU * self.particle.medium().re / self.particle.lambda()
    }

    /// Amplitude matrix between two directions, dimensionless: along and across the plane of
    /// scattering, or in (s, p) of each direction.
    fn jones<'py>(
        &self,
        py: Python<'py>,
        k_in: [f64; 3],
        k_out: [f64; 3],
        in_plane: bool,
    ) -> PyResult<Bound<'py, PyArray2<Complex64>>> {
        let unit = |k: [f64; 3]| DVec3::from(k).normalize();
        let (k_in, k_out) = (unit(k_in), unit(k_out));
        let across = perp(k_in, k_out);
        let frame = |k: DVec3| match in_plane {
            true => TransverseFrame { first: across.cross(k), second: across },
            false => TransverseFrame::psps(k),
        };
        let frames = (frame(k_in), frame(k_out));
        let found = self.particle.jones(k_in, k_out, &frames.0, &frames.1);
        PyArray1::from_vec(py, vec![found.ss, found.ps, found.sp, found.pp]).reshape([2, 2])
    }
}

fn build(
    class: &str,
    given: &[(String, String)],
    files: BTreeMap<String, String>,
    mode: Mode,
) -> Result<Box<dyn Scatterer>, MaterialError> {
    let class = registry::find_class(class)
        .ok_or_else(|| MaterialError::Model { name: class.to_owned(), help: None })?;
    let library = DataFiles::new(Arc::new(RecordedFiles::new(files)), dialect(mode));
    let mut parameters = ModelParameters::new(class);
    for (name, text) in given {
        let path = ParameterPath::resolve(class, name);
        parameters.set(&path, ParameterInput::Text(text), &library, mode, None)?;
    }
    Ok(spec::build::<dyn Scatterer>(&parameters.node(mode, &SharedNotices::default()))?)
}
