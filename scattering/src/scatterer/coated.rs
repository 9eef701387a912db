//! Coated sphere: a core of radius r − t in a shell of thickness t.
//!
//! The coefficients of [`layered`](super::layered) with two layers.
//!
//! A. L. Aden and M. Kerker, J. Appl. Phys. 22, 1242 (1951); C. F. Bohren and D. R. Huffman,
//! *Absorption and Scattering of Light by Small Particles* (Wiley, 1983), 8.1.

use super::{FREE_SPACE, HostMedium, SPHERE, Scatterer, mie::Mie, series};
use crate::{
    ParameterNode,
    spec::{Class, Laws, Parameter, ParameterError, Spec},
};

/// Name, parameters and constructor of a coated sphere.
pub const SPEC: Spec<dyn Scatterer> = Spec {
    class: Class {
        name: "CoatedMieScatterer",
        parent: "SphericalScatterer",
        summary: "Sphere with a coat",
        equation: "Mie series with the coefficients of two layers",
        source: "aden-kerker-1951 bohren-huffman-1983",
        params: &[
            FREE_SPACE,
            SPHERE,
            &[
                Parameter::index("coating", (1.0, 0.0), "Index of the coat"),
                Parameter::number(
                    "thickness",
                    0.0,
                    "um",
                    "Thickness of the coat, inside the radius",
                ),
                Parameter::integer(
                    "nmax",
                    0,
                    "Terms of the series: 0 as many as needed, -n that many less, n exactly n",
                ),
            ],
        ],
        laws: Laws::NONE,
    },
    build: |node| {
        let around = HostMedium::read(node)?;
        let sphere = around.relative_index(node, "sphere")?;
        let coating = around.relative_index(node, "coating")?;
        let radius = around.radius(node, &[sphere, coating])?;
        let thickness = node.number("thickness");
        if !(0.0..=radius).contains(&thickness) {
            let problem = format!("{thickness} um is not from 0 to the radius {radius} um");
            return Err(ParameterError::new("thickness", problem));
        }
        let k = around.wave_number();
        let core = (sphere, k * (radius - thickness));
        let coat = (coating, k * radius);
        let needed = match node.integer("nmax") {
            0 => series::terms_for(node, k * radius),
            _ => series::terms(k * radius),
        };
        let terms = terms(node, needed)?;
        Ok(Box::new(Mie::layered(around, &[core, coat], terms)))
    },
};

/// The number of terms that `nmax` requests if the size needs `needed`.
fn terms(node: &ParameterNode, needed: usize) -> Result<usize, ParameterError> {
    /// Larger spheres than any that a series of this length describes are not built.
    const MOST: i64 = 1_000_000;
    let nmax = i64::from(node.integer("nmax"));
    let terms = if nmax > 0 { nmax } else { needed as i64 + nmax };
    if (1..=MOST).contains(&terms) {
        return Ok(terms as usize);
    }
    Err(ParameterError::new("nmax", format!("{nmax} leaves {terms} of {needed} terms")))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        Mode, ParameterValue,
        optics::RefractiveIndex,
        spec::{self, ParameterError},
    };

    fn build(thickness: f64, nmax: i32) -> Result<Box<dyn Scatterer>, ParameterError> {
        let index = |n, k| ParameterValue::Index(RefractiveIndex::constant(n, k));
        let node = ParameterNode::with_defaults(&SPEC.class, Mode::Sound)
            .with("radius", ParameterValue::Number(0.3))?
            .with("sphere", index(1.7, 0.02))?
            .with("coating", index(1.4, 0.3))?
            .with("thickness", ParameterValue::Number(thickness))?
            .with("nmax", ParameterValue::Integer(nmax))?;
        spec::build::<dyn Scatterer>(&node)
    }

    #[test]
    fn a_coat_of_the_whole_radius_is_a_sphere_of_its_material() {
        let around = HostMedium { lambda: 0.532, medium: 1.0.into() };
        let node = ParameterNode::with_defaults(&SPEC.class, Mode::Sound);
        let expected = Mie::homogeneous(&node, around, num_complex::Complex64::new(1.4, 0.3), 0.3);
        let got = build(0.3, 0).unwrap().round().unwrap().cross_sections().unwrap();
        let expected = expected.series().cross_sections(around.wave_number());
        assert!((got.extinction / expected.extinction - 1.0).abs() < 1e-14);
    }

    #[test]
    fn more_terms_than_needed_change_nothing_and_no_terms_are_refused() {
        let at = |nmax| build(0.1, nmax).unwrap().round().unwrap().cross_sections().unwrap();
        // The terms left out are below those of the rule for their number.
        assert!((at(40).extinction / at(0).extinction - 1.0).abs() < 1e-9);
        assert!((at(-8).extinction / at(0).extinction - 1.0).abs() > 1e-9);
        assert_eq!(build(0.1, -1000).err().unwrap().parameter, "nmax");
        assert_eq!(build(0.31, 0).err().unwrap().parameter, "thickness");
    }
}
