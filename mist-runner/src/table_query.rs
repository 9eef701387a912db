//! The request for a colour table as texts, as command lines and URLs give it.

use mist_engine::{
    Files, Limits,
    material::{
        MaterialError,
        query::{self, ColourQuery},
        table::{GridRequest, TableDirections, TableRequest},
    },
};

/// The texts of a request; what is missing has a default.
#[derive(Clone, Debug, Default)]
pub struct TableQuery {
    /// `thetai=0:2:90,thetas=0:2:90,phis=0:2:180`.
    pub grid: Option<String>,
    /// Rows `thetai thetas phis circle 2`, one per line.
    pub patches: Option<String>,
    /// The solid angle of a grid's nodes; `point`.
    pub patch: Option<String>,
    /// Wavelengths, nm; `360:5:830`.
    pub lambda: Option<String>,
    /// Incident Stokes vector; `1,0,0,0`.
    pub incident: Option<String>,
    /// The basis of the exit light; `psps`.
    pub basis: Option<String>,
    /// True if Q, U and V follow I.
    pub stokes: bool,
    /// Light, observer, space, adaptation, quantity, filters.
    pub colours: ColourQuery,
}

impl TableQuery {
    /// The request for a table of the material called `name`.
    ///
    /// # Errors
    ///
    /// Names the part that cannot be read and what was expected.
    pub fn request(
        &self,
        name: &str,
        files: Option<&dyn Files>,
    ) -> Result<TableRequest, MaterialError> {
        Ok(TableRequest { what: self.what()?, ..self.somewhere(name, files)? })
    }

    /// The request for a table of no directions.
    ///
    /// # Errors
    ///
    /// As [`TableQuery::request`].
    pub fn without_directions(&self, name: &str) -> Result<TableRequest, MaterialError> {
        self.somewhere(name, None)
    }

    fn somewhere(
        &self,
        name: &str,
        files: Option<&dyn Files>,
    ) -> Result<TableRequest, MaterialError> {
        let text = |given: &Option<String>, default: &str| {
            given.clone().unwrap_or_else(|| default.to_owned())
        };
        Ok(TableRequest {
            material: name.to_owned(),
            directions: TableDirections::List(Vec::new()),
            wavelengths: query::nodes("lambda", &text(&self.lambda, "360:5:830"))?,
            settings: self.colours.settings(files)?,
            incident: query::stokes(&text(&self.incident, "1,0,0,0"))?,
            stokes: self.stokes,
            basis: query::basis(&text(&self.basis, "psps"))?,
            sampling: mist_engine::sampling::PlaneSampling::default(),
            limits: Limits::default(),
        })
    }

    fn what(&self) -> Result<TableDirections, MaterialError> {
        if let Some(rows) = &self.patches {
            return Ok(TableDirections::List(query::patches(rows)?));
        }
        let patch = query::grid_patch(self.patch.as_deref().unwrap_or("point"))?;
        let grid: GridRequest = query::grid(self.grid.as_deref().unwrap_or(""), patch)?;
        Ok(TableDirections::Grid(grid))
    }
}
