//! The axes of a `.pbsdf`.

use std::io::{Read, Seek};

use crate::tensor::{TensorError, TensorReader};

/// The checked axes of a file.
#[derive(Clone, Debug)]
pub(super) struct PbsdfHeader {
    /// φ_d, θ_d, θ_h in radians, then nm.
    pub(super) axes: [Vec<f64>; 4],
}

impl PbsdfHeader {
    /// Reads and checks the axes.
    pub(super) fn read<R: Read + Seek>(file: &mut TensorReader<R>) -> Result<Self, TensorError> {
        let mut axis = |name: &str| {
            let nodes = file.numbers(name)?;
            let rising = nodes.windows(2).all(|pair| pair[0] < pair[1]);
            if nodes.is_empty() || !rising || nodes.iter().any(|x| !x.is_finite()) {
                return Err(TensorError::field(name, "expected rising nodes"));
            }
            Ok(nodes)
        };
        let axes = [axis("phi_d")?, axis("theta_d")?, axis("theta_h")?, axis("wvls")?];
        let expected = axes.iter().map(|nodes| nodes.len() as u64).chain([4, 4]);
        let (expected, found): (Vec<u64>, _) = (expected.collect(), &file.field("M")?.shape);
        if expected != *found {
            let problem = format!("its shape is {found:?}, but the axes say {expected:?}");
            return Err(TensorError::field("M", problem));
        }
        Ok(Self { axes })
    }

    /// Numbers of all θ_h and wavelengths at one φ_d and θ_d.
    pub(super) fn row(&self) -> usize {
        self.axes[2].len() * self.axes[3].len() * 16
    }
}
