//! Pyramids on a rectangle at random places.
//!
//! $$ \mathrm{PSD} = D \left| h \iint \left[1 - \max\!\left(\frac{2|x|}{l_x},
//!    \frac{2|y|}{l_y}\right)\right] e^{-2\pi i \mathbf{f}\cdot\mathbf{r}}\,dx\,dy \right|^2 $$
//!
//! l_x, l_y are the sides, h is the height (or depth), D the number per area. The integral over
//! each face is evaluated as a divided difference, without the singular lines of the closed form.
//! NIST's library takes the limit of the lines |X| = |Y|, X = f_x l_x and Y = f_y l_y, wherever its
//! denominator π³|XY(X² − Y²)| is below 10⁻⁶ ([`Defect::PyramidLimits`]).
//!
//! C. de Boor, *Divided differences*, Surveys in Approximation Theory 1, 46 (2005).

use std::f64::consts::PI;

use crate::{
    Defect,
    psd::{Psd, strength, triangle},
    spec::{Class, Laws, Parameter, Spec},
};

/// Name, parameters and constructor of a [`RectangularPyramid`].
pub const SPEC: Spec<dyn Psd> = Spec {
    class: Class {
        name: "Rectangular_Pyramid_PSD_Function",
        parent: "PSD_Function",
        summary: "Pyramids on rectangles",
        equation: "PSD = density |FT(pyramid)|^2",
        source: "deboor-2005",
        params: &[&[
            Parameter::number("lengthx", 1.5, "um", "Length of the side along x"),
            Parameter::number("lengthy", 1.5, "um", "Length of the side along y"),
            Parameter::number("height", 0.01, "um", "Height of one"),
            Parameter::number("density", 0.01, "1/um^2", "Number per area"),
        ]],
        laws: Laws::NONE,
    },
    build: |node| {
        let sides = (node.number("lengthx"), node.number("lengthy"));
        let faces = 0.5 * sides.0 * sides.1 * node.number("height");
        let peak = strength(node, "density")? * faces.powi(2);
        Ok(Box::new(RectangularPyramid {
            sides,
            peak,
            takes_limits: node.reproduces(Defect::PyramidLimits),
        }))
    },
};

/// Four-sided pyramids.
#[derive(Clone, Debug)]
pub struct RectangularPyramid {
    /// l_x and l_y, µm.
    sides: (f64, f64),
    /// D (h l_x l_y/2)², µm⁴: the mean of each pair of faces covers half of the rectangle.
    peak: f64,
    takes_limits: bool,
}

/// Size of a factor or of the denominator below which NIST's library leaves its closed form.
const NEAR_LINE: f64 = 1e-6;

/// True if NIST's library takes the limit of |x| = |y|, both frequencies times π and the sides.
fn is_limit(x: f64, y: f64) -> bool {
    let denominator = x * y * (x * x - y * y) / PI;
    denominator.abs() < NEAR_LINE && [x, y].iter().all(|factor| factor.abs() >= PI * NEAR_LINE)
}

impl Psd for RectangularPyramid {
    fn density(&self, fx: f64, fy: f64) -> f64 {
        let (x, y) = (PI * fx * self.sides.0, PI * fy * self.sides.1);
        if self.takes_limits && is_limit(x, y) {
            let limit = (2.0 * y - (2.0 * y).sin()) / (2.0 * y * y * y);
            return self.peak * limit * limit;
        }
        // The means over two neighbouring faces; opposite faces are complex conjugates.
        let right = triangle::tapered(0.0, [x - y, x + y]);
        let back = triangle::tapered(0.0, [x + y, y - x]);
        self.peak * (right + back).re.powi(2)
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use crate::{Mode, psd::tests::build};

    #[test]
    fn small_pyramids_have_the_limit_of_the_diagonal_in_compat_only() {
        let small = [("lengthx", 0.02), ("lengthy", 0.02)];
        let name = "Rectangular_Pyramid_PSD_Function";
        let (sound, compat) = (build(name, Mode::Sound, &small), build(name, Mode::Compat, &small));
        let diagonal = sound.density(0.9, 0.9);
        assert!((compat.density(1.0, 0.9) / diagonal - 1.0).abs() < 1e-9);
        assert!((sound.density(1.0, 0.9) / diagonal - 1.0).abs() > 1e-5);
        assert!((compat.density(0.0, 0.9) / sound.density(0.0, 0.9) - 1.0).abs() < 1e-14);
    }

    #[test]
    fn the_closed_form_holds_away_from_its_singular_lines() {
        let numbers = [("lengthx", 1.5), ("lengthy", 0.9), ("height", 0.02), ("density", 0.03)];
        let psd = build("Rectangular_Pyramid_PSD_Function", Mode::Sound, &numbers);
        for (fx, fy) in [(0.3, 0.2), (1.1, -0.7), (-2.0, 0.4), (0.1, 7.0)] {
            let (lx, ly) = (1.5, 0.9);
            let (x, y) = (PI * fx * lx, PI * fy * ly);
            let top = fy * ly * y.cos() * x.sin() - fx * lx * x.cos() * y.sin();
            let below = PI.powi(3) * (fx.powi(3) * fy * lx * lx - fx * fy.powi(3) * ly * ly);
            let expected = 0.03 * (0.02 * top / below).powi(2);
            assert!((psd.density(fx, fy) / expected - 1.0).abs() < 1e-10, "{fx} {fy}");
        }
    }
}
