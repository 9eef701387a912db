//! The colour table of a material: spectra over patches, coloured for a renderer.
//!
//! The model is built once per wavelength; directions are shared by all angles of incidence and
//! evaluated in batches; the bits do not depend on the number of threads. Nodes at or below the
//! horizon are filled from 89.9° and flagged.

mod patches;

use std::f64::consts::PI;

use rayon::prelude::*;
use scattering::{Incidence, Mode, Model, Mueller, Stokes};
use spectra::{ColourPlan, ColourSettings, Grid, Quantity};

use patches::{IncidenceGroup, PatchTarget, check, of_grid, of_list, symmetry};

use super::{
    MaterialError, PreparedMaterial,
    patch::{ACCURACY, PatchMeans, Probes},
};
use crate::{
    Control, Warning,
    colour::{
        self, Albedo, ColourRow, ColourTable, RowOrder, TableAxis,
        fold::{coloured, interpolation},
    },
    integrate::integrate,
    region::Region,
    request::{GridPatch, Patch, TableDirections, TableRequest},
    sampling::{
        Layout, PlaneSampling,
        adaptive::{self, Accuracy},
    },
};

/// Accuracy of a hemispherical reflectance.
const ALBEDO: Accuracy = Accuracy { tolerance: 1e-6, budget: 400_000, is_required: false };

/// The colour table of `material`.
///
/// # Errors
///
/// For requests that cannot be served, values that the model cannot take, limits, a model that
/// is not finite somewhere, and a cancellation.
pub fn table(
    material: &PreparedMaterial,
    request: &TableRequest,
    control: &Control,
) -> Result<ColourTable, MaterialError> {
    let colours = Colours::new(&request.wavelengths, &request.settings)?;
    let material = &material.with_own_warnings();
    let work = TableComputation::new(material, request)?;
    let components = if request.stokes || !request.settings.filters.is_empty() { 4 } else { 1 };
    let scale = scale(request.settings.quantity);
    let mut rows: Vec<Option<ColourRow>> = (0..work.rows).map(|_| None).collect();
    let (mut albedo, mut dark) = (Vec::new(), true);
    let mut unmet: Option<UnmetPatch> = None;
    for (number, group) in work.groups.iter().enumerate() {
        let (means, missed) = work.means(group, control)?;
        if missed.as_ref().is_some_and(|one| unmet.as_ref().is_none_or(|u| u.reached < one.reached))
        {
            unmet = missed;
        }
        let light = Stokes(request.incident);
        let finished: Vec<ColourRow> = (0..group.rows.len())
            .into_par_iter()
            .map(|k| {
                let mut spectra: [Vec<f64>; 4] = Default::default();
                for (component, spectrum) in spectra.iter_mut().enumerate().take(components) {
                    let value = |m: &Vec<Mueller>| scale * (m[k] * light).0[component];
                    *spectrum = means.iter().map(value).collect();
                }
                group.row(k, &work, &colours.plan, spectra)
            })
            .collect();
        for (row, at) in finished.into_iter().zip(&group.rows) {
            if let Some(nm) = first_not_finite(&row, &request.wavelengths) {
                let ColourRow { thetai, thetas, phis, .. } = row;
                let place = format!("thetai {thetai}, thetas {thetas}, phis {phis}, {nm} nm");
                return Err(MaterialError::NotFinite(place));
            }
            dark &= row.spectra[3].iter().all(|v| *v == 0.0);
            rows[at.row] = Some(row);
        }
        if matches!(request.directions, TableDirections::Grid(_)) {
            albedo.push(work.albedo(group, &colours, control)?);
        }
        control.report((number + 1) as f64 / work.groups.len() as f64);
    }
    let stokes = match (request.stokes, dark) {
        (false, _) => 1,
        (true, true) => 3,
        (true, false) => 4,
    };
    let head = TableHead {
        material: request.material.clone(),
        incident: request.incident,
        frame: request.basis.name(),
        layout: layout(&request.directions),
        patch: patch_name(&request.directions),
        leading: Vec::new(),
        stokes,
    };
    let table = colours.table(head, rows.into_iter().flatten().collect(), albedo);
    let warnings = request.warnings().into_iter().chain(material.warnings());
    let warnings = warnings.chain(unmet.map(|unmet| unmet.warning())).collect();
    Ok(ColourTable { warnings, ..table })
}

/// A patch whose integral has not reached its tolerance.
struct UnmetPatch {
    /// thetai, thetas, phis, degrees.
    angles: [f64; 3],
    /// The relative error reached.
    reached: f64,
}

impl UnmetPatch {
    fn message(&self) -> String {
        let ([thetai, thetas, phis], reached) = (self.angles, self.reached);
        let (tolerance, budget) = (ACCURACY.tolerance, ACCURACY.budget);
        format!(
            "thetai {thetai}, thetas {thetas}, phis {phis}: the relative error of the mean is \
             {reached:.1e} after {budget} evaluations of the model, more than {tolerance:e}"
        )
    }

    fn warning(&self) -> Warning {
        let help = "leave the direction of the mirror out, or take smaller patches";
        Warning::new("integral/accuracy", self.message() + "; the value stands").help(help)
    }
}

/// Factor from a BRDF (1/sr) to `quantity`.
pub(super) fn scale(quantity: Quantity) -> f64 {
    if quantity == Quantity::Factor { PI } else { 1.0 }
}

/// The mean Mueller BRDF of a patch, per wavelength.
#[derive(Clone, Debug, PartialEq)]
pub struct MuellerRow {
    /// thetai, thetas, phis as they were asked for, degrees.
    pub angles: [f64; 3],
    /// Projected solid angle, sr; 0 for a point.
    pub omega: f64,
    /// One matrix (1/sr) per wavelength.
    pub matrices: Vec<Mueller>,
    /// As [`ColourRow::flags`].
    pub flags: u8,
}

/// The mean Mueller BRDFs of every patch, in the order of the request.
///
/// # Errors
///
/// As [`table`], and for a patch whose integral does not reach its tolerance.
pub fn mueller(
    material: &PreparedMaterial,
    request: &TableRequest,
    control: &Control,
) -> Result<Vec<MuellerRow>, MaterialError> {
    let work = TableComputation::new(material, request)?;
    let mut rows: Vec<Option<MuellerRow>> = (0..work.rows).map(|_| None).collect();
    for (number, group) in work.groups.iter().enumerate() {
        let (means, unmet) = work.means(group, control)?;
        if let Some(unmet) = unmet {
            return Err(MaterialError::Limit(unmet.message()));
        }
        for (k, PatchTarget { row, angles, flags }) in group.rows.iter().enumerate() {
            let matrices: Vec<Mueller> = means.iter().map(|m| m[k]).collect();
            let finite = |m: &Mueller| m.to_row_major().iter().all(|x| x.is_finite());
            if let Some(at) = matrices.iter().position(|m| !finite(m)) {
                let [thetai, thetas, phis] = angles;
                let nm = request.wavelengths[at];
                let place = format!("thetai {thetai}, thetas {thetas}, phis {phis}, {nm} nm");
                return Err(MaterialError::NotFinite(place));
            }
            let omega = work.probes[group.probes].omegas[k];
            let done = MuellerRow { angles: *angles, omega, matrices, flags: *flags };
            rows[*row] = Some(done);
        }
        control.report((number + 1) as f64 / work.groups.len() as f64);
    }
    Ok(rows.into_iter().flatten().collect())
}

/// Conversion of the rows of one table to colours.
pub(super) struct Colours {
    grid: Grid,
    pub(super) plan: ColourPlan,
    /// For reflectances, without filters.
    reflectance: ColourPlan,
}

/// Fields of the header of a table, except for its colours.
pub(super) struct TableHead {
    pub(super) material: String,
    pub(super) incident: [f64; 4],
    pub(super) frame: &'static str,
    pub(super) layout: RowOrder,
    pub(super) patch: colour::RowPatch,
    pub(super) leading: Vec<String>,
    pub(super) stokes: usize,
}

impl Colours {
    pub(super) fn new(
        wavelengths: &[f64],
        settings: &ColourSettings,
    ) -> Result<Self, MaterialError> {
        let grid =
            Grid::new(wavelengths).map_err(|error| MaterialError::request("wavelengths", error))?;
        let plan = |settings| {
            ColourPlan::new(&grid, settings)
                .map_err(|error| MaterialError::request("adaptation", error))
        };
        let own = plan(settings.clone())?;
        let reflectance = plan(ColourSettings {
            quantity: Quantity::Reflectance,
            filters: Vec::new(),
            ..settings.clone()
        })?;
        Ok(Self { grid, plan: own, reflectance })
    }

    pub(super) fn table(
        &self,
        head: TableHead,
        rows: Vec<ColourRow>,
        albedo: Vec<Albedo>,
    ) -> ColourTable {
        let settings = self.plan.settings();
        ColourTable {
            material: head.material,
            quantity: format!("{} {}", settings.quantity.name(), settings.quantity.unit()),
            incident: head.incident,
            frame: head.frame.to_owned(),
            wavelengths: self.grid.nm().to_vec(),
            interpolation: interpolation(&self.grid, settings.outside),
            illuminant: settings.illuminant.name().to_owned(),
            observer: settings.observer.name().to_owned(),
            space: settings.space.name().to_owned(),
            adaptation: settings.adaptation.name().to_owned(),
            white: self.plan.white().map_or([0.0; 3], |white| [white.x, white.y, white.z]),
            layout: head.layout,
            patch: head.patch,
            leading: head.leading,
            stokes: head.stokes,
            rows,
            albedo,
            warnings: Vec::new(),
        }
    }
}

/// All that is to be evaluated.
struct TableComputation<'a> {
    request: &'a TableRequest,
    models: Vec<Model>,
    probes: Vec<Probes>,
    groups: Vec<IncidenceGroup>,
    rows: usize,
    mode: Mode,
}

impl<'a> TableComputation<'a> {
    fn new(material: &PreparedMaterial, request: &'a TableRequest) -> Result<Self, MaterialError> {
        check(request)?;
        let mode = material.mode();
        let usual = (mode == Mode::Compat).then(PlaneSampling::default);
        let plane = request.sampling.or(usual);
        let (probes, groups, rows) = match &request.directions {
            TableDirections::Grid(grid) => of_grid(grid, request, plane.as_ref())?,
            TableDirections::List(list) => of_list(list, request, plane.as_ref())?,
        };
        let each = |group: &IncidenceGroup| probes[group.probes].cost() as f64;
        let cost = groups.iter().map(each).sum::<f64>() * request.wavelengths.len() as f64;
        if cost > request.limits.evaluations {
            let limit = request.limits.evaluations;
            let message = format!("the table needs {cost:.3e} evaluations, more than {limit:e}");
            return Err(MaterialError::Limit(message));
        }
        let models = material.models(&request.wavelengths)?;
        Ok(Self { request, models, probes, groups, rows, mode })
    }

    /// Per wavelength the means of the rows of `group`, and the patch that missed its tolerance by
    /// most.
    fn means(
        &self,
        group: &IncidenceGroup,
        control: &Control,
    ) -> Result<(Vec<Vec<Mueller>>, Option<UnmetPatch>), MaterialError> {
        let probes = &self.probes[group.probes];
        let incidence = Incidence::new(group.thetai.to_radians(), 0.0);
        let pieces = probes.pieces();
        let work: Vec<_> =
            self.models.iter().flat_map(|m| pieces.iter().map(move |piece| (m, *piece))).collect();
        let stop = || control.is_cancelled();
        let done: Option<Vec<PatchMeans>> = work
            .into_par_iter()
            .map(|(model, piece)| {
                let beam = (model, &incidence, self.request.basis);
                (!stop()).then(|| probes.means(beam, piece, &stop)).flatten()
            })
            .collect();
        let done = done.ok_or(MaterialError::Cancelled)?;
        let mut unmet: Option<(usize, f64)> = None;
        for (patch, reached) in done.iter().filter_map(|part| part.unmet) {
            if unmet.is_none_or(|(_, worst)| worst < reached) {
                unmet = Some((patch, reached));
            }
        }
        let unmet =
            unmet.map(|(patch, reached)| UnmetPatch { angles: group.rows[patch].angles, reached });
        let joined = |parts: &[PatchMeans]| {
            parts.iter().flat_map(|part| part.matrices.iter().copied()).collect()
        };
        Ok((done.chunks(pieces.len().max(1)).map(joined).collect(), unmet))
    }

    fn albedo(
        &self,
        group: &IncidenceGroup,
        colours: &Colours,
        control: &Control,
    ) -> Result<Albedo, MaterialError> {
        let incidence = Incidence::new(group.thetai.to_radians(), 0.0);
        let light = Stokes(self.request.incident);
        let stop = || control.is_cancelled();
        let one = |model: &Model| {
            let basis = self.request.basis;
            let hemi = Region::Hemi;
            let accuracy = Accuracy { is_required: self.mode == Mode::Compat, ..ALBEDO };
            let adaptive = adaptive::integrate(model, &incidence, basis, &hemi, &accuracy, &stop);
            let matrix = match adaptive {
                Ok(estimate) if estimate.matrix[(0, 0)].is_finite() => estimate.matrix,
                _ => {
                    let plane = self.request.sampling.unwrap_or_default();
                    let layout = Layout::new(&hemi, &plane, None)
                        .map_err(|error| MaterialError::Patch { number: 1, error })?;
                    integrate(model, &incidence, basis, &layout, &stop)
                        .ok_or(MaterialError::Cancelled)?
                }
            };
            Ok((matrix * light).0[0])
        };
        let spectrum: Result<Vec<f64>, MaterialError> = self.models.par_iter().map(one).collect();
        let thetai = group.rows[0].angles[0];
        let xyz = colours.reflectance.unpolarized(&spectrum?);
        Ok(Albedo { thetai, rgb: colours.reflectance.rgb(xyz), intensity: xyz.y })
    }
}

impl IncidenceGroup {
    fn row(
        &self,
        k: usize,
        work: &TableComputation<'_>,
        plan: &ColourPlan,
        spectra: [Vec<f64>; 4],
    ) -> ColourRow {
        let PatchTarget { angles: [thetai, thetas, phis], flags, .. } = self.rows[k];
        let omega = work.probes[self.probes].omegas[k];
        coloured(plan, Vec::new(), [thetai, thetas, phis, omega], spectra, flags)
    }
}

fn first_not_finite(row: &ColourRow, wavelengths: &[f64]) -> Option<f64> {
    let at = row.spectra.iter().find_map(|s| s.iter().position(|x| !x.is_finite()))?;
    wavelengths.get(at).copied()
}

fn layout(directions: &TableDirections) -> RowOrder {
    let TableDirections::Grid(grid) = directions else { return RowOrder::List };
    let axes = [("thetai", &grid.thetai), ("thetas", &grid.thetas), ("phis", &grid.phis)];
    let axis =
        |(name, nodes): (&str, &Vec<f64>)| TableAxis { name: name.into(), nodes: nodes.clone() };
    RowOrder::Grid { axes: axes.map(axis).into(), symmetry: symmetry(&grid.phis) }
}

fn patch_name(directions: &TableDirections) -> colour::RowPatch {
    match directions {
        TableDirections::Grid(grid) => match grid.patch {
            GridPatch::Point => colour::RowPatch::Point,
            GridPatch::Circle(alpha) => colour::RowPatch::Circle(alpha),
            GridPatch::Cell => colour::RowPatch::Cell,
            GridPatch::Ring => colour::RowPatch::Ring,
        },
        TableDirections::List(list) => match list.first().map(|place| &place.patch) {
            Some(first) if list.iter().all(|place| place.patch == *first) => match first {
                Patch::Circle(alpha) => colour::RowPatch::Circle(*alpha),
                Patch::Ring(inner, outer) => {
                    colour::RowPatch::Other(format!("ring {inner} {outer}"))
                }
                Patch::Polygon(_) => colour::RowPatch::Other("polygon".into()),
                Patch::Point => colour::RowPatch::Point,
            },
            Some(_) => colour::RowPatch::Other("mixed".into()),
            None => colour::RowPatch::Point,
        },
    }
}

#[cfg(test)]
mod tests;
