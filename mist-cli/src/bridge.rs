//! `mist bridge`: the materials of a RISE scene as tables, and scenes that show them.

use std::path::Path;

use mist_runner::files::DiskFiles;
use rise_bridge::rise::{
    product::{self, BridgeFiles, BridgeOptions},
    stack,
};

use super::{
    error::CommandError, input::InputText, material::not_exported, output::print,
    reporter::Reporter,
};

mod args;
mod deferred;
mod files;
mod render;

pub(super) use args::BridgeArgs;

use args::LAMBDA;
use files::{save, save_image};

/// Makes the files, and the pictures if they are asked for.
pub(super) fn bridge(args: &BridgeArgs, reporter: &Reporter) -> Result<(), CommandError> {
    let source = InputText::read(&args.scene)?;
    args.lambda.warn(reporter)?;
    if args.deferred { deferred::deferred(args, &source) } else { tables(args, &source, reporter) }
}

fn tables(args: &BridgeArgs, source: &InputText, reporter: &Reporter) -> Result<(), CommandError> {
    if !(3..=361).contains(&args.nodes) {
        return Err(CommandError::Refused(format!("--nodes is from 3 to 361, not {}", args.nodes)));
    }
    let renderer = args.render.then(render::Renderer::of_environment).transpose()?;
    let options = BridgeOptions {
        nodes: args.nodes,
        wavelengths: args.lambda.nm_or(LAMBDA)?,
        derive: args.derive,
        bands: args.bands,
    };
    let (files, stem) = (DiskFiles::beside_scene(&args.scene).shared(), source.stem());
    let make = |control: &_| product::make(&source.text, &stem, &files, &options, control);
    let made = args.threads.run(&stem, make)?.map_err(not_exported)?;
    reporter.warn(&source.name(), &made.warnings);
    reporter.check()?;
    save(&args.out, &made.files)?;
    print(&told(&args.out, &made))?;
    for scene in renderer.iter().flat_map(|_| &made.scenes) {
        let renderer = renderer.as_ref().expect("there is one for every scene");
        let text = String::from_utf8_lossy(&made.files[scene]).into_owned();
        let images = product::images(&text).map_err(not_exported)?;
        print(&renderer.render(&args.out, scene, &images, render::seen)?)?;
    }
    if args.bands && (args.render || args.stack) {
        let stem = format!("{stem}_bands");
        print(&stacked(
            &args.out,
            &stem,
            &made.bands,
            &options.wavelengths,
            &args.illuminant.illuminant,
        )?)?;
    }
    Ok(())
}

/// Makes one picture of the `renders` in a folder, as .exr and .png.
fn stacked(
    folder: &Path,
    stem: &str,
    renders: &[String],
    wavelengths: &[f64],
    illuminant: &str,
) -> Result<String, CommandError> {
    let images = renders.iter().map(|name| render::seen(&folder.join(name)));
    let images = images.collect::<Result<Vec<_>, String>>().map_err(CommandError::Failed)?;
    let picture = stack::stack(&images, wavelengths, illuminant).map_err(not_exported)?;
    let paths = save_image(folder, stem, &picture)?.into_iter();
    Ok(paths.map(|path| format!("{}: of {} renders\n", path.display(), renders.len())).collect())
}

fn told(folder: &Path, made: &BridgeFiles) -> String {
    let mut text = String::new();
    for (name, table) in &made.tables {
        let [r, g, b] = table.reflectance();
        let path = folder.join(name);
        text += &format!(
            "{}: {} x {} nodes, reflectance {r:.4} {g:.4} {b:.4}\n",
            path.display(),
            table.nodes,
            table.nodes
        );
    }
    for scene in &made.scenes {
        text += &format!("{}\n", folder.join(scene).display());
    }
    for note in &made.invented {
        text += &format!("invented: {note}\n");
    }
    for reason in &made.skipped {
        text += &format!("not converted: {reason}\n");
    }
    text
}
