//! Plateaus with the outline of an equilateral triangle, one side along y, at random places.
//!
//! $$ \mathrm{PSD} = D h^2 \left| \iint_\triangle e^{-2\pi i \mathbf{f}\cdot\mathbf{r}}\,dx\,dy
//!    \right|^2 $$
//!
//! h is the height (or depth), D the number per area. [`Triangular_Pyramid_PSD_Function`] has
//! one side along x, as in NIST's library. The integral is evaluated as a divided difference,
//! without the singular lines of the closed form.
//!
//! C. de Boor, *Divided differences*, Surveys in Approximation Theory 1, 46 (2005).
//!
//! [`Triangular_Pyramid_PSD_Function`]: super::triangular_pyramid

use std::f64::consts::TAU;

use crate::{
    psd::{Psd, strength, triangle},
    spec::{Class, Laws, Parameter, Spec},
};

/// Name, parameters and constructor of a [`TriangularMesa`].
pub const SPEC: Spec<dyn Psd> = Spec {
    class: Class {
        name: "Triangular_Mesa_PSD_Function",
        parent: "PSD_Function",
        summary: "Plateaus shaped as equilateral triangles, one side along y",
        equation: "PSD = density height^2 |FT(triangle)|^2",
        source: "deboor-2005",
        params: &[&[
            Parameter::number("side", 1.5, "um", "Length of a side"),
            Parameter::number("height", 0.01, "um", "Height of one"),
            Parameter::number("density", 0.01, "1/um^2", "Number per area"),
        ]],
        laws: Laws::NONE,
    },
    build: |node| {
        let side = node.number("side");
        let volume = 0.75f64.sqrt() / 2.0 * side * side * node.number("height");
        Ok(Box::new(TriangularMesa { side, peak: strength(node, "density")? * volume.powi(2) }))
    },
};

/// Triangular plateaus.
#[derive(Clone, Debug)]
pub struct TriangularMesa {
    /// Length of a side, µm.
    side: f64,
    /// D times the squared volume of a plateau, µm⁴.
    peak: f64,
}

impl Psd for TriangularMesa {
    fn density(&self, fx: f64, fy: f64) -> f64 {
        let (tip, edge) = (TAU * self.side * 0.75f64.sqrt() * fx, TAU * self.side * 0.5 * fy);
        self.peak * triangle::flat([tip, edge, -edge]).norm_sqr()
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use num_complex::Complex64;

    use crate::{Mode, psd::tests::build};

    #[test]
    fn the_closed_form_holds_away_from_its_singular_lines() {
        let numbers = [("side", 1.5), ("height", 0.02), ("density", 0.03)];
        let psd = build("Triangular_Mesa_PSD_Function", Mode::Sound, &numbers);
        let r3 = 3f64.sqrt();
        for (fx, fy) in [(0.3, 0.2), (1.1, -0.7), (-2.0, 0.4), (0.1, 7.0)] {
            let (x, y) = (PI * fx * 1.5, PI * fy * 1.5);
            let top = Complex64::new((r3 * x).cos() - y.cos(), -(r3 * x).sin()) * (r3 * fy)
                + Complex64::new(0.0, 3.0 * fx * y.sin());
            let ft = top / (2.0 * PI * PI * fy * (fy * fy - 3.0 * fx * fx));
            let expected = 0.03 * 0.02f64.powi(2) * ft.norm_sqr();
            assert!((psd.density(fx, fy) / expected - 1.0).abs() < 1e-11, "{fx} {fy}");
        }
    }

    #[test]
    fn the_spectrum_has_the_symmetry_of_the_triangle() {
        let psd = build("Triangular_Mesa_PSD_Function", Mode::Sound, &[]);
        let (c, s) = (-0.5, 0.75f64.sqrt());
        let turned = psd.density(c * 0.4 - s * 0.3, s * 0.4 + c * 0.3);
        assert!((turned / psd.density(0.4, 0.3) - 1.0).abs() < 1e-13);
    }
}
