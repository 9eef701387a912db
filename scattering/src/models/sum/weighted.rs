//! Common part of the sums of two, three and four models.
//!
//! Sources do not inherit: each must have the wavelength, the type and the substrate of the sum,
//! compared exactly. In NIST's library `Diffuse_Subsurface_BRDF_Model` sets the k of its substrate
//! to 0 in the first evaluation, so that with an absorbing substrate the second one fails
//! ([`Defect::SumAbsorbing`]); compat refuses at once.

use std::slice;

use crate::{
    Basis, Defect, Direction, Incidence, Jones, Mode, Mueller, ParameterError, ParameterNode,
    geometry::beams,
    models::{Brdf, CommonParameters, FAMILY, LobeSupport},
    polarization::change_basis,
    spec::Parameter,
};

/// The class that sets its k to 0 in NIST's library.
const ZEROES_K: &str = "Diffuse_Subsurface_BRDF_Model";

/// The parameters `factorN` and `sourceN` of one source.
pub(super) const fn source(
    factor: &'static str,
    source: &'static str,
    factor_doc: &'static str,
    source_doc: &'static str,
) -> [Parameter; 2] {
    [
        Parameter::number(factor, 1.0, "1", factor_doc),
        Parameter::member(source, &FAMILY, "Microroughness_BRDF_Model", source_doc),
    ]
}

/// One source with its weight.
pub(super) struct WeightedSource {
    factor: f64,
    model: Box<dyn Brdf>,
}

impl WeightedSource {
    /// The source number `number` of `node`.
    pub(super) fn read(
        node: &ParameterNode,
        common: &CommonParameters,
        number: usize,
    ) -> Result<Self, ParameterError> {
        let (factor_name, name) = (format!("factor{number}"), format!("source{number}"));
        let factor = node.number(&factor_name);
        if !(factor >= 0.0 && factor.is_finite()) {
            let problem = format!("{factor} is negative or not finite");
            return Err(ParameterError::new(&factor_name, problem));
        }
        let model = node.member::<dyn Brdf>(&name)?;
        check_same(common, model.common(), &name)?;
        let zeroes_k = node.child(&name).class.name == ZEROES_K;
        if zeroes_k && common.substrate.im != 0.0 && node.reproduces(Defect::SumAbsorbing) {
            let problem = "an absorbing substrate differs from that of the sum, which sees k = 0";
            return Err(ParameterError::new(&format!("{name}.substrate"), problem));
        }
        Ok(Self { factor, model })
    }

    /// The sources 1 to `count` of `node`.
    pub(super) fn read_all(
        node: &ParameterNode,
        common: &CommonParameters,
        count: usize,
    ) -> Result<Vec<Self>, ParameterError> {
        (1..=count).map(|number| Self::read(node, common, number)).collect()
    }

    /// √factor times the source's Jones matrix.
    pub(super) fn jones(&self, incidence: &Incidence, direction: &Direction) -> Option<Jones> {
        Some(self.model.jones(incidence, direction)?.scaled(self.factor.sqrt()))
    }

    /// True if [`WeightedSource::jones`] answers in the basis of the sum.
    pub(super) fn is_coherent(&self) -> bool {
        self.model.is_coherent() && self.model.native_basis() == Basis::Psps
    }
}

fn check_same(
    sum: &CommonParameters,
    source: &CommonParameters,
    name: &str,
) -> Result<(), ParameterError> {
    let error = |parameter: &str, got: String, own: String| {
        let problem = format!("{got} differs from the {own} of the sum");
        Err(ParameterError::new(&format!("{name}.{parameter}"), problem))
    };
    if source.lambda != sum.lambda {
        return error("lambda", source.lambda.to_string(), sum.lambda.to_string());
    }
    if source.side != sum.side {
        return error("type", source.side.number().to_string(), sum.side.number().to_string());
    }
    if source.substrate != sum.substrate {
        return error("substrate", source.substrate.to_string(), sum.substrate.to_string());
    }
    Ok(())
}

/// Σ factor_j F_j.
pub(super) struct WeightedSum {
    pub(super) common: CommonParameters,
    pub(super) sources: Vec<WeightedSource>,
    mode: Mode,
}

impl WeightedSum {
    /// The incoherent sum of `count` sources.
    pub(super) fn read(node: &ParameterNode, count: usize) -> Result<Self, ParameterError> {
        let common = CommonParameters::read(node)?;
        Ok(Self {
            common,
            sources: WeightedSource::read_all(node, &common, count)?,
            mode: node.mode,
        })
    }

    /// Result of `source` in the basis of the sum, times its factor.
    fn weigh(
        &self,
        source: &WeightedSource,
        incidence: &Incidence,
        directions: &[Direction],
        answers: &mut [Mueller],
    ) {
        let from = source.model.native_basis();
        for (m, direction) in answers.iter_mut().zip(directions) {
            if from != Basis::Psps {
                let beams = beams(self.common.side, incidence, direction, self.mode);
                *m = change_basis(*m, from, Basis::Psps, &beams);
            }
            *m *= source.factor;
        }
    }
}

impl Brdf for WeightedSum {
    fn common(&self) -> &CommonParameters {
        &self.common
    }

    fn lobe_supports(&self, incidence: &Incidence) -> Vec<LobeSupport> {
        self.sources.iter().flat_map(|source| source.model.lobe_supports(incidence)).collect()
    }

    fn mueller(&self, incidence: &Incidence, direction: &Direction) -> Mueller {
        let mut out = [Mueller::ZERO];
        self.mueller_batch(incidence, slice::from_ref(direction), &mut out);
        out[0]
    }

    fn mueller_batch(&self, incidence: &Incidence, directions: &[Direction], out: &mut [Mueller]) {
        let (first, others) = self.sources.split_first().expect("a sum has sources");
        first.model.mueller_batch(incidence, directions, out);
        self.weigh(first, incidence, directions, out);
        let mut part = vec![Mueller::ZERO; directions.len()];
        for source in others {
            source.model.mueller_batch(incidence, directions, &mut part);
            self.weigh(source, incidence, directions, &mut part);
            for (sum, m) in out.iter_mut().zip(&part) {
                *sum += *m;
            }
        }
    }
}
