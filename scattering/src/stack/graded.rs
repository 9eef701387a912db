//! A film whose permittivity goes in equal steps from one material to another.
//!
//! $$ \varepsilon_j = (1-f_j)\,\varepsilon_{start} + f_j\,\varepsilon_{end}, \qquad
//!    f_j = \frac{j + 1/2}{N}, \quad j = 0 \ldots N-1 $$
//!
//! Film 0 lies next to the substrate; every film is thickness/N thick. The mixture is the linear
//! one of permittivities, at the wavelength of the evaluation.
//!
//! NIST's library ([`Defect::GradedFilmGrid`]) tabulates each film on a grid of wavelengths: as
//! many as the longer of the two tables has, equidistant over the range of both, where a constant
//! counts as one point at wavelength 0. With one tabulated and one constant material the grid is
//! far too coarse.
//!
//! M. Born and E. Wolf, *Principles of Optics*, 7th ed. (1999), section 1.6.

use std::sync::Arc;

use num_complex::Complex64;

use super::{Film, Stack, check_thickness};
use crate::{
    Defect,
    optics::{AbscissaScale, RealFunction, RefractiveIndex, TableInterpolation},
    spec::{Class, Laws, Parameter, ParameterError, ParameterNode, Spec},
};

/// Name, parameters and constructor of the class.
pub const SPEC: Spec<Stack> = Spec {
    class: Class {
        name: "GradedFilm_StackModel",
        parent: "StackModel",
        summary: "A film that changes in steps from one material to another",
        equation: "eps_j = (1-f) eps_start + f eps_end, f = (j+1/2)/N",
        source: "born-1999",
        params: &[&[
            Parameter::index("start", (1.5, 0.0), "Index next to the substrate"),
            Parameter::index("end", (1.0, 0.0), "Index on the outside"),
            Parameter::number("thickness", 0.1, "um", "Total thickness"),
            Parameter::integer("steps", 5, "Number of films, at least 2"),
        ]],
        laws: Laws::NONE,
    },
    build: |node| graded(node).map(Box::new),
};

/// Films of which a gradient can be made; more do not change what light sees.
const MOST_STEPS: i32 = 10_000;

fn graded(node: &ParameterNode) -> Result<Stack, ParameterError> {
    let steps = node.integer("steps");
    if !(2..=MOST_STEPS).contains(&steps) {
        let problem = format!("{steps} is not from 2 to {MOST_STEPS}");
        return Err(ParameterError::new("steps", problem));
    }
    let thickness = check_thickness("thickness", node.number("thickness"))? / f64::from(steps);
    let (start, end) = (node.index("start"), node.index("end"));
    let grid = wavelengths(start, end).filter(|_| node.reproduces(Defect::GradedFilmGrid));
    let film = |j: i32| {
        let f = (f64::from(j) + 0.5) / f64::from(steps);
        let exact = IndexMixture { start: start.clone(), end: end.clone(), f };
        let index = match &grid {
            Some(grid) => exact.tabulated(grid),
            None => exact.index(),
        };
        Film { index, thickness }
    };
    Ok(Stack { films: (0..steps).map(film).collect() })
}

/// A mixture of two materials with the fraction `f` of `end`.
struct IndexMixture {
    start: RefractiveIndex,
    end: RefractiveIndex,
    f: f64,
}

impl IndexMixture {
    fn at(&self, lambda: f64) -> Complex64 {
        let (a, b) = (self.start.at(lambda), self.end.at(lambda));
        (a * a * (1.0 - self.f) + b * b * self.f).sqrt()
    }

    fn tabulated(&self, grid: &[f64]) -> RefractiveIndex {
        let column = |part: fn(Complex64) -> f64| {
            let rows: Vec<_> = grid.iter().map(|&x| (x, part(self.at(x)))).collect();
            RealFunction::points(&rows, AbscissaScale::Linear, TableInterpolation::Linear)
        };
        RefractiveIndex { n: column(|z| z.re), k: column(|z| z.im) }
    }

    fn index(self) -> RefractiveIndex {
        let constant = [&self.start, &self.end]
            .iter()
            .all(|index| is_constant(&index.n) && is_constant(&index.k));
        if constant {
            let z = self.at(1.0);
            return RefractiveIndex::constant(z.re, z.im);
        }
        let real = Arc::new(self);
        let imaginary = real.clone();
        RefractiveIndex {
            n: RealFunction::Formula(Arc::new(move |x| real.at(x).re)),
            k: RealFunction::Formula(Arc::new(move |x| imaginary.at(x).im)),
        }
    }
}

fn is_constant(table: &RealFunction) -> bool {
    matches!(table, RealFunction::Constant(_))
}

/// The library's grid, or nothing if neither material is tabulated.
fn wavelengths(start: &RefractiveIndex, end: &RefractiveIndex) -> Option<Vec<f64>> {
    let extents = [&start.n, &start.k, &end.n, &end.k].map(RealFunction::extent);
    let count = extents.iter().flatten().map(|e| e.0).max()?;
    // A constant counts as one point at wavelength 0.
    let range = |x: Option<(usize, f64, f64)>| x.map_or((0.0, 0.0), |(_, a, b)| (a, b));
    let low = extents.iter().map(|e| range(*e).0).fold(f64::INFINITY, f64::min);
    let high = extents.iter().map(|e| range(*e).1).fold(f64::NEG_INFINITY, f64::max);
    let step = (high - low) / (count - 1) as f64;
    Some((0..count).map(|i| low + step * i as f64).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Mode, ParameterValue, spec};

    fn tabulated() -> RefractiveIndex {
        let n = [(0.4, 1.6), (0.5, 1.55), (0.6, 1.52), (0.7, 1.5)];
        let k = [(0.4, 0.0), (0.5, 0.0), (0.6, 0.0), (0.7, 0.0)];
        let table = |rows: &[_]| {
            RealFunction::points(rows, AbscissaScale::Linear, TableInterpolation::Linear)
        };
        RefractiveIndex { n: table(&n), k: table(&k) }
    }

    fn stack(mode: Mode) -> Stack {
        let node = ParameterNode::with_defaults(&SPEC.class, mode)
            .with("start", ParameterValue::Index(tabulated()))
            .unwrap();
        *spec::build::<Stack>(&node).unwrap()
    }

    #[test]
    fn permittivity_is_mixed_linearly_at_every_wavelength() {
        let lambda = 0.47;
        let (a, b) = (tabulated().at(lambda), Complex64::ONE);
        for (j, (n, t)) in stack(Mode::Sound).at(lambda).into_iter().enumerate() {
            let f = (j as f64 + 0.5) / 5.0;
            assert!((n * n - (a * a * (1.0 - f) + b * b * f)).norm() < 1e-15);
            assert!((t - 0.02).abs() < 1e-17);
        }
    }

    #[test]
    fn compat_tabulates_from_wavelength_zero_if_one_material_is_constant() {
        // Four points from 0 to 0.7 µm: between 0.4667 and 0.7 a straight line in n.
        let n = stack(Mode::Compat).films[0].index.clone();
        let middle = 0.5 * (n.at(0.7 * 2.0 / 3.0) + n.at(0.7));
        assert!((n.at(0.7 * 5.0 / 6.0) - middle).norm() < 1e-15);
        let exact = stack(Mode::Sound).films[0].index.at(0.7 * 5.0 / 6.0);
        assert!((n.at(0.7 * 5.0 / 6.0) - exact).norm() > 1e-3);
    }

    #[test]
    fn fewer_than_two_steps_are_refused() {
        let node = ParameterNode::with_defaults(&SPEC.class, Mode::Sound)
            .with("steps", ParameterValue::Integer(1))
            .unwrap();
        assert_eq!(spec::build::<Stack>(&node).unwrap_err().parameter, "steps");
    }
}
