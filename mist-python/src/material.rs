//! Materials: a model with its parameters and data files, evaluated in arrays of directions.

use std::{
    collections::{BTreeMap, BTreeSet},
    sync::{
        Arc, Mutex,
        atomic::{AtomicBool, AtomicUsize, Ordering},
    },
};

use mist_engine::{
    Warning,
    material::{Material, MaterialError, PreparedMaterial},
    parameters::ParameterEntry,
};
use numpy::{Complex64, PyArray1, PyArrayDyn, PyArrayMethods};
use pyo3::{
    exceptions::{PyKeyboardInterrupt, PyValueError},
    prelude::*,
    types::{PyDict, PyFloat},
};
use scattering::{Basis, Mode, Notice, Stokes, spec::ParameterKind};

use crate::{
    angles::{Arguments, DirectionArray, Operand},
    error,
    evaluate::{Quantity, TimedModel},
    files::RecordedFiles,
    kept::{ModelCache, locked},
    watch,
};

/// Nanoseconds below which an evaluation is done on the calling thread.
const QUICK: u64 = 2_000_000;
/// Bytes of a result that is made without `out`.
const LARGEST_RESULT: usize = 2 << 30;

/// The name, the text, the description and the class of a parameter.
type EntryTuple =
    (String, String, bool, Option<&'static str>, &'static str, &'static str, &'static str);

/// A model with its parameters set and its files read; immutable.
#[pyclass(frozen, name = "Material", module = "mist._native")]
pub(crate) struct NativeMaterial {
    prepared: PreparedMaterial,
    entries: Vec<ParameterEntry>,
    files: BTreeMap<String, Arc<str>>,
    kept: ModelCache,
    /// Warnings that were given.
    told: Mutex<BTreeSet<Warning>>,
    /// Notices that there were when warnings were given last.
    notices: AtomicUsize,
}

#[pymethods]
impl NativeMaterial {
    #[new]
    #[pyo3(signature = (model, parameters, files, compat))]
    fn new(
        py: Python<'_>,
        model: String,
        parameters: Vec<(String, String)>,
        files: BTreeMap<String, String>,
        compat: bool,
    ) -> PyResult<Self> {
        let mode = if compat { Mode::Compat } else { Mode::Sound };
        let recorded = Arc::new(RecordedFiles::new(files));
        let material = Material { model, parameters, files: BTreeMap::new() };
        let prepared = material
            .prepare(mode, Some(recorded.clone()))
            .map_err(|error| error::of_material(py, &error))?;
        let files = recorded.read();
        Ok(Self::of_prepared(prepared, files))
    }

    /// Name of the class.
    #[getter]
    fn model(&self) -> &'static str {
        self.prepared.parameters().class().name
    }

    /// True if it gives NIST's numbers.
    #[getter]
    fn compat(&self) -> bool {
        self.prepared.mode() == Mode::Compat
    }

    /// Names and texts of the data files that its parameters read.
    #[getter]
    fn files(&self) -> BTreeMap<&str, &str> {
        self.files.iter().map(|(name, text)| (&**name, &**text)).collect()
    }

    /// All parameters: name, text, is_default, kind, unit, doc, class.
    fn entries(&self) -> Vec<EntryTuple> {
        let entry = |entry: &ParameterEntry| {
            let ParameterEntry { name, class, parameter, text, is_default } = entry;
            let kind = parameter.map(|parameter| kind(parameter.kind));
            let (unit, doc) = parameter.map_or(("", ""), |p| (p.unit, p.doc));
            (name.clone(), text.clone(), *is_default, kind, unit, doc, class.name)
        };
        self.entries.iter().map(entry).collect()
    }

    /// The material at another wavelength (µm): of the model and of everything inside of it.
    fn at(&self, wavelength: f64) -> Self {
        Self::of_prepared(self.prepared.at(wavelength).with_own_warnings(), self.files.clone())
    }

    /// Builds the model, so that wrong values are told.
    fn build(&self, py: Python<'_>) -> PyResult<()> {
        self.models(py, &[None])?;
        self.warn(py, 1)
    }

    /// True if the model does not depolarize.
    fn is_coherent(&self, py: Python<'_>) -> PyResult<bool> {
        Ok(self.models(py, &[None])?.iter().all(|timed| timed.model.is_coherent()))
    }

    /// Mueller BRDFs, 1/sr.
    #[pyo3(signature = (theta_i, theta_s, phi_s, rotation, wavelength, basis, out))]
    fn mueller<'py>(
        &self,
        py: Python<'py>,
        theta_i: Operand<'py>,
        theta_s: Operand<'py>,
        phi_s: Operand<'py>,
        rotation: Operand<'py>,
        wavelength: Option<Operand<'py>>,
        basis: &str,
        out: Option<Bound<'py, PyArrayDyn<f64>>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let arguments = Arguments { theta_i, theta_s, phi_s, rotation, wavelength };
        let quantity = Quantity::Mueller(basis_named(basis)?);
        Ok(self.array(py, &arguments, quantity, &[4, 4], out)?.into_any())
    }

    /// BRDFs of one incident light and one sensitivity, 1/sr.
    #[pyo3(signature = (theta_i, theta_s, phi_s, rotation, wavelength, incident, sensitivity, basis, out))]
    fn brdf<'py>(
        &self,
        py: Python<'py>,
        theta_i: Operand<'py>,
        theta_s: Operand<'py>,
        phi_s: Operand<'py>,
        rotation: Operand<'py>,
        wavelength: Option<Operand<'py>>,
        incident: [f64; 4],
        sensitivity: [f64; 4],
        basis: &str,
        out: Option<Bound<'py, PyArrayDyn<f64>>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let arguments = Arguments { theta_i, theta_s, phi_s, rotation, wavelength };
        let [incident, sensitivity] = [incident, sensitivity].map(Stokes);
        let quantity = Quantity::Brdf { basis: basis_named(basis)?, incident, sensitivity };
        if out.is_some() {
            return Ok(self.array(py, &arguments, quantity, &[], out)?.into_any());
        }
        let (shape, numbers) = self.numbers(py, &arguments, quantity)?;
        match (&shape[..], &numbers[..]) {
            ([], [number]) => Ok(PyFloat::new(py, *number).into_any()),
            _ => Ok(PyArray1::from_vec(py, numbers).reshape(shape)?.into_any()),
        }
    }

    /// Jones matrices as pairs of real and imaginary parts, sr^-1/2.
    #[pyo3(signature = (theta_i, theta_s, phi_s, rotation, wavelength, basis))]
    fn jones<'py>(
        &self,
        py: Python<'py>,
        theta_i: Operand<'py>,
        theta_s: Operand<'py>,
        phi_s: Operand<'py>,
        rotation: Operand<'py>,
        wavelength: Option<Operand<'py>>,
        basis: &str,
    ) -> PyResult<Bound<'py, PyArrayDyn<Complex64>>> {
        if !self.is_coherent(py)? {
            let message = format!("{} depolarizes: it has no Jones matrix", self.model());
            let help = Some("take its Mueller matrix");
            return Err(error::exception(
                py,
                "NotCoherent",
                &message,
                "model/depolarizes",
                None,
                help,
            ));
        }
        let arguments = Arguments { theta_i, theta_s, phi_s, rotation, wavelength };
        let quantity = Quantity::Jones(basis_named(basis)?);
        let (shape, numbers) = self.numbers(py, &arguments, quantity)?;
        let complex = numbers.chunks_exact(2).map(|z| Complex64::new(z[0], z[1]));
        let complex: Vec<Complex64> = complex.collect();
        let shape: Vec<usize> = shape.into_iter().chain([2, 2]).collect();
        PyArray1::from_vec(py, complex).reshape(shape)
    }
}

impl NativeMaterial {
    /// The material of the engine.
    pub(crate) fn prepared(&self) -> &PreparedMaterial {
        &self.prepared
    }

    /// True if it gives NIST's numbers.
    pub(crate) fn is_compat(&self) -> bool {
        self.prepared.mode() == Mode::Compat
    }

    fn of_prepared(prepared: PreparedMaterial, files: BTreeMap<String, Arc<str>>) -> Self {
        Self {
            entries: prepared.parameters().entries(),
            prepared,
            files,
            kept: ModelCache::default(),
            told: Mutex::default(),
            notices: AtomicUsize::new(0),
        }
    }

    /// The models at `wavelengths`, built on a pool if they are not kept.
    fn models(
        &self,
        py: Python<'_>,
        wavelengths: &[Option<f64>],
    ) -> PyResult<Vec<Arc<TimedModel>>> {
        let missing: Vec<Option<f64>> =
            wavelengths.iter().copied().filter(|lambda| self.kept.get(*lambda).is_none()).collect();
        let built = if missing.is_empty() { Vec::new() } else { self.built(py, &missing)? };
        let mut built = built.into_iter();
        let mut found = Vec::new();
        for lambda in wavelengths {
            let model = match missing.contains(lambda) {
                true => built.next(),
                false => self.kept.get(*lambda),
            };
            let model =
                model.ok_or_else(|| PyValueError::new_err("a wavelength is not a number"))?;
            self.kept.put(*lambda, &model);
            found.push(model);
        }
        Ok(found)
    }

    /// Models at `wavelengths`, built in parallel.
    fn built(&self, py: Python<'_>, wavelengths: &[Option<f64>]) -> PyResult<Vec<Arc<TimedModel>>> {
        let build = || -> Result<Vec<_>, MaterialError> {
            let lambdas: Vec<f64> = wavelengths.iter().copied().flatten().collect();
            let mut others = self.prepared.models_at(&lambdas)?.into_iter();
            let model = |lambda: &Option<f64>| match lambda {
                None => Ok(Some(self.prepared.own_model()?.0)),
                Some(_) => Ok(others.next()),
            };
            let models: Result<Vec<_>, MaterialError> = wavelengths.iter().map(model).collect();
            Ok(models?
                .into_iter()
                .flatten()
                .map(|model| Arc::new(TimedModel::new(model)))
                .collect())
        };
        let built =
            watch::run(py, None, |flag| scattering::interrupt::until(flag, build), |_| Ok(()))?;
        match built {
            Ok(Ok(models)) => Ok(models),
            Ok(Err(error)) => Err(error::of_material(py, &error)),
            Err(_) => Err(PyKeyboardInterrupt::new_err(())),
        }
    }

    /// The numbers of all directions with the shape of the arguments.
    fn numbers(
        &self,
        py: Python<'_>,
        arguments: &Arguments<'_>,
        quantity: Quantity,
    ) -> PyResult<(Vec<usize>, Vec<f64>)> {
        let directions = arguments.directions()?;
        let bytes = directions.count().saturating_mul(quantity.width() * size_of::<f64>());
        if bytes > LARGEST_RESULT {
            return Err(PyValueError::new_err(format!(
                "the result has {bytes} bytes: give an array `out`, or ask for parts of it"
            )));
        }
        let mut numbers = vec![0.0; directions.count() * quantity.width()];
        self.fill(py, arguments, &directions, quantity, &mut numbers)?;
        Ok((directions.shape, numbers))
    }

    /// Writes the numbers of `directions` into `out`.
    fn fill(
        &self,
        py: Python<'_>,
        arguments: &Arguments<'_>,
        directions: &DirectionArray,
        quantity: Quantity,
        out: &mut [f64],
    ) -> PyResult<()> {
        if directions.count() == 0 {
            return Ok(());
        }
        self.check_units(py, arguments)?;
        let first = directions.beams.first().and_then(|(beam, _)| beam.lambda);
        let one = if directions.beams.len() == 1 { self.kept.get(first) } else { None };
        match one {
            Some(model) if model.expected(directions.count()) < QUICK => {
                py.detach(|| directions.evaluate_here(quantity, &model, out));
            }
            _ => {
                let models = self.models_of(py, directions)?;
                let evaluate =
                    |flag: &Arc<AtomicBool>| directions.evaluate(quantity, &models, flag, out);
                watch::run(py, None, evaluate, |_| Ok(()))?
                    .map_err(|_| PyKeyboardInterrupt::new_err(()))?;
            }
        }
        self.warn(py, 2)
    }

    /// A model for each beam of `directions`.
    fn models_of(
        &self,
        py: Python<'_>,
        directions: &DirectionArray,
    ) -> PyResult<Vec<Arc<TimedModel>>> {
        let mut lambdas: Vec<Option<f64>> = Vec::new();
        let mut numbers: BTreeMap<Option<u64>, usize> = BTreeMap::new();
        let beams = directions.beams.iter().map(|(beam, _)| beam.lambda.filter(|x| !x.is_nan()));
        let of_beams: Vec<usize> = beams
            .map(|lambda| {
                *numbers.entry(lambda.map(f64::to_bits)).or_insert_with(|| {
                    lambdas.push(lambda);
                    lambdas.len() - 1
                })
            })
            .collect();
        let models = self.models(py, &lambdas)?;
        Ok(of_beams.into_iter().map(|number| Arc::clone(&models[number])).collect())
    }

    /// The numbers of all directions as an array whose last axes are `matrix`.
    fn array<'py>(
        &self,
        py: Python<'py>,
        arguments: &Arguments<'py>,
        quantity: Quantity,
        matrix: &[usize],
        out: Option<Bound<'py, PyArrayDyn<f64>>>,
    ) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
        let Some(out) = out else {
            let (shape, numbers) = self.numbers(py, arguments, quantity)?;
            let shape: Vec<usize> = shape.iter().chain(matrix).copied().collect();
            return PyArray1::from_vec(py, numbers).reshape(shape);
        };
        let directions = arguments.directions()?;
        let shape: Vec<usize> = directions.shape.iter().chain(matrix).copied().collect();
        let mut view = out.try_readwrite()?;
        if view.as_array().shape() != shape {
            let message = format!("out has the shape {:?}, not {shape:?}", view.as_array().shape());
            return Err(PyValueError::new_err(message));
        }
        self.fill(py, arguments, &directions, quantity, view.as_slice_mut()?)?;
        drop(view);
        Ok(out)
    }

    /// Warns of angles and wavelengths that are probably in other units.
    fn check_units(&self, py: Python<'_>, arguments: &Arguments<'_>) -> PyResult<()> {
        let [angle, lambda] = arguments.largest();
        if angle > std::f64::consts::PI {
            let message = format!("a polar angle of {angle} is above pi: angles are radians");
            let warning = Warning::new("angle/degrees", message).help("write 60*mist.deg");
            self.give(py, &[warning], 2)?;
        }
        if lambda > 100.0 {
            let message = format!("a wavelength of {lambda} um: wavelengths are micrometres");
            let warning = Warning::new("wavelength/nanometres", message).help("divide by 1000");
            self.give(py, &[warning], 2)?;
        }
        Ok(())
    }

    /// Gives the warnings that were not given yet.
    fn warn(&self, py: Python<'_>, stack_level: usize) -> PyResult<()> {
        let count = locked(self.prepared.notices()).len() + self.kept.count();
        if self.notices.swap(count, Ordering::Relaxed) == count {
            return Ok(());
        }
        let mut warnings = self.prepared.warnings();
        let defects = locked(self.prepared.notices()).clone();
        warnings.extend(defects.iter().filter_map(|notice| match notice {
            Notice::Defect(_) => Some(Warning::new("model/defect", notice.to_string())),
            Notice::Limit(_) => None,
        }));
        self.give(py, &warnings, stack_level)
    }

    fn give(&self, py: Python<'_>, warnings: &[Warning], stack_level: usize) -> PyResult<()> {
        for warning in warnings {
            if !locked(&self.told).insert(warning.clone()) {
                continue;
            }
            let keywords = PyDict::new(py);
            keywords.set_item("code", warning.code)?;
            keywords.set_item("help", warning.help.as_deref())?;
            let class = error::class(py, "MistWarning")?;
            let warning = class.call((&warning.message,), Some(&keywords))?;
            py.import("warnings")?.call_method1("warn", (warning, py.None(), stack_level))?;
        }
        Ok(())
    }
}

fn basis_named(name: &str) -> PyResult<Basis> {
    name.parse().map_err(|error: scattering::polarization::UnknownBasis| {
        PyValueError::new_err(error.to_string())
    })
}

/// The kind of a parameter in a word, as in the registry.
fn kind(kind: ParameterKind) -> &'static str {
    mist_runner::registry::kind(kind).0
}
