//! Pyramids on an equilateral triangle, one side along x, at random places.
//!
//! $$ \mathrm{PSD} = D h^2 \left| \sum_{\text{faces}} \iint \lambda\,
//!    e^{-2\pi i \mathbf{f}\cdot\mathbf{r}}\,dx\,dy \right|^2 $$
//!
//! λ falls from 1 at the centre to 0 at the edge; h is the height (or depth), D the number per
//! area. The integrals are evaluated as divided differences, without the singular lines of the
//! closed form. NIST's library returns 0 wherever its denominator
//! 4π³|XY(3X⁴ − 10X²Y² + 3Y⁴)|, X and Y the frequencies times the side, is below 10⁻⁶ and it has
//! no limit ([`Defect::PyramidLines`]): on the lines f_x = ±√3 f_y, and nearly everywhere for small
//! pyramids.
//!
//! C. de Boor, *Divided differences*, Surveys in Approximation Theory 1, 46 (2005).

use std::f64::consts::{PI, TAU};

use num_complex::Complex64;

use crate::{
    Defect,
    psd::{Psd, strength, triangle},
    spec::{Class, Laws, Parameter, Spec},
};

/// Name, parameters and constructor of a [`TriangularPyramid`].
pub const SPEC: Spec<dyn Psd> = Spec {
    class: Class {
        name: "Triangular_Pyramid_PSD_Function",
        parent: "PSD_Function",
        summary: "Pyramids on equilateral triangles, one side along x",
        equation: "PSD = density |FT(pyramid)|^2",
        source: "deboor-2005",
        params: &[&[
            Parameter::number("length", 1.5, "um", "Length of a side"),
            Parameter::number("height", 0.01, "um", "Height of one"),
            Parameter::number("density", 0.01, "1/um^2", "Number per area"),
        ]],
        laws: Laws::NONE,
    },
    build: |node| {
        let side = node.number("length");
        let face = 0.75f64.sqrt() / 6.0 * side * side;
        Ok(Box::new(TriangularPyramid {
            side,
            peak: strength(node, "density")? * (face * node.number("height")).powi(2),
            dark_lines: node.reproduces(Defect::PyramidLines),
        }))
    },
};

/// Three-sided pyramids.
#[derive(Clone, Debug)]
pub struct TriangularPyramid {
    /// Length of a side, µm.
    side: f64,
    /// D h² times the squared area of a face, µm⁴.
    peak: f64,
    dark_lines: bool,
}

/// Size of a factor or of the denominator below which NIST's library leaves its closed form.
const NEAR_LINE: f64 = 1e-6;

/// True if NIST's library gives 0: its denominator is small and no factor with a limit is.
fn is_dark(x: f64, y: f64) -> bool {
    let (x2, y2) = (x * x, y * y);
    let denominator = 4.0 * PI.powi(3) * x * y * (3.0 * x2 * x2 - 10.0 * x2 * y2 + 3.0 * y2 * y2);
    let has_limit = [x, y, 3.0 * x2 - y2].into_iter().any(|factor| factor.abs() < NEAR_LINE);
    denominator.abs() < NEAR_LINE && !has_limit
}

impl Psd for TriangularPyramid {
    fn density(&self, fx: f64, fy: f64) -> f64 {
        let (x, y) = (fx * self.side, fy * self.side);
        if self.dark_lines && is_dark(x, y) {
            return 0.0;
        }
        let foot = TAU / 12f64.sqrt() * y;
        let corners = [0.5 * TAU * x - foot, 2.0 * foot, -0.5 * TAU * x - foot];
        let faces = [(0, 1), (1, 2), (2, 0)].map(|(a, b)| [corners[a], corners[b]]);
        let sum: Complex64 = faces.into_iter().map(|foot| triangle::tapered(0.0, foot)).sum();
        self.peak * sum.norm_sqr()
    }
}

#[cfg(test)]
mod tests {
    use crate::{Mode, psd::tests::build};

    const NAME: &str = "Triangular_Pyramid_PSD_Function";

    #[test]
    fn the_lines_at_30_degrees_are_dark_in_compat_only() {
        let (fx, fy) = (3f64.sqrt() * 0.4, 0.4);
        let (sound, compat) = (build(NAME, Mode::Sound, &[]), build(NAME, Mode::Compat, &[]));
        assert_eq!(compat.density(fx, fy), 0.0);
        assert!(compat.density(fx, fy + 1e-3) > 0.0);
        // The sound spectrum is smooth across the line.
        let beside = 0.5 * (sound.density(fx, fy + 1e-4) + sound.density(fx, fy - 1e-4));
        assert!((sound.density(fx, fy) / beside - 1.0).abs() < 1e-5);
    }

    #[test]
    fn small_pyramids_are_dark_in_compat_only() {
        let small = [("length", 0.02)];
        let (sound, compat) = (build(NAME, Mode::Sound, &small), build(NAME, Mode::Compat, &small));
        assert_eq!(compat.density(1.3, 0.9), 0.0);
        let volume = 3f64.sqrt() / 12.0 * 0.02 * 0.02 * 0.01;
        let expected = 0.01 * volume * volume;
        assert!((sound.density(1.3, 0.9) / expected - 1.0).abs() < 1e-2);
        assert!((compat.density(0.0, 0.9) / expected - 1.0).abs() < 1e-2);
    }

    #[test]
    fn zero_frequency_gives_the_volume_squared_in_both_modes() {
        let volume = 3f64.sqrt() / 12.0 * 1.5 * 1.5 * 0.01;
        for mode in [Mode::Sound, Mode::Compat] {
            let density = build(NAME, mode, &[]).density(0.0, 0.0);
            assert!((density / (0.01 * volume * volume) - 1.0).abs() < 1e-14);
        }
    }
}
