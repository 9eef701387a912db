//! `mist bridge --deferred`: scenes of geometry alone, and pictures from their renders.

use ::preview::{Polarization, RenderedFilm, brightest, picture};
use mist_engine::request::{ColourQuery, IncidentLight, read};
use mist_runner::files::DiskFiles;
use rise_bridge::{
    export::ExportError,
    rise::deferred::{self, Illumination},
};
use spectra::{ColourPlan, Grid};

use super::{
    args::{BridgeArgs, LAMBDA},
    files::{save, save_image},
    render,
};
use crate::{
    error::CommandError, input::InputText, material::not_exported, output::print, preview,
};

/// Writes the scenes, and the pictures if their renders are there or asked for.
pub(super) fn deferred(args: &BridgeArgs, source: &InputText) -> Result<(), CommandError> {
    let filter = preview::filter(&args.filter)?;
    let lit = args.lit()?;
    let renderer = args.render.then(render::Renderer::of_environment).transpose()?;
    let stem = source.stem();
    let files = DiskFiles::beside_scene(&args.scene).shared();
    let plan = deferred::plan(&source.text, &stem, &*files, args.derive, args.finer);
    let plan = plan.map_err(not_exported)?;
    save(&args.out, &plan.files)?;
    for note in plan.invented() {
        print(&format!("invented: {note}\n"))?;
    }
    for reason in &plan.skipped {
        print(&format!("left black: {reason}\n"))?;
    }
    for scene in plan.scenes() {
        let image = scene.replace(".RISEscene", ".exr");
        match &renderer {
            // Nothing may be seen from one side.
            Some(rise) => print(&rise.render(&args.out, scene, &[image], render::read)?)?,
            None => print(&format!("{}\n", args.out.join(scene).display()))?,
        }
    }
    if !(args.render || args.stack) {
        return Ok(());
    }
    let image = |name: &str| {
        render::read(&args.out.join(name)).map_err(|problem| ExportError::refused(name, problem))
    };
    let film = args.threads.run(&stem, |control| plan.film(image, &files, &lit, control))?;
    let film = film.map_err(not_exported)?;
    save_picture(args, &film, &lit, &format!("{stem}_deferred"), Polarization::All)?;
    if filter != Polarization::All {
        save_picture(args, &film, &lit, &format!("{stem}_deferred_filter"), filter)?;
    }
    Ok(())
}

impl BridgeArgs {
    fn lit(&self) -> Result<Illumination, CommandError> {
        let names = ColourQuery::of_factors(&self.illuminant.illuminant);
        Ok(Illumination {
            wavelengths: self.lambda.nm_or(LAMBDA)?,
            settings: names.settings(None)?,
            light: read::<IncidentLight>("incident", &self.incident)?.0,
            light_basis: self.incident_basis.into(),
        })
    }
}

fn save_picture(
    args: &BridgeArgs,
    film: &RenderedFilm,
    lit: &Illumination,
    name: &str,
    filter: Polarization,
) -> Result<(), CommandError> {
    let failed = |error: &dyn std::fmt::Display| CommandError::Failed(format!("{name}: {error}"));
    let grid = Grid::new(&lit.wavelengths).map_err(|error| failed(&error))?;
    let plan = ColourPlan::new(&grid, lit.settings.clone()).map_err(|error| failed(&error))?;
    let image = picture(film, &plan, filter, 1.0).map_err(|error| failed(&error))?;
    let brightest = brightest(film, filter);
    for path in save_image(&args.out, name, &image)? {
        print(&format!("{}: brightest pixel {brightest:.4}\n", path.display()))?;
    }
    Ok(())
}
