//! Mueller BRDF tabulated as products of Zernike functions of the two directions; made for white
//! standards such as sintered PTFE.
//!
//! A direction is a point of the unit disk with the radius ρ = √2 sin(θ/2), which maps equal
//! solid angles to equal areas, and its azimuth as seen by the sample: π − r for the source,
//! φ_s − r for the viewer, r the rotation. With
//!
//! $$ Z_n^k = R_n^{|k|}(\rho) \times \begin{cases} \cos k\varphi & k > 0 \\
//!    1/\sqrt 2 & k = 0 \\ -\sin k\varphi & k < 0 \end{cases} $$
//!
//! a line `i j n m k l p c` of the coefficient file adds to element ij (1 to 4, i ≤ j) of a
//! reduced matrix m, in the xyxy basis,
//!
//! $$ c \lambda^p \frac{\sqrt{(n+1)(m+1)}}{\pi}\, Z_n^k(i) Z_m^l(s) $$
//!
//! and the same with the directions exchanged to element ji; diagonal elements get the symmetric
//! sum over √(2 + 2δ_nm δ_kl). Lines with i = j = 1 build the unpolarized BRDF
//!
//! $$ B \mathrel{+}= c \lambda^p \frac{1}{2\pi} \sqrt{\frac{(n+1)(m+1)}{q}}
//!    [R_n^l(\rho_i) R_m^l(\rho_s) + R_m^l(\rho_i) R_n^l(\rho_s)] \cos l(\varphi_s - \varphi_i) $$
//!
//! with q = 4 if n = 0 or (n = m and l = 0), else 2 if n = m or l = 0, else 1. The result is
//! F = `scale` · B · m with m_11 = 1 and the signs of m_31, m_32 and m_43 turned. NIST's library
//! computes λ³ as λ² ([`Defect::ZernikePower`]).
//!
//! J. J. Koenderink and A. J. van Doorn, *Phenomenological description of bidirectional surface
//! reflection*, J. Opt. Soc. Am. A 15, 2903 (1998); T. A. Germer, *Full four-dimensional and
//! reciprocal Mueller matrix bidirectional reflectance distribution function of sintered
//! polytetrafluoroethylene*, Appl. Opt. 56, 9333 (2017).

use std::{f64::consts::PI, slice};

use crate::{
    Basis, Defect, Direction, Incidence, Mueller, ParameterError,
    models::{Brdf, COMMON, CommonParameters},
    spec::{Class, Laws, Parameter, Spec},
};

mod harmonics;
mod line;

use harmonics::ZernikeFunctions;
use line::CoefficientLine;

/// Name, parameters and constructor of a [`ZernikeExpansion`].
pub const SPEC: Spec<dyn Brdf> = Spec {
    class: Class {
        name: "ZernikeExpansion_BRDF_Model",
        parent: "BRDF_Model",
        summary: "Tabulated Mueller BRDF in products of Zernike functions",
        equation: "F = scale B m, B and m sums of c lambda^p Z(source) Z(viewer)",
        source: "koenderink-1998 germer-2017",
        params: &[
            COMMON,
            &[
                Parameter::file(
                    "coefficientfile",
                    "Lines `i j n m k l p c`, separated by blanks or commas",
                ),
                Parameter::table("scale", 1.0, "1", "Factor as a function of wavelength (um)"),
            ],
        ],
        laws: Laws::NONE,
    },
    build: |node| {
        let common = CommonParameters::read(node)?;
        common.only_reflection("ZernikeExpansion_BRDF_Model")?;
        let lines = line::read(node.text("coefficientfile"))
            .map_err(|problem| ParameterError::new("coefficientfile", problem))?;
        let mut zernike = ZernikeExpansion {
            common,
            scale: node.table("scale").at(common.lambda),
            harmonics: ZernikeFunctions::default(),
            products: Vec::new(),
        };
        for line in lines {
            // NIST's λ³ is λ².
            let power =
                if line.p == 3 && node.reproduces(Defect::ZernikePower) { 2 } else { line.p };
            zernike.add(&line, line.c * common.lambda.powi(power));
        }
        Ok(Box::new(zernike))
    },
};

/// A BRDF as a sum of products of Zernike functions.
#[derive(Clone, Debug)]
pub struct ZernikeExpansion {
    common: CommonParameters,
    scale: f64,
    harmonics: ZernikeFunctions,
    products: Vec<ZernikeProduct>,
}

/// weight · Z_source · Z_viewer, added to element (row, column); B stands at (0, 0).
#[derive(Clone, Copy, Debug)]
struct ZernikeProduct {
    row: usize,
    column: usize,
    source: usize,
    viewer: usize,
    weight: f64,
}

impl ZernikeExpansion {
    fn add(&mut self, line: &CoefficientLine, strength: f64) {
        let CoefficientLine { i, j, n, m, k, l, .. } = *line;
        let root = f64::from((n + 1) * (m + 1)).sqrt() / PI * strength;
        if (i, j) == (1, 1) {
            return self.add_unpolarized(n, m, l, 0.5 * root);
        }
        let weight = if i != j {
            root
        } else if (n, k) == (m, l) {
            0.5 * root
        } else {
            root / 2f64.sqrt()
        };
        let (first, second) = (self.harmonics.place(n, k), self.harmonics.place(m, l));
        self.push((i, j), first, second, weight);
        self.push((j, i), second, first, weight);
    }

    /// cos l(φ_s − φ_i) is the sum of the products of the two harmonics of order ±l.
    fn add_unpolarized(&mut self, n: u32, m: u32, l: i32, weight: f64) {
        let q: f64 = if n == 0 || (n == m && l == 0) {
            4.0
        } else if n == m || l == 0 {
            2.0
        } else {
            1.0
        };
        let weight = weight / q.sqrt();
        for order in [l, -l] {
            let (first, second) = (self.harmonics.place(n, order), self.harmonics.place(m, order));
            self.push((1, 1), first, second, weight);
            self.push((1, 1), second, first, weight);
        }
    }

    fn push(&mut self, (i, j): (usize, usize), source: usize, viewer: usize, weight: f64) {
        let (row, column) = (i - 1, j - 1);
        let turned = matches!((row, column), (2, 0) | (2, 1) | (3, 2));
        let weight = if turned { -weight } else { weight };
        self.products.push(ZernikeProduct { row, column, source, viewer, weight });
    }

    fn sum(&self, source: &[f64], viewer: &[f64]) -> Mueller {
        let mut m = Mueller::ZERO;
        for product in &self.products {
            m[(product.row, product.column)] +=
                product.weight * source[product.source] * viewer[product.viewer];
        }
        let unpolarized = self.scale * m[(0, 0)];
        m[(0, 0)] = 1.0;
        m * unpolarized
    }
}

impl Brdf for ZernikeExpansion {
    fn common(&self) -> &CommonParameters {
        &self.common
    }

    fn mueller(&self, incidence: &Incidence, direction: &Direction) -> Mueller {
        let mut out = [Mueller::ZERO];
        self.mueller_batch(incidence, slice::from_ref(direction), &mut out);
        out[0]
    }

    fn mueller_batch(&self, incidence: &Incidence, directions: &[Direction], out: &mut [Mueller]) {
        let mut source = vec![0.0; self.harmonics.len()];
        let mut viewer = source.clone();
        self.harmonics.evaluate(incidence.theta(), PI - incidence.rotation(), &mut source);
        for (m, direction) in out.iter_mut().zip(directions) {
            let azimuth = direction.phi() - incidence.rotation();
            self.harmonics.evaluate(direction.theta(), azimuth, &mut viewer);
            *m = self.sum(&source, &viewer);
        }
    }

    fn native_basis(&self) -> Basis {
        Basis::Xyxy
    }
}

#[cfg(test)]
mod tests {
    use super::SPEC;
    use crate::{
        Basis, Geometry, Mode, Model, ParameterError, ParameterNode, models, spec::ParameterValue,
    };

    fn model(text: &str, mode: Mode) -> Result<Model, ParameterError> {
        let node = ParameterNode::with_defaults(&SPEC.class, mode);
        models::build(&node.with("coefficientfile", ParameterValue::Text(text.into())).unwrap())
    }

    const AT: Geometry = Geometry { theta_i: 0.9, theta_s: 0.4, phi_s: 1.2, rotation: 0.3 };

    #[test]
    fn the_constant_term_is_a_white_lambertian() {
        let m = model("1 1 0 0 0 0 0 1\n", Mode::Sound).unwrap().mueller(&AT, Basis::Xyxy);
        // q = 4 and two equal products: (1/2π)·½·2.
        assert!((m[(0, 0)] * 2.0 * std::f64::consts::PI - 1.0).abs() < 1e-14);
        assert_eq!(m[(1, 1)], 0.0);
    }

    #[test]
    fn the_third_power_of_the_wavelength_is_compats_second() {
        let f = |p: i32, mode| {
            let text = format!("1,1,0,0,0,0,{p},1");
            model(&text, mode).unwrap().mueller(&AT, Basis::Xyxy)[(0, 0)]
        };
        assert_eq!(f(3, Mode::Compat), f(2, Mode::Compat));
        assert!((f(3, Mode::Sound) / f(2, Mode::Sound) - 0.532).abs() < 1e-15);
    }

    #[test]
    fn lines_that_cannot_be_read_are_named() {
        for text in ["", "1 1 0 0 0 0 0", "2 1 0 0 0 0 0 1", "1 5 0 0 0 0 0 1", "1 1 0 0 0 0 x 1"] {
            assert_eq!(model(text, Mode::Sound).err().unwrap().parameter, "coefficientfile");
        }
    }
}
