//! The patches of a table: checked, grouped by their angle of incidence, with their directions.

use std::{
    collections::HashMap,
    f64::consts::{FRAC_PI_2, PI},
};

use spectra::Quantity;

use super::super::{
    MaterialError,
    patch::{Probes, azimuth_cells, polar_cells},
};
use crate::{
    colour::{ColourRow, Symmetry},
    region::{PolarCell, Region},
    request::{GridPatch, GridRequest, Patch, PatchRow, TableDirections, TableRequest},
    sampling::{Layout, PlaneSampling},
};

/// In the place of angles of 90° and more.
const FILLED_FROM: f64 = 89.9;

/// A row of the table, and where its patch is.
pub(super) struct PatchTarget {
    pub(super) row: usize,
    /// thetai, thetas, phis as they were asked for, degrees.
    pub(super) angles: [f64; 3],
    pub(super) flags: u8,
}

/// Rows with one angle of incidence.
pub(super) struct IncidenceGroup {
    pub(super) thetai: f64,
    pub(super) rows: Vec<PatchTarget>,
    /// Which probes; the groups of a grid share theirs.
    pub(super) probes: usize,
}

fn above(theta: f64) -> f64 {
    if theta >= 90.0 { FILLED_FROM } else { theta }
}

fn flags(thetai: f64, thetas: f64) -> u8 {
    if thetai >= 90.0 || thetas >= 90.0 { ColourRow::FILLED } else { 0 }
}

/// Refuses a request that has no table.
///
/// # Errors
///
/// For other quantities, angles out of range and grids with too many nodes.
pub(super) fn check(request: &TableRequest) -> Result<(), MaterialError> {
    if !matches!(request.settings.quantity, Quantity::Brdf | Quantity::Factor) {
        let problem = "a table of a material is one of brdf or factor";
        return Err(MaterialError::request("quantity", problem));
    }
    let bad = request.wavelengths.iter().find(|nm| !(nm.is_finite() && **nm > 0.0));
    if let Some(nm) = bad {
        return Err(MaterialError::request("wavelengths", format!("{nm} nm is not a wavelength")));
    }
    let TableDirections::Grid(grid) = &request.directions else { return Ok(()) };
    for (name, nodes, low, high) in [
        ("thetai", &grid.thetai, 0.0, 180.0),
        ("thetas", &grid.thetas, 0.0, 180.0),
        ("phis", &grid.phis, -180.0, 180.0),
    ] {
        let rising = nodes.windows(2).all(|pair| pair[0] < pair[1]);
        let inside = nodes.iter().all(|x| (low..=high).contains(x));
        if nodes.is_empty() || !rising || !inside {
            let problem = format!("expected rising angles from {low} to {high} degrees");
            return Err(MaterialError::request(name, problem));
        }
    }
    if grid.patch == GridPatch::Ring && grid.phis.len() > 1 {
        let problem = "a ring is an average over the azimuth: expected one node";
        return Err(MaterialError::request("phis", problem));
    }
    let nodes = request.directions.rows();
    if nodes > request.limits.steps as f64 {
        return Err(MaterialError::Limit(format!("the grid has {nodes:e} nodes")));
    }
    Ok(())
}

/// The azimuths that a grid with these nodes gives.
pub(super) fn symmetry(phis: &[f64]) -> Symmetry {
    if phis.iter().all(|phi| *phi >= 0.0) { Symmetry::Mirror } else { Symmetry::None }
}

/// The directions, the groups and the number of rows.
pub(super) type Parts = (Vec<Probes>, Vec<IncidenceGroup>, usize);

/// The patches of a grid.
///
/// # Errors
///
/// For patches that cannot be integrated over, and too many directions.
pub(super) fn of_grid(
    grid: &GridRequest,
    request: &TableRequest,
    plane: Option<&PlaneSampling>,
) -> Result<Parts, MaterialError> {
    let mut probes = Probes::default();
    let mut nodes = Vec::new();
    let mirror = symmetry(&grid.phis) == Symmetry::Mirror;
    let rad = |(a, b): (f64, f64)| (a.to_radians(), b.to_radians());
    let azimuths = azimuth_cells(&grid.phis, mirror);
    for (thetas, theta) in grid.thetas.iter().zip(polar_cells(&grid.thetas)) {
        for (phis, phi) in grid.phis.iter().zip(&azimuths) {
            let center = rad((above(*thetas), *phis));
            let (empty, theta) = (theta.0 >= theta.1, rad(theta));
            let error = |error| MaterialError::Patch { number: nodes.len() + 1, error };
            let patch = match grid.patch {
                GridPatch::Circle(alpha) => Patch::Circle(alpha),
                _ => Patch::Point,
            };
            let cell = |phi, center| PolarCell { theta, phi, center };
            match grid.patch {
                GridPatch::Cell if !empty => {
                    probes.add_cell(cell(rad(*phi), Some(center)), plane.is_none());
                }
                GridPatch::Ring if !empty => {
                    probes.add_cell(cell((-PI, PI), None), plane.is_none());
                }
                _ => admit(&probes, &patch, (request, plane))
                    .and_then(|()| probes.add(center, &patch, plane).map_err(error))?,
            }
            within(&probes, request)?;
            nodes.push((*thetas, *phis));
        }
    }
    let group = |(number, thetai): (usize, &f64)| IncidenceGroup {
        thetai: above(*thetai),
        rows: (nodes.iter().enumerate())
            .map(|(k, &(thetas, phis))| PatchTarget {
                row: number * nodes.len() + k,
                angles: [*thetai, thetas, phis],
                flags: flags(*thetai, thetas),
            })
            .collect(),
        probes: 0,
    };
    let groups: Vec<IncidenceGroup> = grid.thetai.iter().enumerate().map(group).collect();
    let rows = grid.thetai.len() * probes.len();
    Ok((vec![probes], groups, rows))
}

/// The patches of a list.
///
/// # Errors
///
/// As [`of_grid`], and for angles that are not finite.
pub(super) fn of_list(
    list: &[PatchRow],
    request: &TableRequest,
    plane: Option<&PlaneSampling>,
) -> Result<Parts, MaterialError> {
    let (mut probes, mut groups): (Vec<Probes>, Vec<IncidenceGroup>) = Default::default();
    let mut known: HashMap<u64, usize> = HashMap::new();
    for (row, place) in list.iter().enumerate() {
        let PatchRow { thetai, thetas, phis, patch } = place;
        if !(0.0..=180.0).contains(thetai) || !thetas.is_finite() || !phis.is_finite() {
            let part = format!("patch {}", row + 1);
            return Err(MaterialError::request(part, "expected finite angles in degrees"));
        }
        // Without the sign of a zero.
        let bits = (above(*thetai) + 0.0).to_bits();
        let at = *known.entry(bits).or_insert_with(|| {
            probes.push(Probes::default());
            groups.push(IncidenceGroup {
                thetai: above(*thetai),
                rows: Vec::new(),
                probes: groups.len(),
            });
            groups.len() - 1
        });
        admit(&probes[at], patch, (request, plane))?;
        let center = (above(*thetas).to_radians(), phis.to_radians());
        probes[at]
            .add(center, patch, plane)
            .map_err(|error| MaterialError::Patch { number: row + 1, error })?;
        within(&probes[at], request)?;
        let (angles, flags) = ([*thetai, *thetas, *phis], flags(*thetai, *thetas));
        groups[at].rows.push(PatchTarget { row, angles, flags });
    }
    Ok((probes, groups, list.len()))
}

/// Refuses a patch whose directions would not fit beside those that are there.
fn admit(
    probes: &Probes,
    patch: &Patch,
    (request, plane): (&TableRequest, Option<&PlaneSampling>),
) -> Result<(), MaterialError> {
    let (Patch::Circle(alpha) | Patch::Ring(_, alpha), Some(plane)) = (patch, plane) else {
        return Ok(());
    };
    let region = Region::Circle {
        center: (0.0, 0.0),
        alpha: alpha.to_radians().clamp(-FRAC_PI_2, FRAC_PI_2),
    };
    let more = Layout::estimate(&region, plane);
    if probes.directions() as f64 + more > request.limits.directions {
        return Err(too_many_directions(request));
    }
    Ok(())
}

/// Refuses to go on with more directions than the limit.
fn within(probes: &Probes, request: &TableRequest) -> Result<(), MaterialError> {
    if probes.directions() as f64 > request.limits.directions {
        return Err(too_many_directions(request));
    }
    Ok(())
}

fn too_many_directions(request: &TableRequest) -> MaterialError {
    let limit = request.limits.directions;
    MaterialError::Limit(format!("the patches have more than {limit:e} directions"))
}
