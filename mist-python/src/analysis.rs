//! Fits, tolerances, colours, tables and files of renderers; results travel as JSON and texts.

use std::{
    collections::BTreeMap,
    path::PathBuf,
    sync::{Arc, atomic::AtomicBool},
};

use mist_engine::{
    Control,
    fit::{self, FitError, FitSettings, MeasuredTable},
    function::{FunctionError, ProgramFunction},
    material::{MaterialError, table},
    request::{RequestError, TableQuery},
    tolerance::{self, ToleranceError},
};
use pyo3::prelude::*;
use rise_bridge::{
    export::ExportError,
    formats::{self, ExportRequest, FileFormat},
    write::Style,
};
use serde::Serialize;
use spectra::{Lab, difference::delta_e_2000};

use crate::{error, material::NativeMaterial, program::NativeProgram, watch};

/// Arguments of a fit as Python gives them.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub(crate) struct FitArguments {
    start: BTreeMap<String, f64>,
    bounds: BTreeMap<String, [f64; 2]>,
    step: f64,
    confidence: f64,
    absolute: bool,
    iterations: usize,
}

fn control(flag: &Arc<AtomicBool>) -> Control {
    Control { cancel: flag.clone(), progress: None }
}

fn json(py: Python<'_>, found: &impl Serialize) -> PyResult<String> {
    serde_json::to_string(found)
        .map_err(|failure| error::plain(py, &failure.to_string(), "result/json", None))
}

fn function(py: Python<'_>, program: &NativeProgram, vary: &[String]) -> PyResult<ProgramFunction> {
    program.function(vary).map_err(|failure| match failure {
        FunctionError::Program(found) => error::of_program(py, &found, program.source()),
        other => error::plain(py, &other.to_string(), "program/variable", Some("vary")),
    })
}

/// Fits variables of a program to a measured table; the answer is JSON.
#[pyfunction]
pub(crate) fn fit_program(
    py: Python<'_>,
    program: &NativeProgram,
    measured: &str,
    vary: Vec<String>,
    arguments: FitArguments,
) -> PyResult<String> {
    let function = function(py, program, &vary)?;
    let measured = MeasuredTable::parse(measured, function.titles(), function.headers()).map_err(
        |failure| error::plain(py, &failure.to_string(), "fit/measured", Some("measured")),
    )?;
    let FitArguments { start, bounds, step, confidence, absolute, iterations } = arguments;
    let settings = FitSettings { start, bounds, step, confidence, absolute, iterations };
    let run = |flag: &Arc<AtomicBool>| fit::fit(&function, &measured, &settings, &control(flag));
    match watch::run(py, None, run, |_| Ok(()))? {
        Ok(found) => json(py, &found),
        Err(failure) => Err(match failure.diagnostics() {
            Some(found) => error::of_program(py, found, program.source()),
            None => of_fit(py, &failure),
        }),
    }
}

fn of_fit(py: Python<'_>, failure: &FitError) -> PyErr {
    error::plain(py, &failure.to_string(), "fit", None)
}

/// Changes of the colours of a program per unit of its variables; the answer is JSON.
#[pyfunction]
pub(crate) fn colour_tolerance(
    py: Python<'_>,
    program: &NativeProgram,
    vary: Vec<String>,
    step: f64,
) -> PyResult<String> {
    let function = function(py, program, &vary)?;
    let run = |flag: &Arc<AtomicBool>| tolerance::tolerance(&function, step, &control(flag));
    match watch::run(py, None, run, |_| Ok(()))? {
        Ok(found) => json(py, &found),
        Err(ToleranceError::Run { failure, .. }) => {
            Err(error::of_failure(py, &failure, program.source()))
        }
        Err(failure) => Err(error::plain(py, &failure.to_string(), "tolerance", None)),
    }
}

/// Colours of spectra: a request and an answer in JSON.
#[pyfunction]
pub(crate) fn colours(py: Python<'_>, request: &str) -> PyResult<String> {
    let wrong = |failure: String| error::plain(py, &failure, "color", None);
    let request = serde_json::from_str(request).map_err(|failure| wrong(failure.to_string()))?;
    let answer = spectra::case::evaluate(&request).map_err(|failure| wrong(failure.to_string()))?;
    json(py, &answer)
}

/// CIEDE2000 of two L*a*b*.
#[pyfunction]
pub(crate) fn ciede2000(first: [f64; 3], second: [f64; 3]) -> f64 {
    let lab = |[l, a, b]: [f64; 3]| Lab::new(l, a, b);
    delta_e_2000(lab(first), lab(second))
}

/// The colour table of a material as texts by format: `mtab`, `mspd`, `json`, `svg`.
#[pyfunction]
pub(crate) fn colour_table(
    py: Python<'_>,
    material: &NativeMaterial,
    name: &str,
    query: &str,
    formats: Vec<String>,
) -> PyResult<Vec<String>> {
    let wrong = |failure: &RequestError| {
        error::plain(py, &failure.to_string(), "request", Some(&failure.key))
    };
    let query: TableQuery = serde_json::from_str(query)
        .map_err(|failure| error::of_material(py, &MaterialError::Json(failure)))?;
    let request = query.request(name, None).map_err(|failure| wrong(&failure))?;
    let prepared = material.prepared();
    let run = |flag: &Arc<AtomicBool>| table::table(prepared, &request, &control(flag));
    let table = watch::run(py, None, run, |_| Ok(()))?
        .map_err(|failure| error::of_material(py, &failure))?;
    let text = |name: &String| {
        let writer = FileFormat::named(name).and_then(FileFormat::colours).ok_or_else(|| {
            let known = formats::extensions(formats::of_colours().map(|(format, _)| format));
            let problem = format!("{name:?} is not a format of colour tables ({known})");
            error::plain(py, &problem, "table/format", Some("format"))
        })?;
        (writer.text)(&table, 0, Style::default())
            .map_err(|failure| error::plain(py, &failure.to_string(), "table/format", None))
    };
    formats.iter().map(text).collect()
}

/// The file of a renderer for a material, with a line about it; the format is that of the name.
#[pyfunction]
#[pyo3(signature = (material, path, wavelengths, grid, rgb, plugin))]
pub(crate) fn export_file(
    py: Python<'_>,
    material: &NativeMaterial,
    path: PathBuf,
    wavelengths: Option<String>,
    grid: Option<String>,
    rgb: bool,
    plugin: bool,
) -> PyResult<(Vec<u8>, String)> {
    let name = path.to_string_lossy();
    let writer = FileFormat::of_file(&name).and_then(FileFormat::material).ok_or_else(|| {
        let known = formats::extensions(formats::of_materials().map(|(format, _)| format));
        let problem = format!("the name {name:?} does not tell the format ({known} do)");
        error::plain(py, &problem, "export/format", Some("path"))
    })?;
    let stem = path.file_stem().map_or_else(String::new, |stem| stem.to_string_lossy().into());
    let request = ExportRequest {
        name: stem,
        lambda: wavelengths,
        grid,
        rgb,
        plugin,
        compat: material.is_compat(),
        estimate_error: true,
        ..ExportRequest::default()
    };
    let prepared = material.prepared();
    let run = |flag: &Arc<AtomicBool>| {
        let mut bytes = Vec::new();
        writer.write(prepared, &request, &mut bytes, &control(flag)).map(|line| (bytes, line))
    };
    watch::run(py, None, run, |_| Ok(()))?.map_err(|failure| match &failure {
        ExportError::Material(inner) => error::of_material(py, inner),
        other => error::plain(py, &other.to_string(), "export", None),
    })
}
