//! The query of a table's URL; angles in degrees, wavelengths in nm.

use axum::{
    extract::FromRequestParts,
    http::{Uri, request::Parts},
};
use mist_engine::{
    material::lobes::LobeRequest,
    request::{ColourQuery, PatchList, RequestError, TableDirections, TableQuery, TableRequest},
};
use rise_bridge::write::Style;
use serde::Deserialize;
use utoipa::IntoParams;

use super::{error::ApiError, extract::Query, renderer};
use crate::limits::{LimitReached, ServeLimits};

/// The keys of a query; all have defaults but the directions.
#[derive(Clone, Debug, Default, Deserialize, IntoParams)]
#[serde(deny_unknown_fields, default)]
#[into_params(parameter_in = Query)]
pub(super) struct MaterialQuery {
    /// Nodes of the grid in degrees: `0:2:90`, or a list with commas.
    thetai: Option<String>,
    /// As `thetai`.
    thetas: Option<String>,
    /// As `thetai`; 0 is the specular side.
    phis: Option<String>,
    /// The solid angle of a grid's nodes: `point`, `cell`, `ring` or `circle:ALPHA`.
    patch: Option<String>,
    /// Rows `thetai thetas phis circle 2`, separated by `;`, in the place of a grid.
    patches: Option<String>,
    /// Wavelengths in nm: `360:5:830`.
    lambda: Option<String>,
    /// CIE name, colour temperature, or `D(temperature)`: `D65`.
    illuminant: Option<String>,
    /// Colour-matching functions: `CIE1931_2`.
    observer: Option<String>,
    /// RGB space: `sRGB`.
    space: Option<String>,
    /// `none`, `Bradford`, `CAT02`, `CAT16` or `VonKries`.
    adaptation: Option<String>,
    /// `brdf` or `factor`.
    quantity: Option<String>,
    /// A filter before the eye: `linear(1.57)`.
    filter: Option<String>,
    /// Incident Stokes vector: `1,0,0,0`.
    incident: Option<String>,
    /// `psps`, `xyxy` or `plane`; for single directions also `mitsuba`.
    basis: Option<String>,
    /// 1 gives Q, U and V too.
    #[param(minimum = 0, maximum = 1)]
    stokes: u8,
    /// Significant digits: 9 bring back every f32, 17 every f64.
    #[param(minimum = 1, maximum = 17)]
    digits: Option<usize>,
    /// 1 gives X, Y and Z too.
    #[param(minimum = 0, maximum = 1)]
    xyz: u8,
    /// Which Stokes component of the spectra: 0 … 3 for I, Q, U, V.
    #[param(minimum = 0, maximum = 3)]
    component: usize,
    /// `rgb`, `spectral` or `mueller`.
    out: Option<String>,
    /// Seconds to wait for a table before 202.
    #[param(minimum = 0, maximum = 3600)]
    wait: Option<f64>,
}

impl<S: Send + Sync> FromRequestParts<S> for MaterialQuery {
    type Rejection = ApiError;

    async fn from_request_parts(parts: &mut Parts, _: &S) -> Result<Self, ApiError> {
        Self::of(&parts.uri)
    }
}

impl MaterialQuery {
    /// The query of the address `uri`.
    pub(super) fn of(uri: &Uri) -> Result<Self, ApiError> {
        let Query(query) = Query::<Self>::of(uri)?;
        let refuse = |text: &str| Err(ApiError::Query(text.into()));
        if query.digits.is_some_and(|digits| !(1..=17).contains(&digits)) {
            return refuse("digits is from 1 to 17");
        }
        if query.component > 3 {
            return refuse("component is 0, 1, 2 or 3 for I, Q, U, V");
        }
        if query.stokes > 1 || query.xyz > 1 {
            return refuse("stokes and xyz are 0 or 1");
        }
        if query.wait.is_some_and(|wait| !(0.0..=3600.0).contains(&wait)) {
            return refuse("wait is from 0 to 3600 seconds");
        }
        Ok(query)
    }

    /// The style of the table's text.
    pub(super) fn style(&self) -> Style {
        let plain = Style::default();
        Style { digits: self.digits.unwrap_or(plain.digits), xyz: self.xyz != 0 }
    }

    /// The Stokes component of the spectra.
    pub(super) fn component(&self) -> usize {
        self.component
    }

    /// The quantity of the exit light.
    pub(super) fn out(&self) -> Option<&str> {
        self.out.as_deref()
    }

    /// Seconds to wait, if the query has them.
    pub(super) fn wait(&self) -> Option<f64> {
        self.wait
    }

    /// The table of the material called `name` for the grid or the patches in the query.
    pub(super) fn request(&self, name: &str) -> Result<TableRequest, ApiError> {
        let query = self.query()?;
        if !query.has_directions() {
            let problem = "a grid is missing: thetai, thetas and phis, or grid, or patches";
            return Err(ApiError::Query(problem.to_owned()));
        }
        Ok(query.request(name, None)?)
    }

    /// The same for these patches.
    pub(super) fn request_at(
        &self,
        PatchList(rows): PatchList,
        name: &str,
    ) -> Result<TableRequest, ApiError> {
        let directions = TableDirections::List(rows);
        let query = TableQuery { patches: None, ..self.query()? };
        Ok(query.request_for(directions, name, None)?)
    }

    /// The same for single directions.
    pub(super) fn view(&self, limits: &ServeLimits) -> Result<LobeRequest, ApiError> {
        let mut query = self.query()?;
        let turn = renderer::turn(query.basis.as_deref());
        if turn.is_some() {
            query.basis = None;
        }
        let none = TableDirections::List(Vec::new());
        let request = query.request_for(none, "", None)?;
        admit(&request, limits)?;
        let TableRequest { wavelengths, settings, incident, basis, .. } = request;
        Ok(LobeRequest { wavelengths, settings, incident, basis, turn })
    }

    fn query(&self) -> Result<TableQuery, ApiError> {
        let patches = self.patches.as_deref().map(|rows| {
            PatchList::inline(rows).map_err(|error| RequestError::new("patches", error))
        });
        Ok(TableQuery {
            grid: None,
            thetai: self.thetai.clone(),
            thetas: self.thetas.clone(),
            phis: self.phis.clone(),
            patch: self.patch.clone(),
            patches: patches.transpose()?,
            lambda: self.lambda.clone(),
            incident: self.incident.clone(),
            basis: self.basis.clone(),
            stokes: self.stokes != 0,
            colours: ColourQuery {
                illuminant: self.illuminant.clone(),
                observer: self.observer.clone(),
                space: self.space.clone(),
                adaptation: self.adaptation.clone(),
                quantity: self.quantity.clone(),
                filters: self.filter.iter().cloned().collect(),
            },
        })
    }
}

/// Refuses a table that is larger than the service makes, before anything is computed; the
/// request gets the limits of the service.
pub(super) fn admit(request: &TableRequest, limits: &ServeLimits) -> Result<(), ApiError> {
    let (rows, waves) = (request.directions.rows(), request.wavelengths.len());
    let numbers = rows * waves as f64 * if request.stokes { 4.0 } else { 1.0 };
    let refuse = |flag, value, message| Err(ApiError::Limit(LimitReached { flag, value, message }));
    if waves > limits.max_wavelengths {
        let most = limits.max_wavelengths;
        let message = format!("lambda has {waves} wavelengths, more than {most}");
        return refuse("max-wavelengths", most as f64, message);
    }
    if rows > limits.max_steps as f64 {
        let most = limits.max_steps;
        let message = format!("the table has {rows:e} rows, more than {most}");
        return refuse("max-steps", most as f64, message);
    }
    if numbers > limits.max_numbers {
        let most = limits.max_numbers;
        let message = format!("the table has {numbers:e} numbers, more than {most:e}");
        return refuse("max-numbers", most, message);
    }
    Ok(())
}
