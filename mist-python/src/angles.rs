//! Arrays of angles and wavelengths: broadcast as in numpy, and grouped by their beams.

use std::{collections::HashMap, ops::Range};

use numpy::{PyArrayDyn, PyArrayMethods, PyReadonlyArrayDyn, PyUntypedArrayMethods};
use pyo3::{exceptions::PyValueError, prelude::*, types::PyFloat};

/// A number, or an array of numbers.
pub(crate) enum Operand<'py> {
    One(f64),
    Many(PyReadonlyArrayDyn<'py, f64>),
}

impl<'py> FromPyObject<'_, 'py> for Operand<'py> {
    type Error = PyErr;

    fn extract(value: Borrowed<'_, 'py, PyAny>) -> PyResult<Self> {
        if let Ok(number) = value.cast::<PyFloat>() {
            return Ok(Self::One(number.extract()?));
        }
        if let Ok(array) = value.cast::<PyArrayDyn<f64>>() {
            return Ok(Self::Many(array.try_readonly()?));
        }
        let py = value.py();
        let numpy = py.import(pyo3::intern!(py, "numpy"))?;
        let float = py.get_type::<PyFloat>();
        let array = numpy.call_method1(pyo3::intern!(py, "asarray"), (value, float))?;
        match array.cast::<PyArrayDyn<f64>>() {
            Ok(array) if array.ndim() == 0 => Ok(Self::One(array.extract()?)),
            Ok(array) => Ok(Self::Many(array.try_readonly()?)),
            Err(error) => Err(error.into()),
        }
    }
}

impl Operand<'_> {
    fn shape(&self) -> &[usize] {
        match self {
            Self::One(_) => &[],
            Self::Many(array) => array.shape(),
        }
    }

    /// The only element, if there is one.
    fn single(&self) -> Option<f64> {
        match self {
            Self::One(x) => Some(*x),
            Self::Many(array) if array.len() == 1 => array.as_array().first().copied(),
            Self::Many(_) => None,
        }
    }

    /// The elements of the array broadcast to `shape`, in C order.
    fn spread(&self, shape: &[usize], count: usize) -> Vec<f64> {
        match self {
            Self::One(x) => vec![*x; count],
            Self::Many(array) => match (array.shape() == shape, array.as_slice()) {
                (true, Ok(values)) => values.to_vec(),
                _ => {
                    let array = array.as_array();
                    array.broadcast(shape).map_or_else(Vec::new, |a| a.iter().copied().collect())
                }
            },
        }
    }
}

/// An incident beam on a sample, of one wavelength.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Beam {
    /// Polar angle, radians.
    pub(crate) theta_i: f64,
    /// Rotation of the sample, radians.
    pub(crate) rotation: f64,
    /// Vacuum wavelength, µm; none for that of the material.
    pub(crate) lambda: Option<f64>,
}

impl Beam {
    fn bits(self) -> [u64; 3] {
        [self.theta_i, self.rotation, self.lambda.unwrap_or(f64::NAN)].map(f64::to_bits)
    }

    /// True if it has no direction or no wavelength.
    pub(crate) fn is_nan(self) -> bool {
        self.theta_i.is_nan() || self.rotation.is_nan() || self.lambda.is_some_and(f64::is_nan)
    }
}

/// The five arguments of an evaluation as they are given.
pub(crate) struct Arguments<'py> {
    pub(crate) theta_i: Operand<'py>,
    pub(crate) theta_s: Operand<'py>,
    pub(crate) phi_s: Operand<'py>,
    pub(crate) rotation: Operand<'py>,
    pub(crate) wavelength: Option<Operand<'py>>,
}

/// The directions of an evaluation, beam by beam.
pub(crate) struct DirectionArray {
    /// Shape of the result without its matrices.
    pub(crate) shape: Vec<usize>,
    /// Polar angles and azimuths of scattering, radians, in the order of the beams.
    pub(crate) theta_s: Vec<f64>,
    pub(crate) phi_s: Vec<f64>,
    /// The beams with the ranges of their directions.
    pub(crate) beams: Vec<(Beam, Range<usize>)>,
    /// Position in the result of each direction, if it is not the same.
    pub(crate) places: Option<Vec<usize>>,
}

impl Arguments<'_> {
    /// Broadcasts the arguments, and collects the directions of equal beams in their order.
    pub(crate) fn directions(&self) -> PyResult<DirectionArray> {
        let all = [&self.theta_i, &self.theta_s, &self.phi_s, &self.rotation];
        let shapes = all.into_iter().chain(&self.wavelength).map(Operand::shape);
        let shape = broadcast(shapes)?;
        let count = shape.iter().product();
        let [theta_s, phi_s] = [&self.theta_s, &self.phi_s].map(|x| x.spread(&shape, count));
        let lambda = self.wavelength.as_ref().map(Operand::single);
        if let (Some(theta_i), Some(rotation), None | Some(Some(_))) =
            (self.theta_i.single(), self.rotation.single(), lambda)
        {
            let beam = Beam { theta_i, rotation, lambda: lambda.flatten() };
            let beams = if count == 0 { Vec::new() } else { vec![(beam, 0..count)] };
            return Ok(DirectionArray { shape, theta_s, phi_s, beams, places: None });
        }
        let [theta_i, rotation] = [&self.theta_i, &self.rotation].map(|x| x.spread(&shape, count));
        let lambda = self.wavelength.as_ref().map(|x| x.spread(&shape, count));
        let beams = (0..count).map(|k| Beam {
            theta_i: theta_i[k],
            rotation: rotation[k],
            lambda: lambda.as_ref().map(|lambda| lambda[k]),
        });
        Ok(grouped(beams, shape, theta_s, phi_s))
    }

    /// The largest magnitudes of the polar angles and of the wavelengths.
    pub(crate) fn largest(&self) -> [f64; 2] {
        let largest = |x: &Operand<'_>| match x {
            Operand::One(x) => x.abs(),
            Operand::Many(array) => array.as_array().iter().fold(0.0, |m: f64, x| m.max(x.abs())),
        };
        let lambda = self.wavelength.as_ref().map_or(0.0, largest);
        [largest(&self.theta_i).max(largest(&self.theta_s)), lambda]
    }
}

/// The directions with those of equal beams next to each other, beams in order of appearance.
fn grouped(
    beams: impl Iterator<Item = Beam>,
    shape: Vec<usize>,
    theta_s: Vec<f64>,
    phi_s: Vec<f64>,
) -> DirectionArray {
    let mut known: HashMap<[u64; 3], usize> = HashMap::new();
    let mut found: Vec<(Beam, Range<usize>)> = Vec::new();
    let mut last = None;
    let numbers: Vec<usize> = beams
        .map(|beam| {
            let bits = beam.bits();
            let number = match last {
                Some((bits_before, number)) if bits_before == bits => number,
                _ => *known.entry(bits).or_insert_with(|| {
                    found.push((beam, 0..0));
                    found.len() - 1
                }),
            };
            last = Some((bits, number));
            found[number].1.end += 1;
            number
        })
        .collect();
    let mut start = 0;
    for (_, range) in &mut found {
        let count = range.end;
        *range = start..start;
        start += count;
    }
    if numbers.is_sorted() {
        for number in numbers {
            found[number].1.end += 1;
        }
        return DirectionArray { shape, theta_s, phi_s, beams: found, places: None };
    }
    let mut places = vec![0; numbers.len()];
    for (place, number) in numbers.into_iter().enumerate() {
        let range = &mut found[number].1;
        places[range.end] = place;
        range.end += 1;
    }
    let pick = |values: &[f64]| places.iter().map(|place| values[*place]).collect();
    let (theta_s, phi_s) = (pick(&theta_s), pick(&phi_s));
    DirectionArray { shape, theta_s, phi_s, beams: found, places: Some(places) }
}

/// The shape of arrays that are used together.
fn broadcast<'a>(shapes: impl Iterator<Item = &'a [usize]> + Clone) -> PyResult<Vec<usize>> {
    let length = shapes.clone().map(<[usize]>::len).max().unwrap_or(0);
    let mut result = vec![1; length];
    for shape in shapes.clone() {
        for (size, own) in result[length - shape.len()..].iter_mut().zip(shape) {
            match (*size, *own) {
                (_, 1) => {}
                (1, own) => *size = own,
                (size, own) if size == own => {}
                _ => {
                    let all: Vec<&[usize]> = shapes.filter(|shape| !shape.is_empty()).collect();
                    return Err(PyValueError::new_err(format!(
                        "arrays of the shapes {all:?} cannot be used together"
                    )));
                }
            }
        }
    }
    Ok(result)
}
