//! What the query of a URL asks for; angles in degrees, wavelengths in nm.

use axum::extract::{FromRequestParts, Query};
use axum::http::request::Parts;
use mist_engine::material::query::ColourNames;
use rise_bridge::write::Style;
use serde::Deserialize;

use super::error::ApiError;
use crate::wanted::Wanted;

/// The keys of a query; all have defaults but the directions.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub(super) struct Asked {
    thetai: Option<String>,
    thetas: Option<String>,
    phis: Option<String>,
    /// The solid angle of a grid's nodes.
    patch: Option<String>,
    /// Rows `thetai thetas phis circle 2`, separated by `;`, in the place of a grid.
    patches: Option<String>,
    lambda: Option<String>,
    illuminant: Option<String>,
    observer: Option<String>,
    space: Option<String>,
    adaptation: Option<String>,
    quantity: Option<String>,
    filter: Option<String>,
    incident: Option<String>,
    basis: Option<String>,
    stokes: u8,
    digits: Option<usize>,
    xyz: u8,
    /// Which Stokes component of the spectra: 0 … 3 for I, Q, U, V.
    component: usize,
}

impl<S: Send + Sync> FromRequestParts<S> for Asked {
    type Rejection = ApiError;

    async fn from_request_parts(parts: &mut Parts, state: &S) -> Result<Self, ApiError> {
        let Query(asked) = Query::<Self>::from_request_parts(parts, state)
            .await
            .map_err(|error| ApiError::Query(error.body_text()))?;
        if asked.digits.is_some_and(|digits| !(1..=17).contains(&digits)) {
            return Err(ApiError::Query("digits is from 1 to 17".into()));
        }
        if asked.component > 3 {
            return Err(ApiError::Query("component is 0, 1, 2 or 3 for I, Q, U, V".into()));
        }
        Ok(asked)
    }
}

impl Asked {
    /// How the text of the table is written.
    pub(super) fn style(&self) -> Style {
        let plain = Style::default();
        Style { digits: self.digits.unwrap_or(plain.digits), xyz: self.xyz != 0 }
    }

    /// The Stokes component whose spectra are wanted.
    pub(super) fn component(&self) -> usize {
        self.component
    }

    /// The table of the grid or of the patches in the query.
    pub(super) fn wanted(&self) -> Result<Wanted, ApiError> {
        if let Some(patches) = &self.patches {
            return Ok(self.wanted_at(patches.replace(';', "\n")));
        }
        let axes = [("thetai", &self.thetai), ("thetas", &self.thetas), ("phis", &self.phis)];
        let axes: Vec<String> = axes
            .into_iter()
            .filter_map(|(name, nodes)| Some(format!("{name}={}", nodes.as_ref()?)))
            .collect();
        if axes.is_empty() {
            let message = "the query names a grid by thetai, thetas and phis, or patches";
            return Err(ApiError::Query(message.into()));
        }
        Ok(Wanted { grid: Some(axes.join(",")), ..self.everything_but_directions() })
    }

    /// The table of the patches in `rows`, one per line.
    pub(super) fn wanted_at(&self, rows: String) -> Wanted {
        Wanted { patches: Some(rows), ..self.everything_but_directions() }
    }

    fn everything_but_directions(&self) -> Wanted {
        Wanted {
            grid: None,
            patches: None,
            patch: self.patch.clone(),
            lambda: self.lambda.clone(),
            incident: self.incident.clone(),
            basis: self.basis.clone(),
            stokes: self.stokes != 0,
            colours: ColourNames {
                illuminant: self.illuminant.clone(),
                observer: self.observer.clone(),
                space: self.space.clone(),
                adaptation: self.adaptation.clone(),
                quantity: self.quantity.clone(),
                filters: self.filter.iter().cloned().collect(),
            },
        }
    }
}
