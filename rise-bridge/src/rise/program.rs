//! The MIST program of one material of a scene: every ring of its table at every wavelength.
//!
//! Ring k of a table is an annulus around the normal, so that R/(π (sin² β − sin² α)) is the mean
//! BRDF of the patch, with the flux R that the program integrates. NIST's MIST runs it unchanged.

use std::fmt::Write;

use super::{material::SceneMaterial, table::ring};

/// Replaces an incidence at the horizon, degrees.
const HORIZON: f64 = 89.0;

/// A program with the lists that its loops read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RingProgram {
    /// The text of the program.
    pub program: String,
    /// Name and text of the list of rings, in the order of the table.
    pub rings: (String, String),
    /// Name and text of the list of wavelengths.
    pub waves: (String, String),
    /// The name of its table.
    pub results: String,
}

/// The program for `material` of the scene `scene`, with `nodes` nodes per polar angle and these
/// wavelengths (nm).
pub fn program(
    material: &SceneMaterial,
    scene: &str,
    nodes: usize,
    wavelengths: &[f64],
) -> RingProgram {
    let name = &material.name;
    let parameters: String = material
        .material
        .parameters
        .iter()
        .filter(|(path, _)| !is_wavelength(path))
        .map(|(path, value)| format!("  ${path} = {value}\n"))
        .collect();
    let program = format!(
        "; written by mist bridge: material \"{name}\" of {scene}\n\
         MODEL = {model}\n\n\
         VARIABLES:\n\
         \x20 deg0 = atan(1)/45\n\
         \x20 thetai = 0            ; degrees, from {name}.rings\n\
         \x20 inner = 0\n\
         \x20 outer = 1\n\
         \x20 wl = 550              ; nm, from {name}.waves\n\n\
         \x20 incidentangle = thetai*deg0\n\
         \x20 incidentpol = (1,0,0,0)\n\
         \x20 rotation = 0\n\
         \x20 differential = (1.5*deg0)^2\n\
         \x20 minsamples = 400\n\n\
         {parameters}\
         {wavelengths}\
         END\n\n\
         VARY:\n\
         \x20 LIST {name}.rings\n\
         \x20 LIST {name}.waves\n\
         END\n\n\
         INTEGRALS:\n\
         \x20 R = ANNULUS OUTERCENTER = (0,0) OUTERALPHA = outer*deg0 INNERCENTER = (0,0) \
         INNERALPHA = inner*deg0 POL = (1,0,0,0) END\n\
         END\n\n\
         OUTPUTS:\n\
         \x20 1 f=R/(4*atan(1)*(sin(outer*deg0)^2-sin(inner*deg0)^2))\n\
         END\n\n\
         FILES:\n\
         \x20 results = {name}.dat\n\
         \x20 listing = {name}.lst\n\
         \x20 format = %.15e\\t\n\
         END\n",
        model = material.material.model,
        wavelengths = wavelength_lines(material),
    );
    let mut rings = String::from("thetai inner outer\n");
    for i in 0..nodes {
        let thetai = (90.0 * i as f64 / (nodes - 1) as f64).min(HORIZON);
        for r in 0..nodes {
            let (inner, outer) = ring(r, nodes);
            // Writing to a string cannot fail.
            let _ = writeln!(rings, "{thetai} {inner} {outer}");
        }
    }
    let waves: String = wavelengths.iter().map(|nm| format!("{nm}\n")).collect();
    RingProgram {
        program,
        rings: (format!("{name}.rings"), rings),
        waves: (format!("{name}.waves"), format!("wl\n{waves}")),
        results: format!("{name}.dat"),
    }
}

fn is_wavelength(path: &str) -> bool {
    path == "lambda" || path.ends_with(".lambda")
}

/// The wavelength of the model and of every source in it.
fn wavelength_lines(material: &SceneMaterial) -> String {
    let sources = material.material.parameters.iter().map(|(path, _)| path.as_str());
    let mut paths: Vec<String> = sources
        .filter(|path| path.rsplit('.').next().is_some_and(|last| last.starts_with("source")))
        .map(|path| format!("{path}.lambda"))
        .collect();
    paths.push("lambda".into());
    paths.iter().map(|path| format!("  #{path} = wl/1000\n")).collect()
}
