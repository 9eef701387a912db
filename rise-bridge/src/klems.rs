//! Klems XML: reflection between 145 × 145 patches of direction, for Radiance and WINDOW.
//!
//! Values are the BRDF in 1/sr without a cosine for unpolarized light, means over the patch of the
//! light that leaves; the light that comes is taken in the middle of its patch. Radiance reads three
//! bands and no wavelengths: CIE X, Y and Z, here for equal energy, so that a grey material has three
//! equal numbers. Its "Reflection Back" is the side of the normal; a sample that is opaque has the
//! same on both sides.
//!
//! J. H. Klems, *A new method for predicting the solar heat gain of complex fenestration systems*,
//! ASHRAE Trans. 100(1) (1994), for the patches.

use std::{
    f64::consts::{FRAC_PI_2, PI, TAU},
    io::Write,
};

use glam::DVec3;
use mist_engine::{
    Control,
    material::{MaterialError, query::ColourNames},
};
use rayon::prelude::*;
use spectra::{ColourPlan, Grid};

use crate::export::{Bands, ExportError, Spread, even_in_four};

/// Upper polar angle (degrees) and number of patches of every ring of the full basis.
const RINGS: [(f64, usize); 9] = [
    (5.0, 1),
    (15.0, 8),
    (25.0, 16),
    (35.0, 20),
    (45.0, 24),
    (55.0, 24),
    (65.0, 24),
    (75.0, 16),
    (90.0, 12),
];
/// Directions along each side of a patch.
const SAMPLES: usize = 4;
const BASIS: &str = "LBNL/Klems Full";

/// A patch: polar angles in radians, azimuth of its middle and its width.
#[derive(Clone, Copy, Debug)]
struct Patch {
    lower: f64,
    upper: f64,
    phi: f64,
    width: f64,
}

/// All patches, ring after ring.
fn patches() -> Vec<Patch> {
    let mut all = Vec::new();
    let mut lower = 0.0_f64;
    for (upper, count) in RINGS {
        let width = TAU / count as f64;
        let ring = (0..count).map(|j| Patch {
            lower: lower.to_radians(),
            upper: upper.to_radians(),
            phi: width * j as f64,
            width,
        });
        all.extend(ring);
        lower = upper;
    }
    all
}

impl Patch {
    /// The direction at `(u, w)` in 0 … 1, even in projected solid angle.
    fn direction(&self, u: f64, w: f64) -> DVec3 {
        let [a, b] = [self.lower, self.upper].map(|theta| theta.sin().powi(2));
        let sin2 = a + (b - a) * u;
        let (sin, cos) = (sin2.sqrt(), (1.0 - sin2).sqrt());
        let (sin_phi, cos_phi) = (self.phi + self.width * (w - 0.5)).sin_cos();
        DVec3::new(sin * cos_phi, sin * sin_phi, cos)
    }

    /// Its middle; the first one is the normal.
    fn middle(&self) -> DVec3 {
        if self.lower == 0.0 { DVec3::Z } else { self.direction(0.5, 0.5) }
    }
}

/// Writes the file for `bands`.
///
/// # Errors
///
/// For materials that are not isotropic or not finite somewhere, wavelengths of which no colour
/// comes, a wish to stop, and an `out` that does not take the text.
pub fn write<W: Write>(
    bands: &Bands,
    name: &str,
    mut out: W,
    control: &Control,
) -> Result<W, ExportError> {
    if !bands.is_isotropic() {
        let problem = "the matrices change when the sample is turned; a Klems file of a material \
                       that is the same on both sides has no room for it";
        return Err(ExportError::refused("material", problem));
    }
    let plan = equal_energy(bands)?;
    let patches = patches();
    let mut columns = Vec::with_capacity(patches.len());
    for (k, from) in patches.iter().enumerate() {
        if control.is_cancelled() {
            return Err(ExportError::Cancelled);
        }
        // An incident patch is named by where its light goes.
        let middle = from.middle();
        let light = DVec3::new(-middle.x, -middle.y, middle.z);
        let column: Result<Vec<[f64; 3]>, ExportError> =
            patches.par_iter().map(|to| mean(bands, &plan, light, to)).collect();
        columns.push(column?);
        control.report((k + 1) as f64 / patches.len() as f64);
    }
    head(&mut out, name)?;
    for (band, component) in [("Visible", 1), ("CIE-X", 0), ("CIE-Z", 2)] {
        for side in ["Reflection Back", "Reflection Front"] {
            block(&mut out, band, side, |to, from| columns[from][to][component])?;
        }
    }
    out.write_all(b"</Layer>\n</Optical>\n</WindowElement>\n")?;
    out.flush()?;
    Ok(out)
}

/// How far the luminous f of a patch is from that of directions in it: what a reader that takes
/// patches as they are is wrong by.
///
/// # Errors
///
/// For wavelengths of which no colour comes.
pub fn spread(bands: &Bands) -> Result<Spread, ExportError> {
    let plan = equal_energy(bands)?;
    let patches = patches();
    let hemisphere = Patch { lower: 0.0, upper: FRAC_PI_2, phi: 0.0, width: TAU };
    Ok(Spread::of(|n| {
        let [a, b, c, d] = even_in_four(n);
        let (light, leaving) = (hemisphere.direction(a, b), hemisphere.direction(c, d));
        let middle = patches[containing(light)].middle();
        let patch = mean(bands, &plan, middle, &patches[containing(leaving)]);
        let spectrum: Vec<f64> = bands.unpolarized(light, leaving).collect();
        let (Ok(patch), exact) = (patch, plan.unpolarized(&spectrum).y) else { return Vec::new() };
        // Directions are even in projected solid angle.
        let compared = (exact > 0.0).then(|| ((patch[1] - exact).abs() / exact, exact));
        compared.into_iter().collect()
    }))
}

/// The number of the patch with a direction.
fn containing(direction: DVec3) -> usize {
    let theta = direction.x.hypot(direction.y).atan2(direction.z).to_degrees();
    let phi = direction.y.atan2(direction.x).rem_euclid(TAU);
    let mut first = 0;
    for (upper, count) in RINGS {
        if theta < upper {
            return first + (phi / TAU * count as f64).round() as usize % count;
        }
        first += count;
    }
    first - 1
}

/// CIE XYZ under equal energy.
fn equal_energy(bands: &Bands) -> Result<ColourPlan, ExportError> {
    let wrong =
        |error: &dyn std::fmt::Display| ExportError::refused("wavelengths", error.to_string());
    let grid = Grid::new(bands.nm()).map_err(|error| wrong(&error))?;
    let names = ColourNames { illuminant: Some("E".into()), ..ColourNames::default() };
    ColourPlan::new(&grid, names.settings(None)?).map_err(|error| wrong(&error))
}

/// XYZ of the mean over the patch `to`.
fn mean(
    bands: &Bands,
    plan: &ColourPlan,
    light: DVec3,
    to: &Patch,
) -> Result<[f64; 3], ExportError> {
    let mut spectrum = vec![0.0; bands.nm().len()];
    for k in 0..SAMPLES * SAMPLES {
        let [u, w] = [k / SAMPLES, k % SAMPLES].map(|i| (i as f64 + 0.5) / SAMPLES as f64);
        for (sum, f) in spectrum.iter_mut().zip(bands.unpolarized(light, to.direction(u, w))) {
            *sum += f / (SAMPLES * SAMPLES) as f64;
        }
    }
    if let Some(bad) = spectrum.iter().position(|f| !f.is_finite()) {
        let place = format!("light from {light:.3}, {} nm", bands.nm()[bad]);
        return Err(MaterialError::NotFinite(place).into());
    }
    let xyz = plan.unpolarized(&spectrum);
    Ok([xyz.x, xyz.y, xyz.z].map(|x| x.max(0.0)))
}

fn head(out: &mut impl Write, name: &str) -> std::io::Result<()> {
    let name = name.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;");
    writeln!(
        out,
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n\
         <WindowElement xmlns=\"http://windows.lbl.gov\">\n\
         <WindowElementType>System</WindowElementType>\n<FileType>BSDF</FileType>\n\
         <Optical>\n<Layer>\n<Material>\n<Name>{name}</Name>\n\
         <Manufacturer>computed with mist {}</Manufacturer>\n<DeviceType>Other</DeviceType>\n\
         </Material>\n<DataDefinition>\n\
         <IncidentDataStructure>Columns</IncidentDataStructure>\n\
         <AngleBasis>\n<AngleBasisName>{BASIS}</AngleBasisName>",
        env!("CARGO_PKG_VERSION")
    )?;
    let mut lower = 0.0;
    for (upper, count) in RINGS {
        let theta = if lower == 0.0 { 0.0 } else { 0.5 * (lower + upper) };
        writeln!(
            out,
            "<AngleBasisBlock><Theta>{theta}</Theta><nPhis>{count}</nPhis><ThetaBounds>\
             <LowerTheta>{lower}</LowerTheta><UpperTheta>{upper}</UpperTheta></ThetaBounds>\
             </AngleBasisBlock>"
        )?;
        lower = upper;
    }
    writeln!(out, "</AngleBasis>\n</DataDefinition>")
}

/// The values of one band on one side: a row per outgoing patch.
fn block(
    out: &mut impl Write,
    band: &str,
    side: &str,
    value: impl Fn(usize, usize) -> f64,
) -> std::io::Result<()> {
    writeln!(
        out,
        "<WavelengthData>\n<LayerNumber>System</LayerNumber>\n\
         <Wavelength unit=\"Integral\">{band}</Wavelength>\n\
         <SourceSpectrum>equal energy</SourceSpectrum>\n\
         <DetectorSpectrum>CIE 1931</DetectorSpectrum>\n<WavelengthDataBlock>\n\
         <WavelengthDataDirection>{side}</WavelengthDataDirection>\n\
         <ColumnAngleBasis>{BASIS}</ColumnAngleBasis>\n<RowAngleBasis>{BASIS}</RowAngleBasis>\n\
         <ScatteringDataType>BRDF</ScatteringDataType>\n<ScatteringData>"
    )?;
    let count: usize = RINGS.iter().map(|ring| ring.1).sum();
    for to in 0..count {
        let row: Vec<String> = (0..count).map(|from| format!("{:.6e}", value(to, from))).collect();
        writeln!(out, "{},", row.join(","))?;
    }
    writeln!(out, "</ScatteringData>\n</WavelengthDataBlock>\n</WavelengthData>")
}

/// The blocks of a file: band, side, and the values `[outgoing][incident]`.
pub type Block = (String, String, Vec<Vec<f64>>);

/// Reads a file that [`fn@write`] wrote.
///
/// # Errors
///
/// For files with another basis or order of rows, and numbers that are missing.
pub fn read(text: &str) -> Result<Vec<Block>, ExportError> {
    let refused = |problem: &str| ExportError::refused("Klems file", problem);
    if !text.contains(&format!("<AngleBasisName>{BASIS}</AngleBasisName>"))
        || !text.contains("<IncidentDataStructure>Columns</IncidentDataStructure>")
    {
        return Err(refused("expected the basis LBNL/Klems Full with columns"));
    }
    let count: usize = RINGS.iter().map(|ring| ring.1).sum();
    let mut blocks = Vec::new();
    for piece in text.split("<WavelengthData>").skip(1) {
        let inside = |tag: &str| {
            // Either the whole tag or one with attributes; no other tag that begins like it.
            let whole = piece.split_once(&format!("<{tag}>"));
            let rest = match whole {
                Some((_, rest)) => rest,
                None => piece.split_once(&format!("<{tag} "))?.1.split_once('>')?.1,
            };
            Some(rest.split_once(&format!("</{tag}>"))?.0)
        };
        let part = |tag: &str| inside(tag).ok_or_else(|| refused(&format!("{tag} is missing")));
        let numbers: Result<Vec<f64>, _> = part("ScatteringData")?
            .split([',', '\n', ' '])
            .filter(|word| !word.is_empty())
            .map(str::parse)
            .collect();
        let numbers =
            numbers.map_err(|_| refused("ScatteringData has a word that is no number"))?;
        if numbers.len() != count * count {
            return Err(refused(&format!("{} numbers of {}", numbers.len(), count * count)));
        }
        let rows = numbers.chunks(count).map(<[f64]>::to_vec).collect();
        let (band, side) = (part("Wavelength")?, part("WavelengthDataDirection")?);
        blocks.push((band.to_owned(), side.to_owned(), rows));
    }
    Ok(blocks)
}

/// The projected solid angle of every patch, sr; their sum is π.
pub fn projected_solid_angles() -> Vec<f64> {
    let angle =
        |patch: &Patch| 0.5 * patch.width * (patch.upper.sin().powi(2) - patch.lower.sin().powi(2));
    let all: Vec<f64> = patches().iter().map(angle).collect();
    debug_assert!((all.iter().sum::<f64>() - PI).abs() < 1e-9);
    all
}

#[cfg(test)]
mod tests {
    use mist_engine::material::Material;
    use scattering::Mode;

    use super::*;

    fn file(json: &str) -> Vec<Block> {
        let material = Material::from_json(json).unwrap().prepare(Mode::Sound, None).unwrap();
        let bands = Bands::new(&material, &[400.0, 500.0, 600.0, 700.0]).unwrap();
        let out = write(&bands, "a < b", Vec::new(), &Control::default()).unwrap();
        read(&String::from_utf8(out).unwrap()).unwrap()
    }

    #[test]
    fn a_grey_diffuser_has_one_value_in_all_bands() {
        let blocks = file(
            r#"{"model": "Lambertian_BRDF_Model",
            "parameters": {"reflectance": "Table_Reflectance", "reflectance.table": 0.5}}"#,
        );
        assert_eq!(blocks.len(), 6);
        for value in blocks.iter().flat_map(|block| block.2.iter().flatten()) {
            // The sums of the three colour-matching functions differ by parts in 10⁴.
            assert!((value * PI - 0.5).abs() < 2e-4, "{value}");
        }
    }

    #[test]
    fn the_light_of_facets_is_on_the_diagonal_and_patches_fill_the_hemisphere() {
        let omegas = projected_solid_angles();
        assert_eq!(omegas.len(), 145);
        assert!((omegas.iter().sum::<f64>() - PI).abs() < 1e-12);
        let blocks = file(
            r#"{"model": "Facet_BRDF_Model", "parameters": {"substrate": "(0.7,2.4)",
            "sdf": "Gaussian_Slope_Distribution_Function", "sdf.s": 0.2}}"#,
        );
        for from in [0, 5, 40, 100] {
            let column: Vec<f64> = blocks[0].2.iter().map(|row| row[from]).collect();
            let most = column.iter().copied().fold(0.0, f64::max);
            assert_eq!(column[from], most, "{from}");
        }
    }

    #[test]
    fn every_patch_contains_its_middle_and_directions_in_it() {
        for (k, patch) in patches().iter().enumerate() {
            assert_eq!(containing(patch.middle()), k);
            for (u, w) in [(0.01, 0.01), (0.01, 0.99), (0.99, 0.01), (0.99, 0.99)] {
                assert_eq!(containing(patch.direction(u, w)), k, "{u} {w}");
            }
        }
    }

    #[test]
    fn the_stated_error_is_none_for_a_diffuser_and_grows_as_the_lobe_narrows() {
        let of = |json: &str| {
            let material = Material::from_json(json).unwrap().prepare(Mode::Sound, None).unwrap();
            spread(&Bands::new(&material, &[400.0, 550.0, 700.0]).unwrap()).unwrap()
        };
        let facets = |slope: f64| {
            of(&format!(
                r#"{{"model": "Facet_BRDF_Model", "parameters": {{"substrate": "(0.7,2.4)",
                "sdf": "Gaussian_Slope_Distribution_Function", "sdf.s": {slope}}}}}"#
            ))
        };
        let white = of(r#"{"model": "Lambertian_BRDF_Model", "parameters": {}}"#);
        assert!(white.most < 1e-12, "{white:?}");
        let (wide, narrow) = (facets(0.5), facets(0.1));
        assert!(wide.median > 0.01 && 2.0 * wide.median < narrow.median, "{wide:?} {narrow:?}");
    }

    #[test]
    fn other_files_are_refused() {
        assert!(read("<WindowElement/>").is_err());
    }
}
