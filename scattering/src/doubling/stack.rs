//! A stack of slabs and faces over an opaque bottom, solved from the bottom up.

use std::{f64::consts::TAU, fmt, sync::Arc};

use num_complex::Complex64;

use super::{
    block::{RealMatrix, TransferBlock},
    expansion::PhaseExpansion,
    flakes::{FlakeKernel, FlakeLayer},
    interface::SmoothFace,
    nodes::{MediumDirections, RayNodes},
    operator::LayerOperator,
    phase_matrix,
    phase_table::PhaseTable,
    rough::{RoughFace, RoughKernel},
    single::SingleSlab,
    slab::{self, SlabMedium},
};

/// A stack at one wavelength, in numbers without unit.
#[derive(Clone, Debug)]
pub struct TransferStack {
    /// Its layers, the uppermost one first.
    pub layers: Vec<TransferLayer>,
    /// The surface below them.
    pub bottom: StackBottom,
}

impl TransferStack {
    /// Index of the medium above layer `j`.
    fn index_above(&self, j: usize) -> f64 {
        j.checked_sub(1).map_or(1.0, |above| self.layers[above].n)
    }
}

/// A slab with the face on it.
#[derive(Clone, Debug)]
pub struct TransferLayer {
    /// Index of the slab, at least 1.
    pub n: f64,
    /// Its upper face.
    pub face: LayerFace,
    /// Scatterers inside.
    pub particles: Option<SlabParticles>,
    /// Optical depth of the binder along the normal.
    pub binder: f64,
    /// Flakes inside.
    pub flakes: Option<FlakeLayer>,
}

/// The upper face of a layer.
#[derive(Clone, Debug)]
pub enum LayerFace {
    /// Plane.
    Smooth(SmoothFace),
    /// With Gaussian facets.
    Rough(RoughFace),
}

impl Default for LayerFace {
    fn default() -> Self {
        Self::Smooth(SmoothFace::default())
    }
}

/// Scatterers of all kinds together.
#[derive(Clone, Debug)]
pub struct SlabParticles {
    /// Their extinction depth along the normal.
    pub depth: f64,
    /// Scattering over extinction.
    pub albedo: f64,
    /// Expansion of the phase matrix.
    pub series: PhaseExpansion,
    /// The complete phase matrix; with `None`, light scattered once is computed by modes too.
    pub whole: Option<Arc<PhaseTable>>,
}

/// A surface of any kind below a medium: the modes of its BRDF at the nodes there.
pub trait SurfaceModes: Send + Sync + fmt::Debug {
    /// f₊ of the modes 0 … `last` at `directions`, 1/sr, with rows 4·node + component.
    fn modes(&self, directions: &MediumDirections, last: usize) -> Vec<RealMatrix>;
}

/// The surface below all layers.
#[derive(Clone, Debug)]
pub enum StackBottom {
    /// Black.
    Black,
    /// A Lambertian of this reflectance.
    Lambertian(f64),
    /// A smooth substrate with films.
    Mirror(SmoothFace, Complex64),
    /// Any other surface.
    Surface(Arc<dyn SurfaceModes>),
}

/// All light, or the light that is not scattered.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum LightPart {
    All,
    Direct,
}

/// Numbers of nodes and orders.
#[derive(Clone, Copy, Debug)]
pub struct AngularResolution {
    /// Nodes up to κ = 1.
    pub outside: usize,
    /// Nodes in each further segment.
    pub trapped: usize,
    /// The largest l of phase matrices.
    pub order: usize,
    /// The last azimuthal mode of facets and flakes.
    pub modes: usize,
}

/// A stack with its nodes.
#[derive(Clone, Debug)]
pub struct TransferProblem<'a> {
    stack: &'a TransferStack,
    nodes: RayNodes,
    /// Phase matrices after δ–M: series, scattering depth, extinction depth.
    scaled: Vec<Option<ScaledParticles>>,
    flakes: Vec<Option<FlakeKernel>>,
    rough: Vec<Option<Arc<RoughKernel>>>,
    /// f₊ of the surface below all layers.
    surface: Arc<Vec<RealMatrix>>,
}

/// Scatterers without the forward peak.
#[derive(Clone, Debug)]
struct ScaledParticles {
    series: PhaseExpansion,
    /// τ'ω'.
    scattering: f64,
    /// τ'.
    extinction: f64,
}

impl<'a> TransferProblem<'a> {
    /// The transfer problem of `stack`; `extra` cosines outside become nodes of no weight.
    pub fn new(stack: &'a TransferStack, resolution: &AngularResolution, extra: &[f64]) -> Self {
        let indices: Vec<f64> = stack.layers.iter().map(|layer| layer.n).collect();
        let nodes = RayNodes::new(&indices, resolution.outside, resolution.trapped, extra);
        let scaled = |layer: &TransferLayer| {
            let particles = layer.particles.as_ref()?;
            let (series, f) = particles.series.truncated(resolution.order);
            let peak = particles.albedo * f;
            let extinction = particles.depth * (1.0 - peak);
            let scattering = particles.depth * particles.albedo * (1.0 - f);
            Some(ScaledParticles { series, scattering, extinction })
        };
        let scaled = stack.layers.iter().map(scaled).collect();
        let flakes = |layer: &TransferLayer| {
            let flakes = layer.flakes.as_ref()?;
            Some(flakes.kernel(&nodes.inside(layer.n), resolution.modes))
        };
        let flakes = stack.layers.iter().map(flakes).collect();
        let rough = |(j, layer): (usize, &TransferLayer)| match &layer.face {
            LayerFace::Rough(face) => {
                Some(face.kernel(&nodes, stack.index_above(j), layer.n, resolution.modes))
            }
            LayerFace::Smooth(_) => None,
        };
        let rough = stack.layers.iter().enumerate().map(rough).collect();
        let surface = match &stack.bottom {
            StackBottom::Surface(surface) => {
                let last = stack.layers.last().map_or(1.0, |layer| layer.n);
                surface.modes(&nodes.inside(last), resolution.modes)
            }
            _ => Vec::new(),
        };
        Self { stack, nodes, scaled, flakes, rough, surface: Arc::new(surface) }
    }

    /// The directions outside.
    pub fn outside(&self) -> MediumDirections {
        self.nodes.inside(1.0)
    }

    /// The complete reflection, with the direct light.
    pub fn reflection(&self, block: TransferBlock) -> RealMatrix {
        self.solve(block, LightPart::All)
    }

    /// Reflection of unscattered light, for every node outside.
    pub fn direct(&self) -> Vec<RealMatrix> {
        let at = |i: usize| {
            let flakes = |kernel: &Option<FlakeKernel>| {
                let extinction = vec![kernel.as_ref()?.extinction[i]];
                Some(FlakeKernel { extinction, modes: Vec::new() })
            };
            let alone = Self {
                stack: self.stack,
                nodes: self.nodes.only(i),
                scaled: self.scaled.clone(),
                flakes: self.flakes.iter().map(flakes).collect(),
                rough: Vec::new(),
                surface: Arc::new(Vec::new()),
            };
            alone.solve(TransferBlock::Mode(1), LightPart::Direct)
        };
        (0..self.outside().len()).map(at).collect()
    }

    /// One reflection at the facets of the uppermost face, in mode `m`; nothing if it is smooth.
    pub fn first_reflection(&self, m: usize) -> Option<&RealMatrix> {
        self.rough.first()?.as_ref()?.first.get(m)
    }

    /// Light scattered once in every slab that is seen through smooth faces.
    pub fn singles(&self) -> Vec<SingleSlab> {
        self.single_slabs().into_iter().map(|(_, slab)| slab).collect()
    }

    /// The same with the number of the layer.
    fn single_slabs(&self) -> Vec<(usize, SingleSlab)> {
        let (mut faces, mut found) = (Vec::new(), Vec::new());
        for (j, layer) in self.stack.layers.iter().enumerate() {
            let LayerFace::Smooth(face) = &layer.face else { break };
            let scaled = self.scaled[j].as_ref();
            let depth = layer.binder + scaled.map_or(0.0, |s| s.extinction);
            faces.push((face.clone(), layer.n, depth));
            if layer.flakes.is_some() {
                break;
            }
            let Some(particles) = &layer.particles else { continue };
            let scattering = particles.depth * particles.albedo;
            if let (Some(phase), true) = (&particles.whole, depth > 0.0) {
                let slab = SingleSlab { faces: faces.clone(), scattering, phase: phase.clone() };
                found.push((j, slab));
            }
        }
        found
    }

    /// Mode `m` of light scattered once with the cut phase matrices, f₊ between the nodes outside
    /// (1/sr), of a block.
    pub fn single_modes(&self, block: TransferBlock) -> RealMatrix {
        let count = self.outside().len();
        let size = block.size();
        let mut sum = RealMatrix::zeros(size * count, size * count);
        for (j, single) in self.single_slabs() {
            let Some(scaled) = &self.scaled[j] else { continue };
            let inside = self.nodes.inside(self.stack.layers[j].n);
            let first = MediumDirections {
                n: inside.n,
                mu: inside.mu[..count].to_vec(),
                w: vec![1.0; count],
            };
            let (_, up) = phase_matrix::modes(block, &first, &scaled.series);
            let rays: Vec<_> = (0..count).map(|i| single.ray(self.nodes.kappa(i))).collect();
            let passes = block.diagonal((count, count, count), |i| rays[i].passes);
            let f = RealMatrix::from_fn(size * count, size * count, |a, b| {
                let (mu_s, mu_i) = (rays[a / size].mu, rays[b / size].mu);
                up[(a, b)] / TAU * single.strength(scaled.scattering, mu_i, mu_s)
            });
            sum += &passes * f * &passes;
        }
        sum
    }

    fn solve(&self, block: TransferBlock, light: LightPart) -> RealMatrix {
        let layers = &self.stack.layers;
        let mut below = self.bottom(block, light, layers.last().map_or(1.0, |layer| layer.n));
        for (j, layer) in layers.iter().enumerate().rev() {
            let directions = self.nodes.inside(layer.n);
            if let Some(slab) = self.slab(block, light, j, &directions) {
                below = slab.over_opaque(&below);
            }
            below = self.face(block, light, j).over_opaque(&below);
        }
        below
    }

    /// The upper face of layer `j`.
    fn face(&self, block: TransferBlock, light: LightPart, j: usize) -> LayerOperator {
        let layer = &self.stack.layers[j];
        let above = self.stack.index_above(j);
        match &layer.face {
            LayerFace::Smooth(face) => face.operator(block, &self.nodes, above, layer.n),
            LayerFace::Rough(_) => {
                let kernel = self.rough.get(j).and_then(Option::as_ref);
                let mode = kernel.and_then(|kernel| kernel.modes.get(block.mode()));
                match mode {
                    Some(mode) if light == LightPart::All => mode.of_whole(block),
                    _ => {
                        let size = block.size();
                        let [a, b] = [above, layer.n].map(|n| size * self.nodes.inside(n).len());
                        LayerOperator::opaque(a, b)
                    }
                }
            }
        }
    }

    /// The slab of layer `j`; `None` if it is empty.
    fn slab(
        &self,
        block: TransferBlock,
        light: LightPart,
        j: usize,
        directions: &MediumDirections,
    ) -> Option<LayerOperator> {
        let layer = &self.stack.layers[j];
        let mut medium = SlabMedium::clear(block, directions, layer.binder);
        let scaled = self.scaled[j].as_ref();
        if let Some(ScaledParticles { series, scattering, extinction }) = scaled {
            let n = medium.down.nrows();
            let (mut down, mut up) = match light {
                LightPart::All => phase_matrix::modes(block, directions, series),
                LightPart::Direct => (RealMatrix::zeros(n, n), RealMatrix::zeros(n, n)),
            };
            if light == LightPart::All {
                slab::close(block, directions, &mut down, &mut up);
            }
            medium.add(*scattering, (&down, &up), *extinction);
        }
        if let Some(flakes) = &self.flakes[j] {
            medium.add_flakes(block, flakes);
        }
        let is_empty = layer.flakes.is_none()
            && layer.binder == 0.0
            && scaled.is_none_or(|s| s.extinction == 0.0);
        (!is_empty).then(|| medium.operator(block, directions))
    }

    fn bottom(&self, block: TransferBlock, light: LightPart, n: f64) -> RealMatrix {
        let directions = self.nodes.inside(n);
        let count = directions.len();
        let size = block.size() * count;
        match &self.stack.bottom {
            StackBottom::Lambertian(rho)
                if light == LightPart::All && block == TransferBlock::Intensity =>
            {
                let root = |row: usize| directions.root_flux(row / 2);
                let both = |i: usize, j: usize| i.is_multiple_of(2) && j.is_multiple_of(2);
                RealMatrix::from_fn(size, size, |i, j| {
                    if both(i, j) { 2.0 * rho * root(i) * root(j) } else { 0.0 }
                })
            }
            StackBottom::Mirror(films, index) => {
                block.diagonal((count, count, count), |i| films.mirror(&self.nodes, i, n, *index))
            }
            StackBottom::Surface(_) => match self.surface.get(block.mode()) {
                Some(f) if light == LightPart::All => {
                    let root = |row: usize| directions.root_flux(row / block.size());
                    let f = block.of_whole(f);
                    RealMatrix::from_fn(size, size, |i, j| TAU * f[(i, j)] * root(i) * root(j))
                }
                _ => RealMatrix::zeros(size, size),
            },
            StackBottom::Black | StackBottom::Lambertian(_) => RealMatrix::zeros(size, size),
        }
    }
}
