//! `mist bridge --deferred`: scenes of geometry alone, and pictures from their renders.

use mist_engine::{
    Control,
    material::query::{self, ColourNames},
};
use rise_bridge::{
    export::ExportError,
    image::Format,
    preview::{Film, Polarization, brightest, picture},
    rise::deferred::{self, Deferred, Lit},
};
use spectra::{ColourPlan, Grid};

use super::{Args, Stop, render, save};
use crate::{
    cli::{
        material::{not_exported, refused},
        preview, print,
        run::pool,
        source::Source,
    },
    disk::{DiskFiles, WholeFile},
    interrupt,
    progress::Progress,
};

/// Writes the scenes, and the pictures if their renders are there or wanted.
pub(super) fn deferred(args: &Args, source: &Source) -> Result<(), Stop> {
    let filter = preview::filter(&args.filter)?;
    let lit = args.lit()?;
    let renderer = args.render.then(render::Renderer::of_environment).transpose()?;
    let stem = source.stem();
    let files = DiskFiles::beside(&args.scene).shared();
    let plan = deferred::plan(&source.text, &stem, &*files, args.derive, args.finer);
    let plan = plan.map_err(not_exported)?;
    save(&args.out, &plan.files)?;
    for reason in &plan.left {
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
    let film = shaded(args, &plan, &lit, &stem)?;
    save_picture(args, &film, &lit, &format!("{stem}_deferred"), Polarization::All)?;
    if filter != Polarization::All {
        save_picture(args, &film, &lit, &format!("{stem}_deferred_filter"), filter)?;
    }
    Ok(())
}

impl Args {
    fn lit(&self) -> Result<Lit, Stop> {
        let names = ColourNames {
            illuminant: Some(self.illuminant.clone()),
            quantity: Some("factor".into()),
            ..ColourNames::default()
        };
        Ok(Lit {
            wavelengths: query::nodes("wavelengths", &self.wavelengths).map_err(refused)?,
            settings: names.settings(None).map_err(refused)?,
            light: query::stokes(&self.incident).map_err(refused)?,
            light_basis: self.incident_basis.into(),
        })
    }
}

fn shaded(args: &Args, plan: &Deferred, lit: &Lit, stem: &str) -> Result<Film, Stop> {
    let progress = Progress::new(stem);
    let bar = progress.clone();
    let control =
        Control { cancel: interrupt::flag(), progress: Some(Box::new(move |part| bar.set(part))) };
    let image = |name: &str| {
        render::read(&args.out.join(name)).map_err(|problem| ExportError::refused(name, problem))
    };
    let files = DiskFiles::beside(&args.scene).shared();
    let film = pool(args.threads)?.install(|| plan.film(image, &files, lit, &control));
    progress.finish();
    film.map_err(not_exported)
}

fn save_picture(
    args: &Args,
    film: &Film,
    lit: &Lit,
    name: &str,
    filter: Polarization,
) -> Result<(), Stop> {
    let failed = |error: &dyn std::fmt::Display| Stop::Failed(format!("{name}: {error}"));
    let grid = Grid::new(&lit.wavelengths).map_err(|error| failed(&error))?;
    let plan = ColourPlan::new(&grid, lit.settings.clone()).map_err(|error| failed(&error))?;
    let image = picture(film, &plan, filter, 1.0).map_err(|error| failed(&error))?;
    for (extension, format) in [("exr", Format::Exr), ("png", Format::Png)] {
        let path = args.out.join(format!("{name}.{extension}"));
        let bytes = image.write(format).map_err(|error| failed(&error))?;
        WholeFile::write_bytes(&path, &bytes).map_err(|error| failed(&error))?;
        print(&format!("{}: brightest pixel {:.4}\n", path.display(), brightest(film, filter)))?;
    }
    Ok(())
}
